//! Sine and cosine together: reduction to |y| ≤ π/4, one polynomial each, and the quadrant.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::large::{reduce_large, reduce_large_sum};
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
use super::pair::plain::{of, short, short_half};

/// Up to here (64 turns) the short reduction serves: |n| ≤ 2⁸.
const FAST: f32 = 402.0;

/// π/2 in three parts. The first two have 16 and 15 significant bits, so that their products with |n| ≤ 2⁸ are exact;
/// all three together are off by less than 2⁻⁵⁸.
pub(super) const FRAC_PI_2: [f32; 3] = [1.5707703, 2.6063062e-5, 6.0771006e-11];

/// Adding and subtracting 1.5·2²³ rounds to an integer, whose last bits are then the last bits of the sum.
pub(super) const ROUND: f32 = 12582912.0;

/// The coefficients of S and C, see [`sin_cos`].
pub(super) const SINE: [f32; 3] = [0.16666646, -0.008331764, 0.00019471647];
pub(super) const COSINE: [f32; 3] = [0.041666646, -0.001388731, 2.4432327e-5];

/// An angle of `quadrant`·π/2 + (y − t), with |y| ≤ π/4 and a tail t of about an ulp of y, or 2⁻²⁶, at most.
pub(super) struct Reduced {
    pub(super) quadrant: u32,
    pub(super) y: f32,
    pub(super) t: f32,
}

/// (sin x, cos x).
///
/// Reduction with π/2 in three parts and a tail (Cody and Waite 1980, Ng 1992) for |x| ≤ 402, without a branch; beyond,
/// out of line, the exact product with 2/π in integers (Payne and Hanek 1983). Then sin y = y − y³S(y²) and
/// cos y = 1 − y²/2 + y⁴C(y²), with three coefficients each, found by Remez exchange for the least relative error on
/// |y| ≤ π/4 and rounded one after the other, the rest refitted. S is weighted by 1 + 8(4y/π)⁸, because its rounding
/// errors count most at π/4: 0.13 ulp at most, 0.016 ulp there; C 0.002 ulp.
///
/// Error: at most 0.95 ulp for every finite x, next to multiples of π/2 too. sin(−0) = −0. NaN if x is not finite.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as a call of its own it keeps all else waiting")]
#[must_use]
pub fn sin_cos(x: f32) -> (f32, f32) {
    if is_short(x) { short(x) } else { large_sin_cos(x) }
}

/// Out of line to the end, so that nothing of it has to be brought together with what is short.
#[cold]
#[inline(never)]
fn large_sin_cos(x: f32) -> (f32, f32) {
    reduce_large(x).one_by_one()
}

/// (sin x/2, cos x/2): the bits of [`sin_cos`] of `0.5 * x`, whose product the quadrant does not wait for.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
#[must_use]
pub fn sin_cos_half(x: f32) -> (f32, f32) {
    if is_short_half(x) { short_half(x) } else { large_sin_cos(0.5 * x) }
}

/// (sin, cos) of the real number x + hi + lo, which is not rounded before the reduction.
///
/// For a constant hi + lo in two parts, such as a phase: |hi| ≤ 4, |lo| ≤ ulp(hi). The rounding error of x + hi (Knuth's
/// two-sum) goes into the tail of the reduction.
///
/// Error: at most 0.95 ulp plus ε²·max(4, |x|). The second part is below 0.05 ulp wherever the result exceeds
/// 5·10⁻⁶·max(4, |x|); next to a multiple of π/2 it is of the size of what lo itself lacks. NaN if an argument is not
/// finite.
#[inline]
#[must_use]
pub fn sin_cos_sum(x: f32, hi: f32, lo: f32) -> (f32, f32) {
    let (sum, error) = two_sum(x, hi);
    if is_short(sum) { of(reduce(sum).plus(error + lo)) } else { large_sin_cos_sum(sum, error, lo) }
}

#[cold]
#[inline(never)]
fn large_sin_cos_sum(x: f32, hi: f32, lo: f32) -> (f32, f32) {
    reduce_large_sum(x, hi, lo).one_by_one()
}

#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
one_by_one!(f32, one_by_one);
short_angles!(f32);
short_sines!(f32, one_by_one);

/// a + b as a rounded sum and its error, exactly.
#[inline]
pub(super) fn two_sum(a: f32, b: f32) -> (f32, f32) {
    let sum = a + b;
    let b_in_sum = sum - a;
    (sum, (a - (sum - b_in_sum)) + (b - b_in_sum))
}

/// For |x| ≤ 402. Nothing is lost but by the last product and the last difference, which act on the tail.
#[inline]
pub(super) fn reduce(x: f32) -> Reduced {
    reduced(x, rounded(x, core::f32::consts::FRAC_2_PI))
}

/// How many quadrants an angle has, of so many for each radian, rounded in the last bits of a number.
#[inline]
fn rounded(x: f32, per_radian: f32) -> f32 {
    x * per_radian + ROUND
}

/// The same, the number of quadrants being known, rounded in the last bits of a number.
#[inline]
fn reduced(x: f32, rounded: f32) -> Reduced {
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
    pub(super) fn plus(self, small: f32) -> Self {
        let Self { quadrant, y, t } = self;
        let t = t - small;
        let sum = y - t;
        Self { quadrant, y: sum, t: t - (y - sum) }
    }

    /// The polynomials, exchanged and negated as the quadrant says. Every sum is arranged so that −0 stays −0.
    #[inline]
    fn one_by_one(self) -> (f32, f32) {
        let Self { quadrant, y, t } = self;
        let z = y * y;
        let half = 0.5 * z;
        let w = 1.0 - half;
        let ([s0, s1, s2], [c0, c1, c2]) = (SINE, COSINE);
        let (s, c) = (s0 + z * (s1 + z * s2), c0 + z * (c1 + z * c2));
        let sin = y - (z * y * s + t * w);
        let cos = w + (z * z * c + (((1.0 - w) - half) + y * t));

        by_quadrant(quadrant, sin, cos)
    }
}

by_quadrant!(f32, u32);
