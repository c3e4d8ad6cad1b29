//! Gear pairs: their dimensions, and the link that keeps their centres apart.

use super::NOWHERE;
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, NodeId, Vector};
use crate::model::evaluate::Scope;
use crate::model::ids::{JointId, LinkId};
use crate::model::units::Kind;
use crate::model::{End, Gear, JointKind, Model};
use crate::syntax::ast::{self, Ast, Item};

/// The dimensions of a gear pair. Its arm is looked for when all joints are known.
pub(super) fn gear(scope: Scope<'_>, given: &ast::Joint, ends: [Option<End>; 2]) -> Result<JointKind, Diagnostic> {
    let graph = &scope.model.graph;
    let Some(radii) = given.gear.radii.as_ref() else { return Ok(stand_in(scope.model)) };
    let [first, second] = [scope.scalar(&radii[0], Kind::Length)?, scope.scalar(&radii[1], Kind::Length)?];
    for (radius, value) in [first, second].into_iter().zip(radii) {
        if radius.sign().is_some_and(|sign| sign <= 0) {
            return Err(Diagnostic::new(value.place, "the radius of a wheel is positive")
                .help("where the first wheel is a ring that runs round the second one, write `internal`"));
        }
    }
    let ring = given.gear.internal;
    if ring && (first - second).sign().is_some_and(|sign| sign <= 0) {
        let problem = format!("the ring of `{}` is no larger than the wheel in it", given.name);
        return Err(Diagnostic::new(radii[0].place.to(radii[1].place), problem)
            .help("of an internal pair the first link is the ring"));
    }
    let phase = match &given.gear.phase {
        Some(value) => scope.scalar(value, Kind::Length)?,
        None => graph.zero(),
    };
    let arm = ends.map(|end| end.unwrap_or(NOWHERE));
    // What depends on parameters is checked when they are given.
    let name = &given.name;
    let failure = |requirement: String| Failure::Parameter { requirement };
    let [first, second] = [first, second]
        .map(|radius| radius.required_positive(format!("{name}: the radius of a wheel must be positive")));
    let first = if ring {
        let requirement = format!("{name}: the ring must be larger than the wheel in it");
        let checked = first.require_above(first, second, failure(requirement));
        if checked.value().is_some() { checked } else { checked.known_positive() }
    } else {
        first
    };
    let second = if ring { -second } else { second };
    let radii = [first.id(), second.id()];
    Ok(JointKind::Gear(Gear { radii, phase: phase.id(), incline: incline(scope, given)?.id(), arm }))
}

/// The tangent of the pressure angle with the sign of the flank.
fn incline<'m>(scope: Scope<'m>, given: &ast::Joint) -> Result<Expr<'m>, Diagnostic> {
    let sense = match &given.gear.flank {
        None => None,
        Some(word) if word.text == "left" => Some(1),
        Some(word) if word.text == "right" => Some(-1),
        Some(word) => {
            return Err(Diagnostic::new(word.place(), format!("there is no flank `{word}`"))
                .suggest(&word.text, ["left", "right"]));
        }
    };
    match (&given.gear.pressure_angle, sense, &given.gear.flank) {
        (Some(value), Some(sense), _) => {
            let angle = scope.scalar(value, Kind::Angle)?;
            let quarter = scope.model.graph.constant(&Number::pi(1, 2));
            let beyond = angle.sign() == Some(-1) || (quarter - angle).sign().is_some_and(|sign| sign <= 0);
            if beyond {
                return Err(Diagnostic::new(value.place, "a pressure angle lies between 0 and 90°")
                    .help("on which side it inclines the tooth force is said by `flank left` or `flank right`"));
            }
            let requirement = format!("{}: its pressure angle must lie between 0 and 90°", given.name);
            let failure = || Failure::Parameter { requirement: requirement.clone() };
            let angle = angle.require_at_least(angle, scope.model.graph.zero(), failure());
            let angle = angle.require_above(quarter, angle, failure());
            let Vector { x, y } = angle.direction();
            Ok(sense * (y / x))
        }
        (Some(value), None, _) => Err(Diagnostic::new(value.place, "which flanks of the teeth touch?")
            .note("a positive tooth force pushes the second wheel away from the first on the left flank, and pulls it on the right one")
            .help("write `flank left` or `flank right` behind the pressure angle")),
        (None, Some(_), Some(word)) => Err(Diagnostic::new(word.place(), "without a pressure angle both flanks are alike")
            .help("write `pressure_angle 20deg` before it, or leave the flank out")),
        _ => Ok(scope.model.graph.zero()),
    }
}

/// A gear pair of which nothing is known.
pub(super) fn stand_in(model: &Model) -> JointKind {
    let (one, zero) = (model.graph.one().id(), model.graph.zero().id());
    JointKind::Gear(Gear { radii: [one, one], phase: zero, incline: zero, arm: [NOWHERE, NOWHERE] })
}

