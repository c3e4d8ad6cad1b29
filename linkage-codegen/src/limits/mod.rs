//! [`Model`] and [`Topology`] in, [`Limits`] out: what a designer asks first of every four-bar and slider-crank in a linkage.
//!
//! A loop is a closed chain of four bodies in which one joint is known before the others: its driver, a driven joint or one that an earlier
//! group places. How far the driver can go, where its output is at a dead centre, and how well it transmits follows from the lengths
//! alone. Each quantity is an expression of them, so that constant lengths give it exactly and parameters give a function.

mod cycles;
mod driven_slide;
mod four_bar;
mod known;
mod slider_crank;

use std::collections::BTreeSet;

use crate::graph::{Expr, Failure, Graph, NodeId, Stage};
use crate::model::ids::JointId;
use crate::model::{Closure, Model, Side};
use crate::program::{Extract, Form, Program, passes};
use crate::topology::Topology;
use cycles::{Chain, Kind};
pub use known::{Grashof, Known, KnownPosition, KnownRange, KnownStroke, KnownTransmission};

/// The heading of a loop's steps, before its name.
const SECTION: &str = "Limits at";

/// The loops of a linkage.
#[derive(Debug)]
pub struct Limits {
    /// In the order in which motion goes through them.
    pub loops: Vec<Loop>,
    /// What the loops whose lengths are parameters need of them; none if there is no such loop.
    pub prepare: Option<Program>,
}

/// A four-bar or a slider-crank.
#[derive(Debug)]
pub struct Loop {
    /// Its name: that of the joint at which it is assembled.
    pub name: String,
    /// What it is, in a few words.
    pub title: String,
    /// Its lengths, and how its angles are counted: a line each, with the nodes that they hold.
    pub dimensions: Vec<(String, NodeId)>,
    /// The driving joint.
    pub driver: JointId,
    /// What its coordinate is called.
    pub coordinate: String,
    /// Of which links it is, unless it is a drive.
    pub between: Option<String>,
    /// How its own angle or travel is made of that coordinate: `ψ = theta + phase`.
    pub origin: Origin,
    /// What is known of it.
    pub shape: Shape,
    /// If its lengths are constants.
    pub known: Option<Known>,
}

/// The angle or the travel of a driver as its loop sees it: `own = ±coordinate + phase`.
#[derive(Clone, Debug)]
pub struct Origin {
    /// What it is.
    pub meaning: String,
    /// Whether it grows with the coordinate.
    pub forwards: bool,
    /// Its value where the coordinate is zero.
    pub phase: NodeId,
}

/// What is known of a loop.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Four pins.
    FourBar(FourBar),
    /// A slide and three pins, one of which is the driver.
    SliderCrank(SliderCrank),
    /// A slide, which is the driver, and three pins.
    DrivenSlide(DrivenSlide),
}

/// A four-bar.
#[derive(Clone, Debug)]
pub struct FourBar {
    /// The lengths: of frame, crank, coupler and output.
    pub lengths: [NodeId; 4],
    /// `g − a + h − b`, `g − a − h + b`, `h + b − g − a`: their signs are its class.
    pub balances: [NodeId; 3],
    /// How far the driver can go.
    pub range: Turning,
    /// Crank and coupler in line: stretched, folded.
    pub dead_centres: [Possible; 2],
    /// How far the output swings.
    pub swing: Stroke,
    /// The least and the greatest transmission angle.
    pub transmission: [Extreme; 2],
}

/// Where the slide of a slider-crank is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inversion {
    /// On the frame.
    OnFrame,
    /// On the crank.
    OnCrank,
    /// Opposite to the driver.
    Opposite,
}

/// A slider-crank or an inversion of it.
#[derive(Clone, Debug)]
pub struct SliderCrank {
    /// Where its slide is.
    pub inversion: Inversion,
    /// How far the driver can go.
    pub range: Turning,
    /// Where the output as driver is at a dead centre.
    pub dead_centres: Vec<Possible>,
    /// How far the output goes.
    pub stroke: Option<Stroke>,
    /// The least and the greatest angle between the rod and the normal of the slide.
    pub transmission: Option<[Extreme; 2]>,
}

/// A loop that its slide drives.
#[derive(Clone, Debug)]
pub struct DrivenSlide {
    /// The travel at which the pins of the loop's slide are nearest to each other.
    pub centre: NodeId,
    /// Further on both sides than the second value, if the first is positive.
    pub near: [NodeId; 2],
    /// At most this far.
    pub far: NodeId,
    /// The joint at its limit.
    pub joint: String,
}

