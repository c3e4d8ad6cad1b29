//! Limits, dead centres and transmission angles against the poses of the same linkage: just inside a limit it assembles and just outside it
//! does not, at a dead centre the toggle's three pins are in line and nowhere else, and no pose transmits worse than is said.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use crate::support::examples::declaration;
use crate::support::linkages::Random;
use crate::support::numbers::Double;
use crate::support::{Arguments, compile, compile_if_it_closes, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::number::Number;
use linkage_codegen::limits::{Grashof, Inversion, Known, KnownPosition, KnownRange, Loop, Posture, Shape};

/// How many linkages of each kind.
const SAMPLES: u64 = 125;
/// How many poses of each are looked at.
const POSES: i32 = 400;

/// What a position scene says.
type Places = HashMap<String, f64>;

fn places(linkage: &Linkage, coordinate: f64) -> Option<Places> {
    let arguments = Arguments { drives: vec![coordinate], ..Arguments::default() };
    let found = scene::<Double>(linkage, "places", &arguments).ok()?;
    Some(found.into_iter().map(|(path, value)| (path, value.0)).collect())
}

fn at(places: &Places, joint: &str) -> [f64; 2] {
    ["x", "y"].map(|part| places[&format!("{joint}.{part}")])
}

fn from_to(places: &Places, from: &str, to: &str) -> [f64; 2] {
    let (from, to) = (at(places, from), at(places, to));
    [to[0] - from[0], to[1] - from[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]))
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]))
}

fn known(found: &Loop) -> &Known {
    found.known.as_ref().expect("constant lengths")
}

/// The intervals of a driver: of an angle without limits a whole turn.
fn intervals(range: &KnownRange) -> Vec<[f64; 2]> {
    let ends = |ends: &[KnownPosition; 2]| ends.each_ref().map(|end| end.at.to_f64());
    match range {
        KnownRange::Unlimited => vec![[-PI, PI]],
        KnownRange::One(one) => vec![ends(one)],
        KnownRange::Two(both) => both.iter().map(ends).collect(),
    }
}

/// A linkage of which nothing is said closes at no pose.
fn closes_nowhere(linkage: &Linkage, text: &str) {
    assert!(linkage.limits.loops.is_empty(), "{:?}\n{text}", linkage.limits);
    let tried =
        (-POSES..POSES).map(|i| f64::from(i) * if text.contains("drive q: S") { 1.0 } else { PI / f64::from(POSES) });
    assert!(tried.into_iter().all(|at| places(linkage, at).is_none()), "{text}");
}

/// How close to its limits the emitted pose agrees with them: the least distance at which it assembles inside and does not outside.
fn sharpness(linkage: &Linkage, range: &KnownRange) -> f64 {
    if matches!(range, KnownRange::Unlimited) {
        return 0.0;
    }
    let mut worst: f64 = 0.0;
    for [from, to] in intervals(range) {
        for (limit, inwards) in [(from, 1.0), (to, -1.0)] {
            let agrees = |by: &f64| {
                let scale = by * limit.abs().max(1.0) * inwards;
                places(linkage, limit + scale).is_some() && places(linkage, limit - scale).is_none()
            };
            let distances = (0..40).map(|halvings| 1e-14 * 2f64.powi(halvings));
            let width = to - from;
            let found = distances.take_while(|by| *by < 0.4 * width).find(agrees);
            worst = worst.max(found.unwrap_or(if width < 1e-6 { 0.0 } else { f64::INFINITY }));
        }
    }
    worst
}

/// Coordinates all over the range, a little inside its limits.
fn coordinates(range: &KnownRange) -> Vec<Vec<f64>> {
    let each = intervals(range).into_iter().map(|[from, to]| {
        let step = |i: i32| from + (to - from) * (f64::from(i) + 0.5) / f64::from(POSES);
        (0..POSES).map(step).collect()
    });
    each.collect()
}

/// The toggle function vanishes at the dead centres that are said, changes its sign there, and changes it nowhere else.
fn check_dead_centres(linkage: &Linkage, known: &Known, toggle: &dyn Fn(&Places) -> f64, text: &str) {
    let dead: Vec<f64> = known.dead_centres.iter().flatten().map(|dead| dead.at.to_f64()).collect();
    for at in &dead {
        let value = places(linkage, *at).map(|places| toggle(&places));
        assert!(value.is_some_and(|value| value.abs() < 2e-7), "{value:?} at the dead centre {at}\n{text}");
        let sides = [1e-4, -1e-4].map(|by| places(linkage, at + by).map(|places| toggle(&places)));
        if let [Some(one), Some(other)] = sides {
            assert!(one * other < 0.0, "{one} {other} about the dead centre {at}\n{text}");
        }
    }
    let all_round = matches!(known.range, KnownRange::Unlimited);
    let mut changes = 0;
    for mut piece in coordinates(&known.range) {
        if all_round {
            piece.push(piece[0] + TAU);
        }
        let values: Vec<f64> = piece.iter().filter_map(|at| places(linkage, *at)).map(|p| toggle(&p)).collect();
        assert_eq!(values.len(), piece.len(), "does not assemble within its range\n{text}");
        changes += values.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    }
    // Two that are closer together than poses are seen as none.
    let close = dead.len() == 2 && (dead[0] - dead[1]).abs() < 3.0 * TAU / f64::from(POSES);
    let edge = intervals(&known.range).iter().flatten().any(|end| {
        !all_round && dead.iter().any(|dead| (0..2).any(|turn| (dead + TAU * f64::from(turn) - end).abs() < 0.02))
    });
    assert!(changes == dead.len() || close || edge, "{changes} dead centres, and not {dead:?}\n{text}");
}

/// The transmission angles that are said are there, and no pose is beyond them.
fn check_transmission(linkage: &Linkage, known: &Known, angle: &dyn Fn(&Places) -> f64, text: &str) {
    let Some([least, greatest]) = &known.transmission else { return };
    let said = [least, greatest].map(|one| one.angle.to_f64());
    for (one, said) in [least, greatest].into_iter().zip(said) {
        // A limit itself may fall on its other side.
        if let Some(places) = places(linkage, one.at.to_f64()) {
            let found = angle(&places);
            assert!((found - said).abs() < 1e-6, "μ = {found} and not {said} at {}\n{text}", one.at.to_f64());
        }
    }
    let all = coordinates(&known.range).concat();
    let seen: Vec<f64> = all.iter().filter_map(|at| places(linkage, *at)).map(|places| angle(&places)).collect();
    let beyond = seen.iter().find(|seen| **seen < said[0] - 1e-9 || **seen > said[1] + 1e-9);
    assert!(beyond.is_none(), "μ = {beyond:?} beyond {said:?}\n{text}");
    let [low, high] = [f64::min, f64::max].map(|with: fn(f64, f64) -> f64| seen.iter().copied().reduce(with).unwrap());
    assert!(low - said[0] < 0.25 && said[1] - high < 0.25, "{low} and {high} for {said:?}\n{text}");
}

