//! A Stephenson six-bar: its floating plate hangs on three links, so that no dyad can be split off.
//!
//! `cargo run --example stephenson` follows it by degrees over a turn, each pose from the one before, and prints the torque on the crank
//! and the force between rod and plate.

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// Stephenson III: a triad, driven by a crank. Its links are placed together, by iteration from a starting pose.
    pub mod stephenson;

    units { mm, N }

    ground     { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm) }
    link crank { O -> A: 28mm }
    link rod   { A -> E: 230mm }
    link plate { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm), G: (50mm, 0) }
    link upper { Q -> C: 192mm }
    link lower { P -> D: 180mm }

    revolute O: ground -> crank;
    revolute A: crank  -> rod;
    revolute E: rod    -> plate;
    revolute C: plate  -> upper;
    revolute D: plate  -> lower;
    revolute Q: ground -> upper;
    revolute P: ground -> lower;

    drive theta: O;
    unknown T12: torque(ground -> crank);

    start theta: 30deg;
    start rod:   (30mm, 20mm), angle 30deg;
    start plate: (240mm, 140mm), angle 0;
    start upper: (500mm, 100mm), angle 140deg;
    start lower: (400mm, -100mm), angle 120deg;

    load F: force(plate.G);
    load M: moment(lower) = 2N*m;

    scene statics: equilibrium;
    scene parts:   superposition -> (T12);
    scene torque:  virtual_work -> (T12);
    scene place:   position -> (plate.G, plate.angle);
}

fn main() -> Result<(), Error> {
    let loads = stephenson::Loads { F: Vector2::new(-180.0, 60.0) };
    println!("{:>6} {:>10} {:>10} {:>10} {:>9}", "θ (°)", "x of G", "y of G", "T (N·mm)", "|E| (N)");
    let start = stephenson::Pose::at(30f64.to_radians())?;
    let mut pose = start;
    for degrees in 30..=390 {
        pose = pose.moved_to(f64::from(degrees).to_radians())?;
        let all = pose.statics(&loads)?;
        assert!((all.T12 - pose.torque(&loads)?.T12).abs() < 1e-9, "equilibrium and virtual work disagree");
        if degrees % 30 == 0 {
            let place = pose.place()?.plate_G;
            println!("{degrees:>6} {:>10.3} {:>10.3} {:>10.1} {:>9.2}", place.x, place.y, all.T12, all.E.norm());
        }
    }
    let difference = (pose.place()?.plate_G - start.place()?.plate_G).norm();
    assert!(difference < 1e-10, "a whole turn does not come back: {difference}");
    Ok(())
}
