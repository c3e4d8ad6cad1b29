//! The bound of the rounding errors: never too small, and as a median within a hundred times the error, for every kind of dyad, for groups
//! that are placed by iteration, and where several follow each other.

use crate::support::bounds::{LOOSEST, median, ratios, ratios_of, with_bounds};
use crate::support::families::{
    boom, four_bar, length, oscillating_block, scotch_yoke, slider_crank, tangent_mechanism,
};
use crate::support::linkages::{Class, Kind, Layout, Random, sample, sample_with_forces, sample_with_search};
use crate::support::numbers::{Double, Single};
use crate::support::{Arguments, Number, compile, from_pose, index_of, pose, scene};
use linkage_codegen::Linkage;
use linkage_codegen::program::Fault;

/// The ratios of a scene from the drives and from a pose.
fn check<T: Number>(linkage: &Linkage, arguments: &Arguments, context: &str) -> Vec<f64> {
    let found = match scene::<T>(linkage, "bounded", arguments) {
        Ok(found) => found,
        Err(Fault::Failed(_)) => return Vec::new(),
        Err(Fault::NotFinite) => panic!("not finite\n{context}"),
    };
    let mut all = ratios(linkage, arguments, &found, context);
    let index = index_of(linkage, "bounded");
    let program = &linkage.functions.scenes[index].from_pose;
    let pose = pose::<T>(linkage, arguments).expect("a pose");
    let values = from_pose(linkage, program, &pose, arguments).expect("from the pose as from the drives");
    let found = program.outputs.iter().map(|(path, _)| path.clone()).zip(values).collect();
    all.extend(ratios(linkage, arguments, &found, context));
    all
}

/// What is given counts as exact: numbers that single precision holds.
#[allow(clippy::cast_possible_truncation, reason = "that is the point")]
fn in_single_precision(arguments: &Arguments) -> Arguments {
    let round = |x: &f64| f64::from(*x as f32);
    Arguments {
        drives: arguments.drives.iter().map(round).collect(),
        loads: arguments.loads.iter().map(|load| load.map(|x| round(&x))).collect(),
        params: arguments.params.iter().map(round).collect(),
        ..arguments.clone()
    }
}

fn random_linkages(seeds: core::ops::Range<u64>, scalar: &'static str) {
    let mut all = Vec::new();
    for seed in seeds {
        let kind = Kind {
            dyads: 1 + usize::try_from(seed % 3).unwrap(),
            sliders: true,
            joints: seed % 2 == 0,
            unknown_anywhere: false,
            params: seed % 5 == 0,
            moving: false,
            scalar,
        };
        let sample = sample(seed, kind);
        let Some(linkage) = with_bounds(&sample.text) else { continue };
        all.extend(match scalar {
            "f32" => check::<Single>(&linkage, &in_single_precision(&sample.arguments), &sample.text),
            _ => check::<Double>(&linkage, &sample.arguments, &sample.text),
        });
    }
    expect_tight(scalar, all);
}

/// Bounds are near errors, as a median.
fn expect_tight(name: &str, mut ratios: Vec<f64>) {
    let count = ratios.len();
    let median = median(&mut ratios).expect("results");
    println!("{name}: {count} results, median of bound over error {median:.1}");
    assert!(count > 100 && median < LOOSEST, "{name}: {count} results, median {median:.1}");
}

#[test]
fn of_random_linkages() {
    random_linkages(0..30, "f64");
    random_linkages(30..45, "f32");
}

#[test]
#[ignore = "long"]
fn of_thousands_of_random_linkages() {
    random_linkages(1000..4000, "f64");
    random_linkages(4000..5000, "f32");
}

