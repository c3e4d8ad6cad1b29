//! How accurate a solution is: measured in 220 bits from the numbers that the solution consists of.

use std::collections::HashMap;

use linkage_codegen::Linkage;
use linkage_codegen::equations::Source;
use linkage_codegen::equations::joints::Component;
use linkage_codegen::equations::loads::{self, Action};
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Coordinate, NodeId, Symbol};
use linkage_codegen::model::ids::{JointId, LinkId};
use linkage_codegen::model::{End, JointKind, LoadKind, UnknownKind};
use linkage_codegen::program::Fault;
use nalgebra::{DMatrix, DVector};

use super::general::{General, coordinates, equations_at};
use super::numbers::Extended;
use super::{Arguments, Number, from_pose, pose};

/// The measures of the acceptance bars, in epsilons of the scalar.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measures {
    /// Largest deviation of a direction's size from one.
    pub unit: f64,
    /// Largest constraint residual over the longest side of a loop: the longest link, or a way that no length bounds.
    pub closure: f64,
    /// Normwise backward error of the equilibrium equations.
    pub backward: f64,
    /// Largest residual of a free body over the sum of its forces, or of its moments.
    pub free_body: f64,
    /// Torque by virtual work against equilibrium, over the sum of the terms' magnitudes.
    pub torque: f64,
}

impl Measures {
    /// The worse of each.
    #[must_use]
    pub fn worst(self, other: Self) -> Self {
        Self {
            unit: self.unit.max(other.unit),
            closure: self.closure.max(other.closure),
            backward: self.backward.max(other.backward),
            free_body: self.free_body.max(other.free_body),
            torque: self.torque.max(other.torque),
        }
    }

    /// Panics if a measure is beyond its bar.
    pub fn assert_within(&self, bars: &Self, what: &str) {
        let all = [
            ("unit", self.unit, bars.unit),
            ("closure", self.closure, bars.closure),
            ("backward error", self.backward, bars.backward),
            ("free body", self.free_body, bars.free_body),
            ("torque", self.torque, bars.torque),
        ];
        for (name, found, bar) in all {
            assert!(found <= bar, "{what}: {name} {found:.2} ε, bar {bar} ε");
        }
    }
}

/// Measures a pose and the scenes `all` (equilibrium, all results) and `work` (virtual work, all results) from it. All loads are forces
/// that are given at run time.
///
/// Residuals of forces are taken at the directions that the pose's vectors have, brought to unit size.
pub fn measure<T: Number>(
    linkage: &Linkage,
    arguments: &Arguments,
    longest: f64,
    epsilon: f64,
) -> Result<Measures, Fault> {
    let kept = pose::<T>(linkage, arguments)?;
    let (all, work) = (from_kept(linkage, "all", &kept, arguments)?, from_kept(linkage, "work", &kept, arguments)?);
    let extended: HashMap<NodeId, Extended> =
        kept.iter().map(|(node, value)| (*node, Extended::exactly(value.to_f64()))).collect();
    let general = equations_at(linkage, arguments, &extended);
    let unit = direction_error(linkage, &extended) / epsilon;
    let side = longest.max(farthest(linkage, arguments, &extended));
    let closure = general.residuals.iter().fold(0.0f64, |m, r| m.max(r.to_f64().abs())) / (side * epsilon);
    let unit_pose = normalised(linkage, &extended);
    let general = equations_at(linkage, arguments, &unit_pose);
    let solution = unknowns(linkage, &general, &all);
    let backward = backward_error(linkage, &general, &solution, longest) / epsilon;
    let bodies: Vec<FreeBody> = linkage
        .model
        .moving_links()
        .map(|link| free_body(linkage, arguments, (&general, &unit_pose), &solution, link))
        .collect();
    let free_body = bodies.iter().map(|body| body.residual).fold(0.0, f64::max) / epsilon;
    // The unknown acts on the first moving link: there equilibrium takes its terms from, virtual work from the loads.
    let terms = bodies[0].moments + work_terms(linkage, arguments, &unit_pose);
    let name = &linkage.model.unknowns[0].name;
    let torque = over((all[name].to_f64() - work[name].to_f64()).abs(), terms) / epsilon;
    Ok(Measures { unit, closure, backward, free_body, torque })
}

