//! Motion: how the links move, found group by group in one way for four purposes.
//!
//! * **Virtual**: the velocities of the links when the coordinate of one unknown changes at unit rate and the others rest. It is the
//!   transpose of equilibrium: the groups of forces, in the order from the unknowns outwards.
//! * **Velocities**: the drives move at their rates; the groups of motion, in their order.
//! * **Accelerations**: the same groups again. What is found is the acceleration of material places, so that a place of a turning link has
//!   `a + α r⊥ − ω² r` where velocities have `v + ω r⊥`; where links slide along each other, Coriolis' acceleration stands between them.
//! * **Change**: the derivative of the pose by a drive's coordinate or by a parameter; of a parameter, places move in their links too.
//!
//! A rule first supposes that its links do not turn or slide by themselves, reads what is missing at its inner joint, and divides it by
//! its pivot: the same for all of them.

use std::collections::BTreeMap;

use super::balance::{Balance, is_close, is_shorter};
use super::framed::Framed;
use super::heading;
use super::pivots::Pivots;
use super::placement::{Placement, Spot};
use super::rules::Rule;
use crate::diagnostics::Sink;
use crate::equations::loads::Action;
use crate::graph::tangent::Tangent;
use crate::graph::{Expr, Graph, Stage, Symbol, Vector};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId, UnknownId};
use crate::model::{Gear, JointKind, Model, UnknownKind};
use crate::topology::{Group, Input};

/// The motion of a link: its rate of rotation, and the velocity of one of its places. Of accelerations the same with one dot more.
#[derive(Clone, Copy, Debug)]
pub struct Twist<'m> {
    /// Rate of rotation.
    pub rate: Expr<'m>,
    /// A place along and across the link's direction.
    pub at: Vector<'m>,
    /// Its velocity.
    pub velocity: Framed<'m>,
}

