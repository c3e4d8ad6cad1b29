//! Which names are declared, and as what.

use std::collections::BTreeMap;

use crate::diagnostics::{Diagnostic, Sink};
use crate::model::units::unit_names;
use crate::syntax::ast::{Ast, Item, Name};

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Param,
    Link,
    Joint,
    Drive,
    Unknown,
    Load,
    Scene,
    /// Its item could not be read: it may stand for anything.
    Broken,
}

impl Role {
    fn describe(self) -> &'static str {
        match self {
            Self::Param => "a parameter",
            Self::Link => "a link",
            Self::Joint => "a joint",
            Self::Drive => "a drive",
            Self::Unknown => "an unknown",
            Self::Load => "a load",
            Self::Scene => "a scene",
            Self::Broken => "something",
        }
    }

    fn noun(self) -> &'static str {
        self.describe().trim_start_matches("an ").trim_start_matches("a ")
    }
}

struct Entry {
    role: Role,
    index: usize,
}

/// The names of all items.
pub(super) struct Names {
    entries: BTreeMap<String, Entry>,
}

/// Names of functions in expressions.
pub(super) const FUNCTIONS: [&str; 8] = ["sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2"];

impl Names {
    /// Every name with its role and its place in the list of that role. The ground is the first link.
    pub(super) fn collect(ast: &Ast, sink: &Sink) -> Self {
        let mut names = Self { entries: BTreeMap::new() };
        let mut counts: [usize; 8] = [0; 8];
        counts[Role::Link as usize] = 1;
        names.entries.insert("ground".into(), Entry { role: Role::Link, index: 0 });
        for item in &ast.items {
            let (role, name) = match item {
                Item::Param(p) => (Role::Param, &p.name),
                Item::Link(l) => match &l.name {
                    Some(name) => (Role::Link, name),
                    None => continue,
                },
                Item::Joint(j) => (Role::Joint, &j.name),
                Item::Drive(d) => (Role::Drive, &d.name),
                Item::Unknown(u) => (Role::Unknown, &u.name),
                Item::Load(l) => (Role::Load, &l.name),
                Item::Scene(s) => (Role::Scene, &s.name),
                Item::Broken(Some(broken)) => (Role::Broken, &broken.name),
                _ => continue,
            };
            let index = counts[role as usize];
            counts[role as usize] += 1;
            names.declare(name, Entry { role, index }, sink);
        }
        names
    }

    fn declare(&mut self, name: &Name, entry: Entry, sink: &Sink) {
        if entry.role == Role::Param
            && (name.text == "pi" || FUNCTIONS.contains(&name.text.as_str()) || unit_names().any(|u| u == name.text))
        {
            sink.report(
                Diagnostic::new(name.place(), format!("`{name}` means something else where values are written"))
                    .help("units and functions keep their names: call the parameter differently"),
            );
        }
        match self.entries.get(&name.text) {
            Some(first) if name.text == "ground" => {
                debug_assert!(first.role == Role::Link);
                sink.report(
                    Diagnostic::new(name.place(), "`ground` is the fixed link, declared as `ground { … }`"),
                );
            }
            Some(first) if first.role != Role::Broken && entry.role != Role::Broken => sink.report(
                Diagnostic::new(name.place(), format!("the name `{name}` is taken: it is {} already", first.role.describe()))
                    .help("parameters, links, joints, drives, unknowns, loads and scenes share their names: choose another one"),
            ),
            Some(_) => {}
            None => {
                self.entries.insert(name.text.clone(), entry);
            }
        }
    }

    /// The place of a name in the list of its role; `None` if its item could not be read.
    pub(super) fn find(&self, role: Role, name: &Name) -> Result<Option<usize>, Diagnostic> {
        match self.entries.get(&name.text) {
            Some(entry) if entry.role == Role::Broken => Ok(None),
            Some(entry) if entry.role == role => Ok(Some(entry.index)),
            Some(entry) => Err(Diagnostic::new(
                name.place(),
                format!("`{name}` is {}, and {} is needed here", entry.role.describe(), role.describe()),
            )
            .suggest(&name.text, self.of(role))),
            None => Err(Diagnostic::new(name.place(), format!("there is no {} `{name}`", role.noun()))
                .suggest(&name.text, self.of(role))),
        }
    }

    /// What a name stands for.
    pub(super) fn role(&self, name: &str) -> Option<(Role, usize)> {
        self.entries.get(name).map(|entry| (entry.role, entry.index))
    }

    /// All names of a role.
    pub(super) fn of(&self, role: Role) -> impl Iterator<Item = &str> {
        self.entries.iter().filter(move |(_, entry)| entry.role == role).map(|(name, _)| name.as_str())
    }
}
