//! What other passes have brought to the same operation is computed once.
//!
//! The graph holds no operation twice, but passes make new ones: products by constants that they bring together, so that a rate and its
//! change have one `1/(l sin μ)`; and what is left of a sum whose common factor was taken out, so that the work of a load along a line has
//! the velocity along it.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::multiples::MULTIPLE;
use crate::graph::{Graph, Kernel, Label, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn compute_once(mut program: Program, _graph: &Graph) -> Program {
    let mut replaced: BTreeMap<ValueId, ValueId> = BTreeMap::new();
    let mut first: FxHashMap<Op<ValueId>, ValueId> = FxHashMap::default();
    // Constants need no step.
    for (index, value) in program.values.iter().enumerate() {
        if let Definition::Computed(op @ Op::Constant(_)) = &value.definition {
            let value = ValueId::new(index);
            let there = *first.entry(op.clone()).or_insert(value);
            if there != value {
                replaced.insert(value, there);
            }
        }
    }
    let mut steps = Vec::new();
    for step in core::mem::take(&mut program.steps) {
        let step = program.reading(step, &replaced);
        if let Step::Let(value) = step
            && let Some(op) = program.op(value)
        {
            let there = *first.entry(in_one_order(op)).or_insert(value);
            if there != value && may_be_one(&program, there, value) {
                let label = program.values[value.index()].label.take();
                let known = &mut program.values[there.index()].label;
                *known = both(known.take(), label);
                replaced.insert(value, there);
                continue;
            }
        }
        steps.push(step);
    }
    program.steps = steps;
    program.rename_results(&replaced);
    program
}

/// Whether a value may stand for another one: not where both have names, which are lines of the derivation, unless they are multiples of what these
/// stand for.
fn may_be_one(program: &Program, there: ValueId, value: ValueId) -> bool {
    let [there, value] = [there, value].map(|value| program.value(value));
    let is_line = |label: &Option<Label>| label.as_ref().is_some_and(|label| !label.name.ends_with(MULTIPLE));
    let no_line_is_lost = match (&there.label, &value.label) {
        (Some(_), Some(_)) => ![there, value].into_iter().any(|value| is_line(&value.label)),
        _ => true,
    };
    no_line_is_lost && there.divided == value.divided
}

/// The name of the first, if it has one, with what both mean.
fn both(there: Option<Label>, label: Option<Label>) -> Option<Label> {
    match (there, label) {
        (Some(Label { name, equation }), Some(label)) if label.equation != equation => {
            Some(Label { name, equation: format!("{equation}; {}", label.equation) })
        }
        (there, label) => there.or(label),
    }
}

/// Sums and products of the same in either order are the same.
fn in_one_order(op: &Op<ValueId>) -> Op<ValueId> {
    match op {
        Op::Add(a, b) if b < a => Op::Add(*b, *a),
        Op::Mul(a, b) if b < a => Op::Mul(*b, *a),
        Op::Kernel { kernel: Kernel::MulAdd, args, part } => {
            let mut args = args.clone();
            args[..2].sort_unstable();
            Op::Kernel { kernel: Kernel::MulAdd, args, part: *part }
        }
        _ => op.clone(),
    }
}
