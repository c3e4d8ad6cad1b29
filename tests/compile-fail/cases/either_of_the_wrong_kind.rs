use linkage_runtime::{Along, Side, linkage, polar};

linkage! {
    pub mod machine;

    units { mm, N }

    ground     { O: (0, 0), Q: (140mm, 0), G: (0, -50mm) }
    link crank { O -> A: 80mm }
    link first { A -> B: 100mm }
    link rocker { Q -> B: 120mm, D: (60mm, 0) }
    link rod   { D -> E: 200mm }
    link ram   { E: (0, 0) }

    revolute O: ground -> crank;
    revolute A: crank -> first;
    revolute B: first -> rocker;
    revolute Q: ground -> rocker;
    revolute D: rocker -> rod;
    revolute E: rod -> ram;
    prismatic G: ground -> ram.E along 0deg;

    drive q: O;
    assemble B: either(A);
    assemble E: either(D -> G);

    load F: force(ram.E);

    scene statics: equilibrium;
}

fn main() {
    let loads = machine::Loads { F: polar(50.0, 4.0) };
    let closures = machine::Closures { B: Along::Ahead, E: Side::Left };
    let pose = machine::Pose::at(1.0, closures).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_q);
    println!("{}", machine::statics_at(1.0, closures, &loads).unwrap().O);
}
