//! Groups that are placed by Newton's method: how well they close, near which poses they do not, and that they stay on their branch.

use crate::support::general::{Coordinates, residuals_at};
use crate::support::linkages::{Kind, Random, sample_with_search};
use crate::support::measures::from_kept;
use crate::support::numbers::{Double, Extended, Single};
use crate::support::{Arguments, Number, compile, index_of, moved, pose};
use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Failure, Graph, Kernel, NodeValues, Op};
use linkage_codegen::program::{Definition, Fault};

/// The bars, in epsilons of the scalar: closure over the longest link, and the size of directions.
const CLOSURE: f64 = 4.0;
const UNIT: f64 = 3.0;

/// Stephenson III: a ternary link on three legs.
const STEPHENSON: &str = "pub mod sample;
    ground { O: (0, 0), Q: (5m, 1m), P: (4m, -1m) } link crank { O -> A: 1m } link b { A -> E: 1.95m }
    link t { E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m), G: (0.3m, 0.3m) } link c { Q -> C: 1.92m } link d { P -> D: 1.8m }
    revolute O: ground -> crank; revolute A: crank -> b; revolute E: t -> b; revolute C: t -> c; revolute D: d -> t;
    revolute Q: ground -> c; revolute P: ground -> d; drive q: O;
    start q: 0.4rad; start b: (1m, 0.4m), angle 36deg; start t: (2.5m, 1.5m), angle 0; start c: (5m, 1m), angle 140deg;
    start d: (4m, -1m), angle 115deg; load F: force(t.G); scene all: equilibrium; scene work: virtual_work;";

/// The largest constraint residual of a pose, and the largest deviation of a direction from unit size.
fn errors<T: Number>(linkage: &Linkage, arguments: &Arguments, kept: &NodeValues<T>) -> (f64, f64) {
    let exact: NodeValues<Extended> =
        kept.iter().map(|(node, value)| (*node, Extended::exactly(value.to_f64()))).collect();
    let residuals = residuals_at(&Coordinates::at(linkage, arguments, &exact));
    let closure = residuals.iter().fold(0.0f64, |m, r| m.max(r.to_f64().abs()));
    let value = |name: String| linkage.plan.pose.iter().find(|k| k.name == name).map(|k| exact[&k.node].clone());
    let units = linkage.model.moving_links().filter_map(|link| {
        let name = &linkage.model.link(link).name;
        let (c, s) = (value(format!("{name}_cos"))?, value(format!("{name}_sin"))?);
        Some(c.mul(&c).add(&s.mul(&s)).sqrt().sub(&Extended::exactly(1.0)).to_f64().abs())
    });
    (closure, units.fold(0.0, f64::max))
}

fn worst<T: Number>(seeds: core::ops::Range<u64>, scalar: &'static str, epsilon: f64) -> (f64, f64, usize) {
    let mut worst = (0.0f64, 0.0f64, 0);
    for seed in seeds {
        let kind = Kind {
            dyads: 0,
            sliders: seed % 2 == 1,
            joints: false,
            unknown_anywhere: false,
            moving: false,
            params: false,
            scalar,
        };
        let sample = sample_with_search(seed, kind);
        let linkage = compile(&sample.text);
        let mut random = Random(seed);
        for turn in 0..6 {
            let mut arguments = sample.arguments.clone();
            if turn > 0 {
                let drive = T::exactly(arguments.drives[0] + random.range(-0.3, 0.3));
                arguments.drives[0] = drive.to_f64();
            }
            match pose::<T>(&linkage, &arguments) {
                Ok(kept) => {
                    let (closure, unit) = errors(&linkage, &arguments, &kept);
                    let closure = closure / (sample.longest * epsilon);
                    worst = (worst.0.max(closure), worst.1.max(unit / epsilon), worst.2 + 1);
                }
                Err(fault) => {
                    assert!(
                        matches!(fault, Fault::Failed(Failure::NoConvergence { .. })),
                        "{fault:?}\n{}",
                        sample.text
                    );
                }
            }
        }
    }
    worst
}

#[test]
fn loops_close_to_rounding() {
    let (closure, unit, count) = worst::<Double>(0..75, "f64", f64::EPSILON);
    println!("f64: closure {closure:.2} ε, unit {unit:.2} ε, {count} poses of 450");
    let (single_closure, single_unit, single) = worst::<Single>(0..75, "f32", f64::from(f32::EPSILON));
    println!("f32: closure {single_closure:.2} ε, unit {single_unit:.2} ε, {single} poses of 450");
    assert!(closure <= CLOSURE && unit <= UNIT, "f64: {closure} ε, {unit} ε");
    assert!(single_closure <= CLOSURE && single_unit <= UNIT, "f32: {single_closure} ε, {single_unit} ε");
    // From 0.3 rad away 94 of 100 converge.
    assert!(count >= 423 && single >= 423, "{count} and {single} of 450");
}

