//! Types of results.

use nalgebra::{Scalar, Vector2};

/// The reaction of a prismatic joint on its second link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderReaction<T: Scalar> {
    /// The force, ground axes.
    pub force: Vector2<T>,
    /// Its signed size along the slide's direction turned by +90°.
    pub normal: T,
    /// The couple about the slide's runner, the point that is on the line, counter-clockwise.
    pub couple: T,
}

/// The term of a load in the principle of virtual work.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorkTerm<T> {
    /// Velocity of the load's point along the load, for unit rate; of a moment the rate of rotation that it works on. Zero for a
    /// force of zero, which has no direction.
    pub velocity: T,
    /// Load times velocity.
    pub work: T,
}

/// A vector by its size and its angle in radians, counter-clockwise from the x axis: `polar(50.0, 230f64.to_radians())`.
///
/// Sine and cosine are those of [`math`](crate::math). An argument that is not finite makes components that are NaN, which every
/// scene reports as [`Error::NotFinite`](crate::Error::NotFinite).
#[must_use]
pub fn polar<T: Polar>(size: T, angle: T) -> Vector2<T> {
    let (x, y) = T::polar(size, angle);
    Vector2::new(x, y)
}

/// A scalar of which [`polar`] makes vectors: `f32` or `f64`.
pub trait Polar: Sized + sealed::Sealed {
    /// `(size cos angle, size sin angle)`.
    fn polar(size: Self, angle: Self) -> (Self, Self);
}

impl Polar for f64 {
    fn polar(size: Self, angle: Self) -> (Self, Self) {
        crate::math::f64::polar(size, angle)
    }
}

impl Polar for f32 {
    fn polar(size: Self, angle: Self) -> (Self, Self) {
        crate::math::f32::polar(size, angle)
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}
