//! Linkages in motion as a user has them: the textbooks' formulas, declared speeds, normal and tangential parts, lines of inertia, poses
//! where motion or forces alone are singular.

use linkage_runtime::{Error, Vector2, linkage};

const CRANK: f64 = 0.04;
const ROD: f64 = 0.14;
const SPEED: f64 = 100.0 * core::f64::consts::PI;

linkage! {
    /// An engine whose speed is given at run time.
    mod engine;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm, G: (-10mm, 0) }
    link rod    { A -> B: 140mm, C: (45mm, 0) }
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
    load Ip: inertia(piston);
    load W: gravity = 9.81m/s^2 @ -90deg;
    load D: spring(ground.O, rod.C) { damping: 300N*s/m };
    scene dynamics: equilibrium(I, W, D);
    scene by_piston: equilibrium(Ip) -> (effort_theta);
    scene parts: superposition(I) -> (effort_theta, O);
    scene work: virtual_work(I, D);
    scene speeds: velocity -> (B, rod.angle);
    scene accelerations: acceleration -> (B, rod.angle, inertia(rod), offset(rod));
    scene circling: acceleration -> (A along crank, A along path);
    scene check: verify;
}

linkage! {
    /// The same at a declared constant speed, in single precision.
    mod constant;
    scalar f32;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: 140mm }
    link piston { B }
    mass piston: 0.45kg at B;
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B along 0deg;
    drive theta: O { rate: 3000rpm, acceleration: 0 };
    assemble B: ahead(A);
    load I: inertia;
    scene dynamics: equilibrium -> (effort_theta);
    scene accelerations: acceleration -> (B);
}

/// Place, velocity and acceleration of the piston at a constant speed, and the angular velocity and acceleration of the rod.
fn textbook(theta: f64) -> [f64; 5] {
    let (s, c) = theta.sin_cos();
    let sine = -CRANK * s / ROD;
    let cosine = (1.0 - sine * sine).sqrt();
    let omega = -CRANK * SPEED * c / (ROD * cosine);
    let alpha = (CRANK * SPEED * SPEED * s + ROD * omega * omega * sine) / (ROD * cosine);
    let speed = -CRANK * SPEED * s - ROD * omega * sine;
    let acceleration = -CRANK * SPEED * SPEED * c - ROD * (alpha * sine + omega * omega * cosine);
    [CRANK * c + ROD * cosine, speed, acceleration, omega, alpha]
}

fn turns() -> impl Iterator<Item = f64> {
    (0..72).map(|step| 0.03 + f64::from(step) * core::f64::consts::TAU / 72.0)
}

fn steady() -> engine::Motion {
    engine::Motion { theta_rate: SPEED, theta_acceleration: 0.0 }
}

#[test]
#[allow(clippy::cast_possible_truncation, reason = "the angle is rounded for the linkage of single precision")]
fn a_piston_moves_as_the_textbook_has_it() -> Result<(), Error> {
    let motion = steady();
    for theta in turns() {
        let [place, speed, acceleration, omega, alpha] = textbook(theta);
        let pose = engine::Pose::at(theta)?;
        let (speeds, accelerations) = (pose.speeds(&motion)?, pose.accelerations(&motion)?);
        let near = |own: f64, other: f64, size: f64| assert!((own - other).abs() < 1e-12 * size, "{own} {other}");
        near(pose.B().x, place, 1.0);
        near(speeds.B.x, speed, SPEED * CRANK);
        near(speeds.rod_angle, omega, SPEED);
        near(accelerations.B.x, acceleration, SPEED * SPEED * CRANK);
        near(accelerations.rod_angle, alpha, SPEED * SPEED);
        // The torque that moves the piston alone brings the power that it takes.
        near(pose.by_piston(&motion)?.effort_theta * SPEED, 0.45 * acceleration * speed, 1e5);
        // Declared as a constant, in single precision.
        let torque = constant::dynamics_at(theta as f32)?.effort_theta;
        let size = 0.45 * SPEED * SPEED * CRANK * CRANK;
        assert!((f64::from(torque) - 0.45 * acceleration * speed / SPEED).abs() < 1e-5 * size, "{torque}");
        let own = constant::accelerations_at(theta as f32)?.B.x;
        assert!((f64::from(own) - acceleration).abs() < 1e-5 * SPEED * SPEED * CRANK, "{own} {acceleration}");
    }
    Ok(())
}

