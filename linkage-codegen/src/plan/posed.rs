//! What loads see of a plan: where everything is, and how it moves.

use super::placement::Placement;
use super::velocities::Motion;
use crate::equations::loads::{Posture, Span};
use crate::graph::{Expr, Order, Vector};
use crate::model::ids::{GROUND, LinkId};
use crate::model::{End, Model};

/// The links as a plan has placed them, with their motion as far as the loads of the linkage depend on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Posed<'m, 'p> {
    /// Where they are.
    pub placement: &'p Placement<'m>,
    /// Their velocities.
    pub velocities: Option<&'p Motion<'m, 'p>>,
    /// Their accelerations.
    pub accelerations: Option<&'p Motion<'m, 'p>>,
}

impl<'m, 'p> Posed<'m, 'p> {
    /// At rest.
    #[must_use]
    pub(super) fn at_rest(placement: &'p Placement<'m>) -> Self {
        Self { placement, velocities: None, accelerations: None }
    }
}

impl<'m> Posture<'m> for Posed<'m, '_> {
    fn model(&self) -> &'m Model {
        self.placement.model
    }

    fn span(&self, [from, to]: [End; 2]) -> Span<'m> {
        let way = self.placement.way(from, to);
        let length = way.length();
        Span { vector: way.vector(), length: Some(length), apart: way.exceeds(length.graph().zero(), 2 * length) }
    }

    fn frame(&self, link: LinkId) -> Vector<'m> {
        self.placement.frame(link)
    }

    fn angle(&self, link: LinkId) -> Expr<'m> {
        self.placement.angle(link)
    }

    fn is_geared(&self, link: LinkId) -> bool {
        let model = self.placement.model;
        self.placement.unwrapped_angle(link).is_some() && model.driven_angle(GROUND, link).is_none()
    }

    fn velocity(&self, ends: [End; 2]) -> Vector<'m> {
        let Some(motion) = self.velocities else { return self.placement.graph().zero_vector() };
        let [first, second] = ends.map(|end| motion.of_point(end));
        motion.difference(&second, &first).ground()
    }

    fn turning(&self, link: LinkId, order: Order) -> Expr<'m> {
        let motion = match order {
            Order::Rate => self.velocities,
            Order::Acceleration => self.accelerations,
        };
        motion.map_or_else(|| self.placement.graph().zero(), |motion| motion.rate(link))
    }

    fn acceleration(&self, link: LinkId, at: Vector<'m>) -> (Vector<'m>, LinkId) {
        let Some(motion) = self.accelerations else { return (self.placement.graph().zero_vector(), GROUND) };
        let found = motion.of_place(link, self.placement.carried(link, at));
        // In the axes in which it arises, if these are those of the link's frame.
        if found.axes == self.placement.direction(link) && found.axes == self.placement.frame(link) {
            return (found.components, link);
        }
        (found.ground(), GROUND)
    }
}
