//! METU Example 6.3: a four-bar with forces on its coupler and its rocker, held by a torque on its crank.
//!
//! `cargo run --example four_bar` prints the pose, the limits of the linkage, the free bodies' equations, the joint forces, what each load
//! contributes, the torque by virtual work, and how well all methods agree.

use linkage_runtime::limits::{DriverRange, Interval};
use linkage_runtime::{Error, Vector2, linkage, polar};

linkage! {
    /// METU Example 6.3: forces on coupler and rocker, held by a torque on the crank.
    pub mod four_bar;

    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;

    scene statics: equilibrium;
    scene parts:   superposition;
    scene torque:  virtual_work(F13, F14) -> (T12);
    scene bearing: equilibrium(F14) -> (B);
    scene terms:   virtual_work -> (F13, F14);
    scene places:  position;
    scene check:   verify;
}

/// Components, and size ∠ angle in degrees.
fn vector(force: Vector2<f64>) -> String {
    let angle = force.y.atan2(force.x).to_degrees();
    format!("{:>9.4} {:>9.4}    {:>8.4} ∠ {angle:>8.3}°", force.x, force.y, force.norm())
}

fn main() -> Result<(), Error> {
    let theta = 60f64.to_radians();
    let loads = four_bar::Loads { F13: polar(50.0, 230f64.to_radians()) };
    let pose = four_bar::Pose::at(theta)?;

    println!("Pose at θ12 = 60°                x         y  (mm)");
    let places = pose.places()?;
    let joints = [("A0", places.A0), ("A", places.A), ("B", places.B), ("B0", places.B0)];
    let points = [("C", places.coupler_C), ("D", places.rocker_D)];
    for (name, place) in joints.into_iter().chain(points) {
        println!("  {name:<24} {:>9.4} {:>9.4}", place.x, place.y);
    }
    println!("  θ13 = {:.4}°, θ14 = {:.4}°", places.coupler_angle.to_degrees(), places.rocker_angle.to_degrees());
    println!("  sin μ at B = {:.4}", pose.sin_mu_B());

    let limits = four_bar::LIMITS.B;
    let [least, greatest] = limits.transmission.map(|one| one.angle.to_degrees());
    println!("\nLimits: {:?}, the crank {}", limits.class, crank_turns(limits.range));
    for dead in limits.dead_centres.iter().flatten() {
        println!(
            "  the rocker cannot turn the crank at θ12 = {:.4}°: {:?} at {}",
            dead.at.to_degrees(),
            dead.posture,
            dead.joint
        );
    }
    println!("  transmission angle between {least:.4}° and {greatest:.4}°");

    println!("\n{}", free_bodies());

    let all = pose.statics(&loads)?;
    println!("\nJoint forces                     x         y  (N)  size ∠ angle");
    let forces = [
        ("ground on crank, A0", all.A0),
        ("crank on coupler, A", all.A),
        ("coupler on rocker, B", all.B),
        ("ground on rocker, B0", all.B0),
    ];
    for (name, force) in forces {
        println!("  {name:<24} {}", vector(force));
    }
    println!("  T12, ground on crank     {:>9.3} N·mm", all.T12);

    let parts = pose.parts(&loads)?;
    let sum = parts.total()?;
    println!("\nContributions                  F13 alone   F14 alone         sum   together");
    println!(
        "  T12 (N·mm)             {:>12.4}{:>12.4}{:>12.4}{:>11.4}",
        parts.F13.T12, parts.F14.T12, sum.T12, all.T12
    );
    let rows = [
        ("A", parts.F13.A, parts.F14.A, sum.A, all.A),
        ("B", parts.F13.B, parts.F14.B, sum.B, all.B),
        ("B0", parts.F13.B0, parts.F14.B0, sum.B0, all.B0),
    ];
    for (name, by_13, by_14, total, together) in rows {
        println!(
            "  {name:<3}x (N)                {:>12.4}{:>12.4}{:>12.4}{:>11.4}",
            by_13.x, by_14.x, total.x, together.x
        );
        println!(
            "  {name:<3}y (N)                {:>12.4}{:>12.4}{:>12.4}{:>11.4}",
            by_13.y, by_14.y, total.y, together.y
        );
    }

    let terms = pose.terms(&loads)?;
    println!("\nVirtual work, for ω12 = 1 rad/s   velocity along the load (mm/s)   work (N·mm/s)");
    println!("  F13                            {:>12.4}{:>34.4}", terms.F13.velocity, terms.F13.work);
    println!("  F14                            {:>12.4}{:>34.4}", terms.F14.velocity, terms.F14.work);
    let torque = four_bar::torque_at(theta, &loads)?.T12;
    println!("  T12 straight from θ12          {torque:>12.4} N·mm");

    println!("\nBy F14 alone, at B               {}", vector(pose.bearing()?.B));
    println!("\nAgreement: {}", pose.check(&loads)?);
    Ok(())
}

/// How far the crank can go, in words.
fn crank_turns(range: DriverRange<f64>) -> String {
    let piece = |Interval { from, to }: Interval<f64>| {
        format!("from {:.4}° to {:.4}°", from.at.to_degrees(), to.at.to_degrees())
    };
    match range {
        DriverRange::Unlimited => "goes all round".to_owned(),
        DriverRange::One(one) => format!("goes {}", piece(one)),
        DriverRange::Two([first, second]) => format!("goes {} or {}", piece(first), piece(second)),
    }
}

/// The part of the derivation that a textbook writes first.
fn free_bodies() -> &'static str {
    let text = four_bar::EQUATIONS;
    let start = text.find("Free bodies").unwrap_or(0);
    let end = text.find("Reduction").unwrap_or(text.len());
    text[start..end].trim_end()
}