fn at(q: f64) -> Arguments {
    Arguments { drives: vec![q], loads: vec![[3.0, -2.0]], ..Arguments::default() }
}

#[test]
fn a_sweep_stays_on_its_branch_and_comes_back() {
    let linkage = compile(STEPHENSON);
    let start = pose::<Double>(&linkage, &at(0.4)).expect("the start");
    let mut here = start.clone();
    let mut end = 0.4;
    // As far as it goes, by degrees.
    for step in 1..=720 {
        let q = 0.4 + f64::from(step) * 1f64.to_radians();
        match moved(&linkage, (&here, &at(end)), &at(q)) {
            Ok(next) => {
                let turned = next.iter().map(|(node, value)| (value.0 - here[node].0).abs()).fold(0.0, f64::max);
                assert!(turned < 0.5, "jumps by {turned} at {q}");
                (here, end) = (next, q);
            }
            Err(fault) => {
                assert!(matches!(fault, Fault::Failed(Failure::NoConvergence { .. })), "{fault:?}");
                break;
            }
        }
    }
    println!("from 0.4 to {end}");
    assert!(end > 1.0, "{end}");
    // And back again, to the same place.
    let mut q = end;
    while q > 0.4 {
        let next = (q - 1f64.to_radians()).max(0.4);
        here = moved(&linkage, (&here, &at(q)), &at(next)).expect("the way back");
        q = next;
    }
    for (node, value) in &start {
        assert!((value.0 - here[node].0).abs() < 1e-13, "{} {}", value.0, here[node].0);
    }
}

/// The largest difference of two poses.
fn apart(a: &NodeValues<Double>, b: &NodeValues<Double>) -> f64 {
    a.iter().map(|(node, value)| (value.0 - b[node].0).abs()).fold(0.0, f64::max)
}

/// How far random linkages go, and the same poses by small steps and at once.
fn check_far(seeds: core::ops::Range<u64>) -> [usize; 3] {
    let (mut reached, mut ended, mut timid) = (0, 0, 0);
    for seed in seeds {
        let kind = Kind {
            dyads: 0,
            sliders: seed % 2 == 1,
            joints: false,
            unknown_anywhere: false,
            moving: false,
            params: seed % 3 == 2,
            scalar: "f64",
        };
        let sample = sample_with_search(seed, kind);
        let linkage = compile(&sample.text);
        let with = |q: f64| {
            let mut arguments = sample.arguments.clone();
            arguments.drives[0] = q;
            arguments
        };
        let begin = sample.arguments.drives[0];
        for sense in [1.0, -1.0] {
            // A dense walk.
            let start = pose::<Double>(&linkage, &with(begin));
            let start = start.unwrap_or_else(|fault| panic!("seed {seed}: {fault:?} at the start\n{}", sample.text));
            let (mut here, mut q) = (start, begin);
            let mut ends = false;
            for step in 1..=400 {
                let next = begin + sense * f64::from(step) * 0.01;
                match moved(&linkage, (&here, &with(q)), &with(next)) {
                    Ok(pose) => (here, q) = (pose, next),
                    Err(_) => {
                        ends = true;
                        break;
                    }
                }
                if step % 100 != 0 {
                    continue;
                }
                match pose::<Double>(&linkage, &with(q)) {
                    Ok(at_once) => {
                        let apart = apart(&at_once, &here);
                        assert!(apart < 1e-9, "seed {seed}: another branch at {q}, {apart:e} off\n{}", sample.text);
                        reached += 1;
                    }
                    Err(fault) => {
                        println!("seed {seed}: {fault:?} on the way to {q}");
                        timid += 1;
                    }
                }
            }
            if ends {
                ended += 1;
                // Beyond the limit there is nothing, however far.
                for beyond in [0.011, 0.1, 0.4] {
                    let q = q + sense * beyond;
                    let found = pose::<Double>(&linkage, &with(q));
                    assert!(
                        matches!(found, Err(Fault::Failed(Failure::NoConvergence { .. }))),
                        "seed {seed}: {q} is beyond the limit\n{}",
                        sample.text
                    );
                }
            }
        }
    }
    [reached, ended, timid]
}

#[test]
fn far_from_the_start_it_is_the_branch_of_a_dense_walk() {
    let [reached, ended, timid] = check_far(0..30);
    println!("{reached} poses reached, {timid} given up, {ended} ways end");
    assert!(reached > 30 && ended > 10 && timid == 0, "{reached} {ended} {timid}");
}

