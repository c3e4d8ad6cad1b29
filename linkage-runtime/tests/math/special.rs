//! Zeros, signs, subnormal numbers, axes, and what is not finite.

/// The same tests for both modules; `$π` is π rounded to the type.
macro_rules! special_values {
    ($type:ident) => {
        mod $type {
            use std::$type::consts::{FRAC_PI_2, FRAC_PI_4, PI};

            use linkage_runtime::math::$type::{
                atan2, fused_sin_cos, fused_sin_cos_half, fused_sin_cos_sum, polar, sin_cos, sin_cos_half, sin_cos_sum,
                sqrt, unit,
            };

            const BAD: [$type; 3] = [$type::NAN, $type::INFINITY, $type::NEG_INFINITY];
            const GOOD: [$type; 9] = [0.0, -0.0, 1.0, -2.5, $type::MAX, $type::MIN, $type::MIN_POSITIVE, TINY, 1e5];
            const TINY: $type = $type::from_bits(1);

            #[track_caller]
            fn same(a: $type, b: $type) {
                assert_eq!(a.to_bits(), b.to_bits(), "{a:e}, {b:e}");
            }

            fn all_nan((a, b): ($type, $type)) -> bool {
                a.is_nan() && b.is_nan()
            }

            #[test]
            fn what_is_not_finite_becomes_nan() {
                for bad in BAD {
                    assert!(all_nan(sin_cos(bad)) && all_nan(fused_sin_cos(bad)));
                    assert!(all_nan(sin_cos_sum(bad, 1.0, 0.0)) && all_nan(fused_sin_cos_sum(bad, 1.0, 0.0)));
                    for good in GOOD.into_iter().chain(BAD) {
                        for (a, b) in [(bad, good), (good, bad)] {
                            assert!(atan2(a, b).is_nan(), "atan2({a:e}, {b:e})");
                            assert!(all_nan(unit(a, b)), "unit({a:e}, {b:e})");
                            assert!(all_nan(polar(a, b)), "polar({a:e}, {b:e})");
                        }
                        for sum in [sin_cos_sum, fused_sin_cos_sum] {
                            assert!(all_nan(sum(good, bad, 0.0)) && all_nan(sum(good, 1.0, bad)));
                        }
                    }
                }
                assert!(sqrt($type::NAN).is_nan());
            }

            #[test]
            fn what_is_finite_stays_finite() {
                for a in GOOD {
                    for (sin, cos) in [sin_cos(a), fused_sin_cos(a)] {
                        assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "{a:e}");
                    }
                    for b in GOOD {
                        assert!(atan2(a, b).abs() <= PI, "atan2({a:e}, {b:e})");
                        let (x, y) = unit(a, b);
                        assert!(x.abs() <= 1.0 && y.abs() <= 1.0, "unit({a:e}, {b:e})");
                        let (x, y) = polar(a, b);
                        assert!(x.abs() <= a.abs() && y.abs() <= a.abs(), "polar({a:e}, {b:e})");
                    }
                }
            }

            #[test]
            fn sine_of_small_angles_is_the_angle() {
                for x in [0.0, TINY, 7.0 * TINY, $type::MIN_POSITIVE, 1e-30, $type::EPSILON / 4.0] {
                    for sin_cos in [sin_cos, fused_sin_cos] {
                        let ((sin, cos), (negative, _)) = (sin_cos(x), sin_cos(-x));
                        same(sin, x);
                        same(negative, -x);
                        same(cos, 1.0);
                    }
                }
            }

            #[test]
            fn angles_on_axes_and_diagonals() {
                for size in [TINY, $type::MIN_POSITIVE, 1e-20, 1.0, 3e30, $type::MAX] {
                    for zero in [0.0, -0.0] {
                        same(atan2(zero, size), zero);
                        same(atan2(zero, -size), PI.copysign(zero));
                        same(atan2(size, zero), FRAC_PI_2);
                        same(atan2(-size, zero), -FRAC_PI_2);
                    }
                    same(atan2(size, size), FRAC_PI_4);
                    same(atan2(-size, size), -FRAC_PI_4);
                    same(atan2(size, -size), (0.75 * std::f64::consts::PI) as $type);
                }
            }

            #[test]
            fn the_angle_of_nothing() {
                same(atan2(0.0, 0.0), 0.0);
                same(atan2(-0.0, 0.0), -0.0);
                same(atan2(0.0, -0.0), PI);
                same(atan2(-0.0, -0.0), -PI);
            }

            #[test]
            fn angles_that_underflow_or_saturate() {
                same(atan2(TINY, $type::MAX), 0.0);
                same(atan2(-TINY, $type::MAX), -0.0);
                same(atan2(TINY, $type::MIN), PI);
                same(atan2($type::MAX, TINY), FRAC_PI_2);
                same(atan2(3.0 * TINY, 1.0), 3.0 * TINY);
                same(atan2(3.0 * TINY, 2.0), 2.0 * TINY);
            }

            #[test]
            fn directions_along_the_axes_are_exact() {
                for size in [TINY, $type::MIN_POSITIVE, 0.1, 3e30, $type::MAX] {
                    assert_eq!(unit(size, 0.0), (1.0, 0.0));
                    assert_eq!(unit(0.0, -size), (0.0, -1.0));
                }
                for (x, y) in [(0.0, 0.0), (-0.0, 0.0), (0.0, -0.0)] {
                    same(unit(x, y).0, x);
                    same(unit(x, y).1, y);
                }
            }

            #[test]
            fn of_half_an_angle_the_same_bits() {
                let bits = |(sin, cos): ($type, $type)| [sin, cos].map($type::to_bits);
                let turns = (0_u16..50_000).map(|i| $type::from(i) * 0.013_7);
                let sizes = (0..2000).map(|i| $type::from_bits($type::MAX.to_bits() / 2000 * i));
                let long = (0_u16..100).map(|i| 4e5 + 5e3 * $type::from(i));
                for x in turns.chain(sizes).chain(long).chain([0.0, $type::MAX, $type::INFINITY]) {
                    for x in [x, -x] {
                        assert_eq!(bits(sin_cos_half(x)), bits(sin_cos(0.5 * x)), "{x:e}");
                        assert_eq!(bits(fused_sin_cos_half(x)), bits(fused_sin_cos(0.5 * x)), "fused, {x:e}");
                    }
                }
            }

            #[test]
            fn a_sum_of_zeros_is_zero() {
                for sum in [sin_cos_sum, fused_sin_cos_sum] {
                    assert_eq!(sum(0.0, 0.0, 0.0), (0.0, 1.0));
                    assert_eq!(sum(-1.5, 1.5, TINY), (TINY, 1.0));
                }
                assert_eq!(sin_cos_sum(1.25, 0.0, 0.0), sin_cos(1.25));
                assert_eq!(fused_sin_cos_sum(1.25, 0.0, 0.0), fused_sin_cos(1.25));
            }
        }
    };
}

special_values!(f32);
special_values!(f64);
