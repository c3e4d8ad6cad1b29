//! What a scene does not need is not computed: shown on the programs and on the emitted code.

mod support;

use linkage_codegen::program::{Counts, Definition, Program, Step};
use support::compile;

const FOUR_BAR: &str = "pub mod four_bar; units { mm, N }
    ground { A0: (0, 0), B0: (140mm, 0) } link crank { A0 -> A: 80mm }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) } link rocker { B0 -> B: 120mm, D: (90mm, 0) }
    revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
    drive theta: A0; unknown T12: torque(ground -> crank); assemble B: left(A -> B0);
    load F13: force(coupler.C); load F14: force(rocker.D) = 100N @ 200deg; load F12: force(crank.A);
    scene statics: equilibrium; scene parts: superposition; scene torque: virtual_work(F13, F14) -> (T12);
    scene bearing: equilibrium(F14) -> (B); scene crank_only: equilibrium(F12) -> (T12); scene elsewhere: equilibrium(F12) -> (B, B0);
    scene place: position -> (A);";

fn program<'a>(linkage: &'a linkage_codegen::Linkage, scene: &str) -> &'a Program {
    let index = linkage.model.scenes.iter().position(|s| s.name.text == scene).expect("a scene of this name");
    &linkage.functions.scenes[index].direct
}

/// The identifiers in the emitted function of a scene, straight from the drives.
fn identifiers(scene: &str) -> Vec<String> {
    let source = linkage_codegen::formatted(linkage_codegen::expand(FOUR_BAR.parse().expect("tokens"))).expect("Rust");
    let start = source.find(&format!("pub fn {scene}_at(")).expect("the function");
    let end = start + source[start..].find("\n    }\n").expect("its end");
    let code = source[start..end].lines().filter(|line| !line.trim_start().starts_with("//"));
    let words = code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_'));
    words.filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

fn contains(words: &[String], word: &str) -> bool {
    words.iter().any(|w| w == word)
}

#[test]
fn a_torque_by_virtual_work_holds_no_joint_force() {
    let linkage = compile(FOUR_BAR);
    let Counts { sin_cos, sqrt, div, .. } = program(&linkage, "torque").counts();
    assert_eq!((sin_cos, sqrt), (1, 1));
    assert!(div <= 2, "{div} divisions");
    let code = identifiers("torque");
    for force in ["A_x", "B_x", "B0_x", "B_along_coupler", "B_across_rocker", "F12"] {
        assert!(!contains(&code, force), "{force} in {code:?}");
    }
    assert_eq!(code.iter().filter(|word| word.starts_with("sin_cos")).count(), 1, "{code:?}");
}

#[test]
fn only_what_a_result_needs_is_computed() {
    let linkage = compile(FOUR_BAR);
    // The bearing B needs the dyad alone: no reaction of the ground, no torque, nothing of the loads that the scene does not name.
    let bearing = identifiers("bearing");
    assert!(contains(&bearing, "F14_B_x"), "{bearing:?}");
    for other in ["T12", "A_x", "B0_x", "F13", "F12", "loads"] {
        assert!(!contains(&bearing, other), "{other} in {bearing:?}");
    }
    // The torque of a load on the crank needs the crank's direction and nothing of the dyad.
    let counts = program(&linkage, "crank_only").counts();
    assert_eq!((counts.sin_cos, counts.sqrt, counts.div), (1, 0, 0));
    // That load does not reach the other joints: its contribution is zero by structure, without any computation.
    let elsewhere = program(&linkage, "elsewhere");
    assert!(elsewhere.steps.iter().all(|step| !matches!(step, Step::Let(_))), "{}", elsewhere.counts());
    // The place of A is that of the crank's end.
    let counts = program(&linkage, "place").counts();
    assert_eq!((counts.sin_cos, counts.sqrt, counts.div, counts.atan2), (1, 0, 0, 0));
}

/// Every value of every program is read by a later step, or is a result.
#[test]
fn no_program_computes_what_nothing_reads() {
    let linkage = compile(FOUR_BAR);
    let scenes = linkage.functions.scenes.iter().flat_map(|scene| [&scene.direct, &scene.from_pose]);
    for program in scenes.chain([&linkage.functions.pose]).chain(&linkage.functions.accessors) {
        let uses = program.uses();
        for step in &program.steps {
            let Step::Let(value) = step else { continue };
            assert!(matches!(program.value(*value).definition, Definition::Computed(_)));
            assert!(uses[value.index()] > 0, "{:?}", program.value(*value).label);
        }
    }
}
