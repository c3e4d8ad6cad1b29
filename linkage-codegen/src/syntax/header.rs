//! The module that a declaration becomes: attributes, visibility, name.

use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::token::{Brace, Bracket, Paren};
use syn::{Error, Lit, Result, Token};

use super::ast::Name;
use super::tokens::{name, peek_word, take};
use crate::diagnostics::{Diagnostic, Place, Sink};

const EXAMPLE: &str = "a declaration begins with the module that it becomes: `pub mod four_bar;`";

/// `attribute* visibility? mod NAME ;`; `None` without a usable name.
pub(super) fn header(input: ParseStream<'_>, sink: &Sink) -> Option<(TokenStream, TokenStream, Name)> {
    let begin = input.fork();
    let refuse = |error: Error| {
        let mut found = Diagnostic::from(error);
        if begin.is_empty() {
            found = Diagnostic::new(found.place(), "an empty declaration");
        }
        sink.report(found.help(EXAMPLE));
    };
    let (attributes, visibility, name) = read(input).map_err(refuse).ok()?;
    if !name.is_usable() {
        let problem = format!("`{name}` cannot be the name of a module: Rust keeps the word for itself");
        sink.report(Diagnostic::new(name.place(), problem).help("choose another name"));
        return None;
    }
    if input.peek(Token![;]) {
        take(input);
    } else {
        let found = Diagnostic::new(name.place(), format!("expected `;` behind `{name}`"));
        sink.report(if input.peek(Brace) {
            found.help(format!("the items stand without braces behind `mod {name};`"))
        } else {
            found.help(EXAMPLE)
        });
    }
    Some((attributes, visibility, name))
}

fn read(input: ParseStream<'_>) -> Result<(TokenStream, TokenStream, Name)> {
    let mut attributes = TokenStream::new();
    while input.peek(Token![#]) {
        let pound: Token![#] = input.parse()?;
        if !input.peek(Bracket) {
            return Err(input.error("expected an attribute, such as `#[doc(alias = \"linkage\")]`"));
        }
        let body;
        let _ = syn::bracketed!(body in input);
        check_attribute(&body.fork())?;
        let body: TokenStream = body.parse()?;
        attributes.extend(quote!(#pound [#body]));
    }
    let mut visibility = TokenStream::new();
    if input.peek(Token![pub]) {
        let token: Token![pub] = input.parse()?;
        visibility.extend(quote!(#token));
        if input.peek(Paren) {
            let scope;
            let parens = syn::parenthesized!(scope in input);
            let place = Place::at(parens.span.open()).to(Place::at(parens.span.close()));
            check_scope(&scope.fork()).map_err(|_| {
                let problem = "a visibility is `pub`, `pub(crate)`, `pub(super)` or `pub(in path)`";
                Error::new(place.start(), problem)
            })?;
            let scope: TokenStream = scope.parse()?;
            visibility.extend(quote!((#scope)));
        }
    }
    if !input.peek(Token![mod]) {
        return Err(input.error("expected `mod`"));
    }
    input.parse::<Token![mod]>()?;
    Ok((attributes, visibility, name(input)?))
}

/// `path`, `path(…)`, `path = literal` or `path = macro!(…)`.
fn check_attribute(body: ParseStream<'_>) -> Result<()> {
    if body.peek(Token![unsafe]) {
        body.parse::<Token![unsafe]>()?;
    } else {
        path(body)?;
    }
    if body.peek(Token![=]) {
        body.parse::<Token![=]>()?;
        if body.peek(Lit) {
            body.parse::<Lit>()?;
        } else {
            path(body)?;
            body.parse::<Token![!]>()?;
            body.parse::<proc_macro2::Group>()?;
        }
    } else if !body.is_empty() {
        body.parse::<proc_macro2::Group>()?;
    }
    if body.is_empty() { Ok(()) } else { Err(body.error("expected `]`")) }
}

fn check_scope(scope: ParseStream<'_>) -> Result<()> {
    match peek_word(scope).as_deref() {
        Some("in") => {
            name(scope)?;
            path(scope)?;
        }
        Some("crate" | "self" | "super") => drop(name(scope)?),
        _ => return Err(scope.error("expected `crate`")),
    }
    if scope.is_empty() { Ok(()) } else { Err(scope.error("expected `)`")) }
}

/// `::a::b`: names with `::` between.
pub(super) fn path(input: ParseStream<'_>) -> Result<TokenStream> {
    let mut path = TokenStream::new();
    if input.peek(Token![::]) {
        let colons: Token![::] = input.parse()?;
        path.extend(quote!(#colons));
    }
    loop {
        let special = peek_word(input).is_some_and(|word| matches!(word.as_str(), "crate" | "self" | "super"));
        let word = if special { input.call(syn::Ident::parse_any)? } else { input.parse()? };
        path.extend(quote!(#word));
        if !input.peek(Token![::]) {
            return Ok(path);
        }
        let colons: Token![::] = input.parse()?;
        path.extend(quote!(#colons));
    }
}
