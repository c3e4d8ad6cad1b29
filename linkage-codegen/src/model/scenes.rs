//! Scenes, and the names that they bring into the generated module.

use super::evaluate::Scope;
use super::ids::{DriveId, GROUND, JointId, LinkId, LoadId, ParamId, PointId, UnknownId};
use super::joints::end;
use super::names::{Names, Role, unread};
use super::{Along, By, Derivative, End, LoadKind, Method, Model, Part, Scene, Spot, Variable, Wanted};
use super::{generated, inverses, sweeps};
use crate::diagnostics::{Diagnostic, Place, Sink, closest, list};
use crate::graph::Order;
use crate::syntax::METHODS;
use crate::syntax::ast::{self, Ast, Item, Name, ResultItem};

/// Scenes with their loads and results.
pub(super) fn scenes(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    let unloaded = model.loads.is_empty() && !names.may_be(Role::Load);
    let mut told = false;
    for item in &ast.items {
        if let Some((broken, name)) = unread(item, Role::Scene) {
            model.scenes.push(stand_in(model, broken, name));
        }
        let Item::Scene(given) = item else { continue };
        if sweeps::is_sweep(given) || inverses::is_inverse(given) {
            continue;
        }
        // A scene that is refused still brings its names.
        let method = sink.absorb(method(given)).unwrap_or_else(|| likely_method(&given.method.text));
        let loads = loads(model, given, method, names, sink);
        let (results, refused) = results(model, given, method, &loads, names, sink);
        if unloaded && method.needs_loads() && !told {
            told = true;
            sink.report(
                Diagnostic::new(given.name.place().to(given.method.place()), "there is no load to balance")
                    .help("declare one, as in `load F: force(coupler.C);`; only scenes of motion need none"),
            );
        }
        let scene = Scene { name: given.name.clone(), method, loads, results, derivative: None, refused };
        if method == Method::Motion && sink.is_clean() && model.moved_masses(&scene).is_empty() {
            sink.report(
                Diagnostic::new(given.method.place(), "no link has mass: nothing resists an acceleration")
                    .help("give one to a link, as in `mass coupler: 0.5kg at (0, 0);`"),
            );
        }
        model.scenes.push(scene);
    }
    inverses::inverses(model, ast, names, sink);
    derivatives(model, ast, names, sink);
    sweeps::sweeps(model, ast, sink);
    if sink.is_clean() {
        generated::check(model, ast, sink);
    }
}

/// Of what and by what the scenes of derivatives are, once all scenes are there. Their loads and results are those of the others.
fn derivatives(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Scene(ast::Scene { name, derivative: Some(given), .. }) = item else { continue };
        let found = sink.absorb(differentiated(model, given, names)).flatten();
        let (mut by, mut refused_by): (Vec<Variable>, _) = (Vec::new(), Vec::new());
        for end in &given.by {
            let Some(variable) = sink.absorb(variable(model, end, names)).flatten() else {
                refused_by.push(in_vain(model, end, names));
                continue;
            };
            if by.iter().any(|other| other.by == variable.by) {
                let problem = format!("`{}` is listed twice", end.written());
                sink.report(Diagnostic::new(end.place(), problem).help("leave one of them out"));
            } else {
                by.push(variable);
            }
        }
        if given.by.is_empty() {
            let problem = format!("the results of `{}` are differentiated by nothing", given.of);
            sink.report(
                Diagnostic::new(given.of.place(), problem)
                    .help("list drives, loads that are given at run time, or parameters"),
            );
        }
        let own = model.scenes.iter().position(|scene| scene.name.text == name.text);
        let (Some(own), Some(of)) = (own, found) else { continue };
        let (loads, mut results, refused) = {
            let Scene { loads, results, refused, .. } = &model.scenes[of];
            (loads.clone(), results.clone(), refused.clone())
        };
        // How uncertain the other results are is none that varies smoothly.
        results.retain(|wanted| !matches!(wanted, Wanted::ErrorBound | Wanted::Part(Part::Rounding)));
        let scene = &mut model.scenes[own];
        (scene.loads, scene.results, scene.refused) = (loads, results, refused);
        scene.derivative = Some(Derivative { of, by, refused: refused_by });
    }
}

