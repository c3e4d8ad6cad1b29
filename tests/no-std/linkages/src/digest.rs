//! A digest of the bits of results.

use core::fmt;

use linkage_runtime::nalgebra::{SMatrix, Scalar};
use linkage_runtime::{Error, SliderReaction, SweepError, Vector2, WorkTerm, Wrench};

/// A hash over the bits of everything put into it, and how many answers and refusals were among it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest {
    /// The hash.
    pub hash: u64,
    /// Results.
    pub answers: u32,
    /// Errors.
    pub refusals: u32,
}

impl Digest {
    /// The digest of nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self { hash: 0xCBF2_9CE4_8422_2325, answers: 0, refusals: 0 }
    }

    fn bits(&mut self, bits: u64) {
        self.hash = (self.hash ^ bits).wrapping_mul(0x0000_0100_0000_01B3).rotate_left(29);
    }

    /// Puts a number, a vector or a structure of them.
    pub fn put<T: Output>(&mut self, value: T) {
        value.put(self);
    }

    /// Puts the results of a scene, or why there are none.
    pub fn result<T: Output>(&mut self, result: Result<T, Error>) {
        match result {
            Ok(value) => {
                self.answers = self.answers.wrapping_add(1);
                self.put(value);
            }
            Err(error) => self.refusal(error),
        }
    }

    /// Puts whether a sweep has all its results, or which one it lacks. The results are put by themselves.
    pub fn sweep(&mut self, swept: Result<(), SweepError>) {
        match swept {
            Ok(()) => self.answers = self.answers.wrapping_add(1),
            Err(SweepError::Position { index, error }) => {
                self.bits(index as u64);
                self.refusal(error);
            }
            Err(SweepError::Length { what, found, expected }) => {
                self.refusals = self.refusals.wrapping_add(1);
                self.bits(what.len() as u64);
                self.bits(found as u64);
                self.bits(expected as u64);
            }
            Err(_) => self.bits(10),
        }
    }

    /// Puts the columns of a sweep. Without an iterator: in unoptimised builds a panic is within their reach.
    pub fn columns<T: Output + Copy, const POSITIONS: usize>(&mut self, columns: &[[T; POSITIONS]]) {
        let mut which = 0;
        while let Some(column) = columns.get(which) {
            let mut position = 0;
            while let Some(number) = column.get(position) {
                self.put(*number);
                position = position.wrapping_add(1);
            }
            which = which.wrapping_add(1);
        }
    }

    /// Puts an error.
    pub fn refusal(&mut self, error: Error) {
        self.refusals = self.refusals.wrapping_add(1);
        let (kind, text, gap) = match error {
            Error::CannotAssemble { joint, gap, .. } => (1, joint, gap),
            Error::CoincidentPivots { joint, .. } => (2, joint, 0.0),
            Error::DeadCentre { pivot, .. } => (3, pivot, 0.0),
            Error::Parameter { requirement } => (4, requirement, 0.0),
            Error::NotFinite { what } => (5, what, 0.0),
            Error::NoConvergence { group, gap } => (7, group, gap),
            Error::NoInertia { scene } => (8, scene, 0.0),
            Error::OtherSide { joint } => (9, joint, 0.0),
            _ => (6, "", 0.0),
        };
        self.bits(kind);
        self.bits(text.len() as u64);
        self.put(gap);
    }
}

impl Default for Digest {
    fn default() -> Self {
        Self::new()
    }
}

/// A line that says the name of a linkage and the hash of what it computes.
#[derive(Clone, Copy, Debug)]
pub struct Line(pub &'static str, pub Digest);

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:016x}", self.0, self.1.hash)
    }
}

/// What a digest takes.
pub trait Output {
    /// Puts its bits into a digest.
    fn put(self, digest: &mut Digest);
}

// Which NaN an operation gives is not fixed by IEEE 754, and differs between targets.
impl Output for f64 {
    fn put(self, digest: &mut Digest) {
        digest.bits(if self.is_nan() { u64::MAX } else { self.to_bits() });
    }
}

impl Output for f32 {
    fn put(self, digest: &mut Digest) {
        digest.bits(if self.is_nan() { u64::MAX } else { u64::from(self.to_bits()) });
    }
}

impl<T: Output, U: Output> Output for (T, U) {
    fn put(self, digest: &mut Digest) {
        self.0.put(digest);
        self.1.put(digest);
    }
}

impl<T: Output + Copy> Output for Vector2<T> {
    fn put(self, digest: &mut Digest) {
        let [[x, y]] = self.data.0;
        x.put(digest);
        y.put(digest);
    }
}

