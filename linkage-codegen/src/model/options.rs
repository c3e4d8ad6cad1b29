//! Units, number type, path of the run-time crate.

use proc_macro2::TokenStream;

use super::scalar_of;
use super::units::{Dimension, Units, unit};
use crate::diagnostics::{Diagnostic, Sink};
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
    for item in &ast.items {
        match item {
            Item::Units(names) => names.iter().for_each(|name| choose_unit(&mut options.units, name, sink)),
            Item::Scalar(name) => match scalar_of(&name.text) {
                Some(scalar) => options.scalar = scalar,
                None => sink.report(Diagnostic::new(name.place(), "the scalar is `f64` or `f32`")),
            },
            Item::Arithmetic(name) => match name.text.as_str() {
                "plain" => options.fused = false,
                "fused" => options.fused = true,
                _ => sink.report(Diagnostic::new(name.place(), "the arithmetic is `plain` or `fused`")),
            },
            Item::Crate(path) => options.runtime = Some(path.clone()),
            Item::Emit(name) => match name.text.as_str() {
                "source" if cfg!(feature = "source") => options.emit_source = true,
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

fn choose_unit(units: &mut Units, name: &Name, sink: &Sink) {
    let refuse = |problem: String| {
        sink.report(
            Diagnostic::new(name.place(), problem)
                .help("`units { mm, N }` chooses the length and the force of the generated functions")
                .note("mass is always in kg, time in s, and an angle in rad"),
        );
    };
    match unit(&name.text) {
        Some(unit) if unit.dimension == Dimension::LENGTH => units.length = unit,
        Some(unit) if unit.dimension == Dimension::FORCE => units.force = unit,
        Some(_) => refuse(format!("`{name}` is a unit neither of length nor of force")),
        None => refuse(format!("there is no unit `{name}`")),
    }
}
