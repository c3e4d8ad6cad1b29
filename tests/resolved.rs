//! Reactions resolved along links, couples about points, and an unknown thrust: each against the plain results.

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// A boom that a cylinder lifts, of which only the thrust matters, and a slider behind it.
    mod lift;
    units { mm, N }
    ground      { O: (0, 0), C: (300mm, -100mm), S: (0, 900mm), K: (50mm, 20mm) }
    link boom   { O -> B: 800mm, Q: (400mm, 50mm) }
    link rod    { B -> D: 600mm, Z: (100mm, 30mm) }
    link slider { D, S: (20mm, -40mm), T: (70mm, 10mm) }
    mass boom: 12kg at (350mm, 20mm);
    revolute O: ground -> boom;
    revolute B: boom -> rod;
    revolute D: slider -> rod;
    prismatic S: slider -> ground along 10deg, angle -10deg;
    drive theta: O;
    unknown P: thrust(ground.C, boom.Q);
    assemble D: ahead(B);
    load F: force(slider.T);
    load G: force(rod.Z);
    load W: gravity = 9.81m/s^2 @ -90deg;
    scene all: equilibrium;
    scene resolved: equilibrium -> (B along boom, B along rod, D along ground, S along rod, S about ground.K, S about slider.T);
    scene parts: superposition -> (P, B along rod, S about ground.K);
    scene work: virtual_work;
    scene check: verify;
    scene places: position -> (D, S, slider.T);
}

const LOADS: lift::Loads = lift::Loads { F: Vector2::new(-300.0, 120.0), G: Vector2::new(40.0, -70.0) };

fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

#[test]
fn resolved_forces_and_couples_are_those_of_the_plain_reactions() -> Result<(), Error> {
    for theta in [0.7, 0.9, 1.3] {
        let pose = lift::Pose::at(theta)?;
        let (all, resolved, places) = (pose.all(&LOADS)?, pose.resolved(&LOADS)?, pose.places()?);
        let along = [
            (resolved.B_along_boom, all.B, pose.boom_direction()),
            (resolved.B_along_rod, all.B, pose.rod_direction()),
            (resolved.D_along_ground, all.D, Vector2::new(1.0, 0.0)),
            (resolved.S_along_rod, all.S.force, pose.rod_direction()),
        ];
        for (resolved, force, direction) in along {
            assert!((resolved.axial - force.dot(&direction)).abs() < 1e-11);
            assert!((resolved.transverse - cross(direction, force)).abs() < 1e-11);
        }
        let about = |place: Vector2<f64>| all.S.couple + cross(places.S - place, all.S.force);
        assert!((resolved.S_about_ground_K - about(Vector2::new(50.0, 20.0))).abs() < 1e-8);
        assert!((resolved.S_about_slider_T - about(places.slider_T)).abs() < 1e-8);
        let total = pose.parts(&LOADS)?.total()?;
        assert!((total.B_along_rod.axial - resolved.B_along_rod.axial).abs() < 1e-11);
        assert!((total.S_about_ground_K - resolved.S_about_ground_K).abs() < 1e-8);
        assert!((total.P - all.P).abs() < 1e-11);
    }
    Ok(())
}

#[test]
fn all_ways_to_a_thrust_agree() -> Result<(), Error> {
    for theta in [0.7, 0.9, 1.3] {
        let agreement = lift::check_at(theta, &LOADS)?;
        assert!(agreement.general < 1e-13 && agreement.superposition < 1e-13 && agreement.virtual_work < 1e-13);
        let work = lift::work_at(theta, &LOADS)?;
        assert!((work.P + work.F.work + work.G.work + work.W.boom.work).abs() < 1e-10);
        // The rate is that of the distance of its points.
        let step = 1e-6;
        let at = |theta: f64| lift::Pose::at(theta).map(|pose| (pose.boom_Q() - Vector2::new(300.0, -100.0)).norm());
        let lengthening = (at(theta + step)? - at(theta - step)?) / (2.0 * step);
        let rising = |theta: f64| lift::Pose::at(theta).map(|pose| pose.rod_Z().dot(&LOADS.G.normalize()));
        let rising = (rising(theta + step)? - rising(theta - step)?) / (2.0 * step);
        assert!((work.G.velocity - rising / lengthening).abs() < 1e-6);
    }
    Ok(())
}

linkage! {
    /// A lever whose cylinder can come into line with its pin, and be as short as nothing.
    mod lever;
    units { mm, N }
    scalar f32;
    ground     { O: (0, 0), C: (200mm, 0) }
    link lever { O -> Q: 200mm }
    revolute O: ground -> lever;
    drive theta: O;
    unknown P: thrust(lever.Q, ground.C);
    load M: moment(lever);
    scene held: equilibrium;
    scene work: virtual_work;
}

#[test]
fn without_a_lever_arm_or_a_direction_a_thrust_is_an_error() -> Result<(), Error> {
    let loads = lever::Loads { M: 400.0 };
    assert!((lever::held_at(core::f32::consts::FRAC_PI_2, &loads)?.P + 400.0 / (200.0 * 0.5f32.sqrt())).abs() < 1e-4);
    for outcome in [lever::held_at(0.0, &loads).err(), lever::work_at(0.0, &loads).err()] {
        assert!(matches!(outcome, Some(Error::CoincidentEnds { of: "P" } | Error::DeadCentre { .. })), "{outcome:?}");
    }
    let outcome = lever::held_at(core::f32::consts::PI, &loads);
    assert!(matches!(outcome, Err(Error::DeadCentre { group: "lever", pivot: "arm_P" })), "{outcome:?}");
    Ok(())
}

linkage! {
    /// A bracket that is welded to an arm.
    mod bracket;
    units { mm, N }
    ground       { O: (0, 0) }
    link arm     { O -> W: 300mm, N: (100mm, -50mm) }
    link bracket { W, T: (80mm, 20mm) }
    revolute O: ground -> arm;
    weld W: arm -> bracket, angle 30deg;
    drive theta: O;
    load F: force(bracket.T);
    scene held: equilibrium -> (W, W along bracket, W about arm.N, W about arm.W);
    scene place: position -> (W);
}

#[test]
fn a_weld_has_a_couple_about_any_point() -> Result<(), Error> {
    let pose = bracket::Pose::at(0.7)?;
    let held = pose.held(&bracket::Loads { F: Vector2::new(30.0, -200.0) })?;
    assert_eq!(held.W_about_arm_W.to_bits(), held.W.couple.to_bits());
    let about = held.W.couple + cross(pose.place()?.W - pose.arm_N(), held.W.force);
    assert!((held.W_about_arm_N - about).abs() < 1e-9);
    assert!((held.W_along_bracket.axial - held.W.force.dot(&pose.bracket_direction())).abs() < 1e-11);
    Ok(())
}
