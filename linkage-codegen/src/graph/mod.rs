//! Expressions: one hash-consed graph that carries a linkage from its declared dimensions to its emitted code.
//!
//! In: arithmetic on [`Expr`], written as in a textbook. Out: nodes, each of which stands once, constants folded exactly,
//! products with zero gone, signs pulled outwards. A node's number grows along its dependencies, so the order of numbers
//! is an order of evaluation.

pub(crate) mod bounds;
mod calculus;
pub(crate) mod elimination;
mod expr;
mod fold;
mod linear;
pub mod number;
pub mod real;
pub mod rounding;
mod search;
pub(crate) mod tangent;
mod vector;

use core::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

pub use calculus::NodeValues;
pub use expr::Expr;
use number::Number;
pub use search::{Arguments, Search, SearchId, Sought, sought_direction};
pub use vector::Vector;

use crate::model::ids::{ClosureId, DriveId, LinkId, LoadId, ParamId};

/// The number type of a linkage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
}

impl Scalar {
    /// The distance from 1 to the next larger number.
    #[must_use]
    pub fn epsilon(self) -> Number {
        Number::power_of_two(match self {
            Self::F64 => -52,
            Self::F32 => -23,
        })
    }

    /// Its largest finite number.
    #[must_use]
    pub fn largest(self) -> f64 {
        match self {
            Self::F64 => f64::MAX,
            Self::F32 => f64::from(f32::MAX),
        }
    }

    /// What is less in magnitude is moderate: `all_moderate` lets it pass.
    #[must_use]
    pub fn moderate(self) -> f64 {
        2f64.powi(match self {
            Self::F64 => 257,
            Self::F32 => 33,
        })
    }

    /// Its name in Rust.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
        }
    }
}

/// A node of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

/// An interned constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NumberId(u32);

/// An interned check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GuardId(u32);

/// A heading under which nodes were made; the emitted code and the derivation are grouped by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SectionId(u32);

/// A place coordinate of a link in the symbolic equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Coordinate {
    /// Abscissa of the frame's origin.
    X,
    /// Ordinate of the frame's origin.
    Y,
    /// Angle of the frame's x axis.
    Angle,
    /// Cosine of that angle.
    Cos,
    /// Sine of that angle.
    Sin,
}

/// How often a coordinate is differentiated by time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Order {
    /// Once.
    Rate,
    /// Twice.
    Acceleration,
}

/// What is not known before run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// A declared parameter.
    Parameter(ParamId),
    /// The coordinate of a drive.
    Drive(DriveId),
    /// Its rate or its acceleration, given at run time.
    Driven(DriveId, Order),
    /// The side of a closure that is chosen at run time: 1 or −1.
    Side(ClosureId),
    /// A component of a load that is given at run time.
    Load(LoadId, u8),
    /// A coordinate of a link in the symbolic equations.
    Coordinate(LinkId, Coordinate),
    /// The rate or the acceleration of a link's place or angle likewise.
    Moving(LinkId, Coordinate, Order),
    /// A place in the symbolic equations that stands for any dimension.
    Dimension(u32),
    /// A number of the unknowns of a search, where it stands.
    Sought(SearchId, u8),
    /// The same where it starts: as declared, or at another pose. Behind them, the coordinates of its drives there.
    Start(SearchId, u8),
}

/// When a value becomes known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// At compile time.
    Constant,
    /// When the parameters are given.
    Prepared,
    /// When the drives are given.
    Posed,
    /// When rates and loads are given.
    Loaded,
    /// In each step of a search.
    Iterated,
}

