//! Generic poses: counting constraints does not tell whether they are independent, so their rank is taken in numbers.
//!
//! The places of the joints and the angles of the links are drawn at random, and the dimensions are those that fit: what is singular
//! then is singular by structure, whatever the declared dimensions are.

use rustc_hash::FxHashMap;

use super::{Group, Input};
use crate::equations::joints::{Shape, Teeth};
use crate::equations::poses::Random;
use crate::equations::{Body, Dimensions, Row, drive_row, joint_rows, unknown_row};
use crate::graph::{Coordinate, Graph, NodeValues, Symbol, Vector};
use crate::model::ids::JointId;
use crate::model::{End, JointKind, Model, UnknownKind};

/// Poses that are tried; one regular pose shows that the structure is regular.
const POSES: u64 = 3;
/// A pivot this much smaller than its row is zero.
const ZERO: f64 = 1e-9;

/// How many constraints a joint has.
pub(super) fn rows_of(model: &Model, joint: JointId) -> usize {
    let graph = Graph::new(model.graph.scalar());
    joint_rows(model, &graph, &Free { model, graph: &graph }, joint).len()
}

/// How many of a group's constraints are independent at generic poses.
pub(super) fn rank_of(model: &Model, group: &Group) -> usize {
    let graph = Graph::new(model.graph.scalar());
    let free = Free { model, graph: &graph };
    let mut rows: Vec<Row> =
        group.outer.iter().chain(&group.inner).flat_map(|joint| joint_rows(model, &graph, &free, *joint)).collect();
    for input in &group.inputs {
        rows.push(match input {
            Input::Unknown(unknown) => unknown_row(model, &graph, &free, *unknown),
            Input::Drive(drive) => drive_row(model, &graph, &free, *drive),
        });
    }
    let full = 3 * group.links.len();
    let mut best = 0;
    for seed in 0..POSES {
        let pose = Pose::random(model, seed);
        let value = |id| graph.evaluate(id, &|symbol| pose.value(symbol), &mut NodeValues::default());
        let matrix: Vec<Vec<f64>> = rows
            .iter()
            .map(|row| {
                let mut line = vec![0.0; full];
                for exerted in &row.exerts {
                    if let Some(column) = group.links.iter().position(|l| *l == exerted.on) {
                        line[3 * column] += value(exerted.x);
                        line[3 * column + 1] += value(exerted.y);
                        line[3 * column + 2] += value(exerted.moment);
                    }
                }
                line
            })
            .collect();
        best = best.max(rank(matrix));
        if best == full {
            break;
        }
    }
    best
}

/// Dimensions that stand for any.
struct Free<'m, 'g> {
    model: &'m Model,
    graph: &'g Graph,
}

/// What a free dimension stands for: a point's coordinate, a line's direction, or the radii of wheels.
fn point_symbol(end: End, axis: u32) -> Symbol {
    Symbol::Dimension((u32::try_from(end.link.index() << 12 | end.point.index() << 1).unwrap_or(0)) | axis)
}

fn slide_symbol(joint: JointId, axis: u32) -> Symbol {
    Symbol::Dimension(1 << 30 | u32::try_from(joint.index() << 1).unwrap_or(0) | axis)
}

impl<'g> Dimensions<'g> for Free<'_, 'g> {
    fn local(&self, end: End) -> Vector<'g> {
        let of = |axis| self.graph.symbol(point_symbol(end, axis));
        Vector::new(of(0), of(1))
    }

    fn shape(&self, joint: JointId) -> Shape<'g> {
        let of = |axis| self.graph.symbol(slide_symbol(joint, axis));
        match self.model.joint(joint).kind {
            JointKind::Revolute => Shape::Revolute,
            JointKind::Prismatic { carrier, .. } => Shape::Prismatic {
                carried_by_first: carrier == self.model.joint(joint).from.link,
                axis: Vector::new(of(0), of(1)),
                angle: self.graph.zero(),
            },
            JointKind::Weld { .. } => Shape::Weld { angle: self.graph.zero() },
            JointKind::Slot { carrier, .. } => Shape::Slot {
                carried_by_first: carrier == self.model.joint(joint).from.link,
                axis: Vector::new(of(0), of(1)),
            },
            JointKind::Gear(gear) => {
                let [first, second] = gear.arm.map(|end| self.local(end));
                let (centres, distance) = (self.graph.unit(second - first), (second - first).size());
                let (phase, arm) = (self.graph.zero(), Body::symbolic(self.graph, gear.arm[0].link));
                Shape::Gear(Teeth { radii: [of(0), of(1)], phase, incline: phase, arm, centres, distance })
            }
        }
    }
}

/// A random pose with the dimensions that fit it.
struct Pose {
    values: FxHashMap<Symbol, f64>,
}

