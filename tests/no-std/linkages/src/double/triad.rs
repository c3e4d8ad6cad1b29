//! A triad, placed by iteration; held between two of its links: forces by a core of more than three equations.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A triad, placed by iteration; held between two of its links: forces by a core of more than three equations.
    pub mod linkage;

    ground     { O: (0, 0), Q: (0.5m, 0.1m), P: (0.4m, -0.1m) }
    link crank { O -> A: 0.028m }
    link rod   { A -> E: 0.23m }
    link plate { E: (0, 0), C: (0.1m, 0.07m), D: (0.07m, -0.09m), G: (0.05m, 0) }
    link upper { Q -> C: 0.192m }
    link lower { P -> D: 0.18m }
    mass plate: 0.4kg at G;

    revolute O: ground -> crank;
    revolute A: crank  -> rod;
    revolute E: rod    -> plate;
    revolute C: plate  -> upper;
    revolute D: plate  -> lower;
    revolute Q: ground -> upper;
    revolute P: ground -> lower;

    drive theta: O;
    unknown T: torque(rod -> plate);

    start theta: 30deg;
    start rod:   (0.03m, 0.02m), angle 30deg;
    start plate: (0.24m, 0.14m), angle 0;
    start upper: (0.5m, 0.1m), angle 140deg;
    start lower: (0.4m, -0.1m), angle 120deg;

    load F: force(plate.G);
    load W: gravity = 9.81m/s^2 @ -90deg;

    scene statics: equilibrium;
    scene parts:   superposition;
    scene work:    virtual_work;
    scene place:   position;
    scene slopes:  derivative(statics) by (theta, F);
}

outputs! {
    linkage::Statics { T, O, A, E, C, D, Q, P }
    linkage::Parts { F, W }
    linkage::PartsContribution { T, O, A, E, C, D, Q, P }
    linkage::PartsW { plate }
    linkage::Work { T, F, W }
    linkage::WorkW { plate }
    linkage::Place { O, A, E, C, D, Q, P, plate_G, crank_angle, rod_angle, plate_angle, upper_angle, lower_angle }
    linkage::Slopes { theta, F }
    linkage::SlopesTheta { T, O, A, E, C, D, Q, P }
    linkage::SlopesF { x, y }
    linkage::SlopesFX { T, O, A, E, C, D, Q, P }
    linkage::SlopesFY { T, O, A, E, C, D, Q, P }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, _, _, _, _] = *input;
    let loads = linkage::Loads { F: Vector2::new(50.0 * a, 50.0 * b) };
    digest.result(linkage::statics_at(theta, &loads));
    digest.result(linkage::parts_at(theta, &loads));
    digest.result(linkage::work_at(theta, &loads));
    digest.result(linkage::place_at(theta));
    digest.result(linkage::slopes_at(theta, &loads));
    let pose = match linkage::Pose::at(theta).and_then(|pose| pose.moved_to(theta + 0.1 * c)) {
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
    digest.result(pose.slopes(&loads));
    accessors!(digest, pose: theta, O, A, E, C, D, Q, P, crank_direction, crank_O, crank_A, rod_direction, rod_A, rod_E,
        plate_direction, plate_E, plate_C, plate_D, plate_G, upper_direction, upper_Q, upper_C, lower_direction,
        lower_P, lower_D);
}

digest!();
