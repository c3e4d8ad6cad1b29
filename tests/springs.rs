//! Springs and thrusts as a user has them: balance, coincident ends, values at run time, several turns, both scalars.

use linkage_runtime::{Error, linkage};

linkage! {
    /// An arm whose weight a spring without free length balances at every angle.
    mod arm;
    units { mm, N }
    ground   { O: (0, 0), P: (0, 200mm), Q: (250mm, 0) }
    link arm { O -> tip: 400mm, M: (250mm, 0), K: (150mm, 0) }
    mass arm: 1.2kg at M;
    revolute O: ground -> arm;
    drive theta: O;
    load W:       gravity = 10m/s^2 @ -90deg;
    load balance: spring(ground.P, arm.K) { rate: 0.1N/mm, free: 0 };
    load soft:    spring(ground.Q, arm.M) { rate: _, free: 0 };
    load stiff:   spring(ground.Q, arm.M) { rate: 2N/mm, free: _, preload: _ };
    load wound:   torsion(ground -> arm) { rate: 3N*m/rad, free: _ };
    load push:    thrust(ground.Q, arm.M);
    scene balanced: equilibrium(W, balance);
    scene soft_held: equilibrium(soft);
    scene stiff_held: equilibrium(stiff);
    scene pushed: equilibrium(push);
    scene turned: equilibrium(wound) -> (effort_theta);
    scene work: virtual_work;
    scene check: verify;
}

fn loads() -> arm::Loads {
    arm::Loads {
        soft: arm::LoadsSoft { rate: 3.0 },
        stiff: arm::LoadsStiff { free: 40.0, preload: 5.0 },
        wound: arm::LoadsWound { free: 0.25 },
        push: 70.0,
    }
}

#[test]
fn a_spring_without_free_length_balances_a_weight_at_every_angle() {
    for step in -20..20 {
        let held = arm::balanced_at(0.3 * f64::from(step)).unwrap();
        assert!(held.effort_theta.abs() < 1e-11, "{}", held.effort_theta);
        // The spring lifts as well as the pin: 0.1 N/mm over 200 mm.
        assert!((held.O.y - (12.0 - 20.0 + 15.0 * (0.3 * f64::from(step)).sin())).abs() < 1e-12);
    }
}

#[test]
fn all_ways_to_the_effort_agree() {
    for theta in [0.4, 1.7, -2.9] {
        let agreement = arm::check_at(theta, &loads()).unwrap();
        assert!(agreement.general < 1e-14 && agreement.superposition < 1e-14 && agreement.virtual_work < 1e-14);
        let work = arm::work_at(theta, &loads()).unwrap();
        let sum =
            work.W.arm.work + work.balance.work + work.soft.work + work.stiff.work + work.wound.work + work.push.work;
        assert!((sum + work.effort_theta).abs() < 1e-10, "{sum} {}", work.effort_theta);
        // Tension 2 (L − 40) + 5, against the rate at which the spring grows.
        let length = (arm::Pose::at(theta).unwrap().arm_M() - linkage_runtime::Vector2::new(250.0, 0.0)).norm();
        assert!((work.stiff.work + (2.0 * (length - 40.0) + 5.0) * work.stiff.velocity).abs() < 1e-9);
        assert!((work.push.work - 70.0 * work.push.velocity).abs() < 1e-9);
    }
}

#[test]
fn coincident_ends_are_exact_or_an_error() {
    let soft = arm::soft_held_at(0.0, &loads()).unwrap();
    assert_eq!((soft.effort_theta, soft.O.x, soft.O.y), (0.0, 0.0, 0.0));
    assert_eq!(arm::stiff_held_at(0.0, &loads()), Err(Error::CoincidentEnds { of: "stiff" }));
    assert_eq!(arm::pushed_at(0.0, &loads()), Err(Error::CoincidentEnds { of: "push" }));
    assert_eq!(arm::pushed_at(1e-300, &loads()), Err(Error::CoincidentEnds { of: "push" }));
    assert!(arm::work_at(0.0, &loads()).is_err() && arm::check_at(0.0, &loads()).is_err());
    // Near to it, in proportion.
    let near = arm::soft_held_at(1e-6, &loads()).unwrap();
    assert!((near.O.y - 3.0 * 250.0 * 1e-6).abs() < 1e-15);
}

#[test]
fn values_that_are_no_numbers_are_errors() {
    for bad in [f64::NAN, f64::INFINITY, 1e308] {
        let soft = arm::Loads { soft: arm::LoadsSoft { rate: bad }, ..loads() };
        assert!(matches!(arm::soft_held_at(1.0, &soft), Err(Error::NotFinite { .. })));
        let free = arm::Loads { stiff: arm::LoadsStiff { free: bad, preload: 0.0 }, ..loads() };
        assert!(matches!(arm::stiff_held_at(1.0, &free), Err(Error::NotFinite { .. })));
        let wound = arm::Loads { wound: arm::LoadsWound { free: bad }, ..loads() };
        assert!(matches!(arm::turned_at(1.0, &wound), Err(Error::NotFinite { .. })));
        let push = arm::Loads { push: if bad < f64::INFINITY { f64::NAN } else { bad }, ..loads() };
        assert!(matches!(arm::pushed_at(1.0, &push), Err(Error::NotFinite { .. })));
    }
}

