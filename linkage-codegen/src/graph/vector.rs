//! Plane vectors of expressions.

use core::ops::{Add, Mul, Neg, Sub};

use super::{Expr, Graph};

/// A vector `(x, y)`; a direction where it has unit size, and then also the rotation that turns the x axis into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<'g> {
    /// Abscissa.
    pub x: Expr<'g>,
    /// Ordinate.
    pub y: Expr<'g>,
}

impl<'g> Vector<'g> {
    /// From its components.
    #[must_use]
    pub fn new(x: Expr<'g>, y: Expr<'g>) -> Self {
        Self { x, y }
    }

    /// Its graph.
    #[must_use]
    pub fn graph(self) -> &'g Graph {
        self.x.graph()
    }

    /// Whether both components are the constant zero.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.x.is_zero() && self.y.is_zero()
    }

    /// Whether both components are constants.
    #[must_use]
    pub fn is_constant(self) -> bool {
        self.x.value().is_some() && self.y.value().is_some()
    }

    /// Inner product.
    #[must_use]
    pub fn dot(self, other: Self) -> Expr<'g> {
        self.x * other.x + self.y * other.y
    }

    /// Outer product `x₁y₂ − y₁x₂`: the moment of `other` at the lever arm `self`.
    #[must_use]
    pub fn cross(self, other: Self) -> Expr<'g> {
        self.x * other.y - self.y * other.x
    }

    /// Turned by +90°.
    #[must_use]
    pub fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Turned by a direction: the vector whose components in the turned axes are these. Both ways along a constant vector are one, with either
    /// sign, so that the arm of a moment is what the pose is made of; where x is zero, each component is one product anyway.
    #[must_use]
    pub fn turned_by(self, direction: Self) -> Self {
        if self.is_constant() && self.x.sign() == Some(-1) {
            return -((-self).turned_by(direction));
        }
        Self { x: direction.x * self.x - direction.y * self.y, y: direction.y * self.x + direction.x * self.y }
    }

    /// Turned back by a direction: its components in the turned axes.
    #[must_use]
    pub fn resolved_along(self, direction: Self) -> Self {
        Self { x: direction.dot(self), y: direction.cross(self) }
    }

    /// Mirrored in the x axis: the opposite rotation of a direction.
    #[must_use]
    pub fn conjugate(self) -> Self {
        Self { x: self.x, y: -self.y }
    }

    /// Squared size.
    #[must_use]
    pub fn squared(self) -> Expr<'g> {
        self.dot(self)
    }

    /// Size.
    #[must_use]
    pub fn size(self) -> Expr<'g> {
        self.squared().sqrt()
    }

    /// Scaled by `factor`.
    #[must_use]
    pub fn scaled(self, factor: Expr<'g>) -> Self {
        Self { x: factor * self.x, y: factor * self.y }
    }

    /// Both components as values that a pose keeps.
    #[must_use]
    pub fn held(self) -> Self {
        Self { x: self.x.held(), y: self.y.held() }
    }

    /// Names both components, `_x` and `_y`.
    #[must_use]
    pub fn named(self, name: &str, equation: &str) -> Self {
        Self { x: self.x.named(format!("{name}_x"), equation), y: self.y.named(format!("{name}_y"), equation) }
    }

    /// The same for what is made already: its names stand under the headings of where it was made.
    #[must_use]
    pub fn named_where_made(self, name: &str, equation: &str) -> Self {
        let [x, y] = [(self.x, "x"), (self.y, "y")]
            .map(|(part, axis)| self.graph().beside(part.id(), || part.named(format!("{name}_{axis}"), equation)));
        Self { x, y }
    }

    /// Names both components of a direction, `_cos` and `_sin`.
    #[must_use]
    pub fn named_direction(self, name: &str, equation: &str) -> Self {
        Self { x: self.x.named(format!("{name}_cos"), equation), y: self.y.named(format!("{name}_sin"), equation) }
    }
}

impl Add for Vector<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Vector<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for Vector<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

impl<'g> Mul<Vector<'g>> for Expr<'g> {
    type Output = Vector<'g>;
    fn mul(self, vector: Vector<'g>) -> Vector<'g> {
        vector.scaled(self)
    }
}
