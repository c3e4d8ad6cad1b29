//! Linear equations of any number.

/// The functions for a scalar.
///
/// Slices are walked by patterns: neither an index nor an iterator, which keep a way to panic in unoptimised builds.
macro_rules! linear {
    ($scalar:ident) => {
        /// An equation during elimination, and after it.
        ///
        /// A step takes the first coefficient away: what is left moves to the front, and the factor that did it is kept at the end.
        #[derive(Clone, Copy)]
        struct Line<const N: usize> {
            /// Of a pivot's line its row of `U` from the diagonal on, then its row of `L` up to the diagonal.
            coefficients: [$scalar; N],
            /// For each coefficient that is left the sum of the magnitudes that make it up.
            sizes: [$scalar; N],
            /// The largest coefficient that it began with.
            scale: $scalar,
            /// Which equation it is.
            number: usize,
        }

        impl<const N: usize> Line<N> {
            const EMPTY: Self = Self { coefficients: [0.0; N], sizes: [0.0; N], scale: 0.0, number: 0 };

            fn of(coefficients: [$scalar; N], sizes: [$scalar; N], number: usize) -> Self {
                let (mut scale, mut rest) = (0.0, coefficients.as_slice());
                while let [value, others @ ..] = rest {
                    if value.abs() > scale {
                        scale = value.abs();
                    }
                    rest = others;
                }
                Self { coefficients, sizes, scale, number }
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

            /// Takes the first of so many unknowns out by means of another equation.
            fn reduce(&mut self, pivot: &Self, unknowns: usize) {
                let (first, first_size) = self.first();
                let factor = first / pivot.first().0;
                let (mut own, mut other, mut left) =
                    (self.coefficients.as_mut_slice(), pivot.coefficients.as_slice(), unknowns);
                while let ([here, own_rest @ ..], [_, other_rest @ ..]) = (own, other) {
                    left = left.saturating_sub(1);
                    *here = match (&*own_rest, other_rest) {
                        ([next, ..], [value, ..]) if left > 0 => *next - factor * *value,
                        ([next, ..], _) => *next,
                        ([], _) => factor,
                    };
                    (own, other) = (own_rest, other_rest);
                }
                // What the terms of all that goes into a coefficient contribute to it: also to one that was zero.
                let (of_own, of_pivot) = (first_size / pivot.first().0.abs(), pivot.first().1 / pivot.first().0.abs());
                let (factor_size, value_size) = (factor.abs(), of_own + factor.abs() * of_pivot);
                let (mut own, mut other) =
                    (self.sizes.as_mut_slice(), (pivot.sizes.as_slice(), pivot.coefficients.as_slice()));
                while let ([here, own_rest @ ..], ([_, sizes @ ..], [_, values @ ..])) = (own, other) {
                    if let ([next, ..], [size, ..], [value, ..]) = (&*own_rest, sizes, values) {
                        *here = *next + factor_size * *size + value_size * value.abs();
                    }
                    (own, other) = (own_rest, (sizes, values));
                }
            }
        }

        /// A matrix as the product of triangular ones, by elimination with row-scaled partial pivoting. It serves any number of right
        /// sides.
        ///
        /// N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2002, chapter 9.
        #[derive(Clone, Copy)]
        pub struct Factors<const N: usize> {
            /// The equations in the order in which they became pivots.
            lines: [Line<N>; N],
            distance: $scalar,
        }

        impl<const N: usize> Factors<N> {
            /// Eliminates. `sizes` has for each coefficient the sum of the magnitudes that make it up.
            #[must_use]
            #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "a NaN counts as singular")]
            pub fn of(matrix: [[$scalar; N]; N], sizes: [[$scalar; N]; N]) -> Self {
                let mut lines = [Line::EMPTY; N];
                let mut number = 0usize;
                let mut into = (lines.as_mut_slice(), matrix.as_slice(), sizes.as_slice());
                while let ([line, lines @ ..], [row, rows @ ..], [size, sizes @ ..]) = into {
                    *line = Line::of(*row, *size, number);
                    number = number.wrapping_add(1);
                    into = (lines, rows, sizes);
                }
                let (mut least, mut sign) = ($scalar::MAX, 1.0);
                let (mut open, mut unknowns) = (lines.as_mut_slice(), N);
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
                        line.reduce(pivot, unknowns);
                        rest = more;
                    }
                    (open, unknowns) = (others, unknowns.wrapping_sub(1));
                }
                Self { lines, distance: sign * least }
            }

            /// How far it is from singular: the smallest pivot over the sum of the magnitudes that make it up, with the sign of the
            /// determinant. A pivot that is no more than a few roundings of its size may be nothing but rounding.
            #[must_use]
            pub fn distance(&self) -> $scalar {
                self.distance
            }

            /// `x` of `A x = b`. Of singular equations it is not finite.
            #[must_use]
            pub fn solve(&self, right: [$scalar; N]) -> [$scalar; N] {
                let mut values = [0.0; N];
                // L y = P b: each line has one factor more than the line before.
                let mut open = self.lines.as_slice();
                while let [line, below @ ..] = open {
                    let (mut factors, mut upper) = (line.coefficients.as_slice(), open);
                    while let ([_, factors_rest @ ..], [_, upper_rest @ ..]) = (factors, upper) {
                        (factors, upper) = (factors_rest, upper_rest);
                    }
                    let (mut value, mut found) = (numbered(&right, line.number), values.as_mut_slice());
                    while let [factor, factors_rest @ ..] = factors {
                        if let [other, ..] = found {
                            value -= *factor * *other;
                        }
                        (factors, found) = (factors_rest, behind_first(found));
                    }
                    if let [here, ..] = found {
                        *here = value;
                    }
                    open = below;
                }
                // U x = y: the last one first.
                let mut open = self.lines.as_slice();
                while let [above @ .., line] = open {
                    let (mut skipped, mut found) = (above, values.as_mut_slice());
                    while let [_, skipped_rest @ ..] = skipped {
                        (skipped, found) = (skipped_rest, behind_first(found));
                    }
                    if let ([value, behind @ ..], [pivot, coefficients @ ..]) = (found, line.coefficients.as_slice()) {
                        let (mut behind, mut coefficients) = (&*behind, coefficients);
                        while let ([other, behind_rest @ ..], [coefficient, coefficients_rest @ ..]) =
                            (behind, coefficients)
                        {
                            *value -= *coefficient * *other;
                            (behind, coefficients) = (behind_rest, coefficients_rest);
                        }
                        *value /= *pivot;
                    }
                    open = above;
                }
                values
            }
        }

        /// All but the first.
        fn behind_first(values: &mut [$scalar]) -> &mut [$scalar] {
            match values {
                [_, rest @ ..] => rest,
                [] => &mut [],
            }
        }

        /// The value of this number.
        fn numbered(values: &[$scalar], number: usize) -> $scalar {
            let (mut rest, mut number) = (values, number);
            while let [value, others @ ..] = rest {
                if number == 0 {
                    return *value;
                }
                (rest, number) = (others, number.wrapping_sub(1));
            }
            0.0
        }

        /// The solution of linear equations, and how far they are from singular; as [`Factors`] say.
        ///
        /// One step of iterative refinement leaves of each equation what rounding makes of its own terms, a few `ε Σ|a x|`; elimination
        /// alone leaves what it makes of the terms of all.
        ///
        /// R. D. Skeel, Iterative Refinement Implies Numerical Stability for Gaussian Elimination, 1980.
        #[must_use]
        pub fn solve<const N: usize>(
            matrix: [[$scalar; N]; N],
            sizes: [[$scalar; N]; N],
            right: [$scalar; N],
        ) -> ([$scalar; N], $scalar) {
            let factors = Factors::of(matrix, sizes);
            let mut solution = factors.solve(right);
            let correction = factors.solve(left_open(&matrix, &solution, right));
            let mut rest = (solution.as_mut_slice(), correction.as_slice());
            while let ([value, values @ ..], [more, others @ ..]) = rest {
                *value += *more;
                rest = (values, others);
            }
            (solution, factors.distance())
        }

        /// `b − A x`
        fn left_open<const N: usize>(
            matrix: &[[$scalar; N]; N],
            solution: &[$scalar; N],
            mut right: [$scalar; N],
        ) -> [$scalar; N] {
            let (mut lines, mut open) = (matrix.as_slice(), right.as_mut_slice());
            while let ([line, others @ ..], [sum, sums @ ..]) = (lines, open) {
                let mut rest = (line.as_slice(), solution.as_slice());
                while let ([coefficient, coefficients @ ..], [value, values @ ..]) = rest {
                    *sum -= *coefficient * *value;
                    rest = (coefficients, values);
                }
                (lines, open) = (others, sums);
            }
            right
        }
    };
}
pub(crate) use linear;

