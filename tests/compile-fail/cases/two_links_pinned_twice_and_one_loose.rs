use linkage_runtime::{linkage, polar};

linkage! {
    pub mod doubled;

    units { mm, N }

    ground     { A: (0, 0), F: (200mm, 0) }
    link crank { A -> B: 90mm, C: (60mm, 30mm) }
    link plate { B -> C: 42mm, D: (20mm, 50mm) }
    link arm   { D -> E: 70mm }
    link rocker { F -> E: 100mm }

    revolute A: ground -> crank;
    revolute B: crank -> plate;
    revolute C: crank -> plate;
    revolute D: plate -> arm;
    revolute E: arm -> rocker;
    revolute F: ground -> rocker;

    drive theta: A;

    load F1: force(arm.E);

    scene statics: equilibrium;
}

fn main() {
    let loads = doubled::Loads { F1: polar(50.0, 4.0) };
    let pose = doubled::Pose::at(1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_theta);
    println!("{}", doubled::statics_at(1.0, &loads).unwrap().C);
}
