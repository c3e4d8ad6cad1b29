//! The distance of two points on links that a driven pin joins, by half of the angle between their arms.
//!
//! With the pin at O, arms `a = |OP|` and `b = |OQ|` and `ψ` the angle from OQ to OP,
//!
//! ```text
//! Q − P = ((b − a) + 2a sin²(ψ/2), −2a sin(ψ/2) cos(ψ/2))   in axes along OQ
//! |PQ|² = (b − a)² + 4ab sin²(ψ/2) = (a + b)² − 4ab cos²(ψ/2)
//! ```
//!
//! so that the distance loses nothing where the arms are nearly in line: there a dyad that hangs on P and Q is near its folds.

use super::assembly::Assembly;
use crate::graph::number::Number;
use crate::graph::{Expr, Vector};
use crate::model::ids::DriveId;
use crate::model::{Drive, End, JointKind, Model};

/// Two arms and the angle between them.
#[derive(Clone, Debug)]
pub(super) struct HalfAngle<'m> {
    /// The drive of the pin.
    pub drive: DriveId,
    /// `|OP|`, to that end.
    pub a: Expr<'m>,
    /// `|OQ|`, to the end on the other link.
    pub b: Expr<'m>,
    /// `(cos ψ/2, sin ψ/2)`.
    pub half: Vector<'m>,
    /// `(cos ψ, sin ψ)`.
    pub whole: Vector<'m>,
    /// The direction of OQ in ground axes.
    pub base: Vector<'m>,
    /// Arm OP in the moved link's own frame, as a direction.
    pub arm: Vector<'m>,
    /// `ψ = sense θ + phase`.
    pub sense: i8,
    /// The constant part of ψ.
    pub phase: Number,
    /// The name of the drive.
    pub name: &'m str,
    /// What a and b are, as text.
    pub lengths: String,
}

impl<'m> HalfAngle<'m> {
    /// The arms from the driven pin between the links of two points to these points, if there is one. The link of `moved` is the one
    /// that the drive places.
    pub(super) fn between(assembly: &Assembly<'m>, moved: End, other: End) -> Option<Self> {
        let model = assembly.model();
        let (index, drive) = pin_between(model, moved, other)?;
        let id = DriveId::new(index);
        let pin = model.joint(drive.joint);
        let (near, far) = (pin.end_on(moved.link)?, pin.end_on(other.link)?);
        let ((op, a), (oq, b)) = (arm(model, near, moved), arm(model, far, other));
        if a.is_zero() || b.is_zero() {
            return None;
        }
        let sense: i8 = if pin.to.link == moved.link { 1 } else { -1 };
        let phase = angle(model, op)?.sub(&angle(model, oq)?);
        let half_of = |n: &Number| n.mul(&Number::ratio(1, 2));
        let coordinate = assembly.graph().constant(&Number::ratio(1, 2)) * assembly.coordinate(id);
        let name = &drive.name;
        let line = |from, to| format!("{} {}", model.point_name(from), model.point_name(to));
        let [first, second] = [line(far, other), line(near, moved)];
        let explained = format!("cos(ψ/2), sin(ψ/2), with ψ the angle from the line {first} to the line {second}");
        let lengths = format!("a = |{second}|, b = |{first}|");
        let half = if sense > 0 {
            coordinate.direction_plus(&half_of(&phase))
        } else {
            coordinate.direction_plus(&half_of(&phase.neg())).conjugate()
        };
        let half = half.named_direction(&format!("half_{name}"), &explained);
        let (c, s) = (half.x, half.y);
        let product = (s * c).named(format!("half_{name}_sin_cos"), "sin(ψ/2) cos(ψ/2)");
        // Fused, the difference of the squares has two roundings, its own and that of one square.
        let cosine =
            if c.graph().is_fused() { c.squared() - sine_squared(half, &name.text) } else { (c - s) * (c + s) };
        let whole = Vector::new(cosine, 2 * product);
        let unit = |v: Vector<'m>, size: Expr<'m>| Vector::new(v.x / size, v.y / size);
        let base = assembly.placement.turned(other.link, unit(oq, b));
        Some(Self { drive: id, a, b, half, whole, base, arm: unit(op, a), sense, phase, name: &name.text, lengths })
    }

