use linkage_runtime::{linkage, polar};

linkage! {
    pub mod doubled;

    units { mm, N }

    ground     { A: (0, 0) }
    link crank { A -> B: 90mm, C: (60mm, 30mm) }
    link plate { B -> C: 42mm, D: (20mm, 50mm) }
    link arm   { D -> E: 70mm }

    revolute A: ground -> crank;
    revolute B: crank -> plate;
    revolute C: crank -> plate;
    revolute D: plate -> arm;

    drive phi: D;

    load F: force(arm.E);

    scene statics: equilibrium;
}

fn main() {
    let loads = doubled::Loads { F: polar(50.0, 4.0) };
    let pose = doubled::Pose::at(2.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_phi);
    println!("{}", doubled::statics_at(2.0, &loads).unwrap().C);
}
