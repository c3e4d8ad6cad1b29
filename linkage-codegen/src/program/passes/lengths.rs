//! Directions that are no results are read in the lengths of their links: not u but `r u`, r the constant length. What a constant has rounded
//! in `u = v (3 − v·v/r²)/(2r)`, `r u = v (3/2 − v·v/(2r²))` does not; and where v has the length r but for a few roundings, and its rule says that
//! it serves as well, v is read.
//!
//! A value that reads u is then found `r`, `r²`, … times as large or as small, which the constants in it take back: those of products with
//! loads and weights, of quotients, of other lengths. In powers of r, every operation but those with constants says how the size of its
//! result goes with those of its operands, results and checks have a size of their own; what follows of this is one system of equations. Where
//! it has no solution for a direction, u stays, or is v times the constant `1/r` where v serves.
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
    let directions = directions(&program);
    let equations = Equations::of(&program, &directions);
    let (mut resized, mut divided) = (Vec::new(), Vec::new());
    for direction in directions {
        match equations.solve(&direction) {
            Some(sizes) => resized.push((direction, sizes)),
            None => divided.push(direction),
        }
    }
    divided.iter().for_each(|direction| divide(&mut program, graph, direction));
    resize(&mut program, graph, &resized);
    super::unused::remove(program, graph)
}

/// A direction.
struct Direction {
    /// Its components, each with that of the vector along the link which serves as well, if there is one.
    components: BTreeMap<ValueId, Option<ValueId>>,
    /// The reciprocal of the link's length.
    reciprocal: Number,
    /// The length, as text.
    length: String,
}

impl Direction {
    /// The components that other values serve for.
    fn arms(&self) -> impl Iterator<Item = (ValueId, ValueId)> {
        self.components.iter().filter_map(|(component, arm)| Some((*component, (*arm)?)))
    }
}

/// The directions of which no component is a result.
fn directions(program: &Program) -> Vec<Direction> {
    let mut directions: Vec<Direction> = Vec::new();
    for step in &program.steps {
        if let Step::Let(value) = step
            && let Some(Component { arm, reciprocal, length }) = &program.value(*value).component
        {
            match directions.iter_mut().find(|direction| direction.length == *length) {
                Some(direction) => drop(direction.components.insert(*value, *arm)),
                None => directions.push(Direction {
                    components: BTreeMap::from([(*value, *arm)]),
                    reciprocal: reciprocal.clone(),
                    length: length.clone(),
                }),
            }
        }
    }
    let is_result = |value: &ValueId| program.outputs.iter().any(|(_, output)| output == value);
    directions.retain(|direction| !direction.components.keys().any(is_result));
    directions
}

/// How the sizes of values go with each other, in powers of the length of any of the directions.
struct Equations {
    /// Sums of powers, each with its factor, that are zero.
    sums: Vec<Vec<(ValueId, i32)>>,
    /// The sums in which each value is.
    sums_of: Vec<Vec<usize>>,
    /// What is read as it is has the power zero.
    fixed: Vec<Option<i32>>,
    /// The components of all directions.
    components: BTreeSet<ValueId>,
    /// All computed values.
    computed: Vec<ValueId>,
}

impl Equations {
    fn of(program: &Program, directions: &[Direction]) -> Self {
        let count = program.values.len();
        let mut equations = Self {
            sums: Vec::new(),
            sums_of: vec![Vec::new(); count],
            fixed: vec![None; count],
            components: directions.iter().flat_map(|direction| direction.components.keys().copied()).collect(),
            computed: program.computed().collect(),
        };
        program.inputs().for_each(|(value, _)| equations.fix(value));
        program.outputs.iter().for_each(|(_, value)| equations.fix(*value));
        for step in &program.steps {
            match step {
                Step::Let(value) => {
                    match program.value(*value).component {
                        // In its place another value is read.
                        Some(Component { arm: Some(arm), .. }) if equations.components.contains(value) => {
                            equations.fix(arm);
                        }
                        _ => equations.state(program, *value),
                    }
                }
                Step::Check { report, .. } => {
                    let computed = report.iter().filter_map(|value| program.op(*value)).flat_map(Op::operands);
                    computed.chain(program.operands_of(step)).for_each(|value| equations.fix(value));
                }
                Step::FiniteInput(_) | Step::FiniteResults(_) => {}
            }
        }
        equations
    }

    fn fix(&mut self, value: ValueId) {
        self.fixed[value.index()] = Some(0);
    }

    fn equate(&mut self, terms: Vec<(ValueId, i32)>) {
        for (value, _) in &terms {
            self.sums_of[value.index()].push(self.sums.len());
        }
        self.sums.push(terms);
    }

