//! Several groups that are placed by iteration in one linkage, and links that share the direction of one of theirs.

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// Two triads, the second hung on the first one's plate; a block on a slide of that plate, declared before it; and a link welded to the
    /// second triad's plate, declared before it too.
    mod hung;

    units { mm, N }

    ground      { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm), Z: (100mm, 300mm), K: (690mm, 150mm), L: (370mm, 540mm) }
    link block  { H: (0, 0) }
    link flag   { V: (0, 0), W: (40mm, 90mm) }
    link crank  { O -> A: 28mm }
    link rod    { A -> E: 230mm }
    link plate  { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm), G: (50mm, 0) }
    link upper  { Q -> C: 192mm }
    link lower  { P -> D: 180mm }
    link rest   { H -> Z: 260mm }
    link rod2   { G -> U: 273mm }
    link plate2 { U: (0, 0), V: (100mm, 70mm), T: (-60mm, 60mm) }
    link upper2 { K -> V2: 163mm }
    link lower2 { L -> T: 268mm }

    revolute O: ground -> crank;
    revolute A: crank  -> rod;
    revolute E: rod    -> plate;
    revolute C: plate  -> upper;
    revolute D: plate  -> lower;
    revolute Q: ground -> upper;
    revolute P: ground -> lower;
    prismatic S: plate.G -> block.H along 0deg of plate;
    revolute H: block -> rest;
    revolute Z: rest -> ground;
    revolute G: plate -> rod2;
    revolute U: rod2 -> plate2;
    revolute V: plate2.V -> upper2.V2;
    revolute T: plate2 -> lower2;
    revolute K: ground -> upper2;
    revolute L: ground -> lower2;
    weld N: plate2.V -> flag.V;

    drive theta: O;
    unknown T12: torque(ground -> crank);
    assemble H: ahead(Z);

    start theta:  30deg;
    start rod:    (30mm, 20mm), angle 30deg;
    start plate:  (240mm, 140mm), angle 0;
    start upper:  (500mm, 100mm), angle 140deg;
    start lower:  (400mm, -100mm), angle 120deg;
    start rod2:   (271mm, 126mm), angle 22deg;
    start plate2: (524mm, 229mm), angle 0;
    start upper2: (690mm, 150mm), angle 114deg;
    start lower2: (370mm, 540mm), angle -69deg;

    load F: force(flag.W);
    load R: force(rest.H);

    scene statics: equilibrium;
    scene work:    virtual_work -> (T12);
}

#[test]
fn groups_that_hang_on_each_other() -> Result<(), Error> {
    let loads = hung::Loads { F: Vector2::new(-180.0, 60.0), R: Vector2::new(25.0, -140.0) };
    let start = hung::Pose::at(30f64.to_radians())?;
    let mut pose = start;
    for degrees in 30..=390 {
        let theta = f64::from(degrees).to_radians();
        let before = pose;
        pose = pose.moved_to(theta)?;
        let (held, work) = (pose.statics(&loads)?, pose.work(&loads)?);
        let size = held.T12.abs().max(28.0 * held.A.norm());
        assert!((held.T12 - work.T12).abs() <= 1e-11 * size, "{degrees}°: {} and {}", held.T12, work.T12);
        // All in balance with the ground.
        let sum = loads.F + loads.R + held.O + held.Q + held.P - held.Z + held.K + held.L;
        assert!(sum.norm() <= 1e-10 * held.A.norm().max(300.0), "{degrees}°: {sum}");
        // Links that are held at one angle, and pins that close.
        assert_eq!(pose.block_direction(), pose.plate_direction());
        assert_eq!(pose.flag_direction(), pose.plate2_direction());
        assert!((pose.plate2_V() - pose.upper2_V2()).norm() < 1e-11 && (pose.plate_G() - pose.rod2_G()).norm() < 1e-11);
        // It has moved like a linkage, not leapt.
        assert!((pose.flag_W() - before.flag_W()).norm() < 5.0, "{degrees}°");
    }
    assert!((pose.flag_W() - start.flag_W()).norm() < 1e-9);
    Ok(())
}

linkage! {
    /// Two links, each in three slots, side by side on one crank.
    mod beside;

    units { mm, N }

    ground     { O: (0, 0), X: (0, 200mm), Y: (300mm, 0), Z: (300mm, 300mm) }
    link crank { O -> A: 40mm, B: (10mm, 30mm) }
    link p     { A: (0, 0), C: (60mm, 40mm), D: (80mm, -30mm) }
    link q     { A: (0, 0), C: (50mm, 20mm), D: (90mm, -50mm) }

    revolute O: ground -> crank;
    slot A1: crank.A -> p.A along 70deg of crank;
    slot C1: ground.X -> p.C along 10deg;
    slot D1: p.D -> ground.Y along 100deg of p;
    slot A2: crank.A -> q.A along 70deg of crank;
    slot C2: ground.X -> q.C along 10deg;
    slot D2: q.D -> ground.Z along 100deg of q;

    drive t: O;
    unknown T: torque(ground -> crank);
    start t: 0;
    start p: (40mm, 160mm), angle 0;
    start q: (40mm, 180mm), angle 0;

    load F: force(p.C);
    load G: force(q.D);

    scene statics: equilibrium;
    scene work:    virtual_work -> (T);
}

#[test]
fn groups_beside_each_other() -> Result<(), Error> {
    let loads = beside::Loads { F: Vector2::new(20.0, 7.0), G: Vector2::new(-5.0, 31.0) };
    let mut pose = beside::Pose::at(0.0)?;
    for step in 1..=60 {
        pose = pose.moved_to(0.02 * f64::from(step))?;
        let (held, work) = (pose.statics(&loads)?.T, pose.work(&loads)?.T);
        assert!((held - work).abs() <= 1e-10 * held.abs().max(1000.0), "{step}: {held} and {work}");
    }
    Ok(())
}
