//! Poses in numbers: where all declared joints hold, found by iteration, and which of the constraints are independent there.
//!
//! They serve messages alone: what to release of a linkage that is held too often, and from where a search may start. Nothing that is
//! emitted comes from here.

use super::{Declared, Row, Source, drive_row, joint_rows};
use crate::graph::real::Real;
use crate::graph::{Coordinate, NodeId, NodeValues, Symbol};
use crate::model::Model;
use crate::model::ids::{DriveId, GROUND, JointId, LinkId};

/// What stays open of a closed pose, in lengths of the linkage.
const CLOSED: f64 = 1e-11;
/// Steps of an iteration.
const STEPS: usize = 60;
/// A row or a pivot this much smaller than the largest is none.
const DEPENDENT: f64 = 1e-7;

/// Where the frame of each link is, the ground first, in the units of the generated functions: its origin, and its angle with all its turns.
#[derive(Clone, Debug)]
pub(crate) struct Pose(pub(crate) Vec<[f64; 3]>);

/// The constraints of a linkage, in numbers.
#[derive(Clone)]
pub(crate) struct Poses<'m> {
    model: &'m Model,
    rows: Vec<(Row, f64)>,
    /// A length of the linkage: turns by one radian count like it.
    length: f64,
}

/// A constraint's change with the coordinates of links, three columns for each.
pub(crate) type Line = Vec<f64>;

impl<'m> Poses<'m> {
    /// All joints; `None` where a dimension is known only at run time.
    pub(crate) fn of(model: &'m Model) -> Option<Self> {
        if model.params.iter().any(|param| param.default.is_none()) {
            return None;
        }
        let dimensions = Declared(model);
        let rows = model.joint_ids().flat_map(|joint| joint_rows(model, &model.graph, &dimensions, joint));
        let mut poses = Self { model, rows: rows.map(|row| (row, 0.0)).collect(), length: 1.0 };
        let mut span = 0.0f64;
        let mut count = 0u32;
        for joint in &model.joints {
            for end in joint.ends() {
                let local = model.local(end);
                let [x, y] = [local.x.id(), local.y.id()].map(|node| poses.constant(node));
                span += x.hypot(y);
                count += 1;
            }
        }
        if span > 0.0 && span.is_finite() {
            poses.length = span / f64::from(count);
        }
        Some(poses)
    }

    /// The drives have these coordinates.
    pub(crate) fn driven(mut self, drives: impl Iterator<Item = (DriveId, f64)>) -> Self {
        for (drive, value) in drives {
            let row = drive_row(self.model, &self.model.graph, &Declared(self.model), drive);
            self.rows.push((row, value));
        }
        self
    }

    /// Of some joints alone.
    pub(crate) fn only(mut self, keeps: &dyn Fn(JointId) -> bool) -> Self {
        self.rows.retain(|(row, _)| match row.source {
            Source::Joint(joint, _) => keeps(joint),
            Source::Drive(drive) => keeps(self.model.drive(drive).joint),
            Source::Unknown(_) => true,
        });
        self
    }

    /// What the coordinate of a drive is in a pose.
    pub(crate) fn coordinate(&self, drive: DriveId, pose: &Pose) -> f64 {
        let alone = Self { rows: Vec::new(), ..self.clone() }.driven([(drive, 0.0)].into_iter());
        let scale = if self.model.drive(drive).turns { alone.length } else { 1.0 };
        alone.lines(pose, &[]).first().map_or(f64::NAN, |(_, open, _)| open / scale)
    }

    /// How far the constraints are from being dependent: the smallest pivot of an elimination, over the largest.
    pub(crate) fn firmness(&self, pose: &Pose, links: &[LinkId]) -> f64 {
        let lines =
            self.lines(pose, links).into_iter().map(|(.., line)| line).filter(|line| line.iter().any(|x| *x != 0.0));
        smallest_pivot(lines.collect(), 3 * links.len())
    }

    /// A length of the linkage.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// The number of an expression of parameters, by their defaults.
    pub(crate) fn constant(&self, node: NodeId) -> f64 {
        let known = |symbol: Symbol| self.parameter(symbol);
        self.model.graph.evaluate(node, &known, &mut NodeValues::default())
    }

    /// A parameter's default.
    pub(crate) fn parameter(&self, symbol: Symbol) -> f64 {
        let graph = &self.model.graph;
        match symbol {
            Symbol::Parameter(param) => {
                let default = self.model.param(param).default.and_then(|node| graph.constant_value(node));
                default.map_or(f64::NAN, |number| number.to_f64())
            }
            _ => f64::NAN,
        }
    }