/// The output's ends are where they are said to be: `output` at the dead centres differs by the stroke, and nowhere by more.
fn check_stroke(linkage: &Linkage, known: &Known, output: &dyn Fn(&Places) -> f64, scale: f64, text: &str) {
    let Some(stroke) = &known.stroke else { return };
    let [Some(first), Some(second)] = known.dead_centres.each_ref().map(|dead| dead.as_ref().map(|d| d.at.to_f64()))
    else {
        panic!("a stroke without ends\n{text}")
    };
    let extent = stroke.extent.to_f64();
    let along = |at: f64| output(&places(linkage, at).expect("goes round"));
    let ends = [along(first), along(second)];
    assert!(((ends[1] - ends[0]).abs() - extent).abs() < 1e-9 * scale, "{ends:?} for {extent}\n{text}");
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    for at in coordinates(&known.range).concat() {
        let value = along(at);
        assert!(value > low - 1e-9 * scale && value < high + 1e-9 * scale, "{value} beyond {ends:?} at {at}\n{text}");
    }
    let turn = (second - first).rem_euclid(TAU);
    let ratio = turn.max(TAU - turn) / turn.min(TAU - turn);
    let said = stroke.time_ratio.to_f64();
    assert!((ratio - said).abs() < 1e-9 * ratio * ratio, "time ratio {ratio} and not {said}\n{text}");
}

/// A length of whole micrometres, now and then such that the linkage folds.
fn length(random: &mut Random, fine: bool) -> u32 {
    u32::try_from(if fine { 10_000 + random.below(90_000) } else { 10_000 * (1 + random.below(9)) }).unwrap()
}

fn mm(length: u32) -> String {
    format!("{}.{:03}mm", length / 1000, length % 1000)
}

fn degrees(random: &mut Random) -> usize {
    random.below(360)
}

/// A link with two points at a distance, in one of several ways.
fn link(random: &mut Random, name: &str, [from, to]: [&str; 2], length: u32) -> String {
    let length = mm(length);
    match random.below(3) {
        0 => format!("link {name} {{ {from} -> {to}: {length} }}\n"),
        1 => format!("link {name} {{ {to} -> {from}: {length} }}\n"),
        _ => format!("link {name} {{ {from}: (0, 0), {to}: {length} @ {}deg }}\n", degrees(random)),
    }
}

fn joint(random: &mut Random, name: &str, [a, b]: [&str; 2]) -> String {
    let [a, b] = if random.chance(0.5) { [a, b] } else { [b, a] };
    format!("revolute {name}: {a} -> {b};\n")
}

fn shuffled(random: &mut Random, mut items: Vec<String>) -> String {
    for last in (1..items.len()).rev() {
        items.swap(last, random.below(last + 1));
    }
    items.concat()
}

fn side(random: &mut Random, inner: &str, [from, to]: [&str; 2]) -> String {
    let [from, to] = if random.chance(0.5) { [from, to] } else { [to, from] };
    format!("assemble {inner}: {}({from} -> {to});\n", random.pick(&["left", "right"]))
}

fn ahead(random: &mut Random, inner: &str, of: &str) -> String {
    format!("assemble {inner}: {}({of});\n", random.pick(&["ahead", "behind"]))
}

fn module(items: &str) -> String {
    format!("mod sample; units {{ mm, N }}\n{items}scene places: position;")
}

