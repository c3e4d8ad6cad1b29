//! Linkages, and for each a function that calls everything that the macro emitted for it.
//!
//! `no_std`, without an allocator. The same functions are linked into firmware, run under WebAssembly and on an emulated
//! board, and run on the host: what they compute is gathered in a [`Digest`] of its bits.
//!
//! A linkage's module has `solve`, which calls everything once with inputs of which nothing is known, and `digest`, which does
//! so over many poses; of the project's examples, `solve` calls every scene at a pose of its cycle. That `solve` leaves out no emitted function is checked by `proofs/tests/complete.rs`.
#![no_std]

mod digest;
pub mod double;
pub mod example;
pub mod single;

pub use digest::{Digest, Line, Output};

/// Over how many poses a digest goes.
pub const POSES: u16 = 480;

/// Hands a macro the names and modules of all linkages, for one function or line each.
#[macro_export]
macro_rules! each_linkage {
    ($then:ident) => {
        $then! {
            double_math = double::math,
            double_adjustable = double::adjustable,
            double_four_bar = double::four_bar,
            double_fused = double::fused,
            double_six_bar = double::six_bar,
            double_triad = double::triad,
            double_two_drives = double::two_drives,
            single_math = single::math,
            single_folding = single::folding,
            single_four_bar = single::four_bar,
            single_iterated = single::iterated,
            single_press = single::press,
            single_slider_crank = single::slider_crank,
            example_control_loop = example::control_loop,
            example_engine = example::engine,
            example_four_bar = example::four_bar,
            example_press = example::press,
            example_six_bar = example::six_bar,
            example_slider_crank = example::slider_crank,
            example_stephenson = example::stephenson,
            example_three_loads = example::three_loads,
        }
    };
}
