//! [`Topology`] and [`System`] in, [`Plan`] out: every group solved by its rule, every scene's results as expressions.
//!
//! Afterwards each result is a node of the graph, reduced by division through named pivots only. What a function needs of it is taken
//! out later, by demand.

mod assembly;
mod balance;
mod coefficients;
mod dynamics;
pub mod efforts;
mod error_bound;
mod framed;
mod half_angle;
mod inverse;
mod linear;
mod output;
mod pivots;
mod placement;
mod posed;
mod reactions;
mod resultants;
pub mod rules;
pub(crate) mod scenes;
mod sensitivities;
pub(crate) mod starts;
mod sweeps;
mod velocities;

pub use assembly::Assembly;
pub use balance::Balance;
pub(crate) use coefficients::names as coefficient_names;
pub use output::{Comparison, Field, Meaning, Output};
pub use pivots::Pivots;
pub use placement::Placement;
pub(crate) use scenes::reaction_type;
pub(crate) use sweeps::slice_name;
pub use velocities::Motion;

use posed::Posed;

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostics::{Diagnostic, Sink, list};
use crate::equations::System;
use crate::graph::{Coordinate, Expr, Graph, Label, NodeId, NodeValues, Op, Order, Sought, Symbol};
use crate::model::ids::{DriveId, JointId, LinkId, ParamId};
use crate::model::units::Kind;
use crate::model::{Along, Closure, End, Joint, Model, Pair, Scene, Wanted, reciprocal_name};
use crate::topology::{Group, Input, Topology};

/// The solution of a linkage.
#[derive(Debug)]
pub struct Plan {
    /// What a pose keeps beside the drives' coordinates.
    pub pose: Vec<Kept>,
    /// What can be asked of a pose by itself.
    pub accessors: Vec<Accessor>,
    /// Where every link is, the ground first.
    pub links: Vec<PlacedLink>,
    /// The scenes' results, in the order of the scenes.
    pub scenes: Vec<Output>,
    /// The rules that solve the groups of motion, in their order.
    pub motion_rules: Vec<&'static str>,
    /// The rules that solve the groups of forces.
    pub force_rules: Vec<&'static str>,
}

/// Where a link is, in the coordinates of the unreduced equations.
#[derive(Clone, Copy, Debug)]
pub struct PlacedLink {
    /// The origin of its frame.
    pub origin: Pair,
    /// The direction of its x axis.
    pub direction: Pair,
    /// The angle of its x axis.
    pub angle: NodeId,
    /// Of a linkage whose motion anything depends on: rate and acceleration of the origin's coordinates and of the angle.
    pub motion: Option<[[NodeId; 3]; 2]>,
}

impl PlacedLink {
    /// The node of the rate or the acceleration of a coordinate.
    #[must_use]
    pub fn moving(&self, which: Coordinate, order: Order) -> Option<NodeId> {
        let [rates, accelerations] = self.motion?;
        let [x, y, angle] = match order {
            Order::Rate => rates,
            Order::Acceleration => accelerations,
        };
        match which {
            Coordinate::X => Some(x),
            Coordinate::Y => Some(y),
            Coordinate::Angle => Some(angle),
            Coordinate::Cos | Coordinate::Sin => None,
        }
    }

    /// The node of a coordinate.
    #[must_use]
    pub fn coordinate(&self, which: Coordinate) -> NodeId {
        match which {
            Coordinate::X => self.origin.x,
            Coordinate::Y => self.origin.y,
            Coordinate::Cos => self.direction.x,
            Coordinate::Sin => self.direction.y,
            Coordinate::Angle => self.angle,
        }
    }
}

/// A value that a pose keeps.
#[derive(Clone, Debug)]
pub struct Kept {
    /// Its name.
    pub name: String,
    /// What it is.
    pub meaning: String,
    /// Its node.
    pub node: NodeId,
    /// Whether it only says how far others may be off: infinite, or no number, where nothing can be said.
    pub is_bound: bool,
}

