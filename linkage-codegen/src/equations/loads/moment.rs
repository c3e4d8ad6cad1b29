//! A moment on a link, reacted by another one or by nothing.

use super::Action;
use crate::graph::NodeId;
use crate::model::Model;
use crate::model::ids::{GROUND, LinkId};

pub(super) fn actions(model: &Model, on: LinkId, from: Option<LinkId>, moment: NodeId) -> Vec<Action> {
    let reaction = (-model.graph.expr(moment)).id();
    let second = from.map(|link| Action::Couple { link, moment: reaction });
    [Some(Action::Couple { link: on, moment }), second]
        .into_iter()
        .flatten()
        .filter(|action| !matches!(action, Action::Couple { link, .. } if *link == GROUND))
        .collect()
}
