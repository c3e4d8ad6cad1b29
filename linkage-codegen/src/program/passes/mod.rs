//! What is improved in a program after it is taken out of the graph. Each pass keeps the results up to rounding; tests run every
//! program before and after each of them.

mod constants;
mod finite;
mod fused;
mod pivots;
mod reciprocals;
mod signs;
mod unused;

use super::Program;

/// A pass.
pub type Pass = fn(Program, &crate::graph::Graph) -> Program;

/// All passes, in their order.
pub const PASSES: [(&str, Pass); 8] = [
    ("pivots", pivots::compare_directly),
    ("reciprocals", reciprocals::share),
    ("constants", constants::merge),
    ("unused", unused::remove),
    ("signs", signs::absorb),
    ("unused", unused::remove),
    ("finite", finite::check_once),
    ("fused", fused::contract),
];

/// A program after the passes that leave every bit of its results as it is.
#[must_use]
pub fn exact(program: Program, graph: &crate::graph::Graph) -> Program {
    unused::remove(signs::absorb(program, graph), graph)
}

/// A program after all passes.
#[must_use]
pub fn optimised(program: Program, graph: &crate::graph::Graph) -> Program {
    PASSES.iter().fold(program, |program, (_, pass)| pass(program, graph))
}
