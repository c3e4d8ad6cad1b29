//! Sine and cosine in the two halves of a register of x86-64: the operations of [`Reduced::one_by_one`], or of the fused ones, each on its
//! number, so the same bits, in half as many instructions. What the quadrant changes stays in the register too.
#![allow(
    unsafe_code,
    reason = "calls of functions that name their instructions, a load of two numbers, a barrier to the compiler"
)]

#[cfg(target_feature = "fma")]
use core::arch::x86_64::_mm_fmadd_pd;
use core::arch::x86_64::{
    __m128d, _mm_add_pd, _mm_and_pd, _mm_cvtsd_f64, _mm_loadu_pd, _mm_mul_pd, _mm_or_pd, _mm_set_pd, _mm_set_sd,
    _mm_set1_pd, _mm_shuffle_pd, _mm_sub_pd, _mm_unpackhi_pd, _mm_unpacklo_pd, _mm_xor_pd,
};

#[cfg(target_feature = "fma")]
use super::mul_add;
use super::sin_cos::{COSINE, Reduced, SINE};

/// See [`Reduced::sin_cos`].
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
pub(super) fn sin_cos(reduced: Reduced) -> (f64, f64) {
    // SAFETY: this module is compiled only where all code may use SSE2.
    unsafe { in_halves(reduced) }
}

/// Sine in the lower half. Of the cosine's sum all terms but the first are carried as negatives, so that both are
/// differences.
#[inline]
#[target_feature(enable = "sse2")]
fn in_halves(Reduced { quadrant, y, t }: Reduced) -> (f64, f64) {
    let y2 = twice(y);
    let z = _mm_mul_pd(y2, y2);
    let z2 = _mm_mul_pd(z, z);
    let half = 0.5 * _mm_cvtsd_f64(z);
    let w = 1.0 - half;
    let ([s0, s1, s2, s3, s4, s5], [c0, c1, c2, c3, c4, c5]) = (SINE, COSINE);
    let p0 = _mm_add_pd(both(s0, -c0), _mm_mul_pd(z, both(s1, -c1)));
    let p1 = _mm_add_pd(both(s2, -c2), _mm_mul_pd(z, both(s3, -c3)));
    let p2 = _mm_add_pd(both(s4, -c4), _mm_mul_pd(z, both(s5, -c5)));
    let p = _mm_add_pd(_mm_add_pd(p0, _mm_mul_pd(z2, p1)), _mm_mul_pd(_mm_mul_pd(z2, z2), p2));
    let first = _mm_mul_pd(z, _mm_unpacklo_pd(y2, z));
    let tail = _mm_mul_pd(_mm_xor_pd(_mm_set1_pd(t), both(0.0, -0.0)), _mm_shuffle_pd::<0b10>(_mm_set_sd(w), y2));
    // −0 changes no number that it is added to.
    let tail = _mm_add_pd(both(-0.0, half - (1.0 - w)), tail);
    let small = _mm_add_pd(_mm_mul_pd(first, p), tail);
    turned(quadrant, _mm_sub_pd(both(y, w), small))
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
    let y2 = twice(y);
    let z = _mm_mul_pd(y2, y2);
    let z2 = _mm_mul_pd(z, z);
    let square = _mm_cvtsd_f64(z);
    let w = mul_add(-0.5, square, 1.0);
    let ([s0, s1, s2, s3, s4, s5], [c0, c1, c2, c3, c4, c5]) = (SINE, COSINE);
    let low = _mm_fmadd_pd(z, both(s1, -c1), both(s0, -c0));
    let middle = _mm_fmadd_pd(z, both(s3, -c3), both(s2, -c2));
    let high = _mm_fmadd_pd(z, both(s5, -c5), both(s4, -c4));
    let p = _mm_fmadd_pd(_mm_mul_pd(z2, z2), high, _mm_fmadd_pd(z2, middle, low));
    let first = _mm_mul_pd(z, _mm_unpacklo_pd(y2, z));
    let rest = both(t * w, mul_add(-y, t, mul_add(0.5, square, w - 1.0)));
    turned(quadrant, _mm_sub_pd(both(y, w), _mm_fmadd_pd(first, p, rest)))
}

/// What a quadrant does to sine and cosine, in bits: which keep their places, which change them, which are negated. From a table, because
/// what is read takes none of the units that calculate.
#[repr(align(16))]
struct Turn {
    kept: [u64; 2],
    exchanged: [u64; 2],
    negated: [u64; 2],
}

const BOTH: [u64; 2] = [u64::MAX; 2];
const NEITHER: [u64; 2] = [0; 2];
const MINUS: u64 = 1 << 63;

static TURNS: [Turn; 4] = [
    Turn { kept: BOTH, exchanged: NEITHER, negated: [0, 0] },
    Turn { kept: NEITHER, exchanged: BOTH, negated: [0, MINUS] },
    Turn { kept: BOTH, exchanged: NEITHER, negated: [MINUS, MINUS] },
    Turn { kept: NEITHER, exchanged: BOTH, negated: [MINUS, 0] },
];

/// Sine and cosine of the reduced angle, exchanged and negated as the quadrant says.
#[inline]
#[target_feature(enable = "sse2")]
fn turned(quadrant: u64, found: __m128d) -> (f64, f64) {
    let Turn { kept, exchanged, negated } = TURNS.get((quadrant & 3) as usize).unwrap_or(&TURNS[0]);
    let other = _mm_shuffle_pd::<0b01>(found, found);
    let turned = _mm_or_pd(_mm_and_pd(found, bits(kept)), _mm_and_pd(other, bits(exchanged)));
    let turned = _mm_xor_pd(turned, bits(negated));
    (_mm_cvtsd_f64(turned), _mm_cvtsd_f64(_mm_unpackhi_pd(turned, turned)))
}

#[inline]
#[target_feature(enable = "sse2")]
fn bits(of: &[u64; 2]) -> __m128d {
    // SAFETY: sixteen bytes are read of sixteen, wherever they stand.
    unsafe { _mm_loadu_pd(core::ptr::from_ref(of).cast()) }
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

/// A number in each half, the first in the lower.
#[inline]
#[target_feature(enable = "sse2")]
fn both(lower: f64, upper: f64) -> __m128d {
    _mm_set_pd(upper, lower)
}

#[cfg(test)]
mod tests {
    use crate::math::f64::{fused_sin_cos, short_fused_sin_cos, short_sin_cos, sin_cos};

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
}
