//! The example `press`.

use linkage_runtime::Error;

use super::{POSES, angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("press.rs");

outputs! {
    press::Held { T, C, S }
    press::Over { forming_advantage }
    press::Place { D }
    press::CrankOf { theta, theta_rate, theta_acceleration }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, press::Loads) {
    (angle(pose), press::Loads { forming: load(pose, 0, 800.0) })
}

/// Every scene at a pose, straight from the drive, and the crank at a place of the ram: up to 24 mm above its lowest, and a little below it.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(press::held_at(theta, &loads));
    digest.result(press::over_at(theta, &loads));
    digest.result(press::place_at(theta));
    let given = load(pose, 1, 1.0);
    let motion = press::CrankOfMotion { S_travel_rate: 20.0 * given.x, S_travel_acceleration: 300.0 * given.y };
    digest.result(press::crank_of_at(620.5 - 24.5 * f64::from(pose) / f64::from(POSES), &motion));
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = press::Pose::at(theta)?;
    accessors!(digest, pose: theta, O, A, B2, C, B, D, S, crank_direction, crank_O, crank_A, rod_direction, rod_A,
        rod_B, upper_direction, upper_C, upper_B, lower_direction, lower_B, lower_D, ram_direction, ram_D, sin_mu_B2,
        sin_mu_D, travel_S);
    scenes!(digest, pose: held(&loads), over(&loads), place());
    Ok(())
}
