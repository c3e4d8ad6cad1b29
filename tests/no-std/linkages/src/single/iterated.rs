//! A group of class IV with a slide, placed by iteration in single precision. One dimension is given at run time.

use linkage_runtime::{Series, Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A group of class IV with a slide, placed by iteration in single precision. One dimension is given at run time.
    pub mod linkage;
    scalar f32;

    param reach: length = 2.3m;

    ground      { O: (0, 0), B: (4.9m, 0.2m) }
    link crank  { O -> A: 0.15m }
    link left   { A: (0, 0), C: (1.5m, 1m), D: (1.6m, -0.6m), G: (1m, 1m) }
    link right  { B: (0, 0), E: (-1.4m, 1.2m), F: (-1m, -1.2m) }
    link upper  { C -> E: reach }
    link lower  { D: (0.1m, 0.2m), S: (1.95m, 0.3m) }
    link runner { S: (0.1m, 0), F: (0.6m, 0.2m) }

    revolute  O: ground -> crank;
    revolute  A: crank  -> left;
    revolute  B: ground -> right;
    revolute  C: left   -> upper;
    revolute  E: upper  -> right;
    revolute  D: left   -> lower;
    prismatic S: lower  -> runner along 10deg of lower, angle 20deg;
    revolute  F: runner -> right;

    drive theta: O;
    drive x: S;

    start theta: 20deg;
    start x: 0.3m;
    start left:   (0.15m, 0.05m), angle 0;
    start right:  (4.9m, 0.2m), angle 0;
    start upper:  (1.65m, 1m), angle 10deg;
    start lower:  (1.7m, -0.7m), angle -20deg;
    start runner: (3.7m, -1.1m), angle 0;

    load L: force(left.G);
    load M: moment(right) = 2N*m;

    scene statics: equilibrium;
    scene torque:  virtual_work -> (effort_theta, effort_x);
    scene place:   position -> (E, left.G, right.angle);
    scene cycle:   sweep(torque);
}

outputs! {
    linkage::Statics { effort_theta, effort_x, O, A, B, C, E, D, S, F }
    linkage::Torque { effort_theta, effort_x }
    linkage::Place { E, left_G, right_angle }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, _, p, _, _] = *input;
    let x = 0.3 + 0.03 * c;
    let loads = linkage::Loads { L: Vector2::new(50.0 * a, 50.0 * b) };
    let params = linkage::Params { reach: linkage::Params::default().reach * (1.0 + 0.02 * p) };
    let prepared = match linkage::Linkage::new(&params) {
        Ok(prepared) => prepared,
        Err(error) => return digest.refusal(error),
    };
    let linkage = &prepared;
    digest.result(linkage::statics_at(linkage, theta, x, &loads));
    digest.result(linkage::torque_at(linkage, theta, x, &loads));
    digest.result(linkage::place_at(linkage, theta, x));
    let thetas = [theta, theta + 0.1 * a, theta - 0.1 * b];
    let inputs = linkage::CycleInputs {
        theta: Series::Each(&thetas),
        x: Series::Constant(x),
        L: Series::Each(&[loads.L, loads.L, Vector2::new(c, p)]),
    };
    let (mut of_theta, mut of_x) = ([0.0; 3], [0.0; 3]);
    let results = linkage::Cycle { effort_theta: &mut of_theta, effort_x: &mut of_x };
    digest.sweep(linkage::cycle(linkage, &inputs, results));
    let ([t, u, v], [x1, x2, x3]) = (of_theta, of_x);
    digest.put((((t, u), (v, x1)), (x2, x3)));
    let pose = match linkage::Pose::at(linkage, theta, x).and_then(|pose| pose.moved_to(theta + 0.1 * a, x)) {
        Ok(pose) => pose,
        Err(error) => return digest.refusal(error),
    };
    digest.result(pose.statics(&loads));
    digest.result(pose.torque(&loads));
    digest.result(pose.place());
    accessors!(digest, pose: theta, x, O, A, B, C, E, D, S, F, crank_direction, crank_O, crank_A, left_direction, left_A,
        left_C, left_D, left_G, right_direction, right_B, right_E, right_F, upper_direction, upper_C, upper_E,
        lower_direction, lower_D, lower_S, runner_direction, runner_S, runner_F);
}

digest!();
