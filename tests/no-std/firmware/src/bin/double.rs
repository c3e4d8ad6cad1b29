//! Everything in double precision, called with numbers of which the compiler knows nothing.
#![no_std]
#![no_main]

use no_std_handler as _;
use no_std_linkages::{Digest, double};

/// The program's entry.
#[unsafe(no_mangle)]
pub extern "C" fn _start(input: &double::Inputs, digest: &mut Digest) {
    double::math::solve(input, digest);
    double::adjustable::solve(input, digest);
    double::four_bar::solve(input, digest);
    double::fused::solve(input, digest);
    double::six_bar::solve(input, digest);
    double::triad::solve(input, digest);
    double::two_drives::solve(input, digest);
}
