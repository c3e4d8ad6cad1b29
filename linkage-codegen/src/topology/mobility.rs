//! Counting: as many drives as freedoms.

use std::collections::BTreeSet;

use super::matching::Unbalanced;
use super::{Constraint, Input, generic, redundant};
use crate::diagnostics::{Diagnostic, Sink, count, list};
use crate::model::Model;
use crate::model::ids::{GROUND, JointId, LinkId};

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
        "3 freedoms for each of {}, less {} of {}: mobility {mobility}, and {}",
        count(model.links.len() - 1, "moving link"),
        count(constraints, "constraint"),
        count(model.joints.len(), "joint"),
        count(drives, "drive"),
    );
    let joints: Vec<JointId> = model.joint_ids().collect();
    let pinned_twice = super::pinned_twice(model, &joints);
    let last = model.drives.last().map_or(model.name.place(), |d| d.name.place());
    let drives = i64::try_from(drives).unwrap_or(0);
    if mobility < drives && pinned_twice.is_none() {
        let redundant = redundant::find(model);
        if let Some(redundant) = redundant.filter(|found| i64::try_from(found.mobility).is_ok_and(|own| own >= drives))
        {
            sink.report(redundant.report(counts));
            return false;
        }
    }
    let found = if mobility <= 0 {
        Diagnostic::new(model.name.place(), "the linkage cannot move: its joints hold it fast")
            .note(counts)
            .note("should it move in spite of that, because of special dimensions such as parallel cranks of equal length, \
                   then one of its joints is redundant, and the reactions have no single answer")
            .help(pinned_twice.unwrap_or_else(|| {
                "release a joint: take one out, or let a link end in a slider instead of a pin".to_owned()
            }))
    } else if mobility < drives {
        let surplus = drives - mobility;
        Diagnostic::new(last, format!("the linkage is over-driven by {}", counted(surplus, "drive"))).note(counts).help(
            pinned_twice.unwrap_or_else(|| {
                format!("take {} out", if surplus == 1 { "a drive".into() } else { counted(surplus, "drive") })
            }),
        )
    } else {
        let problem = match drives {
            0 => "nothing drives the linkage".to_owned(),
            _ => format!("the drives leave {} of the linkage loose", counted(mobility - drives, "freedom")),
        };
        let found = Diagnostic::new(last, problem).note(counts);
        let undriven = model.joints.iter().enumerate().find(|(index, _)| !is_driven(model, *index));
        match undriven {
            Some((_, joint)) => found.help(format!(
                "drive {} joint, as in `drive q: {};`, or hold the linkage by a further joint",
                if drives == 0 { "a" } else { "another" },
                joint.name
            )),
            None => found.help("hold the linkage by a further joint"),
        }
    };
    sink.report(found);
    false
}

/// Reports more or fewer unknowns than drives, which are as many as the freedoms.
pub(super) fn check_unknowns(model: &Model, sink: &Sink) -> bool {
    let (found, wanted) = (model.unknowns.len(), model.drives.len());
    if found == wanted {
        return true;
    }
    let problem = format!(
        "{} {} needed to hold the linkage, and {found} {} declared",
        count(wanted, "unknown"),
        are(wanted),
        are(found)
    );
    let help = if found > wanted {
        format!("take {} out, or drive as many joints more", count(found - wanted, "unknown"))
    } else {
        format!("declare {} more, or none: then the effort at each drive is unknown", count(wanted - found, "unknown"))
    };
    let last = model.unknowns.last().map_or(model.name.place(), |unknown| unknown.place);
    sink.report(
        Diagnostic::new(last, problem)
            .note("one for each drive: a drive fixes one freedom, in which one effort, wherever it acts, holds the linkage against its loads")
            .help(help),
    );
    false
}

fn is_driven(model: &Model, joint: usize) -> bool {
    model.drives.iter().any(|drive| drive.joint.index() == joint)
}

fn counted(n: i64, noun: &str) -> String {
    count(usize::try_from(n).unwrap_or(0), noun)
}

/// The count is right on the whole, but not everywhere.
pub(super) fn unbalanced(model: &Model, all: &[Constraint], inputs: &[Input], found: &Unbalanced) -> Diagnostic {
    let names = |links: &BTreeSet<LinkId>| {
        let names: Vec<&str> = links.iter().map(|l| model.link(*l).name.text.as_str()).collect();
        list(&names)
    };
    let (tight, loose) = (names(&found.overdetermined), names(&found.loose));
    let unknown = inputs.iter().rev().find_map(|input| match input {
        Input::Unknown(unknown) => Some(model.unknown(*unknown)),
        Input::Drive(_) => None,
    });
    if let Some(unknown) = unknown {
        return Diagnostic::new(
            unknown.place,
            format!("the unknowns cannot hold the linkage: they would hold {tight} twice, and {loose} not at all"),
        )
        .help("let each unknown act on links that another drive moves");
    }
    // Inside the tight part, and on the loose one.
    let inside = all.iter().filter(|c| c.links.iter().all(|link| found.overdetermined.contains(link))).count();
    let on = all.iter().filter(|c| c.links.iter().any(|link| found.loose.contains(link))).count();
    let freedoms = |links: &BTreeSet<LinkId>| count(3 * links.len(), "freedom");
    let problem = format!(
        "the count is right on the whole, but {tight} {} held twice, and {loose} {} loose",
        are(found.overdetermined.len()),
        are(found.loose.len())
    );
    let drive = model.drives.iter().rev().find(|drive| {
        let ends = model.joint(drive.joint).ends();
        ends.iter().all(|end| end.link == GROUND || found.overdetermined.contains(&end.link))
    });
    let joint = model.joints.iter().enumerate().find(|(index, joint)| {
        !is_driven(model, *index)
            && joint.ends().iter().all(|end| end.link == GROUND || found.loose.contains(&end.link))
    });
    let first = found.overdetermined.iter().next().map_or(model.name.place(), |l| model.link(*l).name.place());
    let place = drive.map_or(first, |drive| drive.name.place());
    let help = match (drive, joint) {
        (Some(drive), Some((_, joint))) => {
            format!("drive a joint of the loose links instead, as in `drive {}: {};`", drive.name, joint.name)
        }
        _ => "move a joint or a drive from the first links to the second".to_owned(),
    };
    let refusal = Diagnostic::new(place, problem).note(format!(
        "constraints and drives: {inside} for the {} of the first, {on} for the {} of the second",
        freedoms(&found.overdetermined),
        freedoms(&found.loose)
    ));
    match redundant::find(model) {
        Some(redundant) => refusal.note(redundant.reason()).help(redundant.release()),
        None => refusal.help(help),
    }
}

fn are(n: usize) -> &'static str {
    if n == 1 { "is" } else { "are" }
}
