//! Inverse scenes of random linkages: whatever motion of a joint the drives make, they are found from it; and whatever is found from a motion
//! makes it.

use crate::support::linkages::{Kind, Sample, sample};
use crate::support::numbers::Double;
use crate::support::{Arguments, compile_if_it_closes, direct, pose};
use linkage_codegen::Linkage;
use linkage_codegen::graph::{Expr, Failure, NodeId, NodeValues};
use linkage_codegen::model::ids::{DriveId, GROUND, JointId, LinkId};
use linkage_codegen::model::{End, JointKind};
use linkage_codegen::program::Fault;

/// A joint's coordinate, its rate and its acceleration.
type Moved = [f64; 3];

/// A coordinate as the plain mechanics of the placed links has it.
fn coordinate(linkage: &Linkage, arguments: &Arguments, joint: JointId, turns: bool) -> Result<Moved, Fault> {
    pose::<Double>(linkage, arguments)?;
    let graph = &linkage.model.graph;
    let mut done: NodeValues<Double> = NodeValues::default();
    let mut of = |node: NodeId| graph.evaluate(node, &|symbol| Double(arguments.of(symbol)), &mut done).0;
    let data = linkage.model.joint(joint);
    let [a, b] = [data.from, data.to];
    let link = |link: LinkId| &linkage.plan.links[link.index()];
    let mut moving = |id: LinkId| match (id, link(id).motion) {
        (GROUND, _) | (_, None) => [[0.0; 3]; 2],
        (_, Some(motion)) => motion.map(|order| order.map(&mut of)),
    };
    let [motion_a, motion_b] = [a, b].map(|end| moving(end.link));
    if turns {
        let [[xa, ya], [xb, yb]] =
            [a, b].map(|end| [link(end.link).direction.x, link(end.link).direction.y].map(&mut of));
        let angle = (xa * yb - ya * xb).atan2(xa * xb + ya * yb);
        return Ok([angle, motion_b[0][2] - motion_a[0][2], motion_b[1][2] - motion_a[1][2]]);
    }
    let (carrier, axis) = data.kind.line().expect("a line");
    let mut vector = |x: Expr<'_>, y: Expr<'_>| [of(x.id()), of(y.id())];
    let axis = axis.vector(graph);
    let axis = vector(axis.x, axis.y);
    let [local_a, local_b] = [a, b].map(|end: End| linkage.model.local(end)).map(|at| vector(at.x, at.y));
    let mut frame = |id: LinkId| {
        let placed = link(id);
        [placed.direction.x, placed.direction.y, placed.origin.x, placed.origin.y].map(&mut of)
    };
    let ([ca, sa, xa, ya], [cb, sb, xb, yb]) = (frame(a.link), frame(b.link));
    let [c, s, ..] = frame(carrier);
    let turned = |[c, s]: [f64; 2], [x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
    let along = turned([c, s], axis);
    let across = [-along[1], along[0]];
    let dot = |u: [f64; 2], v: [f64; 2]| u[0] * v[0] + u[1] * v[1];
    let (arm_a, arm_b) = (turned([ca, sa], local_a), turned([cb, sb], local_b));
    let apart = [xb + arm_b[0] - xa - arm_a[0], yb + arm_b[1] - ya - arm_a[1]];
    let velocity = |[[vx, vy, w], _]: [[f64; 3]; 2], [x, y]: [f64; 2]| [vx - w * y, vy + w * x];
    let acceleration = |[[_, _, w], [ax, ay, alpha]]: [[f64; 3]; 2], [x, y]: [f64; 2]| {
        [ax - alpha * y - w * w * x, ay + alpha * x - w * w * y]
    };
    let minus = |u: [f64; 2], v: [f64; 2]| [u[0] - v[0], u[1] - v[1]];
    let relative = minus(velocity(motion_b, arm_b), velocity(motion_a, arm_a));
    let changing = minus(acceleration(motion_b, arm_b), acceleration(motion_a, arm_a));
    let omega = if carrier == a.link { motion_a[0][2] } else { motion_b[0][2] };
    let travel = dot(apart, along);
    Ok([
        travel,
        dot(relative, along),
        dot(changing, along) + 2.0 * omega * dot(relative, across) - omega * omega * travel,
    ])
}

/// The declaration with an inverse scene for a coordinate, and with what it has to choose chosen at run time: how much that is. None if the
/// linkage cannot be placed so, and why.
fn with_inverse(text: &str, wanted: &str) -> Result<(Linkage, usize), String> {
    let mut text = format!("{text}scene back: inverse({wanted});\n");
    let mut chosen = 0;
    loop {
        let refusal = match linkage_codegen::analyse(text.parse().expect("tokens")) {
            Ok(linkage) => return Ok((linkage, chosen)),
            Err(refusal) => refusal,
        };
        let mut open = Vec::new();
        for error in &refusal.errors {
            let message = error.message();
            if message.contains("is chosen already") {
                return Err(message.to_owned());
            }
            assert!(message.contains("for the scene `back`") || message.contains("the inverse"), "{message}\n{text}");
            let choice = message.lines().map(str::trim).find(|line| line.starts_with("assemble "));
            match choice {
                Some(choice) => open.push(choice.replace(": left(", ": either(").replace(": ahead(", ": either(")),
                None => return Err(message.to_owned()),
            }
        }
        assert!(!open.is_empty() && chosen < 9, "{text}");
        // Where the declaration says something else of the same joint at run time, it can say no more.
        let given =
            |line: &String| line.split(':').next().is_some_and(|start| text.contains(&format!("{start}: either")));
        if open.iter().any(given) {
            return Err("either twice".to_owned());
        }
        chosen += open.len();
        text.extend(open.into_iter().map(|line| format!("{line}\n")));
    }
}

fn kind(seed: u64) -> Kind {
    let dyads = 1 + usize::try_from(seed % 3).expect("small");
    Kind {
        dyads,
        sliders: true,
        joints: seed % 4 == 1,
        unknown_anywhere: false,
        moving: true,
        params: seed % 5 == 4,
        scalar: "f64",
    }
}

#[derive(Default, Debug)]
struct Tally {
    found: usize,
    other: usize,
    other_side: usize,
    hanging: usize,
    unreached: usize,
    steep: usize,
    refused: usize,
}

/// Whether the group that is assembled at a joint is the same in both.
fn hangs(linkage: &Linkage, inverse: &Linkage, joint: &str) -> bool {
    let of = |linkage: &Linkage| {
        let id = linkage.model.joints.iter().position(|own| own.name.text == joint).map(JointId::new)?;
        let group =
            linkage.topology.motion.iter().find(|group| group.inner.contains(&id) || group.outer.contains(&id))?;
        Some((group.links.clone(), group.outer.clone()))
    };
    of(linkage) == of(inverse)
}

/// One coordinate of a linkage: every choice of sides gives drives that make the motion, or an error; one of them gives those that made it.
fn check(sample: &Sample, joint: &str, turns: bool, is_slot: bool, tally: &mut Tally) {
    let word = if turns { "angle" } else { "travel" };
    let wanted = if is_slot { format!("{joint}.{word}") } else { joint.to_owned() };
    let (linkage, chosen) = match with_inverse(&sample.text, &wanted) {
        Ok(found) => found,
        Err(message) => {
            let known = [
                "no closed form",
                "cannot place",
                "at every pose",
                "either twice",
                "is chosen already",
                "keeps its wheels apart",
            ];
            assert!(known.iter().any(|known| message.contains(known)), "{message}\n{}", sample.text);
            tally.refused += 1;
            return;
        }
    };
    let model = &linkage.model;
    let id = JointId::new(model.joints.iter().position(|own| own.name.text == joint).expect("a joint"));
    let mut given = sample.arguments.clone();
    given.motion.iter_mut().for_each(|[rate, _]| *rate = if rate.abs() < 0.2 { 0.7 } else { *rate });
    let made = coordinate(&linkage, &given, id, turns).expect("a pose");
    // Near a dead centre of what is wanted, or where it hardly moves, nothing can be told by rounded numbers.
    let ratio = (made[1] / given.motion[0][0]).abs();
    if !(1e-3..1e3).contains(&ratio) {
        tally.steep += 1;
        return;
    }
    let inverse = &linkage.inverses[0];
    let program = &inverse.functions.scenes[0].direct;
    let drive = &model.drives[0].name.text;
    let value = |results: &[Double], name: &str| {
        let path = program.outputs.iter().position(|(path, _)| path == name).expect("a result");
        results[path].0
    };
    let close = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-7 * (1.0 + size + b.abs());
    let turned = |a: f64, b: f64| (a - b) - core::f64::consts::TAU * ((a - b) / core::f64::consts::TAU).round();
    let mut returned = false;
    for choice in 0..1usize << chosen {
        let mut arguments =
            Arguments { drives: vec![made[0]], motion: vec![[made[1], made[2]]], loads: Vec::new(), ..given.clone() };
        arguments.sides.resize(model.closures.len() - chosen, 1.0);
        arguments.sides.extend((0..chosen).map(|bit| if choice >> bit & 1 == 0 { 1.0 } else { -1.0 }));
        let results = match direct::<Double>(inverse, program, &arguments) {
            Ok(results) => results,
            Err(Fault::Failed(failure)) => {
                let name = format!("{failure:?}");
                if name.starts_with("OtherSide") {
                    tally.other_side += 1;
                } else {
                    tally.unreached += 1;
                }
                continue;
            }
            Err(fault) => panic!("{fault:?}\n{}", sample.text),
        };
        let found = [drive.clone(), format!("{drive}_rate"), format!("{drive}_acceleration")];
        let found = found.map(|name| value(&results, &name));
        let mut forward = given.clone();
        forward.drives[0] = found[0];
        forward.motion[0] = [found[1], found[2]];
        let size = found[1].abs().powi(2) + found[2].abs() + made[1].powi(2);
        let drive_turns = model.drives[0].turns;
        let off = if drive_turns { turned(found[0], given.drives[0]) } else { found[0] - given.drives[0] };
        if off.abs() < 1e-6 {
            returned = true;
            let [rate, acceleration] = given.motion[0];
            assert!(
                close(found[1], rate, size) && close(found[2], acceleration, size),
                "{wanted}: {found:?} {given:?}\n{}",
                sample.text
            );
        } else if size > 1e6 || sample.text.contains("gear ") {
            // Too near a dead centre; or another turn is another mechanism.
            continue;
        } else {
            tally.other += 1;
        }
        let again = match coordinate(&linkage, &forward, id, turns) {
            Ok(again) => again,
            // What hangs on the rest in whatever way it is driven has no say in the drives.
            Err(Fault::Failed(Failure::CannotAssemble { joint, .. })) if hangs(&linkage, inverse, &joint) => {
                tally.hanging += 1;
                continue;
            }
            Err(fault) => panic!("{wanted}: {found:?} {fault:?}\n{}", sample.text),
        };
        let back = if turns { turned(again[0], made[0]) } else { again[0] - made[0] };
        assert!(
            back.abs() < 1e-6 && close(again[1], made[1], size) && close(again[2], made[2], size),
            "{wanted} of {made:?} comes back as {again:?} with {found:?}\n{}",
            sample.text
        );
    }
    assert!(returned, "{wanted} of {made:?}: {given:?} is not found\n{}", sample.text);
    tally.found += 1;
}

#[test]
fn drives_are_found_from_the_motion_that_they_make() {
    let tally = tally(9000..9008);
    assert!(tally.found > 15 && tally.other > 10 && tally.other_side > 4, "{tally:?}");
}

#[test]
#[ignore = "long"]
fn drives_of_many_linkages_are_found_from_the_motion_that_they_make() {
    let tally = tally(9016..9200);
    println!("{tally:?}");
    assert!(tally.found > 300 && tally.other > 200 && tally.other_side > 100, "{tally:?}");
}

fn tally(seeds: core::ops::Range<u64>) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let sample = sample(seed, kind(seed));
        let Some(linkage) = compile_if_it_closes(&sample.text) else { continue };
        if linkage.model.drives.len() > 1 || pose::<Double>(&linkage, &sample.arguments).is_err() {
            continue;
        }
        let own = linkage.model.drive(DriveId::new(0)).joint;
        for id in linkage.model.joint_ids().filter(|id| *id != own) {
            let joint = linkage.model.joint(id);
            let coordinates: &[bool] = match joint.kind {
                JointKind::Revolute => &[true],
                JointKind::Prismatic { .. } => &[false],
                JointKind::Slot { .. } => &[true, false],
                JointKind::Weld { .. } | JointKind::Gear(_) => &[],
            };
            for turns in coordinates {
                let is_slot = matches!(joint.kind, JointKind::Slot { .. });
                check(&sample, &joint.name.text, *turns, is_slot, &mut tally);
            }
        }
    }
    tally
}

/// Of the two pins that a side of a slide may be told from, the help names the one that says nothing of the declaration's own group.
#[test]
fn a_side_is_asked_for_that_can_be_given() {
    let declared = "mod pump; ground { O: (0, 0), Q: (60mm, 10mm) } link crank { O -> A: 20mm }
         link guide { Q: (0, 0) } link rod { A: (0, 0) }
         revolute O: ground -> crank; revolute A: crank -> rod; revolute Q: ground -> guide;
         prismatic S: guide.Q -> rod.A along 0deg of guide; drive q: O; assemble S: behind(A); scene back: inverse(A) -> (q);";
    let refusal = linkage_codegen::analyse(declared.parse().expect("tokens")).expect_err("no side of the inverse's");
    let [error] = refusal.errors.as_slice() else { panic!("{:?}", refusal.errors) };
    assert!(error.message().contains("assemble S: behind(O);"), "{}", error.message());
    let said = format!("{declared} assemble S: behind(O);");
    assert!(linkage_codegen::analyse(said.parse().expect("tokens")).is_ok());
}
