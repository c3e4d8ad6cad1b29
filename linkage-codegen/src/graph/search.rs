//! Groups that are placed by Newton's method: the arithmetic of the run-time crate, operation by operation, for any number type.

use std::collections::BTreeSet;

use super::linear::Factors;
use super::number::Number;
use super::real::Real;
use super::{Expr, Graph, Kernel, NodeId, NodeValues, Op, Scalar, Stage, Symbol, Vector};
use crate::model::ids::DriveId;

/// A search for the places of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SearchId(u32);

/// An unknown of a search.
#[derive(Clone, Debug)]
pub enum Sought {
    /// A direction: its two components, moved by turning it.
    Direction {
        /// Its name, to which `_cos` and `_sin` are added.
        name: String,
    },
    /// A travel.
    Travel {
        /// Its name.
        name: String,
        /// The length that counts like a turn of one radian.
        scale: NodeId,
    },
}

impl Sought {
    /// How many numbers it has.
    #[must_use]
    pub fn size(&self) -> usize {
        match self {
            Self::Direction { .. } => 2,
            Self::Travel { .. } => 1,
        }
    }

    /// The names of its numbers.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Direction { name } => vec![format!("{name}_cos"), format!("{name}_sin")],
            Self::Travel { name, .. } => vec![name.clone()],
        }
    }
}

/// What a search solves: `residuals = 0`, in the symbols of its unknowns.
#[derive(Clone, Debug)]
pub struct Search {
    /// The name of its function.
    pub name: String,
    /// Its group, by its links.
    pub group: String,
    /// The unknowns: directions, then travels.
    pub sought: Vec<Sought>,
    /// Where it starts unless it goes on from another pose: a value for each number of the unknowns, then for each drive.
    pub start: Vec<NodeId>,
    /// What is zero when the group is closed.
    pub residuals: Vec<NodeId>,
    /// For each residual its change with each unknown: with a turn, or with a travel by its scale.
    pub jacobian: Vec<Vec<NodeId>>,
    /// What rounding may leave open of all residuals together.
    pub rounding: NodeId,
    /// What the residuals read beside the unknowns: first what changes with the drives, then what does not.
    pub known: Vec<NodeId>,
    /// How much of it changes with the drives.
    pub changing: usize,
    /// The drives with which it changes.
    pub drives: Vec<DriveId>,
    /// How far each drive goes in the longest stride.
    pub reach: Vec<NodeId>,
    /// What it takes to work out what changes, beside the drives: what is prepared, and where searches before this one start.
    pub given: Vec<NodeId>,
}

/// The arguments of a search, apart.
#[derive(Clone, Copy, Debug)]
pub struct Arguments<'a, T> {
    /// The numbers of directions, two for each, then those of travels.
    pub start: &'a [T],
    /// The drives there.
    pub from: &'a [T],
    /// The drives where they are wanted.
    pub to: &'a [T],
    /// How far each goes in the longest stride.
    pub reach: &'a [T],
    /// What it takes to work out what changes with the drives.
    pub given: &'a [T],
    /// What is known where the drives are wanted.
    pub known: &'a [T],
}