/// Poses all around, dead centres among them, of every kind of dyad.
fn around(seed: u64, count: usize, poses: usize) {
    type Text = fn(&mut Random) -> String;
    let kinds: [(&str, Text); 6] = [
        ("four-bars", |random| four_bar([0; 4].map(|_| length(random, 0.1, 2.0)), random)),
        ("slider-cranks", |random| {
            slider_crank([length(random, 0.1, 1.0), length(random, 0.3, 3.0), length(random, -0.5, 0.5)], random)
        }),
        ("oscillating blocks", |random| {
            oscillating_block([length(random, 0.3, 2.0), length(random, 0.1, 2.0), length(random, -0.5, 0.5)], random)
        }),
        ("tangent mechanisms", |random| {
            tangent_mechanism(
                [length(random, 0.3, 2.0), length(random, -0.5, 0.5), length(random, 60.0, 120.0)],
                random,
            )
        }),
        ("Scotch yokes", |random| {
            scotch_yoke([length(random, 0.3, 2.0), length(random, -0.5, 0.5), length(random, 45.0, 135.0)], random)
        }),
        ("booms", |random| {
            boom([length(random, 0.5, 2.0), length(random, 0.5, 2.0), length(random, -0.2, 0.2)], random)
        }),
    ];
    for (name, text) in kinds {
        let mut random = Random(seed);
        let mut all = Vec::new();
        for _ in 0..count {
            let text = text(&mut random);
            let Some(linkage) = with_bounds(&text) else { continue };
            for _ in 0..poses {
                let range = if name == "booms" { 0.5..3.0 } else { -1.2..1.2 };
                let drives = vec![random.range(range.start, range.end)];
                let loads = vec![[random.range(-50.0, 50.0), random.range(-50.0, 50.0)]; 2];
                all.extend(check::<Double>(&linkage, &Arguments { drives, loads, ..Arguments::default() }, &text));
            }
        }
        expect_tight(name, all);
    }
}

/// Groups that are placed by iteration, by themselves.
fn iterated(seeds: core::ops::Range<u64>, poses: usize) {
    for (name, class) in
        [("triads", Class::Three), ("triads with sliders", Class::ThreeWithSlider), ("class IV", Class::Four)]
    {
        let (mut random, mut all) = (Random(seeds.start), Vec::new());
        for seed in seeds.clone() {
            let sample = sample_with_forces(seed, class, Layout::Anywhere);
            let Some(linkage) = with_bounds(&sample.text) else { continue };
            for _ in 0..poses {
                let mut arguments = sample.arguments.clone();
                arguments.drives[0] += random.range(-0.3, 0.3);
                all.extend(check::<Double>(&linkage, &arguments, &sample.text));
            }
        }
        expect_tight(name, all);
    }
}

/// Groups of any joints, among others and after them, with parameters and unknowns anywhere.
fn iterated_among_others(seeds: core::ops::Range<u64>, poses: usize, scalar: &'static str) {
    let (mut random, mut all) = (Random(seeds.start), Vec::new());
    for seed in seeds {
        let kind = Kind {
            dyads: usize::try_from(seed % 3).unwrap(),
            sliders: seed % 2 == 1,
            joints: seed % 4 < 2,
            unknown_anywhere: seed % 5 == 0,
            params: seed % 7 == 0,
            moving: false,
            scalar,
        };
        let sample = sample_with_search(seed, kind);
        // Not every unknown can balance a load.
        if kind.unknown_anywhere && linkage_codegen::analyse(sample.text.parse().expect("tokens")).is_err() {
            continue;
        }
        let Some(linkage) = with_bounds(&sample.text) else { continue };
        for pose in 0..poses {
            let mut arguments = sample.arguments.clone();
            if pose > 0 {
                arguments.drives[0] += random.range(-0.1, 0.1);
            }
            all.extend(match scalar {
                "f32" => check::<Single>(&linkage, &in_single_precision(&arguments), &sample.text),
                _ => check::<Double>(&linkage, &arguments, &sample.text),
            });
        }
    }
    expect_tight(&format!("among others, {scalar}"), all);
}

#[test]
fn of_groups_placed_by_iteration() {
    iterated(0..6, 5);
    iterated_among_others(0..15, 2, "f64");
    iterated_among_others(15..25, 2, "f32");
}

#[test]
#[ignore = "long"]
fn of_many_groups_placed_by_iteration() {
    iterated(1000..1200, 10);
    iterated_among_others(1000..1500, 4, "f64");
    iterated_among_others(1500..1800, 4, "f32");
}

#[test]
fn of_every_kind_of_dyad() {
    around(5, 12, 10);
}

#[test]
#[ignore = "long"]
fn of_many_of_every_kind_of_dyad() {
    around(6, 300, 40);
}

/// It has a dead centre at half a turn.
const FOUR_BAR: &str = "pub mod sample; ground { A0: (0, 0), B0: (1.5m, 0) } link crank { A0 -> A: 0.5m }
         link coupler { A -> B: 1m, C: (0.25m, 0.125m) } link rocker { B0 -> B: 1m, D: (0.5m, -0.25m) }
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0);
         load F: force(coupler.C); load H: force(rocker.D);";

