//! Loads.

use super::evaluate::Scope;
use super::ids::{GROUND, LinkId, LoadId};
use super::joints::end;
use super::names::{Names, Role};
use super::units::Kind;
use super::{End, Load, LoadKind, Model};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::{Expr, Symbol, Vector};
use crate::syntax::ast::{self, Ast, Item, Magnitude};

/// Loads; what is given at run time becomes a symbol.
pub(super) fn loads(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Load(given) = item else { continue };
        let id = LoadId::new(model.loads.len());
        let kind = sink.absorb(kind(Scope { model, names }, given, id)).flatten();
        let kind = kind.unwrap_or_else(|| unread(model, id));
        model.loads.push(Load { name: given.name.clone(), kind });
    }
}

/// A load that is refused still brings its name: as a force that is given at run time.
fn unread(model: &Model, id: LoadId) -> LoadKind {
    let part = |part| model.graph.symbol(Symbol::Load(id, part));
    let force = Vector::new(part(0), part(1)).into();
    LoadKind::Force { at: End { link: GROUND, point: super::ids::PointId::FIRST }, force, frame: GROUND }
}

/// Loads that could not be read come last: no other item refers to them.
pub(super) fn broken(model: &mut Model, ast: &Ast) {
    for item in &ast.items {
        let Item::Broken(Some(broken)) = item else { continue };
        if broken.keyword.text == "load" {
            let kind = unread(model, LoadId::new(model.loads.len()));
            model.loads.push(Load { name: broken.name.clone(), kind });
        }
    }
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
                return Err(Diagnostic::new(at.place(), "a force on the ground has no effect on the linkage"));
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
                return Err(Diagnostic::new(on.place(), format!("a moment on `{on}` by itself")));
            }
            if on_link == GROUND && from_link.is_none() {
                return Err(Diagnostic::new(on.place(), "a moment on the ground has no effect on the linkage"));
            }
            Ok(Some(LoadKind::Moment { on: on_link, from: from_link, moment: moment.id() }))
        }
        ast::LoadKind::Gravity => {
            let acceleration = vector(scope, given, id, Kind::Acceleration)?;
            if scope.model.links.iter().all(|link| link.mass.is_none()) {
                return Err(Diagnostic::new(given.name.place(), "gravity acts on nothing: no link has a mass").help(
                    format!(
                        "give one to a link: `mass {}: 0.5kg at (0, 0);`, or leave `{}` out",
                        scope.model.links.get(1).map_or("crank", |l| l.name.text.as_str()),
                        given.name
                    ),
                ));
            }
            Ok(Some(LoadKind::Gravity { acceleration: acceleration.into() }))
        }
        ast::LoadKind::Planned(word) => {
            let what = match word.text.as_str() {
                "thrust" => "a thrust between two points is",
                "spring" => "springs and dampers are",
                "torsion" => "torsion springs and dampers are",
                _ => "inertia forces are",
            };
            Err(Diagnostic::new(word.place(), format!("{what} not supported yet")))
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
        Some(Magnitude::Scalar(value)) => Err(Diagnostic::new(value.place, format!("{} has a direction", kind.name()))
            .help(format!("write `{} @ 90deg` or `(x, y)`", kind.example(&scope.model.units)))),
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
