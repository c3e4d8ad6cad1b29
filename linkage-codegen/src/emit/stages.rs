//! Straight code for a block of positions in stages, each a loop of its own over the block.
//!
//! The processor works on as many positions at once as its window of instructions has room for. One loop over all of a scene fills it with
//! a single position, whose operations wait for each other; loops over a few dozen operations let the next positions fill the gaps. Between
//! stages numbers are kept in columns. A cut is made in front of what waits for roots and quotients: an angle is reduced in one stage, its
//! sine and the next root found in another, and what reads them has no longer to stand and wait. Elsewhere it is made where few numbers have
//! to be kept. A sine stays with the root that it leads to: while a processor finds the root of one position it has the sums of other
//! positions' sines to do. A quotient may be found later, in a stage that would have neither.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::quote;

use super::body::{Question, Statement};

/// What is to be computed at each position.
pub(super) struct Work<'a> {
    /// In an order in which each reads only what stands before it.
    pub(super) statements: Vec<Statement<'a>>,
    /// Under which the results mean something.
    pub(super) conditions: Vec<Question>,
    pub(super) results: Vec<TokenStream>,
}

/// Identifiers by their texts, which are compared more cheaply.
pub(super) type Names = BTreeMap<String, Ident>;

/// A statement, and what is asked of it.
struct Task<'a> {
    statement: Statement<'a>,
    defines: Names,
    reads: Names,
    operations: usize,
    reduces_an_angle: bool,
    /// Whether what reads it waits for as long as dozens of other operations take: for a root, a quotient, or the rest of an angle.
    is_long: bool,
    /// Whether it takes long for a quotient alone, without a root or an angle.
    is_quotient: bool,
    /// How many tasks that are long are in front of it, one behind the other.
    level: usize,
}

impl<'a> Task<'a> {
    fn new(statement: Statement<'a>) -> Self {
        let defines = defined(&statement.code);
        let words = Words::of(&statement.code);
        let (operations, reduces_an_angle, is_long) = (words.operations(), words.reduce_an_angle(), words.are_long());
        let is_quotient = is_long && words.functions.iter().all(|function| function.kind == Kind::Quick);
        let mut reads = words.names;
        reads.retain(|name, _| !defines.contains_key(name));
        Self { statement, defines, reads, operations, reduces_an_angle, is_long, is_quotient, level: 0 }
    }
}

/// Where the numbers of a name lie, by its place among others of the kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Given(usize),
    Kept(usize),
    Result(usize),
}

/// A loop over all positions.
#[derive(Default)]
pub(super) struct Stage<'a> {
    /// What it takes out of columns.
    pub(super) reads: Vec<(Ident, Column)>,
    pub(super) statements: Vec<Statement<'a>>,
    pub(super) conditions: Vec<Question>,
    /// What it leaves in columns.
    pub(super) keeps: Vec<(Column, TokenStream)>,
}

/// Operations that a stage has, about.
const LENGTH: usize = 36;

/// A function that is called, and about how many operations it has.
struct Function {
    operations: usize,
    kind: Kind,
}

#[derive(PartialEq)]
enum Kind {
    Quick,
    Long,
    /// Of an angle.
    Reduction,
}

impl Function {
    /// That of a name, if it counts.
    fn of(name: &str) -> Option<Self> {
        let (operations, kind) = match name {
            "mul_add" => (1, Kind::Quick),
            "sqrt" => (1, Kind::Long),
            "unit" => (15, Kind::Long),
            "atan2" => (50, Kind::Long),
            "short_angle" | "short_angle_sum" | "short_fused_angle" | "short_fused_angle_sum" => (10, Kind::Reduction),
            "short_sin_cos" | "short_fused_sin_cos" => (30, Kind::Quick),
            _ => return None,
        };
        Some(Self { operations, kind })
    }
}

/// What code consists of: the names of its values, the functions that it calls, its operators.
#[derive(Default)]
struct Words {
    names: Names,
    functions: Vec<Function>,
    operators: Vec<char>,
}

