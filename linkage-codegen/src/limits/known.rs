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
    let fits = |node: &NodeId| graph.constant_value(*node).is_some_and(|number| number.fits(graph.scalar()));
    if !found.shape.nodes().iter().all(fits) {
        return None;
    }
    let values = Values { graph };
    Some(match &found.shape {
        Shape::FourBar(FourBar { balances, range, dead_centres, swing, transmission, .. }) => Known {
            class: Some(Grashof::of(balances.map(|node| values.of(node).signum()))),
            range: values.range(range),
            dead_centres: values.dead_centres(dead_centres),
            stroke: values.stroke(swing),
            transmission: Some(transmission.map(|one| values.extreme(one))),
        },
        Shape::SliderCrank(slider_crank) => Known {
            class: None,
            range: values.range(&slider_crank.range),
            dead_centres: values.dead_centres(&slider_crank.dead_centres),
            stroke: slider_crank.stroke.as_ref().and_then(|stroke| values.stroke(stroke)),
            transmission: slider_crank.transmission.map(|both| both.map(|one| values.extreme(one))),
        },
        Shape::DrivenSlide(driven) => Known {
            class: None,
            range: values.travels(driven),
            dead_centres: [None, None],
            stroke: None,
            transmission: None,
        },
    })
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
    /// The value of a node; all that is asked for is constant.
    fn of(&self, node: NodeId) -> Number {
        self.graph.constant_value(node).unwrap_or_else(Number::zero)
    }

    /// The limit, if there is one.
    fn limit(&self, limit: Option<[NodeId; 2]>) -> Option<Number> {
        let [margin, angle] = limit?;
        (self.of(margin).signum() < 0).then(|| self.of(angle))
    }

    fn range(&self, turning: &Turning) -> KnownRange {
        let centre = self.of(turning.centre);
        let (near, far) = (self.limit(turning.near), self.limit(turning.far));
        let position = |at: Number, posture| KnownPosition { at, joint: turning.joint.clone(), posture };
        let [at_near, at_far] = turning.postures;
        let piece = |from: Number, to: &Number, postures: [Posture; 2]| {
            let (first, width) = (turned(centre.add(&from)), to.sub(&from));
            [position(first.clone(), postures[0]), position(first.add(&width), postures[1])]
        };
        match (near, far) {
            (None, None) => KnownRange::Unlimited,
            (Some(near), None) => {
                let rest = Number::pi(2, 1).sub(&near);
                KnownRange::One(piece(near, &rest, [at_near; 2]))
            }
            (None, Some(far)) => KnownRange::One(piece(far.neg(), &far, [at_far; 2])),
            (Some(near), Some(far)) => KnownRange::Two([
                piece(far.neg(), &near.neg(), [at_far, at_near]),
                piece(near, &far, [at_near, at_far]),
            ]),
        }
    }

    fn travels(&self, driven: &DrivenSlide) -> KnownRange {
        let (centre, far) = (self.of(driven.centre), self.of(driven.far));
        let [margin, near] = driven.near.map(|node| self.of(node));
        let at = |by: &Number, posture| KnownPosition { at: centre.add(by), joint: driven.joint.clone(), posture };
        let (stretched, folded) = (|by| at(by, Posture::Stretched), |by| at(by, Posture::Folded));
        if margin.signum() > 0 {
            KnownRange::Two([[stretched(&far.neg()), folded(&near.neg())], [folded(&near), stretched(&far)]])
        } else {
            KnownRange::One([stretched(&far.neg()), stretched(&far)])
        }
    }

    fn dead_centres(&self, all: &[Possible]) -> [Option<KnownPosition>; 2] {
        [0, 1].map(|index| {
            let Possible { margins, at, joint, posture } = all.get(index)?;
            let there = margins.iter().all(|margin| self.of(*margin).signum() >= 0);
            there.then(|| KnownPosition { at: turned(self.of(*at)), joint: joint.clone(), posture: *posture })
        })
    }

    fn stroke(&self, stroke: &Stroke) -> Option<KnownStroke> {
        let (extent, advance) = (self.of(stroke.extent), self.of(stroke.advance).abs());
        let half = Number::pi(1, 1);
        let time_ratio = half.add(&advance).div(&half.sub(&advance))?;
        let there = stroke.margins.iter().all(|margin| self.of(*margin).signum() > 0);
        (there && time_ratio.fits(self.graph.scalar())).then_some(KnownStroke { extent, time_ratio })
    }

    fn extreme(&self, extreme: Extreme) -> KnownTransmission {
        KnownTransmission { angle: self.of(extreme.angle), at: turned(self.of(extreme.at)) }
    }
}
