//! Any other group: its links are placed by iteration, its forces found by block elimination of its equilibrium equations.
//!
//! A link that is held by two pins alone, or by a pin and a slide, and on which no unknown acts, is a *member*: the moment about one
//! pin, or the force along the slide, gives one part of the force at its end, and a single number `N` is left, the force along the
//! member or across its slide. The other links are *carriers* with three equations each, and a pin between two members adds the two
//! of its own balance. The remaining unknowns are eliminated by constants down to a core, which is solved with pivoting. A carrier that
//! hangs on members alone is resolved along and across one of them, with moments about its pin, so that its number is one of those: a
//! ternary link on three members leaves two equations.
//!
//! The virtual velocities of the carriers and the pins are the solution of the transposed equations.

use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::equations::joints::Component;
use crate::graph::{Expr, Vector};
use crate::model::ids::{GROUND, JointId, LinkId};
use crate::model::{JointKind, Model};
use crate::plan::assembly::Assembly;
use crate::plan::balance::{Balance, is_close};
use crate::plan::efforts::{self, Unit};
use crate::plan::framed::Framed;
use crate::plan::linear::{CORE, Core, Equation, solve};
use crate::plan::placement::Placement;
use crate::plan::reactions;
use crate::plan::velocities::{Motion, Twist};
use crate::topology::{Group, Input};

/// The rule.
pub(crate) struct Block;

/// A link with a single number left.
#[derive(Clone, Copy, Debug)]
struct Member {
    link: LinkId,
    /// The end at which its number acts.
    near: JointId,
    /// The other end: a pin, or a slide.
    far: JointId,
    /// Whether both ends are on links of the group.
    within: bool,
}

/// What a column of the equations stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unknown {
    /// The number of a member.
    Member(usize),
    /// A component of the reaction of a joint that no member has, in the order of [`reactions::parts`].
    Joint(JointId, usize),
    /// An effort.
    Effort(Input),
}

/// What has equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Free {
    /// A carrier: force along x and y, moment about its first joint.
    Carrier(LinkId),
    /// A pin between two members: force along x and y.
    Pin(JointId),
}

/// A force, or a couple, of unit size or known.
#[derive(Clone, Copy, Debug)]
enum Act<'m> {
    Force(LinkId, Vector<'m>, Framed<'m>),
    Couple(LinkId, Expr<'m>),
    /// On the pin between two members.
    Pin(JointId, Framed<'m>),
}

impl<'m> From<efforts::Act<'m>> for Act<'m> {
    fn from(act: efforts::Act<'m>) -> Self {
        match act {
            efforts::Act::Force(link, at, force) => Self::Force(link, at, force),
            efforts::Act::Couple(link, moment) => Self::Couple(link, moment),
        }
    }
}

/// A group taken apart.
struct Parts<'p, 'm> {
    placement: &'p Placement<'m>,
    model: &'m Model,
    members: Vec<Member>,
    unknowns: Vec<Unknown>,
    free: Vec<Free>,
}

impl<'p, 'm> Parts<'p, 'm> {
    fn of(placement: &'p Placement<'m>, group: &Group) -> Self {
        let model = placement.model;
        let members = members(model, group);
        let is_member = |link: LinkId| members.iter().any(|m| m.link == link);
        let mut unknowns: Vec<Unknown> = (0..members.len()).map(Unknown::Member).collect();
        let mut free: Vec<Free> =
            group.links.iter().filter(|link| !is_member(**link)).map(|link| Free::Carrier(*link)).collect();
        for joint in group.outer.iter().chain(&group.inner) {
            let ends = model.joint(*joint).ends().map(|end| is_member(end.link));
            match ends {
                [true, true] => free.push(Free::Pin(*joint)),
                [false, false] => {
                    let parts = reactions::parts(placement, *joint).len();
                    unknowns.extend((0..parts).map(|part| Unknown::Joint(*joint, part)));
                }
                _ => {}
            }
        }
        unknowns.extend(group.inputs.iter().copied().map(Unknown::Effort));
        Self { placement, model, members, unknowns, free }
    }