/// A function of the run-time crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kernel {
    /// Sine and cosine.
    SinCos,
    /// Sine and cosine of the argument plus a constant, the sum unrounded.
    SinCosSum(NumberId),
    /// Angle of the direction (second, first argument).
    Atan2,
    /// Product of the first two arguments plus the third, rounded once. Only programs have it.
    MulAdd,
    /// Direction of a vector: its two components over its size, zero for the zero vector.
    Unit,
    /// Solution of two linear equations, with row pivoting: coefficients row by row, then the right sides.
    Solve2,
    /// Solution of three linear equations likewise.
    Solve3,
    /// Solution of any number of linear equations: coefficients row by row, their sizes likewise, then the right sides. Behind the
    /// unknowns, how far from singular they are.
    Solve(u8),
    /// The places of a group by Newton's method, of the [`Arguments`] of its search. How much stays open, then the unknowns.
    Search {
        /// Which one.
        search: SearchId,
        /// How many results it gives.
        parts: u8,
    },
}

impl Kernel {
    /// How many results it gives.
    #[must_use]
    pub fn parts(self) -> u8 {
        match self {
            Self::Atan2 | Self::MulAdd => 1,
            Self::SinCos | Self::SinCosSum(_) | Self::Unit | Self::Solve2 => 2,
            Self::Solve3 => 3,
            Self::Solve(unknowns) => unknowns.saturating_add(1),
            Self::Search { parts, .. } => parts,
        }
    }
}

/// What a node computes from other nodes, or a value from other values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Op<T = NodeId> {
    /// A constant.
    Constant(NumberId),
    /// An unknown of compile time.
    Symbol(Symbol),
    /// Negative.
    Neg(T),
    /// Magnitude.
    Abs(T),
    /// The value, or zero if it is negative.
    NonNegative(T),
    /// The lesser of two; the second one if the first is not a number.
    Lesser(T, T),
    /// Square root.
    Sqrt(T),
    /// Sum.
    Add(T, T),
    /// Difference.
    Sub(T, T),
    /// Product.
    Mul(T, T),
    /// Quotient.
    Div(T, T),
    /// `then` where `value > limit`, zero elsewhere.
    Where {
        /// What is compared.
        value: T,
        /// What it must exceed.
        limit: T,
        /// What is taken.
        then: T,
    },
    /// One of the results of a kernel.
    Kernel {
        /// Which function.
        kernel: Kernel,
        /// Its arguments.
        args: Vec<T>,
        /// Which of its results.
        part: u8,
    },
    /// The value itself, under a name: it is computed as such, and nothing is folded through it.
    Quantity(T),
    /// The value itself, kept by a pose: nothing is folded through it.
    Held(T),
    /// The value, once a check has passed.
    Checked {
        /// What is passed on.
        value: T,
        /// What must hold.
        guard: GuardId,
    },
}

impl<T: Copy> Op<T> {
    /// What it makes of numbers, checks passed over; `of` gives those that it reads. What reads none, or calls a kernel, is known elsewhere:
    /// zero here.
    pub(crate) fn arithmetic<R: real::Real>(&self, of: &mut dyn FnMut(T) -> R) -> R {
        let zero = || R::from_number(&number::Number::zero());
        match *self {
            Self::Constant(_) | Self::Symbol(_) | Self::Kernel { .. } => zero(),
            Self::Neg(a) => of(a).neg(),
            Self::Abs(a) => of(a).abs(),
            Self::NonNegative(a) => {
                let a = of(a);
                if a.above(&zero()) { a } else { zero() }
            }
            Self::Lesser(a, b) => {
                let (a, b) = (of(a), of(b));
                if b.above(&a) { a } else { b }
            }
            Self::Sqrt(a) => of(a).sqrt(),
            Self::Add(a, b) => of(a).add(&of(b)),
            Self::Sub(a, b) => of(a).sub(&of(b)),
            Self::Mul(a, b) => of(a).mul(&of(b)),
            Self::Div(a, b) => of(a).div(&of(b)),
            Self::Where { value, limit, then } => {
                if of(value).above(&of(limit)) {
                    of(then)
                } else {
                    zero()
                }
            }
            Self::Quantity(a) | Self::Held(a) | Self::Checked { value: a, .. } => of(a),
        }
    }

    /// The terms of a sum or a difference, and whether it is a difference.
    #[must_use]
    pub fn terms(&self) -> Option<([T; 2], bool)> {
        match self {
            Self::Add(a, b) => Some(([*a, *b], false)),
            Self::Sub(a, b) => Some(([*a, *b], true)),
            _ => None,
        }
    }

