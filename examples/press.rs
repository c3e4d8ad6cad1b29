//! A knuckle-joint press over its working stroke: the crank for a steady motion of the ram, the torque that the forming force needs there,
//! and how much the linkage multiplies it.
//!
//! `cargo run --example press` prints a table; the crank's power is held against that of the ram.

use linkage_runtime::{Error, Vector2, linkage};

linkage! {
    /// A crank straightens a knuckle of two links, and these press the ram down.
    pub mod press;

    units { mm, kN }

    ground     { O: (-420mm, -300mm), C: (0, 0) }
    link crank { O -> A: 60mm }
    link rod   { A -> B: 360mm }
    link upper { C -> B: 300mm }
    link lower { B -> D: 320mm }
    link ram   { D }

    revolute O:  ground  -> crank;
    revolute A:  crank   -> rod;
    revolute B2: rod.B   -> upper.B;
    revolute C:  ground  -> upper;
    revolute B:  upper   -> lower;
    revolute D:  lower   -> ram;
    prismatic S: ground.C -> ram.D along -90deg;

    drive theta: O;
    unknown T: torque(ground -> crank);
    assemble B2: right(A -> C);
    assemble D: ahead(B);
    // The same from the ram: the knuckle, then the crank on its way down.
    assemble B: right(C -> D);
    assemble A: right(O -> B2);

    load forming: force(ram.D);

    scene held:  equilibrium -> (T, C, S);
    scene over:  virtual_work -> (advantage(forming));
    scene place: position -> (D);
    scene crank_of: inverse(S);
}

/// How far the ram is above its lowest place when it meets the work, mm.
const WORKING: f64 = 12.0;
/// How fast it is to move, mm/s.
const SPEED: f64 = 20.0;
/// The ram's lowest place: the knuckle is straight.
const LOWEST: f64 = 620.0;

/// The forming force on the ram, kN: it rises as the form fills.
fn forming(above: f64) -> f64 {
    let filled = 1.0 - above / WORKING;
    80.0 + 720.0 * filled * filled
}

fn main() -> Result<(), Error> {
    println!(
        "{:>9} {:>9} {:>10} {:>10} {:>9} {:>10} {:>10}",
        "above", "force", "crank", "rate", "torque", "advantage", "pin C"
    );
    println!("{:>9} {:>9} {:>10} {:>10} {:>9} {:>10} {:>10}", "mm", "kN", "deg", "deg/s", "N·m", "kN/N·m", "kN");
    let steady = press::CrankOfMotion { S_travel_rate: SPEED, S_travel_acceleration: 0.0 };
    let (mut worst, mut work, mut before) = (0.0f64, [0.0; 2], None);
    for step in 0..=46 {
        let above = WORKING - 0.25 * f64::from(step);
        let crank = press::crank_of_at(LOWEST - above, &steady)?;
        let pose = press::Pose::at(crank.theta)?;
        let loads = press::Loads { forming: Vector2::new(0.0, forming(above)) };
        let held = pose.held(&loads)?;
        // What the crank puts in is what the ram gives to the work.
        let powers = [held.T * crank.theta_rate, forming(above) * SPEED];
        worst = worst.max((powers[0] - powers[1]).abs() / powers[1]);
        if let Some((theta, torque, force)) = before.replace((crank.theta, held.T, forming(above))) {
            work[0] += 0.5 * (torque + held.T) * (crank.theta - theta);
            work[1] += 0.5 * (force + forming(above)) * 0.25;
        }
        if step % 4 == 0 || step == 46 {
            let advantage = pose.over(&loads)?.forming_advantage.abs();
            println!(
                "{above:>9.2} {:>9.1} {:>10.2} {:>10.2} {:>9.1} {advantage:>10.4} {:>10.1}",
                forming(above),
                crank.theta.to_degrees(),
                crank.theta_rate.to_degrees(),
                held.T,
                held.C.norm(),
            );
        }
    }
    println!("\nwork of the crank {:.2} J, of the ram {:.2} J", work[0], work[1]);
    println!("power of crank and ram differ by {worst:.1e} at most");
    assert!(worst < 1e-10);
    let beyond = press::crank_of_at(LOWEST + 0.1, &steady);
    println!(
        "0.1 mm below the lowest place: {}",
        beyond.map_or_else(|error| error.to_string(), |crank| format!("{crank:?}"))
    );
    Ok(())
}
