use linkage_runtime::{linkage, polar};

linkage! {
    pub mod slider_crank;

    units { mm, N }

    ground      { O: (0, 0) }
    link crank  { O -> A: 30mm }
    link rod    { A -> B: 100mm }
    link piston { B }

    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> piston;
    prismatic S: ground.O -> piston.B;

    drive theta: O;
    assemble B: ahead(A);

    load P: force(piston.B);

    scene statics: equilibrium;
}

fn main() {
    let loads = slider_crank::Loads { P: polar(50.0, 4.0) };
    let pose = slider_crank::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {} {}", all.effort_theta, all.S.normal, pose.rod_B());
    println!("{:?}", slider_crank::statics_at(1.0, &loads).unwrap().B);
}
