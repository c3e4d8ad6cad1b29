//! Loads.

use proc_macro2::TokenTree;

use super::evaluate::Scope;
use super::ids::{GROUND, LinkId, LoadId, PointId};
use super::joints::end;
use super::names::{Names, Role, unread};
use super::units::Kind;
use super::{End, Load, LoadKind, Model, Pair};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::{Expr, NodeId, Symbol, Vector};
use crate::syntax::ast::{self, Ast, Item, Magnitude};
use crate::syntax::is_given_at_run_time;

/// Loads; what is given at run time becomes a symbol.
pub(super) fn loads(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    let massless = weightless(model, ast, names);
    for item in &ast.items {
        let id = LoadId::new(model.loads.len());
        if let Some((broken, name)) = unread(item, Role::Load) {
            let word = broken.words().first().map_or(String::new(), |word| word.text.clone());
            let written: Vec<TokenTree> = broken.rest.clone().into_iter().collect();
            let kind = stand_in(model, id, &word, &|value| is_given_at_run_time(&word, &written, value));
            let links = massive(model);
            model.loads.push(Load { name: name.clone(), kind, links });
        }
        let Item::Load(given) = item else { continue };
        let kind = kind(Scope { model, names }, given, id, sink);
        let kind = sink.absorb(kind).flatten();
        if massless && matches!(given.kind, ast::LoadKind::Gravity | ast::LoadKind::Inertia(None)) {
            sink.report(without_mass(model, given));
        }
        let kind = kind.unwrap_or_else(|| refused(model, given, id));
        let links = match &given.kind {
            ast::LoadKind::Inertia(listed) => inertia_of(Scope { model, names }, listed.as_deref(), massless, sink),
            _ => Vec::new(),
        };
        model.loads.push(Load { name: given.name.clone(), kind, links });
    }
}

/// What stands for a load that is refused.
fn refused(model: &Model, given: &ast::Load, id: LoadId) -> LoadKind {
    let (word, fields) = match &given.kind {
        ast::LoadKind::Force { .. } => ("force", None),
        ast::LoadKind::Moment { .. } => ("moment", None),
        ast::LoadKind::Gravity => ("gravity", None),
        ast::LoadKind::Thrust(_) => ("thrust", None),
        ast::LoadKind::Spring(_, fields) => ("spring", Some(fields)),
        ast::LoadKind::Torsion { fields, .. } => ("torsion", Some(fields)),
        ast::LoadKind::Inertia(_) => ("inertia", None),
    };
    stand_in(model, id, word, &|value| match fields {
        Some(fields) => fields.iter().any(|field| field.name.text == value && field.value.is_none()),
        None => given.magnitude.is_none() && word != "inertia",
    })
}

/// A load that is refused still brings its name, its type, and which of its values are given at run time.
fn stand_in(model: &Model, id: LoadId, word: &str, given: &dyn Fn(&str) -> bool) -> LoadKind {
    let value = |part: u8, name: &str| {
        if given(name) { model.graph.symbol(Symbol::Load(id, part)) } else { model.graph.zero() }.id()
    };
    let vector = Pair { x: value(0, "x"), y: value(1, "y") };
    let nowhere = End { link: GROUND, point: PointId::FIRST };
    match word {
        "moment" => LoadKind::Moment { on: GROUND, from: None, moment: value(0, "") },
        "gravity" => LoadKind::Gravity { acceleration: vector },
        "thrust" => LoadKind::Thrust { ends: [nowhere; 2], force: value(0, "") },
        "spring" => {
            let [rate, free, preload] =
                [(0, "rate"), (1, "free"), (2, "preload")].map(|(part, name)| value(part, name));
            let damping = given("damping").then(|| value(3, "damping"));
            LoadKind::Spring { ends: [nowhere; 2], rate, free, preload, damping }
        }
        "torsion" => {
            let near = given("near").then(|| value(2, "near"));
            let damping = given("damping").then(|| value(3, "damping"));
            LoadKind::Torsion {
                from: GROUND,
                on: GROUND,
                rate: value(0, "rate"),
                free: value(1, "free"),
                near,
                damping,
            }
        }
        "inertia" => LoadKind::Inertia,
        _ => LoadKind::Force { at: nowhere, force: vector, frame: GROUND },
    }
}

