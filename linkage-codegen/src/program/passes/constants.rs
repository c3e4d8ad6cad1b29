//! Constant factors are brought together: `(k₁ x)(k₂ y) = (k₁k₂)(x y)`, `k (a x ± b y) = (ka) x ± (kb) y`, `k ((a x)/y) = ((ka) x)/y` and
//! `(a x)/(k y) = ((a/k) x)/y`, where nothing else reads the inner values. The constants are multiplied exactly and rounded once, and go
//! to a quotient of a constant where there is one. At last, when factors have found their places, those of products go into sums.

use std::collections::BTreeMap;

use super::cycles::is_side;
use crate::graph::number::Number;
use crate::graph::{Graph, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn merge(program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let reads = reads(&program);
    let mut merging = Merging { uses, reads, graph, before: BTreeMap::new(), program };
    let order: Vec<ValueId> = merging.program.computed().collect();
    for value in order {
        merging.value(value);
    }
    merging.finish()
}

/// Sums, products and quotients of constants are constants, which are rounded once, and a check that they pass is none. Graphs have none; factors
/// that are taken out of sums leave some, and so do constants that hang on a condition. One that is read stays a line of the derivation if it has a
/// name.
pub(super) fn fold(mut program: Program, graph: &Graph) -> Program {
    if program.counts_rounding {
        return program;
    }
    for step in core::mem::take(&mut program.steps) {
        let number = |value: ValueId| program.constant(graph, value);
        match step {
            Step::Let(value) => {
                let Some(op) = program.op(value).cloned() else { continue };
                if let Some(number) = constant(&op, number) {
                    let number = graph.intern_number(&number);
                    program.values[value.index()].definition = Definition::Computed(Op::Constant(number));
                    if program.value(value).label.is_none() {
                        continue;
                    }
                } else if let Op::Mul(x, k) = op
                    && number(k).is_some()
                    && number(x).is_none()
                {
                    program.values[value.index()].definition = Definition::Computed(Op::Mul(k, x));
                }
            }
            Step::Check { ref guard, .. } => {
                if let [Some(value), Some(limit)] = guard.condition.operands().map(number)
                    && guard.condition.holds(&value, &limit)
                {
                    continue;
                }
            }
            Step::FiniteInput(_) | Step::FiniteResults(_) => {}
        }
        program.steps.push(step);
    }
    super::unused::remove(program, graph)
}

/// What an operation makes of constants alone.
fn constant(op: &Op<ValueId>, number: impl Fn(ValueId) -> Option<Number>) -> Option<Number> {
    match *op {
        Op::Neg(a) => Some(number(a)?.neg()),
        Op::Abs(a) => Some(number(a)?.abs()),
        Op::Add(a, b) => Some(number(a)?.add(&number(b)?)),
        Op::Sub(a, b) => Some(number(a)?.sub(&number(b)?)),
        Op::Mul(a, b) => Some(number(a)?.mul(&number(b)?)),
        Op::Div(a, b) => number(a)?.div(&number(b)?),
        _ => None,
    }
}

/// How often each value is read by others than checks.
fn reads(program: &Program) -> Vec<usize> {
    let values =
        program.steps.iter().filter_map(|step| if let Step::Let(value) = step { program.op(*value) } else { None });
    let operands = values.filter(|op| !matches!(op, Op::Abs(_))).flat_map(Op::operands);
    let mut reads = vec![0; program.values.len()];
    for value in operands.chain(program.outputs.iter().map(|(_, value)| *value)) {
        reads[value.index()] += 1;
    }
    reads
}

/// `k (x (c/y))` as `x (k (c/y))`, c a constant: the quotient is known before x, which then waits for one product less.
pub(super) fn multiply_reciprocals(mut program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let is_reciprocal = |program: &Program, value: ValueId| program.quotient(graph, value).is_some();
    for index in 0..program.steps.len() {
        if let Step::Let(value) = program.steps[index]
            && let Some(Op::Mul(k, rest)) = program.op(value).cloned()
            && program.constant(graph, k).is_some()
            && program.is_inner(rest, &uses)
            && let Some(Op::Mul(x, y)) = program.op(rest).cloned()
            && is_reciprocal(&program, y)
        {
            program.values[rest.index()].definition = Definition::Computed(Op::Mul(k, y));
            program.values[value.index()].definition = Definition::Computed(Op::Mul(x, rest));
        }
    }
    program
}

/// `k (x (a y ± b z))` as `x ((ka) y ± (kb) z)`, however many products and sums are in between, where nothing else reads them.
///
/// Of `ka` and `kb` it may be much more that is rounded than of a and b, which errors that are counted would have to know.
pub(super) fn multiply_into_sums(program: Program, graph: &Graph) -> Program {
    if program.counts_rounding {
        return program;
    }
    let uses = program.uses();
    let mut merging = Merging { reads: Vec::new(), uses, graph, before: BTreeMap::new(), program };
    for index in 0..merging.program.steps.len() {
        if let Step::Let(value) = merging.program.steps[index] {
            merging.multiply_sum(value);
        }
    }
    super::unused::remove(merging.finish(), graph)
}

struct Merging<'g> {
    program: Program,
    graph: &'g Graph,
    uses: Vec<usize>,
    /// How often each is read by other values and as a result, not counting checks and absolute values, which are for them.
    reads: Vec<usize>,
    /// New values, with the old one before which each is computed.
    before: BTreeMap<ValueId, Vec<ValueId>>,
}

