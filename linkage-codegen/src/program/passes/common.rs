//! Factors that both terms of a sum have are multiplied once: `(f g) x ± (h f) (g y) = (f g) (x ± h y)`, where nothing else reads the
//! products. So in virtual work the rates of rotation of a dyad's links, which share `1/sin μ` and what brings their directions to unit
//! size. The constants of both terms are brought together and rounded once; one goes to a quotient of a constant among the factors.
//!
//! It is a product less for each of them, and only done where the sum is not known later for it. What is left of a product that had a name
//! is named as its factor.

use super::cycles::Ready;
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

/// A sum as `k common (first ± ratio second)`, the common factors as those of both terms.
struct Terms {
    common: Vec<[Factor; 2]>,
    k: Number,
    first: Vec<Factor>,
    minus: bool,
    ratio: Number,
    second: Vec<Factor>,
}

/// A product, however it is put together.
struct Product {
    constant: Number,
    factors: Vec<Factor>,
}

/// A factor, and the product with a name through which it is one.
#[derive(Clone, Copy)]
struct Factor {
    value: ValueId,
    of: Option<ValueId>,
}

impl Factoring<'_> {
    /// The factors of a sum's terms, if they have some in common. A single one is taken out where it is known last, which another pass
    /// sees to.
    fn terms(&self, sum: ValueId) -> Option<Terms> {
        let (terms, minus) = self.program.op(sum)?.terms()?;
        if !terms.iter().all(|term| self.is_read_once(*term)) {
            return None;
        }
        let [mut first, mut second] = terms.map(|term| self.product(term));
        let common = take_common(&mut first.factors, &mut second.factors);
        let ratio = second.constant.div(&first.constant)?;
        let some = common.len() > 1 && !first.factors.is_empty() && !second.factors.is_empty();
        some.then(|| Terms {
            common,
            k: first.constant,
            first: first.factors,
            minus: minus != (ratio.signum() < 0),
            ratio: ratio.abs(),
            second: second.factors,
        })
    }

    /// A value as a product, through products that nothing else reads.
    fn product(&self, value: ValueId) -> Product {
        let mut product = Product { constant: Number::one(), factors: Vec::new() };
        let mut open = vec![Factor { value, of: None }];
        while let Some(Factor { value, of }) = open.pop() {
            let inner = |value: &ValueId| {
                let named = self.program.value(*value).label.is_some() && self.is_product(*value);
                Factor { value: *value, of: if named { Some(*value) } else { of } }
            };
            match self.program.op(value) {
                Some(Op::Constant(number)) => product.constant = product.constant.mul(&self.graph.number(*number)),
                Some(Op::Mul(a, b)) if self.is_read_once(value) => open.extend([inner(b), inner(a)]),
                Some(Op::Neg(a)) if self.is_read_once(value) => {
                    product.constant = product.constant.neg();
                    open.push(inner(a));
                }
                _ => product.factors.push(Factor { value, of }),
            }
        }
        product
    }

    fn is_product(&self, value: ValueId) -> bool {
        self.is_read_once(value) && matches!(self.program.op(value), Some(Op::Mul(..) | Op::Neg(_)))
    }

    fn is_read_once(&self, value: ValueId) -> bool {
        self.uses.get(value.index()) == Some(&1)
    }

    /// Another way to a sum that has just been computed, if that does not take longer.
    fn take_out(&mut self, sum: ValueId, terms: Terms) {
        let (values, ready) = (self.program.values.len(), self.ready.of(sum));
        self.steps.pop();
        let steps = self.steps.len();
        let Terms { common, k, first, minus, ratio, second } = terms;
        let names = names_of(common.iter().flatten());
        let common = self.multiply(&k.abs(), common.iter().map(|[factor, _]| factor.value).collect(), sum);
        let mut factors = Vec::new();
        let [x, y] =
            [(Number::one(), first), (ratio, second)].map(|(k, rest)| self.multiply_rest(&k, &rest, sum, &mut factors));
        let negative = k.signum() < 0;
        let inner = self.add(if negative && minus { Op::Sub(y, x) } else { Op::of_terms([x, y], minus) }, sum);
        let product = Op::Mul(common, inner);
        let op = if negative && !minus { Op::Neg(self.add(product, sum)) } else { product };
        let before = core::mem::replace(&mut self.program.values[sum.index()].definition, Definition::Computed(op));
        self.compute(sum);
        if self.ready.of(sum) > ready {
            self.program.values[sum.index()].definition = before;
            self.program.values.truncate(values);
            self.steps.truncate(steps);
            self.compute(sum);
            return;
        }
        self.name(common, &names, &factors);
    }

    /// Names what is common to products with names, and what is left of them.
    fn name(&mut self, common: ValueId, products: &[ValueId], factors: &[(ValueId, ValueId)]) {
        let labels: Vec<Label> =
            products.iter().filter_map(|product| self.program.value(*product).label.clone()).collect();
        let of = |value: ValueId| self.program.value(value).label.clone();
        let names: Vec<&str> = labels.iter().map(|label| label.name.as_str()).collect();
        let mut labels = Vec::new();
        if !names.is_empty() {
            let equation = format!("common factor of {}", names.join(" and "));
            labels.push((common, Label { name: "common".to_owned(), equation }));
        }
        for (value, product) in factors {
            if let (None, Some(Label { name, equation })) = (of(*value), of(*product)) {
                let equation = format!("factor of {name}, {equation}");
                labels.push((*value, Label { name: format!("{name}_factor"), equation }));
            }
        }
        for (value, label) in labels {
            self.program.values[value.index()].label = Some(label);
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
            let left = self.multiply(&Number::one(), of(Some(product)), product);
            named.push((left, product));
            factors.push(left);
        }
        self.multiply(k, factors, beside)
    }

    /// The product of a constant and some factors: those first that are known first.
    fn multiply(&mut self, constant: &Number, mut factors: Vec<ValueId>, beside: ValueId) -> ValueId {
        self.sort(&mut factors);
        if !constant.is_one() {
            self.scale(constant, &mut factors, beside);
        }
        while let [first, second, ..] = factors[..] {
            factors.drain(..2);
            factors.push(self.add(Op::Mul(first, second), beside));
            self.sort(&mut factors);
        }
        factors[0]
    }

    /// Multiplies a quotient of a constant among the factors by another one, or else what is known first.
    fn scale(&mut self, constant: &Number, factors: &mut [ValueId], beside: ValueId) {
        let quotient = |factor: &ValueId| match self.program.op(*factor) {
            Some(Op::Div(dividend, divisor)) => Some((self.program.constant(self.graph, *dividend)?, *divisor)),
            _ => None,
        };
        let found = factors.iter().enumerate().find_map(|(place, factor)| Some((place, quotient(factor)?)));
        let number =
            |factoring: &mut Self, number: &Number| factoring.program.add_constant(factoring.graph, number, beside);
        if let Some((place, (dividend, divisor))) = found {
            let dividend = number(self, &dividend.mul(constant));
            factors[place] = self.add(Op::Div(dividend, divisor), beside);
        } else {
            let constant = number(self, constant);
            factors[0] = self.add(Op::Mul(constant, factors[0]), beside);
        }
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
