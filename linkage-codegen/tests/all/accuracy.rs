//! The accuracy bars of the closed forms, on random poses.

use crate::support::families::{
    BARS, Family, SCENES, boom, check, defaults, four_bar, length, loads, oscillating_block, planet, scotch_yoke,
    searched, shaper, single, slider_crank, slotted_crank, slotted_yoke, tangent_mechanism, welded,
};
use crate::support::linkages::{Class, Random};
use crate::support::measures::{Measures, measure};
use crate::support::numbers::{Double, Extended, Single};
use crate::support::{Arguments, Number, compile, pose, scene};
use linkage_codegen::Linkage;

/// Linkages with legs of any length, whose cranks turn.
fn with_legs<const N: usize>(
    seed: u64,
    count: usize,
    poses: usize,
    text: fn([f64; N], &mut Random) -> String,
) -> impl Iterator<Item = Family> {
    let mut random = Random(seed);
    (0..count).map(move |_| {
        let lengths = [0; N].map(|_| length(&mut random, 0.1, 2.0));
        let text = text(lengths, &mut random);
        let drives = (0..poses).map(|_| random.range(-7.0, 7.0)).collect();
        Family { text, longest: lengths.into_iter().fold(0.0, f64::max), drives, loads: loads(&mut random) }
    })
}

fn random_four_bars(seed: u64, count: usize, poses: usize) -> impl Iterator<Item = Family> {
    with_legs(seed, count, poses, four_bar)
}

fn random_slider_cranks(seed: u64, count: usize, poses: usize) -> impl Iterator<Item = Family> {
    let mut random = Random(seed);
    (0..count).map(move |_| {
        let lengths = [length(&mut random, 0.1, 1.0), length(&mut random, 0.3, 3.0), length(&mut random, -0.5, 0.5)];
        let text = slider_crank(lengths, &mut random);
        let drives = (0..poses).map(|_| random.range(-7.0, 7.0)).collect();
        Family { text, longest: lengths.into_iter().fold(0.0, f64::max), drives, loads: loads(&mut random) }
    })
}

fn welded_four_bars(seed: u64, count: usize, poses: usize) -> impl Iterator<Item = Family> {
    with_legs(seed, count, poses, welded)
}

type Text = fn([f64; 3], &mut Random) -> String;

/// A linkage by three dimensions, each with its least and its largest size, and the drive's range.
fn random_linkages(
    seed: u64,
    (count, poses): (usize, usize),
    text: Text,
    dimensions: [(f64, f64); 3],
    (low, high): (f64, f64),
) -> impl Iterator<Item = Family> {
    let mut random = Random(seed);
    (0..count).map(move |_| {
        let lengths = dimensions.map(|(low, high)| length(&mut random, low, high));
        let text = text(lengths, &mut random);
        let drives = (0..poses).map(|_| random.range(low, high)).collect();
        // The third may be an angle.
        Family { text, longest: lengths[0].max(lengths[1]), drives, loads: loads(&mut random) }
    })
}

fn oscillating_blocks(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, oscillating_block, [(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn tangent_mechanisms(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, tangent_mechanism, [(0.3, 2.0), (-0.5, 0.5), (60.0, 120.0)], (-1.0, 1.0))
}

fn scotch_yokes(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, scotch_yoke, [(0.3, 2.0), (-0.5, 0.5), (45.0, 135.0)], (-7.0, 7.0))
}

fn booms(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, boom, [(0.5, 2.0), (0.5, 2.0), (-0.2, 0.2)], (0.5, 3.0))
}

