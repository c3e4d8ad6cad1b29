//! Rules: how the groups of each class are placed, balanced and moved in closed form.
//!
//! A rule states position, virtual velocity and force of its class; that it satisfies the group's own constraints and equilibrium
//! equations is proved by a test for every rule in the list.

mod block;
mod crank;
mod dyad;
mod newton;
mod prp;
mod rpp;
mod rpr;
mod rrp;
mod rrr;
mod slide;
mod slot;
mod train;
mod weld;

pub use rrr::pinned_dyad;

use super::assembly::Assembly;
use super::balance::Balance;
use super::velocities::Motion;
use crate::diagnostics::Diagnostic;
use crate::graph::{Expr, Failure};
use crate::model::ids::{JointId, LinkId, PointId};
use crate::model::{End, Model};
use crate::plan::placement::Placement;
use crate::topology::Group;

/// The solution of a class of groups.
pub trait Rule: Sync {
    /// What the class is called: `RRR dyad`.
    fn class(&self) -> &'static str;

    /// Whether it places its links in closed form, and not by iteration.
    fn is_closed(&self) -> bool {
        true
    }

    /// Whether a group belongs to the class.
    fn fits(&self, model: &Model, group: &Group) -> bool;

    /// Places the links of the group.
    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult;

    /// Finds the reactions of the group's joints, and its unknowns, from what acts on its links.
    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult;

    /// Finds the virtual velocities of the group's links from those of the links before it.
    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult;
}

/// An error where the declaration leaves something open, or rules it out at every pose.
pub type RuleResult = Result<(), Diagnostic>;

/// All rules; the first that fits a group solves it.
pub const RULES: [&dyn Rule; 12] = [
    &crank::Crank,
    &slide::Slide,
    &weld::Weld,
    &slot::SlotAndPin,
    &slot::SlotAndSlide,
    &train::Train,
    &rrr::Rrr,
    &rrp::Rrp,
    &rpr::Rpr,
    &prp::Prp,
    &rpp::Rpp,
    &block::Block,
];

/// The rule that solves a group.
#[must_use]
pub fn rule_of(model: &Model, group: &Group) -> Option<&'static dyn Rule> {
    RULES.into_iter().find(|rule| rule.fits(model, group))
}

/// The distance of two pins of a link; of one that depends on parameters it is checked when they are given.
fn length_between(model: &Model, link: LinkId, pins: [JointId; 2]) -> Expr<'_> {
    let [a, b] = pins.map(|pin| model.joint(pin).end_on(link).unwrap_or(model.joint(pin).from));
    checked_length(model, model.distance(link, a.point, b.point), &[link], pins)
}

/// The distance of two pins of a body; one that depends on parameters is checked when they are given.
fn checked_length<'m>(model: &'m Model, length: Expr<'m>, links: &[LinkId], pins: [JointId; 2]) -> Expr<'m> {
    let [first, second] = pins.map(|pin| &model.joint(pin).name);
    let requirement = format!("{}: its joints {first} and {second} must be apart", model.link_names(links));
    let checked = length.require_above(length, model.graph.zero(), Failure::Parameter { requirement });
    if checked.value().is_some() { checked } else { checked.known_positive() }
}

/// A link that is held by two pins needs a length between them.
fn check_length(model: &Model, link: LinkId, pins: [JointId; 2]) -> RuleResult {
    let [a, b] = pins.map(|pin| model.joint(pin).end_on(link));
    let (Some(a), Some(b)) = (a, b) else { return Ok(()) };
    let length = model.distance(link, a.point, b.point);
    if !length.is_zero() {
        return Ok(());
    }
    let [first, second] = pins.map(|pin| &model.joint(pin).name);
    let name = &model.link(link).name;
    Err(Diagnostic::new(
        name.place(),
        format!("the link `{name}` has no length between its joints `{first}` and `{second}`"),
    )
    .help("put the two points apart, or join the two other links by one pin"))
}

/// Between what the travel of a slide or a slot is counted while it is sought: a pin near it on either link, if there is one and its distance
/// along the line is a constant, or else the joint's own point. A pin in a slot is a place of its link; all other points of these joints may
/// be declared anywhere on the line, far from where anything is.
fn counted_between(placement: &Placement<'_>, group: &Group, joint: JointId) -> [End; 2] {
    placement.model.joint(joint).ends().map(|own| near(placement, joint, own, pin_near(placement, group, own)))
}

