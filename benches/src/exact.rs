//! The reference: positions and the equilibrium of the free bodies in 256 binary digits.
//!
//! Straightforward on purpose, and sharing nothing with what it judges: circles are intersected, all equations of all
//! links are eliminated at once. The four-bar's tests hold it against figures that were found by other means, and `interpreted` against the
//! compiler's own programs.

use std::borrow::Borrow;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig};

/// Binary digits; what a fold or a dead centre takes away leaves more than enough.
const DIGITS: usize = 256;

fn context() -> Context<HalfEven> {
    Context::new(DIGITS)
}

type Float = FBig<HalfEven, 2>;

/// A number of 256 binary digits.
#[derive(Clone, Debug)]
pub(crate) struct Big(Float);

macro_rules! operator {
    ($($operator:ident $method:ident),*) => {$(
        impl<R: Borrow<Big>> $operator<R> for &Big {
            type Output = Big;
            fn $method(self, other: R) -> Big {
                Big(context().$method(self.0.repr(), other.borrow().0.repr()).expect("finite").value())
            }
        }
        impl<R: Borrow<Big>> $operator<R> for Big {
            type Output = Big;
            fn $method(self, other: R) -> Big {
                (&self).$method(other)
            }
        }
    )*};
}
operator!(Add add, Sub sub, Mul mul, Div div);

impl Neg for &Big {
    type Output = Big;
    fn neg(self) -> Big {
        Big(-self.0.clone())
    }
}

impl Big {
    /// A number that is a double.
    pub(crate) fn of(value: f64) -> Self {
        Self(Float::try_from(value).expect("finite").with_precision(DIGITS).value())
    }

    /// p/q.
    pub(crate) fn ratio(p: i32, q: i32) -> Self {
        Self::of(f64::from(p)) / Self::of(f64::from(q))
    }

    /// An angle in degrees, in radians.
    #[cfg(test)]
    pub(crate) fn degrees(value: f64) -> Self {
        Self(context().pi::<2>(None).value()) * Self::of(value) / Self::of(180.0)
    }

    /// (cos, sin).
    pub(crate) fn direction(&self) -> Vector {
        let (sin, cos) = context().sin_cos(self.0.repr(), None);
        [Self(cos.expect("finite").value()), Self(sin.expect("finite").value())]
    }

    /// √.
    pub(crate) fn sqrt(&self) -> Self {
        Self(context().sqrt(self.0.repr()).expect("not negative").value())
    }

    /// Its magnitude.
    pub(crate) fn abs(&self) -> Self {
        if self.0 < Float::ZERO { -self } else { self.clone() }
    }

    /// The larger of two.
    pub(crate) fn larger(self, other: Self) -> Self {
        if other.0 > self.0 { other } else { self }
    }

    /// The double next to it.
    pub(crate) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}

/// A plane vector.
pub(crate) type Vector = [Big; 2];

/// A vector of doubles.
pub(crate) fn vector(x: f64, y: f64) -> Vector {
    [Big::of(x), Big::of(y)]
}

/// a − b.
pub(crate) fn difference([ax, ay]: &Vector, [bx, by]: &Vector) -> Vector {
    [ax - bx, ay - by]
}

/// |a|.
pub(crate) fn size([x, y]: &Vector) -> Big {
    (x * x + y * y).sqrt()
}

/// The point (x, y) of a frame whose x axis goes from `from` to `to`, `length` away.
pub(crate) fn in_frame(from: &Vector, to: &Vector, length: &Big, x: &Big, y: &Big) -> Vector {
    let [dx, dy] = difference(to, from);
    [&from[0] + (&dx * x - &dy * y) / length, &from[1] + (dy * x + dx * y) / length]
}

/// The point `r1` away from `from` and `r2` away from `to`, on the left of the way from one to the other.
pub(crate) fn left(from: &Vector, to: &Vector, r1: &Big, r2: &Big) -> Vector {
    let distance = size(&difference(to, from));
    let along = (&distance * &distance + r1 * r1 - r2 * r2) / (Big::of(2.0) * &distance);
    let across = (r1 * r1 - &along * &along).sqrt();
    in_frame(from, to, &distance, &along, &across)
}

/// A joint, and what its reaction on its second link may be.
pub(crate) struct Joint {
    /// The link that the reaction comes from; `None` is the ground.
    pub(crate) first: Option<usize>,
    /// The link that the reaction acts on.
    pub(crate) second: usize,
    /// Where it acts, ground axes.
    pub(crate) at: Vector,
    /// What the reaction may be.
    pub(crate) kind: Kind,
}

/// The reactions that a joint can have.
pub(crate) enum Kind {
    /// A force in any direction.
    Pin,
    /// A force along y, and a couple.
    SlideAlongX,
}