/// How far a driving pin can go: within `far` on both sides of a centre, but no nearer to it than `near`.
#[derive(Clone, Debug)]
pub struct Turning {
    /// The coordinate in the middle.
    pub centre: NodeId,
    /// What is negative if there is such a limit, and the limit; `None` if there never is.
    pub near: Option<[NodeId; 2]>,
    /// The same.
    pub far: Option<[NodeId; 2]>,
    /// The joint at its limit.
    pub joint: String,
    /// How it stands there, near and far.
    pub postures: [Posture; 2],
}

/// How two links stand where a joint is at its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Posture {
    /// In line, one behind the other.
    Stretched,
    /// In line, one upon the other.
    Folded,
    /// At a right angle to the slide.
    Square,
}

impl Posture {
    /// Its variant in the run-time crate.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stretched => "Stretched",
            Self::Folded => "Folded",
            Self::Square => "Square",
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Stretched => "stretched",
            Self::Folded => "folded",
            Self::Square => "square to the slide",
        }
    }
}

/// A position that there may be.
#[derive(Clone, Debug)]
pub struct Possible {
    /// It is there if none of these is negative.
    pub margins: Vec<NodeId>,
    /// The coordinate.
    pub at: NodeId,
    /// The joint at its limit.
    pub joint: String,
    /// How it stands.
    pub posture: Posture,
}

/// How far an output goes while the driver goes round.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// It does so if all of these are positive.
    pub margins: Vec<NodeId>,
    /// From end to end.
    pub extent: NodeId,
    /// By how much less or more than half a turn takes it there.
    pub advance: NodeId,
}

/// The least or greatest value of an angle.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    /// The angle.
    pub angle: NodeId,
    /// The coordinate of the driver.
    pub at: NodeId,
}

impl Limits {
    /// Of all loops of a linkage.
    #[must_use]
    pub fn of(model: &Model, topology: &Topology) -> Self {
        let mut names = BTreeSet::new();
        let mut loops = Vec::new();
        for (_, chain) in driven(model, topology) {
            for closing in Closing::all(&chain) {
                loops.extend(found(&chain, &closing).filter(|_| names.insert(closing.name.clone())));
            }
        }
        let prepare = prepare(&model.graph, &loops);
        Self { loops, prepare }
    }
}

/// The program of all that parameters determine.
fn prepare(graph: &Graph, loops: &[Loop]) -> Option<Program> {
    let nodes = loops.iter().filter(|found| found.known.is_none()).flat_map(|found| found.shape.nodes());
    let nodes: Vec<NodeId> = nodes.collect();
    let results: Vec<(String, NodeId)> = nodes.iter().map(|node| (String::new(), *node)).collect();
    let program = || {
        let mut program = passes::optimised(Extract { graph, form: Form::Prepare }.program(&results, &nodes), graph);
        // Lengths that poses need too were made for these.
        let shared = program.values.iter_mut().filter(|value| !value.section.starts_with(SECTION));
        shared.for_each(|value| value.section.clear());
        program
    };
    (!results.is_empty()).then(program)
}

/// The chains with one hinge that is known before the others, started there and with its crank behind it; in the order of motion.
fn driven<'m>(model: &'m Model, topology: &Topology) -> Vec<(usize, Chain<'m>)> {
    let rank = |body: &cycles::Body| match body {
        cycles::Body::Links(_) if cycles::is_ground(body) => Some(0),
        cycles::Body::Links(links) => {
            let placed = |group: &crate::topology::Group| group.links.iter().any(|link| links.contains(link));
            topology.motion.iter().position(placed).map(|group| group + 1)
        }
        cycles::Body::Block => None,
    };
    let mut all = Vec::new();
    for chain in cycles::chains(model) {
        let ranks = chain.bodies.each_ref().map(rank);
        // A block follows the later one of the links that it joins.
        let block = |body: usize| ranks[(body + 3) % 4].max(ranks[(body + 1) % 4]);
        let ranks = [0, 1, 2, 3].map(|body| ranks[body].or_else(|| block(body)));
        let last = ranks.iter().flatten().copied().max().unwrap_or(0);
        // A joint on the links that are placed last is closed with them, unless it is driven.
        let known = |hinge: &usize| {
            let (before, behind) = (ranks[(hinge + 3) % 4], ranks[*hinge]);
            chain.hinges[*hinge].drive.is_some() || [before, behind].into_iter().flatten().all(|rank| rank < last)
        };
        let [driver] = (0..4).filter(known).collect::<Vec<_>>()[..] else { continue };
        let (frame, crank) = (ranks[(driver + 3) % 4], ranks[driver]);
        let chain = chain.from(driver);
        let backwards = frame > crank || frame == crank && !chain.hinges[0].forwards;
        all.push((last, if backwards { chain.reversed() } else { chain }));
    }
    all.sort_by_key(|(last, _)| *last);
    all
}

