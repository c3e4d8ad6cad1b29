//! Scenes.

use syn::parse::ParseStream;
use syn::token::Paren;
use syn::{Result, Token};

use super::ast::{Item, ResultItem, Scene};
use super::items::{end, rest};
use super::tokens::{comma_list, eat_word, name, semicolon};

/// The methods whose parentheses hold loads and whose results are named.
pub(crate) const METHODS: [&str; 5] = ["position", "equilibrium", "superposition", "virtual_work", "verify"];
/// The methods that are not carried out yet.
pub(crate) const PLANNED: [&str; 6] = ["velocity", "acceleration", "motion", "sweep", "derivative", "inverse"];

pub(super) fn scene(input: ParseStream<'_>) -> Result<Item> {
    let name_ = name(input)?;
    input.parse::<Token![:]>()?;
    let method = name(input)?;
    if !METHODS.contains(&method.text.as_str()) {
        // Whether planned or unknown, the model says what is wrong with it.
        rest(input)?;
        return Ok(Item::Scene(Scene { name: name_, method, loads: None, results: None }));
    }
    let mut loads = None;
    if input.peek(Paren) {
        let content;
        let _ = syn::parenthesized!(content in input);
        loads = Some(comma_list(&content, name)?);
    }
    let mut results = None;
    if input.peek(Token![->]) {
        input.parse::<Token![->]>()?;
        if !input.peek(Paren) {
            return Err(input.error("expected the results in parentheses, as in `-> (T12)`"));
        }
        let content;
        let _ = syn::parenthesized!(content in input);
        results = Some(comma_list(&content, result)?);
    }
    semicolon(input)?;
    Ok(Item::Scene(Scene { name: name_, method, loads, results }))
}

fn result(input: ParseStream<'_>) -> Result<ResultItem> {
    let item = end(input)?;
    if eat_word(input, "along") {
        name(input)?;
        return Ok(ResultItem::Planned(item.place(), "a reaction resolved along a link"));
    }
    if eat_word(input, "about") {
        end(input)?;
        return Ok(ResultItem::Planned(item.place(), "a couple about another point"));
    }
    if item.point.is_none() && item.link.text == "error_bound" {
        return Ok(ResultItem::Planned(item.place(), "the bound of the error"));
    }
    Ok(match item.point {
        None => ResultItem::Name(item.link),
        Some(point) => ResultItem::Point(item.link, point),
    })
}
