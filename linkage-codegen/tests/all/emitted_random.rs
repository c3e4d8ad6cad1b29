//! Random linkages emitted, compiled and run: the same bits as from the interpreter, from every function, or an error of the same kind. So
//! where all that is given is regular, and where one number of it is NaN, infinite, or the largest there is.
//!
//! They are written into a crate of their own, which prints what each scene gives; only that needs a run of cargo within the test.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::linkages::{Kind, sample};
use crate::support::measures::values_from_kept;
use crate::support::numbers::{Double, Single};
use crate::support::{
    Arguments, Number, Told, checked_pose, checked_prepared, direct, index_of, told, told_as_printed,
};
use linkage_codegen::Linkage;
use linkage_codegen::graph::Symbol;
use linkage_codegen::model::LoadKind;
use linkage_codegen::model::ids::{DriveId, LoadId, ParamId};
use linkage_codegen::program::{Fault, Program};

const SCENES: [&str; 8] = ["all", "parts", "work", "whole", "speeds", "accelerations", "gains", "control"];
/// Of linkages that have mass.
const CONTROL: &str = "scene control: motion -> (M, h, rounding, M_kinetic);";

/// What one number is in place of what it was.
const IN_PLACE: [&str; 4] = ["NAN", "INFINITY", "NEG_INFINITY", "MAX"];

struct Case {
    name: String,
    scalar: &'static str,
    declaration: String,
    arguments: Arguments,
    linkage: Linkage,
}

impl Case {
    /// The numbers that are given: parameters, drives, loads, motion.
    fn given(&self) -> Vec<Symbol> {
        let model = &self.linkage.model;
        let mut all: Vec<Symbol> =
            (0..model.params.len()).map(|param| Symbol::Parameter(ParamId::new(param))).collect();
        all.extend((0..model.drives.len()).map(|drive| Symbol::Drive(DriveId::new(drive))));
        for (index, load) in model.loads.iter().enumerate().filter(|(_, load)| load.kind.is_given_at_run_time(model)) {
            let parts: Vec<u8> = match load.kind {
                LoadKind::Moment { .. } | LoadKind::Thrust { .. } => vec![0],
                LoadKind::Force { .. } | LoadKind::Gravity { .. } => vec![0, 1],
                LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
                    let given: Vec<&str> = load.kind.given(model).collect();
                    (0..4).filter(|part| given.contains(&load.kind.value_name(*part))).collect()
                }
                LoadKind::Inertia => Vec::new(),
            };
            all.extend(parts.into_iter().map(|part| Symbol::Load(LoadId::new(index), part)));
        }
        all.extend(linkage_codegen::emit::given_motion(model).into_iter().map(|(drive, order)| {
            let index = model.drives.iter().position(|own| own.name.text == drive.name.text).expect("a drive");
            Symbol::Driven(DriveId::new(index), order)
        }));
        all
    }

    /// Its arguments as they are, then with each number in turn replaced by each of [`IN_PLACE`].
    fn all_arguments(&self) -> Vec<Arguments> {
        let largest = if self.scalar == "f32" { f64::from(f32::MAX) } else { f64::MAX };
        let replaced = self.given().into_iter().flat_map(|symbol| {
            let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, largest];
            bad.map(|bad| Arguments { instead: Some((symbol, bad)), ..self.arguments.clone() })
        });
        core::iter::once(self.arguments.clone()).chain(replaced).collect()
    }
}

fn cases() -> Vec<Case> {
    let of = |seed: u64| {
        let scalar = if seed.is_multiple_of(3) { "f32" } else { "f64" };
        let dyads = usize::try_from(seed % 4).expect("small");
        let kind = Kind {
            dyads,
            sliders: true,
            joints: seed % 4 == 1,
            unknown_anywhere: seed.is_multiple_of(2),
            moving: true,
            params: seed % 5 == 4,
            scalar,
        };
        let mut sample = sample(seed, kind);
        sample.text.push_str("scene gains: coefficients;");
        if sample.text.contains("load I: inertia;") {
            sample.text.push_str(CONTROL);
        }
        for scene in SCENES {
            if sample.text.contains(&format!("scene {scene}:")) {
                let _ = writeln!(sample.text, "scene {scene}_path: sweep({scene});");
            }
        }
        // With its unknown anywhere a linkage may be one that is refused.
        let linkage = linkage_codegen::analyse(sample.text.parse().expect("tokens")).ok()?;
        Some(Case {
            name: format!("case_{seed}"),
            scalar,
            declaration: sample.text,
            arguments: sample.arguments,
            linkage,
        })
    };
    (50_000..50_060).filter_map(of).collect()
}

