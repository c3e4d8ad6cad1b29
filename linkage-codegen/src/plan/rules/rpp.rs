//! The RPP dyad: a slider, and on it another slider with a pin at its outer end.
//!
//! With the direction eₒ of the outer slide and eᵢ of the inner one, g from the pin on the second slider, when neither has travelled, to
//! where it has to be, and tₒ, tᵢ how far they travel:
//!
//! ```text
//! tₒ eₒ + tᵢ eᵢ = g      tₒ = (g × eᵢ)/(eₒ × eᵢ)      tᵢ = g·eᵢ − tₒ (eₒ·eᵢ)
//! ```
//!
//! Both turn with the outer guide, so there is nothing to choose, and `eₒ × eᵢ` does not change with the pose.
//!
//! Forces: with Wₒ the loads on the first slider, what the inner slide exerts on the second one across itself is
//! `N = (eₒ·Wₒ)/(eᵢ × eₒ)`, since the outer guide takes nothing along eₒ. The pin holds the rest, the moments give the couples.
//!
//! Velocities: with c that of the pin's place as if it were fixed to the outer guide, `ṡₒ = ((v − c) × eᵢ)/(eₒ × eᵢ)`.

use super::dyad::{Dyad, dyad};
use super::travels::count;
use super::{Rule, RuleResult};
use crate::model::Model;
use crate::model::ids::{GROUND, JointId};
use crate::plan::assembly::{Assembly, ClosedLoop, Found};
use crate::plan::balance::Balance;
use crate::plan::velocities::Motion;
use crate::topology::Group;

/// The rule.
pub(super) struct Rpp;

/// The group as an RPP dyad, the link with the pin first.
fn sliders<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let mut dyad = dyad(model, group)?;
    match dyad.pins() {
        [true, false, false] => {}
        [false, false, true] => dyad.legs.swap(0, 1),
        _ => return None,
    }
    Some(dyad)
}

/// The outer slide and the inner one.
fn slides(dyad: &Dyad<'_>) -> [JointId; 2] {
    [dyad.legs[1].outer, dyad.inner]
}

impl Rule for Rpp {
    fn class(&self) -> &'static str {
        "RPP dyad"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        sliders(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliders(assembly.model(), group) else { return Ok(()) };
        let [pinned, slider] = &dyad.legs;
        for (leg, slide, link) in [(slider, slider.outer, slider.link()), (pinned, dyad.inner, pinned.tip.end.link)] {
            assembly.placement.orient_along(slide, link);
            dyad.place_rest(assembly, leg, link)?;
            count(assembly, group, slide);
            assembly.placement.connect(slide);
        }
        let (cosine, sine) = dyad.state_slides(assembly, slides(&dyad))?;
        let [outer, inner] = slides(&dyad).map(|slide| dyad.joint_name(slide));
        let pin = dyad.joint_name(pinned.outer);
        let line = assembly.placement.line(dyad.inner);
        let e = line.direction;
        let way = assembly.placement.way(pinned.near, pinned.far);
        let gap = way.resolved_along(line);
        let gap = gap.named(
            &format!("g_{pin}"),
            &format!(
                "g, to {pin} from where it is on {} at no travel, along and across {inner}",
                dyad.link_name(pinned)
            ),
        );
        let own = (-gap.y / sine).named(
            format!("t_{outer}"),
            format!("tₒ = (g × eᵢ)/{}, eₒ along {outer}, eᵢ along {inner}", dyad.pivot_name()),
        );
        let further = (gap.x - own * cosine).named(format!("t_{inner}"), "tᵢ = g·eᵢ − tₒ (eₒ·eᵢ)");
        let along = assembly.placement.slide_direction(slider.outer);
        assembly.closed(|| ClosedLoop {
            name: pin.to_owned(),
            residual: along.scaled(own) + e.scaled(further) - way.vector(),
            found: [Found::Length { length: own, column: along }, Found::Length { length: further, column: e }],
            determinant: sine,
            pivot: None,
            apart: false,
        });
        dyad.set_travel(assembly, slider.outer, slider.link(), own);
        dyad.set_travel(assembly, dyad.inner, pinned.tip.end.link, further);
        assembly.placement.connect(pinned.outer);
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliders(balance.model(), group) else { return Ok(()) };
        let [pinned, slider] = &dyad.legs;
        let [outer, inner] = slides(&dyad).map(|slide| dyad.joint_name(slide));
        let e = balance.placement.slide_direction(slider.outer);
        let load = slider.total(balance).along(e);
        let name = dyad.link_name(slider);
        let along_outer = balance.name(&format!("{outer}_along"));
        let along = load.x.named(along_outer.as_str(), format!("ΣF of the loads on {name} along the slide {outer}"));
        let across = if along.is_zero() {
            along
        } else {
            let sine = balance.pivots.dividing_slides(
                balance.placement,
                slides(&dyad),
                &dyad.pivot_name(),
                &dyad.group_name(),
            );
            (-(along / sine))
                .named(balance.name(&format!("{inner}_across")), format!("−{along_outer}/{}", dyad.pivot_name()))
        };
        dyad.guide_inner(balance, pinned, -across);
        if pinned.is_single() {
            let ground = balance.placement.direction(GROUND);
            let guided = dyad.guided(balance, pinned);
            let held = balance.total(pinned.link()).plus(&guided, ground);
            balance.pin(pinned.outer, pinned.link(), held.opposite());
        } else {
            dyad.balance_rest(balance, pinned)?;
        }
        // The inner slide has put its part on the first slider.
        if !slider.is_single() {
            return dyad.balance_rest(balance, slider);
        }
        // What acts on the slider is all on it, and what it comes to is across its guide. About the guide's own place, or amid the forces:
        // where the inner slide is may be far away, and its force small beside the others.
        let own = balance.placement.point(balance.placement.counted_from(slider.outer, slider.link()));
        let at = balance.amid_forces(slider.link(), own);
        let held = load.y - across * balance.placement.between(slides(&dyad)).x;
        super::slide::guide(balance, slider.outer, slider.link(), held, at);
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let Some(dyad) = sliders(motion.model(), group) else { return Ok(()) };
        let [pinned, slider] = &dyad.legs;
        let pin = motion.passed_on(pinned.outer, pinned.link());
        // Neither slides: the way from the outer guide's runner to the pin goes through the inner slide.
        motion.found(slider.link(), motion.carried(slider.outer, slider.link()));
        dyad.follow_rest(motion, slider, slider.link())?;
        motion.found(pinned.tip.end.link, motion.carried(dyad.inner, pinned.tip.end.link));
        dyad.follow_rest(motion, pinned, pinned.tip.end.link)?;
        let gap = motion.lacking(pinned.outer, &pin, &motion.of_point(pinned.near));
        let across = -motion.part(&gap, motion.placement.slide_direction(dyad.inner).perp());
        let speed = if across.is_zero() {
            across
        } else {
            across
                / motion.pivots.dividing_slides(motion.placement, slides(&dyad), &dyad.pivot_name(), &dyad.group_name())
        };
        let how = format!(": relative {{velocity}} across the inner slide over {}", dyad.pivot_name());
        let speed = motion.named_sliding(speed, slider.outer, &dyad.link_name(slider), &how);
        motion.slides(slider.outer, slider.link(), speed);
        dyad.follow_rest(motion, slider, slider.link())?;
        let rate = motion.rate(pinned.link());
        dyad.turn(motion, pinned, rate)
    }
}