/// Sides of loops that no length bounds, but numbers of the pose with a rounding of their own: how far something slides where two slides
/// alone hold a pin, which grows beyond all lengths as they become parallel; and how far wheels have rolled.
fn farthest(linkage: &Linkage, arguments: &Arguments, kept: &HashMap<NodeId, Extended>) -> f64 {
    let model = &linkage.model;
    let mut sides = Vec::new();
    if linkage.plan.motion_rules.contains(&"PRP dyad") {
        let travels = linkage.plan.pose.iter().filter(|found| found.name.starts_with("travel_"));
        sides.extend(travels.map(|found| kept[&found.node].to_f64().abs()));
    }
    let coordinates = coordinates(linkage, arguments, kept);
    for joint in (0..model.joints.len()).map(JointId::new) {
        let JointKind::Gear(gear) = model.joint(joint).kind else { continue };
        for (end, radius) in model.joint(joint).ends().into_iter().zip(gear.radii) {
            let radius = model.graph.expr(radius).value().expect("constant").to_f64();
            let angle = coordinates.get(&Symbol::Coordinate(end.link, Coordinate::Angle)).map_or(0.0, Number::to_f64);
            sides.push((radius * angle).abs());
        }
    }
    sides.into_iter().fold(0.0, f64::max)
}

/// The pose with all directions brought to unit size.
fn normalised(linkage: &Linkage, kept: &HashMap<NodeId, Extended>) -> HashMap<NodeId, Extended> {
    let mut unit = kept.clone();
    let node = |name: String| linkage.plan.pose.iter().find(|kept| kept.name == name).map(|kept| kept.node);
    for link in linkage.model.moving_links() {
        let name = &linkage.model.link(link).name;
        let (Some(c), Some(s)) = (node(format!("{name}_cos")), node(format!("{name}_sin"))) else { continue };
        let (x, y) = kept[&c].unit(&kept[&s]);
        unit.insert(c, x);
        unit.insert(s, y);
    }
    unit
}

/// A scene from a pose, by the paths of its results.
pub fn from_kept<T: Number>(
    linkage: &Linkage,
    name: &str,
    kept: &HashMap<NodeId, T>,
    arguments: &Arguments,
) -> Result<HashMap<String, T>, Fault> {
    let (paths, values) = values_from_kept(linkage, name, kept, arguments)?;
    Ok(paths.into_iter().zip(values).collect())
}

/// The same in the order of the results.
pub fn values_from_kept<T: Number>(
    linkage: &Linkage,
    name: &str,
    kept: &HashMap<NodeId, T>,
    arguments: &Arguments,
) -> Result<(Vec<String>, Vec<T>), Fault> {
    let index = linkage.model.scenes.iter().position(|scene| scene.name.text == name).expect("a scene of this name");
    let program = &linkage.functions.scenes[index].from_pose;
    let values = from_pose(linkage, program, kept, arguments)?;
    Ok((program.outputs.iter().map(|(path, _)| path.clone()).collect(), values))
}

fn direction_error(linkage: &Linkage, kept: &HashMap<NodeId, Extended>) -> f64 {
    let value = |name: String| {
        let found = linkage.plan.pose.iter().find(|kept| kept.name == name);
        found.map(|found| kept[&found.node].clone())
    };
    let errors = linkage.model.moving_links().filter_map(|link| {
        let name = &linkage.model.link(link).name;
        let (c, s) = (value(format!("{name}_cos"))?, value(format!("{name}_sin"))?);
        Some(c.mul(&c).add(&s.mul(&s)).sqrt().sub(&Extended::exactly(1.0)).to_f64().abs())
    });
    errors.fold(0.0, f64::max)
}

/// The solution in the order of the equations' columns.
fn unknowns<T: Number>(linkage: &Linkage, general: &General<Extended>, all: &HashMap<String, T>) -> Vec<Extended> {
    let names = general.names(linkage);
    names.iter().map(|name| Extended::exactly(all[name].to_f64())).collect()
}