impl Search {
    /// How many numbers the unknowns have.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.sought.iter().map(Sought::size).sum()
    }

    /// The name of the function that works out what changes on the way.
    #[must_use]
    pub fn way_name(&self) -> String {
        format!("{}_on_the_way", self.name)
    }

    /// How many directions it seeks.
    #[must_use]
    pub fn directions(&self) -> usize {
        self.sought.iter().filter(|sought| matches!(sought, Sought::Direction { .. })).count()
    }

    /// Its arguments, apart.
    #[must_use]
    pub fn arguments<'a, T>(&self, all: &'a [T]) -> Arguments<'a, T> {
        let drives = self.drives.len();
        let (start, rest) = all.split_at(self.numbers());
        let (from, rest) = rest.split_at(drives);
        let (to, rest) = rest.split_at(drives);
        let (reach, rest) = rest.split_at(drives);
        let (given, known) = rest.split_at(self.given.len());
        Arguments { start, from, to, reach, given, known }
    }

    /// All that is worked out in a step, each under a name of its own: residuals, Jacobian row by row, what rounding may leave open,
    /// the scales of travels.
    #[must_use]
    pub fn named_results(&self, graph: &Graph) -> Vec<(String, NodeId)> {
        let unknown = |sought: &Sought| match sought {
            Sought::Direction { name } | Sought::Travel { name, .. } => name.clone(),
        };
        let of = |residual: &NodeId| graph.label(*residual).map_or_else(|| "gap".to_owned(), |label| label.name);
        let residuals = self.residuals.iter().map(of);
        let changes = |residual| self.sought.iter().map(move |s| format!("{}_by_{}", of(residual), unknown(s)));
        let jacobian = self.residuals.iter().flat_map(changes);
        let names = residuals.chain(jacobian).chain(["rounding".to_owned()]);
        names.chain(core::iter::repeat("scale".to_owned())).zip(self.results()).collect()
    }

    /// All that is worked out in a step.
    #[must_use]
    pub fn results(&self) -> Vec<NodeId> {
        let scales = self.sought.iter().filter_map(|sought| match sought {
            Sought::Direction { .. } => None,
            Sought::Travel { scale, .. } => Some(scale),
        });
        let equations = self.residuals.iter().chain(self.jacobian.iter().flatten());
        equations.chain([&self.rounding]).chain(scales).copied().collect()
    }
}

impl Graph {
    /// The id of the next search.
    #[must_use]
    pub fn next_search(&self) -> SearchId {
        SearchId(super::index(self.arena.borrow().searches.len()))
    }

    /// A search.
    #[must_use]
    pub fn search(&self, id: SearchId) -> Search {
        self.arena.borrow().searches[id.0 as usize].clone()
    }

    /// All searches.
    #[must_use]
    pub fn searches(&self) -> Vec<(SearchId, Search)> {
        (0..).map(SearchId).zip(self.arena.borrow().searches.iter().cloned()).collect()
    }

    /// Where a search starts.
    #[must_use]
    pub fn start_of(&self, id: SearchId, number: u8) -> NodeId {
        self.arena.borrow().searches[id.0 as usize].start[usize::from(number)]
    }

    /// Whether a result of a search is a component of a direction.
    #[must_use]
    pub fn finds_direction(&self, id: SearchId, part: u8) -> bool {
        let search = self.search(id);
        let mut numbers =
            search.sought.iter().flat_map(|sought| core::iter::repeat_n(sought.size() == 2, sought.size()));
        part.checked_sub(1).and_then(|number| numbers.nth(usize::from(number))).unwrap_or(false)
    }

    /// Whether a search is given this node.
    #[must_use]
    pub fn is_known_to(&self, id: SearchId, node: NodeId) -> bool {
        self.arena.borrow().searches[id.0 as usize].known.contains(&node)
    }

    /// Whether what changes on the way of a search is worked out from this node.
    #[must_use]
    pub fn is_given_on_the_way(&self, id: SearchId, node: NodeId) -> bool {
        let search = &self.arena.borrow().searches[id.0 as usize];
        search.given.contains(&node)
            || matches!(self.op(node), Op::Symbol(Symbol::Drive(drive)) if search.drives.contains(&drive))
    }

    /// Enters a search. What its equations read is noted in it, and with which drives that changes; `reach` says how far one goes in a
    /// stride.
    pub fn enter(&self, mut search: Search, reach: &dyn Fn(DriveId) -> NodeId) -> SearchId {
        let id = self.next_search();
        let mut known = Vec::new();
        self.note_known(&search.results(), &mut known);
        let (changing, fixed): (Vec<NodeId>, Vec<NodeId>) =
            known.into_iter().partition(|node| self.stage(*node) > Stage::Prepared);
        self.note_given(&changing, &mut search);
        search.reach = search.drives.iter().map(|drive| reach(*drive)).collect();
        search.changing = changing.len();
        search.known = changing.into_iter().chain(fixed).collect();
        self.arena.borrow_mut().searches.push(search);
        id
    }

    /// Says where a search starts unless it goes on from another pose.
    pub fn set_start(&self, id: SearchId, start: Vec<NodeId>) {
        self.arena.borrow_mut().searches[id.0 as usize].start = start;
    }

