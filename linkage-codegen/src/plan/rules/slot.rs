//! One link with a slot and a pin, or a slot and a slide: the slot is its own, or the pin in it.
//!
//! **Slot and pin**, a lever that carries its slot: with O its pin, h the distance of the slot's line from O, d the vector from O to the
//! pin in the slot, e the slot's direction and `n = e⊥`:
//!
//! ```text
//! d = s e + h n      s = ±√(d·d − h²)      + where the pin is ahead of O
//! e = d (s − i h)/(d·d)                     as complex numbers
//! ```
//!
//! A link whose end runs in the slot of another one is the link of an RRP dyad without its slider. In both cases the moment about O
//! gives the normal force, with the lever arm `r × n`: of a lever s, of the other link the part of its length along the slot.
//!
//! **Slot and slide**: with m the slide's direction and Q the vector from the slot's point to the pin at no travel, the travel is
//! `x = ∓(n·Q)/(n·m)`, and the sum of the forces along the slide gives the normal force. `n·m = e × m` is the pivot.

use super::dyad::towards_unit;
use super::rrp::{Meeting, ahead, by_parts, meet};
use super::slide::guide;
use super::travels::count;
use super::{Rule, RuleResult};
use crate::graph::{Expr, Failure, Symbol, Vector};
use crate::model::ids::{GROUND, JointId, LinkId};
use crate::model::{End, JointKind, Model};
use crate::plan::assembly::{Assembly, ClosedLoop, DyadPivot, Found, Pivot, Sign};
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::pivots::{Pivots, divisor};
use crate::plan::placement::{Orientation, Placement, Spot};
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Freedom, Group};

/// The rule of a link with a slot and a pin.
pub(super) struct SlotAndPin;

/// The rule of a link with a slot and a slide.
pub(super) struct SlotAndSlide;

/// The parts of such a link.
#[derive(Clone, Copy)]
struct Parts<'a> {
    model: &'a Model,
    link: LinkId,
    slot: JointId,
    /// Whether the slot is the link's own, and the pin in it belongs to the other link.
    carries: bool,
    /// The pin or the slide that holds the link beside the slot.
    held: JointId,
}

/// The link of a group, if it is held by a slot and by a joint that leaves this freedom.
fn parts<'a>(model: &'a Model, group: &Group, leaves: Freedom) -> Option<Parts<'a>> {
    let (&[link], &[a, b]) = (&*group.links, &*group.outer) else { return None };
    if !group.inputs.iter().all(|input| Group::drive_of(model, *input).is_some()) {
        return None;
    }
    let freedom = |joint: JointId| group.freedom(model, joint);
    [(a, b), (b, a)].into_iter().find_map(|(slot, held)| {
        let JointKind::Slot { carrier, .. } = model.joint(slot).kind else { return None };
        let fits = freedom(slot) == Freedom::TurnAndSlide && freedom(held) == leaves;
        fits.then_some(Parts { model, link, slot, carries: carrier == link, held })
    })
}

fn with_pin<'a>(model: &'a Model, group: &Group) -> Option<Parts<'a>> {
    parts(model, group, Freedom::Turn)
}

fn with_slide<'a>(model: &'a Model, group: &Group) -> Option<Parts<'a>> {
    parts(model, group, Freedom::Slide)
}