    /// The sum of two terms, or their difference.
    #[must_use]
    pub fn of_terms([a, b]: [T; 2], minus: bool) -> Self {
        if minus { Self::Sub(a, b) } else { Self::Add(a, b) }
    }

    /// What it reads, checks aside.
    #[must_use]
    pub fn operands(&self) -> Vec<T> {
        let mut operands = Vec::new();
        let _ = self.map(|operand| operands.push(operand));
        operands
    }

    /// The same of other operands.
    #[must_use]
    pub fn map<U>(&self, mut with: impl FnMut(T) -> U) -> Op<U> {
        match self {
            Self::Constant(number) => Op::Constant(*number),
            Self::Symbol(symbol) => Op::Symbol(*symbol),
            Self::Neg(a) => Op::Neg(with(*a)),
            Self::Abs(a) => Op::Abs(with(*a)),
            Self::NonNegative(a) => Op::NonNegative(with(*a)),
            Self::Lesser(a, b) => Op::Lesser(with(*a), with(*b)),
            Self::Sqrt(a) => Op::Sqrt(with(*a)),
            Self::Add(a, b) => Op::Add(with(*a), with(*b)),
            Self::Sub(a, b) => Op::Sub(with(*a), with(*b)),
            Self::Mul(a, b) => Op::Mul(with(*a), with(*b)),
            Self::Div(a, b) => Op::Div(with(*a), with(*b)),
            Self::Where { value, limit, then } => {
                Op::Where { value: with(*value), limit: with(*limit), then: with(*then) }
            }
            Self::Kernel { kernel, args, part } => {
                Op::Kernel { kernel: *kernel, args: args.iter().map(|a| with(*a)).collect(), part: *part }
            }
            Self::Quantity(a) => Op::Quantity(with(*a)),
            Self::Held(a) => Op::Held(with(*a)),
            Self::Checked { value, guard } => Op::Checked { value: with(*value), guard: *guard },
        }
    }
}

/// What must hold before a value is used. Written so that a NaN fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Condition<T = NodeId> {
    /// `value > limit`.
    Above {
        /// What is compared.
        value: T,
        /// What it must exceed.
        limit: T,
    },
    /// `value >= limit`.
    AtLeast {
        /// What is compared.
        value: T,
        /// What it must reach.
        limit: T,
    },
}

impl<T: Copy> Condition<T> {
    /// Whether values of the two sides satisfy it; NaN does not.
    #[must_use]
    pub fn holds<R: real::Real>(self, value: &R, limit: &R) -> bool {
        match self {
            Self::Above { .. } => value.above(limit),
            Self::AtLeast { .. } => value.at_least(limit),
        }
    }

    /// The two sides.
    #[must_use]
    pub fn operands(self) -> [T; 2] {
        match self {
            Self::Above { value, limit } | Self::AtLeast { value, limit } => [value, limit],
        }
    }

    /// The same of other sides.
    #[must_use]
    pub fn map<U>(self, mut with: impl FnMut(T) -> U) -> Condition<U> {
        match self {
            Self::Above { value, limit } => Condition::Above { value: with(value), limit: with(limit) },
            Self::AtLeast { value, limit } => Condition::AtLeast { value: with(value), limit: with(limit) },
        }
    }
}

