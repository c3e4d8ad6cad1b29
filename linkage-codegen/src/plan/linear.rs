//! Linear systems of expressions: constants are eliminated while the code is made, and what is left is a core that is solved at run time
//! with pivoting.

use crate::graph::{Expr, Failure, Graph};

/// An equation: `Σ coefficients · unknowns = right`.
#[derive(Clone, Debug)]
pub(super) struct Equation<'m> {
    /// One for each unknown.
    pub coefficients: Vec<Expr<'m>>,
    /// The right side.
    pub right: Expr<'m>,
}

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
    /// Names an unknown that comes out of the core: what is eliminated before is made of these.
    pub unknown: &'a dyn Fn(usize, Expr<'m>) -> Expr<'m>,
}

/// A step of elimination: which equation gave which unknown.
struct Eliminated<'m> {
    unknown: usize,
    equation: Equation<'m>,
}

/// The unknowns. The size of the core, if that is larger than what can be solved.
pub(super) fn solve<'m>(
    graph: &'m Graph,
    mut equations: Vec<Equation<'m>>,
    core: Core<'_, 'm>,
) -> Result<Vec<Expr<'m>>, usize> {
    let count = equations.len();
    let mut eliminated: Vec<Eliminated<'m>> = Vec::new();
    let mut open: Vec<usize> = (0..count).collect();
    while let Some((row, unknown)) = constant_pivot(&equations, &open) {
        let mut pivot = equations.swap_remove(row);
        let scale = pivot.coefficients[unknown];
        pivot.coefficients.iter_mut().for_each(|c| *c = *c / scale);
        pivot.right = pivot.right / scale;
        for equation in &mut equations {
            let factor = equation.coefficients[unknown];
            if factor.is_zero() {
                continue;
            }
            for column in 0..count {
                equation.coefficients[column] = equation.coefficients[column] - factor * pivot.coefficients[column];
            }
            equation.right = equation.right - factor * pivot.right;
        }
        open.retain(|column| *column != unknown);
        eliminated.push(Eliminated { unknown, equation: pivot });
    }
    let mut values = vec![graph.zero(); count];
    for (column, value) in open.iter().zip(solve_core(graph, &equations, &open, core)?) {
        values[*column] = (core.unknown)(*column, value);
    }
    while let Some(Eliminated { unknown, equation }) = eliminated.pop() {
        let known = (0..count).filter(|column| *column != unknown && !equation.coefficients[*column].is_zero());
        values[unknown] =
            known.fold(equation.right, |sum, column| sum - equation.coefficients[column] * values[column]);
    }
    Ok(values)
}

/// An equation with a constant coefficient of an open unknown: the one that the fewest other equations hold.
fn constant_pivot(equations: &[Equation<'_>], open: &[usize]) -> Option<(usize, usize)> {
    let constant = |row: usize, column: usize| equations[row].coefficients[column].sign().is_some_and(|s| s != 0);
    let candidates = open.iter().flat_map(|column| (0..equations.len()).map(move |row| (row, *column)));
    let others = |column: usize| equations.iter().filter(|e| !e.coefficients[column].is_zero()).count();
    candidates.filter(|(row, column)| constant(*row, *column)).min_by_key(|(_, column)| others(*column))
}

fn solve_core<'m>(
    graph: &'m Graph,
    equations: &[Equation<'m>],
    open: &[usize],
    core: Core<'_, 'm>,
) -> Result<Vec<Expr<'m>>, usize> {
    let rows: Vec<(Vec<Expr<'m>>, Expr<'m>)> =
        equations.iter().map(|e| (open.iter().map(|column| e.coefficients[*column]).collect(), e.right)).collect();
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
        let (values, distance) = graph.solved_any(&rows);
        let distance = distance.named(core.name, "smallest pivot of the core, over the size of its terms");
        let checked = |value: Expr<'m>| value.require_above(distance.abs(), graph.epsilons(8), failure());
        return Ok(values.into_iter().map(checked).collect());
    }
    // The determinant is refused where it is no larger than the rounding of its terms.
    let terms = determinant_terms(&matrix);
    let determinant =
        terms.iter().fold(graph.zero(), |sum, term| sum + *term).named(core.name, "determinant of the core");
    let size = terms.iter().fold(graph.zero(), |sum, term| sum + term.magnitude());
    let rounding = graph.epsilons(8) * size * core.spread;
    let checked = |value: Expr<'m>| value.require_above(determinant.abs(), rounding, failure());
    if let [(row, right)] = rows.as_slice() {
        return Ok(vec![*right / checked(row[0])]);
    }
    Ok(graph.solved(&rows).into_iter().map(checked).collect())
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