    fn ground(&self) -> Vector<'m> {
        self.placement.direction(GROUND)
    }

    fn is_member(&self, link: LinkId) -> bool {
        self.members.iter().any(|m| m.link == link)
    }

    fn is_slide(&self, joint: JointId) -> bool {
        matches!(self.model.joint(joint).kind, JointKind::Prismatic { .. })
    }

    /// Whether the force of a pin was found from another member.
    fn found_before(&self, joint: JointId, on: LinkId) -> bool {
        let first = self.members.iter().find(|m| m.near == joint || m.far == joint).map(|m| m.link);
        self.is_member(self.other(joint, on)) && first != Some(on)
    }

    /// The place of a joint on a link, along and across its direction.
    fn place(&self, joint: JointId, link: LinkId) -> Vector<'m> {
        self.placement.slide_point(joint, link)
    }

    fn other(&self, joint: JointId, link: LinkId) -> LinkId {
        let data = self.model.joint(joint);
        if data.from.link == link { data.to.link } else { data.from.link }
    }

    /// The length of a member between its pins, and its direction towards the near one.
    fn rod(&self, member: &Member) -> (Expr<'m>, Vector<'m>) {
        let end = |joint: JointId| {
            let data = self.model.joint(joint);
            data.end_on(member.link).unwrap_or(data.from)
        };
        let (far, near) = (end(member.far), end(member.near));
        let length = super::length_between(self.model, member.link, [member.far, member.near]);
        let arm = self.model.local(near) - self.model.local(far);
        let direction = self.placement.turned(member.link, Vector::new(arm.x / length, arm.y / length));
        (length, direction)
    }

    /// What acts on the neighbour at a joint when this force acts on the member there.
    fn passed_on(&self, joint: JointId, member: LinkId, force: Framed<'m>) -> Act<'m> {
        let neighbour = self.other(joint, member);
        if self.is_member(neighbour) {
            return Act::Pin(joint, force.opposite());
        }
        Act::Force(neighbour, self.place(joint, neighbour), force.opposite())
    }

    /// What the unit of a member's number does to its neighbours, if nothing else acts on it.
    fn unit_of_member(&self, member: &Member) -> Vec<Act<'m>> {
        let [near, far] = self.units_at_ends(member);
        near.into_iter().chain(far).collect()
    }

    /// The same at its near end and at its far one.
    fn units_at_ends(&self, member: &Member) -> [Vec<Act<'m>>; 2] {
        let (one, zero) = (self.placement.graph().one(), self.placement.graph().zero());
        if self.is_slide(member.far) {
            // Across the slide at the pin; the guide holds it at the runner, and holds its moment.
            let axes = self.placement.slide_direction(member.far);
            let normal = Framed { components: Vector::new(zero, one), axes };
            let arm = self.slide_arm(member);
            let guide = self.other(member.far, member.link);
            let held = vec![Act::Force(guide, self.place(member.far, guide), normal), Act::Couple(guide, arm.x)];
            return [vec![self.passed_on(member.near, member.link, normal)], held];
        }
        let (_, axes) = self.rod(member);
        let along = Framed { components: Vector::new(one, zero), axes };
        [(member.near, along), (member.far, along.opposite())]
            .map(|(end, force)| vec![self.passed_on(end, member.link, force)])
    }

    /// From the place of a slide on its slider to the slider's pin, along and across the slide.
    fn slide_arm(&self, member: &Member) -> Vector<'m> {
        let pin = self.place(member.near, member.link);
        let across =
            self.placement.slide_along_on(member.far, member.link).cross(pin - self.place(member.far, member.link));
        Vector::new(self.placement.ahead_of_slide(member.far, member.link, pin), across)
    }

    /// What the unit of an unknown does to carriers, pins and links outside.
    fn unit(&self, unknown: Unknown) -> Vec<Act<'m>> {
        match unknown {
            Unknown::Member(index) => self.unit_of_member(&self.members[index]),
            Unknown::Joint(joint, part) => {
                let data = self.model.joint(joint);
                let (first, second) = (data.from.link, data.to.link);
                let Some(unit) = reactions::parts(self.placement, joint).into_iter().nth(part) else {
                    return Vec::new();
                };
                let [on_first, on_second] = unit.couples;
                vec![
                    Act::Force(second, self.place(joint, second), unit.force),
                    Act::Force(first, self.place(joint, first), unit.force.opposite()),
                    Act::Couple(second, on_second),
                    Act::Couple(first, on_first),
                ]
            }
            Unknown::Effort(effort) => self.unit_of_effort(effort).acts.into_iter().map(Act::from).collect(),
        }
    }

    fn unit_of_effort(&self, effort: Input) -> Unit<'m> {
        Unit::of(self.placement, effort)
    }

    /// How much larger than that of declared directions the rounding of the efforts' directions may be.
    fn spread(&self) -> Expr<'m> {
        let one = self.placement.graph().one();
        self.unknowns.iter().fold(one, |spread, unknown| match unknown {
            Unknown::Effort(effort) => spread * self.unit_of_effort(*effort).spread,
            _ => spread,
        })
    }

    /// The power of an unknown's unit if the motion keeps the joints: none of a velocity. Of an acceleration it is what curved paths and
    /// sliding along turning lines bring.
    fn beyond(&self, motion: &Motion<'m, '_>, unknown: Unknown) -> Expr<'m> {
        let zero = self.placement.graph().zero();
        match unknown {
            Unknown::Member(index) => {
                let member = &self.members[index];
                if self.is_slide(member.far) {
                    // n·(a_pin − a_guide) − α x = 2 ω ṡ − ω² y at the pin (x, y) from the runner.
                    let coriolis = motion.coriolis(member.far, member.link).components.y;
                    let held = motion.centripetal(member.link, self.slide_arm(member).y) - coriolis;
                    // A parameter may move the pin in its link, and turn the link in its guide.
                    let arm = self.place(member.near, member.link) - self.place(member.far, member.link);
                    let axes = self.placement.direction(member.link);
                    let moved = Framed { components: motion.within(member.link, arm), axes };
                    let across = motion.part(&moved, self.placement.slide_direction(member.far).perp());
                    let turned = motion.turned_by(member.far, member.link);
                    return held - across - turned * self.slide_arm(member).x;
                }
                // u·(a_near − a_far) = −ω² r, and where a parameter changes the length its rate.
                let length = self.rod(member).0;
                motion.centripetal(member.link, length) - motion.change_of(length)
            }
            Unknown::Joint(joint, part) => {
                let component = reactions::parts(self.placement, joint).get(part).map(|part| part.component);
                let data = self.model.joint(joint);
                match (component, data.kind) {
                    (Some(Component::Couple), _) => motion.turned_by(joint, data.to.link),
                    (Some(Component::Normal), _) => motion.coriolis(joint, data.to.link).components.y,
                    // The centres turn about each other.
                    (Some(Component::Tangential), JointKind::Gear(gear)) => {
                        let incline = self.placement.graph().expr(gear.incline);
                        let distance = gear.distance(self.model);
                        let drawn = -(incline * motion.centripetal(gear.arm[0].link, distance));
                        drawn + incline * motion.change_of(distance) + motion.meshing(joint, &gear)
                    }
                    _ => zero,
                }
            }
            Unknown::Effort(_) => zero,
        }
    }

    /// Of a carrier that hangs on members alone, the pin of one of them and the direction of its number.
    fn resolved_at(&self, carrier: LinkId) -> Option<(JointId, Vector<'m>)> {
        let holds = |unknown: &Unknown| match unknown {
            Unknown::Joint(joint, _) => self.model.joint(*joint).end_on(carrier).is_some(),
            Unknown::Member(_) | Unknown::Effort(_) => false,
        };
        if self.unknowns.iter().any(holds) {
            return None;
        }
        let on = |joint: JointId| self.model.joint(joint).end_on(carrier).is_some();
        let candidates = self.members.iter().filter_map(|member| match (on(member.near), on(member.far)) {
            (true, _) if self.is_slide(member.far) => {
                Some((member, member.near, self.placement.slide_direction(member.far)))
            }
            (true, _) => Some((member, member.near, self.rod(member).1)),
            (_, true) if !self.is_slide(member.far) => Some((member, member.far, self.rod(member).1)),
            _ => None,
        });
        // Moments are taken about this pin: one of two that are close to each other, whose motion would be the difference of what is much larger
        // elsewhere; or else where the link's frame begins, if a member is there, since that is the point that the declaration counts from.
        // Of several there the number of one on the ground is what the others leave: it does no work, and may be far larger than that of one
        // that the drive moves.
        let pins: Vec<Vector<'m>> = candidates.clone().map(|(_, pin, _)| self.place(pin, carrier)).collect();
        let has_close = |pin: JointId| {
            let at = self.place(pin, carrier);
            pins.iter().any(|near| *near != at && pins.iter().any(|far| is_close(*near, at, *far)))
        };
        let rank = |(member, pin, _): &(&Member, JointId, Vector<'m>)| {
            let end = self.model.joint(*pin).end_on(carrier);
            let begins_here = end.is_some_and(|end| self.model.local(end).is_zero());
            let other_end = if *pin == member.near { member.far } else { member.near };
            let rank = match (begins_here, self.other(other_end, member.link) == GROUND) {
                (true, true) => 0,
                (true, false) => 1,
                (false, _) => 2,
            };
            (!has_close(*pin), rank)
        };
        candidates.min_by_key(rank).map(|(_, pin, along)| (pin, along))
    }

    /// The axes in which the forces on a carrier or a pin are resolved.
    fn axes(&self, free: Free) -> Vector<'m> {
        let along = match free {
            Free::Carrier(carrier) => self.resolved_at(carrier).map(|(_, along)| along),
            Free::Pin(_) => None,
        };
        along.unwrap_or_else(|| self.ground())
    }

    /// The member, or the slide of one, along and across which the forces on a carrier are resolved.
    fn hangs_on(&self, free: Free) -> Option<String> {
        let Free::Carrier(carrier) = free else { return None };
        let (pin, _) = self.resolved_at(carrier)?;
        let member = self.members.iter().find(|member| [member.near, member.far].contains(&pin))?;
        let [near, far] = [member.near, member.far].map(|joint| &self.model.joint(joint).name);
        let link = &self.model.link(member.link).name;
        Some(if self.is_slide(member.far) { far.text.clone() } else { format!("{link} from {far} to {near}") })
    }

    /// The place about which a carrier's moments are taken: the pin at which its forces are resolved, or else its first joint, but for
    /// a tooth or a slot, which holds no point.
    fn centre(&self, carrier: LinkId) -> Vector<'m> {
        if let Some((pin, _)) = self.resolved_at(carrier) {
            return self.place(pin, carrier);
        }
        let on = |joint: &JointId| self.model.joint(*joint).end_on(carrier).is_some();
        let holds =
            |joint: &JointId| !matches!(self.model.joint(*joint).kind, JointKind::Slot { .. } | JointKind::Gear(_));
        let joints = || self.model.joint_ids().filter(on);
        let joint = joints().find(holds).or_else(|| joints().next());
        joint.map_or_else(|| self.placement.graph().zero_vector(), |joint| self.place(joint, carrier))
    }

    /// The part of an act in the equations of what is free.
    fn parts_of(&self, act: &Act<'m>, free: Free) -> Option<Vec<Expr<'m>>> {
        match (act, free) {
            (Act::Force(link, at, force), Free::Carrier(carrier)) if *link == carrier => {
                let resolved = force.along(self.axes(free));
                let arm = *at - self.centre(carrier);
                let moment = arm.cross(force.along(self.placement.direction(carrier)));
                Some(vec![resolved.x, resolved.y, moment])
            }
            (Act::Couple(link, moment), Free::Carrier(carrier)) if *link == carrier => {
                let zero = self.placement.graph().zero();
                Some(vec![zero, zero, *moment])
            }
            (Act::Pin(joint, force), Free::Pin(pin)) if *joint == pin => {
                let ground = force.ground();
                Some(vec![ground.x, ground.y])
            }
            _ => None,
        }
    }

    /// The sum of acts in all equations.
    fn column(&self, acts: &[Act<'m>]) -> Vec<Expr<'m>> {
        let zero = self.placement.graph().zero();
        let mut column = Vec::new();
        for free in &self.free {
            let rows = if matches!(free, Free::Carrier(_)) { 3 } else { 2 };
            let mut sum = vec![zero; rows];
            for parts in acts.iter().filter_map(|act| self.parts_of(act, *free)) {
                sum.iter_mut().zip(parts).for_each(|(sum, part)| *sum = *sum + part);
            }
            column.extend(sum);
        }
        column
    }

    fn matrix(&self) -> Vec<Vec<Expr<'m>>> {
        self.unknowns.iter().map(|unknown| self.column(&self.unit(*unknown))).collect()
    }

    fn names(&self, group: &Group) -> (String, String) {
        let links = self.model.link_names(&group.links);
        (format!("det_{}", links.replace(" + ", "_")), links)
    }
}

/// Links with two joints and no unknown, but for a slider whose guide is a member itself.
fn members(model: &Model, group: &Group) -> Vec<Member> {
    let mut members: Vec<Member> = Vec::new();
    let slides = |joint: &JointId| matches!(model.joint(*joint).kind, JointKind::Prismatic { .. });
    let pins = |joint: &JointId| matches!(model.joint(*joint).kind, JointKind::Revolute);
    for link in &group.links {
        let joints: Vec<JointId> = group
            .outer
            .iter()
            .chain(&group.inner)
            .copied()
            .filter(|joint| model.joint(*joint).end_on(*link).is_some())
            .collect();
        let acted_on = group.inputs.iter().any(|input| model.links_of(input.effort(model)).contains(link));
        let [a, b] = joints.as_slice() else { continue };
        if acted_on || ![a, b].into_iter().all(|joint| slides(joint) || pins(joint)) {
            continue;
        }
        // The force on the group comes from the moment about the end outside it. As what that end and the loads leave, it would have their
        // rounding, however small it is.
        let inner = |joint: &JointId| group.inner.contains(joint);
        let (near, far) = if slides(a) || (pins(b) && inner(b) && !inner(a)) { (*b, *a) } else { (*a, *b) };
        let guide = model.joint(far).end_off(*link).map(|end| end.link);
        let guided_by_member = slides(&far) && members.iter().any(|m| Some(m.link) == guide);
        // A link between two slides stays a carrier.
        if !slides(&near) && !guided_by_member {
            members.push(Member { link: *link, near, far, within: inner(a) && inner(b) });
        }
    }
    members
}

impl Rule for Block {
    fn class(&self) -> &'static str {
        "block"
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn fits(&self, _: &Model, _: &Group) -> bool {
        true
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        super::newton::place(assembly, group)
    }

    fn balance<'m>(&self, balance: &mut Balance<'m, '_>, group: &Group) -> RuleResult {
        let parts = Parts::of(balance.placement, group);
        let model = parts.model;
        let (determinant, links) = parts.names(group);
        let graph = balance.graph();
        // What is known of the members' ends, and what acts on carriers.
        for member in parts.members.iter().filter(|member| !parts.is_slide(member.far)) {
            super::check_length(model, member.link, [member.far, member.near])?;
        }
        let ends: Vec<MemberEnds<'_>> =
            parts.members.iter().map(|member| known_ends(balance, &parts, member)).collect();
        let mut acts: Vec<Act<'_>> = ends.iter().flat_map(|ends| ends.acts.clone()).collect();
        for free in &parts.free {
            if let Free::Carrier(link) = free {
                let moment = balance.moment(*link, parts.centre(*link), graph.one());
                acts.push(Act::Force(*link, parts.centre(*link), balance.total(*link)));
                acts.push(Act::Couple(*link, moment));
            }
        }
        let equations = equations(&parts, &acts, &ends);
        let along = |index: usize, value: Expr<'m>| {
            let member = &parts.members[index];
            let (link, near, far) =
                (&model.link(member.link).name, &model.joint(member.near).name, &model.joint(member.far).name);
            let way = if parts.is_slide(member.far) {
                format!("across {far}")
            } else {
                format!("along {link} from {far} to {near}")
            };
            let meaning = format!("{way}, of the force on {link} at {near}: from the equations that are left");
            value.named(balance.name(&format!("along_{link}")), meaning)
        };
        let unknown = |row: usize, value: Expr<'m>| match parts.unknowns.get(row) {
            Some(Unknown::Member(index)) => along(*index, value),
            _ => value,
        };
        let spread = parts.spread();
        let core = Core { name: &determinant, group: &links, spread, refined: true, unknown: &unknown };
        let values = solve(graph, &equations, core).map_err(|size| too_large(model, group, size))?;
        let values: Vec<Expr<'_>> = (0..values.len()).map(|row| unknown(row, values[row])).collect();
        let (values, at_far_ends) = values.split_at(parts.unknowns.len());
        let mut at_far_ends = at_far_ends.iter();
        for (unknown, value) in parts.unknowns.iter().zip(values) {
            match *unknown {
                Unknown::Member(index) => {
                    let far = ends[index].balance.and_then(|_| at_far_ends.next());
                    put_member(balance, &parts, &parts.members[index], &ends[index], (*value, far.copied()));
                }
                Unknown::Joint(joint, 0) => {
                    let own = parts.unknowns.iter().zip(values);
                    let own = own.filter(|(unknown, _)| matches!(unknown, Unknown::Joint(of, _) if *of == joint));
                    put_joint(balance, joint, &own.map(|(_, value)| *value).collect::<Vec<_>>(), &links);
                }
                Unknown::Effort(Input::Unknown(effort)) => {
                    let name = &model.unknown(effort).name;
                    let value = value.named(balance.name(name), format!("from the equilibrium of {links}"));
                    balance.found(effort, value);
                    parts.unit_of_effort(effort.into()).exert_outside(balance, value, &group.links);
                }
                // A joint is recorded with its first component; forces know no drives.
                Unknown::Joint(..) | Unknown::Effort(Input::Drive(_)) => {}
            }
        }
        Ok(())
    }

    fn follow<'m>(&self, motion: &mut Motion<'m, '_>, group: &Group) -> RuleResult {
        let parts = Parts::of(motion.placement, group);
        let (determinant, links) = parts.names(group);
        let graph = motion.graph();
        let columns = parts.matrix();
        // If the carriers neither moved nor turned.
        for free in &parts.free {
            if let Free::Carrier(link) = free {
                let velocity = Framed { components: graph.zero_vector(), axes: parts.ground() };
                motion.found(*link, Twist { rate: graph.zero(), at: parts.centre(*link), velocity });
            }
        }
        // The power of a unit of each unknown on all links is the rate of its coordinate: of an unknown of the joints zero, but for what
        // an acceleration has beyond a velocity.
        let equations: Vec<Equation<'m>> = parts
            .unknowns
            .iter()
            .zip(&columns)
            .map(|(unknown, column)| {
                let own = match *unknown {
                    Unknown::Effort(effort) => motion.rate_of(effort),
                    _ => parts.beyond(motion, *unknown),
                };
                let supposed =
                    parts.unit(*unknown).iter().fold(graph.zero(), |sum, act| sum + power(motion, &parts, act));
                Equation { coefficients: column.clone(), right: own - supposed, gives: None }
            })
            .collect();
        let unknown = |row: usize, value: Expr<'m>| motion_of_free(motion, &parts, row, value);
        let spread = parts.spread();
        let core = Core { name: &determinant, group: &links, spread, refined: false, unknown: &unknown };
        let values = solve(graph, &equations, core).map_err(|size| too_large(parts.model, group, size))?;
        let mut row = 0;
        let mut pins: Vec<(JointId, Framed<'_>)> = Vec::new();
        for free in &parts.free {
            let velocity = Framed { components: Vector::new(values[row], values[row + 1]), axes: parts.axes(*free) };
            match free {
                Free::Carrier(link) => {
                    let name = &parts.model.link(*link).name;
                    let rate = motion.named_rate(values[row + 2], &name.text, "");
                    motion.found(*link, Twist { rate, at: parts.centre(*link), velocity });
                    row += 3;
                }
                Free::Pin(joint) => {
                    pins.push((*joint, velocity));
                    row += 2;
                }
            }
        }
        for member in &parts.members {
            let end = |joint: JointId| {
                let found = pins.iter().find(|(pin, _)| *pin == joint);
                let neighbour = parts.other(joint, member.link);
                found.map_or_else(
                    || motion.of_place(neighbour, parts.place(joint, neighbour)),
                    |(_, velocity)| *velocity,
                )
            };
            let of_near = end(member.near);
            if parts.is_slide(member.far) {
                follow_slider(motion, &parts, member, of_near);
            } else {
                let twist = twist_of_rod(motion, &parts, member, [of_near, end(member.far)]);
                motion.found(member.link, twist);
            }
        }
        Ok(())
    }
}

