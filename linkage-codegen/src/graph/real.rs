//! Number types in which a graph can be evaluated.

use super::number::Number;

/// The arithmetic of the emitted code, for any number type: the order of operations is the graph's own.
pub trait Real: Clone {
    /// The nearest number to a constant.
    fn from_number(number: &Number) -> Self;
    /// Sum.
    #[must_use]
    fn add(&self, other: &Self) -> Self;
    /// Difference.
    #[must_use]
    fn sub(&self, other: &Self) -> Self;
    /// Product.
    #[must_use]
    fn mul(&self, other: &Self) -> Self;
    /// Quotient.
    #[must_use]
    fn div(&self, other: &Self) -> Self;
    /// Negative.
    #[must_use]
    fn neg(&self) -> Self;
    /// Square root.
    #[must_use]
    fn sqrt(&self) -> Self;
    /// Product with a factor, plus a summand: rounded once, by numbers that are rounded at every operation.
    #[must_use]
    fn mul_add(&self, factor: &Self, summand: &Self) -> Self {
        self.mul(factor).add(summand)
    }
    /// Whether `self > other`.
    fn above(&self, other: &Self) -> bool;
    /// Whether `self >= other`.
    fn at_least(&self, other: &Self) -> bool;
    /// Whether it is a number, and not infinite.
    fn is_finite(&self) -> bool;
    /// Sine and cosine.
    #[must_use]
    fn sin_cos(&self) -> (Self, Self);
    /// Sine and cosine of the sum with a constant.
    #[must_use]
    fn sin_cos_sum(&self, phase: &Number) -> (Self, Self);
    /// [`sin_cos`](Real::sin_cos) in fused operations.
    #[must_use]
    fn fused_sin_cos(&self) -> (Self, Self) {
        self.sin_cos()
    }
    /// [`sin_cos_sum`](Real::sin_cos_sum) in fused operations.
    #[must_use]
    fn fused_sin_cos_sum(&self, phase: &Number) -> (Self, Self) {
        self.sin_cos_sum(phase)
    }
    /// Angle of the direction `(x, self)`.
    #[must_use]
    fn atan2(&self, x: &Self) -> Self;
    /// Direction of the vector `(self, y)`.
    #[must_use]
    fn unit(&self, y: &Self) -> (Self, Self);

    /// Nothing.
    #[must_use]
    fn zero() -> Self {
        Self::from_number(&Number::zero())
    }

    /// The number, and from it every product of a factor and a value taken away, one after the other.
    #[must_use]
    fn less_products<'t>(&self, factors: &'t [Self], values: &'t [Self]) -> Self {
        factors.iter().zip(values).fold(self.clone(), |sum, (factor, value)| sum.sub(&factor.mul(value)))
    }

    /// Magnitude.
    #[must_use]
    fn abs(&self) -> Self {
        if Self::zero().above(self) { self.neg() } else { self.clone() }
    }

    /// `(x, y)` of `a x + b y = e`, `c x + d y = f`, with `a` the number itself: elimination with the pivots of which the
    /// product is larger. The operations and their order are those of the run-time crate.
    #[must_use]
    fn solve_2(&self, b: &Self, c: &Self, d: &Self, [e, f]: [&Self; 2]) -> (Self, Self) {
        let exchanged = b.mul(c).abs().above(&self.mul(d).abs());
        let (a, b, e, c, d, f) = if exchanged { (c, d, f, self, b, e) } else { (self, b, e, c, d, f) };
        let factor = c.div(a);
        let y = f.sub(&factor.mul(e)).div(&d.sub(&factor.mul(b)));
        let x = e.sub(&b.mul(&y)).div(a);
        (x, y)
    }

    /// The solution of three equations, by elimination from the equation with the largest coefficient of the first unknown, refined once.
    #[must_use]
    fn solve_3(coefficients: &[Self], right: &[Self]) -> Vec<Self> {
        let solution = Self::eliminate_3(coefficients, right);
        let lines = coefficients.chunks(3).zip(right);
        let open: Vec<Self> = lines.map(|(line, right)| right.less_products(line, &solution)).collect();
        let more = Self::eliminate_3(coefficients, &open);
        solution.iter().zip(&more).map(|(value, more)| value.add(more)).collect()
    }

    /// The same without refinement.
    #[must_use]
    fn eliminate_3(coefficients: &[Self], right: &[Self]) -> Vec<Self> {
        let row = |i: usize| [&coefficients[3 * i], &coefficients[3 * i + 1], &coefficients[3 * i + 2], &right[i]];
        let mut rows = [row(0), row(1), row(2)];
        for other in [1, 2] {
            if rows[other][0].abs().above(&rows[0][0].abs()) {
                rows.swap(0, other);
            }
        }
        let [first, others @ ..] = rows;
        let [p, q] = others.map(|line| {
            let factor = line[0].div(first[0]);
            [1, 2, 3].map(|column| line[column].sub(&factor.mul(first[column])))
        });
        let (y, z) = p[0].solve_2(&p[1], &q[0], &q[1], [&p[2], &q[2]]);
        let x = first[3].sub(&first[1].mul(&y)).sub(&first[2].mul(&z)).div(first[0]);
        vec![x, y, z]
    }
}

