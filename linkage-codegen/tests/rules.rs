//! Every rule of the list against the constraints and the equilibrium equations of its group.

mod support;

use linkage_codegen::graph::real::Real;
use linkage_codegen::plan::rules::RULES;
use support::general::{equations, solve_extended};
use support::numbers::Extended;
use support::{Arguments, Number, compile, scene};

/// A linkage for each class of groups, with the class named, drives at which it closes, and how the rule is used.
const CASES: [(&str, &[f64], &str); 19] = [
    // Motion and forces of a crank, its arrow either way, with an inclined dyad.
    (
        "link on a pin",
        &[0.4, 2.0, -1.3],
        "ground { O: (1m, 2m), Q: (4m, 1m) } link crank { O: (0.3m, 0.1m), A: (1.1m, 0.9m) } link b { A -> B: 3m } link c { Q -> B: 2.5m }
         revolute O: crank -> ground; revolute A: b -> crank; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         assemble B: right(Q -> A); load F: force(b.B) = (3N, -2N); load M: moment(c) = 2N*m;",
    ),
    // A force on the crank that holds it along a line that turns with another link.
    (
        "link on a pin",
        &[0.4, 1.2],
        "ground { O: (0, 0), Q: (3m, 0) } link crank { O -> A: 1m, P: (0.5m, 0.5m) } link b { A -> B: 3m } link c { Q -> B: 2.5m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         unknown E: force(crank.P) along 70deg of c; assemble B: left(A -> Q); load F: force(b.B) = (3N, -2N);",
    ),
    // A driven piston whose line it carries itself.
    (
        "link on a slide",
        &[0.4, 1.5],
        "ground { G: (1m, 0.5m), Q: (0, 3m) } link piston { G: (0.2m, 0.4m), A: (0.5m, -0.3m) } link b { A -> B: 3m } link c { Q -> B: 2.5m }
         prismatic G: piston -> ground along 25deg of piston, angle 40deg; revolute A: piston -> b; revolute B: b -> c; revolute Q: ground -> c;
         drive q: G; assemble B: left(A -> Q); load F: force(b.B) = (3N, -2N); load M: moment(piston) = 2N*m;",
    ),
    // A piston held by a force that is not along its slide.
    (
        "link on a slide",
        &[0.4, 2.5],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link rod { A -> B: 3m } link piston { B, G: (0.1m, 0), P: (0.4m, 0.3m) }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: ground -> piston along 10deg; drive q: O;
         unknown E: force(piston.P) along 50deg; assemble B: ahead(A); load M: moment(crank) = 5N*m; load F: force(rod.B) = (1N, 2N);",
    ),
    (
        "RRR dyad",
        &[0.4, 2.0, -2.0],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A: (0.2m, 0.1m), B: (2m, 2m), P: (1m, -1m) }
         link c { Q: (0, 1m), B: (2m, 0), P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: b -> crank; revolute B: c -> b; revolute Q: ground -> c; drive q: O;
         assemble B: left(A -> Q); load F: force(b.P) = (3N, -2N); load H: force(c.P) in b = (1N, 4N);",
    ),
    // An RRR dyad of forces that is none of motion: crank and rod, held at the piston.
    (
        "RRR dyad",
        &[0.4, 2.0],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link rod { A -> B: 3m, P: (1m, 1m) } link piston { B, G }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: piston -> ground along 10deg; drive q: O;
         unknown E: force(piston.B) along 10deg; assemble B: ahead(A); load M: moment(crank) = 5N*m; load F: force(rod.P) = (1N, 2N);",
    ),
    // A slider guided by a moving link, which carries the line.
    (
        "RRP dyad",
        &[0.4, 1.0],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> G: 2m } link rod { A -> B: 3m, P: (1m, 1m) }
         link slider { B: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } revolute O: ground -> crank; revolute Q: ground -> arm;
         revolute A: crank -> rod; revolute B: rod -> slider; prismatic G: arm -> slider along 80deg of arm, angle 15deg;
         drive q: O; drive r: Q; assemble B: ahead(A); load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N);",
    ),
    // An oscillating block beside the line through its pin, with the slide's line on the rod, at an angle to everything.
    (
        "RPR dyad",
        &[0.4, 2.0, -2.0],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0.1m, 0.2m), S: (0.5m, 0.3m), P: (1m, 1m) }
         link block { C: (0.2m, 0.1m), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         prismatic S: block -> rod along 25deg of rod, angle 40deg; drive q: O; assemble S: behind(C);
         load F: force(rod.P) = (3N, -2N); load H: force(block.P) in rod = (1N, 4N); load M: moment(crank -> block) = 2N*m;",
    ),
    // Without an offset; the other pin is named.
    (
        "RPR dyad",
        &[0.4, 2.0, -2.0],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0, 0), P: (1m, 1m) }
         link block { C: (0, 0), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         prismatic S: rod.A -> block.C along 0deg of block; drive q: O; assemble S: behind(C);
         load F: force(rod.P) = (3N, -2N); load H: force(block.P) = (1N, 4N);",
    ),
    // An RPR dyad of forces that is none of motion: a cylinder drives the boom, and a torque holds it.
    (
        "RPR dyad",
        &[1.4, 1.8],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: tube.P -> rod.Q along 10deg of tube;
         drive reach: lift; unknown E: torque(ground -> boom); assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load H: force(tube.G) = (1N, 4N); load J: force(rod.G) = (2N, 1N);",
    ),
    // Two sliders on links that turn.
    (
        "PRP dyad",
        &[0.4, 1.0, -0.8],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> G: 0.5m } link arm { Q -> H: 2m }
         link one { B: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } link two { B: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute B: two -> one;
         prismatic G: one -> crank along 80deg of crank, angle 15deg; prismatic H: arm -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: Q; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // A sine generator: both guides are the ground's but for the crank.
    (
        "PRP dyad",
        &[0.4, 1.0, 2.4],
        "ground { O: (0, 0), G: (0.4m, 0) } link arm { O: (0, 0), h: (0, 0.1m) } link block { B: (0, 0) } link slider { B: (0, 0), t: (0.1m, 0.2m) }
         revolute O: ground -> arm; prismatic P: arm.h -> block.B along 0deg of arm; revolute B: block -> slider;
         prismatic G: ground.G -> slider.B along 90deg; drive q: O; load F: force(slider.t) = (12N, -9N); load M: moment(block) = 2N*m;",
    ),
    (
        "RPP dyad",
        &[0.4, 1.0, -0.8],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> H: 2m }
         link one { A: (0.1m, 0.2m), S: (0.4m, 0.3m), P: (1m, 0) } link two { S: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute A: crank -> one;
         prismatic S: one -> two along 80deg of one, angle 15deg; prismatic H: arm -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: Q; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // A Scotch yoke with a block in its slot.
    (
        "RPP dyad",
        &[0.4, 1.0, 2.4],
        "ground { O: (0, 0), G: (0.4m, 0) } link crank { O -> A: 0.3m } link block { A: (0, 0) } link yoke { S: (0, 0), t: (0.1m, 0.2m) }
         revolute O: ground -> crank; revolute A: crank -> block; prismatic S: yoke.S -> block.A along 90deg of yoke;
         prismatic G: ground.G -> yoke.S along 0deg; drive q: O; load F: force(yoke.t) = (12N, -9N); load M: moment(block) = 2N*m;",
    ),
    // A cylinder whose ends are beside its line.
    (
        "RRR dyad",
        &[1.4, 1.8, 1.1],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0.1m), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: tube.G -> rod.Q along 10deg of rod, angle 50deg;
         drive reach: lift; assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load H: force(tube.G) = (1N, 4N); load J: force(rod.G) = (2N, 1N);",
    ),
    // Coupler and rocker, driven against each other.
    (
        "RRR dyad",
        &[1.3, -2.0],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link coupler { A -> B: 0.9m, P: (0.5m, 0.2m) } link rocker { Q -> B: 0.7m }
         revolute O: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute Q: ground -> rocker;
         drive q: B; assemble A: left(O -> Q); load F: force(coupler.P) = (3N, -2N); load M: moment(crank) = 1N*m;",
    ),
    // A slider whose pin is moved along by a drive, and a rod that is a cylinder.
    (
        "RRP dyad",
        &[0.3, 0.1],
        "ground { A: (0, 1m), G: (0, 0) } link tube { A: (0, 0) } link rod { B: (0, 0), P: (1m, 1m) } link slider { G: (0, 0), S: (0.2m, 0.1m), P: (1m, 0.3m) } link carriage { S: (0, 0), B: (0.2m, 0.3m) }
         revolute A: ground -> tube; prismatic lift: tube.A -> rod.B along 0deg of tube; revolute B: rod -> carriage; prismatic S: slider -> carriage along 60deg of slider;
         prismatic G: ground -> slider along 5deg; drive q: S; drive r: lift; assemble B: ahead(A);
         load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N);",
    ),
    // A torque on the coupler: the links on both sides are members.
    (
        "block",
        &[0.4, 2.0],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m, P: (0.5m, 0.5m) } link b { A -> B: 3m, P: (1m, -1m) } link c { Q -> B: 2.5m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         unknown E: torque(ground -> b); assemble B: left(A -> Q); load F: force(b.P) = (3N, -2N); load H: force(crank.P) = (1N, 4N);",
    ),
    // A force on the rod of a slider-crank: a core of three.
    (
        "block",
        &[0.4, 2.0],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link rod { A -> B: 3m, P: (1m, 1m) } link piston { B: (0.1m, 0.3m), G, P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: piston -> ground along 10deg; drive q: O;
         unknown E: force(rod.P) along 70deg of crank; assemble B: ahead(A); load M: moment(crank) = 5N*m; load F: force(piston.P) = (1N, 2N);",
    ),
];

