use linkage_runtime::{linkage, polar};

linkage! {
    pub mod table;

    units { mm, N }

    ground      { A0: (0, 0), B0: (200mm, 0), C0: (500mm, 0) }
    link crank  { A0 -> A: 80mm }
    link middle { B0 -> B: 80mm }
    link last   { C0 -> C: 80mm }
    link table  { A: (0, 0), B: (200mm, 0), C: (500mm, 0), G: (250mm, 40mm) }

    revolute A0: ground -> crank;
    revolute A:  crank -> table;
    revolute B0: ground -> middle;
    revolute B:  middle -> table;
    revolute C0: ground -> last;
    revolute C:  last -> table;

    drive theta: A0;

    load goods: force(table.G);

    scene statics: equilibrium;
}

fn main() {
    let loads = table::Loads { goods: polar(50.0, 4.0) };
    let pose = table::Pose::at(1.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {}", all.effort_theta, all.B.norm());
    println!("{}", table::statics_at(1.0, &loads).unwrap().effort_theta);
}
