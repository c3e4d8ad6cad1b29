//! A result is not checked to be finite where that is known already: because it lies within bounds whatever is given, or because
//! another one that is checked would not be finite either.
//!
//! What is infinite or no number stays so in sums, differences, products, roots, as dividend, and as argument of a sine or an angle; only
//! as divisor or in a comparison can it be lost. So one check stands for all from which the value is formed in these ways, arguments among
//! them: which of these it was is asked only where something has failed.

use std::collections::BTreeSet;

use crate::graph::bounds::Bounds;
use crate::graph::{Graph, Kernel, Op, Scalar, Symbol};
use crate::program::{Definition, Input, Program, Step, ValueId};

pub(super) fn check_once(mut program: Program, graph: &Graph) -> Program {
    let scalar = graph.scalar();
    let bounds = bounds(&program, graph);
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
        let mut shown = BTreeSet::new();
        let mut open: Vec<ValueId> = finite.into_iter().flat_map(inherited).collect();
        while let Some(value) = open.pop() {
            if shown.insert(value) {
                open.extend(inherited(value));
            }
        }
        shown
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

/// The bounds of all values. Drives are checked, poses and prepared linkages hold finite numbers only; loads may be anything.
fn bounds(program: &Program, graph: &Graph) -> Vec<Bounds> {
    let mut known = vec![None; program.values.len()];
    (0..known.len()).map(|index| bounds_of(program, graph, ValueId::new(index), &mut known)).collect()
}

fn bounds_of(program: &Program, graph: &Graph, value: ValueId, known: &mut Vec<Option<Bounds>>) -> Bounds {
    if let Some(bounds) = known[value.index()] {
        return bounds;
    }
    let scalar = graph.scalar();
    let found = match &program.value(value).definition {
        Definition::Input(Input::Symbol(Symbol::Drive(_)) | Input::Kept(_) | Input::Prepared(_)) => {
            Bounds::finite(scalar)
        }
        Definition::Input(Input::Symbol(symbol @ Symbol::Side(_))) => {
            graph.bounds_of_op(&Op::<ValueId>::Symbol(*symbol), |_| Bounds::ANY)
        }
        Definition::Input(Input::Symbol(_) | Input::Known(_)) => Bounds::ANY,
        Definition::Computed(op) => {
            for operand in op.operands() {
                bounds_of(program, graph, operand, known);
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
    known[value.index()] = Some(found);
    found
}
