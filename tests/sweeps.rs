//! Sweeps, resultants and powers as a user has them.
#![allow(clippy::cast_precision_loss, reason = "small whole numbers are exact")]
#![allow(clippy::float_cmp, reason = "the same operations give the same bits")]

use core::f64::consts::TAU;
use std::sync::{Mutex, PoisonError};

use linkage_runtime::__private::limit_registers;
use linkage_runtime::{Error, Series, SweepError, Vector2, linkage};

linkage! {
    /// An engine with everything that the ground may feel: gas, weights, a spring and a torque between a link and the ground.
    mod engine;
    ground      { O: (10mm, 20mm), P: (-40mm, 30mm), K: (0, 150mm) }
    link crank  { O -> A: 40mm, G: (-10mm, 5mm) }
    link rod    { A -> B: 140mm, C: (45mm, 8mm) }
    link piston { B, H: (12mm, 1mm) }
    mass crank: 1.1kg at G, inertia 900kg*mm^2;
    mass rod: 0.62kg at C, inertia 1900kg*mm^2;
    mass piston: 0.45kg at H;
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B along 0deg;
    drive theta: O;
    assemble B: ahead(A);
    load gas: force(piston.B);
    load I: inertia;
    load W: gravity = 9.81m/s^2 @ -90deg;
    load K: spring(ground.K, rod.C) { rate: _, free: 60mm, damping: 4N*s/m };
    load M: moment(ground -> rod) = 3N*m;
    load F: force(rod.C) in rod;
    scene all: equilibrium -> (effort_theta, O, S, ground about ground.P, ground about rod.C, power, power(effort_theta));
    scene parts: superposition -> (effort_theta, ground about ground.P);
    scene alone: equilibrium(I) -> (ground about ground.P);
    scene work: virtual_work -> (effort_theta, power);
    scene shakes: acceleration -> (shaking(ground.P), shaking(crank.A));
    scene places: position -> (B, A, rod.C, crank.G, piston.H);
    scene speeds: velocity -> (B, rod.angle, rod.C);
    scene cycle: sweep(all);
    scene each: sweep(parts);
    scene speed: sweep(speeds);
}

linkage! {
    /// A press of run-time length, in single precision.
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
    drive theta: O;
    assemble B: ahead(A);
    load F: force(ram.B);
    scene held: equilibrium -> (effort_theta, A);
    scene stroke: sweep(held);
}

linkage! {
    /// A triad, placed by iteration.
    mod triad;
    units { mm, N }
    ground     { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm) }
    link crank { O -> A: 28mm }
    link rod   { A -> E: 230mm }
    link plate { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm), G: (50mm, 0) }
    link upper { Q -> C: 192mm }
    link lower { P -> D: 180mm }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute E: rod -> plate;
    revolute C: plate -> upper;
    revolute D: plate -> lower;
    revolute Q: ground -> upper;
    revolute P: ground -> lower;
    drive theta: O;
    start theta: 30deg;
    start rod: (30mm, 20mm), angle 30deg;
    start plate: (240mm, 140mm), angle 0;
    start upper: (500mm, 100mm), angle 140deg;
    start lower: (400mm, -100mm), angle 120deg;
    load F: force(plate.G);
    scene held: equilibrium -> (effort_theta, E, power);
    scene turned: sweep(held);
}

linkage! {
    /// A four-bar with a couple at run time: it is asked at each position, in place of several results.
    mod rocker;
    units { mm, N }
    emit source;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: 100mm }
    link lever   { B0 -> B: 120mm, D: (90mm, 0) }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> lever;
    revolute B0: ground  -> lever;
    drive theta: A0;
    assemble B: left(A -> B0);
    load M: moment(ground -> coupler);
    load W: force(crank.A) = 30N @ -90deg;
    load G: force(lever.D) = 20N @ -90deg;
    scene pins: equilibrium -> (A0, B0);
    scene cycle: sweep(pins);
}

linkage! {
    /// A slider-crank in fused arithmetic.
    mod pump;
    units { mm, N }
    arithmetic fused;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: 140mm }
    link plunger { B }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> plunger;
    prismatic S: ground.O -> plunger.B along 0deg;
    drive theta: O;
    assemble B: ahead(A);
    load F: force(plunger.B) = 500N @ 170deg;
    scene held: equilibrium -> (effort_theta, A);
    scene stroke: sweep(held);
}

