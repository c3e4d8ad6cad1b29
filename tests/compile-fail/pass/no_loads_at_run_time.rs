//! Where all loads are constant there are no `Loads`, and the name is free.

use linkage_runtime::{Error, linkage};

linkage! {
    mod press;
    units { mm, kN }

    ground      { O: (0, 0) }
    link crank  { O -> A: 30mm }
    link rod    { A -> B: 100mm }
    link piston { B }
    mass piston: 2kg at B;

    revolute  O: ground -> crank;
    revolute  A: crank -> rod;
    revolute  B: rod -> piston;
    prismatic S: ground.O -> piston.B along 90deg;

    drive theta: O;
    assemble B: ahead(A);
    load P: force(piston.B) = 4kN @ -90deg;
    load W: gravity = (0, -9.81m/s^2);
    scene statics: equilibrium;
    scene parts:   superposition;
    scene work:    virtual_work;
    scene place:   position -> (B, rod.angle);
}

struct Loads;

fn main() -> Result<(), Error> {
    use press::*;
    let Loads = Loads;
    let pose = Pose::at(1.0)?;
    let all = pose.statics()?;
    assert!((all.effort_theta - pose.parts()?.total()?.effort_theta).abs() < 1e-9);
    assert!((all.effort_theta - work_at(1.0)?.effort_theta).abs() < 1e-9);
    assert!((statics_at(1.0)?.S.normal - all.S.normal).abs() < 1e-9);
    assert!(place_at(1.0)?.rod_angle.abs() < 4.0);
    Ok(())
}
