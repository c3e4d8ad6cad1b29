//! Visibility and attributes go to the module.

#![deny(warnings, missing_docs)]

use linkage_runtime::{Error, linkage};

mod machine {
    use linkage_runtime::linkage;

    linkage! {
        /// A crank.
        ///
        /// With a second paragraph.
        #[doc = "And a third."]
        #[doc(alias = "arm")]
        pub(crate) mod crank;

        ground     { A0: (0, 0) }
        link crank { A0 -> A: 0.08m }
        revolute A0: ground -> crank;
        drive theta: A0;
        load F: force(crank.A) = (1N, 2N);
        scene statics: equilibrium;
    }

    linkage! {
        pub(in crate::machine) mod inner;

        ground     { A0: (0, 0) }
        link crank { A0 -> A: 0.08m }
        revolute A0: ground -> crank;
        drive theta: A0;
        load F: force(crank.A) = (1N, 2N);
        scene statics: equilibrium;
    }

    pub fn torque(theta: f64) -> Result<f64, linkage_runtime::Error> {
        inner::statics_at(theta).map(|all| all.effort_theta)
    }
}

linkage! {
    #[cfg(any())]
    pub mod absent;

    ground     { A0: (0, 0) }
    link crank { A0 -> A: 0.08m }
    revolute A0: ground -> crank;
    drive theta: A0;
    load F: force(crank.A) = (1N, 2N);
    scene statics: equilibrium;
}

/// Another of the name that the attribute removed.
mod absent {}

fn main() -> Result<(), Error> {
    assert_eq!(machine::crank::statics_at(0.5)?.effort_theta, machine::torque(0.5)?);
    Ok(())
}
