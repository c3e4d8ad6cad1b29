//! A force at a point, in ground axes or in axes that turn with a link.

use super::Action;
use crate::model::ids::LinkId;
use crate::model::{End, Model, Pair};

pub(super) fn actions(model: &Model, at: End, force: Pair, frame: LinkId) -> Vec<Action> {
    vec![Action::Force { link: at.link, at: model.local(at).into(), force, frame }]
}