/// Some blocks of positions and a part of one.
const COUNT: usize = 200;

fn angles() -> [f64; COUNT] {
    core::array::from_fn(|step| 0.03 + TAU * step as f64 / COUNT as f64)
}

fn gas() -> [Vector2<f64>; COUNT] {
    angles().map(|angle| Vector2::new(-2000.0 * (1.0 + angle.cos()), 0.0))
}

fn inputs<'a>(angles: &'a [f64], gas: &'a [Vector2<f64>]) -> engine::CycleInputs<'a> {
    engine::CycleInputs {
        theta: angles.into(),
        theta_rate: Series::Constant(100.0),
        theta_acceleration: 30.0.into(),
        gas: gas.into(),
        K: Series::Constant(engine::LoadsK { rate: 300.0 }),
        F: Series::Constant(Vector2::new(4.0, -7.0)),
    }
}

/// Motion and loads at a position.
fn at(index: usize) -> (engine::Motion, engine::Loads) {
    let motion = engine::Motion { theta_rate: 100.0, theta_acceleration: 30.0 };
    let loads = engine::Loads { gas: gas()[index], K: engine::LoadsK { rate: 300.0 }, F: Vector2::new(4.0, -7.0) };
    (motion, loads)
}

/// Runs the sweep `cycle` into one array of rows.
fn cycle(inputs: &engine::CycleInputs<'_>, rows: &mut [Vec<f64>; 14]) -> Result<(), SweepError> {
    let [t, ox, oy, sx, sy, sn, sc, px, py, pm, cx, cy, cm, pw] = rows;
    let mut own = vec![0.0; pw.len()];
    let results = engine::Cycle {
        effort_theta: t,
        O_x: ox,
        O_y: oy,
        S_force_x: sx,
        S_force_y: sy,
        S_normal: sn,
        S_couple: sc,
        ground_about_ground_P_force_x: px,
        ground_about_ground_P_force_y: py,
        ground_about_ground_P_moment: pm,
        ground_about_rod_C_force_x: cx,
        ground_about_rod_C_force_y: cy,
        ground_about_rod_C_moment: cm,
        power: pw,
        effort_theta_power: &mut own,
    };
    engine::cycle(inputs, results)?;
    assert_eq!(&own, pw);
    Ok(())
}

/// Sweeps with whichever vector instructions there are, of those that the processor has. The limit is that of the process, whose tests run side
/// by side: whatever sweeps does so within this, one test after the other, and none is left with the limit of another one.
fn at_each_width(sweep: impl Fn()) {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    struct Unlimited;
    impl Drop for Unlimited {
        fn drop(&mut self) {
            limit_registers(u8::MAX);
        }
    }
    // A test that has failed has lifted its limit: others go on. What is declared last is dropped first.
    let _alone = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let _unlimited = Unlimited;
    for bytes in [16, 32, 64, u8::MAX] {
        limit_registers(bytes);
        println!("registers of at most {bytes} bytes");
        sweep();
    }
}

#[test]
fn a_sweep_has_the_bits_of_the_point_function() {
    at_each_width(compare_with_the_point_function);
}

fn compare_with_the_point_function() {
    let (angles, gas) = (angles(), gas());
    let mut rows: [Vec<f64>; 14] = core::array::from_fn(|_| vec![f64::NAN; COUNT]);
    cycle(&inputs(&angles, &gas), &mut rows).expect("regular everywhere");
    for (index, theta) in angles.iter().enumerate() {
        let (motion, loads) = at(index);
        let one = engine::all_at(*theta, &motion, &loads).expect("regular");
        let [p, c] = [one.ground_about_ground_P, one.ground_about_rod_C];
        let expected = [
            one.effort_theta,
            one.O.x,
            one.O.y,
            one.S.force.x,
            one.S.force.y,
            one.S.normal,
            one.S.couple,
            p.force.x,
            p.force.y,
            p.moment,
            c.force.x,
            c.force.y,
            c.moment,
            one.power,
        ];
        assert_eq!(rows.each_ref().map(|row| row[index].to_bits()), expected.map(f64::to_bits), "position {index}");
    }
}

