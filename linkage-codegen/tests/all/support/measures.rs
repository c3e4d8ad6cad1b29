//! How accurate a solution is: measured in 220 bits from the numbers that the solution consists of.

use std::collections::HashMap;

use linkage_codegen::Linkage;
use linkage_codegen::equations::Source;
use linkage_codegen::equations::joints::Component;
use linkage_codegen::equations::loads::{self, Action};
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Coordinate, NodeValues, Vector};
use linkage_codegen::model::ids::{GROUND, JointId, LinkId};
use linkage_codegen::model::{End, JointKind, LoadKind, UnknownKind};
use linkage_codegen::program::Fault;
use nalgebra::{DMatrix, DVector};

use super::general::{Coordinates, General, equations_at, residuals_at, solve_extended};
use super::numbers::Extended;
use super::{Arguments, Number, from_pose, index_of, pose, scene};

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

/// Measures a pose and the scenes `all` (equilibrium, all results) and `work` (virtual work, all results) from it; of a single dyad also what
/// the functions that go straight from the drives find there. All loads are forces that are given at run time.
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
    let extended: NodeValues<Extended> =
        kept.iter().map(|(node, value)| (*node, Extended::exactly(value.to_f64()))).collect();
    let unit = direction_error(linkage, &extended) / epsilon;
    let here = Coordinates::at(linkage, arguments, &extended);
    let side = (longest * sides(linkage) / 4.0).max(farthest(&here));
    let closure = residuals_at(&here).iter().fold(0.0f64, |m, r| m.max(r.to_f64().abs())) / (side * epsilon);
    let here = Coordinates::at(linkage, arguments, &normalised(linkage, &extended));
    let general = equations_at(&here);
    let free_bodies_under = |solution: &[Extended]| -> Vec<FreeBody> {
        linkage.model.moving_links().map(|link| free_body(&here, &general, solution, link)).collect()
    };
    let unknown = &linkage.model.unknowns[0];
    let solution = unknowns(linkage, &general, &all);
    let bodies = free_bodies_under(&solution);
    let mut backward = backward_error(linkage, &general, &solution, longest) / epsilon;
    let mut free_body = free_bodies(linkage, &bodies) / epsilon;
    // Of equilibrium, and by virtual work.
    let torques =
        |all: &HashMap<String, T>, work: &HashMap<String, T>| [all, work].map(|of| of[&unknown.name].to_f64());
    let mut both = vec![torques(&all, &work)];
    if has_its_pose(linkage) {
        let [all, work] = [scene::<T>(linkage, "all", arguments)?, scene(linkage, "work", arguments)?];
        let straight = unknowns(linkage, &general, &all);
        backward = backward.max(backward_error(linkage, &general, &straight, longest) / epsilon);
        free_body = free_body.max(free_bodies(linkage, &free_bodies_under(&straight)) / epsilon);
        both.push(torques(&all, &work));
    }
    // Where the unknown acts equilibrium takes its terms from, virtual work from the loads.
    let held = match unknown.kind {
        UnknownKind::Drive(drive) => {
            let ends = linkage.model.joint(linkage.model.drive(drive).joint).ends().map(|end| end.link);
            bodies.iter().find(|body| ends.contains(&body.link)).expect("a link that moves")
        }
        _ => &bodies[0],
    };
    let terms = if is_moment(linkage, &unknown.name) { held.moments } else { held.forces }
        + virtual_velocities(&general).map_or(0.0, |velocities| {
            work_terms(&here, &velocities) + passed_power(linkage, &general, &velocities, &solution)
        });
    let torque = both.iter().fold(0.0f64, |most, [one, other]| most.max(over((one - other).abs(), terms) / epsilon));
    let found = Measures { unit, closure, backward, free_body, torque };
    assert!([unit, closure, backward, free_body, torque].into_iter().all(f64::is_finite), "{found:?}");
    Ok(found)
}

