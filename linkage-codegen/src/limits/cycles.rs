//! The closed chains of four bodies in a linkage: four pins, or three pins and a slide.
//!
//! Links that are welded to each other are one body. A pin in a slot is a slide and a pin, with a block between them that has no size.
//! Pins at one place of a link join the links there to each other as well, as several links on one pin do.

use std::collections::BTreeMap;

use crate::graph::{Expr, NodeId, Vector};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId};
use crate::model::{End, Joint, JointKind, Model};

/// How many hinges a chain has.
const HINGES: usize = 4;

/// What a hinge is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Pin,
    Slide,
}

/// A hinge on one of its bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'m> {
    /// The point in the body's frame: of a slide that of the line.
    pub(super) point: Vector<'m>,
    /// The direction of a slide in the body's frame.
    pub(super) axis: Vector<'m>,
    /// The direction of the x axis of the joint's own link in the body's frame.
    turn: Vector<'m>,
    /// The point of the link; the block in a slot has none.
    end: Option<End>,
}

impl<'m> Side<'m> {
    /// From a slide's line to a pin of the same body, along and across the slide.
    pub(super) fn to(self, pin: Self) -> Vector<'m> {
        (pin.point - self.point).resolved_along(self.axis)
    }
}

/// A hinge of a chain, from the body before it to the one behind it.
#[derive(Clone, Debug)]
pub(super) struct Hinge<'m> {
    pub(super) kind: Kind,
    /// The joint after which it is called.
    pub(super) joint: JointId,
    /// Of several links on one pin a second joint that stands for it.
    other: Option<JointId>,
    pub(super) drive: Option<DriveId>,
    pub(super) sides: [Side<'m>; 2],
    /// Whether the body behind it is the joint's second one.
    pub(super) forwards: bool,
}

impl<'m> Hinge<'m> {
    fn reversed(&self) -> Self {
        Self { sides: [self.sides[1], self.sides[0]], forwards: !self.forwards, ..self.clone() }
    }

    /// Whether it stands for a joint.
    pub(super) fn is(&self, joint: JointId) -> bool {
        self.joint == joint || self.other == Some(joint)
    }

    /// A vector of one of its bodies, in the frame of the joint's own link there.
    pub(super) fn in_link(&self, side: usize, vector: Vector<'m>) -> Vector<'m> {
        vector.resolved_along(self.sides[side].turn)
    }
}

/// A body of a chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Body {
    /// Links that are welded to each other.
    Links(Vec<LinkId>),
    /// The block in a slot.
    Block,
}

impl Body {
    /// Its name.
    pub(super) fn name(&self, model: &Model) -> String {
        match self {
            Self::Links(links) => model.link_names(links),
            Self::Block => "block".to_owned(),
        }
    }
}

/// A closed chain: body `i` lies between hinge `i` and the next one.
#[derive(Clone, Debug)]
pub(super) struct Chain<'m> {
    pub(super) model: &'m Model,
    pub(super) hinges: [Hinge<'m>; HINGES],
    pub(super) bodies: [Body; HINGES],
}

impl<'m> Chain<'m> {
    /// Started at another hinge.
    pub(super) fn from(mut self, hinge: usize) -> Self {
        self.hinges.rotate_left(hinge);
        self.bodies.rotate_left(hinge);
        self
    }

    /// In the other sense round, from the same hinge.
    pub(super) fn reversed(&self) -> Self {
        let hinge = |index: usize| self.hinges[(HINGES - index) % HINGES].reversed();
        let body = |index: usize| self.bodies[HINGES - 1 - index].clone();
        Self { model: self.model, hinges: [0, 1, 2, 3].map(hinge), bodies: [0, 1, 2, 3].map(body) }
    }

