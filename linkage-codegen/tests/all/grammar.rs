//! The examples of the grammar page are what the parser reads.

use linkage_codegen::diagnostics::{Diagnostic, Sink};
use linkage_codegen::syntax;

const PAGE: &str = include_str!("../../../docs/grammar.md");

/// The blocks of examples; rules have `:=`.
fn examples() -> Vec<String> {
    let blocks = PAGE.split("```text\n").skip(1).filter_map(|rest| rest.split("```").next());
    blocks.filter(|block| !block.contains(":=")).map(str::to_owned).collect()
}

/// The declaration that a block shows, or one of its items.
fn declaration(block: &str) -> String {
    match block.split_once("linkage! {") {
        Some((_, inner)) => inner.trim_end().trim_end_matches('}').to_owned(),
        None => format!("mod example; {block}"),
    }
}

#[test]
fn every_example_is_read() {
    let examples = examples();
    assert!(examples.len() >= 8, "{} examples", examples.len());
    for example in examples {
        let sink = Sink::default();
        let tokens = declaration(&example).parse().unwrap_or_else(|error| panic!("{error}\n{example}"));
        let ast = syntax::parse(tokens, &sink);
        let errors = sink.into_errors();
        let messages: Vec<&str> = errors.iter().map(Diagnostic::message).collect();
        assert!(ast.is_some() && messages.is_empty(), "{}\n{example}", messages.join("\n"));
    }
}

/// Every word that a rule sets in `code` and that begins an item has an example.
#[test]
fn every_item_has_an_example() {
    let shown = examples().concat();
    for item in syntax::ITEMS {
        let begins = shown.lines().any(|line| line.trim_start().starts_with(&format!("{item} ")));
        assert!(begins, "`{item}` has no example");
    }
}

/// What is said to slips that are near something else.
#[test]
fn slips_are_told_what_is_meant() {
    one_error_each(&[
        ("unknown T: torque(ground.O -> crank.O);", "write `torque(ground -> crank)`"),
        ("unknown T: torque(ground, crank);", "write `torque(ground -> crank)`"),
        ("emit source; emit source;", "`emit source` is chosen already"),
        ("mass crank: 1kg at A, inertia 3kgm^2;", "did you mean `kg*m`?"),
        (
            "param r: length = 1m; load G: force(crank.A) = (1N*sqrt(2 - r^2/m^2*(1 + 2)), 0N);",
            "`2 - r^2/m^2*(1 + 2)`, whose root",
        ),
        (
            "param r: number = 2; load G: force(crank.A) = 1N @ acos(r);",
            "`r`, of which `acos` is taken, must be from −1 to 1",
        ),
        (
            "param r: number = 2; load G: force(crank.A) = 1N/(r - 2) @ 0;",
            "`r - 2`, by which is divided, must not be zero",
        ),
        (
            "param r: number = 0; unknown P: force(crank.A) along (r, 2*r);",
            "the direction `(r, 2*r)` must not be the zero vector",
        ),
        ("param r: number = 0; load G: force(crank.A) = 1N @ atan2(r, 0);", "of `r` and `0` one must not be zero"),
        (
            "param p: length = 1m; param r: number = -1; mass crank: 1kg*r*p/1m at A;",
            "not so with the defaults of `p` and `r`",
        ),
        ("param true: length;", "`true` is a literal of Rust"),
        ("load crank: moment(crank); scene g: virtual_work(crank) -> (crank);", "the name `crank` is taken"),
        (
            "param error_bound: length; scene g: equilibrium -> (error_bound);",
            "`error_bound` is a parameter, and no result",
        ),
        ("scene Err: sweep(held);", "two functions `Err`: the other one is Rust's own"),
        ("scene Ok: sweep(held);", "two functions `Ok`: the other one is Rust's own"),
        ("link rod { A -> B: 1m, C: left(A -> B, 1m, 1m), B: (1m, 0) }", "the link `rod` has a point `B` already"),
        ("link rod { A, C: left(A -> B, 1m, 1m), B: (1q) }", "expected a vector"),
        ("param crank: length = 1m; mass crank: 1kg at (crank, 0);", "the name `crank` is taken"),
        ("param r: number = 2; mass crank: 1kg*(5 - 1/(r - 2)) at A;", "`r - 2`, by which is divided"),
        ("param r: number = 0; unknown P: force(crank.A) along r @ 30deg;", "the direction `r @ 30deg` must not be"),
        ("unknown P: force(crank.A) along 0 @ 30deg;", "a direction cannot be the zero vector"),
        ("unknown P: force(crank.A) along l2 @ 30deg;", "`param l2: length;`"),
        (
            "param r: number = 2; load G: force(crank.A) = 1N @ acos(-r*(3 - -r^2)/(2*r));",
            "`-r*(3 - -r^2)/(2*r)`, of which",
        ),
        ("load G: force(crank.A) = (1MN, 2*kn);", "did you mean `kN`?"),
        ("load G: force(crank.A) = /// up\n (0N, 1N);", "no attributes or documentation comments"),
        ("param power2: length; scene g: equilibrium -> (power2);", "`power2` is a parameter, and no result"),
        ("mass crank: 1kg at (l2, 0);", "`param l2: length;`"),
        ("mass /// the crank's\n crank: 1kg at A;", "no attributes or documentation comments"),
        ("link rod { A, /// end\n B: (1m, 0) }", "no attributes or documentation comments"),
        ("link rod { C: left(A -> B, 1m, 1m), A -> B: 1m }", "put `A -> B` in front of the other points"),
        ("link rod { A, C: left(A -> B, 1m, 1m), B: (1m, 0) }", "`B` is declared behind the one"),
        ("link rod { A, C: left(A -> C, 1m, 1m) }", "`C` cannot be measured from itself"),
        ("scene back: inverse(O) -> (q, error_bound);", "`inverse` cannot give `error_bound`"),
        (
            "load G: force(crank.O); scene g: virtual_work(G) -> (advantage(G));",
            "there is no advantage over `G`: `v_along_G` is zero",
        ),
        ("load f: force(crank.A); scene d: derivative(held) by (f, F);", "`F` among the results of `d`"),
    ]);
}

