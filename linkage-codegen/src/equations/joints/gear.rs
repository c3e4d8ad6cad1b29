//! Gear pair: two wheels roll on each other, their centres kept apart by an arm.
//!
//! With ψ the direction from the first centre P to the second Q, fixed in the arm, and the second radius negative where the first wheel
//! is a ring,
//!
//! ```text
//! r₁ (θ₁ − ψ) + r₂ (θ₂ − ψ) = phase
//! ```
//!
//! In lengths along the common normal of the teeth, `t + tan α u` with `u` along ψ and `t = u⊥`, the wheels' turning and the motion of
//! their centres make
//!
//! ```text
//! (t + tan α u) · PQ − tan α |PQ| − (r₁ (θ₁ − ψ) + r₂ (θ₂ − ψ) − phase) |PQ|/(r₁ + r₂) = 0
//! ```
//!
//! The first two terms together are zero wherever the arm is: they do not tell where the wheels are, but which force the teeth exert.
//! Its part along the line of centres does no work.

use super::{Component, Constraint, Ends};
use crate::equations::Body;
use crate::graph::{Expr, Vector};

/// The dimensions of a gear pair.
#[derive(Clone, Copy, Debug)]
pub struct Teeth<'g> {
    /// The radii; the second is negative where the first wheel is a ring.
    pub radii: [Expr<'g>; 2],
    /// What the arcs make together.
    pub phase: Expr<'g>,
    /// The tangent of the pressure angle, negative on the right flank.
    pub incline: Expr<'g>,
    /// The link that keeps the centres apart.
    pub arm: Body<'g>,
    /// From the first centre to the second in its frame, a direction.
    pub centres: Vector<'g>,
    /// How far.
    pub distance: Expr<'g>,
}

pub(super) fn constraints<'g>(ends: &Ends<'g>, teeth: &Teeth<'g>) -> Vec<Constraint<'g>> {
    let Teeth { radii: [first, second], phase, incline, arm, centres, distance } = *teeth;
    let along = arm.turned(centres);
    let line = arm.angle + along.graph().atan2(centres.y, centres.x);
    let rolled = first * (ends.first.angle - line) + second * (ends.second.angle - line) - phase;
    let normal = along.perp() + incline * along;
    let residual = normal.dot(ends.gap()) - incline * distance - (distance / (first + second)) * rolled;
    vec![Constraint { component: Component::Tangential, residual }]
}
