//! Drives, unknowns and closures.

use super::evaluate::Scope;
use super::ids::{DriveId, GROUND, JointId, LinkId};
use super::joints::end;
use super::loads::two_points;
use super::names::{Names, Role, unread};
use super::units::Kind;
use super::{Closure, Drive, Joint, JointKind, Model, Side, Start, Unknown, UnknownKind};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::{Expr, NodeId, Order, Symbol};
use crate::syntax::SIDES;
use crate::syntax::ast::{self, Ast, Effort, Item, Name, StartFrom};

/// Drives: each at a joint of its own.
pub(super) fn drives(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        if let Some((_, name)) = unread(item, Role::Drive) {
            let joint = JointId::new(model.joints.len());
            let [rate, acceleration] = ORDERS.map(|order| given_motion(model, order));
            model.drives.push(Drive { name: name.clone(), joint, turns: true, rate, acceleration, start: None });
        }
        let Item::Drive(given) = item else { continue };
        let joint = sink.absorb(names.find(Role::Joint, &given.joint)).flatten().map(JointId::new);
        let turns = joint.is_none_or(|joint| turns(model, given, joint, sink));
        let scope = Scope { model, names };
        let [rate, acceleration] = ORDERS.map(|order| motion(scope, given, turns, order, sink));
        // No joint, if none could be found: no other drive is on the same one.
        let joint = joint.unwrap_or(JointId::new(model.joints.len()));
        model.drives.push(Drive { name: given.name.clone(), joint, turns, rate, acceleration, start: None });
    }
}

const ORDERS: [Order; 2] = [Order::Rate, Order::Acceleration];

/// The rate or the acceleration of the next drive, given at run time.
fn given_motion(model: &Model, order: Order) -> NodeId {
    model.graph.symbol(Symbol::Driven(DriveId::new(model.drives.len()), order)).id()
}

/// The same, as it is declared or given at run time.
fn motion(scope: Scope<'_>, drive: &ast::Drive, turns: bool, order: Order, sink: &Sink) -> NodeId {
    let declared = match order {
        Order::Rate => &drive.motion.rate,
        Order::Acceleration => &drive.motion.acceleration,
    };
    let value = declared.as_ref().and_then(|value| sink.absorb(scope.scalar(value, Drive::kind_of(order, turns))));
    value.map_or_else(|| given_motion(scope.model, order), Expr::id)
}

/// Whether the coordinate of a drive is an angle.
fn turns(model: &Model, given: &ast::Drive, joint: JointId, sink: &Sink) -> bool {
    let target = model.joint(joint);
    let asked = given.coordinate.as_ref().map(|coordinate| coordinate.text.as_str());
    // Of a slot angle and travel are driven independently.
    let same = |drive: &&Drive| {
        let slot = matches!(target.kind, JointKind::Slot { .. });
        drive.joint == joint && (!slot || asked.is_some_and(|asked| drive.turns == (asked == "angle")))
    };
    if let Some(first) = model.drives.iter().find(same) {
        let problem = format!("the joint `{}` is driven by `{}` already", target.name, first.name);
        sink.report(
            Diagnostic::new(given.joint.place(), problem)
                .note("both drives would give the same coordinate")
                .help("drive another joint, or leave one of them out"),
        );
    }
    let written = |coordinate: &str| format!("drive {}: {coordinate};", given.name);
    let asked = Asked { joint: &given.joint, coordinate: given.coordinate.as_ref(), verb: "drive", written: &written };
    let (turns, error) = asked.of(target);
    error.into_iter().for_each(|error| sink.report(error));
    turns
}

/// A coordinate of a joint as it is asked for.
pub(super) struct Asked<'a> {
    /// The joint.
    pub(super) joint: &'a Name,
    /// `.angle` or `.travel`
    pub(super) coordinate: Option<&'a Name>,
    /// What is done with it.
    pub(super) verb: &'a str,
    /// How it is written rightly.
    pub(super) written: &'a dyn Fn(&str) -> String,
}

