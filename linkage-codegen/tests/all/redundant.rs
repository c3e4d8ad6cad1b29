//! Linkages that move only because of their special dimensions: what is redundant is named, and what the message says to write releases it.

use crate::support::compile;

fn refused(declaration: &str) -> Vec<String> {
    let refusal = linkage_codegen::analyse(declaration.parse().expect("tokens")).expect_err(declaration);
    refusal.errors.iter().map(|error| error.message().to_owned()).collect()
}

/// The only message.
fn message(declaration: &str) -> String {
    let messages = refused(declaration);
    let [message] = messages.as_slice() else { panic!("{}", messages.join("\n\n")) };
    message.clone()
}

/// The declaration with the item that the help of a message shows, in place of the joint's own.
fn released(declaration: &str, message: &str) -> String {
    let item = message.lines().map(str::trim).find(|line| line.starts_with("slot ")).expect(message);
    let joint = item["slot ".len()..].split(':').next().expect("a name");
    let start = declaration.find(&format!("revolute {joint}:")).expect("the joint");
    let end = start + declaration[start..].find(';').expect("its end") + 1;
    format!("{}{item}{}", &declaration[..start], &declaration[end..])
}

/// A bar on parallel cranks of equal length, the first of them driven.
fn cranks(places: &[f64]) -> String {
    let list = |of: &dyn Fn(usize, f64) -> String| {
        places.iter().enumerate().map(|(index, x)| of(index, *x)).collect::<Vec<_>>().join(" ")
    };
    let points = |letter: &str| list(&|i, x| format!("{letter}{i}: ({x}m, 0),"));
    let links = list(&|i, _| format!("link crank{i} {{ P{i} -> Q{i}: 1m }}"));
    let joints = list(&|i, _| format!("revolute P{i}: ground -> crank{i}; revolute Q{i}: crank{i} -> bar;"));
    format!(
        "mod cranks; ground {{ {} }} link bar {{ {} }} {links} {joints} drive q: P0;
         load F: force(bar.Q1); scene held: equilibrium;",
        points("P"),
        points("Q")
    )
}

#[test]
fn a_bar_on_three_parallel_cranks() {
    let declaration = cranks(&[0.0, 1.0, 2.5]);
    let message = message(&declaration);
    assert!(message.starts_with("one of `crank1` and `crank2` is redundant: "), "{message}");
    assert!(message.contains("mobility 0, and 1 drive"), "{message}");
    assert!(message.contains("of the 12 constraints 11 are independent, and its true mobility is 1"), "{message}");
    assert!(message.contains("slot Q2: crank2 -> bar along P2 -> Q2 of crank2;"), "{message}");
    // With the slot, only sides are left to be said.
    let released = released(&declaration, &message);
    let left = refused(&released);
    assert!(left.iter().all(|message| message.contains("in two ways")), "{}", left.join("\n\n"));
    compile(&format!("{released} assemble Q1: left(Q0 -> P1); assemble Q2: ahead(P2);"));
}

#[test]
fn a_bar_on_four_parallel_cranks() {
    let message = message(&cranks(&[0.0, 1.0, 2.5, -0.7]));
    assert!(message.starts_with("two of `crank1`, `crank2` and `crank3` are redundant: "), "{message}");
    assert!(message.contains("and likewise at another one"), "{message}");
}

#[test]
fn cranks_of_different_lengths_are_held_fast() {
    let declaration = cranks(&[0.0, 1.0, 2.5]).replace("Q2: 1m", "Q2: 1.1m");
    let message = message(&declaration);
    assert!(message.starts_with("the linkage cannot move"), "{message}");
}

#[test]
fn a_carriage_on_two_parallel_rails() {
    let message = message(
        "mod carriage; ground { A: (0, 0), B: (0, 1m), O: (-2m, 0) } link carriage { A: (0, 0), B: (0, 1m) }
         prismatic A: ground -> carriage along 0deg; prismatic B: ground -> carriage along 0deg;
         drive q: A; load F: force(carriage.B); scene held: equilibrium;",
    );
    assert!(message.starts_with("`B` is redundant: "), "{message}");
    assert!(message.contains("take `B` out"), "{message}");
}

#[test]
fn a_rectangle_of_slides() {
    let slides = "ground { A: (0, 0), D: (0, 0) } link a { A: (0, 0), B: (0, 0) } link b { B: (0, 0), C: (0, 0) }
         link c { C: (0, 0), D: (0, 0) }
         prismatic A: ground -> a along 0deg; prismatic B: a -> b along 90deg of a; prismatic C: b -> c along 0deg of b;
         prismatic D: ground -> c along 90deg;
         load F: force(b.B); scene held: equilibrium;";
    // With both drives that it needs it is over-driven by count.
    let both = message(&format!("mod table; {slides} drive x: A; drive y: D;"));
    assert!(
        both.starts_with("`A`, `B`, `C` and `D` keep their links from turning, by one constraint too many: "),
        "{both}"
    );
    assert!(both.contains("write `slot` in place of `prismatic` for one of `B` and `C`"), "{both}");
    // With one the count is right, and wrong everywhere.
    let one = message(&format!("mod table; {slides} drive x: A;"));
    assert!(one.contains("write `slot` in place of `prismatic`"), "{one}");
    // As the message says.
    let released = format!("mod table; {slides} drive x: A; drive y: D;").replace("prismatic C:", "slot C:");
    compile(&released);
}

#[test]
fn parallel_cranks_beside_what_is_loose() {
    // The count is right on the whole: the third crank makes up for a pendulum that nothing drives.
    let declaration =
        cranks(&[0.0, 1.0, 2.5]) + "link pendulum { S -> T: 1m } revolute S: ground.P1 -> pendulum.S; drive r: S;";
    let both = message(&declaration);
    assert!(both.starts_with("one of `crank1` and `crank2` is redundant: "), "{both}");
    let loose = declaration.replace("drive r: S;", "");
    let message = message(&loose);
    assert!(message.contains("held twice") && message.contains("`pendulum`"), "{message}");
    assert!(message.contains("slot Q2: crank2 -> bar along P2 -> Q2 of crank2;"), "{message}");
}