/// A module with the linkage, and a function that prints what its scenes give with each of its arguments.
fn module(case: &Case) -> String {
    let Case { name, scalar, declaration, arguments, linkage } = case;
    let model = &linkage.model;
    let given = case.given();
    let number = |symbol: Symbol| {
        let place = given.iter().position(|other| *other == symbol).expect("what is given");
        format!("(given[{place}] as {scalar})")
    };
    let loads = model.loads.iter().enumerate().filter(|(_, load)| load.kind.is_given_at_run_time(model));
    let loads = loads.map(|(index, load)| {
        let part = |part| number(Symbol::Load(LoadId::new(index), part));
        let value = match load.kind {
            LoadKind::Moment { .. } | LoadKind::Thrust { .. } => part(0),
            LoadKind::Force { .. } | LoadKind::Gravity { .. } => format!("Vector2::new({}, {})", part(0), part(1)),
            LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
                let place = |name| (0..4).find(|part| load.kind.value_name(*part) == name).expect("a value");
                let fields = load.kind.given(model).map(|name| format!("{name}: {}", part(place(name))));
                format!("sample::{} {{ {} }}", load.type_name(), fields.collect::<Vec<_>>().join(", "))
            }
            LoadKind::Inertia => "()".to_owned(),
        };
        format!("{}: {value}", load.name)
    });
    let loads: Vec<String> = loads.collect();
    let params = model.params.iter().enumerate();
    let params: Vec<String> =
        params.map(|(index, p)| format!("{}: {}", p.name, number(Symbol::Parameter(ParamId::new(index))))).collect();
    let mut text =
        format!("mod {name} {{\nuse linkage_runtime::{{Error, Series, SweepError, Vector2, linkage}};\nlinkage! {{\n");
    let good: Vec<String> = given.iter().map(|symbol| format!("{:?}f64", arguments.of(*symbol))).collect();
    let in_place = IN_PLACE.map(|bad| format!("f64::from({scalar}::{bad})")).join(", ");
    let _ = writeln!(
        text,
        "{declaration}}}
         const GOOD: [f64; {count}] = [{}];
         pub fn run() {{
             with(0, GOOD);
             for (place, (index, bad)) in (0..{count}).flat_map(|index| [{in_place}].map(|bad| (index, bad))).enumerate() {{
                 let mut given = GOOD;
                 given[index] = bad;
                 with(1 + place, given);
             }}
         }}
         fn with(number: usize, given: [f64; {count}]) {{
             if let Err(error) = try_with(number, given) {{ println!(\"{name} {{number}} fails new {{:?}}\", Err::<(), _>(error)); }}
         }}
         fn try_with(number: usize, given: [f64; {count}]) -> Result<(), Error> {{",
        good.join(", "),
        count = given.len(),
    );
    let mut first = String::new();
    if !params.is_empty() {
        let _ = writeln!(text, "let linkage = sample::Linkage::new(&sample::Params {{ {} }})?;", params.join(", "));
        first.push_str("&linkage, ");
    }
    if !loads.is_empty() {
        let _ = writeln!(text, "let loads = sample::Loads {{ {} }};", loads.join(", "));
    }
    let motion = linkage_codegen::emit::given_motion(model).into_iter().map(|(drive, order)| {
        let index = model.drives.iter().position(|own| own.name.text == drive.name.text).expect("a drive");
        format!("{}: {}", drive.motion_name(order), number(Symbol::Driven(DriveId::new(index), order)))
    });
    let motion: Vec<String> = motion.collect();
    let _ = writeln!(text, "let motion = sample::Motion {{ {} }};", motion.join(", "));
    let drive = |index| number(Symbol::Drive(DriveId::new(index)));
    let mut drives: Vec<String> = (0..model.drives.len()).map(drive).collect();
    drives.extend(closures(case));
    let drives = drives.join(", ");
    let names = model.drives.iter().enumerate();
    let angles = names.map(|(index, own)| format!("{}: {}", own.name.text, drive(index)));
    let given: Vec<String> = angles.chain(motion.iter().cloned()).chain(loads.iter().cloned()).collect();
    let _ = writeln!(text, "let pose = sample::Pose::at({first}{drives});");
    for scene in scenes(linkage) {
        let functions = &linkage.functions.scenes[index_of(linkage, scene)];
        let given = |program: &Program| {
            let all = [(program.reads_motion(), "&motion"), (program.reads_loads(), "&loads")];
            all.into_iter().filter_map(|(read, what)| read.then_some(what)).collect::<Vec<_>>().join(", ")
        };
        let straight = given(&functions.direct);
        let straight = if straight.is_empty() { straight } else { format!(", {straight}") };
        let _ = writeln!(
            text,
            "println!(\"{name} {{number}} {scene} straight {{:?}}\", sample::{scene}_at({first}{drives}{straight}));"
        );
        let from_pose = given(&functions.from_pose);
        let _ = writeln!(
            text,
            "println!(\"{name} {{number}} {scene} pose {{:?}}\", pose.and_then(|pose| pose.{scene}({from_pose})));"
        );
    }
    let sides = closures(case).map_or(String::new(), |sides| format!("{sides}, "));
    let emitted = linkage_codegen::expand(declaration.parse().expect("tokens")).to_string();
    for scene in scenes(linkage) {
        text.push_str(&sweep(name, scene, scalar, &emitted, &format!("{first}{sides}"), &given));
    }
    text.push_str("Ok(())\n}\n}\n");
    text
}

/// How many positions are swept: several blocks, and one that is not full.
const POSITIONS: usize = 150;

/// The sweep of a scene, in which nothing changes: all positions have the numbers of the last, which are printed, or the first has none.
fn sweep(case: &str, scene: &str, scalar: &str, emitted: &str, first: &str, given: &[String]) -> String {
    let ty: String = scene[..1].to_uppercase() + &scene[1..] + "Path";
    let fields = |ty: &str| -> Vec<String> {
        let (_, rest) = emitted.split_once(&format!("pub struct {ty} < 'a >")).expect("the sweep's type");
        let (body, _) = rest.split_once('}').expect("its end");
        body.split("pub ").skip(1).map(|field| field.split_whitespace().next().expect("a name").to_owned()).collect()
    };
    let inputs = fields(&format!("{ty}Inputs")).into_iter().map(|name| {
        let value = given.iter().find_map(|one| one.strip_prefix(&format!("{name}: "))).expect("what is given");
        format!("{name}: Series::Constant({value})")
    });
    let inputs: Vec<String> = inputs.collect();
    let results = fields(&ty);
    let rooms = (0..results.len()).map(|_| format!("[0.0{scalar}; {POSITIONS}]")).collect::<Vec<_>>().join(", ");
    let taken = (0..results.len()).map(|index| format!("room_{index}")).collect::<Vec<_>>().join(", ");
    let given_out: Vec<String> =
        results.iter().enumerate().map(|(index, name)| format!("{name}: room_{index}")).collect();
    format!(
        "let mut room = [{rooms}];
         let [{taken}] = &mut room;
         let swept = sample::{scene}_path({first}&sample::{ty}Inputs {{ {} }}, sample::{ty} {{ {} }});
         assert!(swept.is_err() || room.iter().all(|row| row.iter().all(|x| x.to_bits() == row[{POSITIONS} - 1].to_bits())));
         println!(\"{case} {{number}} {scene} sweep {{:?}}\", swept.map(|()| room.map(|row| row[{POSITIONS} - 1])).map_err(|error| match error {{
             SweepError::Position {{ index: 0, error }} => error,
             other => panic!(\"{{other:?}}\"),
         }}));\n",
        inputs.join(", "),
        given_out.join(", ")
    )
}

/// The argument that gives the sides, if some are chosen at run time.
fn closures(Case { linkage: Linkage { model, .. }, arguments, .. }: &Case) -> Option<String> {
    let sides = model.given_closures().map(|(id, closure)| {
        let joint = &model.joint(closure.joint).name.text;
        let variants = if closure.type_name() == "Side" { ["Left", "Right"] } else { ["Ahead", "Behind"] };
        let variant = variants[usize::from(arguments.sides[id.index()] < 0.0)];
        format!("{joint}: linkage_runtime::{}::{variant}", closure.type_name())
    });
    let sides: Vec<String> = sides.collect();
    (!sides.is_empty()).then(|| format!("sample::Closures {{ {} }}", sides.join(", ")))
}

fn scenes(linkage: &Linkage) -> impl Iterator<Item = &'static str> {
    SCENES.into_iter().filter(|scene| linkage.model.scenes.iter().any(|own| own.name.text == *scene))
}

/// A crate of its own workspace, with the versions of this one.
fn write_crate(cases: &[Case]) -> PathBuf {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the workspace");
    let at = Path::new(env!("CARGO_TARGET_TMPDIR")).join("emitted_random");
    // What earlier runs have left there is not compiled.
    let _ = std::fs::remove_dir_all(at.join("src"));
    std::fs::create_dir_all(at.join("src/bin")).expect("a directory");
    let manifest = format!(
        "[package]\nname = \"emitted_random\"\nedition = \"2024\"\n\n[dependencies]\nlinkage-runtime = {{ path = {:?} }}\n\n\
         [workspace]\n\n[profile.dev]\ndebug = false\nincremental = false\n",
        workspace.join("linkage-runtime").to_string_lossy()
    );
    std::fs::write(at.join("Cargo.toml"), manifest).expect("a manifest");
    std::fs::copy(workspace.join("Cargo.lock"), at.join("Cargo.lock")).expect("a lock file");
    for (name, cases) in PROGRAMS.iter().zip(cases.chunks(cases.len().div_ceil(PROGRAMS.len()))) {
        let mut main: String = cases.iter().map(module).collect();
        main.push_str("fn main() {\n");
        for Case { name, .. } in cases {
            let _ = writeln!(main, "{name}::run();");
        }
        main.push_str("}\n");
        std::fs::write(at.join("src/bin").join(name).with_extension("rs"), main).expect("a source");
    }
    at
}

/// Programs that are compiled side by side.
const PROGRAMS: [&str; 4] = ["first", "second", "third", "fourth"];

/// What all programs print.
fn run(at: &Path) -> String {
    let target = at.join("target");
    let cargo = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--offline"])
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("RUSTFLAGS")
        .current_dir(at)
        .output()
        .expect("cargo");
    assert!(cargo.status.success(), "{}", String::from_utf8_lossy(&cargo.stderr));
    let printed = PROGRAMS.map(|name| {
        let output = Command::new(target.join("debug").join(name)).output().expect("a program");
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    });
    printed.concat()
}

/// What the interpreter finds.
fn interpreted<T: Number>(linkage: &Linkage, arguments: &Arguments, scene: &str, form: &str) -> Told {
    let values = || -> Result<Vec<T>, Fault> {
        checked_prepared::<T>(linkage, arguments)?;
        if form == "new" {
            return Ok(Vec::new());
        }
        if form != "pose" {
            return direct(linkage, &linkage.functions.scenes[index_of(linkage, scene)].direct, arguments);
        }
        let kept = checked_pose(linkage, arguments)?;
        values_from_kept(linkage, scene, &kept, arguments).map(|(_, values)| values)
    };
    told(values())
}

#[test]
#[ignore = "long"]
fn random_linkages_compile_to_what_the_interpreter_computes() {
    let cases = cases();
    assert!(cases.len() > 40, "{} linkages", cases.len());
    let printed = run(&write_crate(&cases));
    let (mut results, mut controlled, mut failures) = (0, 0, 0);
    // With one number in place of another: how many results, and errors.
    let mut replaced = (0, 0);
    for case in &cases {
        let lines = printed.lines().filter_map(|line| line.strip_prefix(case.name.as_str())?.strip_prefix(' '));
        let arguments = case.all_arguments();
        let mut seen = vec![0; arguments.len()];
        let all = 3 * scenes(&case.linkage).count();
        for line in lines {
            let mut words = line.splitn(4, ' ');
            let mut word = || words.next().unwrap_or_else(|| panic!("{line}"));
            let (number, scene, form, printed) = (word().parse::<usize>().expect("a number"), word(), word(), word());
            let (own, expected) = if case.scalar == "f32" {
                let expected = interpreted::<Single>(&case.linkage, &arguments[number], scene, form);
                (told_as_printed::<Single>(printed), expected)
            } else {
                let expected = interpreted::<Double>(&case.linkage, &arguments[number], scene, form);
                (told_as_printed::<Double>(printed), expected)
            };
            let context =
                || format!("{scene} {form}: {printed}, {:?}\n{}", arguments[number].instead, case.declaration);
            assert_eq!(own, expected, "{}", context());
            let is_finite = |found: &Vec<u64>| found.iter().all(|bits| f64::from_bits(*bits).is_finite());
            assert!(own.as_ref().is_ok_and(is_finite) || own.is_err(), "{}", context());
            seen[number] += if form == "new" { all } else { 1 };
            if number > 0 {
                replaced.0 += usize::from(own.is_ok());
                replaced.1 += usize::from(own.is_err());
            } else {
                failures += usize::from(form == "new");
                controlled += usize::from(scene == "control" && own.is_ok());
                results += usize::from(own.is_ok());
            }
        }
        assert!(seen.iter().all(|seen| *seen == all), "{seen:?}, {all}\n{}", case.declaration);
    }
    println!(
        "{} linkages, {results} equal results, {controlled} of them equations of motion, {failures} with parameters out of range; \
         with one number replaced {} equal results, {} equal errors",
        cases.len(),
        replaced.0,
        replaced.1
    );
    assert!(results > 300 && controlled > 40, "{results} results, {controlled} equations of motion");
    assert!(replaced.0 > 1000 && replaced.1 > 1000, "{replaced:?}");
}
