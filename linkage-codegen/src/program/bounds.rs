//! Between which bounds the values of a program lie, whatever its arguments are or where these are moderate.

use std::collections::BTreeMap;

use super::{Definition, Input, Program, Step, Value, ValueId};
use crate::graph::bounds::{Bounds, rounded_down};
use crate::graph::{Condition, Graph, Kernel, Op, Scalar, Symbol};

/// What is known of a number that a function has from a pose.
#[derive(Clone, Copy, Debug)]
pub struct Within {
    bounds: Bounds,
    /// If it is more than zero it is not less than this: a pivot is kept as zero where it is no larger than its rounding.
    least_above_zero: f64,
}

impl Within {
    /// Of any finite number.
    pub(super) fn finite(scalar: Scalar) -> Self {
        Self { bounds: Bounds::finite(scalar), least_above_zero: 0.0 }
    }

    /// Whether it may be this number.
    #[must_use]
    pub fn allows(self, number: f64) -> bool {
        self.bounds.contain(number) && (number <= 0.0 || number >= self.least_above_zero)
    }

    /// Of one that comes of either of two programs.
    pub(super) fn or(self, other: Self) -> Self {
        let least_above_zero = self.least_above_zero.min(other.least_above_zero);
        Self { bounds: self.bounds.or(other.bounds), least_above_zero }
    }
}

/// What values are not less than where conditions hold.
fn least_where<'c>(
    conditions: impl IntoIterator<Item = &'c Condition<ValueId>>,
    program: &Program,
    graph: &Graph,
    bounds: &[Bounds],
) -> BTreeMap<ValueId, f64> {
    let mut all: BTreeMap<ValueId, f64> = BTreeMap::new();
    for condition in conditions {
        let [value, limit] = condition.operands();
        let mut least = least(program, graph, bounds, limit);
        if let (Condition::Above { .. }, Some(within)) = (condition, program.value(value).within)
            && least >= 0.0
        {
            least = least.max(within.least_above_zero);
        }
        all.entry(value).and_modify(|known| *known = known.max(least)).or_insert(least);
    }
    all
}

/// What a value is not less than, if it is a number: it may be infinite, as a drive may be beyond which angles are rounded.
fn least(program: &Program, graph: &Graph, bounds: &[Bounds], value: ValueId) -> f64 {
    let of = |value: ValueId| least(program, graph, bounds, value);
    let known = bounds[value.index()].low();
    let found = match program.op(value) {
        Some(Op::Abs(_)) => 0.0,
        Some(Op::Add(a, b)) => of(*a) + of(*b),
        Some(Op::Mul(a, b)) => match [of(*a), of(*b)] {
            [a, b] if a >= 0.0 && b >= 0.0 => a * b,
            _ => return known,
        },
        _ => return known,
    };
    if found >= 0.0 { known.max(rounded_down(found, graph.scalar())) } else { known }
}

/// What arguments may be. Poses and prepared linkages hold finite numbers only, but for bounds of errors where nothing can be said: these are
/// read as the lesser of them and the largest number.
pub(super) struct Given {
    pub(super) drives: Bounds,
    /// Loads and rates.
    pub(super) given: Bounds,
}

impl Given {
    /// Drives are checked.
    pub(super) fn anything(scalar: Scalar) -> Self {
        Self { drives: Bounds::finite(scalar), given: Bounds::ANY }
    }

    /// The bounds of all values.
    pub(super) fn bounds(&self, program: &Program, graph: &Graph) -> Vec<Bounds> {
        self.bounds_with(program, graph, &BTreeMap::new())
    }

    /// Whether checked results lie within bounds.
    pub(super) fn bound_results(&self, program: &Program, graph: &Graph) -> bool {
        let bounds = self.behind_checks(program, graph);
        program.steps.iter().all(|step| match step {
            Step::FiniteResults(checked) => {
                checked.iter().all(|value| bounds[value.index()].are_finite(graph.scalar()))
            }
            _ => true,
        })
    }

    /// The bounds of all values where no check has failed.
    fn behind_checks(&self, program: &Program, graph: &Graph) -> Vec<Bounds> {
        let before = self.bounds(program, graph);
        let conditions = program.steps.iter().filter_map(|step| match step {
            Step::Check { guard, .. } => Some(&guard.condition),
            _ => None,
        });
        self.bounds_with(program, graph, &least_where(conditions, program, graph, &before))
    }

