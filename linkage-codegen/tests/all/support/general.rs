//! The general solution: the unreduced equations of a linkage, at a pose, as one linear system.

use std::cell::RefCell;
use std::collections::HashMap;

use linkage_codegen::Linkage;
use linkage_codegen::equations::joints::Component;
use linkage_codegen::equations::loads::Case;
use linkage_codegen::equations::{Declared, Exerted, Source, drive_row};
use linkage_codegen::graph::number::Number as Exact;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Coordinate, NodeId, NodeValues, Symbol};
use linkage_codegen::model::JointKind;
use linkage_codegen::model::ids::{DriveId, LinkId};
use linkage_codegen::program::Fault;
use nalgebra::{DMatrix, DVector};

use super::numbers::Extended;
use super::{Arguments, Number, pose};

/// The equations at a pose: columns are the scalar unknowns in the order of the system's rows, lines three for every moving link.
pub struct General<T> {
    pub matrix: Vec<Vec<T>>,
    /// What each load case exerts.
    pub cases: Vec<(Case, Vec<T>)>,
    pub sources: Vec<Source>,
}

/// The unreduced equations of a linkage at the pose of its own solution.
pub fn equations<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<General<T>, Fault> {
    Ok(equations_at(&Coordinates::at(linkage, arguments, &pose::<T>(linkage, arguments)?)))
}

/// The unreduced equations of a linkage at a pose.
pub fn equations_at<T: Number>(pose: &Coordinates<'_, T>) -> General<T> {
    let linkage = pose.linkage;
    let known = |symbol| pose.known(symbol);
    let mut done: NodeValues<T> = NodeValues::default();
    let mut value = |node| linkage.model.graph.evaluate(node, &known, &mut done);
    let lines = 3 * (linkage.model.links.len() - 1);
    let mut column = |exerts: &[Exerted]| {
        let mut column = vec![T::exactly(0.0); lines];
        for exerted in exerts {
            let line = 3 * (exerted.on.index() - 1);
            for (offset, node) in [exerted.x, exerted.y, exerted.moment].into_iter().enumerate() {
                column[line + offset] = column[line + offset].add(&value(node));
            }
        }
        column
    };
    let columns: Vec<Vec<T>> = linkage.system.rows.iter().map(|row| column(&row.exerts)).collect();
    let cases = linkage.system.cases.iter().map(|case| (case.case, column(&case.exerts))).collect();
    let matrix = (0..lines).map(|line| columns.iter().map(|column| column[line].clone()).collect()).collect();
    let sources = linkage.system.rows.iter().map(|row| row.source).collect();
    General { matrix, cases, sources }
}

/// The residuals of a linkage at the pose of its own solution.
pub fn residuals<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<Vec<T>, Fault> {
    Ok(residuals_at(&Coordinates::at(linkage, arguments, &pose::<T>(linkage, arguments)?)))
}

/// The residuals of the constraints and of the drives at a pose.
pub fn residuals_at<T: Number>(pose: &Coordinates<'_, T>) -> Vec<T> {
    let (linkage, graph) = (pose.linkage, &pose.linkage.model.graph);
    let known = |symbol| pose.known(symbol);
    let mut done: NodeValues<T> = NodeValues::default();
    let mut value = |node| graph.evaluate(node, &known, &mut done);
    let residuals = linkage.system.rows.iter().filter_map(|row| {
        let residual = value(row.residual?);
        let Source::Joint(joint, component) = row.source else { return Some(residual) };
        let period = match (linkage.model.joint(joint).kind, component) {
            (_, Component::Couple) => Some(graph.one()),
            // The angles of wheels are known with all their turns, those of other links are not.
            (JointKind::Gear(gear), _) => Some(gear.distance(&linkage.model)),
            _ => None,
        };
        Some(match period {
            Some(size) => within_a_turn(&residual, &value(size.id())),
            None => residual,
        })
    });
    let residuals: Vec<T> = residuals.collect();
    // The joints' coordinates are those that the drives give.
    let drives = (0..linkage.model.drives.len()).map(DriveId::new).filter_map(|drive| {
        let coordinate = drive_row(&linkage.model, graph, &Declared(&linkage.model), drive).residual?;
        let coordinate = graph.evaluate(coordinate, &known, &mut NodeValues::default());
        let apart = coordinate.sub(&T::exactly(pose.arguments.drives[drive.index()]));
        Some(if linkage.model.drive(drive).turns { within_a_turn(&apart, &T::exactly(1.0)) } else { apart })
    });
    residuals.into_iter().chain(drives).collect()
}

/// The coordinates of all links at a pose, and if anything depends on them their rates and accelerations. Each is found when it is asked
/// for: an angle takes long in many digits.
pub struct Coordinates<'a, T> {
    pub linkage: &'a Linkage,
    pub arguments: &'a Arguments,
    placed: RefCell<NodeValues<T>>,
}

impl<'a, T: Number> Coordinates<'a, T> {
    /// From what the pose keeps.
    pub fn at(linkage: &'a Linkage, arguments: &'a Arguments, kept: &NodeValues<T>) -> Self {
        Self { linkage, arguments, placed: RefCell::new(kept.clone()) }
    }

    /// A coordinate of a link.
    pub fn of(&self, link: LinkId, which: Coordinate) -> T {
        self.value(self.linkage.plan.links[link.index()].coordinate(which))
    }

