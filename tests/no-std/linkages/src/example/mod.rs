//! The project's examples: their declarations are read from their sources when this is built.
//!
//! Everything of each is called over its cycle. What is straight from the drive and what is asked of poses have digests of their own: they are
//! other code, whose last bits differ.

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

/// What is put at all poses of the cycle.
fn over_cycle(solve: impl Fn(u16, &mut Digest)) -> Digest {
    let mut digest = Digest::new();
    let mut pose = 0;
    while pose < POSES {
        solve(pose, &mut digest);
        pose = pose.wrapping_add(1);
    }
    digest
}

/// The declaration of an example, and the digests over its cycle.
macro_rules! example {
    ($file:literal) => {
        use linkage_runtime::linkage;

        include!(concat!(env!("OUT_DIR"), "/", $file));

        /// Every scene at all poses of the cycle, straight from the drive.
        #[must_use]
        pub fn digest() -> Digest {
            super::over_cycle(solve)
        }

        /// All poses of the cycle, and every scene from them.
        #[must_use]
        pub fn digest_posed() -> Digest {
            super::over_cycle(|number, digest| {
                if let Err(error) = posed(number, digest) {
                    digest.refusal(error);
                }
            })
        }
    };
}
use example;
