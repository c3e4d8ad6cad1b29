//! Words, names and punctuation.

use proc_macro2::{Ident, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Result};

use super::ast::Name;
use super::hyphens;
use crate::diagnostics::Place;

/// Why an attribute is refused anywhere but above the module.
pub(super) const NO_ATTRIBUTES: &str = "items have no attributes or documentation comments
help: document the module above `mod`, and write plain comments `// …` beside items";

/// A name. Rust's keywords serve; the few that cannot be written as raw identifiers are refused where they are declared.
pub(super) fn name(input: ParseStream<'_>) -> Result<Name> {
    let begin = input.fork();
    let name = word(input)?;
    if !input.peek(syn::Token![-]) || input.peek(syn::Token![->]) {
        return Ok(name);
    }
    let ahead: Vec<TokenTree> = begin.parse::<TokenStream>()?.into_iter().collect();
    match hyphens::hyphenated(&ahead) {
        Some((written, _)) => {
            let arrow =
                written.split_once('-').filter(|(_, to)| to.starts_with(char::is_alphabetic) && !to.contains('-'));
            let arrow =
                arrow.map_or(String::new(), |(from, to)| format!(", or `{from} -> {to}` where an arrow stands"));
            Err(Error::new(name.span, format!("{}{arrow}", hyphens::problem(&written))))
        }
        None => Ok(name),
    }
}

/// A word, whatever follows: in values that may be a minus.
pub(super) fn word(input: ParseStream<'_>) -> Result<Name> {
    let begin = input.fork();
    let Ok(ident) = input.call(Ident::parse_any) else {
        return Err(match begin.parse::<TokenTree>() {
            Ok(TokenTree::Literal(literal)) => Error::new(
                literal.span(),
                format!("expected a name, found `{literal}`\nhelp: names begin with a letter"),
            ),
            Ok(TokenTree::Group(group)) => Error::new(group.span_open(), "expected a name before the bracket"),
            Ok(TokenTree::Punct(pound)) if pound.as_char() == '#' => Error::new(pound.span(), NO_ATTRIBUTES),
            Ok(other) => Error::new(other.span(), format!("expected a name, found `{other}`")),
            Err(_) => begin.error("expected a name"),
        });
    };
    Ok(Name::of(&ident))
}

/// The next token, if it is a word.
pub(super) fn peek_word(input: ParseStream<'_>) -> Option<String> {
    input.fork().call(Ident::parse_any).ok().map(|ident| ident.to_string())
}

/// Whether the next token is this word.
pub(super) fn at_word(input: ParseStream<'_>, word: &str) -> bool {
    peek_word(input).is_some_and(|next| next == word)
}

/// Takes this word, if it comes next.
pub(super) fn eat_word(input: ParseStream<'_>, word: &str) -> bool {
    at_word(input, word) && input.call(Ident::parse_any).is_ok()
}

/// Takes this word.
pub(super) fn expect_word(input: ParseStream<'_>, word: &str) -> Result<()> {
    if eat_word(input, word) { Ok(()) } else { Err(input.error(format!("expected `{word}`"))) }
}

/// Items with commas between, up to the end of the stream.
pub(super) fn comma_list<T>(input: ParseStream<'_>, one: fn(ParseStream<'_>) -> Result<T>) -> Result<Vec<T>> {
    let mut all = Vec::new();
    while !input.is_empty() {
        all.push(one(input)?);
        if input.is_empty() {
            break;
        }
        if !input.peek(syn::Token![,]) {
            return Err(input.error("expected `,`"));
        }
        input.parse::<syn::Token![,]>()?;
    }
    Ok(all)
}

/// Takes a token tree. `None` at the end.
pub(super) fn take(input: ParseStream<'_>) -> Option<TokenTree> {
    input.parse::<TokenTree>().ok()
}

/// What was read between two states of a stream.
pub(super) fn between(begin: ParseStream<'_>, end: ParseStream<'_>) -> Vec<TokenTree> {
    let mut read = Vec::new();
    let ahead = begin.fork();
    while ahead.cursor() != end.cursor() {
        let Some(token) = take(&ahead) else { break };
        read.push(token);
    }
    read
}

/// Where tokens stand.
pub(super) fn place_of(tokens: &[TokenTree]) -> Option<Place> {
    let (first, last) = (tokens.first()?, tokens.last()?);
    let open = if let TokenTree::Group(group) = first { group.span_open() } else { first.span() };
    let close = if let TokenTree::Group(group) = last { group.span_close() } else { last.span() };
    Some(Place::at(open).to(Place::at(close)))
}
