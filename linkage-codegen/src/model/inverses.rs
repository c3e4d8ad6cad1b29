//! Inverse scenes: how the drives must move for a wanted motion of other coordinates.
//!
//! The wanted coordinates change places with the drives. What comes of it is a declaration of its own: the same links and joints, driven
//! where the motion is wanted, and asked for the coordinates that were the drives.

use super::ids::{ClosureId, DriveId, JointId};
use super::motion::Asked;
use super::names::{Names, Role};
use super::scenes::{ERROR_BOUND, cannot, end_of};
use super::{Method, Model, Scene, Sweep, Wanted, resolve, type_name};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::Order;
use crate::syntax::ast::{self, Ast, Item, Name, ResultItem};

/// A coordinate of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// The joint.
    pub joint: JointId,
    /// Whether it is an angle.
    pub turns: bool,
}

/// A scene that gives the drives for a wanted motion.
#[derive(Clone, Debug)]
pub struct Inverse {
    /// Its name.
    pub name: Name,
    /// The method's word.
    pub method: Name,
    /// The coordinates whose motion is wanted, each with its name as an argument: as many as there are drives.
    pub wanted: Vec<(Name, Coordinate)>,
    /// What is asked of the drives: their coordinates, rates and accelerations.
    pub results: Vec<(DriveId, Option<Order>)>,
    /// The names of its sweeps.
    pub swept: Vec<Name>,
}

impl Inverse {
    /// What of the wanted motion its results depend on: of accelerations, the rates too.
    #[must_use]
    pub fn orders(&self) -> Vec<Order> {
        let asks = |order| self.results.iter().any(|(_, asked)| *asked == Some(order));
        match (asks(Order::Rate), asks(Order::Acceleration)) {
            (_, true) => vec![Order::Rate, Order::Acceleration],
            (true, false) => vec![Order::Rate],
            (false, false) => Vec::new(),
        }
    }

    /// Its sweeps, as those of a linkage of which it is the only scene.
    pub fn sweeps(&self) -> impl Iterator<Item = Sweep> {
        self.swept.iter().map(|name| Sweep { name: name.clone(), scene: 0 })
    }

    /// What is prepared for it from parameters.
    #[must_use]
    pub fn prepared_name(&self) -> String {
        format!("inverse_{}", self.name)
    }

    /// Its types: of the results, of the wanted rates and accelerations, and of what is prepared for it from parameters.
    #[must_use]
    pub fn types(&self) -> [String; 3] {
        let results = type_name(&self.name.text);
        [results.clone(), format!("{results}Motion"), format!("{results}Linkage")]
    }
}

/// Of a linkage whose wanted coordinates and drives have changed places: what the drives were, by their names.
#[derive(Clone, Debug)]
pub struct Exchanged {
    /// The drives of the declaration.
    pub drives: Vec<(String, Coordinate)>,
    /// The closures of the groups that the declaration's drives move.
    pub closures: Vec<Side>,
    /// Those of this linkage's own groups. A closure may be one of both and mean another side in each.
    pub own: Vec<Side>,
}

/// What a closure says, in whatever way the linkage is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// The closure, which is the same in both.
    pub closure: ClosureId,
    /// Along a slide: which one, and what lies ahead of the other joint or behind it.
    pub along: Option<[JointId; 2]>,
}

pub(super) fn is_inverse(given: &ast::Scene) -> bool {
    given.method.text == "inverse"
}

/// Reads the inverse scenes, once drives and joints are known.
pub(super) fn inverses(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Scene(given) = item else { continue };
        if !is_inverse(given) {
            continue;
        }
        let wanted = wanted(model, given, names, sink);
        let results = results(model, given, names, sink);
        let (name, method) = (given.name.clone(), given.method.clone());
        model.inverses.push(Inverse { name, method, wanted, results, swept: Vec::new() });
    }
}

fn wanted(model: &Model, given: &ast::Scene, names: &Names, sink: &Sink) -> Vec<(Name, Coordinate)> {
    let mut wanted: Vec<(Name, Coordinate)> = Vec::new();
    for ast::End { link: joint, point } in &given.wanted {
        let Some(id) = sink.absorb(names.find(Role::Joint, joint)).flatten().map(JointId::new) else { continue };
        let written = |coordinate: &str| format!("inverse({coordinate})");
        let asked = Asked { joint, coordinate: point.as_ref(), verb: "name", written: &written };
        let Some(target) = model.joints.get(id.index()) else { continue };
        let (turns, error) = asked.of(target);
        error.into_iter().for_each(|error| sink.report(error));
        let coordinate = Coordinate { joint: id, turns };
        let name = Name { text: format!("{joint}_{}", if turns { "angle" } else { "travel" }), span: joint.span };
        if wanted.iter().any(|(_, other)| *other == coordinate) {
            sink.report(
                Diagnostic::new(joint.place(), format!("the motion of `{joint}` is wanted twice"))
                    .help("leave one of them out"),
            );
        } else {
            wanted.push((name, coordinate));
        }
    }
    let (found, needed) = (given.wanted.len(), model.drives.len());
    if found != needed && needed > 0 && !names.may_be(Role::Drive) {
        let (s, are) = if needed == 1 { ("", "is") } else { ("s", "are") };
        let problem =
            format!("{needed} coordinate{s} {are} needed to place the linkage, one for each drive, not {found}");
        sink.report(
            Diagnostic::new(given.method.place(), problem)
                .help("name the joints whose motion is wanted, as in `inverse(B0)`; a driven joint may be among them"),
        );
    }
    wanted
}

