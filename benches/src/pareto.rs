//! Run time against error: every method over the same poses of the four-bar, regular ones and ones next to its change point.
//!
//! Angles and loads are numbers of single precision, so that all methods are given the same, those in `f32` too.

use std::time::Duration;

use linkage_runtime::{Vector2, polar};
use nalgebra::SVector;

use crate::exact::{Big, Exact, difference, size, vector};
use crate::expert::four_bar as expert;
use crate::harness::{Competitor, Mode, measure};
use crate::items::four_bar::double::{equations, put};
use crate::items::four_bar::{double, exact, exact_parts, fused, single};
use crate::items::single::given;
use crate::items::{Case, Errors, Item, Random, Reactions, Results, Start, dense, rounded};
use crate::linkages::four_bar::{Loads, Pose};
use crate::linkages::swept;
use crate::picture::{self, Family, Mark, Panel};
use crate::{newton, textbook};

type All = Reactions<4>;
type At = Case<f64, Loads>;
type AtBegin = Case<newton::Begin, Loads>;
type Posed<T> = Vec<(At, T)>;

/// How many poses each panel has.
const POSES: u32 = 1024;

/// The loads on coupler and rocker, N.
const LOADS: (f64, f64) = (50.0, 100.0);

impl Start for newton::Begin {
    fn depend(&mut self, change: f64) -> bool {
        self.theta += change;
        true
    }
}

/// The exact results of a pose, and the forces that loads of this size cause there in the worst of directions. Where loads happen to cause
/// little, alone or together, that has fewer digits, whichever way it is found.
struct Truth {
    exact: Exact,
    effort: Big,
}

/// A method, and what it comes to.
struct Judged {
    name: &'static str,
    family: Family,
    nanoseconds: f64,
    ratio: f64,
    /// Of the errors of all poses that have an answer: the root mean square, and the largest.
    typical: f64,
    worst: f64,
    /// How many poses have no answer.
    refused: usize,
    on_front: bool,
}

impl Judged {
    /// Whether it is a method for any linkage, and has answers.
    fn competes(&self) -> bool {
        self.family != Family::Hand && self.typical.is_finite()
    }
}

/// The methods of a panel, with their competitors.
struct Methods<'a> {
    poses: &'a Posed<Truth>,
    judged: Vec<Judged>,
    competitors: Vec<Competitor>,
}

impl<'a> Methods<'a> {
    fn new(poses: &'a Posed<Truth>) -> Self {
        Self { poses, judged: Vec::new(), competitors: Vec::new() }
    }

