//! Words of Rust name links, points, joints, drives, loads and scenes.

use linkage_runtime::{Error, linkage, polar};

linkage! {
    pub mod r#loop;
    units { mm, N }

    ground      { in: (0, 0), out: (140mm, 0) }
    link type   { in -> as: 80mm }
    link struct { as -> for: 100mm, fn: left(as -> for, 70mm, 80mm) }
    link impl   { out -> for: 120mm }

    revolute in:  ground -> type;
    revolute as:  type   -> struct;
    revolute for: struct -> impl;
    revolute out: ground -> impl;

    drive move: in;
    unknown let: torque(ground -> type);
    assemble for: left(as -> out);

    load mut:   force(struct.fn);
    load const: moment(impl);
    scene static: equilibrium;
    scene where:  position;
    scene yield:  virtual_work(mut) -> (let, mut);
    scene ref:    superposition;
}

fn main() -> Result<(), Error> {
    let loads = r#loop::Loads { r#mut: polar(50.0, 4.0), r#const: 2.0 };
    let pose = r#loop::Pose::at(1.0)?;
    let all = pose.r#static(&loads)?;
    let each = pose.r#ref(&loads)?;
    assert!((all.r#let - each.total()?.r#let).abs() < 1e-9);
    assert!((all.r#for - each.r#mut.r#for - each.r#const.r#for).norm() < 1e-9);
    assert!((r#loop::yield_at(1.0, &loads)?.r#let - each.r#mut.r#let).abs() < 1e-9);
    assert_eq!(r#loop::where_at(1.0)?.r#in, pose.r#in());
    assert!((pose.struct_fn() - r#loop::where_at(1.0)?.struct_fn).norm() < 1e-12);
    assert_eq!(pose.r#move(), 1.0);
    Ok(())
}
