//! `unit`, `polar` and `sqrt` in `f64` and `f32`.

use linkage_runtime::math::{f32 as single, f64 as double};

use crate::bounds;
use crate::reference::{Real, Reference, Worst, real};
use crate::sample::Random;

const EPSILON: f64 = f64::EPSILON;
const EPSILON_F32: f64 = 1.0 / (1 << 23) as f64;

/// Vectors of all sizes, most with components of similar size.
fn vectors(seed: u64, count: usize, low: i32, high: i32) -> impl Iterator<Item = (f64, f64)> {
    let mut random = Random(seed);
    (0..count).map(move |i| {
        if i % 3 == 0 {
            return (random.between_powers(low, high), random.between_powers(low, high));
        }
        let exponent = low + (random.bits() % (high - low - 4) as u64) as i32;
        (random.between_powers(exponent, exponent + 4), random.between_powers(exponent, exponent + 4))
    })
}

/// |got − truth| of a component in ε of its size, or in 2⁻¹⁰⁷⁴ if it is subnormal.
fn component(got: f64, truth: &Real) -> f64 {
    let error = (real(got) - truth).to_f64().value().abs();
    error / (EPSILON * truth.to_f64().value().abs().max(f64::MIN_POSITIVE))
}

#[test]
fn unit_f64() {
    let (mut reference, mut norms, mut components) = (Reference::new(), Worst::default(), Worst::default());
    for (x, y) in vectors(31, 20_000, -1074, 1024).filter(|(x, y)| x.is_finite() && y.is_finite()) {
        let (unit_x, unit_y) = double::unit(x, y);
        let norm = reference.norm(unit_x, unit_y);
        norms.see(((norm - Real::ONE).to_f64().value() / EPSILON).abs(), || format!("({x:e}, {y:e})"));
        let length = reference.norm(x, y);
        components.see(component(unit_x, &reference.quotient(x, &length)), || format!("x of ({x:e}, {y:e})"));
        components.see(component(unit_y, &reference.quotient(y, &length)), || format!("y of ({x:e}, {y:e})"));
    }
    norms.is_at_most(bounds::UNIT_NORM, "norm of unit, f64, in ε");
    components.is_at_most(bounds::UNIT_COMPONENT, "components of unit, f64, in ε");
}

#[test]
fn unit_f32() {
    let (mut norms, mut components) = (Worst::default(), Worst::default());
    for (x, y) in vectors(32, 1_000_000, -149, 128).map(|(x, y)| (x as f32, y as f32)) {
        if !(x.is_finite() && y.is_finite()) {
            continue;
        }
        let (unit_x, unit_y) = single::unit(x, y);
        norms.see(((f64::from(unit_x).hypot(f64::from(unit_y)) - 1.0) / EPSILON_F32).abs(), || {
            format!("({x:e}, {y:e})")
        });
        let (true_x, true_y) = double::unit(f64::from(x), f64::from(y));
        for (got, truth) in [(unit_x, true_x), (unit_y, true_y)] {
            let size = truth.abs().max(f64::from(f32::MIN_POSITIVE));
            components.see((f64::from(got) - truth).abs() / (EPSILON_F32 * size), || format!("({x:e}, {y:e})"));
        }
    }
    norms.is_at_most(bounds::UNIT_NORM, "norm of unit, f32, in ε");
    components.is_at_most(bounds::UNIT_COMPONENT, "components of unit, f32, in ε");
}

#[test]
fn unit_does_not_depend_on_the_scale() {
    for (x, y) in vectors(33, 1_000, -8, 8) {
        let expected = double::unit(x, y);
        for exponent in (-960..1000).step_by(49) {
            let scale = 2f64.powi(exponent);
            assert_eq!(double::unit(x * scale, y * scale), expected, "({x:e}, {y:e})·2^{exponent}");
        }
        let (x, y) = (x as f32, y as f32);
        let expected = single::unit(x, y);
        for exponent in (-90..110).step_by(7) {
            let scale = 2f32.powi(exponent);
            assert_eq!(single::unit(x * scale, y * scale), expected, "({x:e}, {y:e})·2^{exponent}");
        }
    }
}

#[test]
fn polar_of_both() {
    let (mut reference, mut random) = (Reference::new(), Random(34));
    let (mut worst, mut worst_f32) = (Worst::default(), Worst::default());
    for _ in 0..20_000 {
        let (r, angle) = (random.between_powers(-900, 1000), 400.0 * random.signed());
        let (sin, cos) = reference.sin_cos(&real(angle));
        let (x, y) = double::polar(r, angle);
        worst.see(component(x, &(cos * real(r))), || format!("x of ({r:e}, {angle:e})"));
        worst.see(component(y, &(sin * real(r))), || format!("y of ({r:e}, {angle:e})"));

        let (r, angle) = (random.between_powers(-60, 100) as f32, angle as f32);
        let (x, y) = single::polar(r, angle);
        let (true_x, true_y) = double::polar(f64::from(r), f64::from(angle));
        for (got, truth) in [(x, true_x), (y, true_y)] {
            let size = truth.abs().max(f64::from(f32::MIN_POSITIVE));
            worst_f32.see((f64::from(got) - truth).abs() / (EPSILON_F32 * size), || format!("({r:e}, {angle:e})"));
        }
    }
    worst.is_at_most(bounds::POLAR, "polar of f64, in ε");
    worst_f32.is_at_most(bounds::POLAR, "polar of f32, in ε");
}

#[test]
fn square_roots_are_correctly_rounded() {
    let (mut reference, mut random) = (Reference::new(), Random(35));
    for _ in 0..5_000 {
        let x = random.finite().abs();
        assert_eq!(double::sqrt(x), reference.sqrt(x), "{x:e}");
        let x = f32::from_bits((random.bits() as u32 >> 1).min(f32::MAX.to_bits()));
        assert_eq!(single::sqrt(x), f64::from(x).sqrt() as f32, "{x:e}");
    }
    assert_eq!(double::sqrt(-0.0).to_bits(), (-0.0f64).to_bits());
    assert!(double::sqrt(-1.0).is_nan() && single::sqrt(-1.0).is_nan());
}
