//! Everything that is emitted for the linkages is called in their `solve`, of the examples every scene, and every `solve` by the programs,
//! so that the other proofs are about all of it.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use no_std_proofs::workspace;
use proc_macro2::{TokenStream, TokenTree};

/// The sources of all linkages: the folder, which is the name of a program too, and the file.
fn linkages() -> Vec<(&'static str, PathBuf)> {
    let mut all = Vec::new();
    for folder in ["double", "single"] {
        for entry in fs::read_dir(workspace().join("linkages/src").join(folder)).expect("a folder") {
            let path = entry.expect("a file").path();
            if !path.ends_with("mod.rs") {
                all.push((folder, path));
            }
        }
    }
    assert!(all.len() >= 7, "only {} linkages were found", all.len());
    all
}

/// The declaration in a file, and the names that stand elsewhere in it, but for the fields of results.
fn split(file: TokenStream, declaration: &mut TokenStream, names: &mut BTreeSet<String>) {
    let mut macro_name = String::new();
    for tree in file {
        match tree {
            TokenTree::Group(group) => match macro_name.as_str() {
                "linkage!" => *declaration = group.stream(),
                "outputs!" => {}
                _ => split(group.stream(), declaration, names),
            },
            TokenTree::Ident(ident) => {
                macro_name = ident.to_string();
                names.insert(ident.to_string());
            }
            TokenTree::Punct(mark) => macro_name.push(mark.as_char()),
            TokenTree::Literal(_) => macro_name.clear(),
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

#[test]
fn every_emitted_function_is_called() {
    for (_, path) in linkages() {
        let text = fs::read_to_string(&path).expect("a source");
        let (mut declaration, mut names, mut emitted) = (TokenStream::new(), BTreeSet::new(), BTreeSet::new());
        split(text.parse().expect("tokens"), &mut declaration, &mut names);
        functions(linkage_codegen::expand(declaration), &mut emitted);
        assert!(emitted.contains("at"), "{} declares no linkage", path.display());
        let missing: Vec<&String> = emitted.difference(&names).collect();
        assert!(missing.is_empty(), "{} does not call {missing:?}", path.display());
    }
}

/// The names of the functions of a module's scenes, which stand in the module itself: straight from the drives, and sweeps.
fn scenes(code: TokenStream, into: &mut BTreeSet<String>) {
    let trees: Vec<TokenTree> = code.into_iter().collect();
    let is = |tree: &TokenTree, word: &str| matches!(tree, TokenTree::Ident(ident) if ident == word);
    for window in trees.windows(3) {
        match window {
            [module, _, TokenTree::Group(body)] if is(module, "mod") => scenes(body.stream(), into),
            [public, function, TokenTree::Ident(name)] if is(public, "pub") && is(function, "fn") => {
                into.insert(name.to_string());
            }
            _ => {}
        }
    }
}

/// Of every example, every scene but those that need an operating system.
#[test]
fn every_scene_of_the_examples_is_called() {
    let read = |path: PathBuf| fs::read_to_string(path).expect("a source").parse::<TokenStream>().expect("tokens");
    let list = fs::read_to_string(workspace().join("linkages/src/lib.rs")).expect("a source");
    let mut examples = 0;
    for entry in fs::read_dir(workspace().join("../../examples")).expect("the examples") {
        let path = entry.expect("a file").path();
        let name = path.file_stem().expect("a name").display().to_string();
        let (mut declaration, mut calls, mut called, mut of_scenes) = Default::default();
        split(read(path), &mut declaration, &mut called);
        scenes(linkage_codegen::expand(declaration), &mut of_scenes);
        called.clear();
        split(read(workspace().join(format!("linkages/src/example/{name}.rs"))), &mut calls, &mut called);
        let missing: Vec<&String> = of_scenes.difference(&called).collect();
        assert!(missing.iter().all(|scene| *scene == "check_at"), "{name}: {missing:?} are not called");
        assert!(!of_scenes.is_empty(), "{name} has no scene");
        assert!(list.contains(&format!(" = example::{name},")), "`each_linkage` leaves out {name}");
        examples += 1;
    }
    assert!(examples >= 8, "only {examples} examples were found");
}

#[test]
fn every_linkage_is_called() {
    let read = |path: String| fs::read_to_string(workspace().join(path)).expect("a source");
    let list = read("linkages/src/lib.rs".to_owned());
    for (program, path) in linkages() {
        let module = format!("{program}::{}", path.file_stem().expect("a name").display());
        assert!(list.contains(&format!(" = {module},")), "`each_linkage` leaves out {module}");
        let program = read(format!("firmware/src/bin/{program}.rs"));
        assert!(program.contains(&format!("{module}::solve(")), "the firmware leaves out {module}");
    }
}