/// The scene that is differentiated.
fn differentiated(model: &Model, given: &ast::Derivative, names: &Names) -> Result<Option<usize>, Diagnostic> {
    if names.find(Role::Scene, &given.of)?.is_none() {
        return Ok(None);
    }
    let (of, place) = (&given.of, given.of.place());
    if model.inverses.iter().any(|inverse| inverse.name.text == of.text) {
        let problem = format!("the derivative of the inverse scene `{of}` is not supported");
        return Err(Diagnostic::new(place, problem)
            .help("by a wanted coordinate it is the drive's `.rate` in that scene, at unit rate of the coordinate"));
    }
    let Some(found) = model.scenes.iter().position(|scene| scene.name.text == of.text) else {
        return Err(Diagnostic::new(place, format!("`{of}` is a sweep: it has no results of its own"))
            .help("differentiate the scene that it sweeps; a scene of derivatives can be swept itself"));
    };
    let what = match model.scenes[found].method {
        Method::Derivative => "a derivative of a derivative is not supported",
        Method::Verify => "how far methods disagree is nothing to differentiate",
        _ => return Ok(Some(found)),
    };
    Err(Diagnostic::new(place, what)
        .help("differentiate a scene of positions, velocities, accelerations, forces or the equation of motion"))
}

/// What results are differentiated by: `theta`, `theta.rate`, `F13`, `l2`.
fn variable(model: &Model, end: &ast::End, names: &Names) -> Result<Option<Variable>, Diagnostic> {
    let (name, place) = (&end.link, end.place());
    let found = |by| Ok(Some(Variable { by, place }));
    let known = names.entry(&name.text).map(|entry| (entry.role, entry.index, entry.sound));
    if let (Some((role, ..)), Some(part)) = (known, &end.point)
        && matches!(role, Role::Load | Role::Param)
    {
        let problem = format!("`{}` is no variable by itself", end.written());
        let whole = if role == Role::Load { ": there is a field for each of its numbers" } else { "" };
        return Err(Diagnostic::new(part.place(), problem).help(format!("write `{name}`{whole}")));
    }
    match known {
        Some((Role::Broken, ..) | (_, _, false)) => Ok(None),
        Some((Role::Drive, index, _)) => {
            let (id, Some(drive)) = (DriveId::new(index), model.drives.get(index)) else { return Ok(None) };
            let order = match end.point.as_ref().map(|part| part.text.as_str()) {
                None => return found(By::Drive(id)),
                Some("rate") => Order::Rate,
                Some("acceleration") => Order::Acceleration,
                Some(other) => {
                    let place = end.point.as_ref().map_or(place, Name::place);
                    let problem = format!("the drive `{name}` has no `{other}`");
                    return Err(Diagnostic::new(place, problem).suggest(other, ["rate", "acceleration"]));
                }
            };
            if drive.given_motion(&model.graph).any(|given| given == order) {
                return found(By::Driven(id, order));
            }
            Err(Diagnostic::new(place, format!("`{}` is declared, and does not vary", end.written()))
                .help(format!("leave its value out of the drive `{name}`: then it is given at run time")))
        }
        Some((Role::Load, index, _)) => {
            let (id, Some(load)) = (LoadId::new(index), model.loads.get(index)) else { return Ok(None) };
            if load.kind.is_given_at_run_time(model) {
                return found(By::Load(id));
            }
            Err(match load.kind {
                LoadKind::Inertia => {
                    Diagnostic::new(place, format!("nothing of the inertia `{name}` is given at run time"))
                        .help("differentiate by the acceleration of a drive, or by a mass that is a parameter")
                }
                _ => Diagnostic::new(place, format!("the load `{name}` is a constant, and does not vary"))
                    .help("leave its value out, or write `_` for a value of a spring: then it is given at run time"),
            })
        }
        Some((Role::Param, index, _)) => found(By::Parameter(ParamId::new(index))),
        _ if names.may_mean(&[Role::Drive, Role::Load, Role::Param], &name.text) => Ok(None),
        Some((role, ..)) => {
            let problem = format!("`{name}` is {}, and nothing that varies by itself", role.describe());
            Err(Diagnostic::new(name.place(), problem)
                .help("differentiate by a drive, a load that is given at run time, or a parameter"))
        }
        None => {
            let known = names.of(Role::Drive).chain(names.of(Role::Load)).chain(names.of(Role::Param));
            Err(Diagnostic::new(name.place(), format!("there is no drive, load or parameter `{name}`"))
                .suggest(&name.text, known))
        }
    }
}

/// What a refused variable would be called, and the numbers that it would have.
fn in_vain(model: &Model, end: &ast::End, names: &Names) -> (String, Vec<&'static str>) {
    let known = names.entry(&end.link.text).filter(|entry| entry.role == Role::Load).map(|entry| entry.index);
    let load = known.and_then(|index| model.loads.get(index));
    let numbers = load.map(|load| load.kind.values().into_iter().map(|(name, _)| name).filter(|name| !name.is_empty()));
    (end.written().replace('.', "_"), numbers.into_iter().flatten().collect())
}

