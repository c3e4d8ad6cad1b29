use linkage_runtime::linkage;

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

    drive LIMITS: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;

    scene limits: position;
}

// What is known of its loop has its names in spite of the errors.
fn main() {
    let four_bar = four_bar::LIMITS.B;
    println!("{:?} {:?} {:?}", four_bar.class, four_bar.range, four_bar.dead_centres[0].map(|dead| dead.at));
}
