//! Sine and cosine in the two halves of a register of x86-64: the operations of [`Reduced::one_by_one`], or of the fused ones, each on its
//! number, so the same bits, in half as many instructions.
//!
//! What the quadrant exchanges and negates is exchanged and negated before the polynomials, not after them, where nothing waits for it: each
//! half begins as the sine or the cosine that it will be.
#![allow(
    unsafe_code,
    reason = "calls of functions that name their instructions, a load of two numbers, a barrier to the compiler"
)]

use core::arch::x86_64::{
    __m128d, _mm_add_pd, _mm_and_pd, _mm_andnot_pd, _mm_cvtsd_f64, _mm_load_pd, _mm_mul_pd, _mm_set1_pd, _mm_sub_pd,
    _mm_unpackhi_pd, _mm_xor_pd,
};
#[cfg(target_feature = "fma")]
use core::arch::x86_64::{_mm_fmadd_pd, _mm_fnmadd_pd};

use super::sin_cos::{COSINE, Reduced, SINE};

/// See [`Reduced::sin_cos`].
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
pub(super) fn sin_cos(reduced: Reduced) -> (f64, f64) {
    // SAFETY: this module is compiled only where all code may use SSE2.
    unsafe { in_halves(reduced) }
}

/// Of the cosine's sum all terms but the first are carried as negatives, so that both are differences.
#[inline]
#[target_feature(enable = "sse2")]
fn in_halves(Reduced { quadrant, y, t }: Reduced) -> (f64, f64) {
    let turn = Turn::by(quadrant);
    let (y, t, one) = (twice(y), _mm_set1_pd(t), _mm_set1_pd(1.0));
    let z = _mm_mul_pd(y, y);
    let z2 = _mm_mul_pd(z, z);
    let half = _mm_mul_pd(_mm_set1_pd(0.5), z);
    let w = _mm_sub_pd(one, half);
    let lost = _mm_sub_pd(half, _mm_sub_pd(one, w));
    let [k0, k1, k2, k3, k4, k5] = turn.coefficients.each_ref().map(|of| bits(of));
    let p0 = _mm_add_pd(k0, _mm_mul_pd(z, k1));
    let p1 = _mm_add_pd(k2, _mm_mul_pd(z, k3));
    let p2 = _mm_add_pd(k4, _mm_mul_pd(z, k5));
    let p = _mm_add_pd(_mm_add_pd(p0, _mm_mul_pd(z2, p1)), _mm_mul_pd(_mm_mul_pd(z2, z2), p2));
    let Parts { first, factor, tail, lost } = turn.parts([y, z, w, t, lost]);
    let tail = _mm_add_pd(lost, _mm_mul_pd(tail, factor.other));
    both(_mm_sub_pd(factor.own, _mm_add_pd(_mm_mul_pd(_mm_mul_pd(z, first), p), tail)))
}

/// See `Reduced::fused_one_by_one`.
#[cfg(target_feature = "fma")]
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
pub(super) fn fused_sin_cos(reduced: Reduced) -> (f64, f64) {
    // SAFETY: this function is compiled only where all code may use fused operations.
    unsafe { fused_in_halves(reduced) }
}

/// As [`in_halves`], every product that a sum reads added without being rounded.
#[cfg(target_feature = "fma")]
#[inline]
#[target_feature(enable = "sse2,fma")]
fn fused_in_halves(Reduced { quadrant, y, t }: Reduced) -> (f64, f64) {
    let turn = Turn::by(quadrant);
    let (y, t, one, half) = (twice(y), _mm_set1_pd(t), _mm_set1_pd(1.0), _mm_set1_pd(0.5));
    let z = _mm_mul_pd(y, y);
    let z2 = _mm_mul_pd(z, z);
    let w = _mm_fnmadd_pd(half, z, one);
    let lost = _mm_fmadd_pd(half, z, _mm_sub_pd(w, one));
    let [k0, k1, k2, k3, k4, k5] = turn.coefficients.each_ref().map(|of| bits(of));
    let (low, middle, high) = (_mm_fmadd_pd(z, k1, k0), _mm_fmadd_pd(z, k3, k2), _mm_fmadd_pd(z, k5, k4));
    let p = _mm_fmadd_pd(_mm_mul_pd(z2, z2), high, _mm_fmadd_pd(z2, middle, low));
    let Parts { first, factor, tail, lost } = turn.parts([y, z, w, t, lost]);
    both(_mm_sub_pd(factor.own, _mm_fmadd_pd(_mm_mul_pd(z, first), p, _mm_fmadd_pd(tail, factor.other, lost))))
}

/// What a quadrant makes of the halves, in bits. From a table, because what is read takes none of the units that calculate.
struct Turn {
    /// Those of S or −C, negated where the half is.
    coefficients: [Halves; 6],
    /// All bits of a half that is ± the sine of the reduced angle, none of one that is ± its cosine.
    is_sine: Halves,
    /// The sign of a half that is the negative.
    negated: Halves,
    /// The sign of the tail: of a cosine it is the opposite.
    tail_negated: Halves,
}

