//! What all dyads share: two bodies, a joint between them, and an outer joint on each.
//!
//! For motion, links that a driven joint joins are one body: the drive says how they lie against each other, so that a cylinder with its
//! rod is a link whose length is an argument. The distance between two points of such a body is an expression in its drives. Once the
//! first link of the body is placed, the others are placed from it as driven links; and once the force at its inner joint is known, they
//! are solved as driven links, whose efforts are within the body.

use std::collections::BTreeSet;

use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Symbol, Vector};
use crate::model::ids::{DriveId, JointId, LinkId, UnknownId};
use crate::model::{End, JointKind, Model, UnknownKind};
use crate::plan::assembly::{Assembly, DyadPivot};
use crate::plan::balance::Balance;
use crate::plan::pivots::{divisor, significant};
use crate::plan::placement::{Orientation, Placement, Way};
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Group, Input};

/// A body of a dyad.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    /// Its outer joint.
    pub outer: JointId,
    /// The outer joint's end on a link outside the dyad.
    pub far: End,
    /// The outer joint's end on the body.
    pub near: End,
    /// The inner joint's end on the body.
    pub tip: End,
    /// Its links, that of the outer joint first.
    links: Vec<LinkId>,
    /// The drives between its links.
    drives: Vec<DriveId>,
}

/// The parts of a dyad.
#[derive(Clone, Debug)]
pub struct Dyad<'a> {
    pub(super) model: &'a Model,
    pub(super) legs: [Leg; 2],
    pub(super) inner: JointId,
}

/// The direction of a body between its joints, in the frame of its first link.
#[derive(Clone, Copy, Debug)]
struct Arm<'m> {
    /// The direction that the first link carries, in its own frame.
    axis: Vector<'m>,
    /// From the outer joint to the inner one, along and across that direction.
    along: Vector<'m>,
    /// Its size.
    size: Expr<'m>,
}

/// A group as a dyad, if it is one. Of forces each link stays by itself.
pub(super) fn dyad<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let no_effort = group.inputs.iter().all(|input| matches!(input, Input::Drive(_)));
    no_effort.then(|| dyad_of_bodies(model, group)).flatten()
}

/// The same, but of forces too the links that a driven joint joins are one body; the effort of the drive is found within it.
pub(super) fn dyad_of_bodies<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let drive_within = |input: &Input| {
        let drive = match *input {
            Input::Drive(drive) => drive,
            Input::Unknown(unknown) => match model.unknown(unknown).kind {
                UnknownKind::Drive(drive) => drive,
                UnknownKind::Torque(..) | UnknownKind::Force { .. } | UnknownKind::Thrust(_) => return None,
            },
        };
        group.inner.contains(&model.drive(drive).joint).then_some(drive)
    };
    let slides_or_turns =
        |joint: &JointId| matches!(model.joint(*joint).kind, JointKind::Revolute | JointKind::Prismatic { .. });
    if !group.outer.iter().chain(&group.inner).all(slides_or_turns) {
        return None;
    }
    let drives = group.inputs.iter().map(drive_within).collect::<Option<Vec<DriveId>>>()?;
    let is_driven = |joint: JointId| drives.iter().any(|drive| model.drive(*drive).joint == joint);
    let &[inner] = group.inner.iter().copied().filter(|joint| !is_driven(*joint)).collect::<Vec<_>>().as_slice() else {
        return None;
    };
    let leg = |outer: JointId| {
        let first = group.own_link(model, outer);
        let (near, far) = (model.joint(outer).end_on(first)?, model.joint(outer).end_off(first)?);
        let mut leg = Leg { outer, far, near, tip: near, links: vec![first], drives: Vec::new() };
        while let Some((drive, link)) = next_driven(model, &drives, &leg.links) {
            leg.links.push(link);
            leg.drives.push(drive);
        }
        leg.tip = model.joint(inner).ends().into_iter().find(|end| leg.links.contains(&end.link))?;
        Some(leg)
    };
    let &[a, b] = group.outer.as_slice() else { return None };
    let legs = [leg(a)?, leg(b)?];
    let links: BTreeSet<LinkId> = legs.iter().flat_map(|leg| leg.links.iter().copied()).collect();
    let apart = links.len() == legs[0].links.len() + legs[1].links.len();
    (apart && links.len() == group.links.len()).then_some(Dyad { model, legs, inner })
}

