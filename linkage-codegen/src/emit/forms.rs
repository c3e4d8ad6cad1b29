//! Names of values that no rule has named, by what they are made of: `push_times_cos`, `left_cross_upper`, `reach_squared`.

use super::formula::Terms;
use crate::graph::number::Number;
use crate::graph::{Graph, Kernel, Op};

/// Letters of the longest such name: a longer one says no more than the statement itself.
const LENGTH: usize = 40;

/// Names terms by their form.
pub(super) struct Forms<'a, S> {
    pub(super) graph: &'a Graph,
    pub(super) terms: &'a S,
}

impl<S> Forms<'_, S> {
    /// The name of what an operation makes of terms that have names.
    pub(super) fn name<T: Copy + PartialEq>(&self, term: T) -> Option<String>
    where
        S: Terms<T>,
    {
        self.made_of(term).filter(|name| name.len() <= LENGTH)
    }

    fn made_of<T: Copy + PartialEq>(&self, term: T) -> Option<String>
    where
        S: Terms<T>,
    {
        let known = |term: T| self.terms.name(term).filter(|name| !is_sum(name) && !is_product(name));
        // As a whole a product may have a sign or a factor.
        let called = |term: T| self.terms.name(term).or_else(|| self.made_of(term));
        let whole = |term: T| called(term).filter(|name| !is_sum(name));
        let of_both = |a: T, word: &str, b: T| Some(format!("{}_{word}_{}", known(a)?, known(b)?));
        let is_constant = |term: T| self.constant(term).is_some();
        match self.terms.op(term) {
            Op::Neg(a) => Some(format!("minus_{}", whole(a)?)),
            Op::Abs(a) => match called(a)? {
                name if is_sum(&name) => Some(format!("abs_of_{name}")),
                name => Some(format!("abs_{name}")),
            },
            Op::Mul(a, b) if is_constant(a) => Some(scaled(&whole(b)?)),
            Op::Mul(a, b) if is_constant(b) => Some(scaled(&whole(a)?)),
            Op::Mul(a, b) if a == b => match called(a)? {
                name if is_sum(&name) || is_product(&name) => Some(format!("squared_{name}")),
                name => Some(format!("{name}_squared")),
            },
            Op::Mul(a, b) => match ([a, b].map(called), [a, b].map(|term| self.divisor(term))) {
                ([Some(a), Some(b)], _) if is_sum(&a) && is_sum(&b) => Some(format!("product_of_{a}_and_{b}")),
                (_, [Some(divisor), None]) => of_both(b, "over", divisor),
                (_, [None, Some(divisor)]) => of_both(a, "over", divisor),
                _ => Some(product(&known(a)?, &known(b)?)),
            },
            Op::Div(a, b) => match self.constant(a) {
                Some(one) if one.is_one() => Some(format!("inverse_{}", known(b)?)),
                Some(_) => Some(scaled(&format!("inverse_{}", known(b)?))),
                None => of_both(a, "over", b),
            },
            Op::Add(a, b) | Op::Sub(a, b) if is_constant(b) => Some(format!("{}_shifted", known(a)?)),
            Op::Add(a, b) if is_constant(a) => Some(format!("{}_shifted", known(b)?)),
            Op::Sub(a, b) if is_constant(a) => Some(format!("minus_{}_shifted", known(b)?)),
            Op::Add(a, b) => of_both(a, "plus", b).or_else(|| self.product_of_vectors(term)),
            Op::Sub(a, b) => of_both(a, "minus", b).or_else(|| self.product_of_vectors(term)),
            Op::Kernel { kernel: Kernel::MulAdd, .. } => self.product_of_vectors(term),
            _ => None,
        }
    }

    /// What one is divided by, without a name of its own.
    fn divisor<T: Copy>(&self, term: T) -> Option<T>
    where
        S: Terms<T>,
    {
        match (self.terms.name(term), self.terms.op(term)) {
            (None, Op::Div(one, divisor)) if self.constant(one).is_some_and(|one| one.is_one()) => Some(divisor),
            _ => None,
        }
    }

    fn constant<T: Copy>(&self, term: T) -> Option<Number>
    where
        S: Terms<T>,
    {
        match (self.terms.name(term), self.terms.op(term)) {
            (None, Op::Constant(number)) => Some(self.graph.number(number)),
            _ => None,
        }
    }

    /// `a_x b_y − a_y b_x` is `a_cross_b`, and `a_x b_x + a_y b_y` is `a_dot_b`.
    fn product_of_vectors<T: Copy>(&self, term: T) -> Option<String>
    where
        S: Terms<T>,
    {
        let mut products = Vec::new();
        self.add_products(term, false, &mut products)?;
        let [one, other] = products.as_slice() else { return None };
        let (plus, minus) = if one.is_negative { (other, one) } else { (one, other) };
        let factors = |product: &Product| {
            let [a, b] = &product.factors;
            Some([component(a)?, component(b)?].map(|(vector, part)| (vector.to_owned(), part)))
        };
        let ([(a, a_part), (b, b_part)], mut second) = (factors(plus)?, factors(minus)?);
        if second[0].0 != a {
            second.reverse();
        }
        let [(c, c_part), (d, d_part)] = second;
        if (&a, &b) != (&c, &d) || a_part == c_part || b_part == d_part || plus.is_negative {
            return None;
        }
        match (a_part == b_part, minus.is_negative) {
            (true, false) => Some(format!("{a}_dot_{b}")),
            (false, true) if a_part == Component::X => Some(format!("{a}_cross_{b}")),
            (false, true) => Some(format!("{b}_cross_{a}")),
            _ => None,
        }
    }

    /// The two products that a term is the sum of; none if it is made otherwise.
    fn add_products<T: Copy>(&self, term: T, is_negative: bool, products: &mut Vec<Product>) -> Option<()>
    where
        S: Terms<T>,
    {
        match self.terms.op(term) {
            // Of three or more nobody asks.
            _ if products.len() == 2 || self.terms.name(term).is_some() => None,
            Op::Neg(a) => self.add_products(a, !is_negative, products),
            Op::Add(a, b) => {
                self.add_products(a, is_negative, products)?;
                self.add_products(b, is_negative, products)
            }
            Op::Sub(a, b) => {
                self.add_products(a, is_negative, products)?;
                self.add_products(b, !is_negative, products)
            }
            Op::Mul(a, b) => {
                products.push(Product { is_negative, factors: [self.terms.name(a)?, self.terms.name(b)?] });
                Some(())
            }
            Op::Kernel { kernel: Kernel::MulAdd, args, .. } => {
                let (less, a) = match (self.terms.name(args[0]), self.terms.op(args[0])) {
                    (None, Op::Neg(a)) => (true, a),
                    _ => (false, args[0]),
                };
                let factors = [self.terms.name(a)?, self.terms.name(args[1])?];
                products.push(Product { is_negative: is_negative != less, factors });
                self.add_products(args[2], is_negative, products)
            }
            _ => None,
        }
    }
}

