//! [`Topology`] and [`System`] in, [`Plan`] out: every group solved by its rule, every scene's results as expressions.
//!
//! Afterwards each result is a node of the graph, reduced by division through named pivots only. What a function needs of it is taken
//! out later, by demand.

mod assembly;
mod balance;
mod framed;
mod half_angle;
mod linear;
mod output;
mod pivots;
mod placement;
pub mod rules;
mod scenes;
mod velocities;

pub use assembly::Assembly;
pub use balance::Balance;
pub use output::{Comparison, Field, Meaning, Output};
pub use pivots::Pivots;
pub use placement::Placement;
pub use velocities::Motion;

use std::collections::BTreeSet;

use crate::diagnostics::{Diagnostic, Sink, list};
use crate::equations::System;
use crate::graph::{Coordinate, Expr, NodeId, Op};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId};
use crate::model::units::Kind;
use crate::model::{End, Model, Pair};
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
}

impl PlacedLink {
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
    /// Solves a linkage. `None` if that is not possible; why is reported.
    #[must_use]
    pub fn of(model: &Model, topology: &Topology, system: &System, sink: &Sink) -> Option<Self> {
        let motion_rules = rules_of(model, &topology.motion, "place", rules::placing_rule, sink)?;
        let force_rules = rules_of(model, &topology.forces, "find the forces of", rules::force_rule, sink)?;
        let mut assembly = Assembly::new(model, topology);
        for (index, (group, rule)) in topology.motion.iter().zip(&motion_rules).enumerate() {
            model.graph.begin_section(heading(model, index, group, rule.class(), "position"));
            if let Err(error) = rule.place(&mut assembly, group) {
                sink.report(error);
                // What is chosen at a group that has an error is no second one.
                for joint in &group.inner {
                    assembly.closure(*joint);
                }
            }
        }
        for closure in assembly.unused_closures() {
            let joint = &model.joint(closure.joint).name;
            sink.report(
                Diagnostic::new(closure.place, format!("there is nothing to choose at `{joint}`"))
                    .note("a side is chosen at the inner joint of a dyad: at the joint between its two links")
                    .help("leave it out"),
            );
        }
        if !sink.is_clean() {
            return None;
        }
        let links = placed_links(&assembly);
        let plan = Self {
            pose: kept(&assembly),
            accessors: accessors(&assembly),
            scenes: scenes::outputs(&assembly, &force_rules, (system, &links), sink),
            links,
            motion_rules: motion_rules.iter().map(|rule| rule.class()).collect(),
            force_rules: force_rules.iter().map(|rule| rule.class()).collect(),
        };
        check_possible(model, sink);
        sink.is_clean().then_some(plan)
    }
}

type Rules = Vec<&'static dyn rules::Rule>;

type Choice = fn(&Model, &Group) -> Option<&'static dyn rules::Rule>;

fn rules_of(model: &Model, groups: &[Group], what: &str, choose: Choice, sink: &Sink) -> Option<Rules> {
    let mut found = Vec::new();
    for group in groups {
        match choose(model, group) {
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
        .help("supported are links on one pin or one slide, and RRR, RRP, RPR, PRP and RPP dyads: another drive or unknown may split the linkage so")
}

/// The heading of a group's steps.
fn heading(model: &Model, index: usize, group: &Group, class: &str, what: &str) -> String {
    let joints = group.outer.iter().chain(&group.inner).map(|j| model.joint(*j).name.text.as_str());
    let joints = joints.collect::<Vec<_>>().join(", ");
    format!("Group {}, {class}: {} ({joints}): {what}", index + 1, model.link_names(&group.links))
}

fn placed_links(assembly: &Assembly<'_>) -> Vec<PlacedLink> {
    let placement = &assembly.placement;
    let place = |link: LinkId| PlacedLink {
        origin: placement.origin(link).into(),
        direction: placement.frame(link).into(),
        angle: angle(assembly, link).id(),
    };
    (0..assembly.model().links.len()).map(LinkId::new).map(place).collect()
}

/// Directions, travels and pivots, each once; what is constant is not kept.
fn kept(assembly: &Assembly<'_>) -> Vec<Kept> {
    let model = assembly.model();
    let mut all: Vec<Kept> = Vec::new();
    let mut keep = |name: String, meaning: String, value: Expr<'_>| {
        if matches!(value.op(), Op::Held(_)) && all.iter().all(|kept| kept.node != value.id()) {
            model.graph.name_kept(value, &name);
            all.push(Kept { name, meaning, node: value.id() });
        }
    };
    for link in model.moving_links() {
        let direction = assembly.placement.direction(link);
        let name = &model.link(link).name;
        keep(format!("{name}_cos"), format!("cosine of the direction carried by `{name}`"), direction.x);
        keep(format!("{name}_sin"), format!("sine of the direction carried by `{name}`"), direction.y);
    }
    for (joint, travel) in assembly.placement.travels() {
        let name = &model.joint(joint).name;
        let unit = Kind::Length.unit(&model.units);
        keep(format!("travel_{name}"), format!("travel of the slide `{name}`, {unit}"), travel);
    }
    for pivot in &assembly.dyads {
        let meaning = format!("{}, zero where it is no larger than its rounding", pivot.what);
        keep(pivot.name.clone(), meaning, pivot.value);
    }
    all
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
        let output = Output::vector(placement.place(model.joint(joint).place()), Meaning::Place);
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

/// The angle of a link: of one that is driven from the ground the drive's own value, of others from the direction of its frame.
fn angle<'m>(assembly: &Assembly<'m>, link: LinkId) -> Expr<'m> {
    let model = assembly.model();
    let driven =
        assembly.topology.motion.iter().find_map(|group| match (group.links.as_slice(), group.inputs.as_slice()) {
            ([own], [Input::Drive(drive)]) if *own == link => {
                let joint = model.joint(model.drive(*drive).joint);
                let from_ground = matches!(joint.kind, crate::model::JointKind::Revolute)
                    && joint.end_off(link).is_some_and(|end| end.link == GROUND);
                let value = assembly.coordinate(*drive);
                from_ground.then_some(if joint.to.link == link { value } else { -value })
            }
            _ => None,
        });
    driven.unwrap_or_else(|| {
        let frame = assembly.placement.frame(link);
        assembly.graph().atan2(frame.y, frame.x)
    })
}

/// A check that fails whatever is given stands for a linkage that works at no pose.
fn check_possible(model: &Model, sink: &Sink) {
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
            Failure::CoincidentPivots { group, joint } => Diagnostic::new(
                joint_place(model, joint),
                format!(
                    "the outer joints of {} coincide at every pose: the place of `{joint}` is undetermined",
                    named(group)
                ),
            ),
            Failure::DeadCentre { group, pivot } => Diagnostic::new(
                model.unknowns.first().map_or(model.name.place(), |u| u.place),
                format!("at every pose, nothing holds {}: `{pivot}` is zero", named(group)),
            )
            .note("the unknown does no work on the motion that the loads drive, whatever the pose"),
            Failure::Parameter { requirement } => Diagnostic::new(model.name.place(), requirement.clone()),
        };
        sink.report(found);
    }
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