/// The method that a refused one is most like.
fn likely_method(word: &str) -> Method {
    match word {
        "velocity" => Method::Velocity,
        "acceleration" => Method::Acceleration,
        "coefficients" => Method::Coefficients,
        "position" => Method::Position,
        "verify" => Method::Verify,
        "motion" => Method::Motion,
        "derivative" => Method::Derivative,
        _ => Method::Equilibrium,
    }
}

/// A scene that could not be read: its method if that is among its words, and all results, whatever gives them.
fn stand_in(model: &Model, broken: &ast::Broken, name: &Name) -> Scene {
    let words = broken.words();
    let method = words.first().map_or(Method::Equilibrium, |word| match word.text.as_str() {
        "superposition" => Method::Superposition,
        "virtual_work" => Method::VirtualWork,
        other => likely_method(other),
    });
    let all = if method.has_loads() { model.loads.len() } else { 0 };
    let named: Vec<LoadId> = (0..all)
        .map(LoadId::new)
        .filter(|load| words.iter().any(|word| word.text == model.load(*load).name.text))
        .collect();
    let loads = if named.is_empty() { (0..all).map(LoadId::new).collect() } else { named };
    let results = all_results(model, method, &loads);
    Scene { name: name.clone(), method, loads, results, derivative: None, refused: Vec::new() }
}

fn method(given: &ast::Scene) -> Result<Method, Diagnostic> {
    match given.method.text.as_str() {
        "position" => Ok(Method::Position),
        "velocity" => Ok(Method::Velocity),
        "acceleration" => Ok(Method::Acceleration),
        "coefficients" => Ok(Method::Coefficients),
        "equilibrium" => Ok(Method::Equilibrium),
        "superposition" => Ok(Method::Superposition),
        "virtual_work" => Ok(Method::VirtualWork),
        "motion" => Ok(Method::Motion),
        "derivative" => Ok(Method::Derivative),
        "verify" if cfg!(feature = "reference") => Ok(Method::Verify),
        "verify" => {
            Err(Diagnostic::new(given.method.place(), "a scene can be verified only with the feature `reference`")
                .help("in Cargo.toml: linkage-runtime = { …, features = [\"reference\"] }"))
        }
        word => {
            Err(Diagnostic::new(given.method.place(), format!("there is no method `{word}`")).suggest(word, METHODS))
        }
    }
}

fn loads(model: &Model, given: &ast::Scene, method: Method, names: &Names, sink: &Sink) -> Vec<LoadId> {
    let Some(listed) = &given.loads else {
        let all = if method.has_loads() { model.loads.len() } else { 0 };
        return (0..all).map(LoadId::new).collect();
    };
    if !method.has_loads() {
        let what = match method {
            Method::Velocity => "velocities do",
            Method::Acceleration => "accelerations do",
            Method::Coefficients => "kinematic coefficients do",
            _ => "positions do",
        };
        sink.report(
            Diagnostic::new(given.method.place(), format!("{what} not depend on loads"))
                .help("leave the list of loads out"),
        );
        return Vec::new();
    }
    let mut loads = Vec::new();
    for name in listed {
        let found = sink.absorb(names.find(Role::Load, name));
        // One that is refused is given at run time or not, as the one that was probably meant.
        let known = names.entry(&name.text).filter(|entry| entry.role == Role::Load).map(|entry| entry.index);
        let Some(load) = found.flatten().or(known).or_else(|| names.near(Role::Load, &name.text)) else { continue };
        let load = LoadId::new(load);
        if !loads.contains(&load) {
            loads.push(load);
        } else if found.is_some() {
            sink.report(
                Diagnostic::new(name.place(), format!("the load `{name}` is listed twice"))
                    .help("leave one of them out"),
            );
        }
    }
    if listed.is_empty() && method.needs_loads() {
        sink.report(
            Diagnostic::new(given.method.place(), "a scene without loads has nothing to balance")
                .help("list its loads, or leave the parentheses out to have them all"),
        );
    }
    loads
}

type Refused = Vec<(String, Option<Wanted>)>;

