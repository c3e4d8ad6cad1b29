//! Under WebAssembly: nothing is imported, for a panic neither, and all results have the bits that they have on this host.

use std::path::Path;
use std::process::Command;

use no_std_proofs::{Build, assert_same, native, printed, workspace};

const TARGET: &str = "wasm32-unknown-unknown";

fn node(module: &Path) -> Command {
    let mut node = Command::new("node");
    node.arg(workspace().join("wasm/run.mjs")).arg(module);
    node
}

fn same_bits(profile: &str) {
    let build = Build { package: "no-std-wasm", targets: &[TARGET], profile, flags: "", arguments: &[] };
    build.expect();
    let module = build.folder(TARGET).join("no_std_wasm.wasm");
    assert_same(&printed(&mut node(&module), "install Node, version 18 or later"), "WebAssembly");
}

#[test]
fn without_optimisation() {
    same_bits("dev");
}

#[test]
fn optimised() {
    same_bits("release");
}

/// The host's own bits do not depend on optimisation either.
#[test]
fn native_optimised() {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(workspace()).args(["run", "--quiet", "--locked", "--release", "--package", "no-std-proofs"]);
    cargo.arg("--target-dir").arg(workspace().join("target/proofs"));
    assert_same(&printed(&mut cargo, "no cargo"), "the optimised build");
}

#[test]
fn control_most_poses_have_answers() {
    for (name, digest) in native() {
        let (answers, refusals) = (digest.answers, digest.refusals);
        println!("{name}: {answers} answers, {refusals} refusals");
        // The examples are asked for poses that they have, but for a dead centre and the press's crank below its ram's lowest place.
        let refused = if name.starts_with("example") { answers > 50 * refusals } else { refusals > 50 };
        assert!(name.ends_with("math") || answers > refusals && refused, "{name}: {digest:?}");
    }
}

#[test]
fn control_a_panic_is_an_import() {
    let build = Build {
        package: "no-std-wasm",
        targets: &[TARGET],
        profile: "release",
        flags: "",
        arguments: &["--example", "panics"],
    };
    build.expect();
    let output = node(&build.folder(TARGET).join("examples/panics.wasm")).output().expect("Node runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && message.contains("a_panic_is_reachable"), "{message}");
}