// Velocities within the group may be large, and leave their rounding in that of a slow member, which may be loaded where that tells. Where the
// far end is on a link that was found before, what that link does with a rod along it, with a slider across the slide, has none of that.

/// The motion of a rod from the velocities of the pins at its near end and at its far one.
fn twist_of_rod<'m>(
    motion: &Motion<'m, '_>,
    parts: &Parts<'_, 'm>,
    member: &Member,
    [of_near, of_far]: [Framed<'m>; 2],
) -> Twist<'m> {
    let (link, name) = (member.link, &parts.model.link(member.link).name);
    let [near, far] = [member.near, member.far].map(|joint| parts.place(joint, link));
    let (length, axes) = parts.rod(member);
    // The far end's, and what a change of the rod adds to it.
    let change = Framed { components: motion.within(link, near - far), axes: motion.placement.direction(link) };
    let far_and_change = of_far.plus(&change, parts.ground());
    let gap = motion.difference(&of_near, &far_and_change);
    let rate = motion.named_rate(motion.part(&gap, axes.perp()) / length, &name.text, "");
    if member.within {
        return Twist { rate, at: near, velocity: of_near };
    }
    if of_far.components.is_zero() {
        return Twist { rate, at: far, velocity: of_far };
    }
    let along = motion.part(&far_and_change, axes) - motion.centripetal(link, length);
    let components = Vector::new(along, motion.part(&of_near, axes.perp()));
    Twist { rate, at: near, velocity: Framed { components, axes } }
}

