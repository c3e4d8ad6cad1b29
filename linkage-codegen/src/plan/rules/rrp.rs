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

use super::dyad::{Dyad, difference, dyad, towards_unit};
use super::travels::count;
use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::graph::{Expr, Failure, Vector};
use crate::model::ids::JointId;
use crate::model::{Model, Side};
use crate::plan::assembly::{Assembly, ClosedLoop, DyadPivot, Found, Pivot, Sign};
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::placement::{Line, Way};
use crate::plan::velocities::Motion;
use crate::topology::Group;

/// The rule.
pub(super) struct Rrp;

/// The group as an RRP dyad, the rod first.
fn rod_and_slider<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let mut dyad = dyad(model, group)?;
    match dyad.pins() {
        [true, true, false] => {}
        [false, true, true] => dyad.legs.swap(0, 1),
        _ => return None,
    }
    Some(dyad)
}

impl Rule for Rrp {
    fn class(&self) -> &'static str {
        "RRP dyad"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        rod_and_slider(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(dyad) = rod_and_slider(assembly.model(), group) else { return Ok(()) };
        close(assembly, group, &dyad)
    }

    fn balance<'m>(&self, balance: &mut Balance<'m, '_>, group: &Group) -> RuleResult {
        let model = balance.model();
        let Some(dyad) = rod_and_slider(model, group) else { return Ok(()) };
        let [rod_leg, slider_leg] = &dyad.legs;
        let slide = slider_leg.outer;
        dyad.check_length(rod_leg)?;
        let (rod, inner) = (dyad.link_name(rod_leg), dyad.joint_name(dyad.inner));
        let (outer, slider) = (dyad.joint_name(rod_leg.outer), dyad.link_name(slider_leg));
        let e = balance.placement.slide_direction(slide);
        let u = dyad.direction(balance.placement, rod_leg);
        let load = slider_leg.total(balance).along(e);
        let share = dyad.share(balance, rod_leg);
        // The part across the slide is known last, and need not be negated where the pin's force has it as it is.
        let (rod_end, slider_end) = (rod_leg.tip.end.link, slider_leg.tip.end.link);
        let (reports_rod, normal) = (model.joint(dyad.inner).to.link == rod_end, e.perp());
        let on_rod = match [normal.x.sign(), normal.y.sign()] {
            [Some(0 | 1), Some(0 | 1)] => reports_rod,
            [Some(-1 | 0), Some(-1 | 0)] => !reports_rod,
            _ => true,
        };
        let of_force =
            format!("of the force on {} at {inner}", model.link(if on_rod { rod_end } else { slider_end }).name);
        let [sign, opposite] = if on_rod { ["", "−"] } else { ["−", ""] };
        let reported = |on_rod_itself: Expr<'m>| if on_rod { on_rod_itself } else { -on_rod_itself };
        let moment = format!("{opposite}ΣM({outer})/|{outer} {inner}| of the loads on {rod}");
        let across = reported(-share.inner)
            .named(balance.name(&format!("{inner}_across_{rod}")), format!("across {rod}, {of_force}: {moment}"));
        let along_slide = reported(load.x).named(
            balance.name(&format!("{inner}_along_slide")),
            format!("along the slide, {of_force}: {sign}ΣF of the loads on {slider}"),
        );
        let side = if across.is_zero() && along_slide.is_zero() {
            balance.graph().zero()
        } else {
            let cosine = balance.pivots.dividing_cosine(u, e, u.graph().one(), &dyad.pivot_name(), &dyad.group_name());
            let needed = across - along_slide * balance.pivots.sine(u, e);
            let across_rod = balance.called(across, &format!("{inner}_across_{rod}"), &moment);
            let force = format!("{sign}ΣF of the loads on {slider} along the slide");
            let along = balance.called(along_slide, &format!("{inner}_along_slide"), &force);
            let terms = difference([(across, across_rod), (along_slide, format!("{along} (u × e)"))]);
            (needed / cosine).named(
                balance.name(&format!("{inner}_across_slide")),
                format!("across the slide, {of_force}: {terms}/sin μ, u along {rod}, e along the slide"),
            )
        };
        let force = Framed { components: Vector::new(along_slide, side), axes: e };
        let loads = balance.total(rod_leg.link());
        // The pin puts its part on the slider, whose moments give the couple of the guide.
        let force = balance.pin(dyad.inner, rod_end, if on_rod { force } else { force.opposite() });
        dyad.balance_shared(balance, (rod_leg, &share), force, loads)?;
        if !slider_leg.is_single() {
            return dyad.balance_rest(balance, slider_leg);
        }
        let at = balance.placement.point(slider_leg.tip);
        super::slide::guide(balance, slide, slider_leg.link(), load.y - reported(side), at);
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some(dyad) = rod_and_slider(model, group) else { return Ok(()) };
        let [rod_leg, slider_leg] = &dyad.legs;
        let slide = slider_leg.outer;
        let e = motion.placement.slide_direction(slide);
        let u = dyad.direction(motion.placement, rod_leg);
        // The slider turns with the link that guides it, and B moves with that link but for the sliding:
        // v_A + ω r u⊥ = v_C + ṡ e, multiplied by n and by u.
        motion.found(slider_leg.link(), motion.carried(slide, slider_leg.link()));
        dyad.follow_rest(motion, slider_leg, slider_leg.link())?;
        dyad.turn(motion, rod_leg, motion.graph().zero())?;
        let gap = motion.lacking(
            dyad.inner,
            &dyad.velocity_of_pin(motion, slider_leg),
            &dyad.velocity_of_pin(motion, rod_leg),
        );
        let cosine = motion.pivots.dividing_cosine(u, e, u.graph().one(), &dyad.pivot_name(), &dyad.group_name());
        let rod = dyad.link_name(rod_leg);
        let across = motion.part(&gap, e.perp());
        let rate = if across.is_zero() { across } else { (across / cosine) / dyad.length(rod_leg) };
        let how = ": the pins' relative {velocity} across the slide over length times sin μ";
        let rate = motion.named_rate(rate, &rod, how);
        let along = motion.part(&gap, u);
        let speed = if along.is_zero() { along } else { -(along / cosine) };
        let how = format!(": the pins' relative {{velocity}} along {rod} over sin μ");
        let speed = motion.named_sliding(speed, slide, &dyad.link_name(slider_leg), &how);
        dyad.turn(motion, rod_leg, rate)?;
        motion.slides(slide, slider_leg.link(), speed);
        dyad.follow_rest(motion, slider_leg, slider_leg.link())
    }
}