/// What a motion is.
#[derive(Clone, Copy, Debug)]
enum Purpose<'m, 'p> {
    /// The coordinate of one unknown changes at unit rate.
    Virtual(UnknownId),
    /// One drive moves at unit rate, the others rest.
    Unit(DriveId),
    /// The drives move at their rates.
    Velocity,
    /// The drives' accelerations, at these velocities. Of two different ones, what is left of the accelerations at their sum when those at
    /// each of them are taken away, halved: the part that is linear in both.
    Acceleration([&'p Motion<'m, 'p>; 2]),
    /// The coordinate of this drive, or this parameter, changes at unit rate.
    Change(Symbol),
}

/// The velocities or the accelerations of all links.
#[derive(Debug)]
pub struct Motion<'m, 'p> {
    /// Where the links are.
    pub placement: &'p Placement<'m>,
    /// Known angles.
    pub pivots: &'p Pivots<'m>,
    /// What distinguishes the names of this motion.
    pub prefix: String,
    /// Of a change, what is behind its names: by what.
    by: String,
    purpose: Purpose<'m, 'p>,
    /// Of accelerations: whether the drives accelerate, too.
    driven: bool,
    twists: Vec<Twist<'m>>,
    /// The links whose groups are solved: their motion is found, not supposed.
    solved: Vec<bool>,
    /// Of slides: how fast the second link slides along the first one.
    sliding: BTreeMap<JointId, Expr<'m>>,
    /// How dimensions change, if a parameter does.
    dimensions: Option<Tangent<'m>>,
}

impl<'m, 'p> Motion<'m, 'p> {
    fn new(placement: &'p Placement<'m>, pivots: &'p Pivots<'m>, purpose: Purpose<'m, 'p>, prefix: String) -> Self {
        let graph = placement.graph();
        let rest = Framed { components: graph.zero_vector(), axes: placement.direction(GROUND) };
        let still = Twist { rate: graph.zero(), at: graph.zero_vector(), velocity: rest };
        let twists = vec![still; placement.model.links.len()];
        let by = String::new();
        Self {
            placement,
            pivots,
            prefix,
            by,
            purpose,
            driven: true,
            twists,
            solved: vec![false; placement.model.links.len()],
            sliding: BTreeMap::new(),
            dimensions: None,
        }
    }

    /// The change of the pose with a drive's coordinate or with a parameter, before any group is solved.
    #[must_use]
    pub(crate) fn change(placement: &'p Placement<'m>, pivots: &'p Pivots<'m>, by: Symbol, name: &str) -> Self {
        let mut motion = Self::new(placement, pivots, Purpose::Change(by), String::new());
        motion.by = format!("_by_{name}");
        if let Symbol::Parameter(_) = by {
            motion.dimensions = Some(Tangent::by(placement.graph(), by, name).at_rest());
        }
        motion
    }

    /// How a dimension changes: a length, an angle or a part of a vector in a link's own axes.
    #[must_use]
    pub fn change_of(&self, dimension: Expr<'m>) -> Expr<'m> {
        self.dimensions.as_ref().map_or_else(|| self.graph().zero(), |tangent| tangent.of(dimension))
    }

    /// How fast the direction that a link carries turns in the link's frame: dimensions may tell where it points to.
    fn turn_in_frame(&self, link: LinkId) -> Expr<'m> {
        let axis = self.placement.orientation(link).axis;
        axis.cross(Vector::new(self.change_of(axis.x), self.change_of(axis.y)))
    }

    /// How a vector of a link, along and across the direction that the link carries, changes in the link's frame: dimensions do.
    #[must_use]
    pub fn within(&self, link: LinkId, vector: Vector<'m>) -> Vector<'m> {
        let own = Vector::new(self.change_of(vector.x), self.change_of(vector.y));
        own + vector.perp().scaled(self.turn_in_frame(link))
    }

    /// How fast the direction that a link carries turns.
    #[must_use]
    pub fn rate_of_direction(&self, link: LinkId) -> Expr<'m> {
        self.rate(link) + self.turn_in_frame(link)
    }

    /// How fast the angle changes by which a slide or a weld turns a link against the other one.
    #[must_use]
    pub fn turned_by(&self, joint: JointId, link: LinkId) -> Expr<'m> {
        let data = self.model().joint(joint);
        let change =
            data.kind.turn().map_or_else(|| self.graph().zero(), |(_, angle)| self.change_of(self.graph().expr(angle)));
        if data.to.link == link { change } else { -change }
    }

    /// What a parameter does where two wheels roll, along the pitch line: as far as radii and phase change what rolls by.
    #[must_use]
    pub fn meshing(&self, joint: JointId, gear: &Gear) -> Expr<'m> {
        let (model, graph) = (self.model(), self.graph());
        let [first, second] = gear.radii.map(|radius| graph.expr(radius));
        let changes = [first, second, graph.expr(gear.phase)].map(|dimension| self.change_of(dimension));
        if changes.iter().all(|change| change.is_zero()) {
            return graph.zero();
        }
        let [to_first, to_second, phase] = changes;
        let centres = gear.centres(model);
        let line = self.placement.angle(gear.arm[0].link) + graph.atan2(centres.y, centres.x);
        let [a, b] = model.joint(joint).ends().map(|end| self.placement.angle(end.link) - line);
        (gear.distance(model) / (first + second)) * (to_first * a + to_second * b - phase)
    }