/// A method of a pose.
#[derive(Debug)]
pub struct Accessor {
    /// Its name.
    pub name: String,
    /// What it gives.
    pub meaning: String,
    /// The result.
    pub output: Output,
}

impl Plan {
    /// Solves a linkage. `None` if that is not possible; why is reported. A closure may also be meant for groups that close `elsewhere`: where
    /// the linkage is driven otherwise.
    #[must_use]
    pub fn of(
        model: &Model,
        topology: &Topology,
        system: &System,
        elsewhere: &BTreeSet<JointId>,
        sink: &Sink,
    ) -> Option<Self> {
        let motion_rules = rules_of(model, &topology.motion, "place", sink)?;
        let force_rules = rules_of(model, &topology.forces, "find the forces of", sink)?;
        let mut assembly = Assembly::new(model, topology);
        for (index, (group, rule)) in topology.motion.iter().zip(&motion_rules).enumerate() {
            model.graph.begin_section(heading(model, index, group, rule.class(), "position"));
            if let Err(error) = rule.place(&mut assembly, group) {
                if !assembly.lacks_closure(group) {
                    sink.report(error);
                }
                // What is chosen at a group that has an error is no second one.
                assembly.pass_over(group);
            }
        }
        // Where the linkage is driven otherwise than it is declared, what is not used is the declaration's.
        let idle = |closure: &&Closure| model.exchanged.is_none() && !elsewhere.contains(&closure.joint);
        let unused: Vec<&Closure> = assembly.unused_closures().filter(idle).collect();
        assembly.wrong_closures(&unused).into_iter().for_each(|error| sink.report(error));
        check_chosen_once(model, topology, sink);
        check_starts_used(model, &assembly, sink);
        if !sink.is_clean() {
            return None;
        }
        let velocities = model.moves().then(|| {
            let motion = Motion::velocities(&assembly.placement, &assembly.pivots);
            motion.through(&topology.motion, &motion_rules, sink)
        });
        let accelerations = velocities
            .as_ref()
            .filter(|_| model.accelerates())
            .map(|velocities| Motion::accelerations(velocities).through(&topology.motion, &motion_rules, sink));
        let posed = Posed {
            placement: &assembly.placement,
            velocities: velocities.as_ref(),
            accelerations: accelerations.as_ref(),
        };
        let links = placed_links(posed);
        let accessors = accessors(&assembly);
        let mut pose = kept(&assembly);
        let placed: BTreeSet<NodeId> = pose.iter().map(|kept| kept.node).collect();
        let mut scenes = scenes::outputs(&assembly, posed, [&motion_rules, &force_rules], (system, &links), sink);
        pose.extend(reciprocals(&assembly, &scenes));
        pose.extend(arms(model, &scenes, &pose));
        pose.extend(error_bound::add(&assembly, &mut scenes, &pose));
        let asked = accessors.iter().map(|accessor| &accessor.output);
        let (read, sought) = (read_of_poses(&model.graph, scenes.iter().chain(asked)), sought(&model.graph));
        // The others are there because a scene reads them.
        pose.retain(|kept| !placed.contains(&kept.node) || read.contains(&kept.node) || sought.contains(&kept.name));
        let plan = Self {
            pose,
            accessors,
            scenes,
            links,
            motion_rules: motion_rules.iter().map(|rule| rule.class()).collect(),
            force_rules: force_rules.iter().map(|rule| rule.class()).collect(),
        };
        sweeps::check_names(model, &plan.scenes, sink);
        check_possible(model, sink);
        check_defaults(model, sink);
        sink.is_clean().then_some(plan)
    }
}

/// Where a linkage is driven in several ways, a joint may have several closures; a group of it has one.
fn check_chosen_once(model: &Model, topology: &Topology, sink: &Sink) {
    for group in &topology.motion {
        for joint in group.inner.iter().chain(&group.outer) {
            if let Some(second) = model.fitting_closures(*joint, &group.outer).nth(1) {
                let problem = format!("the side of `{}` is chosen already", joint_name(model, *joint));
                sink.report(
                    Diagnostic::new(model.closure(second).place, problem)
                        .help("keep one of the two; if the other one is for an inverse scene, name a joint that this group does not have"),
                );
            }
        }
    }
}