impl<'m> Parts<'m> {
    fn name(&self) -> &'m str {
        &self.model.link(self.link).name.text
    }

    fn joint_name(&self, joint: JointId) -> &'m str {
        &self.model.joint(joint).name.text
    }

    /// The other link of a joint.
    fn far(&self, joint: JointId) -> LinkId {
        let data = self.model.joint(joint);
        if data.to.link == self.link { data.from.link } else { data.to.link }
    }

    /// Whether the pin that holds the link moves in a slot of the link.
    fn carries_held(&self) -> bool {
        matches!(self.model.joint(self.held).kind, JointKind::Slot { carrier, .. } if carrier == self.link)
    }

    /// From the place in the link's frame of the pin that holds it to one of its points: what of it is constant, and what a drive adds that
    /// moves the pin there. With what the rounding of that place is proportional to: nothing if it does not move.
    fn way_from_held(&self, to: End) -> ([Vector<'m>; 2], Expr<'m>) {
        let (model, graph) = (self.model, &self.model.graph);
        let held = model.joint(self.held);
        let end = held.end_on(self.link).unwrap_or(held.to);
        let constant = model.local(to) - model.local(end);
        match (held.kind.line(), model.drive_of(self.held, false)) {
            (Some((carrier, axis)), Some(drive)) if carrier == self.link => {
                let travel = self.signed(self.held, graph.symbol(Symbol::Drive(drive)));
                let varying = -axis.vector(graph).scaled(travel);
                ([constant, varying], model.local(end).size() + travel.abs())
            }
            _ => ([constant, graph.zero_vector()], graph.zero()),
        }
    }

    /// The travel of a joint from the link that carries its line to the other one, by the joint's own sign.
    fn signed(&self, joint: JointId, ahead: Expr<'m>) -> Expr<'m> {
        let data = self.model.joint(joint);
        let carried_by_first = data.kind.line().is_some_and(|(carrier, _)| carrier == data.from.link);
        if carried_by_first { ahead } else { -ahead }
    }

    /// The travel in the slot, by how far the pin is ahead of where it counts from.
    fn travel(&self, placement: &Placement<'m>, ahead: Expr<'m>) -> Expr<'m> {
        let meaning = format!("travel in the slot {}", self.joint_name(self.slot));
        self.signed(self.slot, ahead).named(placement.name_of_travel(self.slot), meaning)
    }

    /// The reaction of the slot that exerts the force `normal` on the link: the opposite of what the equation says.
    fn react(&self, balance: &mut Balance<'m, '_>, normal: Expr<'m>, equation: &str) {
        let second = self.model.joint(self.slot).to.link == self.link;
        let (normal, sign) = if second { (normal, "−") } else { (-normal, "") };
        let name = balance.name(&format!("{}_normal", self.joint_name(self.slot)));
        balance.react(self.slot, &[normal.named(name, format!("{sign}{equation}"))]);
    }

    /// What the velocity of the link at the slot lacks of that of the other link there.
    fn missing(&self, motion: &Motion<'m, '_>) -> Framed<'m> {
        let [own, other] = [self.link, self.far(self.slot)]
            .map(|link| motion.of_place(link, motion.placement.slide_point(self.slot, link)));
        let beyond = motion.coriolis(self.slot, self.link);
        motion.lacking(self.slot, &other.plus(&beyond, motion.placement.direction(GROUND)), &own)
    }

    /// The lever arm of the slot's normal about the pin, as a divisor.
    fn arm(&self, placement: &Placement<'m>) -> Expr<'m> {
        let name = format!("arm_{}", self.joint_name(self.slot));
        let arm = placement.arm(self.slot, self.held).unwrap_or_else(|| {
            let graph = placement.graph();
            let reach = placement.slide_point(self.slot, self.link) - placement.slide_point(self.held, self.link);
            let normal = placement.slide_direction(self.slot).perp();
            let arm = if self.carries {
                reach.dot(placement.slide_along(self.slot))
            } else {
                reach.cross(normal.resolved_along(placement.direction(self.link)))
            };
            let arm = arm.named(name.clone(), "lever arm of the slot's normal");
            arm.where_above(arm.abs(), graph.epsilons(8) * (reach.x.magnitude() + reach.y.magnitude()))
        });
        divisor(arm, &name, self.name())
    }
}

impl Rule for SlotAndPin {
    fn class(&self) -> &'static str {
        "slot and pin"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        with_pin(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(parts) = with_pin(assembly.model(), group) else { return Ok(()) };
        let (slot, pin) = (parts.joint_name(parts.slot), parts.joint_name(parts.held));
        let lies = if parts.carries {
            format!("along the slot of `{}`, its pin `{slot}` lies ahead of `{pin}` or behind it", parts.name())
        } else {
            format!("along the slot `{slot}`, the pin in it lies ahead of `{pin}` or behind it")
        };
        let ahead = ahead(assembly, group, parts.slot, parts.held, lies)?;
        if parts.carries {
            place_lever(assembly, group, &parts, ahead);
            return Ok(());
        }
        place_runner(assembly, group, &parts, ahead)
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let Some(parts) = with_pin(balance.model(), group) else { return Ok(()) };
        let about = balance.placement.slide_point(parts.held, parts.link);
        let moment = balance.moment(parts.link, about, balance.graph().one());
        let normal = if moment.is_zero() { moment } else { -(moment / parts.arm(balance.placement)) };
        let (pin, name) = (parts.joint_name(parts.held), parts.name());
        let arm = format!("arm_{}", parts.joint_name(parts.slot));
        parts.react(balance, normal, &format!("ΣM({pin})/{arm} of what acts on {name}"));
        balance.pin(parts.held, parts.link, balance.total(parts.link).opposite());
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let Some(parts) = with_pin(motion.model(), group) else { return Ok(()) };
        let at = motion.placement.slide_point(parts.held, parts.link);
        let velocity = motion.passed_on(parts.held, parts.link);
        // If the link did not turn.
        motion.found(parts.link, Twist { rate: motion.graph().zero(), at, velocity });
        let gap = parts.missing(motion);
        let normal = motion.placement.slide_direction(parts.slot).perp();
        let part = motion.part(&gap, normal);
        let rate = if part.is_zero() { part } else { part / parts.arm(motion.placement) };
        let how = ": the pins' relative {velocity} across the slot over its lever arm";
        let rate = motion.named_rate(rate, parts.name(), how);
        motion.found(parts.link, Twist { rate, at, velocity });
        Ok(())
    }
}

