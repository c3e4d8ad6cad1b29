//! `atan2` in `f64` and `f32`.

use linkage_runtime::math::{f32 as single, f64 as double};

use crate::bounds;
use crate::reference::{Reference, Worst, ulps, ulps_f32};
use crate::sample::Random;

fn check_f64(name: &str, vectors: impl IntoIterator<Item = (f64, f64)>) {
    let (mut reference, mut worst) = (Reference::new(), Worst::default());
    for (y, x) in vectors {
        worst.see(ulps(double::atan2(y, x), &reference.atan2(y, x)), || format!("({y:e}, {x:e})"));
    }
    worst.is_at_most(bounds::ATAN2, &format!("atan2 of f64, {name}"));
}

fn check_f32(name: &str, vectors: impl IntoIterator<Item = (f32, f32)>) {
    let mut worst = Worst::default();
    for (y, x) in vectors {
        let truth = double::atan2(f64::from(y), f64::from(x));
        worst.see(ulps_f32(single::atan2(y, x), truth), || format!("({y:e}, {x:e})"));
    }
    worst.is_at_most(bounds::ATAN2, &format!("atan2 of f32, {name}"));
}

fn random_f64(count: usize) {
    let mut random = Random(21);
    let mut vectors =
        |make: fn(&mut Random) -> (f64, f64)| -> Vec<(f64, f64)> { (0..count).map(|_| make(&mut random)).collect() };
    check_f64("square", vectors(|random| (random.signed(), random.signed())));
    check_f64("any exponents", vectors(|random| (random.finite(), random.finite())));
    check_f64(
        "similar exponents",
        vectors(|random| {
            let exponent = (random.bits() % 2000) as i32 - 1000;
            (random.between_powers(exponent, exponent + 8), random.between_powers(exponent, exponent + 8))
        }),
    );
    check_f64(
        "subnormal numbers",
        vectors(|random| {
            (f64::from_bits(random.bits() >> 12), f64::from_bits(random.bits() >> (12 + random.bits() % 40)))
        }),
    );
    check_f64("subnormal ratios", vectors(|random| (random.between_powers(-60, 0), random.between_powers(1000, 1023))));
    check_f64("tiny and huge", vectors(|random| (random.between_powers(-1060, -980), random.between_powers(-60, 60))));
    check_f64(
        "next to the diagonal",
        vectors(|random| {
            let x = random.between_powers(-2, 2);
            (x * (1.0 + random.between_powers(-52, -2)), x)
        }),
    );
    check_f64(
        "where the octants are split",
        vectors(|random| {
            let x = random.signed();
            (x * (0.4142 + random.between_powers(-30, -5)), -x)
        }),
    );
}

fn random_f32(count: usize) {
    let mut random = Random(22);
    let mut vectors =
        |make: fn(&mut Random) -> (f32, f32)| -> Vec<(f32, f32)> { (0..count).map(|_| make(&mut random)).collect() };
    check_f32("square", vectors(|random| (random.signed() as f32, random.signed() as f32)));
    check_f32(
        "any exponents",
        vectors(|random| (random.between_powers(-149, 127) as f32, random.between_powers(-149, 127) as f32)),
    );
    check_f32(
        "subnormal numbers",
        vectors(|random| (f32::from_bits(random.bits() as u32 >> 9), f32::from_bits(1 + (random.bits() as u32 >> 9)))),
    );
    check_f32(
        "similar exponents",
        vectors(|random| {
            let exponent = (random.bits() % 240) as i32 - 130;
            (random.between_powers(exponent, exponent + 8) as f32, random.between_powers(exponent, exponent + 8) as f32)
        }),
    );
}

#[test]
fn random_vectors_f64() {
    random_f64(1_500);
}

#[test]
fn random_vectors_f32() {
    random_f32(200_000);
}

#[test]
fn all_ratios_f32() {
    let ratios = || (1e-12f32.to_bits()..=1e12f32.to_bits()).step_by(997).map(f32::from_bits);
    check_f32("ratios to 1", ratios().map(|y| (y, 1.0)));
    check_f32("ratios to −3", ratios().map(|y| (y, -3.0)));
    check_f32("ratios to 1 + ε", ratios().map(|y| (-y, 1.0 + f32::EPSILON)));
}

#[test]
fn follows_sin_cos_around_the_circle() {
    for degree in -179..180 {
        let angle = f64::from(degree).to_radians();
        let (sin, cos) = double::sin_cos(angle);
        assert!((double::atan2(sin, cos) - angle).abs() <= 2.0 * f64::EPSILON * angle.abs(), "{degree}°");
        let angle = angle as f32;
        let (sin, cos) = single::sin_cos(angle);
        assert!((single::atan2(sin, cos) - angle).abs() <= 2.0 * f32::EPSILON * angle.abs(), "{degree}°");
    }
}

#[test]
#[ignore = "takes minutes"]
fn random_vectors_f64_many() {
    random_f64(150_000);
}

#[test]
#[ignore = "takes minutes"]
fn random_vectors_f32_many() {
    random_f32(20_000_000);
}

#[test]
#[ignore = "takes minutes"]
fn every_ratio_f32() {
    for x in [1.0f32, 1.25, 1.5, 1.75, 2.0f32.next_down()] {
        check_f32("every ratio", (1e-6f32.to_bits()..=x.to_bits()).map(|y| (f32::from_bits(y), x)));
    }
}
