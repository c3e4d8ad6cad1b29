//! What an expert writes by hand: one sine and cosine of the driver's angle by the platform's library, one square root
//! and two divisions for each dyad, and no check of anything.
//!
//! Vectors between joints are carried in millimetres instead of unit vectors, twice the area of the dyad's triangle
//! comes from the square root and serves as determinant of its two moment equations, and its reciprocal does not wait
//! for the positions. What this costs in digits, next to a fold, is seen beside the times.
//!
//! The plain expert intersects circles, as for any dyad. For the four-bar and the six-bar another one knows that the two sides of the triangle
//! over the crank are constants, and takes its third one from the law of cosines.
//!
//! The careful expert of the four-bar takes half the driver's angle, so that nothing cancels at the fold, and checks
//! what generated code checks: the angle, the dead centre, and that the results are finite.

use linkage_runtime::Vector2;

use crate::items::Reactions;

/// The four-bar of METU Example 6.3, in a scalar.
macro_rules! four_bar {
    ($scalar:ident) => {
        /// A pose: A0 A, A B, B0 B in mm, and A B × B0 B.
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Pose {
            crank: Vector2<$scalar>,
            coupler: Vector2<$scalar>,
            rocker: Vector2<$scalar>,
            determinant: $scalar,
        }

        /// The pose at an angle of the crank.
        #[inline]
        pub(crate) fn pose(theta: $scalar) -> Pose {
            let (sin, cos) = theta.sin_cos();
            let (ax, ay) = (80.0 * cos, 80.0 * sin);
            // d from A to B0, |d|², and |A B|² − |B0 B|².
            let (dx, dy) = (140.0 - ax, -ay);
            let d2 = dx * dx + dy * dy;
            let sum = d2 - 4400.0;
            let root = (40000.0 * d2 - sum * sum).sqrt();
            let half = 0.5 / d2;
            Pose::closed(Vector2::new(ax, ay), [dx, dy], [sum * half, root * half], root)
        }

        /// The pose of this one loop: |d|² and what the root is taken of by the law of cosines, straight from cos θ.
        #[inline]
        pub(crate) fn pose_by_cosine(theta: $scalar) -> Pose {
            let (sin, cos) = theta.sin_cos();
            let (ax, ay) = (80.0 * cos, 80.0 * sin);
            let (dx, dy) = (140.0 - ax, -ay);
            let twice = 22400.0 * cos;
            let d2 = 26000.0 - twice;
            // (r₁ + r₂)² − |d|² times |d|² − (r₁ − r₂)².
            let root = ((22400.0 + twice) * (25600.0 - twice)).sqrt();
            let half = 0.5 / d2;
            Pose::closed(Vector2::new(ax, ay), [dx, dy], [(21600.0 - twice) * half, root * half], root)
        }

        /// The pose by half the angle; none at the dead centre, or if the angle is not finite.
        #[inline]
        pub(crate) fn careful_pose(theta: $scalar) -> Option<Pose> {
            let (sin, cos) = (0.5 * theta).sin_cos();
            // False for an angle that is not a number too, and for an infinite one, which has no cosine.
            let regular = cos.abs() > 2.0 * $scalar::EPSILON * (1.0 + theta.abs());
            if !regular {
                return None;
            }
            // d from A to B0, |d|² − 60², and √(pq) with p = 4·80·140 cos².
            let (sin2, sin_cos) = (sin * sin, sin * cos);
            let (dx, dy) = (60.0 + 160.0 * sin2, -160.0 * sin_cos);
            let spread = 44800.0 * sin2;
            let root = 211.660_104_885_167_25 * cos.abs() * (3200.0 + spread).sqrt();
            let half = 0.5 / (3600.0 + spread);
            let crank = Vector2::new(80.0 * (cos - sin) * (cos + sin), 160.0 * sin_cos);
            Some(Pose::closed(crank, [dx, dy], [(spread - 800.0) * half, root * half], root))
        }

        impl Pose {
            /// The pose by d, from A to B0, the coupler's parts along it and across it over its length, and twice A B × B0 B.
            #[inline]
            fn closed(
                crank: Vector2<$scalar>,
                [dx, dy]: [$scalar; 2],
                [along, across]: [$scalar; 2],
                root: $scalar,
            ) -> Self {
                let (x, y) = (along * dx - across * dy, along * dy + across * dx);
                let (coupler, rocker) = (Vector2::new(x, y), Vector2::new(x - dx, y - dy));
                Self { crank, coupler, rocker, determinant: 0.5 * root }
            }

            /// A pose that is found otherwise: A0 A, A B and B0 B.
            #[inline]
            pub(crate) fn of(crank: Vector2<$scalar>, coupler: Vector2<$scalar>, rocker: Vector2<$scalar>) -> Self {
                Self { crank, coupler, rocker, determinant: coupler.x * rocker.y - coupler.y * rocker.x }
            }

            /// The force on the rocker by the coupler, from the moments of the loads on coupler and rocker about A and B0.
            #[inline]
            fn joint(&self, inverse: $scalar, m3: $scalar, m4: $scalar) -> ($scalar, $scalar) {
                let (p, q) = (m3 * inverse, m4 * inverse);
                (p * self.rocker.x + q * self.coupler.x, p * self.rocker.y + q * self.coupler.y)
            }

            /// The moment of a force on the coupler at C about A.
            #[inline]
            fn coupler_moment(&self, force: &Vector2<$scalar>) -> $scalar {
                let (x, y) = (self.coupler.x, self.coupler.y);
                0.425 * (x * force.y - y * force.x) - 0.556_214_886_532_174_7 * (x * force.x + y * force.y)
            }

            /// The moment of a force on the rocker at D about B0.
            #[inline]
            fn rocker_moment(&self, force: &Vector2<$scalar>) -> $scalar {
                0.75 * (self.rocker.x * force.y - self.rocker.y * force.x)
            }

            /// The torque on the crank that balances a force on the coupler by the crank.
            #[inline]
            fn torque(&self, ax: $scalar, ay: $scalar) -> $scalar {
                self.crank.x * ay - self.crank.y * ax
            }

            /// All forces and the torque.
            #[inline]
            pub(crate) fn statics(&self, loads: &Loads, out: &mut Reactions<4, $scalar>) {
                let (bx, by) =
                    self.joint(1.0 / self.determinant, self.coupler_moment(&loads.F13), self.rocker_moment(&loads.F14));
                let (ax, ay) = (bx - loads.F13.x, by - loads.F13.y);
                out.torque = self.torque(ax, ay);
                out.forces = [
                    Vector2::new(ax, ay),
                    Vector2::new(ax, ay),
                    Vector2::new(bx, by),
                    Vector2::new(-loads.F14.x - bx, -loads.F14.y - by),
                ];
            }

            /// The same by each load alone.
            #[inline]
            pub(crate) fn parts(&self, loads: &Loads, out: &mut [Reactions<4, $scalar>; 2]) {
                let inverse = 1.0 / self.determinant;
                let p = self.coupler_moment(&loads.F13) * inverse;
                let (bx, by) = (p * self.rocker.x, p * self.rocker.y);
                let (ax, ay) = (bx - loads.F13.x, by - loads.F13.y);
                out[0].torque = self.torque(ax, ay);
                out[0].forces =
                    [Vector2::new(ax, ay), Vector2::new(ax, ay), Vector2::new(bx, by), Vector2::new(-bx, -by)];
                let q = self.rocker_moment(&loads.F14) * inverse;
                let (bx, by) = (q * self.coupler.x, q * self.coupler.y);
                out[1].torque = self.torque(bx, by);
                out[1].forces = [
                    Vector2::new(bx, by),
                    Vector2::new(bx, by),
                    Vector2::new(bx, by),
                    Vector2::new(-loads.F14.x - bx, -loads.F14.y - by),
                ];
            }

            /// Only the torque.
            #[inline]
            pub(crate) fn torque_of(&self, loads: &Loads) -> $scalar {
                let (bx, by) =
                    self.joint(1.0 / self.determinant, self.coupler_moment(&loads.F13), self.rocker_moment(&loads.F14));
                self.torque(bx - loads.F13.x, by - loads.F13.y)
            }
        }
    };
}

