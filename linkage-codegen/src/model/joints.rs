//! Joints.

mod gears;

use super::evaluate::Scope;
use super::ids::{GROUND, LinkId, PointId};
use super::names::{Names, Role, unread};
use super::units::Kind;
use super::{End, Joint, JointKind, Link, Model, Pair};
use crate::diagnostics::{Diagnostic, Sink, closest, list};
use crate::graph::NodeId;
use crate::syntax::JOINTS;
use crate::syntax::ast::{self, Ast, Item, Name};

pub(super) const NOWHERE: End = End { link: GROUND, point: PointId::FIRST };

/// Joints, with both ends on points of two links.
pub(super) fn joints(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        if let Some((broken, name)) = unread(item, Role::Joint) {
            let word = JOINTS.into_iter().find(|word| broken.is(word));
            let kind = stand_in(model, word.unwrap_or_default());
            model.joints.push(Joint { name: name.clone(), from: NOWHERE, to: NOWHERE, kind });
        }
        let Item::Joint(given) = item else { continue };
        let scope = Scope { model, names };
        let ends = match without_points(scope, given) {
            None => [&given.from, &given.to].map(|e| sink.absorb(end(scope, e, Some(&given.name))).flatten()),
            Some(error) => {
                sink.report(error);
                [None; 2]
            }
        };
        let kind = sink.absorb(kind(scope, given, ends));
        let kind = kind.unwrap_or_else(|| stand_in(model, &given.keyword.text));
        if let [Some(from), Some(to)] = ends
            && from.link == to.link
        {
            let problem = format!("the joint `{}` joins `{}` to itself", given.name, given.from.link);
            sink.report(
                Diagnostic::new(given.from.place().to(given.to.place()), problem)
                    .help("a joint stands between two links: name the other one"),
            );
        }
        let [from, to] = ends.map(|end| end.unwrap_or(NOWHERE));
        model.joints.push(Joint { name: given.name.clone(), from, to, kind });
    }
    gears::arms(model, ast, sink);
}

/// The kind of a joint of which only this is known.
fn stand_in(model: &Model, word: &str) -> JointKind {
    let (along, angle) = (model.graph.zero().direction().into(), model.graph.zero().id());
    match word {
        "prismatic" => JointKind::Prismatic { carrier: GROUND, axis: along, turn: along, angle },
        "weld" => JointKind::Weld { turn: along, angle },
        "slot" => JointKind::Slot { carrier: GROUND, axis: along },
        "gear" => gears::stand_in(model),
        _ => JointKind::Revolute,
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
            scope.point(link, &unspoken).map_err(|_| without_point(scope.model, link, end, joint))?
        }
        (None, None) => {
            let points = scope.model.links.get(link.index()).map_or(&[][..], |link| &link.points);
            let points: Vec<String> = points.iter().map(|point| format!("{}.{}", end.link, point.name)).collect();
            let points: Vec<&str> = points.iter().map(String::as_str).collect();
            let help = match points.as_slice() {
                [] => match scope.model.links.get(link.index()) {
                    Some(body) if !body.unread => {
                        format!("{}, and write `{}.P` here", body.with_point("one", "P"), end.link)
                    }
                    _ => format!("write it behind the link: `{}.P`", end.link),
                },
                [one] => format!("write `{one}`"),
                several => format!("choose from {}", list(several)),
            };
            return Err(Diagnostic::new(end.link.place(), format!("at which point of `{}`?", end.link)).help(help));
        }
    };
    Ok(found.map(|point| End { link, point }))
}

