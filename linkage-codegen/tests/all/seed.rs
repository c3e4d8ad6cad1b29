//! The seed example, METU 6.3: a change-point linkage (80 + 140 = 100 + 120) with forces on coupler and rocker.

use std::collections::HashMap;

use crate::support::numbers::{Double, Extended};
use crate::support::{Arguments, Number, compile, pose, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::Failure;
use linkage_codegen::graph::real::Real;
use linkage_codegen::program::Fault;

fn declaration(closure: &str) -> String {
    format!(
        "pub mod four_bar; units {{ mm, N }}
         ground {{ A0: (0, 0), B0: (140mm, 0) }} link crank {{ A0 -> A: 80mm }}
         link coupler {{ A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }} link rocker {{ B0 -> B: 120mm, D: (90mm, 0) }}
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; unknown T12: torque(ground -> crank); assemble B: {closure};
         load F13: force(coupler.C) = 50N @ 230deg; load F14: force(rocker.D) = 100N @ 200deg;
         scene statics: equilibrium; scene parts: superposition; scene torque: virtual_work -> (T12);
         scene whole: position; scene rate: virtual_work(F14) -> (F14);"
    )
}

fn at(theta: f64) -> Arguments {
    Arguments { drives: vec![theta], loads: vec![[0.0; 2]; 2], ..Arguments::default() }
}

fn solved<T: Number>(linkage: &Linkage, name: &str, theta: f64) -> Result<HashMap<String, T>, Fault> {
    scene(linkage, name, &at(theta))
}

/// The exact values at θ = 60°, not the textbook page's rounded or misprinted ones.
#[test]
fn the_published_pose_has_its_exact_forces() {
    let linkage = compile(&declaration("left(A -> B0)"));
    let theta = 60f64.to_radians();
    let all = solved::<Double>(&linkage, "statics", theta).unwrap();
    let parts = solved::<Double>(&linkage, "parts", theta).unwrap();
    let work = solved::<Double>(&linkage, "torque", theta).unwrap();
    let places = solved::<Double>(&linkage, "whole", theta).unwrap();
    let expected = [
        (&all, "T12", -2_901.327_662_074_53),
        (&work, "T12", -2_901.327_662_074_53),
        // F34, the force on the rocker by the coupler.
        (&all, "B.x", 66.601_819_945_189_1),
        (&all, "B.y", 60.189_362_236_451_6),
        // G14, on the rocker by the ground.
        (&all, "B0.x", 27.367_442_133_401_7),
        (&all, "B0.y", -25.987_347_903_884_8),
        // F23, on the coupler by the crank, and so on the crank by the ground.
        (&all, "A.x", 98.741_200_429_516_1),
        (&all, "A.y", 98.491_584_392_400_5),
        (&all, "A0.x", 98.741_200_429_516_1),
        (&all, "A0.y", 98.491_584_392_400_5),
        (&parts, "F14.T12", -3_183.440_520_968_37),
        (&parts, "F13.T12", 282.112_858_893_847),
    ];
    for (values, path, exact) in expected {
        let error = (values[path].0 - exact) / exact;
        assert!(error.abs() < 1e-13, "{path}: {} instead of {exact}", values[path].0);
    }
    for (path, degrees) in [("coupler_angle", 29.979_957_439_997_5), ("rocker_angle", 96.401_778_961_795_7)] {
        let error = places[path].0.to_degrees() / degrees - 1.0;
        assert!(error.abs() < 1e-13, "{path}: {}°", places[path].0.to_degrees());
    }
}

/// Largest error of a force over the pose's largest force, and of the torque over its own scale `80 mm · F`.
fn force_error(linkage: &Linkage, theta: f64) -> f64 {
    let found = solved::<Double>(linkage, "statics", theta).unwrap();
    let exact = solved::<Extended>(linkage, "statics", theta).unwrap();
    let forces = || exact.iter().filter(|(path, _)| *path != "T12");
    let largest = forces().fold(0.0f64, |m, (_, force)| m.max(force.to_f64().abs()));
    forces()
        .map(|(path, force)| Extended::exactly(found[path].0).sub(force).to_f64().abs() / largest)
        .fold(0.0, f64::max)
}

/// Over a whole turn in half-degree steps: the doubles, not the decimals.
#[test]
fn the_whole_turn_is_exact_to_rounding_through_the_change_point() {
    let linkage = compile(&declaration("left(A -> B0)"));
    let mut worst = (0.0, 0);
    for half_degrees in -360..=360 {
        if half_degrees == 360 || half_degrees == -360 {
            continue;
        }
        let error = force_error(&linkage, (f64::from(half_degrees) * 0.5).to_radians());
        if error > worst.0 {
            worst = (error, half_degrees);
        }
    }
    println!("worst {:e} at {}°", worst.0, f64::from(worst.1) * 0.5);
    assert!(worst.0 <= 2e-15, "{:e} at {}°", worst.0, f64::from(worst.1) * 0.5);
    // Next to the change point, where the closure by two circles has lost all digits.
    for distance in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13] {
        for theta in [core::f64::consts::PI - distance, core::f64::consts::PI + distance] {
            let error = force_error(&linkage, theta);
            assert!(error <= 2e-15, "{error:e} at π ± {distance:e}");
        }
    }
}

