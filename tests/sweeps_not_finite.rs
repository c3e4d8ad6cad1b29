//! NaN, infinity and the largest numbers in every input of sweeps of every kind, in both scalars and in fused arithmetic: at the position that
//! has one the sweep says what the function for a single position says, or has its bits.
#![allow(non_snake_case, reason = "couples have the names of the declaration")]

use linkage_runtime::{Error, Series, SweepError, Vector2, linkage};

/// Some blocks of positions and a part of one, in which one position is not as the others.
const COUNT: usize = 130;

/// Sweeps with one of their inputs bad at one position, each against its point function.
macro_rules! each_input {
    (
        $scalar:ident, $linkage:ident;
        $($sweep:ident($inputs:ident { $($input:ident = $good:expr),* }) -> $results:ident { $($row:ident),* }, $point:expr;)*
    ) => {{
        let mut refused = 0;
        for bad in [$scalar::NAN, $scalar::INFINITY, -$scalar::INFINITY, $scalar::MAX, -0.4 * $scalar::MAX] {
            for index in [0, 5, 63, 64, COUNT - 1] {$({
                let good = [$($good as $scalar),*];
                for which in 0..good.len() {
                    let mut columns = good.map(|good| [good; COUNT]);
                    columns[which][index] = bad;
                    let [$($input),*] = &columns;
                    let mut rows = [$(stringify!($row)),*].map(|_| [$scalar::NAN; COUNT]);
                    let [$($row),*] = &mut rows;
                    let inputs = $linkage::$inputs { $($input: Series::Each($input)),* };
                    let swept = $linkage::$sweep(&inputs, $linkage::$results { $($row),* });
                    let one = $point(columns.each_ref().map(|column| column[index]));
                    let what = format!("{}, {}, input {which} = {bad} at {index}", stringify!($linkage), stringify!($sweep));
                    match (swept, one) {
                        (Ok(()), Ok(one)) => {
                            assert!(one.iter().all(|x| x.is_finite()), "{what}: {one:?}");
                            assert_eq!(rows.map(|row| row[index].to_bits()), one.map($scalar::to_bits), "{what}");
                        }
                        (Err(error), Err(one)) => {
                            refused += 1;
                            assert_eq!(error, SweepError::Position { index, error: one }, "{what}");
                            assert!(rows.iter().all(|row| row[..index].iter().all(|x| !x.is_nan())), "{what}");
                            assert!(rows.iter().all(|row| row[index..].iter().all(|x| x.is_nan())), "{what}");
                        }
                        others => panic!("{what}: {others:?}"),
                    }
                }
            })*}
        }
        assert!(refused > 300, "{refused}");
    }};
}

macro_rules! rocker {
    ($name:ident, $scalar:ident, $arithmetic:ident) => {
        linkage! {
            /// A four-bar with two couples and a rate at run time.
            mod $name;
            scalar $scalar;
            arithmetic $arithmetic;
            units { m, N }
            ground       { A0: (0, 0), B0: (1.4m, 0.2m) }
            link crank   { A0 -> A: 0.4m }
            link coupler { A -> B: 1.3m, C: (0.5m, 0.2m) }
            link lever   { B0 -> B: 0.9m }
            mass coupler: 2kg at (0.6m, 0.1m), inertia 0.2kg*m^2;
            revolute A0: ground  -> crank;
            revolute A:  crank   -> coupler;
            revolute B:  coupler -> lever;
            revolute B0: ground  -> lever;
            drive theta: A0;
            unknown T: torque(ground -> crank);
            assemble B: left(A -> B0);
            assemble A: right(A0 -> B);
            load M: moment(lever);
            load N: moment(coupler);
            load W: gravity = 9.81m/s^2 @ -90deg;
            load I: inertia;
            scene held:   equilibrium(M, N, W) -> (T);
            scene parts:  superposition(M, N) -> (T);
            scene work:   virtual_work(M, W) -> (T);
            scene moved:  equilibrium(M, W, I) -> (T);
            scene place:  position -> (coupler.C);
            scene fast:   velocity -> (coupler.C);
            scene back:   inverse(B0) -> (theta, theta.rate);
            scene slopes: derivative(held) by (theta, M);
            scene state:  motion -> (h);
            scene each_held: sweep(held);
            scene each_part: sweep(parts);
            scene each_work: sweep(work);
            scene each_moved: sweep(moved);
            scene each_place: sweep(place);
            scene each_fast: sweep(fast);
            scene each_back: sweep(back);
            scene each_slope: sweep(slopes);
            scene each_state: sweep(state);
        }
    };
}
rocker!(plain, f64, plain);
rocker!(single, f32, plain);
rocker!(fused, f64, fused);

