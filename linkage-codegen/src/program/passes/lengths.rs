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

use std::collections::BTreeMap;

use super::sizes::{Constant, Powers, Scale, Sizes, exchange};
use crate::graph::number::Number;
use crate::graph::{Component, Graph, Label, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn leave(mut program: Program, graph: &Graph) -> Program {
    if program.counts_rounding {
        return program;
    }
    let directions = directions(&program);
    let arms: BTreeMap<ValueId, ValueId> = directions.iter().flat_map(Direction::arms).collect();
    let equations = Sizes::of(&program, graph, &arms, &|_| false).settled();
    let (mut constants, mut replaced) = (BTreeMap::new(), BTreeMap::new());
    let mut given: Powers = BTreeMap::new();
    directions.iter().for_each(|direction| given.extend(direction.in_power(0)));
    let powers = directions.iter().map(|direction| {
        // The components of the others stay as they are.
        given.extend(direction.in_power(-1));
        let powers = equations.solve(&given);
        given.extend(direction.in_power(0));
        powers
    });
    let powers: Vec<Option<Powers>> = powers.collect();
    let (resized_ones, divided): (Vec<_>, Vec<_>) =
        directions.iter().zip(powers).partition(|(_, powers)| powers.is_some());
    divided.iter().for_each(|(direction, _)| divide(&mut program, graph, direction));
    let readers = program.readers();
    for (direction, powers) in resized_ones {
        let Some(powers) = powers else { continue };
        let scale = Scale { factor: direction.reciprocal.clone(), powers };
        for value in scale.touched(&readers) {
            let constant = constants.get(&value).cloned().or_else(|| Constant::of(&program, graph, value));
            if let Some(constant) = constant
                && let Some(number) = scale.of(&constant)
            {
                constants.insert(value, Constant { number, ..constant });
            }
            if let Some(label) = &mut program.values[value.index()].label {
                *label = resized(label, -scale.power(value), &direction.length);
            }
        }
        replaced.extend(direction.arms());
    }
    exchange(&mut program, graph, &constants, replaced);
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
    /// All components in one power of the reciprocal of the length.
    fn in_power(&self, power: i32) -> impl Iterator<Item = (ValueId, i32)> {
        self.components.keys().map(move |component| (*component, power))
    }

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