fn shapers(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, shaper, [(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn slotted_cranks(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, slotted_crank, [(0.3, 2.0), (0.5, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn slotted_yokes(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, slotted_yoke, [(0.3, 2.0), (-0.5, 0.5), (45.0, 135.0)], (-7.0, 7.0))
}

fn planets(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, planet, [(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn searches(seed: u64, (count, poses): (u64, usize), class: Class) -> impl Iterator<Item = Family> {
    (0..count).map(move |number| searched(1000 * seed + number, class, poses))
}

#[test]
fn slots() {
    assert!(check(shapers(13, (60, 20)), "levers with slots") > 600);
    assert!(check(slotted_cranks(14, (60, 20)), "links in a crank's slot") > 600);
    assert!(check(slotted_yokes(15, (60, 20)), "yokes with slots") > 1000);
}

#[test]
fn gears() {
    assert!(check(planets(17, (60, 20)), "planets") > 1000);
}

#[test]
fn triads_and_rings() {
    assert!(check(searches(18, (25, 6), Class::Three), "triads") > 100);
    assert!(check(searches(19, (25, 6), Class::ThreeWithSlider), "triads, some with a slider") > 100);
    assert!(check(searches(20, (25, 6), Class::Four), "groups of class IV") > 100);
}

#[test]
#[ignore = "long"]
fn ten_thousand_poses_of_slots() {
    assert!(check(shapers(21, (800, 20)), "levers with slots") > 10_000);
    assert!(check(slotted_cranks(22, (800, 20)), "links in a crank's slot") > 10_000);
    assert!(check(slotted_yokes(23, (520, 20)), "yokes with slots") > 10_000);
}

#[test]
#[ignore = "long"]
fn ten_thousand_poses_of_welded_four_bars() {
    assert!(check(welded_four_bars(24, 900, 20), "welded four-bars") > 10_000);
}

#[test]
#[ignore = "long"]
fn ten_thousand_poses_of_gears() {
    assert!(check(planets(25, (520, 20)), "planets") > 10_000);
}

#[test]
fn oscillating_blocks_and_booms() {
    assert!(check(oscillating_blocks(5, (60, 20)), "oscillating blocks") > 600);
    assert!(check(booms(6, (60, 20)), "booms on cylinders") > 300);
}

/// A rod with a load near its runner, which the drive holds against its tube: the pin at the rod's end is far from the load and has little
/// to hold, so that the moments about that pin are large and those about the runner are not.
#[test]
fn a_load_near_the_runner() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), P: 0.7060748338699341m @ 249.6663629451129deg }} link boom {{ O -> Q: 1.242154836654663m }}
         link tube {{ P: (0, 0), D: (-0.005465666297823191m, 0.02559126541018486m) }}
         link rod {{ Q: (0, 0.14513885974884033m), S: (0, 0), E: (0.02559126541018486m, -0.005465666297823191m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of tube; drive extension: lift; assemble Q: left(P -> O);
         load F: force(tube.D); load H: force(rod.E); {SCENES}"
    );
    let loads =
        vec![[5.931_205_272_674_560_5, 39.466_209_411_621_094], [47.785_552_978_515_625, -16.239_543_914_794_922]];
    let drives = vec![0.829_276_919_364_929_2];
    assert_eq!(
        check([Family { text, longest: 1.242_154_836_654_663, drives, loads }].into_iter(), "a load near the runner"),
        1
    );
}

/// A rocker that is much shorter than the coupler, both given at run time: its direction has the rounding of the coupler's square, and
/// forces are resolved along it as it is.
#[test]
fn a_short_rocker_of_a_length_at_run_time() {
    let text = format!(
        "pub mod sample; param a: length = 1.249727487564087m; param b: length = 1.954880714416504m;
         param c: length = 0.11675041913986206m; ground {{ A0: (0, 0), B0: 0.69857257604599m @ 78.69589187392927deg }}
         link crank {{ A0 -> A: a }} link coupler {{ A -> B: b, C: (-0.38753795623779297m, 0.6836923956871033m) }}
         link rocker {{ B0 -> B: c, D: (0.6836923956871033m, -0.38753795623779297m) }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0);
         load F: force(coupler.C); load H: force(rocker.D); {SCENES}"
    );
    let mut drives: Vec<f64> = (0..200).map(|step| -1.95 + 0.01 * f64::from(step)).collect();
    drives.push(-1.944_602_966_308_593_8);
    let loads =
        vec![[8.933_723_449_707_031, 5.120_211_601_257_324], [-3.722_068_071_365_356_4, -0.976_963_639_259_338_4]];
    let family = Family { text, longest: 1.954_880_714_416_504, drives, loads };
    assert!(check(std::iter::once(family), "a short rocker") > 10);
}

/// A rod whose pin is off the cylinder's line: loads on it are resolved along the way between the pins and turned back, and would have the
/// rounding of its length twice.
#[test]
fn a_pin_off_the_line_of_a_cylinder() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), P: 1.975488543510437m @ 220.65445876240142deg }}
         link boom {{ O -> Q: 1.2599191665649414m }} link tube {{ P: (0, 0), D: (0.7978586554527283m, -0.44195276498794556m) }}
         link rod {{ Q: (0, -0.09467635303735733m), S: (0, 0), E: (-0.44195276498794556m, 0.7978586554527283m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of tube; drive extension: lift; assemble Q: right(P -> O);
         load F: force(tube.D); load H: force(rod.E); {SCENES}"
    );
    let loads =
        vec![[-23.844_227_012_538_134, -24.884_737_866_372_355], [-45.271_337_230_606_534, 48.137_081_526_380_77]];
    let family = Family { text, longest: 1.975_488_543_510_437, drives: vec![2.216_225_981_559_167], loads };
    assert_eq!(check(std::iter::once(family), "a pin off the line of a cylinder"), 1);
}

/// A boom whose cylinder is pinned next to its own pin: legs of nearly one length, which must differ by the way between the pins and by
/// nothing that rounding adds to either.
#[test]
fn pins_close_to_each_other() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), P: 0.00846228376030922m @ 208.03794673546273deg }}
         link boom {{ O -> Q: 1.571088194847107m, T: (0.3m, -0.2m) }} link tube {{ P: (0, 0), D: (0.2m, 0.3m) }}
         link rod {{ Q: (0, 0.006199629977345467m), S: (0, 0), E: (0.3m, 0.2m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of tube; drive extension: lift; assemble Q: right(P -> O);
         load F: force(boom.T); load H: force(rod.E); {SCENES}"
    );
    let drives = (0..40).map(|step| 1.563 + 0.000_4 * f64::from(step)).collect();
    let loads = vec![[5.0, 39.0], [47.0, -16.0]];
    let family = Family { text, longest: 1.571_088_194_847_107, drives, loads };
    assert!(check(std::iter::once(family), "pins close to each other") > 30);
}

/// A block that is loaded where it slides on a lever, across the lever's line: next to nothing is left for its own guide, far away, which must
/// get the moment of that and not of what rounding leaves of two forces that cancel.
#[test]
fn a_guide_that_is_left_with_little() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), B: (-0.29m, 0.113m) }} link crank {{ O: (0, 0), A: (0.5m, 0) }} link lever {{ B: (0, 0) }}
         link block {{ P: (0, 0), G: (2.2m, 0.4m) }} revolute O: ground -> crank; revolute B: ground -> lever; drive q: O;
         prismatic outer: crank.A -> block.G along 20deg of crank; prismatic inner: lever.B -> block.P along 10deg of lever, angle 70deg;
         load F: force(block.P); {SCENES}"
    );
    // At zero the lever's line is at −60°, and the load across it.
    let drives = (-20..=20).map(|step| 0.000_7 * f64::from(step)).collect();
    let family = Family { text, longest: 2.3, drives, loads: vec![[34.64, 20.0]] };
    assert!(check(std::iter::once(family), "a guide that is left with little") == 41);
}