impl Pose {
    fn random(model: &Model, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut values = FxHashMap::default();
        let mut frames: Vec<[f64; 4]> = vec![[0.0, 0.0, 1.0, 0.0]];
        for link in model.moving_links() {
            // A random rotation by its half-angle tangent: no trigonometry.
            let t = random.next();
            let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
            let frame = [random.next(), random.next(), cos, sin];
            for (value, c) in frame.into_iter().zip([Coordinate::X, Coordinate::Y, Coordinate::Cos, Coordinate::Sin]) {
                values.insert(Symbol::Coordinate(link, c), value);
            }
            frames.push(frame);
        }
        let mut pose = Self { values };
        let places = places(model, &mut random);
        for (end, place) in &places {
            let [x, y, cos, sin] = frames[end.link.index()];
            let (dx, dy) = (place[0] - x, place[1] - y);
            pose.values.insert(point_symbol(*end, 0), cos * dx + sin * dy);
            pose.values.insert(point_symbol(*end, 1), cos * dy - sin * dx);
        }
        let at = |end: End| places.iter().find(|(e, _)| *e == end).map_or([0.0, 0.0], |(_, place)| *place);
        for joint in model.joint_ids() {
            if let JointKind::Gear(_) = model.joint(joint).kind {
                for radius in 0..2 {
                    pose.values.insert(slide_symbol(joint, radius), 1.5 + random.next());
                }
            }
            let Some((carrier, _)) = model.joint(joint).kind.line() else { continue };
            let (from, to) = (at(model.joint(joint).from), at(model.joint(joint).to));
            let (mut dx, mut dy) = (to[0] - from[0], to[1] - from[1]);
            if dx == 0.0 && dy == 0.0 {
                (dx, dy) = (random.next(), random.next());
            }
            let size = (dx * dx + dy * dy).sqrt();
            let [.., cos, sin] = frames[carrier.index()];
            pose.values.insert(slide_symbol(joint, 0), (cos * dx + sin * dy) / size);
            pose.values.insert(slide_symbol(joint, 1), (cos * dy - sin * dx) / size);
        }
        pose
    }

    fn value(&self, symbol: Symbol) -> f64 {
        self.values.get(&symbol).copied().unwrap_or(0.0)
    }
}

/// Rank by elimination with complete pivoting, each row scaled to its largest entry.
fn rank(mut matrix: Vec<Vec<f64>>) -> usize {
    for row in &mut matrix {
        let size = row.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        if size > 0.0 {
            row.iter_mut().for_each(|x| *x /= size);
        }
    }
    let columns = matrix.first().map_or(0, Vec::len);
    for step in 0..matrix.len().min(columns) {
        let candidates = (step..matrix.len()).flat_map(|r| (step..columns).map(move |c| (r, c)));
        let Some((row, column)) = candidates.max_by(|a, b| matrix[a.0][a.1].abs().total_cmp(&matrix[b.0][b.1].abs()))
        else {
            return step;
        };
        if matrix[row][column].abs() < ZERO {
            return step;
        }
        matrix.swap(step, row);
        matrix.iter_mut().for_each(|line| line.swap(step, column));
        let pivot = matrix[step].clone();
        for line in &mut matrix[step + 1..] {
            let factor = line[step] / pivot[step];
            line.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
        }
    }
    matrix.len().min(columns)
}

/// A random place for every point that joints or unknowns use; points that a pin joins share theirs.
fn places(model: &Model, random: &mut Random) -> Vec<(End, [f64; 2])> {
    let mut classes: Vec<Vec<End>> = Vec::new();
    let mut join = |ends: &[End]| {
        let (mut together, rest): (Vec<_>, Vec<_>) =
            classes.drain(..).partition(|class: &Vec<End>| ends.iter().any(|e| class.contains(e)));
        let mut class: Vec<End> = together.drain(..).flatten().collect();
        class.extend(ends.iter().filter(|e| !class.contains(e)).copied().collect::<Vec<_>>());
        classes = rest;
        classes.push(class);
    };
    for joint in &model.joints {
        match joint.kind {
            JointKind::Revolute | JointKind::Weld { .. } => join(&joint.ends()),
            JointKind::Prismatic { .. } | JointKind::Slot { .. } | JointKind::Gear(_) => {
                joint.ends().iter().for_each(|end| join(&[*end]));
            }
        }
    }
    for unknown in &model.unknowns {
        match unknown.kind {
            UnknownKind::Force { at, .. } => join(&[at]),
            UnknownKind::Thrust(ends) => ends.iter().for_each(|end| join(&[*end])),
            UnknownKind::Drive(_) | UnknownKind::Torque(..) => {}
        }
    }
    classes
        .into_iter()
        .flat_map(|class| {
            let place = [random.next(), random.next()];
            class.into_iter().map(move |end| (end, place))
        })
        .collect()
}
