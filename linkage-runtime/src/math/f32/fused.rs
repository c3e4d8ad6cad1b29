//! Sine and cosine in fused operations, for `arithmetic fused;`: the polynomials of [`sin_cos`](super::sin_cos()), a shorter reduction, and
//! bits of their own, the same on every target.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::fused::mul_addf as mul_add;
use super::large::{reduce_large, reduce_large_sum};
use super::sin_cos::{COSINE, ROUND, Reduced, SINE, by_quadrant, is_short, two_sum};

/// π/2 in three parts. With the first, of all 24 bits and rounded down, x − n·π/2 is exact when fused: a multiple of 2⁻²⁴ below 1. The
/// second has 15 significant bits, so that its product with |n| ≤ 2⁸ is exact, and is positive, so that −0 stays −0; all three together are
/// off by less than 2⁻⁶⁴.
const FRAC_PI_2: [f32; 3] = [f32::from_bits(0x3FC9_0FDA), 7.5498974e-8, -1.0746346e-12];

/// (sin x, cos x), as [`sin_cos`](super::sin_cos()), every product that a sum reads added without being rounded.
///
/// Error: at most 0.82 ulp for every finite x. sin(−0) = −0. NaN if x is not finite.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
#[must_use]
pub fn fused_sin_cos(x: f32) -> (f32, f32) {
    if is_short(x) { reduce(x).fused_sin_cos() } else { large_sin_cos(x) }
}

/// (sin, cos) of the real number x + hi + lo, as [`sin_cos_sum`](super::sin_cos_sum) with its error.
#[inline]
#[must_use]
pub fn fused_sin_cos_sum(x: f32, hi: f32, lo: f32) -> (f32, f32) {
    let (sum, error) = two_sum(x, hi);
    if is_short(sum) { reduce(sum).plus(error + lo).fused_sin_cos() } else { large_sin_cos_sum(sum, error, lo) }
}

#[cold]
#[inline(never)]
fn large_sin_cos(x: f32) -> (f32, f32) {
    reduce_large(x).fused_sin_cos()
}

#[cold]
#[inline(never)]
fn large_sin_cos_sum(x: f32, hi: f32, lo: f32) -> (f32, f32) {
    reduce_large_sum(x, hi, lo).fused_sin_cos()
}

/// [`fused_sin_cos`] without its branch: for angles for which the short reduction serves; elsewhere the numbers mean nothing.
#[doc(hidden)]
#[inline(always)]
#[allow(clippy::inline_always, reason = "for loops that are vectorised")]
#[must_use]
pub fn short_fused_sin_cos(x: f32) -> (f32, f32) {
    reduce(x).fused_sin_cos()
}

/// [`fused_sin_cos_sum`] without its branch: where the short reduction serves for x + hi.
#[doc(hidden)]
#[inline(always)]
#[allow(clippy::inline_always, reason = "for loops that are vectorised")]
#[must_use]
pub fn short_fused_sin_cos_sum(x: f32, hi: f32, lo: f32) -> (f32, f32) {
    let (sum, error) = two_sum(x, hi);
    reduce(sum).plus(error + lo).fused_sin_cos()
}

/// For |x| ≤ 402. Nothing is lost but by the sums that make y and t.
#[inline]
fn reduce(x: f32) -> Reduced {
    let rounded = mul_add(x, core::f32::consts::FRAC_2_PI, ROUND);
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
    fn fused_sin_cos(self) -> (f32, f32) {
        let Self { quadrant, y, t } = self;
        let z = y * y;
        let z2 = z * z;
        let ([s0, s1, s2], [c0, c1, c2]) = (SINE, COSINE);
        let (s, c) = (mul_add(z, mul_add(z, s2, s1), s0), mul_add(z, mul_add(z, c2, c1), c0));
        let w = mul_add(-0.5, z, 1.0);
        let sin = y - mul_add(z * y, s, t * w);
        let cos = w + mul_add(z2, c, mul_add(y, t, mul_add(-0.5, z, 1.0 - w)));
        by_quadrant(quadrant, sin, cos)
    }
}