/// `‖Ax − b‖/(‖A‖‖x‖ + ‖b‖)` in the Euclidean norm; moments count over the longest link.
fn backward_error(linkage: &Linkage, general: &General<Extended>, solution: &[Extended], longest: f64) -> f64 {
    let loads: Vec<Extended> = general.right_side(&|_| true).iter().map(Extended::neg).collect();
    let line_scale = |line: usize| if line % 3 == 2 { longest } else { 1.0 };
    let moments: Vec<bool> = general.names(linkage).iter().map(|name| is_moment(linkage, name)).collect();
    let column_scale = |column: usize| if moments[column] { longest } else { 1.0 };
    let (n, m) = (general.matrix.len(), solution.len());
    let residual = DVector::from_fn(n, |line, _| {
        let row = &general.matrix[line];
        let sum = (0..m).fold(loads[line].clone(), |sum, c| sum.add(&row[c].mul(&solution[c])));
        sum.to_f64() / line_scale(line)
    });
    let matrix =
        DMatrix::from_fn(n, m, |line, c| general.matrix[line][c].to_f64() * column_scale(c) / line_scale(line));
    let x = DVector::from_fn(m, |c, _| solution[c].to_f64() / column_scale(c));
    let b = DVector::from_fn(n, |line, _| loads[line].to_f64() / line_scale(line));
    over(residual.norm(), matrix.singular_values().max() * x.norm() + b.norm())
}

/// A place in the frame of its link.
fn local_place(linkage: &Linkage, end: End) -> [f64; 2] {
    let local = linkage.model.local(end);
    [local.x, local.y].map(|x| x.value().expect("constant").to_f64())
}

/// The lengths of the ways from a link's frame to the runner of a slide.
fn slide_arm(
    linkage: &Linkage,
    arguments: &Arguments,
    kept: &HashMap<NodeId, Extended>,
    joint: JointId,
    link: LinkId,
) -> f64 {
    let model = &linkage.model;
    let data = model.joint(joint);
    let Some(end) = data.end_on(link) else { return 0.0 };
    if let JointKind::Slot { .. } = data.kind {
        // The pin's place is known from the link that has the pin.
        let (place, coordinates) = (data.place(), coordinates(linkage, arguments, kept));
        let of = |link, which| coordinates.get(&Symbol::Coordinate(link, which)).map_or(0.0, Number::to_f64);
        let [x, y] = local_place(linkage, place);
        let (c, s) = (of(place.link, Coordinate::Cos), of(place.link, Coordinate::Sin));
        let apart = [Coordinate::X, Coordinate::Y].map(|which| of(place.link, which) - of(link, which));
        return (apart[0] + c * x - s * y).hypot(apart[1] + s * x + c * y);
    }
    let local = local_place(linkage, end);
    let name = format!("travel_{}", data.name);
    let found = linkage.plan.pose.iter().find(|kept| kept.name == name).map(|found| kept[&found.node].to_f64());
    // The travel of a driven slide is an argument.
    let travel = found.or(model.drive_of(joint, false).map(|drive| arguments.drives[drive.index()])).unwrap_or(0.0);
    let runner_elsewhere = data.place() != end;
    local[0].hypot(local[1]) + if runner_elsewhere { travel.abs() } else { 0.0 }
}

fn over(value: f64, size: f64) -> f64 {
    if size > 0.0 { value / size } else { value }
}

fn is_moment(linkage: &Linkage, name: &str) -> bool {
    let unknown = linkage.model.unknowns.iter().find(|u| u.name == name);
    name.ends_with(".couple")
        || unknown.is_some_and(|unknown| match unknown.kind {
            UnknownKind::Torque(..) => true,
            UnknownKind::Force { .. } | UnknownKind::Thrust(_) => false,
            UnknownKind::Drive(drive) => linkage.model.drive(drive).turns,
        })
}

struct FreeBody {
    /// `|ΣF|/Σ|F|` and `|ΣM|/Σ|r||F|`, whichever is larger.
    residual: f64,
    /// `Σ|r||F|`.
    moments: f64,
}