#[test]
fn what_the_ground_feels_is_what_comes_from_outside() {
    for (index, theta) in angles().into_iter().enumerate() {
        let (motion, loads) = at(index);
        let pose = engine::Pose::at(theta).expect("regular");
        let all = pose.all(&motion, &loads).expect("regular");
        let shakes = pose.shakes(&motion).expect("regular");
        let places = engine::places_at(theta).expect("regular");
        let about = Vector2::new(-0.04, 0.03);
        // From outside: inertia, gas, weights, the force that turns with the rod. Not the spring and the moment, which the ground reacts.
        let weights = [(1.1, places.crank_G), (0.62, places.rod_C), (0.45, places.piston_H)];
        let weights = weights.map(|(mass, at)| (Vector2::new(0.0, -9.81 * mass), at));
        let along = pose.rod_direction();
        let turned = Vector2::new(4.0 * along.x + 7.0 * along.y, 4.0 * along.y - 7.0 * along.x);
        let forces = weights.into_iter().chain([(loads.gas, places.B), (turned, places.rod_C)]);
        let (mut force, mut moment) = (shakes.shaking_ground_P.force, shakes.shaking_ground_P.moment);
        for (one, at) in forces {
            force += one;
            moment += (at - about).perp(&one);
        }
        let felt = all.ground_about_ground_P;
        assert!((felt.force - force).norm() < 1e-9, "{felt:?} at {theta}");
        assert!((felt.moment - moment).abs() < 1e-9, "{felt:?} at {theta}");
        // About another point: the moment of the force beside it.
        let moved = all.ground_about_rod_C;
        let expected = felt.moment - (places.rod_C - about).perp(&felt.force);
        assert!((moved.force - felt.force).norm() < 1e-9 && (moved.moment - expected).abs() < 1e-9);
        let (here, there) = (shakes.shaking_ground_P, shakes.shaking_crank_A);
        assert!((here.moment - (places.A - about).perp(&here.force) - there.moment).abs() < 1e-9);
        // By inertia alone the ground feels nothing else.
        let alone = pose.alone(&motion).expect("regular").ground_about_ground_P;
        assert!((alone.force - here.force).norm() < 1e-9 && (alone.moment - here.moment).abs() < 1e-9);
        let parts = pose.parts(&motion, &loads).expect("regular").total().expect("numbers").ground_about_ground_P;
        assert!((parts.force - felt.force).norm() < 1e-9 && (parts.moment - felt.moment).abs() < 1e-9);
        // The power, by both methods, and by hand.
        assert_eq!(all.power, all.effort_theta * 100.0);
        let work = pose.work(&motion, &loads).expect("regular");
        assert!((work.power - all.power).abs() < 1e-9 * all.power.abs().max(1.0));
    }
}

#[test]
fn the_first_position_without_an_answer_is_named() {
    at_each_width(|| {
        // First and last of a block, and of all.
        for index in [0, 17, 63, 64, 137, COUNT - 1] {
            let (mut angles, gas) = (angles(), gas());
            angles[index] = f64::NAN;
            let mut rows: [Vec<f64>; 14] = core::array::from_fn(|_| vec![f64::NAN; COUNT]);
            let error = cycle(&inputs(&angles, &gas), &mut rows).expect_err("no angle");
            assert_eq!(error, SweepError::Position { index, error: Error::NotFinite { what: "theta" } });
            for row in &rows {
                assert!(row[..index].iter().all(|x| x.is_finite()) && row[index..].iter().all(|x| x.is_nan()));
            }
        }
    });
}

#[test]
fn a_load_that_is_not_finite_is_refused_as_by_the_point_function() {
    at_each_width(|| {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for (index, component) in [(0, 0), (17, 1), (64, 0), (COUNT - 1, 1)] {
                let (angles, mut gas) = (angles(), gas());
                gas[index][component] = bad;
                let mut rows: [Vec<f64>; 14] = core::array::from_fn(|_| vec![f64::NAN; COUNT]);
                let error = cycle(&inputs(&angles, &gas), &mut rows).expect_err("no load");
                let (motion, loads) = at(index);
                let refused = engine::all_at(angles[index], &motion, &engine::Loads { gas: gas[index], ..loads });
                assert_eq!(error, SweepError::Position { index, error: refused.expect_err("no load") });
                assert!(rows.iter().all(|row| row[index..].iter().all(|x| x.is_nan())));
            }
            // One for all positions, and a speed.
            let (angles, gas) = (angles(), gas());
            let rate = engine::CycleInputs { theta_rate: Series::Constant(bad), ..inputs(&angles, &gas) };
            let spring =
                engine::CycleInputs { K: Series::Constant(engine::LoadsK { rate: bad }), ..inputs(&angles, &gas) };
            for inputs in [rate, spring] {
                let mut rows: [Vec<f64>; 14] = core::array::from_fn(|_| vec![f64::NAN; COUNT]);
                let error = cycle(&inputs, &mut rows).expect_err("not finite");
                assert!(
                    matches!(error, SweepError::Position { index: 0, error: Error::NotFinite { .. } }),
                    "{error:?}"
                );
            }
        }
    });
}

