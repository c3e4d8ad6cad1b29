//! The RRP dyad: a link with pins at both ends, the inner one on a slider.
//!
//! With the outer pin A, the inner pin B, `r = |AB|`, the slide's direction e and its normal `n = e⊥`, and Q the vector from A to where B is
//! when the slide's travel is zero:
//!
//! ```text
//! g = e × Q      h = ±√((r − g)(r + g))      + where B is ahead of A
//! u = (h e + g n)/r                           direction A → B
//! travel = h − e·Q
//! ```
//!
//! Forces: with W the sum of the loads on the slider and m the moment of the link's loads about A, the force on the link at B is
//! `p e + f n`, `p = e·W`, and with `t = −m/r` across the link `f = (t − p (u × e))/(u·e)`. The guide exerts `N = f − n·W` across
//! the slide. `u·e = h/r` is the pivot: sin μ, with μ the angle between the link and the normal of the slide.

use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::graph::{Expr, Failure, Vector};
use crate::model::ids::{GROUND, JointId, LinkId};
use crate::model::{End, JointKind, Model, Side};
use crate::plan::assembly::{Assembly, DyadPivot};
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::placement::{Orientation, Placement, Way};
use crate::plan::velocities::{Motion, Twist};
use crate::topology::Group;

/// The rule.
pub(super) struct Rrp;

/// The parts of an RRP dyad.
struct Dyad<'a> {
    model: &'a Model,
    rod: LinkId,
    slider: LinkId,
    outer: JointId,
    inner: JointId,
    slide: JointId,
}

fn dyad<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let pinned = |joint: JointId| matches!(model.joint(joint).kind, JointKind::Revolute);
    let ([_, _], &[inner], &[a, b], []) = (&*group.links, &*group.inner, &*group.outer, &*group.inputs) else {
        return None;
    };
    let (outer, slide) = match (pinned(a), pinned(b)) {
        (true, false) => (a, b),
        (false, true) => (b, a),
        _ => return None,
    };
    let (rod, slider) = (group.own_link(model, outer), group.own_link(model, slide));
    (pinned(inner) && rod != slider).then_some(Dyad { model, rod, slider, outer, inner, slide })
}

impl<'a> Dyad<'a> {
    fn end(&self, joint: JointId, link: LinkId) -> End {
        let joint = self.model.joint(joint);
        joint.end_on(link).unwrap_or(joint.from)
    }

    fn length(&self) -> Expr<'a> {
        super::length_between(self.model, self.rod, [self.outer, self.inner])
    }

    /// The direction from the outer pin to the inner one in the rod's own frame.
    fn axis(&self) -> Vector<'a> {
        let (outer, inner) = (self.end(self.outer, self.rod), self.end(self.inner, self.rod));
        let (arm, length) = (self.model.local(inner) - self.model.local(outer), self.length());
        Vector::new(arm.x / length, arm.y / length)
    }

    fn direction(&self, placement: &Placement<'a>) -> Vector<'a> {
        placement.turned(self.rod, self.axis())
    }

    fn joint_name(&self, joint: JointId) -> &'a str {
        &self.model.joint(joint).name.text
    }

    fn link_name(&self, link: LinkId) -> &'a str {
        &self.model.link(link).name.text
    }

    fn group_name(&self) -> String {
        self.model.link_names(&[self.rod, self.slider])
    }

    fn pivot_name(&self) -> String {
        format!("sin_mu_{}", self.joint_name(self.inner))
    }
}

