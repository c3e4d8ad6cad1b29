//! Sweeps of a machine that runs up: positions, rates and accelerations differ from each position to the next.

use linkage_runtime::{Error, Series, SweepError, linkage};

linkage! {
    /// An engine with inertia and a damper.
    mod engine;
    ground      { O: (0, 0), K: (0, 150mm) }
    link crank  { O -> A: 40mm, G: (-10mm, 5mm) }
    link rod    { A -> B: 140mm, C: (45mm, 8mm) }
    link piston { B }
    mass crank: 1.1kg at G, inertia 900kg*mm^2;
    mass rod: 0.62kg at C, inertia 1900kg*mm^2;
    mass piston: 0.45kg at B;
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B along 0deg;
    drive theta: O;
    assemble B: ahead(A);
    load I: inertia;
    load D: spring(ground.K, rod.C) { damping: 4N*s/m };
    scene held: equilibrium -> (effort_theta, B, power);
    scene speeds: velocity -> (B, rod.angle);
    scene accelerations: acceleration -> (B, rod.angle);
    scene control: motion;
    scene cycle: sweep(held);
    scene speed: sweep(speeds);
    scene accelerated: sweep(accelerations);
    scene controlled: sweep(control);
}

linkage! {
    /// A five-bar, of whose two drives one has its motion declared.
    mod five_bar;
    ground     { O1: (0, 0), O2: (0.5m, 0) }
    link left  { O1 -> P: 0.3m }
    link right { O2 -> Q: 0.35m }
    link upper { P -> R: 0.45m, G: (0.2m, 0) }
    link lower { Q -> R: 0.4m }
    mass upper: 0.8kg at G, inertia 0.012kg*m^2;
    revolute O1: ground -> left;
    revolute O2: ground -> right;
    revolute P: left -> upper;
    revolute Q: right -> lower;
    revolute R: upper -> lower;
    drive a: O1;
    drive b: O2 { rate: 2rad/s, acceleration: 0 };
    assemble R: left(P -> Q);
    load I: inertia;
    scene held: virtual_work -> (effort_a, effort_b);
    scene cycle: sweep(held);
}

/// Some blocks of positions and a part of one.
const COUNT: usize = 150;

/// Angle, rate and acceleration of a crank that runs up, jerkily, at every position.
fn run_up() -> [[f64; COUNT]; 3] {
    let time: [f64; COUNT] = core::array::from_fn(|index| 0.004 * f64::from(u32::try_from(index).expect("small")));
    [
        time.map(|t| 0.3 + 10.0 * t + 50.0 * t * t - 0.1 * (30.0 * t).cos()),
        time.map(|t| 10.0 + 100.0 * t + 3.0 * (30.0 * t).sin()),
        time.map(|t| 100.0 + 90.0 * (30.0 * t).cos()),
    ]
}

/// The bits of one position of some slices.
fn bits<const N: usize>(rows: [&[f64; COUNT]; N], index: usize) -> [u64; N] {
    rows.map(|row| row[index].to_bits())
}

#[test]
fn every_position_has_its_own_motion() -> Result<(), Error> {
    let [thetas, rates, accelerations] = run_up();
    let [mut effort, mut x, mut y, mut power] = [[0.0; COUNT]; 4];
    let inputs = engine::CycleInputs {
        theta: Series::Each(&thetas),
        theta_rate: Series::Each(&rates),
        theta_acceleration: Series::Each(&accelerations),
    };
    let results = engine::Cycle { effort_theta: &mut effort, B_x: &mut x, B_y: &mut y, power: &mut power };
    engine::cycle(&inputs, results).expect("regular everywhere");
    let [mut speed_x, mut speed_y, mut turning] = [[0.0; COUNT]; 3];
    let inputs = engine::SpeedInputs { theta: Series::Each(&thetas), theta_rate: Series::Each(&rates) };
    let results = engine::Speed { B_x: &mut speed_x, B_y: &mut speed_y, rod_angle: &mut turning };
    engine::speed(&inputs, results).expect("regular everywhere");
    let [mut second_x, mut second_y, mut swinging] = [[0.0; COUNT]; 3];
    let inputs = engine::AcceleratedInputs {
        theta: Series::Each(&thetas),
        theta_rate: Series::Each(&rates),
        theta_acceleration: Series::Each(&accelerations),
    };
    let results = engine::Accelerated { B_x: &mut second_x, B_y: &mut second_y, rod_angle: &mut swinging };
    engine::accelerated(&inputs, results).expect("regular everywhere");
    for index in 0..COUNT {
        let theta = thetas[index];
        let motion = engine::Motion { theta_rate: rates[index], theta_acceleration: accelerations[index] };
        let held = engine::held_at(theta, &motion)?;
        let expected = [held.effort_theta, held.B.x, held.B.y, held.power].map(f64::to_bits);
        assert_eq!(bits([&effort, &x, &y, &power], index), expected, "position {index}");
        let speeds = engine::speeds_at(theta, &motion)?;
        let expected = [speeds.B.x, speeds.B.y, speeds.rod_angle].map(f64::to_bits);
        assert_eq!(bits([&speed_x, &speed_y, &turning], index), expected, "position {index}");
        let second = engine::accelerations_at(theta, &motion)?;
        let expected = [second.B.x, second.B.y, second.rod_angle].map(f64::to_bits);
        assert_eq!(bits([&second_x, &second_y, &swinging], index), expected, "position {index}");
    }
    Ok(())
}

