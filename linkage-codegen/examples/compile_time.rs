//! How long the compiler takes, as a library call on the declaration of an example: `cargo run --example compile_time six_bar`.
//!
//! The macro runs unoptimised for its users unless they have optimised `build-override` in a profile: with `--profile unoptimised` and with
//! `--release`. The least of many times is printed: others are those of a busy machine.

use std::path::Path;
use std::time::{Duration, Instant};

use linkage_codegen::{analyse, expand, formatted};
use proc_macro2::TokenStream;

fn least(times: u32, mut run: impl FnMut()) -> Duration {
    let time = |run: &mut dyn FnMut()| {
        let start = Instant::now();
        run();
        start.elapsed()
    };
    (0..times).map(|_| time(&mut run)).min().unwrap_or_default()
}

/// The declaration in an example's file.
fn declaration(example: &str) -> Result<TokenStream, Box<dyn std::error::Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(example).with_extension("rs");
    let file = syn::parse_file(&std::fs::read_to_string(path)?)?;
    let declared = file.items.into_iter().find_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(item.mac.tokens),
        _ => None,
    });
    declared.ok_or_else(|| format!("the example {example} declares no linkage").into())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let all = ["four_bar", "slider_crank", "three_loads", "six_bar"].map(String::from);
    for example in if given.is_empty() { all.to_vec() } else { given } {
        let tokens = declaration(&example)?;
        let source = formatted(expand(tokens.clone()))?;
        let understood = least(20, || drop(analyse(tokens.clone())));
        let whole = least(20, || drop(expand(tokens.clone())));
        println!(
            "{example:<14} {:>6.1} ms; of that up to the functions {:>6.1} ms; {} lines of code",
            whole.as_secs_f64() * 1e3,
            understood.as_secs_f64() * 1e3,
            source.lines().count()
        );
    }
    Ok(())
}
