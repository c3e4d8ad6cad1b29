//! The reduced equation of motion as a user has it: against equilibrium with inertia, forward dynamics, dead centres, kinematic
//! coefficients and mechanical advantage.

use linkage_runtime::nalgebra::SVector;
use linkage_runtime::{Error, Series, SweepError, linkage};

linkage! {
    /// A crank-rocker with masses, weights, a damper and a load on its rocker.
    mod four_bar;
    units { mm, N }
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm, G: (15mm, 2mm) }
    link coupler { A -> B: 120mm, C: (50mm, 30mm) }
    link rocker  { B0 -> B: 80mm, D: (60mm, -10mm) }
    mass crank:   0.8kg at G, inertia 400kg*mm^2;
    mass coupler: 1.2kg at C, inertia 1900kg*mm^2;
    mass rocker:  0.7kg at D, inertia 900kg*mm^2;
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);
    load I: inertia;
    load W: gravity = 9.81m/s^2 @ -90deg;
    load K: spring(ground.B0, coupler.C) { rate: 0.2N/mm, free: 60mm, damping: 3N*s/m };
    load M4: moment(rocker);
    scene dynamics: equilibrium -> (T12);
    scene control: motion;
    scene mass: motion -> (M, M_kinetic);
    scene speeds: velocity -> (rocker.angle, coupler.C);
    scene accelerations: acceleration -> (rocker.angle, coupler.C);
    scene places: position -> (rocker.angle, coupler.C);
    scene advantage: virtual_work(M4) -> (M4, advantage(M4));
    scene gains: coefficients -> (rocker.angle, coupler.C);
    scene bounded: motion -> (M, h, error_bound);
    scene linear: derivative(control) by (theta, theta.rate, M4);
}

linkage! {
    /// The same held by a torque on the rocker: its M is not that of the kinetic energy.
    mod held;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm }
    link rocker  { B0 -> B: 80mm, D: (60mm, -10mm) }
    mass rocker: 0.7kg at D, inertia 900kg*mm^2;
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    unknown T14: torque(ground -> rocker);
    assemble B: left(A -> B0);
    load I: inertia;
    scene dynamics: equilibrium -> (T14);
    scene control: motion -> (M, h, rounding, M_kinetic);
    scene speeds: velocity -> (rocker.angle);
}

linkage! {
    /// A slider-crank in which the piston alone has mass.
    mod light;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: 140mm }
    link piston { B }
    mass piston: 0.45kg at B;
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B along 0deg;
    drive theta: O;
    assemble B: ahead(A);
    load F: force(piston.B) = (-3N, 0);
    scene control: motion();
    scene over: virtual_work -> (advantage(F));
}

linkage! {
    /// A lever that is pulled in any direction.
    mod pulled;
    ground     { O: (0, 0) }
    link lever { O -> A: 0.4m }
    revolute O: ground -> lever;
    drive theta: O;
    load P: force(lever.A);
    scene over: virtual_work -> (advantage(P));
}

linkage! {
    /// A five-bar with two drives.
    mod five_bar;
    ground     { O1: (0, 0), O2: (0.5m, 0) }
    link left  { O1 -> P: 0.3m, G: (0.12m, 0) }
    link right { O2 -> Q: 0.35m, G: (0.2m, 0.01m) }
    link upper { P -> R: 0.45m, G: (0.2m, 0) }
    link lower { Q -> R: 0.4m, G: (0.15m, 0) }
    mass left:  1.2kg at G, inertia 0.01kg*m^2;
    mass right: 1.4kg at G, inertia 0.02kg*m^2;
    mass upper: 0.8kg at G, inertia 0.012kg*m^2;
    mass lower: 0.7kg at G, inertia 0.009kg*m^2;
    revolute O1: ground -> left;
    revolute O2: ground -> right;
    revolute P: left -> upper;
    revolute Q: right -> lower;
    revolute R: upper -> lower;
    drive a: O1;
    drive b: O2;
    assemble R: left(P -> Q);
    load I: inertia;
    load W: gravity = (0, -9.81m/s^2);
    scene dynamics: virtual_work -> (effort_a, effort_b);
    scene control: motion;
    scene bare: motion() -> (M, h);
    scene cycle: sweep(bare);
    scene slopes: derivative(bare) by (a, b, a.rate, b.rate);
    scene path: sweep(slopes);
    scene gains: coefficients -> (R, upper.angle);
    scene speeds: velocity -> (R);
    scene accelerations: acceleration -> (R);
}

