//! A result is not checked to be finite where that is known already: because it lies within bounds whatever is given, or because
//! another one that is checked would not be finite either.
//!
//! What is infinite or no number stays so in sums, differences, products, roots, as dividend, and as argument of a sine or an angle; only
//! as divisor or in a comparison can it be lost. So one check stands for all from which the value is formed in these ways, arguments among
//! them: which of these it was is asked only where something has failed.
//!
//! Results of arguments that are not enormous, behind the checks of pivots, mostly lie within bounds: then arguments are looked at, which
//! waits for nothing, and results only where one is.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::bounds::Bounds;
use crate::graph::{Graph, Kernel, Op, Scalar, Symbol};
use crate::program::{Definition, Input, Program, Step, ValueId};

pub(super) fn check_once(mut program: Program, graph: &Graph) -> Program {
    let scalar = graph.scalar();
    let bounds = Given::anything(scalar).bounds(&program, graph);
    let mut steps = core::mem::take(&mut program.steps);
    for step in &mut steps {
        let Step::FiniteResults(checked) = step else { continue };
        let bare = |value: ValueId| bare(&program, &bounds, scalar, value);
        let mut all = BTreeSet::new();
        checked.retain(|value| !bounds[value.index()].are_finite(scalar) && all.insert(bare(*value)));
        let shown = program.shown_by(all);
        checked.retain(|value| !shown.contains(&bare(*value)));
        pairs_first(&program, checked);
    }
    steps.retain(|step| !matches!(step, Step::FiniteResults(checked) if checked.is_empty()));
    program.steps = steps;
    program
}

/// An argument need not be asked where a checked result is not finite without it: the check of this result is made anyway.
pub(super) fn ask_late(mut program: Program, _graph: &Graph) -> Program {
    let checked = program.steps.iter().filter_map(|step| match step {
        Step::FiniteResults(checked) => Some(checked),
        _ => None,
    });
    let shown = program.shown_by(checked.flatten().copied());
    let (mut steps, mut late) = (core::mem::take(&mut program.steps), core::mem::take(&mut program.asked_late));
    steps.retain(|step| match step {
        Step::FiniteInput(value) if shown.contains(value) => {
            late.push(*value);
            false
        }
        _ => true,
    });
    (program.steps, program.asked_late) = (steps, late);
    program
}

/// In the order in which they are computed, the two components of a vector before what stands alone: one register may hold both.
fn pairs_first(program: &Program, checked: &mut Vec<ValueId>) {
    checked.sort_unstable();
    let kind = |value: &ValueId| program.op(*value).map(core::mem::discriminant);
    let (mut all, mut alone) = (Vec::new(), Vec::new());
    for alike in checked.chunk_by(|one, next| kind(one) == kind(next)) {
        let pairs = alike.chunks_exact(2);
        alone.extend(pairs.remainder());
        all.extend(pairs.flatten());
    }
    all.append(&mut alone);
    *checked = all;
}

impl Program {
    /// The values that are finite if those given are: those from which these are formed.
    pub(crate) fn shown_by(&self, finite: impl IntoIterator<Item = ValueId>) -> BTreeSet<ValueId> {
        let inherited = |value: ValueId| match self.op(value) {
            Some(Op::Neg(a) | Op::Abs(a) | Op::Sqrt(a) | Op::Div(a, _)) => vec![*a],
            Some(Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b)) => vec![*a, *b],
            Some(Op::Kernel {
                kernel: Kernel::SinCos | Kernel::SinCosSum(_) | Kernel::Atan2 | Kernel::MulAdd,
                args,
                ..
            }) => args.clone(),
            _ => Vec::new(),
        };
        reached(finite.into_iter().flat_map(inherited), inherited)
    }
}

/// These values, and what one comes to from them step by step.
fn reached(from: impl IntoIterator<Item = ValueId>, next: impl Fn(ValueId) -> Vec<ValueId>) -> BTreeSet<ValueId> {
    let (mut open, mut reached) = (from.into_iter().collect::<Vec<_>>(), BTreeSet::new());
    while let Some(value) = open.pop() {
        if reached.insert(value) {
            open.extend(next(value));
        }
    }
    reached
}

/// What a value is not less than, if it is a number: it may be infinite, as a drive may be beyond which angles are rounded.
fn least(program: &Program, graph: &Graph, bounds: &[Bounds], value: ValueId) -> f64 {
    let of = |value: ValueId| least(program, graph, bounds, value);
    let known = bounds[value.index()].low();
    // What rounding leaves of it.
    let left = 1.0 - 4.0 * graph.scalar().epsilon().to_f64();
    let found = match program.op(value) {
        Some(Op::Abs(_)) => 0.0,
        Some(Op::Add(a, b)) => of(*a) + of(*b),
        Some(Op::Mul(a, b)) => match [of(*a), of(*b)] {
            [a, b] if a >= 0.0 && b >= 0.0 => a * b,
            _ => return known,
        },
        _ => return known,
    };
    if found >= 0.0 { known.max(found * left) } else { known }
}

