//! The example `four_bar`.

use linkage_runtime::Error;

use super::{angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("four_bar.rs");

outputs! {
    four_bar::Statics { T12, A0, A, B, B0 }
    four_bar::Parts { F13, F14 }
    four_bar::PartsContribution { T12, A0, A, B, B0 }
    four_bar::Torque { T12 }
    four_bar::Bearing { B }
    four_bar::Terms { F13, F14 }
    four_bar::Places { A0, A, B, B0, coupler_C, rocker_D, crank_angle, coupler_angle, rocker_angle }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, four_bar::Loads) {
    (angle(pose), four_bar::Loads { F13: load(pose, 0, 50.0) })
}

/// Every scene at a pose, straight from the drive.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(four_bar::statics_at(theta, &loads));
    digest.result(four_bar::parts_at(theta, &loads));
    digest.result(four_bar::torque_at(theta, &loads));
    digest.result(four_bar::bearing_at(theta));
    digest.result(four_bar::terms_at(theta, &loads));
    digest.result(four_bar::places_at(theta));
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = four_bar::Pose::at(theta)?;
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, coupler_direction, coupler_A,
        coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, rocker_D, sin_mu_B);
    scenes!(digest, pose: statics(&loads), parts(&loads), torque(&loads), bearing(), terms(&loads), places());
    digest.result(pose.parts(&loads)?.total());
    Ok(())
}