fn turns() -> impl Iterator<Item = f64> {
    (0..24).map(|step| 0.1 + 0.26 * f64::from(step))
}

#[test]
fn the_equation_of_motion_gives_the_torque_of_equilibrium_and_back() -> Result<(), Error> {
    let loads = four_bar::Loads { M4: 800.0 };
    for theta in turns() {
        let pose = four_bar::Pose::at(theta)?;
        for (rate, acceleration) in [(0.0, 0.0), (12.0, -40.0), (-7.0, 300.0)] {
            let motion = four_bar::Motion { theta_rate: rate, theta_acceleration: acceleration };
            let torque = pose.dynamics(&motion, &loads)?.T12;
            let control = pose.control(&motion, &loads)?;
            let size = control.h.abs() + control.M * acceleration.abs();
            assert!((control.M * acceleration + control.h - torque).abs() < 1e-12 * size, "{torque} {control:?}");
            assert!(control.M > 0.0 && control.rounding < 1e-12 * control.M, "{control:?}");
            let found = control.acceleration(torque)?;
            assert!((found - acceleration).abs() < 1e-12 * size / control.M, "{found} {acceleration}");
        }
        let mass = pose.mass()?;
        assert_eq!(mass.M.to_bits(), mass.M_kinetic.to_bits());
    }
    Ok(())
}

#[test]
fn held_elsewhere_its_mass_is_not_that_of_the_kinetic_energy() -> Result<(), Error> {
    for theta in turns() {
        let motion = held::Motion { theta_rate: 9.0, theta_acceleration: -55.0 };
        let control = held::control_at(theta, &motion)?;
        let torque = held::dynamics_at(theta, &motion)?.T14;
        assert!((control.M * -55.0 + control.h - torque).abs() < 1e-12 * (control.h.abs() + 55.0 * control.M.abs()));
        // The rocker alone has mass: its moment of inertia about its pin, times the ratio of rates, or its square.
        let inertia = 900e-6 + 0.7 * (0.06f64.powi(2) + 0.01f64.powi(2));
        let unit = held::Motion { theta_rate: 1.0, theta_acceleration: 0.0 };
        let ratio = held::speeds_at(theta, &unit)?.rocker_angle;
        assert!(
            (control.M - inertia * ratio).abs() < 1e-14 && (control.M_kinetic - inertia * ratio * ratio).abs() < 1e-14
        );
    }
    Ok(())
}

/// Linearised about a state, as a controller wants it: masses do not depend on rates and loads, and the rest as differences say.
#[test]
fn the_equation_of_motion_has_derivatives() -> Result<(), Error> {
    const STEP: f64 = 1e-5;
    let loads = four_bar::Loads { M4: 800.0 };
    let of = |theta: f64, rate: f64| {
        four_bar::control_at(theta, &four_bar::Motion { theta_rate: rate, theta_acceleration: 0.0 }, &loads)
    };
    for theta in turns() {
        let motion = four_bar::Motion { theta_rate: 12.0, theta_acceleration: 0.0 };
        let linear = four_bar::linear_at(theta, &motion, &loads)?;
        let near = |found: f64, [behind, ahead]: [f64; 2], size: f64| {
            let expected = (ahead - behind) / (2.0 * STEP);
            assert!((found - expected).abs() < 1e-7 * (size + expected.abs()), "{found} and not {expected}");
        };
        let [behind, ahead] = [of(theta - STEP, 12.0)?, of(theta + STEP, 12.0)?];
        near(linear.theta.M, [behind.M, ahead.M], ahead.M);
        near(linear.theta.h, [behind.h, ahead.h], ahead.h.abs());
        let [behind, ahead] = [of(theta, 12.0 - STEP)?, of(theta, 12.0 + STEP)?];
        near(linear.theta_rate.h, [behind.h, ahead.h], ahead.h.abs());
        assert_eq!([linear.theta_rate.M, linear.M4.M].map(f64::to_bits), [0, 0]);
        // The crank holds the moment on the rocker by the ratio of their rates.
        let unit = four_bar::Motion { theta_rate: 1.0, theta_acceleration: 0.0 };
        let ratio = four_bar::speeds_at(theta, &unit)?.rocker_angle;
        assert!((linear.M4.h + ratio).abs() < 1e-13 * ratio.abs().max(1.0));
    }
    Ok(())
}

