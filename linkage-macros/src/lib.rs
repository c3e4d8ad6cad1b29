//! The procedural macro `linkage!`. Use it through `linkage-runtime`, which re-exports it beside the types that its code needs.

use proc_macro::TokenStream;

/// Turns the declaration of a planar linkage into a module of specialised solver functions.
///
/// The language is described in the project's grammar page, and the generated module documents itself.
#[proc_macro]
pub fn linkage(declaration: TokenStream) -> TokenStream {
    linkage_codegen::expand_or_report(declaration.into()).into()
}