/// The value without its signs, and without terms too small to take a finite number beyond the largest: it is finite where that is.
fn bare(program: &Program, bounds: &[Bounds], scalar: Scalar, mut value: ValueId) -> ValueId {
    let is_small = |term: &ValueId| bounds[term.index()].change_no_finite(scalar);
    loop {
        value = match program.op(value) {
            Some(Op::Neg(a) | Op::Abs(a)) => *a,
            Some(Op::Add(a, term) | Op::Add(term, a) | Op::Sub(a, term) | Op::Sub(term, a)) if is_small(term) => *a,
            _ => return value,
        };
    }
}

/// Remembers the arguments with which, if they are moderate, results are finite: the loads and rates, and the drives where these may be at
/// fault. Where that is none results are not checked.
pub(super) fn look_at_arguments(mut program: Program, graph: &Graph) -> Program {
    if !program.steps.iter().any(|step| matches!(step, Step::FiniteResults(_))) {
        return program;
    }
    let scalar = graph.scalar();
    let given = program.inputs_that(is_given);
    let drives = program.inputs_that(|input| matches!(input, Input::Symbol(Symbol::Drive(_))));
    let moderate = Bounds::moderate(scalar);
    let any_drives = Given { drives: Bounds::finite(scalar), given: moderate };
    let refused = program.refused();
    let arguments = if drives.iter().all(|drive| refused.contains(drive)) && any_drives.bound_results(&program, graph) {
        given
    } else if (Given { drives: moderate, given: moderate }).bound_results(&program, graph) {
        drives.into_iter().chain(given).collect()
    } else {
        return program;
    };
    if arguments.is_empty() {
        program.steps.retain(|step| !matches!(step, Step::FiniteResults(_)));
    }
    program.moderate = arguments;
    program
}

/// Whether an input is a load or a rate.
fn is_given(input: Input) -> bool {
    matches!(input, Input::Symbol(Symbol::Load(..) | Symbol::Driven(..)))
}

impl Program {
    fn inputs_that(&self, is_meant: impl Fn(Input) -> bool) -> Vec<ValueId> {
        self.inputs().filter(|(_, input)| is_meant(*input)).map(|(value, _)| value).collect()
    }

    /// The arguments with which, if they are not finite, a check fails or they are asked first.
    fn refused(&self) -> BTreeSet<ValueId> {
        let (mut refused, mut asked) = (BTreeSet::new(), Vec::new());
        for step in &self.steps {
            match step {
                Step::Check { guard, .. } => asked.extend(guard.condition.operands()),
                Step::FiniteInput(value) => drop(refused.insert(*value)),
                Step::Let(_) | Step::FiniteResults(_) => {}
            }
        }
        // No number, which a sine of what is not finite is, stays none up to the check.
        let kept = |value: ValueId| match self.op(value) {
            Some(
                op @ (Op::Neg(_) | Op::Abs(_) | Op::Sqrt(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..)),
            ) => op.operands(),
            _ => Vec::new(),
        };
        for value in reached(asked, kept) {
            if let Some(Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_), args, .. }) = self.op(value) {
                refused.extend(args);
                refused.extend(self.shown_by(args.iter().copied()));
            }
        }
        refused
    }
}

/// What arguments may be. Poses and prepared linkages hold finite numbers only, but for bounds of errors where nothing can be said: these are
/// read as the lesser of them and the largest number.
struct Given {
    drives: Bounds,
    /// Loads and rates.
    given: Bounds,
}

impl Given {
    /// Drives are checked.
    fn anything(scalar: Scalar) -> Self {
        Self { drives: Bounds::finite(scalar), given: Bounds::ANY }
    }

    /// The bounds of all values.
    fn bounds(&self, program: &Program, graph: &Graph) -> Vec<Bounds> {
        self.bounds_with(program, graph, &BTreeMap::new())
    }

    /// Whether checked results lie within bounds.
    fn bound_results(&self, program: &Program, graph: &Graph) -> bool {
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
        let above = program.steps.iter().filter_map(|step| match step {
            Step::Check { guard, .. } => Some(guard.condition.operands()),
            _ => None,
        });
        let mut most: BTreeMap<ValueId, f64> = BTreeMap::new();
        for [value, limit] in above {
            let least = least(program, graph, &before, limit);
            most.entry(value).and_modify(|known| *known = known.max(least)).or_insert(least);
        }
        self.bounds_with(program, graph, &most)
    }

    /// The same of values of which some are not less than these numbers.
    fn bounds_with(&self, program: &Program, graph: &Graph, least: &BTreeMap<ValueId, f64>) -> Vec<Bounds> {
        let mut known = vec![None; program.values.len()];
        (0..known.len()).map(|index| self.bounds_of((program, graph, least), ValueId::new(index), &mut known)).collect()
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
        let found = match &program.value(value).definition {
            Definition::Input(Input::Symbol(Symbol::Drive(_))) => self.drives,
            Definition::Input(Input::Kept(_) | Input::Prepared(_)) => Bounds::finite(scalar),
            Definition::Input(input) if is_given(*input) => self.given,
            Definition::Input(Input::Symbol(symbol @ Symbol::Side(_))) => {
                graph.bounds_of_op(&Op::<ValueId>::Symbol(*symbol), |_| Bounds::ANY)
            }
            Definition::Input(Input::Symbol(_) | Input::Known(_)) => Bounds::ANY,
            Definition::Computed(op) => {
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
                    Op::Kernel { kernel: Kernel::Search { .. }, .. } => false,
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
