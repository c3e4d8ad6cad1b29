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
mod travels;
mod weld;

pub use rrr::pinned_dyad;

use super::assembly::Assembly;
use super::balance::Balance;
use super::velocities::Motion;
use crate::diagnostics::Diagnostic;
use crate::graph::Expr;
use crate::model::Model;
use crate::model::ids::{JointId, LinkId};
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
    length.required_positive(format!("{}: its joints {first} and {second} must be apart", model.link_names(links)))
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
