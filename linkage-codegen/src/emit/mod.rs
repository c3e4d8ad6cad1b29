//! Programs in, tokens out: types, functions, documentation.

mod body;
mod docs;
mod equations;
mod fallback;
mod forms;
mod formula;
mod functions;
mod inverses;
mod limits;
mod literals;
mod search;
mod stages;
mod sweeps;
mod types;

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::TokenStream;
use quote::quote;

use crate::Linkage;
use crate::graph::{NodeId, Op, Symbol};
use crate::model::{Method, Model, OWN_PATTERNS};
pub use equations::text as equations;
pub use fallback::module as fallback;
use forms::{Forms, scaled};
use formula::Terms;
use literals::ident;
pub use types::given_motion;

/// The module of a linkage.
#[must_use]
pub fn module(linkage: &Linkage) -> TokenStream {
    let plain = with_source(linkage, &TokenStream::new());
    if !linkage.model.emit_source {
        return plain;
    }
    // The source that the module holds is its own, but for that constant.
    let source = literals::text(&source(&plain));
    let constant = quote! {
        /// The source of this module, formatted.
        pub const SOURCE: &str = #source;
    };
    with_source(linkage, &constant)
}

/// Tokens as formatted source; unformatted if that is not built in.
fn source(tokens: &TokenStream) -> String {
    #[cfg(feature = "source")]
    if let Ok(source) = crate::formatted(tokens.clone()) {
        return source;
    }
    tokens.to_string()
}

fn with_source(linkage: &Linkage, source: &TokenStream) -> TokenStream {
    let model = &linkage.model;
    let (attributes, visibility, name) = (&model.attributes, &model.visibility, ident(&model.name.text));
    let docs = docs::module(linkage);
    let runtime = model.runtime.clone().unwrap_or_else(|| quote!(::linkage_runtime));
    let math = ident(model.graph.scalar().name());
    let equations = literals::text(&equations::text(linkage));
    let operations = literals::text(&operations(linkage));
    let limits = limits::tokens(linkage, &runtime);
    let motion = types::motion(model);
    let loads = types::loads(model, true);
    let prepare = if types::has_params(linkage) { functions::prepare(linkage) } else { TokenStream::new() };
    let params = types::params(linkage, &prepare);
    let pose = types::pose(linkage);
    let poses = functions::poses(linkage);
    let searches = search::functions(linkage);
    let accessors = functions::accessors(linkage);
    let verifies = model.scenes.iter().any(|scene| scene.method == Method::Verify);
    let reference = verifies.then(|| {
        quote! {
            use #runtime::__private::{Compared, verify};
            use #runtime::reference::Verification;
        }
    });
    let wrench = uses_wrench(&runtime, model.has_wrenches());
    let sweeps: TokenStream = model.sweeps.iter().map(|sweep| sweeps::function(linkage, sweep, &runtime)).collect();
    let closures = types::closures(model, true);
    let sides = (!closures.is_empty()).then(|| quote!(use #runtime::{Along, Side};));
    let matrices = model.has_matrices().then(|| quote!(use #runtime::nalgebra::{SMatrix, SVector};));
    let scenes = 0..model.scenes.len();
    let results: TokenStream = scenes.clone().map(|s| types::results(model, s, &linkage.plan.scenes[s])).collect();
    let forward: TokenStream = scenes.clone().map(|s| functions::forward(model, s)).collect();
    let from_pose: TokenStream = scenes.clone().map(|s| functions::from_pose(linkage, s)).collect();
    let direct: TokenStream = scenes.map(|s| functions::direct(linkage, s)).collect();
    let inverses: TokenStream = linkage.inverses.iter().map(|inverse| inverses::function(inverse, &runtime)).collect();
    let (generics, elided) = if types::has_params(linkage) {
        (quote!(<'l>), quote!(<'l>))
    } else {
        (TokenStream::new(), TokenStream::new())
    };
    quote! {
            #attributes
            #docs
            #[allow(
                dead_code, non_snake_case, non_camel_case_types, unused_imports, unused_variables, unused_doc_comments,
                    unused_parens,
                clippy::all, clippy::pedantic, clippy::nursery,
                reason = "generated code keeps the names and the formulas of its declaration"
            )]
            #visibility mod #name {
                use #runtime::__private::#math as math;
    use #runtime::{
        Error, GearReaction, ResolvedForce, SliderReaction, SlotReaction, Vector2, WeldReaction, WorkTerm,
    };
                #reference
                #wrench
                #matrices
                #sides

                /// The derivation: free bodies, equilibrium equations, reduction, closed forms.
                pub const EQUATIONS: &str = #equations;
                /// The operations of every function: sums and differences, products, quotients, roots and functions; changes of sign and
                /// absolute values; checks.
                pub const OPERATIONS: &str = #operations;
                #source

                #motion
                #loads
                #closures
                #params
                #limits
                #pose
                impl #generics Pose #elided {
                    #poses
                    #accessors
                    #from_pose
                }
                #results
                #forward
                #direct
                #inverses
                #sweeps
                #searches
            }
        }
}

