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
crank!(checks, holds);
crank!(results, Ok);
crank!(nothing, None);

fn main() -> Result<(), SweepError> {
    let force = Vector2::new(0.0, 1.0);
    let mut found = [0.0; 2];
    let theta = Series::Each(&[0.0, 1.0]);
    lanes::all(&lanes::AllInputs { theta, r#gen: force.into() }, lanes::All { lane: &mut found })?;
    results::all(&results::AllInputs { theta, r#gen: force.into() }, results::All { Ok: &mut found })?;
    assert_eq!(found, [-1.0, -1f64.cos()]);
    Ok(())
}
