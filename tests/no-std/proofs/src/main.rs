//! Prints the digest of every linkage as computed on this host.

use no_std_linkages::Line;

fn main() {
    for (name, digest) in no_std_proofs::native() {
        println!("{}", Line(name, digest));
    }
}
