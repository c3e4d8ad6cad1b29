//! The angle of a vector: what `atan2!` needs of this scalar.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

use super::super::atan2::atan2;

/// π/4 in two parts. The first has 50 significant bits: its products with 2, 3 and 4 are exact.
const FRAC_PI_4: [f64; 2] = [core::f64::consts::FRAC_PI_4, 3.061616997868383e-17];

/// The sign, the exponent and the upper 26 bits of the significand.
const UPPER: u64 = !0 << 27;

const TINY: f64 = 1e-9;
const LARGE: f64 = 1e300;
const SMALL: f64 = 1e-200;
const DOWN: f64 = f64::from_bits((1023 - 60) << 52);
const UP: f64 = f64::from_bits((1023 + 400) << 52);

/// P, by coefficients of least relative error on |q| ≤ √2 − 1, rounded one after the other, the rest refitted: 0.012 ulp.
#[inline]
fn polynomial(z: f64) -> f64 {
    horner!(z; 0.333333333333332, -0.19999999999953622, 0.14285714280191486, -0.11111110782991306,
        0.09090897740974876, -0.07692059885637845, 0.06663100117753122, -0.05847860007581964,
        0.05039171444012682, -0.03806117414693535, 0.01790352223530063)
}

atan2!(f64);
