//! Directions that are no results keep the lengths of their links: `u = v/r` is not brought to unit size, where `v` has the constant length r
//! but for a few roundings, and it is `v` that is read.
//!
//! A value that reads u is then found `r`, `r²`, … times as large or as small, which the constants in it take back: those of products with
//! loads and weights, of quotients, of other lengths. In powers of r, every operation but those with constants says how the size of its
//! result goes with those of its operands, results and checks have a size of their own; what follows of this is one system of equations. Where
//! it has no solution, u is v times the constant `1/r`.
//!
//! Not where rounding errors are counted, which would have to know of it.

use std::collections::BTreeMap;

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
    /// The equations in which each value is.
    equations_of: Vec<Vec<usize>>,
    /// Whether what is read as it is would be found in another size.
    contradict: bool,
    program: &'a Program,
}

impl<'a> Sizes<'a> {
    fn of(program: &'a Program, graph: &Graph, direction: &Direction) -> Self {
        let count = program.values.len();
        let (known, equations_of) = (vec![None; count], vec![Vec::new(); count]);
        let mut sizes = Self { known, equations: Vec::new(), equations_of, contradict: false, program };
        for component in direction.arms.keys() {
            sizes.known[component.index()] = Some(1);
        }
        program.inputs().for_each(|(value, _)| sizes.fix(value));
        program.outputs.iter().for_each(|(_, value)| sizes.fix(*value));
        for step in &program.steps {
            match step {
                Step::Let(value) if direction.arms.contains_key(value) => {}
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
        self.contradict |= *self.known[value.index()].get_or_insert(0) != 0;
    }

    fn equate(&mut self, terms: Vec<(ValueId, i32)>) {
        for (value, _) in &terms {
            self.equations_of[value.index()].push(self.equations.len());
        }
        self.equations.push(terms);
    }

    fn state(&mut self, graph: &Graph, value: ValueId) {
        let program = self.program;
        let Some(op) = program.op(value) else { return };
        let is_constant = |value: ValueId| program.constant(graph, value).is_some();
        let is_computed = |value: &ValueId| !is_constant(*value);
        match *op {
            // A constant in it takes whatever is asked.
            Op::Constant(_) => {}
            Op::Mul(a, b) | Op::Div(a, b) if is_constant(a) || is_constant(b) => {}
            Op::Mul(a, b) => self.equate(vec![(value, 1), (a, -1), (b, -1)]),
            Op::Div(a, b) => self.equate(vec![(value, 1), (a, -1), (b, 1)]),
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

    /// The powers, if there are any that fulfil all equations. What these leave open stays as it is.
    fn solve(mut self) -> Option<Vec<i32>> {
        if self.contradict {
            return None;
        }
        self.conclude((0..self.equations.len()).collect())?;
        for value in self.program.computed() {
            if self.known[value.index()].is_none() {
                self.known[value.index()] = Some(0);
                self.conclude(self.equations_of[value.index()].clone())?;
            }
        }
        Some(self.known.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Goes through equations of which something new is known, and those of what follows from them; nothing where they contradict each other.
    fn conclude(&mut self, mut open: Vec<usize>) -> Option<()> {
        while let Some(equation) = open.pop() {
            let (mut sum, mut unknown) = (0, BTreeMap::new());
            for (value, k) in &self.equations[equation] {
                match self.known[value.index()] {
                    Some(power) => sum += k * power,
                    None => *unknown.entry(*value).or_insert(0) += k,
                }
            }
            match unknown.pop_first() {
                None if sum != 0 => return None,
                Some((value, k)) if unknown.is_empty() => {
                    if k == 0 || sum % k != 0 {
                        return None;
                    }
                    self.known[value.index()] = Some(-sum / k);
                    open.extend(&self.equations_of[value.index()]);
                }
                _ => {}
            }
        }
        Some(())
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
    for component in program.values.iter_mut().filter_map(|value| value.component.as_mut()) {
        component.arm = replaced.get(&component.arm).copied().unwrap_or(component.arm);
    }
    program.rename_results(&replaced);
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
    let Label { name, equation } = label;
    let (number, power) = match size.unsigned_abs() {
        0 => return label.clone(),
        1 => (String::new(), String::new()),
        2 => ("2".to_owned(), "²".to_owned()),
        n => (n.to_string(), format!("^{n}")),
    };
    let (suffix, word) = if size > 0 { ("by", "times") } else { ("over", "over") };
    Label { name: format!("{name}_{suffix}_length{number}"), equation: format!("{equation}, {word} {length}{power}") }
}

/// The vector over the length, a constant, without being brought to unit size.
fn divide(program: &mut Program, graph: &Graph, direction: &Direction) {
    for (component, arm) in &direction.arms {
        let reciprocal = program.add_constant(graph, &direction.reciprocal, *component);
        program.values[component.index()].definition = Definition::Computed(Op::Mul(reciprocal, *arm));
    }
}
