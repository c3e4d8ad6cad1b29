//! The functions that place groups by Newton's method.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::body::{Body, new_name};
use super::literals::{ident, signed_literal};
use super::{docs, name_of};
use crate::Linkage;
use crate::emit::types::scalar;
use crate::graph::{Graph, Op, Search, Sought, Symbol};
use crate::model::Model;
use crate::program::{Input, Program, SearchFunctions};

/// Names that a function's own values cannot have.
const TAKEN: [&str; 9] = ["search", "start", "from", "to", "way", "changing", "EQUATIONS", "OPERATIONS", "SOURCE"];

/// The functions of all searches.
pub(super) fn functions(linkage: &Linkage) -> TokenStream {
    let searches = linkage.model.graph.searches();
    searches
        .iter()
        .zip(&linkage.functions.searches)
        .map(|((_, search), functions)| {
            let (close, on_the_way) = (close(linkage, search, functions), on_the_way(linkage, search, functions));
            quote!(#close #on_the_way)
        })
        .collect()
}

/// The numbers of the unknowns, by their names.
fn numbers(search: &Search) -> Vec<String> {
    search.sought.iter().flat_map(Sought::names).collect()
}

/// The names of what a search reads beside its unknowns, by their nodes.
struct Names {
    known: Vec<String>,
    given: Vec<String>,
    drives: Vec<String>,
    /// How far each drive goes in a stride, where only parameters tell.
    reach: Vec<Option<String>>,
}

fn names(linkage: &Linkage, search: &Search) -> Names {
    let model = &linkage.model;
    let mut used: BTreeSet<String> = TAKEN.iter().map(|name| (*name).to_owned()).chain(numbers(search)).collect();
    let mut distinct = |own: Option<String>, other: &str| new_name(&mut used, own.as_deref().unwrap_or(other));
    let own_name = |node: &crate::graph::NodeId| match model.graph.op(*node) {
        Op::Symbol(Symbol::Drive(drive)) => Some(model.drive(drive).name.text.clone()),
        Op::Symbol(Symbol::Start(other, number)) => {
            Some(format!("{}_before", kept_name(model, &model.graph.search(other), number)))
        }
        Op::Symbol(Symbol::Side(closure)) => Some(format!("side_{}", model.joint(model.closure(closure).joint).name)),
        _ => name_of(model, *node),
    };
    let drives =
        search.drives.iter().map(|drive| distinct(Some(model.drive(*drive).name.text.clone()), "drive")).collect();
    // What is given and known is one argument.
    let given: Vec<String> = search.given.iter().map(|node| distinct(own_name(node), "given")).collect();
    let known = search.known.iter().map(|node| match search.given.iter().position(|given| given == node) {
        Some(index) => given[index].clone(),
        None => distinct(own_name(node), "known"),
    });
    let known = known.collect();
    let reach = search.reach.iter().zip(&search.drives).map(|(node, drive)| {
        let name = format!("reach_{}", model.drive(*drive).name);
        model.graph.constant_value(*node).is_none().then(|| distinct(Some(name), "reach"))
    });
    let reach = reach.collect();
    Names { known, given, drives, reach }
}

/// The name under which a pose keeps a number of an unknown, or a drive.
pub(super) fn kept_name(model: &Model, search: &Search, number: u8) -> String {
    let drives = search.drives.iter().map(|drive| model.drive(*drive).name.text.clone());
    numbers(search).into_iter().chain(drives).nth(usize::from(number)).unwrap_or_default()
}

/// Its own and what else it has, of which each argument stands once.
fn arguments(search: &Search, names: &Names) -> Vec<String> {
    let own = |node: &crate::graph::NodeId| !search.given.contains(node);
    let known = search.known.iter().zip(&names.known).filter(|(node, _)| own(node)).map(|(_, name)| name);
    names.reach.iter().flatten().chain(&names.given).chain(known).cloned().collect()
}

/// The call of a search with the code of its arguments.
pub(super) fn call(graph: &Graph, search: &Search, all: &[TokenStream]) -> TokenStream {
    let parts = search.arguments(all);
    let (directions, travels) = parts.start.split_at(2 * search.directions());
    let directions = directions.chunks(2).map(|pair| quote!((#(#pair),*)));
    let (from, to, given) = (parts.from, parts.to, parts.given);
    let reach = search.reach.iter().zip(parts.reach).filter(|(node, _)| graph.constant_value(**node).is_none());
    let reach = reach.map(|(_, value)| value);
    let known =
        search.known.iter().zip(parts.known).filter(|(node, _)| !search.given.contains(node)).map(|(_, value)| value);
    let name = ident(&search.name);
    quote!(#name(([#(#directions),*], [#(#travels),*]), [#(#from),*], [#(#to),*], #(#reach,)* #(#given,)* #(#known),*))
}

/// The pattern of what a search gives, of the names of its parts.
pub(super) fn pattern(search: &Search, parts: &[TokenStream]) -> TokenStream {
    let Some((open, numbers)) = parts.split_first() else { return quote!(_) };
    let (directions, travels) = numbers.split_at(2 * search.directions());
    let directions = directions.chunks(2).map(|pair| quote!((#(#pair),*)));
    quote!((#open, [#(#directions),*], [#(#travels),*]))
}

/// The body of an evaluation.
pub(super) fn step<'a>(linkage: &'a Linkage, search: &Search, program: &'a Program) -> Body<'a> {
    let names = names(linkage, search);
    let input = |input: Input| match input {
        Input::Symbol(Symbol::Sought(_, number)) => kept_name(&linkage.model, search, number),
        Input::Known(node) => {
            let index = search.known.iter().position(|known| *known == node);
            index.and_then(|index| names.known.get(index).cloned()).unwrap_or_default()
        }
        _ => String::new(),
    };
    let others: Vec<&str> = names.given.iter().chain(&names.drives).map(String::as_str).collect();
    let taken: Vec<&str> = TAKEN.into_iter().chain(others).collect();
    Body::new(program, &linkage.model.graph, &input, &taken)
}

/// The search.
fn close(linkage: &Linkage, search: &Search, functions: &SearchFunctions) -> TokenStream {
    let scalar = scalar(&linkage.model);
    let names = names(linkage, search);
    let (statements, body) = step(linkage, search, &functions.step).statements();
    let outputs: Vec<TokenStream> = functions.step.outputs.iter().map(|(_, value)| body.value(*value)).collect();
    let count = search.sought.len();
    let (residuals, rest) = outputs.split_at(count);
    let (jacobian, rest) = rest.split_at(count * count);
    let Some((rounding, scales)) = rest.split_first() else { return TokenStream::new() };
    let rows = jacobian.chunks(count).map(|row| quote!([#(#row),*]));
    let of = |names: &[String]| names.iter().map(|name| ident(name)).collect::<Vec<_>>();
    let (directions, travels) = (search.directions(), count - search.directions());
    let numbers = of(&numbers(search));
    let (pairs, singles) = numbers.split_at(2 * directions);
    let pairs = pairs.chunks(2).map(|pair| quote!((#(#pair),*)));
    let changing = of(&names.known[..search.changing]);
    let (given, drives, all) = (of(&names.given), of(&names.drives), of(&arguments(search, &names)));
    let (name, way) = (ident(&search.name), ident(&search.way_name()));
    let graph = &linkage.model.graph;
    let reach = search.reach.iter().zip(&names.reach).map(|(node, name)| match (name, graph.constant_value(*node)) {
        (None, Some(value)) => signed_literal(&value, graph.scalar()),
        (name, _) => ident(name.as_deref().unwrap_or_default()).to_token_stream(),
    });
    let lines = docs::search(search, &functions.step);
    let drive_count = proc_macro2::Literal::usize_unsuffixed(search.drives.len());
    let [directions, travels] = [directions, travels].map(proc_macro2::Literal::usize_unsuffixed);
    quote! {
        #lines
        fn #name(
            start: ([(#scalar, #scalar); #directions], [#scalar; #travels]),
            from: [#scalar; #drive_count],
            to: [#scalar; #drive_count],
            #(#all: #scalar),*
        ) -> (#scalar, [(#scalar, #scalar); #directions], [#scalar; #travels]) {
            let mut search = math::Search::new(start, from, to, [#(#reach),*]);
            while let Some(way) = search.way() {
                let changing = match way {
                    math::Way::Wanted => Some([#(#changing),*]),
                    math::Way::Between([#(#drives),*]) => #way(#(#drives,)* #(#given),*),
                };
                let Some([#(#changing),*]) = changing else { continue };
                while let Some(([#(#pairs),*], [#(#singles),*])) = search.places() {
                    #statements
                    search.evaluated([#(#residuals),*], [#(#rows),*], #rounding, [#(#scales),*]);
                }
            }
            search.found()
        }
    }
}

/// What changes with the drives, on the way to where they are wanted.
fn on_the_way(linkage: &Linkage, search: &Search, functions: &SearchFunctions) -> TokenStream {
    let scalar = scalar(&linkage.model);
    let names = names(linkage, search);
    let input = |input: Input| match input {
        Input::Known(node) => match linkage.model.graph.op(node) {
            Op::Symbol(Symbol::Drive(drive)) => {
                let index = search.drives.iter().position(|own| *own == drive);
                index.and_then(|index| names.drives.get(index).cloned()).unwrap_or_default()
            }
            _ => {
                let index = search.given.iter().position(|given| *given == node);
                index.and_then(|index| names.given.get(index).cloned()).unwrap_or_default()
            }
        },
        _ => String::new(),
    };
    let program = &functions.on_the_way;
    let body = Body::new(program, &linkage.model.graph, &input, &TAKEN).without_reasons();
    let (statements, body) = body.statements();
    let outputs = program.outputs.iter().map(|(_, value)| body.value(*value));
    let arguments = names.drives.iter().chain(&names.given).map(|name| ident(name));
    let name = ident(&search.way_name());
    let count = proc_macro2::Literal::usize_unsuffixed(search.changing);
    let lines = docs::on_the_way(search, program);
    quote! {
        #lines
        fn #name(#(#arguments: #scalar),*) -> Option<[#scalar; #count]> {
            #statements
            Some([#(#outputs),*])
        }
    }
}
