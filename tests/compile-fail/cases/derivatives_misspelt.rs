use linkage_runtime::{Error, linkage, polar};

linkage! {
    pub mod four_bar;

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

    scene statics: equilibrium;
    scene torque: virtual_work -> (T12);
    scene a: derivative() by (theta);
    scene b: derivative(statics);
    scene c: derivative statics by theta;
    scene d: derivative(statics, torque) by (theta);
    scene e: derivative(statics) by (theta) -> (T12);
}

fn main() -> Result<(), Error> {
    let loads = four_bar::Loads { F13: polar(50.0, 4.0) };
    let pose = four_bar::Pose::at(1.0)?;
    println!("{}", pose.statics(&loads)?.T12);
    println!("{}", four_bar::torque_at(1.0, &loads)?.T12);
    println!("{}", four_bar::c_at(1.0, &loads)?.theta.T12);
    println!("{} {}", four_bar::d_at(1.0, &loads)?.theta.T12, four_bar::e_at(1.0, &loads)?.theta.T12);
    Ok(())
}
