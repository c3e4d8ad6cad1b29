use linkage_runtime::{linkage, polar};

linkage! {
    pub mod four_bar;

    units { mm, N }

    param inverse_sin_mu_B: length = 80mm;

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: inverse_sin_mu_B }
    link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
    link rocker  { B0 -> B: 120mm }

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: left(A -> B0);

    load arm_coupler_A_C: force(coupler.C);
    load arm_coupler_A_B: moment(rocker) = 3N*m;

    scene statics: equilibrium;
}

fn main() {
    let linkage = four_bar::Linkage::new(&four_bar::Params { inverse_sin_mu_B: 80.0 }).unwrap();
    let loads = four_bar::Loads { arm_coupler_A_C: polar(50.0, 4.0) };
    let pose = four_bar::Pose::at(&linkage, 1.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_theta);
}
