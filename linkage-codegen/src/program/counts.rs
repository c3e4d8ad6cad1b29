//! Operation counts.

use core::fmt;

use super::{Program, Step};
use crate::graph::{Kernel, Op};

/// How many operations a program carries out when no check fails.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Sums and differences.
    pub add: usize,
    /// Products.
    pub mul: usize,
    /// Products that are added without being rounded.
    pub fused: usize,
    /// Quotients.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Sine and cosine pairs.
    pub sin_cos: usize,
    /// Arc tangents.
    pub atan2: usize,
    /// Vectors brought to unit size.
    pub unit: usize,
    /// Sets of linear equations.
    pub solve: usize,
    /// Searches for the places of groups.
    pub search: usize,
    /// Changes of sign and magnitudes.
    pub sign: usize,
    /// Comparisons: checks, clamps and selections.
    pub compare: usize,
}

impl Program {
    /// Its operation counts.
    #[must_use]
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        let mut pairs: Vec<(Kernel, Vec<super::ValueId>)> = Vec::new();
        let angles = self.angles();
        for step in &self.steps {
            match step {
                Step::Let(value) => match self.op(*value) {
                    Some(Op::Neg(_) | Op::Abs(_)) => counts.sign += 1,
                    Some(Op::NonNegative(_) | Op::Lesser(..) | Op::Where { .. }) => counts.compare += 1,
                    Some(Op::Sqrt(_)) => counts.sqrt += 1,
                    Some(Op::Add(..) | Op::Sub(..)) => counts.add += 1,
                    Some(Op::Mul(..)) => counts.mul += 1,
                    Some(Op::Div(..)) => counts.div += 1,
                    Some(Op::Kernel { kernel, args, .. }) => {
                        // The results of one call count once.
                        let call = (*kernel, args.clone());
                        if !pairs.contains(&call) {
                            match kernel {
                                Kernel::SinCos | Kernel::SinCosSum(_) => counts.sin_cos += 1,
                                Kernel::Atan2 => counts.atan2 += 1,
                                Kernel::MulAdd => counts.fused += 1,
                                Kernel::Unit => counts.unit += 1,
                                Kernel::Solve2 | Kernel::Solve3 | Kernel::Solve(_) => counts.solve += 1,
                                Kernel::Search { .. } => counts.search += 1,
                            }
                            pairs.push(call);
                        }
                    }
                    Some(Op::Constant(_) | Op::Symbol(_) | Op::Quantity(_) | Op::Held(_) | Op::Checked { .. })
                    | None => {}
                },
                // That is what its sine asks.
                Step::FiniteInput(value) if angles.contains(value) => {}
                Step::Check { .. } | Step::FiniteInput(_) | Step::FiniteResults(_) => counts.compare += 1,
            }
        }
        counts
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.add, "+−"),
            (self.mul, "×"),
            (self.fused, "fma"),
            (self.div, "÷"),
            (self.sqrt, "√"),
            (self.sin_cos, "sin/cos"),
            (self.atan2, "atan2"),
            (self.unit, "unit"),
            (self.solve, "solve"),
            (self.search, "search"),
            (self.sign, "sign"),
            (self.compare, "compare"),
        ];
        let parts: Vec<String> = parts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")).collect();
        if parts.is_empty() { f.write_str("no operation") } else { f.write_str(&parts.join(", ")) }
    }
}
