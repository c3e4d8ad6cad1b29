//! Every pass keeps the results of every program.

use std::collections::BTreeSet;

use crate::support::declarations::linkages;
use crate::support::families::{boom, four_bar};
use crate::support::linkages::{Kind, Random, Sample, sample, sample_with_search};
use crate::support::numbers::{Double, Extended, Single};
use crate::support::{Arguments, Number, compile, direct, from_pose, moved, pose};
use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Graph, Kernel, NodeId, Op, Symbol};
use linkage_codegen::plan::Output;
use linkage_codegen::program::passes::{PASSES, Pass};
use linkage_codegen::program::{Counts, Definition, Extract, Fault, Form, Input, Program, Run, Step, Value, ValueId};

fn results<T: Number>(linkage: &Linkage, program: &Program, arguments: &Arguments) -> Vec<T> {
    let kept = pose::<T>(linkage, arguments).expect("a pose");
    let run = Run { program, graph: &linkage.model.graph };
    run.with(&|input| match input {
        Input::Symbol(symbol) => T::exactly(arguments.of(symbol)),
        Input::Kept(node) => kept[&node].clone(),
        Input::Prepared(_) | Input::Known(_) => T::exactly(f64::NAN),
    })
    .expect("results")
}

/// What the linkages of most tests may have.
const KIND: Kind = Kind {
    dyads: 2,
    sliders: true,
    joints: true,
    unknown_anywhere: false,
    moving: false,
    params: false,
    scalar: "f64",
};

#[test]
fn passes_keep_the_results() {
    for seed in 0..40 {
        let kind = Kind { dyads: 1 + usize::try_from(seed % 3).unwrap(), joints: false, ..KIND };
        check_each_pass(&sample(seed, kind));
    }
}

/// Slides that are driven leave directions that are constants, rates products of these.
#[test]
fn passes_keep_the_results_of_motion() {
    for seed in 3000..3020 {
        let dyads = 1 + usize::try_from(seed % 4).unwrap();
        check_each_pass(&sample(seed, Kind { dyads, joints: seed % 2 == 1, moving: true, ..KIND }));
    }
}

#[test]
fn passes_keep_the_results_of_fused_arithmetic() {
    for seed in 0..20 {
        let mut sample = sample(seed, Kind { moving: seed % 2 == 0, ..KIND });
        sample.text = sample.text.replacen(';', "; arithmetic fused;", 1);
        check_each_pass(&sample);
    }
}

/// A pass may trade a quotient for products, and with fused arithmetic divide by what it multiplied by the reciprocal of; it never adds
/// quotients, roots or kernels.
fn check_each_pass(sample: &Sample) {
    let linkage = compile(&sample.text);
    let graph = &linkage.model.graph;
    for output in &linkage.plan.scenes {
        for form in [Form::Direct, Form::FromPose] {
            let mut program = unoptimised(output, graph, form);
            let exact = results::<Extended>(&linkage, &program, &sample.arguments);
            let size = exact.iter().fold(1.0f64, |m, x| m.max(x.to_f64().abs()));
            let mut before = program.counts();
            for (name, pass) in PASSES {
                program = pass(program, graph);
                assert_in_order(name, &program);
                let after = results::<Extended>(&linkage, &program, &sample.arguments);
                for ((path, _), (a, b)) in program.outputs.iter().zip(exact.iter().zip(&after)) {
                    let error = a.sub(b).to_f64().abs() / size;
                    assert!(error < 1e-50, "{name} changes {path} by {error:e}\n{}", sample.text);
                }
                let counts = program.counts();
                assert!(
                    counts.div <= before.div && counts.sqrt <= before.sqrt && counts.sin_cos <= before.sin_cos,
                    "{name}"
                );
                before = counts;
            }
            let double = results::<Double>(&linkage, &program, &sample.arguments);
            assert!(double.iter().all(|x| x.0.is_finite()));
        }
    }
}

/// Each step reads what stands before it. The interpreter would find it anywhere.
fn assert_in_order(name: &str, program: &Program) {
    let mut known: BTreeSet<ValueId> = program.inputs().map(|(value, _)| value).collect();
    let is_constant = |value: ValueId| matches!(program.op(value), Some(Op::Constant(_)));
    for step in &program.steps {
        // What is computed only to be reported is computed there.
        if let Step::Check { report, .. } = step {
            known.extend(report);
        }
        let late = program.operands_of(step).into_iter().find(|value| !known.contains(value) && !is_constant(*value));
        assert_eq!(late, None, "{name}: {step:?}");
        if let Step::Let(value) = step {
            known.insert(*value);
        }
    }
    assert!(program.outputs.iter().all(|(_, value)| known.contains(value) || is_constant(*value)), "{name}");
}

