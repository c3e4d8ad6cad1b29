//! Groups that are placed by Newton's method, and linear equations of any number: the arithmetic of the run-time crate, operation by
//! operation, for any number type.

use std::collections::HashMap;

use super::number::Number;
use super::real::Real;
use super::{Expr, Graph, Kernel, NodeId, Stage, Symbol, Vector};

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
    /// The unknowns.
    pub sought: Vec<Sought>,
    /// Where it starts unless it goes on from another pose: a value for each number of the unknowns.
    pub start: Vec<NodeId>,
    /// What is zero when the group is closed.
    pub residuals: Vec<NodeId>,
    /// For each residual its change with each unknown: with a turn, or with a travel by its scale.
    pub jacobian: Vec<Vec<NodeId>>,
    /// What rounding may leave open of all residuals together.
    pub rounding: NodeId,
    /// What the residuals read beside the unknowns.
    pub known: Vec<NodeId>,
}

impl Search {
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

    /// What a search finds: how much stays open, and its unknowns. What the residuals read is noted in it.
    pub fn found(&self, mut search: Search) -> Vec<Expr<'_>> {
        let id = self.next_search();
        let results = search.results();
        self.note_known(&results, &mut search.known);
        let number = |number: usize| u8::try_from(number).unwrap_or(u8::MAX);
        let start = (0..search.start.len()).map(|index| self.symbol(Symbol::Start(id, number(index))));
        let args: Vec<Expr<'_>> = start.chain(search.known.iter().map(|node| self.expr(*node))).collect();
        let parts = 1 + number(search.start.len());
        self.arena.borrow_mut().searches.push(search);
        (0..parts).map(|part| self.kernel(Kernel::Search { search: id, parts }, &args, part)).collect()
    }

    /// The largest parts of expressions that do not depend on a search's unknowns; constants are written where they stand.
    fn note_known(&self, results: &[NodeId], known: &mut Vec<NodeId>) {
        let mut open: Vec<NodeId> = results.iter().rev().copied().collect();
        let mut seen = std::collections::BTreeSet::new();
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

    /// The solution of linear equations, and their distance from singular ones: the smallest pivot over its size.
    pub fn solved_any<'g>(&'g self, equations: &[(Vec<Expr<'g>>, Expr<'g>)]) -> (Vec<Expr<'g>>, Expr<'g>) {
        let rows = equations.iter().map(|(row, _)| row);
        let mut args: Vec<Expr<'g>> = rows.clone().flatten().copied().collect();
        args.extend(rows.flatten().map(|coefficient| coefficient.magnitude()));
        args.extend(equations.iter().map(|(_, right)| *right));
        let size = u8::try_from(equations.len()).unwrap_or(u8::MAX);
        let part = |part| self.kernel(Kernel::Solve(size), &args, part);
        ((0..size).map(part).collect(), part(size))
    }

    /// The results of a search from a start with given values.
    pub(super) fn searched<T: Real>(&self, id: SearchId, args: &[T]) -> Vec<T> {
        let search = self.search(id);
        let count = search.sought.len();
        let (start, known) = args.split_at(search.start.len());
        let given: HashMap<NodeId, T> = search.known.iter().copied().zip(known.iter().cloned()).collect();
        let scales: Vec<Option<T>> = search
            .sought
            .iter()
            .map(|sought| match sought {
                Sought::Direction { .. } => None,
                Sought::Travel { scale, .. } => Some(self.evaluate(*scale, &|_| zero(), &mut given.clone())),
            })
            .collect();
        let mut newton: Newton<T> = Newton::new(count);
        let mut best: Vec<T> = start.to_vec();
        while let Some(steps) = newton.step() {
            let mut next: Vec<T> = Vec::new();
            for (step, scale) in steps.iter().zip(&scales) {
                match (scale, &best[next.len()..]) {
                    (Some(scale), [travel, ..]) => next.push(travel.add(&step.mul(scale))),
                    (None, [cos, sin, ..]) => {
                        let (cos, sin) = cos.sub(&step.mul(sin)).unit(&sin.add(&step.mul(cos)));
                        next.extend([cos, sin]);
                    }
                    _ => {}
                }
            }
            let symbol = |symbol: Symbol| match symbol {
                Symbol::Sought(_, number) => next[usize::from(number)].clone(),
                _ => zero(),
            };
            let mut done = given.clone();
            let mut value = |node: &NodeId| self.evaluate(*node, &symbol, &mut done);
            let residuals: Vec<T> = search.residuals.iter().map(&mut value).collect();
            let jacobian: Vec<Vec<T>> =
                search.jacobian.iter().map(|row| row.iter().map(&mut value).collect()).collect();
            let rounding = value(&search.rounding);
            if newton.improves(&residuals, &jacobian, rounding) {
                best = next;
            }
        }
        core::iter::once(newton.open()).chain(best).collect()
    }
}

/// The direction of an unknown in the symbols of its search.
#[must_use]
pub fn sought_direction(graph: &Graph, search: SearchId, first: u8) -> Vector<'_> {
    Vector::new(graph.symbol(Symbol::Sought(search, first)), graph.symbol(Symbol::Sought(search, first + 1)))
}

fn zero<T: Real>() -> T {
    T::from_number(&Number::zero())
}

