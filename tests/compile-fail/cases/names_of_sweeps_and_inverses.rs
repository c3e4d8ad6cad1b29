use linkage_runtime::{Series, linkage};

linkage! {
    /// The second of two names is refused, whichever it is; the first can be used.
    pub mod four_bar;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm }
    link rocker  { B0 -> B: 80mm }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);
    assemble A: left(A0 -> B);
    load M: moment(rocker);

    scene statics: equilibrium;
    scene r: sweep(statics);
    scene r_inputs: equilibrium;
    scene q_motion: position;
    scene q: inverse(B0);
    scene p: inverse(B0);
    scene p_at: sweep(statics);
    scene s: sweep(p);
    scene s_inputs: inverse(B0);
    scene statics_at: position;
    scene pose: sweep(statics);
    scene LIMITS: sweep(statics);
    scene parts: superposition;
    scene parts_contribution: position;
}

linkage! {
    /// A load that is called like a rate is told once, however many sweeps have both.
    pub mod moved;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm, C: (60mm, 30mm) }
    link rocker  { B0 -> B: 80mm }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0);
    mass rocker: 1kg at B;
    load theta_rate: force(coupler.C);
    load I: inertia;
    scene statics: equilibrium;
    scene work: virtual_work;
    scene cycle: sweep(statics);
    scene works: sweep(work);
}

fn main() {
    let loads = four_bar::Loads { M: 2.0 };
    let pose = four_bar::Pose::at(1.0).unwrap();
    println!("{}", pose.r_inputs(&loads).unwrap().T12 + pose.q_motion().unwrap().B.x);
    let mut theta = [1.0; 2];
    let results = four_bar::R { T12: &mut theta, A0_x: &mut [], A0_y: &mut [], A_x: &mut [], A_y: &mut [], B_x: &mut [], B_y: &mut [], B0_x: &mut [], B0_y: &mut [] };
    four_bar::r(&four_bar::RInputs { theta: Series::Constant(1.0), M: Series::Constant(2.0) }, results).unwrap();
    println!("{}", four_bar::q_at(1.0, &four_bar::QMotion { B0_angle_rate: 1.0, B0_angle_acceleration: 0.0 }).unwrap().theta);
}
