//! Sine and cosine: what `plain_sines!` needs of this scalar.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::plain::plain_sines;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
use super::pair::plain::{of, short, short_half};

/// Up to here (65 000 turns) the short reduction serves: |n| ≤ 2¹⁸.
const FAST: f64 = 4.1e5;

/// π/2 in three parts. The first two have 35 significant bits, so that their products with |n| ≤ 2¹⁸ are exact;
/// all three together are off by less than 2⁻¹²⁹.
pub(super) const FRAC_PI_2: [f64; 3] = [1.5707963267923333, 2.5633441515839558e-12, 1.0562999066987428e-23];

/// Adding and subtracting 1.5·2⁵² rounds to an integer, whose last bits are then the last bits of the sum.
pub(super) const ROUND: f64 = 6755399441055744.0;

/// How many bits the marks of checks leave to the quarter turns of angles that are not far, from −2¹⁷ to 2¹⁷.
#[doc(hidden)]
pub const UNMARKED: u32 = 18;

/// The coefficients of S and C, see [`sin_cos`]: of least relative error on |y| ≤ π/4, rounded one after the other, the rest refitted. S is
/// weighted by 1 + 8(4y/π)⁸, because its rounding errors count most at π/4: 0.063 ulp at most, 0.006 ulp there; C 0.001 ulp.
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

/// The sum with these coefficients, in pairs that do not wait for each other (Estrin 1960).
#[inline]
fn polynomial(z: f64, [c0, c1, c2, c3, c4, c5]: &[f64; 6]) -> f64 {
    let z2 = z * z;
    ((c0 + z * c1) + z2 * (c2 + z * c3)) + (z2 * z2) * (c4 + z * c5)
}

plain_sines!(f64, u64);