/// A product as a term of a sum.
struct Product {
    is_negative: bool,
    factors: [String; 2],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Component {
    X,
    Y,
}

/// The vector or direction that a name is a component of, and which one.
fn component(name: &str) -> Option<(&str, Component)> {
    let endings = [("_cos", Component::X), ("_x", Component::X), ("_sin", Component::Y), ("_y", Component::Y)];
    endings.into_iter().find_map(|(ending, part)| Some((name.strip_suffix(ending)?, part)))
}

/// The name of a multiple.
pub(super) fn scaled(name: &str) -> String {
    // Of what is a multiple itself it is another one, and gets a number.
    format!("{}_scaled", name.trim_end_matches("_scaled"))
}

/// The name of a product. Of a number times a component of its own direction the component alone is said.
fn product(a: &str, b: &str) -> String {
    let [a, b] = if is_of_direction(a) && !is_of_direction(b) { [b, a] } else { [a, b] };
    match b.rsplit_once('_') {
        Some((direction, part)) if is_of_direction(b) && has_words(a, direction) => format!("{a}_times_{part}"),
        _ => format!("{a}_times_{b}"),
    }
}

/// Whether a name contains another one, word by word.
fn has_words(name: &str, words: &str) -> bool {
    format!("_{name}_").contains(&format!("_{words}_"))
}

/// Whether a name is a sum: as a part of a longer one it could be read in another way.
fn is_sum(name: &str) -> bool {
    ["_plus_", "_minus_"].iter().any(|word| name.contains(word))
}

fn is_product(name: &str) -> bool {
    ["_times_", "_over_", "_cross_", "_dot_"].iter().any(|word| name.contains(word))
}

/// Whether a name is that of a cosine or a sine.
fn is_of_direction(name: &str) -> bool {
    name.ends_with("_cos") || name.ends_with("_sin")
}