#[test]
fn every_rule_satisfies_the_equations_of_its_group() {
    for (class, drives, items) in CASES {
        let text = format!("pub mod sample; {items} scene all: equilibrium; scene work: virtual_work;");
        let linkage = compile(&text);
        let used = linkage.plan.motion_rules.iter().chain(&linkage.plan.force_rules);
        assert!(used.into_iter().any(|rule| *rule == class), "{class} is not used\n{text}");
        let second = if text.contains("drive r: lift") { 1.7 } else { 0.3 };
        for drive in drives {
            // A second drive stays where the linkage closes.
            let drives = if linkage.model.drives.len() == 2 { vec![*drive, second] } else { vec![*drive] };
            let arguments = Arguments { drives, loads: vec![[0.0; 2]; linkage.model.loads.len()], params: Vec::new() };
            check(&linkage, &arguments, &text);
        }
    }
}

fn check(linkage: &linkage_codegen::Linkage, arguments: &Arguments, text: &str) {
    // In 220 bits nothing but a wrong formula makes a difference.
    let general = equations::<Extended>(linkage, arguments).unwrap_or_else(|fault| panic!("{fault:?}\n{text}"));
    for residual in &general.residuals {
        assert!(residual.to_f64().abs() < 1e-55, "constraint: {:e}\n{text}", residual.to_f64());
    }
    let solution = solve_extended(&general.matrix, &general.right_side(&|_| true)).expect("regular");
    let all = scene::<Extended>(linkage, "all", arguments).unwrap();
    for (name, value) in general.named(linkage, solution) {
        let error = (all[&name].to_f64() - value.to_f64()).abs();
        assert!(error <= 1e-13 * value.to_f64().abs().max(1.0), "{name}\n{text}");
        assert!(all[&name].sub(&value).to_f64().abs() < 1e-50, "{name}: equilibrium\n{text}");
    }
    let work = scene::<Extended>(linkage, "work", arguments).unwrap();
    for unknown in &linkage.model.unknowns {
        let difference = all[&unknown.name].sub(&work[&unknown.name]).to_f64();
        assert!(difference.abs() < 1e-50, "{}: virtual work {difference:e}\n{text}", unknown.name);
    }
}

#[test]
fn every_rule_has_a_case() {
    for rule in RULES {
        assert!(CASES.iter().any(|(class, ..)| *class == rule.class()), "{} has no case", rule.class());
    }
}
