//! How long values take to be known, in cycles of a usual processor that has whatever it takes to work on all of them at once.

use crate::graph::{Kernel, Op, Symbol};
use crate::program::{Definition, Input, Program, ValueId};

/// When a value is known, by when its operands are.
pub(super) fn known(program: &Program, value: ValueId, ready: &[u32]) -> u32 {
    let Some(op) = program.op(value) else { return 0 };
    cycles(program, op) + op.operands().into_iter().map(|operand| ready[operand.index()]).max().unwrap_or(0)
}

/// How long an operation takes, in cycles of a usual processor. Only the order of sums of them matters. A change of sign takes none, and so
/// does a side that is given at run time, so that its code is that of the same side in the declaration.
pub(super) fn cycles(program: &Program, op: &Op<ValueId>) -> u32 {
    match op {
        Op::Neg(_) | Op::Abs(_) => 0,
        Op::Mul(side, _) if is_side(program, *side) => 0,
        Op::Div(..) => 14,
        Op::Sqrt(_) => 18,
        Op::Kernel { kernel: Kernel::MulAdd, .. } => 4,
        Op::Kernel { .. } => 60,
        _ => 4,
    }
}

fn is_side(program: &Program, value: ValueId) -> bool {
    matches!(program.value(value).definition, Definition::Input(Input::Symbol(Symbol::Side(_))))
}