/// A lever whose load goes nearly through its pin swings a rod on a crank's end: the couple between them holds the rod alone, and must not have
/// the rounding of the lever's moments.
#[test]
fn a_couple_that_is_small_beside_one_links_moments() {
    let text = format!(
        "pub mod sample; ground {{ A0: (0, 0), P: (-1.3m, -0.04m) }} link crank {{ A0 -> A: 1.1m }} link rod {{ A: (0, 0), S: (0.012m, -0.0002m) }}
         link lever {{ P: (0, 0), S: (-0.73m, 0.98m), C: (1.1m, -1.6m) }}
         revolute A0: ground -> crank; revolute A: rod -> crank; revolute P: ground -> lever;
         prismatic S: lever -> rod along -2.28rad of rod, angle 5.21rad; drive theta: A0; assemble S: ahead(P);
         unknown T: torque(ground -> crank); load F: force(lever.C); {SCENES}"
    );
    let linkage = compile(&text);
    let families = (-20..=20).filter_map(|step| {
        let drives = vec![0.1 * f64::from(step)];
        let torque = |loads| {
            let arguments = Arguments { drives: drives.clone(), loads: vec![loads], ..Arguments::default() };
            Some(scene::<Double>(&linkage, "work", &arguments).ok()?["T"].0)
        };
        // Across the lever, as the load's point moves.
        let across = [torque([1.0, 0.0])?, torque([0.0, 1.0])?];
        let [x, y] = across.map(|part| part / across[0].hypot(across[1]));
        let load = [50.0 * y + 0.005 * x, 0.005 * y - 50.0 * x];
        Some(Family { text: text.clone(), longest: 1.5, drives, loads: vec![load] })
    });
    assert!(check(families, "a couple that is small beside one link's moments") > 20);
}

/// A coupler of two welded links with a load on each, at regular poses and next to a dead centre whose loads it can bear: what the weld
/// passes on must not have what rounding leaves of the coupler's direction, times all loads.
#[test]
fn loads_on_both_of_two_welded_links() {
    let text = format!(
        "pub mod sample; ground {{ A0: (0, 0), B0: 0.8399186730384827m @ 17.62735888549749deg }} link crank {{ A0 -> A: 1.2485665082931519m }}
         link near {{ A: (0, 0), W: (0.5m, 0.4930090010166168m), C: (0.6039071679115295m, 0.8200094103813171m) }}
         link tip {{ W: (0, 0), B: (1.009055495262146m, 0), D: (0.8200094103813171m, 0.6039071679115295m) }}
         link rocker {{ B0 -> B: 0.30413731932640076m }} revolute A0: ground -> crank; revolute A: crank -> near;
         weld W: near -> tip, angle 24.333217853883184deg; revolute B: tip -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0);
         load F: force(near.C); load H: force(tip.D); {SCENES}"
    );
    let drives = [-1.092_362_066_322_277].into_iter().chain((0..40).map(|step| -1.1 - 0.002 * f64::from(step)));
    let loads =
        vec![[24.319_082_615_261_35, -30.636_504_961_403_112], [-18.936_640_763_220_055, 37.949_740_083_825_354]];
    let family = Family { text, longest: 1.248_566_508_293_151_9, drives: drives.collect(), loads };
    assert!(check(std::iter::once(family), "loads on both of two welded links") > 35);
}

