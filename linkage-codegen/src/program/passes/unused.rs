//! What nothing reads any more is not computed.

use crate::graph::{Graph, Op};
use crate::program::{Program, Step};

pub(super) fn remove(mut program: Program, _graph: &Graph) -> Program {
    let mut read = vec![false; program.values.len()];
    for (_, value) in &program.outputs {
        read[value.index()] = true;
    }
    let mut kept = Vec::new();
    for step in core::mem::take(&mut program.steps).into_iter().rev() {
        if matches!(step, Step::Let(value) if !read[value.index()]) {
            continue;
        }
        let mut operands = program.operands_of(&step);
        if let Step::Check { report, .. } = &step {
            operands.extend(report.iter().flat_map(|value| program.op(*value).map(Op::operands).unwrap_or_default()));
        }
        for operand in operands {
            read[operand.index()] = true;
        }
        kept.push(step);
    }
    kept.reverse();
    program.steps = kept;
    program
}
