//! How far the solutions of linear equations are off.
//!
//! What the computed unknowns x leave open of `A x = b` is known: `ρ = b − A x`, to its own rounding. With the deviations A' and b' of the
//! numbers, which come with those of the pose and the loads, the unknowns are off by
//!
//! ```text
//! x' = A⁻¹ (b' − A' x − ρ + A' x')
//! ```
//!
//! so shares keep their signs. The last term is of second order. With bounds E of A' and any sizes a of the equations, as those of their
//! coefficients, `|A'||x'| ≤ a C/(1 − q)` where C = max (E T)/a for the bounds T that are known without it, and q = max (E |A⁻¹| a)/a; here
//! sums stand for these largest ones. Where q is not less than 1, A may be singular, and nothing is known: infinite.

use super::super::elimination::{Equation, Linear, Reduced};
use super::super::number::Number;
use super::super::{Expr, Graph, Kernel};
use super::{Deviation, Rounding};

impl<'g> Linear<'g> for Deviation<'g> {
    fn over(&self, pivot: Expr<'g>) -> Self {
        self.scaled(pivot.graph().one() / pivot)
    }
    fn less(&self, factor: Expr<'g>, other: &Self) -> Self {
        self.clone().plus(&other.scaled(-factor))
    }
}

/// The inverse of the matrix of linear equations, by which it is known how an error of a right side goes through their solution.
pub(crate) struct Inverse<'g> {
    graph: &'g Graph,
    reduced: Reduced<'g>,
    /// That of the core, row by row.
    core: Vec<Vec<Expr<'g>>>,
}

impl<'g> Inverse<'g> {
    /// Of some equations; nothing is read of their right sides.
    pub(crate) fn of(graph: &'g Graph, equations: &[Equation<'g>]) -> Self {
        let reduced = Reduced::of(equations);
        let core = inverse(graph, &reduced.core);
        Self { graph, reduced, core }
    }

    /// The deviations of the unknowns by those of the right sides.
    pub(crate) fn times(&self, mut right: Vec<Deviation<'g>>) -> Vec<Deviation<'g>> {
        self.reduced.reduce(&mut right);
        let mut values = vec![Deviation::within(self.graph.zero()); right.len()];
        for (unknown, line) in self.reduced.unknowns.iter().zip(&self.core) {
            let parts = line.iter().zip(&self.reduced.equations).map(|(factor, row)| right[*row].scaled(*factor));
            values[*unknown] = parts.fold(values[*unknown].clone(), |sum, part| sum.plus(&part));
        }
        self.reduced.completed(&right, values)
    }

    /// Deviations of the unknowns, and what is not linear in them: at most so much on the right side of each equation if the unknowns
    /// were off by twice as much.
    pub(crate) fn and_beyond(
        &self,
        found: Vec<Deviation<'g>>,
        beyond: impl Fn(&[Expr<'g>]) -> Vec<Expr<'g>>,
    ) -> Vec<Deviation<'g>> {
        let twice: Vec<Expr<'g>> = found.iter().map(|deviation| 2 * deviation.total()).collect();
        let more = self.times(beyond(&twice).into_iter().map(Deviation::within).collect());
        let one = self.graph.one();
        let half = self.graph.constant(&Number::ratio(1, 2));
        let known = more.iter().zip(&twice).filter(|(more, _)| !more.is_zero());
        let known = known.fold(one, |known, (more, twice)| known * (one - one.where_above(more.rest, half * *twice)));
        found.into_iter().zip(more).map(|(found, more)| found.and(more.rest / known)).collect()
    }
}

/// The inverse of a matrix, row by row.
fn inverse<'g>(graph: &'g Graph, matrix: &[Vec<Expr<'g>>]) -> Vec<Vec<Expr<'g>>> {
    match matrix {
        [] => Vec::new(),
        [row] => vec![vec![graph.one() / row[0]]],
        [a, b] => {
            let determinant = a[0] * b[1] - a[1] * b[0];
            let over = |value: Expr<'g>| value / determinant;
            vec![vec![over(b[1]), over(-a[1])], vec![over(-b[0]), over(a[0])]]
        }
        _ => {
            let size = matrix.len();
            let coefficients: Vec<Expr<'g>> = matrix.iter().flatten().copied().collect();
            let sizes = coefficients.iter().map(|coefficient| coefficient.abs());
            let (kernel, before) = match u8::try_from(size) {
                Ok(3) | Err(_) => (Kernel::Solve3, coefficients),
                Ok(size) => (Kernel::Solve(size), coefficients.iter().copied().chain(sizes).collect()),
            };
            let part = |row: usize, column: usize| {
                let unit = (0..size).map(|line| if line == column { graph.one() } else { graph.zero() });
                let args: Vec<Expr<'g>> = before.iter().copied().chain(unit).collect();
                graph.kernel(kernel, &args, u8::try_from(row).unwrap_or(u8::MAX))
            };
            (0..size).map(|row| (0..size).map(|column| part(row, column)).collect()).collect()
        }
    }
}

impl<'g> Rounding<'g> {
    /// The deviations of values that solve linear equations. What is left open of each equation, its rounding, and what its numbers are off
    /// by without a source is a source of errors: the unknowns have shares of it that balance each other.
    pub(super) fn of_solution(&mut self, equations: &[Equation<'g>], values: &[Expr<'g>]) -> Vec<Deviation<'g>> {
        let graph = self.graph;
        let inverse = Inverse::of(graph, equations);
        // Bounds of the coefficients' errors, in the columns of their unknowns; of those in one equation over the size of its coefficients.
        let mut uncertain = vec![graph.zero(); values.len()];
        let (mut right, mut sizes) = (Vec::new(), Vec::new());
        for equation in equations {
            let products = equation.products(values);
            let mut deviation = self.deviation(equation.right.id());
            let mut terms = equation.right.abs();
            let size = products.iter().fold(graph.zero(), |sum, (_, (coefficient, _))| sum + coefficient.abs());
            for (column, (coefficient, value)) in &products {
                let own = self.deviation(coefficient.id());
                deviation = deviation.less(*value, &own);
                uncertain[*column] = uncertain[*column] + own.total() / size;
                terms = terms + (*coefficient * *value).abs();
            }
            let roundings = i64::try_from(products.len() + 1).unwrap_or(i64::MAX);
            let open = equation.left_open(values).abs() + roundings * self.rounded(terms);
            let rest = deviation.rest + open;
            let source = self.source(&format!("equation_{}", self.sources.len() + 1));
            right.push(deviation.shared().plus(&Deviation::of(source, rest)));
            sizes.push(Deviation::within(size));
        }
        let found = inverse.times(right);
        if uncertain.iter().all(|error| error.is_zero()) {
            return found;
        }
        let reach: Vec<Expr<'g>> = inverse.times(sizes).into_iter().map(|reach| reach.rest).collect();
        let sum = |factors: &mut dyn Iterator<Item = Expr<'g>>| {
            uncertain.iter().zip(factors).fold(graph.zero(), |sum, (error, factor)| sum + *error * factor)
        };
        let beyond = sum(&mut found.iter().map(Deviation::total));
        let left = graph.one() - sum(&mut reach.iter().copied());
        let beyond = beyond / left.where_above(left, graph.zero());
        found.into_iter().zip(reach).map(|(found, reach)| found.and(reach * beyond)).collect()
    }
}
