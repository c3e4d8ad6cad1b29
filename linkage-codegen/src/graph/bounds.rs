//! Between which bounds a value lies whatever its symbols are: what fails at every pose is found before any is given, and what cannot
//! overflow needs no check.

use std::collections::BTreeSet;

use super::{Condition, Graph, Guard, Kernel, NodeId, Op, Scalar, Symbol};
use crate::model::ids::ParamId;

/// Bounds that hold in spite of rounding: of the value as a function computes it, and of their own. Without bounds a value may also be
/// no number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    low: f64,
    high: f64,
}

impl Bounds {
    /// Of what may be anything.
    pub(crate) const ANY: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Of zero.
    pub(crate) const ZERO: Self = Self { low: 0.0, high: 0.0 };

    /// Of any finite number of a scalar.
    pub(crate) fn finite(scalar: Scalar) -> Self {
        let largest = scalar.largest();
        Self { low: -largest, high: largest }
    }

    /// Of what is moderate.
    pub(crate) fn moderate(scalar: Scalar) -> Self {
        let limit = scalar.moderate();
        Self { low: -limit, high: limit }
    }

    /// Of a value within them that is not less than a number.
    pub(crate) fn not_below(self, least: f64) -> Self {
        Self { low: self.low.max(least), high: self.high }
    }

