//! Everything in single precision, called with numbers of which the compiler knows nothing.
#![no_std]
#![no_main]

use no_std_handler as _;
use no_std_linkages::{Digest, single};

/// The program's entry.
#[unsafe(no_mangle)]
pub extern "C" fn _start(input: &single::Inputs, digest: &mut Digest) {
    single::math::solve(input, digest);
    single::folding::solve(input, digest);
    single::four_bar::solve(input, digest);
    single::iterated::solve(input, digest);
    single::press::solve(input, digest);
    single::slider_crank::solve(input, digest);
    single::swept::solve(input, digest);
}