/// For every gear pair, the link that keeps the centres of its wheels apart.
pub(super) fn arms(model: &mut Model, ast: &Ast, sink: &Sink) {
    if !sink.is_clean() {
        return;
    }
    for id in model.joint_ids() {
        let JointKind::Gear(gear) = model.joint(id).kind else { continue };
        match arm(model, id) {
            Some(arm) => {
                let gear = Gear { arm, ..gear };
                check_distance(model, ast, id, &gear, sink);
                let gear = Gear { radii: filling(model, id, &gear), ..gear };
                model.joints[id.index()].kind = JointKind::Gear(gear);
            }
            None => sink.report(loose(model, id)),
        }
    }
}

/// The link that has both centres: where pins keep a point of it.
fn arm(model: &Model, gear: JointId) -> Option<[End; 2]> {
    let wheels = model.joint(gear).ends();
    let [first, second] = wheels.map(|wheel| places(model, wheel));
    let on = |places: &[End], arm: LinkId| places.iter().find(|end| end.link == arm).copied();
    let arms = (0..model.links.len()).map(LinkId::new).filter(|arm| wheels.iter().all(|wheel| wheel.link != *arm));
    arms.into_iter().find_map(|arm| Some([on(&first, arm)?, on(&second, arm)?]))
}

/// All points that are always where this one is: at the same place of its link, or pinned to one that is.
fn places(model: &Model, point: End) -> Vec<End> {
    let mut all = vec![point];
    let mut next = 0;
    while let Some(at) = all.get(next).copied() {
        next += 1;
        let joined = model.joints.iter().filter_map(|joint| {
            let (near, far) = (joint.end_on(at.link)?, joint.end_off(at.link)?);
            let pins = matches!(joint.kind, JointKind::Revolute | JointKind::Weld { .. });
            (pins && model.local(near) == model.local(at)).then_some(far)
        });
        for end in joined {
            if !all.contains(&end) {
                all.push(end);
            }
        }
    }
    all
}

fn loose(model: &Model, gear: JointId) -> Diagnostic {
    let joint = model.joint(gear);
    let [first, second] = joint.ends().map(|end| model.end_name(end));
    let problem = format!("no link keeps the wheels of `{}` at their distance", joint.name);
    Diagnostic::new(joint.name.place(), problem)
        .note("a wheel that leaves the other one is not supported")
        .help(format!("pin both to one link or to the ground, at their centres `{first}` and `{second}`"))
}

/// The radii, checked to fill the distance of the centres when the parameters are given on which that depends.
fn filling(model: &Model, id: JointId, gear: &Gear) -> [NodeId; 2] {
    let distance = gear.distance(model);
    let [first, second] = gear.radii.map(|radius| model.graph.expr(radius));
    let apart = 100 * (distance - (first + second)).abs();
    if (distance - apart).value().is_some() {
        return gear.radii;
    }
    let requirement = format!(
        "{}: the radii of its wheels must fill the distance of their centres to a hundredth",
        model.joint(id).name
    );
    // The wheel in a ring has the opposite of a positive radius, known or given.
    let ring = model.graph.is_positive(-second);
    let [first, second] = [first, if ring { -second } else { second }].map(|radius| {
        let failure = Failure::Parameter { requirement: requirement.clone() };
        radius.require_at_least(distance, apart, failure).known_positive()
    });
    let second = if ring { -second } else { second };
    // A ring is larger than its wheel.
    let _ = (first + second).known_positive();
    [first.id(), second.id()]
}

/// Radii that do not fill the distance of the centres are a slip, where they are known.
fn check_distance(model: &Model, ast: &Ast, id: JointId, gear: &Gear, sink: &Sink) {
    let distance = gear.distance(model);
    let name = &model.joint(id).name;
    let given = ast.items.iter().find_map(|item| match item {
        Item::Joint(joint) if joint.name.text == name.text => joint.gear.radii.as_ref(),
        _ => None,
    });
    let place = given.map_or(name.place(), |[first, second]| first.place.to(second.place));
    if distance.is_zero() {
        sink.report(Diagnostic::new(place, format!("the wheels of `{name}` have one centre")));
        return;
    }
    let [first, second] = gear.radii.map(|radius| model.graph.expr(radius));
    // A hundredth is more than decimals and shifted profiles make of it.
    let apart = 100 * (distance - (first + second)).abs() - distance;
    if apart.sign() == Some(1) {
        let shown = |value: Expr<'_>| value.value().map_or(0.0, |number| number.to_f64());
        let unit = model.units.length.name;
        let (word, filled) =
            if second.sign() == Some(-1) { ("differ by", first + second) } else { ("add up to", first + second) };
        let problem = format!(
            "the radii of `{name}` {word} {} {unit}, and its centres are {} {unit} apart",
            shown(filled),
            shown(distance)
        );
        sink.report(
            Diagnostic::new(place, problem)
                .help("the circles that roll on each other touch: change a radius, or the place of a centre"),
        );
    }
}