    /// Of what lies within these or others.
    pub(crate) fn or(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether a number lies within them.
    pub(crate) fn contain(self, number: f64) -> bool {
        self.low <= number && number <= self.high
    }

    pub(crate) fn low(self) -> f64 {
        self.low
    }

    /// Whether a value within them is finite in a scalar.
    pub(crate) fn are_finite(self, scalar: Scalar) -> bool {
        let largest = scalar.largest();
        -largest <= self.low && self.high <= largest
    }

    /// Whether a value within them, added to a finite one, leaves it finite: it is below half of what lies between the largest two.
    pub(crate) fn change_no_finite(self, scalar: Scalar) -> bool {
        self.magnitude().high <= scalar.largest() * scalar.epsilon().to_f64() / 8.0
    }

    /// Takes the rounding of an operation into account, which never passes over zero; where nothing is known, anything goes.
    fn rounded(self, scalar: Scalar) -> Self {
        if self.low.is_nan() || self.high.is_nan() {
            return Self::ANY;
        }
        Self { low: rounded_down(self.low, scalar), high: -rounded_down(-self.high, scalar) }
    }

    fn opposite(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }

    fn magnitude(self) -> Self {
        let low = if self.low > 0.0 { self.low } else { (-self.high).max(0.0) };
        Self { low, high: self.high.max(-self.low) }
    }

    /// Of a sum.
    fn plus(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }

    fn times(self, other: Self) -> Self {
        let corners = [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        if corners.iter().any(|x| x.is_nan()) {
            return Self::ANY;
        }
        let least = corners.iter().copied().fold(f64::INFINITY, f64::min);
        Self { low: least, high: corners.iter().copied().fold(f64::NEG_INFINITY, f64::max) }
    }

    fn over(self, other: Self) -> Self {
        if other.low <= 0.0 && other.high >= 0.0 {
            return Self::ANY;
        }
        self.times(Self { low: 1.0 / other.high, high: 1.0 / other.low })
    }

    /// Whether any of the values is negative.
    pub(crate) fn has_negative(self) -> bool {
        self.low < 0.0
    }
}

/// What rounding leaves of a result at the least. It never passes over zero.
pub(crate) fn rounded_down(x: f64, scalar: Scalar) -> f64 {
    let (epsilon, tiny) = match scalar {
        Scalar::F64 => (f64::EPSILON, f64::MIN_POSITIVE),
        Scalar::F32 => (f64::from(f32::EPSILON), f64::from(f32::MIN_POSITIVE)),
    };
    let lower = x - (4.0 * epsilon * x.abs() + tiny);
    if x < 0.0 { lower } else { lower.max(0.0) }
}

impl Graph {
    /// Checks that fail whatever the parameters, the drives and the loads are.
    #[must_use]
    pub fn impossible_guards(&self) -> Vec<Guard> {
        let guards = self.guards();
        let bounds = self.bounds();
        let fails = |guard: &Guard| {
            let [a, b] = guard.condition.operands();
            if let Some((a, b)) = self.constant_value(a).zip(self.constant_value(b)) {
                return match guard.condition {
                    Condition::Above { .. } => !a.compare(&b).is_gt(),
                    Condition::AtLeast { .. } => a.compare(&b).is_lt(),
                };
            }
            bounds[a.index()].high < bounds[b.index()].low
        };
        guards.into_iter().filter(fails).collect()
    }

    /// All checks.
    #[must_use]
    pub fn guards(&self) -> Vec<Guard> {
        self.arena.borrow().guards.clone()
    }

    /// The parameters that some nodes depend on.
    #[must_use]
    pub fn parameters_of(&self, nodes: &[NodeId]) -> BTreeSet<ParamId> {
        let (mut open, mut seen, mut found) = (nodes.to_vec(), BTreeSet::new(), BTreeSet::new());
        while let Some(node) = open.pop() {
            if seen.insert(node) {
                let op = self.op(node);
                open.extend(op.operands());
                if let Op::Symbol(Symbol::Parameter(param)) = op {
                    found.insert(param);
                }
            }
        }
        found
    }

    /// The bounds of every node. Operands come before what reads them.
    fn bounds(&self) -> Vec<Bounds> {
        let mut all: Vec<Bounds> = Vec::with_capacity(self.len());
        for index in 0..self.len() {
            let id = NodeId(super::index(index));
            let found = self.bounds_of(id, &all);
            all.push(found);
        }
        all
    }

    fn bounds_of(&self, id: NodeId, known: &[Bounds]) -> Bounds {
        self.bounds_of_op(&self.op(id), |operand| known[operand.index()])
    }

    /// The bounds of what an operation makes of operands within theirs.
    pub(crate) fn bounds_of_op<T: Copy + PartialEq>(&self, op: &Op<T>, of: impl Fn(T) -> Bounds) -> Bounds {
        let computed = |bounds: Bounds| bounds.rounded(self.scalar());
        match *op {
            Op::Constant(number) => {
                let value = self.number(number).to_f64();
                computed(Bounds { low: value, high: value })
            }
            Op::Neg(a) => of(a).opposite(),
            Op::Abs(a) => of(a).magnitude(),
            Op::NonNegative(a) => Bounds { low: of(a).low.max(0.0), high: of(a).high.max(0.0) },
            Op::Lesser(a, b) => Bounds { low: of(a).low.min(of(b).low), high: of(b).high },
            Op::Sqrt(a) => computed(Bounds { low: of(a).low.max(0.0).sqrt(), high: of(a).high.max(0.0).sqrt() }),
            Op::Add(a, b) => computed(of(a).plus(of(b))),
            Op::Sub(a, b) => computed(of(a).plus(of(b).opposite())),
            Op::Mul(a, b) if a == b => computed(of(a).magnitude().times(of(a).magnitude())),
            Op::Mul(a, b) => computed(of(a).times(of(b))),
            Op::Div(a, b) => computed(of(a).over(of(b))),
            Op::Where { then, .. } => Bounds { low: of(then).low.min(0.0), high: of(then).high.max(0.0) },
            Op::Quantity(a) | Op::Held(a) | Op::Checked { value: a, .. } => of(a),
            Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_) | Kernel::Unit, .. } => {
                computed(Bounds { low: -1.0, high: 1.0 })
            }
            Op::Kernel { kernel: Kernel::Atan2, .. } => {
                computed(Bounds { low: -core::f64::consts::PI, high: core::f64::consts::PI })
            }
            Op::Kernel { kernel: Kernel::MulAdd, ref args, .. } => match args[..] {
                [a, b, c] => computed(computed(of(a).times(of(b))).plus(of(c))),
                _ => Bounds::ANY,
            },
            Op::Symbol(Symbol::Side(_)) => Bounds { low: -1.0, high: 1.0 },
            Op::Kernel { kernel: Kernel::Search { search, .. }, part, .. } if self.finds_direction(search, part) => {
                computed(Bounds { low: -1.0, high: 1.0 })
            }
            Op::Symbol(_) | Op::Kernel { .. } => Bounds::ANY,
        }
    }
}
