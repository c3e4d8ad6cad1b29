//! The interpreter: a program carried out with any number type.

use rustc_hash::FxHashMap;

use super::{Definition, Input, Program, Step, ValueId};
use crate::graph::number::Number;
use crate::graph::real::Real;
use crate::graph::{Failure, Graph, Guard, Kernel, Op};

/// Why a program stopped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A check failed.
    Failed(Failure<()>),
    /// An argument or a result is not finite.
    NotFinite,
}

/// What is computed so far: values, and all results of the calls of kernels.
struct Values<T> {
    known: Vec<Option<T>>,
    calls: FxHashMap<(Kernel, Vec<ValueId>), Vec<T>>,
}

/// Carries programs out.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// The program.
    pub program: &'a Program,
    /// The graph that holds its constants.
    pub graph: &'a Graph,
}

impl Run<'_> {
    /// The results, in the order of the program's outputs.
    ///
    /// # Errors
    ///
    /// As the emitted function: where a check fails or a number is not finite.
    pub fn with<T: Real>(self, inputs: &dyn Fn(Input) -> T) -> Result<Vec<T>, Fault> {
        let mut values = Values { known: vec![None; self.program.values.len()], calls: FxHashMap::default() };
        for step in &self.program.steps {
            match step {
                Step::Let(value) => drop(self.value(*value, inputs, &mut values)),
                Step::Check { guard, weaker, .. } => {
                    let mut fails = |guard: &Guard<ValueId>| {
                        let [value, limit] =
                            guard.condition.operands().map(|side| self.value(side, inputs, &mut values));
                        !guard.condition.holds(&value, &limit)
                    };
                    if fails(guard) {
                        let mut asked = self.program.asked_late.clone();
                        asked.extend(self.program.given_to(guard));
                        let guard = weaker.as_ref().filter(|weaker| fails(weaker)).unwrap_or(guard);
                        let told = asked.into_iter().all(|value| self.value(value, inputs, &mut values).is_finite());
                        return Err(if told { Fault::Failed(guard.failure.map(|_| ())) } else { Fault::NotFinite });
                    }
                }
                Step::FiniteInput(value) => {
                    if !self.value(*value, inputs, &mut values).is_finite() {
                        return Err(Fault::NotFinite);
                    }
                }
                Step::FiniteResults(checked) => {
                    let arguments = &self.program.moderate;
                    let are_moderate = !arguments.is_empty()
                        && arguments.iter().all(|value| self.is_moderate(&self.value(*value, inputs, &mut values)));
                    if !are_moderate && !checked.iter().all(|value| self.value(*value, inputs, &mut values).is_finite())
                    {
                        return Err(Fault::NotFinite);
                    }
                }
            }
        }
        Ok(self.program.outputs.iter().map(|(_, value)| self.value(*value, inputs, &mut values)).collect())
    }

    fn is_moderate<T: Real>(self, value: &T) -> bool {
        Number::from_f64(self.graph.scalar().moderate()).is_some_and(|limit| T::from_number(&limit).above(&value.abs()))
    }

    fn value<T: Real>(self, id: ValueId, inputs: &dyn Fn(Input) -> T, values: &mut Values<T>) -> T {
        if let Some(value) = &values.known[id.index()] {
            return value.clone();
        }
        let value = match &self.program.value(id).definition {
            Definition::Input(input) => inputs(*input),
            Definition::Computed(op) => {
                let mut of = |operand: ValueId| self.value(operand, inputs, values);
                match op {
                    Op::Constant(number) => T::from_number(&self.graph.number(*number)),
                    Op::Kernel { kernel, args: of_call, part } => {
                        let args: Vec<T> = of_call.iter().map(|arg| of(*arg)).collect();
                        let call = (*kernel, of_call.clone());
                        let results = values.calls.entry(call).or_insert_with(|| self.graph.apply(*kernel, &args));
                        results[usize::from(*part)].clone()
                    }
                    op => op.arithmetic(&mut of),
                }
            }
        };
        values.known[id.index()] = Some(value.clone());
        value
    }
}
