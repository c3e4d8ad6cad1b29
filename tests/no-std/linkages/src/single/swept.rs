//! A crank-rocker in single precision, swept over more positions than a register holds.

use linkage_runtime::{Series, Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs, scenes};

linkage! {
    /// A crank-rocker in single precision.
    pub mod linkage;
    scalar f32;
    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 100mm, C: (60mm, 25mm) }
    link rocker  { B0 -> B: 120mm }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: left(A -> B0);

    load F: force(coupler.C);

    scene held:  equilibrium -> (effort_theta, A, B);
    scene cycle: sweep(held);
}

outputs! {
    linkage::Held { effort_theta, A, B }
}

/// How many positions are swept: one more than the widest registers hold.
const POSITIONS: usize = 17;

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, d, ..] = *input;
    let loads = linkage::Loads { F: Vector2::new(50.0 * a, 50.0 * b) };
    digest.result(linkage::held_at(theta, &loads));
    let (mut thetas, mut forces) = ([theta; POSITIONS], [loads.F; POSITIONS]);
    // By counting: an iterator keeps a way to panic in unoptimised builds.
    let (mut angle, mut force, mut position) = (theta, loads.F, 0);
    while let (Some(to_angle), Some(to_force)) = (thetas.get_mut(position), forces.get_mut(position)) {
        (*to_angle, *to_force) = (angle, force);
        angle += c;
        force = Vector2::new(force.y - d, force.x + d);
        position = position.wrapping_add(1);
    }
    let inputs = linkage::CycleInputs { theta: Series::Each(&thetas), F: Series::Each(&forces) };
    let mut columns = [[0.0; POSITIONS]; 5];
    let [effort, pin_x, pin_y, far_x, far_y] = &mut columns;
    let results = linkage::Cycle { effort_theta: effort, A_x: pin_x, A_y: pin_y, B_x: far_x, B_y: far_y };
    digest.sweep(linkage::cycle(&inputs, results));
    digest.columns(&columns);
    let pose = match linkage::Pose::at(theta) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    scenes!(digest, pose: held(&loads));
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, coupler_direction, coupler_A,
        coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, sin_mu_B);
}

digest!();
