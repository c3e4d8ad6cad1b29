//! Linkages whose links are placed together and have no start, or one that does not close: the lines of the message close them.

use crate::support::compile;

/// The only message.
fn message(declaration: &str) -> String {
    let refusal = linkage_codegen::analyse(declaration.parse().expect("tokens")).expect_err(declaration);
    let [error] = refusal.errors.as_slice() else { panic!("{:?}", refusal.errors) };
    error.message().to_owned()
}

/// The `start` items of a message.
fn lines(message: &str) -> Vec<String> {
    let lines = message.lines().map(str::trim).filter(|line| line.starts_with("start ") && line.ends_with(';'));
    lines.map(str::to_owned).collect()
}

/// What a start is of.
fn subject(line: &str) -> &str {
    line["start ".len()..].split(':').next().expect("a name")
}

const TRIAD: &str = "mod triad; units { mm, N }
    ground { A: (0, 0), F: (150mm, 0), G: (250mm, 0) } link crank { A -> B: 40mm } link plate { B -> C: 100mm, D: (50mm, 60mm) }
    link left { F -> C: 90mm } link rod { D -> E: 110mm } link right { G -> E: 100mm }
    revolute A: ground -> crank; revolute B: crank -> plate; revolute C: plate -> left; revolute F: ground -> left;
    revolute D: plate -> rod; revolute E: rod -> right; revolute G: ground -> right;
    drive theta: G; load W: force(plate.D); scene held: equilibrium;";

/// An arm that rolls a wheel on a fixed one.
const WHEELS: &str = "mod wheels; units { mm, N }
    ground { O: (0, 0), R: (140mm, 30mm) } link crank { R -> A: 25mm } link arm { O -> J: 60mm }
    link wheel { J: (0, 0), E: (45mm, 0) } link rod { A -> E: 70mm }
    revolute R: ground -> crank; revolute O: ground -> arm; revolute J: arm -> wheel; revolute A: crank -> rod;
    revolute E: rod -> wheel; gear G: ground.O -> wheel.J, radii (40mm, 20mm), phase 15mm;
    drive theta: R; load F: force(wheel.E); scene held: equilibrium;";

/// A plate on three cylinders; a dyad with a side before it, and dimensions that have a default.
const CYLINDERS: &str = "mod cylinders; param base: length = 2m;
    ground { O: (0, 0), Q: (base, 0), R: (1m, 2m), S: (0.5m, 0.5m) }
    link crank { O -> A: 0.5m } link coupler { A -> B: 1.9m, M: (0.9m, 0.3m) } link rocker { Q -> B: 1.2m }
    link plate { D: (0, 0), E: (0.5m, 0), F: (0.2m, 0.4m) } link rod { M -> D: 0.8m } link tube { R: (0, 0) } link piston { E: (0, 0) }
    link shoe { F: (0, 0) }
    revolute O: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute Q: ground -> rocker;
    revolute M: coupler -> rod; revolute D: rod -> plate; revolute R: ground -> tube; revolute E: piston -> plate;
    prismatic lift: tube.R -> piston.E along 0deg of tube; revolute F: plate -> shoe;
    prismatic S: ground -> shoe.F along 60deg, angle 20deg;
    drive theta: O; drive x: lift; assemble B: right(A -> Q);
    load L: force(plate.F); scene held: equilibrium;";

#[test]
fn a_missing_start_is_said_with_lines_that_close() {
    for declaration in [TRIAD, WHEELS, CYLINDERS] {
        let message = message(declaration);
        assert!(message.contains("they close, among other poses, with"), "{message}");
        let lines = lines(&message);
        compile(&format!("{declaration} {}", lines.concat()));
        // If only one of them is missing, it goes with the others.
        for missing in &lines {
            let others: String = lines.iter().filter(|line| *line != missing).cloned().collect();
            let of_one = self::message(&format!("{declaration} {others}"));
            let found = self::lines(&of_one);
            assert_eq!(found.iter().map(|line| subject(line)).collect::<Vec<_>>(), [subject(missing)], "{of_one}");
            compile(&format!("{declaration} {others} {}", found.concat()));
        }
    }
}

