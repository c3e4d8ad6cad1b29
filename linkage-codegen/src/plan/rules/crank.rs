//! One link on one pin: a driven crank, or for forces a link that an unknown holds.
//!
//! * Position: the drive gives the direction; where a dyad hangs on both links of the pin, by the half angle.
//! * Force: the moment about the pin gives the unknown, the sum of the forces the reaction.

use super::{Rule, RuleResult};
use crate::graph::Expr;
use crate::model::ids::{GROUND, JointId, LinkId};
use crate::model::{JointKind, Model};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::efforts::{Unit, point_on};
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
        let joint = model.joint(pin);
        let (other, sense) = if joint.to.link == link { (joint.from.link, 1) } else { (joint.to.link, -1) };
        // To wheels all turns of the drive count, wherever the other link's own angle lies.
        let from = assembly.placement.unwrapped_angle(other);
        if let Some(from) = from.or_else(|| model.has_gears().then(|| assembly.placement.angle(other))) {
            assembly.placement.set_angle(link, from + sense * assembly.coordinate(drive));
        }
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
        let unit = Unit::of(balance.placement, unknown);
        let arm = significant_arm(balance.placement, unknown.into(), &unit, pin, link);
        let (sign, over) = match arm.sign() {
            None => ("−", "/arm"),
            Some(sign) => (if sign > 0 { "−" } else { "" }, ""),
        };
        let value =
            (-moment / arm).named(balance.name(effort), format!("{sign}ΣM({point}){over} of what acts on {name}"));
        balance.found(unknown, value);
        unit.exert_outside(balance, value, &[link]);
        let ground = balance.placement.direction(GROUND);
        let own = unit.force_on(link, ground);
        let own = Framed { components: own.components.scaled(value), axes: own.axes };
        balance.pin(pin, link, total.plus(&own, ground).opposite());
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some((link, pin, input)) = parts(model, group) else { return Ok(()) };
        let data = model.joint(pin);
        let (Some(near), Some(far)) = (data.end_on(link), data.end_off(link)) else { return Ok(()) };
        let about = motion.placement.point(near);
        let velocity = motion.of_point(far);
        let name = &model.link(link).name;
        let unit = Unit::of(motion.placement, input);
        let arm = significant_arm(motion.placement, input, &unit, pin, link);
        // The power of the unit on all links is the rate of its coordinate.
        let own = unit.force_on(link, motion.placement.direction(GROUND));
        let carried = velocity.along(own.axes).dot(own.components);
        let rate = (motion.rate_of(input) - unit.power_outside(motion, &[link]) - carried) / arm;
        let rate = motion.named_rate(rate, &name.text, "");
        motion.found(link, Twist { rate, at: about, velocity });
        Ok(())
    }
}

/// The moment of the unit about the pin as a divisor. A lever arm that is too small beside the distance of its points is none.
fn significant_arm<'m>(
    placement: &Placement<'m>,
    input: Input,
    unit: &Unit<'m>,
    pin: JointId,
    link: LinkId,
) -> Expr<'m> {
    let model = placement.model;
    let near = model.joint(pin).end_on(link).unwrap_or(model.joint(pin).from);
    let arm = unit.moment_on(link, placement, placement.point(near));
    let Some(at) = point_on(model, input, link) else { return arm };
    let (effort, point) = (input.name(model), &model.joint(pin).name);
    let name = format!("arm_{effort}");
    let arm = arm.named(name.clone(), format!("lever arm of {effort} about {point}"));
    let size = model.distance(link, near.point, at.point);
    let rounding = model.graph.epsilons(8) * size * unit.spread;
    divisor(arm.where_above(arm.abs(), rounding), &name, model.link(link).name.text.as_str())
}
