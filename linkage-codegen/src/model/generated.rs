//! Names of what the generated module holds: types, functions, and what a pose can be asked.

use std::collections::BTreeMap;

use super::scenes::{ERROR_BOUND, type_name};
use super::values::{self, OWN_CONSTANTS, OWN_PATTERNS};
use super::{By, Inverse, Method, Model, Scene, Sweep, Wanted};
use crate::diagnostics::{Diagnostic, Sink};
use crate::model::ids::LoadId;
use crate::syntax::ast::{Ast, Item, Name};

/// Types of the generated module and names that it takes from elsewhere.
const OWN_TYPES: [&str; 15] = [
    "Pose",
    "Motion",
    "Loads",
    "Params",
    "Linkage",
    "Limits",
    "Error",
    "Result",
    "Vector2",
    "ResolvedForce",
    "SliderReaction",
    "WeldReaction",
    "SlotReaction",
    "GearReaction",
    "WorkTerm",
];
/// The same, where there are parameters, where there is something to verify, where there are resultants, where there are equations of motion
/// of several drives, and where closures are chosen at run time.
const FURTHER_TYPES: [&str; 8] =
    ["Default", "Verification", "Wrench", "SMatrix", "SVector", "Closures", "Side", "Along"];

/// What is called by a name.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sort {
    Method,
    Function,
    Constant,
}

impl Sort {
    fn word(self) -> &'static str {
        match self {
            Self::Method => "method",
            Self::Function => "function",
            Self::Constant => "constant",
        }
    }
}

/// The names that are taken so far, each with what has it.
struct Taken<'s> {
    /// Methods of a pose and functions.
    calls: BTreeMap<String, (Sort, String)>,
    types: BTreeMap<String, String>,
    sink: &'s Sink,
}

impl Taken<'_> {
    /// Takes a name for a method or a function; `false` if it is taken, which is reported at `name`.
    fn call(&mut self, name: &Name, sort: Sort, made: String, whose: &str) -> bool {
        let rusts_own = || match sort {
            Sort::Function if OWN_PATTERNS.contains(&&*made) => Some((sort, "is Rust's own".to_owned())),
            Sort::Function if OWN_CONSTANTS.contains(&&*made) => {
                Some((Sort::Constant, "belongs to the module".to_owned()))
            }
            _ => None,
        };
        let Some((other, owner)) = self.calls.get(&made).cloned().or_else(rusts_own) else {
            self.calls.insert(made, (sort, whose.to_owned()));
            return true;
        };
        let problem = match (sort, other) {
            (Sort::Method, Sort::Method) => format!("a pose would have two methods `{made}`: the other one {owner}"),
            (Sort::Function, Sort::Function) => {
                format!("there would be two functions `{made}`: the other one {owner}")
            }
            _ => {
                let [own, other] = [sort, other].map(Sort::word);
                format!("there would be a {own} `{made}` and a {other} `{made}`: the {other} {owner}")
            }
        };
        self.refuse(name, problem)
    }

    /// Takes a name for a type; `false` if it is taken, which is reported at `name` as what would have it.
    fn ty(&mut self, name: &Name, made: &str, would: &str, whose: String) -> bool {
        match self.types.get(made).cloned() {
            Some(other) => self.refuse(name, format!("{would} the type `{made}`, and {other}")),
            None => self.types.insert(made.to_owned(), whose).is_none(),
        }
    }

    fn refuse(&self, name: &Name, problem: String) -> bool {
        self.sink.report(Diagnostic::new(name.place(), problem).help("choose another name"));
        false
    }
}

