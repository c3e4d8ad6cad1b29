//! A control: this allocates, and without an allocator it must not build.
#![no_std]
#![no_main]

extern crate alloc;

use no_std_handler as _;

/// The program's entry.
#[unsafe(no_mangle)]
pub extern "C" fn _start(number: f64) -> *mut f64 {
    alloc::boxed::Box::into_raw(alloc::boxed::Box::new(number))
}
