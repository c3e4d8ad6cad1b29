//! Which names are declared, and as what.

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostics::{Diagnostic, Place, Sink, closest};
use crate::model::units::unit_names;
use crate::syntax::ast::{self, Ast, Broken, Item, Name};
use crate::syntax::{FUNCTIONS, JOINTS};

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
    /// Not even its item's kind could be read: it may stand for anything.
    Broken,
}

impl Role {
    pub(super) fn describe(self) -> &'static str {
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

/// What a name stands for, and its place in the list of that role.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) role: Role,
    pub(super) index: usize,
    /// Its item was read and accepted; of another one, nothing but the name is sure.
    pub(super) sound: bool,
}

impl Entry {
    /// That another role is needed where its name is written.
    pub(super) fn instead_of(&self, role: Role, name: &Name) -> Diagnostic {
        let problem = format!("`{name}` is {}, and {} is needed here", self.role.describe(), role.describe());
        Diagnostic::new(name.place(), problem)
    }
}

/// The names of all items.
pub(super) struct Names {
    entries: BTreeMap<String, Entry>,
    /// Roles of items whose names could not be read: any unknown name may be theirs.
    nameless: Vec<Role>,
    /// Names that were taken already, each with the role of the item that is refused for it.
    refused: Vec<(String, Role)>,
}

/// What an item would declare, and under which name if that could be read.
fn declared(item: &Item) -> Option<(Role, Option<&Name>)> {
    Some(match item {
        Item::Param(param) => (Role::Param, Some(&param.name)),
        Item::Link(link) => (Role::Link, Some(link.name.as_ref()?)),
        Item::Joint(joint) => (Role::Joint, Some(&joint.name)),
        Item::Drive(drive) => (Role::Drive, Some(&drive.name)),
        Item::Unknown(unknown) => (Role::Unknown, Some(&unknown.name)),
        Item::Load(load) => (Role::Load, Some(&load.name)),
        Item::Scene(scene) => (Role::Scene, Some(&scene.name)),
        Item::Broken(broken) => (role_of(broken)?, broken.name.as_ref()),
        _ => return None,
    })
}

/// What an item that could not be read would declare.
pub(super) fn role_of(broken: &Broken) -> Option<Role> {
    let Some(keyword) = &broken.keyword else { return Some(Role::Broken) };
    Some(match keyword.text.as_str() {
        "param" => Role::Param,
        "link" => Role::Link,
        word if JOINTS.contains(&word) => Role::Joint,
        "drive" => Role::Drive,
        "unknown" => Role::Unknown,
        "load" => Role::Load,
        "scene" => Role::Scene,
        "units" | "scalar" | "arithmetic" | "crate" | "emit" | "ground" | "mass" | "assemble" | "start" => return None,
        _ => Role::Broken,
    })
}

/// The name of an item of this role that could not be read.
pub(super) fn unread(item: &Item, role: Role) -> Option<(&Broken, &Name)> {
    match item {
        Item::Broken(broken) if role_of(broken) == Some(role) => Some((broken, broken.name.as_ref()?)),
        _ => None,
    }
}

/// The declaration with one item for each role and name, and one ground: what is there twice is reported and left out.
pub(super) fn distinct(ast: &Ast, sink: &Sink) -> Ast {
    let mut seen: BTreeSet<(usize, String)> = BTreeSet::new();
    let mut items: Vec<Item> = Vec::new();
    let swapped = with_drives_in_order(ast, sink);
    for item in &swapped {
        if let Some((role, Some(name))) = declared(item) {
            let first = seen.insert((role as usize, name.text.clone()));
            if !first {
                if !matches!(item, Item::Broken(_)) {
                    sink.report(taken(name, Entry { role, index: 0, sound: true }));
                }
                continue;
            }
        }
        if let Item::Link(second @ ast::Link { name: None, .. }) = item {
            let first = items.iter_mut().find_map(|item| match item {
                Item::Link(link @ ast::Link { name: None, .. }) => Some(link),
                _ => None,
            });
            if let Some(first) = first {
                sink.report(
                    Diagnostic::new(Place::at(second.keyword), "the linkage has a ground already")
                        .help("put all its points into one `ground { … }`"),
                );
                first.places.extend(second.places.clone());
                continue;
            }
        }
        items.push(item.clone());
    }
    Ast { items, ..ast.clone() }
}

/// The items with `drive JOINT: NAME;` the right way round, which is reported.
fn with_drives_in_order(ast: &Ast, sink: &Sink) -> Vec<Item> {
    let is_joint = |name: &Name| {
        let joints = ast.items.iter().filter_map(declared).filter(|(role, _)| *role == Role::Joint);
        joints.filter_map(|(_, own)| own).any(|own| own.text == name.text)
    };
    let in_order = |item: &Item| match item {
        Item::Drive(drive) if is_joint(&drive.name) && !is_joint(&drive.joint) => {
            let ast::Drive { name: joint, joint: name, .. } = drive.clone();
            let problem = format!("`{joint}` is a joint, and the name of the drive comes first");
            sink.report(Diagnostic::new(joint.place(), problem).help(format!("write `drive {name}: {joint};`")));
            Item::Drive(ast::Drive { name, joint, ..drive.clone() })
        }
        other => other.clone(),
    };
    ast.items.iter().map(in_order).collect()
}

