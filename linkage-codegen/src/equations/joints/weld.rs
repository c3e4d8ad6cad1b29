//! Weld: the two points coincide, the links do not turn against each other.

use super::{Component, Constraint, Ends};
use crate::graph::Expr;

pub(super) fn constraints<'g>(ends: &Ends<'g>, angle: Expr<'g>) -> Vec<Constraint<'g>> {
    let gap = ends.gap();
    vec![
        Constraint { component: Component::X, residual: gap.x },
        Constraint { component: Component::Y, residual: gap.y },
        Constraint { component: Component::Couple, residual: ends.second.angle - ends.first.angle - angle },
    ]
}
