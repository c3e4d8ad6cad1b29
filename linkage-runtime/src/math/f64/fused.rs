//! Sine and cosine in fused operations.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::fused::{fused_sines, mul_add};
#[cfg(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma"))]
use super::pair::fused::{of, short, short_half};
use super::sin_cos;

/// π/2 in three parts. With the first, of all 53 bits, x − n·π/2 is exact when fused: a multiple of 2⁻⁵³ below 1. The second has 35
/// significant bits, so that its product with |n| ≤ 2¹⁸ is exact; all three together are off by less than 2⁻¹⁴⁵.
pub(super) const FRAC_PI_2: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.123233995707727e-17, 2.9038559739793605e-28];

pub(super) const SINE: [f64; 6] = sin_cos::SINE;
pub(super) const COSINE: [f64; 6] = {
    let [c0, c1, c2, c3, c4, c5] = sin_cos::COSINE;
    [-c0, -c1, -c2, -c3, -c4, -c5]
};

/// y³ times the polynomial of y², which is added up in pairs, plus a tail.
#[inline]
fn cubic(y: f64, &[c0, c1, c2, c3, c4, c5]: &[f64; 6], tail: f64) -> f64 {
    let z = y * y;
    let z2 = z * z;
    let (low, middle, high) = (mul_add(z, c1, c0), mul_add(z, c3, c2), mul_add(z, c5, c4));
    mul_add(y * z, mul_add(z2, mul_add(z2, high, middle), low), tail)
}

fused_sines!(f64);
#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma")))]
one_by_one!(f64, fused_one_by_one);