/// Towards the toggle position errors grow without limit, and the bound with them.
#[test]
fn near_dead_centres() {
    let linkage = with_bounds(FOUR_BAR).expect("closes");
    let mut before = 0.0;
    for exponent in 1..=7 {
        let drives = vec![core::f64::consts::PI - 10f64.powi(-exponent)];
        let arguments = Arguments { drives, loads: vec![[10.0, -20.0], [-5.0, 30.0]], ..Arguments::default() };
        let Ok(found) = scene::<Double>(&linkage, "bounded", &arguments) else { continue };
        ratios(&linkage, &arguments, &found, FOUR_BAR);
        let bound = found["error_bound.B.x"].to_f64();
        assert!(bound > before, "{bound:e} at 1e-{exponent}");
        before = bound;
    }
    assert!(before > 0.0);
}

/// A slot and a slide along the axes: their travels are the components of the way itself, with its error.
#[test]
fn unknowns_that_are_parts_of_the_way() {
    let text = "pub mod sample; scalar f64; ground { A0: (0, 0), G: (0.25m, 0.5m) } link crank { A0 -> A: 1m, C: (50mm, 270mm) }
         link yoke { S: (0.5m, 0), G: (0, 0), D: (270mm, 50mm) } slot S: yoke.S -> crank.A along 90deg of yoke;
         prismatic G: yoke -> ground along 0deg; revolute A0: ground -> crank; drive theta: A0; unknown T: torque(ground -> crank);
         load F: force(crank.C); load H: force(yoke.D);";
    let linkage = with_bounds(text).expect("closes");
    let mut all = Vec::new();
    for step in 0..200 {
        let drives = vec![0.031 * f64::from(step) - 3.0];
        let arguments = Arguments { drives, loads: vec![[-9.9, -2.4], [-39.8, -0.7]], ..Arguments::default() };
        all.extend(check::<Double>(&linkage, &arguments, text));
    }
    let loosest = median(&mut all).expect("errors");
    assert!(loosest <= LOOSEST, "{loosest}");
}

/// The bounds of places, velocities, accelerations, of what balances inertia, of coefficients and the equation of motion, at poses around one.
fn of_moving(name: &str, text: &str, around: f64, by: f64) {
    let linkage = compile(text);
    let mut random = Random(77);
    let mut all = Vec::new();
    for _ in 0..40 {
        let drives = vec![around + random.range(-by, by)];
        let motion = vec![[random.range(-20.0, 20.0), random.range(-300.0, 300.0)]];
        let arguments = Arguments { drives, loads: vec![[0.0; 2]], motion, ..Arguments::default() };
        for name in ["place", "v", "a", "f", "w", "g", "m"] {
            all.extend(ratios_of::<Double>(&linkage, name, &arguments, text));
        }
    }
    expect_tight(name, all);
}

#[test]
fn of_motion() {
    of_moving(
        "four-bar that moves",
        "pub mod sample; ground { A0: (0, 0), B0: (1.5m, 0) } link crank { A0 -> A: 0.5m }
         link coupler { A -> B: 1.1m, C: (0.25m, 0.125m) } link rocker { B0 -> B: 1.2m, D: (0.5m, -0.25m) }
         mass coupler: 3kg at C, inertia 0.2kg*m^2; mass rocker: 2kg at D;
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0); load I: inertia;
         scene place: position -> (B, coupler.C, rocker.angle, error_bound); scene v: velocity -> (B, coupler.angle, error_bound);
         scene a: acceleration -> (B, coupler.C, rocker.angle, error_bound); scene f: equilibrium -> (T, B, error_bound);
         scene w: virtual_work -> (T, error_bound); scene m: motion -> (M, h, error_bound);
         scene g: coefficients -> (rocker.angle, coupler.C, error_bound);",
        0.0,
        3.0,
    );
    of_moving(
        "triad that moves",
        "pub mod sample; ground { O: (0, 0), Q: (5m, 1m), P: (4m, -1m) } link crank { O -> A: 1m } link b { A -> E: 1.95m }
         link t { E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m), G: (0.3m, 0.3m) } link c { Q -> C: 1.92m } link d { P -> D: 1.8m }
         mass t: 3kg at G, inertia 0.2kg*m^2; mass d: 2kg at D;
         revolute O: ground -> crank; revolute A: crank -> b; revolute E: t -> b; revolute C: t -> c; revolute D: d -> t;
         revolute Q: ground -> c; revolute P: ground -> d; drive q: O; unknown T: torque(ground -> crank);
         start q: 0.4rad; start b: (1m, 0.4m), angle 36deg; start t: (2.5m, 1.5m), angle 0; start c: (5m, 1m), angle 140deg;
         start d: (4m, -1m), angle 115deg; load I: inertia;
         scene place: position -> (D, t.G, c.angle, error_bound); scene v: velocity -> (D, t.angle, error_bound);
         scene a: acceleration -> (D, t.G, c.angle, error_bound); scene f: equilibrium -> (T, D, error_bound);
         scene w: virtual_work -> (T, error_bound); scene m: motion -> (M, h, error_bound);
         scene g: coefficients -> (c.angle, t.G, error_bound);",
        0.4,
        0.3,
    );
}

