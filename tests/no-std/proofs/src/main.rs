//! Prints all digests as computed on this host. With the feature `std` sweeps are computed by registers of as many bytes as the first argument says.

use no_std_linkages::Line;

fn main() {
    #[cfg(feature = "std")]
    if let Some(bytes) = std::env::args().nth(1) {
        linkage_runtime::__private::limit_registers(bytes.parse().expect("a number of bytes"));
    }
    for (name, digest) in no_std_proofs::native() {
        println!("{}", Line(name, digest));
    }
}
