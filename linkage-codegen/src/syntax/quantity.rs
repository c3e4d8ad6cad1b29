//! Scalars, vectors and directions: `80mm`, `2*l2 + 5mm`, `100N @ 200deg`, `(0, -3kN)`, `A -> B of rod`.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::parse::{ParseStream, Parser};
use syn::token::Paren;
use syn::{Error, Lit, Result, Token};

use super::ast::{Direction, DirectionKind, Magnitude, Value, ValueKind, VectorKind, VectorValue};
use super::tokens::{NO_ATTRIBUTES, eat_word, name, peek_word, word};
use crate::diagnostics::Place;

/// Operations within operations, those in a row included.
const DEPTH: usize = 256;
/// Operations of an expression, each as often as powers repeat it.
const OPERATIONS: usize = 4096;

/// An expression; one that is too large is refused.
fn built(kind: ValueKind, place: Place) -> Result<Value> {
    let value = Value::new(kind, place);
    if value.extent.depth <= DEPTH && value.extent.operations <= OPERATIONS {
        return Ok(value);
    }
    let problem = format!(
        "this expression is too long: at most {DEPTH} operations depend on each other, and at most {OPERATIONS} make up the whole"
    );
    Err(Error::new(place.start(), format!("{problem}\nhelp: work a part of it out, and write the number")))
}

/// `value := term ((+ | -) term)*`
pub(super) fn value(input: ParseStream<'_>) -> Result<Value> {
    let mut left = term(input)?;
    loop {
        let join = if input.peek(Token![+]) {
            input.parse::<Token![+]>()?;
            ValueKind::Sum
        } else if input.peek(Token![-]) && !input.peek(Token![->]) {
            input.parse::<Token![-]>()?;
            ValueKind::Difference
        } else {
            return Ok(left);
        };
        left = joined(join, left, term(input)?)?;
    }
}

fn term(input: ParseStream<'_>) -> Result<Value> {
    let mut left = factor(input)?;
    loop {
        let join = if input.peek(Token![*]) {
            input.parse::<Token![*]>()?;
            ValueKind::Product
        } else if input.peek(Token![/]) {
            input.parse::<Token![/]>()?;
            ValueKind::Quotient
        } else {
            return Ok(left);
        };
        left = joined(join, left, factor(input)?)?;
    }
}

fn joined(join: fn(Box<Value>, Box<Value>) -> ValueKind, left: Value, right: Value) -> Result<Value> {
    let place = left.place.to(right.place);
    built(join(Box::new(left), Box::new(right)), place)
}

fn factor(input: ParseStream<'_>) -> Result<Value> {
    let mut signs = Vec::new();
    while captured(input).is_none() && input.peek(Token![-]) && !input.peek(Token![->]) {
        let minus: Token![-] = input.parse()?;
        signs.push(minus.spans[0]);
    }
    signs.into_iter().rev().try_fold(power(input)?, |inner, minus| {
        let place = Place::at(minus).to(inner.place);
        built(ValueKind::Negative(Box::new(inner)), place)
    })
}

/// `atom (^ INTEGER)?`; behind a literal it is a power of its unit.
fn power(input: ParseStream<'_>) -> Result<Value> {
    let is_literal = captured(input).is_none() && input.peek(Lit);
    let base = atom(input)?;
    if !input.peek(Token![^]) {
        return Ok(base);
    }
    input.parse::<Token![^]>()?;
    let exponent =
        input.fork().parse::<syn::LitInt>().map_err(|_| input.error("expected a whole exponent, as in `mm^2`"))?;
    drop(input.parse::<TokenTree>());
    let place = base.place.to(Place::at(exponent.span()));
    match exponent.base10_parse::<u32>() {
        Ok(power @ 0..=16) if exponent.suffix().is_empty() => match base.kind {
            ValueKind::Number(digits, Some(unit)) if is_literal => {
                let number = built(ValueKind::Number(digits, None), base.place)?;
                let unit = built(ValueKind::Number("1".to_owned(), Some(unit)), base.place)?;
                joined(ValueKind::Product, number, built(ValueKind::Power(Box::new(unit), power), place)?)
            }
            _ => built(ValueKind::Power(Box::new(base), power), place),
        },
        _ => Err(Error::new(exponent.span(), "an exponent is a whole number from 0 to 16, without a unit")),
    }
}

