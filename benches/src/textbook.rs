//! The four-bar as the textbook solves it, by angles: the law of cosines for the dyad, the arc tangent for the line between its outer
//! joints, and two load cases in each of which one link is a two-force member (METU, Example 6.3).

use linkage_runtime::Vector2;

use crate::items::Reactions;
use crate::linkages::four_bar::Loads;

/// All forces and the torque.
pub(crate) fn statics(theta12: f64, loads: &Loads, out: &mut Reactions<4>) {
    // The line A B0, its angle, and the angles of the triangle A B B0 at A and at B.
    let (x, y) = (140.0 - 80.0 * theta12.cos(), -80.0 * theta12.sin());
    let s = (140.0_f64.powi(2) + 80.0_f64.powi(2) - 2.0 * 140.0 * 80.0 * theta12.cos()).sqrt();
    let phi = y.atan2(x);
    let psi = ((100.0_f64.powi(2) + s.powi(2) - 120.0_f64.powi(2)) / (2.0 * 100.0 * s)).acos();
    let mu = ((100.0_f64.powi(2) + 120.0_f64.powi(2) - s.powi(2)) / (2.0 * 100.0 * 120.0)).acos();
    let theta13 = phi + psi;
    let theta14 = theta13 + mu;

    // F14 alone: the coupler is a two-force member, moments about B0 of the rocker.
    let moment = 90.0 * (theta14.cos() * loads.F14.y - theta14.sin() * loads.F14.x);
    let by_f14 = moment / (120.0 * (theta14 - theta13).sin());
    // F13 alone: the rocker is a two-force member, moments about A of the coupler. C is at 52.6° from A B, 70 mm away.
    let alpha = theta13 + ALPHA;
    let moment = 70.0 * (alpha.cos() * loads.F13.y - alpha.sin() * loads.F13.x);
    let by_f13 = moment / (100.0 * (theta14 - theta13).sin());

    let f34 =
        Vector2::new(by_f14 * theta13.cos() + by_f13 * theta14.cos(), by_f14 * theta13.sin() + by_f13 * theta14.sin());
    let f23 = f34 - loads.F13;
    out.torque = 80.0 * (theta12.cos() * f23.y - theta12.sin() * f23.x);
    out.forces = [f23, f23, f34, -loads.F14 - f34];
}

/// The angle of A C from A B: cos α = (70² + 100² − 80²)/(2·70·100).
const ALPHA: f64 = 0.918_336_429_476_819_5;

#[cfg(test)]
mod tests {
    #[test]
    fn the_angle_is_that_of_the_triangle() {
        let angle = ((4900.0_f64 + 10000.0 - 6400.0) / 14000.0).acos();
        assert!((super::ALPHA - angle).abs() < 3e-16);
    }
}
