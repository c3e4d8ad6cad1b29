//! Whether numbers are finite, or far from the largest: none of them waits for another, and one jump serves for all.

/// The functions for a scalar; `$four` and `$four_moderate` look at the exponents of four numbers at once. What is moderate is less than two
/// to the 257th power, in single precision to the 33rd: `$moderate` is that in bits.
///
/// By patterns: neither an index nor an iterator, which keep a way to panic in unoptimised builds.
macro_rules! finite {
    ($scalar:ident, $four:ident, $four_moderate:ident, $moderate:literal) => {
        /// Whether none is infinite or NaN.
        ///
        /// More than two together, which takes fewer instructions; two each by itself, which is known sooner.
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
        #[inline]
        #[must_use]
        pub fn all_finite<const N: usize>(values: [$scalar; N]) -> bool {
            match values.as_slice() {
                // In registers of their kind: one for integers, kept for this from the check of the angle on, would have to be saved.
                [value] => return value.abs() <= $scalar::MAX,
                [one, other] => return (one.abs() <= $scalar::MAX) & (other.abs() <= $scalar::MAX),
                _ => {}
            }
            $crate::finite::in_fours!(values, $four)
        }

        /// Whether none is NaN or so large that what is made of all of them, behind the checks of a linkage, could be infinite.
        ///
        /// These are arguments, which are known first of all.
        #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
        #[inline]
        #[must_use]
        pub fn all_moderate<const N: usize>(values: [$scalar; N]) -> bool {
            match values.as_slice() {
                [value] => return value.abs() < $scalar::from_bits($moderate),
                [one, other] => {
                    return (one.abs() < $scalar::from_bits($moderate)) & (other.abs() < $scalar::from_bits($moderate))
                }
                _ => {}
            }
            $crate::finite::in_fours!(values, $four_moderate)
        }

        /// Whether none is NaN or so large that what is made of all of them, behind the checks of a linkage, could be infinite.
        #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
        #[inline]
        #[must_use]
        pub fn all_moderate<const N: usize>(values: [$scalar; N]) -> bool {
            each_moderate(values)
        }

        /// The same for loops that are vectorised, which look at several positions at once.
        #[inline]
        #[must_use]
        pub fn each_moderate<const N: usize>(values: [$scalar; N]) -> bool {
            let (mut moderate, mut rest) = (true, values.as_slice());
            while let [value, others @ ..] = rest {
                moderate &= value.abs() < $scalar::from_bits($moderate);
                rest = others;
            }
            moderate
        }

        /// Whether none is infinite or NaN.
        #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
        #[inline]
        #[must_use]
        pub fn all_finite<const N: usize>(values: [$scalar; N]) -> bool {
            each_finite(values)
        }

        /// The same for loops that are vectorised, which look at several positions at once.
        #[inline]
        #[must_use]
        pub fn each_finite<const N: usize>(values: [$scalar; N]) -> bool {
            let (mut finite, mut rest) = (true, values.as_slice());
            while let [value, others @ ..] = rest {
                finite &= value.is_finite();
                rest = others;
            }
            finite
        }
    };
}
pub(crate) use finite;

/// Whether `$four` marks none of some numbers, of which it looks at four at once.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
macro_rules! in_fours {
    ($values:expr, $four:ident) => {{
        let (mut marks, mut rest) = ($crate::finite::registers::none(), $values.as_slice());
        while let [a, others @ ..] = rest {
            // What is missing of the last four is the one before once more, which need not be moved for it.
            let (b, others) = if let [b, others @ ..] = others { (b, others) } else { (a, others) };
            let (c, others) = if let [c, others @ ..] = others { (c, others) } else { (b, others) };
            let (d, others) = if let [d, others @ ..] = others { (d, others) } else { (c, others) };
            marks = $crate::finite::registers::$four(marks, *a, *b, *c, *d);
            rest = others;
        }
        $crate::finite::registers::is_unmarked(marks)
    }};
}
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
pub(crate) use in_fours;

/// By the registers of x86-64, in which the exponents of four numbers are compared at once.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code, reason = "a function that uses instructions beyond the oldest processors' is unsafe to call")]
pub(crate) mod registers {
    use core::arch::x86_64::{
        __m128, __m128i, _mm_and_si128, _mm_castpd_ps, _mm_castps_si128, _mm_castsi128_ps, _mm_cmpeq_epi32,
        _mm_cmpgt_epi32, _mm_movemask_ps, _mm_or_si128, _mm_set_pd, _mm_set_ps, _mm_set1_epi32, _mm_setzero_si128,
        _mm_shuffle_ps,
    };

    /// Which places of four numbers, of several times four, have held one with the exponent of those that are not finite.
    type Marks = __m128i;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn none() -> Marks {
        // SAFETY: this module is compiled only where all code may use SSE2.
        unsafe { _mm_setzero_si128() }
    }