impl Rule for Rrp {
    fn class(&self) -> &'static str {
        "RRP dyad"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        dyad(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(dyad) = dyad(assembly.model(), group) else { return Ok(()) };
        close(assembly, group, &dyad)
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let model = balance.model();
        let Some(dyad) = dyad(model, group) else { return Ok(()) };
        super::check_length(model, dyad.rod, [dyad.outer, dyad.inner])?;
        let (rod, inner) = (dyad.link_name(dyad.rod), dyad.joint_name(dyad.inner));
        let (outer, slider) = (dyad.joint_name(dyad.outer), dyad.link_name(dyad.slider));
        let e = balance.placement.slide_direction(dyad.slide);
        let u = dyad.direction(balance.placement);
        let load = balance.total(dyad.slider).along(e);
        let about = balance.placement.point(dyad.end(dyad.outer, dyad.rod));
        let across = (-balance.moment(dyad.rod, about, balance.graph().one() / dyad.length())).named(
            balance.name(&format!("{inner}_across_{rod}")),
            format!("−ΣM({outer})/|{outer} {inner}| of the loads on {rod}"),
        );
        let along_slide = load.x.named(
            balance.name(&format!("{inner}_along_slide")),
            format!("ΣF of the loads on {slider} along the slide"),
        );
        let side = if across.is_zero() && along_slide.is_zero() {
            balance.graph().zero()
        } else {
            let cosine = balance.pivots.dividing_cosine(u, e, u.graph().one(), &dyad.pivot_name(), &dyad.group_name());
            let needed = across - along_slide * balance.pivots.sine(u, e);
            (needed / cosine).named(
                balance.name(&format!("{inner}_across_slide")),
                format!("({inner}_across_{rod} − {inner}_along_slide (u × e))/(u·e)"),
            )
        };
        let force = Framed { components: Vector::new(along_slide, side), axes: e };
        let ground = balance.placement.direction(GROUND);
        let loads = balance.total(dyad.rod);
        // The pin puts its part on the slider, whose moments give the couple of the guide.
        let force = balance.pin(dyad.inner, dyad.rod, force);
        balance.pin(dyad.outer, dyad.rod, loads.plus(&force, ground).opposite());
        let pin = balance.placement.point(dyad.end(dyad.inner, dyad.slider));
        super::slide::guide(balance, dyad.slide, dyad.slider, load.y - side, pin);
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some(dyad) = dyad(model, group) else { return Ok(()) };
        let e = motion.placement.slide_direction(dyad.slide);
        let u = dyad.direction(motion.placement);
        let slide = model.joint(dyad.slide);
        let far = if slide.to.link == dyad.slider { slide.from.link } else { slide.to.link };
        // The slider turns with the link that guides it, and B moves with that link but for the sliding:
        // v_A + ω r u⊥ = v_C + ṡ e, multiplied by n and by u.
        let slider_rate = motion.rate(far);
        let at = motion.placement.slide_point(dyad.slide, dyad.slider);
        let guided = motion.of_place(far, motion.placement.slide_point(dyad.slide, far));
        let inner = motion.placement.point(dyad.end(dyad.inner, dyad.slider));
        let ground = motion.placement.direction(GROUND);
        let turning = Framed {
            components: (inner - at).perp().scaled(slider_rate),
            axes: motion.placement.direction(dyad.slider),
        };
        let carried = guided.plus(&turning, ground);
        let outer_end = model.joint(dyad.outer).end_off(dyad.rod).unwrap_or(model.joint(dyad.outer).from);
        let outer = motion.of_point(outer_end);
        let gap = motion.difference(&carried, &outer);
        let cosine = motion.pivots.dividing_cosine(u, e, u.graph().one(), &dyad.pivot_name(), &dyad.group_name());
        let rod = dyad.link_name(dyad.rod);
        let across = motion.part(&gap, e.perp());
        let rate = if across.is_zero() { across } else { (across / cosine) / dyad.length() };
        let rate = rate.named(
            motion.name(&format!("rate_{rod}")),
            format!("rate of rotation of {rod}: the pins' relative velocity across the slide over length times u·e"),
        );
        let along = motion.part(&gap, u);
        let speed = if along.is_zero() { along } else { -(along / cosine) };
        let speed = speed.named(
            motion.name(&format!("speed_{}", dyad.joint_name(dyad.slide))),
            format!(
                "speed of {} along the slide: the pins' relative velocity along {rod} over u·e",
                dyad.link_name(dyad.slider)
            ),
        );
        let rod_at = motion.placement.point(dyad.end(dyad.outer, dyad.rod));
        motion.found(dyad.rod, Twist { rate, at: rod_at, velocity: outer });
        let sliding = Framed { components: Vector::new(speed, motion.graph().zero()), axes: e };
        motion.found(dyad.slider, Twist { rate: slider_rate, at, velocity: guided.plus(&sliding, ground) });
        Ok(())
    }
}

fn close<'m>(assembly: &mut Assembly<'m>, group: &Group, dyad: &Dyad<'m>) -> RuleResult {
    let model = dyad.model;
    let (outer, inner) = (dyad.joint_name(dyad.outer), dyad.joint_name(dyad.inner));
    let r = dyad.length();
    super::check_length(model, dyad.rod, [dyad.outer, dyad.inner])?;
    let slide = dyad.joint_name(dyad.slide);
    let lies = format!("along the slide `{slide}`, `{inner}` lies ahead of `{outer}` or behind it");
    let ahead = ahead(assembly, group, dyad.inner, dyad.outer, lies)?;
    let orientation = assembly.placement.along_slide(dyad.slide, dyad.slider);
    assembly.placement.orient(dyad.slider, orientation);
    let e = assembly.placement.slide_direction(dyad.slide);
    // With the travel still zero, the way goes from A over the guide to B.
    assembly.placement.connect(dyad.slide);
    let outer_end = model.joint(dyad.outer).end_off(dyad.rod).unwrap_or(model.joint(dyad.outer).from);
    let way = assembly.placement.way(outer_end, dyad.end(dyad.inner, dyad.slider));
    let meeting = meet(r, &way, e, ahead, [inner, outer], dyad.group_name());
    let Meeting { q, h, cosine, sine, pivot } = meeting;
    let name = dyad.link_name(dyad.rod);
    let direction = Vector::new(cosine, sine).turned_by(e);
    let direction = direction.named_direction(name, &format!("direction of {name} from {outer} to {inner}"));
    assembly.placement.orient(dyad.rod, Orientation { direction, axis: dyad.axis() });
    assembly.placement.connect(dyad.outer);
    assembly.placement.connect(dyad.inner);
    // From the guide's point to the slider's, whichever of the two is the slide's second.
    let forwards = model.joint(dyad.slide).to.link == dyad.slider;
    let travel = if forwards { h - q.x } else { q.x - h };
    let travel = travel.named(
        format!("travel_{slide}"),
        format!("travel of the slide {slide}: {}", if forwards { "h − e·Q" } else { "e·Q − h" }),
    );
    assembly.placement.set_travel(dyad.slide, travel);
    let u = dyad.direction(&assembly.placement);
    assembly.pivots.state(u, e, None, Some(pivot));
    assembly.dyads.push(DyadPivot { joint: dyad.inner, sine: pivot });
    Ok(())
}

