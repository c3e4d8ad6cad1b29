//! Scenes, and the names that they bring into the generated module.

use std::collections::BTreeMap;

use super::ids::{JointId, LinkId, LoadId, PointId, UnknownId};
use super::names::{Names, Role};
use super::{End, LoadKind, Method, Model, Scene, Wanted};
use crate::diagnostics::{Diagnostic, Sink};
use crate::syntax::ast::{self, Ast, Item, Name, ResultItem};
use crate::syntax::{METHODS, PLANNED_METHODS};

/// Scenes with their loads and results.
pub(super) fn scenes(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    let broken = ast.items.iter().any(|i| matches!(i, Item::Broken(_)));
    for item in &ast.items {
        let Item::Scene(given) = item else { continue };
        // A scene that is refused still brings its names.
        let method = sink.absorb(method(given)).unwrap_or(Method::Equilibrium);
        let scene = Scene {
            name: given.name.clone(),
            method,
            loads: loads(model, given, method, names, sink),
            results: results(model, given, method, names, sink),
        };
        if model.loads.is_empty() && method != Method::Position && !broken {
            sink.report(
                Diagnostic::new(given.method.place(), "there is no load to balance")
                    .help("declare one: `load F: force(coupler.C);`"),
            );
        }
        model.scenes.push(scene);
    }
    for item in &ast.items {
        let Item::Broken(Some(broken)) = item else { continue };
        if broken.keyword.text == "scene" {
            let given =
                ast::Scene { name: broken.name.clone(), method: broken.name.clone(), loads: None, results: None };
            let results = all_results(model, &given, Method::Equilibrium, names);
            let loads = (0..model.loads.len()).map(LoadId::new).collect();
            model.scenes.push(Scene { name: given.name, method: Method::Equilibrium, loads, results });
        }
    }
    if sink.is_clean() {
        check_generated_names(model, sink);
    }
}

fn method(given: &ast::Scene) -> Result<Method, Diagnostic> {
    match given.method.text.as_str() {
        "position" => Ok(Method::Position),
        "equilibrium" => Ok(Method::Equilibrium),
        "superposition" => Ok(Method::Superposition),
        "virtual_work" => Ok(Method::VirtualWork),
        "verify" if cfg!(feature = "reference") => Ok(Method::Verify),
        "verify" => {
            Err(Diagnostic::new(given.method.place(), "a scene can be verified only with the feature `reference`")
                .help("in Cargo.toml: linkage-runtime = { …, features = [\"reference\"] }"))
        }
        word if PLANNED_METHODS.contains(&word) => {
            Err(Diagnostic::new(given.method.place(), format!("the method `{word}` is not supported yet")))
        }
        word => {
            Err(Diagnostic::new(given.method.place(), format!("there is no method `{word}`")).suggest(word, METHODS))
        }
    }
}

fn loads(model: &Model, given: &ast::Scene, method: Method, names: &Names, sink: &Sink) -> Vec<LoadId> {
    let Some(listed) = &given.loads else {
        let all = if method == Method::Position { 0 } else { model.loads.len() };
        return (0..all).map(LoadId::new).collect();
    };
    if method == Method::Position {
        sink.report(
            Diagnostic::new(given.method.place(), "positions do not depend on loads")
                .help("leave the list of loads out"),
        );
        return Vec::new();
    }
    let mut loads = Vec::new();
    for name in listed {
        let Some(Some(load)) = sink.absorb(names.find(Role::Load, name)) else { continue };
        let load = LoadId::new(load);
        if loads.contains(&load) {
            sink.report(Diagnostic::new(name.place(), format!("the load `{name}` is listed twice")));
        } else {
            loads.push(load);
        }
    }
    if listed.is_empty() {
        sink.report(
            Diagnostic::new(given.method.place(), "a scene without loads has nothing to balance")
                .help("list its loads, or leave the parentheses out to have them all"),
        );
    }
    loads
}

