//! Random linkages emitted, compiled and run: the same bits as from the interpreter, from every function.
//!
//! They are written into a crate of their own, which prints what each scene gives; only that needs a run of cargo within the test.

mod support;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkage_codegen::Linkage;
use linkage_codegen::graph::Order;
use linkage_codegen::model::LoadKind;
use linkage_codegen::program::{Fault, Program};
use support::linkages::{Kind, sample};
use support::measures::values_from_kept;
use support::numbers::{Double, Single};
use support::{Arguments, Number, direct, index_of, pose};

const SCENES: [&str; 8] = ["all", "parts", "work", "whole", "speeds", "accelerations", "gains", "control"];
/// Of linkages that have mass.
const CONTROL: &str = "scene control: motion -> (M, h, rounding, M_kinetic);";

struct Case {
    name: String,
    scalar: &'static str,
    declaration: String,
    arguments: Arguments,
    linkage: Linkage,
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

/// A module with the linkage, and a function that prints what its scenes give.
fn module(case: &Case) -> String {
    let Case { name, scalar, declaration, arguments, linkage } = case;
    let model = &linkage.model;
    let number = |value: f64| format!("({value:?}f64 as {scalar})");
    let given = model.loads.iter().zip(&arguments.loads).filter(|(load, _)| load.kind.is_given_at_run_time(model));
    let loads = given.map(|(load, values)| {
        let value = match load.kind {
            LoadKind::Moment { .. } | LoadKind::Thrust { .. } => number(values[0]),
            LoadKind::Force { .. } | LoadKind::Gravity { .. } => {
                format!("Vector2::new({}, {})", number(values[0]), number(values[1]))
            }
            LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
                let place = |name| load.kind.values().iter().position(|(other, _)| *other == name).expect("a value");
                let fields = load.kind.given(model).map(|name| format!("{name}: {}", number(values[place(name) % 2])));
                format!("sample::{} {{ {} }}", load.type_name(), fields.collect::<Vec<_>>().join(", "))
            }
            LoadKind::Inertia => "()".to_owned(),
        };
        format!("{}: {value}", load.name)
    });
    let loads: Vec<String> = loads.collect();
    let params: Vec<String> = model
        .params
        .iter()
        .zip(&arguments.params)
        .map(|(p, value)| format!("{}: {}", p.name, number(*value)))
        .collect();
    let mut text =
        format!("mod {name} {{\nuse linkage_runtime::{{Error, Series, SweepError, Vector2, linkage}};\nlinkage! {{\n");
    let _ = writeln!(text, "{declaration}}}\npub fn run() -> Result<(), Error> {{");
    let mut first = String::new();
    if !params.is_empty() {
        let _ = writeln!(text, "let linkage = sample::Linkage::new(&sample::Params {{ {} }})?;", params.join(", "));
        first.push_str("&linkage, ");
    }
    if !loads.is_empty() {
        let _ = writeln!(text, "let loads = sample::Loads {{ {} }};", loads.join(", "));
    }
    let motion = linkage_codegen::emit::given_motion(model).into_iter().map(|(drive, order)| {
        let name = drive.motion_name(order);
        let index = model.drives.iter().position(|own| own.name.text == drive.name.text).expect("a drive");
        let [rate, acceleration] = arguments.motion[index];
        format!("{name}: {}", number(if order == Order::Rate { rate } else { acceleration }))
    });
    let motion: Vec<String> = motion.collect();
    let _ = writeln!(text, "let motion = sample::Motion {{ {} }};", motion.join(", "));
    let mut drives: Vec<String> = arguments.drives.iter().map(|value| number(*value)).collect();
    drives.extend(closures(case));
    let drives = drives.join(", ");
    let names = model.drives.iter().map(|drive| &drive.name.text);
    let angles = names.zip(&arguments.drives).map(|(name, value)| format!("{name}: {}", number(*value)));
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
            "println!(\"{name} {scene} straight {{:?}}\", sample::{scene}_at({first}{drives}{straight}));"
        );
        let from_pose = given(&functions.from_pose);
        let _ = writeln!(
            text,
            "println!(\"{name} {scene} pose {{:?}}\", pose.and_then(|pose| pose.{scene}({from_pose})));"
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

/// The sweep of a scene, in which nothing changes: all positions have the numbers of the last, which are printed.
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
         println!(\"{case} {scene} sweep {{:?}}\", swept.map(|()| room.map(|row| row[{POSITIONS} - 1])).map_err(|error| match error {{
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
        "[package]\nname = \"emitted_random\"\nedition = \"2024\"\n\n[dependencies]\nlinkage-runtime = {{ path = {:?} }}\n\n[workspace]\n",
        workspace.join("linkage-runtime").to_string_lossy()
    );
    std::fs::write(at.join("Cargo.toml"), manifest).expect("a manifest");
    std::fs::copy(workspace.join("Cargo.lock"), at.join("Cargo.lock")).expect("a lock file");
    for (name, cases) in PROGRAMS.iter().zip(cases.chunks(cases.len().div_ceil(PROGRAMS.len()))) {
        let mut main: String = cases.iter().map(module).collect();
        main.push_str("fn main() {\n");
        for Case { name, .. } in cases {
            let _ = writeln!(main, "if let Err(error) = {name}::run() {{ println!(\"{name} fails {{error:?}}\"); }}");
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

/// All numbers of a printed result, in the order of its fields; `None` for an error.
fn bits<T: Number>(printed: &str) -> Option<Vec<u64>> {
    let inner = printed.strip_prefix("Ok(")?;
    let parts = inner.split(|c: char| "[]{}(),: ".contains(c));
    Some(parts.filter_map(|part| part.parse::<f64>().ok()).map(|x| T::exactly(x).to_f64().to_bits()).collect())
}

fn interpreted<T: Number>(case: &Case, scene: &str, form: &str) -> Option<Vec<u64>> {
    let Case { linkage, arguments, .. } = case;
    let values: Result<Vec<T>, Fault> = if form == "pose" {
        pose(linkage, arguments)
            .and_then(|kept| values_from_kept(linkage, scene, &kept, arguments).map(|(_, values)| values))
    } else {
        direct(linkage, &linkage.functions.scenes[index_of(linkage, scene)].direct, arguments)
    };
    Some(values.ok()?.iter().map(|value| value.to_f64().to_bits()).collect())
}

#[test]
#[ignore = "long"]
fn random_linkages_compile_to_what_the_interpreter_computes() {
    let cases = cases();
    assert!(cases.len() > 40, "{} linkages", cases.len());
    let printed = run(&write_crate(&cases));
    let (mut results, mut controlled, mut failures) = (0, 0, 0);
    for case in &cases {
        let lines = printed.lines().filter_map(|line| line.strip_prefix(case.name.as_str())?.strip_prefix(' '));
        let (mut seen, all) = (0, 3 * scenes(&case.linkage).count());
        for line in lines {
            let Some((scene, rest)) = line.split_once(' ') else { panic!("{line}") };
            if scene == "fails" {
                assert!(pose::<Double>(&case.linkage, &case.arguments).is_err(), "{line}\n{}", case.declaration);
                seen = all;
                failures += 1;
                continue;
            }
            let (form, printed) = rest.split_once(' ').expect("a result");
            let (own, expected) = if case.scalar == "f32" {
                (bits::<Single>(printed), interpreted::<Single>(case, scene, form))
            } else {
                (bits::<Double>(printed), interpreted::<Double>(case, scene, form))
            };
            assert_eq!(own, expected, "{scene} {form}: {printed}\n{}", case.declaration);
            seen += 1;
            controlled += usize::from(scene == "control" && own.is_some());
            results += usize::from(own.is_some());
        }
        assert_eq!(seen, all, "{}", case.declaration);
    }
    println!(
        "{} linkages, {results} equal results, {controlled} of them equations of motion, {failures} with parameters out of range",
        cases.len()
    );
    assert!(results > 300 && controlled > 40, "{results} results, {controlled} equations of motion");
}
