//! A linkage that folds and goes through: the motion is continued by half angles.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A linkage that folds and goes through: the motion is continued by half angles.
    pub mod linkage;
    scalar f32;
    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: 100mm, C: (50mm, 20mm) }
    link rocker  { B0 -> B: 120mm }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: left(A -> B0) smooth at 60deg;

    load F: force(coupler.C);

    scene statics: equilibrium;
    scene torque:  virtual_work -> (effort_theta);
    scene place:   position;
}

outputs! {
    linkage::Statics { effort_theta, A0, A, B, B0 }
    linkage::Torque { effort_theta }
    linkage::Place { A0, A, B, B0, coupler_C, crank_angle, coupler_angle, rocker_angle }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, _, _, _, _, _] = *input;
    let loads = linkage::Loads { F: Vector2::new(50.0 * a, 50.0 * b) };
    digest.result(linkage::statics_at(theta, &loads));
    digest.result(linkage::torque_at(theta, &loads));
    digest.result(linkage::place_at(theta));
    let pose = match linkage::Pose::at(theta) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.statics(&loads));
    digest.result(pose.torque(&loads));
    digest.result(pose.place());
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, coupler_direction, coupler_A,
        coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, sin_mu_B);
}

digest!();
