//! Pin in a slot: the pin lies on a line of the other link, which is free to turn about it.

use super::{Component, Constraint, Ends, prismatic};
use crate::graph::Vector;

pub(super) fn constraints<'g>(ends: &Ends<'g>, carried_by_first: bool, axis: Vector<'g>) -> Vec<Constraint<'g>> {
    let normal = prismatic::direction(ends, carried_by_first, axis).perp();
    vec![Constraint { component: Component::Normal, residual: normal.dot(ends.gap()) }]
}