/// What is reported when a check fails.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Failure<T = NodeId> {
    /// The group cannot be closed at this pose.
    CannotAssemble {
        /// The group, by its links.
        group: String,
        /// The joint that cannot be closed.
        joint: String,
        /// By how much it stays open.
        gap: T,
    },
    /// The search for the places of a group does not arrive.
    NoConvergence {
        /// The group, by its links.
        group: String,
        /// How much stays open.
        gap: T,
    },
    /// Two pivots meet where the group needs them apart.
    CoincidentPivots {
        /// The group, by its links.
        group: String,
        /// The joint whose place is undetermined.
        joint: String,
    },
    /// The unknowns of the group cannot balance its loads.
    DeadCentre {
        /// The group, by its links.
        group: String,
        /// What vanishes.
        pivot: String,
    },
    /// Two points coincide between which something acts.
    CoincidentEnds {
        /// What acts between them.
        of: String,
    },
    /// A vector vanishes whose direction is needed.
    NoDirection {
        /// Which one, as `the velocity of C`.
        of: String,
    },
    /// A joint lies on the other side than is chosen for its group.
    OtherSide {
        /// The joint.
        joint: String,
    },
    /// A parameter is out of its range.
    Parameter {
        /// What is wrong with it, as `crank: |A0 A| must be positive`.
        requirement: String,
    },
}

impl<T: Copy> Failure<T> {
    /// What is reported with it.
    #[must_use]
    pub fn operand(&self) -> Option<T> {
        match self {
            Self::CannotAssemble { gap, .. } | Self::NoConvergence { gap, .. } => Some(*gap),
            _ => None,
        }
    }

    /// The same with another operand.
    #[must_use]
    pub fn map<U>(&self, mut with: impl FnMut(T) -> U) -> Failure<U> {
        match self {
            Self::CannotAssemble { group, joint, gap } => {
                Failure::CannotAssemble { group: group.clone(), joint: joint.clone(), gap: with(*gap) }
            }
            Self::NoConvergence { group, gap } => Failure::NoConvergence { group: group.clone(), gap: with(*gap) },
            Self::CoincidentPivots { group, joint } => {
                Failure::CoincidentPivots { group: group.clone(), joint: joint.clone() }
            }
            Self::DeadCentre { group, pivot } => Failure::DeadCentre { group: group.clone(), pivot: pivot.clone() },
            Self::CoincidentEnds { of } => Failure::CoincidentEnds { of: of.clone() },
            Self::NoDirection { of } => Failure::NoDirection { of: of.clone() },
            Self::OtherSide { joint } => Failure::OtherSide { joint: joint.clone() },
            Self::Parameter { requirement } => Failure::Parameter { requirement: requirement.clone() },
        }
    }
}

/// A check.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Guard<T = NodeId> {
    /// What must hold.
    pub condition: Condition<T>,
    /// What is reported otherwise.
    pub failure: Failure<T>,
}

/// The name of a node in the emitted code, and the equation that it stands for.
#[derive(Clone, Debug)]
pub struct Label {
    /// Its name.
    pub name: String,
    /// The formula or the meaning; may be empty.
    pub equation: String,
}

/// A component of the direction of a link that has a constant length.
#[derive(Clone, Debug)]
pub struct Component<T = NodeId> {
    /// That of the vector along the link, if this over the length is the direction but for a few roundings.
    pub arm: Option<T>,
    /// The reciprocal of the length.
    pub reciprocal: number::Number,
    /// The length, as text: the same in both components, and in no other direction.
    pub length: String,
}

#[derive(Default, Debug)]
struct Arena {
    ops: Vec<Op>,
    stages: Vec<Stage>,
    sections_of: Vec<SectionId>,
    index: FxHashMap<Op, NodeId>,
    numbers: Vec<Number>,
    number_index: FxHashMap<number::Key, NumberId>,
    guards: Vec<Guard>,
    guard_index: FxHashMap<Guard, GuardId>,
    labels: BTreeMap<NodeId, (Label, SectionId)>,
    /// The scene whose results are being worked out, and in which scene a label was given.
    scene: Option<usize>,
    labelled_in: BTreeMap<NodeId, usize>,
    /// What another scene calls a value that an earlier one has named, and under which heading.
    labels_of_scenes: BTreeMap<(usize, NodeId), (Label, SectionId)>,
    results_of_scenes: BTreeMap<(usize, NodeId), SectionId>,
    positive: BTreeSet<NodeId>,
    /// Quotients that are divided, whatever others have the same divisor.
    divided: BTreeSet<NodeId>,
    /// What is checked when a pose is made.
    hold_in_poses: BTreeSet<GuardId>,
    /// Of what a pose keeps, the reciprocals that it keeps, too.
    reciprocals: BTreeMap<NodeId, NodeId>,
    /// Of values, how they are put together where a pose is given.
    from_pose: BTreeMap<NodeId, NodeId>,
    /// Components of directions of links that have a constant length.
    directions: BTreeMap<NodeId, Component>,
    /// From which place on nodes count the rounding of values, if any do.
    counted_from: Option<usize>,
    /// What one group finds and others take up, whose error meets itself again in what is made of it.
    passed_on: BTreeSet<NodeId>,
    /// What was found not to be negative by its form, which is asked for often.
    non_negative: BTreeSet<NodeId>,
    sections: Vec<String>,
    searches: Vec<Search>,
    solved: Vec<elimination::Solved>,
}

