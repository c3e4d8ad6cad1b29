//! Sweeps: the generated function over slices against loops over the positions: of calls of the generated function for a single position, of the
//! expert's, and of all that other libraries and generators have.
#![allow(
    non_snake_case,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    reason = "positions, in either precision"
)]

use std::hint::black_box;
use std::time::Instant;

use linkage_runtime::__private::limit_registers;
use linkage_runtime::Vector2;

use crate::items::Scalar;

/// Prints, for 360 and 4096 positions, the times of each position and the medians of the paired ratios: by the instructions that this
/// program was compiled for, and by wider ones that this processor has; then, by the widest, beside other libraries and generators.
pub(crate) fn print(rounds: usize) -> Result<(), String> {
    println!("\nsweeps of the four-bar, both loads at each position");
    println!(
        "ns for each position: of the expert, of generated calls, of the generated sweep; the sweep's ratio to both"
    );
    for (instructions, bytes) in registers() {
        limit_registers(bytes);
        println!("\n{instructions}");
        println!(
            "  {:>22} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}",
            "", "positions", "expert", "calls", "sweep", "expert", "calls"
        );
        for count in COUNTS {
            double::rows(count, rounds)?;
            single::rows(count, rounds)?;
        }
    }
    println!("\nbeside loops over calls of others, as they are compiled; generated sweeps by the widest registers");
    println!("ns for each position, and the ratio to the expert's");
    // A round takes a hundred times as long.
    let rounds = rounds.div_ceil(20);
    for count in COUNTS {
        double::others(count, rounds)?;
        single::others(count, rounds)?;
    }
    Ok(())
}

const COUNTS: [usize; 2] = [360, 4096];

/// The instructions between which a sweep chooses here, by the bytes of their registers, the widest last.
#[cfg(target_arch = "x86_64")]
fn registers() -> Vec<(&'static str, u8)> {
    let mut registers = vec![("as compiled", 16)];
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        registers.push(("AVX2", 32));
    }
    if is_x86_feature_detected!("avx512f") {
        registers.push(("AVX-512", 64));
    }
    registers
}

#[cfg(not(target_arch = "x86_64"))]
fn registers() -> Vec<(&'static str, u8)> {
    vec![("as this processor has them", u8::MAX)]
}

/// What is given: the driver's angles, and a load on coupler and rocker.
struct Given<T> {
    theta: Vec<T>,
    loads: Vec<Vector2<T>>,
}

/// Finds `N` numbers for each position.
type Find<'a, T, const N: usize> = dyn Fn(&Given<T>, &mut [Vec<T>; N]) + 'a;

/// A way to them.
struct Way<'a, T, const N: usize> {
    method: &'static str,
    find: Box<Find<'a, T, N>>,
}

impl<'a, T, const N: usize> Way<'a, T, N> {
    fn new(method: &'static str, find: impl Fn(&Given<T>, &mut [Vec<T>; N]) + 'a) -> Self {
        Self { method, find: Box::new(find) }
    }
}

/// What each way finds, and of each round the times that all took for a position, in ns.
struct Timed<T, const N: usize> {
    found: Vec<[Vec<T>; N]>,
    rounds: Vec<Vec<f64>>,
}

impl<T, const N: usize> Timed<T, N> {
    /// The median of a way's times.
    fn time(&self, way: usize) -> f64 {
        self.median(|times| times[way])
    }

    /// The median of its times over those of another one in the same round.
    fn ratio(&self, way: usize, to: usize) -> f64 {
        self.median(|times| times[way] / times[to])
    }

    fn median(&self, of: impl Fn(&[f64]) -> f64) -> f64 {
        let mut values: Vec<f64> = self.rounds.iter().map(|times| of(times)).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    }
}

