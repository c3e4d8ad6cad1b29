//! Random linkages: the places of the joints are drawn first, and the dimensions are those that fit.

mod iterated;

use core::fmt::Write;

use super::Arguments;

/// Numbers that are always the same (splitmix64).
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    #[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.next() % n as u64).unwrap()
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    pub fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}

pub type Place = [f64; 2];

pub fn minus(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn plus(a: Place, b: Place) -> Place {
    [a[0] + b[0], a[1] + b[1]]
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Place, b: Place) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub fn size(a: Place) -> f64 {
    a[0].hypot(a[1])
}

pub fn direction(angle: f64) -> Place {
    [angle.cos(), angle.sin()]
}

#[derive(Clone)]
struct Body {
    name: String,
    origin: Place,
    angle: f64,
    points: Vec<(String, Place)>,
    /// The first two points are the frame: `A -> B: length`.
    framed: bool,
    mass: Option<String>,
}

/// A random linkage: its declaration, arguments at which it closes, and where its joints are.
pub struct Sample {
    pub text: String,
    pub arguments: Arguments,
    pub places: Vec<(String, Place)>,
    /// The longest distance between two points of a link that are joints.
    pub longest: f64,
}

/// What a random linkage may have.
#[derive(Clone, Copy, Debug)]
#[allow(clippy::struct_excessive_bools, reason = "each is a choice of its own")]
pub struct Kind {
    /// Dyads beside the driven link.
    pub dyads: usize,
    /// Whether dyads may have sliders.
    pub sliders: bool,
    /// Whether links may be welded, or be held by slots and gears.
    pub joints: bool,
    /// Whether the unknown may act elsewhere than at the driven joint.
    pub unknown_anywhere: bool,
    /// Whether it has inertia and dampers, and scenes with velocities and accelerations.
    pub moving: bool,
    /// Whether dimensions are parameters.
    pub params: bool,
    /// `f32` or `f64`.
    pub scalar: &'static str,
}

#[derive(Clone)]
struct Builder {
    random: Random,
    base: Place,
    bodies: Vec<Body>,
    items: String,
    places: Vec<(String, Place)>,
    names: usize,
    sines: f64,
    /// Pins that hold wheels, each with its two links.
    pins: Vec<(String, usize, usize)>,
    /// Driven joints and their coordinates.
    drives: Vec<(String, f64)>,
    /// Whether pins and slides may be slots with a drive.
    driven_slots: bool,
    /// Whether closures may be arguments.
    either: bool,
    /// On which side each group closes: 1 or −1.
    sides: Vec<f64>,
    /// What is not a place and may be a parameter, with its dimension: radii, values of loads, masses.
    values: Option<Vec<(&'static str, f64)>>,
    /// Whether the frames of links have their origins at joints.
    framed: bool,
    layout: Layout,
    /// Places that others may lie next to.
    drawn: Vec<Place>,
}

/// Where joints are.
#[derive(Clone, Copy, Debug)]
pub enum Layout {
    Anywhere,
    /// At multiples of half a metre, slides along the axes: many links lie along these, and many pins on a line.
    OnLattice,
    /// Some next to others, so many metres from them: lengths differ by that.
    Apart(f64),
    /// Anywhere behind a four-bar that folds where its crank points along the x axis: ground link, crank, coupler and rocker, which single
    /// precision holds.
    BehindFold([f64; 4]),
}

impl Layout {
    /// What distances are at least, as a part of what they are anywhere.
    fn least(self) -> f64 {
        if let Self::Apart(distance) = self { distance } else { 1.0 }
    }

    /// The nearest place that there is.
    fn nearest(self, [x, y]: Place) -> Place {
        if matches!(self, Self::OnLattice) { [x, y].map(|x| (2.0 * x).round() / 2.0) } else { [x, y] }
    }

    /// The nearest direction.
    fn turned(self, angle: f64) -> f64 {
        use core::f64::consts::FRAC_PI_2;
        if matches!(self, Self::OnLattice) { (angle / FRAC_PI_2).round() * FRAC_PI_2 } else { angle }
    }
}

impl Builder {
    fn new(random: Random, base: Place, kind: Kind) -> Self {
        let ground =
            Body { name: "ground".into(), origin: [0.0; 2], angle: 0.0, points: Vec::new(), framed: false, mass: None };
        Self {
            random,
            base,
            bodies: vec![ground],
            items: String::new(),
            places: Vec::new(),
            names: 0,
            sines: 0.2,
            pins: Vec::new(),
            drives: Vec::new(),
            driven_slots: false,
            either: kind.joints,
            sides: Vec::new(),
            values: kind.params.then(Vec::new),
            framed: false,
            layout: Layout::Anywhere,
            drawn: Vec::new(),
        }
    }

    /// A link or some more, placed by those that are there: a dyad, a link with other joints, a wheel.
    fn further(&mut self, kind: Kind) {
        self.driven_slots = kind.joints && self.random.chance(0.3);
        if kind.joints && self.random.chance(0.7) {
            match self.random.below(6) {
                0 => self.weld(),
                5 => self.split(true),
                1 => self.lever(),
                2 => self.runner(),
                3 => self.yoke(),
                _ => self.wheel(),
            }
            return;
        }
        match kind.sliders.then(|| self.random.below(10)) {
            Some(0 | 1) => self.slider_dyad(),
            Some(2) => self.sliding_pair(),
            Some(3) => self.pinned_sliders(),
            Some(4) => self.slider_on_slider(),
            Some(5) => self.split(false),
            _ => self.pinned_dyad(),
        }
    }
}

/// A random linkage.
pub fn sample(seed: u64, kind: Kind) -> Sample {
    let mut random = Random(seed);
    let offset = *random.pick(&[0.0, 0.0, 10.0, 1e3]);
    let base = [random.range(-offset, offset), random.range(-offset, offset)];
    let mut builder = Builder::new(random, base, kind);
    let drive = builder.driven_link(kind.sliders);
    builder.drives.push(drive);
    for _ in 0..kind.dyads {
        builder.further(kind);
    }
    builder.masses();
    let mut loads = builder.loads(kind.unknown_anywhere);
    let motion = if kind.moving { builder.motion(&mut loads) } else { Vec::new() };
    builder.finish(loads, motion, kind)
}

/// The same with a group that has no closed form, its start somewhat off. Without other joints it is the last one: a triad, of which a leg
/// may be a slider, or a group of class IV. With them it has joints of any kind, and other links may follow it.
pub fn sample_with_search(seed: u64, kind: Kind) -> Sample {
    let mut random = Random(seed);
    let base = [random.range(-1.0, 1.0), random.range(-1.0, 1.0)];
    let mut builder = Builder::new(random, base, kind);
    let drive = builder.driven_link(kind.sliders);
    builder.drives.push(drive);
    if kind.joints {
        let before = builder.random.below(kind.dyads + 1);
        for _ in 0..before {
            builder.further(kind);
        }
        builder.iterated();
        for _ in before..kind.dyads {
            builder.further(kind);
        }
    } else {
        for _ in 0..kind.dyads {
            builder.pinned_dyad();
        }
        if builder.random.chance(0.6) {
            builder.triad(kind.sliders);
        } else {
            builder.ring();
        }
    }
    builder.masses();
    let mut loads = builder.loads(kind.unknown_anywhere);
    let motion = if kind.moving { builder.motion(&mut loads) } else { Vec::new() };
    let starts = builder.starts_of_drives(if kind.joints { 0.02 } else { 0.0 });
    let mut sample = builder.finish(loads, motion, kind);
    sample.text.push_str(&starts);
    sample
}

/// Groups without a closed form.
#[derive(Clone, Copy, Debug)]
pub enum Class {
    /// A triad.
    Three,
    /// A triad, one leg of which may be a slider.
    ThreeWithSlider,
    /// A ring of four links.
    Four,
    /// Six dyads that follow each other, of pins and slides.
    Cascade,
}

/// A crank and groups of this class, with forces on two of its links that are given at run time. All lengths are numbers that single
/// precision holds too. Frames have their origins at joints, about which moments are then taken.
pub fn sample_with_forces(seed: u64, class: Class, layout: Layout) -> Sample {
    let kind = Kind {
        dyads: 0,
        sliders: false,
        joints: false,
        unknown_anywhere: false,
        moving: false,
        params: false,
        scalar: "f64",
    };
    let mut random = Random(seed);
    let base = [random.range(-1.0, 1.0), random.range(-1.0, 1.0)];
    let base = if matches!(layout, Layout::BehindFold(_)) { Layout::OnLattice } else { layout }.nearest(base);
    let mut builder = Builder::new(random, base, kind);
    builder.framed = true;
    builder.layout = layout;
    let drive = match layout {
        Layout::BehindFold(lengths) => builder.folding_four_bar(lengths),
        _ => builder.driven_link(false),
    };
    builder.drives.push(drive);
    match class {
        Class::Three => builder.triad(false),
        Class::ThreeWithSlider => builder.triad(true),
        Class::Four => builder.ring(),
        Class::Cascade => (0..6).for_each(|_| match builder.random.below(9) {
            0 | 1 => builder.slider_dyad(),
            2 => builder.sliding_pair(),
            3 => builder.pinned_sliders(),
            4 => builder.slider_on_slider(),
            _ => builder.pinned_dyad(),
        }),
    }
    let loads = builder.forces();
    let starts = if matches!(class, Class::Cascade) { String::new() } else { builder.starts_of_drives(0.0) };
    let mut sample = builder.finish(loads, Vec::new(), kind);
    sample.text.push_str(&starts);
    sample.text = sample.text.replace("scalar f64;\n", "");
    if !matches!(layout, Layout::Apart(distance) if distance < CLOSEST_IN_SINGLE) {
        sample.text = in_single_precision(&sample.text);
    }
    sample
}

/// How near pins of a linkage may be, as a part of its size, so that single precision tells its lengths apart.
pub const CLOSEST_IN_SINGLE: f64 = 0.99e-4;

/// A declaration with all its decimals rounded to single precision.
#[allow(clippy::cast_possible_truncation, reason = "that is the point")]
pub fn in_single_precision(text: &str) -> String {
    let mut rounded = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_alphanumeric()) {
        let (before, word) = rest.split_at(start);
        rounded.push_str(before);
        let decimal = |c: char| c.is_ascii_digit() || c == '.';
        let end = if word.starts_with(decimal) {
            let digits = word.find(|c: char| !decimal(c)).unwrap_or(word.len());
            // Small numbers have an exponent.
            let power = word[digits..].strip_prefix("e-");
            power.map_or(digits, |power| digits + 2 + power.find(|c: char| !decimal(c)).unwrap_or(power.len()))
        } else {
            word.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(word.len())
        };
        let (word, after) = word.split_at(end);
        match word.parse::<f64>() {
            Ok(value) if word.contains('.') => {
                let _ = write!(rounded, "{:?}", f64::from(value as f32));
            }
            _ => rounded.push_str(word),
        }
        rest = after;
    }
    rounded + rest
}

/// Where circles about two places meet, left of the way from the first to the second.
pub fn intersection([first, second]: [Place; 2], [r, s]: [f64; 2]) -> Option<Place> {
    let way = minus(second, first);
    let distance = size(way);
    let along = (distance * distance + r * r - s * s) / (2.0 * distance * distance);
    let across = (r * r / (distance * distance) - along * along).sqrt();
    let [x, y] = way;
    across.is_finite().then(|| plus(first, [along * x - across * y, along * y + across * x]))
}

/// How far a force along a line through `at` is from one that the first two lines hold: the determinant of three unit forces.
fn independence(lines: [(Place, Place); 3]) -> f64 {
    let row = |(at, along): (Place, Place)| {
        let u = along.map(|x| x / size(along));
        [u[0], u[1], cross(minus(at, lines[0].0), u)]
    };
    let [a, b, c] = lines.map(row);
    (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])).abs()
}