macro_rules! every_sweep {
    ($linkage:ident, $scalar:ident) => {
        each_input! {
            $scalar, $linkage;
            each_held(EachHeldInputs { theta = 0.7, M = 3.0, N = -2.0 }) -> EachHeld { T },
                |[theta, M, N]: [$scalar; 3]| $linkage::held_at(theta, &$linkage::Loads { M, N }).map(|one| [one.T]);
            each_part(EachPartInputs { theta = 0.7, M = 3.0, N = -2.0 }) -> EachPart { M_T, N_T },
                |[theta, M, N]: [$scalar; 3]| {
                    $linkage::parts_at(theta, &$linkage::Loads { M, N }).map(|one| [one.M.T, one.N.T])
                };
            each_work(EachWorkInputs { theta = 0.7, M = 3.0 }) -> EachWork { T },
                |[theta, M]: [$scalar; 2]| $linkage::work_at(theta, &$linkage::Loads { M, N: 0.0 }).map(|one| [one.T]);
            each_moved(EachMovedInputs { theta = 0.7, theta_rate = 5.0, theta_acceleration = -8.0, M = 3.0 })
                -> EachMoved { T },
                |[theta, theta_rate, theta_acceleration, M]: [$scalar; 4]| {
                    let motion = $linkage::Motion { theta_rate, theta_acceleration };
                    $linkage::moved_at(theta, &motion, &$linkage::Loads { M, N: 0.0 }).map(|one| [one.T])
                };
            each_place(EachPlaceInputs { theta = 0.7 }) -> EachPlace { coupler_C_x, coupler_C_y },
                |[theta]: [$scalar; 1]| $linkage::place_at(theta).map(|one| [one.coupler_C.x, one.coupler_C.y]);
            each_fast(EachFastInputs { theta = 0.7, theta_rate = 5.0 }) -> EachFast { coupler_C_x, coupler_C_y },
                |[theta, theta_rate]: [$scalar; 2]| {
                    let motion = $linkage::Motion { theta_rate, theta_acceleration: 0.0 };
                    $linkage::fast_at(theta, &motion).map(|one| [one.coupler_C.x, one.coupler_C.y])
                };
            each_back(EachBackInputs { B0_angle = 1.9, B0_angle_rate = 2.0 }) -> EachBack { theta, theta_rate },
                |[B0_angle, B0_angle_rate]: [$scalar; 2]| {
                    $linkage::back_at(B0_angle, &$linkage::BackMotion { B0_angle_rate })
                        .map(|one| [one.theta, one.theta_rate])
                };
            each_slope(EachSlopeInputs { theta = 0.7, M = 3.0, N = -2.0 }) -> EachSlope { theta_T, M_T },
                |[theta, M, N]: [$scalar; 3]| {
                    $linkage::slopes_at(theta, &$linkage::Loads { M, N }).map(|one| [one.theta.T, one.M.T])
                };
            each_state(EachStateInputs { theta = 0.7, theta_rate = 5.0, M = 3.0, N = -2.0 }) -> EachState { h },
                |[theta, theta_rate, M, N]: [$scalar; 4]| {
                    let motion = $linkage::Motion { theta_rate, theta_acceleration: 0.0 };
                    $linkage::state_at(theta, &motion, &$linkage::Loads { M, N }).map(|one| [one.h])
                };
        }
    };
}

#[test]
fn what_is_not_finite_is_refused_by_every_sweep() {
    every_sweep!(plain, f64);
    every_sweep!(single, f32);
    every_sweep!(fused, f64);
}

