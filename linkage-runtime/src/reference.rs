//! The general solution, against which generated results are held: all equilibrium equations of the free bodies at once, by nalgebra.
//!
//! For tests and for a host that wants to see the agreement; not part of the path that emitted code takes otherwise. A linkage emits
//! the table of its equations for a scene with the method `verify`.

extern crate alloc;

use alloc::vec::Vec;
use core::fmt;

use nalgebra::{DMatrix, DVector, RealField};

use crate::Error;

/// How far the ways to a scene's results disagree: the largest difference of forces over the largest force, or of moments over the
/// largest term of the equations in which they stand, whichever is larger.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A lever with a force at its end.
///     mod lever;
///     units { mm, N }
///     ground     { O: (0, 0) }
///     link lever { O -> P: 250mm }
///     revolute O: ground -> lever;
///     drive theta: O;
///     load F: force(lever.P);
///     scene check: verify;
/// }
///
/// let agreement = lever::check_at(0.3, &lever::Loads { F: Vector2::new(2.0, -8.0) })?;
/// assert!(agreement.general < 1e-15 && agreement.virtual_work < 1e-15);
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
///
/// A size of `1e-15` is a matter of roundings; it grows with [`condition`](Self::condition), and where loads nearly balance
/// each other, so that next to nothing is left of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verification<T> {
    /// The sum of all contributions against equilibrium.
    pub superposition: T,
    /// The unknowns by virtual work against those by equilibrium.
    pub virtual_work: T,
    /// The general solution against equilibrium.
    pub general: T,
    /// The 2-norm condition number of the general equations, each line scaled to its largest coefficient.
    pub condition: T,
}

impl<T: fmt::LowerExp> fmt::Display for Verification<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "superposition {:.1e}, virtual work {:.1e}, general solution {:.1e} (condition {:.1e})",
            self.superposition, self.virtual_work, self.general, self.condition
        )
    }
}

/// A square linear system, solved with complete pivoting: for each unknown what its unit exerts on the links, for each equation what the loads exert.
///
/// ```
/// use linkage_runtime::reference::Equations;
///
/// // Two equations: 2x + y + 4 = 0, y − 6 = 0.
/// let equations = Equations::new(&[(0, 0, 2.0), (0, 1, 1.0), (1, 1, 1.0)], &[4.0, -6.0]);
/// assert_eq!(equations.solve(), Some(vec![-5.0, 6.0]));
/// assert!(equations.condition() < 3.0);
/// ```
#[derive(Clone, Debug)]
pub struct Equations<T> {
    matrix: DMatrix<T>,
    right: DVector<T>,
}

impl<T: RealField + Copy> Equations<T> {
    /// From the coefficients that are not structurally zero, each as `(line, column, value)`, and what the loads exert.
    ///
    /// # Panics
    ///
    /// If a line or a column is beyond the number of equations.
    #[must_use]
    pub fn new(coefficients: &[(usize, usize, T)], loads: &[T]) -> Self {
        let n = loads.len();
        let mut matrix = DMatrix::zeros(n, n);
        for (line, column, value) in coefficients {
            matrix[(*line, *column)] = *value;
        }
        let mut right = DVector::from_iterator(n, loads.iter().map(|load| -*load));
        // Forces and moments have different units: each line by its largest coefficient.
        for line in 0..n {
            let size = matrix.row(line).iter().fold(T::zero(), |m, x| m.max(x.abs()));
            if size > T::zero() {
                matrix.row_mut(line).iter_mut().for_each(|x| *x /= size);
                right[line] /= size;
            }
        }
        Self { matrix, right }
    }

    /// The unknowns; `None` if the equations are singular.
    #[must_use]
    pub fn solve(&self) -> Option<Vec<T>> {
        self.matrix.clone().full_piv_lu().solve(&self.right).map(|x| x.iter().copied().collect())
    }

    /// The 2-norm condition number; infinite if singular.
    #[must_use]
    pub fn condition(&self) -> T {
        let values = self.matrix.clone().singular_values();
        values.max() / values.min()
    }
}

/// What emitted code has found of one pose under one set of loads.
#[doc(hidden)]
#[derive(Debug)]
pub struct Compared<'a, T> {
    /// The coefficients of the general equations.
    pub coefficients: &'a [(usize, usize, T)],
    /// What the loads exert.
    pub loads: &'a [T],
    /// Which unknowns are moments.
    pub moments: &'a [bool],
    /// The unknowns by equilibrium, in the order of the columns.
    pub equilibrium: &'a [T],
    /// The same by superposition.
    pub superposition: &'a [T],
    /// The efforts by virtual work: the last unknowns.
    pub virtual_work: &'a [T],
}