impl<T: Output + Copy> Output for SMatrix<T, 2, 2> {
    fn put(self, digest: &mut Digest) {
        let [[a, b], [c, d]] = self.data.0;
        (a, b).put(digest);
        (c, d).put(digest);
    }
}

impl<T: Output + Scalar + Copy> Output for SliderReaction<T> {
    fn put(self, digest: &mut Digest) {
        let Self { force, normal, couple } = self;
        force.put(digest);
        normal.put(digest);
        couple.put(digest);
    }
}

impl<T: Output + Scalar + Copy> Output for Wrench<T> {
    fn put(self, digest: &mut Digest) {
        let Self { force, moment } = self;
        force.put(digest);
        moment.put(digest);
    }
}

impl<T: Output> Output for WorkTerm<T> {
    fn put(self, digest: &mut Digest) {
        let Self { velocity, work } = self;
        velocity.put(digest);
        work.put(digest);
    }
}

/// Lets a digest take the result types of a linkage. A field that is left out is an error.
macro_rules! outputs {
    ($($name:ty { $($field:ident),* $(,)? })*) => { $(
        impl $crate::Output for $name {
            #[allow(non_snake_case, reason = "names of the declaration")]
            fn put(self, digest: &mut $crate::Digest) {
                let Self { $($field),* } = self;
                $(digest.put($field);)*
            }
        }
    )* };
}
pub(crate) use outputs;

/// Puts what a pose says of itself.
macro_rules! accessors {
    ($digest:ident, $pose:ident: $($name:ident),*) => { $($digest.put($pose.$name());)* };
}
pub(crate) use accessors;

/// Puts the results of scenes from a pose.
macro_rules! scenes {
    ($digest:ident, $pose:ident: $($scene:ident($($given:expr),*)),*) => { $($digest.result($pose.$scene($($given),*));)* };
}
pub(crate) use scenes;

/// `inputs` and `math` of a scalar, and the macro that makes the `digest` of a linkage.
macro_rules! scalar {
    ($scalar:ident) => {
        /// What a linkage is called with: the drive, four numbers for loads and three for dimensions.
        pub type Inputs = [$scalar; 8];

        /// Inputs that depend on the number of a pose only: the drive between −20 and 20, the others between −1 and 1.
        /// Some are far out: an angle of many turns, a dimension that does not close, numbers that are not finite.
        #[must_use]
        #[allow(clippy::cast_precision_loss, clippy::cast_lossless, reason = "24 bits fit")]
        pub fn inputs(pose: u16) -> Inputs {
            let mut state = u64::from(pose);
            let mut draw = || {
                // splitmix64
                state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
                let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
                let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
                let bits = u32::try_from(z >> 40).unwrap_or(0);
                bits as $scalar / 8_388_608.0 - 1.0
            };
            let drive = 20.0 * draw();
            let [a, b, c, d] = [draw(), draw(), draw(), draw()];
            let [p, q, r] = [draw(), draw(), draw()];
            match pose % 16 {
                3 => [1e6 * drive, a, b, c, d, p, q, r],
                7 => [drive, a, b, c, d, 1e3 * p, q, r],
                11 => [drive, a, 1e30 / b, c, $scalar::NAN, p, q, r],
                15 => [drive / 0.0, a, b, c, d, p, q, $scalar::INFINITY],
                _ => [drive, a, b, c, d, p, q, r],
            }
        }

        /// The run-time crate's elementary functions: they are public too.
        pub mod math {
            use linkage_runtime::math::$scalar as math;

            /// Calls all.
            pub fn solve(input: &super::Inputs, digest: &mut $crate::Digest) {
                let [angle, x, y, ..] = *input;
                digest.put(math::sqrt(x));
                digest.put(math::sin_cos(angle));
                digest.put(math::sin_cos_half(angle));
                digest.put(math::sin_cos_sum(angle, x, y));
                digest.put(math::atan2(y, x));
                digest.put(math::unit(x, y));
                digest.put(math::polar(x, angle));
                digest.put(linkage_runtime::polar(x, angle));
            }

            $crate::digest::digest!();
        }
    };
}
pub(crate) use scalar;

/// `digest`: everything in a module called at many poses.
macro_rules! digest {
    () => {
        /// Everything called at [`POSES`](crate::POSES) poses.
        #[must_use]
        pub fn digest() -> $crate::Digest {
            let mut digest = $crate::Digest::new();
            let mut pose = 0;
            while pose < $crate::POSES {
                solve(&super::inputs(pose), &mut digest);
                pose = pose.wrapping_add(1);
            }
            digest
        }
    };
}
pub(crate) use digest;
