//! Parameters, links, points and masses.

use std::collections::BTreeSet;

use super::evaluate::Scope;
use super::ids::{GROUND, LinkId, PointId};
use super::names::{Names, Role, unread};
use super::units::{Kind, PARAMETER_KINDS};
use super::{Link, Mass, Model, Param, Point};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::{Expr, Failure, NodeId, Vector};
use crate::syntax::ast::{self, Ast, Distances, Item, Name, PointPlace, PointRef, ValueKind};

/// Parameters. Their defaults are constants.
pub(super) fn params(model: &mut Model, ast: &Ast, names: &mut Names, sink: &Sink) {
    let constants = Names::collect(&Ast { items: Vec::new(), ..ast.clone() }, &Sink::default());
    for item in &ast.items {
        if let Some((_, name)) = unread(item, Role::Param) {
            model.params.push(Param { name: name.clone(), kind: Kind::Number, default: None });
        }
        let Item::Param(param) = item else { continue };
        let name = param.name.clone();
        let Some((_, kind)) = PARAMETER_KINDS.iter().find(|(name, _)| *name == param.dimension.text) else {
            let known = PARAMETER_KINDS.iter().map(|(name, _)| *name);
            let problem = format!("there is no dimension `{}`", param.dimension);
            sink.report(Diagnostic::new(param.dimension.place(), problem).suggest(&param.dimension.text, known));
            names.distrust(&name);
            model.params.push(Param { name, kind: Kind::Number, default: None });
            continue;
        };
        let scope = Scope { model, names: &constants };
        let default = param.default.as_ref().and_then(|value| {
            let variable = parameter_in(value, names);
            sink.absorb(variable.map_or_else(|| scope.scalar(value, *kind), Err))
        });
        let default = default.map(Expr::id);
        model.params.push(Param { name, kind: *kind, default });
    }
}

/// A parameter on which a default would depend.
fn parameter_in(value: &ast::Value, names: &Names) -> Option<Diagnostic> {
    match &value.kind {
        ValueKind::Name(name) => {
            let param = names.entry(name).is_some_and(|entry| entry.role == Role::Param && entry.sound);
            let found =
                || Diagnostic::new(value.place, format!("`{name}` is a parameter, and a default is a constant"));
            param.then(|| found().help("write the number with its unit"))
        }
        ValueKind::Number(..) => None,
        ValueKind::Negative(inner) | ValueKind::Power(inner, _) => parameter_in(inner, names),
        ValueKind::Sum(a, b) | ValueKind::Difference(a, b) | ValueKind::Product(a, b) | ValueKind::Quotient(a, b) => {
            parameter_in(a, names).or_else(|| parameter_in(b, names))
        }
        ValueKind::Call(_, args) => args.iter().find_map(|arg| parameter_in(arg, names)),
    }
}

/// The ground and the links, with their points.
pub(super) fn links(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    let bodies: Vec<&ast::Link> =
        ast.items.iter().filter_map(|i| if let Item::Link(l) = i { Some(l) } else { None }).collect();
    let grounds: Vec<&&ast::Link> = bodies.iter().filter(|l| l.name.is_none()).collect();
    let ground_unread = ast.items.iter().find_map(|item| match item {
        Item::Broken(broken) if broken.is("ground") => Some(broken),
        _ => None,
    });
    let may_be_ground = ground_unread.is_some() || names.may_be(Role::Broken);
    if grounds.is_empty() && !may_be_ground {
        sink.report(
            Diagnostic::new(ast.name.place(), "the linkage has no ground")
                .help("say where its fixed points are: `ground { A0: (0, 0), B0: (140mm, 0) }`"),
        );
    }
    let ground_name = Name { text: "ground".into(), span: grounds.first().map_or(ast.name.span, |g| g.keyword) };
    model.links.push(link(ground_name, grounds.is_empty()));
    if let Some(ground) = grounds.first() {
        points(model, GROUND, ground, names, sink);
    }
    for item in &ast.items {
        let id = LinkId::new(model.links.len());
        if let Some((broken, name)) = unread(item, Role::Link) {
            model.links.push(link(name.clone(), true));
            unread_points(model, id, broken.words());
        }
        let Item::Link(body @ ast::Link { name: Some(name), .. }) = item else { continue };
        model.links.push(link(name.clone(), false));
        points(model, id, body, names, sink);
    }
}

fn link(name: Name, unread: bool) -> Link {
    Link { name, points: Vec::new(), distances: Vec::new(), mass: None, unread }
}