/// A coupler that is loaded at its pin on the rocker, nearly along this: a small force is left for its pin on the crank, and the load's point
/// moves as slowly as the rocker's end. Neither must have the rounding of the load or of the crank's motion.
#[test]
fn a_load_at_the_slow_end_of_a_coupler() {
    let text = format!(
        "pub mod sample; ground {{ A0: (0, 0), B0: (1.9m, -0.3m) }} link crank {{ A0 -> A: 2.3m }} link coupler {{ A -> B: 2.5m, C: (1.1m, 0.4m) }}
         link rocker {{ B0 -> B: 4.6m }} revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker;
         revolute B0: ground -> rocker; drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0);
         load F: force(coupler.B); load H: force(coupler.C); {SCENES}"
    );
    let linkage = compile(&text);
    let kept = |name: &str| linkage.plan.pose.iter().find(|kept| kept.name == name).expect("what the pose keeps").node;
    let rocker = ["rocker_cos", "rocker_sin"].map(kept);
    let families = (-60..60).filter_map(|step| {
        let drives = vec![0.05 * f64::from(step)];
        let arguments = Arguments { drives: drives.clone(), ..Arguments::default() };
        let pose = pose::<Double>(&linkage, &arguments).ok()?;
        let [x, y] = rocker.map(|part| pose[&part].0);
        let load = |along: f64, across: f64| [along * x - across * y, along * y + across * x];
        Some(Family { text: text.clone(), longest: 4.6, drives, loads: vec![load(1e9, 0.5), load(0.3, 0.2)] })
    });
    assert!(check(families, "a load at the slow end of a coupler") > 60);
}

/// Booms whose cylinder stands across its own line. As long as the boom and pinned beside it, it folds there, where the product of its line
/// and the boom cancels. With next to no boom, the rod's runner is always beside the tube's pin: loads near it leave the boom nothing to hold.
#[test]
fn booms_on_cylinders_across_their_line() {
    let boom = |ground: &str, length: &str, [x, y]: [&str; 2], carrier: &str, loads: [&str; 2]| {
        format!(
            "ground {{ O: (0, 0), P: {ground} }} link boom {{ O -> Q: {length}, T: ({x}, {y}) }} link tube {{ P: (0, 0), D: ({y}, {x}) }}
             link rod {{ Q: (0, 1.0m), S: (0, 0), E: ({x}, {y}) }} revolute O: ground -> boom; revolute P: ground -> tube;
             revolute Q: rod -> boom; prismatic lift: tube.P -> rod.S along 0deg of {carrier}; drive extension: lift;
             assemble Q: left(P -> O); load F: force({}); load H: force({}); {SCENES}",
            loads[0], loads[1]
        )
    };
    let at = |drive: f64, loads: [[f64; 2]; 2]| Arguments {
        drives: vec![drive],
        loads: loads.to_vec(),
        ..Arguments::default()
    };
    let place = ["-0.1475161463022232m", "0.5233664512634277m"];
    let text = boom("0.0004962522652931511m @ 356.8875783763737deg", "1.0m", place, "tube", ["boom.T", "rod.E"]);
    let arguments = at(
        3.792_831_687_767_717_4e-6,
        [[23.580_092_026_642_717, -27.447_251_959_911_39], [31.886_136_656_318_314, 3.753_398_895_819_636]],
    );
    let linkage = compile(&format!("pub mod sample; {text}"));
    let found = measure::<Double>(&linkage, &arguments, 1.0, f64::EPSILON).expect("a regular pose");
    found.assert_within(&BARS, "a cylinder that folds with its boom");

    let place = ["-0.031915515661239624m", "0.06209813058376312m"];
    let text = boom("1.0m @ 156.64503892784322deg", "6.568870389855874e-7m", place, "rod", ["tube.D", "rod.E"]);
    let arguments = at(
        2.682_083_622_972_637_3e-8,
        [[40.933_152_224_055_83, 35.889_287_944_278_55], [-49.045_626_658_443_97, -16.137_964_635_694_36]],
    );
    let linkage = compile(&format!("pub mod sample; scalar f32; {text}"));
    let found = measure::<Single>(&linkage, &arguments, 1.0, f64::from(f32::EPSILON)).expect("a regular pose");
    found.assert_within(&BARS, "a cylinder with next to no boom");
}

