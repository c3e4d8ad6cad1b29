//! Sine and cosine in fused operations.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::fused::{fused_sines, mul_addf as mul_add};
use super::sin_cos::{COSINE, SINE};

/// π/2 in three parts. With the first, of all 24 bits and rounded down, x − n·π/2 is exact when fused: a multiple of 2⁻²⁴ below 1. The
/// second has 15 significant bits, so that its product with |n| ≤ 2⁸ is exact, and is positive, so that −0 stays −0; all three together are
/// off by less than 2⁻⁶⁴.
const FRAC_PI_2: [f32; 3] = [f32::from_bits(0x3FC9_0FDA), 7.5498974e-8, -1.0746346e-12];

/// S and C.
#[inline]
fn polynomials(z: f32) -> (f32, f32) {
    let sum = |[c0, c1, c2]: [f32; 3]| mul_add(z, mul_add(z, c2, c1), c0);
    (sum(SINE), sum(COSINE))
}

#[inline]
fn reduced_sin_cos(reduced: Reduced) -> (f32, f32) {
    reduced.fused_one_by_one()
}

fused_sines!(f32);
