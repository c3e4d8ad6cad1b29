//! Where points and links are, as loads see them.

use crate::equations::Body;
use crate::graph::{Expr, Symbol, Vector};
use crate::model::ids::{DriveId, LinkId};
use crate::model::{End, Model};

/// Where points and links are, as loads see them: in the symbols of the equations, or as a plan has placed them.
pub trait Posture<'m> {
    /// The linkage.
    fn model(&self) -> &'m Model;

    /// From a point to another, ground axes, and the lengths that its rounding grows with; in symbols there is none.
    fn span(&self, ends: [End; 2]) -> (Vector<'m>, Option<Expr<'m>>);

    /// The direction of the x axis of a link's frame.
    fn frame(&self, link: LinkId) -> Vector<'m>;
}

/// In the symbols of the unreduced equations.
#[derive(Clone, Copy, Debug)]
pub struct Symbolic<'m>(pub &'m Model);

impl<'m> Posture<'m> for Symbolic<'m> {
    fn model(&self) -> &'m Model {
        self.0
    }

    fn span(&self, ends: [End; 2]) -> (Vector<'m>, Option<Expr<'m>>) {
        let [first, second] = ends.map(|end| Body::symbolic(&self.0.graph, end.link).point(self.0.local(end)));
        (second - first, None)
    }

    fn frame(&self, link: LinkId) -> Vector<'m> {
        Body::symbolic(&self.0.graph, link).direction
    }
}

/// The angle of the second link from the first, less a free angle. Where driven pins, slides and welds lead from one to the other, it is what
/// these give, of any number of turns; elsewhere only directions are known, and it is the smallest one, in (−π, π].
pub(super) fn wound<'m>(posture: &dyn Posture<'m>, [from, on]: [LinkId; 2], free: Expr<'m>) -> Expr<'m> {
    if let Some(angle) = driven_angle(posture.model(), from, on) {
        return angle - free;
    }
    let graph = free.graph();
    let turned = posture.frame(on).resolved_along(posture.frame(from)).resolved_along(free.direction());
    graph.atan2(turned.y, turned.x)
}

/// The angle of a link from another one, if driven pins, slides and welds give it.
fn driven_angle(model: &Model, from: LinkId, on: LinkId) -> Option<Expr<'_>> {
    let mut reached = vec![(from, model.graph.zero())];
    let mut next = 0;
    while let Some((link, angle)) = reached.get(next).copied() {
        if link == on {
            return Some(angle);
        }
        next += 1;
        for joint in model.joint_ids() {
            let data = model.joint(joint);
            let Some(other) = data.end_off(link).filter(|end| reached.iter().all(|(link, _)| *link != end.link)) else {
                continue;
            };
            let fixed = data.kind.turn().map(|(_, angle)| model.graph.expr(angle));
            let driven = |drive: DriveId| model.drive(drive).turns.then(|| model.graph.symbol(Symbol::Drive(drive)));
            let turn = fixed.or_else(|| model.drive_of(joint).and_then(driven));
            if let Some(turn) = turn {
                reached.push((other.link, if data.to == other { angle + turn } else { angle - turn }));
            }
        }
    }
    None
}
