//! The example `press`.

use super::{POSES, angle, example, load};
use crate::digest::{Digest, outputs};

example!("press.rs");

outputs! {
    press::Held { T, C, S }
    press::Over { forming_advantage }
    press::Place { D }
    press::CrankOf { theta, theta_rate, theta_acceleration }
}

/// Every scene at a pose, and the crank at a place of the ram: up to 24 mm above its lowest, and a little below it.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = (angle(pose), press::Loads { forming: load(pose, 0, 800.0) });
    digest.result(press::held_at(theta, &loads));
    digest.result(press::over_at(theta, &loads));
    digest.result(press::place_at(theta));
    let given = load(pose, 1, 1.0);
    let motion = press::CrankOfMotion { S_travel_rate: 20.0 * given.x, S_travel_acceleration: 300.0 * given.y };
    digest.result(press::crank_of_at(620.5 - 24.5 * f64::from(pose) / f64::from(POSES), &motion));
}
