//! Reduction of large angles: the exact product with 2/π, in integers.
//!
//! Where a shift depends on the argument it is written as a rotation: shifts bring a check, and with it a panic, into
//! builds without optimisation.
#![allow(clippy::cast_possible_truncation, reason = "the upper or lower half of a product is meant")]
#![allow(clippy::cast_precision_loss, reason = "integers below 2²⁴ are exact, and a tail may be rounded")]

use super::sin_cos::{Reduced, reduce, two_sum};

/// π/2 · 2³¹.
const FRAC_PI_2: u32 = 0xC90F_DAA2;

/// The bit of an `f32` that is its sign, and those that are its fraction.
const SIGN: u32 = 1 << 31;
const FRACTION: u32 = (1 << 23) - 1;

/// For any |x| ≥ 1; NaN if x is not finite.
///
/// x = m·2ᵉ with an integer m < 2²⁴ (Payne and Hanek 1983). Digits of 2/π whose product with x is a multiple of 4 are
/// skipped; m times the next 96 has the quadrant in its two leading bits and the fraction of a quadrant below them. No
/// `f32` comes closer than 2⁻³⁰ to a multiple of π/2, so that of the 62 bits of fraction that are kept 32 count.
#[cold]
pub(super) fn reduce_large(x: f32) -> Reduced {
    let exponent = (x.to_bits() & !SIGN) >> 23;
    if exponent == 0xFF {
        return Reduced { quadrant: 0, y: f32::NAN, t: f32::NAN };
    }
    let m = (x.to_bits() & FRACTION) | (FRACTION + 1);
    let digits = digits_from(exponent.wrapping_sub(120));
    let low = product(m, digits[2]);
    let middle = product(m, digits[1]).wrapping_add(low >> 32);
    let high = m.wrapping_mul(digits[0]).wrapping_add((middle >> 32) as u32);
    let turned = u64::from(high) << 32 | u64::from(middle as u32);

    // The quadrant rounded, and what remains: from −1/2 to 1/2, as a normalised magnitude and its sign.
    let quadrant = high.wrapping_add(1 << 29) >> 30;
    let remains = (turned << 2).cast_signed();
    let zeros = remains.unsigned_abs().leading_zeros();
    let magnitude = remains.unsigned_abs().rotate_left(zeros);

    // Times π/2: the upper 24 bits rounded, and by how much they are too large.
    let angle = product((magnitude >> 32) as u32, FRAC_PI_2);
    let y = angle.wrapping_add(1 << 39) >> 40;
    let t = (y << 40).wrapping_sub(angle).cast_signed() >> 16;
    let ulp = f32::from_bits(104_u32.wrapping_sub(zeros) << 23);
    let (y, t) = (y as u32 as f32 * ulp, t as i32 as f32 * (ulp * TWO_POW_MINUS_24));

    let (y, t) = if remains < 0 { (-y, -t) } else { (y, t) };
    if x < 0.0 { Reduced { quadrant: quadrant.wrapping_neg(), y: -y, t: -t } } else { Reduced { quadrant, y, t } }
}

/// 2⁻²⁴.
const TWO_POW_MINUS_24: f32 = 1.0 / (1_u32 << 24) as f32;

/// The sum + error + lo for a sum beyond the short reduction, whose error may be as large as the constant.
#[cold]
pub(super) fn reduce_large_sum(sum: f32, error: f32, lo: f32) -> Reduced {
    let large = reduce_large(sum);
    let (near, rest) = two_sum(large.y, error);
    let small = reduce(near).plus(rest + (lo - large.t));
    Reduced { quadrant: large.quadrant.wrapping_add(small.quadrant), ..small }
}

/// The exact product.
fn product(a: u32, b: u32) -> u64 {
    u64::from(a).wrapping_mul(u64::from(b))
}

/// 96 bits of 2/π from the given bit of the table on.
fn digits_from(bit: u32) -> [u32; 3] {
    let (word, shift) = (bit >> 5, bit & 31);
    let join = |a: u32, b: u32| ((u64::from(a) << 32 | u64::from(b)).rotate_left(shift) >> 32) as u32;
    let (a, b) = (digits(word), digits(word.wrapping_add(1)));
    let (c, d) = (digits(word.wrapping_add(2)), digits(word.wrapping_add(3)));
    [join(a, b), join(b, c), join(c, d)]
}

/// 2/π in words of 32 bits after a word of zeros. A `match`, because an index would bring a panic into builds without
/// optimisation; it becomes the same table.
fn digits(word: u32) -> u32 {
    match word {
        1 => 0xA2F9_836E,
        2 => 0x4E44_1529,
        3 => 0xFC27_57D1,
        4 => 0xF534_DDC0,
        5 => 0xDB62_9599,
        6 => 0x3C43_9041,
        7 => 0xFE51_63AB,
        _ => 0,
    }
}
