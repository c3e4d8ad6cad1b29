//! The example `stephenson`.

use super::{angle, example, load};
use crate::digest::{Digest, outputs};

example!("stephenson.rs");

outputs! {
    stephenson::Statics { T12, O, A, E, C, D, Q, P }
    stephenson::Parts { F, M }
    stephenson::PartsContribution { T12 }
    stephenson::Torque { T12 }
    stephenson::Place { plate_G, plate_angle }
}

/// Every scene at a pose.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = (angle(pose), stephenson::Loads { F: load(pose, 0, 60.0) });
    digest.result(stephenson::statics_at(theta, &loads));
    digest.result(stephenson::parts_at(theta, &loads));
    digest.result(stephenson::torque_at(theta, &loads));
    digest.result(stephenson::place_at(theta));
}