/// How a loop is assembled.
struct Closing<'m> {
    /// The joint at which a side is chosen, and where it is an argument, the side.
    name: String,
    closure: &'m Closure,
    side: Side,
}

impl<'m> Closing<'m> {
    /// On the side that is chosen, or on both, where it is an argument; none if nothing is said of the loop.
    fn all(chain: &Chain<'m>) -> Vec<Self> {
        let holds = |joint: &JointId| chain.hinges[1..].iter().any(|hinge| hinge.is(*joint));
        let closed = |closure: &&Closure| holds(&closure.joint) && closure.of.iter().all(holds);
        let Some(closure) = chain.model.closures.iter().find(closed) else { return Vec::new() };
        let joint = &chain.model.joint(closure.joint).name.text;
        let on = |side: Side| Self { name: format!("{joint}_{}", side.word()), closure, side };
        match (closure.is_given_at_run_time(), closure.of.len()) {
            (false, _) => vec![Self { name: joint.clone(), closure, side: closure.side }],
            (true, 2) => [Side::Left, Side::Right].map(on).into(),
            (true, _) => [Side::Ahead, Side::Behind].map(on).into(),
        }
    }

    /// Which way round the hinges behind the driver, the one before it and the one between these follow each other: 1 for
    /// counter-clockwise. `None` if the closure is of other joints.
    fn sense(&self, chain: &Chain<'_>) -> Option<i64> {
        let hinge = |joint: JointId| [1, 3, 2].iter().position(|hinge| chain.hinges[*hinge].is(joint));
        let &[from, to] = self.closure.of.as_slice() else { return None };
        let order = [hinge(from)?, hinge(to)?, hinge(self.closure.joint)?];
        let even = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].contains(&order);
        let left = self.side == Side::Left;
        Some(if even == left { 1 } else { -1 })
    }

    /// Along the slide, whether a hinge lies ahead of another one (1) or behind it (−1). `None` if the closure is of other joints.
    fn ahead(&self, chain: &Chain<'_>, [from, to]: [usize; 2]) -> Option<i64> {
        let &[of] = self.closure.of.as_slice() else { return None };
        let pin = |joint: JointId| {
            (1..4).find(|hinge| chain.hinges[*hinge].kind == Kind::Pin && chain.hinges[*hinge].is(joint))
        };
        let behind = pin(of)?;
        // At a slide the other one of its two pins is meant.
        let other = || {
            let slide = (1..4).find(|hinge| chain.hinges[*hinge].is(self.closure.joint))?;
            [slide - 1, slide + 1].into_iter().find(|hinge| *hinge != behind)
        };
        let front = pin(self.closure.joint).or_else(other)?;
        let sign = if self.side == Side::Ahead { 1 } else { -1 };
        match [behind, front] {
            pins if pins == [from, to] => Some(sign),
            pins if pins == [to, from] => Some(-sign),
            _ => None,
        }
    }
}

fn found(chain: &Chain<'_>, closing: &Closing<'_>) -> Option<Loop> {
    if (0..4).any(|body| is_point(chain, body)) {
        return None;
    }
    let slide = chain.hinges.iter().position(|hinge| hinge.kind == Kind::Slide);
    let found = match slide {
        None => four_bar::of(chain, closing.sense(chain)?, closing),
        Some(0) => driven_slide::of(chain, closing),
        Some(2) => slider_crank::inverted(chain, closing.ahead(chain, [1, 3])?, closing),
        Some(3) => slider_crank::of(chain, closing.ahead(chain, [1, 2])?, Inversion::OnFrame, closing),
        // With the crank as its frame, the slide is where it is on a slider-crank.
        Some(_) => slider_crank::of(&chain.reversed(), closing.ahead(chain, [3, 2])?, Inversion::OnCrank, closing),
    };
    let mut found = found?;
    let graph = &chain.model.graph;
    let constant = found.shape.nodes().iter().all(|node| graph.stage(*node) == Stage::Constant);
    if constant {
        found.known = Some(known::known(graph, &found)?);
    }
    Some(found)
}

