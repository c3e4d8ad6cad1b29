//! No declaration, however broken, makes the compiler panic, run away, or emit what is not Rust; and it always says the same.

use std::fmt::Write as _;
use std::hash::{DefaultHasher, Hash, Hasher};

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::support::examples::{declaration, every_example};
use crate::support::linkages::Random;
use linkage_codegen::{analyse, expand, formatted};
use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};

/// Far above what any of these takes, far below what a user would bear.
const PATIENCE: Duration = Duration::from_secs(10);

/// What the examples leave out: parameters, `f32`, sliders everywhere, two drives, folds, and all that is planned.
const FURTHER: [&str; 5] = [
    "pub mod crane; units { cm, kN } scalar f32;
     param reach: length = 120cm; param load: mass; param lean: angle = 15deg;
     ground { A: (0, 0), C: 90cm @ lean }
     link boom { A: (0, 0), B: (reach/2, 5cm), T: (reach, sqrt(reach*reach/4) - 2cm) }
     link tube { C } link rod { C: (0, 0), B: (100cm, 0) }
     mass boom: load at (reach/3, 0), inertia load*reach^2/12; mass rod: 4kg at B;
     revolute A: ground -> boom; revolute C: ground -> tube; revolute B: rod -> boom;
     prismatic stroke: tube.C -> rod.C along 0deg of tube;
     drive theta: A; unknown P: force(boom.T) along (0, 1) of boom; assemble B: ahead(A);
     load W: gravity = 9.81m/s^2 @ -90deg; load F: force(boom.T) in boom; load M: moment(rod -> boom) = -2kN*cm;
     scene hold: equilibrium(F, W) -> (P, A, stroke); scene parts: superposition; scene work: virtual_work -> (P, W, M);
     scene check: verify; scene where_: position -> (boom.T, rod.angle, B);",
    "mod five_bar; ground { A: (0, 0), E: (200mm, 0) }
     link left { A -> B: 90mm } link lower { B -> C: 120mm } link upper { C -> D: 120mm } link right { E -> D: 90mm }
     revolute A: ground -> left; revolute B: left -> lower; revolute C: lower -> upper; revolute D: upper -> right;
     revolute E: right -> ground;
     drive alpha: A; drive beta: E; assemble C: left(B -> D); load F: force(lower.C); load G: moment(upper);
     scene statics: equilibrium; scene work: virtual_work; scene parts: superposition(F) -> (effort_beta, C);",
    "pub(crate) mod fold; units { mm } ground { A0: (0, 0), B0: (140mm, 0) }
     link crank { A0 -> A: 80mm } link coupler { A -> B: 140mm, C: right(A -> B, 100mm, 80mm) } link rocker { B0 -> B: 80mm }
     revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
     drive theta: A0; assemble B: left(A -> B0) smooth at 60deg; load F: force(coupler.C) = (0, -3N*cos(20deg));
     scene statics: equilibrium -> (B); emit source;",
    "mod planned; arithmetic fused; crate = ::other::runtime; ground { O: (0, 0) } link a { O -> P: 1m } link b { P, Q: (1m, 0) }
     revolute O: ground -> a { rate: 3000rpm, acceleration: 0 }; slot S: a.P -> b.P along 0deg of a; weld P: a -> b, angle 3deg;
     gear G: a.O -> b.P, radii (20mm, 30mm), phase 5mm, internal; start a: (0, 0), angle 30deg; drive q: S.travel;
     unknown T: thrust(a.O, b.Q); assemble P: either(O -> S); load K: spring(a.O, b.Q) { rate: 2N/mm, free: _ };
     load KT: torsion(a -> b) { rate: 3N*m/rad }; load I: inertia; load H: thrust(a.O, b.P) = 3N;
     scene v: velocity -> (a.P); scene s: sweep(v); scene e: equilibrium -> (O along a, P about a.P, error_bound);",
    TRAIN,
];

