//! Every example, stage by stage: groups, equations, emitted code, operation counts, numbers.

use std::fmt::Write;

use crate::support::declarations::{OTHERS, given, poses};
use crate::support::examples::{declaration, every_example};
use crate::support::numbers::Double;
use crate::support::{Arguments, compile, direct, pose};
use linkage_codegen::topology::{Group, Input};
use linkage_codegen::{Linkage, emit};

fn linkage(example: &str) -> Linkage {
    linkage_codegen::analyse(declaration(example)).unwrap_or_else(|refusal| panic!("{:?}", refusal.errors))
}

/// The groups of motion and of forces with all that belongs to them.
fn topology(linkage: &Linkage) -> String {
    let model = &linkage.model;
    let mut text = String::new();
    let mut list = |heading: &str, groups: &[Group], rules: &[&str]| {
        let _ = writeln!(text, "{heading}");
        for (index, (group, rule)) in groups.iter().zip(rules).enumerate() {
            let joints = |ids: &[linkage_codegen::model::ids::JointId]| {
                ids.iter().map(|j| model.joint(*j).name.text.as_str()).collect::<Vec<_>>().join(", ")
            };
            let inputs = group.inputs.iter().map(|input| match input {
                Input::Drive(drive) => format!("drive {}", model.drive(*drive).name),
                Input::Unknown(unknown) => format!("unknown {}", model.unknown(*unknown).name),
            });
            let parts = [
                ("outer", joints(&group.outer)),
                ("inner", joints(&group.inner)),
                ("by", inputs.collect::<Vec<_>>().join(", ")),
            ];
            let parts = parts.into_iter().filter(|(_, names)| !names.is_empty());
            let parts: Vec<String> = parts.map(|(what, names)| format!("; {what} {names}")).collect();
            let _ = writeln!(text, "  {}. {rule}: {}{}", index + 1, model.link_names(&group.links), parts.concat());
        }
    };
    list("motion", &linkage.topology.motion, &linkage.plan.motion_rules);
    list("forces, from the unknowns outwards", &linkage.topology.forces, &linkage.plan.force_rules);
    text.push_str("a pose keeps\n");
    for kept in &linkage.plan.pose {
        let _ = writeln!(text, "  {}: {}", kept.name, kept.meaning);
    }
    text
}

/// What every scene gives at a few poses, digit for digit.
fn numbers(linkage: &Linkage, poses: &[Vec<f64>]) -> String {
    let given = given(linkage);
    let mut text = format!("loads that are given at run time: {:?}\n", given.loads);
    for drives in poses {
        let arguments = Arguments { drives: drives.clone(), ..given.clone() };
        let _ = writeln!(text, "\nat {}", drives.iter().map(f64::to_string).collect::<Vec<_>>().join(", "));
        if let Err(fault) = pose::<Double>(linkage, &arguments) {
            let _ = writeln!(text, "  {fault:?}");
            continue;
        }
        for (scene, functions) in linkage.model.scenes.iter().zip(&linkage.functions.scenes) {
            let _ = writeln!(text, "  {}", scene.name);
            let values = match direct::<Double>(linkage, &functions.direct, &arguments) {
                Ok(values) => values,
                Err(fault) => {
                    let _ = writeln!(text, "    {fault:?}");
                    continue;
                }
            };
            for ((path, _), value) in functions.direct.outputs.iter().zip(values) {
                // The equations of a verification have no names of their own.
                if !path.is_empty() {
                    let _ = writeln!(text, "    {path} = {:?}", value.0);
                }
            }
        }
    }
    text
}

#[test]
fn every_stage_of_every_example() {
    for example in every_example() {
        let linkage = linkage(&example);
        let operations = emit::operations(&linkage);
        let code =
            linkage_codegen::formatted(linkage_codegen::expand(without_source(declaration(&example)))).expect("Rust");
        insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!(format!("{example}.1_groups"), topology(&linkage));
            insta::assert_snapshot!(format!("{example}.2_equations"), emit::equations(&linkage));
            insta::assert_snapshot!(format!("{example}.3_code"), code);
            insta::assert_snapshot!(format!("{example}.4_operations"), operations);
            insta::assert_snapshot!(format!("{example}.5_numbers"), numbers(&linkage, &[vec![0.5], vec![2.0], vec![-1.0]]));
        });
    }
}