fn close<'m>(assembly: &mut Assembly<'m>, group: &Group, dyad: &Dyad<'m>) -> RuleResult {
    let model = dyad.model;
    let [rod_leg, slider_leg] = &dyad.legs;
    let slide = slider_leg.outer;
    let (outer, inner) = (dyad.joint_name(rod_leg.outer), dyad.joint_name(dyad.inner));
    let r = dyad.length(rod_leg);
    dyad.check_length(rod_leg)?;
    let lies = format!("along the slide `{}`, `{inner}` lies ahead of `{outer}` or behind it", dyad.joint_name(slide));
    let ahead = ahead(assembly, group, dyad.inner, rod_leg.outer, lies)?;
    assembly.placement.orient_along(slide, slider_leg.link());
    dyad.place_rest(assembly, slider_leg, slider_leg.link())?;
    let line = assembly.placement.line(slide);
    let e = line.direction;
    // With the travel still zero, the way goes from A over the guide to B.
    count(assembly, group, slide);
    assembly.placement.connect(slide);
    let way = assembly.placement.way(rod_leg.far, slider_leg.tip);
    let meeting = meet((r, dyad.slack(rod_leg)), &way, line, ahead, [inner, outer], dyad.group_name());
    let Meeting { q, h, cosine, sine, pivot } = meeting;
    let name = dyad.link_name(rod_leg);
    let direction = dyad.refined(rod_leg, by_parts(Vector::new(cosine, sine), e, &name));
    let direction = direction.named_direction(&name, &format!("direction of {name} from {outer} to {inner}"));
    let u = dyad.orient(assembly, rod_leg, direction)?;
    dyad.take_moments_over_length(&mut assembly.placement, rod_leg);
    assembly.placement.connect(rod_leg.outer);
    assembly.placement.connect(dyad.inner);
    // From the guide's point to the slider's, whichever of the two is the slide's second.
    let forwards = model.joint(slide).to.link == slider_leg.link();
    let travel = if forwards { h - q.x } else { q.x - h };
    let name = dyad.joint_name(slide);
    let travel = travel.named(
        assembly.placement.name_of_travel(slide),
        format!("travel of the slide {name}: {}", if forwards { "h − e·Q" } else { "e·Q − h" }),
    );
    let run = e.scaled(travel);
    let (run, along) = if forwards { (run, e) } else { (-run, -e) };
    let arm = direction.scaled(r);
    assembly.closed(|| ClosedLoop {
        name: inner.to_owned(),
        residual: arm - (way.vector() + run),
        found: [
            Found::Direction { direction, column: arm.perp(), arm },
            Found::Length { length: travel, column: -along },
        ],
        determinant: if forwards { r * cosine } else { -(r * cosine) },
        pivot: Some(Pivot { value: cosine, again: direction.dot(e), slopes: None }),
        apart: false,
    });
    assembly.placement.set_travel(slide, travel);
    assembly.pivots.state(u, e, None, Some(pivot));
    assembly.dyads.push(DyadPivot::sine(dyad.model, dyad.inner, pivot, None));
    Ok(())
}

