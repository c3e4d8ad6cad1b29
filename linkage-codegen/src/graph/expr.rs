//! Expressions written with operators.

use core::ops::{Add, Div, Mul, Neg, Sub};
use std::collections::BTreeMap;

use super::number::Number;
use super::{Component, Condition, Failure, Graph, Guard, Kernel, Label, NodeId, Op, Stage, Vector};

/// A node together with its graph.
#[derive(Clone, Copy)]
pub struct Expr<'g> {
    graph: &'g Graph,
    id: NodeId,
}

impl core::fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:?}={:?}", self.id, self.graph.op(self.id))
    }
}

impl PartialEq for Expr<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl<'g> Expr<'g> {
    pub(super) fn new(graph: &'g Graph, id: NodeId) -> Self {
        Self { graph, id }
    }

    /// Its node.
    #[must_use]
    pub fn id(self) -> NodeId {
        self.id
    }

    /// Its graph.
    #[must_use]
    pub fn graph(self) -> &'g Graph {
        self.graph
    }

    /// What it computes.
    #[must_use]
    pub fn op(self) -> Op {
        self.graph.op(self.id)
    }

    /// When it becomes known.
    #[must_use]
    pub fn stage(self) -> Stage {
        self.graph.stage(self.id)
    }

    /// Its value, if constant.
    #[must_use]
    pub fn value(self) -> Option<Number> {
        self.graph.constant_value(self.id)
    }

    /// Whether it is the constant zero.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.value().is_some_and(|v| v.is_zero())
    }

    /// Whether it is the constant one.
    #[must_use]
    pub fn is_one(self) -> bool {
        self.value().is_some_and(|v| v.is_one())
    }

    /// The sign of a constant.
    #[must_use]
    pub fn sign(self) -> Option<i8> {
        self.value().map(|v| v.signum())
    }

    /// The value as a named quantity, with the expression that it stands for. It is computed once and as it is written here; constants
    /// and symbols need no name, and the first name that a value gets is the one that stays.
    #[must_use]
    pub fn named(self, name: impl Into<String>, equation: impl Into<String>) -> Self {
        let is_named = matches!(self.op(), Op::Quantity(_)) && self.graph.label(self.id).is_some();
        if is_named || matches!(self.op(), Op::Constant(_) | Op::Symbol(_) | Op::Held(_)) {
            return self;
        }
        let quantity = self.as_it_is();
        self.graph.set_label(quantity.id, Label { name: name.into(), equation: equation.into() });
        quantity
    }

    /// The value as it is written here.
    fn as_it_is(self) -> Self {
        if let Op::Quantity(_) = self.op() { self } else { self.graph.intern(Op::Quantity(self.id)) }
    }

    /// The same value, put together in another way where a pose is given: of what this keeps, when it is made, and not each function by itself.
    #[must_use]
    pub fn or_from_pose(self, other: Self) -> Self {
        if self == other || matches!(self.op(), Op::Constant(_) | Op::Symbol(_) | Op::Held(_)) {
            return self;
        }
        let value = self.as_it_is();
        // Behind both, in the order of evaluation; one that was there before keeps its only way.
        if other.id < value.id {
            self.graph.arena.borrow_mut().from_pose.entry(value.id).or_insert(other.id);
        }
        value
    }

    /// Whether this is known to be more than 4ε of a size: more than rounding makes of zero, where numbers of this size are added up.
    #[must_use]
    pub fn exceeds_rounding_of(self, size: Self) -> bool {
        (self - self.graph.epsilons(4) * size).sign() == Some(1)
    }

    /// States that the value is positive wherever it is used.
    #[must_use]
    pub fn known_positive(self) -> Self {
        self.graph.arena.borrow_mut().positive.insert(self.id);
        self
    }

    /// The quotient as one that is divided, not multiplied by a reciprocal that it shares with others: it is rounded once.
    #[must_use]
    pub fn divided(self) -> Self {
        if let Op::Div(..) = self.op() {
            self.graph.arena.borrow_mut().divided.insert(self.id);
        }
        self
    }

    /// States that the value is a component of the direction of a link, and how long this is, if that is constant. Where no result is the
    /// direction itself, what is made of it may as well be made of a vector of that length. If one is given, it is that but for a few roundings.
    #[must_use]
    pub fn along(self, arm: Option<Self>, length: Self, name: &str) -> Self {
        let reciprocal = length.value().and_then(|length| Number::one().div(&length));
        if let (None, Some(reciprocal)) = (self.value(), reciprocal) {
            let component = Component { arm: arm.map(|arm| arm.id), reciprocal, length: name.to_owned() };
            self.graph.arena.borrow_mut().directions.insert(self.id, component);
        }
        self
    }

    /// The value as one that a pose keeps: nothing is folded through it, so that what reads it reads no further.
    #[must_use]
    pub fn held(self) -> Self {
        self.graph.held(self)
    }

    /// Square root.
    #[must_use]
    pub fn sqrt(self) -> Self {
        self.graph.sqrt(self)
    }

    /// Magnitude.
    #[must_use]
    pub fn abs(self) -> Self {
        self.graph.abs(self)
    }

    /// The sum of the magnitudes of the terms that make up the value: how large its rounding may be, in epsilons.
    #[must_use]
    pub fn magnitude(self) -> Self {
        self.magnitude_with(&mut BTreeMap::new())
    }

    /// The same, where the sizes of some values are known. What is gone into is added to them.
    #[must_use]
    pub fn magnitude_given(self, known: &mut BTreeMap<NodeId, Self>) -> Self {
        self.magnitude_with(known)
    }

    /// Values may use each other often: each is gone into once.
    fn magnitude_with(self, done: &mut BTreeMap<NodeId, Self>) -> Self {
        if let Some(found) = done.get(&self.id) {
            return *found;
        }
        let mut of = |id| self.graph.expr(id).magnitude_with(done);
        let found = match self.op() {
            Op::Neg(a) | Op::Quantity(a) => of(a),
            Op::Add(a, b) | Op::Sub(a, b) => of(a) + of(b),
            Op::Mul(a, b) => of(a) * of(b),
            Op::Div(a, b) => of(a) / self.graph.expr(b).abs(),
            _ => self.abs(),
        };
        done.insert(self.id, found);
        found
    }

    /// The value, or zero if it is negative.
    #[must_use]
    pub fn non_negative(self) -> Self {
        self.graph.non_negative(self)
    }

    /// The value, or a lesser one; that one, too, if this is not a number.
    #[must_use]
    pub fn at_most(self, limit: Self) -> Self {
        self.graph.lesser(self, limit)
    }

    /// The product with itself.
    #[must_use]
    pub fn squared(self) -> Self {
        self * self
    }

    /// Whole power.
    #[must_use]
    pub fn pow(self, exponent: u32) -> Self {
        (0..exponent).fold(self.graph.one(), |product, _| product * self)
    }

    /// `(cosine, sine)` of an angle.
    #[must_use]
    pub fn direction(self) -> Vector<'g> {
        let part = |part| self.graph.kernel(Kernel::SinCos, &[self], part);
        Vector { x: part(1), y: part(0) }
    }

    /// `(cosine, sine)` of the angle plus a constant, the sum not rounded.
    #[must_use]
    pub fn direction_plus(self, phase: &Number) -> Vector<'g> {
        if phase.is_zero() || self.value().is_some() {
            return (self + self.graph.constant(phase)).direction();
        }
        if let Number::Pi(turn) = phase {
            // A quarter turn swaps the two, exactly.
            let (sine, cosine) = phase.sin_cos();
            if (turn * dashu_ratio::RBig::from(2)).denominator().is_one() {
                let quarter = Vector::new(self.graph.constant(&cosine), self.graph.constant(&sine));
                return self.direction().turned_by(quarter);
            }
        }
        let kernel = Kernel::SinCosSum(self.graph.intern_number(phase));
        let part = |part| self.graph.kernel(kernel, &[self], part);
        Vector { x: part(1), y: part(0) }
    }

    /// The value where `compared > limit`, zero elsewhere.
    #[must_use]
    pub fn where_above(self, compared: Self, limit: Self) -> Self {
        self.graph.select(compared, limit, self)
    }

    /// The value, checked: `compared > limit`, or the failure.
    #[must_use]
    pub fn require_above(self, compared: Self, limit: Self, failure: Failure) -> Self {
        let condition = Condition::Above { value: compared.id, limit: limit.id };
        self.graph.checked(self, &Guard { condition, failure })
    }

    /// What must be positive, as a length or a mass: where parameters give it, it is checked when they are known.
    #[must_use]
    pub fn required_positive(self, requirement: String) -> Self {
        let checked = self.require_above(self, self.graph.zero(), Failure::Parameter { requirement });
        if checked.value().is_some() { checked } else { checked.known_positive() }
    }

    /// The value, checked: `compared >= limit`, or the failure.
    #[must_use]
    pub fn require_at_least(self, compared: Self, limit: Self, failure: Failure) -> Self {
        let condition = Condition::AtLeast { value: compared.id, limit: limit.id };
        self.graph.checked(self, &Guard { condition, failure })
    }
}

impl<'g> Add for Expr<'g> {
    type Output = Expr<'g>;
    fn add(self, other: Self) -> Self {
        self.graph.sum(self, other)
    }
}

impl<'g> Sub for Expr<'g> {
    type Output = Expr<'g>;
    fn sub(self, other: Self) -> Self {
        self.graph.difference(self, other)
    }
}

impl<'g> Mul for Expr<'g> {
    type Output = Expr<'g>;
    fn mul(self, other: Self) -> Self {
        self.graph.product(self, other)
    }
}

impl<'g> Div for Expr<'g> {
    type Output = Expr<'g>;
    fn div(self, other: Self) -> Self {
        self.graph.quotient(self, other)
    }
}

impl<'g> Neg for Expr<'g> {
    type Output = Expr<'g>;
    fn neg(self) -> Self {
        self.graph.negative(self)
    }
}

impl<'g> Mul<Expr<'g>> for i64 {
    type Output = Expr<'g>;
    fn mul(self, other: Expr<'g>) -> Expr<'g> {
        other.graph.integer(self) * other
    }
}