/// A lever with its own slot.
fn place_lever<'m>(assembly: &mut Assembly<'m>, group: &Group, parts: &Parts<'m>, ahead: Sign<'m>) {
    let Parts { model, link, slot, held, .. } = *parts;
    let graph = assembly.graph();
    let pin = model.joint(slot);
    let (Some(own), Some(to)) = (pin.end_on(link), pin.end_off(link)) else { return };
    let Some(from) = Spot::of_pin(model, held, parts.far(held)) else { return };
    let Some((_, axis)) = pin.kind.line() else { return };
    let axis = axis.vector(graph);
    let (name, at, about) = (parts.name(), parts.joint_name(slot), parts.joint_name(held));
    // From the pin O to the slot's point, along and across the slot.
    let (between, slack) = parts.way_from_held(own);
    let [constant, varying] = between.map(|part| part.resolved_along(axis));
    let datum = constant + varying;
    let h = datum.y;
    let way = assembly.placement.way(from, to);
    let d = way.vector().named(&format!("d_{at}"), &format!("d, from {about} to the pin in the slot"));
    let d2 = d.squared().named(format!("D2_{at}"), "d·d");
    let size = d2.sqrt().named(format!("D_{at}"), format!("distance of {about} from the pin in the slot"));
    let (s, direction) = if h.is_zero() {
        let size = if way.exceeds(graph.zero(), way.length()) {
            size
        } else {
            let failure = Failure::CoincidentPivots { group: name.into(), joint: at.into() };
            size.require_above(size, graph.epsilons(2) * way.length(), failure)
        };
        let size = size.known_positive();
        let s = ahead.of(size);
        (s, Vector::new(d.x / s, d.y / s))
    } else {
        let square = (d2 - h.squared())
            .named(format!("s2_{at}"), format!("s² = d·d − h², h how far the slot's line passes {about}"));
        let (square, rounding) = if way.exceeds(h.abs(), slack + way.length()) {
            (square.known_positive(), graph.zero())
        } else {
            let rounding = graph.epsilons(2) * (h.squared() + h.abs() * slack + size * way.length());
            let terms = "2ε (h² + |h| Λ + D L), L the lengths that make up d, Λ those that a drive brings into h";
            let meaning = format!("what rounding makes of s2_{at} = 0: {terms}");
            (square, rounding.named(format!("rounding_s2_{at}"), meaning))
        };
        let gap = (h.abs() - size).id();
        let failure = Failure::CannotAssemble { group: name.into(), joint: at.into(), gap };
        let square = square.require_at_least(square, -rounding, failure);
        let s = ahead.of(square.non_negative().sqrt());
        let equation = match ahead {
            Sign::Plus => format!("s = √(s²), its pin ahead of {about}"),
            Sign::Minus => format!("s = −√(s²), its pin behind {about}"),
            Sign::Given(..) => format!("s = side_{at} √(s²), how far its pin is ahead of {about}"),
        };
        let s = s.named(format!("s_{at}"), equation);
        let rough = Vector::new(s / d2, -(h / d2)).turned_by(d);
        let rough = rough.named_direction(&format!("rough_{name}"), "(s d − h d⊥)/(d·d)");
        let correction =
            graph.constant(&crate::graph::number::Number::ratio(1, 2)) * (3 * graph.one() - rough.squared());
        let arm = s.where_above(square, rounding);
        let arm = arm.named(format!("arm_{at}"), "s, zero where it is no larger than its rounding");
        assembly.placement.set_arm(slot, held, arm.held());
        (s, rough.scaled(correction.named(format!("correction_{name}"), "1.5 − 0.5 |rough|²")))
    };
    let direction = direction.named_direction(name, &format!("direction of the slot of {name}"));
    let reach = direction.scaled(s) + direction.perp().scaled(h);
    assembly.closed(|| ClosedLoop {
        name: at.to_owned(),
        residual: reach - d,
        found: [
            Found::Direction { direction, column: reach.perp(), arm: reach },
            Found::Length { length: s, column: direction },
        ],
        determinant: -s,
        pivot: None,
        apart: false,
    });
    assembly.placement.orient(link, Orientation { direction, axis });
    assembly.placement.connect(held);
    let fixed = datum.x + parts.signed(slot, count(assembly, group, slot));
    let travel = parts.travel(&assembly.placement, s - fixed);
    assembly.placement.set_travel(slot, travel);
    if datum.is_zero() {
        // The lever arm is the travel.
        let arm = parts.signed(slot, assembly.placement.travel(slot));
        assembly.placement.set_arm(slot, held, arm);
    } else if h.is_zero() {
        assembly.placement.set_arm(slot, held, s.held());
    }
}