    /// What a search finds where the drives are wanted: how much stays open, and its unknowns.
    pub fn found(&self, id: SearchId) -> Vec<Expr<'_>> {
        let search = self.search(id);
        let number = |number: usize| u8::try_from(number).unwrap_or(u8::MAX);
        let start = (0..search.numbers()).map(|index| self.symbol(Symbol::Start(id, number(index))));
        // All searches leave from the same pose: a drive's place there has one symbol, of the first search that reads it.
        let all = self.searches();
        let from = search.drives.iter().filter_map(|drive| {
            all.iter().find_map(|(first, other)| {
                let index = other.drives.iter().position(|own| own == drive)?;
                Some(self.symbol(Symbol::Start(*first, number(other.numbers() + index))))
            })
        });
        let to = search.drives.iter().map(|drive| self.symbol(Symbol::Drive(*drive)));
        let others = search.reach.iter().chain(&search.given).chain(&search.known).map(|node| self.expr(*node));
        let args: Vec<Expr<'_>> = start.chain(from).chain(to).chain(others).collect();
        self.search_from(id, &args)
    }

    /// What a search finds with other arguments.
    pub fn search_from<'g>(&'g self, id: SearchId, args: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let parts = 1 + u8::try_from(self.search(id).numbers()).unwrap_or(u8::MAX);
        let kernel = Kernel::Search { search: id, parts };
        let values: Option<Vec<Number>> = args.iter().map(|arg| arg.value()).collect();
        match values {
            Some(values) => {
                self.searched(id, &values).iter().map(|value| self.constant(&without_rounding(value))).collect()
            }
            None => (0..parts).map(|part| self.kernel(kernel, args, part)).collect(),
        }
    }

    /// Whether an expression reads a symbol of a search.
    #[must_use]
    pub fn depends_on(&self, expression: Expr<'_>, symbol: Symbol) -> bool {
        let (mut open, mut seen) = (vec![expression.id()], BTreeSet::new());
        while let Some(node) = open.pop() {
            if self.stage(node) == Stage::Iterated && seen.insert(node) {
                match self.op(node) {
                    Op::Symbol(own) if own == symbol => return true,
                    op => open.extend(op.operands()),
                }
            }
        }
        false
    }

    /// The drives and all else from which some expressions are worked out.
    fn note_given(&self, results: &[NodeId], search: &mut Search) {
        let mut open: Vec<NodeId> = results.iter().rev().copied().collect();
        let mut seen = BTreeSet::new();
        while let Some(node) = open.pop() {
            if !seen.insert(node) {
                continue;
            }
            match (self.stage(node), self.op(node)) {
                (Stage::Constant, _) => {}
                (_, Op::Symbol(Symbol::Drive(drive))) => search.drives.push(drive),
                (Stage::Prepared, op) if !matches!(op, Op::Neg(_)) => search.given.push(node),
                (_, Op::Symbol(_)) => search.given.push(node),
                (_, op) => {
                    open.extend(op.operands().into_iter().rev());
                    if let Op::Checked { guard, .. } = op {
                        let guard = self.guard(guard);
                        open.extend(guard.condition.operands());
                        open.extend(guard.failure.operand());
                    }
                }
            }
        }
        search.drives.sort_unstable();
    }

    /// What changes on the way of a search, with the drives at some place; `None` where the links before the group have no pose.
    fn on_the_way<T: Real>(&self, search: &Search, drives: &[T], given: &[T]) -> Option<Vec<T>> {
        let mut done: NodeValues<T> = search.given.iter().copied().zip(given.iter().cloned()).collect();
        let symbol = |symbol: Symbol| match symbol {
            Symbol::Drive(drive) => {
                let index = search.drives.iter().position(|own| *own == drive);
                index.and_then(|index| drives.get(index).cloned()).unwrap_or_else(T::zero)
            }
            _ => T::zero(),
        };
        let mut open: Vec<NodeId> = search.known[..search.changing].to_vec();
        let mut seen = BTreeSet::new();
        while let Some(node) = open.pop() {
            if !seen.insert(node) || search.given.contains(&node) {
                continue;
            }
            let op = self.op(node);
            open.extend(op.operands());
            if let Op::Checked { guard, .. } = op {
                let condition = self.guard(guard).condition;
                let [value, limit] = condition.operands().map(|side| self.evaluate(side, &symbol, &mut done));
                if !condition.holds(&value, &limit) {
                    return None;
                }
                open.extend(condition.operands());
            }
        }
        Some(search.known[..search.changing].iter().map(|node| self.evaluate(*node, &symbol, &mut done)).collect())
    }

    /// The largest parts of expressions that do not depend on a search's unknowns; constants are written where they stand.
    fn note_known(&self, results: &[NodeId], known: &mut Vec<NodeId>) {
        let mut open: Vec<NodeId> = results.iter().rev().copied().collect();
        let mut seen = BTreeSet::new();
        while let Some(node) = open.pop() {
            if !seen.insert(node) {
                continue;
            }
            match (self.stage(node), self.op(node)) {
                (Stage::Constant, _) => {}
                (Stage::Iterated, op) => open.extend(op.operands().into_iter().rev()),
                (_, super::Op::Neg(inner)) => open.push(inner),
                _ => known.push(node),
            }
        }
    }

    /// The constants in a search's equations, which are the same at every step.
    fn constants<T: Real>(&self, search: &Search) -> NodeValues<T> {
        let mut open = search.results();
        let mut seen: BTreeSet<NodeId> = search.known.iter().copied().collect();
        let mut constants = NodeValues::default();
        while let Some(node) = open.pop() {
            if seen.insert(node) {
                match self.op(node) {
                    Op::Constant(number) => drop(constants.insert(node, T::from_number(&self.number(number)))),
                    op => open.extend(op.operands()),
                }
            }
        }
        constants
    }

    /// The results of a search.
    pub(super) fn searched<T: Real>(&self, id: SearchId, args: &[T]) -> Vec<T> {
        let search = self.search(id);
        let Arguments { start, from, to, reach, given, known } = search.arguments(args);
        let constants = self.constants(&search);
        let mut newton = Newton::new(&search, self.scalar(), start, [from, to, reach]);
        while let Some(between) = newton.way() {
            let known = match between {
                None => Some(known.to_vec()),
                Some(drives) => self.on_the_way(&search, &drives, given).map(|mut changing| {
                    changing.extend_from_slice(&known[search.changing..]);
                    changing
                }),
            };
            let Some(known) = known else { continue };
            let mut known: NodeValues<T> = search.known.iter().copied().zip(known).collect();
            known.extend(constants.clone());
            while let Some(places) = newton.places() {
                let symbol = |symbol: Symbol| match symbol {
                    Symbol::Sought(_, number) => places[usize::from(number)].clone(),
                    _ => T::zero(),
                };
                let mut done = known.clone();
                let mut value = |node: &NodeId| self.evaluate(*node, &symbol, &mut done);
                let residuals: Vec<T> = search.residuals.iter().map(&mut value).collect();
                let jacobian: Vec<Vec<T>> =
                    search.jacobian.iter().map(|row| row.iter().map(&mut value).collect()).collect();
                let rounding = value(&search.rounding);
                let scales = search.sought.iter().filter_map(|sought| match sought {
                    Sought::Direction { .. } => None,
                    Sought::Travel { scale, .. } => Some(value(scale)),
                });
                let scales = scales.collect();
                newton.evaluated(&residuals, &jacobian, rounding, scales);
            }
        }
        newton.found()
    }
}

