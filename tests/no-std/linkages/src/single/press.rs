//! A press, posed by its crank and held between crank and rod: forces by a core of two equations.
//! One dimension is given at run time. The crank is found from the ram, too.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A press, posed by its crank and held between crank and rod: forces by a core of two equations.
    /// One dimension is given at run time.
    pub mod linkage;
    scalar f32;
    units { mm, N }

    param reach: length = 150mm;

    ground       { A0: (0, 0), B0: (100mm, 60mm), D: (100mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 110mm, C: (60mm, 20mm) }
    link rocker  { B0 -> B: 80mm }
    link rod     { B -> E: reach }
    link ram     { E: (0, 0), D: (0, 0), G: (10mm, -30mm) }
    mass coupler: 0.5kg at C;
    mass ram:     3kg at (0, -20mm);

    revolute  A0: ground   -> crank;
    revolute  A:  crank    -> coupler;
    revolute  B:  coupler  -> rocker;
    revolute  B0: ground   -> rocker;
    revolute  B5: rocker.B -> rod.B;
    revolute  E:  rod      -> ram;
    prismatic D:  ground   -> ram along -90deg;

    drive theta: A0;
    unknown T: torque(crank -> rod);
    assemble B: left(A -> B0);
    assemble E: ahead(B5);
    assemble B5: left(E -> B0);
    assemble A: left(A0 -> B);

    load P: force(ram.G);
    load M: moment(ground -> crank) = 2N*m;
    load W: gravity = 9.81m/s^2 @ -90deg;

    scene statics: equilibrium;
    scene parts:   superposition;
    scene work:    virtual_work;
    scene place:   position;
    scene crank_of: inverse(D);
}

outputs! {
    linkage::Statics { T, A0, A, B, B0, B5, E, D }
    linkage::Parts { P, M, W }
    linkage::PartsContribution { T, A0, A, B, B0, B5, E, D }
    linkage::PartsW { coupler, ram }
    linkage::CrankOf { theta, theta_rate, theta_acceleration }
    linkage::Work { T, P, M, W }
    linkage::WorkW { coupler, ram }
    linkage::Place { A0, A, B, B0, B5, E, D, coupler_C, ram_G, crank_angle, coupler_angle, rocker_angle, rod_angle, ram_angle }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, d, p, _, _] = *input;
    let loads = linkage::Loads { P: Vector2::new(50.0 * a, 50.0 * b) };
    let params = linkage::Params { reach: linkage::Params::default().reach * (1.0 + 0.1 * p) };
    let prepared = match linkage::Linkage::new(&params) {
        Ok(prepared) => prepared,
        Err(error) => return digest.refusal(error),
    };
    match linkage::Limits::of(&params) {
        Ok(limits) => {
            let [least, greatest] = limits.B.transmission;
            digest.put((least.angle, least.at));
            digest.put((greatest.angle, greatest.at));
        }
        Err(error) => digest.refusal(error),
    }
    let linkage = &prepared;
    digest.result(linkage::statics_at(linkage, theta, &loads));
    digest.result(linkage::parts_at(linkage, theta, &loads));
    digest.result(linkage::work_at(linkage, theta, &loads));
    digest.result(linkage::place_at(linkage, theta));
    let motion = linkage::CrankOfMotion { D_travel_rate: 100.0 * c, D_travel_acceleration: 1000.0 * d };
    digest.result(linkage::crank_of_at(linkage, 120.0 + 90.0 * a, &motion));
    let pose = match linkage::Pose::at(linkage, theta) {
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
    accessors!(digest, pose: theta, A0, A, B, B0, B5, E, D, crank_direction, crank_A0, crank_A, coupler_direction,
        coupler_A, coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, rod_direction, rod_B, rod_E,
        ram_direction, ram_E, ram_D, ram_G, sin_mu_B, sin_mu_E, travel_D);
}

digest!();
