//! The RPR dyad: two links that slide along each other, each with a pin at its other end. An oscillating cylinder, an inverted
//! slider-crank.
//!
//! With the outer pins P on the slide's first link and Q on its second, `d = Q − P`, `D² = d·d`, the slide's direction e and its normal
//! `n = e⊥`, the links hold Q at a fixed distance h from the line through P along e:
//!
//! ```text
//! d = s e + h n      s = ±√(D² − h²)      + where Q is ahead of P
//! e = (s d − h d⊥)/D²                      as complex numbers, e = d/(s + ih)
//! ```
//!
//! and the travel is s less a constant. Both links turn together.
//!
//! Forces: across the slide alone they press on each other, with N on the second link; s is its lever arm about both pins. The moments
//! of the loads on the first link about P and of those on the second about Q are together `N s`.
//!
//! Velocities: `v_Q − v_P = ω d⊥ + ṡ e`, multiplied by n: `ω = n·(v_Q − v_P)/s`. So s is the pivot: where it vanishes, the line between
//! the pins is square to the slide.

use super::dyad::{Dyad, Leg, dyad, towards_unit};
use super::travels::count;
use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::graph::{Expr, Failure, Vector};
use crate::model::ids::{GROUND, JointId};
use crate::model::{Closure, Model, Side};
use crate::plan::assembly::{Assembly, ClosedLoop, DyadPivot, Found, Sign};
use crate::plan::balance::{Balance, is_shorter};
use crate::plan::framed::Framed;
use crate::plan::pivots::Pivots;
use crate::plan::placement::Placement;
use crate::plan::velocities::Motion;
use crate::topology::Group;

/// The rule.
pub(super) struct Rpr;

/// The group as an RPR dyad, the slide's first link first.
fn sliding_pair<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let mut dyad = dyad(model, group).filter(|dyad| dyad.pins() == [true, false, true])?;
    if dyad.legs[0].tip.end != model.joint(dyad.inner).from {
        dyad.legs.swap(0, 1);
    }
    Some(dyad)
}

fn pivot_name(dyad: &Dyad<'_>) -> String {
    format!("reach_{}", dyad.joint_name(dyad.inner))
}

/// s as a divisor. Where forces see another dyad than motion does, it is the way from the one pin to the other.
fn reach<'m>(dyad: &Dyad<'m>, placement: &Placement<'m>, pivots: &Pivots<'m>) -> Expr<'m> {
    let [from, to] = dyad.legs.each_ref().map(|leg| leg.near);
    let (way, line) = (placement.way(from, to), placement.line(dyad.inner));
    pivots.dividing_reach(dyad.inner, &way, line, &pivot_name(dyad), &dyad.group_name())
}