/// Three cylinders in a row, each carried by what the one before places, and a four-bar behind them: what one group is off by, all that follow
/// are off by too, and much of that cancels in them.
#[test]
fn of_an_excavator() {
    let linkage = compile(
        "pub mod excavator; units { m, kN } ground { B: (0, 0), C1: (0.4m, -0.3m) }
         link boom { B: (0, 0), A: (5m, 0), J1: (2m, 0.4m), C2: (2.4m, 0.6m) }
         link stick { A: (0, 0), J2: (-0.6m, 0.3m), H: (2.6m, 0), C3: (0.2m, 0.5m), R: (2.2m, 0.05m) }
         link bucket { H: (0, 0), K: (0.1m, 0.35m), tip: (1.2m, -0.3m) } link guide { R -> L: 0.45m } link dog { L -> K: 0.5m }
         link tube1 { C1 -> x: 1m } link rod1 { J1 -> x: 1m } link tube2 { C2 -> x: 1m } link rod2 { J2 -> x: 1m }
         link tube3 { C3 -> x: 1m } link rod3 { L -> x: 1m }
         revolute B: ground -> boom; revolute A: boom -> stick; revolute H: stick -> bucket; revolute R: stick -> guide;
         revolute L: guide -> dog; revolute K: dog -> bucket; revolute C1: ground -> tube1; revolute J1: boom -> rod1;
         revolute C2: boom -> tube2; revolute J2: stick -> rod2; revolute C3: stick -> tube3; revolute T: guide.L -> rod3.L;
         prismatic s1: tube1.C1 -> rod1.J1 along 0deg of tube1; prismatic s2: tube2.C2 -> rod2.J2 along 0deg of tube2;
         prismatic s3: tube3.C3 -> rod3.L along 0deg of tube3; drive x1: s1; drive x2: s2; drive x3: s3;
         assemble J1: left(C1 -> B); assemble J2: left(C2 -> A); assemble T: left(C3 -> R); assemble K: left(L -> H);
         mass boom: 1500kg at (2.4m, 0.3m), inertia 3000kg*m^2; mass stick: 700kg at (1m, 0.1m), inertia 600kg*m^2;
         mass bucket: 500kg at (0.5m, 0), inertia 100kg*m^2; mass tube1: 60kg at (0.5m, 0), inertia 5kg*m^2;
         load dig: force(bucket.tip) in bucket; load W: gravity = (0, -9.81m/s^2); load I: inertia;
         scene place: position -> (stick.angle, bucket.angle, guide.angle, bucket.tip, K, error_bound);
         scene v: velocity -> (stick.angle, bucket.angle, guide.angle, bucket.tip, K, error_bound);
         scene a: acceleration -> (stick.angle, bucket.angle, guide.angle, bucket.tip, K, error_bound);
         scene digging: equilibrium(dig) -> (effort_x1, effort_x2, effort_x3, B, A, H, R, L, K, J1, J2, T, error_bound);
         scene held: equilibrium(dig, W) -> (effort_x1, effort_x2, effort_x3, B, A, H, R, L, K, J1, J2, T, error_bound);
         scene moved: equilibrium(I) -> (effort_x1, effort_x2, effort_x3, B, A, H, R, L, K, J1, J2, T, error_bound);
         scene work: virtual_work(dig, W, I) -> (effort_x1, effort_x2, effort_x3, error_bound);
         scene gains: coefficients -> (stick.angle, bucket.angle, bucket.tip, error_bound); scene m: motion -> (M, h, error_bound);",
    );
    let mut random = Random(77);
    let mut poses = || {
        let drives = vec![random.range(1.76, 2.3), random.range(2.2, 2.86), random.range(1.8, 2.27)];
        let motion = (0..3).map(|_| [random.range(-1.0, 1.0), random.range(-1.0, 1.0)]).collect();
        Arguments { drives, loads: vec![[-30.0, 10.0]], motion, ..Arguments::default() }
    };
    let arguments: Vec<Arguments> = (0..60).map(|_| poses()).collect();
    for name in ["place", "v", "a", "digging", "held", "moved", "work", "gains", "m"] {
        let ratios = arguments.iter().flat_map(|arguments| ratios_of::<Double>(&linkage, name, arguments, name));
        expect_tight(&format!("excavator, {name}"), ratios.collect());
    }
}

