//! Derivatives of the results of every kind of scene, of random linkages, against central differences in 220 bits.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::support::linkages::{Kind, Random, Sample, sample, sample_with_search};
use crate::support::numbers::{Double, Extended};
use crate::support::{Arguments, Number, compile, index_of};
use linkage_codegen::Linkage;
use linkage_codegen::diagnostics::Diagnostic;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{NodeValues, Op, Order, Symbol};
use linkage_codegen::model::End;
use linkage_codegen::model::ids::{DriveId, GROUND, LinkId, LoadId, ParamId, PointId};
use linkage_codegen::plan::rules::RULES;
use linkage_codegen::program::{Fault, Input, Program, Run};

/// Its square is far below what is compared, and rounding over it is too.
const STEP: f64 = 1e-18;
/// Of central differences: what the third derivative brings.
const TOLERANCE: f64 = 1e-22;

/// A linkage at arguments of which one may be a little off.
struct At<'a> {
    linkage: &'a Linkage,
    arguments: &'a Arguments,
    moved: Option<(Symbol, f64)>,
}

impl At<'_> {
    fn known<T: Number>(&self, symbol: Symbol) -> T {
        let value = T::exactly(self.arguments.of(symbol));
        match self.moved {
            Some((moved, by)) if moved == symbol => value.add(&T::exactly(by)),
            _ => value,
        }
    }

    fn run<T: Number>(&self, program: &Program, pose: &NodeValues<T>) -> Result<Vec<T>, Fault> {
        let graph = &self.linkage.model.graph;
        let nothing = || T::exactly(f64::NAN);
        let functions = &self.linkage.functions;
        let values = Run { program: &functions.prepare, graph }.with(&|input| match input {
            Input::Symbol(symbol) => self.known(symbol),
            _ => nothing(),
        })?;
        let prepared: NodeValues<T> = functions.prepared.iter().copied().zip(values).collect();
        Run { program, graph }.with(&|input| match input {
            Input::Symbol(symbol) => self.known(symbol),
            Input::Prepared(node) => prepared[&node].clone(),
            Input::Kept(node) => pose[&node].clone(),
            Input::Known(_) => nothing(),
        })
    }

    fn direct<T: Number>(&self, scene: &str) -> Result<HashMap<String, T>, Fault> {
        let program = &self.linkage.functions.scenes[index_of(self.linkage, scene)].direct;
        Ok(paths(program).zip(self.run(program, &NodeValues::default())?).collect())
    }

    fn posed<T: Number>(&self, scene: &str) -> Result<HashMap<String, T>, Fault> {
        let kept = self.run(&self.linkage.functions.pose, &NodeValues::default())?;
        let pose = self.linkage.plan.pose.iter().map(|kept| kept.node).zip(kept).collect();
        let program = &self.linkage.functions.scenes[index_of(self.linkage, scene)].from_pose;
        Ok(paths(program).zip(self.run(program, &pose)?).collect())
    }
}

fn paths(program: &Program) -> impl Iterator<Item = String> {
    program.outputs.iter().map(|(path, _)| path.clone())
}

/// Something to differentiate by: as it is written, the path of its record, and its symbol.
struct Variable {
    written: String,
    numbers: Vec<(String, Symbol)>,
}

fn variables(linkage: &Linkage) -> Vec<Variable> {
    let model = &linkage.model;
    let one = |written: String, path: String, symbol| Variable { written, numbers: vec![(path, symbol)] };
    let mut all = Vec::new();
    for (index, drive) in model.drives.iter().enumerate() {
        let (id, name) = (DriveId::new(index), drive.name.text.clone());
        all.push(one(name.clone(), name.clone(), Symbol::Drive(id)));
        for order in drive.given_motion(&model.graph) {
            let word = if order == Order::Rate { "rate" } else { "acceleration" };
            all.push(one(format!("{name}.{word}"), format!("{name}_{word}"), Symbol::Driven(id, order)));
        }
    }
    for index in 0..model.params.len() {
        let (id, name) = (ParamId::new(index), model.params[index].name.text.clone());
        all.push(one(name.clone(), name, Symbol::Parameter(id)));
    }
    for index in 0..model.loads.len() {
        let load = model.load(LoadId::new(index));
        let numbers = load.kind.values().into_iter().filter_map(|(field, node)| match model.graph.op(node) {
            Op::Symbol(symbol @ Symbol::Load(..)) => {
                let dot = if field.is_empty() { "" } else { "." };
                Some((format!("{}{dot}{field}", load.name), symbol))
            }
            _ => None,
        });
        let numbers: Vec<_> = numbers.collect();
        if !numbers.is_empty() {
            all.push(Variable { written: load.name.text.clone(), numbers });
        }
    }
    all
}

