//! A result is not checked to be finite where that is known already: because it lies within bounds whatever is given, or because
//! another one that is checked would not be finite either.
//!
//! What is infinite or no number stays so in sums, differences, products, roots, as dividend, and as argument of a sine or an angle; only
//! as divisor or in a comparison can it be lost. So one check stands for all from which the value is formed in these ways, arguments among
//! them: which of these it was is asked only where something has failed.
//!
//! Results of arguments that are not enormous, behind the checks of pivots, mostly lie within bounds: then arguments are looked at, which
//! waits for nothing, and results only where one is.

use std::collections::BTreeSet;

use super::reached;
use crate::graph::bounds::Bounds;
use crate::graph::{Graph, Guard, Kernel, Op, Scalar, Symbol};
use crate::program::bounds::Given;
use crate::program::{Input, Program, Step, ValueId};

pub(super) fn check_once(mut program: Program, graph: &Graph) -> Program {
    let scalar = graph.scalar();
    let given = Given::anything(scalar);
    let bounds = given.bounds(&program, graph);
    let mut steps = core::mem::take(&mut program.steps);
    for step in &mut steps {
        let Step::FiniteResults(checked) = step else { continue };
        let bare = |value: ValueId| bare(&program, &bounds, scalar, value);
        let mut all = BTreeSet::new();
        let is_finite = |value: ValueId| {
            let [found, _] = given.of_result(&program, graph, (&bounds, value));
            found.are_finite(scalar)
        };
        checked.retain(|value| !is_finite(bare(*value)) && all.insert(bare(*value)));
        let shown = program.shown_by(all);
        checked.retain(|value| !shown.contains(&bare(*value)));
        pairs_first(&program, checked);
    }
    steps.retain(|step| !matches!(step, Step::FiniteResults(checked) if checked.is_empty()));
    program.steps = steps;
    program
}

/// An argument need not be asked where a checked result is not finite without it: the check of this result is made anyway.
///
/// An angle is asked first all the same, if it is not for the check of a pivot that it goes through: its sine asks whether it is short, so this
/// costs nothing, and results need not be looked at for it.
pub(super) fn ask_late(mut program: Program, _graph: &Graph) -> Program {
    let checked = program.steps.iter().filter_map(|step| match step {
        Step::FiniteResults(checked) => Some(checked),
        _ => None,
    });
    let shown = program.shown_by(checked.flatten().copied());
    let (angles, refused) = (program.angles(), program.refused_by_checks());
    let (mut steps, mut late) = (core::mem::take(&mut program.steps), core::mem::take(&mut program.asked_late));
    steps.retain(|step| match step {
        Step::FiniteInput(value) if shown.contains(value) && (refused.contains(value) || !angles.contains(value)) => {
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
    let mut drives = program.inputs_that(|input| matches!(input, Input::Symbol(Symbol::Drive(_))));
    // Those of a pose are no arguments.
    drives.retain(|drive| program.value(*drive).within.is_none());
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

/// Loads, and the rates of drives.
fn is_given(input: Input) -> bool {
    matches!(input, Input::Symbol(Symbol::Load(..) | Symbol::Driven(..)))
}

impl Program {
    /// The loads and rates on which a check depends: where it fails, they may be at fault.
    pub(crate) fn given_to(&self, guard: &Guard<ValueId>) -> Vec<ValueId> {
        let read = reached(guard.condition.operands(), |value| self.op(value).map(Op::operands).unwrap_or_default());
        let mut given = self.inputs_that(is_given);
        given.retain(|value| read.contains(value));
        given
    }

    fn inputs_that(&self, is_meant: impl Fn(Input) -> bool) -> Vec<ValueId> {
        self.inputs().filter(|(_, input)| is_meant(*input)).map(|(value, _)| value).collect()
    }

    /// The values whose sine and cosine are taken as they are.
    pub(crate) fn angles(&self) -> BTreeSet<ValueId> {
        let angle = |step: &Step| match step {
            Step::Let(value) => match self.op(*value) {
                Some(Op::Kernel { kernel: Kernel::SinCos, args, .. }) => args.first().copied(),
                _ => None,
            },
            _ => None,
        };
        self.steps.iter().filter_map(angle).collect()
    }

    /// The arguments with which, if they are not finite, a check of a pivot fails or they are asked first.
    fn refused(&self) -> BTreeSet<ValueId> {
        let mut refused = self.refused_by_checks();
        refused.extend(self.steps.iter().filter_map(|step| match step {
            Step::FiniteInput(value) => Some(*value),
            _ => None,
        }));
        refused
    }

    /// The arguments with which, if they are not finite, a check of a pivot fails.
    fn refused_by_checks(&self) -> BTreeSet<ValueId> {
        let guards = self.steps.iter().filter_map(|step| match step {
            Step::Check { guard, .. } => Some(guard.condition.operands()),
            _ => None,
        });
        // No number, which a sine of what is not finite is, stays none up to the check.
        let kept = |value: ValueId| match self.op(value) {
            Some(
                op @ (Op::Neg(_) | Op::Abs(_) | Op::Sqrt(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..)),
            ) => op.operands(),
            _ => Vec::new(),
        };
        let mut refused = BTreeSet::new();
        for value in reached(guards.flatten(), kept) {
            if let Some(Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_), args, .. }) = self.op(value) {
                refused.extend(args);
                refused.extend(self.shown_by(args.iter().copied()));
            }
        }
        refused
    }
}