/// Without the check of the results: where loads and rates are as large as may be for that, and drives are anything at which no other check
/// fails, all results are finite. With a drive that is not, another check fails, or it is among what must be moderate.
#[test]
fn results_of_moderate_arguments_are_finite() {
    let (mut programs, mut poses) = (0, 0);
    for seed in 0..60 {
        let scalar = if seed % 3 == 0 { "f32" } else { "f64" };
        let sample = sample(seed, Kind { dyads: 1, moving: seed % 2 == 0, scalar, ..KIND });
        let linkage = compile(&sample.text);
        for program in linkage.functions.scenes.iter().map(|functions| &functions.direct) {
            let Some(unchecked) = without_check_of_results(program) else { continue };
            programs += 1;
            let run = |arguments: &Arguments| match scalar {
                "f32" => Ok(in_doubles(&direct::<Single>(&linkage, &unchecked, arguments)?)),
                _ => Ok(in_doubles(&direct::<Double>(&linkage, &unchecked, arguments)?)),
            };
            let mut random = Random(seed);
            for index in 0..200 {
                let arguments = largest_near(&sample, scalar, 10f64.powi(index % 8 - 4), &mut random);
                let results = run(&arguments);
                poses += usize::from(results.is_ok());
                let finite = |results: &Vec<f64>| results.iter().copied().all(f64::is_finite);
                assert!(results.as_ref().map_or(true, finite), "{results:?} {arguments:?}\n{}", sample.text);
            }
            for (value, input) in unchecked.inputs() {
                if let Input::Symbol(Symbol::Drive(drive)) = input
                    && !unchecked.moderate.contains(&value)
                {
                    for not in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
                        let mut arguments = sample.arguments.clone();
                        arguments.drives[drive.index()] = not;
                        let results = run(&arguments);
                        assert!(matches!(results, Err(Fault::NotFinite)), "{not} {results:?}\n{}", sample.text);
                    }
                }
            }
        }
    }
    assert!(programs > 60 && poses > 5000, "{programs} programs, {poses} poses");
}

/// The same from a pose, whose numbers are within what is known of them: next to a dead centre too, and where the pose follows from another.
#[test]
fn results_of_moderate_arguments_at_a_pose_are_finite() {
    let (mut programs, mut poses) = (0, 0);
    for seed in 0..36 {
        let scalar = if seed % 3 == 0 { "f32" } else { "f64" };
        let dyads = if seed % 2 == 0 { 1 } else { 2 };
        let kind = Kind { dyads, moving: seed % 5 == 0, params: seed % 7 == 3, scalar, ..KIND };
        let mut sample = if seed % 12 == 5 { sample_with_search(seed, kind) } else { sample(seed, kind) };
        if seed % 4 == 0 {
            sample.text = sample.text.replacen(';', "; arithmetic fused;", 1);
        }
        let linkage = compile(&sample.text);
        for from_pose in linkage.functions.scenes.iter().map(|functions| &functions.from_pose) {
            let unchecked = without_check_of_results(from_pose);
            let program = unchecked.as_ref().unwrap_or(from_pose);
            let with_results = match scalar {
                "f32" => at_poses::<Single>(&linkage, program, &sample, scalar),
                _ => at_poses::<Double>(&linkage, program, &sample, scalar),
            };
            if unchecked.is_some() {
                programs += 1;
                poses += with_results;
            }
        }
    }
    assert!(programs > 15 && poses > 3000, "{programs} programs, {poses} poses");
}

/// At how many poses of many a function has results, all finite, with the largest loads and rates.
fn at_poses<T: Number>(linkage: &Linkage, program: &Program, sample: &Sample, scalar: &str) -> usize {
    let mut random = Random(sample.text.len() as u64);
    let start = pose::<T>(linkage, &sample.arguments);
    let mut poses = 0;
    for index in 0..200 {
        let arguments = largest_near(sample, scalar, 10f64.powi(index % 16 - 12), &mut random);
        let reached = match &start {
            Ok(start) if linkage.functions.near.is_some() && index % 2 == 0 => {
                moved(linkage, (start, &sample.arguments), &arguments)
            }
            _ => pose::<T>(linkage, &arguments),
        };
        let Ok(kept) = reached else { continue };
        for (value, input) in program.inputs() {
            if let (Input::Kept(node), Some(within)) = (input, program.value(value).within) {
                let number = kept[&node].to_f64();
                assert!(within.allows(number), "{node:?} {number} {within:?}\n{}", sample.text);
            }
        }
        let Ok(results) = from_pose(linkage, program, &kept, &arguments) else { continue };
        let results = in_doubles(&results);
        assert!(results.iter().copied().all(f64::is_finite), "{results:?} {arguments:?}\n{}", sample.text);
        poses += 1;
    }
    poses
}

/// A function that looks at arguments in place of results, or at none, without its check of the results; nothing of another one.
fn without_check_of_results(program: &Program) -> Option<Program> {
    let mut unchecked = program.clone();
    unchecked.steps.retain(|step| !matches!(step, Step::FiniteResults(_)));
    let has_check = unchecked.steps.len() < program.steps.len();
    (!has_check || !program.moderate.is_empty()).then_some(unchecked)
}

