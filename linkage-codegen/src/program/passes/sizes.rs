//! In which sizes values may be found: each as a power of some factor times as large as it is, where the constants that they are made with
//! take it back. Results, arguments and what is checked have a size of their own.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use crate::graph::number::Number;
use crate::graph::{Graph, Kernel, Op};
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

/// Powers of values, as a rule those that are not zero.
pub(super) type Powers = BTreeMap<ValueId, i32>;

impl Sizes {
    /// Of a program, in which others are read in place of some values: these are not computed. The dividends of
    /// some values stay as they are.
    pub(super) fn of(
        program: &Program,
        graph: &Graph,
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
                Step::Check { guard, weaker, report } => {
                    let reported = report.iter().filter_map(|value| program.op(*value)).flat_map(Op::operands);
                    let guards = [guard].into_iter().chain(weaker);
                    let told = guards.clone().filter_map(|guard| guard.failure.operand());
                    // Whether something is more than nothing is the same in all sizes: factors are positive.
                    let is_nothing = |limit| program.constant(graph, limit).is_some_and(|limit| limit.is_zero());
                    let compared =
                        guards.map(|guard| guard.condition.operands()).filter(|[_, limit]| !is_nothing(*limit));
                    reported.chain(told).chain(compared.flatten()).for_each(|value| sizes.fix(value));
                }
                Step::FiniteInput(_) | Step::FiniteResults(_) => {}
            }
        }
        sizes
    }

    /// Also what must be as it is because of what is read as it is.
    pub(super) fn settled(mut self) -> Self {
        let mut solution = Solution::of(&self);
        solution.open = (0..self.sums.len()).collect();
        // Nothing speaks against all values being as they are.
        let _ = solution.conclude();
        let known: Vec<ValueId> = solution.known.into_keys().collect();
        known.into_iter().for_each(|value| self.fix(value));
        self
    }

    /// Some values stay as they are, with all that they are made of.
    pub(super) fn keep(&mut self, values: impl IntoIterator<Item = ValueId>) {
        let kept = super::reached(values, |value| self.operands[value.index()].clone());
        kept.into_iter().for_each(|value| self.fix(value));
    }

    fn fix(&mut self, value: ValueId) {
        self.fixed[value.index()] = true;
    }

    /// A sum of powers that is zero.
    pub(super) fn equate(&mut self, terms: Vec<(ValueId, i32)>) {
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
            _ if op.operands().into_iter().all(is_constant) => self.fix(value),
            Op::Div(k, a) if is_constant(k) && stays(value) => self.equate(vec![(value, 1), (a, 1)]),
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

    /// The sizes of all values, some being given; nothing if these contradict each other. What they leave open stays as it is, in the
    /// order of the values. All that has nothing to do with what is given another size stays as it is too, and is not looked at.
    pub(super) fn solve(&self, given: &Powers) -> Option<Powers> {
        let stays = |value: ValueId| self.fixed[value.index()] || given.get(&value) == Some(&0);
        let changed = given.iter().filter(|(_, power)| **power != 0).map(|(value, _)| *value);
        let terms = |sum: &usize| self.sums[*sum].iter().map(|(value, _)| *value);
        let beside = |value: ValueId| {
            if stays(value) { Vec::new() } else { self.sums_of[value.index()].iter().flat_map(terms).collect() }
        };
        let near = super::reached(changed, beside);

        let mut solution = Solution::of(self);
        for value in &near {
            if let Some(power) = given.get(value) {
                solution.set(*value, *power)?;
            }
        }
        solution.conclude()?;
        near.iter().try_for_each(|value| solution.stay(*value))?;
        Some(solution.powers())
    }

    /// The same of one value that is found the factor times as large, if that has to do with a few values only, and with no power of the factor
    /// beyond the second: others would make numbers too large or too small of factors that are neither. What is left open stays as it is as is
    /// said.
    pub(super) fn solve_near(&self, value: ValueId, order: Order) -> Option<Powers> {
        let mut solution = Solution { values: 150, power: 2, ..Solution::of(self) };
        solution.set(value, 1)?;
        solution.conclude()?;
        if let Order::LastMade = order {
            while let Some(value) = solution.undecided.pop_last() {
                solution.stay(value)?;
            }
        }
        solution.leave_the_rest()
    }
}

/// Of values that are not decided, which stay as they are first.
#[derive(Clone, Copy)]
pub(super) enum Order {
    /// What others are made of.
    FirstMade,
    /// What is made of others.
    LastMade,
}

/// What is known of the sizes so far. Of a value that nothing known has to do with nothing is said.
struct Solution<'s> {
    sizes: &'s Sizes,
    known: FxHashMap<ValueId, i32>,
    /// Sums of which something new is known.
    open: Vec<usize>,
    /// Values that were met when they were not known.
    undecided: BTreeSet<ValueId>,
    /// How many values may be known, and the highest power.
    values: usize,
    power: i32,
}

impl<'s> Solution<'s> {
    fn of(sizes: &'s Sizes) -> Self {
        let (known, open, undecided) = (FxHashMap::default(), Vec::new(), BTreeSet::new());
        Self { sizes, known, open, undecided, values: usize::MAX, power: i32::MAX }
    }

    fn of_value(&self, value: ValueId) -> Option<i32> {
        if self.sizes.fixed[value.index()] { Some(0) } else { self.known.get(&value).copied() }
    }

    fn set(&mut self, value: ValueId, power: i32) -> Option<()> {
        match self.of_value(value) {
            Some(known) if known != power => return None,
            Some(_) => {}
            None if power.abs() > self.power || self.known.len() >= self.values => return None,
            None => {
                self.known.insert(value, power);
                self.open.extend(&self.sizes.sums_of[value.index()]);
            }
        }
        Some(())
    }

