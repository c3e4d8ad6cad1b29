//! Random linkages through the whole compiler and the interpreter, against the general solution.

mod support;

use std::collections::HashMap;

use linkage_codegen::Linkage;
use linkage_codegen::graph::Failure;
use linkage_codegen::graph::real::Real;
use linkage_codegen::program::Fault;
use support::general::{equations, solve_extended, solve_nalgebra};
use support::linkages::{Kind, Sample, sample, sample_with_search};
use support::numbers::{Double, Extended};
use support::{Arguments, Number, compile, scene};

/// How far two solutions may differ in 220 bits, over the largest force times the worst amplification seen.
const EXTENDED: f64 = 1e-40;

/// The size of a solution: its largest number.
fn largest<T: Number>(values: &HashMap<String, T>) -> f64 {
    values.values().fold(0.0, |m, v| m.max(v.to_f64().abs()))
}

/// The largest difference of what two solutions share, over the size of the second.
fn difference<T: Number>(a: &HashMap<String, T>, b: &HashMap<String, T>) -> f64 {
    let size = largest(b).max(f64::MIN_POSITIVE);
    let shared = a.iter().filter_map(|(path, value)| Some(value.sub(b.get(path)?).to_f64().abs() / size));
    shared.fold(0.0, f64::max)
}

/// Sums of all parts of a superposition, by the paths of the totals.
fn totals<T: Number>(linkage: &Linkage, parts: &HashMap<String, T>) -> HashMap<String, T> {
    let mut totals: HashMap<String, T> = HashMap::new();
    for (path, value) in parts {
        let mut rest = path.split_once('.').expect("a load's name").1;
        let first = rest.split('.').next().expect("a name");
        if linkage.model.links.iter().any(|link| link.name.text == first) {
            rest = rest.split_once('.').expect("a link's name").1;
        }
        totals.entry(rest.to_owned()).and_modify(|sum| *sum = sum.add(value)).or_insert_with(|| value.clone());
    }
    totals
}

/// What the scenes of a sample give.
struct Solved<T> {
    all: HashMap<String, T>,
    parts: HashMap<String, T>,
    work: HashMap<String, T>,
}

fn solved<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Solved<T> {
    let of = |name| scene::<T>(linkage, name, arguments).unwrap_or_else(|fault| panic!("{name}: {fault:?}"));
    Solved { all: of("all"), parts: of("parts"), work: of("work") }
}

fn efforts<T: Number>(linkage: &Linkage, work: &HashMap<String, T>) -> HashMap<String, T> {
    let names = linkage.model.unknowns.iter().map(|unknown| unknown.name.clone());
    names.map(|name| (name.clone(), work[&name].clone())).collect()
}

/// Why a sample whose unknown acts anywhere may be refused: a core that is too large, or an unknown that can hold nothing.
const REFUSALS: [&str; 4] =
    ["not supported yet", "cannot hold", "at every pose, nothing holds", "has no length between"];

/// The sample's linkage, unless its unknown makes it one that is refused.
fn supported(sample: &Sample) -> Option<Linkage> {
    match linkage_codegen::analyse(sample.text.parse().expect("tokens")) {
        // A rigid loop that turns as a whole holds no torque within itself, and with parameters, what has no length is only known when
        // they are given.
        Ok(linkage) => match scene::<Double>(&linkage, "all", &sample.arguments) {
            Err(Fault::Failed(Failure::DeadCentre { .. } | Failure::Parameter { .. })) => None,
            _ => Some(linkage),
        },
        Err(refusal) if refusal.errors.iter().all(|e| REFUSALS.iter().any(|r| e.message().contains(r))) => None,
        Err(_) => Some(compile(&sample.text)),
    }
}

/// In 220 bits nothing but a wrong equation makes a difference.
fn check_exactly(sample: &Sample, linkage: &Linkage) {
    let context = &sample.text;
    let exact = solved::<Extended>(linkage, &sample.arguments);
    let general = equations::<Extended>(linkage, &sample.arguments).expect("a pose");
    for residual in &general.residuals {
        assert!(residual.to_f64().abs() < 1e-50, "constraint {}\n{context}", residual.to_f64());
    }
    let right = general.right_side(&|_| true);
    let reference = solve_extended(&general.matrix, &right).expect("regular");
    let reference = general.named(linkage, reference);
    assert!(difference(&reference, &exact.all) < EXTENDED, "equilibrium\n{context}");
    assert!(difference(&totals(linkage, &exact.parts), &exact.all) < EXTENDED, "superposition\n{context}");
    let work = efforts(linkage, &exact.work);
    assert!(difference(&work, &exact.all) < EXTENDED, "virtual work\n{context}");
    // The terms of the loads make up each effort; of several unknowns every one has terms of its own.
    let unknowns = &linkage.model.unknowns;
    for unknown in unknowns {
        let own = |path: &str| unknowns.len() == 1 || path.contains(&format!(".{}.", unknown.name));
        let terms = exact.work.iter().filter(|(path, _)| path.rsplit('.').next() == Some("work") && own(path));
        let sum = terms.fold(exact.work[&unknown.name].clone(), |sum, (_, term)| sum.add(term));
        assert!(sum.to_f64().abs() <= EXTENDED * largest(&exact.work), "terms\n{context}");
    }
}

