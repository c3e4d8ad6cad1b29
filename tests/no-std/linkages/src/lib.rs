//! Linkages, and for each a function that calls everything that the macro emitted for it.
//!
//! `no_std`, without an allocator. The same functions are linked into firmware, run under WebAssembly and on an emulated
//! board, and run on the host: what they compute is gathered in a [`Digest`] of its bits.
//!
//! A linkage's module has `solve`, which calls everything once with inputs of which nothing is known, and `digest`, which does
//! so over many poses. The project's examples are called over their cycles, in digests of their own what is asked of poses. That no emitted
//! function is left out is checked by `proofs/tests/complete.rs`.
#![no_std]

mod digest;
pub mod double;
pub mod example;
pub mod single;

pub use digest::{Digest, Line, Output};

/// Over how many poses a digest goes.
pub const POSES: u16 = 480;

/// Hands a macro the names of all digests and the functions that compute them, for one function or line each.
#[macro_export]
macro_rules! each_linkage {
    ($then:ident) => {
        $then! {
            double_math = double::math::digest,
            double_adjustable = double::adjustable::digest,
            double_four_bar = double::four_bar::digest,
            double_fused = double::fused::digest,
            double_six_bar = double::six_bar::digest,
            double_triad = double::triad::digest,
            double_two_drives = double::two_drives::digest,
            single_math = single::math::digest,
            single_folding = single::folding::digest,
            single_four_bar = single::four_bar::digest,
            single_iterated = single::iterated::digest,
            single_press = single::press::digest,
            single_slider_crank = single::slider_crank::digest,
            single_swept = single::swept::digest,
            example_control_loop = example::control_loop::digest,
            example_control_loop_posed = example::control_loop::digest_posed,
            example_engine = example::engine::digest,
            example_engine_cycle = example::engine::digest_cycle,
            example_engine_posed = example::engine::digest_posed,
            example_four_bar = example::four_bar::digest,
            example_four_bar_posed = example::four_bar::digest_posed,
            example_press = example::press::digest,
            example_press_posed = example::press::digest_posed,
            example_six_bar = example::six_bar::digest,
            example_six_bar_posed = example::six_bar::digest_posed,
            example_slider_crank = example::slider_crank::digest,
            example_slider_crank_posed = example::slider_crank::digest_posed,
            example_stephenson = example::stephenson::digest,
            example_stephenson_posed = example::stephenson::digest_posed,
            example_three_loads = example::three_loads::digest,
            example_three_loads_posed = example::three_loads::digest_posed,
        }
    };
}
