//! Loads.

use syn::parse::ParseStream;
use syn::token::Paren;
use syn::{Error, Result, Token};

use super::ast::{Item, Load, LoadKind};
use super::items::{end, rest};
use super::quantity::magnitude;
use super::tokens::{eat_word, name, semicolon};
use crate::diagnostics::closest;

const KINDS: [&str; 7] = ["force", "moment", "gravity", "thrust", "spring", "torsion", "inertia"];

pub(super) fn load(input: ParseStream<'_>) -> Result<Item> {
    let name_ = name(input)?;
    input.parse::<Token![:]>()?;
    let word = name(input)?;
    let kind = match word.text.as_str() {
        "force" => {
            let at = in_parentheses(input, "force(coupler.C)", end)?;
            let frame = if eat_word(input, "in") { Some(name(input)?) } else { None };
            LoadKind::Force { at, frame }
        }
        "moment" => in_parentheses(input, "moment(rocker)", moment)?,
        "gravity" => LoadKind::Gravity,
        "thrust" | "spring" | "torsion" | "inertia" => {
            rest(input)?;
            return Ok(Item::Load(Load { name: name_, kind: LoadKind::Planned(word), magnitude: None }));
        }
        other => {
            let help = closest(other, KINDS).map_or_else(
                || format!("a load is one of {}", KINDS.join(", ")),
                |near| format!("did you mean `{near}`?"),
            );
            return Err(Error::new(word.span, format!("there is no load `{other}`\nhelp: {help}")));
        }
    };
    let magnitude = if input.peek(Token![=]) {
        input.parse::<Token![=]>()?;
        Some(magnitude(input)?)
    } else {
        None
    };
    semicolon(input)?;
    Ok(Item::Load(Load { name: name_, kind, magnitude }))
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
        return Err(input.error(format!("expected parentheses, as in `{example}`")));
    }
    let content;
    let _ = syn::parenthesized!(content in input);
    let result = inside(&content)?;
    if content.is_empty() { Ok(result) } else { Err(content.error("expected `)`")) }
}