/// A boom of a few millimetres whose load acts two hundred times as far out, beside a cylinder of a metre: its direction has the cylinder's
/// rounding, and the forces must balance along the directions as they are.
#[test]
fn a_load_far_out_on_a_short_boom() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), P: 1.0149632692337036m @ 228.115577201663deg }}
         link boom {{ O -> Q: 0.0032332944683730602m, T: (-0.3123747706413269m, -0.5961052775382996m) }} link tube {{ P: (0, 0) }}
         link rod {{ Q: (0, -0.036544423550367355m), S: (0, 0), E: (-0.3123747706413269m, -0.5961052775382996m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of rod; drive extension: lift; assemble Q: right(P -> O);
         load F: force(boom.T); load H: force(rod.E); {SCENES}"
    );
    let drives = (0..30).map(|step| 1.0115 + 0.000_1 * f64::from(step)).collect();
    let loads =
        vec![[29.912_719_681_365_218, 13.124_096_303_869_194], [25.872_027_197_046_833, -44.213_025_641_200_73]];
    let family = Family { text, longest: 1.014_963_269_233_703_6, drives, loads };
    assert!(check(std::iter::once(family), "a load far out on a short boom") > 25);
}

/// A member of a triad on a resting pin, next to a pose where the group loses its hold: its load goes nearly through that pin, and must not have
/// the rounding of velocities within the group, which are thousands of times as large as its own.
#[test]
fn a_load_on_a_slow_member_of_a_triad() {
    let text = format!(
        "pub mod sample; ground {{ J1: (-1.0845708847045898m, -1.3419924974441528m), J4: (2.0549514293670654m, -0.7982017397880554m),
         J5: (1.8579635620117188m, 2.3185179233551025m) }}
         link l2 {{ J1: (0, 0), J3: (-1.5593979358673096m, 2.0865886211395264m), p13: (-3.7673425674438477m, 1.2896945476531982m) }}
         link l9 {{ J6 -> J7: 1.7518683671951294m, J8: (2.4517037868499756m, 0.9389231204986572m) }}
         link l10 {{ J3 -> J6: 1.5364713668823242m }} link l12 {{ J5 -> J8: 0.8511312007904053m }}
         link l11 {{ J4 -> J7: 1.617149829864502m, p14: (1.5024943351745605m, 0.12497469782829285m) }}
         revolute J1: l2 -> ground; revolute J3: l2 -> l10; revolute J6: l9 -> l10; revolute J4: l11 -> ground; revolute J7: l11 -> l9;
         revolute J5: l12 -> ground; revolute J8: l12 -> l9;
         start l10: (1.4882261753082275m, -1.1793633699417114m), angle 2.754526138305664rad;
         start l11: (2.034505605697632m, -0.8033512830734253m), angle 1.9939144849777222rad;
         start l12: (1.8490991592407227m, 2.355830192565918m), angle -2.4992165565490723rad;
         start l9: (0.06723402440547943m, -0.623344361782074m), angle 0.8141549825668335rad;
         load Lp13: force(l2.p13); load Lp14: force(l11.p14); drive q0: J1; start q0: 2.1519646644592285rad; {SCENES}"
    );
    let drives = (-10..=10).map(|step| single(1.471_487_297_870_484_3 + 0.000_1 * f64::from(step))).collect();
    let loads = vec![[-30.401_933_415_105_5, 1.353_407_014_477_996_4], [-7.561_746_851_432_48, 8.011_910_913_908_45]];
    let family = Family { text, longest: 4.0, drives, loads };
    assert!(check(std::iter::once(family), "a load on a slow member of a triad") > 5);
}

