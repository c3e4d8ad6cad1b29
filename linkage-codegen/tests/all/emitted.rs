//! Emitted and compiled code against the interpreter: the same bits on every example, from every function, or errors of the same kind; of some
//! with NaN, infinity and the largest numbers in each argument, too.

use std::fmt::Debug;

use crate::support::examples::declaration;
use crate::support::measures::values_from_kept;
use crate::support::numbers::Double;
use crate::support::{Arguments, Told, checked_pose, checked_prepared, direct, moved, pose, told, told_as_printed};
use linkage_codegen::Linkage;
use linkage_runtime::{Error, Side, Vector2, polar};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

#[path = "../../../examples/four_bar.rs"]
#[allow(dead_code, unused_imports, missing_docs, reason = "only its declaration is used here")]
mod four_bar_example;
#[path = "../../../examples/six_bar.rs"]
#[allow(dead_code, unused_imports, missing_docs, reason = "only its declaration is used here")]
mod six_bar_example;
#[path = "../../../examples/slider_crank.rs"]
#[allow(dead_code, unused_imports, missing_docs, reason = "only its declaration is used here")]
mod slider_crank_example;
#[path = "../../../examples/stephenson.rs"]
#[allow(dead_code, unused_imports, missing_docs, reason = "only its declaration is used here")]
mod stephenson_example;
#[path = "../../../examples/three_loads.rs"]
#[allow(dead_code, unused_imports, missing_docs, reason = "only its declaration is used here")]
mod three_loads_example;

use four_bar_example::four_bar;
use six_bar_example::six_bar;
use slider_crank_example::engine;
use stephenson_example::stephenson;
use three_loads_example::three_loads;

/// A declaration as a module, and as text.
macro_rules! declared {
    ($text:ident: $($tokens:tt)*) => {
        linkage_runtime::linkage! { $($tokens)* }
        const $text: &str = stringify!($($tokens)*);
    };
}

declared! { CRUSHER:
    mod crusher;
    units { mm, N }
    param rod_mass: mass;
    ground { O: (0, 0), Q: (140mm, 20mm) } link crank { O -> A: 40mm } link rod { A -> B: 130mm, C: (60mm, 15mm) }
    link jaw { Q -> B: 110mm, T: (160mm, -10mm) } link ram { P: (0, 0) }
    mass crank: 1.1kg at (5mm, 0), inertia 900kg*mm^2; mass rod: rod_mass at C, inertia 1900kg*mm^2;
    mass jaw: 2kg at (60mm, 5mm), inertia 4000kg*mm^2; mass jaw: 0.5kg at T; mass ram: 3kg at (10mm, 2mm);
    revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> jaw; revolute Q: ground -> jaw;
    prismatic S: jaw.B -> ram.P along 70deg of jaw;
    drive theta: O; drive x: S { rate: 80mm/s, acceleration: -2m/s^2 };
    assemble B: left(A -> Q);
    load I: inertia; load Ij: inertia(jaw); load W: gravity = 9.81m/s^2 @ -90deg;
    load K: spring(ground.O, rod.C) { rate: 2N/mm, free: 60mm, damping: _ };
    load D: torsion(ground -> jaw) { rate: 3N*m/rad, free: 100deg, damping: 0.2N*m*s };
    scene held: equilibrium; scene parts: superposition(I, K); scene work: virtual_work(Ij, D, W);
    scene speeds: velocity; scene accelerations: acceleration;
    scene more: acceleration -> (B along jaw, jaw.T along path, S, inertia(ram), offset(jaw), offset(rod));
    scene control: motion(I, W, K) -> (M, h, rounding, M_kinetic); scene light: motion(Ij) -> (M);
    scene gains: coefficients;
    scene slopes: derivative(held) by (theta, x, theta.rate, theta.acceleration, K, rod_mass);
    scene curves: derivative(more) by (theta, x, theta.rate);
}

declared! { FUSED:
    mod fused;
    units { mm, N } arithmetic fused;
    ground { A0: (0, 0), B0: (140mm, 10mm) } link crank { A0 -> A: 50mm }
    link coupler { A -> B: 100mm, C: (60mm, 35mm) } link rocker { B0 -> B: 120mm }
    link rod { B -> D: 200mm } link block { D: (0, 0) }
    mass coupler: 0.9kg at (65mm, 12mm); mass rocker: 0.8kg at (60mm, -10mm);
    revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
    revolute B2: rocker.B -> rod.B; revolute D: rod -> block; prismatic S: ground.B0 -> block.D along 10deg;
    drive theta: A0; assemble B: left(A -> B0); assemble D: ahead(B2);
    load F: force(coupler.C); load W: gravity = 9.81m/s^2 @ -90deg;
    scene held: equilibrium; scene parts: superposition; scene work: virtual_work; scene places: position;
}

