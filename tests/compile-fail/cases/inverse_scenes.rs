use linkage_runtime::{Series, linkage};

linkage! {
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
    assemble B: left(A -> B0);
    scene places: position;
    scene nothing: inverse;
    scene two: inverse(B0, B);
    scene no_joint: inverse(C0);
    scene travel: inverse(B0.travel);
    scene reaction: inverse(B0) -> (B);
    scene jerk: inverse(B0) -> (theta.jerk);
    scene twice: inverse(B0) -> (theta, theta);
    scene swept: sweep(two);
    scene cycle: sweep(twoo);
    scene two_at: sweep(twice);
    scene slope: derivative(twice) by (theta);
}

linkage! {
    /// Sound, but for the side of the dyad that the crank and the coupler make.
    pub mod open;
    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm }
    link rocker  { B0 -> B: 80mm }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0);
    scene crank_of: inverse(B0);
    scene cycle: sweep(crank_of);
}

linkage! {
    /// From its last link a Stephenson linkage has no closed form.
    pub mod stephenson;
    ground       { A0: (0, 0), B0: (140mm, 0), C0: (300mm, 20mm) }
    link crank   { A0 -> A: 40mm }
    link coupler { A -> B: 120mm, D: (60mm, 50mm) }
    link rocker  { B0 -> B: 80mm }
    link rod     { D -> E: 170mm }
    link last    { C0 -> E: 90mm }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    revolute D:  coupler -> rod;
    revolute E:  rod     -> last;
    revolute C0: ground  -> last;
    drive theta: A0;
    assemble B: left(A -> B0);
    assemble E: left(D -> C0);
    scene crank_of: inverse(C0);
}

linkage! {
    /// A parallelogram that moves on through its folds.
    pub mod parallelogram;
    ground       { A0: (0, 0), B0: (200mm, 0) }
    link crank   { A0 -> A: 60mm }
    link coupler { A -> B: 200mm }
    link rocker  { B0 -> B: 60mm }
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0) smooth at 60deg;
    assemble A: left(A0 -> B);
    scene crank_of: inverse(B0);
}

fn main() {
    println!("{}", open::crank_of_at(1.0, &open::CrankOfMotion::default()).unwrap().theta);
    let (mut theta, mut rates, mut accelerations) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let inputs = open::CycleInputs {
        B0_angle: Series::Each(&[1.0, 1.1]),
        B0_angle_rate: Series::Constant(2.0),
        B0_angle_acceleration: Series::Constant(0.0),
    };
    let results = open::Cycle { theta: &mut theta, theta_rate: &mut rates, theta_acceleration: &mut accelerations };
    open::cycle(&inputs, results).unwrap();
    println!("{}", four_bar::travel_at(1.0, &four_bar::TravelMotion::default()).unwrap().theta_rate);
}
