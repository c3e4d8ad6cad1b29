//! Factors that both terms of a sum have are multiplied once: `(f g) x ± (h f) (g y) = (f g) (x ± h y)`, where nothing else reads the
//! products. So in virtual work the works on a dyad's links, which have `1/sin μ` in common and what brings the links' directions to unit
//! size. The constants of each term are brought together and rounded once; where that takes a product less, the first term's goes to the
//! common factors, to a quotient of a constant above all, and the second's is divided by it.
//!
//! It is only done where the sum is not known later for it, and where it saves as many products as names go, at least one: each name is
//! a line of the derivation. What is left of a product that had a name is named as its factor.

use std::collections::BTreeSet;

use super::cycles::{Ready, is_side};
use crate::graph::number::Number;
use crate::graph::{Graph, Label, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn factor(program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let mut factoring = Factoring { graph, program, uses, ready: Ready::default(), steps: Vec::new() };
    for step in core::mem::take(&mut factoring.program.steps) {
        if let Step::Let(value) = step {
            factoring.compute(value);
            if let Some(terms) = factoring.terms(value) {
                factoring.take_out(value, terms);
            }
        } else {
            factoring.steps.push(step);
        }
    }
    factoring.program.steps = factoring.steps;
    super::unused::remove(factoring.program, graph)
}

struct Factoring<'g> {
    graph: &'g Graph,
    program: Program,
    /// Of the values that were there before.
    uses: Vec<usize>,
    ready: Ready,
    steps: Vec<Step>,
}

/// A sum as `k common (±k₁ first ± k₂ second)`, the common factors as those of both terms.
struct Terms {
    common: Vec<[Factor; 2]>,
    k: Number,
    first: (Number, Vec<Factor>),
    second: (Number, Vec<Factor>),
    negative: [bool; 2],
}

/// A product, however it is put together, and how many products it is now, how many of them with names.
struct Product {
    constant: Number,
    factors: Vec<Factor>,
    products: usize,
    names: usize,
}

/// A factor, and the product with a name through which it is one.
#[derive(Clone, Copy)]
struct Factor {
    value: ValueId,
    of: Option<ValueId>,
}

