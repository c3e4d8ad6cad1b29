//! Any other group of motion: its links are placed together, by Newton's method from a starting pose.
//!
//! The unknowns are few: a direction for each link, but for links that a slide, a weld or a driven pin lets follow another one, and a
//! travel for each slide or slot that is not driven. The joints make a tree that places every link from those before it; each further joint closes a
//! loop, whose two equations say that the way round it comes back. With the directions `u` as unit vectors and `u⊥` as their changes
//! the equations are polynomials, and their Jacobian is exact without any trigonometry. Only wheels and their arms have angles, which
//! count their turns, because a gear pair is linear in them.

use core::iter;
use std::collections::BTreeSet;

use super::RuleResult;
use super::travels::{counted_between, pins_of};
use crate::diagnostics::{Diagnostic, list};
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Graph, NodeId, Search, SearchId, Sought, Stage, Symbol, Vector, sought_direction};
use crate::model::ids::{DriveId, JointId, LinkId};
use crate::model::{End, Gear, JointKind, Model, Start};
use crate::plan::assembly::{Assembly, ClosedEquation, PlacedTogether, Unknown};
use crate::plan::placement::{Orientation, Placement, Segment, Way};
use crate::plan::starts;
use crate::topology::{Group, Input};

/// What a group's links are placed by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Direction(LinkId),
    Angle(LinkId),
    /// The travel of a slide or a slot, and between which points of its links it counts.
    Run(JointId, [End; 2]),
}

/// Places the links of a group.
pub(super) fn place(assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
    let model = assembly.model();
    let graph = assembly.graph();
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
            Place::Run(..) | Place::Angle(_) => {
                let travel = graph.symbol(Symbol::Sought(id, first));
                Vector::new(travel, travel)
            }
        }
    });
    let mut equations: Vec<Equation<'_>> = loops.iter().flat_map(|(joint, way)| closure(&trial, *joint, way)).collect();
    equations.extend(gears(model, group).map(|(joint, gear)| meshing(&trial, joint, &gear)));
    if equations.len() != places.len() || numbers == u8::MAX {
        return Err(crate::plan::unsupported(model, group, "place"));
    }
    let scale = scale_of(assembly, group, &places);
    let sought: Vec<Sought> = places.iter().map(|place| sought(&trial, *place, scale)).collect();
    let jacobian = equations
        .iter()
        .map(|equation| (0..sought.len()).map(|unknown| change(equation, id, &sought, unknown).id()).collect())
        .collect();
    let reach = equations.iter().fold(graph.zero(), |sum, equation| sum + equation.size);
    let search = Search {
        name: format!("close_{}", model.link_names(&group.links).replace(" + ", "_")),
        group: model.link_names(&group.links),
        start: places.iter().flat_map(|place| start_of(assembly, group, *place)).map(Expr::id).collect(),
        sought,
        residuals: equations.iter().map(|equation| equation.residual.id()).collect(),
        jacobian,
        rounding: (graph.epsilons(1) * graph.constant(&Number::ratio(ROUNDING.0, ROUNDING.1)) * reach).id(),
        known: Vec::new(),
        changing: 0,
        drives: Vec::new(),
        reach: Vec::new(),
        given: Vec::new(),
    };
    let links = search.group.clone();
    let failure = |gap: Expr<'_>| Failure::NoConvergence { group: links.clone(), gap: gap.id() };
    let id = graph.enter(search, &|drive| {
        let turns = model.drive(drive).turns;
        let stride = graph.constant(&Number::ratio(STRIDE.0, STRIDE.1));
        (if turns { stride } else { scale * stride }).id()
    });
    close_start(model, id, &failure);
    let found = graph.found(id);
    let open = found[0].named(
        format!("open_{}", links.replace(" + ", "_")),
        "what stays open of all loops, zero where it is no more than rounding",
    );
    let mut values = found.into_iter().skip(1).map(|value| value.require_at_least(graph.zero(), open, failure(open)));
    let mut next = || values.next().unwrap_or_else(|| graph.zero());
    let mut unknowns: Vec<Unknown<'_>> = Vec::new();
    lay_out(&mut assembly.placement, group, &mut |place| match place {
        Place::Direction(link) => {
            let name = &model.link(link).name.text;
            let direction = Vector::new(next(), next()).named_direction(name, &format!("direction carried by {name}"));
            unknowns.push(Unknown::Direction(direction));
            direction
        }
        Place::Angle(link) => {
            let name = &model.link(link).name;
            let angle = next().named(format!("angle_{name}"), format!("angle of {name}, with all its turns"));
            unknowns.push(Unknown::Angle(angle));
            let angle = angle.held();
            Vector::new(angle, angle)
        }
        Place::Run(joint, between) => {
            let [from, to] = between.map(|end| model.end_name(end));
            let what = model.joint(joint).kind.noun();
            let what = format!("travel of the {what} {}, from {from} to {to}", model.joint(joint).name);
            let run = next().named(trial.name_of_run(joint, between), what);
            unknowns.push(Unknown::Travel { travel: run, scale });
            Vector::new(run, run)
        }
    });
    assembly.placed_together(|| placed_together(graph, id, unknowns, 2 * loops.len()));
    Ok(())
}