/// A body whose pins coincide turns about them without moving anything.
fn is_point(chain: &Chain<'_>, body: usize) -> bool {
    let pins = [body, (body + 1) % 4].iter().all(|hinge| chain.hinges[*hinge].kind == Kind::Pin);
    pins && chain.length(body).is_zero()
}

/// What the formulas of a loop are written with.
struct Writing<'m> {
    chain: Chain<'m>,
    graph: &'m Graph,
    name: String,
    /// The joint at which it is assembled.
    joint: JointId,
    /// Its dimensions, each as its symbol and what that is.
    dimensions: Vec<String>,
}

impl<'m> Writing<'m> {
    /// From here on its formulas are written, with the symbols of these dimensions.
    fn new(chain: &Chain<'m>, closing: &Closing<'_>, dimensions: &[(&str, String)]) -> Self {
        let (graph, name, joint) = (&chain.model.graph, closing.name.clone(), closing.closure.joint);
        let dimensions: Vec<String> = dimensions.iter().map(|(symbol, name)| format!("{symbol} = {name}")).collect();
        graph.begin_section(format!("{SECTION} {name}: {}", dimensions.join(", ")));
        Self { chain: chain.clone(), graph, name, joint, dimensions }
    }

    /// The length of a body, under a name; of one that depends on parameters it is checked when they are given.
    fn length(&self, body: usize, symbol: &str) -> Expr<'m> {
        let length = self.chain.length(body);
        let requirement = format!(
            "{}: its joints {} and {} must be apart",
            self.chain.body_name(body),
            self.chain.hinge_name(body),
            { self.chain.hinge_name((body + 1) % 4) }
        );
        let [from, to] = [body, (body + 1) % 4].map(|hinge| self.chain.hinge_name(hinge));
        self.named(length.required_positive(requirement), symbol, &format!("|{from} {to}|"))
    }

    /// The value, named after the loop.
    fn named(&self, value: Expr<'m>, name: &str, equation: &str) -> Expr<'m> {
        value.named(format!("{name}_{}", self.name), equation)
    }

    /// `2 atan2(√y², √x²)`, both squares taken for zero where they are negative.
    fn twice(&self, y2: Expr<'m>, x2: Expr<'m>, name: &str, equation: &str) -> Expr<'m> {
        let half = self.graph.atan2(y2.non_negative().sqrt(), x2.non_negative().sqrt());
        let half = self.named(half, &format!("half_{name}"), equation);
        self.named(2 * half, name, "")
    }

    /// What must not be negative for the loop to close at any coordinate. `None` if it is.
    fn assembled(&self, margins: &[Expr<'m>]) -> Option<Vec<Expr<'m>>> {
        let failure = |gap: Expr<'m>| Failure::CannotAssemble {
            group: [1, 2].map(|body| self.chain.body_name(body)).join(" + "),
            joint: self.chain.model.joint(self.joint).name.text.clone(),
            gap: gap.id(),
        };
        let each = margins.iter().map(|margin| {
            // A check that always fails says that the linkage has no pose.
            let checked = margin.require_at_least(*margin, self.graph.zero(), failure(-*margin));
            (margin.sign() != Some(-1)).then_some(checked)
        });
        each.collect()
    }

    fn pi(&self) -> Expr<'m> {
        self.graph.constant(&crate::graph::number::Number::pi(1, 1))
    }

    /// The driver's own angle from its coordinate: that of an arm on the crank from a direction on the frame.
    fn phase(&self, frame: crate::graph::Vector<'m>, arm: crate::graph::Vector<'m>) -> Expr<'m> {
        let driver = &self.chain.hinges[0];
        let (frame, arm) = (driver.in_link(0, frame), driver.in_link(1, arm));
        let (sine, cosine) = (frame.cross(arm), frame.dot(arm));
        // Lines that lie upon each other make no angle, whatever their lengths.
        if sine.is_zero() && self.graph.is_positive(cosine) {
            self.graph.zero()
        } else {
            self.graph.atan2(sine, cosine)
        }
    }

    /// The coordinate at an angle of the loop.
    fn coordinate(&self, angle: Expr<'m>, phase: Expr<'m>, name: &str) -> Expr<'m> {
        let coordinate = if self.chain.hinges[0].forwards { angle - phase } else { phase - angle };
        self.named(coordinate, &format!("at_{name}"), "")
    }

    /// What the coordinate of the driver is called.
    fn coordinate_name(&self) -> String {
        let (model, driver) = (self.chain.model, &self.chain.hinges[0]);
        match driver.drive {
            Some(drive) => model.drive(drive).name.text.clone(),
            None if driver.kind == Kind::Pin => format!("the angle at {}", self.chain.hinge_name(0)),
            None => format!("the travel at {}", self.chain.hinge_name(0)),
        }
    }

    /// Between which links a coordinate is that is no drive.
    fn between(&self) -> Option<String> {
        let (model, driver) = (self.chain.model, &self.chain.hinges[0]);
        let joint = model.joint(driver.joint);
        let undriven = driver.drive.is_none();
        undriven.then(|| format!("of {} from {}", model.link(joint.to.link).name, model.link(joint.from.link).name))
    }

    fn origin(&self, meaning: String, phase: Expr<'m>) -> Origin {
        Origin { meaning, forwards: self.chain.hinges[0].forwards, phase: phase.id() }
    }

    fn of(&self, title: String, dimensions: &[Expr<'m>], origin: Origin, shape: Shape) -> Loop {
        let dimensions = self.dimensions.iter().zip(dimensions);
        Loop {
            name: self.name.clone(),
            title,
            dimensions: dimensions.map(|(text, value)| (text.clone(), value.id())).collect(),
            driver: self.chain.hinges[0].joint,
            coordinate: self.coordinate_name(),
            between: self.between(),
            origin,
            shape,
            known: None,
        }
    }
}

