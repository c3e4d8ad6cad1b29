//! A four-bar with a force on each of its moving links, solved by superposition.
//!
//! `cargo run --example three_loads` prints the three partial torques and their sum. The force on the crank reaches the ground through
//! the crank's own bearing: to every other joint its contribution is zero by structure, and no code is emitted for it.

use linkage_runtime::{Error, linkage, polar};

linkage! {
    /// The four-bar of METU Example 6.3 with one more force, on its crank.
    pub mod three_loads;

    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm, E: (40mm, 15mm) }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F12: force(crank.E);
    load F13: force(coupler.C);
    load F14: force(rocker.D);

    scene parts:  superposition;
    scene whole:  equilibrium;
    scene torque: virtual_work -> (T12);
}

fn main() -> Result<(), Error> {
    let degrees = |angle: f64| angle.to_radians();
    let loads = three_loads::Loads {
        F12: polar(30.0, degrees(300.0)),
        F13: polar(50.0, degrees(230.0)),
        F14: polar(100.0, degrees(200.0)),
    };
    let pose = three_loads::Pose::at(degrees(60.0))?;
    let parts = pose.parts(&loads)?;
    let (sum, whole) = (parts.total()?, pose.whole(&loads)?);

    println!("{:<22}{:>12}{:>12}{:>12}{:>14}{:>12}", "", "F12 alone", "F13 alone", "F14 alone", "sum", "together");
    let row = |name: &str, values: [f64; 5]| {
        print!("{name:<22}");
        values.iter().for_each(|value| print!("{value:>12.4}"));
        println!();
    };
    row("torque T12 (N·mm)", [parts.F12.T12, parts.F13.T12, parts.F14.T12, sum.T12, whole.T12]);
    row("A0 x (N)", [parts.F12.A0.x, parts.F13.A0.x, parts.F14.A0.x, sum.A0.x, whole.A0.x]);
    row("A0 y (N)", [parts.F12.A0.y, parts.F13.A0.y, parts.F14.A0.y, sum.A0.y, whole.A0.y]);
    row("A x (N)", [parts.F12.A.x, parts.F13.A.x, parts.F14.A.x, sum.A.x, whole.A.x]);
    row("A y (N)", [parts.F12.A.y, parts.F13.A.y, parts.F14.A.y, sum.A.y, whole.A.y]);
    row("B x (N)", [parts.F12.B.x, parts.F13.B.x, parts.F14.B.x, sum.B.x, whole.B.x]);
    row("B y (N)", [parts.F12.B.y, parts.F13.B.y, parts.F14.B.y, sum.B.y, whole.B.y]);
    row("B0 x (N)", [parts.F12.B0.x, parts.F13.B0.x, parts.F14.B0.x, sum.B0.x, whole.B0.x]);
    row("B0 y (N)", [parts.F12.B0.y, parts.F13.B0.y, parts.F14.B0.y, sum.B0.y, whole.B0.y]);

    println!("\ntorque by virtual work: {:.4} N·mm", pose.torque(&loads)?.T12);
    Ok(())
}