/// The check that an engineer makes on paper.
fn free_body(
    linkage: &Linkage,
    arguments: &Arguments,
    (general, kept): (&General<Extended>, &HashMap<NodeId, Extended>),
    solution: &[Extended],
    link: LinkId,
) -> FreeBody {
    let first = 3 * (link.index() - 1);
    let coefficient = |offset: usize, column: usize| &general.matrix[first + offset][column];
    let mut sums = [Extended::zero(), Extended::zero(), Extended::zero()];
    let (mut forces, mut moments) = (0.0, 0.0);
    // Reactions: the components of a pin belong together, with the arm that their moments have.
    let mut column = 0;
    while column < solution.len() {
        let pair = matches!(general.sources[column], Source::Joint(_, Component::X));
        let columns = if pair { column..column + 2 } else { column..column + 1 };
        let mut part = [Extended::zero(), Extended::zero(), Extended::zero()];
        for c in columns.clone() {
            for (offset, sum) in part.iter_mut().enumerate() {
                *sum = sum.add(&coefficient(offset, c).mul(&solution[c]));
            }
        }
        let force = part[0].to_f64().hypot(part[1].to_f64());
        let arm = match general.sources[column] {
            // The runner is at the end of two ways: to the slide's point on the link, and along the slide.
            Source::Joint(joint, Component::Normal) => slide_arm(linkage, arguments, kept, joint, link),
            Source::Unknown(unknown) if force > 0.0 => {
                // The effort along a slide acts at its runner.
                match linkage.model.unknown(unknown).kind {
                    UnknownKind::Drive(drive) => {
                        slide_arm(linkage, arguments, kept, linkage.model.drive(drive).joint, link)
                    }
                    _ => coefficient(2, column).to_f64().abs(),
                }
            }
            _ => columns.clone().map(|c| coefficient(2, c).to_f64()).fold(0.0, f64::hypot),
        };
        forces += force;
        moments += if force > 0.0 { arm * force } else { part[2].to_f64().abs() };
        sums.iter_mut().zip(&part).for_each(|(sum, part)| *sum = sum.add(part));
        column = columns.end;
    }
    let symbolic = loads::Symbolic { model: &linkage.model, topology: &linkage.topology };
    for ((case, exerted), (_, actions)) in general.cases.iter().zip(loads::cases(&symbolic)) {
        let LoadKind::Force { at, .. } = linkage.model.load(case.load).kind else { continue };
        if at.link != link {
            continue;
        }
        let value = arguments.loads[case.load.index()];
        let [Action::Force { at, .. }] = actions.as_slice() else { continue };
        let known = |symbol| arguments.of(symbol);
        let mut done = HashMap::new();
        let local = [at.x, at.y].map(|node| linkage.model.graph.evaluate::<f64>(node, &known, &mut done));
        let force = value[0].hypot(value[1]);
        forces += force;
        moments += force * local[0].hypot(local[1]);
        for (offset, sum) in sums.iter_mut().enumerate() {
            *sum = sum.add(&exerted[first + offset]);
        }
    }
    let [x, y, moment] = sums.map(|sum| sum.to_f64());
    FreeBody { residual: over(x.hypot(y), forces).max(over(moment.abs(), moments)), moments }
}

/// The sum of `|F||v|`, at unit rate of the unknown's coordinate.
fn work_terms(linkage: &Linkage, arguments: &Arguments, kept: &HashMap<NodeId, Extended>) -> f64 {
    // The velocity of a load's point is the work of unit forces.
    let velocity = |load: usize| {
        let part = |unit: [f64; 2]| {
            let mut arguments = arguments.clone();
            arguments.loads[load] = unit;
            let name = format!("{}.work", linkage.model.loads[load].name);
            from_kept::<Extended>(linkage, "work", kept, &arguments).map_or(0.0, |work| work[&name].to_f64())
        };
        part([1.0, 0.0]).hypot(part([0.0, 1.0]))
    };
    let loads = arguments.loads.iter().enumerate();
    loads.map(|(index, force)| force[0].hypot(force[1]) * velocity(index)).sum()
}