/// The motion of a slider from the velocity of its pin, and how fast it slides.
fn follow_slider<'m>(motion: &mut Motion<'m, '_>, parts: &Parts<'_, 'm>, member: &Member, of_near: Framed<'m>) {
    let (link, name) = (member.link, &parts.model.link(member.link).name);
    let at = parts.place(member.near, link);
    let carried = motion.carried(member.far, link);
    let rate = motion.named_rate(carried.rate, &name.text, "");
    if member.within {
        motion.found(link, Twist { rate, at, velocity: of_near });
        return;
    }
    motion.found(link, Twist { rate, ..carried });
    let (axes, guided) = (motion.placement.slide_direction(member.far), motion.of_place(link, at));
    let [along, guided_along] = [of_near, guided].map(|velocity| motion.part(&velocity, axes));
    let sliding = motion.named_sliding(along - guided_along, member.far, &name.text, "");
    let along = if guided_along.is_zero() { sliding } else { along };
    let components = Vector::new(along, motion.part(&guided, axes.perp()));
    motion.found(link, Twist { rate, at, velocity: Framed { components, axes } });
    motion.records(member.far, link, sliding);
}

/// The number of a free body or a pin that the core gives, as a named quantity: the components in which its motion is resolved, and of a
/// body also the rate.
fn motion_of_free<'m>(motion: &Motion<'m, '_>, parts: &Parts<'_, 'm>, row: usize, value: Expr<'m>) -> Expr<'m> {
    let mut first = 0;
    for free in &parts.free {
        let (name, count) = match free {
            Free::Carrier(link) => (&parts.model.link(*link).name, 3),
            Free::Pin(joint) => (&parts.model.joint(*joint).name, 2),
        };
        let part = row - first;
        if part == 2 && count == 3 {
            return motion.named_rate(value, &name.text, "");
        }
        if part < 2 {
            let (which, axes) = match parts.hangs_on(*free) {
                Some(member) => (["along", "across"], format!("{member}, on which it hangs")),
                None => (["x", "y"], "of the ground".to_owned()),
            };
            return motion.named_part(value, &name.text, (which[part], &axes));
        }
        first += count;
    }
    value
}

