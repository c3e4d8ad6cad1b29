//! The bits of all linkages, the project's examples among them, are those in `digests.txt`: a change of what is emitted that changes a
//! number is seen here, on whatever machine.
//!
//! Where numbers are meant to change: `cargo run --release --package no-std-proofs > proofs/digests.txt`, or `just digests`.

use std::fs;
use std::process::Command;

use no_std_proofs::{assert_same, printed, workspace};

#[test]
fn the_bits_are_pinned() {
    assert_same(&fs::read_to_string(workspace().join("proofs/digests.txt")).expect("the file"), "`digests.txt`");
}

/// With an operating system, and without optimisation.
#[test]
fn hosted_unoptimised() {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(workspace()).args(["run", "--quiet", "--locked", "--package", "no-std-proofs"]);
    cargo.args(["--features", "std", "--target-dir"]).arg(workspace().join("target/proofs"));
    assert_same(&printed(&mut cargo, "no cargo"), "the unoptimised build with `std`");
}

/// By what compilers make of each level of x86-64: wider vectors, and operations that fuse where they may.
#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use std::arch::is_x86_feature_detected as has;
    use std::fs;
    use std::path::{Path, PathBuf};
    use std::process::Command;

    use no_std_proofs::{Build, assert_same, printed};
    use object::{Object, ObjectSymbol};

    /// A program that prints the digests, compiled for a level of x86-64.
    fn program(level: &str, features: &str) -> PathBuf {
        let target = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
        let build = Build {
            package: "no-std-proofs",
            targets: &[&target],
            profile: "release",
            flags: &format!("-C target-cpu={level}"),
            arguments: &["--features", features],
        };
        build.expect();
        build.folder(&target).join("no-std-proofs")
    }

    /// Of which scalars a program has sweeps in blocks: what they do where a check fails is a function of its own.
    fn blocks(program: &Path) -> Vec<&'static str> {
        let program = fs::read(program).expect("the program");
        let file = object::File::parse(&*program).expect("a program");
        let names: Vec<&str> = file.symbols().filter_map(|symbol| symbol.name().ok()).collect();
        assert!(!names.is_empty(), "no table of symbols");
        let swept = |scalar: &&str| names.iter().any(|name| name.contains(&format!("__private3{scalar}10one_by_one")));
        ["f32", "f64"].into_iter().filter(swept).collect()
    }

    /// Each that this processor has. Without an operating system, and with one: then sweeps are computed in blocks, by registers of each
    /// width, whatever the level.
    #[test]
    fn levels() {
        let v2 = has!("sse4.2") && has!("popcnt");
        let v3 = v2 && has!("avx2") && has!("bmi2") && has!("fma") && has!("lzcnt");
        let v4 = v3 && has!("avx512f") && has!("avx512bw") && has!("avx512cd") && has!("avx512dq") && has!("avx512vl");
        for (level, has) in [("x86-64", true), ("x86-64-v2", v2), ("x86-64-v3", v3), ("x86-64-v4", v4)] {
            if !has {
                println!("{level}: not looked at, as this processor lacks it");
                continue;
            }
            // The lowest level is what is built where nothing is said: `native_optimised`.
            if level != "x86-64" {
                let program = program(level, "");
                assert_eq!(blocks(&program), [""; 0], "a control");
                assert_same(&printed(&mut Command::new(program), "no program"), level);
                println!("{level}: the same bits");
            }
            let program = program(level, "std");
            assert_eq!(blocks(&program), ["f32", "f64"]);
            for (bytes, has) in [("16", true), ("32", v3), ("64", v4)] {
                let place = format!("{level}, with `std`, sweeps by {bytes} bytes at once");
                if has {
                    assert_same(&printed(Command::new(&program).arg(bytes), "no program"), &place);
                    println!("{place}: the same bits");
                } else {
                    println!("{place}: not looked at, as this processor lacks them");
                }
            }
        }
    }
}

#[test]
#[should_panic(expected = "compute different bits")]
fn control_another_bit_is_found() {
    let digests = fs::read_to_string(workspace().join("proofs/digests.txt")).expect("the file");
    let (rest, last) = digests.trim_end().split_at(digests.trim_end().len() - 1);
    assert_same(&format!("{rest}{}", if last == "0" { "1" } else { "0" }), "a changed digest");
}
