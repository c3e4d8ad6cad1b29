//! Between which bounds a value lies whatever its symbols are: what fails at every pose is found before any is given.

use std::collections::BTreeSet;

use super::{Condition, Graph, Guard, Kernel, NodeId, Op, Symbol};
use crate::model::ids::ParamId;

/// Bounds that hold in spite of the rounding with which they are worked out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    low: f64,
    high: f64,
}

impl Bounds {
    const ANY: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Takes the rounding of one operation into account; where nothing is known, anything goes.
    fn rounded(low: f64, high: f64) -> Self {
        let wider = |x: f64, by: f64| x + by * (x.abs() * 1e-15 + f64::MIN_POSITIVE);
        if low.is_nan() || high.is_nan() { Self::ANY } else { Self { low: wider(low, -1.0), high: wider(high, 1.0) } }
    }

    fn of_all(corners: &[f64]) -> Self {
        if corners.iter().any(|x| x.is_nan()) {
            return Self::ANY;
        }
        let least = corners.iter().copied().fold(f64::INFINITY, f64::min);
        Self::rounded(least, corners.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    }

    fn magnitude(self) -> Self {
        let low = if self.low > 0.0 { self.low } else { (-self.high).max(0.0) };
        Self { low, high: self.high.max(-self.low) }
    }

    fn times(self, other: Self) -> Self {
        let corners = [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        Self::of_all(&corners)
    }

    fn over(self, other: Self) -> Self {
        if other.low <= 0.0 && other.high >= 0.0 {
            return Self::ANY;
        }
        self.times(Self::rounded(1.0 / other.high, 1.0 / other.low))
    }
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
        let of = |id: NodeId| known[id.index()];
        match self.op(id) {
            Op::Constant(number) => {
                let value = self.number(number).to_f64();
                Bounds::rounded(value, value)
            }
            Op::Neg(a) => Bounds { low: -of(a).high, high: -of(a).low },
            Op::Abs(a) => of(a).magnitude(),
            Op::NonNegative(a) => Bounds { low: of(a).low.max(0.0), high: of(a).high.max(0.0) },
            Op::Sqrt(a) => Bounds::rounded(of(a).low.max(0.0).sqrt(), of(a).high.max(0.0).sqrt()),
            Op::Add(a, b) => Bounds::rounded(of(a).low + of(b).low, of(a).high + of(b).high),
            Op::Sub(a, b) => Bounds::rounded(of(a).low - of(b).high, of(a).high - of(b).low),
            Op::Mul(a, b) if a == b => of(a).magnitude().times(of(a).magnitude()),
            Op::Mul(a, b) => of(a).times(of(b)),
            Op::Div(a, b) => of(a).over(of(b)),
            Op::Where { then, .. } => Bounds { low: of(then).low.min(0.0), high: of(then).high.max(0.0) },
            Op::Quantity(a) | Op::Held(a) | Op::Checked { value: a, .. } => of(a),
            Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_) | Kernel::Unit, .. } => {
                Bounds::rounded(-1.0, 1.0)
            }
            Op::Symbol(_) | Op::Kernel { .. } => Bounds::ANY,
        }
    }
}
