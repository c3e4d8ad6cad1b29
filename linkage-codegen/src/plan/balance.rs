//! Equilibrium of one load case: what acts on every link, and what the groups solved so far exert.
//!
//! Groups are solved from the last to the first: the reactions of a group load the groups before it.

use std::collections::BTreeMap;

use super::framed::Framed;
use super::pivots::Pivots;
use super::placement::Placement;
use super::reactions;
use crate::equations::joints::Component;
use crate::equations::loads::Action;
use crate::graph::number::Number;
use crate::graph::{Expr, Graph, Op, Symbol, Vector};
use crate::model::ids::{GROUND, JointId, LinkId, UnknownId};
use crate::model::{End, JointKind, Model, arm_name};

/// Two places of a link are close to each other if others are so many times as far away.
const CLOSE: i64 = 8;

/// What acts on a link: forces and a couple.
#[derive(Clone, Debug)]
struct Wrench<'m> {
    forces: Vec<Acting<'m>>,
    couple: Expr<'m>,
}

/// A force on a link.
#[derive(Clone, Copy, Debug)]
struct Acting<'m> {
    /// Its place along and across the link's direction.
    at: Vector<'m>,
    force: Framed<'m>,
    /// Whether it is a load, which is given, and not what a joint was found to exert.
    is_load: bool,
    /// How many forces at this place it is the sum of.
    forces: i64,
}

/// The moment of what acts on a link, in ways that differ in rounding only.
struct Moment<'m> {
    /// Loads turned by the link's direction as it is known first.
    turned: Expr<'m>,
    /// The same by its direction of unit size, which a pose keeps.
    by_unit: Expr<'m>,
    /// By arms that a pose keeps.
    of_kept: Expr<'m>,
}

impl<'m> Acting<'m> {
    fn one(at: Vector<'m>, force: Framed<'m>, is_load: bool) -> Self {
        Self { at, force, is_load, forces: 1 }
    }
}

/// The reaction of a joint on its second link, at the joint's place on it; of a gear pair where the wheels touch.
#[derive(Clone, Copy, Debug)]
pub struct Reaction<'m> {
    /// The force.
    pub force: Framed<'m>,
    /// The couple of a slide or a weld.
    pub couple: Option<Expr<'m>>,
}

/// The equilibrium of a load case.
#[derive(Clone, Debug)]
pub struct Balance<'m, 'p> {
    /// Where the links are.
    pub placement: &'p Placement<'m>,
    /// Known angles.
    pub pivots: &'p Pivots<'m>,
    /// What distinguishes the names of this case.
    pub prefix: String,
    wrenches: Vec<Wrench<'m>>,
    reactions: BTreeMap<JointId, Reaction<'m>>,
    efforts: BTreeMap<UnknownId, Expr<'m>>,
}

impl<'m, 'p> Balance<'m, 'p> {
    /// Under some loads, before any group is solved.
    #[must_use]
    pub fn new(placement: &'p Placement<'m>, pivots: &'p Pivots<'m>, prefix: String, actions: &[Action]) -> Self {
        let nothing = Wrench { forces: Vec::new(), couple: placement.graph().zero() };
        let wrenches = vec![nothing; placement.model.links.len()];
        let mut balance =
            Self { placement, pivots, prefix, wrenches, reactions: BTreeMap::new(), efforts: BTreeMap::new() };
        for action in actions {
            let graph = placement.graph();
            match *action {
                Action::Force { link, at, force, frame } => {
                    let at = placement.carried(link, at.vector(graph));
                    let force = balance.force_in_frame(force.vector(graph), frame);
                    balance.act(link, Acting::one(at, force, true));
                }
                Action::Couple { link, moment } => balance.couple(link, graph.expr(moment)),
            }
        }
        balance
    }