#[test]
#[ignore = "long"]
fn far_from_the_start_it_is_the_branch_of_a_dense_walk_for_a_thousand() {
    let [reached, ended, timid] = check_far(1000..2000);
    println!("{reached} poses reached, {timid} given up, {ended} ways end");
    assert!(timid == 0, "{timid}");
}

#[test]
fn near_singular_poses_are_refused_or_close() {
    // The limit of the motion is a pose at which the legs' lines meet in a point; the steps to it are halved.
    let linkage = compile(STEPHENSON);
    let (mut here, mut q) = (pose::<Double>(&linkage, &at(0.4)).expect("the start"), 0.4);
    let mut step = 0.1;
    let mut refused = 0;
    while step > 1e-15 {
        match moved(&linkage, (&here, &at(q)), &at(q + step)) {
            Ok(next) => {
                q += step;
                let (closure, unit) = errors(&linkage, &at(q), &next);
                // Next to the end a search may stop where half an epsilon of the loops' lengths is open; the longest link is 1.95 long.
                assert!(
                    closure <= 2.0 * CLOSURE * f64::EPSILON && unit <= UNIT * f64::EPSILON,
                    "{closure:e} {unit:e} at {q}"
                );
                here = next;
                let scene = from_kept::<Double>(&linkage, "all", &here, &at(q));
                match scene {
                    Ok(values) => assert!(values.values().all(|value| value.0.is_finite())),
                    Err(fault) => assert!(matches!(fault, Fault::Failed(Failure::DeadCentre { .. })), "{fault:?}"),
                }
                if q > 7.0 {
                    break;
                }
            }
            Err(fault) => {
                assert!(matches!(fault, Fault::Failed(Failure::NoConvergence { .. })), "{fault:?}");
                step *= 0.5;
                refused += 1;
            }
        }
    }
    println!("the motion ends at {q}, after {refused} refusals");
    for value in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        assert_eq!(pose::<Double>(&linkage, &at(value)).unwrap_err(), Fault::NotFinite);
        assert_eq!(moved(&linkage, (&here, &at(q)), &at(value)).unwrap_err(), Fault::NotFinite);
    }
}

#[test]
fn extended_numbers_converge_to_their_own_precision() {
    let linkage = compile(STEPHENSON);
    let kept = pose::<Extended>(&linkage, &at(0.5)).expect("a pose");
    let residuals = residuals_at(&Coordinates::at(&linkage, &at(0.5), &kept));
    let worst = residuals.iter().fold(0.0f64, |m, r| m.max(r.to_f64().abs()));
    assert!(worst < 1e-63, "{worst:e}");
}

#[test]
fn large_systems_are_the_run_time_crates_bit_for_bit() {
    let mut random = Random(5);
    let graph = Graph::new(linkage_codegen::graph::Scalar::F64);
    let mut compared = 0;
    for _ in 0..500 {
        let mut draw = || if random.chance(0.2) { 0.0 } else { random.range(-1.0, 1.0) };
        let matrix: [[f64; 5]; 5] = [(); 5].map(|()| [(); 5].map(|()| draw()));
        let right: [f64; 5] = [(); 5].map(|()| draw());
        let sizes = matrix.map(|row| row.map(f64::abs));
        let (solution, distance) = linkage_runtime::__private::f64::solve(matrix, sizes, right);
        let args = matrix.as_flattened().iter().chain(sizes.as_flattened()).chain(&right);
        let args: Vec<Double> = args.map(|value| Double(*value)).collect();
        let found = graph.apply(Kernel::Solve(5), &args);
        if distance.abs() > 1e-15 {
            let expected: Vec<u64> = solution.iter().chain([&distance]).map(|value| value.to_bits()).collect();
            assert_eq!(found.iter().map(|value| value.0.to_bits()).collect::<Vec<_>>(), expected);
            compared += 1;
        }
    }
    assert!(compared > 400, "{compared}");
}

#[test]
fn a_scene_that_needs_no_place_of_the_group_does_not_search() {
    let text = STEPHENSON
        .replace("scene all: equilibrium;", "scene tip: position -> (crank.A); scene plate: position -> (t.G);");
    let linkage = compile(&text);
    let searches = |name: &str| {
        let index = index_of(&linkage, name);
        let functions = &linkage.functions.scenes[index];
        [&functions.direct, &functions.from_pose].map(|program| {
            let ops = (0..program.values.len()).filter_map(|i| match &program.values[i].definition {
                linkage_codegen::program::Definition::Computed(op) => Some(op),
                linkage_codegen::program::Definition::Input(_) => None,
            });
            ops.filter(|op| matches!(op, Op::Kernel { kernel: Kernel::Search { .. }, .. })).count() > 0
        })
    };
    assert_eq!(searches("tip"), [false, false]);
    assert_eq!(searches("plate"), [true, false]);
    assert_eq!(searches("work"), [true, false]);
}

