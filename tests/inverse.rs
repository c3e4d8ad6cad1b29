//! Inverse scenes as a user has them: the drives for a wanted motion of an output, and what cannot be reached.

use core::f64::consts::TAU;

use linkage_runtime::cycle::unwrap;
use linkage_runtime::{Error, Series, Side, SweepError, linkage};

linkage! {
    /// A crank-rocker, asked for the crank both ways.
    mod four_bar;
    units { mm, N }
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm }
    link rocker  { B0 -> B: 80mm }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0);
    assemble A: either(A0 -> B);
    load M4: moment(rocker);
    scene places: position -> (rocker.angle);
    scene speeds: velocity -> (rocker.angle);
    scene accelerations: acceleration -> (rocker.angle);
    scene crank_of: inverse(B0);
    scene angle_of: inverse(B0) -> (theta);
    scene cycle: sweep(crank_of);
    scene angles: sweep(angle_of);
}

linkage! {
    /// A press of run-time length in single precision: the crank for a wanted stroke.
    mod press;
    scalar f32;
    units { mm, N }
    param length: length = 130mm;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: length }
    link ram    { B }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> ram;
    prismatic S: ground.O -> ram.B along 0deg;
    drive theta: O { rate: 3rad/s, acceleration: 0 };
    assemble B: ahead(A);
    assemble A: left(O -> B);
    scene places: position -> (B);
    scene speeds: velocity -> (B);
    scene accelerations: acceleration -> (B);
    scene crank_of: inverse(S);
    scene stroke: sweep(crank_of);
}

linkage! {
    /// A double rocker: its two assemblies swing over common angles.
    mod rocker;
    ground       { A0: (0, 0), B0: (1.2m, 0) }
    link crank   { A0 -> A: 0.9m }
    link coupler { A -> B: 0.5m }
    link rocker  { B0 -> B: 0.8m }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0);
    assemble A: either(A0 -> B);
    scene places: position -> (rocker.angle);
    scene crank_of: inverse(B0) -> (theta, theta.rate);
}

linkage! {
    /// A five-bar that a tool's slide and pin are to guide.
    mod five_bar;
    ground     { O1: (0, 0), O2: (0.5m, 0), S: (0.25m, 0.4m) }
    link left  { O1 -> P: 0.3m }
    link right { O2 -> Q: 0.35m }
    link upper { P -> R: 0.45m }
    link lower { Q -> R: 0.4m }
    revolute O1: ground -> left;
    revolute O2: ground -> right;
    revolute P: left -> upper;
    revolute Q: right -> lower;
    revolute R: upper -> lower;
    drive a: O1;
    drive b: O2;
    assemble R: left(P -> Q);
    assemble P: either(O1 -> R);
    scene places: position -> (lower.angle, right.angle);
    scene speeds: velocity -> (lower.angle, right.angle);
    scene accelerations: acceleration -> (lower.angle, right.angle);
    scene drives_of: inverse(O2, Q);
}

fn turned(a: f64, b: f64) -> f64 {
    (a - b) - TAU * ((a - b) / TAU).round()
}

#[test]
fn the_crank_is_found_from_the_motion_of_the_rocker() -> Result<(), Error> {
    for theta in (0..48).map(|step| 0.05 + 0.13 * f64::from(step)) {
        let motion = four_bar::Motion { theta_rate: 12.0, theta_acceleration: -70.0 };
        let angle = four_bar::places_at(theta, closures(Side::Left))?.rocker_angle;
        let rate = four_bar::speeds_at(theta, closures(Side::Left), &motion)?.rocker_angle;
        let acceleration = four_bar::accelerations_at(theta, closures(Side::Left), &motion)?.rocker_angle;
        let wanted = four_bar::CrankOfMotion { B0_angle_rate: rate, B0_angle_acceleration: acceleration };
        let found = [Side::Left, Side::Right].map(|side| four_bar::crank_of_at(angle, closures(side), &wanted));
        let mut back = 0;
        for (found, side) in found.into_iter().zip([Side::Left, Side::Right]) {
            let found = found?;
            assert_eq!(found.theta.to_bits(), four_bar::angle_of_at(angle, closures(side))?.theta.to_bits());
            let again = four_bar::places_at(found.theta, closures(side))?.rocker_angle;
            assert!((again - angle).abs() < 1e-12, "{angle} {again}");
            if turned(found.theta, theta).abs() < 1e-6 {
                back += 1;
                assert!(
                    (found.theta_rate - 12.0).abs() < 1e-8 && (found.theta_acceleration + 70.0).abs() < 1e-5,
                    "{found:?}"
                );
            }
        }
        assert_eq!(back, 1);
    }
    Ok(())
}

