//! Tokens in, [`Ast`] out. Afterwards every item has the shape that the grammar gives it; names and dimensions are unchecked.
//!
//! An item that cannot be read is reported, and reading goes on behind it.

pub mod ast;
mod header;
mod hyphens;
mod items;
mod loads;
mod quantity;
mod recovery;
mod scenes;
mod tokens;

use proc_macro2::{TokenStream, TokenTree};
use syn::Token;
use syn::parse::discouraged::Speculative;
use syn::parse::{ParseStream, Parser};
use syn::token::Brace;

pub(crate) use items::SIDES;
pub(crate) use loads::is_given_at_run_time;
pub(crate) use scenes::METHODS;

use ast::{Ast, Item};
use recovery::{at_item, pass_over, unread};
use tokens::{NO_ATTRIBUTES, between, place_of, take};

use crate::diagnostics::{Diagnostic, Place, Sink};

/// Brackets in brackets.
const DEPTH: usize = 128;
/// Characters of a number. A double written out has up to 1,075 digits.
const LENGTH: usize = 4096;

/// The words of joints.
pub(crate) const JOINTS: [&str; 5] = ["revolute", "prismatic", "slot", "weld", "gear"];

/// Names of functions in expressions.
pub(crate) const FUNCTIONS: [&str; 8] = ["sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2"];

/// The words that begin an item.
pub const ITEMS: [&str; 20] = [
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

/// Other words for items, of the field and of other programs: in front of braces, and otherwise.
const OTHER_WORDS: [(&str, &str, &str); 17] = [
    ("let", "param", "param"),
    ("const", "param", "param"),
    ("pin", "link", "revolute"),
    ("hinge", "link", "revolute"),
    ("pivot", "link", "revolute"),
    ("slide", "link", "prismatic"),
    ("slider", "link", "prismatic"),
    ("rigid", "link", "weld"),
    ("fixed", "ground", "weld"),
    ("body", "link", "link"),
    ("bar", "link", "link"),
    ("frame", "ground", "ground"),
    ("motor", "drive", "drive"),
    ("actuator", "drive", "drive"),
    ("input", "drive", "drive"),
    ("closure", "assemble", "assemble"),
    ("solve", "scene", "scene"),
];

/// Reads a declaration. `None` if even its header cannot be read.
pub fn parse(input: TokenStream, sink: &Sink) -> Option<Ast> {
    if let Some(excess) = excess(&input) {
        sink.report(excess);
        return None;
    }
    let read = |stream: ParseStream<'_>| Ok(declaration(stream, sink));
    match read.parse2(hyphens::joined(input, sink)) {
        Ok(ast) => ast,
        Err(error) => {
            sink.report(error);
            None
        }
    }
}

/// A bracket that is nested too deeply, or a number that is too long: reading them would take too much stack or time.
fn excess(input: &TokenStream) -> Option<Diagnostic> {
    let mut open: Vec<(usize, TokenTree)> = input.clone().into_iter().map(|token| (0, token)).collect();
    while let Some((depth, token)) = open.pop() {
        match token {
            TokenTree::Group(group) if depth == DEPTH => {
                let problem = format!("brackets are nested more than {DEPTH} deep");
                return Some(Diagnostic::new(Place::at(group.span_open()), problem));
            }
            TokenTree::Group(group) => open.extend(group.stream().into_iter().map(|token| (depth + 1, token))),
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                if text.len() > LENGTH && text.starts_with(|first: char| first.is_ascii_digit()) {
                    let problem = format!("this number has more than {LENGTH} characters");
                    return Some(Diagnostic::new(Place::at(literal.span()), problem));
                }
            }
            TokenTree::Ident(_) | TokenTree::Punct(_) => {}
        }
    }
    None
}

fn declaration(input: ParseStream<'_>, sink: &Sink) -> Option<Ast> {
    let Some((attributes, visibility, name)) = header::header(input, sink) else {
        while take(input).is_some() {}
        return None;
    };
    let mut items = Vec::new();
    if input.peek(Brace) {
        drop(items_in_braces(input, &mut items, sink));
    }
    all_items(input, &mut items, sink);
    Some(Ast { attributes, visibility, name, items })
}

/// As a module of Rust has them. That is reported with the header.
fn items_in_braces(input: ParseStream<'_>, items: &mut Vec<Item>, sink: &Sink) -> syn::Result<()> {
    let content;
    let _ = syn::braced!(content in input);
    all_items(&content, items, sink);
    Ok(())
}

fn all_items(input: ParseStream<'_>, items: &mut Vec<Item>, sink: &Sink) {
    while !input.is_empty() {
        if let Some(place) = attributes_of_item(input) {
            sink.report(Diagnostic::new(place, NO_ATTRIBUTES));
            continue;
        }
        items.push(item(input, sink));
    }
}

/// Passes over `#[…]`; documentation comments are such attributes.
fn attributes_of_item(input: ParseStream<'_>) -> Option<Place> {
    let begin = input.fork();
    while input.peek(Token![#]) && input.peek2(syn::token::Bracket) {
        take(input);
        take(input);
    }
    place_of(&between(&begin, input))
}

/// One item. On an error, what was left of it is passed over.
fn item(input: ParseStream<'_>, sink: &Sink) -> Item {
    let begin = input.fork();
    // What cannot be read leaves no traces in the stream itself.
    let ahead = input.fork();
    let slips = Sink::default();
    let read = items::item(&ahead, &slips).and_then(|item| {
        close(&ahead, &begin, &slips)?;
        Ok(item)
    });
    let slips = slips.into_errors();
    let keyword = begin.fork().call(tokens::name).ok();
    match read {
        Ok(item) => {
            input.advance_to(&ahead);
            slips.into_iter().for_each(|slip| sink.report(slip));
            item
        }
        Err(error) => {
            pass_over(input);
            let passed = between(&begin, input);
            // A word that was corrected in vain is the error; what came of it is none.
            if slips.is_empty() {
                sink.report(unread(error, keyword.as_ref(), &passed, ahead.is_empty()));
            }
            slips.into_iter().for_each(|slip| sink.report(slip));
            recovery::broken(keyword, passed)
        }
    }
}

/// The `;` behind an item; behind braces it may be left out.
fn close(input: ParseStream<'_>, begin: ParseStream<'_>, slips: &Sink) -> syn::Result<()> {
    if input.peek(Token![;]) {
        take(input);
        return Ok(());
    }
    let read = between(begin, input);
    let last = read.last();
    if matches!(last, Some(TokenTree::Group(group)) if group.delimiter() == proc_macro2::Delimiter::Brace) {
        return Ok(());
    }
    if !input.is_empty() && !at_item(input) {
        let found = input.fork().parse::<TokenTree>().map_or_else(|_| String::new(), |token| recovery::shown(&token));
        return Err(input.error(format!("expected `;`, found {found}")));
    }
    let place = last.and_then(|last| place_of(core::slice::from_ref(last)));
    slips.report(Diagnostic::new(
        place.unwrap_or(Place::at(input.span())),
        format!("expected `;` behind {}", last.map_or_else(|| "the item".to_owned(), recovery::shown)),
    ));
    Ok(())
}