#[test]
fn a_torsion_spring_at_a_driven_link_counts_whole_turns() {
    let at = |theta: f64| arm::turned_at(theta, &loads()).unwrap().effort_theta;
    assert_eq!(at(0.25).to_bits(), 0);
    assert!((at(20.25) - 60_000.0).abs() < 1e-9);
}

linkage! {
    /// A torsion spring at a rocker, whose angle is known by its direction only.
    mod rocker;
    units { mm, N }
    scalar f32;
    param stiffness: torsion_stiffness = 2N*m/rad;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 60mm }
    link coupler { A -> B: 100mm }
    link rocker  { B0 -> B: 120mm }
    revolute A0: ground -> crank;
    revolute A: crank -> coupler;
    revolute B: coupler -> rocker;
    revolute B0: ground -> rocker;
    drive theta: A0;
    unknown M: torque(ground -> rocker);
    assemble B: left(A -> B0);
    load near: torsion(ground -> rocker) { rate: stiffness, free: 90deg };
    load far: torsion(ground -> rocker) { rate: stiffness, free: 90deg + 4rev };
    scene one: equilibrium(near) -> (M);
    scene other: equilibrium(far) -> (M);
    scene whole: position -> (rocker.angle);
}

#[test]
fn elsewhere_the_angle_is_the_one_nearest_to_the_free_angle() {
    let linkage = rocker::Linkage::new(&rocker::Params::default()).unwrap();
    let angle = rocker::whole_at(&linkage, 1.0).unwrap().rocker_angle;
    let held = rocker::one_at(&linkage, 1.0).unwrap().M;
    assert!((held - 2000.0 * (angle - core::f32::consts::FRAC_PI_2)).abs() < 1e-3, "{held} at {angle}");
    assert!((rocker::other_at(&linkage, 1.0).unwrap().M - held).abs() < 1e-3);
}

linkage! {
    /// A torsion spring between a crank that goes round and round and its coupler, which does not.
    mod winder;
    units { mm, N }
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 60mm }
    link coupler { A -> B: 100mm }
    link rocker  { B0 -> B: 120mm }
    revolute A0: ground -> crank;
    revolute A: crank -> coupler;
    revolute B: coupler -> rocker;
    revolute B0: ground -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0);
    load fixed: torsion(crank -> coupler) { rate: 2N*m/rad, free: 20deg, near: 30deg };
    load given: torsion(coupler -> crank) { rate: _, free: _, near: _ };
    scene parts: superposition -> (B);
    scene work: virtual_work;
    scene angle: position -> (coupler.angle);
    scene check: verify;
}

#[test]
fn a_torsion_spring_may_say_its_turn() {
    let given = winder::LoadsGiven { rate: 2000.0, free: -20f64.to_radians(), near: -30f64.to_radians() };
    let loads = winder::Loads { given };
    for turns in [-3.0, 0.0, 2.0] {
        let theta = 1.0 + turns * core::f64::consts::TAU;
        let work = winder::work_at(theta, &loads).unwrap();
        let wound = winder::angle_at(theta).unwrap().coupler_angle - theta - 20f64.to_radians();
        assert!((work.fixed.work + 2000.0 * wound * work.fixed.velocity).abs() < 1e-9 * work.fixed.work.abs());
        assert!((work.given.work - work.fixed.work).abs() < 1e-9 * work.fixed.work.abs());
        let parts = winder::parts_at(theta, &loads).unwrap();
        assert!((parts.given.B - parts.fixed.B).norm() < 1e-9 * parts.fixed.B.norm());
        assert!(winder::check_at(theta, &loads).unwrap().general < 1e-12);
    }
}

linkage! {
    /// A sprung rod on an arm that stands a million metres from the origin, where places are rounded to a tenth of a nanometre.
    mod far;
    units { mm, N }
    ground   { O: (1e9mm, 1e9mm), P: (1e9mm + 300mm, 1e9mm + 80mm) }
    link arm { O -> A: 120mm }
    link rod { A: (0, 0), K: (70mm, 25mm) }
    revolute O: ground -> arm;
    weld A: arm -> rod, angle 40deg;
    drive theta: O;
    load pull: spring(ground.P, rod.K) { rate: 0.3N/mm, free: 40mm };
    load push: thrust(ground.P, rod.K) = 25N;
    scene check: verify;
}

#[test]
fn far_from_the_origin_the_general_solution_agrees_too() {
    for step in -20..20 {
        let agreement = far::check_at(0.3 * f64::from(step)).unwrap();
        assert!(agreement.general < 1e-14 && agreement.virtual_work < 1e-14, "{step}: {agreement:?}");
    }
}
