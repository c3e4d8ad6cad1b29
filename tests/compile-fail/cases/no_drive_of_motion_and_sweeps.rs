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

    mass coupler: 2kg at C;
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;

    scene statics: equilibrium;
    scene control: motion;
    scene turn: sweep(statics);
    scene moved: inverse(B0);
    scene moves: sweep(moved);
}

fn main() {
    let loads = four_bar::Loads { F13: polar(50.0, 4.0) };
    let pose = four_bar::Pose::at().unwrap();
    println!("{}", pose.statics(&loads).unwrap().B);
    println!("{}", four_bar::statics_at(&loads).unwrap().B);
}
