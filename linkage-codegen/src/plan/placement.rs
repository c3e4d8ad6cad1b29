//! Where the links are: what the groups solved so far have placed.
//!
//! A link is placed by a direction, a unit vector, never by an angle. Places are not kept as coordinates of the plane: the way from a
//! point to another goes through the links between them, so that nothing depends on where the origin is.

use core::ops::Neg;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::graph::number::Number;
use crate::graph::{Expr, Graph, Symbol, Vector};
use crate::model::ids::{GROUND, JointId, LinkId, PointId};
use crate::model::{End, Gear, Joint, JointKind, Model, PLACE, Wanted};

/// The direction that a link carries.
#[derive(Clone, Copy, Debug)]
pub struct Orientation<'m> {
    /// The carried direction, in ground axes.
    pub direction: Vector<'m>,
    /// The same in the link's own frame: a constant, or a parameter.
    pub axis: Vector<'m>,
}

/// A place on a link: one of its points, or where a pin is in a slot that the link carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// The link, and its point or that of its slot.
    pub end: End,
    /// The slot in which the pin is.
    pub slot: Option<JointId>,
}

impl From<End> for Spot {
    fn from(end: End) -> Self {
        Self { end, slot: None }
    }
}

impl Spot {
    /// The place of a pin, which may be one in a slot, on one of its links.
    #[must_use]
    pub fn of_pin(model: &Model, joint: JointId, link: LinkId) -> Option<Self> {
        let data = model.joint(joint);
        let carried = matches!(data.kind, JointKind::Slot { carrier, .. } if carrier == link);
        Some(Self { end: data.end_on(link)?, slot: carried.then_some(joint) })
    }
}

/// A part of the way from a point to another: a vector that turns with a link.
#[derive(Clone, Copy, Debug)]
pub struct Segment<'m> {
    /// The direction with which it turns.
    pub direction: Vector<'m>,
    /// What of its components along and across that direction varies.
    varying: Vector<'m>,
    /// What of them is constant: one sum, which is exact.
    constant: Vector<'m>,
    /// The lengths of the parts that vary.
    rest: Expr<'m>,
    /// Whether what varies is several parts: their directions in the link may vary too, so that their lengths do not tell that of their sum.
    is_bent: bool,
}

impl<'m> Segment<'m> {
    /// A part of this length.
    fn new(direction: Vector<'m>, along: Vector<'m>, size: Expr<'m>) -> Self {
        let graph = size.graph();
        if along.is_constant() {
            Self { direction, varying: graph.zero_vector(), constant: along, rest: graph.zero(), is_bent: false }
        } else {
            Self { direction, varying: along, constant: graph.zero_vector(), rest: size, is_bent: false }
        }
    }

    /// Its components along and across its direction.
    #[must_use]
    pub fn along(&self) -> Vector<'m> {
        self.varying + self.constant
    }

    /// Its components along and across a direction: constant if it turns with the link that carries the line.
    #[must_use]
    pub fn resolved_along(&self, line: &Line<'m>) -> Vector<'m> {
        if self.direction == line.carrier {
            self.along().resolved_along(line.axis)
        } else {
            self.along().turned_by(self.direction.resolved_along(line.direction))
        }
    }

    /// Its length, or the lengths together of which it is made up.
    #[must_use]
    pub fn size(&self) -> Expr<'m> {
        self.constant.size() + self.rest
    }

    /// The least that its length can be: of several parts that vary, or one beside a constant one, nothing is known.
    fn least(&self) -> Expr<'m> {
        match (self.rest.is_zero(), self.constant.is_zero() && !self.is_bent) {
            (true, _) => self.constant.size(),
            (false, true) => self.rest,
            (false, false) => self.rest.graph().zero(),
        }
    }
}

/// The direction of a line that a link carries.
#[derive(Clone, Copy, Debug)]
pub struct Line<'m> {
    /// In ground axes.
    pub direction: Vector<'m>,
    /// The direction of the link.
    carrier: Vector<'m>,
    /// Along and across that.
    axis: Vector<'m>,
}

impl<'m> From<Vector<'m>> for Line<'m> {
    fn from(direction: Vector<'m>) -> Self {
        let graph = direction.x.graph();
        Self { direction, carrier: direction, axis: Vector::new(graph.one(), graph.zero()) }
    }
}

/// The way from a point to another.
#[derive(Clone, Debug)]
pub struct Way<'m> {
    /// Its parts.
    pub segments: Vec<Segment<'m>>,
    graph: &'m Graph,
}

