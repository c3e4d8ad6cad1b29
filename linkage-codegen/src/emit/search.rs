//! The functions that place groups by Newton's method.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::body::Body;
use super::literals::ident;
use super::{docs, name_of};
use crate::Linkage;
use crate::emit::types::scalar;
use crate::graph::{Op, Search, Sought, Symbol};
use crate::program::{Input, Program, ValueId};

/// Names that a function's own values cannot have.
const TAKEN: [&str; 4] = ["search", "EQUATIONS", "OPERATIONS", "SOURCE"];

/// The functions of all searches.
pub(super) fn functions(linkage: &Linkage) -> TokenStream {
    let searches = linkage.model.graph.searches();
    searches
        .iter()
        .zip(&linkage.functions.searches)
        .map(|((_, search), program)| function(linkage, search, program))
        .collect()
}

/// The numbers of the unknowns, by their names.
fn numbers(search: &Search) -> Vec<String> {
    search.sought.iter().flat_map(Sought::names).collect()
}

/// The names of what a search is given.
fn known_names(linkage: &Linkage, search: &Search) -> Vec<String> {
    let mut names = numbers(search);
    let first = names.len();
    for node in &search.known {
        let own = match linkage.model.graph.op(*node) {
            Op::Symbol(Symbol::Drive(drive)) => Some(linkage.model.drive(drive).name.text.clone()),
            Op::Symbol(Symbol::Side(closure)) => {
                Some(format!("side_{}", linkage.model.joint(linkage.model.closure(closure).joint).name))
            }
            _ => name_of(&linkage.model, *node),
        };
        let own = own.unwrap_or_else(|| "known".to_owned());
        let (mut name, mut number) = (own.clone(), 2);
        while names.contains(&name) {
            name = format!("{own}_{number}");
            number += 1;
        }
        names.push(name);
    }
    names.split_off(first)
}

/// The name under which a pose keeps a number of an unknown.
pub(super) fn kept_name(search: &Search, number: u8) -> String {
    numbers(search).get(usize::from(number)).cloned().unwrap_or_default()
}

/// What is moved in a step: the variable that holds the best so far, and the step.
fn variables(sought: &Sought) -> (Ident, Ident) {
    let (Sought::Direction { name } | Sought::Travel { name, .. }) = sought;
    (ident(&format!("best_{name}")), ident(&format!("step_{name}")))
}

/// The body of a step.
pub(super) fn step<'a>(linkage: &'a Linkage, search: &Search, program: &'a Program) -> Body<'a> {
    let known = known_names(linkage, search);
    let input = |input: Input| match input {
        Input::Symbol(Symbol::Sought(_, number)) => kept_name(search, number),
        Input::Known(node) => {
            let index = search.known.iter().position(|known| *known == node);
            index.and_then(|index| known.get(index).cloned()).unwrap_or_default()
        }
        _ => String::new(),
    };
    let own: Vec<String> =
        search.sought.iter().flat_map(|s| <[Ident; 2]>::from(variables(s))).map(|name| name.to_string()).collect();
    let taken: Vec<&str> = TAKEN.into_iter().chain(own.iter().map(String::as_str)).collect();
    Body::new(program, &linkage.model.graph, &input, &taken)
}

fn function(linkage: &Linkage, search: &Search, program: &Program) -> TokenStream {
    let scalar = scalar(&linkage.model);
    let known = known_names(linkage, search);
    let (statements, body) = step(linkage, search, program).statements();
    let outputs: Vec<TokenStream> =
        program.outputs.iter().map(|(_, value): &(String, ValueId)| body.value(*value)).collect();
    let count = search.sought.len();
    let (residuals, rest) = outputs.split_at(count);
    let (jacobian, rest) = rest.split_at(count * count);
    let Some((rounding, scales)) = rest.split_first() else { return TokenStream::new() };
    let rows = jacobian.chunks(count).map(|row| quote!([#(#row),*]));
    let mut scales = scales.iter();
    let (mut begin, mut moves, mut keep, mut found) =
        (TokenStream::new(), TokenStream::new(), TokenStream::new(), Vec::new());
    for sought in &search.sought {
        let (best, step) = variables(sought);
        let names: Vec<Ident> = sought.names().iter().map(|name| ident(name)).collect();
        match names.as_slice() {
            [cos, sin] => {
                begin.extend(quote!(let mut #best = (#cos, #sin);));
                moves.extend(quote!(let (#cos, #sin) = math::turned(#best, #step);));
                keep.extend(quote!(#best = (#cos, #sin);));
                found.extend([quote!(#best.0), quote!(#best.1)]);
            }
            names => {
                let scale = scales.next();
                for travel in names {
                    begin.extend(quote!(let mut #best = #travel;));
                    moves.extend(quote!(let #travel = #best + #step * #scale;));
                    keep.extend(quote!(#best = #travel;));
                    found.push(quote!(#best));
                }
            }
        }
    }
    let steps = search.sought.iter().map(|sought| variables(sought).1);
    let arguments: Vec<Ident> = numbers(search).iter().chain(&known).map(|name| ident(name)).collect();
    let numbers = 0..=found.len();
    let results = numbers.map(|_| &scalar);
    let name = ident(&search.name);
    let lines = docs::search(search, program);
    quote! {
        #lines
        fn #name(#(#arguments: #scalar),*) -> (#(#results),*) {
            let mut search = math::Search::new();
            #begin
            while let Some([#(#steps),*]) = search.step() {
                #moves
                #statements
                if search.improves([#(#residuals),*], [#(#rows),*], #rounding) {
                    #keep
                }
            }
            (search.open(), #(#found),*)
        }
    }
}