/// Whether the inner joint is declared to lie ahead of the outer pin along a line; `lies` says what there is to choose.
pub(super) fn ahead(
    assembly: &mut Assembly<'_>,
    group: &Group,
    inner: JointId,
    outer: JointId,
    lies: String,
) -> Result<bool, Diagnostic> {
    let model = assembly.model();
    let [name, of] = [inner, outer].map(|joint| &model.joint(joint).name.text);
    let Some(closure) = assembly.closure(inner) else {
        return Err(assembly.missing_closure(group, inner, [Side::Ahead, Side::Behind], of));
    };
    if !matches!(closure.side, Side::Ahead | Side::Behind) || closure.of != [outer] {
        let across = matches!(closure.side, Side::Left | Side::Right);
        let problem =
            if across { format!("`{}` is for dyads of three pins: {lies}", closure.side.word()) } else { lies };
        return Err(Diagnostic::new(closure.side_place, problem)
            .help(format!("choose one of\nassemble {name}: ahead({of});\nassemble {name}: behind({of});")));
    }
    if closure.smooth_at.is_some() {
        return Err(Diagnostic::new(closure.smooth_place, "a group with a slider or a slot does not fold")
            .help("`smooth` is for dyads of three pins: leave it out"));
    }
    Ok(closure.side == Side::Ahead)
}

/// Where a link of length r on a pin meets a line.
pub(super) struct Meeting<'m> {
    /// From the pin to the line's point, along and across the line.
    pub q: Vector<'m>,
    /// How far ahead of the pin the link's end lies on the line.
    pub h: Expr<'m>,
    /// `u·e`, the direction of the link along the line.
    pub cosine: Expr<'m>,
    /// `u·n`, across it.
    pub sine: Expr<'m>,
    /// `u·e`, zero where it is no larger than its rounding; kept by the pose.
    pub pivot: Expr<'m>,
}

/// Meets a line of direction e, to a point of which the way leads, in one of two places.
pub(super) fn meet<'m>(
    r: Expr<'m>,
    way: &Way<'m>,
    e: Vector<'m>,
    ahead: bool,
    [inner, outer]: [&str; 2],
    group: String,
) -> Meeting<'m> {
    let graph = r.graph();
    let pivot_name = format!("sin_mu_{inner}");
    let q = way.resolved_along(e);
    let g = q.y.named(format!("g_{inner}"), format!("g = e × Q, Q from {outer} to {inner} at no travel"));
    let h2 = ((r - g) * (r + g)).named(format!("h2_{inner}"), "h² = (r − g)(r + g)");
    let reach = reach_across(way, e);
    let (h2, rounding) = if (r - reach).sign() == Some(1) {
        (h2.known_positive(), graph.zero())
    } else {
        let rounding = graph.epsilons(4) * (r * (r + reach));
        (h2, rounding.named(format!("rounding_h2_{inner}"), format!("what rounding makes of h2_{inner} = 0")))
    };
    let failure = Failure::CannotAssemble { group, joint: inner.into(), gap: (g.abs() - r).id() };
    let h2 = h2.require_at_least(h2, -rounding, failure);
    let h = if ahead { 1 } else { -1 } * h2.non_negative().sqrt();
    let h = h.named(format!("h_{inner}"), if ahead { "h = √(h²), ahead" } else { "h = −√(h²), behind" });
    let (cosine, sine) = (
        (h / r).named(pivot_name.clone(), "sin μ = u·e = h/r"),
        (g / r).named(format!("g_over_r_{inner}"), "u·n = g/r"),
    );
    let pivot = cosine.where_above(h2, rounding);
    let pivot = pivot.named(format!("{pivot_name}_or_zero"), "zero where it is no larger than its rounding").held();
    Meeting { q, h, cosine, sine, pivot }
}

/// How far across the slide the parts of a way reach together.
fn reach_across<'m>(way: &Way<'m>, e: Vector<'m>) -> Expr<'m> {
    let graph = e.graph();
    way.segments.iter().fold(graph.zero(), |sum, segment| {
        let constant = segment.along.turned_by(segment.direction.resolved_along(e)).y;
        let size = if constant.value().is_some() { constant.abs() } else { segment.size };
        sum + size
    })
}
