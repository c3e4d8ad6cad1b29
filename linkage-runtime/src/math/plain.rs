//! Sine and cosine in sums and products that are rounded one by one.

/// Needs `FAST`, up to where the short reduction serves, `FRAC_PI_2` in three parts, `ROUND`, `UNMARKED`, `SINE` and `COSINE`, the coefficients of S
/// and C, `polynomial`, which adds such up, and on x86-64 `short`, `short_half` and `of`.
macro_rules! plain_sines {
    ($scalar:ident, $bits:ident) => {
        use super::large::{reduce_large, reduce_large_sum};

        /// An angle of `quadrant`·π/2 + (y − t), with |y| ≤ π/4 and a tail t of about an ulp of y, or
        /// ε/64, in single precision ε/8, at most.
        pub(super) struct Reduced {
            pub(super) quadrant: $bits,
            pub(super) y: $scalar,
            pub(super) t: $scalar,
        }

        sines! {
            $scalar, one_by_one;
            /// (sin x, cos x).
            ///
            /// Reduction with π/2 in three parts and a tail (Cody and Waite 1980, Ng 1992) up to 65 000 turns, in single precision 64, without a
            /// branch; beyond, out of line, the exact product with 2/π in integers (Payne and Hanek 1983). Then sin y = y − y³S(y²) and
            /// cos y = 1 − y²/2 + y⁴C(y²), with six coefficients each, in single precision three, found by Remez exchange.
            ///
            /// Error: at most 0.95 ulp for every finite x, next to multiples of π/2 too. sin(−0) = −0. NaN if x is not finite.
            sin_cos,
            /// (sin x/2, cos x/2): the bits of [`sin_cos`] of `0.5 * x`, whose product the quadrant does not wait for.
            sin_cos_half,
            /// (sin, cos) of the real number x + hi + lo, which is not rounded before the reduction.
            ///
            /// For a constant hi + lo in two parts, such as a phase: |hi| ≤ 4, |lo| ≤ ulp(hi). The rounding error of x + hi (Knuth's
            /// two-sum) goes into the tail of the reduction.
            ///
            /// Error: at most 0.95 ulp plus ε²·max(4, |x|). The second part is below 0.05 ulp wherever the result exceeds
            /// 45 ε·max(4, |x|); next to a multiple of π/2 it is of the size of what lo itself lacks. NaN if an argument is not
            /// finite.
            sin_cos_sum,
        }
        #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
        one_by_one!($scalar, one_by_one);
        short_angles!($scalar, $bits);
        short_sines!($scalar, one_by_one);

        /// a + b as a rounded sum and its error, exactly.
        #[inline]
        pub(super) fn two_sum(a: $scalar, b: $scalar) -> ($scalar, $scalar) {
            let sum = a + b;
            let b_in_sum = sum - a;
            (sum, (a - (sum - b_in_sum)) + (b - b_in_sum))
        }

        /// How many quadrants an angle has, of so many for each radian, rounded in the last bits of a number.
        #[inline]
        fn rounded(x: $scalar, per_radian: $scalar) -> $scalar {
            x * per_radian + ROUND
        }

        /// The angle without its quadrants, whose number is known, rounded in the last bits of a number: for |x| up to `FAST`. Nothing is lost but by
        /// the last product and the last difference, which act on the tail.
        #[inline]
        fn reduced(x: $scalar, rounded: $scalar) -> Reduced {
            let n = rounded - ROUND;
            let x1 = x - n * FRAC_PI_2[0];
            let w = n * FRAC_PI_2[1];
            let y = x1 - w;
            let t = n * FRAC_PI_2[2] - ((x1 - y) - w);
            Reduced { quadrant: rounded.to_bits(), y, t }
        }

        impl Reduced {
            /// The angle plus a small one.
            #[inline]
            pub(super) fn plus(self, small: $scalar) -> Self {
                let Self { quadrant, y, t } = self;
                let t = t - small;
                let sum = y - t;
                Self { quadrant, y: sum, t: t - (y - sum) }
            }

            /// The polynomials, exchanged and negated as the quadrant says. Every sum is arranged so that −0 stays −0.
            #[inline]
            fn one_by_one(self) -> ($scalar, $scalar) {
                let Self { quadrant, y, t } = self;
                let z = y * y;
                let half = 0.5 * z;
                let w = 1.0 - half;
                let (s, c) = (polynomial(z, &SINE), polynomial(z, &COSINE));
                let sin = y - (z * y * s + t * w);
                let cos = w + (z * z * c + (((1.0 - w) - half) + y * t));
                by_quadrant(quadrant, sin, cos)
            }
        }

        by_quadrant!($scalar, $bits);
    };
}
pub(super) use plain_sines;