/// In doubles all methods agree to the rounding that the condition of the equations allows.
fn check_in_doubles(sample: &Sample, linkage: &Linkage) -> f64 {
    let context = &sample.text;
    let solution = solved::<Double>(linkage, &sample.arguments);
    let general = equations::<Double>(linkage, &sample.arguments).expect("a pose");
    let matrix: Vec<Vec<f64>> = general.matrix.iter().map(|line| line.iter().map(|x| x.0).collect()).collect();
    let right: Vec<f64> = general.right_side(&|_| true).iter().map(|x| x.0).collect();
    let (reference, condition) = solve_nalgebra(&matrix, &right).expect("regular");
    let reference = general.named(linkage, reference.into_iter().map(Double).collect());
    // The general solution takes lines of action from coordinates of points that are far from the origin; the emitted code does not.
    let has_lines = sample.text.contains("spring(") || sample.text.contains("thrust(");
    let far = sample.places.iter().flat_map(|(_, place)| place).fold(0.0f64, |far, x| far.max(x.abs()));
    let allowed = 50.0 * f64::EPSILON * condition * if has_lines { 1.0 + far } else { 1.0 };
    let error = difference(&reference, &solution.all);
    assert!(error < allowed, "equilibrium {error:e}, allowed {allowed:e}\n{context}");
    let error = difference(&totals(linkage, &solution.parts), &solution.all);
    assert!(error < allowed, "superposition {error:e}, allowed {allowed:e}\n{context}");
    let error = difference(&efforts(linkage, &solution.work), &solution.all);
    assert!(error < allowed, "virtual work {error:e}, allowed {allowed:e}\n{context}");
    let places = scene::<Double>(linkage, "whole", &sample.arguments).expect("places");
    for (joint, [x, y]) in &sample.places {
        for (path, drawn) in [(format!("{joint}.x"), x), (format!("{joint}.y"), y)] {
            let error = (places[&path].0 - drawn).abs();
            assert!(error < 1e-9 * (1.0 + drawn.abs()), "{path} is off by {error:e}\n{context}");
        }
    }
    condition
}

/// A linkage of what there is: dyads of pins and slides; welds, slots, wheels, driven cylinders; groups without a closed form, triads, of
/// class IV and others, with joints of all kinds in them; springs and thrusts, and where it moves dampers and inertia; unknowns anywhere.
fn drawn(seed: u64) -> Sample {
    let dyads = usize::try_from(seed % 7).expect("small");
    let kind = Kind {
        dyads,
        sliders: true,
        joints: !seed.is_multiple_of(3),
        unknown_anywhere: seed % 2 == 1,
        moving: seed % 11 == 3,
        params: seed % 5 == 4,
        scalar: "f64",
    };
    if seed % 8 < 3 { sample_with_search(seed, Kind { dyads: dyads % 3, ..kind }) } else { sample(seed, kind) }
}

/// How many of the linkages were solved; the others are rightly refused. All that disagree are told, not only the first.
fn check(seeds: core::ops::Range<u64>, exactly: u64) -> usize {
    let solves = |seed: u64| {
        let sample = drawn(seed);
        let Some(linkage) = supported(&sample) else { return false };
        check_in_doubles(&sample, &linkage);
        if seed.is_multiple_of(exactly) {
            check_exactly(&sample, &linkage);
        }
        true
    };
    let (mut solved, mut wrong) = (0, Vec::new());
    for seed in seeds {
        match std::panic::catch_unwind(|| solves(seed)) {
            Ok(one) => solved += usize::from(one),
            Err(_) => wrong.push(seed),
        }
    }
    assert!(wrong.is_empty(), "wrong: {wrong:?}");
    solved
}

#[test]
fn random_linkages_agree_with_the_general_solution() {
    let solved = check(0..400, 4);
    println!("{solved} of 400");
    assert!(solved > 320, "{solved}");
}

#[test]
#[ignore = "long"]
fn five_thousand_linkages_agree_with_the_general_solution() {
    let solved = check(10_000..16_000, 1);
    println!("{solved} of 6000");
    assert!(solved >= 5000, "{solved}");
}
