//! An export for each digest: the hash of what is computed. Nothing is imported, not even for a panic.
#![no_std]

use no_std_handler as _;
use no_std_linkages::{double, each_linkage, example, single};

macro_rules! exports {
    ($($name:ident = $($digest:ident)::*,)*) => { $(
        /// The hash of what is computed.
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() -> u64 {
            $($digest)::*().hash
        }
    )* };
}
each_linkage!(exports);
