//! P1: the four-bar of METU Example 6.3.

use super::dense::{self, eliminations};
use super::{Case, Extent, Item, Reactions, Turn};
use crate::exact::{Big, Exact, Joint, Kind, Load, Vector, equilibrium, in_frame, left, vector};
use crate::expert::four_bar as expert;
use crate::generators::{self, Foreign};
use crate::linkages::four_bar::{Loads, Pose};
use crate::linkages::four_bar_fused;

loads!(four_bar, f64; F13: 50.0 N, F14: 100.0 N);
loads!(four_bar_fused, f64; F13: 50.0 N, F14: 100.0 N);
loads!(four_bar_single, f32; F13: 50.0 N, F14: 100.0 N);
loads!(four_bar_fused_single, f32; F13: 50.0 N, F14: 100.0 N);

same_loads!(four_bar, f64, four_bar_fused; F13, F14);
same_loads!(four_bar, f32, four_bar_single; F13, F14);
same_loads!(four_bar_single, f32, four_bar_fused_single; F13, F14);

type All = Reactions<4>;
type At = Case<f64, Loads>;

pub(super) fn items(extent: Extent) -> Vec<Item> {
    let turn = Turn::new(extent, 80.0, |theta, loads| vec![exact(theta, loads)]);
    let parts = Turn::new(extent, 80.0, exact_parts);
    let pose = |theta| Pose::at(theta).expect("a pose");
    let fused_pose = |theta| four_bar_fused::Pose::at(theta).expect("a pose");
    let careful_pose = |theta| expert::careful_pose(theta).expect("a pose");
    let mut items = [
        Item {
            id: "P1a",
            title: "four-bar: all forces and the torque, from a pose",
            competitors: vec![
                turn.prepared("expert", expert::pose, double::statics_expert),
                turn.prepared("careful expert", careful_pose, double::statics_careful),
                turn.prepared("generated", pose, double::statics_generated),
                turn.prepared("generated, fused", fused_pose, fused::statics_generated),
            ],
        },
        Item {
            id: "P1b",
            title: "four-bar: all forces and the torque, from the driver's angle",
            competitors: vec![
                turn.competitor("expert", double::statics_at_expert),
                turn.competitor("expert, law of cosines", double::statics_at_by_cosine),
                turn.competitor("careful expert", double::statics_at_careful),
                turn.competitor("generated", double::statics_at_generated),
                turn.competitor("generated, fused", fused::statics_at_generated),
                turn.competitor("generated, by way of a pose", statics_at_pose),
            ],
        },
        Item {
            id: "P1c",
            title: "four-bar: the torque only, from the driver's angle",
            competitors: vec![
                turn.competitor("expert", double::torque_at_expert),
                turn.competitor("expert, law of cosines", double::torque_at_by_cosine),
                turn.competitor("careful expert", double::torque_at_careful),
                turn.competitor("generated", double::torque_at_generated),
                turn.competitor("generated, fused", fused::torque_at_generated),
            ],
        },
        Item {
            id: "P1d",
            title: "four-bar: forces and torque by each of two loads, from the driver's angle",
            competitors: vec![
                parts.competitor("expert", double::parts_at_expert),
                parts.competitor("expert, law of cosines", double::parts_at_by_cosine),
                parts.competitor("careful expert", double::parts_at_careful),
                parts.competitor("generated", double::parts_at_generated),
                parts.competitor("generated, fused", fused::parts_at_generated),
            ],
        },
    ];
    let eliminations = [
        eliminations!(|method, call| turn.prepared(method, pose, call), "9x9", double::statics_eliminated),
        eliminations!(|method, call| turn.competitor(method, call), "9x9", double::statics_at_eliminated),
        eliminations!(|method, call| turn.competitor(method, call), "9x9", double::torque_at_eliminated),
        eliminations!(|method, call| parts.competitor(method, call), "9x9", double::parts_at_eliminated),
    ];
    for (item, eliminations) in items.iter_mut().zip(eliminations) {
        item.competitors.extend(eliminations);
    }
    add_generators::<f64>(&mut items, &turn, &parts);
    items.into()
}

/// What other generators wrote for the items, P1a to P1d in a scalar, if a library of it is loaded.
pub(super) fn add_generators<T: Foreign>(items: &mut [Item], turn: &Turn<Loads>, parts: &Turn<Loads>) {
    let loads = |loads: &Loads| vec![loads.F13, loads.F14];
    for Item { id, competitors, .. } in items {
        match id.trim_end_matches("-f32") {
            "P1a" => generators::add::<T, _, 11, 9, 1>(competitors, id, turn, loads),
            "P1b" => generators::add::<T, _, 5, 9, 1>(competitors, id, turn, loads),
            "P1c" => generators::add::<T, _, 5, 1, 1>(competitors, id, turn, loads),
            _ => generators::add::<T, _, 5, 18, 2>(competitors, id, parts, loads),
        }
    }
}

