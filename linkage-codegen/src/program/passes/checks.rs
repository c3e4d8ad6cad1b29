//! Where one check shows what another asks of the same value, the weaker one is asked only where the stronger fails, to tell why.
//!
//! A loop is closed where `p ≥ −τ`, and what divides by √p has `p > τ`. In one function the latter says it all, and that p is positive.

use std::collections::BTreeMap;

use crate::graph::{Condition, Failure, Graph, Op};
use crate::program::{Program, Step, ValueId};

pub(super) fn ask_once(mut program: Program, graph: &Graph) -> Program {
    let mut replaced: BTreeMap<ValueId, ValueId> = BTreeMap::new();
    let mut steps = core::mem::take(&mut program.steps);
    let mut index = 0;
    while index < steps.len() {
        steps[index] = program.reading(steps[index].clone(), &replaced);
        if let Some(distance) = stronger(&program, graph, &steps[index..])
            && let Step::Check { guard: stronger, .. } = steps.remove(index + distance)
            && let Step::Check { guard, weaker, .. } = &mut steps[index]
        {
            let [value, limit] = stronger.condition.operands();
            *weaker = Some(core::mem::replace(guard, stronger));
            if program.constant(graph, limit).is_some_and(|limit| limit.signum() >= 0) {
                let behind = steps[index..].iter().filter_map(|step| match step {
                    Step::Let(same) if program.op(*same) == Some(&Op::NonNegative(value)) => Some((*same, value)),
                    _ => None,
                });
                replaced.extend(behind);
            }
        }
        index += 1;
    }
    program.steps = steps;
    program
}

/// How many steps behind the first, a check, there is one of the same value that says more. None is asked before a check that tells
/// something else: a vanishing pivot where two joints meet is not the cause.
fn stronger(program: &Program, graph: &Graph, steps: &[Step]) -> Option<usize> {
    let Step::Check { guard, weaker: None, .. } = steps.first()? else { return None };
    let Condition::AtLeast { value, limit: least } = guard.condition else { return None };
    let least = program.constant(graph, least)?;
    let says_more = |step: &Step| match step {
        Step::Check { guard, weaker: None, report } if report.is_empty() => match guard.condition {
            Condition::Above { value: same, limit } => {
                same == value && program.constant(graph, limit).is_some_and(|limit| limit.compare(&least).is_ge())
            }
            Condition::AtLeast { .. } => false,
        },
        _ => false,
    };
    let may_wait = |step: &Step| match step {
        Step::Let(_) => true,
        Step::Check { guard, .. } => {
            matches!(guard.failure, Failure::CannotAssemble { .. } | Failure::DeadCentre { .. })
        }
        Step::FiniteInput(_) | Step::FiniteResults(_) => false,
    };
    let behind = steps.iter().enumerate().skip(1);
    behind.take_while(|(_, step)| may_wait(step)).find(|(_, step)| says_more(step)).map(|(index, _)| index)
}
