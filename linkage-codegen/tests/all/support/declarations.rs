//! Declarations of all that there is, and what is given to their functions.

use linkage_codegen::graph::NodeValues;
use linkage_codegen::model::Param;
use linkage_codegen::{Linkage, analyse};
use proc_macro2::{TokenStream, TokenTree};

use super::examples::{declaration, every_example};
use super::linkages::Random;
use super::numbers::Double;
use super::{Arguments, pose};

/// The declarations of every example and of [`OTHERS`], with their names.
pub fn declarations() -> Vec<(String, TokenStream)> {
    let examples = every_example().into_iter().map(|name| {
        let tokens = declaration(&name);
        (name, tokens)
    });
    let others = OTHERS.iter().map(|(name, text)| ((*name).to_owned(), text.parse().expect("tokens")));
    examples.chain(others).collect()
}

/// The same as linkages.
pub fn linkages() -> Vec<(String, Linkage)> {
    declarations().into_iter().map(analysed).collect()
}

/// The same in fused arithmetic.
pub fn fused_linkages() -> Vec<(String, Linkage)> {
    let option: TokenStream = "arithmetic fused;".parse().expect("tokens");
    let fused = declarations().into_iter().map(|(name, tokens)| {
        let mut tokens: Vec<TokenTree> = tokens.into_iter().collect();
        if !tokens.iter().any(|token| matches!(token, TokenTree::Ident(word) if word == "arithmetic")) {
            let ends = |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ';');
            let header = 1 + tokens.iter().position(ends).expect("a header");
            tokens.splice(header..header, option.clone());
        }
        (name, tokens.into_iter().collect())
    });
    fused.map(analysed).collect()
}

fn analysed((name, tokens): (String, TokenStream)) -> (String, Linkage) {
    let linkage = analyse(tokens).unwrap_or_else(|refusal| panic!("{name}: {:?}", refusal.errors));
    (name, linkage)
}

/// What is given at run time, but for the drives: loads, rates and accelerations, the first of both sides, the defaults of parameters.
pub fn given(linkage: &Linkage) -> Arguments {
    let model = &linkage.model;
    let loads = model.loads.iter().enumerate().map(|(index, _)| {
        let index = f64::from(u32::try_from(index).expect("few loads"));
        [-30.0 + 7.0 * index, 40.0 - 11.0 * index]
    });
    let default =
        |param: &Param| model.graph.constant_value(param.default.expect("a default")).expect("a number").to_f64();
    Arguments {
        loads: loads.collect(),
        motion: model.drives.iter().map(|_| [2.5, -1.5]).collect(),
        sides: model.closures.iter().map(|_| 1.0).collect(),
        params: model.params.iter().map(default).collect(),
        ..Arguments::default()
    }
}

/// Two of the poses that are tried and that there are, at coordinates of two digits.
pub fn poses(linkage: &Linkage) -> Vec<Vec<f64>> {
    let given = given(linkage);
    let is_pose = |drives: &Vec<f64>| {
        let arguments = Arguments { drives: drives.clone(), ..given.clone() };
        pose::<Double>(linkage, &arguments).is_ok()
    };
    let found: Vec<Vec<f64>> = coordinates(linkage).filter(is_pose).take(2).collect();
    assert_eq!(found.len(), 2, "{}", linkage.model.name.text);
    found
}

/// Where poses are tried: within a turn, or the length of the longest link.
pub fn coordinates(linkage: &Linkage) -> impl Iterator<Item = Vec<f64>> {
    let model = &linkage.model;
    let given = given(linkage);
    let known = |symbol| given.of(symbol);
    let mut done = NodeValues::default();
    let mut longest = 0.0f64;
    for link in &model.links {
        let at: Vec<[f64; 2]> = link
            .points
            .iter()
            .map(|point| [point.at.x, point.at.y].map(|part| model.graph.evaluate(part, &known, &mut done)))
            .collect();
        let distances = at.iter().flat_map(|p| at.iter().map(move |q| (p[0] - q[0]).hypot(p[1] - q[1])));
        longest = distances.fold(longest, f64::max);
    }
    let mut random = Random(1);
    (0..2000).map(move |_| {
        let each = model.drives.iter().map(|drive| {
            let reach = if drive.turns { 3.0 } else { longest };
            (random.range(-reach, reach) * 100.0).round() / 100.0
        });
        each.collect()
    })
}

