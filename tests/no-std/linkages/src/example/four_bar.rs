//! The example `four_bar`.

use super::{angle, example, load};
use crate::digest::{Digest, outputs};

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

/// Every scene at a pose.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = (angle(pose), four_bar::Loads { F13: load(pose, 0, 50.0) });
    digest.result(four_bar::statics_at(theta, &loads));
    digest.result(four_bar::parts_at(theta, &loads));
    digest.result(four_bar::torque_at(theta, &loads));
    digest.result(four_bar::bearing_at(theta));
    digest.result(four_bar::terms_at(theta, &loads));
    digest.result(four_bar::places_at(theta));
}
