//! Prismatic joint: a slide. The second point lies on the line through the first, the links do not turn against each other.

use super::{Component, Constraint, Ends};
use crate::graph::{Expr, Vector};

pub(super) fn constraints<'g>(
    ends: &Ends<'g>,
    carried_by_first: bool,
    axis: Vector<'g>,
    angle: Expr<'g>,
) -> Vec<Constraint<'g>> {
    let normal = direction(ends, carried_by_first, axis).perp();
    vec![
        Constraint { component: Component::Normal, residual: normal.dot(ends.gap()) },
        Constraint { component: Component::Couple, residual: ends.second.angle - ends.first.angle - angle },
    ]
}

/// The travel of the second point along the line.
pub(super) fn coordinate<'g>(ends: &Ends<'g>, carried_by_first: bool, axis: Vector<'g>) -> Expr<'g> {
    direction(ends, carried_by_first, axis).dot(ends.gap())
}

pub(super) fn direction<'g>(ends: &Ends<'g>, carried_by_first: bool, axis: Vector<'g>) -> Vector<'g> {
    if carried_by_first { ends.first.turned(axis) } else { ends.second.turned(axis) }
}
