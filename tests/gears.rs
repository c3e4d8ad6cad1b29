//! Gears as a user has them: torsion springs on wheels that turn many times, and radii that are parameters.

use core::f64::consts::TAU;

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// A planetary train in a fixed ring, with springs on its wheels.
    mod train;
    units { mm, N }
    ground       { O: (0, 0) }
    link sun     { O -> k: 20mm }
    link carrier { O -> C: 37.5mm }
    link planet  { C: (0, 0), p: (10mm, 0) }
    revolute Os: ground.O -> sun.O;
    revolute Oc: ground.O -> carrier.O;
    revolute C: carrier -> planet;
    gear Gs: sun.O -> planet.C, radii (25mm, 12.5mm);
    gear Gr: ground.O -> planet.C, radii (50mm, 12.5mm), internal;
    drive q: Os;
    load A: torsion(ground -> planet) { rate: 2N*mm/rad, free: 10deg };
    load B: torsion(planet -> carrier) { rate: 3N*mm/rad, free: _ };
    load C1: torsion(sun -> planet) { rate: 1N*mm/rad, free: 0 };
    scene work: virtual_work;
    scene statics: equilibrium;
    scene where: position -> (sun.angle, planet.angle, carrier.angle);
    scene check: verify;
}

#[test]
fn torsion_springs_on_wheels_count_all_turns() -> Result<(), Error> {
    let loads = train::Loads { B: train::LoadsB { free: 0.25 } };
    for q in [0.3, 2.0, 10.0, -35.0, 40.0 * TAU + 0.1] {
        // Willis: with the ring at rest the carrier makes a third of the sun's turns, and the planet turns at −1.
        let (carrier, planet) = (q / 3.0, -q);
        let angles = train::r#where_at(q)?;
        assert!((angles.carrier_angle - carrier).abs() < 1e-12 * (1.0 + q.abs()));
        assert!((angles.planet_angle - planet).abs() < 1e-12 * (1.0 + q.abs()));
        let held = [2.0 * (planet - 10f64.to_radians()), 3.0 * (carrier - planet - 0.25), planet - q];
        let rates = [-1.0, 4.0 / 3.0, -2.0];
        let work = train::work_at(q, &loads)?;
        let expected: f64 = held.iter().zip(rates).map(|(moment, rate)| moment * rate).sum();
        assert!((work.effort_q - expected).abs() < 1e-11 * (1.0 + expected.abs()), "{} {expected}", work.effort_q);
        let terms = [work.A, work.B, work.C1];
        for (term, (moment, rate)) in terms.iter().zip(held.iter().zip(rates)) {
            assert!((term.work + moment * rate).abs() < 1e-11 * (1.0 + moment.abs()));
        }
        assert!((train::statics_at(q, &loads)?.effort_q - expected).abs() < 1e-11 * (1.0 + expected.abs()));
        assert!(train::check_at(q, &loads)?.general < 1e-11);
    }
    Ok(())
}

linkage! {
    /// A pinion in a ring on a rocker, which turns it several times to and fro.
    mod pinion;
    units { mm, N }
    ground       { O: (0, 0), Q: (140mm, 0), R: (140mm, 57mm) }
    link crank   { O -> A: 60mm }
    link coupler { A -> B: 100mm }
    link rocker  { Q -> B: 120mm }
    link wheel   { R -> p: 5mm }
    link arm     { R -> a: 20mm }
    revolute O: ground -> crank;
    revolute A: crank -> coupler;
    revolute B: coupler -> rocker;
    revolute Q: ground -> rocker;
    revolute R: ground -> wheel;
    gear G: rocker.Q -> wheel.R, radii (60mm, 3mm), internal, pressure_angle 20deg, flank left;
    weld W: wheel.R -> arm.R, angle 30deg;
    drive q: O;
    assemble B: left(A -> Q);
    load K: torsion(ground -> wheel) { rate: 2N*mm/rad, free: 100deg };
    load L: torsion(arm -> coupler) { rate: 1N*mm/rad, free: 0 };
    scene parts: virtual_work;
    scene where: position -> (wheel.angle, arm.angle, coupler.angle, rocker.angle);
    scene check: verify;
}

