//! Groups that have no closed form, of joints of every kind: plates on legs, and legs of many ways to be one.
//!
//! A plate on three legs, two plates with a hinge each and two legs between them, and two plates on two legs each with two more between
//! them. A leg takes one freedom of a plate: a rod, a slider, a pin in a slot, a cylinder with its rod, two rods that a weld joins, a slider
//! between two slides, a crank that a wheel of another leg turns, or a gear pair. Plates may be two links that a weld, a driven pin or a
//! driven slide joins.

use core::fmt::Write as _;

use nalgebra::DMatrix;

use super::{Builder, Place, cross, direction, dot, minus, size};

/// What holds two links, where they are.
#[derive(Clone, Copy)]
enum Hold {
    /// A pin at a place.
    Pin(Place),
    /// Nothing goes across a line at a place.
    Line(Place, Place),
    /// No turn against each other.
    Turn,
    /// Wheels on an arm, with their radii.
    Teeth(usize, [(usize, f64); 2]),
}

/// Constraints of a group that is being built.
#[derive(Clone, Default)]
struct Group {
    links: Vec<usize>,
    holds: Vec<(usize, usize, Hold)>,
    /// Rods on pins, from another link of which a wheel may turn a leg: the rod, its foot's pin and place, and the link of the foot.
    cranks: Vec<(usize, String, Place, usize)>,
    /// Parts of plates that a leg holds.
    held: Vec<usize>,
}

impl Group {
    fn pin(&mut self, a: usize, b: usize, at: Place) {
        self.holds.push((a, b, Hold::Pin(at)));
    }

    fn slide(&mut self, a: usize, b: usize, angle: f64) {
        let normal = direction(angle + core::f64::consts::FRAC_PI_2);
        self.holds.extend([(a, b, Hold::Line([0.0; 2], normal)), (a, b, Hold::Turn)]);
    }

    fn fixed(&mut self, a: usize, b: usize, at: Place) {
        self.holds.extend([(a, b, Hold::Pin(at)), (a, b, Hold::Turn)]);
    }

    /// The smallest singular value of the constraints against velocities and rates of rotation, places taken from `base`.
    fn firmness(&self, base: Place) -> f64 {
        let columns = 3 * self.links.len();
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let column = |link: usize| self.links.iter().position(|own| *own == link).map(|index| 3 * index);
        let mut row = |parts: &[(usize, [f64; 3])]| {
            let mut line = vec![0.0; columns];
            for (link, part) in parts {
                if let Some(first) = column(*link) {
                    line[first..first + 3].iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
                }
            }
            rows.push(line);
        };
        // The rate at which a link's point at a place goes along a direction.
        let along = |at: Place, n: Place, sign: f64| [sign * n[0], sign * n[1], sign * cross(minus(at, base), n)];
        for (a, b, hold) in &self.holds {
            match *hold {
                Hold::Pin(at) => {
                    for n in [[1.0, 0.0], [0.0, 1.0]] {
                        row(&[(*a, along(at, n, 1.0)), (*b, along(at, n, -1.0))]);
                    }
                }
                Hold::Line(at, n) => row(&[(*a, along(at, n, 1.0)), (*b, along(at, n, -1.0))]),
                Hold::Turn => row(&[(*a, [0.0, 0.0, 1.0]), (*b, [0.0, 0.0, -1.0])]),
                Hold::Teeth(arm, [(first, r), (second, s)]) => {
                    row(&[(first, [0.0, 0.0, r]), (second, [0.0, 0.0, s]), (arm, [0.0, 0.0, -r - s])]);
                }
            }
        }
        if rows.len() != columns {
            return 0.0;
        }
        let matrix = DMatrix::from_fn(columns, columns, |i, j| rows[i][j]);
        matrix.singular_values().min()
    }
}

/// Whether two plates with a pin each, joined by two rods, are far enough from a singular pose: a rough start must not be beyond it.
pub(super) fn ring_is_firm([a, b, c, d, e, f]: [Place; 6], base: Place) -> bool {
    let mut group = Group { links: vec![1, 2, 3, 4], ..Group::default() };
    for (first, second, at) in [(0, 1, a), (0, 2, b), (1, 3, c), (3, 2, e), (1, 4, d), (4, 2, f)] {
        group.pin(first, second, at);
    }
    group.firmness(base) > 0.08
}

