//! Directions that are no results keep the lengths of their links: `u = v/r` is not brought to unit size, where `v` has the constant length r
//! but for a few roundings, and it is `v` that is read.
//!
//! A value that reads u is then found `r`, `r²`, … times as large or as small, which the constants in it take back: those of products with
//! loads and weights, of quotients, of other lengths. In powers of r, every operation but those with constants says how the size of its
//! result goes with those of its operands, results and checks have a size of their own; what follows of this is one system of equations. Where
//! it has no solution, u is v times the constant `1/r`.
//!
//! Not where rounding errors are counted, which would have to know of it.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::number::Number;
use crate::graph::{Component, Graph, Kernel, Label, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn leave(mut program: Program, graph: &Graph) -> Program {
    if graph.counts_rounding() {
        return program;
    }
    let mut divided = 0;
    while let Some(direction) = directions(&program).into_iter().nth(divided) {
        match Sizes::of(&program, graph, &direction).solve() {
            // It is no more.
            Some(sizes) => resize(&mut program, graph, &direction, &sizes),
            None => {
                divide(&mut program, graph, &direction);
                divided += 1;
            }
        }
    }
    super::unused::remove(program, graph)
}

/// A direction: its components, each with that of the vector along the link.
struct Direction {
    arms: BTreeMap<ValueId, ValueId>,
    /// The reciprocal of the link's length.
    reciprocal: Number,
    /// The length, as text.
    length: String,
}

/// The directions of which no component is a result.
fn directions(program: &Program) -> Vec<Direction> {
    let mut directions: Vec<Direction> = Vec::new();
    for step in &program.steps {
        if let Step::Let(value) = step
            && let Some(Component { arm, reciprocal, length }) = &program.value(*value).component
        {
            match directions.iter_mut().find(|direction| direction.length == *length) {
                Some(direction) => drop(direction.arms.insert(*value, *arm)),
                None => directions.push(Direction {
                    arms: BTreeMap::from([(*value, *arm)]),
                    reciprocal: reciprocal.clone(),
                    length: length.clone(),
                }),
            }
        }
    }
    let is_result = |value: &ValueId| program.outputs.iter().any(|(_, output)| output == value);
    directions.retain(|direction| !direction.arms.keys().any(is_result));
    directions
}

/// In powers of r, how much smaller each value is found than it is: one for the components of the direction.
struct Sizes<'a> {
    known: Vec<Option<i32>>,
    /// Sums of powers, each with its factor, that are zero.
    equations: Vec<Vec<(ValueId, i32)>>,
    program: &'a Program,
}

impl<'a> Sizes<'a> {
    fn of(program: &'a Program, graph: &Graph, direction: &Direction) -> Self {
        let mut sizes = Self { known: vec![None; program.values.len()], equations: Vec::new(), program };
        for (value, _) in program.inputs() {
            sizes.known[value.index()] = Some(0);
        }
        for (_, value) in &program.outputs {
            sizes.fix(*value);
        }
        for step in &program.steps {
            match step {
                Step::Let(value) if direction.arms.contains_key(value) => sizes.known[value.index()] = Some(1),
                Step::Let(value) => {
                    sizes.state(graph, *value);
                    // What is known of other directions goes on to hold.
                    if let Some(Component { arm, .. }) = program.value(*value).component {
                        sizes.fix(*value);
                        sizes.fix(arm);
                    }
                }
                Step::Check { report, .. } => {
                    let computed = report.iter().filter_map(|value| program.op(*value)).flat_map(Op::operands);
                    computed.chain(program.operands_of(step)).for_each(|value| sizes.fix(value));
                }
                Step::FiniteInput(_) | Step::FiniteResults(_) => {}
            }
        }
        sizes
    }

    /// What is read as it is.
    fn fix(&mut self, value: ValueId) {
        self.equations.push(vec![(value, 1)]);
    }

    fn state(&mut self, graph: &Graph, value: ValueId) {
        let program = self.program;
        let Some(op) = program.op(value) else { return };
        let is_constant = |value: ValueId| program.constant(graph, value).is_some();
        let mut equal = |operands: &[ValueId]| {
            for operand in operands.iter().filter(|operand| !is_constant(**operand)) {
                self.equations.push(vec![(value, 1), (*operand, -1)]);
            }
        };
        match *op {
            // A constant in it takes whatever is asked.
            Op::Constant(_) => {}
            Op::Mul(a, b) | Op::Div(a, b) if is_constant(a) || is_constant(b) => {}
            Op::Mul(a, b) => self.equations.push(vec![(value, 1), (a, -1), (b, -1)]),
            Op::Div(a, b) => self.equations.push(vec![(value, 1), (a, -1), (b, 1)]),
            // An angle, and what is brought to unit size, are the same in all sizes.
            Op::Kernel { kernel: Kernel::Atan2 | Kernel::Unit, ref args, .. } => {
                self.fix(value);
                if let [a, b] = args[..]
                    && !is_constant(a)
                    && !is_constant(b)
                {
                    self.equations.push(vec![(a, 1), (b, -1)]);
                } else {
                    args.iter().filter(|arg| !is_constant(**arg)).for_each(|arg| self.fix(*arg));
                }
            }
            Op::Neg(a) | Op::Abs(a) | Op::NonNegative(a) => equal(&[a]),
            Op::Add(a, b) | Op::Sub(a, b) => equal(&[a, b]),
            _ => op.operands().into_iter().chain([value]).for_each(|value| {
                if !is_constant(value) {
                    self.fix(value);
                }
            }),
        }
    }

