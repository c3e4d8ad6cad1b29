//! What a scene does not need is not computed: shown on the programs and on the emitted code, of every example and of what no example has too.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::support::compile;
use crate::support::declarations::{declarations, fused_linkages, linkages};
use crate::support::linkages::Random;
use linkage_codegen::graph::{Failure, Graph, Kernel, NodeId, Op, Order, Sought, Symbol};
use linkage_codegen::model::{Load, LoadKind, Unknown, UnknownKind, Wanted};
use linkage_codegen::program::{Counts, Definition, Input, Program, Step, ValueId};
use linkage_codegen::{analyse, expand};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

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

/// A pose is for several scenes: it divides by its pivots and turns the arms of loads once for all of them, and neither if none would.
#[test]
fn a_pose_keeps_what_scenes_would_divide_by_and_turn() {
    let kept = |linkage: &linkage_codegen::Linkage| -> Vec<String> {
        let shared = |name: &&str| ["inverse_", "arm_"].iter().any(|start| name.starts_with(start));
        linkage.plan.pose.iter().map(|kept| kept.name.as_str()).filter(shared).map(str::to_owned).collect()
    };
    let linkage = compile(FOUR_BAR);
    assert_eq!(
        kept(&linkage),
        ["inverse_sin_mu_B", "arm_coupler_A_C_x", "arm_coupler_A_C_y", "arm_crank_A0_A_x", "arm_crank_A0_A_y"]
    );
    let from_pose = |scene: &str| {
        let index = linkage.model.scenes.iter().position(|s| s.name.text == scene).expect("a scene of this name");
        linkage.functions.scenes[index].from_pose.counts()
    };
    assert!(["statics", "parts", "torque", "bearing"].iter().all(|scene| from_pose(scene).div == 0));
    // The moment of F13 is two products, that of the constant F14 as well.
    let Counts { add, mul, .. } = from_pose("statics");
    assert_eq!((add, mul), (12, 13));
    // A torque by a force on the crank needs the crank's arm alone, a place nothing.
    let others = FOUR_BAR.find("scene statics").zip(FOUR_BAR.find("scene crank_only")).expect("scenes");
    let without = format!("{}{}", &FOUR_BAR[..others.0], &FOUR_BAR[others.1..]);
    assert_eq!(kept(&compile(&without)), ["arm_crank_A0_A_x", "arm_crank_A0_A_y"]);
    let mut multiplied = 0;
    for (name, linkage) in linkages() {
        let graph = &linkage.model.graph;
        for (scene, functions) in linkage.model.scenes.iter().zip(&linkage.functions.scenes) {
            let program = &functions.from_pose;
            let kept = |value: ValueId| match program.value(value).definition {
                Definition::Input(Input::Kept(node)) => Some(node),
                _ => None,
            };
            for value in program.computed() {
                let Some(op) = program.op(value) else { continue };
                if let Op::Div(_, divisor) = op {
                    let reciprocal = kept(*divisor).and_then(|node| graph.kept_reciprocal(node));
                    let is_counted = program.counts_rounding;
                    assert!(is_counted || reciprocal.is_none(), "{name}, {}: divides", scene.name);
                }
                let reads = |operand: &ValueId| {
                    kept(*operand).is_some_and(|node| graph.label(node).is_some_and(|l| l.name.starts_with("inverse_")))
                };
                multiplied += usize::from(op.operands().iter().any(reads));
            }
        }
    }
    assert!(multiplied > 50, "only {multiplied} products with a reciprocal");
}

/// A slider-crank in motion.
const ENGINE: &str = "pub mod engine; units { mm, N }
    ground { O: (0, 0) } link crank { O -> A: 40mm } link rod { A -> B: 140mm, C: (45mm, 0) } link piston { B }
    mass crank: 1.1kg at (5mm, 0), inertia 900kg*mm^2; mass rod: 0.62kg at C, inertia 1900kg*mm^2;
    revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston;
    prismatic G: ground.O -> piston.B along 0deg; drive theta: OMOTION; assemble B: ahead(A);
    load I: inertia; load Ic: inertia(crank); load gas: force(piston.B); load K: spring(ground.O, rod.C) { damping: 2N*s/mm };
    scene statics: equilibrium(gas); scene dynamics: equilibrium(I, gas); scene crank_alone: equilibrium(Ic) -> (effort_theta);
    scene dynamics_torque: equilibrium(I, gas) -> (effort_theta);
    scene damped: equilibrium(K) -> (effort_theta); scene speeds: velocity; scene turning: acceleration -> (rod.angle);";

/// The same with its drive as it is declared here.
fn engine(motion: &str) -> linkage_codegen::Linkage {
    compile(&ENGINE.replace("MOTION", motion))
}

/// What a scene reads of the drive's motion.
fn motion_read(linkage: &linkage_codegen::Linkage, scene: &str) -> Vec<Order> {
    let inputs = program(linkage, scene).inputs().filter_map(|(_, input)| match input {
        Input::Symbol(Symbol::Driven(_, order)) => Some(order),
        _ => None,
    });
    let mut read: Vec<Order> = inputs.collect();
    read.sort_unstable();
    read
}

#[test]
fn what_rests_has_no_velocity_and_what_is_damped_no_acceleration() {
    let linkage = engine("");
    assert!(motion_read(&linkage, "statics").is_empty());
    let named = |scene: &str, name: &str| {
        program(&linkage, scene).values.iter().any(|value| value.label.as_ref().is_some_and(|own| own.name == name))
    };
    for quantity in ["omega_rod", "alpha_rod", "omega2_crank"] {
        assert!(!named("statics", quantity), "{quantity}");
        assert!(named("dynamics", quantity), "{quantity}");
    }
    assert_eq!(motion_read(&linkage, "speeds"), [Order::Rate]);
    assert_eq!(motion_read(&linkage, "damped"), [Order::Rate]);
    assert_eq!(motion_read(&linkage, "dynamics"), [Order::Rate, Order::Acceleration]);
    assert!(!named("damped", "alpha_rod"));
}

#[test]
fn inertia_of_one_link_needs_the_acceleration_of_that_link_alone() {
    let linkage = engine("");
    // The crank's own inertia needs nothing of the rod: its centrifugal force has no moment about the pin.
    assert_eq!(motion_read(&linkage, "crank_alone"), [Order::Acceleration]);
    let counts = program(&linkage, "crank_alone").counts();
    assert_eq!((counts.sin_cos, counts.sqrt, counts.div), (0, 0, 0), "{counts}");
    // The piston has no mass: its acceleration is not computed.
    let computed = |name: &str| {
        let values = &program(&linkage, "dynamics").values;
        values.iter().any(|value| value.label.as_ref().is_some_and(|own| own.name == name))
    };
    assert!(computed("alpha_rod") && !computed("acceleration_G"));
}