/// A force on a link at a point.
pub(crate) struct Load {
    /// The link that it acts on.
    pub(crate) link: usize,
    /// Where it acts, ground axes.
    pub(crate) at: Vector,
    /// The force, ground axes.
    pub(crate) force: Vector,
}

/// The solution of the equations of equilibrium.
#[derive(Clone, Debug)]
pub(crate) struct Exact {
    /// On the second link of each joint, in the joints' order.
    pub(crate) forces: Vec<Vector>,
    /// On link 0 by the ground.
    pub(crate) torque: Big,
}

/// The equilibrium of all links: both forces and the moment about the origin of each, eliminated at once.
pub(crate) fn equilibrium(links: usize, joints: &[Joint], loads: &[Load]) -> Exact {
    let n = 3 * links;
    let zero = Big::of(0.0);
    let mut lines = vec![vec![zero.clone(); n + 1]; n];
    // Adds to the equations of a link what a force of unit size, or a load, exerts on it.
    let mut push = |link: usize, column: usize, at: &Vector, force: &Vector| {
        let moment = &at[0] * &force[1] - &at[1] * &force[0];
        for (line, value) in [&force[0], &force[1], &moment].into_iter().enumerate() {
            lines[3 * link + line][column] = &lines[3 * link + line][column] + value;
        }
    };
    for (index, joint) in joints.iter().enumerate() {
        let directions: &[Vector] = match joint.kind {
            Kind::Pin => &[vector(1.0, 0.0), vector(0.0, 1.0)],
            Kind::SlideAlongX => &[vector(0.0, 1.0)],
        };
        for (k, force) in directions.iter().enumerate() {
            push(joint.second, 2 * index + k, &joint.at, force);
            if let Some(first) = joint.first {
                push(first, 2 * index + k, &joint.at, &difference(&vector(0.0, 0.0), force));
            }
        }
    }
    for load in loads {
        push(load.link, n, &load.at, &difference(&vector(0.0, 0.0), &load.force));
    }
    for (index, joint) in joints.iter().enumerate() {
        if matches!(joint.kind, Kind::SlideAlongX) {
            assert!(joint.first.is_none(), "slides are on the ground");
            lines[3 * joint.second + 2][2 * index + 1] = Big::of(1.0);
        }
    }
    lines[2][n - 1] = Big::of(1.0);

    let unknowns = eliminate(lines);
    let forces = joints.iter().zip(unknowns.chunks(2)).map(|(joint, unknowns)| match joint.kind {
        Kind::Pin => [unknowns[0].clone(), unknowns[1].clone()],
        Kind::SlideAlongX => [zero.clone(), unknowns[0].clone()],
    });
    Exact { forces: forces.collect(), torque: unknowns[n - 1].clone() }
}

/// Elimination with the largest pivot of each column; the last entry of a line is its right-hand side.
fn eliminate(mut lines: Vec<Vec<Big>>) -> Vec<Big> {
    let n = lines.len();
    for k in 0..n {
        let best = (k..n).max_by(|&a, &b| lines[a][k].abs().0.partial_cmp(&lines[b][k].abs().0).expect("ordered"));
        lines.swap(k, best.expect("a line"));
        let (done, rest) = lines.split_at_mut(k + 1);
        for line in rest {
            let factor = &line[k] / &done[k][k];
            for column in k..=n {
                line[column] = &line[column] - &factor * &done[k][column];
            }
        }
    }
    let mut unknowns: Vec<Big> = Vec::new();
    for k in (0..n).rev() {
        let known = (k + 1..n).zip(unknowns.iter().rev());
        let right = known.fold(lines[k][n].clone(), |right, (column, x)| right - &lines[k][column] * x);
        unknowns.push(right / &lines[k][k]);
    }
    unknowns.reverse();
    unknowns
}

#[cfg(test)]
mod interpreted;

#[cfg(test)]
mod tests {
    use super::*;

    /// A Hilbert matrix of ten lines takes 13 decimal digits away, and leaves far more than a double has.
    #[test]
    fn elimination_is_exact_to_a_double() {
        let line = |i: i32| {
            let entries: Vec<Big> = (0..10).map(|j| Big::ratio(1, i + j + 1)).collect();
            let right = entries.iter().zip(1..).fold(Big::of(0.0), |sum, (entry, j)| sum + entry * Big::ratio(j, 1));
            entries.into_iter().chain([right]).collect()
        };
        let unknowns = eliminate((0..10).map(line).collect());
        let expected: Vec<f64> = (1..=10).map(f64::from).collect();
        assert_eq!(unknowns.iter().map(Big::to_f64).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn circles_are_intersected_on_the_left() {
        let point = left(&vector(0.0, 0.0), &vector(5.0, 0.0), &Big::of(3.0), &Big::of(4.0));
        let expected = [Big::ratio(9, 5), Big::ratio(12, 5)];
        assert!(size(&difference(&point, &expected)).to_f64() < 1e-70);
    }
}
