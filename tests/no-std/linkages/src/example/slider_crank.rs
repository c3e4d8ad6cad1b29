//! The example `slider_crank`.

use super::{angle, example, load};
use crate::digest::{Digest, outputs};

example!("slider_crank.rs");

outputs! {
    engine::Hold { T, O, A, B, G }
    engine::Weights { W }
    engine::WeightsW { crank, rod, piston }
    engine::WeightsContribution { T }
    engine::Torque { T }
}

/// Every scene at a pose.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = (angle(pose), engine::Loads { gas: load(pose, 0, 4000.0) });
    digest.result(engine::hold_at(theta, &loads));
    digest.result(engine::weights_at(theta));
    digest.result(engine::torque_at(theta, &loads));
}
