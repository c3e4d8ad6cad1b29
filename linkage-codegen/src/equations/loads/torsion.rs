//! A torsion spring between two links: the moment `−k (θ − θ₀) − c θ̇` on the second, with its angle θ from the first.

use super::{Action, moment};
use crate::graph::Expr;
use crate::model::ids::LinkId;

/// The moments of the spring and of the damper, by which it holds the second link back.
pub(super) fn actions<'m>(from: LinkId, on: LinkId, wound: Expr<'m>, damped: Option<Expr<'m>>) -> Vec<Action> {
    moment::actions(on, Some(from), -damped.map_or(wound, |damped| wound + damped))
}
