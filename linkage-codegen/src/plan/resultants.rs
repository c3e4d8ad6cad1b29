//! Resultants of forces about a point, and powers: what shakes the ground, what acts on it, what the drives put in.

use super::efforts::{Act, Unit};
use super::framed::Framed;
use super::placement::Placement;
use super::{Balance, Motion};
use crate::equations::loads::Action;
use crate::graph::{Expr, Vector};
use crate::model::ids::{GROUND, LinkId, PointId, UnknownId};
use crate::model::{End, JointKind, LoadKind, UnknownKind};
use crate::plan::Output;
use crate::topology::Input;

/// A force in ground axes, and the moment about a point.
#[derive(Clone, Copy)]
pub(super) struct Resultant<'m, 'p> {
    placement: &'p Placement<'m>,
    about: End,
    force: Vector<'m>,
    moment: Expr<'m>,
}

impl<'m, 'p> Resultant<'m, 'p> {
    /// Nothing yet.
    #[must_use]
    pub(super) fn about(placement: &'p Placement<'m>, about: End) -> Self {
        let graph = placement.graph();
        Self { placement, about, force: graph.zero_vector(), moment: graph.zero() }
    }

    /// From the point to a place along and across a link's direction, ground axes.
    fn arm(&self, link: LinkId, at: Vector<'m>) -> Vector<'m> {
        let (way, beyond) = self.way_and_beyond(link, at);
        way + beyond.turned_by(self.placement.direction(link))
    }

    /// The same as the way to the link, in ground axes, and what is beyond on the link, along and across its direction.
    fn way_and_beyond(&self, link: LinkId, at: Vector<'m>) -> (Vector<'m>, Vector<'m>) {
        if link == self.about.link {
            return (self.placement.graph().zero_vector(), at - self.placement.point(self.about));
        }
        let near = End { link, point: PointId::FIRST };
        if self.placement.model.link(link).points.is_empty() {
            return (-self.placement.place(self.about), at);
        }
        (self.placement.way(self.about, near).vector(), at - self.placement.point(near))
    }

    /// With a force at the end of an arm: `M + arm × F`.
    fn force(&mut self, arm: Vector<'m>, force: Vector<'m>) {
        self.force = self.force + force;
        self.moment = self.moment + arm.cross(force);
    }

    /// With a couple.
    fn couple(&mut self, couple: Expr<'m>) {
        self.moment = self.moment + couple;
    }

    /// With force and couple of a link's inertia at its centre of mass; the force in ground axes too, as it is named. In the link's own axes
    /// what has no moment about a place on the link is seen to have none.
    pub(super) fn inertia(
        &mut self,
        (link, centroid): (LinkId, Vector<'m>),
        force: Framed<'m>,
        named: Vector<'m>,
        couple: Expr<'m>,
    ) {
        let at = self.placement.carried(link, centroid);
        if force.axes == self.placement.direction(link) {
            let (way, beyond) = self.way_and_beyond(link, at);
            self.force(way, named);
            self.couple(beyond.cross(force.components));
        } else {
            self.force(self.arm(link, at), named);
        }
        self.couple(couple);
    }

    /// With what all joints of the ground exert on it.
    pub(super) fn joints(&mut self, balance: &Balance<'m, '_>) {
        let model = self.placement.model;
        for joint in model.joint_ids() {
            let data = model.joint(joint);
            let sign = match (data.to.link, data.from.link) {
                (GROUND, _) => 1,
                (_, GROUND) => -1,
                _ => continue,
            };
            let reaction = balance.reaction(joint);
            let mut arm = self.placement.way(self.about, data.place()).vector();
            if let JointKind::Gear(gear) = data.kind {
                let [_, radius] = gear.rolling_radii(model);
                arm = arm - self.placement.centre_line(&gear).scaled(radius);
            }
            let force = reaction.force.ground();
            self.force(arm, if sign > 0 { force } else { -force });
            if let Some(couple) = reaction.couple {
                self.couple(sign * couple);
            }
        }
    }

    /// With the efforts that the ground reacts.
    pub(super) fn efforts(&mut self, balance: &Balance<'m, '_>) {
        for unknown in (0..self.placement.model.unknowns.len()).map(UnknownId::new) {
            let value = balance.effort(unknown);
            for act in Unit::of(self.placement, unknown).on(GROUND) {
                match *act {
                    Act::Force(link, at, force) => self.force(self.arm(link, at), force.ground().scaled(value)),
                    Act::Couple(_, couple) => self.couple(couple * value),
                }
            }
        }
    }

    /// With what the ground gets of loads that act between it and a link: the opposite of what the link gets, in the same line.
    pub(super) fn opposite_of(&mut self, actions: &[Action]) {
        let graph = self.placement.graph();
        for action in actions {
            match *action {
                Action::Force { link, at, force, frame } => {
                    let arm = self.arm(link, self.placement.carried(link, at.vector(graph)));
                    let force = self.placement.carried(frame, force.vector(graph));
                    self.force(arm, -force.turned_by(self.placement.direction(frame)));
                }
                Action::Couple { moment, .. } => self.couple(-graph.expr(moment)),
            }
        }
    }

    /// As a result, with a name among values.
    #[must_use]
    pub(super) fn output(&self, name: &str) -> Output {
        let force = self.force.named(name, &format!("{name}, ground axes"));
        let moment = self.moment.named(format!("{name}_moment"), "Σ r × F + Σ C");
        Output::Reaction { ty: "Wrench", force: [force.x.id(), force.y.id()], parts: vec![("moment", moment.id())] }
    }
}

/// Whether a load acts between the ground and a link.
#[must_use]
pub(super) fn reacted_by_ground(kind: LoadKind) -> bool {
    match kind {
        LoadKind::Moment { on, from: Some(from), .. } | LoadKind::Torsion { on, from, .. } => {
            on == GROUND || from == GROUND
        }
        LoadKind::Thrust { ends, .. } | LoadKind::Spring { ends, .. } => ends.iter().any(|end| end.link == GROUND),
        LoadKind::Moment { from: None, .. } | LoadKind::Force { .. } | LoadKind::Gravity { .. } | LoadKind::Inertia => {
            false
        }
    }
}

/// The rate of the coordinate on which an unknown works.
#[must_use]
pub(super) fn rate_of<'m>(velocities: &Motion<'m, '_>, unknown: UnknownId) -> Expr<'m> {
    let model = velocities.model();
    if let UnknownKind::Drive(drive) = model.unknown(unknown).kind {
        return velocities.rate_of(Input::Drive(drive));
    }
    let unit = Unit::of(velocities.placement, unknown);
    unit.acts.iter().fold(velocities.graph().zero(), |sum, act| sum + act.power(velocities))
}
