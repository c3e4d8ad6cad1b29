//! The words of the language are not reserved.

use linkage_runtime::{Error, linkage, polar};

linkage! {
    pub mod scene;
    units { mm, N }

    param param: length = 80mm;
    ground        { ground: (0, 0), at: (140mm, 0) }
    link link     { ground -> left: param }
    link along    { left -> right: 100mm, of: left(left -> right, 70mm, 80mm) }
    link mass     { at -> right: 120mm }
    mass mass: 0.5kg at (60mm, 0), inertia 900kg*mm^2;
    mass along: 0.5kg at of;

    revolute revolute: ground.ground -> link.ground;
    revolute left:     link -> along;
    revolute right:    along -> mass;
    revolute start:    ground.at -> mass.at;

    drive drive: revolute;
    unknown unknown: torque(ground -> link);
    assemble right: left(left -> start);

    load load:    force(along.of);
    load force:   moment(along -> mass);
    load gravity: gravity = (0, -9.81m/s^2);
    scene position:    position;
    scene equilibrium: equilibrium;
    scene work:        virtual_work(load) -> (unknown, load);
    scene each:        superposition(load, gravity);
}

fn main() -> Result<(), Error> {
    let linkage = scene::Linkage::new(&scene::Params::default())?;
    let loads = scene::Loads { load: polar(50.0, 4.0), force: 2.0 };
    let pose = scene::Pose::at(&linkage, 1.0)?;
    let [torque, straight] = [pose.equilibrium(&loads)?, scene::equilibrium_at(&linkage, 1.0, &loads)?].map(|all| all.unknown);
    assert!((torque - straight).abs() < 1e-12 * straight.abs());
    assert_eq!(pose.position()?.along_of, pose.along_of());
    assert!(pose.work(&loads)?.load.work.is_finite());
    assert!(pose.each(&loads)?.gravity.mass.right.norm() > 0.0);
    Ok(())
}
