//! Pivots: the quantities that a group's forces and velocities are divided by, each a named sine or cosine of the geometry.
//!
//! A pivot that is no larger than the rounding that could have produced it counts as zero, and dividing by it is a typed error: a
//! dead centre. What the closure of a group knows of an angle is kept, because a cross product of rounded directions would lose it next to a fold.

use std::collections::BTreeMap;

use super::placement::{Line, Placement, Way};
use crate::graph::{Expr, Failure, Vector};
use crate::model::ids::JointId;

/// Rounding of the cross product of two unit vectors, each true to 3 ε, in epsilons.
const ROUNDING: i64 = 8;

/// Sine and cosine between two directions, as far as a closure knows them.
#[derive(Clone, Copy, Debug)]
struct Known<'m> {
    from: Vector<'m>,
    to: Vector<'m>,
    sine: Option<Expr<'m>>,
    cosine: Option<Expr<'m>>,
}

/// The angles between directions that closures know.
#[derive(Clone, Debug, Default)]
pub struct Pivots<'m> {
    known: Vec<Known<'m>>,
    reaches: BTreeMap<JointId, Expr<'m>>,
}

impl<'m> Pivots<'m> {
    /// States the sine and the cosine of the angle between two directions. What is used as a divisor is zero where it is no larger
    /// than its rounding.
    pub fn state(&mut self, from: Vector<'m>, to: Vector<'m>, sine: Option<Expr<'m>>, cosine: Option<Expr<'m>>) {
        self.known.push(Known { from, to, sine, cosine });
    }

    /// All that is stated: two directions, and the sine and the cosine of the angle from the first to the second.
    pub(super) fn stated(&self) -> impl Iterator<Item = (Vector<'m>, Vector<'m>, Option<Expr<'m>>, Option<Expr<'m>>)> {
        self.known.iter().map(|known| (known.from, known.to, known.sine, known.cosine))
    }

    /// States the distance of two pins along the slide between them, zero where it is no larger than its rounding.
    pub fn state_reach(&mut self, slide: JointId, reach: Expr<'m>) {
        self.reaches.insert(slide, reach);
    }

    /// The distance of two pins along the slide between them as a divisor: what is known of it, or the sum of the way.
    #[must_use]
    pub fn dividing_reach(&self, slide: JointId, way: &Way<'m>, line: Line<'m>, name: &str, group: &str) -> Expr<'m> {
        let of_way = || {
            let reach = way.resolved_along(line).x.named(name, "from pin to pin, along the slide");
            reach.where_above(reach.abs(), reach.graph().epsilons(ROUNDING) * way.length())
        };
        divisor(self.reaches.get(&slide).copied().unwrap_or_else(of_way), name, group)
    }

    /// The sine between the directions of two slides as a divisor.
    #[must_use]
    pub fn dividing_slides(
        &self,
        placement: &Placement<'m>,
        slides: [JointId; 2],
        name: &str,
        group: &str,
    ) -> Expr<'m> {
        let [from, to] = slides.map(|slide| placement.slide_direction(slide));
        let known = self.find(from, to, |k| k.sine, -1);
        divisor(
            known.unwrap_or_else(|| significant(placement.between(slides).y.named(name, ""), placement.graph().one())),
            name,
            group,
        )
    }

    /// `from × to`.
    #[must_use]
    pub fn sine(&self, from: Vector<'m>, to: Vector<'m>) -> Expr<'m> {
        self.find(from, to, |k| k.sine, -1).unwrap_or_else(|| from.cross(to))
    }

    /// `from · to`.
    #[must_use]
    pub fn cosine(&self, from: Vector<'m>, to: Vector<'m>) -> Expr<'m> {
        self.known_cosine(from, to).unwrap_or_else(|| from.dot(to))
    }

    /// `from · to`, if a closure knows it.
    #[must_use]
    pub fn known_cosine(&self, from: Vector<'m>, to: Vector<'m>) -> Option<Expr<'m>> {
        self.find(from, to, |k| k.cosine, 1)
    }

    /// `from × to` as a divisor.
    #[must_use]
    pub fn dividing_sine(&self, from: Vector<'m>, to: Vector<'m>, name: &str, group: &str) -> Expr<'m> {
        let known = self.find(from, to, |k| k.sine, -1);
        divisor(known.unwrap_or_else(|| significant(from.cross(to).named(name, ""), from.graph().one())), name, group)
    }

    /// `from · to` as a divisor. `spread` is how much larger than that of a unit vector the rounding of the second may be.
    #[must_use]
    pub fn dividing_cosine(
        &self,
        from: Vector<'m>,
        to: Vector<'m>,
        spread: Expr<'m>,
        name: &str,
        group: &str,
    ) -> Expr<'m> {
        let known = self.known_cosine(from, to);
        divisor(known.unwrap_or_else(|| significant(from.dot(to).named(name, ""), spread)), name, group)
    }

    /// What is known of the directions, in either order and of either sense. `swapped` is the sign that an exchange brings.
    fn find(
        &self,
        from: Vector<'m>,
        to: Vector<'m>,
        part: impl Fn(&Known<'m>) -> Option<Expr<'m>>,
        swapped: i64,
    ) -> Option<Expr<'m>> {
        let sense = |a: Vector<'m>, b: Vector<'m>| {
            if a == b { Some(1) } else { (a == -b).then_some(-1) }
        };
        self.known.iter().find_map(|k| {
            let found = part(k)?;
            let straight = sense(from, k.from).zip(sense(to, k.to)).map(|(a, b)| a * b);
            let crossed = sense(from, k.to).zip(sense(to, k.from)).map(|(a, b)| a * b * swapped);
            straight.or(crossed).map(|sign| sign * found)
        })
    }
}

/// The value, or zero where it is no larger than the rounding of a product of unit vectors.
pub(super) fn significant<'m>(value: Expr<'m>, spread: Expr<'m>) -> Expr<'m> {
    value.where_above(value.abs(), value.graph().epsilons(ROUNDING) * spread)
}

/// A pivot as a divisor: zero is a dead centre.
#[must_use]
pub(super) fn divisor<'m>(pivot: Expr<'m>, name: &str, group: &str) -> Expr<'m> {
    let failure = Failure::DeadCentre { group: group.into(), pivot: name.into() };
    pivot.require_above(pivot.abs(), pivot.graph().zero(), failure)
}