/// Whether a driven link moves one dyad, whose functions straight from the drives have the pose that is measured. Near a dead centre of others they
/// may have another one, by as much as rounding makes of it there; and an RPP dyad's travels differ from it by ε of all lengths, however short they
/// are.
fn has_its_pose(linkage: &Linkage) -> bool {
    let model = &linkage.model;
    let kinds = || model.joint_ids().map(|joint| &model.joint(joint).kind);
    let slides = kinds().filter(|kind| matches!(kind, JointKind::Prismatic { .. })).count();
    let pins = kinds().filter(|kind| matches!(kind, JointKind::Revolute)).count();
    let travels = linkage.plan.motion_rules.contains(&"RPP dyad");
    linkage.topology.motion.len() == 2 && slides + pins == 4 && !travels
}

/// The sides of the longest loop, at least four: a leg's, and those of the ways over links that are placed before.
#[allow(clippy::cast_precision_loss, reason = "few")]
fn sides(linkage: &Linkage) -> f64 {
    let model = &linkage.model;
    let mut placed = vec![GROUND];
    let mut most = 4;
    for group in &linkage.topology.motion {
        let outside = |joint: &JointId| {
            let ends = model.joint(*joint).ends().map(|end| end.link);
            ends.into_iter().find(|link| !group.links.contains(link)).expect("an outer joint")
        };
        let mut ends = group.outer.iter().map(outside);
        if let (Some(from), Some(to)) = (ends.next(), ends.next()) {
            // Links in the order of their distance from one end.
            let mut reached = vec![(from, 1)];
            let mut next = 0;
            while let Some(&(link, distance)) = reached.get(next) {
                for joint in
                    model.joint_ids().map(|joint| model.joint(joint)).filter(|joint| joint.end_on(link).is_some())
                {
                    let other = joint.end_off(link).expect("another link").link;
                    if placed.contains(&other) && !reached.iter().any(|(known, _)| *known == other) {
                        reached.push((other, distance + 1));
                    }
                }
                next += 1;
            }
            let way = reached.iter().find(|(link, _)| *link == to).map_or(2, |(_, distance)| *distance);
            most = most.max(way + group.links.len());
        }
        placed.extend(&group.links);
    }
    most as f64
}

/// Sides of loops that no length bounds, but numbers of the pose with a rounding of their own: how far something slides where two slides
/// are all that a pin leaves, which grows beyond all lengths as they become parallel; and how far wheels have rolled.
fn farthest(pose: &Coordinates<'_, Extended>) -> f64 {
    let (linkage, model) = (pose.linkage, &pose.linkage.model);
    let mut sides = Vec::new();
    if ["PRP dyad", "RPP dyad", "slot and slide"].iter().any(|rule| linkage.plan.motion_rules.contains(rule)) {
        let travels = linkage.plan.pose.iter().filter(|found| found.name.starts_with("travel_"));
        sides.extend(travels.map(|found| pose.value(found.node).to_f64().abs()));
    }
    for joint in (0..model.joints.len()).map(JointId::new) {
        let JointKind::Gear(gear) = model.joint(joint).kind else { continue };
        for (end, radius) in model.joint(joint).ends().into_iter().zip(gear.radii) {
            let radius = model.graph.expr(radius).value().expect("constant").to_f64();
            sides.push((radius * pose.of(end.link, Coordinate::Angle).to_f64()).abs());
        }
    }
    sides.into_iter().fold(0.0, f64::max)
}

/// The pose with all directions brought to unit size.
fn normalised(linkage: &Linkage, kept: &NodeValues<Extended>) -> NodeValues<Extended> {
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
    kept: &NodeValues<T>,
    arguments: &Arguments,
) -> Result<HashMap<String, T>, Fault> {
    let (paths, values) = values_from_kept(linkage, name, kept, arguments)?;
    Ok(paths.into_iter().zip(values).collect())
}

/// The same in the order of the results.
pub fn values_from_kept<T: Number>(
    linkage: &Linkage,
    name: &str,
    kept: &NodeValues<T>,
    arguments: &Arguments,
) -> Result<(Vec<String>, Vec<T>), Fault> {
    let index = index_of(linkage, name);
    let program = &linkage.functions.scenes[index].from_pose;
    let values = from_pose(linkage, program, kept, arguments)?;
    Ok((program.outputs.iter().map(|(path, _)| path.clone()).collect(), values))
}

