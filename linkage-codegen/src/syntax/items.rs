//! One parser per item, but for loads and scenes.

use syn::parse::ParseStream;
use syn::token::{Brace, Paren};
use syn::{Error, Result, Token};

use super::ast::{
    Assemble, Distances, Drive, Effort, End, Item, Joint, Link, Mass, Name, Param, PointPlace, PointRef, Unknown,
};
use super::quantity::{at_pair, direction, value, vector};
use super::tokens::{at_word, comma_list, eat_word, expect_word, name, peek_word, semicolon};
use super::{ITEMS, at_group, loads, scenes};
use crate::diagnostics::{Place, closest};

/// Reads an item.
pub(super) fn item(input: ParseStream<'_>) -> Result<Item> {
    let begin = input.fork();
    let Some(word) = peek_word(input) else {
        return Err(input.error("expected an item, such as `link`, `revolute` or `load`"));
    };
    if word == "crate" {
        return crate_path(input);
    }
    let keyword = name(input)?;
    match word.as_str() {
        "units" => units(input),
        "scalar" => Ok(Item::Scalar(closing_name(input)?)),
        "arithmetic" => Ok(Item::Arithmetic(closing_name(input)?)),
        "emit" => Ok(Item::Emit(closing_name(input)?)),
        "param" => param(input),
        "ground" => link(input, &keyword, None),
        "link" => {
            let name = name(input)?;
            link(input, &keyword, Some(name))
        }
        "mass" => mass(input),
        "revolute" | "prismatic" => joint(input, keyword),
        "slot" | "weld" | "gear" => planned_joint(input, keyword),
        "drive" => drive(input),
        "assemble" => assemble(input, &keyword),
        "start" => {
            rest(input)?;
            Ok(Item::Start(keyword.place()))
        }
        "unknown" => unknown(input),
        "load" => loads::load(input),
        "scene" => scenes::scene(input),
        _ => {
            let help = closest(&word, ITEMS).map_or_else(
                || format!("an item begins with one of {}", ITEMS.join(", ")),
                |near| format!("did you mean `{near}`?"),
            );
            Err(Error::new(begin.span(), format!("there is no item `{word}`\nhelp: {help}")))
        }
    }
}

/// Takes what is left of an item whose inside is not read.
pub(super) fn rest(input: ParseStream<'_>) -> Result<()> {
    while !input.is_empty() && !input.peek(Token![;]) {
        let braces = input.peek(Brace);
        input.parse::<proc_macro2::TokenTree>()?;
        if braces {
            break;
        }
    }
    if input.peek(Token![;]) {
        input.parse::<Token![;]>()?;
    }
    Ok(())
}

fn closing_name(input: ParseStream<'_>) -> Result<Name> {
    let name = name(input)?;
    semicolon(input)?;
    Ok(name)
}

fn crate_path(input: ParseStream<'_>) -> Result<Item> {
    input.parse::<Token![crate]>()?;
    input.parse::<Token![=]>()?;
    let mut path = proc_macro2::TokenStream::new();
    while !input.is_empty() && !input.peek(Token![;]) {
        path.extend([input.parse::<proc_macro2::TokenTree>()?]);
    }
    if path.is_empty() {
        return Err(input.error("expected a path, as in `crate = ::my_runtime;`"));
    }
    semicolon(input)?;
    Ok(Item::Crate(path))
}

fn units(input: ParseStream<'_>) -> Result<Item> {
    let content;
    let _ = syn::braced!(content in input);
    let names = comma_list(&content, name)?;
    optional_semicolon(input)?;
    Ok(Item::Units(names))
}

fn optional_semicolon(input: ParseStream<'_>) -> Result<()> {
    if input.peek(Token![;]) { input.parse::<Token![;]>().map(drop) } else { Ok(()) }
}

fn colon_name(input: ParseStream<'_>) -> Result<Name> {
    let name = name(input)?;
    input.parse::<Token![:]>()?;
    Ok(name)
}

fn param(input: ParseStream<'_>) -> Result<Item> {
    let name_ = colon_name(input)?;
    let dimension = name(input)?;
    let default = if input.peek(Token![=]) {
        input.parse::<Token![=]>()?;
        Some(value(input)?)
    } else {
        None
    };
    semicolon(input)?;
    Ok(Item::Param(Param { name: name_, dimension, default }))
}

fn link(input: ParseStream<'_>, keyword: &Name, name: Option<Name>) -> Result<Item> {
    let content;
    let _ = syn::braced!(content in input);
    let places = comma_list(&content, point_place)?;
    optional_semicolon(input)?;
    Ok(Item::Link(Link { name, keyword: keyword.span, places }))
}

fn point_place(input: ParseStream<'_>) -> Result<PointPlace> {
    let point = name(input)?;
    if input.peek(Token![->]) {
        input.parse::<Token![->]>()?;
        let to = name(input)?;
        input.parse::<Token![:]>()?;
        return Ok(PointPlace::Frame(point, to, value(input)?));
    }
    if !input.peek(Token![:]) {
        return Ok(PointPlace::Origin(point));
    }
    input.parse::<Token![:]>()?;
    let by_distances = (at_word(input, "left") || at_word(input, "right")) && input.peek2(Paren);
    if !by_distances {
        return Ok(PointPlace::At(point, vector(input)?));
    }
    let side = name(input)?;
    let content;
    let parens = syn::parenthesized!(content in input);
    let from = name(&content)?;
    content.parse::<Token![->]>()?;
    let to = name(&content)?;
    content.parse::<Token![,]>()?;
    let from_distance = value(&content)?;
    content.parse::<Token![,]>()?;
    let to_distance = value(&content)?;
    optional_comma(&content)?;
    let place = side.place().to(Place::at(parens.span.close()));
    let distances = Distances { left: side.text == "left", from, to, from_distance, to_distance, place };
    Ok(PointPlace::Distances(point, Box::new(distances)))
}