/// The declaration with these scenes. Over a load that never moves with the unknown there is no advantage, and what rests has no path.
fn with_further_scenes(text: &str, plain: &Linkage) -> (String, Linkage) {
    let between = |error: &Diagnostic, before: &str, behind: &str| {
        Some(error.message().split_once(before)?.1.split_once(behind)?.0.to_owned())
    };
    let ways = [
        ("no advantage over `", "`"),
        ("the velocity of ", " vanishes"),
        ("the centre of mass of ", " vanishes"),
        ("`", "` never moves"),
    ];
    let mut vain: Vec<String> = Vec::new();
    loop {
        let further = format!("{text}{}", further_scenes(plain, &vain));
        let Err(refusal) = linkage_codegen::analyse(further.parse().expect("tokens")) else {
            return (further.clone(), compile(&further));
        };
        let errors = || refusal.errors.iter();
        let found = ways
            .into_iter()
            .flat_map(|(before, behind)| errors().filter_map(move |error| between(error, before, behind)));
        let new: Vec<String> = found.filter(|name| !vain.contains(name)).collect();
        assert!(!new.is_empty(), "{:?}\n{further}", refusal.errors);
        vain.extend(new);
    }
}

/// How the results of a scene change with a symbol.
fn differences(linkage: &Linkage, arguments: &Arguments, scene: &str, symbol: Symbol) -> HashMap<String, Extended> {
    let [before, behind] = [-STEP, STEP]
        .map(|by| At { linkage, arguments, moved: Some((symbol, by)) }.direct::<Extended>(scene).expect("results"));
    let twice = Extended::exactly(STEP).add(&Extended::exactly(STEP));
    behind.iter().map(|(path, value)| (path.clone(), value.sub(&before[path]).div(&twice))).collect()
}

/// The declaration with the derivatives of these scenes by all variables, but for those by what no result depends on: these are refused.
fn with_derivatives(text: &str, scenes: &[&str], variables: &[Variable]) -> (Linkage, Vec<(String, Vec<usize>)>) {
    let mut asked: Vec<(String, Vec<usize>)> =
        scenes.iter().map(|scene| ((*scene).to_owned(), (0..variables.len()).collect())).collect();
    loop {
        let mut all = text.to_owned();
        for (scene, by) in &asked {
            let by: Vec<&str> = by.iter().map(|index| variables[*index].written.as_str()).collect();
            all.push_str(&format!("scene d_{scene}: derivative({scene}) by ({});\n", by.join(", ")));
        }
        let refusal = match linkage_codegen::analyse(all.parse().expect("tokens")) {
            Ok(linkage) => return (linkage, asked),
            Err(refusal) => refusal,
        };
        let errors: Vec<&str> = refusal.errors.iter().map(Diagnostic::message).collect();
        let count = |asked: &[(String, Vec<usize>)]| asked.iter().map(|(_, by)| by.len()).sum::<usize>();
        let before = count(&asked);
        for (scene, by) in &mut asked {
            by.retain(|index| {
                let written = &variables[*index].written;
                !errors.iter().any(|e| e.contains(&format!("no result of `{scene}` depends on `{written}`")))
            });
        }
        asked.retain(|(_, by)| !by.is_empty());
        assert_eq!(before - count(&asked), errors.len(), "{}\n\n{all}", errors.join("\n\n"));
    }
}

const SCENES: [&str; 11] =
    ["whole", "speeds", "accelerations", "all", "parts", "work", "gains", "felt", "shaken", "over", "reduced"];

/// The scenes that a sample does not bring: kinematic coefficients, power and what the ground feels, inertia with its line and its resultant,
/// mechanical advantage, and the reduced equation of motion.
fn further_scenes(linkage: &Linkage, vain: &[String]) -> String {
    let model = &linkage.model;
    let point = |link: LinkId| model.end_name(End { link, point: PointId::FIRST });
    let mut text =
        format!("scene gains: coefficients;\nscene felt: equilibrium -> (power, ground about {});\n", point(GROUND));
    let over = model.loads.iter().filter(|load| !load.kind.is_per_link() && !vain.contains(&load.name.text));
    let over: Vec<String> = over.map(|load| format!("advantage({})", load.name)).collect();
    if !over.is_empty() {
        text.push_str(&format!("scene over: virtual_work -> ({});\n", over.join(", ")));
    }
    let heavy: Vec<LinkId> = model.moving_links().filter(|link| model.link(*link).mass.is_some()).collect();
    if let [first, ..] = heavy.as_slice() {
        let mut shaken = vec![format!("shaking({})", point(GROUND))];
        for name in heavy.iter().map(|link| &model.link(*link).name.text) {
            shaken.push(format!("inertia({name})"));
            if !vain.contains(name) {
                shaken.push(format!("offset({name})"));
            }
        }
        let path = point(*first);
        if !vain.contains(&path) {
            shaken.push(format!("{path} along path"));
        }
        text.push_str(&format!("scene shaken: acceleration -> ({});\n", shaken.join(", ")));
        text.push_str("scene reduced: motion -> (M, h, M_kinetic);\n");
    }
    text
}

