//! What emitted code uses beside the elementary functions: clamping, error gaps, and cores of two and three equations.

/// The functions for a scalar; `$single` is the number `$x` in single precision.
///
/// No function pointers: with the table of them that an unoptimised WebAssembly module then has, its linker fails.
macro_rules! support {
    ($scalar:ident, $x:ident => $single:expr) => {
        /// Whether what a pose keeps, which is never NaN, is more than zero. Asked of its bits: the processor need not bring them from memory
        /// into a register of numbers, and where floating point is software no function is called.
        #[inline]
        #[must_use]
        pub fn is_positive(x: $scalar) -> bool {
            x.to_bits().cast_signed() > 0
        }

        /// The value, or zero if it is negative or NaN.
        #[inline]
        #[must_use]
        pub fn non_negative(x: $scalar) -> $scalar {
            if x > 0.0 { x } else { 0.0 }
        }

        /// The lesser of two numbers; the second one if the first is NaN.
        #[inline]
        #[must_use]
        pub fn lesser(x: $scalar, limit: $scalar) -> $scalar {
            if x < limit { x } else { limit }
        }

        /// A gap for an error message: in single precision, at most its largest number.
        #[cold]
        #[must_use]
        #[allow(clippy::cast_possible_truncation, reason = "a diagnostic in single precision")]
        pub fn gap($x: $scalar) -> f32 {
            let single: f32 = $single;
            if single < f32::MAX { single } else { f32::MAX }
        }

        /// `[x, y]` of `a x + b y = e`, `c x + d y = f`, by elimination with the pivots of which the product is larger, `a d` or `c b`.
        ///
        /// So what elimination takes from a coefficient is no larger than that coefficient, however equations and unknowns are scaled: each
        /// equation of a regular pair is solved to a few roundings of its own terms. Of a singular pair the results are not finite.
        #[inline]
        #[must_use]
        pub fn solve_2([[a, b], [c, d]]: [[$scalar; 2]; 2], [e, f]: [$scalar; 2]) -> ($scalar, $scalar) {
            let (a, b, e, c, d, f) =
                if (b * c).abs() > (a * d).abs() { (c, d, f, a, b, e) } else { (a, b, e, c, d, f) };
            let factor = c / a;
            let y = (f - factor * e) / (d - factor * b);
            let x = (e - b * y) / a;
            (x, y)
        }

        /// The solution of three equations, by elimination from the equation with the largest coefficient of the first unknown, and one
        /// step of iterative refinement: as of any number of equations.
        #[inline]
        #[must_use]
        pub fn solve_3(matrix: [[$scalar; 3]; 3], [e, f, g]: [$scalar; 3]) -> ($scalar, $scalar, $scalar) {
            let (x, y, z) = eliminate_3(matrix, [e, f, g]);
            let [[a0, a1, a2], [b0, b1, b2], [c0, c1, c2]] = matrix;
            let open = [e - a0 * x - a1 * y - a2 * z, f - b0 * x - b1 * y - b2 * z, g - c0 * x - c1 * y - c2 * z];
            let (more_x, more_y, more_z) = eliminate_3(matrix, open);
            (x + more_x, y + more_y, z + more_z)
        }

        #[inline]
        fn eliminate_3(
            [[a0, a1, a2], [b0, b1, b2], [c0, c1, c2]]: [[$scalar; 3]; 3],
            [a3, b3, c3]: [$scalar; 3],
        ) -> ($scalar, $scalar, $scalar) {
            let (mut first, mut second, mut third) = ((a0, a1, a2, a3), (b0, b1, b2, b3), (c0, c1, c2, c3));
            if second.0.abs() > first.0.abs() {
                (first, second) = (second, first);
            }
            if third.0.abs() > first.0.abs() {
                (first, third) = (third, first);
            }
            let p = second.0 / first.0;
            let (p1, p2, p3) = (second.1 - p * first.1, second.2 - p * first.2, second.3 - p * first.3);
            let q = third.0 / first.0;
            let (q1, q2, q3) = (third.1 - q * first.1, third.2 - q * first.2, third.3 - q * first.3);
            let (y, z) = solve_2([[p1, p2], [q1, q2]], [p3, q3]);
            let x = (first.3 - first.1 * y - first.2 * z) / first.0;
            (x, y, z)
        }
    };
}
pub(crate) use support;

#[cfg(test)]
mod tests {
    use crate::__private::f64::{gap, is_positive, lesser, non_negative, solve_2, solve_3};

    #[test]
    fn small_systems_are_pivoted() {
        // Without an exchange of rows the first of each would divide by zero.
        assert_eq!(solve_2([[0.0, 2.0], [4.0, 1.0]], [6.0, 11.0]), (2.0, 3.0));
        // With the larger of the first coefficients the first equation would have its terms' sum as 1.
        let small = 2f64.powi(-60);
        assert_eq!(solve_2([[1.0, small], [2.0, 2.0]], [2.0, 2.0 / small]), (1.0, 1.0 / small));
        let (x, y, z) = solve_3([[0.0, 1.0, 1.0], [0.0, 2.0, -1.0], [5.0, 1.0, 0.0]], [5.0, 1.0, 7.0]);
        assert_eq!((x, y, z), (1.0, 2.0, 3.0));
    }

    #[test]
    fn what_is_positive_is_told_by_its_bits() {
        for x in [5e-324, f64::MIN_POSITIVE, 1.0, f64::MAX] {
            assert!(is_positive(x) && !is_positive(-x), "{x:e}");
        }
        assert!(!is_positive(0.0) && !is_positive(-0.0));
        let single = crate::__private::f32::is_positive;
        assert!(single(1e-45) && single(f32::MAX) && ![0.0, -0.0, -1e-45, f32::MIN].map(single).contains(&true));
    }

    #[test]
    fn clamps_and_gaps() {
        assert_eq!(non_negative(-1.0).to_bits(), 0.0f64.to_bits());
        assert_eq!(non_negative(f64::NAN).to_bits(), 0.0f64.to_bits());
        let lesser = [lesser(1.0, 2.0), lesser(3.0, 2.0), lesser(f64::NAN, 2.0)];
        assert_eq!(lesser.map(f64::to_bits), [1.0f64, 2.0, 2.0].map(f64::to_bits));
        assert_eq!(
            [gap(1e300), gap(f64::NAN), gap(2.0)].map(f32::to_bits),
            [f32::MAX, f32::MAX, 2.0].map(f32::to_bits)
        );
    }
}
