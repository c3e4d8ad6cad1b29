//! Everything that is emitted for the linkages is called in their sources: what is straight from the drives, poses, what a pose says of
//! itself, every scene from it. Of the project's examples too. And all of it by the programs, so that the other proofs are about all of it.

use std::collections::BTreeSet;
use std::fs;

use no_std_proofs::workspace;
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The sources of all linkages: the folder and the name.
fn linkages() -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    for folder in ["double", "single", "example"] {
        for entry in fs::read_dir(workspace().join("linkages/src").join(folder)).expect("a folder") {
            let path = entry.expect("a file").path();
            let name = path.file_stem().expect("a name").display().to_string();
            if name != "mod" {
                all.push((folder, name));
            }
        }
    }
    assert!(all.len() >= 19, "only {} linkages were found", all.len());
    all
}

/// A file, by its path from the workspace.
fn read(path: &str) -> String {
    let path = workspace().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The declaration in a file, and what is called elsewhere in it: names before parentheses, and accessors of poses.
fn split(file: TokenStream, declaration: &mut TokenStream, called: &mut BTreeSet<String>) {
    let mut name = String::new();
    for tree in file {
        match tree {
            TokenTree::Group(group) => match name.as_str() {
                "linkage!" => *declaration = group.stream(),
                "outputs!" => {}
                "accessors!" => called.extend(group.stream().into_iter().map(|name| name.to_string())),
                _ => {
                    if group.delimiter() == Delimiter::Parenthesis {
                        called.insert(name.clone());
                    }
                    split(group.stream(), declaration, called);
                }
            },
            TokenTree::Ident(ident) => name = ident.to_string(),
            TokenTree::Punct(mark) => name.push(mark.as_char()),
            TokenTree::Literal(_) => name.clear(),
        }
    }
}

/// The names of the public functions in emitted code.
fn functions(code: TokenStream, into: &mut BTreeSet<String>) {
    let is = |tree: &TokenTree, word: &str| matches!(tree, TokenTree::Ident(ident) if ident == word);
    let trees: Vec<TokenTree> = code.into_iter().collect();
    for window in trees.windows(3) {
        if let [public, function, TokenTree::Ident(name)] = window
            && is(public, "pub")
            && is(function, "fn")
        {
            into.insert(name.to_string());
        }
    }
    for tree in trees {
        if let TokenTree::Group(group) = tree {
            functions(group.stream(), into);
        }
    }
}

/// The source of an example, without what needs an operating system: as `linkages/build.rs` takes it.
fn example(name: &str) -> String {
    let source = read(&format!("../../examples/{name}.rs"));
    let hosted = |line: &&str| line.trim() == "emit source;" || line.trim_end().ends_with(" verify;");
    source.lines().filter(|line| !hosted(line)).collect::<Vec<_>>().join("\n")
}

/// What a linkage has and its source does not call.
fn missing(declaration: &str, source: &str) -> BTreeSet<String> {
    let (mut declared, mut called, mut emitted) = (TokenStream::new(), BTreeSet::new(), BTreeSet::new());
    split(declaration.parse().expect("tokens"), &mut declared, &mut BTreeSet::new());
    split(source.parse().expect("tokens"), &mut TokenStream::new(), &mut called);
    functions(linkage_codegen::expand(declared), &mut emitted);
    assert!(emitted.contains("at"), "there is no linkage");
    emitted.difference(&called).cloned().collect()
}

#[test]
fn every_emitted_function_is_called() {
    for (folder, name) in linkages() {
        let source = read(&format!("linkages/src/{folder}/{name}.rs"));
        let declaration = if folder == "example" { example(&name) } else { source.clone() };
        let missing = missing(&declaration, &source);
        assert!(missing.is_empty(), "{folder}::{name} does not call {missing:?}");
    }
}

/// Of a linkage placed by iteration: a scene straight from the drive and from a pose, an accessor, a pose that moves.
#[test]
fn control_what_is_not_called_is_found() {
    let source = read("linkages/src/example/stephenson.rs");
    for (name, call) in [
        ("statics_at", "::statics_at("),
        ("statics", " statics("),
        ("rod_direction", " rod_direction,"),
        ("moved_to", ".moved_to("),
    ] {
        assert!(source.contains(call), "{call} is not in the source");
        let missing = missing(&example("stephenson"), &source.replace(call, &call.replace(name, "another")));
        assert_eq!(missing, BTreeSet::from([name.to_owned()]));
    }
}

#[test]
fn every_linkage_is_called() {
    let list = read("linkages/src/lib.rs");
    let mut examples = BTreeSet::new();
    for (folder, name) in linkages() {
        let module = format!("{folder}::{name}");
        let digest = |function: &str| list.contains(&format!(" = {module}::{function},"));
        assert!(digest("digest"), "`each_linkage` leaves out {module}");
        if folder == "example" {
            assert!(digest("digest_posed"), "`each_linkage` leaves out the poses of {module}");
            examples.insert(name);
        } else {
            let program = read(&format!("firmware/src/bin/{folder}.rs"));
            assert!(program.contains(&format!("{module}::solve(")), "the firmware leaves out {module}");
        }
    }
    for entry in fs::read_dir(workspace().join("../../examples")).expect("the examples") {
        let name = entry.expect("a file").path().file_stem().expect("a name").display().to_string();
        assert!(examples.contains(&name), "the example {name} is left out");
    }
}
