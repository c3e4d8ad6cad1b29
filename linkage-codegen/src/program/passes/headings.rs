//! Pass "headings": a heading under which nothing has a name, as where velocities and forces have coefficients in common and velocities are not
//! asked for, gives way to that of what reads its values.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::Graph;
use crate::program::{Program, Step, ValueId};

pub(super) fn settle(mut program: Program, _: &Graph) -> Program {
    let computed: Vec<ValueId> = program.computed().collect();
    let results: BTreeSet<ValueId> = program.outputs.iter().map(|(_, value)| *value).collect();
    let named = computed.iter().filter(|value| program.value(**value).label.is_some() || results.contains(value));
    let headings: BTreeSet<String> = named.map(|value| program.value(*value).section.clone()).collect();
    let (readers, checked) = (program.readers(), checked(&program));
    for value in computed.into_iter().rev() {
        // Those behind it have theirs.
        let reader = readers[value.index()].first().or_else(|| checked.get(&value));
        if let Some(reader) = reader
            && !headings.contains(&program.value(value).section)
        {
            let heading = program.value(*reader).section.clone();
            program.values[value.index()].section = heading;
        }
    }
    program
}

/// For what a check reads, what it checks.
fn checked(program: &Program) -> BTreeMap<ValueId, ValueId> {
    let checks = program.steps.iter().filter_map(|step| match step {
        Step::Check { guard, .. } => Some(guard.condition.operands()),
        _ => None,
    });
    checks.flat_map(|sides| sides.map(|side| (side, named_part(program, sides[0])))).collect()
}

/// A value if it has a name, or the first of its operands, and of theirs, that has one.
fn named_part(program: &Program, mut value: ValueId) -> ValueId {
    while program.value(value).label.is_none()
        && let Some(first) = program.op(value).and_then(|op| op.operands().first().copied())
    {
        value = first;
    }
    value
}
