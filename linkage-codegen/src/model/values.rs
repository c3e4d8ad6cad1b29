//! Names of what the generated functions read: what is given, and what a pose keeps.

use std::collections::BTreeMap;

use super::{JointKind, Link, Model};
use crate::diagnostics::{Diagnostic, Sink};
use crate::syntax::ast::Name;

/// Patterns that Rust knows already: no value can be bound by such a name.
pub(crate) const OWN_PATTERNS: [&str; 4] = ["Ok", "Err", "Some", "None"];

/// Constants of the generated module.
pub(crate) const OWN_CONSTANTS: [&str; 4] = ["EQUATIONS", "LIMITS", "OPERATIONS", "SOURCE"];

/// Names by which a sweep computes its positions.
pub(crate) const SWEPT: [&str; 4] = ["lane", "lanes", "block", "failed"];

/// What a place on a link is called at which no point is.
pub(crate) const PLACE: &str = "place";

/// What the places on a link are called.
fn places_of(link: &Link) -> impl Iterator<Item = &str> {
    link.points.iter().map(|point| point.name.text.as_str()).chain([PLACE])
}

/// What the arm from one place on a link to another one is called.
#[must_use]
pub(crate) fn arm_name(link: &str, from: &str, to: &str) -> String {
    format!("arm_{link}_{from}_{to}")
}

/// What the reciprocal of a pivot is called.
#[must_use]
pub(crate) fn reciprocal_name(pivot: &str) -> String {
    format!("inverse_{pivot}")
}

/// What the generated functions read may not have two meanings under one name.
pub(super) fn check(model: &Model, sink: &Sink) {
    let mut values: BTreeMap<String, String> = BTreeMap::new();
    values.insert("loads".into(), "holds the loads".into());
    if model.moves() {
        values.insert("motion".into(), "holds the rates of the drives".into());
    }
    values.insert("linkage".into(), "holds what is prepared from the parameters".into());
    for (_, closure) in model.given_closures() {
        values.insert("closures".into(), "holds the closures that are chosen at run time".into());
        let joint = &model.joint(closure.joint).name;
        values.insert(format!("side_{joint}"), format!("is the side of `{joint}`"));
    }
    for constant in OWN_CONSTANTS {
        values.insert(constant.into(), "is a constant of the module".into());
    }
    for pattern in OWN_PATTERNS {
        values.insert(pattern.into(), "is Rust's own".into());
    }
    for name in SWEPT.into_iter().filter(|_| !model.sweeps.is_empty()) {
        values.insert(name.into(), "is what sweeps compute by".into());
    }
    for link in &model.links {
        for part in ["cos", "sin"] {
            values.insert(format!("{}_{part}", link.name), format!("is the direction of `{}`", link.name));
            values.insert(format!("{}_{part}_before", link.name), format!("is a direction of `{}`", link.name));
        }
        for (from, to) in places_of(link).flat_map(|from| places_of(link).map(move |to| (from, to))) {
            for part in ["x", "y"] {
                values
                    .insert(arm_name(&link.name.text, from, to) + "_" + part, format!("is an arm on `{}`", link.name));
            }
        }
    }
    // Only wheels, and what is joined to them, keep an angle.
    let gears = model.has_gears();
    for link in model.links.iter().filter(|_| gears) {
        for name in [format!("angle_{}", link.name), format!("angle_{}_before", link.name)] {
            values.insert(name, format!("is an angle of `{}`", link.name));
        }
    }
    for joint in &model.joints {
        for pivot in joint.pivot_names() {
            values.insert(reciprocal_name(&pivot), format!("is the reciprocal of a pivot of `{}`", joint.name));
            values.insert(pivot, format!("is a pivot of `{}`", joint.name));
        }
        values.insert(format!("cos_mu_{}", joint.name), format!("is the cosine of an angle at `{}`", joint.name));
        if matches!(joint.kind, JointKind::Slot { .. }) {
            values.insert(format!("arm_{}", joint.name), format!("is the lever arm of `{}`", joint.name));
        }
        for travel in ["travel", "run"] {
            values.insert(format!("{travel}_{}", joint.name), format!("is the travel of `{}`", joint.name));
            values.insert(format!("{travel}_{}_before", joint.name), format!("is a travel of `{}`", joint.name));
        }
    }
    for drive in model.drives.iter().filter(|_| !model.starts.is_empty()) {
        values.insert(format!("{}_before", drive.name), format!("is where `{}` comes from", drive.name));
    }
    let params = model.params.iter().map(|param| (&param.name, vec![param.name.text.clone()]));
    let drives = model.drives.iter().map(|drive| {
        let motion = drive.given_motion(&model.graph).filter(|_| model.moves());
        let motion = motion.map(|order| drive.motion_name(order));
        (&drive.name, core::iter::once(drive.name.text.clone()).chain(motion).collect::<Vec<_>>())
    });
    let loads = model.loads.iter().map(|load| {
        let values = load.kind.given(model).map(|value| load.value_name(value));
        (&load.name, values.collect())
    });
    let mut claim = |name: &Name, made: String, meaning: String| {
        if let Some(other) = values.insert(made.clone(), meaning) {
            let problem = format!("the generated functions would have two values `{made}`: the other one {other}");
            sink.report(Diagnostic::new(name.place(), problem).help("choose another name"));
        }
    };
    for inverse in model.inverses.iter().filter(|_| !model.params.is_empty()) {
        claim(&inverse.name, inverse.prepared_name(), format!("is what is prepared for `{}`", inverse.name));
    }
    for (name, made) in params.chain(drives).chain(loads) {
        for made in made {
            let meaning = if made == name.text { "has that name".into() } else { format!("belongs to `{name}`") };
            claim(name, made, meaning);
        }
    }
}