/// The torque and the forces, as generated functions name them.
macro_rules! reactions {
    ($all:expr) => {{
        let all = &$all;
        Reactions { torque: all.T12, forces: [all.A0, all.A, all.B, all.B0] }
    }};
}

/// What is generated, in a scalar and an arithmetic.
macro_rules! generated {
    ($scalar:ident, $linkage:ident, $given:ident) => {
        impl Start for crate::linkages::$linkage::Pose {
            fn depend(&mut self, _: f64) -> bool {
                false
            }
        }

        pub(crate) fn statics_generated(
            case: &Case<crate::linkages::$linkage::Pose, crate::linkages::$given::Loads>,
            out: &mut Reactions<4, $scalar>,
        ) -> bool {
            match case.start.statics(&case.loads.into()) {
                Ok(all) => {
                    *out = reactions!(all);
                    true
                }
                Err(_) => false,
            }
        }

        generated_at!(
            statics_at_generated,
            $scalar,
            $linkage::statics_at,
            $given,
            |all| reactions!(all),
            Reactions<4, $scalar>
        );
        generated_at!(torque_at_generated, $scalar, $linkage::torque_at, $given, |torque| torque.T12, $scalar);
        generated_at!(
            parts_at_generated,
            $scalar,
            $linkage::parts_at,
            $given,
            |parts| [reactions!(parts.F13), reactions!(parts.F14)],
            [Reactions<4, $scalar>; 2]
        );
    };
}

/// The equations of all free bodies, to be solved by a way of elimination, in a scalar.
macro_rules! eliminated {
    ($scalar:ident, $linkage:ident) => {
        type Matrix = SMatrix<$scalar, 9, 9>;
        /// A right side for each set of loads.
        type Right<const M: usize> = SMatrix<$scalar, 9, M>;

        /// The matrix at a pose, and where C is from A, and D from B0.
        #[inline]
        #[allow(clippy::excessive_precision, reason = "in single precision")]
        fn matrix(pose: &Pose) -> (Matrix, [$scalar; 2], [$scalar; 2]) {
            let along = |r: $scalar, u: Vector2<$scalar>| [r * u.x, r * u.y];
            let (coupler, rocker) = (pose.coupler_direction(), pose.rocker_direction());
            let a = along(80.0, pose.crank_direction());
            let matrix = dense::matrix(&[
                Pin { first: None, second: (0, [0.0, 0.0]) },
                Pin { first: Some((0, a)), second: (1, [0.0, 0.0]) },
                Pin { first: Some((1, along(100.0, coupler))), second: (2, along(120.0, rocker)) },
                Pin { first: None, second: (2, [0.0, 0.0]) },
            ]);
            let ([x, y], [p, q]) = (along(42.5, coupler), along(55.621_488_653_217_47, coupler));
            (matrix, [x - q, y + p], along(90.0, rocker))
        }

        /// The equations at a pose with both loads.
        #[inline]
        pub(crate) fn equations(pose: &Pose, loads: &Loads) -> (Matrix, Right<1>) {
            let (matrix, c, d) = matrix(pose);
            let mut right = Right::zeros();
            dense::load(&mut right, 0, 1, c, loads.F13.into());
            dense::load(&mut right, 0, 2, d, loads.F14.into());
            (matrix, right)
        }

        #[inline]
        pub(crate) fn put(solution: Option<Right<1>>, out: &mut All) -> bool {
            let Some(x) = solution else { return false };
            let force = |k: usize| Vector2::new(x[k], x[k + 1]);
            *out = Reactions { torque: x[8], forces: [force(0), force(2), force(4), force(6)] };
            true
        }

        pub(crate) fn statics_eliminated(
            case: &Case<Pose, Loads>,
            out: &mut All,
            solve: impl Fn(Matrix, &Right<1>) -> Option<Right<1>>,
        ) -> bool {
            let (matrix, right) = equations(&case.start, &case.loads);
            put(solve(matrix, &right), out)
        }

        pub(crate) fn statics_at_eliminated(
            case: &At,
            out: &mut All,
            solve: impl Fn(Matrix, &Right<1>) -> Option<Right<1>>,
        ) -> bool {
            let Ok(start) = Pose::at(case.start) else { return false };
            statics_eliminated(&Case { start, loads: case.loads }, out, solve)
        }

        pub(crate) fn torque_at_eliminated(
            case: &At,
            out: &mut $scalar,
            solve: impl Fn(Matrix, &Right<1>) -> Option<Right<1>>,
        ) -> bool {
            let Ok(pose) = Pose::at(case.start) else { return false };
            let (matrix, right) = equations(&pose, &case.loads);
            let Some(x) = solve(matrix, &right) else { return false };
            *out = x[8];
            true
        }

        pub(crate) fn parts_at_eliminated(
            case: &At,
            out: &mut [All; 2],
            solve: impl Fn(Matrix, &Right<2>) -> Option<Right<2>>,
        ) -> bool {
            let Ok(pose) = Pose::at(case.start) else { return false };
            let (matrix, c, d) = matrix(&pose);
            let mut right = Right::zeros();
            dense::load(&mut right, 0, 1, c, case.loads.F13.into());
            dense::load(&mut right, 1, 2, d, case.loads.F14.into());
            let Some(x) = solve(matrix, &right) else { return false };
            put(Some(x.column(0).into_owned()), &mut out[0]) && put(Some(x.column(1).into_owned()), &mut out[1])
        }
    };
}

