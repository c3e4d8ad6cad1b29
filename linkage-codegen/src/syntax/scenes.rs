//! Scenes.

use syn::parse::ParseStream;
use syn::token::Paren;
use syn::{Result, Token};

use super::ast::{Derivative, Item, ResultItem, Scene};
use super::items::{end, rest};
use super::tokens::{between, comma_list, eat_word, name, place_of, take};
use crate::diagnostics::{Diagnostic, Place, Sink, closest};

/// The methods that are carried out.
pub(crate) const METHODS: [&str; 12] = [
    "position",
    "velocity",
    "acceleration",
    "coefficients",
    "equilibrium",
    "superposition",
    "virtual_work",
    "motion",
    "inverse",
    "verify",
    "sweep",
    "derivative",
];

pub(super) fn scene(input: ParseStream<'_>, slips: &Sink) -> Result<Item> {
    let name_ = name(input)?;
    input.parse::<Token![:]>()?;
    let mut method = name(input)?;
    if !METHODS.contains(&method.text.as_str())
        && let Some(meant) = closest(&method.text, METHODS)
    {
        let problem = format!("there is no method `{method}`");
        slips.report(Diagnostic::new(method.place(), problem).help(format!("did you mean `{meant}`?")));
        meant.clone_into(&mut method.text);
    }
    if !METHODS.contains(&method.text.as_str()) {
        // The model says what is wrong with it.
        rest(input);
        let (loads, results, derivative) = (None, None, None);
        return Ok(Item::Scene(Scene { name: name_, method, loads, wanted: Vec::new(), results, derivative }));
    }
    if method.text == "derivative" {
        let (wanted, derivative) = (Vec::new(), Some(derivative(input, slips)?));
        return Ok(Item::Scene(Scene { name: name_, method, loads: None, wanted, results: None, derivative }));
    }
    let (mut loads, mut wanted) = (None, Vec::new());
    if input.peek(Paren) {
        let content;
        let _ = syn::parenthesized!(content in input);
        match method.text.as_str() {
            "inverse" => wanted = comma_list(&content, end)?,
            _ => loads = Some(comma_list(&content, name)?),
        }
    }
    let mut results = None;
    if input.peek(Token![->]) {
        input.parse::<Token![->]>()?;
        results = Some(result_list(input, slips)?);
    }
    Ok(Item::Scene(Scene { name: name_, method, loads, wanted, results, derivative: None }))
}

/// `(statics) by (theta, F13)`
fn derivative(input: ParseStream<'_>, slips: &Sink) -> Result<Derivative> {
    let form = |of: &str| format!("as in `derivative({of}) by (theta)`");
    let begin = input.fork();
    let scenes = if input.peek(Paren) {
        let content;
        let _ = syn::parenthesized!(content in input);
        comma_list(&content, name)?
    } else {
        vec![name(input)?]
    };
    let Some(of) = scenes.first().cloned() else {
        return Err(begin.error(format!("a derivative is that of a scene\nhelp: {}", form("statics"))));
    };
    if let Some(other) = scenes.get(1) {
        slips.report(
            Diagnostic::new(other.place(), "one scene is differentiated at a time").help("declare a scene for each"),
        );
    }
    if !eat_word(input, "by") {
        return Err(input.error(format!("expected what varies\nhelp: {}", form(&of.text))));
    }
    let by = if input.peek(Paren) {
        let content;
        let _ = syn::parenthesized!(content in input);
        comma_list(&content, end)?
    } else {
        vec![end(input)?]
    };
    if input.peek(Token![->]) {
        let begin = input.fork();
        input.parse::<Token![->]>()?;
        result_list(input, slips)?;
        let place = place_of(&between(&begin, input)).unwrap_or(Place::at(begin.span()));
        slips.report(
            Diagnostic::new(place, "a derivative has the results of its scene")
                .help(format!("leave the list out, or list them in the scene `{of}`")),
        );
    }
    Ok(Derivative { of, by })
}

/// `( … )`; without parentheses it is clear what is meant, too.
fn result_list(input: ParseStream<'_>, slips: &Sink) -> Result<Vec<ResultItem>> {
    if input.peek(Paren) {
        let content;
        let _ = syn::parenthesized!(content in input);
        return comma_list(&content, result);
    }
    let begin = input.fork();
    let mut results = vec![result(input)?];
    while input.peek(Token![,]) {
        take(input);
        results.push(result(input)?);
    }
    let written = between(&begin, input);
    let text: Vec<String> = results.iter().map(shown).collect();
    let place = place_of(&written).unwrap_or(Place::at(begin.span()));
    slips.report(
        Diagnostic::new(place, "the results of a scene stand in parentheses")
            .help(format!("write `-> ({})`", text.join(", "))),
    );
    Ok(results)
}

fn shown(result: &ResultItem) -> String {
    match result {
        ResultItem::Name(name) => name.text.clone(),
        ResultItem::Point(link, point) => format!("{link}.{point}"),
        ResultItem::Along(joint, link) => format!("{} along {link}", joint.written()),
        ResultItem::About(joint, point) => format!("{} about {}", joint.written(), point.written()),
        ResultItem::OfLink(what, link) => format!("{what}({link})"),
        ResultItem::OfPoint(what, point) => format!("{what}({})", point.written()),
    }
}

fn result(input: ParseStream<'_>) -> Result<ResultItem> {
    let item = end(input)?;
    if item.point.is_none() && input.peek(Paren) {
        let content;
        let _ = syn::parenthesized!(content in input);
        let of = end(&content)?;
        return if !content.is_empty() {
            Err(content.error("expected `)`"))
        } else if of.point.is_none() {
            Ok(ResultItem::OfLink(item.link, of.link))
        } else {
            Ok(ResultItem::OfPoint(item.link, of))
        };
    }
    if input.peek(Token![.]) {
        let (whole, part) = (item.written(), input.fork());
        take(&part);
        let problem = format!("a result is given as a whole\nhelp: write `{whole}`, and read its parts in the code");
        return Err(part.error(problem));
    }
    if eat_word(input, "along") {
        let link = name(input)?;
        if input.peek(Token![.]) {
            let problem = format!("behind `along` stands a link, and no point of it\nhelp: write `along {link}`");
            return Err(input.error(problem));
        }
        return Ok(ResultItem::Along(item, link));
    }
    if eat_word(input, "about") {
        return Ok(ResultItem::About(item, end(input)?));
    }
    Ok(match item.point {
        None => ResultItem::Name(item.link),
        Some(point) => ResultItem::Point(item.link, point),
    })
}