#[test]
fn a_wheel_that_a_rocker_turns_counts_its_turns_too() -> Result<(), Error> {
    let (mut low, mut high) = (f64::MAX, f64::MIN);
    let mut before: Option<(f64, f64)> = None;
    for step in 0..200 {
        let q = f64::from(step) * 0.05;
        let angles = pinion::r#where_at(q)?;
        (low, high) = (low.min(angles.wheel_angle), high.max(angles.wheel_angle));
        assert!((angles.arm_angle - angles.wheel_angle - 30f64.to_radians()).abs() < 1e-13);
        let terms = pinion::parts_at(q)?;
        // By the angle that the results show.
        let moment = -2.0 * (angles.wheel_angle - 100f64.to_radians());
        assert!((terms.K.work - moment * terms.K.velocity).abs() < 1e-11 * (1.0 + terms.K.work.abs()));
        let moment = -(angles.coupler_angle - angles.arm_angle);
        assert!((terms.L.work - moment * terms.L.velocity).abs() < 1e-11 * (1.0 + terms.L.work.abs()));
        // Which is one motion, without jumps.
        if let Some((angle, rate)) = before {
            let mean = f64::midpoint(rate, terms.K.velocity);
            assert!((angles.wheel_angle - angle - mean * 0.05).abs() < 0.02, "{q}");
        }
        before = Some((angles.wheel_angle, terms.K.velocity));
        assert!(pinion::check_at(q)?.general < 1e-11);
    }
    assert!(high - low > 2.0 * TAU, "{low} {high}");
    Ok(())
}

linkage! {
    mod adjustable;
    units { mm, N }
    param ra: length = 30mm;
    param rb: length;
    param alpha: angle = 20deg;
    ground { O: (0, 0), Q: (70mm, 0), R: (0, 45mm) }
    link a { O -> k: 20mm }
    link b { Q: (0, 0), T: (25mm, 0) }
    link c { R: (0, 0) }
    revolute O: ground -> a;
    revolute Q: ground -> b;
    revolute R: ground -> c;
    gear G: a.O -> b.Q, radii (ra, rb), phase ra / 6, pressure_angle alpha, flank right;
    gear H: c.R -> a.O, radii (45mm + ra, ra), internal;
    drive q: O;
    load F: force(b.T);
    load K: torsion(ground -> c) { rate: 5N*mm/rad, free: 0 };
    scene statics: equilibrium;
}

#[test]
fn radii_may_be_parameters() -> Result<(), Error> {
    use adjustable::{Linkage, Loads, Params};
    let linkage = Linkage::new(&Params { ra: 30.0, rb: 40.0, alpha: 20f64.to_radians() })?;
    let loads = Loads { F: Vector2::new(0.0, 100.0) };
    let held = adjustable::statics_at(&linkage, 9.0, &loads)?;
    // 30 θa + 40 θb = 5: the force of 100 N at 25 mm turns b by its cosine, and c, in whose ring a runs, turns with a: 75 θc = 30 θa + ….
    let b = (5.0 - 30.0 * 9.0) / 40.0;
    let tooth = 100.0 * 25.0 * f64::cos(b) / 40.0;
    assert!((held.G.tangential - tooth).abs() < 1e-12 * tooth.abs(), "{} {tooth}", held.G.tangential);
    assert!((held.G.force.x + held.G.tangential * 20f64.to_radians().tan()).abs() < 1e-12 * tooth.abs());
    let refused = |ra: f64, rb: f64, alpha: f64, what: &str| match Linkage::new(&Params { ra, rb, alpha }) {
        Err(Error::Parameter { requirement }) => assert!(requirement.contains(what), "{requirement}"),
        other => panic!("{other:?}"),
    };
    refused(30.0, 41.0, 0.3, "G: the radii of its wheels must fill the distance of their centres to a hundredth");
    refused(30.0, -40.0, 0.3, "G: the radius of a wheel must be positive");
    refused(30.0, 40.0, 1.6, "G: its pressure angle must lie between 0 and 90°");
    refused(30.0, 40.0, -0.1, "G: its pressure angle must lie between 0 and 90°");
    assert!(matches!(Linkage::new(&Params { ra: f64::NAN, rb: 40.0, alpha: 0.3 }), Err(Error::NotFinite { .. })));
    Ok(())
}