    /// A place of the ground and an angle for every link, one of many.
    pub(crate) fn anywhere(&self, random: &mut Random) -> Pose {
        let link = |_| [3.0 * self.length * random.next(), 3.0 * self.length * random.next(), 3.2 * random.next()];
        let mut frames: Vec<[f64; 3]> = (0..self.model.links.len()).map(link).collect();
        frames[GROUND.index()] = [0.0; 3];
        Pose(frames)
    }

    /// What stays open of each constraint in a pose, and how that changes with the coordinates of links: both in lengths.
    pub(crate) fn lines(&self, pose: &Pose, links: &[LinkId]) -> Vec<(Source, f64, Line)> {
        let directions: Vec<(f64, f64)> = pose.0.iter().map(|[.., angle]| Real::sin_cos(angle)).collect();
        let known = |symbol: Symbol| match symbol {
            Symbol::Coordinate(link, which) => {
                let ([x, y, angle], (sin, cos)) = (pose.0[link.index()], directions[link.index()]);
                match which {
                    Coordinate::X => x,
                    Coordinate::Y => y,
                    Coordinate::Cos => cos,
                    Coordinate::Sin => sin,
                    Coordinate::Angle => angle,
                }
            }
            _ => self.parameter(symbol),
        };
        let mut done = NodeValues::default();
        let mut value = |node: NodeId| self.model.graph.evaluate(node, &known, &mut done);
        let line = |(row, wanted): &(Row, f64)| {
            let mut line = vec![0.0; 3 * links.len()];
            // A constraint of angles counts like one of lengths.
            let mut angular = true;
            for exerted in &row.exerts {
                let parts = [exerted.x, exerted.y, exerted.moment].map(&mut value);
                angular &= parts[0] == 0.0 && parts[1] == 0.0;
                if let Some(column) = links.iter().position(|link| *link == exerted.on) {
                    line[3 * column] = parts[0];
                    line[3 * column + 1] = parts[1];
                    line[3 * column + 2] = parts[2] / self.length;
                }
            }
            let mut open = row.residual.map_or(0.0, &mut value) - wanted;
            if angular {
                open *= self.length;
                line.iter_mut().for_each(|change| *change *= self.length);
            }
            (row.source, open, line)
        };
        self.rows.iter().map(line).collect()
    }

    /// Moves links until all constraints hold.
    pub(crate) fn closed(&self, mut pose: Pose, links: &[LinkId]) -> Option<Pose> {
        let size = |lines: &[(Source, f64, Line)]| lines.iter().map(|(_, open, _)| open * open).sum::<f64>().sqrt();
        let mut lines = self.lines(&pose, links);
        let mut open = size(&lines);
        for _ in 0..STEPS {
            if !open.is_finite() {
                return None;
            }
            if open < CLOSED * self.length {
                return Some(pose);
            }
            // Damped as far as it is open: many constraints may say the same.
            let mut damping = 0.01 * open / self.length;
            let mut next = None;
            for _ in 0..12 {
                let trial = moved(&pose, links, &step(&lines, damping * damping)?, self.length);
                let trial_lines = self.lines(&trial, links);
                let left = size(&trial_lines);
                if left < open {
                    next = Some((trial, trial_lines, left));
                    break;
                }
                damping = 4.0 * damping + 1e-6;
            }
            (pose, lines, open) = next?;
        }
        None
    }
}

/// A pose whose links moved by a step of lengths.
pub(crate) fn moved(pose: &Pose, links: &[LinkId], step: &[f64], length: f64) -> Pose {
    let mut moved = pose.clone();
    for (link, part) in links.iter().zip(step.chunks(3)) {
        let frame = &mut moved.0[link.index()];
        frame[0] += part[0];
        frame[1] += part[1];
        // No more than half a turn at once.
        frame[2] += (part[2] / length).clamp(-1.5, 1.5);
    }
    moved
}