/// Each function of a single pose is marked `#[inline]`, so that a caller in another crate has its results in registers. What is prepared once,
/// and a sweep, whose callers have nothing to gain, are calls; so is the sum of all parts, for the compiler's sake.
#[test]
fn functions_of_a_pose_can_be_inlined() {
    let examples = every_example().into_iter().map(|example| without_source(declaration(&example)));
    for tokens in examples.chain(OTHERS.map(|(_, text)| text.parse().expect("tokens"))) {
        let sweeps: Vec<String> = {
            let linkage =
                linkage_codegen::analyse(tokens.clone()).unwrap_or_else(|refusal| panic!("{:?}", refusal.errors));
            linkage.model.sweeps.iter().map(|sweep| sweep.name.text.clone()).collect()
        };
        let code = linkage_codegen::formatted(linkage_codegen::expand(tokens)).expect("Rust");
        let mut is_inline = false;
        for line in code.lines().map(str::trim).filter(|line| !line.starts_with("//")) {
            is_inline |= line == "#[inline]";
            let Some((before, rest)) = line.split_once("fn ") else { continue };
            let name = rest.split(['(', '<']).next().unwrap_or_default();
            let is_called = ["new", "of", "total"].contains(&name) || sweeps.iter().any(|sweep| sweep == name);
            assert!(!before.starts_with("pub") || is_inline != is_called, "{line}");
            is_inline = false;
        }
    }
}

/// The function that the first page shows is the one that is emitted for the declaration above it.
#[test]
fn the_first_page_shows_what_is_emitted() {
    // But for the breaks of lines, and the commas that go with them.
    let without_breaks = |text: &str| {
        let text: String = text.split_whitespace().collect();
        text.replace(",}", "}").replace(",)", ")").replace(",]", "]")
    };
    let page = include_str!("../../../README.md");
    let shown = page.split("```text\n").find(|part| part.starts_with("pub fn bearing")).expect("the function");
    let shown = shown.split("```").next().unwrap_or_default();
    let tokens = without_source(declaration("four_bar"));
    let code = linkage_codegen::formatted(linkage_codegen::expand(tokens)).expect("Rust");
    assert!(without_breaks(&code).contains(&without_breaks(shown)), "{shown}");
}

#[test]
fn equations_and_code_of_what_no_example_has() {
    for (name, text) in OTHERS {
        let linkage = compile(text);
        let code = linkage_codegen::formatted(linkage_codegen::expand(text.parse().expect("tokens"))).expect("Rust");
        insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!(format!("{name}.1_groups"), topology(&linkage));
            insta::assert_snapshot!(format!("{name}.2_equations"), emit::equations(&linkage));
            insta::assert_snapshot!(format!("{name}.3_code"), code);
            insta::assert_snapshot!(format!("{name}.4_operations"), emit::operations(&linkage));
            insta::assert_snapshot!(format!("{name}.5_numbers"), numbers(&linkage, &poses(&linkage)));
        });
    }
}

/// A machine in motion, in what its scenes skip: statics beside dynamics, the inertia of one link beside that of all, a piston without mass
/// and with one, and of the drive a motion that is given, one of constant speed, and rest.
#[test]
fn operations_of_what_is_skipped() {
    let mut text = String::new();
    for (motion, piston) in [
        ("", ""),
        ("", "mass piston: 0.45kg at B;"),
        (" { rate: 3000rpm, acceleration: 0 }", ""),
        (" { rate: 0, acceleration: 0 }", ""),
    ] {
        let linkage = compile(&format!(
            "pub mod engine; units {{ mm, N }}
             ground {{ O: (0, 0) }} link crank {{ O -> A: 40mm }} link rod {{ A -> B: 140mm, C: (45mm, 0) }} link piston {{ B }}
             mass crank: 1.1kg at (5mm, 0), inertia 900kg*mm^2; mass rod: 0.62kg at C, inertia 1900kg*mm^2; {piston}
             revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston;
             prismatic G: ground.O -> piston.B along 0deg; drive theta: O{motion}; assemble B: ahead(A);
             load I: inertia; load Ic: inertia(crank); load gas: force(piston.B);
             scene statics: equilibrium(gas) -> (effort_theta); scene dynamics: equilibrium(I, gas) -> (effort_theta);
             scene of_crank: equilibrium(Ic) -> (effort_theta); scene torque: virtual_work(I, gas) -> (effort_theta);
             scene turning: acceleration -> (rod.angle);"
        ));
        let motion = if motion.is_empty() { "given at run time" } else { motion };
        let piston = if piston.is_empty() { "without mass" } else { "with mass" };
        let _ =
            writeln!(text, "motion of the drive: {}, piston {piston}\n{}", motion.trim(), emit::operations(&linkage));
    }
    insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!("skipped.4_operations", text);
    });
}

/// The declaration without `emit source;`: the code would hold itself.
fn without_source(declaration: proc_macro2::TokenStream) -> proc_macro2::TokenStream {
    let tokens: Vec<proc_macro2::TokenTree> = declaration.into_iter().collect();
    let start = tokens.iter().position(|token| token.to_string() == "emit");
    let keep = |index: usize| start.is_none_or(|start| !(start..start + 3).contains(&index));
    tokens.into_iter().enumerate().filter(|(index, _)| keep(*index)).map(|(_, token)| token).collect()
}
