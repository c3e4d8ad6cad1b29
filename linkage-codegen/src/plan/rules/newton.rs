//! Any other group of motion: its links are placed together, by Newton's method from a starting pose.
//!
//! The unknowns are few: a direction for each link, but for links that a slide, a weld or a driven pin lets follow another one, and a
//! travel for each slide or slot that is not driven. The joints make a tree that places every link from those before it; each further joint closes a
//! loop, whose two equations say that the way round it comes back. With the directions `u` as unit vectors and `u⊥` as their changes
//! the equations are polynomials, and their Jacobian is exact without any trigonometry.

use super::RuleResult;
use crate::diagnostics::{Diagnostic, list};
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Search, SearchId, Sought, Stage, Symbol, Vector, sought_direction};
use crate::model::ids::{DriveId, JointId, LinkId};
use crate::model::{End, JointKind, Model, Start};
use crate::plan::assembly::Assembly;
use crate::plan::placement::{Orientation, Placement, Way};
use crate::topology::{Group, Input};

/// What a group's links are placed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Direction(LinkId),
    Travel(JointId),
}

/// Places the links of a group.
pub(super) fn place(assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
    let model = assembly.model();
    let graph = assembly.graph();
    let joints = || group.outer.iter().chain(&group.inner);
    if joints().any(|joint| matches!(model.joint(*joint).kind, JointKind::Gear(_))) {
        return Err(crate::plan::unsupported(model, group, "place"));
    }
    assembly.started.extend(&group.links);
    check_starts(assembly, group)?;
    let id = graph.next_search();
    // The equations, on a placement in which the unknowns are symbols.
    let mut trial = assembly.placement.clone();
    let mut places: Vec<Place> = Vec::new();
    let mut numbers = 0u8;
    let loops = lay_out(&mut trial, group, &mut |place| {
        places.push(place);
        let first = numbers;
        numbers = numbers.saturating_add(if matches!(place, Place::Direction(_)) { 2 } else { 1 });
        match place {
            Place::Direction(_) => sought_direction(graph, id, first),
            Place::Travel(_) => {
                let travel = graph.symbol(Symbol::Sought(id, first));
                Vector::new(travel, travel)
            }
        }
    });
    let residuals: Vec<Expr<'_>> = loops.iter().flat_map(|(joint, way)| closure(model, *joint, way)).collect();
    if residuals.len() != places.len() || numbers == u8::MAX {
        return Err(crate::plan::unsupported(model, group, "place"));
    }
    let scale = scale_of(model, group);
    let sought: Vec<Sought> = places.iter().map(|place| sought(model, *place, scale)).collect();
    let jacobian = residuals
        .iter()
        .map(|residual| (0..sought.len()).map(|unknown| change(*residual, id, &sought, unknown, scale)).collect())
        .collect();
    let reach = loops.iter().fold(graph.zero(), |sum, (_, way)| sum + way.length());
    let search = Search {
        name: format!("close_{}", model.link_names(&group.links).replace(" + ", "_")),
        group: model.link_names(&group.links),
        start: places.iter().flat_map(|place| start_of(assembly, group, *place)).map(Expr::id).collect(),
        sought,
        residuals: residuals.into_iter().map(Expr::id).collect(),
        jacobian,
        rounding: (graph.epsilons(1) * graph.constant(&Number::ratio(ROUNDING.0, ROUNDING.1)) * reach).id(),
        known: Vec::new(),
    };
    let links = search.group.clone();
    let found = graph.found(search);
    let open = found[0].named(
        format!("open_{}", links.replace(" + ", "_")),
        "what stays open of all loops, zero where it is no more than rounding",
    );
    let failure = || Failure::NoConvergence { group: links.clone(), gap: open.id() };
    let mut values = found.into_iter().skip(1).map(|value| value.require_at_least(graph.zero(), open, failure()));
    let mut next = || values.next().unwrap_or_else(|| graph.zero());
    lay_out(&mut assembly.placement, group, &mut |place| match place {
        Place::Direction(link) => {
            let name = &model.link(link).name.text;
            Vector::new(next(), next()).named_direction(name, &format!("direction carried by {name}"))
        }
        Place::Travel(joint) => {
            let name = &model.joint(joint).name;
            let what = model.joint(joint).kind.noun();
            let travel = next().named(format!("travel_{name}"), format!("travel of the {what} {name}"));
            Vector::new(travel, travel)
        }
    });
    Ok(())
}