/// Zero for what is only rounding in a number that a search has found in 256 bits: a direction along an axis has a component of this size,
/// which no scalar need hold.
fn without_rounding(found: &Number) -> Number {
    if found.is_zero() || found.binary_exponent() > -200 { found.clone() } else { Number::zero() }
}

/// The direction of an unknown in the symbols of its search.
#[must_use]
pub fn sought_direction(graph: &Graph, search: SearchId, first: u8) -> Vector<'_> {
    Vector::new(graph.symbol(Symbol::Sought(search, first)), graph.symbol(Symbol::Sought(search, first + 1)))
}

/// Newton's method along the motion of the drives, as `Search` of the run-time crate.
struct Newton<T> {
    from: Vec<T>,
    to: Vec<T>,
    length: T,
    behind: T,
    stride: T,
    ahead: T,
    mode: Mode,
    strides: u32,
    directions: usize,
    closed: Vec<T>,
    best: Vec<T>,
    next: Vec<T>,
    scales: Vec<T>,
    step: Vec<T>,
    first: Size<T>,
    second: Size<T>,
    last: Size<T>,
    /// `None` before the first evaluation.
    open: Option<T>,
    begin: T,
    rounding: T,
    /// `None` before it is known.
    sense: Option<T>,
    evaluations: u32,
    arrived: bool,
    short: T,
    tiny: T,
}

