//! The statements of a long function in blocks, each of which leaves what others read.
//!
//! What a `let` binds is in scope for all that follows, and a compiler that describes scopes to a debugger goes into each from within the one
//! before: of some thousands it finds no end of its stack.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::stages::{Names, defined, names};

/// A function of no more steps is one block; about half of them are statements.
const LONG: usize = 2000;

/// Statements that a block has at least, up to the end of a section, and at most.
const LENGTH: usize = 200;
const MOST: usize = 2 * LENGTH;

/// Statements as they are collected.
pub(super) struct Blocks<'a> {
    is_long: bool,
    all: Vec<Block>,
    section: &'a str,
}

#[derive(Default)]
struct Block {
    /// With what stands above them.
    statements: Vec<TokenStream>,
    defines: Names,
    reads: Names,
}

impl<'a> Blocks<'a> {
    /// Of a program of so many steps.
    pub(super) fn new(steps: usize) -> Self {
        Self { is_long: steps > LONG, all: vec![Block::default()], section: "" }
    }

    /// Adds a statement: with what stands above it, alone, and of which section it is.
    pub(super) fn add(&mut self, with_notes: TokenStream, statement: &TokenStream, section: &'a str) {
        let count = self.all.last().map_or(0, |block| block.statements.len());
        if self.is_long && (count >= MOST || count >= LENGTH && section != self.section) {
            self.all.push(Block::default());
        }
        self.section = section;
        let Some(block) = self.all.last_mut() else { return };
        if self.is_long {
            block.defines.extend(defined(statement));
            block.reads.extend(names(statement));
        }
        block.statements.push(with_notes);
    }

    /// The statements of a function with these results, which are asked for if there are several blocks.
    pub(super) fn joined(self, results: impl FnOnce() -> TokenStream) -> TokenStream {
        let last = self.all.len() - 1;
        let mut read = if last > 0 { names(&results()) } else { Names::new() };
        let mut code = Vec::new();
        for (number, Block { statements, defines, reads }) in self.all.into_iter().enumerate().rev() {
            let left = defines.into_iter().filter(|(name, _)| read.contains_key(name)).map(|(_, name)| name);
            code.push(match left.collect::<Vec<_>>().as_slice() {
                _ if number == last => quote!(#(#statements)*),
                [] => quote!({ #(#statements)* }),
                [one] => quote!(let #one = { #(#statements)* #one };),
                left => quote!(let (#(#left),*) = { #(#statements)* (#(#left),*) };),
            });
            read.extend(reads);
        }
        code.into_iter().rev().collect()
    }
}