declared! { ROCKER:
    mod rocker;
    units { mm, N }
    param reach: length;
    ground { A0: (0, 0), B0: (140mm, 0) } link crank { A0 -> A: 40mm } link coupler { A -> B: 120mm }
    link rocker { B0 -> B: reach } link guide { P: (0, 0), E: (0, 15mm) } link rod { B -> E: 200mm }
    revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
    revolute B2: rocker.B -> rod.B; revolute E: rod -> guide; prismatic S: ground.B0 -> guide.P along 10deg, angle 10deg;
    drive theta: A0; assemble B: left(A -> B0); assemble E: ahead(B2); assemble A: either(A0 -> B); assemble B2: right(E -> B0);
    scene places: position; scene crank_of: inverse(S);
}

declared! { RAIL:
    mod rail;
    ground { A0: (0, 0), S: (1.5m, -0.2m) } link crank { A0 -> A: 0.5m } link left { A -> B: 1m, C: (0.4m, 0.1m) }
    link right { D -> B: 1.1m } link slide { S: (0, 0), D: (0, 0.1m) }
    mass crank: 1.3kg at (0.2m, 0), inertia 0.02kg*m^2; mass left: 0.9kg at C, inertia 0.07kg*m^2; mass slide: 2.1kg at D;
    revolute A0: ground -> crank; revolute A: crank -> left; revolute B: left -> right; revolute D: slide -> right;
    prismatic S: ground -> slide along 30deg;
    drive theta: A0; drive travel: S; unknown T: torque(crank -> left); unknown P: force(left.C) along 80deg;
    assemble B: left(A -> D); load W: gravity = 9.81m/s^2 @ -90deg;
    scene control: motion -> (M, h, rounding, M_kinetic);
}

declared! { BOUNDED:
    mod bounded;
    units { mm, N }
    ground { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm) } link crank { O -> A: 100mm } link b { A -> E: 195mm }
    link t { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm), G: (30mm, 30mm) } link c { Q -> C: 192mm, S: (90mm, 10mm) }
    link d { P -> D: 180mm }
    mass t: 3kg at G, inertia 2000kg*mm^2;
    revolute O: ground -> crank; revolute A: crank -> b; revolute E: t -> b; revolute C: t -> c; revolute D: d -> t;
    revolute Q: ground -> c; revolute P: ground -> d; drive q: O; unknown T: torque(ground -> crank);
    start q: 0.4rad; start b: (100mm, 40mm), angle 36deg; start t: (250mm, 150mm), angle 0; start c: (500mm, 100mm), angle 140deg;
    start d: (400mm, -100mm), angle 115deg; load F: force(c.S); load I: inertia;
    scene held: equilibrium(F) -> (T, C, error_bound); scene speeds: velocity -> (t.G, d.angle, error_bound);
    scene carried: equilibrium(I) -> (T, error_bound);
}

/// Dyads of a coupler and a rocker, each behind the rocker before, and weights.
macro_rules! chain {
    ($text:ident: $name:ident: $($driver:ident $pin:ident $coupler:ident $middle:ident $rocker:ident $ground:ident $x:tt $next:ident,)*) => {
        declared! { $text:
            mod $name;
            units { mm, N }
            ground { O: (0, 0) $(, $ground: ($x, 3mm))* }
            link crank { O -> A: 50mm }
            $(
                link $coupler { $pin -> $middle: 140mm }
                link $rocker { $ground -> $middle: 100mm, $next: (50mm, 20mm) }
                mass $coupler: 0.9kg at (65mm, 12mm);
                mass $rocker: 0.8kg at (60mm, -10mm);
            )*
            revolute O: ground -> crank;
            $(
                revolute $pin: $driver -> $coupler;
                revolute $middle: $coupler -> $rocker;
                revolute $ground: ground -> $rocker;
                assemble $middle: left($pin -> $ground);
            )*
            drive q: O;
            load W: gravity = 9.81m/s^2 @ -90deg;
            scene parts: superposition;
        }
    };
}