#[test]
fn the_equation_of_motion_takes_the_rates_of_every_position() -> Result<(), Error> {
    let [thetas, rates, _] = run_up();
    let [mut mass, mut bias, mut rounding] = [[0.0; COUNT]; 3];
    let inputs = engine::ControlledInputs { theta: Series::Each(&thetas), theta_rate: Series::Each(&rates) };
    let results = engine::Controlled { M: &mut mass, h: &mut bias, rounding: &mut rounding };
    engine::controlled(&inputs, results).expect("regular everywhere");
    for index in 0..COUNT {
        let motion = engine::Motion { theta_rate: rates[index], theta_acceleration: f64::NAN };
        let one = engine::control_at(thetas[index], &motion)?;
        let expected = [one.M, one.h, one.rounding].map(f64::to_bits);
        assert_eq!(bits([&mass, &bias, &rounding], index), expected, "position {index}");
    }
    Ok(())
}

#[test]
fn declared_motion_and_motion_at_every_position_go_together() -> Result<(), Error> {
    let [_, rates, accelerations] = run_up();
    let angles: [f64; COUNT] =
        core::array::from_fn(|index| 1.2 + 0.005 * f64::from(u32::try_from(index).expect("small")));
    let [mut of_a, mut of_b] = [[0.0; COUNT]; 2];
    let inputs = five_bar::CycleInputs {
        a: Series::Each(&angles),
        b: Series::Constant(1.3),
        a_rate: Series::Each(&rates),
        a_acceleration: Series::Each(&accelerations),
    };
    five_bar::cycle(&inputs, five_bar::Cycle { effort_a: &mut of_a, effort_b: &mut of_b }).expect("regular everywhere");
    for index in 0..COUNT {
        let motion = five_bar::Motion { a_rate: rates[index], a_acceleration: accelerations[index] };
        let one = five_bar::held_at(angles[index], 1.3, &motion)?;
        let expected = [one.effort_a, one.effort_b].map(f64::to_bits);
        assert_eq!(bits([&of_a, &of_b], index), expected, "position {index}");
    }
    Ok(())
}

#[test]
fn rates_without_a_number_and_of_another_length_are_told() {
    let [thetas, mut rates, accelerations] = run_up();
    let run = |rates: &[f64]| {
        let [mut effort, mut x, mut y, mut power] = [[0.0; COUNT]; 4];
        let inputs = engine::CycleInputs {
            theta: Series::Each(&thetas),
            theta_rate: Series::Each(rates),
            theta_acceleration: Series::Each(&accelerations),
        };
        engine::cycle(&inputs, engine::Cycle { effort_theta: &mut effort, B_x: &mut x, B_y: &mut y, power: &mut power })
    };
    let expected = SweepError::Length { what: "theta_rate", found: COUNT - 2, expected: COUNT };
    assert_eq!(run(&rates[2..]), Err(expected));
    rates[91] = f64::INFINITY;
    assert!(matches!(run(&rates), Err(SweepError::Position { index: 91, error: Error::NotFinite { .. } })));
}