impl Rule for Rpr {
    fn class(&self) -> &'static str {
        "RPR dyad"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        sliding_pair(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliding_pair(assembly.model(), group) else { return Ok(()) };
        close(assembly, group, &dyad)
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliding_pair(balance.model(), group) else { return Ok(()) };
        let [first, second] = &dyad.legs;
        let slide = dyad.joint_name(dyad.inner);
        let one = balance.graph().one();
        let names = dyad.legs.each_ref().map(|leg| balance.name(&format!("moment_{}", dyad.link_name(leg))));
        let moments = [0, 1].map(|index| {
            let leg = &dyad.legs[index];
            let (pin, link) = (dyad.joint_name(leg.outer), dyad.link_name(leg));
            let moment = dyad.moment(balance, leg, one);
            moment.named(names[index].as_str(), format!("ΣM({pin}) of the loads on {link}"))
        });
        let moment = moments[0] + moments[1];
        let across = if moment.is_zero() {
            moment
        } else {
            let reach = reach(&dyad, balance.placement, balance.pivots);
            let acting = names.iter().zip(moments).filter(|(_, moment)| !moment.is_zero());
            let terms = match acting.map(|(name, _)| name.as_str()).collect::<Vec<_>>()[..] {
                [one] => one.to_owned(),
                ref all => format!("({})", all.join(" + ")),
            };
            let (link, other) = (dyad.link_name(first), dyad.link_name(second));
            let meaning = format!("across the slide, of the force on {other} by {link}: {terms}/{}", pivot_name(&dyad));
            (moment / reach).named(balance.name(&format!("{slide}_across")), meaning)
        };
        // The couple about the runner from the link that carries it: there the lever arm of the pin does not change. Or else from the other one,
        // if nothing else acts there: moments may be large on the first one, and their rounding more than the couple. But where the slide is
        // farther from the pin of that one, its arm is what is left of a long travel.
        let runner = usize::from(balance.model().joint(dyad.inner).place().link == second.tip.end.link);
        let free = dyad.legs.each_ref().map(|leg| leg.is_single() && balance.is_free(leg.link()));
        let spans =
            dyad.legs.each_ref().map(|leg| balance.placement.point(leg.tip) - balance.placement.point(leg.near));
        let other_is_free = free[1 - runner] && !free[runner];
        let from_other = other_is_free && !is_shorter(spans[runner], spans[1 - runner]);
        let from = if from_other { 1 - runner } else { runner };
        let (leg, other, acting) = if from == 1 { (second, first, -across) } else { (first, second, across) };
        let loads = balance.total(leg.link());
        dyad.guide_inner(balance, leg, acting);
        if leg.is_single() {
            let ground = balance.placement.direction(GROUND);
            let held = loads.plus(&dyad.guided(balance, leg), ground);
            balance.pin(leg.outer, leg.link(), held.opposite());
        } else {
            dyad.balance_rest(balance, leg)?;
        }
        // The guide has put its part on the other link.
        dyad.balance_rest(balance, other)
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliding_pair(motion.model(), group) else { return Ok(()) };
        let [first, second] = &dyad.legs;
        let e = motion.placement.slide_direction(dyad.inner);
        // If the bodies that slide along each other did not turn; what drives within the legs turn them by is taken off.
        let own = turns_within(&dyad, motion)?;
        let ground = motion.placement.direction(GROUND);
        let carried = place_on(&dyad, motion, first).plus(&motion.coriolis(dyad.inner, second.tip.end.link), ground);
        let gap = motion.lacking(dyad.inner, &place_on(&dyad, motion, second), &carried);
        let across = motion.part(&gap, e.perp());
        let rate = if across.is_zero() { across } else { across / reach(&dyad, motion.placement, motion.pivots) };
        let [one, other] = [first, second].map(|leg| dyad.link_name(leg));
        let how = format!(" and {other}: the pins' relative {{velocity}} across the slide over {}", pivot_name(&dyad));
        let rate = motion.named_rate(rate, &one, &how);
        if [first, second].into_iter().all(Leg::is_single) && !is_turned(&dyad) {
            // Turning, the slide's places on the two links move apart along it.
            let arm =
                |leg: &Leg| motion.placement.slide_point(dyad.inner, leg.link()) - motion.placement.point(leg.near);
            let apart = (arm(second) - arm(first)).perp().dot(motion.placement.slide_along(dyad.inner));
            let sliding = motion.part(&gap, e) + rate * apart;
            motion.records(dyad.inner, second.link(), sliding);
        }
        let legs = [(first, own[0]), (second, own[1])];
        legs.into_iter().try_for_each(|(leg, own)| dyad.turn(motion, leg, rate - own))
    }
}

/// Supposes that the carrier of the slide does not turn, nor the other link against it but for a drive or a parameter. Gives what their first links must
/// turn back for that.
fn turns_within<'m>(dyad: &Dyad<'m>, motion: &mut Motion<'m, '_>) -> Result<[Expr<'m>; 2], Diagnostic> {
    let mut own = [motion.graph().zero(); 2];
    for (leg, own) in dyad.legs.iter().zip(&mut own) {
        dyad.turn(motion, leg, *own)?;
        // In a slot the drive turns the other link against its carrier.
        let link = leg.tip.end.link;
        let carrier = dyad.model.joint(dyad.inner).kind.line().map_or(link, |(carrier, _)| carrier);
        let wanted = if carrier == link {
            motion.graph().zero()
        } else {
            motion.driven_rate(dyad.inner, carrier) + motion.turned_by(dyad.inner, link)
        };
        *own = motion.rate(link) - wanted;
        if !own.is_zero() {
            dyad.turn(motion, leg, -*own)?;
        }
    }
    Ok(own)
}