#[test]
fn enormous_loads_are_refused_only_where_results_are_not_finite() {
    at_each_width(|| {
        assert!(rocker::SOURCE.contains("math::each_moderate([M])"));
        let angles: Vec<f64> = (0..130).map(|index| 0.1 + 0.02 * f64::from(index)).collect();
        let solve = |loads: &[f64]| {
            let mut rows: [Vec<f64>; 4] = core::array::from_fn(|_| vec![f64::NAN; angles.len()]);
            let [a, b, c, d] = &mut rows;
            let results = rocker::Cycle { A0_x: a, A0_y: b, B0_x: c, B0_y: d };
            let inputs = rocker::CycleInputs { theta: Series::Each(&angles), M: Series::Each(loads) };
            rocker::cycle(&inputs, results).map(|()| rows)
        };
        for index in [0, 5, 63, 64, 129] {
            for couple in [f64::NAN, f64::INFINITY, -f64::INFINITY, f64::MAX, -1e308, 1e200, -1e100, 2.4e77] {
                let mut loads = vec![350.0; angles.len()];
                loads[index] = couple;
                match (solve(&loads), rocker::pins_at(angles[index], &rocker::Loads { M: couple })) {
                    (Ok(rows), Ok(one)) => {
                        let one = [one.A0.x, one.A0.y, one.B0.x, one.B0.y];
                        assert!(one.iter().all(|x| x.is_finite()));
                        assert_eq!(rows.each_ref().map(|row| row[index].to_bits()), one.map(f64::to_bits));
                    }
                    (Err(error), Err(one)) => assert_eq!(error, SweepError::Position { index, error: one }),
                    others => panic!("{couple} at {index}: {others:?}"),
                }
            }
        }
        // Next to the fold forces are larger than the couple over the lengths, and that of the largest couple larger than any number.
        let one = |theta: f64, couple: f64| rocker::pins_at(theta, &rocker::Loads { M: couple }).is_ok();
        assert_eq!(
            [one(1.0, 1e300), one(TAU / 2.0 - 1e-4, 1e300), one(TAU / 2.0 - 1e-4, f64::MAX), one(1.0, f64::NAN)],
            [true, true, false, false]
        );
    });
}

#[test]
fn angles_beyond_the_short_reduction_have_the_bits_of_the_point_function() {
    at_each_width(|| {
        // Among others: what needs a branch is solved by itself.
        let mut angles = angles();
        for (index, angle) in [(3, 1e6), (63, -7e8), (64, 1e17), (130, -1e300)] {
            angles[index] = angle;
        }
        let gas = gas();
        let mut rows: [Vec<f64>; 14] = core::array::from_fn(|_| vec![f64::NAN; COUNT]);
        cycle(&inputs(&angles, &gas), &mut rows).expect("regular everywhere");
        for (index, theta) in angles.iter().enumerate() {
            let (motion, loads) = at(index);
            let one = engine::all_at(*theta, &motion, &loads).expect("regular");
            assert_eq!(rows[0][index].to_bits(), one.effort_theta.to_bits());
            assert_eq!(rows[11][index].to_bits(), one.ground_about_rod_C.force.y.to_bits());
        }
    });
}