/// The step of Levenberg and Marquardt: `(JᵀJ + μ) δ = −Jᵀ r`.
fn step(lines: &[(Source, f64, Line)], damping: f64) -> Option<Vec<f64>> {
    let columns = lines.first()?.2.len();
    let mut matrix = vec![vec![0.0; columns + 1]; columns];
    for (_, open, line) in lines {
        for (row, a) in matrix.iter_mut().zip(line).filter(|(_, a)| **a != 0.0) {
            row.iter_mut().zip(line).for_each(|(sum, b)| *sum += a * b);
            row[columns] -= a * open;
        }
    }
    for (index, row) in matrix.iter_mut().enumerate() {
        row[index] += damping.max(1e-12);
    }
    for pivot in 0..columns {
        let best = (pivot..columns).max_by(|a, b| matrix[*a][pivot].abs().total_cmp(&matrix[*b][pivot].abs()))?;
        matrix.swap(pivot, best);
        let top = matrix[pivot].clone();
        if top[pivot] == 0.0 {
            return None;
        }
        for row in &mut matrix[pivot + 1..] {
            let factor = row[pivot] / top[pivot];
            row.iter_mut().zip(&top).skip(pivot).for_each(|(x, t)| *x -= factor * t);
        }
    }
    let mut found = vec![0.0; columns];
    for row in (0..columns).rev() {
        let known: f64 = (row + 1..columns).map(|column| matrix[row][column] * found[column]).sum();
        found[row] = (matrix[row][columns] - known) / matrix[row][row];
    }
    found.iter().all(|x: &f64| x.is_finite()).then_some(found)
}

/// How many lines are independent, and a basis of what they leave free.
pub(crate) fn rank_and_kernel(mut matrix: Vec<Line>, columns: usize) -> (usize, Vec<Line>) {
    let mut order: Vec<usize> = (0..columns).collect();
    let largest = matrix.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
    let mut rank = 0;
    while rank < matrix.len().min(columns) {
        let candidates = (rank..matrix.len()).flat_map(|row| (rank..columns).map(move |column| (row, column)));
        let pivot = candidates.max_by(|a, b| matrix[a.0][a.1].abs().total_cmp(&matrix[b.0][b.1].abs()));
        let Some((row, column)) = pivot.filter(|(row, column)| matrix[*row][*column].abs() > DEPENDENT * largest)
        else {
            break;
        };
        matrix.swap(rank, row);
        matrix.iter_mut().for_each(|line| line.swap(rank, column));
        order.swap(rank, column);
        let scale = matrix[rank][rank];
        matrix[rank].iter_mut().for_each(|x| *x /= scale);
        let top = matrix[rank].clone();
        for (index, line) in matrix.iter_mut().enumerate() {
            if index != rank {
                let factor = line[rank];
                line.iter_mut().zip(&top).for_each(|(x, t)| *x -= factor * t);
            }
        }
        rank += 1;
    }
    let kernel = (rank..columns).map(|free| {
        let mut vector = vec![0.0; columns];
        vector[order[free]] = 1.0;
        for row in 0..rank {
            vector[order[row]] = -matrix[row][free];
        }
        vector
    });
    let kernel = kernel.collect();
    (rank, kernel)
}

/// The smallest pivot of an elimination over the largest; zero of dependent lines.
fn smallest_pivot(mut matrix: Vec<Line>, columns: usize) -> f64 {
    let mut first = 0.0;
    let mut last = 0.0;
    for rank in 0..columns.min(matrix.len()) {
        let candidates = (rank..matrix.len()).flat_map(|row| (rank..columns).map(move |column| (row, column)));
        let pivot = candidates.max_by(|a, b| matrix[a.0][a.1].abs().total_cmp(&matrix[b.0][b.1].abs()));
        let Some((row, column)) = pivot.filter(|(row, column)| matrix[*row][*column] != 0.0) else { return 0.0 };
        matrix.swap(rank, row);
        matrix.iter_mut().for_each(|line| line.swap(rank, column));
        let top = matrix[rank].clone();
        last = top[rank].abs();
        if rank == 0 {
            first = last;
        }
        for line in &mut matrix[rank + 1..] {
            let factor = line[rank] / top[rank];
            line.iter_mut().zip(&top).for_each(|(x, t)| *x -= factor * t);
        }
    }
    if first > 0.0 && matrix.len() >= columns { last / first } else { 0.0 }
}

/// Numbers between −1 and 1 (xorshift): always the same ones.
pub(crate) struct Random(u64);

impl Random {
    /// One of many series.
    pub(crate) fn new(seed: u64) -> Self {
        Self(0x9e37_79b9_7f4a_7c15 ^ (seed + 1).wrapping_mul(0xd134_2543_de82_ef95))
    }

    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        f64::from(u32::try_from(self.0 >> 33).unwrap_or(0)) / f64::from(1u32 << 30) - 1.0
    }
}