    /// A method that starts from what `prepare` makes of a pose, which is not timed. Where one has no answer it goes
    /// on, with NaN as its torque: that costs time too. Generated functions have answers at all poses, and stop where they have none.
    fn add<S: Start, L: crate::items::Loads, R: Results>(
        &mut self,
        (family, name): (Family, &'static str),
        prepare: impl Fn(&At) -> Case<S, L>,
        call: fn(&Case<S, L>, &mut R) -> bool,
    ) {
        let cases: Vec<Case<S, L>> = self.poses.iter().map(|(case, _)| prepare(case)).collect();
        let mut errors: Vec<f64> = Vec::new();
        for (case, (_, exact)) in cases.iter().zip(self.poses) {
            let mut results = R::default();
            assert!(call(case, &mut results), "{name} stops");
            let parts = results.parts();
            let (torque, forces) = parts.first().expect("results");
            if torque.is_finite() && forces.iter().all(|force| force.x.is_finite() && force.y.is_finite()) {
                errors.push(error(*torque, forces, exact));
            }
        }
        let squares: f64 = errors.iter().map(|error| error * error).sum();
        self.judged.push(Judged {
            name,
            family,
            nanoseconds: 0.0,
            ratio: 0.0,
            typical: (squares / f64::from(u32::try_from(errors.len()).expect("few poses"))).sqrt(),
            worst: errors.iter().copied().fold(f64::NAN, f64::max),
            refused: cases.len() - errors.len(),
            on_front: false,
        });
        self.competitors.push(Competitor::new(name, Errors::default(), cases, call));
    }

    /// Takes the times, and finds those that no other method beats in both; what is written by hand for this linkage alone does not compete.
    fn timed(self, rounds: usize, least: Duration) -> Vec<Judged> {
        let Self { mut judged, competitors, .. } = self;
        let mut item = Item { id: "", title: "", competitors };
        for (method, timing) in judged.iter_mut().zip(measure(&mut item, rounds, least, Mode::Independent)) {
            (method.nanoseconds, method.ratio) = (timing.nanoseconds, timing.ratio);
        }
        let all: Vec<(f64, f64)> = judged
            .iter()
            .filter(|method| method.competes())
            .map(|method| (method.nanoseconds, method.typical))
            .collect();
        for method in &mut judged {
            let own = (method.nanoseconds, method.typical);
            let beaten = |other: &(f64, f64)| *other != own && other.0 <= own.0 && other.1 <= own.1;
            method.on_front = method.competes() && !all.iter().any(beaten);
        }
        judged
    }
}

/// The error of a pose's results: of the forces by those that loads of this size cause there, of the torque by this force at the crank's
/// length; of a torque alone by the loads at the crank's length, as it does not grow with the forces in the joints.
fn error(torque: f64, forces: &[Vector2<f64>], Truth { exact, effort }: &Truth) -> f64 {
    let scale = if forces.is_empty() { Big::of(LOADS.0 + LOADS.1) } else { effort.clone() };
    let torque = ((Big::of(torque) - &exact.torque).abs() / (scale * Big::of(80.0))).to_f64();
    let forces = forces.iter().zip(&exact.forces);
    forces
        .map(|(force, exact)| (size(&difference(&vector(force.x, force.y), exact)) / effort).to_f64())
        .fold(torque, f64::max)
}

/// Measures all methods, prints the tables, and draws them if a file is named.
pub(crate) fn print(rounds: usize, least: Duration, machine: &str, file: Option<&str>) -> Result<(), String> {
    let mut panels = Vec::new();
    let mut beaten = String::new();
    for (where_, poses) in
        [("at least 30° from the change point", regular()), ("10⁻¹ to 10⁻⁵ rad from the change point", near())]
    {
        for (what, methods) in [("all forces and the torque", all(&poses)), ("the torque alone", torque(&poses))] {
            let judged = methods.timed(rounds, least);
            let title = format!("{what}, {where_}");
            table(&title, &judged);
            for (generated, by) in beaten_by_others(&judged) {
                beaten += &format!("{title}: {generated} is slower and less exact than {by}\n");
            }
            for name in behind(&judged) {
                beaten += &format!("{title}: {name} is not on the front\n");
            }
            let marks = judged.iter().filter(|method| method.typical.is_finite()).map(|method| Mark {
                name: method.name,
                family: method.family,
                nanoseconds: method.nanoseconds,
                error: method.typical,
                on_front: method.on_front,
            });
            panels.push(Panel { title: [what.to_owned(), where_.to_owned()], marks: marks.collect() });
        }
    }
    if let Some(file) = file {
        std::fs::write(file, picture::drawn(&panels, machine)).map_err(|error| format!("{file}: {error}"))?;
        println!("\nwrote {file}");
    }
    if beaten.is_empty() { Ok(()) } else { Err(beaten) }
}

/// Generated functions, each with a method for any linkage that is not generated and beats it in both time and typical error.
fn beaten_by_others(judged: &[Judged]) -> impl Iterator<Item = (&'static str, &'static str)> {
    let of = |generated: bool| {
        judged.iter().filter(move |method| (method.family == Family::Generated) == generated && method.competes())
    };
    of(true).flat_map(move |own| {
        let beats = |other: &&Judged| other.nanoseconds <= own.nanoseconds && other.typical <= own.typical;
        of(false).filter(beats).map(|other| (own.name, other.name))
    })
}

/// Those that should lead and do not.
fn behind(judged: &[Judged]) -> impl Iterator<Item = &'static str> {
    judged.iter().filter(|method| LEADING.contains(&method.name) && !method.on_front).map(|method| method.name)
}

fn table(title: &str, judged: &[Judged]) {
    println!("\n{title}: {POSES} poses");
    println!("  {:<36} {:>8} {:>8} {:>9} {:>9} {:>9}  front", "", "ns", "ratio", "typical", "worst", "refused");
    for Judged { name, nanoseconds, ratio, typical, worst, refused, on_front, .. } in judged {
        let front = if *on_front { "yes" } else { "no" };
        println!("  {name:<36} {nanoseconds:>8.1} {ratio:>8.2} {typical:>9.2e} {worst:>9.1e} {refused:>9}  {front}");
    }
}