/// Whether it is sure that no link has a mass.
fn weightless(model: &Model, ast: &Ast, names: &Names) -> bool {
    let unread = ast.items.iter().any(|item| match item {
        Item::Mass(_) => true,
        Item::Broken(broken) => broken.is("mass"),
        _ => false,
    });
    !unread && !names.may_be(Role::Broken) && model.links.iter().all(|link| link.mass.is_none())
}

fn without_mass(model: &Model, given: &ast::Load) -> Diagnostic {
    let link = model.links.get(1).map_or("crank", |link| link.name.text.as_str());
    let what = if let ast::LoadKind::Gravity = given.kind { "gravity acts on nothing" } else { "inertia of nothing" };
    Diagnostic::new(given.name.place(), format!("{what}: no link has a mass"))
        .help(format!("give one to a link, as in `mass {link}: 0.5kg at (0, 0);`, or leave `{}` out", given.name))
}

/// All links that have mass.
fn massive(model: &Model) -> Vec<LinkId> {
    model.moving_links().filter(|link| model.link(*link).mass.is_some()).collect()
}

/// The links whose inertia is meant: those that are listed, or all that have mass.
fn inertia_of(scope: Scope<'_>, listed: Option<&[ast::Name]>, massless: bool, sink: &Sink) -> Vec<LinkId> {
    let model = scope.model;
    let Some(listed) = listed else { return massive(model) };
    let mut links = Vec::new();
    for name in listed {
        let Some(Some(link)) = sink.absorb(scope.names.find(Role::Link, name)) else { continue };
        let link = LinkId::new(link);
        let Some(body) = model.links.get(link.index()) else { continue };
        if links.contains(&link) {
            sink.report(
                Diagnostic::new(name.place(), format!("`{name}` is listed twice")).help("leave one of them out"),
            );
        } else if link == GROUND {
            sink.report(
                Diagnostic::new(name.place(), "the ground does not move: it has no inertia").help("leave it out"),
            );
        } else if body.mass.is_none() && (massless || !massive(model).is_empty()) {
            let help = format!("give it one, as in `mass {name}: 0.5kg at (0, 0);`, or leave `{name}` out");
            sink.report(Diagnostic::new(name.place(), format!("the link `{name}` has no mass")).help(help));
        } else {
            links.push(link);
        }
    }
    links
}

