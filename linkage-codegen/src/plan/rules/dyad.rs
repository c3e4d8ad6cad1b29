//! What all dyads share: two bodies, a joint between them, and an outer joint on each.
//!
//! Links that a weld or a driven joint joins are one body: the drive says how they lie against each other, so that a cylinder with its
//! rod is a link whose length is an argument. The distance between two points of such a body is an expression in its drives. Once the
//! first link of the body is placed, the others are placed from it as driven or welded links; and once the force at its inner joint is
//! known, they are solved as such, with the efforts and the reactions of the welds within the body.
//!
//! A slot along which its pin is driven is a pin whose place on the slot's link is an expression in the drive; one whose link is turned
//! by a drive is a slide.

use std::collections::BTreeSet;

use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Symbol, Vector};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId};
use crate::model::{JointKind, Model};
use crate::plan::assembly::{Assembly, DyadPivot};
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::pivots::{divisor, significant};
use crate::plan::placement::{Orientation, Placement, Spot, Way};
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Freedom, Group, Input};

/// A body of a dyad.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    /// Its outer joint.
    pub outer: JointId,
    /// Whether that is a pin.
    pinned: bool,
    /// The outer joint's place on a link outside the dyad.
    pub far: Spot,
    /// The outer joint's place on the body.
    pub near: Spot,
    /// The inner joint's place on the body.
    pub tip: Spot,
    /// Its links, that of the outer joint first.
    links: Vec<LinkId>,
    /// The welds and driven joints between its links.
    rigid: Vec<JointId>,
}

/// How the pins of a leg share the loads on it across the line between them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share<'m> {
    /// The moment of the loads about the outer pin over the length: what the inner pin has to hold.
    pub inner: Expr<'m>,
    /// Where a joint within the leg passes on what neither of the pins tells well.
    cut: Option<Cut<'m>>,
}

/// A joint within a leg that two pins hold, between its first link or its last one and the others.
#[derive(Clone, Copy, Debug)]
struct Cut<'m> {
    /// The link from the equilibrium of which the joint is found.
    from: LinkId,
    /// The link towards which all other joints are found.
    towards: LinkId,
    /// The force that the outer side passes on, across the leg.
    across: Expr<'m>,
    /// The loads on the outer side.
    outer: Framed<'m>,
    /// The loads on the inner side, along the leg.
    along: Expr<'m>,
    /// The moment of the loads on the link's own side about its pin.
    moment: Expr<'m>,
}

/// What holds a link at the end of a leg: a pin of the leg, and a joint within the leg.
#[derive(Clone, Copy, Debug)]
struct Held<'m> {
    /// The link.
    link: LinkId,
    /// The pin's place on the link.
    pin: Vector<'m>,
    /// The force of the pin on the link.
    reaction: Framed<'m>,
    /// The sum of that force and of the loads on the link and on those it holds: what the joint passes on.
    passed: Framed<'m>,
    /// The moment of the loads about the pin.
    moment: Expr<'m>,
}

impl<'m> Held<'m> {
    /// Puts what the joint passes on in the stead of all that acts on the link.
    ///
    /// About the pin the moment is that of the loads alone, and carried to the joint it has that of what is passed on besides. Loads that act
    /// nearer to the joint may have little moment about it, and what they have about the pin would only be taken off again and leave its
    /// rounding. So then the moments of the loads and of the pin's force are taken about the joint itself.
    fn reduce(&self, balance: &mut Balance<'m, '_>, joint: JointId) {
        let own = balance.placement.slide_point(joint, self.link);
        if !balance.acts_nearer(self.link, own, self.pin) {
            balance.reduce(self.link, self.pin, self.passed, self.moment);
            return;
        }
        balance.push(self.link, self.pin, self.reaction);
        let moment = balance.moment(self.link, own, balance.graph().one());
        balance.reduce(self.link, own, self.passed, moment);
    }
}

/// The parts of a dyad.
#[derive(Clone, Debug)]
pub struct Dyad<'a> {
    pub(super) model: &'a Model,
    pub(super) legs: [Leg; 2],
    pub(super) inner: JointId,
    /// Whether the inner joint is a pin.
    pinned: bool,
}

/// The direction of a body between its joints, in the frame of its first link.
#[derive(Clone, Copy, Debug)]
struct Arm<'m> {
    /// The direction that the first link carries, in its own frame.
    axis: Vector<'m>,
    /// From the outer joint to the inner one, along and across that direction.
    along: Vector<'m>,
    /// Its size.
    size: Expr<'m>,
    /// Its direction: its components over its size, brought to unit size once more.
    lean: Vector<'m>,
}