impl<'m> Way<'m> {
    /// The vector from its start to its end.
    #[must_use]
    pub fn vector(&self) -> Vector<'m> {
        let parts = self.segments.iter().map(|s| s.along().turned_by(s.direction));
        parts.reduce(|sum, part| sum + part).unwrap_or_else(|| self.graph.zero_vector())
    }

    /// Its components along and across a direction: each part by itself, so that constant parts fold exactly.
    #[must_use]
    pub fn resolved_along(&self, line: impl Into<Line<'m>>) -> Vector<'m> {
        let line = line.into();
        let parts = self.segments.iter().map(|segment| segment.resolved_along(&line));
        parts.reduce(|sum, part| sum + part).unwrap_or_else(|| self.graph.zero_vector())
    }

    /// Goes on along the x axis.
    pub fn go_on(&mut self, distance: Expr<'m>) {
        let x_axis = Vector::new(self.graph.one(), self.graph.zero());
        push_segment(&mut self.segments, Segment::new(x_axis, x_axis.scaled(distance), distance.abs()));
    }

    /// The sum of the lengths of its parts: the size of the rounding in its vector, in epsilons.
    #[must_use]
    pub fn length(&self) -> Expr<'m> {
        self.segments.iter().fold(self.graph.zero(), |sum, s| sum + s.size())
    }

    /// The least and the largest distance that its parts can make up, whatever their directions are; nothing if a length is not constant.
    fn reach(&self) -> Option<[Expr<'m>; 2]> {
        let sizes = self.segments.iter().map(|part| Some([part.least().value()?, part.size().value()?]));
        let sizes: Vec<[Number; 2]> = sizes.collect::<Option<_>>()?;
        let most = sizes.iter().fold(Number::zero(), |sum, [_, size]| sum.add(size));
        // One part is longer than the others together.
        let beyond = |[least, size]: &[Number; 2]| least.sub(&most.sub(size));
        let larger = |one: Number, other: Number| if other.compare(&one).is_gt() { other } else { one };
        let least = sizes.iter().map(beyond).fold(Number::zero(), larger);
        Some([least, most].map(|distance| self.graph.constant(&distance)))
    }

    /// Whether its ends are known to be farther apart than this, by more than rounding makes of the difference where numbers of a further size
    /// are added up.
    #[must_use]
    pub fn exceeds(&self, distance: Expr<'m>, further: Expr<'m>) -> bool {
        self.reach().is_some_and(|[least, _]| (least - distance).exceeds_rounding_of(distance + further))
    }

    /// Whether they are known to be nearer to each other than this, in the same way.
    #[must_use]
    pub fn falls_short_of(&self, distance: Expr<'m>, further: Expr<'m>) -> bool {
        self.reach().is_some_and(|[_, most]| (distance - most).exceeds_rounding_of(distance + further))
    }
}

/// The travel of a slide or a slot, from the joint's first point to its second one along its direction.
#[derive(Clone, Copy, Debug)]
struct Travel<'m> {
    /// What was found.
    found: Expr<'m>,
    /// What the declared points add to it, a constant: they may lie far away, where a sum of both has no digits left of what was found.
    datum: Expr<'m>,
    /// Both together.
    whole: Expr<'m>,
    /// From where to where the former counts.
    between: [End; 2],
}

impl Neg for Travel<'_> {
    type Output = Self;

    fn neg(self) -> Self {
        Self { found: -self.found, datum: -self.datum, whole: -self.whole, ..self }
    }
}

/// What is placed so far.
#[derive(Clone, Debug)]
pub struct Placement<'m> {
    /// The linkage.
    pub model: &'m Model,
    orientations: Vec<Option<Orientation<'m>>>,
    rough: BTreeMap<LinkId, Vector<'m>>,
    travels: BTreeMap<JointId, Travel<'m>>,
    angles: BTreeMap<LinkId, Expr<'m>>,
    arms: BTreeMap<[JointId; 2], Expr<'m>>,
    lengths: BTreeMap<LinkId, Expr<'m>>,
    /// On each link, the joints through which ways may go.
    placed: Vec<BTreeSet<JointId>>,
}

impl<'m> Placement<'m> {
    /// Only the ground.
    #[must_use]
    pub fn of_ground(model: &'m Model) -> Self {
        let x_axis = Vector::new(model.graph.one(), model.graph.zero());
        let mut orientations = vec![None; model.links.len()];
        orientations[GROUND.index()] = Some(Orientation { direction: x_axis, axis: x_axis });
        let angles = BTreeMap::from([(GROUND, model.graph.zero())]);
        Self {
            model,
            orientations,
            rough: BTreeMap::new(),
            travels: BTreeMap::new(),
            angles,
            arms: BTreeMap::new(),
            lengths: BTreeMap::new(),
            placed: vec![BTreeSet::new(); model.links.len()],
        }
    }