fn kind(scope: Scope<'_>, given: &ast::Load, id: LoadId, sink: &Sink) -> Result<Option<LoadKind>, Diagnostic> {
    match &given.kind {
        ast::LoadKind::Force { at, frame } => {
            let Some(at_end) = end(scope, at, None)? else { return Ok(None) };
            let frame = match frame {
                None => GROUND,
                Some(name) => match scope.names.find(Role::Link, name)? {
                    Some(link) => LinkId::new(link),
                    None => return Ok(None),
                },
            };
            let force = vector(scope, given, id, Kind::Force)?;
            if at_end.link == GROUND {
                return Err(Diagnostic::new(at.place(), "a force on the ground has no effect on the linkage")
                    .help("let it act on a moving link, or leave it out"));
            }
            Ok(Some(LoadKind::Force { at: at_end, force: force.into(), frame }))
        }
        ast::LoadKind::Moment { from, on } => {
            let on_link = scope.names.find(Role::Link, on)?.map(LinkId::new);
            let from_link = match from {
                Some(name) => scope.names.find(Role::Link, name)?.map(LinkId::new),
                None => None,
            };
            let moment = scalar(scope, given, id, Kind::Moment)?;
            let Some(on_link) = on_link else { return Ok(None) };
            if on_link == GROUND && from_link.is_none_or(|from| from == GROUND) {
                return Err(Diagnostic::new(on.place(), "a moment on the ground has no effect on the linkage")
                    .help("let it act on a moving link, or leave it out"));
            }
            if Some(on_link) == from_link {
                let place = from.as_ref().map_or(on.place(), |from| from.place().to(on.place()));
                return Err(Diagnostic::new(place, format!("`{on}` cannot exert a moment on itself")).help(format!(
                    "write `moment({on})` if it comes from outside, or name the link that reacts it: `moment(ground -> {on})`"
                )));
            }
            Ok(Some(LoadKind::Moment { on: on_link, from: from_link, moment: moment.id() }))
        }
        ast::LoadKind::Gravity => {
            let acceleration = vector(scope, given, id, Kind::Acceleration)?;
            Ok(Some(LoadKind::Gravity { acceleration: acceleration.into() }))
        }
        ast::LoadKind::Thrust(ends) => {
            let ends = two_points(scope, ends)?;
            let force = scalar(scope, given, id, Kind::Force)?.id();
            Ok(ends.map(|ends| LoadKind::Thrust { ends, force }))
        }
        ast::LoadKind::Spring(ends, fields) => {
            let ends = two_points(scope, ends);
            let ([rate, free, preload], damping) = spring_values(scope, given, fields, id, sink)?;
            Ok(ends?.map(|ends| LoadKind::Spring { ends, rate, free, preload, damping }))
        }
        ast::LoadKind::Torsion { from, on, fields } => {
            let links = scope.names.find(Role::Link, from)?.zip(scope.names.find(Role::Link, on)?);
            let ([rate, free, near], damping) = spring_values(scope, given, fields, id, sink)?;
            if from.text == on.text {
                return Err(Diagnostic::new(
                    from.place().to(on.place()),
                    format!("a torsion spring on `{on}` by itself"),
                )
                .help(super::motion::between_links(scope.model, "torsion", on, "reacts it")));
            }
            let Some([from, on]) = links.map(|(from, on)| [from, on].map(LinkId::new)) else { return Ok(None) };
            let known = scope.model.driven_angle(from, on).is_some();
            if let Some(field) = fields.iter().find(|field| field.name.text == "near" && known) {
                let problem = "between these two links there is no turn to choose: the drives give their angle";
                return Err(Diagnostic::new(field.name.place(), problem).help("leave `near` out"));
            }
            let near = fields.iter().any(|field| field.name.text == "near").then_some(near);
            Ok(Some(LoadKind::Torsion { from, on, rate, free, near, damping }))
        }
        ast::LoadKind::Inertia(_) => Ok(Some(LoadKind::Inertia)),
    }
}

/// Two points between which something acts: points of two links.
pub(super) fn two_points(scope: Scope<'_>, ends: &[ast::End; 2]) -> Result<Option<[End; 2]>, Diagnostic> {
    let (Some(first), Some(second)) = (end(scope, &ends[0], None)?, end(scope, &ends[1], None)?) else {
        return Ok(None);
    };
    if first.link == second.link {
        let problem = format!("both points belong to `{}`: their distance never changes", ends[0].link);
        return Err(
            Diagnostic::new(ends[0].place().to(ends[1].place()), problem).help("name points of two different links")
        );
    }
    Ok(Some([first, second]))
}