/// Any of these words may have been meant as a point.
fn unread_points(model: &mut Model, link: LinkId, words: Vec<Name>) {
    model.links[link.index()].unread = true;
    for word in words {
        if model.link(link).points.iter().all(|point| point.name.text != word.text) {
            let at = model.unread_vector().into();
            model.links[link.index()].points.push(Point { name: word, at });
        }
    }
}

fn points(model: &mut Model, link: LinkId, body: &ast::Link, names: &Names, sink: &Sink) {
    let mut frame_given = false;
    for (index, place) in body.places.iter().enumerate() {
        match place {
            PointPlace::Frame(from, to, length) => {
                let refused = wrong_frame(model.link(link), frame_given, from, to);
                // Of a frame that is refused, nothing is said of its points.
                let slips = Sink::default();
                let sink = refused.map_or(sink, |error| {
                    sink.report(error);
                    &slips
                });
                frame_given = true;
                let length = sink.absorb(frame_length(model, names, link, (from, to), length));
                let zero = model.graph.zero().id();
                let length = length.unwrap_or_else(|| model.unread().known_positive().id());
                let start = add_point(model, link, from, (zero, zero), sink);
                let end = add_point(model, link, to, (length, zero), sink);
                model.links[link.index()].distances.push((start, end, length));
            }
            PointPlace::Origin(name) => {
                let zero = model.graph.zero().id();
                add_point(model, link, name, (zero, zero), sink);
            }
            PointPlace::At(name, vector) => {
                let scope = Scope { model, names };
                let at = sink.absorb(scope.vector(vector, Kind::Length));
                let at = at.unwrap_or_else(|| model.unread_vector());
                let at = (at.x.id(), at.y.id());
                let id = add_point(model, link, name, at, sink);
                polar_distance(model, link, id, vector, names);
            }
            PointPlace::Distances(name, distances) => {
                let found = match measured_from_later(&model.link(link).points, &body.places[index..], distances) {
                    // The frame itself is refused there, and what cannot be read is.
                    Some((_, PointPlace::Frame(..) | PointPlace::Unread(_))) => None,
                    Some((own, _)) if own.text == name.text => {
                        let problem = format!("the point `{own}` cannot be measured from itself");
                        sink.report(Diagnostic::new(own.place(), problem).help("choose another point of the link"));
                        None
                    }
                    Some((later, _)) => {
                        let problem =
                            format!("the point `{later}` is declared behind the one that is measured from it");
                        sink.report(Diagnostic::new(later.place(), problem).help(format!("put `{later}` in front")));
                        None
                    }
                    None => sink.absorb(by_distances(model, names, link, name, distances)),
                };
                let (at, legs) = found.unwrap_or_else(|| {
                    let at = model.unread_vector();
                    ((at.x.id(), at.y.id()), Vec::new())
                });
                let id = add_point(model, link, name, at, sink);
                model.links[link.index()].distances.extend(legs.into_iter().map(|(to, length)| (to, id, length)));
            }
            PointPlace::Unread(words) => unread_points(model, link, words.clone()),
        }
    }
    // A point of which the name is another one's may have been meant as any.
    let points = &model.link(link).points;
    let names: BTreeSet<&str> = points.iter().map(|point| point.name.text.as_str()).collect();
    if names.len() < points.len() {
        model.links[link.index()].unread = true;
    }
}

/// What is wrong with the frame `from -> to` behind the points that a link has so far.
fn wrong_frame(body: &Link, frame_given: bool, from: &Name, to: &Name) -> Option<Diagnostic> {
    let refusal =
        |problem: String, help: String| Some(Diagnostic::new(from.place().to(to.place()), problem).help(help));
    if frame_given {
        let help = format!("give `{to}` by its coordinates in the frame: `{to}: (x, y)`");
        return refusal("a link has one frame".to_owned(), help);
    }
    if from.text == to.text {
        let problem = format!("the frame of `{}` goes from `{from}` to `{to}`", body.name);
        return refusal(problem, "name two points: the frame's x axis goes from the first to the second".to_owned());
    }
    if !body.points.is_empty() {
        let help = format!("put `{from} -> {to}` in front of the other points");
        return refusal("the frame comes first in a link".to_owned(), help);
    }
    None
}

/// The first end of the distances that is none of the known points, but declared at one of these places; and that place.
fn measured_from_later<'a>(
    known: &[Point],
    places: &'a [PointPlace],
    distances: &'a Distances,
) -> Option<(&'a Name, &'a PointPlace)> {
    let declares = |place: &PointPlace, end: &Name| match place {
        PointPlace::Frame(from, to, _) => [from, to].into_iter().any(|point| point.text == end.text),
        PointPlace::At(point, _) | PointPlace::Distances(point, _) | PointPlace::Origin(point) => {
            point.text == end.text
        }
        PointPlace::Unread(words) => words.iter().any(|word| word.text == end.text),
    };
    let ends = [&distances.from, &distances.to].into_iter();
    let mut unknown = ends.filter(|end| known.iter().all(|point| point.name.text != end.text));
    unknown.find_map(|end| Some((end, places.iter().find(|place| declares(place, end))?)))
}

