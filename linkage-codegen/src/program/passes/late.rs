//! What is known last is multiplied last, so that little has to wait for it: `(f a) x ± (f b) y = f (a x ± b y)` for an `f` that is known
//! after all the others, as what brings a vector to unit size is; then `k (f x) = f (k x)`. It is a product less where nothing else reads
//! `f a` and `f b`, and a product more where something does: that is spent on the longest way to the results only.
//!
//! And nothing that is known last waits for a constant: `k (a x ± b y) = (k a) x ± (k b) y`, where a multiple by `k` of a factor is there
//! already, under a name. It is a product less where there is one for both terms; on the longest way one is enough, and in the other term
//! the factor is multiplied that is known first.

use std::collections::BTreeMap;

use super::cycles::{PRODUCT, Ready, cycles};
use crate::graph::number::Number;
use crate::graph::{Graph, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn multiply_last(program: Program, graph: &Graph) -> Program {
    let (uses, spare) = (program.uses(), spare(&program));
    let (ready, multiples) = (Ready::default(), BTreeMap::new());
    let mut ordering = Ordering { graph, program, uses, spare, ready, multiples, steps: Vec::new() };
    for step in core::mem::take(&mut ordering.program.steps) {
        if let Step::Let(value) = step {
            ordering.improve(value);
            ordering.compute(value);
        } else {
            ordering.steps.push(step);
        }
    }
    ordering.program.steps = ordering.steps;
    super::unused::remove(ordering.program, graph)
}

/// How much later each value could be known without a result being known later than the last one is.
fn spare(program: &Program) -> Vec<u32> {
    let ready = Ready::all(program);
    let values = || (0..program.values.len()).map(ValueId::new);
    let last = values().map(|value| ready.of(value)).max().unwrap_or(0);
    let mut latest = vec![last; program.values.len()];
    for step in program.steps.iter().rev() {
        if let Step::Let(value) = step {
            let begin = latest[value.index()].saturating_sub(program.op(*value).map_or(0, |op| cycles(program, op)));
            for operand in program.operands_of(step) {
                latest[operand.index()] = latest[operand.index()].min(begin);
            }
        }
    }
    latest.iter().zip(values()).map(|(latest, value)| latest.saturating_sub(ready.of(value))).collect()
}

/// What is spare by less than this, little more than an operation, is on the longest way.
const SHORT: u32 = 5;

struct Ordering<'g> {
    graph: &'g Graph,
    program: Program,
    uses: Vec<usize>,
    /// How long each could be waited for. New values have none: they stand within others.
    spare: Vec<u32>,
    ready: Ready,
    /// The multiples by constants that others may use, by what they are multiples of.
    multiples: BTreeMap<ValueId, Vec<(Number, ValueId)>>,
    steps: Vec<Step>,
}

/// The terms of a sum or a difference, products that nothing else reads.
struct Products {
    terms: [ValueId; 2],
    minus: bool,
}

/// A factor of a factor of a product: `late` of `product = late · within`, beside which stands `beside`.
#[derive(Clone, Copy)]
struct Factor {
    late: ValueId,
    within: ValueId,
    product: ValueId,
    beside: ValueId,
}

/// The factor of a product that is multiplied by a constant, what stands beside it, and the multiple if it is there, perhaps as its
/// opposite.
#[derive(Clone, Copy)]
struct Scaled {
    factor: ValueId,
    other: ValueId,
    there: Option<(ValueId, bool)>,
}