/// The velocity of the slide's place on a leg.
fn place_on<'m>(dyad: &Dyad<'m>, motion: &Motion<'m, '_>, leg: &Leg) -> Framed<'m> {
    motion.of_place(leg.tip.end.link, motion.placement.slide_point(dyad.inner, leg.tip.end.link))
}

fn close<'m>(assembly: &mut Assembly<'m>, group: &Group, dyad: &Dyad<'m>) -> RuleResult {
    let graph = assembly.graph();
    let [first, second] = &dyad.legs;
    let [p, q] = [first, second].map(|leg| dyad.joint_name(leg.outer));
    let slide = dyad.joint_name(dyad.inner);
    let side = side(assembly, group, dyad)?;
    count(assembly, group, dyad.inner);
    // From P to the slide and from Q to it, along and across it: the same for every pose, but for drives within the bodies.
    let [from_p, from_q] = dyad.legs.each_ref().map(|leg| dyad.way_to_slide(&assembly.placement, leg));
    let offset = from_p.vector() - from_q.vector();
    let h = offset.y.named(format!("h_{slide}"), format!("h, how far {q} is across the slide from {p}"));
    let way = assembly.placement.way(first.far, second.far);
    let d = way.vector().named(&format!("d_{slide}"), &format!("d, from {p} to {q}"));
    let d2 = d.squared().named(format!("D2_{slide}"), "d·d");
    let driven = dyad.legs.iter().zip([&from_p, &from_q]).filter(|(leg, _)| !leg.is_constant(dyad.model));
    let slack = driven.fold(way.length(), |sum, (_, within)| sum + within.length());
    // A driven angle between the links makes h and what is fixed along the slide rounded too.
    let length = if is_turned(dyad) { slack + from_p.length() + from_q.length() } else { slack };
    let rounding = |of: &str, value: Expr<'m>, size: &str| {
        let meaning =
            format!("what rounding makes of {of}_{slide} = 0: {size}, Λ the lengths that make up d and driven legs");
        value.named(format!("rounding_{of}_{slide}"), meaning)
    };
    // Coincident pins leave the direction open, unless h or the lengths between them keep them apart.
    let apart = h.abs().exceeds_rounding_of(length) || way.exceeds(graph.zero(), length);
    let d2 = if apart {
        d2.known_positive()
    } else {
        let close = rounding("D2", (graph.epsilons(2) * length).squared(), "(2ε Λ)²");
        let failure = Failure::CoincidentPivots { group: dyad.group_name(), joint: slide.into() };
        d2.require_above(d2, close, failure).known_positive()
    };
    let (s, reach) = if h.is_zero() {
        let s = side.of(d2.sqrt());
        (s, s)
    } else {
        let s2 = (d2 - h.squared())
            .named(format!("s2_{slide}"), format!("s² = D2_{slide} − h², h how far {q} is across the slide from {p}"));
        let (s2, limit) = if way.exceeds(h.abs(), length) {
            (s2.known_positive(), graph.zero())
        } else {
            (s2, rounding("s2", graph.epsilons(2) * (h.squared() + h.abs() * length), "2ε |h| (|h| + Λ)"))
        };
        let failure = Failure::CannotAssemble {
            group: dyad.group_name(),
            joint: slide.into(),
            gap: (-s2 / (d2.sqrt() + h.abs())).id(),
        };
        let s2 = s2.require_at_least(s2, -limit, failure);
        let s = side.of(s2.non_negative().sqrt());
        (s, s.where_above(s2, limit))
    };
    let s = s.named(format!("s_{slide}"), format!("s, how far {q} is ahead of {p}"));
    let reach = if h.is_zero() { s } else { reach };
    let reach = reach.named(pivot_name(dyad), "s, zero where it is no larger than its rounding").held();
    let inverse = (graph.one() / d2).named(format!("inverse_D2_{slide}"), "");
    let (along, across) = ((s * inverse), (h * inverse));
    let name = dyad.link_name(first);
    let rough = d.scaled(along) - d.perp().scaled(across);
    let rough = rough.named_direction(&format!("rough_{name}"), &format!("(s d − h d⊥)/D2_{slide}"));
    let direction = towards_unit(rough, &name).named_direction(slide, &format!("direction of the slide {slide}"));
    let arm = direction.scaled(s) + direction.perp().scaled(h);
    assembly.closed(|| ClosedLoop {
        name: slide.to_owned(),
        residual: arm - d,
        found: [
            Found::Direction { direction, column: arm.perp(), arm },
            Found::Length { length: s, column: direction },
        ],
        determinant: -s,
        pivot: None,
        apart: false,
    });
    place(assembly, dyad, direction)?;
    let name = assembly.placement.name_of_travel(dyad.inner);
    let travel = (s - offset.x).named(name, format!("travel of the slide {slide}: s less what is fixed"));
    assembly.placement.set_travel(dyad.inner, travel);
    for leg in [first, second] {
        assembly.placement.connect(leg.outer);
    }
    assembly.pivots.state_reach(dyad.inner, reach);
    assembly.dyads.push(DyadPivot::reach(dyad.model, dyad.inner, reach));
    Ok(())
}

