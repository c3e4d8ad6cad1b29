//! A slider-crank with the weight of its links, and its equation of motion.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A slider-crank with the weight of its links.
    pub mod linkage;
    scalar f32;
    units { mm, N }

    ground       { A0: (0, 0), C: (0, 15mm) }
    link crank   { A0 -> A: 50mm }
    link rod     { A -> B: 180mm, G: (60mm, 0) }
    link piston  { B: (0, 0), C: (0, 0), D: (20mm, 0) }
    mass crank:  0.8kg at (10mm, 0);
    mass rod:    0.4kg at G, inertia 1900kg*mm^2;
    mass piston: 0.3kg at D;

    revolute  A0: ground -> crank;
    revolute  A:  crank  -> rod;
    revolute  B:  rod    -> piston;
    prismatic C:  ground -> piston along 0deg;

    drive theta: A0;
    assemble B: ahead(A);

    load P: force(piston.D) in piston;
    load W: gravity = 9.81m/s^2 @ -90deg;

    scene statics: equilibrium;
    scene guide:   equilibrium(W) -> (C);
    scene parts:   superposition;
    scene work:    virtual_work;
    scene torque:  virtual_work -> (effort_theta);
    scene place:   position;
    scene stroke:  position -> (piston.D);
    scene control: motion;
}

outputs! {
    linkage::Statics { effort_theta, A0, A, B, C }
    linkage::Guide { C }
    linkage::Parts { P, W }
    linkage::PartsContribution { effort_theta, A0, A, B, C }
    linkage::PartsW { crank, rod, piston }
    linkage::Work { effort_theta, P, W }
    linkage::WorkW { crank, rod, piston }
    linkage::Torque { effort_theta }
    linkage::Place { A0, A, B, C, rod_G, piston_D, crank_angle, rod_angle, piston_angle }
    linkage::Stroke { piston_D }
    linkage::Control { M, h, rounding }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, _, _, p, q, _] = *input;
    let loads = linkage::Loads { P: Vector2::new(50.0 * a, 50.0 * b) };
    digest.result(linkage::statics_at(theta, &loads));
    digest.result(linkage::guide_at(theta));
    digest.result(linkage::parts_at(theta, &loads));
    digest.result(linkage::work_at(theta, &loads));
    digest.result(linkage::torque_at(theta, &loads));
    digest.result(linkage::place_at(theta));
    digest.result(linkage::stroke_at(theta));
    let motion = linkage::Motion { theta_rate: 30.0 * p };
    digest.result(linkage::control_at(theta, &motion, &loads));
    let pose = match linkage::Pose::at(theta) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.statics(&loads));
    digest.result(pose.guide());
    let parts = pose.parts(&loads);
    digest.result(parts);
    if let Ok(parts) = parts {
        digest.result(parts.total());
        digest.result(parts.W.total());
    }
    digest.result(pose.work(&loads));
    digest.result(pose.torque(&loads));
    digest.result(pose.place());
    digest.result(pose.stroke());
    let control = pose.control(&motion, &loads);
    digest.result(control);
    if let Ok(control) = control {
        digest.result(control.acceleration(200.0 * q));
    }
    accessors!(digest, pose: theta, A0, A, B, C, crank_direction, crank_A0, crank_A, rod_direction, rod_A, rod_B,
        rod_G, piston_direction, piston_B, piston_C, piston_D, sin_mu_B, travel_C);
}

digest!();
