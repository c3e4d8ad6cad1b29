//! Loads: each kind in a file of its own that states which forces and couples it puts on which links, and nothing else.

mod force;
mod gravity;
mod inertia;
mod line;
mod moment;
mod posture;
mod spring;
mod thrust;
mod torsion;

pub use line::Line;
pub use posture::{Posture, Span, Symbolic};

pub(crate) use inertia::by_dalembert;

use super::{Body, Exerted};
use crate::graph::{NodeId, Order, Vector};
use crate::model::ids::{LinkId, LoadId};
use crate::model::{LoadKind, Pair};

/// A load that is solved by itself: the whole load, or of gravity and inertia the part of one link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Case {
    /// The declared load.
    pub load: LoadId,
    /// The link whose weight or inertia it is.
    pub link: Option<LinkId>,
}

/// An elementary action on a link.
#[derive(Clone, Copy, Debug)]
pub enum Action {
    /// A force at a point.
    Force {
        /// On this link.
        link: LinkId,
        /// At this place in its frame.
        at: Pair,
        /// The force's components,
        force: Pair,
        /// in the axes of this link.
        frame: LinkId,
    },
    /// A couple.
    Couple {
        /// On this link.
        link: LinkId,
        /// How much.
        moment: NodeId,
    },
}

/// All load cases, in the order of declaration.
#[must_use]
pub fn cases(posture: &dyn Posture<'_>) -> Vec<(Case, Vec<Action>)> {
    (0..posture.model().loads.len()).map(LoadId::new).flat_map(|load| cases_of(posture, load)).collect()
}

/// The cases of a load.
#[must_use]
pub fn cases_of(posture: &dyn Posture<'_>, load: LoadId) -> Vec<(Case, Vec<Action>)> {
    let model = posture.model();
    let graph = &model.graph;
    let whole = Case { load, link: None };
    let name = &model.load(load).name.text;
    match model.load(load).kind {
        LoadKind::Force { at, force, frame } => vec![(whole, force::actions(model, at, force, frame))],
        LoadKind::Moment { on, from, moment } => vec![(whole, moment::actions(on, from, graph.expr(moment)))],
        LoadKind::Thrust { ends, force } => {
            let line = Line::between(posture, name, ends);
            vec![(whole, thrust::actions(&line, graph.expr(force)))]
        }
        LoadKind::Spring { ends, rate, free, preload, damping } => {
            let line = Line::between(posture, name, ends);
            let [rate, free, preload] = [rate, free, preload].map(|value| graph.expr(value));
            let damped = damping.map(|damping| graph.expr(damping) * line.stretching(posture));
            vec![(whole, spring::actions(&line, rate, free, preload, damped))]
        }
        LoadKind::Torsion { from, on, rate, free, near, damping } => {
            let meaning = format!("angle of {} from {} − free angle", model.link(on).name, model.link(from).name);
            let wound = posture::wound(posture, [from, on], graph.expr(free), near.map(|near| graph.expr(near)));
            let wound = wound.named(format!("{name}_wound"), meaning);
            let damped = damping.map(|damping| {
                let turning = posture.turning(on, Order::Rate) - posture.turning(from, Order::Rate);
                graph.expr(damping) * turning
            });
            vec![(whole, torsion::actions(from, on, graph.expr(rate) * wound, damped))]
        }
        LoadKind::Gravity { acceleration } => gravity::weights(model, acceleration)
            .into_iter()
            .map(|(link, action)| (Case { load, link: Some(link) }, vec![action]))
            .collect(),
        LoadKind::Inertia => {
            let massive = model.load(load).links.iter().filter_map(|link| Some((*link, model.link(*link).mass?)));
            let of = |(link, mass)| (Case { load, link: Some(link) }, inertia::actions(posture, link, mass));
            massive.map(of).collect()
        }
    }
}

/// The inertia of a link by D'Alembert; nothing if it has no mass.
#[must_use]
pub fn inertia_of(posture: &dyn Posture<'_>, link: LinkId) -> Vec<Action> {
    posture.model().link(link).mass.map_or_else(Vec::new, |mass| inertia::actions(posture, link, mass))
}

/// What a force at a point of a link exerts about the origin of its frame: with `r` from there to the point, `r × F`.
pub(super) fn exerted_at<'g>(link: LinkId, body: &Body<'g>, local: Vector<'g>, force: Vector<'g>) -> Exerted {
    let arm = body.turned(local);
    Exerted { on: link, x: force.x.id(), y: force.y.id(), moment: arm.cross(force).id() }
}