/// What rounding may leave open of all loops together, in epsilons of the lengths that make them up. A search goes on while it gains, to
/// about a fifth of it; next to a singular pose, where it gains little, it may end here.
const ROUNDING: (i64, i64) = (1, 2);

/// Orients all links, each by a slide or a driven pin that leads to it, or else by a direction that is sought; and connects them. Gives
/// the joints that close loops, with the way round each from its first point to its second.
fn lay_out<'m>(
    placement: &mut Placement<'m>,
    group: &Group,
    seek: &mut dyn FnMut(Place) -> Vector<'m>,
) -> Vec<(JointId, Way<'m>)> {
    let model = placement.model;
    let joints: Vec<JointId> = group.outer.iter().chain(&group.inner).copied().collect();
    let mut open = group.links.clone();
    while let Some(first) = open.first().copied() {
        let led = joints.iter().find_map(|joint| led(placement, group, *joint, &open));
        let (link, orientation) = led.unwrap_or_else(|| {
            let axis = axis(placement, group, first);
            (first, Orientation { direction: seek(Place::Direction(first)), axis })
        });
        placement.orient(link, orientation);
        open.retain(|other| *other != link);
    }
    let mut travels: Vec<(JointId, Expr<'m>)> = Vec::new();
    let mut travel_of = |joint: JointId| {
        let along = driven(group, model, joint, false);
        let known = along.map(|drive| placement.graph().symbol(Symbol::Drive(drive)));
        let has_line = model.joint(joint).kind.line().is_some();
        has_line.then(|| known.unwrap_or_else(|| seek(Place::Travel(joint)).x))
    };
    for joint in &joints {
        if let Some(travel) = travel_of(*joint) {
            travels.push((*joint, travel));
        }
    }
    let travel_of = |joint: JointId| travels.iter().find(|(slide, _)| *slide == joint).map(|(_, travel)| *travel);
    let mut open = group.links.clone();
    let mut closing = joints;
    while let Some(index) = closing.iter().position(|joint| {
        let ends = model.joint(*joint).ends();
        ends.iter().filter(|end| open.contains(&end.link)).count() == 1
    }) {
        let joint = closing.remove(index);
        open.retain(|link| model.joint(joint).end_on(*link).is_none());
        match travel_of(joint) {
            Some(travel) => placement.set_travel(joint, travel),
            None => placement.connect(joint),
        }
    }
    let loops: Vec<(JointId, Way<'m>)> =
        closing.iter().map(|joint| (*joint, placement.round(*joint, travel_of(*joint)))).collect();
    for joint in closing {
        match travel_of(joint) {
            Some(travel) => placement.set_travel(joint, travel),
            None => placement.connect(joint),
        }
    }
    loops
}

/// A link that a joint with an oriented one orients: along a slide, by a weld, or turned by a drive.
fn led<'m>(
    placement: &Placement<'m>,
    group: &Group,
    joint: JointId,
    open: &[LinkId],
) -> Option<(LinkId, Orientation<'m>)> {
    let model = placement.model;
    let data = model.joint(joint);
    let link = match data.ends().map(|end| open.contains(&end.link)) {
        [true, false] => data.from.link,
        [false, true] => data.to.link,
        _ => return None,
    };
    if data.kind.turn().is_some() {
        return Some((link, placement.along_slide(joint, link)));
    }
    let drive = driven(group, model, joint, true)?;
    Some((link, placement.driven(joint, link, placement.graph().symbol(Symbol::Drive(drive)))))
}

/// The drive of a joint's angle, or of its travel.
fn driven(group: &Group, model: &Model, joint: JointId, turns: bool) -> Option<DriveId> {
    let own = |drive: &DriveId| model.drive(*drive).joint == joint && model.drive(*drive).turns == turns;
    group.inputs.iter().find_map(|input| match input {
        Input::Drive(drive) => Some(*drive).filter(own),
        Input::Unknown(_) => None,
    })
}

/// The direction that a link carries, in its own frame: from its first joint to its second, if that is a constant.
fn axis<'m>(placement: &Placement<'m>, group: &Group, link: LinkId) -> Vector<'m> {
    let (model, graph) = (placement.model, placement.graph());
    let x_axis = Vector::new(graph.one(), graph.zero());
    let mut ends = group.outer.iter().chain(&group.inner).filter_map(|joint| model.joint(*joint).end_on(link));
    let (Some(first), Some(second)) = (ends.next(), ends.next()) else { return x_axis };
    let length = model.distance(link, first.point, second.point);
    if length.is_zero() {
        return x_axis;
    }
    let arm = model.local(second) - model.local(first);
    let axis = Vector::new(arm.x / length, arm.y / length);
    if axis.x.value().is_some() && axis.y.value().is_some() { axis } else { x_axis }
}

