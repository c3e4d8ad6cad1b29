//! Elimination in linear systems of expressions, while the code is made: what gives an unknown by a constant is taken out of the others,
//! down to a core.

use super::{Expr, Graph, NodeId};

/// An equation: `Σ coefficients · unknowns = right`.
#[derive(Clone, Debug)]
pub(crate) struct Equation<'m> {
    /// One for each unknown.
    pub coefficients: Vec<Expr<'m>>,
    /// The right side.
    pub right: Expr<'m>,
    /// The unknown that it gives before any other is eliminated, if it is there to tell one from another.
    pub gives: Option<usize>,
}

impl<'m> Equation<'m> {
    /// The coefficients and the unknowns that make it up, each with its column.
    pub(crate) fn products(&self, values: &[Expr<'m>]) -> Vec<(usize, (Expr<'m>, Expr<'m>))> {
        let terms = self.coefficients.iter().copied().zip(values.iter().copied()).enumerate();
        terms.filter(|(_, (coefficient, _))| !coefficient.is_zero()).collect()
    }

    /// What values of the unknowns leave open of it.
    pub(crate) fn left_open(&self, values: &[Expr<'m>]) -> Expr<'m> {
        let terms = self.products(values).into_iter();
        terms.fold(self.right, |sum, (_, (coefficient, value))| sum - coefficient * value)
    }
}

/// What equations can have for right sides and unknowns.
pub(crate) trait Linear<'m>: Clone {
    /// The quotient by a pivot.
    fn over(&self, pivot: Expr<'m>) -> Self;
    /// What is left without a multiple of another one.
    fn less(&self, factor: Expr<'m>, other: &Self) -> Self;
}

impl<'m> Linear<'m> for Expr<'m> {
    fn over(&self, pivot: Expr<'m>) -> Self {
        *self / pivot
    }
    fn less(&self, factor: Expr<'m>, other: &Self) -> Self {
        *self - factor * *other
    }
}

/// A step of elimination: an equation gives an unknown, which is taken out of others.
#[derive(Debug)]
pub(crate) struct Step<'m> {
    /// The equation.
    pub equation: usize,
    unknown: usize,
    /// The coefficient of the unknown, and what those of the others are over it.
    pivot: Expr<'m>,
    others: Vec<(usize, Expr<'m>)>,
    /// The coefficients of the unknown in other equations.
    pub factors: Vec<(usize, Expr<'m>)>,
}

/// Equations from which unknowns were eliminated by constants.
#[derive(Debug)]
pub(crate) struct Reduced<'m> {
    /// The eliminated ones.
    pub steps: Vec<Step<'m>>,
    /// The coefficients of what is left, and of which equations and unknowns they are.
    pub core: Vec<Vec<Expr<'m>>>,
    /// The equations that are left.
    pub equations: Vec<usize>,
    /// The unknowns that are left.
    pub unknowns: Vec<usize>,
}

impl<'m> Reduced<'m> {
    /// Eliminates.
    pub(crate) fn of(equations: &[Equation<'m>]) -> Self {
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

    /// Right sides as elimination leaves them.
    pub(crate) fn reduce<R: Linear<'m>>(&self, right: &mut [R]) {
        for step in &self.steps {
            right[step.equation] = right[step.equation].over(step.pivot);
            for (row, factor) in &step.factors {
                right[*row] = right[*row].less(*factor, &right[step.equation]);
            }
        }
    }

    /// The other unknowns, from those of the core and the right sides that are left.
    pub(crate) fn completed<R: Linear<'m>>(&self, right: &[R], mut values: Vec<R>) -> Vec<R> {
        for step in self.steps.iter().rev() {
            let others = step.others.iter();
            values[step.unknown] = others.fold(right[step.equation].clone(), |sum, (column, coefficient)| {
                sum.less(*coefficient, &values[*column])
            });
        }
        values
    }

    /// Whether something was taken out of an equation, or it is one of the core.
    pub(crate) fn changes(&self, row: usize) -> bool {
        let changed = |step: &Step<'m>| step.factors.iter().any(|(other, _)| *other == row);
        self.equations.contains(&row) || self.steps.iter().any(changed)
    }
}

/// An equation with a constant coefficient of an open unknown: the one that the fewest other equations hold.
fn constant_pivot(rows: &[Vec<Expr<'_>>], equations: &[usize], unknowns: &[usize]) -> Option<(usize, usize)> {
    let constant = |row: usize, column: usize| rows[row][column].sign().is_some_and(|s| s != 0);
    let candidates = unknowns.iter().flat_map(|column| (0..equations.len()).map(move |row| (row, *column)));
    let others = |column: usize| equations.iter().filter(|row| !rows[**row][column].is_zero()).count();
    candidates.filter(|(row, column)| constant(equations[*row], *column)).min_by_key(|(_, column)| others(*column))
}

/// Equations and values that solve them, where the values are known better than the operations tell that lead to them.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    /// Coefficients and right side of each equation, and the unknown that it gives.
    equations: Vec<(Vec<NodeId>, NodeId, Option<usize>)>,
    /// The unknowns.
    values: Vec<NodeId>,
}

impl Graph {
    /// Notes that values solve equations to the rounding of the equations' own terms.
    pub(crate) fn note_solution(&self, equations: &[Equation<'_>], values: &[Expr<'_>]) {
        let ids = |values: &[Expr<'_>]| values.iter().map(|value| value.id()).collect::<Vec<_>>();
        let equations = equations.iter().map(|own| (ids(&own.coefficients), own.right.id(), own.gives)).collect();
        self.arena.borrow_mut().solved.push(Solved { equations, values: ids(values) });
    }

    /// What was noted.
    pub(super) fn noted_solutions(&self) -> Vec<(Vec<Equation<'_>>, Vec<Expr<'_>>)> {
        let all = self.arena.borrow().solved.clone();
        let expressions = |nodes: &[NodeId]| nodes.iter().map(|node| self.expr(*node)).collect::<Vec<_>>();
        let of = |solved: Solved| {
            let equations = solved.equations.iter().map(|(coefficients, right, gives)| Equation {
                coefficients: expressions(coefficients),
                right: self.expr(*right),
                gives: *gives,
            });
            (equations.collect(), expressions(&solved.values))
        };
        all.into_iter().map(of).collect()
    }
}
