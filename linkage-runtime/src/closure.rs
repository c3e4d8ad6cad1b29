//! Sides on which a group may be assembled, where that is an argument.

/// On which side of the line from one outer joint of a dyad to the other its inner joint lies.
///
/// ```
/// use linkage_runtime::{Error, Side, linkage};
///
/// linkage! {
///     /// A leg that may be assembled with its knee on either side.
///     mod leg;
///     units { mm, N }
///     ground     { O: (0, 0), Q: (60mm, 0) }
///     link crank { O -> A: 30mm }
///     link thigh { A -> B: 70mm }
///     link shank { Q -> B: 50mm }
///     revolute O: ground -> crank;
///     revolute A: crank -> thigh;
///     revolute B: thigh -> shank;
///     revolute Q: ground -> shank;
///     drive theta: O;
///     assemble B: either(A -> Q);
///     scene knee: position -> (B);
/// }
///
/// let above = leg::knee_at(0.5, leg::Closures { B: Side::Left })?.B;
/// let below = leg::knee_at(0.5, leg::Closures { B: Side::Right })?.B;
/// assert!(above.y > 0.0 && below.y < 0.0);
/// // The side belongs to the pose; no motion changes it.
/// let pose = leg::Pose::at(0.5, leg::Closures { B: Side::Left.other() })?;
/// assert!((pose.knee()?.B - below).norm() < 1e-12);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i8)]
pub enum Side {
    /// On the left of it.
    Left = 1,
    /// On the right of it.
    Right = -1,
}

impl Side {
    /// 1 on the left, −1 on the right.
    #[inline]
    #[must_use]
    pub const fn sign(self) -> i8 {
        self as i8
    }

    /// The other side.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// Where along a slide or a slot the inner joint of a group lies, seen from its outer pin.
///
/// ```
/// use linkage_runtime::{Along, Error, linkage};
///
/// linkage! {
///     mod engine;
///     units { mm, N }
///     ground      { O: (0, 0) }
///     link crank  { O -> A: 30mm }
///     link rod    { A -> B: 70mm }
///     link piston { B }
///     revolute O: ground -> crank;
///     revolute A: crank -> rod;
///     revolute B: rod -> piston;
///     prismatic S: ground.O -> piston.B along 0deg;
///     drive theta: O;
///     assemble B: either(A);
///     scene places: position -> (B);
/// }
///
/// assert_eq!(engine::places_at(0.0, engine::Closures { B: Along::Ahead })?.B.x, 100.0);
/// assert_eq!(engine::places_at(0.0, engine::Closures { B: Along::Behind })?.B.x, -40.0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i8)]
pub enum Along {
    /// Further along it.
    Ahead = 1,
    /// Less far along it.
    Behind = -1,
}

impl Along {
    /// 1 ahead, −1 behind.
    #[inline]
    #[must_use]
    pub const fn sign(self) -> i8 {
        self as i8
    }

    /// The other one.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Ahead => Self::Behind,
            Self::Behind => Self::Ahead,
        }
    }
}
