//! The project's examples: their declarations are read from their sources when this is built.
//!
//! Every scene of each is solved over its cycle; what stands beside it, the accessors of poses, is in the other linkages.

pub mod control_loop;
pub mod engine;
pub mod four_bar;
pub mod press;
pub mod six_bar;
pub mod slider_crank;
pub mod stephenson;
pub mod three_loads;

use linkage_runtime::Vector2;

use crate::Digest;

/// Over how many poses a digest goes: three degrees apart.
pub const POSES: u16 = 120;

/// The angle of a pose, in one turn.
fn angle(pose: u16) -> f64 {
    core::f64::consts::TAU * f64::from(pose) / f64::from(POSES)
}

/// A load that changes along the cycle, by up to a size in each direction; the numbers of several loads differ.
fn load(pose: u16, number: u16, size: f64) -> Vector2<f64> {
    let wave = |step: u16| f64::from((pose.wrapping_mul(step).wrapping_add(number.wrapping_mul(29))) % 97) / 48.0 - 1.0;
    Vector2::new(size * wave(31), size * wave(53))
}

/// The declaration of an example, and the digest over its cycle.
macro_rules! example {
    ($file:literal) => {
        use linkage_runtime::linkage;

        include!(concat!(env!("OUT_DIR"), "/", $file));

        /// Every scene at all poses of the cycle.
        #[must_use]
        pub fn digest() -> $crate::Digest {
            let mut digest = $crate::Digest::new();
            let mut pose = 0;
            while pose < super::POSES {
                solve(pose, &mut digest);
                pose = pose.wrapping_add(1);
            }
            digest
        }
    };
}
use example;

/// Puts the columns of a sweep. Without an iterator: in unoptimised builds a panic is within their reach.
fn put<const POSITIONS: usize>(digest: &mut Digest, columns: &[[f64; POSITIONS]]) {
    let mut which = 0;
    while let Some(column) = columns.get(which) {
        let mut position = 0;
        while let Some(number) = column.get(position) {
            digest.put(*number);
            position = position.wrapping_add(1);
        }
        which = which.wrapping_add(1);
    }
}
