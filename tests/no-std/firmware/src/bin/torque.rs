//! One scene in single precision and nothing else: how much of the flash it takes.
#![no_std]
#![no_main]

use linkage_runtime::Error;
use no_std_handler as _;
use no_std_linkages::single::four_bar::linkage::{Loads, Torque, torque_at};

/// The program's entry.
#[unsafe(no_mangle)]
pub extern "C" fn _start(theta: f32, loads: &Loads, torque: &mut Result<Torque, Error>) {
    *torque = torque_at(theta, loads);
}
