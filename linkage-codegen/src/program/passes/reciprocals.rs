//! Several quotients by one divisor become products with its reciprocal, but for those that are to be divided.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::number::Number;
use crate::graph::{Graph, Label, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn share(mut program: Program, graph: &Graph) -> Program {
    let mut divisors: BTreeMap<ValueId, usize> = BTreeMap::new();
    for step in &program.steps {
        if let Step::Let(value) = step
            && let Some(Op::Div(_, divisor)) = program.op(*value)
            && !program.value(*value).divided
        {
            *divisors.entry(*divisor).or_default() += 1;
        }
    }
    let shared: BTreeSet<ValueId> =
        divisors.into_iter().filter(|(_, uses)| *uses > 1).map(|(divisor, _)| divisor).collect();
    // A reciprocal that is there already serves all the others.
    let mut own: BTreeMap<ValueId, ValueId> = BTreeMap::new();
    for step in &program.steps {
        if let Step::Let(value) = step
            && let Some(Op::Div(dividend, divisor)) = program.op(*value)
            && shared.contains(divisor)
            && program.constant(graph, *dividend).is_some_and(|number| number.is_one())
        {
            own.entry(*divisor).or_insert(*value);
        }
    }
    // Those that have their step. One that was there stays a quotient, also if it is to be divided.
    let mut reciprocals: BTreeMap<ValueId, ValueId> = BTreeMap::new();
    let mut steps = Vec::new();
    for step in core::mem::take(&mut program.steps) {
        if let Step::Let(value) = step
            && let Some(Op::Div(dividend, divisor)) = program.op(value).cloned()
            && shared.contains(&divisor)
            && (!program.value(value).divided || own.get(&divisor) == Some(&value))
        {
            if let Some(reciprocal) = own.get(&divisor).copied() {
                if reciprocals.insert(divisor, reciprocal).is_none() {
                    steps.push(Step::Let(reciprocal));
                }
                if reciprocal == value {
                    continue;
                }
            }
            let reciprocal = *reciprocals.entry(divisor).or_insert_with(|| {
                let reciprocal = reciprocal_of(&mut program, graph, divisor, value);
                steps.push(Step::Let(reciprocal));
                reciprocal
            });
            program.values[value.index()].definition = Definition::Computed(Op::Mul(dividend, reciprocal));
        }
        steps.push(step);
    }
    program.steps = steps;
    program
}

/// `1/divisor` as a new value, under the heading of its first use.
fn reciprocal_of(program: &mut Program, graph: &Graph, divisor: ValueId, first_use: ValueId) -> ValueId {
    let one = program.add_constant(graph, &Number::one(), first_use);
    let reciprocal = program.add(Op::Div(one, divisor), first_use);
    let named = program.value(divisor).label.clone();
    program.values[reciprocal.index()].label =
        named.map(|label| Label { name: format!("inverse_{}", label.name), equation: String::new() });
    reciprocal
}