/// The length of a step; `None` where there is no step.
type Size<T> = Option<T>;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    Begins,
    Closes,
    Walks,
    GivesUp,
}

const STRIDES: u32 = 1024;
const EVALUATIONS: u32 = 40;

fn power<T: Real>(exponent: i32) -> T {
    T::from_number(&Number::power_of_two(exponent))
}

/// Whether a length is at most so much; one that is no number is not.
fn within<T: Real>(size: Option<&T>, most: &T) -> bool {
    size.is_some_and(|size| most.at_least(size))
}

impl<T: Real> Newton<T> {
    fn new(search: &Search, scalar: Scalar, start: &[T], [from, to, reach]: [&[T]; 3]) -> Self {
        let ways = from.iter().zip(to).zip(reach);
        let length = ways.fold(T::zero(), |sum, ((a, b), reach)| sum.add(&b.sub(a).abs().div(reach)));
        let one = power::<T>(0);
        let stride = if length.above(&one) { one.div(&length) } else { one };
        let strides = if length.above(&power(10)) { 0 } else { STRIDES };
        let (short, tiny) = match scalar {
            Scalar::F64 => (power(-26), power(-1022)),
            Scalar::F32 => (power(-11), power(-126)),
        };
        Self {
            from: from.to_vec(),
            to: to.to_vec(),
            length,
            behind: T::zero(),
            stride,
            ahead: T::zero(),
            mode: Mode::Begins,
            strides,
            directions: search.directions(),
            closed: start.to_vec(),
            best: start.to_vec(),
            next: start.to_vec(),
            scales: vec![T::zero(); search.sought.len() - search.directions()],
            step: vec![T::zero(); search.sought.len()],
            first: None,
            second: None,
            last: None,
            open: None,
            begin: T::zero(),
            rounding: T::zero(),
            sense: None,
            evaluations: 0,
            arrived: false,
            short,
            tiny,
        }
    }

    /// Where the drives are, if not where they are wanted.
    #[allow(clippy::option_option, reason = "the end, the wanted place, a place between")]
    fn way(&mut self) -> Option<Option<Vec<T>>> {
        let one = power::<T>(0);
        match self.mode {
            Mode::Begins => self.mode = if self.length.above(&T::zero()) { Mode::Walks } else { Mode::Closes },
            Mode::Walks if !self.arrived => {
                self.stride = self.stride.mul(&power(-1));
                // A sense that was seen too far from the start need not be that of the start.
                if T::zero().at_least(&self.behind) {
                    self.sense = None;
                }
            }
            Mode::Walks if one.above(&self.ahead) => {
                (self.closed, self.behind) = (self.best.clone(), self.ahead.clone());
                let easy =
                    self.first.as_ref().is_some_and(|first| within(self.second.as_ref(), &power::<T>(-4).mul(first)));
                if easy {
                    self.stride = self.stride.mul(&power(1));
                }
                if self.stride.mul(&self.length).above(&one) {
                    self.stride = one.div(&self.length);
                }
            }
            Mode::Walks | Mode::Closes | Mode::GivesUp => return None,
        }
        self.ahead = self.behind.add(&self.stride);
        // Numbers of many bits tell apart what no scalar does: for them a stride is lost where it is 2⁻⁶⁴ of the way behind.
        let lost = self.behind.at_least(&self.ahead) || self.behind.mul(&power(-64)).at_least(&self.stride);
        if self.mode == Mode::Walks && (self.strides == 0 || lost) {
            self.mode = Mode::GivesUp;
        }
        self.strides = self.strides.wrapping_sub(1);
        self.best = self.closed.clone();
        self.step = vec![T::zero(); self.step.len()];
        (self.open, self.arrived, self.evaluations) = (None, false, EVALUATIONS);
        if self.mode != Mode::Walks || self.ahead.at_least(&one) {
            self.ahead = one;
            return Some(None);
        }
        let at = self.from.iter().zip(&self.to).map(|(a, b)| a.add(&self.ahead.mul(&b.sub(a))));
        Some(Some(at.collect()))
    }