#[test]
fn lengths_are_checked_before_anything_is_computed() {
    at_each_width(|| {
        let (angles, gas) = (angles(), gas());
        let mut rows: [Vec<f64>; 14] = core::array::from_fn(|_| vec![f64::NAN; COUNT]);
        let short = engine::CycleInputs { gas: (&gas[1..]).into(), ..inputs(&angles, &gas) };
        let expected = SweepError::Length { what: "gas", found: COUNT - 1, expected: COUNT };
        assert_eq!(cycle(&short, &mut rows), Err(expected));
        rows[5].pop();
        let expected = SweepError::Length { what: "S_normal", found: COUNT - 1, expected: COUNT };
        assert_eq!(cycle(&inputs(&angles, &gas), &mut rows), Err(expected));
        assert!(rows.iter().all(|row| row.iter().all(|x| x.is_nan())));
        let mut none: [Vec<f64>; 14] = core::array::from_fn(|_| Vec::new());
        assert_eq!(cycle(&inputs(&[], &[]), &mut none), Ok(()));
    });
}

#[test]
fn parameters_single_precision_and_scenes_without_loads() {
    at_each_width(|| {
        let linkage = press::Linkage::new(&press::Params { length: 150.0 }).expect("a press");
        let angles: [f32; COUNT] = core::array::from_fn(|step| 0.1 + 0.03 * step as f32);
        let [mut t, mut x, mut y] = [[0.0f32; COUNT]; 3];
        let inputs =
            press::StrokeInputs { theta: Series::Each(&angles), F: Series::Constant(Vector2::new(-50.0, 0.0)) };
        press::stroke(&linkage, &inputs, press::Stroke { effort_theta: &mut t, A_x: &mut x, A_y: &mut y })
            .expect("regular");
        let loads = press::Loads { F: Vector2::new(-50.0, 0.0) };
        for (index, theta) in angles.into_iter().enumerate() {
            let one = press::held_at(&linkage, theta, &loads).expect("regular");
            assert_eq!(
                [t[index], x[index], y[index]].map(f32::to_bits),
                [one.effort_theta, one.A.x, one.A.y].map(f32::to_bits)
            );
        }
    });
}

#[test]
fn what_is_placed_by_iteration_goes_on_from_the_position_before() {
    at_each_width(|| {
        let angles: [f64; 120] = core::array::from_fn(|step| 0.5 + 0.1 * step as f64);
        let [mut t, mut x, mut y, mut power] = [[0.0; 120]; 4];
        let results = triad::Turned { effort_theta: &mut t, E_x: &mut x, E_y: &mut y, power: &mut power };
        let force = Vector2::new(3.0, -20.0);
        let inputs = triad::TurnedInputs {
            theta: Series::Each(&angles),
            theta_rate: Series::Constant(-2.0),
            F: Series::Constant(force),
        };
        triad::turned(&inputs, results).expect("regular");
        let mut pose = triad::Pose::at(angles[0]).expect("near the start");
        let (motion, loads) = (triad::Motion { theta_rate: -2.0 }, triad::Loads { F: force });
        for (index, theta) in angles.into_iter().enumerate() {
            if index > 0 {
                pose = pose.moved_to(theta).expect("near");
            }
            let one = pose.held(&motion, &loads).expect("regular");
            let expected = [one.effort_theta, one.E.x, one.E.y, -2.0 * one.effort_theta];
            assert_eq!(
                [t, x, y, power].map(|row| row[index].to_bits()),
                expected.map(f64::to_bits),
                "position {index}"
            );
        }
    });
}

linkage! {
    /// A four-bar whose side is chosen at run time, for a whole sweep.
    mod sided;
    ground { A0: (0, 0), B0: (1m, 0) } link crank { A0 -> A: 0.25m } link coupler { A -> B: 1m } link rocker { B0 -> B: 0.5m }
    revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
    drive theta: A0; assemble B: either(A -> B0); load M: moment(rocker) = 1N*m;
    scene hold: equilibrium -> (effort_theta);
    scene cycle: sweep(hold);
}

#[test]
fn a_side_is_chosen_for_the_whole_sweep() {
    at_each_width(|| {
        let theta = [0.5, 1.0, 1.5];
        for side in [linkage_runtime::Side::Left, linkage_runtime::Side::Right] {
            let closures = sided::Closures { B: side };
            let mut efforts = [0.0; 3];
            let inputs = sided::CycleInputs { theta: Series::Each(&theta) };
            sided::cycle(closures, &inputs, sided::Cycle { effort_theta: &mut efforts }).expect("regular");
            for (theta, effort) in theta.into_iter().zip(efforts) {
                assert_eq!(effort, sided::hold_at(theta, closures).expect("regular").effort_theta);
            }
        }
    });
}