    /// The name of a hinge.
    pub(super) fn hinge_name(&self, hinge: usize) -> &'m str {
        &self.model.joint(self.hinges[hinge].joint).name.text
    }

    /// The name of a body.
    pub(super) fn body_name(&self, body: usize) -> String {
        self.bodies[body].name(self.model)
    }

    /// From the hinge before a body to the one behind it, in the body's frame.
    pub(super) fn arm(&self, body: usize) -> Vector<'m> {
        self.hinges[(body + 1) % HINGES].sides[0].point - self.hinges[body].sides[1].point
    }

    /// The distance of the hinges of a body: as declared, if it was declared as such.
    pub(super) fn length(&self, body: usize) -> Expr<'m> {
        let (before, behind) = (self.hinges[body].sides[1].end, self.hinges[(body + 1) % HINGES].sides[0].end);
        match (before, behind) {
            (Some(from), Some(to)) if from.link == to.link => self.model.distance(from.link, from.point, to.point),
            _ => self.arm(body).size(),
        }
    }

    /// How the distance of two hinges is written: `|A B|`.
    pub(super) fn distance_name(&self, [from, to]: [usize; 2]) -> String {
        format!("|{} {}|", self.hinge_name(from), self.hinge_name(to))
    }
}

/// The frame of a link in that of its body.
#[derive(Clone, Copy, Debug)]
struct Frame<'m> {
    origin: Vector<'m>,
    turn: Vector<'m>,
}

/// Whether the links and the points of a joint are there: in a sound declaration they are.
fn is_read(model: &Model, joint: &Joint) -> bool {
    let there = |end: End| model.links.get(end.link.index()).is_some_and(|link| end.point.index() < link.points.len());
    joint.ends().into_iter().all(there)
}

/// Links and the bodies that welds make of them, each called after its first link.
struct Bodies<'m> {
    model: &'m Model,
    of: Vec<LinkId>,
    frames: Vec<Frame<'m>>,
}

impl<'m> Bodies<'m> {
    fn new(model: &'m Model) -> Self {
        let graph = &model.graph;
        let own = Frame { origin: graph.zero_vector(), turn: Vector::new(graph.one(), graph.zero()) };
        let links: Vec<LinkId> = (0..model.links.len()).map(LinkId::new).collect();
        let mut bodies = Self { model, frames: vec![own; links.len()], of: links.clone() };
        let welds = model.joints.iter().filter(|joint| matches!(joint.kind, JointKind::Weld { .. }));
        let welds: Vec<&Joint> = welds.filter(|weld| is_read(model, weld)).collect();
        for first in links {
            let mut reached = vec![first];
            let mut next = 0;
            while let Some(at) = reached.get(next).copied().filter(|_| bodies.of[first.index()] == first) {
                next += 1;
                for weld in &welds {
                    let (Some(here), Some(there)) = (weld.end_on(at), weld.end_off(at)) else { continue };
                    if there.link == first
                        || bodies.of[there.link.index()] != there.link
                        || reached.contains(&there.link)
                    {
                        continue;
                    }
                    bodies.weld(weld, here, there);
                    bodies.of[there.link.index()] = first;
                    reached.push(there.link);
                }
            }
        }
        bodies
    }

    /// Places a link in the body of the one to which it is welded.
    fn weld(&mut self, weld: &Joint, here: End, there: End) {
        let Some((turn, _)) = weld.kind.turn() else { return };
        let turn = turn.vector(&self.model.graph);
        let turn = if weld.to == there { turn } else { turn.conjugate() };
        let turn = turn.turned_by(self.frames[here.link.index()].turn);
        let origin = self.place(here) - self.model.local(there).turned_by(turn);
        self.frames[there.link.index()] = Frame { origin, turn };
    }