/// Rate, free length or angle, and preload or turn of a spring; its damping if it has one.
fn spring_values(
    scope: Scope<'_>,
    given: &ast::Load,
    fields: &[ast::SpringField],
    id: LoadId,
    sink: &Sink,
) -> Result<([NodeId; 3], Option<NodeId>), Diagnostic> {
    let turns = matches!(given.kind, ast::LoadKind::Torsion { .. });
    let known: &[(&str, Kind)] = if turns {
        &[
            ("rate", Kind::TorsionStiffness),
            ("free", Kind::Angle),
            ("near", Kind::Angle),
            ("damping", Kind::TorsionDamping),
        ]
    } else {
        &[("rate", Kind::Stiffness), ("free", Kind::Length), ("preload", Kind::Force), ("damping", Kind::Damping)]
    };
    let mut values: [Option<NodeId>; 4] = [None; 4];
    for field in fields {
        let name = &field.name;
        let Some(part) = known.iter().position(|(word, _)| *word == name.text) else {
            sink.report(unknown_field(name, turns, known));
            continue;
        };
        if values[part].is_some() {
            sink.report(Diagnostic::new(name.place(), format!("`{name}` is given twice")).help("keep one of the two"));
            continue;
        }
        let value = match &field.value {
            None => Some(scope.model.graph.symbol(Symbol::Load(id, [0, 1, 2, 3][part]))),
            Some(value) => {
                let limited = match name.text.as_str() {
                    "rate" => Some(("the rate of a spring", "the rate")),
                    "damping" => Some(("a damping", "the damping")),
                    "free" if !turns => Some(("a free length", "the free length")),
                    _ => None,
                };
                let kind = known[part].1;
                sink.absorb(match limited {
                    Some((what, its)) => {
                        scope.not_negative(value, kind, what, format!("{}: {its} must not be negative", given.name))
                    }
                    None => scope.scalar(value, kind),
                })
            }
        };
        // What could not be read is reported; it is not missing.
        values[part] = Some(value.unwrap_or_else(|| scope.model.graph.one()).id());
    }
    let broken = fields.iter().any(|field| known.iter().all(|(word, _)| *word != field.name.text));
    let name = &given.name;
    let missing = |problem: String, help: &str| Err(Diagnostic::new(name.place(), problem).help(help));
    let zero = scope.model.graph.zero().id();
    match values {
        [Some(rate), Some(free), preload, damping] => Ok(([rate, free, preload.unwrap_or(zero)], damping)),
        // Nothing but a damper.
        [None, None, None, Some(damping)] => Ok(([zero; 3], Some(damping))),
        // A field that was meant to be this one has been reported.
        _ if broken => Ok(([scope.model.graph.one().id(); 3], None)),
        [None, ..] if turns => missing(format!("the torsion spring `{name}` has no rate"), "say it: `rate: 3N*m/rad`"),
        [None, ..] => missing(format!("the spring `{name}` has no rate"), "say it: `rate: 2N/mm`"),
        _ if turns => missing(
            format!("the torsion spring `{name}` has no free angle"),
            "say at which angle it is slack: `free: 20deg`",
        ),
        _ => missing(
            format!("the spring `{name}` has no free length"),
            "say how long it is when slack: `free: 60mm`; `free: 0` where its force grows in proportion to its length",
        ),
    }
}

fn unknown_field(name: &ast::Name, turns: bool, known: &[(&str, Kind)]) -> Diagnostic {
    match name.text.as_str() {
        "preload" if turns => Diagnostic::new(name.place(), "a torsion spring has no preload of its own")
            .help("let its free angle say so: it is where the moment is zero"),
        other => Diagnostic::new(name.place(), format!("a spring has no `{name}`"))
            .suggest(other, known.iter().map(|(word, _)| *word)),
    }
}

fn vector<'m>(scope: Scope<'m>, given: &ast::Load, id: LoadId, kind: Kind) -> Result<Vector<'m>, Diagnostic> {
    match &given.magnitude {
        None => {
            let part = |part| scope.model.graph.symbol(Symbol::Load(id, part));
            Ok(Vector::new(part(0), part(1)))
        }
        Some(Magnitude::Vector(vector)) => scope.vector(vector, kind),
        Some(Magnitude::Scalar(value)) => {
            Err(Diagnostic::new(value.place, format!("{} has a direction, and none is given", kind.name())).help(
                format!(
                    "write `{} @ {}` or `(x, y)`",
                    kind.example(&scope.model.units),
                    if kind == Kind::Acceleration { "-90deg" } else { "90deg" }
                ),
            ))
        }
    }
}

