//! Loads.

use proc_macro2::TokenTree;
use syn::parse::ParseStream;
use syn::token::{Brace, Paren};
use syn::{Error, Result, Token};

use super::ast::{End, Item, Load, LoadKind, Name, SpringField, words};
use super::items::end;
use super::quantity::{magnitude, value};
use super::tokens::{at_word, comma_list, eat_word, name, peek_word, take};
use crate::diagnostics::{Diagnostic, Sink, closest};

/// The kinds, with a load of each.
const KINDS: [(&str, &str); 7] = [
    ("force", "load F: force(coupler.C) = 100N @ 200deg;"),
    ("moment", "load M: moment(rocker) = -4N*m;"),
    ("gravity", "load W: gravity = 9.81m/s^2 @ -90deg;"),
    ("thrust", "load S: thrust(ground.P, rocker.D) = 250N;"),
    ("spring", "load K: spring(ground.P, rocker.D) { rate: 2N/mm, free: 60mm };"),
    ("torsion", "load K: torsion(ground -> crank) { rate: 3N*m/rad, free: 20deg };"),
    ("inertia", "load I: inertia;"),
];

/// A load of a kind.
pub(super) fn example(kind: &str) -> Option<&'static str> {
    KINDS.iter().find(|(known, _)| *known == kind).map(|(_, example)| *example)
}

pub(super) fn load(input: ParseStream<'_>, slips: &Sink) -> Result<Item> {
    let name_ = name(input)?;
    input.parse::<Token![:]>()?;
    let mut word = name(input)?;
    if example(&word.text).is_none() {
        let problem = format!("there is no kind of load `{word}`");
        let kinds = KINDS.map(|(kind, _)| kind);
        // That is the word of unknowns.
        let meant = if word.text == "torque" { Some("moment") } else { closest(&word.text, kinds) };
        let Some(meant) = meant else {
            return Err(Error::new(word.span, format!("{problem}\nhelp: a load is one of {}", kinds.join(", "))));
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
        "thrust" => LoadKind::Thrust(in_parentheses(input, "thrust(ground.P, boom.Q)", two_ends)?),
        "spring" => {
            let ends = in_parentheses(input, "spring(ground.P, boom.Q)", two_ends)?;
            let fields = spring_fields(input, &name_, "{ rate: 2N/mm, free: 60mm }")?;
            return Ok(Item::Load(Load { name: name_, kind: LoadKind::Spring(ends, fields), magnitude: None }));
        }
        "torsion" => {
            let (from, on) = in_parentheses(input, "torsion(ground -> crank)", two_links)?;
            let fields = spring_fields(input, &name_, "{ rate: 3N*m/rad, free: 20deg }")?;
            return Ok(Item::Load(Load { name: name_, kind: LoadKind::Torsion { from, on, fields }, magnitude: None }));
        }
        _ => {
            let links = if input.peek(Paren) {
                Some(in_parentheses(input, "inertia(rod, piston)", |input| comma_list(input, name))?)
            } else {
                None
            };
            if input.peek(Token![=]) {
                let help = "masses and accelerations say how large it is: leave the value out";
                return Err(Error::new(word.span, format!("the inertia of links is not given\nhelp: {help}")));
            }
            return Ok(Item::Load(Load { name: name_, kind: LoadKind::Inertia(links), magnitude: None }));
        }
    };
    let magnitude = if input.peek(Token![=]) {
        input.parse::<Token![=]>()?;
        let size = magnitude(input)?;
        if word.text == "force" && at_word(input, "in") {
            let help = format!("as in `load {name_}: force(coupler.C) in coupler = (0, -3kN);`");
            return Err(input.error(format!("the frame of a force stands in front of its size\nhelp: {help}")));
        }
        if input.peek(Token![,]) {
            return Err(input.error("the components of a vector stand in parentheses\nhelp: write `= (x, y)`"));
        }
        Some(size)
    } else {
        None
    };
    Ok(Item::Load(Load { name: name_, kind, magnitude }))
}

/// Whether a value of a load of this kind, of a spring the named one, is given at run time if the load is written so.
pub(crate) fn is_given_at_run_time(kind: &str, written: &[TokenTree], value: &str) -> bool {
    match kind {
        "inertia" => false,
        "spring" | "torsion" => written.iter().any(|token| match token {
            TokenTree::Group(group) => {
                words(group.stream()).windows(2).any(|pair| pair[0].text == value && pair[1].text == "_")
            }
            _ => false,
        }),
        // A number that stands somewhere else is meant for its value, too.
        _ => {
            !written.iter().any(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == '=') || has_number(token))
        }
    }
}

