//! An export for each linkage: the hash of what it computes. Nothing is imported, not even for a panic.
#![no_std]

use no_std_handler as _;
use no_std_linkages::{double, each_linkage, example, single};

macro_rules! exports {
    ($($name:ident = $($module:ident)::*,)*) => { $(
        /// The hash of what the linkage computes.
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() -> u64 {
            $($module)::*::digest().hash
        }
    )* };
}
each_linkage!(exports);
