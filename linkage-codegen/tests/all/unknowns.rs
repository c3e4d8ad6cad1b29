//! Efforts at drives by their names: in whatever order they are declared, and beside one that acts elsewhere.

use std::collections::HashMap;

use crate::support::numbers::Double;
use crate::support::{Arguments, compile, scene};

/// A boom that turns on the ground, and a stick that a cylinder on the boom turns.
const BOOM: &str = "mod boom; ground { O: (0, 0), C: (0.9m, -0.3m) } link boom { O -> E: 5m, Q: (2.2m, 0.4m), R: (2.6m, 0.9m) }
    link stick { E -> tip: 2.8m, K: (-0.6m, 0.2m) } link tube { R: (0, 0) } link rod { K: (0, 0) }
    mass boom: 1400kg at (2.4m, 0.3m), inertia 3100kg*m^2; mass stick: 600kg at (1m, 0.05m); mass rod: 60kg at (-0.6m, 0);
    revolute O: ground -> boom; revolute E: boom -> stick; revolute R: boom -> tube; revolute K: rod -> stick;
    prismatic curl: tube.R -> rod.K along 0deg of tube; drive turn: O; drive reach: curl; assemble K: left(R -> E);
    load W: gravity = 9.81m/s^2 @ -90deg; load I: inertia; load dig: force(stick.tip) in stick;
    scene all: equilibrium; scene work: virtual_work -> (EFFORTS); scene control: motion -> (M, h, M_kinetic);
    scene put_in: equilibrium -> (power, ground about ground.C);";

fn solved(unknowns: &str, efforts: &str) -> [HashMap<String, f64>; 4] {
    let linkage = compile(&format!("{} {unknowns}", BOOM.replace("EFFORTS", efforts)));
    let arguments = Arguments {
        drives: vec![0.9, 2.3],
        loads: vec![[0.0; 2], [0.0; 2], [-9e3, 4e3]],
        motion: vec![[0.35, -0.2], [0.22, 0.4]],
        ..Arguments::default()
    };
    ["all", "work", "control", "put_in"].map(|name| {
        let found = scene::<Double>(&linkage, name, &arguments).expect("a solution");
        found.into_iter().map(|(path, value)| (path, value.0)).collect()
    })
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1e4), "{found} and not {expected}");
}

#[test]
fn efforts_at_the_drives_have_names_of_their_own_in_any_order() {
    let [plain, work, control, put_in] = solved("", "effort_turn, effort_reach");
    let names = [("hold", "effort_turn"), ("thrust", "effort_reach")];
    let declared = ["unknown hold: effort(turn);", "unknown thrust: effort(reach);"];
    for [first, second] in [[0, 1], [1, 0]] {
        let unknowns = format!("{} {}", declared[first], declared[second]);
        let [own, own_work, own_control, own_put_in] = solved(&unknowns, "hold, thrust");
        for (name, default) in names {
            near(own[name], plain[default]);
            near(own_work[name], work[default]);
        }
        for (path, value) in plain.iter().filter(|(path, _)| !path.starts_with("effort_")) {
            near(own[path], *value);
        }
        // A row for each unknown, a column for each drive.
        for row in 0..2 {
            let own_row = [first, second].iter().position(|drive| *drive == row).expect("a row") + 1;
            near(own_control[&format!("h.{own_row}")], control[&format!("h.{}", row + 1)]);
            for column in 1..3 {
                near(own_control[&format!("M.{own_row}.{column}")], control[&format!("M.{}.{column}", row + 1)]);
                let kinetic = format!("M_kinetic.{}.{column}", row + 1);
                near(own_control[&kinetic], control[&kinetic]);
            }
        }
        for (path, value) in &put_in {
            near(own_put_in[path], *value);
        }
    }
}

#[test]
fn an_effort_at_a_drive_stands_beside_one_elsewhere() {
    let [plain, _, _, put_in] = solved("", "effort_turn, effort_reach");
    let declared = ["unknown lift: thrust(ground.C, boom.Q);", "unknown thrust: effort(reach);"];
    let [reversed, ..] = solved(&[declared[1], declared[0]].concat(), "thrust, lift");
    let [own, work, control, own_put_in] = solved(&declared.concat(), "lift, thrust");
    for (path, value) in &own {
        near(reversed[path], *value);
    }
    // The cylinder on the boom does not know what holds the boom.
    near(own["thrust"], plain["effort_reach"]);
    near(work["thrust"], own["thrust"]);
    near(work["lift"], own["lift"]);
    near(own_put_in["power"], put_in["power"]);
    for row in 1..3 {
        let name = if row == 1 { "lift" } else { "thrust" };
        let sum = control[&format!("M.{row}.1")] * -0.2 + control[&format!("M.{row}.2")] * 0.4;
        near(sum + control[&format!("h.{row}")], own[name]);
    }
    // What holds it turns it about its pin as the torque did.
    let (c, q) = ([0.9, -0.3], [2.2 * 0.9f64.cos() - 0.4 * 0.9f64.sin(), 2.2 * 0.9f64.sin() + 0.4 * 0.9f64.cos()]);
    let line = [q[0] - c[0], q[1] - c[1]];
    let arm = (c[0] * line[1] - c[1] * line[0]) / line[0].hypot(line[1]);
    near(own["lift"] * arm, plain["effort_turn"]);
}
