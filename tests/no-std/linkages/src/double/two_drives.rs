//! Two drives, one of them along a rail, and a force among the unknowns; its equation of motion with forward dynamics.

use linkage_runtime::nalgebra::SVector;
use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// Two drives, one of them along a rail, and a force among the unknowns; its equation of motion.
    pub mod linkage;

    ground       { A0: (0, 0), S: (1.5m, -0.2m) }
    link crank   { A0 -> A: 0.5m }
    link left    { A -> B: 1m, C: (0.4m, 0.1m) }
    link right   { D -> B: 1.1m }
    link slide   { S: (0, 0), D: (0, 0.1m) }
    mass crank:  1.3kg at (0.2m, 0), inertia 0.02kg*m^2;
    mass left:   0.9kg at C, inertia 0.07kg*m^2;
    mass slide:  2.1kg at D;

    revolute  A0: ground -> crank;
    revolute  A:  crank  -> left;
    revolute  B:  left   -> right;
    revolute  D:  slide  -> right;
    prismatic S:  ground -> slide along 30deg;

    drive theta: A0;
    drive travel: S;
    unknown T: torque(crank -> left);
    unknown P: force(left.C) along 80deg;
    assemble B: left(A -> D);

    load F: force(right.B);
    load M: moment(slide -> right);

    scene statics: equilibrium;
    scene parts:   superposition;
    scene work:    virtual_work;
    scene place:   position;
    scene control: motion;
}

outputs! {
    linkage::Statics { T, P, A0, A, B, D, S }
    linkage::Parts { F, M }
    linkage::PartsContribution { T, P, A0, A, B, D, S }
    linkage::Work { T, P, F, M }
    linkage::WorkF { T, P }
    linkage::WorkM { T, P }
    linkage::Control { M, h, rounding }
    linkage::Place { A0, A, B, D, S, left_C, crank_angle, left_angle, right_angle, slide_angle }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, travel, p, q, _] = *input;
    let travel = 0.4 * travel - 0.2;
    let loads = linkage::Loads { F: Vector2::new(50.0 * a, 50.0 * b), M: 10.0 * c };
    digest.result(linkage::statics_at(theta, travel, &loads));
    digest.result(linkage::parts_at(theta, travel, &loads));
    digest.result(linkage::work_at(theta, travel, &loads));
    digest.result(linkage::place_at(theta, travel));
    let motion = linkage::Motion { theta_rate: 9.0 * p, travel_rate: 2.0 * q };
    digest.result(linkage::control_at(theta, travel, &motion, &loads));
    let pose = match linkage::Pose::at(theta, travel) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.statics(&loads));
    let parts = pose.parts(&loads);
    digest.result(parts);
    if let Ok(parts) = parts {
        digest.result(parts.total());
    }
    digest.result(pose.work(&loads));
    digest.result(pose.place());
    let control = pose.control(&motion, &loads);
    digest.result(control);
    if let Ok(control) = control {
        digest.result(control.acceleration(SVector::from([20.0 * p, 50.0 * q])));
    }
    accessors!(digest, pose: theta, travel, A0, A, B, D, S, crank_direction, crank_A0, crank_A, left_direction, left_A,
        left_B, left_C, right_direction, right_D, right_B, slide_direction, slide_S, slide_D, sin_mu_B);
}

digest!();