/// Goes all ways in turns. The results of each are near those of the first.
fn timed<T: Scalar, const N: usize>(
    title: &str,
    given: &Given<T>,
    rounds: usize,
    tolerance: f64,
    ways: &[Way<'_, T, N>],
) -> Result<Timed<T, N>, String> {
    let count = given.theta.len();
    let mut found: Vec<[Vec<T>; N]> =
        ways.iter().map(|_| core::array::from_fn(|_| vec![T::default(); count])).collect();
    for (way, found) in ways.iter().zip(&mut found) {
        (way.find)(given, found);
    }
    for (way, results) in ways.iter().zip(&found) {
        for (first, other) in found[0].iter().flatten().zip(results.iter().flatten()) {
            let (first, other): (f64, f64) = ((*first).into(), (*other).into());
            let near = (first - other).abs() <= tolerance * (1.0 + other.abs());
            if !near {
                return Err(format!("{title}: {} has {first}, {} {other}", ways[0].method, way.method));
            }
        }
    }
    // Shorter than what the system gives a program at a time: few of these times hold a pause.
    let repeats = (16_384 / count).max(1);
    let round = |_| {
        let times = ways.iter().zip(&mut found).map(|(way, found)| {
            let start = Instant::now();
            for _ in 0..repeats {
                (way.find)(black_box(given), black_box(&mut *found));
            }
            start.elapsed().as_secs_f64() * 1e9 / (count * repeats) as f64
        });
        times.collect()
    };
    let rounds = (0..rounds).map(round).collect();
    Ok(Timed { found, rounds })
}

/// A row: by the expert, by calls, by the sweep, which has the bits of the calls.
fn row<T: Scalar, const N: usize>(
    title: &str,
    given: &Given<T>,
    rounds: usize,
    tolerance: f64,
    ways: &[Way<'_, T, N>; 3],
) -> Result<(), String> {
    let timed = timed(title, given, rounds, tolerance, ways)?;
    for (calls, sweep) in timed.found[1].iter().flatten().zip(timed.found[2].iter().flatten()) {
        let [calls, sweep]: [f64; 2] = [(*calls).into(), (*sweep).into()];
        if calls.to_bits() != sweep.to_bits() {
            return Err(format!("{title}: a sweep has other bits than the calls"));
        }
    }
    let [expert, calls, sweep] = [0, 1, 2].map(|way| timed.time(way));
    let [to_expert, to_calls] = [0, 1].map(|to| timed.ratio(2, to));
    let count = given.theta.len();
    println!("  {title:>22} {count:>9} {expert:>8.2} {calls:>8.2} {sweep:>8.2} {to_expert:>8.3} {to_calls:>8.3}");
    Ok(())
}

/// A table of all that others have, the expert first.
fn table<T: Scalar, const N: usize>(
    title: &str,
    given: &Given<T>,
    rounds: usize,
    tolerance: f64,
    ways: &[Way<'_, T, N>],
) -> Result<(), String> {
    let timed = timed(title, given, rounds, tolerance, ways)?;
    println!("\n  {title}, {} positions", given.theta.len());
    for (index, way) in ways.iter().enumerate() {
        println!("    {:<28} {:>8.2} {:>8.3}", way.method, timed.time(index), timed.ratio(index, 0));
    }
    Ok(())
}

/// The sweeps of a four-bar, and its calls for a single position, in a scalar and an arithmetic.
macro_rules! generated {
    ($module:ident, $scalar:ident, $linkage:ident) => {
        mod $module {
            use linkage_runtime::{Series, Vector2};

            use crate::linkages::swept::$linkage::{self, Cycle, CycleInputs, Loads, Torques, TorquesInputs};
            use crate::sweeps::Given;

            pub(super) fn torque(theta: $scalar, load: Vector2<$scalar>) -> Option<$scalar> {
                Some($linkage::torque_at(theta, &Loads { F13: load, F14: load }).ok()?.T12)
            }

            pub(super) fn all(theta: $scalar, load: Vector2<$scalar>) -> Option<($scalar, [Vector2<$scalar>; 4])> {
                let all = $linkage::statics_at(theta, &Loads { F13: load, F14: load }).ok()?;
                Some((all.T12, [all.A0, all.A, all.B, all.B0]))
            }

            pub(super) fn torques(given: &Given<$scalar>, [T12]: &mut [Vec<$scalar>; 1]) {
                let (theta, load) = (Series::Each(&given.theta), Series::Each(&given.loads));
                let _ = $linkage::torques(&TorquesInputs { theta, F13: load, F14: load }, Torques { T12 });
            }

            pub(super) fn cycle(given: &Given<$scalar>, results: &mut [Vec<$scalar>; 9]) {
                let (theta, load) = (Series::Each(&given.theta), Series::Each(&given.loads));
                let [T12, A0_x, A0_y, A_x, A_y, B_x, B_y, B0_x, B0_y] = results.each_mut().map(Vec::as_mut_slice);
                let _ = $linkage::cycle(
                    &CycleInputs { theta, F13: load, F14: load },
                    Cycle { T12, A0_x, A0_y, A_x, A_y, B_x, B_y, B0_x, B0_y },
                );
            }
        }
    };
}

/// All that competes in a scalar.
macro_rules! sweeps {
    ($module:ident, $scalar:ident, $linkage:ident, $fused:ident, $tolerance:expr) => {
        mod $module {
            use linkage_runtime::Vector2;

            use super::{Given, Way, row, table};
            use crate::expert::$linkage as expert;
            use crate::generators;
            use crate::items::four_bar::$module as items;
            use crate::items::{Case, Reactions, dense};
            use crate::linkages::$linkage::Loads;

            generated!(plain, $scalar, $linkage);
            generated!(fused, $scalar, $fused);

            /// A turn from the line of the ground link on, without what lies next to the fold at half a turn, where the expert has no digits left
            /// in single precision.
            fn given(count: usize) -> Given<$scalar> {
                const BESIDE: $scalar = 0.05;
                const HALF: $scalar = core::$scalar::consts::PI;
                let part = |index: usize| index as $scalar / count as $scalar;
                let theta = |index: usize| {
                    let turned = 2.0 * (HALF - BESIDE) * part(index);
                    if turned < HALF - BESIDE { turned } else { turned + 2.0 * BESIDE }
                };
                let load = |angle: $scalar| Vector2::new(50.0 * angle.cos(), 50.0 * angle.sin());
                Given {
                    theta: (0..count).map(theta).collect(),
                    loads: (0..count).map(|index| load(6.0 * part(index))).collect(),
                }
            }

            /// The torque at each position by itself.
            fn torques<'a>(
                method: &'static str,
                call: impl Fn($scalar, Vector2<$scalar>) -> Option<$scalar> + 'a,
            ) -> Way<'a, $scalar, 1> {
                Way::new(method, move |given, [torques]| {
                    for ((theta, load), torque) in given.theta.iter().zip(&given.loads).zip(torques) {
                        let Some(found) = call(*theta, *load) else { return };
                        *torque = found;
                    }
                })
            }

            /// The torque and the forces in A0, A, B and B0 at each position by itself.
            fn all<'a>(
                method: &'static str,
                call: impl Fn($scalar, Vector2<$scalar>) -> Option<($scalar, [Vector2<$scalar>; 4])> + 'a,
            ) -> Way<'a, $scalar, 9> {
                Way::new(method, move |given, results| {
                    let count = given.theta.len();
                    let mut slices = results.each_mut().map(|slice| &mut slice[..count]);
                    for (index, (theta, load)) in given.theta.iter().zip(&given.loads).enumerate() {
                        let Some((torque, [a0, a, b, b0])) = call(*theta, *load) else { return };
                        let numbers = [torque, a0.x, a0.y, a.x, a.y, b.x, b.y, b0.x, b0.y];
                        for (slice, number) in slices.iter_mut().zip(numbers) {
                            slice[index] = number;
                        }
                    }
                })
            }

            fn torques_expert() -> Way<'static, $scalar, 1> {
                torques("expert", |theta, load| Some(expert::pose(theta).torque_of(&Loads { F13: load, F14: load })))
            }

            fn all_expert() -> Way<'static, $scalar, 9> {
                all("expert", |theta, load| {
                    let mut out = Reactions::default();
                    expert::pose(theta).statics(&Loads { F13: load, F14: load }, &mut out);
                    Some((out.torque, out.forces))
                })
            }

            pub(super) fn rows(count: usize, rounds: usize) -> Result<(), String> {
                let given = given(count);
                let scalar = stringify!($scalar);
                let ways = [torques_expert(), torques("calls", plain::torque), Way::new("sweep", plain::torques)];
                row(&format!("torque only, {scalar}"), &given, rounds, $tolerance, &ways)?;
                let ways = [all_expert(), all("calls", plain::all), Way::new("sweep", plain::cycle)];
                row(&format!("all forces, {scalar}"), &given, rounds, $tolerance, &ways)?;
                let ways = [torques_expert(), torques("calls", fused::torque), Way::new("sweep", fused::torques)];
                row(&format!("torque only, {scalar} fused"), &given, rounds, $tolerance, &ways)?;
                let ways = [all_expert(), all("calls", fused::all), Way::new("sweep", fused::cycle)];
                row(&format!("all forces, {scalar} fused"), &given, rounds, $tolerance, &ways)
            }

            pub(super) fn others(count: usize, rounds: usize) -> Result<(), String> {
                let given = given(count);
                let case = |theta, load| Case { start: theta, loads: Loads { F13: load, F14: load } };
                let numbers = |theta: $scalar, load: Vector2<$scalar>| [theta, load.x, load.y, load.x, load.y];
                macro_rules! torque_by {
                    ($elimination:path) => {
                        |theta, load| {
                            let mut torque = 0.0;
                            items::torque_at_eliminated(&case(theta, load), &mut torque, $elimination).then_some(torque)
                        }
                    };
                }
                macro_rules! all_by {
                    ($elimination:path) => {
                        |theta, load| {
                            let mut out = Reactions::default();
                            let found = items::statics_at_eliminated(&case(theta, load), &mut out, $elimination);
                            found.then_some((out.torque, out.forces))
                        }
                    };
                }
                let mut ways = vec![
                    torques_expert(),
                    Way::new("generated", plain::torques),
                    Way::new("generated, fused", fused::torques),
                    torques("LU 9x9", torque_by!(dense::partial)),
                    torques("LU 9x9, faer", torque_by!(dense::faer)),
                ];
                ways.extend(generators::functions("P1c").into_iter().map(|(method, function)| {
                    torques(method, move |theta, load| {
                        let mut torque = [0.0];
                        function.find(&numbers(theta, load), &mut torque).then_some(torque[0])
                    })
                }));
                let scalar = stringify!($scalar);
                table(&format!("torque only, {scalar}"), &given, rounds, $tolerance, &ways)?;
                let mut ways = vec![
                    all_expert(),
                    Way::new("generated", plain::cycle),
                    Way::new("generated, fused", fused::cycle),
                    all("LU 9x9", all_by!(dense::partial)),
                    all("LU 9x9, faer", all_by!(dense::faer)),
                ];
                ways.extend(generators::functions("P1b").into_iter().map(|(method, function)| {
                    all(method, move |theta, load| {
                        let mut found = [0.0; 9];
                        let [a0_x, a0_y, a_x, a_y, b_x, b_y, b0_x, b0_y, torque] =
                            function.find(&numbers(theta, load), &mut found).then_some(found)?;
                        let forces = [[a0_x, a0_y], [a_x, a_y], [b_x, b_y], [b0_x, b0_y]];
                        Some((torque, forces.map(Vector2::from)))
                    })
                }));
                table(&format!("all forces, {scalar}"), &given, rounds, $tolerance, &ways)
            }
        }
    };
}

sweeps!(double, f64, four_bar, four_bar_fused, 1e-9);
sweeps!(single, f32, four_bar_single, four_bar_fused_single, 1e-2);
