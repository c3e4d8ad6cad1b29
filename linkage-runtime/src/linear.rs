//! Linear equations of any number.

/// The functions for a scalar.
///
/// Slices are walked by patterns: neither an index nor an iterator, which keep a way to panic in unoptimised builds.
macro_rules! linear {
    ($scalar:ident) => {
        /// An equation during elimination. Every step takes its first coefficient away: what is left moves to the front.
        #[derive(Clone, Copy)]
        struct Line<const N: usize> {
            coefficients: [$scalar; N],
            /// For each coefficient the sum of the magnitudes that make it up.
            sizes: [$scalar; N],
            right: $scalar,
            /// The largest coefficient that it began with.
            scale: $scalar,
        }

        impl<const N: usize> Line<N> {
            const EMPTY: Self = Self { coefficients: [0.0; N], sizes: [0.0; N], right: 0.0, scale: 0.0 };

            fn of(coefficients: [$scalar; N], sizes: [$scalar; N], right: $scalar) -> Self {
                let (mut scale, mut rest) = (0.0, coefficients.as_slice());
                while let [value, others @ ..] = rest {
                    if value.abs() > scale {
                        scale = value.abs();
                    }
                    rest = others;
                }
                Self { coefficients, sizes, right, scale }
            }

            /// The first coefficient, and its size.
            fn first(&self) -> ($scalar, $scalar) {
                match (self.coefficients.as_slice(), self.sizes.as_slice()) {
                    ([first, ..], [size, ..]) => (*first, *size),
                    _ => (0.0, 0.0),
                }
            }

            /// The first coefficient, as it counts in the choice of a pivot.
            fn weight(&self) -> $scalar {
                self.first().0.abs() / self.scale
            }

            /// Takes the first unknown out by means of another equation.
            fn reduce(&mut self, pivot: &Self) {
                let factor = self.first().0 / pivot.first().0;
                let (mut own, mut other) = (self.coefficients.as_mut_slice(), pivot.coefficients.as_slice());
                while let ([here, own_rest @ ..], [_, other_rest @ ..]) = (own, other) {
                    if let ([next, ..], [value, ..]) = (&*own_rest, other_rest) {
                        *here = *next - factor * *value;
                    }
                    (own, other) = (own_rest, other_rest);
                }
                let factor_size = factor.abs();
                let (mut own, mut other) = (self.sizes.as_mut_slice(), pivot.sizes.as_slice());
                while let ([here, own_rest @ ..], [_, other_rest @ ..]) = (own, other) {
                    if let ([next, ..], [value, ..]) = (&*own_rest, other_rest) {
                        *here = *next + factor_size * *value;
                    }
                    (own, other) = (own_rest, other_rest);
                }
                self.right -= factor * pivot.right;
            }

            /// The first unknown, from those behind it.
            fn solved(&self, behind: &[$scalar; N]) -> $scalar {
                let mut sum = self.right;
                if let [_, coefficients @ ..] = self.coefficients.as_slice() {
                    let (mut coefficients, mut behind) = (coefficients, behind.as_slice());
                    while let ([coefficient, more @ ..], [value, further @ ..]) = (coefficients, behind) {
                        sum -= *coefficient * *value;
                        (coefficients, behind) = (more, further);
                    }
                }
                sum / self.first().0
            }
        }

        /// The solution of linear equations, by elimination with row-scaled partial pivoting; and how far they are from singular: the
        /// smallest pivot over the sum of the magnitudes that make it up, with the sign of the determinant.
        ///
        /// `sizes` has for each coefficient the sum of the magnitudes that make it up. A pivot that is no more than a few roundings of
        /// its size may be nothing but rounding. Of singular equations the results are not finite.
        #[must_use]
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "a NaN counts as singular")]
        pub fn solve<const N: usize>(
            matrix: [[$scalar; N]; N],
            sizes: [[$scalar; N]; N],
            right: [$scalar; N],
        ) -> ([$scalar; N], $scalar) {
            let mut lines = [Line::EMPTY; N];
            let mut into = (lines.as_mut_slice(), matrix.as_slice(), sizes.as_slice(), right.as_slice());
            while let ([line, lines @ ..], [row, rows @ ..], [size, sizes @ ..], [value, values @ ..]) = into {
                *line = Line::of(*row, *size, *value);
                into = (lines, rows, sizes, values);
            }
            let (mut least, mut sign) = ($scalar::MAX, 1.0);
            let mut open = lines.as_mut_slice();
            while let [pivot, others @ ..] = open {
                let mut rest = &mut *others;
                while let [line, more @ ..] = rest {
                    if line.weight() > pivot.weight() {
                        (*line, *pivot) = (*pivot, *line);
                        sign = -sign;
                    }
                    rest = more;
                }
                let (value, size) = pivot.first();
                if value < 0.0 {
                    sign = -sign;
                }
                let distance = value.abs() / size;
                // Written so that a NaN, which a pivot of zero makes of all that follows, is the last word.
                if !(distance >= least) {
                    least = distance;
                }
                let mut rest = &mut *others;
                while let [line, more @ ..] = rest {
                    line.reduce(pivot);
                    rest = more;
                }
                open = others;
            }
            let mut solution = [0.0; N];
            let mut open = lines.as_slice();
            while let [before @ .., line] = open {
                let mut value = line.solved(&solution);
                // The solution so far moves back by one.
                let mut rest = solution.as_mut_slice();
                while let [here, more @ ..] = rest {
                    (*here, value) = (value, *here);
                    rest = more;
                }
                open = before;
            }
            (solution, sign * least)
        }
    };
}
pub(crate) use linear;

#[cfg(test)]
mod tests {
    use crate::__private::f64::solve;

    #[test]
    fn equations_are_pivoted() {
        let matrix = [[0.0, 1.0, 1.0, 0.0], [0.0, 2.0, -1.0, 0.0], [5.0, 1.0, 0.0, 1.0], [0.0, 0.0, 0.0, 2.0]];
        let (solution, distance) = solve(matrix, matrix.map(|row| row.map(f64::abs)), [5.0, 1.0, 11.0, 8.0]);
        assert_eq!(solution.map(f64::to_bits), [1.0f64, 2.0, 3.0, 4.0].map(f64::to_bits));
        // The determinant is −30.
        assert!(distance < -0.1, "{distance}");
    }

    #[test]
    fn singular_equations_are_no_farther_from_singular_than_rounding() {
        let matrix = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];
        assert!(solve(matrix, matrix, [1.0, 1.0, 0.0]).1.abs() < 1e-15);
        let nothing = [[0.0; 3]; 3];
        assert!(!solve(nothing, nothing, [1.0; 3]).1.is_finite());
    }
}
