//! Starts that close: for messages that miss one, a pose of this linkage to paste.

use crate::equations::poses::{Pose, Poses, Random};
use crate::graph::{NodeId, NodeValues, Symbol};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId};
use crate::model::{Model, Start};

/// Poses from which one that closes is looked for, first with the links that have a start there, then with all of them anywhere.
const TRIES: u64 = 60;
const NEAR: u64 = 12;
/// Poses that close, of which the best is taken.
const CLOSED: usize = 6;

/// Where a link's frame is, as expressions: its origin, and its angle.
pub(crate) type Frame = [NodeId; 3];

/// Links that are to be placed together, and what is placed before them.
pub(crate) struct Wanted<'a, 'm> {
    pub(crate) model: &'m Model,
    /// The links that need a start.
    pub(crate) group: &'a [LinkId],
    /// Of links that the drives place, by what.
    pub(crate) placed: &'a dyn Fn(LinkId) -> Option<Frame>,
}

impl Wanted<'_, '_> {
    /// `start` items for all drives, and for the links of the group, at a pose in which all joints hold. Drives that have a start keep it.
    pub(crate) fn starts(&self) -> Option<Vec<(Item, String)>> {
        let model = self.model;
        let whole = Poses::of(model)?;
        let declared = |drive: &DriveId| model.drive(*drive).start.map(|(value, _)| (*drive, whole.constant(value)));
        let drives: Vec<DriveId> = (0..model.drives.len()).map(DriveId::new).collect();
        let held: Vec<(DriveId, f64)> = drives.iter().filter_map(declared).collect();
        let whole = whole.driven(held.iter().copied());
        let ahead = |joint: JointId| {
            let ends = model.joint(joint).ends().map(|end| end.link);
            ends.iter().all(|link| self.group.contains(link) || (self.placed)(*link).is_some())
        };
        let own = Poses::of(model)?.only(&ahead);
        let links: Vec<LinkId> = model.moving_links().collect();
        let mut best: Option<(f64, Pose, Vec<f64>)> = None;
        let mut closed = 0;
        for seed in 0..TRIES {
            if seed == NEAR && best.is_some() {
                break;
            }
            let Some(pose) = whole.closed(self.rough(&whole, seed), &links) else { continue };
            // Round coordinates of the drives, and the pose that is there.
            let value = |drive: &DriveId| match held.iter().find(|(own, _)| own == drive) {
                Some((_, value)) => *value,
                None => self.rounded(*drive, whole.coordinate(*drive, &pose), whole.length()),
            };
            let values: Vec<f64> = drives.iter().map(value).collect();
            let Some(pose) = self.at(&own, pose, &values) else { continue };
            // The nearest to what is declared, or else the farthest from a singular one.
            let worth =
                if model.starts.is_empty() { own.firmness(&pose, self.group) } else { -self.distance(&own, &pose) };
            if best.as_ref().is_none_or(|(other, ..)| worth > *other) {
                best = Some((worth, pose, values));
            }
            closed += 1;
            if closed == CLOSED {
                break;
            }
        }
        let (_, pose, values) = best?;
        let drives = drives.into_iter().zip(values).map(|(drive, value)| {
            let name = &model.drive(drive).name;
            let value = if model.drive(drive).turns { degrees(value) } else { self.length(value, whole.length()) };
            (Item::Drive(drive), format!("start {name}: {value};"))
        });
        let links = self.group.iter().map(|link| {
            let [x, y, angle] = pose.0[link.index()];
            let [x, y] = [x, y].map(|at| self.length(at, whole.length()));
            let name = &model.link(*link).name;
            (Item::Link(*link), format!("start {name}: ({x}, {y}), angle {};", degrees(self.turned(angle))))
        });
        Some(drives.chain(links).collect())
    }

    /// A pose to begin with.
    fn rough(&self, poses: &Poses<'_>, seed: u64) -> Pose {
        let mut pose = poses.anywhere(&mut Random::new(seed));
        if seed < NEAR {
            for start in &self.model.starts {
                pose.0[start.link.index()] = declared(poses, start);
            }
        }
        pose
    }

    /// How far the links that have a start are from there.
    fn distance(&self, poses: &Poses<'_>, pose: &Pose) -> f64 {
        let turn = core::f64::consts::TAU;
        let of = |start: &Start| {
            let ([x, y, angle], at) = (declared(poses, start), pose.0[start.link.index()]);
            let angle = angle - at[2];
            (x - at[0]).hypot(y - at[1]) + poses.length() * (angle - turn * (angle / turn).round()).abs()
        };
        self.model.starts.iter().map(of).sum()
    }

    /// The pose with these coordinates of the drives, near to that which was found.
    fn at(&self, own: &Poses<'_>, mut pose: Pose, values: &[f64]) -> Option<Pose> {
        let known = |symbol: Symbol| match symbol {
            Symbol::Drive(drive) => values.get(drive.index()).copied().unwrap_or(f64::NAN),
            Symbol::Side(_) => 1.0,
            _ => own.parameter(symbol),
        };
        let mut done = NodeValues::default();
        for link in self.model.moving_links() {
            if let Some(frame) = (self.placed)(link) {
                pose.0[link.index()] = frame.map(|node| self.model.graph.evaluate(node, &known, &mut done));
            }
        }
        let driven = own.clone().driven((0..values.len()).map(DriveId::new).zip(values.iter().copied()));
        let driven = driven.only(&|joint| {
            self.model.joint(joint).ends().iter().any(|end| end.link != GROUND && self.group.contains(&end.link))
                || (self.placed)(self.model.joint(joint).from.link).is_some()
                    && (self.placed)(self.model.joint(joint).to.link).is_some()
        });
        driven.closed(pose, self.group)
    }

    /// Three digits are enough.
    fn rounded(&self, drive: DriveId, value: f64, length: f64) -> f64 {
        if self.model.drive(drive).turns { degrees_of(value).to_radians() } else { round(value, unit_of(length)) }
    }

    fn length(&self, value: f64, length: f64) -> String {
        format!("{}{}", plain(round(value, unit_of(length))), self.model.units.length.name)
    }

    /// An angle within a turn, but where wheels count their turns.
    fn turned(&self, angle: f64) -> f64 {
        let counts = self.model.has_gears();
        let turn = core::f64::consts::TAU;
        if counts { angle } else { angle - turn * (angle / turn).round() }
    }
}

fn declared(poses: &Poses<'_>, start: &Start) -> [f64; 3] {
    [start.origin.x, start.origin.y, start.angle].map(|node| poses.constant(node))
}

/// What a start is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Item {
    Drive(DriveId),
    Link(LinkId),
}

fn degrees_of(angle: f64) -> f64 {
    round(angle.to_degrees(), 0.1)
}

fn degrees(angle: f64) -> String {
    format!("{}deg", plain(degrees_of(angle)))
}

/// The place of the third digit.
fn unit_of(length: f64) -> f64 {
    let mut unit = 1.0;
    while unit > 0.004 * length && unit > 1e-30 {
        unit /= 10.0;
    }
    while unit * 10.0 <= 0.004 * length && unit < 1e30 {
        unit *= 10.0;
    }
    unit
}

fn round(value: f64, unit: f64) -> f64 {
    // A tenth is no double, its inverse is.
    let rounded = if unit < 1.0 {
        (value * (1.0 / unit).round()).round() / (1.0 / unit).round()
    } else {
        (value / unit).round() * unit
    };
    if rounded == 0.0 { 0.0 } else { rounded }
}

/// A number as it is written in a declaration.
fn plain(value: f64) -> String {
    format!("{value}")
}