fn has_number(token: &TokenTree) -> bool {
    match token {
        TokenTree::Group(group) => group.stream().into_iter().any(|token| has_number(&token)),
        other => matches!(other, TokenTree::Literal(_)),
    }
}

fn moment(input: ParseStream<'_>) -> Result<LoadKind> {
    let first = name(input)?;
    if input.peek(Token![.]) {
        let help = format!("leave the point out: `moment({first})`");
        return Err(input.error(format!("a moment acts on a whole link, and not at a point\nhelp: {help}")));
    }
    if !input.peek(Token![->]) {
        return Ok(LoadKind::Moment { from: None, on: first });
    }
    input.parse::<Token![->]>()?;
    Ok(LoadKind::Moment { from: Some(first), on: name(input)? })
}

/// `a.P, b.Q`
pub(super) fn two_ends(input: ParseStream<'_>) -> Result<[End; 2]> {
    let first = end(input)?;
    if input.peek(Token![->]) {
        return Err(input.error("a comma stands between the two points: `ground.P, boom.Q`"));
    }
    if !input.peek(Token![,]) {
        let help = "name the two points between which it acts: `ground.P, boom.Q`";
        return Err(Error::new(first.link.span, format!("two points are needed, and one is given\nhelp: {help}")));
    }
    input.parse::<Token![,]>()?;
    let second = end(input)?;
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
    }
    Ok([first, second])
}

/// How two links are written of which only the first stands as it should; what stands behind it may be the second.
pub(super) fn both_links(from: &Name, behind: ParseStream<'_>) -> String {
    let is_point = behind.peek(Token![.]);
    take(behind);
    if is_point {
        // The name of a point of the first, and the arrow.
        take(behind);
        let _ = behind.parse::<Token![->]>();
    }
    match name(behind) {
        Ok(to) => format!("{from} -> {to}"),
        Err(_) if from.text == "ground" => "ground -> crank".to_owned(),
        Err(_) => format!("ground -> {from}"),
    }
}

fn two_links(input: ParseStream<'_>) -> Result<(Name, Name)> {
    let from = name(input)?;
    if !input.peek(Token![->]) {
        let help = format!("name both: `{}`, on the second by the first", both_links(&from, input));
        return Err(Error::new(from.span, format!("a torsion spring acts between two links\nhelp: {help}")));
    }
    input.parse::<Token![->]>()?;
    Ok((from, name(input)?))
}

/// `{ rate: 2N/mm, free: _ }`
fn spring_fields(input: ParseStream<'_>, of: &Name, example: &str) -> Result<Vec<SpringField>> {
    if !input.peek(Brace) {
        let problem = format!("of the spring `{of}` only its place is said");
        return Err(Error::new(of.span, format!("{problem}\nhelp: say behind it how stiff it is: `{example}`")));
    }
    let content;
    let _ = syn::braced!(content in input);
    comma_list(&content, |input| {
        let name = name(input)?;
        input.parse::<Token![:]>()?;
        let value = if peek_word(input).as_deref() == Some("_") {
            take(input);
            None
        } else {
            Some(value(input)?)
        };
        Ok(SpringField { name, value })
    })
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
