//! The angle of a vector: what `atan2!` needs of this scalar.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::atan2::atan2;

/// π/4 in two parts. The first has 22 significant bits: its products with 2, 3 and 4 are exact.
const FRAC_PI_4: [f32; 2] = [0.78539824, -8.146034e-8];

/// The sign, the exponent and the upper 12 bits of the significand.
const UPPER: u32 = !0 << 12;

const TINY: f32 = 1e-5;
const LARGE: f32 = 1e30;
const SMALL: f32 = 1e-18;
const DOWN: f32 = f32::from_bits((127 - 20) << 23);
const UP: f32 = f32::from_bits((127 + 80) << 23);

/// P, by coefficients of least relative error on |q| ≤ √2 − 1, rounded one after the other, the rest refitted: 0.012 ulp.
#[inline]
fn polynomial(z: f32) -> f32 {
    horner!(z; 0.33333316, -0.19998528, 0.14244388, -0.1059912, 0.06089863)
}

atan2!(f32);