/// What is asked of the drives; everything, if nothing is said.
fn results(model: &Model, given: &ast::Scene, names: &Names, sink: &Sink) -> Vec<(DriveId, Option<Order>)> {
    let orders = [None, Some(Order::Rate), Some(Order::Acceleration)];
    let drives = || (0..model.drives.len()).map(DriveId::new);
    let Some(listed) = &given.results else {
        return drives().flat_map(|drive| orders.map(|order| (drive, order))).collect();
    };
    let mut results = Vec::new();
    for item in listed {
        let found = match item {
            ResultItem::Name(name) if name.text == ERROR_BOUND && names.entry(ERROR_BOUND).is_none() => {
                sink.report(
                    cannot(given, name.place(), ERROR_BOUND, "the bound of the errors")
                        .help("`equilibrium`, `virtual_work` and `motion` give it, and `position`, `velocity`, `acceleration` and `coefficients`"),
                );
                continue;
            }
            ResultItem::Name(name) => Some((name, None)),
            ResultItem::Point(name, what) => match what.text.as_str() {
                "rate" => Some((name, Some(Order::Rate))),
                "acceleration" => Some((name, Some(Order::Acceleration))),
                other => {
                    sink.report(
                        Diagnostic::new(what.place(), format!("a drive has no `{other}`"))
                            .suggest(other, ["rate", "acceleration"]),
                    );
                    continue;
                }
            },
            _ => None,
        };
        let Some((name, order)) = found else {
            let place = end_of(item).place();
            sink.report(
                Diagnostic::new(place, "`inverse` gives the motion of the drives")
                    .help("its results are such as `theta`, `theta.rate` and `theta.acceleration`"),
            );
            continue;
        };
        let Some(drive) = sink.absorb(names.find(Role::Drive, name)).flatten() else { continue };
        let wanted = (DriveId::new(drive), order);
        if results.contains(&wanted) {
            sink.report(Diagnostic::new(name.place(), "this result is listed twice").help("leave one of them out"));
        } else {
            results.push(wanted);
        }
    }
    if listed.is_empty() {
        sink.report(
            Diagnostic::new(given.method.place(), "a scene without results has nothing to compute")
                .help("list its results, or leave the list out to have them all"),
        );
    }
    results
}

impl Model {
    /// The field of a drive's coordinate, its rate or its acceleration among the results of an inverse scene.
    #[must_use]
    pub fn driver_name(drive: &str, order: Option<Order>) -> String {
        match order {
            None => drive.to_owned(),
            Some(Order::Rate) => format!("{drive}_rate"),
            Some(Order::Acceleration) => format!("{drive}_acceleration"),
        }
    }

    /// The linkage with the wanted coordinates of an inverse scene for drives, and one scene: the motion of what were the drives. `closures`
    /// are those of its groups.
    #[must_use]
    pub fn exchanged(&self, ast: &Ast, inverse: &Inverse, closures: Vec<Side>, sink: &Sink) -> Self {
        let kept = |item: &&Item| {
            matches!(
                item,
                Item::Units(_)
                    | Item::Scalar(_)
                    | Item::Arithmetic(_)
                    | Item::Crate(_)
                    | Item::Param(_)
                    | Item::Link(_)
                    | Item::Joint(_)
                    | Item::Assemble(_)
            )
        };
        let drives = inverse.wanted.iter().map(|(name, coordinate)| {
            let joint = self.joint(coordinate.joint);
            let word = if coordinate.turns { "angle" } else { "travel" };
            let said = matches!(joint.kind, super::JointKind::Slot { .. });
            let coordinate = said.then(|| Name { text: word.to_owned(), span: name.span });
            let joint = Name { text: joint.name.text.clone(), span: name.span };
            Item::Drive(ast::Drive { name: name.clone(), joint, coordinate, motion: ast::DriveMotion::default() })
        });
        let items = ast.items.iter().filter(kept).cloned().chain(drives).collect();
        let mut model = resolve(&Ast { items, ..ast.clone() }, sink);
        let drives = self
            .drives
            .iter()
            .map(|drive| (drive.name.text.clone(), Coordinate { joint: drive.joint, turns: drive.turns }));
        model.exchanged = Some(Exchanged { drives: drives.collect(), closures, own: Vec::new() });
        let results = inverse.results.iter().map(|(drive, order)| Wanted::Driver(*drive, *order)).collect();
        model.scenes.push(Scene {
            name: inverse.name.clone(),
            method: Method::Inverse,
            loads: Vec::new(),
            results,
            derivative: None,
            refused: Vec::new(),
        });
        model.sweeps.extend(inverse.sweeps());
        model
    }
}
