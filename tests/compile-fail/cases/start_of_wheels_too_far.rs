use linkage_runtime::{linkage, polar};

linkage! {
    pub mod rolling;

    units { mm, N }

    ground     { O: (0, 0), R: (140mm, 30mm) }
    link crank { R -> A: 25mm }
    link arm   { O -> J: 60mm }
    link wheel { J: (0, 0), E: (45mm, 0) }
    link rod   { A -> E: 70mm }

    revolute R: ground -> crank;
    revolute O: ground -> arm;
    revolute J: arm -> wheel;
    revolute A: crank -> rod;
    revolute E: rod -> wheel;
    gear     G: ground.O -> wheel.J, radii (40mm, 20mm);

    drive theta: R;

    start theta: 90deg;
    start arm: (0, 0), angle 200deg;
    start wheel: (60mm, 0), angle 0deg;
    start rod: (140mm, 55mm), angle 0deg;

    load F: force(wheel.E);

    scene statics: equilibrium;
}

fn main() {
    let loads = rolling::Loads { F: polar(50.0, 4.0) };
    let pose = rolling::Pose::at(1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_theta);
    println!("{}", rolling::statics_at(1.0, &loads).unwrap().G.tangential);
}