    /// All expressions.
    #[must_use]
    pub fn graph(&self) -> &'m Graph {
        &self.model.graph
    }

    /// A link is a leg of this length, over which the moments on it are taken.
    pub fn set_length(&mut self, link: LinkId, length: Expr<'m>) {
        self.lengths.insert(link, length);
    }

    /// The length over which the moments on a link are taken where its dyad is balanced: one if it is no leg between pins.
    #[must_use]
    pub fn length(&self, link: LinkId) -> Expr<'m> {
        self.lengths.get(&link).copied().unwrap_or_else(|| self.graph().one())
    }

    /// Places a link. A pose keeps its direction.
    pub fn orient(&mut self, link: LinkId, orientation: Orientation<'m>) {
        let direction = orientation.direction.held();
        self.orientations[link.index()] = Some(Orientation { direction, ..orientation });
    }

    /// Places a link that a slide or a weld joins to a placed one.
    pub fn orient_along(&mut self, joint: JointId, link: LinkId) {
        let Orientation { direction, axis } = self.along_slide(joint, link);
        let direction = match self.model.drive_of(joint, true) {
            Some(drive) => {
                let (name, drive) = (&self.model.link(link).name, &self.model.drive(drive).name);
                direction.named_direction(&name.text, &format!("direction of {name}, from {drive}"))
            }
            None => direction,
        };
        self.orient(link, Orientation { direction, axis });
    }

    /// Places a link for as long as lengths are worked out: no pose keeps it.
    pub fn suppose(&mut self, link: LinkId, orientation: Orientation<'m>) {
        self.orientations[link.index()] = Some(orientation);
    }

    /// From here on, ways may go through this joint.
    pub fn connect(&mut self, joint: JointId) {
        for end in self.model.joint(joint).ends() {
            self.placed[end.link.index()].insert(joint);
        }
    }

    /// The joints of a link through which ways may go.
    fn placed_on(&self, link: LinkId) -> impl Iterator<Item = (JointId, &'m Joint)> {
        self.placed[link.index()].iter().map(|joint| (*joint, self.model.joint(*joint)))
    }

    /// Lets the travel of a slide or a slot count from where these points of its links lie beside each other; until it is found, it is zero.
    pub fn count_between(&mut self, joint: JointId, between: [End; 2]) {
        let (found, datum) = (self.graph().zero(), self.datum(joint, between));
        self.travels.insert(joint, Travel { found, datum, whole: datum, between });
    }

    /// How the travel of a slide or a slot is called, as it counts.
    #[must_use]
    pub fn name_of_travel(&self, joint: JointId) -> String {
        self.name_of_run(joint, self.counts_between(joint))
    }

    /// How it is called if it counts between these points: `travel_S` if they are as good as its own, else `run_S`.
    #[must_use]
    pub fn name_of_run(&self, joint: JointId, between: [End; 2]) -> String {
        let what = if self.datum(joint, between).is_zero() { "travel" } else { "run" };
        format!("{what}_{}", self.model.joint(joint).name)
    }

    /// The point of one of its links from which it counts.
    #[must_use]
    pub fn counted_from(&self, joint: JointId, link: LinkId) -> End {
        let [from, to] = self.counts_between(joint);
        if to.link == link { to } else { from }
    }

    fn counts_between(&self, joint: JointId) -> [End; 2] {
        self.travel_in_parts(joint).between
    }

    /// The travel of a slide, or of the pin in a slot, as it counts, is known. A pose keeps it.
    pub fn set_travel(&mut self, joint: JointId, travel: Expr<'m>) {
        self.know_run(joint, travel, self.counts_between(joint));
        self.connect(joint);
    }

    /// That of one through which no ways go yet, between its own points.
    pub fn know_travel(&mut self, joint: JointId, travel: Expr<'m>) {
        self.know_run(joint, travel, self.model.joint(joint).ends());
    }

    /// The same of one that is counted between other points of its links.
    pub fn know_run(&mut self, joint: JointId, run: Expr<'m>, between: [End; 2]) {
        let (found, datum, name) = (run.held(), self.datum(joint, between), &self.model.joint(joint).name);
        let whole = if datum.is_zero() {
            found
        } else {
            let [from, to] = self.model.joint(joint).ends().map(|end| self.model.end_name(end));
            (found + datum).named(format!("travel_{name}"), format!("travel of {name}, from {from} to {to}")).held()
        };
        self.travels.insert(joint, Travel { found, datum, whole, between });
    }

    /// The travel of a slide or a slot: of its second point from its first, along its direction. Where it is not known yet, zero.
    #[must_use]
    pub fn travel(&self, joint: JointId) -> Expr<'m> {
        self.travel_in_parts(joint).whole
    }

    fn travel_in_parts(&self, joint: JointId) -> Travel<'m> {
        let driven = || self.model.drive_of(joint, false).map(|drive| self.graph().symbol(Symbol::Drive(drive)));
        self.travels.get(&joint).copied().unwrap_or_else(|| {
            let whole = driven().unwrap_or_else(|| self.graph().zero());
            let between = self.model.joint(joint).ends();
            Travel { found: whole, datum: self.graph().zero(), whole, between }
        })
    }

    /// How far the second point of a slide or a slot is from its first one, along its direction, where these points of its links lie beside
    /// each other.
    #[must_use]
    pub fn datum(&self, joint: JointId, [near_from, near_to]: [End; 2]) -> Expr<'m> {
        let [from, to] = self.model.joint(joint).ends();
        self.along_line(joint, from, near_from) - self.along_line(joint, to, near_to)
    }

    /// How far a point of a link of a slide or a slot is ahead of another one, along the line.
    #[must_use]
    pub fn along_line(&self, joint: JointId, from: End, to: End) -> Expr<'m> {
        self.slide_axis(joint, from.link).dot(self.model.local(to) - self.model.local(from))
    }

    /// The angle of a joint's second link from its first, if it is fixed, or driven in a slot: as a direction and as an angle.
    #[must_use]
    pub fn turn(&self, joint: JointId) -> Option<(Vector<'m>, Expr<'m>)> {
        let data = self.model.joint(joint);
        if let Some((direction, angle)) = data.kind.turn() {
            return Some((direction.vector(self.graph()), self.graph().expr(angle)));
        }
        let angle = self.driven_turn(joint)?;
        Some((angle.direction(), angle))
    }

    /// The angle between the links of a slot, if a drive gives it.
    fn driven_turn(&self, slot: JointId) -> Option<Expr<'m>> {
        let is_slot = matches!(self.model.joint(slot).kind, JointKind::Slot { .. });
        let drive = self.model.drive_of(slot, true).filter(|_| is_slot)?;
        Some(self.graph().symbol(Symbol::Drive(drive)))
    }

    /// All slides and slots with their travels.
    pub fn travels(&self) -> impl Iterator<Item = (JointId, Expr<'m>)> {
        self.travels.iter().map(|(joint, travel)| (*joint, travel.whole))
    }

    /// Those slides and slots of which the travel was not counted between their own points, with what was found, and between which it counts.
    pub fn runs(&self) -> impl Iterator<Item = (JointId, Expr<'m>, [End; 2])> {
        let apart = self.travels.iter().filter(|(_, travel)| !travel.datum.is_zero());
        apart.map(|(joint, travel)| (*joint, travel.found, travel.between))
    }

    /// The lever arm of a slot's normal about a pin of the same link is known, zero where it is no larger than its rounding: made of
    /// what a pose keeps.
    pub fn set_arm(&mut self, slot: JointId, pin: JointId, arm: Expr<'m>) {
        self.arms.insert([slot, pin], arm);
    }

    /// The lever arm of a slot's normal about a pin of the same link, if its position told it.
    #[must_use]
    pub fn arm(&self, slot: JointId, pin: JointId) -> Option<Expr<'m>> {
        self.arms.get(&[slot, pin]).copied()
    }

    /// All slots with the lever arms of their normals about pins.
    pub fn arms(&self) -> impl Iterator<Item = (JointId, Expr<'m>)> {
        self.arms.iter().map(|([slot, _], arm)| (*slot, *arm))
    }

    /// Whether a link is placed.
    #[must_use]
    pub fn is_placed(&self, link: LinkId) -> bool {
        self.orientations[link.index()].is_some()
    }

    /// The direction of a link. A link whose group is not solved yet has that of the ground; no rule asks for it.
    #[must_use]
    pub fn orientation(&self, link: LinkId) -> Orientation<'m> {
        let x_axis = Vector::new(self.graph().one(), self.graph().zero());
        self.orientations[link.index()].unwrap_or(Orientation { direction: x_axis, axis: x_axis })
    }

    /// The carried direction of a link.
    #[must_use]
    pub fn direction(&self, link: LinkId) -> Vector<'m> {
        self.orientation(link).direction
    }

    /// The direction that a link carries is known before it is brought to unit size, but for a few roundings of its size. No pose keeps that:
    /// what reads it has another way there ([`Expr::or_from_pose`]).
    pub fn know_rough(&mut self, link: LinkId, direction: Vector<'m>) {
        self.rough.insert(link, direction);
    }

    /// The direction that a link carries as it is known first: for a product with what was known before, where its size counts once. In a scene
    /// with bounds of errors that of unit size: rounding is counted of what a pose keeps.
    #[must_use]
    pub fn rough_direction(&self, link: LinkId) -> Vector<'m> {
        let counts = |scene: usize| self.model.scenes[scene].results.contains(&Wanted::ErrorBound);
        let rough = self.rough.get(&link).filter(|_| !self.graph().scene().is_some_and(counts));
        rough.copied().unwrap_or_else(|| self.direction(link))
    }

    /// A vector of a link's frame, along and across the direction that the link carries.
    #[must_use]
    pub fn carried(&self, link: LinkId, local: Vector<'m>) -> Vector<'m> {
        let axis = self.orientation(link).axis;
        let x_axis = Vector::new(self.graph().one(), self.graph().zero());
        if local == axis {
            x_axis
        } else if local == -axis {
            -x_axis
        } else {
            local.resolved_along(axis)
        }
    }

    /// A place on a link, along and across the direction that the link carries.
    #[must_use]
    pub fn point(&self, at: impl Into<Spot>) -> Vector<'m> {
        let Spot { end, slot } = at.into();
        match slot {
            Some(slot) => self.slide_point(slot, end.link),
            None => self.carried(end.link, self.model.local(end)),
        }
    }

    /// What a place on a link, along and across the direction that it carries, is called: by the point that is there.
    #[must_use]
    pub fn name_of_place(&self, link: LinkId, place: Vector<'m>) -> String {
        let points = (0..self.model.link(link).points.len()).map(|point| End { link, point: PointId::new(point) });
        let found = points.into_iter().find(|point| self.point(*point) == place);
        found.map_or_else(|| PLACE.to_owned(), |point| self.model.point_name(point).to_owned())
    }

    /// A vector of a link's frame in ground axes.
    #[must_use]
    pub fn turned(&self, link: LinkId, local: Vector<'m>) -> Vector<'m> {
        self.carried(link, local).turned_by(self.direction(link))
    }

    /// The direction of the x axis of a link's frame.
    #[must_use]
    pub fn frame(&self, link: LinkId) -> Vector<'m> {
        let Orientation { direction, axis } = self.orientation(link);
        axis.conjugate().turned_by(direction)
    }

    /// The direction along which a slide or a slot goes, in ground axes.
    #[must_use]
    pub fn slide_direction(&self, joint: JointId) -> Vector<'m> {
        let line = self.model.joint(joint).kind.line();
        line.map_or(self.direction(GROUND), |(carrier, axis)| self.turned(carrier, axis.vector(self.graph())))
    }

    /// The same with what is known of it on the link that carries it.
    #[must_use]
    pub fn line(&self, joint: JointId) -> Line<'m> {
        Line {
            direction: self.slide_direction(joint),
            carrier: self.carrier_direction(joint),
            axis: self.slide_along(joint),
        }
    }

    /// The direction from the centre of a gear pair's first wheel to that of the second, in ground axes.
    #[must_use]
    pub fn centre_line(&self, gear: &Gear) -> Vector<'m> {
        self.turned(gear.arm[0].link, gear.centres(self.model))
    }

    /// The direction of a slide along and across the direction that its carrier has; of a slide both links carry the same.
    #[must_use]
    pub fn slide_along(&self, joint: JointId) -> Vector<'m> {
        let line = self.model.joint(joint).kind.line();
        line.map_or(self.direction(GROUND), |(carrier, axis)| self.carried(carrier, axis.vector(self.graph())))
    }

    /// The same along and across the direction of one of its links.
    #[must_use]
    pub fn slide_along_on(&self, joint: JointId, link: LinkId) -> Vector<'m> {
        match self.driven_turn(joint) {
            Some(_) => self.carried(link, self.slide_axis(joint, link)),
            None => self.slide_along(joint),
        }
    }

    /// The place of a joint on one of its links, along and across that link's direction: of a slide that on its line where its travel counts
    /// from on the link that runs along it, of a slot its pin, of a gear pair the wheel's centre.
    #[must_use]
    pub fn slide_point(&self, joint: JointId, link: LinkId) -> Vector<'m> {
        let data = self.model.joint(joint);
        let own = data.end_on(link).unwrap_or(data.to);
        let Some((carrier, _)) = data.kind.line() else { return self.point(own) };
        let along = self.slide_along_on(joint, link);
        let place = self.point(own) + along.scaled(self.ahead_of_own(joint, own));
        if carrier == link { place + along.scaled(self.travel_on(joint, link).found) } else { place }
    }

    /// How far a place of a link is ahead of that of a slide on it, along the slide.
    #[must_use]
    pub fn ahead_of_slide(&self, slide: JointId, link: LinkId, at: Vector<'m>) -> Expr<'m> {
        let data = self.model.joint(slide);
        let own = data.end_on(link).unwrap_or(data.to);
        let ahead_of_own = (at - self.point(own)).dot(self.slide_along_on(slide, link));
        let ahead = ahead_of_own - self.ahead_of_own(slide, own);
        let carries = data.kind.line().is_some_and(|(carrier, _)| carrier == link);
        if carries { ahead - self.travel_on(slide, link).found } else { ahead }
    }

    /// How far the place of a slide is ahead of its runner, the point by which it was declared: a constant.
    #[must_use]
    pub fn ahead_of_runner(&self, slide: JointId) -> Expr<'m> {
        self.ahead_of_own(slide, self.model.joint(slide).place())
    }

    /// How far the point of a link from which the travel of a slide or a slot counts is ahead of that by which it was declared there, along the
    /// line: a constant, as a rule zero.
    #[must_use]
    pub fn ahead_of_own(&self, joint: JointId, own: End) -> Expr<'m> {
        self.along_line(joint, own, self.counted_from(joint, own.link))
    }

    /// How far the other link's point is ahead of that of the link that carries the line.
    fn travel_on(&self, joint: JointId, carrier: LinkId) -> Travel<'m> {
        let travel = self.travel_in_parts(joint);
        if self.model.joint(joint).from.link == carrier { travel } else { -travel }
    }

    /// The place of a point in ground axes.
    #[must_use]
    pub fn place(&self, end: End) -> Vector<'m> {
        let on_ground = self.placed_on(GROUND).find_map(|(_, joint)| joint.end_on(GROUND));
        match on_ground {
            Some(start) if end.link != GROUND => {
                let mut way = self.way(start, end);
                let ground = self.direction(GROUND);
                let start = Segment::new(ground, self.model.local(start), self.graph().zero());
                let mut segments = vec![start];
                way.segments.drain(..).for_each(|segment| push_segment(&mut segments, segment));
                Way { segments, ..way }.vector()
            }
            _ => self.model.local(end),
        }
    }

    /// The place of a joint in ground axes: of a gear pair the point where the wheels touch.
    #[must_use]
    pub fn joint_place(&self, joint: JointId) -> Vector<'m> {
        let data = self.model.joint(joint);
        let place = self.place(data.place());
        let JointKind::Gear(gear) = data.kind else { return place };
        let [_, radius] = gear.rolling_radii(self.model);
        place - self.centre_line(&gear).scaled(radius)
    }

    /// The angle of a link is known, with all its turns.
    pub fn set_angle(&mut self, link: LinkId, angle: Expr<'m>) {
        self.angles.insert(link, angle);
    }

    /// All links of which the angle with all its turns is known by itself.
    pub fn angles(&self) -> impl Iterator<Item = (LinkId, Expr<'m>)> {
        self.angles.iter().map(|(link, angle)| (*link, *angle))
    }

    /// The angle of a link with all its turns, if it follows from the drives alone: that of a driven link or a wheel, or of a link that
    /// does not turn against one.
    #[must_use]
    pub fn unwrapped_angle(&self, link: LinkId) -> Option<Expr<'m>> {
        let mut reached = BTreeMap::from([(link, self.graph().zero())]);
        let mut open = VecDeque::from([link]);
        while let Some(at) = open.pop_front() {
            let ahead = reached[&at];
            if let Some(angle) = self.angles.get(&at) {
                return Some(*angle + ahead);
            }
            for (id, joint) in self.placed_on(at) {
                let (Some((_, turn)), Some(far)) = (self.turn(id), joint.end_off(at)) else { continue };
                let turn = if joint.to.link == at { turn } else { -turn };
                reached.entry(far.link).or_insert_with(|| {
                    open.push_back(far.link);
                    ahead + turn
                });
            }
        }
        None
    }

    /// The angle of a link: with all its turns if it follows from the drives alone, of others that of the direction of its frame.
    #[must_use]
    pub fn angle(&self, link: LinkId) -> Expr<'m> {
        self.unwrapped_angle(link).unwrap_or_else(|| {
            let frame = self.frame(link);
            self.graph().atan2(frame.y, frame.x)
        })
    }

    /// The origin of a link's frame in ground axes.
    #[must_use]
    pub fn origin(&self, link: LinkId) -> Vector<'m> {
        let point = End { link, point: crate::model::ids::PointId::FIRST };
        if link == GROUND || self.model.link(link).points.is_empty() {
            return self.graph().zero_vector();
        }
        self.place(point) - self.turned(link, self.model.local(point))
    }

    /// The orientation of a link that a slide or a weld joins to a placed one: they turn together, or in a slot by a driven angle.
    #[must_use]
    pub fn along_slide(&self, joint: JointId, link: LinkId) -> Orientation<'m> {
        if let Some(angle) = self.driven_turn(joint) {
            return self.driven(joint, link, angle);
        }
        let Some((turn, _)) = self.turn(joint) else { return self.orientation(link) };
        let joint = self.model.joint(joint);
        let other = if joint.from.link == link { joint.to.link } else { joint.from.link };
        let Orientation { direction, axis } = self.orientation(other);
        // The second link's frame is turned by `turn` against the first one's.
        let axis = if joint.to.link == link { axis.resolved_along(turn) } else { axis.turned_by(turn) };
        Orientation { direction, axis }
    }

    /// The orientation of a link that a driven angle turns against a placed one.
    #[must_use]
    pub fn driven(&self, joint: JointId, link: LinkId, coordinate: Expr<'m>) -> Orientation<'m> {
        let data = self.model.joint(joint);
        let turned = coordinate.direction();
        let (turned, other) =
            if data.to.link == link { (turned, data.from.link) } else { (turned.conjugate(), data.to.link) };
        let x_axis = Vector::new(self.graph().one(), self.graph().zero());
        Orientation { direction: turned.turned_by(self.frame(other)), axis: x_axis }
    }

    /// The direction of a slide or a slot in the frame of a link that it is constant in, of which the carrier is one.
    #[must_use]
    pub fn slide_axis(&self, joint: JointId, link: LinkId) -> Vector<'m> {
        let data = self.model.joint(joint);
        match (data.kind.line(), self.turn(joint)) {
            (Some((carrier, axis)), _) if carrier == link => axis.vector(self.graph()),
            (Some((_, axis)), Some((turn, _))) if data.to.link == link => {
                axis.vector(self.graph()).resolved_along(turn)
            }
            (Some((_, axis)), Some((turn, _))) => axis.vector(self.graph()).turned_by(turn),
            _ => Vector::new(self.graph().one(), self.graph().zero()),
        }
    }

    /// The direction of a slide along and across that of another; a constant where both turn with the same link.
    #[must_use]
    pub fn between(&self, [first, second]: [JointId; 2]) -> Vector<'m> {
        if self.carrier_direction(first) == self.carrier_direction(second) {
            return self.slide_along(second).resolved_along(self.slide_along(first));
        }
        self.slide_direction(second).resolved_along(self.slide_direction(first))
    }

    fn carrier_direction(&self, slide: JointId) -> Vector<'m> {
        self.direction(self.model.joint(slide).kind.line().map_or(GROUND, |(carrier, _)| carrier))
    }

    /// The orientation of a link of a slide whose direction is known: both links carry it, but for a slot's link that a drive turns.
    #[must_use]
    pub fn sliding(&self, joint: JointId, link: LinkId, direction: Vector<'m>) -> Orientation<'m> {
        let axis = self.slide_axis(joint, link);
        let carrier = self.model.joint(joint).kind.line().map(|(carrier, _)| carrier);
        if self.driven_turn(joint).is_none() || carrier == Some(link) {
            return Orientation { direction, axis };
        }
        let name = &self.model.link(link).name;
        let turned = axis.conjugate().turned_by(direction);
        let turned = turned.named_direction(&name.text, &format!("direction of {name}, from that of its slot"));
        Orientation { direction: turned, axis: Vector::new(self.graph().one(), self.graph().zero()) }
    }

    /// The shortest way between two places on placed links.
    #[must_use]
    pub fn way(&self, from: impl Into<Spot>, to: impl Into<Spot>) -> Way<'m> {
        let (from, to) = (from.into(), to.into());
        let mut segments: Vec<Segment<'m>> = Vec::new();
        let mut at = from.end;
        if let Some(slot) = from.slot {
            self.push_slid(&mut segments, slot, -self.travel_on(slot, at.link));
        }
        let (to, to_slot) = (to.end, to.slot);
        for joint in self.route(from.end, to) {
            let joint_data = self.model.joint(joint);
            let (Some(near), Some(far)) = (joint_data.end_on(at.link), joint_data.end_off(at.link)) else { continue };
            push_segment(&mut segments, self.within(at, near));
            if joint_data.kind.line().is_some() {
                let travel = self.travel_in_parts(joint);
                let signed = if joint_data.from == near { travel } else { -travel };
                self.push_slid(&mut segments, joint, signed);
            }
            at = far;
        }
        if at.link == to.link {
            push_segment(&mut segments, self.within(at, to));
        } else {
            // A group between has an error: nothing is known of the way.
            let (along, size) = (self.model.unread_vector(), self.model.unread());
            push_segment(&mut segments, Segment::new(self.direction(GROUND), along, size));
        }
        if let Some(slot) = to_slot {
            self.push_slid(&mut segments, slot, self.travel_on(slot, to.link));
        }
        segments.retain(|s| !s.along().is_zero());
        Way { segments, graph: self.graph() }
    }

    /// The way from the first point of a joint to its second that does not go through it; less its travel, if it is a slide: nothing
    /// stays of it where the joint is closed.
    #[must_use]
    pub fn round(&self, joint: JointId) -> Way<'m> {
        let data = self.model.joint(joint);
        let mut way = self.way(data.from, data.to);
        if self.travels.contains_key(&joint) {
            self.push_slid(&mut way.segments, joint, -self.travel_in_parts(joint));
        }
        way
    }

    /// From a point to another of the same link.
    fn within(&self, from: End, to: End) -> Segment<'m> {
        let along = self.point(to) - self.point(from);
        Segment::new(self.direction(from.link), along, self.model.distance(from.link, from.point, to.point))
    }

    /// Adds a part along a slide or a slot.
    fn push_slid(&self, segments: &mut Vec<Segment<'m>>, joint: JointId, travel: Travel<'m>) {
        let Some((carrier, axis)) = self.model.joint(joint).kind.line() else { return };
        let (direction, along) = (self.direction(carrier), self.carried(carrier, axis.vector(self.graph())));
        for part in [travel.datum, travel.found] {
            push_segment(segments, Segment::new(direction, along.scaled(part), part.abs()));
        }
    }

    /// The joints on the shortest route between two places on placed links. Of several routes through as few joints, that with the fewest parts:
    /// one through a pin at the place itself does not go away along a link and come back along another one.
    #[must_use]
    pub fn route(&self, from: End, to: End) -> Vec<JointId> {
        let away = self.joints_away(to.link, from.link);
        let mut front: Vec<(End, usize, Vec<JointId>)> = vec![(from, 0, Vec::new())];
        for left in (0..away.get(&from.link).copied().unwrap_or(0)).rev() {
            let mut next: Vec<(End, usize, Vec<JointId>)> = Vec::new();
            for (at, parts, route) in &front {
                for (joint, data) in self.placed_on(at.link) {
                    let (Some(near), Some(far)) = (data.end_on(at.link), data.end_off(at.link)) else { continue };
                    if away.get(&far.link) != Some(&left) {
                        continue;
                    }
                    let parts = parts + self.parts(*at, near) + usize::from(data.kind.line().is_some());
                    let further = || route.iter().copied().chain([joint]).collect();
                    match next.iter_mut().find(|(end, ..)| *end == far) {
                        Some((_, known, _)) if *known <= parts => {}
                        Some(known) => *known = (far, parts, further()),
                        None => next.push((far, parts, further())),
                    }
                }
            }
            front = next;
        }
        let shortest = front.into_iter().min_by_key(|(at, parts, _)| parts + self.parts(*at, to));
        shortest.map(|(.., route)| route).unwrap_or_default()
    }

    /// Through how many joints one comes to a link, from those that are no further than another one.
    fn joints_away(&self, to: LinkId, from: LinkId) -> BTreeMap<LinkId, usize> {
        let mut away = BTreeMap::from([(to, 0)]);
        let mut open = VecDeque::from([to]);
        while let Some(at) = open.pop_front().filter(|_| !away.contains_key(&from)) {
            let further = away[&at] + 1;
            for far in self.placed_on(at).filter_map(|(_, joint)| joint.end_off(at)) {
                away.entry(far.link).or_insert_with(|| {
                    open.push_back(far.link);
                    further
                });
            }
        }
        away
    }

    /// None, if two points of a link are one.
    fn parts(&self, from: End, to: End) -> usize {
        usize::from(from != to && !(self.model.local(to) - self.model.local(from)).is_zero())
    }
}

/// Adds a segment; what turns together is added up in its own axes.
fn push_segment<'m>(segments: &mut Vec<Segment<'m>>, segment: Segment<'m>) {
    match segments.iter_mut().find(|s| s.direction == segment.direction) {
        Some(same) if same.along().is_zero() => *same = segment,
        Some(_) if segment.along().is_zero() => {}
        Some(same) => {
            same.is_bent |= segment.is_bent || !(same.rest.is_zero() || segment.rest.is_zero());
            same.varying = same.varying + segment.varying;
            same.constant = same.constant + segment.constant;
            same.rest = same.rest + segment.rest;
        }
        None => segments.push(segment),
    }
}