chain! { LONG: long:
    crank A b C c P 150mm D,
    c D e F f Q 300mm G,
    f G h I i R 450mm J,
    i J k L l S 600mm M,
    l M n U u T 750mm V,
    u V w X x Y 900mm Z,
    x Z bb CC cc PP 1050mm DD,
    cc DD ee FF ff QQ 1200mm GG,
    ff GG hh II ii RR 1350mm JJ,
    ii JJ kk LL ll SS 1500mm MM,
    ll MM nn UU uu TT 1650mm VV,
}

/// What an emitted function gave.
fn given<T: Debug>(result: &Result<T, Error>) -> Told {
    told_as_printed::<Double>(&format!("{result:?}"))
}

/// The same by the interpreter, from the drives and from a pose.
struct Interpreted {
    linkage: Linkage,
}

impl Interpreted {
    fn of(example: &str) -> Self {
        let linkage = linkage_codegen::analyse(declaration(example));
        Self { linkage: linkage.unwrap_or_else(|refusal| panic!("{:?}", refusal.errors)) }
    }

    fn of_text(text: &str) -> Self {
        let linkage = linkage_codegen::analyse(text.parse().expect("tokens"));
        Self { linkage: linkage.unwrap_or_else(|refusal| panic!("{:?}", refusal.errors)) }
    }

    fn check<A: Debug, B: Debug>(
        &self,
        scene: &str,
        arguments: &Arguments,
        straight: &Result<A, Error>,
        from_pose: &Result<B, Error>,
    ) {
        let index = self.linkage.model.scenes.iter().position(|s| s.name.text == scene).expect("a scene of this name");
        let functions = &self.linkage.functions.scenes[index];
        let expected = told(direct::<Double>(&self.linkage, &functions.direct, arguments));
        assert_eq!(given(straight), expected, "{scene}_at at {arguments:?}");
        let kept = checked_pose::<Double>(&self.linkage, arguments);
        let expected = kept.and_then(|kept| values_from_kept(&self.linkage, scene, &kept, arguments).map(|all| all.1));
        assert_eq!(given(from_pose), told(expected), "{scene} at {arguments:?}");
    }
}

/// Angles all round, the axes and the change point among them.
fn angles() -> impl Iterator<Item = f64> {
    (-720..=720)
        .map(|half_degrees| (f64::from(half_degrees) * 0.5).to_radians())
        .chain([1e-9, 3.0, 1e3, -4e5, 1e6, 1e22])
}

#[test]
fn four_bar() {
    let interpreted = Interpreted::of("four_bar");
    let force: Vector2<f64> = polar(50.0, 230f64.to_radians());
    let loads = four_bar::Loads { F13: force };
    for theta in angles() {
        let arguments =
            Arguments { drives: vec![theta], loads: vec![[force.x, force.y], [0.0; 2]], ..Arguments::default() };
        let pose = four_bar::Pose::at(theta);
        let from = |scene: fn(&four_bar::Pose, &four_bar::Loads) -> Result<four_bar::Statics, Error>| {
            pose.and_then(|pose| scene(&pose, &loads))
        };
        interpreted.check("statics", &arguments, &four_bar::statics_at(theta, &loads), &from(four_bar::Pose::statics));
        interpreted.check(
            "parts",
            &arguments,
            &four_bar::parts_at(theta, &loads),
            &pose.and_then(|pose| pose.parts(&loads)),
        );
        interpreted.check(
            "torque",
            &arguments,
            &four_bar::torque_at(theta, &loads),
            &pose.and_then(|pose| pose.torque(&loads)),
        );
        interpreted.check("bearing", &arguments, &four_bar::bearing_at(theta), &pose.and_then(|pose| pose.bearing()));
        interpreted.check(
            "terms",
            &arguments,
            &four_bar::terms_at(theta, &loads),
            &pose.and_then(|pose| pose.terms(&loads)),
        );
        interpreted.check("places", &arguments, &four_bar::places_at(theta), &pose.and_then(|pose| pose.places()));
    }
}