/// A group as a dyad, if it is one.
pub(super) fn dyad<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let driven = |input: &Input| Group::drive_of(model, *input).is_some();
    if !group.inputs.iter().all(driven) {
        return None;
    }
    let freedom = |joint: JointId| group.freedom(model, joint);
    let is_pin = |joint: JointId| match freedom(joint) {
        Freedom::Turn => Some(true),
        Freedom::Slide => Some(false),
        Freedom::None | Freedom::TurnAndSlide | Freedom::Roll => None,
    };
    let (rigid, free): (Vec<JointId>, Vec<JointId>) =
        group.inner.iter().partition(|joint| freedom(**joint) == Freedom::None);
    let &[inner] = free.as_slice() else { return None };
    let pinned = is_pin(inner)?;
    let spot = |joint: JointId, pinned: bool, link: LinkId| {
        let end = model.joint(joint).end_on(link).map(Spot::from);
        if pinned { Spot::of_pin(model, joint, link) } else { end }
    };
    let leg = |outer: JointId| {
        let first = group.own_link(model, outer);
        let outside = model.joint(outer).end_off(first)?.link;
        let outer_pinned = is_pin(outer)?;
        let (near, far) = (spot(outer, outer_pinned, first)?, spot(outer, outer_pinned, outside)?);
        let mut leg = Leg { outer, pinned: outer_pinned, far, near, tip: near, links: vec![first], rigid: Vec::new() };
        while let Some((joint, link)) = next_rigid(model, &rigid, &leg.links) {
            leg.links.push(link);
            leg.rigid.push(joint);
        }
        let own = model.joint(inner).ends().into_iter().find(|end| leg.links.contains(&end.link))?.link;
        leg.tip = spot(inner, pinned, own)?;
        Some(leg)
    };
    let &[a, b] = group.outer.as_slice() else { return None };
    let legs = [leg(a)?, leg(b)?];
    let links: BTreeSet<LinkId> = legs.iter().flat_map(|leg| leg.links.iter().copied()).collect();
    let apart = links.len() == legs[0].links.len() + legs[1].links.len();
    (apart && links.len() == group.links.len()).then_some(Dyad { model, legs, inner, pinned })
}

/// A link that a weld or a driven joint places from one of these, and the joint.
fn next_rigid(model: &Model, rigid: &[JointId], from: &[LinkId]) -> Option<(JointId, LinkId)> {
    rigid.iter().find_map(|joint| {
        let mut ends = model.joint(*joint).ends().map(|end| end.link);
        if from.contains(&ends[1]) {
            ends.swap(0, 1);
        }
        (from.contains(&ends[0]) && !from.contains(&ends[1])).then_some((*joint, ends[1]))
    })
}

/// One step towards unit size, which squares the error.
pub(super) fn towards_unit<'m>(rough: Vector<'m>, name: &str) -> Vector<'m> {
    let half = |n: i64| rough.graph().constant(&Number::ratio(n, 2));
    let factor = half(3) - half(1) * rough.squared();
    rough.scaled(factor.named(format!("unit_{name}"), format!("(3 − u·u)/2, u = rough_{name}")))
}

/// The sum of the loads on some links.
fn total_on<'m>(balance: &Balance<'m, '_>, links: &[LinkId]) -> Framed<'m> {
    let ground = balance.placement.direction(GROUND);
    let nothing = Framed { components: balance.graph().zero_vector(), axes: ground };
    links.iter().fold(nothing, |sum, link| sum.plus(&balance.total(*link), ground))
}

/// How a link is placed and held that a weld or driven joint joins to another one.
fn rigid_rule(model: &Model, joint: JointId) -> &'static dyn Rule {
    match model.joint(joint).kind {
        JointKind::Revolute => &super::crank::Crank,
        JointKind::Weld { .. } => &super::weld::Weld,
        JointKind::Prismatic { .. } | JointKind::Slot { .. } | JointKind::Gear(_) => &super::slide::Slide,
    }
}

impl Leg {
    /// The link of the outer joint.
    pub(super) fn link(&self) -> LinkId {
        self.near.end.link
    }

    pub(super) fn is_single(&self) -> bool {
        self.links.len() == 1
    }

    /// Whether its joints are always equally far apart.
    pub(super) fn is_constant(&self, model: &Model) -> bool {
        let driven = |joint: &JointId| model.drives_of(*joint).next().is_some();
        self.near.slot.is_none() && self.tip.slot.is_none() && !self.rigid.iter().any(driven)
    }

    /// The sum of the loads on it.
    pub(super) fn total<'m>(&self, balance: &Balance<'m, '_>) -> Framed<'m> {
        total_on(balance, &self.links)
    }

    /// At which joint what the pins of the leg share is told apart, from which of its links that joint is found, and towards which link
    /// all others are; nothing where the inner pin's force is all that there is to pass on.
    fn cut(&self, model: &Model, balance: &Balance<'_, '_>) -> Option<(JointId, LinkId, LinkId)> {
        let order = self.joined_to(model, self.link());
        let before = |link: LinkId| {
            let (joint, _) = order.iter().find(|(_, own)| *own == link)?;
            Some((*joint, model.joint(*joint).end_off(link)?.link))
        };
        // The links from the inner joint to the outer one, and those of them that something acts on, or on a link that they hold.
        let way = |link| core::iter::successors(Some(link), |link| before(*link).map(|(_, link)| link));
        let path: Vec<LinkId> = way(self.tip.end.link).collect();
        let loaded: BTreeSet<LinkId> = self
            .links
            .iter()
            .filter(|link| !balance.is_free(**link))
            .filter_map(|link| way(*link).find(|link| path.contains(link)))
            .collect();
        let (&[last, ..], &[.., second, first]) = (path.as_slice(), path.as_slice()) else { return None };
        let idle = |link: LinkId| !loaded.contains(&link);
        let joint = before(second)?.0;
        let data = model.joint(joint);
        // A slide's couple is about its runner, and is best found from the link that this lies on.
        let runs_on_first = data.kind.line().is_some() && data.place().link == first;
        if loaded.is_empty() {
            None
        } else if idle(first) || runs_on_first {
            let towards = path.iter().copied().find(|link| *link != first && loaded.contains(link));
            Some((joint, first, towards.unwrap_or(last)))
        } else if idle(last) {
            None
        } else {
            Some((before(last)?.0, last, first))
        }
    }