#[test]
fn at_the_change_point_forces_are_a_typed_error_and_places_are_not() {
    for closure in ["left(A -> B0)", "right(A -> B0)", "left(A -> B0) smooth at 60deg"] {
        let linkage = compile(&declaration(closure));
        for theta in [core::f64::consts::PI, -core::f64::consts::PI, 3.0 * core::f64::consts::PI] {
            for scene in ["statics", "parts", "torque"] {
                let fault = solved::<Double>(&linkage, scene, theta).unwrap_err();
                let Fault::Failed(Failure::DeadCentre { group, pivot }) = fault else { panic!("{fault:?}") };
                assert_eq!((group.as_str(), pivot.as_str()), ("coupler + rocker", "sin_mu_B"));
            }
            let places = solved::<Double>(&linkage, "whole", theta).unwrap();
            assert!((places["B.x"].0 - 20.0).abs() < 1e-12 && places["B.y"].0.abs() < 1e-5, "{places:?}");
        }
    }
}

/// The side of the joint B: positive on the left of A → B0.
fn side(linkage: &Linkage, theta: f64) -> f64 {
    let kept = pose::<Double>(linkage, &at(theta)).unwrap();
    let pivot = linkage.plan.pose.iter().find(|kept| kept.name == "sin_mu_B").unwrap();
    kept[&pivot.node].0
}

#[test]
fn a_fixed_side_stays_and_a_smooth_motion_goes_through_the_fold() {
    let fixed = compile(&declaration("left(A -> B0)"));
    let smooth = compile(&declaration("left(A -> B0) smooth at 60deg"));
    let step = 0.1f64.to_radians();
    let mut before: Option<[f64; 2]> = None;
    for index in 0..7200 {
        let theta = (f64::from(index) + 0.5) * step;
        assert!(side(&fixed, theta) > 0.0, "{theta}");
        // Through half a turn the smooth motion changes its side, and after two whole turns it is back.
        let half_turns = (theta / core::f64::consts::PI).rem_euclid(4.0);
        let expected = if (1.0..3.0).contains(&half_turns) { -1.0 } else { 1.0 };
        assert!(side(&smooth, theta) * expected > 0.0, "{theta}");
        // The rocker moves on by no more than a few steps of the crank: no jump.
        let places = solved::<Double>(&smooth, "whole", theta).unwrap();
        let b = [places["B.x"].0, places["B.y"].0];
        if let Some(last) = before {
            let moved = (b[0] - last[0]).hypot(b[1] - last[1]);
            assert!(moved < 120.0 * 2.0 * step, "jump of {moved} at {theta}");
        }
        before = Some(b);
    }
}

/// The velocity ratio through the fold is that of the smooth motion: ω₃/ω₂ = −0.163 on both sides of 180°.
#[test]
fn the_smooth_motion_keeps_its_velocity_ratio() {
    let smooth = compile(&declaration("left(A -> B0) smooth at 60deg"));
    let angle = |theta: f64| {
        let places = solved::<Extended>(&smooth, "whole", theta).unwrap();
        places["coupler_angle"].to_f64()
    };
    let ratio = |theta: f64| {
        let change = angle(theta + 5e-5) - angle(theta - 5e-5);
        (change - (change / core::f64::consts::TAU).round() * core::f64::consts::TAU) / 1e-4
    };
    let (before, after) = (ratio(core::f64::consts::PI - 1e-3), ratio(core::f64::consts::PI + 1e-3));
    assert!((before - after).abs() < 1e-2, "{before} {after}");
    println!("{before} {after}");
    assert!((before + 0.163).abs() < 1e-3, "{before}");
}