/// Loads and rates as large as they may be to be moderate, of either sign, and drives so near those of a sample.
fn largest_near(sample: &Sample, scalar: &str, near: f64, random: &mut Random) -> Arguments {
    let largest = if scalar == "f32" { f64::from(2f32.powi(33).next_down()) } else { 2f64.powi(257).next_down() };
    let mut arguments = sample.arguments.clone();
    let mut sign = |x: &mut f64| *x = if random.chance(0.5) { largest } else { -largest };
    arguments.loads.iter_mut().flatten().for_each(&mut sign);
    arguments.motion.iter_mut().flatten().for_each(&mut sign);
    for drive in &mut arguments.drives {
        *drive += random.range(-1.0, 1.0) * near;
    }
    arguments
}

fn in_doubles<T: Number>(numbers: &[T]) -> Vec<f64> {
    numbers.iter().map(T::to_f64).collect()
}

/// A function that starts from a pose computes nothing that the pose holds: no trigonometry and no root.
#[test]
fn a_scene_from_a_pose_goes_on_where_the_pose_ends() {
    for seed in 0..40 {
        let sample = sample(seed, KIND);
        let linkage = compile(&sample.text);
        for (index, functions) in linkage.functions.scenes.iter().enumerate() {
            let counts = functions.from_pose.counts();
            // The length of a spring and its twist belong to the scene that it loads.
            // A body with a driven joint in it has its length from the drive.
            let lines = ["spring(", "torsion(", "thrust("].iter().any(|load| sample.text.contains(load));
            if lines || sample.arguments.drives.len() > 1 {
                continue;
            }
            assert_eq!((counts.sin_cos, counts.sqrt), (0, 0), "scene {index}\n{}", sample.text);
            let drives = functions
                .from_pose
                .inputs()
                .filter(|(_, input)| matches!(input, Input::Symbol(linkage_codegen::graph::Symbol::Drive(_))));
            // Only the angle of a driven link, or the travel of a driven slide, is the drive's own value.
            let named = drives.count();
            assert!(named <= 1, "{}", sample.text);
        }
    }
}

/// Where an arm is there for moments alone, its constants take their factor: that spares a product of each moment, and adds none anywhere.
#[test]
fn arms_take_the_factors_of_their_moments() {
    let mut spared = 0;
    for seed in 0..40 {
        let sample = sample(seed, Kind { dyads: 3, ..KIND });
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            for form in [Form::Direct, Form::FromPose] {
                let program = unoptimised(output, graph, form);
                let [before, after] = before_and_after("arms", program, graph).map(|program| program.counts());
                assert!(after.mul <= before.mul && after.add == before.add, "{before:?} {after:?}\n{}", sample.text);
                spared += before.mul - after.mul;
            }
        }
    }
    assert!(spared > 20, "{spared} products");
}

/// What is multiplied last makes no way to the results longer, many shorter, and spends about one product in a hundred on it.
#[test]
fn nothing_waits_longer_for_what_is_multiplied_last() {
    let (mut shorter, mut products) = (0, [0, 0]);
    for seed in 0..40 {
        let kind = Kind { dyads: 1 + usize::try_from(seed % 3).unwrap(), moving: seed % 2 == 0, ..KIND };
        let sample = sample(seed, kind);
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            for form in [Form::Direct, Form::FromPose] {
                let program = unoptimised(output, graph, form);
                let programs = before_and_after("late", program, graph);
                let ways = programs.each_ref().map(longest_way);
                assert!(ways[1] <= ways[0], "{ways:?}\n{}", sample.text);
                let count = programs.each_ref().map(|program| program.counts().mul);
                shorter += usize::from(ways[1] < ways[0]);
                products = [products[0] + count[0], products[1] + count[1]];
            }
        }
    }
    assert!(shorter > 40, "only {shorter} ways became shorter");
    assert!(100 * products[1] <= 102 * products[0], "{products:?} products");
}