fn closures(side: Side) -> four_bar::Closures {
    four_bar::Closures { A: side }
}

#[test]
fn what_the_rocker_does_not_reach_is_an_error() {
    let wanted = four_bar::CrankOfMotion::default();
    assert!(matches!(
        four_bar::crank_of_at(0.2, closures(Side::Left), &wanted),
        Err(Error::CannotAssemble { group: "crank + coupler", joint: "A", .. })
    ));
    assert!(matches!(
        four_bar::crank_of_at(f64::NAN, closures(Side::Left), &wanted),
        Err(Error::NotFinite { what: "B0_angle" })
    ));
    let wanted = four_bar::CrankOfMotion { B0_angle_rate: f64::INFINITY, B0_angle_acceleration: 0.0 };
    assert!(matches!(four_bar::crank_of_at(1.8, closures(Side::Left), &wanted), Err(Error::NotFinite { .. })));
}

/// Of the angles that the other assembly alone reaches, nothing is given.
#[test]
fn no_drive_is_found_on_the_other_side() -> Result<(), Error> {
    let (mut found, mut other) = (0, 0);
    for angle in (0..200).map(|step| -3.0 + 0.03 * f64::from(step)) {
        for side in [Side::Left, Side::Right] {
            let closures = rocker::Closures { A: side };
            let wanted = rocker::CrankOfMotion { B0_angle_rate: 1.0 };
            match rocker::crank_of_at(angle, closures, &wanted) {
                Ok(crank) => {
                    found += 1;
                    let again = rocker::places_at(crank.theta, closures)?.rocker_angle;
                    assert!(turned(again, angle).abs() < 1e-9, "{angle} {again}");
                }
                Err(Error::OtherSide { joint: "B" }) => other += 1,
                Err(error) => assert!(matches!(error, Error::CannotAssemble { .. }), "{error}"),
            }
        }
    }
    assert!(found > 40 && other > 40, "{found} {other}");
    Ok(())
}

#[test]
fn the_crank_of_a_press_is_found_from_its_stroke() -> Result<(), Error> {
    let linkage = press::Linkage::new(&press::Params { length: 140.0 })?;
    for theta in [0.2f32, 0.9, 1.7, 2.6] {
        let stroke = press::places_at(&linkage, theta)?.B.x;
        let wanted = press::CrankOfMotion {
            S_travel_rate: press::speeds_at(&linkage, theta)?.B.x,
            S_travel_acceleration: press::accelerations_at(&linkage, theta)?.B.x,
        };
        let found = press::crank_of_at(&linkage, stroke, &wanted)?;
        assert!((found.theta - theta).abs() < 1e-5, "{found:?}");
        assert!((found.theta_rate - 3.0).abs() < 1e-4 && found.theta_acceleration.abs() < 2e-3, "{found:?}");
    }
    // At its dead centre no rate of the crank moves the ram.
    let ahead = press::crank_of_at(&linkage, 180.0, &press::CrankOfMotion::default());
    assert!(matches!(ahead, Err(Error::DeadCentre { .. })), "{ahead:?}");
    let beyond = press::crank_of_at(&linkage, 180.1, &press::CrankOfMotion::default());
    assert!(matches!(beyond, Err(Error::CannotAssemble { joint: "A", .. })), "{beyond:?}");
    Ok(())
}

