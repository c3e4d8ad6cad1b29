//! The example `three_loads`.

use linkage_runtime::Error;

use super::{angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("three_loads.rs");

outputs! {
    three_loads::Parts { F12, F13, F14 }
    three_loads::PartsContribution { T12, A0, A, B, B0 }
    three_loads::Whole { T12, A0, A, B, B0 }
    three_loads::Torque { T12 }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, three_loads::Loads) {
    let loads = three_loads::Loads { F12: load(pose, 0, 80.0), F13: load(pose, 1, 80.0), F14: load(pose, 2, 80.0) };
    (angle(pose), loads)
}

/// Every scene at a pose, straight from the drive.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(three_loads::parts_at(theta, &loads));
    digest.result(three_loads::whole_at(theta, &loads));
    digest.result(three_loads::torque_at(theta, &loads));
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = three_loads::Pose::at(theta)?;
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, crank_E, coupler_direction,
        coupler_A, coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, rocker_D, sin_mu_B);
    scenes!(digest, pose: parts(&loads), whole(&loads), torque(&loads));
    digest.result(pose.parts(&loads)?.total());
    Ok(())
}
