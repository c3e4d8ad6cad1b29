//! The body of a function: a program as statements.

mod blocks;
mod naming;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use self::blocks::Blocks;
use super::docs::told;
use super::formula::{Formula, Values};
use super::literals::{ident, literal};
use crate::graph::number::Number;
use crate::graph::{Condition, Failure, Graph, Guard, Kernel, Op, Scalar};
use crate::model::{Model, OWN_PATTERNS};
use crate::program::{Definition, Input, Program, Step, Value, ValueId};

/// How tightly an expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Choice,
    Sum,
    Product,
    Sign,
    Atom,
}

struct Code {
    tokens: TokenStream,
    binding: Binding,
}

impl Code {
    fn atom(tokens: TokenStream) -> Self {
        Self { tokens, binding: Binding::Atom }
    }

    /// The tokens, in parentheses unless they bind at least this tightly.
    fn within(self, binding: Binding) -> TokenStream {
        let tokens = self.tokens;
        if self.binding >= binding { tokens } else { quote!((#tokens)) }
    }
}

/// Writes a program as statements.
pub(super) struct Body<'a> {
    program: &'a Program,
    graph: &'a Graph,
    /// The name of every value that has its own statement, or is an input.
    names: BTreeMap<ValueId, Ident>,
    checks: Checks,
    /// The path of every value that is a result; the first, of several.
    results: BTreeMap<ValueId, &'a str>,
    /// What values are for of which no label says what they mean.
    purposes: BTreeMap<ValueId, String>,
    /// Of sines that are found in two statements, what lies between.
    angles: BTreeMap<(Kernel, Vec<ValueId>), [Ident; 3]>,
}

/// A `let` statement.
pub(super) struct Statement<'a> {
    section: &'a str,
    meaning: Cow<'a, str>,
    pub(super) code: TokenStream,
}

#[cfg(test)]
impl From<TokenStream> for Statement<'_> {
    fn from(code: TokenStream) -> Self {
        Self { section: "", meaning: Cow::Borrowed(""), code }
    }
}

/// What stands above a condition in the derivation, before the error if it does not hold.
pub(super) const REQUIRED: &str = "required, else";

/// What stands above values, one after the other: the heading of a new section, and what a value means.
#[derive(Default)]
struct Notes<'a> {
    section: &'a str,
    meaning: Cow<'a, str>,
}

impl<'a> Notes<'a> {
    /// What stands above the next value. What holds for the one before as well, as for the components of a vector, is not said again.
    fn above(&mut self, section: &'a str, meaning: Cow<'a, str>) -> (Option<&'a str>, Option<Cow<'a, str>>) {
        let heading = Some(section).filter(|section| !section.is_empty() && *section != self.section);
        let is_said = heading.is_none() && meaning == self.meaning;
        let said = (!meaning.is_empty() && !is_said).then(|| meaning.clone());
        (self.section, self.meaning) = (heading.unwrap_or(self.section), meaning);
        (heading, said)
    }