fn results(model: &Model, given: &ast::Scene, method: Method, names: &Names, sink: &Sink) -> Vec<Wanted> {
    let Some(listed) = &given.results else { return all_results(model, given, method, names) };
    if method == Method::Verify {
        let place = given.method.place();
        sink.report(Diagnostic::new(place, "`verify` compares all results").help("leave the list of results out"));
        return Vec::new();
    }
    let mut results: Vec<Wanted> = Vec::new();
    for item in listed {
        let Some(Some(wanted)) = sink.absorb(result(model, given, method, item, names)) else { continue };
        if results.contains(&wanted) {
            let (ResultItem::Name(name) | ResultItem::Point(name, _)) = item else { continue };
            sink.report(Diagnostic::new(name.place(), "this result is listed twice"));
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

/// All that a method gives.
fn all_results(model: &Model, given: &ast::Scene, method: Method, names: &Names) -> Vec<Wanted> {
    let joints = (0..model.joints.len()).map(|j| Wanted::Joint(JointId::new(j)));
    let unknowns = (0..model.unknowns.len()).map(|u| Wanted::Unknown(UnknownId::new(u)));
    match method {
        Method::Position => {
            let jointed = |end: End| model.joints.iter().any(|j| j.ends().contains(&end));
            let points = model
                .moving_links()
                .flat_map(|link| (0..model.link(link).points.len()).map(move |p| End { link, point: PointId::new(p) }));
            let points = points.filter(|end| !jointed(*end)).map(Wanted::Point);
            joints.chain(points).chain(model.moving_links().map(Wanted::Angle)).collect()
        }
        Method::Equilibrium | Method::Superposition => unknowns.chain(joints).collect(),
        Method::VirtualWork => {
            let terms = loads(model, given, method, names, &Sink::default()).into_iter().map(Wanted::Load);
            unknowns.chain(terms).collect()
        }
        Method::Verify => Vec::new(),
    }
}

fn result(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    item: &ResultItem,
    names: &Names,
) -> Result<Option<Wanted>, Diagnostic> {
    match item {
        ResultItem::Planned(place, what) => Err(Diagnostic::new(*place, format!("{what} is not supported yet"))),
        ResultItem::Point(link, point) => {
            let Some(id) = names.find(Role::Link, link)?.map(LinkId::new) else { return Ok(None) };
            if method != Method::Position {
                return Err(cannot(given, link, "where a point is"));
            }
            if point.text == "angle" {
                return Ok(Some(Wanted::Angle(id)));
            }
            let Some(body) = model.links.get(id.index()) else { return Ok(None) };
            match body.points.iter().position(|p| p.name.text == point.text) {
                Some(index) => Ok(Some(Wanted::Point(End { link: id, point: PointId::new(index) }))),
                None => {
                    let known = body.points.iter().map(|p| p.name.text.as_str()).chain(["angle"]);
                    let problem = format!("the link `{link}` has no point `{point}`");
                    Err(Diagnostic::new(point.place(), problem).suggest(&point.text, known))
                }
            }
        }
        ResultItem::Name(name) => named_result(model, given, method, name, names),
    }
}

fn named_result(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    name: &Name,
    names: &Names,
) -> Result<Option<Wanted>, Diagnostic> {
    if let Some(index) = model.unknowns.iter().position(|u| u.name == name.text) {
        return match method {
            Method::Position => Err(cannot(given, name, "an effort")),
            _ => Ok(Some(Wanted::Unknown(UnknownId::new(index)))),
        };
    }
    match names.role(&name.text) {
        Some((Role::Broken, _)) => Ok(None),
        Some((Role::Joint, index)) => match method {
            Method::VirtualWork => Err(cannot(given, name, "the reaction of a joint").note(
                "a joint's reaction does no work in the motion that the joints allow, so it never enters; \
                 `equilibrium` gives it",
            )),
            _ => Ok(Some(Wanted::Joint(JointId::new(index)))),
        },
        Some((Role::Load, index)) => {
            let load = LoadId::new(index);
            if method != Method::VirtualWork {
                return Err(cannot(given, name, "the term of a load").note("`virtual_work` gives it"));
            }
            let listed = given.loads.as_ref().is_none_or(|l| l.iter().any(|n| n.text == name.text));
            if !listed {
                let problem = format!("the load `{name}` is not in this scene");
                return Err(Diagnostic::new(name.place(), problem).help("add it to the list of loads"));
            }
            Ok(Some(Wanted::Load(load)))
        }
        Some((Role::Link, _)) if method == Method::Position => {
            Err(Diagnostic::new(name.place(), format!("of the link `{name}`, its angle or a point?"))
                .help(format!("`{name}.angle`, or `{name}.P` with a point of it")))
        }
        _ => {
            let known: Vec<&str> = match method {
                Method::Position => names.of(Role::Joint).collect(),
                Method::VirtualWork => {
                    model.unknowns.iter().map(|u| u.name.as_str()).chain(names.of(Role::Load)).collect()
                }
                _ => model.unknowns.iter().map(|u| u.name.as_str()).chain(names.of(Role::Joint)).collect(),
            };
            let problem = format!("there is no result `{name}`");
            Err(Diagnostic::new(name.place(), problem).suggest(&name.text, known))
        }
    }
}

fn cannot(given: &ast::Scene, name: &Name, what: &str) -> Diagnostic {
    Diagnostic::new(name.place(), format!("`{}` cannot give `{name}`: {what} is not among its results", given.method))
}

/// A type's name for a scene: `bearing_load` becomes `BearingLoad`.
#[must_use]
pub fn type_name(name: &str) -> String {
    name.split('_')
        .map(|part| {
            let mut letters = part.chars();
            letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
        })
        .collect()
}

/// No two things of the generated module may have one name.
fn check_generated_names(model: &Model, sink: &Sink) {
    let mut types: BTreeMap<String, String> = ["Pose", "Loads", "Params", "Linkage", "Error"]
        .into_iter()
        .map(|n| (n.to_owned(), "the module's own".to_owned()))
        .collect();
    let mut methods: BTreeMap<String, String> = BTreeMap::new();
    methods.insert("at".into(), "the pose's own".into());
    let clash = |name: &Name, made: &str, other: &str| {
        sink.report(
            Diagnostic::new(
                name.place(),
                format!("`{name}` brings the name `{made}` into the module, where it is {other} already"),
            )
            .help("choose another name"),
        );
    };
    for drive in &model.drives {
        methods.insert(drive.name.text.clone(), format!("the drive `{}`", drive.name));
    }
    for joint in &model.joints {
        for made in [joint.name.text.clone(), format!("sin_mu_{}", joint.name)] {
            if let Some(other) = methods.insert(made.clone(), format!("of the joint `{}`", joint.name)) {
                clash(&joint.name, &made, &other);
            }
        }
    }
    for link in &model.links {
        let points = link.points.iter().map(|p| p.name.text.as_str()).chain(["direction"]);
        for made in points.map(|p| format!("{}_{p}", link.name)) {
            if let Some(other) = methods.insert(made.clone(), format!("of the link `{}`", link.name)) {
                clash(&link.name, &made, &other);
            }
        }
    }
    for scene in &model.scenes {
        let own = format!("of the scene `{}`", scene.name);
        for made in [scene.name.text.clone(), format!("{}_at", scene.name)] {
            if let Some(other) = methods.insert(made.clone(), own.clone()) {
                clash(&scene.name, &made, &other);
            }
        }
        let base = type_name(&scene.name.text);
        let gravity = scene.loads.iter().filter(|l| matches!(model.load(**l).kind, LoadKind::Gravity { .. }));
        let per_link = gravity.map(|l| format!("{base}{}", type_name(&model.load(*l).name.text)));
        for made in [base.clone(), format!("{base}Contribution")].into_iter().chain(per_link) {
            if let Some(other) = types.insert(made.clone(), own.clone()) {
                clash(&scene.name, &made, &other);
            }
        }
    }
}