fn scalar<'m>(scope: Scope<'m>, given: &ast::Load, id: LoadId, kind: Kind) -> Result<Expr<'m>, Diagnostic> {
    match &given.magnitude {
        None => Ok(scope.model.graph.symbol(Symbol::Load(id, 0))),
        Some(Magnitude::Scalar(value)) => scope.scalar(value, kind),
        Some(Magnitude::Vector(vector)) if kind == Kind::Moment => {
            Err(Diagnostic::new(vector.place, "in the plane a moment is a single number")
                .help(format!("write `{}`, positive counter-clockwise", kind.example(&scope.model.units))))
        }
        Some(Magnitude::Vector(vector)) => {
            Err(Diagnostic::new(vector.place, "a thrust is a single number: its direction is that of its two points")
                .help(format!("write `{}`, positive where it pushes them apart", kind.example(&scope.model.units))))
        }
    }
}

fn said<const N: usize>(values: [(&'static str, Option<NodeId>); N]) -> Vec<(&'static str, NodeId)> {
    values.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
}

impl LoadKind {
    /// Its values, each with its name behind that of the load: none where there is only one.
    #[must_use]
    pub fn values(&self) -> Vec<(&'static str, NodeId)> {
        match *self {
            Self::Force { force: Pair { x, y }, .. } | Self::Gravity { acceleration: Pair { x, y } } => {
                vec![("x", x), ("y", y)]
            }
            Self::Moment { moment: value, .. } | Self::Thrust { force: value, .. } => vec![("", value)],
            Self::Spring { rate, free, preload, damping, .. } => {
                said([("rate", Some(rate)), ("free", Some(free)), ("preload", Some(preload)), ("damping", damping)])
            }
            Self::Torsion { rate, free, near, damping, .. } => {
                said([("rate", Some(rate)), ("free", Some(free)), ("near", near), ("damping", damping)])
            }
            Self::Inertia => Vec::new(),
        }
    }

    /// The name of the value with this number among those that are given at run time.
    #[must_use]
    pub fn value_name(&self, part: u8) -> &'static str {
        let names: &[&str] = match self {
            Self::Force { .. } | Self::Gravity { .. } => &["x", "y"],
            Self::Moment { .. } | Self::Thrust { .. } | Self::Inertia => &[],
            Self::Spring { .. } => &["rate", "free", "preload", "damping"],
            Self::Torsion { .. } => &["rate", "free", "near", "damping"],
        };
        names.get(usize::from(part)).copied().unwrap_or("")
    }

    /// Whether it depends on velocities or accelerations.
    #[must_use]
    pub fn depends_on_motion(&self) -> bool {
        match self {
            Self::Inertia => true,
            Self::Spring { damping, .. } | Self::Torsion { damping, .. } => damping.is_some(),
            Self::Force { .. } | Self::Moment { .. } | Self::Gravity { .. } | Self::Thrust { .. } => false,
        }
    }

    /// Whether it has a part for each of some links: weights, inertia.
    #[must_use]
    pub fn is_per_link(&self) -> bool {
        matches!(self, Self::Gravity { .. } | Self::Inertia)
    }

    /// The values that are given at run time.
    pub fn given(&self, model: &Model) -> impl Iterator<Item = &'static str> {
        let symbol = |id| matches!(model.graph.op(id), crate::graph::Op::Symbol(Symbol::Load(..)));
        self.values().into_iter().filter(move |(_, value)| symbol(*value)).map(|(name, _)| name)
    }

    /// Whether it is a spring: what is given of it at run time has a type of its own.
    #[must_use]
    pub fn is_spring(&self) -> bool {
        matches!(self, Self::Spring { .. } | Self::Torsion { .. })
    }

    /// Whether any of its values is given at run time.
    #[must_use]
    pub fn is_given_at_run_time(&self, model: &Model) -> bool {
        self.given(model).next().is_some()
    }
}
