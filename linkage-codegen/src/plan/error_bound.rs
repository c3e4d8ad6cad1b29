//! Bounds of the rounding errors of a scene's results.
//!
//! They follow the operations (see [`Rounding`]), but for what closes a loop: there the operations' own bounds would add up what in truth
//! makes up for each other. What the closure leaves over, which is computed, says more: with the residual `ρ` of the loop, known to its
//! own rounding, and the columns `c`, `c'` by which it changes with the two unknowns, these are off by y and y' with `c y + c' y' = ρ`:
//!
//! ```text
//! y = (ρ × c')/(c × c')        y' = −y (c·c')/(c'·c') + (ρ·c')/(c'·c')
//! ```
//!
//! Near a dead centre, where `c × c'` vanishes, only the first is large, and the second follows it. So y is a source of errors, of which
//! all that is placed through the loop has a share; where more loops follow, the little beside it in y' is another one. So are the errors of
//! the forces and the rates of rotation that one group passes on to the next. Where the operations of the two directions themselves tell more
//! than the residual, the two sources stand for what these are off.
//!
//! Of a group that was placed by a search, with n unknowns and equations, what stays open of them is known likewise, and the changes of the
//! equations with the unknowns are the matrix J of its last step. The unknowns are off by `J⁻¹ (ρ − ρ')`, with ρ' what earlier sources and
//! rounding make of ρ; each equation is a source, because near a singular pose all unknowns follow one of them. What is not linear is bounded
//! as in the theorem of Newton and Kantorovich: were the unknowns off by twice what first order says, it must not make more of them than that.
//!
//! Of three pins, half angles and constants that fold know the sine of the transmission angle, `s = u × u'`, better near its zeros than the
//! residual does: `δs = (u·u')(y' − y)` is a second bound of y. The lesser of the two is taken.

use super::assembly::{Closed, ClosedEquation, ClosedLoop, Found, Pivot, PlacedTogether, Unknown};
use super::output::Field;
use super::{Assembly, Kept, Output};
use crate::graph::elimination::Equation;
use crate::graph::number::Number;
use crate::graph::rounding::{BoundOf, Deviation, HeldBound, Inverse, Rounding};
use crate::graph::{Expr, Graph, NodeId, Op, Vector};
use crate::model::Wanted;

/// Adds their bounds to the results of the scenes that want them. What a pose has to keep for that comes back.
pub(super) fn add(assembly: &Assembly<'_>, scenes: &mut [Output], kept: &[Kept]) -> Vec<Kept> {
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
    assembly.leans.iter().for_each(|lean| rounding.is_direction(*lean));
    for closed in &assembly.closed {
        match closed {
            Closed::Loop(closed) => state(&mut rounding, closed, kept, assembly.closed.len() > 1),
            Closed::Together(placed) => state_together(&mut rounding, placed),
        }
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
    }
    let named = |node: NodeId| kept.iter().find(|kept| kept.node == node).map(|kept| kept.name.clone());
    let shared = |held: &HeldBound<'_>| {
        let same = |other: &HeldBound<'_>| (other.value, other.what) == (held.value, held.what);
        rounding.held.iter().any(|other| same(other) && other.source.is_some())
    };
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
        let (name, meaning) = match held.source.map(|source| rounding.name_of(source)) {
            Some(by) => (
                format!("{name}_by_{by}"),
                format!("share of the rounding error of {what} that comes with that of `{by}`"),
            ),
            None if shared(held) => (name, format!("bound of the rounding error of {what} beside its shares")),
            None => (name, format!("bound of the rounding error of {what}")),
        };
        graph.name_kept(held.bound.id(), &name);
        Kept { name, meaning, node: held.bound.id(), is_bound: true }
    };
    rounding.held.iter().map(keep).collect()
}