    /// Marks the places of those of four more that are not finite.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn four_f64(marks: Marks, a: f64, b: f64, c: f64, d: f64) -> Marks {
        // SAFETY: as above.
        unsafe { marked(marks, upper_halves(a, b, c, d), 0x7FF0_0000) }
    }

    /// The same in single precision.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn four_f32(marks: Marks, a: f32, b: f32, c: f32, d: f32) -> Marks {
        // SAFETY: as above.
        unsafe { marked(marks, _mm_set_ps(d, c, b, a), 0x7F80_0000) }
    }

    /// Marks the places of those of four more that are not moderate.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn four_moderate_f64(marks: Marks, a: f64, b: f64, c: f64, d: f64) -> Marks {
        // SAFETY: as above.
        unsafe { marked_above(marks, upper_halves(a, b, c, d), 0x4FFF_FFFF) }
    }

    /// The same in single precision.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn four_moderate_f32(marks: Marks, a: f32, b: f32, c: f32, d: f32) -> Marks {
        // SAFETY: as above.
        unsafe { marked_above(marks, _mm_set_ps(d, c, b, a), 0x4FFF_FFFF) }
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn is_unmarked(marks: Marks) -> bool {
        // SAFETY: as above.
        unsafe { _mm_movemask_ps(_mm_castsi128_ps(marks)) == 0 }
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn marked(marks: Marks, numbers: __m128, exponent: i32) -> Marks {
        let exponent = _mm_set1_epi32(exponent);
        _mm_or_si128(marks, _mm_cmpeq_epi32(_mm_and_si128(_mm_castps_si128(numbers), exponent), exponent))
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn marked_above(marks: Marks, numbers: __m128, most: i32) -> Marks {
        let sizes = _mm_and_si128(_mm_castps_si128(numbers), _mm_set1_epi32(0x7FFF_FFFF));
        _mm_or_si128(marks, _mm_cmpgt_epi32(sizes, _mm_set1_epi32(most)))
    }

    /// The halves of the numbers that hold their exponents.
    #[inline]
    #[target_feature(enable = "sse2")]
    fn upper_halves(a: f64, b: f64, c: f64, d: f64) -> __m128 {
        _mm_shuffle_ps::<0b11_01_11_01>(_mm_castpd_ps(_mm_set_pd(b, a)), _mm_castpd_ps(_mm_set_pd(d, c)))
    }
}

#[cfg(test)]
mod tests {
    use crate::__private::{f32, f64};

    /// Each number that is not finite, in each place of one to nine numbers.
    #[test]
    fn what_is_not_finite_is_found_in_every_place() {
        macro_rules! every_place {
            ($scalar:ident: $($length:literal)+) => {$({
                let finite = [0.0, -0.0, 5e-324 as $scalar, -$scalar::MIN_POSITIVE, $scalar::MAX, -$scalar::MAX, 1.0];
                for x in finite {
                    assert!($scalar::all_finite([x; $length]) && $scalar::each_finite([x; $length]), "{x:e}");
                    for not in [$scalar::INFINITY, -$scalar::INFINITY, $scalar::NAN, -$scalar::NAN] {
                        for place in 0..$length {
                            let mut values = [x; $length];
                            values[place] = not;
                            assert!(!$scalar::all_finite(values) && !$scalar::each_finite(values), "{values:?}");
                        }
                    }
                }
            })+};
        }
        assert!(f64::all_finite([]) && f32::all_finite([]));
        every_place!(f64: 1 2 3 4 5 6 7 8 9);
        every_place!(f32: 1 2 3 4 5 6 7 8 9);
    }

    /// Each number that is too large, in each place of one to nine numbers.
    #[test]
    fn what_is_not_moderate_is_found_in_every_place() {
        macro_rules! every_place {
            ($scalar:ident, $most:expr; $($length:literal)+) => {$({
                let beyond: $scalar = $most;
                for x in [0.0, -0.0, 5e-324 as $scalar, -$scalar::MIN_POSITIVE, beyond.next_down(), -beyond.next_down()] {
                    assert!($scalar::all_moderate([x; $length]) && $scalar::each_moderate([x; $length]), "{x:e}");
                    for not in [beyond, -beyond, $scalar::MAX, $scalar::INFINITY, -$scalar::INFINITY, $scalar::NAN, -$scalar::NAN] {
                        for place in 0..$length {
                            let mut values = [x; $length];
                            values[place] = not;
                            assert!(!$scalar::all_moderate(values) && !$scalar::each_moderate(values), "{values:?}");
                        }
                    }
                }
            })+};
        }
        assert!(f64::all_moderate([]) && f32::all_moderate([]));
        every_place!(f64, 2f64.powi(257); 1 2 3 4 5 6 7 8 9);
        every_place!(f32, 2f32.powi(33); 1 2 3 4 5 6 7 8 9);
    }
}
