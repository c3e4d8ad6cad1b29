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
    let loads = three_loads::Loads { F12: load(pose, 0, 80.0), F13: load(pose, 1, 80.0), F14: load(pose, 2, 80.0) };
    digest.result(three_loads::parts_at(theta, &loads));
    digest.result(three_loads::whole_at(theta, &loads));
    digest.result(three_loads::torque_at(theta, &loads));
}