/// The errors of a loop's unknowns.
fn state<'g>(rounding: &mut Rounding<'g>, closed: &ClosedLoop<'g>, kept: &[Kept], leads_on: bool) {
    let graph = closed.determinant.graph();
    let exact: Vec<Expr<'g>> = closed.found.iter().flat_map(Found::values).collect();
    let ClosedLoop { residual, name, .. } = closed;
    // Where slides along the axes make the unknowns parts of the way itself, nothing is left over by form, and that says nothing of them:
    // their own operations do.
    if residual.x.is_zero() || residual.y.is_zero() {
        return;
    }
    let [x, y] = [residual.x, residual.y].map(|part| rounding.deviation_from(part, &exact));
    let stretch = closed.found.each_ref().map(|found| match found {
        Found::Direction { direction, .. } => rounding.stretch(*direction),
        Found::Length { .. } => graph.zero(),
    });
    // Of what has no source: by how much the parts of the residual, and the sizes of directions, may change a product with the residual.
    let [own_x, own_y] = [("x", residual.x, &x), ("y", residual.y, &y)].map(|(axis, residual, found)| {
        let what = format!("what the loop at {name} leaves open along {axis}, and the rounding of that");
        (residual.abs() + found.rest).named(format!("open_{name}_{axis}"), what)
    });
    let own = |parts: Vector<'g>, arms: &dyn Fn(Vector<'g>) -> Expr<'g>| {
        closed.found.iter().zip(stretch).fold(parts.x.abs() * own_x + parts.y.abs() * own_y, |sum, (found, stretch)| {
            match found {
                Found::Direction { arm, .. } => sum + stretch * arms(*arm).abs(),
                Found::Length { .. } => sum,
            }
        })
    };
    let [first, second] = closed.found.each_ref().map(Found::column);
    let size = closed.determinant.abs();
    // What earlier sources bring, as the unknowns would follow the change of the residual.
    let [one, other] = [(second, -1), (first, 1)].map(|(column, sign)| {
        Deviation::shares_of(&x, &y, |dx, dy| sign * (dx * column.y - dy * column.x) / closed.determinant)
    });
    // The rest as a source: the first unknown, which the second follows, but for what is along its column.
    let square = second.squared();
    let [one_name, other_name] = closed.found.each_ref().map(|found| name_of(found, kept));
    let follows = -(first.dot(second) / square);
    let follows = follows
        .named(format!("follows_{name}"), format!("how {other_name} follows {one_name} where the loop stays closed"));
    let decisive = own(second.perp(), &|arm| arm.cross(second)) / size;
    let decisive = decisive.named(format!("off_{name}"), format!("bound of the error of {one_name} by what is open"));
    let beside = own(second, &|arm| arm.dot(second)) / square;
    let beside = beside.named(format!("beside_{name}"), format!("of {other_name} what does not follow {one_name}"));
    let totals = [one.total() + decisive, other.total() + follows.abs() * decisive + beside];
    let change = beyond_first_order(closed, totals);
    let change = change
        .named(format!("beyond_{name}"), "what is not linear in these errors; infinite where that is not bounded");
    let along = second.x.abs() + second.y.abs();
    let (decisive, beside) = (decisive + change * along / size, beside + change * along / square);
    // Near a dead centre the pivot, by its own operations, may tell more than the residual does.
    let mut by_itself = None;
    let decisive = match closed.pivot {
        Some(Pivot { value, again, slopes: Some(slopes) }) => {
            let own = rounding.by_operations(value);
            let unexpected = own.clone().plus(&one.scaled(-slopes[0])).plus(&other.scaled(-slopes[1])).total();
            let stretched = again.abs() * (stretch[0] + stretch[1]);
            let rounded = rounding.deviation_from(again, &exact).rest + (again - value).abs();
            let curved = 2 * (totals[0] + totals[1]).squared();
            let sum = unexpected + rounded + stretched + slopes[1].abs() * beside + curved;
            by_itself = Some(own);
            let by_pivot = sum / (slopes[0] + slopes[1] * follows).abs();
            let what = format!("bound of the error of {one_name} by that of the pivot");
            lesser(decisive, by_pivot.named(format!("off_{name}_by_pivot"), what))
        }
        _ => decisive,
    };
    let own_turns = closed.found.each_ref().map(|found| match found {
        Found::Direction { direction, .. } if closed.apart => Some(rounding.turn_by_operations(*direction)),
        _ => None,
    });
    let source = rounding.source(&closed.name);
    let one = one.plus(&Deviation::of(source, decisive));
    let other = other.plus(&Deviation::of(source, follows * decisive)).and(beside);
    let second_source = leads_on.then(|| rounding.source(&format!("{}_beside", closed.name)));
    let other = match second_source {
        Some(second_source) => other.from(second_source),
        None => other,
    };
    let deviations = match (own_turns, second_source) {
        ([Some(own), Some(others)], Some(second_source)) => {
            // Both by the same way, so that what comes with a source is the same in both.
            let by_residual = [one, other];
            let by_operations = [own.from(source), others.from(second_source)];
            let both = |[one, other]: &[Deviation<'g>; 2]| one.total() + other.total();
            let second = graph.one().where_above(both(&by_residual), both(&by_operations));
            [0, 1].map(|found| either(second, &by_residual[found], &by_operations[found]))
        }
        ([own, others], _) => {
            let nearer = |deviation: Deviation<'g>, own: Option<Deviation<'g>>| match own {
                Some(own) => lesser_deviation(&deviation, &own),
                None => deviation,
            };
            [nearer(one, own), nearer(other, others)]
        }
    };
    for ((found, deviation), stretch) in closed.found.iter().zip(deviations).zip(stretch) {
        match found {
            Found::Direction { direction, .. } => rounding.state_direction(*direction, deviation, stretch),
            Found::Length { length, .. } => rounding.state(*length, deviation),
        }
    }
    if let Some(Pivot { value, again, .. }) = closed.pivot {
        let found = rounding.deviation(again.id()).and((again - value).abs());
        let deviation = by_itself.map_or_else(|| found.clone(), |own| lesser_deviation(&found, &own));
        rounding.state(value, deviation);
    }
}

