use linkage_runtime::linkage;

linkage! {
    pub mod massless;
    ground     { O: (0, 0) }
    link lever { O -> P: 250mm }
    revolute O: ground -> lever;
    drive theta: O;
    load F: force(lever.P) = (0, -3N);
    scene control: motion;
}

linkage! {
    pub mod lever;
    ground     { O: (0, 0) }
    link lever { O -> P: 250mm }
    mass lever: 2kg at (100mm, 0);
    revolute O: ground -> lever;
    drive theta: O;
    load F: force(lever.P) = (0, -3N);
    scene control: motion(F) -> (M, h, O);
    scene moved: motion -> (M, effort_theta, lever.P);
    scene twice: motion -> (M, M);
    scene of_what: motion(G);
    scene sound: motion;
}

fn main() {
    let motion = lever::Motion { theta_rate: 1.0 };
    let pose = lever::Pose::at(1.0).unwrap();
    println!("{}", pose.control(&motion).unwrap().M);
    println!("{}", pose.sound(&motion).unwrap().acceleration(3.0).unwrap());
    println!("{}", massless::control_at(1.0, &massless::Motion { theta_rate: 1.0 }).unwrap().h);
}