    /// What is known of a program's results, where these are checked to be finite.
    pub(super) fn results(&self, program: &Program, graph: &Graph) -> Vec<Within> {
        let bounds = self.behind_checks(program, graph);
        let within = |result: ValueId| {
            let [found, above_zero] = self.of_result(program, graph, (&bounds, result));
            let finite = if found.are_finite(graph.scalar()) { found } else { Bounds::finite(graph.scalar()) };
            Within { bounds: finite, least_above_zero: above_zero.low().max(0.0) }
        };
        program.outputs.iter().map(|(_, result)| within(*result)).collect()
    }

    /// The bounds of a value, and those where it is not zero for its conditions.
    pub(super) fn of_result(
        &self,
        program: &Program,
        graph: &Graph,
        (bounds, value): (&[Bounds], ValueId),
    ) -> [Bounds; 2] {
        if let Some(Op::Where { .. }) = program.op(value) {
            let chosen = self.chosen(program, graph, (bounds, value));
            [chosen.or(Bounds::ZERO), chosen]
        } else {
            [bounds[value.index()]; 2]
        }
    }

    /// The bounds of a value that is zero elsewhere, where its conditions hold. What one of them compares may be such a value itself: where it
    /// is more than zero, its own conditions hold.
    fn chosen(&self, program: &Program, graph: &Graph, (bounds, value): (&[Bounds], ValueId)) -> Bounds {
        let (mut conditions, mut then) = (Vec::new(), value);
        while let Some(Op::Where { value, limit, then: inner }) = program.op(then) {
            conditions.push(Condition::Above { value: *value, limit: *limit });
            then = *inner;
        }
        let mut least = least_where(&conditions, program, graph, bounds);
        for (value, known) in &mut least {
            if *known >= 0.0 && matches!(program.op(*value), Some(Op::Where { .. })) {
                *known = known.max(self.chosen(program, graph, (bounds, *value)).low());
            }
        }
        self.bounds_with(program, graph, &least)[then.index()]
    }

    /// The same of values of which some are not less than these numbers.
    fn bounds_with(&self, program: &Program, graph: &Graph, least: &BTreeMap<ValueId, f64>) -> Vec<Bounds> {
        let mut known = vec![None; program.values.len()];
        (0..known.len()).map(|index| self.bounds_of((program, graph, least), ValueId::new(index), &mut known)).collect()
    }

    fn of_input(&self, input: Input, graph: &Graph) -> Bounds {
        match input {
            Input::Symbol(Symbol::Drive(_)) => self.drives,
            Input::Symbol(Symbol::Load(..) | Symbol::Driven(..)) => self.given,
            Input::Symbol(symbol @ Symbol::Side(_)) => {
                graph.bounds_of_op(&Op::<ValueId>::Symbol(symbol), |_| Bounds::ANY)
            }
            Input::Kept(_) | Input::Prepared(_) => Bounds::finite(graph.scalar()),
            Input::Symbol(_) | Input::Known(_) => Bounds::ANY,
        }
    }

    fn bounds_of(
        &self,
        context: (&Program, &Graph, &BTreeMap<ValueId, f64>),
        value: ValueId,
        known: &mut Vec<Option<Bounds>>,
    ) -> Bounds {
        let (program, graph, least) = context;
        if let Some(bounds) = known[value.index()] {
            return bounds;
        }
        let scalar = graph.scalar();
        let Value { definition, within, .. } = program.value(value);
        let found = match (definition, within) {
            (Definition::Input(_), Some(within)) => within.bounds,
            (Definition::Input(input), None) => self.of_input(*input, graph),
            (Definition::Computed(op), _) => {
                for operand in op.operands() {
                    self.bounds_of(context, operand, known);
                }
                let of = |operand: ValueId| known[operand.index()].unwrap_or(Bounds::ANY);
                // Bounds of numbers; these give none.
                let no_number = match op {
                    Op::Sqrt(a) => of(*a).has_negative(),
                    Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_) | Kernel::Atan2, args, .. } => {
                        !args.iter().all(|arg| of(*arg).are_finite(scalar))
                    }
                    // The directions that it finds have been brought to unit size, from a start that is finite.
                    Op::Kernel { kernel: Kernel::Search { .. } | Kernel::MulAdd, .. } => false,
                    Op::Kernel { .. } => true,
                    // Of an operand that is no number nothing is known.
                    _ => false,
                };
                if no_number { Bounds::ANY } else { graph.bounds_of_op(op, of) }
            }
        };
        // Beyond the largest number it is infinite, and what becomes of it may be no number.
        let found = if found.are_finite(scalar) { found } else { Bounds::ANY };
        let found = least.get(&value).map_or(found, |least| found.not_below(*least));
        known[value.index()] = Some(found);
        found
    }
}