/// A pose at an angle, with loads in any directions.
fn pose(theta: f64, random: &mut Random) -> (At, Truth) {
    let mut load = |size: f64| {
        let force = polar(size, std::f64::consts::TAU * random.next());
        force.map(rounded)
    };
    let case = Case { start: rounded(theta), loads: Loads { F13: load(LOADS.0), F14: load(LOADS.1) } };
    let theta = Big::of(case.start);
    let effort = [(1.0, 0.0), (0.0, 1.0)].map(|(x, y)| {
        let along = |size: f64| Vector2::new(size * x, size * y);
        caused(&theta, &Loads { F13: along(LOADS.0), F14: along(LOADS.1) })
    });
    (case, Truth { exact: exact(&theta, &case.loads), effort: size(&effort) })
}

/// The largest force by each load alone, added up.
fn caused(theta: &Big, loads: &Loads) -> Big {
    let largest = |exact: &Exact| exact.forces.iter().map(size).reduce(Big::larger).expect("a force");
    exact_parts(theta, loads).iter().map(largest).reduce(|sum, force| sum + force).expect("a load")
}

/// Along the turn, but for the sixty degrees about the change point.
fn regular() -> Posed<Truth> {
    let mut random = Random(20_240_902);
    let part = |k: u32| (f64::from(k) + 0.5) / f64::from(POSES);
    (0..POSES).map(|k| pose((300.0 * part(k) - 150.0).to_radians(), &mut random)).collect()
}

/// On both sides of the change point.
fn near() -> Posed<Truth> {
    let mut random = Random(20_240_903);
    let distance = |k: u32| 10_f64.powf(-1.0 - 4.0 * f64::from(k) / f64::from(POSES - 1));
    let side = |k: u32| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    (0..POSES).map(|k| pose(std::f64::consts::PI - side(k) * distance(k), &mut random)).collect()
}

type Method = (Family, &'static str);

const EXPERT: Method = (Family::Hand, "expert");
const CAREFUL: Method = (Family::Hand, "careful expert");
const SUPERPOSITION: Method = (Family::Generated, "generated, superposition");
const ANGLES: Method = (Family::Angles, "textbook angles");
const NEWTON: Method = (Family::Iteration, "Newton's method");

/// Generated functions that no method for any linkage may beat in both time and typical error. Fused virtual work is not among them: where fused
/// operations are calls, superposition takes less, and next to the change point it has errors as small.
const LEADING: [&str; 3] = ["generated, equilibrium", "generated, equilibrium, fused", "generated, virtual work"];

/// What a panel compares: all forces with the torque; or the torque alone, for which those that have no shorter way solve for everything.
trait Wanted: Results {
    fn of_pose(&mut self, pose: &expert::Pose, loads: &Loads);
    fn of_all(&mut self, solve: impl FnOnce(&mut All));
}

impl Wanted for All {
    #[inline]
    fn of_pose(&mut self, pose: &expert::Pose, loads: &Loads) {
        pose.statics(loads, self);
    }

    #[inline]
    fn of_all(&mut self, solve: impl FnOnce(&mut All)) {
        solve(self);
    }
}

impl Wanted for f64 {
    #[inline]
    fn of_pose(&mut self, pose: &expert::Pose, loads: &Loads) {
        *self = pose.torque_of(loads);
    }

    #[inline]
    fn of_all(&mut self, solve: impl FnOnce(&mut All)) {
        let mut all = All::default();
        solve(&mut all);
        *self = all.torque;
    }
}

/// All forces and the torque.
fn all(poses: &Posed<Truth>) -> Methods<'_> {
    let mut methods = Methods::new(poses);
    add_by_hand::<All>(&mut methods);
    methods.add((Family::Generated, "generated, equilibrium"), same, double::statics_at_generated);
    methods.add((Family::Generated, "generated, equilibrium, fused"), same, fused::statics_at_generated);
    methods.add((Family::Generated, "generated, equilibrium, f32"), given, single::statics_at_generated);
    add_others::<All>(&mut methods);
    methods
}

