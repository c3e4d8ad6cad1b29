use linkage_runtime::{linkage, polar};

linkage! {
    pub mod machine;

    units { mm, N }

    ground     { O: (0, 0), Q: (0, -350mm) }
    link crank { O -> A: 140mm }
    link lever { Q -> B: 720mm }

    revolute O: ground -> crank;
    revolute Q: ground -> lever;
    slot S: lever.Q -> crank.A along 0deg of lever;

    drive q: S.travel;

    load F: force(lever.B);

    scene statics: equilibrium;
}

fn main() {
    let loads = machine::Loads { F: polar(50.0, 4.0) };
    let pose = machine::Pose::at(1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_q);
    println!("{}", machine::statics_at(1.0, &loads).unwrap().O);
}