/// What no example has: dimensions at run time, single precision, a motion through the folds, a driven slide, two drives, springs,
/// cylinders, slots, welds, gears, inner slides, unknowns elsewhere than at the drives, equations of motion, inverse scenes,
/// derivatives, fused arithmetic, a group of class IV.
pub const OTHERS: [(&str, &str); 25] = [
    (
        "class_iv",
        "/// A group of class IV: two plates, on the crank and on the ground, joined by two rods.
        pub mod class_iv; units { mm, N }
        ground { O: (0, 0), B: (200mm, 0) } link crank { O -> A: 30mm }
        link left { A: (0, 0), C: (60mm, 50mm), D: (90mm, -20mm) } link right { B: (0, 0), E: (-50mm, 60mm), F: (-60mm, -40mm) }
        link upper { C -> E: 77mm } link lower { D -> F: 58mm }
        mass right: 1.2kg at (-30mm, 10mm), inertia 900kg*mm^2;
        revolute O: ground -> crank; revolute A: crank -> left; revolute B: ground -> right; revolute C: left -> upper;
        revolute E: upper -> right; revolute D: left -> lower; revolute F: lower -> right;
        drive theta: O; unknown T: torque(ground -> crank);
        start theta: 16deg; start left: (29mm, 8mm), angle -38deg; start right: (200mm, 0), angle -8deg;
        start upper: (107mm, 10mm), angle 47deg; start lower: (87mm, -63mm), angle 34deg;
        load W: gravity = 9.81m/s^2 @ -90deg; load push: force(right.E);
        scene held: equilibrium; scene parts: superposition -> (T); scene torque: virtual_work -> (T);
        scene place: position -> (right.E, right.angle); scene speeds: velocity -> (right.angle);",
    ),
    (
        "guided_plate",
        "/// A triad one leg of which is guided: the points that give the slide's line lie beside the pins.
        pub mod guided_plate; units { mm, N }
        ground { O: (0, 0), D0: (260mm, 10mm), S: (131mm, 126mm) } link crank { O -> A: 40mm } link rod { A -> B: 121mm }
        link plate { B -> D: 90mm, C: left(B -> D, 60mm, 60mm), Q: (45mm, 20mm) } link rocker { D0 -> D: 82mm }
        link block { C: (0, 0), P: (10mm, 30mm) }
        revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> plate; revolute D: plate -> rocker;
        revolute D0: ground -> rocker; revolute C: plate -> block; prismatic S: ground -> block.P along 20deg;
        drive theta: O; unknown T: torque(ground -> crank);
        start theta: 50deg; start rod: (26mm, 31mm), angle 19deg; start plate: (140mm, 70mm), angle 10deg;
        start rocker: (260mm, 10mm), angle 113deg; start block: (177mm, 117mm), angle 0deg;
        load push: force(plate.Q); load along: force(block.P) in block = 40N @ 20deg;
        scene held: equilibrium; scene place: position -> (block.C); scene speeds: velocity -> (S);",
    ),
    (
        "fused",
        "/// A crank-rocker in fused arithmetic.
        pub mod fused; units { mm, N } arithmetic fused;
        ground { A0: (0, 0), B0: (140mm, 0) } link crank { A0 -> A: 40mm } link coupler { A -> B: 100mm, C: (60mm, 35mm) }
        link rocker { B0 -> B: 120mm }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        drive theta: A0; assemble B: left(A -> B0); load F: force(coupler.C); scene held: equilibrium;",
    ),
    (
        "bounded",
        "/// A slider-crank whose results come with bounds of their rounding errors.
        pub mod bounded; ground { O: (0, 0) } link crank { O -> A: 0.25m } link rod { A -> B: 1m } link piston { B }
        revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic C: ground.O -> piston.B along 0deg;
        drive theta: O; unknown T: torque(ground -> crank); assemble B: ahead(A); load gas: force(piston.B);
        scene hold: equilibrium -> (T, B, error_bound);",
    ),
    (
        "adjustable",
        "/// A crank-rocker whose dimensions are given at run time.
        pub mod adjustable; units { mm, N } scalar f32;
        param base: length = 140mm; param crank_length: length = 80mm; param tilt: angle = 10deg;
        ground { A0: (0, 0), B0: base @ tilt } link crank { A0 -> A: crank_length }
        link coupler { A -> B: 100mm, C: (crank_length / 2, 20mm) } link rocker { B0 -> B: 120mm }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        drive theta: A0; unknown T12: torque(ground -> crank); assemble B: left(A -> B0);
        load F: force(coupler.C) in coupler; load M: moment(rocker);
        scene torque: virtual_work -> (T12); scene reaction: equilibrium -> (B); scene turn: sweep(torque);",
    ),
    (
        "sensitive",
        "/// How a crank's torque and a coupler's point change with the angle, the loads and the crank.
        pub mod sensitive; units { mm, N }
        param crank_length: length = 80mm;
        ground { A0: (0, 0), B0: (140mm, 0) } link crank { A0 -> A: crank_length } link coupler { A -> B: 100mm, C: (50mm, 20mm) }
        link rocker { B0 -> B: 120mm }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        drive theta: A0; unknown T12: torque(ground -> crank); assemble B: left(A -> B0);
        load F: force(coupler.C); load K: spring(ground.B0, coupler.C) { rate: 2N/mm, free: _ };
        scene torque: virtual_work -> (T12); scene place: position -> (coupler.C);
        scene slopes: derivative(torque) by (theta, F, K, crank_length); scene moved: derivative(place) by (theta, crank_length);",
    ),
    (
        "parallelogram",
        "/// Folds at 0 and at π, and moves on smoothly.
        pub mod parallelogram; units { mm, N }
        ground { A0: (0, 0), B0: (200mm, 0) } link crank { A0 -> A: 60mm } link coupler { A -> B: 200mm, C: (70mm, 30mm) }
        link rocker { B0 -> B: 60mm }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        drive theta: A0; assemble B: left(A -> B0) smooth at 60deg;
        load F: force(coupler.C); scene held: equilibrium -> (effort_theta, B); scene place: position -> (coupler.C);",
    ),
    (
        "oscillating_cylinder",
        "/// A steam engine without a connecting rod: its cylinder swings about a pin beside its line.
        pub mod oscillating_cylinder; units { mm, N }
        ground { O: (0, 0), C: (0, 260mm) } link crank { O -> A: 60mm } link piston { A: (0, 0), head: (150mm, 0) }
        link cylinder { C: (0, 10mm), bore: (0, 0) }
        revolute O: ground -> crank; revolute A: crank -> piston; prismatic slide: piston.A -> cylinder.bore along 0deg of piston;
        revolute C: ground -> cylinder;
        drive theta: O; unknown T: torque(ground -> crank); assemble slide: ahead(A);
        load steam: force(piston.head) in piston; load back: force(cylinder.bore) in cylinder;
        scene held: equilibrium; scene torque: virtual_work -> (T); scene place: position -> (slide, cylinder.angle);",
    ),
    (
        "excavator",
        "/// A boom on a cylinder, and a bucket that a second cylinder turns by a link and a bell crank.
        pub mod excavator; units { m, kN }
        ground { O: (0, 0), P: (0.6m, -0.4m) }
        link boom { O: (0, 0), Q: (1.2m, 0.3m), C0: (1.0m, 0.6m), R0: (2.3m, 0.35m), K0: (2.75m, 0.2m) }
        link tube { P: (0, 0) } link rod { Q: (0, 0) }
        link cylinder { C0: (0, 0) } link plunger { T: (0, 0) } link bell { R0 -> T: 0.47m }
        link coupler { T -> U: 0.63m } link bucket { K0 -> U: 0.46m, tip: (-0.6m, -0.8m) }
        mass boom: 600kg at (1.4m, 0.3m); mass bucket: 180kg at (-0.16m, -0.35m);
        revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
        prismatic lift: tube.P -> rod.Q along 0deg of tube;
        revolute C0: boom -> cylinder; prismatic curl: cylinder.C0 -> plunger.T along 0deg of cylinder;
        revolute T: plunger -> bell; revolute R0: boom -> bell; revolute Tl: bell.T -> coupler.T;
        revolute U: coupler -> bucket; revolute K0: boom -> bucket;
        drive boom_length: lift; drive bucket_length: curl;
        assemble Q: left(P -> O); assemble T: left(C0 -> R0); assemble U: left(Tl -> K0);
        load W: gravity = 9.81m/s^2 @ -90deg; load dig: force(bucket.tip) in bucket;
        scene held: equilibrium -> (effort_boom_length, effort_bucket_length); scene work: virtual_work;
        scene place: position -> (bucket.tip, bucket.angle);",
    ),
    (
        "hoist",
        "/// A carriage that runs on a slope, and an arm on it.
        pub mod hoist; units { m, kN }
        ground { O: (0, 0) } link carriage { P: (0, 0), E: (0.2m, 0.5m) } link arm { E: (0, 0), tip: (2.9m, 0) }
        mass carriage: 600kg at (0.1m, 0.2m); mass arm: 300kg at (1m, 0), inertia 200kg*m^2;
        prismatic run: ground.O -> carriage.P along 15deg, angle 15deg; revolute E: carriage -> arm;
        drive travel: run; drive turn: E;
        load W: gravity = 9.81m/s^2 @ -90deg; load lifted: force(arm.tip);
        scene held: equilibrium; scene work: virtual_work; scene place: position -> (E, arm.tip, arm.angle);",
    ),
    (
        "boom",
        "/// An excavator's boom and stick, each with its cylinder; the bodies of the cylinders do not matter.
        pub mod boom; units { m, kN }
        ground { O: (0, 0), C: (0.9m, -0.3m) } link boom { O -> E: 5m, Q: (2.2m, 0.4m), R: (2.6m, 0.9m) }
        link stick { E -> tip: 2.8m, K: (-0.6m, 0.2m) }
        mass boom: 1400kg at (2.4m, 0.3m); mass stick: 600kg at (1m, 0);
        revolute O: ground -> boom; revolute E: boom -> stick;
        drive lift: O; drive curl: E;
        unknown boom_cylinder: thrust(ground.C, boom.Q); unknown stick_cylinder: thrust(boom.R, stick.K);
        load W: gravity = 9.81m/s^2 @ -90deg; load dig: force(stick.tip);
        scene held: equilibrium -> (boom_cylinder, stick_cylinder, O along boom, E along stick);
        scene work: virtual_work;",
    ),
    (
        "balanced_arm",
        "/// An arm whose weight a spring without free length balances at every angle, and a counter spring that does not.
        pub mod balanced_arm; units { mm, N }
        ground { O: (0, 0), P: (0, 200mm), Q: (-80mm, 0) } link arm { O -> tip: 400mm, M: (250mm, 0), K: (150mm, 0) }
        mass arm: 1.2kg at M;
        revolute O: ground -> arm; drive theta: O;
        load W: gravity = 10m/s^2 @ -90deg;
        load balance: spring(ground.P, arm.K) { rate: 0.1N/mm, free: 0 };
        load counter: spring(arm.M, ground.Q) { rate: _, free: 60mm, preload: 5N };
        load stop: torsion(ground -> arm) { rate: 3N*m/rad, free: 20deg };
        load push: thrust(ground.Q, arm.tip);
        scene balanced: equilibrium(W, balance) -> (effort_theta);
        scene held: equilibrium; scene parts: superposition(counter, stop) -> (effort_theta, O);
        scene work: virtual_work(balance, counter, stop, push); scene check: verify;",
    ),
    (
        "shaper",
        "/// A crank shaper: the crank's pin swings the slotted lever, which draws the ram.
        pub mod shaper; units { mm, N }
        ground { O2: (0, 0), O4: (0, -350mm), R: (0, 330mm) } link crank { O2 -> A: 140mm } link lever { O4 -> B: 720mm }
        link rod { B -> C: 280mm } link ram { C: (0, 0), tool: (-200mm, -60mm) }
        revolute O2: ground -> crank; revolute O4: ground -> lever; slot A: lever.O4 -> crank.A along 0deg of lever;
        revolute B: lever -> rod; revolute C: rod -> ram; prismatic R: ground.R -> ram.C along 0deg;
        drive theta: O2; assemble A: ahead(O4); assemble C: behind(B);
        load cut: force(ram.tool); scene held: equilibrium; scene torque: virtual_work;",
    ),
    (
        "engine_dynamic",
        "/// An engine in motion: bearing forces with inertia, a constant speed that is declared apart.
        pub mod engine_dynamic; units { mm, N }
        ground { O: (0, 0) } link crank { O -> A: 40mm } link rod { A -> B: 140mm, C: (45mm, 0) } link piston { B }
        mass crank: 1.1kg at (5mm, 0), inertia 900kg*mm^2; mass rod: 0.62kg at C, inertia 1900kg*mm^2; mass piston: 0.45kg at B;
        revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: ground.O -> piston.B along 0deg;
        drive theta: O; assemble B: ahead(A);
        load I: inertia; load gas: force(piston.B); load K: spring(ground.O, rod.C) { damping: _ };
        scene dynamics: equilibrium(I, gas); scene torque: virtual_work(I, gas) -> (effort_theta);
        scene damped: equilibrium(K) -> (effort_theta); scene statics: equilibrium(gas) -> (effort_theta);
        scene speeds: velocity; scene accelerations: acceleration -> (B, rod.C, rod.C along path, rod.angle, inertia(rod), offset(rod));",
    ),
    (
        "robot",
        "/// A five-bar robot under computed torque: its equation of motion, and that of its links alone.
        pub mod robot;
        ground { O1: (0, 0), O2: (0.5m, 0) } link left { O1 -> P: 0.3m } link right { O2 -> Q: 0.3m }
        link upper { P -> R: 0.45m } link lower { Q -> R: 0.4m }
        mass left: 1.2kg at (0.12m, 0), inertia 0.01kg*m^2; mass right: 1.2kg at (0.12m, 0), inertia 0.01kg*m^2;
        mass upper: 0.8kg at (0.2m, 0), inertia 0.012kg*m^2; mass lower: 0.7kg at (0.15m, 0.01m);
        revolute O1: ground -> left; revolute O2: ground -> right; revolute P: left -> upper; revolute Q: right -> lower;
        revolute R: upper -> lower;
        drive a: O1; drive b: O2; assemble R: left(P -> Q);
        load tool: force(upper.R); scene control: motion; scene mass: motion() -> (M); scene cycle: sweep(control);",
    ),
    (
        "swing",
        "/// The crank of a crank-rocker for a wanted motion of the rocker.
        pub mod swing; units { mm, N } param reach: length = 120mm;
        ground { A0: (0, 0), B0: (140mm, 0) } link crank { A0 -> A: 40mm } link coupler { A -> B: 120mm } link rocker { B0 -> B: reach }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        drive theta: A0; assemble B: left(A -> B0); assemble A: right(A0 -> B);
        scene place: position -> (rocker.angle); scene gains: coefficients -> (rocker.angle, B); scene crank_of: inverse(B0); scene angle_of: inverse(B0) -> (theta);",
    ),
    (
        "bounded_four_bar",
        "/// A drag link with a bound of the rounding error of its torque.
        pub mod bounded_four_bar; units { mm, N }
        ground { A0: (0, 0), B0: (40mm, 0) } link crank { A0 -> A: 80mm } link coupler { A -> B: 100mm } link rocker { B0 -> B: 90mm, D: (60mm, 20mm) }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0);
        load F: force(rocker.D); scene held: equilibrium -> (T, error_bound);",
    ),
    (
        "either_side",
        "/// A crank-rocker that is assembled on the side that the caller states, and one of its kind that folds.
        pub mod either_side; units { mm, N }
        ground { A0: (0, 0), B0: (100mm, 0), C0: (-150mm, 0) } link crank { A0 -> A: 40mm, D: (0, 50mm) }
        link coupler { A -> B: 120mm, E: (60mm, 30mm) } link rocker { B0 -> B: 80mm }
        link rod { D -> C: 120mm, G: (40mm, -10mm) } link lever { C0 -> C: 80mm }
        revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
        revolute D: crank -> rod; revolute C: rod -> lever; revolute C0: ground -> lever;
        drive theta: A0; assemble B: either(A -> B0); assemble C: either(D -> C0);
        load F: force(coupler.E); load H: force(rod.G);
        scene held: equilibrium -> (effort_theta, B); scene torque: virtual_work -> (effort_theta);",
    ),
    (
        "scotch_yoke",
        "/// A Scotch yoke with an arm welded to it.
        pub mod scotch_yoke; units { mm, N }
        ground { O: (0, 0) } link crank { O -> A: 80mm } link yoke { Y: (0, 0), W: (300mm, 0) } link arm { W -> tip: 100mm }
        revolute O: ground -> crank; prismatic Y: ground.O -> yoke along 0deg; slot A: yoke.Y -> crank.A along 90deg of yoke;
        weld W: yoke -> arm, angle 90deg;
        drive theta: O; load F: force(arm.tip); scene held: equilibrium; scene torque: virtual_work;",
    ),
    (
        "gears",
        "/// A wheel turned by a pinion, and a planetary train: sun, carrier, and a planet in a fixed ring.
        pub mod gears; units { mm, N }
        ground { O: (0, 0), P: (0, -450mm) } link pinion { P } link sun { O } link carrier { O -> C: 375mm } link planet { C }
        revolute P: ground -> pinion; revolute Os: ground.O -> sun.O; revolute Oc: ground.O -> carrier.O; revolute C: carrier -> planet;
        gear G: pinion.P -> sun.O, radii (150mm, 300mm), phase 5mm, pressure_angle 20deg, flank left;
        gear Gs: sun.O -> planet.C, radii (250mm, 125mm); gear Gr: ground.O -> planet.C, radii (500mm, 125mm), internal;
        drive theta: P; load M: moment(carrier); scene held: equilibrium; scene torque: virtual_work;
        scene angles: position -> (sun.angle, carrier.angle, planet.angle, Gs);",
    ),
    (
        "five_bar",
        "/// A five-bar: a point in the plane, placed by two motors on the ground.
        pub mod five_bar; units { mm, N }
        ground { O1: (-250mm, 0), O2: (300mm, 50mm) } link left { O1 -> A: 650mm } link right { O2 -> B: 680mm }
        link upper { A -> C: 955mm } link lower { B -> C: 850mm, tool: (1100mm, -105mm) }
        mass left: 1kg at (320mm, 0), inertia 40000kg*mm^2; mass lower: 0.9kg at (460mm, -35mm), inertia 70000kg*mm^2;
        revolute O1: ground -> left; revolute O2: ground -> right; revolute A: left -> upper; revolute B: right -> lower;
        revolute C: upper -> lower;
        drive a: O1; drive b: O2; assemble C: left(A -> B);
        load W: gravity = 9.81m/s^2 @ -90deg; load I: inertia; load tip: force(lower.tool);
        scene held: equilibrium(W, tip) -> (effort_a, effort_b); scene torques: virtual_work(W, tip) -> (effort_a, effort_b);
        scene dynamics: equilibrium -> (effort_a, effort_b, C); scene place: position -> (lower.tool);",
    ),
    (
        "planetary_drive",
        "/// A planet that two motors turn, by the arm and by the sun, and a rod on a pin beside its centre: what both do at speed.
        pub mod planetary_drive; units { mm, N }
        ground { O: (0, 0), Q: (200mm, 0) } link arm { O -> P: 50mm } link sun { O } link planet { P: (0, 0), E: (22mm, 0) }
        link rod { E -> R: 120mm } link lever { Q -> R: 100mm }
        mass planet: 1kg at P, inertia 500kg*mm^2; mass rod: 0.3kg at (60mm, 0), inertia 400kg*mm^2;
        revolute Oa: ground.O -> arm.O; revolute Os: ground.O -> sun.O; revolute P: arm -> planet;
        gear G: sun.O -> planet.P, radii (20mm, 30mm), pressure_angle 20deg, flank left;
        revolute E: planet -> rod; revolute R: rod -> lever; revolute Q: ground -> lever;
        drive a: Oa; drive b: Os; assemble R: right(E -> Q); load I: inertia; load M: moment(lever);
        scene held: equilibrium -> (effort_a, effort_b, G); scene torque: virtual_work -> (effort_a, effort_b);
        scene speeds: velocity -> (planet.angle, E); scene turning: acceleration -> (planet.angle, lever.angle);",
    ),
    (
        "geared_five_bar",
        "/// Two cranks in mesh, and a coupler on each: a pin on a path that one crank cannot give.
        pub mod geared_five_bar; units { mm, N }
        ground { O1: (0, 0), O2: (562.5mm, 0) } link driver { O1 -> A: 225mm } link driven { O2 -> B: 380mm }
        link left { A -> C: 765mm } link right { B -> C: 745mm, tip: (1060mm, -20mm) }
        revolute O1: ground -> driver; revolute O2: ground -> driven;
        gear G: driver.O1 -> driven.O2, radii (312.5mm, 250mm), phase 860mm, pressure_angle 20deg, flank left;
        revolute A: driver -> left; revolute B: driven -> right; revolute C: left -> right;
        drive theta: O1; unknown T: torque(ground -> driver); assemble C: right(A -> B);
        load F: force(right.tip); scene held: equilibrium; scene torque: virtual_work -> (T); scene place: position -> (C, G);",
    ),
    (
        "toggle_clamp",
        "/// A toggle clamp: the hand on the lever against the work under the arm, nearly at its toggle.
        pub mod toggle_clamp; units { mm, N }
        ground { O1: (0, 0), O2: (60mm, 10mm) } link lever { O1 -> A: 35mm, H: (85mm, 160mm) } link mid { A -> B: 55mm }
        link arm { O2 -> B: 98mm, tip: (-38mm, -71mm) }
        revolute O1: ground -> lever; revolute A: lever -> mid; revolute B: mid -> arm; revolute O2: ground -> arm;
        drive theta: O1; unknown hand: force(lever.H) along (3, -4) of lever; assemble B: left(A -> O2);
        load work: force(arm.tip); scene closed: equilibrium; scene hold: virtual_work -> (hand);",
    ),
    (
        "scissor_lift",
        "/// A scissor lift of two stages on pins and rollers, raised by a cylinder within its lower one.
        pub mod scissor_lift; units { m, N }
        ground { L: (0, 0), R: (0, 0) }
        link rising1 { L -> R: 1m, M: (0.5m, 0), N: (0.8m, 0) } link falling1 { R -> L: 1m, M: (0.5m, 0), K: (0.35m, 0.05m) }
        link rising2 { L -> R: 1m, M: (0.5m, 0) } link falling2 { R -> L: 1m, M: (0.5m, 0) } link deck { L: (0, 0), Q: (0.3m, 0.1m) }
        mass deck: 20kg at (0.5m, 0);
        revolute L1: ground.L -> rising1.L; slot roller: ground.R -> falling1.R along 0deg; revolute M1: rising1.M -> falling1.M;
        revolute L2: falling1.L -> rising2.L; revolute R2: rising1.R -> falling2.R; revolute M2: rising2.M -> falling2.M;
        revolute L3: falling2.L -> deck.L; slot top: deck.L -> rising2.R along 0deg of deck;
        drive x: roller.travel; unknown cylinder: thrust(falling1.K, rising1.N);
        assemble M1: left(L1 -> roller); assemble M2: right(L2 -> R2); assemble top: ahead(L3);
        load W: gravity = 9.81m/s^2 @ -90deg; load goods: force(deck.Q);
        scene held: equilibrium; scene thrust: virtual_work -> (cylinder); scene height: position -> (deck.L, deck.angle);",
    ),
];