/// The poses that the page says are beyond a bar: by no more than it says, and they keep the other bars.
#[test]
fn triads_on_a_crank_of_millimetres() {
    let text = format!(
        "pub mod sample; ground {{ J1: (-0.6655423045158386m, -0.3496416211128235m), J4: (-0.6785668730735779m, -0.3496301770210266m),
         J5: (0.7875091433525085m, -0.2575482726097107m) }}
         link l2 {{ J1: (0, 0), J3: (-0.003436887636780739m, 0.0027365051209926605m) }}
         link l9 {{ J6 -> J7: 1.8115129470825195m, J8: (-1.816433072090149m, 1.8614903688430786m), p14: (-1.6967494487762451m, 0.52959805727005m) }}
         link l10 {{ J3 -> J6: 1.467642903327942m, p13: (1.4529074430465698m, 0.0026859119534492493m) }}
         link l11 {{ J4 -> J7: 0.8727315068244934m }} link l12 {{ J5 -> J8: 2.5992214679718018m }}
         revolute J1: ground -> l2; revolute J3: l10 -> l2; revolute J6: l10 -> l9; revolute J4: l11 -> ground; revolute J7: l9 -> l11;
         revolute J5: l12 -> ground; revolute J8: l9 -> l12;
         start l10: (-0.6697795987129211m, -0.3497580885887146m), angle 0.06621871143579483rad;
         start l11: (-0.6781930923461914m, -0.3497658669948578m), angle 1.7684260606765747rad;
         start l12: (0.7877975106239319m, -0.25773629546165466m), angle -1.2272173166275024rad;
         start l9: (0.7943307757377625m, -0.2534019351005554m), angle 2.709007501602173rad;
         load Lp13: force(l10.p13); load Lp14: force(l9.p14); drive q0: J1; start q0: 0.7851831912994385rad; {SCENES}"
    );
    let linkage = compile(&text);
    let loads = vec![[-5.723_937_015_652_027, 37.990_243_346_193], [-20.576_402_351_749_167, 27.539_582_770_619_887]];
    let measures = (-10..=10).map(|step| {
        let drives = vec![single(0.735_183_210_118_815_9 + 0.000_1 * f64::from(step))];
        let arguments = Arguments { drives, loads: loads.clone(), ..Arguments::default() };
        measure::<Double>(&linkage, &arguments, 2.6, f64::EPSILON).expect("a regular pose")
    });
    let worst = measures.fold(Measures::default(), Measures::worst);
    assert!(worst.torque > BARS.torque && worst.torque <= 12.0, "{worst:?}");
    Measures { torque: 0.0, ..worst }.assert_within(&BARS, "but for virtual work");
}

/// A parallelogram that a leg at one of its pins drives, next to its fold: two legs hold each other with 10⁷ times the loads, the third carries
/// no more than it did.
#[test]
fn a_leg_that_drives_a_folding_loop() {
    let text = format!(
        "pub mod sample; ground {{ O: (0.27m, -0.28m), F: (0.5m, 0), G: (1.5m, 0) }} link crank {{ O -> A: 0.7m }} link b {{ A -> P: 0.76m }}
         link t {{ Q -> R: 1m, P: (0, 0), T: (0, -0.5m) }} link c {{ F -> Q: 1m, S: (0.25m, 0.5m) }} link d {{ G -> R: 1m }}
         revolute O: ground -> crank; revolute A: crank -> b; revolute P: b -> t; revolute F: ground -> c; revolute Q: c -> t;
         revolute G: ground -> d; revolute R: d -> t; drive q: O; start q: 0.974rad;
         start b: (0.66m, 0.3m), angle 0.152rad; start t: (1.41m, 0.413m), angle 0; start c: (0.5m, 0), angle 0.426rad;
         start d: (1.5m, 0), angle 0.426rad; load L: force(t.T); load H: force(c.S); {SCENES}"
    );
    // Where the pins P and Q are at (1.5 m, 0): the angle from O that the crank has with legs of 0.7 m and 0.76 m.
    let (way, crank, leg) = ((1.23f64).hypot(0.28), 0.7f64, 0.76f64);
    let fold = (0.28f64).atan2(1.23) + ((way * way + crank * crank - leg * leg) / (2.0 * way * crank)).acos();
    let distances = (2..=14).map(|half| 10f64.powf(-0.5 * f64::from(half)));
    let drives: Vec<f64> = distances.flat_map(|distance| [fold - distance, fold + distance]).map(single).collect();
    let loads = vec![[18.5, 21.0], [27.5, -11.25]];
    // Their sizes, at arms of 1 m.
    let size: f64 = loads.iter().map(|[x, y]: &[f64; 2]| x.hypot(*y)).sum();
    let agree = |scalar: &str, epsilon: f64, torques: &dyn Fn(&Linkage, &Arguments) -> Option<[f64; 2]>| {
        let linkage = compile(&text.replacen(';', &format!("; scalar {scalar};"), 1));
        let mut poses = 0;
        for drive in &drives {
            let arguments = Arguments { drives: vec![*drive], loads: loads.clone(), ..Arguments::default() };
            let Some([balanced, worked]) = torques(&linkage, &arguments) else { continue };
            let terms = worked.abs() + size;
            let off = (balanced - worked).abs() / (epsilon * terms);
            assert!(off <= 8.0, "{scalar} at {drive}: {balanced}, {worked}, {off} ε of the terms");
            poses += 1;
        }
        assert!(poses > 10);
    };
    agree("f64", f64::EPSILON, &both_torques::<Double>);
    agree("f32", f64::from(f32::EPSILON), &both_torques::<Single>);
}

/// The drive's torque by equilibrium and by virtual work.
fn both_torques<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Option<[f64; 2]> {
    let torque = |name| Some(scene::<T>(linkage, name, arguments).ok()?["effort_q"].to_f64());
    Some([torque("all")?, torque("work")?])
}