fn too_large(model: &Model, group: &Group, size: usize) -> Diagnostic {
    crate::plan::unsupported(model, group, "find the forces of")
        .note(format!("its equilibrium equations leave a core of {size}; up to {CORE} are supported"))
}

/// The equations of all that is free, in the unknowns of the group; and of each member with a number of its own at its far end the balance
/// of both.
fn equations<'m>(parts: &Parts<'_, 'm>, known: &[Act<'m>], ends: &[MemberEnds<'m>]) -> Vec<Equation<'m>> {
    let (one, zero) = (parts.placement.graph().one(), parts.placement.graph().zero());
    let mut columns = parts.matrix();
    let mut balances = Vec::new();
    for (index, ends) in ends.iter().enumerate() {
        let Some((of_near, right)) = ends.balance else { continue };
        let member = &parts.members[index];
        let [near, far] = parts.units_at_ends(member).map(|acts| parts.column(&acts));
        // Of the unit at the near end, with the opposite at the far end of a rod.
        let far = if parts.is_slide(member.far) { far } else { far.into_iter().map(|part| -part).collect() };
        columns[index] = near;
        columns.push(far);
        balances.push((index, columns.len() - 1, of_near, right));
    }
    let known = parts.column(known);
    let mut equations: Vec<Equation<'m>> = (0..known.len())
        .map(|row| Equation { coefficients: columns.iter().map(|c| c[row]).collect(), right: -known[row], gives: None })
        .collect();
    for (near, far, of_near, right) in balances {
        let mut coefficients = vec![zero; columns.len()];
        (coefficients[near], coefficients[far]) = (of_near, one);
        equations.push(Equation { coefficients, right, gives: Some(far) });
    }
    equations
}

/// The power of an act on a link. Members have no motion before their ends have one.
fn power<'m>(motion: &Motion<'m, '_>, parts: &Parts<'_, 'm>, act: &Act<'m>) -> Expr<'m> {
    let moves = |link: LinkId| !parts.is_member(link);
    match act {
        Act::Force(link, at, force) if moves(*link) => {
            motion.of_place(*link, *at).along(force.axes).dot(force.components)
        }
        Act::Couple(link, moment) if moves(*link) => *moment * motion.rate(*link),
        _ => motion.graph().zero(),
    }
}

