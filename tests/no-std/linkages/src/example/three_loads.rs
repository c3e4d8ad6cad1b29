//! The example `three_loads`.

use super::{angle, example, load};
use crate::digest::{Digest, outputs};

example!("three_loads.rs");

outputs! {
    three_loads::Parts { F12, F13, F14 }
    three_loads::PartsContribution { T12, A0, A, B, B0 }
    three_loads::Whole { T12, A0, A, B, B0 }
    three_loads::Torque { T12 }
}

/// Every scene at a pose.
pub fn solve(pose: u16, digest: &mut Digest) {
    let theta = angle(pose);
    let [on_crank, on_coupler, on_rocker] = [0, 1, 2].map(|number| load(pose, number, 80.0));
    let loads = three_loads::Loads { F12: on_crank, F13: on_coupler, F14: on_rocker };
    digest.result(three_loads::parts_at(theta, &loads));
    digest.result(three_loads::whole_at(theta, &loads));
    digest.result(three_loads::torque_at(theta, &loads));
}
