//! P2: a six-bar with weight on every link.

use super::dense::{self, eliminations};
use super::{Extent, Item, Reactions, Turn};
use crate::exact::{Big, Exact, Joint, Kind, Load, equilibrium, in_frame, left, vector};
use crate::generators;
use crate::linkages::six_bar::Loads;

loads!(six_bar, f64; F: 50.0 N, G: 100.0 N);
loads!(six_bar_single, f32; F: 50.0 N, G: 100.0 N);

pub(super) fn items(extent: Extent) -> Vec<Item> {
    let turn = Turn::new(extent, 50.0, |theta, loads| vec![exact(theta, loads)]);
    let mut competitors = vec![
        turn.competitor("expert", statics_at_expert),
        turn.competitor("expert, law of cosines", statics_at_by_cosine),
        turn.competitor("generated", statics_at_generated),
        turn.competitor("generated, fused", statics_at_fused),
    ];
    competitors.extend(eliminations!(
        |method, call| turn.competitor(method, call),
        "15x15",
        double::statics_at_eliminated
    ));
    generators::add::<f64, _, 5, 15, 1>(&mut competitors, "P2b", &turn, |loads: &Loads| vec![loads.F, loads.G]);
    vec![Item {
        id: "P2b",
        title: "six-bar with weights: all forces and the torque, from the driver's angle",
        competitors,
    }]
}

generated_statics_at!(7, |all| Reactions { torque: all.T, forces: [all.A0, all.A, all.B, all.B0, all.C, all.D, all.D0] };
    statics_at_generated: f64, six_bar, six_bar;
    statics_at_generated_single: f32, six_bar_single, six_bar_single;
    statics_at_fused: f64, six_bar_fused, six_bar;
    statics_at_fused_single: f32, six_bar_fused_single, six_bar_single;
);
same_loads!(six_bar, f64, six_bar_fused; F, G);
same_loads!(six_bar, f32, six_bar_single; F, G);
same_loads!(six_bar_single, f32, six_bar_fused_single; F, G);

expert_at!(statics_at_expert, f64, six_bar, 7);
expert_at!(statics_at_expert_single, f32, six_bar_single, 7);
expert_at!(statics_at_by_cosine, statics_by_cosine, f64, six_bar, 7);
expert_at!(statics_at_by_cosine_single, statics_by_cosine, f32, six_bar_single, 7);

/// Each link's mass in kg, and its place in mm.
const MASSES: [(f64, f64, f64); 5] =
    [(0.4, 25.0, 0.0), (0.9, 65.0, 12.0), (0.8, 60.0, -10.0), (0.7, 85.0, 0.0), (0.6, 50.0, 8.0)];

