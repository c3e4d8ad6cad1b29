//! True values to 200 bits, and distances from them.

use dashu_float::round::mode::HalfEven;
use dashu_float::{ConstCache, Context, FBig};

pub(crate) type Real = FBig<HalfEven>;

const BITS: usize = 200;
/// Holds any sum of numbers of `f64` without rounding.
const EXACT_BITS: usize = 2200;

pub(crate) fn real(x: f64) -> Real {
    Real::try_from(x).unwrap().with_precision(EXACT_BITS).value()
}

/// Evaluates the functions; keeps the digits of π.
pub(crate) struct Reference {
    context: Context<HalfEven>,
    cache: ConstCache,
}

impl Reference {
    pub(crate) fn new() -> Self {
        Self { context: Context::new(BITS), cache: ConstCache::new() }
    }

    pub(crate) fn sin_cos(&mut self, x: &Real) -> (Real, Real) {
        let (sin, cos) = self.context.sin_cos(x.repr(), Some(&mut self.cache));
        (sin.unwrap().value(), cos.unwrap().value())
    }

    pub(crate) fn atan2(&mut self, y: f64, x: f64) -> Real {
        self.context.atan2(real(y).repr(), real(x).repr(), Some(&mut self.cache)).unwrap().value()
    }

    pub(crate) fn norm(&mut self, x: f64, y: f64) -> Real {
        let (x, y) = (real(x), real(y));
        let squared = &x * &x + &y * &y;
        self.context.sqrt(squared.repr()).unwrap().value()
    }

    pub(crate) fn quotient(&mut self, x: f64, length: &Real) -> Real {
        self.context.div(real(x).repr(), length.repr()).unwrap().value()
    }

    pub(crate) fn sqrt(&mut self, x: f64) -> f64 {
        self.context.sqrt(real(x).repr()).unwrap().value().to_f64().value()
    }

    /// The `f64` next to n·π/2.
    pub(crate) fn multiple_of_half_pi(&mut self, n: u64) -> f64 {
        let pi: Real = self.context.pi(Some(&mut self.cache)).value();
        (pi * Real::from(n) / Real::from(2)).to_f64().value()
    }
}

/// |got − truth| in ulp of the truth, where an ulp of a subnormal number is 2⁻¹⁰⁷⁴.
pub(crate) fn ulps(got: f64, truth: &Real) -> f64 {
    if !got.is_finite() {
        return f64::INFINITY;
    }
    let error = (real(got) - truth).to_f64().value().abs();
    let near = truth.to_f64().value().abs();
    // The binade of the truth itself, should it have been rounded up into the next one.
    let rounded_up = real(near) > if *truth < Real::ZERO { -truth } else { truth.clone() };
    error_in_ulps(error, if rounded_up { near.next_down() } else { near })
}

fn error_in_ulps(error: f64, size: f64) -> f64 {
    let exponent = ((size.to_bits() >> 52) as i32).max(1) - 1075;
    // In two steps: 2¹⁰⁷⁴ is not a number.
    error * 2f64.powi(-exponent / 2) * 2f64.powi(-exponent - -exponent / 2)
}

/// |got − truth| in ulp of `f32`, for a truth known to `f64`.
pub(crate) fn ulps_f32(got: f32, truth: f64) -> f64 {
    if !got.is_finite() {
        return f64::INFINITY;
    }
    let exponent = (((truth.to_bits() >> 52) & 0x7FF) as i32 - 1023).max(-126) - 23;
    (f64::from(got) - truth).abs() * 2f64.powi(-exponent)
}

/// The largest error of a test, with where it was found.
#[derive(Default)]
pub(crate) struct Worst {
    error: f64,
    place: String,
}

impl Worst {
    pub(crate) fn see(&mut self, error: f64, place: impl FnOnce() -> String) {
        if error.is_nan() || error > self.error {
            *self = Self { error, place: place() };
        }
    }

    #[track_caller]
    pub(crate) fn is_at_most(&self, bound: f64, what: &str) {
        println!("{what}: {:.4} (promised {bound}) at {}", self.error, self.place);
        assert!(self.error <= bound, "{what}: {} > {bound} at {}", self.error, self.place);
    }
}