impl Builder {
    /// A group, with starts near to where it is.
    pub(super) fn iterated(&mut self) {
        loop {
            let mut trial = self.clone();
            let group = trial.any_group();
            self.random = trial.random.clone();
            if group.firmness(self.base) > 0.15 {
                *self = trial;
                break;
            }
        }
    }

    fn any_group(&mut self) -> Group {
        let mut group = Group::default();
        let n = self.bodies.len();
        let first = [n - 1, self.random.below(n), self.random.below(n), self.random.below(n)];
        match self.random.below(5) {
            0..=2 => {
                let plate = self.any_plate(&mut group);
                let legs = if self.random.chance(0.2) { self.geared_leg(&mut group, first[0], plate) } else { 0 };
                for foot in &first[legs..3] {
                    self.leg(&mut group, *foot, plate);
                }
            }
            3 => {
                let plates = [self.any_plate(&mut group), self.any_plate(&mut group)];
                for (foot, plate) in first.into_iter().zip(plates) {
                    self.hinge(&mut group, foot, plate[0]);
                }
                for _ in 0..2 {
                    self.leg_between(&mut group, plates);
                }
            }
            _ => {
                let plates = [self.any_plate(&mut group), self.any_plate(&mut group)];
                for (index, foot) in first.into_iter().enumerate() {
                    self.leg(&mut group, foot, plates[index % 2]);
                }
                for _ in 0..2 {
                    self.leg_between(&mut group, plates);
                }
            }
        }
        for link in group.links.clone() {
            self.start(link);
        }
        group
    }

    fn own(&mut self, group: &mut Group, points: [(&str, Place); 2]) -> usize {
        let [first, second] = points;
        let link = self.link(first, second);
        group.links.push(link);
        link
    }

    /// A plate, with no point that matters yet; now and then two links of which none moves against the other but by a drive. Legs hold
    /// them in turn.
    fn any_plate(&mut self, group: &mut Group) -> [usize; 2] {
        self.driven_slots = false;
        let [a, b] = [self.fresh('q'), self.fresh('q')];
        let (at_a, at_b) = (self.place(), self.place());
        let plate = self.own(group, [(&a, at_a), (&b, at_b)]);
        if self.random.chance(0.7) {
            return [plate; 2];
        }
        let (s, x) = (self.fresh('J'), self.fresh('q'));
        let (at, other) = (self.place(), self.place());
        match self.random.below(3) {
            0 => {
                let second = self.own(group, [(&s, at), (&x, other)]);
                self.bodies[plate].points.push((s.clone(), at));
                self.welded(&s, plate, second);
                self.places.push((s, at));
                group.fixed(plate, second, at);
                [plate, second]
            }
            1 => {
                let second = self.own(group, [(&s, at), (&x, other)]);
                self.bodies[plate].points.push((s.clone(), at));
                let (from, to) = self.revolute(&s, plate, second);
                // A driven pin holds no wheel.
                self.pins.retain(|(name, ..)| *name != s);
                self.drives.push((s.clone(), self.bodies[to].angle - self.bodies[from].angle));
                self.places.push((s, at));
                group.fixed(plate, second, at);
                [plate, second]
            }
            _ => {
                let y = self.fresh('q');
                let second = self.own(group, [(&x, at), (&y, other)]);
                let angle = self.angle();
                self.driven_slide(&s, plate, second, angle);
                group.fixed(plate, second, at);
                [plate, second]
            }
        }
    }

    fn welded(&mut self, name: &str, near: usize, far: usize) {
        let (from, to) = self.arrow(near, far);
        let fixed = self.bodies[to].angle - self.bodies[from].angle;
        let (from, to) = (&self.bodies[from].name, &self.bodies[to].name);
        let _ = writeln!(self.items, "weld {name}: {from} -> {to}, angle {fixed:?}rad;");
    }

    /// A slide with a drive, its line anywhere.
    fn driven_slide(&mut self, name: &str, near: usize, far: usize, angle: f64) {
        self.slide(name, near, far, angle);
        let end = |builder: &Self, link: usize| builder.bodies[link].points.last().expect("its end").1;
        let gap = minus(end(self, far), end(self, near));
        let line = self.items.lines().last().expect("the slide");
        let from_near = line.contains(&format!("{name}: {} -> ", self.bodies[near].name));
        let travel = dot(if from_near { gap } else { gap.map(|x| -x) }, direction(angle));
        self.drives.push((name.to_owned(), travel));
    }

