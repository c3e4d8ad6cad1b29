//! Starting poses: every search must arrive from where it is declared to start.

use std::collections::HashMap;

use super::{Fault, Functions, Input, Run};
use crate::diagnostics::{Diagnostic, Sink, list};
use crate::graph::{Failure, NodeId, Symbol};
use crate::model::Model;

/// Refuses a linkage that cannot be posed at the start of its drives. With a parameter that has no default, only a run tells.
pub fn check_start(model: &Model, functions: &Functions, sink: &Sink) {
    if functions.near.is_none() || model.params.iter().any(|param| param.default.is_none()) {
        return;
    }
    // Of closures that are chosen at run time, one choice must do.
    let choices = 1u32 << model.given_closures().count().min(6);
    let faults = (0..choices).map(|choice| fault(model, functions, choice));
    let Some(fault) = faults.collect::<Option<Vec<_>>>().and_then(|mut faults| faults.pop()) else { return };
    report(model, &fault, sink);
}

/// What goes wrong at the start, with the sides as the bits of a choice say.
fn fault(model: &Model, functions: &Functions, choice: u32) -> Option<Fault> {
    let number = |node: Option<NodeId>| {
        node.and_then(|node| model.graph.constant_value(node)).map_or(f64::NAN, |value| value.to_f64())
    };
    let of = |symbol: Symbol| match symbol {
        Symbol::Side(closure) => {
            let index = model.given_closures().position(|(own, _)| own == closure).unwrap_or(0);
            if choice >> index & 1 == 0 { 1.0 } else { -1.0 }
        }
        Symbol::Drive(drive) => number(model.drive(drive).start.map(|(value, _)| value)),
        Symbol::Parameter(param) => number(model.param(param).default),
        _ => f64::NAN,
    };
    let run = |program, prepared: &HashMap<NodeId, f64>| {
        Run { program, graph: &model.graph }.with(&|input| match input {
            Input::Symbol(symbol) => of(symbol),
            Input::Prepared(node) => prepared.get(&node).copied().unwrap_or(f64::NAN),
            Input::Kept(_) | Input::Known(_) => f64::NAN,
        })
    };
    let prepared = run(&functions.prepare, &HashMap::new());
    let prepared = prepared.map(|values| functions.prepared.iter().copied().zip(values).collect::<HashMap<_, _>>());
    prepared.and_then(|prepared| run(&functions.pose, &prepared)).err()
}

fn report(model: &Model, fault: &Fault, sink: &Sink) {
    let of_drives = model.drives.iter().find_map(|drive| drive.start).map_or(model.name.place(), |(_, place)| place);
    sink.report(match fault {
        Fault::Failed(Failure::NoConvergence { group, .. }) => {
            let names: Vec<&str> = group.split(" + ").collect();
            let start = model.starts.iter().find(|start| names.contains(&model.link(start.link).name.text.as_str()));
            let place = start.map_or(of_drives, |start| start.place);
            Diagnostic::new(place, format!("{} cannot be closed from their starting pose", list(&names)))
                .note("the iteration does not arrive: the start is too far from a closed pose, or beyond a pose at which they lock")
                .help("say more closely where they are when the drives are at their start")
        }
        Fault::Failed(Failure::CannotAssemble { group, joint, .. }) => {
            let names: Vec<&str> = group.split(" + ").collect();
            Diagnostic::new(of_drives, format!("{} cannot be assembled at `{joint}` at the start of the drives", list(&names)))
                .help("choose a start at which the linkage can be assembled")
        }
        _ => Diagnostic::new(of_drives, "the linkage has no pose at the start of the drives")
            .help("choose a start at which the linkage can be assembled"),
    });
}