#[test]
fn what_has_no_mass_costs_nothing() {
    let linkage = engine("");
    // A mass on the piston is what makes a difference.
    let heavy = compile(&ENGINE.replace("MOTION", "").replace("mass rod:", "mass piston: 0.4kg at B; mass rod:"));
    let work = |linkage: &linkage_codegen::Linkage, scene: &str| {
        let counts = program(linkage, scene).counts();
        counts.add + counts.mul
    };
    assert!(work(&heavy, "dynamics") > work(&linkage, "dynamics"));
    // Links without mass and load that hang on the others change nothing, neither in forces with inertia nor in the equation of motion.
    let hung = "link left { C: (0, 0), E: (90mm, 0) } link right { E: (0, 0), H: (70mm, 0) }
        revolute Cl: rod.C -> left.C; revolute E: left -> right; revolute H: right.H -> ground.H; assemble E: left(Cl -> H);";
    let reduced = "scene control: motion -> (M, h);";
    let with = |more: &str| {
        let ground =
            ENGINE.replace("MOTION", "").replace("ground { O: (0, 0) }", "ground { O: (0, 0), H: (60mm, -90mm) }");
        compile(&format!("{ground} {more} {reduced}"))
    };
    let (plain, hung) = (with(""), with(hung));
    for scene in ["dynamics_torque", "crank_alone", "damped", "control"] {
        assert_eq!(program(&plain, scene).counts(), program(&hung, scene).counts(), "{scene}");
    }
}

#[test]
fn a_declared_constant_speed_drops_what_it_makes_zero() {
    let free = engine("");
    let constant = engine(" { rate: 3000rpm, acceleration: 0 }");
    for scene in ["dynamics", "turning", "damped"] {
        assert!(motion_read(&constant, scene).is_empty());
    }
    let work = |linkage: &linkage_codegen::Linkage, scene: &str| {
        let counts = program(linkage, scene).counts();
        (counts.add, counts.mul)
    };
    for scene in ["dynamics", "turning"] {
        let ([sums, products], [fewer_sums, fewer_products]) =
            (<[usize; 2]>::from(work(&free, scene)), <[usize; 2]>::from(work(&constant, scene)));
        assert!(
            fewer_sums < sums && fewer_products + 2 < products,
            "{scene}: {sums} {products} {fewer_sums} {fewer_products}"
        );
    }
    // At rest there is nothing at all.
    let resting = engine(" { rate: 0, acceleration: 0 }");
    for scene in ["turning", "speeds"] {
        assert!(program(&resting, scene).steps.iter().all(|step| !matches!(step, Step::Let(_))), "{scene}");
    }
}

#[test]
fn derivatives_cost_nothing_elsewhere_and_share_what_they_have_in_common() {
    let plain = compile(FOUR_BAR);
    let with = compile(&format!(
        "{FOUR_BAR} scene both: derivative(torque) by (theta, F13); scene slope: derivative(torque) by (theta);
         scene linear: derivative(torque) by (F13); scene far: derivative(statics) by (F12);"
    ));
    // A scene stays as it was, and so does the pose.
    for scene in &plain.model.scenes {
        let [before, behind] = [&plain, &with].map(|linkage| program(linkage, &scene.name.text).counts());
        assert_eq!(before, behind, "{}", scene.name);
    }
    assert_eq!(plain.functions.pose.counts(), with.functions.pose.counts());
    assert_eq!(plain.plan.pose.len(), with.plan.pose.len());
    // What a load changes does not depend on how large it is, nor on how the pose changes.
    let reads_load = |program: &Program| program.inputs().any(|(_, i)| matches!(i, Input::Symbol(Symbol::Load(..))));
    assert!(reads_load(program(&with, "torque")) && !reads_load(program(&with, "linear")));
    // The pose is solved once for all: the same sine, the same roots and divisions as for the torque itself.
    let [torque, both, slope, linear] =
        ["torque", "both", "slope", "linear"].map(|scene| program(&with, scene).counts());
    assert_eq!([torque.sin_cos, torque.sqrt, torque.div], [both.sin_cos, both.sqrt, both.div]);
    // Together they take less than one by one, and all three less than the torque at three further places, for three differences.
    let work = |counts: Counts| counts.add + counts.mul;
    assert!(work(both) < work(slope) + work(linear), "{both}, {slope}, {linear}");
    assert!(work(both) < 3 * work(torque), "{both}, {torque}");
    // A load on the crank alone reaches no pin of the dyad.
    let far = program(&with, "far").outputs.iter().map(|(path, _)| path.clone());
    assert!(far.clone().any(|path| path == "F12.x.T12") && far.clone().any(|path| path == "F12.y.B.x"));
    let value = |path: &str| {
        let (_, id) = program(&with, "far").outputs.iter().find(|(other, _)| other == path).expect("a result");
        program(&with, "far").value(*id)
    };
    assert!(matches!(value("F12.x.B.x").definition, Definition::Computed(Op::Constant(_))));
}

/// Bounds of errors are worked out for the scene that has them, and of the pose what it needs.
#[test]
fn bounds_of_errors_cost_other_scenes_nothing() {
    let plain = compile(FOUR_BAR);
    let with = compile(&format!("{FOUR_BAR} scene bounded: equilibrium -> (T12, error_bound);"));
    for scene in &plain.model.scenes {
        let [before, behind] = [&plain, &with].map(|linkage| program(linkage, &scene.name.text));
        assert_eq!(before.counts(), behind.counts(), "{}", scene.name);
    }
    let bounds = |linkage: &linkage_codegen::Linkage| linkage.plan.pose.iter().filter(|kept| kept.is_bound).count();
    assert_eq!(bounds(&plain), 0);
    assert_eq!(plain.plan.pose.len(), with.plan.pose.len() - bounds(&with));
    // Counted: the bound is more work than what it bounds.
    let [alone, bounded] = [program(&plain, "statics"), program(&with, "bounded")].map(Program::counts);
    assert!(bounded.add + bounded.mul > 2 * (alone.add + alone.mul), "{alone}, {bounded}");
}