/// Only the torque.
fn torque(poses: &Posed<Truth>) -> Methods<'_> {
    let mut methods = Methods::new(poses);
    add_by_hand::<f64>(&mut methods);
    methods.add((Family::Generated, "generated, virtual work"), same, double::torque_at_generated);
    methods.add((Family::Generated, "generated, virtual work, fused"), same, fused::torque_at_generated);
    methods.add((Family::Generated, "generated, virtual work, f32"), given, single::torque_at_generated);
    add_others::<f64>(&mut methods);
    methods
}

fn add_by_hand<R: Wanted>(methods: &mut Methods<'_>) {
    methods.add(EXPERT, same, |case: &At, out: &mut R| answer(Some(expert::pose(case.start)), case, out));
    methods.add(CAREFUL, same, |case: &At, out: &mut R| answer(expert::careful_pose(case.start), case, out));
}

fn add_others<R: Wanted>(methods: &mut Methods<'_>) {
    methods.add(SUPERPOSITION, same, |case: &At, out: &mut R| {
        out.of_all(|out| superpose(case, out));
        true
    });
    methods.add(ANGLES, same, |case: &At, out: &mut R| {
        out.of_all(|out| textbook::statics(case.start, &case.loads, out));
        true
    });
    methods.add(NEWTON, begin, |case: &AtBegin, out: &mut R| answer(newton::pose(&case.start), case, out));
    methods.add((Family::Elimination, "nalgebra LU 9×9"), same, |case: &At, out: &mut R| {
        eliminated(case, out, dense::partial)
    });
    methods.add((Family::Elimination, "nalgebra LU 9×9, full pivoting"), same, |case: &At, out: &mut R| {
        eliminated(case, out, dense::full)
    });
    methods.add((Family::Elimination, "nalgebra LU, dynamic"), same, |case: &At, out: &mut R| {
        eliminated(case, out, dense::dynamic)
    });
    methods.add((Family::Elimination, "faer LU"), same, |case: &At, out: &mut R| eliminated(case, out, dense::faer));
}

/// By the linkage with sweeps, so that the function that P1d measures is called there alone, and becomes part of its caller; a function, so that this
/// one is called here alone, and what it finds is added up where it is.
#[inline(never)]
fn superpose(case: &At, out: &mut All) {
    let loads = swept::four_bar::Loads { F13: case.loads.F13, F14: case.loads.F14 };
    match swept::four_bar::parts_at(case.start, &loads).and_then(|parts| parts.total()) {
        Ok(all) => *out = Reactions { torque: all.T12, forces: [all.A0, all.A, all.B, all.B0] },
        Err(_) => out.torque = f64::NAN,
    }
}

fn same(case: &At) -> At {
    *case
}

/// Newton's method comes from the pose before: a degree farther from the change point, next to it a tenth of the distance.
fn begin(case: &At) -> AtBegin {
    let distance = case.start - std::f64::consts::PI.copysign(case.start);
    let before = case.start + distance.signum() * (0.1 * distance.abs()).min(1_f64.to_radians());
    let pose = Pose::at(before).expect("a pose");
    let [coupler, rocker] = [pose.coupler_direction(), pose.rocker_direction()].map(|u| u.y.atan2(u.x));
    Case { start: newton::Begin { theta: case.start, coupler, rocker }, loads: case.loads }
}

/// The forces at a pose, if there is one.
#[inline]
fn answer<S, R: Wanted>(pose: Option<expert::Pose>, case: &Case<S, Loads>, out: &mut R) -> bool {
    match pose {
        Some(pose) => out.of_pose(&pose, &case.loads),
        None => out.of_all(|out| out.torque = f64::NAN),
    }
    true
}

