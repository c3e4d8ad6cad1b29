//! Number types: the emitted code's own arithmetic, and one far beyond it.

use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig};
use linkage_codegen::graph::number::Number as Constant;
use linkage_codegen::graph::real::Real;
use linkage_runtime::math;

use super::Number;

macro_rules! scalar {
    ($(#[$doc:meta])* $name:ident, $scalar:ident, $to:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name(pub $scalar);

        impl $name {
            /// A constant as an unevaluated sum.
            fn split(constant: &Constant) -> ($scalar, $scalar) {
                let high = constant.$to();
                let rest = constant.sub(&Constant::from_f64(f64::from(high)).expect("finite"));
                (high, rest.$to())
            }
        }

        impl Real for $name {
            fn from_number(number: &Constant) -> Self {
                Self(number.$to())
            }
            fn add(&self, other: &Self) -> Self {
                Self(self.0 + other.0)
            }
            fn sub(&self, other: &Self) -> Self {
                Self(self.0 - other.0)
            }
            fn mul(&self, other: &Self) -> Self {
                Self(self.0 * other.0)
            }
            fn div(&self, other: &Self) -> Self {
                Self(self.0 / other.0)
            }
            fn neg(&self) -> Self {
                Self(-self.0)
            }
            fn sqrt(&self) -> Self {
                Self(math::$scalar::sqrt(self.0))
            }
            fn mul_add(&self, factor: &Self, summand: &Self) -> Self {
                Self(self.0.mul_add(factor.0, summand.0))
            }
            fn above(&self, other: &Self) -> bool {
                self.0 > other.0
            }
            fn at_least(&self, other: &Self) -> bool {
                self.0 >= other.0
            }
            fn is_finite(&self) -> bool {
                self.0.is_finite()
            }
            fn sin_cos(&self) -> (Self, Self) {
                let (s, c) = math::$scalar::sin_cos(self.0);
                (Self(s), Self(c))
            }
            fn sin_cos_sum(&self, phase: &Constant) -> (Self, Self) {
                let (high, low) = Self::split(phase);
                let (s, c) = math::$scalar::sin_cos_sum(self.0, high, low);
                (Self(s), Self(c))
            }
            fn fused_sin_cos(&self) -> (Self, Self) {
                let (s, c) = math::$scalar::fused_sin_cos(self.0);
                (Self(s), Self(c))
            }
            fn fused_sin_cos_sum(&self, phase: &Constant) -> (Self, Self) {
                let (high, low) = Self::split(phase);
                let (s, c) = math::$scalar::fused_sin_cos_sum(self.0, high, low);
                (Self(s), Self(c))
            }
            fn atan2(&self, x: &Self) -> Self {
                Self(math::$scalar::atan2(self.0, x.0))
            }
            fn unit(&self, y: &Self) -> (Self, Self) {
                let (x, y) = math::$scalar::unit(self.0, y.0);
                (Self(x), Self(y))
            }
        }
    };
}

scalar!(
    /// Double precision with the run-time crate's functions: bit for bit what emitted code computes.
    Double, f64, to_f64
);
scalar!(
    /// Single precision likewise.
    Single, f32, to_f32
);

impl Number for Double {
    fn exactly(value: f64) -> Self {
        Self(value)
    }
    fn to_f64(&self) -> f64 {
        self.0
    }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "arguments of single-precision linkages are single-precision numbers"
)]
impl Number for Single {
    fn exactly(value: f64) -> Self {
        Self(value as f32)
    }
    fn to_f64(&self) -> f64 {
        f64::from(self.0)
    }
}

type Float = FBig<HalfEven, 2>;

/// Binary digits of [`Extended`].
const DIGITS: usize = 220;

/// 220 binary digits: where it is compared with doubles it counts as exact.
#[derive(Clone, Debug)]
pub struct Extended(pub Float);

fn context() -> Context<HalfEven> {
    Context::new(DIGITS)
}

impl Extended {
    pub fn zero() -> Self {
        Self(Float::ZERO.with_precision(DIGITS).value())
    }

    pub fn abs(&self) -> Self {
        if self.0 < Float::ZERO { self.neg() } else { self.clone() }
    }
}

impl Real for Extended {
    fn from_number(number: &Constant) -> Self {
        let float: Float = match number {
            Constant::Rational(q) => q.to_float(DIGITS).value(),
            Constant::Pi(q) => {
                let pi = context().pi::<2>(None).value();
                let q: Float = q.to_float(DIGITS).value();
                context().mul(pi.repr(), q.repr()).expect("finite").value()
            }
            Constant::Real(x) => x.clone().with_precision(DIGITS).value(),
        };
        Self(float)
    }
    fn add(&self, other: &Self) -> Self {
        Self(context().add(self.0.repr(), other.0.repr()).expect("finite").value())
    }
    fn sub(&self, other: &Self) -> Self {
        Self(context().sub(self.0.repr(), other.0.repr()).expect("finite").value())
    }
    fn mul(&self, other: &Self) -> Self {
        Self(context().mul(self.0.repr(), other.0.repr()).expect("finite").value())
    }
    fn div(&self, other: &Self) -> Self {
        Self(context().div(self.0.repr(), other.0.repr()).expect("divisor").value())
    }
    fn neg(&self) -> Self {
        Self(-self.0.clone())
    }
    fn sqrt(&self) -> Self {
        Self(context().sqrt(self.0.repr()).expect("not negative").value())
    }
    fn above(&self, other: &Self) -> bool {
        self.0 > other.0
    }
    fn at_least(&self, other: &Self) -> bool {
        self.0 >= other.0
    }
    fn is_finite(&self) -> bool {
        true
    }
    fn sin_cos(&self) -> (Self, Self) {
        let (s, c) = context().sin_cos(self.0.repr(), None);
        (Self(s.expect("finite").value()), Self(c.expect("finite").value()))
    }
    fn sin_cos_sum(&self, phase: &Constant) -> (Self, Self) {
        self.add(&Self::from_number(phase)).sin_cos()
    }
    fn atan2(&self, x: &Self) -> Self {
        Self(context().atan2(self.0.repr(), x.0.repr(), None).expect("finite").value())
    }
    fn unit(&self, y: &Self) -> (Self, Self) {
        let size = self.mul(self).add(&y.mul(y)).sqrt();
        if size.0 == Float::ZERO { (Self::zero(), Self::zero()) } else { (self.div(&size), y.div(&size)) }
    }
}

impl Number for Extended {
    fn exactly(value: f64) -> Self {
        if value.is_finite() { Self::from_number(&Constant::from_f64(value).expect("finite")) } else { Self::zero() }
    }
    fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}
