//! The motion side of a plan while it is made: what is placed, which angles are known, which closures were used.

use std::collections::BTreeSet;

use super::output::Meaning;
use super::pivots::Pivots;
use super::placement::Placement;
use crate::diagnostics::{Diagnostic, list};
use crate::graph::{Expr, Graph, Op, Symbol, Vector};
use crate::model::ids::{ClosureId, DriveId, JointId, LinkId};
use crate::model::units::Kind;
use crate::model::{Closure, Model, Side, Wanted};
use crate::topology::{Group, Topology};

/// A pivot of a dyad: zero at its dead centre, and where it is no larger than its rounding.
#[derive(Clone, Debug)]
pub struct DyadPivot<'m> {
    /// Its name.
    pub name: String,
    /// What it is.
    pub what: String,
    /// Of a length or a sine.
    pub meaning: Meaning,
    /// Its value.
    pub value: Expr<'m>,
    /// With a sine, the cosine of the same angle, if the closure knows it.
    pub cosine: Option<Cosine<'m>>,
}

/// The cosine of a transmission angle.
#[derive(Clone, Debug)]
pub struct Cosine<'m> {
    /// Its name.
    pub name: String,
    /// What it is.
    pub what: String,
    /// Its value.
    pub value: Expr<'m>,
}

impl<'m> DyadPivot<'m> {
    /// The sine of the transmission angle at a dyad's inner joint, and its cosine if that is known.
    #[must_use]
    pub fn sine(model: &Model, inner: JointId, value: Expr<'m>, cosine: Option<Expr<'m>>) -> Self {
        let joint = &model.joint(inner).name;
        let what = format!("of the transmission angle at `{joint}`");
        let cosine =
            cosine.map(|value| Cosine { name: format!("cos_mu_{joint}"), what: format!("cosine {what}"), value });
        Self { name: format!("sin_mu_{joint}"), what: format!("sine {what}"), meaning: Meaning::Sine, value, cosine }
    }

    /// The distance of a dyad's outer pins along its slide.
    #[must_use]
    pub fn reach(model: &Model, slide: JointId, value: Expr<'m>) -> Self {
        let (joint, unit) = (&model.joint(slide).name, Kind::Length.unit(&model.units));
        let what = format!("distance of the outer pins along the slide `{joint}`, {unit}, the lever arm of its force");
        Self { name: format!("reach_{joint}"), what, meaning: Meaning::Length, value, cosine: None }
    }
}

/// The sign of a root that a closure chooses.
#[derive(Clone, Copy, Debug)]
pub enum Sign<'m> {
    /// The positive one.
    Plus,
    /// The negative one.
    Minus,
    /// As an argument says, which is 1 or −1, with its name.
    Given(Expr<'m>, &'m str),
}

impl<'m> Sign<'m> {
    /// The root with this sign.
    #[must_use]
    pub fn of(self, root: Expr<'m>) -> Expr<'m> {
        match self {
            Self::Plus => root,
            Self::Minus => -root,
            Self::Given(sign, _) => sign * root,
        }
    }

    /// The other one.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Plus => Self::Minus,
            Self::Minus => Self::Plus,
            Self::Given(sign, joint) => Self::Given(-sign, joint),
        }
    }

    /// What stands before the root in an equation.
    #[must_use]
    pub fn text(self) -> String {
        match self {
            Self::Plus => String::new(),
            Self::Minus => "−".to_owned(),
            Self::Given(sign, joint) => {
                format!("{}side_{joint} ", if matches!(sign.op(), Op::Neg(_)) { "−" } else { "" })
            }
        }
    }
}

/// How a group in two unknowns was closed: from what is left of its closure follows how far its solution is off.
#[derive(Clone, Debug)]
pub struct ClosedLoop<'m> {
    /// The name of its error: that of the joint that closes it.
    pub name: String,
    /// What should be zero, of the values as they are found.
    pub residual: Vector<'m>,
    /// What was found.
    pub found: [Found<'m>; 2],
    /// The first column × the second one.
    pub determinant: Expr<'m>,
    /// The pivot, if the closure gave it by itself.
    pub pivot: Option<Pivot<'m>>,
    /// Whether lengths may differ by so much that a direction is found better than what is left of the closure tells.
    pub apart: bool,
}

/// How a group was placed by a search: from what is left of its equations follows how far its unknowns are off.
#[derive(Clone, Debug)]
pub struct PlacedTogether<'m> {
    /// As many as there are unknowns.
    pub equations: Vec<ClosedEquation<'m>>,
    /// What was sought.
    pub unknowns: Vec<Unknown<'m>>,
    /// What that is called.
    pub names: Vec<String>,
}