linkage! {
    /// A pinion in a driven ring, their radii at run time.
    mod ringed;
    units { mm, N }
    param ring: length;
    param pinion: length;
    ground { R: (0, 0), P: (30mm, 0) }
    link outer { R: (0, 0) }
    link inner { P: (0, 0) }
    revolute R: ground -> outer;
    revolute P: ground -> inner;
    gear G: outer.R -> inner.P, radii (ring, pinion), internal;
    drive q: R;
    load M: moment(inner) = 300N*mm;
    scene statics: equilibrium -> (effort_q, G);
    scene place: position -> (inner.angle);
}

#[test]
fn a_ring_of_given_size_turns_its_pinion() -> Result<(), Error> {
    let linkage = ringed::Linkage::new(&ringed::Params { ring: 50.0, pinion: 20.0 })?;
    for q in [-4.0, 0.3, 9.0] {
        // 50 q = 20 θ, and the tooth force holds the moment.
        assert!((ringed::place_at(&linkage, q)?.inner_angle - 2.5 * q).abs() < 1e-14 * (1.0 + q.abs()));
        let held = ringed::statics_at(&linkage, q)?;
        assert!((held.G.tangential.abs() - 15.0).abs() < 1e-13, "{held:?}");
        assert!((held.effort_q + 750.0).abs() < 1e-11, "{held:?}");
    }
    let refused = ringed::Linkage::new(&ringed::Params { ring: 20.0, pinion: 50.0 });
    assert!(matches!(refused, Err(Error::Parameter { .. })), "{refused:?}");
    Ok(())
}

/// A wheel on a coupler that a parameter makes as long as it has to be for the gear: what the gear divides by is a constant.
macro_rules! wheel_on_a_coupler {
    ($name:ident, $scalar:ident, $results:tt) => {
        linkage! {
            mod $name;
            scalar $scalar;
            units { mm, N }
            param along: length = 100mm;
            ground { O: (0, 0), R: (300mm, 0) }
            link crank   { O: (0, 0), A: (60mm, 0) }
            link coupler { A: (0, 0), B: (200mm, 50mm), W: (along, 10mm) }
            link rocker  { R: (0, 0), B: (180mm, 0) }
            link wheel   { W: (0, 0) }
            revolute O: ground  -> crank;
            revolute A: coupler -> crank;
            revolute B: rocker  -> coupler;
            revolute R: ground  -> rocker;
            revolute W: wheel   -> coupler;
            gear G: crank.A -> wheel.W, radii (140mm, 40mm), internal;
            drive q: O;
            assemble B: left(A -> R);
            load M: moment(wheel);
            scene held: equilibrium -> $results;
            scene work: virtual_work;
        }
    };
}
wheel_on_a_coupler!(on_coupler, f64, (effort_q, G));
wheel_on_a_coupler!(on_coupler_single, f32, (effort_q, G));
wheel_on_a_coupler!(on_coupler_bounded, f64, (effort_q, error_bound));

