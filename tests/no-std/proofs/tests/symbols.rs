//! A linkage in `f32` does no arithmetic in `f64`: these targets have no double precision in hardware, so every operation
//! of it is a call of a routine that would stand in the program's table of symbols.

use no_std_proofs::Build;
use object::{Object, ObjectSymbol};

const TARGETS: &[&str] = &["thumbv7em-none-eabihf", "thumbv6m-none-eabi", "riscv32imafc-unknown-none-elf"];

/// Routines of double precision by the names of GCC's; the Arm run-time interface has others.
const ROUTINES: &[&str] = &[
    "__adddf3",
    "__subdf3",
    "__muldf3",
    "__divdf3",
    "__negdf2",
    "__powidf2",
    "__eqdf2",
    "__nedf2",
    "__ltdf2",
    "__ledf2",
    "__gtdf2",
    "__gedf2",
    "__unorddf2",
    "__cmpdf2",
    "__extendsfdf2",
    "__truncdfsf2",
    "__floatsidf",
    "__floatunsidf",
    "__floatdidf",
    "__floatundidf",
    "__fixdfsi",
    "__fixdfdi",
    "__fixunsdfsi",
    "__fixunsdfdi",
];

/// Whether a symbol, mangled or not, is of double precision: routines, the square root, the run-time crate's own functions.
fn is_double(symbol: &str) -> bool {
    symbol.starts_with("__aeabi_d")
        || symbol.starts_with("__aeabi_") && symbol.ends_with("2d")
        || symbol == "sqrt"
        || symbol.contains("4math3f64")
        || ROUTINES.iter().any(|routine| symbol.contains(routine))
}

/// For every target, optimised and not: the symbols of double precision in a program.
fn doubles(program: &str) -> Vec<(String, Vec<String>)> {
    let mut all = Vec::new();
    for profile in ["dev", "release"] {
        let build =
            Build { package: "no-std-firmware", targets: TARGETS, profile, flags: "", arguments: &["--bin", program] };
        build.expect();
        for target in TARGETS {
            let file = std::fs::read(build.folder(target).join(program)).expect("the program");
            let file = object::File::parse(&*file).expect("an ELF file");
            let names: Vec<&str> = file.symbols().filter_map(|symbol| symbol.name().ok()).collect();
            assert!(names.contains(&"_start"), "no table of symbols");
            let found = names.into_iter().filter(|name| is_double(name)).map(str::to_owned).collect();
            all.push((format!("{target}, {profile}"), found));
        }
    }
    all
}

#[test]
fn single_precision_has_no_double() {
    for (place, found) in doubles("single") {
        assert!(found.is_empty(), "{place}: {found:#?}");
    }
}

#[test]
fn control_double_precision_is_found() {
    for (place, found) in doubles("double") {
        for names in
            [["__aeabi_dadd", "__adddf3"], ["__aeabi_dmul", "__muldf3"], ["__aeabi_ddiv", "__divdf3"], ["sqrt"; 2]]
        {
            assert!(
                found.iter().any(|name| names.contains(&name.as_str())),
                "{place}: none of {names:?} in {found:#?}"
            );
        }
    }
}