/// The results of a scene, and those that it names in vain.
fn results(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    loads: &[LoadId],
    names: &Names,
    sink: &Sink,
) -> (Vec<Wanted>, Refused) {
    let Some(listed) = &given.results else { return (all_results(model, method, loads), Vec::new()) };
    if method == Method::Verify {
        let place = given.method.place();
        if cfg!(feature = "reference") {
            sink.report(Diagnostic::new(place, "`verify` compares all results").help("leave the list of results out"));
        }
        return (Vec::new(), Vec::new());
    }
    let (mut results, mut refused): (Vec<Wanted>, Refused) = (Vec::new(), Vec::new());
    for item in listed {
        match result(model, given, method, item, names) {
            Ok(Some(wanted)) if results.contains(&wanted) => {
                let place = end_of(item).place();
                sink.report(Diagnostic::new(place, "this result is listed twice").help("leave one of them out"));
            }
            Ok(Some(wanted)) => {
                // Where a joint is could be another mistake.
                if sink.is_clean() {
                    without_path(model, item, wanted).into_iter().for_each(|error| sink.report(error));
                }
                let name = model.result_name(wanted);
                if name.is_some() && results.iter().any(|other| model.result_name(*other) == name) {
                    let problem = format!("two results would be called `{}`", name.unwrap_or_default());
                    sink.report(
                        Diagnostic::new(end_of(item).place(), problem).help("let two scenes give them, or rename one"),
                    );
                }
                results.push(wanted);
            }
            Ok(None) => refused.push(likely(model, names, item)),
            Err(error) => {
                sink.report(error);
                refused.push(likely(model, names, item));
            }
        }
    }
    if listed.is_empty() {
        sink.report(
            Diagnostic::new(given.method.place(), "a scene without results has nothing to compute")
                .help("list its results, or leave the list out to have them all"),
        );
    } else if results == [Wanted::ErrorBound] && refused.is_empty() {
        sink.report(
            Diagnostic::new(end_of(&listed[0]).place(), "there is no result whose error it could bound")
                .help("list the results whose bounds are wanted beside it"),
        );
    }
    (results, refused)
}

/// What a result is about.
pub(super) fn end_of(item: &ResultItem) -> ast::End {
    match item {
        ResultItem::Name(name) => ast::End { link: name.clone(), point: None },
        ResultItem::Point(link, point) => ast::End { link: link.clone(), point: Some(point.clone()) },
        ResultItem::Along(joint, _) | ResultItem::About(joint, _) => joint.clone(),
        ResultItem::OfLink(what, _) | ResultItem::OfPoint(what, _) => ast::End { link: what.clone(), point: None },
    }
}

/// The field of a refused result, and what it is like.
fn likely(model: &Model, names: &Names, item: &ResultItem) -> (String, Option<Wanted>) {
    let near = |joint: &Name| JointId::new(names.near(Role::Joint, &joint.text).unwrap_or(0));
    match item {
        ResultItem::Along(of, link) if of.point.is_none() => {
            let joint = &of.link;
            return (format!("{joint}_along_{link}"), Some(Wanted::Along(near(joint), GROUND)));
        }
        ResultItem::Along(of, link) => {
            let name = format!("{}_along_{link}", of.written().replace('.', "_"));
            return (name, Some(Wanted::Resolved(Spot::Joint(JointId::new(0)), Along::Path)));
        }
        ResultItem::OfLink(what, link) => {
            let like = match what.text.as_str() {
                "offset" => Wanted::Offset(GROUND),
                "power" => Wanted::Power(None),
                "advantage" => Wanted::Advantage(LoadId::new(names.near(Role::Load, &link.text).unwrap_or(0))),
                _ => Wanted::Inertia(GROUND),
            };
            return (format!("{link}_{what}"), Some(like));
        }
        ResultItem::OfPoint(what, ast::End { link, point }) => {
            let point = point.as_ref().map_or("", |point| point.text.as_str());
            let at = End { link: GROUND, point: PointId::FIRST };
            return (format!("{what}_{link}_{point}"), Some(Wanted::Shaking(at)));
        }
        ResultItem::About(joint, ast::End { link, point }) if joint.link.text == "ground" => {
            let point = point.as_ref().map_or("", |point| point.text.as_str());
            let at = End { link: GROUND, point: PointId::FIRST };
            return (format!("ground_about_{link}_{point}"), Some(Wanted::OnGround(at)));
        }
        ResultItem::About(joint, ast::End { link, point }) => {
            let point = point.as_ref().map_or("", |point| point.text.as_str());
            let at = End { link: GROUND, point: PointId::FIRST };
            let joint = &joint.link;
            return (format!("{joint}_about_{link}_{point}"), Some(Wanted::About(near(joint), at)));
        }
        _ => {}
    }
    let ast::End { link, point } = end_of(item);
    if let Some(joint) = names.entry(&link.text).filter(|entry| entry.role == Role::Joint) {
        return (link.text, Some(Wanted::Joint(JointId::new(joint.index))));
    }
    if let Some(point) = point {
        let id = LinkId::new(names.near(Role::Link, &link.text).unwrap_or(0));
        let at = Wanted::Point(End { link: id, point: PointId::FIRST });
        return (format!("{link}_{point}"), Some(if point.text == "angle" { Wanted::Angle(id) } else { at }));
    }
    let of = |name: &str| {
        let unknown = model.unknowns.iter().position(|unknown| unknown.name == name);
        let entry = names.entry(name);
        match (unknown, entry.map(|entry| (entry.role, entry.index))) {
            (Some(unknown), _) => Some(Wanted::Unknown(UnknownId::new(unknown))),
            (_, Some((Role::Joint, joint))) => Some(Wanted::Joint(JointId::new(joint))),
            (_, Some((Role::Load, load))) => Some(Wanted::Load(LoadId::new(load))),
            _ => None,
        }
    };
    let known = model.unknowns.iter().map(|unknown| unknown.name.as_str());
    let known = known.chain(names.of(Role::Joint)).chain(names.of(Role::Load));
    let like = of(&link.text).or_else(|| closest(&link.text, known).and_then(of));
    (link.text, like)
}