/// A leg with a load next to the crank, whose other pin moves much faster: its turning takes that velocity away again.
#[test]
fn a_load_near_a_pin_that_hardly_moves() {
    let text = format!(
        "pub mod sample; ground {{ O: (0.931m, 1.603m), G: (1.595m, 0.905m) }}
         link crank {{ O: (0, 0), A: (-0.0052m, 0.0039m), C: (-0.912m, -1.118m), T: (0.0005m, 0.0073m) }}
         link t {{ Q -> R: 2.28m, V: (1.502m, -0.996m) }} link b {{ A -> Q: 1.491m, S: (0.0158m, 0.0035m) }}
         link c {{ G -> R: 2.363m }} link d {{ C -> V: 1.038m }}
         revolute O: ground -> crank; revolute A: b -> crank; revolute Q: b -> t; revolute G: ground -> c; revolute R: c -> t;
         revolute C: d -> crank; revolute V: d -> t; drive q: O; start q: -0.2875rad;
         start b: (0.925m, 1.605m), angle -0.551rad; start c: (1.595m, 0.905m), angle -1.437rad; start d: (0.374m, 0.272m), angle -0.9rad;
         start t: (2.195m, 0.824m), angle -1.697rad; load L: force(b.S); load H: force(crank.T); {SCENES}"
    );
    let drives = (-20..=20).map(|step| -0.2875 + 0.025 * f64::from(step)).collect();
    let family = Family { text, longest: 2.4, drives, loads: vec![[-11.8, -23.9], [30.1, 34.6]] };
    assert!(check(std::iter::once(family), "a load near a pin that hardly moves") > 30);
}

