//! Bounds of the rounding errors of a scene's results.
//!
//! They follow the operations (see [`Rounding`]), but for what closes a loop: there the operations' own bounds would add up what in truth
//! makes up for each other. What the closure leaves over, which is computed, says more: with the residual `ρ` of the loop and the columns
//! `c` by which it changes with the two unknowns, each of these is off by no more than `|ρ × c'|/|c × c'|`, c' the other's column, as long
//! as this is too little to change `c × c'` much.

use super::assembly::{ClosedLoop, Found};
use super::output::Field;
use super::{Assembly, Kept, Output};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::number::Number;
use crate::graph::rounding::{BoundOf, HeldBound, Rounding};
use crate::graph::{Expr, Graph, NodeId, Op, Vector};
use crate::model::Wanted;

/// Adds their bounds to the results of the scenes that want them. What a pose has to keep for that comes back.
pub(super) fn add(assembly: &Assembly<'_>, scenes: &mut [Output], kept: &[Kept], sink: &Sink) -> Vec<Kept> {
    let model = assembly.model();
    let graph = &model.graph;
    if !model.scenes.iter().any(|scene| scene.results.contains(&Wanted::ErrorBound)) {
        return Vec::new();
    }
    let mut rounding = Rounding::new(graph);
    graph.begin_section("Bounds of rounding errors");
    for link in model.moving_links() {
        let Vector { x, y } = assembly.placement.direction(link);
        if let (Op::Held(x), Op::Held(y)) = (x.op(), y.op()) {
            rounding.is_direction(Vector::new(graph.expr(x), graph.expr(y)));
        }
    }
    for closed in &assembly.loops {
        state(&mut rounding, closed);
    }
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
        if core::mem::take(&mut rounding.searched) {
            let problem = "bounds of errors are not supported yet where links are placed by iteration";
            sink.report(
                Diagnostic::new(scene.name.place(), problem)
                    .help("leave `error_bound` out, or ask for results that do not depend on these links"),
            );
        }
    }
    let named = |node: NodeId| kept.iter().find(|kept| kept.node == node).map(|kept| kept.name.clone());
    let keep = |held: &HeldBound<'_>| {
        let value = named(held.value).unwrap_or_else(|| format!("value_{}", held.value.index()));
        let direction = value.strip_suffix("_cos").unwrap_or(&value);
        let (name, what) = match held.what {
            BoundOf::Value => (format!("error_{value}"), format!("`{value}`")),
            BoundOf::Angle => {
                (format!("error_angle_{direction}"), format!("the angle of the direction carried by `{direction}`"))
            }
            BoundOf::Size => {
                (format!("error_size_{direction}"), format!("the size of the direction carried by `{direction}`"))
            }
        };
        graph.name_kept(held.bound, &name);
        Kept { name, meaning: format!("bound of the rounding error of {what}"), node: held.bound.id() }
    };
    rounding.held.iter().map(keep).collect()
}

/// The errors of a loop's unknowns.
fn state<'g>(rounding: &mut Rounding<'g>, closed: &ClosedLoop<'g>) {
    let graph = closed.determinant.graph();
    let exact: Vec<Expr<'g>> = closed.found.iter().flat_map(Found::values).collect();
    let ClosedLoop { residual, .. } = closed;
    let [x, y] = [residual.x, residual.y].map(|part| part.abs() + rounding.error_from(part, &exact));
    // How far directions are from unit size.
    let half = graph.constant(&Number::ratio(1, 2));
    let stretch = closed.found.each_ref().map(|found| match found {
        Found::Direction { direction, .. } => {
            let excess = direction.squared() - graph.one();
            half * (excess.abs() + rounding.error_from(excess, &exact))
        }
        Found::Length { .. } => graph.zero(),
    });
    // |v × column| of what the residual may be, and of what the sizes of the directions bring into it.
    let across = |column: Vector<'g>| {
        let stretched = closed.found.iter().zip(stretch).fold(graph.zero(), |sum, (found, stretch)| match found {
            Found::Direction { arm, .. } => sum + stretch * arm.cross(column).abs(),
            Found::Length { .. } => sum,
        });
        x * column.y.abs() + y * column.x.abs() + stretched
    };
    let columns = closed.found.each_ref().map(Found::column);
    let first_order = [across(columns[1]), across(columns[0])].map(|sum| sum / closed.determinant);
    // What these may change of the columns, and these of the determinant.
    let sum_of = |angles: bool| {
        let counted = closed.found.iter().zip(first_order).filter(|(found, _)| found.is_direction() == angles);
        counted.fold(graph.zero(), |sum, (_, error)| sum + error)
    };
    let (turned, longer) = (sum_of(true), sum_of(false));
    let size = |column: Vector<'g>| column.x.abs() + column.y.abs();
    let [first, second] = columns.map(size);
    let [change, other_change] = [first, second].map(|size| size * turned + longer);
    let changed = 2 * (change * second + first * other_change);
    let least = closed.determinant - changed;
    let factor = closed.determinant / least.where_above(least, graph.zero());
    for ((found, error), stretch) in closed.found.iter().zip(first_order).zip(stretch) {
        let error = error * factor;
        match found {
            Found::Direction { direction, .. } => {
                rounding.state_direction(*direction, error, stretch);
            }
            Found::Length { length, .. } => rounding.state(*length, error),
        }
    }
    for (value, again) in &closed.beside {
        let difference = *again - *value;
        let error = rounding.error_from(difference, &[*value]);
        rounding.state(*value, difference.abs() + error);
    }
}

impl<'g> Found<'g> {
    fn values(&self) -> Vec<Expr<'g>> {
        match *self {
            Self::Direction { direction, .. } => vec![direction.x, direction.y],
            Self::Length { length, .. } => vec![length],
        }
    }

    fn column(&self) -> Vector<'g> {
        match *self {
            Self::Direction { column, .. } | Self::Length { column, .. } => column,
        }
    }

    fn is_direction(&self) -> bool {
        matches!(self, Self::Direction { .. })
    }
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
        Output::Column(values) => Output::Column(values.iter().copied().map(bound).collect()),
        Output::Matrix(rows) => {
            Output::Matrix(rows.iter().map(|row| row.iter().copied().map(&mut bound).collect()).collect())
        }
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