impl Merging<'_> {
    fn constant(&self, value: ValueId) -> Option<Number> {
        self.program.constant(self.graph, value)
    }

    fn is_inner(&self, value: ValueId) -> bool {
        self.program.is_inner(value, &self.uses)
    }

    /// A product with a constant: the constant and the rest.
    fn scaled(&self, value: ValueId) -> Option<(Number, ValueId)> {
        self.program.multiple(self.graph, value)
    }

    fn value(&mut self, value: ValueId) {
        let Some(op) = self.program.op(value).cloned() else { return };
        match op {
            Op::Mul(a, b) if self.constant(a).is_none() => self.product(value, a, b),
            Op::Mul(k, x) => {
                let Some(k) = self.constant(k) else { return };
                self.constant_times(value, &k, x);
            }
            // Whether a check reads it too may depend on when a side is given: bits do not.
            Op::Div(dividend, divisor) if self.reads.get(divisor.index()) == Some(&1) => {
                if let Some((k, rest)) = self.multiple_within(divisor)
                    && let Some(dividend) = self.divided(value, &k, dividend)
                {
                    let divisor = rest.unwrap_or_else(|op| self.add(value, op));
                    self.program.values[value.index()].definition = Definition::Computed(Op::Div(dividend, divisor));
                }
            }
            _ => {}
        }
    }

    /// The constant of a multiple, perhaps of either sign: beside it what is left, or the operation that leads to it.
    fn multiple_within(&self, value: ValueId) -> Option<(Number, Result<ValueId, Op<ValueId>>)> {
        if let Some((k, rest)) = self.scaled(value) {
            return Some((k, Ok(rest)));
        }
        let within = |inner: ValueId| if self.is_read_once(inner) { self.scaled(inner) } else { None };
        match *self.program.op(value)? {
            Op::Neg(inner) => within(inner).map(|(k, rest)| (k, Err(Op::Neg(rest)))),
            Op::Mul(side, inner) if is_side(&self.program, side) => {
                within(inner).map(|(k, rest)| (k, Err(Op::Mul(side, rest))))
            }
            _ => None,
        }
    }

    /// `x/k` for an x that is a constant or has a constant factor, which takes no operation more.
    fn divided(&mut self, before: ValueId, k: &Number, x: ValueId) -> Option<ValueId> {
        if let Some(constant) = self.constant(x) {
            return Some(self.number(before, &constant.div(k)?));
        }
        if !self.is_read_once(x) {
            return None;
        }
        if let Some((own, rest)) = self.scaled(x) {
            let quotient = own.div(k)?;
            return Some(if quotient.is_one() {
                rest
            } else if quotient.neg().is_one() {
                self.another(x, Op::Neg(rest))
            } else {
                let factor = self.number(before, &quotient);
                self.another(x, Op::Mul(factor, rest))
            });
        }
        let op = match self.program.op(x).cloned()? {
            Op::Neg(a) => Op::Neg(self.divided(before, k, a)?),
            Op::Mul(side, a) if is_side(&self.program, side) => Op::Mul(side, self.divided(before, k, a)?),
            Op::Mul(a, b) if self.is_inner(x) => {
                [(a, b), (b, a)].into_iter().find_map(|(a, b)| Some(Op::Mul(self.divided(before, k, a)?, b)))?
            }
            _ => return None,
        };
        Some(self.another(x, op))
    }

    /// Another value in the place of one that nothing else reads, so without its name.
    fn another(&mut self, value: ValueId, op: Op<ValueId>) -> ValueId {
        let own = &mut self.program.values[value.index()];
        (own.definition, own.label) = (Definition::Computed(op), None);
        value
    }

    fn is_read_once(&self, value: ValueId) -> bool {
        self.uses.get(value.index()) == Some(&1)
    }

    /// Takes constants out of both factors.
    fn product(&mut self, value: ValueId, a: ValueId, b: ValueId) {
        let inner = |s: &Self, v| if s.is_inner(v) { s.scaled(v) } else { None };
        let (left, right) = (inner(self, a), inner(self, b));
        if left.is_none() && right.is_none() {
            return;
        }
        let (ka, x) = left.unwrap_or((Number::one(), a));
        let (kb, y) = right.unwrap_or((Number::one(), b));
        let rest = self.add(value, Op::Mul(x, y));
        self.constant_times(value, &ka.mul(&kb), rest);
    }

    /// `value := k x`, the constant merged with those in x.
    fn constant_times(&mut self, value: ValueId, k: &Number, x: ValueId) {
        if self.is_inner(x) {
            if let Some((inner, rest)) = self.scaled(x) {
                return self.constant_times(value, &k.mul(&inner), rest);
            }
            let merged = match self.program.op(x).cloned() {
                // The place of the quotient is taken by what is divided: both are known then.
                Some(Op::Div(of, by)) if self.is_inner(of) => self.multiple(x, k, of).map(|multiple| {
                    self.program.values[x.index()].definition = Definition::Computed(multiple);
                    Op::Div(x, by)
                }),
                _ => self.multiple_of_terms(value, k, x),
            };
            if let Some(op) = merged {
                self.program.values[value.index()].definition = Definition::Computed(op);
                return;
            }
        }
        let k = self.number(value, k);
        self.program.values[value.index()].definition = Definition::Computed(Op::Mul(k, x));
    }

    /// `(ka) x`, if x is `a x`, or the same of its terms.
    fn multiple(&mut self, before: ValueId, k: &Number, x: ValueId) -> Option<Op<ValueId>> {
        match self.scaled(x) {
            Some((inner, rest)) => Some(Op::Mul(self.number(before, &k.mul(&inner)), rest)),
            None => self.multiple_of_terms(before, k, x),
        }
    }

    /// `(ka) x ± (kb) y`, if x is `a x ± b y`.
    fn multiple_of_terms(&mut self, before: ValueId, k: &Number, x: ValueId) -> Option<Op<ValueId>> {
        let ([a, b], minus) = self.program.op(x)?.terms()?;
        Some(Op::of_terms([self.rescaled(before, k, a)?, self.rescaled(before, k, b)?], minus))
    }

    /// A constant, or a constant multiple that nothing else reads, times `k`.
    fn rescaled(&mut self, before: ValueId, k: &Number, term: ValueId) -> Option<ValueId> {
        let takes = self.constant(term).is_some() || self.is_inner(term) && self.scaled(term).is_some();
        takes.then(|| self.factor(before, k, term))
    }

    /// Multiplies the constant of a product into those that its other factor has.
    fn multiply_sum(&mut self, product: ValueId) {
        let Some(Op::Mul(a, b)) = self.program.op(product).cloned() else { return };
        for (with, sum) in [(a, b), (b, a)] {
            let Some(op) = self.program.op(sum).filter(|_| self.takes(sum)).cloned() else { continue };
            let op = match (self.constant(with), self.is_inner(with).then(|| self.scaled(with)).flatten()) {
                (Some(k), _) => self.multiplied(product, &k, op),
                (None, Some((k, rest))) => {
                    let op = self.multiplied(product, &k, op);
                    Op::Mul(rest, self.add(product, op))
                }
                (None, None) => continue,
            };
            self.program.values[product.index()].definition = Definition::Computed(op);
            return;
        }
    }

    /// Whether a value that nothing else reads has constants in all its terms, of which a multiple has others.
    fn takes(&self, value: ValueId) -> bool {
        let of = |value: &ValueId| self.constant(*value).is_some() || self.takes(*value);
        self.is_inner(value)
            && match self.program.op(value) {
                Some(Op::Neg(a)) => of(a),
                Some(Op::Mul(a, b)) => of(a) || of(b),
                Some(Op::Add(a, b) | Op::Sub(a, b)) => of(a) && of(b),
                _ => false,
            }
    }

    /// The multiple of what takes the factor.
    fn multiplied(&mut self, before: ValueId, k: &Number, op: Op<ValueId>) -> Op<ValueId> {
        match op {
            Op::Mul(a, b) if self.constant(a).is_some() || self.takes(a) => Op::Mul(self.factor(before, k, a), b),
            Op::Mul(a, b) => Op::Mul(a, self.factor(before, k, b)),
            sum => sum.map(|term| self.factor(before, k, term)),
        }
    }

    /// `k` times a constant, or a value that takes it.
    fn factor(&mut self, before: ValueId, k: &Number, value: ValueId) -> ValueId {
        match (self.program.op(value).cloned(), self.scaled(value)) {
            (_, Some((own, rest))) if k.mul(&own).is_one() => rest,
            (Some(Op::Constant(own)), _) => self.number(before, &k.mul(&self.graph.number(own))),
            (Some(op), _) => {
                let op = self.multiplied(before, k, op);
                self.add(before, op)
            }
            (None, _) => value,
        }
    }

    fn number(&mut self, before: ValueId, number: &Number) -> ValueId {
        let id = self.program.add_constant(self.graph, number, before);
        self.uses.resize(self.program.values.len(), 1);
        id
    }

    fn add(&mut self, before: ValueId, op: Op<ValueId>) -> ValueId {
        let id = self.program.add(op, before);
        self.uses.resize(self.program.values.len(), 1);
        self.before.entry(before).or_default().push(id);
        id
    }

    fn finish(mut self) -> Program {
        let mut steps = Vec::new();
        for step in core::mem::take(&mut self.program.steps) {
            if let Step::Let(value) = &step {
                steps.extend(self.before.remove(value).unwrap_or_default().into_iter().map(Step::Let));
            }
            steps.push(step);
        }
        self.program.steps = steps;
        self.program
    }
}