#[test]
#[allow(clippy::cast_possible_truncation, reason = "to single precision")]
fn a_wheel_on_an_adjustable_coupler() -> Result<(), Error> {
    let along = (100f64 * 100.0 - 10.0 * 10.0).sqrt();
    let linkage = on_coupler::Linkage::new(&on_coupler::Params { along })?;
    let single = on_coupler_single::Linkage::new(&on_coupler_single::Params { along: 99.498_74 })?;
    let bounded = on_coupler_bounded::Linkage::new(&on_coupler_bounded::Params { along })?;
    for q in [0.4, 2.0, -1.5] {
        let held = on_coupler::held_at(&linkage, q, &on_coupler::Loads { M: 300.0 })?;
        assert!((held.G.tangential.abs() - 7.5).abs() < 1e-13, "{held:?}");
        let work = on_coupler::work_at(&linkage, q, &on_coupler::Loads { M: 300.0 })?;
        assert!((held.effort_q - work.effort_q).abs() < 1e-10, "{held:?}, {work:?}");
        let in_single = on_coupler_single::held_at(&single, q as f32, &on_coupler_single::Loads { M: 300.0 })?;
        assert!((f64::from(in_single.effort_q) - held.effort_q).abs() < 1e-2, "{held:?}, {in_single:?}");
        let bound = on_coupler_bounded::held_at(&bounded, q, &on_coupler_bounded::Loads { M: 300.0 })?;
        assert!((bound.effort_q - held.effort_q).abs() <= 2.0 * bound.error_bound.effort_q, "{held:?}, {bound:?}");
    }
    // Wheels that are not held at their distance are refused.
    let apart = on_coupler::Linkage::new(&on_coupler::Params { along: 120.0 });
    assert!(matches!(apart, Err(Error::Parameter { .. })), "{apart:?}");
    Ok(())
}

linkage! {
    /// A wheel that a drive turns against the rocker of a four-bar, and another one in mesh with it.
    mod rolling;
    ground       { A0: (0, 0), B0: (0.14m, 0) }
    link crank   { A0 -> A: 0.04m }
    link coupler { A -> B: 0.12m }
    link rocker  { B0: (0, 0), B: (-0.08m, 0), Q: (-0.05m, 0.01m), R: (-0.02m, 0.05m) }
    link driven  { Q: (0, 0), rim: (0.02m, 0) }
    link meshing { R: (0, 0), rim: (0.01m, 0) }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    revolute Q:  rocker  -> driven;
    revolute R:  rocker  -> meshing;
    gear H: driven.Q -> meshing.R, radii (0.021m, 0.029m), phase 0.003m;
    drive t: A0;
    drive y: Q;
    assemble B: left(A -> B0);
    load K: torsion(driven -> ground) { rate: 1N*m/rad, free: 0 };
    scene place: position -> (rocker.angle, driven.angle, meshing.angle, meshing.R, meshing.rim);
    scene speeds: velocity -> (driven.angle, meshing.angle);
    scene work: virtual_work -> (K);
}

#[test]
fn a_wheel_that_a_drive_turns_against_a_moving_arm_counts_its_turns() -> Result<(), Error> {
    let at = |y| rolling::place_at(0.5, y);
    let rest = at(0.0)?;
    for y in [-40.0, -4.6, 0.3, 4.6, 4.7, 8.0, 9.0, 1000.0] {
        let (here, near) = (at(y)?, 1e-12 * (1.0 + f64::abs(y)));
        assert!((here.rocker_angle - rest.rocker_angle).abs() < near);
        assert!((here.driven_angle - rest.driven_angle - y).abs() < near, "{y}: {}", here.driven_angle);
        assert!(
            (here.meshing_angle - rest.meshing_angle + 21.0 / 29.0 * y).abs() < near,
            "{y}: {}",
            here.meshing_angle
        );
        let (sin, cos) = here.meshing_angle.sin_cos();
        let rim = here.meshing_R + 0.01 * Vector2::new(cos, sin);
        assert!((here.meshing_rim - rim).norm() < near);
        let motion = rolling::Motion { t_rate: 0.0, y_rate: 2.0 };
        let speeds = rolling::speeds_at(0.5, y, &motion)?;
        assert!((speeds.driven_angle - 2.0).abs() < 1e-12 && (speeds.meshing_angle + 42.0 / 29.0).abs() < 1e-12);
        // The spring counts the turns too: its moment holds the wheel back.
        let term = rolling::work_at(0.5, y)?.K.effort_y;
        assert!((term.work + here.driven_angle).abs() < 1e-11 * (1.0 + f64::abs(y)), "{y}: {term:?}");
    }
    Ok(())
}
