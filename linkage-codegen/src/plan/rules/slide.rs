//! One link on one slide: a driven piston, or for forces a link that an unknown holds.
//!
//! * Position: the link turns with the slide's other link; the drive is its travel.
//! * Force: along the slide the sum of the forces gives the unknown, across it the normal force; the moment gives the couple.

use super::{Rule, RuleResult};
use crate::graph::{Expr, Vector};
use crate::model::ids::{GROUND, JointId, LinkId};
use crate::model::{JointKind, Model, UnknownKind};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::efforts::Unit;
use crate::plan::framed::Framed;
use crate::plan::pivots::Pivots;
use crate::plan::placement::Placement;
use crate::plan::velocities::Motion;
use crate::topology::{Freedom, Group, Input};

/// The rule.
pub(super) struct Slide;

/// The link, its slide and what closes it. A slot that is driven both ways is a slide that turns.
fn parts(model: &Model, group: &Group) -> Option<(LinkId, JointId, Input)> {
    let (&[link], &[slide]) = (group.links.as_slice(), group.outer.as_slice()) else { return None };
    match (model.joint(slide).kind, group.inputs.as_slice()) {
        (JointKind::Prismatic { .. }, &[input]) => Some((link, slide, input)),
        (JointKind::Slot { .. }, _) if group.freedom(model, slide) == Freedom::None => {
            let travel = |input: &Input| Group::drive_of(model, *input).is_some_and(|drive| !model.drive(drive).turns);
            Some((link, slide, group.inputs.iter().copied().find(travel)?))
        }
        _ => None,
    }
}

impl Rule for Slide {
    fn class(&self) -> &'static str {
        "link on a slide"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        parts(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some((link, slide, Input::Drive(drive))) = parts(assembly.model(), group) else { return Ok(()) };
        assembly.placement.orient_along(slide, link);
        let travel = assembly.coordinate(drive);
        assembly.placement.set_travel(slide, travel);
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let model = balance.model();
        let Some((link, slide, Input::Unknown(unknown))) = parts(model, group) else { return Ok(()) };
        let joint = model.joint(slide);
        let second = joint.to.link == link;
        let direction = balance.placement.slide_direction(slide);
        let total = balance.total(link).along(direction);
        let (name, effort) = (&model.link(link).name, &model.unknown(unknown).name);
        let sum = format!("ΣF of what acts on {name} along the slide {}", joint.name);
        let unit = Unit::of(balance.placement, unknown);
        let across = if let UnknownKind::Drive(_) = model.unknown(unknown).kind {
            // The effort acts along the slide: on the second link forwards, on the first one backwards. It turns nothing.
            let (value, sign) = if second { (-total.x, "−") } else { (total.x, "") };
            let value = value.named(balance.name(effort), format!("{sign}{sum}"));
            balance.found(unknown, value);
            unit.exert_outside(balance, value, &[link]);
            total.y
        } else {
            let along = unit.force_on(link, balance.placement.direction(GROUND));
            let cosine = dividing_cosine(balance.placement, balance.pivots, unknown.into(), &unit, slide, link);
            let value = (-total.x / cosine).named(balance.name(effort), format!("−{sum}, over the cosine"));
            balance.found(unknown, value);
            unit.exert_outside(balance, value, &[]);
            let force = Framed { components: along.components.scaled(value), axes: along.axes };
            total.y + force.along(direction).y
        };
        let own = balance.placement.point(balance.placement.counted_from(slide, link));
        guide(balance, slide, link, across, own);
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some((link, slide, input)) = parts(model, group) else { return Ok(()) };
        // The link moves with the other one, and along it.
        motion.found(link, motion.carried(slide, link));
        let own = motion.rate_of(input);
        let unit = Unit::of(motion.placement, input);
        let sliding = if let UnknownKind::Drive(_) = input.effort(model) {
            if model.joint(slide).to.link == link { own } else { -own }
        } else {
            let cosine = dividing_cosine(motion.placement, motion.pivots, input, &unit, slide, link);
            // The power of the unit on all links is the rate of its coordinate: on this one, as if it did not slide.
            (own - unit.power_outside(motion, &[link]) - unit.power_on(motion, link)) / cosine
        };
        let sliding = motion.named_sliding(sliding, slide, &model.link(link).name.text, "");
        motion.slides(slide, link, sliding);
        Ok(())
    }
}

/// The reaction of a slide: its normal force holds the force `across` that acts on the link, its couple the moments on it. These are
/// taken about a place near the forces, and carried over to that of the slide.
pub(super) fn guide<'m>(
    balance: &mut Balance<'m, '_>,
    slide: JointId,
    link: LinkId,
    across: Expr<'m>,
    about: Vector<'m>,
) {
    let ahead = balance.placement.ahead_of_slide(slide, link, about);
    let moment = balance.moment(link, about, balance.graph().one());
    react(balance, slide, link, across, (moment, ahead));
}

/// The reaction of a slide that holds the force `across` on a link and its moment, about a place that is so far ahead of the slide's. The couple
/// is about the runner, which may be far away along the slide.
pub(super) fn react<'m>(
    balance: &mut Balance<'m, '_>,
    slide: JointId,
    link: LinkId,
    across: Expr<'m>,
    (moment, ahead): (Expr<'m>, Expr<'m>),
) {
    let model = balance.model();
    let (joint, name) = (&model.joint(slide).name, &model.link(link).name);
    let second = model.joint(slide).to.link == link;
    let couple_name = match (model.joint(slide).kind, model.effort_of(slide, true)) {
        (JointKind::Slot { .. }, Some(effort)) => model.unknown(effort).name.clone(),
        _ => format!("{joint}_couple"),
    };
    let from_runner = balance.placement.ahead_of_runner(slide);
    let signed = |part: Expr<'m>| if second { -part } else { part };
    let sign = if second { "−" } else { "" };
    let (normal, couple) = (signed(across), signed(moment + (ahead + from_runner) * across));
    let normal = normal.named(
        balance.name(&format!("{joint}_normal")),
        format!("{sign}ΣF of what acts on {name} across the slide {joint}"),
    );
    let couple = couple.named(balance.name(&couple_name), format!("{sign}ΣM({joint}) of what acts on {name}"));
    let axes = balance.placement.slide_direction(slide);
    let force = Framed { components: Vector::new(balance.graph().zero(), normal), axes };
    let at_place = if from_runner.is_zero() { couple } else { signed(moment + ahead * across) };
    balance.slide(slide, link, force, [couple, at_place]);
}

/// The cosine between a slide and an unknown force on its link, as a divisor.
fn dividing_cosine<'m>(
    placement: &Placement<'m>,
    pivots: &Pivots<'m>,
    input: Input,
    unit: &Unit<'m>,
    slide: JointId,
    link: LinkId,
) -> Expr<'m> {
    let model = placement.model;
    let along = unit.force_on(link, placement.direction(GROUND)).ground();
    let (pivot, name) = (format!("cos_{}", input.name(model)), &model.link(link).name.text);
    pivots.dividing_cosine(placement.slide_direction(slide), along, unit.spread, &pivot, name)
}