/// What is known of a member's ends before its number is.
struct MemberEnds<'m> {
    /// The force on the member at its near end.
    near: Framed<'m>,
    /// The force on it at its far end, if that is not what the near end and the loads leave.
    far: Option<Framed<'m>>,
    /// The sum of the loads on it.
    loads: Framed<'m>,
    /// What that does to its neighbours.
    acts: Vec<Act<'m>>,
    /// Of a loaded member between links of the group the balance of the numbers at its ends, neither of which is the other one's rounding:
    /// `coefficient · near + far = right`.
    balance: Option<(Expr<'m>, Expr<'m>)>,
}

fn known_ends<'m>(balance: &Balance<'m, '_>, parts: &Parts<'_, 'm>, member: &Member) -> MemberEnds<'m> {
    let (graph, ground) = (balance.graph(), parts.ground());
    let loads = balance.total(member.link);
    if parts.is_slide(member.far) {
        let axes = balance.placement.slide_direction(member.far);
        let total = loads.along(axes);
        // Along the slide the pin alone holds the loads; across it the guide does, and their moment about the runner.
        let near = Framed { components: Vector::new(-total.x, graph.zero()), axes };
        let own = (member.within && !total.y.is_zero()).then(|| (-graph.one(), total.y));
        let across = if own.is_some() { graph.zero() } else { total.y };
        let held = Framed { components: Vector::new(graph.zero(), across), axes };
        let moment = balance.moment(member.link, parts.place(member.near, member.link), graph.one());
        let arm = parts.slide_arm(member);
        let guide = parts.other(member.far, member.link);
        let acts = vec![
            parts.passed_on(member.near, member.link, near),
            Act::Force(guide, parts.place(member.far, guide), held),
            Act::Couple(guide, moment + arm.x * across),
        ];
        return MemberEnds { near, far: None, loads, acts, balance: own };
    }
    let (length, axes) = parts.rod(member);
    let about = parts.place(member.far, member.link);
    let across = -balance.moment(member.link, about, graph.one() / length);
    let name = &parts.model.link(member.link).name;
    let across = across.named(balance.name(&format!("across_{name}")), format!("−ΣM/length of the loads on {name}"));
    let near = Framed { components: Vector::new(graph.zero(), across), axes };
    // Where the far end is on a link of the group, too, what it holds across is a number of its own, which that link's equations have as it is:
    // by the moment about the near end, or where the loads act farther away than that and both moments have roundings with long arms, what the
    // near end leaves of the loads.
    let own = (member.within && !loads.components.is_zero()).then(|| {
        let pin = parts.place(member.near, member.link);
        let (at_far, equation) = if balance.all_act_beyond(member.link, pin, about) {
            (-(across + loads.along(axes).y), format!("across {name}, −ΣF of what acts on it"))
        } else {
            (balance.moment(member.link, pin, graph.one() / length), format!("ΣM/length of the loads on {name}"))
        };
        let label = balance.name(&format!("across_{name}_at_{}", parts.model.joint(member.far).name));
        Framed { components: Vector::new(graph.zero(), at_far.named(label, equation)), axes }
    });
    let far = own.unwrap_or_else(|| loads.plus(&near, ground).opposite());
    let acts = vec![parts.passed_on(member.near, member.link, near), parts.passed_on(member.far, member.link, far)];
    let balance = own.map(|_| (graph.one(), -loads.along(axes).x));
    MemberEnds { near, far: own, loads, acts, balance }
}

