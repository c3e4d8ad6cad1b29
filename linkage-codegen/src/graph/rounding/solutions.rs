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

    /// The same with a name and a meaning for how an unknown changes with the right side of an equation.
    pub(crate) fn named(mut self, name: impl Fn(usize, usize) -> (String, String)) -> Self {
        for (unknown, line) in self.reduced.unknowns.iter().zip(&mut self.core) {
            for (factor, equation) in line.iter_mut().zip(&self.reduced.equations) {
                let (name, meaning) = name(*unknown, *equation);
                *factor = factor.named(name, meaning);
            }
        }
        self
    }

    /// The deviations of the unknowns by those of the right sides.
    pub(crate) fn times(&self, right: Vec<Deviation<'g>>) -> Vec<Deviation<'g>> {
        self.times_with(right, |own| own)
    }

    /// The same with what becomes of the right sides of the core.
    fn times_with(
        &self,
        mut right: Vec<Deviation<'g>>,
        in_core: impl FnMut(Deviation<'g>) -> Deviation<'g>,
    ) -> Vec<Deviation<'g>> {
        self.reduced.reduce(&mut right);
        let rows = self.reduced.equations.iter();
        let of_core: Vec<Deviation<'g>> = rows.map(|row| right[*row].clone()).map(in_core).collect();
        let mut values = vec![Deviation::within(self.graph.zero()); right.len()];
        for (unknown, line) in self.reduced.unknowns.iter().zip(&self.core) {
            let parts = line.iter().zip(&of_core).map(|(factor, right)| right.scaled(*factor));
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
    /// The deviations of values that solve linear equations. What is left open of each equation of the core, its rounding, and what its numbers
    /// are off by without a source is a source of errors: the unknowns have shares of it that balance each other.
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
            right.push(deviation.and(open));
            sizes.push(Deviation::within(size));
        }
        let found = inverse.times_with(right, |own| {
            let source = self.source(&format!("equation_{}", self.sources.len() + 1));
            own.shared().plus(&Deviation::of(source, own.rest))
        });
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

#[cfg(test)]
mod tests {
    use super::super::Rounding;
    use crate::graph::number::Number;
    use crate::graph::{Expr, Graph, NodeValues, Scalar, Symbol};
    use crate::model::ids::LoadId;

    /// A sequence of numbers from −1 to 1.
    fn drawn(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss, reason = "53 bits")]
        let value = (*state >> 11) as f64;
        value / 2f64.powi(52) - 1.0
    }

    /// The bound of a value's error and the error; of the values of symbols.
    fn bound_and_error(graph: &Graph, value: Expr<'_>, bound: Expr<'_>, values: &[f64]) -> (f64, f64) {
        let of = |symbol: Symbol| match symbol {
            Symbol::Load(load, part) => values[2 * load.index() + usize::from(part)],
            _ => f64::NAN,
        };
        let exactly = |symbol: Symbol| Number::from_f64(of(symbol)).expect("finite");
        let rounded: f64 = graph.evaluate(value.id(), &of, &mut NodeValues::default());
        let exact: Number = graph.evaluate(value.id(), &exactly, &mut NodeValues::default());
        // Of singular equations a check, which is not among these operations, says that there is no solution.
        let error = Number::from_f64(rounded).map_or(0.0, |rounded| rounded.sub(&exact).to_f64().abs());
        (graph.evaluate(bound.id(), &of, &mut NodeValues::default()), error)
    }

    #[test]
    fn bounds_hold_the_errors_of_solutions() {
        let mut state = 1;
        for size in 2..=6usize {
            // Coefficients and right sides are sums, which have been rounded.
            let graph = Graph::new(Scalar::F64);
            let mut count = 0;
            let mut symbol = || {
                count += 1;
                graph.symbol(Symbol::Load(LoadId::new((count - 1) / 2), u8::from(count % 2 == 0)))
            };
            let mut sum = || symbol() + symbol();
            let rows: Vec<(Vec<Expr<'_>>, Expr<'_>)> =
                (0..size).map(|_| ((0..size).map(|_| sum()).collect(), sum())).collect();
            let solution = if size < 4 { graph.solved(&rows) } else { graph.solved_any(&rows).0 };
            let mut rounding = Rounding::new(&graph);
            let bounds: Vec<Expr<'_>> = solution.iter().map(|value| rounding.bound(*value)).collect();
            let mut ratios = Vec::new();
            for exponent in 0..100 {
                let mut values: Vec<f64> = (0..count).map(|_| drawn(&mut state)).collect();
                // The second equation comes near the first one: to the last bits, in the end.
                let near = 2f64.powi(-exponent / 2);
                for column in 0..2 * size {
                    let second = 2 * (size + 1) + column;
                    values[second] = values[column] + near * values[second];
                }
                for (value, bound) in solution.iter().zip(&bounds) {
                    let (bound, error) = bound_and_error(&graph, *value, *bound, &values);
                    assert!(error <= bound, "{size}: off by {error:e}, bound {bound:e}, at {values:?}");
                    if error > 0.0 {
                        ratios.push(bound / error);
                    }
                }
            }
            ratios.sort_by(f64::total_cmp);
            let median = ratios[ratios.len() / 2];
            assert!(ratios.len() > 50 * size && median < 100.0, "{size}: {median}");
        }
    }

    #[test]
    fn of_nothing_there_is_no_error() {
        let graph = Graph::new(Scalar::F64);
        let symbol = |number: usize| graph.symbol(Symbol::Load(LoadId::new(number), 0));
        let row = |first: usize| vec![symbol(first) + symbol(first + 1), symbol(first + 2) + symbol(first + 3)];
        let rows = [(row(0), symbol(8)), (row(4), symbol(9))];
        let solution = graph.solved(&rows);
        let mut rounding = Rounding::new(&graph);
        let bound = rounding.bound(solution[0]);
        let at = |right: f64, near: f64| {
            let values = [1.0, 0.1, 2.0, 0.3, 1.0, 0.1, 2.0, 0.3 + near, right, right];
            let of = |symbol: Symbol| match symbol {
                Symbol::Load(load, _) => values[load.index()],
                _ => f64::NAN,
            };
            graph.evaluate::<f64>(bound.id(), &of, &mut NodeValues::default())
        };
        assert_eq!(at(0.0, 0.1).to_bits(), 0.0f64.to_bits());
        assert!(at(1.0, 0.1) < 1e-13);
        // Equations that may be singular tell nothing.
        assert_eq!(at(1.0, 1e-16).to_bits(), f64::MAX.to_bits());
    }
}
