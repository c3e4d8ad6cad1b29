//! Exact constants: what is known at compile time is worked out here and rounded once, when it is written into the code.
//!
//! A number stays rational as long as it can, an angle stays a rational multiple of π, and what roots and trigonometry
//! make of them carries 256 bits.

use core::cmp::Ordering;

use dashu_float::round::Rounded;
use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig, Repr};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

use super::Scalar;

/// Binary digits of a number that is not rational.
const PRECISION: usize = 256;
/// A difference of two such numbers that cancels this many bits is zero: the exact values were equal.
const CANCELLED: isize = 200;
/// A rational number that needs more bits than this goes on as a 256-bit one.
const RATIONAL_BITS: usize = 8192;
/// No constant that is written down has an exponent beyond this: twice that of a double's square.
const EXPONENT: isize = 4096;
/// The same for angles.
const ANGLE_EXPONENT: isize = 64;

type Float = FBig<HalfEven, 2>;

fn context() -> Context<HalfEven> {
    Context::new(PRECISION)
}

/// A constant, exact or to 256 bits.
#[derive(Clone, Debug)]
pub enum Number {
    /// An exact fraction.
    Rational(RBig),
    /// An exact multiple of π.
    Pi(RBig),
    /// Rounded to 256 bits; never zero.
    Real(Float),
}

/// What tells two numbers apart; equal numbers of one representation have equal keys.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key(u8, IBig, IBig);

impl Number {
    /// Zero.
    #[must_use]
    pub fn zero() -> Self {
        Self::Rational(RBig::ZERO)
    }

    /// One.
    #[must_use]
    pub fn one() -> Self {
        Self::integer(1)
    }

    /// A whole number.
    #[must_use]
    pub fn integer(value: i64) -> Self {
        Self::Rational(RBig::from(value))
    }

    /// `numerator / denominator`, the latter not zero.
    #[must_use]
    pub fn ratio(numerator: i64, denominator: i64) -> Self {
        Self::Rational(RBig::from_parts_signed(numerator.into(), denominator.into()))
    }

    /// `2^exponent`.
    #[must_use]
    pub fn power_of_two(exponent: i32) -> Self {
        let power = RBig::from(UBig::ONE << exponent.unsigned_abs() as usize);
        Self::Rational(if exponent < 0 { RBig::ONE / power } else { power })
    }

    /// An exact decimal: digits with at most one point and at most one exponent, as Rust writes them without sign.
    /// `None` where the text is no such number or its exponent is beyond ±400.
    #[must_use]
    pub fn decimal(text: &str) -> Option<Self> {
        let text = text.replace('_', "");
        let (digits, exponent) = match text.split_once(['e', 'E']) {
            Some((digits, exponent)) => (digits, exponent.parse::<i64>().ok()?),
            None => (text.as_str(), 0),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let all = format!("{whole}{fraction}");
        if all.is_empty() || !all.bytes().all(|b| b.is_ascii_digit()) || exponent.abs() > 400 {
            return None;
        }
        let value = RBig::from(UBig::from_str_radix(&all, 10).ok()?);
        let shift = exponent - i64::try_from(fraction.len()).ok()?;
        let power = RBig::from(UBig::from(10u8).pow(usize::try_from(shift.unsigned_abs()).ok()?));
        Some(Self::Rational(if shift < 0 { value / power } else { value * power }))
    }

    /// The exact value of a double; `None` unless finite.
    #[must_use]
    pub fn from_f64(value: f64) -> Option<Self> {
        RBig::try_from(value).ok().map(Self::Rational)
    }

    /// π times a fraction.
    #[must_use]
    pub fn pi(numerator: i64, denominator: i64) -> Self {
        Self::Pi(RBig::from_parts_signed(numerator.into(), denominator.into()))
    }

    fn rational(value: RBig) -> Self {
        let bits = bit_length(value.numerator()) + bit_length(value.denominator().as_ibig());
        if bits > RATIONAL_BITS { Self::real(Self::Rational(value).float()) } else { Self::Rational(value) }
    }

    /// A value to 256 bits; one that agrees with a whole number in all but its last bits is that number.
    fn real(value: Float) -> Self {
        if value.repr().significand().is_zero() {
            return Self::zero();
        }
        let nearest = value.round();
        let error = context().sub(value.repr(), nearest.repr()).map_or(Float::ZERO, Rounded::value);
        if magnitude(&value).abs() < 64 && magnitude(&error) < magnitude(&value) - CANCELLED {
            return Self::Rational(RBig::from(nearest.to_int().value()));
        }
        Self::Real(value)
    }

    /// The value to 256 bits.
    fn float(&self) -> Float {
        let quotient = |q: &RBig| {
            let n = Repr::<2>::new(q.numerator().clone(), 0);
            let d = Repr::<2>::new(q.denominator().as_ibig().clone(), 0);
            context().div(&n, &d).map_or(Float::ZERO, Rounded::value)
        };
        match self {
            Self::Rational(q) => quotient(q),
            Self::Pi(q) => {
                let pi = context().pi::<2>(None).value();
                context().mul(pi.repr(), quotient(q).repr()).map_or(Float::ZERO, Rounded::value)
            }
            Self::Real(x) => x.clone(),
        }
    }

    pub(crate) fn key(&self) -> Key {
        match self {
            Self::Rational(q) => Key(0, q.numerator().clone(), q.denominator().as_ibig().clone()),
            Self::Pi(q) => Key(1, q.numerator().clone(), q.denominator().as_ibig().clone()),
            Self::Real(x) => Key(2, x.repr().significand().clone(), x.repr().exponent().into()),
        }
    }

    /// −1, 0 or 1.
    #[must_use]
    pub fn signum(&self) -> i8 {
        match self.compare(&Self::zero()) {
            Ordering::Less => -1,
            Ordering::Equal => 0,
            Ordering::Greater => 1,
        }
    }

    /// Whether it is exactly zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        matches!(self, Self::Rational(q) | Self::Pi(q) if q.is_zero())
    }