/// Where nothing can be said of errors, the bounds are the largest number, from a pose too: a pose is not refused for what it keeps of
/// its errors.
#[test]
fn where_nothing_is_known() {
    let linkage = with_bounds(FOUR_BAR).expect("closes");
    let (mut known, mut unknown) = (0, 0);
    for exponent in 1..=14 {
        let arguments = Arguments {
            drives: vec![core::f64::consts::PI - 10f64.powi(-exponent)],
            loads: vec![[10.0, -20.0], [-5.0, 30.0]],
            ..Arguments::default()
        };
        check::<Double>(&linkage, &arguments, FOUR_BAR);
        let found = scene::<Double>(&linkage, "bounded", &arguments).expect("not yet a dead centre");
        if found["error_bound.T"].to_f64() < f64::MAX { known += 1 } else { unknown += 1 }
    }
    assert!(known >= 6 && unknown > 0, "{known} known, {unknown} not");
}

/// An in-line slider-crank at its angle of zero: every number of its pose is exact, and a bound says so too.
#[test]
fn where_nothing_is_off() {
    let linkage = with_bounds(
        "pub mod sample; ground { A0: (0, 0), C: (0, 0) } link crank { A0 -> A: 0.5m } link coupler { A -> B: 1.5m, P: (0.5m, 0.25m) }
         link piston { B: (0, 0) } revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> piston;
         prismatic C: ground -> piston.B along 0deg; drive theta: A0; unknown T: torque(ground -> crank); assemble B: ahead(A);
         load F: force(coupler.P);",
    );
    let linkage = linkage.expect("it closes");
    let bounds = |theta: f64| -> Vec<f64> {
        let arguments = Arguments { drives: vec![theta], loads: vec![[10.0, -20.0]], ..Arguments::default() };
        check::<Double>(&linkage, &arguments, "at an angle of zero");
        let found = scene::<Double>(&linkage, "bounded", &arguments).expect("a regular pose");
        found.iter().filter(|(path, _)| path.starts_with("error_bound.")).map(|(_, bound)| bound.0).collect()
    };
    assert!(bounds(0.0).into_iter().all(|bound| bound < 1e-13), "{:?}", bounds(0.0));
    assert!(bounds(1e-12).into_iter().all(|bound| bound < 1e-13), "{:?}", bounds(1e-12));
}

/// Forces of wheels that stand still, which constant loads make constants: they are rounded once, whatever their equations are.
#[test]
fn of_constants_that_are_solved_for() {
    for moment in ["1N*m", "2N*m", "3N*m", "0.1N*m", "11.7N*m"] {
        let text = format!(
            "mod planetary; ground {{ C: (150mm, 100mm), D: (300mm, 0) }} link crank {{ D -> T: 50mm }} link wheel {{ C: (0, 0) }}
             link arm {{ C -> P: 80mm }} link planet {{ P }} revolute D: ground -> crank; drive q: D; weld C: wheel -> ground;
             revolute C2: ground.C -> arm.C; revolute P: arm -> planet; gear G1: planet.P -> wheel.C, radii (50mm, 30mm);
             gear G2: ground.C -> planet.P, radii (130mm, 50mm), internal; load M: moment(arm) = {moment};"
        );
        let linkage = with_bounds(&text).expect("it closes");
        let arguments = Arguments { drives: vec![0.3], loads: vec![[0.0; 2]], ..Arguments::default() };
        check::<Double>(&linkage, &arguments, &text);
        let found = scene::<Double>(&linkage, "bounded", &arguments).expect("no pivot vanishes");
        let (bounds, results): (Vec<_>, Vec<_>) = found.iter().partition(|(path, _)| path.starts_with("error_bound."));
        let largest = results.iter().map(|(_, result)| result.0.abs()).fold(0.0, f64::max);
        assert!(bounds.len() == results.len() && largest > 0.0, "{found:?}");
        assert!(bounds.iter().all(|(_, bound)| bound.0 <= 2.0 * f64::EPSILON * largest), "{found:?}");
    }
}
