use linkage_runtime::{Error, linkage, polar};

linkage! {
    pub mod four_bar;

    units { mm, N }

    param reach: length = 100mm;

    ground       { A0: (0, 0), B0: (140mm, 0) }
    link crank   { A0 -> A: 80mm }
    link coupler { A -> B: reach, C: (60mm, 20mm) }
    link rocker  { B0 -> B: 120mm, D: (90mm, 0) }
    mass rocker: 2kg at (60mm, 0);

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0 { rate: 3rad/s };
    unknown T12: torque(ground -> crank);
    assemble B: left(A -> B0);

    load F13: force(coupler.C);
    load F14: force(rocker.D) = 100N @ 200deg;
    load I: inertia;

    scene statics: equilibrium(F13, F14) -> (T12, B);
    scene moving: velocity -> (B);
    scene cycle: sweep(statics);
    scene slopes: derivative(statics) by (theta, F13, F14, thetta);
    scene a: derivative(static) by (theta);
    scene b: derivative(slopes) by (theta);
    scene c: derivative(cycle) by (theta);
    scene d: derivative(statics) by ();
    scene e: derivative(statics) by (theta, reach, theta);
    scene f: derivative(statics) by (F13.x);
    scene g: derivative(moving) by (theta.rate);
    scene h: derivative(moving) by (theta.speed);
    scene i: derivative(moving) by (rocker);
    scene j: derivative(statics) by (I);
}

fn main() -> Result<(), Error> {
    let linkage = four_bar::Linkage::new(&four_bar::Params { reach: 90.0 })?;
    let loads = four_bar::Loads { F13: polar(50.0, 4.0) };
    let slopes = four_bar::slopes_at(&linkage, 1.0, &loads)?;
    println!("{} {}", slopes.theta.T12, slopes.F13.x.B.norm());
    println!("{} {}", slopes.F14.y.T12, slopes.thetta.T12);
    println!("{}", four_bar::e_at(&linkage, 1.0, &loads)?.reach.T12);
    println!("{}", four_bar::j_at(&linkage, 1.0, &loads)?.I.T12);
    Ok(())
}
