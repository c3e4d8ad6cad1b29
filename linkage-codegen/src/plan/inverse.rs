//! The inverse question: what the drives were, in a linkage that is driven where its motion is wanted.
//!
//! The links are placed, and follow, by the groups of that linkage. A pose that they reach is one of the declaration only if its own groups
//! close there on the sides that are chosen for them: that is checked.

use super::output::{Field, Meaning, Output};
use super::posed::Posed;
use super::{Assembly, Motion, joint_name};
use crate::graph::{Expr, Failure, Order};
use crate::model::ids::{GROUND, JointId};
use crate::model::inverses::Side;
use crate::model::units::Kind;
use crate::model::{Coordinate, Drive, Model, Scene, Wanted};

/// How far on the wrong side a joint may lie, in epsilons of what its place is made of: at a fold, both sides are one.
const ROUNDING: i64 = 16;

/// The motion of what were the drives.
pub(super) fn drivers(assembly: &Assembly<'_>, posed: Posed<'_, '_>, scene: &Scene) -> Output {
    let model = assembly.model();
    let Some(exchanged) = &model.exchanged else { return Output::Record(Vec::new()) };
    model.graph.begin_section("Sides");
    let sides = exchanged.closures.iter().filter(|side| !(assembly.uses(side.closure) && exchanged.own.contains(side)));
    let margins: Vec<(JointId, [Expr<'_>; 2])> =
        sides.filter_map(|side| Some((model.closure(side.closure).joint, margin(assembly, side)?))).collect();
    model.graph.begin_section("Drives");
    let fields = scene.results.iter().filter_map(|wanted| {
        let Wanted::Driver(drive, order) = *wanted else { return None };
        let (name, coordinate) = exchanged.drives.get(drive.index())?;
        let value = match order {
            None => place(assembly, *coordinate),
            Some(Order::Rate) => change(posed.velocities?, *coordinate),
            Some(Order::Acceleration) => change(posed.accelerations?, *coordinate),
        };
        let checked = margins.iter().fold(value, |value, (joint, [margin, limit])| {
            let failure = Failure::OtherSide { joint: joint_name(model, *joint).to_owned() };
            value.require_at_least(*margin, *limit, failure)
        });
        let doc = driver_doc(model, name, *coordinate, order);
        let value = Output::scalar(checked, meaning(order, coordinate.turns));
        Some(Field { name: Model::driver_name(name, order), doc, value })
    });
    Output::Record(fields.collect())
}

/// A coordinate of a joint.
fn place<'m>(assembly: &Assembly<'m>, Coordinate { joint, turns }: Coordinate) -> Expr<'m> {
    let (model, placement) = (assembly.model(), &assembly.placement);
    if let Some(drive) = model.drive_of(joint, turns) {
        return assembly.coordinate(drive);
    }
    if !turns {
        return placement.travel(joint);
    }
    let [from, to] = model.joint(joint).ends().map(|end| end.link);
    if from == GROUND {
        return placement.angle(to);
    }
    let relative = placement.frame(to).resolved_along(placement.frame(from));
    placement.graph().atan2(relative.y, relative.x)
}

/// How fast a coordinate changes; of accelerations the same with one dot more.
fn change<'m>(motion: &Motion<'m, '_>, Coordinate { joint, turns }: Coordinate) -> Expr<'m> {
    let [from, to] = motion.model().joint(joint).ends().map(|end| end.link);
    if turns { motion.rate(to) - motion.rate(from) } else { motion.sliding(joint, to) }
}

/// How far a joint lies on the side that is chosen for it, and the least that it must: nothing but rounding.
fn margin<'m>(assembly: &Assembly<'m>, side: &Side) -> Option<[Expr<'m>; 2]> {
    let (model, placement) = (assembly.model(), &assembly.placement);
    let closure = model.closure(side.closure);
    let name = joint_name(model, closure.joint);
    let way = |from: JointId, to: JointId| placement.way(model.joint(from).place(), model.joint(to).place());
    let (far, size, plus, how) = match (side.along, closure.of.as_slice()) {
        (None, [from, to]) => {
            let (line, own) = (way(*from, *to), way(*from, closure.joint));
            let how = format!(
                "{name} to the left of the line from {} to {}, times its length",
                joint_name(model, *from),
                joint_name(model, *to)
            );
            (line.vector().cross(own.vector()), line.length() * own.length(), crate::model::Side::Left, how)
        }
        (Some([slide, ahead]), [named]) => {
            let way = way(*named, ahead);
            let how =
                format!("{name} ahead of {} along the slide {}", joint_name(model, *named), joint_name(model, slide));
            (placement.slide_direction(slide).dot(way.vector()), way.length(), crate::model::Side::Ahead, how)
        }
        _ => return None,
    };
    let sign = assembly.sign(closure, plus);
    let how = if sign.text().is_empty() { how } else { format!("{}({how})", sign.text()) };
    let margin = sign.of(far).named(format!("side_of_{name}"), how);
    Some([margin, -(placement.graph().epsilons(ROUNDING) * size)])
}

fn meaning(order: Option<Order>, turns: bool) -> Meaning {
    match (order, turns) {
        (None, _) => Meaning::Coordinate,
        (Some(Order::Rate), true) => Meaning::AngularRate,
        (Some(Order::Rate), false) => Meaning::Velocity,
        (Some(Order::Acceleration), true) => Meaning::AngularAcceleration,
        (Some(Order::Acceleration), false) => Meaning::Acceleration,
    }
}

fn driver_doc(model: &Model, name: &str, Coordinate { turns, .. }: Coordinate, order: Option<Order>) -> String {
    match order {
        None if turns => format!("The drive `{name}`, rad, in (−π, π]."),
        None => format!("The drive `{name}`, {}.", Kind::Length.unit(&model.units)),
        Some(order) => {
            let what = match order {
                Order::Rate => "Rate",
                Order::Acceleration => "Acceleration",
            };
            format!("{what} of the drive `{name}`, {}.", Drive::kind_of(order, turns).unit(&model.units))
        }
    }
}
