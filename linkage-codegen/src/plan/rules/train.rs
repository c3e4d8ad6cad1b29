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
use crate::diagnostics::Diagnostic;
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

/// The equations of the angles of a group's links, or of their rates: what of them meshes and what is driven is given, and those of other links are
/// known. Nothing if an effort acts that is no torque between two links: its coordinate is not an angle.
fn equations<'m>(
    (model, graph): (&'m Model, &'m Graph),
    group: &Group,
    meshed: impl Fn(JointId, &Gear) -> Expr<'m>,
    driven: impl Fn(Input) -> Option<Expr<'m>>,
    known: impl Fn(LinkId) -> Expr<'m>,
) -> Option<Vec<Equation<'m>>> {
    let equation = |factors: &[(LinkId, Expr<'m>)], sum: Expr<'m>| {
        let mut equation = Equation { coefficients: vec![graph.zero(); group.links.len()], right: sum, gives: None };
        for (link, factor) in factors {
            match group.links.iter().position(|own| own == link) {
                Some(column) => equation.coefficients[column] = equation.coefficients[column] + *factor,
                None => equation.right = equation.right - *factor * known(*link),
            }
        }
        equation
    };
    let gears = joints(group).filter_map(|id| match model.joint(id).kind {
        JointKind::Gear(gear) => {
            let [first, second] = gear.radii.map(|radius| graph.expr(radius));
            let [a, b] = model.joint(id).ends().map(|end| end.link);
            let factors = [(a, first), (b, second), (gear.arm[0].link, -(first + second))];
            Some(equation(&factors, meshed(id, &gear)))
        }
        _ => None,
    });
    let inputs = group.inputs.iter().map(|input| {
        let [from, to] = match input.effort(model) {
            UnknownKind::Torque(from, to) => [from, to],
            UnknownKind::Drive(drive) => model.joint(model.drive(drive).joint).ends().map(|end| end.link),
            UnknownKind::Force { .. } | UnknownKind::Thrust(_) => return None,
        };
        Some(equation(&[(from, -graph.one()), (to, graph.one())], driven(*input)?))
    });
    gears.map(Some).chain(inputs).collect()
}

/// The angles or the rates; `verb` says what could not be done without.
fn solved<'m>(
    (model, graph): (&'m Model, &'m Graph),
    group: &Group,
    equations: &[Equation<'m>],
    verb: &str,
) -> Result<Vec<Expr<'m>>, Diagnostic> {
    let links = model.link_names(&group.links);
    let determinant = format!("det_{}", links.replace(" + ", "_"));
    let spread = graph.one();
    let core = Core { name: &determinant, group: &links, spread, refined: false, unknown: &|_, value| value };
    solve(graph, equations, core).map_err(|_| crate::plan::unsupported(model, group, verb))
}

/// Both radii together, and the angle of the line of centres in the arm's frame.
fn line_of_centres<'m>((model, graph): (&'m Model, &'m Graph), gear: &Gear) -> [Expr<'m>; 2] {
    let ([first, second], centres) = (gear.radii.map(|radius| graph.expr(radius)), gear.centres(model));
    [first + second, graph.atan2(centres.y, centres.x)]
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
        let meshed = |_: JointId, gear: &Gear| {
            let [both, within] = line_of_centres((model, graph), gear);
            graph.expr(gear.phase) + both * within
        };
        let driven = |input| Group::drive_of(model, input).map(|drive| assembly.coordinate(drive));
        let known = |link| assembly.placement.angle(link);
        let Some(equations) = equations((model, graph), group, meshed, driven, known) else { return Ok(()) };
        let angles = solved((model, graph), group, &equations, "place")?;
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
        let (model, graph) = (motion.model(), motion.graph());
        // What the position says, differentiated.
        let meshed = |joint: JointId, gear: &Gear| {
            let [both, within] = line_of_centres((model, graph), gear);
            both * motion.change_of(within) - motion.meshing(joint, gear) * (both / gear.distance(model))
        };
        let driven = |input| Some(motion.rate_of(input));
        let known = |link| motion.rate(link);
        let Some(equations) = equations((model, graph), group, meshed, driven, known) else {
            return Block.follow(motion, group);
        };
        let rates = solved((model, graph), group, &equations, "move")?;
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
