use linkage_runtime::{linkage, polar};

linkage! {
    pub mod wheels;

    units { mm, N }

    param angle_wheel: length = 30mm;

    ground     { O: (0, 0), Q: (60mm, 0) }
    link crank { O -> A: 25mm }
    link wheel { Q -> B: angle_wheel }

    revolute O: ground -> crank;
    revolute Q: ground -> wheel;
    gear     G: crank.O -> wheel.Q, radii (40mm, 20mm);

    drive angle_crank: O;

    load angle_wheel_before: moment(wheel);
    load sin_mu_Q: force(wheel.B);
    load cos_mu_Q: moment(wheel);

    scene statics: equilibrium;
}

fn main() {
    let linkage = wheels::Linkage::new(&wheels::Params { angle_wheel: 30.0 }).unwrap();
    let loads = wheels::Loads { angle_wheel_before: 1.0, sin_mu_Q: polar(50.0, 4.0), cos_mu_Q: 2.0 };
    let pose = wheels::Pose::at(&linkage, 1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_angle_crank);
}
