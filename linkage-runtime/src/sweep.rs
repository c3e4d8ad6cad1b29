//! Sweeps over many positions: what is given at each of them, and what may go wrong.

use core::fmt;
use core::ops::Range;

use crate::Error;

/// A value at every position of a sweep: the same one everywhere, or one for each.
///
/// ```
/// use linkage_runtime::Series;
///
/// let angles = [0.0, 0.1, 0.2];
/// assert_eq!(Series::from(&angles[..]), Series::Each(&[0.0, 0.1, 0.2]));
/// assert_eq!(Series::from(314.0), Series::Constant(314.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Series<'a, T> {
    /// The same everywhere.
    Constant(T),
    /// One for each position.
    Each(&'a [T]),
}

impl<T: Copy + Default> Series<'_, T> {
    /// Whether it has a value at every position.
    ///
    /// # Errors
    ///
    /// [`SweepError::Length`] if it has values of another number.
    #[inline]
    pub fn check(&self, what: &'static str, count: usize) -> Result<(), SweepError> {
        match self {
            Self::Constant(_) => Ok(()),
            Self::Each(values) => same_length(what, values.len(), count),
        }
    }

    /// The value at a position. Beyond the last one, which [`check`](Self::check) excludes, the default of its type.
    #[inline]
    #[must_use]
    pub fn at(&self, index: usize) -> T {
        match self {
            Self::Constant(value) => *value,
            Self::Each(values) => match values.get(index) {
                Some(value) => *value,
                None => T::default(),
            },
        }
    }
}

impl<T> From<T> for Series<'_, T> {
    fn from(value: T) -> Self {
        Self::Constant(value)
    }
}

impl<'a, T> From<&'a [T]> for Series<'a, T> {
    fn from(values: &'a [T]) -> Self {
        Self::Each(values)
    }
}

/// Why a sweep has not all its results.
///
/// ```
/// use linkage_runtime::{Error, Series, SweepError, linkage};
///
/// linkage! {
///     /// A pump rod on a crank that is too long for it at some angles.
///     mod pump;
///     units { mm, N }
///     ground       { O: (0, 0), Q: (0, 60mm) }
///     link crank   { O -> A: 100mm }
///     link rod     { A -> B: 120mm }
///     link plunger { B }
///     revolute O: ground -> crank;
///     revolute A: crank -> rod;
///     revolute B: rod -> plunger;
///     prismatic S: ground.Q -> plunger.B along 0deg;
///     drive theta: O;
///     assemble B: ahead(A);
///     scene place: position -> (B);
///     scene stroke: sweep(place);
/// }
///
/// let (mut x, mut y) = ([0.0; 3], [0.0; 3]);
/// let inputs = pump::StrokeInputs { theta: Series::Each(&[0.5, 0.0, -1.5]) };
/// let error = pump::stroke(&inputs, pump::Stroke { B_x: &mut x, B_y: &mut y }).unwrap_err();
/// assert!(matches!(error, SweepError::Position { index: 2, error: Error::CannotAssemble { joint: "B", .. } }));
/// assert!(x[0] > x[1] - 100.0 && y == [60.0, 60.0, 0.0]);
///
/// let error = pump::stroke(&inputs, pump::Stroke { B_x: &mut x, B_y: &mut y[..2] }).unwrap_err();
/// assert_eq!(error.to_string(), "B_y has 2 values for 3 positions");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SweepError {
    /// A slice has not one value for each position. Nothing was computed.
    Length {
        /// Which one.
        what: &'static str,
        /// How many values it has.
        found: usize,
        /// How many positions there are: as many as the first slice of the results has room for.
        expected: usize,
    },
    /// A position has no answer. Those before it have theirs.
    Position {
        /// Which one, from 0.
        index: usize,
        /// Why.
        error: Error,
    },
}

impl fmt::Display for SweepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { what, found, expected } => write!(f, "{what} has {found} values for {expected} positions"),
            Self::Position { index, error } => write!(f, "position {index}: {error}"),
        }
    }
}

impl core::error::Error for SweepError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Length { .. } => None,
            Self::Position { error, .. } => Some(error),
        }
    }
}

/// Checks the length of a slice.
#[inline]
pub fn same_length(what: &'static str, found: usize, expected: usize) -> Result<(), SweepError> {
    if found == expected { Ok(()) } else { Err(SweepError::Length { what, found, expected }) }
}

/// Puts a result into its place. Lengths are checked before: every position has one.
#[inline]
pub fn store<T>(results: &mut [T], index: usize, value: T) {
    if let Some(place) = results.get_mut(index) {
        *place = value;
    }
}

/// Solves so many positions, up to the first without an answer.
#[inline]
pub fn sweep(count: usize, position: impl FnMut(usize) -> Result<(), Error>) -> Result<(), SweepError> {
    one_by_one(0..count, position)
}

/// Solves one position after the other, up to the first without an answer.
///
/// By counting: a range as an iterator, or an addition that is checked, keeps a way to panic in unoptimised builds.
#[inline]
pub(crate) fn one_by_one(
    positions: Range<usize>,
    mut position: impl FnMut(usize) -> Result<(), Error>,
) -> Result<(), SweepError> {
    let mut index = positions.start;
    while index < positions.end {
        if let Err(error) = position(index) {
            return Err(SweepError::Position { index, error });
        }
        index = index.wrapping_add(1);
    }
    Ok(())
}
