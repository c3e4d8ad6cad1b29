//! A Watt six-bar with the weights of all its links and two loads.
//!
//! `cargo run --example six_bar` prints the torque on the crank over its working stroke, what each weight contributes to it, and the
//! forces in the joints of the second dyad.

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// A crank-rocker whose rocker drives a second dyad.
    pub mod six_bar;

    units { mm, N }

    ground       { A0: (0, 0), B0: (300mm, -40mm), D0: (620mm, 60mm) }
    link crank   { A0 -> A: 90mm }
    link coupler { A -> B: 280mm, G: (140mm, 20mm) }
    link rocker  { B0 -> B: 200mm, C: left(B0 -> B, 160mm, 90mm) }
    link rod     { C -> D: 320mm }
    link output  { D0 -> D: 170mm, P: (120mm, 15mm) }

    mass crank:   1.2kg at (30mm, 0);
    mass coupler: 0.9kg at G, inertia 5200kg*mm^2;
    mass rocker:  1.1kg at (100mm, 20mm);
    mass rod:     0.6kg at (130mm, 0);
    mass output:  1.4kg at (80mm, 0);

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    revolute C:  rocker  -> rod;
    revolute D:  rod     -> output;
    revolute D0: ground  -> output;

    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);
    assemble D: left(C -> D0);

    load W: gravity = 9.80665m/s^2 @ -90deg;
    load F: force(output.P);
    load M: moment(coupler) = -4N*m;

    scene statics: equilibrium;
    scene parts:   superposition -> (T12);
    scene torque:  virtual_work -> (T12);
    scene second:  equilibrium -> (C, D, D0);
}

fn main() -> Result<(), Error> {
    let loads = six_bar::Loads { F: Vector2::new(-180.0, 60.0) };
    println!("Torque on the crank (N·m), and what contributes to it");
    println!(
        "{:>5} {:>9} | {:>8} {:>8} {:>8} {:>8} {:>8} | {:>8} {:>8} | {:>8} {:>8}",
        "θ (°)", "torque", "crank", "coupler", "rocker", "rod", "output", "F", "M", "|C| (N)", "|D| (N)"
    );
    for degrees in (0..360).step_by(30) {
        let pose = six_bar::Pose::at(f64::from(degrees).to_radians())?;
        let torque = pose.torque(&loads)?.T12;
        let parts = pose.parts(&loads)?;
        let second = pose.second(&loads)?;
        let metres = |contribution: six_bar::PartsContribution| contribution.T12 / 1000.0;
        println!(
            "{degrees:>5} {:>9.4} | {:>8.4} {:>8.4} {:>8.4} {:>8.4} {:>8.4} | {:>8.4} {:>8.4} | {:>8.2} {:>8.2}",
            torque / 1000.0,
            metres(parts.W.crank),
            metres(parts.W.coupler),
            metres(parts.W.rocker),
            metres(parts.W.rod),
            metres(parts.W.output),
            metres(parts.F),
            metres(parts.M),
            second.C.norm(),
            second.D.norm(),
        );
        let sum = metres(parts.total()?);
        assert!((sum - torque / 1000.0).abs() < 1e-9, "the parts do not add up");
    }
    Ok(())
}
