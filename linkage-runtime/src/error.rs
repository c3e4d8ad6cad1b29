//! The error of all linkages.

use core::fmt;

/// Why a function of a linkage has no answer at a pose.
///
/// Groups are named by their links, joints and pivots as in the declaration.
///
/// ```
/// use linkage_runtime::{Error, linkage};
///
/// linkage! {
///     /// Its ground is too long for it to turn all round.
///     mod four_bar;
///     units { mm, N }
///     ground       { A0: (0, 0), B0: (200mm, 0) }
///     link crank   { A0 -> A: 80mm }
///     link coupler { A -> B: 100mm }
///     link rocker  { B0 -> B: 120mm }
///     revolute A0: ground -> crank;
///     revolute A: crank -> coupler;
///     revolute B: coupler -> rocker;
///     revolute B0: ground -> rocker;
///     drive theta: A0;
///     assemble B: left(A -> B0);
///     scene places: position;
/// }
///
/// let error = four_bar::Pose::at(std::f64::consts::PI).unwrap_err();
/// assert_eq!(error.to_string(), "coupler + rocker cannot be assembled: B stays open by 60");
/// assert!(matches!(error, Error::CannotAssemble { joint: "B", .. }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The links of a group cannot be closed at these coordinates of the drives.
    CannotAssemble {
        /// The group, by its links.
        group: &'static str,
        /// The joint that stays open.
        joint: &'static str,
        /// By how much, in the linkage's unit of length; a diagnostic in single precision.
        gap: f32,
    },
    /// The search for the places of a group's links, along the motion from its starting pose or from the pose before, does not arrive:
    /// on its branch the group cannot be closed, some pose between cannot, or the way there is too far.
    NoConvergence {
        /// The group, by its links.
        group: &'static str,
        /// How much stays open where the drives are wanted, in the linkage's unit of length: the sum over all loops; a diagnostic in
        /// single precision. Of a pose that closes, but to which no motion leads, it is what was open when the search for it began.
        gap: f32,
    },
    /// The outer joints of a group coincide, so that the place of its inner joint is undetermined.
    CoincidentPivots {
        /// The group, by its links.
        group: &'static str,
        /// The undetermined joint.
        joint: &'static str,
    },
    /// A group is at a dead centre: of the scene's unknown, no effort, however large, holds its loads; or of the drives, no rate of them
    /// moves it on.
    DeadCentre {
        /// The group, by its links.
        group: &'static str,
        /// What vanishes there, such as `sin_mu_B`.
        pivot: &'static str,
    },
    /// The two points between which a spring or a thrust acts coincide: its force has no direction.
    CoincidentEnds {
        /// The load or the unknown.
        of: &'static str,
    },
    /// A vector vanishes whose direction is asked for, or is no larger than its rounding: of a point that rests, its path; of a centre of
    /// mass without acceleration, the line of its inertia; of a force, what it is held by.
    NoDirection {
        /// The vector.
        of: &'static str,
    },
    /// The wanted coordinates of an inverse scene are reached, with the sides that are chosen for it, only where a group that the drives move
    /// would be assembled on its other side: no coordinates of the drives lead there.
    OtherSide {
        /// The joint at which that group is assembled.
        joint: &'static str,
    },
    /// The mass of an equation of motion is singular: no mass resists some acceleration of the drives, as at the dead centre of a crank
    /// that moves nothing but a slider. The efforts say nothing of that acceleration.
    NoInertia {
        /// The scene.
        scene: &'static str,
    },
    /// A parameter is out of its range.
    Parameter {
        /// What is required.
        requirement: &'static str,
    },
    /// An argument is not a finite number, or a result is too large for one.
    NotFinite {
        /// Which argument; or that it is a result, a load or what is made of the parameters.
        what: &'static str,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CannotAssemble { group, joint, gap } => {
                write!(f, "{group} cannot be assembled: {joint} stays open by {gap}")
            }
            Self::NoConvergence { group, gap } => {
                write!(f, "{group} cannot be closed from where the search starts: {gap} stays open")
            }
            Self::CoincidentPivots { group, joint } => {
                write!(f, "the outer joints of {group} coincide: the place of {joint} is undetermined")
            }
            Self::DeadCentre { group, pivot } => write!(f, "{group} is at a dead centre: {pivot} vanishes"),
            Self::CoincidentEnds { of } => write!(f, "the ends of {of} coincide: it has no direction"),
            Self::NoDirection { of } => write!(f, "{of} vanishes: it has no direction"),
            Self::OtherSide { joint } => write!(f, "only with {joint} on its other side are these coordinates reached"),
            Self::NoInertia { scene } => write!(f, "no mass resists the acceleration: M of {scene} is singular"),
            Self::Parameter { requirement } => f.write_str(requirement),
            Self::NotFinite { what } => write!(f, "{what} is not finite"),
        }
    }
}

impl core::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::Error;
    use std::string::ToString;

    #[test]
    fn says_where_and_why() {
        let error = Error::CannotAssemble { group: "coupler + rocker", joint: "B", gap: 2.5 };
        assert_eq!(error.to_string(), "coupler + rocker cannot be assembled: B stays open by 2.5");
        let error: &dyn core::error::Error = &Error::NotFinite { what: "theta" };
        assert_eq!(error.to_string(), "theta is not finite");
    }
}
