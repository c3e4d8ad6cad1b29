//! With `arithmetic fused;` a product that a sum reads is added without being rounded: `a·b + c` is one operation. What has a name of its own
//! is a line of the derivation and stays a number of its own, rounded as such; only constants are added to it before it is.
//!
//! Of two products the one that is known last is added to the other, which has been rounded by then; a change of sign goes to a factor. A
//! constant multiple that has a name gives it to its other factor, if it is the one that is known last and nothing but the sum reads it: the
//! sum multiplies by the constant then, and waits for one product less.
//!
//! Where one product alone reads a reciprocal, it is a quotient instead, rounded once less, if its other factor is known before the reciprocal is.

use super::cycles::Ready;
use super::multiples::tell_factor;
use crate::graph::number::Number;
use crate::graph::{Graph, Kernel, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn contract(mut program: Program, graph: &Graph) -> Program {
    if !graph.is_fused() {
        return program;
    }
    divide(&mut program, graph);
    leave_multiples(&mut program, graph);
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

/// `x · (1/y)` as `x/y`, where nothing else reads the reciprocal, and x is known before it is.
fn divide(program: &mut Program, graph: &Graph) {
    let (uses, ready) = (program.uses(), Ready::all(program));
    for value in program.computed().collect::<Vec<_>>() {
        let Some(&Op::Mul(a, b)) = program.op(value) else { continue };
        let divisor = |reciprocal: ValueId, x: ValueId| {
            let (one, divisor) = program.quotient(graph, reciprocal)?;
            (one.is_one() && uses[reciprocal.index()] == 1 && ready.of(reciprocal) > ready.of(x)).then_some(divisor)
        };
        if let Some((x, y)) = divisor(b, a).map(|y| (a, y)).or_else(|| divisor(a, b).map(|y| (b, y))) {
            program.values[value.index()].definition = Definition::Computed(Op::Div(x, y));
        }
    }
}

/// In sums with a named multiple `k x` that is known last, x has its name.
fn leave_multiples(program: &mut Program, graph: &Graph) {
    let (uses, ready) = (program.uses(), Ready::all(program));
    for sum in program.computed().collect::<Vec<_>>() {
        let Some(([a, b], _)) = program.op(sum).and_then(Op::terms) else { continue };
        for (multiple, other) in [(a, b), (b, a)] {
            if let Some((k, x)) = program.multiple(graph, multiple)
                && let Some(factor) = Number::one().div(&k)
                && uses[multiple.index()] == 1
                && program.is_inner(x, &uses)
                && program.op(x).is_some()
                && ready.of(multiple) > ready.of(other)
                && let Some(mut label) = program.values[multiple.index()].label.take()
            {
                tell_factor(&mut label, &factor);
                program.values[x.index()].label = Some(label);
            }
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
