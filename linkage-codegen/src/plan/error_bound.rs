//! Bounds of the rounding errors of a scene's results.

use super::output::Field;
use super::{Kept, Output};
use crate::graph::rounding::Rounding;
use crate::graph::{Graph, NodeId};
use crate::model::{Model, Wanted};

/// Adds their bounds to the results of the scenes that want them. What a pose has to keep for that comes back.
pub(super) fn add(model: &Model, scenes: &mut [Output], kept: &[Kept]) -> Vec<Kept> {
    let graph = &model.graph;
    let mut rounding = Rounding::new(graph);
    for (scene, output) in model.scenes.iter().zip(scenes) {
        if !scene.results.contains(&Wanted::ErrorBound) {
            continue;
        }
        let Output::Record(fields) = output else { continue };
        graph.begin_section("Bounds of rounding errors");
        let name = model.result_name(Wanted::ErrorBound).unwrap_or_default();
        let doc = "Bounds of the rounding errors of the other results, each in its own unit.".to_owned();
        let bounds = fields.iter().map(|field| bounded(graph, &mut rounding, field)).collect();
        fields.push(Field { name, doc, value: Output::Record(bounds) });
    }
    let named = |node: NodeId| kept.iter().find(|kept| kept.node == node).map(|kept| kept.name.clone());
    rounding
        .held
        .iter()
        .enumerate()
        .map(|(index, (of, bound))| {
            let of = named(*of).unwrap_or_else(|| format!("value_{}", index + 1));
            let name = format!("error_{of}");
            graph.name_kept(*bound, &name);
            Kept { name, meaning: format!("bound of the rounding error of `{of}`"), node: bound.id() }
        })
        .collect()
}

fn bounded<'g>(graph: &'g Graph, rounding: &mut Rounding<'g>, field: &Field) -> Field {
    let doc = format!("Of: {}", field.doc);
    Field { name: field.name.clone(), doc, value: bounds_of(graph, rounding, &field.value) }
}

/// The same result with its bounds for values.
fn bounds_of<'g>(graph: &'g Graph, rounding: &mut Rounding<'g>, output: &Output) -> Output {
    let mut bound = |node: NodeId| rounding.bound(graph.expr(node)).id();
    match output {
        Output::Scalar(node, meaning) => Output::Scalar(bound(*node), *meaning),
        Output::Vector(pair, meaning) => Output::Vector(pair.map(bound), *meaning),
        Output::Resolved(pair) => Output::Resolved(pair.map(bound)),
        Output::Reaction { ty, force, parts } => Output::Reaction {
            ty,
            force: force.map(&mut bound),
            parts: parts.iter().map(|(part, node)| (*part, bound(*node))).collect(),
        },
        Output::Term { velocity, work, meaning } => {
            Output::Term { velocity: bound(*velocity), work: bound(*work), meaning: *meaning }
        }
        Output::Record(fields) => Output::Record(fields.iter().map(|field| bounded(graph, rounding, field)).collect()),
        Output::Verification(comparison) => Output::Verification(comparison.clone()),
    }
}