/// The sign of how far the inner joint is declared to lie ahead of the outer pin along a line; `lies` says what there is to choose.
pub(super) fn ahead<'m>(
    assembly: &mut Assembly<'m>,
    group: &Group,
    inner: JointId,
    outer: JointId,
    lies: String,
) -> Result<Sign<'m>, Diagnostic> {
    let model = assembly.model();
    let [name, of] = [inner, outer].map(|joint| &model.joint(joint).name.text);
    let Some(closure) = assembly.closure(inner, group) else {
        return Err(assembly.missing_closure(group, inner, [Side::Ahead, Side::Behind], of));
    };
    if !matches!(closure.side, Side::Ahead | Side::Behind | Side::Either) || closure.of != [outer] {
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
    Ok(assembly.sign(closure, Side::Ahead))
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

/// Meets a line of direction e, to a point of which the way leads, in one of two places. The length r may be rounded to the size of its
/// slack.
pub(super) fn meet<'m>(
    (r, slack): (Expr<'m>, Expr<'m>),
    way: &Way<'m>,
    line: Line<'m>,
    ahead: Sign<'m>,
    [inner, outer]: [&str; 2],
    group: String,
) -> Meeting<'m> {
    let graph = r.graph();
    let pivot_name = format!("sin_mu_{inner}");
    let q = way.resolved_along(line);
    let g =
        q.y.named(format!("g_{inner}"), format!("g = e × Q, e along the line, Q from {outer} to {inner} at no travel"));
    // Fused, the difference of the squares is rounded once; where r is no constant, r² would be rounded first.
    let (h2, formula) = if graph.is_fused() && r.value().is_some() {
        (r.squared() - g.squared(), "r² − g²")
    } else {
        ((r - g) * (r + g), "(r − g)(r + g)")
    };
    let h2 = h2.named(format!("h2_{inner}"), format!("h² = {formula}, r = |{outer} {inner}|"));
    let reach = reach_across(way, &line);
    // Of a length that is longer by no more than rounding the margin is checked at run time.
    let (h2, rounding) = if (r - reach).exceeds_rounding_of(r + reach) {
        (h2.known_positive(), graph.zero())
    } else {
        let rounding = graph.epsilons(4) * (r * (r + (reach + slack)));
        let size = "4ε r (r + Λ), Λ the lengths that make up g and a driven rod";
        (h2, rounding.named(format!("rounding_h2_{inner}"), format!("what rounding makes of h2_{inner} = 0: {size}")))
    };
    let failure = Failure::CannotAssemble { group, joint: inner.into(), gap: (g.abs() - r).id() };
    let h2 = h2.require_at_least(h2, -rounding, failure);
    let h = ahead.of(h2.non_negative().sqrt());
    let equation = match ahead {
        Sign::Plus => format!("h = √(h²), {inner} ahead of {outer}"),
        Sign::Minus => format!("h = −√(h²), {inner} behind {outer}"),
        Sign::Given(..) => format!("h = side_{inner} √(h²), how far {inner} is ahead of {outer}"),
    };
    let h = h.named(format!("h_{inner}"), equation);
    let length = format!("|{outer} {inner}|");
    let [cosine, sine] = [h, g].map(|part| (part / r).along(Some(part), r, &length));
    let (cosine, sine) = (
        cosine.named(pivot_name.clone(), "sin μ = u·e = h/r, u from the one pin to the other"),
        sine.named(format!("g_over_r_{inner}"), "u·n = g/r, n across the line"),
    );
    let pivot = cosine.where_above(h2, rounding);
    let pivot = pivot.named(format!("{pivot_name}_or_zero"), "zero where it is no larger than its rounding").held();
    Meeting { q, h, cosine, sine, pivot }
}

/// The direction of a link by its parts along and across a line. The size of a moving line's direction is rounded: links that are placed one
/// by the other would pass that on, and each add its own.
pub(super) fn by_parts<'m>(parts: Vector<'m>, line: Vector<'m>, name: &str) -> Vector<'m> {
    let direction = parts.turned_by(line);
    if line.is_constant() {
        return direction;
    }
    let rough = direction.named_direction(&format!("rough_{name}"), "by its parts along and across the line");
    towards_unit(rough, name)
}

/// How far across the slide the parts of a way reach together.
fn reach_across<'m>(way: &Way<'m>, line: &Line<'m>) -> Expr<'m> {
    let graph = line.direction.graph();
    way.segments.iter().fold(graph.zero(), |sum, segment| {
        let constant = segment.resolved_along(line).y;
        let size = if constant.value().is_some() { constant.abs() } else { segment.size() };
        sum + size
    })
}