/// How a group was placed by a search, the first equations of which are those of loops.
fn placed_together<'m>(
    graph: &'m Graph,
    id: SearchId,
    unknowns: Vec<Unknown<'m>>,
    of_loops: usize,
) -> PlacedTogether<'m> {
    let search = graph.search(id);
    let numbers: Vec<Expr<'m>> = unknowns.iter().flat_map(Unknown::values).collect();
    let found = |node: &NodeId| {
        graph.substituted_from(graph.expr(*node), Stage::Iterated, &|symbol| match symbol {
            Symbol::Sought(own, number) if own == id => numbers.get(usize::from(number)).copied(),
            _ => None,
        })
    };
    let names = search.sought.iter().map(|sought| match sought {
        Sought::Direction { name } => format!("angle_{name}"),
        Sought::Travel { name, .. } => name.clone(),
    });
    let names: Vec<String> = names.collect();
    let equations = search.residuals.iter().zip(&search.jacobian).enumerate().map(|(index, (residual, changes))| {
        let name = graph.label(*residual).map_or_else(|| "gap".to_owned(), |label| label.name);
        let residual = found(residual).named(format!("open_{name}"), format!("{name} of what was found"));
        let change = |(change, unknown): (&NodeId, &String)| {
            found(change).named(format!("{name}_by_{unknown}"), format!("change of {name} with {unknown}"))
        };
        ClosedEquation {
            name: name.strip_prefix("gap_").unwrap_or(&name).to_owned(),
            residual,
            changes: changes.iter().zip(&names).map(change).collect(),
            other: (index < of_loops).then_some(index ^ 1),
        }
    });
    let equations = equations.collect();
    PlacedTogether { equations, unknowns, names }
}

/// What rounding may leave open of all loops together, in epsilons of the lengths that make them up. A search goes on while it gains, to
/// about a fifth of it; next to a singular pose, where it gains little, it may end here.
const ROUNDING: (i64, i64) = (1, 2);

/// How far a drive goes at most while nothing is looked at, so that the way is followed and not only its end: in radians, or in the lengths
/// of the links together.
const STRIDE: (i64, i64) = (1, 4);

