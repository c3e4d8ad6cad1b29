//! One parser per item, but for loads and scenes. The `;` behind an item is not theirs.

use proc_macro2::{TokenStream, TokenTree};
use quote::quote;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::parse::discouraged::Speculative;
use syn::token::{Brace, Paren};
use syn::{Error, Result, Token};

use super::ast::Magnitude;
use super::ast::{
    Assemble, Distances, Drive, DriveMotion, Effort, End, Gear, Item, Joint, Link, Mass, Name, Param, PointPlace,
    PointRef, Smooth, Start, StartFrom, Unknown, Value, words,
};
use super::quantity::{direction, magnitude, value, vector};
use super::tokens::{at_word, between, comma_list, eat_word, expect_word, name, peek_word, place_of, take};
use super::{FUNCTIONS, ITEMS, OTHER_WORDS, header, loads, scenes};
use crate::diagnostics::{Diagnostic, Place, Sink, closest};

/// Reads an item. A word that was meant to be another one is a slip, and reading goes on as if it were that.
pub(super) fn item(input: ParseStream<'_>, slips: &Sink) -> Result<Item> {
    let begin = input.fork();
    if input.peek(Token![;]) || input.peek(Token![,]) {
        return Err(input.error("nothing stands between items but their own `;`\nhelp: leave this one out"));
    }
    if peek_word(input).is_none() {
        return Err(input.error("expected an item, such as `link`, `revolute` or `load`"));
    }
    let mut keyword = name(input)?;
    if !ITEMS.contains(&keyword.text.as_str()) {
        let problem = format!("there is no item `{keyword}`");
        if let Some(example) = loads::example(&keyword.text) {
            return Err(Error::new(begin.span(), format!("{problem}\nhelp: it is a load, as in `{example}`")));
        }
        if keyword.text == "friction" {
            let help = "joints have none: give it as a load, a `moment` between the links or a `force` at the point";
            return Err(Error::new(begin.span(), format!("{problem}\nhelp: {help}")));
        }
        let behind_name = input.fork();
        let _ = name(&behind_name);
        let has_braces = input.peek(Brace) || behind_name.peek(Brace);
        let Some(meant) = meant(&keyword.text, has_braces) else {
            return Err(Error::new(
                begin.span(),
                format!("{problem}\nhelp: an item begins with one of {}", ITEMS.join(", ")),
            ));
        };
        slips.report(Diagnostic::new(keyword.place(), problem).help(format!("did you mean `{meant}`?")));
        meant.clone_into(&mut keyword.text);
    }
    match keyword.text.as_str() {
        "crate" => crate_path(input),
        "units" => units(input),
        "scalar" => Ok(Item::Scalar(name(input)?)),
        "arithmetic" => Ok(Item::Arithmetic(name(input)?)),
        "emit" => Ok(Item::Emit(name(input)?)),
        "param" => param(input),
        "ground" => link(input, &keyword, None, slips),
        "link" => {
            let name = name(input)?;
            if name.text == "ground" {
                let problem = "`ground` is the fixed link, and stands by itself";
                slips.report(Diagnostic::new(name.place(), problem).help("write `ground { … }`"));
                return link(input, &keyword, None, slips);
            }
            link(input, &keyword, Some(name), slips)
        }
        "mass" => mass(input),
        word if super::JOINTS.contains(&word) => joint(input, keyword),
        "drive" => drive(input),
        "assemble" => assemble(input, &keyword),
        "start" => start(input, &keyword),
        "unknown" => unknown(input, slips),
        "load" => loads::load(input, slips),
        _ => scenes::scene(input, slips),
    }
}

/// The word of an item that was probably meant by another one.
pub(super) fn meant(word: &str, has_braces: bool) -> Option<&'static str> {
    let other_word = OTHER_WORDS.iter().find(|(other, ..)| *other == word);
    let by_other_word = other_word.map(|(_, braced, other)| if has_braces { *braced } else { *other });
    by_other_word.or_else(|| closest(word, ITEMS))
}

/// Takes what is left of an item whose inside is not read.
pub(super) fn rest(input: ParseStream<'_>) {
    while !input.is_empty() && !input.peek(Token![;]) {
        let braces = input.peek(Brace);
        take(input);
        if braces {
            return;
        }
    }
}

