//! Sine and cosine: what `plain_sines!` needs of this scalar.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::plain::plain_sines;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
use super::pair::plain::{of, short, short_half};

/// Up to here (64 turns) the short reduction serves: |n| ≤ 2⁸.
const FAST: f32 = 402.0;

/// π/2 in three parts. The first two have 16 and 15 significant bits, so that their products with |n| ≤ 2⁸ are exact;
/// all three together are off by less than 2⁻⁵⁸.
pub(super) const FRAC_PI_2: [f32; 3] = [1.5707703, 2.6063062e-5, 6.0771006e-11];

/// Adding and subtracting 1.5·2²³ rounds to an integer, whose last bits are then the last bits of the sum.
pub(super) const ROUND: f32 = 12582912.0;

/// How many bits the marks of checks leave to the quarter turns of angles that are not far, from −2⁷ to 2⁷.
#[doc(hidden)]
pub const UNMARKED: u32 = 8;

/// The coefficients of S and C, see [`sin_cos`]: of least relative error on |y| ≤ π/4, rounded one after the other, the rest refitted. S is
/// weighted by 1 + 8(4y/π)⁸, because its rounding errors count most at π/4: 0.13 ulp at most, 0.016 ulp there; C 0.002 ulp.
pub(super) const SINE: [f32; 3] = [0.16666646, -0.008331764, 0.00019471647];
pub(super) const COSINE: [f32; 3] = [0.041666646, -0.001388731, 2.4432327e-5];

/// The sum with these coefficients.
#[inline]
fn polynomial(z: f32, [c0, c1, c2]: &[f32; 3]) -> f32 {
    c0 + z * (c1 + z * c2)
}

plain_sines!(f32, u32);