    fn state(&mut self, program: &Program, value: ValueId) {
        let Some(op) = program.op(value) else { return };
        let is_constant = |value: ValueId| is_constant(program, value);
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

    /// In powers of the length of one direction, how much smaller each value is found than it is: one for the direction's components. What
    /// the equations leave open stays as it is; nothing if they contradict each other.
    fn solve(&self, direction: &Direction) -> Option<Vec<i32>> {
        let mut known = self.fixed.clone();
        for component in &self.components {
            let power = i32::from(direction.components.contains_key(component));
            if *known[component.index()].get_or_insert(power) != power {
                return None;
            }
        }
        self.conclude(&mut known, (0..self.sums.len()).collect())?;
        for value in &self.computed {
            if known[value.index()].is_none() {
                known[value.index()] = Some(0);
                self.conclude(&mut known, self.sums_of[value.index()].clone())?;
            }
        }
        Some(known.into_iter().map(Option::unwrap_or_default).collect())
    }

    /// Goes through sums of which something new is known, and those of what follows from them; nothing where they contradict each other.
    fn conclude(&self, known: &mut [Option<i32>], mut open: Vec<usize>) -> Option<()> {
        while let Some(index) = open.pop() {
            let terms = &self.sums[index];
            let power = |value: ValueId| known[value.index()];
            let sum: i32 = terms.iter().filter_map(|(value, k)| Some(k * power(*value)?)).sum();
            let mut unknown = terms.iter().map(|(value, _)| *value).filter(|value| power(*value).is_none());
            match unknown.next() {
                None if sum != 0 => return None,
                Some(value) if unknown.all(|other| other == value) => {
                    let k: i32 = terms.iter().filter(|(other, _)| *other == value).map(|(_, k)| k).sum();
                    if k == 0 || sum % k != 0 {
                        return None;
                    }
                    known[value.index()] = Some(-sum / k);
                    open.extend(&self.sums_of[value.index()]);
                }
                _ => {}
            }
        }
        Some(())
    }
}

fn is_constant(program: &Program, value: ValueId) -> bool {
    matches!(program.op(value), Some(Op::Constant(_)))
}

/// Directions are read in the lengths of their links, and constants take it back.
fn resize(program: &mut Program, graph: &Graph, directions: &[(Direction, Vec<i32>)]) {
    let mut replaced: BTreeMap<ValueId, ValueId> =
        directions.iter().flat_map(|(direction, _)| direction.arms()).collect();
    for step in core::mem::take(&mut program.steps) {
        if let Step::Let(value) = step {
            if replaced.contains_key(&value) {
                continue;
            }
            if let Some((constant, power)) = constant_of(program, value)
                && let Some(factor) = factor(directions, &power)
                && let Some(number) = program.constant(graph, constant)
                && let Some(op) = program.op(value).cloned()
            {
                let number = number.mul(&factor);
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
                for (direction, sizes) in directions {
                    *label = resized(label, sizes[value.index()], &direction.length);
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

/// The product of the reciprocals of all lengths, each to the sum of some powers; nothing if it is one.
fn factor(directions: &[(Direction, Vec<i32>)], powers: &[(ValueId, i32)]) -> Option<Number> {
    let mut product: Option<Number> = None;
    for (Direction { reciprocal, .. }, sizes) in directions {
        let exponent: i32 = powers.iter().map(|(value, k)| k * sizes[value.index()]).sum();
        if exponent != 0 {
            let power = reciprocal.pow(exponent.unsigned_abs());
            let power = if exponent < 0 { Number::one().div(&power)? } else { power };
            product = Some(product.map_or_else(|| power.clone(), |product| product.mul(&power)));
        }
    }
    product
}

/// The constant that an operation has, and the sum of powers of the reciprocal of a length by which it is multiplied, so that the result has
/// the size that is asked of it.
fn constant_of(program: &Program, value: ValueId) -> Option<(ValueId, Vec<(ValueId, i32)>)> {
    let is_constant = |value: ValueId| is_constant(program, value);
    match *program.op(value)? {
        Op::Mul(k, a) | Op::Mul(a, k) if is_constant(k) => Some((k, vec![(a, 1), (value, -1)])),
        Op::Div(k, a) if is_constant(k) => Some((k, vec![(a, -1), (value, -1)])),
        Op::Div(a, k) if is_constant(k) => Some((k, vec![(a, -1), (value, 1)])),
        Op::Add(k, _) | Op::Add(_, k) | Op::Sub(k, _) | Op::Sub(_, k) if is_constant(k) => Some((k, vec![(value, -1)])),
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
    for (component, arm) in direction.arms() {
        let reciprocal = program.add_constant(graph, &direction.reciprocal, component);
        program.values[component.index()].definition = Definition::Computed(Op::Mul(reciprocal, arm));
    }
}