/// Without bounds of errors nothing stands between a function and its results but pivots, and what is finite; where something is searched for,
/// acts between two points or has a direction, that it is found, they are apart and it has one; and what parameters and inverse scenes ask
/// for. No function asks the same twice.
#[test]
fn without_bounds_of_errors_only_pivots_are_checked() {
    let (mut looked_at, mut pivots, mut with_bounds) = (0, 0, 0);
    for (name, linkage) in linkages() {
        let model = &linkage.model;
        let scenes = |linkage: &linkage_codegen::Linkage| -> Vec<String> {
            linkage
                .model
                .scenes
                .iter()
                .flat_map(|scene| [format!("Pose::{scene}", scene = scene.name), format!("{}_at", scene.name)])
                .collect()
        };
        let of_inverses: Vec<String> = linkage.inverses.iter().flat_map(scenes).collect();
        let of_scenes = scenes(&linkage);
        let is_line = |of: &String| {
            let is_load = |load: &Load| matches!(load.kind, LoadKind::Spring { .. } | LoadKind::Thrust { .. });
            let is_unknown = |unknown: &Unknown| matches!(unknown.kind, UnknownKind::Thrust { .. });
            model.loads.iter().any(|load| load.name.text == *of && is_load(load))
                || model.unknowns.iter().any(|unknown| unknown.name == *of && is_unknown(unknown))
        };
        for (function, program, _) in programs(&linkage) {
            if program.counts_rounding {
                with_bounds += 1;
                continue;
            }
            looked_at += 1;
            let mut asked = Vec::new();
            for step in &program.steps {
                let Step::Check { guard, weaker, .. } = step else { continue };
                for guard in core::iter::once(guard).chain(weaker) {
                    let is_right = match &guard.failure {
                        Failure::DeadCentre { .. }
                        | Failure::CannotAssemble { .. }
                        | Failure::CoincidentPivots { .. } => {
                            pivots += 1;
                            true
                        }
                        Failure::NoConvergence { .. } => {
                            !linkage.functions.searches.is_empty()
                                && (["Pose::at", "Pose::moved_to"].contains(&function.as_str())
                                    || function.ends_with("_at"))
                        }
                        Failure::CoincidentEnds { of } => is_line(of),
                        Failure::NoDirection { .. } => of_scenes.contains(&function),
                        Failure::OtherSide { .. } => of_inverses.contains(&function),
                        Failure::Parameter { .. } => ["Linkage::new", "Limits::of"].contains(&function.as_str()),
                    };
                    assert!(is_right, "{name}, {function}: {guard:?}");
                }
                assert!(!asked.contains(&guard.condition), "{name}, {function} asks twice: {guard:?}");
                asked.push(guard.condition);
            }
        }
        // A pose keeps bounds for scenes that have some alone.
        let kept = linkage.plan.pose.iter().filter(|kept| kept.is_bound).count();
        let has_bounds = model.scenes.iter().any(|scene| scene.results.contains(&Wanted::ErrorBound));
        assert!(kept == 0 || has_bounds, "{name}: {kept} bounds are kept");
        assert_eq!(linkage.functions.pose.counts_rounding, has_bounds, "{name}");
    }
    assert!(looked_at > 800 && pivots > 250 && with_bounds > 4, "{looked_at}, {pivots}, {with_bounds}");
}

/// From a crank's pin on the ground to its other pin leads the crank, on whatever link that pin is named and in whatever order the joints
/// stand: all other ways are longer, and have the rounding of longer links.
#[test]
fn a_way_between_two_points_is_through_the_pin_at_one_of_them() {
    let joints = [
        "revolute A0: ground -> crank;",
        "revolute A: crank -> coupler;",
        "revolute B: coupler -> rocker;",
        "revolute B0: ground -> rocker;",
    ];
    let mut orders = vec![vec![]];
    for joint in joints {
        let further = |order: &Vec<&'static str>| {
            (0..=order.len()).map(|at| [&order[..at], &[joint], &order[at..]].concat()).collect::<Vec<_>>()
        };
        orders = orders.iter().flat_map(further).collect();
    }
    assert_eq!(orders.len(), 24);
    for order in orders {
        let linkage = compile(&format!(
            "pub mod four_bar; units {{ mm, N }} ground {{ A0: (0, 0), B0: (140mm, 0) }} link crank {{ A0 -> A: 80mm }}
             link coupler {{ A -> B: 100mm }} link rocker {{ B0 -> B: 120mm }} {} drive theta: A0; assemble B: left(A -> B0);
             load K: spring(coupler.A, ground.A0) {{ rate: 2N/mm, free: 10mm }}; scene held: equilibrium -> (effort_theta, A0);",
            order.concat()
        ));
        let held = program(&linkage, "held");
        let labels = held.values.iter().filter_map(|value| value.label.as_ref()).map(|label| label.name.as_str());
        let read: Vec<&str> = labels.filter(|name| name.starts_with("coupler") || name.starts_with("rocker")).collect();
        assert!(read.is_empty(), "{read:?} with {order:?}");
    }
}

/// The power of what acts at a pin, or nearer to it than to the one where the link's motion is found, is that at the pin's velocity: then
/// nothing asks how the link turns, or what turning adds is small.
#[test]
fn power_is_found_at_the_nearest_pin() {
    let torque = |place: &str, loads: &str| {
        let text = FOUR_BAR
            .replace("C: left(A -> B, 70mm, 80mm)", &format!("C: {place}"))
            .replace("virtual_work(F13, F14)", &format!("virtual_work({loads})"));
        let linkage = compile(&text);
        let program = program(&linkage, "torque");
        let rates = ["rate_coupler", "rate_rocker"].map(|rate| {
            program.values.iter().filter_map(|value| value.label.as_ref()).any(|label| label.name.starts_with(rate))
        });
        let Counts { add, mul, .. } = program.counts();
        (rates, add + mul)
    };
    let (rates, at_the_far_pin) = torque("(100mm, 0)", "F13");
    assert_eq!(rates, [false, true]);
    let (rates, off_the_pins) = torque("(30mm, 20mm)", "F13");
    assert_eq!(rates, [true, false]);
    assert!(at_the_far_pin < off_the_pins, "{at_the_far_pin} and {off_the_pins} operations");
    // With a load on the rocker its rate is known anyway.
    let [(near, of_near), (far, of_far)] = ["(30mm, 20mm)", "(70mm, 20mm)"].map(|place| torque(place, "F13, F14"));
    assert_eq!([near, far], [[true, true]; 2]);
    assert!(of_far <= of_near, "{of_far} and {of_near} operations");
}

/// What only slides has one velocity, and what is nearest to a pin of a link that turns about a moving pin stays where it is.
#[test]
fn power_is_not_found_by_way_of_what_turns() {
    let operations = |place: &str| {
        let linkage = compile(&format!(
            "pub mod press; units {{ mm, N }} ground {{ O: (0, 0), S: (0, 0) }} link crank {{ O -> A: 42mm }}
             link rod {{ A -> B: 142mm, G: (42mm, 10mm) }} link ram {{ B: (0, 0), S: (0, 50mm), D: {place} }}
             revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> ram;
             prismatic S: ground -> ram along 90deg of ground;
             drive theta: O; unknown T: torque(ground -> crank); assemble B: ahead(A);
             load F: force(rod.G); load H: force(ram.D); scene torque: virtual_work -> (T);"
        ));
        program(&linkage, "torque").counts()
    };
    assert_eq!(operations("(1mm, 0)"), operations("(0, 49mm)"));
}