/// The type of resultants, if there are any.
fn uses_wrench(runtime: &TokenStream, any: bool) -> Option<TokenStream> {
    any.then(|| quote!(use #runtime::Wrench;))
}

/// The operation counts of all functions, a line each.
#[must_use]
pub fn operations(linkage: &Linkage) -> String {
    let mut text = format!("{:<28} {}\n", "Pose::at", linkage.functions.pose.counts());
    if let Some(near) = &linkage.functions.near {
        text.push_str(&format!("{:<28} {}\n", "Pose::moved_to", near.counts()));
    }
    for ((_, search), functions) in linkage.model.graph.searches().iter().zip(&linkage.functions.searches) {
        let name = format!("{}, each step", search.name);
        text.push_str(&format!("{name:<28} {}, 1 solve\n", functions.step.counts()));
    }
    for (scene, functions) in linkage.model.scenes.iter().zip(&linkage.functions.scenes) {
        text.push_str(&format!("{:<28} {}\n", format!("Pose::{}", scene.name), functions.from_pose.counts()));
        text.push_str(&format!("{:<28} {}\n", format!("{}_at", scene.name), functions.direct.counts()));
    }
    for (scene, program) in linkage.inverses.iter().filter_map(inverses::scene) {
        text.push_str(&format!("{:<28} {}\n", format!("{}_at", scene.name), program.counts()));
    }
    text
}

/// The names of everything that is prepared from the parameters: those of parameters and quantities, of others what they are made of. None is
/// that of anything else that a function reads.
fn prepared_names(linkage: &Linkage) -> BTreeMap<NodeId, String> {
    let Linkage { model, functions, .. } = linkage;
    let mut used: BTreeSet<String> = functions::taken().into_iter().chain(OWN_PATTERNS).map(str::to_owned).collect();
    used.extend(functions::given_names(linkage));
    let mut named = Prepared { model, names: BTreeMap::new() };
    // Parameters first: each has its own.
    let (params, others): (Vec<&NodeId>, Vec<&NodeId>) =
        functions.prepared.iter().partition(|node| parameter_of(model, **node).is_some());
    for node in params {
        let own = parameter_of(model, *node).unwrap_or_default();
        named.names.insert(*node, body::new_name(&mut used, own));
    }
    used.extend(model.params.iter().map(|param| param.name.text.clone()));
    for node in others {
        let form = || Forms { graph: &model.graph, terms: &named }.name(*node);
        let form = || form().filter(|name| !name.contains("prepared"));
        let own = name_of(model, *node).or_else(form).unwrap_or_else(|| "prepared".to_owned());
        named.names.insert(*node, body::new_name(&mut used, &own));
    }
    named.names
}

/// What is prepared, down to the next names.
struct Prepared<'a> {
    model: &'a Model,
    names: BTreeMap<NodeId, String>,
}

impl Terms<NodeId> for Prepared<'_> {
    fn op(&self, node: NodeId) -> Op {
        self.model.graph.op(self.model.graph.bare(node))
    }

    fn name(&self, node: NodeId) -> Option<String> {
        self.names.get(&node).cloned().or_else(|| name_of(self.model, node))
    }
}

/// The name of the parameter that a node is.
fn parameter_of(model: &Model, node: NodeId) -> Option<&str> {
    match model.graph.op(model.graph.bare(node)) {
        Op::Symbol(Symbol::Parameter(param)) => Some(&model.param(param).name.text),
        _ => None,
    }
}

/// The name of a quantity, of a parameter, or of what is a multiple of one.
fn name_of(model: &Model, node: NodeId) -> Option<String> {
    let graph = &model.graph;
    if let Some(param) = parameter_of(model, node) {
        return Some(param.to_owned());
    }
    match (graph.label(node), graph.op(node)) {
        (Some(label), _) => Some(label.name),
        (None, Op::Checked { value, .. }) => name_of(model, value),
        (None, Op::Mul(a, b)) if graph.expr(a).value().is_some() => Some(scaled(&name_of(model, b)?)),
        _ => None,
    }
}
