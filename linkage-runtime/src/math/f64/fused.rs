//! Sine and cosine in fused operations.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::fused::{fused_sines, mul_add};
use super::sin_cos::{COSINE, SINE};

/// π/2 in three parts. With the first, of all 53 bits, x − n·π/2 is exact when fused: a multiple of 2⁻⁵³ below 1. The second has 35
/// significant bits, so that its product with |n| ≤ 2¹⁸ is exact; all three together are off by less than 2⁻¹⁴⁵.
const FRAC_PI_2: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.123233995707727e-17, 2.9038559739793605e-28];

/// S and C, added up in pairs (Estrin 1960).
#[inline]
fn polynomials(z: f64) -> (f64, f64) {
    let z2 = z * z;
    let sum = |[c0, c1, c2, c3, c4, c5]: [f64; 6]| {
        let (low, middle, high) = (mul_add(z, c1, c0), mul_add(z, c3, c2), mul_add(z, c5, c4));
        mul_add(z2 * z2, high, mul_add(z2, middle, low))
    };
    (sum(SINE), sum(COSINE))
}

/// Sine and cosine, whichever way is the faster: both have the same bits.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as `sin_cos`")]
fn reduced_sin_cos(reduced: Reduced) -> (f64, f64) {
    #[cfg(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma"))]
    return super::pair::fused_sin_cos(reduced);
    #[cfg(not(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma")))]
    reduced.fused_one_by_one()
}

fused_sines!(f64);