impl Builder {
    /// Two forces on two links, anywhere.
    fn forces(&mut self) -> Vec<[f64; 2]> {
        let moving = self.bodies.len() - 1;
        let first = 1 + self.random.below(moving);
        let second = 1 + (first + self.random.below(moving - 1)) % moving;
        [first, second]
            .map(|link| {
                let (point, at) = (self.fresh('p'), self.place());
                let _ = writeln!(self.items, "load L{point}: force({}.{point});", self.bodies[link].name);
                self.bodies[link].points.push((point, at));
                [self.random.range(-50.0, 50.0), self.random.range(-50.0, 50.0)]
            })
            .to_vec()
    }

    /// A link with points of its own.
    fn plate(&mut self, points: &[(&str, Place)]) -> usize {
        let link = self.link(points[0], points[1]);
        let others = points[2..].iter().map(|(name, at)| ((*name).to_owned(), *at));
        self.bodies[link].points.extend(others);
        link
    }

    /// Where a link starts: near where it is.
    fn start(&mut self, link: usize) {
        let most = 0.04 * self.layout.least();
        let mut off = || self.random.range(-most, most);
        let (dx, dy, turn) = (off(), off(), off());
        let Body { name, origin: [x, y], angle, .. } = &self.bodies[link];
        let line = format!("start {name}: ({:?}m, {:?}m), angle {:?}rad;\n", x + dx, y + dy, angle + turn);
        self.items.push_str(&line);
    }