/// Wheels that loads turn.
const TRAIN: &str = "mod train; units { mm, N } ground { O: (0, 0) } link sun { O -> k: 20mm } link carrier { O -> C: 37.5mm }
     link planet { C: (0, 0), p: (10mm, 0) } revolute Os: ground.O -> sun.O; revolute Oc: ground.O -> carrier.O;
     revolute C: carrier -> planet; gear Gs: sun.O -> planet.C, radii (25mm, 12.5mm);
     gear Gr: ground.O -> planet.C, radii (50mm, 12.5mm), internal; drive q: Os;
     load A: torsion(ground -> planet) { rate: 2N*mm/rad, free: 10deg }; load B: torsion(planet -> carrier) { rate: 3N*mm/rad, free: _ };
     scene work: virtual_work; scene statics: equilibrium; scene where_: position -> (sun.angle, planet.angle, carrier.angle);
     scene check: verify;";

/// All declarations, as words.
fn declarations() -> Vec<Vec<String>> {
    let further = FURTHER.iter().map(|text| text.parse().expect("tokens"));
    every_example().iter().map(|example| declaration(example)).chain(further).map(words).collect()
}

/// A declaration as words: names, numbers, signs and brackets, each by itself.
fn words(tokens: TokenStream) -> Vec<String> {
    let mut words = Vec::new();
    let mut joint = false;
    for token in tokens {
        let joined = core::mem::replace(&mut joint, false);
        match token {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Parenthesis => ["(", ")"],
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::None => ["", ""],
                };
                words.push(open.to_owned());
                words.extend(self::words(group.stream()));
                words.push(close.to_owned());
            }
            TokenTree::Punct(sign) => {
                joint = sign.spacing() == Spacing::Joint;
                match words.last_mut() {
                    Some(last) if joined => last.push(sign.as_char()),
                    _ => words.push(sign.as_char().to_string()),
                }
            }
            other => words.push(other.to_string()),
        }
    }
    words
}