impl Words {
    fn of(code: &TokenStream) -> Self {
        let mut words = Self::default();
        words.add(code);
        words
    }

    fn operations(&self) -> usize {
        self.operators.len() + self.functions.iter().map(|function| function.operations).sum::<usize>()
    }

    fn reduce_an_angle(&self) -> bool {
        self.functions.iter().any(|function| function.kind == Kind::Reduction)
    }

    fn are_long(&self) -> bool {
        self.operators.contains(&'/') || self.functions.iter().any(|function| function.kind != Kind::Quick)
    }

    fn add(&mut self, code: &TokenStream) {
        let is = |token: Option<&TokenTree>, sign: char| matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign);
        let mut tokens = code.clone().into_iter().peekable();
        let mut before: Option<TokenTree> = None;
        while let Some(token) = tokens.next() {
            match &token {
                TokenTree::Group(group) => self.add(&group.stream()),
                TokenTree::Punct(punct) if "+-*/".contains(punct.as_char()) => self.operators.push(punct.as_char()),
                TokenTree::Ident(name) if is(before.as_ref(), ':') => {
                    self.functions.extend(Function::of(&name.to_string()));
                }
                TokenTree::Ident(name) if name == "_" => {}
                // Neither a method nor the beginning of a path.
                TokenTree::Ident(name) if !is(before.as_ref(), '.') && !is(tokens.peek(), ':') => {
                    self.names.insert(name.to_string(), name.clone());
                }
                _ => {}
            }
            before = Some(token);
        }
    }
}

/// The names of the values in some code.
pub(super) fn names(code: &TokenStream) -> Names {
    Words::of(code).names
}

/// The names that a statement binds, if it is a `let`.
pub(super) fn defined(code: &TokenStream) -> Names {
    let mut tokens = code.clone().into_iter();
    if !matches!(tokens.next(), Some(TokenTree::Ident(word)) if word == "let") {
        return Names::new();
    }
    // In front of a type, if there is one.
    let is_end = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if [':', '='].contains(&punct.as_char()));
    names(&tokens.take_while(|token| !is_end(token)).collect())
}

/// The stages of some work, of which the names in `given` are known before.
pub(super) fn stages<'a>(work: Work<'a>, given: &[Ident]) -> Vec<Stage<'a>> {
    let Work { statements, conditions, results } = work;
    let mut tasks: Vec<Task> = statements.into_iter().map(Task::new).collect();
    find_levels(&mut tasks);
    sink(&mut tasks, &conditions);
    tasks.sort_by_key(|task| task.level);
    let cuts = cuts(&tasks);
    let mut stages: Vec<Stage> = cuts.iter().map(|_| Stage::default()).collect();
    let mut wanted: Vec<Names> = vec![Names::new(); stages.len()];
    let mut stage_of: BTreeMap<String, usize> = BTreeMap::new();
    let mut number = 0;
    for (index, Task { statement, defines, reads, .. }) in tasks.into_iter().enumerate() {
        while index >= cuts[number] {
            number += 1;
        }
        stage_of.extend(defines.into_keys().map(|name| (name, number)));
        wanted[number].extend(reads);
        stages[number].statements.push(statement);
    }
    // The first stage that knows all that something reads.
    let mut reading = |tokens: &TokenStream| {
        let names = names(tokens);
        let number = names.keys().filter_map(|name| stage_of.get(name).copied()).max().unwrap_or(0);
        wanted[number].extend(names);
        number
    };
    for condition in conditions {
        stages[reading(condition.code())].conditions.push(condition);
    }
    let given = given.iter().enumerate().map(|(place, name)| (name.to_string(), Column::Given(place)));
    let mut columns: BTreeMap<String, Column> = given.collect();
    for (place, result) in results.into_iter().enumerate() {
        let (column, name) = (Column::Result(place), result.to_string());
        stages[reading(&result)].keeps.push((column, result));
        // What is prepared may be a result too: it is read where it is.
        if stage_of.contains_key(&name) {
            columns.entry(name).or_insert(column);
        }
    }
    keep(&mut stages, &wanted, &stage_of, columns);
    debug_assert!(columns_are_filled_and_read(&stages), "a column is read that has other numbers, or kept for nothing");
    stages
}