/// All programs of a linkage, with names and the graph of each: its inverses are linkages of their own.
fn programs(linkage: &linkage_codegen::Linkage) -> Vec<(String, &Program, &Graph)> {
    let functions = &linkage.functions;
    let mut all = vec![("Linkage::new".to_owned(), &functions.prepare), ("Pose::at".to_owned(), &functions.pose)];
    all.extend(functions.near.iter().map(|near| ("Pose::moved_to".to_owned(), near)));
    all.extend(linkage.limits.prepare.iter().map(|prepare| ("Limits::of".to_owned(), prepare)));
    for search in &functions.searches {
        all.push(("each step of a search".to_owned(), &search.step));
        all.push(("the way of a search".to_owned(), &search.on_the_way));
    }
    for (accessor, program) in linkage.plan.accessors.iter().zip(&functions.accessors) {
        all.push((format!("Pose::{}", accessor.name), program));
    }
    for (scene, functions) in linkage.model.scenes.iter().zip(&functions.scenes) {
        all.push((format!("Pose::{}", scene.name), &functions.from_pose));
        all.push((format!("{}_at", scene.name), &functions.direct));
    }
    let own = all.into_iter().map(|(name, program)| (name, program, &linkage.model.graph));
    own.chain(linkage.inverses.iter().flat_map(programs)).collect()
}

/// Every value of every program is read by a later step, or is a result: of every example and of what no example has.
#[test]
fn no_program_computes_what_nothing_reads() {
    let (mut computed, mut looked_at) = (0, 0);
    for (name, linkage) in linkages() {
        for (function, program, _) in programs(&linkage) {
            let uses = program.uses();
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                assert!(matches!(program.value(*value).definition, Definition::Computed(_)));
                let label = &program.value(*value).label;
                assert!(uses[value.index()] > 0, "{name}, {function}: {label:?}");
                computed += 1;
            }
            looked_at += 1;
        }
    }
    assert!(computed > 16_900 && looked_at > 850, "{computed} values in {looked_at} programs");
}

/// The results of a kernel that nothing reads are known: each of these is found with the other one, of which it shares all that takes long, the
/// reduction of the angle, the size of the vector, the elimination. A search has to find all its unknowns.
#[test]
fn unread_results_of_kernels_are_found_beside_others() {
    let mut unread: BTreeSet<(String, String, Kernel, u8)> = BTreeSet::new();
    let mut calls = 0;
    for (name, linkage) in linkages() {
        for (function, program, _) in programs(&linkage) {
            let mut read: BTreeMap<(Kernel, &[ValueId]), BTreeSet<u8>> = BTreeMap::new();
            for value in program.computed() {
                match program.op(value) {
                    Some(Op::Kernel { kernel: Kernel::Search { .. }, .. }) => {}
                    Some(Op::Kernel { kernel, args, part }) => {
                        read.entry((*kernel, args)).or_default().insert(*part);
                    }
                    _ => {}
                }
            }
            calls += read.len();
            for ((kernel, _), parts) in read {
                let left = (0..kernel.parts()).filter(|part| !parts.contains(part));
                unread.extend(left.map(|part| (name.clone(), function.clone(), kernel, part)));
            }
        }
    }
    // The yoke's stroke hangs on the crank's sine alone; of the class IV group's two last equations one unknown is asked; forces along a slide and
    // across one, of which the point moves along an axis only.
    let known = [
        ("class_iv", "speeds", Kernel::Solve2, 0),
        ("class_iv", "torque", Kernel::Solve2, 0),
        ("press", "over", Kernel::Unit, 0),
        ("scotch_yoke", "torque", Kernel::Unit, 1),
        ("shaper", "torque", Kernel::Unit, 1),
    ];
    let both = known.into_iter().flat_map(|(name, scene, kernel, part)| {
        [format!("Pose::{scene}"), format!("{scene}_at")].map(|function| (name.to_owned(), function, kernel, part))
    });
    let direct = ["held_at", "torque_at"];
    let sines = direct.map(|function| ("scotch_yoke".to_owned(), function.to_owned(), Kernel::SinCos, 1));
    assert_eq!(unread, both.chain(sines).collect());
    assert!(calls > 300, "only {calls}");
}

/// What a pose or a prepared linkage keeps is read: by a scene that starts from it, by what can be asked of it, or by a search that does.
#[test]
fn nothing_is_kept_that_nothing_reads() {
    let (mut kept, mut unread) = (0, Vec::new());
    for (name, linkage) in linkages() {
        let functions = &linkage.functions;
        let programs = programs(&linkage);
        let own = programs.iter().filter(|(_, _, graph)| core::ptr::eq(*graph, &raw const linkage.model.graph));
        let read: BTreeSet<NodeId> = own
            .flat_map(|(_, program, _)| program.inputs())
            .filter_map(|(_, input)| match input {
                Input::Kept(node) | Input::Prepared(node) => Some(node),
                Input::Symbol(_) | Input::Known(_) => None,
            })
            .collect();
        let searches = linkage.model.graph.searches();
        let sought: Vec<String> =
            searches.iter().flat_map(|(_, search)| search.sought.iter().flat_map(Sought::names)).collect();
        for number in &linkage.plan.pose {
            kept += 1;
            if !read.contains(&number.node) && !sought.contains(&number.name) {
                unread.push(format!("{name}: {}", number.name));
            }
        }
        for node in &functions.prepared {
            kept += 1;
            if !read.contains(node) {
                unread.push(format!("{name}: prepared {:?}", linkage.model.graph.label(*node)));
            }
        }
    }
    assert!(unread.is_empty(), "of {kept}: {unread:#?}");
    assert!(kept > 300, "only {kept}");
}

/// What a program comes to for numbers of which none is related to another: any given ones, and any results of kernels and roots. So
/// what is a square by a law of triangles is not, and nothing is stationary because a vector has unit size.
struct Unrelated<'a> {
    program: &'a Program,
    numbers: Vec<f64>,
}

impl<'a> Unrelated<'a> {
    fn of(program: &'a Program, graph: &'a Graph, seed: u64) -> Self {
        let mut random = Random(seed);
        let mut unrelated = Self { program, numbers: vec![0.0; program.values.len()] };
        for (index, value) in program.values.iter().enumerate() {
            unrelated.numbers[index] = match &value.definition {
                Definition::Computed(Op::Constant(number)) => graph.number(*number).to_f64(),
                _ => random.range(0.5, 2.0),
            };
        }
        for value in unrelated.computed() {
            if let Some(number) = unrelated.number(value) {
                unrelated.numbers[value.index()] = number;
            }
        }
        unrelated
    }

