//! From where the travels of slides and slots count: the points by which lines are declared may be far from where anything is.

use crate::graph::Expr;
use crate::model::ids::{JointId, LinkId, PointId};
use crate::model::{End, Model};
use crate::plan::assembly::Assembly;
use crate::plan::placement::Placement;
use crate::topology::Group;

/// Between what the travel of a slide or a slot is counted while it is sought: a pin near it on either link, if there is one and its distance
/// along the line is a constant, or else the joint's own point. A pin in a slot is a place of its link; all other points of these joints may
/// be declared anywhere on the line, far from where anything is.
pub(super) fn counted_between(placement: &Placement<'_>, group: &Group, joint: JointId) -> [End; 2] {
    placement.model.joint(joint).ends().map(|own| {
        let pin = near(placement, joint, own, pin_near(placement, group, own));
        if pin == own { near_if_far(placement, joint, own, any_place(placement.model, joint, own)) } else { pin }
    })
}

/// Lets the travel of a slide or a slot that is found in a formula count from where it is placed to be zero, and gives how far its second point
/// is from its first there.
///
/// As a rule its own points are near enough, and near where things are. Where they are far beyond all lengths, what goes over the slide later
/// would have the rounding of the distance: then another place on the link serves instead.
pub(super) fn count<'m>(assembly: &mut Assembly<'m>, group: &Group, joint: JointId) -> Expr<'m> {
    let (model, placement) = (assembly.model(), &assembly.placement);
    let between = model.joint(joint).ends().map(|own| {
        let place = pin_near(placement, group, own).or_else(|| any_place(model, joint, own));
        near_if_far(placement, joint, own, place)
    });
    assembly.placement.count_between(joint, between);
    assembly.placement.datum(joint, between)
}

/// A pin of the link in the stead of a slide's own point on its line, if its distance along that is a constant.
fn near(placement: &Placement<'_>, joint: JointId, own: End, pin: Option<End>) -> End {
    let is_constant = |pin: &End| placement.along_line(joint, own, *pin).value().is_some();
    pin.filter(|_| placement.model.joint(joint).is_line_on(own.link)).filter(is_constant).unwrap_or(own)
}

/// Such a place only where the slide's own point is far away from it.
fn near_if_far(placement: &Placement<'_>, joint: JointId, own: End, place: Option<End>) -> End {
    let place = near(placement, joint, own, place);
    if is_far(placement.model, placement.along_line(joint, own, place)) { place } else { own }
}

/// What is more than this times as long as anything is far away. So much may be lost before: a bit.
const FAR: i64 = 2;

/// Whether a constant distance is far beyond all lengths that are constants, too.
fn is_far<'m>(model: &'m Model, distance: Expr<'m>) -> bool {
    let beyond = lengths(model).into_iter().filter_map(|length| (distance.abs() - FAR * length).sign());
    let beyond: Vec<i8> = beyond.collect();
    !beyond.is_empty() && beyond.into_iter().all(|sign| sign == 1)
}

/// The distances between points of a link, and of these from lines on it; without the points by which lines are declared.
fn lengths(model: &Model) -> Vec<Expr<'_>> {
    let axes = Placement::of_ground(model);
    let mut lengths = Vec::new();
    for link in (0..model.links.len()).map(LinkId::new) {
        let of_lines: Vec<(JointId, End)> = lines_on(model, link).collect();
        let points: Vec<End> = places_on(model, link).collect();
        for (index, from) in points.iter().enumerate() {
            let way = |to: End| model.local(to) - model.local(*from);
            lengths.extend(points[index + 1..].iter().map(|to| way(*to).size()));
            lengths.extend(of_lines.iter().map(|(joint, to)| way(*to).cross(axes.slide_axis(*joint, link)).abs()));
        }
    }
    lengths
}

/// The lines on a link, each with the point by which it was declared there.
fn lines_on(model: &Model, link: LinkId) -> impl Iterator<Item = (JointId, End)> {
    let lines = model.joint_ids().filter(move |joint| model.joint(*joint).is_line_on(link));
    lines.filter_map(move |joint| Some((joint, model.joint(joint).end_on(link)?)))
}

/// The points of a link but for those by which only lines were declared.
fn places_on(model: &Model, link: LinkId) -> impl Iterator<Item = End> {
    let points = (0..model.link(link).points.len()).map(move |index| End { link, point: PointId::new(index) });
    points.filter(move |at| {
        let is_pin = |joint: JointId| model.joint(joint).pin_on(link) == Some(*at);
        model.joint_ids().any(is_pin) || lines_on(model, link).all(|(_, end)| end != *at)
    })
}

/// The first pin that a group has on a link of its own or around it, or else that by which loops of the group go on from the link.
fn pin_near(placement: &Placement<'_>, group: &Group, own: End) -> Option<End> {
    let model = placement.model;
    let is_around = |end: &End| !group.links.contains(&end.link);
    let [near, _] = pins_of(model, group, own.link);
    near.or_else(|| {
        let around = group.outer.iter().flat_map(|joint| model.joint(*joint).ends()).filter(is_around);
        let ways = around.filter(|end| is_around(&own) && end.link != own.link).map(|end| placement.route(own, end));
        ways.filter_map(|way| way.first().copied()).find_map(|joint| model.joint(joint).pin_on(own.link))
    })
}

/// A place on a link of a slide or a slot where things are: its first pin; or the point of a line along which it is driven, which is as far away
/// as the argument says; or a point that no line was declared by; or that of another line, if it is near where the two cross.
fn any_place(model: &Model, joint: JointId, own: End) -> Option<End> {
    let link = own.link;
    let pin = model.joint_ids().find_map(|joint| model.joint(joint).pin_on(link));
    let driven = || lines_on(model, link).find(|(joint, _)| model.drive_of(*joint, false).is_some());
    let crossing = || {
        let axes = Placement::of_ground(model);
        let axis = |joint: JointId| axes.slide_axis(joint, link);
        lines_on(model, link).find(|(other, end)| {
            let sine = axis(*other).cross(axis(joint));
            let ahead = (model.local(*end) - model.local(own)).cross(axis(joint));
            *other != joint && sine.sign().is_some_and(|sign| sign != 0) && !is_far(model, ahead / sine)
        })
    };
    let point_of = |(_, end): (JointId, End)| end;
    pin.or_else(|| driven().map(point_of))
        .or_else(|| places_on(model, link).next())
        .or_else(|| crossing().map(point_of))
}

/// The first two points of a link at joints of the group, but for those that may lie anywhere on a line.
pub(super) fn pins_of(model: &Model, group: &Group, link: LinkId) -> [Option<End>; 2] {
    let mut pins = group.outer.iter().chain(&group.inner).filter_map(|joint| model.joint(*joint).pin_on(link));
    [pins.next(), pins.next()]
}
