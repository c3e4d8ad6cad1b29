//! Where points and links are, as loads see them.

use crate::equations::Body;
use crate::graph::{Coordinate, Expr, Order, Symbol, Vector};
use crate::model::ids::{GROUND, LinkId};
use crate::model::{End, Model};
use crate::topology::Topology;

/// The way from a point to another.
#[derive(Clone, Copy, Debug)]
pub struct Span<'m> {
    /// Ground axes.
    pub vector: Vector<'m>,
    /// The lengths that its rounding grows with; in symbols there is none.
    pub length: Option<Expr<'m>>,
    /// Whether its lengths keep the points apart, whatever the pose.
    pub apart: bool,
}

/// Where points and links are, as loads see them: in the symbols of the equations, or as a plan has placed them.
pub trait Posture<'m> {
    /// The linkage.
    fn model(&self) -> &'m Model;

    /// From a point to another.
    fn span(&self, ends: [End; 2]) -> Span<'m>;

    /// The direction of the x axis of a link's frame.
    fn frame(&self, link: LinkId) -> Vector<'m>;

    /// The angle of the x axis of a link's frame.
    fn angle(&self, link: LinkId) -> Expr<'m>;

    /// Whether gears tell the angle of a link, with all its turns.
    fn is_geared(&self, link: LinkId) -> bool;

    /// The velocity of the second point as seen from the first, ground axes.
    fn velocity(&self, ends: [End; 2]) -> Vector<'m>;

    /// The rate of a link's angle, or its acceleration.
    fn turning(&self, link: LinkId, order: Order) -> Expr<'m>;

    /// The acceleration of a place in a link's frame, in the axes of the frame of one of the links.
    fn acceleration(&self, link: LinkId, at: Vector<'m>) -> (Vector<'m>, LinkId);
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

    fn span(&self, ends: [End; 2]) -> Span<'m> {
        let body = |link| Body::symbolic(&self.model.graph, link);
        let [first, second] = ends.map(|end| body(end.link).point(self.model.local(end)));
        Span { vector: second - first, length: None, apart: false }
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

    fn velocity(&self, ends: [End; 2]) -> Vector<'m> {
        let [first, second] = ends.map(|end| {
            let arm = Body::symbolic(&self.model.graph, end.link).turned(self.model.local(end));
            self.of_origin(end.link, Order::Rate) + arm.perp().scaled(self.turning(end.link, Order::Rate))
        });
        second - first
    }

    fn turning(&self, link: LinkId, order: Order) -> Expr<'m> {
        self.moving(link, Coordinate::Angle, order)
    }

    fn acceleration(&self, link: LinkId, at: Vector<'m>) -> (Vector<'m>, LinkId) {
        let arm = Body::symbolic(&self.model.graph, link).turned(at);
        let [rate, acceleration] = [Order::Rate, Order::Acceleration].map(|order| self.turning(link, order));
        let turning = arm.perp().scaled(acceleration) - arm.scaled(rate.squared());
        (self.of_origin(link, Order::Acceleration) + turning, GROUND)
    }
}

impl<'m> Symbolic<'m> {
    fn moving(self, link: LinkId, which: Coordinate, order: Order) -> Expr<'m> {
        let graph = &self.model.graph;
        if link == GROUND { graph.zero() } else { graph.symbol(Symbol::Moving(link, which, order)) }
    }

    fn of_origin(self, link: LinkId, order: Order) -> Vector<'m> {
        Vector::new(self.moving(link, Coordinate::X, order), self.moving(link, Coordinate::Y, order))
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