    /// Coordinates, arguments of the linkage.
    fn known(&self, symbol: Symbol) -> T {
        match symbol {
            Symbol::Coordinate(link, which) => self.of(link, which),
            Symbol::Moving(link, which, order) => {
                let node = self.linkage.plan.links[link.index()].moving(which, order);
                self.value(node.expect("what something depends on"))
            }
            _ => T::exactly(self.arguments.of(symbol)),
        }
    }

    /// What the pose keeps, or what follows from it.
    pub fn value(&self, node: NodeId) -> T {
        let known = |symbol| T::exactly(self.arguments.of(symbol));
        self.linkage.model.graph.evaluate(node, &known, &mut self.placed.borrow_mut())
    }
}

/// What the motion leaves open of every joint and drive: how fast its residual changes, and how fast that does. Of drives the residual is
/// the coordinate less the given one.
pub fn open_motion<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<Vec<(Source, [T; 2])>, Fault> {
    let (model, graph) = (&linkage.model, &linkage.model.graph);
    let pose = Coordinates::at(linkage, arguments, &pose::<T>(linkage, arguments)?);
    let known = |symbol| pose.known(symbol);
    let joints = linkage.system.rows.iter().filter_map(|row| Some((row.source, graph.expr(row.residual?))));
    let drives = (0..model.drives.len()).map(DriveId::new).filter_map(|drive| {
        let row = drive_row(model, graph, &Declared(model), drive);
        Some((row.source, graph.expr(row.residual?) - graph.symbol(Symbol::Drive(drive))))
    });
    let open = joints.chain(drives).map(|(source, residual)| {
        let rate = graph.rate(residual);
        let both = [rate, graph.rate(rate)].map(|of| graph.evaluate(of.id(), &known, &mut NodeValues::default()));
        (source, both)
    });
    Ok(open.collect())
}

/// What is left of an arc when whole turns of its circle are taken off.
fn within_a_turn<T: Number>(arc: &T, radius: &T) -> T {
    let turn = T::from_number(&Exact::pi(2, 1)).mul(radius);
    let turns = (arc.to_f64() / turn.to_f64()).round();
    arc.sub(&turn.mul(&T::exactly(turns)))
}

impl<T: Number> General<T> {
    /// The right-hand side of some cases together: the opposite of what they exert.
    pub fn right_side(&self, which: &dyn Fn(&Case) -> bool) -> Vec<T> {
        let mut sum = vec![T::exactly(0.0); self.matrix.len()];
        for (case, exerted) in &self.cases {
            if which(case) {
                for (total, part) in sum.iter_mut().zip(exerted) {
                    *total = total.sub(part);
                }
            }
        }
        sum
    }

    /// The unknowns' names, as the paths that scenes use: `B.x`, `C.normal`, `C.couple`, `T12`.
    pub fn names(&self, linkage: &Linkage) -> Vec<String> {
        let name = |source: &Source| match source {
            Source::Joint(joint, component) => {
                let joint = linkage.model.joint(*joint);
                let force = match (joint.kind, component) {
                    (JointKind::Weld { .. }, Component::X | Component::Y) => "force.",
                    _ => "",
                };
                format!("{}.{force}{}", joint.name, component.name())
            }
            Source::Unknown(unknown) => linkage.model.unknown(*unknown).name.clone(),
            Source::Drive(drive) => linkage.model.drive(*drive).name.text.clone(),
        };
        self.sources.iter().map(name).collect()
    }

    /// Values of the unknowns by their names.
    pub fn named(&self, linkage: &Linkage, values: Vec<T>) -> HashMap<String, T> {
        self.names(linkage).into_iter().zip(values).collect()
    }
}

/// By nalgebra, with every line scaled to its largest entry: `None` if singular.
pub fn solve_nalgebra(matrix: &[Vec<f64>], right: &[f64]) -> Option<(Vec<f64>, f64)> {
    let n = matrix.len();
    let scale: Vec<f64> = matrix.iter().map(|line| line.iter().fold(0.0f64, |m, x| m.max(x.abs()))).collect();
    let a = DMatrix::from_fn(n, n, |i, j| matrix[i][j] / scale[i]);
    let b = DVector::from_fn(n, |i, _| right[i] / scale[i]);
    let condition = {
        let values = a.clone().singular_values();
        values.max() / values.min()
    };
    a.full_piv_lu().solve(&b).map(|x| (x.iter().copied().collect(), condition))
}

/// By elimination with partial pivoting in extended precision.
pub fn solve_extended(matrix: &[Vec<Extended>], right: &[Extended]) -> Option<Vec<Extended>> {
    let n = matrix.len();
    let mut a: Vec<Vec<Extended>> =
        matrix.iter().zip(right).map(|(line, b)| line.iter().cloned().chain([b.clone()]).collect()).collect();
    let zero = Extended::zero();
    for step in 0..n {
        let pivot = (step..n).max_by(|p, q| a[*p][step].abs().0.cmp(&a[*q][step].abs().0))?;
        a.swap(step, pivot);
        if a[step][step].0 == zero.0 {
            return None;
        }
        let (above, below) = a.split_at_mut(step + 1);
        let top = &above[step];
        for line in below {
            if line[step].0 == zero.0 {
                continue;
            }
            let factor = line[step].div(&top[step]);
            for column in step..=n {
                if top[column].0 != zero.0 {
                    line[column] = line[column].sub(&factor.mul(&top[column]));
                }
            }
        }
    }
    let mut x = vec![zero; n];
    for step in (0..n).rev() {
        let sum = (step + 1..n).fold(a[step][n].clone(), |sum, c| sum.sub(&a[step][c].mul(&x[c])));
        x[step] = sum.div(&a[step][step]);
    }
    Some(x)
}
