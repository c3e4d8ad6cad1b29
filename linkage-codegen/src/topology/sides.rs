//! What the closures of a linkage's groups say, in whatever way the linkage is driven.

use super::{Freedom, Group, Topology};
use crate::model::ids::{ClosureId, JointId};
use crate::model::inverses::Side;
use crate::model::{Closure, Model};

impl Topology {
    /// The sides that are chosen at the groups of motion.
    #[must_use]
    pub(crate) fn sides(&self, model: &Model) -> Vec<Side> {
        let ids = (0..model.closures.len()).map(ClosureId::new);
        ids.filter_map(|closure| self.motion.iter().find_map(|group| side(model, group, closure))).collect()
    }

    /// The joints at which groups of motion may close in two ways.
    pub(crate) fn closing(&self, model: &Model) -> Vec<JointId> {
        let of_group = |group: &Group| {
            let slots = group.outer.iter().filter(|joint| group.freedom(model, **joint) == Freedom::TurnAndSlide);
            slots.chain(&group.inner).copied().collect::<Vec<_>>()
        };
        self.motion.iter().flat_map(of_group).collect()
    }
}

/// What a closure says of a group; nothing if it is not the group's.
fn side(model: &Model, group: &Group, closure: ClosureId) -> Option<Side> {
    let Closure { joint, of, .. } = model.closure(closure);
    let (joint, freedom) = (*joint, group.freedom(model, *joint));
    if !of.iter().all(|of| group.outer.contains(of)) {
        return None;
    }
    let slot = group.outer.contains(&joint) && freedom == Freedom::TurnAndSlide;
    if !slot && !group.inner.contains(&joint) {
        return None;
    }
    let [named] = of.as_slice() else { return Some(Side { closure, along: None }) };
    let along = match freedom {
        // Between two pins.
        Freedom::Slide => [joint, *group.outer.iter().find(|outer| *outer != named)?],
        Freedom::TurnAndSlide => [joint, joint],
        // On a slide beside a pin.
        Freedom::Turn => {
            let slides = |outer: &&_| group.freedom(model, **outer) == Freedom::Slide;
            [*group.outer.iter().find(slides)?, joint]
        }
        Freedom::None | Freedom::Roll => return None,
    };
    Some(Side { closure, along: Some(along) })
}
