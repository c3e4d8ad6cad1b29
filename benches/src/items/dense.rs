//! The equations of the free bodies as a matrix, solved by nalgebra and by faer.
//!
//! Moments are about the points that the textbook takes: of each link the pin nearest to the driver, or on the ground.

use std::mem::MaybeUninit;

use faer::dyn_stack::MemStack;
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::traits::ComplexField;
use faer::{MatMut, Par, Spec};
use nalgebra::{Const, DMatrix, DimMin, RealField, SMatrix};

/// Numbers that both libraries eliminate with.
pub(crate) trait Real: RealField + ComplexField + Copy {}
impl<T: RealField + ComplexField + Copy> Real for T {}

/// Where a joint is, seen from the point of moments of the first and the second link that it joins; the first may be the
/// ground.
pub(super) struct Pin<T> {
    pub(super) first: Option<(usize, [T; 2])>,
    pub(super) second: (usize, [T; 2]),
}

/// The matrix of a linkage whose joints are pins, with the torque on link 0 as the last unknown.
#[inline]
pub(super) fn matrix<T: Real, const N: usize>(pins: &[Pin<T>]) -> SMatrix<T, N, N> {
    let (mut matrix, one) = (SMatrix::zeros(), nalgebra::one::<T>());
    for (k, Pin { first, second: (link, [x, y]) }) in pins.iter().enumerate() {
        matrix[(3 * link, 2 * k)] = one;
        matrix[(3 * link + 1, 2 * k + 1)] = one;
        matrix[(3 * link + 2, 2 * k)] = -*y;
        matrix[(3 * link + 2, 2 * k + 1)] = *x;
        if let Some((link, [x, y])) = first {
            matrix[(3 * link, 2 * k)] = -one;
            matrix[(3 * link + 1, 2 * k + 1)] = -one;
            matrix[(3 * link + 2, 2 * k)] = *y;
            matrix[(3 * link + 2, 2 * k + 1)] = -*x;
        }
    }
    matrix[(2, N - 1)] = one;
    matrix
}

/// What a force at a place, seen from the point of moments, puts on the right of its link's equations.
#[inline]
pub(super) fn load<T: Real, const N: usize, const M: usize>(
    right: &mut SMatrix<T, N, M>,
    column: usize,
    link: usize,
    [x, y]: [T; 2],
    [fx, fy]: [T; 2],
) {
    right[(3 * link, column)] -= fx;
    right[(3 * link + 1, column)] -= fy;
    right[(3 * link + 2, column)] -= x * fy - y * fx;
}

/// LU with exchange of rows, sizes known at compile time.
#[inline]
pub(crate) fn partial<T: Real, const N: usize, const M: usize>(
    matrix: SMatrix<T, N, N>,
    right: &SMatrix<T, N, M>,
) -> Option<SMatrix<T, N, M>>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    matrix.lu().solve(right)
}

/// LU with exchange of rows and columns, sizes known at compile time.
#[inline]
pub(crate) fn full<T: Real, const N: usize, const M: usize>(
    matrix: SMatrix<T, N, N>,
    right: &SMatrix<T, N, M>,
) -> Option<SMatrix<T, N, M>>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    matrix.full_piv_lu().solve(right)
}

/// LU with exchange of rows, sizes known at run time.
#[inline]
pub(crate) fn dynamic<T: Real, const N: usize, const M: usize>(
    matrix: SMatrix<T, N, N>,
    right: &SMatrix<T, N, M>,
) -> Option<SMatrix<T, N, M>> {
    let matrix = DMatrix::from_column_slice(N, N, matrix.as_slice());
    let right = DMatrix::from_column_slice(N, M, right.as_slice());
    matrix.lu().solve(&right).map(|solution| SMatrix::from_column_slice(solution.as_slice()))
}

/// LU with exchange of rows by faer, in place, on the stack and by one thread: what it offers to those who solve small systems often.
#[inline]
pub(crate) fn faer<T: Real, const N: usize, const M: usize>(
    mut matrix: SMatrix<T, N, N>,
    right: &SMatrix<T, N, M>,
) -> Option<SMatrix<T, N, M>> {
    let mut solution = *right;
    let (mut rows, mut inverse) = ([0_usize; N], [0_usize; N]);
    let mut room = [const { MaybeUninit::<u128>::uninit() }; 256];
    let room = MemStack::new_any(&mut room);
    let mut factors = MatMut::from_column_major_slice_mut(matrix.as_mut_slice(), N, N);
    let (_, exchanged) =
        factor::lu_in_place(factors.as_mut(), &mut rows, &mut inverse, Par::Seq, room, Spec::default());
    // Below the diagonal is one factor, whose own diagonal is not stored; from it on the other.
    let factors = factors.as_ref();
    let unknowns = MatMut::from_column_major_slice_mut(solution.as_mut_slice(), N, M);
    solve::solve_in_place(factors, factors, exchanged, unknowns, Par::Seq, room);
    solution.iter().all(nalgebra::ComplexField::is_finite).then_some(solution)
}

/// The four ways to solve an item's equations as its competitors: `$add` makes one of a name and a function, `$solve` sets the equations up
/// and has them solved by what it is given.
macro_rules! eliminations {
    ($add:expr, $size:literal, $solve:path) => {
        [
            $add(concat!("LU ", $size), |case, out| $solve(case, out, dense::partial)),
            $add(concat!("LU ", $size, ", full pivoting"), |case, out| $solve(case, out, dense::full)),
            $add(concat!("LU ", $size, ", dynamic"), |case, out| $solve(case, out, dense::dynamic)),
            $add(concat!("LU ", $size, ", faer"), |case, out| $solve(case, out, dense::faer)),
        ]
    };
}
pub(super) use eliminations;
