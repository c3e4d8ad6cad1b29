//! [`Model`] in, [`Topology`] out: the links split into Assur groups, in the order in which they are solved.
//!
//! Motion and forces have a decomposition each. For motion the drives are given, and a group is the smallest set of links whose
//! places follow from those of the groups before it. For forces the linkage is seen from where its unknowns act: each unknown
//! stands for a constraint that would hold its coordinate, and the groups are solved in the opposite order. Where the unknowns
//! act at the drives, the two coincide.
//!
//! Afterwards every group is regular at generic poses: it has as many constraints as freedoms, and they are independent.

mod generic;
mod matching;
mod mobility;
mod redundant;
mod sides;

use std::collections::BTreeSet;

use crate::diagnostics::{Diagnostic, Sink, list};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId, UnknownId};
use crate::model::{JointKind, Model, Unknown, UnknownKind};

/// What closes a decomposition beside the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Input {
    /// A known motion.
    Drive(DriveId),
    /// An unknown effort.
    Unknown(UnknownId),
}

impl From<UnknownId> for Input {
    fn from(unknown: UnknownId) -> Self {
        Self::Unknown(unknown)
    }
}

impl Input {
    /// The effort that it is, or that a drive needs.
    #[must_use]
    pub fn effort(self, model: &Model) -> UnknownKind {
        match self {
            Self::Drive(drive) => UnknownKind::Drive(drive),
            Self::Unknown(unknown) => model.unknown(unknown).kind,
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(self, model: &Model) -> &str {
        match self {
            Self::Drive(drive) => &model.drive(drive).name.text,
            Self::Unknown(unknown) => &model.unknown(unknown).name,
        }
    }
}

/// What a joint leaves its links, the drives of its group counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Nothing: a weld, or a joint whose coordinates are all driven. Its links are one body.
    None,
    /// To turn: a pin, and one in a slot along which it is driven.
    Turn,
    /// To slide: a slide, and a slot in which the pin's link is turned by a drive.
    Slide,
    /// Both: a slot.
    TurnAndSlide,
    /// To roll: a gear pair.
    Roll,
}

/// An Assur group, or a driven link.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its links, in the order of their declaration.
    pub links: Vec<LinkId>,
    /// Joints between its links.
    pub inner: Vec<JointId>,
    /// Joints to links of groups before it, or to the ground.
    pub outer: Vec<JointId>,
    /// Drives or unknowns that close it.
    pub inputs: Vec<Input>,
}

impl Group {
    /// The link of an outer joint that belongs to the group.
    #[must_use]
    pub fn own_link(&self, model: &Model, joint: JointId) -> LinkId {
        let joint = model.joint(joint);
        if self.links.contains(&joint.from.link) { joint.from.link } else { joint.to.link }
    }

    /// The drive that an input stands for: itself, or that whose effort is the unknown.
    #[must_use]
    pub fn drive_of(model: &Model, input: Input) -> Option<DriveId> {
        match input {
            Input::Drive(drive) => Some(drive),
            Input::Unknown(unknown) => match model.unknown(unknown).kind {
                UnknownKind::Drive(drive) => Some(drive),
                UnknownKind::Torque(..) | UnknownKind::Force { .. } | UnknownKind::Thrust(_) => None,
            },
        }
    }

    /// What one of its joints leaves free.
    #[must_use]
    pub fn freedom(&self, model: &Model, joint: JointId) -> Freedom {
        let drives = || self.inputs.iter().filter_map(|input| Self::drive_of(model, *input)).map(|d| model.drive(d));
        let driven = |turns: bool| drives().any(|drive| drive.joint == joint && drive.turns == turns);
        match model.joint(joint).kind {
            JointKind::Revolute if driven(true) => Freedom::None,
            JointKind::Revolute => Freedom::Turn,
            JointKind::Prismatic { .. } if driven(false) => Freedom::None,
            JointKind::Prismatic { .. } => Freedom::Slide,
            JointKind::Weld { .. } => Freedom::None,
            JointKind::Slot { .. } => match (driven(true), driven(false)) {
                (true, true) => Freedom::None,
                (false, true) => Freedom::Turn,
                (true, false) => Freedom::Slide,
                (false, false) => Freedom::TurnAndSlide,
            },
            JointKind::Gear(_) => Freedom::Roll,
        }
    }

    /// Whether it is a gear train: wheels and arms on a pin each, with a gear pair or a drive for each.
    #[must_use]
    pub fn is_train(&self, model: &Model) -> bool {
        let joints = || self.outer.iter().chain(&self.inner);
        let count = |kind: fn(&JointKind) -> bool| joints().filter(|joint| kind(&model.joint(**joint).kind)).count();
        let gears = count(|kind| matches!(kind, JointKind::Gear(_)));
        let pins = count(|kind| matches!(kind, JointKind::Revolute));
        let turned = self.inputs.iter().all(|input| match input {
            Input::Drive(drive) => model.drive(*drive).turns,
            Input::Unknown(_) => true,
        });
        let size = self.links.len();
        gears > 0 && turned && pins == size && gears + self.inputs.len() == size && gears + pins == joints().count()
    }