/// The equations of all free bodies, moments about the origin of each link's frame, solved by a way of elimination, in a scalar.
macro_rules! eliminated {
    ($name:ident, $scalar:ident, $linkage:ident) => {
        pub(crate) mod $name {
            use linkage_runtime::Vector2;
            use nalgebra::SMatrix;

            use super::MASSES;
            use crate::items::dense::{self, Pin};
            use crate::items::{Case, Reactions};
            use crate::linkages::$linkage::{Loads, Pose};

            type Matrix = SMatrix<$scalar, 15, 15>;
            type Right = SMatrix<$scalar, 15, 1>;

            #[inline]
            #[allow(clippy::cast_possible_truncation, reason = "in single precision")]
            fn equations(pose: &Pose, loads: &Loads) -> (Matrix, Right) {
                // The place (x, y) in a link's frame, seen from the frame's origin.
                let at = |u: Vector2<$scalar>, x: $scalar, y: $scalar| [x * u.x - y * u.y, x * u.y + y * u.x];
                let (crank, coupler, rocker) =
                    (pose.crank_direction(), pose.coupler_direction(), pose.rocker_direction());
                let (rod, arm) = (pose.rod_direction(), pose.arm_direction());
                let here = [0.0, 0.0];
                let matrix = dense::matrix(&[
                    Pin { first: None, second: (0, here) },
                    Pin { first: Some((0, at(crank, 50.0, 0.0))), second: (1, here) },
                    Pin { first: Some((1, at(coupler, 140.0, 0.0))), second: (2, at(rocker, 100.0, 0.0)) },
                    Pin { first: None, second: (2, here) },
                    Pin { first: Some((2, at(rocker, 80.0, -40.0))), second: (3, here) },
                    Pin { first: Some((3, at(rod, 170.0, 0.0))), second: (4, at(arm, 110.0, 0.0)) },
                    Pin { first: None, second: (4, here) },
                ]);
                let mut right = Right::zeros();
                dense::load(&mut right, 0, 1, at(coupler, 60.0, 35.0), loads.F.into());
                dense::load(&mut right, 0, 4, at(arm, 70.0, 25.0), loads.G.into());
                for (link, (u, (mass, x, y))) in [crank, coupler, rocker, rod, arm].into_iter().zip(MASSES).enumerate()
                {
                    let weight = [0.0, (-9.81 * mass) as $scalar];
                    dense::load(&mut right, 0, link, at(u, x as $scalar, y as $scalar), weight);
                }
                (matrix, right)
            }

            pub(crate) fn statics_at_eliminated(
                case: &Case<$scalar, Loads>,
                out: &mut Reactions<7, $scalar>,
                solve: impl Fn(Matrix, &Right) -> Option<Right>,
            ) -> bool {
                let Ok(pose) = Pose::at(case.start) else { return false };
                let (matrix, right) = equations(&pose, &case.loads);
                let Some(x) = solve(matrix, &right) else { return false };
                out.torque = x[14];
                for (k, force) in out.forces.iter_mut().enumerate() {
                    *force = Vector2::new(x[2 * k], x[2 * k + 1]);
                }
                true
            }
        }
    };
}
eliminated!(double, f64, six_bar);
eliminated!(single, f32, six_bar_single);

/// The exact forces and torque.
pub(crate) fn exact(theta: &Big, loads: &Loads) -> Exact {
    let number = |x: i32| Big::ratio(x, 1);
    let point = |x: i32, y: i32| [number(x), number(y)];
    let (a0, b0, d0) = (point(0, 0), point(150, 0), point(330, 20));
    let [cos, sin] = theta.direction();
    let a = [number(50) * cos, number(50) * sin];
    let b = left(&a, &b0, &number(140), &number(100));
    let c = in_frame(&b0, &b, &number(100), &number(80), &number(-40));
    let d = left(&c, &d0, &number(170), &number(110));
    let pin = |first, second, at: &[Big; 2]| Joint { first, second, at: at.clone(), kind: Kind::Pin };
    let joints = [
        pin(None, 0, &a0),
        pin(Some(0), 1, &a),
        pin(Some(1), 2, &b),
        pin(None, 2, &b0),
        pin(Some(2), 3, &c),
        pin(Some(3), 4, &d),
        pin(None, 4, &d0),
    ];
    let frames = [(&a0, &a, 50), (&a, &b, 140), (&b0, &b, 100), (&c, &d, 170), (&d0, &d, 110)];
    let place = |link: usize, x: i32, y: i32| {
        let (from, to, length) = frames[link];
        in_frame(from, to, &number(length), &number(x), &number(y))
    };
    // Tenths of a kilogramme, and the centre of each link.
    let masses = [(4, 25, 0), (9, 65, 12), (8, 60, -10), (7, 85, 0), (6, 50, 8)];
    let mut all = vec![
        Load { link: 1, at: place(1, 60, 35), force: vector(loads.F.x, loads.F.y) },
        Load { link: 4, at: place(4, 70, 25), force: vector(loads.G.x, loads.G.y) },
    ];
    for (link, (mass, x, y)) in masses.into_iter().enumerate() {
        all.push(Load { link, at: place(link, x, y), force: [number(0), Big::ratio(-981 * mass, 1000)] });
    }
    equilibrium(5, &joints, &all)
}