/// A link whose end runs in a placed slot.
fn place_runner<'m>(assembly: &mut Assembly<'m>, group: &Group, parts: &Parts<'m>, ahead: Sign<'m>) -> RuleResult {
    let Parts { model, link, slot, held, .. } = *parts;
    let data = model.joint(slot);
    let (Some(own), Some(to)) = (data.end_on(link), Spot::of_pin(model, slot, parts.far(slot))) else { return Ok(()) };
    let Some(from) = Spot::of_pin(model, held, parts.far(held)) else { return Ok(()) };
    // With the travel still zero.
    count(assembly, group, slot);
    let ([constant, varying], slack) = parts.way_from_held(own);
    let arm = constant + varying;
    let moves = parts.carries_held();
    let r = if moves {
        let r = arm.size();
        let failure = Failure::CoincidentPivots { group: parts.name().into(), joint: parts.joint_name(slot).into() };
        let r = r.named(format!("length_{}", parts.name()), "distance of the pins in the two slots");
        r.require_above(r, r.graph().epsilons(4) * slack, failure).known_positive()
    } else {
        super::check_length(model, link, [held, slot])?;
        super::length_between(model, link, [held, slot])
    };
    let (name, at, about) = (parts.name(), parts.joint_name(slot), parts.joint_name(held));
    let line = assembly.placement.line(slot);
    let e = line.direction;
    let way = assembly.placement.way(from, to);
    let Meeting { q, h, cosine, sine, pivot } = meet((r, slack), &way, line, ahead, [at, about], name.into());
    let of_line = Vector::new(cosine, sine);
    let axis = Vector::new(arm.x / r, arm.y / r);
    let (direction, orientation) = if moves {
        // Its own slot moves the pin in the link: the link carries the direction of its frame.
        let between = of_line.turned_by(e);
        let rough = axis.conjugate().turned_by(between).named_direction(&format!("rough_{name}"), "");
        let meaning = format!("direction of {name}, from that between the pins {about} and {at}");
        let direction = towards_unit(rough, name).named_direction(name, &meaning);
        (between, Orientation { direction, axis: Vector::new(r.graph().one(), r.graph().zero()) })
    } else {
        let meaning = format!("direction of {name} from {about} to {at}");
        let direction = by_parts(of_line, e, name).named_direction(name, &meaning);
        (direction, Orientation { direction, axis })
    };
    assembly.placement.orient(link, orientation);
    assembly.placement.connect(held);
    let travel = parts.travel(&assembly.placement, h - q.x);
    let along = e.scaled(parts.signed(slot, r.graph().one()));
    let reach = direction.scaled(r);
    assembly.closed(|| ClosedLoop {
        name: at.to_owned(),
        residual: reach - (way.vector() + along.scaled(travel)),
        found: [
            Found::Direction { direction, column: reach.perp(), arm: reach },
            Found::Length { length: travel, column: -along },
        ],
        determinant: parts.signed(slot, r * cosine),
        pivot: Some(Pivot { value: cosine, again: direction.dot(e), slopes: None }),
        apart: false,
    });
    assembly.placement.set_travel(slot, travel);
    let u = assembly.placement.turned(link, axis);
    assembly.pivots.state(u, e, None, Some(pivot));
    assembly.dyads.push(DyadPivot::sine(model, slot, pivot, None));
    assembly.placement.set_arm(slot, held, r * pivot);
    Ok(())
}