/// The declared start is rough. The search begins where it is closed, with the drives at theirs: known now, or with the parameters.
fn close_start(model: &Model, id: SearchId, failure: &dyn Fn(Expr<'_>) -> Failure) {
    let graph = &model.graph;
    let search = graph.search(id);
    let drive = |drive: &DriveId| model.drive(*drive).start.map_or(graph.zero(), |(value, _)| graph.expr(value));
    let drives: Vec<Expr<'_>> = search.drives.iter().map(drive).collect();
    let rough = search.start.iter().map(|node| graph.expr(*node));
    let others = search.reach.iter().chain(&search.given).chain(&search.known);
    let others = others.map(|node| at_start(model, graph.expr(*node)));
    let args: Vec<Expr<'_>> = rough.chain(drives.clone()).chain(drives.clone()).chain(others).collect();
    let found = graph.search_from(id, &args);
    let names = search.sought.iter().flat_map(Sought::names);
    let open = found[0].named(format!("open_{}_start", search.name), "what stays open at the start");
    // Known now, in many digits: what is left there of a zero is smaller than a scalar may hold.
    let rounding = Number::ratio(1, 2).pow(160);
    let vanishes = |value: &Expr<'_>| value.value().is_some_and(|value| value.abs().compare(&rounding).is_lt());
    let closed = found[1..].iter().zip(names).map(|(value, name)| {
        let value = if vanishes(value) { graph.zero() } else { *value };
        let value = value.require_at_least(graph.zero(), open, failure(open));
        value.named(format!("{name}_start"), format!("{name} where the drives start"))
    });
    let start: Vec<Expr<'_>> = closed.chain(drives).collect();
    graph.set_start(id, start.into_iter().map(Expr::id).collect());
}

/// Orients all links, each by a slide or a driven pin that leads to it, or else by a direction that is sought; and connects them. Gives
/// the joints that close loops, with the way round each from its first point to its second.
fn lay_out<'m>(
    placement: &mut Placement<'m>,
    group: &Group,
    seek: &mut dyn FnMut(Place) -> Vector<'m>,
) -> Vec<(JointId, Way<'m>)> {
    let model = placement.model;
    let joints: Vec<JointId> = group.outer.iter().chain(&group.inner).copied().collect();
    let joints: Vec<JointId> =
        joints.into_iter().filter(|joint| !matches!(model.joint(*joint).kind, JointKind::Gear(_))).collect();
    let counted = counted(model, group);
    let mut open = group.links.clone();
    // Directions come before angles.
    while let Some(first) = open.iter().find(|link| !counted.contains(link)).or(open.first()).copied() {
        let led = joints.iter().find_map(|joint| led(placement, group, *joint, &open));
        let (link, orientation, angle) = led.unwrap_or_else(|| {
            if counted.contains(&first) {
                let angle = seek(Place::Angle(first)).x;
                let name = &model.link(first).name.text;
                let direction = angle.direction().named_direction(name, &format!("direction of {name}"));
                return (first, Orientation { direction, axis: x_axis(placement.graph()) }, Some(angle));
            }
            let axis = axis(placement, group, first);
            (first, Orientation { direction: seek(Place::Direction(first)), axis }, None)
        });
        placement.orient(link, orientation);
        if let Some(angle) = angle {
            placement.set_angle(link, angle);
        }
        open.retain(|other| *other != link);
    }
    for joint in joints.iter().copied().filter(|joint| model.joint(*joint).kind.line().is_some()) {
        match driven(group, model, joint, false) {
            Some(drive) => placement.know_travel(joint, placement.graph().symbol(Symbol::Drive(drive))),
            None => {
                let between = counted_between(placement, group, joint);
                placement.know_run(joint, seek(Place::Run(joint, between)).x, between);
            }
        }
    }
    let mut open = group.links.clone();
    let mut closing = joints;
    while let Some(index) = closing.iter().position(|joint| {
        let ends = model.joint(*joint).ends();
        ends.iter().filter(|end| open.contains(&end.link)).count() == 1
    }) {
        let joint = closing.remove(index);
        open.retain(|link| model.joint(joint).end_on(*link).is_none());
        placement.connect(joint);
    }
    let loops = closing.iter().map(|joint| (*joint, placement.round(*joint))).collect();
    closing.into_iter().for_each(|joint| placement.connect(joint));
    loops
}

/// A link that a joint with an oriented one orients: along a slide, by a weld, or turned by a drive.
fn led<'m>(
    placement: &Placement<'m>,
    group: &Group,
    joint: JointId,
    open: &[LinkId],
) -> Option<(LinkId, Orientation<'m>, Option<Expr<'m>>)> {
    let model = placement.model;
    let data = model.joint(joint);
    let link = match data.ends().map(|end| open.contains(&end.link)) {
        [true, false] => data.from.link,
        [false, true] => data.to.link,
        _ => return None,
    };
    if data.kind.turn().is_some() {
        let (_, turn) = data.kind.turn()?;
        let other = data.end_off(link)?.link;
        let turn = placement.graph().expr(turn);
        let angle = placement
            .unwrapped_angle(other)
            .map(|angle| if data.to.link == link { angle + turn } else { angle - turn });
        return Some((link, placement.along_slide(joint, link), angle));
    }
    let drive = driven(group, model, joint, true)?;
    let turn = placement.graph().symbol(Symbol::Drive(drive));
    let other = data.end_off(link)?.link;
    let angle =
        placement.unwrapped_angle(other).map(|angle| if data.to.link == link { angle + turn } else { angle - turn });
    Some((link, placement.driven(joint, link, turn), angle))
}

