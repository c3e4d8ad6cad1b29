//! Documentation of the module and its functions.

use proc_macro2::TokenStream;
use quote::quote;

use crate::Linkage;
use crate::diagnostics::count;
use crate::graph::{Failure, Search};
use crate::model::Method;
use crate::program::{Program, Step};
use crate::topology::Group;

/// Doc attributes, a line each.
fn lines(text: &str) -> TokenStream {
    text.lines()
        .map(|line| {
            let line = if line.is_empty() { String::new() } else { format!(" {line}") };
            quote!(#[doc = #line])
        })
        .collect()
}

/// The module's own documentation: behind what the declaration says, what it is made of.
pub(super) fn module(linkage: &Linkage) -> TokenStream {
    let model = &linkage.model;
    let mut text = String::new();
    if !model.attributes.is_empty() {
        text.push('\n');
    }
    text.push_str(&format!(
        "A planar linkage of {}, {} and {}. Lengths in {}, forces in {}, angles in rad.\n",
        count(model.links.len() - 1, "moving link"),
        count(model.joints.len(), "joint"),
        count(model.drives.len(), "drive"),
        model.units.length.name,
        model.units.force.name,
    ));
    text.push_str("\n```text\n");
    text.push_str(&blocks(linkage));
    text.push_str("```\n\nThe whole derivation is in `EQUATIONS`.");
    lines(&text)
}

/// The groups of motion and of forces, a line each.
pub(super) fn blocks(linkage: &Linkage) -> String {
    let mut text = motion_blocks(linkage);
    let forces = linkage.topology.forces.iter().zip(&linkage.plan.force_rules);
    for (index, (group, class)) in forces.enumerate().rev() {
        text.push_str(&block(linkage, "forces", index, group, class));
    }
    text
}

/// The groups of motion, a line each.
pub(super) fn motion_blocks(linkage: &Linkage) -> String {
    let motion = linkage.topology.motion.iter().zip(&linkage.plan.motion_rules);
    motion.enumerate().map(|(index, (group, class))| block(linkage, "motion", index, group, class)).collect()
}

fn block(linkage: &Linkage, what: &str, index: usize, group: &Group, class: &str) -> String {
    use crate::topology::Input;
    let model = &linkage.model;
    let joints = |ids: &[crate::model::ids::JointId]| {
        ids.iter().map(|j| model.joint(*j).name.text.as_str()).collect::<Vec<_>>().join(", ")
    };
    let inputs: Vec<&str> = group
        .inputs
        .iter()
        .map(|input| match input {
            Input::Drive(drive) => model.drive(*drive).name.text.as_str(),
            Input::Unknown(unknown) => model.unknown(*unknown).name.as_str(),
        })
        .collect();
    let mut line = format!(
        "{what} {}: {class:<15} {:<24} outer {:<10}",
        index + 1,
        model.link_names(&group.links),
        joints(&group.outer)
    );
    if !group.inner.is_empty() {
        line.push_str(&format!(" inner {}", joints(&group.inner)));
    }
    if !inputs.is_empty() {
        line.push_str(&format!(" by {}", inputs.join(", ")));
    }
    format!("{}\n", line.trim_end())
}

/// What a scene's function does.
pub(super) fn scene_summary(linkage: &Linkage, index: usize, from_pose: bool) -> String {
    let model = &linkage.model;
    let scene = &model.scenes[index];
    let loads: Vec<String> = scene.loads.iter().map(|load| format!("`{}`", model.load(*load).name)).collect();
    let loads = loads.join(", ");
    let from = if from_pose { "from this pose" } else { "straight from the drives" };
    match scene.method {
        Method::Position => format!("Where everything is, {from}."),
        Method::Velocity => format!("How fast everything moves, {from}."),
        Method::Acceleration => format!("The accelerations, {from}."),
        Method::Coefficients => format!("Kinematic coefficients: how everything changes with the drives, {from}."),
        Method::Equilibrium => format!("Equilibrium under {loads}, {from}."),
        Method::Superposition => format!("Equilibrium under each of {loads} by itself, {from}."),
        Method::VirtualWork => format!("Virtual work of {loads}, {from}."),
        Method::Motion => {
            let with = if scene.loads.is_empty() { String::new() } else { format!(" with {loads}") };
            format!("The reduced equation of motion `τ = M q̈ + h`{with}, {from}.")
        }
        Method::Inverse => {
            "The drives that give the linkage the wanted coordinates, with their rates and accelerations.".to_owned()
        }
        Method::Derivative => {
            let Some(derivative) = &scene.derivative else { return String::new() };
            let by: Vec<String> = derivative.by.iter().map(|by| format!("`{}`", by.written(model))).collect();
            format!(
                "Derivatives of the results of `{}` by {}, {from}.",
                model.scenes[derivative.of].name,
                by.join(", ")
            )
        }
        Method::Verify => {
            format!("Equilibrium, superposition, virtual work and the general solution against each other, {from}.")
        }
    }
}

/// Documentation of a function: summary, further points, errors, operation counts, equations.
pub(super) fn function(
    linkage: &Linkage,
    summary: &str,
    points: &[String],
    program: &Program,
    equations: &[String],
) -> TokenStream {
    let mut text = format!("{summary}\n");
    if !points.is_empty() {
        text.push_str(&format!("\n{}\n", points.join("\n")));
    }
    text.push_str(&format!("\nOperations: {}.\n", program.counts()));
    if !equations.is_empty() {
        text.push_str(&format!("\n```text\n{}\n```\n", equations.join("\n")));
    }
    text.push_str("\n# Errors\n\n");
    text.push_str(&errors(linkage, program).join("\n"));
    lines(&text)
}

/// Documentation of a search: what it does, and what a step costs.
pub(super) fn search(search: &Search, program: &Program) -> TokenStream {
    lines(&format!(
        "Places {} by Newton's method, from `start` with the drives at `from`: what stays open, and the places.\n\n\
         The drives go straight to `to`, by short strides, and after each of them the group is closed again.\n\n\
         A step turns each direction `u` by `δ`, to the direction of `u + δ u⊥`; the steps solve `J δ = −gap`, with the exact Jacobian `J`.\n\n\
         Operations of a step, beside the solution of its {} equations: {}.",
        search.group,
        search.residuals.len(),
        program.counts()
    ))
}

/// Documentation of what changes on the way of a search.
pub(super) fn on_the_way(search: &Search, program: &Program) -> TokenStream {
    let checks = program.steps.iter().any(|step| matches!(step, Step::Check { .. }));
    let nothing = if checks { " Nothing, if there is no such pose." } else { "" };
    lines(&format!(
        "What {} reads of the links before its own, at a pose on the way.{nothing}\n\nOperations: {}.",
        search.name,
        program.counts()
    ))
}

fn errors(linkage: &Linkage, program: &Program) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    let mut add = |line: String| {
        if !all.contains(&line) {
            all.push(line);
        }
    };
    // An inverse scene is one of a linkage that is driven where a motion is wanted.
    let given = if linkage.model.exchanged.is_some() { "what is wanted" } else { "a drive" };
    let not_finite = format!("* [`Error::NotFinite`]: {given} is not a finite number.");
    if !program.asked_late.is_empty() {
        add(not_finite.clone());
    }
    for step in &program.steps {
        match step {
            Step::Check { guard, weaker, .. } => {
                weaker.iter().chain([guard]).for_each(|guard| add(of_failure(&guard.failure)));
            }
            Step::FiniteInput(_) => add(not_finite.clone()),
            Step::FiniteResults(_) => {
                let read = match (program.reads_motion(), program.reads_loads()) {
                    (true, true) => "what is read of the rates and the loads is not finite, or ",
                    (true, false) => "what is read of the rates is not finite, or ",
                    (false, true) => "what is read of the loads is not finite, or ",
                    (false, false) => "",
                };
                add(format!("* [`Error::NotFinite`]: {read}a result is too large for one."));
            }
            Step::Let(_) => {}
        }
    }
    if all.is_empty() {
        all.push("None: what it computes is always defined.".into());
    }
    all
}

