//! Whether numbers are finite, or far from the largest: none of them waits for another, and one jump serves for all.

/// The functions for a scalar; `$four` looks at the exponents of four numbers at once. The pattern of infinity begins with `$infinite`.
/// What is moderate is less than two to the 257th power, in single precision to the 33rd: `$moderate` is that in bits.
///
/// By patterns: neither an index nor an iterator, which keep a way to panic in unoptimised builds.
macro_rules! finite {
    ($scalar:ident, $bits:ident, $four:ident, $infinite:literal, $moderate:literal) => {
        /// Whether none is infinite or NaN.
        #[inline]
        #[must_use]
        pub fn all_finite<const N: usize>(values: [$scalar; N]) -> bool {
            #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
            return $crate::finite::in_fours!(values, $four, $infinite, value => value.abs() <= $scalar::MAX);
            #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
            $crate::finite::in_each!(values, value => value.is_finite())
        }

        /// The same for loops that are vectorised, which look at several positions at once: marks if any is infinite or NaN. By the sum, which is
        /// finite only if all are, and then leaves zero without itself. Where it is not, the numbers may be so large that they are finite
        /// all the same: then their block is solved one by one.
        #[inline]
        #[must_use]
        pub fn not_finite<const N: usize>(values: [$scalar; N]) -> $bits {
            let (mut sum, mut rest) = match values.as_slice() {
                [value, others @ ..] => (*value, others),
                [] => return 0,
            };
            while let [value, others @ ..] = rest {
                sum += *value;
                rest = others;
            }
            (sum - sum).to_bits()
        }

        /// Whether none is NaN or so large that what is made of all of them, behind the checks of a linkage, could be infinite.
        ///
        /// These are arguments, which are known first of all.
        #[inline]
        #[must_use]
        pub fn all_moderate<const N: usize>(values: [$scalar; N]) -> bool {
            #[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
            return $crate::finite::in_fours!(values, $four, 0x5000_0000, value => value.abs() < $scalar::from_bits($moderate));
            // As integers: where floating point is software, a comparison of such numbers would be a call.
            #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
            $crate::finite::in_each!(values, value => value.abs().to_bits() < $moderate)
        }

        /// The same for loops that are vectorised, which look at several positions at once.
        #[inline]
        #[must_use]
        pub fn each_moderate<const N: usize>(values: [$scalar; N]) -> bool {
            $crate::finite::in_each!(values, value => value.abs() < $scalar::from_bits($moderate))
        }
    };
}
pub(crate) use finite;

/// Whether something holds for each of some numbers, one after the other.
macro_rules! in_each {
    ($values:expr, $value:ident => $holds:expr) => {{
        let (mut all, mut rest) = (true, $values.as_slice());
        while let [$value, others @ ..] = rest {
            all &= $holds;
            rest = others;
        }
        all
    }};
}
pub(crate) use in_each;

/// Whether something holds for all of some numbers: `$four` marks those of four for which it does not, from `$least` on.
///
/// More than two together, which takes fewer instructions; two each by itself, which is known sooner.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
macro_rules! in_fours {
    ($values:expr, $four:ident, $least:literal, $value:ident => $holds:expr) => {
        if $values.len() <= 2 {
            $crate::finite::in_each!($values, $value => $holds)
        } else {
            let (mut marks, mut rest) = ($crate::finite::registers::none(), $values.as_slice());
            while let [a, others @ ..] = rest {
                // What is missing of the last four is the one before once more, which need not be moved for it.
                let (b, others) = if let [b, others @ ..] = others { (b, others) } else { (a, others) };
                let (c, others) = if let [c, others @ ..] = others { (c, others) } else { (b, others) };
                let (d, others) = if let [d, others @ ..] = others { (d, others) } else { (c, others) };
                marks = $crate::finite::registers::$four(marks, $least, [*a, *b, *c, *d]);
                rest = others;
            }
            $crate::finite::registers::is_unmarked(marks)
        }
    };
}
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
pub(crate) use in_fours;

/// By the registers of x86-64, in which the exponents of four numbers are looked at at once.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code, reason = "a function that uses instructions beyond the oldest processors' is unsafe to call")]
pub(crate) mod registers {
    use core::arch::x86_64::{
        __m128, __m128i, _mm_add_epi32, _mm_and_si128, _mm_castpd_ps, _mm_castps_si128, _mm_movemask_epi8,
        _mm_or_si128, _mm_set_pd, _mm_set_ps, _mm_set1_epi32, _mm_setzero_si128, _mm_shuffle_ps,
    };