fn x_axis(graph: &Graph) -> Vector<'_> {
    Vector::new(graph.one(), graph.zero())
}

/// The gear pairs of a group.
fn gears<'m>(model: &'m Model, group: &'m Group) -> impl Iterator<Item = (JointId, Gear)> {
    group.outer.iter().chain(&group.inner).filter_map(|joint| match model.joint(*joint).kind {
        JointKind::Gear(gear) => Some((*joint, gear)),
        _ => None,
    })
}

/// The links of which an angle is sought, and not a direction: wheels, their arms, and what leads these or is led by them.
fn counted(model: &Model, group: &Group) -> BTreeSet<LinkId> {
    let of = |(joint, gear): (JointId, Gear)| {
        let [a, b] = model.joint(joint).ends().map(|end| end.link);
        [a, b, gear.arm[0].link]
    };
    let mut counted: BTreeSet<LinkId> = gears(model, group).flat_map(of).collect();
    let leads =
        |joint: &JointId| model.joint(*joint).kind.turn().is_some() || driven(group, model, *joint, true).is_some();
    let leading: Vec<JointId> = group.outer.iter().chain(&group.inner).copied().filter(leads).collect();
    loop {
        let before = counted.len();
        for joint in &leading {
            let ends = model.joint(*joint).ends().map(|end| end.link);
            if ends.iter().any(|link| counted.contains(link)) {
                counted.extend(ends.into_iter().filter(|link| group.links.contains(link)));
            }
        }
        if counted.len() == before {
            return counted;
        }
    }
}

/// The drive of a joint's angle, or of its travel.
fn driven(group: &Group, model: &Model, joint: JointId, turns: bool) -> Option<DriveId> {
    let own = |drive: &DriveId| model.drive(*drive).joint == joint && model.drive(*drive).turns == turns;
    group.inputs.iter().find_map(|input| match input {
        Input::Drive(drive) => Some(*drive).filter(own),
        Input::Unknown(_) => None,
    })
}

/// The direction that a link carries, in its own frame: from its first pin to its second, or else along its slide, if that is a constant.
fn axis<'m>(placement: &Placement<'m>, group: &Group, link: LinkId) -> Vector<'m> {
    let (model, x_axis) = (placement.model, x_axis(placement.graph()));
    let [Some(first), Some(second)] = pins_of(model, group, link) else {
        return line_of(model, group, link).map(|(_, line)| line).filter(|line| line.is_constant()).unwrap_or(x_axis);
    };
    let length = model.distance(link, first.point, second.point);
    if length.is_zero() {
        return x_axis;
    }
    let arm = model.local(second) - model.local(first);
    let axis = Vector::new(arm.x / length, arm.y / length);
    if axis.is_constant() { axis } else { x_axis }
}

/// The first line of a link at a joint of the group: a point of it, and its direction in the link's frame.
fn line_of<'m>(model: &'m Model, group: &Group, link: LinkId) -> Option<(End, Vector<'m>)> {
    let mut joints = group.outer.iter().chain(&group.inner);
    let joint = joints.find(|joint| model.joint(**joint).is_line_on(link))?;
    Some((model.joint(*joint).end_on(link)?, Placement::of_ground(model).slide_axis(*joint, link)))
}

/// What is zero where the group is closed.
struct Equation<'m> {
    residual: Expr<'m>,
    /// What turns with the unknowns, each part as a whole with one direction; and which component of it is meant.
    parts: Vec<(Vector<'m>, Vector<'m>)>,
    component: fn(Vector<'m>) -> Expr<'m>,
    /// The lengths that make it up: of its rounding, in epsilons.
    size: Expr<'m>,
}