#[test]
fn slider_crank() {
    let interpreted = Interpreted::of("slider_crank");
    let loads = engine::Loads { gas: Vector2::new(12.5, -4000.0) };
    for theta in angles() {
        let arguments =
            Arguments { drives: vec![theta], loads: vec![[12.5, -4000.0], [0.0; 2]], ..Arguments::default() };
        let pose = engine::Pose::at(theta);
        interpreted.check(
            "hold",
            &arguments,
            &engine::hold_at(theta, &loads),
            &pose.and_then(|pose| pose.hold(&loads)),
        );
        interpreted.check("weights", &arguments, &engine::weights_at(theta), &pose.and_then(|pose| pose.weights()));
        interpreted.check(
            "torque",
            &arguments,
            &engine::torque_at(theta, &loads),
            &pose.and_then(|pose| pose.torque(&loads)),
        );
    }
}

#[test]
fn six_bar() {
    let interpreted = Interpreted::of("six_bar");
    let loads = six_bar::Loads { F: Vector2::new(-180.0, 60.0) };
    for theta in angles() {
        let given = vec![[0.0; 2], [-180.0, 60.0], [0.0; 2]];
        let arguments = Arguments { drives: vec![theta], loads: given, ..Arguments::default() };
        let pose = six_bar::Pose::at(theta);
        interpreted.check(
            "statics",
            &arguments,
            &six_bar::statics_at(theta, &loads),
            &pose.and_then(|pose| pose.statics(&loads)),
        );
        interpreted.check(
            "parts",
            &arguments,
            &six_bar::parts_at(theta, &loads),
            &pose.and_then(|pose| pose.parts(&loads)),
        );
        interpreted.check(
            "torque",
            &arguments,
            &six_bar::torque_at(theta, &loads),
            &pose.and_then(|pose| pose.torque(&loads)),
        );
        interpreted.check(
            "second",
            &arguments,
            &six_bar::second_at(theta, &loads),
            &pose.and_then(|pose| pose.second(&loads)),
        );
    }
}

#[test]
fn three_loads() {
    let interpreted = Interpreted::of("three_loads");
    let given = [[3.0, -20.0], [-30.0, 40.0], [-90.0, -30.0]];
    let [f12, f13, f14] = given.map(Vector2::from);
    let loads = three_loads::Loads { F12: f12, F13: f13, F14: f14 };
    for theta in angles() {
        let arguments = Arguments { drives: vec![theta], loads: given.to_vec(), ..Arguments::default() };
        let pose = three_loads::Pose::at(theta);
        interpreted.check(
            "parts",
            &arguments,
            &three_loads::parts_at(theta, &loads),
            &pose.and_then(|pose| pose.parts(&loads)),
        );
        interpreted.check(
            "whole",
            &arguments,
            &three_loads::whole_at(theta, &loads),
            &pose.and_then(|pose| pose.whole(&loads)),
        );
        interpreted.check(
            "torque",
            &arguments,
            &three_loads::torque_at(theta, &loads),
            &pose.and_then(|pose| pose.torque(&loads)),
        );
    }
}

#[test]
fn stephenson() {
    let interpreted = Interpreted::of("stephenson");
    let loads = stephenson::Loads { F: Vector2::new(-180.0, 60.0) };
    for theta in angles() {
        let arguments =
            Arguments { drives: vec![theta], loads: vec![[-180.0, 60.0], [0.0; 2]], ..Arguments::default() };
        let pose = stephenson::Pose::at(theta);
        interpreted.check(
            "statics",
            &arguments,
            &stephenson::statics_at(theta, &loads),
            &pose.and_then(|pose| pose.statics(&loads)),
        );
        interpreted.check(
            "parts",
            &arguments,
            &stephenson::parts_at(theta, &loads),
            &pose.and_then(|p| p.parts(&loads)),
        );
        interpreted.check(
            "torque",
            &arguments,
            &stephenson::torque_at(theta, &loads),
            &pose.and_then(|pose| pose.torque(&loads)),
        );
        interpreted.check("place", &arguments, &stephenson::place_at(theta), &pose.and_then(|pose| pose.place()));
    }
}

