//! Loops of constant lengths: what is decided at compile time, by the exact signs of exact numbers.

use super::{DrivenSlide, Extreme, FourBar, Loop, Possible, Posture, Shape, Stroke, Turning};
use crate::graph::number::Number;
use crate::graph::{Graph, NodeId};

/// The class of a four-bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grashof {
    /// The crank goes all round, the output rocks.
    CrankRocker,
    /// Both go all round.
    DoubleCrank,
    /// Both rock, and the coupler goes all round.
    DoubleRocker,
    /// The driver rocks, the output goes all round.
    RockerCrank,
    /// All rock.
    TripleRocker,
    /// The linkage folds.
    ChangePoint,
}

impl Grashof {
    /// By the signs of `g − a + h − b`, `g − a − h + b` and `h + b − g − a`.
    #[must_use]
    pub fn of(signs: [i8; 3]) -> Self {
        match signs {
            [1, 1, 1] => Self::CrankRocker,
            [1, -1, -1] => Self::RockerCrank,
            [-1, -1, 1] => Self::DoubleCrank,
            [-1, 1, -1] => Self::DoubleRocker,
            signs if signs.contains(&0) => Self::ChangePoint,
            _ => Self::TripleRocker,
        }
    }

    /// Its variant in the run-time crate.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::CrankRocker => "CrankRocker",
            Self::DoubleCrank => "DoubleCrank",
            Self::DoubleRocker => "DoubleRocker",
            Self::RockerCrank => "RockerCrank",
            Self::TripleRocker => "TripleRocker",
            Self::ChangePoint => "ChangePoint",
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::CrankRocker => "crank-rocker",
            Self::DoubleCrank => "double-crank",
            Self::DoubleRocker => "double-rocker",
            Self::RockerCrank => "rocker-crank",
            Self::TripleRocker => "triple-rocker",
            Self::ChangePoint => "change point",
        }
    }
}

/// A loop of constant lengths.
#[derive(Clone, Debug)]
pub struct Known {
    /// Of a four-bar.
    pub class: Option<Grashof>,
    /// How far the driver can go.
    pub range: KnownRange,
    /// Where the output as driver is at a dead centre.
    pub dead_centres: [Option<KnownPosition>; 2],
    /// How far the output goes while the driver goes round.
    pub stroke: Option<KnownStroke>,
    /// The least and the greatest transmission angle.
    pub transmission: Option<[KnownTransmission; 2]>,
}

/// How far a driver can go.
#[derive(Clone, Debug)]
pub enum KnownRange {
    /// All round.
    Unlimited,
    /// From one limit to the other.
    One([KnownPosition; 2]),
    /// Within one of two pieces.
    Two([[KnownPosition; 2]; 2]),
}

/// A position of the driver at which a joint is at its limit.
#[derive(Clone, Debug)]
pub struct KnownPosition {
    /// The coordinate.
    pub at: Number,
    /// The joint.
    pub joint: String,
    /// How it stands.
    pub posture: Posture,
}

/// How far an output goes.
#[derive(Clone, Debug)]
pub struct KnownStroke {
    /// From end to end.
    pub extent: Number,
    /// The turn of the driver for the slower way over that for the quicker one.
    pub time_ratio: Number,
}

/// A transmission angle.
#[derive(Clone, Debug)]
pub struct KnownTransmission {
    /// The angle.
    pub angle: Number,
    /// The coordinate of the driver.
    pub at: Number,
}

/// The loop's values. `None` if one is not constant or does not fit the scalar.
pub(super) fn known(graph: &Graph, found: &Loop) -> Option<Known> {
    let values = Values { graph };
    match &found.shape {
        Shape::FourBar(FourBar { balances, range, dead_centres, swing, transmission, .. }) => {
            let mut signs = [0; 3];
            for (sign, node) in signs.iter_mut().zip(balances) {
                *sign = values.of(*node)?.signum();
            }
            Some(Known {
                class: Some(Grashof::of(signs)),
                range: values.range(range)?,
                dead_centres: values.dead_centres(dead_centres)?,
                stroke: values.stroke(swing)?,
                transmission: Some(values.extremes(transmission)?),
            })
        }
        Shape::SliderCrank(slider_crank) => Some(Known {
            class: None,
            range: values.range(&slider_crank.range)?,
            dead_centres: values.dead_centres(&slider_crank.dead_centres)?,
            stroke: match &slider_crank.stroke {
                Some(stroke) => values.stroke(stroke)?,
                None => None,
            },
            transmission: match &slider_crank.transmission {
                Some(both) => Some(values.extremes(both)?),
                None => None,
            },
        }),
        Shape::DrivenSlide(driven) => Some(Known {
            class: None,
            range: values.travels(driven)?,
            dead_centres: [None, None],
            stroke: None,
            transmission: None,
        }),
    }
}