    /// Whether it is exactly one.
    #[must_use]
    pub fn is_one(&self) -> bool {
        matches!(self, Self::Rational(q) if q.is_one())
    }

    /// Ordered by value.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Rational(a), Self::Rational(b)) | (Self::Pi(a), Self::Pi(b)) => a.cmp(b),
            _ => self.float().cmp(&other.float()),
        }
    }

    /// Sum.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        match (self, other) {
            (a, z) if z.is_zero() => a.clone(),
            (z, b) if z.is_zero() => b.clone(),
            (Self::Rational(a), Self::Rational(b)) => Self::rational(a + b),
            (Self::Pi(a), Self::Pi(b)) => Self::pi_times(a + b),
            _ => {
                let (a, b) = (self.float(), other.float());
                let sum = context().add(a.repr(), b.repr()).map_or(Float::ZERO, Rounded::value);
                let size = magnitude(&a).max(magnitude(&b));
                if magnitude(&sum) < size.saturating_sub(CANCELLED) { Self::zero() } else { Self::real(sum) }
            }
        }
    }

    /// Difference.
    #[must_use]
    pub fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }

    /// Product.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        match (self, other) {
            (z, _) | (_, z) if z.is_zero() => Self::zero(),
            (Self::Rational(a), Self::Rational(b)) => Self::rational(a * b),
            (Self::Pi(a), Self::Rational(b)) | (Self::Rational(a), Self::Pi(b)) => Self::pi_times(a * b),
            _ => {
                Self::real(context().mul(self.float().repr(), other.float().repr()).map_or(Float::ZERO, Rounded::value))
            }
        }
    }

    fn pi_times(factor: RBig) -> Self {
        if factor.is_zero() { Self::zero() } else { Self::Pi(factor) }
    }

    /// Quotient; `None` for a divisor of zero.
    #[must_use]
    pub fn div(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        Some(match (self, other) {
            (Self::Rational(a), Self::Rational(b)) | (Self::Pi(a), Self::Pi(b)) => Self::rational(a / b),
            (Self::Pi(a), Self::Rational(b)) => Self::pi_times(a / b),
            _ => {
                Self::real(context().div(self.float().repr(), other.float().repr()).map_or(Float::ZERO, Rounded::value))
            }
        })
    }

    /// Negative.
    #[must_use]
    pub fn neg(&self) -> Self {
        match self {
            Self::Rational(q) => Self::Rational(-q),
            Self::Pi(q) => Self::Pi(-q),
            Self::Real(x) => Self::Real(-x.clone()),
        }
    }

    /// Magnitude.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.signum() < 0 { self.neg() } else { self.clone() }
    }

    /// Whole power.
    #[must_use]
    pub fn pow(&self, exponent: u32) -> Self {
        (0..exponent).fold(Self::one(), |product, _| product.mul(self))
    }

    /// Square root; exact for a square; `None` below zero.
    #[must_use]
    pub fn sqrt(&self) -> Option<Self> {
        if self.signum() < 0 {
            return None;
        }
        if let Self::Rational(q) = self {
            let (n, d) = (square_root(q.numerator()), square_root(q.denominator().as_ibig()));
            if let (Some(n), Some(d)) = (n, d) {
                return Some(Self::Rational(RBig::from_parts_signed(n, d)));
            }
        }
        context().sqrt(self.float().repr()).ok().map(|r| Self::real(r.value()))
    }

    /// Sine and cosine; exact at multiples of 30° where the value is rational.
    #[must_use]
    pub fn sin_cos(&self) -> (Self, Self) {
        let zero = || Float::ZERO;
        match self {
            z if z.is_zero() => (Self::zero(), Self::one()),
            Self::Pi(q) => {
                if let Some(exact) = exact_sin_cos(q) {
                    return exact;
                }
                let x = Self::Rational(q.clone()).float();
                let (s, c) = context().sin_cos_pi(x.repr(), None);
                (
                    Self::real(s.map_or_else(|_| zero(), Rounded::value)),
                    Self::real(c.map_or_else(|_| zero(), Rounded::value)),
                )
            }
            _ => {
                let (s, c) = context().sin_cos(self.float().repr(), None);
                (
                    Self::real(s.map_or_else(|_| zero(), Rounded::value)),
                    Self::real(c.map_or_else(|_| zero(), Rounded::value)),
                )
            }
        }
    }

    /// Angle of the direction `(x, y)` in (−π, π], exact along the axes and the diagonals; zero for the zero vector.
    #[must_use]
    pub fn atan2(y: &Self, x: &Self) -> Self {
        let quarter_turns = match (x.signum(), y.signum()) {
            (0 | 1, 0) => return Self::zero(),
            (-1, 0) => return Self::pi(1, 1),
            (0, s) => return Self::pi(i64::from(s), 2),
            (sx, sy) if x.abs().compare(&y.abs()) == Ordering::Equal => {
                return Self::pi(i64::from(sy) * if sx > 0 { 1 } else { 3 }, 4);
            }
            _ => context().atan2(y.float().repr(), x.float().repr(), None),
        };
        quarter_turns.map_or_else(|_| Self::zero(), |r| Self::real(r.value()))
    }

    /// Whether the nearest number of a scalar is finite, and zero only for zero.
    #[must_use]
    pub fn fits(&self, scalar: Scalar) -> bool {
        let nearest = self.nearest(scalar);
        nearest.is_finite() && (nearest != 0.0 || self.is_zero())
    }

    /// Nearest number of a scalar, ties to even; infinite beyond the range.
    #[must_use]
    pub fn nearest(&self, scalar: Scalar) -> f64 {
        match scalar {
            Scalar::F64 => self.to_f64(),
            Scalar::F32 => f64::from(self.to_f32()),
        }
    }

    /// Whether it is so large or so small that its exponent alone would be a burden.
    #[must_use]
    pub fn is_excessive(&self) -> bool {
        !self.is_zero() && self.binary_exponent().abs() > EXPONENT
    }

    /// Whether it is so many radians that 256 bits leave no direction.
    #[must_use]
    pub fn is_excessive_angle(&self) -> bool {
        self.binary_exponent() > ANGLE_EXPONENT
    }

    /// The place of the leading bit, give or take one; of π's multiples that of the factor.
    pub(super) fn binary_exponent(&self) -> isize {
        match self {
            Self::Rational(q) | Self::Pi(q) => {
                bit_length(q.numerator()).cast_signed() - bit_length(q.denominator().as_ibig()).cast_signed()
            }
            Self::Real(x) => magnitude(x),
        }
    }

    /// Nearest double, ties to even; infinite beyond the range.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        match self {
            Self::Rational(q) => q.to_f64().value(),
            _ => self.float().to_f64().value(),
        }
    }

    /// Nearest single, ties to even; infinite beyond the range.
    #[must_use]
    pub fn to_f32(&self) -> f32 {
        match self {
            Self::Rational(q) => q.to_f32().value(),
            _ => self.float().to_f32().value(),
        }
    }
}