/// Lagrange: `h_i = Σ (∂M_ij/∂q_k − ½ ∂M_jk/∂q_i) q̇_j q̇_k`, which is of second degree in the rates.
#[test]
fn centripetal_and_coriolis_terms_are_made_of_the_derivatives_of_the_masses() -> Result<(), Box<dyn core::error::Error>>
{
    let places = [(1.9, 1.1), (1.5, 1.6), (1.2, 2.0)];
    let rates = [2.5, -1.5];
    for (a, b) in places {
        let motion = five_bar::Motion { a_rate: rates[0], a_acceleration: 0.0, b_rate: rates[1], b_acceleration: 0.0 };
        let (bare, slopes) = (five_bar::bare_at(a, b, &motion)?, five_bar::slopes_at(a, b, &motion)?);
        let by = [slopes.a.M, slopes.b.M];
        for i in 0..2 {
            let terms = (0..4).map(|pair| (pair / 2, pair % 2));
            let terms = terms.map(|(j, k)| (by[k][(i, j)] - 0.5 * by[i][(j, k)]) * rates[j] * rates[k]);
            let sum: f64 = terms.sum();
            assert!((sum - bare.h[i]).abs() < 1e-12 * (1.0 + sum.abs()), "{sum} and not {}", bare.h[i]);
            let by_rates = rates[0] * slopes.a_rate.h[i] + rates[1] * slopes.b_rate.h[i];
            assert!((by_rates - 2.0 * bare.h[i]).abs() < 1e-12 * (1.0 + by_rates.abs()), "{by_rates}");
        }
        assert_eq!([slopes.a_rate.M.norm(), slopes.b_rate.M.norm()].map(f64::to_bits), [0, 0]);
    }
    Ok(())
}

#[test]
fn where_no_mass_resists_there_is_no_acceleration() -> Result<(), Error> {
    let motion = light::Motion { theta_rate: 20.0 };
    for dead in [0.0, core::f64::consts::PI, -core::f64::consts::PI] {
        let control = light::control_at(dead, &motion)?;
        assert!(control.M < 1e-30);
        assert_eq!(control.acceleration(1.0), Err(Error::NoInertia { scene: "control" }));
        // Close by, where the mass is more than rounding, it is no error.
        let near = light::control_at(dead + 1e-7, &motion)?;
        assert!(near.acceleration(1.0)? > 0.0);
    }
    let control = light::control_at(1.0, &motion)?;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, f64::MAX, -f64::MAX] {
        assert!(matches!(control.acceleration(bad), Err(Error::NotFinite { .. })), "{bad}");
    }
    assert_eq!(control.acceleration(control.h)?.to_bits(), 0.0f64.to_bits());
    Ok(())
}

