//! A control: here a panic can be reached, so this module cannot do without imports.
#![no_std]

use no_std_handler as _;

/// Panics out of range.
#[unsafe(no_mangle)]
pub extern "C" fn element(index: usize) -> u8 {
    [1, 2, 3, 5, 8][index]
}
