//! A single-cylinder engine at rest: which torque on the crankshaft holds the gas force on its piston and the weight of its parts?
//!
//! `cargo run --example slider_crank` prints, over half a turn from the upper dead centre, the piston's place, the torque, the forces in
//! the bearings and the side force on the cylinder wall.
//!
//! `tests/pinned.rs` holds the emitted code, its equations, its operations and its numbers against snapshots.

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// Crank, connecting rod and piston of an upright engine; the piston pin is offset from the crankshaft's axis by 1 mm.
    pub mod engine;

    units { mm, N }

    ground      { O: (0, 0), G: (1mm, 0) }
    link crank  { O -> A: 42mm }
    link rod    { A -> B: 142mm }
    link piston { B, G: (0, 0), crown: (30mm, 0) }

    mass crank:  3.2kg at (9mm, 0), inertia 5600kg*mm^2;
    mass rod:    0.62kg at (45mm, 0), inertia 1900kg*mm^2;
    mass piston: 0.48kg at (12mm, 0);

    revolute O:  ground -> crank;
    revolute A:  crank  -> rod;
    revolute B:  rod    -> piston;
    prismatic G: ground -> piston along 90deg, angle 90deg;

    drive theta: O;
    unknown T: torque(ground -> crank);
    assemble B: ahead(A);

    load gas: force(piston.crown);
    load W: gravity = 9.80665m/s^2 @ -90deg;

    scene hold:    equilibrium;
    scene weights: superposition(W) -> (T);
    scene torque:  virtual_work -> (T);

    emit source;
}

fn main() -> Result<(), Error> {
    let loads = engine::Loads { gas: Vector2::new(0.0, -4000.0) };
    println!("Gas force 4000 N downwards; crank angle from the upper dead centre");
    println!(
        "{:>6} {:>11} {:>11} {:>11} {:>11} {:>11} {:>13}",
        "angle", "pin height", "torque", "bearing A", "pin B", "wall", "by weights"
    );
    println!("{:>6} {:>11} {:>11} {:>11} {:>11} {:>11} {:>13}", "°", "mm", "N·m", "N", "N", "N", "N·m");
    for degrees in (0..=180).step_by(15) {
        let theta = (90.0 - f64::from(degrees)).to_radians();
        let pose = engine::Pose::at(theta)?;
        let held = pose.hold(&loads)?;
        let weights = pose.weights()?.total()?;
        println!(
            "{degrees:>6} {:>11.3} {:>11.3} {:>11.1} {:>11.1} {:>11.1} {:>13.4}",
            pose.B().y,
            held.T / 1000.0,
            held.A.norm(),
            held.B.norm(),
            held.G.normal,
            weights.T / 1000.0,
        );
        let torque = engine::torque_at(theta, &loads)?.T;
        assert!((torque - held.T).abs() < 1e-9 * 4000.0 * 42.0, "virtual work disagrees with equilibrium");
    }
    println!("\n{}", engine::OPERATIONS);
    Ok(())
}
