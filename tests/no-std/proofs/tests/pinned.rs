//! The bits of all linkages, the project's examples among them, are those in `digests.txt`: a change of what is emitted that changes a
//! number is seen here, on whatever machine.
//!
//! Where numbers are meant to change: `cargo run --package no-std-proofs > proofs/digests.txt`.

use std::process::Command;

use no_std_proofs::{assert_same, printed, workspace};

#[test]
fn the_bits_are_pinned() {
    assert_same(&std::fs::read_to_string(workspace().join("proofs/digests.txt")).expect("the file"), "`digests.txt`");
}

/// By what compilers make of each level of x86-64 that this processor has: wider vectors, and operations that fuse where they may.
#[test]
#[cfg(target_arch = "x86_64")]
fn levels_of_x86_64() {
    use std::arch::is_x86_feature_detected as has;

    let levels = [
        ("x86-64-v2", has!("sse4.2") && has!("popcnt")),
        ("x86-64-v3", has!("avx2") && has!("bmi2") && has!("fma") && has!("lzcnt")),
        ("x86-64-v4", has!("avx512f") && has!("avx512bw") && has!("avx512cd") && has!("avx512dq") && has!("avx512vl")),
    ];
    for (level, has) in levels {
        if !has {
            println!("{level}: not looked at, as this processor lacks it");
            continue;
        }
        let target = format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(workspace()).env("RUSTFLAGS", format!("-C target-cpu={level}"));
        cargo.args(["run", "--quiet", "--locked", "--release", "--package", "no-std-proofs", "--target", &target]);
        cargo.arg("--target-dir").arg(workspace().join("target/proofs").join(level));
        assert_same(&printed(&mut cargo, "no cargo"), level);
        println!("{level}: the same bits");
    }
}

#[test]
#[should_panic(expected = "compute different bits")]
fn control_another_bit_is_found() {
    let digests = std::fs::read_to_string(workspace().join("proofs/digests.txt")).expect("the file");
    let (rest, last) = digests.trim_end().split_at(digests.trim_end().len() - 1);
    assert_same(&format!("{rest}{}", if last == "0" { "1" } else { "0" }), "a changed digest");
}