/// A triad whose dimensions are parameters: parts of loops are turned by two components each, which rounds more than one does.
#[test]
fn a_triad_by_parameters_closes_to_rounding() {
    let kind = Kind {
        dyads: 0,
        sliders: false,
        joints: false,
        unknown_anywhere: false,
        moving: false,
        params: true,
        scalar: "f64",
    };
    let sample = sample_with_search(1340, kind);
    let linkage = compile(&sample.text);
    for step in -30..=30 {
        let mut arguments = sample.arguments.clone();
        arguments.drives[0] += 0.01 * f64::from(step);
        let found = pose::<Double>(&linkage, &arguments);
        assert!(found.is_ok(), "{found:?} at {}\n{}", arguments.drives[0], sample.text);
    }
}

/// Far from the start its determinant may have the other sign, which says nothing of the way that begins there.
#[test]
fn the_sense_of_a_way_is_that_of_its_start() {
    let [reached, ended, timid] = check_far(1661..1662);
    assert_eq!([reached, ended, timid], [8, 0, 0]);
}

/// A triad all of whose legs stand on one link is placed when compiled. One leg lies along an axis: what rounding leaves of the direction's
/// other component is no number that single precision has to hold.
#[test]
fn what_rounding_leaves_of_a_direction_that_is_found_when_compiled_is_nothing() {
    for scalar in ["f32", "f64"] {
        let linkage = compile(&format!(
            "pub mod sample; scalar {scalar};
             ground {{ O: (0, 0) }} link crank {{ O -> A: 1m, P: (-2.5m, -0.5m), Q: (-2.5m, -3.5m), R: (-2m, 0.5m) }}
             link plate {{ S -> T: 3.1622776985168457m, U: (2.213594436645508m, 1.2649110555648804m) }}
             link b {{ P -> S: 3m, K: (1.5m, 0) }} link c {{ Q -> T: 3.1622776985168457m }} link d {{ R -> U: 1.8027756214141846m }}
             revolute O: ground -> crank; revolute P: b -> crank; revolute S: b -> plate;
             revolute Q: crank -> c; revolute T: c -> plate; revolute R: d -> crank; revolute U: d -> plate;
             drive q: O; start q: 90deg; start b: (-1.01m, -0.52m), angle 0.025rad; start c: (1.98m, -0.48m), angle 2.82rad;
             start d: (-2.03m, 0.02m), angle -0.55rad; start plate: (2.04m, -0.5m), angle 2.84rad;
             load F: force(b.K); scene all: equilibrium;"
        ));
        let tiny = |number: f64| number != 0.0 && number.abs() < 1e-30;
        let constants = linkage.functions.pose.values.iter().filter_map(|value| match value.definition {
            Definition::Computed(Op::Constant(number)) => Some(linkage.model.graph.number(number).to_f64()),
            _ => None,
        });
        assert_eq!(constants.filter(|number| tiny(*number)).count(), 0, "{scalar}");
    }
}

/// The same of the pose that a search starts from, which is closed when compiled: here a leg points along the axis.
#[test]
fn what_rounding_leaves_of_a_start_that_is_closed_when_compiled_is_nothing() {
    for scalar in ["f32", "f64"] {
        let linkage = compile(&format!(
            "pub mod sample; scalar {scalar};
             ground {{ O: (0.8855811953544617m, -1.8924840688705444m), F: (0.5m, -0.5m), G: (1m, -0.5m) }}
             link crank {{ O -> A: 0.811387300491333m }} link b {{ A -> P: 1.3235175609588623m }}
             link t {{ Q -> R: 1m, P: (-0.5m, 0.5m) }} link c {{ F -> Q: 1m }} link d {{ G -> R: 0.5m, V: (0.5m, 0.25m) }}
             revolute O: ground -> crank; revolute A: crank -> b; revolute P: b -> t; revolute F: ground -> c; revolute Q: c -> t;
             revolute G: ground -> d; revolute R: d -> t; drive q: O; start q: -2.5319089889526367rad;
             start b: (0.2203821837902069m, -2.357090950012207m), angle 0.44367942214012146rad;
             start t: (1.3072428703308105m, -1.0902193784713745m), angle 2.5102620124816895rad;
             start c: (0.5m, -0.5m), angle -0.631330668926239rad; start d: (1m, -0.5m), angle 180deg;
             load H: force(d.V); scene all: equilibrium;"
        ));
        let starts = linkage.model.graph.searches().into_iter().flat_map(|(_, search)| search.start);
        let numbers = starts.filter_map(|node| linkage.model.graph.constant_value(node));
        let tiny = |number: f64| number != 0.0 && number.abs() < 1e-30;
        assert_eq!(numbers.filter(|number| tiny(number.to_f64())).count(), 0, "{scalar}");
    }
}