/// What a loop's unknown is called in the text of its bounds: as a pose keeps it.
fn name_of(found: &Found<'_>, kept: &[Kept]) -> String {
    let of = |value: Expr<'_>| {
        let node = value.held().id();
        kept.iter().find(|kept| kept.node == node).map(|kept| kept.name.clone())
    };
    match found {
        Found::Direction { direction, .. } => of(direction.x).map_or_else(
            || "the direction".to_owned(),
            |name| format!("the angle of {}", name.strip_suffix("_cos").unwrap_or(&name)),
        ),
        Found::Length { length, .. } => of(*length).unwrap_or_else(|| "the length".to_owned()),
    }
}

/// The errors of the unknowns of a group that was placed by a search.
fn state_together<'g>(rounding: &mut Rounding<'g>, placed: &PlacedTogether<'g>) {
    let PlacedTogether { equations, unknowns, .. } = placed;
    let Some(graph) = equations.first().map(|equation| equation.residual.graph()) else { return };
    let exact: Vec<Expr<'g>> = unknowns.iter().flat_map(Unknown::values).collect();
    let strain = unknowns.iter().zip(&placed.names).map(|(unknown, name)| match unknown {
        Unknown::Direction(direction) => {
            let strain = rounding.strain(*direction);
            strain.named(format!("strain_of_{name}"), format!("how far the direction at {name} is from unit size"))
        }
        Unknown::Angle(_) | Unknown::Travel { .. } => graph.zero(),
    });
    let strain: Vec<Expr<'g>> = strain.collect();
    let inverse = Inverse::of(graph, &linear(equations)).named(|unknown, equation| {
        let (unknown, equation) = (&placed.names[unknown], &equations[equation].name);
        (format!("{unknown}_by_{equation}"), format!("how {unknown} changes with what stays open at {equation}"))
    });
    let right = equations.iter().enumerate().map(|(index, equation)| {
        let found = rounding.deviation_from(equation.residual, &exact);
        // With its size a direction changes one component as with its angle the other one; what its size is off by is known.
        let (mut open, mut uncertain) = (equation.residual, graph.zero());
        if let Some(other) = equation.other {
            for (arm, strain) in equations[other].changes.iter().zip(&strain).filter(|(_, strain)| !strain.is_zero()) {
                let part = *strain * *arm;
                open = if index < other { open - part } else { open + part };
                uncertain = uncertain + arm.abs();
            }
        }
        let own = open.abs() + found.rest + rounding.of_strain() * uncertain;
        let source = rounding.source(&equation.name);
        Deviation::of(source, own).plus(&found.shared().opposite())
    });
    let found = inverse.times(right.collect());
    let found = inverse.and_beyond(found, |most| beyond_linear(placed, most));
    for (unknown, deviation) in unknowns.iter().zip(found) {
        match unknown {
            Unknown::Direction(direction) => {
                rounding.state_direction(*direction, deviation, rounding.stretch(*direction));
            }
            Unknown::Angle(angle) => rounding.state(*angle, deviation),
            Unknown::Travel { travel, scale } => rounding.state(*travel, deviation.scaled(*scale)),
        }
    }
}