struct Line<T> {
    coefficients: Vec<T>,
    sizes: Vec<T>,
    right: T,
    scale: T,
}

impl<T: Real> Line<T> {
    fn weight(&self) -> Option<T> {
        // Zero over zero is no weight.
        self.scale.above(&zero()).then(|| self.coefficients[0].abs().div(&self.scale))
    }

    fn reduce(&mut self, pivot: &Self) {
        let factor = self.coefficients[0].div(&pivot.coefficients[0]);
        let less = |(own, other): (&T, &T)| own.sub(&factor.mul(other));
        self.coefficients = self.coefficients.iter().zip(&pivot.coefficients).skip(1).map(less).collect();
        let size = factor.abs();
        let more = |(own, other): (&T, &T)| own.add(&size.mul(other));
        self.sizes = self.sizes.iter().zip(&pivot.sizes).skip(1).map(more).collect();
        self.right = self.right.sub(&factor.mul(&pivot.right));
    }
}

/// The solution of linear equations, and the smallest pivot over its size with the sign of the determinant. `None` where a pivot is
/// zero: by scalars that would give what is not a number.
pub(super) fn solve<T: Real>(matrix: &[Vec<T>], sizes: &[Vec<T>], right: &[T]) -> Option<(Vec<T>, T)> {
    let line = |((coefficients, sizes), right): ((&Vec<T>, &Vec<T>), &T)| {
        let scale = coefficients.iter().fold(zero::<T>(), |m, c| if c.abs().above(&m) { c.abs() } else { m });
        Line { coefficients: coefficients.clone(), sizes: sizes.clone(), right: right.clone(), scale }
    };
    let mut lines: Vec<Line<T>> = matrix.iter().zip(sizes).zip(right).map(line).collect();
    let (mut least, mut negative): (Option<T>, bool) = (None, false);
    for step in 0..lines.len() {
        let (done, others) = lines.split_at_mut(step + 1);
        let pivot = &mut done[step];
        for line in others.iter_mut() {
            if let (Some(own), Some(best)) = (line.weight(), pivot.weight())
                && own.above(&best)
            {
                core::mem::swap(line, pivot);
                negative = !negative;
            }
        }
        let value = pivot.coefficients[0].clone();
        if zero::<T>().above(&value) {
            negative = !negative;
        }
        if !value.abs().above(&zero()) {
            return None;
        }
        let distance = value.abs().div(&pivot.sizes[0]);
        least = match least {
            Some(least) if distance.at_least(&least) => Some(least),
            _ => Some(distance),
        };
        for line in others {
            line.reduce(pivot);
        }
    }
    let mut solution: Vec<T> = Vec::new();
    for line in lines.iter().rev() {
        let behind = line.coefficients[1..].iter().zip(&solution);
        let sum = behind.fold(line.right.clone(), |sum, (coefficient, value)| sum.sub(&coefficient.mul(value)));
        solution.insert(0, sum.div(&line.coefficients[0]));
    }
    let least = least?;
    Some((solution, if negative { least.neg() } else { least }))
}

/// Newton's method with bounded steps, as `Search` of the run-time crate.
struct Newton<T> {
    step: Vec<T>,
    /// `None` before the first evaluation.
    open: Option<T>,
    rounding: T,
    sense: Option<T>,
    left: u32,
}

impl<T: Real> Newton<T> {
    fn new(count: usize) -> Self {
        Self { step: vec![zero(); count], open: None, rounding: zero(), sense: None, left: 40 }
    }

    fn step(&mut self) -> Option<Vec<T>> {
        self.left = self.left.checked_sub(1)?;
        Some(self.step.clone())
    }

    fn improves(&mut self, residuals: &[T], jacobian: &[Vec<T>], rounding: T) -> bool {
        let half = T::from_number(&Number::power_of_two(-1));
        let open = residuals.iter().fold(zero::<T>(), |sum, r| sum.add(&r.abs()));
        let sizes: Vec<Vec<T>> = jacobian.iter().map(|row| row.iter().map(Real::abs).collect()).collect();
        let solved = solve(jacobian, &sizes, residuals);
        let sense = solved.as_ref().map(|(_, sense)| sense.clone());
        let better = match (&self.open, &self.sense, &sense) {
            (None, ..) => true,
            (Some(least), Some(first), Some(sense)) => least.above(&open) && sense.mul(first).above(&zero()),
            _ => false,
        };
        if better {
            if self.open.is_none() {
                self.sense = sense;
            }
            (self.open, self.rounding) = (Some(open), rounding);
            let Some((solution, _)) = solved else {
                // Nowhere to go from a singular start.
                self.left = 0;
                return true;
            };
            let longest = solution.iter().fold(half.clone(), |m, s| if s.abs().above(&m) { s.abs() } else { m });
            let factor = half.div(&longest).neg();
            self.step = solution.iter().map(|s| s.mul(&factor)).collect();
            return true;
        }
        if self.open.as_ref().is_some_and(|open| self.rounding.at_least(open)) {
            self.left = 0;
        }
        self.step = self.step.iter().map(|s| s.mul(&half)).collect();
        false
    }

    fn open(&self) -> T {
        match &self.open {
            Some(open) if !self.rounding.at_least(open) => open.clone(),
            _ => zero(),
        }
    }
}
