//! The example `engine`.

use linkage_runtime::Series;

use super::{angle, example, load, put};
use crate::digest::{Digest, outputs};

example!("engine.rs");

outputs! {
    engine::Forces { T, O, A, B, S, power, ground_about_ground_O }
    engine::Shakes { shaking_ground_O }
}

/// Every scene at a pose, and sweeps over it and the four next to it.
pub fn solve(pose: u16, digest: &mut Digest) {
    let (theta, loads) = (angle(pose), engine::Loads { gas: load(pose, 0, 9000.0) });
    digest.result(engine::forces_at(theta, &loads));
    digest.result(engine::shakes_at(theta));
    let next = |number: u16| angle(pose.wrapping_add(number));
    let thetas = [theta, next(1), next(2), next(3), next(4)];
    let mut columns = [[0.0; 5]; 15];
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
    let inputs = engine::CycleInputs { theta: Series::Each(&thetas), gas: Series::Constant(loads.gas) };
    digest.sweep(engine::cycle(&inputs, results));
    put(digest, &columns);
    let mut columns = [[0.0; 5]; 3];
    let [x, y, moment] = &mut columns;
    let results =
        engine::Shaking { shaking_ground_O_force_x: x, shaking_ground_O_force_y: y, shaking_ground_O_moment: moment };
    digest.sweep(engine::shaking(&engine::ShakingInputs { theta: Series::Each(&thetas) }, results));
    put(digest, &columns);
}
