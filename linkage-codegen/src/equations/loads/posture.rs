//! Where points and links are, as loads see them.

use crate::equations::Body;
use crate::graph::{Expr, Vector};
use crate::model::ids::{GROUND, LinkId};
use crate::model::{End, Model};
use crate::topology::Topology;

/// Where points and links are, as loads see them: in the symbols of the equations, or as a plan has placed them.
pub trait Posture<'m> {
    /// The linkage.
    fn model(&self) -> &'m Model;

    /// From a point to another, ground axes, and the lengths that its rounding grows with; in symbols there is none.
    fn span(&self, ends: [End; 2]) -> (Vector<'m>, Option<Expr<'m>>);

    /// The direction of the x axis of a link's frame.
    fn frame(&self, link: LinkId) -> Vector<'m>;

    /// The angle of the x axis of a link's frame.
    fn angle(&self, link: LinkId) -> Expr<'m>;

    /// Whether gears tell the angle of a link, with all its turns.
    fn is_geared(&self, link: LinkId) -> bool;
}

/// In the symbols of the unreduced equations.
#[derive(Clone, Copy, Debug)]
pub struct Symbolic<'m> {
    /// The linkage.
    pub model: &'m Model,
    /// Its groups of motion: they tell which links gears turn.
    pub topology: &'m Topology,
}

impl<'m> Posture<'m> for Symbolic<'m> {
    fn model(&self) -> &'m Model {
        self.model
    }

    fn span(&self, ends: [End; 2]) -> (Vector<'m>, Option<Expr<'m>>) {
        let body = |link| Body::symbolic(&self.model.graph, link);
        let [first, second] = ends.map(|end| body(end.link).point(self.model.local(end)));
        (second - first, None)
    }

    fn frame(&self, link: LinkId) -> Vector<'m> {
        Body::symbolic(&self.model.graph, link).direction
    }

    fn angle(&self, link: LinkId) -> Expr<'m> {
        Body::symbolic(&self.model.graph, link).angle
    }

    fn is_geared(&self, link: LinkId) -> bool {
        self.topology.geared(self.model).contains(&link)
    }
}

/// The angle of the second link from the first, less a free angle.
///
/// Where it follows from drives alone, it is what these give, of any number of turns; of a wheel that other links turn, what the gears give
/// and the other link's own angle. Elsewhere only directions are known, and a turn is chosen: that of the angle nearest to the free one, or,
/// of what drives do not turn, nearest to `near`.
pub(super) fn wound<'m>(
    posture: &dyn Posture<'m>,
    [from, on]: [LinkId; 2],
    free: Expr<'m>,
    near: Option<Expr<'m>>,
) -> Expr<'m> {
    let (model, graph) = (posture.model(), free.graph());
    if let Some([driven, rest]) = model.driven_angle(from, on) {
        return driven + rest - free;
    }
    let Some(near) = near else {
        if posture.is_geared(from) || posture.is_geared(on) {
            return posture.angle(on) - posture.angle(from) - free;
        }
        let turned = posture.frame(on).resolved_along(posture.frame(from)).resolved_along(free.direction());
        return graph.atan2(turned.y, turned.x);
    };
    // Without what the drives turn it by, if they alone give its angle.
    let still = |link: LinkId| match model.driven_angle(GROUND, link) {
        Some([driven, rest]) => (driven, rest.direction()),
        None => (graph.zero(), posture.frame(link)),
    };
    let ((from_driven, from), (on_driven, on)) = (still(from), still(on));
    let turned = on.resolved_along(from).resolved_along(near.direction());
    on_driven - from_driven + graph.atan2(turned.y, turned.x) + (near - free)
}
