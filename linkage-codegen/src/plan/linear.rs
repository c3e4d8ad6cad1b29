//! Linear systems of expressions: constants are eliminated while the code is made, and what is left is a core that is solved at run time
//! with pivoting.

pub(super) use crate::graph::elimination::Equation;
use crate::graph::elimination::Reduced;
use crate::graph::{Expr, Failure, Graph};

/// The largest core: its unknowns are numbered in a byte.
pub(super) const CORE: usize = 250;
/// The largest core whose determinant is written out.
const WRITTEN_OUT: usize = 3;

/// What a vanishing core is called.
#[derive(Clone, Copy)]
pub(super) struct Core<'a, 'm> {
    /// The name of its determinant.
    pub name: &'a str,
    /// The group, by its links.
    pub group: &'a str,
    /// How much larger the rounding of its terms may be than that of products of unit vectors.
    pub spread: Expr<'m>,
    /// Whether the solution is refined.
    pub refined: bool,
    /// Names an unknown that comes out of the core: what is eliminated before is made of these.
    pub unknown: &'a dyn Fn(usize, Expr<'m>) -> Expr<'m>,
}

/// The unknowns. The size of the core, if that is larger than what can be solved.
///
/// What elimination takes from one equation to another brings its rounding there, however small the terms of that equation are. Where right
/// sides are taken over, and it is asked for, the solution is refined: what it leaves open of the equations as they were is solved once
/// more, so that each is left with the rounding of its own terms.
///
/// R. D. Skeel, Iterative Refinement Implies Numerical Stability for Gaussian Elimination, 1980.
pub(super) fn solve<'m>(
    graph: &'m Graph,
    equations: &[Equation<'m>],
    core: Core<'_, 'm>,
) -> Result<Vec<Expr<'m>>, usize> {
    let reduced = Reduced::of(equations);
    let mut right: Vec<Expr<'m>> = equations.iter().map(|equation| equation.right).collect();
    let mut values = solved(graph, &reduced, &mut right, core)?;
    if core.refined && reduced.steps.iter().any(|step| !step.factors.is_empty() && !right[step.equation].is_zero()) {
        values = reduced.completed(&right, values);
        // What gave an unknown as it was has nothing open but its own rounding.
        let open = |(row, equation): (usize, &Equation<'m>)| {
            if reduced.changes(row) { equation.left_open(&values) } else { graph.zero() }
        };
        let mut open: Vec<Expr<'m>> = equations.iter().enumerate().map(open).collect();
        for value in open.iter_mut().filter(|value| value.value().is_none()) {
            let name = format!("open_{}", core.group.replace(" + ", "_"));
            *value =
                value.named(name, format!("what the solution so far leaves open of the equilibrium of {}", core.group));
        }
        let more = solved(graph, &reduced, &mut open, core)?;
        let more = reduced.completed(&open, more);
        let refined = values.iter().zip(more).enumerate();
        let refined: Vec<Expr<'m>> =
            refined.map(|(column, (value, more))| (core.unknown)(column, *value + more)).collect();
        graph.note_solution(equations, &refined);
        return Ok(refined);
    }
    for column in &reduced.unknowns {
        values[*column] = (core.unknown)(*column, values[*column]);
    }
    Ok(reduced.completed(&right, values))
}

/// The unknowns of the core, under some right sides; these are then as the equations' own became.
fn solved<'m>(
    graph: &'m Graph,
    reduced: &Reduced<'m>,
    right: &mut [Expr<'m>],
    core: Core<'_, 'm>,
) -> Result<Vec<Expr<'m>>, usize> {
    reduced.reduce(right);
    let rows = reduced.core.iter().zip(&reduced.equations).map(|(line, row)| (line.clone(), right[*row]));
    let mut values = vec![graph.zero(); right.len()];
    for (column, value) in reduced.unknowns.iter().zip(solve_core(graph, &rows.collect::<Vec<_>>(), core)?) {
        values[*column] = value;
    }
    Ok(values)
}

fn solve_core<'m>(
    graph: &'m Graph,
    rows: &[(Vec<Expr<'m>>, Expr<'m>)],
    core: Core<'_, 'm>,
) -> Result<Vec<Expr<'m>>, usize> {
    let matrix: Vec<&[Expr<'m>]> = rows.iter().map(|(row, _)| row.as_slice()).collect();
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    if rows.len() > CORE {
        return Err(rows.len());
    }
    if rows.iter().all(|(_, right)| right.is_zero()) {
        return Ok(vec![graph.zero(); rows.len()]);
    }
    let failure = || Failure::DeadCentre { group: core.group.into(), pivot: core.name.into() };
    if rows.len() > WRITTEN_OUT {
        // A pivot is refused where it is no larger than the rounding of its terms.
        let (values, distance) = graph.solved_any(rows);
        let distance =
            distance.named(core.name, "smallest pivot of the equations that are left, over the size of its terms");
        let checked = |value: Expr<'m>| value.require_above(distance.abs(), graph.epsilons(8), failure());
        return Ok(values.into_iter().map(checked).collect());
    }
    // The determinant is refused where it is no larger than the rounding of its terms.
    let terms = determinant_terms(&matrix);
    let determinant = terms
        .iter()
        .fold(graph.zero(), |sum, term| sum + *term)
        .named(core.name, "determinant of the equations that are left");
    let size = terms.iter().fold(graph.zero(), |sum, term| sum + term.magnitude());
    let rounding = graph.epsilons(8) * size * core.spread;
    let checked = |value: Expr<'m>| value.require_above(determinant.abs(), rounding, failure());
    if let [(row, right)] = rows {
        return Ok(vec![*right / checked(row[0])]);
    }
    Ok(graph.solved(rows).into_iter().map(checked).collect())
}

/// The terms of a determinant of at most three rows, by the rule of Leibniz.
fn determinant_terms<'m>(matrix: &[&[Expr<'m>]]) -> Vec<Expr<'m>> {
    match matrix {
        [a] => vec![a[0]],
        [a, b] => vec![a[0] * b[1], -(a[1] * b[0])],
        [a, b, c] => (0..3)
            .flat_map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                [a[i] * b[j] * c[k], -(a[i] * b[k] * c[j])]
            })
            .collect(),
        _ => Vec::new(),
    }
}
