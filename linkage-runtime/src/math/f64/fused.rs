//! Sine and cosine in fused operations, for `arithmetic fused;`: the polynomials of [`sin_cos`](super::sin_cos()), a shorter reduction, and
//! bits of their own, the same on every target.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::fused::mul_add;
use super::large::{reduce_large, reduce_large_sum};
use super::sin_cos::{COSINE, ROUND, Reduced, SINE, by_quadrant, is_short, two_sum};

/// π/2 in three parts. With the first, of all 53 bits, x − n·π/2 is exact when fused: a multiple of 2⁻⁵³ below 1. The second has 35
/// significant bits, so that its product with |n| ≤ 2¹⁸ is exact; all three together are off by less than 2⁻¹⁴⁵.
const FRAC_PI_2: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.123233995707727e-17, 2.9038559739793605e-28];

/// (sin x, cos x), as [`sin_cos`](super::sin_cos()), every product that a sum reads added without being rounded.
///
/// Error: at most 0.82 ulp for every finite x. sin(−0) = −0. NaN if x is not finite.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
#[must_use]
pub fn fused_sin_cos(x: f64) -> (f64, f64) {
    if is_short(x) { reduce(x).fused_sin_cos() } else { large_sin_cos(x) }
}

/// (sin, cos) of the real number x + hi + lo, as [`sin_cos_sum`](super::sin_cos_sum) with its error.
#[inline]
#[must_use]
pub fn fused_sin_cos_sum(x: f64, hi: f64, lo: f64) -> (f64, f64) {
    let (sum, error) = two_sum(x, hi);
    if is_short(sum) { reduce(sum).plus(error + lo).fused_sin_cos() } else { large_sin_cos_sum(sum, error, lo) }
}

#[cold]
#[inline(never)]
fn large_sin_cos(x: f64) -> (f64, f64) {
    reduce_large(x).fused_sin_cos()
}

#[cold]
#[inline(never)]
fn large_sin_cos_sum(x: f64, hi: f64, lo: f64) -> (f64, f64) {
    reduce_large_sum(x, hi, lo).fused_sin_cos()
}

/// [`fused_sin_cos`] without its branch: for angles for which the short reduction serves; elsewhere the numbers mean nothing.
#[doc(hidden)]
#[inline(always)]
#[allow(clippy::inline_always, reason = "for loops that are vectorised")]
#[must_use]
pub fn short_fused_sin_cos(x: f64) -> (f64, f64) {
    reduce(x).fused_sin_cos()
}

/// [`fused_sin_cos_sum`] without its branch: where the short reduction serves for x + hi.
#[doc(hidden)]
#[inline(always)]
#[allow(clippy::inline_always, reason = "for loops that are vectorised")]
#[must_use]
pub fn short_fused_sin_cos_sum(x: f64, hi: f64, lo: f64) -> (f64, f64) {
    let (sum, error) = two_sum(x, hi);
    reduce(sum).plus(error + lo).fused_sin_cos()
}

/// For |x| ≤ 4.1·10⁵. Nothing is lost but by the sums that make y and t.
#[inline]
fn reduce(x: f64) -> Reduced {
    let rounded = mul_add(x, core::f64::consts::FRAC_2_PI, ROUND);
    let n = rounded - ROUND;
    let x1 = mul_add(-n, FRAC_PI_2[0], x);
    let w = n * FRAC_PI_2[1];
    let y = x1 - w;
    let t = mul_add(n, FRAC_PI_2[2], w - (x1 - y));
    Reduced { quadrant: rounded.to_bits(), y, t }
}

impl Reduced {
    /// The polynomials, exchanged and negated as the quadrant says. Every sum is arranged so that −0 stays −0.
    #[inline]
    fn fused_sin_cos(self) -> (f64, f64) {
        let Self { quadrant, y, t } = self;
        let z = y * y;
        let z2 = z * z;
        let sum = |[c0, c1, c2, c3, c4, c5]: [f64; 6]| {
            let (low, middle, high) = (mul_add(z, c1, c0), mul_add(z, c3, c2), mul_add(z, c5, c4));
            mul_add(z2 * z2, high, mul_add(z2, middle, low))
        };
        let (s, c) = (sum(SINE), sum(COSINE));
        let w = mul_add(-0.5, z, 1.0);
        let sin = y - mul_add(z * y, s, t * w);
        let cos = w + mul_add(z2, c, mul_add(y, t, mul_add(-0.5, z, 1.0 - w)));
        by_quadrant(quadrant, sin, cos)
    }
}
