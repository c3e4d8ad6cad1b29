//! Limits.
mod support;

use linkage_codegen::emit;

#[test]
fn print() {
    for path in std::env::var("DECL").unwrap().split(',') {
        let text = std::fs::read_to_string(path).unwrap();
        let linkage = support::compile(&text);
        let all = emit::equations(&linkage);
        let start = all.find("Limits\n---").unwrap_or(all.len());
        println!("{}", &all[start..all.find("Closed forms").unwrap().max(start)]);
        if let Some(i) = all.find("limits, from the param") { println!("{}", &all[i..]); }
        let code = linkage_codegen::formatted(linkage_codegen::expand(text.parse().expect("tokens"))).expect("Rust");
        let start = code.find("use ::linkage_runtime::limits").unwrap_or(code.len());
        println!("{}", &code[start..code[start..].find("pub struct Pose").map_or(code.len(), |e| start + e)]);
    }
}