/// The direction of a leg of driven length is divided, whatever else is: what is resolved along the leg and back has the square of its size.
#[test]
fn the_direction_of_a_driven_leg_is_divided() {
    let mut random = Random(5);
    for (scalar, offset) in [("f64", 0.25), ("f32", 0.25), ("f64", 1.0)] {
        let text = boom([1.5, 1.75, offset], &mut random).replacen(';', &format!("; scalar {scalar};"), 1);
        let linkage = compile(&text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes[..1] {
            for form in [Form::Direct, Form::FromPose] {
                let mut program = unoptimised(output, graph, form);
                for (_, pass) in PASSES {
                    program = pass(program, graph);
                }
                let divided = |step: &&Step| matches!(step, Step::Let(value) if program.value(*value).divided);
                let quotients: Vec<_> = program.steps.iter().filter(divided).collect();
                assert_eq!(quotients.len(), 2, "{text}");
                let is_quotient =
                    |step: &&Step| matches!(step, Step::Let(value) if matches!(program.op(*value), Some(Op::Div(..))));
                assert!(quotients.iter().all(is_quotient), "{text}");
            }
        }
    }
}

/// Common factors of the terms of a sum are a product less each, and make no way to the results longer.
#[test]
fn common_factors_are_multiplied_once() {
    let (mut saved, mut named) = (0, 0);
    for seed in 0..40 {
        let kind =
            Kind { dyads: 1 + usize::try_from(seed % 3).unwrap(), sliders: seed % 2 == 0, joints: false, ..KIND };
        let sample = sample(seed, kind);
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            // Of virtual work the efforts alone, whose rates nothing else reads.
            let mut results = output.leaves();
            results.retain(|(path, _)| linkage.model.unknowns.iter().any(|unknown| unknown.name == *path));
            for form in [Form::Direct, Form::FromPose] {
                let program = Extract { graph, form }.program(&results, &[]);
                let programs = before_and_after("common factors", program, graph);
                let [before, after] = programs.each_ref().map(|program| (longest_way(program), program.counts()));
                assert!(after.0 <= before.0, "{before:?} {after:?}\n{}", sample.text);
                assert!(after.1.mul <= before.1.mul && after.1.div <= before.1.div, "{}", sample.text);
                saved += before.1.mul - after.1.mul;
                let is_common = |value: &&Value| value.label.as_ref().is_some_and(|label| label.name == "common");
                named += programs[1].values.iter().filter(is_common).count();
            }
        }
    }
    assert!(saved > 40 && named > 10, "{saved} products saved, {named} named");
}

/// Values that are found in multiples spare products in most functions, add none, and leave all else; no constant of a sum or of a quotient that was
/// exact becomes one that is not.
#[test]
fn multiples_spare_products_alone() {
    let (mut spared, mut functions, mut exact) = (0, [0, 0], 0);
    for seed in 0..60 {
        let scalar = ["f64", "f32"][usize::from(seed % 3 == 2)];
        let kind = Kind { dyads: 1 + usize::try_from(seed % 3).unwrap(), moving: seed % 2 == 0, scalar, ..KIND };
        let sample = sample(seed, kind);
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            for form in [Form::Direct, Form::FromPose] {
                let program = unoptimised(output, graph, form);
                let programs = before_and_after("multiples", program, graph);
                let [before, after] = programs.each_ref().map(Program::counts);
                let less = before.mul - after.mul;
                // What becomes the negative of its factor is no product.
                assert!(after.sign <= before.sign + less, "{before:?} {after:?}\n{}", sample.text);
                assert_eq!(Counts { mul: before.mul, sign: before.sign, ..after }, before, "{}", sample.text);
                spared += less;
                functions[usize::from(less > 0)] += 1;
                let [before, after] = programs.each_ref().map(|program| exact_constants(program, graph));
                assert!(after >= before, "{before} {after}\n{}", sample.text);
                exact += before;
            }
        }
    }
    assert!(spared > 500 && functions[1] > functions[0] && exact > 100, "{spared} {functions:?} {exact}");
}

/// How many constants of sums and dividends the scalar has as they are.
fn exact_constants(program: &Program, graph: &Graph) -> usize {
    let computed = program.steps.iter().filter_map(|step| match step {
        Step::Let(value) => program.op(*value),
        _ => None,
    });
    let beside = computed.flat_map(|op| match op {
        Op::Add(a, b) | Op::Sub(a, b) => vec![*a, *b],
        Op::Div(a, _) => vec![*a],
        _ => vec![],
    });
    let exact = |number: linkage_codegen::graph::number::Number| {
        let nearest = linkage_codegen::graph::number::Number::from_f64(number.nearest(graph.scalar()));
        nearest.is_some_and(|nearest| nearest.sub(&number).is_zero())
    };
    beside.filter(|value| program.constant(graph, *value).is_some_and(exact)).count()
}

/// The cosine of twice an angle is the difference of its squares where both are there: a sum and a product less, and nothing waits longer.
/// Elsewhere, and where rounding errors are counted, it stays a product.
#[test]
fn squares_that_are_there_are_subtracted() {
    let (mut random, mut spared) = (Random(43), [0, 0]);
    for _ in 0..40 {
        let lengths = [random.range(1.8, 2.2), random.range(0.5, 1.0), random.range(1.5, 2.5), random.range(1.5, 2.5)];
        // The crank is turned from the ground, or the ground from the crank.
        let pin = random.pick(&["revolute A0: ground -> crank", "revolute A0: crank -> ground"]);
        let linkage = compile(&four_bar(lengths, &mut random).replace("revolute A0: ground -> crank", pin));
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            for form in [Form::Direct, Form::FromPose] {
                let program = unoptimised(output, graph, form);
                let programs = before_and_after("squares", program, graph);
                let squares = programs.each_ref().map(squares_of_sines);
                let ways = programs.each_ref().map(longest_way);
                let [before, after] = programs.each_ref().map(Program::counts);
                let is_spared = usize::from(squares[0] == 2);
                let expected = Counts { add: before.add - is_spared, mul: before.mul - is_spared, ..before };
                assert_eq!((after, squares[1]), (expected, squares[0]));
                assert!(ways[1] <= ways[0], "{ways:?}");
                spared[is_spared] += 1;
                let [before, after] = programs;
                if is_spared == 1 {
                    assert_in_order("squares", &after);
                    assert_only_so(&before, graph);
                }
            }
        }
    }
    assert!(spared[0] > 40 && spared[1] > 20, "{spared:?}");
}

