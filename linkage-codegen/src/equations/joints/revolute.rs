//! Revolute joint: a pin. The two points coincide.

use super::{Component, Constraint, Ends};
use crate::graph::Expr;

pub(super) fn constraints<'g>(ends: &Ends<'g>) -> Vec<Constraint<'g>> {
    let gap = ends.gap();
    vec![
        Constraint { component: Component::X, residual: gap.x },
        Constraint { component: Component::Y, residual: gap.y },
    ]
}

/// The angle of the second link seen from the first.
pub(super) fn coordinate<'g>(ends: &Ends<'g>) -> Expr<'g> {
    ends.second.angle - ends.first.angle
}