    /// The linkage.
    #[must_use]
    pub fn model(&self) -> &'m Model {
        self.placement.model
    }

    /// All expressions.
    #[must_use]
    pub fn graph(&self) -> &'m Graph {
        self.placement.graph()
    }

    /// A force given in the axes of a link's frame.
    #[must_use]
    pub fn force_in_frame(&self, components: Vector<'m>, frame: LinkId) -> Framed<'m> {
        Framed { components: self.placement.carried(frame, components), axes: self.placement.direction(frame) }
    }

    /// A force in ground axes.
    #[must_use]
    pub fn ground_force(&self, components: Vector<'m>) -> Framed<'m> {
        Framed { components, axes: self.placement.direction(GROUND) }
    }

    /// Puts the force of a joint on a link, at a place along and across its direction.
    pub fn push(&mut self, link: LinkId, at: Vector<'m>, force: Framed<'m>) {
        self.act(link, Acting::one(at, force, false));
    }

    /// Forces at one place in the same axes are added up. Those in other axes stay apart: in its own axes what has no moment is seen to have
    /// none, as the part of a link's inertia along its arm.
    fn act(&mut self, link: LinkId, acting: Acting<'m>) {
        if link == GROUND || acting.force.components.is_zero() {
            return;
        }
        let ground = self.placement.direction(GROUND);
        let forces = &mut self.wrenches[link.index()].forces;
        match forces.iter_mut().find(|there| there.at == acting.at && there.force.axes == acting.force.axes) {
            Some(there) => {
                there.force = there.force.plus(&acting.force, ground);
                there.is_load &= acting.is_load;
                there.forces += acting.forces;
            }
            None => forces.push(acting),
        }
    }

    /// Puts a couple on a link.
    pub fn couple(&mut self, link: LinkId, moment: Expr<'m>) {
        let couple = &mut self.wrenches[link.index()].couple;
        *couple = *couple + moment;
    }

    /// Puts a force at a place and a couple in the stead of all that acts on a link.
    pub fn reduce(&mut self, link: LinkId, at: Vector<'m>, force: Framed<'m>, couple: Expr<'m>) {
        self.wrenches[link.index()] = Wrench { forces: vec![Acting::one(at, force, false)], couple };
    }

    /// Lets the loads on a link act at one of its pins on the other link there, and leaves their moment about it. At a pin on the ground they
    /// have no power.
    pub fn carry_over(&mut self, pin: JointId, link: LinkId) {
        self.carry_some_over(pin, link, |_| true);
    }

    /// The same of those whose places are asked for. Whether there are any.
    pub fn carry_some_over(&mut self, pin: JointId, link: LinkId, which: impl Fn(Vector<'m>) -> bool) -> bool {
        let Some(far) = self.model().joint(pin).end_off(link) else { return false };
        let about = self.placement.slide_point(pin, link);
        let wrench = self.wrenches[link.index()].clone();
        let (carried, stay): (Vec<_>, Vec<_>) = wrench.forces.into_iter().partition(|acting| which(acting.at));
        if carried.is_empty() {
            return false;
        }
        self.wrenches[link.index()] = Wrench { forces: carried, couple: wrench.couple };
        let (force, couple) = (self.total(link), self.moment_of_turned(link, about));
        self.wrenches[link.index()] = Wrench { forces: stay, couple };
        let at = self.placement.slide_point(pin, far.link);
        self.act(far.link, Acting::one(at, force, true));
        true
    }

    /// Whether a force on a link is known to act nearer to one of its places than another place is.
    #[must_use]
    pub fn acts_nearer(&self, link: LinkId, to: Vector<'m>, than: Vector<'m>) -> bool {
        let far = than - to;
        self.wrenches[link.index()].forces.iter().any(|acting| is_shorter(acting.at - to, far))
    }

    /// Whether all forces on a link are known to act nearer to one of its places than to another one.
    #[must_use]
    pub fn all_act_nearer(&self, link: LinkId, to: Vector<'m>, than: Vector<'m>) -> bool {
        let forces = &self.wrenches[link.index()].forces;
        !forces.is_empty() && forces.iter().all(|acting| is_shorter(acting.at - to, acting.at - than))
    }

    /// Whether all forces on a link are known to act close to one of its places, by the distance of another one.
    #[must_use]
    pub fn all_act_close_to(&self, link: LinkId, place: Vector<'m>, other: Vector<'m>) -> bool {
        let forces = &self.wrenches[link.index()].forces;
        !forces.is_empty() && forces.iter().all(|acting| is_close(acting.at, place, other))
    }

    /// Whether a force on a link is known to act there, and none farther away than the other place is.
    #[must_use]
    pub fn acts_close_to(&self, link: LinkId, place: Vector<'m>, other: Vector<'m>) -> bool {
        let forces = &self.wrenches[link.index()].forces;
        forces.iter().any(|acting| is_close(acting.at, place, other))
            && forces.iter().all(|acting| is_shorter(acting.at - place, other - place))
    }

    /// Whether all forces on a link are known to act farther from one of its places than another one is.
    #[must_use]
    pub fn all_act_beyond(&self, link: LinkId, from: Vector<'m>, than: Vector<'m>) -> bool {
        let forces = &self.wrenches[link.index()].forces;
        !forces.is_empty() && forces.iter().all(|acting| is_shorter(than - from, acting.at - from))
    }

    /// A place on a link amid the forces that act there: this one, where another force will act, or that of a force from which the ways to
    /// all of them are shorter together. Forces that act near each other may cancel, and the moment of what is left of them has the rounding
    /// of each, times its arm. Where the places are not numbers, it counts how many forces act elsewhere.
    #[must_use]
    pub fn amid_forces(&self, link: LinkId, place: Vector<'m>) -> Vector<'m> {
        let forces = &self.wrenches[link.index()].forces;
        let places = || forces.iter().map(|acting| (acting.at, acting.forces)).chain([(place, 1)]);
        let are_numbers = places().all(|(at, _)| (at - place).squared().value().is_some());
        let ways = |to: Vector<'m>| {
            let one = self.graph().one();
            let way = |from: Vector<'m>| if are_numbers || from == to { (to - from).size() } else { one };
            places().fold(self.graph().zero(), |sum, (at, forces)| sum + forces * way(at))
        };
        let nearer = |to: Vector<'m>, than: Vector<'m>| (ways(to) - ways(than)).sign() == Some(-1);
        forces.iter().fold(place, |best, acting| if nearer(acting.at, best) { acting.at } else { best })
    }

    /// Whether nothing acts on a link but forces at this place.
    #[must_use]
    pub fn acts_only_at(&self, link: LinkId, place: Vector<'m>) -> bool {
        let wrench = &self.wrenches[link.index()];
        wrench.couple.is_zero() && wrench.forces.iter().all(|acting| acting.at == place)
    }

    /// The sum of the forces on a link.
    #[must_use]
    pub fn total(&self, link: LinkId) -> Framed<'m> {
        let ground = self.placement.direction(GROUND);
        let forces = self.wrenches[link.index()].forces.iter().map(|acting| acting.force);
        forces
            .reduce(|sum, force| sum.plus(&force, ground))
            .unwrap_or(Framed { components: self.graph().zero_vector(), axes: ground })
    }

    /// The sum of the moments on a link about a place along and across its direction u, times a factor: `factor Σ (r × F) + factor C`.
    ///
    /// What is known first is multiplied first. Loads in ground axes are turned by their arms r along and across u, and added up:
    /// `Σ (r × F) = u × Σ (r·F, r × F)`; for reactions, which are found later than directions, the arms are turned by u, and multiplied by the
    /// factor after that: turned, they may be parts of the pose. An arm along the link, or across it, is one factor of the moment instead, but
    /// for loads that are added up. Loads do not wait for u to be brought to unit size.
    ///
    /// Where a pose is given, which several functions may share, it keeps the arms in ground axes, times the factor: there the moment of a force
    /// that is not known before is two products.
    #[must_use]
    pub fn moment(&self, link: LinkId, about: Vector<'m>, factor: Expr<'m>) -> Expr<'m> {
        let Moment { turned, of_kept, .. } = self.moment_in_ways(link, about, factor);
        turned.or_from_pose(of_kept)
    }

    /// The same by turned loads where a pose is given, too.
    #[must_use]
    pub fn moment_of_turned(&self, link: LinkId, about: Vector<'m>) -> Expr<'m> {
        let Moment { turned, by_unit, .. } = self.moment_in_ways(link, about, self.graph().one());
        turned.or_from_pose(by_unit)
    }

    /// The moment about the place that the motion of a link is given for. Where a pose is given, by the arms over the link's length that it keeps
    /// for equilibrium.
    #[must_use]
    pub fn moment_for_power(&self, link: LinkId, about: Vector<'m>) -> Expr<'m> {
        let (one, length) = (self.graph().one(), self.placement.length(link));
        let [turned, of_kept] = [one, one / length].map(|factor| self.moment_in_ways(link, about, factor));
        turned.turned.or_from_pose(length * of_kept.of_kept)
    }

    fn moment_in_ways(&self, link: LinkId, about: Vector<'m>, factor: Expr<'m>) -> Moment<'m> {
        let (direction, ground) = (self.placement.direction(link), self.placement.direction(GROUND));
        let wrench = &self.wrenches[link.index()];
        let mut sum = factor * wrench.couple;
        let mut from_pose = sum;
        let (mut loads, mut others) = (Vec::new(), Vec::new());
        for Acting { at, force, is_load, .. } in &wrench.forces {
            let way = *at - about;
            let arm = way.scaled(factor);
            if arm.is_zero() {
                continue;
            }
            let in_other_axes = force.axes == ground && direction != ground;
            let is_oblique = in_other_axes && !arm.x.is_zero() && !arm.y.is_zero();
            let is_turned = in_other_axes && *is_load;
            let along = || arm.cross(force.along(direction));
            if is_turned {
                loads.push((arm, force.components));
            } else if is_oblique {
                sum = sum + factor * way.turned_by(direction).cross(force.components);
            } else {
                sum = sum + along();
            }
            // Along the link the direction serves as well, with one product more: the arm is kept if the force itself is given.
            let is_given = |component: Expr<'m>| matches!(component.op(), Op::Symbol(Symbol::Load(..)));
            let is_direction =
                [(arm.x, arm.y), (arm.y, arm.x)].into_iter().any(|(a, b)| a.is_zero() && b.abs().is_one());
            let is_kept = is_oblique
                || is_turned && !is_direction && [force.components.x, force.components.y].into_iter().any(is_given);
            if is_kept && !(*is_load && force.components.is_constant()) {
                from_pose = from_pose + self.kept_arm(link, [about, *at], factor).cross(force.components);
            } else if is_turned {
                others.push((arm, force.components));
            } else {
                from_pose = from_pose + along();
            }
        }
        let plus = |sum: Expr<'m>, loads: &[(Vector<'m>, Vector<'m>)], direction: Vector<'m>| match loads {
            [] => sum,
            [(arm, force)] if arm.x.is_zero() || arm.y.is_zero() => sum + arm.cross(force.resolved_along(direction)),
            [(arm, force), loads @ ..] => {
                let first = force.resolved_along(*arm);
                sum + direction.cross(loads.iter().fold(first, |sum, (arm, force)| sum + force.resolved_along(*arm)))
            }
        };
        Moment {
            turned: plus(sum, &loads, self.placement.rough_direction(link)),
            by_unit: plus(sum, &loads, direction),
            of_kept: plus(from_pose, &others, direction),
        }
    }

    /// The arm from one place of a link to another one in ground axes, times a factor, as a pose keeps it.
    fn kept_arm(&self, link: LinkId, [from, to]: [Vector<'m>; 2], factor: Expr<'m>) -> Vector<'m> {
        let name = &self.model().link(link).name;
        let [from_name, to_name] = [from, to].map(|place| self.placement.name_of_place(link, place));
        let over = match (factor.is_one(), factor.value().and_then(|factor| Number::one().div(&factor))) {
            (true, _) => String::new(),
            (false, Some(length)) => format!(", over {}", length.to_f64()),
            (false, None) => ", over a length".to_owned(),
        };
        let meaning = format!("arm from {from_name} to {to_name} of {name}{over}");
        let direction = self.placement.direction(link);
        self.graph().beside(direction.x.id(), || {
            let arm = (to - from).scaled(factor).turned_by(direction);
            arm.named(&arm_name(&name.text, &from_name, &to_name), &meaning).held()
        })
    }

    /// Whether nothing acts on a link.
    #[must_use]
    pub fn is_free(&self, link: LinkId) -> bool {
        let wrench = &self.wrenches[link.index()];
        wrench.forces.is_empty() && wrench.couple.is_zero()
    }

    /// A pin exerts a force on a link; the other link gets the opposite one. Gives the force on the link as it was named: in ground
    /// axes, by the joint's own sign.
    pub fn pin(&mut self, joint: JointId, on: LinkId, force: Framed<'m>) -> Framed<'m> {
        let force = self.name_pin(joint, on, force);
        if let Some(far) = self.model().joint(joint).end_off(on) {
            self.push(far.link, self.placement.slide_point(joint, far.link), force.opposite());
        }
        force
    }

    /// The same, with the force not yet on the other link.
    pub fn name_pin(&mut self, joint: JointId, on: LinkId, force: Framed<'m>) -> Framed<'m> {
        let data = self.model().joint(joint);
        if let JointKind::Slot { .. } = data.kind {
            return self.name_pin_in_slot(joint, on, force);
        }
        let sign = if data.to.link == on { 1 } else { -1 };
        let signed = |v: Vector<'m>| if sign > 0 { v } else { -v };
        let (from, to) = (&self.model().link(data.from.link).name, &self.model().link(data.to.link).name);
        let meaning = format!("force on {to} by {from}");
        let reaction = signed(force.ground()).named(&self.name(&data.name.text), &meaning);
        let reaction = self.ground_force(reaction);
        self.reactions.insert(joint, Reaction { force: reaction, couple: None });
        if sign > 0 { reaction } else { reaction.opposite() }
    }

    /// The same of a pin in a slot along which it is driven: the slot exerts the part across it, and the drive that along it.
    fn name_pin_in_slot(&mut self, slot: JointId, on: LinkId, force: Framed<'m>) -> Framed<'m> {
        let data = self.model().joint(slot);
        let second = data.to.link == on;
        let axes = self.placement.slide_direction(slot);
        let part = if second { force } else { force.opposite() }.along(axes);
        let (from, to) = (&self.model().link(data.from.link).name, &self.model().link(data.to.link).name);
        let across = format!("force on {to} by {from} across the slot");
        let normal = part.y.named(self.name(&format!("{}_normal", data.name)), across);
        let along = match self.model().effort_of(slot, false) {
            Some(effort) => {
                let name = self.name(&self.model().unknown(effort).name);
                let along = part.x.named(name, format!("force on {to} by {from} along the slot {}", data.name));
                self.found(effort, along);
                along
            }
            None => part.x,
        };
        let reaction = Framed { components: Vector::new(self.graph().zero(), normal), axes };
        self.reactions.insert(slot, Reaction { force: reaction, couple: None });
        let force = Framed { components: Vector::new(along, normal), axes };
        if second { force } else { force.opposite() }
    }

    /// The force of a pin on one of its links, found before.
    #[must_use]
    pub fn pinned(&self, joint: JointId, on: LinkId) -> Framed<'m> {
        let force = self.reaction(joint).force;
        if self.model().joint(joint).to.link == on { force } else { force.opposite() }
    }

    /// The reaction of a slide on its second link, found from the equilibrium of the link `on`, its couple about the runner; the other link gets
    /// its part at the slide's place, with the couple there.
    pub fn slide(&mut self, joint: JointId, on: LinkId, force: Framed<'m>, [couple, at_place]: [Expr<'m>; 2]) {
        let data = self.model().joint(joint);
        // In a slot it is the drive of its angle that exerts the couple.
        let effort = match data.kind {
            JointKind::Slot { .. } => self.model().effort_of(joint, true),
            _ => None,
        };
        if let Some(effort) = effort {
            self.found(effort, couple);
        }
        self.reactions.insert(joint, Reaction { force, couple: effort.is_none().then_some(couple) });
        let (far, force, couple) = if data.to.link == on {
            (data.from.link, force.opposite(), -at_place)
        } else {
            (data.to.link, force, at_place)
        };
        self.push(far, self.placement.slide_point(joint, far), force);
        self.couple(far, couple);
    }

    /// The reaction of a joint, a number for each of its parts; both links get what it exerts at the joint's place on them. The couple of a slide
    /// is given about its runner.
    pub fn react(&mut self, joint: JointId, values: &[Expr<'m>]) {
        let data = self.model().joint(joint);
        let parts = reactions::parts(self.placement, joint);
        let graph = self.graph();
        let mut force = self.ground_force(graph.zero_vector());
        let (mut normal, mut couple) = (graph.zero(), None);
        for (part, value) in parts.iter().zip(values) {
            let own = Framed { components: part.force.components.scaled(*value), axes: part.force.axes };
            force = force.plus(&own, self.placement.direction(GROUND));
            match part.component {
                Component::Normal => normal = *value,
                Component::Couple => couple = Some(*value),
                Component::X | Component::Y | Component::Tangential => {}
            }
            for (end, couple) in data.ends().into_iter().zip(part.couples) {
                self.couple(end.link, couple * *value);
            }
        }
        self.push(data.to.link, self.placement.slide_point(joint, data.to.link), force);
        self.push(data.from.link, self.placement.slide_point(joint, data.from.link), force.opposite());
        let about_runner = |at_place: Expr<'m>| {
            let ahead = self.placement.ahead_of_runner(joint);
            let couple = at_place + ahead * normal;
            if ahead.is_zero() {
                couple
            } else {
                couple.named(self.name(&format!("{}_couple", data.name)), "about its runner")
            }
        };
        self.reactions.insert(joint, Reaction { force, couple: couple.map(about_runner) });
    }

    /// An unknown effort is found.
    pub fn found(&mut self, unknown: UnknownId, value: Expr<'m>) {
        self.efforts.insert(unknown, value);
    }

    /// The effort of an unknown.
    #[must_use]
    pub fn effort(&self, unknown: UnknownId) -> Expr<'m> {
        self.efforts.get(&unknown).copied().unwrap_or_else(|| self.graph().zero())
    }

    /// The reaction of a joint.
    #[must_use]
    pub fn reaction(&self, joint: JointId) -> Reaction<'m> {
        let nothing = Reaction { force: self.ground_force(self.graph().zero_vector()), couple: None };
        self.reactions.get(&joint).copied().unwrap_or(nothing)
    }

    /// The name of a quantity of this case.
    #[must_use]
    pub fn name(&self, name: &str) -> String {
        format!("{}{name}", self.prefix)
    }

    /// What a quantity of this case is called in an equation: its name, or words where it has no line of its own, a number or what is given.
    #[must_use]
    pub fn called(&self, quantity: Expr<'m>, name: &str, words: &str) -> String {
        match quantity.op() {
            Op::Constant(_) | Op::Symbol(_) => format!("({words})"),
            _ => self.name(name),
        }
    }

    /// The end of a joint on a link.
    #[must_use]
    pub fn end(&self, joint: JointId, link: LinkId) -> End {
        let joint = self.model().joint(joint);
        joint.end_on(link).unwrap_or(joint.from)
    }
}

/// Whether a place is known to be close to another one, by the distance of a third one from that.
pub(super) fn is_close<'m>(at: Vector<'m>, place: Vector<'m>, other: Vector<'m>) -> bool {
    let graph = place.graph();
    is_shorter((at - place).scaled(CLOSE * graph.one()), other - place)
}

/// Whether a vector is known to be shorter than another one.
pub(super) fn is_shorter(vector: Vector<'_>, than: Vector<'_>) -> bool {
    (vector.squared() - than.squared()).sign() == Some(-1)
}
