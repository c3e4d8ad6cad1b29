//! Declarations whose code has what few have: each is compiled, and two ways to its results agree.
#![allow(non_snake_case, reason = "matrices have the names of their equations")]

use linkage_runtime::{Error, Series, SweepError, linkage};

linkage! {
    /// A parameter with the name of a keyword, of which others are made.
    mod keyword;
    param r#let: length = 1m;
    param b: length = 3m;
    ground { O, G: (0, 0) }
    link crank { O -> A: r#let }
    link rod { A -> B: b }
    link slider { B }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> slider;
    prismatic G: ground.G -> slider.B along 0;
    drive theta: O;
    assemble B: ahead(A);
    scene v: velocity;
    scene a: acceleration;
}

#[test]
fn a_parameter_may_be_a_keyword() -> Result<(), Error> {
    let linkage = keyword::Linkage::new(&keyword::Params { r#let: 1.0, b: 3.0 })?;
    let motion = keyword::Motion { theta_rate: 2.0, theta_acceleration: 0.5 };
    let (theta, h) = (0.7, 1e-5);
    let speed = |theta: f64| {
        let motion = keyword::Motion { theta_acceleration: 0.0, ..motion };
        keyword::v_at(&linkage, theta, &motion).map(|found| found.B.x)
    };
    let change = (speed(theta + h)? - speed(theta - h)?) / (2.0 * h);
    let found = keyword::a_at(&linkage, theta, &motion)?.B.x;
    let expected = change * motion.theta_rate + speed(theta)? / motion.theta_rate * motion.theta_acceleration;
    assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    Ok(())
}

linkage! {
    /// A spring that pulls from no length on, damped: two results are one sum of products.
    mod damped;
    arithmetic fused;
    ground { A: (0, 0), B: (1m, 0.5m) }
    link a { A -> C: 0.5m }
    revolute A: a -> ground;
    drive q: A;
    load L: spring(a.C, ground.B) { rate: _, free: 0, damping: 0.3N*s/m };
    load K: moment(a);
    scene work: virtual_work;
    scene held: equilibrium;
}

#[test]
fn a_damped_spring_of_no_length_works_in_fused_arithmetic() -> Result<(), Error> {
    let (motion, loads) = (damped::Motion { q_rate: 3.0 }, damped::Loads { L: damped::LoadsL { rate: 100.0 }, K: 2.0 });
    for q in [0.3, 2.0, -2.0] {
        let (work, held) = (damped::work_at(q, &motion, &loads)?, damped::held_at(q, &motion, &loads)?);
        assert!((work.effort_q - held.effort_q).abs() < 1e-13, "{work:?}, {held:?}");
        assert!((work.effort_q + work.L.work + work.K.work).abs() < 1e-13, "{work:?}");
    }
    Ok(())
}

linkage! {
    /// A dyad behind a leg on a cylinder: stages of a sweep read the cylinder's sense, which is one of two literals.
    mod leg;
    ground { A: (0, 0), B: (0.9m, 0.1m), P: (-0.4m, 0.05m) }
    link leg   { A -> C: 0.7m, E: (0.2m, 0.1m) }
    link upper { B -> D: 0.5m }
    link lower { D -> C: 0.62m }
    link tube  { P }
    link rod   { E: (0, 0), s: (-0.1m, 0) }
    revolute A: ground -> leg;
    revolute B: upper  -> ground;
    revolute D: upper  -> lower;
    revolute C: lower  -> leg;
    revolute P: ground -> tube;
    revolute E: rod    -> leg;
    prismatic X: rod.s -> tube.P along 180deg of rod;
    drive x: X;
    assemble E: right(A -> P);
    assemble D: left(B -> C);
    mass lower: 10kg at (1m, 0);
    scene state: motion;
    scene states: sweep(state);
}

#[test]
fn a_sense_is_read_by_the_stages_of_a_sweep() -> Result<(), SweepError> {
    let mut x = [0.35; 20];
    for index in 1..x.len() {
        x[index] = x[index - 1] + 0.005;
    }
    let ([mut M, mut h, mut rounding], rates) = ([[0.0; 20]; 3], [0.4; 20]);
    let inputs = leg::StatesInputs { x: Series::Each(&x), x_rate: Series::Each(&rates) };
    leg::states(&inputs, leg::States { M: &mut M, h: &mut h, rounding: &mut rounding })?;
    for (index, x) in x.into_iter().enumerate() {
        let one = leg::state_at(x, &leg::Motion { x_rate: 0.4 }).expect("a pose");
        let swept = [M[index], h[index], rounding[index]];
        assert_eq!(swept.map(f64::to_bits), [one.M, one.h, one.rounding].map(f64::to_bits));
        assert!(one.M > 1e3 * one.rounding && one.rounding > 0.0, "{one:?}");
    }
    Ok(())
}

/// A slide along a polar vector of negative size, and of one whose size is a parameter.
macro_rules! slide {
    ($module:ident, $($along:tt)*) => {
        linkage! {
            mod $module;
            param r: number = 1;
            ground { O: (0, 0) }
            link block { P: (0, 0) }
            prismatic S: ground.O -> block.P along $($along)*;
            drive x: S;
            scene place: position -> (block.P);
            load F: force(block.P) = (r*1N, 0N);
            scene held: equilibrium;
        }
    };
}
slide!(turned, 210deg);
slide!(negative, -2 @ 30deg);
slide!(by_parameter, r @ 30deg);

#[test]
fn a_polar_direction_of_negative_size_points_the_other_way() -> Result<(), Error> {
    let expected = turned::place_at(&turned::Linkage::new(&turned::Params { r: 1.0 })?, 2.0)?.block_P;
    let found = negative::place_at(&negative::Linkage::new(&negative::Params { r: 1.0 })?, 2.0)?.block_P;
    assert!((found - expected).norm() < 1e-15, "{found}");
    let found = by_parameter::place_at(&by_parameter::Linkage::new(&by_parameter::Params { r: -3.0 })?, 2.0)?.block_P;
    assert!((found - expected).norm() < 1e-15, "{found}");
    let none = by_parameter::Linkage::new(&by_parameter::Params { r: 0.0 });
    assert!(matches!(none, Err(Error::Parameter { requirement }) if requirement.contains("`r @ 30deg`")), "{none:?}");
    Ok(())
}

macro_rules! lever {
    ($name:ident, $length:expr, $end:expr, $load:expr, $stretch:literal) => {
        linkage! {
            /// A lever of lengths that a macro by example has captured.
            mod $name;
            units { mm, N }
            ground { O }
            link lever { O -> A: 2 * $length, B: $end, C: (-$length, $length / 2), D: $stretch @ $length / 1mm * 1rad }
            revolute O: ground -> lever;
            drive theta: O;
            load F: force(lever.B) = $load;
            scene places: position -> (lever.A, lever.B, lever.C, lever.D);
            scene torque: equilibrium;
        }
    };
}

lever!(captured, 3mm - 1mm, (5mm, 2 * 3mm), (1N, 2N + 3N), 7mm);
lever!(plain, 2mm, (5mm, 6mm), (1N, 5N), 7mm);

#[test]
fn what_a_macro_has_captured_is_one_value() -> Result<(), Error> {
    assert_eq!(format!("{:?}", captured::places_at(0.3)?), format!("{:?}", plain::places_at(0.3)?));
    assert_eq!(format!("{:?}", captured::torque_at(0.3)?), format!("{:?}", plain::torque_at(0.3)?));
    assert!((plain::places_at(0.0)?.lever_A.x - 4.0).abs() < 1e-12);
    Ok(())
}