fn optional_comma(input: ParseStream<'_>) -> Result<()> {
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
    }
    if input.is_empty() { Ok(()) } else { Err(input.error("expected `)`")) }
}

fn mass(input: ParseStream<'_>) -> Result<Item> {
    let link = colon_name(input)?;
    let mass = value(input)?;
    expect_word(input, "at")?;
    let named = !at_pair(input) && (input.peek2(Token![,]) || input.peek2(Token![;]));
    let at = if named { PointRef::Named(name(input)?) } else { PointRef::At(vector(input)?) };
    let mut inertia = None;
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
        expect_word(input, "inertia")?;
        inertia = Some(value(input)?);
    }
    semicolon(input)?;
    Ok(Item::Mass(Mass { link, mass, at, inertia }))
}

/// `LINK` or `LINK.POINT`
pub(super) fn end(input: ParseStream<'_>) -> Result<End> {
    let link = name(input)?;
    let point = if input.peek(Token![.]) {
        input.parse::<Token![.]>()?;
        Some(name(input)?)
    } else {
        None
    };
    Ok(End { link, point })
}

fn joint(input: ParseStream<'_>, keyword: Name) -> Result<Item> {
    let name = colon_name(input)?;
    let from = end(input)?;
    input.parse::<Token![->]>()?;
    let to = end(input)?;
    let along = if eat_word(input, "along") { Some(direction(input)?) } else { None };
    let mut angle = None;
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
        expect_word(input, "angle")?;
        angle = Some(value(input)?);
    }
    semicolon(input)?;
    let slides = keyword.text == "prismatic";
    if slides && along.is_none() {
        return Err(Error::new(
            name.span,
            format!(
                "the prismatic joint `{name}` has no direction\nhelp: say along which line it slides: `along 0deg`"
            ),
        ));
    }
    if !slides && (along.is_some() || angle.is_some()) {
        let what = if along.is_some() { "slides along nothing" } else { "has no fixed angle" };
        return Err(Error::new(name.span, format!("the revolute joint `{name}` {what}")));
    }
    Ok(Item::Joint(Joint { name, keyword, from, to, along, angle }))
}

/// A joint that is not carried out yet: its ends are read, so that the links count as connected.
fn planned_joint(input: ParseStream<'_>, keyword: Name) -> Result<Item> {
    let name = colon_name(input)?;
    let from = end(input)?;
    input.parse::<Token![->]>()?;
    let to = end(input)?;
    rest(input)?;
    Ok(Item::Joint(Joint { name, keyword, from, to, along: None, angle: None }))
}

fn drive(input: ParseStream<'_>) -> Result<Item> {
    let name_ = colon_name(input)?;
    let joint = name(input)?;
    let coordinate = if input.peek(Token![.]) {
        input.parse::<Token![.]>()?;
        Some(name(input)?)
    } else {
        None
    };
    let motion = if input.peek(Brace) {
        let place = Place::at(input.span());
        input.parse::<proc_macro2::TokenTree>()?;
        optional_semicolon(input)?;
        Some(place)
    } else {
        semicolon(input)?;
        None
    };
    Ok(Item::Drive(Drive { name: name_, joint, coordinate, motion }))
}

fn assemble(input: ParseStream<'_>, keyword: &Name) -> Result<Item> {
    let joint = colon_name(input)?;
    let side = name(input)?;
    let content;
    if !input.peek(Paren) {
        return Err(input.error("expected the joints in parentheses, as in `left(A -> B0)` or `ahead(A)`"));
    }
    let _ = syn::parenthesized!(content in input);
    let mut joints = vec![name(&content)?];
    if content.peek(Token![->]) {
        content.parse::<Token![->]>()?;
        joints.push(name(&content)?);
    }
    optional_comma(&content)?;
    let smooth = if eat_word(input, "smooth") {
        expect_word(input, "at")?;
        Some(value(input)?)
    } else {
        None
    };
    semicolon(input)?;
    Ok(Item::Assemble(Assemble { joint, side, joints, smooth, keyword: keyword.span }))
}

fn unknown(input: ParseStream<'_>) -> Result<Item> {
    let name_ = colon_name(input)?;
    let word = name(input)?;
    if !at_group(input) {
        return Err(input.error(format!("expected `({})`", "…")));
    }
    let effort = match word.text.as_str() {
        "torque" => {
            let content;
            let _ = syn::parenthesized!(content in input);
            let from = name(&content)?;
            content.parse::<Token![->]>().map_err(|e| {
                Error::new(e.span(), "a torque acts between two links\nhelp: write `torque(ground -> crank)`: on the second, by the first")
            })?;
            let to = name(&content)?;
            optional_comma(&content)?;
            Effort::Torque(from, to)
        }
        "force" => {
            let content;
            let _ = syn::parenthesized!(content in input);
            let at = end(&content)?;
            optional_comma(&content)?;
            expect_word(input, "along")?;
            Effort::Force(at, direction(input)?)
        }
        "thrust" => {
            input.parse::<proc_macro2::TokenTree>()?;
            Effort::Thrust(word.place())
        }
        other => {
            return Err(Error::new(
                word.span,
                format!("there is no unknown `{other}`\nhelp: an unknown is a `torque`, a `force` or a `thrust`"),
            ));
        }
    };
    semicolon(input)?;
    Ok(Item::Unknown(Unknown { name: name_, effort }))
}
