//! A change of sign that an operand can take on costs nothing: `−(a − b) = b − a`, `−(k x) = (−k) x`, `−(k x / y) = (−k) x / y`,
//! `a − (−b) = a + b`, `a − (−b − c) = a + (b + c)`, `(−x) (a − b) = x (b − a)`.
//!
//! That of a sum goes to one of its terms, `−(a + b) = −a − b`: nothing then waits for it, and the formula ends as that of the other
//! component of a vector does, so that a compiler can work at both at once.

use crate::graph::{Graph, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn absorb(mut program: Program, graph: &Graph) -> Program {
    let mut uses = program.uses();
    let depths = depths(&program);
    let mut steps = Vec::with_capacity(program.steps.len());
    for step in core::mem::take(&mut program.steps) {
        if let Step::Let(value) = step
            && let Some(Op::Neg(inner)) = program.op(value).cloned()
            && program.is_inner(inner, &uses)
        {
            let op = match program.op(inner).cloned() {
                Some(Op::Add(a, b)) => {
                    Some(negative_sum(&mut program, graph, [a, b], (&mut uses, &depths), &mut steps))
                }
                // The place of the quotient is taken by what is divided.
                Some(Op::Div(a, b)) if program.is_inner(a, &uses) => {
                    negative(&mut program, graph, a, &uses).map(|negative| {
                        program.values[inner.index()].definition = Definition::Computed(negative);
                        Op::Div(inner, b)
                    })
                }
                _ => negative(&mut program, graph, inner, &uses),
            };
            if let Some(op) = op {
                program.values[value.index()].definition = Definition::Computed(op);
            }
        }
        if let Step::Let(value) = step {
            take_negative(&mut program, value, &uses);
            exchange_terms(&mut program, value, &uses);
        }
        steps.push(step);
    }
    program.steps = steps;
    super::unused::remove(without_negative_constants(program, graph), graph)
}

/// `a ± (−b)` as `a ∓ b`, `a ± (−b − c)` as `a ∓ (b + c)`.
fn take_negative(program: &mut Program, value: ValueId, uses: &[usize]) {
    let Some(([first, mut second], mut minus)) = program.op(value).and_then(Op::terms) else { return };
    if let Some(Op::Neg(b)) = program.op(second).cloned()
        && program.is_inner(second, uses)
    {
        (second, minus) = (b, !minus);
        program.values[value.index()].definition = Definition::Computed(Op::of_terms([first, second], minus));
    }
    let ([b, c], sum, a) = match [first, second].map(|term| program.negative_terms(term, uses)) {
        [_, Some(terms)] => (terms, second, first),
        [Some(terms), None] if !minus => (terms, first, second),
        _ => return,
    };
    program.values[sum.index()].definition = Definition::Computed(Op::Add(b, c));
    program.values[value.index()].definition = Definition::Computed(Op::of_terms([a, sum], !minus));
}

/// `(−x) (a − b)` as `x (b − a)`, whatever else reads the negative.
fn exchange_terms(program: &mut Program, value: ValueId, uses: &[usize]) {
    let Some(Op::Mul(a, b)) = program.op(value).cloned() else { return };
    for (negative, factor) in [(a, b), (b, a)] {
        if let (Some(Op::Neg(x)), Some(Op::Sub(first, second))) =
            (program.op(negative).cloned(), program.op(factor).cloned())
            && program.is_inner(factor, uses)
        {
            program.values[factor.index()].definition = Definition::Computed(Op::Sub(second, first));
            program.values[value.index()].definition = Definition::Computed(Op::Mul(x, factor));
            return;
        }
    }
}

impl Program {
    /// `b` and `c` of `−b − c` that nothing else reads.
    fn negative_terms(&self, sum: ValueId, uses: &[usize]) -> Option<[ValueId; 2]> {
        let Some(Op::Sub(negated, c)) = self.op(sum) else { return None };
        let Some(Op::Neg(b)) = self.op(*negated) else { return None };
        (self.is_inner(sum, uses) && self.is_inner(*negated, uses)).then_some([*b, *c])
    }
}

/// `a − (−k)` as `a + k`.
fn without_negative_constants(mut program: Program, graph: &Graph) -> Program {
    for index in 0..program.values.len() {
        if let Definition::Computed(Op::Sub(a, b)) = program.values[index].definition
            && let Some(number) = program.constant(graph, b).filter(|number| number.signum() < 0)
        {
            let opposite = program.add_constant(graph, &number.neg(), ValueId::new(index));
            program.values[index].definition = Definition::Computed(Op::Add(a, opposite));
        }
    }
    program
}

/// The longest way from the inputs to each value, in operations.
fn depths(program: &Program) -> Vec<usize> {
    let mut depths = vec![0; program.values.len()];
    for step in &program.steps {
        if let Step::Let(value) = step {
            let below = program.operands_of(step).into_iter().map(|operand| depths[operand.index()]).max();
            depths[value.index()] = 1 + below.unwrap_or(0);
        }
    }
    depths
}

/// `−(a + b)`: the sign goes to the term that takes it for nothing, or else to that which is known first.
fn negative_sum(
    program: &mut Program,
    graph: &Graph,
    [a, b]: [ValueId; 2],
    (uses, depths): (&mut Vec<usize>, &[usize]),
    steps: &mut Vec<Step>,
) -> Op<ValueId> {
    // What is new is known as soon as what it negates, at the least.
    let depth = |value: ValueId| depths.get(value.index()).copied().unwrap_or(0);
    let [first, second] = if depth(b) < depth(a) { [b, a] } else { [a, b] };
    for (term, other) in [(first, second), (second, first)] {
        if program.is_inner(term, uses)
            && let Some(op) = negative(program, graph, term, uses)
        {
            program.values[term.index()].definition = Definition::Computed(op);
            return Op::Sub(term, other);
        }
    }
    let negated = program.add(Op::Neg(first), first);
    uses.resize(program.values.len(), 1);
    steps.push(Step::Let(negated));
    Op::Sub(negated, second)
}

/// The operation that gives the negative of a value that nothing else reads.
fn negative(program: &mut Program, graph: &Graph, value: ValueId, uses: &[usize]) -> Option<Op<ValueId>> {
    match program.op(value).cloned()? {
        Op::Sub(a, b) => Some(Op::Sub(b, a)),
        Op::Neg(a) => Some(program.op(a).cloned()?),
        Op::Mul(k, x) => {
            if let Some(number) = program.constant(graph, k) {
                return Some(Op::Mul(program.add_constant(graph, &number.neg(), value), x));
            }
            // The sign passes on to a factor that nothing else reads.
            for factor in [k, x] {
                if let (true, Some(Op::Sub(a, b))) = (program.is_inner(factor, uses), program.op(factor).cloned()) {
                    program.values[factor.index()].definition = Definition::Computed(Op::Sub(b, a));
                    return Some(Op::Mul(k, x));
                }
            }
            None
        }
        _ => None,
    }
}
