//! P1b and P1c in single precision.

use linkage_runtime::Vector2;

use super::four_bar::exact;
use super::{Case, Extent, Item, Reactions, Turn};
use crate::expert::four_bar_single as expert;
use crate::linkages::four_bar;
use crate::linkages::four_bar_single::{self, Loads};

type All = Reactions<4, f32>;
type At = Case<f32, Loads>;

pub(super) fn items(extent: Extent) -> Vec<Item> {
    let turn = Turn::new(Extent { single: true, ..extent }, 80.0, |theta, loads| vec![exact(theta, loads)]);
    vec![
        Item {
            id: "P1b-f32",
            title: "four-bar in f32: all forces and the torque, from the driver's angle",
            competitors: vec![
                turn.posed("expert", given, statics_expert),
                turn.posed("careful expert", given, statics_careful),
                turn.posed("generated", given, statics_generated),
            ],
        },
        Item {
            id: "P1c-f32",
            title: "four-bar in f32: the torque only, from the driver's angle",
            competitors: vec![
                turn.posed("expert", given, torque_expert),
                turn.posed("careful expert", given, torque_careful),
                turn.posed("generated", given, torque_generated),
            ],
        },
    ]
}

/// A case whose numbers single precision holds.
#[allow(clippy::cast_possible_truncation, reason = "they are numbers of single precision")]
pub(crate) fn given(case: &Case<f64, four_bar::Loads>) -> At {
    let force = |force: Vector2<f64>| force.map(|part| part as f32);
    let four_bar::Loads { F13, F14 } = case.loads;
    Case { start: case.start as f32, loads: Loads { F13: force(F13), F14: force(F14) } }
}

fn statics_expert(case: &At, out: &mut All) -> bool {
    expert::pose(case.start).statics(&case.loads, out);
    true
}

fn statics_careful(case: &At, out: &mut All) -> bool {
    let Some(pose) = expert::careful_pose(case.start) else { return false };
    pose.statics(&case.loads, out);
    out.is_finite()
}

pub(crate) fn statics_generated(case: &At, out: &mut All) -> bool {
    match four_bar_single::statics_at(case.start, &case.loads) {
        Ok(all) => {
            *out = Reactions { torque: all.T12, forces: [all.A0, all.A, all.B, all.B0] };
            true
        }
        Err(_) => false,
    }
}

fn torque_expert(case: &At, out: &mut f32) -> bool {
    *out = expert::pose(case.start).torque_of(&case.loads);
    true
}

fn torque_careful(case: &At, out: &mut f32) -> bool {
    let Some(pose) = expert::careful_pose(case.start) else { return false };
    *out = pose.torque_of(&case.loads);
    out.is_finite()
}

pub(crate) fn torque_generated(case: &At, out: &mut f32) -> bool {
    match four_bar_single::torque_at(case.start, &case.loads) {
        Ok(torque) => {
            *out = torque.T12;
            true
        }
        Err(_) => false,
    }
}