/// An angle in (−π, π].
fn turned(mut angle: Number) -> Number {
    let (half, whole) = (Number::pi(1, 1), Number::pi(2, 1));
    while angle.compare(&half).is_gt() {
        angle = angle.sub(&whole);
    }
    while angle.compare(&half.neg()).is_le() {
        angle = angle.add(&whole);
    }
    angle
}

struct Values<'g> {
    graph: &'g Graph,
}

impl Values<'_> {
    fn of(&self, node: NodeId) -> Option<Number> {
        self.graph.constant_value(node).filter(|number| number.fits(self.graph.scalar()))
    }

    /// The limit, if there is one.
    fn limit(&self, limit: Option<[NodeId; 2]>) -> Option<Option<Number>> {
        let Some([margin, angle]) = limit else { return Some(None) };
        let (margin, angle) = (self.of(margin)?, self.of(angle)?);
        Some((margin.signum() < 0).then_some(angle))
    }

    fn range(&self, turning: &Turning) -> Option<KnownRange> {
        let centre = self.of(turning.centre)?;
        let [near, far] = [self.limit(turning.near)?, self.limit(turning.far)?];
        let position = |at: Number, posture| KnownPosition { at, joint: turning.joint.clone(), posture };
        let [at_near, at_far] = turning.postures;
        // Both ends lie as far from the first, which is within a turn.
        let piece = |from: Number, to: Number, postures: [Posture; 2]| {
            let (first, width) = (turned(centre.add(&from)), to.sub(&from));
            [position(first.clone(), postures[0]), position(first.add(&width), postures[1])]
        };
        let rest = |near: &Number| Number::pi(2, 1).sub(near);
        Some(match (near, far) {
            (None, None) => KnownRange::Unlimited,
            (Some(near), None) => KnownRange::One(piece(near.clone(), rest(&near), [at_near; 2])),
            (None, Some(far)) => KnownRange::One(piece(far.neg(), far, [at_far; 2])),
            (Some(near), Some(far)) => {
                KnownRange::Two([piece(far.neg(), near.neg(), [at_far, at_near]), piece(near, far, [at_near, at_far])])
            }
        })
    }

    fn travels(&self, driven: &DrivenSlide) -> Option<KnownRange> {
        let (centre, far) = (self.of(driven.centre)?, self.of(driven.far)?);
        let [margin, near] = driven.near.map(|node| self.of(node));
        let near = (margin?.signum() > 0).then_some(near?);
        let at = |by: Number, posture| KnownPosition { at: centre.add(&by), joint: driven.joint.clone(), posture };
        let (stretched, folded) = (|by| at(by, Posture::Stretched), |by| at(by, Posture::Folded));
        Some(match near {
            None => KnownRange::One([stretched(far.neg()), stretched(far)]),
            Some(near) => KnownRange::Two([[stretched(far.neg()), folded(near.neg())], [folded(near), stretched(far)]]),
        })
    }

    fn dead_centres(&self, all: &[Possible]) -> Option<[Option<KnownPosition>; 2]> {
        let mut found = [None, None];
        for (found, possible) in found.iter_mut().zip(all) {
            let mut there = true;
            for margin in &possible.margins {
                there &= self.of(*margin)?.signum() >= 0;
            }
            let at = turned(self.of(possible.at)?);
            let (joint, posture) = (possible.joint.clone(), possible.posture);
            *found = there.then_some(KnownPosition { at, joint, posture });
        }
        Some(found)
    }

    fn stroke(&self, stroke: &Stroke) -> Option<Option<KnownStroke>> {
        for margin in &stroke.margins {
            if self.of(*margin)?.signum() <= 0 {
                return Some(None);
            }
        }
        let (extent, advance) = (self.of(stroke.extent)?, self.of(stroke.advance)?.abs());
        let half = Number::pi(1, 1);
        let time_ratio = half.add(&advance).div(&half.sub(&advance))?;
        Some(time_ratio.fits(self.graph.scalar()).then_some(KnownStroke { extent, time_ratio }))
    }

    fn extremes(&self, both: &[Extreme; 2]) -> Option<[KnownTransmission; 2]> {
        let one = |extreme: &Extreme| {
            Some(KnownTransmission { angle: self.of(extreme.angle)?, at: turned(self.of(extreme.at)?) })
        };
        Some([one(&both[0])?, one(&both[1])?])
    }
}
