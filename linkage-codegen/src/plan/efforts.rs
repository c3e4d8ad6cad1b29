//! What a unit of an unknown effort exerts on the links: the one place where rules learn how an unknown acts.

use super::balance::Balance;
use super::framed::Framed;
use super::placement::Placement;
use super::posed::Posed;
use super::velocities::Motion;
use crate::equations::loads::Line;
use crate::graph::{Expr, Vector};
use crate::model::ids::{GROUND, LinkId};
use crate::model::{End, Model, UnknownKind};
use crate::topology::Input;

/// A force or a couple on a link.
#[derive(Clone, Copy, Debug)]
pub enum Act<'m> {
    /// A force at a place along and across the link's direction.
    Force(LinkId, Vector<'m>, Framed<'m>),
    /// A couple.
    Couple(LinkId, Expr<'m>),
}

impl<'m> Act<'m> {
    /// The link on which it acts.
    #[must_use]
    pub fn link(&self) -> LinkId {
        match self {
            Self::Force(link, ..) | Self::Couple(link, _) => *link,
        }
    }

    /// Its power in a motion.
    #[must_use]
    pub fn power(&self, motion: &Motion<'m, '_>) -> Expr<'m> {
        match *self {
            Self::Force(link, at, force) => motion.of_place(link, at).along(force.axes).dot(force.components),
            Self::Couple(link, moment) => moment * motion.rate(link),
        }
    }

    /// Its moment about a place of its link.
    #[must_use]
    pub fn moment(&self, placement: &Placement<'m>, about: Vector<'m>) -> Expr<'m> {
        match *self {
            Self::Force(link, at, force) => (at - about).cross(force.along(placement.direction(link))),
            Self::Couple(_, moment) => moment,
        }
    }
}

/// What a unit of an effort exerts.
#[derive(Clone, Debug)]
pub struct Unit<'m> {
    /// On each link.
    pub acts: Vec<Act<'m>>,
    /// How much larger than that of a declared direction the rounding of its direction may be.
    pub spread: Expr<'m>,
}

impl<'m> Unit<'m> {
    /// Of an unknown, or of what a drive needs.
    #[must_use]
    pub fn of(placement: &Placement<'m>, input: impl Into<Input>) -> Self {
        let input = input.into();
        let (model, graph) = (placement.model, placement.graph());
        let one = graph.one();
        let pair = |[first, second]: [(LinkId, Vector<'m>); 2], force: Framed<'m>| {
            vec![Act::Force(second.0, second.1, force), Act::Force(first.0, first.1, force.opposite())]
        };
        if let Some((from, to)) = torque_links(model, input) {
            return Self { acts: vec![Act::Couple(to, one), Act::Couple(from, -one)], spread: one };
        }
        match input.effort(model) {
            UnknownKind::Force { at, along, frame } => {
                let components = placement.carried(frame, along.vector(graph));
                let force = Framed { components, axes: placement.direction(frame) };
                Self { acts: vec![Act::Force(at.link, placement.point(at), force)], spread: one }
            }
            UnknownKind::Thrust(ends) => {
                let line = Line::between(&Posed::at_rest(placement), input.name(model), ends);
                let direction = line.direction();
                let components = Vector::new(line.checked(direction.x), line.checked(direction.y));
                let force = Framed { components, axes: placement.direction(GROUND) };
                Self { acts: pair(ends.map(|end| (end.link, placement.point(end))), force), spread: line.spread() }
            }
            UnknownKind::Drive(drive) => {
                let joint = model.drive(drive).joint;
                let axes = placement.slide_direction(joint);
                let force = Framed { components: Vector::new(one, graph.zero()), axes };
                let places = model.joint(joint).ends().map(|end| (end.link, placement.slide_point(joint, end.link)));
                Self { acts: pair(places, force), spread: one }
            }
            UnknownKind::Torque(..) => Self { acts: Vec::new(), spread: one },
        }
    }

    /// What it exerts on a link.
    pub fn on(&self, link: LinkId) -> impl Iterator<Item = &Act<'m>> {
        self.acts.iter().filter(move |act| act.link() == link)
    }

    /// Its forces on a link, added up.
    #[must_use]
    pub fn force_on(&self, link: LinkId, ground: Vector<'m>) -> Framed<'m> {
        let nothing = Framed { components: self.spread.graph().zero_vector(), axes: ground };
        self.on(link).fold(nothing, |sum, act| match act {
            Act::Force(_, _, force) => sum.plus(force, ground),
            Act::Couple(..) => sum,
        })
    }

    /// Its moments on a link about one of its places, added up.
    #[must_use]
    pub fn moment_on(&self, link: LinkId, placement: &Placement<'m>, about: Vector<'m>) -> Expr<'m> {
        self.on(link).fold(placement.graph().zero(), |sum, act| sum + act.moment(placement, about))
    }

    /// Its power on a link.
    #[must_use]
    pub fn power_on(&self, motion: &Motion<'m, '_>, link: LinkId) -> Expr<'m> {
        self.on(link).fold(motion.graph().zero(), |sum, act| sum + act.power(motion))
    }

    /// Its power on all links but these.
    #[must_use]
    pub fn power_outside(&self, motion: &Motion<'m, '_>, links: &[LinkId]) -> Expr<'m> {
        let outside = self.acts.iter().filter(|act| !links.contains(&act.link()));
        outside.fold(motion.graph().zero(), |sum, act| sum + act.power(motion))
    }

    /// Exerts it, so many times, on all links but these.
    pub fn exert_outside(&self, balance: &mut Balance<'m, '_>, value: Expr<'m>, links: &[LinkId]) {
        for act in self.acts.iter().filter(|act| !links.contains(&act.link())) {
            match *act {
                Act::Force(link, at, force) => {
                    balance.push(link, at, Framed { components: force.components.scaled(value), axes: force.axes });
                }
                Act::Couple(link, moment) => balance.couple(link, moment * value),
            }
        }
    }
}

/// The point of a link at which an unknown force acts.
#[must_use]
pub(super) fn point_on(model: &Model, input: Input, link: LinkId) -> Option<End> {
    match input.effort(model) {
        UnknownKind::Force { at, .. } => Some(at).filter(|end| end.link == link),
        UnknownKind::Thrust(ends) => ends.into_iter().find(|end| end.link == link),
        UnknownKind::Drive(_) | UnknownKind::Torque(..) => None,
    }
}

/// The links between which an unknown torque acts.
fn torque_links(model: &Model, input: Input) -> Option<(LinkId, LinkId)> {
    match input.effort(model) {
        UnknownKind::Torque(from, to) => Some((from, to)),
        UnknownKind::Drive(drive) => {
            let joint = model.joint(model.drive(drive).joint);
            model.drive(drive).turns.then_some((joint.from.link, joint.to.link))
        }
        UnknownKind::Force { .. } | UnknownKind::Thrust(_) => None,
    }
}