/// A four-bar O P I Q: the lengths |OQ|, |OP|, |PI|, |IQ| in micrometres, its text, and the pins in the order in which its driver sees them.
fn four_bar(random: &mut Random) -> ([u32; 4], String, [&'static str; 4]) {
    let fine = random.chance(0.6);
    let [g, a, h, b] = [0; 4].map(|_| length(random, fine));
    let tilt = degrees(random);
    let ground = match random.below(3) {
        0 => format!("ground {{ O: (0, 0), Q: {} @ {tilt}deg }}\n", mm(g)),
        1 => format!("ground {{ Q: (0, 0), O: {} @ {tilt}deg }}\n", mm(g)),
        _ => format!("ground {{ O: (37mm, -12mm), Q: (37mm, -12mm + {}) }}\n", mm(g)),
    };
    let mut items = vec![
        ground,
        link(random, "crank", ["O", "P"], a),
        link(random, "coupler", ["P", "I"], h),
        link(random, "rocker", ["I", "Q"], b),
        joint(random, "O", ["ground", "crank"]),
        joint(random, "P", ["crank", "coupler"]),
        joint(random, "I", ["coupler", "rocker"]),
        joint(random, "Q", ["rocker", "ground"]),
    ];
    // The driver at one of the fixed pins or between two moving links.
    let (drive, pins) = match random.below(5) {
        0 | 1 => ("O", ["O", "P", "I", "Q"]),
        2 | 3 => ("Q", ["Q", "I", "P", "O"]),
        // Its frame is the first link of the joint.
        _ => ("P", ["P", "I", "Q", "O"]),
    };
    items.push(match drive {
        "O" => side(random, "I", ["P", "Q"]),
        "Q" => side(random, "P", ["I", "O"]),
        _ => side(random, "I", ["O", "Q"]),
    });
    items.push(format!("drive theta: {drive};\n"));
    ([g, a, h, b], module(&shuffled(random, items)), pins)
}

/// Grashof's rule as it is usually put: which link is the shortest, and whether it and the longest are less than the other two.
fn class(frame: u32, driver: u32, coupler: u32, output: u32) -> Grashof {
    let all = [frame, driver, coupler, output];
    let (shortest, longest) = (*all.iter().min().unwrap(), *all.iter().max().unwrap());
    let (ends, sum) = (shortest + longest, all.iter().sum::<u32>());
    match (2 * ends).cmp(&sum) {
        std::cmp::Ordering::Equal => Grashof::ChangePoint,
        std::cmp::Ordering::Greater => Grashof::TripleRocker,
        std::cmp::Ordering::Less if shortest == driver => Grashof::CrankRocker,
        std::cmp::Ordering::Less if shortest == frame => Grashof::DoubleCrank,
        std::cmp::Ordering::Less if shortest == coupler => Grashof::DoubleRocker,
        std::cmp::Ordering::Less => Grashof::RockerCrank,
    }
}

#[test]
fn random_four_bars() {
    let (mut classes, mut limited, mut sharp, mut samples) = (HashMap::new(), 0, 0, 0);
    for seed in 0..SAMPLES {
        let mut random = Random(seed);
        let ([g, a, h, b], text, pins) = four_bar(&mut random);
        let Some(linkage) = compile_if_it_closes(&text) else { continue };
        let [found] = linkage.limits.loops.as_slice() else {
            closes_nowhere(&linkage, &text);
            continue;
        };
        samples += 1;
        let Shape::FourBar(_) = &found.shape else { panic!("{found:?}\n{text}") };
        let known = known(found);
        // The lengths as the driver sees them.
        let driver_is_first = text.contains("revolute P: coupler -> crank");
        let expected = match pins[0] {
            "O" => class(g, a, h, b),
            "Q" => class(g, b, h, a),
            _ if driver_is_first => class(h, a, g, b),
            _ => class(a, h, b, g),
        };
        assert_eq!(known.class, Some(expected), "{text}");
        *classes.entry(expected.name()).or_insert(0) += 1;
        let near = sharpness(&linkage, &known.range);
        assert!(near < 1e-6, "agrees only {near} from its limits\n{text}");
        limited += usize::from(near > 0.0);
        sharp += usize::from(near > 0.0 && near < 1e-12);
        if expected == Grashof::ChangePoint {
            continue;
        }
        // The crank's pin and the output's, as seen from the driver.
        let pins = if pins[0] == "P" && driver_is_first { ["P", "O", "Q", "I"] } else { pins };
        let joint = known.dead_centres.iter().flatten().map(|dead| dead.joint.as_str());
        assert!(joint.clone().all(|joint| joint == pins[1]), "{known:?}\n{text}");
        let arms = |places: &Places| [from_to(places, pins[0], pins[1]), from_to(places, pins[1], pins[2])];
        check_dead_centres(&linkage, known, &|places| cross(arms(places)[0], arms(places)[1]), &text);
        for dead in known.dead_centres.iter().flatten() {
            let [crank, coupler] = arms(&places(&linkage, dead.at.to_f64()).expect("assembles"));
            let stretched = dead.posture == Posture::Stretched;
            assert_eq!(dot(crank, coupler) > 0.0, stretched, "{dead:?}\n{text}");
        }
        let mu = |places: &Places| {
            let (one, other) = (from_to(places, pins[2], pins[1]), from_to(places, pins[2], pins[3]));
            cross(one, other).abs().atan2(dot(one, other))
        };
        check_transmission(&linkage, known, &mu, &text);
        let swing = |places: &Places| {
            let (frame, output) = (from_to(places, pins[3], pins[0]), from_to(places, pins[3], pins[2]));
            cross(frame, output).atan2(dot(frame, output)).abs()
        };
        assert_eq!(known.stroke.is_some(), expected == Grashof::CrankRocker, "{text}");
        check_stroke(&linkage, known, &swing, 1.0, &text);
    }
    assert!(samples > 75 && limited > 30 && sharp * 10 > limited * 8, "{samples} {limited} {sharp}");
    assert_eq!(classes.len(), 6, "{classes:?}");
}

/// Of a loop whose side is an argument the limits are those of both sides, each as if it were declared.
#[test]
fn limits_where_the_side_is_an_argument() {
    let mut found = 0;
    for seed in 0..60 {
        let mut random = Random(seed);
        let kinds = [
            SliderKind::Engine,
            SliderKind::Piston,
            SliderKind::BlockOnCrank,
            SliderKind::Cylinder,
            SliderKind::Slot,
            SliderKind::Boom,
        ];
        let kind = kinds[usize::try_from(seed / 2 % 6).expect("small")];
        let text = if seed % 2 == 0 { four_bar(&mut random).1 } else { slider_crank(&mut random, kind).0 };
        let closure = text.lines().find(|line| line.starts_with("assemble ")).expect("a side").to_owned();
        let (start, of) = closure.split_once('(').expect("joints");
        let (joint, word) = start["assemble ".len()..].split_once(": ").expect("a joint and a side");
        let words = if ["left", "right"].contains(&word) { ["left", "right"] } else { ["ahead", "behind"] };
        let with = |word: &str| text.replace(&closure, &format!("assemble {joint}: {word}({of}"));
        let Some(either) = compile_if_it_closes(&with("either")) else { continue };
        for word in words {
            let one = compile_if_it_closes(&with(word)).expect("closes on both sides or on none");
            let [expected] = one.limits.loops.as_slice() else { continue };
            let own = either.limits.loops.iter().find(|own| own.name == format!("{joint}_{word}")).expect("its limits");
            assert_eq!(format!("{:?}", known(own)), format!("{:?}", known(expected)), "{text}");
            found += 1;
        }
    }
    assert!(found > 30, "{found}");
}

/// What the driver of a slider-crank turns.
#[derive(Clone, Copy, PartialEq)]
enum SliderKind {
    Engine,
    Piston,
    BlockOnCrank,
    Cylinder,
    Slot,
    Boom,
}

/// A slide between a point of one link and a point of another, in any order and with its direction in any frame; and the direction of the
/// line as an angle in the frame of the second.
fn slide(random: &mut Random, name: &str, [first, second]: [&str; 2]) -> (String, usize) {
    let (direction, turn) = (degrees(random), degrees(random));
    let owner = |link: &str| link.split('.').next().unwrap().to_owned();
    let second_frame = (direction + 720 - turn) % 360;
    let text = match random.below(3) {
        0 => format!("{first} -> {second} along {direction}deg of {}, angle {turn}deg", owner(first)),
        1 => format!("{second} -> {first} along {direction}deg of {}, angle {}deg", owner(first), 360 - turn),
        _ => format!("{first} -> {second} along {second_frame}deg of {}, angle {turn}deg", owner(second)),
    };
    (format!("prismatic {name}: {text};\n"), second_frame)
}

fn point(random: &mut Random, reach: u32) -> String {
    let mut number = || i64::try_from(random.below(2 * reach as usize)).unwrap() - i64::from(reach);
    let (x, y) = (number(), number());
    format!("({x}um, {y}um)")
}

/// A slider-crank, and the direction of its slide in the frame of the link `slider`.
fn slider_crank(random: &mut Random, kind: SliderKind) -> (String, usize) {
    let [a, r] = [0; 2].map(|_| length(random, true));
    let reach = *random.pick(&[1, 10_000, 40_000]);
    let mut items = Vec::new();
    let direction;
    match kind {
        SliderKind::Engine | SliderKind::Piston => {
            let (slide, found) = slide(random, "S", ["ground.G", "slider.G"]);
            direction = found;
            items.push(format!("ground {{ O: {}, G: {} }}\n", point(random, reach), point(random, reach)));
            items.push(format!("link slider {{ G: (0, 0), B: {} }}\n", point(random, reach)));
            items.extend([link(random, "crank", ["O", "A"], a), link(random, "rod", ["A", "B"], r), slide]);
            items.extend([joint(random, "O", ["ground", "crank"]), joint(random, "A", ["crank", "rod"])]);
            items.push(joint(random, "B", ["rod", "slider"]));
            if kind == SliderKind::Engine {
                items.extend([ahead(random, "B", "A"), "drive q: O;\n".into()]);
            } else {
                items.extend([side(random, "A", ["O", "B"]), "drive q: S;\n".into()]);
            }
        }
        SliderKind::BlockOnCrank => {
            let (slide, found) = slide(random, "S", ["crank.G", "slider.G"]);
            direction = found;
            items.push(format!("ground {{ O: (0, 0), A: {} @ {}deg }}\n", mm(a), degrees(random)));
            items.push(format!("link crank {{ O: (0, 0), G: {} }}\n", point(random, reach)));
            items.push(format!("link slider {{ G: (0, 0), B: {} }}\n", point(random, reach)));
            items.extend([link(random, "rod", ["A", "B"], r), slide]);
            items.extend([joint(random, "O", ["ground", "crank"]), joint(random, "A", ["ground", "rod"])]);
            items.extend([joint(random, "B", ["rod", "slider"]), ahead(random, "B", "A"), "drive q: O;\n".into()]);
        }
        SliderKind::Cylinder | SliderKind::Boom => {
            let (slide, found) = slide(random, "S", ["cylinder.G", "slider.G"]);
            direction = found;
            items.push(format!("ground {{ O: (0, 0), C: {} @ {}deg }}\n", mm(r), degrees(random)));
            items.push(format!("link cylinder {{ C: (0, 0), G: {} }}\n", point(random, reach)));
            items.push(format!("link slider {{ G: (0, 0), A: {} }}\n", point(random, reach)));
            items.extend([link(random, "crank", ["O", "A"], a), slide]);
            items.extend([joint(random, "O", ["ground", "crank"]), joint(random, "C", ["ground", "cylinder"])]);
            items.push(joint(random, "A", ["crank", "slider"]));
            if kind == SliderKind::Cylinder {
                let pin = *random.pick(&["A", "C"]);
                items.extend([ahead(random, "S", pin), "drive q: O;\n".into()]);
            } else {
                items.extend([side(random, "A", ["C", "O"]), "drive q: S;\n".into()]);
            }
        }
        SliderKind::Slot => {
            direction = degrees(random);
            items.push(format!("ground {{ O: (0, 0), C: {} @ {}deg }}\n", mm(r), degrees(random)));
            items.push(format!("link slider {{ C: (0, 0), G: {} }}\n", point(random, reach)));
            items.push(link(random, "crank", ["O", "A"], a));
            let ends = if random.chance(0.5) { "slider.G -> crank.A" } else { "crank.A -> slider.G" };
            items.push(format!("slot A: {ends} along {direction}deg of slider;\n"));
            items.extend([joint(random, "O", ["ground", "crank"]), joint(random, "C", ["ground", "slider"])]);
            items.extend([ahead(random, "A", "C"), "drive q: O;\n".into()]);
        }
    }
    (module(&shuffled(random, items)), direction)
}

fn check_slider_cranks(kind: SliderKind) {
    let [mut samples, mut limited, mut sharp, mut dead, mut strokes] = [0; 5];
    for seed in 0..SAMPLES {
        let (text, direction) = slider_crank(&mut Random(seed), kind);
        let Some(linkage) = compile_if_it_closes(&text) else { continue };
        let [found] = linkage.limits.loops.as_slice() else {
            closes_nowhere(&linkage, &text);
            continue;
        };
        samples += 1;
        let known = known(found);
        let near = sharpness(&linkage, &known.range);
        assert!(near < 1e-6, "agrees only {near} from its limits: {:?}\n{text}", known.range);
        limited += usize::from(near > 0.0);
        sharp += usize::from(near > 0.0 && near < 1e-12);
        let slide = |places: &Places| {
            let angle = places["slider_angle"] + (f64::from(u32::try_from(direction).unwrap())).to_radians();
            [angle.cos(), angle.sin()]
        };
        let Shape::SliderCrank(slider_crank) = &found.shape else {
            assert!(matches!(kind, SliderKind::Piston | SliderKind::Boom), "{found:?}\n{text}");
            continue;
        };
        let toggle = |places: &Places| match kind {
            SliderKind::Engine => cross(from_to(places, "O", "A"), from_to(places, "A", "B")),
            SliderKind::BlockOnCrank => dot(slide(places), from_to(places, "O", "B")),
            _ => dot(slide(places), from_to(places, "O", "A")),
        };
        let expected = match kind {
            SliderKind::Engine => Inversion::OnFrame,
            SliderKind::BlockOnCrank => Inversion::OnCrank,
            _ => Inversion::Opposite,
        };
        assert_eq!(slider_crank.inversion, expected, "{text}");
        check_dead_centres(&linkage, known, &toggle, &text);
        dead += known.dead_centres.iter().flatten().count();
        for at in known.dead_centres.iter().flatten().filter(|at| at.posture != Posture::Square) {
            let places = places(&linkage, at.at.to_f64()).expect("assembles");
            let stretched = dot(from_to(&places, "O", "A"), from_to(&places, "A", "B")) > 0.0;
            assert_eq!(stretched, at.posture == Posture::Stretched, "{at:?}\n{text}");
        }
        let mu = |places: &Places| {
            let (e, rod) = (slide(places), from_to(places, "A", "B"));
            let normal = [-e[1], e[0]];
            cross(normal, rod).abs().atan2(dot(normal, rod))
        };
        check_transmission(&linkage, known, &mu, &text);
        let (datum, sense) = (places(&linkage, known.dead_centres[0].as_ref().map_or(0.0, |d| d.at.to_f64())), 1.0);
        let datum = datum.map(|places| slide(&places));
        let output = |places: &Places| match (kind, datum) {
            (SliderKind::Engine, _) => {
                let (e, b) = (slide(places), at(places, "B"));
                sense * (e[0] * b[0] + e[1] * b[1])
            }
            (_, Some(datum)) => cross(datum, slide(places)).atan2(dot(datum, slide(places))),
            _ => f64::NAN,
        };
        strokes += usize::from(known.stroke.is_some());
        check_stroke(&linkage, known, &output, if kind == SliderKind::Engine { 100.0 } else { 1.0 }, &text);
    }
    assert!(samples > 60 && limited > 10, "{samples} {limited}");
    assert!(sharp * 10 >= limited * 8, "{samples} {limited} {sharp}");
    let toggles = matches!(kind, SliderKind::Engine | SliderKind::Cylinder | SliderKind::Slot);
    assert!(dead > 10 && strokes > 10 || !toggles, "{dead} {strokes}");
}

#[test]
fn random_slider_cranks() {
    check_slider_cranks(SliderKind::Engine);
}

#[test]
fn random_slider_cranks_driven_at_the_slide() {
    check_slider_cranks(SliderKind::Piston);
}

#[test]
fn random_blocks_on_a_crank() {
    check_slider_cranks(SliderKind::BlockOnCrank);
}

#[test]
fn random_oscillating_cylinders() {
    check_slider_cranks(SliderKind::Cylinder);
}

#[test]
fn random_slotted_levers() {
    check_slider_cranks(SliderKind::Slot);
}

#[test]
fn random_booms_on_a_cylinder() {
    check_slider_cranks(SliderKind::Boom);
}

fn decimal(text: &str) -> Number {
    Number::decimal(text).unwrap()
}

/// Within 60 digits.
fn agree(found: &Number, expected: &Number) -> bool {
    found.sub(expected).abs().compare(&decimal("1e-60").mul(&expected.abs().add(&Number::one()))).is_lt()
}

/// A four-bar that has every limit and every dead centre, its ground line inclined: by the law of cosines in 256 bits.
#[test]
fn constants_are_exact_to_the_last_bit() {
    let text = "mod exact; units { mm, N } ground { O: (0, 0), Q: 97.3mm @ 37deg } link crank { O: (0, 0), P: 61.7mm @ -12deg }
        link coupler { P -> I: 30.2mm } link rocker { Q -> I: 79.9mm }
        revolute O: crank -> ground; revolute P: crank -> coupler; revolute I: coupler -> rocker; revolute Q: rocker -> ground;
        drive theta: O; assemble I: left(P -> Q); scene places: position;";
    let linkage = compile(text);
    let known = known(&linkage.limits.loops[0]);
    let [g, a, h, b] = ["97.3", "61.7", "30.2", "79.9"].map(decimal);
    // ψ = −θ − 12° − 37°, as the joint's arrow leads from the crank to the ground.
    let cosine = |at: &Number| at.neg().sub(&Number::pi(49, 180)).sin_cos().1;
    let square = |x: &Number| x.mul(x);
    // |PQ|² less the square of a length, as a part of the largest of them.
    let distance = |at: &Number| square(&g).add(&square(&a)).sub(&Number::integer(2).mul(&g).mul(&a).mul(&cosine(at)));
    assert_eq!(known.class, Some(Grashof::DoubleRocker));
    let KnownRange::Two(pieces) = &known.range else { panic!("{known:?}") };
    for end in pieces.iter().flatten() {
        let reach = if end.posture == Posture::Stretched { h.add(&b) } else { h.sub(&b) };
        assert!(agree(&distance(&end.at), &square(&reach)) && end.joint == "I", "{end:?}");
    }
    for (dead, line) in known.dead_centres.iter().zip([a.add(&h), a.sub(&h)]) {
        let dead = dead.as_ref().expect("it has both");
        let sides = square(&g).add(&square(&line)).sub(&square(&b));
        let expected = sides.div(&Number::integer(2).mul(&g).mul(&line)).expect("unequal lengths");
        assert!(agree(&cosine(&dead.at), &expected) && dead.joint == "P", "{dead:?}");
    }
}

/// METU 6.3: 80 + 140 = 100 + 120, so that it folds at 180°, exactly.
#[test]
fn the_seed_example_is_at_its_change_point() {
    let declaration = declaration("four_bar");
    let linkage = linkage_codegen::analyse(declaration).unwrap_or_else(|refusal| panic!("{:?}", refusal.errors));
    let [found] = linkage.limits.loops.as_slice() else { panic!("{:?}", linkage.limits) };
    let known = known(found);
    assert_eq!((found.name.as_str(), known.class), ("B", Some(Grashof::ChangePoint)));
    assert!(matches!(known.range, KnownRange::Unlimited) && known.stroke.is_none());
    let [stretched, folded] = known.dead_centres.each_ref().map(|dead| dead.as_ref().expect("it is there"));
    assert!(folded.at.sub(&Number::pi(1, 1)).is_zero(), "{folded:?}");
    // 100 + 80 stretched: cos ψ = (140² + 180² − 120²)/(2·140·180)
    assert!(agree(&stretched.at.sin_cos().1, &Number::ratio(37600, 50400)), "{stretched:?}");
    let [least, greatest] = known.transmission.as_ref().expect("of a four-bar");
    assert!(greatest.angle.sub(&Number::pi(1, 1)).is_zero() && greatest.at.sub(&Number::pi(1, 1)).is_zero());
    // 60 between the outer pins at ψ = 0: cos μ = (100² + 120² − 60²)/(2·100·120)
    assert!(least.at.is_zero() && agree(&least.angle.sin_cos().1, &Number::ratio(20800, 24000)), "{least:?}");
    let text = linkage_codegen::emit::equations(&linkage);
    assert!(text.contains("s + l = 80 + 140 = 220 = p + q = 100 + 120 = 220: change point"), "{text}");
}

/// A parallelogram and a kite: the same posture at every limit that there is.
#[test]
fn linkages_that_fold() {
    let text = |g: u32, a: u32, h: u32, b: u32| {
        module(&format!(
            "ground {{ O: (0, 0), Q: ({g}mm, 0) }} link crank {{ O -> P: {a}mm }} link coupler {{ P -> I: {h}mm }}
             link rocker {{ Q -> I: {b}mm }} revolute O: ground -> crank; revolute P: crank -> coupler;
             revolute I: coupler -> rocker; revolute Q: ground -> rocker; drive theta: O; assemble I: left(P -> Q);\n"
        ))
    };
    for lengths in
        [[200, 60, 200, 60], [60, 60, 200, 200], [200, 60, 60, 200], [3, 4, 5, 6], [6, 5, 4, 3], [4, 3, 6, 5]]
    {
        let [g, a, h, b] = lengths;
        let Some(linkage) = compile_if_it_closes(&text(g, a, h, b)) else { panic!("{lengths:?}") };
        let known = known(&linkage.limits.loops[0]);
        assert_eq!(known.class, Some(Grashof::ChangePoint), "{lengths:?}");
        assert!(sharpness(&linkage, &known.range) < 1e-7, "{lengths:?}");
        // g + a ≤ h + b and |g − a| ≥ |h − b|.
        let all_round = g + a <= h + b && g.abs_diff(a) >= h.abs_diff(b);
        assert_eq!(matches!(known.range, KnownRange::Unlimited), all_round, "{lengths:?}");
    }
}

/// The textbook's crank-shaper: the lever swings by 2 asin(a/g), and the driver turns by half a turn more than that for the slow way.
#[test]
fn quick_return() {
    let text = "mod shaper; units { mm, N } ground { O2: (0, 0), O4: (0, -350mm), R: (0, 330mm) } link crank { O2 -> A: 140mm }
        link lever { O4 -> B: 720mm } link rod { B -> C: 280mm } link ram { C }
        revolute O2: ground -> crank; revolute O4: ground -> lever; slot A: lever.O4 -> crank.A along 0deg of lever;
        revolute B: lever -> rod; revolute C: rod -> ram; prismatic R: ground.R -> ram.C along 0deg;
        drive theta: O2; assemble A: ahead(O4); assemble C: behind(B); scene places: position;";
    let linkage = compile(text);
    let names: Vec<&str> = linkage.limits.loops.iter().map(|found| found.name.as_str()).collect();
    assert_eq!(names, ["A", "C"]);
    let stroke = known(&linkage.limits.loops[0]).stroke.clone().expect("the crank goes round");
    let half = (0.4f64).asin();
    assert!((stroke.extent.to_f64() - 2.0 * half).abs() < 1e-15, "{stroke:?}");
    assert!((stroke.time_ratio.to_f64() - (PI + 2.0 * half) / (PI - 2.0 * half)).abs() < 1e-14, "{stroke:?}");
    // The ram's slider-crank has the lever as its crank, which is not driven itself.
    let ram = &linkage.limits.loops[1];
    assert_eq!(ram.coordinate, "the angle at O4");
    assert_eq!(ram.between.as_deref(), Some("of lever from ground"));
}

/// A Watt six-bar, with its second loop on a pin that three links share, and a bracket welded to its rocker.
#[test]
fn loops_further_out() {
    let outer = |second: &str| {
        format!(
            "mod six_bar; units {{ mm, N }} ground {{ A0: (0, 0), B0: (300mm, -40mm), D0: (620mm, 60mm) }}
             link crank {{ A0 -> A: 90mm }} link coupler {{ A -> B: 280mm }} link rocker {{ B0 -> B: 200mm }} link rod {{ B -> D: 320mm }}
             link output {{ D0 -> D: 170mm }}
             revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
             revolute D: rod -> output; revolute D0: ground -> output;
             drive theta: A0; assemble B: left(A -> B0); {second} scene places: position;"
        )
    };
    let with = [
        "revolute C: rocker.B -> rod.B; assemble D: left(C -> D0);",
        "revolute C: coupler.B -> rod.B; assemble D: left(C -> D0);",
        "link bracket { W: (0, 0), B: (150mm, 80mm) } weld W: rocker.B0 -> bracket.W, angle 20deg;
         revolute C: bracket.B -> rod.B; assemble D: left(C -> D0);",
    ];
    let found = with.map(|second| compile(&outer(second)));
    let loops = found.each_ref().map(|linkage| {
        let names: Vec<&str> = linkage.limits.loops.iter().map(|found| found.name.as_str()).collect();
        assert_eq!(names, ["B", "D"]);
        known(&linkage.limits.loops[1])
    });
    // Whichever of the links on the shared pin holds the rod, the loop is the same.
    assert_eq!(format!("{:?}", loops[0].transmission), format!("{:?}", loops[1].transmission));
    assert_eq!(format!("{:?}", loops[0].dead_centres[0].as_ref().map(|d| d.at.to_f64())), {
        format!("{:?}", loops[1].dead_centres[0].as_ref().map(|d| d.at.to_f64()))
    });
    // In the bracket's frame the crank of the second loop is 170 long: √(150² + 80²).
    let Shape::FourBar(four_bar) = &found[2].limits.loops[1].shape else { panic!() };
    let crank = found[2].model.graph.constant_value(four_bar.lengths[1]).expect("constant");
    assert!(agree(&crank, &Number::integer(170)), "{crank:?}");
    let pins = ["B0", "C", "D", "D0"];
    let coordinate = |places: &Places| places["rocker_angle"];
    for (linkage, known) in found.iter().zip(loops) {
        for dead in known.dead_centres.iter().flatten() {
            // Where the rocker comes through the angle, crank and rod of the second loop are in line.
            let poses: Vec<Places> = (0..4000).filter_map(|i| places(linkage, f64::from(i) * TAU / 4000.0)).collect();
            let near = poses.iter().min_by(|a, b| {
                let off = |p: &Places| (coordinate(p) - dead.at.to_f64()).abs();
                off(a).total_cmp(&off(b))
            });
            let near = near.expect("poses");
            let off = (coordinate(near) - dead.at.to_f64()).abs();
            if off < 1e-3 {
                let value = cross(from_to(near, pins[0], pins[1]), from_to(near, pins[1], pins[2]));
                assert!(value.abs() < 20.0 * off + 1e-9, "{value} at {off} from {dead:?}");
            }
        }
    }
}

/// A crank of two welded links, driven at the one that is declared second.
#[test]
fn a_welded_crank() {
    for (pin, angle) in [("hub -> ground", 30), ("ground -> hub", -75)] {
        let text = format!(
            "mod welded; units {{ mm, N }} ground {{ O: (0, 0), Q: 97mm @ 37deg }} link arm {{ W: (0, 0), P: (50mm, 10mm) }}
             link hub {{ O: (1mm, 2mm), W: (9mm, 5mm) }} link coupler {{ P -> I: 30mm }} link rocker {{ Q -> I: 80mm }}
             revolute O: {pin}; weld W: hub -> arm, angle {angle}deg; revolute P: arm -> coupler; revolute I: coupler -> rocker;
             revolute Q: ground -> rocker; drive theta: O; assemble I: right(P -> Q); scene places: position;"
        );
        let linkage = compile(&text);
        let known = known(&linkage.limits.loops[0]);
        let near = sharpness(&linkage, &known.range);
        assert!(near > 0.0 && near < 1e-12, "{near} {known:?}\n{text}");
        let toggle = |places: &Places| cross(from_to(places, "O", "P"), from_to(places, "P", "I"));
        check_dead_centres(&linkage, known, &toggle, &text);
    }
}

/// A loop of which nothing can be said is left out; a linkage without loops has no such section.
#[test]
fn no_loops() {
    let lever = "mod lever; ground { O: (0, 0) } link lever { O -> P: 250mm } revolute O: ground -> lever;
        drive theta: O; scene places: position;";
    let linkage = compile(lever);
    assert!(linkage.limits.loops.is_empty() && linkage.limits.prepare.is_none());
    assert!(!linkage_codegen::emit::equations(&linkage).contains("Limits"));
    let code = linkage_codegen::expand(lever.parse().expect("tokens")).to_string();
    assert!(!code.contains("LIMITS") && !code.contains("limits"));
}

/// Many links on one pin are searched through as quickly as few.
#[test]
fn levers_on_one_pin() {
    let mut text = "mod levers; ground { O: (0, 0) }".to_owned();
    for lever in 0..60 {
        let _ = write!(
            text,
            "link lever{lever} {{ O{lever}: (0, 0), P: (250mm, 0) }} revolute J{lever}: ground.O -> lever{lever}.O{lever};
             drive theta{lever}: J{lever};"
        );
    }
    let linkage = compile(&format!("{text} scene places: position -> (lever7.P);"));
    assert!(linkage.limits.loops.is_empty());
}

/// Every type of a four-bar in the table of signs, by lengths of each.
#[test]
fn classes() {
    let cases = [
        ([5, 2, 4, 4], Grashof::CrankRocker),
        ([2, 5, 4, 4], Grashof::DoubleCrank),
        ([5, 4, 2, 4], Grashof::DoubleRocker),
        ([5, 4, 4, 2], Grashof::RockerCrank),
        ([9, 4, 4, 3], Grashof::TripleRocker),
        ([4, 9, 4, 3], Grashof::TripleRocker),
        ([4, 4, 9, 3], Grashof::TripleRocker),
        ([4, 4, 3, 9], Grashof::TripleRocker),
        ([3, 4, 5, 4], Grashof::ChangePoint),
    ];
    for ([g, a, h, b], expected) in cases {
        let signs = [g - a + h - b, g - a - h + b, h + b - g - a].map(|sum: i32| i8::try_from(sum.signum()).unwrap());
        assert_eq!(Grashof::of(signs), expected, "{g} {a} {h} {b}");
    }
}

/// The section says what the constants say.
#[test]
fn the_derivation_has_the_numbers() {
    let text = "mod slide; units { mm, N } ground { O: (0, 0), G: (0, 5mm) } link crank { O -> A: 60mm } link rod { A -> B: 50mm }
        link slider { B, G: (0, 0) } revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> slider;
        prismatic G: ground -> slider along 0deg; drive theta: O; assemble B: ahead(A); scene places: position;";
    let linkage = compile(text);
    let equations = linkage_codegen::emit::equations(&linkage);
    let section = &equations[equations.find("Limits\n------").expect("a section")..];
    let KnownRange::Two(pieces) = &known(&linkage.limits.loops[0]).range else { panic!("{section}") };
    let mut numbers = String::new();
    for piece in pieces {
        for end in piece {
            let _ = write!(numbers, "{} ", end.at.to_f64());
            let shown = format!("{}", end.at.to_f64().abs());
            assert!(section.contains(&shown), "{shown} is not in\n{section}");
        }
    }
    assert!(section.contains("B square to the slide"), "{section}{numbers}");
}

/// Emitted constants and emitted functions, of the same lengths.
mod emitted {
    use linkage_runtime::limits::{DriverRange, FourBar, Grashof, Posture, SliderCrank};
    use linkage_runtime::{Error, linkage};

    linkage! {
        mod constant;
        units { mm, N }
        ground       { O: (10mm, 5mm), Q: (107mm, 25mm), R: (40mm, -60mm) }
        link crank   { O: (0, 0), P: 61mm @ -12deg }
        link coupler { P -> I: 30mm }
        link rocker  { Q -> I: 80mm, C: (100mm, 15mm) }
        link rod     { C -> D: 140mm }
        link slider  { D }
        revolute O: crank -> ground;
        revolute P: crank -> coupler;
        revolute I: coupler -> rocker;
        revolute Q: ground -> rocker;
        revolute C: rocker -> rod;
        revolute D: rod -> slider;
        prismatic S: ground.R -> slider.D along 20deg;
        drive theta: O;
        assemble I: left(P -> Q);
        assemble D: behind(C);
        scene places: position;
    }

    linkage! {
        mod adjustable;
        units { mm, N }
        param crank_length: length;
        param coupler_length: length;
        param rocker_length: length;
        param rod_length: length;
        ground       { O: (10mm, 5mm), Q: (107mm, 25mm), R: (40mm, -60mm) }
        link crank   { O: (0, 0), P: crank_length @ -12deg }
        link coupler { P -> I: coupler_length }
        link rocker  { Q -> I: rocker_length, C: (rocker_length + 20mm, 15mm) }
        link rod     { C -> D: rod_length }
        link slider  { D }
        revolute O: crank -> ground;
        revolute P: crank -> coupler;
        revolute I: coupler -> rocker;
        revolute Q: ground -> rocker;
        revolute C: rocker -> rod;
        revolute D: rod -> slider;
        prismatic S: ground.R -> slider.D along 20deg;
        drive theta: O;
        assemble I: left(P -> Q);
        assemble D: behind(C);
        scene places: position;
    }

    linkage! {
        mod cylinders;
        scalar f32;
        param stroke: length = 1.3m;
        ground { O: (0, 0), P: (0.6m, -0.4m), C: (2m, stroke) }
        link boom { O -> Q: 1.2m } link tube { P } link rod { E: (0, 0), Q: (0, 0.1m) }
        link crank { C -> K: 0.3m } link piston { K: (0, 0) } link barrel { B: (0, 0), K: (0, 0.05m) }
        revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
        prismatic lift: tube.P -> rod.E along 0deg of tube;
        revolute C: ground -> crank; revolute K: crank -> piston; prismatic bore: barrel.K -> piston.K along 0deg of barrel;
        revolute B: boom.Q -> barrel.B;
        drive length: lift; drive theta: C;
        assemble Q: left(P -> O);
        assemble bore: ahead(B);
        scene places: position;
    }

    fn params(crank: f64, coupler: f64) -> adjustable::Params {
        adjustable::Params { crank_length: crank, coupler_length: coupler, rocker_length: 80.0, rod_length: 140.0 }
    }

    /// All numbers of what is known, and the rest of it as text.
    fn parts(text: &str) -> (Vec<f64>, String) {
        let is_number = |c: char| c.is_ascii_digit() || ".-e".contains(c);
        let words = text.split(|c: char| !(is_number(c) || c.is_alphanumeric() || c == '_'));
        let (numbers, rest): (Vec<&str>, Vec<&str>) =
            words.filter(|word| !word.is_empty()).partition(|word| word.parse::<f64>().is_ok());
        (numbers.into_iter().map(|number| number.parse().unwrap()).collect(), rest.join(" "))
    }

    #[test]
    fn functions_agree_with_constants() {
        let found = adjustable::Limits::of(&params(61.0, 30.0)).unwrap();
        let constant: (FourBar<f64>, SliderCrank<f64>) = (constant::LIMITS.I, constant::LIMITS.D);
        assert!(matches!(constant.0.range, DriverRange::Two(_)), "{constant:?}");
        let (numbers, words) = parts(&format!("{:?}", (found.I, found.D)));
        let (expected, expected_words) = parts(&format!("{constant:?}"));
        assert_eq!(words, expected_words);
        assert!(numbers.len() > 12 && numbers.len() == expected.len(), "{numbers:?}");
        for (number, expected) in numbers.iter().zip(&expected) {
            assert!((number - expected).abs() < 1e-14 * 180.0, "{number} for {expected}");
        }
    }

    #[test]
    fn limits_of_parameters_are_those_of_the_pose() {
        for (crank, coupler, class) in [
            (61.0, 30.0, Grashof::DoubleRocker),
            (30.0, 90.0, Grashof::CrankRocker),
            (95.0, 20.0, Grashof::DoubleRocker),
            (150.0, 110.0, Grashof::TripleRocker),
            (70.0, 60.0, Grashof::TripleRocker),
            (61.0, 90.0, Grashof::CrankRocker),
        ] {
            let params = params(crank, coupler);
            let linkage = adjustable::Linkage::new(&params).unwrap();
            let limits = adjustable::Limits::of(&params).unwrap().I;
            assert_eq!(limits.class, class, "{params:?}");
            let pieces = match limits.range {
                DriverRange::Unlimited => Vec::new(),
                DriverRange::One(one) => vec![one],
                DriverRange::Two(two) => two.to_vec(),
            };
            for (end, inwards) in pieces.iter().flat_map(|piece| [(piece.from, 1e-12), (piece.to, -1e-12)]) {
                // The second loop may have limits of its own.
                let open = |at: f64| {
                    matches!(adjustable::Pose::at(&linkage, at), Err(Error::CannotAssemble { joint: "I", .. }))
                };
                assert!(!open(end.at + inwards) && open(end.at - inwards), "{end:?} of {params:?}");
            }
            assert_eq!(limits.swing.is_some(), class == Grashof::CrankRocker);
        }
        let error = adjustable::Limits::of(&params(5.0, 5.0)).unwrap_err();
        assert!(matches!(error, Error::CannotAssemble { joint: "I", .. }), "{error:?}");
        assert!(matches!(adjustable::Limits::of(&params(61.0, -1.0)).unwrap_err(), Error::Parameter { .. }));
        let huge = adjustable::Params { rocker_length: 1e200, ..params(61.0, 1e200) };
        assert!(matches!(adjustable::Limits::of(&huge).unwrap_err(), Error::NotFinite { .. }));
    }

    #[test]
    fn what_is_not_finite_is_refused_in_every_parameter() {
        let adjustable::Params { crank_length, coupler_length, rocker_length, rod_length } = params(61.0, 100.0);
        let good = [crank_length, coupler_length, rocker_length, rod_length];
        let limits = |[crank_length, coupler_length, rocker_length, rod_length]: [f64; 4]| {
            adjustable::Limits::of(&adjustable::Params { crank_length, coupler_length, rocker_length, rod_length })
        };
        assert!(limits(good).is_ok());
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -f64::MAX] {
            for which in 0..good.len() {
                let mut params = good;
                params[which] = bad;
                match limits(params) {
                    Err(Error::NotFinite { .. }) => {}
                    // What is finite may be no length, or one with which nothing can be assembled.
                    Err(Error::Parameter { .. } | Error::CannotAssemble { .. }) if bad.is_finite() => {}
                    other => panic!("parameter {which} = {bad}: {other:?}"),
                }
            }
        }
        for stroke in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let refused = cylinders::Limits::of(&cylinders::Params { stroke });
            assert!(matches!(refused, Err(Error::NotFinite { .. })), "{stroke}: {refused:?}");
        }
    }

    #[test]
    fn in_single_precision() {
        let limits = cylinders::Limits::of(&cylinders::Params::default()).unwrap();
        let linkage = cylinders::Linkage::new(&cylinders::Params::default()).unwrap();
        // The boom's cylinder reaches from |1.2 − √0.52| to 1.2 + √0.52, its rod's eye 0.1 beside its line.
        let DriverRange::Two([_, range]) = limits.Q.range else { panic!("{limits:?}") };
        let reach = |d: f64| (d * d - 0.01).sqrt();
        assert!((f64::from(range.from.at) - reach(1.2 - 0.52f64.sqrt())).abs() < 3e-7, "{range:?}");
        assert!((f64::from(range.to.at) - reach(1.2 + 0.52f64.sqrt())).abs() < 3e-7, "{range:?}");
        assert_eq!((range.from.posture, range.to.posture), (Posture::Folded, Posture::Stretched));
        for (at, by) in [(range.from.at, 1e-5), (range.to.at, -1e-5)] {
            assert!(cylinders::places_at(&linkage, at + by, 1.0).is_ok());
            assert!(matches!(cylinders::places_at(&linkage, at - by, 1.0), Err(Error::CannotAssemble { .. })));
        }
    }
}

