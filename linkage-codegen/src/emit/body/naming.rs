//! Names of values: those that rules have given; of others what they are, or what they are part of.

use std::collections::BTreeMap;

use proc_macro2::Ident;

use super::Body;
use crate::emit::forms::{Forms, scaled};
use crate::emit::formula::Values;
use crate::graph::{Failure, Kernel, Op};
use crate::program::{Step, ValueId};

impl Body<'_> {
    /// The label of a value; of an unlabelled one, what it is, or what it is part of.
    pub(super) fn wanted_name(
        &self,
        value: ValueId,
        readers: &[Option<Reader>],
        coefficients: &BTreeMap<ValueId, String>,
    ) -> String {
        if let Some(name) = self.given_name(value).or_else(|| self.name_by_operation(value)) {
            return name;
        }
        if let (None, Some(name)) = (self.scaled_name(value), coefficients.get(&value)) {
            return name.clone();
        }
        match &readers[value.index()] {
            Some(Reader::One(name)) => format!("{name}_part"),
            Some(Reader::Several(common)) => match (self.scaled_name(value), common.as_str()) {
                (Some(name), _) => name,
                (None, "") => self.name_by_form(value).unwrap_or_else(|| "shared".to_owned()),
                // Names of what is made of parameters have those of parameters in common, which says little.
                (None, common) => {
                    let form = self.program.prepares().then(|| self.name_by_form(value)).flatten();
                    form.unwrap_or_else(|| format!("{common}_part"))
                }
            },
            None => "part".to_owned(),
        }
    }

    /// The name of what is called by what it is: results of kernels, and absolute values.
    fn name_by_operation(&self, value: ValueId) -> Option<String> {
        match self.program.op(value)? {
            Op::Abs(of) => self.names.get(of).map(|of| format!("abs_{of}")),
            Op::Kernel { kernel: Kernel::MulAdd, .. } => None,
            Op::Kernel { kernel, part, args } => {
                let of = args.first().and_then(|arg| self.names.get(arg));
                let of = of.map_or_else(|| "angle".to_owned(), ToString::to_string);
                Some(match (kernel, part) {
                    (Kernel::SinCos | Kernel::SinCosSum(_), 0) => format!("sin_{of}"),
                    (Kernel::SinCos | Kernel::SinCosSum(_), _) => format!("cos_{of}"),
                    (Kernel::Atan2 | Kernel::MulAdd, _) => format!("angle_{of}"),
                    (Kernel::Unit, part) => {
                        format!("unit_{}_{}", of.trim_end_matches("_x"), if *part == 0 { "x" } else { "y" })
                    }
                    (Kernel::Search { .. }, part) => format!("found_{part}"),
                    (Kernel::Solve2 | Kernel::Solve3 | Kernel::Solve(_), part) => format!("solved_{}", part + 1),
                })
            }
            _ => None,
        }
    }

    /// The name that a value has from its label, or as a result.
    fn given_name(&self, value: ValueId) -> Option<String> {
        let label = self.program.value(value).label.as_ref().map(|label| label.name.clone());
        label.or_else(|| self.result_name(value))
    }

    /// The name of a multiple of a named value, or of its opposite.
    fn scaled_name(&self, value: ValueId) -> Option<String> {
        let is_constant = |of: &ValueId| self.program.constant(self.graph, *of).is_some();
        match self.program.op(value)? {
            Op::Neg(of) => self.names.get(of).map(|of| format!("minus_{of}")),
            Op::Mul(factor, of) | Op::Mul(of, factor) if is_constant(factor) => {
                self.names.get(of).map(|of| scaled(&of.to_string()))
            }
            _ => None,
        }
    }

    /// The name of what is read by values that have nothing in common: what it is made of, if that is little.
    fn name_by_form(&self, value: ValueId) -> Option<String> {
        let names = |value| self.names.get(&value).map(ToString::to_string);
        let terms = Values { program: self.program, names: &names, of: value };
        let name = Forms { graph: self.graph, terms: &terms }.name(value);
        name.filter(|name| !name.contains("shared"))
    }

    /// The names of the coefficients of linear equations: each by its equation and what it is multiplied by.
    pub(super) fn coefficients(&self) -> BTreeMap<ValueId, String> {
        let mut names: BTreeMap<ValueId, String> = BTreeMap::new();
        let mut columns: BTreeMap<&[ValueId], BTreeMap<usize, Option<Reader>>> = BTreeMap::new();
        for value in self.program.computed() {
            let Some(Op::Kernel { kernel, args, part }) = self.program.op(value) else { continue };
            let unknowns = match kernel {
                Kernel::Solve2 | Kernel::Solve3 => usize::from(kernel.parts()),
                Kernel::Solve(unknowns) => usize::from(*unknowns),
                _ => continue,
            };
            // Equations with other right sides have the same coefficients.
            let column =
                columns.entry(&args[..unknowns * unknowns]).or_default().entry(usize::from(*part)).or_default();
            Reader::join(column, self.given_name(value).map(Reader::One).as_ref());
        }
        for (coefficients, columns) in columns {
            let unknowns = coefficients.len().isqrt();
            for (index, coefficient) in coefficients.iter().enumerate() {
                let (row, column) = (index / unknowns + 1, index % unknowns);
                let unknown = match columns.get(&column) {
                    Some(Some(Reader::One(name) | Reader::Several(name))) if !name.is_empty() => name.clone(),
                    _ => format!("unknown_{}", column + 1),
                };
                names.entry(*coefficient).or_insert_with(|| format!("equation_{row}_by_{unknown}"));
            }
        }
        names
    }

    /// What reads each value: the named values that are computed from it, by way of unnamed ones; or what it is compared with.
    pub(super) fn readers(&self) -> Vec<Option<Reader>> {
        let mut readers: Vec<Option<Reader>> = vec![None; self.program.values.len()];
        let mut compared = readers.clone();
        for step in self.program.steps.iter().rev() {
            let (known, own) = match step {
                Step::Let(value) => {
                    let own = self.given_name(*value).map(Reader::One).or_else(|| readers[value.index()].clone());
                    let limits = compared[value.index()].clone();
                    for of in self.program.operands_of(step) {
                        Reader::join(&mut compared[of.index()], limits.as_ref());
                    }
                    (&mut readers, own)
                }
                Step::Check { guard, .. } => {
                    (&mut compared, subject(&guard.failure).map(|of| Reader::One(format!("{of}_limit"))))
                }
                Step::FiniteInput(_) | Step::FiniteResults(_) => continue,
            };
            for of in self.program.operands_of(step) {
                Reader::join(&mut known[of.index()], own.as_ref());
            }
        }
        readers.into_iter().zip(compared).map(|(reader, limit)| reader.or(limit)).collect()
    }

    /// What each value is for of which no label says what it means: a result, or the named ones that are computed from it, by way of unnamed ones.
    pub(super) fn purposes(&self) -> BTreeMap<ValueId, String> {
        let says_nothing =
            |value: &ValueId| self.program.value(*value).label.as_ref().is_none_or(|label| label.equation.is_empty());
        let mut served: BTreeMap<ValueId, Vec<ValueId>> = BTreeMap::new();
        for step in self.program.steps.iter().rev() {
            let Step::Let(value) = step else { continue };
            let own = match self.given_name(*value) {
                Some(_) => vec![*value],
                None => served.get(value).cloned().unwrap_or_default(),
            };
            for of in self.program.operands_of(step).into_iter().filter(says_nothing) {
                let known = served.entry(of).or_default();
                // The steps are read backwards.
                let new: Vec<ValueId> = own.iter().copied().filter(|value| !known.contains(value)).collect();
                known.splice(0..0, new);
            }
        }
        let part_of = |(value, of): (ValueId, Vec<ValueId>)| {
            let names: Vec<&Ident> = of.iter().filter_map(|value| self.names.get(value)).collect();
            (value, part_of(&names))
        };
        let prepares = self.program.prepares();
        let results = self.program.outputs.iter().map(|(path, of)| {
            // What limits are compared by are results without a name.
            let what = if prepares && !path.is_empty() { "prepared for poses and scenes" } else { "a result" };
            (*of, what.to_owned())
        });
        served.into_iter().map(part_of).chain(results).collect()
    }

    /// The name of a result; of one of those that are compared with each other, that it is one.
    fn result_name(&self, value: ValueId) -> Option<String> {
        let path = self.results.get(&value)?;
        Some(if path.is_empty() { "compared".to_owned() } else { path.replace('.', "_") })
    }
}

