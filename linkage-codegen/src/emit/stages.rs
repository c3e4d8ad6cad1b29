//! Straight code for a block of positions in stages, each a loop of its own over the block.
//!
//! The processor works on as many positions at once as its window of instructions has room for. One loop over all of a scene fills it with
//! a single position, whose operations wait for each other; loops over a few dozen operations let the next positions fill the gaps. Between
//! stages numbers are kept in columns; a cut is made where few have to be.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, TokenStream, TokenTree};

/// What is to be computed at each position.
pub(super) struct Work {
    /// `let` statements, in an order in which each reads only what stands before it.
    pub(super) statements: Vec<TokenStream>,
    /// Under which the results mean something.
    pub(super) conditions: Vec<TokenStream>,
    pub(super) results: Vec<TokenStream>,
}

struct Statement {
    tokens: TokenStream,
    defines: BTreeSet<Ident>,
}

impl Statement {
    fn new(tokens: TokenStream) -> Self {
        let pattern =
            tokens.clone().into_iter().skip_while(|token| !matches!(token, TokenTree::Ident(name) if name == "let"));
        let pattern =
            pattern.skip(1).take_while(|token| !matches!(token, TokenTree::Punct(punct) if punct.as_char() == '='));
        Self { defines: names(&pattern.collect()), tokens }
    }
}

/// A loop over all positions.
#[derive(Default)]
pub(super) struct Stage {
    /// What it takes out of columns.
    pub(super) reads: Vec<Ident>,
    pub(super) statements: TokenStream,
    pub(super) conditions: Vec<TokenStream>,
    /// What it leaves for later stages.
    pub(super) keeps: Vec<Ident>,
    /// Results, by their places among all.
    pub(super) results: Vec<(usize, TokenStream)>,
}

/// Operations that a stage has, about. (Half as many or twice as many change little.)
const LENGTH: usize = 40;
/// A sine and cosine count as so many.
const SINE: usize = 30;

/// The stages of some work, of which the names in `given` are known before.
pub(super) fn stages(work: Work, given: &[Ident]) -> Vec<Stage> {
    let Work { statements, conditions, results } = work;
    let statements: Vec<Statement> = statements.into_iter().map(Statement::new).collect();
    let known: BTreeSet<String> =
        statements.iter().flat_map(|one| &one.defines).chain(given).map(Ident::to_string).collect();
    let reads = |tokens: &TokenStream| {
        names(tokens).into_iter().filter(|name| known.contains(&name.to_string())).collect::<Vec<_>>()
    };
    let cuts = cuts(&statements);
    // The stage that defines each name: what is given is there from the first on.
    let mut stage_of: BTreeMap<String, usize> = BTreeMap::new();
    let mut stages: Vec<Stage> = cuts.iter().map(|_| Stage::default()).collect();
    let mut wanted: Vec<BTreeSet<Ident>> = vec![BTreeSet::new(); stages.len()];
    let mut number = 0;
    for (index, Statement { tokens, defines }) in statements.into_iter().enumerate() {
        while index >= cuts[number] {
            number += 1;
        }
        wanted[number].extend(reads(&tokens));
        stage_of.extend(defines.into_iter().map(|name| (name.to_string(), number)));
        stages[number].statements.extend(tokens);
    }
    let first_with = |tokens: &TokenStream, stage_of: &BTreeMap<String, usize>| {
        reads(tokens).iter().filter_map(|name| stage_of.get(&name.to_string()).copied()).max().unwrap_or(0)
    };
    for condition in conditions {
        let number = first_with(&condition, &stage_of);
        wanted[number].extend(reads(&condition));
        stages[number].conditions.push(condition);
    }
    for (place, result) in results.into_iter().enumerate() {
        let number = first_with(&result, &stage_of);
        wanted[number].extend(reads(&result));
        stages[number].results.push((place, result));
    }
    for (number, names) in wanted.into_iter().enumerate() {
        for name in names {
            match stage_of.get(&name.to_string()) {
                Some(own) if *own == number => {}
                Some(earlier) => {
                    let keeps = &mut stages[*earlier].keeps;
                    if !keeps.contains(&name) {
                        keeps.push(name.clone());
                    }
                    stages[number].reads.push(name);
                }
                None => stages[number].reads.push(name),
            }
        }
    }
    stages
}

/// For each stage, how many statements are before its end. Near the length that a stage should have it ends where the fewest names are
/// read later.
fn cuts(statements: &[Statement]) -> Vec<usize> {
    let length: Vec<usize> = statements.iter().map(|one| operations(&one.tokens)).collect();
    let mut last_read: BTreeMap<String, usize> = BTreeMap::new();
    for (index, statement) in statements.iter().enumerate() {
        last_read.extend(names(&statement.tokens).into_iter().map(|name| (name.to_string(), index)));
    }
    // How many names that are defined before an end are read behind it.
    let kept = |end: usize| {
        let names = statements[..end].iter().flat_map(|one| &one.defines);
        names.filter(|name| last_read.get(&name.to_string()).is_some_and(|last| *last >= end)).count()
    };
    let mut cuts = Vec::new();
    let mut begin = 0;
    loop {
        let (mut sum, mut best) = (0, None);
        for end in begin + 1..statements.len() {
            sum += length[end - 1];
            if sum > LENGTH + LENGTH / 2 && best.is_some() {
                break;
            }
            if sum >= LENGTH / 2 && best.is_none_or(|(least, _)| kept(end) <= least) {
                best = Some((kept(end), end));
            }
        }
        let rest: usize = length[begin..].iter().sum();
        match best {
            Some((_, end)) if rest > LENGTH + LENGTH / 2 => {
                cuts.push(end);
                begin = end;
            }
            _ => break,
        }
    }
    cuts.push(statements.len());
    cuts
}

/// How many operations a statement has, about.
fn operations(tokens: &TokenStream) -> usize {
    tokens
        .clone()
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(group) => operations(&group.stream()),
            TokenTree::Punct(punct) => usize::from("+-*/".contains(punct.as_char())),
            TokenTree::Ident(name) if name.to_string().starts_with("short_") => SINE,
            TokenTree::Ident(name) if name == "mul_add" || name == "sqrt" => 1,
            TokenTree::Ident(_) | TokenTree::Literal(_) => 0,
        })
        .sum()
}

/// All identifiers.
fn names(tokens: &TokenStream) -> BTreeSet<Ident> {
    let mut found = BTreeSet::new();
    for token in tokens.clone() {
        match token {
            TokenTree::Group(group) => found.extend(names(&group.stream())),
            TokenTree::Ident(name) => {
                found.insert(name);
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    found
}
