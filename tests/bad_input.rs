//! Bad input at run time, in both scalars: a typed error from every scene, and no NaN or infinity in any result.

use std::fmt::Debug;

use linkage_runtime::Error;

/// What each scene gives, from a pose and straight from the drive.
type Outcomes = Vec<(&'static str, Result<String, Error>)>;

fn text(result: impl Debug) -> String {
    format!("{result:?}")
}

macro_rules! outcomes {
    ($module:ident, $pose:expr; $($scene:ident($($argument:expr),*), $straight:ident($($all:expr),*);)*) => {
        vec![$(
            (stringify!($scene), $pose.and_then(|pose| pose.$scene($($argument),*).map(text))),
            (stringify!($straight), $module::$straight($($all),*).map(text)),
        )*]
    };
}

/// Every scene fails in this way, but for those of these names.
fn all_fail(outcomes: Outcomes, but: &[&str], expected: impl Fn(&Error) -> bool) {
    for (scene, outcome) in outcomes {
        if but.contains(&scene) {
            assert!(outcome.is_ok(), "{scene}: {outcome:?}");
        } else {
            assert!(outcome.as_ref().is_err_and(&expected), "{scene}: {outcome:?}");
        }
    }
}

macro_rules! scalar {
    ($scalar:ident) => {
        mod $scalar {
            use linkage_runtime::{Error, Vector2, linkage};

            use super::{Outcomes, all_fail, text};

            linkage! {
                /// Folds when `theta` is π, and can be assembled everywhere else.
                mod folding;
                units { mm, N }
                scalar $scalar;

                ground       { A0: (0, 0), B0: (140mm, 0) }
                link crank   { A0 -> A: 80mm }
                link coupler { A -> B: 100mm, C: (50mm, 20mm) }
                link rocker  { B0 -> B: 120mm }
                mass rocker: 2kg at (60mm, 0);

                revolute A0: ground  -> crank;
                revolute A:  crank   -> coupler;
                revolute B:  coupler -> rocker;
                revolute B0: ground  -> rocker;

                drive theta: A0;
                unknown T12: torque(ground -> crank);
                assemble B: left(A -> B0);

                load F: force(coupler.C);
                load M: moment(rocker);
                load W: gravity = 9.81m/s^2 @ -90deg;

                scene place:   position;
                scene statics: equilibrium;
                scene parts:   superposition;
                scene torque:  virtual_work -> (T12);
                scene terms:   virtual_work -> (F, M, W);
                scene check:   verify;
            }

            linkage! {
                /// Of the default base it stays open when `theta` is π, by 60 mm.
                mod opening;
                units { mm, N }
                scalar $scalar;
                param base: length = 200mm;

                ground       { A0: (0, 0), B0: (base, 0) }
                link crank   { A0 -> A: 80mm }
                link coupler { A -> B: 100mm }
                link rocker  { B0 -> B: 120mm }

                revolute A0: ground  -> crank;
                revolute A:  crank   -> coupler;
                revolute B:  coupler -> rocker;
                revolute B0: ground  -> rocker;

                drive theta: A0;
                assemble B: right(A -> B0);

                load F: force(rocker.B);

                scene place:   position;
                scene statics: equilibrium;
                scene parts:   superposition;
                scene torque:  virtual_work;
                scene check:   verify;
            }

            linkage! {
                /// Points by functions that take some parameters and no others.
                mod functions;
                units { mm, N }
                scalar $scalar;
                param reach: length;
                param ratio: number;

                ground     { O: (0, 0) }
                link lever { O, P: (sqrt(reach^2 - 400mm^2), 0), Q: 10mm @ acos(ratio), R: 10mm @ asin(2*ratio),
                             S: (1mm/ratio, 0) }
                revolute O: ground -> lever;
                drive theta: O;

                load F: force(lever.P) = (0N, 1N);
                load G: force(lever.Q) = (0N, 2N);
                load H: force(lever.R) = (0N, 3N);
                load J: force(lever.S) = (0N, 4N);

                scene statics: equilibrium;
            }

            linkage! {
                /// Directions that are none where a parameter is zero.
                mod directions;
                units { mm, N }
                scalar $scalar;
                param k: number;
                param d: length;
                param p: number;

                ground       { O: (0, 0) }
                link block   { P: (0, 0), E: (d, 0) }
                link plunger { P: (0, 0), Q: 10mm @ atan2(p, 2*p) }
                prismatic X: ground.O -> block.P along (k, 2*k);
                prismatic Y: block.P -> plunger.P along P -> E of block;
                drive x: X;
                drive y: Y;

                load F: force(plunger.P) = (3N, 1N);

                scene place: position -> (plunger.P);
                scene up: equilibrium -> (X);
                scene turned: position -> (plunger.Q);
            }

            const PI: $scalar = std::$scalar::consts::PI;
            const MAX: $scalar = $scalar::MAX;
            const NOT_FINITE: [$scalar; 3] = [$scalar::NAN, $scalar::INFINITY, $scalar::NEG_INFINITY];

            fn folding(theta: $scalar, [x, y, m]: [$scalar; 3]) -> Outcomes {
                let loads = folding::Loads { F: Vector2::new(x, y), M: m };
                outcomes! { folding, folding::Pose::at(theta);
                    place(), place_at(theta);
                    statics(&loads), statics_at(theta, &loads);
                    parts(&loads), parts_at(theta, &loads);
                    torque(&loads), torque_at(theta, &loads);
                    terms(&loads), terms_at(theta, &loads);
                    check(&loads), check_at(theta, &loads);
                }
            }

            fn opening(base: $scalar, theta: $scalar) -> Outcomes {
                let loads = opening::Loads { F: Vector2::new(30.0, -40.0) };
                let linkage = opening::Linkage::new(&opening::Params { base });
                let Ok(linkage) = linkage else { return vec![("new", linkage.map(text))] };
                outcomes! { opening, opening::Pose::at(&linkage, theta);
                    place(), place_at(&linkage, theta);
                    statics(&loads), statics_at(&linkage, theta, &loads);
                    parts(&loads), parts_at(&linkage, theta, &loads);
                    torque(&loads), torque_at(&linkage, theta, &loads);
                    check(&loads), check_at(&linkage, theta, &loads);
                }
            }

            /// How near the fold is cannot be known where the rounding of the angle is about a turn.
            #[test]
            fn an_angle_whose_rounding_is_about_a_turn() {
                for theta in [1.0 / $scalar::EPSILON, -1e3 / $scalar::EPSILON] {
                    let expected = |error: &Error| matches!(error, Error::DeadCentre { .. });
                    all_fail(folding(theta, [1.0, 2.0, 3.0]), &["place", "place_at"], expected);
                }
                let outcomes = folding(0.01 / $scalar::EPSILON, [1.0, 2.0, 3.0]);
                assert!(outcomes.iter().all(|(_, outcome)| outcome.is_ok()), "{outcomes:?}");
            }

            #[test]
            fn a_drive_that_is_not_finite() {
                for theta in NOT_FINITE {
                    let expected = |error: &Error| *error == Error::NotFinite { what: "theta" };
                    all_fail(folding(theta, [1.0, 2.0, 3.0]), &[], expected);
                    all_fail(opening(200.0, theta), &[], expected);
                }
            }

            #[test]
            fn a_load_that_is_not_finite() {
                for bad in NOT_FINITE {
                    for loads in [[bad, 2.0, 3.0], [1.0, bad, 3.0], [1.0, 2.0, bad]] {
                        let expected = |error: &Error| *error == Error::NotFinite { what: "a load or a result" };
                        all_fail(folding(1.0, loads), &["place", "place_at"], expected);
                    }
                }
            }

            #[test]
            fn a_parameter_that_is_not_finite() {
                for base in NOT_FINITE {
                    all_fail(opening(base, 1.0), &[], |error| *error == Error::NotFinite { what: "base" });
                }
            }

            #[test]
            fn a_parameter_that_a_function_does_not_take() {
                let statics = |reach, ratio| {
                    let linkage = functions::Linkage::new(&functions::Params { reach, ratio })?;
                    functions::statics_at(&linkage, 0.0).map(|found| found.effort_theta)
                };
                // Forces upwards balance against the sum of moments: 1·√(r² − 400) + 2·10 cos acos + 3·10 cos asin + 4/ratio.
                let moments = 15.0 + 20.0 * 0.5 + 8.0;
                let found: $scalar = statics(25.0, 0.5).expect("within both domains, at the end of one");
                assert!((found + moments).abs() < 1e-5, "{found}");
                for (reach, ratio, expected) in [
                    (19.0, 0.5, Some("`reach^2 - 400mm^2`, whose root is taken, must not be negative")),
                    (25.0, 0.51, Some("`2*ratio`, of which `asin` is taken, must be from −1 to 1")),
                    (25.0, -1.5, Some("`ratio`, of which `acos` is taken, must be from −1 to 1")),
                    (25.0, 0.0, Some("`ratio`, by which is divided, must not be zero")),
                    (25.0, $scalar::from_bits(1), None),
                ] {
                    let expected = match expected {
                        Some(requirement) => Error::Parameter { requirement },
                        None => Error::NotFinite { what: "what is made of the parameters" },
                    };
                    assert_eq!(statics(reach, ratio), Err(expected));
                }
            }

            #[test]
            fn a_direction_of_parameters_that_vanish() {
                let root = $scalar::sqrt(5.0);
                let at = |k, d, p| {
                    let linkage = directions::Linkage::new(&directions::Params { k, d, p })?;
                    let place = directions::place_at(&linkage, root, 3.0)?.plunger_P;
                    let turned = directions::turned_at(&linkage, root, 3.0)?.plunger_Q - place;
                    directions::up_at(&linkage, root, 3.0).map(|found| (place, found.X.normal, turned))
                };
                let near = |found: $scalar, expected: $scalar| (found - expected).abs() < 4.0 * $scalar::EPSILON * 10.0;
                for (k, d) in
                    [(1.0, 2.0), (-1.0, 2.0), (1.0, -2.0), ($scalar::MIN_POSITIVE, 1e30), (1e30, $scalar::from_bits(1))]
                {
                    let (place, normal, turned) = at(k, d, -k).expect("directions");
                    // A sign turns the slide, and its normal with it.
                    assert!(near(place.x, k.signum() + 3.0 * d.signum()) && near(place.y, 2.0 * k.signum()), "{place}");
                    assert!(near(normal * root, 5.0 * k.signum()), "{normal}");
                    assert!(
                        near(turned.x * root, -20.0 * k.signum()) && near(turned.y * root, -10.0 * k.signum()),
                        "{turned}"
                    );
                }
                for (k, d, p, requirement) in [
                    (0.0, 2.0, 1.0, "ground: the direction `(k, 2*k)` must not be the zero vector"),
                    (1.0, 0.0, 1.0, "block: the direction `P -> E` must not be the zero vector"),
                    (1.0, -0.0, 1.0, "block: the direction `P -> E` must not be the zero vector"),
                    (1.0, 2.0, 0.0, "of `p` and `2*p` one must not be zero, of which `atan2` is taken"),
                ] {
                    assert_eq!(at(k, d, p), Err(Error::Parameter { requirement }));
                }
            }

            #[test]
            fn a_pose_that_cannot_be_assembled() {
                // Too far apart; too close together, the outer pins in one place.
                for (base, theta, open) in [(200.0, PI, 60.0), (80.0, 0.0, 20.0)] {
                    all_fail(opening(base, theta), &[], |error| match *error {
                        Error::CannotAssemble { group: "coupler + rocker", joint: "B", gap } => {
                            (gap - open).abs() < 1e-4 * open
                        }
                        _ => false,
                    });
                }
            }

            #[test]
            fn a_dead_centre() {
                let expected =
                    |error: &Error| *error == Error::DeadCentre { group: "coupler + rocker", pivot: "sin_mu_B" };
                all_fail(folding(PI, [1.0, 2.0, 3.0]), &["place", "place_at"], expected);
            }

            /// Whatever comes in, what comes out as a result is a number.
            #[test]
            fn no_result_is_infinite_or_nan() {
                let tiny = $scalar::from_bits(1);
                let values =
                    [0.0, -0.0, 1.0, -1e3, tiny, -tiny, $scalar::MIN_POSITIVE, MAX, -MAX, 0.4 * MAX, MAX.sqrt()];
                let mut results = 0;
                for theta in values.into_iter().chain([PI, -PI, PI / 2.0, 1e4]) {
                    let with_loads = values.into_iter().flat_map(|x| values.map(|m| folding(theta, [x, 2.0, m])));
                    for (scene, outcome) in
                        with_loads.flatten().chain(values.into_iter().flat_map(|b| opening(b, theta)))
                    {
                        let Ok(text) = outcome else { continue };
                        results += 1;
                        assert!(!text.contains("NaN") && !text.contains("inf"), "{scene} at {theta}: {text}");
                    }
                }
                assert!(results > 1000, "{results} results");
            }
        }
    };
}

scalar!(f64);
scalar!(f32);
