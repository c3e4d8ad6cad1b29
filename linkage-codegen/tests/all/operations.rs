//! `docs/operations.md`: the least number of operations that was found by hand for the scenes of two examples, carried out in a number
//! type that counts, beside what is emitted.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::support::examples::declaration;
use crate::support::numbers::Double;
use crate::support::{Arguments, direct, from_pose as from_kept, pose};
use linkage_codegen::Linkage;
use linkage_codegen::model::Method;
use linkage_codegen::program::Program;

/// Sums and differences, products, quotients, square roots, sine and cosine pairs, arc tangents, vectors brought to unit size.
type Tally = [usize; 7];

/// Their words on the page, as in `OPERATIONS`.
const WORDS: [&str; 7] = ["+−", "×", "÷", "√", "sin/cos", "atan2", "unit"];

thread_local! {
    static TALLY: Cell<Tally> = const { Cell::new([0; 7]) };
}

fn count(which: usize) {
    TALLY.with(|tally| {
        let mut counted = tally.get();
        counted[which] += 1;
        tally.set(counted);
    });
}

/// A number that counts what is done with it. Among constants nothing is counted: they are worked out by the compiler.
#[derive(Clone, Copy, Debug)]
struct N(f64);

macro_rules! operators {
    ($($operator:ident $method:ident $which:literal,)*) => {$(
        impl $operator for N {
            type Output = N;
            fn $method(self, other: N) -> N {
                count($which);
                N(self.0.$method(other.0))
            }
        }
        impl $operator<f64> for N {
            type Output = N;
            fn $method(self, other: f64) -> N {
                self.$method(N(other))
            }
        }
        impl $operator<N> for f64 {
            type Output = N;
            fn $method(self, other: N) -> N {
                N(self).$method(other)
            }
        }
    )*};
}
operators!(Add add 0, Sub sub 0, Mul mul 1, Div div 2,);

impl Neg for N {
    type Output = N;
    fn neg(self) -> N {
        N(-self.0)
    }
}

impl N {
    fn sqrt(self) -> N {
        count(3);
        N(self.0.sqrt())
    }
    fn sin_cos(self) -> (N, N) {
        count(4);
        let (sin, cos) = self.0.sin_cos();
        (N(sin), N(cos))
    }
    fn atan2(self, x: N) -> N {
        count(5);
        N(self.0.atan2(x.0))
    }
}

type Vector = [N; 2];

fn cross([ax, ay]: Vector, [bx, by]: Vector) -> N {
    ax * by - ay * bx
}

fn dot([ax, ay]: Vector, [bx, by]: Vector) -> N {
    ax * bx + ay * by
}

fn add([ax, ay]: Vector, [bx, by]: Vector) -> Vector {
    [ax + bx, ay + by]
}

fn sub([ax, ay]: Vector, [bx, by]: Vector) -> Vector {
    [ax - bx, ay - by]
}

fn times(factor: N, [x, y]: Vector) -> Vector {
    [factor * x, factor * y]
}