/// A rocker that swings as a sine, and the crank that makes it do so: the sweep has the bits of the single positions.
#[test]
fn a_wanted_cycle_is_swept() -> Result<(), Box<dyn core::error::Error>> {
    const COUNT: usize = 101;
    let times: [f64; COUNT] = core::array::from_fn(|step| f64::from(u32::try_from(step).unwrap_or(0)) / 100.0);
    let angles = times.map(|t| 2.0 + 0.2 * (TAU * t).sin());
    let rates = times.map(|t| 0.2 * TAU * (TAU * t).cos());
    let accelerations = times.map(|t| -0.2 * TAU * TAU * (TAU * t).sin());
    let inputs = four_bar::CycleInputs {
        B0_angle: Series::Each(&angles),
        B0_angle_rate: Series::Each(&rates),
        B0_angle_acceleration: Series::Each(&accelerations),
    };
    let [mut theta, mut theta_rate, mut theta_acceleration] = [[0.0; COUNT]; 3];
    let results =
        four_bar::Cycle { theta: &mut theta, theta_rate: &mut theta_rate, theta_acceleration: &mut theta_acceleration };
    four_bar::cycle(closures(Side::Left), &inputs, results)?;
    for (index, angle) in angles.into_iter().enumerate() {
        let wanted =
            four_bar::CrankOfMotion { B0_angle_rate: rates[index], B0_angle_acceleration: accelerations[index] };
        let one = four_bar::crank_of_at(angle, closures(Side::Left), &wanted)?;
        let [found, expected] = [
            [theta[index], theta_rate[index], theta_acceleration[index]],
            [one.theta, one.theta_rate, one.theta_acceleration],
        ];
        assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{index}");
    }
    // The rate is the derivative of the angle over the cycle, whatever its turns.
    unwrap(&mut theta)?;
    for index in 1..COUNT - 1 {
        let slope = (theta[index + 1] - theta[index - 1]) / 0.02;
        assert!((slope - theta_rate[index]).abs() < 0.02 * (1.0 + theta_rate[index].abs()), "{index}: {slope}");
    }
    // Beyond its reach it stops, and says where.
    let far = [2.0, 2.1, 0.2, 2.0];
    let mut theta = [0.0; 4];
    let inputs = four_bar::AnglesInputs { B0_angle: Series::Each(&far) };
    let swept = four_bar::angles(closures(Side::Left), &inputs, four_bar::Angles { theta: &mut theta });
    assert!(matches!(swept, Err(SweepError::Position { index: 2, error: Error::CannotAssemble { .. } })), "{swept:?}");
    assert!(theta[1].abs() > 0.1 && theta[2..].iter().all(|theta| theta.to_bits() == 0));
    let short = four_bar::AnglesInputs { B0_angle: Series::Each(&far[..3]) };
    let swept = four_bar::angles(closures(Side::Left), &short, four_bar::Angles { theta: &mut theta });
    assert!(matches!(swept, Err(SweepError::Length { .. })), "{swept:?}");
    Ok(())
}

#[test]
fn a_stroke_of_given_length_is_swept() -> Result<(), Box<dyn core::error::Error>> {
    let linkage = press::Linkage::new(&press::Params { length: 140.0 })?;
    let strokes: [f32; 40] = core::array::from_fn(|step| 110.0 + 1.7 * u16::try_from(step).map_or(0.0, f32::from));
    let [mut theta, mut theta_rate, mut theta_acceleration] = [[0.0; 40]; 3];
    let inputs = press::StrokeInputs {
        S_travel: Series::Each(&strokes),
        S_travel_rate: Series::Constant(12.0),
        S_travel_acceleration: Series::Constant(-3.0),
    };
    let results =
        press::Stroke { theta: &mut theta, theta_rate: &mut theta_rate, theta_acceleration: &mut theta_acceleration };
    press::stroke(&linkage, &inputs, results)?;
    for (index, stroke) in strokes.into_iter().enumerate() {
        let wanted = press::CrankOfMotion { S_travel_rate: 12.0, S_travel_acceleration: -3.0 };
        let one = press::crank_of_at(&linkage, stroke, &wanted)?;
        assert_eq!(theta[index].to_bits(), one.theta.to_bits());
        assert_eq!(theta_rate[index].to_bits(), one.theta_rate.to_bits());
        assert_eq!(theta_acceleration[index].to_bits(), one.theta_acceleration.to_bits());
    }
    Ok(())
}

#[test]
fn two_drives_are_found_from_two_coordinates() -> Result<(), Error> {
    for (a, b, side) in [(1.9, 1.1, Side::Left), (1.5, 1.6, Side::Left), (1.2, 2.0, Side::Right)] {
        let closures = five_bar::Closures { P: side };
        let motion = five_bar::Motion { a_rate: 2.5, a_acceleration: -3.0, b_rate: -1.5, b_acceleration: 6.0 };
        let pose = five_bar::Pose::at(a, b, closures)?;
        let (places, speeds, accelerations) = (pose.places()?, pose.speeds(&motion)?, pose.accelerations(&motion)?);
        let wanted = five_bar::DrivesOfMotion {
            O2_angle_rate: speeds.right_angle,
            O2_angle_acceleration: accelerations.right_angle,
            Q_angle_rate: speeds.lower_angle - speeds.right_angle,
            Q_angle_acceleration: accelerations.lower_angle - accelerations.right_angle,
        };
        let [first, second] = [places.right_angle, places.lower_angle - places.right_angle];
        let found = five_bar::drives_of_at(first, second, closures, &wanted)?;
        assert!(turned(found.a, a).abs() < 1e-12 && (found.b - b).abs() < 1e-12, "{found:?}");
        assert!((found.a_rate - 2.5).abs() < 1e-9 && (found.b_rate + 1.5).abs() < 1e-9, "{found:?}");
        assert!((found.a_acceleration + 3.0).abs() < 1e-8 && (found.b_acceleration - 6.0).abs() < 1e-8, "{found:?}");
    }
    Ok(())
}

