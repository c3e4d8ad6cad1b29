//! Gravity: the weight `m g` of every link that has mass, at its centre of mass.

use super::Action;
use crate::model::ids::{GROUND, LinkId};
use crate::model::{Model, Pair};

pub(super) fn weights(model: &Model, acceleration: Pair) -> Vec<(LinkId, Action)> {
    let graph = &model.graph;
    let conversion = graph.constant(&model.units.force_per_mass_acceleration());
    let massive = model.moving_links().filter_map(|link| Some((link, model.link(link).mass?)));
    massive
        .map(|(link, mass)| {
            let weight = acceleration.vector(graph).scaled(conversion * graph.expr(mass.mass));
            let name = &model.link(link).name;
            let weight = weight.named(&format!("weight_{name}"), &format!("weight of {name}"));
            (link, Action::Force { link, at: mass.centroid, force: weight.into(), frame: GROUND })
        })
        .collect()
}
