//! Linear equations of any number: the arithmetic of the run-time crate, operation by operation, for any number type.

use super::real::Real;
use super::{Expr, Graph, Kernel};

impl Graph {
    /// The solution of linear equations, and their distance from singular ones: the smallest pivot over its size.
    pub fn solved_any<'g>(&'g self, equations: &[(Vec<Expr<'g>>, Expr<'g>)]) -> (Vec<Expr<'g>>, Expr<'g>) {
        let rows = equations.iter().map(|(row, _)| row);
        let mut args: Vec<Expr<'g>> = rows.clone().flatten().copied().collect();
        args.extend(rows.flatten().map(|coefficient| coefficient.magnitude()));
        args.extend(equations.iter().map(|(_, right)| *right));
        let size = u8::try_from(equations.len()).unwrap_or(u8::MAX);
        let part = |part| self.kernel(Kernel::Solve(size), &args, part);
        ((0..size).map(part).collect(), part(size))
    }
}

/// An equation during elimination, and after it.
#[derive(Clone)]
struct Line<T> {
    /// What is left of the coefficients: of a pivot's line its row of `U` from the diagonal on.
    coefficients: Vec<T>,
    /// For each of them the sum of the magnitudes that make it up.
    sizes: Vec<T>,
    /// With which the lines before it were taken away: its row of `L` up to the diagonal.
    factors: Vec<T>,
    scale: T,
    number: usize,
}

impl<T: Real> Line<T> {
    fn weight(&self) -> Option<T> {
        // Zero over zero is no weight.
        self.scale.above(&T::zero()).then(|| self.coefficients[0].abs().div(&self.scale))
    }

    fn reduce(&mut self, pivot: &Self) {
        let factor = self.coefficients[0].div(&pivot.coefficients[0]);
        let less = |(own, other): (&T, &T)| own.sub(&factor.mul(other));
        self.coefficients = self.coefficients.iter().zip(&pivot.coefficients).skip(1).map(less).collect();
        let divisor = pivot.coefficients[0].abs();
        let (of_own, of_pivot) = (self.sizes[0].div(&divisor), pivot.sizes[0].div(&divisor));
        let (factor_size, value_size) = (factor.abs(), of_own.add(&factor.abs().mul(&of_pivot)));
        let more =
            |(own, (size, value)): (&T, (&T, &T))| own.add(&factor_size.mul(size)).add(&value_size.mul(&value.abs()));
        let others = pivot.sizes.iter().zip(&pivot.coefficients);
        self.sizes = self.sizes.iter().zip(others).skip(1).map(more).collect();
        self.factors.push(factor);
    }
}

/// A matrix as the product of triangular ones, as `Factors` of the run-time crate.
pub(super) struct Factors<T> {
    lines: Vec<Line<T>>,
    distance: T,
}

impl<T: Real> Factors<T> {
    /// Eliminates. `None` where a pivot is zero: by scalars that would give what is not a number.
    pub(super) fn of(matrix: &[Vec<T>], sizes: &[Vec<T>]) -> Option<Self> {
        let line = |(number, (coefficients, sizes)): (usize, (&Vec<T>, &Vec<T>))| {
            let scale = coefficients.iter().fold(T::zero(), |m, c| if c.abs().above(&m) { c.abs() } else { m });
            Line { coefficients: coefficients.clone(), sizes: sizes.clone(), factors: Vec::new(), scale, number }
        };
        let mut lines: Vec<Line<T>> = matrix.iter().zip(sizes).enumerate().map(line).collect();
        let (mut least, mut negative): (Option<T>, bool) = (None, false);
        for step in 0..lines.len() {
            let (done, others) = lines.split_at_mut(step + 1);
            let pivot = &mut done[step];
            for line in others.iter_mut() {
                if let (Some(own), Some(best)) = (line.weight(), pivot.weight())
                    && own.above(&best)
                {
                    core::mem::swap(line, pivot);
                    negative = !negative;
                }
            }
            let value = pivot.coefficients[0].clone();
            if T::zero().above(&value) {
                negative = !negative;
            }
            if !value.abs().above(&T::zero()) {
                return None;
            }
            let distance = value.abs().div(&pivot.sizes[0]);
            least = match least {
                Some(least) if distance.at_least(&least) => Some(least),
                _ => Some(distance),
            };
            for line in others {
                line.reduce(pivot);
            }
        }
        let least = least?;
        Some(Self { lines, distance: if negative { least.neg() } else { least } })
    }

    /// The smallest pivot over its size, with the sign of the determinant.
    pub(super) fn distance(&self) -> T {
        self.distance.clone()
    }

    /// `x` of `A x = b`.
    pub(super) fn solve(&self, right: &[T]) -> Vec<T> {
        let mut values: Vec<T> = Vec::new();
        for line in &self.lines {
            values.push(right[line.number].less_products(&line.factors, &values));
        }
        for (index, line) in self.lines.iter().enumerate().rev() {
            let sum = values[index].less_products(&line.coefficients[1..], &values[index + 1..]);
            values[index] = sum.div(&line.coefficients[0]);
        }
        values
    }
}

/// The solution of linear equations, refined, and how far they are from singular. `None` where a pivot is zero.
pub(super) fn solve<T: Real>(matrix: &[Vec<T>], sizes: &[Vec<T>], right: &[T]) -> Option<(Vec<T>, T)> {
    let factors = Factors::of(matrix, sizes)?;
    let solution = factors.solve(right);
    let open: Vec<T> = matrix.iter().zip(right).map(|(line, right)| right.less_products(line, &solution)).collect();
    let refined = solution.iter().zip(factors.solve(&open)).map(|(value, more)| value.add(&more));
    Some((refined.collect(), factors.distance()))
}
