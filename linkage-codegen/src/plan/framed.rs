//! Vectors in the axes in which they arise.

use crate::graph::Vector;

/// A force or a velocity along and across a direction; only turned into other axes where it must be.
#[derive(Clone, Copy, Debug)]
pub struct Framed<'m> {
    /// Along and across the direction.
    pub components: Vector<'m>,
    /// The direction, in ground axes.
    pub axes: Vector<'m>,
}

impl<'m> Framed<'m> {
    /// In ground axes.
    #[must_use]
    pub fn ground(&self) -> Vector<'m> {
        self.components.turned_by(self.axes)
    }

    /// Along and across another direction.
    #[must_use]
    pub fn along(&self, direction: Vector<'m>) -> Vector<'m> {
        if self.axes == direction { self.components } else { self.ground().resolved_along(direction) }
    }

    /// The opposite vector.
    #[must_use]
    pub fn opposite(&self) -> Self {
        Self { components: -self.components, axes: self.axes }
    }

    /// The sum: in the axes that both share, or else in those of `ground`.
    #[must_use]
    pub fn plus(&self, other: &Self, ground: Vector<'m>) -> Self {
        if self.components.is_zero() {
            *other
        } else if other.components.is_zero() {
            *self
        } else if self.axes == other.axes {
            Self { components: self.components + other.components, axes: self.axes }
        } else {
            Self { components: self.ground() + other.ground(), axes: ground }
        }
    }
}
