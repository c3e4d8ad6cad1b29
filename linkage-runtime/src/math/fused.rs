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
/// the same on every target. Needs `mul_add`, `FRAC_PI_2` in three parts, `SINE` and `COSINE`, the coefficients of S and −C, `cubic`, which is
/// y³ times such a polynomial, plus a tail, and `short`, `short_half` and `of` for an angle of the short reduction, half of one, and a reduced
/// one: `one_by_one` of `fused_one_by_one`, or what has its bits.
macro_rules! fused_sines {
    ($scalar:ident) => {
        use super::large::{reduce_large, reduce_large_sum};
        use super::sin_cos::{ROUND, Reduced, by_quadrant, is_short, is_short_half, two_sum};

        sines! {
            $scalar, fused_one_by_one;
            /// (sin x, cos x), as [`sin_cos`](super::sin_cos()), every product that a sum reads added without being rounded.
            ///
            /// Error: at most 0.96 ulp for every finite x. sin(−0) = −0. NaN if x is not finite.
            fused_sin_cos,
            /// (sin x/2, cos x/2): the bits of [`fused_sin_cos`] of `0.5 * x`, whose product the quadrant does not wait for.
            fused_sin_cos_half,
            /// (sin, cos) of the real number x + hi + lo, as [`sin_cos_sum`](super::sin_cos_sum), with 0.96 ulp in place of 0.95.
            fused_sin_cos_sum,
        }
        short_sines!($scalar, fused_one_by_one, short_fused_angle, short_fused_angle_sum, short_fused_sin_cos);

        /// How many quadrants an angle has, of so many for each radian, rounded in the last bits of a number.
        #[inline]
        fn rounded(x: $scalar, per_radian: $scalar) -> $scalar {
            mul_add(x, per_radian, ROUND)
        }

        /// The angle without its quadrants, whose number is known, rounded in the last bits of a number: where the short reduction serves. Nothing
        /// is lost but by the sums that make y and t.
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
            /// sin(y − t) = y − (y³S + t) and cos(y − t) = 1 − y ((y/2 − t) − y³C), exchanged and negated as the quadrant says. The tail of
            /// the sine is not multiplied by cos y, a sixth of an ulp at most, and that of the cosine by y in place of sin y, a twenty-fifth.
            /// The sums are arranged so that −0 stays −0.
            #[inline]
            fn fused_one_by_one(self) -> ($scalar, $scalar) {
                let Self { quadrant, y, t } = self;
                let sin = y - cubic(y, &SINE, t);
                let cos = mul_add(-y, cubic(y, &COSINE, mul_add(y, 0.5, -t)), 1.0);
                by_quadrant(quadrant, sin, cos)
            }
        }
    };
}
pub(super) use fused_sines;
