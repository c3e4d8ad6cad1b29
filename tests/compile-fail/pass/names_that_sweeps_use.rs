//! Unknowns may have the names by which a sweep computes, and those of Rust's own patterns.

use linkage_runtime::{Series, SweepError, Vector2, linkage};

macro_rules! crank {
    ($name:ident, $unknown:ident) => {
        linkage! {
            mod $name;
            units { m, N }

            ground     { O: (0, 0) }
            link crank { O -> A: 1m }

            revolute O: ground -> crank;

            drive theta: O;
            unknown $unknown: torque(ground -> crank);

            load gen: force(crank.A);
            scene held:   equilibrium -> ($unknown);
            scene parts:  superposition -> ($unknown);
            scene all:    sweep(held);
        }
    };
}
crank!(lanes, lane);
crank!(blocks, block);
crank!(checks, failed);
crank!(results, Ok);
crank!(nothing, None);

// What depends on parameters alone is prepared under the name of the unknown.
macro_rules! weight {
    ($name:ident, $unknown:ident) => {
        linkage! {
            mod $name;
            units { m, N }
            param load: mass = 2kg;

            ground { O: (0, 0) }
            link block { P }
            mass block: load at P;

            prismatic S: ground.O -> block.P along 90deg;

            drive s: S;
            unknown $unknown: effort(s);

            load W: gravity = 9.81m/s^2 @ -90deg;
            scene held: equilibrium -> ($unknown);
            scene all:  sweep(held);
        }
    };
}
weight!(weights, failed);
weight!(scales, Ok);

fn main() -> Result<(), SweepError> {
    let force = Vector2::new(0.0, 1.0);
    let mut found = [0.0; 2];
    let theta = Series::Each(&[0.0, 1.0]);
    lanes::all(&lanes::AllInputs { theta, r#gen: force.into() }, lanes::All { lane: &mut found })?;
    results::all(&results::AllInputs { theta, r#gen: force.into() }, results::All { Ok: &mut found })?;
    assert_eq!(found, [-1.0, -1f64.cos()]);
    let linkage = weights::Linkage::new(&weights::Params::default()).expect("a mass");
    weights::all(&linkage, &weights::AllInputs { s: theta }, weights::All { failed: &mut found })?;
    assert_eq!(found, [2.0 * 9.81; 2]);
    let linkage = scales::Linkage::new(&scales::Params::default()).expect("a mass");
    scales::all(&linkage, &scales::AllInputs { s: theta }, scales::All { Ok: &mut found })?;
    assert_eq!(found, [2.0 * 9.81; 2]);
    Ok(())
}
