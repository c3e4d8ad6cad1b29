//! Starting poses: every search must arrive from where it is declared to start.

use super::{Fault, Functions, Input, Run};
use crate::diagnostics::{Diagnostic, Sink, list};
use crate::graph::{Failure, NodeId, NodeValues, Symbol};
use crate::model::Model;
use crate::model::ids::{GROUND, LinkId};
use crate::model::units::Kind;
use crate::plan::Plan;
use crate::plan::starts::{Item, Wanted};
use crate::topology::Topology;

/// Of so many sides that are chosen at run time all choices are looked at; of further ones the first side.
const SIDES: usize = 6;

/// Refuses a linkage that cannot be posed at the start of its drives. With a parameter that has no default, only a run tells. Of sides that are
/// chosen at run time one choice must do; the others with which the linkage cannot be posed there are given back, in words.
pub fn check_start(
    model: &Model,
    (topology, plan): (&Topology, &Plan),
    functions: &Functions,
    sink: &Sink,
) -> Vec<String> {
    if functions.near.is_none() || model.params.iter().any(|param| param.default.is_none()) {
        return Vec::new();
    }
    let choices = 1u32 << model.given_closures().count().min(SIDES);
    let mut faults: Vec<(u32, Fault)> =
        (0..choices).filter_map(|choice| Some((choice, fault(model, functions, choice)?))).collect();
    if faults.len() < choices as usize {
        return faults.into_iter().map(|(choice, _)| in_words(model, choice)).collect();
    }
    if let Some((_, fault)) = faults.pop() {
        report(model, (topology, plan), &fault, sink);
    }
    Vec::new()
}

/// The sides of a choice: `` `B` left and `C` behind ``.
fn in_words(model: &Model, choice: u32) -> String {
    let sides = model.given_closures().take(SIDES).enumerate().map(|(index, (_, closure))| {
        let [first, second] = if closure.of.len() == 2 { ["left", "right"] } else { ["ahead", "behind"] };
        let side = if choice >> index & 1 == 0 { first } else { second };
        format!("`{}` {side}", model.joint(closure.joint).name)
    });
    sides.collect::<Vec<_>>().join(" and ")
}

/// The number of a symbol at the start, with the sides as the bits of a choice say.
fn at_start(model: &Model, choice: u32, symbol: Symbol) -> f64 {
    let number = |node: Option<NodeId>| {
        node.and_then(|node| model.graph.constant_value(node)).map_or(f64::NAN, |value| value.to_f64())
    };
    match symbol {
        Symbol::Side(closure) => {
            let index = model.given_closures().position(|(own, _)| own == closure).unwrap_or(0);
            if index >= SIDES || choice >> index & 1 == 0 { 1.0 } else { -1.0 }
        }
        Symbol::Drive(drive) => number(model.drive(drive).start.map(|(value, _)| value)),
        Symbol::Parameter(param) => number(model.param(param).default),
        _ => f64::NAN,
    }
}

/// What goes wrong at the start, with the sides as the bits of a choice say.
fn fault(model: &Model, functions: &Functions, choice: u32) -> Option<Fault> {
    let of = |symbol: Symbol| at_start(model, choice, symbol);
    let run = |program, prepared: &NodeValues<f64>| {
        Run { program, graph: &model.graph }.with(&|input| match input {
            Input::Symbol(symbol) => of(symbol),
            Input::Prepared(node) => prepared.get(&node).copied().unwrap_or(f64::NAN),
            Input::Kept(_) | Input::Known(_) => f64::NAN,
        })
    };
    let prepared = run(&functions.prepare, &NodeValues::default());
    let prepared = prepared.map(|values| functions.prepared.iter().copied().zip(values).collect::<NodeValues<_>>());
    prepared.and_then(|prepared| run(&functions.pose, &prepared)).err()
}

/// What stays open of a group at its start, with the first of all closures.
fn gap(model: &Model, links: &str) -> Option<f64> {
    let of = |failure: &Failure| match failure {
        Failure::NoConvergence { group, gap } if group == links => Some(*gap),
        _ => None,
    };
    let known = |symbol: Symbol| at_start(model, 0, symbol);
    let gaps = model.graph.guards().into_iter().filter_map(|guard| of(&guard.failure));
    let mut gaps = gaps.map(|gap| model.graph.evaluate(gap, &known, &mut NodeValues::default()));
    gaps.find(|gap| *gap > 0.0 && gap.is_finite())
}

/// Starts of a group with which it closes.
fn closing(model: &Model, (topology, plan): (&Topology, &Plan), group: &[LinkId]) -> Option<Vec<String>> {
    let earlier = topology.motion.iter().take_while(|other| !other.links.iter().any(|link| group.contains(link)));
    let earlier: Vec<LinkId> = earlier.flat_map(|other| other.links.iter().copied()).chain([GROUND]).collect();
    let placed = |link: LinkId| {
        let at = &plan.links[link.index()];
        earlier.contains(&link).then_some([at.origin.x, at.origin.y, at.angle])
    };
    let items = Wanted { model, group, placed: &placed }.starts()?;
    Some(items.into_iter().filter(|(item, _)| matches!(item, Item::Link(_))).map(|(_, line)| line).collect())
}

fn report(model: &Model, stages: (&Topology, &Plan), fault: &Fault, sink: &Sink) {
    let of_drives = model.drives.iter().find_map(|drive| drive.start).map_or(model.name.place(), |(_, place)| place);
    sink.report(match fault {
        Fault::Failed(Failure::NoConvergence { group, .. }) => {
            let names: Vec<&str> = group.split(" + ").collect();
            let start = model.starts.iter().find(|start| names.contains(&model.link(start.link).name.text.as_str()));
            let place = start.map_or(of_drives, |start| start.place);
            let own = |link: &LinkId| names.contains(&model.link(*link).name.text.as_str());
            let links: Vec<LinkId> = model.moving_links().filter(own).collect();
            let left = gap(model, group).map_or_else(String::new, |gap| {
                format!(": it ends where {gap:.3e} {} stay open of all loops together", Kind::Length.unit(&model.units))
            });
            let found = Diagnostic::new(place, format!("{} cannot be closed from their starting pose", list(&names)))
                .note(format!("the iteration does not arrive{left}"))
                .note("the start is too far from a closed pose, or beyond a pose at which they lock");
            match closing(model, stages, &links) {
                Some(lines) => found.help(format!(
                    "say more closely where they are when the drives are at their start: they close, among other poses, with\n{}",
                    lines.join("\n")
                )),
                None => found.help(
                    "say more closely where they are when the drives are at their start, at which no pose was found that closes: \
                     another start of the drives may be needed",
                ),
            }
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