/// Sine and cosine of a multiple of π where both are rational.
fn exact_sin_cos(multiple: &RBig) -> Option<(Number, Number)> {
    let quarters = multiple * RBig::from(2);
    if !quarters.denominator().is_one() {
        return half_sin_cos(multiple);
    }
    let quarter = quarters.numerator() - (quarters.numerator() / IBig::from(4)) * IBig::from(4);
    let quarter = i64::try_from(quarter).ok()?.rem_euclid(4);
    let unit = |k: i64| Number::integer([0, 1, 0, -1][usize::try_from(k.rem_euclid(4)).unwrap_or(0)]);
    Some((unit(quarter), unit(quarter + 1)))
}

/// Sine and cosine of a multiple of 30°, one of which is ±1/2 and the other ±√3/2.
fn half_sin_cos(multiple: &RBig) -> Option<(Number, Number)> {
    let sixths = multiple * RBig::from(6);
    if !sixths.denominator().is_one() {
        return None;
    }
    let step = sixths.numerator() - (sixths.numerator() / IBig::from(12)) * IBig::from(12);
    let step = i64::try_from(step).ok()?.rem_euclid(12);
    let root = Number::ratio(3, 4).sqrt()?;
    let half = Number::ratio(1, 2);
    // 30° steps; the multiples of 90° are not here.
    let value = |k: i64| match k.rem_euclid(12) {
        1 | 5 => half.clone(),
        2 | 4 => root.clone(),
        7 | 11 => half.neg(),
        _ => root.neg(),
    };
    Some((value(step), value(step + 3)))
}

