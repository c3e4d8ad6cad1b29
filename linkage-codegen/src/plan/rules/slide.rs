//! One link on one slide: a driven piston, or for forces a link that an unknown holds.
//!
//! * Position: the link turns with the slide's other link; the drive is its travel.
//! * Force: along the slide the sum of the forces gives the unknown, across it the normal force; the moment gives the couple.

use super::{Rule, RuleResult};
use crate::graph::{Expr, Vector};
use crate::model::ids::{GROUND, JointId, LinkId, UnknownId};
use crate::model::{End, JointKind, Model, UnknownKind};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::placement::Placement;
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Group, Input};

/// The rule.
pub(super) struct Slide;

/// The link, its slide and what closes it.
fn parts(model: &Model, group: &Group) -> Option<(LinkId, JointId, Input)> {
    match (group.links.as_slice(), group.outer.as_slice(), group.inputs.as_slice()) {
        ([link], [slide], [input]) if matches!(model.joint(*slide).kind, JointKind::Prismatic { .. }) => {
            Some((*link, *slide, *input))
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
        let orientation = assembly.placement.along_slide(slide, link);
        assembly.placement.orient(link, orientation);
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
        let equation = format!("±ΣF of what acts on {name} along the slide {}", joint.name);
        let across = match force_on(balance.placement, unknown) {
            None => {
                // The effort acts along the slide: on the second link forwards, on the first one backwards.
                let value = if second { -total.x } else { total.x }.named(balance.name(effort), equation);
                balance.found(unknown, value);
                let (far, on_far) = if second { (joint.from.link, -value) } else { (joint.to.link, value) };
                let along = Vector::new(on_far, balance.graph().zero());
                let at = balance.placement.slide_point(slide, far);
                balance.push(far, at, Framed { components: along, axes: direction });
                total.y
            }
            Some((at, along)) => {
                let pivot = format!("cos_{effort}");
                let cosine = balance.pivots.dividing_cosine(direction, along.ground(), &pivot, &name.text);
                let value = (-total.x / cosine).named(balance.name(effort), equation);
                balance.found(unknown, value);
                let force = Framed { components: along.components.scaled(value), axes: along.axes };
                balance.push(link, at, force);
                total.y + force.along(direction).y
            }
        };
        let own = balance.placement.point(balance.end(slide, link));
        guide(balance, slide, link, across, own);
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some((link, slide, Input::Unknown(unknown))) = parts(model, group) else { return Ok(()) };
        let joint = model.joint(slide);
        let far = if joint.to.link == link { joint.from.link } else { joint.to.link };
        let direction = motion.placement.slide_direction(slide);
        let at = motion.placement.slide_point(slide, link);
        // The link moves with the other one, and along it.
        let rate = motion.rate(far);
        let carried = motion.of_place(far, motion.placement.slide_point(slide, far));
        let own = motion.rate_of(unknown);
        let ground = motion.placement.direction(GROUND);
        let sliding = match force_on(motion.placement, unknown) {
            None => {
                if joint.to.link == link {
                    own
                } else {
                    -own
                }
            }
            Some((place, along)) => {
                let pivot = format!("cos_{}", model.unknown(unknown).name);
                let cosine =
                    motion.pivots.dividing_cosine(direction, along.ground(), &pivot, &model.link(link).name.text);
                let turning = (place - at).perp().scaled(rate);
                let turning = Framed { components: turning, axes: motion.placement.direction(link) };
                let before = carried.plus(&turning, ground);
                (own - before.along(along.axes).dot(along.components)) / cosine
            }
        };
        let meaning = format!("speed of {} along the slide {}", model.link(link).name, joint.name);
        let sliding = sliding.named(motion.name(&format!("speed_{}", joint.name)), meaning);
        let along = Framed { components: Vector::new(sliding, motion.graph().zero()), axes: direction };
        motion.found(link, Twist { rate, at, velocity: carried.plus(&along, ground) });
        Ok(())
    }
}

/// The reaction of a slide: its normal force holds the force `across` that acts on the link, its couple the moments on it. These are
/// taken about a place near the forces, and carried over to the runner, which may be far away along the slide.
pub(super) fn guide<'m>(
    balance: &mut Balance<'m, '_>,
    slide: JointId,
    link: LinkId,
    across: Expr<'m>,
    about: Vector<'m>,
) {
    let model = balance.model();
    let (joint, name) = (&model.joint(slide).name, &model.link(link).name);
    let runner = balance.placement.slide_point(slide, link);
    let arm = (about - runner).dot(balance.placement.slide_along(slide));
    let one = balance.graph().one();
    let moment = balance.moment(link, about, one) + arm * across;
    let second = model.joint(slide).to.link == link;
    let (normal, couple) = if second { (-across, -moment) } else { (across, moment) };
    let normal = normal.named(
        balance.name(&format!("{joint}_normal")),
        format!("±ΣF of what acts on {name} across the slide {joint}"),
    );
    let couple = couple.named(balance.name(&format!("{joint}_couple")), format!("±ΣM({joint}) of what acts on {name}"));
    let axes = balance.placement.slide_direction(slide);
    let force = Framed { components: Vector::new(balance.graph().zero(), normal), axes };
    balance.slide(slide, link, force, couple);
}

/// The velocity that a point of a slider has in so far as it moves with its guide: `v + ω r⊥`, without the sliding.
pub(super) fn carried<'m>(motion: &Motion<'m, '_>, slide: JointId, link: LinkId, point: End) -> Framed<'m> {
    let placement = motion.placement;
    let joint = motion.model().joint(slide);
    let guide = if joint.to.link == link { joint.from.link } else { joint.to.link };
    let guided = motion.of_place(guide, placement.slide_point(slide, guide));
    let arm = placement.point(point) - placement.slide_point(slide, link);
    let turning = Framed { components: arm.perp().scaled(motion.rate(guide)), axes: placement.direction(link) };
    guided.plus(&turning, placement.direction(GROUND))
}

/// The place and the direction of an unknown force; `None` for the effort at the slide itself.
fn force_on<'m>(placement: &Placement<'m>, unknown: UnknownId) -> Option<(Vector<'m>, Framed<'m>)> {
    let UnknownKind::Force { at, along, frame } = placement.model.unknown(unknown).kind else { return None };
    let components = placement.carried(frame, along.vector(placement.graph()));
    Some((placement.point(at), Framed { components, axes: placement.direction(frame) }))
}