/// Only what is placed by iteration starts anywhere.
fn check_starts_used(model: &Model, assembly: &Assembly<'_>, sink: &Sink) {
    let unused = |place, name: &str| {
        sink.report(
            Diagnostic::new(place, format!("`{name}` needs no start"))
                .note("a start is for links that are placed by iteration, and for the drives of a linkage that has such links")
                .help("leave it out"),
        );
    };
    for start in model.starts.iter().filter(|start| !assembly.started.contains(&start.link)) {
        unused(start.place, &model.link(start.link).name.text);
    }
    for drive in model.drives.iter().filter(|_| assembly.started.is_empty()) {
        if let Some((_, place)) = drive.start {
            unused(place, &drive.name.text);
        }
    }
}

type Rules = Vec<&'static dyn rules::Rule>;

fn rules_of(model: &Model, groups: &[Group], what: &str, sink: &Sink) -> Option<Rules> {
    let mut found = Vec::new();
    for group in groups {
        match rules::rule_of(model, group) {
            Some(rule) => found.push(rule),
            None => sink.report(unsupported(model, group, what)),
        }
    }
    sink.is_clean().then_some(found)
}

/// A group for which there is no rule.
fn unsupported(model: &Model, group: &Group, what: &str) -> Diagnostic {
    let links: Vec<&str> = group.links.iter().map(|link| model.link(*link).name.text.as_str()).collect();
    let place = match group.inputs.first() {
        Some(Input::Unknown(unknown)) => model.unknown(*unknown).place,
        Some(Input::Drive(drive)) => model.drive(*drive).name.place(),
        None => model.link(group.links[0]).name.place(),
    };
    let letters = group.letters(model);
    let joints = group.outer.iter().chain(&group.inner).map(|j| model.joint(*j).name.text.as_str());
    let joints = joints.collect::<Vec<_>>();
    let class = "its class is not supported yet";
    Diagnostic::new(place, format!("there is no rule to {what} the group of {}: {class}", list(&links)))
        .note(format!("its joints are {} ({letters})", list(&joints)))
        .help(format!(
            "groups of joints of every kind are solved, with up to {} unknowns, and wheels whose arm is placed before them or with them: another drive or unknown may split the linkage so",
            linear::CORE
        ))
}

/// The heading of a group's steps.
fn heading(model: &Model, index: usize, group: &Group, class: &str, what: &str) -> String {
    let joints = group.outer.iter().chain(&group.inner).map(|j| model.joint(*j).name.text.as_str());
    let joints = joints.collect::<Vec<_>>().join(", ");
    format!("Group {}, {class}: {} ({joints}): {what}", index + 1, model.link_names(&group.links))
}

fn placed_links(posed: Posed<'_, '_>) -> Vec<PlacedLink> {
    let placement = posed.placement;
    let zero = placement.graph().zero();
    let moving = |motion: Option<&Motion<'_, '_>>, link: LinkId| {
        let Some(motion) = motion else { return [zero.id(); 3] };
        let origin = motion.of_place(link, placement.graph().zero_vector()).ground();
        [origin.x.id(), origin.y.id(), motion.rate(link).id()]
    };
    let place = |link: LinkId| PlacedLink {
        origin: placement.origin(link).into(),
        direction: placement.frame(link).into(),
        angle: placement.angle(link).id(),
        motion: posed.velocities.map(|_| [posed.velocities, posed.accelerations].map(|motion| moving(motion, link))),
    };
    (0..placement.model.links.len()).map(LinkId::new).map(place).collect()
}

