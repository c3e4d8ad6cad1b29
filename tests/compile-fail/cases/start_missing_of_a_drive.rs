use linkage_runtime::{linkage, polar};

linkage! {
    pub mod stephenson;

    units { mm, N }

    ground      { A: (0, 0), F: (150mm, 0), G: (250mm, 0) }
    link crank  { A -> B: 40mm }
    link plate  { B -> C: 100mm, D: (50mm, 60mm) }
    link left   { F -> C: 90mm }
    link rod    { D -> E: 110mm }
    link right  { G -> E: 100mm }

    revolute A: ground -> crank;
    revolute B: crank -> plate;
    revolute C: plate -> left;
    revolute F: ground -> left;
    revolute D: plate -> rod;
    revolute E: rod -> right;
    revolute G: ground -> right;

    drive theta: G;

    start crank: (0, 0), angle 90deg;
    start plate: (0, 40mm), angle 140deg;
    start left:  (150mm, 0), angle -160deg;
    start rod:   (80mm, 40mm), angle 20deg;

    load W: force(plate.D);

    scene statics: equilibrium;
}

fn main() {
    let loads = stephenson::Loads { W: polar(50.0, 4.0) };
    let pose = stephenson::Pose::at(1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_theta);
    println!("{}", stephenson::statics_at(1.0, &loads).unwrap().B);
}