/// The two equations of a loop: what is known of the way, and what turns with the unknowns.
fn closure<'m>(model: &'m Model, joint: JointId, way: &Way<'m>) -> [Expr<'m>; 2] {
    let graph = &model.graph;
    let name = &model.joint(joint).name;
    let parts: Vec<Vector<'m>> = way.segments.iter().map(|s| s.along.turned_by(s.direction)).collect();
    let is_known = |part: &&Vector<'m>| part.x.stage().max(part.y.stage()) < Stage::Iterated;
    let known = parts.iter().filter(is_known).fold(graph.zero_vector(), |sum, part| sum + *part);
    let known = known.named(&format!("loop_{name}"), &format!("the part of the loop through {name} that is known"));
    let sum = parts.iter().filter(|part| !is_known(part)).fold(known, |sum, part| sum + *part);
    let sum = sum.named(&format!("gap_{name}"), &format!("what stays open of the loop through {name}"));
    [sum.x, sum.y]
}

/// How a residual changes with an unknown: with a turn by one radian, or with a travel by its scale.
fn change(
    residual: Expr<'_>,
    id: SearchId,
    sought: &[Sought],
    unknown: usize,
    scale: Expr<'_>,
) -> crate::graph::NodeId {
    let graph = residual.graph();
    let first = sought[..unknown].iter().map(Sought::size).sum::<usize>();
    let first = u8::try_from(first).unwrap_or(u8::MAX);
    let is_direction = matches!(sought[unknown], Sought::Direction { .. });
    let scale = graph.expr(scale.id());
    let symbol = |symbol: Symbol| match symbol {
        Symbol::Sought(search, number) if search == id && number == first => {
            if is_direction {
                -graph.symbol(Symbol::Sought(id, first + 1))
            } else {
                scale
            }
        }
        Symbol::Sought(search, number) if search == id && is_direction && number == first + 1 => {
            graph.symbol(Symbol::Sought(id, first))
        }
        _ => graph.zero(),
    };
    graph.change(residual, Stage::Iterated, &symbol).id()
}

/// The length that counts like a turn of one radian: the links' lengths together.
fn scale_of<'m>(model: &'m Model, group: &Group) -> Expr<'m> {
    let graph = &model.graph;
    let length = |link: &LinkId| {
        let mut ends = group.outer.iter().chain(&group.inner).filter_map(|joint| model.joint(*joint).end_on(*link));
        ends.next().zip(ends.next()).map(|(a, b)| model.distance(*link, a.point, b.point))
    };
    let sum = group.links.iter().filter_map(length).fold(graph.zero(), |sum, length| sum + length);
    if sum.is_zero() { graph.one() } else { sum }
}