    /// Its kinds of joints in the order outer, inner, …: `RRP`.
    #[must_use]
    pub fn letters(&self, model: &Model) -> String {
        let letter = |joint: &JointId| match model.joint(*joint).kind {
            JointKind::Revolute => 'R',
            JointKind::Prismatic { .. } => 'P',
            JointKind::Weld { .. } => 'W',
            JointKind::Slot { .. } => 'S',
            JointKind::Gear(_) => 'G',
        };
        self.outer.iter().chain(&self.inner).map(letter).collect()
    }
}

/// The groups of a linkage.
#[derive(Debug)]
pub struct Topology {
    /// In the order in which motion goes.
    pub motion: Vec<Group>,
    /// From the unknowns outwards; forces are solved in the opposite order.
    pub forces: Vec<Group>,
}

/// A scalar constraint: between which moving links, and what it comes from.
#[derive(Clone, Debug)]
struct Constraint {
    links: Vec<LinkId>,
    origin: Origin,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Joint(JointId, usize),
    Input(Input),
}

impl Topology {
    /// The links of which gears tell the angle, though drives alone do not: wheels that other links turn, and what a fixed or driven angle
    /// joins to one.
    #[must_use]
    pub fn geared(&self, model: &Model) -> BTreeSet<LinkId> {
        let mut found = BTreeSet::new();
        for group in &self.motion {
            let gears = group.outer.iter().chain(&group.inner).filter_map(|joint| match model.joint(*joint).kind {
                JointKind::Gear(gear) => Some((*joint, gear)),
                _ => None,
            });
            for (joint, gear) in gears {
                let [a, b] = model.joint(joint).ends().map(|end| end.link);
                let geared = [a, b, gear.arm[0].link].into_iter().filter(|link| group.links.contains(link));
                found.extend(geared);
            }
            if group.is_train(model) {
                found.extend(group.links.iter().copied());
            }
        }
        let turns =
            |joint: &JointId| model.joint(*joint).kind.turn().is_some() || model.drive_of(*joint, true).is_some();
        let joined: Vec<[LinkId; 2]> =
            model.joint_ids().filter(turns).map(|joint| model.joint(joint).ends().map(|end| end.link)).collect();
        while let Some(next) = joined.iter().find_map(|ends| match ends.map(|link| found.contains(&link)) {
            [true, false] => Some(ends[1]),
            [false, true] => Some(ends[0]),
            _ => None,
        }) {
            found.insert(next);
        }
        found.retain(|link| model.driven_angle(GROUND, *link).is_none());
        found
    }

    /// Splits a linkage into groups. `None` if that is not possible; why is reported.
    pub fn of(model: &Model, sink: &Sink) -> Option<Self> {
        let drives: Vec<Input> = (0..model.drives.len()).map(|d| Input::Drive(DriveId::new(d))).collect();
        if !mobility::check(model, sink) || !mobility::check_unknowns(model, sink) {
            return None;
        }
        let motion = decompose(model, &drives, sink)?;
        let unknowns: Vec<Input> = (0..model.unknowns.len()).map(|u| Input::Unknown(UnknownId::new(u))).collect();
        let at_drives = model.unknowns.iter().all(|u| matches!(u.kind, UnknownKind::Drive(_)));
        let forces = if at_drives { as_forces(model, &motion) } else { decompose(model, &unknowns, sink)? };
        Some(Self { motion, forces })
    }
}

/// The groups of motion as groups of forces: the drives' efforts are the unknowns.
fn as_forces(model: &Model, motion: &[Group]) -> Vec<Group> {
    let effort = |input: &Input| match input {
        Input::Drive(drive) => model.effort_at(*drive).map_or(*input, Input::Unknown),
        Input::Unknown(_) => *input,
    };
    motion.iter().map(|group| Group { inputs: group.inputs.iter().map(effort).collect(), ..group.clone() }).collect()
}

fn constraints(model: &Model, inputs: &[Input]) -> Vec<Constraint> {
    let moving = |links: &[LinkId]| links.iter().copied().filter(|l| *l != GROUND).collect::<Vec<_>>();
    let mut all = Vec::new();
    for joint in model.joint_ids() {
        let links = moving(&model.joint(joint).ends().map(|end| end.link));
        for row in 0..generic::rows_of(model, joint) {
            all.push(Constraint { links: links.clone(), origin: Origin::Joint(joint, row) });
        }
    }
    for input in inputs {
        all.push(Constraint { links: moving(&links_of(model, *input)), origin: Origin::Input(*input) });
    }
    all
}

/// The links on which a drive or an unknown acts.
fn links_of(model: &Model, input: Input) -> Vec<LinkId> {
    model.links_of(input.effort(model))
}