    /// How fast the travel of a slide or a slot changes: its second point along it, from the first one. A travel that parameters alone
    /// determine moves its place on the line as a dimension does; what slides beside that is found.
    #[must_use]
    pub fn of_travel(&self, joint: JointId) -> Expr<'m> {
        self.sliding(joint, self.model().joint(joint).to.link) + self.change_of(self.placement.travel(joint))
    }

    /// The virtual motion of an unknown, before any group is solved.
    #[must_use]
    pub fn of_unknown(
        placement: &'p Placement<'m>,
        pivots: &'p Pivots<'m>,
        unknown: UnknownId,
        prefix: String,
    ) -> Self {
        Self::new(placement, pivots, Purpose::Virtual(unknown), prefix)
    }

    /// The velocities, before any group is solved.
    #[must_use]
    pub fn velocities(placement: &'p Placement<'m>, pivots: &'p Pivots<'m>) -> Self {
        Self::new(placement, pivots, Purpose::Velocity, String::new())
    }

    /// The velocities at unit rate of one drive, before any group is solved.
    #[must_use]
    pub fn of_drive(placement: &'p Placement<'m>, pivots: &'p Pivots<'m>, drive: DriveId, prefix: String) -> Self {
        Self::new(placement, pivots, Purpose::Unit(drive), prefix)
    }

    /// The velocities as the sum of those at unit rates, each times the rate of its drive.
    #[must_use]
    pub fn combined(units: &[&Motion<'m, 'p>], placement: &'p Placement<'m>, pivots: &'p Pivots<'m>) -> Self {
        let mut sum = Self::velocities(placement, pivots);
        let (model, graph) = (placement.model, placement.graph());
        let ground = placement.direction(GROUND);
        let rates = || model.drives.iter().map(|drive| graph.expr(drive.rate));
        for link in model.moving_links() {
            let Some(at) = units.first().map(|unit| unit.twists[link.index()].at) else { continue };
            let mut twist = Twist { at, ..sum.twists[link.index()] };
            for (unit, rate) in units.iter().zip(rates()) {
                let Framed { components, axes } = unit.of_place(link, at);
                twist.rate = twist.rate + rate * unit.rate(link);
                twist.velocity = twist.velocity.plus(&Framed { components: components.scaled(rate), axes }, ground);
            }
            let name = &model.link(link).name;
            twist.rate = twist.rate.named(format!("omega_{name}"), format!("rate of rotation of {name}"));
            graph.pass_on(twist.rate);
            sum.found(link, twist);
        }
        let slides = units.first().map(|unit| unit.sliding.keys().copied().collect::<Vec<_>>()).unwrap_or_default();
        for slide in slides {
            let to = model.joint(slide).to.link;
            let speeds = units.iter().zip(rates()).map(|(unit, rate)| rate * unit.sliding(slide, to));
            let speed = speeds.fold(graph.zero(), |sum, speed| sum + speed);
            sum.sliding.insert(slide, speed);
        }
        sum
    }

    /// What the accelerations are at these velocities without any of the drives, before any group is solved.
    #[must_use]
    pub fn undriven_accelerations(velocities: &'p Motion<'m, 'p>) -> Self {
        Self::second_order([velocities; 2], String::new())
    }

    /// The second derivatives of the motion by two drives, from the first ones; before any group is solved.
    #[must_use]
    pub fn second_order(first: [&'p Motion<'m, 'p>; 2], prefix: String) -> Self {
        let Motion { placement, pivots, .. } = *first[0];
        Self { driven: false, ..Self::new(placement, pivots, Purpose::Acceleration(first), prefix) }
    }

    /// The accelerations at these velocities, before any group is solved.
    #[must_use]
    pub fn accelerations(velocities: &'p Motion<'m, 'p>) -> Self {
        let Motion { placement, pivots, .. } = *velocities;
        Self::new(placement, pivots, Purpose::Acceleration([velocities; 2]), String::new())
    }

    /// The same, once all groups are solved, each by its rule.
    #[must_use]
    pub fn through(mut self, groups: &[Group], rules: &[&dyn Rule], sink: &Sink) -> Self {
        let what = match self.purpose {
            Purpose::Virtual(_) => "virtual velocities",
            Purpose::Unit(_) => "velocities at unit rate",
            Purpose::Change(_) => "change of the pose",
            Purpose::Velocity => "velocities",
            Purpose::Acceleration(_) if !self.driven => "accelerations by the velocities alone",
            Purpose::Acceleration(_) => "accelerations",
        };
        for (index, (group, rule)) in groups.iter().zip(rules).enumerate() {
            self.graph().begin_section(heading(self.model(), index, group, rule.class(), what));
            // An error of a rule is the same in every scene: once is enough.
            if let (Err(error), true) = (rule.follow(&mut self, group), sink.is_clean()) {
                sink.report(error);
            }
            for link in &group.links {
                self.solved[link.index()] = true;
                self.graph().pass_on(self.rate(*link));
            }
        }
        self
    }

    /// The linkage.
    #[must_use]
    pub fn model(&self) -> &'m Model {
        self.placement.model
    }

    /// All expressions.
    #[must_use]
    pub fn graph(&self) -> &'m Graph {
        self.placement.graph()
    }

    /// The motion of a link is found, or supposed until it is.
    pub fn found(&mut self, link: LinkId, twist: Twist<'m>) {
        self.twists[link.index()] = twist;
    }

    /// A link's rate of rotation; of accelerations its angular acceleration.
    #[must_use]
    pub fn rate(&self, link: LinkId) -> Expr<'m> {
        self.twists[link.index()].rate
    }

    /// `ω²` of a link, if these are accelerations and it turns.
    fn angular_velocity_squared(&self, link: LinkId) -> Option<Expr<'m>> {
        let Purpose::Acceleration([one, other]) = self.purpose else { return None };
        let product = one.rate(link) * other.rate(link);
        let name = &self.model().link(link).name;
        let how = if core::ptr::eq(one, other) { "ω²" } else { "the product of the rates of rotation" };
        (!product.is_zero()).then(|| product.named(self.name(&format!("omega2_{name}")), format!("{how} of {name}")))
    }

    /// The rate at which the coordinate of a drive or an unknown changes: of a virtual motion one or zero.
    #[must_use]
    pub fn rate_of(&self, input: Input) -> Expr<'m> {
        let (model, graph) = (self.model(), self.graph());
        match (self.purpose, input) {
            (Purpose::Virtual(own), _) => {
                let same = match (input, model.unknown(own).kind) {
                    (Input::Unknown(unknown), _) => unknown == own,
                    (Input::Drive(drive), UnknownKind::Drive(driven)) => drive == driven,
                    (Input::Drive(_), _) => false,
                };
                if same { graph.one() } else { graph.zero() }
            }
            (Purpose::Unit(own), Input::Drive(drive)) => {
                if own == drive {
                    graph.one()
                } else {
                    graph.zero()
                }
            }
            (Purpose::Acceleration(_), Input::Drive(_)) if !self.driven => graph.zero(),
            (Purpose::Velocity, Input::Drive(drive)) => graph.expr(model.drive(drive).rate),
            (Purpose::Acceleration(_), Input::Drive(drive)) => graph.expr(model.drive(drive).acceleration),
            (Purpose::Change(by), Input::Drive(drive)) => {
                if by == Symbol::Drive(drive) {
                    graph.one()
                } else {
                    graph.zero()
                }
            }
            // Real motion is driven.
            (
                Purpose::Unit(_) | Purpose::Velocity | Purpose::Acceleration(_) | Purpose::Change(_),
                Input::Unknown(_),
            ) => graph.zero(),
        }
    }

    /// The velocity of a joint's place on a link.
    #[must_use]
    pub fn of_point(&self, at: impl Into<Spot>) -> Framed<'m> {
        let at = at.into();
        self.of_place(at.end.link, self.placement.point(at))
    }

    /// The velocity of a joint: of its point, of a gear pair where the wheels touch, as a place of the link that keeps them apart.
    #[must_use]
    pub fn of_joint(&self, joint: JointId) -> Framed<'m> {
        let data = self.model().joint(joint);
        let JointKind::Gear(gear) = data.kind else { return self.of_point(data.place()) };
        let (arm, placement) = (gear.arm[1], self.placement);
        let [_, radius] = gear.rolling_radii(self.model());
        let towards = placement.carried(arm.link, gear.centres(self.model()));
        self.of_place(arm.link, placement.point(arm) - towards.scaled(radius))
    }

    /// The velocity of a place along and across a link's direction: `v + ω r⊥`. Its acceleration is `a + α r⊥ − ω² r`.
    ///
    /// What turning adds to the velocity of a far place may take most of it away again, and leave its rounding. So it is added to that of
    /// the nearest pin which moves in a simple way, as one of a link on the ground.
    #[must_use]
    pub fn of_place(&self, link: LinkId, at: Vector<'m>) -> Framed<'m> {
        self.of_place_by(&self.nearest_twist(link, at), link, at)
    }

    /// The motion of a link as that of the nearest such pin, or of the place for which it was found.
    fn nearest_twist(&self, link: LinkId, at: Vector<'m>) -> Twist<'m> {
        let own = self.twists[link.index()];
        if !self.solved[link.index()] || own.rate.is_zero() || own.velocity.components.is_zero() {
            return own;
        }
        self.pins(link).filter(|(_, far)| self.solved[far.index()]).fold(own, |nearest, (pin, far)| {
            let [here, there] = [link, far].map(|link| self.placement.slide_point(pin, link));
            if !is_shorter(here - at, nearest.at - at) {
                return nearest;
            }
            let velocity = self.of_place_by(&self.twists[far.index()], far, there);
            if is_simple(&velocity) { Twist { rate: own.rate, at: here, velocity } } else { nearest }
        })
    }

    /// The pins of a link, each with the other link there.
    fn pins(&self, link: LinkId) -> impl Iterator<Item = (JointId, LinkId)> {
        let model = self.model();
        model.joint_ids().filter_map(move |joint| {
            let data = model.joint(joint);
            let far = data.end_on(link).and(data.end_off(link))?.link;
            matches!(data.kind, JointKind::Revolute).then_some((joint, far))
        })
    }

    /// The same, by way of a place whose velocity is known.
    fn of_place_by(&self, twist: &Twist<'m>, link: LinkId, at: Vector<'m>) -> Framed<'m> {
        let arm = at - twist.at;
        let turning = arm.perp().scaled(twist.rate);
        let turning = match self.angular_velocity_squared(link) {
            Some(squared) => turning - arm.scaled(squared),
            None => turning,
        };
        // A parameter moves places in their link.
        let turning = if self.dimensions.is_some() { turning + self.within(link, arm) } else { turning };
        let turning = Framed { components: turning, axes: self.placement.direction(link) };
        turning.plus(&twist.velocity, self.placement.direction(GROUND))
    }

    /// The motion of a link that a slide guides along another one, as if it did not slide.
    #[must_use]
    pub fn carried(&self, slide: JointId, link: LinkId) -> Twist<'m> {
        let far = self.other(slide, link);
        let guided = self.of_place(far, self.placement.slide_point(slide, far));
        let velocity = guided.plus(&self.coriolis(slide, link), self.placement.direction(GROUND));
        Twist {
            rate: self.rate(far) + self.driven_rate(slide, far) + self.turned_by(slide, link),
            at: self.placement.slide_point(slide, link),
            velocity,
        }
    }

    /// The velocity of a joint's place on a link as the other link has it there: of a pin that is driven along a slot with what that adds.
    #[must_use]
    pub fn passed_on(&self, joint: JointId, link: LinkId) -> Framed<'m> {
        let (far, ground) = (self.other(joint, link), self.placement.direction(GROUND));
        let place = self.of_place(far, self.placement.slide_point(joint, far));
        match self.driven_sliding(joint, link) {
            Some(sliding) => {
                place.plus(&self.along_slide(joint, sliding), ground).plus(&self.coriolis(joint, link), ground)
            }
            None => place,
        }
    }

    /// How fast a drive slides a link along the other link of a slot.
    fn driven_sliding(&self, slot: JointId, link: LinkId) -> Option<Expr<'m>> {
        let joint = self.model().joint(slot);
        let is_slot = matches!(joint.kind, JointKind::Slot { .. });
        let rate = self.rate_of(Input::Drive(self.model().drive_of(slot, false).filter(|_| is_slot)?));
        Some(if joint.to.link == link { rate } else { -rate })
    }

    /// The rate at which a drive turns the other link of a slot against this one.
    #[must_use]
    pub fn driven_rate(&self, slot: JointId, from: LinkId) -> Expr<'m> {
        let joint = self.model().joint(slot);
        let is_slot = matches!(joint.kind, JointKind::Slot { .. });
        let drive = self.model().drive_of(slot, true).filter(|_| is_slot);
        let rate = drive.map_or(self.graph().zero(), |drive| self.rate_of(Input::Drive(drive)));
        if joint.from.link == from { rate } else { -rate }
    }

    /// A link that was carried along a slide also slides.
    pub fn slides(&mut self, slide: JointId, link: LinkId, sliding: Expr<'m>) {
        let along = self.along_slide(slide, sliding);
        let ground = self.placement.direction(GROUND);
        let twist = &mut self.twists[link.index()];
        twist.velocity = twist.velocity.plus(&along, ground);
        self.records(slide, link, sliding);
    }

    /// How fast a link slides along the other one.
    pub fn records(&mut self, slide: JointId, link: LinkId, sliding: Expr<'m>) {
        let forwards = self.model().joint(slide).to.link == link;
        self.sliding.insert(slide, if forwards { sliding } else { -sliding });
    }

    /// A velocity along a slide.
    #[must_use]
    pub fn along_slide(&self, slide: JointId, sliding: Expr<'m>) -> Framed<'m> {
        let axes = self.placement.slide_direction(slide);
        Framed { components: Vector::new(sliding, self.graph().zero()), axes }
    }

    /// How fast a link slides along the other link of a slide or a slot.
    #[must_use]
    pub fn sliding(&self, joint: JointId, link: LinkId) -> Expr<'m> {
        if let Some(sliding) = self.sliding.get(&joint) {
            return if self.model().joint(joint).to.link == link { *sliding } else { -*sliding };
        }
        if let Some(driven) = self.driven_sliding(joint, link) {
            return driven;
        }
        let far = self.other(joint, link);
        let [own, its] = [link, far].map(|link| self.of_place(link, self.placement.slide_point(joint, link)));
        self.part(&self.difference(&own, &its), self.placement.slide_direction(joint))
    }

    /// What the acceleration of a link at a slide or a slot is beyond that of the other link there and its own sliding: Coriolis' `2 ω v`
    /// across the line, with ω of the link that carries the line. None of a velocity.
    #[must_use]
    pub fn coriolis(&self, joint: JointId, link: LinkId) -> Framed<'m> {
        let graph = self.graph();
        let nothing = Framed { components: graph.zero_vector(), axes: self.placement.direction(GROUND) };
        let (Purpose::Acceleration([one, other]), Some((carrier, _))) =
            (self.purpose, self.model().joint(joint).kind.line())
        else {
            return nothing;
        };
        if one.rate(carrier).is_zero() && other.rate(carrier).is_zero() {
            return nothing;
        }
        let name = &self.model().joint(joint).name;
        let (across, how) = if core::ptr::eq(one, other) {
            ((2 * graph.one()) * (one.rate(carrier) * one.sliding(joint, link)), "2 ω times the speed of sliding")
        } else {
            let part = |turning: &Motion<'m, '_>, sliding: &Motion<'m, '_>| {
                let omega = turning.rate(carrier);
                if omega.is_zero() { omega } else { omega * sliding.sliding(joint, link) }
            };
            (part(one, other) + part(other, one), "ω times the speed of sliding, of either by the other")
        };
        let across = across.named(self.name(&format!("coriolis_{name}")), format!("Coriolis: {how}"));
        Framed { components: Vector::new(graph.zero(), across), axes: self.placement.slide_direction(joint) }
    }

    /// The acceleration by which a place of a link is drawn towards another one, times their distance: `ω² r`. None of a velocity.
    #[must_use]
    pub fn centripetal(&self, link: LinkId, distance: Expr<'m>) -> Expr<'m> {
        self.angular_velocity_squared(link).map_or_else(|| self.graph().zero(), |squared| squared * distance)
    }

    fn other(&self, joint: JointId, link: LinkId) -> LinkId {
        let data = self.model().joint(joint);
        if data.to.link == link { data.from.link } else { data.to.link }
    }

    /// The difference of two velocities.
    #[must_use]
    pub fn difference(&self, of: &Framed<'m>, from: &Framed<'m>) -> Framed<'m> {
        of.plus(&from.opposite(), self.placement.direction(GROUND))
    }

    /// What a link lacks of the velocity that it must have at a joint, as long as it does not turn or slide by itself.
    #[must_use]
    pub fn lacking(&self, joint: JointId, needed: &Framed<'m>, has: &Framed<'m>) -> Framed<'m> {
        let gap = self.difference(needed, has);
        let (letter, what) = match self.purpose {
            Purpose::Virtual(_) | Purpose::Unit(_) | Purpose::Change(_) => return gap,
            Purpose::Velocity => ('v', "velocity"),
            Purpose::Acceleration(_) => ('a', "acceleration"),
        };
        let joint = &self.model().joint(joint).name;
        let meaning = format!("relative {what} at {joint} as long as its links do not turn or slide by themselves");
        Framed { components: gap.components.named(&format!("d{letter}_{joint}"), &meaning), axes: gap.axes }
    }

    /// A velocity's part along a direction.
    #[must_use]
    pub fn part(&self, velocity: &Framed<'m>, along: Vector<'m>) -> Expr<'m> {
        let Framed { components, axes } = *velocity;
        if axes == along {
            return components.x;
        }
        if axes.perp() == along {
            return components.y;
        }
        // a x·d + b x⊥·d, and x⊥·d = x × d.
        let mut sum = self.graph().zero();
        if !components.x.is_zero() {
            sum = sum + components.x * self.pivots.cosine(axes, along);
        }
        if !components.y.is_zero() {
            sum = sum + components.y * self.pivots.sine(axes, along);
        }
        sum
    }

    /// The loads where their power is found best: those near another pin of a link are carried to it, all of them, or some that act next to it.
    #[must_use]
    pub fn at_nearest_pins<'l>(&self, loads: &Balance<'m, 'l>) -> Balance<'m, 'l> {
        let (mut carried, mut given) = (loads.clone(), Vec::new());
        for link in self.model().moving_links() {
            let pins = self.simple_pins(link, &given);
            if let Some(pin) = self.pin_for_power(&carried, link, &pins) {
                carried.carry_over(pin, link);
                given.push(link);
                continue;
            }
            let own = self.twists[link.index()].at;
            for pin in pins {
                let at = self.placement.slide_point(pin, link);
                let known = !carried.is_free(self.other(pin, link));
                let goes = |place| if known { is_close(place, at, own) } else { place == at && at != own };
                if carried.carry_some_over(pin, link, goes) {
                    given.push(link);
                }
            }
        }
        carried
    }

    /// The one of these pins of a link at which the power of its loads is found best, if that is not where the link's own motion is.
    ///
    /// What turning adds to the velocity of a far place may take most of it away again, and leave its rounding. So if all forces act nearer to
    /// another pin that moves in a simple way, as one of a link on the ground, they are carried there, to the link on its other side, and leave
    /// their moment about the pin. That link's motion has to be known for loads of its own; or the forces act at the pin itself, and no load
    /// asks how this link turns.
    fn pin_for_power(&self, loads: &Balance<'m, '_>, link: LinkId, pins: &[JointId]) -> Option<JointId> {
        let own = self.twists[link.index()].at;
        let nearest = pins.iter().fold((own, None), |nearest, &joint| {
            let at = self.placement.slide_point(joint, link);
            let known = !loads.is_free(self.other(joint, link)) || loads.acts_only_at(link, at);
            if known && loads.all_act_nearer(link, at, nearest.0) { (at, Some(joint)) } else { nearest }
        });
        nearest.1
    }

    /// The pins of a link that turns about no resting place which move in a simple way. A link that has given its loads away, one of `given`, gets
    /// none back: no pin there.
    fn simple_pins(&self, link: LinkId, given: &[LinkId]) -> Vec<JointId> {
        let own = self.twists[link.index()];
        if own.rate.is_zero() || own.velocity.components.is_zero() {
            return Vec::new();
        }
        let pins = self.pins(link).filter(|(pin, far)| !given.contains(far) && is_simple(&self.passed_on(*pin, link)));
        pins.map(|(pin, _)| pin).collect()
    }

    /// The power of all that acts on a link: `ΣF · v` and `ΣM ω`, with the moments about the place whose velocity is v.
    #[must_use]
    pub fn power_of(&self, loads: &Balance<'m, '_>, link: LinkId) -> [Expr<'m>; 2] {
        let Twist { rate, at, velocity } = self.twists[link.index()];
        let force = loads.total(link).along(velocity.axes);
        let moment = loads.moment_for_power(link, at);
        [velocity.components.dot(force), rate * moment]
    }

    /// The power of an action: `F · v` or `M ω`.
    #[must_use]
    pub fn power(&self, action: &Action) -> Expr<'m> {
        let graph = self.graph();
        match *action {
            Action::Force { link, at, force, frame } => {
                let velocity = self.of_place(link, self.placement.carried(link, at.vector(graph)));
                let components = self.placement.carried(frame, force.vector(graph));
                let axes = self.placement.direction(frame);
                velocity.along(axes).dot(components)
            }
            Action::Couple { link, moment } => graph.expr(moment) * self.rate(link),
        }
    }

    /// The name of a quantity of this motion.
    #[must_use]
    pub fn name(&self, name: &str) -> String {
        format!("{}{name}{}", self.prefix, self.by)
    }

    /// A link's rate of rotation, or its angular acceleration, as a named quantity; how it comes about is said with `{velocity}` for
    /// what these are.
    #[must_use]
    pub fn named_rate(&self, rate: Expr<'m>, of: &str, how: &str) -> Expr<'m> {
        let (name, what) = match self.purpose {
            Purpose::Virtual(_) | Purpose::Unit(_) => ("rate", "rate of rotation"),
            Purpose::Change(_) => ("turn", "change of the angle"),
            Purpose::Velocity => ("omega", "angular velocity"),
            Purpose::Acceleration(_) => ("alpha", "angular acceleration"),
        };
        let how = self.in_words(how);
        rate.named(self.name(&format!("{name}_{}", of.replace(" + ", "_"))), format!("{what} of {of}{how}"))
    }

    /// A component of the velocity, or of the acceleration, of something, as a named quantity: which one, and in what axes.
    #[must_use]
    pub fn named_part(&self, part: Expr<'m>, of: &str, (which, axes): (&str, &str)) -> Expr<'m> {
        let letter = match self.purpose {
            Purpose::Virtual(_) | Purpose::Unit(_) | Purpose::Velocity => "v",
            Purpose::Change(_) => "d",
            Purpose::Acceleration(_) => "a",
        };
        let what = self.in_words("{velocity}");
        part.named(self.name(&format!("{letter}_{of}_{which}")), format!("{what} of {of}, {which} {axes}"))
    }

    /// The speed, or the acceleration, along a slide as a named quantity.
    #[must_use]
    pub fn named_sliding(&self, sliding: Expr<'m>, slide: JointId, of: &str, how: &str) -> Expr<'m> {
        let what = match self.purpose {
            Purpose::Virtual(_) | Purpose::Unit(_) | Purpose::Velocity => "speed",
            Purpose::Change(_) => "shift",
            Purpose::Acceleration(_) => "acceleration",
        };
        let (how, slide) = (self.in_words(how), &self.model().joint(slide).name);
        sliding.named(self.name(&format!("{what}_{slide}")), format!("{what} of {of} along the slide {slide}{how}"))
    }

    fn in_words(&self, how: &str) -> String {
        let word = match self.purpose {
            Purpose::Virtual(_) | Purpose::Unit(_) | Purpose::Velocity => "velocity",
            Purpose::Change(_) => "change",
            Purpose::Acceleration(_) => "acceleration",
        };
        how.replace("{velocity}", word)
    }
}

/// Whether a velocity is one product at most: that of a pin of a link on the ground, of a slide's runner, of a place that a drive moves.
fn is_simple(velocity: &Framed<'_>) -> bool {
    let Vector { x, y } = velocity.components;
    x.is_zero() || y.is_zero() || x.stage().max(y.stage()) < Stage::Posed
}