    /// Leaves all as it is that is not decided by then; the powers that are not zero.
    fn leave_the_rest(mut self) -> Option<Powers> {
        while let Some(value) = self.undecided.pop_first() {
            self.leave(value)?;
        }
        Some(self.powers())
    }

    fn powers(self) -> Powers {
        self.known.into_iter().filter(|(_, power)| *power != 0).collect()
    }

    /// Leaves a value as it is, if nothing speaks against it.
    fn stay(&mut self, value: ValueId) -> Option<()> {
        if self.of_value(value).is_none() {
            self.set(value, 0)?;
            self.conclude()?;
        }
        Some(())
    }

    /// The same, and first of all of what it is made of.
    fn leave(&mut self, value: ValueId) -> Option<()> {
        let sizes = self.sizes;
        let mut waiting = vec![(value, false)];
        while let Some((value, operands_are_left)) = waiting.pop() {
            if self.of_value(value).is_some() {
                continue;
            }
            if operands_are_left {
                self.stay(value)?;
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
            let (mut sum, mut unknown) = (0, None);
            let mut several = false;
            for (value, k) in terms {
                match self.of_value(*value) {
                    Some(power) => sum += k * power,
                    None => several |= *unknown.get_or_insert(*value) != *value,
                }
            }
            match unknown {
                None if sum != 0 => return None,
                None => {}
                Some(_) if several => {
                    let unknown = terms.iter().map(|(value, _)| *value);
                    let unknown: Vec<ValueId> = unknown.filter(|value| self.of_value(*value).is_none()).collect();
                    self.undecided.extend(unknown);
                }
                Some(value) => {
                    let k: i32 = terms.iter().filter(|(other, _)| *other == value).map(|(_, k)| k).sum();
                    if k == 0 || sum % k != 0 {
                        return None;
                    }
                    self.set(value, -sum / k)?;
                }
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
    /// By what a value of the power one is multiplied, which is positive.
    pub(super) factor: Number,
    /// The powers.
    pub(super) powers: Powers,
}

impl Scale {
    /// The values of another size, and what reads them: where constants change.
    pub(super) fn touched(&self, readers: &[Vec<ValueId>]) -> BTreeSet<ValueId> {
        self.powers.keys().flat_map(|value| readers[value.index()].iter().chain([value])).copied().collect()
    }

    pub(super) fn power(&self, value: ValueId) -> i32 {
        self.powers.get(&value).copied().unwrap_or(0)
    }

    /// What a constant becomes, if it changes.
    pub(super) fn of(&self, Constant { number, powers, .. }: &Constant) -> Option<Number> {
        let exponent: i32 = powers.iter().map(|(value, k)| k * self.power(*value)).sum();
        let power = self.factor.pow(exponent.unsigned_abs());
        match exponent {
            0 => None,
            ..0 => number.div(&power),
            _ => Some(number.mul(&power)),
        }
    }
}

/// The constant of an operation.
#[derive(Clone)]
pub(super) struct Constant {
    /// Its place.
    pub(super) value: ValueId,
    pub(super) number: Number,
    /// The sum of powers by which it is multiplied, so that the result has the size that is asked of it.
    pub(super) powers: Vec<(ValueId, i32)>,
}

impl Constant {
    /// That of an operation that has one.
    pub(super) fn of(program: &Program, graph: &Graph, value: ValueId) -> Option<Self> {
        let is_constant = |value: ValueId| is_constant(program, value);
        let op = program.op(value)?;
        if op.operands().into_iter().all(is_constant) {
            return None;
        }
        let (constant, powers) = match *op {
            Op::Mul(k, a) | Op::Mul(a, k) if is_constant(k) => (k, vec![(a, -1), (value, 1)]),
            Op::Div(k, a) if is_constant(k) => (k, vec![(a, 1), (value, 1)]),
            Op::Div(a, k) if is_constant(k) => (k, vec![(a, 1), (value, -1)]),
            Op::Add(k, _) | Op::Add(_, k) | Op::Sub(k, _) | Op::Sub(_, k) if is_constant(k) => (k, vec![(value, 1)]),
            _ => return None,
        };
        Some(Self { value: constant, number: program.constant(graph, constant)?, powers })
    }
}

/// Operations get other constants; a product with one is its other factor then, with minus one the negative of it. What others are read in
/// place of is left out.
pub(super) fn exchange(
    program: &mut Program,
    graph: &Graph,
    constants: &BTreeMap<ValueId, Constant>,
    mut replaced: BTreeMap<ValueId, ValueId>,
) {
    for step in core::mem::take(&mut program.steps) {
        if let Step::Let(value) = step {
            if replaced.contains_key(&value) {
                continue;
            }
            if let Some(constant) = constants.get(&value)
                && let Some(op) = program.op(value).cloned()
            {
                let op = match factor_beside(&op, constant) {
                    Some(rest) if constant.number.is_one() => {
                        let rest = replaced.get(&rest).copied().unwrap_or(rest);
                        replaced.values_mut().filter(|other| **other == value).for_each(|other| *other = rest);
                        replaced.insert(value, rest);
                        continue;
                    }
                    Some(rest) => Op::Neg(rest),
                    None => {
                        let own = program.add_constant(graph, &constant.number, value);
                        op.map(|operand| if operand == constant.value { own } else { operand })
                    }
                };
                program.values[value.index()].definition = Definition::Computed(op);
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

/// The other factor of a product with one or minus one.
pub(super) fn factor_beside(op: &Op<ValueId>, constant: &Constant) -> Option<ValueId> {
    let is_left_out = matches!(op, Op::Mul(..)) && constant.number.abs().is_one();
    op.operands().into_iter().find(|operand| is_left_out && *operand != constant.value)
}