/// A program of which the squares are subtracted stays as it is if rounding errors are counted, if something else reads a factor of the
/// product, if its sum is not that of cosine and sine, or if these are of two angles.
fn assert_only_so(program: &Program, graph: &Graph) {
    let ops = || program.computed().filter_map(|value| Some((value, program.op(value)?.clone())));
    let product = ops().find_map(|(value, op)| match op {
        Op::Mul(a, b) => match (program.op(a)?, program.op(b)?) {
            (Op::Sub(c, s), Op::Add(first, second)) if [first, second] == [c, s] => Some((value, a, b, *c, *s)),
            _ => None,
        },
        _ => None,
    });
    let (product, difference, sum, cosine, sine) = product.expect("a product");
    let altered = |value: ValueId, op: Op<ValueId>| {
        let mut altered = program.clone();
        altered.values[value.index()].definition = Definition::Computed(op);
        altered
    };
    let mut read = program.clone();
    read.outputs.push(("factor".to_owned(), difference));
    let Some(Op::Kernel { kernel, part: 1, .. }) = program.op(cosine) else { panic!("{:?}", program.op(cosine)) };
    let other_angle = Op::Kernel { kernel: *kernel, args: vec![sine_of(program, sine)], part: 1 };
    let others = [
        Program { counts_rounding: true, ..program.clone() },
        read,
        altered(sum, Op::Add(cosine, cosine)),
        altered(cosine, other_angle),
    ];
    assert!(matches!(pass("squares")(program.clone(), graph).op(product), Some(Op::Sub(..))));
    for other in others {
        let after = pass("squares")(other, graph);
        assert!(matches!(after.op(product), Some(Op::Mul(..))), "{after:?}");
    }
}

/// The sine itself, if a value is the negative of one.
fn sine_of(program: &Program, value: ValueId) -> ValueId {
    if let Some(Op::Neg(positive)) = program.op(value) { *positive } else { value }
}

/// How many sines, negatives of sines and cosines are squared.
fn squares_of_sines(program: &Program) -> usize {
    let is_sine = |value| {
        let sine = program.op(sine_of(program, value));
        matches!(sine, Some(Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_), .. }))
    };
    let is_square = |value: &ValueId| matches!(program.op(*value), Some(Op::Mul(x, y)) if x == y && is_sine(*x));
    program.computed().filter(is_square).count()
}

/// Nothing is computed twice, but under two names that are lines of the derivation; and no bit of a result changes.
#[test]
fn what_is_repeated_is_computed_once() {
    let mut saved = 0;
    for seed in 0..60 {
        let kind = Kind { dyads: 1 + usize::try_from(seed % 3).unwrap(), moving: seed % 2 == 0, ..KIND };
        let sample = sample(seed, kind);
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            for form in [Form::Direct, Form::FromPose] {
                let programs = before_and_after("repeated", unoptimised(output, graph, form), graph);
                let [before, after] =
                    programs.each_ref().map(|program| results::<Double>(&linkage, program, &sample.arguments));
                let bits = |results: Vec<Double>| results.iter().map(|x| x.0.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(before), bits(after), "{}", sample.text);
                let [before, after] = programs.each_ref().map(repeated);
                assert_eq!(after, 0, "{}", sample.text);
                saved += before;
            }
        }
    }
    assert!(saved > 20, "{saved}");
}

/// How many values a program computes of which there is one already, but for those of which both have names.
fn repeated(program: &Program) -> usize {
    let mut there: Vec<(Op<ValueId>, bool)> = Vec::new();
    let mut count = 0;
    for step in &program.steps {
        let Step::Let(value) = step else { continue };
        let op = match program.op(*value).expect("computed") {
            Op::Add(a, b) => Op::Add(*a.min(b), *a.max(b)),
            Op::Mul(a, b) => Op::Mul(*a.min(b), *a.max(b)),
            op => op.clone(),
        };
        let named = program.value(*value).label.is_some();
        count += usize::from(there.iter().any(|(other, other_named)| *other == op && !(named && *other_named)));
        there.push((op, named));
    }
    count
}

