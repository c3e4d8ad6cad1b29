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
                Ok(format!("{:?} {:?} {at:?}", pose.statics(&loads)?, chosen::statics_at(q, $closures, &loads)?))
            });
            let fixed = $other::Pose::at(q).and_then(|pose| {
                let (loads, at) = ($other::Loads { F: loads }, $other::places_at(q)?);
                Ok(format!("{:?} {:?} {at:?}", pose.statics(&loads)?, $other::statics_at(q, &loads)?))
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
