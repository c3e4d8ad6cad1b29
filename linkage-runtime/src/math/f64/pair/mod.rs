//! Sine and cosine in the two halves of a register of x86-64: the bits of `Reduced::one_by_one`, or of the fused ones, in half as many
//! instructions.
//!
//! What the quadrant exchanges and negates is exchanged and negated before the polynomials, not after them, where nothing waits for it: each
//! half begins as the sine or the cosine that it will be.
#![allow(
    unsafe_code,
    reason = "calls of functions that name their instructions, a load of two numbers, a barrier to the compiler"
)]

/// The ways in, with these instructions: needs `rounded`, `reduced` and `sin_cos`, each of both halves.
macro_rules! ways_in {
    ($instructions:literal) => {
        /// For angles of the short reduction.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        pub(in super::super) fn short(x: f64) -> (f64, f64) {
            #[inline]
            #[target_feature(enable = $instructions)]
            fn halves(x: f64) -> (f64, f64) {
                let x = twice(x);
                sin_cos(reduced(x, rounded(x, core::f64::consts::FRAC_2_PI)))
            }
            // SAFETY: this module is compiled only where all code may use these instructions.
            unsafe { halves(x) }
        }

        /// For half of an angle.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        pub(in super::super) fn short_half(x: f64) -> (f64, f64) {
            #[inline]
            #[target_feature(enable = $instructions)]
            fn halves(x: f64) -> (f64, f64) {
                let x = twice(x);
                sin_cos(reduced(_mm_mul_pd(_mm_set1_pd(0.5), x), rounded(x, core::f64::consts::FRAC_1_PI)))
            }
            // SAFETY: as in `short`.
            unsafe { halves(x) }
        }

        /// For an angle that is reduced.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "as `sin_cos`")]
        pub(in super::super) fn of(reduced: Reduced) -> (f64, f64) {
            // SAFETY: as in `short`.
            unsafe { sin_cos(Spread::of(reduced)) }
        }
    };
}

#[cfg(target_feature = "fma")]
pub(super) mod fused;
pub(super) mod plain;

use core::arch::x86_64::{__m128d, _mm_cvtsd_f64, _mm_load_pd, _mm_set1_pd, _mm_unpackhi_pd};

use super::sin_cos::Reduced;

/// A reduced angle, its y and t in both halves.
struct Spread {
    quadrant: u64,
    y: __m128d,
    t: __m128d,
}

impl Spread {
    #[inline]
    #[target_feature(enable = "sse2")]
    fn of(Reduced { quadrant, y, t }: Reduced) -> Self {
        Self { quadrant, y: twice(y), t: twice(t) }
    }
}

/// The halves that are sin x and cos x in each quadrant: whether it is the sine of the reduced angle, not the cosine, and whether it is the
/// negative of that.
const QUADRANTS: [[(bool, bool); 2]; 4] = [
    [(true, false), (false, false)],
    [(false, false), (true, true)],
    [(true, true), (false, true)],
    [(false, true), (true, false)],
];

const SIGN: u64 = 1 << 63;

/// The bits of both halves, where an instruction can take them from memory.
#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct Halves([u64; 2]);

impl Halves {
    const ZERO: Self = Self([0; 2]);

    #[inline]
    #[target_feature(enable = "sse2")]
    fn bits(&self) -> __m128d {
        // SAFETY: sixteen bytes are read of sixteen, at a multiple of sixteen.
        unsafe { _mm_load_pd(self.0.as_ptr().cast()) }
    }
}

/// The row of a quadrant in a table.
#[inline]
fn row<T>(table: &'static [T; 4], quadrant: u64) -> &'static T {
    table.get((quadrant & 3) as usize).unwrap_or(&table[0])
}

/// The numbers of both halves.
#[inline]
#[target_feature(enable = "sse2")]
fn both(halves: __m128d) -> (f64, f64) {
    (_mm_cvtsd_f64(halves), _mm_cvtsd_f64(_mm_unpackhi_pd(halves, halves)))
}

/// A number in both halves, unknown to the compiler, which would calculate squares of the number alone and spread each over a register.
#[inline]
#[target_feature(enable = "sse2")]
fn twice(number: f64) -> __m128d {
    let mut halves = _mm_set1_pd(number);
    // SAFETY: no instruction at all.
    unsafe { core::arch::asm!("/* {0} */", inout(xmm_reg) halves, options(pure, nomem, nostack, preserves_flags)) };
    halves
}

#[cfg(test)]
mod tests {
    use crate::math::f64::{
        fused_sin_cos, fused_sin_cos_sum, short_angle, short_angle_sum, short_fused_angle, short_fused_angle_sum,
        short_fused_sin_cos, short_sin_cos, sin_cos, sin_cos_sum,
    };

    fn one_by_one((quarters, rest, tail): (f64, f64, f64)) -> (f64, f64) {
        short_sin_cos(quarters, rest, tail)
    }

    fn fused_one_by_one((quarters, rest, tail): (f64, f64, f64)) -> (f64, f64) {
        short_fused_sin_cos(quarters, rest, tail)
    }

    #[test]
    fn halves_have_the_bits_of_one_by_one() {
        let bits = |(sin, cos): (f64, f64)| [sin.to_bits(), cos.to_bits()];
        let turns = (0..200_000).map(|i| f64::from(i) * 0.013_7);
        let small = (0..2000).map(|i| f64::from_bits(0x3FF0_0000_0000_0000 - 0x0001_3579_BDF0_2468 * i));
        for x in turns.chain(small).chain([0.0, 5e-324]) {
            for x in [x, -x] {
                assert_eq!(bits(sin_cos(x)), bits(one_by_one(short_angle(x))), "{x:e}");
                assert_eq!(bits(fused_sin_cos(x)), bits(fused_one_by_one(short_fused_angle(x))), "fused, {x:e}");
            }
        }
    }

    /// Where nothing is left of a reduced angle, the sign of zero is the same too.
    #[test]
    fn halves_have_the_bits_of_one_by_one_at_quarter_turns() {
        let bits = |(sin, cos): (f64, f64)| [sin.to_bits(), cos.to_bits()];
        let (pi, rest) = (core::f64::consts::PI, 1.224_646_799_147_353_2e-16);
        for quarters in [-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0] {
            let (hi, lo) = (0.25 * quarters * pi, 0.25 * quarters * rest);
            for (hi, lo) in [(hi, lo), (2.0 * hi, 2.0 * lo)] {
                for x in [0.0, -0.0] {
                    assert_eq!(bits(sin_cos_sum(x, hi, lo)), bits(one_by_one(short_angle_sum(x, hi, lo))), "{hi:e}");
                    let fused =
                        [fused_sin_cos_sum(x, hi, lo), fused_one_by_one(short_fused_angle_sum(x, hi, lo))].map(bits);
                    assert_eq!(fused[0], fused[1], "fused, {hi:e}");
                }
            }
        }
    }
}