/// All that a method gives.
fn all_results(model: &Model, method: Method, loads: &[LoadId]) -> Vec<Wanted> {
    let joints = (0..model.joints.len()).map(|j| Wanted::Joint(JointId::new(j)));
    let unknowns = (0..model.unknowns.len()).map(|u| Wanted::Unknown(UnknownId::new(u)));
    match method {
        Method::Position | Method::Velocity | Method::Acceleration | Method::Coefficients => {
            let jointed = |end: End| model.joints.iter().any(|j| j.ends().contains(&end));
            let points = model
                .moving_links()
                .flat_map(|link| (0..model.link(link).points.len()).map(move |p| End { link, point: PointId::new(p) }));
            let points = points.filter(|end| !jointed(*end)).map(Wanted::Point);
            joints.chain(points).chain(model.moving_links().map(Wanted::Angle)).collect()
        }
        Method::Equilibrium | Method::Superposition => unknowns.chain(joints).collect(),
        Method::VirtualWork => unknowns.chain(loads.iter().copied().map(Wanted::Load)).collect(),
        Method::Motion => [Part::Mass, Part::Bias, Part::Rounding].map(Wanted::Part).into(),
        Method::Verify | Method::Inverse | Method::Derivative => Vec::new(),
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
        // Of a method that is not known, nothing is known of its results.
        _ if given.method.text != word(method) => Ok(None),
        _ if method == Method::Motion => part(item).map(Some),
        ResultItem::Point(link, point) => {
            let place = link.place().to(point.place());
            if let Some(joint) = names.entry(&link.text).filter(|entry| entry.role == Role::Joint) {
                let help = format!("ask for the whole result, `{link}`, and read its `.{point}` in the code");
                return Err(Diagnostic::new(place, joint.instead_of(Role::Link, link).message()).help(help));
            }
            let Some(id) = names.find(Role::Link, link)?.map(LinkId::new) else { return Ok(None) };
            if method.has_loads() {
                let what = if point.text == "angle" { "the angle of a link" } else { "the place of a point" };
                return Err(cannot(given, place, &format!("{link}.{point}"), what).help("`position` gives it"));
            }
            if point.text == "angle" {
                return Ok(Some(Wanted::Angle(id)));
            }
            Ok(point_of(model, id, point)?.map(Wanted::Point))
        }
        ResultItem::Name(name) => named_result(model, given, method, name, names),
        ResultItem::Along(of, along) if !method.has_loads() && of.point.as_ref().is_some_and(|p| p.text == "angle") => {
            let whole = of.written();
            let problem = format!("`{whole}` turns, and has no part along `{along}`");
            Err(Diagnostic::new(of.place().to(along.place()), problem).help(format!("write `{whole}`")))
        }
        ResultItem::Along(of, link) if matches!(method, Method::Velocity | Method::Acceleration) => {
            let spot = match &of.point {
                Some(point) => {
                    let Some(id) = names.find(Role::Link, &of.link)?.map(LinkId::new) else { return Ok(None) };
                    point_of(model, id, point)?.map(Spot::Point)
                }
                None => names.find(Role::Joint, &of.link)?.map(|joint| Spot::Joint(JointId::new(joint))),
            };
            let link_called_so = names.entry("path").is_some_and(|entry| entry.role == Role::Link);
            if link.text == "path" && !link_called_so {
                if method == Method::Velocity {
                    let problem = "a velocity is along the path: across it there is nothing";
                    return Err(
                        Diagnostic::new(link.place(), problem).help("resolve it along a link, or ask for the vector")
                    );
                }
                return Ok(spot.map(|spot| Wanted::Resolved(spot, Along::Path)));
            }
            let along = names.find(Role::Link, link)?.map(|link| Along::Link(LinkId::new(link)));
            Ok(spot.zip(along).map(|(spot, along)| Wanted::Resolved(spot, along)))
        }
        ResultItem::OfLink(what, unknown) if what.text == "power" => {
            let place = what.place().to(unknown.place());
            power(model, given, method, (place, Some(unknown)), names)
        }
        ResultItem::OfLink(what, load) if what.text == "advantage" => {
            advantage(model, given, method, (what, load), names)
        }
        ResultItem::OfPoint(what, point) => shaking(model, given, method, (what, point), names),
        ResultItem::OfLink(what, link) => of_link(model, given, method, (what, link), names),
        ResultItem::Along(of, link) if matches!(method, Method::Position | Method::Coefficients) => {
            let (place, whole) = (of.place().to(link.place()), of.written());
            Err(cannot(given, place, &format!("{whole} along {link}"), "a part of a vector")
                .help(format!("ask for the whole vector: `{whole}`")))
        }
        ResultItem::Along(joint, link) => {
            let link_id = names.find(Role::Link, link)?.map(LinkId::new);
            let joint_id =
                reaction_of(given, method, (joint, &format!("along {link}")), names, joint.place().to(link.place()))?;
            Ok(joint_id.zip(link_id).map(|(joint, link)| Wanted::Along(joint, link)))
        }
        ResultItem::About(joint, point) => {
            let at = end(Scope { model, names }, point, None)?;
            if joint.point.is_none() && joint.link.text == "ground" {
                let place = joint.place().to(point.place());
                return match method {
                    Method::Equilibrium | Method::Superposition => Ok(at.map(Wanted::OnGround)),
                    _ => {
                        Err(cannot(given, place, &format!("ground about {}", point.written()), "what the ground feels")
                            .help("`equilibrium` gives it"))
                    }
                };
            }
            let Some(id) = reaction_of(
                given,
                method,
                (joint, &format!("about {}", point.written())),
                names,
                joint.place().to(point.place()),
            )?
            else {
                return Ok(None);
            };
            if let Some(of) = model.joints.get(id.index()).filter(|of| of.kind.turn().is_none()) {
                let (name, noun) = (&of.name, of.kind.noun());
                let problem = format!("the {noun} `{name}` has no couple, about whatever point");
                return Err(Diagnostic::new(joint.place(), problem).help(format!("ask for its force: `{name}`")));
            }
            Ok(at.map(|at| Wanted::About(id, at)))
        }
    }
}

