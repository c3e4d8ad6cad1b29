//! Loads.

use proc_macro2::TokenTree;

use super::evaluate::Scope;
use super::ids::{GROUND, LinkId, LoadId, PointId};
use super::joints::end;
use super::names::{Names, Role, unread};
use super::units::Kind;
use super::{End, Load, LoadKind, Model};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::{Expr, Symbol, Vector};
use crate::syntax::ast::{self, Ast, Item, Magnitude};
use crate::syntax::is_constant;

/// Loads; what is given at run time becomes a symbol.
pub(super) fn loads(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    let massless = weightless(model, ast, names);
    for item in &ast.items {
        let id = LoadId::new(model.loads.len());
        if let Some((broken, name)) = unread(item, Role::Load) {
            let word = broken.words().first().map_or(String::new(), |word| word.text.clone());
            let written: Vec<TokenTree> = broken.rest.clone().into_iter().collect();
            let kind = stand_in(model, id, &word, is_constant(&word, &written));
            model.loads.push(Load { name: name.clone(), kind });
        }
        let Item::Load(given) = item else { continue };
        let kind = sink.absorb(kind(Scope { model, names }, given, id)).flatten();
        if massless && matches!(given.kind, ast::LoadKind::Gravity) {
            sink.report(without_mass(model, given));
        }
        let kind = kind.unwrap_or_else(|| {
            let (word, constant) = match &given.kind {
                ast::LoadKind::Force { .. } => ("force", given.magnitude.is_some()),
                ast::LoadKind::Moment { .. } => ("moment", given.magnitude.is_some()),
                ast::LoadKind::Gravity => ("gravity", given.magnitude.is_some()),
                ast::LoadKind::Planned(word, constant) => (word.text.as_str(), *constant),
            };
            stand_in(model, id, word, constant)
        });
        model.loads.push(Load { name: given.name.clone(), kind });
    }
}

/// A load that is refused still brings its name, its type, and whether it is given at run time.
fn stand_in(model: &Model, id: LoadId, word: &str, constant: bool) -> LoadKind {
    let part = |part| if constant { model.graph.zero() } else { model.graph.symbol(Symbol::Load(id, part)) };
    let vector = Vector::new(part(0), part(1)).into();
    match word {
        "moment" | "thrust" | "torsion" => LoadKind::Moment { on: GROUND, from: None, moment: part(0).id() },
        "gravity" => LoadKind::Gravity { acceleration: vector },
        _ => LoadKind::Force { at: End { link: GROUND, point: PointId::FIRST }, force: vector, frame: GROUND },
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
    Diagnostic::new(given.name.place(), "gravity acts on nothing: no link has a mass")
        .help(format!("give one to a link, as in `mass {link}: 0.5kg at (0, 0);`, or leave `{}` out", given.name))
}

fn kind(scope: Scope<'_>, given: &ast::Load, id: LoadId) -> Result<Option<LoadKind>, Diagnostic> {
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
            let moment = scalar(scope, given, id)?;
            let Some(on_link) = on_link else { return Ok(None) };
            if Some(on_link) == from_link {
                let place = from.as_ref().map_or(on.place(), |from| from.place().to(on.place()));
                return Err(Diagnostic::new(place, format!("`{on}` cannot exert a moment on itself")).help(format!(
                    "write `moment({on})` if it comes from outside, or name the link that reacts it: `moment(ground -> {on})`"
                )));
            }
            if on_link == GROUND && from_link.is_none() {
                return Err(Diagnostic::new(on.place(), "a moment on the ground has no effect on the linkage")
                    .help("let it act on a moving link, or leave it out"));
            }
            Ok(Some(LoadKind::Moment { on: on_link, from: from_link, moment: moment.id() }))
        }
        ast::LoadKind::Gravity => {
            let acceleration = vector(scope, given, id, Kind::Acceleration)?;
            Ok(Some(LoadKind::Gravity { acceleration: acceleration.into() }))
        }
        ast::LoadKind::Planned(word, _) => {
            let name = &given.name;
            let (what, help) = match word.text.as_str() {
                "thrust" => (
                    "a thrust between two points is",
                    format!("until then work it out, and give it as a force on each link: `load {name}1: force(…);`"),
                ),
                "spring" => (
                    "springs and dampers between points are",
                    format!("until then work their force out, and give it on each link: `load {name}1: force(…);`"),
                ),
                "torsion" => (
                    "torsion springs and dampers are",
                    format!("until then work their moment out, and give it: `load {name}: moment(ground -> crank);`"),
                ),
                _ => (
                    "inertia forces are",
                    format!(
                        "until then give each as a force at the centre of mass and a moment: `load {name}1: force(…);`"
                    ),
                ),
            };
            Err(Diagnostic::new(word.place(), format!("{what} not supported yet")).help(help))
        }
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
            Err(Diagnostic::new(value.place, format!("{} has a direction, and none is given", kind.name()))
                .help(format!("write `{} @ 90deg` or `(x, y)`", kind.example(&scope.model.units))))
        }
    }
}

fn scalar<'m>(scope: Scope<'m>, given: &ast::Load, id: LoadId) -> Result<Expr<'m>, Diagnostic> {
    match &given.magnitude {
        None => Ok(scope.model.graph.symbol(Symbol::Load(id, 0))),
        Some(Magnitude::Scalar(value)) => scope.scalar(value, Kind::Moment),
        Some(Magnitude::Vector(vector)) => {
            Err(Diagnostic::new(vector.place, "in the plane a moment is a single number")
                .help(format!("write `{}`, positive counter-clockwise", Kind::Moment.example(&scope.model.units))))
        }
    }
}

impl LoadKind {
    /// Whether any of its values is given at run time.
    #[must_use]
    pub fn is_given_at_run_time(&self, model: &Model) -> bool {
        let symbol = |id| matches!(model.graph.op(id), crate::graph::Op::Symbol(Symbol::Load(..)));
        match self {
            Self::Force { force: pair, .. } | Self::Gravity { acceleration: pair } => symbol(pair.x),
            Self::Moment { moment, .. } => symbol(*moment),
        }
    }

    /// Where a force acts.
    #[must_use]
    pub fn point(&self) -> Option<End> {
        if let Self::Force { at, .. } = self { Some(*at) } else { None }
    }
}