impl Ordering<'_> {
    fn improve(&mut self, value: ValueId) {
        match self.program.op(value).cloned() {
            Some(Op::Add(..) | Op::Sub(..)) => self.take_out(value),
            Some(Op::Mul(k, rest)) if self.program.constant(self.graph, k).is_some() => {
                self.distribute(value, k, rest);
                self.swap(value);
            }
            _ => {}
        }
    }

    /// `(f a) x ± (f b) y = f (a x ± b y)`.
    fn take_out(&mut self, value: ValueId) {
        let Some(Products { terms, minus }) = self.products(value) else { return };
        let Some([first, second]) = self.common_factor(terms) else { return };
        let saves = [first, second].iter().all(|factor| self.uses[factor.product.index()] == 1);
        // What a pose keeps, made of other things that it keeps, is waited for by nobody.
        let is_result = |value: ValueId| self.program.outputs.iter().any(|(_, output)| *output == value);
        let is_late_result = [value, first.product, second.product].into_iter().all(is_result);
        if !(saves || self.is_on_the_longest_way(value) && !is_late_result) {
            return;
        }
        for (term, factor) in terms.into_iter().zip([first, second]) {
            let Factor { within: a, beside: x, .. } = factor;
            let is_constant = self.program.constant(self.graph, x).is_some();
            self.compute_here(term, if is_constant { Op::Mul(x, a) } else { Op::Mul(a, x) });
        }
        let inner = self.add(Op::of_terms(terms, minus), value);
        self.define(value, Op::Mul(first.late, inner));
    }

    fn is_on_the_longest_way(&self, value: ValueId) -> bool {
        self.spare.get(value.index()).is_some_and(|spare| *spare < SHORT)
    }

    /// The factor that two products have within one of their factors each, if it is known last.
    fn common_factor(&self, terms: [ValueId; 2]) -> Option<[Factor; 2]> {
        let [first, second] = terms.map(|term| self.factors(term));
        first.iter().find_map(|one| {
            let other = second.iter().find(|other| other.late == one.late)?;
            let all = [one.within, one.beside, other.within, other.beside];
            all.iter().all(|factor| self.ready(*factor) < self.ready(one.late)).then_some([*one, *other])
        })
    }

    fn factors(&self, product: ValueId) -> Vec<Factor> {
        let Some(Op::Mul(u, x)) = self.program.op(product) else { return Vec::new() };
        let mut found = Vec::new();
        for (product, beside) in [(*u, *x), (*x, *u)] {
            if let Some(Op::Mul(f, a)) = self.program.op(product) {
                found.extend([(*f, *a), (*a, *f)].map(|(late, within)| Factor { late, within, product, beside }));
            }
        }
        found
    }

    /// `k (f x) = f (k x)`.
    fn swap(&mut self, value: ValueId) {
        if let Some(Op::Mul(k, product)) = self.program.op(value).cloned()
            && self.program.is_inner(product, &self.uses)
            && let Some(Op::Mul(a, b)) = self.program.op(product).cloned()
            && self.program.constant(self.graph, a).is_none()
        {
            let [early, late] = if self.ready(a) < self.ready(b) { [a, b] } else { [b, a] };
            if self.ready(early) < self.ready(late) {
                self.compute_here(product, Op::Mul(k, early));
                self.define(value, Op::Mul(product, late));
            }
        }
    }

    /// `k (a x ± b y) = (k a) x ± (k b) y`.
    fn distribute(&mut self, value: ValueId, k: ValueId, sum: ValueId) {
        if !self.program.is_inner(sum, &self.uses) {
            return;
        }
        let (Some(Products { terms, minus }), Some(number)) =
            (self.products(sum), self.program.constant(self.graph, k))
        else {
            return;
        };
        let scaled = terms.map(|term| self.scaled_factor(&number, term));
        let [Some(first), Some(second)] = scaled else { return };
        let there = [first, second].iter().filter(|factor| factor.there.is_some()).count();
        if there == 0 || there == 1 && !self.is_on_the_longest_way(value) {
            return;
        }
        let mut negative = [false, minus];
        for ((term, Scaled { factor, other, there }), negative) in
            terms.into_iter().zip([first, second]).zip(&mut negative)
        {
            let multiple = if let Some((multiple, is_opposite)) = there {
                *negative ^= is_opposite;
                multiple
            } else {
                *negative ^= number.signum() < 0;
                let size = self.program.add_constant(self.graph, &number.abs(), term);
                let multiple = self.add(Op::Mul(size, factor), term);
                self.remember(multiple);
                multiple
            };
            self.compute_here(term, Op::Mul(multiple, other));
        }
        let [p, q] = terms;
        let op = match negative {
            [false, false] => Op::Add(p, q),
            [false, true] => Op::Sub(p, q),
            [true, false] => Op::Sub(q, p),
            [true, true] => Op::Sub(self.add(Op::Neg(p), p), q),
        };
        self.define(value, op);
    }

    /// Which factor of a product of variables to multiply by `k`: one of which that multiple is there by the time that it could be, or else the one that
    /// is known first.
    fn scaled_factor(&self, k: &Number, product: ValueId) -> Option<Scaled> {
        let Some(Op::Mul(a, b)) = self.program.op(product) else { return None };
        if self.program.constant(self.graph, *a).is_some() {
            return None;
        }
        let ways = [(*a, *b), (*b, *a)];
        let there = ways.into_iter().find_map(|(factor, other)| {
            let (multiple, is_opposite) = self.multiple(k, factor)?;
            let in_time = self.ready(multiple) <= self.ready(factor).max(self.ready(other)) + PRODUCT;
            in_time.then_some(Scaled { factor, other, there: Some((multiple, is_opposite)) })
        });
        let [(factor, other), _] = if self.ready(*a) < self.ready(*b) { ways } else { [ways[1], ways[0]] };
        there.or((self.ready(factor) < self.ready(other)).then_some(Scaled { factor, other, there: None }))
    }

    /// A value that is `k` times another, and whether it is the negative of that, if there is one.
    fn multiple(&self, k: &Number, of: ValueId) -> Option<(ValueId, bool)> {
        let (own, base) = self.scaled(of);
        let wanted = own.mul(k);
        let is = |number: &Number| self.multiples.get(&base)?.iter().find(|(own, _)| own.sub(number).is_zero());
        let there = is(&wanted).map(|(_, value)| (*value, false));
        there.or_else(|| is(&wanted.neg()).map(|(_, value)| (*value, true)))
    }

    /// A value as a constant times another value.
    fn scaled(&self, value: ValueId) -> (Number, ValueId) {
        if let Some((number, x)) = self.program.multiple(self.graph, value) {
            let (inner, base) = self.scaled(x);
            return (number.mul(&inner), base);
        }
        match self.program.op(value) {
            Some(Op::Neg(x)) => {
                let (inner, base) = self.scaled(*x);
                (inner.neg(), base)
            }
            _ => (Number::one(), value),
        }
    }

    fn products(&self, sum: ValueId) -> Option<Products> {
        let (terms, minus) = self.program.op(sum)?.terms()?;
        let is_product = |term: &ValueId| {
            self.program.is_inner(*term, &self.uses) && matches!(self.program.op(*term), Some(Op::Mul(..)))
        };
        (terms[0] != terms[1] && terms.iter().all(is_product)).then_some(Products { terms, minus })
    }

    fn ready(&self, value: ValueId) -> u32 {
        self.ready.of(value)
    }

    /// A value that is new, computed here.
    fn add(&mut self, op: Op<ValueId>, beside: ValueId) -> ValueId {
        let operands = op.operands();
        let value = self.program.add(op, beside);
        self.uses.resize(self.program.values.len(), 0);
        self.read(&operands);
        self.compute(value);
        value
    }

    /// Another way to a value that nothing has read yet.
    fn define(&mut self, value: ValueId, op: Op<ValueId>) {
        for operand in self.program.op(value).map(Op::operands).unwrap_or_default() {
            self.uses[operand.index()] -= 1;
        }
        self.read(&op.operands());
        self.program.values[value.index()].definition = Definition::Computed(op);
    }

    fn read(&mut self, operands: &[ValueId]) {
        for operand in operands {
            self.uses[operand.index()] += 1;
        }
    }

    /// Another way to a value, at a later place.
    fn compute_here(&mut self, value: ValueId, op: Op<ValueId>) {
        // It stands a few steps before this one.
        if let Some(place) = self.steps.iter().rposition(|step| matches!(step, Step::Let(other) if *other == value)) {
            self.steps.remove(place);
        }
        self.define(value, op);
        self.compute(value);
    }

    fn compute(&mut self, value: ValueId) {
        self.steps.push(Step::Let(value));
        self.ready.compute(&self.program, value);
        if self.program.value(value).label.is_some() {
            self.remember(value);
        }
    }

    /// A multiple for others to use.
    fn remember(&mut self, value: ValueId) {
        let (number, base) = self.scaled(value);
        if base != value {
            self.multiples.entry(base).or_default().push((number, value));
        }
    }
}