impl Asked<'_> {
    /// Whether it is an angle; with what is wrong, if the joint has no such coordinate.
    pub(super) fn of(&self, target: &Joint) -> (bool, Option<Diagnostic>) {
        let Self { joint, coordinate, .. } = self;
        let kind = target.kind.word();
        let asked = coordinate.map(|coordinate| coordinate.text.as_str());
        let place = coordinate.map_or(joint.place(), |coordinate| joint.place().to(coordinate.place()));
        let has = match target.kind {
            JointKind::Revolute => "angle",
            JointKind::Prismatic { .. } => "travel",
            JointKind::Slot { .. } => {
                let unsaid = !matches!(asked, Some("angle" | "travel"));
                let error = unsaid.then(|| {
                    let problem = format!("the slot `{}` has an angle and a travel", target.name);
                    let help = format!("say which one it is: `{}`", (self.written)(&format!("{joint}.travel")));
                    Diagnostic::new(place, problem).help(help)
                });
                return (asked == Some("angle"), error);
            }
            JointKind::Weld { .. } | JointKind::Gear(_) => {
                let problem = format!("the {} `{}` has no coordinate of its own", target.kind.noun(), target.name);
                let help = format!("{} a joint that turns or slides", self.verb);
                return (true, Some(Diagnostic::new(place, problem).help(help)));
            }
        };
        let wrong = coordinate.filter(|coordinate| coordinate.text != has).map(|coordinate| {
            let problem = format!("the {kind} joint `{}` has an {has}, and no {coordinate}", target.name);
            let problem = if has == "travel" { problem.replace(" an ", " a ") } else { problem };
            Diagnostic::new(place, problem).help(format!("write `{}`", (self.written)(&joint.text)))
        });
        (has == "angle", wrong)
    }
}

/// Unknowns: as declared, or the efforts at the driven joints.
pub(super) fn unknowns(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    let given: Vec<&ast::Unknown> =
        ast.items.iter().filter_map(|i| if let Item::Unknown(u) = i { Some(u) } else { None }).collect();
    let lost: Vec<&Name> = ast.items.iter().filter_map(|i| Some(unread(i, Role::Unknown)?.1)).collect();
    let nowhere = UnknownKind::Torque(GROUND, GROUND);
    for name in &lost {
        model.unknowns.push(Unknown { name: name.text.clone(), place: name.place(), kind: nowhere });
    }
    let lost = !lost.is_empty() || names.may_be(Role::Unknown);
    if given.is_empty() && !lost {
        for (index, drive) in model.drives.iter().enumerate() {
            let kind = UnknownKind::Drive(DriveId::new(index));
            let name = format!("effort_{}", drive.name);
            if names.entry(&name).is_some_and(|entry| entry.sound) {
                let problem =
                    format!("the effort at the drive `{}` is called `{name}`, and that name is taken", drive.name);
                sink.report(Diagnostic::new(drive.name.place(), problem).help(format!(
                    "name the effort yourself, as in `unknown {}_effort: torque(ground -> crank);`, or rename the other item",
                    drive.name
                )));
            }
            model.unknowns.push(Unknown { name, place: drive.name.place(), kind });
        }
        return;
    }
    for unknown in &given {
        let kind = sink.absorb(effort(Scope { model, names }, unknown));
        let kind = kind.unwrap_or(nowhere);
        model.unknowns.push(Unknown { name: unknown.name.text.clone(), place: unknown.place, kind });
    }
}

/// What to write in place of a torque or a torsion spring of a link on itself.
pub(super) fn between_links(model: &Model, word: &str, on: &Name, acts: &str) -> String {
    match model.moving_links().next() {
        Some(link) if on.text == "ground" => {
            format!("say on which other link it acts: `{word}(ground -> {})`", model.link(link).name)
        }
        _ => format!("say which other link {acts}: `{word}(ground -> {on})`"),
    }
}