    /// `Q − P` in ground axes.
    #[must_use]
    pub(super) fn separation(&self) -> Vector<'m> {
        let Self { a, b, .. } = *self;
        let (c, s) = (self.half.x, self.half.y);
        Vector::new((b - a) + (2 * a) * self.sine_squared(), -((2 * a) * (s * c))).turned_by(self.base)
    }

    /// `sin²(ψ/2)`.
    #[must_use]
    pub(super) fn sine_squared(&self) -> Expr<'m> {
        sine_squared(self.half, self.name)
    }

    /// The direction of OP in ground axes.
    #[must_use]
    pub(super) fn moved_direction(&self) -> Vector<'m> {
        self.whole.turned_by(self.base)
    }

    /// Names `cos ψ, sin ψ`, where the direction of OP has not named them.
    pub(super) fn name_whole(&self) {
        let _ = self.whole.named_direction(&format!("psi_{}", self.name), "cos ψ, sin ψ");
    }

    /// The half angle at a coordinate of the drive: `(cos, sin)`.
    #[must_use]
    pub(super) fn half_at(&self, coordinate: &Number) -> (Number, Number) {
        let signed = if self.sense > 0 { coordinate.clone() } else { coordinate.neg() };
        let (sine, cosine) = signed.add(&self.phase).mul(&Number::ratio(1, 2)).sin_cos();
        (cosine, sine)
    }
}

fn sine_squared<'m>(half: Vector<'m>, drive: &str) -> Expr<'m> {
    half.y.squared().named(format!("half_{drive}_sin2"), "sin²(ψ/2)")
}

/// The driven pin between the links of two points, if there is one.
fn pin_between(model: &Model, moved: End, other: End) -> Option<(usize, &Drive)> {
    model.drives.iter().enumerate().find(|(_, drive)| {
        let joint = model.joint(drive.joint);
        matches!(joint.kind, JointKind::Revolute)
            && joint.end_on(moved.link).is_some()
            && joint.end_off(moved.link).is_some_and(|end| end.link == other.link)
    })
}

/// Where a driven pin joins the links of two points: from which joint to which point an arm's direction is not known, since a parameter gives it.
pub(super) fn arm_without_direction(model: &Model, ends: [End; 2]) -> Option<[&str; 2]> {
    let (_, drive) = pin_between(model, ends[0], ends[1])?;
    let pin = model.joint(drive.joint);
    let is_unknown =
        |end: &End| pin.end_on(end.link).is_some_and(|from| angle(model, arm(model, from, *end).0).is_none());
    let end = ends.into_iter().find(is_unknown)?;
    Some([&pin.name.text, model.point_name(end)])
}

/// The way from one point of a link to another one in the link's frame, and its length.
///
/// Along the link's x axis it is as long as its component there, if that is a parameter that has to be positive for another link.
fn arm(model: &Model, from: End, to: End) -> (Vector<'_>, Expr<'_>) {
    let arm = model.local(to) - model.local(from);
    match model.graph.asked_to_be_positive(arm.x).filter(|_| arm.y.is_zero()) {
        Some(along) => (Vector::new(along, arm.y), along),
        None => (arm, model.distance(to.link, from.point, to.point)),
    }
}

/// The angle of a vector, if it is known: along the x axis it has none, whatever its length.
fn angle(model: &Model, v: Vector<'_>) -> Option<Number> {
    let is_along = v.y.is_zero() && model.graph.is_positive(v.x);
    if is_along { Some(Number::zero()) } else { Some(Number::atan2(&v.y.value()?, &v.x.value()?)) }
}

/// The outer ends of the first three-pin dyad that hangs on both links of a driven pin: the drive's angle is best halved for it.
#[must_use]
pub(super) fn first_dyad_on(
    assembly: &Assembly<'_>,
    drive: DriveId,
    moved: crate::model::ids::LinkId,
) -> Option<(End, End)> {
    let model = assembly.model();
    let pin = model.joint(model.drive(drive).joint);
    let other = pin.end_off(moved)?.link;
    assembly.topology.motion.iter().find_map(|group| {
        let [first, second] = super::rules::pinned_dyad(model, group)?.outer_ends()?;
        if (first.link, second.link) == (moved, other) {
            Some((first, second))
        } else {
            ((first.link, second.link) == (other, moved)).then_some((second, first))
        }
    })
}