fn direction_error(linkage: &Linkage, kept: &NodeValues<Extended>) -> f64 {
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

/// Where a slide or the pin in a slot acts on a link, in the link's frame: the runner's own place, and on the link that carries the line
/// the place of the slide's point with the travel from there, as the pose has it, if it does;
/// and the lengths of these ways, or of that over the other links.
fn runner_on(pose: &Coordinates<'_, Extended>, joint: JointId, link: LinkId) -> Option<(Option<[Extended; 2]>, f64)> {
    let (linkage, model) = (pose.linkage, &pose.linkage.model);
    let data = model.joint(joint);
    let (carrier, axis) = data.kind.line()?;
    let local = given(pose, model.local(data.end_on(link)?));
    let near = local[0].to_f64().hypot(local[1].to_f64());
    if link != carrier {
        return Some((Some(local), near));
    }
    let name = format!("travel_{}", data.name);
    let found = linkage.plan.pose.iter().find(|kept| kept.name == name).map(|found| pose.value(found.node));
    // The travel of a driven slide is an argument.
    let drive = || model.drive_of(joint, false).map(|drive| Extended::exactly(pose.arguments.drives[drive.index()]));
    let Some(travel) = found.or_else(drive) else { return Some((None, way_to_runner(pose, joint, link))) };
    let ahead = if data.from.link == carrier { travel } else { travel.neg() };
    let [x, y] = given(pose, axis.vector(&model.graph));
    // A travel that is found as a run between other points has the rounding of that.
    let name = format!("run_{}", data.name);
    let run =
        linkage.plan.pose.iter().find(|found| found.name == name).map_or(0.0, |run| pose.value(run.node).to_f64());
    let reach = near + ahead.to_f64().abs().max(run.abs());
    Some((Some([local[0].add(&x.mul(&ahead)), local[1].add(&y.mul(&ahead))]), reach))
}

/// The shortest way from a link's origin to the runner that a slide has on the other link, over links and joints but the slide itself: where
/// the pose keeps no travel, the place has the rounding of that.
fn way_to_runner(pose: &Coordinates<'_, Extended>, slide: JointId, link: LinkId) -> f64 {
    let model = &pose.linkage.model;
    let place = |end: End| {
        let [c, s, x, y] = [Coordinate::Cos, Coordinate::Sin, Coordinate::X, Coordinate::Y]
            .map(|which| if end.link == GROUND { 0.0 } else { pose.of(end.link, which).to_f64() });
        let [along, across] = given(pose, model.local(end)).map(|part| part.to_f64());
        if end.link == GROUND { [along, across] } else { [x + c * along - s * across, y + s * along + c * across] }
    };
    let apart = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).hypot(b - d);
    let origin = [Coordinate::X, Coordinate::Y].map(|which| pose.of(link, which).to_f64());
    // The ends of all joints, each with its place and the shortest way there that is known so far.
    let mut ends: Vec<(JointId, End, [f64; 2], f64)> = model
        .joint_ids()
        .flat_map(|joint| model.joint(joint).ends().map(|end| (joint, end)))
        .map(|(joint, end)| {
            (joint, end, place(end), if end.link == link { apart(origin, place(end)) } else { f64::INFINITY })
        })
        .collect();
    for _ in 0..ends.len() {
        for from in 0..ends.len() {
            let (joint, end, at, way) = ends[from];
            for (other, far, there, known) in &mut ends {
                if far.link == end.link || (*other == joint && joint != slide) {
                    *known = known.min(way + apart(at, *there));
                }
            }
        }
    }
    let runner = ends.iter().find(|(joint, end, ..)| *joint == slide && end.link != link);
    runner.map_or(f64::INFINITY, |(.., way)| *way)
}

/// A vector of constants and parameters.
fn given(pose: &Coordinates<'_, Extended>, vector: Vector<'_>) -> [Extended; 2] {
    [vector.x, vector.y].map(|part| pose.value(part.id()))
}

fn over(value: f64, size: f64) -> f64 {
    if size > 0.0 { value / size } else { value }
}

/// Whether an unknown is a couple.
pub fn is_moment(linkage: &Linkage, name: &str) -> bool {
    let unknown = linkage.model.unknowns.iter().find(|u| u.name == name);
    name.ends_with(".couple")
        || unknown.is_some_and(|unknown| match unknown.kind {
            UnknownKind::Torque(..) => true,
            UnknownKind::Force { .. } | UnknownKind::Thrust(_) => false,
            UnknownKind::Drive(drive) => linkage.model.drive(drive).turns,
        })
}