/// Of two products the one that a fused sum adds is not known before the one that is rounded.
#[test]
fn the_product_that_is_known_last_is_fused() {
    let mut sums = 0;
    for seed in 0..20 {
        let linkage = compile(&sample(seed, KIND).text.replacen(';', "; arithmetic fused;", 1));
        for program in linkage.functions.scenes.iter().flat_map(|scene| [&scene.direct, &scene.from_pose]) {
            let known = known(program);
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                let Some(Op::Kernel { kernel: Kernel::MulAdd, args, .. }) = program.op(*value) else { continue };
                let [x, y, sum] = args[..] else { panic!("{args:?}") };
                let rounded = match program.op(sum) {
                    Some(Op::Neg(product)) => *product,
                    _ => sum,
                };
                let is_product = matches!(program.op(rounded), Some(Op::Mul(..)));
                if is_product && program.values[rounded.index()].label.is_none() {
                    let added = 4 + known[x.index()].max(known[y.index()]);
                    assert!(known[rounded.index()] <= added, "{program:?}");
                    sums += 1;
                }
            }
        }
    }
    assert!(sums > 300, "{sums}");
}

/// Fused, a product by a reciprocal is a quotient if its other factor is known first, and no sum waits for the product of a named multiple.
#[test]
fn fused_sums_and_quotients_wait_for_nothing_in_vain() {
    let mut random = Random(41);
    let (mut reciprocals, mut names) = ([0, 0], 0);
    for _ in 0..40 {
        let lengths = [random.range(1.8, 2.2), random.range(0.5, 1.0), random.range(1.5, 2.5), random.range(1.5, 2.5)];
        let text = four_bar(lengths, &mut random).replacen(';', "; arithmetic fused;", 1);
        // On the rocker's line: the moment of the force there is a multiple of that of the rocker's vector.
        let (before, point) = text.split_once("D: (").expect("a point on the rocker");
        let (_, after) = point.split_once(')').expect("its place");
        let linkage = compile(&format!("{before}D: (0.3m, 0){after}"));
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            let programs = before_and_after("fused", unoptimised(output, graph, Form::Direct), graph);
            let [before, after] = &programs;
            let (known, uses) = (known(before), before.uses());
            let named = |program: &Program, value: ValueId| program.value(value).label.is_some();
            for step in &before.steps {
                let Step::Let(value) = step else { continue };
                if let Some(Op::Mul(x, reciprocal)) = before.op(*value)
                    && before.quotient(graph, *reciprocal).is_some_and(|(one, _)| one.is_one())
                    && uses[reciprocal.index()] == 1
                {
                    let is_quotient = matches!(after.op(*value), Some(Op::Div(..)));
                    assert_eq!(is_quotient, known[x.index()] < known[reciprocal.index()], "{before:?}");
                    reciprocals[usize::from(is_quotient)] += 1;
                }
                // What the sum waited for was named; what is multiplied there is now.
                if let Some(([other, multiple], _)) = before.op(*value).and_then(Op::terms)
                    && let Some((_, x)) = before.multiple(graph, multiple)
                    && named(before, multiple)
                    && uses[multiple.index()] == 1
                    && before.is_inner(x, &uses)
                {
                    assert_eq!(named(after, x), known[multiple.index()] > known[other.index()]);
                    names += usize::from(named(after, x));
                }
            }
        }
    }
    assert!(reciprocals[0] > 30 && names > 10, "{reciprocals:?}, {names} names");
}

/// In cycles.
fn longest_way(program: &Program) -> usize {
    let known = known(program);
    program.outputs.iter().map(|(_, value)| known[value.index()]).max().unwrap_or(0)
}

/// When each value is known: a sum or a product takes four cycles, a change of sign and a side none.
fn known(program: &Program) -> Vec<usize> {
    let mut known = vec![0; program.values.len()];
    for step in &program.steps {
        let Step::Let(value) = step else { continue };
        let Some(op) = program.op(*value) else { continue };
        let is_side = |value: &ValueId| {
            matches!(program.value(*value).definition, Definition::Input(Input::Symbol(Symbol::Side(_))))
        };
        let takes = match op {
            Op::Neg(_) | Op::Abs(_) => 0,
            Op::Mul(side, _) if is_side(side) => 0,
            Op::Div(..) => 14,
            Op::Sqrt(_) => 18,
            Op::Kernel { kernel, .. } if *kernel != Kernel::MulAdd => 60,
            _ => 4,
        };
        known[value.index()] = takes + op.operands().iter().map(|operand| known[operand.index()]).max().unwrap_or(0);
    }
    known
}

/// No `a ± (−b − c)` is left, which is `a ∓ (b + c)`.
#[test]
fn no_sum_of_two_negatives_is_added_or_subtracted() {
    let mut sums = 0;
    for seed in 0..40 {
        let linkage = compile(&sample(seed, KIND).text);
        for program in linkage.functions.scenes.iter().flat_map(|scene| [&scene.direct, &scene.from_pose]) {
            let uses = program.uses();
            let of_negatives = |sum: &ValueId| match program.op(*sum) {
                Some(Op::Sub(b, _)) => {
                    [sum, b].into_iter().all(|value| program.is_inner(*value, &uses))
                        && matches!(program.op(*b), Some(Op::Neg(_)))
                }
                _ => false,
            };
            for step in &program.steps {
                let Step::Let(value) = step else { continue };
                let Some(([a, b], minus)) = program.op(*value).and_then(Op::terms) else { continue };
                assert!(!of_negatives(&b) && (minus || !of_negatives(&a)), "{program:?}");
                sums += 1;
            }
        }
    }
    assert!(sums > 1000, "{sums}");
}

