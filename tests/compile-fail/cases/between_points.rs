use linkage_runtime::{linkage, polar};

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
    unknown T12: thrust(crank.A0, crank.A);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;

    load S1: thrust(coupler.A, coupler.C) = 250N;
    load S2: thrust(ground.B0, coupler.C) = 250N @ 30deg;
    load S3: thrust(coupler.C) = 250N;
    load S4: thrust(ground.B0, coupler.Z);
    load S5: spring(ground, coupler.C) { rate: 2N/mm, free: 0 };
    load S6: thrust(ground.B0 -> coupler.C) = 250N;

    scene statics: equilibrium;
    scene torque: virtual_work -> (T12);
}

fn main() {
    let loads = four_bar::Loads { F13: polar(50.0, 4.0), S4: 250.0 };
    let pose = four_bar::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {} {}", all.T12, all.B.norm(), pose.coupler_C());
    println!("{}", four_bar::torque_at(1.0, &loads).unwrap().T12);
}
