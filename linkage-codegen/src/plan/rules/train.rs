//! Wheels on pins: a gear for every pin, as in a wheel that another one turns, or in a planetary train with its carrier.
//!
//! The constraints of gears are linear in the angles, with ψ the angle of the arm plus a constant:
//!
//! ```text
//! r₁ (θ₁ − ψ) + r₂ (θ₂ − ψ) = phase
//! ```
//!
//! so that the angles of the group are the solution of linear equations with constant coefficients, and the pins give the places.
//! Forces: the moments about the pins give the tooth forces, as for any group.

use super::block::Block;
use super::{Rule, RuleResult};
use crate::graph::Vector;
use crate::model::ids::{JointId, LinkId};
use crate::model::{JointKind, Model};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::linear::{Core, Equation, solve};
use crate::plan::placement::Orientation;
use crate::plan::velocities::Motion;
use crate::topology::{Group, Input};

/// The rule.
pub(super) struct Train;

/// A condition of the angles: factors of the links' angles, and what their sum is.
struct Condition<'m> {
    factors: Vec<(LinkId, crate::graph::Expr<'m>)>,
    sum: crate::graph::Expr<'m>,
}

fn conditions<'m>(assembly: &Assembly<'m>, group: &Group) -> Vec<Condition<'m>> {
    let (model, graph) = (assembly.model(), assembly.graph());
    let gears = joints(group).filter_map(|id| match model.joint(id).kind {
        JointKind::Gear(gear) => {
            let [first, second] = gear.radii.map(|radius| graph.expr(radius));
            let [a, b] = model.joint(id).ends().map(|end| end.link);
            let centres = gear.centres(model);
            let within = graph.atan2(centres.y, centres.x);
            let both = first + second;
            let factors = vec![(a, first), (b, second), (gear.arm[0].link, -both)];
            Some(Condition { factors, sum: graph.expr(gear.phase) + both * within })
        }
        _ => None,
    });
    let drives = group.inputs.iter().filter_map(|input| {
        let Input::Drive(drive) = *input else { return None };
        let [a, b] = model.joint(model.drive(drive).joint).ends().map(|end| end.link);
        Some(Condition { factors: vec![(a, -graph.one()), (b, graph.one())], sum: assembly.coordinate(drive) })
    });
    gears.chain(drives).collect()
}

fn joints(group: &Group) -> impl Iterator<Item = JointId> {
    group.outer.iter().chain(&group.inner).copied()
}

impl Rule for Train {
    fn class(&self) -> &'static str {
        "gear train"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        group.is_train(model)
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let (model, graph) = (assembly.model(), assembly.graph());
        for gear in joints(group).filter_map(|id| match model.joint(id).kind {
            JointKind::Gear(gear) => Some(gear),
            _ => None,
        }) {
            let arm = gear.arm[0].link;
            if !assembly.placement.is_placed(arm) && !group.links.contains(&arm) {
                return Err(crate::plan::unsupported(model, group, "place").note(format!(
                    "`{}` keeps its wheels apart, and is placed only after them",
                    model.link(arm).name
                )));
            }
        }
        let equations = conditions(assembly, group).into_iter().map(|condition| {
            let mut equation =
                Equation { coefficients: vec![graph.zero(); group.links.len()], right: condition.sum, gives: None };
            for (link, factor) in condition.factors {
                match group.links.iter().position(|own| *own == link) {
                    Some(column) => equation.coefficients[column] = equation.coefficients[column] + factor,
                    None => equation.right = equation.right - factor * assembly.placement.angle(link),
                }
            }
            equation
        });
        let links = model.link_names(&group.links);
        let determinant = format!("det_{}", links.replace(" + ", "_"));
        let equations: Vec<Equation<'_>> = equations.collect();
        let spread = graph.one();
        let core = Core { name: &determinant, group: &links, spread, refined: false, unknown: &|_, value| value };
        let angles = solve(graph, &equations, core).map_err(|_| crate::plan::unsupported(model, group, "place"))?;
        let x_axis = Vector::new(graph.one(), graph.zero());
        for (link, angle) in group.links.iter().zip(angles) {
            let name = &model.link(*link).name;
            let angle = angle.named(format!("angle_{name}"), format!("angle of {name}, from its gears"));
            let direction = angle.direction().named_direction(&name.text, &format!("direction of {name}"));
            assembly.placement.orient(*link, Orientation { direction, axis: x_axis });
            assembly.placement.set_angle(*link, angle);
        }
        for joint in joints(group).filter(|joint| matches!(model.joint(*joint).kind, JointKind::Revolute)) {
            assembly.placement.connect(joint);
        }
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        Block.balance(balance, group)
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        Block.follow(motion, group)
    }
}
