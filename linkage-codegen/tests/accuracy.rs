//! The accuracy bars of the closed forms, on random poses.

mod support;

use support::families::{
    Family, SCENES, boom, check, four_bar, length, loads, oscillating_block, planet, scotch_yoke, searched, shaper,
    slider_crank, slotted_crank, slotted_yoke, tangent_mechanism,
};
use support::linkages::{Class, Random};

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

type Text = fn([f64; 3], &mut Random) -> String;

/// A linkage by three dimensions, each with its least and its largest size, and the drive's range.
fn random_linkages(
    seed: u64,
    (count, poses): (usize, usize),
    text: Text,
    dimensions: [(f64, f64); 3],
    (low, high): (f64, f64),
) -> impl Iterator<Item = Family> {
    let mut random = Random(seed);
    (0..count).map(move |_| {
        let lengths = dimensions.map(|(low, high)| length(&mut random, low, high));
        let text = text(lengths, &mut random);
        let drives = (0..poses).map(|_| random.range(low, high)).collect();
        // The third may be an angle.
        Family { text, longest: lengths[0].max(lengths[1]), drives, loads: loads(&mut random) }
    })
}

fn oscillating_blocks(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, oscillating_block, [(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn tangent_mechanisms(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, tangent_mechanism, [(0.3, 2.0), (-0.5, 0.5), (60.0, 120.0)], (-1.0, 1.0))
}

fn scotch_yokes(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, scotch_yoke, [(0.3, 2.0), (-0.5, 0.5), (45.0, 135.0)], (-7.0, 7.0))
}

fn booms(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, boom, [(0.5, 2.0), (0.5, 2.0), (-0.2, 0.2)], (0.5, 3.0))
}

fn shapers(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, shaper, [(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn slotted_cranks(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, slotted_crank, [(0.3, 2.0), (0.5, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn slotted_yokes(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, slotted_yoke, [(0.3, 2.0), (-0.5, 0.5), (45.0, 135.0)], (-7.0, 7.0))
}

fn planets(seed: u64, size: (usize, usize)) -> impl Iterator<Item = Family> {
    random_linkages(seed, size, planet, [(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)], (-7.0, 7.0))
}

fn searches(seed: u64, (count, poses): (u64, usize), class: Class) -> impl Iterator<Item = Family> {
    (0..count).map(move |number| searched(1000 * seed + number, class, poses))
}

#[test]
fn slots() {
    assert!(check(shapers(13, (60, 20)), "levers with slots") > 600);
    assert!(check(slotted_cranks(14, (60, 20)), "links in a crank's slot") > 600);
    assert!(check(slotted_yokes(15, (60, 20)), "yokes with slots") > 1000);
}

#[test]
fn gears() {
    assert!(check(planets(17, (60, 20)), "planets") > 1000);
}

#[test]
fn triads_and_rings() {
    assert!(check(searches(18, (25, 6), Class::Three), "triads") > 100);
    assert!(check(searches(19, (25, 6), Class::ThreeWithSlider), "triads, some with a slider") > 100);
    assert!(check(searches(20, (25, 6), Class::Four), "groups of class IV") > 100);
}

#[test]
#[ignore = "long"]
fn ten_thousand_poses_of_slots() {
    assert!(check(shapers(21, (800, 20)), "levers with slots") > 10_000);
    assert!(check(slotted_cranks(22, (800, 20)), "links in a crank's slot") > 10_000);
}

#[test]
#[ignore = "long"]
fn ten_thousand_poses_of_gears() {
    assert!(check(planets(25, (520, 20)), "planets") > 10_000);
}

#[test]
fn oscillating_blocks_and_booms() {
    assert!(check(oscillating_blocks(5, (60, 20)), "oscillating blocks") > 600);
    assert!(check(booms(6, (60, 20)), "booms on cylinders") > 300);
}

/// A rod with a load near its runner, which the drive holds against its tube: the pin at the rod's end is far from the load and has little
/// to hold, so that the moments about that pin are large and those about the runner are not.
#[test]
fn a_load_near_the_runner() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), P: 0.7060748338699341m @ 249.6663629451129deg }} link boom {{ O -> Q: 1.242154836654663m }}
         link tube {{ P: (0, 0), D: (-0.005465666297823191m, 0.02559126541018486m) }}
         link rod {{ Q: (0, 0.14513885974884033m), S: (0, 0), E: (0.02559126541018486m, -0.005465666297823191m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of tube; drive extension: lift; assemble Q: left(P -> O);
         load F: force(tube.D); load H: force(rod.E); {SCENES}"
    );
    let loads =
        vec![[5.931_205_272_674_560_5, 39.466_209_411_621_094], [47.785_552_978_515_625, -16.239_543_914_794_922]];
    let drives = vec![0.829_276_919_364_929_2];
    assert_eq!(
        check([Family { text, longest: 1.242_154_836_654_663, drives, loads }].into_iter(), "a load near the runner"),
        1
    );
}

/// A boom whose cylinder is pinned next to its own pin: legs of nearly one length, which must differ by the way between the pins and by
/// nothing that rounding adds to either.
#[test]
fn pins_close_to_each_other() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), P: 0.00846228376030922m @ 208.03794673546273deg }}
         link boom {{ O -> Q: 1.571088194847107m, T: (0.3m, -0.2m) }} link tube {{ P: (0, 0), D: (0.2m, 0.3m) }}
         link rod {{ Q: (0, 0.006199629977345467m), S: (0, 0), E: (0.3m, 0.2m) }}
         revolute O: ground -> boom; revolute P: ground -> tube; revolute Q: rod -> boom;
         prismatic lift: tube.P -> rod.S along 0deg of tube; drive extension: lift; assemble Q: right(P -> O);
         load F: force(boom.T); load H: force(rod.E); {SCENES}"
    );
    let drives = (0..40).map(|step| 1.563 + 0.000_4 * f64::from(step)).collect();
    let loads = vec![[5.0, 39.0], [47.0, -16.0]];
    let family = Family { text, longest: 1.571_088_194_847_107, drives, loads };
    assert!(check(std::iter::once(family), "pins close to each other") > 30);
}