    fn places(&mut self) -> Option<Vec<T>> {
        self.evaluations = self.evaluations.checked_sub(1)?;
        let (directions, travels) = self.best.split_at(2 * self.directions);
        let (turns, slides) = self.step.split_at(self.directions);
        let mut next: Vec<T> = Vec::new();
        for (direction, step) in directions.chunks(2).zip(turns) {
            let (cos, sin) = (&direction[0], &direction[1]);
            let (cos, sin) = cos.sub(&step.mul(sin)).unit(&sin.add(&step.mul(cos)));
            next.extend([cos, sin]);
        }
        let moved = |((travel, scale), step): ((&T, &T), &T)| travel.add(&step.mul(scale));
        next.extend(travels.iter().zip(&self.scales).zip(slides).map(moved));
        self.next.clone_from(&next);
        Some(next)
    }

    fn evaluated(&mut self, residuals: &[T], jacobian: &[Vec<T>], rounding: T, scales: Vec<T>) {
        let open = residuals.iter().fold(T::zero(), |sum, r| sum.add(&r.abs()));
        let sizes: Vec<Vec<T>> = jacobian.iter().map(|row| row.iter().map(Real::abs).collect()).collect();
        let factors = Factors::of(jacobian, &sizes);
        let solution = factors.as_ref().map(|factors| factors.solve(residuals));
        let sense = factors.map(|factors| factors.distance());
        let longest: Size<T> = solution.as_ref().and_then(|solution| {
            let longest = solution.iter().fold(T::zero(), |m, s| if m.at_least(&s.abs()) { m } else { s.abs() });
            // What is no number is at least nothing.
            solution.iter().all(|s| longest.at_least(&s.abs())).then_some(longest)
        });
        let (begins, walks) = (self.open.is_none(), self.mode == Mode::Walks);
        if begins {
            (self.begin, self.first) = (open.clone(), longest.clone());
            if !walks || self.sense.is_none() {
                self.sense.clone_from(&sense);
            }
        } else if self.evaluations + 2 == EVALUATIONS {
            self.second.clone_from(&longest);
        }
        let same_sense = sense.zip(self.sense.clone()).is_some_and(|(now, then)| now.mul(&then).above(&T::zero()));
        let gains = self.open.as_ref().is_none_or(|least| least.above(&open) && same_sense);
        if gains {
            let most = match &self.last {
                Some(last) if !begins => Some(power::<T>(-2).mul(last)),
                _ if begins => Some(power(-1)),
                _ => None,
            };
            let closes = rounding.at_least(&open);
            let contracts = most.is_some_and(|most| within(longest.as_ref(), &most))
                || within(longest.as_ref(), &self.short)
                || closes;
            self.best.clone_from(&self.next);
            (self.open, self.rounding, self.scales) = (Some(open), rounding, scales);
            self.last.clone_from(&longest);
            let bound = power::<T>(-1);
            let factor = match &longest {
                Some(longest) if longest.above(&bound) => bound.div(longest),
                _ => power(0),
            };
            let factor = factor.neg();
            match solution {
                Some(solution) => self.step = solution.iter().map(|s| s.mul(&factor)).collect(),
                // Nowhere to go from a singular place.
                None => self.evaluations = 0,
            }
            if walks && !(same_sense && contracts) {
                self.evaluations = 0;
                return;
            }
            self.arrived = closes;
            let one = power::<T>(0);
            let near = self.first.as_ref().is_some_and(|first| within(longest.as_ref(), &power::<T>(-4).mul(first)));
            if walks && one.above(&self.ahead) && near {
                (self.arrived, self.evaluations) = (true, 0);
            }
            return;
        }
        if self.arrived || walks && !within(self.last.as_ref(), &self.short) {
            self.evaluations = 0;
        }
        self.step = self.step.iter().map(|s| s.mul(&power(-1))).collect();
    }

    fn found(&self) -> Vec<T> {
        let closes = self.open.as_ref().is_some_and(|open| self.rounding.at_least(open));
        let open = match (&self.open, closes) {
            (_, true) if self.mode == Mode::GivesUp && self.begin.above(&self.rounding) => self.begin.clone(),
            (_, true) if self.mode == Mode::GivesUp => self.rounding.add(&self.tiny),
            (Some(open), false) => open.clone(),
            _ => T::zero(),
        };
        core::iter::once(open).chain(self.best.iter().cloned()).collect()
    }
}