/// Constant lengths that never meet are refused, whatever the bounds of the expressions say.
#[test]
fn loops_that_never_close_are_refused() {
    let refused = |declaration: &str| {
        let refusal = linkage_codegen::analyse(declaration.parse().expect("tokens")).expect_err(declaration);
        let messages: Vec<&str> =
            refusal.errors.iter().map(linkage_codegen::diagnostics::Diagnostic::message).collect();
        let [message] = messages[..] else { panic!("{}", messages.join("\n\n")) };
        assert!(message.contains("cannot be assembled at `B`, at any pose"), "{message}");
    };
    let four_bar = |a: &str, h: &str, b: &str| {
        format!(
            "mod four_bar; ground {{ O: (0, 0), C: (3m, 1m) }} link crank {{ O -> A: {a} }} link coupler {{ A -> B: {h} }}
             link rocker {{ C -> B: {b} }} revolute O: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker;
             revolute C: ground -> rocker; drive q: O; assemble B: left(A -> C); load M: moment(rocker); scene held: equilibrium;"
        )
    };
    refused(&four_bar("1m", "0.5m", "0.4m"));
    refused(&four_bar("0.5m", "9m", "1m"));
    refused(
        "mod crank; ground { O: (0, 0), G: (0, 3m) } link crank { O -> A: 1m } link rod { A -> B: 1.5m } link piston { B }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: ground.G -> piston.B along 0deg;
         drive q: O; assemble B: ahead(A); load F: force(piston.B); scene held: equilibrium;",
    );
    // Behind another loop.
    refused(
        "mod chain; ground { P: (0, 0), Q: (4m, 0), V: (9m, 0) } link first { P -> R: 1m } link second { Q -> S: 2m, T: (1m, 0.2m) }
         link middle { R -> S: 4m } link rod { T -> B: 0.2m } link arm { V -> B: 0.3m }
         revolute P: ground -> first; revolute R: first -> middle; revolute S: middle -> second; revolute Q: ground -> second;
         revolute T: second -> rod; revolute V: ground -> arm; revolute B: rod -> arm;
         drive q: P; assemble S: left(R -> Q); assemble B: left(T -> V); load M: moment(arm); scene held: equilibrium;",
    );
}
