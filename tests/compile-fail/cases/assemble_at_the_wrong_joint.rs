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
    unknown T12: torque(ground -> crank);
    assemble A: left(A0 -> B);

    load F13: force(coupler.C);

    scene statics: equilibrium;
    scene torque: virtual_work -> (T12);
}

linkage! {
    /// Two dyads, each with a side at one of its outer joints.
    pub mod six_bar;

    ground       { A0: (0, 0), B0: (140mm, 0), C0: (300mm, 20mm) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm, D: (60mm, 50mm) }
    link rocker  { B0 -> B: 80mm }
    link rod     { D -> E: 170mm }
    link last    { C0 -> E: 90mm }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    revolute D:  coupler -> rod;
    revolute E:  rod     -> last;
    revolute C0: ground  -> last;

    drive theta: A0;
    assemble C0: left(D -> E);
    assemble B0: left(A -> B);

    scene places: position;
}

fn main() {
    let loads = four_bar::Loads { F13: polar(50.0, 4.0) };
    let pose = four_bar::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {} {}", all.T12, all.B.norm(), pose.coupler_C());
    println!("{}", four_bar::torque_at(1.0, &loads).unwrap().T12);
}