/// Compares all ways to the results.
///
/// # Errors
///
/// [`Error::DeadCentre`] if the general equations are singular to rounding.
#[doc(hidden)]
pub fn verify<T: RealField + Copy>(compared: &Compared<'_, T>) -> Result<Verification<T>, Error> {
    let Compared { coefficients, loads, moments, equilibrium, superposition, virtual_work } = compared;
    let equations = Equations::new(coefficients, loads);
    let singular = Error::DeadCentre { group: "the linkage", pivot: "determinant of the general equations" };
    let condition = equations.condition();
    // Beyond this the general solution has no digits.
    let regular = condition * T::default_epsilon() < T::one();
    let general = equations.solve().filter(|_| regular).ok_or(singular)?;
    let efforts = equilibrium.len().saturating_sub(virtual_work.len());
    // A moment may be the rest of others that nearly cancel: it is as large as the largest term of an equation in which it stands.
    let terms = largest_terms(coefficients, loads, equilibrium);
    let size_of = |column: usize| {
        let own = coefficients.iter().filter(|(_, own, value)| *own == column && !value.is_zero());
        own.fold(equilibrium[column].abs(), |m, (line, _, value)| m.max((terms[*line] / *value).abs()))
    };
    // The unknowns from `first` on, forces and moments each by their largest.
    let difference = |values: &[T], first: usize| {
        let of = |kind: bool| {
            let all = (0..equilibrium.len()).filter(|column| moments[*column] == kind);
            let size = |column: usize| if kind { size_of(column) } else { equilibrium[column].abs() };
            let size = all.map(size).fold(T::zero(), T::max);
            let pairs =
                equilibrium.iter().zip(*moments).skip(first).zip(values).filter(|((_, moment), _)| **moment == kind);
            let largest = pairs.fold(T::zero(), |m, ((x, _), y)| m.max((*x - *y).abs()));
            if size > T::zero() { largest / size } else { largest }
        };
        of(false).max(of(true))
    };
    Ok(Verification {
        superposition: difference(superposition, 0),
        virtual_work: difference(virtual_work, efforts),
        general: difference(&general, 0),
        condition,
    })
}

/// The largest term of each equation, what the loads exert among them.
fn largest_terms<T: RealField + Copy>(coefficients: &[(usize, usize, T)], loads: &[T], values: &[T]) -> Vec<T> {
    let mut terms: Vec<T> = loads.to_vec();
    for (line, column, coefficient) in coefficients {
        terms[*line] = terms[*line].abs().max((*coefficient * values[*column]).abs());
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::{Compared, Equations, verify};

    const COEFFICIENTS: [(usize, usize, f64); 3] = [(0, 0, 2.0), (1, 0, 1.0), (1, 1, 1e-3)];

    #[test]
    fn solves_what_it_is_given() {
        let solution = Equations::new(&COEFFICIENTS, &[-4.0, -5.0]).solve().unwrap();
        assert!((solution[0] - 2.0).abs() < 1e-12 && (solution[1] - 3000.0).abs() < 1e-9);
        assert!(Equations::new(&[(0, 0, 1.0), (1, 0, 1.0)], &[1.0, 1.0]).solve().is_none());
    }

    /// A force of 2 at an arm of 3, held by a moment of 10⁻⁹ beside a load that takes nearly all of it: rounding is none of the moment.
    #[test]
    fn a_moment_that_is_what_others_leave_counts_by_them() {
        let rest = 1e-9;
        let compared = Compared {
            coefficients: &[(0, 0, 1.0), (1, 0, 3.0), (1, 1, 1.0)],
            loads: &[-2.0, -6.0 - rest],
            moments: &[false, true],
            equilibrium: &[2.0, rest],
            superposition: &[2.0, rest + 1e-15],
            virtual_work: &[rest + 2e-15],
        };
        let found = verify(&compared).unwrap();
        assert!(found.superposition < 1e-15 && found.virtual_work < 1e-15 && found.general < 1e-15, "{found}");
    }

    #[test]
    fn a_wrong_answer_shows() {
        let compared = |equilibrium: &'static [f64]| Compared {
            coefficients: &COEFFICIENTS,
            loads: &[-4.0, -5.0],
            moments: &[false, true],
            equilibrium,
            superposition: &[2.0, 3000.0],
            virtual_work: &[3000.0],
        };
        assert!(verify(&compared(&[2.0, 3000.0])).unwrap().general < 1e-12);
        let wrong = verify(&compared(&[2.0, 3001.0])).unwrap();
        assert!(wrong.general > 1e-4 && wrong.superposition > 1e-4 && wrong.virtual_work > 1e-4);
    }
}