    /// The powers, if there are any that fulfil all equations. What these leave open stays as it is.
    fn solve(mut self) -> Option<Vec<i32>> {
        let order: Vec<ValueId> = self
            .program
            .steps
            .iter()
            .filter_map(|step| if let Step::Let(value) = step { Some(*value) } else { None })
            .collect();
        let mut open = order.into_iter();
        loop {
            while self.conclude()? {}
            let Some(value) = open.find(|value| self.known[value.index()].is_none()) else { break };
            self.known[value.index()] = Some(0);
        }
        Some(self.known.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Whether another power is found; nothing where equations contradict each other.
    fn conclude(&mut self) -> Option<bool> {
        let mut found = false;
        let mut open = Vec::new();
        for equation in core::mem::take(&mut self.equations) {
            let sum: i32 = equation.iter().filter_map(|(value, k)| Some(k * self.known[value.index()]?)).sum();
            let unknown: BTreeSet<ValueId> =
                equation.iter().map(|(value, _)| *value).filter(|value| self.known[value.index()].is_none()).collect();
            match (unknown.len(), unknown.first()) {
                (1, Some(value)) => {
                    let k: i32 = equation.iter().filter(|(other, _)| other == value).map(|(_, k)| k).sum();
                    if k == 0 || sum % k != 0 {
                        return None;
                    }
                    self.known[value.index()] = Some(-sum / k);
                    found = true;
                }
                (0, _) if sum != 0 => return None,
                (0, _) => {}
                _ => open.push(equation),
            }
        }
        self.equations = open;
        Some(found)
    }
}

/// The direction is read in the length of its link, and constants take it back.
fn resize(program: &mut Program, graph: &Graph, direction: &Direction, sizes: &[i32]) {
    let power = |exponent: i32| {
        let power = direction.reciprocal.pow(exponent.unsigned_abs());
        if exponent < 0 { Number::one().div(&power).unwrap_or(power) } else { power }
    };
    let size = |value: ValueId| sizes[value.index()];
    let mut replaced = direction.arms.clone();
    for step in core::mem::take(&mut program.steps) {
        if let Step::Let(value) = step {
            if direction.arms.contains_key(&value) {
                continue;
            }
            if let Some((constant, exponent)) = constant_of(program, graph, value, &size)
                && exponent != 0
                && let Some(number) = program.constant(graph, constant)
                && let Some(op) = program.op(value).cloned()
            {
                let number = number.mul(&power(exponent));
                let rest = op.operands().into_iter().find(|operand| *operand != constant);
                if let (Op::Mul(..), true, Some(rest)) = (&op, number.is_one(), rest) {
                    replaced.insert(value, replaced.get(&rest).copied().unwrap_or(rest));
                    continue;
                }
                let own = program.add_constant(graph, &number, value);
                let op = op.map(|operand| if operand == constant { own } else { operand });
                program.values[value.index()].definition = Definition::Computed(op);
            }
            if let Some(label) = &mut program.values[value.index()].label {
                *label = resized(label, size(value), &direction.length);
            }
        }
        let step = program.reading(step, &replaced);
        program.steps.push(step);
    }
    let renamed = |value: &mut ValueId| *value = replaced.get(value).copied().unwrap_or(*value);
    program.values.iter_mut().filter_map(|value| value.component.as_mut()).for_each(|of| renamed(&mut of.arm));
    program.outputs.iter_mut().for_each(|(_, value)| renamed(value));
    for step in &mut program.steps {
        if let Step::FiniteResults(values) = step {
            values.iter_mut().for_each(renamed);
        }
    }
}

/// The constant that an operation has, and the power of the reciprocal of the length by which it is multiplied, so that the result has the
/// size that is asked of it.
fn constant_of(
    program: &Program,
    graph: &Graph,
    value: ValueId,
    size: &dyn Fn(ValueId) -> i32,
) -> Option<(ValueId, i32)> {
    let is_constant = |value: ValueId| program.constant(graph, value).is_some();
    let own = size(value);
    match *program.op(value)? {
        Op::Mul(k, a) | Op::Mul(a, k) if is_constant(k) => Some((k, size(a) - own)),
        Op::Div(k, a) if is_constant(k) => Some((k, -size(a) - own)),
        Op::Div(a, k) if is_constant(k) => Some((k, own - size(a))),
        Op::Add(k, _) | Op::Add(_, k) | Op::Sub(k, _) | Op::Sub(_, k) if is_constant(k) => Some((k, -own)),
        _ => None,
    }
}

/// The name of a value that is found in another size.
fn resized(label: &Label, size: i32, length: &str) -> Label {
    let power = match size.unsigned_abs() {
        1 => String::new(),
        2 => "²".to_owned(),
        n => format!("^{n}"),
    };
    let Label { name, equation } = label;
    let number = if power.is_empty() { String::new() } else { size.unsigned_abs().to_string() };
    match size {
        0 => label.clone(),
        1.. => {
            Label { name: format!("{name}_by_length{number}"), equation: format!("{equation}, times {length}{power}") }
        }
        _ => {
            Label { name: format!("{name}_over_length{number}"), equation: format!("{equation}, over {length}{power}") }
        }
    }
}

/// The vector over the length, a constant, without being brought to unit size.
fn divide(program: &mut Program, graph: &Graph, direction: &Direction) {
    for (component, arm) in &direction.arms {
        let reciprocal = program.add_constant(graph, &direction.reciprocal, *component);
        program.values[component.index()].definition = Definition::Computed(Op::Mul(reciprocal, *arm));
    }
}
