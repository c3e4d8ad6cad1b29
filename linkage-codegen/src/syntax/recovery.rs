//! What happens to an item that cannot be read: its error with an example, its name, and where the next item begins.

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use syn::parse::ParseStream;
use syn::token::Brace;
use syn::{Error, Token};

use super::ITEMS;
use super::ast::{Broken, Item, Name};
use super::items::meant;
use super::loads;
use super::tokens::{name, peek_word, place_of, take};
use crate::diagnostics::Diagnostic;

/// An item of each kind.
fn example(keyword: &str) -> Option<&'static str> {
    Some(match keyword {
        "units" => "units { mm, N }",
        "scalar" => "scalar f32;",
        "arithmetic" => "arithmetic plain;",
        "crate" => "crate = ::my_runtime;",
        "emit" => "emit source;",
        "param" => "param l2: length = 80mm;",
        "ground" => "ground { A0: (0, 0), B0: (140mm, 0) }",
        "link" => "link coupler { A -> B: 100mm, C: (50mm, 20mm) }",
        "mass" => "mass coupler: 0.6kg at (50mm, 0), inertia 1900kg*mm^2;",
        "revolute" => "revolute A: crank -> coupler;",
        "prismatic" => "prismatic C: ground -> piston along 0deg;",
        "slot" => "slot S: lever.O -> block.S along 0deg of lever;",
        "weld" => "weld W: bracket -> arm, angle 30deg;",
        "gear" => "gear G: sun.O -> planet.P, radii (20mm, 30mm);",
        "drive" => "drive theta: A0;",
        "assemble" => "assemble B: left(A -> B0);",
        "unknown" => "unknown T12: torque(ground -> crank);",
        "scene" => "scene torque: virtual_work(F) -> (T12);",
        _ => return None,
    })
}

/// A load of the kind that is written behind the load's name, else a force.
fn example_of_load(item: &[TokenTree]) -> Option<&'static str> {
    let behind_name = item.iter().skip(2);
    let kind = behind_name.map(ToString::to_string).find_map(|word| loads::example(&word));
    kind.or_else(|| loads::example("force"))
}

/// The error of an item, with an example of one if it has no other help.
pub(super) fn unread(error: Error, keyword: Option<&Name>, passed: &[TokenTree], at_end: bool) -> Diagnostic {
    let at_end = at_end && error.to_string().starts_with("unexpected end of input");
    let mut found = Diagnostic::from(error);
    if let (true, Some(last)) = (at_end, passed.last()) {
        // The end of the declaration has no place of its own.
        found = found.moved(place_of(core::slice::from_ref(last)));
    }
    let example =
        keyword.and_then(|word| if word.text == "load" { example_of_load(passed) } else { example(&word.text) });
    match example {
        Some(example) if !found.message().contains("\nhelp:") => found.help(format!("as in `{example}`")),
        _ => found,
    }
}

/// What is known of an item: keyword, name, and the rest.
pub(super) fn broken(keyword: Option<Name>, passed: Vec<TokenTree>) -> Item {
    let has_braces = matches!(passed.last(), Some(TokenTree::Group(last)) if last.delimiter() == Delimiter::Brace);
    let mut rest = passed.into_iter().peekable();
    let written = keyword.clone();
    let keyword = keyword.map(|word| {
        rest.next();
        let own = ITEMS.into_iter().find(|item| *item == word.text);
        // A load by the word of its kind alone.
        let load = loads::example(&word.text).map(|_| "load");
        match own.or(load).or_else(|| meant(&word.text, has_braces)) {
            Some(meant) => Name { text: meant.to_owned(), span: word.span },
            None => word.clone(),
        }
    });
    let kind = keyword.as_ref().zip(written).filter(|(keyword, _)| keyword.text == "load");
    let kind = kind.filter(|(_, word)| loads::example(&word.text).is_some());
    let kind = kind.map(|(_, word)| TokenTree::from(Ident::new(&word.text, word.span)));
    let named = keyword.as_ref().is_some_and(|word| !matches!(word.text.as_str(), "ground" | "units" | "crate"));
    let name = match rest.peek() {
        Some(TokenTree::Ident(ident)) if named => Some(Name::of(ident)),
        _ => None,
    };
    if name.is_some() {
        rest.next();
    }
    // In front of an arrow or a point stands a link.
    let is_end = matches!(rest.peek(), Some(TokenTree::Punct(next)) if matches!(next.as_char(), '-' | '.'));
    let name = name.filter(|_| !is_end);
    Item::Broken(Broken { keyword, name, rest: kind.into_iter().chain(rest).collect::<TokenStream>() })
}

/// Goes on behind the item that begins here: behind its `;` or its braces, or before the next item.
pub(super) fn pass_over(input: ParseStream<'_>) {
    take(input);
    while !input.is_empty() && !at_item(input) {
        let braces = input.peek(Brace);
        if input.peek(Token![;]) {
            take(input);
            return;
        }
        take(input);
        if braces {
            if input.peek(Token![;]) {
                take(input);
            }
            return;
        }
    }
}

/// Whether an item begins here: `load F:`, `link crank {`, `ground {`, …
pub(super) fn at_item(input: ParseStream<'_>) -> bool {
    let Some(word) = peek_word(input).filter(|word| ITEMS.contains(&word.as_str())) else { return false };
    let ahead = input.fork();
    take(&ahead);
    match word.as_str() {
        "ground" | "units" => return ahead.peek(Brace),
        "crate" => return ahead.peek(Token![=]),
        _ => {}
    }
    if ahead.call(name).is_err() {
        return false;
    }
    match word.as_str() {
        "scalar" | "arithmetic" | "emit" => ahead.peek(Token![;]),
        "link" => ahead.peek(Brace),
        _ => ahead.peek(Token![:]) && !ahead.peek(Token![::]),
    }
}

/// A token in a message.
pub(super) fn shown(token: &TokenTree) -> String {
    match token {
        TokenTree::Group(group) => match group.delimiter() {
            Delimiter::Parenthesis => "`( … )`".into(),
            Delimiter::Brace => "`{ … }`".into(),
            Delimiter::Bracket => "`[ … ]`".into(),
            Delimiter::None => "a group".into(),
        },
        other => format!("`{other}`"),
    }
}
