use linkage_runtime::{linkage, polar};

linkage! {
    pub mod cylinder;

    units { mm, N }

    ground      { A: (0, 0), C: (200mm, 0) }
    link tube   { A: (0, 0), P: (50mm, 0) }
    link rod    { P: (0, 0), B: (60mm, 0) }
    link arm    { C -> B: 120mm }

    revolute  A: ground -> tube;
    prismatic P: tube -> rod along 0deg;
    revolute  B: rod -> arm;
    revolute  C: ground -> arm;

    drive stroke: P;
    assemble B: left(A -> C);

    load F: force(arm.B);

    scene statics: equilibrium;
}

fn main() {
    let loads = cylinder::Loads { F: polar(50.0, 4.0) };
    let pose = cylinder::Pose::at(90.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {}", all.effort_stroke, all.P.couple);
}
