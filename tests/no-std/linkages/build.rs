//! Takes the declarations of the project's examples out of their sources, as they stand there: a file `<example>.rs` for each.
//!
//! Left out are `emit source;` and scenes of the method `verify`, which need an operating system.

use std::path::Path;
use std::{env, fs};

fn main() {
    let examples = Path::new(&env::var("CARGO_MANIFEST_DIR").expect("by cargo")).join("../../../examples");
    println!("cargo::rerun-if-changed={}", examples.display());
    let out = env::var("OUT_DIR").expect("by cargo");
    for entry in fs::read_dir(&examples).expect("the examples") {
        let path = entry.expect("a file").path();
        let source = fs::read_to_string(&path).expect("text");
        let start = source.find("linkage! {").unwrap_or_else(|| panic!("{} declares no linkage", path.display()));
        // The declaration ends with the first brace at the beginning of a line.
        let length = source[start..].find("\n}").expect("the end of the declaration") + 2;
        let hosted = |line: &&str| line.trim() == "emit source;" || line.trim_end().ends_with(" verify;");
        let lines: Vec<&str> = source[start..start + length].lines().filter(|line| !hosted(line)).collect();
        let name = path.file_name().expect("a name");
        fs::write(Path::new(&out).join(name), lines.join("\n") + "\n").expect("a folder to write to");
    }
}
