use linkage_runtime::{linkage, polar};

linkage! {
    pub mod machine;

    units { mm, N }

    ground      { O: (0, 0), Q: (140mm, 0) }
    link crank  { O -> A: 80mm }
    link first  { A -> W: 50mm }
    link second { W -> B: 50mm }
    link rocker { Q -> B: 120mm }

    revolute O: ground -> crank;
    revolute A: crank -> first;
    weld W: first -> second, angle 180deg;
    revolute B: second -> rocker;
    revolute Q: ground -> rocker;

    drive q: O;
    assemble B: left(A -> Q);

    load F: force(second.B);

    scene statics: equilibrium;
}

fn main() {
    let loads = machine::Loads { F: polar(50.0, 4.0) };
    let pose = machine::Pose::at(1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_q);
    println!("{}", machine::statics_at(1.0, &loads).unwrap().O);
}
