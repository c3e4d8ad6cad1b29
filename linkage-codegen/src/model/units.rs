//! Dimensions and units.
//!
//! Values are kept in the units of the generated functions: its length, its force, kg, s and rad. Force is a dimension of its own
//! here, because its unit is chosen apart from that of mass; `kg·m/s²` is turned into it where a force is wanted.

use core::fmt;

use crate::graph::number::Number;

/// Exponents of the base dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Dimension {
    /// Of length.
    pub length: i32,
    /// Of mass.
    pub mass: i32,
    /// Of time.
    pub time: i32,
    /// Of angle.
    pub angle: i32,
    /// Of force.
    pub force: i32,
}

impl Dimension {
    /// A bare number.
    pub const NUMBER: Self = Self { length: 0, mass: 0, time: 0, angle: 0, force: 0 };
    /// A length.
    pub const LENGTH: Self = Self { length: 1, ..Self::NUMBER };
    /// A mass.
    pub const MASS: Self = Self { mass: 1, ..Self::NUMBER };
    /// A time.
    pub const TIME: Self = Self { time: 1, ..Self::NUMBER };
    /// An angle.
    pub const ANGLE: Self = Self { angle: 1, ..Self::NUMBER };
    /// A force.
    pub const FORCE: Self = Self { force: 1, ..Self::NUMBER };

    /// Of a product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        self.plus(other, 1)
    }

    /// Of a quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        self.plus(other, -1)
    }

    /// Of a power.
    #[must_use]
    pub fn power(self, exponent: u32) -> Self {
        Self::NUMBER.plus(self, i32::try_from(exponent).unwrap_or(0))
    }

    /// Of a square root, if it has one.
    #[must_use]
    pub fn root(self) -> Option<Self> {
        let all = [self.length, self.mass, self.time, self.angle, self.force];
        all.iter().all(|e| e % 2 == 0).then_some(Self {
            length: self.length / 2,
            mass: self.mass / 2,
            time: self.time / 2,
            angle: self.angle / 2,
            force: self.force / 2,
        })
    }

    fn plus(self, other: Self, times: i32) -> Self {
        Self {
            length: self.length + times * other.length,
            mass: self.mass + times * other.mass,
            time: self.time + times * other.time,
            angle: self.angle + times * other.angle,
            force: self.force + times * other.force,
        }
    }

    /// The same with `count` forces taken as mass times acceleration.
    fn with_force_spelled_out(self, count: i32) -> Self {
        self.plus(Self { length: 1, mass: 1, time: -2, angle: 0, force: -1 }, count)
    }
}

/// What a value is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A bare number.
    Number,
    /// A distance.
    Length,
    /// An angle.
    Angle,
    /// A mass.
    Mass,
    /// A moment of inertia.
    Inertia,
    /// A force.
    Force,
    /// A moment of force.
    Moment,
    /// A velocity.
    Velocity,
    /// An acceleration.
    Acceleration,
    /// An angular velocity.
    AngularRate,
    /// An angular acceleration.
    AngularAcceleration,
    /// Force per length.
    Stiffness,
    /// Moment per angle.
    TorsionStiffness,
    /// Force per velocity.
    Damping,
    /// Moment per angular rate.
    TorsionDamping,
}

/// The kinds that a parameter may be declared with.
pub const PARAMETER_KINDS: [(&str, Kind); 11] = [
    ("length", Kind::Length),
    ("angle", Kind::Angle),
    ("number", Kind::Number),
    ("mass", Kind::Mass),
    ("inertia", Kind::Inertia),
    ("force", Kind::Force),
    ("moment", Kind::Moment),
    ("stiffness", Kind::Stiffness),
    ("torsion_stiffness", Kind::TorsionStiffness),
    ("damping", Kind::Damping),
    ("torsion_damping", Kind::TorsionDamping),
];

impl Kind {
    /// Its dimension.
    #[must_use]
    pub fn dimension(self) -> Dimension {
        let base = |length, mass, time, angle, force| Dimension { length, mass, time, angle, force };
        match self {
            Self::Number => Dimension::NUMBER,
            Self::Length => base(1, 0, 0, 0, 0),
            Self::Angle => base(0, 0, 0, 1, 0),
            Self::Mass => base(0, 1, 0, 0, 0),
            Self::Inertia => base(2, 1, 0, 0, 0),
            Self::Force => base(0, 0, 0, 0, 1),
            Self::Moment => base(1, 0, 0, 0, 1),
            Self::Velocity => base(1, 0, -1, 0, 0),
            Self::Acceleration => base(1, 0, -2, 0, 0),
            Self::AngularRate => base(0, 0, -1, 1, 0),
            Self::AngularAcceleration => base(0, 0, -2, 1, 0),
            Self::Stiffness => base(-1, 0, 0, 0, 1),
            Self::TorsionStiffness => base(1, 0, 0, -1, 1),
            Self::Damping => base(-1, 0, 1, 0, 1),
            Self::TorsionDamping => base(1, 0, 1, -1, 1),
        }
    }

