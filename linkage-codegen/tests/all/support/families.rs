//! Families of poses and the bars that they are held to.

use linkage_codegen::Linkage;
use linkage_codegen::model::Param;

use super::linkages::{Class, Layout, Random, Sample, sample_with_forces};
use super::measures::{Measures, measure};
use super::numbers::{Double, Single};
use super::{Arguments, Number, compile_if_it_closes};

/// The bars, in epsilons of the scalar.
pub const BARS: Measures = Measures { unit: 3.0, closure: 4.0, backward: 1.0, free_body: 3.0, torque: 8.0 };

/// A family of poses of a linkage: declaration without its scalar, the length of its longest link, drives and loads.
pub struct Family {
    pub text: String,
    pub longest: f64,
    pub drives: Vec<f64>,
    pub loads: Vec<[f64; 2]>,
}

pub const SCENES: &str = "scene all: equilibrium; scene work: virtual_work;";

/// A four-bar with forces on coupler and rocker.
pub fn four_bar(lengths: [f64; 4], random: &mut Random) -> String {
    let [g, a, b, c] = lengths;
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let side = random.pick(&["left", "right"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), B0: {g:?}m @ {angle:?}deg }} link crank {{ A0 -> A: {a:?}m }}
         link coupler {{ A -> B: {b:?}m, C: ({x:?}m, {y:?}m) }} link rocker {{ B0 -> B: {c:?}m, D: ({y:?}m, {x:?}m) }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: {side}(A -> B0);
         load F: force(coupler.C); load H: force(rocker.D); {SCENES}"
    )
}

/// A slider-crank with forces on rod and piston; the guide lies anywhere and does not go through the crank's pivot.
pub fn slider_crank([crank, rod, offset]: [f64; 3], random: &mut Random) -> String {
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let side = random.pick(&["ahead", "behind"]);
    let carrier = random.pick(&["ground", "piston"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), C: {offset:?}m @ {angle:?}deg + 90deg }} link crank {{ A0 -> A: {crank:?}m }}
         link coupler {{ A -> B: {rod:?}m, P: ({x:?}m, {y:?}m) }} link piston {{ B: (0, 0), C: ({x:?}m, 0), D: ({y:?}m, {x:?}m) }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> piston;
         prismatic C: ground -> piston along {angle:?}deg of {carrier};
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: {side}(A);
         load F: force(coupler.P); load H: force(piston.D); {SCENES}"
    )
}

/// The rest of a linkage that a crank drives, with forces on two links.
const CRANK: &str = "revolute A0: ground -> crank; drive theta: A0; unknown T: torque(ground -> crank);";

/// A crank whose pin slides through a block that swings about another pin; the offset keeps its line off that pin.
pub fn oscillating_block([ground, crank, offset]: [f64; 3], random: &mut Random) -> String {
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let side = random.pick(&["ahead", "behind"]);
    let carrier = random.pick(&["rod", "block"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), C: {ground:?}m @ {angle:?}deg }} link crank {{ A0 -> A: {crank:?}m }}
         link rod {{ A: (0, 0), P: ({x:?}m, {y:?}m) }} link block {{ C: (0, {offset:?}m), S: (0, 0), D: ({y:?}m, {x:?}m) }}
         revolute A: crank -> rod; prismatic S: rod.A -> block.S along 0deg of {carrier}; revolute C: ground -> block;
         {CRANK} assemble S: {side}(A); load F: force(rod.P); load H: force(block.D); {SCENES}"
    )
}

/// A block that slides on the crank, and moves a slider; the crank's line goes past its pivot.
pub fn tangent_mechanism([guide, offset, angle]: [f64; 3], random: &mut Random) -> String {
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let carrier = random.pick(&["ground", "slider"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), G: ({guide:?}m, 0) }} link crank {{ A0: (0, 0), S: (0, {offset:?}m) }}
         link block {{ B: (0, 0), P: ({x:?}m, {y:?}m) }} link slider {{ B: (0, 0), D: ({y:?}m, {x:?}m) }}
         prismatic S: crank.S -> block.B along 0deg of crank; revolute B: slider -> block;
         prismatic G: ground.G -> slider.B along {angle:?}deg of {carrier};
         {CRANK} load F: force(block.P); load H: force(slider.D); {SCENES}"
    )
}