/// The path as it is within the generated module: `self` and `super` are meant where the declaration stands.
fn crate_path(input: ParseStream<'_>) -> Result<Item> {
    input.parse::<Token![=]>()?;
    let path = header::path(input)?;
    let mut rest = path.clone().into_iter();
    Ok(Item::Crate(match rest.next() {
        Some(TokenTree::Ident(first)) if first == "self" => {
            let rest: TokenStream = rest.collect();
            quote!(super #rest)
        }
        Some(TokenTree::Ident(first)) if first == "super" => quote!(super::#path),
        _ => path,
    }))
}

fn units(input: ParseStream<'_>) -> Result<Item> {
    let content;
    let _ = syn::braced!(content in input);
    Ok(Item::Units(comma_list(&content, name)?))
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
    Ok(Item::Param(Param { name: name_, dimension, default }))
}

fn link(input: ParseStream<'_>, keyword: &Name, name: Option<Name>, slips: &Sink) -> Result<Item> {
    let content;
    let _ = syn::braced!(content in input);
    let mut places = Vec::new();
    while !content.is_empty() {
        places.push(point_place_or_none(&content, slips));
        if content.peek(Token![,]) {
            take(&content);
        }
    }
    Ok(Item::Link(Link { name, keyword: keyword.span, places }))
}

/// A point with its place, up to the comma. One that cannot be read is reported, and does not spoil the others.
fn point_place_or_none(content: ParseStream<'_>, slips: &Sink) -> PointPlace {
    let ahead = content.fork();
    let read = point_place(&ahead).and_then(|place| {
        if ahead.is_empty() || ahead.peek(Token![,]) { Ok(place) } else { Err(ahead.error("expected `,`")) }
    });
    match read {
        Ok(place) => {
            content.advance_to(&ahead);
            place
        }
        Err(error) => {
            let error = Diagnostic::from(error);
            let helped = error.message().contains("\nhelp:");
            let help = "a point is written `A -> B: 100mm`, `C: (50mm, 20mm)` or `C: left(A -> B, 70mm, 80mm)`";
            slips.report(if helped { error } else { error.help(help) });
            let begin = content.fork();
            while !content.is_empty() && !before_point(content) {
                take(content);
            }
            PointPlace::Unread(words(between(&begin, content).into_iter().collect()))
        }
    }
}

/// Whether the comma in front of the next point comes next: a point begins with its name.
fn before_point(content: ParseStream<'_>) -> bool {
    content.peek(Token![,]) && content.peek2(syn::Ident::peek_any)
}

fn point_place(input: ParseStream<'_>) -> Result<PointPlace> {
    // `A - B: 100mm`
    if input.peek2(Token![-]) && input.peek3(syn::Ident::peek_any) {
        let ahead = input.fork();
        take(&ahead);
        let hyphen = ahead.fork();
        take(&ahead);
        take(&ahead);
        if ahead.peek(Token![:]) {
            return Err(hyphen.error("expected `->`, found `-`"));
        }
    }
    let point = name(input)?;
    if input.peek(Token![->]) {
        input.parse::<Token![->]>()?;
        let to = name(input)?;
        input.parse::<Token![:]>()?;
        return Ok(PointPlace::Frame(point, to, value(input)?));
    }
    if input.is_empty() || input.peek(Token![,]) {
        return Ok(PointPlace::Origin(point));
    }
    if !input.peek(Token![:]) {
        return Err(input.error("expected `:` or `->`"));
    }
    input.parse::<Token![:]>()?;
    let by_distances = (at_word(input, "left") || at_word(input, "right")) && input.peek2(Paren);
    if !by_distances {
        return place_by_coordinates(input, point);
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

/// `(x, y)` or `size @ angle`
fn place_by_coordinates(input: ParseStream<'_>, point: Name) -> Result<PointPlace> {
    if let Some(word) = peek_word(input).filter(|word| input.peek2(Paren) && !FUNCTIONS.contains(&word.as_str())) {
        let help = "a point lies on the `left` or the `right` of a line, as in `left(A -> B, 70mm, 80mm)`";
        return Err(input.error(format!("there is no side `{word}`\nhelp: {help}")));
    }
    match magnitude(input)? {
        Magnitude::Vector(vector) => Ok(PointPlace::At(point, vector)),
        // The other coordinate, without a name.
        Magnitude::Scalar(x) if input.peek(Token![,]) && !input.peek2(syn::Ident::peek_any) => {
            let help = format!("as in `{point}: (50mm, 20mm)`");
            Err(Error::new(x.place.start(), format!("the coordinates of a point stand in parentheses\nhelp: {help}")))
        }
        Magnitude::Scalar(length) => Err(Error::new(
            length.place.start(),
            "expected a vector\nhelp: Cartesian `(x, y)` or polar `size @ angle`; a length alone is that between two points, as in `A -> B: 80mm`",
        )),
    }
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
    let named =
        !input.peek(Paren) && (input.peek2(Token![,]) || input.peek2(Token![;]) || input.peek2(syn::Ident::peek_any));
    let at = if named { PointRef::Named(name(input)?) } else { PointRef::At(vector(input)?) };
    let mut inertia = None;
    if input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
        expect_word(input, "inertia")?;
        inertia = Some(value(input)?);
    }
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
    let mut joint = Joint { name, keyword, from, to, along, angle: None, gear: Box::default() };
    while input.peek(Token![,]) {
        input.parse::<Token![,]>()?;
        if joint.keyword.text == "gear" {
            gear_option(input, &mut joint.gear)?;
        } else {
            expect_word(input, "angle")?;
            joint.angle = Some(value(input)?);
        }
    }
    let problem = match joint.keyword.text.as_str() {
        "prismatic" if joint.along.is_none() => {
            "has no direction\nhelp: say along which line it slides: `along 0deg`".to_owned()
        }
        "slot" if joint.along.is_none() => {
            let help =
                format!("say along which line of which link the pin slides: `along 0deg of {}`", joint.from.link);
            format!("has no direction\nhelp: {help}")
        }
        "gear" if joint.gear.radii.is_none() => {
            "has no radii\nhelp: give those of both wheels behind the links: `, radii (20mm, 30mm)`".to_owned()
        }
        "revolute" | "weld" | "gear" if joint.along.is_some() => "slides along nothing".to_owned(),
        "revolute" | "slot" if joint.angle.is_some() => "has no fixed angle".to_owned(),
        _ => return Ok(Item::Joint(joint)),
    };
    let what = match joint.keyword.text.as_str() {
        "slot" | "weld" => joint.keyword.text.clone(),
        "gear" => "gear pair".to_owned(),
        kind => format!("{kind} joint"),
    };
    Err(Error::new(joint.name.span, format!("the {what} `{}` {problem}", joint.name)))
}

fn gear_option(input: ParseStream<'_>, gear: &mut Gear) -> Result<()> {
    const OPTIONS: [&str; 5] = ["radii", "internal", "phase", "pressure_angle", "flank"];
    let word = name(input)?;
    match word.text.as_str() {
        "radii" => {
            let content;
            let _ = syn::parenthesized!(content in input);
            let first = value(&content)?;
            content.parse::<Token![,]>()?;
            let second = value(&content)?;
            optional_comma(&content)?;
            gear.radii = Some([first, second]);
        }
        "internal" => gear.internal = true,
        "phase" => gear.phase = Some(value(input)?),
        "pressure_angle" => gear.pressure_angle = Some(value(input)?),
        "flank" => gear.flank = Some(name(input)?),
        other => {
            let help = closest(other, OPTIONS)
                .map_or_else(|| format!("it has {}", OPTIONS.join(", ")), |meant| format!("did you mean `{meant}`?"));
            return Err(Error::new(word.span, format!("a gear pair has no `{word}`\nhelp: {help}")));
        }
    }
    Ok(())
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
    let mut motion = DriveMotion::default();
    if input.peek(Token![,]) {
        let help = format!("as in `drive {name_}: {joint} {{ rate: 3000rpm, acceleration: 0 }};`");
        return Err(input.error(format!("the motion of a drive stands in braces\nhelp: {help}")));
    }
    if input.peek(Brace) {
        let content;
        let _ = syn::braced!(content in input);
        for (name, value) in comma_list(&content, field)? {
            put_motion(&mut motion, &name, value)?;
        }
    }
    Ok(Item::Drive(Drive { name: name_, joint, coordinate, motion }))
}

/// `rate: 3000rpm`
fn field(input: ParseStream<'_>) -> Result<(Name, Value)> {
    let name = colon_name(input)?;
    Ok((name, value(input)?))
}

fn put_motion(motion: &mut DriveMotion, name: &Name, value: Value) -> Result<()> {
    const FIELDS: [&str; 2] = ["rate", "acceleration"];
    let field = match name.text.as_str() {
        "rate" => &mut motion.rate,
        "acceleration" => &mut motion.acceleration,
        other => {
            let help = closest(other, FIELDS)
                .map_or_else(|| format!("it has {}", FIELDS.join(" and ")), |meant| format!("did you mean `{meant}`?"));
            return Err(Error::new(name.span, format!("the motion of a drive has no `{name}`\nhelp: {help}")));
        }
    };
    if field.is_some() {
        return Err(Error::new(name.span, format!("the {name} is said twice\nhelp: keep one of the two")));
    }
    *field = Some(value);
    Ok(())
}

/// The sides of an `assemble`.
pub(crate) const SIDES: [&str; 5] = ["left", "right", "ahead", "behind", "either"];

/// That there is no such side.
fn no_side(side: &Name) -> Option<String> {
    let error = || Diagnostic::new(side.place(), format!("there is no side `{side}`")).suggest(&side.text, SIDES);
    (!SIDES.contains(&side.text.as_str())).then(|| error().message().to_owned())
}

fn assemble(input: ParseStream<'_>, keyword: &Name) -> Result<Item> {
    let joint = colon_name(input)?;
    let side = name(input)?;
    let content;
    if !input.peek(Paren) {
        if let Some(problem) = no_side(&side) {
            return Err(Error::new(side.span, problem));
        }
        return Err(
            input.error("expected `(`\nhelp: the joints stand in parentheses, as in `left(A -> B0)` or `ahead(A)`")
        );
    }
    let parens = syn::parenthesized!(content in input);
    let chosen = side.place().to(Place::at(parens.span.close()));
    let mut place = keyword.place().to(chosen);
    let mut joints = vec![name(&content)?];
    if content.peek(Token![->]) {
        content.parse::<Token![->]>()?;
        joints.push(name(&content)?);
    } else if content.peek(Token![,]) && content.peek2(syn::Ident) {
        take(&content);
        let help = format!("write `{side}({} -> {})`", joints[0], name(&content)?);
        return Err(Error::new(
            joints[0].span,
            format!("an arrow stands between the two joints of a line\nhelp: {help}"),
        ));
    }
    optional_comma(&content)?;
    let begin = input.fork();
    let smooth = if eat_word(input, "smooth") {
        expect_word(input, "at")?;
        let at = value(input)?;
        let whole = place_of(&between(&begin, input)).unwrap_or(at.place);
        place = place.to(whole);
        Some(Smooth { at, place: whole })
    } else {
        None
    };
    Ok(Item::Assemble(Assemble { joint, side, joints, smooth, chosen, place }))
}

fn start(input: ParseStream<'_>, keyword: &Name) -> Result<Item> {
    let name = colon_name(input)?;
    let (from, end) = match magnitude(input)? {
        Magnitude::Vector(at) => {
            if !input.peek(Token![,]) {
                return Err(input.error(format!(
                    "expected `,` and the angle\nhelp: a link starts with a place and an angle, as in `start {name}: (0, 0), angle 30deg;`"
                )));
            }
            input.parse::<Token![,]>()?;
            expect_word(input, "angle")?;
            let angle = value(input)?;
            let end = angle.place;
            (StartFrom::Pose(at, angle), end)
        }
        Magnitude::Scalar(value) => {
            let end = value.place;
            (StartFrom::Coordinate(value), end)
        }
    };
    Ok(Item::Start(Start { name, from, place: keyword.place().to(end) }))
}

fn unknown(input: ParseStream<'_>, slips: &Sink) -> Result<Item> {
    const EFFORTS: [&str; 4] = ["torque", "force", "thrust", "effort"];
    let begin = input.fork();
    let name_ = colon_name(input)?;
    let mut word = name(input)?;
    if !EFFORTS.contains(&word.text.as_str()) {
        let problem = format!("there is no kind of unknown `{word}`");
        let help = "an unknown is a `torque`, a `force`, a `thrust` or the `effort` at a drive";
        // That is the word of loads.
        let meant = if word.text == "moment" { Some("torque") } else { closest(&word.text, EFFORTS) };
        let Some(meant) = meant else {
            return Err(Error::new(word.span, format!("{problem}\nhelp: {help}")));
        };
        slips.report(Diagnostic::new(word.place(), problem).help(format!("did you mean `{meant}`?")));
        meant.clone_into(&mut word.text);
    }
    if !input.peek(Paren) {
        return Err(
            input.error("expected `(`\nhelp: as in `torque(ground -> crank)` or `force(piston.B) along 180deg`")
        );
    }
    let content;
    let _ = syn::parenthesized!(content in input);
    let effort = match word.text.as_str() {
        "torque" => {
            let from = name(&content)?;
            if !content.peek(Token![->]) {
                let help =
                    format!("write `torque({})`: on the second, by the first", loads::both_links(&from, &content));
                return Err(Error::new(from.span, format!("a torque acts between two links\nhelp: {help}")));
            }
            content.parse::<Token![->]>()?;
            let to = name(&content)?;
            optional_comma(&content)?;
            Effort::Torque(from, to)
        }
        "force" => {
            let at = end(&content)?;
            optional_comma(&content)?;
            if !at_word(input, "along") {
                let help = "write it behind the point: `along 90deg`, or `along 0deg of crank`";
                return Err(Error::new(
                    at.link.span,
                    format!("the line of the force `{name_}` is not said\nhelp: {help}"),
                ));
            }
            expect_word(input, "along")?;
            Effort::Force(at, Box::new(direction(input)?))
        }
        "effort" => {
            let drive = name(&content)?;
            if content.peek(Token![,]) {
                content.parse::<Token![,]>()?;
            }
            if !content.is_empty() {
                return Err(content.error(format!("an effort is that of one drive\nhelp: write `effort({drive})`")));
            }
            Effort::Drive(drive)
        }
        _ => {
            let ends = loads::two_ends(&content)?;
            if !content.is_empty() {
                return Err(content.error("expected `)`"));
            }
            Effort::Thrust(ends)
        }
    };
    let place = place_of(&between(&begin, input)).unwrap_or(name_.place());
    Ok(Item::Unknown(Unknown { name: name_, place, effort }))
}
