//! Tokens in, [`Ast`] out. Afterwards every item has the shape that the grammar gives it; names and dimensions are unchecked.
//!
//! An item that cannot be read is reported, and reading goes on behind it.

pub mod ast;
mod items;
mod loads;
mod quantity;
mod scenes;
mod tokens;

use proc_macro2::TokenStream;
use quote::quote;
use syn::Token;
use syn::parse::{ParseStream, Parser};
use syn::token::{Brace, Bracket, Paren};

pub(crate) use scenes::{METHODS, PLANNED as PLANNED_METHODS};

use ast::{Ast, Item};
use tokens::{name, peek_word};

use crate::diagnostics::{Diagnostic, Sink};

/// The words that begin an item.
const ITEMS: [&str; 20] = [
    "units",
    "scalar",
    "arithmetic",
    "crate",
    "emit",
    "param",
    "ground",
    "link",
    "mass",
    "revolute",
    "prismatic",
    "slot",
    "weld",
    "gear",
    "drive",
    "assemble",
    "start",
    "unknown",
    "load",
    "scene",
];

/// Reads a declaration. `None` if even its header cannot be read.
pub fn parse(input: TokenStream, sink: &Sink) -> Option<Ast> {
    let read = |stream: ParseStream<'_>| Ok(declaration(stream, sink));
    match read.parse2(input) {
        Ok(ast) => ast,
        Err(error) => {
            sink.report(error);
            None
        }
    }
}

fn declaration(input: ParseStream<'_>, sink: &Sink) -> Option<Ast> {
    let header = header(input);
    let (attributes, visibility, name) = match header {
        Ok(header) => header,
        Err(error) => {
            sink.report(
                Diagnostic::from(error)
                    .help("a declaration begins with the module that it becomes: `pub mod four_bar;`"),
            );
            skip_all(input);
            return None;
        }
    };
    let mut items = Vec::new();
    while !input.is_empty() {
        items.push(item(input, sink));
    }
    Some(Ast { attributes, visibility, name, items })
}

fn header(input: ParseStream<'_>) -> syn::Result<(TokenStream, TokenStream, ast::Name)> {
    let mut attributes = TokenStream::new();
    while input.peek(Token![#]) {
        let pound: Token![#] = input.parse()?;
        let body;
        let _ = syn::bracketed!(body in input);
        let body: TokenStream = body.parse()?;
        attributes.extend(quote!(#pound [#body]));
    }
    let mut visibility = TokenStream::new();
    if input.peek(Token![pub]) {
        let token: Token![pub] = input.parse()?;
        visibility.extend(quote!(#token));
        if input.peek(Paren) {
            let scope;
            let _ = syn::parenthesized!(scope in input);
            let scope: TokenStream = scope.parse()?;
            visibility.extend(quote!((#scope)));
        }
    }
    input.parse::<Token![mod]>()?;
    let name = name(input)?;
    input.parse::<Token![;]>()?;
    Ok((attributes, visibility, name))
}

/// One item. On an error, what was left of it is passed over.
fn item(input: ParseStream<'_>, sink: &Sink) -> Item {
    let begin = input.fork();
    match items::item(input) {
        Ok(item) => item,
        Err(error) => {
            sink.report(error);
            pass_over(input, &begin);
            let keyword = begin.call(name).ok();
            let named = begin.call(name).ok();
            Item::Broken(keyword.zip(named).map(|(keyword, name)| ast::Broken { keyword, name }))
        }
    }
}

/// Goes on behind the item that began at `begin`: behind its `;` or its braces, or before the word that begins the next.
fn pass_over(input: ParseStream<'_>, begin: ParseStream<'_>) {
    if input.cursor() == begin.cursor() {
        skip_one(input);
    }
    while !input.is_empty() {
        if input.peek(Token![;]) {
            skip_one(input);
            return;
        }
        if input.peek(Brace) {
            skip_one(input);
            if input.peek(Token![;]) {
                skip_one(input);
            }
            return;
        }
        // `load F: force(coupler.C)  load G: …`: the second begins an item if what stands behind it could be its name.
        let begins_item = peek_word(input).is_some_and(|word| ITEMS.contains(&word.as_str()));
        if begins_item
            && !input.peek2(Token![:])
            && !input.peek2(Token![;])
            && !input.peek2(Token![,])
            && !input.peek2(Token![.])
        {
            return;
        }
        skip_one(input);
    }
}

fn skip_one(input: ParseStream<'_>) {
    // Taking one token tree off a stream that has one cannot fail.
    drop(input.parse::<proc_macro2::TokenTree>());
}

fn skip_all(input: ParseStream<'_>) {
    drop(input.parse::<TokenStream>());
}

/// Whether the next token opens a bracket of any kind.
fn at_group(input: ParseStream<'_>) -> bool {
    input.peek(Paren) || input.peek(Brace) || input.peek(Bracket)
}
