//! One link on one pin: a driven crank, or for forces a link that an unknown holds.
//!
//! * Position: the drive gives the direction; where a dyad hangs on both links of the pin, by the half angle.
//! * Force: the moment about the pin gives the unknown, the sum of the forces the reaction.

use super::{Rule, RuleResult};
use crate::graph::{Expr, Vector};
use crate::model::ids::{JointId, LinkId, UnknownId};
use crate::model::{JointKind, Model, UnknownKind};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::half_angle::{HalfAngle, first_dyad_on};
use crate::plan::pivots::divisor;
use crate::plan::placement::{Orientation, Placement};
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Group, Input};

/// The rule.
pub(super) struct Crank;

/// The link, its pin and what closes it.
fn parts(model: &Model, group: &Group) -> Option<(LinkId, JointId, Input)> {
    match (group.links.as_slice(), group.outer.as_slice(), group.inputs.as_slice()) {
        ([link], [pin], [input]) if matches!(model.joint(*pin).kind, JointKind::Revolute) => {
            Some((*link, *pin, *input))
        }
        _ => None,
    }
}

impl Rule for Crank {
    fn class(&self) -> &'static str {
        "link on a pin"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        parts(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let model = assembly.model();
        let Some((link, pin, Input::Drive(drive))) = parts(model, group) else { return Ok(()) };
        let (name, drive_name) = (&model.link(link).name, &model.drive(drive).name);
        let arms =
            first_dyad_on(assembly, drive, link).and_then(|(moved, other)| HalfAngle::between(assembly, moved, other));
        let orientation = match &arms {
            Some(arms) => Orientation { direction: arms.moved_direction(), axis: arms.arm },
            None => assembly.placement.driven(pin, link, assembly.coordinate(drive)),
        };
        let meaning = format!("direction of {name}, from {drive_name}");
        let direction = orientation.direction.named_direction(&name.text, &meaning);
        if let Some(arms) = arms {
            arms.name_whole();
        }
        assembly.placement.orient(link, Orientation { direction, ..orientation });
        assembly.placement.connect(pin);
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let model = balance.model();
        let Some((link, pin, Input::Unknown(unknown))) = parts(model, group) else { return Ok(()) };
        let about = balance.placement.point(balance.end(pin, link));
        let (name, point) = (&model.link(link).name, &model.joint(pin).name);
        let one = balance.graph().one();
        let moment = balance.moment(link, about, one);
        let effort = &model.unknown(unknown).name;
        let total = balance.total(link);
        match torque_links(model, unknown) {
            Some((from, to)) => {
                let torque = if to == link { -moment } else { moment };
                let torque = torque.named(
                    balance.name(effort),
                    format!("{}ΣM({point}) of what acts on {name}", if to == link { "−" } else { "" }),
                );
                balance.found(unknown, torque);
                let (other, on_other) = if to == link { (from, -torque) } else { (to, torque) };
                balance.couple(other, on_other);
                balance.pin(pin, link, total.opposite());
            }
            None => {
                let Some((along, arm)) = line_of_force(balance.placement, unknown, about) else { return Ok(()) };
                let arm = significant_arm(model, unknown, arm, pin, name.text.as_str());
                let force =
                    (-moment / arm).named(balance.name(effort), format!("−ΣM({point})/arm of what acts on {name}"));
                balance.found(unknown, force);
                let along = Framed { components: along.components.scaled(force), axes: along.axes };
                let ground = balance.placement.direction(crate::model::ids::GROUND);
                balance.pin(pin, link, total.plus(&along, ground).opposite());
            }
        }
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some((link, pin, Input::Unknown(unknown))) = parts(model, group) else { return Ok(()) };
        let data = model.joint(pin);
        let (Some(near), Some(far)) = (data.end_on(link), data.end_off(link)) else { return Ok(()) };
        let about = motion.placement.point(near);
        let velocity = motion.of_point(far);
        let own_rate = motion.rate_of(unknown);
        let name = &model.link(link).name;
        let rate = match torque_links(model, unknown) {
            Some((from, to)) => {
                if to == link {
                    motion.rate(from) + own_rate
                } else {
                    motion.rate(to) - own_rate
                }
            }
            None => {
                let Some((along, arm)) = line_of_force(motion.placement, unknown, about) else { return Ok(()) };
                let arm = significant_arm(model, unknown, arm, pin, name.text.as_str());
                (own_rate - velocity.along(along.axes).dot(along.components)) / arm
            }
        };
        let rate = rate.named(motion.name(&format!("rate_{name}")), format!("rate of rotation of {name}"));
        motion.found(link, Twist { rate, at: about, velocity });
        Ok(())
    }
}

/// The links between which an unknown torque acts.
pub(super) fn torque_links(model: &Model, unknown: UnknownId) -> Option<(LinkId, LinkId)> {
    match model.unknown(unknown).kind {
        UnknownKind::Torque(from, to) => Some((from, to)),
        UnknownKind::Drive(drive) => {
            let joint = model.joint(model.drive(drive).joint);
            matches!(joint.kind, JointKind::Revolute).then_some((joint.from.link, joint.to.link))
        }
        UnknownKind::Force { .. } => None,
    }
}

/// The direction of an unknown force, and its lever arm about a place of the link on which it acts.
fn line_of_force<'m>(
    placement: &Placement<'m>,
    unknown: UnknownId,
    about: Vector<'m>,
) -> Option<(Framed<'m>, Expr<'m>)> {
    let UnknownKind::Force { at, along, frame } = placement.model.unknown(unknown).kind else { return None };
    let along = along.vector(placement.graph());
    let along = Framed { components: placement.carried(frame, along), axes: placement.direction(frame) };
    let arm = (placement.point(at) - about).cross(along.along(placement.direction(at.link)));
    Some((along, arm))
}

/// The lever arm as a divisor: too small beside the distance of its points, it is none.
fn significant_arm<'m>(model: &'m Model, unknown: UnknownId, arm: Expr<'m>, pin: JointId, link: &str) -> Expr<'m> {
    let name = format!("arm_{}", model.unknown(unknown).name);
    let (effort, point) = (&model.unknown(unknown).name, &model.joint(pin).name);
    let arm = arm.named(name.clone(), format!("lever arm of {effort} about {point}"));
    let UnknownKind::Force { at, .. } = model.unknown(unknown).kind else { return arm };
    let near = model.joint(pin).end_on(at.link).unwrap_or(at);
    let size = model.distance(at.link, near.point, at.point);
    let rounding = model.graph.epsilons(8) * size;
    divisor(arm.where_above(arm.abs(), rounding), &name, link)
}
