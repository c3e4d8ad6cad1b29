//! Counting: as many drives as freedoms.

use std::collections::BTreeSet;

use super::matching::Unbalanced;
use super::{Input, generic};
use crate::diagnostics::{Diagnostic, Sink, list};
use crate::model::Model;
use crate::model::ids::LinkId;

/// Reports a linkage with more or fewer drives than it has freedoms.
pub(super) fn check(model: &Model, sink: &Sink) -> bool {
    let freedoms = 3 * (model.links.len() - 1);
    let constraints: usize = model.joint_ids().map(|j| generic::rows_of(model, j)).sum();
    let drives = model.drives.len();
    if freedoms == constraints + drives {
        return true;
    }
    let mobility = i64::try_from(freedoms).unwrap_or(0) - i64::try_from(constraints).unwrap_or(0);
    let counts = format!(
        "{} moving links with 3 freedoms each, less {} constraints of {} joints: mobility {mobility}; drives: {drives}",
        model.links.len() - 1,
        constraints,
        model.joints.len(),
    );
    let place = model.drives.last().map_or(model.name.place(), |d| d.name.place());
    let drives = i64::try_from(drives).unwrap_or(0);
    let found = if mobility > drives {
        let problem = match drives {
            0 => "nothing drives the linkage".to_owned(),
            _ => format!(
                "the linkage keeps {} freedom{} beside its drives",
                mobility - drives,
                plural(mobility - drives)
            ),
        };
        let undriven =
            model.joints.iter().enumerate().find(|(index, _)| model.drives.iter().all(|d| d.joint.index() != *index));
        let help = undriven.map_or_else(String::new, |(_, joint)| {
            format!("drive another joint, as in `drive q: {};`, or add a joint", joint.name)
        });
        Diagnostic::new(place, problem).help(help)
    } else if mobility <= 0 {
        Diagnostic::new(place, "the linkage cannot move: its joints hold it fast")
            .help("release a joint: take one out, or let a link end in a slider instead of a pin")
            .note("should it move in spite of that, because of special dimensions such as parallel cranks of equal length, \
                   then one of its joints is redundant and its reactions have no single answer")
    } else {
        Diagnostic::new(place, format!("{} too many: the linkage is over-driven", count(drives - mobility, "drive")))
            .help("take a drive out")
    };
    sink.report(found.note(counts));
    false
}

fn plural(n: i64) -> &'static str {
    if n == 1 { "" } else { "s" }
}

fn count(n: i64, noun: &str) -> String {
    format!("{n} {noun}{}", plural(n))
}

/// The count is right on the whole, but not everywhere.
pub(super) fn unbalanced(model: &Model, inputs: &[Input], unbalanced: &Unbalanced) -> Diagnostic {
    let names = |links: &BTreeSet<LinkId>| {
        let names: Vec<&str> = links.iter().map(|l| model.link(*l).name.text.as_str()).collect();
        list(&names)
    };
    let (tight, loose) = (names(&unbalanced.overdetermined), names(&unbalanced.loose));
    let unknown = inputs.iter().rev().find_map(|input| match input {
        Input::Unknown(unknown) => Some(model.unknown(*unknown)),
        Input::Drive(_) => None,
    });
    if let Some(unknown) = unknown {
        return Diagnostic::new(
            unknown.place,
            format!("the unknowns cannot hold the linkage: {tight} would be held twice, and {loose} not at all"),
        )
        .help("let each unknown act on links that another drive moves");
    }
    let place = unbalanced.overdetermined.iter().next().map_or(model.name.place(), |l| model.link(*l).name.place());
    Diagnostic::new(place, format!("the count is right, but {tight} is over-constrained and {loose} is loose"))
        .help("move a joint or a drive from the first to the second")
        .note("each link needs three constraints of its own; those of the first part cannot hold the second")
}
