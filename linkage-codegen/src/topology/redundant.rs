//! Constraints that say the same: linkages that move only because of their special dimensions, such as a bar on three parallel cranks.
//!
//! Counting takes them to be rigid. A pose with the declared dimensions shows whether the constraints depend on each other there, and
//! another one near to it, reached along the motion that they leave, that this is no accident of the first.

use std::collections::BTreeSet;

use crate::diagnostics::{Diagnostic, list};
use crate::equations::Source;
use crate::equations::joints::Component;
use crate::equations::poses::{Line, Pose, Poses, Random, moved, rank_and_kernel};
use crate::model::ids::{GROUND, JointId, LinkId};
use crate::model::{End, JointKind, Model};

/// Poses from which one that closes is looked for.
const STARTS: u64 = 24;
/// Poses without anything redundant that are enough.
const REGULAR: usize = 3;
/// How far the linkage is moved, in its lengths.
const MOVED: f64 = 0.05;
/// A part of a dependency that is smaller than this is none.
const SHARE: f64 = 1e-6;

/// What a linkage has too much of.
pub(super) struct Redundant<'m> {
    model: &'m Model,
    /// Freedoms that it has.
    pub(super) mobility: usize,
    constraints: usize,
    /// Constraints that say what others say.
    surplus: usize,
    /// The joints that share them, and by which components.
    shared: Vec<(JointId, Component)>,
    /// Each of these joints could go.
    joints: Vec<JointId>,
    /// Each of these links could go, with its joints.
    links: Vec<LinkId>,
    /// A pin that may slide, and the points of its link along which.
    slot: Option<(JointId, [End; 2])>,
}

/// What a linkage has too much of, if it moves all the same; `None` if that is not so, or cannot be told.
pub(super) fn find(model: &Model) -> Option<Redundant<'_>> {
    let poses = Poses::of(model)?;
    let links: Vec<LinkId> = model.moving_links().collect();
    let mut regular = 0;
    for seed in 0..STARTS {
        let Some(pose) = poses.closed(poses.anywhere(&mut Random::new(seed)), &links) else { continue };
        let at = Constraints::at(&poses, &pose, &links);
        if at.rank() == at.lines.len() {
            regular += 1;
            if regular == REGULAR {
                return None;
            }
            continue;
        }
        if let Some(at) = at.elsewhere(&poses, &pose, &links) {
            return Some(at.redundant(model, &links));
        }
    }
    None
}

/// The constraints of the joints in a pose.
struct Constraints {
    lines: Vec<(JointId, Component, Line)>,
    columns: usize,
}

impl Constraints {
    fn at(poses: &Poses<'_>, pose: &Pose, links: &[LinkId]) -> Self {
        let of_joint = |(source, _, line): (Source, f64, Line)| match source {
            Source::Joint(joint, component) => Some((joint, component, line)),
            Source::Drive(_) | Source::Unknown(_) => None,
        };
        let lines = poses.lines(pose, links).into_iter().filter_map(of_joint).collect();
        Self { lines, columns: 3 * links.len() }
    }

    fn matrix(&self) -> Vec<Line> {
        self.lines.iter().map(|(.., line)| line.clone()).collect()
    }

    fn rank(&self) -> usize {
        rank_and_kernel(self.matrix(), self.columns).0
    }