/// A link that a drive places from one of these, and the drive.
fn next_driven(model: &Model, drives: &[DriveId], from: &[LinkId]) -> Option<(DriveId, LinkId)> {
    drives.iter().find_map(|drive| {
        let mut ends = model.joint(model.drive(*drive).joint).ends().map(|end| end.link);
        if from.contains(&ends[1]) {
            ends.swap(0, 1);
        }
        (from.contains(&ends[0]) && !from.contains(&ends[1])).then_some((*drive, ends[1]))
    })
}

/// One step towards unit size, which squares the error.
pub(super) fn towards_unit<'m>(rough: Vector<'m>, name: &str) -> Vector<'m> {
    let half = |n: i64| rough.graph().constant(&Number::ratio(n, 2));
    let factor = half(3) - half(1) * rough.squared();
    rough.scaled(factor.named(format!("unit_{name}"), format!("(3 − u·u)/2, u = rough_{name}")))
}

pub(super) fn is_pin(model: &Model, joint: JointId) -> bool {
    matches!(model.joint(joint).kind, JointKind::Revolute)
}

impl Leg {
    /// The link of the outer joint.
    pub(super) fn link(&self) -> LinkId {
        self.near.link
    }

    pub(super) fn is_single(&self) -> bool {
        self.links.len() == 1
    }

    /// The driven links in an order in which they can be placed from one of its links.
    fn driven_from(&self, model: &Model, first: LinkId) -> Vec<(DriveId, LinkId)> {
        let (mut placed, mut order) = (vec![first], Vec::new());
        while let Some((drive, link)) = next_driven(model, &self.drives, &placed) {
            placed.push(link);
            order.push((drive, link));
        }
        order
    }
}

impl<'a> Dyad<'a> {
    /// Whether its outer joints and its inner one are pins: `[true, true, true]` is RRR.
    pub(super) fn pins(&self) -> [bool; 3] {
        [self.legs[0].outer, self.inner, self.legs[1].outer].map(|joint| is_pin(self.model, joint))
    }