type Ids = (NodeId, NodeId);

fn add_point(model: &mut Model, link: LinkId, name: &Name, at: Ids, sink: &Sink) -> PointId {
    let body = &mut model.links[link.index()];
    if body.points.iter().any(|p| p.name.text == name.text) && !body.unread {
        sink.report(
            Diagnostic::new(name.place(), format!("the link `{}` has a point `{name}` already", body.name))
                .help("give this one another name, or leave it out"),
        );
    }
    if !name.is_usable() {
        let problem = format!("`{name}` cannot be a name: Rust keeps the word for itself");
        sink.report(Diagnostic::new(name.place(), problem).help("choose another name"));
    }
    if matches!(name.text.as_str(), "angle" | "direction") {
        sink.report(
            Diagnostic::new(
                name.place(),
                format!("a point cannot be called `{name}`: `{}.{name}` is the link's own {name}", body.name),
            )
            .help("choose another name"),
        );
    }
    // Only what parameters make of it gets a name in the code.
    let owner = if body.name.text == "ground" { String::new() } else { format!("{}_", body.name) };
    let at = super::Pair { x: at.0, y: at.1 }.vector(&model.graph);
    let at = at.named(&format!("{owner}{name}"), &format!("{name} in the frame of {}", body.name));
    body.points.push(Point { name: name.clone(), at: at.into() });
    PointId::new(body.points.len() - 1)
}

fn frame_length(
    model: &Model,
    names: &Names,
    link: LinkId,
    (from, to): (&Name, &Name),
    length: &ast::Value,
) -> Result<NodeId, Diagnostic> {
    let value = Scope { model, names }.scalar(length, Kind::Length)?;
    let body = &model.link(link).name;
    match value.sign() {
        Some(1) => Ok(value.id()),
        Some(_) => Err(Diagnostic::new(length.place, format!("the length of `{body}` from `{from}` to `{to}` must be positive"))
            .note("the frame's x axis points from the first point to the second: with no length between them it has no direction")),
        None => {
            let requirement = format!("{body}: the length {from} -> {to} must be positive");
            Ok(value.required_positive(requirement).id())
        }
    }
}

/// A point `size @ angle` is at the distance `size` from a point at the origin.
fn polar_distance(model: &mut Model, link: LinkId, id: PointId, vector: &ast::VectorValue, names: &Names) {
    let ast::VectorKind::Polar(size, _) = &vector.kind else { return };
    let Ok(size) = (Scope { model, names }).scalar(size, Kind::Length) else { return };
    if size.sign() != Some(1) {
        return;
    }
    let size = size.id();
    let at_origin = |p: &Point| p.at.vector(&model.graph).is_zero();
    let origin = model.link(link).points.iter().position(at_origin).map(PointId::new);
    if let Some(origin) = origin.filter(|o| *o != id) {
        model.links[link.index()].distances.push((origin, id, size));
    }
}

type Triangle = (Ids, Vec<(PointId, NodeId)>);

