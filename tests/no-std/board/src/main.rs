//! Prints all digests, a line each: name and hash.
#![no_std]
#![no_main]

use no_std_linkages::{Line, double, each_linkage, example, single};
use semihosting::{println, process};

macro_rules! print {
    ($($name:ident = $($digest:ident)::*,)*) => { $(
        println!("{}", Line(stringify!($name), $($digest)::*()));
    )* };
}

#[cortex_m_rt::entry]
fn main() -> ! {
    each_linkage!(print);
    process::exit(0)
}
