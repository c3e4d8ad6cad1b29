//! How long the macro takes, and how much it emits: chains of dyads, each driven by the one before.

use std::time::Instant;

use linkage_codegen::{expand, formatted};

/// What is measured, by the number of dyads.
const CHAINS: [(&str, u32); 5] =
    [("four-bar", 1), ("six-bar", 2), ("eight-bar", 3), ("ten dyads", 10), ("twenty dyads", 20)];

/// Prints, for linkages of some numbers of dyads, the least time of so many expansions and the lines of its formatted code, comments and
/// documentation apart.
pub(crate) fn print(rounds: usize) -> Result<(), String> {
    println!("\nexpansion of chains of dyads; of a linkage's growth, what each dyad adds to the four-bar");
    println!("  {:<24} {:>6} {:>10} {:>10} {:>12} {:>12}", "", "dyads", "ms", "lines", "ms/dyad", "lines/dyad");
    let mut first = None;
    for (title, dyads) in CHAINS {
        let declaration = chain(dyads);
        let lines = lines(&declaration).map_err(|error| format!("{title}: {error}"))?;
        // The least: others are those of a busy machine.
        let mut time = f64::INFINITY;
        for _ in 0..rounds {
            let tokens = declaration.parse().map_err(|error| format!("{title}: {error}"))?;
            let start = Instant::now();
            let _ = expand(tokens);
            time = time.min(start.elapsed().as_secs_f64() * 1e3);
        }
        let (time_of_first, lines_of_first) = *first.get_or_insert((time, lines));
        let more = f64::from(dyads - 1);
        #[allow(clippy::cast_precision_loss, reason = "thousands of lines")]
        let (of_time, of_lines) = ((time - time_of_first) / more, (lines - lines_of_first) as f64 / more);
        let each = |value: f64| if dyads == 1 { "–".to_owned() } else { format!("{value:.2}") };
        println!("  {title:<24} {dyads:>6} {time:>10.2} {lines:>10} {:>12} {:>12}", each(of_time), each(of_lines));
    }
    Ok(())
}

/// The lines of a declaration's formatted code, comments and documentation apart.
fn lines(declaration: &str) -> Result<usize, String> {
    let tokens = declaration.parse().map_err(|error| format!("{error}"))?;
    let source = formatted(expand(tokens)).map_err(|error| format!("{error}"))?;
    if source.contains("compile_error") {
        return Err("is refused".into());
    }
    let is_code = |line: &&str| !line.trim_start().starts_with("//") && !line.trim().is_empty();
    Ok(source.lines().filter(is_code).count())
}

/// A crank, and dyads of a coupler and a rocker, each behind the rocker before; a force on each coupler, and weights.
fn chain(dyads: u32) -> String {
    let mut text = String::from("mod chain; units { mm, N } ");
    let mut ground = String::from("ground { O0: (0, 0)");
    let (mut links, mut joints, mut loads) = (String::new(), String::new(), String::new());
    for dyad in 1..=dyads {
        let (before, driver) = (dyad - 1, if dyad == 1 { "crank".to_owned() } else { format!("rocker{}", dyad - 1) });
        ground.push_str(&format!(", O{dyad}: ({}mm, {}mm)", 150 * dyad, 3 * (dyad % 2)));
        links.push_str(&format!(
            "link coupler{dyad} {{ A{before} -> B{dyad}: 140mm, P{dyad}: (60mm, 35mm) }}
             link rocker{dyad} {{ O{dyad} -> B{dyad}: 100mm, A{dyad}: (50mm, 20mm) }}
             mass coupler{dyad}: 0.9kg at (65mm, 12mm); mass rocker{dyad}: 0.8kg at (60mm, -10mm); "
        ));
        joints.push_str(&format!(
            "revolute A{before}: {driver} -> coupler{dyad}; revolute B{dyad}: coupler{dyad} -> rocker{dyad};
             revolute O{dyad}: ground -> rocker{dyad}; assemble B{dyad}: left(A{before} -> O{dyad}); "
        ));
        loads.push_str(&format!("load F{dyad}: force(coupler{dyad}.P{dyad}); "));
    }
    text.push_str(&format!("{ground} }} link crank {{ O0 -> A0: 50mm }} {links}"));
    text.push_str(&format!("revolute O0: ground -> crank; drive theta: O0; {joints} {loads}"));
    text.push_str("load W: gravity = 9.81m/s^2 @ -90deg; scene statics: equilibrium; scene torque: virtual_work;");
    text
}

#[cfg(test)]
mod tests {
    use super::{CHAINS, chain, lines};

    /// Each further dyad adds as many lines, to a twentieth; and the page says how many there are.
    #[test]
    fn lines_grow_with_the_dyads() {
        let page = include_str!("../README.md");
        let all = CHAINS.map(|(title, dyads)| {
            let lines = lines(&chain(dyads)).expect(title);
            let row = page.lines().find(|row| row.starts_with(&format!("| {title} |"))).expect(title);
            assert_eq!(row.split('|').nth(3).map(str::trim), Some(lines.to_string().as_str()), "{row}");
            (dyads as usize, lines)
        });
        let (first, each) = (all[0].1, all[1].1 - all[0].1);
        for (dyads, lines) in all {
            let expected = first + (dyads - 1) * each;
            assert!(20 * lines.abs_diff(expected) <= expected, "{lines} lines for {dyads} dyads, {expected} expected");
        }
    }
}
