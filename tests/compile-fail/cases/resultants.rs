use linkage_runtime::linkage;

linkage! {
    pub mod four_bar;

    units { mm, N }

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F14: force(rocker.D) = 100N @ 200deg;

    scene statics: equilibrium -> (T12, power(T13), shaking(ground.A0), ground about ground.Q);
    scene speeds: velocity -> (B, power, power(T12));
    scene shakes: acceleration -> (shaking(ground.A0), shaking(ground.Q), shaken(ground.A0));
    scene work: virtual_work -> (T12, power, ground about ground.A0);
}

fn main() {
    let motion = four_bar::Motion { theta_rate: 1.0, theta_acceleration: 0.0 };
    println!("{}", four_bar::work_at(1.0, &motion).unwrap().power);
    println!("{}", four_bar::shakes_at(1.0, &motion).unwrap().shaking_ground_A0.moment);
}
