//! Sweeps: the generated function over slices against a loop that calls the point function, in the same round.
#![allow(clippy::cast_precision_loss, reason = "small whole numbers are exact")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use linkage_runtime::{Error, Series, SweepError, Vector2, polar};

use crate::linkages::four_bar::{self, Loads, Torques, TorquesInputs};

/// Prints, for 360 and 4096 positions, the time of each and the median of the paired ratios.
pub(crate) fn print(rounds: usize) -> Result<(), String> {
    println!("\nsweeps of the four-bar, torque only, both loads at each position: ns for each position");
    println!("  {:>9} {:>12} {:>8} {:>8}", "positions", "point calls", "sweep", "ratio");
    for count in [360, 4096] {
        row(count, rounds)?;
    }
    Ok(())
}

fn row(count: usize, rounds: usize) -> Result<(), String> {
    let part = |index: usize| index as f64 / count as f64;
    // Within the range in which the linkage closes.
    let theta: Vec<f64> = (0..count).map(|index| 0.5 + 2.0 * part(index)).collect();
    let loads: Vec<Vector2<f64>> = (0..count).map(|index| polar(50.0, 6.0 * part(index))).collect();
    let (mut points, mut swept) = (vec![0.0; count], vec![0.0; count]);
    let repeats = (200_000 / count).max(1);
    let mut times: Vec<[Duration; 2]> = Vec::new();
    for _ in 0..rounds {
        let start = Instant::now();
        for _ in 0..repeats {
            point_by_point(black_box(&theta), black_box(&loads), black_box(&mut points)).map_err(|e| e.to_string())?;
        }
        let by_points = start.elapsed();
        let start = Instant::now();
        for _ in 0..repeats {
            sweep(black_box(&theta), black_box(&loads), black_box(&mut swept)).map_err(|e| e.to_string())?;
        }
        times.push([by_points, start.elapsed()]);
    }
    if points.iter().zip(&swept).any(|(point, swept)| point.to_bits() != swept.to_bits()) {
        return Err("a sweep has other bits than the point function".into());
    }
    let mut ratios: Vec<f64> = times.iter().map(|[point, sweep]| sweep.as_secs_f64() / point.as_secs_f64()).collect();
    let mut each = [0, 1].map(|which| times.iter().map(|time| time[which].as_secs_f64()).collect::<Vec<_>>());
    let median = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let calls = (count * repeats) as f64;
    let [point, sweep] = each.each_mut().map(|times| median(times) * 1e9 / calls);
    println!("  {count:>9} {point:>12.2} {sweep:>8.2} {:>8.3}", median(&mut ratios));
    Ok(())
}

#[inline(never)]
fn point_by_point(theta: &[f64], loads: &[Vector2<f64>], torques: &mut [f64]) -> Result<(), Error> {
    for ((theta, load), torque) in theta.iter().zip(loads).zip(torques) {
        *torque = four_bar::torque_at(*theta, &Loads { F13: *load, F14: *load })?.T12;
    }
    Ok(())
}

#[inline(never)]
fn sweep(theta: &[f64], loads: &[Vector2<f64>], torques: &mut [f64]) -> Result<(), SweepError> {
    let inputs = TorquesInputs { theta: Series::Each(theta), F13: Series::Each(loads), F14: Series::Each(loads) };
    four_bar::torques(&inputs, Torques { T12: torques })
}