    /// The constraints somewhat further on, if the linkage moves there and nothing else holds it.
    fn elsewhere(&self, poses: &Poses<'_>, pose: &Pose, links: &[LinkId]) -> Option<Self> {
        let (rank, kernel) = rank_and_kernel(self.matrix(), self.columns);
        let mut way = vec![0.0; self.columns];
        for (index, vector) in (0u8..).zip(&kernel) {
            let weight = 1.0 / (1.0 + 0.4 * f64::from(index));
            way.iter_mut().zip(vector).for_each(|(sum, part)| *sum += weight * part);
        }
        let size = way.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        if size == 0.0 {
            return None;
        }
        way.iter_mut().for_each(|x| *x *= MOVED * poses.length() / size);
        let next = poses.closed(moved(pose, links, &way, poses.length()), links)?;
        let parts = pose.0.iter().zip(&next.0);
        let gone = parts.fold(0.0f64, |most, (a, b)| {
            most.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs()).max((a[2] - b[2]).abs() * poses.length())
        });
        let at = Self::at(poses, &next, links);
        let moves = gone > 0.3 * MOVED * poses.length() && gone < 3.0 * MOVED * poses.length();
        (moves && at.rank() == rank).then_some(at)
    }

    /// Rank and number of what is left of the constraints without those of some joints, and of the freedoms without some links.
    fn without(&self, keeps: &dyn Fn(JointId) -> bool, gone: Option<usize>) -> (usize, usize) {
        let columns: Vec<usize> = (0..self.columns).filter(|column| Some(column / 3) != gone).collect();
        let lines = self.lines.iter().filter(|(joint, ..)| keeps(*joint));
        let matrix: Vec<Line> = lines.map(|(.., line)| columns.iter().map(|column| line[*column]).collect()).collect();
        let count = matrix.len();
        (rank_and_kernel(matrix, columns.len()).0, count)
    }

    fn redundant<'m>(&self, model: &'m Model, links: &[LinkId]) -> Redundant<'m> {
        let (rank, constraints) = (self.rank(), self.lines.len());
        let (mobility, surplus) = (self.columns - rank, constraints - rank);
        // Forces that balance each other without any load.
        let transposed = (0..self.columns).map(|column| self.lines.iter().map(|(.., line)| line[column]).collect());
        let (_, prestress) = rank_and_kernel(transposed.collect(), constraints);
        let takes_part = |index: usize| {
            prestress.iter().any(|forces| {
                let size = forces.iter().fold(0.0f64, |most, force| most.max(force.abs()));
                forces[index].abs() > SHARE * size
            })
        };
        let shared: Vec<(JointId, Component)> =
            (0..constraints).filter(|i| takes_part(*i)).map(|i| (self.lines[i].0, self.lines[i].1)).collect();
        let driven = |joint: JointId| is_driven(model, joint);
        let share: BTreeSet<JointId> = shared.iter().map(|(joint, _)| *joint).collect();
        let joints = share.iter().copied().filter(|joint| !driven(*joint));
        let joints = joints.filter(|joint| self.without(&|other| other != *joint, None).0 == rank).collect();
        let can_go = |index: usize, link: LinkId| {
            let own = |joint: JointId| model.joint(joint).end_on(link).is_some();
            let (left, count) = self.without(&|joint| !own(joint), Some(index));
            let moves = self.columns - 3 - left;
            !model.joint_ids().any(|joint| own(joint) && driven(joint)) && moves == mobility && count - left < surplus
        };
        let links: Vec<LinkId> =
            links.iter().enumerate().filter(|(index, link)| can_go(*index, **link)).map(|(_, link)| *link).collect();
        let slot = links.iter().rev().find_map(|link| self.slot(model, *link, (rank, &share)));
        Redundant { model, mobility, constraints, surplus, shared, joints, links, slot }
    }

    /// Of a link on two pins that of the pins which may slide along it: then nothing else is lost.
    fn slot(
        &self,
        model: &Model,
        link: LinkId,
        (rank, share): (usize, &BTreeSet<JointId>),
    ) -> Option<(JointId, [End; 2])> {
        let own: Vec<JointId> = model.joint_ids().filter(|joint| model.joint(*joint).end_on(link).is_some()).collect();
        let [a, b] = own.as_slice() else { return None };
        let pin = |joint: JointId| matches!(model.joint(joint).kind, JointKind::Revolute) && share.contains(&joint);
        if !pin(*a) || !pin(*b) {
            return None;
        }
        let grounded = |joint: JointId| model.joint(joint).end_on(GROUND).is_some();
        let [fixed, freed] = if grounded(*b) { [*b, *a] } else { [*a, *b] };
        let [first, second] = [fixed, freed].map(|joint| model.joint(joint).end_on(link));
        let (first, second) = (first?, second?);
        if model.distance(link, first.point, second.point).is_zero() {
            return None;
        }
        // The force that the slot no longer takes is one of those that balance each other, so that all others stay.
        let without = self.without(&|joint| joint != freed, None).0;
        (without + 1 == rank || without == rank).then_some((freed, [first, second]))
    }
}