    /// A ternary link on three legs.
    fn triad(&mut self, sliders: bool) {
        let n = self.bodies.len();
        let outer = [n - 1, self.random.below(n), self.random.below(n)];
        let names: Vec<String> = (0..6).map(|_| self.fresh('J')).collect();
        let (feet, tips, slides) = loop {
            let feet = [self.place(), self.place(), self.place()];
            let tips = [self.place(), self.place(), self.place()];
            let slides = sliders && self.random.chance(0.4);
            let lines = [0, 1, 2].map(|i| {
                let leg = minus(tips[i], feet[i]);
                // A slider holds its pin across the line on which it goes.
                (tips[i], if slides && i == 2 { [-leg[1], leg[0]] } else { leg })
            });
            let least = self.layout.least();
            let apart = |a: Place, b: Place| size(minus(a, b)) > 0.4 * least;
            let arms = [1, 2].map(|i| size(minus(tips[i], tips[0])));
            let arm = if least < 1.0 { arms[0].max(arms[1]) } else { 1.0 };
            if (0..3).all(|i| apart(feet[i], tips[i]) && apart(tips[i], tips[(i + 1) % 3]))
                && independence(lines) > 0.4 * arm
            {
                break (feet, tips, slides);
            }
        };
        let plate = self.plate(&[(&names[3], tips[0]), (&names[4], tips[1]), (&names[5], tips[2])]);
        for i in 0..3 {
            let (foot, tip) = (names[i].clone(), names[i + 3].clone());
            self.bodies[outer[i]].points.push((foot.clone(), feet[i]));
            if slides && i == 2 {
                let along = minus(tips[i], feet[i]);
                let slider = self.link((&tip, tips[i]), (&foot, plus(feet[i], along.map(|x| 0.3 * x))));
                self.revolute(&tip, plate, slider);
                let (from, to) = self.arrow(outer[i], slider);
                let carrier = *self.random.pick(&[outer[i], slider]);
                let local = along[1].atan2(along[0]) - self.bodies[carrier].angle;
                let fixed = self.bodies[to].angle - self.bodies[from].angle;
                let line = format!(
                    "prismatic {foot}: {} -> {} along {local:?}rad of {}, angle {fixed:?}rad;\n",
                    self.bodies[from].name, self.bodies[to].name, self.bodies[carrier].name
                );
                self.items.push_str(&line);
                self.start(slider);
                self.places.push((tip, tips[i]));
            } else {
                let leg = self.link((&foot, feet[i]), (&tip, tips[i]));
                self.revolute(&foot, outer[i], leg);
                self.revolute(&tip, leg, plate);
                self.start(leg);
                self.places.extend([(foot, feet[i]), (tip, tips[i])]);
            }
        }
        self.start(plate);
    }

    /// Two ternary links joined by two others: class IV.
    fn ring(&mut self) {
        let n = self.bodies.len();
        let outer = [n - 1, self.random.below(n)];
        let names: Vec<String> = (0..6).map(|_| self.fresh('J')).collect();
        // Feet a and b; c, d on the first plate, e, f on the second; legs c-e and d-f.
        let [a, b, c, d, e, f] = loop {
            let [a, b, c, d, e, f] = [(); 6].map(|()| self.place());
            let least = self.layout.least();
            let apart = |a: Place, b: Place| size(minus(a, b)) > 0.4 * least;
            let unit = |v: Place| v.map(|x| x / size(v));
            let far = [(a, c), (a, d), (c, d), (b, e), (b, f), (e, f), (c, e), (d, f), (a, b)];
            if !far.into_iter().all(|(p, q)| apart(p, q)) {
                continue;
            }
            // The rates at which the plates' turns stretch the legs.
            let (u, v) = (unit(minus(e, c)), unit(minus(f, d)));
            let rates = [cross(minus(c, a), u), cross(minus(e, b), u), cross(minus(d, a), v), cross(minus(f, b), v)];
            let rate = (rates[0] * rates[3] - rates[1] * rates[2]).abs();
            let firm = if least < 1.0 {
                rate > 0.4 * size(minus(c, a)).max(size(minus(d, a))) * size(minus(e, b)).max(size(minus(f, b)))
            } else {
                rate > 0.6 && iterated::ring_is_firm([a, b, c, d, e, f], self.base)
            };
            if firm {
                break [a, b, c, d, e, f];
            }
        };
        self.bodies[outer[0]].points.push((names[0].clone(), a));
        self.bodies[outer[1]].points.push((names[1].clone(), b));
        let first = self.plate(&[(&names[0], a), (&names[2], c), (&names[3], d)]);
        let second = self.plate(&[(&names[1], b), (&names[4], e), (&names[5], f)]);
        let upper = self.link((&names[2], c), (&names[4], e));
        let lower = self.link((&names[3], d), (&names[5], f));
        self.revolute(&names[0], outer[0], first);
        self.revolute(&names[1], outer[1], second);
        self.revolute(&names[2], first, upper);
        self.revolute(&names[4], second, upper);
        self.revolute(&names[3], lower, first);
        self.revolute(&names[5], lower, second);
        for link in [first, second, upper, lower] {
            self.start(link);
        }
        self.places.extend(names.into_iter().zip([a, b, c, d, e, f]));
    }

    fn fresh(&mut self, letter: char) -> String {
        self.names += 1;
        format!("{letter}{}", self.names)
    }

    fn place(&mut self) -> Place {
        let at = plus(self.base, [self.random.range(-2.0, 2.0), self.random.range(-2.0, 2.0)]);
        let Layout::Apart(distance) = self.layout else { return self.layout.nearest(at) };
        let at = if !self.drawn.is_empty() && self.random.chance(0.4) {
            let other = *self.random.pick(&self.drawn);
            plus(other, minus(at, self.base).map(|x| 0.5 * distance * x))
        } else {
            at
        };
        self.drawn.push(at);
        at
    }

    fn angle(&mut self) -> f64 {
        let angle = self.random.range(-3.0, 3.0);
        self.layout.turned(angle)
    }

    fn link(&mut self, first: (&str, Place), second: (&str, Place)) -> usize {
        let name = self.fresh('l');
        let arm = minus(second.1, first.1);
        // On a lattice both points may be one place.
        let framed = if self.framed { size(arm) > 0.0 } else { self.random.chance(0.5) };
        let (origin, angle) = if framed {
            (first.1, arm[1].atan2(arm[0]))
        } else if self.framed {
            (first.1, 0.0)
        } else {
            (self.place(), self.angle())
        };
        let points = vec![(first.0.to_owned(), first.1), (second.0.to_owned(), second.1)];
        self.bodies.push(Body { name, origin, angle, points, framed, mass: None });
        self.bodies.len() - 1
    }

    fn arrow(&mut self, near: usize, far: usize) -> (usize, usize) {
        if self.random.chance(0.5) { (near, far) } else { (far, near) }
    }

    /// A pin, or one in a slot along which it is driven.
    fn revolute(&mut self, name: &str, near: usize, far: usize) -> (usize, usize) {
        let (from, to) = self.arrow(near, far);
        if self.driven_slots && self.random.chance(0.3) {
            let (datum, angle) = (format!("{name}o"), self.random.range(-3.0, 3.0));
            let at = self.bodies[to].points.iter().find(|(point, _)| point == name).expect("its point").1;
            let travel = self.random.range(-2.0, 2.0);
            self.bodies[from].points.push((datum.clone(), minus(at, direction(angle).map(|x| x * travel))));
            let carrier_first = self.slot(name, (from, &datum), (to, name), angle);
            self.drives.push((format!("{name}.travel"), if carrier_first { travel } else { -travel }));
            return (from, to);
        }
        let line = format!("revolute {name}: {} -> {};\n", self.bodies[from].name, self.bodies[to].name);
        self.items.push_str(&line);
        self.pins.push((name.to_owned(), from, to));
        (from, to)
    }

