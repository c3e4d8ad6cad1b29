use linkage_runtime::{linkage, polar};

linkage! {
    pub mod press;

    units { mm, N }

    param run_S: length = 45mm;

    ground      { O: (0, 0), G: (5m, 0) }
    link crank  { O -> A: run_S }
    link rod    { A -> B: 150mm }
    link slider { B: (0, 0) }

    revolute O:  ground -> crank;
    revolute A:  crank  -> rod;
    revolute B:  rod    -> slider;
    prismatic S: ground.G -> slider.B along 0deg;

    assemble B: ahead(A);

    drive travel_S: O;

    load F: force(slider.B);

    scene statics: equilibrium;
}

fn main() {
    let linkage = press::Linkage::new(&press::Params { run_S: 45.0 }).unwrap();
    let loads = press::Loads { F: polar(50.0, 4.0) };
    let pose = press::Pose::at(&linkage, 1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_travel_S);
}
