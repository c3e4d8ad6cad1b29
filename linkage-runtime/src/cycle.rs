//! Statistics of a cycle: what a machine's designer asks of the results of a sweep.
//!
//! A [`Cycle`] is the places of the positions, angles of a crank or times, in one period, and not necessarily at equal distances. All integrals over it
//! are those of the trapezoidal rule with the last interval closed by the first position: for smooth periodic functions at equal
//! distances its error falls faster than any power of their distance (Trefethen and Weideman, *The exponentially convergent trapezoidal
//! rule*, SIAM Review 56, 2014).
//!
//! ```
//! use linkage_runtime::cycle::{Cycle, flywheel_inertia, peak};
//!
//! // A torque of 100 N·m for one half of a turn, −20 N·m for the other, from one to the other in a hundredth of a turn.
//! let turn = core::f64::consts::TAU;
//! let angles = [0.0, 0.49, 0.5, 0.99].map(|part| part * turn);
//! let torques = [100.0, 100.0, -20.0, -20.0];
//! let cycle = Cycle::new(&angles, turn)?;
//! assert!((cycle.mean(&torques)? - 40.0).abs() < 1e-12);
//! assert_eq!(peak(&torques).map(|peak| (peak.index, peak.value)), Some((0, 100.0)));
//!
//! // What is above the mean, 60 N·m, lasts for 0.49 of a turn, and for half as much of the way down and up.
//! let fluctuation = cycle.energy_fluctuation(&torques)?;
//! assert!((fluctuation - 60.0 * (0.49 + 0.005) * turn).abs() < 1e-10);
//! // At 150 rad/s and with a coefficient of fluctuation of 1/50:
//! let inertia = flywheel_inertia(fluctuation, 0.02, 150.0)?;
//! assert!((inertia - fluctuation / 450.0).abs() < 1e-12);
//! # Ok::<(), linkage_runtime::cycle::CycleError>(())
//! ```

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// What is wrong with the numbers of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CycleError {
    /// There is no position.
    Empty,
    /// A slice has not one value for each position.
    Length {
        /// How many values it has.
        found: usize,
        /// How many positions there are.
        expected: usize,
    },
    /// A position is not beyond the one before it, or the last one not within a period of the first.
    Order {
        /// Which one, from 0.
        index: usize,
    },
    /// A value is not a finite number, or a result is too large for one.
    NotFinite,
    /// What must be positive is not.
    NotPositive {
        /// What that is.
        what: &'static str,
    },
}

impl fmt::Display for CycleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a cycle without positions"),
            Self::Length { found, expected } => write!(f, "{found} values for {expected} positions"),
            Self::Order { index } => write!(f, "position {index} is not in the order of one period"),
            Self::NotFinite => f.write_str("a value or a result is not finite"),
            Self::NotPositive { what } => write!(f, "{what} is not positive"),
        }
    }
}

impl core::error::Error for CycleError {}

/// A scalar of results: `f32` or `f64`.
pub trait Number:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + sealed::Sealed
{
    /// 0.
    const ZERO: Self;
    /// ½.
    const HALF: Self;
    /// Half a turn.
    const PI: Self;
    /// Its square root.
    #[must_use]
    fn root(self) -> Self;
    /// Whether it is neither infinite nor NaN.
    fn finite(self) -> bool;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

macro_rules! number {
    ($scalar:ident) => {
        impl Number for $scalar {
            const ZERO: Self = 0.0;
            const HALF: Self = 0.5;
            const PI: Self = core::$scalar::consts::PI;
            fn root(self) -> Self {
                crate::math::$scalar::sqrt(self)
            }
            fn finite(self) -> bool {
                self.is_finite()
            }
        }
    };
}
number!(f32);
number!(f64);

fn finite<T: Number>(value: T) -> Result<T, CycleError> {
    if value.finite() { Ok(value) } else { Err(CycleError::NotFinite) }
}

fn magnitude<T: Number>(value: T) -> T {
    if value < T::ZERO { -value } else { value }
}

/// A value of a cycle, and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak<T> {
    /// The position, from 0.
    pub index: usize,
    /// The value, with its sign.
    pub value: T,
}