/// The two equations of a loop: what is known of the way, and what turns with the unknowns.
fn closure<'m>(placement: &Placement<'m>, joint: JointId, way: &Way<'m>) -> [Equation<'m>; 2] {
    let (model, graph) = (placement.model, placement.graph());
    let name = &model.joint(joint).name;
    let (mut known, mut parts, mut size) = (graph.zero_vector(), Vec::new(), graph.zero());
    for segment in &way.segments {
        let part = segment.along().turned_by(segment.direction);
        size = size + rounded_size(segment);
        if part.x.stage().max(part.y.stage()) < Stage::Iterated {
            known = known + part;
            continue;
        }
        let carrier = model.moving_links().find(|link| placement.direction(*link) == segment.direction);
        let part = match carrier {
            Some(link) => {
                let link_name = &model.link(link).name;
                let what = format!("what {link_name} contributes to the loop through {name}");
                // A direction of a large angle is as uncertain as the angle.
                if let Some(angle) = placement.unwrapped_angle(link).filter(|angle| angle.stage() == Stage::Iterated) {
                    size = size + segment.size() * angle.abs();
                }
                part.named(&format!("{link_name}_to_{name}"), &what)
            }
            None => part,
        };
        parts.push((segment.direction, part));
    }
    let known = known.named(&format!("loop_{name}"), &format!("the part of the loop through {name} that is known"));
    let sum = parts.iter().fold(known, |sum, (_, part)| sum + *part);
    let sum = sum.named(&format!("gap_{name}"), &format!("what stays open of the loop through {name}"));
    // Half of the size each: it is that of both.
    let half = graph.constant(&Number::ratio(1, 2));
    let of = |residual, component: fn(Vector<'m>) -> Expr<'m>| Equation {
        residual,
        parts: parts.clone(),
        component,
        size: half * size,
    };
    [of(sum.x, |vector| vector.x), of(sum.y, |vector| vector.y)]
}

/// The length of a part of a way, as much of it as is rounded: more where it is turned by two components instead of one.
fn rounded_size<'m>(segment: &Segment<'m>) -> Expr<'m> {
    let Vector { x, y } = segment.along();
    let half = x.graph().constant(&Number::ratio(1, 2));
    if x.is_zero() || y.is_zero() { segment.size() } else { segment.size() + half * (x.abs() + y.abs()) }
}

/// The equation of a gear pair: linear in angles, which count their turns.
fn meshing<'m>(placement: &Placement<'m>, joint: JointId, gear: &Gear) -> Equation<'m> {
    let (model, graph) = (placement.model, placement.graph());
    let name = &model.joint(joint).name;
    let [first, second] = gear.radii.map(|radius| graph.expr(radius));
    let [a, b] = model.joint(joint).ends().map(|end| end.link);
    let centres = gear.centres(model);
    let within = graph.atan2(centres.y, centres.x);
    let both = first + second;
    let rolled =
        [(first, a), (second, b), (-both, gear.arm[0].link)].map(|(radius, link)| radius * placement.angle(link));
    let constant = graph.expr(gear.phase) + both * within;
    let (moving, known): (Vec<Expr<'m>>, Vec<Expr<'m>>) =
        rolled.into_iter().partition(|part| part.stage() == Stage::Iterated);
    let known = known.iter().fold(-constant, |sum, part| sum + *part);
    let known = known.named(format!("loop_{name}"), format!("the part of what rolls at {name} that is known"));
    let residual = moving.iter().fold(known, |sum, part| sum + *part);
    let residual = residual.named(format!("gap_{name}"), format!("what is not rolled at {name}"));
    let size = rolled.iter().fold(constant.abs(), |sum, part| sum + part.abs());
    Equation { residual, parts: Vec::new(), component: |vector| vector.x, size }
}

/// How an equation changes with an unknown: with a turn by one radian, or with a travel by its scale.
fn change<'m>(equation: &Equation<'m>, id: SearchId, sought: &[Sought], unknown: usize) -> Expr<'m> {
    let graph = equation.residual.graph();
    let first = sought[..unknown].iter().map(Sought::size).sum::<usize>();
    let first = u8::try_from(first).unwrap_or(u8::MAX);
    let rate = |by: Symbol, rate: Expr<'m>| move |symbol: Symbol| if symbol == by { rate } else { graph.zero() };
    let own = Symbol::Sought(id, first);
    match &sought[unknown] {
        // What is carried turns as a whole.
        Sought::Direction { .. } => {
            let turns = |direction: &Vector<'m>| {
                let depends = |part: Expr<'m>| graph.depends_on(part, own);
                depends(direction.x) || depends(direction.y)
            };
            let parts = equation.parts.iter().filter(|(direction, _)| turns(direction));
            parts.fold(graph.zero(), |sum, (_, part)| sum + (equation.component)(part.perp()))
        }
        Sought::Travel { scale, .. } => {
            graph.change(equation.residual, Stage::Iterated, &rate(own, graph.expr(*scale)))
        }
    }
}

