//! Straight code for a block of positions in stages, each a loop of its own over the block.
//!
//! The processor works on as many positions at once as its window of instructions has room for. One loop over all of a scene fills it with
//! a single position, whose operations wait for each other; loops over a few dozen operations let the next positions fill the gaps. Between
//! stages numbers are kept in columns; a cut is made where few have to be. An angle is reduced in one stage, and its sine found in the next:
//! the longest chain of operations that wait for each other is cut in two.

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

/// Identifiers by their texts, which are compared more cheaply.
type Names = BTreeMap<String, Ident>;

struct Statement {
    tokens: TokenStream,
    defines: Names,
    /// What it defines among it.
    names: Names,
}

impl Statement {
    fn new(tokens: TokenStream) -> Self {
        let pattern =
            tokens.clone().into_iter().skip_while(|token| !matches!(token, TokenTree::Ident(name) if name == "let"));
        let pattern =
            pattern.skip(1).take_while(|token| !matches!(token, TokenTree::Punct(punct) if punct.as_char() == '='));
        Self { defines: names(&pattern.collect()), names: names(&tokens), tokens }
    }

    fn reduces_an_angle(&self) -> bool {
        self.names.keys().any(|name| is_reduction(name))
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

/// Operations that a stage has, about.
const LENGTH: usize = 40;
/// A sine and cosine count as so many.
const SINE: usize = 30;
/// And the reduction of their angle.
const REDUCTION: usize = 10;

/// The stages of some work, of which the names in `given` are known before.
pub(super) fn stages(work: Work, given: &[Ident]) -> Vec<Stage> {
    let Work { statements, conditions, results } = work;
    let statements: Vec<Statement> = statements.into_iter().map(Statement::new).collect();
    let cuts = cuts(&statements);
    let mut stages: Vec<Stage> = cuts.iter().map(|_| Stage::default()).collect();
    let mut wanted: Vec<Names> = vec![Names::new(); stages.len()];
    // The stage that defines each name; of what is given, none.
    let mut stage_of: BTreeMap<String, Option<usize>> = given.iter().map(|name| (name.to_string(), None)).collect();
    let mut number = 0;
    for (index, Statement { tokens, defines, names }) in statements.into_iter().enumerate() {
        while index >= cuts[number] {
            number += 1;
        }
        stage_of.extend(defines.into_keys().map(|name| (name, Some(number))));
        wanted[number].extend(names);
        stages[number].statements.extend(tokens);
    }
    // The first stage that knows all that something reads.
    let mut reading = |tokens: &TokenStream| {
        let names = names(tokens);
        let number = names.keys().filter_map(|name| *stage_of.get(name)?).max().unwrap_or(0);
        wanted[number].extend(names);
        number
    };
    for condition in conditions {
        stages[reading(&condition)].conditions.push(condition);
    }
    for (place, result) in results.into_iter().enumerate() {
        stages[reading(&result)].results.push((place, result));
    }
    let mut kept = BTreeSet::new();
    for (number, names) in wanted.into_iter().enumerate() {
        for (text, name) in names {
            match stage_of.get(&text) {
                // A function, a constant, or what is the same at every position; or its own.
                None => continue,
                Some(Some(own)) if *own == number => continue,
                Some(Some(earlier)) => {
                    if kept.insert(text) {
                        stages[*earlier].keeps.push(name.clone());
                    }
                }
                Some(None) => {}
            }
            stages[number].reads.push(name);
        }
    }
    stages
}

/// For each stage, how many statements are before its end. It ends behind an angle that is reduced, or else, near the length that a stage
/// should have, where the fewest names are read later.
fn cuts(statements: &[Statement]) -> Vec<usize> {
    let length: Vec<usize> = statements.iter().map(|one| operations(&one.tokens)).collect();
    let kept = kept(statements);
    let mut cuts = Vec::new();
    let (mut begin, mut rest) = (0, length.iter().sum::<usize>());
    while rest > LENGTH + LENGTH / 2 || statements[begin..].iter().any(Statement::reduces_an_angle) {
        let (mut sum, mut best) = (0, None);
        for end in begin + 1..statements.len() {
            sum += length[end - 1];
            if statements[end - 1].reduces_an_angle() {
                best = Some((kept[end], end));
                break;
            }
            if sum > LENGTH + LENGTH / 2 && best.is_some() {
                break;
            }
            if sum >= LENGTH / 2 && best.is_none_or(|(least, _)| kept[end] <= least) {
                best = Some((kept[end], end));
            }
        }
        let Some((_, end)) = best else { break };
        cuts.push(end);
        rest -= length[begin..end].iter().sum::<usize>();
        begin = end;
    }
    cuts.push(statements.len());
    cuts
}

/// For each number of statements, how many names that these define are read by others.
fn kept(statements: &[Statement]) -> Vec<usize> {
    let mut last_read: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, statement) in statements.iter().enumerate() {
        last_read.extend(statement.names.keys().map(|name| (name.as_str(), index)));
    }
    let mut ends = vec![0; statements.len()];
    let mut open = 0;
    let mut kept = vec![0];
    for (index, statement) in statements.iter().enumerate() {
        open += statement.defines.len();
        for name in statement.defines.keys() {
            ends[last_read[name.as_str()]] += 1;
        }
        open -= ends[index];
        kept.push(open);
    }
    kept
}

/// How many operations a statement has, about.
fn operations(tokens: &TokenStream) -> usize {
    tokens
        .clone()
        .into_iter()
        .map(|token| match token {
            TokenTree::Group(group) => operations(&group.stream()),
            TokenTree::Punct(punct) => usize::from("+-*/".contains(punct.as_char())),
            TokenTree::Ident(name) if name == "mul_add" || name == "sqrt" => 1,
            TokenTree::Ident(name) if name == "short_sin_cos" || name == "short_fused_sin_cos" => SINE,
            TokenTree::Ident(name) if is_reduction(&name.to_string()) => REDUCTION,
            TokenTree::Ident(_) | TokenTree::Literal(_) => 0,
        })
        .sum()
}

fn is_reduction(name: &str) -> bool {
    ["short_angle", "short_angle_sum", "short_fused_angle", "short_fused_angle_sum"].contains(&name)
}

/// All identifiers.
fn names(tokens: &TokenStream) -> Names {
    let mut found = Names::new();
    for token in tokens.clone() {
        match token {
            TokenTree::Group(group) => found.extend(names(&group.stream())),
            TokenTree::Ident(name) => {
                found.insert(name.to_string(), name);
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proc_macro2::TokenStream;
    use quote::{format_ident, quote};

    use super::{LENGTH, Stage, Work, operations, stages};

    /// A sine, then a chain of sums of two numbers: `x1 = x0 + x0 * sine` and so on; every tenth has a condition and a result.
    fn chain(links: usize) -> Vec<Stage> {
        let mut statements = vec![
            quote!(let (quarters, rest, tail) = math::short_angle(angle);),
            quote!(let (sine, _) = math::short_sin_cos(quarters, rest, tail);),
        ];
        let (mut conditions, mut results) = (Vec::new(), Vec::new());
        for link in 0..links {
            let (from, to) = (format_ident!("x{link}"), format_ident!("x{}", link + 1));
            statements.push(quote!(let #to = #from + #from * sine;));
            if link % 10 == 0 {
                conditions.push(quote!((#to > angle)));
                results.push(quote!(#to));
            }
        }
        stages(Work { statements, conditions, results }, &[format_ident!("angle"), format_ident!("x0")])
    }

    #[test]
    fn a_stage_reads_what_is_given_or_kept_before() {
        let stages = chain(200);
        let mut known: BTreeSet<String> = ["angle", "x0"].map(str::to_owned).into();
        for stage in &stages {
            assert!(stage.reads.iter().all(|name| known.contains(&name.to_string())), "{:?}", stage.reads);
            known.extend(stage.keeps.iter().map(ToString::to_string));
        }
        // The angle in three numbers, then the sine and the chain's last link.
        assert_eq!((stages[0].keeps.len(), stages[0].reads.len()), (3, 1));
        assert!(stages[2..stages.len() - 1].iter().all(|stage| stage.reads.len() <= 3 && stage.keeps.len() == 1));
        let numbers: BTreeSet<usize> =
            stages.iter().flat_map(|stage| stage.results.iter().map(|(place, _)| *place)).collect();
        assert_eq!(numbers, (0..20).collect());
        assert_eq!(stages.iter().map(|stage| stage.conditions.len()).sum::<usize>(), 20);
    }

    #[test]
    fn stages_are_neither_long_nor_many() {
        let work = |stage: &Stage| operations(&stage.statements);
        let stages = chain(200);
        assert!(
            stages.iter().all(|stage| work(stage) <= 2 * LENGTH),
            "{:?}",
            stages.iter().map(work).collect::<Vec<_>>()
        );
        assert!(stages.len() <= 3 + 400 / (LENGTH / 2));
        // What is short stays together, but for the angle of a sine.
        assert_eq!(chain(5).len(), 2);
        assert_eq!(
            super::stages(
                Work { statements: Vec::new(), conditions: Vec::new(), results: vec![TokenStream::new()] },
                &[]
            )
            .len(),
            1
        );
    }
}