/// The graph. Nodes are added through a shared reference, so that expressions can be written with operators.
#[derive(Debug)]
pub struct Graph {
    arena: RefCell<Arena>,
    scalar: Scalar,
    fused: bool,
}

impl Graph {
    /// An empty graph for a number type.
    #[must_use]
    pub fn new(scalar: Scalar) -> Self {
        let arena = Arena { sections: vec![String::new()], ..Arena::default() };
        Self { arena: RefCell::new(arena), scalar, fused: false }
    }

    /// The same, for programs in which products are added without being rounded.
    #[must_use]
    pub fn with_fused(self, fused: bool) -> Self {
        Self { fused, ..self }
    }

    /// The rounding of values is counted from here on, of the operations as they stand here.
    pub fn count_rounding(&self) {
        let next = self.len();
        self.arena.borrow_mut().counted_from.get_or_insert(next);
    }

    /// Whether the rounding of any values is counted.
    #[must_use]
    pub fn counts_rounding(&self) -> bool {
        self.arena.borrow().counted_from.is_some()
    }

    /// Whether a node came with the count.
    #[must_use]
    pub fn is_of_count(&self, node: NodeId) -> bool {
        self.arena.borrow().counted_from.is_some_and(|first| node.index() >= first)
    }

    /// Whether products are added without being rounded.
    #[must_use]
    pub fn is_fused(&self) -> bool {
        self.fused
    }

    /// The number type.
    #[must_use]
    pub fn scalar(&self) -> Scalar {
        self.scalar
    }

