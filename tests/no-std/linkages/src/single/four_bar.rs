//! A crank-rocker in single precision, held by the effort at its driven joint.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A crank-rocker in single precision, held by the effort at its driven joint.
    pub mod linkage;
    scalar f32;
    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 100mm, C: (60mm, 25mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;
    load M4:  moment(rocker);

    scene statics: equilibrium;
    scene bearing: equilibrium(F14) -> (B);
    scene parts:   superposition;
    scene terms:   virtual_work;
    scene torque:  virtual_work(F13, F14) -> (effort_theta);
    scene place:   position;
}

outputs! {
    linkage::Statics { effort_theta, A0, A, B, B0 }
    linkage::Bearing { B }
    linkage::Parts { F13, F14, M4 }
    linkage::PartsContribution { effort_theta, A0, A, B, B0 }
    linkage::Terms { effort_theta, F13, F14, M4 }
    linkage::Torque { effort_theta }
    linkage::Place { A0, A, B, B0, coupler_C, rocker_D, crank_angle, coupler_angle, rocker_angle }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, _, _, _, _] = *input;
    let loads = linkage::Loads { F13: Vector2::new(50.0 * a, 50.0 * b), M4: 1e3 * c };
    digest.result(linkage::statics_at(theta, &loads));
    digest.result(linkage::bearing_at(theta));
    digest.result(linkage::parts_at(theta, &loads));
    digest.result(linkage::terms_at(theta, &loads));
    digest.result(linkage::torque_at(theta, &loads));
    digest.result(linkage::place_at(theta));
    let pose = match linkage::Pose::at(theta) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.statics(&loads));
    digest.result(pose.bearing());
    let parts = pose.parts(&loads);
    digest.result(parts);
    if let Ok(parts) = parts {
        digest.result(parts.total());
    }
    digest.result(pose.terms(&loads));
    digest.result(pose.torque(&loads));
    digest.result(pose.place());
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, coupler_direction, coupler_A,
        coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, rocker_D, sin_mu_B);
}

digest!();