    /// To which link of a plate a leg is joined: first to each that has none.
    fn joined(&mut self, group: &mut Group, plate: [usize; 2]) -> usize {
        let free = plate.into_iter().find(|link| !group.held.contains(link));
        let link = free.unwrap_or_else(|| *self.random.pick(&plate));
        group.held.push(link);
        link
    }

    fn leg_between(&mut self, group: &mut Group, plates: [[usize; 2]; 2]) {
        let foot = self.joined(group, plates[0]);
        self.leg(group, foot, plates[1]);
    }

    /// A pin or a slide.
    fn hinge(&mut self, group: &mut Group, foot: usize, link: usize) {
        let j = self.fresh('J');
        group.held.push(link);
        self.driven_slots = self.random.chance(0.2);
        if self.random.chance(0.7) {
            let at = self.place();
            self.bodies[foot].points.push((j.clone(), at));
            self.bodies[link].points.push((j.clone(), at));
            self.revolute(&j, foot, link);
            self.places.push((j, at));
            group.pin(foot, link, at);
        } else {
            let angle = self.angle();
            self.slide(&j, foot, link, angle);
            group.slide(foot, link, angle);
        }
        self.driven_slots = false;
    }

    /// Two places that are apart.
    fn two_places(&mut self) -> [Place; 2] {
        loop {
            let places = [self.place(), self.place()];
            if size(minus(places[0], places[1])) > 0.5 {
                return places;
            }
        }
    }

    /// What takes one freedom of a plate against another link.
    fn leg(&mut self, group: &mut Group, foot: usize, plate: [usize; 2]) {
        let link = self.joined(group, plate);
        self.driven_slots = self.random.chance(0.15);
        let [f, t] = [self.fresh('J'), self.fresh('J')];
        let [at_f, at_t] = self.two_places();
        match self.random.below(12) {
            0..=2 => {
                let rod = self.rod(group, [(foot, &f, at_f), (link, &t, at_t)]);
                if self.pins.iter().any(|(pin, ..)| *pin == f) {
                    group.cranks.push((rod, f, at_f, foot));
                }
            }
            3 | 4 => {
                // A slider on either link, with a pin on the other one.
                let [near, far] = if self.random.chance(0.5) { [foot, link] } else { [link, foot] };
                let other = self.place();
                let slider = self.own(group, [(&t, at_t), (&format!("{t}x"), other)]);
                self.bodies[far].points.push((t.clone(), at_t));
                self.revolute(&t, slider, far);
                let angle = self.angle();
                self.slide(&f, near, slider, angle);
                self.places.push((t, at_t));
                group.pin(slider, far, at_t);
                group.slide(near, slider, angle);
            }
            5 | 6 => {
                let [near, far] = if self.random.chance(0.5) { [foot, link] } else { [link, foot] };
                let (angle, travel) = (self.angle(), self.random.range(-2.0, 2.0));
                self.bodies[near].points.push((f.clone(), minus(at_t, direction(angle).map(|x| x * travel))));
                self.bodies[far].points.push((t.clone(), at_t));
                self.slot(&t, (near, &f), (far, &t), angle);
                self.places.push((t, at_t));
                let normal = direction(angle + core::f64::consts::FRAC_PI_2);
                group.holds.push((near, far, Hold::Line(at_t, normal)));
            }
            7 | 8 => {
                // A cylinder with its rod, or two links that a weld joins.
                let [a, b] = [self.place(), self.place()];
                self.bodies[foot].points.push((f.clone(), at_f));
                self.bodies[link].points.push((t.clone(), at_t));
                let tube = self.own(group, [(&f, at_f), (&format!("{f}x"), a)]);
                let rod = self.own(group, [(&t, at_t), (&format!("{t}x"), b)]);
                self.revolute(&f, foot, tube);
                self.revolute(&t, rod, link);
                self.driven_slots = false;
                let s = self.fresh('J');
                if self.random.chance(0.5) {
                    let at = self.place();
                    [tube, rod].into_iter().for_each(|link| self.bodies[link].points.push((s.clone(), at)));
                    self.welded(&s, tube, rod);
                    self.places.push((s, at));
                } else {
                    let angle = self.angle();
                    self.driven_slide(&s, tube, rod, angle);
                }
                self.places.extend([(f, at_f), (t, at_t)]);
                group.pin(foot, tube, at_f);
                group.pin(rod, link, at_t);
                group.fixed(tube, rod, at_t);
            }
            9 => {
                let (a, b) = (self.place(), self.place());
                let slider = self.own(group, [(&format!("{f}x"), a), (&format!("{t}x"), b)]);
                let [one, two] = self.two_directions();
                self.slide(&f, foot, slider, one);
                self.slide(&t, slider, link, two);
                group.slide(foot, slider, one);
                group.slide(slider, link, two);
            }
            _ => self.geared_crank(group, foot, link, [(&f, at_f), (&t, at_t)]),
        }
        self.driven_slots = false;
    }