/// Whether each column that a stage reads has been filled, and with the numbers of that name, by a stage before it; and each that is kept
/// for later stages is read by one of them.
fn columns_are_filled_and_read(stages: &[Stage]) -> bool {
    let mut filled: Vec<(Column, String, bool)> = Vec::new();
    for Stage { reads, keeps, .. } in stages {
        for (name, column) in reads {
            let own = filled.iter_mut().find(|(own, text, _)| own == column && name == text);
            match (own, column) {
                (Some((_, _, is_read)), _) => *is_read = true,
                (None, Column::Given(_)) => {}
                (None, _) => return false,
            }
        }
        for (column, tokens) in keeps {
            if let Some(index) = filled.iter().position(|(own, ..)| own == column)
                && !filled.swap_remove(index).2
            {
                return false;
            }
            filled.push((*column, tokens.to_string(), matches!(column, Column::Result(_))));
        }
    }
    filled.iter().all(|(_, _, is_read)| *is_read)
}

/// Gives columns to what later stages read, of which `columns` are known already.
fn keep(
    stages: &mut [Stage],
    wanted: &[Names],
    stage_of: &BTreeMap<String, usize>,
    mut columns: BTreeMap<String, Column>,
) {
    // What each stage leaves for others, and the last that reads it.
    let mut left: Vec<BTreeMap<&String, (&Ident, usize)>> = stages.iter().map(|_| BTreeMap::new()).collect();
    for (number, names) in wanted.iter().enumerate() {
        for (text, name) in names {
            if let Some(own) = stage_of.get(text)
                && *own < number
                && !columns.contains_key(text)
            {
                left[*own].insert(text, (name, number));
            }
        }
    }
    // The last stage that reads each column: it may write into it, as it reads the numbers of a position first.
    let mut last: Vec<usize> = Vec::new();
    for (number, names) in left.into_iter().enumerate() {
        for (text, (name, until)) in names {
            let place = last.iter().position(|last| *last <= number).unwrap_or(last.len());
            last.resize(last.len().max(place + 1), until);
            last[place] = until;
            columns.insert(text.clone(), Column::Kept(place));
            stages[number].keeps.push((Column::Kept(place), quote!(#name)));
        }
    }
    for (number, names) in wanted.iter().enumerate() {
        let others = names.iter().filter(|(text, _)| stage_of.get(*text) != Some(&number));
        stages[number].reads = others.filter_map(|(text, name)| Some((name.clone(), *columns.get(text)?))).collect();
    }
}

fn find_levels(tasks: &mut [Task]) {
    // The level from which on each name is there without waiting.
    let mut ready: BTreeMap<String, usize> = BTreeMap::new();
    for task in tasks {
        task.level = task.reads.keys().filter_map(|name| ready.get(name).copied()).max().unwrap_or(0);
        let level = task.level + usize::from(task.is_long);
        ready.extend(task.defines.keys().map(|name| (name.clone(), level)));
    }
}

/// Lets tasks stand at the level where their results are read, if no more numbers have to be kept till there than they have results. A
/// quotient does so only where nothing else takes long: what divides is busy with one quotient or root at a time.
fn sink(tasks: &mut [Task], conditions: &[Question]) {
    let level_of: BTreeMap<String, usize> =
        tasks.iter().flat_map(|task| task.defines.keys().map(|name| (name.clone(), task.level))).collect();
    let mut read = Levels::default();
    for condition in conditions {
        let names = names(condition.code());
        let level = names.keys().filter_map(|name| level_of.get(name).copied()).max().unwrap_or(0);
        read.at(level, &names);
    }
    // One that has sunk may let others follow, for which numbers are kept then.
    let mut sunk = true;
    while sunk {
        sunk = false;
        let mut read = read.clone();
        for index in (0..tasks.len()).rev() {
            let task = &tasks[index];
            let first = task.defines.keys().filter_map(|name| Some(read.0.get(name)?.0)).min();
            if let Some(first) = first
                && first > task.level
                && (!task.is_long
                    || task.is_quotient && !tasks.iter().any(|other| other.is_long && other.level == first))
            {
                let computed = task.reads.keys().filter(|name| level_of.contains_key(*name));
                let not_kept = computed.filter(|name| read.0.get(*name).is_none_or(|(_, last)| *last < first));
                if not_kept.count() <= task.defines.len() {
                    (tasks[index].level, sunk) = (first, true);
                }
            }
            read.at(tasks[index].level, &tasks[index].reads);
        }
    }
}

/// The first and the last level at which each name is read.
#[derive(Clone, Default)]
struct Levels(BTreeMap<String, (usize, usize)>);

impl Levels {
    fn at(&mut self, level: usize, names: &Names) {
        for name in names.keys() {
            let (first, last) = self.0.entry(name.clone()).or_insert((level, level));
            (*first, *last) = (level.min(*first), level.max(*last));
        }
    }
}

/// For each stage, how many tasks are before its end. It ends in front of what waits for its roots and quotients, or else, near the length
/// that a stage should have, where the fewest names are read later. Angles that are reduced always end it.
fn cuts(tasks: &[Task]) -> Vec<usize> {
    let length: Vec<usize> = tasks.iter().map(|task| task.operations).collect();
    let kept = kept(tasks);
    let mut cuts = Vec::new();
    let (mut begin, mut rest) = (0, length.iter().sum::<usize>());
    loop {
        let (mut sum, mut best) = (0, None);
        let mut reduces = false;
        for end in begin + 1..tasks.len() {
            sum += length[end - 1];
            reduces |= tasks[end - 1].reduces_an_angle;
            let waits = tasks[end].level > tasks[end - 1].level;
            // In front of what would wait a stage may be shorter, and what is left behind it.
            let short = if waits { LENGTH / 3 } else { LENGTH / 2 };
            let parts = sum >= short && rest - sum >= short;
            if waits && (reduces || parts) {
                best = Some((kept[end], end));
                break;
            }
            if rest <= LENGTH + LENGTH / 2 {
                continue;
            }
            if sum > LENGTH + LENGTH / 2 && best.is_some() {
                break;
            }
            if parts && best.is_none_or(|(least, _)| kept[end] <= least) {
                best = Some((kept[end], end));
            }
        }
        let Some((_, end)) = best else { break };
        cuts.push(end);
        rest -= length[begin..end].iter().sum::<usize>();
        begin = end;
    }
    cuts.push(tasks.len());
    cuts
}

/// For each number of tasks, how many names that these define are read by others.
fn kept(tasks: &[Task]) -> Vec<usize> {
    let mut last_read: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, task) in tasks.iter().enumerate() {
        last_read.extend(task.defines.keys().chain(task.reads.keys()).map(|name| (name.as_str(), index)));
    }
    let mut ends = vec![0; tasks.len()];
    let mut open = 0;
    let mut kept = vec![0];
    for (index, task) in tasks.iter().enumerate() {
        open += task.defines.len();
        for name in task.defines.keys() {
            ends[last_read[name.as_str()]] += 1;
        }
        open -= ends[index];
        kept.push(open);
    }
    kept
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use proc_macro2::{Ident, TokenStream};
    use quote::{format_ident, quote};

    use super::{Column, LENGTH, Question, Stage, Statement, Words, Work, stages};

    fn ident(name: &str) -> Ident {
        format_ident!("{name}")
    }

    fn staged(
        statements: Vec<TokenStream>,
        conditions: Vec<Question>,
        results: Vec<TokenStream>,
        given: &[Ident],
    ) -> Vec<Stage<'static>> {
        let statements = statements.into_iter().map(Statement::from).collect();
        stages(Work { statements, conditions, results }, given)
    }

    /// A sine, then a chain of sums of two numbers: `x1 = x0 + x0 * sine` and so on; every tenth has a condition and a result.
    fn chain(links: usize) -> Vec<Stage<'static>> {
        let mut statements = vec![
            quote!(let (quarters, rest, tail) = math::short_angle(angle);),
            quote!(let (sine, _) = math::short_sin_cos(quarters, rest, tail);),
        ];
        let (mut conditions, mut results) = (Vec::new(), Vec::new());
        for link in 0..links {
            let (from, to) = (format_ident!("x{link}"), format_ident!("x{}", link + 1));
            statements.push(quote!(let #to = #from + #from * sine;));
            if link % 10 == 0 {
                conditions.push(Question::Holds(quote!((#to > angle))));
                results.push(quote!(#to));
            }
        }
        staged(statements, conditions, results, &[ident("angle"), ident("x0")])
    }

    #[test]
    fn a_stage_reads_what_is_given_or_kept_before() {
        let stages = chain(200);
        let mut kept: BTreeMap<usize, String> = BTreeMap::new();
        let mut results = BTreeSet::new();
        for stage in &stages {
            for (name, column) in &stage.reads {
                match column {
                    Column::Given(place) => assert_eq!(["angle", "x0"][*place], name.to_string()),
                    Column::Kept(place) => assert_eq!(kept[place], name.to_string()),
                    Column::Result(place) => assert_eq!(format!("x{}", 10 * place + 1), name.to_string()),
                }
            }
            for (column, tokens) in &stage.keeps {
                match column {
                    Column::Kept(place) => drop(kept.insert(*place, tokens.to_string())),
                    Column::Result(place) => assert!(results.insert(*place)),
                    Column::Given(_) => panic!("what is given stays"),
                }
            }
        }
        assert_eq!(results, (0..20).collect());
        // The angle in three numbers; then, in the same columns, the sine and the chain's last link.
        assert_eq!((stages[0].keeps.len(), stages[0].reads.len(), kept.len()), (3, 1, 3));
        assert!(stages[2..].iter().all(|stage| stage.reads.len() <= 3));
        assert_eq!(stages.iter().map(|stage| stage.conditions.len()).sum::<usize>(), 20);
    }

    #[test]
    fn a_stage_ends_in_front_of_what_waits_for_a_root() {
        let sums = |from: &Ident, to: &str| {
            let names = (1..=LENGTH).map(|link| format_ident!("{to}{link}"));
            let names: Vec<Ident> = std::iter::once(from.clone()).chain(names).collect();
            names.windows(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect::<Vec<_>>()
        };
        let [early, late] = ["early", "late"].map(|name| format_ident!("{name}{LENGTH}"));
        let before = sums(&ident("a"), "early").into_iter().map(|(from, to)| quote!(let #to = #from + a;));
        let mut statements: Vec<TokenStream> = before.collect();
        statements.push(quote!(let aside = early1 + a;));
        statements.push(quote!(let root = math::sqrt(#early);));
        statements.push(quote!(let beside = a + aside;));
        let behind = sums(&ident("root"), "late").into_iter().map(|(from, to)| quote!(let #to = #from + beside;));
        statements.extend(behind);
        let stages = staged(statements, Vec::new(), vec![quote!(#early), quote!(#late)], &[ident("a")]);
        let names = |stage: &Stage| stage.reads.iter().map(|(name, _)| name.to_string()).collect::<Vec<_>>();
        assert_eq!(stages.len(), 2);
        assert_eq!(names(&stages[0]), ["a"]);
        // What nothing waits for stands where it is read, as one number is kept for it as well as another.
        assert_eq!(names(&stages[1]), ["a", "early1", "root"]);
        assert_eq!(stages[1].statements.len(), 2 + LENGTH);
    }

    /// The stage that begins behind a sine and a root finds the quotient that it reads, unless it has a root of its own.
    #[test]
    fn a_quotient_is_found_where_nothing_else_takes_long() {
        let stage_of_the_quotient = |own: TokenStream| {
            let mut statements = vec![
                quote!(let (quarters, rest, tail) = math::short_angle(angle);),
                quote!(let (sine, _) = math::short_sin_cos(quarters, rest, tail);),
                quote!(let root = math::sqrt(sine);),
                quote!(let quotient = 1.0 / sine;),
                quote!(let x0 = root + quotient;),
            ];
            for link in 0..LENGTH {
                let (from, to) = (format_ident!("x{link}"), format_ident!("x{}", link + 1));
                statements.push(quote!(let #to = #from + angle;));
            }
            statements.push(quote!(let own = #own;));
            let last = format_ident!("x{LENGTH}");
            let stages = staged(statements, Vec::new(), vec![quote!(#last), quote!(own)], &[ident("angle")]);
            let is_the_quotient = |one: &Statement| one.code.to_string().starts_with("let quotient");
            stages.iter().position(|stage| stage.statements.iter().any(is_the_quotient))
        };
        assert_eq!(stage_of_the_quotient(quote!(root + angle)), Some(2));
        assert_eq!(stage_of_the_quotient(quote!(math::sqrt(root))), Some(1));
    }

    #[test]
    fn a_result_is_read_where_it_is() {
        let statements = vec![
            quote!(let (quarters, rest, tail) = math::short_angle(angle);),
            quote!(let (sine, cosine) = math::short_sin_cos(quarters, rest, tail);),
        ];
        let stages = staged(statements, Vec::new(), vec![quote!(angle), quote!(rest), quote!(sine)], &[ident("angle")]);
        assert_eq!(
            stages[1].reads.iter().map(|(_, column)| *column).collect::<Vec<_>>(),
            [Column::Kept(0), Column::Result(1), Column::Kept(1)]
        );
    }

    /// What is prepared once for all positions is no number of a column.
    #[test]
    fn a_result_that_no_statement_finds_is_read_where_it_is() {
        let statements = vec![
            quote!(let (quarters, rest, tail) = math::short_angle(angle + length);),
            quote!(let (sine, _) = math::short_sin_cos(quarters, rest, tail);),
            quote!(let place = length * sine;),
        ];
        let stages = staged(statements, Vec::new(), vec![quote!(length), quote!(place)], &[ident("angle")]);
        assert!(stages.iter().all(|stage| stage.reads.iter().all(|(name, _)| name != "length")));
        assert_eq!(stages[0].keeps[0].0, Column::Result(0));
    }

    #[test]
    fn names_are_those_of_values() {
        let found = |code: TokenStream| Words::of(&code).names.into_keys().collect::<Vec<_>>();
        assert_eq!(found(quote!(math::sqrt(sqrt_of.abs() + 2.0 * x) - f64::from(y))), ["sqrt_of", "x", "y"]);
        let is_long = |code: TokenStream| Words::of(&code).are_long();
        assert!(is_long(quote!(2.0 * math::sqrt(x))) && !is_long(quote!(2.0 * sqrt)));
    }

    #[test]
    fn no_stage_is_short() {
        for links in 1..150 {
            let stages = chain(links);
            let short = |stage: &Stage| {
                stage.statements.iter().map(|one| Words::of(&one.code).operations()).sum::<usize>() < LENGTH / 2
            };
            assert!(stages.len() <= 2 || !stages[1..].iter().any(short), "{links}");
        }
    }

    #[test]
    fn stages_are_neither_long_nor_many() {
        let work = |stage: &Stage| stage.statements.iter().map(|one| Words::of(&one.code).operations()).sum::<usize>();
        let stages = chain(200);
        assert!(
            stages.iter().all(|stage| work(stage) <= 2 * LENGTH),
            "{:?}",
            stages.iter().map(work).collect::<Vec<_>>()
        );
        assert!(stages.len() <= 3 + 400 / (LENGTH / 2));
        // What is short stays together, but for the angle of a sine.
        assert_eq!(chain(5).len(), 2);
        assert_eq!(staged(Vec::new(), Vec::new(), vec![TokenStream::new()], &[]).len(), 1);
    }
}
