//! What a designer asks first of every four-bar and slider-crank in a linkage: how far its driver can go, where its output is at a dead
//! centre, how well it transmits.
//!
//! A module has the constant `LIMITS`, or with parameters the function `Limits::of`, with a field for each of these loops, named after the
//! joint at which it is assembled. A loop's driver is the joint that is known before its others: a driven joint, or one that an earlier
//! loop gives. Positions are in that joint's own coordinate, which for a driven joint is the drive: angles in radians, travels in the
//! linkage's unit of length. Numbers of constant lengths are exact, rounded once; which class a linkage belongs to and which limits it
//! has is decided exactly. With parameters both are decided in the scalar, by the sums of the lengths as they are rounded there.
//!
//! ```
//! use linkage_runtime::limits::{DriverRange, Grashof, Posture};
//! use linkage_runtime::{Error, linkage};
//!
//! linkage! {
//!     /// Its ground is too long for it to turn all round.
//!     mod four_bar;
//!     units { mm, N }
//!     ground       { A0: (0, 0), B0: (200mm, 0) }
//!     link crank   { A0 -> A: 80mm }
//!     link coupler { A -> B: 100mm }
//!     link rocker  { B0 -> B: 120mm }
//!     revolute A0: ground -> crank;
//!     revolute A: crank -> coupler;
//!     revolute B: coupler -> rocker;
//!     revolute B0: ground -> rocker;
//!     drive theta: A0;
//!     assemble B: left(A -> B0);
//!     scene places: position;
//! }
//!
//! let limits = four_bar::LIMITS.B;
//! assert_eq!(limits.class, Grashof::TripleRocker);
//! let DriverRange::One(range) = limits.range else { unreachable!() };
//! assert_eq!((range.to.joint, range.to.posture), ("B", Posture::Stretched));
//! assert!((range.to.at.cos() - (200f64.powi(2) + 80f64.powi(2) - 220f64.powi(2)) / (2.0 * 200.0 * 80.0)).abs() < 1e-15);
//! assert!(four_bar::Pose::at(range.to.at - 1e-12).is_ok());
//! assert!(matches!(four_bar::Pose::at(range.to.at + 1e-12), Err(Error::CannotAssemble { joint: "B", .. })));
//! ```

/// A loop of four pins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar<T> {
    /// Which of its links go all round.
    pub class: Grashof,
    /// How far the driver can go.
    pub range: DriverRange<T>,
    /// Where the driver stands when the output, as driver, is at a dead centre: crank and coupler in line, stretched and folded. For the
    /// closure that the declaration chooses; with the other one they lie mirrored in the line of the frame's pins.
    pub dead_centres: [Option<Position<T>>; 2],
    /// How far the output swings while the driver goes round, in radians; of a crank-rocker alone.
    pub swing: Option<Stroke<T>>,
    /// The least and the greatest angle between coupler and output, in [0, π]: 0 or π at a limit of the driver.
    pub transmission: [Transmission<T>; 2],
}

/// A loop of three pins and a slide with a pin as its driver. A pin in a slot is a pin and a slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderCrank<T> {
    /// Where its slide is.
    pub inversion: Inversion,
    /// How far the driver can go.
    pub range: DriverRange<T>,
    /// Where the driver stands when the output, as driver, is at a dead centre. With the slide on the frame crank and rod are in line,
    /// stretched and folded; with the slide opposite to the driver the crank is square to it, once on each side; with the slide on the crank,
    /// where there is only the first, the rod's end is as near to the driver as the slide lets it. For the closure that the declaration
    /// chooses.
    pub dead_centres: [Option<Position<T>>; 2],
    /// How far the output goes while the driver goes round: a slide on the frame in the unit of length, a link in radians. None where
    /// the driver does not go round or the output does.
    pub stroke: Option<Stroke<T>>,
    /// The least and the greatest angle between the rod and the normal of the slide, in [0, π]; none with the slide opposite to the
    /// driver, which pushes the output at a right angle always.
    pub transmission: Option<[Transmission<T>; 2]>,
}

/// A loop of three pins and a slide with the slide as its driver: a piston on its crank, a cylinder on its lever.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenSlide<T> {
    /// How far the slide can go, its travel in the unit of length.
    pub range: DriverRange<T>,
}

/// The class of a four-bar, by the sum of its shortest and its longest link against that of the two others (Grashof).
///
/// The driver is named first. In brackets Barker's names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Grashof {
    /// The driver is the shortest link and goes all round, the output rocks (GCRR).
    CrankRocker,
    /// The frame is the shortest: driver and output go all round (GCCC), a drag link.
    DoubleCrank,
    /// The coupler is the shortest and goes all round, driver and output rock (GRCR).
    DoubleRocker,
    /// The output is the shortest link and goes all round, the driver rocks (GRRC).
    RockerCrank,
    /// No link goes all round: the two others are less than the shortest and the longest (RRR1 to RRR4).
    TripleRocker,
    /// The sums are equal: the linkage folds (change point; S1X to S6X).
    ChangePoint,
}

