//! Every example, stage by stage: groups, equations, emitted code, operation counts, numbers.

mod support;

use std::fmt::Write;

use linkage_codegen::topology::{Group, Input};
use linkage_codegen::{Linkage, emit};
use support::examples::{EXAMPLES, declaration};
use support::numbers::Double;
use support::{Arguments, direct, pose};

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
            let _ = writeln!(
                text,
                "  {}. {rule}: {}; outer {}; inner {}; by {}",
                index + 1,
                model.link_names(&group.links),
                joints(&group.outer),
                joints(&group.inner),
                inputs.collect::<Vec<_>>().join(", "),
            );
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
fn numbers(linkage: &Linkage) -> String {
    let loads = linkage.model.loads.iter().enumerate().map(|(index, _)| {
        let index = f64::from(u32::try_from(index).expect("few loads"));
        [-30.0 + 7.0 * index, 40.0 - 11.0 * index]
    });
    let loads: Vec<[f64; 2]> = loads.collect();
    let mut text = format!("loads that are given at run time: {loads:?}\n");
    for drive in [0.5, 2.0, -1.0] {
        let arguments = Arguments { drives: vec![drive], loads: loads.clone(), params: Vec::new() };
        let _ = writeln!(text, "\nat {drive}");
        if let Err(fault) = pose::<Double>(linkage, &arguments) {
            let _ = writeln!(text, "  {fault:?}");
            continue;
        }
        for (scene, functions) in linkage.model.scenes.iter().zip(&linkage.functions.scenes) {
            let _ = writeln!(text, "  {}", scene.name);
            let values = direct::<Double>(linkage, &functions.direct, &arguments).expect("results");
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
    for example in EXAMPLES {
        let linkage = linkage(example);
        let operations = emit::operations(&linkage);
        let code =
            linkage_codegen::formatted(linkage_codegen::expand(without_source(declaration(example)))).expect("Rust");
        insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!(format!("{example}.1_groups"), topology(&linkage));
            insta::assert_snapshot!(format!("{example}.2_equations"), emit::equations(&linkage));
            insta::assert_snapshot!(format!("{example}.3_code"), code);
            insta::assert_snapshot!(format!("{example}.4_operations"), operations);
            insta::assert_snapshot!(format!("{example}.5_numbers"), numbers(&linkage));
        });
    }
}

/// The declaration without `emit source;`: the code would hold itself.
fn without_source(declaration: proc_macro2::TokenStream) -> proc_macro2::TokenStream {
    let tokens: Vec<proc_macro2::TokenTree> = declaration.into_iter().collect();
    let start = tokens.iter().position(|token| token.to_string() == "emit");
    let keep = |index: usize| start.is_none_or(|start| !(start..start + 3).contains(&index));
    tokens.into_iter().enumerate().filter(|(index, _)| keep(*index)).map(|(_, token)| token).collect()
}
