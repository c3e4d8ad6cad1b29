//! The product `(c − s)(c + s)` of an angle's cosine and sine is the difference of their squares, where both squares are there already: one
//! operation in place of three.
//!
//! It is the cosine of twice the angle. As c and s are rounded already, either form has it to within about an ε of one, and none has all its
//! digits where it is small. Of other numbers `(x − y)(x + y)` stays: nearly equal squares lose the digits of their difference.
//!
//! With one square alone it would be a sum less as well, and is not done: a compiler pairs the new square with products of the loads, and the
//! torque alone takes longer. Nor is it where rounding errors are counted, which would have to know of it.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::{Graph, Kernel, Label, Op};
use crate::program::{Definition, Program, Step, Value, ValueId};

pub(super) fn subtract(mut program: Program, graph: &Graph) -> Program {
    if program.counts_rounding {
        return program;
    }
    let (uses, squares) = (program.uses(), squares(&program));
    let (mut steps, mut there) = (Vec::new(), BTreeSet::new());
    for step in core::mem::take(&mut program.steps) {
        let Step::Let(value) = step else {
            steps.push(step);
            continue;
        };
        if let Some(parts) = cosine_and_sine(&program, value, &uses)
            && let [Some(c2), Some(s2)] = parts.map(|part| squares.get(&part).copied())
        {
            for (part, square) in parts.into_iter().zip([c2, s2]) {
                if there.insert(square) {
                    program.stand_beside(value, square, part);
                    steps.push(Step::Let(square));
                }
            }
            program.values[value.index()].definition = Definition::Computed(Op::Sub(c2, s2));
        }
        if there.insert(value) {
            steps.push(step);
        }
    }
    program.steps = steps;
    super::unused::remove(program, graph)
}

/// The squares that are computed, by what they are squares of.
fn squares(program: &Program) -> BTreeMap<ValueId, ValueId> {
    let square = |value: ValueId| match program.op(value) {
        Some(Op::Mul(x, same)) if x == same => Some((*x, value)),
        _ => None,
    };
    program.computed().filter_map(square).collect()
}

/// `c` and `s` of a product `(c − s)(c + s)`, if they are the cosine and the sine of an angle and nothing else reads the factors.
fn cosine_and_sine(program: &Program, product: ValueId, uses: &[usize]) -> Option<[ValueId; 2]> {
    let Some(Op::Mul(a, b)) = program.op(product) else { return None };
    let (Some(Op::Sub(c, s)), Some(Op::Add(first, second))) = (program.op(*a), program.op(*b)) else { return None };
    // Of an angle that is counted against the drive the sine is the negative of the drive's.
    let bare = |value: ValueId| if let Some(Op::Neg(positive)) = program.op(value) { *positive } else { value };
    let part_of_angle = |value: &ValueId| match program.op(bare(*value)) {
        Some(Op::Kernel { kernel: kernel @ (Kernel::SinCos | Kernel::SinCosSum(_)), args, part }) => {
            Some((*part, (*kernel, args)))
        }
        _ => None,
    };
    let ((1, angle), (0, same)) = (part_of_angle(c)?, part_of_angle(s)?) else { return None };
    let is_sum = [first, second] == [c, s] || [second, first] == [c, s];
    let spares = [a, b].into_iter().all(|factor| program.is_inner(*factor, uses));
    (angle == same && is_sum && spares).then_some([*c, *s])
}

impl Program {
    /// A square is computed in front of a value: under its heading, and with a name and a meaning, as several read it.
    fn stand_beside(&mut self, value: ValueId, square: ValueId, of: ValueId) {
        let section = self.value(value).section.clone();
        let name = self.value(of).label.as_ref().map(|label| label.name.clone());
        let Value { label, section: heading, .. } = &mut self.values[square.index()];
        *heading = section;
        if label.is_none() {
            *label = name.map(|name| Label { equation: format!("{name}²"), name: format!("{name}2") });
        }
    }
}
