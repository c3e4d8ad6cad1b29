//! The project's examples: their declarations, as they stand in the source.

use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};

/// All examples by the names of their files, as the folder has them.
pub fn every_example() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let files = std::fs::read_dir(folder).expect("the examples").map(|entry| entry.expect("a file").path());
    let sources = files.filter(|path| path.extension().is_some_and(|extension| extension == "rs"));
    let mut names: Vec<String> = sources.map(|path| path.file_stem().expect("a name").display().to_string()).collect();
    names.sort();
    assert!(names.len() >= 8, "only {} examples were found", names.len());
    names
}

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