    fn driven_link(&mut self, sliders: bool) -> (String, f64) {
        let joint = self.fresh('J');
        let at = self.place();
        self.places.push((joint.clone(), at));
        self.bodies[0].points.push((joint.clone(), at));
        if sliders && self.random.chance(0.25) {
            let angle = self.random.range(-3.0, 3.0);
            let travel = self.random.range(-1.5, 1.5);
            let end = plus(at, direction(angle).map(|x| x * travel));
            self.places.pop();
            let other = self.place();
            let link = self.link((&joint, end), (&format!("{joint}x"), other));
            let (from, to) = self.arrow(0, link);
            let fixed = self.bodies[to].angle - self.bodies[from].angle;
            let line = format!(
                "prismatic {joint}: {} -> {} along {angle:?}rad, angle {fixed:?}rad;\n",
                self.bodies[from].name, self.bodies[to].name
            );
            self.items.push_str(&line);
            self.places.push((joint.clone(), end));
            let travel = if to == link { travel } else { -travel };
            return (joint, travel);
        }
        let (length, angle) = (self.random.range(0.5, 1.5), self.angle());
        let small = match self.layout {
            Layout::Apart(distance) if self.random.chance(0.3) => distance,
            _ => 1.0,
        };
        let end = self.layout.nearest(plus(at, direction(angle).map(|x| x * length * small)));
        let tip = format!("{joint}x");
        let link = self.link((&joint, at), (&tip, end));
        let (_, to) = self.revolute(&joint, 0, link);
        let theta = if to == link { self.bodies[link].angle } else { -self.bodies[link].angle };
        (joint, theta)
    }

    /// A four-bar near its fold, and its drive.
    fn folding_four_bar(&mut self, [ground, crank, coupler, rocker]: [f64; 4]) -> (String, f64) {
        let [joint, p, q, b] = [self.fresh('J'), self.fresh('J'), self.fresh('J'), self.fresh('J')];
        let (at, at_q) = (self.base, plus(self.base, [ground, 0.0]));
        let (tip, at_b) = loop {
            let fold = if self.random.chance(0.5) { 0.0 } else { core::f64::consts::PI };
            let turned = self.random.range(0.1, 0.6);
            let angle = if self.random.chance(0.5) { fold + turned } else { fold - turned };
            let tip = plus(at, direction(angle).map(|x| x * crank));
            if let Some(at_b) = intersection([tip, at_q], [coupler, rocker]) {
                break (tip, at_b);
            }
        };
        let points = [(joint.clone(), at), (q.clone(), at_q)];
        self.bodies[0].points.extend(points);
        self.places.push((joint.clone(), at));
        let link = self.link((&joint, at), (&p, tip));
        let (_, to) = self.revolute(&joint, 0, link);
        self.close_pinned(link, 0, [&p, &q, &b], tip, at_q, at_b);
        let angle = self.bodies[link].angle;
        (joint, if to == link { angle } else { -angle })
    }

    /// A point for a dyad's outer joint on a placed link, under the joint's name.
    fn outer(&mut self, joint: &str, link: usize) -> Place {
        // Often a point that is there already: several joints at one place.
        // But for the pin on which a moving link hangs, from which the dyad would get no motion.
        let first = usize::from(link > 0);
        let at = if self.random.chance(0.4) && self.bodies[link].points.len() > first {
            let index = first + self.random.below(self.bodies[link].points.len() - first);
            self.bodies[link].points[index].1
        } else {
            self.place()
        };
        self.bodies[link].points.push((joint.to_owned(), at));
        at
    }

    fn two_links(&mut self) -> (usize, usize) {
        let n = self.bodies.len();
        // The youngest link takes part, so that the linkage is a cascade.
        let x = if self.random.chance(0.7) { n - 1 } else { self.random.below(n) };
        let mut y = self.random.below(n);
        if y == x {
            y = (x + 1) % n;
        }
        (x, y)
    }

    fn pinned_dyad(&mut self) {
        let (x, y) = self.two_links();
        let [p, q, b] = [self.fresh('J'), self.fresh('J'), self.fresh('J')];
        let (at_p, at_q) = (self.outer(&p, x), self.outer(&q, y));
        let least = self.layout.least();
        let at_b = loop {
            let at = self.place();
            let (u, v) = (minus(at, at_p), minus(at, at_q));
            if size(u) > 0.3 * least
                && size(v) > 0.3 * least
                && (cross(u, v) / (size(u) * size(v))).abs() > self.sines
                && size(minus(at_p, at_q)) > 0.2 * least
            {
                break at;
            }
            if size(minus(at_p, at_q)) <= 0.2 * least {
                // Too close together: take the second point elsewhere.
                let moved = self.place();
                let own = self.bodies[y].points.len() - 1;
                self.bodies[y].points[own].1 = moved;
                return self.finish_pinned(x, y, [&p, &q, &b], at_p, moved);
            }
        };
        self.close_pinned(x, y, [&p, &q, &b], at_p, at_q, at_b);
    }

    fn finish_pinned(&mut self, x: usize, y: usize, names: [&str; 3], at_p: Place, at_q: Place) {
        let least = self.layout.least();
        let at_b = loop {
            let at = self.place();
            let (u, v) = (minus(at, at_p), minus(at, at_q));
            if size(u) > 0.3 * least && size(v) > 0.3 * least && (cross(u, v) / (size(u) * size(v))).abs() > 0.05 {
                break at;
            }
        };
        self.close_pinned(x, y, names, at_p, at_q, at_b);
    }

    fn close_pinned(&mut self, x: usize, y: usize, [p, q, b]: [&str; 3], at_p: Place, at_q: Place, at_b: Place) {
        let first = self.link((p, at_p), (b, at_b));
        let second = self.link((q, at_q), (b, at_b));
        self.revolute(p, x, first);
        self.revolute(q, y, second);
        self.revolute(b, first, second);
        self.places.extend([(p.to_owned(), at_p), (q.to_owned(), at_q), (b.to_owned(), at_b)]);
        let left = cross(minus(at_q, at_p), minus(at_b, at_p)) > 0.0;
        let (start, end, left) = if self.random.chance(0.5) { (p, q, left) } else { (q, p, !left) };
        self.assemble(b, if left { "left" } else { "right" }, &format!("{start} -> {end}"), left);
    }

    fn slider_dyad(&mut self) {
        let (x, y) = self.two_links();
        let [p, b, s] = [self.fresh('J'), self.fresh('J'), self.fresh('J')];
        let at_p = self.outer(&p, x);
        let (angle, least) = (self.angle(), self.layout.least());
        let e = direction(angle);
        let at_b = loop {
            let at = self.place();
            let u = minus(at, at_p);
            if size(u) > 0.3 * least && (dot(u, e) / size(u)).abs() > self.sines {
                break at;
            }
        };
        let guide = self.place();
        let travel = self.random.range(-2.0, 2.0);
        let runner = plus(guide, e.map(|x| x * travel));
        self.bodies[y].points.push((s.clone(), guide));
        let rod = self.link((&p, at_p), (&b, at_b));
        let slider = self.link((&b, at_b), (&s, runner));
        self.revolute(&p, x, rod);
        self.revolute(&b, rod, slider);
        let (from, to) = self.arrow(y, slider);
        let carrier = *self.random.pick(&[y, slider]);
        self.guide(&s, (from, to), carrier, angle);
        self.side(&b, &p, dot(minus(at_b, at_p), e));
        let on_line = if carrier == y { runner } else { guide };
        self.places.extend([(p, at_p), (b, at_b), (s, on_line)]);
    }