/// The first of the values than which no other is better.
fn best<T: Number>(values: &[T], better: impl Fn(T, T) -> bool) -> Option<Peak<T>> {
    if values.iter().any(|value| !value.finite()) {
        return None;
    }
    let all = values.iter().enumerate().map(|(index, value)| Peak { index, value: *value });
    all.reduce(|best, other| if better(other.value, best.value) { other } else { best })
}

/// The value of the largest magnitude, the first of several. `None` of no values, or if one is not finite.
#[must_use]
pub fn peak<T: Number>(values: &[T]) -> Option<Peak<T>> {
    best(values, |other, best| magnitude(other) > magnitude(best))
}

/// The largest value, the first of several. `None` of no values, or if one is not finite.
#[must_use]
pub fn maximum<T: Number>(values: &[T]) -> Option<Peak<T>> {
    best(values, |other, best| other > best)
}

/// The smallest value, the first of several. `None` of no values, or if one is not finite.
#[must_use]
pub fn minimum<T: Number>(values: &[T]) -> Option<Peak<T>> {
    best(values, |other, best| other < best)
}

/// The positions of a cycle, in ascending order within one period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle<'a, T> {
    at: &'a [T],
    period: T,
}

impl<'a, T: Number> Cycle<'a, T> {
    /// Of positions and the period after which the first one comes again: of an engine of four strokes, 4π.
    ///
    /// # Errors
    ///
    /// [`CycleError::Empty`], [`CycleError::Order`], [`CycleError::NotPositive`] of the period, [`CycleError::NotFinite`].
    pub fn new(at: &'a [T], period: T) -> Result<Self, CycleError> {
        let first = *at.first().ok_or(CycleError::Empty)?;
        if !finite(period)?.gt(&T::ZERO) {
            return Err(CycleError::NotPositive { what: "the period" });
        }
        let mut before = finite(first)?;
        for (index, place) in at.iter().enumerate().skip(1) {
            if finite(*place)? <= before || *place - first >= period {
                return Err(CycleError::Order { index });
            }
            before = *place;
        }
        Ok(Self { at, period })
    }

