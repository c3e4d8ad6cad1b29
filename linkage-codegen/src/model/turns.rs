//! Angles that follow from the drives alone, with all their turns: through driven pins and slots, slides, welds and gears.

use std::collections::BTreeMap;

use super::ids::{GROUND, LinkId};
use super::{JointKind, Model};
use crate::graph::{Expr, Symbol};

/// A condition of the angles: `Σ factor θ = driven + rest`.
#[derive(Clone, Debug)]
struct Condition<'m> {
    factors: BTreeMap<LinkId, Expr<'m>>,
    /// What drives make of it, and what is constant.
    sum: [Expr<'m>; 2],
}

impl<'m> Condition<'m> {
    fn scaled(mut self, by: Expr<'m>) -> Self {
        self.factors.values_mut().for_each(|factor| *factor = *factor * by);
        self.sum = self.sum.map(|part| part * by);
        self
    }

    /// Without the angle for which another one is solved.
    fn without(mut self, link: LinkId, solved: &Self) -> Self {
        let Some(factor) = self.factors.get(&link).copied() else { return self };
        for (other, own) in &solved.factors {
            let sum = self.factors.get(other).map_or_else(|| -(factor * *own), |sum| *sum - factor * *own);
            self.factors.insert(*other, sum);
        }
        self.factors.remove(&link);
        self.factors.retain(|_, factor| !factor.is_zero());
        self.sum = [0, 1].map(|part| self.sum[part] - factor * solved.sum[part]);
        self
    }
}

impl Model {
    /// The angle of a link from another one, if it follows from drives alone: what these turn it by, and the rest.
    #[must_use]
    pub fn driven_angle(&self, from: LinkId, on: LinkId) -> Option<[Expr<'_>; 2]> {
        self.driven_path(from, on).or_else(|| {
            // From the ground both, or the one from the other.
            let angles = self.driven_angles(GROUND);
            if let (Some(from), Some(on)) = (angles.get(&from), angles.get(&on)) {
                return Some([0, 1].map(|part| on[part] - from[part]));
            }
            self.driven_angles(from).get(&on).copied()
        })
    }

    /// The same where driven pins and slots, slides and welds lead from the one to the other.
    fn driven_path(&self, from: LinkId, on: LinkId) -> Option<[Expr<'_>; 2]> {
        let zero = self.graph.zero();
        let mut reached = vec![(from, [zero, zero])];
        let mut next = 0;
        while let Some((link, angle)) = reached.get(next).copied() {
            if link == on {
                return Some(angle);
            }
            next += 1;
            for joint in self.joint_ids() {
                let data = self.joint(joint);
                let unknown = |link: LinkId| reached.iter().all(|(reached, _)| *reached != link);
                let Some(other) = data.end_off(link).filter(|other| unknown(other.link)) else { continue };
                let Some(turn) = self.turn_of(joint) else { continue };
                let sign = if data.to == other { 1 } else { -1 };
                reached.push((other.link, [0, 1].map(|part| angle[part] + sign * turn[part])));
            }
        }
        None
    }

    /// The angle between the links of a joint, if it is fixed or driven.
    fn turn_of(&self, joint: super::ids::JointId) -> Option<[Expr<'_>; 2]> {
        let zero = self.graph.zero();
        let fixed = self.joint(joint).kind.turn().map(|(_, angle)| [zero, self.graph.expr(angle)]);
        let driven = self.drive_of(joint, true).map(|drive| [self.graph.symbol(Symbol::Drive(drive)), zero]);
        fixed.or(driven)
    }

    /// The angles from a link that follow from drives alone, gears among what leads there.
    fn driven_angles(&self, from: LinkId) -> BTreeMap<LinkId, [Expr<'_>; 2]> {
        let (zero, one) = (self.graph.zero(), self.graph.one());
        if !self.has_gears() {
            return BTreeMap::new();
        }
        let mut open: Vec<Condition<'_>> = Vec::new();
        for joint in self.joint_ids() {
            let [first, second] = self.joint(joint).ends().map(|end| end.link);
            if let Some(sum) = self.turn_of(joint) {
                open.push(Condition { factors: BTreeMap::from([(first, -one), (second, one)]), sum });
            }
            if let JointKind::Gear(gear) = self.joint(joint).kind {
                let [r1, r2] = gear.radii.map(|radius| self.graph.expr(radius));
                let centres = gear.centres(self);
                let within = self.graph.atan2(centres.y, centres.x);
                let sum = [zero, self.graph.expr(gear.phase) + (r1 + r2) * within];
                let factors = BTreeMap::from([(first, r1), (second, r2), (gear.arm[0].link, -(r1 + r2))]);
                open.push(Condition { factors, sum });
            }
        }
        for condition in &mut open {
            condition.factors.remove(&from);
        }
        // Each is solved for one of its angles, which the others then do without.
        let mut solved: Vec<(LinkId, Condition<'_>)> = Vec::new();
        while let Some((index, link)) = open.iter().enumerate().find_map(|(index, condition)| {
            let divides = |factor: &Expr<'_>| factor.sign().is_some_and(|sign| sign != 0);
            Some((index, *condition.factors.iter().find(|(_, factor)| divides(factor))?.0))
        }) {
            let condition = open.swap_remove(index);
            let factor = condition.factors[&link];
            let mut condition = condition.scaled(one / factor);
            condition.factors.insert(link, one);
            open = open.into_iter().map(|other| other.without(link, &condition)).collect();
            solved = solved.into_iter().map(|(of, other)| (of, other.without(link, &condition))).collect();
            solved.push((link, condition));
        }
        let alone = solved.into_iter().filter(|(_, condition)| condition.factors.len() == 1);
        alone.map(|(link, condition)| (link, condition.sum)).chain([(from, [zero, zero])]).collect()
    }
}
