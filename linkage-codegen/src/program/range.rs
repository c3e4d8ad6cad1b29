//! Constants that the scalar cannot hold.

use std::collections::BTreeSet;

use super::{Definition, Functions, Program};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::Op;
use crate::model::Model;

/// Refuses functions with a constant that is infinite in the scalar, or nothing: no code could give the right numbers.
pub fn check_range(model: &Model, functions: &Functions, sink: &Sink) {
    let scalar = model.graph.scalar();
    let both = functions.scenes.iter().flat_map(|scene| [&scene.from_pose, &scene.direct]);
    let programs = [&functions.prepare, &functions.pose].into_iter().chain(&functions.accessors).chain(both);
    let numbers: BTreeSet<_> = programs.flat_map(constants).collect();
    if numbers.iter().all(|number| model.graph.number(*number).fits(scalar)) {
        return;
    }
    let problem = format!("the equations of this linkage have constants beyond the range of an `{}`", scalar.name());
    sink.report(
        Diagnostic::new(model.name.place(), problem)
            .note("they are products and squares of the declared dimensions, masses and loads")
            .help("choose `units` in which these are neither so large nor so small"),
    );
}

/// Those that are read: of others, larger or smaller, some are made.
fn constants(program: &Program) -> impl Iterator<Item = crate::graph::NumberId> {
    program.values.iter().zip(program.uses()).filter_map(|(value, uses)| match value.definition {
        Definition::Computed(Op::Constant(number)) if uses > 0 => Some(number),
        _ => None,
    })
}
