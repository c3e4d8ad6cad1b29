//! The bits of all functions over a fixed sample. A change here is a change of what every user computes: it belongs in
//! the changelog.

use linkage_runtime::math::{f32 as single, f64 as double};

use crate::sample::Random;

/// FNV-1a over the results, 64 bits each.
struct Hash(u64);

impl Hash {
    fn of<T>(seed: u64, mut results: impl FnMut(&mut Random) -> T, bits: impl Fn(T) -> [u64; 2]) -> u64 {
        let (mut random, mut hash) = (Random(seed), Self(0xCBF2_9CE4_8422_2325));
        for _ in 0..20_000 {
            for byte in bits(results(&mut random)).into_iter().flat_map(u64::to_le_bytes) {
                hash.0 = (hash.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
            }
        }
        hash.0
    }
}

fn pair((a, b): (f64, f64)) -> [u64; 2] {
    [a.to_bits(), b.to_bits()]
}

fn pair_f32((a, b): (f32, f32)) -> [u64; 2] {
    [u64::from(a.to_bits()), u64::from(b.to_bits())]
}

/// Three of four angles within a hundred turns, the others of any size.
fn angle(random: &mut Random) -> f64 {
    if random.bits().is_multiple_of(4) { random.between_powers(-1022, 1023) } else { 628.0 * random.signed() }
}

fn angle_f32(random: &mut Random) -> f32 {
    if random.bits().is_multiple_of(4) {
        random.between_powers(-126, 127) as f32
    } else {
        (628.0 * random.signed()) as f32
    }
}

#[test]
fn bits_of_f64() {
    let hashes = [
        Hash::of(1, |random| double::sin_cos(angle(random)), pair),
        Hash::of(2, |random| double::sin_cos_sum(angle(random), random.signed(), 1e-17 * random.signed()), pair),
        Hash::of(3, |random| (double::atan2(random.finite(), random.finite()), 0.0), pair),
        Hash::of(4, |random| (double::atan2(random.signed(), random.signed()), 0.0), pair),
        Hash::of(5, |random| double::unit(random.signed(), random.signed()), pair),
        Hash::of(6, |random| double::polar(random.signed(), angle(random)), pair),
        Hash::of(1, |random| double::fused_sin_cos(angle(random)), pair),
        Hash::of(2, |random| double::fused_sin_cos_sum(angle(random), random.signed(), 1e-17 * random.signed()), pair),
    ];
    let pinned = [
        0xA729_7BAE_3813_A92C,
        0x9A27_209D_39B8_9488,
        0x3049_C228_8AAC_E864,
        0x3EA2_5F75_3044_C477,
        0x23EA_CDDF_90C3_D9FB,
        0x9593_89C8_8FF9_49E3,
        0x177E_1A9B_AC86_EF73,
        0xF1DC_8A26_EE1F_A9EA,
    ];
    assert_eq!(hashes, pinned, "{hashes:#X?}");
}

#[test]
fn bits_of_f32() {
    let single = |random: &mut Random| random.signed() as f32;
    let hashes = [
        Hash::of(1, |random| single::sin_cos(angle_f32(random)), pair_f32),
        Hash::of(2, |random| single::sin_cos_sum(angle_f32(random), single(random), 1e-8 * single(random)), pair_f32),
        Hash::of(3, |random| (single::atan2(angle_f32(random), angle_f32(random)), 0.0), pair_f32),
        Hash::of(4, |random| (single::atan2(single(random), single(random)), 0.0), pair_f32),
        Hash::of(5, |random| single::unit(single(random), single(random)), pair_f32),
        Hash::of(6, |random| single::polar(single(random), angle_f32(random)), pair_f32),
        Hash::of(1, |random| single::fused_sin_cos(angle_f32(random)), pair_f32),
        Hash::of(
            2,
            |random| single::fused_sin_cos_sum(angle_f32(random), single(random), 1e-8 * single(random)),
            pair_f32,
        ),
    ];
    let pinned = [
        0xD9A7_2E17_3351_DBB8,
        0xAF70_A6A7_5C09_1C4E,
        0x6C59_23FB_98F8_ACF1,
        0x4169_0337_EFE5_A823,
        0xB8E3_C961_BB4C_A400,
        0x207C_37C7_9266_E64F,
        0x9BE1_4395_C856_F906,
        0x8DD2_7A43_6ABA_AAB4,
    ];
    assert_eq!(hashes, pinned, "{hashes:#X?}");
}
