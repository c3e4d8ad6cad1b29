//! Random linkages through the whole compiler and the interpreter, against the general solution.

use std::collections::{BTreeMap, HashMap};

use crate::support::general::{equations, residuals, solve_extended, solve_nalgebra};
use crate::support::linkages::{Kind, Sample, sample, sample_with_search};
use crate::support::numbers::{Double, Extended};
use crate::support::{Arguments, Number, compile, direct, index_of, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Failure, NodeId};
use linkage_codegen::model::UnknownKind;
use linkage_codegen::model::ids::LinkId;
use linkage_codegen::plan::rules::RULES;
use linkage_codegen::program::{Extract, Fault, Form, passes};
use linkage_codegen::topology::Group;

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

/// The efforts by virtual work alone, straight from the drives, as a scene finds them that asks for nothing else.
fn efforts_alone<T: Number>(linkage: &Linkage, arguments: &Arguments) -> HashMap<String, T> {
    let graph = &linkage.model.graph;
    let mut results = linkage.plan.scenes[index_of(linkage, "work")].leaves();
    results.retain(|(path, _)| linkage.model.unknowns.iter().any(|unknown| unknown.name == *path));
    let finite: Vec<NodeId> = results.iter().map(|(_, node)| *node).collect();
    let program = passes::optimised(Extract { graph, form: Form::Direct }.program(&results, &finite), graph);
    let values = direct(linkage, &program, arguments).expect("efforts");
    program.outputs.iter().map(|(path, _)| path.clone()).zip(values).collect()
}

/// Why a sample may be refused whose unknown acts anywhere: it can hold nothing.
const REFUSALS: [&str; 3] = ["cannot hold", "at every pose, nothing holds", "has no length between"];

/// The smallest condition of equations that count as singular: those of the samples that are solved stay far below it.
const SINGULAR: f64 = 1e13;

/// The sample's linkage; none if it has an unknown of its own, somewhere else than at the drive, that rightly makes it one that is refused.
/// Every linkage that is held at its drives is solved.
fn supported(sample: &Sample) -> Option<Linkage> {
    if !sample.text.contains("\nunknown ") {
        return Some(compile(&sample.text));
    }
    match linkage_codegen::analyse(sample.text.parse().expect("tokens")) {
        // A rigid loop that turns as a whole holds no torque within itself, and with parameters, what has no length is only known when
        // they are given.
        Ok(linkage) => match scene::<Double>(&linkage, "all", &sample.arguments) {
            Err(Fault::Failed(Failure::DeadCentre { .. } | Failure::Parameter { .. })) => {
                let condition = solution_of_all(&linkage, &sample.arguments).map_or(f64::INFINITY, |(_, found)| found);
                assert!(condition > SINGULAR, "refused at a condition of {condition:e}\n{}", sample.text);
                for other in ["parts", "work"] {
                    let found = scene::<Double>(&linkage, other, &sample.arguments);
                    assert!(found.is_err(), "{other} is solved where the other is refused\n{}", sample.text);
                }
                None
            }
            _ => Some(linkage),
        },
        Err(refusal) if refusal.errors.iter().all(|e| REFUSALS.iter().any(|r| e.message().contains(r))) => None,
        Err(_) => Some(compile(&sample.text)),
    }
}

/// The general solution in doubles, and the condition of its equations; none if they are singular.
fn solution_of_all(linkage: &Linkage, arguments: &Arguments) -> Option<(HashMap<String, Double>, f64)> {
    let general = equations::<Double>(linkage, arguments).expect("a pose");
    let matrix: Vec<Vec<f64>> = general.matrix.iter().map(|line| line.iter().map(|x| x.0).collect()).collect();
    let right: Vec<f64> = general.right_side(&|_| true).iter().map(|x| x.0).collect();
    let (solution, condition) = solve_nalgebra(&matrix, &right)?;
    Some((general.named(linkage, solution.into_iter().map(Double).collect()), condition))
}

/// What loads and masses have beside lengths, which may be a parameter.
const VALUES: [&str; 7] =
    ["a force", "a moment", "a mass", "a moment of inertia", "a stiffness", "a torsional stiffness", "an angle"];
/// The same of what damps, and so is there in few of the linkages that move.
const DAMPING: [&str; 2] = ["a damping", "a torsional damping"];

/// What was solved.
#[derive(Debug, Default)]
struct Census {
    linkages: usize,
    /// Linkages with a joint of a kind, a driven joint of a kind, an unknown of their own, a triad, a ring of class IV, by their words.
    having: BTreeMap<String, usize>,
}

impl Census {
    fn count(&mut self, linkage: &Linkage) {
        self.linkages += 1;
        let model = &linkage.model;
        let mut words: Vec<String> = model.joints.iter().map(|joint| joint.kind.word().to_owned()).collect();
        words.extend(model.drives.iter().map(|drive| {
            let coordinate = if drive.turns { "angle" } else { "travel" };
            format!("{coordinate} of a {}", model.joint(drive.joint).kind.word())
        }));
        if model.unknowns.iter().any(|unknown| !matches!(unknown.kind, UnknownKind::Drive(_))) {
            words.push("an unknown of its own".to_owned());
            if model.unknowns.iter().any(|unknown| matches!(unknown.kind, UnknownKind::Drive(_))) {
                words.push("an unknown of its own beside the effort at a drive".to_owned());
            }
        }
        // What varies of a load or a mass is seldom a length; of dimensions nothing else.
        words.extend(model.params.iter().map(|param| format!("parameter: {}", param.kind.name())));
        for (group, rule) in linkage.topology.motion.iter().zip(&linkage.plan.motion_rules) {
            words.push(format!("rule: {rule}"));
            words.extend(shape(linkage, group).map(str::to_owned));
        }
        words.sort_unstable();
        words.dedup();
        words.into_iter().for_each(|word| *self.having.entry(word).or_default() += 1);
    }