/// A lever with a slot, in which the pin of a driven rod slides.
macro_rules! lever {
    ($(#[$meta:meta])* mod $module:ident; $($items:tt)*) => {
        linkage! {
            $(#[$meta])*
            mod $module;
            ground     { A: (0, 0), B: (0.04m, -0.06m) }
            link rod   { P: (0, 0), A: (-0.15m, 0.05m) }
            link lever { B: (0, 0), Q: (-0.004m, 0.075m) }
            revolute A: ground -> rod;
            revolute B: ground -> lever;
            slot N: rod.P -> lever.Q along -20deg of rod;
            drive x: A;
            $($items)*
        }
    };
}

lever! {
    /// Forwards its side is that of the pin in the slot, driven by the slot's angle that of both pins along it.
    mod slotted;
    assemble N: behind(B);
    scene place: position -> (rod.angle, lever.angle);
    scene back: inverse(N.angle) -> (x);
}

#[test]
fn a_closure_that_means_another_side_in_the_inverse_is_checked() {
    let mut found = [0, 0];
    for step in -314_i32..=314 {
        let wanted = 0.01 * f64::from(step);
        match slotted::back_at(wanted) {
            Ok(back) => {
                let place = slotted::place_at(back.x).expect("what is found leads back");
                let (sin, cos) = (place.lever_angle - place.rod_angle - wanted).sin_cos();
                assert!(sin.abs() < 1e-9 && cos > 0.0, "{wanted}");
                found[0] += 1;
            }
            Err(Error::OtherSide { joint: "N" }) => found[1] += 1,
            Err(Error::CannotAssemble { .. } | Error::CoincidentPivots { .. } | Error::DeadCentre { .. }) => {}
            Err(other) => panic!("{wanted}: {other}"),
        }
    }
    assert!(found[0] > 50 && found[1] > 50, "{found:?}");
}

lever! {
    /// Asked for how far the pin has slid, which is the middle pin of a dyad then, to the left or to the right of the outer ones.
    mod slid;
    assemble N: ahead(B);
    assemble N: either(A -> B);
    scene back: inverse(N.travel) -> (x, x.rate);
}

#[test]
fn the_travel_of_a_slot_leads_back() {
    let mut found = [0, 0];
    for step in -314_i32..=314 {
        let x = 0.01 * f64::from(step);
        // The side is the inverse's alone: no pose of the lever hangs on it.
        let pose_at = |x: f64| slid::Pose::at(x, slid::Closures { N: Side::Left });
        let Ok(pose) = pose_at(x) else { continue };
        let motion = slid::BackMotion { N_travel_rate: 0.5 };
        let mut returned = false;
        for (index, side) in [Side::Left, Side::Right].into_iter().enumerate() {
            match slid::back_at(pose.travel_N(), slid::Closures { N: side }, &motion) {
                Ok(back) => {
                    let (sin, cos) = (back.x - x).sin_cos();
                    let is_same = sin.abs() < 1e-6 && cos > 0.0;
                    returned |= is_same;
                    found[index] += usize::from(is_same);
                    let again = |x: f64| pose_at(x).expect("what is found leads back").travel_N();
                    assert!((again(back.x) - pose.travel_N()).abs() < 1e-12, "{x}");
                    let change = again(back.x + 1e-6 * back.x_rate) - again(back.x - 1e-6 * back.x_rate);
                    // Next to a dead centre, either way, the slope changes within the difference.
                    assert!((change - 1e-6).abs() < 1e-9 * (1.0 + back.x_rate.powi(2)), "{x}: {change}");
                }
                Err(Error::OtherSide { joint: "N" } | Error::DeadCentre { .. }) => {}
                Err(other) => panic!("{x}: {other}"),
            }
        }
        assert!(returned, "{x}");
    }
    assert!(found[0] > 50 && found[1] > 50, "{found:?}");
}