fn sought(model: &Model, place: Place, scale: Expr<'_>) -> Sought {
    match place {
        Place::Direction(link) => Sought::Direction { name: model.link(link).name.text.clone() },
        Place::Travel(joint) => {
            Sought::Travel { name: format!("travel_{}", model.joint(joint).name), scale: scale.id() }
        }
    }
}

fn declared(model: &Model, link: LinkId) -> Option<&Start> {
    model.starts.iter().find(|start| start.link == link)
}

/// An expression at the drives' start: a constant, or one of parameters.
fn at_start<'m>(model: &'m Model, of: Expr<'m>) -> Expr<'m> {
    let graph = &model.graph;
    graph.substituted(of, &|symbol| match symbol {
        Symbol::Drive(drive) => model.drive(drive).start.map(|(value, _)| graph.expr(value)),
        Symbol::Start(search, number) => Some(graph.expr(graph.start_of(search, number))),
        _ => None,
    })
}

/// Where an unknown starts.
fn start_of<'m>(assembly: &Assembly<'m>, group: &Group, place: Place) -> Vec<Expr<'m>> {
    let (model, graph, placement) = (assembly.model(), assembly.graph(), &assembly.placement);
    let frame = |link: LinkId| match declared(model, link) {
        Some(start) if group.links.contains(&link) => (start.origin.vector(graph), start.direction.vector(graph)),
        _ => (placement.origin(link), placement.frame(link)),
    };
    match place {
        Place::Direction(link) => {
            let direction = axis(placement, group, link).turned_by(frame(link).1);
            vec![at_start(model, direction.x), at_start(model, direction.y)]
        }
        Place::Travel(joint) => {
            let data = model.joint(joint);
            let Some((carrier, axis)) = data.kind.line() else { return vec![graph.zero()] };
            let at = |end: End| {
                let (origin, direction) = frame(end.link);
                origin + model.local(end).turned_by(direction)
            };
            let along = axis.vector(graph).turned_by(frame(carrier).1);
            vec![at_start(model, along.dot(at(data.to) - at(data.from)))]
        }
    }
}

/// Every link and every drive starts somewhere.
fn check_starts(assembly: &Assembly<'_>, group: &Group) -> RuleResult {
    let model = assembly.model();
    let missing: Vec<LinkId> = group.links.iter().copied().filter(|link| declared(model, *link).is_none()).collect();
    let drives = model
        .drives
        .iter()
        .filter(|drive| drive.start.is_none())
        .map(|drive| format!("start {}: {};", drive.name, if drive.turns { "0deg" } else { "0" }));
    let links = missing.iter().map(|link| format!("start {}: (0, 0), angle 0deg;", model.link(*link).name));
    let lines: Vec<String> = drives.chain(links).collect();
    if lines.is_empty() {
        return Ok(());
    }
    let names: Vec<&str> = group.links.iter().map(|link| model.link(*link).name.text.as_str()).collect();
    let problem = format!("{} are placed together, by iteration: they need a pose to start from", list(&names));
    let (place, note) = match (missing.first(), model.drives.iter().find(|drive| drive.start.is_none())) {
        (Some(link), _) => (
            model.link(*link).name.place(),
            "the place of each frame's origin, and the angle of its x axis, roughly; and the drives' coordinates there",
        ),
        (None, Some(drive)) => (drive.name.place(), "what the drives' coordinates are at that pose is part of it"),
        (None, None) => (model.name.place(), ""),
    };
    Err(Diagnostic::new(place, problem)
        .note(note)
        .help(format!("with the numbers of your linkage, write\n{}", lines.join("\n"))))
}
