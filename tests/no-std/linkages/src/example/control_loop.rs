//! The example `control_loop`.

use linkage_runtime::Error;

use super::{angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("control_loop.rs");

outputs! {
    four_bar::Control { M, h, rounding }
    four_bar::Powers { D, M4 }
    four_bar::Centres { crank_G, coupler_G, rocker_G }
}

/// The angle of the crank at a pose, its rate, and a torque.
fn given(pose: u16) -> (f64, four_bar::Motion, f64) {
    let given = load(pose, 0, 1.0);
    (angle(pose), four_bar::Motion { theta_rate: 9.0 * given.x }, 0.7 * given.y)
}

/// Every scene at a pose, straight from the drive, and the acceleration under a torque.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, motion, torque) = given(pose);
    let control = four_bar::control_at(theta, &motion);
    digest.result(control);
    if let Ok(control) = control {
        digest.result(control.acceleration(torque));
    }
    digest.result(four_bar::powers_at(theta, &motion));
    digest.result(four_bar::centres_at(theta));
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, motion, torque) = given(number);
    let pose = four_bar::Pose::at(theta)?;
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, crank_G, coupler_direction,
        coupler_A, coupler_B, coupler_G, rocker_direction, rocker_B0, rocker_B, rocker_G, sin_mu_B);
    scenes!(digest, pose: control(&motion), powers(&motion), centres());
    digest.result(pose.control(&motion)?.acceleration(torque));
    Ok(())
}