    pub(super) fn joint_name(&self, joint: JointId) -> &'a str {
        &self.model.joint(joint).name.text
    }

    /// The name of a body: `tube_rod`.
    pub(super) fn link_name(&self, leg: &Leg) -> String {
        self.model.link_names(&leg.links).replace(" + ", "_")
    }

    pub(super) fn group_name(&self) -> String {
        let links: Vec<LinkId> = self.legs.iter().flat_map(|leg| leg.links.iter().copied()).collect();
        self.model.link_names(&links)
    }

    /// A leg that is held by two pins needs a length between them.
    pub(super) fn check_length(&self, leg: &Leg) -> RuleResult {
        if leg.is_single() { super::check_length(self.model, leg.link(), [leg.outer, self.inner]) } else { Ok(()) }
    }

    /// Distance of a leg's joints.
    pub(super) fn length(&self, leg: &Leg) -> Expr<'a> {
        if leg.is_single() {
            return super::length_between(self.model, leg.link(), [leg.outer, self.inner]);
        }
        self.arm(leg).size
    }

    /// What the rounding of a leg's length is proportional to: nothing if the length is constant.
    pub(super) fn slack(&self, leg: &Leg) -> Expr<'a> {
        if leg.is_single() {
            return self.model.graph.zero();
        }
        self.way_within(leg, leg.link(), self.arm_axis(leg)).length()
    }

    /// The direction from the outer joint to the inner one, in the frame of the leg's single link.
    pub(super) fn axis(&self, leg: &Leg) -> Vector<'a> {
        let (arm, length) = (self.model.local(leg.tip) - self.model.local(leg.near), self.length(leg));
        Vector::new(arm.x / length, arm.y / length)
    }

    /// The direction of a leg of a placed dyad from the outer joint to the inner one, in ground axes.
    pub(super) fn direction(&self, placement: &Placement<'a>, leg: &Leg) -> Vector<'a> {
        if leg.is_single() {
            return placement.turned(leg.link(), self.axis(leg));
        }
        let Arm { axis, along, size } = self.arm(leg);
        Vector::new(along.x / size, along.y / size).turned_by(placement.turned(leg.link(), axis))
    }

    /// Places the links of a leg whose direction from the outer joint to the inner one is known. Gives that direction as it is kept.
    pub(super) fn orient(
        &self,
        assembly: &mut Assembly<'a>,
        leg: &Leg,
        direction: Vector<'a>,
    ) -> Result<Vector<'a>, Diagnostic> {
        if leg.is_single() {
            assembly.placement.orient(leg.link(), Orientation { direction, axis: self.axis(leg) });
            return Ok(self.direction(&assembly.placement, leg));
        }
        let arm = self.arm(leg);
        let unit = Vector::new(arm.along.x / arm.size, arm.along.y / arm.size);
        let first = &self.model.link(leg.link()).name;
        let meaning = format!("direction of {first}, from that of {}", self.link_name(leg));
        let turned = unit.conjugate().turned_by(direction);
        // Off the line, the direction is not only turned round.
        let turned = if unit.y.is_zero() {
            turned
        } else {
            let rough = turned.named_direction(&format!("rough_{first}"), "turned back by the arm's direction");
            towards_unit(rough, &first.text)
        };
        let carried = turned.named_direction(&first.text, &meaning);
        assembly.placement.orient(leg.link(), Orientation { direction: carried, axis: arm.axis });
        self.place_rest(assembly, leg, leg.link())?;
        Ok(self.direction(&assembly.placement, leg))
    }

    /// The driven links of a leg as groups of their own, in the order in which they are placed from one of its links.
    fn driven(&self, leg: &Leg, first: LinkId, input: fn(DriveId) -> Input) -> Vec<(&'static dyn Rule, Group)> {
        let driven = |(drive, link): (DriveId, LinkId)| -> (&'static dyn Rule, Group) {
            let joint = self.model.drive(drive).joint;
            let rule: &dyn Rule = if is_pin(self.model, joint) { &super::crank::Crank } else { &super::slide::Slide };
            (rule, Group { links: vec![link], inner: Vec::new(), outer: vec![joint], inputs: vec![input(drive)] })
        };
        leg.driven_from(self.model, first).into_iter().map(driven).collect()
    }

    /// Places the other links of a leg from one of them.
    pub(super) fn place_rest(&self, assembly: &mut Assembly<'a>, leg: &Leg, placed: LinkId) -> RuleResult {
        self.driven(leg, placed, Input::Drive).iter().try_for_each(|(rule, group)| rule.place(assembly, group))
    }

    /// The moment of the loads on a leg about its outer joint, over its length.
    pub(super) fn moment_over_length(&self, balance: &Balance<'a, '_>, leg: &Leg) -> Expr<'a> {
        let (placement, length) = (balance.placement, self.length(leg));
        let inverse = balance.graph().one() / length;
        let own = balance.moment(leg.link(), placement.point(leg.near), inverse);
        leg.links[1..].iter().fold(own, |sum, link| {
            // About a place on the link, and with the arm of that place.
            let at = self.place_on(leg, *link);
            let direction = placement.direction(*link);
            let arm = placement.way(leg.near, at).resolved_along(direction).scaled(inverse);
            let force = balance.total(*link).along(direction);
            sum + (balance.moment(*link, placement.point(at), inverse) + arm.cross(force))
        })
    }

    /// A joint's end on a link of a leg: the inner joint's where it is one.
    fn place_on(&self, leg: &Leg, link: LinkId) -> End {
        let ends = leg.drives.iter().filter_map(|drive| self.model.joint(self.model.drive(*drive).joint).end_on(link));
        if leg.tip.link == link { leg.tip } else { ends.last().unwrap_or(leg.near) }
    }

    /// The efforts within a leg and the reaction of its outer joint, once the force at its inner joint is on it.
    pub(super) fn balance_rest(&self, balance: &mut Balance<'a, '_>, leg: &Leg) -> RuleResult {
        let effort = |drive: DriveId| Input::Unknown(UnknownId::new(drive.index()));
        self.driven(leg, leg.link(), effort).iter().rev().try_for_each(|(rule, group)| rule.balance(balance, group))?;
        let held = balance.total(leg.link());
        balance.pin(leg.outer, leg.link(), held.opposite());
        Ok(())
    }

    /// Moves a leg about its outer joint: its first link turns at this rate, the others as their drives say.
    pub(super) fn turn(&self, motion: &mut Motion<'a, '_>, leg: &Leg, rate: Expr<'a>) -> RuleResult {
        let (at, velocity) = (motion.placement.point(leg.near), motion.of_point(leg.far));
        motion.found(leg.link(), Twist { rate, at, velocity });
        self.follow_rest(motion, leg, leg.link())
    }

    /// The motion of the other links of a leg, once that of one of them is found.
    pub(super) fn follow_rest(&self, motion: &mut Motion<'a, '_>, leg: &Leg, found: LinkId) -> RuleResult {
        self.driven(leg, found, Input::Drive).iter().try_for_each(|(rule, group)| rule.follow(motion, group))
    }

    pub(super) fn pivot_name(&self) -> String {
        format!("sin_mu_{}", self.joint_name(self.inner))
    }

    /// States the sine between two slides; at a pose it divides what places the dyad. Slides that are always parallel guide nothing.
    pub(super) fn state_slides(
        &self,
        assembly: &mut Assembly<'a>,
        slides: [JointId; 2],
    ) -> Result<(Expr<'a>, Expr<'a>), Diagnostic> {
        let between = assembly.placement.between(slides);
        let [first, second] = slides.map(|slide| self.joint_name(slide));
        let sine = between.y.named(self.pivot_name(), format!("sine between the slides {first} and {second}"));
        let pivot = significant(sine, sine.graph().one());
        if pivot.is_zero() {
            let problem = format!(
                "the slides `{first}` and `{second}` are parallel: where {} lie along them is open at every pose",
                crate::diagnostics::list(&self.group_name().split(" + ").collect::<Vec<_>>())
            );
            let place = self.model.joint(slides[1]).name.place();
            return Err(Diagnostic::new(place, problem).help("turn one of them, so that it guides another way"));
        }
        let pivot = pivot
            .named(format!("{}_or_zero", self.pivot_name()), "zero where it is no larger than its rounding")
            .held();
        let [from, to] = slides.map(|slide| assembly.placement.slide_direction(slide));
        assembly.pivots.state(from, to, Some(pivot), None);
        assembly.dyads.push(DyadPivot::sine(self.model, self.inner, pivot));
        Ok((between.x, divisor(pivot, &self.pivot_name(), &self.group_name())))
    }

    /// The travel of a slide, of one of its links from the other one along its direction.
    pub(super) fn set_travel(&self, assembly: &mut Assembly<'a>, slide: JointId, of: LinkId, by: Expr<'a>) {
        let travel = if self.model.joint(slide).to.link == of { by } else { -by };
        let name = self.joint_name(slide);
        let travel = travel.named(format!("travel_{name}"), format!("travel of the slide {name}"));
        assembly.placement.set_travel(slide, travel);
    }

    /// The vector between a leg's joints, worked out with its first link lying along the x axis.
    fn arm(&self, leg: &Leg) -> Arm<'a> {
        let graph = &self.model.graph;
        let axis = self.arm_axis(leg);
        let way = self.way_within(leg, leg.link(), axis);
        let name = self.link_name(leg);
        let (from, to) = (self.joint_name(leg.outer), self.joint_name(self.inner));
        let meaning =
            format!("from {from} to {to}, along and across what {} carries", self.model.link(leg.link()).name);
        let along = way.vector().named(&format!("arm_{name}"), &meaning);
        let size = if along.y.is_zero() { along.x.abs() } else { along.size() };
        let size = size.named(format!("length_{name}"), format!("|{from} {to}|"));
        // Joints that meet leave the direction of the body open.
        let (group, joint) = (self.model.link_names(&leg.links), self.joint_name(self.inner).into());
        let failure = Failure::CoincidentPivots { group, joint };
        let size = size.require_above(size, graph.epsilons(4) * way.length(), failure).known_positive();
        Arm { axis, along, size }
    }

    /// What the first link of a body carries: the direction of its driven slide, so that what lies along that stays so.
    fn arm_axis(&self, leg: &Leg) -> Vector<'a> {
        let graph = &self.model.graph;
        let driven = leg.drives.iter().map(|drive| self.model.drive(*drive).joint);
        let own = |joint: &JointId| self.model.joint(*joint).end_on(leg.link()).is_some();
        let slide = driven.filter(own).find(|joint| !is_pin(self.model, *joint));
        let x_axis = Vector::new(graph.one(), graph.zero());
        slide.map_or(x_axis, |slide| Placement::of_ground(self.model).slide_axis(slide, leg.link()))
    }

    /// The way through a body from its outer joint to its inner one, with one of its links lying so that a direction in its frame is
    /// along the x axis.
    pub(super) fn way_within(&self, leg: &Leg, supposed: LinkId, axis: Vector<'a>) -> Way<'a> {
        let graph = &self.model.graph;
        let x_axis = Vector::new(graph.one(), graph.zero());
        let mut placement = Placement::of_ground(self.model);
        placement.suppose(supposed, Orientation { direction: x_axis, axis });
        for (drive, link) in leg.driven_from(self.model, supposed) {
            let joint = self.model.drive(drive).joint;
            let coordinate = graph.symbol(Symbol::Drive(drive));
            let orientation = placement.driven(joint, link, coordinate);
            placement.suppose(link, orientation);
            if is_pin(self.model, joint) { placement.connect(joint) } else { placement.set_travel(joint, coordinate) }
        }
        placement.way(leg.near, leg.tip)
    }
}
