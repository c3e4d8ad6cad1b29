//! The path of the run-time crate is that of the place where the declaration stands.

pub extern crate linkage_runtime as renamed;

mod machines {
    pub use renamed as rt;

    rt::linkage! {
        pub mod crank;
        crate = self::rt;
        ground { O: (0, 0) }
        link crank { O -> A: 1m }
        revolute O: ground -> crank;
        drive theta: O;
        load F: force(crank.A);
        scene torque: virtual_work;
    }

    pub mod inner {
        super::rt::linkage! {
            pub mod lever;
            crate = super::rt;
            ground { O: (0, 0) }
            link lever { O -> A: 1m }
            revolute O: ground -> lever;
            drive theta: O;
            load F: force(lever.A) = (0N, 2N);
            scene torque: virtual_work;
        }
    }
}

fn main() -> Result<(), renamed::Error> {
    use machines::{crank, inner::lever};
    let by_crank = crank::torque_at(0.0, &crank::Loads { F: renamed::polar(2.0, core::f64::consts::FRAC_PI_2) })?;
    assert!((by_crank.effort_theta - lever::torque_at(0.0)?.effort_theta).abs() < 1e-15);
    Ok(())
}
