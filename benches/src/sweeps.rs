//! Sweeps: the generated function over slices against loops over the positions, one that calls the generated function for a
//! single position and one that calls the expert's, in the same round.
#![allow(
    non_snake_case,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    reason = "positions, in either precision"
)]

use std::hint::black_box;
use std::time::Instant;

use linkage_runtime::__private::limit_registers;

/// Prints, for 360 and 4096 positions, the times of each position and the medians of the paired ratios: by the instructions that this
/// program was compiled for, and by wider ones that this processor has.
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
        for count in [360, 4096] {
            double::rows(count, rounds)?;
            single::rows(count, rounds)?;
            fused::rows(count, rounds)?;
            fused_single::rows(count, rounds)?;
        }
    }
    Ok(())
}

/// The instructions between which a sweep chooses here, by the bytes of their registers.
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

/// Times three ways, in turns, and prints a row.
fn row(title: &str, count: usize, rounds: usize, ways: &mut [&mut dyn FnMut(); 3]) {
    // Shorter than what the system gives a program at a time: few of these times hold a pause.
    let repeats = (16_384 / count).max(1);
    let mut times: Vec<[f64; 3]> = Vec::new();
    for _ in 0..rounds {
        times.push(ways.each_mut().map(|way| {
            let start = Instant::now();
            for _ in 0..repeats {
                way();
            }
            start.elapsed().as_secs_f64() * 1e9 / (count * repeats) as f64
        }));
    }
    let median = |of: &dyn Fn(&[f64; 3]) -> f64| {
        let mut values: Vec<f64> = times.iter().map(of).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let [expert, calls, sweep] = [0, 1, 2].map(|which| median(&|times| times[which]));
    let [to_expert, to_calls] = [0, 1].map(|which| median(&|times| times[2] / times[which]));
    println!("  {title:>22} {count:>9} {expert:>8.2} {calls:>8.2} {sweep:>8.2} {to_expert:>8.3} {to_calls:>8.3}");
}

/// The sweeps of a four-bar in a scalar.
macro_rules! sweeps {
    ($module:ident, $scalar:ident, $note:literal, $linkage:ident, $tolerance:expr) => {
        mod $module {
            use linkage_runtime::{Series, Vector2};

            use super::{black_box, row};
            use crate::expert::swept::$linkage as expert;
            use crate::items::Reactions;
            use crate::linkages::swept::$linkage::{self, Cycle, CycleInputs, Loads, Torques, TorquesInputs};

            /// What is given: the driver's angles, and a load on coupler and rocker.
            struct Given {
                theta: Vec<$scalar>,
                loads: Vec<Vector2<$scalar>>,
            }

            impl Given {
                /// A turn from the line of the ground link on, without what lies next to the fold at half a turn, where the expert has no digits left
                /// in single precision.
                fn new(count: usize) -> Self {
                    const BESIDE: $scalar = 0.05;
                    const HALF: $scalar = core::$scalar::consts::PI;
                    let part = |index: usize| index as $scalar / count as $scalar;
                    let theta = |index: usize| {
                        let turned = 2.0 * (HALF - BESIDE) * part(index);
                        if turned < HALF - BESIDE { turned } else { turned + 2.0 * BESIDE }
                    };
                    let load = |angle: $scalar| Vector2::new(50.0 * angle.cos(), 50.0 * angle.sin());
                    Self {
                        theta: (0..count).map(theta).collect(),
                        loads: (0..count).map(|index| load(6.0 * part(index))).collect(),
                    }
                }

                fn at(&self) -> impl Iterator<Item = (&$scalar, Loads)> {
                    let loads = self.loads.iter().map(|load| Loads { F13: *load, F14: *load });
                    self.theta.iter().zip(loads)
                }
            }

            /// A number in each slice for each position.
            fn room<const N: usize>(count: usize) -> [Vec<$scalar>; N] {
                core::array::from_fn(|_| vec![0.0; count])
            }

            #[inline(never)]
            fn torques_expert(given: &Given, results: &mut [Vec<$scalar>; 1]) {
                let [torques] = results;
                for ((theta, loads), torque) in given.at().zip(torques) {
                    *torque = expert::pose(*theta).torque_of(&loads);
                }
            }

            #[inline(never)]
            fn torques_calls(given: &Given, results: &mut [Vec<$scalar>; 1]) {
                let [torques] = results;
                for ((theta, loads), torque) in given.at().zip(torques) {
                    let Ok(solved) = $linkage::torque_at(*theta, &loads) else { return };
                    *torque = solved.T12;
                }
            }

            #[inline(never)]
            fn torques_sweep(given: &Given, results: &mut [Vec<$scalar>; 1]) {
                let (theta, load) = (Series::Each(&given.theta), Series::Each(&given.loads));
                let [T12] = results;
                let _ = $linkage::torques(&TorquesInputs { theta, F13: load, F14: load }, Torques { T12 });
            }

            /// The torque and the forces in A, B and B0; A0 has the force of A.
            #[inline]
            fn put(results: &mut [Vec<$scalar>; 9], index: usize, torque: $scalar, forces: [Vector2<$scalar>; 4]) {
                let [a0, a, b, b0] = forces;
                let numbers = [torque, a0.x, a0.y, a.x, a.y, b.x, b.y, b0.x, b0.y];
                for (slice, number) in results.iter_mut().zip(numbers) {
                    if let Some(place) = slice.get_mut(index) {
                        *place = number;
                    }
                }
            }

            #[inline(never)]
            fn all_expert(given: &Given, results: &mut [Vec<$scalar>; 9]) {
                for (index, (theta, loads)) in given.at().enumerate() {
                    let mut out = Reactions { torque: 0.0, forces: [Vector2::zeros(); 4] };
                    expert::pose(*theta).statics(&loads, &mut out);
                    put(results, index, out.torque, out.forces);
                }
            }

            #[inline(never)]
            fn all_calls(given: &Given, results: &mut [Vec<$scalar>; 9]) {
                for (index, (theta, loads)) in given.at().enumerate() {
                    let Ok(all) = $linkage::statics_at(*theta, &loads) else { return };
                    put(results, index, all.T12, [all.A0, all.A, all.B, all.B0]);
                }
            }

            #[inline(never)]
            fn all_sweep(given: &Given, results: &mut [Vec<$scalar>; 9]) {
                let (theta, load) = (Series::Each(&given.theta), Series::Each(&given.loads));
                let [T12, A0_x, A0_y, A_x, A_y, B_x, B_y, B0_x, B0_y] = results.each_mut().map(Vec::as_mut_slice);
                let _ = $linkage::cycle(
                    &CycleInputs { theta, F13: load, F14: load },
                    Cycle { T12, A0_x, A0_y, A_x, A_y, B_x, B_y, B0_x, B0_y },
                );
            }

            type Way<const N: usize> = fn(&Given, &mut [Vec<$scalar>; N]);

            /// A row: all positions in three ways. The sweep has the bits of the calls, the expert is near them.
            fn compared<const N: usize>(
                title: &str,
                count: usize,
                rounds: usize,
                ways: [Way<N>; 3],
            ) -> Result<(), String> {
                let given = Given::new(count);
                let mut results = [(); 3].map(|()| room::<N>(count));
                for (way, results) in ways.iter().zip(&mut results) {
                    way(&given, results);
                }
                let [by_expert, by_calls, by_sweep] = &results;
                for ((expert, calls), sweep) in
                    by_expert.iter().flatten().zip(by_calls.iter().flatten()).zip(by_sweep.iter().flatten())
                {
                    if calls.to_bits() != sweep.to_bits() {
                        return Err(format!("{title}: a sweep has other bits than the calls"));
                    }
                    let near = (expert - calls).abs() <= $tolerance * (1.0 + calls.abs());
                    if !near {
                        return Err(format!("{title}: the expert has {expert}, a call {calls}"));
                    }
                }
                let [expert, calls, sweep] = &mut results;
                let [by_expert, by_calls, by_sweep] = ways;
                row(
                    title,
                    count,
                    rounds,
                    &mut [
                        &mut || by_expert(black_box(&given), black_box(&mut *expert)),
                        &mut || by_calls(black_box(&given), black_box(&mut *calls)),
                        &mut || by_sweep(black_box(&given), black_box(&mut *sweep)),
                    ],
                );
                Ok(())
            }

            pub(super) fn rows(count: usize, rounds: usize) -> Result<(), String> {
                let scalar = concat!(stringify!($scalar), $note);
                compared(
                    &format!("torque only, {scalar}"),
                    count,
                    rounds,
                    [torques_expert, torques_calls, torques_sweep],
                )?;
                compared(&format!("all forces, {scalar}"), count, rounds, [all_expert, all_calls, all_sweep])
            }
        }
    };
}

sweeps!(double, f64, "", four_bar, 1e-9);
sweeps!(single, f32, "", four_bar_single, 1e-2);
sweeps!(fused, f64, " fused", four_bar_fused, 1e-9);
sweeps!(fused_single, f32, " fused", four_bar_fused_single, 1e-2);