/// What a scene's formulas find, by the paths of the results; several paths may have the same number.
type Found = Vec<(&'static str, N)>;

fn force(found: &mut Found, paths: &[[&'static str; 2]], [x, y]: Vector) {
    for [of_x, of_y] in paths {
        found.extend([(*of_x, x), (*of_y, y)]);
    }
}

// --- the four-bar -----------------------------------------------------------------------------------------------------------------

/// Units of length, mm: in that of twice the crank's length the pose has a product less.
const MM: f64 = 1.0;
const TWO_CRANKS: f64 = 160.0;

/// From A0 to A, A to B, B0 to B, in a unit of length.
struct Pose {
    crank: Vector,
    coupler: Vector,
    rocker: Vector,
    /// The coupler's parts along d, from A to B0, and across it, over the length of d.
    along: N,
    across: N,
    /// AB × B0B over `area(unit)`.
    kappa: N,
}

/// AB × B0B = b √(2a) |cos θ/2| √(2a sin² θ/2 + 80/7).
fn area(unit: f64) -> f64 {
    140.0 / unit * (160.0 / unit).sqrt()
}

/// The pose without the crank; 2a sin² θ/2 with it.
fn dyad(theta: f64, unit: f64) -> (Pose, N) {
    let (s, c) = (0.5 * N(theta)).sin_cos();
    let u = if unit == TWO_CRANKS { s } else { 160.0 / unit * s };
    let (w, y) = (u * s, u * c);
    let d = [w + 60.0 / unit, -y];
    let kappa = N(c.0.abs()) * (w + 80.0 / 7.0 / unit).sqrt();
    let root = (160.0 / unit).sqrt();
    let half = 0.5 * root / (w + 90.0 / 7.0 / unit);
    let (along, across) = (0.5 - 110.0 / 7.0 / unit / root * half, kappa * half);
    let coupler = [along * d[0] - across * d[1], along * d[1] + across * d[0]];
    (Pose { crank: [N(0.0), y], coupler, rocker: sub(coupler, d), along, across, kappa }, w)
}

fn four_bar_pose(theta: f64, unit: f64) -> Pose {
    let (mut pose, w) = dyad(theta, unit);
    pose.crank[0] = 80.0 / unit - w;
    pose
}

/// C in the frame of the coupler, over its length: (70² + 100² − 80²)/(2·100²), and what is left of 70, over the former.
const ALONG: f64 = 0.425;
fn slope() -> f64 {
    (0.49_f64 - ALONG * ALONG).sqrt() / ALONG
}

/// From A to C, over `ALONG`.
fn to_c(pose: &Pose) -> Vector {
    let [x, y] = pose.coupler;
    [x - slope() * y, y + slope() * x]
}

/// 100 N at 200°.
fn f14() -> [f64; 2] {
    let angle = 200_f64.to_radians();
    [100.0 * angle.cos(), 100.0 * angle.sin()]
}

/// Moments of F13 about A and of F14 about B0, each over `ALONG`.
fn moments(pose: &Pose, f13: Vector) -> (N, N) {
    (cross(to_c(pose), f13), m4(pose, 1.0 / ALONG))
}

/// `factor` times the moment of F14 about B0; D is three quarters of the way from B0 to B.
fn m4(pose: &Pose, factor: f64) -> N {
    let [x, y] = f14();
    0.75 * factor * y * pose.rocker[0] - 0.75 * factor * x * pose.rocker[1]
}

const T12: &str = "T12";

/// All that equilibrium gives, with the forces in A and B.
fn held(torque: N, a: Vector, b: Vector) -> Found {
    let [x, y] = f14();
    let mut found = vec![(T12, torque)];
    force(&mut found, &[["A.x", "A.y"], ["A0.x", "A0.y"]], a);
    force(&mut found, &[["B.x", "B.y"]], b);
    force(&mut found, &[["B0.x", "B0.y"]], [-x - b[0], -y - b[1]]);
    found
}

/// What each load contributes, with the forces in A and B by F13, the force in both by F14, and their torques.
fn held_by_each(torques: [N; 2], [a, b]: [Vector; 2], by_f14: Vector) -> Found {
    let mut found = vec![("F13.T12", torques[0]), ("F14.T12", torques[1])];
    force(&mut found, &[["F13.A.x", "F13.A.y"], ["F13.A0.x", "F13.A0.y"]], a);
    force(&mut found, &[["F13.B.x", "F13.B.y"]], b);
    force(&mut found, &[["F13.B0.x", "F13.B0.y"]], [-b[0], -b[1]]);
    let [x, y] = f14();
    force(&mut found, &[["F14.A.x", "F14.A.y"], ["F14.A0.x", "F14.A0.y"], ["F14.B.x", "F14.B.y"]], by_f14);
    force(&mut found, &[["F14.B0.x", "F14.B0.y"]], [-x - by_f14[0], -y - by_f14[1]]);
    found
}

fn statics_at(theta: f64, f13: Vector) -> Found {
    let pose = four_bar_pose(theta, MM);
    let inverse = ALONG / area(MM) / pose.kappa;
    let (m3, m4) = moments(&pose, f13);
    let b = add(times(m3 * inverse, pose.rocker), times(m4 * inverse, pose.coupler));
    let a = sub(b, f13);
    held(cross(pose.crank, a), a, b)
}

fn parts_at(theta: f64, f13: Vector) -> Found {
    let pose = four_bar_pose(theta, MM);
    let inverse = ALONG / area(MM) / pose.kappa;
    let (m3, m4) = moments(&pose, f13);
    let b = times(m3 * inverse, pose.rocker);
    let a = sub(b, f13);
    let by_f14 = times(m4 * inverse, pose.coupler);
    held_by_each([cross(pose.crank, a), cross(pose.crank, by_f14)], [a, b], by_f14)
}

/// A0A × AB over b, mm; A0A × B0B over b is more than that by the y of A.
fn swept(pose: &Pose) -> N {
    pose.across * (pose.crank[0] - 80.0 * 80.0 / 140.0) - pose.along * pose.crank[1]
}

/// By virtual work.
fn torque_at(theta: f64, f13: Vector) -> Found {
    let pose = four_bar_pose(theta, MM);
    let inverse = 140.0 * ALONG / area(MM) / pose.kappa;
    let (m3, m4) = moments(&pose, f13);
    let work = swept(&pose) * (m3 + m4) + pose.crank[1] * m3;
    vec![(T12, inverse * work - cross(pose.crank, f13))]
}

fn bearing_at(theta: f64) -> Found {
    let (pose, _) = dyad(theta, TWO_CRANKS);
    let mut found = Vec::new();
    force(&mut found, &[["B.x", "B.y"]], times(m4(&pose, 1.0 / area(TWO_CRANKS)) / pose.kappa, pose.coupler));
    found
}

/// Virtual velocities along the loads, and their work, for unit rate of the crank.
fn terms_at(theta: f64, f13: Vector) -> Found {
    let pose = four_bar_pose(theta, MM);
    // The rates over what the links sweep, times `ALONG`: `to_c` and the moment of F14 are over it.
    let inverse = -140.0 * ALONG / area(MM) / pose.kappa;
    let swept = swept(&pose);
    let c = times((swept + pose.crank[1]) * inverse, to_c(&pose));
    let v = [-(pose.crank[1] + c[1]), pose.crank[0] + c[0]];
    count(6);
    let size = f13[0].0.hypot(f13[1].0);
    let unit = f13.map(|part| N(part.0 / size));
    let velocity = swept * inverse * m4(&pose, 0.01 / ALONG);
    vec![
        ("F13.velocity", dot(v, unit)),
        ("F13.work", dot(v, f13)),
        ("F14.velocity", velocity),
        ("F14.work", 100.0 * velocity),
    ]
}

fn places_at(theta: f64) -> Found {
    let pose = four_bar_pose(theta, MM);
    let [x, y] = pose.coupler;
    let across = ALONG * slope();
    let c = add(pose.crank, [ALONG * x - across * y, ALONG * y + across * x]);
    let [x, y] = pose.rocker;
    let mut found = vec![
        ("coupler_angle", pose.coupler[1].atan2(pose.coupler[0])),
        ("rocker_angle", pose.rocker[1].atan2(pose.rocker[0])),
    ];
    force(&mut found, &[["A.x", "A.y"]], pose.crank);
    force(&mut found, &[["B.x", "B.y"]], [x + 140.0, y]);
    force(&mut found, &[["coupler_C.x", "coupler_C.y"]], c);
    force(&mut found, &[["rocker_D.x", "rocker_D.y"]], [0.75 * x + 140.0, 0.75 * y]);
    found
}

/// What the four-bar's pose keeps.
struct Links {
    crank: Vector,
    coupler: Vector,
    rocker: Vector,
    /// 1/sin μ.
    inverse: N,
    /// From A to C, over the coupler's length.
    arm: Vector,
}

impl Links {
    fn of(kept: Kept<'_>) -> Self {
        let vector = |x: &str, y: &str| [kept(x), kept(y)];
        Self {
            crank: vector("crank_cos", "crank_sin"),
            coupler: vector("coupler_cos", "coupler_sin"),
            rocker: vector("rocker_cos", "rocker_sin"),
            inverse: kept("inverse_sin_mu_B"),
            arm: vector("arm_coupler_A_C_x", "arm_coupler_A_C_y"),
        }
    }

    /// The moment of F14 about B0, over the rocker's length and times a factor.
    fn m4(&self, factor: f64) -> N {
        let [x, y] = f14();
        0.75 * factor * y * self.rocker[0] - 0.75 * factor * x * self.rocker[1]
    }

    /// The forces in B by F13 and by F14.
    fn forces(&self, f13: Vector) -> [Vector; 2] {
        let m3 = cross(self.arm, f13);
        [times(m3 * self.inverse, self.rocker), times(self.m4(1.0) * self.inverse, self.coupler)]
    }

    fn torque(&self, a: Vector) -> N {
        80.0 * cross(self.crank, a)
    }
}

fn statics(kept: Kept<'_>, f13: Vector) -> Found {
    let links = Links::of(kept);
    let [by_f13, by_f14] = links.forces(f13);
    let b = add(by_f13, by_f14);
    let a = sub(b, f13);
    held(links.torque(a), a, b)
}

fn parts(kept: Kept<'_>, f13: Vector) -> Found {
    let links = Links::of(kept);
    let [b, by_f14] = links.forces(f13);
    let a = sub(b, f13);
    held_by_each([links.torque(a), links.torque(by_f14)], [a, b], by_f14)
}

/// By the force in A.
fn torque(kept: Kept<'_>, f13: Vector) -> Found {
    let links = Links::of(kept);
    let [by_f13, by_f14] = links.forces(f13);
    vec![(T12, links.torque(sub(add(by_f13, by_f14), f13)))]
}

fn bearing(kept: Kept<'_>) -> Found {
    let links = Links::of(kept);
    let mut found = Vec::new();
    force(&mut found, &[["B.x", "B.y"]], times(links.m4(1.0) * links.inverse, links.coupler));
    found
}

fn terms(kept: Kept<'_>, f13: Vector) -> Found {
    let links = Links::of(kept);
    // The rates of coupler and rocker over −80/100 and −80/120.
    let [of_coupler, of_rocker] = [links.rocker, links.coupler].map(|other| cross(links.crank, other) * links.inverse);
    let [x, y] = times(of_coupler, links.arm);
    let v = [80.0 * (y - links.crank[1]), 80.0 * (links.crank[0] - x)];
    count(6);
    let size = f13[0].0.hypot(f13[1].0);
    let unit = f13.map(|part| N(part.0 / size));
    let velocity = of_rocker * links.m4(-0.8);
    vec![
        ("F13.velocity", dot(v, unit)),
        ("F13.work", dot(v, f13)),
        ("F14.velocity", velocity),
        ("F14.work", 100.0 * velocity),
    ]
}

fn places(kept: Kept<'_>) -> Found {
    let links = Links::of(kept);
    let angle = |[x, y]: Vector| y.atan2(x);
    let mut found = vec![("coupler_angle", angle(links.coupler)), ("rocker_angle", angle(links.rocker))];
    let a = [80.0 * links.crank[0], 80.0 * links.crank[1]];
    force(&mut found, &[["A.x", "A.y"]], a);
    force(&mut found, &[["coupler_C.x", "coupler_C.y"]], add(a, [100.0 * links.arm[0], 100.0 * links.arm[1]]));
    let [x, y] = links.rocker;
    force(&mut found, &[["B.x", "B.y"]], [120.0 * x + 140.0, 120.0 * y]);
    force(&mut found, &[["rocker_D.x", "rocker_D.y"]], [90.0 * x + 140.0, 90.0 * y]);
    found
}

// --- the slider-crank -------------------------------------------------------------------------------------------------------------

/// Weights of crank, rod and piston, N; how far that of the rod is from A, over the rod's length, and that of the crank from O, over its.
const G: f64 = 9.80665;
const WEIGHTS: [f64; 3] = [3.2 * G, 0.62 * G, 0.48 * G];
const OF_ROD: f64 = 45.0 / 142.0;
const OF_CRANK: f64 = 9.0 / 42.0;

/// In units of the crank's length: sin θ and cos θ, which are the place of A, and of the rod's vector (−g, h) g and h.
fn slider_crank_pose(theta: f64) -> (N, N, N, N) {
    let (sin, cos) = N(theta).sin_cos();
    let g = cos - 1.0 / 42.0;
    (sin, cos, g, ((142.0 / 42.0) * (142.0 / 42.0) - g * g).sqrt())
}

/// All that equilibrium gives, with cos θ and sin θ and the rod's force across the slide.
fn engine_held([cos, sin]: Vector, across: N, gas: Vector) -> Found {
    let [of_crank, of_rod, of_piston] = WEIGHTS;
    let b = of_piston - gas[1];
    let at_a = b + of_rod;
    let normal = gas[0] + across;
    let mut found = vec![
        ("T", 42.0 * (cos * (at_a + OF_CRANK * of_crank) - sin * across)),
        ("G.normal", normal),
        ("G.couple", 30.0 * gas[0]),
        ("G.force.x", -normal),
    ];
    force(&mut found, &[["B.x", "B.y"]], [across, b]);
    force(&mut found, &[["A.x", "A.y"]], [across, at_a]);
    force(&mut found, &[["O.x", "O.y"]], [across, at_a + of_crank]);
    found
}

fn hold_at(theta: f64, gas: Vector) -> Found {
    let (sin, cos, g, h) = slider_crank_pose(theta);
    let [_, of_rod, of_piston] = WEIGHTS;
    engine_held([cos, sin], g * (gas[1] - (of_piston + OF_ROD * of_rod)) / h, gas)
}

fn weights_at(theta: f64) -> Found {
    let (sin, cos, g, h) = slider_crank_pose(theta);
    let lever = sin * (g / h);
    let [of_crank, of_rod, of_piston] = WEIGHTS.map(|weight| 42.0 * weight);
    vec![
        ("W.crank.T", OF_CRANK * of_crank * cos),
        ("W.rod.T", of_rod * cos + OF_ROD * of_rod * lever),
        ("W.piston.T", of_piston * (cos + lever)),
    ]
}

fn slider_crank_torque_at(theta: f64, gas: Vector) -> Found {
    let (sin, cos, g, h) = slider_crank_pose(theta);
    let [of_crank, of_rod, of_piston] = WEIGHTS;
    let across = g * (gas[1] - (of_piston + OF_ROD * of_rod)) / h;
    vec![("T", 42.0 * (cos * ((of_piston + of_rod + OF_CRANK * of_crank) - gas[1]) - sin * across))]
}

/// The force on the rod across the slide in B, from what the pose keeps: the rod's vector is (−g, h).
fn across_slide(kept: Kept<'_>, gas: Vector) -> N {
    let [_, of_rod, of_piston] = WEIGHTS;
    ((of_piston + OF_ROD * of_rod) - gas[1]) * kept("rod_cos") * kept("inverse_sin_mu_B")
}

fn hold(kept: Kept<'_>, gas: Vector) -> Found {
    engine_held([kept("crank_cos"), kept("crank_sin")], across_slide(kept, gas), gas)
}

fn weights(kept: Kept<'_>) -> Found {
    let lever = kept("crank_sin") * (kept("rod_cos") * kept("inverse_sin_mu_B"));
    let cos = kept("crank_cos");
    let [of_crank, of_rod, of_piston] = WEIGHTS.map(|weight| 42.0 * weight);
    vec![
        ("W.crank.T", OF_CRANK * of_crank * cos),
        ("W.rod.T", of_rod * cos - OF_ROD * of_rod * lever),
        ("W.piston.T", of_piston * (cos - lever)),
    ]
}

/// By the force in A.
fn slider_crank_torque(kept: Kept<'_>, gas: Vector) -> Found {
    let [of_crank, of_rod, of_piston] = WEIGHTS;
    let lift = kept("crank_cos") * ((of_piston + of_rod + OF_CRANK * of_crank) - gas[1]);
    vec![("T", 42.0 * (lift - kept("crank_sin") * across_slide(kept, gas)))]
}

// --- the page ---------------------------------------------------------------------------------------------------------------------

/// The counts of the page: for each function of an example the least, and what is emitted.
fn page(example: &str) -> BTreeMap<String, [Tally; 2]> {
    let text = include_str!("../../../docs/operations.md");
    let chapter = text.split("\n## ").find(|chapter| chapter.starts_with(example)).expect("a chapter");
    let rows = chapter.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`'));
    let tally = |cell: &str| {
        let mut tally = [0; 7];
        for part in cell.split(',') {
            let (number, word) = part.trim().split_once(' ').expect("a number and a word");
            let which = WORDS.iter().position(|own| *own == word).expect("a word of the page");
            tally[which] = number.parse().expect("a number");
        }
        tally
    };
    let row = |(name, rest): (&str, &str)| {
        let cells: Vec<&str> = rest.trim_matches(['|', ' ']).split('|').collect();
        let [least, emitted] = cells.as_slice() else { panic!("{name} has {} columns", cells.len()) };
        (name.to_owned(), [tally(least), tally(emitted)])
    };
    rows.map(row).collect()
}

fn emitted(program: &Program) -> Tally {
    let counts = program.counts();
    assert_eq!((counts.fused, counts.solve, counts.search), (0, 0, 0), "{counts}");
    [counts.add, counts.mul, counts.div, counts.sqrt, counts.sin_cos, counts.atan2, counts.unit]
}

/// What a pose keeps, by name.
type Kept<'a> = &'a dyn Fn(&str) -> N;

/// An example, and the rows of the page that are still to be held.
struct Chapter {
    linkage: Linkage,
    rows: BTreeMap<String, [Tally; 2]>,
}

impl Chapter {
    fn of(example: &str, title: &str) -> Self {
        let linkage = linkage_codegen::analyse(declaration(example));
        Self { linkage: linkage.unwrap_or_else(|refusal| panic!("{:?}", refusal.errors)), rows: page(title) }
    }

    fn row(&mut self, name: &str) -> [Tally; 2] {
        self.rows.remove(name).unwrap_or_else(|| panic!("the page leaves out {name}"))
    }

    /// Holds the formulas of the pose, carried out already, against the page.
    fn hold_pose(&mut self) {
        let [least, most] = self.row("Pose::at");
        assert_eq!(TALLY.get(), least, "the pose: what the formulas count is not what the page says");
        let own = emitted(&self.linkage.functions.pose);
        assert_eq!(own, most, "the pose: what is emitted is not what the page says");
    }

    /// Holds a scene's formulas, from the drive and from what a pose keeps, the page and the emitted functions against each other.
    fn hold(
        &mut self,
        scene: &str,
        straight: impl Fn(f64, Vector) -> Found,
        from_pose: impl Fn(Kept<'_>, Vector) -> Found,
    ) {
        let rows = [format!("{scene}_at"), format!("Pose::{scene}")].map(|name| (self.row(&name), name));
        let index = self.linkage.model.scenes.iter().position(|own| own.name.text == scene).expect("a scene");
        let functions = &self.linkage.functions.scenes[index];
        let programs = [&functions.direct, &functions.from_pose];
        // The last is next to the four-bar's fold.
        for (theta, load) in [(1.0, [-31.0, 38.0]), (-2.5, [0.5, 700.0]), (0.25, [12.0, -3.0]), (3.1413, [9.0, 40.0])] {
            let loads = vec![load; self.linkage.model.loads.len()];
            let arguments = Arguments { drives: vec![theta], loads, ..Arguments::default() };
            let pose = pose::<Double>(&self.linkage, &arguments).expect("a pose");
            let kept = |name: &str| {
                let number = self.linkage.plan.pose.iter().find(|kept| kept.name == name);
                N(pose[&number.expect("a number of the pose").node].0)
            };
            let values = [
                direct::<Double>(&self.linkage, programs[0], &arguments).expect("an answer"),
                from_kept::<Double>(&self.linkage, programs[1], &pose, &arguments).expect("an answer"),
            ];
            for (from_kept, (([least, _], name), values)) in rows.iter().zip(&values).enumerate() {
                TALLY.set([0; 7]);
                let load = load.map(N);
                let found = if from_kept == 1 { from_pose(&kept, load) } else { straight(theta, load) };
                assert_eq!(TALLY.get(), *least, "{name}: what the formulas count is not what the page says");
                compare(name, theta, &found, programs[from_kept], values);
            }
        }
        for (([_, most], name), program) in rows.iter().zip(programs) {
            assert_eq!(emitted(program), *most, "{name}: what is emitted is not what the page says");
        }
    }

    /// The page has no other rows, and leaves out no scene but one that only compares the others' methods.
    fn complete(self, scenes: &[&str]) {
        assert!(self.rows.is_empty(), "no scene has {:?}", self.rows);
        let own = self.linkage.model.scenes.iter().filter(|scene| scene.method != Method::Verify);
        assert_eq!(own.map(|scene| scene.name.text.as_str()).collect::<Vec<_>>(), scenes);
    }
}

/// Holds what formulas have found against the results of a program.
fn compare(name: &str, theta: f64, found: &Found, program: &Program, values: &[Double]) {
    let largest = values.iter().fold(1.0_f64, |largest, value| largest.max(value.0.abs()));
    let mut compared = 0;
    for ((path, _), value) in program.outputs.iter().zip(values) {
        let Some((_, own)) = found.iter().find(|(own, _)| own == path) else {
            // Constants, and what is given, take no formula.
            assert!([theta, 0.0, 140.0].contains(&value.0), "{name} finds no {path}");
            continue;
        };
        compared += 1;
        assert!((own.0 - value.0).abs() <= 1e-13 * largest, "{name}, {path}: {} and {}", own.0, value.0);
    }
    assert_eq!(compared, found.len(), "{name}: {:?}", program.outputs);
}

#[test]
fn four_bar() {
    let mut chapter = Chapter::of("four_bar", "Four-bar");
    TALLY.set([0; 7]);
    let found = four_bar_pose(1.0, TWO_CRANKS);
    chapter.hold_pose();
    let [crank, coupler, rocker] =
        [found.crank, found.coupler, found.rocker].map(|vector| vector.map(|part| TWO_CRANKS * part.0));
    let (sin, cos) = 1f64.sin_cos();
    let off = [
        crank[0] - 80.0 * cos,
        crank[1] - 80.0 * sin,
        coupler[0].hypot(coupler[1]) - 100.0,
        rocker[0].hypot(rocker[1]) - 120.0,
        crank[0] + coupler[0] - 140.0 - rocker[0],
        crank[1] + coupler[1] - rocker[1],
    ];
    assert!(off.iter().all(|off| off.abs() < 1e-12) && rocker[1] > 0.0, "{off:?}");
    chapter.hold("statics", statics_at, statics);
    chapter.hold("parts", parts_at, parts);
    chapter.hold("torque", torque_at, torque);
    chapter.hold("bearing", |theta, _| bearing_at(theta), |kept, _| bearing(kept));
    chapter.hold("terms", terms_at, terms);
    chapter.hold("places", |theta, _| places_at(theta), |kept, _| places(kept));
    chapter.complete(&["statics", "parts", "torque", "bearing", "terms", "places"]);
}

#[test]
fn slider_crank() {
    let mut chapter = Chapter::of("slider_crank", "Slider-crank");
    TALLY.set([0; 7]);
    let (sin, cos, g, h) = slider_crank_pose(1.0);
    let travel = h + sin;
    chapter.hold_pose();
    // The pin's line is x = 1 mm, and the rod has its length.
    let off = [42.0 * (cos.0 - g.0) - 1.0, 42.0 * g.0.hypot(h.0) - 142.0, 42.0 * (travel.0 - h.0 - 1f64.sin())];
    assert!(off.iter().all(|off| off.abs() < 1e-12), "{off:?}");
    chapter.hold("hold", hold_at, hold);
    chapter.hold("weights", |theta, _| weights_at(theta), |kept, _| weights(kept));
    chapter.hold("torque", slider_crank_torque_at, slider_crank_torque);
    chapter.complete(&["hold", "weights", "torque"]);
}
