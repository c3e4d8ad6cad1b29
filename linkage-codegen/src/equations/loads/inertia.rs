//! Inertia by D'Alembert: with a the acceleration of the centre of mass and α that of the angle, the force `−m a` at the centre of mass
//! and the couple `−I α`.

use super::{Action, Posture};
use crate::graph::{Expr, Order, Vector};
use crate::model::ids::{GROUND, LinkId};
use crate::model::{Mass, Model};

pub(super) fn actions(posture: &dyn Posture<'_>, link: LinkId, mass: Mass) -> Vec<Action> {
    let (model, graph) = (posture.model(), &posture.model().graph);
    let name = &model.link(link).name;
    let (acceleration, frame) = posture.acceleration(link, mass.centroid.vector(graph));
    let axes = if frame == GROUND { String::new() } else { format!(", along and across {}", model.link(frame).name) };
    let (force, couple) = by_dalembert(model, mass, acceleration, posture.turning(link, Order::Acceleration));
    let force = force.named(&format!("inertia_{name}"), &format!("−m a of the centre of mass of {name}{axes}"));
    let couple = couple.named(format!("inertia_couple_{name}"), format!("−I α of {name}"));
    let force = Action::Force { link, at: mass.centroid, force: force.into(), frame };
    let couple = (!couple.is_zero()).then(|| Action::Couple { link, moment: couple.id() });
    core::iter::once(force).chain(couple).collect()
}

/// `−m a` and `−I α`, in the units of the generated functions.
pub(crate) fn by_dalembert<'m>(model: &'m Model, mass: Mass, a: Vector<'m>, alpha: Expr<'m>) -> (Vector<'m>, Expr<'m>) {
    let graph = &model.graph;
    let conversion = graph.constant(&model.units.force_per_mass_acceleration());
    let force = -a.scaled(conversion * graph.expr(mass.mass));
    let couple = -(conversion * graph.expr(mass.inertia) * alpha);
    (force, couple)
}