/// Constants of a quotient are brought together: none is left in its divisor where there is one in the dividend.
#[test]
fn no_quotient_has_constants_above_and_below() {
    const SLIDER_CRANK: &str =
        "mod crank; units { mm, N } ground { O: (0, 0) } link crank { O -> A: 45mm } link rod { A -> B: 150mm } link piston { B }
        revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston;
        prismatic P: ground.O -> piston.B along 0deg;
        drive theta: O; unknown T: torque(ground -> crank); assemble B: ahead(A);
        load gas: force(piston.B); scene statics: equilibrium;";
    let quotients = |text: &str| {
        let linkage = compile(text);
        let graph = &linkage.model.graph;
        linkage.plan.scenes.iter().fold([0, 0], |[before, after], output| {
            // Without the pass that takes such constants away before.
            let programs =
                before_and_after_others("constants", &["lengths"], unoptimised(output, graph, Form::Direct), graph);
            let [b, a] = programs.map(|program| quotients_of_multiples(&program, graph));
            [before + b, after + a]
        })
    };
    assert_eq!(quotients(SLIDER_CRANK), [1, 0]);
    for seed in 0..40 {
        let [_, after] = quotients(&sample(seed, KIND).text);
        assert_eq!(after, 0);
    }
}

fn quotients_of_multiples(program: &Program, graph: &Graph) -> usize {
    let uses = program.uses();
    let factors = |value: ValueId| match program.op(value) {
        Some(Op::Mul(a, b)) if uses[value.index()] == 1 => vec![*a, *b],
        _ => vec![],
    };
    let is_constant = |value: &ValueId| program.constant(graph, *value).is_some();
    let is_multiple = |value: ValueId| factors(value).iter().any(is_constant);
    let quotients = program.steps.iter().filter_map(|step| match step {
        Step::Let(value) => program.op(*value),
        _ => None,
    });
    let both = quotients.filter(|op| match op {
        Op::Div(a, b) if is_multiple(*b) => {
            let inner = if program.is_inner(*a, &uses) { factors(*a) } else { vec![] };
            is_constant(a) || is_multiple(*a) || inner.into_iter().any(is_multiple)
        }
        _ => false,
    });
    both.count()
}

/// A result that is not finite is found out by the checks that are left, whatever comes in.
#[test]
fn fewer_checks_find_the_same() {
    let (mut refused, mut checks) = (0, [0, 0]);
    for seed in 0..26 {
        // With rates, and with groups that are placed by iteration, too; how many checks are left is counted without.
        let (moving, searches) = (seed >= 20, seed % 4 == 3);
        let kind = Kind { moving, ..KIND };
        let sample = if searches { sample_with_search(seed, kind) } else { sample(seed, kind) };
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            let program = unoptimised(output, graph, Form::Direct);
            let [before, after] = before_and_after("finite", program, graph);
            for (count, program) in checks.iter_mut().zip([&before, &after]).filter(|_| !moving && !searches) {
                *count += program.steps.iter().map(checked).sum::<usize>();
            }
            for value in [f64::INFINITY, f64::NAN, 1.7e308, -1.7e308, 1e200] {
                let loads = 2 * sample.arguments.loads.len();
                for at in 0..loads + 2 * sample.arguments.motion.len() {
                    let mut arguments = sample.arguments.clone();
                    match at.checked_sub(loads) {
                        None => arguments.loads[at / 2][at % 2] = value,
                        Some(at) => arguments.motion[at / 2][at % 2] = value,
                    }
                    let [with_all, with_fewer] = [&before, &after].map(|program| bits(program, graph, &arguments));
                    refused += usize::from(with_all.is_err());
                    assert_eq!(with_all, with_fewer, "argument {at} = {value}\n{}", sample.text);
                }
            }
        }
    }
    assert!(refused > 100, "{refused} refused");
    assert!(3 * checks[1] < 2 * checks[0], "{checks:?}");
}

/// Where a loop cannot be closed the same is said as by two checks, and everywhere else the results have the same bits.
#[test]
fn the_weaker_of_two_checks_tells_why() {
    let (mut refused, mut checks, mut limited) = (0, [0, 0], [0, 0]);
    for seed in 0..40 {
        let sample = sample(seed, KIND);
        let linkage = compile(&sample.text);
        let graph = &linkage.model.graph;
        for output in &linkage.plan.scenes {
            let both = before_and_after("checks", unoptimised(output, graph, Form::Direct), graph);
            for ((program, checks), limited) in both.iter().zip(&mut checks).zip(&mut limited) {
                *checks += program.steps.iter().filter(|step| matches!(step, Step::Check { .. })).count();
                let reads_limited = |step: &Step| {
                    let operands = program.operands_of(step);
                    operands.iter().any(|value| matches!(program.op(*value), Some(Op::NonNegative(_))))
                };
                *limited += program.steps.iter().filter(|step| reads_limited(step)).count();
            }
            for step in 0..24 {
                let mut arguments = sample.arguments.clone();
                arguments.drives.iter_mut().for_each(|drive| *drive += 0.27 * f64::from(step));
                let [before, after] = both.each_ref().map(|program| bits(program, graph, &arguments));
                refused += usize::from(before.is_err());
                assert_eq!(before, after, "{:?}\n{}", arguments.drives, sample.text);
            }
        }
    }
    assert!(refused > 100, "{refused} refused");
    assert!(checks[1] < checks[0] && limited[1] < limited[0], "{checks:?}, {limited:?}");
}

