//! Counts instructions by running this program under callgrind: figures that do not depend on the machine's mood.

use std::process::{Command, Stdio};

use crate::harness::Mode;
use crate::items::{Extent, chosen};

/// Goes through an item's table with one competitor; what callgrind watches.
pub(crate) fn once(id: &str, method: &str, sweeps: u32, mode: Mode) -> Result<(), String> {
    let mut items = chosen(EXTENT, &[id])?;
    let mut competitors = items.iter_mut().flat_map(|item| &mut item.competitors);
    let competitor =
        competitors.find(|competitor| competitor.method == method).ok_or_else(|| format!("{id} has no {method}"))?;
    competitor.sweep(sweeps, mode);
    Ok(())
}

/// Poses of a sweep: many more than the branch-free calls need, few enough for a simulated processor.
const POSES: u32 = 512;

/// Runs without exact solutions, which would only cost time here.
const EXTENT: Extent = Extent { timed: POSES, judged: false, shuffled: false, single: false };

/// Prints the instructions of one call of every competitor, the loop around it taken off.
pub(crate) fn print(ids: &[&str]) -> Result<(), String> {
    let version = Command::new("valgrind").arg("--version").stdin(Stdio::null()).output();
    if !version.is_ok_and(|version| version.status.success()) {
        return Err("--instructions counts by callgrind: install `valgrind`".into());
    }
    for item in &chosen(EXTENT, ids)? {
        println!("\n{}  {}", item.id, item.title);
        println!("  {:<28} {:>12}", "", "instructions");
        for competitor in &item.competitors {
            let call = per_call(item.id, competitor.method, "independent")?;
            let empty = per_call(item.id, competitor.method, "empty")?;
            println!("  {:<28} {:>12.0}", competitor.method, call - empty);
        }
    }
    Ok(())
}

/// Instructions of a call with its share of the loop: what four more sweeps cost more, so that nothing else counts.
fn per_call(id: &str, method: &str, mode: &str) -> Result<f64, String> {
    let few = collected(id, method, 1, mode)?;
    let many = collected(id, method, 5, mode)?;
    Ok((many - few) / (4.0 * f64::from(POSES)))
}

/// What callgrind counts over a whole run.
fn collected(id: &str, method: &str, sweeps: u32, mode: &str) -> Result<f64, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["--once", id, method, &sweeps.to_string(), mode])
        .stdin(Stdio::null())
        .output()
        .map_err(|error| format!("valgrind: {error}"))?;
    let report = String::from_utf8_lossy(&output.stderr);
    let count = report.lines().find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok());
    count.ok_or_else(|| format!("callgrind has no count:\n{report}"))
}
