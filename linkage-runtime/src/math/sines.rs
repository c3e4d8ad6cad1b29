//! What plain and fused sines have in common: where the short reduction serves, the quadrant, and the ways in.

/// Sine and cosine of an angle from those of its distance from the next multiple of π/2, in the bits of a scalar.
macro_rules! by_quadrant {
    ($scalar:ident, $bits:ident) => {
        /// Exchanged and negated by what differs: in loops that are vectorised a choice between two registers takes longer.
        #[inline]
        pub(super) fn by_quadrant(quadrant: $bits, sin: $scalar, cos: $scalar) -> ($scalar, $scalar) {
            const SIGN: $bits = 1 << ($bits::BITS - 1);
            let (sin, cos) = (sin.to_bits(), cos.to_bits());
            let exchanged = (sin ^ cos) & (quadrant & 1).wrapping_neg();
            // The last bit as the sign; the one before it.
            let quarter_turn = quadrant << ($bits::BITS - 1);
            let half_turn = (quadrant << ($bits::BITS - 2)) & SIGN;
            let both = exchanged ^ half_turn;
            ($scalar::from_bits(sin ^ both), $scalar::from_bits(cos ^ (both ^ quarter_turn)))
        }
    };
}

/// Whether the short reduction serves for an angle: up to `FAST`, and not for what is no number.
macro_rules! short_angles {
    ($scalar:ident, $bits:ident) => {
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

        /// For loops that are vectorised: marks, from the quarter turns of an angle, that its sine is left to the function for a single position.
        /// There are none, but for the last bits, `UNMARKED`, up to half of what the short reduction serves for; there always are beyond that, and
        /// of what is no number.
        #[doc(hidden)]
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "for loops that are vectorised")]
        #[must_use]
        pub fn far(quarters: $scalar) -> $bits {
            const LEAST: $bits = ROUND.to_bits() - (1 << (UNMARKED - 1));
            quarters.to_bits().wrapping_sub(LEAST)
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

/// Sine and cosine of an angle, of half of one and of a sum, with these polynomials: by the short reduction where it serves. Needs `rounded` and
/// `reduced`, and `short`, `short_half` and `of`.
macro_rules! sines {
    (
        $scalar:ident, $polynomials:ident;
        $(#[$whole:meta])* $sin_cos:ident, $(#[$half:meta])* $sin_cos_half:ident, $(#[$sum:meta])* $sin_cos_sum:ident,
    ) => {
        $(#[$whole])*
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as a call of its own it keeps all else waiting")]
        #[must_use]
        pub fn $sin_cos(x: $scalar) -> ($scalar, $scalar) {
            if is_short(x) { short(x) } else { large_sin_cos(x) }
        }

        $(#[$half])*
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        #[must_use]
        pub fn $sin_cos_half(x: $scalar) -> ($scalar, $scalar) {
            if is_short_half(x) { short_half(x) } else { large_sin_cos(0.5 * x) }
        }

        $(#[$sum])*
        #[inline]
        #[must_use]
        pub fn $sin_cos_sum(x: $scalar, hi: $scalar, lo: $scalar) -> ($scalar, $scalar) {
            let (sum, error) = two_sum(x, hi);
            if is_short(sum) { of(reduce(sum).plus(error + lo)) } else { large_sin_cos_sum(sum, error, lo) }
        }

        /// Out of line to the end, so that nothing of it has to be brought together with what is short.
        #[cold]
        #[inline(never)]
        fn large_sin_cos(x: $scalar) -> ($scalar, $scalar) {
            reduce_large(x).$polynomials()
        }

        #[cold]
        #[inline(never)]
        fn large_sin_cos_sum(x: $scalar, hi: $scalar, lo: $scalar) -> ($scalar, $scalar) {
            reduce_large_sum(x, hi, lo).$polynomials()
        }

        /// The short reduction.
        #[inline]
        pub(super) fn reduce(x: $scalar) -> Reduced {
            reduced(x, rounded(x, core::$scalar::consts::FRAC_2_PI))
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

#[cfg(test)]
mod tests {
    /// Of quarter turns, what is far and what is not.
    macro_rules! far_angles_are_marked {
        ($scalar:ident) => {
            use crate::__private::$scalar::{UNMARKED, all_hold, far, is_short, short_angle, short_fused_angle};

            let nearest =
                |x: $scalar| [short_angle(x).0, short_fused_angle(x).0].map(|quarters| all_hold(far(quarters)));
            let most = (1..UNMARKED).fold(1.0, |most: $scalar, _| 2.0 * most);
            for quarters in [0.0, 0.25, 1.0, most - 1.0, most - 0.75] {
                let x = quarters * core::$scalar::consts::FRAC_PI_2;
                assert_eq!([nearest(x), nearest(-x)], [[true; 2]; 2], "{x}");
                assert!(is_short(x));
            }
            let beyond = (most + 1.0) * core::$scalar::consts::FRAC_PI_2;
            for x in [beyond, 3.0 * beyond, 1e6 * beyond, 1e20, $scalar::MAX, $scalar::INFINITY, $scalar::NAN] {
                assert_eq!([nearest(x), nearest(-x)], [[false; 2]; 2], "{x}");
            }
        };
    }

    #[test]
    fn far_angles_are_marked_and_near_ones_are_short() {
        {
            far_angles_are_marked!(f64);
        }
        far_angles_are_marked!(f32);
    }
}