/// Lets the travel of a slide or a slot that is found in a formula count from where it is placed to be zero, and gives how far its second point
/// is from its first there.
///
/// As a rule its own points are near enough, and near where things are. Where they are far beyond all lengths, the ways of later groups that
/// go over the slide would have the rounding of the distance: then a pin on the link serves instead.
fn count<'m>(assembly: &mut Assembly<'m>, group: &Group, joint: JointId) -> Expr<'m> {
    let placement = &assembly.placement;
    let is_far = |own: End, pin: End| {
        let distance = placement.along_line(joint, own, pin).abs();
        let is_beyond = |length: Expr<'m>| (distance - FAR * length).sign() == Some(1);
        !distance.is_zero() && lengths(placement.model).into_iter().all(is_beyond)
    };
    let between = placement.model.joint(joint).ends().map(|own| {
        let pin = near(placement, joint, own, pin_near(placement, group, own).or_else(|| pin_on(placement.model, own)));
        if is_far(own, pin) { pin } else { own }
    });
    assembly.placement.count_between(joint, between);
    assembly.placement.datum(joint, between)
}

/// A pin of the link in the stead of a slide's own point on its line, if its distance along that is a constant.
fn near(placement: &Placement<'_>, joint: JointId, own: End, pin: Option<End>) -> End {
    let is_constant = |pin: &End| placement.along_line(joint, own, *pin).value().is_some();
    pin.filter(|_| placement.model.joint(joint).is_line_on(own.link)).filter(is_constant).unwrap_or(own)
}

/// What is more than this times as long as anything is far away. So much may be lost before, less than a digit.
const FAR: i64 = 8;

/// The distances between points of a link, and of these from lines on it; without the points by which lines are declared.
fn lengths(model: &Model) -> Vec<Expr<'_>> {
    let axes = Placement::of_ground(model);
    let mut lengths = Vec::new();
    for link in (0..model.links.len()).map(LinkId::new) {
        let ends = || model.joint_ids().filter_map(|joint| Some((joint, model.joint(joint).end_on(link)?)));
        let (of_lines, of_pins): (Vec<_>, Vec<_>) = ends().partition(|(joint, _)| model.joint(*joint).is_line_on(link));
        let is = |at: End| move |(_, end): &(JointId, End)| *end == at;
        let points = (0..model.link(link).points.len()).map(|index| End { link, point: PointId::new(index) });
        let points: Vec<End> =
            points.filter(|at| of_pins.iter().any(is(*at)) || !of_lines.iter().any(is(*at))).collect();
        for (index, from) in points.iter().enumerate() {
            let way = |to: End| model.local(to) - model.local(*from);
            lengths.extend(points[index + 1..].iter().map(|to| way(*to).size()));
            lengths.extend(of_lines.iter().map(|(joint, to)| way(*to).cross(axes.slide_axis(*joint, link)).abs()));
        }
    }
    lengths
}

/// The first pin that a group has on a link of its own or around it, or else that by which loops of the group go on from the link.
fn pin_near(placement: &Placement<'_>, group: &Group, own: End) -> Option<End> {
    let model = placement.model;
    let is_around = |end: &End| !group.links.contains(&end.link);
    let [near, _] = pins_of(model, group, own.link);
    near.or_else(|| {
        let around = group.outer.iter().flat_map(|joint| model.joint(*joint).ends()).filter(is_around);
        let ways = around.filter(|end| is_around(&own) && end.link != own.link).map(|end| placement.route(own, end));
        let first = ways.filter_map(|way| way.first().map(|joint| model.joint(*joint)));
        first.filter(|joint| !joint.is_line_on(own.link)).find_map(|joint| joint.end_on(own.link))
    })
}

/// The first pin of all on a link.
fn pin_on(model: &Model, own: End) -> Option<End> {
    let mut joints = model.joint_ids().map(|joint| model.joint(joint)).filter(|joint| !joint.is_line_on(own.link));
    joints.find_map(|joint| joint.end_on(own.link))
}

/// The first two points of a link at joints of the group, but for those that may lie anywhere on a line.
fn pins_of(model: &Model, group: &Group, link: LinkId) -> [Option<End>; 2] {
    let joints = group.outer.iter().chain(&group.inner).map(|joint| model.joint(*joint));
    let mut ends = joints.filter(|joint| !joint.is_line_on(link)).filter_map(|joint| joint.end_on(link));
    [ends.next(), ends.next()]
}