/// Doubles, for what is decided at compile time by comparing sizes; the emitted code has its own functions.
impl Real for f64 {
    fn from_number(number: &Number) -> Self {
        number.to_f64()
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn div(&self, other: &Self) -> Self {
        self / other
    }
    fn neg(&self) -> Self {
        -self
    }
    fn sqrt(&self) -> Self {
        f64::sqrt(*self)
    }
    fn mul_add(&self, factor: &Self, summand: &Self) -> Self {
        f64::mul_add(*self, *factor, *summand)
    }
    fn above(&self, other: &Self) -> bool {
        self > other
    }
    fn at_least(&self, other: &Self) -> bool {
        self >= other
    }
    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }
    fn sin_cos(&self) -> (Self, Self) {
        f64::sin_cos(*self)
    }
    fn sin_cos_sum(&self, phase: &Number) -> (Self, Self) {
        f64::sin_cos(self + phase.to_f64())
    }
    fn atan2(&self, x: &Self) -> Self {
        f64::atan2(*self, *x)
    }
    fn unit(&self, y: &Self) -> (Self, Self) {
        let size = self.hypot(*y);
        if size > 0.0 { (self / size, y / size) } else { (0.0, 0.0) }
    }
}

/// The extended numbers of the compiler themselves, for answers far beyond the scalar's precision. A square root below zero and a
/// quotient by zero, which the emitted code reports as errors, are zero.
impl Real for Number {
    fn from_number(number: &Number) -> Self {
        number.clone()
    }
    fn add(&self, other: &Self) -> Self {
        Number::add(self, other)
    }
    fn sub(&self, other: &Self) -> Self {
        Number::sub(self, other)
    }
    fn mul(&self, other: &Self) -> Self {
        Number::mul(self, other)
    }
    fn div(&self, other: &Self) -> Self {
        Number::div(self, other).unwrap_or_else(Number::zero)
    }
    fn neg(&self) -> Self {
        Number::neg(self)
    }
    fn sqrt(&self) -> Self {
        Number::sqrt(self).unwrap_or_else(Number::zero)
    }
    fn above(&self, other: &Self) -> bool {
        self.compare(other).is_gt()
    }
    fn at_least(&self, other: &Self) -> bool {
        self.compare(other).is_ge()
    }
    fn is_finite(&self) -> bool {
        true
    }
    fn sin_cos(&self) -> (Self, Self) {
        Number::sin_cos(self)
    }
    fn sin_cos_sum(&self, phase: &Number) -> (Self, Self) {
        Number::add(self, phase).sin_cos()
    }
    fn atan2(&self, x: &Self) -> Self {
        Number::atan2(self, x)
    }
    fn unit(&self, y: &Self) -> (Self, Self) {
        let size = Real::sqrt(&Number::add(&self.mul(self), &y.mul(y)));
        (Real::div(self, &size), Real::div(y, &size))
    }
}