/// Records the forces at a member's ends, from its number at the near one, and at the far one if it has one of its own.
fn put_member<'m>(
    balance: &mut Balance<'m, '_>,
    parts: &Parts<'_, 'm>,
    member: &Member,
    ends: &MemberEnds<'m>,
    (value, at_far_end): (Expr<'m>, Option<Expr<'m>>),
) {
    let (graph, ground) = (balance.graph(), parts.ground());
    let is_slide = parts.is_slide(member.far);
    let own = if is_slide { Vector::new(graph.zero(), value) } else { Vector::new(value, graph.zero()) };
    let near = Framed { components: ends.near.components + own, axes: ends.near.axes };
    if is_slide {
        let across = at_far_end.unwrap_or_else(|| ends.loads.along(near.axes).y + value);
        // The reaction of the guide needs the pin's force among what acts on the slider; another member may have put it there.
        if !parts.found_before(member.near, member.link) {
            balance.push(member.link, parts.place(member.near, member.link), near);
        }
        put_pin(balance, parts, member.near, member.link, near);
        super::slide::guide(balance, member.far, member.link, across, parts.place(member.near, member.link));
    } else {
        let near = put_pin(balance, parts, member.near, member.link, near);
        let far = match (ends.far, at_far_end) {
            (Some(far), Some(along)) => {
                Framed { components: far.components + Vector::new(along, graph.zero()), axes: far.axes }
            }
            _ => ends.loads.plus(&near, ground).opposite(),
        };
        put_pin(balance, parts, member.far, member.link, far);
    }
}

/// Records a pin's force. A pin between two members is found from each of them: once is enough.
fn put_pin<'m>(
    balance: &mut Balance<'m, '_>,
    parts: &Parts<'_, 'm>,
    joint: JointId,
    on: LinkId,
    force: Framed<'m>,
) -> Framed<'m> {
    if parts.found_before(joint, on) { balance.pinned(joint, on) } else { balance.pin(joint, on, force) }
}

/// Records a joint that no member has. One of its links may be outside the group, and is loaded by it.
fn put_joint<'m>(balance: &mut Balance<'m, '_>, joint: JointId, values: &[Expr<'m>], links: &str) {
    let name = &balance.model().joint(joint).name;
    let components = reactions::parts(balance.placement, joint);
    let is_at_runner = balance.placement.ahead_of_runner(joint).is_zero();
    let values = components.iter().zip(values).map(|(part, value)| {
        let (what, about) = match part.component {
            Component::Couple if !is_at_runner => ("moment", " about its place"),
            component => (component.name(), ""),
        };
        let name = balance.name(&format!("{name}_{what}"));
        value.named(name, format!("from the equilibrium of {links}{about}"))
    });
    let values: Vec<Expr<'m>> = values.collect();
    balance.react(joint, &values);
}