/// No two things of the generated module may have one name. Of two that would, the one that is declared behind the other is refused.
pub(super) fn check(model: &Model, ast: &Ast, sink: &Sink) {
    values::check(model, sink);
    let own = model.own_types().map(|name| (name.to_owned(), "the module has that already".to_owned()));
    let mut taken = Taken { calls: BTreeMap::new(), types: own.collect(), sink };
    poses(model, &mut taken);
    for load in model.loads.iter().filter(|load| load.kind.is_spring() && load.kind.is_given_at_run_time(model)) {
        let would = format!("what is given of `{}` would be", load.name);
        taken.ty(&load.name, &load.type_name(), &would, format!("the load `{}` has that", load.name));
    }
    for item in &ast.items {
        let Item::Scene(given) = item else { continue };
        if let Some(bringer) = Bringer::of(model, &given.name) {
            bringer.claim(model, &given.name, &mut taken);
        }
    }
}

/// What a pose can be asked whatever the scenes are.
fn poses(model: &Model, taken: &mut Taken<'_>) {
    taken.calls.insert("at".into(), (Sort::Method, "makes a pose".into()));
    if !model.starts.is_empty() {
        taken.calls.insert("moved_to".into(), (Sort::Method, "makes a pose from another one".into()));
    }
    for drive in &model.drives {
        taken.call(&drive.name, Sort::Method, drive.name.text.clone(), &format!("gives the drive `{}`", drive.name));
    }
    for joint in &model.joints {
        for made in joint.asked_names().into_iter().chain([joint.name.text.clone()]) {
            taken.call(&joint.name, Sort::Method, made, &format!("belongs to the joint `{}`", joint.name));
        }
    }
    for link in &model.links {
        let points = link.points.iter().map(|p| (p.name.text.as_str(), &p.name));
        for (point, name) in points.chain([("direction", &link.name)]) {
            let made = format!("{}_{point}", link.name);
            taken.call(name, Sort::Method, made, &format!("gives `{}.{point}`", link.name));
        }
    }
}

/// What is declared as a scene, and brings names into the module.
enum Bringer<'m> {
    Scene(&'m Scene),
    Inverse(&'m Inverse),
    Sweep(Sweep),
}

impl<'m> Bringer<'m> {
    fn of(model: &'m Model, name: &Name) -> Option<Self> {
        let scene = model.scenes.iter().find(|scene| scene.name.text == name.text).map(Self::Scene);
        let inverse = || model.inverses.iter().find(|inverse| inverse.name.text == name.text).map(Self::Inverse);
        let sweep = || {
            let mut all = model.sweeps.iter().cloned().chain(model.inverses.iter().flat_map(Inverse::sweeps));
            all.find(|sweep| sweep.name.text == name.text).map(Self::Sweep)
        };
        scene.or_else(inverse).or_else(sweep)
    }

    /// Takes its names, up to the first that is taken already: one mistake is one error.
    fn claim(&self, model: &Model, name: &Name, taken: &mut Taken<'_>) {
        let what = if let Self::Sweep(_) = self { "sweep" } else { "scene" };
        let whose = format!("belongs to the {what} `{name}`");
        let calls = match self {
            Self::Scene(_) => vec![(Sort::Method, name.text.clone()), (Sort::Function, format!("{name}_at"))],
            Self::Inverse(_) => vec![(Sort::Function, format!("{name}_at"))],
            Self::Sweep(_) => vec![(Sort::Function, name.text.clone())],
        };
        let own =
            |made: String| (made, format!("the {what} `{name}` would have"), format!("the {what} `{name}` has that"));
        let types: Vec<_> = match self {
            Self::Scene(scene) => model.types_of(scene).into_iter().map(|(made, of)| claimed(name, made, of)).collect(),
            Self::Inverse(inverse) => inverse.types().map(own).into(),
            Self::Sweep(sweep) => sweep.types().map(own).into(),
        };
        let _ = calls.into_iter().all(|(sort, made)| taken.call(name, sort, made, &whose))
            && types.into_iter().all(|(made, would, whose)| taken.ty(name, &made, &would, whose));
    }
}

/// A type that a scene brings for something among its results, or for all: its name, what would be it, and what has it.
fn claimed(scene: &Name, made: String, of: Option<String>) -> (String, String, String) {
    match of {
        None => (made, format!("the results of `{scene}` would be"), format!("the scene `{scene}` has that")),
        Some(of) => (
            made,
            format!("`{of}` among the results of `{scene}` would be"),
            format!("`{of}` in the scene `{scene}` has that"),
        ),
    }
}

impl Model {
    /// The types that the module has whatever its scenes are called.
    pub(crate) fn own_types(&self) -> impl Iterator<Item = &'static str> {
        let verifies = self.scenes.iter().any(|scene| scene.method == Method::Verify);
        let (wrenches, matrices) = (self.has_wrenches(), self.has_matrices());
        let chooses = self.given_closures().next().is_some();
        let further = [!self.params.is_empty(), verifies, wrenches, matrices, matrices, chooses, chooses, chooses];
        let further = FURTHER_TYPES.into_iter().zip(further).filter(|(_, there)| *there).map(|(name, _)| name);
        OWN_TYPES.into_iter().chain(further)
    }

    /// The types that a scene brings, each with what of its results has it; the first is that of all.
    pub(crate) fn types_of(&self, scene: &Scene) -> Vec<(String, Option<String>)> {
        types_named(self, scene, &type_name(&scene.name.text), None)
    }
}