/// That what never moves has no path.
fn without_path(model: &Model, item: &ResultItem, wanted: Wanted) -> Option<Diagnostic> {
    let Wanted::Resolved(spot, Along::Path) = wanted else { return None };
    let why = match spot {
        Spot::Point(End { link: GROUND, .. }) => "it is a point of the ground",
        _ if model.is_fixed(spot) => "a joint holds it to the ground",
        _ => return None,
    };
    let of = end_of(item);
    let problem = format!("`{}` never moves, and has no path", of.written());
    Some(Diagnostic::new(of.place(), problem).note(why).help("ask for a point that moves, or leave it out"))
}

/// A point of a link by its name.
fn point_of(model: &Model, id: LinkId, point: &Name) -> Result<Option<End>, Diagnostic> {
    let Some(body) = model.links.get(id.index()) else { return Ok(None) };
    match body.points.iter().position(|p| p.name.text == point.text) {
        Some(index) => Ok(Some(End { link: id, point: PointId::new(index) })),
        None if body.unread => Ok(None),
        None => Err(body.without_point(point, ["angle"])),
    }
}

/// `inertia(rod)`, `offset(rod)`
fn of_link(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    (what, link): (&Name, &Name),
    names: &Names,
) -> Result<Option<Wanted>, Diagnostic> {
    let place = what.place().to(link.place());
    let shown = format!("{what}({link})");
    let wanted: fn(LinkId) -> Wanted = match what.text.as_str() {
        "inertia" => Wanted::Inertia,
        "offset" => Wanted::Offset,
        "shaking" => {
            return Err(Diagnostic::new(link.place(), format!("of what point of `{link}`?"))
                .help("the resultant of inertia is taken about a point, as in `shaking(ground.O)`"));
        }
        other => {
            return Err(Diagnostic::new(what.place(), format!("there is no result `{shown}`"))
                .suggest(other, ["inertia", "offset", "shaking", "power", "advantage"]));
        }
    };
    if method != Method::Acceleration {
        return Err(cannot(given, place, &shown, "what the inertia of a link exerts").help("`acceleration` gives it"));
    }
    let Some(id) = names.find(Role::Link, link)?.map(LinkId::new) else { return Ok(None) };
    let Some(body) = model.links.get(id.index()) else { return Ok(None) };
    if id == GROUND {
        return Err(Diagnostic::new(link.place(), "the ground does not move: it has no inertia")
            .help("ask for that of a moving link"));
    }
    if body.mass.is_none() {
        return Err(Diagnostic::new(link.place(), format!("the link `{link}` has no mass"))
            .help(format!("give it one, as in `mass {link}: 0.5kg at (0, 0);`, or leave the result out")));
    }
    Ok(Some(wanted(id)))
}

