//! Hyphens in names: `four-bar` where `four_bar` is meant.

use proc_macro2::{Delimiter, Group, Ident, TokenStream, TokenTree};
use syn::ext::IdentExt;

use crate::diagnostics::{Diagnostic, Place, Sink};

/// Names with hyphens that are declared somewhere: before a `:`, or behind `mod` and `link`; in braces before a place, as `A - B: 80mm` is a slip
/// of the arrow. Each is reported once, where it is declared; wherever else it stands it is read as the same name with underscores.
pub(super) fn joined(input: TokenStream, sink: &Sink) -> TokenStream {
    let mut declared = Vec::new();
    declarations(&input, false, &mut declared);
    let mut told: Vec<&str> = Vec::new();
    for (written, place) in &declared {
        if !told.contains(&written.as_str()) {
            told.push(written);
            sink.report(Diagnostic::new(*place, problem(written)));
        }
    }
    if told.is_empty() { input } else { replaced(input, &told) }
}

/// What is wrong with a name with hyphens.
pub(super) fn problem(written: &str) -> String {
    format!("`{written}` is no name: names have no hyphens\nhelp: write `{}`", written.replace('-', "_"))
}

/// A name with hyphens that begins here, and of how many tokens it is made. A minus of a value is none: it is for the caller to know where values
/// stand.
pub(super) fn hyphenated(tokens: &[TokenTree]) -> Option<(String, usize)> {
    let TokenTree::Ident(first) = tokens.first()? else { return None };
    let (mut written, mut length) = (first.unraw().to_string(), 1);
    while let [TokenTree::Punct(hyphen), part, ..] = &tokens[length..]
        && hyphen.as_char() == '-'
        && let Some(part) = part_of_name(part)
    {
        written.push('-');
        written.push_str(&part);
        length += 2;
    }
    (length > 1).then_some((written, length))
}

/// What may stand behind a hyphen: a word or a number.
fn part_of_name(token: &TokenTree) -> Option<String> {
    let text = match token {
        TokenTree::Ident(word) => word.unraw().to_string(),
        TokenTree::Literal(number) => number.to_string(),
        TokenTree::Group(_) | TokenTree::Punct(_) => return None,
    };
    text.chars().all(|letter| letter.is_alphanumeric() || letter == '_').then_some(text)
}

fn declarations(input: &TokenStream, in_braces: bool, found: &mut Vec<(String, Place)>) {
    let tokens: Vec<TokenTree> = input.clone().into_iter().collect();
    let mut at = 0;
    while at < tokens.len() {
        if let TokenTree::Group(group) = &tokens[at] {
            declarations(&group.stream(), group.delimiter() == Delimiter::Brace, found);
        }
        let Some((written, length)) = hyphenated(&tokens[at..]) else {
            at += 1;
            continue;
        };
        let behind = tokens.get(at + length);
        let before = at.checked_sub(1).map(|before| tokens[before].to_string());
        let is_declared = matches!(behind, Some(TokenTree::Punct(colon)) if colon.as_char() == ':')
            && (!in_braces || is_place(&tokens[at + length + 1..]))
            || before.is_some_and(|word| matches!(word.as_str(), "mod" | "link"));
        if is_declared {
            found.push((written, Place::at(tokens[at].span()).to(Place::at(tokens[at + length - 1].span()))));
        }
        at += length;
    }
}

/// The longest of these names that begins here: behind it may stand the minus of a value.
fn known(tokens: &[TokenTree], names: &[&str]) -> Option<(String, usize)> {
    let (_, whole) = hyphenated(tokens)?;
    let begins = (1..=whole).rev().filter_map(|length| hyphenated(&tokens[..length]));
    begins.into_iter().find(|(written, _)| names.contains(&written.as_str()))
}

/// Whether the place of a point stands here, up to the comma: `(x, y)`, `size @ angle` or `left( … )`.
fn is_place(tokens: &[TokenTree]) -> bool {
    let own = || tokens.iter().take_while(|token| !matches!(token, TokenTree::Punct(comma) if comma.as_char() == ','));
    let is_polar = own().any(|token| matches!(token, TokenTree::Punct(at) if at.as_char() == '@'));
    let is_side = matches!(tokens.first(), Some(TokenTree::Ident(side)) if side == "left" || side == "right");
    is_polar || is_side || own().count() == 1 && matches!(tokens[0], TokenTree::Group(_))
}

fn replaced(input: TokenStream, names: &[&str]) -> TokenStream {
    let tokens: Vec<TokenTree> = input.into_iter().collect();
    let mut output = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if let Some((written, length)) = known(&tokens[at..], names) {
            output.push(TokenTree::Ident(Ident::new(&written.replace('-', "_"), tokens[at].span())));
            at += length;
            continue;
        }
        output.push(match &tokens[at] {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), replaced(group.stream(), names));
                inner.set_span(group.span());
                inner.into()
            }
            other => other.clone(),
        });
        at += 1;
    }
    output.into_iter().collect()
}