/// The length that counts like a turn of one radian: of all links together how far apart their joints are, lines taken as a whole. Where
/// that says nothing of one, because a slide goes through its only pin or it has only slides, those distances on the links around the group
/// count as well; in want of any, how far the slides are out at the start.
fn scale_of<'m>(assembly: &Assembly<'m>, group: &Group, places: &[Place]) -> Expr<'m> {
    let (model, graph) = (assembly.model(), assembly.graph());
    let total = |lengths: Vec<Expr<'m>>| lengths.into_iter().fold(graph.zero(), |sum, length| sum + length);
    let between_pins = |link: LinkId| match pins_of(model, group, link) {
        [Some(a), Some(b)] => model.distance(link, a.point, b.point),
        _ => graph.zero(),
    };
    let length = |link: LinkId| match (pins_of(model, group, link), line_of(model, group, link)) {
        ([Some(pin), None], Some((point, line))) => (model.local(pin) - model.local(point)).cross(line).abs(),
        _ => between_pins(link),
    };
    let own: Vec<Expr<'m>> = group.links.iter().map(|link| length(*link)).collect();
    if own.iter().all(|length| !length.is_zero()) {
        return total(own);
    }
    let around = group.outer.iter().flat_map(|joint| model.joint(*joint).ends()).map(|end| end.link);
    let around: BTreeSet<LinkId> = around.filter(|link| !group.links.contains(link)).collect();
    let sum = total(own) + total(around.into_iter().map(between_pins).collect());
    let slides = places.iter().filter(|place| matches!(place, Place::Run(..)));
    let out = || total(slides.flat_map(|place| start_of(assembly, group, *place)).map(Expr::abs).collect());
    [sum].into_iter().chain(iter::once_with(out)).find(|sum| !sum.is_zero()).unwrap_or(graph.one())
}

fn sought(placement: &Placement<'_>, place: Place, scale: Expr<'_>) -> Sought {
    let model = placement.model;
    match place {
        Place::Direction(link) => Sought::Direction { name: model.link(link).name.text.clone() },
        Place::Angle(link) => {
            Sought::Travel { name: format!("angle_{}", model.link(link).name), scale: model.graph.one().id() }
        }
        Place::Run(joint, between) => Sought::Travel { name: placement.name_of_run(joint, between), scale: scale.id() },
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
        Place::Angle(link) => {
            vec![declared(model, link).map_or(graph.zero(), |start| at_start(model, graph.expr(start.angle)))]
        }
        Place::Run(joint, between) => {
            let Some((carrier, axis)) = model.joint(joint).kind.line() else { return vec![graph.zero()] };
            let [from, to] = between.map(|end| {
                let (origin, direction) = frame(end.link);
                origin + model.local(end).turned_by(direction)
            });
            let along = axis.vector(graph).turned_by(frame(carrier).1);
            vec![at_start(model, along.dot(to - from))]
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
    let placed = |link: LinkId| {
        let placement = &assembly.placement;
        let frame = |origin: Vector<'_>, angle: Expr<'_>| [origin.x.id(), origin.y.id(), angle.id()];
        placement.is_placed(link).then(|| frame(placement.origin(link), placement.angle(link)))
    };
    let closing = starts::Wanted { model, group: &group.links, placed: &placed }.starts();
    let is_missing = |item: &starts::Item| match item {
        starts::Item::Drive(drive) => model.drive(*drive).start.is_none(),
        starts::Item::Link(link) => missing.contains(link),
    };
    let closing = closing.map(|items| items.into_iter().filter(|(item, _)| is_missing(item)).map(|(_, line)| line));
    let help = match closing {
        Some(closing) => {
            let closing: Vec<String> = closing.collect();
            format!("they close, among other poses, with\n{}", closing.join("\n"))
        }
        None => format!("with the numbers of your linkage, write\n{}", lines.join("\n")),
    };
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
    Err(Diagnostic::new(place, problem).note(note).help(help))
}
