//! [`Plan`](crate::plan::Plan) in, [`Program`]s out: straight-line code, one program for every function of the module.
//!
//! A program holds what its results need and nothing else, in an order of evaluation, each value computed once. Checks stand where
//! what they protect is first used.

mod bounds;
mod counts;
mod extract;
mod functions;
mod interpret;
pub mod passes;
mod range;
mod start;

pub use bounds::Within;
pub use counts::Counts;
pub use extract::{Extract, Form};
pub use functions::{Functions, SceneFunctions, SearchFunctions};
pub use interpret::{Fault, Run};
pub use range::check_range;
pub use start::check_start;

use core::iter;

use crate::graph::{Component, Guard, Label, NodeId, Op, Symbol};

/// A value of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ValueId(u32);

impl ValueId {
    /// Its place in the list of definitions.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }

    fn new(index: usize) -> Self {
        Self(u32::try_from(index).unwrap_or(u32::MAX))
    }
}

/// Where an input comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// A drive, a load or a parameter.
    Symbol(Symbol),
    /// Kept by the pose.
    Kept(NodeId),
    /// Prepared from the parameters.
    Prepared(NodeId),
    /// Given to a search.
    Known(NodeId),
}

/// How a value comes about.
#[derive(Clone, Debug, PartialEq)]
pub enum Definition {
    /// It is given.
    Input(Input),
    /// It is computed.
    Computed(Op<ValueId>),
}

/// A value.
#[derive(Clone, Debug)]
pub struct Value {
    /// How it comes about.
    pub definition: Definition,
    /// Its name and equation.
    pub label: Option<Label>,
    /// The heading under which it stands.
    pub section: String,
    /// Whether it is a quotient that is divided, whatever others have the same divisor.
    pub divided: bool,
    /// What is known of it if it is a component of a link's direction.
    pub component: Option<Component<ValueId>>,
    /// What is known of it if it comes from a pose, as the pose's drives do.
    pub within: Option<Within>,
}

/// A step of a program.
#[derive(Clone, Debug)]
pub enum Step {
    /// Computes a value.
    Let(ValueId),
    /// Checks a condition.
    Check {
        /// What must hold, and what is reported otherwise.
        guard: Guard<ValueId>,
        /// What holds wherever this does: asked only where this does not, to tell why.
        weaker: Option<Guard<ValueId>>,
        /// What is computed only to be reported.
        report: Vec<ValueId>,
    },
    /// An argument must be a finite number.
    FiniteInput(ValueId),
    /// These results must be finite.
    FiniteResults(Vec<ValueId>),
}

/// Straight-line code.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// All values, in an order of evaluation.
    pub values: Vec<Value>,
    /// What is done, in order. Inputs and constants need no step.
    pub steps: Vec<Step>,
    /// Arguments that must be finite numbers, but are asked only where something fails, before what has failed is told: with others a check
    /// fails anyway.
    pub asked_late: Vec<ValueId>,
    /// Arguments with which, if they are moderate, all results are finite; none if nothing is known of that.
    pub moderate: Vec<ValueId>,
    /// The results, each with its path.
    pub outputs: Vec<(String, ValueId)>,
    /// Whether the rounding of its values is counted: then passes may only do what the count knows of.
    pub counts_rounding: bool,
}

impl Program {
    /// A value.
    #[must_use]
    pub fn value(&self, id: ValueId) -> &Value {
        &self.values[id.index()]
    }

    /// What a computed value computes.
    #[must_use]
    pub fn op(&self, id: ValueId) -> Option<&Op<ValueId>> {
        match &self.value(id).definition {
            Definition::Computed(op) => Some(op),
            Definition::Input(_) => None,
        }
    }

    /// All inputs that are read.
    pub fn inputs(&self) -> impl Iterator<Item = (ValueId, Input)> {
        self.values.iter().enumerate().filter_map(|(index, value)| match value.definition {
            Definition::Input(input) => Some((ValueId::new(index), input)),
            Definition::Computed(_) => None,
        })
    }

    /// The values that are computed, in order.
    pub fn computed(&self) -> impl Iterator<Item = ValueId> {
        self.steps.iter().filter_map(|step| if let Step::Let(value) = step { Some(*value) } else { None })
    }

    /// Whether parameters are all that it reads.
    #[must_use]
    pub fn prepares(&self) -> bool {
        let mut inputs = self.inputs().map(|(_, input)| input).peekable();
        inputs.peek().is_some() && inputs.all(|input| matches!(input, Input::Symbol(Symbol::Parameter(_))))
    }

    /// Whether any load is read.
    #[must_use]
    pub fn reads_loads(&self) -> bool {
        self.inputs().any(|(_, input)| matches!(input, Input::Symbol(Symbol::Load(..))))
    }

    /// Whether any rate or acceleration of a drive is read.
    #[must_use]
    pub fn reads_motion(&self) -> bool {
        self.inputs().any(|(_, input)| matches!(input, Input::Symbol(Symbol::Driven(..))))
    }

    /// How often each value is read: by other values, by checks, and as a result.
    #[must_use]
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.values.len()];
        for step in &self.steps {
            for operand in self.operands_of(step) {
                uses[operand.index()] += 1;
            }
            if let Step::Check { report, .. } = step {
                for value in report {
                    for operand in self.op(*value).map(Op::operands).unwrap_or_default() {
                        uses[operand.index()] += 1;
                    }
                }
            }
        }
        for (_, value) in &self.outputs {
            uses[value.index()] += 1;
        }
        uses
    }

    /// By which values each value is read, once for each time.
    #[must_use]
    pub fn readers(&self) -> Vec<Vec<ValueId>> {
        let mut readers = vec![Vec::new(); self.values.len()];
        for value in self.computed() {
            for operand in self.op(value).map(Op::operands).unwrap_or_default() {
                readers[operand.index()].push(value);
            }
        }
        readers
    }

    /// What a step reads.
    #[must_use]
    pub fn operands_of(&self, step: &Step) -> Vec<ValueId> {
        match step {
            Step::Let(value) => self.op(*value).map(Op::operands).unwrap_or_default(),
            Step::Check { guard, weaker, .. } => {
                let read = |guard: &Guard<ValueId>| {
                    guard.condition.operands().into_iter().chain(guard.failure.operand()).collect::<Vec<_>>()
                };
                iter::once(guard).chain(weaker).flat_map(read).collect()
            }
            Step::FiniteInput(value) => vec![*value],
            // Results are counted as such.
            Step::FiniteResults(_) => Vec::new(),
        }
    }
}