    /// A point in the frame of its body.
    fn place(&self, end: End) -> Vector<'m> {
        let Frame { origin, turn } = self.frames[end.link.index()];
        self.model.local(end).turned_by(turn) + origin
    }

    /// A joint on the body of one of its ends.
    fn side(&self, joint: &Joint, end: End) -> Side<'m> {
        let graph = &self.model.graph;
        let Frame { turn, .. } = self.frames[end.link.index()];
        let x_axis = Vector::new(graph.one(), graph.zero());
        let axis = joint.kind.line().map_or(x_axis, |(carrier, axis)| {
            let axis = axis.vector(graph);
            let (Some((between, _)), false) = (joint.kind.turn(), carrier == end.link) else { return axis };
            let between = between.vector(graph);
            if joint.to == end { axis.resolved_along(between) } else { axis.turned_by(between) }
        });
        Side { point: self.place(end), axis: axis.turned_by(turn), turn, end: Some(end) }
    }

    fn links(&self, body: LinkId) -> Vec<LinkId> {
        let all = (0..self.of.len()).map(LinkId::new);
        all.filter(|link| self.of[link.index()] == body).collect()
    }
}

/// What joins two bodies.
#[derive(Clone, Copy, Debug)]
struct Edge {
    joint: JointId,
    /// Of links on one pin the other joint that they share, and where on which body they meet.
    other: Option<(JointId, (LinkId, [NodeId; 2]))>,
    ends: [End; 2],
}

impl Edge {
    /// Whether it is a pin in a slot, which is two hinges.
    fn is_slot(&self, model: &Model) -> bool {
        matches!(model.joint(self.joint).kind, JointKind::Slot { .. })
    }

    fn weight(&self, model: &Model) -> usize {
        1 + usize::from(self.is_slot(model))
    }
}

/// All pins, slides and slots, and what pins at one place make of each other.
fn edges(bodies: &Bodies<'_>) -> Vec<Edge> {
    let model = bodies.model;
    let body = |end: End| bodies.of[end.link.index()];
    let joined = |joint: JointId| {
        let data = model.joint(joint);
        let kind = matches!(data.kind, JointKind::Revolute | JointKind::Prismatic { .. } | JointKind::Slot { .. });
        (kind && is_read(model, data) && body(data.from) != body(data.to)).then_some(Edge {
            joint,
            other: None,
            ends: data.ends(),
        })
    };
    let mut all: Vec<Edge> = model.joint_ids().filter_map(joined).collect();
    let pins = all.iter().copied().filter(|edge| matches!(model.joint(edge.joint).kind, JointKind::Revolute));
    let pins: Vec<(Edge, [Vector<'_>; 2])> = pins.map(|edge| (edge, edge.ends.map(|end| bodies.place(end)))).collect();
    for (index, (first, first_places)) in pins.iter().enumerate() {
        for (second, second_places) in &pins[index + 1..] {
            for (at, to) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let [mine, its] = [first.ends[at], second.ends[to]];
                let ends = [first.ends[1 - at], second.ends[1 - to]];
                let meet = body(mine) == body(its) && first_places[at] == second_places[to];
                if meet && body(ends[0]) != body(ends[1]) {
                    let place = [first_places[at].x, first_places[at].y].map(Expr::id);
                    all.push(Edge { joint: second.joint, other: Some((first.joint, (body(mine), place))), ends });
                }
            }
        }
    }
    all
}

/// All closed chains of four hinges with at most one slide.
pub(super) fn chains(model: &Model) -> Vec<Chain<'_>> {
    let bodies = Bodies::new(model);
    let edges = edges(&bodies);
    let mut at: BTreeMap<LinkId, Vec<(usize, usize)>> = BTreeMap::new();
    for (index, edge) in edges.iter().enumerate() {
        for (side, end) in edge.ends.iter().enumerate() {
            at.entry(bodies.of[end.link.index()]).or_default().push((index, side));
        }
    }
    let mut found = Vec::new();
    for (first, edge) in edges.iter().enumerate() {
        let [start, next] = edge.ends.map(|end| bodies.of[end.link.index()]);
        let mut open = vec![(vec![(first, 0)], vec![next], edge.weight(model))];
        // A chain is found from its first joint alone, in the sense of that joint's arrow.
        while let Some((path, passed, weight)) = open.pop() {
            let Some(here) = passed.last() else { continue };
            if *here == start {
                if weight == HINGES {
                    found.extend(chain(&bodies, &edges, &path));
                }
                continue;
            }
            for (index, side) in at.get(here).into_iter().flatten().copied().filter(|(index, _)| *index > first) {
                let there = bodies.of[edges[index].ends[1 - side].link.index()];
                let weight = weight + edges[index].weight(model);
                // Two hinges of a chain at one point would be one.
                let meets = |(other, _): &(usize, usize)| {
                    let shared = [edges[*other], edges[index]].map(|edge| edge.other.map(|(_, at)| at));
                    shared[0].is_some() && shared[0] == shared[1]
                };
                if weight <= HINGES && !passed.contains(&there) && !path.iter().any(meets) {
                    let path = path.iter().copied().chain([(index, side)]).collect();
                    open.push((path, passed.iter().copied().chain([there]).collect(), weight));
                }
            }
        }
    }
    found
}