fn decompose(model: &Model, inputs: &[Input], sink: &Sink) -> Option<Vec<Group>> {
    let constraints = constraints(model, inputs);
    let graph: Vec<Vec<LinkId>> = constraints.iter().map(|c| c.links.clone()).collect();
    let matched = match matching::assign(model.links.len(), &graph) {
        Ok(matched) => matched,
        Err(unbalanced) => {
            sink.report(mobility::unbalanced(model, &constraints, inputs, &unbalanced));
            return None;
        }
    };
    let groups: Vec<Group> = matching::components(model.links.len(), &graph, &matched)
        .into_iter()
        .map(|links| group(model, &constraints, &matched, links))
        .collect();
    let singular = groups.iter().find_map(|group| {
        let rank = generic::rank_of(model, group);
        (rank < 3 * group.links.len()).then_some((group, rank))
    });
    if let Some((group, rank)) = singular {
        sink.report(singular_group(model, group, rank));
        return None;
    }
    Some(groups)
}

fn group(model: &Model, constraints: &[Constraint], matched: &[LinkId], links: Vec<LinkId>) -> Group {
    let own: BTreeSet<LinkId> = links.iter().copied().collect();
    let mut group = Group { links, inner: Vec::new(), outer: Vec::new(), inputs: Vec::new() };
    for (constraint, owner) in constraints.iter().zip(matched) {
        if !own.contains(owner) {
            continue;
        }
        match constraint.origin {
            Origin::Joint(joint, 0) => {
                let both = model.joint(joint).ends().iter().all(|end| own.contains(&end.link));
                if both { group.inner.push(joint) } else { group.outer.push(joint) }
            }
            Origin::Joint(..) => {}
            Origin::Input(input) => group.inputs.push(input),
        }
    }
    group
}

/// The count is right, and yet the group's constraints are dependent at every pose.
fn singular_group(model: &Model, group: &Group, rank: usize) -> Diagnostic {
    let names: Vec<&str> = group.links.iter().map(|l| model.link(*l).name.text.as_str()).collect();
    let elsewhere = group.inputs.iter().find_map(|input| match input {
        Input::Unknown(unknown) => Some(model.unknown(*unknown)).filter(|u| !matches!(u.kind, UnknownKind::Drive(_))),
        Input::Drive(_) => None,
    });
    if let Some(unknown) = elsewhere {
        return powerless(model, unknown, &names);
    }
    let joints: Vec<JointId> = group.outer.iter().chain(&group.inner).copied().collect();
    let joint_names: Vec<&str> = joints.iter().map(|j| model.joint(*j).name.text.as_str()).collect();
    let freedoms = 3 * group.links.len();
    let place = model.link(group.links[0]).name.place();
    let problem = format!("the joints {} cannot place {} at any pose", list(&joint_names), list(&names));
    let found = Diagnostic::new(place, problem).note(format!(
        "{freedoms} constraints for {freedoms} freedoms, but only {rank} of them independent: the linkage is held twice here, and loose elsewhere"
    ));
    if let Some(help) = pinned_twice(model, &joints) {
        return found.help(help);
    }
    match redundant::find(model) {
        Some(redundant) => found.note(redundant.reason()).help(redundant.release()),
        None => found.help("take out a joint that repeats another one, or turn a slider so that it guides another way"),
    }
}

/// What to do about two pins between the same two links, if there are such.
fn pinned_twice(model: &Model, joints: &[JointId]) -> Option<String> {
    let pinned = |joint: JointId| {
        let joint = model.joint(joint);
        let [a, b] = joint.ends().map(|end| end.link);
        matches!(joint.kind, JointKind::Revolute).then_some([a.min(b), a.max(b)])
    };
    let (links, first, second) = joints.iter().enumerate().find_map(|(index, first)| {
        let links = pinned(*first)?;
        let second = joints[index + 1..].iter().find(|second| pinned(**second) == Some(links))?;
        Some((links, &model.joint(*first).name, &model.joint(*second).name))
    })?;
    let [a, b] = links.map(|link| &model.link(link).name);
    Some(format!(
        "the pins `{first}` and `{second}` make one rigid body of `{a}` and `{b}`: declare it as one link, or take one pin out"
    ))
}

/// An unknown that does no work at any pose.
fn powerless(model: &Model, unknown: &Unknown, links: &[&str]) -> Diagnostic {
    let name = &unknown.name;
    let reason = match unknown.kind {
        UnknownKind::Torque(from, to) => {
            let (from, to) = (&model.link(from).name, &model.link(to).name);
            format!("the linkage moves without turning `{to}` against `{from}`")
        }
        UnknownKind::Force { at, .. } => {
            format!("the linkage moves without moving `{}` along its line", model.end_name(at))
        }
        UnknownKind::Thrust([first, second]) => {
            let (first, second) = (model.end_name(first), model.end_name(second));
            format!("the linkage moves without changing the distance of `{first}` and `{second}`")
        }
        UnknownKind::Drive(_) => "the linkage moves without it".to_owned(),
    };
    Diagnostic::new(unknown.place, format!("the unknown `{name}` cannot hold {} at any pose", list(links)))
        .note(format!("{reason}: no size of it balances a load"))
        .help("let it act on a coordinate that changes when the drive moves")
}
