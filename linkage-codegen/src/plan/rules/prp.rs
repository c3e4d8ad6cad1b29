//! The PRP dyad: two sliders with a pin between them.
//!
//! With the directions e₁ and e₂ of the slides, g from the pin on the first slider to the pin on the second when neither has
//! travelled, and t₁, t₂ how far they travel:
//!
//! ```text
//! t₁ e₁ − t₂ e₂ = g      t₁ = (g × e₂)/(e₁ × e₂)      t₂ = t₁ (e₁·e₂) − g·e₂
//! ```
//!
//! Each slider turns with the link that guides it, so there is nothing to choose. The second travel is the projection, not another
//! quotient: then the pin closes to rounding however flat the angle between the slides is. Its sine is the pivot.
//!
//! Forces: the guides take nothing along the slides, so the force F on the first slider at the pin has `F·e₁ = a = −e₁·W₁` and
//! `F·e₂ = b = e₂·W₂` with W the loads: along e₁ it is a, across it `(b − a (e₁·e₂))/(e₁ × e₂)`.
//!
//! Velocities: the pin has that of the place on the first guide, and `ṡ₁ = ((c₂ − c₁) × e₂)/(e₁ × e₂)` along e₁, with c the velocities
//! of the places on the guides.

use super::dyad::{Dyad, difference, dyad};
use super::travels::count;
use super::{Rule, RuleResult};
use crate::graph::Vector;
use crate::model::Model;
use crate::model::ids::{GROUND, JointId};
use crate::plan::assembly::{Assembly, ClosedLoop, Found};
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::velocities::{Motion, Twist};
use crate::topology::Group;

/// The rule.
pub(super) struct Prp;

fn sliders<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    dyad(model, group).filter(|dyad| dyad.pins() == [false, true, false])
}

fn slides(dyad: &Dyad<'_>) -> [JointId; 2] {
    dyad.legs.each_ref().map(|leg| leg.outer)
}

