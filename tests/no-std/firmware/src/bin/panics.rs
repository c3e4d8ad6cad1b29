//! A control: here a panic can be reached, so this must not link.
#![no_std]
#![no_main]

use no_std_handler as _;

/// The program's entry.
#[unsafe(no_mangle)]
pub extern "C" fn _start(numbers: &[f64; 4], index: usize) -> f64 {
    numbers[index]
}