/// The results of a program that starts from the drives, bit for bit.
fn bits(program: &Program, graph: &Graph, arguments: &Arguments) -> Result<Vec<u64>, Fault> {
    let results = Run { program, graph }.with(&|input| match input {
        Input::Symbol(symbol) => Double(arguments.of(symbol)),
        Input::Kept(_) | Input::Prepared(_) | Input::Known(_) => Double(f64::NAN),
    });
    results.map(|values| values.iter().map(|x| x.0.to_bits()).collect())
}

/// A program before and after a pass, behind all passes that come before it.
fn before_and_after(name: &str, program: Program, graph: &Graph) -> [Program; 2] {
    before_and_after_others(name, &[], program, graph)
}

/// The same, some of those that come before it left out.
fn before_and_after_others(name: &str, without: &[&str], program: Program, graph: &Graph) -> [Program; 2] {
    let index = place(name);
    let others = PASSES[..index].iter().filter(|(pass, _)| !without.contains(pass));
    let before = others.fold(program, |program, (_, pass)| pass(program, graph));
    let after = pass(name)(before.clone(), graph);
    [before, after]
}

fn pass(name: &str) -> Pass {
    PASSES[place(name)].1
}

fn place(name: &str) -> usize {
    PASSES.iter().position(|(pass, _)| *pass == name).expect("the pass")
}

/// All of a scene's results, which are to be finite.
fn unoptimised(output: &Output, graph: &Graph, form: Form) -> Program {
    let results = output.leaves();
    let finite: Vec<NodeId> = results.iter().map(|(_, node)| *node).collect();
    Extract { graph, form }.program(&results, &finite)
}

fn checked(step: &Step) -> usize {
    if let Step::FiniteResults(checked) = step { checked.len() } else { 0 }
}

/// Where a direction is no result, and its link's vector serves, nothing is spent on its size: sums and products less, and never one more. A
/// pose keeps its directions, and legs of several links have theirs brought to unit size for what these pass on.
#[test]
fn directions_that_are_no_results_keep_the_lengths_of_their_links() {
    let mut spared = [0, 0];
    for seed in 0..60 {
        let text = sample(seed, Kind { dyads: 3, ..KIND }).text;
        let linkage = compile(&text);
        let graph = &linkage.model.graph;
        let spends = |program: &Program| {
            let counts = program.counts();
            [counts.add, counts.mul]
        };
        for output in &linkage.plan.scenes {
            let [before, after] = before_and_after("lengths", unoptimised(output, graph, Form::Direct), graph)
                .map(|program| spends(&program));
            for (spared, (before, after)) in spared.iter_mut().zip(before.into_iter().zip(after)) {
                assert!(after <= before, "{before} {after}\n{text}");
                *spared += before - after;
            }
        }
        let kept: Vec<(String, NodeId)> = linkage.plan.pose.iter().map(|kept| (kept.name.clone(), kept.node)).collect();
        let pose = Extract { graph, form: Form::Direct }.program(&kept, &[]);
        let [before, after] = before_and_after("lengths", pose, graph).map(|program| spends(&program));
        assert_eq!(before, after, "{text}");
    }
    assert!(spared[0] > 100 && spared[1] > 300, "{spared:?}");
}

/// Coefficients of a force that velocities would have too stand under forces where no velocity is asked for: no heading stands above values
/// without names alone, of which others read some.
#[test]
fn no_heading_stands_above_what_has_no_name() {
    for (name, linkage) in linkages() {
        for (scene, functions) in linkage.model.scenes.iter().zip(&linkage.functions.scenes) {
            for program in [&functions.from_pose, &functions.direct] {
                let readers = program.readers();
                let values = || program.computed().map(|value| (value, program.value(value)));
                let is_result = |value: ValueId| program.outputs.iter().any(|(_, result)| *result == value);
                let named = values().filter(|(value, of)| of.label.is_some() || is_result(*value));
                let named: BTreeSet<&str> = named.map(|(_, of)| of.section.as_str()).collect();
                for (_, Value { section, .. }) in values().filter(|(value, _)| !readers[value.index()].is_empty()) {
                    assert!(named.contains(section.as_str()), "{name}, {}: {section}", scene.name);
                }
            }
        }
    }
}