/// The scenes without bounds of their errors: for these rounding is not counted, and they are arranged for what a pose keeps.
fn uncounted<'s>(model: &'s Model, scenes: &'s [Output]) -> impl Iterator<Item = &'s Output> {
    let both = model.scenes.iter().zip(scenes);
    both.filter(|(scene, _)| !scene.results.contains(&Wanted::ErrorBound)).map(|(_, output)| output)
}

/// What scenes and what else can be asked of a pose read of what it keeps.
fn read_of_poses<'s>(graph: &Graph, scenes: impl IntoIterator<Item = &'s Output>) -> BTreeSet<NodeId> {
    let mut open: Vec<NodeId> = scenes.into_iter().flat_map(Output::leaves).map(|(_, node)| node).collect();
    let (mut seen, mut read) = (BTreeSet::new(), BTreeSet::new());
    while let Some(node) = open.pop() {
        if !seen.insert(node) {
            continue;
        }
        match graph.op(node) {
            Op::Held(_) => {
                read.insert(node);
            }
            Op::Checked { value, guard } => {
                let guard = graph.guard(guard);
                open.push(value);
                open.extend(guard.condition.operands());
                open.extend(guard.failure.operand());
            }
            op => open.extend(graph.put_together_from_pose(node).map_or_else(|| op.operands(), |other| vec![other])),
        }
    }
    read
}

/// The arms of forces that scenes read beside what a pose keeps anyway.
fn arms(model: &Model, scenes: &[Output], kept: &[Kept]) -> Vec<Kept> {
    let graph = &model.graph;
    let mut names: BTreeSet<String> = kept.iter().map(|kept| kept.name.clone()).collect();
    let read = read_of_poses(graph, uncounted(model, scenes));
    let others = read.into_iter().filter(|node| kept.iter().all(|kept| kept.node != *node));
    let arm = |node: NodeId| {
        let Label { mut name, equation } = graph.op(node).operands().first().and_then(|inner| graph.label(*inner))?;
        while !names.insert(name.clone()) {
            name.push('_');
        }
        graph.name_kept(node, &name);
        let component = if name.trim_end_matches('_').ends_with('x') { "x" } else { "y" };
        Some(Kept { name, meaning: format!("{component} of the {equation}, ground axes"), node, is_bound: false })
    };
    others.filter_map(arm).collect()
}

/// The reciprocals of the pivots by which scenes divide: a pose divides once, for all of them.
fn reciprocals(assembly: &Assembly<'_>, scenes: &[Output]) -> Vec<Kept> {
    let graph = &assembly.model().graph;
    let divisors = divisors(graph, uncounted(assembly.model(), scenes));
    let mut kept: Vec<Kept> = Vec::new();
    for pivot in assembly.dyads.iter().filter(|pivot| divisors.contains(&pivot.value.id())) {
        if graph.kept_reciprocal(pivot.value.id()).is_some() {
            continue;
        }
        let (name, equation) = (reciprocal_name(&pivot.name), format!("1/{}", pivot.name));
        let keep = || graph.keep_reciprocal(pivot.value, &name, &equation);
        let reciprocal = graph.beside(pivot.value.id(), keep);
        graph.name_kept(reciprocal.id(), &name);
        let meaning = format!("reciprocal of the {}, zero where that counts as zero", pivot.what);
        kept.push(Kept { name, meaning, node: reciprocal.id(), is_bound: false });
    }
    kept
}

/// What scenes divide by, without names and checks.
fn divisors<'s>(graph: &Graph, scenes: impl Iterator<Item = &'s Output>) -> BTreeSet<NodeId> {
    let mut open: Vec<NodeId> = scenes.flat_map(Output::leaves).map(|(_, node)| node).collect();
    let (mut seen, mut divisors) = (BTreeSet::new(), BTreeSet::new());
    while let Some(node) = open.pop() {
        let op = graph.op(node);
        if !seen.insert(node) || matches!(op, Op::Held(_)) {
            continue;
        }
        if let Op::Div(_, divisor) = op
            && !graph.is_divided(node)
        {
            divisors.insert(graph.bare(divisor));
        }
        open.extend(op.operands());
    }
    divisors
}