fn bit_length(value: &IBig) -> usize {
    use dashu_int::ops::BitTest;
    value.bit_len()
}

/// The place of the leading bit.
fn magnitude(value: &Float) -> isize {
    if value.repr().significand().is_zero() {
        return isize::MIN;
    }
    value.repr().exponent() + bit_length(value.repr().significand()).cast_signed()
}

/// The root of a whole square.
fn square_root(value: &IBig) -> Option<IBig> {
    use dashu_int::ops::SquareRoot;
    let value = UBig::try_from(value.clone()).ok()?;
    let root = value.sqrt();
    (root.sqr() == value).then(|| root.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(text: &str) -> Number {
        Number::decimal(text).unwrap()
    }

    #[test]
    fn decimals_are_exact() {
        // In doubles this is 2.8e-17.
        let sum = decimal("0.08").add(&decimal("0.14"));
        let other = decimal("0.10").add(&decimal("0.12"));
        assert!(sum.sub(&other).is_zero());
        assert_eq!(decimal("1_000.5e-2").to_f64().to_bits(), 10.005f64.to_bits());
        assert!(Number::decimal("1e401").is_none());
        assert!(Number::decimal("1.2.3").is_none());
    }

    #[test]
    fn roots_and_angles_keep_what_is_rational() {
        assert!(decimal("6.25").sqrt().unwrap().sub(&decimal("2.5")).is_zero());
        let root = Number::integer(2).sqrt().unwrap();
        assert!(root.mul(&root).sub(&Number::integer(2)).is_zero());
        for (degrees, sine, cosine) in [
            (0, 0.0, 1.0),
            (30, 0.5, 3f64.sqrt() / 2.0),
            (90, 1.0, 0.0),
            (-90, -1.0, 0.0),
            (180, 0.0, -1.0),
            (300, -(3f64.sqrt()) / 2.0, 0.5),
        ] {
            let (s, c) = Number::pi(degrees, 180).sin_cos();
            assert_eq!((s.to_f64(), c.to_f64()), (sine, cosine), "{degrees}°");
        }
    }

    #[test]
    fn arc_tangent_is_exact_where_the_angle_is_a_fraction_of_a_turn() {
        let at = |y, x| Number::atan2(&Number::integer(y), &Number::integer(x));
        assert!(at(3, 3).sub(&Number::pi(1, 4)).is_zero());
        assert!(at(-2, 0).sub(&Number::pi(-1, 2)).is_zero());
        assert!(at(0, -5).sub(&Number::pi(1, 1)).is_zero());
        assert_eq!(at(3, 4).to_f64().to_bits(), 3f64.atan2(4.0).to_bits());
    }
}
