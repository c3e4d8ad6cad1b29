//! Constant factors are brought together: `(k₁ x)(k₂ y) = (k₁k₂)(x y)`, `k (a x ± b y) = (ka) x ± (kb) y`, and `k ((a x)/y) = ((ka) x)/y`,
//! where nothing else reads the inner values. The constants are multiplied exactly and rounded once, and go to a reciprocal where there
//! is one.

use std::collections::BTreeMap;

use crate::graph::number::Number;
use crate::graph::{Graph, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn merge(program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let mut merging = Merging { uses, graph, before: BTreeMap::new(), program };
    let order: Vec<ValueId> = merging
        .program
        .steps
        .iter()
        .filter_map(|step| if let Step::Let(value) = step { Some(*value) } else { None })
        .collect();
    for value in order {
        merging.value(value);
    }
    merging.finish()
}

/// `k (x (1/y))` as `x (k (1/y))`: the reciprocal is known before x, which then waits for one product less.
pub(super) fn multiply_reciprocals(mut program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let is_reciprocal = |program: &Program, value: ValueId| match program.op(value) {
        Some(Op::Div(one, _)) => program.constant(graph, *one).is_some_and(|one| one.is_one()),
        _ => false,
    };
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

struct Merging<'g> {
    program: Program,
    graph: &'g Graph,
    uses: Vec<usize>,
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
        match self.program.op(value)? {
            Op::Mul(k, x) => Some((self.constant(*k)?, *x)),
            _ => None,
        }
    }

    fn value(&mut self, value: ValueId) {
        let Some(op) = self.program.op(value).cloned() else { return };
        match op {
            Op::Mul(a, b) if self.constant(a).is_none() => self.product(value, a, b),
            Op::Mul(k, x) => {
                let Some(k) = self.constant(k) else { return };
                self.constant_times(value, &k, x);
            }
            _ => {}
        }
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
        if let Some(constant) = self.constant(term) {
            return Some(self.number(before, &k.mul(&constant)));
        }
        if !self.is_inner(term) {
            return None;
        }
        let (inner, rest) = self.scaled(term)?;
        let product = k.mul(&inner);
        let factor = self.number(before, &product);
        Some(self.add(before, Op::Mul(factor, rest)))
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