/// Directions, travels and pivots, each once; what is constant is not kept.
fn kept(assembly: &Assembly<'_>) -> Vec<Kept> {
    let model = assembly.model();
    let mut all: Vec<Kept> = Vec::new();
    let mut keep = |name: String, meaning: String, value: Expr<'_>| {
        if matches!(value.op(), Op::Held(_)) {
            all.push(Kept { name, meaning, node: value.id(), is_bound: false });
        }
    };
    for link in model.moving_links() {
        let direction = assembly.placement.direction(link);
        let name = &model.link(link).name;
        keep(format!("{name}_cos"), format!("cosine of the direction carried by `{name}`"), direction.x);
        keep(format!("{name}_sin"), format!("sine of the direction carried by `{name}`"), direction.y);
    }
    for (link, angle) in assembly.placement.angles() {
        let name = &model.link(link).name;
        keep(format!("angle_{name}"), format!("angle of `{name}`, rad, with all its turns"), angle);
    }
    for (joint, travel) in assembly.placement.travels() {
        let name = &model.joint(joint).name;
        let unit = Kind::Length.unit(&model.units);
        let what = model.joint(joint).kind.noun();
        keep(format!("travel_{name}"), format!("travel of the {what} `{name}`, {unit}"), travel);
    }
    for (joint, run, between) in assembly.placement.runs() {
        let (name, unit) = (&model.joint(joint).name, Kind::Length.unit(&model.units));
        let [from, to] = between.map(|end| model.end_name(end));
        let what = model.joint(joint).kind.noun();
        keep(format!("run_{name}"), format!("travel of the {what} `{name}` from `{from}` to `{to}`, {unit}"), run);
    }
    for (slot, arm) in assembly.placement.arms() {
        let (name, unit) = (&model.joint(slot).name, Kind::Length.unit(&model.units));
        let meaning = format!(
            "lever arm of the slot `{name}` about its link's pin, {unit}, zero where it is no larger than its rounding"
        );
        keep(format!("arm_{name}"), meaning, arm);
    }
    for pivot in &assembly.dyads {
        let meaning = format!("{}, zero where it is no larger than its rounding", pivot.what);
        keep(pivot.name.clone(), meaning, pivot.value);
        if let Some(cosine) = &pivot.cosine {
            keep(cosine.name.clone(), cosine.what.clone(), cosine.value);
        }
    }
    let all = each_once(all, &model.graph);
    for kept in &all {
        model.graph.name_kept(kept.node, &kept.name);
    }
    all
}

/// The names of what searches seek: they start from a pose.
fn sought(graph: &Graph) -> BTreeSet<String> {
    graph.searches().iter().flat_map(|(_, search)| search.sought.iter().flat_map(Sought::names)).collect()
}

/// What links that are held at one angle share goes by the name by which a search seeks it, otherwise by the first.
fn each_once(all: Vec<Kept>, graph: &Graph) -> Vec<Kept> {
    let sought = sought(graph);
    let mut names: BTreeMap<NodeId, String> = BTreeMap::new();
    for kept in &all {
        let name = names.entry(kept.node).or_insert_with(|| kept.name.clone());
        if sought.contains(&kept.name) {
            name.clone_from(&kept.name);
        }
    }
    all.into_iter().filter(|kept| names.get(&kept.node) == Some(&kept.name)).collect()
}

