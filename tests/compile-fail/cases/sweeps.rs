use linkage_runtime::{Series, linkage, polar};

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

    scene cycle: sweep(torque);
    scene a: sweep;
    scene b: sweep(statics, torque);
    scene c: sweep(static);
    scene d: sweep(cycle);
    scene e: sweep(statics) -> (T12);
}

fn main() {
    let loads = four_bar::Loads { F13: polar(50.0, 4.0) };
    println!("{}", four_bar::torque_at(1.0, &loads).unwrap().T12);
    let mut torque = [0.0; 2];
    let inputs = four_bar::CycleInputs { theta: Series::Each(&[1.0, 2.0]), F13: Series::Constant(polar(50.0, 4.0)) };
    four_bar::cycle(&inputs, four_bar::Cycle { T12: &mut torque }).unwrap();
}
