//! The reduced equation of motion of random linkages: `M q̈ + h` is what equilibrium with inertia gives, at every acceleration; M is the mass
//! of the kinetic energy where the unknowns act at the drives.

use std::collections::HashMap;

use crate::support::linkages::{Kind, sample, sample_with_search};
use crate::support::numbers::{Double, Extended};
use crate::support::{Arguments, Number, compile, from_pose, index_of, pose, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;
use linkage_codegen::model::UnknownKind;

fn kind(seed: u64) -> Kind {
    let dyads = usize::try_from(seed % 4).expect("small");
    Kind {
        dyads,
        sliders: true,
        joints: seed % 2 == 1,
        unknown_anywhere: seed.is_multiple_of(3),
        moving: true,
        params: seed % 5 == 4,
        scalar: "f64",
    }
}

/// A linkage with the scene `control`; none if its unknown, which may act anywhere, leaves it loose.
fn linkage(seed: u64) -> Option<(String, Linkage, Arguments)> {
    let sample = if seed % 7 == 5 { sample_with_search(seed, kind(seed)) } else { sample(seed, kind(seed)) };
    let text = format!("{} scene control: motion -> (M, h, rounding, M_kinetic);", sample.text);
    let linkage = linkage_codegen::analyse(text.parse().expect("tokens")).ok()?;
    Some((text, linkage, sample.arguments))
}

/// A part of the equation: its numbers row by row.
fn numbers<T: Clone>(results: &HashMap<String, T>, part: &str, rows: usize, columns: usize) -> Vec<Vec<T>> {
    let name = |row: usize, column: usize| match (rows, columns) {
        (1, _) => part.to_owned(),
        (_, 1) => format!("{part}.{}", row + 1),
        _ => format!("{part}.{}.{}", row + 1, column + 1),
    };
    (0..rows).map(|row| (0..columns).map(|column| results[&name(row, column)].clone()).collect()).collect()
}

fn at_drives(linkage: &Linkage) -> bool {
    linkage.model.unknowns.iter().all(|unknown| matches!(unknown.kind, UnknownKind::Drive(_)))
}

/// The efforts are those of equilibrium, whatever the drives' accelerations.
fn check_efforts<T: Number>(text: &str, linkage: &Linkage, arguments: &Arguments, tolerance: f64) {
    let count = linkage.model.drives.len();
    let results = scene::<T>(linkage, "control", arguments).expect("an equation of motion");
    let (mass, bias) = (numbers(&results, "M", count, count), numbers(&results, "h", count, 1));
    for factor in [0.0, 1.0, -2.75] {
        let mut other = arguments.clone();
        other.motion.iter_mut().enumerate().for_each(|(drive, [_, acceleration])| {
            *acceleration *= if drive == 0 { factor } else { 1.0 };
        });
        let exact = scene::<Extended>(linkage, "all", &other).expect("forces");
        let parts = scene::<Double>(linkage, "parts", &other).expect("parts");
        for (row, unknown) in linkage.model.unknowns.iter().enumerate() {
            let terms = (0..count).map(|drive| mass[row][drive].mul(&T::exactly(other.motion[drive][1])));
            let own = terms.fold(bias[row][0].clone(), |sum, term| sum.add(&term));
            // What cancels takes part with all its size.
            let named = parts.iter().filter(|(path, _)| path.ends_with(&unknown.name));
            let size = named.fold(1e-30, |sum, (_, part)| sum + part.0.abs());
            let off = (own.to_f64() - exact[&unknown.name].to_f64()).abs();
            assert!(off <= tolerance * size, "{} is off by {off:e} of {size:e}\n{text}", unknown.name);
        }
    }
}

/// The accelerations that efforts give, as the method `acceleration` of the emitted results: `None` where no inertia resists.
fn forward(mass: &[Vec<f64>], rounding: &[Vec<f64>], open: &[f64]) -> Option<Vec<f64>> {
    fn solve<const N: usize>(mass: &[Vec<f64>], rounding: &[Vec<f64>], open: &[f64]) -> Option<Vec<f64>> {
        let square = |of: &[Vec<f64>]| core::array::from_fn(|row| core::array::from_fn(|column| of[row][column]));
        let open: [f64; N] = core::array::from_fn(|row| open[row]);
        let (found, distance) = linkage_runtime::__private::f64::solve::<N>(square(mass), square(rounding), open);
        (distance.abs() > 1.0).then(|| found.to_vec())
    }
    match open {
        [open] => (mass[0][0].abs() > rounding[0][0]).then(|| vec![open / mass[0][0]]),
        [_, _] => solve::<2>(mass, rounding, open),
        [_, _, _] => solve::<3>(mass, rounding, open),
        [_, _, _, _] => solve::<4>(mass, rounding, open),
        _ => panic!("more drives than any sample has"),
    }
}

/// Forward dynamics after inverse dynamics: the efforts of equilibrium give the accelerations that they were asked for, to what their own
/// rounding makes of accelerations. False where no inertia resists.
fn check_forward(text: &str, linkage: &Linkage, arguments: &Arguments) -> bool {
    let count = linkage.model.drives.len();
    let results = scene::<Double>(linkage, "control", arguments).expect("an equation of motion");
    let part = |name: &str, columns: usize| -> Vec<Vec<f64>> {
        let rows = numbers(&results, name, count, columns);
        rows.iter().map(|row| row.iter().map(|value| value.0).collect()).collect()
    };
    let (mass, rounding, bias) = (part("M", count), part("rounding", count), part("h", 1));
    let all = scene::<Double>(linkage, "all", arguments).expect("forces");
    let parts = scene::<Double>(linkage, "parts", arguments).expect("parts");
    let unknowns = &linkage.model.unknowns;
    let open: Vec<f64> = unknowns.iter().zip(&bias).map(|(unknown, bias)| all[&unknown.name].0 - bias[0]).collect();
    let Some(found) = forward(&mass, &rounding, &open) else { return false };
    // What an effort of the size of its rounding gives, by the inverse of M.
    let mut allowed = vec![0.0; count];
    for (row, unknown) in unknowns.iter().enumerate() {
        let named = parts.iter().filter(|(path, _)| path.ends_with(&unknown.name));
        let mut unit = vec![0.0; count];
        unit[row] = 1e-9 * named.fold(1e-30, |sum, (_, part)| sum + part.0.abs());
        let share = forward(&mass, &rounding, &unit).expect("as before");
        allowed.iter_mut().zip(share).for_each(|(sum, share)| *sum += share.abs());
    }
    for (drive, [_, wanted]) in arguments.motion.iter().enumerate() {
        let off = (found[drive] - wanted).abs();
        assert!(
            off <= allowed[drive],
            "{} is {off:e} off {wanted}, allowed {:e}\n{text}",
            found[drive],
            allowed[drive]
        );
    }
    true
}

/// Symmetric, and no motion has a negative kinetic energy.
fn check_mass(text: &str, linkage: &Linkage, results: &HashMap<String, Extended>, rates: &[f64]) {
    let count = linkage.model.drives.len();
    let kinetic = numbers(results, "M_kinetic", count, count);
    let mass = numbers(results, "M", count, count);
    let rounding = numbers(results, "rounding", count, count);
    for row in 0..count {
        for column in 0..count {
            assert_eq!(kinetic[row][column].to_f64().to_bits(), kinetic[column][row].to_f64().to_bits(), "{text}");
            if at_drives(linkage) {
                assert_eq!(mass[row][column].to_f64().to_bits(), kinetic[row][column].to_f64().to_bits(), "{text}");
            }
            assert!(rounding[row][column].to_f64() >= 0.0, "{text}");
        }
        assert!(kinetic[row][row].to_f64() >= 0.0, "{text}");
    }
    let mut twice = Extended::zero();
    for row in 0..count {
        for column in 0..count {
            let rates = Extended::exactly(rates[row]).mul(&Extended::exactly(rates[column]));
            twice = twice.add(&kinetic[row][column].mul(&rates));
        }
    }
    if let [[a, b], [c, d]] = kinetic.iter().map(Vec::as_slice).collect::<Vec<_>>()[..] {
        let determinant = a.mul(d).sub(&b.mul(c)).to_f64();
        assert!(determinant >= -1e-50 * a.mul(d).to_f64(), "{determinant:e}\n{text}");
    }
    assert!(twice.to_f64() >= 0.0, "{text}");
}

/// Of a linkage that was checked.
struct Checked {
    drives: usize,
    at_drives: bool,
    /// Whether forward dynamics gave accelerations.
    forward: bool,
}

fn check(seed: u64) -> Option<Checked> {
    let (text, linkage, arguments) = linkage(seed)?;
    let Ok(results) = scene::<Extended>(&linkage, "control", &arguments) else { return None };
    check_efforts::<Double>(&text, &linkage, &arguments, 1e-9);
    check_efforts::<Extended>(&text, &linkage, &arguments, 1e-14);
    let forward = check_forward(&text, &linkage, &arguments);
    let rates: Vec<f64> = arguments.motion.iter().map(|[rate, _]| *rate).collect();
    check_mass(&text, &linkage, &results, &rates);
    // From a pose the same as straight from the drives.
    let index = index_of(&linkage, "control");
    let kept = pose::<Double>(&linkage, &arguments).expect("a pose");
    let own = from_pose::<Double>(&linkage, &linkage.functions.scenes[index].from_pose, &kept, &arguments);
    let straight = scene::<Double>(&linkage, "control", &arguments).expect("an equation of motion");
    let paths = linkage.functions.scenes[index].from_pose.outputs.iter().map(|(path, _)| path);
    for (path, value) in paths.zip(own.expect("an equation of motion")) {
        let part = |path: &str| path.split('.').next().map(str::to_owned);
        let alike = straight.iter().filter(|(other, _)| part(other) == part(path));
        let size = alike.fold(0.0f64, |most, (_, value)| most.max(value.0.abs()));
        let off = (value.0 - straight[path].0).abs();
        assert!(off <= 1e-10 * size, "{path} is off by {off:e} of {size:e}\n{text}");
    }
    Some(Checked { drives: linkage.model.drives.len(), at_drives: at_drives(&linkage), forward })
}

#[test]
fn the_equation_of_motion_of_random_linkages_is_their_equilibrium() {
    let checked: Vec<Checked> = (8000..8050).filter_map(check).collect();
    let count = |having: &dyn Fn(&Checked) -> bool| checked.iter().filter(|one| having(one)).count();
    let (several, elsewhere) = (count(&|one| one.drives > 1), count(&|one| !one.at_drives));
    let (forward, forward_several) = (count(&|one| one.forward), count(&|one| one.forward && one.drives > 1));
    println!("{} {several} {elsewhere} {forward} {forward_several}", checked.len());
    assert!(checked.len() > 25 && several > 2 && elsewhere > 4, "{} {several} {elsewhere}", checked.len());
    assert!(forward > 20 && forward_several > 1, "forward: {forward}, of several drives {forward_several}");
}

/// With the coefficients of first and second order every velocity and every acceleration is made of the drives' motion.
#[test]
fn kinematic_coefficients_of_random_linkages_make_their_motion() {
    let (mut checked, mut several) = (0, 0);
    for seed in 8200..8230 {
        let Some((text, _, arguments)) = linkage(seed) else { continue };
        let linkage = compile(&format!("{text} scene gains: coefficients;"));
        let Ok(gains) = scene::<Double>(&linkage, "gains", &arguments) else { continue };
        let speeds = scene::<Double>(&linkage, "speeds", &arguments).expect("velocities");
        let accelerations = scene::<Double>(&linkage, "accelerations", &arguments).expect("accelerations");
        let drives: Vec<&str> = linkage.model.drives.iter().map(|drive| drive.name.text.as_str()).collect();
        for (path, speed) in &speeds {
            let (what, part) = match path.strip_suffix(".x").or(path.strip_suffix(".y")) {
                Some(what) => (what, &path[what.len()..]),
                None => (path.as_str(), ""),
            };
            let of = |by: String| gains[&format!("{what}.by{by}{part}")].0;
            let (mut first, mut second, mut size) = (0.0, 0.0, 1e-9);
            for (i, one) in drives.iter().enumerate() {
                let [rate, acceleration] = arguments.motion[i];
                let gain = of(format!("_{one}"));
                first += gain * rate;
                second += gain * acceleration;
                size += (gain * acceleration).abs();
                for (j, other) in drives.iter().enumerate().skip(i) {
                    let twice = if i == j { 1.0 } else { 2.0 };
                    let term = twice * of(format!("_{one}_{other}")) * rate * arguments.motion[j][0];
                    second += term;
                    size += term.abs();
                }
            }
            assert!((first - speed.0).abs() <= 1e-9 * (speed.0.abs() + 1.0), "{path}: {first} {}\n{text}", speed.0);
            let off = (second - accelerations[path].0).abs();
            assert!(off <= 1e-9 * (size + 1.0), "{path}: {second} {}\n{text}", accelerations[path].0);
        }
        checked += 1;
        several += usize::from(drives.len() > 1);
    }
    assert!(checked > 20 && several > 2, "{checked} {several}");
}

/// A crank-rocker with masses.
const FOUR_BAR: &str = "mod four_bar; ground { A0: (0, 0), B0: (0.14m, 0) } link crank { A0 -> A: 0.04m, G: (0.015m, 2mm) }
    link coupler { A -> B: 0.1m, C: (50mm, 30mm) } link rocker { B0 -> B: 0.12m, D: (60mm, -10mm) }
    mass crank: 0.8kg at G, inertia 400kg*mm^2; mass coupler: 1.2kg at C, inertia 1900kg*mm^2; mass rocker: 0.7kg at D, inertia 900kg*mm^2;
    revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
    drive theta: A0; assemble B: left(A -> B0); load I: inertia; load W: gravity = 9.81m/s^2 @ -90deg; load M4: moment(rocker);
    scene control: motion; scene controlled: motion -> (M, h); scene mass: motion -> (M); scene bias: motion -> (h);
    scene free: motion(); scene torque: virtual_work -> (effort_theta); scene statics: virtual_work(W, M4) -> (effort_theta);
    scene of_rocker: motion(Ir) -> (M); load Ir: inertia(rocker);";

/// A five-bar with masses and two inputs.
const FIVE_BAR: &str = "mod five_bar; ground { O1: (0, 0), O2: (0.5m, 0) } link left { O1 -> P: 0.3m, G: (0.12m, 0) }
    link right { O2 -> Q: 0.35m, G: (0.2m, 0.01m) } link upper { P -> R: 0.45m, G: (0.2m, 0) } link lower { Q -> R: 0.4m, G: (0.15m, 0) }
    mass left: 1.2kg at G, inertia 0.01kg*m^2; mass right: 1.4kg at G, inertia 0.02kg*m^2;
    mass upper: 0.8kg at G, inertia 0.012kg*m^2; mass lower: 0.7kg at G, inertia 0.009kg*m^2;
    revolute O1: ground -> left; revolute O2: ground -> right; revolute P: left -> upper; revolute Q: right -> lower;
    revolute R: upper -> lower; drive a: O1; drive b: O2; assemble R: left(P -> Q); load I: inertia; load W: gravity = (0, -9.81m/s^2);
    scene torque: virtual_work -> (effort_a, effort_b); scene control: motion; scene controlled: motion -> (M, h); scene mass: motion -> (M);";

/// Additions, multiplications and divisions of a scene, from a pose.
fn cost(linkage: &Linkage, name: &str) -> usize {
    let index = index_of(linkage, name);
    let counts = linkage.functions.scenes[index].from_pose.counts();
    counts.add + counts.mul + counts.div
}

#[test]
fn mass_and_bias_together_cost_less_than_two_dynamic_solutions() {
    let text = FOUR_BAR.replace("scene torque: virtual_work ->", "scene torque: virtual_work(I, W, M4) ->");
    let text = text.replace("motion;", "motion(I, W, M4);").replace("motion -> (M, h)", "motion(I, W, M4) -> (M, h)");
    for text in [text.as_str(), FIVE_BAR] {
        let linkage = compile(text);
        let [once, both, all, mass] = ["torque", "controlled", "control", "mass"].map(|name| cost(&linkage, name));
        println!("dynamic solution {once}, M and h {both}, with rounding {all}, M {mass}");
        // `rounding`, of which the default has one number for each of M, too.
        assert!(all < 2 * once && both < all && mass < both, "{once} {both} {all} {mass}");
        // The mass needs no acceleration, nor what one has of velocities: three fifths of a dynamic solution, which skips what has no power.
        let of_mass = &linkage.functions.scenes[index_of(&linkage, "mass")].from_pose;
        let names = of_mass.values.iter().filter_map(|value| value.label.as_ref()).map(|label| label.name.as_str());
        let moving = ["omega_", "omega2_", "alpha_", "da_"];
        assert!(names.clone().all(|name| !moving.iter().any(|start| name.starts_with(start))));
        assert!(names.count() > 3);
        assert!(5 * mass < 3 * once, "{once} {mass}");
    }
    // And inertia of one link no velocity of another.
    let linkage = compile(&text);
    assert!(cost(&linkage, "of_rocker") < cost(&linkage, "mass"));
}