impl Turning {
    fn nodes(&self) -> Vec<NodeId> {
        let limits = [self.near, self.far].into_iter().flatten().flatten();
        core::iter::once(self.centre).chain(limits).collect()
    }
}

impl Possible {
    fn nodes(&self) -> Vec<NodeId> {
        self.margins.iter().copied().chain([self.at]).collect()
    }
}

impl Stroke {
    fn nodes(&self) -> Vec<NodeId> {
        self.margins.iter().copied().chain([self.extent, self.advance]).collect()
    }
}

impl Shape {
    /// All its quantities.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        let extremes = |both: &[Extreme]| both.iter().flat_map(|one| [one.angle, one.at]).collect::<Vec<_>>();
        match self {
            Self::FourBar(FourBar { balances, range, dead_centres, swing, transmission, .. }) => {
                let dead = dead_centres.iter().flat_map(Possible::nodes);
                let all = balances.iter().copied().chain(range.nodes()).chain(dead).chain(swing.nodes());
                all.chain(extremes(transmission)).collect()
            }
            Self::SliderCrank(SliderCrank { range, dead_centres, stroke, transmission, .. }) => {
                let dead = dead_centres.iter().flat_map(Possible::nodes);
                let stroke = stroke.iter().flat_map(Stroke::nodes);
                let transmission = transmission.iter().flat_map(|both| extremes(both));
                range.nodes().into_iter().chain(dead).chain(stroke).chain(transmission).collect()
            }
            Self::DrivenSlide(DrivenSlide { centre, near, far, .. }) => {
                core::iter::once(*centre).chain(*near).chain([*far]).collect()
            }
        }
    }
}

/// What is sure of the loops of a linkage that has errors: their names, and of which kind they are.
#[must_use]
pub fn outlines(model: &Model) -> Vec<(String, &'static str)> {
    let mut all: Vec<(String, &'static str)> = Vec::new();
    for chain in cycles::chains(model) {
        let own = Closing::all(&chain);
        let closings = if own.is_empty() { Closing::all(&chain.clone().from(1)) } else { own };
        let slide = chain.hinges.iter().find(|hinge| hinge.kind == Kind::Slide);
        let ty = match slide {
            None => "FourBar",
            Some(slide) if slide.drive.is_some() => "DrivenSlide",
            Some(_) => "SliderCrank",
        };
        for Closing { name, .. } in closings {
            if all.iter().all(|(other, _)| *other != name) {
                all.push((name, ty));
            }
        }
    }
    all
}
