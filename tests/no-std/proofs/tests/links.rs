//! No panic can be reached, and nothing allocates.
//!
//! The handler of panics calls a function that is defined nowhere, and there is no allocator: a program with a panic that
//! can be reached does not link, one that allocates does not build. The programs call everything that is emitted, with
//! numbers of which the compiler knows nothing. Not among it: formatting of errors and of the equations' text, and `==` of
//! vectors, which are the standard library's and nalgebra's.

use no_std_proofs::Build;

const TARGETS: &[&str] = &["thumbv7em-none-eabihf", "thumbv6m-none-eabi", "riscv32imafc-unknown-none-elf"];

const PROGRAMS: &[&str] = &["--bin", "double", "--bin", "single", "--bin", "torque"];

fn firmware<'a>(profile: &'a str, arguments: &'a [&'a str]) -> Build<'a> {
    Build { package: "no-std-firmware", targets: TARGETS, profile, flags: "", arguments }
}

/// Unoptimised, with overflow checks and debug assertions.
#[test]
fn without_optimisation() {
    firmware("dev", PROGRAMS).expect();
}

#[test]
fn optimised() {
    firmware("release", PROGRAMS).expect();
}

/// For size, across crates, with overflow checks and debug assertions.
#[test]
fn small() {
    firmware("small", PROGRAMS).expect();
}

#[test]
fn control_a_panic_does_not_link() {
    for profile in ["dev", "release"] {
        let message =
            firmware(profile, &["--features", "controls", "--bin", "panics"]).run().expect_err("it has a panic");
        assert!(message.contains("undefined symbol: a_panic_is_reachable"), "{message}");
    }
}

#[test]
fn control_an_allocation_does_not_build() {
    let message = firmware("dev", &["--features", "controls", "--bin", "allocates"]).run().expect_err("it allocates");
    assert!(message.contains("no global memory allocator found"), "{message}");
}
