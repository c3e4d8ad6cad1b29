//! A link in the plane: the place and the direction of its frame.

use crate::graph::{Coordinate, Expr, Graph, Symbol, Vector};
use crate::model::ids::{GROUND, LinkId};

/// Place and direction of a link's frame, as expressions.
#[derive(Clone, Copy, Debug)]
pub struct Body<'g> {
    /// The frame's origin.
    pub origin: Vector<'g>,
    /// The direction of its x axis.
    pub direction: Vector<'g>,
    /// The angle of that direction.
    pub angle: Expr<'g>,
}

impl<'g> Body<'g> {
    /// In the symbols of the link's coordinates; the ground stands at the origin.
    #[must_use]
    pub fn symbolic(graph: &'g Graph, link: LinkId) -> Self {
        if link == GROUND {
            return Self {
                origin: graph.zero_vector(),
                direction: Vector::new(graph.one(), graph.zero()),
                angle: graph.zero(),
            };
        }
        let of = |coordinate| graph.symbol(Symbol::Coordinate(link, coordinate));
        Self {
            origin: Vector::new(of(Coordinate::X), of(Coordinate::Y)),
            direction: Vector::new(of(Coordinate::Cos), of(Coordinate::Sin)),
            angle: of(Coordinate::Angle),
        }
    }

    /// A vector of the link's frame, in ground axes.
    #[must_use]
    pub fn turned(&self, local: Vector<'g>) -> Vector<'g> {
        local.turned_by(self.direction)
    }

    /// A point of the link.
    #[must_use]
    pub fn point(&self, local: Vector<'g>) -> Vector<'g> {
        self.origin + self.turned(local)
    }
}