impl Rule for Prp {
    fn class(&self) -> &'static str {
        "PRP dyad"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        sliders(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliders(assembly.model(), group) else { return Ok(()) };
        let [first, second] = &dyad.legs;
        for leg in &dyad.legs {
            assembly.placement.orient_along(leg.outer, leg.link());
            dyad.place_rest(assembly, leg, leg.link())?;
            count(assembly, group, leg.outer);
            assembly.placement.connect(leg.outer);
        }
        let (cosine, sine) = dyad.state_slides(assembly, slides(&dyad))?;
        let pin = dyad.joint_name(dyad.inner);
        let [first_name, second_name] = [first, second].map(|leg| dyad.link_name(leg));
        let line = assembly.placement.line(second.outer);
        let e = line.direction;
        let way = assembly.placement.way(first.tip, second.tip);
        let gap = way.resolved_along(line);
        let gap = gap.named(
            &format!("g_{pin}"),
            &format!(
                "g, from {pin} on {first_name} to {pin} on {second_name} at no travel, along and across {}",
                dyad.joint_name(second.outer)
            ),
        );
        let [first_slide, second_slide] = [first, second].map(|leg| dyad.joint_name(leg.outer));
        let along_slides = format!("e₁ along {first_slide}, e₂ along {second_slide}");
        let own =
            (-gap.y / sine).named(format!("t_{first_name}"), format!("t₁ = (g × e₂)/sin_mu_{pin}, {along_slides}"));
        let other = (own * cosine - gap.x).named(format!("t_{second_name}"), "t₂ = t₁ (e₁·e₂) − g·e₂");
        let along = assembly.placement.slide_direction(first.outer);
        assembly.closed(|| ClosedLoop {
            name: pin.to_owned(),
            residual: along.scaled(own) - e.scaled(other) - way.vector(),
            found: [Found::Length { length: own, column: along }, Found::Length { length: other, column: -e }],
            determinant: -sine,
            pivot: None,
            apart: false,
        });
        dyad.set_travel(assembly, first.outer, first.link(), own);
        dyad.set_travel(assembly, second.outer, second.link(), other);
        assembly.placement.connect(dyad.inner);
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliders(balance.model(), group) else { return Ok(()) };
        let [first, second] = &dyad.legs;
        let pin = dyad.joint_name(dyad.inner);
        let [one, two] = [first, second].map(|leg| balance.placement.slide_direction(leg.outer));
        let loads = first.total(balance).along(one);
        let [along_first, along_second] =
            [first, second].map(|leg| format!("{pin}_along_{}", dyad.joint_name(leg.outer)));
        let (link, other) = (dyad.link_name(first), dyad.link_name(second));
        let (slide, its) = (dyad.joint_name(first.outer), dyad.joint_name(second.outer));
        let of_force = format!("of the force on {link} at {pin}");
        let meaning = format!("along {slide}, {of_force}: −ΣF of its loads");
        let own = (-loads.x).named(balance.name(&along_first), meaning);
        let needed = second.total(balance).along(two).x;
        let meaning = format!("along {its}, {of_force}: ΣF of the loads on {other}");
        let needed = needed.named(balance.name(&along_second), meaning);
        let across = if own.is_zero() && needed.is_zero() {
            balance.graph().zero()
        } else {
            let cosine = balance.placement.between(slides(&dyad)).x;
            let sine = balance.pivots.dividing_slides(
                balance.placement,
                slides(&dyad),
                &dyad.pivot_name(),
                &dyad.group_name(),
            );
            let own_name = balance.called(own, &along_first, &format!("−ΣF of the loads on {link} along {slide}"));
            let its_name = balance.called(needed, &along_second, &format!("ΣF of the loads on {other} along {its}"));
            let terms = difference([(needed, its_name), (own, format!("{own_name} (e₁·e₂)"))]);
            ((needed - own * cosine) / sine).named(
                balance.name(&format!("{pin}_across_{slide}")),
                format!("across {slide}, {of_force}: {terms}/{}, e₁ along {slide}, e₂ along {its}", dyad.pivot_name()),
            )
        };
        let force = Framed { components: Vector::new(own, across), axes: one };
        // The pin puts its part on the second slider.
        let force = dyad.pin_inner(balance, first, force).along(one);
        if first.is_single() {
            let at = balance.placement.point(first.tip);
            super::slide::guide(balance, first.outer, first.link(), loads.y + force.y, at);
        } else {
            dyad.balance_rest(balance, first)?;
        }
        dyad.balance_rest(balance, second)
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliders(motion.model(), group) else { return Ok(()) };
        let [first, second] = &dyad.legs;
        for leg in &dyad.legs {
            motion.found(leg.link(), motion.carried(leg.outer, leg.link()));
            dyad.follow_rest(motion, leg, leg.link())?;
        }
        let carried = dyad.legs.each_ref().map(|leg| dyad.velocity_of_pin(motion, leg));
        let gap = motion.lacking(dyad.inner, &carried[1], &carried[0]);
        let across = -motion.part(&gap, motion.placement.slide_direction(second.outer).perp());
        let speed = if across.is_zero() {
            across
        } else {
            across
                / motion.pivots.dividing_slides(motion.placement, slides(&dyad), &dyad.pivot_name(), &dyad.group_name())
        };
        let how = format!(": the guides' relative {{velocity}} across the other slide over {}", dyad.pivot_name());
        let speed = motion.named_sliding(speed, first.outer, &dyad.link_name(first), &how);
        motion.records(first.outer, first.link(), speed);
        let sliding = motion.along_slide(first.outer, speed);
        let velocity = carried[0].plus(&sliding, motion.placement.direction(GROUND));
        // The pin's own link first: of a slot that its pin is driven along, the carrier follows.
        let legs = || dyad.legs.iter();
        legs().filter(|leg| leg.tip.slot.is_none()).chain(legs().filter(|leg| leg.tip.slot.is_some())).try_for_each(
            |leg| {
                let link = leg.tip.end.link;
                let velocity = if leg.tip.slot.is_some() { motion.passed_on(dyad.inner, link) } else { velocity };
                let at = motion.placement.point(leg.tip);
                motion.found(link, Twist { rate: motion.rate(link), at, velocity });
                dyad.follow_rest(motion, leg, link)
            },
        )
    }
}
