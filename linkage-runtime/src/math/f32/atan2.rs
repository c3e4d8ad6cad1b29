//! The angle of a vector.
#![allow(clippy::unreadable_literal, reason = "coefficients are shortest decimals of exact bit patterns")]

/// π/4 in two parts. The first has 22 significant bits: its products with 2, 3 and 4 are exact.
const FRAC_PI_4: [f32; 2] = [0.78539824, -8.146034e-8];

/// The sign, the exponent and the upper 12 bits of the significand.
const UPPER: u32 = !0 << 12;

/// The angle of the vector (x, y) from the x axis, from −π to π.
///
/// The ratio q of the smaller to the larger magnitude, or (q − 1)/(q + 1) with π/4 added where q > √2 − 1, is divided
/// with its remainder (Dekker 1971), so that it carries no error to speak of. Then atan q = q − q³P(q²), with five
/// coefficients found by Remez exchange for the least relative error on |q| ≤ √2 − 1 and rounded one after the other,
/// the rest refitted: 0.012 ulp. The octant adds 0, 1, … 4 times π/4, in two parts.
///
/// Error: at most 0.70 ulp for all finite x and y, whatever their size. Zeros and signs are those of IEEE 754: ±0 for
/// y = ±0 with x ≥ +0, ±π (as an `f32`) for y = ±0 with x ≤ −0. NaN if an argument is not finite.
#[inline]
#[must_use]
pub fn atan2(y: f32, x: f32) -> f32 {
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
    let remainder = if quotient.abs() < 1e-5 { 0.0 * remainder } else { remainder };

    let z = quotient * quotient;
    let p = horner!(z; 0.33333316, -0.19998528, 0.14244388, -0.1059912, 0.06089863);
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
fn scale(large: f32) -> f32 {
    const DOWN: f32 = f32::from_bits((127 - 20) << 23);
    const UP: f32 = f32::from_bits((127 + 80) << 23);
    if large > 1e30 {
        DOWN
    } else if large < 1e-18 {
        UP
    } else {
        1.0
    }
}

/// What the rounded quotient leaves of the numerator, in halves of significands whose products are exact.
#[inline]
fn remainder(numerator: f32, quotient: f32, denominator: f32) -> f32 {
    let q = f32::from_bits(quotient.to_bits() & UPPER);
    let d = f32::from_bits(denominator.to_bits() & UPPER);
    let (q_rest, d_rest) = (quotient - q, denominator - d);
    numerator - q * d - q * d_rest - q_rest * d - q_rest * d_rest
}
