//! What the functions emitted by `linkage!` call at run time.
#![no_std]

#[cfg(any(feature = "std", test))]
extern crate std;

pub mod math;
