//! Wheels on pins: a gear for every pin, as in a wheel that another one turns, or in a planetary train with its carrier.
//!
//! The constraints of gears are linear in the angles, with ψ the angle of the arm plus a constant:
//!
//! ```text
//! r₁ (θ₁ − ψ) + r₂ (θ₂ − ψ) = phase
//! ```
//!
//! so that the angles of the group are the solution of linear equations with constant coefficients, and the pins give the places. So are
//! their rates and accelerations (Willis 1841), whatever direction the teeth press in.
//! Forces: the moments about the pins give the tooth forces, as for any group.

use super::block::Block;
use super::{Rule, RuleResult};
use crate::graph::{Expr, Graph, Vector};
use crate::model::ids::{JointId, LinkId};
use crate::model::{Gear, JointKind, Model, UnknownKind};
use crate::plan::assembly::Assembly;
use crate::plan::balance::Balance;
use crate::plan::linear::{Core, Equation, solve};
use crate::plan::placement::Orientation;
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Group, Input};

/// The rule.
pub(super) struct Train;

/// A condition of the angles: factors of the links' angles, and what their sum is.
struct Condition<'m> {
    factors: Vec<(LinkId, Expr<'m>)>,
    sum: Expr<'m>,
}

fn conditions<'m>(assembly: &Assembly<'m>, group: &Group) -> Vec<Condition<'m>> {
    let (model, graph) = (assembly.model(), assembly.graph());
    let gears = joints(group).filter_map(|id| match model.joint(id).kind {
        JointKind::Gear(gear) => {
            let centres = gear.centres(model);
            let within = graph.atan2(centres.y, centres.x);
            let both = graph.expr(gear.radii[0]) + graph.expr(gear.radii[1]);
            Some(Condition { factors: factors(model, graph, id, &gear), sum: graph.expr(gear.phase) + both * within })
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

/// The conditions of the rates of the angles: the same, differentiated (Willis). Nothing if an effort acts that is no torque between two links:
/// the rate of its coordinate is not that of an angle.
fn conditions_of_rates<'m>(motion: &Motion<'m, '_>, group: &Group) -> Option<Vec<Condition<'m>>> {
    let (model, graph) = (motion.model(), motion.graph());
    let gears = joints(group).filter_map(|id| match model.joint(id).kind {
        JointKind::Gear(gear) => {
            let centres = gear.centres(model);
            let within = motion.change_of(graph.atan2(centres.y, centres.x));
            let both = graph.expr(gear.radii[0]) + graph.expr(gear.radii[1]);
            let rolled = motion.meshing(id, &gear) * (both / gear.distance(model));
            Some(Condition { factors: factors(model, graph, id, &gear), sum: both * within - rolled })
        }
        _ => None,
    });
    let inputs = group.inputs.iter().map(|input| {
        let [from, to] = match input.effort(model) {
            UnknownKind::Torque(from, to) => [from, to],
            UnknownKind::Drive(drive) => model.joint(model.drive(drive).joint).ends().map(|end| end.link),
            UnknownKind::Force { .. } | UnknownKind::Thrust(_) => return None,
        };
        let sum = motion.rate_of(*input);
        Some(Condition { factors: vec![(from, -graph.one()), (to, graph.one())], sum })
    });
    gears.map(Some).chain(inputs).collect()
}

/// By what the angles of two wheels and their arm count where they mesh.
fn factors<'m>(model: &Model, graph: &'m Graph, joint: JointId, gear: &Gear) -> Vec<(LinkId, Expr<'m>)> {
    let [first, second] = gear.radii.map(|radius| graph.expr(radius));
    let [a, b] = model.joint(joint).ends().map(|end| end.link);
    vec![(a, first), (b, second), (gear.arm[0].link, -(first + second))]
}

/// Conditions as equations for the links of a group, where the others have known angles, or rates.
fn equations<'m>(
    graph: &'m Graph,
    group: &Group,
    conditions: Vec<Condition<'m>>,
    known: impl Fn(LinkId) -> Expr<'m>,
) -> Vec<Equation<'m>> {
    let equations = conditions.into_iter().map(|condition| {
        let coefficients = vec![graph.zero(); group.links.len()];
        let mut equation = Equation { coefficients, right: condition.sum, gives: None };
        for (link, factor) in condition.factors {
            match group.links.iter().position(|own| *own == link) {
                Some(column) => equation.coefficients[column] = equation.coefficients[column] + factor,
                None => equation.right = equation.right - factor * known(link),
            }
        }
        equation
    });
    equations.collect()
}

fn solved<'m>(
    model: &Model,
    graph: &'m Graph,
    group: &Group,
    equations: &[Equation<'m>],
) -> Result<Vec<Expr<'m>>, usize> {
    let links = model.link_names(&group.links);
    let determinant = format!("det_{}", links.replace(" + ", "_"));
    let spread = graph.one();
    solve(
        graph,
        equations,
        Core { name: &determinant, group: &links, spread, refined: false, unknown: &|_, value| value },
    )
}

fn joints(group: &Group) -> impl Iterator<Item = JointId> {
    group.outer.iter().chain(&group.inner).copied()
}

fn pins(model: &Model, group: &Group) -> impl Iterator<Item = JointId> {
    joints(group).filter(|joint| matches!(model.joint(*joint).kind, JointKind::Revolute))
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
        let equations = equations(graph, group, conditions(assembly, group), |link| assembly.placement.angle(link));
        let angles =
            solved(model, graph, group, &equations).map_err(|_| crate::plan::unsupported(model, group, "place"))?;
        let x_axis = Vector::new(graph.one(), graph.zero());
        for (link, angle) in group.links.iter().zip(angles) {
            let name = &model.link(*link).name;
            let angle = angle.named(format!("angle_{name}"), format!("angle of {name}, from its gears"));
            let direction = angle.direction().named_direction(&name.text, &format!("direction of {name}"));
            assembly.placement.orient(*link, Orientation { direction, axis: x_axis });
            assembly.placement.set_angle(*link, angle);
        }
        pins(model, group).for_each(|pin| assembly.placement.connect(pin));
        Ok(())
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        Block.balance(balance, group)
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let Some(conditions) = conditions_of_rates(motion, group) else { return Block.follow(motion, group) };
        let (model, graph) = (motion.model(), motion.graph());
        let equations = equations(graph, group, conditions, |link| motion.rate(link));
        let rates =
            solved(model, graph, group, &equations).map_err(|_| crate::plan::unsupported(model, group, "move"))?;
        let mut open = Vec::new();
        for (link, rate) in group.links.iter().zip(rates) {
            open.push((*link, motion.named_rate(rate, &model.link(*link).name.text, " from its gears")));
        }
        // Each turns about the pin that joins it to what is found already.
        while let Some((pin, index)) = pins(model, group).find_map(|pin| Some((pin, hung(model, pin, &open)?))) {
            let (link, rate) = open.swap_remove(index);
            let at = motion.placement.slide_point(pin, link);
            motion.found(link, Twist { rate, at, velocity: motion.passed_on(pin, link) });
        }
        Ok(())
    }
}

/// Of the links that are open still the one that a pin joins to one that is not.
fn hung(model: &Model, pin: JointId, open: &[(LinkId, Expr<'_>)]) -> Option<usize> {
    let place = |link: LinkId| open.iter().position(|(own, _)| *own == link);
    match model.joint(pin).ends().map(|end| place(end.link)) {
        [Some(index), None] | [None, Some(index)] => Some(index),
        _ => None,
    }
}
