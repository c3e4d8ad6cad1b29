//! The run-time crate may have another name.

extern crate linkage_runtime as renamed;

/// Nothing is left of the own name in this module's path.
mod linkage_runtime {}

use renamed::{Error, linkage, polar};

linkage! {
    mod four_bar;
    crate = ::renamed;
    units { mm, N }

    param l2: length = 80mm;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: l2 }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker  { B0 -> B: 120mm }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: left(A -> B0);
    load F: force(coupler.C);
    scene statics: equilibrium;
    scene terms:   virtual_work;
}

fn main() -> Result<(), Error> {
    let linkage = four_bar::Linkage::new(&four_bar::Params { l2: 90.0 })?;
    let loads = four_bar::Loads { F: polar(50.0, 4.0) };
    let pose = four_bar::Pose::at(&linkage, 1.0)?;
    let (all, terms) = (pose.statics(&loads)?, pose.terms(&loads)?);
    assert!((all.effort_theta - terms.effort_theta).abs() < 1e-9);
    Ok(())
}