/// What a superposition is in all is finite, or not given.
#[test]
fn a_sum_of_parts_is_finite_or_refused() -> Result<(), Error> {
    let mut parts = plain::parts_at(0.7, &plain::Loads { M: 3.0, N: -2.0 })?;
    assert!((parts.total()?.T - parts.M.T - parts.N.T).abs() < 1e-12);
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        parts.M.T = bad;
        assert!(matches!(parts.total(), Err(Error::NotFinite { .. })), "{bad}");
    }
    (parts.M.T, parts.N.T) = (f64::MAX, f64::MAX);
    assert!(matches!(parts.total(), Err(Error::NotFinite { .. })));
    Ok(())
}

linkage! {
    /// A triad with a leg whose length is given at run time: placed by iteration, each position from the one before.
    mod triad;
    units { mm, N }
    param reach: length = 180mm;
    ground     { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm) }
    link crank { O -> A: 28mm }
    link rod   { A -> E: 230mm }
    link plate { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm), G: (50mm, 0) }
    link upper { Q -> C: 192mm }
    link lower { P -> D: reach }
    mass plate: 1kg at G;
    revolute O: ground -> crank;
    revolute A: crank  -> rod;
    revolute E: rod    -> plate;
    revolute C: plate  -> upper;
    revolute D: plate  -> lower;
    revolute Q: ground -> upper;
    revolute P: ground -> lower;
    drive theta: O;
    start theta: 30deg;
    start rod:   (30mm, 20mm), angle 30deg;
    start plate: (240mm, 140mm), angle 0;
    start upper: (500mm, 100mm), angle 140deg;
    start lower: (400mm, -100mm), angle 120deg;
    load F: force(plate.G);
    load I: inertia;
    scene held:   equilibrium -> (effort_theta, E, error_bound);
    scene turned: sweep(held);
}

/// Of positions that follow each other by iteration those before a bad one have the numbers that they have without it.
#[test]
fn what_is_not_finite_is_refused_where_positions_follow_each_other() {
    const COUNT: usize = 20;
    let linkage = triad::Linkage::new(&triad::Params::default()).unwrap();
    let run = |change: &dyn Fn(&mut [[f64; COUNT]; 5])| {
        let mut given: [[f64; COUNT]; 5] = [[0.5; COUNT], [2.0; COUNT], [1.0; COUNT], [3.0; COUNT], [-20.0; COUNT]];
        let mut theta = 0.5;
        for place in &mut given[0] {
            *place = theta;
            theta += 0.05;
        }
        change(&mut given);
        let [theta, theta_rate, theta_acceleration, x, y] = &given;
        let loads: [Vector2<f64>; COUNT] = core::array::from_fn(|index| Vector2::new(x[index], y[index]));
        let inputs = triad::TurnedInputs {
            theta: Series::Each(theta),
            theta_rate: Series::Each(theta_rate),
            theta_acceleration: Series::Each(theta_acceleration),
            F: Series::Each(&loads),
        };
        let mut rows = [[f64::NAN; COUNT]; 6];
        let [effort_theta, E_x, E_y, error_bound_effort_theta, error_bound_E_x, error_bound_E_y] = &mut rows;
        let results =
            triad::Turned { effort_theta, E_x, E_y, error_bound_effort_theta, error_bound_E_x, error_bound_E_y };
        (triad::turned(&linkage, &inputs, results), rows.map(|row| row.map(f64::to_bits)))
    };
    let (all, good) = run(&|_| {});
    assert_eq!(all, Ok(()));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -f64::MAX] {
        for at in [0, 7, COUNT - 1] {
            for which in 0..5 {
                let (swept, rows) = run(&|given| given[which][at] = bad);
                let what = format!("input {which} = {bad} at {at}: {swept:?}");
                assert!(matches!(swept, Err(SweepError::Position { index, .. }) if index == at), "{what}");
                for (row, good) in rows.iter().zip(&good) {
                    assert_eq!(row[..at], good[..at], "{what}");
                    assert!(row[at..].iter().all(|bits| f64::from_bits(*bits).is_nan()), "{what}");
                }
            }
        }
    }
}