#[test]
fn fused_operations_are_rounded_once_in_vectors_too() {
    at_each_width(|| {
        let angles = angles();
        let [mut t, mut x, mut y] = [[0.0; COUNT]; 3];
        let inputs = pump::StrokeInputs { theta: Series::Each(&angles) };
        pump::stroke(&inputs, pump::Stroke { effort_theta: &mut t, A_x: &mut x, A_y: &mut y }).expect("regular");
        for (index, theta) in angles.into_iter().enumerate() {
            let one = pump::held_at(theta).expect("regular");
            let expected = [one.effort_theta, one.A.x, one.A.y];
            assert_eq!([t[index], x[index], y[index]].map(f64::to_bits), expected.map(f64::to_bits));
        }
    });
}

linkage! {
    /// Two places, one of them a parameter.
    mod places;
    param d: length = 1.4m;
    ground { A0: (0, 0), B0: (d, 0) }
    link crank { A0 -> A: 0.8m } link coupler { A -> B: 1m } link rocker { B0 -> B: 1.2m }
    revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
    drive theta: A0; assemble B: left(A -> B0);
    scene ends: position -> (B0, B); scene path: sweep(ends);
}

#[test]
fn what_is_the_same_at_every_position_may_be_a_result() {
    at_each_width(|| {
        let linkage = places::Linkage::new(&places::Params::default()).expect("lengths");
        let theta = angles();
        let mut numbers = [[0.0; COUNT]; 4];
        let [x0, y0, x, y] = &mut numbers;
        let inputs = places::PathInputs { theta: Series::Each(&theta) };
        places::path(&linkage, &inputs, places::Path { B0_x: x0, B0_y: y0, B_x: x, B_y: y }).expect("regular");
        for (index, theta) in theta.iter().enumerate() {
            let one = places::ends_at(&linkage, *theta).expect("regular");
            let expected = [one.B0.x, one.B0.y, one.B.x, one.B.y];
            assert_eq!(numbers.map(|row| row[index].to_bits()), expected.map(f64::to_bits), "position {index}");
        }
    });
}

linkage! {
    /// Parameters, links and drives whose names are those of a sweep's columns, or that it makes of other ones.
    mod namesakes;
    param kept: length = 0.5m; param given: length = 0.25m;
    ground { O: (0, 0) } link a { O -> P: kept } link a_cos { P -> Q: given } link a_sin { Q -> R: 0.125m }
    revolute O: ground -> a; revolute P: a -> a_cos; revolute Q: a_cos -> a_sin;
    drive a_quarters: O; drive a_rest: P; drive a_tail: Q;
    load W: gravity = 9.81m/s^2 @ -90deg; mass a: 1kg at (0.25m, 0); mass a_cos: 1kg at (0.125m, 0); mass a_sin: 1kg at (0.1m, 0);
    scene held: equilibrium -> (effort_a_quarters, effort_a_rest, effort_a_tail);
    scene path: sweep(held);
}

#[test]
fn names_that_meet_are_kept_apart() {
    at_each_width(|| {
        let [first, second, third] = [1.0, -2.0, 0.5].map(|rate| angles().map(|angle| rate * angle));
        let mut efforts = [[0.0; COUNT]; 3];
        let [a, b, c] = &mut efforts;
        let inputs = namesakes::PathInputs {
            a_quarters: Series::Each(&first),
            a_rest: Series::Each(&second),
            a_tail: Series::Each(&third),
        };
        let results = namesakes::Path { effort_a_quarters: a, effort_a_rest: b, effort_a_tail: c };
        let linkage = namesakes::Linkage::new(&namesakes::Params::default()).expect("lengths");
        namesakes::path(&linkage, &inputs, results).expect("regular");
        for index in 0..COUNT {
            let one = namesakes::held_at(&linkage, first[index], second[index], third[index]).expect("regular");
            let expected = [one.effort_a_quarters, one.effort_a_rest, one.effort_a_tail];
            assert_eq!(efforts.map(|row| row[index].to_bits()), expected.map(f64::to_bits), "position {index}");
        }
    });
}