    /// What one of the links holds if a joint is taken away, with that link.
    fn held_without(&self, model: &Model, link: LinkId, joint: JointId) -> Vec<LinkId> {
        let rigid: Vec<JointId> = self.rigid.iter().copied().filter(|own| *own != joint).collect();
        let mut held = vec![link];
        while let Some((_, link)) = next_rigid(model, &rigid, &held) {
            held.push(link);
        }
        held
    }

    /// The other links in an order in which they can be placed from one of its links.
    fn joined_to(&self, model: &Model, first: LinkId) -> Vec<(JointId, LinkId)> {
        let (mut placed, mut order) = (vec![first], Vec::new());
        while let Some((joint, link)) = next_rigid(model, &self.rigid, &placed) {
            placed.push(link);
            order.push((joint, link));
        }
        order
    }
}

impl<'a> Dyad<'a> {
    /// Whether its outer joints and its inner one are pins: `[true, true, true]` is RRR.
    pub(super) fn pins(&self) -> [bool; 3] {
        [self.legs[0].pinned, self.pinned, self.legs[1].pinned]
    }

    pub(super) fn joint_name(&self, joint: JointId) -> &'a str {
        &self.model.joint(joint).name.text
    }

    /// The name of a body: `tube_rod`.
    pub(super) fn link_name(&self, leg: &Leg) -> String {
        self.model.link_names(&leg.links).replace(" + ", "_")
    }

    pub(super) fn group_name(&self) -> String {
        let links: Vec<LinkId> = self.legs.iter().flat_map(|leg| leg.links.iter().copied()).collect();
        self.model.link_names(&links)
    }

    /// A leg that is held by two pins needs a length between them.
    pub(super) fn check_length(&self, leg: &Leg) -> RuleResult {
        if leg.is_single() && leg.is_constant(self.model) {
            return super::check_length(self.model, leg.link(), [leg.outer, self.inner]);
        }
        if !leg.is_constant(self.model) || !self.constant_arm(leg).is_zero() {
            return Ok(());
        }
        let [first, second] = [leg.outer, self.inner].map(|joint| &self.model.joint(joint).name);
        let links: Vec<&str> = leg.links.iter().map(|link| self.model.link(*link).name.text.as_str()).collect();
        let links = crate::diagnostics::list(&links);
        let problem = format!("the welded links {links} have no length between their joints `{first}` and `{second}`");
        Err(Diagnostic::new(self.model.link(leg.link()).name.place(), problem)
            .help("put the two points apart, or join the two other links by one pin"))
    }

    /// From the outer joint of a leg to the inner one, where that is always the same, in the frame of its first link.
    fn constant_arm(&self, leg: &Leg) -> Vector<'a> {
        let (graph, model) = (&self.model.graph, self.model);
        if leg.is_single() {
            return model.local(leg.tip.end) - model.local(leg.near.end);
        }
        self.way_within(leg, leg.link(), Vector::new(graph.one(), graph.zero())).vector()
    }

    /// Distance of a leg's joints.
    pub(super) fn length(&self, leg: &Leg) -> Expr<'a> {
        if !leg.is_constant(self.model) {
            return self.arm(leg).size;
        }
        if leg.is_single() {
            return super::length_between(self.model, leg.link(), [leg.outer, self.inner]);
        }
        super::checked_length(self.model, self.constant_arm(leg).size(), &leg.links, [leg.outer, self.inner])
    }

    /// Moments on a leg of one link are taken over its length, as `share` does.
    pub(super) fn take_moments_over_length(&self, placement: &mut Placement<'a>, leg: &Leg) {
        if leg.is_single() && leg.is_constant(self.model) {
            placement.set_length(leg.link(), self.length(leg));
        }
    }

    /// The vector between a leg's joints, along and across what its first link carries, if its length is not constant.
    pub(super) fn driven_arm(&self, leg: &Leg) -> Option<Vector<'a>> {
        (!leg.is_constant(self.model)).then(|| self.arm(leg).along)
    }

    /// What the rounding of a leg's length is proportional to: nothing if the length is constant.
    pub(super) fn slack(&self, leg: &Leg) -> Expr<'a> {
        if leg.is_constant(self.model) {
            return self.model.graph.zero();
        }
        self.way_within(leg, leg.link(), self.arm_axis(leg)).length()
    }

    /// The direction from the outer joint to the inner one, in the frame of the first link of a leg where it is always the same.
    fn axis(&self, leg: &Leg) -> Vector<'a> {
        let (arm, length) = (self.constant_arm(leg), self.length(leg));
        Vector::new(arm.x / length, arm.y / length)
    }

    /// The direction of a leg of a placed dyad from the outer joint to the inner one, in ground axes.
    pub(super) fn direction(&self, placement: &Placement<'a>, leg: &Leg) -> Vector<'a> {
        let direction = self.along_first(placement, leg).turned_by(placement.direction(leg.link()));
        if leg.is_constant(self.model) || self.arm(leg).lean.y.is_zero() {
            return direction;
        }
        let (name, from, to) = (self.link_name(leg), self.joint_name(leg.outer), self.joint_name(self.inner));
        direction.named_direction(&name, &format!("direction of {name} from {from} to {to}"))
    }

    /// The same along and across the direction that its first link carries.
    fn along_first(&self, placement: &Placement<'a>, leg: &Leg) -> Vector<'a> {
        if leg.is_constant(self.model) {
            return placement.carried(leg.link(), self.axis(leg));
        }
        let Arm { axis, lean, .. } = self.arm(leg);
        lean.turned_by(placement.carried(leg.link(), axis))
    }

    /// Whether a leg of constant length has several links.
    pub(super) fn is_composed(&self, leg: &Leg) -> bool {
        !leg.is_single() && leg.is_constant(self.model)
    }

    /// The direction of a leg, of several links brought to unit size by its difference from it. What such links pass on to each other is
    /// resolved along the leg and turned back: what is left of the size would come in twice, and count against all loads.
    pub(super) fn refined(&self, leg: &Leg, direction: Vector<'a>) -> Vector<'a> {
        if !self.is_composed(leg) {
            return direction;
        }
        let (link, graph) = (self.link_name(leg), &self.model.graph);
        let nearly =
            direction.named_direction(&format!("nearly_{link}"), &format!("direction of {link} but for its size"));
        let missing = graph.constant(&Number::ratio(1, 2)) * (graph.one() - nearly.squared());
        nearly + nearly.scaled(missing.named(format!("missing_{link}"), format!("(1 − u·u)/2, u = nearly_{link}")))
    }

    /// Places the links of a leg whose direction from the outer joint to the inner one is known. Gives that direction as it is kept.
    pub(super) fn orient(
        &self,
        assembly: &mut Assembly<'a>,
        leg: &Leg,
        direction: Vector<'a>,
    ) -> Result<Vector<'a>, Diagnostic> {
        if leg.is_constant(self.model) {
            assembly.placement.orient(leg.link(), Orientation { direction, axis: self.axis(leg) });
            self.place_rest(assembly, leg, leg.link())?;
            return Ok(self.direction(&assembly.placement, leg));
        }
        let arm = self.arm(leg);
        let first = &self.model.link(leg.link()).name;
        let meaning = format!("direction of {first}, from that of {}", self.link_name(leg));
        let turned = arm.lean.conjugate().turned_by(direction);
        // Off the line, the direction is not only turned round.
        let turned = if arm.lean.y.is_zero() {
            turned
        } else {
            assembly.leans.push(arm.lean);
            let rough = turned.named_direction(&format!("rough_{first}"), "turned back by the arm's direction");
            towards_unit(rough, &first.text)
        };
        let carried = turned.named_direction(&first.text, &meaning);
        assembly.placement.orient(leg.link(), Orientation { direction: carried, axis: arm.axis });
        self.place_rest(assembly, leg, leg.link())?;
        let direction = self.direction(&assembly.placement, leg);
        // Multiplied out, the first link's own direction would come in twice. No divisor: a leg may lie across its first link.
        let carried = assembly.placement.turned(leg.link(), arm.axis);
        assembly.pivots.state(carried, direction, Some(arm.lean.y), Some(arm.lean.x));
        Ok(direction)
    }

    /// States the angle from what the first link of a driven leg carries to another direction, by that from the leg itself, given as its cosine
    /// and sine. Where the two fold and the leg lies across its first link, the product of the directions would be rounding alone.
    pub(super) fn state_carried(
        &self,
        assembly: &mut Assembly<'a>,
        leg: &Leg,
        other: Vector<'a>,
        from_leg: Vector<'a>,
    ) {
        let Arm { axis, lean, .. } = self.arm(leg);
        let carried = assembly.placement.turned(leg.link(), axis);
        let angle = from_leg.turned_by(lean);
        assembly.pivots.state(carried, other, Some(angle.y), Some(angle.x));
    }

    /// The other links of a leg as groups of their own, in the order in which they are placed from one of its links.
    fn joined(&self, leg: &Leg, first: LinkId, input: impl Fn(DriveId) -> Input) -> Vec<(&'static dyn Rule, Group)> {
        let group = |(joint, link): (JointId, LinkId)| {
            let inputs = self.model.drives_of(joint).map(&input).collect();
            let group = Group { links: vec![link], inner: Vec::new(), outer: vec![joint], inputs };
            (rigid_rule(self.model, joint), group)
        };
        leg.joined_to(self.model, first).into_iter().map(group).collect()
    }

    /// Places the other links of a leg from one of them.
    pub(super) fn place_rest(&self, assembly: &mut Assembly<'a>, leg: &Leg, placed: LinkId) -> RuleResult {
        self.joined(leg, placed, Input::Drive).iter().try_for_each(|(rule, group)| rule.place(assembly, group))
    }

    /// The moment of the loads on a leg about its outer joint, times a factor.
    pub(super) fn moment(&self, balance: &Balance<'a, '_>, leg: &Leg, factor: Expr<'a>) -> Expr<'a> {
        self.moment_on(balance, (leg, &leg.links), leg.near, factor)
    }

    /// The same of some of its links, about one of its joints.
    fn moment_on(
        &self,
        balance: &Balance<'a, '_>,
        (leg, links): (&Leg, &[LinkId]),
        joint: Spot,
        factor: Expr<'a>,
    ) -> Expr<'a> {
        let placement = balance.placement;
        let moments = links.iter().map(|link| {
            if *link == joint.end.link {
                return balance.moment(*link, placement.point(joint), factor);
            }
            if balance.is_free(*link) {
                return balance.graph().zero();
            }
            // About a place on the link, and with the arm of that place.
            let at = if self.is_loaded_within(balance, leg, *link) {
                self.place_within(leg, *link)
            } else {
                self.place_on(leg, *link)
            };
            let direction = placement.direction(*link);
            let arm = placement.way(joint, at).resolved_along(direction).scaled(factor);
            let force = balance.total(*link).along(direction);
            balance.moment(*link, placement.point(at), factor) + arm.cross(force)
        });
        moments.reduce(|sum, moment| sum + moment).unwrap_or_else(|| balance.graph().zero())
    }

    /// How the pins of a leg share the loads on it across the line between them.
    ///
    /// What a joint within the leg passes on may be small beside the loads on either side of it, and what those leave over of the pins'
    /// forces would be their rounding. It is found from moments: with m₁ that of the loads on the outer side about the outer pin, m₂ that
    /// of the loads on the inner side about the inner one, the outer side passes on `(m₁ + m₂)/r` across the leg, and each pin holds the
    /// rest of its own side. Where the loads of the inner side act close to that joint, far from the inner pin, this may have little of them to
    /// hold, too: then its part is found from moments about the outer pin.
    pub(super) fn share(&self, balance: &Balance<'a, '_>, leg: &Leg) -> Share<'a> {
        let factor = balance.graph().one() / self.length(leg);
        let Some((joint, from, towards)) = leg.cut(self.model, balance) else {
            return Share { inner: self.moment(balance, leg, factor), cut: None };
        };
        let outer_side = leg.held_without(self.model, leg.link(), joint);
        let (outer, inner): (Vec<LinkId>, Vec<LinkId>) = leg.links.iter().partition(|link| outer_side.contains(link));
        let sides = [(&outer, leg.near, leg.outer), (&inner, leg.tip, self.inner)];
        let moments = sides.map(|(links, spot, pin)| {
            let moment = self.moment_on(balance, (leg, links), spot, balance.graph().one());
            let names = self.model.link_names(links);
            let name = format!("moment_{}", names.replace(" + ", "_"));
            moment.named(balance.name(&name), format!("ΣM({}) of the loads on {names}", self.joint_name(pin)))
        });
        let across = ((moments[0] + moments[1]) * factor).named(
            balance.name(&format!("{}_across_{}", self.joint_name(joint), self.link_name(leg))),
            format!("the moments over |{} {}|", self.joint_name(leg.outer), self.joint_name(self.inner)),
        );
        let tip = leg.tip.end.link;
        let tip_alone = inner.iter().all(|link| *link == tip || balance.is_free(*link));
        let about_outer = (tip_alone && self.is_loaded_within(balance, leg, tip)).then(|| {
            let moment = moments[0] + self.moment_on(balance, (leg, &inner), leg.near, balance.graph().one());
            moment * factor
        });
        let [outer, inner] = [outer, inner].map(|links| total_on(balance, &links));
        let inner = inner.along(self.direction(balance.placement, leg));
        let moment = moments[usize::from(from != leg.link())];
        let cut = Cut { from, towards, across, outer, along: inner.x, moment };
        Share { inner: about_outer.unwrap_or(across + inner.y), cut: Some(cut) }
    }

    /// Whether all loads on the link of a leg's inner pin act close to the joint within the leg.
    fn is_loaded_within(&self, balance: &Balance<'a, '_>, leg: &Leg, link: LinkId) -> bool {
        let within = balance.placement.point(self.place_within(leg, link));
        let tip = balance.placement.point(leg.tip);
        self.pinned && leg.tip.end.link == link && balance.all_act_close_to(link, within, tip)
    }

    /// A joint's place on a link of a leg: the inner joint's where that is a pin; the point of a slide may be far away.
    fn place_on(&self, leg: &Leg, link: LinkId) -> Spot {
        if leg.tip.end.link == link && self.pinned { leg.tip } else { self.place_within(leg, link) }
    }

    /// The place on a link of a leg of a joint that is not the inner one.
    fn place_within(&self, leg: &Leg, link: LinkId) -> Spot {
        let ends = leg.rigid.iter().filter_map(|joint| self.model.joint(*joint).end_on(link));
        ends.last().map_or(leg.near, Spot::from)
    }

    /// The inner pin exerts a force on a leg, and the opposite one on the other leg. Gives the force on the leg as it was named.
    pub(super) fn pin_inner(&self, balance: &mut Balance<'a, '_>, leg: &Leg, force: Framed<'a>) -> Framed<'a> {
        let force = balance.pin(self.inner, leg.tip.end.link, force);
        if !leg.is_single() {
            balance.push(leg.tip.end.link, balance.placement.point(leg.tip), force);
        }
        force
    }

    /// The inner slide holds the force `across` that acts on a leg across it, and the moment of its loads about its outer pin; the other
    /// leg gets the opposite.
    pub(super) fn guide_inner(&self, balance: &mut Balance<'a, '_>, leg: &Leg, across: Expr<'a>) {
        let pin = balance.placement.point(leg.near);
        if leg.is_single() {
            super::slide::guide(balance, self.inner, leg.link(), across, pin);
            return;
        }
        let link = leg.tip.end.link;
        let own = self.place_within(leg, link);
        let way = balance.placement.way(leg.near, own).resolved_along(balance.placement.line(self.inner));
        let arm = way.x - balance.placement.ahead_of_slide(self.inner, link, balance.placement.point(own));
        let moment = self.moment(balance, leg, balance.graph().one());
        super::slide::react(balance, self.inner, link, across, (moment, -arm));
        // What it exerts on the leg itself: the opposite of what the other link got.
        balance.push(link, balance.placement.slide_point(self.inner, link), self.guided(balance, leg));
        balance.couple(link, arm * across - moment);
    }

    /// What the inner slide exerts on a leg.
    pub(super) fn guided(&self, balance: &Balance<'a, '_>, leg: &Leg) -> Framed<'a> {
        let reaction = balance.reaction(self.inner).force;
        if self.model.joint(self.inner).to.link == leg.tip.end.link { reaction } else { reaction.opposite() }
    }

    /// The inner pin exerts a force on a leg that two pins hold: gives it as it was named. The links of the leg get it from
    /// [`Self::balance_shared`].
    pub(super) fn name_inner(&self, balance: &mut Balance<'a, '_>, leg: &Leg, force: Framed<'a>) -> Framed<'a> {
        balance.name_pin(self.inner, leg.tip.end.link, force)
    }

    /// The reaction of the outer pin of a leg that two pins hold, and what is within the leg, by the force of the inner pin on it and the
    /// loads on its first link.
    pub(super) fn balance_shared(
        &self,
        balance: &mut Balance<'a, '_>,
        (leg, share): (&Leg, &Share<'a>),
        force: Framed<'a>,
        loads: Framed<'a>,
    ) -> RuleResult {
        let (outer, first) = (leg.outer, leg.link());
        if leg.is_single() {
            let held = self.single_outer(balance, (leg, force), loads);
            balance.pin(outer, first, held);
            return Ok(());
        }
        // Along and across the leg the forces are known each to its own size. In ground axes the rounding of the larger would be in both.
        let along = force.along(self.direction(balance.placement, leg)).x;
        let own = |along, across| self.in_own_axes(balance.placement, leg, Vector::new(along, across));
        let (pin, tip) = (own(along, -share.inner), balance.placement.point(leg.tip));
        let Some(cut) = share.cut else {
            balance.push(leg.tip.end.link, tip, pin);
            return self.balance_rest(balance, leg);
        };
        let (link, moment) = (cut.from, cut.moment);
        let passed = own(along + cut.along, -cut.across);
        if link != first {
            let held = Held { link, pin: tip, reaction: pin, passed, moment };
            self.balance_towards(balance, leg, cut.towards, Some(held))?;
            self.hold(balance, leg);
            return Ok(());
        }
        let (near, ground) = (balance.placement.point(leg.near), balance.placement.direction(GROUND));
        let reaction = balance.pin(outer, first, passed.plus(&cut.outer, ground).opposite());
        balance.push(leg.tip.end.link, tip, pin);
        let held = Held { link, pin: near, reaction, passed: passed.opposite(), moment };
        self.balance_towards(balance, leg, cut.towards, Some(held))
    }

    /// The force of the outer pin on a leg of one link: what the loads and the inner pin's force leave. Where a load acts next to the inner pin,
    /// both may be large and leave next to nothing, with their rounding, which a link that the drive moves would pass on: there it is, across
    /// the leg, the loads' moment about the inner pin.
    fn single_outer(
        &self,
        balance: &Balance<'a, '_>,
        (leg, force): (&Leg, Framed<'a>),
        loads: Framed<'a>,
    ) -> Framed<'a> {
        let (link, graph) = (leg.link(), balance.graph());
        let [near, tip] = [leg.near, leg.tip].map(|spot| balance.placement.point(spot));
        if leg.far.end.link == GROUND || !balance.acts_close_to(link, tip, near) {
            return loads.plus(&force, balance.placement.direction(GROUND)).opposite();
        }
        let axes = self.direction(balance.placement, leg);
        let (name, outer, inner) = (self.link_name(leg), self.joint_name(leg.outer), self.joint_name(self.inner));
        let called = |part: Expr<'a>, way: &str, what: &str| {
            part.named(
                balance.name(&format!("{outer}_{way}_{name}")),
                format!("{way} {name}, of the force on {name} at {outer}: {what}"),
            )
        };
        let [loads, force] = [loads, force].map(|force| force.along(axes).x);
        let along =
            called(-(loads + force), "along", &format!("−ΣF of the loads on {name} and of the force at {inner}"));
        let across = balance.moment(link, tip, graph.one() / self.length(leg));
        let across = called(across, "across", &format!("ΣM({inner})/|{outer} {inner}| of the loads on {name}"));
        Framed { components: Vector::new(along, across), axes }
    }

    /// A force along and across a leg, along and across the direction of its first link.
    fn in_own_axes(&self, placement: &Placement<'a>, leg: &Leg, force: Vector<'a>) -> Framed<'a> {
        let components = force.turned_by(self.along_first(placement, leg));
        Framed { components, axes: placement.direction(leg.link()) }
    }

    /// The efforts and welds within a leg, from its ends towards one of its links; for one of the others what it passes on may be known.
    fn balance_towards(
        &self,
        balance: &mut Balance<'a, '_>,
        leg: &Leg,
        link: LinkId,
        held: Option<Held<'a>>,
    ) -> RuleResult {
        let effort = |drive: DriveId| self.model.effort_at(drive).map_or(Input::Drive(drive), Input::Unknown);
        self.joined(leg, link, effort).iter().rev().try_for_each(|(rule, group)| {
            if let Some(held) = held.filter(|held| group.links == [held.link]) {
                group.outer.iter().for_each(|joint| held.reduce(balance, *joint));
            }
            rule.balance(balance, group)
        })
    }

    /// The efforts and welds within a leg and the reaction of its outer joint, once the force of its inner joint is on it.
    pub(super) fn balance_rest(&self, balance: &mut Balance<'a, '_>, leg: &Leg) -> RuleResult {
        self.balance_towards(balance, leg, leg.link(), None)?;
        self.hold(balance, leg);
        Ok(())
    }

    /// The reaction of the outer joint of a leg.
    fn hold(&self, balance: &mut Balance<'a, '_>, leg: &Leg) {
        let (link, held) = (leg.link(), balance.total(leg.link()));
        if leg.pinned {
            balance.pin(leg.outer, link, held.opposite());
        } else {
            let across = held.along(balance.placement.slide_direction(leg.outer)).y;
            super::slide::guide(balance, leg.outer, link, across, balance.placement.point(self.place_on(leg, link)));
        }
    }

    /// The velocity of the inner pin as a leg has it: of one that is driven along a slot of the leg, with what that adds.
    pub(super) fn velocity_of_pin(&self, motion: &Motion<'a, '_>, leg: &Leg) -> Framed<'a> {
        let joint = self.model.joint(self.inner);
        match (leg.tip.slot, joint.end_off(leg.tip.end.link)) {
            (Some(_), Some(pin)) => motion.passed_on(self.inner, pin.link),
            _ => motion.of_point(leg.tip.end),
        }
    }

    /// Moves a leg about its outer joint: its first link turns at this rate, the others as their drives say.
    pub(super) fn turn(&self, motion: &mut Motion<'a, '_>, leg: &Leg, rate: Expr<'a>) -> RuleResult {
        let (at, velocity) = (motion.placement.point(leg.near), motion.passed_on(leg.outer, leg.link()));
        motion.found(leg.link(), Twist { rate, at, velocity });
        self.follow_rest(motion, leg, leg.link())
    }

    /// The motion of the other links of a leg, once that of one of them is found.
    pub(super) fn follow_rest(&self, motion: &mut Motion<'a, '_>, leg: &Leg, found: LinkId) -> RuleResult {
        self.joined(leg, found, Input::Drive).iter().try_for_each(|(rule, group)| rule.follow(motion, group))
    }

    pub(super) fn pivot_name(&self) -> String {
        format!("sin_mu_{}", self.joint_name(self.inner))
    }

    /// The name of the cosine of the same angle.
    pub(super) fn cosine_name(&self) -> String {
        format!("cos_mu_{}", self.joint_name(self.inner))
    }

    /// States the sine between two slides; at a pose it divides what places the dyad. Slides that are always parallel guide nothing.
    pub(super) fn state_slides(
        &self,
        assembly: &mut Assembly<'a>,
        slides: [JointId; 2],
    ) -> Result<(Expr<'a>, Expr<'a>), Diagnostic> {
        let between = assembly.placement.between(slides);
        let [first, second] = slides.map(|slide| self.joint_name(slide));
        let sine = between.y.named(self.pivot_name(), format!("sine between the slides {first} and {second}"));
        let pivot = significant(sine, sine.graph().one());
        if pivot.is_zero() {
            let problem = format!(
                "the slides `{first}` and `{second}` are parallel: where {} lie along them is open at every pose",
                crate::diagnostics::list(&self.group_name().split(" + ").collect::<Vec<_>>())
            );
            let place = self.model.joint(slides[1]).name.place();
            return Err(Diagnostic::new(place, problem).help("turn one of them, so that it guides another way"));
        }
        let pivot = pivot
            .named(format!("{}_or_zero", self.pivot_name()), "zero where it is no larger than its rounding")
            .held();
        let [from, to] = slides.map(|slide| assembly.placement.slide_direction(slide));
        assembly.pivots.state(from, to, Some(pivot), None);
        assembly.dyads.push(DyadPivot::sine(self.model, self.inner, pivot, None));
        Ok((between.x, divisor(pivot, &self.pivot_name(), &self.group_name())))
    }

    /// The travel of a slide, of one of its links from the other one along its direction.
    pub(super) fn set_travel(&self, assembly: &mut Assembly<'a>, slide: JointId, of: LinkId, by: Expr<'a>) {
        let travel = if self.model.joint(slide).to.link == of { by } else { -by };
        let name = self.joint_name(slide);
        let travel = travel.named(assembly.placement.name_of_travel(slide), format!("travel of the slide {name}"));
        assembly.placement.set_travel(slide, travel);
    }

    /// The vector between a leg's joints, worked out with its first link lying along the x axis.
    fn arm(&self, leg: &Leg) -> Arm<'a> {
        let graph = &self.model.graph;
        let axis = self.arm_axis(leg);
        let way = self.way_within(leg, leg.link(), axis);
        let name = self.link_name(leg);
        let (from, to) = (self.joint_name(leg.outer), self.joint_name(self.inner));
        let first = &self.model.link(leg.link()).name;
        let meaning = format!("from {from} to {to}, along and across what {first} carries");
        let along = way.vector().named(&format!("arm_{name}"), &meaning);
        let on_line = along.y.is_zero();
        let size = if on_line { along.x.abs() } else { along.size() };
        let size = size.named(format!("length_{name}"), format!("|{from} {to}|"));
        // Joints that meet leave the direction of the body open.
        let (group, joint) = (self.model.link_names(&leg.links), self.joint_name(self.inner).into());
        let failure = Failure::CoincidentPivots { group, joint };
        let least = graph.epsilons(4) * way.length();
        let apart = |value: Expr<'a>| value.require_above(size, least, failure.clone());
        let size = apart(size).known_positive();
        let lean = if on_line {
            // Behind the check the sign is certain: a sum of up to seven parts along the line is off by less than the check's limit.
            let sense = graph.integer(2).where_above(along.x, graph.zero()) - graph.one();
            let meaning = format!("1 where {to} lies ahead of {from}, −1 where it lies behind");
            Vector::new(apart(sense.named(format!("sense_{name}"), meaning)), graph.zero())
        } else {
            // What is resolved along the body and back has the square of this direction's size, against all loads: the rounding of the length
            // is taken out again.
            let lean = format!("lean_{name}");
            let meaning = format!("from {from} to {to} over length_{name}, along and across what {first} carries");
            let rough = Vector::new((along.x / size).divided(), (along.y / size).divided());
            let rough = rough.named_direction(&format!("rough_{lean}"), &meaning);
            towards_unit(rough, &lean).named_direction(&lean, "the same, of unit size")
        };
        Arm { axis, along, size, lean }
    }

    /// What the first link of a body carries: the direction of its driven slide or slot, so that what lies along that stays so.
    fn arm_axis(&self, leg: &Leg) -> Vector<'a> {
        let graph = &self.model.graph;
        let x_axis = Vector::new(graph.one(), graph.zero());
        let mut pins = [leg.near, leg.tip].into_iter().filter(|spot| spot.end.link == leg.link());
        if let Some(slot) = pins.find_map(|spot| spot.slot) {
            return self.model.joint(slot).kind.line().map_or(x_axis, |(_, axis)| axis.vector(graph));
        }
        let slides = |joint: &JointId| {
            let joint = self.model.joint(*joint);
            joint.kind.line().is_some() && joint.end_on(leg.link()).is_some()
        };
        let slide = leg.rigid.iter().copied().find(slides);
        slide.map_or(x_axis, |slide| Placement::of_ground(self.model).slide_axis(slide, leg.link()))
    }

    /// The way through a leg from its outer joint to the place of the inner slide on it, along and across that.
    pub(super) fn way_to_slide(&self, placement: &Placement<'a>, leg: &Leg) -> Way<'a> {
        let link = leg.tip.end.link;
        let mut way = self.way_within(leg, link, placement.slide_axis(self.inner, link));
        way.go_on(placement.ahead_of_own(self.inner, leg.tip.end));
        way
    }

    /// The way through a body from its outer joint to its inner one, with one of its links lying so that a direction in its frame is
    /// along the x axis.
    fn way_within(&self, leg: &Leg, supposed: LinkId, axis: Vector<'a>) -> Way<'a> {
        let graph = &self.model.graph;
        let x_axis = Vector::new(graph.one(), graph.zero());
        let mut placement = Placement::of_ground(self.model);
        placement.suppose(supposed, Orientation { direction: x_axis, axis });
        for (joint, link) in leg.joined_to(self.model, supposed) {
            let orientation = match self.model.joint(joint).kind {
                JointKind::Revolute => {
                    let turn =
                        self.model.drive_of(joint, true).map_or(graph.zero(), |d| graph.symbol(Symbol::Drive(d)));
                    placement.driven(joint, link, turn)
                }
                _ => placement.along_slide(joint, link),
            };
            placement.suppose(link, orientation);
            placement.connect(joint);
        }
        placement.way(leg.near, leg.tip)
    }
}

/// `(a − b)` as text, without a term that is zero.
pub(super) fn difference([(first, a), (second, b)]: [(Expr<'_>, String); 2]) -> String {
    match (first.is_zero(), second.is_zero()) {
        (false, false) => format!("({a} − {b})"),
        (_, true) => a,
        (true, false) => format!("−{b}"),
    }
}