    /// At least so many linkages were solved, and so many of them with each of all that there is.
    fn expect(&self, linkages: usize, each: usize) {
        println!("{self:#?}");
        assert!(self.linkages >= linkages, "{}", self.linkages);
        let joints = ["revolute", "prismatic", "slot", "weld", "gear"];
        let driven = ["angle of a revolute", "travel of a prismatic", "travel of a slot", "angle of a slot"];
        let count = |word: &str| self.having.get(word).copied().unwrap_or(0);
        for word in joints.into_iter().chain(driven).chain(["an unknown of its own", "triad", "ring of class IV"]) {
            assert!(count(word) >= each, "{word}: {}", count(word));
        }
        // Each group that is closed in formulas has its rule; wheels of trains and dyads of slides are the rarest.
        for rule in RULES.iter().map(|rule| rule.class()) {
            assert!(count(&format!("rule: {rule}")) >= each.div_ceil(5), "{rule}: {}", count(&format!("rule: {rule}")));
        }
        assert!(count("an unknown of its own beside the effort at a drive") >= each.div_ceil(5));
        for value in VALUES {
            assert!(count(&format!("parameter: {value}")) >= each.div_ceil(5), "{value}: {:?}", self.having);
        }
        assert!(DAMPING.iter().any(|value| count(&format!("parameter: {value}")) > 0), "{:?}", self.having);
    }
}

/// What a group without a closed form is called: a triad is a link that three others join to what is placed; a ring, of class IV, four
/// links one after the other.
fn shape(linkage: &Linkage, group: &Group) -> Option<&'static str> {
    let ends = |link: LinkId| {
        let holds = |id: &&_| {
            let joint = linkage.model.joint(**id);
            joint.from.link == link || joint.to.link == link
        };
        group.inner.iter().filter(holds).count()
    };
    let inner: Vec<usize> = group.links.iter().map(|link| ends(*link)).collect();
    match (group.links.len(), group.outer.len(), group.inner.len()) {
        (4, 3, 3) if inner.contains(&3) => Some("triad"),
        (4, 2, 4) if inner.iter().all(|count| *count == 2) => Some("ring of class IV"),
        _ => None,
    }
}

/// In 220 bits nothing but a wrong equation makes a difference.
fn check_exactly(sample: &Sample, linkage: &Linkage) {
    let context = &sample.text;
    let exact = solved::<Extended>(linkage, &sample.arguments);
    for residual in residuals::<Extended>(linkage, &sample.arguments).expect("a pose") {
        assert!(residual.to_f64().abs() < 1e-50, "constraint {}\n{context}", residual.to_f64());
    }
    let general = equations::<Extended>(linkage, &sample.arguments).expect("a pose");
    let right = general.right_side(&|_| true);
    let reference = solve_extended(&general.matrix, &right).expect("regular");
    let reference = general.named(linkage, reference);
    assert!(difference(&reference, &exact.all) < EXTENDED, "equilibrium\n{context}");
    assert!(difference(&totals(linkage, &exact.parts), &exact.all) < EXTENDED, "superposition\n{context}");
    let work = efforts(linkage, &exact.work);
    assert!(difference(&work, &exact.all) < EXTENDED, "virtual work\n{context}");
    let alone = efforts_alone(linkage, &sample.arguments);
    assert!(difference(&alone, &work) < EXTENDED, "virtual work alone\n{context}");
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
    let (reference, condition) = solution_of_all(linkage, &sample.arguments).expect("regular");
    // The general solution takes lines of action from coordinates of points that are far from the origin; the emitted code does not.
    let has_lines = sample.text.contains("spring(") || sample.text.contains("thrust(");
    let far = sample.places.iter().flat_map(|(_, place)| place).fold(0.0f64, |far, x| far.max(x.abs()));
    let allowed = 50.0 * f64::EPSILON * condition * if has_lines { 1.0 + far } else { 1.0 };
    let error = difference(&reference, &solution.all);
    assert!(error < allowed, "equilibrium {error:e}, allowed {allowed:e}\n{context}");
    let error = difference(&totals(linkage, &solution.parts), &solution.all);
    assert!(error < allowed, "superposition {error:e}, allowed {allowed:e}\n{context}");
    for work in [efforts(linkage, &solution.work), efforts_alone(linkage, &sample.arguments)] {
        let error = difference(&work, &solution.all);
        assert!(error < allowed, "virtual work {error:e}, allowed {allowed:e}\n{context}");
    }
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

/// What of the linkages was solved; the others are rightly refused. All that disagree are told, not only the first.
fn check(seeds: core::ops::Range<u64>, exactly: u64) -> Census {
    let solves = |seed: u64| {
        let sample = drawn(seed);
        let linkage = supported(&sample)?;
        check_in_doubles(&sample, &linkage);
        if seed.is_multiple_of(exactly) {
            check_exactly(&sample, &linkage);
        }
        Some(linkage)
    };
    let (mut census, mut wrong) = (Census::default(), Vec::new());
    for seed in seeds {
        match std::panic::catch_unwind(|| solves(seed)) {
            Ok(Some(linkage)) => census.count(&linkage),
            Ok(None) => {}
            Err(_) => wrong.push(seed),
        }
    }
    assert!(wrong.is_empty(), "wrong: {wrong:?}");
    census
}

#[test]
fn random_linkages_agree_with_the_general_solution() {
    check(0..200, 4).expect(180, 7);
}

#[test]
#[ignore = "long"]
fn five_thousand_linkages_agree_with_the_general_solution() {
    check(10_000..16_000, 1).expect(5000, 150);
}
