use linkage_runtime::{linkage, polar};

linkage! {
    pub mod yoke;

    units { mm, N }

    ground     { O: (0, 0), G: (300mm, 0) }
    link crank { O -> A: 120mm }
    link block { A: (0, 0) }
    link yoke  { S: (0, 0), tip: (100mm, 0) }

    revolute  O: ground -> crank;
    revolute  A: crank -> block;
    prismatic S: yoke.S -> block.A along 0deg of yoke;
    prismatic G: ground.G -> yoke.S along 0deg;

    drive theta: O;
    load F: force(yoke.tip);

    scene statics: equilibrium;
}

fn main() {
    let loads = yoke::Loads { F: polar(50.0, 4.0) };
    let pose = yoke::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {}", all.effort_theta, all.S.normal);
    println!("{:?}", yoke::statics_at(1.0, &loads).unwrap().A);
}
