use linkage_runtime::{Side, linkage, polar};

linkage! {
    pub mod machine;

    units { mm, N }

    ground     { O: (0, 0), Q: (140mm, 0) }
    link crank { O -> A: 80mm }
    link first { A -> B: 100mm }
    link rocker { Q -> B: 120mm }

    revolute O: ground -> crank;
    revolute A: crank -> first;
    revolute B: first -> rocker;
    revolute Q: ground -> rocker;

    drive side_B: O;
    assemble B: either(A -> Q);

    load closures: force(first.B);

    scene statics: equilibrium;
}

fn main() {
    let loads = machine::Loads { closures: polar(50.0, 4.0) };
    let closures = machine::Closures { B: Side::Left };
    let pose = machine::Pose::at(1.0, closures).unwrap();
    println!("{}", pose.statics(&loads).unwrap().B);
    println!("{}", machine::statics_at(1.0, closures, &loads).unwrap().O);
}
