//! In which sizes values may be found: each as a power of some factor times as large as it is, where the constants that they are made with
//! take it back. Results, arguments and what is checked have a size of their own.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::number::Number;
use crate::graph::{Graph, Kernel, Label, Op};
use crate::program::{Definition, Program, Step, ValueId};

/// How the sizes of values go with each other, as powers of one and the same factor.
///
/// Every operation but those with constants says how the size of its result goes with those of its operands.
pub(super) struct Sizes {
    /// Sums of powers, each with its number, that are zero.
    sums: Vec<Vec<(ValueId, i32)>>,
    /// The sums in which each value is.
    sums_of: Vec<Vec<usize>>,
    /// Whether a value is read as it is: the power zero.
    fixed: Vec<bool>,
    /// Of what each value is made, but constants.
    operands: Vec<Vec<ValueId>>,
}

/// The powers that are not zero.
pub(super) type Powers = BTreeMap<ValueId, i32>;

impl Sizes {
    /// Of a program, in which others are read in place of some values: these are not computed. Some dividends stay as they are.
    pub(super) fn of(
        program: &Program,
        replaced: &BTreeMap<ValueId, ValueId>,
        stays: &dyn Fn(ValueId) -> bool,
    ) -> Self {
        let count = program.values.len();
        let (sums_of, operands) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let mut sizes = Self { sums: Vec::new(), sums_of, fixed: vec![false; count], operands };
        program.inputs().for_each(|(value, _)| sizes.fix(value));
        program.outputs.iter().for_each(|(_, value)| sizes.fix(*value));
        replaced.values().for_each(|value| sizes.fix(*value));
        for step in &program.steps {
            match step {
                Step::Let(value) if replaced.contains_key(value) => {}
                Step::Let(value) => sizes.state(program, *value, stays),
                Step::Check { report, .. } => {
                    let computed = report.iter().filter_map(|value| program.op(*value)).flat_map(Op::operands);
                    computed.chain(program.operands_of(step)).for_each(|value| sizes.fix(value));
                }
                Step::FiniteInput(_) | Step::FiniteResults(_) => {}
            }
        }
        sizes.fix_what_follows();
        sizes
    }

    /// What must be as it is because of what is read as it is.
    fn fix_what_follows(&mut self) {
        let mut solution = Solution::of(self);
        solution.open = (0..self.sums.len()).collect();
        // Nothing speaks against all values being as they are.
        let _ = solution.conclude();
        let known: Vec<ValueId> = solution.known.into_keys().collect();
        known.into_iter().for_each(|value| self.fix(value));
    }

    fn fix(&mut self, value: ValueId) {
        self.fixed[value.index()] = true;
    }

    fn equate(&mut self, terms: Vec<(ValueId, i32)>) {
        for (value, _) in &terms {
            self.sums_of[value.index()].push(self.sums.len());
        }
        self.sums.push(terms);
    }

    fn state(&mut self, program: &Program, value: ValueId, stays: &dyn Fn(ValueId) -> bool) {
        let Some(op) = program.op(value) else { return };
        let is_constant = |value: ValueId| is_constant(program, value);
        let is_computed = |value: &ValueId| !is_constant(*value);
        self.operands[value.index()] = op.operands().into_iter().filter(is_computed).collect();
        match *op {
            // A constant in it takes whatever is asked.
            Op::Constant(_) => {}
            Op::Div(k, a) if is_constant(k) && stays(k) => self.equate(vec![(value, 1), (a, 1)]),
            Op::Mul(a, b) | Op::Div(a, b) if is_constant(a) || is_constant(b) => {}
            Op::Mul(a, b) => self.equate(vec![(value, 1), (a, -1), (b, -1)]),
            Op::Div(a, b) => self.equate(vec![(value, 1), (a, -1), (b, 1)]),
            Op::Sqrt(a) if is_computed(&a) => self.equate(vec![(value, 2), (a, -1)]),
            Op::Neg(_) | Op::Abs(_) | Op::NonNegative(_) | Op::Add(..) | Op::Sub(..) => {
                op.operands().into_iter().filter(is_computed).for_each(|a| self.equate(vec![(value, 1), (a, -1)]));
            }
            // An angle, and what is brought to unit size, are the same in all sizes of both components.
            Op::Kernel { kernel: Kernel::Atan2 | Kernel::Unit, ref args, .. } if args.iter().all(is_computed) => {
                self.fix(value);
                args.windows(2).for_each(|pair| self.equate(vec![(pair[0], 1), (pair[1], -1)]));
            }
            _ => op.operands().into_iter().filter(is_computed).chain([value]).for_each(|value| self.fix(value)),
        }
    }

