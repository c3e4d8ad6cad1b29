//! Closures that are arguments: the same numbers, to the bit, as with the side in the declaration.

use linkage_runtime::{Along, Error, Side, Vector2, linkage};

macro_rules! machines {
    ($($name:ident: $rocker:tt, $ram:tt, $cylinder:tt, $lever:tt, $shoe:tt;)*) => {$(
        linkage! {
            mod $name;
            ground        { O: (0, 0), Q: (3m, 0.5m), G: (0, -1m), P: (-2m, 0.3m), R: (0.2m, 2.5m), S: (0, 3m) }
            link crank    { O -> A: 1m, T: (0.4m, 0.3m) }
            link coupler  { A -> B: 3m, C: (1m, 0.4m) }
            link rocker   { Q -> B: 2.5m, D: (1m, 0.2m) }
            link rod      { D -> E: 4m }
            link ram      { E }
            link tube     { P: (0.1m, 0.2m) }
            link piston   { K: (0, 0) }
            link lever    { R: (0.1m, 0), L: (0.5m, 0.2m) }
            link shoe     { U -> V: 6m }
            revolute O: ground -> crank;
            revolute A: crank -> coupler;
            revolute B: coupler -> rocker;
            revolute Q: ground -> rocker;
            revolute D: rocker -> rod;
            revolute E: rod -> ram;
            prismatic G: ground -> ram.E along 10deg;
            revolute P: ground -> tube;
            prismatic H: tube.P -> piston.K along 0deg of tube;
            revolute K: piston.K -> coupler.C;
            revolute R: ground -> lever;
            slot L: lever -> crank.T along 5deg of lever;
            revolute U: coupler.C -> shoe.U;
            slot V: shoe.V -> ground.S along 20deg;
            drive q: O;
            assemble B: $rocker(A -> Q);
            assemble E: $ram(D);
            assemble H: $cylinder(P);
            assemble L: $lever(R);
            assemble V: $shoe(U);
            load F: force(ram.E);
            load J: force(piston.K) = (3N, 1N);
            load M: moment(lever) = 2N*m;
            load N: force(shoe.V) = (1N, 1N);
            scene statics: equilibrium;
            scene torque: virtual_work -> (effort_q);
            scene places: position;
        }
    )*};
}

machines! {
    chosen: either, either, either, either, either;
    first:  left, ahead, ahead, ahead, ahead;
    second: right, behind, behind, behind, behind;
    third:  left, behind, ahead, behind, ahead;
}

/// The same as text: the types of two modules differ.
macro_rules! same {
    ($other:ident, $closures:expr) => {
        for step in 0..20 {
            let q = f64::from(step) * 0.3;
            let loads = Vector2::new(5.0, -7.0);
            let chosen = chosen::Pose::at(q, $closures).and_then(|pose| {
                let (loads, at) = (chosen::Loads { F: loads }, chosen::places_at(q, $closures)?);
                let statics = (pose.statics(&loads)?, chosen::statics_at(q, $closures, &loads)?);
                Ok(format!(
                    "{statics:?} {:?} {:?} {at:?}",
                    pose.torque(&loads)?,
                    chosen::torque_at(q, $closures, &loads)?
                ))
            });
            let fixed = $other::Pose::at(q).and_then(|pose| {
                let (loads, at) = ($other::Loads { F: loads }, $other::places_at(q)?);
                let statics = (pose.statics(&loads)?, $other::statics_at(q, &loads)?);
                Ok(format!("{statics:?} {:?} {:?} {at:?}", pose.torque(&loads)?, $other::torque_at(q, &loads)?))
            });
            assert_eq!(chosen, fixed);
            assert!(chosen.is_ok(), "{chosen:?}");
        }
    };
}

#[test]
fn a_side_at_run_time_gives_the_same_bits_as_one_in_the_declaration() {
    use Along::{Ahead, Behind};
    same!(first, chosen::Closures { B: Side::Left, E: Ahead, H: Ahead, L: Ahead, V: Ahead });
    same!(second, chosen::Closures { B: Side::Right, E: Behind, H: Behind, L: Behind, V: Behind });
    same!(third, chosen::Closures { B: Side::Left, E: Behind, H: Ahead, L: Behind, V: Ahead });
}

#[test]
fn a_pose_keeps_its_side_along_a_motion() -> Result<(), Error> {
    let closures =
        chosen::Closures { B: Side::Left, E: Along::Ahead, H: Along::Behind, L: Along::Ahead, V: Along::Ahead };
    for step in 0..100 {
        let pose = chosen::Pose::at(f64::from(step) * 0.1, closures)?;
        let (from, to, at) = (pose.A(), pose.Q(), pose.B());
        assert!((to - from).perp(&(at - from)) > 0.0);
    }
    Ok(())
}