#[cfg(test)]
mod tests {
    use super::Block;
    use crate::diagnostics::Sink;
    use crate::graph::{NodeValues, Order, Symbol};
    use crate::model::{self, Model};
    use crate::plan::assembly::Assembly;
    use crate::plan::rules::{Rule, rule_of};
    use crate::plan::velocities::Motion;
    use crate::syntax;
    use crate::topology::Topology;

    /// Groups that the closed forms of other rules move, too: members between pins, on a slide, on each other; carriers with slots,
    /// slides and welds.
    const CASES: [&str; 6] = [
        "link b { A -> B: 3m, P: (1m, 1m) } link c { Q -> B: 2.5m } revolute A: crank -> b; revolute B: b -> c; revolute Q: ground -> c;
         assemble B: left(A -> Q);",
        "link rod { A -> B: 3m } link piston { B: (0.1m, 0.3m), G: (0.4m, 0.2m) } revolute A: crank -> rod; revolute B: rod -> piston;
         prismatic G: piston -> arm.Q along 10deg of piston, angle 25deg; assemble B: ahead(A);",
        "link rod { A: (0.1m, 0.2m), S: (0.5m, 0.3m) } link block { Q: (0.2m, 0.1m), S: (-0.1m, 0.3m) } revolute A: rod -> crank;
         revolute Q: arm -> block; prismatic S: block -> rod along 25deg of rod, angle 40deg; assemble S: behind(Q);",
        "link lever { Q: (0.2m, 0.3m), S: (3m, 2m) } revolute Q: lever -> ground; slot S: crank.A -> lever.S along 70deg of lever;
         assemble S: behind(Q);",
        "link runner { A: (0.2m, 0.3m), S: (1m, 2m), W: (1m, 0) } link tip { W: (0.2m, 0.1m) } revolute A: runner -> crank;
         slot S: runner.S -> arm.Q along 70deg of arm; weld W: tip -> runner, angle 40deg; assemble S: behind(A);",
        "link slider { G: (0.2m, 0.3m), S: (1m, 2m) } prismatic G: slider -> crank.A along 20deg of slider, angle 65deg;
         slot S: arm.Q -> slider.S along -30deg of slider;",
    ];

    /// Rates of all links, and how fast their origins move, one motion after another.
    fn moved(model: &Model, topology: &Topology, assembly: &Assembly<'_>, rules: &[&dyn Rule]) -> Vec<f64> {
        let sink = Sink::default();
        let velocities = Motion::velocities(&assembly.placement, &assembly.pivots);
        let velocities = velocities.through(&topology.motion, rules, &sink);
        let accelerations = Motion::accelerations(&velocities).through(&topology.motion, rules, &sink);
        assert!(sink.is_clean());
        let known = |symbol: Symbol| match symbol {
            Symbol::Drive(drive) => [0.4, 1.1][drive.index()],
            Symbol::Driven(drive, Order::Rate) => [1.3, -0.6][drive.index()],
            Symbol::Driven(drive, Order::Acceleration) => [0.7, 2.1][drive.index()],
            _ => f64::NAN,
        };
        let mut done = NodeValues::default();
        let mut all = Vec::new();
        for motion in [&velocities, &accelerations] {
            for link in model.moving_links() {
                let origin = motion.of_place(link, model.graph.zero_vector()).ground();
                let values = [origin.x, origin.y, motion.rate(link)];
                all.extend(values.map(|value| model.graph.evaluate(value.id(), &known, &mut done)));
            }
        }
        all
    }

    #[test]
    fn elimination_moves_links_as_closed_forms_do() {
        for items in CASES {
            let text = format!(
                "mod sample; ground {{ O: (0, 0), Q: (3m, 0.5m) }} link crank {{ O -> A: 1m }} link arm {{ Q: (0.2m, 0) , R: (0.1m, 0.4m) }}
                 revolute O: ground -> crank; revolute R: ground.Q -> arm; drive q: O; drive r: R; {items}
                 scene speeds: acceleration;"
            );
            let sink = Sink::default();
            let ast = syntax::parse(text.parse().expect("tokens"), &sink).expect("a declaration");
            let model = model::resolve(&ast, &sink);
            let topology = Topology::of(&model, &sink).expect("groups");
            let rules: Vec<&dyn Rule> =
                topology.motion.iter().map(|group| rule_of(&model, group).expect("a rule")).collect();
            let mut assembly = Assembly::new(&model, &topology);
            for (group, rule) in topology.motion.iter().zip(&rules) {
                assert!(rule.place(&mut assembly, group).is_ok(), "{text}");
            }
            let blocks: Vec<&dyn Rule> = topology.motion.iter().map(|_| &Block as &dyn Rule).collect();
            let closed = moved(&model, &topology, &assembly, &rules);
            let eliminated = moved(&model, &topology, &assembly, &blocks);
            for (index, (own, other)) in closed.iter().zip(&eliminated).enumerate() {
                let size = own.abs().max(1.0);
                assert!((own - other).abs() <= 1e-11 * size, "{index}: {own} and {other}\n{text}");
            }
        }
    }
}
