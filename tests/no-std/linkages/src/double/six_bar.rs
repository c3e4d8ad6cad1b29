//! A six-bar, held at its last link: forces by a core of three equations.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A six-bar, held at its last link: forces by a core of three equations.
    pub mod linkage;

    ground       { A0: (0, 0), B0: (1.4m, 0), F0: (2.4m, 0.3m) }
    link crank   { A0 -> A: 0.4m }
    link coupler { A -> B: 1.2m, C: (0.5m, 0.2m), E: (0.8m, 0.3m) }
    link rocker  { B0 -> B: 1m }
    link rod     { E -> F: 1.3m }
    link arm     { F0 -> F: 0.9m }
    mass arm: 4kg at (0.4m, 0);

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    revolute E:  coupler -> rod;
    revolute F:  rod     -> arm;
    revolute F0: ground  -> arm;

    drive theta: A0;
    unknown T: torque(ground -> arm);
    assemble B: left(A -> B0);
    assemble F: left(E -> F0);

    load L: force(coupler.C);
    load M: moment(ground -> crank);
    load W: gravity;

    scene statics: equilibrium;
    scene parts:   superposition;
    scene work:    virtual_work;
    scene place:   position;
}

outputs! {
    linkage::Statics { T, A0, A, B, B0, E, F, F0 }
    linkage::Parts { L, M, W }
    linkage::PartsContribution { T, A0, A, B, B0, E, F, F0 }
    linkage::PartsW { arm }
    linkage::Work { T, L, M, W }
    linkage::WorkW { arm }
    linkage::Place { A0, A, B, B0, E, F, F0, coupler_C, crank_angle, coupler_angle, rocker_angle, rod_angle, arm_angle }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, d, _, _, _] = *input;
    let loads = linkage::Loads { L: Vector2::new(50.0 * a, 50.0 * b), M: 1e3 * c, W: Vector2::new(c, 9.81 * d) };
    digest.result(linkage::statics_at(theta, &loads));
    digest.result(linkage::parts_at(theta, &loads));
    digest.result(linkage::work_at(theta, &loads));
    digest.result(linkage::place_at(theta));
    let pose = match linkage::Pose::at(theta) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.statics(&loads));
    let parts = pose.parts(&loads);
    digest.result(parts);
    if let Ok(parts) = parts {
        digest.result(parts.total());
        digest.result(parts.W.total());
    }
    digest.result(pose.work(&loads));
    digest.result(pose.place());
    accessors!(digest, pose: theta, A0, A, B, B0, E, F, F0, crank_direction, crank_A0, crank_A, coupler_direction,
        coupler_A, coupler_B, coupler_C, coupler_E, rocker_direction, rocker_B0, rocker_B, rod_direction, rod_E,
        rod_F, arm_direction, arm_F0, arm_F, sin_mu_B, sin_mu_F);
}

digest!();
