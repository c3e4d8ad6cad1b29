//! How long values take to be known, in cycles of a usual processor that has whatever it takes to work on all of them at once.

use crate::graph::{Kernel, Op, Symbol};
use crate::program::{Definition, Input, Program, Step, ValueId};

/// When each value is known: an input at once, what is computed after its operands.
#[derive(Default)]
pub(super) struct Ready(Vec<u32>);

impl Ready {
    pub(super) fn all(program: &Program) -> Self {
        let mut ready = Self::default();
        for step in &program.steps {
            if let Step::Let(value) = step {
                ready.compute(program, *value);
            }
        }
        ready
    }

    pub(super) fn of(&self, value: ValueId) -> u32 {
        self.0.get(value.index()).copied().unwrap_or(0)
    }

    /// Computes a value, its operands being computed.
    pub(super) fn compute(&mut self, program: &Program, value: ValueId) {
        let Some(op) = program.op(value) else { return };
        let begin = op.operands().into_iter().map(|operand| self.of(operand)).max().unwrap_or(0);
        self.0.resize(program.values.len(), 0);
        self.0[value.index()] = begin + cycles(program, op);
    }
}

/// How long a product takes.
pub(super) const PRODUCT: u32 = 4;

/// How long an operation takes, in cycles of a usual processor. Only the order of sums of them matters. A change of sign takes none, and so
/// does a side that is given at run time, so that its code is that of the same side in the declaration.
pub(super) fn cycles(program: &Program, op: &Op<ValueId>) -> u32 {
    match op {
        Op::Neg(_) | Op::Abs(_) => 0,
        Op::Mul(side, _) if is_side(program, *side) => 0,
        Op::Div(..) => 14,
        Op::Sqrt(_) => 18,
        Op::Kernel { kernel: Kernel::MulAdd, .. } => PRODUCT,
        Op::Kernel { .. } => 60,
        _ => PRODUCT,
    }
}

pub(super) fn is_side(program: &Program, value: ValueId) -> bool {
    matches!(program.value(value).definition, Definition::Input(Input::Symbol(Symbol::Side(_))))
}