    /// A link welded to a moving one.
    fn weld(&mut self) {
        let x = 1 + self.random.below(self.bodies.len() - 1);
        let w = self.fresh('J');
        let at = self.outer(&w, x);
        let other = self.place();
        let link = self.link((&w, at), (&format!("{w}x"), other));
        let (from, to) = self.arrow(x, link);
        let fixed = self.bodies[to].angle - self.bodies[from].angle;
        let line = format!("weld {w}: {} -> {}, angle {fixed:?}rad;\n", self.bodies[from].name, self.bodies[to].name);
        self.items.push_str(&line);
        self.places.push((w, at));
    }

    /// The item of a slot; the first of the ends carries it. Whether that is also the first one of the item.
    fn slot(&mut self, name: &str, (carrier, datum): (usize, &str), (other, pin): (usize, &str), angle: f64) -> bool {
        let local = angle - self.bodies[carrier].angle;
        let ends = [(carrier, datum), (other, pin)].map(|(link, point)| format!("{}.{point}", self.bodies[link].name));
        let [first, second] = if self.random.chance(0.5) { [0, 1] } else { [1, 0] };
        let line = format!(
            "slot {name}: {} -> {} along {local:?}rad of {};\n",
            ends[first], ends[second], self.bodies[carrier].name
        );
        self.items.push_str(&line);
        first == 0
    }

    /// A slide with its line on one of its links, or a slot whose links a drive turns.
    fn guide(&mut self, name: &str, (from, to): (usize, usize), carrier: usize, angle: f64) {
        // Along the axis the second point must lie on the line through the first, whichever link carries it.
        let local = angle - self.bodies[carrier].angle;
        let fixed = self.bodies[to].angle - self.bodies[from].angle;
        let ends = format!(
            "{name}: {} -> {} along {local:?}rad of {}",
            self.bodies[from].name, self.bodies[to].name, self.bodies[carrier].name
        );
        if self.driven_slots && self.random.chance(0.5) {
            let _ = writeln!(self.items, "slot {ends};");
            self.drives.push((format!("{name}.angle"), fixed));
        } else {
            let _ = writeln!(self.items, "prismatic {ends}, angle {fixed:?}rad;");
        }
    }

    /// A direction that is not across the way from a place to another.
    fn inclined(&mut self, way: Place) -> f64 {
        loop {
            let angle = self.random.range(-3.0, 3.0);
            if (dot(way, direction(angle)) / size(way)).abs() > self.sines {
                return angle;
            }
        }
    }

    fn side(&mut self, inner: &str, outer: &str, along: f64) {
        let side = if along > 0.0 { "ahead" } else { "behind" };
        self.assemble(inner, side, outer, along > 0.0);
    }

    /// A closure, now and then as an argument.
    fn assemble(&mut self, inner: &str, side: &str, of: &str, plus: bool) {
        let side = if self.either && self.random.chance(0.3) { "either" } else { side };
        let _ = writeln!(self.items, "assemble {inner}: {side}({of});");
        self.sides.push(if plus { 1.0 } else { -1.0 });
    }

    /// A lever on a pin, whose slot holds a pin of another link.
    fn lever(&mut self) {
        let (x, y) = self.two_links();
        let [p, s] = [self.fresh('J'), self.fresh('J')];
        let at_p = self.outer(&p, x);
        let at_s = loop {
            let at = self.place();
            if size(minus(at, at_p)) > 0.4 {
                break at;
            }
        };
        self.bodies[y].points.push((s.clone(), at_s));
        let way = minus(at_s, at_p);
        // The slot goes through the lever's own pin, or past it.
        let (lever, own, angle) = if self.random.chance(0.5) {
            let ahead = if self.random.chance(0.5) { way } else { way.map(|x| -x) };
            let other = self.place();
            (self.link((&p, at_p), (&format!("{s}x"), other)), p.clone(), ahead[1].atan2(ahead[0]))
        } else {
            let (angle, own) = (self.inclined(way), format!("{s}o"));
            let travel = self.random.range(-2.0, 2.0);
            let datum = minus(at_s, direction(angle).map(|x| x * travel));
            (self.link((&p, at_p), (&own, datum)), own, angle)
        };
        self.revolute(&p, x, lever);
        self.slot(&s, (lever, &own), (y, &s), angle);
        self.side(&s, &p, dot(way, direction(angle)));
        self.places.extend([(p, at_p), (s, at_s)]);
    }

    /// A link on a pin, whose end runs in the slot of another link.
    fn runner(&mut self) {
        let (x, y) = self.two_links();
        let [p, s] = [self.fresh('J'), self.fresh('J')];
        let at_p = self.outer(&p, x);
        let at_s = loop {
            let at = self.place();
            if size(minus(at, at_p)) > 0.4 {
                break at;
            }
        };
        let way = minus(at_s, at_p);
        let angle = self.inclined(way);
        let travel = self.random.range(-2.0, 2.0);
        let datum = format!("{s}o");
        self.bodies[y].points.push((datum.clone(), minus(at_s, direction(angle).map(|x| x * travel))));
        let link = self.link((&p, at_p), (&s, at_s));
        self.revolute(&p, x, link);
        self.slot(&s, (y, &datum), (link, &s), angle);
        self.side(&s, &p, dot(way, direction(angle)));
        self.places.extend([(p, at_p), (s, at_s)]);
    }

    /// A link on a slide and in a slot: its own, or that of another link.
    fn yoke(&mut self) {
        let (x, y) = self.two_links();
        let [g, s] = [self.fresh('J'), self.fresh('J')];
        let (slide, at_s) = (self.random.range(-3.0, 3.0), self.place());
        let angle = self.inclined(direction(slide + core::f64::consts::FRAC_PI_2));
        let (guide, travel, run) = (self.place(), self.random.range(-2.0, 2.0), self.random.range(-2.0, 2.0));
        let runner = plus(guide, direction(slide).map(|x| x * travel));
        let datum = minus(at_s, direction(angle).map(|x| x * run));
        self.bodies[x].points.push((g.clone(), guide));
        let (pin, line) = (s.clone(), format!("{s}o"));
        let carries = self.random.chance(0.5);
        let ((own, own_at), (its, its_at)) =
            if carries { ((&line, datum), (&pin, at_s)) } else { ((&pin, at_s), (&line, datum)) };
        self.bodies[y].points.push((its.clone(), its_at));
        let link = self.link((&g, runner), (own, own_at));
        let (from, to) = self.arrow(x, link);
        let carrier = *self.random.pick(&[x, link]);
        self.guide(&g, (from, to), carrier, slide);
        if carries {
            self.slot(&s, (link, &line), (y, &pin), angle);
        } else {
            self.slot(&s, (y, &line), (link, &pin), angle);
        }
        self.places.extend([(g, if carrier == x { runner } else { guide }), (s, at_s)]);
    }

