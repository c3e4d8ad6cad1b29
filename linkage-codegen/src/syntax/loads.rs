//! Loads.

use proc_macro2::TokenTree;
use syn::parse::ParseStream;
use syn::token::Paren;
use syn::{Error, Result, Token};

use super::ast::{Item, Load, LoadKind, words};
use super::items::{end, rest};
use super::quantity::magnitude;
use super::tokens::{between, eat_word, name};
use crate::diagnostics::{Diagnostic, Sink, closest};

const KINDS: [&str; 7] = ["force", "moment", "gravity", "thrust", "spring", "torsion", "inertia"];

pub(super) fn load(input: ParseStream<'_>, slips: &Sink) -> Result<Item> {
    let name_ = name(input)?;
    input.parse::<Token![:]>()?;
    let mut word = name(input)?;
    if !KINDS.contains(&word.text.as_str()) {
        let problem = format!("there is no kind of load `{word}`");
        let Some(meant) = closest(&word.text, KINDS) else {
            return Err(Error::new(word.span, format!("{problem}\nhelp: a load is one of {}", KINDS.join(", "))));
        };
        slips.report(Diagnostic::new(word.place(), problem).help(format!("did you mean `{meant}`?")));
        meant.clone_into(&mut word.text);
    }
    let kind = match word.text.as_str() {
        "force" => {
            let at = in_parentheses(input, "force(coupler.C)", end)?;
            let frame = if eat_word(input, "in") { Some(name(input)?) } else { None };
            LoadKind::Force { at, frame }
        }
        "moment" => in_parentheses(input, "moment(rocker)", moment)?,
        "gravity" => LoadKind::Gravity,
        _ => {
            let begin = input.fork();
            rest(input);
            let constant = is_constant(&word.text, &between(&begin, input));
            return Ok(Item::Load(Load { name: name_, kind: LoadKind::Planned(word, constant), magnitude: None }));
        }
    };
    let magnitude = if input.peek(Token![=]) {
        input.parse::<Token![=]>()?;
        Some(magnitude(input)?)
    } else {
        None
    };
    Ok(Item::Load(Load { name: name_, kind, magnitude }))
}

/// Whether a load of this kind that is written so has its value already.
pub(crate) fn is_constant(kind: &str, written: &[TokenTree]) -> bool {
    match kind {
        "inertia" => true,
        "spring" | "torsion" => !written.iter().any(|token| match token {
            TokenTree::Group(group) => words(group.stream()).iter().any(|word| word.text == "_"),
            _ => false,
        }),
        _ => written.iter().any(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == '=')),
    }
}

fn moment(input: ParseStream<'_>) -> Result<LoadKind> {
    let first = name(input)?;
    if !input.peek(Token![->]) {
        return Ok(LoadKind::Moment { from: None, on: first });
    }
    input.parse::<Token![->]>()?;
    Ok(LoadKind::Moment { from: Some(first), on: name(input)? })
}

fn in_parentheses<T>(input: ParseStream<'_>, example: &str, inside: fn(ParseStream<'_>) -> Result<T>) -> Result<T> {
    if !input.peek(Paren) {
        return Err(input.error(format!("expected `(`\nhelp: as in `{example}`")));
    }
    let content;
    let _ = syn::parenthesized!(content in input);
    let result = inside(&content)?;
    if content.is_empty() { Ok(result) } else { Err(content.error("expected `)`")) }
}
