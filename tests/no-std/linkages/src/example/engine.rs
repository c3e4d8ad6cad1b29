//! The example `engine`.

use linkage_runtime::{Error, Series, Vector2};

use super::{POSES, angle, example, load};
use crate::digest::{Digest, accessors, outputs, scenes};

example!("engine.rs");

outputs! {
    engine::Forces { T, O, A, B, S, power, ground_about_ground_O }
    engine::Shakes { shaking_ground_O }
}

/// The angle of the crank at a pose, and the loads.
fn given(pose: u16) -> (f64, engine::Loads) {
    (angle(pose), engine::Loads { gas: load(pose, 0, 9000.0) })
}

/// Every scene at a pose, straight from the drive, and sweeps over it and the four next to it.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = given(pose);
    digest.result(engine::forces_at(theta, &loads));
    digest.result(engine::shakes_at(theta));
    let next = |number: u16| angle(pose.wrapping_add(number));
    swept(&[theta, next(1), next(2), next(3), next(4)], Series::Constant(loads.gas), digest);
}

/// The cycle swept at once, with a load at each position: more positions than a block of a sweep has.
#[must_use]
pub fn digest_cycle() -> Digest {
    let mut digest = Digest::new();
    let (mut thetas, mut gas) = ([0.0; POSES as usize], [Vector2::new(0.0, 0.0); POSES as usize]);
    let mut pose = 0;
    while let (Some(theta), Some(load)) = (thetas.get_mut(usize::from(pose)), gas.get_mut(usize::from(pose))) {
        let (angle, loads) = given(pose);
        (*theta, *load) = (angle, loads.gas);
        pose = pose.wrapping_add(1);
    }
    swept(&thetas, Series::Each(&gas), &mut digest);
    digest
}

/// Sweeps over some positions.
fn swept<const POSITIONS: usize>(thetas: &[f64; POSITIONS], gas: Series<'_, Vector2<f64>>, digest: &mut Digest) {
    let mut columns = [[0.0; POSITIONS]; 15];
    let [t, ox, oy, ax, ay, bx, by, sx, sy, sn, sc, power, gx, gy, gm] = &mut columns;
    let results = engine::Cycle {
        T: t,
        O_x: ox,
        O_y: oy,
        A_x: ax,
        A_y: ay,
        B_x: bx,
        B_y: by,
        S_force_x: sx,
        S_force_y: sy,
        S_normal: sn,
        S_couple: sc,
        power,
        ground_about_ground_O_force_x: gx,
        ground_about_ground_O_force_y: gy,
        ground_about_ground_O_moment: gm,
    };
    let inputs = engine::CycleInputs { theta: Series::Each(thetas), gas };
    digest.sweep(engine::cycle(&inputs, results));
    digest.columns(&columns);
    let mut columns = [[0.0; POSITIONS]; 3];
    let [x, y, moment] = &mut columns;
    let results =
        engine::Shaking { shaking_ground_O_force_x: x, shaking_ground_O_force_y: y, shaking_ground_O_moment: moment };
    digest.sweep(engine::shaking(&engine::ShakingInputs { theta: Series::Each(thetas) }, results));
    digest.columns(&columns);
}

/// What a pose says of itself, and every scene from it.
fn posed(number: u16, digest: &mut Digest) -> Result<(), Error> {
    let (theta, loads) = given(number);
    let pose = engine::Pose::at(theta)?;
    accessors!(digest, pose: theta, O, A, B, S, crank_direction, crank_O, crank_A, rod_direction, rod_A, rod_B,
        piston_direction, piston_B, sin_mu_B, travel_S);
    scenes!(digest, pose: forces(&loads), shakes());
    Ok(())
}