    /// A wheel on the arm of another one, which may be any link on a pin.
    fn wheel(&mut self) {
        if self.pins.is_empty() {
            return self.pinned_dyad();
        }
        // Its own pin is one that may hold further wheels.
        self.driven_slots = false;
        let (centre, a, b) = self.random.pick(&self.pins.clone()).clone();
        let (arm, wheel) = self.arrow(a, b);
        let points = &self.bodies[arm].points;
        let at = points.iter().find(|(name, _)| *name == centre).expect("a pin's point").1;
        let p = self.fresh('J');
        let own = loop {
            let own = self.place();
            if size(minus(own, at)) > 0.3 {
                break own;
            }
        };
        self.bodies[arm].points.push((p.clone(), own));
        let other = self.place();
        let link = self.link((&p, own), (&format!("{p}x"), other));
        self.revolute(&p, arm, link);
        let (g, touch, _) = self.mesh(arm, [(wheel, &centre, at), (link, &p, own)]);
        self.places.extend([(p, own), (g, touch)]);
    }

    /// A value with its unit, or the parameter of this dimension that has it.
    fn value(&mut self, value: f64, [dimension, unit]: [&'static str; 2]) -> String {
        match &mut self.values {
            Some(values) => {
                values.push((dimension, value));
                format!("r{}", values.len() - 1)
            }
            None => format!("{value:?}{unit}"),
        }
    }

    /// A gear pair of two wheels on the pins of an arm: its name, where the teeth touch, and its radii, that of a pinion in a ring negative.
    /// The ring, if there is one, is the first.
    fn mesh(&mut self, arm: usize, ends: [(usize, &str, Place); 2]) -> (String, Place, [(usize, f64); 2]) {
        let g = self.fresh('J');
        let [first, second] = if self.random.chance(0.5) { [ends[0], ends[1]] } else { [ends[1], ends[0]] };
        let way = minus(second.2, first.2);
        let distance = size(way);
        let ring = self.random.chance(0.4);
        let ratio = self.random.range(0.2, 0.8);
        let radii = if ring {
            [distance / ratio, distance / ratio - distance]
        } else {
            [distance * ratio, distance - distance * ratio]
        };
        let signed = [radii[0], if ring { -radii[1] } else { radii[1] }];
        let e = direction(self.bodies[arm].angle);
        // Where both centres are on the arm's x axis, that is exact in its frame.
        let across = cross(e, way);
        let within = (if across.abs() < 1e-12 { 0.0 } else { across }).atan2(dot(e, way));
        let psi = self.bodies[arm].angle + within;
        let angles = [first.0, second.0].map(|link| self.bodies[link].angle);
        let phase = signed[0] * (angles[0] - psi) + signed[1] * (angles[1] - psi);
        let mut options = String::from(if ring { ", internal" } else { "" });
        if self.random.chance(0.5) {
            let (angle, flank) = (self.random.range(0.1, 0.5), *self.random.pick(&["left", "right"]));
            let _ = write!(options, ", pressure_angle {angle:?}rad, flank {flank}");
        }
        let written = radii.map(|radius| self.value(radius, ["length", "m"]));
        let line = format!(
            "gear {g}: {}.{} -> {}.{}, radii ({}), phase {phase:?}m{options};\n",
            self.bodies[first.0].name,
            first.1,
            self.bodies[second.0].name,
            second.1,
            written.join(", ")
        );
        self.items.push_str(&line);
        let touch = plus(first.2, way.map(|x| x * signed[0] / (signed[0] + signed[1])));
        (g, touch, [(first.0, signed[0]), (second.0, signed[1])])
    }

    /// A slide between two links that are placed here, with its line anywhere.
    fn slide(&mut self, name: &str, near: usize, far: usize, angle: f64) {
        let (start, travel) = (self.place(), self.random.range(-2.0, 2.0));
        let end = plus(start, direction(angle).map(|x| x * travel));
        let (from, to) = self.arrow(near, far);
        self.bodies[from].points.push((name.to_owned(), start));
        self.bodies[to].points.push((name.to_owned(), end));
        let carrier = *self.random.pick(&[from, to]);
        self.guide(name, (from, to), carrier, angle);
        let runner = if carrier == from { end } else { start };
        self.places.push((name.to_owned(), runner));
    }

    /// Two outer pins, and a slide between the links on them.
    fn sliding_pair(&mut self) {
        let (x, y) = self.two_links();
        let [p, q, s] = [self.fresh('J'), self.fresh('J'), self.fresh('J')];
        let (at_p, angle, least) = (self.outer(&p, x), self.angle(), self.layout.least());
        let e = direction(angle);
        let at_q = loop {
            let at = self.place();
            if dot(minus(at, at_p), e).abs() > 0.3 * least + self.sines * size(minus(at, at_p)) {
                break at;
            }
        };
        self.bodies[y].points.push((q.clone(), at_q));
        let (px, qx) = (self.place(), self.place());
        let first = self.link((&p, at_p), (&format!("{p}x"), px));
        let second = self.link((&q, at_q), (&format!("{q}x"), qx));
        self.revolute(&p, x, first);
        self.revolute(&q, y, second);
        self.slide(&s, first, second, angle);
        let ahead = dot(minus(at_q, at_p), e) > 0.0;
        let (of, ahead) = if self.random.chance(0.5) { (&p, ahead) } else { (&q, !ahead) };
        self.assemble(&s, if ahead { "ahead" } else { "behind" }, of, ahead);
        self.places.extend([(p, at_p), (q, at_q)]);
    }

    /// Two directions that are not nearly parallel.
    fn two_directions(&mut self) -> [f64; 2] {
        let first = self.random.range(-3.0, 3.0);
        let turn = self.random.range(0.3, 2.8);
        let second = if self.random.chance(0.5) { first + turn } else { first - turn };
        let [one, two] = [first, second].map(|angle| self.layout.turned(angle));
        // Quarter turns may be nearest that are parallel.
        [one, if cross(direction(one), direction(two)).abs() < 0.2 { one + core::f64::consts::FRAC_PI_2 } else { two }]
    }

    /// Two sliders with a pin between them.
    fn pinned_sliders(&mut self) {
        let (x, y) = self.two_links();
        let [b, s, t] = [self.fresh('J'), self.fresh('J'), self.fresh('J')];
        let at = self.place();
        let links = [x, y].map(|_| {
            let other = self.place();
            let name = format!("{b}x");
            self.link((&b, at), (&name, other))
        });
        self.revolute(&b, links[0], links[1]);
        let [one, two] = self.two_directions();
        self.slide(&s, x, links[0], one);
        self.slide(&t, y, links[1], two);
        self.places.push((b, at));
    }

    /// A slider, and another one on it with a pin.
    fn slider_on_slider(&mut self) {
        let (x, y) = self.two_links();
        let [p, s, t] = [self.fresh('J'), self.fresh('J'), self.fresh('J')];
        let at = self.outer(&p, x);
        let (px, a, b) = (self.place(), self.place(), self.place());
        let pinned = self.link((&p, at), (&format!("{p}x"), px));
        let slider = self.link((&format!("{t}x"), a), (&format!("{t}y"), b));
        self.revolute(&p, x, pinned);
        let [one, two] = self.two_directions();
        self.slide(&s, pinned, slider, one);
        self.slide(&t, y, slider, two);
        self.places.push((p, at));
    }

    /// A dyad whose first link is two: welded, or a cylinder with its driven rod.
    fn split(&mut self, welded: bool) {
        let before = self.bodies.len();
        self.driven_slots = false;
        if self.random.chance(0.3) {
            self.slider_dyad();
        } else {
            self.pinned_dyad();
        }
        // The first link becomes the tube, and a rod takes over its pin to the second one.
        let (tube, other) = (before, before + 1);
        let own = &self.bodies[other].points;
        let shared = self.bodies[tube].points.iter().find(|(name, _)| own.iter().any(|(point, _)| point == name));
        let (pin, at) = shared.expect("the inner pin").clone();
        let (s, rx) = (self.fresh('J'), self.place());
        let rod = self.link((&pin, at), (&format!("{s}x"), rx));
        let (old, new) = (self.bodies[tube].name.clone(), self.bodies[rod].name.clone());
        let mark = format!("revolute {pin}: ");
        let lines = self.items.lines().map(|line| {
            let line = if line.starts_with(&mark) {
                line.replace(&format!(" {old} "), &format!(" {new} ")).replace(&format!(" {old};"), &format!(" {new};"))
            } else {
                line.to_owned()
            };
            line + "\n"
        });
        self.items = lines.collect();
        // Its pin is no longer on the links that hold it for wheels.
        self.pins.retain(|(name, ..)| *name != pin);
        if welded {
            let at = self.place();
            let (from, to) = self.arrow(tube, rod);
            [tube, rod].into_iter().for_each(|link| self.bodies[link].points.push((s.clone(), at)));
            let fixed = self.bodies[to].angle - self.bodies[from].angle;
            let _ = writeln!(
                self.items,
                "weld {s}: {} -> {}, angle {fixed:?}rad;",
                self.bodies[from].name, self.bodies[to].name
            );
            self.places.push((s, at));
            return;
        }
        let angle = self.random.range(-3.0, 3.0);
        self.slide(&s, tube, rod, angle);
        let ends = [tube, rod].map(|body| self.bodies[body].points.last().expect("its end").1);
        let [tube_end, rod_end] = ends;
        let from_tube = self.items.lines().last().expect("the slide").contains(&format!("{s}: {old} -> "));
        let gap = minus(rod_end, tube_end);
        let travel = dot(if from_tube { gap } else { gap.map(|x| -x) }, direction(angle));
        self.drives.push((s, travel));
    }

    fn masses(&mut self) {
        for index in 1..self.bodies.len() {
            if self.random.chance(0.5) {
                let (mass, x, y) =
                    (self.random.range(0.1, 3.0), self.random.range(-1.0, 1.0), self.random.range(-1.0, 1.0));
                let (name, mass) = (self.bodies[index].name.clone(), self.value(mass, ["mass", "kg"]));
                let mut text = format!("mass {name}: {mass} at ({x:?}m, {y:?}m);\n");
                if self.random.chance(0.3) {
                    let inertia = self.value(1.0, ["inertia", "kg*m^2"]);
                    let _ = writeln!(text, "mass {name}: {mass} at ({y:?}m, {x:?}m), inertia {inertia};");
                }
                self.bodies[index].mass = Some(text);
            }
        }
    }

    /// Loads and the unknown; the arguments of the loads that are given at run time.
    fn loads(&mut self, unknown_anywhere: bool) -> Vec<[f64; 2]> {
        let mut arguments = Vec::new();
        let count = 1 + self.random.below(4);
        let moving = self.bodies.len() - 1;
        for number in 0..count {
            let link = 1 + self.random.below(moving);
            let value = [self.random.range(-50.0, 50.0), self.random.range(-50.0, 50.0)];
            let given = self.random.chance(0.5);
            let name = self.bodies[link].name.clone();
            let line = if self.random.chance(0.7) {
                let point = self.fresh('p');
                let at = self.place();
                self.bodies[link].points.push((point.clone(), at));
                let frame = if self.random.chance(0.3) {
                    let other = 1 + self.random.below(moving);
                    format!(" in {}", self.bodies[other].name)
                } else {
                    String::new()
                };
                let constant = if given {
                    String::new()
                } else {
                    let [x, y] = value.map(|part| self.value(part, ["force", "N"]));
                    format!(" = ({x}, {y})")
                };
                format!("load L{number}: force({name}.{point}){frame}{constant};\n")
            } else {
                let constant =
                    if given { String::new() } else { format!(" = {}", self.value(value[0], ["moment", "N*m"])) };
                let other = self.random.below(moving + 1);
                if other == link {
                    format!("load L{number}: moment({name}){constant};\n")
                } else {
                    format!("load L{number}: moment({} -> {name}){constant};\n", self.bodies[other].name)
                }
            };
            self.items.push_str(&line);
            arguments.push(value);
        }
        for number in 0..self.random.below(3) {
            let (line, values) = self.between(number);
            self.items.push_str(&line);
            arguments.push(values);
        }
        if self.bodies.iter().any(|body| body.mass.is_some()) {
            if self.random.chance(0.5) {
                self.items.push_str("load W: gravity = 9.81m/s^2 @ -90deg;\n");
            } else {
                self.items.push_str("load W: gravity;\n");
            }
            arguments.push([self.random.range(-1.0, 1.0), -9.81]);
        }
        if unknown_anywhere && self.drives.len() <= 3 && self.random.chance(0.7) {
            for number in 0..self.drives.len() {
                let line = self.unknown(number);
                self.items.push_str(&line);
            }
        }
        arguments
    }

    /// An unknown that acts anywhere; of several, some at a drive.
    fn unknown(&mut self, number: usize) -> String {
        if self.drives.len() > 1 && self.random.chance(0.4) {
            return format!("unknown E{number}: effort(q{number});\n");
        }
        let moving = self.bodies.len() - 1;
        let link = 1 + self.random.below(moving);
        let name = self.bodies[link].name.clone();
        if self.random.chance(0.4) {
            format!("unknown E{number}: thrust({});\n", self.two_points())
        } else if self.random.chance(0.5) {
            let mut other = self.random.below(moving + 1);
            if other == link {
                other = 0;
            }
            format!("unknown E{number}: torque({} -> {name});\n", self.bodies[other].name)
        } else {
            let point = self.fresh('p');
            let at = self.place();
            self.bodies[link].points.push((point.clone(), at));
            let angle = self.random.range(-3.0, 3.0);
            let frame = self.random.below(moving + 1);
            format!("unknown E{number}: force({name}.{point}) along {angle:?}rad of {};\n", self.bodies[frame].name)
        }
    }

    /// Two points of two links, as they are written.
    fn two_points(&mut self) -> String {
        let moving = self.bodies.len() - 1;
        let link = 1 + self.random.below(moving);
        let mut other = self.random.below(moving + 1);
        if other == link {
            other = 0;
        }
        let mut ends = [(other, self.place()), (link, self.place())];
        while size(minus(ends[0].1, ends[1].1)) < 0.3 {
            ends[1].1 = self.place();
        }
        if self.random.chance(0.5) {
            ends.reverse();
        }
        let ends = ends.map(|(link, at)| {
            let point = self.fresh('p');
            self.bodies[link].points.push((point.clone(), at));
            format!("{}.{point}", self.bodies[link].name)
        });
        ends.join(", ")
    }

    /// What acts between two links: a thrust, a spring, a torsion spring; and its values if they are given at run time.
    fn between(&mut self, number: usize) -> (String, [f64; 2]) {
        let given = self.random.chance(0.5);
        let kind = self.random.below(4);
        if kind == 0 {
            let force = self.random.range(-50.0, 50.0);
            let constant = if given { String::new() } else { format!(" = {}", self.value(force, ["force", "N"])) };
            return (format!("load B{number}: thrust({}){constant};\n", self.two_points()), [force, 0.0]);
        }
        let (rate, free) = (self.random.range(1.0, 50.0), self.random.range(0.0, 3.0));
        if kind == 1 {
            let moving = self.bodies.len() - 1;
            let link = 1 + self.random.below(moving);
            let other = self.random.below(link);
            let (from, on) = self.arrow(link, other);
            let (from, on) = (&self.bodies[from].name, &self.bodies[on].name);
            let (from, on) = (from.clone(), on.clone());
            let fields = if given {
                "rate: _, free: _".to_owned()
            } else {
                let rate = self.value(rate, ["torsion_stiffness", "N*m/rad"]);
                format!("rate: {rate}, free: {}", self.value(free, ["angle", "rad"]))
            };
            return (format!("load B{number}: torsion({from} -> {on}) {{ {fields} }}\n"), [rate, free]);
        }
        // Among them such as have no free length.
        let free = if kind == 2 { 0.0 } else { free };
        let preload = if self.random.chance(0.3) { self.random.range(-20.0, 20.0) } else { 0.0 };
        let length = if kind == 2 { "0".to_owned() } else { format!("{free:?}m") };
        let fields = match (given, self.random.chance(0.5)) {
            (true, true) => "rate: _, free: _".to_owned(),
            (true, false) => format!("rate: _, free: {length}"),
            _ => {
                let length = if kind == 2 { length } else { self.value(free, ["length", "m"]) };
                format!("rate: {}, free: {length}", self.value(rate, ["stiffness", "N/m"]))
            }
        };
        let fields =
            if preload == 0.0 { fields } else { format!("{fields}, preload: {}", self.value(preload, ["force", "N"])) };
        (format!("load B{number}: spring({}) {{ {fields} }};\n", self.two_points()), [rate, free])
    }

    /// Inertia and dampers; rate and acceleration of each drive.
    fn motion(&mut self, loads: &mut Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        if self.bodies.iter().any(|body| body.mass.is_some()) {
            self.items.push_str("load I: inertia;\n");
            loads.push([0.0; 2]);
        }
        let moving = self.bodies.len() - 1;
        let (rate, damping) = (self.random.range(1.0, 50.0), self.random.range(0.5, 9.0));
        let free = self.random.range(0.0, 3.0);
        let line = match self.random.below(4) {
            0 => {
                let damping = self.value(damping, ["damping", "N*s/m"]);
                format!("spring({}) {{ damping: {damping} }}", self.two_points())
            }
            1 => format!("spring({}) {{ rate: {rate:?}N/m, free: 0, damping: _ }}", self.two_points()),
            2 => {
                let free = self.value(free, ["length", "m"]);
                let fields = format!("rate: _, free: {free}, damping: {}", self.value(damping, ["damping", "N*s/m"]));
                format!("spring({}) {{ {fields} }}", self.two_points())
            }
            _ => {
                let link = 1 + self.random.below(moving);
                let other = self.random.below(link);
                let (from, on) = self.arrow(link, other);
                let (from, on) = (self.bodies[from].name.clone(), self.bodies[on].name.clone());
                let fields = format!(
                    "rate: {}, free: {free:?}rad, damping: {}",
                    self.value(rate, ["torsion_stiffness", "N*m/rad"]),
                    self.value(damping, ["torsion_damping", "N*m*s/rad"])
                );
                format!("torsion({from} -> {on}) {{ {fields} }}")
            }
        };
        let _ = writeln!(self.items, "load D: {line};");
        loads.push([rate, damping]);
        self.items.push_str("scene speeds: velocity;\nscene accelerations: acceleration;\n");
        self.drives.iter().map(|_| [self.random.range(-3.0, 3.0), self.random.range(-5.0, 5.0)]).collect()
    }

    fn finish(self, loads: Vec<[f64; 2]>, motion: Vec<[f64; 2]>, kind: Kind) -> Sample {
        let mut text = format!("pub mod sample;\nscalar {};\n", kind.scalar);
        let values = self.values.clone().unwrap_or_default();
        for (index, (dimension, _)) in values.iter().enumerate() {
            let _ = writeln!(text, "param r{index}: {dimension};");
        }
        let mut params: Vec<f64> = values.into_iter().map(|(_, value)| value).collect();
        let mut length = |value: f64, text: &mut String| {
            if kind.params {
                let _ = writeln!(text, "param k{}: length;", params.len());
                params.push(value);
                format!("k{}", params.len() - 1)
            } else {
                format!("{value:?}m")
            }
        };
        for body in &self.bodies {
            let mut places = Vec::new();
            let e = direction(body.angle);
            for (index, (name, at)) in body.points.iter().enumerate() {
                let r = minus(*at, body.origin);
                let local = [dot(e, r), cross(e, r)];
                match (body.framed, index) {
                    (true, 0) => {}
                    (true, 1) => {
                        let value = length(size(r), &mut text);
                        places.push(format!("{} -> {name}: {value}", body.points[0].0));
                    }
                    _ => {
                        let (x, y) = (length(local[0], &mut text), length(local[1], &mut text));
                        places.push(format!("{name}: ({x}, {y})"));
                    }
                }
            }
            let word = if body.name == "ground" { String::new() } else { "link ".to_owned() };
            let _ = writeln!(text, "{word}{} {{ {} }}", body.name, places.join(", "));
            text.push_str(body.mass.as_deref().unwrap_or(""));
        }
        text.push_str(&self.items);
        for (index, (joint, _)) in self.drives.iter().enumerate() {
            let _ = writeln!(text, "drive q{index}: {joint};");
        }
        text.push_str(
            "scene all: equilibrium;\nscene parts: superposition;\nscene work: virtual_work;\nscene whole: position;\n",
        );
        let moving = self.bodies[1..].iter();
        let distances =
            moving.flat_map(|b| b.points.iter().flat_map(|p| b.points.iter().map(move |q| minus(p.1, q.1))));
        let longest = distances.map(size).fold(0.0, f64::max);
        let drives = self.drives.iter().map(|(_, at)| *at).collect();
        let arguments = Arguments { drives, loads, params, sides: self.sides, motion, ..Arguments::default() };
        Sample { text, arguments, places: self.places, longest }
    }
}
