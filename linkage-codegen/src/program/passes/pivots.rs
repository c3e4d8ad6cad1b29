//! Where a pivot is computed and divided by in one function, its check compares what makes it significant directly.
//!
//! A pose keeps a pivot as zero where it is no larger than its rounding, and a function that starts from the pose checks that it is
//! not zero: `w = k where p > τ, else 0; check |w| > 0`. In one function this is `check p > τ`, with k in place of w from there on.

use std::collections::BTreeMap;

use crate::graph::{Condition, Graph, Guard, Op};
use crate::program::{Program, Step, ValueId};

pub(super) fn compare_directly(mut program: Program, graph: &Graph) -> Program {
    let mut replaced: BTreeMap<ValueId, ValueId> = BTreeMap::new();
    let mut steps = Vec::new();
    for step in core::mem::take(&mut program.steps) {
        let step = program.reading(step, &replaced);
        let Step::Check { guard, weaker: None, report } = step else {
            steps.push(step);
            continue;
        };
        let Some(mut pivot) = not_zero(&program, graph, &guard) else {
            steps.push(Step::Check { guard, weaker: None, report });
            continue;
        };
        let first = pivot;
        while let Some(Op::Where { value, limit, then }) = program.op(pivot).cloned() {
            let condition = Condition::Above { value, limit };
            let guard = Guard { condition, failure: guard.failure.clone() };
            steps.push(Step::Check { guard, weaker: None, report: Vec::new() });
            pivot = then;
        }
        if pivot == first {
            steps.push(Step::Check { guard, weaker: None, report });
        } else {
            replaced.insert(first, pivot);
        }
    }
    program.steps = steps;
    program
}

/// The pivot that a check wants not to be zero.
fn not_zero(program: &Program, graph: &Graph, guard: &Guard<ValueId>) -> Option<ValueId> {
    let Condition::Above { value, limit } = guard.condition else { return None };
    let Some(Op::Constant(number)) = program.op(limit) else { return None };
    if !graph.number(*number).is_zero() {
        return None;
    }
    match program.op(value)? {
        Op::Abs(pivot) => Some(*pivot),
        Op::Where { .. } => Some(value),
        // The magnitude of a pivot that is negative by its side.
        Op::Neg(pivot) => matches!(program.op(*pivot), Some(Op::Where { .. })).then_some(*pivot),
        _ => None,
    }
}