/// A Scotch yoke with a block in its slot, which is inclined to the guide.
pub fn scotch_yoke([crank, offset, angle]: [f64; 3], random: &mut Random) -> String {
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let line = random.range(0.0, 360.0);
    let carrier = random.pick(&["block", "yoke"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), G: (0.25m, {offset:?}m) }} link crank {{ A0 -> A: {crank:?}m }}
         link block {{ A: (0, 0), P: ({x:?}m, {y:?}m) }} link yoke {{ S: ({offset:?}m, 0), G: (0, 0), D: ({y:?}m, {x:?}m) }}
         revolute A: crank -> block; prismatic S: yoke.S -> block.A along {line:?}deg + {angle:?}deg of {carrier};
         prismatic G: yoke -> ground along {line:?}deg;
         {CRANK} load F: force(block.P); load H: force(yoke.D); {SCENES}"
    )
}

/// A boom that a cylinder lifts, its rod's end beside the cylinder's line, with forces on two of the three.
pub fn boom([ground, boom, offset]: [f64; 3], random: &mut Random) -> String {
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let side = random.pick(&["left", "right"]);
    let carrier = random.pick(&["tube", "rod"]);
    let (first, second) = random.pick(&[("boom.T", "tube.D"), ("boom.T", "rod.E"), ("tube.D", "rod.E")]);
    format!(
        "pub mod sample; ground {{ O: (0, 0), P: {ground:?}m @ {angle:?}deg }} link boom {{ O -> Q: {boom:?}m, T: ({x:?}m, {y:?}m) }}
         link tube {{ P: (0, 0), D: ({y:?}m, {x:?}m) }} link rod {{ Q: (0, {offset:?}m), S: (0, 0), E: ({x:?}m, {y:?}m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of {carrier}; drive extension: lift; assemble Q: {side}(P -> O);
         load F: force({first}); load H: force({second}); {SCENES}"
    )
}

/// A lever with a slot that the crank's pin swings; the slot's line goes past the lever's pin.
pub fn shaper([ground, crank, offset]: [f64; 3], random: &mut Random) -> String {
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let side = random.pick(&["ahead", "behind"]);
    let line = random.range(0.0, 360.0);
    let arrow = random.pick(&["lever.S -> crank.A", "crank.A -> lever.S"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), P: {ground:?}m @ {angle:?}deg }} link crank {{ A0 -> A: {crank:?}m, C: ({x:?}m, {y:?}m) }}
         link lever {{ P: (0, 0), S: {offset:?}m @ {line:?}deg + 90deg, D: ({y:?}m, {x:?}m) }}
         slot S: {arrow} along {line:?}deg of lever; revolute P: ground -> lever;
         {CRANK} assemble S: {side}(P); load F: force(crank.C); load H: force(lever.D); {SCENES}"
    )
}

/// A link whose end runs in a slot of the crank, beside the crank's pin.
pub fn slotted_crank([ground, rocker, offset]: [f64; 3], random: &mut Random) -> String {
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let side = random.pick(&["ahead", "behind"]);
    let arrow = random.pick(&["crank.K -> rocker.S", "rocker.S -> crank.K"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), P: {ground:?}m @ {angle:?}deg }} link crank {{ A0: (0, 0), K: (0, {offset:?}m), C: ({x:?}m, {y:?}m) }}
         link rocker {{ P -> S: {rocker:?}m, D: ({y:?}m, {x:?}m) }}
         slot S: {arrow} along 0deg of crank; revolute P: ground -> rocker;
         {CRANK} assemble S: {side}(P); load F: force(crank.C); load H: force(rocker.D); {SCENES}"
    )
}

