//! Rules: how the groups of each class are placed, balanced and moved in closed form.
//!
//! A rule states position, virtual velocity and force of its class; that it satisfies the group's own constraints and equilibrium
//! equations is proved by a test for every rule in the list.

mod crank;
mod rrp;
mod rrr;
mod slide;

pub use rrr::pinned_dyad;

use super::assembly::Assembly;
use super::balance::Balance;
use super::velocities::Motion;
use crate::diagnostics::Diagnostic;
use crate::model::Model;
use crate::topology::Group;

/// The solution of a class of groups.
pub trait Rule: Sync {
    /// What the class is called: `RRR dyad`.
    fn class(&self) -> &'static str;

    /// Whether a group belongs to the class.
    fn fits(&self, model: &Model, group: &Group) -> bool;

    /// Places the links of the group.
    ///
    /// # Errors
    ///
    /// Where the declaration leaves the place open, or rules it out at every pose.
    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> Result<(), Diagnostic>;

    /// Finds the reactions of the group's joints, and its unknowns, from what acts on its links.
    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group);

    /// Finds the virtual velocities of the group's links from those of the links before it.
    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group);
}

/// All rules; the first that fits a group solves it.
pub const RULES: [&dyn Rule; 4] = [&crank::Crank, &slide::Slide, &rrr::Rrr, &rrp::Rrp];

/// The rule of a group.
#[must_use]
pub fn rule_of(model: &Model, group: &Group) -> Option<&'static dyn Rule> {
    RULES.into_iter().find(|rule| rule.fits(model, group))
}
