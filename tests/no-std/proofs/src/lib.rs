//! Proofs about the emitted code and the run-time crate, by building and running them for targets without an operating system.
//!
//! | test | proves |
//! |---|---|
//! | `links` | no panic can be reached, optimised or not; nothing allocates |
//! | `symbols` | a linkage in `f32` does no arithmetic in `f64` |
//! | `wasm` | the same bits under WebAssembly, which needs nothing from its host |
//! | `board` | the same bits on a Cortex-M4F and a Cortex-M3, emulated |
//! | `pinned` | the bits are those that they were, the examples' too, at every level of x86-64, and with `std`, sweeps by all registers |
//! | `size` | one scene takes little of the flash |
//! | `complete` | the functions of which all this is proved are all that are emitted |
//!
//! Each has a control: something that must fail, or must be found, so that a proof that has stopped to look is noticed.
//!
//! `cargo test` needs the targets of `rustup target add thumbv7em-none-eabihf thumbv6m-none-eabi riscv32imafc-unknown-none-elf
//! wasm32-unknown-unknown`, and Node; `cargo test -- --ignored` needs QEMU (`qemu-system-arm`).

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use no_std_linkages::{Digest, double, each_linkage, example, single};

/// All digests, computed here.
#[must_use]
pub fn native() -> Vec<(&'static str, Digest)> {
    macro_rules! digests {
        ($($name:ident = $($digest:ident)::*,)*) => { vec![$((stringify!($name), $($digest)::*())),*] };
    }
    each_linkage!(digests)
}

/// Holds lines of a name and a hash, printed elsewhere, against what is computed here.
///
/// # Panics
///
/// Where they differ.
pub fn assert_same(printed: &str, place: &str) {
    let printed: BTreeMap<&str, &str> = printed.lines().filter_map(|line| line.split_once(' ')).collect();
    let native: BTreeMap<&str, String> =
        native().into_iter().map(|(name, digest)| (name, format!("{:016x}", digest.hash))).collect();
    let native: BTreeMap<&str, &str> = native.iter().map(|(name, hash)| (*name, hash.as_str())).collect();
    assert_eq!(printed, native, "{place} (left) and this host (right) compute different bits");
}

/// The folder of the workspace.
#[must_use]
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// What cargo is asked to build: a package of this workspace.
#[derive(Clone, Copy, Debug)]
pub struct Build<'a> {
    /// The package.
    pub package: &'a str,
    /// The targets.
    pub targets: &'a [&'a str],
    /// The profile.
    pub profile: &'a str,
    /// Flags of the compiler for the targets, or nothing.
    pub flags: &'a str,
    /// Further arguments.
    pub arguments: &'a [&'a str],
}

impl Build<'_> {
    /// Where it is built: not in the folder that the cargo that runs the tests may hold locked.
    #[must_use]
    pub fn folder(self, target: &str) -> PathBuf {
        target_folder().join(target).join(if self.profile == "dev" { "debug" } else { self.profile })
    }

    /// Builds it.
    ///
    /// # Errors
    ///
    /// What cargo printed.
    ///
    /// # Panics
    ///
    /// If there is no cargo.
    pub fn run(self) -> Result<(), String> {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(workspace()).env("CARGO_TERM_COLOR", "never");
        cargo.args(["build", "--locked", "--package", self.package, "--profile", self.profile]);
        cargo.args(self.arguments).arg("--target-dir").arg(target_folder());
        for target in self.targets {
            cargo.args(["--target", target]);
        }
        if !self.flags.is_empty() {
            cargo.env("RUSTFLAGS", self.flags);
        }
        let output = cargo.output().expect("cargo runs");
        if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
    }

    /// Builds it.
    ///
    /// # Panics
    ///
    /// If it does not build, with what cargo printed.
    pub fn expect(self) {
        if let Err(message) = self.run() {
            panic!(
                "{} does not build for {} in the profile {}:\n{message}",
                self.package,
                self.targets.join(", "),
                self.profile
            );
        }
    }
}

fn target_folder() -> PathBuf {
    workspace().join("target").join("proofs")
}

/// What a program printed.
///
/// # Panics
///
/// If it cannot be started, with how to install it, or fails.
#[must_use]
pub fn printed(command: &mut Command, install: &str) -> String {
    let Output { status, stdout, stderr } =
        command.output().unwrap_or_else(|error| panic!("{}: {error}; {install}", command.get_program().display()));
    let (stdout, stderr) =
        (String::from_utf8_lossy(&stdout).into_owned(), String::from_utf8_lossy(&stderr).into_owned());
    assert!(status.success(), "{command:?}: {status}\n{stdout}{stderr}");
    stdout
}
