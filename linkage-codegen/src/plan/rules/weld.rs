//! One link welded to a placed one.
//!
//! * Position: the link turns with the other one.
//! * Force: the weld holds the sum of the forces, and their moment about its point.

use super::{Rule, RuleResult};
use crate::model::ids::{JointId, LinkId};
use crate::model::{JointKind, Model};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::velocities::{Motion, Twist};
use crate::topology::Group;

/// The rule.
pub(super) struct Weld;

/// The link and its weld.
fn parts(model: &Model, group: &Group) -> Option<(LinkId, JointId)> {
    match (group.links.as_slice(), group.outer.as_slice(), group.inputs.as_slice()) {
        ([link], [weld], []) if matches!(model.joint(*weld).kind, JointKind::Weld { .. }) => Some((*link, *weld)),
        _ => None,
    }
}

impl Rule for Weld {
    fn class(&self) -> &'static str {
        "welded link"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        parts(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some((link, weld)) = parts(assembly.model(), group) else { return Ok(()) };
        let orientation = assembly.placement.along_slide(weld, link);
        assembly.placement.orient(link, orientation);
        assembly.placement.connect(weld);
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let model = balance.model();
        let Some((link, weld)) = parts(model, group) else { return Ok(()) };
        let about = balance.placement.point(balance.end(weld, link));
        let (name, joint) = (&model.link(link).name, &model.joint(weld).name);
        let force = balance.total(link).ground();
        let moment = balance.moment(link, about, balance.graph().one());
        let second = model.joint(weld).to.link == link;
        let (force, couple, sign) = if second { (-force, -moment, "−") } else { (force, moment, "") };
        let force = force.named(&balance.name(&joint.text), &format!("{sign}ΣF of what acts on {name}"));
        let equation = format!("{sign}ΣM({joint}) of what acts on {name}");
        let couple = couple.named(balance.name(&format!("{joint}_couple")), equation);
        balance.react(weld, &[force.x, force.y, couple]);
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some((link, weld)) = parts(model, group) else { return Ok(()) };
        let data = model.joint(weld);
        let (Some(near), Some(far)) = (data.end_on(link), data.end_off(link)) else { return Ok(()) };
        let (at, rate, velocity) =
            (motion.placement.point(near), motion.rate(far.link) + motion.turned_by(weld, link), motion.of_point(far));
        motion.found(link, Twist { rate, at, velocity });
        Ok(())
    }
}
