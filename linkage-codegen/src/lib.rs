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
mod inverse;
pub mod limits;
pub mod model;
pub mod plan;
pub mod program;
pub mod syntax;
pub mod topology;

use proc_macro2::TokenStream;

use diagnostics::{Diagnostic, Sink};
use equations::System;
use limits::Limits;
use model::Model;
use plan::Plan;
use program::Functions;
use syntax::ast::Ast;
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
    /// What is known of its four-bars and slider-cranks.
    pub limits: Limits,
    /// With which choices of sides it cannot be posed at the start of its drives, in words.
    pub unposed: Vec<String>,
    /// The same linkage, driven where inverse scenes want a motion: one for each of them, which is its only scene.
    pub inverses: Vec<Linkage>,
}

/// A declaration that is wrong.
#[derive(Debug)]
pub struct Refusal {
    /// All that was found, each with its place.
    pub errors: Vec<Diagnostic>,
    /// What was understood of it, if anything: names above all.
    pub model: Option<Box<Model>>,
}

/// Takes a declaration through all stages.
///
/// ```
/// let declaration = "mod lever; ground { O: (0, 0) } link lever { O -> P: 250mm }
///     revolute O: ground -> lever; drive theta: O; load F: force(lever.P); scene torque: virtual_work;";
/// let linkage = linkage_codegen::analyse(declaration.parse()?).map_err(|refusal| format!("{:?}", refusal.errors))?;
/// assert_eq!(linkage.plan.motion_rules, ["link on a pin"]);
/// assert!(linkage_codegen::emit::equations(&linkage).contains("ΣM(O)"));
///
/// let wrong = declaration.replace("lever.P", "lever.Q");
/// let refusal = linkage_codegen::analyse(wrong.parse()?).unwrap_err();
/// assert_eq!(refusal.errors.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// All that was found to be wrong, each with its place.
pub fn analyse(declaration: TokenStream) -> Result<Linkage, Refusal> {
    let sink = Sink::default();
    let ast = syntax::parse(declaration, &sink);
    let model = ast.as_ref().map(|ast| model::resolve(ast, &sink));
    let (Some(ast), Some(model)) = (ast, model) else {
        return Err(Refusal { errors: sink.into_errors(), model: None });
    };
    if sink.is_clean()
        && let Some(solved) = solve(&ast, &model, &sink)
        && sink.is_clean()
    {
        let Solved { topology, system, plan, functions, limits, unposed, inverses } = solved;
        return Ok(Linkage { model, topology, system, plan, functions, limits, unposed, inverses });
    }
    Err(Refusal { errors: sink.into_errors(), model: Some(Box::new(model)) })
}

/// What comes of a model.
struct Solved {
    topology: Topology,
    system: System,
    plan: Plan,
    functions: Functions,
    limits: Limits,
    unposed: Vec<String>,
    inverses: Vec<Linkage>,
}

fn solve(ast: &Ast, model: &Model, sink: &Sink) -> Option<Solved> {
    let topology = Topology::of(model, sink)?;
    let exchanged = inverse::exchanged(ast, model, &topology, sink)?;
    let system = System::of(model, &topology);
    let plan = Plan::of(model, &topology, &system, &inverse::closing(&exchanged), sink)?;
    let functions = Functions::of(model, &plan);
    program::check_range(model, &functions, sink);
    let unposed = program::check_start(model, (&topology, &plan), &functions, sink);
    // Last, as its expressions share the graph: they change no function.
    let limits = Limits::of(model, &topology);
    // Lengths that never meet are found there, too.
    plan::check_possible(model, sink);
    let inverses = inverse::solved(exchanged, model, sink)?;
    Some(Solved { topology, system, plan, functions, limits, unposed, inverses })
}

/// The module of a declaration; of a wrong one its errors, and a module with the same names, so that one mistake is one error.
#[must_use]
pub fn expand(declaration: TokenStream) -> TokenStream {
    match analyse(declaration) {
        Ok(linkage) => emit::module(&linkage),
        Err(Refusal { errors, model }) => {
            let mut tokens = diagnostics::to_tokens(&errors);
            tokens.extend(model.map(|model| emit::fallback(*model)));
            tokens
        }
    }
}

/// The same for the macro: a fault of the compiler is shown as its own.
#[must_use]
pub fn expand_or_report(declaration: TokenStream) -> TokenStream {
    let expanded = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| expand(declaration)));
    expanded.unwrap_or_else(|_| {
        let fault = Diagnostic::new(
            diagnostics::Place::at(proc_macro2::Span::call_site()),
            "a fault of the compiler of `linkage!` itself, not of this declaration",
        );
        diagnostics::to_tokens(&[fault.help("please report the declaration to the project")])
    })
}

/// Emitted tokens as formatted source.
///
/// ```
/// let declaration = "mod lever; ground { O: (0, 0) } link lever { O -> P: 250mm }
///     revolute O: ground -> lever; drive theta: O; scene place: position -> (lever.P);";
/// let source = linkage_codegen::formatted(linkage_codegen::expand(declaration.parse()?))?;
/// assert!(source.contains("pub fn place_at(theta: f64)"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// If the tokens are no Rust items, which would be a fault of the compiler.
#[cfg(feature = "source")]
pub fn formatted(tokens: TokenStream) -> syn::Result<String> {
    syn::parse2(tokens).map(|file| prettyplease::unparse(&file))
}
