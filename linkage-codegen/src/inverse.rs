//! Inverse scenes: the linkage once more, driven where a motion is wanted.
//!
//! Wanted coordinates and drives change places, and the linkage goes the whole road again: it falls into other groups, each solved by its
//! rule. A group of it closes on a side like any other: what `assemble` says at its inner joint.

use std::collections::BTreeSet;

use crate::Linkage;
use crate::diagnostics::{Diagnostic, Sink};
use crate::equations::System;
use crate::limits::Limits;
use crate::model::ids::JointId;
use crate::model::{Inverse, Model};
use crate::plan::{Plan, rules};
use crate::program::{self, Functions};
use crate::syntax::ast::Ast;
use crate::topology::Topology;

/// A linkage that is driven where an inverse scene wants a motion.
pub(crate) struct Exchanged<'a> {
    inverse: &'a Inverse,
    model: Model,
    topology: Topology,
}

/// The linkage, once for each inverse scene. `None` if one cannot be driven so; why is reported.
pub(crate) fn exchanged<'a>(
    ast: &Ast,
    model: &'a Model,
    topology: &Topology,
    sink: &Sink,
) -> Option<Vec<Exchanged<'a>>> {
    let all = model.inverses.iter().map(|inverse| {
        let refusals = Sink::default();
        let mut other = model.exchanged(ast, inverse, topology.sides(model), &refusals);
        let found = if refusals.is_clean() { Topology::of(&other, &refusals) } else { None };
        let own = found.as_ref().map(|found| found.sides(&other)).unwrap_or_default();
        if let Some(exchanged) = &mut other.exchanged {
            exchanged.own = own;
        }
        if let Some(found) = &found {
            check_closed_forms(&other, found, inverse, &refusals);
            check_folds(model, &other, (topology, found), inverse, &refusals);
        }
        tell(refusals, inverse, sink);
        Some(Exchanged { inverse, model: other, topology: found? })
    });
    let all: Vec<_> = all.collect();
    all.into_iter().collect::<Option<Vec<_>>>().filter(|_| sink.is_clean())
}

/// The joints at which these linkages may close in two ways.
pub(crate) fn closing(exchanged: &[Exchanged<'_>]) -> BTreeSet<JointId> {
    exchanged.iter().flat_map(|other| other.topology.closing(&other.model)).collect()
}

/// The solutions of these linkages, once that of the declaration is known.
pub(crate) fn solved(exchanged: Vec<Exchanged<'_>>, model: &Model, sink: &Sink) -> Option<Vec<Linkage>> {
    let searched = !model.graph.searches().is_empty();
    let all = exchanged.into_iter().map(|Exchanged { inverse, model, topology }| {
        if searched {
            let problem = "the inverse is not supported yet where links are placed by iteration";
            let note = "to which branch a pose belongs is known of groups in closed form alone";
            sink.report(Diagnostic::new(inverse.method.place(), problem).note(note));
            return None;
        }
        let refusals = Sink::default();
        let system = System::of(&model, &topology);
        let plan = Plan::of(&model, &topology, &system, &BTreeSet::new(), &refusals);
        let linkage = plan.map(|plan| {
            let functions = Functions::of(&model, &plan);
            program::check_range(&model, &functions, &refusals);
            let (limits, inverses) = (Limits { loops: Vec::new(), prepare: None }, Vec::new());
            Linkage { model, topology, system, plan, functions, limits, unposed: Vec::new(), inverses }
        });
        tell(refusals, inverse, sink);
        linkage
    });
    let all: Vec<_> = all.collect();
    all.into_iter().collect()
}

/// What is wrong with the linkage as it is driven for an inverse scene.
fn tell(refusals: Sink, inverse: &Inverse, sink: &Sink) {
    let wanted: Vec<String> = inverse.wanted.iter().map(|(name, _)| format!("`{name}`")).collect();
    for error in refusals.into_errors() {
        let note = format!("for the scene `{}` the linkage is placed from {}", inverse.name, wanted.join(" and "));
        sink.report(error.note(note));
    }
}

/// All groups have closed forms.
fn check_closed_forms(model: &Model, topology: &Topology, inverse: &Inverse, sink: &Sink) {
    for group in &topology.motion {
        if rules::rule_of(model, group).is_some_and(rules::Rule::is_closed) {
            continue;
        }
        let problem = format!("the inverse has no closed form: {} are placed together", model.link_names(&group.links));
        sink.report(
            Diagnostic::new(inverse.method.place(), problem)
                .help("ask for the motion of a joint from which the linkage is placed one dyad after the other"),
        );
    }
}

/// On which side a group lies that folds depends on the drives.
fn check_folds(model: &Model, other: &Model, (own, exchanged): (&Topology, &Topology), inverse: &Inverse, sink: &Sink) {
    let closing = exchanged.closing(other);
    for side in own.sides(model) {
        let closure = model.closure(side.closure);
        if closure.smooth_at.is_some() && !closing.contains(&closure.joint) {
            let problem = "the inverse is not supported yet where a group folds smoothly";
            let joint = &model.joint(closure.joint).name;
            let note = format!("on which side `{joint}` lies depends on the drive that is asked for");
            sink.report(Diagnostic::new(inverse.method.place(), problem).note(note));
        }
    }
}