struct FreeBody {
    link: LinkId,
    /// `|ΣF|`
    force: f64,
    /// `Σ|F|`
    forces: f64,
    /// `|ΣM|`
    moment: f64,
    /// `Σ|r||F|`
    moments: f64,
}

/// The check that an engineer makes on paper. Moments are about the origin of the link's frame.
fn free_body(
    pose: &Coordinates<'_, Extended>,
    general: &General<Extended>,
    solution: &[Extended],
    link: LinkId,
) -> FreeBody {
    let (linkage, arguments) = (pose.linkage, pose.arguments);
    let first = 3 * (link.index() - 1);
    let coefficient = |offset: usize, column: usize| &general.matrix[first + offset][column];
    let [cos, sin] = [Coordinate::Cos, Coordinate::Sin].map(|which| pose.of(link, which));
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
        // What acts at a runner acts where the travel says that it is: its distance over the other links has their rounding.
        let slide = match general.sources[column] {
            Source::Joint(joint, Component::Normal) => Some(joint),
            Source::Unknown(unknown) => match linkage.model.unknown(unknown).kind {
                UnknownKind::Drive(drive) if force > 0.0 => Some(linkage.model.drive(drive).joint),
                _ => None,
            },
            _ => None,
        };
        let runner = slide.filter(|_| force > 0.0).and_then(|joint| runner_on(pose, joint, link));
        let arm = if let Some((at, reach)) = runner {
            if let Some([x, y]) = at {
                let along = cos.mul(&part[0]).add(&sin.mul(&part[1]));
                let across = cos.mul(&part[1]).sub(&sin.mul(&part[0]));
                part[2] = x.mul(&across).sub(&y.mul(&along));
            }
            reach
        } else {
            columns.clone().map(|c| coefficient(2, c).to_f64()).fold(0.0, f64::hypot)
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
        let mut done = NodeValues::default();
        let local = [at.x, at.y].map(|node| linkage.model.graph.evaluate::<f64>(node, &known, &mut done));
        let force = value[0].hypot(value[1]);
        forces += force;
        moments += force * local[0].hypot(local[1]);
        for (offset, sum) in sums.iter_mut().enumerate() {
            *sum = sum.add(&exerted[first + offset]);
        }
    }
    let [x, y, moment] = sums.map(|sum| sum.to_f64());
    FreeBody { link, force: x.hypot(y), forces, moment: moment.abs(), moments }
}

/// The largest residual of the free bodies: `|ΣF|/Σ|F|`, and `|ΣM|/Σ|r||F|`. What holds links together has the rounding of its couple from the
/// moments on either side: those of links that a weld or a driven slide joins count together.
fn free_bodies(linkage: &Linkage, bodies: &[FreeBody]) -> f64 {
    let model = &linkage.model;
    let is_rigid = |joint: JointId| match model.joint(joint).kind {
        JointKind::Weld { .. } => true,
        JointKind::Prismatic { .. } => model.drive_of(joint, false).is_some(),
        _ => false,
    };
    let held_together = |a: LinkId, b: LinkId| {
        let mut rigid = model.joint_ids().filter(|joint| is_rigid(*joint)).map(|joint| model.joint(joint));
        rigid.any(|joint| joint.end_on(a).is_some() && joint.end_on(b).is_some())
    };
    let residuals = bodies.iter().map(|body| {
        let others = bodies.iter().filter(|other| other.link != body.link && held_together(body.link, other.link));
        let moments = others.fold(body.moments, |sum, other| sum + other.moments);
        over(body.force, body.forces).max(over(body.moment, moments))
    });
    residuals.fold(0.0, f64::max)
}

/// Virtual velocities at unit rate of the unknown's coordinate: for each link that of its frame's origin and its rate of turning, so that
/// what the unknown does has the power one, and what each reaction does none.
///
/// In many digits: near a singular pose doubles would not tell how large they are.
fn virtual_velocities(general: &General<Extended>) -> Option<DVector<f64>> {
    let lines = 0..general.matrix.len();
    let column = |column: usize| lines.clone().map(|line| general.matrix[line][column].clone()).collect();
    let transposed: Vec<Vec<Extended>> = lines.clone().map(column).collect();
    let effort = general.sources.iter().position(|source| matches!(source, Source::Unknown(_))).expect("an unknown");
    let unit = lines.map(|line| Extended::exactly(f64::from(u8::from(line == effort)))).collect::<Vec<_>>();
    let velocities = solve_extended(&transposed, &unit)?;
    Some(DVector::from_iterator(velocities.len(), velocities.iter().map(Extended::to_f64)))
}