/// Words as tokens, whatever they are: brackets that do not match are closed or left out.
fn tokens(words: &[String]) -> TokenStream {
    let mut open = Vec::new();
    let mut text = String::new();
    for word in words {
        match word.as_str() {
            "(" => open.push(")"),
            "{" => open.push("}"),
            "[" => open.push("]"),
            ")" | "}" | "]" if open.last() != Some(&word.as_str()) => continue,
            ")" | "}" | "]" => drop(open.pop()),
            _ => {}
        }
        write!(text, "{word} ").expect("a string takes it");
    }
    while let Some(bracket) = open.pop() {
        text.push_str(bracket);
    }
    text.parse().unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// Words that no declaration above need have.
const STRANGERS: [&str; 64] = [
    "mod",
    "pub",
    "units",
    "scalar",
    "param",
    "ground",
    "link",
    "mass",
    "revolute",
    "prismatic",
    "slot",
    "weld",
    "gear",
    "drive",
    "assemble",
    "start",
    "unknown",
    "load",
    "scene",
    "emit",
    "crate",
    "self",
    "_",
    "r#type",
    "in",
    "of",
    "at",
    "along",
    "about",
    "smooth",
    "either",
    "left",
    "ahead",
    "equilibrium",
    "virtual_work",
    "verify",
    "position",
    "gravity",
    "spring",
    "inertia",
    "sqrt",
    "atan2",
    "pi",
    "mm",
    "kN",
    "rpm",
    "0",
    "0mm",
    "1e400",
    "1e300mm",
    "-",
    "->",
    "=>",
    "@",
    "::",
    "..",
    "^",
    "#",
    "'a'",
    "\"text\"",
    "0x1f",
    "1_0.5e-3deg",
    "é",
    "{",
];

/// Any word, strangers now and then.
fn word(random: &mut Random, words: &[String]) -> String {
    if random.chance(0.3) { (*random.pick(&STRANGERS)).to_owned() } else { random.pick(words).clone() }
}

/// One to three slips, mostly one.
fn mutant(random: &mut Random, of: &[String]) -> Vec<String> {
    let mut words = of.to_vec();
    for _ in 0..=random.below(6).saturating_sub(3) {
        if words.is_empty() {
            break;
        }
        let (at, to) = (random.below(words.len()), random.below(words.len()));
        match random.below(8) {
            0 => drop(words.remove(at)),
            1 => words.insert(to, words[at].clone()),
            2 => words.insert(at, words[at].clone()),
            3 => words.swap(at, to),
            4 => words.swap(at, (at + 1).min(of.len() - 1).min(to.max(at))),
            5 => words.insert(at, word(random, of)),
            6 if random.chance(0.3) => words.truncate(at),
            _ => words[at] = word(random, of),
        }
    }
    words
}

/// Anything, mostly behind a header.
fn soup(random: &mut Random, words: &[String]) -> Vec<String> {
    let header = if random.chance(0.1) { random.below(3) } else { 3 };
    let header = ["mod", "soup", ";"].map(str::to_owned).into_iter().take(header);
    let length = random.below(60);
    header.chain((0..length).map(|_| word(random, words)).collect::<Vec<_>>()).collect()
}

/// What is emitted for a declaration, once it is known to be Rust; and whether the declaration was accepted.
fn compiled(words: &[String]) -> (String, bool) {
    let declaration = tokens(words);
    let begin = Instant::now();
    let expanded = catch_unwind(AssertUnwindSafe(|| {
        let accepted = match analyse(declaration.clone()) {
            Ok(_) => true,
            Err(refusal) => {
                assert!(!refusal.errors.is_empty(), "refused without a reason");
                assert!(refusal.errors.iter().all(|error| !error.message().trim().is_empty()), "an empty reason");
                false
            }
        };
        let tokens = expand(declaration.clone());
        let text = tokens.to_string();
        (formatted(tokens).map(|_| text), accepted)
    }));
    let took = begin.elapsed();
    assert!(took < PATIENCE, "{took:?} for\n{declaration}");
    match expanded {
        Ok((Ok(text), accepted)) => {
            assert_eq!(text.contains("compile_error"), !accepted, "{declaration}");
            (text, accepted)
        }
        Ok((Err(error), _)) => panic!("{error} in what is emitted for\n{declaration}"),
        Err(fault) => {
            eprintln!("a panic at\n{declaration}");
            resume_unwind(fault)
        }
    }
}

/// Mutants of every declaration and soups of its words; how many of them, and how many were accepted.
fn survive(each: usize, seed: u64) -> (usize, usize) {
    let declarations = declarations();
    thread::scope(|scope| {
        let runs: Vec<_> = declarations
            .iter()
            .zip(1..)
            .map(|(words, index): (_, u64)| {
                scope.spawn(move || {
                    let mut random = Random(seed + index);
                    let mutants = (0..each).filter(|_| compiled(&mutant(&mut random, words)).1).count();
                    let soups = (0..each / 4).filter(|_| compiled(&soup(&mut random, words)).1).count();
                    (each + each / 4, mutants + soups)
                })
            })
            .collect();
        let done = runs.into_iter().map(|run| run.join().unwrap_or_else(|fault| resume_unwind(fault)));
        done.fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    })
}

#[test]
fn broken_declarations_are_refused_in_rust() {
    let (all, accepted) = survive(125, 0);
    // Mutants that are nothing but refused, or never, would show little.
    assert!(accepted * 100 > all && accepted * 2 < all, "{accepted} of {all} accepted");
}

#[test]
#[ignore = "long"]
fn many_broken_declarations_are_refused_in_rust() {
    survive(6000, 1000);
}

/// What is said to a four-bar with this crank, this load on the coupler, and these further items; nothing if it is accepted.
fn refusal(crank: &str, load: &str, items: &str) -> Vec<String> {
    let text = format!(
        "mod four_bar; units {{ mm, N }} {items} ground {{ A0: (0, 0), B0: (140mm, 0) }}
         link crank {{ A0 -> A: {crank} }} link coupler {{ A -> B: 100mm, C: (50mm, 20mm) }} link rocker {{ B0 -> B: 120mm }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker;
         revolute B0: ground -> rocker; drive theta: A0; assemble B: left(A -> B0);
         load F: force(coupler.C) = {load}; load M: moment(rocker); scene statics: equilibrium;"
    );
    let declaration: TokenStream = text.parse().unwrap_or_else(|error| panic!("{error}: {text}"));
    let begin = Instant::now();
    formatted(expand(declaration.clone())).unwrap_or_else(|error| panic!("{error}: {text}"));
    let found = analyse(declaration).err().map_or_else(Vec::new, |refusal| refusal.errors);
    assert!(begin.elapsed() < PATIENCE, "{text}");
    found.iter().map(|error| error.message().lines().next().expect("a line").to_owned()).collect()
}

#[test]
fn extreme_numbers_are_accepted_or_refused_but_never_wrong() {
    let crank = |value: &str| refusal(value, "(1N, 2N)", "");
    let beyond = ["this number is beyond the range of an `f64`"];
    for value in ["1e999999999mm", "1e99999999999999999999mm", "1e400mm", "1e309mm", "1e-400mm", "80mm*((10^16)^16)^2"]
    {
        assert_eq!(crank(value), beyond, "{value}");
    }
    assert_eq!(refusal("1e39mm", "(1N, 2N)", "scalar f32;"), ["this number is beyond the range of an `f32`"]);
    // Each number by itself fits, and their product does not.
    let heavy = |scalar: &str, much: &str| {
        let mass = format!("mass crank: {much}kg at ({much}mm, 0); load W: gravity = (0, -1m/s^2);");
        refusal("80mm", "(1N, 2N)", &format!("scalar {scalar}; {mass}"))
    };
    let beyond =
        |scalar: &str| [format!("the equations of this linkage have constants beyond the range of an `{scalar}`")];
    assert_eq!(heavy("f64", "1e200"), beyond("f64"));
    assert_eq!(heavy("f32", "1e25"), beyond("f32"));
    assert_eq!(heavy("f64", "1e25"), [""; 0]);
    assert_eq!(crank(&format!("0.8{}e2mm", "0".repeat(4000))), [""; 0]);
    assert_eq!(crank(&format!("{}mm", "8".repeat(100_000))), ["this number has more than 4096 characters"]);
    assert_eq!(crank("80mm*(2 + sin(1e15deg))"), [""; 0]);
    for angle in ["1e30deg", "1e300rad", "1e20rev"] {
        assert_eq!(refusal("80mm", &format!("3N @ {angle}"), ""), ["this angle is too large"], "{angle}");
    }
    assert_eq!(refusal("80mm", "(0, 0)", ""), [""; 0]);
}

#[test]
fn undefined_constants_are_refused() {
    for (value, problem) in [
        ("80mm/0", "division by zero"),
        ("80mm/(1mm - 1mm)", "division by zero"),
        ("80mm/(sqrt(2)*sqrt(2) - 2)", "division by zero"),
        ("80mm/sin(180deg)", "division by zero"),
        ("80mm*sqrt(1 - 2)", "the root of a negative number"),
        ("sqrt(80mm)", "a length has no square root"),
        ("80mm*asin(2)/1rad", "`asin` takes a number from −1 to 1"),
        ("80mm*tan(270deg)", "the tangent of a right angle is infinite"),
        ("80mm*atan2(0, 0)/1rad", "the zero vector has no angle"),
        ("80mm*2^17", "an exponent is a whole number from 0 to 16, without a unit"),
        ("0x50", "numbers are decimal"),
    ] {
        assert_eq!(refusal(value, "(1N, 2N)", ""), [problem], "{value}");
    }
}

/// Which link keeps wheels apart is not known where something else is wrong, and loads ask how they turn.
#[test]
fn wheels_of_a_broken_declaration_are_refused() {
    let problems = |text: &str| {
        let refusal = analyse(text.parse().expect("tokens")).err();
        refusal.map_or_else(Vec::new, |refusal| refusal.errors.iter().map(|error| error.message().to_owned()).collect())
    };
    assert_eq!(problems(TRAIN), [""; 0]);
    for (right, wrong) in [
        ("ground {", "ground 1N {"),
        ("revolute C:", "revolute 150mm:"),
        ("planet.C, radii (50mm", "carrier.C, radii (50mm"),
        ("sun { O -> k", "sun { O --> k"),
        ("link planet { C: (0, 0)", "link planet { : (0, 0)"),
        ("(50mm, 12.5mm)", "(50mm, 60mm)"),
        ("sun.O -> planet.C", "sun.O -> planet"),
    ] {
        assert!(TRAIN.contains(right), "{right}");
        assert!(!problems(&TRAIN.replace(right, wrong)).is_empty(), "{wrong}");
    }
}

#[test]
fn nesting_and_length_have_limits() {
    let crank = |value: &str| refusal(value, "(1N, 2N)", "param p: number = 1; param q: length = 50mm;");
    let nested = |depth: usize, inner: &str| format!("{}{inner}{}", "(".repeat(depth), ")".repeat(depth));
    assert_eq!(crank(&nested(120, "80mm")), [""; 0]);
    for depth in [200, 20_000] {
        assert_eq!(crank(&nested(depth, "80mm")), ["brackets are nested more than 128 deep"]);
    }
    assert_eq!(crank(&format!("80mm{}", "*p".repeat(200))), [""; 0]);
    assert_eq!(crank("80mm*((p^16)^16)^15"), [""; 0]);
    let rows = (0..100).fold("80mm".to_owned(), |inner, _| format!("({inner}{})", " + 1mm".repeat(100)));
    let powers = "80mm*(((p^16)^16)^16)^16".to_owned();
    for long in ["-".repeat(10_000) + "80mm", format!("80mm{}", " + 1mm".repeat(1000)), rows, powers] {
        let found = crank(&long);
        assert!(found.len() == 1 && found[0].starts_with("this expression is too long"), "{found:?}");
    }
}

/// Each point takes the two before it twice: what is made of the last one must not double with every point.
#[test]
fn points_upon_points_stay_cheap() {
    let points: Vec<String> = (2..20).map(|n| format!("P{n}: left(P{} -> P{}, p, q)", n - 2, n - 1)).collect();
    let points = points.join(", ");
    let items = format!(
        "param p: length = 40mm; param q: length = 50mm; link plate {{ P0: (0, p), P1: (q, 3mm), {points} }}
         prismatic S: ground.A0 -> plate.P19 along 0deg; drive x: S; load G: force(plate.P18);"
    );
    assert_eq!(refusal("80mm", "(1N, 2N)", &items), [""; 0]);
}

/// What is emitted for all declarations and some mutants of each, in one number.
fn digest() -> u64 {
    let mut hasher = DefaultHasher::new();
    for words in declarations() {
        let mut random = Random(7);
        compiled(&words).0.hash(&mut hasher);
        (0..4).for_each(|_| compiled(&mutant(&mut random, &words)).0.hash(&mut hasher));
    }
    hasher.finish()
}

#[test]
fn the_same_declaration_gives_the_same_code_everywhere() {
    let own = digest();
    assert_eq!(thread::spawn(digest).join().expect("no panic"), own, "in another thread");
    let mut process = Command::new(std::env::current_exe().expect("this test"));
    let output = process
        .args(["--exact", "robustness::tells_its_digest", "--ignored", "--nocapture"])
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains(&format!("digest {own:x}")), "in another process: {said}");
}

#[test]
#[ignore = "part of the test of other processes"]
fn tells_its_digest() {
    println!("digest {:x}", digest());
}