fn taken(name: &Name, by: Entry) -> Diagnostic {
    let problem = format!("the name `{name}` is taken: it is {} already", by.role.describe());
    Diagnostic::new(name.place(), problem)
        .help("parameters, links, joints, drives, unknowns, loads and scenes share their names: choose another one")
}

/// What a name means wherever a value is written.
fn meaning_in_values(name: &str) -> Option<&'static str> {
    match name {
        "pi" => Some("a number"),
        "true" | "false" => Some("a literal of Rust"),
        _ if FUNCTIONS.contains(&name) => Some("a function"),
        _ if unit_names().any(|unit| unit == name) => Some("a unit"),
        _ => None,
    }
}

impl Names {
    /// Every name with its role and its place in the list of that role. The ground is the first link.
    pub(super) fn collect(ast: &Ast, sink: &Sink) -> Self {
        let mut names = Self { entries: BTreeMap::new(), nameless: Vec::new(), refused: Vec::new() };
        let mut counts: [usize; 8] = [0; 8];
        counts[Role::Link as usize] = 1;
        names.entries.insert("ground".into(), Entry { role: Role::Link, index: 0, sound: true });
        for item in &ast.items {
            let Some((role, name)) = declared(item) else { continue };
            let Some(name) = name else {
                names.nameless.push(role);
                continue;
            };
            let index = counts[role as usize];
            counts[role as usize] += 1;
            names.declare(name, Entry { role, index, sound: !matches!(item, Item::Broken(_)) }, sink);
        }
        names
    }

    fn declare(&mut self, name: &Name, mut entry: Entry, sink: &Sink) {
        if !name.is_usable() {
            let problem = format!("`{name}` cannot be a name: Rust keeps the word for itself");
            sink.report(Diagnostic::new(name.place(), problem).help("choose another name"));
        }
        if let Some(other) = meaning_in_values(&name.text).filter(|_| entry.role == Role::Param) {
            sink.report(
                Diagnostic::new(name.place(), format!("`{name}` is {other}, and cannot be the name of a parameter"))
                    .help("choose another name"),
            );
            // Where it stands now it may be meant as either.
            entry.sound = false;
        }
        match self.entries.get(&name.text) {
            // What could not be read is an error already.
            Some(_) if name.text == "ground" && !entry.sound => {}
            Some(_) if name.text == "ground" => sink.report(
                Diagnostic::new(name.place(), "`ground` is the fixed link, and no name for another item")
                    .help("its points are declared by `ground { A0: (0, 0) }`"),
            ),
            Some(first) if first.sound && entry.sound => {
                sink.report(taken(name, *first));
                self.refused.push((name.text.clone(), entry.role));
            }
            Some(_) => {}
            None => {
                self.entries.insert(name.text.clone(), entry);
            }
        }
    }

    /// The place of a name in the list of its role; `None` if its item could not be read.
    pub(super) fn find(&self, role: Role, name: &Name) -> Result<Option<usize>, Diagnostic> {
        match self.entries.get(&name.text) {
            Some(entry) if entry.role == Role::Broken || entry.role == role && !entry.sound => Ok(None),
            Some(entry) if entry.role == role => Ok(Some(entry.index)),
            _ if self.may_mean(&[role], &name.text) => Ok(None),
            Some(entry) => Err(entry.instead_of(role, name).suggest(&name.text, self.of(role))),
            None => {
                let found = Diagnostic::new(name.place(), format!("there is no {} `{name}`", role.noun()));
                let found = found.suggest(&name.text, self.of(role));
                // One that is like no other one is not misspelt, but missing.
                Err(if closest(&name.text, self.of(role)).is_none() { found.once() } else { found })
            }
        }
    }

    /// Whether a name may be that of an item of one of these roles which is refused: for its name, which was taken, or as it could not be read.
    pub(super) fn may_mean(&self, roles: &[Role], name: &str) -> bool {
        match self.entries.get(name) {
            Some(_) => self.refused.iter().any(|(refused, of)| refused == name && roles.contains(of)),
            None => roles.iter().any(|role| self.may_be(*role)),
        }
    }

    /// What a name stands for.
    pub(super) fn entry(&self, name: &str) -> Option<Entry> {
        self.entries.get(name).copied()
    }

    /// Whether an unknown name may be that of an item of this role whose name could not be read.
    pub(super) fn may_be(&self, role: Role) -> bool {
        self.nameless.contains(&role) || self.nameless.contains(&Role::Broken)
    }

    /// From now on nothing but the name of this item is sure: what refers to it is not held against it.
    pub(super) fn distrust(&mut self, name: &Name) {
        if let Some(entry) = self.entries.get_mut(&name.text) {
            entry.sound = false;
        }
    }

    /// The item of this role that was probably meant by a name.
    pub(super) fn near(&self, role: Role, name: &str) -> Option<usize> {
        closest(name, self.of(role)).and_then(|near| self.entry(near)).map(|entry| entry.index)
    }

    /// All names of a role.
    pub(super) fn of(&self, role: Role) -> impl Iterator<Item = &str> {
        self.entries.iter().filter(move |(_, entry)| entry.role == role).map(|(name, _)| name.as_str())
    }
}
