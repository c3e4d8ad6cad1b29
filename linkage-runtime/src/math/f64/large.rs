//! Reduction of large angles: the exact product with 2/π, in integers.
//!
//! Where a shift depends on the argument it is written as a rotation: shifts bring a check, and with it a panic, into
//! builds without optimisation.
#![allow(clippy::cast_possible_truncation, reason = "the upper or lower half of a product is meant")]
#![allow(clippy::cast_precision_loss, reason = "integers below 2⁵³ are exact")]

use super::sin_cos::{Reduced, reduce, two_sum};

/// π/2 · 2⁶³.
const FRAC_PI_2: u64 = 0xC90F_DAA2_2168_C235;

/// The bit of an `f64` that is its sign, and those that are its fraction.
const SIGN: u64 = 1 << 63;
const FRACTION: u64 = (1 << 52) - 1;

/// For any |x| ≥ 1; NaN if x is not finite.
///
/// x = m·2ᵉ with an integer m < 2⁵³ (Payne and Hanek 1983). Digits of 2/π whose product with x is a multiple of 4 are
/// skipped; m times the next 192 has the quadrant in its two leading bits and the fraction of a quadrant below them. No
/// `f64` comes closer than 2⁻⁶² to a multiple of π/2, so that of the 126 bits of fraction that are kept 64 count.
#[cold]
pub(super) fn reduce_large(x: f64) -> Reduced {
    let exponent = (x.to_bits() & !SIGN) >> 52;
    if exponent == 0x7FF {
        return Reduced { quadrant: 0, y: f64::NAN, t: f64::NAN };
    }
    let m = (x.to_bits() & FRACTION) | (FRACTION + 1);
    let digits = digits_from(exponent.wrapping_sub(1013));
    let low = product(m, digits[2]);
    let middle = product(m, digits[1]).wrapping_add(low >> 64);
    let high = m.wrapping_mul(digits[0]).wrapping_add((middle >> 64) as u64);
    let turned = u128::from(high) << 64 | u128::from(middle as u64);

    // The quadrant rounded, and what remains: from −1/2 to 1/2, as a normalised magnitude and its sign.
    let quadrant = high.wrapping_add(1 << 61) >> 62;
    let remains = (turned << 2).cast_signed();
    let zeros = remains.unsigned_abs().leading_zeros();
    let magnitude = remains.unsigned_abs().rotate_left(zeros);

    // Times π/2: the upper 53 bits rounded, and by how much they are too large.
    let angle = product((magnitude >> 64) as u64, FRAC_PI_2);
    let y = angle.wrapping_add(1 << 74) >> 75;
    let t = (y << 75).wrapping_sub(angle).cast_signed() >> 32;
    let ulp = f64::from_bits(u64::from(971_u32.wrapping_sub(zeros)) << 52);
    let (y, t) = (y as u64 as f64 * ulp, t as i64 as f64 * (ulp * TWO_POW_MINUS_43));

    let (y, t) = if remains < 0 { (-y, -t) } else { (y, t) };
    if x < 0.0 { Reduced { quadrant: quadrant.wrapping_neg(), y: -y, t: -t } } else { Reduced { quadrant, y, t } }
}

/// 2⁻⁴³.
const TWO_POW_MINUS_43: f64 = 1.0 / (1_u64 << 43) as f64;

/// The sum + error + lo for a sum beyond the short reduction, whose error may be as large as the constant.
#[cold]
pub(super) fn reduce_large_sum(sum: f64, error: f64, lo: f64) -> Reduced {
    let large = reduce_large(sum);
    let (near, rest) = two_sum(large.y, error);
    let small = reduce(near).plus(rest + (lo - large.t));
    Reduced { quadrant: large.quadrant.wrapping_add(small.quadrant), ..small }
}

/// The exact product.
fn product(a: u64, b: u64) -> u128 {
    u128::from(a).wrapping_mul(u128::from(b))
}

/// 192 bits of 2/π from the given bit of the table on.
fn digits_from(bit: u64) -> [u64; 3] {
    let (word, shift) = (bit >> 6, bit as u32 & 63);
    let join = |a: u64, b: u64| ((u128::from(a) << 64 | u128::from(b)).rotate_left(shift) >> 64) as u64;
    let (a, b) = (digits(word), digits(word.wrapping_add(1)));
    let (c, d) = (digits(word.wrapping_add(2)), digits(word.wrapping_add(3)));
    [join(a, b), join(b, c), join(c, d)]
}

/// 2/π in words of 64 bits after a word of zeros. A `match`, because an index would bring a panic into builds without
/// optimisation; it becomes the same table.
fn digits(word: u64) -> u64 {
    match word {
        1 => 0xA2F9_836E_4E44_1529,
        2 => 0xFC27_57D1_F534_DDC0,
        3 => 0xDB62_9599_3C43_9041,
        4 => 0xFE51_63AB_DEBB_C561,
        5 => 0xB724_6E3A_424D_D2E0,
        6 => 0x0649_2EEA_09D1_921C,
        7 => 0xFE1D_EB1C_B129_A73E,
        8 => 0xE882_35F5_2EBB_4484,
        9 => 0xE99C_7026_B45F_7E41,
        10 => 0x3991_D639_8353_39F4,
        11 => 0x9C84_5F8B_BDF9_283B,
        12 => 0x1FF8_97FF_DE05_980F,
        13 => 0xEF2F_118B_5A0A_6D1F,
        14 => 0x6D36_7ECF_27CB_09B7,
        15 => 0x4F46_3F66_9E5F_EA2D,
        16 => 0x7527_BAC7_EBE5_F17B,
        17 => 0x3D07_39F7_8A52_92EA,
        18 => 0x6BFB_5FB1_1F8D_5D08,
        19 => 0x5603_3046_FC7B_6BAB,
        _ => 0,
    }
}
