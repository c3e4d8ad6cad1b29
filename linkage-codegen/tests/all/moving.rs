//! Random linkages in motion: velocities and accelerations against differences of places in 220 bits, forces against the balance of
//! energy.

use crate::support::general::{equations, open_motion, solve_extended, solve_nalgebra};
use crate::support::linkages::{Kind, Sample, sample, sample_with_search};
use crate::support::numbers::{Double, Extended};
use crate::support::{Arguments, Number, compile, index_of, pose, prepared, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{Coordinate, NodeId, NodeValues, Symbol};
use linkage_codegen::model::ids::LinkId;
use linkage_codegen::model::{End, LoadKind, Pair};
use linkage_codegen::program::{Input, Run};

/// A step in time: its square is far below what is compared, and rounding over its square is too.
const STEP: f64 = 1e-18;

fn exactly(value: f64) -> Extended {
    Extended::exactly(value)
}

fn kind(seed: u64) -> Kind {
    let dyads = 1 + usize::try_from(seed % 4).expect("small");
    Kind {
        dyads,
        sliders: true,
        joints: seed % 2 == 1,
        unknown_anywhere: false,
        moving: true,
        params: seed % 5 == 4,
        scalar: "f64",
    }
}

/// A moment near to that of the arguments: coordinates and rates of the drives are continued by their accelerations.
struct Moment<'a> {
    linkage: &'a Linkage,
    arguments: &'a Arguments,
    time: Extended,
}

impl Moment<'_> {
    fn known(&self, symbol: Symbol) -> Extended {
        let motion = |drive: usize| self.arguments.motion[drive].map(exactly);
        match symbol {
            Symbol::Drive(drive) => {
                let [rate, acceleration] = motion(drive.index());
                let half = acceleration.mul(&self.time).mul(&exactly(0.5));
                exactly(self.arguments.drives[drive.index()]).add(&self.time.mul(&rate.add(&half)))
            }
            _ => exactly(self.arguments.of(symbol)),
        }
    }

    /// The value of an expression of the plan.
    fn value(&self, node: NodeId, done: &mut NodeValues<Extended>) -> Extended {
        self.linkage.model.graph.evaluate(node, &|symbol| self.known(symbol), done)
    }

    /// What a pose keeps.
    fn kept(&self) -> NodeValues<Extended> {
        let prepared = prepared::<Extended>(self.linkage, self.arguments).expect("parameters");
        let run = Run { program: &self.linkage.functions.pose, graph: &self.linkage.model.graph };
        let values = run.with(&|input| match input {
            Input::Symbol(symbol) => self.known(symbol),
            Input::Prepared(node) => prepared[&node].clone(),
            Input::Kept(_) | Input::Known(_) => Extended::zero(),
        });
        self.linkage.plan.pose.iter().map(|kept| kept.node).zip(values.expect("a pose")).collect()
    }
}

