//! The line between two points, along which springs and thrusts act.

use super::{Action, Posture, Span};
use crate::graph::{Expr, Failure, Vector};
use crate::model::End;
use crate::model::ids::GROUND;

/// The line between two points.
#[derive(Clone, Debug)]
pub struct Line<'m> {
    /// What acts along it.
    pub name: String,
    ends: [End; 2],
    places: [Vector<'m>; 2],
    /// From the first point to the second, ground axes.
    pub span: Vector<'m>,
    rounding: Option<Expr<'m>>,
    apart: bool,
    /// In words.
    meaning: String,
}

impl<'m> Line<'m> {
    /// Between two points.
    #[must_use]
    pub fn between(posture: &dyn Posture<'m>, name: &str, ends: [End; 2]) -> Self {
        let model = posture.model();
        let Span { vector: span, length: rounding, apart } = posture.span(ends);
        let meaning = format!("from {} to {}", model.end_name(ends[0]), model.end_name(ends[1]));
        let span = span.named(&format!("{name}_span"), &meaning);
        Self { name: name.to_owned(), ends, places: ends.map(|end| model.local(end)), span, rounding, apart, meaning }
    }

    /// Its direction, a unit vector; zero where the points coincide.
    #[must_use]
    pub fn direction(&self) -> Vector<'m> {
        self.span.graph().unit(self.span).named_direction(&self.name, "")
    }

    /// The distance of the points.
    #[must_use]
    pub fn length(&self) -> Expr<'m> {
        self.direction().dot(self.span).named(format!("{}_length", self.name), format!("distance {}", self.meaning))
    }

    /// How fast the distance grows.
    #[must_use]
    pub fn stretching(&self, posture: &dyn Posture<'m>) -> Expr<'m> {
        let velocity = posture.velocity(self.ends);
        let stretching = self.direction().dot(velocity);
        stretching.named(format!("{}_stretching", self.name), format!("rate of the distance {}", self.meaning))
    }

    /// How much larger than that of a declared direction the rounding of its direction may be: it grows where the points come near each
    /// other.
    #[must_use]
    pub fn spread(&self) -> Expr<'m> {
        let one = self.span.graph().one();
        self.rounding.map_or(one, |rounding| one + rounding / self.checked(self.length()))
    }

    /// A value that has a meaning only where the line has a direction, whatever the load: where its points are further apart than their
    /// rounding. Where they always are, nothing is asked.
    #[must_use]
    pub fn checked(&self, value: Expr<'m>) -> Expr<'m> {
        let Some(rounding) = self.rounding.filter(|_| !self.apart) else { return value };
        let rounding = value.graph().epsilons(8) * rounding;
        value.require_above(self.length(), rounding, Failure::CoincidentEnds { of: self.name.clone() })
    }

    /// The force of this size on the second point, away from the first.
    #[must_use]
    pub fn along(&self, force: Expr<'m>) -> Vector<'m> {
        self.direction().scaled(self.checked(force))
    }

    /// A force on the second point, and the opposite one on the first.
    #[must_use]
    pub fn pushed(&self, force: Vector<'m>) -> Vec<Action> {
        let on = |index: usize, force: Vector<'m>| {
            let link = self.ends[index].link;
            (link != GROUND).then(|| Action::Force {
                link,
                at: self.places[index].into(),
                force: force.into(),
                frame: GROUND,
            })
        };
        [on(0, -force), on(1, force)].into_iter().flatten().collect()
    }
}
