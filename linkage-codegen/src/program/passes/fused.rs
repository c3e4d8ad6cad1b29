//! With `arithmetic fused;` a product that a sum reads is added without being rounded: `a·b + c` is one operation. What has a name of its own
//! is a line of the derivation and stays a number of its own, rounded as such; only constants are added to it before it is.
//!
//! Of two products the one that is known last is added to the other, which has been rounded by then; a change of sign goes to a factor.
//!
//! Where one product alone reads a reciprocal, it is a quotient instead, which is known later, and rounded once less.

use super::cycles::Ready;
use crate::graph::{Graph, Kernel, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn contract(mut program: Program, graph: &Graph) -> Program {
    if !graph.is_fused() {
        return program;
    }
    divide(&mut program, graph);
    let mut steps = Vec::new();
    let mut ready = Ready::default();
    for step in core::mem::take(&mut program.steps) {
        let done = steps.len();
        if let Step::Let(value) = step
            && let Some([a, b, c]) = operands(&mut program, graph, value, (&ready, &mut steps))
        {
            let op = Op::Kernel { kernel: Kernel::MulAdd, args: vec![a, b, c], part: 0 };
            program.values[value.index()].definition = Definition::Computed(op);
        }
        steps.push(step);
        for step in steps.iter().skip(done) {
            if let Step::Let(value) = step {
                ready.compute(&program, *value);
            }
        }
    }
    program.steps = steps;
    super::unused::remove(program, graph)
}

/// `x · (1/y)` as `x/y`, where nothing else reads the reciprocal.
fn divide(program: &mut Program, graph: &Graph) {
    let uses = program.uses();
    for value in program.computed().collect::<Vec<_>>() {
        let Some(&Op::Mul(a, b)) = program.op(value) else { continue };
        let divisor = |reciprocal: ValueId| {
            let (one, divisor) = program.quotient(graph, reciprocal)?;
            (one.is_one() && uses[reciprocal.index()] == 1).then_some(divisor)
        };
        if let Some((x, y)) = divisor(b).map(|y| (a, y)).or_else(|| divisor(a).map(|y| (b, y))) {
            program.values[value.index()].definition = Definition::Computed(Op::Div(x, y));
        }
    }
}

/// Factors and summand of a sum with a product.
fn operands(
    program: &mut Program,
    graph: &Graph,
    sum: ValueId,
    (ready, steps): (&Ready, &mut Vec<Step>),
) -> Option<[ValueId; 3]> {
    let ([a, b], minus) = program.op(sum)?.terms()?;
    let beside_constant = program.adds_constant(graph, sum);
    let unnamed =
        |value: ValueId| program.op(value).filter(|_| beside_constant || program.value(value).label.is_none());
    let product = |value: ValueId| match unnamed(value)? {
        Op::Mul(x, y) => Some((*x, *y, false)),
        Op::Neg(product) => match unnamed(*product)? {
            Op::Mul(x, y) => Some((*x, *y, true)),
            _ => None,
        },
        _ => None,
    };
    let second = product(b).filter(|_| product(a).is_none() || ready.of(b) > ready.of(a));
    let ((x, y, is_negative), rest, subtracted) = match (product(a), second) {
        (_, Some((x, y, is_negative))) => ((x, y, is_negative != minus), a, false),
        (Some(product), None) => (product, b, minus),
        (None, None) => return None,
    };
    let x = if is_negative { negative(program, graph, x, steps) } else { x };
    Some([x, y, if subtracted { negative(program, graph, rest, steps) } else { rest }])
}

/// The negative of a value, which is exact.
fn negative(program: &mut Program, graph: &Graph, value: ValueId, steps: &mut Vec<Step>) -> ValueId {
    if let Some(Op::Neg(positive)) = program.op(value) {
        return *positive;
    }
    if let Some(number) = program.constant(graph, value) {
        return program.add_constant(graph, &number.neg(), value);
    }
    let negative = program.add(Op::Neg(value), value);
    steps.push(Step::Let(negative));
    negative
}