fn atom(input: ParseStream<'_>) -> Result<Value> {
    if let Some(inner) = captured(input) {
        input.parse::<TokenTree>()?;
        return value.parse2(inner);
    }
    if input.peek(Paren) {
        let content;
        let parens = syn::parenthesized!(content in input);
        let mut inner = value(&content)?;
        if !content.is_empty() {
            return Err(content.error("expected `)` or an operator"));
        }
        inner.place = Place::at(parens.span.open()).to(Place::at(parens.span.close()));
        return Ok(inner);
    }
    if input.peek(Lit) {
        return number(input);
    }
    if input.peek(Token![.]) {
        return Err(input.error("a number begins with a digit, as in `0.5mm`"));
    }
    if peek_word(input).is_some() {
        let word = word(input)?;
        if input.peek(Paren) {
            let content;
            let parens = syn::parenthesized!(content in input);
            let place = word.place().to(Place::at(parens.span.close()));
            let args = super::tokens::comma_list(&content, value)?;
            return built(ValueKind::Call(word, args), place);
        }
        let place = word.place();
        return built(ValueKind::Name(word.text), place);
    }
    if input.peek(Token![#]) {
        return Err(input.error(NO_ATTRIBUTES));
    }
    Err(input.error("expected a value, such as `80mm`"))
}

/// What stands in the invisible brackets that come next, if there is more than one token in them: an expression that a macro by example has
/// captured, as `$length:expr`, and that counts as one.
fn captured(input: ParseStream<'_>) -> Option<TokenStream> {
    match input.fork().parse::<TokenTree>() {
        Ok(TokenTree::Group(group)) if group.delimiter() == Delimiter::None => {
            Some(group.stream()).filter(|inner| inner.clone().into_iter().nth(1).is_some())
        }
        _ => None,
    }
}

/// Words that may follow a value.
const AFTER_VALUES: [&str; 7] = ["along", "angle", "at", "in", "inertia", "of", "smooth"];

fn number(input: ParseStream<'_>) -> Result<Value> {
    let literal: Lit = input.parse()?;
    if input.peek(Token![.]) {
        return Err(input.error("digits follow a decimal point, as in `80.0mm`"));
    }
    let follows = peek_word(input).filter(|word| !AFTER_VALUES.contains(&word.as_str()));
    // A word and a colon begin the next field.
    if let Some(word) = follows.filter(|_| !input.peek2(Token![:])) {
        return Err(
            input.error(format!("expected an operator, found `{word}`: a unit is written to its number, as in `80mm`"))
        );
    }
    let place = Place::at(literal.span());
    let written = literal.to_string_of_source();
    if written.starts_with("0x") || written.starts_with("0b") || written.starts_with("0o") {
        return Err(Error::new(literal.span(), "numbers are decimal"));
    }
    let (digits, suffix) = match &literal {
        Lit::Int(n) => (n.base10_digits().to_owned(), n.suffix()),
        Lit::Float(n) => (n.base10_digits().to_owned(), n.suffix()),
        _ => return Err(Error::new(literal.span(), "expected a number, such as `80mm`")),
    };
    let unit = (!suffix.is_empty()).then(|| suffix.to_owned());
    built(ValueKind::Number(digits, unit), place)
}

/// The literal as its token prints.
trait SourceText {
    fn to_string_of_source(&self) -> String;
}

impl SourceText for Lit {
    fn to_string_of_source(&self) -> String {
        quote::ToTokens::to_token_stream(self).to_string()
    }
}

/// Whether the next token is `( …, … )`.
fn at_pair(input: ParseStream<'_>) -> bool {
    is_pair(input.fork().parse::<TokenTree>().ok())
}

fn is_pair(token: Option<TokenTree>) -> bool {
    let Some(TokenTree::Group(group)) = token else { return false };
    let mut inner = group.stream().into_iter();
    match group.delimiter() {
        Delimiter::Parenthesis => inner.any(|token| matches!(&token, TokenTree::Punct(p) if p.as_char() == ',')),
        // A pair that a macro by example has captured.
        Delimiter::None => is_pair(inner.next()) && inner.next().is_none(),
        Delimiter::Brace | Delimiter::Bracket => false,
    }
}

fn pair(input: ParseStream<'_>) -> Result<VectorValue> {
    let content;
    let parens = syn::parenthesized!(content in input);
    let place = Place::at(parens.span.open()).to(Place::at(parens.span.close()));
    let x = value(&content)?;
    content.parse::<Token![,]>()?;
    let y = value(&content)?;
    if content.peek(Token![,]) {
        content.parse::<Token![,]>()?;
    }
    if !content.is_empty() {
        return Err(content.error("a vector has two components: `(x, y)`"));
    }
    Ok(VectorValue { kind: VectorKind::Cartesian(x, y), place })
}

/// A scalar or a vector, as it comes.
pub(super) fn magnitude(input: ParseStream<'_>) -> Result<Magnitude> {
    if at_pair(input) {
        return Ok(Magnitude::Vector(pair(input)?));
    }
    let size = value(input)?;
    if !input.peek(Token![@]) {
        return Ok(Magnitude::Scalar(size));
    }
    input.parse::<Token![@]>()?;
    let angle = value(input)?;
    let place = size.place.to(angle.place);
    Ok(Magnitude::Vector(VectorValue { kind: VectorKind::Polar(size, angle), place }))
}

/// `(x, y)` or `size @ angle`
pub(super) fn vector(input: ParseStream<'_>) -> Result<VectorValue> {
    match magnitude(input)? {
        Magnitude::Vector(vector) => Ok(vector),
        Magnitude::Scalar(value) => Err(syn::Error::new(
            value.place.start(),
            "expected a vector\nhelp: Cartesian `(x, y)` or polar `size @ angle`",
        )),
    }
}

/// `(value | vector | P -> Q) (of LINK)?`
pub(super) fn direction(input: ParseStream<'_>) -> Result<Direction> {
    if peek_word(input).is_some() && input.peek2(Token![.]) {
        let link = name(input)?;
        let help = format!("write both points alone, and the link behind them: `P -> Q of {link}`");
        return Err(Error::new(link.span, format!("a line goes through two points of one link\nhelp: {help}")));
    }
    let (kind, mut place) = if peek_word(input).is_some() && input.peek2(Token![->]) {
        let from = name(input)?;
        input.parse::<Token![->]>()?;
        let to = name(input)?;
        let place = from.place().to(to.place());
        (DirectionKind::Points(from, to), place)
    } else {
        match magnitude(input)? {
            Magnitude::Scalar(angle) => {
                let place = angle.place;
                (DirectionKind::Angle(angle), place)
            }
            Magnitude::Vector(vector) => {
                let place = vector.place;
                (DirectionKind::Vector(vector), place)
            }
        }
    };
    let of = if eat_word(input, "of") { Some(name(input)?) } else { None };
    if let Some(link) = of.as_ref().filter(|_| input.peek(Token![.])) {
        return Err(input.error(format!("behind `of` stands a link, and no point of it\nhelp: write `of {link}`")));
    }
    if let Some(of) = &of {
        place = place.to(of.place());
    }
    Ok(Direction { kind, of, place })
}
