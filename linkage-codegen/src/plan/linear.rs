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
    /// The unknown that it gives before any other is eliminated, if it is there to tell one from another.
    pub gives: Option<usize>,
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
    /// Whether the solution is refined.
    pub refined: bool,
    /// Names an unknown that comes out of the core: what is eliminated before is made of these.
    pub unknown: &'a dyn Fn(usize, Expr<'m>) -> Expr<'m>,
}

/// A step of elimination: an equation gives an unknown, which is taken out of others.
struct Step<'m> {
    equation: usize,
    unknown: usize,
    /// The coefficient of the unknown, and what those of the others are over it.
    pivot: Expr<'m>,
    others: Vec<(usize, Expr<'m>)>,
    /// The coefficients of the unknown in other equations.
    factors: Vec<(usize, Expr<'m>)>,
}

/// Equations from which unknowns were eliminated by constants.
struct Reduced<'m> {
    steps: Vec<Step<'m>>,
    /// The coefficients of what is left, and of which equations and unknowns they are.
    core: Vec<Vec<Expr<'m>>>,
    equations: Vec<usize>,
    unknowns: Vec<usize>,
}

impl<'m> Reduced<'m> {
    fn of(equations: &[Equation<'m>]) -> Self {
        let mut rows: Vec<Vec<Expr<'m>>> = equations.iter().map(|equation| equation.coefficients.clone()).collect();
        // From the last one on, so that the others stay where they are.
        let mut given: Vec<(usize, usize)> =
            (0..rows.len()).filter_map(|row| Some((row, equations[row].gives?))).collect();
        let (mut equations, mut unknowns): (Vec<usize>, Vec<usize>) = (0..rows.len()).map(|row| (row, row)).unzip();
        let mut steps = Vec::new();
        while let Some((index, unknown)) = given.pop().or_else(|| constant_pivot(&rows, &equations, &unknowns)) {
            let equation = equations.swap_remove(index);
            unknowns.retain(|column| *column != unknown);
            let pivot = rows[equation][unknown];
            let factor = |row: &usize| Some((*row, rows[*row][unknown])).filter(|(_, factor)| !factor.is_zero());
            let factors: Vec<(usize, Expr<'m>)> = equations.iter().filter_map(factor).collect();
            let other = |column: &usize| {
                let coefficient = rows[equation][*column];
                (!coefficient.is_zero()).then(|| (*column, coefficient / pivot))
            };
            let others: Vec<(usize, Expr<'m>)> = unknowns.iter().filter_map(other).collect();
            for (row, factor) in &factors {
                for (column, coefficient) in &others {
                    rows[*row][*column] = rows[*row][*column] - *factor * *coefficient;
                }
            }
            steps.push(Step { equation, unknown, pivot, others, factors });
        }
        let core = equations.iter().map(|row| unknowns.iter().map(|column| rows[*row][*column]).collect()).collect();
        Self { steps, core, equations, unknowns }
    }

    /// The unknowns of the core, under some right sides; these are then as the equations' own became.
    fn solved(&self, graph: &'m Graph, right: &mut [Expr<'m>], core: Core<'_, 'm>) -> Result<Vec<Expr<'m>>, usize> {
        for step in &self.steps {
            right[step.equation] = right[step.equation] / step.pivot;
            for (row, factor) in &step.factors {
                right[*row] = right[*row] - *factor * right[step.equation];
            }
        }
        let rows = self.core.iter().zip(&self.equations).map(|(line, row)| (line.clone(), right[*row]));
        let mut values = vec![graph.zero(); right.len()];
        for (column, value) in self.unknowns.iter().zip(solve_core(graph, &rows.collect::<Vec<_>>(), core)?) {
            values[*column] = value;
        }
        Ok(values)
    }

    /// The other unknowns, from those of the core.
    fn completed(&self, right: &[Expr<'m>], mut values: Vec<Expr<'m>>) -> Vec<Expr<'m>> {
        for step in self.steps.iter().rev() {
            let others = step.others.iter();
            values[step.unknown] =
                others.fold(right[step.equation], |sum, (column, coefficient)| sum - *coefficient * values[*column]);
        }
        values
    }

    /// What the unknowns leave open of an equation. One that gave an unknown as it was has nothing open but its own rounding.
    fn left_open(&self, graph: &'m Graph, row: usize, equation: &Equation<'m>, values: &[Expr<'m>]) -> Expr<'m> {
        let changed = |step: &Step<'m>| step.factors.iter().any(|(other, _)| *other == row);
        if !self.equations.contains(&row) && !self.steps.iter().any(changed) {
            return graph.zero();
        }
        let terms = equation.coefficients.iter().zip(values).filter(|(coefficient, _)| !coefficient.is_zero());
        terms.fold(equation.right, |sum, (coefficient, value)| sum - *coefficient * *value)
    }
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
    let mut values = reduced.solved(graph, &mut right, core)?;
    if core.refined && reduced.steps.iter().any(|step| !step.factors.is_empty() && !right[step.equation].is_zero()) {
        values = reduced.completed(&right, values);
        let mut open: Vec<Expr<'m>> =
            (0..equations.len()).map(|row| reduced.left_open(graph, row, &equations[row], &values)).collect();
        for value in open.iter_mut().filter(|value| value.value().is_none()) {
            let name = format!("open_{}", core.group.replace(" + ", "_"));
            *value =
                value.named(name, format!("what the solution so far leaves open of the equilibrium of {}", core.group));
        }
        let more = reduced.solved(graph, &mut open, core)?;
        let more = reduced.completed(&open, more);
        let refined = values.iter().zip(more).enumerate();
        return Ok(refined.map(|(column, (value, more))| (core.unknown)(column, *value + more)).collect());
    }
    for column in &reduced.unknowns {
        values[*column] = (core.unknown)(*column, values[*column]);
    }
    Ok(reduced.completed(&right, values))
}

/// An equation with a constant coefficient of an open unknown: the one that the fewest other equations hold.
fn constant_pivot(rows: &[Vec<Expr<'_>>], equations: &[usize], unknowns: &[usize]) -> Option<(usize, usize)> {
    let constant = |row: usize, column: usize| rows[row][column].sign().is_some_and(|s| s != 0);
    let candidates = unknowns.iter().flat_map(|column| (0..equations.len()).map(move |row| (row, *column)));
    let others = |column: usize| equations.iter().filter(|row| !rows[**row][column].is_zero()).count();
    candidates.filter(|(row, column)| constant(equations[*row], *column)).min_by_key(|(_, column)| others(*column))
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
