//! The accuracy bars of the closed forms, on random poses.

mod support;

use support::families::{Family, check, four_bar, length, loads, slider_crank};
use support::linkages::Random;

fn random_four_bars(seed: u64, count: usize, poses: usize) -> impl Iterator<Item = Family> {
    let mut random = Random(seed);
    (0..count).map(move |_| {
        let lengths = [0; 4].map(|_| length(&mut random, 0.1, 2.0));
        let text = four_bar(lengths, &mut random);
        let drives = (0..poses).map(|_| random.range(-7.0, 7.0)).collect();
        Family { text, longest: lengths.into_iter().fold(0.0, f64::max), drives, loads: loads(&mut random) }
    })
}

fn random_slider_cranks(seed: u64, count: usize, poses: usize) -> impl Iterator<Item = Family> {
    let mut random = Random(seed);
    (0..count).map(move |_| {
        let lengths = [length(&mut random, 0.1, 1.0), length(&mut random, 0.3, 3.0), length(&mut random, -0.5, 0.5)];
        let text = slider_crank(lengths, &mut random);
        let drives = (0..poses).map(|_| random.range(-7.0, 7.0)).collect();
        Family { text, longest: lengths.into_iter().fold(0.0, f64::max), drives, loads: loads(&mut random) }
    })
}

#[test]
fn four_bars() {
    assert!(check(random_four_bars(1, 100, 20), "four-bars") > 1000);
}

#[test]
fn slider_cranks() {
    assert!(check(random_slider_cranks(2, 100, 20), "slider-cranks") > 1000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_four_bars() {
    assert!(check(random_four_bars(3, 5000, 40), "four-bars") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_slider_cranks() {
    assert!(check(random_slider_cranks(4, 3000, 40), "slider-cranks") > 100_000);
}
