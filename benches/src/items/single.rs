//! All items in single precision.

use super::dense::{self, eliminations};
use super::{Case, Extent, Item, Turn, four_bar, six_bar, slider_crank};
use crate::expert::four_bar_single as expert;
use crate::generators;
use crate::linkages::{self, four_bar_fused_single, four_bar_single};

pub(super) fn items(extent: Extent) -> Vec<Item> {
    let extent = Extent { single: true, ..extent };
    let mut items = of_four_bar(extent);
    items.push(of_six_bar(extent));
    items.push(of_slider_crank(extent));
    items
}

fn of_four_bar(extent: Extent) -> Vec<Item> {
    use four_bar::{fused_single as fused, single};

    let turn = Turn::new(extent, 80.0, |theta, loads| vec![four_bar::exact(theta, loads)]);
    let parts = Turn::new(extent, 80.0, four_bar::exact_parts);
    let pose = |theta| four_bar_single::Pose::at(theta).expect("a pose");
    let fused_pose = |theta| four_bar_fused_single::Pose::at(theta).expect("a pose");
    let careful_pose = |theta| expert::careful_pose(theta).expect("a pose");
    let mut items = vec![
        Item {
            id: "P1a-f32",
            title: "four-bar in f32: all forces and the torque, from a pose",
            competitors: vec![
                turn.posed("expert", prepared(expert::pose), single::statics_expert),
                turn.posed("careful expert", prepared(careful_pose), single::statics_careful),
                turn.posed("generated", prepared(pose), single::statics_generated),
                turn.posed("generated, fused", prepared(fused_pose), fused::statics_generated),
            ],
        },
        Item {
            id: "P1b-f32",
            title: "four-bar in f32: all forces and the torque, from the driver's angle",
            competitors: vec![
                turn.posed("expert", given, single::statics_at_expert),
                turn.posed("expert, law of cosines", given, single::statics_at_by_cosine),
                turn.posed("careful expert", given, single::statics_at_careful),
                turn.posed("generated", given, single::statics_at_generated),
                turn.posed("generated, fused", given, fused::statics_at_generated),
            ],
        },
        Item {
            id: "P1c-f32",
            title: "four-bar in f32: the torque only, from the driver's angle",
            competitors: vec![
                turn.posed("expert", given, single::torque_at_expert),
                turn.posed("expert, law of cosines", given, single::torque_at_by_cosine),
                turn.posed("careful expert", given, single::torque_at_careful),
                turn.posed("generated", given, single::torque_at_generated),
                turn.posed("generated, fused", given, fused::torque_at_generated),
            ],
        },
        Item {
            id: "P1d-f32",
            title: "four-bar in f32: forces and torque by each of two loads, from the driver's angle",
            competitors: vec![
                parts.posed("expert", given, single::parts_at_expert),
                parts.posed("expert, law of cosines", given, single::parts_at_by_cosine),
                parts.posed("careful expert", given, single::parts_at_careful),
                parts.posed("generated", given, single::parts_at_generated),
                parts.posed("generated, fused", given, fused::parts_at_generated),
            ],
        },
    ];
    let eliminations = [
        eliminations!(|method, call| turn.posed(method, prepared(pose), call), "9x9", single::statics_eliminated),
        eliminations!(|method, call| turn.posed(method, given, call), "9x9", single::statics_at_eliminated),
        eliminations!(|method, call| turn.posed(method, given, call), "9x9", single::torque_at_eliminated),
        eliminations!(|method, call| parts.posed(method, given, call), "9x9", single::parts_at_eliminated),
    ];
    for (item, eliminations) in items.iter_mut().zip(eliminations) {
        item.competitors.extend(eliminations);
    }
    four_bar::add_generators::<f32>(&mut items, &turn, &parts);
    items
}

fn of_six_bar(extent: Extent) -> Item {
    let turn = Turn::new(extent, 50.0, |theta, loads| vec![six_bar::exact(theta, loads)]);
    let mut competitors = vec![
        turn.posed("expert", given, six_bar::statics_at_expert_single),
        turn.posed("expert, law of cosines", given, six_bar::statics_at_by_cosine_single),
        turn.posed("generated", given, six_bar::statics_at_generated_single),
        turn.posed("generated, fused", given, six_bar::statics_at_fused_single),
    ];
    let eliminations =
        eliminations!(|method, call| turn.posed(method, given, call), "15x15", six_bar::single::statics_at_eliminated);
    competitors.extend(eliminations);
    let loads = |loads: &linkages::six_bar::Loads| vec![loads.F, loads.G];
    generators::add::<f32, _, 5, 15, 1>(&mut competitors, "P2b-f32", &turn, loads);
    Item {
        id: "P2b-f32",
        title: "six-bar with weights in f32: all forces and the torque, from the driver's angle",
        competitors,
    }
}

fn of_slider_crank(extent: Extent) -> Item {
    let turn = Turn::new(extent, 45.0, |theta, loads| vec![slider_crank::exact(theta, loads)]);
    let mut competitors = vec![
        turn.posed("expert", given, slider_crank::statics_at_expert_single),
        turn.posed("generated", given, slider_crank::statics_at_generated_single),
        turn.posed("generated, fused", given, slider_crank::statics_at_fused_single),
    ];
    let eliminations = eliminations!(
        |method, call| turn.posed(method, given, call),
        "9x9",
        slider_crank::single::statics_at_eliminated
    );
    competitors.extend(eliminations);
    let loads = |loads: &linkages::slider_crank::Loads| vec![loads.gas];
    generators::add::<f32, _, 3, 9, 1>(&mut competitors, "P3b-f32", &turn, loads);
    Item {
        id: "P3b-f32",
        title: "slider-crank in f32: all forces and the torque, from the driver's angle",
        competitors,
    }
}

/// A case whose numbers single precision holds.
#[allow(clippy::cast_possible_truncation, reason = "they are numbers of single precision")]
pub(crate) fn given<L: Copy, K: From<L>>(case: &Case<f64, L>) -> Case<f32, K> {
    Case { start: case.start as f32, loads: case.loads.into() }
}

/// The same, but for what `prepare` makes of the driver's angle.
fn prepared<S, L: Copy, K: From<L>>(prepare: impl Fn(f32) -> S) -> impl Fn(&Case<f64, L>) -> Case<S, K> {
    move |case| {
        let Case { start, loads } = given(case);
        Case { start: prepare(start), loads }
    }
}
