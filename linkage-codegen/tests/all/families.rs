//! The families of poses that break weak implementations.

use crate::support::families::{
    BARS, Family, SCENES, boom, check, length, loads, single, slider_crank, tangent_mechanism, worst,
};
use crate::support::linkages::{Random, in_single_precision};
use crate::support::measures::from_kept;
use crate::support::numbers::{Double, Extended, Single};
use crate::support::{Arguments, Number, compile, pose, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::Failure;
use linkage_codegen::graph::real::Real;
use linkage_codegen::program::Fault;

/// Angles of the crank at which a four-bar has `sin μ = ±distance`, near its stretched and its folded position.
fn near_toggle([g, a, b, c]: [f64; 4], distance: f64) -> Vec<f64> {
    let mut angles = Vec::new();
    for stretched in [1.0, -1.0] {
        // D² = b² + c² + 2bc cos μ', with cos μ' = ±√(1 − distance²)
        let d2 = b * b + c * c + stretched * 2.0 * b * c * (1.0 - distance * distance).sqrt();
        let cosine = (g * g + a * a - d2) / (2.0 * g * a);
        if cosine.abs() < 1.0 {
            angles.extend([cosine.acos(), -cosine.acos()]);
        }
    }
    angles
}

#[test]
fn toggles_inner_and_outer() {
    let mut random = Random(11);
    let families = (0..120).map(|index| {
        let lengths = [0; 4].map(|_| length(&mut random, 0.3, 2.0));
        let text = four_bar_along_x(lengths);
        let drives = near_toggle(lengths, 10f64.powi(-(index % 7) - 1));
        Family { text, longest: lengths.into_iter().fold(0.0, f64::max), drives, loads: loads(&mut random) }
    });
    assert!(check(families, "toggles") > 50);
}

/// A load on the coupler next to a pin that hardly moves has little power: by way of the crank's pin, whose velocity the coupler's turning takes
/// away again, six times the rounding would be left.
#[test]
fn loads_next_to_a_pin_that_hardly_moves() {
    let linkage = compile(&format!(
        "pub mod sample; ground {{ A0: (0, 0), B0: 1.5m @ 135deg }} link crank {{ A0 -> A: 0.125m }}
         link coupler {{ A -> B: 1m, C: (0.9375m, -0.015625m) }} link rocker {{ B0 -> B: 1.875m, D: (0, 0.9375m) }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: right(A -> B0);
         load F: force(coupler.C); load H: force(rocker.D); {SCENES}"
    ));
    let mut random = Random(29);
    let mut worst = 0.0f64;
    for _ in 0..2000 {
        // Crank and coupler are in line at −2.54 rad.
        let drives = vec![random.range(-2.6, -2.5)];
        let arguments = Arguments { drives, loads: loads(&mut random), ..Arguments::default() };
        let kept = pose::<Double>(&linkage, &arguments).expect("a pose");
        let exactly = kept.iter().map(|(node, value)| (*node, Extended::exactly(value.0))).collect();
        let rounded = from_kept(&linkage, "work", &kept, &arguments).expect("a torque")["T"].0;
        let exact = from_kept::<Extended>(&linkage, "work", &exactly, &arguments).expect("a torque")["T"].clone();
        let forces: f64 = arguments.loads.iter().map(|[x, y]| x.hypot(*y)).sum();
        let error = Extended::exactly(rounded).sub(&exact).to_f64().abs();
        worst = worst.max(error / (forces * 0.125 * f64::EPSILON));
    }
    println!("{worst:.3} ε of the loads at the crank's length");
    assert!(worst < 0.4, "{worst:.3} ε");
}

/// A four-bar with its ground line along x.
fn four_bar_along_x([g, a, b, c]: [f64; 4]) -> String {
    format!(
        "pub mod sample; ground {{ A0: (0, 0), B0: ({g:?}m, 0) }} link crank {{ A0 -> A: {a:?}m }}
         link coupler {{ A -> B: {b:?}m, C: (0.25m, 0.125m) }} link rocker {{ B0 -> B: {c:?}m, D: (0.5m, -0.25m) }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0);
         load F: force(coupler.C); load H: force(rocker.D); {SCENES}"
    )
}

#[test]
fn folding_linkages_near_their_folds() {
    // Parallelogram, kites, change points: g, a, b, c.
    let folding = [
        [1.0, 0.5, 1.0, 0.5],
        [0.5, 1.0, 0.5, 1.0],
        [1.0, 1.0, 1.0, 1.0],
        [1.0, 1.0, 0.5, 0.5],
        [0.5, 1.0, 1.0, 0.5],
        [1.75, 1.0, 1.25, 1.5],
        [1.5, 0.5, 1.25, 0.75],
    ];
    let mut random = Random(12);
    let (mut solved, mut solved_in_single) = (0, 0);
    for lengths in folding {
        let text = four_bar_along_x(lengths);
        let values = loads(&mut random);
        let [double, single_precision] = [compile(&text), compile(&in_single_precision(&text))];
        for exponent in 0..=7 {
            let distance = 10f64.powi(-exponent);
            for drive in [distance, -distance, core::f64::consts::PI - distance, distance - core::f64::consts::PI] {
                let near = |drive| Arguments { drives: vec![drive], loads: values.clone(), ..Arguments::default() };
                let what = format!("{lengths:?} at {drive:e}");
                solved += usize::from(is_exact::<Double>(&double, &near(drive), f64::EPSILON, &what));
                let what = format!("{what}, f32");
                let epsilon = f64::from(f32::EPSILON);
                let is_exact = is_exact::<Single>(&single_precision, &near(single(drive)), epsilon, &what);
                solved_in_single += usize::from(is_exact);
            }
        }
    }
    // The others cannot be assembled.
    assert!(solved >= 208 && solved_in_single >= 208, "{solved}, in single precision {solved_in_single} of 224");
}

/// Whether there is an answer, which is then within 4 ε of the largest number in it.
fn is_exact<T: Number>(linkage: &Linkage, arguments: &Arguments, epsilon: f64, what: &str) -> bool {
    let Ok(found) = scene::<T>(linkage, "all", arguments) else { return false };
    let exact = scene::<Extended>(linkage, "all", arguments).expect("regular");
    let size = exact.values().fold(0.0f64, |m, x| m.max(x.to_f64().abs()));
    for (path, value) in &exact {
        let error = Extended::exactly(found[path].to_f64()).sub(value).to_f64().abs() / size;
        assert!(error <= 4.0 * epsilon, "{what}: {path} is off by {:.2} ε", error / epsilon);
    }
    true
}

#[test]
fn links_of_very_different_lengths() {
    let mut random = Random(13);
    let mut families = Vec::new();
    for exponent in 2..=8 {
        let small = 10f64.powi(-exponent);
        for [b, c] in [[small, 1.0], [1.0, small]] {
            // The ground and the crank bring the outer pins to a distance near the longer leg.
            let lengths = [1.0, small / 2.0, b, c];
            let drives = (0..20).map(|_| random.range(-3.0, 3.0)).collect();
            families.push(Family { text: four_bar_along_x(lengths), longest: 1.0, drives, loads: loads(&mut random) });
        }
    }
    let mut singles = families.into_iter();
    // In doubles all ratios; single precision tells lengths apart up to about 10⁴.
    let (near, far): (Vec<_>, Vec<_>) = singles.by_ref().enumerate().partition(|(index, _)| *index < 6);
    assert!(check(near.into_iter().map(|(_, family)| family), "ratios up to 10⁴") > 20);
    for (_, family) in far {
        let (worst, _) = worst::<Double>(&family, "f64", f64::EPSILON);
        worst.assert_within(&BARS, "ratios up to 10⁸");
    }
}

#[test]
fn poses_along_the_axes_are_regular() {
    let quarter = core::f64::consts::FRAC_PI_2;
    let mut random = Random(14);
    let drives: Vec<f64> = (-4..=4).map(|k| f64::from(k) * quarter).collect();
    let families = [
        // Crank-rockers and double cranks whose crank lies along the axes, and so do other links.
        Family {
            text: four_bar_along_x([2.0, 0.5, 1.75, 1.0]),
            longest: 2.0,
            drives: drives.clone(),
            loads: loads(&mut random),
        },
        Family {
            text: four_bar_along_x([0.5, 1.0, 1.25, 1.0]),
            longest: 1.25,
            drives: drives.clone(),
            loads: loads(&mut random),
        },
        // Unit square: all links along the axes.
        Family {
            text: four_bar_along_x([1.0, 1.0, 1.0, 1.0]),
            longest: 1.0,
            drives: vec![quarter, -quarter],
            loads: loads(&mut random),
        },
        Family {
            text: slider_crank([0.5, 1.5, 0.0], &mut random),
            longest: 1.5,
            drives: drives.clone(),
            loads: loads(&mut random),
        },
        Family { text: slider_crank([0.5, 1.0, 0.5], &mut random), longest: 1.0, drives, loads: loads(&mut random) },
    ];
    assert!(check(families.into_iter(), "along the axes") > 25);
}

/// In-line slider-cranks and collinear pins: aligned, and regular all the same.
#[test]
fn aligned_poses_are_regular() {
    let in_line = "pub mod sample; ground { O: (0, 0), G: (0, 0) } link crank { O -> A: 0.5m } link rod { A -> B: 1.5m } link piston { B, G: (0, 0) }
        revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston; prismatic G: ground -> piston along 0deg;
        drive q: O; unknown T: torque(ground -> crank); assemble B: ahead(A); load F: force(piston.B); scene all: equilibrium; scene work: virtual_work;";
    let linkage = compile(in_line);
    let arguments = Arguments { drives: vec![0.0], loads: vec![[-100.0, 7.0]], ..Arguments::default() };
    let all = scene::<Double>(&linkage, "all", &arguments).unwrap();
    // At the dead centre of the piston the crank carries no torque, and that is a right answer.
    assert_eq!((all["T"].0, all["A.x"].0, all["B.x"].0, all["G.normal"].0), (0.0, 100.0, 100.0, -7.0));
    // Three pins on one line of the coupler.
    let collinear = four_bar_along_x([2.0, 0.5, 1.75, 1.0]).replace("C: (0.25m, 0.125m)", "C: (0.875m, 0)");
    let family = Family {
        text: collinear,
        longest: 2.0,
        drives: (0..40).map(|k| f64::from(k) * 0.157).collect(),
        loads: vec![[3.0, -5.0], [1.0, 2.0]],
    };
    assert_eq!(check([family].into_iter(), "three collinear pins"), 40);
}

#[test]
fn the_ground_line_may_have_any_angle() {
    let mut random = Random(16);
    // A change-point linkage whose fold lies at half a turn from an inclined ground line.
    for degrees in [30.0f64, 90.0, 123.456, 180.0, -77.5] {
        let text =
            four_bar_along_x([1.75, 1.0, 1.25, 1.5]).replace("B0: (1.75m, 0)", &format!("B0: 1.75m @ {degrees:?}deg"));
        let linkage = compile(&format!("{text} scene parts: superposition;"));
        let values = loads(&mut random);
        for exponent in 1..=7 {
            let drive = degrees.to_radians() + core::f64::consts::PI - 10f64.powi(-exponent);
            let arguments = Arguments { drives: vec![drive], loads: values.clone(), ..Arguments::default() };
            let found = scene::<Double>(&linkage, "all", &arguments).unwrap();
            let exact = scene::<Extended>(&linkage, "all", &arguments).unwrap();
            // Near the fold the loads' own forces are large, and may cancel.
            let parts = scene::<Extended>(&linkage, "parts", &arguments).unwrap();
            let size = parts.values().fold(0.0f64, |m, x| m.max(x.to_f64().abs()));
            for (path, value) in &exact {
                let error = Extended::exactly(found[path].0).sub(value).to_f64().abs() / size;
                assert!(error < 2e-15, "{degrees}°, {path} is off by {error:e}, 1e-{exponent} from the fold");
            }
        }
    }
}

/// `(x + ulp, x − ulp)`
fn neighbours(x: f64) -> [f64; 2] {
    [x.next_up(), x.next_down()]
}

#[test]
fn what_cannot_be_assembled_is_a_typed_error() {
    // A driven slider brings the pins of a dyad of lengths 1 and 2 to any distance.
    let text = "pub mod sample; ground { S: (0, 0), B0: (0, 0) } link slide { S } link a { S -> B: 1m } link b { B0 -> B: 2m }
        prismatic S: ground -> slide along 0deg; revolute A: slide.S -> a.S; revolute B: a -> b; revolute B0: ground -> b;
        drive x: S; assemble B: left(A -> B0); load F: force(a.B); load H: force(b.B); scene all: equilibrium; scene parts: superposition;
        scene work: virtual_work; scene where: position;";
    let linkage = compile(text);
    let run = |name: &str, x: f64, load: f64| {
        let arguments = Arguments { drives: vec![x], loads: vec![[load, 1.0], [2.0, -1.0]], ..Arguments::default() };
        scene::<Double>(&linkage, name, &arguments)
    };
    for far in [3.03, 30.0, 1e10, 1e200, -3.03] {
        for name in ["all", "parts", "work", "where"] {
            let fault = run(name, far, 1.0).unwrap_err();
            assert!(matches!(fault, Fault::Failed(Failure::CannotAssemble { .. })), "{name} at {far}: {fault:?}");
        }
    }
    for close in [0.99, -0.5, 1e-3, 0.0, -0.0] {
        let fault = run("where", close, 1.0).unwrap_err();
        assert!(matches!(fault, Fault::Failed(Failure::CannotAssemble { .. })), "at {close}: {fault:?}");
    }
    // Stretched and folded exactly, and by one ulp: a place, but no forces whatever the loads.
    for limit in [3.0, 1.0, -3.0, -1.0] {
        for x in neighbours(limit).into_iter().chain([limit]) {
            run("where", x, 1.0).unwrap();
            for load in [0.0, 1.0] {
                for name in ["all", "parts", "work"] {
                    let fault = run(name, x, load).unwrap_err();
                    assert!(matches!(fault, Fault::Failed(Failure::DeadCentre { .. })), "{name} at {x}: {fault:?}");
                }
            }
        }
    }
    // Legs of one length with the pins together: the place of B is open.
    let equal = compile(&text.replace("B0 -> B: 2m", "B0 -> B: 1m"));
    for x in [0.0, -0.0] {
        let arguments = Arguments { drives: vec![x], loads: vec![[0.0; 2]; 2], ..Arguments::default() };
        let fault = scene::<Double>(&equal, "where", &arguments).unwrap_err();
        assert!(matches!(fault, Fault::Failed(Failure::CoincidentPivots { .. })), "at {x}: {fault:?}");
    }
}

/// The block of a crank: its pin at the distance 1 from the crank's, beside the slide by the offset.
fn block_along_x(crank: f64, offset: f64) -> String {
    format!(
        "pub mod sample; ground {{ A0: (0, 0), C: (1m, 0) }} link crank {{ A0 -> A: {crank:?}m }}
         link rod {{ A: (0, 0), P: (0.25m, 0.125m) }} link block {{ C: (0, {offset:?}m), S: (0, 0), D: (0.5m, -0.25m) }}
         revolute A0: ground -> crank; revolute A: crank -> rod; prismatic S: rod.A -> block.S along 0deg of rod; revolute C: ground -> block;
         drive theta: A0; unknown T: torque(ground -> crank); assemble S: ahead(A);
         load F: force(rod.P); load H: force(block.D); {SCENES}"
    )
}

#[test]
fn blocks_whose_pins_are_nearly_square_to_the_slide() {
    let mut random = Random(18);
    let families = (0..140).map(|index| {
        let (crank, offset) = (length(&mut random, 0.6, 1.4), length(&mut random, 0.5, 0.9));
        // D = h/√(1 − distance²), with D² = 1 + a² − 2a cos θ
        let distance = 10f64.powi(-(index % 7) - 1);
        let d2 = offset * offset / (1.0 - distance * distance);
        let angle = ((1.0 + crank * crank - d2) / (2.0 * crank)).acos();
        let (drives, loads) = (vec![angle, -angle], loads(&mut random));
        Family { text: block_along_x(crank, offset), longest: crank.max(1.0), drives, loads }
    });
    assert!(check(families, "nearly square to the slide") > 150);
}

#[test]
fn blocks_whose_pins_nearly_meet() {
    let mut random = Random(19);
    let drives = (0..=6).flat_map(|k| [10f64.powi(-k), -10f64.powi(-k)]).collect();
    let family = Family { text: block_along_x(1.0, 0.0), longest: 1.0, drives, loads: loads(&mut random) };
    assert_eq!(check([family].into_iter(), "pins that nearly meet"), 14);
}

#[test]
fn slides_that_are_nearly_parallel() {
    let mut random = Random(20);
    for exponent in 1..=6 {
        let slope = 10f64.powi(-exponent);
        let text =
            tangent_mechanism([1.0, 0.0, 0.0], &mut random).replace("G: (1.0m, 0)", &format!("G: (1.0m, {slope:?}m)"));
        let family = Family { text, longest: 1.0, drives: vec![slope, -slope], loads: loads(&mut random) };
        assert_eq!(check([family].into_iter(), "nearly parallel"), 2);
    }
}

/// Where a link is longer than others reach by less than rounding, poses at which they reach farthest have places, and forces or a dead centre.
#[test]
fn lengths_that_differ_by_less_than_rounding() {
    let (mut dead, mut alive) = (0, 0);
    let mut check = |text: &str, drives: &[f64]| {
        let arguments = Arguments { drives: drives.to_vec(), loads: vec![[1.0, 2.0]], ..Arguments::default() };
        for arithmetic in ["plain", "fused"] {
            let linkage = compile(&text.replacen(';', &format!("; arithmetic {arithmetic};"), 1));
            scene::<Double>(&linkage, "where", &arguments).unwrap_or_else(|fault| panic!("{fault:?}, {text}"));
            match scene::<Double>(&linkage, "all", &arguments) {
                Ok(values) => {
                    assert!(values.values().all(|value| value.0.is_finite()), "{text}");
                    alive += 1;
                }
                Err(Fault::Failed(Failure::DeadCentre { .. })) => dead += 1,
                Err(fault) => panic!("{fault:?}, {text}"),
            }
        }
    };
    let decimal = |tenths: u32, more: &str| format!("{}.{}{more}m", tenths / 10, tenths % 10);
    let straight = core::f64::consts::PI;
    for (a, c) in (1..30).flat_map(|a| (1..30).map(move |c| (a, c))).step_by(7) {
        for more in ["000000000000000001", "0000000000000000001"] {
            let [crank, offset, rod] = [decimal(a, ""), decimal(c, ""), decimal(a + c, more)];
            let slider = format!(
                "pub mod sample; ground {{ A0: (0, 0), C: (0, -{offset}) }} link crank {{ A0 -> A: {crank} }} link rod {{ A -> B: {rod} }}
                 link piston {{ B }} revolute A0: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston;
                 prismatic C: ground.C -> piston.B along 0deg; drive theta: A0; assemble B: ahead(A);
                 load F: force(piston.B); scene all: equilibrium; scene where: position;"
            );
            check(&slider, &[straight / 2.0]);
            let ground = decimal(3, "");
            let five = format!(
                "pub mod sample; ground {{ A0: (0, 0), B0: ({ground}, 0) }} link a {{ A0 -> A: {crank} }} link b {{ B0 -> B: {offset} }}
                 link c {{ A -> C: {ground} }} link d {{ B -> C: {rod} }} revolute A0: ground -> a; revolute B0: ground -> b;
                 revolute A: a -> c; revolute B: b -> d; revolute C: c -> d; drive p: A0; drive q: B0; assemble C: left(A -> B);
                 load F: force(c.C); scene all: equilibrium; scene where: position;"
            );
            check(&five, &[straight, 0.0]);
        }
    }
    assert!(dead > 100, "{dead} dead centres, {alive} others");
}

#[test]
fn where_dyads_with_inner_slides_end_is_a_typed_error() {
    let run = |text: &str, name: &str, drive: f64| {
        let arguments = Arguments { drives: vec![drive], loads: vec![[1.0, 1.0], [2.0, -1.0]], ..Arguments::default() };
        scene::<Double>(&compile(&format!("{text} scene where: position;")), name, &arguments)
    };
    // The crank's pin comes as near to the block's as half of what the block holds it off.
    let near = block_along_x(0.75, 0.5);
    for name in ["all", "work", "where"] {
        let fault = run(&near, name, 0.0).unwrap_err();
        assert!(matches!(fault, Fault::Failed(Failure::CannotAssemble { .. })), "{name}: {fault:?}");
    }
    // Exactly as far as it is held off: a place, but no forces.
    let square = block_along_x(0.5, 0.5);
    run(&square, "where", 0.0).unwrap();
    for name in ["all", "work"] {
        let fault = run(&square, name, 0.0).unwrap_err();
        assert!(matches!(fault, Fault::Failed(Failure::DeadCentre { .. })), "{name}: {fault:?}");
    }
    let fault = run(&block_along_x(1.0, 0.0), "where", 0.0).unwrap_err();
    assert!(matches!(fault, Fault::Failed(Failure::CoincidentPivots { .. })), "{fault:?}");
    let fault = run(&block_along_x(1.0, 0.0), "where", f64::from(1u32 << 30) * f64::EPSILON / f64::from(1u32 << 30))
        .unwrap_err();
    assert!(matches!(fault, Fault::Failed(Failure::CoincidentPivots { .. })), "{fault:?}");
    // Slides that become parallel.
    let mut random = Random(21);
    let parallel = tangent_mechanism([1.0, 0.25, 0.0], &mut random);
    for name in ["all", "work", "where"] {
        let fault = run(&parallel, name, 0.0).unwrap_err();
        assert!(matches!(fault, Fault::Failed(Failure::DeadCentre { .. })), "{name}: {fault:?}");
    }
    // A cylinder without length, one that is too short, and one that is too long.
    let cylinder = boom([1.0, 1.5, 0.0], &mut random);
    for (extension, coincides) in [(0.0, true), (-0.0, true), (0.4, false), (-0.4, false), (2.6, false), (1e100, false)]
    {
        for name in ["all", "work", "where"] {
            let fault = run(&cylinder, name, extension).unwrap_err();
            let found = match &fault {
                Fault::Failed(Failure::CoincidentPivots { .. }) => coincides,
                Fault::Failed(Failure::CannotAssemble { .. }) => !coincides,
                _ => false,
            };
            assert!(found, "{name} at {extension}: {fault:?}");
        }
    }
    for limit in [0.5, 2.5] {
        run(&cylinder, "where", limit).unwrap();
        for name in ["all", "work"] {
            let fault = run(&cylinder, name, limit).unwrap_err();
            assert!(matches!(fault, Fault::Failed(Failure::DeadCentre { .. })), "{name} at {limit}: {fault:?}");
        }
    }
    // A negative length turns the cylinder round, and is as good.
    for extension in [1.7, -1.7] {
        run(&cylinder, "all", extension).unwrap();
    }
}

/// Parts of a way that turn against each other with a parameter, as links welded at an angle, may fold: what their lengths add up to keeps nothing
/// apart.
#[test]
fn where_a_parameter_folds_welded_links_is_a_typed_error() {
    let arm = "units { mm, N } ground { O: (0, 0), E: (50mm, 0) } revolute O: ground -> a; weld W: a -> b, angle beta; drive theta: O;
        link a { O: (0, 0), W: (30mm, 0) } link b { W: (0, 0), Q: (30mm, 0) } load G: force(b.Q); scene held: equilibrium;";
    let barrel = |own: &str| {
        format!(
            "link barrel {{ O: (0, 0), P: {own} }} link piston {{ Q }} revolute O2: ground.O -> barrel.O; load M: moment(barrel);
            revolute Q: b -> piston; prismatic S: barrel.P -> piston.Q along 0deg of barrel; assemble S: ahead(O2);"
        )
    };
    let lever = |own: &str| {
        format!(
            "link lever {{ O: (0, 0), P: {own} }} revolute O2: ground.O -> lever.O; load M: moment(lever);
            slot S: lever.P -> b.Q along 0deg of lever; assemble S: ahead(O2);"
        )
    };
    let dyad = "link c { Q -> R: 30mm } link d { E -> R: 25mm } revolute Q: b -> c; revolute R: c -> d; revolute E: ground -> d;
        assemble R: left(Q -> E); load M: moment(d);";
    let (spring, thrust) = ("load K: spring(ground.O, b.Q) { rate: 3N/mm, free: 10mm };", "load H: thrust(a.O, b.Q);");
    // Folded, Q lies on O; with the half angle whose cosine is 5/6 it is as far from it as E, and with the crank turned back by it on E.
    let half = (5.0f64 / 6.0).acos();
    let (on_o, on_e) = ([0.4, core::f64::consts::PI], [-half, 2.0 * half]);
    for (rest, pose, error) in [
        (spring.to_owned(), on_o, "CoincidentEnds"),
        (thrust.to_owned(), on_o, "CoincidentEnds"),
        (barrel("(5mm, 0)"), on_o, "CoincidentPivots"),
        (barrel("(0, 5mm)"), on_o, "CannotAssemble"),
        (lever("(5mm, 0)"), on_o, "CoincidentPivots"),
        (lever("(0, 5mm)"), on_o, "CannotAssemble"),
        (dyad.to_owned(), on_e, "CannotAssemble"),
    ] {
        let linkage = compile(&format!("mod m; param beta: angle; {arm} {rest}"));
        let run = |[theta, beta]: [f64; 2]| {
            let loads = vec![[1.0, 2.0]; linkage.model.loads.len()];
            let arguments = Arguments { drives: vec![theta], loads, params: vec![beta], ..Arguments::default() };
            scene::<Double>(&linkage, "held", &arguments)
        };
        let fault = run(pose).unwrap_err();
        assert!(format!("{fault:?}").contains(error), "{rest}: {fault:?}");
        assert!(run([0.4, 0.1]).is_ok(), "{rest}");
    }
}
