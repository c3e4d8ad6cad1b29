//! The example `slider_crank`.

use linkage_runtime::Error;

use super::{angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("slider_crank.rs");

outputs! {
    engine::Hold { T, O, A, B, G }
    engine::Weights { W }
    engine::WeightsW { crank, rod, piston }
    engine::WeightsContribution { T }
    engine::Torque { T }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, engine::Loads) {
    (angle(pose), engine::Loads { gas: load(pose, 0, 4000.0) })
}

/// Every scene at a pose, straight from the drive.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(engine::hold_at(theta, &loads));
    digest.result(engine::weights_at(theta));
    digest.result(engine::torque_at(theta, &loads));
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = engine::Pose::at(theta)?;
    accessors!(digest, pose: theta, O, A, B, G, crank_direction, crank_O, crank_A, rod_direction, rod_A, rod_B,
        piston_direction, piston_B, piston_G, piston_crown, sin_mu_B, travel_G);
    scenes!(digest, pose: hold(&loads), weights(), torque(&loads));
    let weights = pose.weights()?;
    digest.result(weights.total());
    digest.result(weights.W.total());
    Ok(())
}