fn of_failure<T>(failure: &Failure<T>) -> String {
    let (error, what) = told(failure);
    format!("* [`Error::{error}`]: {what}.")
}

/// The error that a failure is, and what it says.
pub(super) fn told<T>(failure: &Failure<T>) -> (&'static str, String) {
    match failure {
        Failure::CannotAssemble { group, joint, .. } => {
            ("CannotAssemble", format!("{group} cannot be closed at `{joint}`"))
        }
        Failure::CoincidentPivots { group, joint } => {
            ("CoincidentPivots", format!("the outer joints of {group} coincide, the place of `{joint}` is open"))
        }
        Failure::NoConvergence { group, .. } => {
            ("NoConvergence", format!("the search for the places of {group} does not arrive"))
        }
        Failure::DeadCentre { group, pivot } => {
            ("DeadCentre", format!("{group} is at a dead centre, `{pivot}` vanishes"))
        }
        Failure::OtherSide { joint } => (
            "OtherSide",
            format!("only with `{joint}` on the other side than is chosen does it have these coordinates"),
        ),
        Failure::NoDirection { of } => ("NoDirection", format!("{of} vanishes")),
        Failure::CoincidentEnds { of } => ("CoincidentEnds", format!("the points between which `{of}` acts coincide")),
        Failure::Parameter { requirement } => ("Parameter", requirement.clone()),
    }
}