/// The power that passes at joints of which no term is counted already, `Σ|F||v|`: between groups at those that are on neither the ground
/// nor the driven link; and where a group is one system of equations at all of its joints.
///
/// The torque of equilibrium is that of virtual work, and the power of what equilibrium leaves open of each free body and of what the virtual
/// velocities leave open at each joint: a few roundings of their terms, and of these powers, whatever the condition of the equations.
fn passed_power(
    linkage: &Linkage,
    general: &General<Extended>,
    velocities: &DVector<f64>,
    solution: &[Extended],
) -> f64 {
    let topology = &linkage.topology;
    let is_iterated = |index: usize| linkage.plan.motion_rules[index] == "block";
    let passing = topology.motion.iter().enumerate().flat_map(|(index, group)| {
        let inner = group.inner.iter().filter(move |_| is_iterated(index));
        let end = move |joint: &JointId| {
            let ends = linkage.model.joint(*joint).ends().map(|end| end.link);
            let own = ends.into_iter().find(|link| group.links.contains(link) == is_iterated(index));
            own.map(|link| (*joint, link))
        };
        group.outer.iter().chain(inner).filter_map(end)
    });
    let between = passing.filter(|(_, link)| link.index() > 1);
    let power = |(joint, link): (JointId, LinkId)| {
        let first = 3 * (link.index() - 1);
        let of_joint = |c: &usize| matches!(general.sources[*c], Source::Joint(own, _) if own == joint);
        // The two components of a pin are one force: its rounding has any direction, whatever that of the force itself.
        let (pin, others): (Vec<usize>, Vec<usize>) = (0..solution.len())
            .filter(of_joint)
            .partition(|c| matches!(general.sources[*c], Source::Joint(_, Component::X | Component::Y)));
        let rate = |c: usize| -> f64 {
            (first..first + 3).map(|line| general.matrix[line][c].to_f64() * velocities[line]).sum()
        };
        let size = |values: &dyn Fn(usize) -> f64| pin.iter().map(|c| values(*c)).fold(0.0, f64::hypot);
        let of_pin = size(&|c| solution[c].to_f64()) * size(&rate);
        of_pin + others.into_iter().map(|c| (rate(c) * solution[c].to_f64()).abs()).sum::<f64>()
    };
    between.map(power).sum()
}

/// The terms of the loads' power, `Σ|F|(|v| + |ω||r|)`: the velocity of a load's point is that of a joint of its link and what turning adds
/// to it, of which little can be left. The joint is that of each link with the smallest terms.
fn work_terms(pose: &Coordinates<'_, Extended>, velocities: &DVector<f64>) -> f64 {
    let model = &pose.linkage.model;
    let terms = |index: usize, force: &[f64; 2]| {
        let LoadKind::Force { at, .. } = model.loads[index].kind else { return 0.0 };
        let [c, s] = [Coordinate::Cos, Coordinate::Sin].map(|which| pose.of(at.link, which).to_f64());
        let first = 3 * (at.link.index() - 1);
        let local = |end| given(pose, model.local(end)).map(|part| part.to_f64());
        let [x, y] = local(at);
        let by_way_of = |end| {
            let [px, py] = local(end);
            let turning = velocities[first + 2];
            let (vx, vy) =
                (velocities[first] - turning * (s * px + c * py), velocities[first + 1] + turning * (c * px - s * py));
            vx.hypot(vy) + turning.abs() * (x - px).hypot(y - py)
        };
        let joints = model.joint_ids().filter_map(|joint| model.joint(joint).end_on(at.link));
        force[0].hypot(force[1]) * joints.map(by_way_of).fold(f64::INFINITY, f64::min)
    };
    pose.arguments.loads.iter().enumerate().map(|(index, force)| terms(index, force)).sum()
}