/// What competes in every scalar: the experts, what is generated in plain arithmetic, and elimination.
macro_rules! competitors {
    ($name:ident, $scalar:ident, $linkage:ident) => {
        pub(crate) mod $name {
            use linkage_runtime::Vector2;
            use nalgebra::SMatrix;

            use crate::expert::$linkage as expert;
            use crate::items::dense::{self, Pin};
            use crate::items::{Case, Reactions, Start};
            use crate::linkages::$linkage::{Loads, Pose};

            type All = Reactions<4, $scalar>;
            type At = Case<$scalar, Loads>;

            generated!($scalar, $linkage, $linkage);
            eliminated!($scalar, $linkage);

            impl Start for expert::Pose {
                fn depend(&mut self, _: f64) -> bool {
                    false
                }
            }

            pub(crate) fn statics_expert(case: &Case<expert::Pose, Loads>, out: &mut All) -> bool {
                case.start.statics(&case.loads, out);
                true
            }

            pub(crate) fn statics_careful(case: &Case<expert::Pose, Loads>, out: &mut All) -> bool {
                case.start.statics(&case.loads, out);
                out.is_finite()
            }

            pub(crate) fn statics_at_expert(case: &At, out: &mut All) -> bool {
                expert::pose(case.start).statics(&case.loads, out);
                true
            }

            pub(crate) fn statics_at_by_cosine(case: &At, out: &mut All) -> bool {
                expert::pose_by_cosine(case.start).statics(&case.loads, out);
                true
            }

            pub(crate) fn statics_at_careful(case: &At, out: &mut All) -> bool {
                let Some(pose) = expert::careful_pose(case.start) else { return false };
                pose.statics(&case.loads, out);
                out.is_finite()
            }

            pub(crate) fn torque_at_expert(case: &At, out: &mut $scalar) -> bool {
                *out = expert::pose(case.start).torque_of(&case.loads);
                true
            }

            pub(crate) fn torque_at_by_cosine(case: &At, out: &mut $scalar) -> bool {
                *out = expert::pose_by_cosine(case.start).torque_of(&case.loads);
                true
            }

            pub(crate) fn torque_at_careful(case: &At, out: &mut $scalar) -> bool {
                let Some(pose) = expert::careful_pose(case.start) else { return false };
                *out = pose.torque_of(&case.loads);
                out.is_finite()
            }

            pub(crate) fn parts_at_expert(case: &At, out: &mut [All; 2]) -> bool {
                expert::pose(case.start).parts(&case.loads, out);
                true
            }

            pub(crate) fn parts_at_by_cosine(case: &At, out: &mut [All; 2]) -> bool {
                expert::pose_by_cosine(case.start).parts(&case.loads, out);
                true
            }

            pub(crate) fn parts_at_careful(case: &At, out: &mut [All; 2]) -> bool {
                let Some(pose) = expert::careful_pose(case.start) else { return false };
                pose.parts(&case.loads, out);
                out[0].is_finite() && out[1].is_finite()
            }
        }
    };
}
competitors!(double, f64, four_bar);
competitors!(single, f32, four_bar_single);

/// What is generated in fused arithmetic.
pub(crate) mod fused {
    use crate::items::{Case, Reactions, Start};

    generated!(f64, four_bar_fused, four_bar);
}

/// The same in single precision.
pub(crate) mod fused_single {
    use crate::items::{Case, Reactions, Start};

    generated!(f32, four_bar_fused_single, four_bar_single);
}

fn statics_at_pose(case: &At, out: &mut All) -> bool {
    match Pose::at(case.start).and_then(|pose| pose.statics(&case.loads)) {
        Ok(all) => {
            *out = reactions!(all);
            true
        }
        Err(_) => false,
    }
}

/// The exact forces and torque.
pub(crate) fn exact(theta: &Big, loads: &Loads) -> Exact {
    let [first, second] = [loads.F13, loads.F14].map(|force| vector(force.x, force.y));
    solve(theta, &[Some(first), Some(second)])
}