#[test]
fn of_two_drives_the_mass_is_a_symmetric_matrix() -> Result<(), Error> {
    for (a, b) in [(1.9, 1.1), (1.5, 1.6), (1.2, 2.0)] {
        let motion = five_bar::Motion { a_rate: 2.5, a_acceleration: -3.0, b_rate: -1.5, b_acceleration: 6.0 };
        let pose = five_bar::Pose::at(a, b)?;
        let control = pose.control(&motion)?;
        assert_eq!(control.M, control.M.transpose());
        assert!(control.M.determinant() > 0.0 && control.M.trace() > 0.0);
        let wanted = SVector::from([-3.0, 6.0]);
        let efforts = control.M * wanted + control.h;
        let dynamics = pose.dynamics(&motion)?;
        assert!((efforts - SVector::from([dynamics.effort_a, dynamics.effort_b])).norm() < 1e-12 * control.h.norm());
        let found = control.acceleration(efforts)?;
        assert!((found - wanted).norm() < 1e-11, "{found}");
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -f64::MAX] {
            for efforts in [[bad, 0.0], [0.0, bad], [bad, bad], [bad, -bad]] {
                let refused = control.acceleration(SVector::from(efforts));
                assert!(matches!(refused, Err(Error::NotFinite { .. })), "{efforts:?}: {refused:?}");
            }
        }
        let straight = five_bar::control_at(a, b, &motion)?;
        assert!((straight.M - control.M).norm() < 1e-14 && (straight.h - control.h).norm() < 1e-12);
        // Without loads what is left of h is quadratic in the rates.
        let faster = five_bar::Motion { a_rate: 5.0, b_rate: -3.0, ..motion };
        let (slow, fast) = (pose.bare(&motion)?, pose.bare(&faster)?);
        assert!((fast.h - 4.0 * slow.h).norm() < 1e-12 * fast.h.norm() && slow.M == control.M);
    }
    Ok(())
}

#[test]
fn a_sweep_has_a_slice_for_every_entry() -> Result<(), SweepError> {
    let (a, b) = ([1.9, 1.5, 1.2], [1.1, 1.6, 2.0]);
    let inputs = five_bar::CycleInputs {
        a: Series::Each(&a),
        b: Series::Each(&b),
        a_rate: Series::Constant(2.5),
        b_rate: Series::Constant(-1.5),
    };
    let [mut m_11, mut m_21, mut m_12, mut m_22, mut h_1, mut h_2] = [[0.0; 3]; 6];
    let results = five_bar::Cycle {
        M_1_1: &mut m_11,
        M_2_1: &mut m_21,
        M_1_2: &mut m_12,
        M_2_2: &mut m_22,
        h_1: &mut h_1,
        h_2: &mut h_2,
    };
    five_bar::cycle(&inputs, results)?;
    let motion = five_bar::Motion { a_rate: 2.5, b_rate: -1.5, ..five_bar::Motion::default() };
    for index in 0..3 {
        let alone = five_bar::bare_at(a[index], b[index], &motion).expect("a pose");
        assert_eq!(alone.M.data.0, [[m_11[index], m_21[index]], [m_12[index], m_22[index]]]);
        assert_eq!(alone.h.data.0, [[h_1[index], h_2[index]]]);
    }
    Ok(())
}

#[test]
fn coefficients_of_motion_are_what_unit_rate_gives() -> Result<(), Error> {
    let unit = four_bar::Motion { theta_rate: 1.0, theta_acceleration: 0.0 };
    for theta in turns() {
        let step = 1e-4;
        let [before, at, behind] = [theta - step, theta, theta + step].map(four_bar::places_at);
        let (before, at, behind) = (before?, at?, behind?);
        let (first, second) = (four_bar::speeds_at(theta, &unit)?, four_bar::accelerations_at(theta, &unit)?);
        let turned = (behind.rocker_angle - before.rocker_angle) / (2.0 * step);
        let bent = (behind.rocker_angle - 2.0 * at.rocker_angle + before.rocker_angle) / (step * step);
        assert!((first.rocker_angle - turned).abs() < 1e-6 && (second.rocker_angle - bent).abs() < 1e-5);
        let curved = (behind.coupler_C - 2.0 * at.coupler_C + before.coupler_C) / (step * step);
        assert!((second.coupler_C - curved).norm() < 1e-3);
        // One turn of the crank for so many of the rocker: moments are in the inverse ratio.
        let advantage = four_bar::advantage_at(theta, &four_bar::Loads { M4: 1.0 })?;
        assert!((advantage.M4.velocity - first.rocker_angle).abs() < 1e-14);
        assert!((advantage.M4_advantage * first.rocker_angle - 1.0).abs() < 1e-14);
        let gains = four_bar::gains_at(theta)?;
        let (angle, place) = (gains.rocker_angle, gains.coupler_C);
        assert!((angle.by_theta - first.rocker_angle).abs() < 1e-14, "{angle:?}");
        assert!((angle.by_theta_theta - second.rocker_angle).abs() < 1e-12, "{angle:?}");
        assert!((place.by_theta - first.coupler_C).norm() < 1e-11, "{place:?}");
        assert!((place.by_theta_theta - second.coupler_C).norm() < 1e-10, "{place:?}");
    }
    Ok(())
}

