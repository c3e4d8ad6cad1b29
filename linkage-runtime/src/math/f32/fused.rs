//! Sine and cosine in fused operations.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::fused::{fused_sines, mul_addf as mul_add};
#[cfg(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma"))]
use super::pair::fused::{of, short, short_half};
use super::sin_cos;

/// π/2 in three parts. With the first, of all 24 bits and rounded down, x − n·π/2 is exact when fused: a multiple of 2⁻²⁴ below 1. The
/// second has 15 significant bits, so that its product with |n| ≤ 2⁸ is exact, and is positive, so that −0 stays −0; all three together are
/// off by less than 2⁻⁶⁴.
pub(super) const FRAC_PI_2: [f32; 3] = [f32::from_bits(0x3FC9_0FDA), 7.5498974e-8, -1.0746346e-12];

pub(super) const SINE: [f32; 3] = sin_cos::SINE;
pub(super) const COSINE: [f32; 3] = {
    let [c0, c1, c2] = sin_cos::COSINE;
    [-c0, -c1, -c2]
};

/// y³ times the polynomial of y², plus a tail.
#[inline]
fn cubic(y: f32, &[c0, c1, c2]: &[f32; 3], tail: f32) -> f32 {
    let z = y * y;
    mul_add(y * z, mul_add(z, mul_add(z, c2, c1), c0), tail)
}

fused_sines!(f32);
#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2", target_feature = "fma")))]
one_by_one!(f32, fused_one_by_one);