impl Rule for SlotAndSlide {
    fn class(&self) -> &'static str {
        "slot and slide"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        with_slide(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(parts) = with_slide(assembly.model(), group) else { return Ok(()) };
        let Parts { model, link, slot, held: slide, .. } = parts;
        let data = model.joint(slot);
        assembly.placement.orient_along(slide, link);
        // With the travel still zero, the way goes over the guide.
        count(assembly, group, slide);
        assembly.placement.connect(slide);
        count(assembly, group, slot);
        let carried_by_first = data.kind.line().is_some_and(|(carrier, _)| carrier == data.from.link);
        let (line, pin) = if carried_by_first { (data.from, data.to) } else { (data.to, data.from) };
        let way = assembly.placement.way(Spot { end: line, slot: Some(slot) }, pin);
        let [e, m] = [slot, slide].map(|joint| assembly.placement.slide_direction(joint));
        let q = way.resolved_along(assembly.placement.line(slot));
        let (sine, cosine) = inclination(&assembly.placement, &assembly.pivots, &parts);
        let (at, along) = (parts.joint_name(slot), parts.joint_name(slide));
        // Sliding forwards, the link takes the pin along, or the slot from under it.
        let ahead = if parts.carries { q.y / sine } else { -(q.y / sine) };
        let run = if parts.carries { q.x - ahead * cosine } else { q.x + ahead * cosine };
        let forwards = model.joint(slide).to.link == link;
        let sign = if parts.carries == forwards { "" } else { "−" };
        let travel = if forwards { ahead } else { -ahead }.named(
            assembly.placement.name_of_travel(slide),
            format!("travel of the slide {along}: {sign}(n·Q)/(n·m), Q from the slot {at} to its pin at no travel"),
        );
        assembly.placement.set_travel(slide, travel);
        let taken = if parts.carries { m } else { -m };
        assembly.closed(|| ClosedLoop {
            name: at.to_owned(),
            residual: e.scaled(run) + taken.scaled(ahead) - way.vector(),
            found: [Found::Length { length: ahead, column: taken }, Found::Length { length: run, column: e }],
            determinant: if parts.carries { -sine } else { sine },
            pivot: None,
            apart: false,
        });
        let travel = parts.travel(&assembly.placement, run);
        assembly.placement.set_travel(slot, travel);
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let Some(parts) = with_slide(balance.model(), group) else { return Ok(()) };
        let (slide, link) = (parts.held, parts.link);
        let direction = balance.placement.slide_direction(slide);
        let along = balance.total(link).along(direction).x;
        let normal = if along.is_zero() {
            along
        } else {
            let (sine, _) = inclination(balance.placement, balance.pivots, &parts);
            -(along / sine)
        };
        let equation = format!("ΣF/(n·m) of what acts on {} along the slide {}", parts.name(), parts.joint_name(slide));
        parts.react(balance, normal, &equation);
        let across = balance.total(link).along(direction).y;
        // About the guide's own place on the link: the pin in the slot may be far away from the other forces.
        guide(balance, slide, link, across, balance.placement.point(balance.placement.counted_from(slide, link)));
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let Some(parts) = with_slide(motion.model(), group) else { return Ok(()) };
        let Parts { link, slot, held: slide, .. } = parts;
        motion.found(link, motion.carried(slide, link));
        let gap = parts.missing(motion);
        let part = motion.part(&gap, motion.placement.slide_direction(slot).perp());
        let (sine, _) = inclination(motion.placement, motion.pivots, &parts);
        let speed = if part.is_zero() { part } else { part / sine };
        let how = ": the relative {velocity} across the slot over n·m";
        let speed = motion.named_sliding(speed, slide, parts.name(), how);
        motion.slides(slide, link, speed);
        Ok(())
    }
}

/// Sine, as a divisor, and cosine between the slot and the slide. Where both turn together, they are constant.
fn inclination<'m>(placement: &Placement<'m>, pivots: &Pivots<'m>, parts: &Parts<'m>) -> (Expr<'m>, Expr<'m>) {
    let name = format!("sin_{}", parts.joint_name(parts.slot));
    let carrier = parts.model.joint(parts.slot).kind.line().map_or(GROUND, |(carrier, _)| carrier);
    if placement.direction(carrier) == placement.direction(parts.link) {
        let [slot, slide] = [placement.slide_along(parts.slot), placement.slide_along_on(parts.held, parts.link)];
        return (divisor(slot.cross(slide).named(name.clone(), "n·m"), &name, parts.name()), slot.dot(slide));
    }
    let [slot, slide] = [parts.slot, parts.held].map(|joint| placement.slide_direction(joint));
    (pivots.dividing_sine(slot, slide, &name, parts.name()), pivots.cosine(slot, slide))
}