/// A joint's name is no point of either link: that is one mistake.
fn without_points(scope: Scope<'_>, given: &ast::Joint) -> Option<Diagnostic> {
    let name = &given.name;
    let body = |end: &ast::End| {
        let link = scope.names.find(Role::Link, &end.link).ok().flatten()?;
        let body = scope.model.links.get(link).filter(|body| !body.unread && end.point.is_none())?;
        body.points.iter().all(|point| point.name.text != name.text).then_some(body)
    };
    let (from, to) = (body(&given.from)?, body(&given.to)?);
    let has = |body: &Link, name: &Name| body.points.iter().any(|point| point.name.text == name.text);
    let both = from.points.iter().find(|point| has(to, &point.name));
    let [one, other] = [both.or(from.points.first())?, both.or(to.points.first())?];
    let problem = format!("neither `{}` nor `{}` has a point `{name}` for the joint `{name}`", from.name, to.name);
    Some(Diagnostic::new(name.place(), problem).help(format!(
        "give both links that point, or say which other ones they are: `{}.{} -> {}.{}`",
        from.name, one.name, to.name, other.name
    )))
}

/// A joint's name is no point of its link.
fn without_point(model: &Model, link: LinkId, end: &ast::End, joint: &Name) -> Diagnostic {
    let body = model.link(link);
    let names = body.points.iter().map(|point| point.name.text.as_str());
    let problem = format!("the link `{}` has no point `{joint}` for the joint `{joint}`", end.link);
    Diagnostic::new(end.link.place(), problem).help(
        match closest(&joint.text, names.clone()).or_else(|| names.clone().next()) {
            Some(other) => format!("give the link that point, or say which other one it is: `{}.{other}`", end.link),
            None => body.with_point("that one", &joint.text),
        },
    )
}

fn kind(scope: Scope<'_>, given: &ast::Joint, ends: [Option<End>; 2]) -> Result<JointKind, Diagnostic> {
    match given.keyword.text.as_str() {
        "prismatic" => {
            let (carrier, axis) = line(scope, given, ends)?;
            let (turn, angle) = turn(scope, given)?;
            Ok(JointKind::Prismatic { carrier, axis, turn, angle })
        }
        "weld" => {
            let (turn, angle) = turn(scope, given)?;
            Ok(JointKind::Weld { turn, angle })
        }
        "slot" => {
            let (carrier, axis) = line(scope, given, ends)?;
            Ok(JointKind::Slot { carrier, axis })
        }
        "gear" => gears::gear(scope, given, ends),
        _ => Ok(JointKind::Revolute),
    }
}

/// The fixed angle between the links, zero if it is not said.
fn turn(scope: Scope<'_>, given: &ast::Joint) -> Result<(Pair, NodeId), Diagnostic> {
    let angle = match &given.angle {
        Some(value) => scope.scalar(value, Kind::Angle)?,
        None => scope.model.graph.zero(),
    };
    Ok((angle.direction().into(), angle.id()))
}

/// The line of a slide or a slot, and the link that carries it.
fn line(scope: Scope<'_>, given: &ast::Joint, ends: [Option<End>; 2]) -> Result<(LinkId, Pair), Diagnostic> {
    let unread = || (GROUND, scope.model.graph.zero().direction().into());
    let ([Some(from), Some(to)], Some(along)) = (ends, &given.along) else { return Ok(unread()) };
    let links = [from.link, to.link];
    let carrier = match &along.of {
        Some(name) => match scope.names.find(Role::Link, name)?.map(LinkId::new) {
            None => return Ok(unread()),
            Some(link) if links.contains(&link) => link,
            Some(_) => {
                let problem =
                    format!("the line of `{}` belongs to one of its two links, and `{name}` is neither", given.name);
                return Err(Diagnostic::new(name.place(), problem)
                    .help(format!("write `of {}` or `of {}`", given.from.link, given.to.link)));
            }
        },
        None if links.contains(&GROUND) => GROUND,
        None => {
            let problem = format!("both links of `{}` move: with which of them does its line turn?", given.name);
            return Err(Diagnostic::new(along.place, problem)
                .help(format!("write `of {}` or `of {}` behind the direction", given.from.link, given.to.link)));
        }
    };
    Ok((carrier, scope.direction(along, carrier)?.into()))
}
