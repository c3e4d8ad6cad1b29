//! A moment on a link, reacted by another one or by nothing.

use super::Action;
use crate::graph::Expr;
use crate::model::ids::{GROUND, LinkId};

pub(super) fn actions(on: LinkId, from: Option<LinkId>, moment: Expr<'_>) -> Vec<Action> {
    let couple = |link, moment: Expr<'_>| Action::Couple { link, moment: moment.id() };
    let second = from.filter(|from| *from != GROUND).map(|from| couple(from, -moment));
    let first = (on != GROUND).then(|| couple(on, moment));
    first.into_iter().chain(second).collect()
}
