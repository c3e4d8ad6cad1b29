//! The example `stephenson`.

use linkage_runtime::Error;

use super::{angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("stephenson.rs");

outputs! {
    stephenson::Statics { T12, O, A, E, C, D, Q, P }
    stephenson::Parts { F, M }
    stephenson::PartsContribution { T12 }
    stephenson::Torque { T12 }
    stephenson::Place { plate_G, plate_angle }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, stephenson::Loads) {
    (angle(pose), stephenson::Loads { F: load(pose, 0, 60.0) })
}

/// Every scene at a pose, straight from the drive.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(stephenson::statics_at(theta, &loads));
    digest.result(stephenson::parts_at(theta, &loads));
    digest.result(stephenson::torque_at(theta, &loads));
    digest.result(stephenson::place_at(theta));
}

/// A pose, and one that it moves to, of 3 degrees: what each says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = stephenson::Pose::at(theta)?;
    put(&pose, &loads, digest)?;
    put(&pose.moved_to(angle(number.wrapping_add(1)))?, &loads, digest)
}

fn put(pose: &stephenson::Pose, loads: &stephenson::Loads, digest: &mut Digest) -> Result<(), Error> {
    accessors!(digest, pose: theta, O, A, E, C, D, Q, P, crank_direction, crank_O, crank_A, rod_direction, rod_A, rod_E,
        plate_direction, plate_E, plate_C, plate_D, plate_G, upper_direction, upper_Q, upper_C, lower_direction,
        lower_P, lower_D);
    scenes!(digest, pose: statics(loads), parts(loads), torque(loads), place());
    digest.result(pose.parts(loads)?.total());
    Ok(())
}