pub(crate) mod four_bar {
    use super::{Reactions, Vector2};
    use crate::linkages::four_bar::Loads;

    four_bar!(f64);
}

#[allow(
    dead_code,
    clippy::excessive_precision,
    reason = "a pose that is found otherwise is of the other precision; of a number the nearest there"
)]
pub(crate) mod four_bar_single {
    use super::{Reactions, Vector2};
    use crate::linkages::four_bar_single::Loads;

    four_bar!(f32);
}

/// The six-bar, in a scalar.
macro_rules! six_bar {
    ($scalar:ident) => {
        /// A dyad of three pins: from the vector between its outer joints its links' vectors to the inner joint, which is on
        /// the left, and the reciprocal of their product. The constants are 4r₁² and r₁² − r₂².
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "a call would cost the expert a twentieth of its instructions")]
        fn dyad(dx: $scalar, dy: $scalar, four: $scalar, p: $scalar) -> ([$scalar; 2], [$scalar; 2], $scalar) {
            let d2 = dx * dx + dy * dy;
            let sum = d2 + p;
            closed(dx, dy, d2, sum, (four * d2 - sum * sum).sqrt())
        }

        /// The same by the square of that vector, by this and the difference of the links' squares, and by four times the triangle's area.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "a call would cost the expert a twentieth of its instructions")]
        fn closed(
            dx: $scalar,
            dy: $scalar,
            d2: $scalar,
            sum: $scalar,
            root: $scalar,
        ) -> ([$scalar; 2], [$scalar; 2], $scalar) {
            let half = 0.5 / d2;
            let (along, across) = (sum * half, root * half);
            let (x, y) = (along * dx - across * dy, along * dy + across * dx);
            ([x, y], [x - dx, y - dy], 2.0 / root)
        }

        /// All forces and the torque.
        #[inline]
        pub(crate) fn statics(theta: $scalar, loads: &Loads, out: &mut Reactions<7, $scalar>) {
            let (sin, cos) = theta.sin_cos();
            let (ax, ay) = (50.0 * cos, 50.0 * sin);
            let inner = dyad(150.0 - ax, -ay, 4.0 * 140.0 * 140.0, 140.0 * 140.0 - 100.0 * 100.0);
            balanced([ax, ay], inner, loads, out);
        }

        /// The same with the first dyad closed by the law of cosines: (r₁ + r₂)² − |d|² times |d|² − (r₁ − r₂)² is what the root is taken of.
        #[inline]
        pub(crate) fn statics_by_cosine(theta: $scalar, loads: &Loads, out: &mut Reactions<7, $scalar>) {
            let (sin, cos) = theta.sin_cos();
            let (ax, ay) = (50.0 * cos, 50.0 * sin);
            let twice = 15000.0 * cos;
            let root = ((32600.0 + twice) * (23400.0 - twice)).sqrt();
            let inner = closed(150.0 - ax, -ay, 25000.0 - twice, 34600.0 - twice, root);
            balanced([ax, ay], inner, loads, out);
        }

        /// The outer dyad, and the forces from there inwards.
        #[inline(always)]
        #[allow(clippy::inline_always, reason = "a call would cost the expert a twentieth of its instructions")]
        fn balanced(
            [ax, ay]: [$scalar; 2],
            ([x3, y3], [x4, y4], inverse_b): ([$scalar; 2], [$scalar; 2], $scalar),
            loads: &Loads,
            out: &mut Reactions<7, $scalar>,
        ) {
            const G: $scalar = 9.81;
            let (cx, cy) = (0.8 * x4 + 0.4 * y4, 0.8 * y4 - 0.4 * x4);
            let ([x5, y5], [x6, y6], inverse_d) =
                dyad(180.0 - cx, 20.0 - cy, 4.0 * 170.0 * 170.0, 170.0 * 170.0 - 110.0 * 110.0);

            // The outer dyad: moments of the loads about C and D0, forces at D, C and D0.
            let m5 = -0.5 * 0.7 * G * x5;
            let g = &loads.G;
            let m6 = (70.0 / 110.0) * (x6 * g.y - y6 * g.x)
                - (25.0 / 110.0) * (x6 * g.x + y6 * g.y)
                - 0.6 * G * ((50.0 / 110.0) * x6 - (8.0 / 110.0) * y6);
            let (p, q) = (m5 * inverse_d, m6 * inverse_d);
            let (fdx, fdy) = (p * x6 + q * x5, p * y6 + q * y5);
            let (fcx, fcy) = (fdx, fdy + 0.7 * G);
            let (fd0x, fd0y) = (-g.x - fdx, 0.6 * G - g.y - fdy);

            // The inner one: the load of the rod acts on the rocker at C.
            let f = &loads.F;
            let m3 = (60.0 / 140.0) * (x3 * f.y - y3 * f.x)
                - (35.0 / 140.0) * (x3 * f.x + y3 * f.y)
                - 0.9 * G * ((65.0 / 140.0) * x3 - (12.0 / 140.0) * y3);
            let m4 = cy * fcx - cx * fcy - 0.8 * G * (0.6 * x4 + 0.1 * y4);
            let (p, q) = (m3 * inverse_b, m4 * inverse_b);
            let (fbx, fby) = (p * x4 + q * x3, p * y4 + q * y3);
            let (fax, fay) = (fbx - f.x, fby - f.y + 0.9 * G);
            let (fb0x, fb0y) = (fcx - fbx, fcy + 0.8 * G - fby);

            out.torque = ax * fay - ay * fax + 0.5 * 0.4 * G * ax;
            out.forces = [
                Vector2::new(fax, fay + 0.4 * G),
                Vector2::new(fax, fay),
                Vector2::new(fbx, fby),
                Vector2::new(fb0x, fb0y),
                Vector2::new(fcx, fcy),
                Vector2::new(fdx, fdy),
                Vector2::new(fd0x, fd0y),
            ];
        }
    };
}

