//! Folding: what is simplified while an expression is written.
//!
//! Every rule keeps the value up to the rounding of its terms, and none adds an operation to what is read only here. Signs are pulled
//! outwards (they are exact), constants are merged exactly, and a divisor that is known earlier than its dividend becomes a factor that is
//! prepared once.

use core::cmp::Ordering;

use super::number::Number;
use super::{Condition, Expr, Graph, Guard, Kernel, NodeId, Op, Stage, Symbol};

impl Graph {
    pub(super) fn sum<'g>(&'g self, a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
        match (a.value(), b.value()) {
            (Some(x), Some(y)) => return self.constant(&x.add(&y)),
            (Some(x), None) if x.is_zero() => return b,
            (None, Some(y)) if y.is_zero() => return a,
            (Some(x), None) => return self.plus_constant(b, &x),
            (None, Some(y)) => return self.plus_constant(a, &y),
            _ => {}
        }
        match (a.op(), b.op()) {
            (_, Op::Neg(y)) => a - self.expr(y),
            (Op::Neg(x), _) => b - self.expr(x),
            _ => {
                let merged = self.like_terms(a, b, false).or_else(|| self.like_terms(b, a, false));
                merged.unwrap_or_else(|| self.intern(Op::Add(a.id(), b.id())))
            }
        }
    }

    pub(super) fn difference<'g>(&'g self, a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
        if self.are_one(a, b) {
            return self.zero();
        }
        match (a.value(), b.value()) {
            (Some(x), Some(y)) => return self.constant(&x.sub(&y)),
            (Some(x), None) if x.is_zero() => return -b,
            (None, Some(y)) if y.is_zero() => return a,
            (None, Some(y)) => return self.plus_constant(a, &y.neg()),
            (Some(x), None) => match b.op() {
                // k − (y ± c), with both constants in one.
                Op::Add(y, c) if self.constant_value(c).is_some() => {
                    return self.constant(&x) - self.expr(c) - self.expr(y);
                }
                Op::Sub(c, y) if self.constant_value(c).is_some() => {
                    return (self.constant(&x) - self.expr(c)) + self.expr(y);
                }
                Op::Sub(y, c) if self.constant_value(c).is_some() => {
                    return (self.constant(&x) + self.expr(c)) - self.expr(y);
                }
                _ => {}
            },
            _ => {}
        }
        match (a.op(), b.op()) {
            (_, Op::Neg(y)) => a + self.expr(y),
            (Op::Neg(x), _) => -(self.expr(x) + b),
            _ => {
                let merged = self.like_terms(a, b, true).or_else(|| self.like_terms(b, a, true).map(|merged| -merged));
                merged.unwrap_or_else(|| match self.find(&Op::Sub(b.id(), a.id())) {
                    Some(opposite) => self.intern(Op::Neg(opposite.id())),
                    None => self.intern(Op::Sub(a.id(), b.id())),
                })
            }
        }
    }

    /// `a ± b`, if b and a, or b and a term of a, are multiples of one value: one product of both constants' sum.
    ///
    /// A multiple that is the rounding of the other one stays by itself: in the sum of the constants it would be lost. And so does a small one
    /// beside a term of a sum of which little may be left, unless it takes from that term.
    fn like_terms<'g>(&'g self, a: Expr<'g>, b: Expr<'g>, negative: bool) -> Option<Expr<'g>> {
        let (k, x) = self.coefficient(b);
        let k = if negative { k.neg() } else { k };
        let rounding = 4.0 * self.scalar.epsilon().to_f64();
        let merged = |term: Expr<'g>, least_added: f64| {
            let (own, factor) = self.coefficient(term);
            let least = if own.signum() == k.signum() { least_added } else { rounding };
            let sizes = [own.to_f64().abs(), k.to_f64().abs()];
            let alike = sizes[0].min(sizes[1]) > least * sizes[0].max(sizes[1]);
            (self.are_one(factor, x) && alike).then(|| self.constant(&own.add(&k)) * x)
        };
        if let Some(product) = merged(a, rounding) {
            return Some(product);
        }
        let (first, second) = match a.op() {
            Op::Add(y, z) => (self.expr(y), self.expr(z)),
            Op::Sub(y, z) => (self.expr(y), -self.expr(z)),
            _ => return None,
        };
        let of_sum = |term| merged(term, 1.0 / 16.0);
        of_sum(first).map(|product| product + second).or_else(|| of_sum(second).map(|product| first + product))
    }

    /// A value as a constant and what it multiplies.
    fn coefficient<'g>(&'g self, a: Expr<'g>) -> (Number, Expr<'g>) {
        match a.op() {
            Op::Neg(x) => {
                let (k, x) = self.coefficient(self.expr(x));
                (k.neg(), x)
            }
            Op::Mul(k, x) => self.constant_value(k).map_or((Number::one(), a), |k| (k, self.expr(x))),
            _ => (Number::one(), a),
        }
    }

    /// `x + k`, merged with a constant that `x` already adds.
    fn plus_constant<'g>(&'g self, x: Expr<'g>, k: &Number) -> Expr<'g> {
        match x.op() {
            Op::Add(y, c) if self.constant_value(c).is_some() => self.expr(y) + (self.expr(c) + self.constant(k)),
            Op::Sub(c, y) if self.constant_value(c).is_some() => (self.expr(c) + self.constant(k)) - self.expr(y),
            Op::Sub(y, c) if self.constant_value(c).is_some() => self.expr(y) + (self.constant(k) - self.expr(c)),
            Op::Neg(y) => self.constant(k) - self.expr(y),
            _ if k.signum() < 0 => {
                let k = self.constant(&k.neg());
                self.intern(Op::Sub(x.id(), k.id()))
            }
            _ => {
                let k = self.constant(k);
                self.intern(Op::Add(x.id(), k.id()))
            }
        }
    }

    /// Whether two values are one. What is computed and named may be compared with what it is, to see its rounding; a parameter has none.
    fn are_one(&self, a: Expr<'_>, b: Expr<'_>) -> bool {
        a == b || self.are_same(a, b) && matches!(self.op(self.bare(a.id())), Op::Symbol(_))
    }

    /// Whether two values are one but for their names and checks.
    pub(crate) fn are_same(&self, a: Expr<'_>, b: Expr<'_>) -> bool {
        self.bare(a.id()) == self.bare(b.id())
    }

    pub(super) fn product<'g>(&'g self, a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
        match (a.value(), b.value()) {
            (Some(x), Some(y)) => return self.constant(&x.mul(&y)),
            (Some(k), None) => return self.times_constant(b, &k),
            (None, Some(k)) => return self.times_constant(a, &k),
            _ => {}
        }
        match (a.op(), b.op()) {
            (Op::Neg(x), _) => -(self.expr(x) * b),
            (_, Op::Neg(y)) => -(a * self.expr(y)),
            // The square of a root is its argument.
            (Op::Sqrt(x), Op::Sqrt(y)) if x == y => self.expr(x),
            // What divides a constant is multiplied by it again.
            (Op::Div(k, x), _) if self.constant_value(k).is_some() && self.are_same(self.expr(x), b) => self.expr(k),
            (_, Op::Div(k, y)) if self.constant_value(k).is_some() && self.are_same(self.expr(y), a) => self.expr(k),
            // A square has no sign.
            (Op::Abs(x), Op::Abs(y)) if x == y => self.expr(x) * self.expr(y),
            _ => self.intern(Op::Mul(a.id(), b.id())),
        }
    }

    /// `k·x`, merged with a constant factor that `x` already has.
    fn times_constant<'g>(&'g self, x: Expr<'g>, k: &Number) -> Expr<'g> {
        if k.is_zero() {
            return self.zero();
        }
        if k.is_one() {
            return x;
        }
        if k.signum() < 0 {
            return -self.times_constant(x, &k.neg());
        }
        match x.op() {
            Op::Neg(y) => -self.times_constant(self.expr(y), k),
            Op::Mul(c, y) if self.constant_value(c).is_some() => (self.constant(k) * self.expr(c)) * self.expr(y),
            Op::Div(c, y) if self.constant_value(c).is_some() => (self.constant(k) * self.expr(c)) / self.expr(y),
            _ => {
                let k = self.constant(k);
                self.intern(Op::Mul(k.id(), x.id()))
            }
        }
    }

    pub(super) fn quotient<'g>(&'g self, a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
        if a.is_zero() {
            return a;
        }
        if self.are_same(a, b) {
            return self.one();
        }
        if let Some(divisor) = b.value() {
            // A constant divisor of zero is refused before it gets here; should one come, the run-time checks report it.
            if let Some(inverse) = Number::one().div(&divisor) {
                return a * self.constant(&inverse);
            }
        }
        match (a.op(), b.op()) {
            (Op::Neg(x), _) => -(self.expr(x) / b),
            (_, Op::Neg(y)) => -(a / self.expr(y)),
            _ if b.stage() == Stage::Prepared && a.stage() > Stage::Prepared => a * (self.one() / b),
            _ => self.intern(Op::Div(a.id(), b.id())),
        }
    }

    pub(super) fn negative<'g>(&'g self, a: Expr<'g>) -> Expr<'g> {
        if let Some(value) = a.value() {
            return self.constant(&value.neg());
        }
        match a.op() {
            Op::Neg(x) => self.expr(x),
            // −(k − x) = x − k, merged with what else is added to it.
            Op::Sub(k, x) if self.constant_value(k).is_some() => self.expr(x) - self.expr(k),
            _ => self.intern(Op::Neg(a.id())),
        }
    }

    pub(super) fn sqrt<'g>(&'g self, a: Expr<'g>) -> Expr<'g> {
        if let Some(root) = a.value().and_then(|v| v.sqrt()) {
            return self.constant(&root);
        }
        match a.op() {
            Op::Mul(x, y) if x == y => self.expr(x).abs(),
            _ => self.intern(Op::Sqrt(a.id())),
        }
    }

    pub(super) fn abs<'g>(&'g self, a: Expr<'g>) -> Expr<'g> {
        if let Some(value) = a.value() {
            return self.constant(&value.abs());
        }
        match a.op() {
            Op::Neg(x) => self.expr(x).abs(),
            Op::Abs(_) => a,
            _ if self.is_non_negative(a) => a,
            _ => self.intern(Op::Abs(a.id())),
        }
    }

    pub(super) fn non_negative<'g>(&'g self, a: Expr<'g>) -> Expr<'g> {
        match a.sign() {
            Some(-1) => self.zero(),
            Some(_) => a,
            None if self.is_non_negative(a) => a,
            None => self.intern(Op::NonNegative(a.id())),
        }
    }

    pub(super) fn lesser<'g>(&'g self, a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
        match compare(a, b) {
            Some(Ordering::Less) => a,
            Some(_) => b,
            None => self.intern(Op::Lesser(a.id(), b.id())),
        }
    }

    pub(super) fn held<'g>(&'g self, a: Expr<'g>) -> Expr<'g> {
        match a.op() {
            Op::Constant(_) | Op::Symbol(_) | Op::Held(_) => a,
            _ if a.stage() < Stage::Posed => a,
            _ => self.intern(Op::Held(a.id())),
        }
    }

    pub(super) fn select<'g>(&'g self, value: Expr<'g>, limit: Expr<'g>, then: Expr<'g>) -> Expr<'g> {
        match compare(value, limit) {
            Some(Ordering::Greater) => then,
            Some(_) => self.zero(),
            None if then.is_zero() => then,
            None if limit.is_zero() && self.is_positive(value) => then,
            None => self.intern(Op::Where { value: value.id(), limit: limit.id(), then: then.id() }),
        }
    }

    pub(super) fn kernel<'g>(&'g self, kernel: Kernel, args: &[Expr<'g>], part: u8) -> Expr<'g> {
        let values: Option<Vec<Number>> = args.iter().map(|a| a.value()).collect();
        if let Some(values) = values {
            return self.constant(&self.apply(kernel, &values).swap_remove(usize::from(part)));
        }
        // The sine is odd, the cosine even.
        if let (Kernel::SinCos, Op::Neg(x)) = (kernel, args[0].op()) {
            let positive = self.kernel(kernel, &[self.expr(x)], part);
            return if part == 0 { -positive } else { positive };
        }
        self.intern(Op::Kernel { kernel, args: args.iter().map(|a| a.id()).collect(), part })
    }

    /// Angle of the direction `(x, y)`, in (−π, π].
    pub fn atan2<'g>(&'g self, y: Expr<'g>, x: Expr<'g>) -> Expr<'g> {
        self.kernel(Kernel::Atan2, &[y, x], 0)
    }

    /// Direction of a vector, zero for the zero vector.
    pub fn unit<'g>(&'g self, vector: super::Vector<'g>) -> super::Vector<'g> {
        let part = |part| self.kernel(Kernel::Unit, &[vector.x, vector.y], part);
        super::Vector { x: part(0), y: part(1) }
    }

    /// The solution of two or three linear equations.
    pub fn solved<'g>(&'g self, equations: &[(Vec<Expr<'g>>, Expr<'g>)]) -> Vec<Expr<'g>> {
        let kernel = if equations.len() == 2 { Kernel::Solve2 } else { Kernel::Solve3 };
        let coefficients = equations.iter().flat_map(|(row, _)| row.iter().copied());
        let args: Vec<Expr<'g>> = coefficients.chain(equations.iter().map(|(_, right)| *right)).collect();
        (0..kernel.parts()).map(|part| self.kernel(kernel, &args, part)).collect()
    }

    /// The value behind a check; a check that constants already pass is not made.
    pub(super) fn checked<'g>(&'g self, value: Expr<'g>, guard: &Guard) -> Expr<'g> {
        let [a, b] = guard.condition.operands().map(|id| self.expr(id));
        let passes = match (compare(a, b), guard.condition) {
            (Some(order), Condition::Above { .. }) => order == Ordering::Greater,
            (Some(order), Condition::AtLeast { .. }) => order != Ordering::Less,
            (None, Condition::AtLeast { .. }) => b.sign().is_some_and(|s| s <= 0) && self.is_non_negative(a),
            (None, Condition::Above { .. }) => {
                b.is_zero() && self.is_positive(a) || b.sign() == Some(-1) && self.is_non_negative(a)
            }
        };
        if passes {
            return value;
        }
        let guard = self.asked_before(guard).unwrap_or_else(|| self.intern_guard(guard.clone()));
        self.intern(Op::Checked { value: value.id(), guard })
    }

    /// Whether the value is positive by its form, or was stated to be.
    #[must_use]
    pub fn is_positive(&self, a: Expr<'_>) -> bool {
        let of = |id| self.is_positive(self.expr(id));
        if self.arena.borrow().positive.contains(&a.id()) {
            return true;
        }
        match a.op() {
            Op::Constant(_) => a.sign() == Some(1),
            Op::Add(x, y) => {
                let (x, y) = (self.expr(x), self.expr(y));
                self.is_positive(x) && self.is_non_negative(y) || self.is_non_negative(x) && self.is_positive(y)
            }
            Op::Mul(x, y) | Op::Div(x, y) => of(x) && of(y),
            Op::Sqrt(x) | Op::Quantity(x) | Op::Held(x) | Op::Checked { value: x, .. } => of(x),
            Op::Abs(x) => self.is_other_than_zero(self.expr(x)),
            _ => false,
        }
    }

    /// Whether the value is positive or negative by its form: a root on either side, or what was checked to be apart from zero.
    fn is_other_than_zero(&self, a: Expr<'_>) -> bool {
        let of = |id| self.is_other_than_zero(self.expr(id));
        if self.arena.borrow().positive.contains(&a.id()) {
            return true;
        }
        match a.op() {
            Op::Symbol(Symbol::Side(_)) => true,
            Op::Checked { value, guard } => {
                let condition = self.guard(guard).condition;
                let [compared, limit] = condition.operands();
                let is_it = |x: NodeId| x == value || self.op(value) == Op::Neg(x);
                let is_of_it = is_it(compared) || matches!(self.op(compared), Op::Abs(x) | Op::Neg(x) if is_it(x));
                let is_above = matches!(condition, Condition::Above { .. }) && self.is_non_negative(self.expr(limit));
                is_of_it && is_above || of(value)
            }
            Op::Neg(x) | Op::Quantity(x) | Op::Held(x) => of(x),
            Op::Mul(x, y) | Op::Div(x, y) => of(x) && of(y),
            _ => self.is_positive(a),
        }
    }

    /// Whether the value cannot be negative, by its form.
    #[must_use]
    pub fn is_non_negative(&self, a: Expr<'_>) -> bool {
        let of = |id| self.is_non_negative(self.expr(id));
        let known = {
            let arena = self.arena.borrow();
            arena.positive.contains(&a.id()) || arena.non_negative.contains(&a.id())
        };
        if known {
            return true;
        }
        let found = match a.op() {
            Op::Constant(_) => a.sign() != Some(-1),
            Op::Mul(x, y) if x == y => true,
            Op::Add(x, y) | Op::Mul(x, y) | Op::Div(x, y) | Op::Lesser(x, y) => of(x) && of(y),
            // What is there by itself, or where it is more than such a one.
            Op::Where { value, limit, then } => of(then) || value == then && of(limit),
            Op::Quantity(x) | Op::Held(x) | Op::Checked { value: x, .. } => of(x),
            Op::Sqrt(_) | Op::Abs(_) | Op::NonNegative(_) => true,
            _ => false,
        };
        if found {
            // Sums of sums of what is not negative share their parts: each is looked through once.
            self.arena.borrow_mut().non_negative.insert(a.id());
        }
        found
    }
}

