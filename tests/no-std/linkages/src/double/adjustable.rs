//! A crank-rocker whose dimensions and mass are given at run time.

use linkage_runtime::{Vector2, linkage};

use crate::digest::{Digest, accessors, digest, outputs};

linkage! {
    /// A crank-rocker whose dimensions and mass are given at run time.
    pub mod linkage;
    units { mm, N }

    param crank_length: length = 80mm;
    param base: length = 140mm;
    param tilt: angle = 10deg;
    param coupler_mass: mass = 0.4kg;

    ground       { A0: (0, 0), B0: base @ tilt }
    link crank   { A0 -> A: crank_length }
    link coupler { A -> B: 100mm, C: (crank_length / 2, 20mm) }
    link rocker  { B0 -> B: 120mm }
    mass coupler: coupler_mass at C, inertia 300kg*mm^2;
    mass rocker:  0.3kg at (60mm, 0);

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: right(A -> B0);

    load F: force(coupler.C) in coupler;
    load M: moment(crank -> rocker);
    load W: gravity = 9.81m/s^2 @ -90deg;

    scene statics: equilibrium;
    scene parts:   superposition;
    scene work:    virtual_work;
    scene held:    virtual_work(W) -> (effort_theta);
    scene place:   position;
    scene slopes:  derivative(held) by (theta, crank_length, tilt, coupler_mass);
}

outputs! {
    linkage::Statics { effort_theta, A0, A, B, B0 }
    linkage::Parts { F, M, W }
    linkage::PartsContribution { effort_theta, A0, A, B, B0 }
    linkage::PartsW { coupler, rocker }
    linkage::Work { effort_theta, F, M, W }
    linkage::WorkW { coupler, rocker }
    linkage::Held { effort_theta }
    linkage::Place { A0, A, B, B0, coupler_C, crank_angle, coupler_angle, rocker_angle }
    linkage::Slopes { theta, crank_length, tilt, coupler_mass }
    linkage::SlopesTheta { effort_theta }
    linkage::SlopesCrankLength { effort_theta }
    linkage::SlopesTilt { effort_theta }
    linkage::SlopesCouplerMass { effort_theta }
}

/// Calls everything.
pub fn solve(input: &super::Inputs, digest: &mut Digest) {
    let [theta, a, b, c, mass, p, q, r] = *input;
    let loads = linkage::Loads { F: Vector2::new(50.0 * a, 50.0 * b), M: 1e3 * c };
    let default = linkage::Params::default();
    let params = linkage::Params {
        crank_length: default.crank_length * (1.0 + 0.5 * p),
        base: default.base * (1.0 + 0.2 * q),
        tilt: default.tilt + r,
        coupler_mass: default.coupler_mass * (1.0 + mass),
    };
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
    digest.result(linkage::held_at(linkage, theta));
    digest.result(linkage::place_at(linkage, theta));
    digest.result(linkage::slopes_at(linkage, theta));
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
    digest.result(pose.held());
    digest.result(pose.place());
    digest.result(pose.slopes());
    accessors!(digest, pose: theta, A0, A, B, B0, crank_direction, crank_A0, crank_A, coupler_direction, coupler_A,
        coupler_B, coupler_C, rocker_direction, rocker_B0, rocker_B, sin_mu_B);
}

digest!();