    /// How many nodes there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.arena.borrow().ops.len()
    }

    /// Whether there is no node.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The expression of a node.
    #[must_use]
    pub fn expr(&self, id: NodeId) -> Expr<'_> {
        Expr::new(self, id)
    }

    /// What a node computes.
    #[must_use]
    pub fn op(&self, id: NodeId) -> Op {
        self.arena.borrow().ops[id.index()].clone()
    }

    /// When a node becomes known.
    #[must_use]
    pub fn stage(&self, id: NodeId) -> Stage {
        self.arena.borrow().stages[id.index()]
    }

    /// A constant's value.
    #[must_use]
    pub fn number(&self, id: NumberId) -> Number {
        self.arena.borrow().numbers[id.0 as usize].clone()
    }

    /// The value of a node that is constant.
    #[must_use]
    pub fn constant_value(&self, id: NodeId) -> Option<Number> {
        let arena = self.arena.borrow();
        match arena.ops[id.index()] {
            Op::Constant(n) => Some(arena.numbers[n.0 as usize].clone()),
            _ => None,
        }
    }

    /// A check.
    #[must_use]
    pub fn guard(&self, id: GuardId) -> Guard {
        self.arena.borrow().guards[id.0 as usize].clone()
    }

    /// Notes the checks without which there is no pose.
    pub(crate) fn hold_in_poses(&self, guards: BTreeSet<GuardId>) {
        self.arena.borrow_mut().hold_in_poses = guards;
    }

    /// Whether there is no pose without this check.
    pub(crate) fn holds_in_poses(&self, guard: GuardId) -> bool {
        self.arena.borrow().hold_in_poses.contains(&guard)
    }

    /// Notes that groups take up what another has found, under its name.
    pub(crate) fn pass_on(&self, value: Expr<'_>) {
        self.arena.borrow_mut().passed_on.insert(value.id());
    }

    /// Whether they do.
    pub(crate) fn is_passed_on(&self, node: NodeId) -> bool {
        self.arena.borrow().passed_on.contains(&node)
    }

    /// A node's name.
    #[must_use]
    pub fn label(&self, id: NodeId) -> Option<Label> {
        self.arena.borrow().labels.get(&id).map(|(label, _)| label.clone())
    }

    /// A node's name in the functions of a scene.
    #[must_use]
    pub fn label_in(&self, scene: Option<usize>, id: NodeId) -> Option<Label> {
        self.arena.borrow().given_in(scene, id).map(|(label, _)| label.clone())
    }

    /// The heading under which a node got its name or became a result of the scene, whatever made it before.
    #[must_use]
    pub fn heading_in(&self, scene: Option<usize>, id: NodeId) -> Option<String> {
        let arena = self.arena.borrow();
        let given = arena.given_in(scene, id).map(|(_, section)| *section);
        let section = given.or_else(|| arena.results_of_scenes.get(&(scene?, id)).copied())?;
        Some(arena.sections[section.0 as usize].clone())
    }

    /// These are results of the scene that is worked out, under the heading that is open.
    pub fn are_results(&self, nodes: impl IntoIterator<Item = NodeId>) {
        let arena = &mut *self.arena.borrow_mut();
        let (Some(scene), section) = (arena.scene, SectionId(index(arena.sections.len() - 1))) else { return };
        for node in nodes {
            arena.results_of_scenes.entry((scene, node)).or_insert(section);
        }
    }

    /// From here on, results of this scene are worked out: what another one has named, it may call by another name.
    pub fn begin_scene(&self, scene: usize) {
        self.arena.borrow_mut().scene = Some(scene);
    }

    /// The scene of which results are worked out.
    #[must_use]
    pub fn scene(&self) -> Option<usize> {
        self.arena.borrow().scene
    }

    /// The results of all scenes are worked out.
    pub fn end_scenes(&self) {
        self.arena.borrow_mut().scene = None;
    }

    fn set_label(&self, id: NodeId, label: Label) {
        let arena = &mut *self.arena.borrow_mut();
        let section = SectionId(index(arena.sections.len() - 1));
        match (arena.labels.get_mut(&id), arena.scene) {
            // One that came without a meaning, or without a heading as in the general equations, gets those that come with it later.
            (Some((first, own)), _) if first.name == label.name => {
                let says_more = first.equation.is_empty() && !label.equation.is_empty();
                if says_more || arena.sections[own.0 as usize].is_empty() {
                    (*first, *own) = (label, section);
                }
            }
            (None, scene) => {
                arena.labels.insert(id, (label, section));
                arena.labelled_in.extend(scene.map(|scene| (id, scene)));
            }
            // A name that the pose gave is that of all.
            (Some(_), Some(scene)) if arena.labelled_in.get(&id).is_some_and(|own| *own != scene) => {
                arena.labels_of_scenes.entry((scene, id)).or_insert((label, section));
            }
            _ => {}
        }
    }

    /// Names a value that a pose keeps.
    pub fn name_kept(&self, value: NodeId, name: &str) {
        let label = Label { name: name.to_owned(), equation: String::new() };
        let arena = &mut *self.arena.borrow_mut();
        arena.labels.entry(value).or_insert((label, arena.sections_of[value.index()]));
    }

    /// The heading under which a node was made, empty for none.
    #[must_use]
    pub fn section(&self, id: NodeId) -> String {
        let arena = self.arena.borrow();
        arena.sections[arena.sections_of[id.index()].0 as usize].clone()
    }

    /// What is known of a node that is a component of a link's direction.
    #[must_use]
    pub fn component(&self, id: NodeId) -> Option<Component> {
        self.arena.borrow().directions.get(&id).cloned()
    }

    /// Lets a pose keep the reciprocal of what it keeps, zero where that is zero. Functions from a pose multiply by it.
    pub fn keep_reciprocal<'g>(&'g self, kept: Expr<'g>, name: &str, equation: &str) -> Expr<'g> {
        let reciprocal = (self.one() / kept).where_above(kept.abs(), self.zero());
        let zero = if let Op::Where { .. } = reciprocal.op() { ", zero where that is" } else { "" };
        let reciprocal = reciprocal.named(name, format!("{equation}{zero}")).held();
        self.arena.borrow_mut().reciprocals.insert(kept.id(), reciprocal.id());
        reciprocal
    }

    /// How a value is put together where a pose is given, if that is not as straight from the drives.
    #[must_use]
    pub fn put_together_from_pose(&self, value: NodeId) -> Option<NodeId> {
        self.arena.borrow().from_pose.get(&value).copied()
    }

    /// The reciprocal that a pose keeps of a divisor, itself kept.
    #[must_use]
    pub fn kept_reciprocal(&self, divisor: NodeId) -> Option<NodeId> {
        self.arena.borrow().reciprocals.get(&self.bare(divisor)).copied()
    }

    /// A value without its names and checks.
    #[must_use]
    pub fn bare(&self, mut node: NodeId) -> NodeId {
        while let Op::Quantity(inner) | Op::Checked { value: inner, .. } = self.op(node) {
            node = inner;
        }
        node
    }

    /// Whether a value, perhaps with names, is one of a check.
    #[must_use]
    pub fn is_checked(&self, node: NodeId) -> bool {
        match self.op(node) {
            Op::Checked { .. } => true,
            Op::Quantity(inner) => self.is_checked(inner),
            _ => false,
        }
    }

    /// Whether a node is a quotient that is to be divided.
    #[must_use]
    pub fn is_divided(&self, id: NodeId) -> bool {
        self.arena.borrow().divided.contains(&id)
    }

    /// From here on, new nodes stand under this heading.
    pub fn begin_section(&self, heading: impl Into<String>) {
        self.arena.borrow_mut().sections.push(heading.into());
    }

    /// What is made under the heading of another node.
    pub(crate) fn beside<T>(&self, node: NodeId, make: impl FnOnce() -> T) -> T {
        let own = self.arena.borrow().sections.last().cloned().unwrap_or_default();
        self.begin_section(self.section(node));
        let made = make();
        self.begin_section(own);
        made
    }

    /// A constant.
    pub fn constant(&self, value: &Number) -> Expr<'_> {
        let id = self.intern_number(value);
        self.intern(Op::Constant(id))
    }

    /// A whole number.
    pub fn integer(&self, value: i64) -> Expr<'_> {
        self.constant(&Number::integer(value))
    }

    /// Zero.
    pub fn zero(&self) -> Expr<'_> {
        self.integer(0)
    }

    /// One.
    pub fn one(&self) -> Expr<'_> {
        self.integer(1)
    }

    /// The largest number of the number type.
    pub fn largest(&self) -> Expr<'_> {
        let largest = Number::from_f64(self.scalar.largest()).unwrap_or_else(Number::one);
        self.constant(&largest)
    }

    /// A multiple of the number type's epsilon.
    pub fn epsilons(&self, factor: i64) -> Expr<'_> {
        self.constant(&self.scalar.epsilon().mul(&Number::integer(factor)))
    }

    /// What is known only at run time.
    pub fn symbol(&self, symbol: Symbol) -> Expr<'_> {
        self.intern(Op::Symbol(symbol))
    }

    /// The zero vector.
    pub fn zero_vector(&self) -> Vector<'_> {
        Vector { x: self.zero(), y: self.zero() }
    }

    pub(crate) fn intern_number(&self, value: &Number) -> NumberId {
        let mut arena = self.arena.borrow_mut();
        let key = value.key();
        if let Some(id) = arena.number_index.get(&key) {
            return *id;
        }
        let id = NumberId(index(arena.numbers.len()));
        arena.numbers.push(value.clone());
        arena.number_index.insert(key, id);
        id
    }

    /// What a parameter must be is asked once, whatever it is used for: two links that have it as their length have one length.
    fn asked_before(&self, guard: &Guard) -> Option<GuardId> {
        let of_parameter = |guard: &Guard| matches!(guard.failure, Failure::Parameter { .. });
        if !of_parameter(guard) {
            return None;
        }
        let same = |other: &Guard| of_parameter(other) && other.condition == guard.condition;
        self.arena.borrow().guards.iter().position(same).map(|place| GuardId(index(place)))
    }

    /// What parameters make as what has been asked to be positive, if it has.
    #[must_use]
    pub fn asked_to_be_positive<'g>(&'g self, value: Expr<'g>) -> Option<Expr<'g>> {
        if value.value().is_some() {
            return None;
        }
        let positive = Condition::Above { value: value.id(), limit: self.zero().id() };
        let arena = self.arena.borrow();
        let asked = |id: &NodeId| match arena.ops[id.index()] {
            Op::Checked { value: of, guard } => of == value.id() && self.guard(guard).condition == positive,
            _ => false,
        };
        arena.positive.iter().copied().find(asked).map(|id| self.expr(id))
    }

    fn intern_guard(&self, guard: Guard) -> GuardId {
        let mut arena = self.arena.borrow_mut();
        if let Some(id) = arena.guard_index.get(&guard) {
            return *id;
        }
        let id = GuardId(index(arena.guards.len()));
        arena.guards.push(guard.clone());
        arena.guard_index.insert(guard, id);
        id
    }

    /// The node that computes this, made if there is none. Sums and products are found in either order.
    fn intern(&self, op: Op) -> Expr<'_> {
        let mut arena = self.arena.borrow_mut();
        let swapped = match op {
            Op::Add(a, b) => Some(Op::Add(b, a)),
            Op::Mul(a, b) => Some(Op::Mul(b, a)),
            _ => None,
        };
        if let Some(id) = arena.index.get(&op).or_else(|| swapped.and_then(|op| arena.index.get(&op))) {
            return Expr::new(self, *id);
        }
        let id = NodeId(index(arena.ops.len()));
        let stage = arena.stage_of(&op);
        let section = SectionId(index(arena.sections.len() - 1));
        arena.ops.push(op.clone());
        arena.stages.push(stage);
        arena.sections_of.push(section);
        arena.index.insert(op, id);
        Expr::new(self, id)
    }

    fn find(&self, op: &Op) -> Option<Expr<'_>> {
        self.arena.borrow().index.get(op).map(|id| Expr::new(self, *id))
    }
}

impl Arena {
    /// A node's name in the functions of a scene, and the section in which it was given.
    fn given_in(&self, scene: Option<usize>, id: NodeId) -> Option<&(Label, SectionId)> {
        let own = scene.and_then(|scene| self.labels_of_scenes.get(&(scene, id)));
        own.or_else(|| self.labels.get(&id))
    }

    fn stage_of(&self, op: &Op) -> Stage {
        let own = match op {
            Op::Symbol(Symbol::Parameter(_)) => Stage::Prepared,
            Op::Symbol(Symbol::Load(..) | Symbol::Driven(..) | Symbol::Moving(..)) => Stage::Loaded,
            Op::Symbol(Symbol::Sought(..)) => Stage::Iterated,
            Op::Symbol(_) => Stage::Posed,
            _ => Stage::Constant,
        };
        let guard = match op {
            Op::Checked { guard, .. } => self.guards[guard.0 as usize].condition.operands().to_vec(),
            _ => Vec::new(),
        };
        op.operands().iter().chain(&guard).map(|id| self.stages[id.index()]).max().unwrap_or(own).max(own)
    }
}

impl NodeId {
    /// Its place in the order of evaluation.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Graphs stay far below 2³² nodes: a declaration would need gigabytes of source.
fn index(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