fn near(
    found: &HashMap<String, Extended>,
    path: &str,
    expected: &HashMap<String, Extended>,
    tolerance: f64,
    why: &str,
) {
    let scale = expected.values().fold(1.0f64, |most, value| most.max(value.to_f64().abs()));
    for (leaf, value) in expected {
        let own = &found[&format!("{path}.{leaf}")];
        let off = own.sub(value).to_f64().abs();
        assert!(
            off <= tolerance * scale,
            "{path}.{leaf}: {:e} and not {:e}, of {scale:e}: {why}",
            own.to_f64(),
            value.to_f64()
        );
    }
}

/// What was compared.
#[derive(Debug, Default)]
struct Found {
    /// The classes of groups with parameters among the dimensions.
    classes: BTreeSet<&'static str>,
    /// How many derivatives of each scene.
    compared: BTreeMap<String, usize>,
}

impl Found {
    fn expect(&self, each: usize) {
        println!("{:#?}", self.compared);
        for scene in SCENES {
            let compared = self.compared.get(scene).copied().unwrap_or(0);
            assert!(compared >= each, "{compared} derivatives of `{scene}`");
        }
    }
}

/// A linkage whose unknown cannot hold it is refused, and at a dead centre there are no derivatives.
fn check(sample: &Sample, found: &mut Found) {
    let Ok(plain) = linkage_codegen::analyse(sample.text.parse().expect("tokens")) else { return };
    let (text, plain) = with_further_scenes(&sample.text, &plain);
    let arguments = &with_motion(&sample.arguments, plain.model.drives.len());
    let at = At { linkage: &plain, arguments, moved: None };
    let scenes: Vec<&str> = SCENES
        .into_iter()
        .filter(|scene| plain.model.scenes.iter().any(|other| other.name.text == *scene))
        .filter(|scene| at.direct::<Double>(scene).is_ok() && at.direct::<Extended>(scene).is_ok())
        .collect();
    let variables = variables(&plain);
    if variables.iter().any(|variable| matches!(variable.numbers[0].1, Symbol::Parameter(_))) {
        found.classes.extend(&plain.plan.motion_rules);
    }
    let (linkage, asked) = with_derivatives(&text, &scenes, &variables);
    let at = At { linkage: &linkage, arguments, moved: None };
    let doubles = |results: HashMap<String, Double>| -> HashMap<String, Extended> {
        results.into_iter().map(|(path, value)| (path, Extended::exactly(value.0))).collect()
    };
    for (scene, by) in &asked {
        let own = format!("d_{scene}");
        let direct = at.direct::<Extended>(&own).expect("derivatives");
        let from_pose = at.posed::<Extended>(&own).expect("derivatives from a pose");
        let rounded = [at.direct::<Double>(&own), at.posed::<Double>(&own)].map(|found| doubles(found.expect("f64")));
        for (path, symbol) in by.iter().flat_map(|index| &variables[*index].numbers) {
            let expected = differences(&linkage, arguments, scene, *symbol);
            let why = format!("{own}\n{}", sample.text);
            near(&direct, path, &expected, TOLERANCE, &why);
            near(&from_pose, path, &expected, TOLERANCE, &why);
            for rounded in &rounded {
                near(rounded, path, &expected, 1e-9, &format!("rounded, {why}"));
            }
            *found.compared.entry(scene.clone()).or_default() += expected.len();
        }
    }
    // What is refused because nothing depends on it does not change.
    for scene in &scenes {
        let by = asked.iter().find(|(other, _)| other == scene).map_or(&[][..], |(_, by)| by);
        for variable in (0..variables.len()).filter(|index| !by.contains(index)).map(|index| &variables[index]) {
            for (path, value) in differences(&linkage, arguments, scene, variable.numbers[0].1) {
                assert!(value.to_f64().abs() < 1e-30, "{scene}: {path} depends on {}", variable.written);
            }
        }
    }
}

