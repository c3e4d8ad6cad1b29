//! P3: an engine's slider-crank.

use linkage_runtime::Vector2;
use nalgebra::{SMatrix, SVector};

use super::dense::{self, eliminations};
use super::{Case, Extent, Item, Reactions, Turn};
use crate::exact::{Big, Exact, Joint, Kind, Load, equilibrium, vector};
use crate::generators;
use crate::linkages::slider_crank::{Loads, Pose};

loads!(slider_crank, f64; gas: 50.0 N);
loads!(slider_crank_single, f32; gas: 50.0 N);

type All = Reactions<4>;
type At = Case<f64, Loads>;

pub(super) fn items(extent: Extent) -> Vec<Item> {
    let turn = Turn::new(extent, 45.0, |theta, loads| vec![exact(theta, loads)]);
    let mut competitors = vec![
        turn.competitor("expert", statics_at_expert),
        turn.competitor("generated", statics_at_generated),
        turn.competitor("generated, fused", statics_at_fused),
    ];
    competitors.extend(eliminations!(|method, call| turn.competitor(method, call), "9x9", statics_at_eliminated));
    generators::add::<_, 3, 9, 1>(&mut competitors, "P3b", &turn, |loads: &Loads| vec![loads.gas]);
    vec![Item { id: "P3b", title: "slider-crank: all forces and the torque, from the driver's angle", competitors }]
}

generated_statics_at!(4, |all| Reactions { torque: all.T, forces: [all.O, all.A, all.B, all.P.force] };
    statics_at_generated: f64, slider_crank, slider_crank;
    statics_at_generated_single: f32, slider_crank_single, slider_crank_single;
    statics_at_fused: f64, slider_crank_fused, slider_crank;
);
same_loads!(slider_crank, f64, slider_crank_fused; gas);
same_loads!(slider_crank, f32, slider_crank_single; gas);

expert_at!(statics_at_expert, f64, slider_crank, 4);
expert_at!(statics_at_expert_single, f32, slider_crank_single, 4);

/// Unknowns: the forces at O, A, B, the guide's force and couple, the torque. Moments about O, A and B.
#[inline]
fn equations(pose: &Pose, loads: &Loads) -> (SMatrix<f64, 9, 9>, SVector<f64, 9>) {
    let (crank, rod) = (45.0 * pose.crank_direction(), 150.0 * pose.rod_direction());
    let mut matrix = SMatrix::<f64, 9, 9>::zeros();
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
    let mut right = SVector::<f64, 9>::zeros();
    dense::load(&mut right, 0, 2, [0.0, 0.0], loads.gas.into());
    (matrix, right)
}

#[inline]
fn put(solution: Option<SVector<f64, 9>>, out: &mut All) -> bool {
    let Some(x) = solution else { return false };
    out.torque = x[8];
    out.forces =
        [Vector2::new(x[0], x[1]), Vector2::new(x[2], x[3]), Vector2::new(x[4], x[5]), Vector2::new(0.0, x[6])];
    true
}

fn statics_at_eliminated(
    case: &At,
    out: &mut All,
    solve: impl Fn(SMatrix<f64, 9, 9>, &SVector<f64, 9>) -> Option<SVector<f64, 9>>,
) -> bool {
    let Ok(pose) = Pose::at(case.start) else { return false };
    let (matrix, right) = equations(&pose, &case.loads);
    put(solve(matrix, &right), out)
}

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