/// The chain along some joints, each with the side from which it is gone through; `None` if it slides more than once.
fn chain<'m>(bodies: &Bodies<'m>, edges: &[Edge], path: &[(usize, usize)]) -> Option<Chain<'m>> {
    let model = bodies.model;
    let (mut hinges, mut behind) = (Vec::new(), Vec::new());
    for (index, side) in path {
        let edge = edges[*index];
        let (from, to) = (edge.ends[*side], edge.ends[1 - *side]);
        let next = Body::Links(bodies.links(bodies.of[to.link.index()]));
        if edge.is_slot(model) {
            hinges.extend(slot(bodies, edge.joint, from, to));
            behind.extend([Body::Block, next]);
        } else {
            let joint = model.joint(edge.joint);
            let kind = if matches!(joint.kind, JointKind::Revolute) { Kind::Pin } else { Kind::Slide };
            // What stands for two joints has no coordinate.
            let drive = model.drives_of(edge.joint).next().filter(|_| edge.other.is_none());
            let sides = [bodies.side(joint, from), bodies.side(joint, to)];
            let other = edge.other.map(|(joint, _)| joint);
            hinges.push(Hinge { kind, joint: edge.joint, other, drive, sides, forwards: joint.to == to });
            behind.push(next);
        }
    }
    let slides = hinges.iter().filter(|hinge| hinge.kind == Kind::Slide).count();
    let (hinges, bodies) = (hinges.try_into().ok()?, behind.try_into().ok()?);
    (slides <= 1).then_some(Chain { model, hinges, bodies })
}

/// A pin in a slot: a slide on the link that has the slot, a block, and a pin on the other link.
fn slot<'m>(bodies: &Bodies<'m>, slot: JointId, from: End, to: End) -> [Hinge<'m>; 2] {
    let model = bodies.model;
    let (graph, joint) = (&model.graph, model.joint(slot));
    let x_axis = Vector::new(graph.one(), graph.zero());
    let block = Side { point: graph.zero_vector(), axis: x_axis, turn: x_axis, end: None };
    let carries = |end: End| joint.kind.line().is_some_and(|(carrier, _)| carrier == end.link);
    let hinge = |kind: Kind, sides: [Side<'m>; 2]| Hinge {
        kind,
        joint: slot,
        other: None,
        drive: model.drive_of(slot, kind == Kind::Pin),
        sides,
        forwards: joint.to == to,
    };
    let (near, far) = (bodies.side(joint, from), bodies.side(joint, to));
    let kinds = if carries(from) { [Kind::Slide, Kind::Pin] } else { [Kind::Pin, Kind::Slide] };
    [hinge(kinds[0], [near, block]), hinge(kinds[1], [block, far])]
}

/// Whether a body holds the ground.
pub(super) fn is_ground(body: &Body) -> bool {
    matches!(body, Body::Links(links) if links.contains(&GROUND))
}
