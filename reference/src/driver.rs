//! The crate that computes: all declarations as modules, and a program that prints what their scenes give.
//!
//! It is the emitted code that is held against the answers, compiled as anyone's would be. A module whose code does not compile is
//! taken out, so that it costs no other file its verdict.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use linkage_codegen::graph::Order;
use linkage_codegen::model::Sweep;
use linkage_codegen::program::Program;

use crate::closure::Closed;
use crate::declaration::Declaration;

/// A mechanism to be computed.
pub(crate) struct Case<'a> {
    pub(crate) declaration: &'a Declaration,
    pub(crate) closed: &'a Closed,
}

/// The two functions of a scene.
pub(crate) const FORMS: [&str; 2] = ["pose", "straight"];

/// The form whose numbers a sweep has: links that are placed by iteration are searched from the pose before.
pub(crate) fn form_of_sweep(closed: &Closed) -> &'static str {
    FORMS[usize::from(closed.linkage.functions.near.is_none())]
}

/// The numbers of a sweep at a position.
pub(crate) const SWEPT: &str = "swept";
/// How many positions a sweep went through.
pub(crate) const ANSWERED: &str = "answered";

/// What the program printed for a mechanism.
#[derive(Debug, Default)]
pub(crate) struct Printed {
    /// By position, scene and form.
    pub(crate) results: BTreeMap<(usize, String, String), String>,
    /// Why its code did not compile.
    pub(crate) broken: Option<String>,
}

/// Compiles and runs all mechanisms. `name` tells crates of different folders from each other.
pub(crate) fn run(cases: &[Case<'_>], name: &str) -> Result<Vec<Printed>, String> {
    let mut printed: Vec<Printed> = cases.iter().map(|_| Printed::default()).collect();
    let home = target().join("reference");
    let at = home.join(name);
    loop {
        let sound: Vec<usize> = (0..cases.len()).filter(|case| printed[*case].broken.is_none()).collect();
        if sound.is_empty() {
            return Ok(printed);
        }
        write_crate(cases, &sound, &at, name).map_err(|error| format!("{}: {error}", at.display()))?;
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let output = Command::new(cargo)
            .args(["run", "--quiet", "--offline"])
            .env("CARGO_TARGET_DIR", home.join("target"))
            .env_remove("RUSTFLAGS")
            .current_dir(&at)
            .output()
            .map_err(|error| format!("cargo: {error}"))?;
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.success() {
            collect(&String::from_utf8_lossy(&output.stdout), &mut printed);
            return Ok(printed);
        }
        let broken = broken(&said);
        if broken.is_empty() {
            return Err(format!("the program of all mechanisms fails:\n{said}"));
        }
        for (case, message) in broken {
            if let Some(printed) = printed.get_mut(case) {
                printed.broken = Some(message);
            }
        }
    }
}

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| workspace().join("target"), PathBuf::from)
}

