//! A torsion spring between two links: the moment `−k (θ − θ₀)` on the second, with its angle θ from the first.

use super::{Action, moment};
use crate::graph::Expr;
use crate::model::ids::LinkId;

/// `wound` is the angle by which it is wound up, `θ − θ₀`.
pub(super) fn actions(from: LinkId, on: LinkId, rate: Expr<'_>, wound: Expr<'_>) -> Vec<Action> {
    moment::actions(on, Some(from), -(rate * wound))
}
