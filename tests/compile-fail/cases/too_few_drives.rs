use linkage_runtime::{linkage, polar};

linkage! {
    pub mod five_bar;

    units { mm, N }

    ground     { A: (0, 0), E: (200mm, 0) }
    link left  { A -> B: 90mm }
    link lower { B -> C: 120mm }
    link upper { C -> D: 120mm }
    link right { E -> D: 90mm }

    revolute A: ground -> left;
    revolute B: left -> lower;
    revolute C: lower -> upper;
    revolute D: upper -> right;
    revolute E: right -> ground;

    drive alpha: A;
    assemble C: left(B -> D);

    load F: force(lower.C);

    scene statics: equilibrium;
}

fn main() {
    let loads = five_bar::Loads { F: polar(50.0, 4.0) };
    let pose = five_bar::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {} {}", all.effort_alpha, all.B, pose.C());
    println!("{}", five_bar::statics_at(1.0, &loads).unwrap().effort_alpha);
}