#[cfg(test)]
mod tests {
    use crate::__private::f64::{Factors, solve};

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

    #[test]
    fn a_coefficient_is_as_uncertain_as_what_eliminated_it() {
        // The first coefficient of the second equation is a difference of terms as large as the others', and nothing but their rounding.
        let matrix = [[1.0, 1.0, 0.0], [1e-16, 0.0, 1.0], [0.0, 0.0, 1.0]];
        let sizes = [[1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
        assert!(solve(matrix, sizes, [1.0; 3]).1.abs() < 1e-15);
        // Where that is all there is, a small one is as good as any.
        assert!(solve(matrix, matrix, [1.0; 3]).1.abs() > 0.1);
    }

    #[test]
    fn factors_serve_any_right_side() {
        // Pivots come from other lines than their own.
        let matrix = [
            [0.0, 2.0, 1.0, 0.0, 4.0],
            [1.0, 0.0, 0.0, 3.0, -1.0],
            [0.0, 0.0, 5.0, 1.0, 2.0],
            [8.0, 1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 2.0, -3.0],
        ];
        let factors = Factors::of(matrix, matrix.map(|row| row.map(f64::abs)));
        for unknown in 0..5 {
            let mut wanted = [0.0; 5];
            wanted[unknown] = 3.0;
            let near = |found: [f64; 5]| found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-14);
            assert!(near(factors.solve(matrix.map(|row| 3.0 * row[unknown]))));
        }
    }
}
