//! The reactions of a joint, a component at a time: what a unit of each exerts on its two links, in the axes in which it is simplest.

use super::framed::Framed;
use super::placement::Placement;
use crate::equations::joints::Component;
use crate::graph::{Expr, Vector};
use crate::model::JointKind;
use crate::model::ids::{GROUND, JointId};

/// What the unit of a component exerts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'m> {
    /// Which component.
    pub component: Component,
    /// The force on the second link, at the joint's place on it; the first one gets the opposite, at the joint's place on itself.
    pub force: Framed<'m>,
    /// The couples on the first and on the second link.
    pub couples: [Expr<'m>; 2],
}

/// The components of a joint's reaction, in the order of its constraints.
#[must_use]
pub(super) fn parts<'m>(placement: &Placement<'m>, joint: JointId) -> Vec<Part<'m>> {
    let graph = placement.graph();
    let (zero, one) = (graph.zero(), graph.one());
    let force = |component, x, y, axes| Part {
        component,
        force: Framed { components: Vector::new(x, y), axes },
        couples: [zero, zero],
    };
    let ground = placement.direction(GROUND);
    let x = force(Component::X, one, zero, ground);
    let y = force(Component::Y, zero, one, ground);
    let couple = Part { couples: [-one, one], ..force(Component::Couple, zero, zero, ground) };
    let normal = || force(Component::Normal, zero, one, placement.slide_direction(joint));
    match placement.model.joint(joint).kind {
        JointKind::Revolute => vec![x, y],
        JointKind::Weld { .. } => vec![x, y, couple],
        JointKind::Prismatic { .. } => vec![normal(), couple],
        JointKind::Slot { .. } => vec![normal()],
        JointKind::Gear(gear) => {
            // At the pitch point; about the centres the part along their line has no moment.
            let [first, second] = gear.rolling_radii(placement.model);
            let tooth = force(Component::Tangential, graph.expr(gear.incline), one, placement.centre_line(&gear));
            vec![Part { couples: [-first, -second], ..tooth }]
        }
    }
}
