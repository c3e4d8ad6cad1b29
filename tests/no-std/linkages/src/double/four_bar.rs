//! METU Example 6.3, held by a torque on the crank, at single positions and swept.

use linkage_runtime::{Series, Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// METU Example 6.3, held by a torque on the crank.
    pub mod linkage;
    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;
    load M14: moment(coupler -> rocker);

    scene statics: equilibrium;
    scene bearing: equilibrium(F14) -> (B);
    scene parts:   superposition;
    scene terms:   virtual_work;
    scene torque:  virtual_work(F13, F14) -> (T12);
    scene place:   position;
    scene pin:     position -> (B);
    scene cycle:   sweep(torque);
}

outputs! {
    linkage::Statics { T12, A0, A, B, B0 }
    linkage::Bearing { B }
    linkage::Parts { F13, F14, M14 }
    linkage::PartsContribution { T12, A0, A, B, B0 }
    linkage::Terms { T12, F13, F14, M14 }
    linkage::Torque { T12 }
    linkage::Place { A0, A, B, B0, coupler_C, rocker_D, crank_angle, coupler_angle, rocker_angle }
    linkage::Pin { B }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, _, _, _, _] = *input;
    let loads = linkage::Loads { F13: Vector2::new(50.0 * a, 50.0 * b), M14: 1e3 * c };
    digest.result(linkage::statics_at(theta, &loads));
    digest.result(linkage::bearing_at(theta));
    digest.result(linkage::parts_at(theta, &loads));
    digest.result(linkage::terms_at(theta, &loads));
    digest.result(linkage::torque_at(theta, &loads));
    digest.result(linkage::place_at(theta));
    digest.result(linkage::pin_at(theta));
    let thetas = [theta, theta + a, theta - b, b, c];
    let inputs = linkage::CycleInputs { theta: Series::Each(&thetas), F13: Series::Constant(loads.F13) };
    let mut torques = [0.0; 5];
    digest.sweep(linkage::cycle(&inputs, linkage::Cycle { T12: &mut torques }));
    let [t, u, v, w, x] = torques;
    digest.put((((t, u), (v, w)), x));
    // A slice of another length.
    let inputs = linkage::CycleInputs { theta: Series::Each(&[theta, a]), F13: Series::Constant(loads.F13) };
    digest.sweep(linkage::cycle(&inputs, linkage::Cycle { T12: &mut torques }));
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
    digest.result(pose.pin());
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, coupler_direction, coupler_A,
        coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, rocker_D, sin_mu_B);
}

digest!();