#[test]
fn a_start_that_does_not_close_is_said_with_what_stays_open_and_with_lines_that_do() {
    let rough = "start theta: 90deg; start arm: (0, 0), angle 200deg; start wheel: (60mm, 0), angle 0deg;
        start rod: (140mm, 55mm), angle 0deg;";
    let message = message(&format!("{WHEELS} {rough}"));
    assert!(message.contains(" mm stay open of all loops together"), "{message}");
    let lines = lines(&message);
    assert_eq!(lines.len(), 3, "{message}");
    compile(&format!("{WHEELS} start theta: 90deg; {}", lines.concat()));
}

#[test]
fn dimensions_that_are_given_later_leave_the_numbers_open() {
    let message = message(&CYLINDERS.replace("length = 2m", "length"));
    assert!(message.contains("with the numbers of your linkage, write"), "{message}");
}

#[test]
fn a_start_far_off_is_said_with_lines_that_close() {
    let links = |plate: &str| {
        format!(
            "start theta: 132deg; start crank: (0, 0), angle 90deg; start plate: (0, 40mm), angle {plate};
         start left: (150mm, 0), angle -160deg; start rod: (80mm, 40mm), angle 20deg;"
        )
    };
    compile(&format!("{TRIAD} {}", links("-45deg")));
    let message = message(&format!("{TRIAD} {}", links("140deg")));
    let lines = lines(&message);
    assert_eq!(lines.len(), 4, "{message}");
    compile(&format!("{TRIAD} start theta: 132deg; {}", lines.concat()));
}

/// Behind a side that is an argument a group starts from one pose: of the other side it is said, if it does not close from there.
#[test]
fn sides_with_which_a_start_does_not_close_are_said() {
    let text = |side: &str, upper: &str| {
        format!(
            "mod behind; ground {{ O: (0, 0), Q: (5m, 1m), R: (2m, -2m) }} link crank {{ O -> A: 1m }} link e {{ A -> H: 2m }}
             link f {{ R -> H: 2m, P: (1.745m, -1.398m) }} link b {{ A -> E: 1.95m }}
             link t {{ E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m) }} link c {{ Q -> C: {upper} }} link d {{ D: (0.2m, 0.1m), P: (1.8m, 0.6m) }}
             revolute O: ground -> crank; revolute Ae: crank.A -> e.A; revolute H: e -> f; revolute R: ground -> f;
             revolute Ab: crank.A -> b.A; revolute E: t -> b; revolute C: t -> c; revolute D: d -> t; revolute Q: ground -> c;
             revolute P: d -> f; drive q: O; assemble H: {side}(Ae -> R); start q: 0.4rad; start b: (1m, 0.4m), angle 36deg;
             start t: (2.5m, 1.5m), angle 0; start c: (5m, 1m), angle 140deg; start d: (3m, 0.6m), angle -80deg;
             scene places: position -> (C);"
        )
    };
    let either = compile(&text("either", "1.92m"));
    // As many as are refused when they are declared.
    let sides = ["left", "right"];
    let refused = |side: &&str| linkage_codegen::analyse(text(side, "1.92m").parse().expect("tokens")).is_err();
    let expected: Vec<String> = sides.iter().filter(|side| refused(side)).map(|side| format!("`H` {side}")).collect();
    assert_eq!(either.unposed, expected);
    assert_eq!(expected, ["`H` right"]);
    let code = linkage_codegen::expand(text("either", "1.92m").parse().expect("tokens")).to_string();
    assert!(code.contains("it does not close with `H` right: from there no pose has these sides"), "{code}");
    // With none of them it is refused.
    assert!(linkage_codegen::analyse(text("either", "9m").parse().expect("tokens")).is_err());
}
