//! How to pin a linkage in a build of one's own: its emitted source, equations, operation counts and numbers as snapshots, all from one
//! declaration, here that of the example `slider_crank`.
//!
//! The recipe: `emit source;` in the declaration; among the development dependencies `insta`, and `linkage-runtime` with the feature
//! `source`. `cargo insta review` then shows every change of the declaration or of the compiler as a difference in what the machine
//! runs and in what it answers.

use insta::{assert_debug_snapshot, assert_snapshot};
use linkage_runtime::{Error, Vector2};

#[path = "../examples/slider_crank.rs"]
#[allow(dead_code, reason = "only its declaration is used here")]
mod slider_crank;
use slider_crank::engine;

#[test]
fn the_engine() -> Result<(), Error> {
    assert_snapshot!("source", engine::SOURCE);
    assert_snapshot!("equations", engine::EQUATIONS);
    assert_snapshot!("operations", engine::OPERATIONS);

    let loads = engine::Loads { gas: Vector2::new(0.0, -4000.0) };
    let pose = engine::Pose::at(1.0)?;
    // Every digit: the bits are the same on every target.
    assert_debug_snapshot!("numbers", (pose, pose.hold(&loads)?, pose.weights()?, pose.torque(&loads)?));
    Ok(())
}
