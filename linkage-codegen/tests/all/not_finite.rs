//! NaN and infinity in every input of every emitted function, one at a time: a typed error of what reads it, and of what does not the same
//! results bit for bit.
//!
//! The functions are those of every example and of the declarations beside them, as the interpreter carries them out: what it finds is what
//! the emitted code computes, as `emitted.rs` and `emitted_random.rs` hold. Sweeps, `Limits`, and the accelerations that follow from an
//! equation of motion are given such numbers as emitted code: in the root package's `sweeps.rs`, `sweeps_not_finite.rs`,
//! `sweeps_of_motion.rs`, `control.rs`, and in `limits.rs`.

use crate::support::declarations::{coordinates, given, linkages, poses};
use crate::support::numbers::{Double, Single};
use crate::support::{Arguments, Number, checked_pose, direct, from_pose, moved, pose, prepared};
use linkage_codegen::Linkage;
use linkage_codegen::graph::{Failure, NodeValues, Order, Scalar, Symbol};
use linkage_codegen::model::ids::DriveId;
use linkage_codegen::program::{Fault, Input, Program, Step};

type Call<'a, T> = Box<dyn Fn(&Arguments) -> Result<Vec<T>, Fault> + 'a>;

/// A function by its name, where its arguments are good, and the inputs that it reads: itself, or what was called for what it is called on.
struct Function<'a, T> {
    name: String,
    good: Arguments,
    reads: Vec<Symbol>,
    call: Call<'a, T>,
}

/// How many values of inputs were tried, and what came of them.
#[derive(Debug, Default)]
struct Tally {
    refused: usize,
    untouched: usize,
}

/// The inputs that a program reads, but for sides, which are no numbers.
fn read_by(program: &Program) -> impl Iterator<Item = Symbol> {
    program.inputs().filter_map(|(_, input)| match input {
        Input::Symbol(
            symbol @ (Symbol::Parameter(_)
            | Symbol::Drive(_)
            | Symbol::Driven(_, Order::Rate | Order::Acceleration)
            | Symbol::Load(..)),
        ) => Some(symbol),
        _ => None,
    })
}

fn drives(linkage: &Linkage) -> impl Iterator<Item = Symbol> {
    (0..linkage.model.drives.len()).map(|drive| Symbol::Drive(DriveId::new(drive)))
}

/// All inputs that a program of the linkage reads, and all drives.
fn inputs(linkage: &Linkage) -> Vec<Symbol> {
    let functions = &linkage.functions;
    let scenes = functions.scenes.iter().flat_map(|scene| [&scene.direct, &scene.from_pose]);
    let programs = [&functions.prepare, &functions.pose].into_iter().chain(&functions.near).chain(scenes);
    let mut all: Vec<Symbol> = drives(linkage).collect();
    for symbol in programs.chain(&functions.accessors).flat_map(read_by) {
        if !all.contains(&symbol) {
            all.push(symbol);
        }
    }
    all
}