/// A pose from the one before, over a whole turn.
#[test]
fn stephenson_moved() {
    let linkage = Interpreted::of("stephenson").linkage;
    let at = |theta: f64| Arguments { drives: vec![theta], loads: vec![[0.0; 2]; 2], ..Arguments::default() };
    let mut kept = pose::<Double>(&linkage, &at(0.5)).expect("a pose");
    let mut emitted = stephenson::Pose::at(0.5).expect("a pose");
    let mut before = 0.5;
    // By small steps, and by some that are followed in strides.
    for theta in (0..630).map(|step| 0.5 + f64::from(step) * 0.01).chain([4.0, 9.5, -3.0, 0.5]) {
        kept = moved(&linkage, (&kept, &at(before)), &at(theta)).expect("a pose");
        emitted = emitted.moved_to(theta).expect("a pose");
        before = theta;
        let expected = values_from_kept(&linkage, "place", &kept, &at(theta)).map(|all| all.1);
        assert_eq!(given(&emitted.place()), told(expected), "at {theta}");
    }
}

#[test]
fn fused_arithmetic() {
    let interpreted = Interpreted::of_text(FUSED);
    let force: Vector2<f64> = polar(50.0, 1.0);
    let regular = angles().map(|theta| [theta, force.x, force.y]);
    for [theta, x, y] in
        regular.chain([0.6, 2.5].into_iter().flat_map(|theta| each_replaced([theta, force.x, force.y])))
    {
        let loads = fused::Loads { F: Vector2::new(x, y) };
        let arguments = Arguments { drives: vec![theta], loads: vec![[x, y], [0.0; 2]], ..Arguments::default() };
        let pose = fused::Pose::at(theta);
        interpreted.check("held", &arguments, &fused::held_at(theta, &loads), &pose.and_then(|pose| pose.held(&loads)));
        interpreted.check(
            "parts",
            &arguments,
            &fused::parts_at(theta, &loads),
            &pose.and_then(|pose| pose.parts(&loads)),
        );
        interpreted.check("work", &arguments, &fused::work_at(theta, &loads), &pose.and_then(|pose| pose.work(&loads)));
        interpreted.check("places", &arguments, &fused::places_at(theta), &pose.and_then(|pose| pose.places()));
    }
    assert_eq!(interpreted.linkage.functions.scenes[0].direct.counts().fused, 22);
}

/// The most statements with `let` that one block has.
fn most_bindings(code: TokenStream) -> usize {
    let (mut own, mut most) = (0, 0);
    for token in code {
        match token {
            TokenTree::Ident(word) if word == "let" => own += 1,
            TokenTree::Group(group) => most = most.max(most_bindings(group.stream())),
            _ => {}
        }
    }
    most.max(own)
}

/// The body of the function of this name in a module.
fn body_of(module: TokenStream, name: &str) -> Option<TokenStream> {
    let block = |token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group.stream()),
        _ => None,
    };
    let mut items = module.into_iter().find_map(block)?.into_iter();
    items.find(|token| matches!(token, TokenTree::Ident(word) if word == name))?;
    items.find_map(block)
}

/// In blocks, of which each leaves what others read.
#[test]
fn long_functions() {
    let interpreted = Interpreted::of_text(LONG);
    let steps = interpreted.linkage.functions.scenes[0].direct.steps.len();
    let body = body_of(linkage_codegen::expand(LONG.parse().expect("tokens")), "parts_at").expect("a function");
    let most = most_bindings(body);
    assert!(steps > 2000 && most < 450, "{steps} steps, {most} bindings in a block");
    for theta in angles() {
        let arguments = Arguments { drives: vec![theta], loads: vec![[0.0; 2]], ..Arguments::default() };
        let pose = long::Pose::at(theta);
        interpreted.check("parts", &arguments, &long::parts_at(theta), &pose.and_then(|pose| pose.parts()));
    }
}

/// In place of a number.
const BAD: [f64; 4] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX];

/// These numbers, with each in turn replaced by each of [`BAD`].
fn each_replaced<const N: usize>(good: [f64; N]) -> impl Iterator<Item = [f64; N]> {
    (0..N).flat_map(|index| BAD.map(|bad| (index, bad))).map(move |(index, bad)| {
        let mut replaced = good;
        replaced[index] = bad;
        replaced
    })
}

#[test]
fn in_motion() {
    let interpreted = Interpreted::of_text(CRUSHER);
    let at = |theta: f64| [theta, 12.0 + theta.clamp(-4.0, 4.0), 0.75, 0.62, 31.4, -250.0];
    for theta in angles() {
        crusher_at(&interpreted, at(theta));
    }
    for theta in [0.4, -1.3, 2.0] {
        assert!(pose::<Double>(&interpreted.linkage, &crusher_arguments(at(theta))).is_ok(), "{theta}");
        each_replaced(at(theta)).for_each(|numbers| crusher_at(&interpreted, numbers));
    }
}

