//! The angle of a vector.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

/// π/4 in two parts. The first has 50 significant bits: its products with 2, 3 and 4 are exact.
const FRAC_PI_4: [f64; 2] = [core::f64::consts::FRAC_PI_4, 3.061616997868383e-17];

/// The sign, the exponent and the upper 26 bits of the significand.
const UPPER: u64 = !0 << 27;

/// The angle of the vector (x, y) from the x axis, from −π to π.
///
/// The ratio q of the smaller to the larger magnitude, or (q − 1)/(q + 1) with π/4 added where q > √2 − 1, is divided
/// with its remainder (Dekker 1971), so that it carries no error to speak of. Then atan q = q − q³P(q²), with eleven
/// coefficients found by Remez exchange for the least relative error on |q| ≤ √2 − 1 and rounded one after the other,
/// the rest refitted: 0.012 ulp. The octant adds 0, 1, … 4 times π/4, in two parts.
///
/// Error: at most 0.70 ulp for all finite x and y, whatever their size. Zeros and signs are those of IEEE 754: ±0 for
/// y = ±0 with x ≥ +0, ±π (as an `f64`) for y = ±0 with x ≤ −0. NaN if an argument is not finite.
#[inline]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let steep = y.abs() > x.abs();
    let (small, large) = if steep { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
    let scale = scale(large);
    let small = small * scale;
    let large = if large == 0.0 { 1.0 } else { large * scale };

    let near = small > 0.4142 * large;
    let (numerator, denominator) = if near { (small - large, small + large) } else { (small, large) };
    let quotient = numerator / denominator;
    let rounding = if near {
        // The sums are not exact: what they lost belongs to the remainder.
        (small - (numerator + large)) - quotient * (small - (denominator - large))
    } else {
        0.0
    };
    let remainder = remainder(numerator, quotient, denominator) + rounding;
    // A tiny ratio is its own arctangent; what underflowed in its remainder must go, but NaN must stay.
    let remainder = if quotient.abs() < 1e-9 { 0.0 * remainder } else { remainder };

    let z = quotient * quotient;
    let p = horner!(z; 0.333333333333332, -0.19999999999953622, 0.14285714280191486, -0.11111110782991306,
        0.09090897740974876, -0.07692059885637845, 0.06663100117753122, -0.05847860007581964,
        0.05039171444012682, -0.03806117414693535, 0.01790352223530063);
    // The derivative of the arctangent is 1/(1 + z).
    let tail = remainder / (denominator + z * denominator) - quotient * z * p;

    // The octant: eighths·π/4 ± the arctangent.
    let left = x.is_sign_negative();
    let eighths = if near { 1.0 } else { 0.0 };
    let eighths = if steep { 2.0 - eighths } else { eighths };
    let eighths = if left { 4.0 - eighths } else { eighths };
    let (head, tail) = if steep == left { (quotient, tail) } else { (-quotient, -tail) };
    let base = eighths * FRAC_PI_4[0];
    let sum = base + head;
    let rounding = (base - sum) + head;
    (sum + (rounding + (eighths * FRAC_PI_4[1] + tail))).copysign(y)
}

/// A power of two that keeps the sums, quotients and remainders of `atan2` from overflow and underflow.
#[inline]
fn scale(large: f64) -> f64 {
    const DOWN: f64 = f64::from_bits((1023 - 60) << 52);
    const UP: f64 = f64::from_bits((1023 + 400) << 52);
    if large > 1e300 {
        DOWN
    } else if large < 1e-200 {
        UP
    } else {
        1.0
    }
}

/// What the rounded quotient leaves of the numerator, in halves of significands whose products are exact.
#[inline]
fn remainder(numerator: f64, quotient: f64, denominator: f64) -> f64 {
    let q = f64::from_bits(quotient.to_bits() & UPPER);
    let d = f64::from_bits(denominator.to_bits() & UPPER);
    let (q_rest, d_rest) = (quotient - q, denominator - d);
    numerator - q * d - q * d_rest - q_rest * d - q_rest * d_rest
}