fn compare(a: Expr<'_>, b: Expr<'_>) -> Option<Ordering> {
    Some(a.value()?.compare(&b.value()?))
}

#[cfg(test)]
mod tests {
    use crate::graph::number::Number;
    use crate::graph::{Graph, Scalar, Symbol};
    use crate::model::ids::DriveId;

    #[test]
    fn like_terms_become_one() {
        let graph = Graph::new(Scalar::F64);
        let [x, y] = [0, 1].map(|index| graph.symbol(Symbol::Drive(DriveId::new(index))));
        assert_eq!(3 * x + 2 * x, 5 * x);
        assert_eq!(3 * x - 2 * x, x);
        assert_eq!(2 * x - 3 * x, -x);
        assert_eq!(x + x, 2 * x);
        assert_eq!(x - 3 * x, -(2 * x));
        assert!((3 * x - 3 * x).is_zero());
        assert_eq!((y + 3 * x) - x, y + 2 * x);
        assert_eq!((3 * x + y) - 3 * x, y);
        assert_eq!((y - 3 * x) + 5 * x, y + 2 * x);
        assert_eq!((y - 3 * x) - x, y - 4 * x);
        assert_eq!((3 * x - y) + x, 4 * x - y);
        assert_eq!((3 * x - y) - 3 * x, -y);
        let tenth = graph.constant(&Number::ratio(1, 10));
        let hundredth = tenth * tenth;
        assert_eq!((x - y) + tenth * x, (graph.one() + tenth) * x - y);
        assert_ne!((x - y) + hundredth * x, (graph.one() + hundredth) * x - y);
        assert_eq!((x - y) - hundredth * x, (graph.one() - hundredth) * x - y);
        let [two, five] = [2, 5].map(|number| graph.integer(number));
        assert_eq!((y - five) + two, y + (two - five));
        assert_eq!((y - five) + five, y);
        assert_eq!(two - (y - five), (two + five) - y);
        let rounding = graph.epsilons(1) * x;
        assert_ne!(x + rounding, x);
        assert_eq!((x + rounding) + rounding, x + 2 * rounding);
    }

    /// What reads a value by its name reads no further.
    #[test]
    fn terms_of_a_named_sum_stay() {
        let graph = Graph::new(Scalar::F64);
        let [x, y] = [0, 1].map(|index| graph.symbol(Symbol::Drive(DriveId::new(index))));
        let sum = (y + 3 * x).named("sum", "");
        assert_ne!(sum - 3 * x, y);
        assert_eq!(2 * sum + sum, 3 * sum);
    }
}