/// All equations at the generated pose.
#[inline]
fn eliminated<R: Wanted>(
    case: &At,
    out: &mut R,
    solve: impl Fn(nalgebra::SMatrix<f64, 9, 9>, &SVector<f64, 9>) -> Option<SVector<f64, 9>>,
) -> bool {
    let pose = Pose::at(case.start).ok();
    let solution = pose.and_then(|pose| {
        let (matrix, right) = equations(&pose, &case.loads);
        solve(matrix, &right)
    });
    out.of_all(|out| {
        if !put(solution, out) {
            out.torque = f64::NAN;
        }
    });
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_is_beaten_is_found() {
        let method = |name, family, nanoseconds, typical| Judged {
            name,
            family,
            nanoseconds,
            ratio: 0.0,
            typical,
            worst: typical,
            refused: 0,
            on_front: false,
        };
        let hand = method("by hand", Family::Hand, 1.0, 1e-17);
        let fused = method("fused", Family::Generated, 2.0, 1e-16);
        let [fast, exact] =
            [(2.0, 3e-16), (9.0, 1e-16)].map(|(ns, error)| method("plain", Family::Generated, ns, error));
        let elimination = method("LU", Family::Elimination, 3.0, 2e-16);
        let of = |all: [Judged; 4]| beaten_by_others(&all).collect::<Vec<_>>();
        assert_eq!(of([hand, fused, fast, elimination]), []);
        let [hand, fused] =
            [("by hand", Family::Hand), ("fused", Family::Generated)].map(|(n, f)| method(n, f, 2.0, 1e-16));
        assert_eq!(of([hand, fused, exact, method("LU", Family::Elimination, 3.0, 1e-16)]), [("plain", "LU")]);
    }

    #[test]
    fn who_should_lead_and_does_not_is_found() {
        let method = |name, on_front| Judged {
            name,
            family: Family::Generated,
            nanoseconds: 1.0,
            ratio: 0.0,
            typical: 1e-16,
            worst: 1e-16,
            refused: 0,
            on_front,
        };
        let judged = [method(LEADING[0], true), method(LEADING[1], false), method(SUPERPOSITION.1, false)];
        assert_eq!(behind(&judged).collect::<Vec<_>>(), [LEADING[1]]);
        // Each name is that of a method.
        let poses = regular();
        let names: Vec<&str> = [all(&poses), torque(&poses)]
            .iter()
            .flat_map(|methods| &methods.judged)
            .map(|method| method.name)
            .collect();
        assert!(LEADING.iter().all(|name| names.contains(name)), "{names:?}");
    }

    /// What each method is good for at poses that are far from the change point.
    #[test]
    fn every_method_is_right_at_regular_poses() {
        let poses = regular();
        for methods in [all(&poses), torque(&poses)] {
            for Judged { name, worst, refused, .. } in &methods.judged {
                let bar = match *name {
                    name if name.ends_with("f32") => 1e-6,
                    name if name.starts_with("generated") => 2e-15,
                    _ => 1e-13,
                };
                assert_eq!(*refused, 0, "{name}");
                assert!(*worst > 0.0 && *worst <= bar, "{name} is off by {worst:e}");
            }
        }
    }

    /// Next to the change point generated code keeps its digits, and plain formulas do not.
    #[test]
    fn digits_next_to_the_change_point() {
        let poses = near();
        for methods in [all(&poses), torque(&poses)] {
            for Judged { name, worst, refused, .. } in &methods.judged {
                match *name {
                    name if name.starts_with("generated") && !name.ends_with("f32") => {
                        assert!(*refused == 0 && *worst <= 2e-15, "{name} is off by {worst:e}, {refused} refused");
                    }
                    "expert" | "textbook angles" => assert!(*worst > 1e-9, "{name} is off by {worst:e} only"),
                    _ => {}
                }
            }
        }
    }

    /// Generated code has errors about as small as those of all equations with a pivot chosen among all, smaller ones at regular poses; and in
    /// fused arithmetic smaller ones everywhere, than in plain and by superposition too, which are faster where every fused operation is a call.
    #[test]
    fn typical_errors() {
        for (poses, most) in [(regular(), 1.0), (near(), 1.1)] {
            let typical = |methods: &Methods<'_>, name: &str| {
                methods.judged.iter().find(|method| method.name == name).expect("a method").typical
            };
            let methods = all(&poses);
            let of = |name: &str| typical(&methods, name);
            let (plain, fused) = (of("generated, equilibrium"), of("generated, equilibrium, fused"));
            let elimination = of("nalgebra LU 9×9, full pivoting");
            assert!(plain < most * elimination, "{plain:e}, by elimination {elimination:e}");
            assert!(fused < plain && fused < elimination, "{plain:e}, fused {fused:e}, by elimination {elimination:e}");
            assert!(fused < of("generated, superposition"), "{fused:e}");
            let methods = torque(&poses);
            let of = |name: &str| typical(&methods, name);
            let (plain, fused) = (of("generated, virtual work"), of("generated, virtual work, fused"));
            assert!(fused < plain && plain < of("nalgebra LU 9×9"), "{plain:e}, fused {fused:e}");
        }
    }
}