    /// The intervals: their lengths, and the values at both ends.
    fn intervals(self, values: &'a [T]) -> Result<impl Iterator<Item = (T, T, T)> + 'a, CycleError> {
        if values.len() != self.at.len() {
            return Err(CycleError::Length { found: values.len(), expected: self.at.len() });
        }
        let closed = self.at.first().map(|first| *first + self.period);
        let ends = self.at.iter().copied().skip(1).chain(closed);
        let after = values.iter().skip(1).chain(values.first());
        let both = values.iter().zip(after).zip(self.at.iter().zip(ends));
        Ok(both.map(|((value, after), (start, end))| (end - *start, *value, *after)))
    }

    /// `∫ f` over the period: `Σ h (f + f′)/2` over the intervals h between f and f′. The work of a torque, if the places are angles on
    /// which it works; of a power, if they are times.
    ///
    /// # Errors
    ///
    /// [`CycleError::Length`], [`CycleError::NotFinite`].
    pub fn integral(self, values: &'a [T]) -> Result<T, CycleError> {
        let half_sum = |value: T, after: T| T::HALF * value + T::HALF * after;
        finite(self.intervals(values)?.fold(T::ZERO, |sum, (h, value, after)| sum + h * half_sum(value, after)))
    }

    /// The mean: `∫ f` over the period, divided by the period.
    ///
    /// # Errors
    ///
    /// As [`integral`](Self::integral).
    pub fn mean(self, values: &'a [T]) -> Result<T, CycleError> {
        finite(self.integral(values)? / self.period)
    }

    /// The root of the mean of the squares, which are taken at the positions.
    ///
    /// # Errors
    ///
    /// As [`integral`](Self::integral).
    pub fn rms(self, values: &'a [T]) -> Result<T, CycleError> {
        // By the largest value: squares would leave the range of numbers before the result does.
        let largest = peak(values).map_or(T::ZERO, |peak| magnitude(peak.value));
        if values.iter().any(|value| !value.finite()) {
            return Err(CycleError::NotFinite);
        }
        let intervals = self.intervals(values)?;
        if largest <= T::ZERO {
            return Ok(T::ZERO);
        }
        let square = |value: T| (value / largest) * (value / largest);
        let sum =
            intervals.fold(T::ZERO, |sum, (h, value, after)| sum + h * (T::HALF * (square(value) + square(after))));
        finite(largest * (sum / self.period).root())
    }

    /// The work of an effort whose coordinate changes at a rate: `∫ F q̇` over the period, where the places are times. Divided by the
    /// period it is the mean power.
    ///
    /// # Errors
    ///
    /// As [`integral`](Self::integral).
    pub fn work(self, efforts: &'a [T], rates: &'a [T]) -> Result<T, CycleError> {
        let both = self.intervals(efforts)?.zip(self.intervals(rates)?);
        let power = |((h, effort, effort_after), (_, rate, rate_after)): ((T, T, T), (T, T, T))| {
            h * (T::HALF * (effort * rate + effort_after * rate_after))
        };
        finite(both.fold(T::ZERO, |sum, interval| sum + power(interval)))
    }

    /// The fluctuation of energy `ΔE = max E − min E` of `E(θ) = ∫ (T − T̄) dθ`, where the places are the angles on which the torque
    /// works, and T̄ is its mean, with which what drives and what is driven cancel over the cycle.
    ///
    /// Between two positions the torque is taken as linear, so that E has its extremes where T crosses its mean, which is mostly between
    /// positions. Source: R. L. Norton, *Design of Machinery*, "Energy method of flywheel sizing".
    ///
    /// # Errors
    ///
    /// As [`integral`](Self::integral).
    pub fn energy_fluctuation(self, torques: &'a [T]) -> Result<T, CycleError> {
        let mean = self.mean(torques)?;
        let (mut energy, mut most, mut least) = (T::ZERO, T::ZERO, T::ZERO);
        let mut see = |energy: T| {
            if energy > most {
                most = energy;
            }
            if energy < least {
                least = energy;
            }
            finite(energy)
        };
        for (h, torque, after) in self.intervals(torques)? {
            // By halves: the whole of what two torques differ by may be beyond the range of numbers.
            let [surplus, next] = [torque, after].map(|torque| T::HALF * torque - T::HALF * mean);
            if (surplus > T::ZERO && next < T::ZERO) || (surplus < T::ZERO && next > T::ZERO) {
                // To the crossing: a triangle of the height of the surplus.
                see(energy + h * surplus * (surplus / (surplus - next)))?;
            }
            energy = see(energy + h * (surplus + next))?;
        }
        finite(most - least)
    }
}

/// Angles that follow each other along a motion, each in (−π, π], as one that counts its turns: each lies within half a turn of the one
/// before. So the angle of a link, or of a drive that an inverse scene finds, becomes continuous, if between two positions no link turns by
/// half a turn or more. The first one stays as it is.
///
/// ```
/// use linkage_runtime::cycle::unwrap;
///
/// let mut angles = [2.0, 3.0, -2.3, -1.3, 3.0];
/// unwrap(&mut angles)?;
/// let turn = core::f64::consts::TAU;
/// assert_eq!(angles, [2.0, 3.0, turn - 2.3, turn - 1.3, 3.0]);
/// # Ok::<(), linkage_runtime::cycle::CycleError>(())
/// ```
///
/// # Errors
///
/// [`CycleError::NotFinite`]: then all angles stay as they are.
pub fn unwrap<T: Number>(angles: &mut [T]) -> Result<(), CycleError> {
    if angles.iter().any(|angle| !angle.finite()) {
        return Err(CycleError::NotFinite);
    }
    let (mut turns, mut before) = (T::ZERO, None);
    for angle in angles {
        let wrapped = *angle;
        let step = before.map_or(T::ZERO, |before| wrapped - before);
        if step > T::PI {
            turns = turns - (T::HALF + T::HALF);
        } else if step < -T::PI {
            turns = turns + (T::HALF + T::HALF);
        }
        // Not added up from position to position: that would add up roundings too.
        *angle = wrapped + turns * (T::PI + T::PI);
        before = Some(wrapped);
    }
    Ok(())
}

/// The work of an effort around a closed path of its coordinate: `Σ (F + F′)/2 (q′ − q)` from each position to the next one, and from the
/// last to the first: the area in the diagram of force over stroke.
///
/// # Errors
///
/// [`CycleError::Length`], [`CycleError::NotFinite`].
pub fn work_around<T: Number>(efforts: &[T], coordinates: &[T]) -> Result<T, CycleError> {
    if efforts.len() != coordinates.len() {
        return Err(CycleError::Length { found: efforts.len(), expected: coordinates.len() });
    }
    let after = |values: &[T]| values.first().copied();
    let next_efforts = efforts.iter().copied().skip(1).chain(after(efforts));
    let next_coordinates = coordinates.iter().copied().skip(1).chain(after(coordinates));
    let both = efforts.iter().zip(next_efforts).zip(coordinates.iter().zip(next_coordinates));
    let part = |((effort, next), (at, to)): ((&T, T), (&T, T))| T::HALF * (*effort + next) * (to - *at);
    finite(both.fold(T::ZERO, |sum, interval| sum + part(interval)))
}

/// The coefficient of speed fluctuation `C_s = (ω_max − ω_min)/ω_mean` with `ω_mean = (ω_max + ω_min)/2` (R. L. Norton, *Design of
/// Machinery*).
///
/// # Errors
///
/// [`CycleError::Empty`], [`CycleError::NotFinite`], [`CycleError::NotPositive`] if the mean speed is not.
pub fn speed_fluctuation<T: Number>(speeds: &[T]) -> Result<T, CycleError> {
    if speeds.is_empty() {
        return Err(CycleError::Empty);
    }
    let (Some(most), Some(least)) = (maximum(speeds), minimum(speeds)) else { return Err(CycleError::NotFinite) };
    let mean = T::HALF * most.value + T::HALF * least.value;
    if mean <= T::ZERO {
        return Err(CycleError::NotPositive { what: "the mean speed" });
    }
    finite((most.value - least.value) / mean)
}

/// The moment of inertia `I = ΔE/(C_s ω²)` that keeps the speed within the coefficient of fluctuation: all inertia that turns with the
/// crank, of which the flywheel is what is not there already (R. L. Norton, *Design of Machinery*).
///
/// In consistent units: ΔE in N·m and ω in rad/s give kg·m².
///
/// # Errors
///
/// [`CycleError::NotPositive`] if the coefficient or the speed is not, or the fluctuation of energy is less than zero;
/// [`CycleError::NotFinite`].
pub fn flywheel_inertia<T: Number>(energy_fluctuation: T, coefficient: T, mean_speed: T) -> Result<T, CycleError> {
    for (value, what) in [(coefficient, "the coefficient of fluctuation"), (mean_speed, "the mean speed")] {
        if finite(value)? <= T::ZERO {
            return Err(CycleError::NotPositive { what });
        }
    }
    if finite(energy_fluctuation)? < T::ZERO {
        return Err(CycleError::NotPositive { what: "the fluctuation of energy" });
    }
    // One factor after the other: their product may be beyond the range of numbers where the quotient is not.
    finite(energy_fluctuation / mean_speed / coefficient / mean_speed)
}

#[cfg(test)]
mod tests {
    use super::{Cycle, CycleError, flywheel_inertia, maximum, minimum, peak, speed_fluctuation, unwrap, work_around};
    use core::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
    use std::vec::Vec;