pub(crate) fn exact_parts(theta: &Big, loads: &Loads) -> Vec<Exact> {
    let [first, second] = [loads.F13, loads.F14].map(|force| vector(force.x, force.y));
    vec![solve(theta, &[Some(first), None]), solve(theta, &[None, Some(second)])]
}

/// The places of A0, A, B and B0.
fn joints(theta: &Big) -> [Vector; 4] {
    let (a0, b0) = (vector(0.0, 0.0), vector(140.0, 0.0));
    let a = theta.direction().map(|x| Big::of(80.0) * x);
    let b = left(&a, &b0, &Big::of(100.0), &Big::of(120.0));
    [a0, a, b, b0]
}

/// The exact solution under the forces at C and at D.
fn solve(theta: &Big, forces: &[Option<Vector>; 2]) -> Exact {
    let number = |x: f64| Big::of(x);
    let [a0, a, b, b0] = joints(theta);
    let c = left(&a, &b, &number(70.0), &number(80.0));
    let d = in_frame(&b0, &b, &number(120.0), &number(90.0), &number(0.0));
    let pin = |first, second, at: &Vector| Joint { first, second, at: at.clone(), kind: Kind::Pin };
    let joints = [pin(None, 0, &a0), pin(Some(0), 1, &a), pin(Some(1), 2, &b), pin(None, 2, &b0)];
    let loads = [(1, c), (2, d)].into_iter().zip(forces);
    let loads = loads.filter_map(|((link, at), force)| force.clone().map(|force| Load { link, at, force }));
    equilibrium(3, &joints, &loads.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use linkage_runtime::Vector2;

    use super::*;
    use crate::exact::difference;

    /// The fifteen digits that the figures are stored with.
    fn digits(value: &Big) -> String {
        format!("{:.14e}", value.to_f64())
    }

    fn polar(size: f64, degrees: f64) -> Vector {
        Big::degrees(degrees).direction().map(|x| Big::of(size) * x)
    }

    /// The figures of METU Example 6.3, found by other means in 80 digits; not the page's, some of which are misprints.
    #[test]
    fn the_reference_has_the_seeds_digits() {
        let theta = Big::degrees(60.0);
        let (first, second) = (polar(50.0, 230.0), polar(100.0, 200.0));

        let all = solve(&theta, &[Some(first.clone()), Some(second.clone())]);
        assert_eq!(digits(&all.torque), "-2.90132766207453e3");
        // F23, F34, G14: on the coupler by the crank, on the rocker by the coupler, on the rocker by the ground.
        let [_, a, b, b0] = all.forces.try_into().expect("four joints");
        assert_eq!(a.map(|x| digits(&x)), ["9.87412004295161e1", "9.84915843924005e1"]);
        assert_eq!(b.map(|x| digits(&x)), ["6.66018199451891e1", "6.01893622364516e1"]);
        assert_eq!(b0.map(|x| digits(&x)), ["2.73674421334017e1", "-2.59873479038848e1"]);

        assert_eq!(digits(&solve(&theta, &[None, Some(second)]).torque), "-3.18344052096837e3");
        assert_eq!(digits(&solve(&theta, &[Some(first), None]).torque), "2.82112858893847e2");
    }

    /// The angles of coupler and rocker there, as far as their digits go.
    #[test]
    fn the_reference_has_the_seeds_pose() {
        let [_, a, b, b0] = joints(&Big::degrees(60.0));
        for (from, length, degrees) in [(a, 100.0, 29.979_957_439_997_5), (b0, 120.0, 96.401_778_961_795_7)] {
            let [x, y] = difference(&difference(&b, &from), &polar(length, degrees));
            assert!(x.to_f64().hypot(y.to_f64()) < 1e-15 * length, "{x:?} {y:?} at {degrees}°");
        }
    }

    /// What makes the careful expert careful.
    #[test]
    fn the_careful_expert_refuses_what_generated_code_refuses() {
        let loads = super::super::Loads::toward(1.0, 2.0);
        let endless = Loads { F13: Vector2::new(f64::INFINITY, 0.0), ..loads };
        let angles = [std::f64::consts::PI, f64::NAN, f64::INFINITY].map(|start| Case { start, loads });
        for case in angles.into_iter().chain([Case { start: 1.0, loads: endless }]) {
            let mut out = All::default();
            assert!(
                !double::statics_at_generated(&case, &mut out) && !double::statics_at_careful(&case, &mut out),
                "{case:?}"
            );
            let mut out = [All::default(); 2];
            assert!(
                !double::parts_at_generated(&case, &mut out) && !double::parts_at_careful(&case, &mut out),
                "{case:?}"
            );
            let mut out = 0.0;
            assert!(
                !double::torque_at_generated(&case, &mut out) && !double::torque_at_careful(&case, &mut out),
                "{case:?}"
            );
        }
    }
}
