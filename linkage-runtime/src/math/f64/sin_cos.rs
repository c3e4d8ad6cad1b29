//! Sine and cosine together: reduction to |y| ≤ π/4, one polynomial each, and the quadrant.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::large::{reduce_large, reduce_large_sum};
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
use super::pair::plain::{of, short, short_half};

/// Up to here (65 000 turns) the short reduction serves: |n| ≤ 2¹⁸.
const FAST: f64 = 4.1e5;

/// π/2 in three parts. The first two have 35 significant bits, so that their products with |n| ≤ 2¹⁸ are exact;
/// all three together are off by less than 2⁻¹²⁹.
pub(super) const FRAC_PI_2: [f64; 3] = [1.5707963267923333, 2.5633441515839558e-12, 1.0562999066987428e-23];

/// Adding and subtracting 1.5·2⁵² rounds to an integer, whose last bits are then the last bits of the sum.
pub(super) const ROUND: f64 = 6755399441055744.0;

/// The coefficients of S and C, see [`sin_cos`].
pub(super) const SINE: [f64; 6] = [
    0.16666666666666596,
    -0.008333333333314359,
    0.00019841269823970287,
    -2.755731184826506e-6,
    2.5050493313348815e-8,
    -1.588260855736768e-10,
];
pub(super) const COSINE: [f64; 6] = [
    0.041666666666666595,
    -0.0013888888888873342,
    2.4801587289002052e-5,
    -2.755731421702115e-7,
    2.0875705392259066e-9,
    -1.135874897753106e-11,
];

/// An angle of `quadrant`·π/2 + (y − t), with |y| ≤ π/4 and a tail t of about an ulp of y, or 2⁻⁵⁸, at most.
pub(super) struct Reduced {
    pub(super) quadrant: u64,
    pub(super) y: f64,
    pub(super) t: f64,
}

/// (sin x, cos x).
///
/// Reduction with π/2 in three parts and a tail (Cody and Waite 1980, Ng 1992) for |x| ≤ 4.1·10⁵, without a branch;
/// beyond, out of line, the exact product with 2/π in integers (Payne and Hanek 1983). Then sin y = y − y³S(y²) and
/// cos y = 1 − y²/2 + y⁴C(y²), with six coefficients each, added up in pairs (Estrin 1960), found by Remez exchange for
/// the least relative error on |y| ≤ π/4 and rounded one after the other, the rest refitted. S is weighted by 1 + 8(4y/π)⁸, because its rounding
/// errors count most at π/4: 0.063 ulp at most, 0.006 ulp there; C 0.001 ulp.
///
/// Error: at most 0.95 ulp for every finite x, next to multiples of π/2 too. sin(−0) = −0. NaN if x is not finite.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as a call of its own it keeps all else waiting")]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if is_short(x) { short(x) } else { large_sin_cos(x) }
}

/// Out of line to the end, so that nothing of it has to be brought together with what is short.
#[cold]
#[inline(never)]
fn large_sin_cos(x: f64) -> (f64, f64) {
    reduce_large(x).one_by_one()
}

/// (sin x/2, cos x/2): the bits of [`sin_cos`] of `0.5 * x`, whose product the quadrant does not wait for.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
#[must_use]
pub fn sin_cos_half(x: f64) -> (f64, f64) {
    if is_short_half(x) { short_half(x) } else { large_sin_cos(0.5 * x) }
}

/// (sin, cos) of the real number x + hi + lo, which is not rounded before the reduction.
///
/// For a constant hi + lo in two parts, such as a phase: |hi| ≤ 4, |lo| ≤ ulp(hi). The rounding error of x + hi (Knuth's
/// two-sum) goes into the tail of the reduction.
///
/// Error: at most 0.95 ulp plus ε²·max(4, |x|). The second part is below 0.05 ulp wherever the result exceeds
/// 10⁻¹⁴·max(4, |x|); next to a multiple of π/2 it is of the size of what lo itself lacks. NaN if an argument is not
/// finite.
#[inline]
#[must_use]
pub fn sin_cos_sum(x: f64, hi: f64, lo: f64) -> (f64, f64) {
    let (sum, error) = two_sum(x, hi);
    if is_short(sum) { of(reduce(sum).plus(error + lo)) } else { large_sin_cos_sum(sum, error, lo) }
}

#[cold]
#[inline(never)]
fn large_sin_cos_sum(x: f64, hi: f64, lo: f64) -> (f64, f64) {
    reduce_large_sum(x, hi, lo).one_by_one()
}

#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
one_by_one!(f64, one_by_one);
short_angles!(f64);
short_sines!(f64, one_by_one);

/// a + b as a rounded sum and its error, exactly.
#[inline]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_in_sum = sum - a;
    (sum, (a - (sum - b_in_sum)) + (b - b_in_sum))
}

/// For |x| ≤ 4.1·10⁵. Nothing is lost but by the last product and the last difference, which act on the tail.
#[inline]
pub(super) fn reduce(x: f64) -> Reduced {
    reduced(x, rounded(x, core::f64::consts::FRAC_2_PI))
}

/// How many quadrants an angle has, of so many for each radian, rounded in the last bits of a number.
#[inline]
fn rounded(x: f64, per_radian: f64) -> f64 {
    x * per_radian + ROUND
}

/// The same, the number of quadrants being known, rounded in the last bits of a number.
#[inline]
fn reduced(x: f64, rounded: f64) -> Reduced {
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
    pub(super) fn plus(self, small: f64) -> Self {
        let Self { quadrant, y, t } = self;
        let t = t - small;
        let sum = y - t;
        Self { quadrant, y: sum, t: t - (y - sum) }
    }

    /// The polynomials, exchanged and negated as the quadrant says. Every sum is arranged so that −0 stays −0.
    #[inline]
    fn one_by_one(self) -> (f64, f64) {
        let Self { quadrant, y, t } = self;
        let z = y * y;
        let half = 0.5 * z;
        let w = 1.0 - half;
        let (s, c) = (estrin!(z; SINE), estrin!(z; COSINE));
        let sin = y - (z * y * s + t * w);
        let cos = w + (z * z * c + (((1.0 - w) - half) + y * t));
        by_quadrant(quadrant, sin, cos)
    }
}

by_quadrant!(f64, u64);