    fn turn(count: u32) -> Vec<f64> {
        (0..count).map(|step| TAU * f64::from(step) / f64::from(count)).collect()
    }

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} instead of {expected}");
    }

    #[test]
    fn extremes_with_their_places() {
        let values = [1.0, -5.0, 5.0, 2.0];
        assert_eq!(peak(&values).map(|p| (p.index, p.value)), Some((1, -5.0)));
        assert_eq!(maximum(&values).map(|p| (p.index, p.value)), Some((2, 5.0)));
        assert_eq!(minimum(&values).map(|p| (p.index, p.value)), Some((1, -5.0)));
        assert_eq!((peak::<f64>(&[]), peak(&[1.0, f64::NAN]), maximum(&[f64::INFINITY])), (None, None, None));
    }

    #[test]
    fn means_of_a_sine_are_exact_from_three_positions_on() {
        for count in [3, 4, 7, 36] {
            let angles = turn(count);
            let values: Vec<f64> = angles.iter().map(|angle| 3.0 + 2.0 * angle.sin()).collect();
            let cycle = Cycle::new(&angles, TAU).expect("a cycle");
            close(cycle.mean(&values).expect("finite"), 3.0);
            close(cycle.rms(&values).expect("finite"), (9.0f64 + 2.0).sqrt());
            close(cycle.integral(&values).expect("finite"), 3.0 * TAU);
        }
        let angles = turn(4);
        let cycle = Cycle::new(&angles, TAU).expect("a cycle");
        close(cycle.rms(&[1e200, 0.0, -1e200, 0.0]).expect("finite") / 1e200, FRAC_1_SQRT_2);
        assert_eq!(cycle.rms(&[0.0; 4]), Ok(0.0));
    }

    #[test]
    fn uneven_positions_weigh_by_their_intervals() {
        // From 0 to 1 up to 4, down to 0 at 3, and level to 5: an area of 2 + 4.
        let cycle = Cycle::new(&[0.0, 1.0, 3.0], 5.0).expect("a cycle");
        close(cycle.integral(&[0.0, 4.0, 0.0]).expect("finite"), 6.0);
        close(cycle.mean(&[0.0, 4.0, 0.0]).expect("finite"), 1.2);
    }

    #[test]
    fn work_over_time_and_around_a_stroke() {
        // F = cos t and v = cos t: half of the period. Around a rectangle, its area.
        let times = turn(12);
        let values: Vec<f64> = times.iter().map(|t| t.cos()).collect();
        let cycle = Cycle::new(&times, TAU).expect("a cycle");
        close(cycle.work(&values, &values).expect("finite"), PI);
        let at = [0.0, 2.0, 2.0, 0.0];
        close(work_around(&[3.0, 3.0, 1.0, 1.0], &at).expect("finite"), 4.0);
        assert_eq!(work_around(&[1.0], &at), Err(CycleError::Length { found: 1, expected: 4 }));
    }

    #[test]
    fn fluctuation_of_a_sine_and_its_flywheel() {
        // T = 10 + 6 sin 2θ: between two crossings, ΔE = 6 ∫ sin 2θ over a quarter turn = 6.
        let angles = turn(3600);
        let torques: Vec<f64> = angles.iter().map(|angle| 10.0 + 6.0 * (2.0 * angle).sin()).collect();
        let found = Cycle::new(&angles, TAU).and_then(|cycle| cycle.energy_fluctuation(&torques)).expect("finite");
        // The rule's error: h²/12 of the second derivative's integral.
        assert!((found - 6.0).abs() < 1e-5, "{found}");
        close(flywheel_inertia(6.0, 0.05, 20.0).expect("positive"), 0.3);
        close(flywheel_inertia(1e300, 1.0, 1e200).expect("finite") * 1e100, 1.0);
        close(flywheel_inertia(1e-300, 1e-200, 1e-100).expect("finite") / 1e100, 1.0);
        // The cycle may begin anywhere.
        let moved: Vec<f64> = angles.iter().map(|angle| 10.0 + 6.0 * (2.0 * angle + 1.0).sin()).collect();
        let again = Cycle::new(&angles, TAU).and_then(|cycle| cycle.energy_fluctuation(&moved)).expect("finite");
        assert!((again - 6.0).abs() < 1e-5, "{again}");
    }

    #[test]
    fn crossings_between_positions_count() {
        // A triangle between −1 and 1: from crossing to crossing half a period of 4, its area is 1.
        let cycle = Cycle::new(&[0.0, 2.0], 4.0).expect("a cycle");
        close(cycle.energy_fluctuation(&[-1.0, 1.0]).expect("finite"), 1.0);
        assert_eq!(cycle.energy_fluctuation(&[7.0, 7.0]), Ok(0.0));
    }

    /// A number beyond the range within the sum may not pass for one that there is.
    #[test]
    fn what_is_nearly_out_of_range_is_found_or_refused() {
        let cycle = Cycle::new(&[0.0, 1.0], 2.0).expect("a cycle");
        close(cycle.energy_fluctuation(&[1e308, -1e308]).expect("finite") / 1e308, 0.5);
        assert_eq!(cycle.mean(&[1e308, 1.5e308]), Err(CycleError::NotFinite));
        let long = Cycle::new(&[0.0, 10.0], 20.0).expect("a cycle");
        assert_eq!(long.energy_fluctuation(&[1e308, -1e308]), Err(CycleError::NotFinite));
    }

    #[test]
    fn coefficient_of_speeds() {
        close(speed_fluctuation(&[98.0, 102.0, 101.0]).expect("positive"), 0.04);
        assert_eq!(speed_fluctuation(&[-1.0, 1.0]), Err(CycleError::NotPositive { what: "the mean speed" }));
        assert_eq!(speed_fluctuation::<f64>(&[]), Err(CycleError::Empty));
    }

    #[test]
    fn angles_count_their_turns_both_ways() {
        let steps: Vec<f64> = (0..200).map(|step| 0.37 * f64::from(step)).collect();
        let motion: Vec<f64> = steps.iter().map(|t| 1.0 + 20.0 * (0.13 * t).sin()).collect();
        let mut angles: Vec<f64> = motion.iter().map(|angle| angle.sin().atan2(angle.cos())).collect();
        assert_eq!(unwrap(&mut angles), Ok(()));
        for (found, expected) in angles.iter().zip(&motion) {
            close(*found, *expected);
        }
        let mut single = [3.0f32, -3.0, 3.0];
        assert_eq!(unwrap(&mut single), Ok(()));
        assert!((single[1] - 3.283_185_4).abs() < 1e-6 && (single[2] - 3.0).abs() < 1e-6, "{single:?}");
        let mut broken = [1.0, f64::NAN];
        assert_eq!((unwrap(&mut broken), broken[0]), (Err(CycleError::NotFinite), 1.0));
        assert_eq!(unwrap::<f64>(&mut []), Ok(()));
    }

    #[test]
    fn wrong_cycles_are_refused() {
        assert_eq!(Cycle::<f64>::new(&[], 1.0), Err(CycleError::Empty));
        assert_eq!(Cycle::new(&[0.0, 1.0, 1.0], 4.0), Err(CycleError::Order { index: 2 }));
        assert_eq!(Cycle::new(&[0.0, 4.0], 4.0), Err(CycleError::Order { index: 1 }));
        assert_eq!(Cycle::new(&[0.0], 0.0), Err(CycleError::NotPositive { what: "the period" }));
        assert_eq!(Cycle::new(&[0.0, f64::NAN], 4.0), Err(CycleError::NotFinite));
        let cycle = Cycle::new(&[0.0f32, 1.0], 4.0).expect("a cycle");
        assert_eq!(cycle.mean(&[1.0]), Err(CycleError::Length { found: 1, expected: 2 }));
        assert_eq!(cycle.rms(&[1.0, f32::INFINITY]), Err(CycleError::NotFinite));
        assert_eq!(
            flywheel_inertia(-1.0, 0.5, 3.0),
            Err(CycleError::NotPositive { what: "the fluctuation of energy" })
        );
        assert_eq!(
            flywheel_inertia(1.0, 0.0, 3.0),
            Err(CycleError::NotPositive { what: "the coefficient of fluctuation" })
        );
    }
}