fn effort(scope: Scope<'_>, unknown: &ast::Unknown) -> Result<UnknownKind, Diagnostic> {
    let nothing = UnknownKind::Torque(GROUND, GROUND);
    match &unknown.effort {
        Effort::Torque(from, to) => {
            let (Some(a), Some(b)) = (scope.names.find(Role::Link, from)?, scope.names.find(Role::Link, to)?) else {
                return Ok(nothing);
            };
            if a == b {
                let problem = format!("a torque on `{to}` by itself");
                return Err(Diagnostic::new(from.place().to(to.place()), problem).help(between_links(
                    scope.model,
                    "torque",
                    to,
                    "it comes from",
                )));
            }
            Ok(UnknownKind::Torque(LinkId::new(a), LinkId::new(b)))
        }
        Effort::Force(at, direction) => {
            let Some(at_end) = end(scope, at, None)? else { return Ok(nothing) };
            if at_end.link == GROUND {
                return Err(Diagnostic::new(at.place(), "a force on the ground balances nothing")
                    .help("the unknown acts on a moving link"));
            }
            let frame = match &direction.of {
                None => GROUND,
                Some(name) => match scope.names.find(Role::Link, name)? {
                    Some(link) => LinkId::new(link),
                    None => return Ok(nothing),
                },
            };
            let along = scope.direction(direction, frame)?;
            Ok(UnknownKind::Force { at: at_end, along: along.into(), frame })
        }
        Effort::Thrust(ends) => Ok(two_points(scope, ends)?.map_or(nothing, UnknownKind::Thrust)),
        Effort::Drive(drive) => {
            if let Some(joint) = scope.names.entry(&drive.text).filter(|entry| entry.role == Role::Joint)
                && let Some(own) = scope.model.drives.iter().find(|own| own.joint.index() == joint.index)
            {
                let help = format!("it is driven by `{0}`: write `effort({0})`", own.name);
                return Err(joint.instead_of(Role::Drive, drive).help(help));
            }
            let Some(id) = scope.names.find(Role::Drive, drive)?.map(DriveId::new) else { return Ok(nothing) };
            let taken = |unknown: &&Unknown| matches!(unknown.kind, UnknownKind::Drive(own) if own == id);
            if let Some(other) = scope.model.unknowns.iter().find(taken) {
                let problem = format!("the effort at the drive `{drive}` is `{}` already", other.name);
                return Err(
                    Diagnostic::new(drive.place(), problem).help("leave one of the two out, or let it act elsewhere")
                );
            }
            Ok(UnknownKind::Drive(id))
        }
    }
}

/// Closures: the words are checked here, and that the joints make a group when the groups are known.
pub(super) fn closures(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Assemble(given) = item else { continue };
        let found = closure(Scope { model, names }, given);
        let Some(Some(closure)) = sink.absorb(found) else { continue };
        // A linkage that is also driven otherwise may be assembled at one joint between others, and across a line instead of along one.
        let again = |own: &Closure| {
            let both_given = own.is_given_at_run_time() && closure.is_given_at_run_time();
            let is_same = own.of.len() == closure.of.len() && own.of.iter().all(|of| closure.of.contains(of));
            own.joint == closure.joint && (both_given || is_same)
        };
        if model.closures.iter().any(again) {
            let problem = format!("the side of `{}` is chosen already", given.joint);
            sink.report(Diagnostic::new(closure.place, problem).help("keep one of the two"));
        }
        model.closures.push(closure);
    }
}

/// Where links and drives start.
pub(super) fn starts(model: &mut Model, ast: &Ast, names: &Names, sink: &Sink) {
    for item in &ast.items {
        let Item::Start(given) = item else { continue };
        let result = match names.entry(&given.name.text).map(|entry| entry.role) {
            Some(Role::Drive) => drive_start(model, names, given),
            _ => link_start(model, names, given),
        };
        sink.absorb(result);
    }
}

