//! P3: an engine's slider-crank.

use super::dense::{self, eliminations};
use super::{Extent, Item, Reactions, Turn};
use crate::exact::{Big, Exact, Joint, Kind, Load, equilibrium, vector};
use crate::generators;
use crate::linkages::slider_crank::Loads;

loads!(slider_crank, f64; gas: 50.0 N);
loads!(slider_crank_single, f32; gas: 50.0 N);

pub(super) fn items(extent: Extent) -> Vec<Item> {
    let turn = Turn::new(extent, 45.0, |theta, loads| vec![exact(theta, loads)]);
    let mut competitors = vec![
        turn.competitor("expert", statics_at_expert),
        turn.competitor("generated", statics_at_generated),
        turn.competitor("generated, fused", statics_at_fused),
    ];
    competitors.extend(eliminations!(
        |method, call| turn.competitor(method, call),
        "9x9",
        double::statics_at_eliminated
    ));
    generators::add::<f64, _, 3, 9, 1>(&mut competitors, "P3b", &turn, |loads: &Loads| vec![loads.gas]);
    vec![Item { id: "P3b", title: "slider-crank: all forces and the torque, from the driver's angle", competitors }]
}

generated_statics_at!(4, |all| Reactions { torque: all.T, forces: [all.O, all.A, all.B, all.P.force] };
    statics_at_generated: f64, slider_crank, slider_crank;
    statics_at_generated_single: f32, slider_crank_single, slider_crank_single;
    statics_at_fused: f64, slider_crank_fused, slider_crank;
    statics_at_fused_single: f32, slider_crank_fused_single, slider_crank_single;
);
same_loads!(slider_crank, f64, slider_crank_fused; gas);
same_loads!(slider_crank, f32, slider_crank_single; gas);
same_loads!(slider_crank_single, f32, slider_crank_fused_single; gas);

expert_at!(statics_at_expert, f64, slider_crank, 4);
expert_at!(statics_at_expert_single, f32, slider_crank_single, 4);

/// The equations of all free bodies, solved by a way of elimination, in a scalar. Unknowns: the forces at O, A, B, the guide's force and
/// couple, the torque. Moments about O, A and B.
macro_rules! eliminated {
    ($name:ident, $scalar:ident, $linkage:ident) => {
        pub(crate) mod $name {
            use linkage_runtime::Vector2;
            use nalgebra::SMatrix;

            use crate::items::{Case, Reactions, dense};
            use crate::linkages::$linkage::{Loads, Pose};

            type Matrix = SMatrix<$scalar, 9, 9>;
            type Right = SMatrix<$scalar, 9, 1>;

            #[inline]
            fn equations(pose: &Pose, loads: &Loads) -> (Matrix, Right) {
                let (crank, rod) = (45.0 * pose.crank_direction(), 150.0 * pose.rod_direction());
                let mut matrix = Matrix::zeros();
                for link in 0..3 {
                    matrix[(3 * link, 2 * link)] = 1.0;
                    matrix[(3 * link + 1, 2 * link + 1)] = 1.0;
                }
                for (link, arm) in [crank, rod].into_iter().enumerate() {
                    matrix[(3 * link, 2 * link + 2)] = -1.0;
                    matrix[(3 * link + 1, 2 * link + 3)] = -1.0;
                    matrix[(3 * link + 2, 2 * link + 2)] = arm.y;
                    matrix[(3 * link + 2, 2 * link + 3)] = -arm.x;
                }
                matrix[(7, 6)] = 1.0;
                matrix[(8, 7)] = 1.0;
                matrix[(2, 8)] = 1.0;
                let mut right = Right::zeros();
                dense::load(&mut right, 0, 2, [0.0, 0.0], loads.gas.into());
                (matrix, right)
            }

            pub(crate) fn statics_at_eliminated(
                case: &Case<$scalar, Loads>,
                out: &mut Reactions<4, $scalar>,
                solve: impl Fn(Matrix, &Right) -> Option<Right>,
            ) -> bool {
                let Ok(pose) = Pose::at(case.start) else { return false };
                let (matrix, right) = equations(&pose, &case.loads);
                let Some(x) = solve(matrix, &right) else { return false };
                out.torque = x[8];
                let force = |k: usize| Vector2::new(x[k], x[k + 1]);
                out.forces = [force(0), force(2), force(4), Vector2::new(0.0, x[6])];
                true
            }
        }
    };
}
eliminated!(double, f64, slider_crank);
eliminated!(single, f32, slider_crank_single);

/// The exact forces and torque.
pub(crate) fn exact(theta: &Big, loads: &Loads) -> Exact {
    let [cos, sin] = theta.direction();
    let a = [Big::of(45.0) * cos, Big::of(45.0) * sin];
    let b = [&a[0] + (Big::of(22500.0) - &a[1] * &a[1]).sqrt(), Big::of(0.0)];
    let joint = |first, second, at: &[Big; 2], kind| Joint { first, second, at: at.clone(), kind };
    let joints = [
        joint(None, 0, &vector(0.0, 0.0), Kind::Pin),
        joint(Some(0), 1, &a, Kind::Pin),
        joint(Some(1), 2, &b, Kind::Pin),
        joint(None, 2, &b, Kind::SlideAlongX),
    ];
    equilibrium(3, &joints, &[Load { link: 2, at: b, force: vector(loads.gas.x, loads.gas.y) }])
}
