//! A virtual motion: the velocities of the links when the coordinate of one unknown changes at unit rate and the others rest.
//!
//! It is the transpose of equilibrium: the same groups, the same pivots, in the order from the unknowns outwards.

use super::balance::Balance;
use super::framed::Framed;
use super::pivots::Pivots;
use super::placement::Placement;
use crate::equations::loads::Action;
use crate::graph::{Expr, Graph, Vector};
use crate::model::ids::{GROUND, JointId, LinkId, UnknownId};
use crate::model::{End, JointKind, Model};

/// The motion of a link: its rate of rotation, and the velocity of one of its places.
#[derive(Clone, Copy, Debug)]
pub struct Twist<'m> {
    /// Rate of rotation.
    pub rate: Expr<'m>,
    /// A place along and across the link's direction.
    pub at: Vector<'m>,
    /// Its velocity.
    pub velocity: Framed<'m>,
}

/// The velocities of a virtual motion.
#[derive(Debug)]
pub struct Motion<'m, 'p> {
    /// Where the links are.
    pub placement: &'p Placement<'m>,
    /// Known angles.
    pub pivots: &'p Pivots<'m>,
    /// The unknown whose coordinate changes.
    pub unknown: UnknownId,
    /// What distinguishes the names of this motion.
    pub prefix: String,
    twists: Vec<Twist<'m>>,
}

impl<'m, 'p> Motion<'m, 'p> {
    /// Before any group is solved.
    #[must_use]
    pub fn new(placement: &'p Placement<'m>, pivots: &'p Pivots<'m>, unknown: UnknownId, prefix: String) -> Self {
        let graph = placement.graph();
        let rest = Framed { components: graph.zero_vector(), axes: placement.direction(GROUND) };
        let still = Twist { rate: graph.zero(), at: graph.zero_vector(), velocity: rest };
        Self { placement, pivots, unknown, prefix, twists: vec![still; placement.model.links.len()] }
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

    /// The motion of a link is found.
    pub fn found(&mut self, link: LinkId, twist: Twist<'m>) {
        self.twists[link.index()] = twist;
    }

    /// A link's rate of rotation.
    #[must_use]
    pub fn rate(&self, link: LinkId) -> Expr<'m> {
        self.twists[link.index()].rate
    }

    /// The rate at which an unknown's coordinate changes: one or zero.
    #[must_use]
    pub fn rate_of(&self, unknown: UnknownId) -> Expr<'m> {
        if unknown == self.unknown { self.graph().one() } else { self.graph().zero() }
    }

    /// The velocity of a joint's point on a link.
    #[must_use]
    pub fn of_point(&self, end: End) -> Framed<'m> {
        self.of_place(end.link, self.placement.point(end))
    }

    /// The velocity of a place along and across a link's direction: `v + ω r⊥`.
    #[must_use]
    pub fn of_place(&self, link: LinkId, at: Vector<'m>) -> Framed<'m> {
        let twist = &self.twists[link.index()];
        let direction = self.placement.direction(link);
        let turning = (at - twist.at).perp().scaled(twist.rate);
        let turning = Framed { components: turning, axes: direction };
        turning.plus(&twist.velocity, self.placement.direction(GROUND))
    }

    /// The velocity of a joint's place on one of its links as the other link has it there: with what a drive along a slot adds.
    #[must_use]
    pub fn across(&self, joint: JointId, from: LinkId) -> Framed<'m> {
        let place = self.of_place(from, self.placement.slide_point(joint, from));
        match self.model().joint(joint).kind {
            JointKind::Slot { .. } => place.plus(&self.driven_sliding(joint, from), self.placement.direction(GROUND)),
            _ => place,
        }
    }

    /// The rate of rotation of the other link of a slide: that of this one, and what a drive in a slot adds.
    #[must_use]
    pub fn rate_across(&self, slide: JointId, from: LinkId) -> Expr<'m> {
        self.rate(from) + self.driven_rate(slide, from)
    }

    /// The rate at which a drive turns the other link of a joint against this one.
    #[must_use]
    pub fn driven_rate(&self, joint: JointId, from: LinkId) -> Expr<'m> {
        let rate = self.model().effort_of(joint, true).map_or(self.graph().zero(), |effort| self.rate_of(effort));
        if self.model().joint(joint).from.link == from { rate } else { -rate }
    }

    /// The velocity at which a drive slides the other link of a joint along this one.
    #[must_use]
    pub fn driven_sliding(&self, joint: JointId, from: LinkId) -> Framed<'m> {
        let graph = self.graph();
        let rate = self.model().effort_of(joint, false).map_or(graph.zero(), |effort| self.rate_of(effort));
        let rate = if self.model().joint(joint).from.link == from { rate } else { -rate };
        Framed { components: Vector::new(rate, graph.zero()), axes: self.placement.slide_direction(joint) }
    }

    /// The difference of two velocities.
    #[must_use]
    pub fn difference(&self, of: &Framed<'m>, from: &Framed<'m>) -> Framed<'m> {
        of.plus(&from.opposite(), self.placement.direction(GROUND))
    }

    /// A velocity's part along a direction.
    #[must_use]
    pub fn part(&self, velocity: &Framed<'m>, along: Vector<'m>) -> Expr<'m> {
        let Framed { components, axes } = *velocity;
        if axes == along {
            return components.x;
        }
        // a x·d + b x⊥·d, and x⊥·d = x × d.
        let mut sum = self.graph().zero();
        if !components.x.is_zero() {
            sum = sum + components.x * self.pivots.cosine(axes, along);
        }
        if !components.y.is_zero() {
            sum = sum + components.y * self.pivots.sine(axes, along);
        }
        sum
    }

    /// The power of all that acts on a link: `ΣF · v + ΣM ω`, with the moments about the place whose velocity is v.
    #[must_use]
    pub fn power_of(&self, loads: &Balance<'m, '_>, link: LinkId) -> Expr<'m> {
        let Twist { rate, at, velocity } = self.twists[link.index()];
        let force = loads.total(link).along(velocity.axes);
        velocity.components.dot(force) + rate * loads.moment(link, at, self.graph().one())
    }

    /// The power of an action: `F · v` or `M ω`.
    #[must_use]
    pub fn power(&self, action: &Action) -> Expr<'m> {
        let graph = self.graph();
        match *action {
            Action::Force { link, at, force, frame } => {
                let velocity = self.of_place(link, self.placement.carried(link, at.vector(graph)));
                let components = self.placement.carried(frame, force.vector(graph));
                let axes = self.placement.direction(frame);
                velocity.along(axes).dot(components)
            }
            Action::Couple { link, moment } => graph.expr(moment) * self.rate(link),
        }
    }

    /// The name of a quantity of this motion.
    #[must_use]
    pub fn name(&self, name: &str) -> String {
        format!("{}{name}", self.prefix)
    }
}