    /// The statement with what stands above it.
    fn with(&mut self, Statement { section, meaning, code }: &Statement<'a>) -> TokenStream {
        let (heading, meaning) = self.above(section, meaning.clone());
        let [heading, meaning] =
            [heading.map(|heading| format!(" — {heading} —")), meaning.map(|meaning| format!(" {meaning}"))]
                .map(|text| text.map(|text| quote!(#[doc = #text])));
        quote!(#heading #meaning #code)
    }
}

/// Statements with their headings and meanings.
pub(super) fn with_notes(statements: &[Statement]) -> TokenStream {
    let mut notes = Notes::default();
    statements.iter().map(|statement| notes.with(statement)).collect()
}

/// What is checked beside statements without a branch.
#[derive(Clone, Debug)]
pub(super) enum Question {
    /// Holds, or else the results mean nothing.
    Holds(TokenStream),
    /// Gives marks if they do not.
    Marks(TokenStream),
}

impl Question {
    pub(super) fn code(&self) -> &TokenStream {
        match self {
            Self::Holds(code) | Self::Marks(code) => code,
        }
    }
}

/// What becomes of a check.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Checks {
    /// Where it fails the function ends, and says why.
    Reported,
    /// Where it fails the function ends with nothing.
    Silent,
    /// All are computed at the end, and no branch depends on them.
    Gathered,
}

/// The calls of which several results may be read: one statement for all of them.
type Calls = BTreeMap<(Kernel, Vec<ValueId>), Vec<(u8, ValueId)>>;

impl<'a> Body<'a> {
    /// Names all values. `input` gives the names of inputs; no other name equals one of these or of `taken`.
    pub(super) fn new(program: &'a Program, graph: &'a Graph, input: &dyn Fn(Input) -> String, taken: &[&str]) -> Self {
        let mut used: BTreeSet<String> = taken.iter().copied().chain(OWN_PATTERNS).map(str::to_owned).collect();
        let mut names = BTreeMap::new();
        for (value, which) in program.inputs() {
            let name = input(which);
            used.insert(name.clone());
            names.insert(value, ident(&name));
        }
        let mut body = Self {
            program,
            graph,
            names,
            checks: Checks::Reported,
            results: program.outputs.iter().rev().map(|(path, value)| (*value, path.as_str())).collect(),
            purposes: BTreeMap::new(),
            angles: BTreeMap::new(),
        };
        let mut uses = program.uses();
        // The results of one call read their arguments together.
        let mut calls = BTreeSet::new();
        for (kernel, args) in body.kernels() {
            if !calls.insert((kernel, args.clone())) {
                args.iter().for_each(|arg| uses[arg.index()] -= 1);
            }
        }
        let (readers, coefficients) = (body.readers(), body.coefficients());
        for step in &program.steps {
            let Step::Let(value) = step else { continue };
            let own = program.value(*value).label.is_some()
                || uses[value.index()] > 1
                || matches!(program.op(*value), Some(Op::Kernel { kernel, .. }) if *kernel != Kernel::MulAdd)
                || body.results.contains_key(value);
            if own {
                // A name that is made of a keyword is none.
                let wanted = body.wanted_name(*value, &readers, &coefficients).replace("r#", "");
                let name = new_name(&mut used, &wanted);
                body.names.insert(*value, ident(&name));
            }
        }
        body.purposes = body.purposes();
        body
    }

    /// The section of a value, and what it means, or what it is for.
    fn notes_of(&self, value: ValueId) -> (&'a str, Cow<'a, str>) {
        let Value { section, label, .. } = self.program.value(value);
        let meaning = match label {
            Some(label) if !label.equation.is_empty() => Cow::Borrowed(label.equation.as_str()),
            _ => self.purposes.get(&value).cloned().map(Cow::Owned).unwrap_or_default(),
        };
        (section, meaning)
    }

    /// The same, of a function that gives nothing where a check fails.
    pub(super) fn without_reasons(mut self) -> Self {
        self.checks = Checks::Silent;
        self
    }

    /// All statements, without a branch, and the conditions under which the results mean something.
    pub(super) fn straight(mut self) -> (Vec<Statement<'a>>, Vec<Question>, Self) {
        self.checks = Checks::Gathered;
        self.angles = self.angles();
        let body = self;
        let mut calls = body.calls();
        let values = body.program.steps.iter().filter_map(|step| match step {
            Step::Let(value) => Some(*value),
            _ => None,
        });
        let statements = values.flat_map(|value| body.let_statements(value, &mut calls)).collect();
        let angles = body.angles.values().map(|[quarters, ..]| Question::Marks(quote!(math::far(#quarters))));
        // Every angle is far that is not finite.
        let sines = body.program.steps.iter().filter_map(|step| match step {
            Step::Let(value) => Some(*value).filter(|value| body.is_sine(*value)),
            _ => None,
        });
        let shown = body.program.shown_by(sines);
        let checks = body.program.steps.iter().filter_map(|step| match step {
            Step::Let(_) => None,
            Step::Check { guard, .. } => Some(Question::Holds(body.condition(guard))),
            Step::FiniteInput(value) if shown.contains(value) => None,
            Step::FiniteInput(value) => {
                let value = body.code(*value).within(Binding::Atom);
                Some(Question::Holds(quote!(#value.is_finite())))
            }
            Step::FiniteResults(checked) => {
                // A loop over positions waits for neither: what counts are operations. Each number that is asked takes three: for its size,
                // for the comparison, and for what gathers them. Of results that is their sum, of arguments every one.
                let (_, others) = body.moderate();
                if body.program.moderate.is_empty() || checked.len() + 2 <= 3 * others.len() {
                    let values = body.array(checked);
                    Some(Question::Marks(quote!(math::not_finite(#values))))
                } else if others.is_empty() {
                    None
                } else {
                    let arguments = body.array(&others);
                    Some(Question::Holds(quote!(math::each_moderate(#arguments))))
                }
            }
        });
        let conditions = checks.chain(angles).collect();
        (statements, conditions, body)
    }

    /// Every call of a kernel, with its arguments.
    fn kernels(&self) -> impl Iterator<Item = (Kernel, Vec<ValueId>)> + '_ {
        self.program.steps.iter().filter_map(|step| match step {
            Step::Let(value) => match self.program.op(*value) {
                Some(Op::Kernel { kernel, args, .. }) => Some((*kernel, args.clone())),
                _ => None,
            },
            _ => None,
        })
    }

    fn is_sine(&self, value: ValueId) -> bool {
        matches!(self.program.op(value), Some(Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_), .. }))
    }

    /// The program as equations, a line each, under the headings of its sections, and what it requires; a line above says what it means.
    pub(super) fn equations(&self, model: &Model) -> Vec<String> {
        let mut notes = Notes::default();
        let mut lines = Vec::new();
        for step in &self.program.steps {
            match step {
                Step::Let(of) => {
                    let Some(name) = self.names.get(of) else { continue };
                    let (section, meaning) = self.notes_of(*of);
                    let (heading, meaning) = notes.above(section, meaning);
                    lines.extend(heading.map(|heading| format!("{heading}:")));
                    lines.extend(meaning.map(|meaning| format!("  {meaning}")));
                    lines.push(format!("    {name} = {}", self.formula(model, *of)));
                }
                Step::Check { guard, .. } => {
                    let (error, what) = told(&guard.failure);
                    let meaning = format!("{REQUIRED} {error}: {}", what.replace('`', ""));
                    lines.extend(notes.above("", meaning.into()).1.map(|meaning| format!("  {meaning}")));
                    let [value, limit] = guard.condition.operands().map(|side| self.shown(model, side));
                    let sign = match guard.condition {
                        Condition::Above { .. } => '>',
                        Condition::AtLeast { .. } => '≥',
                    };
                    lines.push(format!("    {value} {sign} {limit}"));
                }
                Step::FiniteInput(_) | Step::FiniteResults(_) => {}
            }
        }
        lines
    }

    /// What a value is made of, as text.
    fn formula(&self, model: &Model, of: ValueId) -> String {
        let names = |value| self.names.get(&value).map(ToString::to_string);
        Formula { model, terms: Values { program: self.program, names: &names, of } }.of(of)
    }

    /// The name of a value; of one without, what it is made of.
    fn shown(&self, model: &Model, value: ValueId) -> String {
        self.names.get(&value).map_or_else(|| self.formula(model, value), ToString::to_string)
    }

    /// What is kept of the program for others, a line each where it is not kept under the name that it has here.
    pub(super) fn kept(&self, model: &Model) -> Vec<String> {
        let kept = self.program.outputs.iter().map(|(name, value)| (name, self.shown(model, *value)));
        let lines: Vec<String> =
            kept.filter(|(name, text)| *name != text).map(|(name, text)| format!("    {name} = {text}")).collect();
        let heading = (!lines.is_empty()).then(|| "Kept as:".to_owned());
        heading.into_iter().chain(lines).collect()
    }

    /// The name or the written-out expression of a value.
    pub(super) fn value(&self, value: ValueId) -> TokenStream {
        self.code(value).tokens
    }

    fn code(&self, value: ValueId) -> Code {
        match self.names.get(&value) {
            Some(name) => Code::atom(quote!(#name)),
            None => self.written_out(value),
        }
    }

    /// Whether the written-out expression of a value has the type of its literals alone.
    fn is_literal(&self, value: ValueId) -> bool {
        let is_literal = |of: &ValueId| !self.names.contains_key(of) && self.is_literal(*of);
        match self.program.op(value) {
            Some(Op::Constant(_)) => true,
            Some(Op::Neg(a) | Op::Where { then: a, .. }) => is_literal(a),
            Some(Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b)) => is_literal(a) && is_literal(b),
            _ => false,
        }
    }

    fn scalar(&self) -> Ident {
        ident(self.graph.scalar().name())
    }

    fn written_out(&self, value: ValueId) -> Code {
        let Definition::Computed(op) = &self.program.value(value).definition else { return Code::atom(quote!(0.0)) };
        let within = |id: &ValueId, binding| self.code(*id).within(binding);
        let plain = |id: &ValueId| self.code(*id).tokens;
        match op {
            Op::Constant(number) => match literal(&self.graph.number(*number), self.graph.scalar()) {
                Some((true, literal)) => Code { tokens: quote!(-#literal), binding: Binding::Sign },
                Some((false, literal)) => Code::atom(quote!(#literal)),
                None => Code::atom(quote!(0.0)),
            },
            Op::Neg(a) => {
                let a = within(a, Binding::Sign);
                Code { tokens: quote!(-#a), binding: Binding::Sign }
            }
            Op::Add(a, b) => {
                // The right operand of a sum keeps its own order of evaluation.
                let (a, b) = (within(a, Binding::Sum), within(b, Binding::Product));
                Code { tokens: quote!(#a + #b), binding: Binding::Sum }
            }
            Op::Sub(a, b) => {
                let (a, b) = (within(a, Binding::Sum), within(b, Binding::Product));
                Code { tokens: quote!(#a - #b), binding: Binding::Sum }
            }
            Op::Mul(a, b) => {
                let (a, b) = (within(a, Binding::Product), within(b, Binding::Sign));
                Code { tokens: quote!(#a * #b), binding: Binding::Product }
            }
            Op::Div(a, b) => {
                let (a, b) = (within(a, Binding::Product), within(b, Binding::Sign));
                Code { tokens: quote!(#a / #b), binding: Binding::Product }
            }
            Op::Abs(a) if !self.names.contains_key(a) && self.is_literal(*a) => {
                let (scalar, a) = (self.scalar(), plain(a));
                Code::atom(quote!(#scalar::abs(#a)))
            }
            Op::Abs(a) => {
                let a = within(a, Binding::Atom);
                Code::atom(quote!(#a.abs()))
            }
            Op::NonNegative(a) => {
                let a = plain(a);
                Code::atom(quote!(math::non_negative(#a)))
            }
            Op::Lesser(a, b) => {
                let (a, b) = (plain(a), plain(b));
                Code::atom(quote!(math::lesser(#a, #b)))
            }
            Op::Sqrt(a) => {
                let a = plain(a);
                Code::atom(quote!(math::sqrt(#a)))
            }
            Op::Where { value, limit, then } => {
                // Of several conditions, all must hold.
                let mut conditions = vec![(value, limit)];
                let mut then = then;
                while let (None, Some(Op::Where { value, limit, then: inner })) =
                    (self.names.get(then), self.program.op(*then))
                {
                    conditions.insert(0, (value, limit));
                    then = inner;
                }
                let conditions = conditions.into_iter().map(|(value, limit)| {
                    let (value, limit) = (within(value, Binding::Sum), plain(limit));
                    quote!(#value > #limit)
                });
                let (conditions, then) = (conditions.reduce(|all, one| quote!(#all && #one)), plain(then));
                Code { tokens: quote!(if #conditions { #then } else { 0.0 }), binding: Binding::Choice }
            }
            Op::Kernel { kernel, args, part } => {
                let call = self.call(*kernel, args);
                let part = proc_macro2::Literal::u8_unsuffixed(*part);
                Code::atom(if kernel.parts() == 1 { call } else { quote!(#call.#part) })
            }
            Op::Symbol(_) | Op::Quantity(_) | Op::Held(_) | Op::Checked { .. } => Code::atom(quote!(0.0)),
        }
    }

    fn call(&self, kernel: Kernel, args: &[ValueId]) -> TokenStream {
        if let (Kernel::SinCos, [arg]) = (kernel, args)
            && let Some(whole) = self.halved(*arg)
        {
            let function = self.sin_cos("sin_cos_half");
            return quote!(math::#function(#whole));
        }
        let args = args.iter().map(|arg| self.value(*arg)).collect::<Vec<_>>();
        match kernel {
            Kernel::SinCos => {
                let function = self.sin_cos("sin_cos");
                quote!(math::#function(#(#args),*))
            }
            Kernel::SinCosSum(phase) => {
                let function = self.sin_cos("sin_cos_sum");
                let (high, low) = split(&self.graph.number(phase), self.graph.scalar());
                quote!(math::#function(#(#args),*, #high, #low))
            }
            Kernel::Atan2 => quote!(math::atan2(#(#args),*)),
            Kernel::MulAdd => quote!(math::mul_add(#(#args),*)),
            Kernel::Unit => quote!(math::unit(#(#args),*)),
            Kernel::Solve2 | Kernel::Solve3 => {
                let unknowns = usize::from(kernel.parts());
                let (coefficients, right) = args.split_at(unknowns * unknowns);
                let rows = coefficients.chunks(unknowns).map(|row| quote!([#(#row),*]));
                let function = if unknowns == 2 { quote!(solve_2) } else { quote!(solve_3) };
                quote!(math::#function([#(#rows),*], [#(#right),*]))
            }
            Kernel::Solve(unknowns) => {
                let unknowns = usize::from(unknowns);
                let (coefficients, rest) = args.split_at(unknowns * unknowns);
                let (sizes, right) = rest.split_at(unknowns * unknowns);
                let rows = coefficients.chunks(unknowns).map(|row| quote!([#(#row),*]));
                let sizes = sizes.chunks(unknowns).map(|row| quote!([#(#row),*]));
                quote!(math::solve([#(#rows),*], [#(#sizes),*], [#(#right),*]))
            }
            Kernel::Search { search, .. } => super::search::call(self.graph, &self.graph.search(search), &args),
        }
    }

    /// What a value that nothing else reads is half of.
    fn halved(&self, value: ValueId) -> Option<TokenStream> {
        let (None, Some(Op::Mul(half, whole))) = (self.names.get(&value), self.program.op(value)) else { return None };
        let factor = self.program.constant(self.graph, *half);
        let is_half = factor.is_some_and(|factor| factor.compare(&Number::ratio(1, 2)).is_eq());
        is_half.then(|| self.value(*whole))
    }

    /// The function for sine and cosine in the linkage's arithmetic; without its branch if the checks are gathered.
    fn sin_cos(&self, function: &str) -> Ident {
        let short = if self.checks == Checks::Gathered { "short_" } else { "" };
        let fused = if self.graph.is_fused() { "fused_" } else { "" };
        ident(&format!("{short}{fused}{function}"))
    }

    /// Names for the angles of all sines, in quarter turns, and for what is left of each, the rest less the tail.
    fn angles(&self) -> BTreeMap<(Kernel, Vec<ValueId>), [Ident; 3]> {
        let mut used: BTreeSet<String> = self.names.values().map(ToString::to_string).collect();
        let mut angles = BTreeMap::new();
        for step in &self.program.steps {
            if let Step::Let(value) = step
                && self.is_sine(*value)
                && let Some(Op::Kernel { kernel, args, .. }) = self.program.op(*value)
                && !angles.contains_key(&(*kernel, args.clone()))
            {
                let name = self.names.get(value).map(ToString::to_string).unwrap_or_default();
                let name = ["_sin", "_cos"].into_iter().find_map(|part| name.strip_suffix(part)).unwrap_or(&name);
                let parts =
                    ["quarters", "rest", "tail"].map(|part| ident(&new_name(&mut used, &format!("{name}_{part}"))));
                angles.insert((*kernel, args.clone()), parts);
            }
        }
        angles
    }

    /// Without a branch, sine and cosine are two statements: the angle is brought between ±π/4, and both are found of what is left.
    fn in_two(&self, kernel: Kernel, args: &[ValueId]) -> Option<(Statement<'a>, TokenStream)> {
        let [quarters, rest, tail] = self.angles.get(&(kernel, args.to_vec()))?;
        let args = args.iter().map(|arg| self.value(*arg));
        let reduced = match kernel {
            Kernel::SinCosSum(phase) => {
                let function = self.sin_cos("angle_sum");
                let (high, low) = split(&self.graph.number(phase), self.graph.scalar());
                quote!(math::#function(#(#args),*, #high, #low))
            }
            _ => {
                let function = self.sin_cos("angle");
                quote!(math::#function(#(#args),*))
            }
        };
        let function = self.sin_cos("sin_cos");
        let meaning = Cow::Borrowed("the angle in quarter turns, and what is left of it: the rest less the tail");
        Some((
            Statement { section: "", meaning, code: quote!(let (#quarters, #rest, #tail) = #reduced;) },
            quote!(math::#function(#quarters, #rest, #tail)),
        ))
    }

    /// All statements.
    pub(super) fn statements(self) -> (TokenStream, Self) {
        let mut notes = Notes::default();
        let mut calls = self.calls();
        let mut blocks = Blocks::new(self.program.steps.len());
        let angles = self.program.angles();
        for step in &self.program.steps {
            let statement = match step {
                Step::Let(value) => {
                    for statement in self.let_statements(*value, &mut calls) {
                        blocks.add(notes.with(&statement), &statement.code, statement.section);
                    }
                    continue;
                }
                Step::Check { guard, weaker, .. } => self.check(guard, weaker.as_ref()),
                Step::FiniteInput(value) if angles.contains(value) => self.finite_angle(*value),
                Step::FiniteInput(value) => self.finite_input(*value),
                Step::FiniteResults(checked) => self.finite_results(checked),
            };
            // Behind a check it is said again.
            notes.meaning = Cow::Borrowed("");
            blocks.add(statement.clone(), &statement, notes.section);
        }
        let results = || self.program.outputs.iter().map(|(_, value)| self.value(*value)).collect();
        (blocks.joined(results), self)
    }

    fn calls(&self) -> Calls {
        let mut calls: Calls = BTreeMap::new();
        for step in &self.program.steps {
            if let Step::Let(value) = step
                && let Some(Op::Kernel { kernel, args, part }) = self.program.op(*value)
                && kernel.parts() > 1
            {
                calls.entry((*kernel, args.clone())).or_default().push((*part, *value));
            }
        }
        calls
    }

    /// The statement of a value, if it has one of its own, and that before it if it takes two.
    fn let_statements(&self, value: ValueId, calls: &mut Calls) -> Vec<Statement<'a>> {
        let Some(name) = self.names.get(&value) else { return Vec::new() };
        let call = match self.program.op(value) {
            Some(Op::Kernel { kernel, args, .. }) if kernel.parts() > 1 => match calls.remove(&(*kernel, args.clone()))
            {
                Some(parts) => Some((*kernel, args, parts)),
                // The first result that was read has brought the statement for all.
                None => return Vec::new(),
            },
            _ => None,
        };
        let (section, meaning) = self.notes_of(value);
        let Some((kernel, args, parts)) = call else {
            let code = self.written_out(value).tokens;
            // What holds literals only says of which type they are: methods are called on it.
            let ty = self.is_literal(value).then(|| self.scalar()).map(|scalar| quote!(: #scalar));
            return vec![Statement { section, meaning, code: quote!(let #name #ty = #code;) }];
        };
        let pattern = self.pattern(kernel, &parts);
        let (first, code) = match self.in_two(kernel, args) {
            Some((first, code)) => (Some(Statement { section, ..first }), code),
            None => (None, self.call(kernel, args)),
        };
        first.into_iter().chain([Statement { section, meaning, code: quote!(let #pattern = #code;) }]).collect()
    }

    /// What the results of a call are bound to.
    fn pattern(&self, kernel: Kernel, read: &[(u8, ValueId)]) -> TokenStream {
        let part = |which: u8| {
            let value = read.iter().find(|(part, _)| *part == which);
            value.and_then(|(_, value)| self.names.get(value)).map_or_else(|| quote!(_), |name| quote!(#name))
        };
        let parts: Vec<TokenStream> = (0..kernel.parts()).map(part).collect();
        match (kernel, &parts[..]) {
            (Kernel::Solve(_), [unknowns @ .., distance]) => quote!(([#(#unknowns),*], #distance)),
            (Kernel::Search { search, .. }, _) => super::search::pattern(&self.graph.search(search), &parts),
            _ => quote!((#(#parts),*)),
        }
    }

    /// What must hold, as one factor.
    fn condition(&self, guard: &Guard<ValueId>) -> TokenStream {
        match guard.condition {
            Condition::Above { value, limit } if self.is_kept(value) && self.is_zero(limit) => {
                let value = self.value(value);
                quote!(math::is_positive(#value))
            }
            Condition::Above { value, limit } => {
                let (value, limit) = (self.code(value).within(Binding::Sum), self.value(limit));
                quote!((#value > #limit))
            }
            Condition::AtLeast { value, limit } => {
                let (value, limit) = (self.code(value).within(Binding::Sum), self.value(limit));
                quote!((#value >= #limit))
            }
        }
    }

    /// Whether a value lies in memory: one that a pose keeps, or its magnitude.
    fn is_kept(&self, value: ValueId) -> bool {
        match &self.program.value(value).definition {
            Definition::Input(input) => matches!(input, Input::Kept(_)),
            Definition::Computed(Op::Abs(value)) => self.is_kept(*value),
            Definition::Computed(_) => false,
        }
    }

    fn is_zero(&self, value: ValueId) -> bool {
        self.program.constant(self.graph, value).is_some_and(|number| number.is_zero())
    }

    fn check(&self, guard: &Guard<ValueId>, weaker: Option<&Guard<ValueId>>) -> TokenStream {
        if self.checks == Checks::Silent {
            let condition = self.condition(guard);
            return quote!(if !#condition { return None; });
        }
        let weaker = weaker.map(|weaker| self.failing(weaker, &TokenStream::new()));
        let late = self.asked_late();
        let given = self.program.given_to(guard).into_iter().map(|value| self.finite_input(value));
        self.failing(guard, &quote!(#late #(#given)* #weaker))
    }

    /// Where a condition does not hold: something else that is asked first, then its own failure.
    fn failing(&self, guard: &Guard<ValueId>, first: &TokenStream) -> TokenStream {
        let condition = self.condition(guard);
        let failure = match &guard.failure {
            Failure::CannotAssemble { group, joint, gap } => {
                let gap = self.value(*gap);
                quote!(Error::CannotAssemble { group: #group, joint: #joint, gap: math::gap(#gap) })
            }
            Failure::CoincidentPivots { group, joint } => {
                quote!(Error::CoincidentPivots { group: #group, joint: #joint })
            }
            Failure::NoConvergence { group, gap } => {
                let gap = self.value(*gap);
                quote!(Error::NoConvergence { group: #group, gap: math::gap(#gap) })
            }
            Failure::DeadCentre { group, pivot } => quote!(Error::DeadCentre { group: #group, pivot: #pivot }),
            Failure::NoDirection { of } => quote!(Error::NoDirection { of: #of }),
            Failure::OtherSide { joint } => quote!(Error::OtherSide { joint: #joint }),
            Failure::CoincidentEnds { of } => quote!(Error::CoincidentEnds { of: #of }),
            Failure::Parameter { requirement } => quote!(Error::Parameter { requirement: #requirement }),
        };
        quote!(if !#condition { #first return Err(#failure); })
    }

    fn finite_input(&self, value: ValueId) -> TokenStream {
        let name = self.value(value);
        asked(&name, &quote!(#name.is_finite()))
    }

    /// The same of an angle: its sine, which asks whether it is short, need not ask again then.
    fn finite_angle(&self, value: ValueId) -> TokenStream {
        let name = self.value(value);
        asked(&name, &quote!(math::is_angle(#name)))
    }

    /// What is asked where something fails, before that is told.
    fn asked_late(&self) -> TokenStream {
        self.program.asked_late.iter().map(|value| self.finite_input(*value)).collect()
    }

    /// Values as an array.
    fn array(&self, checked: &[ValueId]) -> TokenStream {
        let values = checked.iter().map(|value| self.code(*value).tokens);
        quote!([#(#values),*])
    }

    /// The arguments that are looked at in place of results: angles of which a sine is taken, which asks whether they are short, and others.
    fn moderate(&self) -> (Vec<ValueId>, Vec<ValueId>) {
        let angles = self.program.angles();
        self.program.moderate.iter().partition(|value| angles.contains(value))
    }

    fn finite_results(&self, checked: &[ValueId]) -> TokenStream {
        let values = self.array(checked);
        let (angles, others) = self.moderate();
        let short = angles.into_iter().map(|angle| self.value(angle)).map(|angle| quote!(math::is_short(#angle)));
        let others =
            (!others.is_empty()).then(|| self.array(&others)).map(|values| quote!(math::all_moderate(#values)));
        let moderate = match &short.chain(others).collect::<Vec<_>>()[..] {
            [] => TokenStream::new(),
            [one] => quote!(!#one &&),
            all => quote!(!(#(#all)&&*) &&),
        };
        let what = match (self.program.reads_motion(), self.program.reads_loads()) {
            (true, true) => "a rate, an acceleration, a load or a result",
            (true, false) => "a rate, an acceleration or a result",
            (false, true) => "a load or a result",
            (false, false) if self.program.prepares() => "what is made of the parameters",
            (false, false) => "a result",
        };
        let late = self.asked_late();
        quote!(if #moderate !math::all_finite(#values) { #late return Err(Error::NotFinite { what: #what }); })
    }
}

/// Refuses an argument that is not finite.
fn asked(name: &TokenStream, is_finite: &TokenStream) -> TokenStream {
    let text = name.to_string();
    quote!(if !#is_finite { return Err(Error::NotFinite { what: #text }); })
}

/// The wanted name, or with a number the first of that kind that is not used yet.
pub(super) fn new_name(used: &mut BTreeSet<String>, wanted: &str) -> String {
    let mut name = wanted.to_owned();
    let mut number = 2;
    while !used.insert(name.clone()) {
        name = format!("{wanted}_{number}");
        number += 1;
    }
    name
}

/// A constant as an unevaluated sum of two numbers of the scalar.
fn split(number: &crate::graph::number::Number, scalar: Scalar) -> (TokenStream, TokenStream) {
    use super::literals::signed_literal;
    let high = match scalar {
        Scalar::F64 => number.to_f64(),
        Scalar::F32 => f64::from(number.to_f32()),
    };
    let high_number = crate::graph::number::Number::from_f64(high).unwrap_or_else(crate::graph::number::Number::zero);
    (signed_literal(&high_number, scalar), signed_literal(&number.sub(&high_number), scalar))
}