/// A Scotch yoke whose slot holds the crank's pin.
pub fn slotted_yoke([crank, offset, angle]: [f64; 3], random: &mut Random) -> String {
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let line = random.range(0.0, 360.0);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), G: (0.25m, {offset:?}m) }} link crank {{ A0 -> A: {crank:?}m, C: ({x:?}m, {y:?}m) }}
         link yoke {{ S: ({offset:?}m, 0), G: (0, 0), D: ({y:?}m, {x:?}m) }}
         slot S: yoke.S -> crank.A along {line:?}deg + {angle:?}deg of yoke; prismatic G: yoke -> ground along {line:?}deg;
         {CRANK} load F: force(crank.C); load H: force(yoke.D); {SCENES}"
    )
}

/// A four-bar with a coupler of two welded links and an arm welded to its rocker.
pub fn welded([ground, crank, rocker]: [f64; 3], random: &mut Random) -> String {
    let angle = random.range(0.0, 360.0);
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let (b, w, turn) = (length(random, 0.1, 2.0), length(random, -0.5, 0.5), random.range(-180.0, 180.0));
    let side = random.pick(&["left", "right"]);
    let (first, second) =
        random.pick(&[("near.C", "tip.D"), ("near.C", "arm.K"), ("tip.D", "arm.K"), ("tip.D", "rocker.E")]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0), B0: {ground:?}m @ {angle:?}deg }} link crank {{ A0 -> A: {crank:?}m }}
         link near {{ A: (0, 0), W: (0.5m, {w:?}m), C: ({x:?}m, {y:?}m) }} link tip {{ W: (0, 0), B: ({b:?}m, 0), D: ({y:?}m, {x:?}m) }}
         link rocker {{ B0 -> B: {rocker:?}m, V: ({w:?}m, 0.25m), E: ({x:?}m, {y:?}m) }} link arm {{ V: (0, 0), K: ({y:?}m, {w:?}m) }}
         revolute A: crank -> near; weld W: near -> tip, angle {turn:?}deg; revolute B: tip -> rocker; revolute B0: ground -> rocker;
         weld V: rocker -> arm, angle {angle:?}deg;
         {CRANK} assemble B: {side}(A -> B0); load F: force({first}); load H: force({second}); {SCENES}"
    )
}

/// A planet on a driven carrier, about a fixed sun or in a fixed ring.
pub fn planet([sun, planet, phase]: [f64; 3], random: &mut Random) -> String {
    let (x, y) = (length(random, -1.0, 1.0), length(random, -1.0, 1.0));
    let (ring, carrier) = if random.chance(0.5) { ("", sun + planet) } else { (", internal", sun) };
    let wheel = if ring.is_empty() { sun } else { sun + planet };
    let teeth = random.pick(&["", ", pressure_angle 20deg, flank left", ", pressure_angle 25deg, flank right"]);
    format!(
        "pub mod sample; ground {{ A0: (0, 0) }} link carrier {{ A0 -> P: {carrier:?}m, C: ({x:?}m, {y:?}m) }}
         link planet {{ P: (0, 0), D: ({y:?}m, {x:?}m) }}
         revolute A0: ground -> carrier; drive theta: A0; unknown T: torque(ground -> carrier); revolute P: carrier -> planet;
         gear G: ground.A0 -> planet.P, radii ({wheel:?}m, {planet:?}m), phase {phase:?}m{ring}{teeth}; load F: force(carrier.C); load H: force(planet.D); {SCENES}"
    )
}

/// A linkage whose last group has no closed form, near where it starts.
pub fn searched(seed: u64, class: Class, poses: usize) -> Family {
    let Sample { text, arguments, longest, .. } = sample_with_forces(seed, class, Layout::Anywhere);
    let mut random = Random(seed);
    let begin = arguments.drives[0];
    let drives = (0..poses).map(|_| begin + random.range(-0.3, 0.3)).collect();
    Family { text, longest, drives, loads: arguments.loads }
}