/// `shaking(ground.O)`
fn shaking(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    (what, point): (&Name, &ast::End),
    names: &Names,
) -> Result<Option<Wanted>, Diagnostic> {
    let (place, shown) = (what.place().to(point.place()), format!("{what}({})", point.written()));
    if ["inertia", "offset"].contains(&what.text.as_str()) {
        let link = &point.link;
        return Err(Diagnostic::new(place, format!("`{what}` is that of a whole link, and not of a point"))
            .help(format!("write `{what}({link})`")));
    }
    if what.text != "shaking" {
        return Err(Diagnostic::new(what.place(), format!("there is no result `{shown}`"))
            .suggest(&what.text, ["inertia", "offset", "shaking", "power", "advantage"]));
    }
    if method != Method::Acceleration {
        return Err(cannot(given, place, &shown, "the resultant of inertia").help("`acceleration` gives it"));
    }
    let at = end(Scope { model, names }, point, None)?;
    if model.links.iter().all(|link| link.mass.is_none()) && !model.links.iter().any(|link| link.unread) {
        return Err(Diagnostic::new(place, "no link has a mass: nothing shakes")
            .help("declare one, as in `mass rod: 0.5kg at (0, 0);`, or leave the result out"));
    }
    Ok(at.map(Wanted::Shaking))
}

/// `power`, `power(T)`
fn power(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    (place, of): (Place, Option<&Name>),
    names: &Names,
) -> Result<Option<Wanted>, Diagnostic> {
    let shown = of.map_or_else(|| "power".to_owned(), |of| format!("power({of})"));
    if !method.has_loads() || method == Method::Verify {
        return Err(
            cannot(given, place, &shown, "the power of an effort").help("`equilibrium` and `virtual_work` give it")
        );
    }
    let Some(name) = of else { return Ok(Some(Wanted::Power(None))) };
    match model.unknowns.iter().position(|unknown| unknown.name == name.text) {
        Some(index) => Ok(Some(Wanted::Power(Some(UnknownId::new(index))))),
        None if names.may_be(Role::Unknown) => Ok(None),
        None => {
            let known = model.unknowns.iter().map(|unknown| unknown.name.as_str());
            Err(Diagnostic::new(name.place(), format!("there is no unknown `{name}`")).suggest(&name.text, known))
        }
    }
}

/// `advantage(M4)`
fn advantage(
    model: &Model,
    given: &ast::Scene,
    method: Method,
    (what, load): (&Name, &Name),
    names: &Names,
) -> Result<Option<Wanted>, Diagnostic> {
    let (place, shown) = (what.place().to(load.place()), format!("{what}({load})"));
    if method != Method::VirtualWork {
        return Err(cannot(given, place, &shown, "the mechanical advantage").help("`virtual_work` gives it"));
    }
    let Some(id) = names.find(Role::Load, load)?.map(LoadId::new) else { return Ok(None) };
    if model.loads.get(id.index()).is_some_and(|load| load.kind.is_per_link()) {
        return Err(Diagnostic::new(
            load.place(),
            format!("`{load}` acts on many links: no single velocity goes with it"),
        )
        .help("ask for the advantage over a force, a moment or a thrust"));
    }
    Ok(Some(Wanted::Advantage(id)))
}

/// The joint whose reaction is wanted in some form.
fn reaction_of(
    given: &ast::Scene,
    method: Method,
    (end, behind): (&ast::End, &str),
    names: &Names,
    whole: Place,
) -> Result<Option<JointId>, Diagnostic> {
    let joint = &end.link;
    if !matches!(method, Method::Equilibrium | Method::Superposition) {
        let shown = format!("{} {behind}", end.written());
        return Err(cannot(given, whole, &shown, "the reaction of a joint").help("`equilibrium` gives it"));
    }
    if let Some(point) = &end.point {
        let word = behind.split(' ').next().unwrap_or_default();
        let problem = format!("before `{word}` stands a joint, and `{joint}.{point}` is a point");
        return Err(Diagnostic::new(end.place(), problem).help("write the name of the joint alone"));
    }
    Ok(names.find(Role::Joint, joint)?.map(JointId::new))
}

fn word(method: Method) -> &'static str {
    match method {
        Method::Position => "position",
        Method::Velocity => "velocity",
        Method::Acceleration => "acceleration",
        Method::Coefficients => "coefficients",
        Method::Equilibrium => "equilibrium",
        Method::Superposition => "superposition",
        Method::VirtualWork => "virtual_work",
        Method::Motion => "motion",
        Method::Inverse => "inverse",
        Method::Verify => "verify",
        Method::Derivative => "derivative",
    }
}