/// Where the driver moves and the output rests, a unit of effort holds any load.
#[test]
fn at_a_dead_centre_of_the_output_the_advantage_is_unbounded() -> Result<(), Error> {
    let stroke = |crank: f64| light::over_at(crank).map(|over| over.F_advantage);
    assert_eq!(stroke(0.0), Err(Error::DeadCentre { group: "F", pivot: "v_along_F" }));
    assert_eq!(stroke(core::f64::consts::PI), Err(Error::DeadCentre { group: "F", pivot: "v_along_F" }));
    // At right angles the piston moves as fast as the crank's pin: the force there, times the crank, is the torque.
    assert!((stroke(core::f64::consts::FRAC_PI_2)? - 25.0).abs() < 1e-12);
    Ok(())
}

#[test]
fn a_force_that_vanishes_has_no_direction_to_be_held_in() {
    let pull = |x: f64, y: f64| pulled::over_at(0.0, &pulled::Loads { P: [x, y].into() }).map(|over| over.P_advantage);
    assert_eq!(pull(0.0, 1e-300), Ok(2.5));
    assert_eq!(pull(0.0, -2.0), Ok(-2.5));
    assert_eq!(pull(3.0, 0.0), Err(Error::DeadCentre { group: "P", pivot: "v_along_P" }));
    assert_eq!(pull(0.0, 0.0), Err(Error::NoDirection { of: "P" }));
}

#[test]
fn the_bounds_of_an_equation_of_motion_hold_what_two_ways_differ_by() -> Result<(), Error> {
    let (motion, loads) =
        (four_bar::Motion { theta_rate: 12.0, theta_acceleration: -40.0 }, four_bar::Loads { M4: 800.0 });
    for theta in turns() {
        let (bounded, control) =
            (four_bar::bounded_at(theta, &motion, &loads)?, four_bar::control_at(theta, &motion, &loads)?);
        let bound = bounded.error_bound;
        assert!((bounded.M - control.M).abs() <= 2.0 * bound.M && (bounded.h - control.h).abs() <= 2.0 * bound.h);
        assert!(bound.M > 0.0 && bound.M < 1e-10 * control.M, "{bounded:?}");
        assert!(bound.h > 0.0 && bound.h < 1e-9 * control.h.abs().max(1.0), "{bounded:?}");
    }
    Ok(())
}

#[test]
fn coefficients_of_two_drives_make_every_motion() -> Result<(), Error> {
    for (a, b) in [(1.9, 1.1), (1.5, 1.6), (1.2, 2.0)] {
        let motion = five_bar::Motion { a_rate: 2.5, a_acceleration: -3.0, b_rate: -1.5, b_acceleration: 6.0 };
        let pose = five_bar::Pose::at(a, b)?;
        let (gains, speeds, accelerations) = (pose.gains()?, pose.speeds(&motion)?, pose.accelerations(&motion)?);
        let own = gains.R;
        let speed = own.by_a * 2.5 - own.by_b * 1.5;
        let acceleration =
            own.by_a * -3.0 + own.by_b * 6.0 + own.by_a_a * 6.25 + own.by_a_b * (2.0 * 2.5 * -1.5) + own.by_b_b * 2.25;
        assert!((speed - speeds.R).norm() < 1e-12 * speed.norm(), "{speed} {}", speeds.R);
        assert!((acceleration - accelerations.R).norm() < 1e-12 * acceleration.norm(), "{acceleration}");
        // Mixed derivatives by differences of the first ones.
        let step = 1e-5;
        let [below, above] = [five_bar::gains_at(a, b - step)?, five_bar::gains_at(a, b + step)?];
        let mixed = (above.upper_angle.by_a - below.upper_angle.by_a) / (2.0 * step);
        assert!((mixed - gains.upper_angle.by_a_b).abs() < 1e-8, "{mixed}");
    }
    Ok(())
}