/// An equation of a search at the place that was found.
#[derive(Clone, Debug)]
pub struct ClosedEquation<'m> {
    /// The name of its error: that of the joint, and which component.
    pub name: String,
    /// What should be zero.
    pub residual: Expr<'m>,
    /// Its change with each unknown: with a turn, or with a travel by its scale.
    pub changes: Vec<Expr<'m>>,
    /// Of a loop the equation of its other component; an equation that has none is linear.
    pub other: Option<usize>,
}

/// An unknown of a search, where it was found.
#[derive(Clone, Copy, Debug)]
pub enum Unknown<'m> {
    /// A direction.
    Direction(Vector<'m>),
    /// An angle with all its turns.
    Angle(Expr<'m>),
    /// A travel.
    Travel {
        /// Its value.
        travel: Expr<'m>,
        /// The length that counts like a turn of one radian.
        scale: Expr<'m>,
    },
}

impl<'m> Unknown<'m> {
    /// Its numbers.
    #[must_use]
    pub fn values(&self) -> Vec<Expr<'m>> {
        match *self {
            Self::Direction(direction) => vec![direction.x, direction.y],
            Self::Angle(value) | Self::Travel { travel: value, .. } => vec![value],
        }
    }
}

/// How a group with unknowns was closed.
#[derive(Clone, Debug)]
pub enum Closed<'m> {
    /// In closed form.
    Loop(Box<ClosedLoop<'m>>),
    /// By a search.
    Together(PlacedTogether<'m>),
}

/// A pivot that a closure knows by itself.
#[derive(Clone, Copy, Debug)]
pub struct Pivot<'m> {
    /// Its value.
    pub value: Expr<'m>,
    /// The same from what was found.
    pub again: Expr<'m>,
    /// How it changes with the two unknowns, if its own operations may tell more than what is left of the closure.
    pub slopes: Option<[Expr<'m>; 2]>,
}

/// An unknown of a closed loop, and by what vector the residual changes with it.
#[derive(Clone, Copy, Debug)]
pub enum Found<'m> {
    /// A direction.
    Direction {
        /// The unit vector.
        direction: Vector<'m>,
        /// Change of the residual with its angle.
        column: Vector<'m>,
        /// Change of the residual with its size.
        arm: Vector<'m>,
    },
    /// A length.
    Length {
        /// Its value.
        length: Expr<'m>,
        /// Change of the residual with it.
        column: Vector<'m>,
    },
}

/// What the groups solved so far have placed.
#[derive(Debug)]
pub struct Assembly<'m> {
    /// Where the links are.
    pub placement: Placement<'m>,
    /// Which angles are known.
    pub pivots: Pivots<'m>,
    /// The dyads' pivots.
    pub dyads: Vec<DyadPivot<'m>>,
    /// How groups were closed, in their order.
    pub closed: Vec<Closed<'m>>,
    /// Directions beside those of the links: of driven legs against what their first links carry.
    pub leans: Vec<Vector<'m>>,
    /// The groups of motion.
    pub topology: &'m Topology,
    /// The links that are placed by iteration, from a start.
    pub started: BTreeSet<LinkId>,
    used: BTreeSet<ClosureId>,
    /// Groups of which is not said how they close.
    unsaid: Vec<Unsaid>,
}

/// A group that closes in two ways, and no word which one is meant.
#[derive(Clone, Debug)]
struct Unsaid {
    links: Vec<LinkId>,
    inner: JointId,
    outer: Vec<JointId>,
    /// What it is, in words, and what to write.
    problem: String,
    choice: String,
}

impl Unsaid {
    fn error(&self, model: &Model) -> Diagnostic {
        Diagnostic::new(model.joint(self.inner).name.place(), self.problem.clone()).help(&self.choice)
    }
}

impl<'m> Assembly<'m> {
    /// Before any group is solved.
    #[must_use]
    pub fn new(model: &'m Model, topology: &'m Topology) -> Self {
        Self {
            placement: Placement::of_ground(model),
            pivots: Pivots::default(),
            dyads: Vec::new(),
            closed: Vec::new(),
            leans: Vec::new(),
            topology,
            started: BTreeSet::new(),
            used: BTreeSet::new(),
            unsaid: Vec::new(),
        }
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

    /// The coordinate of a drive.
    #[must_use]
    pub fn coordinate(&self, drive: DriveId) -> Expr<'m> {
        self.graph().symbol(Symbol::Drive(drive))
    }

    /// A loop is closed.
    pub fn closed(&mut self, how: impl FnOnce() -> ClosedLoop<'m>) {
        self.note(|| Closed::Loop(Box::new(how())));
    }