/// Whether a drive turns the links of the slide against each other.
fn is_turned(dyad: &Dyad<'_>) -> bool {
    dyad.model.drive_of(dyad.inner, true).is_some()
}

/// Both links carry the slide's direction.
fn place<'m>(assembly: &mut Assembly<'m>, dyad: &Dyad<'m>, direction: Vector<'m>) -> RuleResult {
    for leg in &dyad.legs {
        let link = leg.tip.end.link;
        let orientation = assembly.placement.sliding(dyad.inner, link, direction);
        assembly.placement.orient(link, orientation);
        dyad.place_rest(assembly, leg, link)?;
    }
    Ok(())
}

/// The sign of s, by the closure.
fn side<'m>(assembly: &mut Assembly<'m>, group: &Group, dyad: &Dyad<'_>) -> Result<Sign<'m>, Diagnostic> {
    let slide = dyad.joint_name(dyad.inner);
    let outer: [JointId; 2] = dyad.legs.each_ref().map(|leg| leg.outer);
    let [p, q] = outer.map(|joint| dyad.joint_name(joint));
    let Some(closure) = assembly.closure(dyad.inner, group) else {
        // Of the two ways to say it, the one that no other group at this joint has, nor that of the declaration's drives.
        let here = |other: &Closure| other.joint == dyad.inner;
        let said = dyad.model.closures.iter().any(|other| here(other) && other.of == [outer[0]]);
        let meant = dyad.model.exchanged.as_ref().is_some_and(|exchanged| {
            let along = Some([dyad.inner, outer[0]]);
            exchanged.closures.iter().any(|side| here(dyad.model.closure(side.closure)) && side.along == along)
        });
        let taken = said || meant;
        let of = if taken { q } else { p };
        return Err(assembly.missing_closure(group, dyad.inner, [Side::Ahead, Side::Behind], of));
    };
    let sign = match (closure.side, outer.iter().position(|joint| closure.of == [*joint])) {
        (Side::Ahead | Side::Behind | Side::Either, Some(0)) => assembly.sign(closure, Side::Ahead),
        (Side::Ahead | Side::Behind | Side::Either, Some(_)) => assembly.sign(closure, Side::Ahead).opposite(),
        _ => {
            let noun = dyad.model.joint(dyad.inner).kind.noun();
            let lies = format!("along the {noun} `{slide}`, `{q}` lies ahead of `{p}` or behind it");
            let across = matches!(closure.side, Side::Left | Side::Right);
            let problem =
                if across { format!("`{}` is for dyads of three pins: {lies}", closure.side.word()) } else { lies };
            return Err(Diagnostic::new(closure.side_place, problem)
                .help(format!("choose one of\nassemble {slide}: ahead({p});\nassemble {slide}: behind({p});")));
        }
    };
    if closure.smooth_at.is_some() {
        return Err(Diagnostic::new(closure.smooth_place, "a dyad with a slide does not fold")
            .help("`smooth` is for dyads of three pins: leave it out"));
    }
    Ok(sign)
}