/// Some values, or the last one everywhere.
fn of<T: Copy>(values: &[T], is_same: bool) -> Series<'_, T> {
    match values {
        [.., last] if is_same => Series::Constant(*last),
        values => Series::Each(values),
    }
}

/// A crank with a spring of which all is given, a slide along which only one component of its force counts, and a force of which both count: what
/// is read in place, and what is copied, of few positions and of many.
macro_rules! given {
    ($name:ident, $scalar:ident, $test:ident) => {
        linkage! {
            mod $name;
            scalar $scalar;
            units { mm, N }
            ground     { O: (0, 0), K: (0, 150mm) }
            link crank { O -> A: 40mm }
            link rod   { A -> B: 140mm, C: (45mm, 8mm) }
            link ram   { B }
            revolute O: ground -> crank;
            revolute A: crank -> rod;
            revolute B: rod -> ram;
            prismatic S: ground.O -> ram.B along 0deg;
            drive theta: O;
            assemble B: ahead(A);
            load spring: spring(ground.K, rod.C) { rate: _, free: _, preload: _ };
            load along:  force(ram.B);
            load across: force(rod.C);
            load turning: moment(crank);
            scene held:  equilibrium -> (effort_theta, B);
            scene push:  virtual_work(along) -> (effort_theta);
            scene all:   sweep(held);
            scene pushed: sweep(push);
        }

        #[test]
        fn $test() {
            use $name::*;
            /// What lies around the results of a sweep.
            const AROUND: $scalar = 12345.0;
            const COUNTS: [usize; 14] = [0, 1, 2, 7, 8, 9, 16, 17, 63, 64, 65, 127, 128, 200];
            let each =
                |part: fn($scalar) -> $scalar| -> [$scalar; COUNT] { core::array::from_fn(|at| part(at as $scalar)) };
            let angles = each(|at| 0.03 + 0.031 * at);
            let vector = |at: $scalar| Vector2::new(7.0 - at, 2.0 * at - 90.0);
            let vectors = each(|at| at).map(vector);
            let springs =
                each(|at| at).map(|at| LoadsSpring { rate: 0.3 + at, free: 60.0 + 0.1 * at, preload: 0.5 * at });
            let moments = each(|at| 11.0 - at);
            at_each_width(|| {
                // Each of four series is one of values, or the same everywhere.
                for (count, same) in COUNTS.into_iter().flat_map(|count| (0..16).map(move |same| (count, same))) {
                    let is_same = |series: u8| same >> series & 1 == 1;
                    let inputs = AllInputs {
                        theta: Series::Each(&angles[..count]),
                        spring: of(&springs[..count], is_same(0)),
                        along: of(&vectors[..count], is_same(1)),
                        across: of(&vectors[..count], is_same(2)),
                        turning: of(&moments[..count], is_same(3)),
                    };
                    let mut rows: [Vec<$scalar>; 4] = core::array::from_fn(|_| vec![AROUND; count + 2]);
                    let [torque, x, y, pushed] = rows.each_mut().map(|row| &mut row[1..=count]);
                    all(&inputs, All { effort_theta: torque, B_x: x, B_y: y }).expect("regular");
                    let AllInputs { theta, spring, along, across, turning } = inputs;
                    self::$name::pushed(&PushedInputs { theta, along }, Pushed { effort_theta: pushed })
                        .expect("regular");
                    for row in &rows {
                        assert_eq!([row[0], row[count + 1]], [AROUND; 2]);
                    }
                    for at in 0..count {
                        let loads = Loads {
                            spring: spring.at(at),
                            along: along.at(at),
                            across: across.at(at),
                            turning: turning.at(at),
                        };
                        let held = held_at(theta.at(at), &loads).expect("regular");
                        let push = push_at(theta.at(at), &loads).expect("regular");
                        let expected = [held.effort_theta, held.B.x, held.B.y, push.effort_theta];
                        let found = rows.each_ref().map(|row| row[at + 1].to_bits());
                        assert_eq!(found, expected.map($scalar::to_bits), "position {at} of {count}, {same:b}");
                    }
                }
            });
        }
    };
}
given!(clamp, f64, whatever_is_given_has_the_bits_of_the_point_function);
given!(small_clamp, f32, whatever_is_given_has_the_bits_of_the_point_function_in_single_precision);
