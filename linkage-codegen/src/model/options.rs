//! Units, number type, path of the run-time crate.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;

use super::scalar_of;
use super::units::{Dimension, Units, unit};
use crate::diagnostics::{Diagnostic, Place, Sink};
use crate::graph::Scalar;
use crate::syntax::ast::{Ast, Item, Name};

pub(super) struct Options {
    pub(super) units: Units,
    pub(super) scalar: Scalar,
    pub(super) runtime: Option<TokenStream>,
    pub(super) fused: bool,
    pub(super) emit_source: bool,
}

pub(super) fn options(ast: &Ast, sink: &Sink) -> Options {
    let mut options =
        Options { units: Units::default(), scalar: Scalar::F64, runtime: None, fused: false, emit_source: false };
    let mut chosen = BTreeSet::new();
    let mut once = |what: &'static str, place: Place| {
        let first = chosen.insert(what);
        if !first {
            let problem = format!("{what} is chosen already");
            sink.report(Diagnostic::new(place, problem).help("leave one of the two out"));
        }
        first
    };
    for item in &ast.items {
        match item {
            Item::Units(names) => {
                for name in names {
                    let what = choose_unit(&mut options.units, name, sink);
                    // Units that are chosen anew are one mistake.
                    if what.is_some_and(|what| !once(what, name.place())) {
                        break;
                    }
                }
            }
            Item::Scalar(name) => {
                once("the scalar", name.place());
                match scalar_of(&name.text) {
                    Some(scalar) => options.scalar = scalar,
                    None => sink.report(Diagnostic::new(name.place(), "the scalar is `f64` or `f32`")),
                }
            }
            Item::Arithmetic(name) => {
                once("the arithmetic", name.place());
                match name.text.as_str() {
                    "plain" => options.fused = false,
                    "fused" => options.fused = true,
                    _ => sink.report(Diagnostic::new(name.place(), "the arithmetic is `plain` or `fused`")),
                }
            }
            Item::Crate(path) => {
                if let Some(token) = path.clone().into_iter().next() {
                    once("the path of the run-time crate", Place::at(token.span()));
                }
                options.runtime = Some(path.clone());
            }
            Item::Emit(name) => match name.text.as_str() {
                "source" if cfg!(feature = "source") => {
                    once("`emit source`", name.place());
                    options.emit_source = true;
                }
                "source" => sink.report(
                    Diagnostic::new(name.place(), "the module can hold its own source only with the feature `source`")
                        .help("in Cargo.toml: linkage-runtime = { …, features = [\"source\"] }"),
                ),
                _ => sink.report(Diagnostic::new(name.place(), "what can be emitted besides the solvers is `source`")),
            },
            _ => {}
        }
    }
    options
}

/// What the unit is of, if it is one.
fn choose_unit(units: &mut Units, name: &Name, sink: &Sink) -> Option<&'static str> {
    let refuse = |problem: String| {
        sink.report(
            Diagnostic::new(name.place(), problem)
                .help("`units { mm, N }` chooses the length and the force of the generated functions")
                .note("mass is always in kg, time in s, and an angle in rad"),
        );
        None
    };
    match unit(&name.text) {
        Some(unit) if unit.dimension == Dimension::LENGTH => {
            units.length = unit;
            Some("the unit of length")
        }
        Some(unit) if unit.dimension == Dimension::FORCE => {
            units.force = unit;
            Some("the unit of force")
        }
        Some(_) => refuse(format!("`{name}` is a unit neither of length nor of force")),
        None => refuse(format!("there is no unit `{name}`")),
    }
}