/// The same with rates and accelerations, if there are none yet.
fn with_motion(arguments: &Arguments, drives: usize) -> Arguments {
    let mut arguments = arguments.clone();
    if arguments.motion.is_empty() {
        arguments.motion = vec![[1.7, -2.3], [-0.9, 1.1], [2.4, 0.6]].into_iter().cycle().take(drives).collect();
    }
    arguments
}

fn kind(seed: u64) -> Kind {
    let dyads = 1 + usize::try_from(seed % 3).expect("small");
    Kind {
        dyads,
        sliders: true,
        joints: seed % 2 == 1,
        unknown_anywhere: seed % 7 == 3,
        moving: !seed.is_multiple_of(3),
        params: false,
        scalar: "f64",
    }
}

fn drawn(seed: u64) -> Sample {
    let drawn = if seed % 6 == 5 { sample_with_search(seed, kind(seed)) } else { sample(seed, kind(seed)) };
    if seed.is_multiple_of(2) { drawn } else { with_parameters(drawn, &mut Random(seed)) }
}

/// The units of literals that may be parameters, none the beginning of one behind it.
const UNITS: [(&str, &str); 9] = [
    ("N*m*s/rad", "torsion_damping"),
    ("N*m/rad", "torsion_stiffness"),
    ("N*s/m", "damping"),
    ("N/m", "stiffness"),
    ("N*m", "moment"),
    ("kg*m^2", "inertia"),
    ("rad", "angle"),
    ("kg", "mass"),
    ("m", "length"),
];

/// Some of all dimensions of a linkage as parameters: lengths, angles, masses, stiffnesses.
fn with_parameters(sample: Sample, random: &mut Random) -> Sample {
    let Sample { text, mut arguments, places, longest } = sample;
    let share = *random.pick(&[0.1, 0.3, 1.0]);
    let (mut written, mut declared) = (String::new(), String::new());
    for line in text.lines() {
        let mut rest = if line.starts_with("start ") { "" } else { line };
        written.push_str(&line[..line.len() - rest.len()]);
        while let Some(begin) = rest.find(|letter: char| letter.is_ascii_alphanumeric()) {
            let (before, word) = rest.split_at(begin);
            let end = word.find(|letter: char| !letter.is_ascii_alphanumeric()).unwrap_or(word.len());
            let literal = literal(word);
            written.push_str(before);
            rest = literal.map_or(&word[end..], |(.., behind)| behind);
            match literal {
                Some((value, dimension, _)) if random.chance(share) => {
                    let name = format!("v{}", arguments.params.len());
                    arguments.params.push(value);
                    written.push_str(&name);
                    declared.push_str(&format!("param {name}: {dimension};\n"));
                }
                _ => written.push_str(&word[..word.len() - rest.len()]),
            }
        }
        written.push_str(rest);
        written.push('\n');
    }
    Sample { text: written + &declared, arguments, places, longest }
}

/// The value and the dimension of a literal with a unit, and what is behind it.
fn literal(text: &str) -> Option<(f64, &'static str, &str)> {
    let starts = text.starts_with(|letter: char| letter.is_ascii_digit());
    let of_number = |(index, letter): (usize, char)| match letter {
        '0'..='9' | '.' | 'e' => true,
        '-' => text[..index].ends_with('e'),
        _ => false,
    };
    let length = text.char_indices().find(|at| !of_number(*at)).map_or(text.len(), |(index, _)| index);
    let (number, unit) = text.split_at(length);
    let (written, dimension) = UNITS.iter().find(|(written, _)| unit.starts_with(written))?;
    let behind = &unit[written.len()..];
    let whole = !behind.starts_with(|letter: char| letter.is_ascii_alphanumeric() || letter == '/');
    (starts && whole).then(|| Some((number.parse().ok()?, *dimension, behind)))?
}

#[test]
fn derivatives_are_those_of_differences() {
    let mut found = Found::default();
    for seed in 7007..7012 {
        check(&drawn(seed), &mut found);
    }
    found.expect(25);
    for class in ["RRR dyad", "RRP dyad", "block"] {
        assert!(found.classes.contains(class), "no {class} among {:?}", found.classes);
    }
}

/// Every class of groups has parameters among its dimensions.
#[test]
#[ignore = "long"]
fn derivatives_of_many_linkages_are_those_of_differences() {
    let mut found = Found::default();
    for seed in 80_000..80_150 {
        check(&drawn(seed), &mut found);
    }
    found.expect(1000);
    for rule in RULES {
        assert!(found.classes.contains(rule.class()), "no {} among the groups", rule.class());
    }
}