fn twice(given: &ast::Start) -> Diagnostic {
    Diagnostic::new(given.place, format!("where `{}` starts is said already", given.name)).help("keep one of the two")
}

fn drive_start(model: &mut Model, names: &Names, given: &ast::Start) -> Result<(), Diagnostic> {
    let Some(index) = names.find(Role::Drive, &given.name)? else { return Ok(()) };
    let slides = !model.drives[index].turns;
    let StartFrom::Coordinate(value) = &given.from else {
        let example = if slides { "50mm" } else { "60deg" };
        return Err(Diagnostic::new(given.place, format!("`{}` is a drive: it starts at a value", given.name))
            .help(format!("as in `start {}: {example};`", given.name)));
    };
    let kind = if slides { Kind::Length } else { Kind::Angle };
    let value = Scope { model, names }.scalar(value, kind)?.id();
    if model.drives[index].start.replace((value, given.place)).is_some() {
        return Err(twice(given));
    }
    Ok(())
}

fn link_start(model: &mut Model, names: &Names, given: &ast::Start) -> Result<(), Diagnostic> {
    let Some(index) = names.find(Role::Link, &given.name)? else { return Ok(()) };
    let link = LinkId::new(index);
    if link == GROUND {
        return Err(Diagnostic::new(given.place, "the ground does not move: it starts nowhere").help("leave it out"));
    }
    let StartFrom::Pose(at, angle) = &given.from else {
        return Err(Diagnostic::new(
            given.place,
            format!("`{}` is a link: it starts at a place and an angle", given.name),
        )
        .help(format!("as in `start {}: (0, 0), angle 30deg;`", given.name)));
    };
    let scope = Scope { model, names };
    let origin = scope.vector(at, Kind::Length)?.into();
    let angle = scope.scalar(angle, Kind::Angle)?;
    let direction = angle.direction().into();
    if model.starts.iter().any(|start| start.link == link) {
        return Err(twice(given));
    }
    model.starts.push(Start { link, origin, direction, angle: angle.id(), place: given.place });
    Ok(())
}

fn closure(scope: Scope<'_>, given: &ast::Assemble) -> Result<Option<Closure>, Diagnostic> {
    let joint = |name: &Name| scope.names.find(Role::Joint, name).map(|found| found.map(JointId::new));
    let (side, wanted) = match given.side.text.as_str() {
        "left" => (Side::Left, 2),
        "right" => (Side::Right, 2),
        "ahead" => (Side::Ahead, 1),
        "behind" => (Side::Behind, 1),
        // As the joints say: of a line, or along a slide.
        "either" => (Side::Either, given.joints.len()),
        other => {
            let found = Diagnostic::new(given.side.place(), format!("there is no side `{other}`"));
            let is_swapped = SIDES.contains(&given.joint.text.as_str());
            return Err(if is_swapped {
                found.help(format!("the joint comes first: `assemble {other}: {}(…);`", given.joint))
            } else {
                found.suggest(other, SIDES)
            });
        }
    };
    if given.joints.len() != wanted {
        let side = &given.side;
        let (of, example) = if wanted == 2 { ("the line between two joints", "A -> B0") } else { ("one joint", "A") };
        return Err(Diagnostic::new(given.chosen, format!("`{side}` is a side of {of}"))
            .help(format!("as in `{side}({example})`")));
    }
    let Some(inner) = joint(&given.joint)? else { return Ok(None) };
    let mut of = Vec::new();
    for name in &given.joints {
        match joint(name)? {
            Some(outer) => of.push(outer),
            None => return Ok(None),
        }
    }
    let smooth_at = match &given.smooth {
        Some(smooth) => Some(scope.scalar(&smooth.at, Kind::Angle)?.id()),
        None => None,
    };
    let smooth_place = given.smooth.as_ref().map_or(given.place, |smooth| smooth.place);
    let (place, side_place) = (given.place, given.chosen);
    Ok(Some(Closure { joint: inner, side, of, smooth_at, place, side_place, smooth_place }))
}
