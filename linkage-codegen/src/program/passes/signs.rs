//! A change of sign that an operand can take on costs nothing: `−(a − b) = b − a`, `−(k x) = (−k) x`.

use crate::graph::{Graph, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn absorb(mut program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let order: Vec<ValueId> =
        program.steps.iter().filter_map(|step| if let Step::Let(value) = step { Some(*value) } else { None }).collect();
    for value in order {
        let Some(Op::Neg(inner)) = program.op(value).cloned() else { continue };
        if uses[inner.index()] != 1 || program.value(inner).label.is_some() {
            continue;
        }
        if let Some(op) = negative(&mut program, graph, inner, &uses) {
            program.values[value.index()].definition = Definition::Computed(op);
        }
    }
    program
}

/// The operation that gives the negative of a value that nothing else reads.
fn negative(program: &mut Program, graph: &Graph, value: ValueId, uses: &[usize]) -> Option<Op<ValueId>> {
    match program.op(value).cloned()? {
        Op::Sub(a, b) => Some(Op::Sub(b, a)),
        Op::Neg(a) => Some(program.op(a).cloned()?),
        Op::Mul(k, x) => {
            if let Some(Op::Constant(number)) = program.op(k).cloned()
                && let Op::Constant(negated) = graph.constant(&graph.number(number).neg()).op()
            {
                let section = program.value(value).section.clone();
                let constant = Definition::Computed(Op::Constant(negated));
                program.values.push(crate::program::Value { definition: constant, label: None, section });
                return Some(Op::Mul(ValueId::new(program.values.len() - 1), x));
            }
            // The sign passes on to a factor that nothing else reads.
            for factor in [k, x] {
                let single = uses.get(factor.index()) == Some(&1) && program.value(factor).label.is_none();
                if let (true, Some(Op::Sub(a, b))) = (single, program.op(factor).cloned()) {
                    program.values[factor.index()].definition = Definition::Computed(Op::Sub(b, a));
                    return Some(Op::Mul(k, x));
                }
            }
            None
        }
        _ => None,
    }
}