/// A part of the equation of motion.
fn part(item: &ResultItem) -> Result<Wanted, Diagnostic> {
    let of = end_of(item);
    if matches!(item, ResultItem::Name(name) if name.text == ERROR_BOUND) {
        return Ok(Wanted::ErrorBound);
    }
    let named = match item {
        ResultItem::Name(name) => Part::ALL.into_iter().find(|part| part.name() == name.text),
        _ => None,
    };
    named.map(Wanted::Part).ok_or_else(|| {
        let names: Vec<&str> = Part::ALL.iter().map(|part| part.name()).collect();
        Diagnostic::new(of.place(), format!("`motion` cannot give `{}`", of.written()))
            .help(format!("its results are {}", list(&names)))
    })
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
            Method::Position | Method::Velocity | Method::Acceleration | Method::Coefficients => {
                Err(cannot(given, name.place(), &name.text, "an effort")
                    .help("`equilibrium` and `virtual_work` give it"))
            }
            _ => Ok(Some(Wanted::Unknown(UnknownId::new(index)))),
        };
    }
    if name.text == ERROR_BOUND && names.entry(ERROR_BOUND).is_none() {
        return match method {
            Method::Superposition => Err(cannot(given, name.place(), ERROR_BOUND, "the bound of the errors")
                .help("`equilibrium` gives it, of one load too")),
            _ => Ok(Some(Wanted::ErrorBound)),
        };
    }
    match names.entry(&name.text).map(|entry| (entry.role, entry.index)) {
        Some((Role::Broken, _)) => Ok(None),
        Some((Role::Joint, index)) => match method {
            Method::VirtualWork => Err(cannot(given, name.place(), &name.text, "the reaction of a joint")
                .note("a reaction does no work in the motion that its joint allows, so it never enters")
                .help("`equilibrium` gives it")),
            _ => Ok(Some(Wanted::Joint(JointId::new(index)))),
        },
        Some((Role::Load, index)) => {
            let load = LoadId::new(index);
            if method != Method::VirtualWork {
                return Err(
                    cannot(given, name.place(), &name.text, "the term of a load").help("`virtual_work` gives it")
                );
            }
            let listed = given.loads.as_ref().is_none_or(|l| l.iter().any(|n| n.text == name.text));
            if !listed {
                let problem = format!("the load `{name}` is not in this scene");
                return Err(Diagnostic::new(name.place(), problem).help("add it to the list of loads"));
            }
            Ok(Some(Wanted::Load(load)))
        }
        Some((Role::Link, index)) if !method.has_loads() => {
            let points = model.links.get(index).map_or(&[][..], |link| &link.points);
            let point = points.last().map_or("P", |point| point.name.text.as_str());
            Err(Diagnostic::new(name.place(), format!("of the link `{name}`, its angle or a point?"))
                .help(format!("write `{name}.angle`, or a point of it, such as `{name}.{point}`")))
        }
        // The effort at a drive whose name could not be read.
        None if name.text.starts_with("effort_") && names.may_be(Role::Drive) => Ok(None),
        None if name.text == "power" => power(model, given, method, (name.place(), None), names),
        _ if names.may_mean(&[Role::Joint, Role::Load, Role::Unknown], &name.text) => Ok(None),
        _ => {
            let known: Vec<&str> = match method {
                _ if !method.has_loads() => names.of(Role::Joint).collect(),
                Method::VirtualWork => {
                    model.unknowns.iter().map(|u| u.name.as_str()).chain(names.of(Role::Load)).collect()
                }
                _ => model.unknowns.iter().map(|u| u.name.as_str()).chain(names.of(Role::Joint)).collect(),
            };
            let problem = match names.entry(&name.text) {
                Some(entry) => format!("`{name}` is {}, and no result", entry.role.describe()),
                None => format!("there is no result `{name}`"),
            };
            Err(Diagnostic::new(name.place(), problem).suggest(&name.text, known))
        }
    }
}

/// The word for the bounds of all errors among a scene's results.
pub(crate) const ERROR_BOUND: &str = "error_bound";

pub(super) fn cannot(given: &ast::Scene, place: Place, result: &str, what: &str) -> Diagnostic {
    Diagnostic::new(place, format!("`{}` cannot give `{result}`: {what} is not among its results", given.method))
}

/// A type's name for a scene: `bearing_load` becomes `BearingLoad`. Underscores in front stay.
#[must_use]
pub fn type_name(name: &str) -> String {
    let inner = name.trim_start_matches('_');
    let capitals = inner.split('_').map(|part| {
        let mut letters = part.chars();
        letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    });
    core::iter::once(name[..name.len() - inner.len()].to_owned()).chain(capitals).collect()
}