    /// A group is placed by a search.
    pub fn placed_together(&mut self, how: impl FnOnce() -> PlacedTogether<'m>) {
        self.note(|| Closed::Together(how()));
    }

    /// How a group is closed is of interest to bounds of errors alone.
    fn note(&mut self, how: impl FnOnce() -> Closed<'m>) {
        if self.model().scenes.iter().any(|scene| scene.results.contains(&Wanted::ErrorBound)) {
            self.closed.push(how());
        }
    }

    /// The declared closure of a group with this inner joint.
    pub fn closure(&mut self, inner: JointId, group: &Group) -> Option<&'m Closure> {
        let model = self.model();
        let id = model.closure_at(inner, &group.outer)?;
        self.used.insert(id);
        Some(model.closure(id))
    }

    /// Nothing is said of the closures of a group that has an error.
    pub fn pass_over(&mut self, group: &Group) {
        let ids = (0..self.model().closures.len()).map(ClosureId::new);
        let own = ids.filter(|id| group.inner.contains(&self.model().closure(*id).joint));
        self.used.extend(own.collect::<Vec<_>>());
    }

    /// The sign that a closure chooses, if `plus` is the side of the positive root.
    #[must_use]
    pub fn sign(&self, closure: &Closure, plus: Side) -> Sign<'m> {
        let model = self.model();
        if !closure.is_given_at_run_time() {
            return if closure.side == plus { Sign::Plus } else { Sign::Minus };
        }
        let index = model.closures.iter().position(|own| core::ptr::eq(own, closure)).unwrap_or(0);
        let sign = self.graph().symbol(Symbol::Side(ClosureId::new(index)));
        Sign::Given(sign, &model.joint(closure.joint).name.text)
    }

    /// Whether a group closes as this closure says.
    #[must_use]
    pub fn uses(&self, closure: ClosureId) -> bool {
        self.used.contains(&closure)
    }

    /// Closures that no group asked for.
    pub fn unused_closures(&self) -> impl Iterator<Item = &'m Closure> {
        let all = self.model().closures.iter().enumerate();
        all.filter(|(index, _)| !self.uses(ClosureId::new(*index))).map(|(_, closure)| closure)
    }

    /// A group that closes in two ways, and no word which one is meant.
    pub fn missing_closure(&mut self, group: &Group, inner: JointId, sides: [Side; 2], of: &str) -> Diagnostic {
        let model = self.model();
        let joint = &model.joint(inner).name;
        let [one, other] = sides.map(|side| format!("assemble {joint}: {}({of});", side.word()));
        let links: Vec<&str> = group.links.iter().map(|link| model.link(*link).name.text.as_str()).collect();
        let problem = format!("{} can be assembled at `{joint}` in two ways", list(&links));
        let choice = format!("choose one of\n{one}\n{other}");
        let unsaid = Unsaid { links: group.links.clone(), inner, outer: group.outer.clone(), problem, choice };
        let error = unsaid.error(model);
        self.unsaid.push(unsaid);
        error
    }

    /// Whether nothing but its closure is missing of a group: it is told with the closures that are not used, as one of them may be meant.
    #[must_use]
    pub fn lacks_closure(&self, group: &Group) -> bool {
        self.unsaid.iter().any(|unsaid| unsaid.links == group.links)
    }

    /// What is wrong with the closures: those that no group asked for, and groups that asked for one in vain. Of a closure at the wrong joint
    /// of a group there is one error.
    pub fn wrong_closures(&mut self, unused: &[&Closure]) -> Vec<Diagnostic> {
        let model = self.model();
        let mut found = Vec::new();
        for closure in unused {
            let problem = format!("there is nothing to choose at `{}`", model.joint(closure.joint).name);
            let error = Diagnostic::new(closure.place, problem);
            found.push(match self.meant_by(closure) {
                Some(group) => error.note(group.problem).help(group.choice),
                None => error
                    .note("a side is chosen at the inner joint of a dyad: at the joint between its two links")
                    .help("leave it out"),
            });
        }
        found.extend(self.unsaid.iter().map(|group| group.error(model)));
        found
    }

    /// Takes the group for which a closure at another joint was probably meant: the one with most of its joints.
    fn meant_by(&mut self, closure: &Closure) -> Option<Unsaid> {
        let named: Vec<JointId> = closure.of.iter().copied().chain([closure.joint]).collect();
        let shared =
            |group: &Unsaid| named.iter().filter(|joint| group.inner == **joint || group.outer.contains(joint)).count();
        let counted = self.unsaid.iter().map(shared).enumerate().filter(|(_, shared)| *shared > 0);
        // Of several the first.
        let (index, _) = counted.rev().max_by_key(|(_, shared)| *shared)?;
        Some(self.unsaid.remove(index))
    }
}