/// sin x and cos x in the quadrants, as the sine of the reduced angle or its cosine, and whether they are the negatives.
static TURNS: [Turn; 4] = [
    Turn::of([(true, false), (false, false)]),
    Turn::of([(false, false), (true, true)]),
    Turn::of([(true, true), (false, true)]),
    Turn::of([(false, true), (true, false)]),
];

const SIGN: u64 = 1 << 63;

/// The bits of both halves, where an instruction can take them from memory.
#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct Halves([u64; 2]);

/// What the halves are made of, exchanged and negated.
struct Parts {
    /// y or z, which the polynomial is multiplied by beside z.
    first: __m128d,
    factor: Factor,
    tail: __m128d,
    /// What the first term of a cosine has lost.
    lost: __m128d,
}

/// The first term of each half, y or w, and what its tail is multiplied by, w or y.
struct Factor {
    own: __m128d,
    other: __m128d,
}

impl Turn {
    const fn of(halves: [(bool, bool); 2]) -> Self {
        const ZERO: Halves = Halves([0; 2]);
        let mut turn = Self { coefficients: [ZERO; 6], is_sine: ZERO, negated: ZERO, tail_negated: ZERO };
        let mut half = 0;
        while half < 2 {
            let (is_sine, negated) = halves[half];
            let mut term = 0;
            while term < 6 {
                let coefficient = if is_sine { SINE[term] } else { -COSINE[term] };
                let coefficient = if negated { -coefficient } else { coefficient };
                turn.coefficients[term].0[half] = coefficient.to_bits();
                term += 1;
            }
            turn.is_sine.0[half] = if is_sine { u64::MAX } else { 0 };
            turn.negated.0[half] = if negated { SIGN } else { 0 };
            turn.tail_negated.0[half] = if negated == is_sine { SIGN } else { 0 };
            half += 1;
        }
        turn
    }

    #[inline]
    fn by(quadrant: u64) -> &'static Self {
        TURNS.get((quadrant & 3) as usize).unwrap_or(&TURNS[0])
    }

    /// Of y, z, w, the tail and what w has lost.
    #[inline]
    #[target_feature(enable = "sse2")]
    fn parts(&self, [y, z, w, t, lost]: [__m128d; 5]) -> Parts {
        let [is_sine, negated, tail_negated] = [&self.is_sine, &self.negated, &self.tail_negated].map(|of| bits(of));
        let differing = _mm_and_pd(_mm_xor_pd(y, w), is_sine);
        Parts {
            first: _mm_xor_pd(z, _mm_and_pd(_mm_xor_pd(y, z), is_sine)),
            factor: Factor { own: _mm_xor_pd(_mm_xor_pd(w, differing), negated), other: _mm_xor_pd(y, differing) },
            tail: _mm_xor_pd(t, tail_negated),
            // Zero for a sine, whatever its sign: −0 from the rest stays −0.
            lost: _mm_andnot_pd(is_sine, _mm_xor_pd(lost, negated)),
        }
    }
}

#[inline]
#[target_feature(enable = "sse2")]
fn bits(of: &Halves) -> __m128d {
    // SAFETY: sixteen bytes are read of sixteen, at a multiple of sixteen.
    unsafe { _mm_load_pd(of.0.as_ptr().cast()) }
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
        fused_sin_cos, fused_sin_cos_sum, short_fused_sin_cos, short_fused_sin_cos_sum, short_sin_cos,
        short_sin_cos_sum, sin_cos, sin_cos_sum,
    };

    #[test]
    fn halves_have_the_bits_of_one_by_one() {
        let bits = |(sin, cos): (f64, f64)| [sin.to_bits(), cos.to_bits()];
        let turns = (0..200_000).map(|i| f64::from(i) * 0.013_7);
        let small = (0..2000).map(|i| f64::from_bits(0x3FF0_0000_0000_0000 - 0x0001_3579_BDF0_2468 * i));
        for x in turns.chain(small).chain([0.0, 5e-324]) {
            for x in [x, -x] {
                assert_eq!(bits(sin_cos(x)), bits(short_sin_cos(x)), "{x:e}");
                assert_eq!(bits(fused_sin_cos(x)), bits(short_fused_sin_cos(x)), "fused, {x:e}");
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
                    assert_eq!(bits(sin_cos_sum(x, hi, lo)), bits(short_sin_cos_sum(x, hi, lo)), "{hi:e}");
                    let fused = [fused_sin_cos_sum(x, hi, lo), short_fused_sin_cos_sum(x, hi, lo)].map(bits);
                    assert_eq!(fused[0], fused[1], "fused, {hi:e}");
                }
            }
        }
    }
}
