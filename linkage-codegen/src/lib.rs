//! The compiler behind `linkage!`: a declared planar linkage in, its solvers and equations out.
//!
//! One road, one direction; every stage is a type, and what holds of it is said where it is made:
//!
//! ```text
//! tokens → Ast → Model → Topology → System → Plan → Program → tokens, equations
//! ```

pub mod diagnostics;
pub mod emit;
pub mod equations;
pub mod graph;
pub mod model;
pub mod plan;
pub mod program;
pub mod syntax;
pub mod topology;

use proc_macro2::TokenStream;

use diagnostics::{Diagnostic, Sink};
use equations::System;
use model::Model;
use plan::Plan;
use program::Functions;
use topology::Topology;

/// A linkage at the end of the road: every stage that it went through.
#[derive(Debug)]
pub struct Linkage {
    /// Names and values.
    pub model: Model,
    /// Groups.
    pub topology: Topology,
    /// The unreduced equations.
    pub system: System,
    /// The solution of every group.
    pub plan: Plan,
    /// The functions.
    pub functions: Functions,
}

/// Takes a declaration through all stages.
///
/// # Errors
///
/// All that was found to be wrong, each with its place.
pub fn analyse(declaration: TokenStream) -> Result<Linkage, Vec<Diagnostic>> {
    let sink = Sink::default();
    let linkage = stages(declaration, &sink);
    match linkage {
        Some(linkage) if sink.is_clean() => Ok(linkage),
        _ => Err(sink.into_errors()),
    }
}

fn stages(declaration: TokenStream, sink: &Sink) -> Option<Linkage> {
    let ast = syntax::parse(declaration, sink)?;
    let model = model::resolve(&ast, sink);
    if !sink.is_clean() {
        return None;
    }
    let topology = Topology::of(&model, sink)?;
    let system = System::of(&model);
    let plan = Plan::of(&model, &topology, sink)?;
    let functions = Functions::of(&model.graph, &plan);
    Some(Linkage { model, topology, system, plan, functions })
}

/// The module of a declaration; of a wrong one its errors, and a module with the same names, so that one mistake is one error.
#[must_use]
pub fn expand(declaration: TokenStream) -> TokenStream {
    match analyse(declaration.clone()) {
        Ok(linkage) => emit::module(&linkage),
        Err(errors) => diagnostics::to_tokens(&errors),
    }
}

/// Emitted tokens as formatted source.
///
/// # Errors
///
/// If the tokens are no Rust items, which would be a fault of the compiler.
#[cfg(feature = "source")]
pub fn formatted(tokens: TokenStream) -> syn::Result<String> {
    syn::parse2(tokens).map(|file| prettyplease::unparse(&file))
}