linkage! {
    /// The same side smooth through its folds, from either side.
    mod folding;
    param k: number = 1;
    ground       { O: (0, 0), Q: (3m, 0) }
    link crank   { O -> A: 1m }
    link coupler { A -> B: 3m }
    link rocker  { Q -> B: 1m }
    revolute O: ground -> crank;
    revolute A: crank -> coupler;
    revolute B: coupler -> rocker;
    revolute Q: ground -> rocker;
    drive q: O;
    assemble B: either(A -> Q) smooth at 60deg;
    load M: moment(rocker) = 1N*m * k;
    scene places: position -> (B);
    scene statics: equilibrium;
}

#[test]
fn a_smooth_motion_may_start_on_either_side() -> Result<(), Error> {
    let linkage = folding::Linkage::new(&folding::Params { k: 1.0 })?;
    for (side, x) in [(Side::Left, 1.0), (Side::Right, -1.0)] {
        let mut before = folding::places_at(&linkage, 0.05, folding::Closures { B: side })?.B;
        for step in 1..126 {
            let q = 0.05 + f64::from(step) * 0.05;
            let now = folding::places_at(&linkage, q, folding::Closures { B: side })?.B;
            // Nowhere does it jump to the other side.
            assert!((now - before).norm() < 0.2, "{x} {q}");
            before = now;
        }
    }
    Ok(())
}

linkage! {
    /// A triad that is placed by iteration, behind a dyad whose side is an argument.
    mod behind;
    ground     { O: (0, 0), Q: (5m, 1m), R: (2m, -2m) }
    link crank { O -> A: 1m }
    link e     { A -> H: 2m }
    link f     { R -> H: 2m, P: (1.745m, -1.398m) }
    link b     { A -> E: 1.95m, G: (1m, 1m) }
    link t     { E: (0, 0), C: (1m, 0.7m), D: (0.7m, -0.9m) }
    link c     { Q -> C: 1.92m }
    link d     { D: (0.2m, 0.1m), P: (1.8m, 0.6m) }
    revolute O: ground -> crank;
    revolute Ae: crank.A -> e.A;
    revolute H: e -> f;
    revolute R: ground -> f;
    revolute Ab: crank.A -> b.A;
    revolute E: t -> b;
    revolute C: t -> c;
    revolute D: d -> t;
    revolute Q: ground -> c;
    revolute P: d -> f;
    drive q: O;
    assemble H: either(Ae -> R);
    start q: 0.4rad;
    start b: (1m, 0.4m), angle 36deg;
    start t: (2.5m, 1.5m), angle 0;
    start c: (5m, 1m), angle 140deg;
    start d: (3m, 0.6m), angle -80deg;
    load F: force(b.G) = (3N, -2N);
    scene statics: equilibrium;
    scene work: virtual_work;
    scene places: position -> (C, P, c.C, f.P);
}

#[test]
fn a_group_behind_a_chosen_side_is_searched_from_its_start() -> Result<(), Error> {
    let closures = behind::Closures { H: Side::Left };
    let mut pose = behind::Pose::at(0.4, closures)?;
    for step in 0..20 {
        let q = 0.4 + f64::from(step) * 0.02;
        // A pose that is moved keeps its side.
        pose = pose.moved_to(q)?;
        let direct = behind::Pose::at(q, closures)?;
        assert!((pose.H() - direct.H()).norm() < 1e-13 && (pose.C() - direct.C()).norm() < 1e-12);
        assert!((pose.c_C() - pose.t_C()).norm() < 1e-12 && (pose.f_P() - pose.d_P()).norm() < 1e-12);
        let (held, work) = (pose.statics()?, behind::work_at(q, closures)?);
        assert!((held.effort_q - work.effort_q).abs() < 1e-11);
    }
    // On the other side of the dyad the triad may be out of reach: never a wrong pose.
    match behind::Pose::at(0.4, behind::Closures { H: Side::Right }) {
        Ok(pose) => assert!((pose.c_C() - pose.t_C()).norm() < 1e-12 && (pose.f_P() - pose.d_P()).norm() < 1e-12),
        Err(error) => assert!(matches!(error, Error::NoConvergence { .. }), "{error}"),
    }
    Ok(())
}

linkage! {
    /// A triad of which one length is known only at run time.
    mod given;
    units { mm, N }
    param reach: length;
    ground     { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm) }
    link crank { O -> A: 28mm }
    link rod   { A -> E: 230mm }
    link plate { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm) }
    link upper { Q -> C: reach }
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
    scene places: position -> (C, upper.C);
}

/// What no compiler can know is checked when it is known, before any pose is asked for.
#[test]
fn a_start_from_which_given_lengths_do_not_close_is_an_error() -> Result<(), Error> {
    let linkage = given::Linkage::new(&given::Params { reach: 192.0 })?;
    let places = given::places_at(&linkage, 0.9)?;
    assert!((places.C - places.upper_C).norm() < 1e-9);
    for reach in [5.0, 2000.0] {
        let refused = given::Linkage::new(&given::Params { reach });
        assert!(
            matches!(refused, Err(Error::NoConvergence { group: "rod + plate + upper + lower", gap }) if gap > 0.0),
            "{refused:?}"
        );
    }
    assert!(matches!(given::Linkage::new(&given::Params { reach: f64::NAN }), Err(Error::NotFinite { .. })));
    Ok(())
}
