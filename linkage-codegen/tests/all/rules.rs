//! Every rule of the list against the constraints and the equilibrium equations of its group.

use std::collections::BTreeMap;

use crate::support::bounds::{LOOSEST, median, ratios_of};
use crate::support::families::single;
use crate::support::far_points;
use crate::support::general::{equations, open_motion, residuals, solve_extended};
use crate::support::numbers::{Double, Extended, Single};
use crate::support::{Arguments, Number, compile, index_of, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::Op;
use linkage_codegen::graph::real::Real;
use linkage_codegen::model::JointKind;
use linkage_codegen::plan::rules::RULES;
use linkage_codegen::program::Definition;

/// A linkage for each class of groups, with the class named, drives at which it closes, and how the rule is used.
const CASES: [(&str, &[&[f64]], &str); 86] = [
    // Motion and forces of a crank, its arrow either way, with an inclined dyad.
    (
        "link on a pin",
        &[&[0.4], &[2.0], &[-1.3]],
        "ground { O: (1m, 2m), Q: (4m, 1m) } link crank { O: (0.3m, 0.1m), A: (1.1m, 0.9m) } link b { A -> B: 3m } link c { Q -> B: 2.5m }
         revolute O: crank -> ground; revolute A: b -> crank; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         assemble B: right(Q -> A); load F: force(b.B) = (3N, -2N); load M: moment(c) = 2N*m;",
    ),
    // A force on the crank that holds it along a line that turns with another link.
    (
        "link on a pin",
        &[&[0.4], &[1.2]],
        "ground { O: (0, 0), Q: (3m, 0) } link crank { O -> A: 1m, P: (0.5m, 0.5m) } link b { A -> B: 3m } link c { Q -> B: 2.5m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         unknown E: force(crank.P) along 70deg of c; assemble B: left(A -> Q); load F: force(b.B) = (3N, -2N);",
    ),
    // A driven piston whose line it carries itself.
    (
        "link on a slide",
        &[&[0.4], &[1.5]],
        "ground { G: (1m, 0.5m), Q: (0, 3m) } link piston { G: (0.2m, 0.4m), A: (0.5m, -0.3m) } link b { A -> B: 3m } link c { Q -> B: 2.5m }
         prismatic G: piston -> ground along 25deg of piston, angle 40deg; revolute A: piston -> b; revolute B: b -> c; revolute Q: ground -> c;
         drive q: G; assemble B: left(A -> Q); load F: force(b.B) = (3N, -2N); load M: moment(piston) = 2N*m;",
    ),
    // A piston held by a force that is not along its slide.
    (
        "link on a slide",
        &[&[0.4], &[2.5]],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link rod { A -> B: 3m } link piston { B, G: (0.1m, 0), P: (0.4m, 0.3m) }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: ground -> piston along 10deg; drive q: O;
         unknown E: force(piston.P) along 50deg; assemble B: ahead(A); load M: moment(crank) = 5N*m; load F: force(rod.B) = (1N, 2N);",
    ),
    (
        "RRR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A: (0.2m, 0.1m), B: (2m, 2m), P: (1m, -1m) }
         link c { Q: (0, 1m), B: (2m, 0), P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: b -> crank; revolute B: c -> b; revolute Q: ground -> c; drive q: O;
         assemble B: left(A -> Q); load F: force(b.P) = (3N, -2N); load H: force(c.P) in b = (1N, 4N);",
    ),
    // Parallelograms that move through their folds, and a crossed one; on an inclined line, from either outer pin, of four equal sides, and
    // with the dyad between links that both move.
    (
        "RRR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), Q: (1.2m, 0.5m) } link crank { O: (0.1m, 0.2m), A: (0.4m, 0.6m) }
         link b { A: (0.1m, 0.2m), B: (1.3m, 0.7m), P: (1m, -1m) } link c { Q: (0, 1m), B: (0.3m, 1.4m), P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: b -> crank; revolute B: c -> b; revolute Q: ground -> c; drive q: O;
         assemble B: left(A -> Q) smooth at 40deg; load F: force(b.P) = (3N, -2N); load H: force(c.P) in b = (1N, 4N);",
    ),
    (
        "RRR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), Q: (1.2m, 0.5m) } link crank { O -> A: 0.5m } link b { A -> B: 1.3m, P: (1m, -1m) } link c { Q -> B: 0.5m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         assemble B: right(A -> Q) smooth at 40deg; load F: force(b.P) = (3N, -2N); load M: moment(c) = 2N*m;",
    ),
    (
        "RRR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), Q: (1.2m, 0.5m) } link crank { O -> A: 0.5m } link b { B -> A: 1.3m, P: (1m, -1m) } link c { B -> Q: 0.5m }
         revolute O: crank -> ground; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         assemble B: right(Q -> A) smooth at -40deg; load F: force(b.P) = (3N, -2N); load M: moment(c) = 2N*m;",
    ),
    (
        "RRR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), Q: (2m, 0) } link crank { O -> A: 2m } link b { A -> B: 2m, P: (1m, -1m) } link c { Q -> B: 2m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         assemble B: left(A -> Q) smooth at 40deg; load F: force(b.P) = (3N, -2N); load M: moment(c) = 2N*m;",
    ),
    (
        "RRR dyad",
        &[&[0.4, 0.7], &[2.0, -1.0], &[-2.0, 2.5]],
        "ground { G: (1m, 1m) } link base { G: (0.3m, 0.1m), O: (0, 0), Q: (1.2m, 0.5m) } link crank { O -> A: 0.5m }
         link b { A -> B: 1.3m, P: (1m, -1m) } link c { Q -> B: 0.5m } revolute G: ground -> base;
         revolute O: base -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: base -> c; drive r: G; drive q: O;
         assemble B: left(A -> Q) smooth at 40deg; load F: force(b.P) = (3N, -2N); load M: moment(c) = 2N*m;",
    ),
    // An RRR dyad of forces that is none of motion: crank and rod, held at the piston.
    (
        "RRR dyad",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link rod { A -> B: 3m, P: (1m, 1m) } link piston { B, G }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: piston -> ground along 10deg; drive q: O;
         unknown E: force(piston.B) along 10deg; assemble B: ahead(A); load M: moment(crank) = 5N*m; load F: force(rod.P) = (1N, 2N);",
    ),
    // A slider guided by a moving link, which carries the line.
    (
        "RRP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> G: 2m } link rod { A -> B: 3m, P: (1m, 1m) }
         link slider { B: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } revolute O: ground -> crank; revolute Q: ground -> arm;
         revolute A: crank -> rod; revolute B: rod -> slider; prismatic G: arm -> slider along 80deg of arm, angle 15deg;
         drive q: O; drive r: Q; assemble B: ahead(A); load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N);",
    ),
    // An oscillating block beside the line through its pin, with the slide's line on the rod, at an angle to everything.
    (
        "RPR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0.1m, 0.2m), S: (0.5m, 0.3m), P: (1m, 1m) }
         link block { C: (0.2m, 0.1m), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         prismatic S: block -> rod along 25deg of rod, angle 40deg; drive q: O; assemble S: behind(C);
         load F: force(rod.P) = (3N, -2N); load H: force(block.P) in rod = (1N, 4N); load M: moment(crank -> block) = 2N*m;",
    ),
    // Without an offset; the other pin is named.
    (
        "RPR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0, 0), P: (1m, 1m) }
         link block { C: (0, 0), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         prismatic S: rod.A -> block.C along 0deg of block; drive q: O; assemble S: behind(C);
         load F: force(rod.P) = (3N, -2N); load H: force(block.P) = (1N, 4N);",
    ),
    // An RPR dyad of forces that is none of motion: a cylinder drives the boom, and a torque holds it.
    (
        "RPR dyad",
        &[&[1.4], &[1.8]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: tube.P -> rod.Q along 10deg of tube;
         drive reach: lift; unknown E: torque(ground -> boom); assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load H: force(tube.G) = (1N, 4N); load J: force(rod.G) = (2N, 1N);",
    ),
    // Two sliders on links that turn.
    (
        "PRP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3], &[-0.8, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> G: 0.5m } link arm { Q -> H: 2m }
         link one { B: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } link two { B: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute B: two -> one;
         prismatic G: one -> crank along 80deg of crank, angle 15deg; prismatic H: arm -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: Q; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // A sine generator: both guides are the ground's but for the crank.
    (
        "PRP dyad",
        &[&[0.4], &[1.0], &[2.4]],
        "ground { O: (0, 0), G: (0.4m, 0) } link arm { O: (0, 0), h: (0, 0.1m) } link block { B: (0, 0) } link slider { B: (0, 0), t: (0.1m, 0.2m) }
         revolute O: ground -> arm; prismatic P: arm.h -> block.B along 0deg of arm; revolute B: block -> slider;
         prismatic G: ground.G -> slider.B along 90deg; drive q: O; load F: force(slider.t) = (12N, -9N); load M: moment(block) = 2N*m;",
    ),
    (
        "RPP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3], &[-0.8, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> H: 2m }
         link one { A: (0.1m, 0.2m), S: (0.4m, 0.3m), P: (1m, 0) } link two { S: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute A: crank -> one;
         prismatic S: one -> two along 80deg of one, angle 15deg; prismatic H: arm -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: Q; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // A Scotch yoke with a block in its slot.
    (
        "RPP dyad",
        &[&[0.4], &[1.0], &[2.4]],
        "ground { O: (0, 0), G: (0.4m, 0) } link crank { O -> A: 0.3m } link block { A: (0, 0) } link yoke { S: (0, 0), t: (0.1m, 0.2m) }
         revolute O: ground -> crank; revolute A: crank -> block; prismatic S: yoke.S -> block.A along 90deg of yoke;
         prismatic G: ground.G -> yoke.S along 0deg; drive q: O; load F: force(yoke.t) = (12N, -9N); load M: moment(block) = 2N*m;",
    ),
    // A cylinder whose ends are beside its line.
    (
        "RRR dyad",
        &[&[1.4], &[1.8], &[1.1]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0.1m), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: tube.G -> rod.Q along 10deg of rod, angle 50deg;
         drive reach: lift; assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load H: force(tube.G) = (1N, 4N); load J: force(rod.G) = (2N, 1N);",
    ),
    // Cylinders of which one part alone is loaded, or both, the line carried by either.
    (
        "RRR dyad",
        &[&[1.4], &[1.8], &[-1.1]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0.1m), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: tube.G -> rod.Q along 10deg of tube, angle 50deg;
         drive reach: lift; assemble Q: left(P -> O); load F: force(boom.T) = (3N, -2N); load J: force(rod.G) = (2N, 1N);",
    ),
    (
        "RRR dyad",
        &[&[1.4], &[1.8], &[-1.1]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0.1m), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: tube.G -> rod.Q along 10deg of rod, angle 50deg;
         drive reach: lift; assemble Q: left(O -> P); load F: force(boom.T) = (3N, -2N); load J: force(tube.G) = (2N, 1N); load M: moment(boom -> tube) = 2N*m;",
    ),
    (
        "RRR dyad",
        &[&[1.4], &[1.8], &[-1.1]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0.1m), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; prismatic lift: rod.Q -> tube.G along 10deg of tube, angle 50deg;
         drive reach: lift; assemble Q: left(O -> P); load F: force(rod.G) in boom = (3N, -2N); load J: force(tube.G) = (2N, 1N); load M: moment(rod) = 2N*m;",
    ),
    // The same of more parts, one of them held beside the way from pin to pin: the middle alone is loaded, or what is beside it, or the ends.
    (
        "RRR dyad",
        &[&[0.6], &[0.9]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link foot { P: (0, 0.1m), W: (0.1m, 0.5m) } link tube { W: (0.1m, 0), G: (0.3m, 0.2m), V: (0.2m, 0.2m) }
         link arm { V: (0, 0), K: (0.4m, 0.3m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> foot; weld W: foot -> tube, angle 20deg; weld V: arm -> tube, angle 35deg; revolute Q: rod -> boom;
         prismatic lift: tube.G -> rod.Q along 80deg of tube, angle 50deg; drive reach: lift; assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load J: force(tube.G) = (2N, 1N); load H: force(arm.K) = (-1N, 3N);",
    ),
    (
        "RRR dyad",
        &[&[0.6], &[0.9]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link foot { P: (0, 0.1m), W: (0.1m, 0.5m) } link tube { W: (0.1m, 0), G: (0.3m, 0.2m), V: (0.2m, 0.2m) }
         link arm { V: (0, 0), K: (0.4m, 0.3m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> foot; weld W: foot -> tube, angle 20deg; weld V: arm.V -> foot.W, angle 35deg; revolute Q: rod -> boom;
         prismatic lift: tube.G -> rod.Q along 80deg of rod, angle 50deg; drive reach: lift; assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load J: force(rod.G) = (2N, 1N); load H: force(arm.K) = (-1N, 3N);",
    ),
    (
        "RRP dyad",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link b1 { A: (0.1m, 0.2m), W: (1m, 0.3m), P: (1m, 1m) } link b2 { W: (0.2m, 0), B: (1.5m, 0.3m), P: (0.3m, 0.2m) }
         link s { B: (0.1m, 0.3m), G: (0.2m, 0.1m), P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> b1; weld W: b2 -> b1, angle 20deg; revolute B: b2 -> s; prismatic G: s -> ground along 10deg, angle 15deg; drive q: O;
         assemble B: ahead(A); load H: force(b2.P) = (1N, 4N); load J: force(s.P) = (2N, 4N); load M: moment(s -> b2) = 3N*m;",
    ),
    // Coupler and rocker, driven against each other.
    (
        "RRR dyad",
        &[&[1.3], &[-2.0]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link coupler { A -> B: 0.9m, P: (0.5m, 0.2m) } link rocker { Q -> B: 0.7m }
         revolute O: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute Q: ground -> rocker;
         drive q: B; assemble A: left(O -> Q); load F: force(coupler.P) = (3N, -2N); load M: moment(crank) = 1N*m;",
    ),
    // A slider whose pin is moved along by a drive, and a rod that is a cylinder.
    (
        "RRP dyad",
        &[&[0.3, 1.7], &[0.1, 1.7]],
        "ground { A: (0, 1m), G: (0, 0) } link tube { A: (0, 0) } link rod { B: (0, 0), P: (1m, 1m) } link slider { G: (0, 0), S: (0.2m, 0.1m), P: (1m, 0.3m) } link carriage { S: (0, 0), B: (0.2m, 0.3m) }
         revolute A: ground -> tube; prismatic lift: tube.A -> rod.B along 0deg of tube; revolute B: rod -> carriage; prismatic S: slider -> carriage along 60deg of slider;
         prismatic G: ground -> slider along 5deg; drive q: S; drive r: lift; assemble B: ahead(A);
         load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N);",
    ),
    // A torque on the coupler: the links on both sides are members.
    (
        "block",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m, P: (0.5m, 0.5m) } link b { A -> B: 3m, P: (1m, -1m) } link c { Q -> B: 2.5m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; drive q: O;
         unknown E: torque(ground -> b); assemble B: left(A -> Q); load F: force(b.P) = (3N, -2N); load H: force(crank.P) = (1N, 4N);",
    ),
    // A triad: Stephenson III. The unknown at the crank leaves a core of three, one at the ternary link a larger one.
    (
        "block",
        &[&[0.4], &[0.9], &[-0.2]],
        "ground { O: (0, 0), Q: (5m, 1m), P: (4m, -1m) } link crank { O -> A: 1m } link b { A -> E: 1.95m, G: (1m, 1m) }
         link t { E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m), G: (0.3m, 0.3m) } link c { Q -> C: 1.92m } link d { D: (0.2m, 0.1m), P: (1.8m, 0.6m) }
         revolute O: ground -> crank; revolute A: crank -> b; revolute E: t -> b; revolute C: t -> c; revolute D: d -> t;
         revolute Q: ground -> c; revolute P: d -> ground; drive q: O;
         start q: 0.4rad; start b: (1m, 0.4m), angle 36deg; start t: (2.5m, 1.5m), angle 0; start c: (5m, 1m), angle 140deg;
         start d: (3m, 0.6m), angle -80deg; load F: force(t.G) = (3N, -2N); load H: force(b.G) in c = (1N, 4N); load M: moment(d) = 2N*m;",
    ),
    (
        "block",
        &[&[0.4], &[0.7]],
        "ground { O: (0, 0), Q: (5m, 1m), P: (4m, -1m) } link crank { O -> A: 1m } link b { A -> E: 1.95m, G: (1m, 1m) }
         link t { E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m), G: (0.3m, 0.3m) } link c { Q -> C: 1.92m } link d { D: (0.2m, 0.1m), P: (1.8m, 0.6m) }
         revolute O: ground -> crank; revolute A: crank -> b; revolute E: t -> b; revolute C: t -> c; revolute D: d -> t;
         revolute Q: ground -> c; revolute P: d -> ground; drive q: O; unknown T: torque(b -> t);
         start q: 0.4rad; start b: (1m, 0.4m), angle 36deg; start t: (2.5m, 1.5m), angle 0; start c: (5m, 1m), angle 140deg;
         start d: (3m, 0.6m), angle -80deg; load F: force(t.G) = (3N, -2N); load H: force(b.G) in c = (1N, 4N); load M: moment(d) = 2N*m;",
    ),
    // A group of class IV: two ternary links, joined by two links; one of these is guided by a slide instead.
    (
        "block",
        &[&[0.4, 0.4], &[0.8, 0.4]],
        "ground { O: (0, 0), B: (6m, 0.5m) } link crank { O -> A: 1m } link a { A: (0, 0), C: (1.5m, 1m), D: (1.6m, -0.6m), G: (1m, 1m) }
         link b { B: (0, 0), E: (-1.4m, 1.2m), F: (-1m, -1.2m) } link up { C -> E: 2.3m } link down { D: (0.1m, 0.2m), S: (1.95m, 0.3m), G: (0, 1m) }
         link runner { S: (0.1m, 0), F: (0.6m, 0.2m) }
         revolute O: ground -> crank; revolute A: crank -> a; revolute B: ground -> b; revolute C: a -> up; revolute E: up -> b;
         revolute D: a -> down; prismatic S: down -> runner along 10deg of down, angle 20deg; drive r: S; revolute F: runner -> b; drive q: O;
         start q: 0.4rad; start r: 0.3m; start a: (1m, 0.4m), angle 0; start b: (6m, 0.5m), angle 0; start up: (2.5m, 1.4m), angle 10deg;
         start down: (2.5m, -0.4m), angle -20deg; start runner: (4.5m, -0.8m), angle 0;
         load F1: force(a.G) = (3N, -2N); load H: force(down.G) = (1N, 4N); load M: moment(b) = 2N*m;",
    ),
    // A triad with a slider on a slider, which has no pin.
    (
        "block",
        &[&[0.4], &[0.7], &[0.1]],
        "ground { O: (0, 0), P: (4m, -1m), G: (0, 2m) } link crank { O -> A: 1m } link b { A -> E: 1.95m, G: (1m, 1m) }
         link t { E: (0, 0), D: (0.7m, -0.9m), S: (1m, 0.7m), G: (0.3m, 0.3m) } link y { G: (0.1m, 0.2m), S: (0.3m, 0.1m) } link d { D -> P: 1.7m }
         revolute O: ground -> crank; revolute A: crank -> b; revolute E: t -> b; revolute D: d -> t; revolute P: d -> ground;
         prismatic G: ground -> y along 20deg, angle 10deg; prismatic S: y -> t along 80deg of y, angle -10deg; drive q: O;
         start q: 0.4rad; start b: (0.92m, 0.39m), angle 32deg; start t: (2.57m, 1.43m), angle 0; start y: (3.29m, 3m), angle 10deg;
         start d: (3.27m, 0.53m), angle -64deg; load F: force(t.G) = (3N, -2N); load H: force(b.G) in d = (1N, 4N); load M: moment(y) = 2N*m;",
    ),
    // A triad with a slider on a moving guide that is placed before.
    (
        "block",
        &[&[0.4, 0.3], &[0.8, 0.3]],
        "ground { O: (0, 0), Q: (5m, 1m), P: (4m, -1m) } link crank { O -> A: 1m } link guide { Q: (0, 0), S: (-0.5m, 0.5m) }
         link b { A -> E: 1.95m, G: (1m, 1m) } link t { E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m), G: (0.3m, 0.3m) }
         link c { S: (0.1m, 0.3m), C: (0.4m, 0) } link d { D -> P: 1.7m }
         revolute O: ground -> crank; revolute Q: ground -> guide; revolute A: crank -> b; revolute E: t -> b; revolute C: t -> c;
         prismatic S: guide -> c along 120deg of c, angle 15deg; revolute D: d -> t; revolute P: d -> ground; drive q: O; drive r: Q;
         start q: 0.4rad; start r: 0.3rad; start b: (1m, 0.4m), angle 36deg; start t: (2.5m, 1.5m), angle 0; start c: (3.5m, 2m), angle 30deg;
         start d: (3.2m, 0.6m), angle -60deg; load F: force(t.G) = (3N, -2N); load H: force(b.G) in c = (1N, 4N); load M: moment(d) = 2N*m;",
    ),
    // Two slots between two links: both travels are sought.
    (
        "block",
        &[&[0.6], &[0.8]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A -> B: 2m, S: (0.2m, 0.1m), T: (0.5m, 1m), G: (1m, 1m) }
         link c { Q: (0, 0), S: (-1.2m, 0.3m), T: (-1m, 1.4m), G: (0.3m, 0.4m) } revolute O: ground -> crank; revolute A: crank -> b;
         revolute Q: ground -> c; slot S: b -> c along 10deg of b; slot T: c -> b along 80deg of c; drive q: O;
         start q: 0.6rad; start b: (0.8m, 0.6m), angle 10deg; start c: (3m, 0.5m), angle 0;
         load F: force(b.G) = (3N, -2N); load H: force(c.G) in b = (1N, 4N);",
    ),
    // A geared five-bar that is driven at the pin between its couplers; the second wheel is a turn on.
    (
        "block",
        &[&[1.15]],
        "ground { O: (0, 0), Q: (0.6m, 0) } link g { O -> A: 0.3m } link h { Q -> B: 0.3m, G: (0.1m, 0.1m) } link c { A -> C: 0.65m, G: (0.3m, 0.1m) }
         link d { B -> C: 0.75m } revolute O: ground -> g; revolute Q: ground -> h; revolute A: g -> c; revolute B: d -> h; revolute C: c -> d;
         gear W: g.O -> h.Q, radii (0.3m, 0.3m), phase 2.395m, pressure_angle 20deg, flank left; drive q: C;
         start q: 1.15rad; start g: (0, 0), angle 1.2rad; start h: (0.6m, 0), angle 6.8rad; start c: (0.11m, 0.28m), angle 0.93rad;
         start d: (0.86m, 0.14m), angle 2.08rad; load F: force(c.G) = (3N, -2N); load H: force(h.G) in c = (1N, 4N); load M: moment(d) = 2N*m;",
    ),
    // A force on the rod of a slider-crank: a core of three.
    (
        "block",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link rod { A -> B: 3m, P: (1m, 1m) } link piston { B: (0.1m, 0.3m), G, P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: piston -> ground along 10deg; drive q: O;
         unknown E: force(rod.P) along 70deg of crank; assemble B: ahead(A); load M: moment(crank) = 5N*m; load F: force(piston.P) = (1N, 2N);",
    ),
    // An arm welded to a rocker by a turned arrow, another one to the ground's side of the crank.
    (
        "welded link",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A -> B: 3m } link c { Q -> B: 2.5m, W: (1m, 1m) }
         link arm { W: (0.3m, 0.2m), P: (1m, -1m) } link tip { P: (0.1m, 0), E: (1m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; weld W: arm -> c, angle 50deg;
         weld P: arm -> tip, angle -20deg; drive q: O; assemble B: left(A -> Q);
         load F: force(tip.E) = (3N, -2N); load H: force(arm.P) in b = (1N, 4N); load M: moment(crank -> tip) = 2N*m;",
    ),
    // A rocker held at the arm that is welded to it: the weld's group of forces is none of motion.
    (
        "welded link",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A -> B: 3m } link c { Q -> B: 2.5m, W: (1m, 1m) }
         link arm { W: (0.3m, 0.2m), P: (1m, -1m) } link tip { P: (0.1m, 0), E: (1m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; weld W: c -> arm, angle 50deg;
         weld P: tip -> arm, angle -20deg; drive q: O; unknown E: force(arm.P) along 30deg of b; assemble B: left(A -> Q);
         load F: force(tip.E) = (3N, -2N); load H: moment(crank) = 3N*m;",
    ),
    // A lever with a slot in line with its pin, driven by a crank: a crank shaper with its ram.
    (
        "slot and pin",
        &[&[0.5], &[2.0], &[-1.0]],
        "ground { O: (0, 0), Q: (0, -0.35m), R: (0, 0.33m) } link crank { O -> A: 0.14m } link lever { Q -> B: 0.72m } link rod { B -> C: 0.28m }
         link ram { C: (0, 0), T: (-0.2m, -0.06m) } revolute O: ground -> crank; revolute Q: ground -> lever; slot S: lever.Q -> crank.A along 0deg of lever;
         revolute B: lever -> rod; revolute C: rod -> ram; prismatic R: ground.R -> ram.C along 0deg; drive q: O;
         assemble S: ahead(Q); assemble C: behind(B); load F: force(ram.T) = (-30N, 4N); load M: moment(lever) = 2N*m;",
    ),
    // The slot beside the pin, its point far along it, the pin behind; the arrow the other way.
    (
        "slot and pin",
        &[&[0.5], &[2.0], &[1.2]],
        "ground { O: (1m, 0.5m), Q: (0, -1m) } link crank { O -> A: 0.7m } link lever { Q: (0.2m, 0.3m), S: (3m, 2m), P: (1m, 1m) }
         revolute O: ground -> crank; revolute Q: lever -> ground; slot S: crank.A -> lever.S along 70deg of lever; drive q: O;
         assemble S: behind(Q); load F: force(lever.P) = (3N, -2N); load H: force(crank.A) in lever = (1N, 4N);",
    ),
    // A link whose end runs in the slot of the ground, and of a moving link.
    (
        "slot and pin",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), G: (1m, 0.2m), Q: (-3m, 0) } link crank { O -> A: 1m } link rod { A -> B: 3m, P: (1m, 1m), C: (2m, -0.5m) }
         link c { Q -> D: 5m, P: (0.5m, 1m) } revolute O: ground -> crank; revolute A: crank -> rod; slot B: rod.B -> ground.G along 10deg;
         revolute Q: c -> ground; slot C: c.Q -> rod.C along D -> Q of c; drive q: O; assemble B: ahead(A); assemble C: behind(Q);
         load F: force(rod.P) = (3N, -2N); load H: force(c.P) in rod = (1N, 4N);",
    ),
    // The crank of a shaper that is held at its ram.
    (
        "slot and pin",
        &[&[0.5], &[2.0]],
        "ground { O: (0, 0), Q: (0, -0.35m), R: (0, 0.33m) } link crank { O: (0.1m, 0), A: (0, 0.14m) } link lever { Q -> B: 0.72m, S: (0.1m, 0.01m) } link rod { B -> C: 0.28m }
         link ram { C: (0, 0), T: (-0.2m, -0.06m) } revolute O: ground -> crank; revolute Q: ground -> lever; slot S: lever -> crank.A along 1deg of lever;
         revolute B: lever -> rod; revolute C: rod -> ram; prismatic R: ground.R -> ram.C along 0deg; drive q: O; unknown E: force(ram.T) along 20deg;
         assemble S: ahead(Q); assemble C: behind(B); load F: force(crank.A) = (-30N, 4N); load M: moment(lever) = 2N*m;",
    ),
    // A Scotch yoke with its slot inclined, and a slider with a pin in the slot of a turning link.
    (
        "slot and slide",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), G: (1m, 0.2m) } link crank { O -> A: 1m, C: (0.4m, 0.2m) } link yoke { G: (0.3m, 0.2m), S: (0.5m, 1m), P: (1m, 1m) }
         link shoe { D: (0.1m, 0.2m), E: (0.4m, 0.3m) } revolute O: ground -> crank; prismatic G: yoke -> ground along 10deg, angle 30deg;
         slot S: crank.A -> yoke.S along 100deg of yoke; prismatic D: ground.G -> shoe.D along 80deg, angle 15deg; slot E: crank.C -> shoe.E along (1, 2) of crank;
         drive q: O; load F: force(yoke.P) = (3N, -2N); load H: force(shoe.D) in crank = (1N, 4N); load M: moment(shoe) = 1N*m;",
    ),
    // The same guided by a turning link, and held at the yoke: there the crank has pin and slot.
    (
        "slot and slide",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> G: 2m } link yoke { G: (0.3m, 0.2m), S: (0.5m, 1m), P: (1m, 1m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; prismatic G: arm -> yoke along 10deg of yoke, angle 30deg;
         slot S: yoke -> crank.A along 100deg of yoke; drive q: O; drive r: Q; unknown E: force(yoke.P) along 30deg of arm;
         unknown T: torque(ground -> arm); load F: force(crank.A) = (3N, -2N); load H: force(yoke.S) in crank = (1N, 4N);",
    ),
    // A wheel that a crank's wheel turns, in five turns.
    (
        "gear train",
        &[&[0.4], &[31.0]],
        "ground { O: (0, 0), Q: (0.3m, 0.4m) } link a { O -> A: 1m } link b { Q: (0.1m, 0.1m), B: (1m, 0) } revolute O: ground -> a; revolute Q: b -> ground;
         gear G: a.O -> b.Q, radii (0.2m, 0.3m), phase 0.05m, pressure_angle 20deg, flank left; drive q: O;
         load F: force(b.B) = (3N, -2N); load H: force(a.A) in b = (1N, 4N); load M: moment(b) = 2N*m;",
    ),
    // A pinion in a ring that swings, the arrows the other way.
    (
        "gear train",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m), R: (3.1m, 0.5m) } link crank { O -> A: 1m } link b { A -> B: 3m } link c { Q -> B: 2.5m, W: (1m, 1m) } link p { R: (0.1m, 0), P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; revolute R: p -> ground;
         gear G: c.Q -> p.R, radii (0.3m, 0.2m), internal, phase 5mm, pressure_angle 25deg, flank right; drive q: O; assemble B: left(A -> Q);
         load F: force(p.P) = (3N, -2N); load H: force(p.R) in b = (1N, 4N);",
    ),
    // A planetary train: sun, carrier and planet in a fixed ring, and a dyad behind the planet.
    (
        "gear train",
        &[&[0.4], &[15.0]],
        "ground { O: (0, 0), Q: (2m, 0) } link sun { O -> k: 0.2m } link carrier { O -> C: 0.375m } link planet { C: (0, 0), p: (0.1m, 0) }
         revolute Os: ground.O -> sun.O; revolute Oc: ground.O -> carrier.O; revolute C: carrier -> planet;
         gear Gs: sun.O -> planet.C, radii (0.25m, 0.125m), pressure_angle 0.35rad, flank left; gear Gr: ground.O -> planet.C, radii (0.5m, 0.125m), internal;
         link b { p -> B: 2m } link c { Q -> B: 2.5m } revolute p: planet -> b; revolute B: b -> c; revolute Q: ground -> c; assemble B: left(p -> Q);
         drive q: Os; load F: force(c.B) = (3N, -2N); load H: force(b.B) in planet = (1N, 4N); load M: moment(carrier) = 2N*m;",
    ),
    // A differential: sun and carrier turned by their own drives, a wheel beside the planet's arm.
    (
        "gear train",
        &[&[0.4, 0.3], &[2.0, 0.3]],
        "ground { O: (0, 0) } link sun { O -> k: 0.2m } link carrier { O -> C: 0.375m } link planet { C: (0, 0), p: (0.1m, 0) }
         revolute Os: ground.O -> sun.O; revolute Oc: ground.O -> carrier.O; revolute C: carrier -> planet; gear Gs: planet.C -> sun.O, radii (0.125m, 0.25m), phase 3mm;
         drive q: Os; drive r: C; load F: force(planet.p) = (3N, -2N); load H: force(carrier.C) in planet = (1N, 4N); load M: moment(sun) = 2N*m;",
    ),
    // A geared five-bar.
    (
        "gear train",
        &[&[2.375], &[-1.0]],
        "ground { O: (0, 0), Q: (0.5625m, 0) } link a { O -> A: 0.223607m } link b { Q -> B: 0.382631m } link c { A -> C: 0.763217m } link d { B -> C: 0.743303m, T: (1.06282m, -0.0201802m) }
         revolute O: ground -> a; revolute Q: ground -> b; gear G: a.O -> b.Q, radii (0.3125m, 0.25m), phase 0.861053075216m;
         revolute A: a -> c; revolute B: b -> d; revolute C: c -> d; drive q: O; assemble C: left(A -> B); load F: force(d.T) = (3N, -2N);",
    ),
    // The same held at its coupler: gear and pins in one group of forces.
    (
        "block",
        &[&[2.375], &[-1.0]],
        "ground { O: (0, 0), Q: (0.5625m, 0) } link a { O -> A: 0.223607m } link b { Q -> B: 0.382631m } link c { A -> C: 0.763217m } link d { B -> C: 0.743303m, T: (1.06282m, -0.0201802m) }
         revolute O: ground -> a; revolute Q: ground -> b; gear G: b.Q -> a.O, radii (0.25m, 0.3125m), phase 0.861053075216m, pressure_angle 20deg, flank right;
         revolute A: a -> c; revolute B: b -> d; revolute C: c -> d; drive q: O; unknown E: torque(ground -> d); assemble C: left(A -> B); load F: force(d.T) = (3N, -2N);",
    ),
    // A torque on an arm that is welded to the coupler: a weld in the group of forces.
    (
        "block",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A -> B: 3m, W: (1m, 1m) } link c { Q -> B: 2.5m } link arm { W: (0.3m, 0.2m), P: (1m, -1m) }
         revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c; weld W: b -> arm, angle 50deg;
         drive q: O; unknown E: torque(ground -> arm); assemble B: left(A -> Q); load F: force(arm.P) = (3N, -2N); load H: moment(crank) = 3N*m;",
    ),
    // A torque between crank and rod of a shaper: slot, pins, slide and effort in one group.
    (
        "block",
        &[&[0.5], &[2.0]],
        "ground { O: (0, 0), Q: (0, -0.35m), R: (0, 0.33m) } link crank { O -> A: 0.14m } link lever { Q -> B: 0.72m, P: (0.3m, 0.2m) } link rod { B -> C: 0.28m }
         link ram { C: (0, 0), T: (-0.2m, -0.06m) } revolute O: ground -> crank; revolute Q: ground -> lever; slot S: lever.Q -> crank.A along 0deg of lever;
         revolute B: lever -> rod; revolute C: rod -> ram; prismatic R: ground.R -> ram.C along 0deg; drive q: O; unknown E: torque(crank -> rod);
         assemble S: ahead(Q); assemble C: behind(B); load F: force(ram.T) = (-30N, 4N); load M: moment(crank) = 2N*m;",
    ),
    // A roller on a rail, driven along it: the outer pin of a dyad moves.
    (
        "RRR dyad",
        &[&[-1.2], &[-1.5]],
        "ground { O: (0, 0), R: (0.1m, 0.05m) } link p { O -> B: 1m, P: (0.7m, 0.2m) } link s { R: (0.1m, 0.1m), B: (1m, 0.3m), P: (1m, 1m) }
         revolute O: ground -> p; slot R: s.R -> ground.R along 10deg; revolute B: p -> s; drive q: R.travel; assemble B: left(O -> R);
         load F: force(p.P) = (3N, -2N); load H: force(s.P) = (1N, 4N);",
    ),
    // The same in a slot that the dyad's own link has.
    (
        "RRR dyad",
        &[&[0.4, 0.3], &[2.0, -0.2]],
        "ground { O: (0, 0), Q: (2m, 0.5m) } link crank { O -> A: 0.6m } link b { A -> B: 1.5m, P: (1m, -1m) } link c { Q: (0.2m, 0.1m), B: (1.4m, 0.2m), P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: b -> crank; revolute B: c -> b; slot Q: ground.Q -> c.Q along 30deg of c; drive q: O; drive r: Q.travel;
         assemble B: left(A -> Q); load F: force(b.P) = (3N, -2N); load H: force(c.P) in b = (1N, 4N);",
    ),
    // Driven along a slot between the dyad's links.
    (
        "RRR dyad",
        &[&[0.6], &[0.5]],
        "ground { O: (0, 0), Q: (0, -0.35m) } link crank { O -> A: 0.34m, P: (0.1m, 0.2m) } link lever { Q: (0.1m, 0.02m), S: (0.1m, 0.05m), B: (0.72m, 0) }
         revolute O: ground -> crank; revolute Q: ground -> lever; slot S: lever.S -> crank.A along 10deg of lever; drive q: S.travel; assemble S: left(O -> Q);
         load F: force(lever.B) = (3N, -2N); load H: force(crank.P) = (1N, 4N);",
    ),
    // Turned in a slot between the dyad's links, by a drive.
    (
        "RPR dyad",
        &[&[0.8], &[-0.5]],
        "ground { O: (0, 0), Q: (0, -0.35m) } link crank { O: (0.1m, 0), A: (0.2m, 0.1m), P: (0.1m, 0.2m) } link lever { Q: (0.1m, 0.02m), S: (0.1m, 0.05m), B: (0.72m, 0) }
         revolute O: ground -> crank; revolute Q: ground -> lever; slot S: lever.S -> crank.A along 10deg of lever; drive q: S.angle; assemble S: ahead(Q);
         load F: force(lever.B) = (3N, -2N); load H: force(crank.P) = (1N, 4N);",
    ),
    // The same between moving links, the slot on the other one.
    (
        "RPR dyad",
        &[&[0.4, 0.8], &[2.0, -0.5]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0.1m, 0.2m), S: (0.5m, 0.3m), P: (1m, 1m) }
         link block { C: (0.2m, 0.1m), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         slot S: block -> rod along 25deg of rod; drive q: O; drive r: S.angle; assemble S: behind(C);
         load F: force(rod.P) = (3N, -2N); load H: force(block.P) in rod = (1N, 4N); load M: moment(crank -> block) = 2N*m;",
    ),
    // A slider in a slot that a drive turns.
    (
        "RRP dyad",
        &[&[0.3], &[-0.4]],
        "ground { A: (0, 1m), G: (0, 0) } link rod { A -> B: 2m, P: (1m, 1m) } link slider { G: (0.1m, 0.2m), B: (0.4m, 0.3m), P: (1m, 0.3m) }
         revolute A: ground -> rod; revolute B: rod -> slider; slot G: ground -> slider along 5deg; drive q: G.angle; assemble B: ahead(A);
         load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N);",
    ),
    // The same with a slot of its own, on a moving link.
    (
        "RRP dyad",
        &[&[0.3, 0.2], &[-0.4, 0.5]],
        "ground { O: (0, 0), A: (0, 1m), G: (0, 0) } link crank { O -> G: 0.4m } link rod { A -> B: 2m, P: (1m, 1m) } link slider { G: (0.1m, 0.2m), B: (0.4m, 0.3m), P: (1m, 0.3m) }
         revolute O: ground -> crank; revolute A: ground -> rod; revolute B: rod -> slider; slot G: slider -> crank along 5deg of slider; drive q: O; drive r: G.angle; assemble B: ahead(A);
         load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N);",
    ),
    // Two sliders in slots, both turned by drives.
    (
        "PRP dyad",
        &[&[0.4, 0.3], &[1.0, -0.2]],
        "ground { G: (0, 0), Q: (1m, 0) } link one { B: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } link two { B: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute B: two -> one; slot G: one.G -> ground.G along 80deg of one; slot H: ground.Q -> two.H along 15deg; drive q: G.angle; drive r: H.angle;
         load F: force(one.P) = (3N, -2N); load K: force(two.P) in one = (1N, 4N);",
    ),
    // A slider turned against the one that carries it.
    (
        "RPP dyad",
        &[&[0.4, 0.3], &[1.0, -0.2]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link one { A: (0.1m, 0.2m), S: (0.4m, 0.3m), P: (1m, 0) } link two { S: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> one; slot S: one -> two along 80deg of one; prismatic H: ground.Q -> two.H along 15deg of two, angle -35deg;
         drive q: O; drive r: S.angle; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // Both of them, the slots the carrying slider's.
    (
        "RPP dyad",
        &[&[0.4, 0.3, 0.2], &[1.0, -0.2, 0.5]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link one { A: (0.1m, 0.2m), S: (0.4m, 0.3m), P: (1m, 0) } link two { S: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) }
         revolute O: ground -> crank; revolute A: crank -> one; slot S: two -> one along 80deg of two; slot H: two.H -> ground.Q along 15deg of two;
         drive q: H.angle; drive r: S.angle; drive s: O; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // A lever whose pin is driven along a rail, and along a slot of its own.
    (
        "slot and pin",
        &[&[0.4, 0.3], &[1.0, -0.2]],
        "ground { O: (0, 0), Q: (0, -1m) } link crank { O -> A: 0.7m } link lever { Q: (0.2m, 0.3m), S: (0.5m, 0.4m), P: (1m, 1m) }
         revolute O: ground -> crank; slot Q: lever -> ground along 20deg; slot S: crank.A -> lever.S along 70deg of lever; drive q: O; drive r: Q.travel;
         assemble S: behind(Q); load F: force(lever.P) = (3N, -2N); load H: force(crank.A) in lever = (1N, 4N);",
    ),
    (
        "slot and pin",
        &[&[0.4, 0.3], &[1.0, -0.2]],
        "ground { O: (0, 0), Q: (0, -1m) } link crank { O -> A: 0.7m } link lever { Q: (0.2m, 0.3m), S: (0.5m, 0.4m), P: (1m, 1m) }
         revolute O: ground -> crank; slot Q: lever -> ground along 20deg of lever; slot S: crank.A -> lever.S along 70deg of lever; drive q: O; drive r: Q.travel;
         assemble S: behind(Q); load F: force(lever.P) = (3N, -2N); load H: force(crank.A) in lever = (1N, 4N);",
    ),
    // A link whose end runs in a slot, and whose pin is driven along one.
    (
        "slot and pin",
        &[&[0.3, 0.4], &[-0.2, 1.0]],
        "ground { O: (0, 0), Q: (0, -1m) } link crank { O -> A: 0.7m } link bar { Q: (0.2m, 0.3m), S: (3m, 2m), P: (1m, 1m) }
         revolute O: ground -> crank; slot Q: ground -> bar along 20deg of bar; slot S: crank.A -> bar.S along 70deg of crank; drive r: Q.travel; drive q: O;
         assemble S: behind(Q); load F: force(bar.P) = (3N, -2N); load H: force(crank.A) in bar = (1N, 4N);",
    ),
    (
        "slot and pin",
        &[&[0.3, 0.4], &[-0.2, 1.0]],
        "ground { O: (0, 0), Q: (0, -1m) } link crank { O -> A: 0.7m } link bar { Q: (0.2m, 0.3m), S: (3m, 2m), P: (1m, 1m) }
         revolute O: ground -> crank; slot Q: ground -> bar along 20deg; slot S: crank.A -> bar.S along 70deg of crank; drive r: Q.travel; drive q: O;
         assemble S: ahead(Q); load F: force(bar.P) = (3N, -2N); load H: force(crank.A) in bar = (1N, 4N);",
    ),
    // A yoke that a drive turns in its guide.
    (
        "slot and slide",
        &[&[0.4, 0.3], &[2.0, -0.7]],
        "ground { O: (0, 0), G: (1m, 0.2m) } link crank { O -> A: 1m } link yoke { G: (0.3m, 0.2m), S: (0.5m, 1m), P: (1m, 1m) }
         revolute O: ground -> crank; slot G: yoke -> ground along 10deg; slot S: crank.A -> yoke.S along 100deg of yoke; drive q: O; drive r: G.angle;
         load F: force(yoke.P) = (3N, -2N); load H: force(crank.A) = (1N, 4N);",
    ),
    (
        "slot and slide",
        &[&[0.4, 0.3], &[2.0, -0.7]],
        "ground { O: (0, 0), G: (1m, 0.2m) } link crank { O -> A: 1m } link yoke { G: (0.3m, 0.2m), S: (0.5m, 1m), P: (1m, 1m) }
         revolute O: ground -> crank; slot G: yoke -> ground along 10deg of yoke; slot S: crank.A -> yoke.S along 100deg of crank; drive q: O; drive r: G.angle;
         load F: force(yoke.P) = (3N, -2N); load H: force(crank.A) = (1N, 4N);",
    ),
    // A link that is driven both ways in a slot.
    (
        "link on a slide",
        &[&[0.4, 0.3, 0.5], &[2.0, -0.7, -0.3]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b { A: (0.3m, 0.1m), B: (0.2m, 0), P: (1m, 1m) } link c { B -> C: 2m } link d { Q -> C: 2.5m }
         revolute O: ground -> crank; slot A: crank -> b along 20deg of b; revolute B: b -> c; revolute C: c -> d; revolute Q: d -> ground; drive q: O; drive r: A.travel; drive s: A.angle;
         assemble C: left(B -> Q); load F: force(b.P) = (3N, -2N); load H: force(c.C) = (1N, 4N);",
    ),
    // The same within a dyad's body.
    (
        "RRR dyad",
        &[&[1.4, 0.3], &[1.7, -0.2]],
        "ground { O: (0, 0), P: (1m, -0.5m) } link boom { O -> Q: 1.5m, T: (2m, 0.3m) } link tube { P: (0, 0.1m), G: (0.1m, 0.5m) } link rod { Q: (0, 0), G: (0.3m, 0.2m) }
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom; slot lift: tube.G -> rod.Q along 10deg of rod; drive q: lift.travel; drive r: lift.angle; assemble Q: left(P -> O);
         load F: force(boom.T) = (3N, -2N); load H: force(tube.G) = (1N, 4N); load J: force(rod.G) = (2N, 1N);",
    ),
    // Welded links as bodies of dyads.
    (
        "RRR dyad",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), Q: (3m, 0.5m) } link crank { O -> A: 1m } link b1 { A: (0.1m, 0.2m), W: (1m, 0.3m), P: (1m, 1m) } link b2 { W: (0.2m, 0), B: (1.5m, 0.3m), P: (0.3m, 0.2m) } link c { Q -> B: 2.5m, P: (1m, 1m) }
         revolute O: ground -> crank; revolute A: b1 -> crank; weld W: b1 -> b2, angle 20deg; revolute B: c -> b2; revolute Q: ground -> c; drive q: O;
         assemble B: left(A -> Q); load F: force(b1.P) = (3N, -2N); load G: force(b2.P) = (2N, 1N); load H: force(c.P) in b1 = (1N, 4N);",
    ),
    (
        "RRP dyad",
        &[&[0.4], &[2.0]],
        "ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: 1m } link b1 { A: (0.1m, 0.2m), W: (1m, 0.3m), P: (1m, 1m) } link b2 { W: (0.2m, 0), B: (1.5m, 0.3m), P: (0.3m, 0.2m) }
         link s1 { B: (0.1m, 0.3m), V: (0.2m, 0.1m), P: (1m, 1m) } link s2 { V: (0.3m, 0.3m), G: (0.1m, 0), P: (0.4m, 0.2m) }
         revolute O: ground -> crank; revolute A: crank -> b1; weld W: b2 -> b1, angle 20deg; revolute B: b2 -> s1; weld V: s2 -> s1, angle -50deg; prismatic G: s2 -> ground along 10deg, angle 15deg; drive q: O;
         assemble B: ahead(A); load F: force(b1.P) = (3N, -2N); load H: force(b2.P) = (1N, 4N); load J: force(s1.P) = (2N, 4N); load K: force(s2.P) in b1 = (1N, 2N);",
    ),
    (
        "RPR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link r1 { A: (0.1m, 0.2m), W: (0.3m, 0.1m), P: (1m, 1m) } link r2 { W: (0.1m, 0.1m), S: (0.5m, 0.3m), P: (1m, 1m) }
         link k1 { C: (0.2m, 0.1m), V: (0, 0.2m), P: (0.5m, 0) } link k2 { V: (0.2m, 0), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: r1 -> crank; weld W: r1 -> r2, angle 10deg; revolute C: ground -> k1;
         weld V: k2 -> k1, angle 30deg; prismatic S: k2 -> r2 along 25deg of r2, angle 40deg; drive q: O; assemble S: behind(C);
         load F: force(r1.P) = (3N, -2N); load G: force(r2.P) = (2N, -2N); load H: force(k1.P) in r2 = (1N, 4N); load J: force(k2.P) = (1N, 4N); load M: moment(crank -> k1) = 2N*m;",
    ),
    (
        "RPR dyad",
        &[&[0.4], &[2.0], &[-2.0]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link r1 { A: (0.1m, 0.2m), W: (0.3m, 0.1m), P: (1m, 1m) } link r2 { W: (0.1m, 0.1m), S: (0.5m, 0.3m), P: (1m, 1m) }
         link k1 { C: (0.2m, 0.1m), V: (0, 0.2m), P: (0.5m, 0) } link k2 { V: (0.2m, 0), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: r1 -> crank; weld W: r1 -> r2, angle 10deg; revolute C: ground -> k1;
         weld V: k2 -> k1, angle 30deg; prismatic S: r2 -> k2 along 25deg of k2, angle 40deg; drive q: O; assemble S: behind(C);
         load F: force(r1.P) = (3N, -2N); load G: force(r2.P) = (2N, -2N); load H: force(k1.P) in r2 = (1N, 4N); load J: force(k2.P) = (1N, 4N); load M: moment(crank -> k1) = 2N*m;",
    ),
    (
        "PRP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> G: 0.5m } link arm { Q -> H: 2m }
         link one { V: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } link tip { V: (0.2m, 0.2m), B: (0, 0.3m), P: (1m, 1m) } link two { B: (0.3m, -0.2m), W: (0.2m, 0.3m), P: (0.3m, 1m) } link end { W: (0.1m, 0), H: (0.3m, 0.3m), P: (0.2m, 0.2m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute B: two -> tip; weld V: tip -> one, angle 12deg; weld W: two -> end, angle -35deg;
         prismatic G: one -> crank along 80deg of crank, angle 15deg; prismatic H: arm -> end along 15deg of end, angle -35deg;
         drive q: O; drive r: Q; load F: force(one.P) = (3N, -2N); load G1: force(tip.P) = (1N, -2N); load K: force(two.P) in crank = (1N, 4N); load L: force(end.P) = (3N, 3N);",
    ),
    (
        "RPP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> H: 2m }
         link one { A: (0.1m, 0.2m), V: (0.4m, 0.3m), P: (1m, 0) } link tip { V: (0.1m, 0.1m), S: (0.2m, 0.1m), P: (1m, 0.2m) } link two { W: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) } link end { W: (0, 0.1m), S: (0.4m, 0.1m), P: (0.2m, 0.2m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute A: crank -> one; weld V: tip -> one, angle 12deg; weld W: two -> end, angle -35deg;
         prismatic S: tip -> end along 80deg of tip, angle 15deg; prismatic H: arm -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: Q; load F: force(one.P) = (3N, -2N); load G1: force(tip.P) = (1N, -2N); load K: force(two.P) in crank = (1N, 4N); load L: force(end.P) = (3N, 3N);",
    ),
    // Driven joints and welds within the bodies.
    (
        "RPR dyad",
        &[&[0.4, 0.3, 0.2], &[2.0, 0.3, -0.3]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link r1 { A: (0.1m, 0.2m), W: (0.3m, 0.1m), P: (1m, 1m) } link r2 { W: (0.1m, 0.1m), S: (0.5m, 0.3m), P: (1m, 1m) }
         link k1 { C: (0.2m, 0.1m), V: (0, 0.2m), P: (0.5m, 0) } link k2 { V: (0.2m, 0), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: r1 -> crank; revolute W: r1 -> r2; revolute C: ground -> k1;
         prismatic V: k2 -> k1 along 30deg of k1, angle 30deg; prismatic S: r2 -> k2 along 25deg of k2, angle 40deg; drive q: O; drive r: W; drive s: V; assemble S: behind(C);
         load F: force(r1.P) = (3N, -2N); load G: force(r2.P) = (2N, -2N); load H: force(k1.P) in r2 = (1N, 4N); load J: force(k2.P) = (1N, 4N); load M: moment(crank -> k1) = 2N*m;",
    ),
    (
        "PRP dyad",
        &[&[0.4, 0.3, 0.2, 0.1], &[1.0, 0.3, -0.2, 0.3]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> G: 0.5m } link arm { Q -> H: 2m }
         link one { V: (0.1m, 0.2m), G: (0.4m, 0.3m), P: (1m, 0) } link tip { V: (0.2m, 0.2m), B: (0, 0.3m), P: (1m, 1m) } link two { B: (0.3m, -0.2m), W: (0.2m, 0.3m), P: (0.3m, 1m) } link end { W: (0.1m, 0), H: (0.3m, 0.3m), P: (0.2m, 0.2m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; slot B: two -> tip along 30deg of tip; prismatic V: tip -> one along 20deg of tip, angle 12deg; weld W: two -> end, angle -35deg;
         prismatic G: one -> crank along 80deg of crank, angle 15deg; prismatic H: arm -> end along 15deg of end, angle -35deg;
         drive q: O; drive r: Q; drive s: V; drive t: B.travel; load F: force(one.P) = (3N, -2N); load G1: force(tip.P) = (1N, -2N); load K: force(two.P) in crank = (1N, 4N); load L: force(end.P) = (3N, 3N);",
    ),
    (
        "RPP dyad",
        &[&[0.4, 0.3, 0.2], &[1.0, 0.3, -0.2]],
        "ground { O: (0, 0), Q: (1m, 0) } link crank { O -> A: 0.5m } link arm { Q -> H: 2m }
         link one { A: (0.1m, 0.2m), V: (0.4m, 0.3m), P: (1m, 0) } link tip { V: (0.1m, 0.1m), S: (0.2m, 0.1m), P: (1m, 0.2m) } link two { W: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) } link end { W: (0, 0.1m), S: (0.4m, 0.1m), P: (0.2m, 0.2m) }
         revolute O: ground -> crank; revolute Q: ground -> arm; revolute A: crank -> one; weld V: tip -> one, angle 12deg; revolute W: two -> end;
         prismatic S: tip -> end along 80deg of tip, angle 15deg; prismatic H: arm -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: Q; drive s: W; load F: force(one.P) = (3N, -2N); load G1: force(tip.P) = (1N, -2N); load K: force(two.P) in crank = (1N, 4N); load L: force(end.P) = (3N, 3N);",
    ),
    (
        "RRP dyad",
        &[&[0.3, 0.1, 0.2], &[0.5, 0.2, 0.4]],
        "ground { A: (0, 1m), G: (0, 0) } link tube { A: (0, 0) } link rod { C: (0, 0), B: (1m, 0.1m), P: (1m, 1m) } link slider { G: (0, 0), S: (0.2m, 0.1m), P: (1m, 0.3m) } link carriage { S: (0, 0), B: (0.2m, 0.3m), P: (1m, 0) }
         revolute A: ground -> tube; prismatic lift: tube.A -> rod.C along 0deg of tube; slot B: rod -> carriage along 30deg of rod; revolute S: slider -> carriage;
         prismatic G: ground -> slider along 5deg; drive q: S; drive r: lift; drive s: B.travel; assemble B: ahead(A);
         load F: force(rod.P) = (3N, -2N); load H: force(slider.P) = (1N, 4N); load J: force(carriage.P) = (1N, 4N);",
    ),
    // An oscillating block whose rod is bent by a drive, and one whose rod is lengthened.
    (
        "RPR dyad",
        &[&[0.4, 0.3], &[2.0, 0.3]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0.1m, 0.2m), E: (0.5m, 0.1m) } link tip { E: (0, 0.1m), S: (0.3m, 0.1m), P: (1m, 1m) }
         link block { C: (0.2m, 0.1m), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         revolute E: tip -> rod; prismatic S: block -> tip along 25deg of tip, angle 40deg; drive q: O; drive r: E; assemble S: behind(C);
         load F: force(tip.P) = (3N, -2N); load H: force(block.P) in rod = (1N, 4N);",
    ),
    (
        "RPR dyad",
        &[&[0.4, 0.3], &[2.0, 0.3]],
        "ground { O: (0, 0), C: (2m, -0.3m) } link crank { O -> A: 0.6m } link rod { A: (0.1m, 0.2m), E: (0.5m, 0.1m) } link tip { E: (0, 0.1m), S: (0.3m, 0.1m), P: (1m, 1m) }
         link block { C: (0.2m, 0.1m), S: (-0.1m, 0.3m), P: (0.5m, 0) } revolute O: ground -> crank; revolute A: rod -> crank; revolute C: ground -> block;
         prismatic E: tip -> rod along 70deg of rod, angle 20deg; prismatic S: block -> tip along 25deg of tip, angle 40deg; drive q: O; drive r: E; assemble S: behind(C);
         load F: force(tip.P) = (3N, -2N); load H: force(block.P) in rod = (1N, 4N);",
    ),
    // Two sliders, one of them bent by a drive.
    (
        "PRP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0) } link crank { O -> G: 0.5m } link one { E: (0.1m, 0.2m), G: (0.4m, 0.3m) } link mid { E: (0, 0.1m), B: (0.3m, 0.2m), P: (1m, 0) }
         link two { B: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) } revolute O: ground -> crank; revolute E: one -> mid; revolute B: two -> mid;
         prismatic G: one -> crank along 80deg of crank, angle 15deg; prismatic H: ground.O -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: E; load F: force(mid.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    // A slider on a slider, each of them bent by a drive.
    (
        "RPP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0), H: (1m, 1m) } link crank { O -> A: 0.5m } link one { A: (0.1m, 0.2m), E: (0.4m, 0.3m) } link mid { E: (0, 0.1m), S: (0.3m, 0.2m), P: (1m, 0) }
         link two { S: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) } revolute O: ground -> crank; revolute A: crank -> one; revolute E: one -> mid;
         prismatic S: mid -> two along 80deg of mid, angle 15deg; prismatic H: crank.A -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: E; load F: force(mid.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
    (
        "RPP dyad",
        &[&[0.4, 0.3], &[1.0, 0.3]],
        "ground { O: (0, 0) } link crank { O -> A: 0.5m, H: (0.2m, 0.7m) } link one { A: (0.1m, 0.2m), S: (0.4m, 0.3m), P: (1m, 0) } link mid { E: (0, 0.1m), S: (0.3m, 0.2m) }
         link two { E: (0.3m, -0.2m), H: (0.2m, 0.3m), P: (0.3m, 1m) } revolute O: ground -> crank; revolute A: crank -> one; revolute E: two -> mid;
         prismatic S: one -> mid along 80deg of one, angle 15deg; prismatic H: crank -> two along 15deg of two, angle -35deg;
         drive q: O; drive r: E; load F: force(one.P) = (3N, -2N); load K: force(two.P) in crank = (1N, 4N);",
    ),
];

/// Rate and acceleration of each drive.
const MOTION: [[f64; 2]; 4] = [[1.3, -0.7], [0.6, 2.1], [-0.9, 0.4], [0.3, 1.7]];

#[test]
fn every_rule_satisfies_the_equations_of_its_group() {
    for (class, drives, items) in CASES {
        let text = format!(
            "pub mod sample; {items} scene all: equilibrium; scene work: virtual_work; scene moved: acceleration;"
        );
        let linkage = compile(&text);
        let used = linkage.plan.motion_rules.iter().chain(&linkage.plan.force_rules);
        assert!(used.into_iter().any(|rule| *rule == class), "{class} is not used\n{text}");
        for drives in drives {
            let arguments = at_rest(&linkage, drives);
            check(&linkage, &arguments, &text);
            check_motion(&linkage, &arguments, &text);
        }
    }
}

/// A pose by its drives. All loads are constants.
fn at_rest(linkage: &Linkage, drives: &[f64]) -> Arguments {
    let loads = vec![[0.0; 2]; linkage.model.loads.len()];
    Arguments { drives: drives.to_vec(), loads, ..Arguments::default() }
}

/// Velocities keep the constraints, and so do accelerations: `J q̇ = 0` and `J q̈ + J̇ q̇ = 0`, the drives' own coordinates as given.
fn check_motion(linkage: &Linkage, arguments: &Arguments, text: &str) {
    let motions = [MOTION, [[-0.4, 0.0], [1.9, -1.0], [0.0, 1.1], [-1.2, 0.0]]];
    for motion in motions {
        let arguments = Arguments { motion: motion.to_vec(), ..arguments.clone() };
        for (source, [rate, acceleration]) in open_motion::<Extended>(linkage, &arguments).unwrap() {
            assert!(rate.to_f64().abs() < 1e-50, "velocity at {source:?}: {:e}\n{text}", rate.to_f64());
            let open = acceleration.to_f64();
            assert!(open.abs() < 1e-50, "acceleration at {source:?}: {open:e}\n{text}");
        }
    }
}

fn check(linkage: &Linkage, arguments: &Arguments, text: &str) {
    // In 220 bits nothing but a wrong formula makes a difference.
    for residual in residuals::<Extended>(linkage, arguments).unwrap_or_else(|fault| panic!("{fault:?}\n{text}")) {
        assert!(residual.to_f64().abs() < 1e-55, "constraint: {:e}\n{text}", residual.to_f64());
    }
    let general = equations::<Extended>(linkage, arguments).expect("a pose");
    let solution = solve_extended(&general.matrix, &general.right_side(&|_| true)).expect("regular");
    let all = scene::<Extended>(linkage, "all", arguments).unwrap();
    for (name, value) in general.named(linkage, solution) {
        let error = (all[&name].to_f64() - value.to_f64()).abs();
        let size = value.to_f64().abs().max(1.0);
        assert!(error <= 1e-13 * size, "{name}\n{text}");
        assert!(all[&name].sub(&value).to_f64().abs() < 1e-53 * size, "{name}: equilibrium\n{text}");
    }
    let work = scene::<Extended>(linkage, "work", arguments).unwrap();
    for unknown in &linkage.model.unknowns {
        let difference = all[&unknown.name].sub(&work[&unknown.name]).to_f64();
        assert!(difference.abs() < 1e-50, "{}: virtual work {difference:e}\n{text}", unknown.name);
    }
}

/// A case with scenes that bound the errors of forces and efforts, of efforts by virtual work, and of how the links turn; of the reactions of
/// these joints.
fn bounded(items: &str, of: fn(&JointKind) -> bool) -> String {
    let linkage = compile(&format!("pub mod sample; {items} scene all: equilibrium;"));
    let unknowns: Vec<&str> = linkage.model.unknowns.iter().map(|unknown| unknown.name.as_str()).collect();
    let joints = linkage.model.joints.iter().filter(|joint| of(&joint.kind));
    let forces: Vec<&str> = unknowns.iter().copied().chain(joints.map(|joint| joint.name.text.as_str())).collect();
    let angles = linkage.model.moving_links().map(|link| format!("{}.angle", linkage.model.link(link).name));
    let (forces, unknowns, angles) = (forces.join(", "), unknowns.join(", "), angles.collect::<Vec<_>>().join(", "));
    format!(
        "pub mod sample; {items} scene held: equilibrium -> ({forces}, error_bound);
         scene work: virtual_work -> ({unknowns}, error_bound); scene moved: acceleration -> ({angles}, error_bound);
         scene all: equilibrium;"
    )
}

/// The scenes of such a case that have bounds.
const BOUNDED: [&str; 3] = ["held", "work", "moved"];

/// In both scalars, in plain and in fused arithmetic.
#[test]
fn bounds_hold_the_errors_of_every_rule() {
    let mut by_rule: BTreeMap<(&str, &str), Vec<f64>> = BTreeMap::new();
    for (class, drives, items) in CASES {
        let text = bounded(items, |_| true);
        for options in
            ["scalar f64; arithmetic plain;", "arithmetic fused;", "scalar f32;", "scalar f32; arithmetic fused;"]
        {
            let text = text.replacen(';', &format!("; {options}"), 1);
            let linkage = compile(&text);
            for (drives, name) in drives.iter().flat_map(|drives| BOUNDED.map(|name| (drives, name))) {
                let what = format!("{class}: {name} at {drives:?}\n{text}");
                let arguments = Arguments { motion: MOTION.to_vec(), ..at_rest(&linkage, drives) };
                let ratios = if options.starts_with("scalar f32") {
                    ratios_of::<Single>(&linkage, name, &in_single(&arguments), &what)
                } else {
                    ratios_of::<Double>(&linkage, name, &arguments, &what)
                };
                by_rule.entry((class, options)).or_default().extend(ratios);
            }
        }
    }
    assert!(by_rule.values().map(Vec::len).sum::<usize>() > 10_000);
    for ((class, options), ratios) in &mut by_rule {
        let (count, median) = (ratios.len(), median(ratios).expect("results"));
        println!("{class}, {options}: {count} results, median of bound over error {median:.1}");
        assert!(median < LOOSEST, "{class}, {options}: {count} results, median {median:.1}");
    }
}

/// The nearest arguments that single precision holds.
fn in_single(arguments: &Arguments) -> Arguments {
    let drives = arguments.drives.iter().map(|drive| single(*drive)).collect();
    let motion = arguments.motion.iter().map(|motion| motion.map(single)).collect();
    Arguments { drives, motion, ..arguments.clone() }
}

/// What does not depend on the points by which lines are declared.
fn independent_of_points(items: &str) -> String {
    bounded(items, |kind| !matches!(kind, JointKind::Prismatic { .. } | JointKind::Slot { .. }))
}

/// Lines that are declared by points far away: no function has the distance in it, errors are like those with near points, and so are bounds.
#[test]
fn far_points_of_lines_take_no_digits() {
    let [line, runner, both]: [&[bool]; 3] = [&[false], &[true], &[false, true]];
    let moves = [(20.0, line), (1e4, line), (-1e8, line), (1e8, runner), (-3e5, runner), (1e6, both)];
    let mut tried = 0;
    for (class, drives, items) in CASES {
        let text = independent_of_points(items);
        let near = compile(&text);
        let lines = far_points::lines(&text);
        // Each line by every other of the moves, every move of lines of every class.
        let turns = (0..)
            .zip(&lines)
            .flat_map(|(turn, name)| moves.into_iter().skip(turn % 2).step_by(2).map(move |by| (name, by)));
        for (name, (distance, points)) in turns {
            let move_point = |text: String, runner: &bool| far_points::with_point_moved(&text, name, distance, *runner);
            let Some(moved) = points.iter().try_fold(text.clone(), move_point) else { continue };
            let far = compile(&moved);
            check(&far, &at_rest(&far, drives[0]), &moved);
            for (drives, scene) in drives.iter().flat_map(|drives| BOUNDED.map(|scene| (drives, scene))) {
                tried += 1;
                let arguments = Arguments { motion: MOTION.to_vec(), ..at_rest(&near, drives) };
                compare([&far, &near], scene, &arguments, &format!("{class}: {scene} at {drives:?}\n{moved}"));
                let is_far = |size: f64| distance.abs() > 1e3 && size > 0.1 * distance.abs() && size < 1e300;
                let largest = constants(&far, scene).map(f64::abs).filter(|size| is_far(*size)).reduce(f64::max);
                assert!(largest.is_none(), "{class}: {largest:?} in {scene}\n{moved}");
            }
        }
    }
    assert!(tried > 1000, "{tried}");
}

/// The constants of a scene's function from the drives.
fn constants(linkage: &Linkage, scene: &str) -> impl Iterator<Item = f64> {
    let program = &linkage.functions.scenes[index_of(linkage, scene)].direct;
    program.values.iter().filter_map(|value| match value.definition {
        Definition::Computed(Op::Constant(number)) => Some(linkage.model.graph.number(number).to_f64()),
        _ => None,
    })
}

/// All ground points far from the origin: not a bit of forces, efforts and rates of rotation changes.
#[test]
fn far_grounds_change_no_bit() {
    for (class, drives, items) in CASES {
        let text = independent_of_points(items);
        let moved = far_points::with_ground_moved(&text, [1e6, -3e5]);
        assert!(moved.contains("1000000.0m"), "{moved}");
        let linkages = [&moved, &text].map(|text| compile(text));
        for (drives, name) in drives.iter().flat_map(|drives| BOUNDED.map(|scene| (drives, scene))) {
            let arguments = Arguments { motion: MOTION.to_vec(), ..at_rest(&linkages[0], drives) };
            let [far, near] = linkages.each_ref().map(|linkage| scene::<Double>(linkage, name, &arguments).unwrap());
            for (path, value) in far.iter().filter(|(path, _)| !path.starts_with("error_bound.")) {
                let [far, near] = [value, &near[path]].map(|value| value.to_f64().to_bits());
                assert_eq!(far, near, "{class}: {path} of {name} at {drives:?}\n{moved}");
            }
        }
    }
}

/// With lengths that are parameters, too.
#[test]
fn far_points_beside_parameters_take_no_digits() {
    let items = "param a: length = 1m; param b: length = 3m; ground { O: (0, 0), G: (0, 0.2m) } link crank { O -> A: a }
        link rod { A -> B: b, P: (1m, 0.3m) } link piston { B: (0.1m, 0.2m), G: (0.4m, 0.2m) } revolute O: ground -> crank; revolute A: crank -> rod;
        revolute B: rod -> piston; prismatic G: ground -> piston along 10deg; drive q: O; assemble B: ahead(A); load F: force(rod.P) = (1N, 2N);
        load H: force(piston.G) = (-20N, 3N);";
    let text = independent_of_points(items);
    for (distance, runner) in [(-1e8, false), (1e8, true), (1e4, false)] {
        let moved = far_points::with_point_moved(&text, "G", distance, runner).expect("a slide");
        let linkages = [&moved, &text].map(|text| compile(text));
        for scene in BOUNDED {
            let params = vec![0.8, 2.5];
            let arguments = Arguments { params, motion: MOTION.to_vec(), ..at_rest(&linkages[1], &[0.7]) };
            compare(linkages.each_ref(), scene, &arguments, &moved);
        }
    }
}

/// Errors and bounds of a linkage that says the same as another one by far points.
fn compare([far, near]: [&Linkage; 2], name: &str, arguments: &Arguments, context: &str) {
    let at = |further: f64| {
        let drives = arguments.drives.iter().map(|drive| drive + further);
        Arguments { drives: drives.collect(), ..arguments.clone() }
    };
    let is_value = |path: &str| !path.starts_with("error_bound.") && !path.ends_with("couple");
    let nearby = (1..4).map(|k| at(f64::from(k) * 1e-12));
    let further = far_points::further_off::<Double>([far, near], (name, is_value), &at(0.0), nearby, f64::EPSILON);
    assert!(further.expect("a pose") < 10.0, "{further:?} times the error; {context}");
    ratios_of::<Double>(far, name, &at(0.0), context);
    let [bounds, near] = [far, near].map(|linkage| scene::<Double>(linkage, name, &at(0.0)).expect("a pose"));
    for (path, bound) in bounds {
        if path.starts_with("error_bound.") && !path.ends_with("couple") {
            assert!(bound.to_f64() <= 10.0 * near[&path].to_f64(), "{path} is {bound:?}; {context}");
        }
    }
}

#[test]
fn every_rule_has_a_case() {
    for rule in RULES {
        assert!(CASES.iter().any(|(class, ..)| *class == rule.class()), "{} has no case", rule.class());
    }
}

/// A parallelogram is one by its side at the stated angle: its place takes no root and no quotient, and is that of the parallelogram. A crossed
/// one takes both.
#[test]
fn a_parallelogram_is_recognised_by_its_side() {
    let (mut parallel, mut crossed) = (0, 0);
    for (pins, at, side) in
        [("A -> Q", 40.0, 1.0), ("Q -> A", 40.0, -1.0), ("A -> Q", -130.0, 1.0), ("Q -> A", -330.0, -1.0)]
    {
        for (word, left) in [("left", side), ("right", -side)] {
            let linkage = compile(&format!(
                "pub mod sample; ground {{ O: (0, 0), Q: (1.2m, 0.5m) }} link crank {{ O -> A: 0.5m }} link b {{ A -> B: 1.3m }}
                 link c {{ Q -> B: 0.5m }} revolute O: ground -> crank; revolute A: crank -> b; revolute B: b -> c;
                 revolute Q: ground -> c; drive q: O; assemble B: {word}({pins}) smooth at {at}deg; scene place: position -> (B);"
            ));
            let place = |q: f64| scene::<Double>(&linkage, "place", &at_rest(&linkage, &[q])).expect("a place");
            // B of the parallelogram, from A, and on which side of the line from A to Q it lies at the stated angle.
            let opposite = |q: f64| [0.5 * q.cos() + 1.2, 0.5 * q.sin() + 0.5];
            let start = f64::to_radians(at);
            let (a, b) = ([0.5 * start.cos(), 0.5 * start.sin()], opposite(start));
            let turn = (1.2 - a[0]) * (b[1] - a[1]) - (0.5 - a[1]) * (b[0] - a[0]);
            let is_parallel = turn * left > 0.0;
            for q in [start, 0.3, 1.9, 3.5, -2.2] {
                let (found, expected) = (place(q), opposite(q));
                let off = (found["B.x"].0 - expected[0]).hypot(found["B.y"].0 - expected[1]);
                assert_eq!(off < 1e-14, is_parallel, "{word}({pins}) at {at}, {q}: {off:e}");
            }
            let counts = linkage.functions.scenes[0].direct.counts();
            assert_eq!(counts.sqrt + counts.div == 0, is_parallel, "{counts}");
            *(if is_parallel { &mut parallel } else { &mut crossed }) += 1;
        }
    }
    assert_eq!((parallel, crossed), (4, 4));
}

/// Of an arm by points only the parameter is replaced by what another link asks to be positive: not a constant for which a wheel of a
/// parameter asks that it is larger.
#[test]
fn folds_of_constants_are_known_beside_wheels_of_parameters() {
    for radius in ["0.4m", "1.1m"] {
        let linkage = compile(&format!(
            "pub mod sample; param w: length = 0.2m; ground {{ A0: (0, 0), B0: (1.1m, 0) }} link crank {{ A0 -> A: 0.4m }}
             link coupler {{ A -> B: 1.1m }} link rocker {{ B0 -> B: 0.4m }} link arm {{ B0: (0, 0), P: ({radius} - w, 0) }}
             link planet {{ P: (0, 0) }} revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker;
             revolute B0: ground -> rocker; revolute M: ground.B0 -> arm.B0; revolute P: arm -> planet;
             gear G: ground.B0 -> planet.P, radii ({radius}, w), internal; drive theta: A0; drive psi: M;
             assemble B: left(A -> B0) smooth at 90deg; scene place: position -> (B);"
        ));
        let counts = linkage.functions.scenes[0].direct.counts();
        assert_eq!((counts.sqrt, counts.div), (0, 0), "{radius}: {counts}");
    }
}