/// Where the slide of a slider-crank is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Inversion {
    /// On the frame: the slider-crank itself.
    OnFrame,
    /// On the driven link, along which a block runs that the output holds.
    OnCrank,
    /// Opposite to the driver: an oscillating cylinder, a slotted lever.
    Opposite,
}

/// How far a driver can go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DriverRange<T> {
    /// All round.
    Unlimited,
    /// From one limit to the other.
    One(Interval<T>),
    /// Within one of two intervals: from one into the other the linkage does not get without being taken apart.
    Two([Interval<T>; 2]),
}

/// From a limit of a driver to the next. Of an angle the first lies in (−π, π], the second within a turn behind it; whole turns may be
/// added to both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<T> {
    /// Its least coordinate.
    pub from: Position<T>,
    /// Its greatest.
    pub to: Position<T>,
}

/// A position of a driver where a joint is at its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position<T> {
    /// The coordinate of the driver; an angle in (−π, π], but for the end of an interval.
    pub at: T,
    /// The joint at its limit.
    pub joint: &'static str,
    /// How it stands there.
    pub posture: Posture,
}

/// How two links stand where the joint between them is at its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Posture {
    /// In line, one behind the other.
    Stretched,
    /// In line, one upon the other.
    Folded,
    /// At a right angle to the slide.
    Square,
}

/// How far an output goes, to and fro, while the driver goes round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke<T> {
    /// From end to end.
    pub extent: T,
    /// The turn of the driver for the slower way over that for the quicker one: 1 or more, the quick return's ratio of times where the
    /// driver turns evenly.
    pub time_ratio: T,
}

/// A transmission angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission<T> {
    /// The angle, in radians.
    pub angle: T,
    /// Where the driver stands; at limits of the driver there are two such positions, of which this is one.
    pub at: T,
}

/// What emitted code puts together from angles and the margins that decide about them.
macro_rules! limits {
    ($scalar:ident) => {
        use crate::limits::{DriverRange, Grashof, Interval, Position, Posture, Stroke};

        const PI: $scalar = core::$scalar::consts::PI;

        /// An angle of less than two turns in (−π, π].
        #[must_use]
        pub fn within_a_turn(angle: $scalar) -> $scalar {
            let angle = if angle > PI { angle - 2.0 * PI } else { angle };
            if angle <= -PI { angle + 2.0 * PI } else { angle }
        }

        /// The class of a four-bar by `g − a + h − b`, `g − a − h + b` and `h + b − g − a`.
        #[must_use]
        pub fn grashof([first, second, third]: [$scalar; 3]) -> Grashof {
            if first == 0.0 || second == 0.0 || third == 0.0 {
                return Grashof::ChangePoint;
            }
            match (first > 0.0, second > 0.0, third > 0.0) {
                (true, true, true) => Grashof::CrankRocker,
                (true, false, false) => Grashof::RockerCrank,
                (false, false, true) => Grashof::DoubleCrank,
                (false, true, false) => Grashof::DoubleRocker,
                _ => Grashof::TripleRocker,
            }
        }

        /// The range of a driving pin within `far` of its centre on both sides, but no nearer than `near`; each is a limit where the margin
        /// before it is negative.
        #[must_use]
        pub fn turning(
            centre: $scalar,
            near: ($scalar, $scalar, Posture),
            far: ($scalar, $scalar, Posture),
            joint: &'static str,
        ) -> DriverRange<$scalar> {
            let (near_margin, near, at_near) = near;
            let (far_margin, far, at_far) = far;
            let interval = |from: $scalar, to: $scalar, first, last| {
                let at = within_a_turn(centre + from);
                let from_there = Position { at: at + (to - from), joint, posture: last };
                Interval { from: Position { at, joint, posture: first }, to: from_there }
            };
            match (near_margin < 0.0, far_margin < 0.0) {
                (false, false) => DriverRange::Unlimited,
                (true, false) => DriverRange::One(interval(near, 2.0 * PI - near, at_near, at_near)),
                (false, true) => DriverRange::One(interval(-far, far, at_far, at_far)),
                (true, true) => {
                    DriverRange::Two([interval(-far, -near, at_far, at_near), interval(near, far, at_near, at_far)])
                }
            }
        }

        /// The range of a driving slide within `far` of its centre on both sides, but no nearer than `near` where the margin before it is
        /// positive.
        #[must_use]
        pub fn sliding(
            centre: $scalar,
            (near_margin, near): ($scalar, $scalar),
            far: $scalar,
            joint: &'static str,
        ) -> DriverRange<$scalar> {
            let stretched = |by: $scalar| Position { at: centre + by, joint, posture: Posture::Stretched };
            let folded = |by: $scalar| Position { at: centre + by, joint, posture: Posture::Folded };
            if near_margin > 0.0 {
                DriverRange::Two([
                    Interval { from: stretched(-far), to: folded(-near) },
                    Interval { from: folded(near), to: stretched(far) },
                ])
            } else {
                DriverRange::One(Interval { from: stretched(-far), to: stretched(far) })
            }
        }

        /// A position that is there if no margin is negative.
        #[must_use]
        pub fn possible<const N: usize>(
            margins: [$scalar; N],
            at: $scalar,
            joint: &'static str,
            posture: Posture,
        ) -> Option<Position<$scalar>> {
            let mut rest = margins.as_slice();
            while let [margin, others @ ..] = rest {
                if *margin < 0.0 {
                    return None;
                }
                rest = others;
            }
            Some(Position { at: within_a_turn(at), joint, posture })
        }

        /// The stroke of an output if all margins are positive, with the driver's turn from end to end, less half a turn.
        #[must_use]
        pub fn stroke<const N: usize>(
            margins: [$scalar; N],
            extent: $scalar,
            advance: $scalar,
        ) -> Option<Stroke<$scalar>> {
            let mut rest = margins.as_slice();
            while let [margin, others @ ..] = rest {
                if *margin <= 0.0 {
                    return None;
                }
                rest = others;
            }
            let advance = advance.abs();
            let time_ratio = (PI + advance) / (PI - advance);
            // At an advance of half a turn there is no way back.
            let there = time_ratio.is_finite() && time_ratio > 0.0;
            if there { Some(Stroke { extent, time_ratio }) } else { None }
        }
    };
}
pub(crate) use limits;

