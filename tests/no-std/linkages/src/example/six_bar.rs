//! The example `six_bar`.

use super::{angle, example, load};
use crate::digest::{Digest, outputs};

example!("six_bar.rs");

outputs! {
    six_bar::Statics { T12, A0, A, B, B0, C, D, D0 }
    six_bar::Parts { W, F, M }
    six_bar::PartsW { crank, coupler, rocker, rod, output }
    six_bar::PartsContribution { T12 }
    six_bar::Torque { T12 }
    six_bar::Second { C, D, D0 }
}

/// Every scene at a pose.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = (angle(pose), six_bar::Loads { F: load(pose, 0, 120.0) });
    digest.result(six_bar::statics_at(theta, &loads));
    digest.result(six_bar::parts_at(theta, &loads));
    digest.result(six_bar::torque_at(theta, &loads));
    digest.result(six_bar::second_at(theta, &loads));
}
