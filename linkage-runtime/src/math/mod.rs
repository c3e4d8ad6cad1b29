//! Elementary functions with the same bits on every target.
//!
//! Only `+ − × ÷`, the square root, comparisons, integer operations and bit casts, in the order written: no library of
//! the platform, and no fused multiply-add but in the functions that are named for it, where it is IEEE 754's. The same
//! source therefore gives the same bits on a microcontroller without a floating-point unit, on a desktop and in a browser,
//! at every optimisation level. Nothing panics, nothing allocates, and [`f32`](mod@f32) never touches an `f64`, but in
//! the routine of the compiler that stands for a fused operation where the processor has none.
//!
//! | function | largest error found, `f64` and `f32` | promised |
//! |---|---|---|
//! | `sqrt` | | correctly rounded |
//! | `sin_cos`, `sin_cos_half` | 0.887, 0.788 ulp (every `f32`) | 0.95 ulp |
//! | `fused_sin_cos`, `fused_sin_cos_half` | 0.950, 0.914 ulp (every `f32`) | 0.96 ulp |
//! | `sin_cos_sum` | 0.83, 0.83 ulp | 0.95 ulp + ε²·max(4, \|x\|) |
//! | `fused_sin_cos_sum` | 0.926, 0.923 ulp | 0.96 ulp + ε²·max(4, \|x\|) |
//! | `atan2` | 0.66, 0.67 ulp | 0.70 ulp |
//! | `unit` | norm 0.99, 1.13 ε; component 1.18, 1.46 ε | 1.5 ε for both |
//! | `polar` | 0.92, 1.03 ε of a component | 1.3 ε |
//!
//! ε is 2⁻⁵² (`f64`) or 2⁻²³ (`f32`), an ulp the distance of neighbouring numbers at the true result. An argument that
//! is not finite gives NaN in every result; the infinite square root alone is infinite.

/// `c0 + z·(c1 + z·(c2 + …))`, evaluated from the innermost bracket.
macro_rules! horner {
    ($z:expr; $c:expr) => { $c };
    ($z:expr; $c:expr, $($rest:expr),+) => { $c + $z * horner!($z; $($rest),+) };
}

/// The same polynomial with six coefficients, in pairs that do not wait for each other (Estrin 1960).
macro_rules! estrin {
    ($z:expr; $c:expr) => {{
        let (z, [c0, c1, c2, c3, c4, c5]) = ($z, $c);
        let z2 = z * z;
        ((c0 + z * c1) + z2 * (c2 + z * c3)) + (z2 * z2) * (c4 + z * c5)
    }};
}

/// Sine and cosine of an angle from those of its distance from the next multiple of π/2, in the bits of a scalar.
macro_rules! by_quadrant {
    ($scalar:ident, $bits:ident) => {
        #[inline]
        pub(super) fn by_quadrant(quadrant: $bits, sin: $scalar, cos: $scalar) -> ($scalar, $scalar) {
            let (sin, cos) = if quadrant & 1 == 0 { (sin, cos) } else { (cos, sin) };
            // The last bit as the sign; the one before it.
            let quarter_turn = quadrant << ($bits::BITS - 1);
            let half_turn = (quadrant >> 1) << ($bits::BITS - 1);
            let turned = |part: $scalar, signs: $bits| $scalar::from_bits(part.to_bits() ^ signs);
            (turned(sin, half_turn), turned(cos, half_turn ^ quarter_turn))
        }
    };
}

/// Whether the short reduction serves for an angle: up to `FAST`, and not for what is no number.
macro_rules! short_angles {
    ($scalar:ident) => {
        /// Whether the short reduction serves for an angle.
        ///
        /// As integers, whose units have nothing else to do; and where floating point is software, a comparison of such numbers would be a call.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        #[must_use]
        pub fn is_short(x: $scalar) -> bool {
            x.abs().to_bits() <= FAST.to_bits()
        }

        /// Whether it serves for half of an angle.
        #[inline]
        pub(super) fn is_short_half(x: $scalar) -> bool {
            x.abs().to_bits() <= (2.0 * FAST).to_bits()
        }

        /// The same as `is_short` for loops that are vectorised, which look at several positions at once.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn each_short(x: $scalar) -> bool {
            x.abs() <= FAST
        }

        /// Whether an angle is finite. Behind this its sine need not ask again whether it is short.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        #[must_use]
        pub fn is_angle(x: $scalar) -> bool {
            is_short(x) || large_is_finite(x)
        }

        /// Out of line, so that it is not worked out beside the other question.
        #[cold]
        #[inline(never)]
        fn large_is_finite(x: $scalar) -> bool {
            x.is_finite()
        }
    };
}

/// Sine and cosine without a branch, in two parts: for angles for which the short reduction serves; elsewhere the numbers mean nothing. Loops
/// over angles keep what lies between, so that the operations of the second part do not wait for those of the first.
macro_rules! short_sines {
    ($scalar:ident, $polynomials:ident) => {
        short_sines!($scalar, $polynomials, short_angle, short_angle_sum, short_sin_cos);
    };
    ($scalar:ident, $polynomials:ident, $angle:ident, $angle_sum:ident, $sin_cos:ident) => {
        /// The angle as quarter turns, in the last bits of the first number, and what is left, the second number less the third.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn $angle(x: $scalar) -> ($scalar, $scalar, $scalar) {
            let Reduced { quadrant, y, t } = reduce(x);
            ($scalar::from_bits(quadrant), y, t)
        }

        /// The same of the real number x + hi + lo: where the short reduction serves for x + hi.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn $angle_sum(x: $scalar, hi: $scalar, lo: $scalar) -> ($scalar, $scalar, $scalar) {
            let (sum, error) = two_sum(x, hi);
            let Reduced { quadrant, y, t } = reduce(sum).plus(error + lo);
            ($scalar::from_bits(quadrant), y, t)
        }

        /// (sin, cos) of such an angle.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn $sin_cos(quarters: $scalar, rest: $scalar, tail: $scalar) -> ($scalar, $scalar) {
            Reduced { quadrant: quarters.to_bits(), y: rest, t: tail }.$polynomials()
        }
    };
}

/// `short`, `short_half` and `of` with these polynomials: for angles of the short reduction, halves of such angles, and reduced ones.
#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma")))]
macro_rules! one_by_one {
    ($scalar:ident, $polynomials:ident) => {
        #[inline]
        fn short(x: $scalar) -> ($scalar, $scalar) {
            reduce(x).$polynomials()
        }

        #[inline]
        fn short_half(x: $scalar) -> ($scalar, $scalar) {
            reduced(0.5 * x, rounded(x, core::$scalar::consts::FRAC_1_PI)).$polynomials()
        }

        #[inline]
        fn of(reduced: Reduced) -> ($scalar, $scalar) {
            reduced.$polynomials()
        }
    };
}

#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[macro_use]
mod halves;

pub mod f32;
pub mod f64;
mod fused;
mod sqrt;