    /// All that is computed, in an order of evaluation; of a report before its check.
    fn computed(&self) -> Vec<ValueId> {
        let of = |step: &Step| match step {
            Step::Let(value) => vec![*value],
            Step::Check { report, .. } => report.clone(),
            _ => Vec::new(),
        };
        self.program.steps.iter().flat_map(of).collect()
    }

    /// What an operation makes of its operands; of a kernel or a root nothing is known.
    fn number(&self, value: ValueId) -> Option<f64> {
        let at = |operand: &ValueId| self.numbers[operand.index()];
        Some(match self.program.op(value)? {
            Op::Neg(a) => -at(a),
            Op::Abs(a) | Op::NonNegative(a) => at(a).abs(),
            Op::Add(a, b) => at(a) + at(b),
            Op::Sub(a, b) => at(a) - at(b),
            Op::Mul(a, b) => at(a) * at(b),
            Op::Div(a, b) => at(a) / at(b),
            Op::Kernel { kernel: Kernel::MulAdd, args, .. } => at(&args[0]) * at(&args[1]) + at(&args[2]),
            Op::Lesser(a, b) => at(a).min(at(b)),
            // One of two constants, as a side, is either.
            Op::Where { then, .. } if !matches!(self.program.op(*then), Some(Op::Constant(_))) => at(then),
            _ => return None,
        })
    }

    /// What must be right: results, both sides of checks, what they report, and what kernels are given.
    fn wanted(&self) -> Vec<ValueId> {
        let mut wanted: Vec<ValueId> = self.program.outputs.iter().map(|(_, value)| *value).collect();
        for step in &self.program.steps {
            match step {
                Step::Check { .. } => wanted.extend(self.program.operands_of(step)),
                Step::FiniteResults(values) => wanted.extend(values),
                Step::Let(_) | Step::FiniteInput(_) => {}
            }
        }
        for value in self.computed() {
            match self.program.op(value).expect("computed") {
                Op::Kernel { kernel, args, .. } if *kernel != Kernel::MulAdd => wanted.extend(args),
                Op::Where { value, limit, .. } => wanted.extend([value, limit]),
                _ => {}
            }
        }
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }

    /// How a value changes with each of its operands.
    fn slopes(&self, value: ValueId) -> Vec<(ValueId, f64)> {
        let at = |operand: ValueId| self.numbers[operand.index()];
        match self.program.op(value).expect("computed") {
            Op::Neg(a) => vec![(*a, -1.0)],
            Op::Abs(a) | Op::NonNegative(a) => vec![(*a, at(*a).signum())],
            Op::Sqrt(a) => vec![(*a, 0.5 / at(value))],
            Op::Add(a, b) => vec![(*a, 1.0), (*b, 1.0)],
            Op::Sub(a, b) => vec![(*a, 1.0), (*b, -1.0)],
            Op::Mul(a, b) => vec![(*a, at(*b)), (*b, at(*a))],
            Op::Div(a, b) => vec![(*a, 1.0 / at(*b)), (*b, -at(value) / at(*b))],
            Op::Kernel { kernel: Kernel::MulAdd, args, .. } => {
                vec![(args[0], at(args[1])), (args[1], at(args[0])), (args[2], 1.0)]
            }
            Op::Lesser(a, _) | Op::Where { then: a, .. } => vec![(*a, 1.0)],
            _ => Vec::new(),
        }
    }

    /// Which values change something that is wanted, and not only in ways that cancel.
    fn with_effect(&self) -> Vec<bool> {
        let computed = self.computed();
        let mut effect = vec![false; self.numbers.len()];
        for wanted in self.wanted() {
            // How it changes with each value: the sum over all ways, and the sum of their magnitudes.
            let mut change = vec![(0.0f64, 0.0f64); self.numbers.len()];
            change[wanted.index()] = (1.0, 1.0);
            for value in computed.iter().rev() {
                let (sum, size) = change[value.index()];
                if sum.abs() > 1e-9 * size {
                    effect[value.index()] = true;
                    for (operand, slope) in self.slopes(*value) {
                        let (operand_sum, operand_size) = &mut change[operand.index()];
                        *operand_sum += sum * slope;
                        *operand_size += (sum * slope).abs();
                    }
                }
            }
        }
        effect
    }
}

