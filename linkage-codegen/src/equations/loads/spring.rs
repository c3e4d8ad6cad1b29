//! A spring between two points: the tension `k (L − L₀) + p` pulls them together.

use super::{Action, Line};
use crate::graph::Expr;

pub(super) fn actions<'m>(line: &Line<'m>, rate: Expr<'m>, free: Expr<'m>, preload: Expr<'m>) -> Vec<Action> {
    // In proportion to the length, the force is the rate times the vector between the points, and needs no direction: it is exact, and
    // zero where they coincide.
    if (preload - rate * free).is_zero() {
        return line.pushed(-line.span.scaled(rate));
    }
    let equation = if preload.is_zero() { "rate·(length − free)" } else { "rate·(length − free) + preload" };
    let tension = rate * (line.length() - free) + preload;
    line.pushed(line.along(-tension.named(format!("{}_tension", line.name), equation)))
}
