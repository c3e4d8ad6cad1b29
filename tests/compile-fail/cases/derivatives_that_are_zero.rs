use linkage_runtime::{Error, linkage, polar};

linkage! {
    pub mod four_bar;

    units { mm, N }

    param reach: length = 100mm;
    param weight: mass = 2kg;

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: reach, C: (60mm, 20mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }
    mass rocker: weight at (60mm, 0);

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D);
    load W: gravity = 9.81m/s^2 @ -90deg;

    scene statics: equilibrium(F13);
    scene place: position -> (A);
    scene slopes: derivative(statics) by (theta, F13, F14, weight);
    scene moved: derivative(place) by (theta, reach, theta.rate);
    scene reduced: motion(F13);
    scene linear: derivative(reduced) by (theta, theta.rate, theta.acceleration, F13, F14, weight);
    scene blurred: motion -> (rounding);
    scene sharp: derivative(blurred) by (theta);
}

fn main() -> Result<(), Error> {
    let linkage = four_bar::Linkage::new(&four_bar::Params::default())?;
    let loads = four_bar::Loads { F13: polar(50.0, 4.0), F14: polar(1.0, 2.0) };
    let slopes = four_bar::slopes_at(&linkage, 1.0, &loads)?;
    println!("{} {}", slopes.theta.T12, slopes.weight.B.norm());
    let motion = four_bar::Motion::default();
    println!("{}", four_bar::linear_at(&linkage, 1.0, &motion, &loads)?.theta.M);
    println!("{}", four_bar::moved_at(&linkage, 1.0)?.reach.A.norm());
    Ok(())
}