/// No value is computed of which nothing is left in any result, because its terms cancel; but for functions with bounds of rounding
/// errors, which are made of residuals, and for an arm whose numbers happen to balance it.
#[test]
fn no_program_computes_what_cancels() {
    let mut looked_at = 0;
    for (name, linkage) in linkages() {
        for (function, program, graph) in programs(&linkage) {
            let has_bounds = program.outputs.iter().any(|(path, _)| path.contains("error_bound"));
            if has_bounds || (name.as_str(), function.as_str()) == ("balanced_arm", "balanced_at") {
                continue;
            }
            let effects = [1, 2].map(|seed| Unrelated::of(program, graph, seed).with_effect());
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                let has_effect = effects.iter().any(|effect| effect[value.index()]);
                assert!(has_effect, "{name}, {function}: {:?}", program.value(*value));
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 16_000, "{looked_at}");
}

/// Two links whose length is one parameter.
const EQUAL_LINKS: &str = "pub mod equal; units { mm, N } param l: length = 100mm;
    ground { O: (0, 0), Q: (140mm, 0) } link crank { O -> A: 40mm } link b { A -> B: l, P: (30mm, 20mm) } link c { Q -> B: l }
    revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c;
    drive theta: O; assemble B: left(A -> Q); load F: force(b.P); load M: moment(c);
    scene held: equilibrium; scene work: virtual_work; scene place: position;";

/// No value is computed that is a constant whatever is given, such as a length over itself; but where a weight is balanced by a spring, and
/// where a scissor lift is level by its symmetry.
#[test]
fn no_program_computes_a_constant() {
    let mut looked_at = 0;
    let is_balanced = |name: &str, function: &str| match name {
        "balanced_arm" => ["balanced", "work", "check"].iter().any(|scene| function.contains(scene)),
        name => name == "scissor_lift",
    };
    for (name, linkage) in linkages().into_iter().chain([("equal links".to_owned(), compile(EQUAL_LINKS))]) {
        for (function, program, graph) in programs(&linkage) {
            if program.counts_rounding || is_balanced(&name, &function) {
                continue;
            }
            let runs = [1, 2].map(|seed| Unrelated::of(program, graph, seed));
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                if runs[0].number(*value).is_none() {
                    continue;
                }
                let [one, other] = runs.each_ref().map(|run| run.numbers[value.index()]);
                let is_constant = (one - other).abs() <= 1e-12 * one.abs();
                assert!(!is_constant, "{name}, {function}: {:?}", program.value(*value));
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 10_000, "{looked_at}");
}

/// Where constants are in products and sums, through what nothing else reads and what has no name.
struct Constants<'a> {
    program: &'a Program,
    uses: Vec<usize>,
}

impl<'a> Constants<'a> {
    fn of(program: &'a Program) -> Self {
        Self { program, uses: program.uses() }
    }

    fn is_inner(&self, value: ValueId) -> bool {
        self.program.is_inner(value, &self.uses)
    }

    /// Whether a value has constants in all its terms, so that one more could go into these.
    fn takes_one(&self, value: ValueId) -> bool {
        match self.program.op(value) {
            Some(Op::Constant(_)) => true,
            Some(Op::Neg(a)) => self.is_inner(value) && self.takes_one(*a),
            Some(Op::Mul(a, b)) => self.is_inner(value) && (self.takes_one(*a) || self.takes_one(*b)),
            Some(Op::Add(a, b) | Op::Sub(a, b)) => self.is_inner(value) && self.takes_one(*a) && self.takes_one(*b),
            _ => false,
        }
    }

    /// Whether a value has a constant factor.
    fn has_factor(&self, value: ValueId) -> bool {
        match self.program.op(value) {
            Some(Op::Constant(_)) => true,
            Some(Op::Neg(a)) => self.is_inner(value) && self.has_factor(*a),
            Some(Op::Mul(a, b)) => self.is_inner(value) && (self.has_factor(*a) || self.has_factor(*b)),
            _ => false,
        }
    }

    /// Whether a constant is multiplied by what could take it.
    fn is_left(&self, product: ValueId) -> bool {
        let Some(Op::Mul(a, b)) = self.program.op(product) else { return false };
        self.has_factor(*a) && self.takes_one(*b) || self.has_factor(*b) && self.takes_one(*a)
    }
}

/// No constant is multiplied by what has constants of its own that could take it, but where rounding errors are counted.
#[test]
fn constants_are_multiplied_when_compiled() {
    let (mut multiplied, mut left) = (0, Vec::new());
    for (name, linkage) in linkages().into_iter().filter(|(_, linkage)| !linkage.model.graph.counts_rounding()) {
        for (function, program, graph) in programs(&linkage) {
            let constants = Constants::of(program);
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                multiplied += usize::from(program.multiple(graph, *value).is_some());
                if constants.is_left(*value) {
                    left.push(format!("{name}, {function}: {:?}", program.value(*value)));
                }
            }
        }
    }
    assert!(multiplied > 3000, "only {multiplied}");
    assert!(left.is_empty(), "{} of {multiplied}: {left:#?}", left.len());
}

/// The terms of a sum, through what nothing else reads and what has no name: of what each is a multiple, and whether a constant says so.
fn terms(program: &Program, graph: &Graph, uses: &[usize], sum: ValueId) -> Vec<(ValueId, bool)> {
    let is_inner = |value| program.is_inner(value, uses);
    let Some((terms_of, _)) = program.op(sum).and_then(Op::terms) else { return Vec::new() };
    let each = terms_of.into_iter().flat_map(|term| {
        let deeper = if is_inner(term) { terms(program, graph, uses, term) } else { Vec::new() };
        let multiple = program.multiple(graph, term).filter(|_| is_inner(term));
        let own = multiple.map_or((term, false), |(_, of)| (of, true));
        if deeper.is_empty() { vec![own] } else { deeper }
    });
    each.collect()
}

/// No sum has two multiples of one value as terms, but where rounding errors are counted.
#[test]
fn like_terms_are_added_when_compiled() {
    let (mut sums, mut left) = (0, Vec::new());
    for (name, linkage) in linkages() {
        let programs = programs(&linkage);
        for (function, program, graph) in programs.iter().filter(|(_, program, _)| !program.counts_rounding) {
            let uses = program.uses();
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                let terms = terms(program, graph, &uses, *value);
                sums += usize::from(terms.len() > 2);
                let is_double = |(index, (of, is_multiple)): (usize, &(ValueId, bool))| {
                    let before = terms[..index].iter().filter(|(other, _)| other == of);
                    before.map(|(_, other)| *other).any(|other| other || *is_multiple)
                };
                if terms.iter().enumerate().any(is_double) {
                    left.push(format!("{name}, {function}: {:?}", program.value(*value)));
                }
            }
        }
    }
    assert!(sums > 700, "only {sums}");
    assert!(left.is_empty(), "{} of {sums}: {left:#?}", left.len());
}

/// No value is computed twice, in either arithmetic: but what has two names, which are lines of the derivation.
#[test]
fn no_program_computes_the_same_twice() {
    let (mut computed, mut twice) = (0, Vec::new());
    for (name, linkage) in linkages().into_iter().chain(fused_linkages()) {
        for (function, program, _) in programs(&linkage) {
            let mut there: HashMap<(Op<ValueId>, bool), ValueId> = HashMap::new();
            for value in program.computed() {
                computed += 1;
                let mut op = program.op(value).expect("computed").clone();
                match &mut op {
                    Op::Add(a, b) | Op::Mul(a, b) => (*a, *b) = (*a.min(b), *a.max(b)),
                    Op::Kernel { kernel: Kernel::MulAdd, args, .. } => args[..2].sort_unstable(),
                    _ => {}
                }
                let first = *there.entry((op, program.value(value).divided)).or_insert(value);
                let are_lines = [first, value].iter().all(|value| program.value(*value).label.is_some());
                if first != value && !are_lines {
                    twice.push(format!(
                        "{name}, {function}: {:?} and {:?}",
                        program.value(first),
                        program.value(value)
                    ));
                }
            }
        }
    }
    assert!(computed > 30_000, "only {computed}");
    assert!(twice.is_empty(), "{} of {computed}: {twice:#?}", twice.len());
}

/// The names that functions bind and never read behind that, and how many they bind.
#[derive(Default)]
struct Reading {
    function: String,
    /// The names of each block, from the outermost to the innermost, and whether they are read.
    blocks: Vec<Vec<(String, bool)>>,
    bound: usize,
    unread: Vec<String>,
}

impl Reading {
    fn of(code: TokenStream) -> Self {
        let mut reading = Self::default();
        reading.block(code, Vec::new());
        reading
    }