/// The named values that an unnamed one is part of.
#[derive(Clone, PartialEq, Eq)]
pub(super) enum Reader {
    /// The only one.
    One(String),
    /// What the names of several have in common; may be empty.
    Several(String),
}

impl Reader {
    /// Another reader is found.
    fn join(known: &mut Option<Self>, other: Option<&Self>) {
        let joined = match (known.take(), other) {
            (Some(Self::One(one)), Some(Self::One(other))) if one == *other => Some(Self::One(one)),
            (Some(Self::One(one) | Self::Several(one)), Some(Self::One(other) | Self::Several(other))) => {
                Some(Self::Several(in_common(&one, other)))
            }
            (known, other) => known.or_else(|| other.cloned()),
        };
        *known = joined;
    }
}

/// The words that two names both begin or both end with, if they say more than a component.
fn in_common(one: &str, other: &str) -> String {
    let [a, b] = [one, other].map(|name| name.split('_').collect::<Vec<_>>());
    let alike = |(a, b): &(&&str, &&str)| a == b;
    let first = a.iter().zip(&b).take_while(alike).count();
    let last = a.iter().rev().zip(b.iter().rev()).take_while(alike).count();
    let words = if first >= last { &a[..first] } else { &a[a.len() - last..] };
    // A name begins with a letter, and a component or a number alone says nothing.
    let begins = |word: &&str| word.starts_with(char::is_alphabetic);
    let words = &words[words.iter().position(begins).unwrap_or(words.len())..];
    let says_nothing = |word: &&str| ["x", "y", "cos", "sin"].contains(word) || !begins(word);
    if words.iter().all(says_nothing) { String::new() } else { words.join("_") }
}

