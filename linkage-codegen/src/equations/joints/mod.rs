//! Joints: each kind in a file of its own that states its constraints and its coordinate, and nothing else.

mod gear;
mod prismatic;
mod revolute;
mod slot;
mod weld;

pub use gear::Teeth;

use super::Body;
use crate::graph::{Expr, Vector};

/// What a joint joins.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'g> {
    /// The link that acts.
    pub first: Body<'g>,
    /// The link that feels.
    pub second: Body<'g>,
    /// The joint's point in the first link's frame.
    pub first_point: Vector<'g>,
    /// The joint's point in the second link's frame.
    pub second_point: Vector<'g>,
}

impl<'g> Ends<'g> {
    /// From the first point to the second.
    #[must_use]
    pub fn gap(&self) -> Vector<'g> {
        self.second.point(self.second_point) - self.first.point(self.first_point)
    }
}

/// What a joint constrains, with its dimensions.
#[derive(Clone, Copy, Debug)]
pub enum Shape<'g> {
    /// Two points coincide.
    Revolute,
    /// The second point lies on a line through the first; the angle between the links is fixed.
    Prismatic {
        /// Whether the line turns with the first link, not with the second.
        carried_by_first: bool,
        /// The line's direction in that link's frame.
        axis: Vector<'g>,
        /// Angle of the second link minus angle of the first.
        angle: Expr<'g>,
    },
    /// Two points coincide; the angle between the links is fixed.
    Weld {
        /// Angle of the second link minus angle of the first.
        angle: Expr<'g>,
    },
    /// A pin lies on a line of the other link.
    Slot {
        /// Whether the first link has the slot, not the second.
        carried_by_first: bool,
        /// The line's direction in that link's frame.
        axis: Vector<'g>,
    },
    /// Two wheels roll on each other.
    Gear(Teeth<'g>),
}

/// A component of a joint's reaction, on the second link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// Force along x.
    X,
    /// Force along y.
    Y,
    /// Force along the normal of a slide or a slot: its direction turned by +90°.
    Normal,
    /// Force of teeth across the line of centres: along the direction from the first centre to the second, turned by +90°.
    Tangential,
    /// Couple.
    Couple,
}

impl Component {
    /// Its name behind the joint's.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Normal => "normal",
            Self::Tangential => "tangential",
            Self::Couple => "couple",
        }
    }
}

/// A constraint: its residual is zero when it holds, and its gradient by the second link's coordinates is the direction of its reaction.
#[derive(Clone, Copy, Debug)]
pub struct Constraint<'g> {
    /// The reaction that upholds it.
    pub component: Component,
    /// Zero when it holds.
    pub residual: Expr<'g>,
}

/// The constraints of a joint.
#[must_use]
pub fn constraints<'g>(shape: Shape<'g>, ends: &Ends<'g>) -> Vec<Constraint<'g>> {
    match shape {
        Shape::Revolute => revolute::constraints(ends),
        Shape::Prismatic { carried_by_first, axis, angle } => {
            prismatic::constraints(ends, carried_by_first, axis, angle)
        }
        Shape::Weld { angle } => weld::constraints(ends, angle),
        Shape::Slot { carried_by_first, axis } => slot::constraints(ends, carried_by_first, axis),
        Shape::Gear(teeth) => gear::constraints(ends, &teeth),
    }
}

/// The coordinate of a joint that a drive gives: the angle between its links, or the travel along its line.
#[must_use]
pub fn coordinate<'g>(shape: Shape<'g>, turns: bool, ends: &Ends<'g>) -> Expr<'g> {
    match shape {
        Shape::Prismatic { carried_by_first, axis, .. } | Shape::Slot { carried_by_first, axis } if !turns => {
            prismatic::coordinate(ends, carried_by_first, axis)
        }
        _ => revolute::coordinate(ends),
    }
}