    /// The factor that turns a value of this dimension into one of the kind, if they are compatible.
    #[must_use]
    pub fn factor_from(self, found: Dimension, units: &Units) -> Option<Number> {
        let wanted = self.dimension();
        // An angle may be left out of a rate of rotation, and of a torsional stiffness or damping.
        let turning = matches!(
            self,
            Self::AngularRate | Self::AngularAcceleration | Self::TorsionStiffness | Self::TorsionDamping
        );
        let same = |d: Dimension| d == wanted || turning && d == Dimension { angle: 0, ..wanted };
        if same(found) {
            return Some(Number::one());
        }
        // kg·m/s² where a force is wanted.
        let spelled = found.with_force_spelled_out(-wanted.force);
        (wanted.force == 1 && found.force == 0 && same(spelled)).then(|| units.force_per_mass_acceleration())
    }

    /// `a length`, for messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Number => "a bare number",
            Self::Length => "a length",
            Self::Angle => "an angle",
            Self::Mass => "a mass",
            Self::Inertia => "a moment of inertia",
            Self::Force => "a force",
            Self::Moment => "a moment",
            Self::Velocity => "a velocity",
            Self::Acceleration => "an acceleration",
            Self::AngularRate => "an angular rate",
            Self::AngularAcceleration => "an angular acceleration",
            Self::Stiffness => "a stiffness",
            Self::TorsionStiffness => "a torsional stiffness",
            Self::Damping => "a damping",
            Self::TorsionDamping => "a torsional damping",
        }
    }

    /// Its unit in the generated functions.
    #[must_use]
    pub fn unit(self, units: &Units) -> String {
        let (length, force) = (units.length.name, units.force.name);
        match self {
            Self::Number => "1".into(),
            Self::Length => length.into(),
            Self::Angle => "rad".into(),
            Self::Mass => "kg".into(),
            Self::Inertia => format!("kg·{length}²"),
            Self::Force => force.into(),
            Self::Moment => format!("{force}·{length}"),
            Self::Velocity => format!("{length}/s"),
            Self::Acceleration => format!("{length}/s²"),
            Self::AngularRate => "rad/s".into(),
            Self::AngularAcceleration => "rad/s²".into(),
            Self::Stiffness => format!("{force}/{length}"),
            Self::TorsionStiffness => format!("{force}·{length}/rad"),
            Self::Damping => format!("{force}·s/{length}"),
            Self::TorsionDamping => format!("{force}·{length}·s/rad"),
        }
    }

    /// How a value is written, for help.
    #[must_use]
    pub fn example(self, units: &Units) -> String {
        let (length, force) = (units.length.name, units.force.name);
        match self {
            Self::Number => "1.5".into(),
            Self::Length => format!("80{length}"),
            Self::Angle => "30deg".into(),
            Self::Mass => "0.5kg".into(),
            Self::Inertia => format!("120kg*{length}^2"),
            Self::Force => format!("50{force}"),
            Self::Moment => format!("5{force}*{length}"),
            Self::Velocity => "0.5m/s".into(),
            Self::Acceleration => "9.81m/s^2".into(),
            Self::AngularRate => "3000rpm".into(),
            Self::AngularAcceleration => "20rad/s^2".into(),
            Self::Stiffness => format!("2{force}/{length}"),
            Self::TorsionStiffness => format!("2{force}*{length}/rad"),
            Self::Damping => format!("2{force}*s/{length}"),
            Self::TorsionDamping => format!("2{force}*{length}*s/rad"),
        }
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let moving = [Kind::Velocity, Kind::Acceleration, Kind::AngularRate, Kind::AngularAcceleration];
        let known = PARAMETER_KINDS.iter().map(|(_, kind)| *kind).chain(moving);
        if let Some(kind) = known.into_iter().find(|kind| kind.dimension() == *self) {
            return f.write_str(kind.name());
        }
        let parts = [
            (self.force, "force"),
            (self.mass, "mass"),
            (self.length, "length"),
            (self.time, "time"),
            (self.angle, "angle"),
        ];
        let text: Vec<String> = parts
            .iter()
            .filter(|(exponent, _)| *exponent != 0)
            .map(|(exponent, name)| if *exponent == 1 { (*name).to_owned() } else { format!("{name}^{exponent}") })
            .collect();
        f.write_str(&text.join("·"))
    }
}

