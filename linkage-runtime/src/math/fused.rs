//! The product that is added without being rounded: `fusedMultiplyAdd` of IEEE 754, the same bits everywhere. Fast where the processor has it
//! and the program is compiled for that; elsewhere it is put together from many operations.

#[cfg(not(feature = "std"))]
mod foreign {
    #![allow(unsafe_code, reason = "`core` has no fused operation; both functions are total and free of side effects")]

    unsafe extern "C" {
        pub(super) safe fn fma(a: f64, b: f64, c: f64) -> f64;
        pub(super) safe fn fmaf(a: f32, b: f32, c: f32) -> f32;
    }
}

/// a·b + c, rounded once.
#[inline]
#[must_use]
pub fn mul_add(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(feature = "std")]
    return a.mul_add(b, c);
    #[cfg(not(feature = "std"))]
    return foreign::fma(a, b, c);
}

/// a·b + c, rounded once.
#[inline]
#[must_use]
pub fn mul_addf(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(feature = "std")]
    return a.mul_add(b, c);
    #[cfg(not(feature = "std"))]
    return foreign::fmaf(a, b, c);
}

/// Sine and cosine in fused operations, for `arithmetic fused;`: the coefficients of `sin_cos`, a shorter reduction, and bits of their own,
/// the same on every target. Needs `mul_add`, `FRAC_PI_2` in three parts, `polynomials`, S and C of y², and `reduced_sin_cos`, which is
/// `fused_one_by_one` or as good.
macro_rules! fused_sines {
    ($scalar:ident) => {
        use super::large::{reduce_large, reduce_large_sum};
        use super::sin_cos::{ROUND, Reduced, by_quadrant, is_short, is_short_half, two_sum};

        /// (sin x, cos x), as [`sin_cos`](super::sin_cos()), every product that a sum reads added without being rounded.
        ///
        /// Error: at most 0.82 ulp for every finite x. sin(−0) = −0. NaN if x is not finite.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        #[must_use]
        pub fn fused_sin_cos(x: $scalar) -> ($scalar, $scalar) {
            if is_short(x) { reduced_sin_cos(reduce(x)) } else { large_sin_cos(x) }
        }

        /// (sin x/2, cos x/2): the bits of [`fused_sin_cos`] of `0.5 * x`, whose product the quadrant does not wait for.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        #[must_use]
        pub fn fused_sin_cos_half(x: $scalar) -> ($scalar, $scalar) {
            let half = 0.5 * x;
            if is_short_half(x) {
                reduced_sin_cos(reduced(half, mul_add(x, core::$scalar::consts::FRAC_1_PI, ROUND)))
            } else {
                large_sin_cos(half)
            }
        }

        /// (sin, cos) of the real number x + hi + lo, as [`sin_cos_sum`](super::sin_cos_sum) with its error.
        #[inline]
        #[must_use]
        pub fn fused_sin_cos_sum(x: $scalar, hi: $scalar, lo: $scalar) -> ($scalar, $scalar) {
            let (sum, error) = two_sum(x, hi);
            if is_short(sum) {
                reduced_sin_cos(reduce(sum).plus(error + lo))
            } else {
                large_sin_cos_sum(sum, error, lo)
            }
        }

        #[cold]
        #[inline(never)]
        fn large_sin_cos(x: $scalar) -> ($scalar, $scalar) {
            reduce_large(x).fused_one_by_one()
        }

        #[cold]
        #[inline(never)]
        fn large_sin_cos_sum(x: $scalar, hi: $scalar, lo: $scalar) -> ($scalar, $scalar) {
            reduce_large_sum(x, hi, lo).fused_one_by_one()
        }

        /// [`fused_sin_cos`] without its branch: for angles for which the short reduction serves; elsewhere the numbers mean nothing.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn short_fused_sin_cos(x: $scalar) -> ($scalar, $scalar) {
            reduce(x).fused_one_by_one()
        }

        /// [`fused_sin_cos_sum`] without its branch: where the short reduction serves for x + hi.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn short_fused_sin_cos_sum(x: $scalar, hi: $scalar, lo: $scalar) -> ($scalar, $scalar) {
            let (sum, error) = two_sum(x, hi);
            reduce(sum).plus(error + lo).fused_one_by_one()
        }

        /// Where the short reduction serves. Nothing is lost but by the sums that make y and t.
        #[inline]
        fn reduce(x: $scalar) -> Reduced {
            reduced(x, mul_add(x, core::$scalar::consts::FRAC_2_PI, ROUND))
        }

        /// The same, the number of quadrants being known, rounded in the last bits of a number.
        #[inline]
        fn reduced(x: $scalar, rounded: $scalar) -> Reduced {
            let n = rounded - ROUND;
            let x1 = mul_add(-n, FRAC_PI_2[0], x);
            let w = n * FRAC_PI_2[1];
            let y = x1 - w;
            let t = mul_add(n, FRAC_PI_2[2], w - (x1 - y));
            Reduced { quadrant: rounded.to_bits(), y, t }
        }

        impl Reduced {
            /// The polynomials, exchanged and negated as the quadrant says. Every sum is arranged so that −0 stays −0.
            #[inline]
            fn fused_one_by_one(self) -> ($scalar, $scalar) {
                let Self { quadrant, y, t } = self;
                let z = y * y;
                let (s, c) = polynomials(z);
                let w = mul_add(-0.5, z, 1.0);
                let sin = y - mul_add(z * y, s, t * w);
                let cos = w + mul_add(z * z, c, mul_add(y, t, mul_add(-0.5, z, 1.0 - w)));
                by_quadrant(quadrant, sin, cos)
            }
        }
    };
}
pub(super) use fused_sines;