/// A block that is loaded where it slides on a lever, across the lever's line: next to nothing is left for its own guide, far away, which must
/// get the moment of that and not of what rounding leaves of two forces that cancel.
#[test]
fn a_guide_that_is_left_with_little() {
    let text = format!(
        "pub mod sample; ground {{ O: (0, 0), B: (-0.29m, 0.113m) }} link crank {{ O: (0, 0), A: (0.5m, 0) }} link lever {{ B: (0, 0) }}
         link block {{ P: (0, 0), G: (2.2m, 0.4m) }} revolute O: ground -> crank; revolute B: ground -> lever; drive q: O;
         prismatic outer: crank.A -> block.G along 20deg of crank; prismatic inner: lever.B -> block.P along 10deg of lever, angle 70deg;
         load F: force(block.P); {SCENES}"
    );
    // At zero the lever's line is at −60°, and the load across it.
    let drives = (-20..=20).map(|step| 0.000_7 * f64::from(step)).collect();
    let family = Family { text, longest: 2.3, drives, loads: vec![[34.64, 20.0]] };
    assert!(check(std::iter::once(family), "a guide that is left with little") == 41);
}

#[test]
fn sliders_on_sliders() {
    assert!(check(tangent_mechanisms(7, (60, 20)), "tangent mechanisms") > 1000);
    assert!(check(scotch_yokes(8, (60, 20)), "Scotch yokes") > 1000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_oscillating_blocks() {
    assert!(check(oscillating_blocks(9, (3500, 40)), "oscillating blocks") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_booms() {
    assert!(check(booms(10, (3600, 40)), "booms on cylinders") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_tangent_mechanisms() {
    assert!(check(tangent_mechanisms(11, (2600, 40)), "tangent mechanisms") > 100_000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_scotch_yokes() {
    assert!(check(scotch_yokes(12, (2600, 40)), "Scotch yokes") > 100_000);
}

/// The same linkages with products that are added without being rounded.
fn fused(families: impl Iterator<Item = Family>) -> impl Iterator<Item = Family> {
    families.map(|family| {
        let text = family.text.replacen("pub mod sample;", "pub mod sample; arithmetic fused;", 1);
        assert!(text.contains("arithmetic fused;"));
        Family { text, ..family }
    })
}

#[test]
fn fused_arithmetic() {
    assert!(check(fused(random_four_bars(9, 100, 20)), "fused four-bars") > 1000);
    assert!(check(fused(random_slider_cranks(10, 60, 20)), "fused slider-cranks") > 600);
    assert!(check(fused(oscillating_blocks(11, (60, 20))), "fused oscillating blocks") > 600);
    assert!(check(fused(tangent_mechanisms(12, (60, 20))), "fused tangent mechanisms") > 600);
    assert!(check(fused(scotch_yokes(13, (60, 20))), "fused Scotch yokes") > 1000);
}

#[test]
#[ignore = "long"]
fn a_hundred_thousand_fused_four_bars() {
    assert!(check(fused(random_four_bars(14, 5_000, 40)), "fused four-bars") > 100_000);
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