impl Factoring<'_> {
    /// The factors of a sum's terms, if some are common and it saves enough to take them out.
    fn terms(&self, sum: ValueId) -> Option<Terms> {
        let (terms, minus) = self.program.op(sum)?.terms()?;
        if !terms.iter().all(|term| self.is_read_once(*term)) {
            return None;
        }
        let ([first, second], common) = self.common_factors(terms);
        if common.is_empty() || first.factors.is_empty() || second.factors.is_empty() {
            return None;
        }
        let negative = [first.constant.signum() < 0, minus != (second.constant.signum() < 0)];
        let [k1, k2] = [&first, &second].map(|term| term.constant.abs());
        let ratio = k2.div(&k1)?;
        let product = |k: &Number| usize::from(!k.is_one());
        let takes_constant = common.iter().any(|[factor, _]| self.quotient(factor.value, 2).is_some());
        let [inside, outside] =
            [product(&k1) + product(&k2), if takes_constant { 0 } else { product(&k1) } + product(&ratio)];
        let products = common.len() + first.factors.len() + second.factors.len() - 2 + inside.min(outside);
        let (before, names) = (first.products + second.products, first.names + second.names);
        if before < products + names.max(1) {
            return None;
        }
        let (k, k1, k2) = if outside < inside { (k1, Number::one(), ratio) } else { (Number::one(), k1, k2) };
        Some(Terms { common, k, first: (k1, first.factors), second: (k2, second.factors), negative })
    }

    /// Two terms as products without the factors that are common, and these. A product with a name that has none of them stays one factor.
    fn common_factors(&self, terms: [ValueId; 2]) -> ([Product; 2], Vec<[Factor; 2]>) {
        let mut kept = BTreeSet::new();
        loop {
            let [mut first, mut second] = terms.map(|term| self.product(term, &kept));
            let common = take_common(&mut first.factors, &mut second.factors);
            let through = names_of(common.iter().flatten());
            let names = names_of(first.factors.iter().chain(&second.factors));
            let whole: Vec<ValueId> = names.into_iter().filter(|name| !through.contains(name)).collect();
            if whole.is_empty() {
                return ([first, second], common);
            }
            kept.extend(whole);
        }
    }

    /// A value as a product, through products that nothing else reads, but for those that are kept.
    ///
    /// With a side that is given at run time a value is one factor, as with its sign in the declaration.
    fn product(&self, value: ValueId, kept: &BTreeSet<ValueId>) -> Product {
        let mut product = Product { constant: Number::one(), factors: Vec::new(), products: 0, names: 0 };
        let mut open = vec![Factor { value, of: None }];
        while let Some(Factor { value, of }) = open.pop() {
            let is_inner = self.is_read_once(value) && !kept.contains(&value);
            let is_named = self.label(value).is_some();
            let inner = |inner: &ValueId| Factor { value: *inner, of: if is_named { Some(value) } else { of } };
            match self.program.op(value) {
                Some(Op::Constant(number)) => product.constant = product.constant.mul(&self.graph.number(*number)),
                Some(Op::Mul(a, b)) if is_inner && ![a, b].into_iter().any(|side| is_side(&self.program, *side)) => {
                    product.products += 1;
                    product.names += usize::from(is_named);
                    open.extend([inner(b), inner(a)]);
                }
                Some(Op::Neg(a)) if is_inner => {
                    product.constant = product.constant.neg();
                    product.names += usize::from(is_named);
                    open.push(inner(a));
                }
                _ => product.factors.push(Factor { value, of }),
            }
        }
        product
    }

    fn is_read_once(&self, value: ValueId) -> bool {
        self.uses.get(value.index()) == Some(&1)
    }

    /// Another way to a sum that has just been computed, if that does not take longer.
    fn take_out(&mut self, sum: ValueId, terms: Terms) {
        let (values, ready) = (self.program.values.len(), self.ready.of(sum));
        self.steps.pop();
        let steps = self.steps.len();
        let Terms { common, k, first, second, negative } = terms;
        let is_named = common.iter().flatten().any(|factor| factor.of.is_some());
        let mut factors = Vec::new();
        let [x, y] = [first, second].map(|(k, rest)| self.multiply_rest(&k, &rest, sum, &mut factors));
        let common = self.multiply(&k, (common.iter().map(|[factor, _]| factor.value).collect(), 2), sum);
        let inner = match negative {
            [true, false] => Op::Sub(y, x),
            [first, second] => Op::of_terms([x, y], first != second),
        };
        let product = Op::Mul(common, self.add(inner, sum));
        let op = if negative == [true; 2] { Op::Neg(self.add(product, sum)) } else { product };
        let before = core::mem::replace(&mut self.program.values[sum.index()].definition, Definition::Computed(op));
        self.compute(sum);
        if self.ready.of(sum) > ready {
            self.program.values[sum.index()].definition = before;
            self.program.values.truncate(values);
            self.steps.truncate(steps);
            self.compute(sum);
            return;
        }
        if is_named {
            let equation = "what both terms of the next sum have in common".to_owned();
            self.name(common, values, Label { name: "common".to_owned(), equation });
        }
        for (factor, product) in factors {
            self.name_factor(factor, values, product);
        }
    }

    /// Names what is left of a product with a name.
    fn name_factor(&mut self, factor: ValueId, values: usize, product: ValueId) {
        if let Some(Label { name, equation }) = self.label(product) {
            let of = if equation.is_empty() { name.clone() } else { format!("{name}, {equation}") };
            self.name(factor, values, Label { name: format!("{name}_factor"), equation: format!("factor of {of}") });
        }
    }

    fn label(&self, value: ValueId) -> Option<Label> {
        self.program.value(value).label.clone()
    }

    /// Names a value that is new, or that is a step which nothing else reads.
    fn name(&mut self, value: ValueId, values: usize, label: Label) {
        let is_step = matches!(self.program.op(value), Some(Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..)));
        if value.index() >= values || is_step && self.is_read_once(value) {
            self.program.values[value.index()].label.get_or_insert(label);
        }
    }

    /// What is left of a term; of a product with a name, that by itself, which is added to `named` with the product.
    fn multiply_rest(
        &mut self,
        k: &Number,
        rest: &[Factor],
        beside: ValueId,
        named: &mut Vec<(ValueId, ValueId)>,
    ) -> ValueId {
        let of = |product: Option<ValueId>| {
            rest.iter().filter(move |factor| factor.of == product).map(|factor| factor.value).collect()
        };
        let mut factors: Vec<ValueId> = of(None);
        for product in names_of(rest) {
            let left = self.multiply(&Number::one(), (of(Some(product)), 1), product);
            named.push((left, product));
            factors.push(left);
        }
        self.multiply(k, (factors, 1), beside)
    }

    /// The product of a constant and some factors, each of which is read that often here: those first that are known first.
    fn multiply(&mut self, constant: &Number, (mut factors, reads): (Vec<ValueId>, usize), beside: ValueId) -> ValueId {
        self.sort(&mut factors);
        if !constant.is_one() {
            self.scale(constant, (&mut factors, reads), beside);
            self.sort(&mut factors);
        }
        while let [first, second, ..] = factors[..] {
            factors.drain(..2);
            factors.push(self.add(Op::Mul(first, second), beside));
            self.sort(&mut factors);
        }
        factors[0]
    }

    /// Multiplies a quotient of a constant that nothing else reads by another one, or else what is known first.
    fn scale(&mut self, constant: &Number, (factors, reads): (&mut Vec<ValueId>, usize), beside: ValueId) {
        let quotient = |factor: &ValueId| {
            let (dividend, divisor) = self.quotient(*factor, reads)?;
            Some((dividend.mul(constant), divisor))
        };
        let found = factors.iter().enumerate().find_map(|(place, factor)| Some((place, quotient(factor)?)));
        if let Some((place, (dividend, divisor))) = found {
            let dividend = self.program.add_constant(self.graph, &dividend, beside);
            factors[place] = self.add(Op::Div(dividend, divisor), beside);
        } else {
            let constant = self.program.add_constant(self.graph, constant, beside);
            factors[0] = self.add(Op::Mul(constant, factors[0]), beside);
        }
    }

    /// The constant and the divisor of a quotient of a constant that is read that often.
    fn quotient(&self, value: ValueId, reads: usize) -> Option<(Number, ValueId)> {
        self.program.quotient(self.graph, value).filter(|_| self.uses.get(value.index()) == Some(&reads))
    }

    fn sort(&self, factors: &mut [ValueId]) {
        factors.sort_by_key(|factor| self.ready.of(*factor));
    }

    /// A value that is new, computed here.
    fn add(&mut self, op: Op<ValueId>, beside: ValueId) -> ValueId {
        let value = self.program.add(op, beside);
        self.compute(value);
        value
    }

    fn compute(&mut self, value: ValueId) {
        self.steps.push(Step::Let(value));
        self.ready.compute(&self.program, value);
    }
}

/// What both have is taken out of both.
fn take_common(first: &mut Vec<Factor>, second: &mut Vec<Factor>) -> Vec<[Factor; 2]> {
    let mut common = Vec::new();
    first.retain(|factor| {
        let place = second.iter().position(|other| other.value == factor.value);
        common.extend(place.map(|place| [*factor, second.remove(place)]));
        place.is_none()
    });
    common
}

/// The products with names through which these are factors.
fn names_of<'a>(factors: impl IntoIterator<Item = &'a Factor>) -> Vec<ValueId> {
    let mut names = Vec::new();
    for name in factors.into_iter().filter_map(|factor| factor.of) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}