fn crusher_arguments([theta, x, damping, rod_mass, theta_rate, theta_acceleration]: [f64; 6]) -> Arguments {
    let mut loads = vec![[0.0; 2]; 5];
    loads[3] = [0.0, damping];
    Arguments {
        drives: vec![theta, x],
        loads,
        params: vec![rod_mass],
        // The other drive's motion is declared.
        motion: vec![[theta_rate, theta_acceleration], [f64::NAN; 2]],
        ..Arguments::default()
    }
}

fn crusher_at(interpreted: &Interpreted, numbers: [f64; 6]) {
    let arguments = crusher_arguments(numbers);
    let [theta, x, damping, rod_mass, theta_rate, theta_acceleration] = numbers;
    let linkage = match crusher::Linkage::new(&crusher::Params { rod_mass }) {
        Ok(linkage) => linkage,
        Err(error) => {
            let expected = checked_prepared::<Double>(&interpreted.linkage, &arguments).map(|_| Vec::new());
            assert_eq!(given(&Err::<(), _>(error)), told::<Double>(expected));
            return;
        }
    };
    let motion = crusher::Motion { theta_rate, theta_acceleration };
    let loads = crusher::Loads { K: crusher::LoadsK { damping } };
    let pose = crusher::Pose::at(&linkage, theta, x);
    interpreted.check(
        "held",
        &arguments,
        &crusher::held_at(&linkage, theta, x, &motion, &loads),
        &pose.and_then(|pose| pose.held(&motion, &loads)),
    );
    interpreted.check(
        "parts",
        &arguments,
        &crusher::parts_at(&linkage, theta, x, &motion, &loads),
        &pose.and_then(|pose| pose.parts(&motion, &loads)),
    );
    interpreted.check(
        "work",
        &arguments,
        &crusher::work_at(&linkage, theta, x, &motion),
        &pose.and_then(|pose| pose.work(&motion)),
    );
    interpreted.check(
        "speeds",
        &arguments,
        &crusher::speeds_at(&linkage, theta, x, &motion),
        &pose.and_then(|pose| pose.speeds(&motion)),
    );
    interpreted.check(
        "accelerations",
        &arguments,
        &crusher::accelerations_at(&linkage, theta, x, &motion),
        &pose.and_then(|pose| pose.accelerations(&motion)),
    );
    interpreted.check(
        "slopes",
        &arguments,
        &crusher::slopes_at(&linkage, theta, x, &motion, &loads),
        &pose.and_then(|pose| pose.slopes(&motion, &loads)),
    );
    interpreted.check(
        "curves",
        &arguments,
        &crusher::curves_at(&linkage, theta, x, &motion),
        &pose.and_then(|pose| pose.curves(&motion)),
    );
    interpreted.check(
        "more",
        &arguments,
        &crusher::more_at(&linkage, theta, x, &motion),
        &pose.and_then(|pose| pose.more(&motion)),
    );
    interpreted.check(
        "control",
        &arguments,
        &crusher::control_at(&linkage, theta, x, &motion, &loads),
        &pose.and_then(|pose| pose.control(&motion, &loads)),
    );
    interpreted.check("gains", &arguments, &crusher::gains_at(&linkage, theta, x), &pose.and_then(|pose| pose.gains()));
    interpreted.check("light", &arguments, &crusher::light_at(&linkage, theta, x), &pose.and_then(|pose| pose.light()));
}