    /// A block in which these names are bound already.
    fn block(&mut self, code: TokenStream, names: Vec<String>) {
        self.blocks.push(Vec::new());
        self.bind(names);
        self.read(&code.into_iter().collect::<Vec<_>>());
        for (name, is_read) in self.blocks.pop().expect("this block") {
            if !is_read {
                self.unread.push(format!("{name} in {}", self.function));
            }
        }
    }

    fn bind(&mut self, names: Vec<String>) {
        self.bound += names.len();
        self.blocks.last_mut().expect("a block").extend(names.into_iter().map(|name| (name, false)));
    }

    fn read(&mut self, code: &[TokenTree]) {
        let mut at = 0;
        while let Some(token) = code.get(at) {
            let before = at.checked_sub(1).map(|before| &code[before]);
            at += 1;
            match token {
                TokenTree::Ident(word) if word == "let" => {
                    let is_condition = before.is_some_and(|before| is(before, "if") || is(before, "while"));
                    at = self.binding(code, at, is_condition);
                }
                TokenTree::Ident(word) if word == "fn" => at = self.function(code, at),
                TokenTree::Ident(word) if word == "use" || word == "struct" => at = end_of_item(code, at),
                TokenTree::Ident(name) => {
                    // Neither a field or a method, nor a part of a path, nor the name of a field before its value, nor a lifetime.
                    let is_range = at > 2 && is(&code[at - 3], ".");
                    let is_part = before
                        .is_some_and(|mark| is(mark, ".") && !is_range || follows_path(code, at - 2) || is(mark, "'"));
                    let is_field = code.get(at).is_some_and(|mark| is(mark, ":"));
                    if !is_part && !is_field {
                        self.mark(&name.to_string());
                    }
                }
                // An attribute.
                TokenTree::Punct(mark) if mark.as_char() == '#' => at += 1,
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                    self.block(group.stream(), Vec::new());
                }
                TokenTree::Group(group) => self.read(&group.stream().into_iter().collect::<Vec<_>>()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }

    fn mark(&mut self, name: &str) {
        let mut all = self.blocks.iter_mut().rev().flat_map(|block| block.iter_mut().rev());
        if let Some((_, is_read)) = all.find(|(bound, _)| bound == name) {
            *is_read = true;
        }
    }

    /// What stands behind a `let`; the place behind it.
    fn binding(&mut self, code: &[TokenTree], start: usize, is_condition: bool) -> usize {
        let equals = start + code[start..].iter().position(|token| is(token, "=")).expect("a value");
        let pattern = &code[start..equals];
        // A type may follow.
        let typed = (0..pattern.len()).find(|at| is(&pattern[*at], ":") && !in_path(pattern, *at));
        let names = bound_by(&pattern[..typed.unwrap_or(pattern.len())]);
        let is_end = |token: &TokenTree| match token {
            TokenTree::Group(group) => is_condition && group.delimiter() == Delimiter::Brace,
            token => is(token, ";"),
        };
        let end = equals + code[equals..].iter().position(is_end).expect("an end");
        self.read(&code[equals + 1..end]);
        match &code[end] {
            TokenTree::Group(group) => self.block(group.stream(), names),
            _ => self.bind(names),
        }
        end + 1
    }

    /// What stands behind `fn`: nothing outside is seen there.
    fn function(&mut self, code: &[TokenTree], start: usize) -> usize {
        let is_body =
            |token: &TokenTree| matches!(token, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace);
        let body = start + code[start..].iter().position(is_body).expect("a body");
        let TokenTree::Group(group) = &code[body] else { return body };
        let outside = core::mem::take(&mut self.blocks);
        let function = core::mem::replace(&mut self.function, code[start].to_string());
        self.block(group.stream(), Vec::new());
        (self.blocks, self.function) = (outside, function);
        body + 1
    }
}

/// Whether a token is this word or mark.
fn is(token: &TokenTree, text: &str) -> bool {
    !matches!(token, TokenTree::Group(_)) && token.to_string() == text
}

/// Whether a colon is one of two.
fn in_path(code: &[TokenTree], at: usize) -> bool {
    follows_path(code, at) || code.get(at + 1).is_some_and(|next| is(next, ":"))
}

/// Whether a token is the second of two colons.
fn follows_path(code: &[TokenTree], at: usize) -> bool {
    at > 0 && is(&code[at], ":") && is(&code[at - 1], ":")
}

/// The place behind an item that is no function.
fn end_of_item(code: &[TokenTree], start: usize) -> usize {
    let is_end = |token: &TokenTree| match token {
        TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
        token => is(token, ";"),
    };
    code[start..].iter().position(is_end).map_or(code.len(), |end| start + end + 1)
}

/// The names that a pattern binds.
fn bound_by(pattern: &[TokenTree]) -> Vec<String> {
    let mut names = Vec::new();
    for (at, token) in pattern.iter().enumerate() {
        match token {
            TokenTree::Group(group) => names.extend(bound_by(&group.stream().into_iter().collect::<Vec<_>>())),
            TokenTree::Ident(name) => {
                // A type, a variant, or the name of a field before a pattern.
                let is_other =
                    pattern.get(at + 1).is_some_and(|next| is(next, ":") || matches!(next, TokenTree::Group(_)));
                let is_variant = at > 0 && follows_path(pattern, at - 1);
                let is_word = ["mut", "ref", "_", "None"].iter().any(|word| name == word);
                if !(is_other || is_variant || is_word) {
                    names.push(name.to_string());
                }
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    names
}

/// Every name that a function of the emitted code binds is read behind it, in that function: so in the code of every example and of what no
/// example has, sweeps, searches and limits included.
#[test]
fn no_emitted_function_binds_what_it_does_not_read() {
    let mut bound = 0;
    let mut unread = Vec::new();
    for (name, declaration) in declarations() {
        let reading = Reading::of(linkage_codegen::expand(declaration));
        unread.extend(reading.unread.into_iter().map(|what| format!("{name}: {what}")));
        bound += reading.bound;
    }
    assert!(bound > 9000, "only {bound} names");
    assert!(unread.is_empty(), "{} of {bound}: {unread:#?}", unread.len());
}

/// A root that cannot vanish is not asked whether it does, on whichever side it stands: crank-rocker, slider-crank and a lever with a slot.
#[test]
fn no_side_asks_for_a_dead_centre_that_there_is_not() {
    let crank =
        "units { mm, N } ground { O: (0, 0), Q: (180mm, 0) } link crank { O -> A: 50mm } revolute O: ground -> crank;
        drive theta: O; unknown T: torque(ground -> crank);";
    let rocker =
        "link coupler { A -> B: 120mm } link rocker { Q -> B: 200mm, D: (60mm, 20mm) } revolute A: crank -> coupler;
        revolute B: coupler -> rocker; revolute Q: ground -> rocker; load F: force(rocker.D); scene held: equilibrium;";
    let slider = "link rod { A -> B: 180mm } link block { B } revolute A: crank -> rod; revolute B: rod -> block;
        prismatic G: ground.O -> block.B along 0deg; load F: force(block.B); scene held: equilibrium;";
    let lever = "link lever { Q: (0, 0), D: (60mm, 20mm) } revolute Q: ground -> lever; slot S: lever.Q -> crank.A along 0deg of lever;
        load F: force(lever.D); scene held: equilibrium;";
    let sides = |joint: &str, of: &str, words: [&str; 3]| words.map(|word| format!("assemble {joint}: {word}({of});"));
    for (rest, sides) in [
        (rocker, sides("B", "A -> Q", ["left", "right", "either"])),
        (slider, sides("B", "A", ["ahead", "behind", "either"])),
        (lever, sides("S", "Q", ["ahead", "behind", "either"])),
    ] {
        for side in sides {
            let code = expand(format!("mod m; {crank} {rest} {side}").parse().expect("tokens")).to_string();
            assert!(code.contains("held_at") && !code.contains("DeadCentre"), "{side}");
        }
    }
}

/// Pins that their lengths keep apart are not asked whether they coincide, nor a slot whether its pin reaches it, nor the ends of a spring.
#[test]
fn nothing_asks_whether_points_meet_that_never_do() {
    let crank = "units { mm, N } link crank { O -> A: 50mm } revolute O: ground -> crank; drive theta: O;
        unknown T: torque(ground -> crank);";
    let lever = |own: &str| {
        format!(
            "link lever {{ Q: (0, 0), {own}, D: (60mm, 20mm) }} revolute Q: ground -> lever;
            slot S: lever.P -> crank.A along 0deg of lever; assemble S: ahead(Q); load F: force(lever.D);"
        )
    };
    let cylinder = |own: &str| {
        format!(
            "link barrel {{ Q: (0, 0), {own}, D: (60mm, 20mm) }} link piston {{ A }} revolute Q: ground -> barrel;
            revolute A: crank -> piston; prismatic S: barrel.P -> piston.A along 0deg of barrel; assemble S: ahead(Q);
            load F: force(barrel.D);"
        )
    };
    let asks = |distance: u32, rest: String| {
        let ground = format!("ground {{ O: (0, 0), Q: ({distance}mm, 0) }}");
        let declaration = format!("mod m; {ground} {crank} {rest} scene held: equilibrium;");
        let code = expand(declaration.parse().expect("tokens")).to_string();
        assert!(code.contains("held_at") && !code.contains("compile_error"), "{declaration}");
        ["DeadCentre", "CoincidentPivots", "CannotAssemble", "CoincidentEnds"]
            .iter()
            .any(|error| code.contains(&format!("Error :: {error}")))
    };
    let spring = |load: &str| format!("load K: {load};");
    for load in ["spring(ground.Q, crank.A) { rate: 3N/mm, free: 10mm }", "thrust(crank.A, ground.Q)"] {
        assert!(asks(50, spring(load)) && !asks(51, spring(load)), "{load}");
    }
    for (own, distance_that_it_may_have) in [("P: (10mm, 0)", 50), ("P: (10mm, 30mm)", 80), ("P: (10mm, -130mm)", 180)]
    {
        for rest in [lever(own), cylinder(own)] {
            assert!(asks(distance_that_it_may_have, rest.clone()), "{rest}");
            assert!(!asks(distance_that_it_may_have + 1, rest.clone()), "{rest}");
        }
    }
}

/// How fast wheels turn is found from their radii (Willis), and not by the direction in which their teeth press: where arm and sun turn
/// steadily, no angular acceleration is left of their planet's.
#[test]
fn rates_of_wheels_are_found_from_their_radii() {
    let train = "mod m; units { mm, N } ground { O: (0, 0) } link arm { O -> P: 50mm } link sun { O } link planet { P }
        revolute Oa: ground.O -> arm.O; revolute Os: ground.O -> sun.O; revolute P: arm -> planet;
        gear G: sun.O -> planet.P, radii (20mm, 30mm), pressure_angle 20deg, flank left;
        mass planet: 1kg at P, inertia 500kg*mm^2; load I: inertia;";
    let steady = "drive a: Oa { rate: 1000rpm, acceleration: 0 }; drive b: Os { rate: 3000rpm, acceleration: 0 };
        scene turning: acceleration -> (planet.angle); scene held: equilibrium -> (effort_b);";
    let moved = "drive a: Oa; drive b: Os; scene turning: velocity -> (planet.angle);";
    let counts = |rest: &str| {
        let linkage = analyse(format!("{train} {rest}").parse().expect("tokens")).expect("a linkage");
        let scenes = linkage.functions.scenes.iter();
        scenes.map(|scene| scene.from_pose.counts().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(counts(steady), ["no operation", "no operation"]);
    assert_eq!(counts(moved), ["1 +−, 2 ×, 1 compare"]);
}

/// What the test before this one looks for is found.
#[test]
fn a_name_that_is_not_read_is_found() {
    for (code, expected) in [
        ("let a = 1; let b = a; b", &[][..]),
        ("let a = 1; let b = 2; a", &["b"]),
        ("let a = 1; let a = a; a", &[]),
        ("let a = 1; let a = 2; a", &["a"]),
        ("let a = a;", &["a"]),
        ("let a = 1; b.a + c::a(b.a())", &["a"]),
        ("let a = 1; S { a: 2 }", &["a"]),
        ("let a = 1; let b = 2; S { a, c: b }", &[]),
        ("let a = 1; 0..a", &[]),
        ("let (a, _) = f(); let [b, mut c] = a; c", &["b"]),
        ("let Self { a, b: d, .. } = *self; b + a", &["d"]),
        ("let p::S { a: [b, c], .. } = s; b", &["c"]),
        ("let S { a: ref b, .. } = s; a", &["b"]),
        ("let a: f64 = 1; f64", &["a"]),
        ("let a = 1; { let a = 2; a }", &["a"]),
        ("if let Some(a) = f(b) { a } let c = 1; if let Some(c) = d { c }", &["c"]),
        ("while let Some((a, b)) = s.f() { a }", &["b"]),
        ("let Some(a) = b else { continue }; f(&a)", &[]),
        ("let a = 1; fn g() { a }", &["a"]),
        ("let a = 1; #[doc = a] struct S<'a> { a: a } f(|x| x[a])", &[]),
    ] {
        let code: TokenStream = format!("fn f() {{ {code} }}").parse().expect("tokens");
        let expected: Vec<String> = expected.iter().map(|name| format!("{name} in f")).collect();
        assert_eq!(Reading::of(code.clone()).unread, expected, "{code}");
    }
}
