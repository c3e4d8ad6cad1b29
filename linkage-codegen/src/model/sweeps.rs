//! Sweeps: scenes that are solved at many positions.

use std::collections::{BTreeMap, BTreeSet};

use super::{Drive, LoadKind, Method, Model, Scene, type_name};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::Order;
use crate::model::ids::LoadId;
use crate::syntax::ast::{self, Ast, Item, Name};

/// A scene at many positions.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Its name.
    pub name: Name,
    /// The scene, by its place in the list of scenes.
    pub scene: usize,
}

impl Sweep {
    /// The types of its arguments: what is given at each position, and where its results go.
    #[must_use]
    pub fn types(&self) -> [String; 2] {
        let results = type_name(&self.name.text);
        [format!("{results}Inputs"), results]
    }
}

pub(super) fn is_sweep(given: &ast::Scene) -> bool {
    given.method.text == "sweep"
}

/// Reads the sweeps, once all scenes are known.
pub(super) fn sweeps(model: &mut Model, ast: &Ast, sink: &Sink) {
    for item in &ast.items {
        let Item::Scene(given) = item else { continue };
        if !is_sweep(given) {
            continue;
        }
        let name = given.name.clone();
        match scene_of(model, ast, given) {
            Ok(Some(Swept::Scene(scene))) => model.sweeps.push(Sweep { name, scene }),
            Ok(Some(Swept::Inverse(inverse))) => model.inverses[inverse].swept.push(name),
            Ok(None) => {}
            Err(error) => sink.report(error),
        }
    }
    check_inputs(model, sink);
}

/// What a sweep goes through, by its place in its list.
enum Swept {
    Scene(usize),
    Inverse(usize),
}

/// The scene of a sweep.
fn scene_of(model: &Model, ast: &Ast, given: &ast::Scene) -> Result<Option<Swept>, Diagnostic> {
    let named = given.loads.as_deref().unwrap_or_default();
    let [name] = named else {
        let place = named.get(1).map_or(given.method.place(), Name::place);
        return Err(Diagnostic::new(place, "a sweep goes through one scene")
            .help("name it in parentheses, as in `scene cycle: sweep(statics);`"));
    };
    if let Some(results) = &given.results {
        let place = given.method.place();
        let problem = "a sweep has the results of its scene";
        return Err(Diagnostic::new(place, problem).help(if results.is_empty() {
            "leave the list out"
        } else {
            "list them in that scene"
        }));
    }
    if let Some(inverse) = model.inverses.iter().position(|inverse| inverse.name.text == name.text) {
        return Ok(Some(Swept::Inverse(inverse)));
    }
    let scene = model.scenes.iter().position(|scene| scene.name.text == name.text);
    match scene.map(|index| (index, &model.scenes[index])) {
        Some((_, Scene { method: Method::Verify, .. })) => {
            Err(Diagnostic::new(name.place(), "a scene that verifies is solved at one position after the other")
                .help("sweep another scene, and verify single positions in a test"))
        }
        Some((index, _)) => Ok(Some(Swept::Scene(index))),
        None => {
            let swept =
                ast.items.iter().any(|item| matches!(item, Item::Scene(s) if is_sweep(s) && s.name.text == name.text));
            let problem =
                if swept { format!("`{name}` is a sweep itself") } else { format!("there is no scene `{name}`") };
            let inverses = model.inverses.iter().map(|inverse| inverse.name.text.as_str());
            let known = model.scenes.iter().map(|scene| scene.name.text.as_str()).chain(inverses);
            Err(Diagnostic::new(name.place(), problem).suggest(&name.text, known))
        }
    }
}

/// What is given at each position stands in one struct: drives, their motion, and loads. A load that is called like one of the others is
/// refused once, however many sweeps have both.
fn check_inputs(model: &Model, sink: &Sink) {
    let mut refused: BTreeSet<LoadId> = BTreeSet::new();
    for sweep in &model.sweeps {
        let scene = &model.scenes[sweep.scene];
        let motion = model.swept_motion(scene);
        let motion: BTreeMap<_, _> =
            motion.into_iter().map(|(drive, order)| (drive.motion_name(order), (drive, order))).collect();
        for load in model.swept_loads(scene) {
            let name = &model.load(load).name;
            let Some((drive, order)) = motion.get(&name.text).filter(|_| refused.insert(load)) else { continue };
            let what = match order {
                Order::Rate => "rate",
                Order::Acceleration => "acceleration",
            };
            let problem = format!(
                "the sweep `{}` would have two inputs `{name}`: the other one is the {what} of the drive `{}`",
                sweep.name, drive.name
            );
            sink.report(Diagnostic::new(name.place(), problem).help("choose another name"));
        }
    }
}

impl Model {
    /// Rates and accelerations of drives that a scene may depend on and that are given at run time.
    #[must_use]
    pub fn swept_motion(&self, scene: &Scene) -> Vec<(&Drive, Order)> {
        let read = |order: &Order| match order {
            Order::Rate => self.scene_moves(scene),
            Order::Acceleration => self.scene_accelerates(scene),
        };
        let of = |drive| Drive::given_motion(drive, &self.graph).filter(read).map(move |order| (drive, order));
        self.drives.iter().flat_map(of).collect()
    }

    /// The loads of a scene that are given at run time.
    #[must_use]
    pub fn swept_loads(&self, scene: &Scene) -> Vec<LoadId> {
        let given = |load: &LoadId| {
            let kind = self.loads.get(load.index()).map(|load| &load.kind);
            kind.is_some_and(|kind| !matches!(kind, LoadKind::Inertia) && kind.is_given_at_run_time(self))
        };
        scene.loads.iter().copied().filter(given).collect()
    }
}