#[test]
fn sliders_on_sliders() {
    assert!(check(tangent_mechanisms(7, (60, 20)), "tangent mechanisms") > 1000);
    assert!(check(scotch_yokes(8, (60, 20)), "Scotch yokes") > 1000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_oscillating_blocks() {
    assert!(check(oscillating_blocks(9, (3500, 40)), "oscillating blocks") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_booms() {
    assert!(check(booms(10, (3600, 40)), "booms on cylinders") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_tangent_mechanisms() {
    assert!(check(tangent_mechanisms(11, (2600, 40)), "tangent mechanisms") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_scotch_yokes() {
    assert!(check(scotch_yokes(12, (2600, 40)), "Scotch yokes") > 100_000);
}

/// The same linkages with the lengths of their links given at run time.
fn with_parameters(families: impl Iterator<Item = Family>) -> impl Iterator<Item = Family> {
    families.map(|family| {
        let text = crate::support::families::with_parameters(&family.text);
        assert!(text.matches("param ").count() > 1, "{text}");
        Family { text, ..family }
    })
}

#[test]
fn lengths_at_run_time() {
    assert!(check(with_parameters(random_four_bars(31, 60, 20)), "four-bars with parameters") > 600);
    assert!(check(with_parameters(random_slider_cranks(32, 40, 20)), "slider-cranks with parameters") > 400);
    assert!(check(with_parameters(fused(random_four_bars(33, 60, 20))), "fused four-bars with parameters") > 600);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_poses_with_lengths_at_run_time() {
    assert!(check(with_parameters(random_four_bars(34, 5_000, 40)), "four-bars with parameters") > 100_000);
    assert!(check(with_parameters(random_slider_cranks(35, 3_000, 40)), "slider-cranks with parameters") > 100_000);
}

/// The same linkages with products that are added without being rounded.
fn fused(families: impl Iterator<Item = Family>) -> impl Iterator<Item = Family> {
    families.map(|family| {
        let text = family.text.replacen("pub mod sample;", "pub mod sample; arithmetic fused;", 1);
        assert!(text.contains("arithmetic fused;"));
        Family { text, ..family }
    })
}

#[test]
fn fused_arithmetic() {
    assert!(check(fused(random_four_bars(9, 50, 20)), "fused four-bars") > 500);
    assert!(check(fused(random_slider_cranks(10, 30, 20)), "fused slider-cranks") > 300);
    assert!(check(fused(oscillating_blocks(11, (30, 20))), "fused oscillating blocks") > 300);
    assert!(check(fused(tangent_mechanisms(12, (30, 20))), "fused tangent mechanisms") > 300);
    assert!(check(fused(scotch_yokes(13, (30, 20))), "fused Scotch yokes") > 500);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_fused_four_bars() {
    assert!(check(fused(random_four_bars(14, 5_000, 40)), "fused four-bars") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_fused_slider_cranks() {
    assert!(check(fused(random_slider_cranks(15, 3_000, 40)), "fused slider-cranks") > 100_000);
}

#[test]
fn four_bars() {
    assert!(check(random_four_bars(1, 100, 20), "four-bars") > 1000);
}

#[test]
fn slider_cranks() {
    assert!(check(random_slider_cranks(2, 100, 20), "slider-cranks") > 1000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_four_bars() {
    assert!(check(random_four_bars(3, 5000, 40), "four-bars") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_slider_cranks() {
    assert!(check(random_slider_cranks(4, 3000, 40), "slider-cranks") > 100_000);
}

/// Four-bars that fold with their cranks, by constants of which one may be much longer than the other one, and by a length of two links
/// that is given at run time: next to the fold the forces lose no digits to its distance.
#[test]
fn next_to_a_fold_whatever_the_lengths() {
    let kite = |params: &str, leg: &str| {
        format!(
            "pub mod sample; {params} ground {{ A0: (0, 0), B0: 1.1m @ 30deg }} link crank {{ A0 -> A: 1.1m }}
             link coupler {{ A -> B: {leg}, C: (0.3m, 0.2m) }} link rocker {{ B0 -> B: {leg}, D: (0.4m, 0.1m) }}"
        )
    };
    let galloway = |params: &str, short: &str| {
        format!(
            "pub mod sample; {params} ground {{ A0: (0, 0), B0: 1.1m @ 30deg }} link crank {{ A0 -> A: {short} }}
             link coupler {{ A -> B: {short}, C: (0.3m, 0.2m) }} link rocker {{ B0 -> B: 1.1m, D: (0.4m, 0.1m) }}"
        )
    };
    let parallelogram = |params: &str, short: &str, long: &str| {
        format!(
            "pub mod sample; {params} ground {{ A0: (0, 0), B0: {long} @ 30deg }} link crank {{ A0 -> A: {short} }}
             link coupler {{ A -> B: {long}, C: (0.3m, 0.2m) }} link rocker {{ B0 -> B: {short}, D: (0.4m, 0.1m) }}"
        )
    };
    // The ground's side is a component that is the length of another link, and so cannot be negative.
    let on_the_axis = |crank: &str, coupler: &str, rocker: &str| {
        format!(
            "pub mod sample; param r: length = 1.1m; param q: length = 0.4m; ground {{ A0: (0, 0), B0: (r, 0) }}
             link crank {{ A0 -> A: {crank} }} link coupler {{ A -> B: {coupler}, C: (0.3m, 0.2m) }}
             link rocker {{ B0 -> B: {rocker}, D: (0.4m, 0.1m) }}"
        )
    };
    let at_30_degrees = [
        kite("", "0.7m"),
        kite("param r: length = 0.7m;", "r"),
        galloway("", "0.4m"),
        galloway("", "0.05m"),
        galloway("param r: length = 0.4m;", "r"),
        galloway("param r: length = 0.05m;", "r"),
        parallelogram("", "0.25m", "1m"),
        parallelogram("", "0.0625m", "2m"),
        parallelogram("param r: length = 0.25m;", "r", "1m"),
        parallelogram("param r: length = 0.0625m;", "r", "2m"),
    ];
    let at_zero = [on_the_axis("q", "r", "q"), on_the_axis("q", "q", "r"), on_the_axis("r", "0.7m", "0.7m")];
    let cases = at_30_degrees.map(|case| (case, 30f64)).into_iter().chain(at_zero.map(|case| (case, 0.0)));
    for (case, fold, smooth) in
        cases.flat_map(|(case, fold)| ["", " smooth at 90deg"].map(|smooth| (case.clone(), fold, smooth)))
    {
        let text = format!(
            "{case} revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker;
             revolute B0: ground -> rocker; drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0){smooth};
             load F: force(coupler.C); load H: force(rocker.D); {SCENES}"
        );
        // The same against the ground's line.
        let (sin, cos) = (fold - 30.0).to_radians().sin_cos();
        let loads = vec![[5.0, 39.0], [47.0, -16.0]];
        let loads: Vec<_> = loads.into_iter().map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]).collect();
        let drives = (0..60).map(|step| 0.05 + 0.1 * f64::from(step)).collect();
        let family = Family { text: text.clone(), longest: 2.0, drives, loads: loads.clone() };
        assert!(check(std::iter::once(family), &text) > 20);
        let linkage = compile(&text);
        for step in 2..13 {
            let drives = vec![fold.to_radians() + 10f64.powi(-step)];
            let arguments =
                Arguments { drives, params: defaults(&linkage), loads: loads.clone(), ..Arguments::default() };
            let found =
                scene::<Double>(&linkage, "all", &arguments).unwrap_or_else(|fault| panic!("{fault:?}\n{text}"));
            let exact =
                scene::<Extended>(&linkage, "all", &arguments).unwrap_or_else(|fault| panic!("{fault:?}\n{text}"));
            let size = exact.values().fold(0.0, |size: f64, value| size.max(value.to_f64().abs()));
            for (name, value) in &exact {
                let error = (found[name].to_f64() - value.to_f64()).abs() / size;
                assert!(error < 5e-15, "{name}: {error:e} at 1e-{step} from the fold\n{text}");
            }
        }
    }
}
