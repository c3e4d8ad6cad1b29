use linkage_runtime::{linkage, polar};

linkage! {
    pub mod four-bar;

    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank_1 { A0 -> A: 80mm }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker-1 { B0 -> B: 120mm, D: (90mm, 0) }

    revolute A0: ground  -> crank-1;
    revolute A:  crank_1 -> coupler;
    revolute B:  coupler -> rocker-1;
    revolute B0: ground  -> rocker-1;

    drive theta: A0;
    unknown T12: torque(ground -> crank_1);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);

    scene statics: equilibrium;
    scene torque: virtual_work -> (T12);
}

fn main() {
    let loads = four_bar::Loads { F13: polar(50.0, 4.0) };
    let pose = four_bar::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {} {}", all.T12, all.B.norm(), pose.coupler_C());
    println!("{}", four_bar::torque_at(1.0, &loads).unwrap().T12);
}