/// A unit: its name and its size in m, kg, s, rad or N.
#[derive(Clone, Debug)]
pub struct Unit {
    /// As written.
    pub name: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// How large it is.
    pub size: Number,
}

/// Name, dimension, size in SI.
type Entry = (&'static str, Dimension, fn() -> Number);

const UNITS: [Entry; 25] = [
    ("um", Dimension::LENGTH, || Number::ratio(1, 1_000_000)),
    ("mm", Dimension::LENGTH, || Number::ratio(1, 1000)),
    ("cm", Dimension::LENGTH, || Number::ratio(1, 100)),
    ("m", Dimension::LENGTH, Number::one),
    ("km", Dimension::LENGTH, || Number::integer(1000)),
    ("inch", Dimension::LENGTH, || Number::ratio(254, 10_000)),
    ("ft", Dimension::LENGTH, || Number::ratio(3048, 10_000)),
    ("mg", Dimension::MASS, || Number::ratio(1, 1_000_000)),
    ("g", Dimension::MASS, || Number::ratio(1, 1000)),
    ("kg", Dimension::MASS, Number::one),
    ("t", Dimension::MASS, || Number::integer(1000)),
    ("lb", Dimension::MASS, || Number::ratio(45_359_237, 100_000_000)),
    ("mrad", Dimension::ANGLE, || Number::ratio(1, 1000)),
    ("rad", Dimension::ANGLE, Number::one),
    ("deg", Dimension::ANGLE, || Number::pi(1, 180)),
    ("rev", Dimension::ANGLE, || Number::pi(2, 1)),
    ("rpm", Dimension { angle: 1, time: -1, ..Dimension::NUMBER }, || Number::pi(1, 30)),
    ("mN", Dimension::FORCE, || Number::ratio(1, 1000)),
    ("N", Dimension::FORCE, Number::one),
    ("kN", Dimension::FORCE, || Number::integer(1000)),
    ("MN", Dimension::FORCE, || Number::integer(1_000_000)),
    // The pound-force is the pound times the standard acceleration of 9.80665 m/s².
    ("lbf", Dimension::FORCE, || Number::ratio(45_359_237, 100_000_000).mul(&Number::ratio(980_665, 100_000))),
    ("ms", Dimension::TIME, || Number::ratio(1, 1000)),
    ("s", Dimension::TIME, Number::one),
    ("min", Dimension::TIME, || Number::integer(60)),
];

/// The unit of this name.
#[must_use]
pub fn unit(name: &str) -> Option<Unit> {
    let (name, dimension, size) = UNITS.iter().find(|(n, ..)| *n == name)?;
    Some(Unit { name, dimension: *dimension, size: size() })
}

/// All units' names.
pub fn unit_names() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|(name, ..)| *name)
}

/// The length and the force of the generated functions.
#[derive(Clone, Debug)]
pub struct Units {
    /// The unit of length.
    pub length: Unit,
    /// The unit of force.
    pub force: Unit,
}

impl Default for Units {
    fn default() -> Self {
        let si = |name, dimension| Unit { name, dimension, size: Number::one() };
        Self { length: si("m", Dimension::LENGTH), force: si("N", Dimension::FORCE) }
    }
}

impl Units {
    /// The size of a unit in the units of the generated functions.
    #[must_use]
    pub fn size_of(&self, unit: &Unit) -> Number {
        let scaled = |size: Number, by: &Number, power: i32| {
            (0..power.abs())
                .fold(size, |size, _| if power > 0 { size.div(by).unwrap_or_else(Number::zero) } else { size.mul(by) })
        };
        let size = scaled(unit.size.clone(), &self.length.size, unit.dimension.length);
        scaled(size, &self.force.size, unit.dimension.force)
    }

    /// How many units of force make 1 kg accelerate by one unit of length per s²: in mm and N, 1/1000.
    #[must_use]
    pub fn force_per_mass_acceleration(&self) -> Number {
        self.length.size.div(&self.force.size).unwrap_or_else(Number::zero)
    }
}