/// Places, directions and transmission angles.
fn accessors(assembly: &Assembly<'_>) -> Vec<Accessor> {
    let model = assembly.model();
    let placement = &assembly.placement;
    let unit = Kind::Length.unit(&model.units);
    let mut all = Vec::new();
    model.graph.begin_section("");
    for (index, drive) in model.drives.iter().enumerate() {
        let value = assembly.coordinate(DriveId::new(index));
        let meaning = format!("The coordinate of the drive `{}`.", drive.name);
        all.push(Accessor {
            name: drive.name.text.clone(),
            meaning,
            output: Output::scalar(value, Meaning::Coordinate),
        });
    }
    for joint in model.joint_ids() {
        let name = &model.joint(joint).name;
        let meaning = format!("Place of the joint `{name}`, {unit}, ground axes.");
        let output = Output::vector(placement.joint_place(joint), Meaning::Place);
        all.push(Accessor { name: name.text.clone(), meaning, output });
    }
    for link in model.moving_links() {
        let name = &model.link(link).name;
        let meaning = format!("Direction of the x axis of the frame of `{name}`, a unit vector.");
        let output = Output::vector(placement.frame(link), Meaning::Direction);
        all.push(Accessor { name: format!("{name}_direction"), meaning, output });
        for (index, point) in model.link(link).points.iter().enumerate() {
            let end = End { link, point: crate::model::ids::PointId::new(index) };
            let meaning = format!("Place of the point `{}` of `{name}`, {unit}, ground axes.", point.name);
            let output = Output::vector(placement.place(end), Meaning::Place);
            all.push(Accessor { name: format!("{name}_{}", point.name), meaning, output });
        }
    }
    for (joint, travel) in placement.travels().filter(|(joint, _)| model.drive_of(*joint, false).is_none()) {
        let Joint { name, kind, .. } = model.joint(joint);
        let meaning = format!("Travel of the {} `{name}`, {unit}.", kind.noun());
        let output = Output::scalar(travel, Meaning::Length);
        all.push(Accessor { name: format!("travel_{name}"), meaning, output });
    }
    for pivot in &assembly.dyads {
        let mut what = pivot.what.clone();
        what[..1].make_ascii_uppercase();
        let meaning =
            format!("{what}: zero at a dead centre of its dyad, and where it is no larger than its rounding.");
        let output = Output::scalar(pivot.value, pivot.meaning);
        all.push(Accessor { name: pivot.name.clone(), meaning, output });
    }
    all
}

/// A check that fails whatever is given stands for a linkage that works at no pose.
pub(crate) fn check_possible(model: &Model, sink: &Sink) {
    let mut told = BTreeSet::new();
    for guard in model.graph.impossible_guards() {
        use crate::graph::Failure;
        let found = match &guard.failure {
            Failure::CannotAssemble { joint, .. } if !told.insert(joint.clone()) => continue,
            Failure::CannotAssemble { group, joint, .. } => Diagnostic::new(
                joint_place(model, joint),
                format!("{} cannot be assembled at `{joint}`, at any pose", named(group)),
            )
            .note("whatever the drives are, its links are too short or too long to meet there")
            .help("check their lengths, and where the joints are on which they hang"),
            // Nothing is known of what a search leaves open.
            Failure::NoConvergence { .. } => continue,
            Failure::CoincidentPivots { group, joint } => Diagnostic::new(
                joint_place(model, joint),
                format!(
                    "the outer joints of {} coincide at every pose: the place of `{joint}` is undetermined",
                    named(group)
                ),
            ),
            Failure::DeadCentre { group, pivot } => match scene_of_advantage(model, group) {
                Some(scene) => Diagnostic::new(
                    scene.name.place(),
                    format!("at every pose, there is no advantage over `{group}`: `{pivot}` is zero"),
                )
                .note("the load does no work on the motion of that effort, whatever the pose")
                .help("leave out the result that asks for it"),
                None => Diagnostic::new(
                    model.unknowns.first().map_or(model.name.place(), |u| u.place),
                    format!("at every pose, nothing holds {}: `{pivot}` is zero", named(group)),
                )
                .note("the unknown does no work on the motion that the loads drive, whatever the pose")
                .help("let it act on a coordinate that changes when the drive moves"),
            },
            Failure::NoDirection { of } => {
                let directed = |wanted: &Wanted| matches!(wanted, Wanted::Offset(_) | Wanted::Resolved(_, Along::Path));
                let asks = |scene: &&Scene| scene.results.iter().any(directed);
                let scene = scene_of_advantage(model, of).or_else(|| model.scenes.iter().find(asks));
                let place = scene.map_or(model.name.place(), |scene| scene.name.place());
                Diagnostic::new(place, format!("{of} vanishes at every pose: it has no direction"))
                    .help("leave out the result that asks for it")
            }
            Failure::CoincidentEnds { of } => {
                let load = model.loads.iter().find(|load| load.name.text == *of).map(|load| load.name.place());
                let unknown = model.unknowns.iter().find(|unknown| unknown.name == *of).map(|unknown| unknown.place);
                Diagnostic::new(
                    load.or(unknown).unwrap_or(model.name.place()),
                    format!("the two points of `{of}` coincide at every pose: it has no direction"),
                )
                .help("let it act between points that are apart")
            }
            Failure::OtherSide { joint } => {
                let place = model.scenes.first().map_or(model.name.place(), |scene| scene.name.place());
                Diagnostic::new(place, format!("at every pose that is reached, `{joint}` lies on the other side"))
                    .note("a pose counts if the groups that the drives move close there on the sides that are chosen for them")
                    .help("choose the other side for one of the groups")
            }
            Failure::Parameter { requirement } => Diagnostic::new(model.name.place(), requirement.clone()),
        };
        sink.report(found);
    }
}

