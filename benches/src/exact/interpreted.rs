//! The reference against the programs that the compiler writes, interpreted in as many digits: two derivations that share nothing find
//! the same sixty decimal digits.

use std::f64::consts::PI;

use linkage_codegen::Linkage;
use linkage_codegen::graph::Symbol;
use linkage_codegen::graph::number::Number;
use linkage_codegen::graph::real::Real;
use linkage_codegen::program::{Input, Run};
use linkage_runtime::polar;
use proc_macro2::{TokenStream, TokenTree};

use super::{Big, DIGITS, Exact, Float, context};
use crate::items::{four_bar, six_bar, slider_crank};
use crate::linkages;

impl Real for Big {
    fn from_number(number: &Number) -> Self {
        let float: Float = match number {
            Number::Rational(q) => q.to_float(DIGITS).value(),
            Number::Pi(q) => {
                let q: Float = q.to_float(DIGITS).value();
                context().mul(context().pi::<2>(None).value().repr(), q.repr()).expect("finite").value()
            }
            Number::Real(x) => x.clone().with_precision(DIGITS).value(),
        };
        Self(float)
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn div(&self, other: &Self) -> Self {
        self / other
    }
    fn neg(&self) -> Self {
        -self
    }
    fn sqrt(&self) -> Self {
        Big::sqrt(self)
    }
    fn above(&self, other: &Self) -> bool {
        self.0 > other.0
    }
    fn at_least(&self, other: &Self) -> bool {
        self.0 >= other.0
    }
    fn is_finite(&self) -> bool {
        true
    }
    fn sin_cos(&self) -> (Self, Self) {
        let [cos, sin] = self.direction();
        (sin, cos)
    }
    fn sin_cos_sum(&self, phase: &Number) -> (Self, Self) {
        Real::sin_cos(&(self + Self::from_number(phase)))
    }
    fn atan2(&self, x: &Self) -> Self {
        Self(context().atan2(self.0.repr(), x.0.repr(), None).expect("finite").value())
    }
    fn unit(&self, y: &Self) -> (Self, Self) {
        let size = Big::sqrt(&(self * self + y * y));
        (self / &size, y / &size)
    }
}

/// A linkage that is measured, from the very text that declares it.
fn linkage(name: &str) -> Linkage {
    // Each in a macro of its name.
    let source = include_str!("../linkages.rs")
        .replace("$scalar", "f64")
        .replace("$arithmetic", "plain")
        .replace("$($sweeps)*", "");
    let named = |part: &str| part.replace("$name", part.split_whitespace().next().expect("a name"));
    let source = source.split("macro_rules! ").map(named).collect::<Vec<_>>().join("macro_rules! ");
    let mut declarations = Vec::new();
    find(source.parse().expect("tokens"), &mut declarations);
    let linkages =
        declarations.into_iter().map(|declaration| linkage_codegen::analyse(declaration).expect("a linkage"));
    linkages.into_iter().find(|linkage| linkage.model.name.text == name).expect("a linkage of this name")
}

/// What stands between the braces of each `linkage!`, those in the rules of a macro too.
fn find(tokens: TokenStream, into: &mut Vec<TokenStream>) {
    let trees: Vec<TokenTree> = tokens.into_iter().collect();
    for (index, tree) in trees.iter().enumerate() {
        let TokenTree::Group(group) = tree else { continue };
        let is = |back: usize, text: &str| index >= back && trees[index - back].to_string() == text;
        if is(1, "!") && is(2, "linkage") {
            into.push(group.stream());
        } else {
            find(group.stream(), into);
        }
    }
}

/// The largest difference of the scene `statics` from the reference, by the largest force: in forces, and in the torque at 1 mm.
fn difference(linkage: &Linkage, theta: f64, loads: &[[f64; 2]], joints: &[&str], exact: &Exact) -> f64 {
    let scene = linkage.model.scenes.iter().position(|scene| scene.name.text == "statics").expect("the scene");
    let program = &linkage.functions.scenes[scene].direct;
    let inputs = |input| match input {
        Input::Symbol(Symbol::Drive(_)) => Big::of(theta),
        Input::Symbol(Symbol::Load(load, part)) => Big::of(loads[load.index()][usize::from(part)]),
        input => panic!("{input:?} is no input here"),
    };
    let found = Run { program, graph: &linkage.model.graph }.with(&inputs).expect("an answer");
    let largest = exact.forces.iter().map(super::size).reduce(Big::larger).expect("a force");
    let mut worst = Big::of(0.0);
    let mut compared = 0;
    let mut compare = |path: &str, exact: &Big| {
        let index = program.outputs.iter().position(|(own, _)| own == path);
        if let Some(index) = index {
            let error = (&found[index] - exact).abs() / &largest;
            worst = worst.clone().larger(error);
            compared += 1;
        }
    };
    let torque = linkage.model.unknowns[0].name.clone();
    compare(&torque, &exact.torque);
    for (joint, force) in joints.iter().zip(&exact.forces) {
        for (part, exact) in ["x", "y"].into_iter().zip(force) {
            compare(&format!("{joint}.{part}"), exact);
            compare(&format!("{joint}.force.{part}"), exact);
        }
    }
    let paths: Vec<&String> = program.outputs.iter().map(|(path, _)| path).collect();
    assert_eq!(compared, 2 * joints.len() + 1, "{paths:?}");
    worst.to_f64()
}

/// Angles all over the turn, next to the change point and beside it.
const ANGLES: [f64; 8] = [-3.0, -1.0, 0.0, 0.5, 1.6, 3.1, PI - 1e-6, PI + 1e-6];

#[test]
fn the_reference_and_the_interpreter_agree() {
    let (first, second) = (polar(50.0, 4.0), polar(100.0, 3.5));
    let pair = [[first.x, first.y], [second.x, second.y]];
    let (bar, six, crank) = (linkage("four_bar"), linkage("six_bar"), linkage("slider_crank"));
    for theta in ANGLES {
        let angle = Big::of(theta);
        let exact = four_bar::exact(&angle, &linkages::four_bar::Loads { F13: first, F14: second });
        let error = difference(&bar, theta, &pair, &["A0", "A", "B", "B0"], &exact);
        assert!(error < 1e-60, "four-bar at {theta}: {error:e}");

        let exact = six_bar::exact(&angle, &linkages::six_bar::Loads { F: first, G: second });
        let error = difference(&six, theta, &pair, &["A0", "A", "B", "B0", "C", "D", "D0"], &exact);
        assert!(error < 1e-60, "six-bar at {theta}: {error:e}");

        let exact = slider_crank::exact(&angle, &linkages::slider_crank::Loads { gas: first });
        let error = difference(&crank, theta, &pair, &["O", "A", "B", "P"], &exact);
        assert!(error < 1e-60, "slider-crank at {theta}: {error:e}");
    }
}