#[cfg(test)]
mod tests {
    use super::{DriverRange, Grashof, Posture};
    use crate::__private::f64::{grashof, possible, sliding, stroke, turning, within_a_turn};
    use core::f64::consts::PI;

    #[test]
    fn angles_within_a_turn() {
        let found = [within_a_turn(PI), within_a_turn(-PI), within_a_turn(4.0), within_a_turn(-4.0)].map(f64::to_bits);
        assert_eq!(found, [PI, PI, 4.0 - 2.0 * PI, 2.0 * PI - 4.0].map(f64::to_bits));
    }

    #[test]
    fn classes_by_signs() {
        let all = [
            ([1.0, 1.0, 1.0], Grashof::CrankRocker),
            ([1.0, -1.0, -1.0], Grashof::RockerCrank),
            ([-1.0, -1.0, 1.0], Grashof::DoubleCrank),
            ([-1.0, 1.0, -1.0], Grashof::DoubleRocker),
            ([-1.0, -1.0, -1.0], Grashof::TripleRocker),
            ([-1.0, 1.0, 1.0], Grashof::TripleRocker),
            ([1.0, -1.0, 1.0], Grashof::TripleRocker),
            ([1.0, 1.0, -1.0], Grashof::TripleRocker),
            ([1.0, 0.0, -1.0], Grashof::ChangePoint),
        ];
        assert!(all.iter().all(|(signs, class)| grashof(*signs) == *class));
    }

    #[test]
    fn ranges_lie_about_their_centre() {
        let range =
            |near: f64, far: f64| turning(3.0, (near, 0.5, Posture::Folded), (far, 2.0, Posture::Stretched), "B");
        assert_eq!(range(1.0, 0.0), DriverRange::Unlimited);
        let DriverRange::One(one) = range(-1.0, 1.0) else { panic!() };
        assert!((one.from.at - (3.5 - 2.0 * PI)).abs() < 1e-15 && (one.to.at - 2.5).abs() < 1e-15);
        let DriverRange::One(one) = range(1.0, -1.0) else { panic!() };
        assert!((one.from.at - 1.0).abs() < 1e-15 && (one.to.at - 5.0).abs() < 1e-15);
        let DriverRange::Two([first, second]) = range(-1.0, -1.0) else { panic!() };
        assert_eq!((first.from.posture, first.to.posture), (Posture::Stretched, Posture::Folded));
        assert!((first.from.at - 1.0).abs() < 1e-15 && (first.to.at - 2.5).abs() < 1e-15);
        assert!((second.from.at - (3.5 - 2.0 * PI)).abs() < 1e-15 && (second.to.at - (5.0 - 2.0 * PI)).abs() < 1e-15);
        let DriverRange::Two([first, second]) = sliding(1.0, (1.0, 2.0), 5.0, "B") else { panic!() };
        let found = [first.from.at, first.to.at, second.from.at, second.to.at].map(f64::to_bits);
        assert_eq!(found, [-4.0f64, -1.0, 3.0, 6.0].map(f64::to_bits));
        let DriverRange::One(one) = sliding(1.0, (0.0, 0.0), 5.0, "B") else { panic!() };
        assert_eq!([one.from.at, one.to.at].map(f64::to_bits), [-4.0f64, 6.0].map(f64::to_bits));
    }

    #[test]
    fn what_there_may_be() {
        assert!(possible([0.0, -1e-300], 1.0, "A", Posture::Folded).is_none());
        assert_eq!(possible([0.0], 4.0, "A", Posture::Folded).map(|there| there.at), Some(4.0 - 2.0 * PI));
        assert!(stroke([1.0, 0.0], 1.0, 0.0).is_none() && stroke([1.0], 1.0, PI).is_none());
        assert_eq!(stroke([1.0], 2.0, -PI / 2.0).map(|found| [found.extent, found.time_ratio]), Some([2.0, 3.0]));
    }
}