impl Redundant<'_> {
    /// The linkage as a whole is refused for it.
    pub(super) fn report(&self, counts: String) -> Diagnostic {
        let model = self.model;
        let joint = self.joints.last().or(self.shared.last().map(|(joint, _)| joint));
        let link = self.links.last().filter(|_| self.joints.is_empty() && !self.is_of_couples());
        let place = match (link, joint) {
            (Some(link), _) => model.link(*link).name.place(),
            (None, Some(joint)) => model.joint(*joint).name.place(),
            (None, None) => model.name.place(),
        };
        // Slides alone keep each other's links from turning whatever their directions are.
        let why = if self.is_of_couples() { "all the same" } else { "only because of its special dimensions" };
        Diagnostic::new(
            place,
            format!("{}: the linkage moves {why}, and its reactions have no single answer", self.problem()),
        )
        .note(counts)
        .note(self.reason())
        .help(self.release())
    }

    /// Whether nothing but couples is shared: the links are kept from turning too often.
    fn is_of_couples(&self) -> bool {
        self.shared.iter().all(|(_, component)| *component == Component::Couple)
    }

    fn shared_joints(&self) -> Vec<&str> {
        let joints: BTreeSet<JointId> = self.shared.iter().map(|(joint, _)| *joint).collect();
        joints.into_iter().map(|joint| self.model.joint(joint).name.text.as_str()).collect()
    }

    /// The joints or links that could go.
    fn candidates(&self) -> Vec<&str> {
        let model = self.model;
        if !self.joints.is_empty() {
            self.joints.iter().map(|joint| model.joint(*joint).name.text.as_str()).collect()
        } else if !self.links.is_empty() && !self.is_of_couples() {
            self.links.iter().map(|link| model.link(*link).name.text.as_str()).collect()
        } else {
            self.shared_joints()
        }
    }

    fn problem(&self) -> String {
        let names = self.candidates();
        let all = list(&names);
        let number = number(self.surplus);
        if !self.joints.is_empty() || !self.links.is_empty() && !self.is_of_couples() {
            return match (names.len(), self.surplus) {
                (1, _) => format!("{all} is redundant"),
                (_, 1) => format!("one of {all} is redundant"),
                (count, surplus) if count <= surplus => format!("{all} are redundant"),
                _ => format!("{number} of {all} are redundant"),
            };
        }
        let constraints = if self.surplus == 1 { "constraint" } else { "constraints" };
        if self.is_of_couples() {
            return format!("{all} keep their links from turning, by {number} {constraints} too many");
        }
        format!("{all} hold their links by {number} {constraints} too many")
    }

    /// Why.
    pub(super) fn reason(&self) -> String {
        format!(
            "of the {} constraints {} are independent, and its true mobility is {}: the reactions of {} balance each other in any size",
            self.constraints,
            self.constraints - self.surplus,
            self.mobility,
            list(&self.shared_joints())
        )
    }

    /// What to do.
    pub(super) fn release(&self) -> String {
        let model = self.model;
        let names = self.candidates();
        let number = number(self.surplus.min(names.len()));
        let couples: Vec<&str> = {
            let of_couple = |(joint, component): &(JointId, Component)| match model.joint(*joint).kind {
                JointKind::Prismatic { .. } if *component == Component::Couple && !is_driven(model, *joint) => {
                    Some(model.joint(*joint).name.text.as_str())
                }
                _ => None,
            };
            self.shared.iter().filter_map(of_couple).collect()
        };
        let mut ways = Vec::new();
        let some = if names.len() == 1 { list(&names) } else { format!("{number} of {}", list(&names)) };
        if !self.joints.is_empty() {
            ways.push(format!("take {some} out"));
        } else if !self.links.is_empty() && !self.is_of_couples() {
            let its = if self.surplus == 1 { "its" } else { "their" };
            ways.push(format!("take {some} out, with {its} joints"));
        }
        if let Some((pin, [first, second])) = self.slot {
            let joint = model.joint(pin);
            let end = |end: End| {
                let link = &model.link(end.link).name;
                if *model.point_name(end) == joint.name.text { link.text.clone() } else { model.end_name(end) }
            };
            let each = if self.surplus == 1 { "" } else { ", and likewise at another one" };
            ways.push(format!(
                "let a pin slide where it need not hold: in place of `revolute {}` write{each}\nslot {}: {} -> {} along {} -> {} of {};",
                joint.name,
                joint.name,
                end(joint.from),
                end(joint.to),
                model.point_name(first),
                model.point_name(second),
                model.link(first.link).name
            ));
        }
        if !couples.is_empty() {
            ways.push(format!(
                "write `slot` in place of `prismatic` for {} of {}, without an angle: a slot lets its pin's link turn",
                if self.is_of_couples() { number } else { "one" },
                list(&couples)
            ));
        }
        if ways.is_empty() {
            return format!(
                "release one of {}: take it out, or let it leave its links another freedom",
                list(&self.shared_joints())
            );
        }
        ways.join(", or ")
    }
}

fn is_driven(model: &Model, joint: JointId) -> bool {
    model.drives.iter().any(|drive| drive.joint == joint)
}

fn number(count: usize) -> &'static str {
    match count {
        0 | 1 => "one",
        2 => "two",
        3 => "three",
        4 => "four",
        _ => "several",
    }
}