fn types_named(model: &Model, scene: &Scene, base: &str, path: Option<&str>) -> Vec<(String, Option<String>)> {
    let own = (base.to_owned(), path.map(str::to_owned));
    let within = |name: &str| path.map_or_else(|| name.to_owned(), |path| format!("{path}.{name}"));
    if let Some(derivative) = &scene.derivative {
        // A record for each variable, and in it for each number of a load, of the results of the other scene.
        let records = derivative.by.iter().flat_map(|variable| {
            let (name, of) = (variable.name(model), &model.scenes[derivative.of]);
            let base = format!("{base}{}", type_name(&name));
            let numbers: Vec<&str> = match variable.by {
                By::Load(load) => model.load(load).kind.given(model).filter(|value| !value.is_empty()).collect(),
                _ => Vec::new(),
            };
            if numbers.is_empty() {
                return types_named(model, of, &base, Some(&name));
            }
            let inner = numbers.iter().flat_map(|number| {
                let path = format!("{name}.{number}");
                types_named(model, of, &format!("{base}{}", type_name(number)), Some(&path))
            });
            let inner: Vec<_> = inner.collect();
            [vec![(base, Some(name))], inner].concat()
        });
        return core::iter::once(own).chain(records).collect();
    }
    let per_link = |load: &LoadId| model.load(*load).kind.is_per_link();
    let records = scene.loads.iter().filter(|load| match scene.method {
        Method::VirtualWork => per_link(load) || model.unknowns.len() > 1,
        Method::Superposition => per_link(load),
        _ => false,
    });
    let records = records.map(|load| model.load(*load).name.text.clone());
    let resolved = scene.results.iter().filter_map(|wanted| match wanted {
        Wanted::Joint(_) | Wanted::Point(_) | Wanted::Angle(_) if scene.method == Method::Coefficients => {
            model.result_name(*wanted)
        }
        Wanted::Advantage(_) if model.unknowns.len() > 1 => model.result_name(*wanted),
        Wanted::Resolved(..) | Wanted::Inertia(_) | Wanted::Offset(_) => model.result_name(*wanted),
        _ => None,
    });
    let parts = (scene.method == Method::Superposition).then(|| "contribution".to_owned());
    let bounds = scene.results.contains(&Wanted::ErrorBound).then(|| ERROR_BOUND.to_owned());
    let named = parts.into_iter().chain(bounds).chain(records).chain(resolved);
    let records = named.map(|name| (format!("{base}{}", type_name(&name)), Some(within(&name))));
    core::iter::once(own).chain(records).collect()
}