/// The functions of a linkage; of one that is driven for an inverse scene that scene alone is emitted.
fn functions<'a, T: Number + 'a>(linkage: &'a Linkage, is_inverse: bool) -> Vec<Function<'a, T>> {
    let given = given(linkage);
    // An inverse scene may have its answers further away, and only where nothing lies on its other side.
    let further = |drives: Vec<f64>| drives.into_iter().map(|drive| 2.0 * drive).collect();
    let at = if is_inverse { coordinates(linkage).map(further).collect() } else { poses(linkage) };
    let at: Vec<Arguments> = at.into_iter().map(|drives| Arguments { drives, ..given.clone() }).collect();
    let mut all = Vec::new();
    let (prepare, at_pose) = (&linkage.functions.prepare, &linkage.functions.pose);
    let mut add = |name: &str, programs: &[&Program], call: Call<'a, T>| {
        // What parameters alone determine is there before anything else is called.
        let mut reads: Vec<Symbol> = programs.iter().copied().chain([prepare]).flat_map(read_by).collect();
        if programs.iter().any(|program| core::ptr::eq(*program, at_pose)) {
            reads.extend(drives(linkage));
        }
        let good = at.iter().find(|arguments| call(arguments).is_ok());
        let good = good.unwrap_or_else(|| panic!("{name}: {:?}", call(&at[0]).err())).clone();
        all.push(Function { name: name.to_owned(), good, reads, call });
    };
    let in_order = move |kept: &NodeValues<T>| -> Vec<T> {
        linkage.plan.pose.iter().map(|part| kept[&part.node].clone()).collect()
    };
    add(
        "Linkage::new",
        &[],
        Box::new(|arguments| {
            let values = prepared::<T>(linkage, arguments)?;
            Ok(linkage.functions.prepared.iter().map(|node| values[node].clone()).collect())
        }),
    );
    for (scene, functions) in linkage.model.scenes.iter().zip(&linkage.functions.scenes) {
        let name = &scene.name.text;
        let call = |arguments: &Arguments| direct(linkage, &functions.direct, arguments);
        add(&format!("{name}_at"), &[&functions.direct], Box::new(call));
        if !is_inverse {
            let call = move |arguments: &Arguments| {
                let kept = checked_pose::<T>(linkage, arguments)?;
                from_pose(linkage, &functions.from_pose, &kept, arguments)
            };
            add(&format!("Pose::{name}"), &[at_pose, &functions.from_pose], Box::new(call));
        }
    }
    if is_inverse {
        return all;
    }
    let call = move |arguments: &Arguments| Ok(in_order(&checked_pose::<T>(linkage, arguments)?));
    add("Pose::at", &[at_pose], Box::new(call));
    for (accessor, program) in linkage.plan.accessors.iter().zip(&linkage.functions.accessors) {
        // Without checks, as it is emitted.
        let mut unchecked = program.clone();
        unchecked.steps.retain(|step| matches!(step, Step::Let(_)));
        let call = move |arguments: &Arguments| {
            let kept = checked_pose::<T>(linkage, arguments)?;
            from_pose(linkage, &unchecked, &kept, arguments)
        };
        add(&format!("Pose::{}", accessor.name), &[at_pose, program], Box::new(call));
    }
    if let Some(near) = &linkage.functions.near {
        let mut before = at[0].clone();
        before.drives[0] += 0.01;
        let from = pose::<T>(linkage, &before).expect("a pose");
        let call = move |arguments: &Arguments| Ok(in_order(&moved(linkage, (&from, &before), arguments)?));
        add("Pose::moved_to", &[near], Box::new(call));
    }
    all
}

fn try_all<T: Number>(name: &str, linkage: &Linkage, is_inverse: bool, tally: &mut Tally) {
    let inputs = inputs(linkage);
    for Function { name: function, good, reads, call } in functions::<T>(linkage, is_inverse) {
        let before = call(&good).expect("good arguments");
        assert!(before.iter().all(|value| value.to_f64().is_finite()), "{name}, {function}");
        for symbol in &inputs {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let after = call(&Arguments { instead: Some((*symbol, bad)), ..good.clone() });
                let context = format!("{name}, {function} with {symbol:?} = {bad}");
                assert_eq!(after.is_err(), reads.contains(symbol), "{context}: {:?}", after.err());
                let after = match after {
                    Ok(after) => after,
                    Err(fault) => {
                        // A length that is no number is not a positive one.
                        let is_told = match fault {
                            Fault::NotFinite => true,
                            Fault::Failed(Failure::Parameter { .. }) => matches!(symbol, Symbol::Parameter(_)),
                            Fault::Failed(_) => false,
                        };
                        assert!(is_told, "{context}: {fault:?}");
                        tally.refused += 1;
                        continue;
                    }
                };
                for (found, expected) in after.iter().zip(&before) {
                    let [found, expected] = [found, expected].map(T::to_f64);
                    assert_eq!(found.to_bits(), expected.to_bits(), "{context}: {found} instead of {expected}");
                }
                tally.untouched += 1;
            }
        }
    }
}

#[test]
fn nothing_that_is_not_finite_passes() {
    let mut tally = Tally::default();
    let mut inverses = 0;
    for (name, linkage) in linkages() {
        let all = core::iter::once((&linkage, false)).chain(linkage.inverses.iter().map(|inverse| (inverse, true)));
        for (linkage, is_inverse) in all {
            inverses += usize::from(is_inverse);
            match linkage.model.graph.scalar() {
                Scalar::F64 => try_all::<Double>(&name, linkage, is_inverse, &mut tally),
                Scalar::F32 => try_all::<Single>(&name, linkage, is_inverse, &mut tally),
            }
        }
    }
    assert!(tally.refused > 4000 && tally.untouched > 5000 && inverses >= 3, "{tally:?}, {inverses} inverse scenes");
}