/// What one does who writes the first declaration: a mistake is one error, where it was made.
#[test]
fn first_slips_are_one_error_each() {
    one_error_each(&[
        ("link four-bar { A } mass four-bar: 1kg at A;", "write `four_bar`"),
        ("revolute B: ground - crank;", "`ground -> crank` where an arrow stands"),
        (
            "link lever { O: (0, 0), D: (60mm, 0) } revolute Q: ground.O -> lever.O; slot S: lever.O -> crank.A along 0deg of lever;",
            "`lever` can be assembled at `S` in two ways",
        ),
        ("load Z: force(crank.A) = (0, 0); scene z: virtual_work(Z) -> (advantage(Z));", "Z vanishes at every pose"),
        ("param l-2: length = 1m; mass crank: 1kg at (l-2-5mm, 0);", "write `l_2`"),
        ("load G: force(crank.A-1);", "`A-1` is no name: names have no hyphens"),
        ("link rod { A-1, B: (1m, 0) }", "write `A_1`"),
        ("link rod { A -> A: 1m } weld B: crank.A -> rod;", "the frame of `rod` goes from `A` to `A`"),
        ("link rod { A: (0, 0), A -> B: 1m }", "put `A -> B` in front of the other points"),
        ("link rod { A -> B: 1m, A -> C: 2m }", "a link has one frame"),
        ("link rod { A, A: (1m, 0) } weld B: crank.A -> rod.B;", "the link `rod` has a point `A` already"),
        ("scene p: position -> (O along crank);", "ask for the whole vector: `O`"),
        ("scene p: position -> (crank.A along crank);", "`position` cannot give `crank.A along crank`"),
        ("scene p: position -> (crank.A along path);", "`position` cannot give `crank.A along path`"),
        ("scene p: position -> (crank.angle along crank);", "`crank.angle` turns, and has no part along `crank`"),
        ("scene p: velocity -> (crank.angle along crank);", "write `crank.angle`"),
        ("scene p: virtual_work -> (crank.A along crank);", "`virtual_work` cannot give `crank.A along crank`"),
        ("scene p: virtual_work -> (O about crank.A);", "`virtual_work` cannot give `O about crank.A`"),
        ("scene p: acceleration -> (O along path);", "`O` never moves, and has no path"),
        ("scene p: acceleration -> (crank.A, crank.O along path);", "a joint holds it to the ground"),
        ("scene p: acceleration -> (ground.O along path);", "it is a point of the ground"),
        ("link ring { } weld R: crank.A -> ring;", "give it that one, as in `link ring { R }`"),
        ("link ring { } weld R: crank.A -> ring.A;", "give it that one, as in `link ring { A }`"),
        ("link ring { } mass ring: 1kg at A;", "give it that one, as in `link ring { A }`"),
        ("link ring { } load G: force(ring);", "as in `link ring { P }`, and write `ring.P` here"),
        ("link ring { } scene p: position -> (ring.A);", "give it that one, as in `link ring { A }`"),
        ("assemble O: left(O, A);", "write `left(O -> A)`"),
        ("link rod { A - B: 1m }", "expected `->`, found `-`"),
        ("link rod { A: 1m, 2m, B: (1m, 0) }", "the coordinates of a point stand in parentheses"),
        ("link rod { A: above(A -> B, 1m, 1m) }", "there is no side `above`"),
        ("link rod { A: 1m }", "as in `A -> B: 80mm`"),
        ("revolute ground -> crank: R; unknown T: thrust(ground.O, crank.A);", "expected `:`"),
        ("weld joint: ground -> crank;", "neither `ground` nor `crank` has a point `joint`"),
        ("load G: moment(rod); load H: moment(rod);", "there is no link `rod`"),
        ("mass crank: 1kg at (1m);", "expected a vector"),
        ("unknown T: moment(ground -> crank);", "did you mean `torque`?"),
        ("load G: torque(crank);", "did you mean `moment`?"),
        ("load G: moment(crank.A) = 1N*m;", "leave the point out: `moment(crank)`"),
        ("load G: force(crank.A) = 1N, 2N;", "write `= (x, y)`"),
        ("load G: force(crank.A) = (1N, 2N) in crank;", "the frame of a force stands in front of its size"),
        ("force G: crank.A = (1N, 0N); scene g: virtual_work(G);", "it is a load"),
        ("let r = 1m; link rod { A -> B: r }", "did you mean `param`?"),
        ("drive p: O, rate 1rpm;", "the motion of a drive stands in braces"),
        ("assemble left: O(A -> B);", "the joint comes first: `assemble O: left(…);`"),
        ("assemble O: open;", "there is no side `open`"),
        ("scene g: equilibrium -> (O.x);", "ask for the whole result, `O`, and read its `.x` in the code"),
        ("scene g: position -> (crank.A.x);", "write `crank.A`, and read its parts in the code"),
        ("scene g: equilibrium -> (O along crank.A);", "write `along crank`"),
        ("units { mm, N } units { mm, N }", "the unit of length is chosen already"),
        ("mass crank: 1kg at A inertia 1kg*m^2;", "expected `;`, found `inertia`"),
        ("scalar f64;;", "leave this one out"),
        ("link rod { A }, weld A: crank -> rod;", "leave this one out"),
        ("revolute W: ground.O -> crank.A; drive W: p;", "write `drive p: W;`"),
        ("load G: gravity = 9.81m/s2 @ -90deg; mass crank: 1kg at A;", "did you mean `s^2`?"),
        ("mass crank: 1kg at A, inertia 5kg*mm2;", "did you mean `mm^2`?"),
        (
            "weld P: ground.O -> crank.A; prismatic R: ground.O -> crank.A along crank.O -> crank.A;",
            "`P -> Q of crank`",
        ),
        ("prismatic R: ground.O -> crank.A along 0deg of crank.A;", "write `of crank`"),
        ("drive: O; scene g: equilibrium -> (effort_p);", "expected a name, found `:`"),
    ]);
}

/// Each of these items is refused beside a sound crank, by one error that says this.
fn one_error_each(slips: &[(&str, &str)]) {
    for (slip, expected) in slips {
        let text = format!(
            "mod slips; ground {{ O: (0, 0) }} link crank {{ O -> A: 1m }} revolute O: ground -> crank; drive q: O;
             load F: force(crank.A); scene held: equilibrium; {slip}"
        );
        let refusal = linkage_codegen::analyse(text.parse().expect("tokens")).expect_err(slip);
        let messages: Vec<&str> = refusal.errors.iter().map(Diagnostic::message).collect();
        assert!(messages.len() == 1 && messages[0].contains(expected), "{slip}: {messages:?}");
    }
}