/// That a value is part of these.
fn part_of(names: &[&Ident]) -> String {
    match names {
        [] => String::new(),
        [one] => format!("part of {one}"),
        [one, other] => format!("part of {one} and {other}"),
        [one, other, third] => format!("part of {one}, {other} and {third}"),
        [one, other, ..] => format!("part of {one}, {other} and others"),
    }
}

/// What a check is about, as a part of a name.
fn subject(failure: &Failure<ValueId>) -> Option<String> {
    match failure {
        Failure::DeadCentre { pivot, .. } => Some(pivot.clone()),
        Failure::CannotAssemble { joint, .. } | Failure::CoincidentPivots { joint, .. } => Some(joint.clone()),
        Failure::OtherSide { joint } => Some(format!("side_of_{joint}")),
        Failure::CoincidentEnds { of } => Some(of.clone()),
        Failure::NoDirection { .. } => Some("size".to_owned()),
        Failure::NoConvergence { .. } | Failure::Parameter { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::in_common;

    #[test]
    fn what_names_have_in_common_is_a_name_too() {
        for (one, other, common) in [
            ("A_x", "A_y", "A"),
            ("F13_T12", "F14_T12", "T12"),
            ("B_x", "A_x", ""),
            ("da_B_2_x", "inertia_coupler_2_x", ""),
            ("B_2_y", "C_2_y", ""),
            ("2_a_x", "3_a_x", "a_x"),
            ("v_β_x", "v_β_y", "v_β"),
            ("sum", "", ""),
            ("", "", ""),
        ] {
            assert_eq!(in_common(one, other), common, "{one}, {other}");
            assert_eq!(in_common(other, one), common, "{other}, {one}");
        }
    }
}