/// The third corner of a triangle: with `e` the direction of the base of length `d`, it lies at
/// `x e ± y e⊥`, `x = (r₁² − r₂² + d²)/2d`, `y = √(r₁² − x²)`.
fn by_distances(
    model: &Model,
    names: &Names,
    link: LinkId,
    name: &Name,
    given: &Distances,
) -> Result<Triangle, Diagnostic> {
    let scope = Scope { model, names };
    let r1 = scope.scalar(&given.from_distance, Kind::Length)?;
    let r2 = scope.scalar(&given.to_distance, Kind::Length)?;
    let (Some(from), Some(to)) = (scope.point(link, &given.from)?, scope.point(link, &given.to)?) else {
        let at = model.unread_vector();
        return Ok(((at.x.id(), at.y.id()), Vec::new()));
    };
    let point = |p: PointId| model.link(link).points[p.index()].at.vector(&model.graph);
    let base = point(to) - point(from);
    let d = model.distance(link, from, to);
    if d.is_zero() {
        let problem = format!("`{}` and `{}` are at the same place", given.from, given.to);
        return Err(Diagnostic::new(given.place, problem).help("choose two points that are apart, or give coordinates"));
    }
    let along = (r1.squared() - r2.squared() + d.squared()) / (2 * d);
    let height_squared = r1.squared() - along.squared();
    let body = &model.link(link).name;
    if height_squared.sign() == Some(-1) || r1.sign() == Some(-1) || r2.sign() == Some(-1) {
        let problem = format!("no point is at these distances from `{}` and `{}`", given.from, given.to);
        let unit = model.units.length.name;
        let note = if [r1, r2].iter().any(|distance| distance.sign() == Some(-1)) {
            "a distance is not less than zero: to which side the point lies, `left` and `right` say".to_owned()
        } else {
            let [d, r1, r2] = [d, r1, r2].map(number);
            format!(
                "the sides of the triangle are {d} {unit}, {r1} {unit} and {r2} {unit}, and none may be longer than the other two together"
            )
        };
        return Err(Diagnostic::new(given.place, problem)
            .note(note)
            .help(format!("change a distance, or give coordinates: `{name}: (x, y)`")));
    }
    let requirement =
        format!("{body}: the distances of {name} must close the triangle {} {} {name}", given.from, given.to);
    let height_squared =
        height_squared.require_at_least(height_squared, model.graph.zero(), Failure::Parameter { requirement });
    let height = height_squared.sqrt();
    let across = if given.left { height } else { -height };
    let direction = Vector::new(base.x / d, base.y / d);
    let at = point(from) + Vector::new(along, across).turned_by(direction);
    let legs = [(from, &given.from, r1), (to, &given.to, r2)].into_iter().filter(|(.., length)| !length.is_zero());
    let requirement = |end: &Name| format!("{body}: the distance {end} {name} must be positive");
    let legs = legs.map(|(point, end, length)| (point, length.required_positive(requirement(end)).id())).collect();
    Ok(((at.x.id(), at.y.id()), legs))
}

fn number(value: Expr<'_>) -> String {
    value.value().map_or_else(|| "a parameter".to_owned(), |v| v.to_f64().to_string())
}

/// Masses; several on a link are taken together at their common centre, by Steiner's rule.
pub(super) fn masses(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Mass(given) = item else { continue };
        let Some(Some(link)) = sink.absorb(names.find(Role::Link, &given.link)) else { continue };
        let link = LinkId::new(link);
        if link == GROUND {
            sink.report(
                Diagnostic::new(given.link.place(), "the ground does not move: its mass plays no part")
                    .help("leave it out"),
            );
            continue;
        }
        if model.links.len() <= link.index() {
            continue;
        }
        let found = mass(Scope { model, names }, link, given);
        let added = sink.absorb(found).flatten().unwrap_or_else(|| {
            let unread = || model.unread().known_positive().id();
            Mass { mass: unread(), centroid: model.unread_vector().into(), inertia: unread() }
        });
        let total = match model.link(link).mass {
            None => added,
            Some(first) => together(model, first, added),
        };
        model.links[link.index()].mass = Some(total);
    }
}

fn mass(scope: Scope<'_>, link: LinkId, given: &ast::Mass) -> Result<Option<Mass>, Diagnostic> {
    let graph = &scope.model.graph;
    let Some(body) = scope.model.links.get(link.index()) else { return Ok(None) };
    let mass = scope.scalar(&given.mass, Kind::Mass)?;
    let mass = match mass.sign() {
        Some(1) => mass,
        Some(_) => return Err(Diagnostic::new(given.mass.place, "a mass must be positive")),
        None => {
            let requirement = format!("{}: the mass must be positive", body.name);
            mass.required_positive(requirement)
        }
    };
    let centroid = match &given.at {
        PointRef::At(vector) => scope.vector(vector, Kind::Length)?,
        PointRef::Named(name) => match scope.point(link, name)? {
            Some(point) => body.points[point.index()].at.vector(graph),
            None => return Ok(None),
        },
    };
    let inertia = match &given.inertia {
        None => graph.zero(),
        Some(value) => {
            let requirement = format!("{}: the moment of inertia must not be negative", body.name);
            scope.not_negative(value, Kind::Inertia, "a moment of inertia", requirement)?
        }
    };
    Ok(Some(Mass { mass: mass.id(), centroid: centroid.into(), inertia: inertia.id() }))
}

fn together(model: &Model, a: Mass, b: Mass) -> Mass {
    let graph = &model.graph;
    let (ma, mb) = (graph.expr(a.mass), graph.expr(b.mass));
    let (ra, rb) = (a.centroid.vector(graph), b.centroid.vector(graph));
    let mass = ma + mb;
    let share = mb / mass;
    let centroid = ra + (rb - ra).scaled(share);
    let inertia = graph.expr(a.inertia) + graph.expr(b.inertia) + ma * share * (rb - ra).squared();
    Mass { mass: mass.id(), centroid: centroid.into(), inertia: inertia.id() }
}
