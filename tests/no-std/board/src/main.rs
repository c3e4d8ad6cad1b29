//! Prints the digest of every linkage, a line each: name, hash, answers, refusals.
#![no_std]
#![no_main]

use no_std_linkages::{Line, double, each_linkage, example, single};
use semihosting::{println, process};

macro_rules! print {
    ($($name:ident = $($module:ident)::*,)*) => { $(
        println!("{}", Line(stringify!($name), $($module)::*::digest()));
    )* };
}

#[cortex_m_rt::entry]
fn main() -> ! {
    each_linkage!(print);
    process::exit(0)
}