/// Results of a group that is placed by iteration, with their bounds.
#[test]
fn with_bounds() {
    let interpreted = Interpreted::of_text(BOUNDED);
    let force: Vector2<f64> = polar(50.0, 1.0);
    let (loads, motion) = (bounded::Loads { F: force }, bounded::Motion { q_rate: 31.4, q_acceleration: -250.0 });
    let mut found = 0;
    for q in (0..200).map(|step| 0.01 * f64::from(step)) {
        let arguments = Arguments {
            drives: vec![q],
            loads: vec![[force.x, force.y], [0.0; 2]],
            motion: vec![[31.4, -250.0]],
            ..Arguments::default()
        };
        let pose = bounded::Pose::at(q);
        let held = bounded::held_at(q, &loads);
        found += usize::from(held.is_ok());
        interpreted.check("held", &arguments, &held, &pose.and_then(|pose| pose.held(&loads)));
        interpreted.check(
            "speeds",
            &arguments,
            &bounded::speeds_at(q, &motion),
            &pose.and_then(|pose| pose.speeds(&motion)),
        );
        interpreted.check(
            "carried",
            &arguments,
            &bounded::carried_at(q, &motion),
            &pose.and_then(|pose| pose.carried(&motion)),
        );
    }
    assert!(found > 100, "{found}");
    for [q, x, y, q_rate, q_acceleration] in each_replaced([0.4, force.x, force.y, 31.4, -250.0]) {
        let arguments = Arguments {
            drives: vec![q],
            loads: vec![[x, y], [0.0; 2]],
            motion: vec![[q_rate, q_acceleration]],
            ..Arguments::default()
        };
        let (loads, motion) = (bounded::Loads { F: Vector2::new(x, y) }, bounded::Motion { q_rate, q_acceleration });
        let pose = bounded::Pose::at(q);
        interpreted.check("held", &arguments, &bounded::held_at(q, &loads), &pose.and_then(|pose| pose.held(&loads)));
        interpreted.check(
            "speeds",
            &arguments,
            &bounded::speeds_at(q, &motion),
            &pose.and_then(|pose| pose.speeds(&motion)),
        );
        interpreted.check(
            "carried",
            &arguments,
            &bounded::carried_at(q, &motion),
            &pose.and_then(|pose| pose.carried(&motion)),
        );
    }
}

/// Inverse scenes, with what is prepared for them.
#[test]
fn inverse() {
    let interpreted = Interpreted::of_text(ROCKER);
    let exchanged = &interpreted.linkage.inverses[0];
    let program = &exchanged.functions.scenes[0].direct;
    let linkage = rocker::Linkage::new(&rocker::Params { reach: 80.0 }).expect("a length");
    let mut found = 0;
    let regular = (0..=400).map(|step| [100.0 + 0.5 * f64::from(step), 230.0, -1700.0]);
    let replaced = [160.0, 200.0, 240.0].into_iter().flat_map(|travel| each_replaced([travel, 230.0, -1700.0]));
    for [travel, rate, acceleration] in regular.chain(replaced) {
        let motion = rocker::CrankOfMotion { S_travel_rate: rate, S_travel_acceleration: acceleration };
        for side in [Side::Left, Side::Right] {
            let arguments = Arguments {
                drives: vec![travel],
                params: vec![80.0],
                motion: vec![[rate, acceleration]],
                sides: vec![1.0, 1.0, f64::from(side.sign()), 1.0],
                ..Arguments::default()
            };
            let own = rocker::crank_of_at(&linkage, travel, rocker::Closures { A: side }, &motion);
            let expected = told(direct::<Double>(exchanged, program, &arguments));
            assert_eq!(given(&own), expected, "{side:?} at {travel}");
            found += usize::from(own.is_ok());
        }
    }
    assert!(found > 100, "{found}");
}

/// Where the unknowns act elsewhere, the mass is not symmetric: rows and columns are in their places.
#[test]
fn masses_of_efforts_elsewhere() {
    let interpreted = Interpreted::of_text(RAIL);
    let motion = rail::Motion { theta_rate: 3.1, travel_rate: -0.8 };
    let mut skew = 0;
    for theta in angles() {
        let arguments = Arguments {
            drives: vec![theta, 0.1],
            loads: vec![[0.0; 2]],
            motion: vec![[3.1, f64::NAN], [-0.8, f64::NAN]],
            ..Arguments::default()
        };
        let straight = rail::control_at(theta, 0.1, &motion);
        let pose = rail::Pose::at(theta, 0.1);
        interpreted.check("control", &arguments, &straight, &pose.and_then(|pose| pose.control(&motion)));
        let Ok(control) = straight else { continue };
        // A row of M is what one effort gives to both accelerations.
        let index = interpreted.linkage.functions.scenes[0].direct.outputs.iter().position(|(path, _)| path == "M.1.2");
        let values =
            direct::<Double>(&interpreted.linkage, &interpreted.linkage.functions.scenes[0].direct, &arguments);
        let entry = values.expect("results")[index.expect("an entry")].0;
        assert_eq!(control.M[(0, 1)].to_bits(), entry.to_bits());
        skew += usize::from(control.M[(0, 1)].to_bits() != control.M[(1, 0)].to_bits());
    }
    assert!(skew > 100, "{skew}");
}
