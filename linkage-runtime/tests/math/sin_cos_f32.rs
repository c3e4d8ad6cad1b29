//! `math::f32::sin_cos` and `sin_cos_sum`, and both in fused operations, against those of `f64`.

use linkage_runtime::math::{f32 as single, f64 as double};

use crate::bounds;
use crate::reference::{Worst, ulps_f32};
use crate::sample::Random;

/// The `f32` of the largest bit pattern that is a number.
const LAST: u32 = f32::MAX.to_bits();
/// About where the short reduction ends.
const BORDER: f32 = 402.0;

fn check(name: &str, patterns: impl IntoIterator<Item = u32>) {
    check_mirrored(name, patterns, 1);
}

/// Of every so-many-th also its opposite.
fn check_mirrored(name: &str, patterns: impl IntoIterator<Item = u32>, every: u32) {
    let mut worst = <[Worst; 4]>::default();
    for pattern in patterns {
        let x = f32::from_bits(pattern);
        let truth = double::sin_cos(f64::from(x));
        for (functions, of) in worst.chunks_exact_mut(2).zip([single::sin_cos, single::fused_sin_cos]) {
            let (sin, cos) = of(x);
            functions[0].see(ulps_f32(sin, truth.0), || format!("{x:e}"));
            functions[1].see(ulps_f32(cos, truth.1), || format!("{x:e}"));
            if pattern % every == 0 {
                let (mirrored_sin, mirrored_cos) = of(-x);
                let mirrored = (mirrored_sin.to_bits(), mirrored_cos.to_bits());
                assert_eq!(mirrored, ((-sin).to_bits(), cos.to_bits()), "{x:e}");
            }
        }
    }
    let [plain, fused] = [bounds::SIN_COS, bounds::FUSED_SIN_COS];
    let promised = [("sin", plain), ("cos", plain), ("fused sin", fused), ("fused cos", fused)];
    for (worst, (what, bound)) in worst.iter().zip(promised) {
        worst.is_at_most(bound, &format!("{what}, {name}"));
    }
}

fn sums(count: usize) {
    let mut random = Random(11);
    let mut check = |name: &str, make: &mut dyn FnMut(&mut Random, f32) -> f32| {
        let mut worst = <[Worst; 2]>::default();
        for _ in 0..count {
            let hi = (4.0 * random.signed()) as f32;
            let lo = hi * (random.signed() as f32) * f32::EPSILON;
            let x = make(&mut random, hi);
            let (true_sin, true_cos) = double::sin_cos_sum(f64::from(x), f64::from(hi), f64::from(lo));
            let allowed = bounds::SUM_ALLOWANCE * f64::from(f32::EPSILON).powi(2) * f64::from(x.abs()).max(4.0);
            for (worst, sum) in worst.iter_mut().zip([single::sin_cos_sum, single::fused_sin_cos_sum]) {
                let (sin, cos) = sum(x, hi, lo);
                for (got, truth) in [(sin, true_sin), (cos, true_cos)] {
                    let ulp = f64::from((truth as f32).abs().next_up() - (truth as f32).abs());
                    worst.see(ulps_f32(got, truth) - allowed / ulp, || format!("{x:e} + {hi:e} + {lo:e}"));
                }
            }
        }
        worst[0].is_at_most(bounds::SIN_COS, &format!("sums, {name}"));
        worst[1].is_at_most(bounds::FUSED_SIN_COS, &format!("fused sums, {name}"));
    };
    check("two turns", &mut |random, _| (12.0 * random.signed()) as f32);
    check("short reduction", &mut |random, _| (402.0 * random.signed()) as f32);
    check("any exponent", &mut |random, _| random.between_powers(-149, 128) as f32);
    check("where the constant shows", &mut |random, _| random.between_powers(10, 30) as f32);
    check("close to multiples of π/2", &mut |random, hi| {
        let near = std::f64::consts::FRAC_PI_2 * (random.bits() % 64) as f64 - f64::from(hi);
        f32::from_bits((near as f32).to_bits().wrapping_add((random.bits() % 3) as u32))
    });
}

#[test]
fn spread_over_all_numbers() {
    check("all numbers", (0..=LAST).step_by(1999));
}

#[test]
fn where_angles_are() {
    check("from 1/8 to 7", (0.125f32.to_bits()..=7f32.to_bits()).step_by(43));
    check("short reduction", (7f32.to_bits()..=BORDER.to_bits()).step_by(97));
    check("border of the short reduction", BORDER.to_bits() - 50_000..=BORDER.to_bits() + 50_000);
}

#[test]
fn next_to_multiples_of_half_pi() {
    let near = (1..200_000).map(|n| (f64::from(n) * std::f64::consts::FRAC_PI_2) as f32);
    check("next to quarter turns", near.flat_map(|x| x.to_bits() - 2..=x.to_bits() + 2));
}

#[test]
fn random_sums() {
    sums(300_000);
}

#[test]
#[ignore = "takes minutes"]
fn every_number() {
    // In parts, as many at once as there are processors.
    let parts = u32::try_from(std::thread::available_parallelism().map_or(1, std::num::NonZero::get)).unwrap_or(1);
    std::thread::scope(|scope| {
        for first in 0..parts {
            scope.spawn(move || {
                let of = |numbers: std::ops::RangeInclusive<u32>| numbers.skip(first as usize).step_by(parts as usize);
                check_mirrored("every number of the short reduction", of(0..=BORDER.to_bits()), 16 + 1);
                check_mirrored("every number beyond", of(BORDER.to_bits()..=LAST), 16 + 1);
            });
        }
    });
}

#[test]
#[ignore = "takes minutes"]
fn random_sums_many() {
    sums(100_000_000);
}
