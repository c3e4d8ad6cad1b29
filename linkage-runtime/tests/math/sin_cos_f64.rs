//! `math::f64::sin_cos` and `sin_cos_sum`, and both in fused operations.

use linkage_runtime::math::f64::{fused_sin_cos, fused_sin_cos_sum, sin_cos, sin_cos_sum};

use crate::bounds;
use crate::reference::{Real, Reference, Worst, real, ulps};
use crate::sample::Random;

/// The largest number of quarter turns of the short reduction, and about where it ends.
const FAST_QUARTERS: u64 = 261_014;

fn check(name: &str, arguments: impl IntoIterator<Item = f64>) {
    let (mut reference, mut worst) = (Reference::new(), <[Worst; 4]>::default());
    for x in arguments {
        let (true_sin, true_cos) = reference.sin_cos(&real(x));
        let ((sin, cos), (fused_sin, fused_cos)) = (sin_cos(x), fused_sin_cos(x));
        let found = [(sin, &true_sin), (cos, &true_cos), (fused_sin, &true_sin), (fused_cos, &true_cos)];
        for (worst, (got, truth)) in worst.iter_mut().zip(found) {
            worst.see(ulps(got, truth), || format!("{x:e}"));
        }
    }
    let [plain, fused] = [bounds::SIN_COS, bounds::FUSED_SIN_COS];
    let promised = [("sin", plain), ("cos", plain), ("fused sin", fused), ("fused cos", fused)];
    for (worst, (what, bound)) in worst.iter().zip(promised) {
        worst.is_at_most(bound, &format!("{what}, {name}"));
    }
}

fn near_multiples(quarters: impl Iterator<Item = u64>) -> impl Iterator<Item = f64> {
    let mut reference = Reference::new();
    quarters.flat_map(move |n| {
        let x = reference.multiple_of_half_pi(n);
        [x, x.next_up(), -x.next_down()]
    })
}

fn random_ranges(count: usize) {
    let mut random = Random(1);
    let mut uniform = |range: f64| -> Vec<f64> { (0..count).map(|_| range * random.signed()).collect() };
    check("first octant", uniform(std::f64::consts::FRAC_PI_4));
    check("two turns", uniform(4.0 * std::f64::consts::PI));
    check("short reduction", uniform(4.1e5));
    check("just beyond it", uniform(1e6));
    let mut random = Random(2);
    check("any exponent", (0..count / 2).map(|_| random.finite()));
    check("beyond 1", (0..count / 2).map(|_| random.between_powers(0, 1023)));
    check("small", (0..count / 2).map(|_| random.between_powers(-60, 0)));
}

fn sums(count: usize) {
    let mut random = Random(3);
    check_sums("two turns", (0..count).map(|_| (12.0 * random.signed(), phase(&mut Random(random.bits())))));
    check_sums("short reduction", (0..count).map(|_| (4.1e5 * random.signed(), phase(&mut Random(random.bits())))));
    check_sums("any exponent", (0..count / 4).map(|_| (random.finite(), phase(&mut Random(random.bits())))));
    check_sums(
        "where the constant shows",
        (0..count / 4).map(|_| (random.between_powers(18, 60), phase(&mut Random(random.bits())))),
    );
    check_sums(
        "close to multiples of π/2",
        (0..count).map(|i| {
            let (hi, lo) = phase(&mut random);
            let near = std::f64::consts::FRAC_PI_2 * (i % 64) as f64 - hi;
            (f64::from_bits(near.to_bits().wrapping_add(random.bits() % 3)), (hi, lo))
        }),
    );
}

/// A constant in two parts.
fn phase(random: &mut Random) -> (f64, f64) {
    let hi = 4.0 * random.signed();
    (hi, hi * random.signed() * f64::EPSILON)
}