    /// The sizes of all values, some being given; nothing if these contradict each other. What they leave open stays as it is, first of all these
    /// values in their order, then what is computed first before what is made of it.
    pub(super) fn solve(
        &self,
        given: impl IntoIterator<Item = (ValueId, i32)>,
        first_of_all: &[ValueId],
    ) -> Option<Powers> {
        let mut solution = Solution::of(self);
        for (value, power) in given {
            solution.set(value, power)?;
        }
        solution.conclude()?;
        first_of_all.iter().try_for_each(|value| solution.leave(*value))?;
        while let Some(value) = solution.undecided.pop_first() {
            solution.leave(value)?;
        }
        solution.known.retain(|_, power| *power != 0);
        Some(solution.known)
    }
}

/// What is known of the sizes so far. Of a value that nothing known has to do with nothing is said.
struct Solution<'s> {
    sizes: &'s Sizes,
    known: Powers,
    /// Sums of which something new is known.
    open: Vec<usize>,
    /// Values that were met when they were not known.
    undecided: BTreeSet<ValueId>,
}

impl<'s> Solution<'s> {
    fn of(sizes: &'s Sizes) -> Self {
        Self { sizes, known: BTreeMap::new(), open: Vec::new(), undecided: BTreeSet::new() }
    }

    fn power(&self, value: ValueId) -> Option<i32> {
        if self.sizes.fixed[value.index()] { Some(0) } else { self.known.get(&value).copied() }
    }

    fn set(&mut self, value: ValueId, power: i32) -> Option<()> {
        match self.power(value) {
            Some(known) if known != power => return None,
            Some(_) => {}
            None => {
                self.known.insert(value, power);
                self.open.extend(&self.sizes.sums_of[value.index()]);
            }
        }
        Some(())
    }

    /// Leaves a value as it is, if nothing speaks against it, and first of all what it is made of.
    fn leave(&mut self, value: ValueId) -> Option<()> {
        let sizes = self.sizes;
        let mut waiting = vec![(value, false)];
        while let Some((value, operands_are_left)) = waiting.pop() {
            if self.power(value).is_some() {
                continue;
            }
            if operands_are_left {
                self.set(value, 0)?;
                self.conclude()?;
            } else {
                waiting.push((value, true));
                waiting.extend(sizes.operands[value.index()].iter().rev().map(|operand| (*operand, false)));
            }
        }
        Some(())
    }

    /// Goes through sums of which something new is known, and those of what follows from them; nothing where they contradict each other.
    fn conclude(&mut self) -> Option<()> {
        let sizes = self.sizes;
        while let Some(index) = self.open.pop() {
            let terms = &sizes.sums[index];
            let sum: i32 = terms.iter().filter_map(|(value, k)| Some(k * self.power(*value)?)).sum();
            let unknown: BTreeSet<ValueId> =
                terms.iter().map(|(value, _)| *value).filter(|value| self.power(*value).is_none()).collect();
            let mut unknowns = unknown.iter();
            match (unknowns.next(), unknowns.next()) {
                (None, _) if sum != 0 => return None,
                (None, _) => {}
                (Some(value), None) => {
                    let k: i32 = terms.iter().filter(|(other, _)| other == value).map(|(_, k)| k).sum();
                    if k == 0 || sum % k != 0 {
                        return None;
                    }
                    self.set(*value, -sum / k)?;
                }
                _ => self.undecided.extend(unknown),
            }
        }
        Some(())
    }
}

