//! Names and numbers as tokens.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use crate::graph::Scalar;
use crate::graph::number::Number;

/// A name as an identifier, raw where it is a keyword.
pub(super) fn ident(name: &str) -> Ident {
    // `gen` is a keyword only from the edition of 2024 on, and a name to syn. Names that cannot be raw were refused when they were read.
    let plain = syn::parse_str::<Ident>(name).ok().filter(|_| name != "gen");
    plain.unwrap_or_else(|| match name {
        "self" | "Self" | "super" | "crate" | "_" => Ident::new(&format!("{name}_"), Span::call_site()),
        _ => Ident::new_raw(name, Span::call_site()),
    })
}

/// A constant as the nearest number of the scalar, in the fewest digits that give it back; its sign apart. `None` if that is not
/// finite.
pub(super) fn literal(number: &Number, scalar: Scalar) -> Option<(bool, Literal)> {
    let text = match scalar {
        Scalar::F64 => {
            let value = number.to_f64();
            value.is_finite().then(|| format!("{:?}", value.abs()))?
        }
        Scalar::F32 => {
            let value = number.to_f32();
            value.is_finite().then(|| format!("{:?}", value.abs()))?
        }
    };
    let literal = text.parse::<Literal>().ok()?;
    Some((number.signum() < 0, literal))
}

/// A constant with its sign.
pub(super) fn signed_literal(number: &Number, scalar: Scalar) -> TokenStream {
    match literal(number, scalar) {
        Some((true, literal)) => quote!(-#literal),
        Some((false, literal)) => quote!(#literal),
        // Constants beyond the scalar's range are refused before code is emitted.
        None => quote!(0.0),
    }
}

/// A text as a raw string, line by line as it is read.
pub(super) fn text(text: &str) -> Literal {
    // As many signs as no text in it can close: a source holds raw strings itself.
    let signs =
        "#".repeat(1 + text.split('"').map(|part| part.chars().take_while(|c| *c == '#').count()).max().unwrap_or(0));
    format!("r{signs}\"{text}\"{signs}").parse::<Literal>().unwrap_or_else(|_| Literal::string(text))
}
