//! The example `six_bar`.

use linkage_runtime::Error;

use super::{angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("six_bar.rs");

outputs! {
    six_bar::Statics { T12, A0, A, B, B0, C, D, D0 }
    six_bar::Parts { W, F, M }
    six_bar::PartsW { crank, coupler, rocker, rod, output }
    six_bar::PartsContribution { T12 }
    six_bar::Torque { T12 }
    six_bar::Second { C, D, D0 }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, six_bar::Loads) {
    (angle(pose), six_bar::Loads { F: load(pose, 0, 120.0) })
}

/// Every scene at a pose, straight from the drive.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(six_bar::statics_at(theta, &loads));
    digest.result(six_bar::parts_at(theta, &loads));
    digest.result(six_bar::torque_at(theta, &loads));
    digest.result(six_bar::second_at(theta, &loads));
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = six_bar::Pose::at(theta)?;
    accessors!(digest, pose: theta, A0, A, B, B0, C, D, D0, crank_direction, crank_A0, crank_A, coupler_direction,
        coupler_A, coupler_B, coupler_G, rocker_direction, rocker_B0, rocker_B, rocker_C, rod_direction, rod_C, rod_D,
        output_direction, output_D0, output_D, output_P, sin_mu_B, sin_mu_D);
    scenes!(digest, pose: statics(&loads), parts(&loads), torque(&loads), second(&loads));
    let parts = pose.parts(&loads)?;
    digest.result(parts.total());
    digest.result(parts.W.total());
    Ok(())
}
