//! The project's examples: their declarations, as they stand in the source.

use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};

/// All examples by the names of their files.
pub const EXAMPLES: [&str; 5] = ["four_bar", "slider_crank", "six_bar", "three_loads", "stephenson"];

/// The tokens between the braces of an example's `linkage!`.
pub fn declaration(example: &str) -> TokenStream {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(format!("{example}.rs"));
    let source = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let tokens: Vec<TokenTree> = source.parse::<TokenStream>().expect("Rust").into_iter().collect();
    let found = tokens.windows(3).find_map(|window| match window {
        [TokenTree::Ident(name), TokenTree::Punct(bang), TokenTree::Group(body)]
            if name == "linkage" && bang.as_char() == '!' =>
        {
            Some(body.stream())
        }
        _ => None,
    });
    found.expect("a declaration")
}
