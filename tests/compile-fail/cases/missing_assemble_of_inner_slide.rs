use linkage_runtime::{linkage, polar};

linkage! {
    pub mod block;

    units { mm, N }

    ground     { O: (0, 0), C: (400mm, -60mm) }
    link crank { O -> A: 120mm }
    link rod   { A: (0, 0), tip: (600mm, 0) }
    link block { C: (0, 0) }

    revolute  O: ground -> crank;
    revolute  A: crank -> rod;
    prismatic S: rod.A -> block.C along 0deg of rod;
    revolute  C: ground -> block;

    drive theta: O;

    load F: force(rod.tip);

    scene statics: equilibrium;
}

fn main() {
    let loads = block::Loads { F: polar(50.0, 4.0) };
    let pose = block::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {} {}", all.effort_theta, all.S.normal, pose.reach_S());
    println!("{:?}", block::statics_at(1.0, &loads).unwrap().C);
}
