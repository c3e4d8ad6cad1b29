//! A spring between two points: the tension `k (L − L₀) + p + c L̇` pulls them together.

use super::{Action, Line};
use crate::graph::Expr;

/// `damped` is the part of its damper, if it has one: that needs a direction.
pub(super) fn actions<'m>(
    line: &Line<'m>,
    rate: Expr<'m>,
    free: Expr<'m>,
    preload: Expr<'m>,
    damped: Option<Expr<'m>>,
) -> Vec<Action> {
    let pull =
        |tension: Expr<'m>, equation: &str| line.along(-tension.named(format!("{}_tension", line.name), equation));
    // In proportion to the length, the force is the rate times the vector between the points, and needs no direction: it is exact, and
    // zero where they coincide.
    if (preload - rate * free).is_zero() {
        let force = -line.span.scaled(rate);
        return line.pushed(damped.map_or(force, |damped| force + pull(damped, "damping·stretching")));
    }
    let equation = if preload.is_zero() { "rate·(length − free)" } else { "rate·(length − free) + preload" };
    let tension = rate * (line.length() - free) + preload;
    line.pushed(match damped {
        Some(damped) => pull(tension + damped, &format!("{equation} + damping·stretching")),
        None => pull(tension, equation),
    })
}