    /// A rod with a pin at either end.
    fn rod(&mut self, group: &mut Group, [foot, tip]: [(usize, &str, Place); 2]) -> usize {
        self.bodies[foot.0].points.push((foot.1.to_owned(), foot.2));
        self.bodies[tip.0].points.push((tip.1.to_owned(), tip.2));
        let rod = self.own(group, [(foot.1, foot.2), (tip.1, tip.2)]);
        self.revolute(foot.1, foot.0, rod);
        self.revolute(tip.1, rod, tip.0);
        self.places.extend([foot, tip].map(|(_, name, at)| (name.to_owned(), at)));
        group.pin(foot.0, rod, foot.2);
        group.pin(rod, tip.0, tip.2);
        rod
    }

    /// A crank beside a rod of another leg on the same link, which turns it by its wheel, and a rod from the crank to the plate; a rod alone
    /// if there is no such leg.
    fn geared_crank(
        &mut self,
        group: &mut Group,
        foot: usize,
        plate: usize,
        [(f, at_f), (t, at_t)]: [(&str, Place); 2],
    ) {
        self.driven_slots = false;
        let beside = group.cranks.iter().position(|(.., other)| *other == foot);
        let Some((turning, pin, at, _)) = beside.map(|index| group.cranks.swap_remove(index)) else {
            self.rod(group, [(foot, f, at_f), (plate, t, at_t)]);
            return;
        };
        let [own, tip] = loop {
            let places = self.two_places();
            if size(minus(places[0], at)) > 0.4 && size(minus(places[1], at_t)) > 0.4 {
                break places;
            }
        };
        let m = self.fresh('J');
        let crank = self.own(group, [(f, own), (&m, tip)]);
        self.bodies[foot].points.push((f.to_owned(), own));
        self.revolute(f, foot, crank);
        group.pin(foot, crank, own);
        self.places.push((f.to_owned(), own));
        let (g, touch, radii) = self.mesh(foot, [(turning, &pin, at), (crank, f, own)]);
        self.places.push((g, touch));
        group.holds.push((turning, crank, Hold::Teeth(foot, radii)));
        // The crank has the rod's pin already.
        let rod = self.own(group, [(&m, tip), (t, at_t)]);
        self.bodies[plate].points.push((t.to_owned(), at_t));
        self.revolute(&m, crank, rod);
        self.revolute(t, rod, plate);
        self.places.extend([(m, tip), (t.to_owned(), at_t)]);
        group.pin(crank, rod, tip);
        group.pin(rod, plate, at_t);
    }

    /// A rod, and a gear pair between the links at its ends: two legs.
    fn geared_leg(&mut self, group: &mut Group, foot: usize, plate: [usize; 2]) -> usize {
        self.driven_slots = false;
        let [f, t] = [self.fresh('J'), self.fresh('J')];
        let [at_f, at_t] = self.two_places();
        group.held.push(plate[0]);
        let rod = self.rod(group, [(foot, &f, at_f), (plate[0], &t, at_t)]);
        let (g, touch, radii) = self.mesh(rod, [(foot, &f, at_f), (plate[0], &t, at_t)]);
        self.places.push((g, touch));
        group.holds.push((foot, plate[0], Hold::Teeth(rod, radii)));
        2
    }

    /// Where the drives start: where they are, or somewhat off.
    pub(super) fn starts_of_drives(&mut self, off: f64) -> String {
        let mut lines = String::new();
        for (index, (joint, at)) in self.drives.clone().iter().enumerate() {
            let slides = joint.ends_with(".travel") || self.items.contains(&format!("prismatic {joint}:"));
            let unit = if slides { "m" } else { "rad" };
            let at = if off > 0.0 && self.random.chance(0.5) { at + self.random.range(-off, off) } else { *at };
            let _ = writeln!(lines, "start q{index}: {at:?}{unit};");
        }
        lines
    }
}
