//! The example `control_loop`.

use super::{angle, example, load};
use crate::digest::{Digest, outputs};

example!("control_loop.rs");

outputs! {
    four_bar::Control { M, h, rounding }
    four_bar::Powers { D, M4 }
    four_bar::Centres { crank_G, coupler_G, rocker_G }
}

/// Every scene at a pose, and the acceleration under a torque.
pub fn solve(pose: u16, digest: &mut Digest) {
    let theta = angle(pose);
    let given = load(pose, 0, 1.0);
    let motion = four_bar::Motion { theta_rate: 9.0 * given.x };
    let control = four_bar::control_at(theta, &motion);
    digest.result(control);
    if let Ok(control) = control {
        digest.result(control.acceleration(0.7 * given.y));
    }
    digest.result(four_bar::powers_at(theta, &motion));
    digest.result(four_bar::centres_at(theta));
}