#[test]
fn all_ways_to_the_forces_agree() -> Result<(), Error> {
    let motion = engine::Motion { theta_rate: -40.0, theta_acceleration: 350.0 };
    for theta in turns() {
        let agreement = engine::check_at(theta, &motion)?;
        assert!(agreement.general < 1e-13 && agreement.superposition < 1e-13 && agreement.virtual_work < 1e-13);
        let pose = engine::Pose::at(theta)?;
        let (parts, work) = (pose.parts(&motion)?, pose.work(&motion)?);
        let sum = work.I.crank.work + work.I.rod.work + work.I.piston.work + work.D.work;
        assert!((sum + work.effort_theta).abs() < 1e-10 * sum.abs().max(1.0));
        let total = parts.total()?.effort_theta;
        assert!((total - parts.I.total()?.effort_theta).abs() < 1e-10 * total.abs().max(1.0));
        // A damper pulls the more, the faster it is stretched: it only takes.
        assert!(work.D.work * motion.theta_rate <= 0.0);
        assert!(pose.dynamics(&motion)?.O.norm() > 0.0);
    }
    Ok(())
}

#[test]
fn normal_and_tangential_parts() -> Result<(), Error> {
    for (rate, acceleration) in [(30.0, 200.0), (-30.0, 200.0), (-12.0, -7.0)] {
        let motion = engine::Motion { theta_rate: rate, theta_acceleration: acceleration };
        let circling = engine::circling_at(0.7, &motion)?;
        let near = |own: f64, other: f64| assert!((own - other).abs() < 1e-13, "{own} {other}");
        near(circling.A_along_crank.axial, -CRANK * rate * rate);
        near(circling.A_along_crank.transverse, CRANK * acceleration);
        near(circling.A_along_path.tangential, CRANK * acceleration * rate.signum());
        // Turning counter-clockwise, the centre lies to the left.
        near(circling.A_along_path.normal, CRANK * rate * rate * rate.signum());
    }
    // What rests has no path.
    let resting = engine::Motion { theta_rate: 0.0, theta_acceleration: 5.0 };
    assert!(matches!(engine::circling_at(0.7, &resting), Err(Error::NoDirection { of: "the velocity of A" })));
    let nothing = engine::Motion { theta_rate: f64::NAN, theta_acceleration: 5.0 };
    assert!(engine::circling_at(0.7, &nothing).is_err() && engine::speeds_at(0.7, &nothing).is_err());
    Ok(())
}

#[test]
fn a_single_force_stands_for_inertia_on_its_line() -> Result<(), Error> {
    let motion = engine::Motion { theta_rate: 25.0, theta_acceleration: -300.0 };
    for theta in turns() {
        let found = engine::accelerations_at(theta, &motion)?;
        let (inertia, line) = (found.rod_inertia, found.rod_offset);
        assert!((inertia.force + 0.62 * inertia.acceleration).norm() < 1e-12);
        assert!((inertia.couple + 1900e-6 * found.rod_angle).abs() < 1e-12);
        let moment = line.vector.x * inertia.force.y - line.vector.y * inertia.force.x;
        assert!((moment - inertia.couple).abs() < 1e-13 * inertia.couple.abs().max(1.0), "{moment}");
        // On the right of the acceleration where the rod turns faster and faster to the left.
        let right = Vector2::new(inertia.acceleration.y, -inertia.acceleration.x).normalize();
        assert!((line.vector - right * line.distance).norm() < 1e-13 && line.distance * found.rod_angle >= 0.0);
    }
    let resting = engine::Motion { theta_rate: 0.0, theta_acceleration: 0.0 };
    assert!(matches!(engine::accelerations_at(1.0, &resting), Err(Error::NoDirection { .. })));
    Ok(())
}

linkage! {
    /// A carriage with an arm: the arm's centre of mass may rest while the arm turns.
    mod carriage;
    ground        { O: (0, 0) }
    link carriage { E: (0, 0) }
    link arm      { E -> tip: 1m, G: (0.5m, 0) }
    mass carriage: 3kg at E;
    mass arm: 2kg at G, inertia 0.25kg*m^2;
    prismatic run: ground.O -> carriage.E along 0deg;
    revolute E: carriage -> arm;
    drive travel: run;
    drive turn: E;
    load I: inertia;
    scene dynamics: equilibrium -> (effort_travel, effort_turn, E);
    scene work: virtual_work -> (effort_travel, effort_turn);
    scene parts: superposition -> (effort_turn);
    scene inertia: acceleration -> (inertia(arm), arm.angle);
    scene line: acceleration -> (offset(arm));
}