/// Defaults with which the linkage cannot be prepared.
fn check_defaults(model: &Model, sink: &Sink) {
    let graph = &model.graph;
    let mut told = BTreeSet::new();
    for guard in graph.guards() {
        let crate::graph::Failure::Parameter { requirement } = &guard.failure else { continue };
        let [value, limit] = guard.condition.operands();
        let read = graph.parameters_of(&[value, limit]);
        let default = |id: &ParamId| model.param(*id).default.and_then(|node| graph.constant_value(node));
        let (Some(first), true) = (read.first(), read.iter().all(|id| default(id).is_some())) else { continue };
        let known = |symbol| match symbol {
            Symbol::Parameter(id) => default(&id).map_or(f64::NAN, |number| number.to_f64()),
            _ => f64::NAN,
        };
        let mut done = NodeValues::default();
        let (value, limit) = (graph.evaluate(value, &known, &mut done), graph.evaluate(limit, &known, &mut done));
        // What comes of a root of less than zero or of a quotient by zero is told where that is asked.
        let is_number = [value, limit].into_iter().all(f64::is_finite);
        if is_number && !guard.condition.holds(&value, &limit) && told.insert(requirement.clone()) {
            let names: Vec<&str> = read.iter().map(|id| model.param(*id).name.text.as_str()).collect();
            let (s, it) = if names.len() == 1 { ("", "the default") } else { ("s", "a default") };
            let problem = format!("{requirement}, which is not so with the default{s} of {}", list(&names));
            sink.report(
                Diagnostic::new(model.param(*first).name.place(), problem)
                    .help(format!("change {it}, or leave it out")),
            );
        }
    }
}

/// The scene that asks for the mechanical advantage over a load of this name.
fn scene_of_advantage<'m>(model: &'m Model, load: &str) -> Option<&'m Scene> {
    let is_asked = |wanted: &Wanted| matches!(wanted, Wanted::Advantage(own) if model.load(*own).name.text == load);
    model.scenes.iter().find(|scene| scene.results.iter().any(is_asked))
}

/// The links of a group as it is named in failures: `a + b`.
fn named(group: &str) -> String {
    list(&group.split(" + ").collect::<Vec<_>>())
}

fn joint_place(model: &Model, name: &str) -> crate::diagnostics::Place {
    let joint = model.joints.iter().find(|j| j.name.text == name);
    joint.map_or(model.name.place(), |j| j.name.place())
}

/// The name of a joint, for headings.
fn joint_name(model: &Model, joint: JointId) -> &str {
    &model.joint(joint).name.text
}