/// The worst measures of a family, over the poses that assemble and are no dead centres; and how many those are.
pub fn worst<T: Number>(family: &Family, scalar: &str, epsilon: f64) -> (Measures, usize) {
    let text = family.text.replacen(';', &format!("; scalar {scalar};"), 1);
    let Some(linkage) = compile_if_it_closes(&text) else { return (Measures::default(), 0) };
    let mut worst = Measures::default();
    let mut count = 0;
    for drive in &family.drives {
        let (drives, loads) = (vec![*drive], family.loads.clone());
        let arguments = Arguments { drives, loads, params: defaults(&linkage), ..Arguments::default() };
        if let Ok(measures) = measure::<T>(&linkage, &arguments, family.longest, epsilon) {
            worst = worst.worst(measures);
            count += 1;
        }
    }
    (worst, count)
}

/// The defaults of a linkage's parameters.
pub fn defaults(linkage: &Linkage) -> Vec<f64> {
    let model = &linkage.model;
    let default = |param: &Param| model.graph.constant_value(param.default.expect("a default"));
    model.params.iter().map(|param| default(param).expect("a number").to_f64()).collect()
}

/// The same linkage with the lengths of its links as parameters: what stands behind `A -> B:` is a default.
pub fn with_parameters(text: &str) -> String {
    let (mut params, mut parts) = (String::new(), text.split(" -> "));
    let mut changed = parts.next().expect("a part").to_owned();
    for (index, part) in parts.enumerate() {
        changed += " -> ";
        let is_number = |c: char| c.is_ascii_digit() || ".e-".contains(c);
        let named = part.split_once(": ").filter(|(name, _)| name.chars().all(char::is_alphanumeric));
        let length = named.map(|(name, rest)| (name, rest.split_at(rest.find(|c| !is_number(c)).unwrap_or(0))));
        match length {
            Some((name, (length, rest))) if rest.starts_with('m') => {
                params += &format!(" param length_{index}: length = {length}m;");
                changed += &format!("{name}: length_{index}{}", &rest[1..]);
            }
            _ => changed += part,
        }
    }
    changed.replacen(';', &format!(";{params}"), 1)
}

/// Holds all families to the bars, in both scalars; how many poses they had.
pub fn check(families: impl Iterator<Item = Family>, what: &str) -> usize {
    let mut all = [Measures::default(); 2];
    let (mut count, mut singles) = (0, 0);
    for family in families {
        let (double, poses) = worst::<Double>(&family, "f64", f64::EPSILON);
        let (single, in_single) = worst::<Single>(&rounded(&family), "f32", f64::from(f32::EPSILON));
        all = [all[0].worst(double), all[1].worst(single)];
        count += poses;
        singles += in_single;
    }
    // Next to dead centres single precision ends much sooner.
    assert!(4 * singles > count, "{what}: {singles} poses in f32, {count} in f64");
    println!("{what}, {count} poses\n  f64 {:?}\n  f32 {:?}", all[0], all[1]);
    all[0].assert_within(&BARS, &format!("{what}, f64"));
    all[1].assert_within(&BARS, &format!("{what}, f32"));
    count
}

/// The same with single-precision arguments.
#[allow(clippy::cast_possible_truncation, reason = "that is the point")]
pub fn rounded(family: &Family) -> Family {
    let round = |x: &f64| f64::from(*x as f32);
    let drives = family.drives.iter().map(round).collect();
    let loads = family.loads.iter().map(|load| [round(&load[0]), round(&load[1])]).collect();
    Family { text: family.text.clone(), longest: family.longest, drives, loads }
}

/// A length that single precision holds too.
pub fn length(random: &mut Random, low: f64, high: f64) -> f64 {
    single(random.range(low, high))
}

/// The nearest number that single precision holds too.
#[allow(clippy::cast_possible_truncation, reason = "that is the point")]
pub fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

pub fn loads(random: &mut Random) -> Vec<[f64; 2]> {
    (0..2).map(|_| [random.range(-50.0, 50.0), random.range(-50.0, 50.0)]).collect()
}