fn is_constant(program: &Program, value: ValueId) -> bool {
    matches!(program.op(value), Some(Op::Constant(_)))
}

/// A factor, and the sizes of values as powers of it.
pub(super) struct Scale {
    /// By what a value of the power one is multiplied.
    pub(super) factor: Number,
    /// The powers.
    pub(super) powers: Powers,
}

impl Scale {
    fn power(&self, value: ValueId) -> i32 {
        self.powers.get(&value).copied().unwrap_or(0)
    }
}

/// Finds values in their sizes, where constants take it back; a product with a constant that is one then is its other factor, or the negative of
/// it. The names of others change as is said.
pub(super) fn resize(
    program: &mut Program,
    graph: &Graph,
    scales: &[Scale],
    mut replaced: BTreeMap<ValueId, ValueId>,
    renamed: impl Fn(usize, &Label, i32) -> Label,
) {
    for step in core::mem::take(&mut program.steps) {
        if let Step::Let(value) = step {
            if replaced.contains_key(&value) {
                continue;
            }
            if let Some((constant, number)) = rescaled(program, graph, scales, value)
                && let Some(op) = program.op(value).cloned()
            {
                let product_with_one = if matches!(op, Op::Mul(..)) && number.abs().is_one() {
                    other_operand(&op, constant)
                } else {
                    None
                };
                let op = match product_with_one {
                    Some(rest) if number.is_one() => {
                        replaced.insert(value, replaced.get(&rest).copied().unwrap_or(rest));
                        continue;
                    }
                    Some(rest) => Op::Neg(rest),
                    None => {
                        let own = program.add_constant(graph, &number, value);
                        op.map(|operand| if operand == constant { own } else { operand })
                    }
                };
                program.values[value.index()].definition = Definition::Computed(op);
            }
            if let Some(label) = &mut program.values[value.index()].label {
                for (index, scale) in scales.iter().enumerate() {
                    *label = renamed(index, label, scale.power(value));
                }
            }
        }
        let step = program.reading(step, &replaced);
        program.steps.push(step);
    }
    for component in program.values.iter_mut().filter_map(|value| value.component.as_mut()) {
        component.arm = component.arm.map(|arm| replaced.get(&arm).copied().unwrap_or(arm));
    }
    program.rename_results(&replaced);
}

/// The operand of a product that is not the constant.
pub(super) fn other_operand(op: &Op<ValueId>, constant: ValueId) -> Option<ValueId> {
    op.operands().into_iter().find(|operand| *operand != constant)
}

/// The constant that an operation has, and what it becomes, if it changes.
pub(super) fn rescaled(
    program: &Program,
    graph: &Graph,
    scales: &[Scale],
    value: ValueId,
) -> Option<(ValueId, Number)> {
    let (constant, powers) = constant_of(program, value)?;
    let mut number = None;
    for scale in scales {
        let exponent: i32 = powers.iter().map(|(value, k)| k * scale.power(*value)).sum();
        if exponent != 0 {
            let power = scale.factor.pow(exponent.unsigned_abs());
            let before = number.map_or_else(|| program.constant(graph, constant), Some)?;
            number = Some(if exponent < 0 { before.div(&power)? } else { before.mul(&power) });
        }
    }
    Some((constant, number?))
}

/// The constant that an operation has, and the sum of powers by which it is multiplied, so that the result has the size that is asked of it.
fn constant_of(program: &Program, value: ValueId) -> Option<(ValueId, Vec<(ValueId, i32)>)> {
    let is_constant = |value: ValueId| is_constant(program, value);
    match *program.op(value)? {
        Op::Mul(k, a) | Op::Mul(a, k) if is_constant(k) => Some((k, vec![(a, -1), (value, 1)])),
        Op::Div(k, a) if is_constant(k) => Some((k, vec![(a, 1), (value, 1)])),
        Op::Div(a, k) if is_constant(k) => Some((k, vec![(a, 1), (value, -1)])),
        Op::Add(k, _) | Op::Add(_, k) | Op::Sub(k, _) | Op::Sub(_, k) if is_constant(k) => Some((k, vec![(value, 1)])),
        _ => None,
    }
}