#[test]
fn inertia_that_is_a_couple_alone_has_no_line() -> Result<(), Error> {
    // At a right angle to the slide: what the arm turns backwards at its middle, the carriage goes forwards.
    let motion = |forwards| carriage::Motion {
        travel_rate: 0.7,
        travel_acceleration: forwards,
        turn_rate: 0.0,
        turn_acceleration: 8.0,
    };
    let pose = carriage::Pose::at(0.3, core::f64::consts::FRAC_PI_2)?;
    let inertia = pose.inertia(&motion(4.0))?;
    assert!(inertia.arm_inertia.acceleration.norm() < 1e-15 && inertia.arm_inertia.force.norm() < 2e-15);
    assert_eq!([inertia.arm_angle, inertia.arm_inertia.couple].map(f64::to_bits), [8.0f64, -2.0].map(f64::to_bits));
    let of = "the acceleration of the centre of mass of arm";
    assert_eq!(pose.line(&motion(4.0)), Err(Error::NoDirection { of }));
    assert_eq!(carriage::line_at(0.3, core::f64::consts::FRAC_PI_2, &motion(4.0)), Err(Error::NoDirection { of }));
    let forces = pose.dynamics(&motion(4.0))?;
    assert!((forces.effort_turn - 2.0).abs() < 1e-15 && (forces.effort_travel - 12.0).abs() < 1e-14);
    assert!(forces.E.norm() < 2e-15, "{:?}", forces.E);
    let work = pose.work(&motion(4.0))?;
    assert!((work.effort_turn - 2.0).abs() < 1e-15 && (work.effort_travel - 12.0).abs() < 1e-14);
    let parts = pose.parts(&motion(4.0))?;
    assert!((parts.I.arm.effort_turn - 2.0).abs() < 1e-15 && parts.I.carriage.effort_turn.abs() < 1e-300);
    // A little off, and there is a line, far away.
    let line = pose.line(&motion(4.001))?.arm_offset;
    assert!((line.distance - 0.25 * 8.0 / (2.0 * 0.001)).abs() < 1e-9, "{line:?}");
    Ok(())
}

linkage! {
    /// A press driven at its slide and held at its crank.
    mod press;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: 140mm }
    link piston { B }
    mass crank: 2kg at (20mm, 0), inertia 900kg*mm^2;
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B along 0deg;
    drive x: S;
    unknown M: torque(ground -> crank);
    assemble A: left(O -> B);
    load F: force(piston.B) = (-100N, 0);
    load I: inertia;
    scene statics: equilibrium(F);
    scene dynamics: equilibrium(F, I);
    scene speeds: velocity -> (crank.angle);
}

linkage! {
    /// The same, driven at its crank and held at its slide.
    mod held;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: 140mm }
    link piston { B }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B along 0deg;
    drive theta: O;
    unknown F: force(piston.B) along 0deg;
    assemble B: ahead(A);
    load M: moment(crank) = 2N*m;
    scene statics: equilibrium;
    scene speeds: velocity -> (B, rod.angle);
}

#[test]
fn motion_and_forces_have_dead_centres_of_their_own() -> Result<(), Error> {
    let motion = press::Motion { x_rate: 0.5, x_acceleration: 0.0 };
    // Stretched: no rate of the slide moves the crank on, but the crank's torque holds the slide.
    let stretched = CRANK + ROD;
    assert!(press::statics_at(stretched)?.M.abs() < 1e-9);
    assert!(matches!(press::speeds_at(stretched, &motion), Err(Error::DeadCentre { .. })));
    assert!(matches!(press::dynamics_at(stretched, &motion), Err(Error::DeadCentre { .. })));
    let inside = press::speeds_at(0.15, &motion)?.crank_angle;
    let before = press::Pose::at(0.15 - 1e-7)?.crank_direction();
    let behind = press::Pose::at(0.15 + 1e-7)?.crank_direction();
    let turned = before.x * behind.y - before.y * behind.x;
    assert!((turned / 2e-7 * 0.5 - inside).abs() < 1e-6 * inside.abs(), "{inside}");
    // The other way round: the crank carries the slide through its dead centre, where no force on the slide holds the crank.
    let motion = held::Motion { theta_rate: 10.0 };
    assert!(matches!(held::statics_at(0.0), Err(Error::DeadCentre { .. })));
    let speeds = held::speeds_at(0.0, &motion)?;
    assert!(speeds.B.norm() < 1e-15 && (speeds.rod_angle + 10.0 * CRANK / ROD).abs() < 1e-14);
    Ok(())
}
