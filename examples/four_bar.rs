use linkage_runtime::{linkage, polar};
linkage! {
    /// METU Example 6.3: forces on coupler and rocker, held by a torque on the crank.
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
    load F14: force(rocker.D) = 100N @ 200deg;
    scene statics: equilibrium;
    scene parts:   superposition;
    scene torque:  virtual_work(F13, F14) -> (T12);
    scene bearing: equilibrium(F14) -> (B);
    scene terms: virtual_work;
    scene pos: position;
    scene check: verify;
}
fn main() {
    let loads = four_bar::Loads { F13: polar(50.0, 230f64.to_radians()) };
    let pose = four_bar::Pose::at(60f64.to_radians()).unwrap();
    println!("{:?}", pose);
    println!("{:?}", pose.statics(&loads).unwrap());
    println!("{:?}", pose.parts(&loads).unwrap().total());
    println!("{:?}", four_bar::torque_at(60f64.to_radians(), &loads).unwrap());
    println!("{}", four_bar::EQUATIONS);
    println!("{}", four_bar::OPERATIONS);
    println!("{}", pose.check(&loads).unwrap());
}