fn check_sums(name: &str, arguments: impl IntoIterator<Item = (f64, (f64, f64))>) {
    let (mut reference, mut worst) = (Reference::new(), <[Worst; 2]>::default());
    for (x, (hi, lo)) in arguments {
        let (true_sin, true_cos) = reference.sin_cos(&(real(x) + real(hi) + real(lo)));
        let allowed = bounds::SUM_ALLOWANCE * f64::EPSILON.powi(2) * x.abs().max(4.0);
        for (worst, sum) in worst.iter_mut().zip([sin_cos_sum, fused_sin_cos_sum]) {
            let (sin, cos) = sum(x, hi, lo);
            worst.see(beyond(sin, &true_sin, allowed), || format!("sin, {x:e} + {hi:e} + {lo:e}"));
            worst.see(beyond(cos, &true_cos, allowed), || format!("cos, {x:e} + {hi:e} + {lo:e}"));
        }
    }
    worst[0].is_at_most(bounds::SIN_COS, &format!("sums, {name}"));
    worst[1].is_at_most(bounds::FUSED_SIN_COS, &format!("fused sums, {name}"));
}

/// The error in ulp after an absolute allowance.
fn beyond(got: f64, truth: &Real, allowed: f64) -> f64 {
    let size = truth.to_f64().value();
    ulps(got, truth) - allowed / (size.abs().next_up() - size.abs())
}

#[test]
fn random_arguments() {
    random_ranges(6_000);
}

#[test]
fn next_to_multiples_of_half_pi() {
    check("next to few quarter turns", near_multiples(1..600));
    check("next to many quarter turns", near_multiples((600..FAST_QUARTERS).step_by(241)));
    check("border of the short reduction", near_multiples(FAST_QUARTERS - 200..FAST_QUARTERS + 400));
    // Continued fractions of π give the closest; nearest of all of `f64` is 6381956970095103·2⁷⁹⁷.
    let convergents = [22.0, 355.0, 103_993.0, 104_348.0, 208_341.0, 312_689.0, 833_719.0, 5_419_351.0, 80_143_857.0];
    check("convergents of π", convergents.into_iter().flat_map(|p| (-8..60).map(move |k| p * 2f64.powi(k))));
    check(
        "nearest of all",
        (-1..2).map(|k| f64::from_bits((6_381_956_970_095_103.0 * 2f64.powi(797)).to_bits().wrapping_add_signed(k))),
    );
}

/// The largest errors that were found, first those of two cosines and two sines in fused operations: there every rounding goes the same way.
#[test]
fn where_roundings_add_up() {
    let found = [
        0x40A7_A123_01AA_5E4A,
        0x408C_D6B8_B459_A946,
        0x408F_EE5E_75F9_7818,
        0x4063_2492_BB9A_7D9F,
        0x405D_A65B_16C8_88BF,
        0x4095_898B_E6FF_799B,
    ];
    check("where roundings add up", found.map(f64::from_bits));
}

#[test]
fn nearest_of_all_as_published() {
    // J.-M. Muller, Elementary Functions, on the double that is closest to a multiple of π/2.
    let (sin, cos) = sin_cos(6_381_956_970_095_103.0 * 2f64.powi(797));
    assert_eq!(sin, 1.0);
    assert!((cos / -4.687_165_924_254_628e-19 - 1.0).abs() < 1e-16, "{cos:e}");
}

#[test]
fn random_sums() {
    sums(4_000);
}

#[test]
fn a_sum_is_not_rounded() {
    // π/2 in two parts: the sine of x + π/2 is the cosine of x, the cosine is −sin x.
    let (hi, lo) = (std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);
    let mut random = Random(4);
    for _ in 0..100_000 {
        let x = random.between_powers(-40, 10);
        let ((sin, cos), (shifted_sin, shifted_cos)) = (sin_cos(x), sin_cos_sum(x, hi, lo));
        assert!((shifted_sin - cos).abs() <= 2.0 * f64::EPSILON * cos.abs() + 2e-31 * x.abs().max(4.0), "{x:e}");
        assert!((shifted_cos + sin).abs() <= 2.0 * f64::EPSILON * sin.abs() + 2e-31 * x.abs().max(4.0), "{x:e}");
    }
}

#[test]
#[ignore = "takes minutes"]
fn random_arguments_many() {
    random_ranges(600_000);
}

#[test]
#[ignore = "takes minutes"]
fn random_sums_many() {
    sums(400_000);
}

#[test]
#[ignore = "takes minutes"]
fn next_to_every_multiple_of_half_pi() {
    check("next to all quarter turns", near_multiples(1..FAST_QUARTERS + 1000));
}
