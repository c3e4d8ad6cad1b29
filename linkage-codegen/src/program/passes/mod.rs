//! What is improved in a program after it is taken out of the graph. Each pass keeps the results up to rounding; tests run every
//! program before and after each of them.

mod arms;
mod checks;
mod common;
mod constants;
mod cycles;
mod finite;
mod fused;
mod headings;
mod late;
mod lengths;
mod like_terms;
mod multiples;
mod pivots;
mod reciprocals;
mod repeated;
mod signs;
mod sizes;
mod squares;
mod unused;

use std::collections::{BTreeMap, BTreeSet};

use super::{Definition, Program, Step, Value, ValueId};
use crate::graph::number::Number;
use crate::graph::{Graph, Guard, Op};

/// A pass.
pub type Pass = fn(Program, &Graph) -> Program;

/// All passes, in their order.
pub const PASSES: [(&str, Pass); 25] = [
    ("lengths", lengths::leave),
    ("pivots", pivots::compare_directly),
    ("checks", checks::ask_once),
    ("reciprocals", reciprocals::share),
    ("constants", constants::merge),
    ("like terms", like_terms::add),
    ("arms", arms::scale),
    ("unused", unused::remove),
    ("signs", signs::absorb),
    ("constants at reciprocals", constants::multiply_reciprocals),
    ("late", late::multiply_last),
    ("common factors", common::factor),
    ("folded", constants::fold),
    ("constants of sums", constants::multiply_into_sums),
    ("multiples", multiples::find),
    ("squares", squares::subtract),
    ("repeated", repeated::compute_once),
    ("like terms", like_terms::add),
    ("signs", signs::absorb),
    ("finite", finite::check_once),
    ("arguments", finite::ask_late),
    ("moderate", finite::look_at_arguments),
    ("fused", fused::contract),
    ("repeated", repeated::compute_once),
    ("headings", headings::settle),
];

impl Program {
    /// A new value without a name, under the heading of another one.
    fn add(&mut self, op: Op<ValueId>, beside: ValueId) -> ValueId {
        let section = self.value(beside).section.clone();
        let definition = Definition::Computed(op);
        self.values.push(Value { definition, label: None, section, divided: false, component: None, within: None });
        ValueId::new(self.values.len() - 1)
    }

    /// A new constant.
    fn add_constant(&mut self, graph: &Graph, number: &Number, beside: ValueId) -> ValueId {
        self.add(Op::Constant(graph.intern_number(number)), beside)
    }

    /// Whether a value is a sum with a constant, to which a product is added, fused, whatever its name.
    fn adds_constant(&self, graph: &Graph, value: ValueId) -> bool {
        let terms = self.op(value).and_then(Op::terms);
        terms.is_some_and(|(terms, _)| terms.iter().any(|term| self.constant(graph, *term).is_some()))
    }

    /// A step that reads other values in place of some. Which results it checks stays as it is.
    fn reading(&mut self, step: Step, replaced: &BTreeMap<ValueId, ValueId>) -> Step {
        let name = |value: ValueId| replaced.get(&value).copied().unwrap_or(value);
        let computed: &[ValueId] = match &step {
            Step::Let(value) => std::slice::from_ref(value),
            Step::Check { report, .. } => report,
            Step::FiniteInput(_) | Step::FiniteResults(_) => &[],
        };
        for value in computed {
            if let Definition::Computed(op) = &self.values[value.index()].definition {
                self.values[value.index()].definition = Definition::Computed(op.map(name));
            }
        }
        match step {
            Step::Check { guard, weaker, report } => {
                let renamed = |guard: Guard<ValueId>| Guard {
                    condition: guard.condition.map(name),
                    failure: guard.failure.map(name),
                };
                Step::Check { guard: renamed(guard), weaker: weaker.map(renamed), report }
            }
            step => step,
        }
    }

    /// Results that are other values in place of some.
    fn rename_results(&mut self, replaced: &BTreeMap<ValueId, ValueId>) {
        let name = |value: &mut ValueId| *value = replaced.get(value).copied().unwrap_or(*value);
        self.outputs.iter_mut().for_each(|(_, value)| name(value));
        for step in &mut self.steps {
            if let Step::FiniteResults(values) = step {
                values.iter_mut().for_each(name);
            }
        }
    }

    /// What a constant is.
    #[must_use]
    pub fn constant(&self, graph: &Graph, value: ValueId) -> Option<Number> {
        match self.op(value) {
            Some(Op::Constant(number)) => Some(graph.number(*number)),
            _ => None,
        }
    }

    /// A product with a constant: the constant and the rest.
    #[must_use]
    pub fn multiple(&self, graph: &Graph, value: ValueId) -> Option<(Number, ValueId)> {
        match self.op(value)? {
            Op::Mul(k, x) => Some((self.constant(graph, *k)?, *x)),
            _ => None,
        }
    }

    /// A quotient of a constant: the constant and the divisor.
    #[must_use]
    pub fn quotient(&self, graph: &Graph, value: ValueId) -> Option<(Number, ValueId)> {
        match self.op(value)? {
            Op::Div(k, divisor) => Some((self.constant(graph, *k)?, *divisor)),
            _ => None,
        }
    }

    /// Whether only one other value reads it, and it has no name of its own.
    #[must_use]
    pub fn is_inner(&self, value: ValueId, uses: &[usize]) -> bool {
        uses.get(value.index()) == Some(&1) && self.value(value).label.is_none()
    }
}

/// These values, and what one comes to from them step by step.
fn reached(from: impl IntoIterator<Item = ValueId>, next: impl Fn(ValueId) -> Vec<ValueId>) -> BTreeSet<ValueId> {
    let (mut open, mut reached) = (from.into_iter().collect::<Vec<_>>(), BTreeSet::new());
    while let Some(value) = open.pop() {
        if reached.insert(value) {
            open.extend(next(value));
        }
    }
    reached
}

/// A program after the passes that leave every bit of its results as it is.
#[must_use]
pub fn exact(program: Program, graph: &Graph) -> Program {
    signs::absorb(program, graph)
}

/// A program after all passes.
#[must_use]
pub fn optimised(program: Program, graph: &Graph) -> Program {
    PASSES.iter().fold(program, |program, (_, pass)| pass(program, graph))
}