pub(crate) mod six_bar {
    use super::{Reactions, Vector2};
    use crate::linkages::six_bar::Loads;

    six_bar!(f64);
}

pub(crate) mod six_bar_single {
    use super::{Reactions, Vector2};
    use crate::linkages::six_bar_single::Loads;

    six_bar!(f32);
}

/// The slider-crank, in a scalar.
macro_rules! slider_crank {
    ($scalar:ident) => {
        /// All forces and the torque.
        #[inline]
        pub(crate) fn statics(theta: $scalar, loads: &Loads, out: &mut Reactions<4, $scalar>) {
            let (sin, cos) = theta.sin_cos();
            let (ax, ay) = (45.0 * cos, 45.0 * sin);
            // The rod's vector is (√(l² − ay²), −ay), and the force in it goes along it.
            let x = (22500.0 - ay * ay).sqrt();
            let (fx, fy) = (-loads.gas.x, loads.gas.x * ay / x);
            out.torque = ax * fy - ay * fx;
            out.forces = [
                Vector2::new(fx, fy),
                Vector2::new(fx, fy),
                Vector2::new(fx, fy),
                Vector2::new(0.0, -loads.gas.y - fy),
            ];
        }
    };
}

pub(crate) mod slider_crank {
    use super::{Reactions, Vector2};
    use crate::linkages::slider_crank::Loads;

    slider_crank!(f64);
}

pub(crate) mod slider_crank_single {
    use super::{Reactions, Vector2};
    use crate::linkages::slider_crank_single::Loads;

    slider_crank!(f32);
}
