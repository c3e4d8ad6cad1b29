//! The four-bar closed by Newton's method instead of a formula, as one writes it in an afternoon: the angles of coupler and rocker from
//! the closure of the loop, from those of the pose before.

use linkage_runtime::Vector2;

use crate::expert::four_bar::Pose;

/// Where a search begins: the driver's angle that is asked for, and the angles of coupler and rocker at the pose before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Begin {
    /// The driver's angle.
    pub(crate) theta: f64,
    /// The coupler's angle at the pose before.
    pub(crate) coupler: f64,
    /// The rocker's angle at the pose before.
    pub(crate) rocker: f64,
}

/// As many steps as a search may take.
const STEPS: usize = 50;

/// The pose; none if the angles do not settle.
pub(crate) fn pose(begin: &Begin) -> Option<Pose> {
    let (sin2, cos2) = begin.theta.sin_cos();
    let (mut theta3, mut theta4) = (begin.coupler, begin.rocker);
    for _ in 0..STEPS {
        let ((sin3, cos3), (sin4, cos4)) = (theta3.sin_cos(), theta4.sin_cos());
        // The gap at B, and how it changes with both angles.
        let x = 80.0 * cos2 + 100.0 * cos3 - 120.0 * cos4 - 140.0;
        let y = 80.0 * sin2 + 100.0 * sin3 - 120.0 * sin4;
        let [[a, b], [c, d]] = [[-100.0 * sin3, 120.0 * sin4], [100.0 * cos3, -120.0 * cos4]];
        let determinant = a * d - b * c;
        let (change3, change4) = ((b * y - d * x) / determinant, (c * x - a * y) / determinant);
        theta3 += change3;
        theta4 += change4;
        if change3.abs().max(change4.abs()) < 1e-13 {
            let ((sin3, cos3), (sin4, cos4)) = (theta3.sin_cos(), theta4.sin_cos());
            return Some(Pose::of(
                80.0 * Vector2::new(cos2, sin2),
                100.0 * Vector2::new(cos3, sin3),
                120.0 * Vector2::new(cos4, sin4),
            ));
        }
    }
    None
}
