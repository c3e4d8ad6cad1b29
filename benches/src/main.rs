//! Measures what `linkage!` emits against closed forms by hand and general solutions: time, and error against 256 binary
//! digits.
//!
//! `README.md` beside the manifest says how to run it and how to read what it prints.

mod exact;
mod expansion;
mod expert;
mod generators;
mod harness;
mod instructions;
mod items;
mod linkages;
mod newton;
mod pareto;
mod picture;
mod sweeps;
mod textbook;

use std::process::ExitCode;
use std::time::Duration;

use crate::harness::{Mode, Timing, agree, measure};
use crate::items::{Extent, Item, chosen};

/// What the command line can be; `--once` is how `--instructions` calls this program again.
const USAGE: &str = "\
linkage-bench [--quick] [--chained] [--shuffled] [ITEM …]
linkage-bench --sweeps [--quick]
linkage-bench --pareto [--quick] [FILE.svg]
linkage-bench --instructions [ITEM …]
linkage-bench --expansion [--quick]
linkage-bench --generators LIBRARY [--quick] [--chained] [--shuffled] [ITEM …]
linkage-bench --once ITEM METHOD SWEEPS [independent | chained | empty]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Does what the command line asks for.
fn run(arguments: &[String]) -> Result<(), String> {
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if let ["--once", id, method, sweeps, rest @ ..] = arguments.as_slice() {
        let mode = match rest {
            [] | ["independent"] => Mode::Independent,
            ["chained"] => Mode::Chained,
            ["empty"] => Mode::Empty,
            _ => return Err(USAGE.into()),
        };
        return instructions::once(id, method, sweeps.parse().map_err(|_| USAGE)?, mode);
    }
    let mut arguments = arguments;
    if let ["--generators", library, ..] = arguments.as_slice() {
        generators::load(library)?;
        arguments.drain(..2);
    }
    let (options, ids): (Vec<&str>, Vec<&str>) = arguments.into_iter().partition(|argument| argument.starts_with("--"));
    let has = |option| options.contains(&option);
    let apart: Vec<&str> =
        ["--instructions", "--sweeps", "--expansion", "--pareto"].into_iter().filter(|option| has(option)).collect();
    // With which other options each goes, and how many items or files it takes.
    let (with, most): (&[&str], usize) = match apart.as_slice() {
        [] => (&["--quick", "--chained", "--shuffled"], usize::MAX),
        ["--instructions"] => (&[], usize::MAX),
        ["--pareto"] => (&["--quick"], 1),
        ["--sweeps" | "--expansion"] => (&["--quick"], 0),
        _ => return Err(USAGE.into()),
    };
    if ids.len() > most || !options.iter().all(|option| with.contains(option) || apart.contains(option)) {
        return Err(USAGE.into());
    }
    if has("--instructions") {
        return instructions::print(&ids);
    }
    let quick = has("--quick");
    if has("--expansion") {
        println!("{}", processor());
        return expansion::print(if quick { 3 } else { 21 });
    }
    if has("--sweeps") {
        println!("{}", processor());
        return sweeps::print(if quick { 201 } else { 2001 });
    }
    let (rounds, least) = if quick { (101, Duration::from_micros(100)) } else { (1001, Duration::from_micros(200)) };
    if has("--pareto") {
        let machine = processor();
        println!("{machine}; {rounds} rounds");
        return pareto::print(rounds, least, &machine, ids.first().copied());
    }
    let extent = Extent::judged(has("--shuffled"));
    let mode = if has("--chained") { Mode::Chained } else { Mode::Independent };
    println!(
        "{}; {rounds} rounds; {} poses {}, {}",
        processor(),
        extent.timed,
        if extent.shuffled { "in disorder" } else { "along a turn" },
        if mode == Mode::Chained { "each waits for the one before" } else { "independent of each other" }
    );
    for mut item in chosen(extent, &ids)? {
        agree(&item)?;
        let timings = measure(&mut item, rounds, least, mode);
        print(&item, &timings);
    }
    Ok(())
}

/// The processor's name where the system tells it, and the widest instructions that this program was compiled for.
fn processor() -> String {
    let system = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = system.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let features = [
        (cfg!(target_feature = "avx512f"), "AVX-512"),
        (cfg!(target_feature = "fma"), "FMA"),
        (cfg!(target_feature = "avx2"), "AVX2"),
    ];
    let compiled: Vec<&str> = features.into_iter().filter_map(|(has, name)| has.then_some(name)).collect();
    let compiled = if compiled.is_empty() { "the baseline".into() } else { compiled.join(", ") };
    format!("{}, compiled for {compiled}", name.map_or(std::env::consts::ARCH, |(_, name)| name))
}

/// Times beside errors.
fn print(item: &Item, timings: &[Timing]) {
    println!("\n{}  {}", item.id, item.title);
    println!("  {:<28} {:>8} {:>8}  {:<15} {:>9} {:>9}", "", "ns", "ratio", " quartiles", "force", "torque");
    for (competitor, timing) in item.competitors.iter().zip(timings) {
        let Timing { nanoseconds, ratio, quartiles: (low, high) } = timing;
        let quartiles = format!("{low:.3} – {high:.3}");
        let force = competitor.errors.force.map_or(String::from("–"), |error| format!("{error:.1e}"));
        println!(
            "  {:<28} {nanoseconds:>8.2} {ratio:>8.3}  {quartiles:<15} {force:>9} {:>9.1e}",
            competitor.method, competitor.errors.torque
        );
    }
}
