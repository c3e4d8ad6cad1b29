//! Joints.

use super::evaluate::Scope;
use super::ids::{GROUND, LinkId, PointId};
use super::names::{Names, Role};
use super::units::Kind;
use super::{End, Joint, JointKind, Model};
use crate::diagnostics::{Diagnostic, Sink};
use crate::syntax::ast::{self, Ast, Item, Name};

const NOWHERE: End = End { link: GROUND, point: PointId::FIRST };

/// Joints, with both ends on points of two links.
pub(super) fn joints(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Joint(given) = item else { continue };
        let scope = Scope { model, names };
        let ends = [&given.from, &given.to].map(|e| sink.absorb(end(scope, e, Some(&given.name))).flatten());
        let kind = sink.absorb(kind(scope, given, ends));
        if let [Some(from), Some(to)] = ends {
            if from.link == to.link {
                let problem = format!("the joint `{}` joins `{}` to itself", given.name, given.from.link);
                sink.report(Diagnostic::new(given.from.place().to(given.to.place()), problem));
            }
        }
        let [from, to] = ends.map(|end| end.unwrap_or(NOWHERE));
        model.joints.push(Joint { name: given.name.clone(), from, to, kind: kind.unwrap_or(JointKind::Revolute) });
    }
}

/// A point on a link; the one of the joint's name, if none is said. `None` if the link could not be read.
pub(super) fn end(scope: Scope<'_>, end: &ast::End, joint: Option<&Name>) -> Result<Option<End>, Diagnostic> {
    let Some(link) = scope.names.find(Role::Link, &end.link)? else { return Ok(None) };
    let link = LinkId::new(link);
    let found = match (&end.point, joint) {
        (Some(point), _) => scope.point(link, point)?,
        (None, Some(joint)) => {
            let unspoken = Name { text: joint.text.clone(), span: end.link.span };
            scope.point(link, &unspoken).map_err(|error| {
                error.help(format!("add `{joint}` to `{}`, or name another point: `{}.…`", end.link, end.link))
            })?
        }
        (None, None) => {
            let problem = format!("at which point of `{}`?", end.link);
            return Err(
                Diagnostic::new(end.link.place(), problem).help(format!("write it behind the link: `{}.P`", end.link))
            );
        }
    };
    Ok(found.map(|point| End { link, point }))
}

fn kind(scope: Scope<'_>, given: &ast::Joint, ends: [Option<End>; 2]) -> Result<JointKind, Diagnostic> {
    let planned = |what: &str| Err(Diagnostic::new(given.keyword.place(), format!("{what} are not supported yet")));
    match given.keyword.text.as_str() {
        "slot" => planned("pins in slots"),
        "weld" => planned("welds"),
        "gear" => planned("gear pairs"),
        "prismatic" => prismatic(scope, given, ends),
        _ => Ok(JointKind::Revolute),
    }
}

fn prismatic(scope: Scope<'_>, given: &ast::Joint, ends: [Option<End>; 2]) -> Result<JointKind, Diagnostic> {
    let ([Some(from), Some(to)], Some(along)) = (ends, &given.along) else { return Ok(JointKind::Revolute) };
    let links = [from.link, to.link];
    let carrier = match &along.of {
        Some(name) => match scope.names.find(Role::Link, name)?.map(LinkId::new) {
            None => return Ok(JointKind::Revolute),
            Some(link) if links.contains(&link) => link,
            Some(_) => {
                let problem = format!(
                    "the line of `{}` turns with one of its own links, and `{name}` is none of them",
                    given.name
                );
                return Err(Diagnostic::new(name.place(), problem)
                    .help(format!("`of {}` or `of {}`", given.from.link, given.to.link)));
            }
        },
        None if links.contains(&GROUND) => GROUND,
        None => {
            let problem = format!("with which link does the line of `{}` turn?", given.name);
            return Err(Diagnostic::new(along.place, problem)
                .help(format!("say it: `of {}` or `of {}`", given.from.link, given.to.link))
                .note("the ground, in whose axes a direction is meant by default, is neither of the two"));
        }
    };
    let axis = scope.direction(along, carrier)?;
    let angle = match &given.angle {
        Some(value) => scope.scalar(value, Kind::Angle)?,
        None => scope.model.graph.zero(),
    };
    Ok(JointKind::Prismatic { carrier, axis: axis.into(), turn: angle.direction().into(), angle: angle.id() })
}