/// The changes of equations with the unknowns.
fn linear<'g>(equations: &[ClosedEquation<'g>]) -> Vec<Equation<'g>> {
    let of = |equation: &ClosedEquation<'g>| Equation {
        coefficients: equation.changes.clone(),
        right: equation.residual.graph().zero(),
        gives: None,
    };
    equations.iter().map(of).collect()
}

/// By how much each equation is off what is linear in the unknowns, if these are off by no more than y: of a loop `Σ |c| y²/2` over what
/// turns, with `c` its vector, and `y₁ y₂` for each length and each angle, as it may lie along what turns with that.
fn beyond_linear<'g>(placed: &PlacedTogether<'g>, most: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let PlacedTogether { equations, unknowns, .. } = placed;
    let of = |equation: &ClosedEquation<'g>| {
        let graph = equation.residual.graph();
        let half = graph.constant(&Number::ratio(1, 2));
        let Some(other) = equation.other else { return graph.zero() };
        let size = |index: usize| equation.changes[index].abs() + equations[other].changes[index].abs();
        let part_of = (0..unknowns.len()).filter(|index| !size(*index).is_zero());
        let (travels, turns): (Vec<usize>, Vec<usize>) =
            part_of.partition(|index| matches!(unknowns[*index], Unknown::Travel { .. }));
        let curved = turns.iter().fold(graph.zero(), |sum, index| sum + half * (size(*index) * most[*index].squared()));
        let angles = turns.iter().fold(graph.zero(), |sum, index| sum + most[*index]);
        travels.iter().fold(curved, |sum, index| match unknowns[*index] {
            Unknown::Travel { scale, .. } => sum + scale * most[*index] * angles,
            _ => sum,
        })
    };
    equations.iter().map(of).collect()
}

/// The lesser of two bounds; the first if the second is no number.
fn lesser<'g>(one: Expr<'g>, other: Expr<'g>) -> Expr<'g> {
    lesser_deviation(&Deviation::within(one), &Deviation::within(other)).rest
}

/// The deviation with the lesser bound; the first if that of the second is no number.
fn lesser_deviation<'g>(one: &Deviation<'g>, other: &Deviation<'g>) -> Deviation<'g> {
    either(one.rest.graph().one().where_above(one.total(), other.total()), one, other)
}

/// The first of two deviations where `second` is zero, the second where that is one.
fn either<'g>(second: Expr<'g>, one: &Deviation<'g>, other: &Deviation<'g>) -> Deviation<'g> {
    let half = second.graph().constant(&Number::ratio(1, 2));
    let pick = |one: Expr<'g>, other: Expr<'g>| one.where_above(half, second) + other.where_above(second, half);
    Deviation::shares_of(one, other, pick).and(pick(one.rest, other.rest))
}

/// By how much the residual is off what is linear in the unknowns. Let these be off by no more than y = 2T, twice what first order says: then
/// that is `Σ |c| y²/2` over the directions, and `y₁ y₂` if a length lies along a direction. If what it makes of the unknowns is no more
/// than T, there is a solution as near as y, and it is the one on the same side; or else nothing is known: infinite.
fn beyond_first_order<'g>(closed: &ClosedLoop<'g>, totals: [Expr<'g>; 2]) -> Expr<'g> {
    let graph = closed.determinant.graph();
    let sizes = closed.found.each_ref().map(|found| {
        let column = found.column();
        if found.is_direction() { column.x.abs() + column.y.abs() } else { graph.one() }
    });
    let curved = |index: usize| {
        if closed.found[index].is_direction() { sizes[index] * totals[index].squared() } else { graph.zero() }
    };
    let [first, second] = &closed.found;
    let both = if first.is_direction() == second.is_direction() { graph.zero() } else { 2 * (totals[0] * totals[1]) };
    let change = 2 * (curved(0) + curved(1) + both);
    let size = closed.determinant.abs();
    // Not where both are compared the other way: if nothing is off at all, none is more than the other.
    let is_more = |index: usize| graph.one().where_above(change * sizes[1 - index], size * totals[index]);
    change / graph.one().where_above(graph.constant(&Number::ratio(1, 2)), is_more(0) + is_more(1))
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
