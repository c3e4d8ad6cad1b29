//! A slider-crank in fused arithmetic, at single positions and swept, and sines and cosines in fused operations of both scalars.
//!
//! Not among what is proven to do without double precision: where the processor has no fused operation in single precision, the compiler's
//! own routine for it computes in double.

use linkage_runtime::{Series, Vector2, linkage, math};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A slider-crank.
    pub mod linkage;
    units { mm, N }
    arithmetic fused;

    ground      { O: (0, 0), P: (0, 10mm) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: 140mm, C: (60mm, 10mm) }
    link piston { B }

    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.P -> piston.B along 0deg;

    drive theta: O;
    unknown T: torque(ground -> crank);
    assemble B: ahead(A);

    load F: force(rod.C);

    scene held:  equilibrium -> (T, A, S);
    scene cycle: sweep(held);
}

outputs! {
    linkage::Held { T, A, S }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, ..] = *input;
    #[allow(clippy::cast_possible_truncation, reason = "any number serves")]
    let (single, part) = (theta as f32, 1e-8 * b as f32);
    digest.put(math::f32::fused_sin_cos(single));
    digest.put(math::f32::fused_sin_cos_half(single));
    digest.put(math::f32::fused_sin_cos_sum(single, 1.25, part));
    digest.put(math::f64::fused_sin_cos(theta));
    digest.put(math::f64::fused_sin_cos_half(theta));
    digest.put(math::f64::fused_sin_cos_sum(theta, 1.25, 1e-17 * b));
    let loads = linkage::Loads { F: Vector2::new(50.0 * a, 50.0 * b) };
    digest.result(linkage::held_at(theta, &loads));
    let thetas = [theta, theta + a, theta - b, b, c];
    let inputs = linkage::CycleInputs { theta: Series::Each(&thetas), F: Series::Constant(loads.F) };
    let [mut torque, mut pin_x, mut pin_y] = [[0.0; 5]; 3];
    let [mut force_x, mut force_y, mut normal, mut couple] = [[0.0; 5]; 4];
    let results = linkage::Cycle {
        T: &mut torque,
        A_x: &mut pin_x,
        A_y: &mut pin_y,
        S_force_x: &mut force_x,
        S_force_y: &mut force_y,
        S_normal: &mut normal,
        S_couple: &mut couple,
    };
    digest.sweep(linkage::cycle(&inputs, results));
    let all = [torque, pin_x, pin_y, force_x, force_y, normal, couple];
    let mut results = all.as_slice();
    // By patterns: an iterator keeps a way to panic in unoptimised builds.
    while let [[p, q, r, s, t], others @ ..] = results {
        digest.put((((*p, *q), (*r, *s)), *t));
        results = others;
    }
    let pose = match linkage::Pose::at(theta) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.held(&loads));
    accessors!(digest, pose: theta, O, A, B, S, crank_direction, crank_O, crank_A, rod_direction, rod_A, rod_B,
        rod_C, piston_direction, piston_B, sin_mu_B, travel_S);
}

digest!();
