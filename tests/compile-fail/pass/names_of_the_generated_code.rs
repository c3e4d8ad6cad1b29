//! Names that the generated code uses itself are free for the declaration.

use linkage_runtime::{Error, linkage, polar};

linkage! {
    pub mod math;
    units { mm, N }

    param at: length = 80mm;
    param params: length = 100mm;
    ground    { A: (0, 0), D: (140mm, 0) }
    link core { A -> B: at }
    link f64  { B -> C: params }
    link cos  { D -> C: 120mm }

    revolute A: ground -> core;
    revolute B: core -> f64;
    revolute C: f64 -> cos;
    revolute D: ground -> cos;

    drive self_: A;
    unknown theta: torque(ground -> core);
    assemble C: left(B -> D);

    load pose:   force(f64.C);
    load sin_cos: moment(cos);
    load result: moment(core -> f64) = 2N*m;
    scene u8:    equilibrium;
    scene parts: superposition;
    scene total: virtual_work -> (theta, pose);
}

fn main() -> Result<(), Error> {
    let linkage = math::Linkage::new(&math::Params::default())?;
    let loads = math::Loads { pose: polar(50.0, 4.0), sin_cos: 2.0 };
    let pose = math::Pose::at(&linkage, 1.0)?;
    // What is multiplied in another order may be rounded otherwise.
    let [from_pose, straight] = [pose.u8(&loads)?.theta, math::u8_at(&linkage, 1.0, &loads)?.theta];
    assert!((from_pose - straight).abs() <= 2.0 * f64::EPSILON * straight.abs());
    let [from_pose, straight] = [pose.parts(&loads)?.total()?.B, math::parts_at(&linkage, 1.0, &loads)?.total()?.B];
    assert!((from_pose - straight).norm() <= 2.0 * f64::EPSILON * straight.norm());
    assert!(pose.total(&loads)?.pose.work.is_finite());
    assert_eq!(pose.self_(), 1.0);
    Ok(())
}