/// The linkage at three moments: before, at, and behind that of the arguments.
struct Passing<'a> {
    linkage: &'a Linkage,
    moments: [(Moment<'a>, NodeValues<Extended>); 3],
}

impl<'a> Passing<'a> {
    fn of(linkage: &'a Linkage, arguments: &'a Arguments) -> Self {
        let moments = [-STEP, 0.0, STEP].map(|time| {
            let moment = Moment { linkage, arguments, time: exactly(time) };
            let kept = moment.kept();
            (moment, kept)
        });
        Self { linkage, moments }
    }

    /// The value at the three moments.
    fn values(&self, of: &dyn Fn(&Moment<'_>, &mut NodeValues<Extended>) -> Extended) -> [Extended; 3] {
        self.moments.each_ref().map(|(moment, kept)| of(moment, &mut kept.clone()))
    }

    fn rate(&self, of: &dyn Fn(&Moment<'_>, &mut NodeValues<Extended>) -> Extended) -> Extended {
        let [before, _, behind] = self.values(of);
        behind.sub(&before).div(&exactly(STEP).add(&exactly(STEP)))
    }

    fn acceleration(&self, of: &dyn Fn(&Moment<'_>, &mut NodeValues<Extended>) -> Extended) -> Extended {
        let [before, at, behind] = self.values(of);
        behind.add(&before).sub(&at).sub(&at).div(&exactly(STEP).mul(&exactly(STEP)))
    }

    fn coordinate(&self, link: LinkId, which: Coordinate) -> NodeId {
        self.linkage.plan.links[link.index()].coordinate(which)
    }

    /// A place in a link's frame, at a moment.
    fn place(&self, link: LinkId, at: Pair, moment: &Moment<'_>, done: &mut NodeValues<Extended>) -> [Extended; 2] {
        use Coordinate::{Cos, Sin, X, Y};
        let [x, y, c, s] = [X, Y, Cos, Sin].map(|which| moment.value(self.coordinate(link, which), done));
        let [a, b] = [at.x, at.y].map(|node| moment.value(node, done));
        [x.add(&c.mul(&a)).sub(&s.mul(&b)), y.add(&s.mul(&a)).add(&c.mul(&b))]
    }

    fn point(&self, end: End) -> Pair {
        self.linkage.model.local(end).into()
    }

    /// Rate of a part of a place's coordinates.
    fn velocity(&self, link: LinkId, at: Pair) -> [Extended; 2] {
        [0, 1].map(|part| self.rate(&|moment, done| self.place(link, at, moment, done)[part].clone()))
    }

    fn distance(&self, ends: [End; 2], moment: &Moment<'_>, done: &mut NodeValues<Extended>) -> Extended {
        let [a, b] = ends.map(|end| self.place(end.link, self.point(end), moment, done));
        let [x, y] = [b[0].sub(&a[0]), b[1].sub(&a[1])];
        x.mul(&x).add(&y.mul(&y)).sqrt()
    }

    fn turning(&self, link: LinkId) -> Extended {
        self.rate(&|moment, done| moment.value(self.coordinate(link, Coordinate::Angle), done))
    }

    /// The power of a load, from differences of places; none of inertia.
    fn power(&self, kind: LoadKind) -> Extended {
        let now = |node: NodeId| self.moments[1].0.value(node, &mut self.moments[1].1.clone());
        let dot = |[x, y]: [Extended; 2], [a, b]: [Extended; 2]| x.mul(&a).add(&y.mul(&b));
        match kind {
            LoadKind::Force { at, force, frame } => {
                let [c, s] = [Coordinate::Cos, Coordinate::Sin].map(|which| now(self.coordinate(frame, which)));
                let [a, b] = [force.x, force.y].map(now);
                let force = [c.mul(&a).sub(&s.mul(&b)), s.mul(&a).add(&c.mul(&b))];
                dot(force, self.velocity(at.link, self.point(at)))
            }
            LoadKind::Moment { on, from, moment } => {
                let rate = self.turning(on).sub(&from.map_or_else(Extended::zero, |from| self.turning(from)));
                now(moment).mul(&rate)
            }
            LoadKind::Gravity { acceleration } => {
                let model = &self.linkage.model;
                let massive = model.moving_links().filter_map(|link| Some((link, model.link(link).mass?)));
                massive.fold(Extended::zero(), |sum, (link, mass)| {
                    let weight = [acceleration.x, acceleration.y].map(|part| now(mass.mass).mul(&now(part)));
                    sum.add(&dot(weight, self.velocity(link, mass.centroid)))
                })
            }
            LoadKind::Thrust { ends, force } => {
                now(force).mul(&self.rate(&|moment, done| self.distance(ends, moment, done)))
            }
            LoadKind::Spring { ends, rate, free, preload, damping } => {
                let length = self.distance(ends, &self.moments[1].0, &mut self.moments[1].1.clone());
                let stretching = self.rate(&|moment, done| self.distance(ends, moment, done));
                let damped = damping.map_or_else(Extended::zero, |damping| now(damping).mul(&stretching));
                let tension = now(rate).mul(&length.sub(&now(free))).add(&now(preload)).add(&damped);
                tension.mul(&stretching).neg()
            }
            LoadKind::Torsion { from, on, rate, free, damping, .. } => {
                let [a, b] = [from, on].map(|link| now(self.coordinate(link, Coordinate::Angle)));
                let turning = self.turning(on).sub(&self.turning(from));
                let mut wound = b.sub(&a).sub(&now(free));
                let model = &self.linkage.model;
                let geared = self.linkage.topology.geared(model);
                let counted = geared.contains(&from) || geared.contains(&on);
                if model.driven_angle(from, on).is_none() && !counted {
                    // The angle nearest to the free one. That of a wheel counts all its turns.
                    let (sine, cosine) = wound.sin_cos();
                    wound = sine.atan2(&cosine);
                }
                let damped = damping.map_or_else(Extended::zero, |damping| now(damping).mul(&turning));
                now(rate).mul(&wound).add(&damped).mul(&turning).neg()
            }
            LoadKind::Inertia => Extended::zero(),
        }
    }

    /// Rate of the kinetic energy.
    fn kinetic_power(&self) -> Extended {
        let model = &self.linkage.model;
        let massive = model.moving_links().filter_map(|link| Some((link, model.link(link).mass?)));
        massive.fold(Extended::zero(), |sum, (link, mass)| {
            let now = |node: NodeId| self.moments[1].0.value(node, &mut self.moments[1].1.clone());
            let parts = [0, 1].map(|part| {
                let place = |moment: &Moment<'_>, done: &mut NodeValues<Extended>| {
                    self.place(link, mass.centroid, moment, done)[part].clone()
                };
                now(mass.mass).mul(&self.rate(&place)).mul(&self.acceleration(&place))
            });
            let angle = |moment: &Moment<'_>, done: &mut NodeValues<Extended>| {
                moment.value(self.coordinate(link, Coordinate::Angle), done)
            };
            let turning = now(mass.inertia).mul(&self.rate(&angle)).mul(&self.acceleration(&angle));
            parts.iter().fold(sum.add(&turning), |sum, part| sum.add(part))
        })
    }
}

fn near(found: &Extended, expected: &Extended, tolerance: f64, what: &str, text: &str) {
    let (off, size) = (found.sub(expected).to_f64().abs(), expected.to_f64().abs().max(1.0));
    assert!(off <= tolerance * size, "{what} is off by {off:e} of {size:e}\n{text}");
}

/// Velocities and accelerations of every joint, point and link are those of the places.
fn check_differences(sample: &Sample, linkage: &Linkage, passing: &Passing<'_>) {
    let whole = index_of(linkage, "whole");
    let places = linkage.plan.scenes[whole].leaves();
    let speeds = scene::<Extended>(linkage, "speeds", &sample.arguments).expect("velocities");
    let accelerations = scene::<Extended>(linkage, "accelerations", &sample.arguments).expect("accelerations");
    for (path, node) in places {
        let place = |moment: &Moment<'_>, done: &mut NodeValues<Extended>| moment.value(node, done);
        near(&speeds[&path], &passing.rate(&place), 1e-25, &format!("velocity of {path}"), &sample.text);
        let found = &accelerations[&path];
        near(found, &passing.acceleration(&place), 1e-20, &format!("acceleration of {path}"), &sample.text);
    }
}

/// What the drives and the loads bring is what the kinetic energy grows by, with forces in 220 bits and in doubles.
///
/// The scale: the powers of every load, of every drive and of inertia, each by its magnitude, added up; of the efforts in doubles also the
/// power of every load's part of them, which cancel in the sum and take part in its rounding with all their size.
fn check_energy(text: &str, linkage: &Linkage, arguments: &Arguments, passing: &Passing<'_>) {
    let powers: Vec<Extended> = linkage.model.loads.iter().map(|load| passing.power(load.kind)).collect();
    let kinetic = passing.kinetic_power();
    let drives = || linkage.model.unknowns.iter().zip(&arguments.motion).map(|(unknown, [rate, _])| (unknown, *rate));
    let efforts = |of: &dyn Fn(&str) -> Extended| {
        drives().map(|(unknown, rate)| of(&unknown.name).mul(&exactly(rate))).collect::<Vec<_>>()
    };
    let exact = scene::<Extended>(linkage, "all", arguments).expect("forces");
    let doubles = scene::<Double>(linkage, "all", arguments).expect("forces");
    let parts = scene::<Double>(linkage, "parts", arguments).expect("parts");
    let work = scene::<Extended>(linkage, "work", arguments).expect("work");
    let exactly_driven = efforts(&|name| exact[name].clone());
    let size = |terms: &[Extended]| terms.iter().fold(0.0, |sum, term| sum + term.to_f64().abs());
    let scale = size(&powers) + size(&exactly_driven) + kinetic.to_f64().abs();
    let in_parts = drives().flat_map(|(unknown, rate)| {
        let own = parts.iter().filter(move |(path, _)| path.rsplit('.').next() == Some(unknown.name.as_str()));
        own.map(move |(_, part)| (part.0 * rate).abs())
    });
    let in_parts: f64 = in_parts.sum();
    for (driven, tolerance) in [
        (exactly_driven, 1e-18 * scale),
        (efforts(&|name| work[name].clone()), 1e-18 * scale),
        (efforts(&|name| exactly(doubles[name].0)), 1e-12 * (scale + in_parts)),
    ] {
        let all = driven.iter().chain(&powers);
        let open = all.fold(kinetic.clone(), |rest, power| rest.sub(power)).to_f64().abs();
        assert!(open <= tolerance, "energy: {open:e} of {scale:e} and {in_parts:e}\n{text}");
    }
}

/// The condition of the unreduced equations: large where the linkage is near a dead centre.
fn condition(linkage: &Linkage, arguments: &Arguments) -> Option<f64> {
    let general = equations::<Double>(linkage, arguments).ok()?;
    let matrix: Vec<Vec<f64>> = general.matrix.iter().map(|line| line.iter().map(|x| x.0).collect()).collect();
    let right: Vec<f64> = general.right_side(&|_| true).iter().map(|x| x.0).collect();
    Some(solve_nalgebra(&matrix, &right)?.1)
}

/// A linkage stops before its dead centres, where accelerations and forces grow beyond all bounds and their rounding with them: where the
/// sine of a transmission angle falls below this, or the condition is so much worse than at the pose that was drawn.
const SINE: f64 = 0.1;
const WORSE: f64 = 30.0;

/// Whether a linkage is at a pose that is no dead centre, nor near to one.
fn is_clear(linkage: &Linkage, arguments: &Arguments, drawn: f64) -> bool {
    let Ok(kept) = pose::<Double>(linkage, arguments) else { return false };
    let sines = linkage.plan.pose.iter().filter(|number| number.name.starts_with("sin_mu_"));
    sines.into_iter().all(|sine| kept[&sine.node].0.abs() >= SINE)
        && condition(linkage, arguments).is_some_and(|found| found <= WORSE * drawn)
}

/// The balance of energy while the first drive goes through a whole turn, or as far as the linkage lets it: from the pose that was drawn
/// to both sides. How many poses that are, and whether it is a whole turn.
fn check_cycle(seed: u64) -> (usize, bool) {
    const STEPS: u32 = 24;
    let sample = drawn(seed);
    let linkage = compile(&sample.text);
    let turns = linkage.model.drives[0].turns;
    let step = if turns { core::f64::consts::TAU / f64::from(STEPS) } else { 0.1 };
    let drawn = condition(&linkage, &sample.arguments).expect("a pose");
    let mut reached = 0;
    for direction in [1.0, -1.0] {
        for index in 1..=STEPS / 2 {
            let mut arguments = sample.arguments.clone();
            arguments.drives[0] += direction * step * f64::from(index);
            if !is_clear(&linkage, &arguments, drawn) {
                break;
            }
            let text = format!("drives {:?}\n{}", arguments.drives, sample.text);
            check_energy(&text, &linkage, &arguments, &Passing::of(&linkage, &arguments));
            reached += 1;
        }
    }
    (reached, turns && reached == usize::try_from(STEPS).expect("small"))
}

/// At least so many poses, and so many linkages that turn round.
fn check_cycles(seeds: core::ops::Range<u64>, poses: usize, round: usize) {
    let found: Vec<(usize, bool)> = seeds.map(check_cycle).collect();
    println!("{found:?}");
    let reached: usize = found.iter().map(|(reached, _)| reached).sum();
    let turned = found.iter().filter(|(_, turned)| *turned).count();
    assert!(reached >= poses && turned >= round, "{reached} poses, {turned} whole turns");
}

/// The unreduced equations with the accelerations as they are give the same forces.
fn check_equations(sample: &Sample, linkage: &Linkage) {
    for (source, [rate, acceleration]) in open_motion::<Extended>(linkage, &sample.arguments).expect("a pose") {
        assert!(rate.to_f64().abs() < 1e-40, "velocity at {source:?}\n{}", sample.text);
        assert!(acceleration.to_f64().abs() < 1e-40, "acceleration at {source:?}\n{}", sample.text);
    }
    let general = equations::<Extended>(linkage, &sample.arguments).expect("a pose");
    let solution = solve_extended(&general.matrix, &general.right_side(&|_| true)).expect("regular");
    let all = scene::<Extended>(linkage, "all", &sample.arguments).expect("forces");
    let named = general.named(linkage, solution);
    let size = named.values().fold(0.0f64, |most, value| most.max(value.to_f64().abs()));
    for (name, value) in named {
        let off = all[&name].sub(&value).to_f64().abs();
        assert!(off <= 1e-40 * size, "{name} is off by {off:e} of {size:e}\n{}", sample.text);
    }
}

/// Among them such as are placed by iteration.
fn drawn(seed: u64) -> Sample {
    if seed % 6 == 5 { sample_with_search(seed, kind(seed)) } else { sample(seed, kind(seed)) }
}

fn check(seed: u64) {
    let sample = drawn(seed);
    let linkage = compile(&sample.text);
    let passing = Passing::of(&linkage, &sample.arguments);
    check_equations(&sample, &linkage);
    check_differences(&sample, &linkage, &passing);
    check_energy(&sample.text, &linkage, &sample.arguments, &passing);
}

#[test]
fn random_linkages_move_as_their_places_do_and_keep_the_balance_of_energy() {
    (3000..3030).for_each(check);
}

#[test]
#[ignore = "long"]
fn a_thousand_linkages_keep_the_balance_of_energy() {
    (30_000..31_000).for_each(check);
}

#[test]
fn random_linkages_keep_the_balance_of_energy_on_their_way() {
    check_cycles(3100..3115, 200, 3);
}

#[test]
#[ignore = "long"]
fn two_hundred_linkages_keep_the_balance_of_energy_on_their_way() {
    check_cycles(31_000..31_200, 1000, 15);
}