    /// The places of four numbers, of several times four: a sign where one was marked.
    type Marks = __m128i;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn none() -> Marks {
        // SAFETY: this module is compiled only where all code may use SSE2.
        unsafe { _mm_setzero_si128() }
    }

    /// Marks the places of those of four more whose patterns begin with no less.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn four_f64(marks: Marks, least: i32, [a, b, c, d]: [f64; 4]) -> Marks {
        // SAFETY: as above.
        unsafe { marked_from(marks, upper_halves(a, b, c, d), least) }
    }

    /// The same in single precision.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn four_f32(marks: Marks, least: i32, [a, b, c, d]: [f32; 4]) -> Marks {
        // SAFETY: as above.
        unsafe { marked_from(marks, _mm_set_ps(d, c, b, a), least) }
    }

    /// By the signs of bytes, of which each fourth is that of a number: a mask of the numbers' own signs that is compared with zero
    /// becomes an instruction of newer sets that takes longer.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a few instructions")]
    pub(crate) fn is_unmarked(marks: Marks) -> bool {
        // SAFETY: as above.
        unsafe { _mm_movemask_epi8(marks) & 0b1000_1000_1000_1000 == 0 }
    }

    /// Marks the places of numbers whose patterns of bits, without the sign, are no less than another one: by a sum that is negative from
    /// there on. Such patterns grow with the numbers, halves of patterns too; those of what is no number are the largest.
    #[inline]
    #[target_feature(enable = "sse2")]
    fn marked_from(marks: Marks, numbers: __m128, least: i32) -> Marks {
        let sizes = _mm_and_si128(_mm_castps_si128(numbers), _mm_set1_epi32(i32::MAX));
        _mm_or_si128(marks, _mm_add_epi32(sizes, _mm_set1_epi32(i32::MIN.wrapping_sub(least))))
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

    /// Each number for which something does not hold, in each place of one to nine numbers for which it does. `$each` is what loops ask.
    macro_rules! every_place {
        ($scalar:ident, $all:ident, $each:expr, $beyond:expr; $($length:literal)+) => {$({
            let least: $scalar = $beyond;
            let most = least.next_down();
            for x in [0.0, -0.0, 5e-324 as $scalar, -$scalar::MIN_POSITIVE, 1.0, most, -most] {
                assert!($scalar::$all([x; $length]), "{x:e}");
                assert_eq!($each(&[x; $length]), [x; $length].iter().sum::<$scalar>().is_finite(), "{x:e}");
                for not in [least, -least, $scalar::INFINITY, -$scalar::INFINITY, $scalar::NAN, -$scalar::NAN] {
                    for place in 0..$length {
                        let mut values = [x; $length];
                        values[place] = not;
                        assert!(!$scalar::$all(values) && !$each(&values), "{values:?}");
                    }
                }
            }
        })+};
    }

    /// What a loop asks of results: whether what marks them leaves nothing.
    macro_rules! unmarked {
        ($scalar:ident, $values:expr) => {
            $scalar::all_hold($scalar::not_finite($values))
        };
    }

    #[test]
    fn what_is_not_finite_is_found_in_every_place() {
        assert!(f64::all_finite([]) && f32::all_finite([]));
        assert!(unmarked!(f64, []) && unmarked!(f32, []));
        every_place!(f64, all_finite, |values: &_| unmarked!(f64, *values), f64::INFINITY; 1 2 3 4 5 6 7 8 9);
        every_place!(f32, all_finite, |values: &_| unmarked!(f32, *values), f32::INFINITY; 1 2 3 4 5 6 7 8 9);
        // Of opposite signs they leave nothing that is finite either.
        assert!(!unmarked!(f64, [f64::INFINITY, f64::NEG_INFINITY, 1.0]) && !unmarked!(f64, [1.0, f64::NAN]));
        let enormous = [f64::MAX, f64::MAX, -f64::MAX];
        assert!(!unmarked!(f64, enormous) && f64::all_finite(enormous));
    }

    #[test]
    fn what_is_not_moderate_is_found_in_every_place() {
        assert!(f64::all_moderate([]) && f32::all_moderate([]));
        every_place!(f64, all_moderate, |values: &_| f64::each_moderate(*values), 2f64.powi(257); 1 2 3 4 5 6 7 8 9);
        every_place!(f32, all_moderate, |values: &_| f32::each_moderate(*values), 2f32.powi(33); 1 2 3 4 5 6 7 8 9);
    }
}