/// A crate of its own workspace, with the versions of this one.
fn write_crate(cases: &[Case<'_>], sound: &[usize], at: &Path, name: &str) -> std::io::Result<()> {
    let workspace = workspace().canonicalize()?;
    let source = at.join("src");
    if source.exists() {
        std::fs::remove_dir_all(&source)?;
    }
    std::fs::create_dir_all(&source)?;
    let manifest = format!(
        "[package]\nname = \"reference-{name}\"\nedition = \"2024\"\n\n\
         [dependencies]\nlinkage-runtime = {{ path = \"{}\" }}\n\n\
         # The compiler of declarations is in here.\n[profile.dev.build-override]\nopt-level = 2\n\n[workspace]\n",
        workspace.join("linkage-runtime").display()
    );
    std::fs::write(at.join("Cargo.toml"), manifest)?;
    std::fs::copy(workspace.join("Cargo.lock"), at.join("Cargo.lock"))?;
    let (mut modules, mut calls) = (String::new(), String::new());
    for case in sound {
        let _ = writeln!(modules, "mod case_{case};");
        let _ = writeln!(calls, "    case_{case}::run();");
        std::fs::write(source.join(format!("case_{case}.rs")), module(*case, &cases[*case]))?;
    }
    std::fs::write(source.join("main.rs"), format!("{modules}\nfn main() {{\n{calls}}}\n"))
}

/// A linkage, and a function that prints what its scenes give at each position.
fn module(index: usize, case: &Case<'_>) -> String {
    let Case { declaration, closed } = case;
    let functions = &closed.linkage.functions.scenes;
    let scenes = &closed.linkage.model.scenes;
    let mut text = String::new();
    let _ = writeln!(
        text,
        "#![allow(dead_code, unused_imports, unused_variables)]\nuse linkage_runtime::{{Series, SweepError, Vector2, linkage}};"
    );
    let _ = writeln!(text, "\nlinkage! {{\n{}}}\n\npub fn run() {{", closed.text);
    let drives = declaration.positions.first().map_or(0, Vec::len);
    let _ = writeln!(
        text,
        "    let positions: [[f64; {drives}]; {}] = {:?};",
        declaration.positions.len(),
        declaration.positions
    );
    if !declaration.run_time_loads.is_empty() {
        let _ = writeln!(text, "    let loads = [");
        for position in 0..declaration.positions.len() {
            let fields = declaration.run_time_loads.iter();
            let fields =
                fields.map(|(name, values)| format!("{name}: {}", values.get(position).map_or("", String::as_str)));
            let _ = writeln!(text, "        mechanism::Loads {{ {} }},", fields.collect::<Vec<_>>().join(", "));
        }
        let _ = writeln!(text, "    ];");
    }
    let model = &closed.linkage.model;
    let motion = linkage_codegen::emit::given_motion(model).into_iter().filter_map(|(drive, order)| {
        let index = model.drives.iter().position(|own| own.name.text == drive.name.text)?;
        let [rate, acceleration] = declaration.motion.get(index)?;
        let value = if order == Order::Rate { rate } else { acceleration };
        Some(format!("{}: {value:?}", drive.motion_name(order)))
    });
    let motion: Vec<String> = motion.collect();
    if !motion.is_empty() {
        let _ = writeln!(text, "    let motion = mechanism::Motion {{ {} }};", motion.join(", "));
    }
    for sweep in &model.sweeps {
        swept(&mut text, index, case, sweep);
    }
    let arguments: Vec<String> = (0..drives).map(|drive| format!("at[{drive}]")).collect();
    let arguments = arguments.join(", ");
    // Where groups are placed by iteration, a sweep goes from pose to pose.
    let moves = closed.linkage.functions.near.is_some();
    if moves {
        let _ = writeln!(text, "    let mut before: Option<mechanism::Pose> = None;");
    }
    let _ = writeln!(text, "    for (position, at) in positions.iter().enumerate() {{");
    if !declaration.run_time_loads.is_empty() {
        let _ = writeln!(text, "        let loads = loads[position];");
    }
    let _ = writeln!(text, "        let pose = mechanism::Pose::at({arguments});");
    if moves {
        let _ = writeln!(text, "        let pose = before.map_or(pose, |before| before.moved_to({arguments}));");
        let _ = writeln!(text, "        before = pose.ok().or(before);");
    }
    for (scene, function) in scenes.iter().zip(functions) {
        let scene = &scene.name.text;
        let given = |program: &Program| {
            let all = [(program.reads_motion(), "&motion"), (program.reads_loads(), "&loads")];
            all.into_iter().filter_map(|(read, what)| read.then_some(what)).collect::<Vec<_>>().join(", ")
        };
        let from_pose = given(&function.from_pose);
        let straight = given(&function.direct);
        let straight = if straight.is_empty() { straight } else { format!(", {straight}") };
        for (form, call) in FORMS.into_iter().zip([
            format!("pose.and_then(|pose| pose.{scene}({from_pose}))"),
            format!("mechanism::{scene}_at({arguments}{straight})"),
        ]) {
            let _ = writeln!(text, "        println!(\"{index} {{position}} {scene} {form} {{:?}}\", {call});");
        }
    }
    text.push_str("    }\n}\n");
    text
}

/// The function of a sweep, called once for all positions, and the numbers that it gives.
fn swept(text: &mut String, index: usize, case: &Case<'_>, sweep: &Sweep) {
    let Case { declaration, closed } = case;
    let model = &closed.linkage.model;
    let scene = &model.scenes[sweep.scene];
    let count = declaration.positions.len();
    let mut inputs = String::new();
    for (place, drive) in model.drives.iter().enumerate() {
        let name = &drive.name.text;
        let _ = writeln!(text, "    let each_{name} = positions.map(|at| at[{place}]);");
        let _ = write!(inputs, "{name}: Series::Each(&each_{name}), ");
    }
    for (drive, order) in model.swept_motion(scene) {
        let name = drive.motion_name(order);
        let _ = write!(inputs, "{name}: Series::Constant(motion.{name}), ");
    }
    for load in model.swept_loads(scene) {
        let name = &model.load(load).name.text;
        let _ = writeln!(text, "    let each_{name} = loads.map(|loads| loads.{name});");
        let _ = write!(inputs, "{name}: Series::Each(&each_{name}), ");
    }
    let paths = closed.linkage.plan.scenes[sweep.scene].leaves();
    let slices: Vec<String> = paths.into_iter().map(|(path, _)| path.replace('.', "_")).collect();
    let (mut results, mut fields, mut values) = (String::new(), String::new(), String::new());
    for (place, name) in slices.iter().enumerate() {
        let _ = writeln!(text, "    let mut slice_{place} = [0.0f64; {count}];");
        let _ = write!(results, "{name}: &mut slice_{place}, ");
        let _ = write!(fields, "{name}: {{:?}}, ");
        let _ = write!(values, "slice_{place}[position], ");
    }
    let name = &sweep.name.text;
    let [inputs_type, results_type] = sweep.types();
    let _ = writeln!(
        text,
        "    let inputs = mechanism::{inputs_type} {{ {inputs}}};\n    \
             let outcome = mechanism::{name}(&inputs, mechanism::{results_type} {{ {results}}});\n    \
             let (answered, said) = match outcome {{\n        \
                 Ok(()) => ({count}, {count}.to_string()),\n        \
                 Err(SweepError::Position {{ index, .. }}) => (index, index.to_string()),\n        \
                 Err(error) => (0, error.to_string()),\n    \
             }};\n    \
             println!(\"{index} 0 {name} {ANSWERED} {{said}}\");\n    \
             for position in 0..answered {{\n        \
                 println!(\"{index} {{position}} {scene} {SWEPT} Ok(Swept {{{{ {fields}}}}})\", {values});\n    \
             }}",
        scene = scene.name.text,
    );
}

fn collect(output: &str, printed: &mut [Printed]) {
    for line in output.lines() {
        let mut words = line.splitn(5, ' ');
        let mut next = || words.next().unwrap_or_default();
        let (case, position, scene, form, result) = (next(), next(), next(), next(), next());
        let (Ok(case), Ok(position)) = (case.parse::<usize>(), position.parse()) else { continue };
        if let Some(printed) = printed.get_mut(case) {
            printed.results.insert((position, scene.to_owned(), form.to_owned()), result.to_owned());
        }
    }
}

/// The cases in which the compiler of Rust found errors, each with the first one.
fn broken(said: &str) -> BTreeMap<usize, String> {
    let mut found = BTreeMap::new();
    let mut error = "";
    for line in said.lines() {
        if line.starts_with("error") {
            error = line;
        }
        let place = line.trim_start().strip_prefix("--> src/case_").and_then(|rest| rest.split_once(".rs"));
        if let (Some(case), false) = (place.and_then(|(case, _)| case.parse().ok()), error.is_empty()) {
            found.entry(case).or_insert_with(|| error.to_owned());
            error = "";
        }
        if line.starts_with("warning") {
            error = "";
        }
    }
    found
}
