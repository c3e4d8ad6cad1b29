//! Running error analysis (Wilkinson 1963; Higham, *Accuracy and Stability of Numerical Algorithms*, § 3.3) in affine forms (Comba, Stolfi
//! 1993; de Figueiredo, Stolfi, *Self-Validated Numerical Methods and Applications*, 1997): beside every value what is known of how far
//! rounding has taken it from what exact arithmetic would give.
//!
//! The error of a closure is in all that is placed or loaded through it, and much of it cancels where these meet. So the deviation of a
//! computed value x from the exact one is kept as
//!
//! ```text
//! Σ xⱼ sⱼ + r     |sⱼ| ≤ 1, |r| ≤ R(x)     E(x) = Σ |xⱼ| + R(x)
//! ```
//!
//! with the same numbers sⱼ, one for each source of errors, for all values: of them nothing is known but their bounds. The shares xⱼ have
//! signs, and pass through operations as derivatives do. What is not linear in the deviations, the rounding of each operation, and whatever
//! has no source goes to the rest R. With `u` half the distance from 1 to the next number:
//!
//! ```text
//! a ± b   aⱼ ± bⱼ             R(a) + R(b) + u|a ± b|
//! a b     a bⱼ + b aⱼ         |a| R(b) + |b| R(a) + E(a) E(b) + u|a b|
//! q = a/b (aⱼ − q bⱼ)/b       (R(a) + |q| R(b))/|b| + E(a − q b)/|b| · E(b)/(|b| − E(b)) + 2u|q|
//! q = √a  aⱼ/(2q)             R(a)/(2q) + q t²/2 + u q, t = E(a)/a
//! ```
//!
//! The deviations of the two components of a direction are those of its angle, `δ`, which has shares too, and of its size, `ν`. So a sum
//! of products with them (a projection, a moment, a turned vector) has
//!
//! ```text
//! x a + y b   (x b − y a) δⱼ + x aⱼ + y bⱼ
//!             |x b − y a| R(δ) + |x a + y b| ν + |x| R(a) + |y| R(b) + E(δ)² (|a| + |b|) + E(δ) (E(a) + E(b))
//!               + u(|x a| + |y b| + |x a + y b|)
//! ```
//!
//! The solution of linear equations is known by what it leaves open of them (see `solutions`).
//!
//! A quotient counts twice, because it may become a product with a reciprocal. What is given (drives, parameters, loads) is exact; constants
//! are rounded once, by what is known when compiled. Shares and bounds are rounded as well: what all of them lack is of second order, and
//! made up for where a result takes its bound.

mod solutions;

use std::collections::{BTreeMap, HashSet};

use rustc_hash::FxHashMap;

use super::elimination::Equation;
use super::number::Number;
use super::{Expr, Graph, Kernel, NodeId, Op, Vector};

pub(crate) use solutions::Inverse;

/// A source of errors that many values share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source(usize);

/// How far a value may be off: by its shares of the sources' errors, and by a rest.
#[derive(Clone, Debug)]
pub struct Deviation<'g> {
    /// With their signs.
    shares: BTreeMap<Source, Expr<'g>>,
    /// The bound of the rest.
    pub rest: Expr<'g>,
}

impl<'g> Deviation<'g> {
    /// No more than this, whatever it comes from.
    #[must_use]
    pub fn within(rest: Expr<'g>) -> Self {
        Self { shares: BTreeMap::new(), rest }
    }

    /// A share of one source.
    #[must_use]
    pub fn of(source: Source, share: Expr<'g>) -> Self {
        let rest = share.graph().zero();
        Self { shares: BTreeMap::from([(source, share)]), rest }
    }

    /// Whether the value is exact.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.shares.is_empty() && self.rest.is_zero()
    }

    /// The bound of all of it.
    #[must_use]
    pub fn total(&self) -> Expr<'g> {
        self.shares.values().fold(self.rest, |sum, share| sum + share.abs())
    }

    /// That of a multiple of the value.
    #[must_use]
    pub fn scaled(&self, factor: Expr<'g>) -> Self {
        let rest = if self.rest.is_zero() { self.rest } else { factor.abs() * self.rest };
        self.each(|share| factor * share, rest)
    }

    /// That of a sum, before it is rounded.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        for (source, share) in &other.shares {
            let sum = self.shares.get(source).map_or(*share, |own| *own + *share);
            self.shares.insert(*source, sum);
        }
        self.shares.retain(|_, share| !share.is_zero());
        Self { rest: self.rest + other.rest, ..self }
    }

    /// That of the opposite.
    #[must_use]
    pub fn opposite(&self) -> Self {
        self.each(|share| -share, self.rest)
    }

    /// Its shares alone.
    #[must_use]
    pub fn shared(&self) -> Self {
        Self { rest: self.rest.graph().zero(), ..self.clone() }
    }

    /// The same with the rest as a share of a source of its own.
    #[must_use]
    pub fn from(self, source: Source) -> Self {
        let zero = self.rest.graph().zero();
        let rest = Self::of(source, self.rest);
        Self { rest: zero, ..self }.plus(&rest)
    }

    /// With so much more of a rest.
    #[must_use]
    pub fn and(self, rest: Expr<'g>) -> Self {
        Self { rest: self.rest + rest, ..self }
    }

    /// The shares of two deviations, taken together; what is zero by structure is zero.
    pub fn shares_of(x: &Self, y: &Self, of: impl Fn(Expr<'g>, Expr<'g>) -> Expr<'g>) -> Self {
        let zero = x.rest.graph().zero();
        let part = |deviation: &Self, source: &Source| deviation.shares.get(source).copied().unwrap_or(zero);
        let sources = x.shares.keys().chain(y.shares.keys());
        let shares: BTreeMap<Source, Expr<'g>> =
            sources.map(|source| (*source, of(part(x, source), part(y, source)))).collect();
        Self { shares: shares.into_iter().filter(|(_, share)| !share.is_zero()).collect(), rest: zero }
    }

    fn each(&self, share: impl Fn(Expr<'g>) -> Expr<'g>, rest: Expr<'g>) -> Self {
        let shares = self.shares.iter().map(|(source, own)| (*source, share(*own)));
        Self { shares: shares.filter(|(_, share)| !share.is_zero()).collect(), rest }
    }
}

/// A direction, how far its angle may be off, and a bound of how far its size is.
#[derive(Clone, Debug)]
struct Direction<'g> {
    unit: Vector<'g>,
    turn: Deviation<'g>,
    stretch: Expr<'g>,
}

/// What a bound of a kept value is a bound of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundOf {
    /// The value.
    Value,
    /// The angle of the direction whose first component it is.
    Angle,
    /// The size of that direction.
    Size,
}

/// A share or a bound that a pose keeps.
#[derive(Clone, Copy, Debug)]
pub struct HeldBound<'g> {
    /// The kept value.
    pub value: NodeId,
    /// What of it is off.
    pub what: BoundOf,
    /// Whose error it has a share of; nothing if it is the bound of the rest.
    pub source: Option<Source>,
    /// The share or the bound.
    pub bound: Expr<'g>,
}

/// Deviations of nodes.
#[derive(Debug)]
pub struct Rounding<'g> {
    graph: &'g Graph,
    done: FxHashMap<NodeId, Deviation<'g>>,
    /// Directions, by either component.
    directions: FxHashMap<NodeId, Direction<'g>>,
    /// Which values are directions.
    pairs: FxHashMap<NodeId, Vector<'g>>,
    /// Those of which the deviation is being found.
    open: HashSet<NodeId>,
    /// What has been found since, where some values are supposed to be exact.
    supposed: Option<Vec<NodeId>>,
    /// The names of the sources.
    sources: Vec<String>,
    /// Solutions of linear equations that are known better than their operations tell, and which of them a value belongs to.
    solutions: Vec<(Vec<Equation<'g>>, Vec<Expr<'g>>)>,
    solved: FxHashMap<NodeId, usize>,
    /// What belongs to values that a pose keeps; it is kept beside them.
    pub held: Vec<HeldBound<'g>>,
}

impl<'g> Rounding<'g> {
    /// Nothing bounded yet.
    #[must_use]
    pub fn new(graph: &'g Graph) -> Self {
        graph.count_rounding();
        let solutions = graph.noted_solutions();
        // What is there before all numbers of the equations did not come from them, and may be one of them.
        let of = |(index, (equations, values)): (usize, &(Vec<Equation<'g>>, Vec<Expr<'g>>))| {
            let numbers = equations.iter().flat_map(|equation| equation.coefficients.iter().chain([&equation.right]));
            let last = numbers.map(|number| number.id()).max();
            // Nor did one that is known when compiled: it is rounded once.
            let unknown = values.iter().filter(|value| value.value().is_none() && Some(value.id()) > last);
            unknown.map(|value| (value.id(), index)).collect::<Vec<_>>()
        };
        let solved = solutions.iter().enumerate().flat_map(of).collect();
        Self {
            graph,
            done: FxHashMap::default(),
            directions: FxHashMap::default(),
            pairs: FxHashMap::default(),
            open: HashSet::new(),
            supposed: None,
            sources: Vec::new(),
            solutions,
            solved,
            held: Vec::new(),
        }
    }

    /// A new source of errors.
    pub fn source(&mut self, name: &str) -> Source {
        self.sources.push(name.to_owned());
        Source(self.sources.len() - 1)
    }

    /// What a source is called.
    #[must_use]
    pub fn name_of(&self, source: Source) -> &str {
        &self.sources[source.0]
    }

    /// Says that two values are a direction.
    pub fn is_direction(&mut self, unit: Vector<'g>) {
        self.pairs.extend([unit.x, unit.y].map(|part| (part.id(), unit)));
    }

    /// States the deviation of a direction's angle and the bound of that of its size.
    pub fn state_direction(&mut self, unit: Vector<'g>, turn: Deviation<'g>, stretch: Expr<'g>) {
        let total = turn.total();
        for (part, turned) in [(unit.x, -unit.y), (unit.y, unit.x)] {
            let deviation = turn.scaled(turned).and(part.abs() * stretch + total * total);
            self.found(part.id(), deviation);
        }
        let found = Direction { unit, turn, stretch };
        for part in [unit.x, unit.y] {
            self.directions.insert(part.id(), found.clone());
        }
    }

    /// How far a computed direction is from unit size, `(u·u − 1)/2`, to half an epsilon: two roundings of what is about 1, halved.
    #[must_use]
    pub fn strain(&self, unit: Vector<'g>) -> Expr<'g> {
        let half = self.graph.constant(&Number::ratio(1, 2));
        half * (unit.squared() - self.graph.one())
    }

    /// The bound of that.
    #[must_use]
    pub fn stretch(&self, unit: Vector<'g>) -> Expr<'g> {
        self.strain(unit).abs() + self.of_strain()
    }

    /// The bound of how far the strain of a direction is off itself.
    #[must_use]
    pub fn of_strain(&self) -> Expr<'g> {
        let half = self.graph.constant(&Number::ratio(1, 2));
        half * self.graph.epsilons(1)
    }

    /// What is known of a direction that a value is a component of.
    fn direction_of(&mut self, part: NodeId) -> Option<Direction<'g>> {
        if let Some(found) = self.directions.get(&part) {
            return Some(found.clone());
        }
        if let Op::Held(inner) = self.graph.op(part) {
            let Direction { unit, turn, stretch } = self.direction_of(inner)?;
            let unit = unit.held();
            let value = unit.x.id();
            let turn = self.keep(value, BoundOf::Angle, &turn);
            let stretch = self.keep(value, BoundOf::Size, &Deviation::within(stretch)).rest;
            self.state_direction(unit, turn, stretch);
        } else {
            let unit = *self.pairs.get(&part)?;
            // Its components are as far off as their operations tell, also where one is computed from the other.
            if !self.open.insert(unit.x.id()) {
                return None;
            }
            let turn = self.turn_by_operations(unit);
            self.open.remove(&unit.x.id());
            self.state_direction(unit, turn, self.stretch(unit));
        }
        self.directions.get(&part).cloned()
    }

    /// The deviation of a kept value, as a pose keeps it.
    fn keep(&mut self, value: NodeId, what: BoundOf, deviation: &Deviation<'g>) -> Deviation<'g> {
        let mut kept = |source: Option<Source>, own: Expr<'g>| {
            let bound = own.held();
            let known = self.held.iter().any(|held| (held.value, held.what, held.source) == (value, what, source));
            if matches!(bound.op(), Op::Held(_)) && !known {
                self.held.push(HeldBound { value, what, source, bound });
            }
            bound
        };
        let shares = deviation.shares.iter().map(|(source, share)| (*source, kept(Some(*source), *share))).collect();
        Deviation { shares, rest: kept(None, deviation.rest) }
    }

    /// The bound of a result's error: that of its value, and a little more for the rounding of the bound itself. Where nothing can be
    /// said, because something was divided by what may be zero, it is the largest number.
    pub fn bound(&mut self, of: Expr<'g>) -> Expr<'g> {
        let graph = self.graph;
        let error = self.deviation(of.id()).total();
        // More than thousands of operations on bounds can lose, and more than what signs may cancel in the shares: of a share's roundings
        // each is 2u of an error, where the value's own are u of the value.
        let generous = Number::one().add(&Number::power_of_two(-7));
        (graph.constant(&generous) * error).at_most(graph.largest())
    }

    /// States the deviation of a value that is known better than its operations tell.
    pub fn state(&mut self, of: Expr<'g>, deviation: Deviation<'g>) {
        if of.value().is_none() {
            let deviation = self.named(of.id(), deviation);
            self.found(of.id(), deviation);
        }
    }

    /// The deviation with which an expression is computed from some values, were these exact.
    pub fn deviation_from(&mut self, of: Expr<'g>, exact: &[Expr<'g>]) -> Deviation<'g> {
        self.supposed = Some(Vec::new());
        let nothing = Deviation::within(self.graph.zero());
        for value in exact {
            self.found(value.id(), nothing.clone());
            if let Some(unit) = self.pairs.get(&value.id()).copied() {
                self.state_direction(unit, nothing.clone(), self.graph.zero());
            }
        }
        let deviation = self.deviation(of.id());
        for node in core::mem::take(&mut self.supposed).unwrap_or_default() {
            self.done.remove(&node);
            self.directions.remove(&node);
        }
        deviation
    }

    /// The deviation of a value as its own operations tell, whatever is stated of it.
    pub fn by_operations(&mut self, of: Expr<'g>) -> Deviation<'g> {
        match of.op() {
            Op::Quantity(inner) => self.deviation(inner),
            _ => self.deviation_of(of.id()),
        }
    }

    /// The deviation of a direction's angle as the operations of its components tell. A factor of both, which brings a vector to unit size,
    /// does not turn it, whatever it is off.
    pub fn turn_by_operations(&mut self, unit: Vector<'g>) -> Deviation<'g> {
        if let Some(vector) = self.without_common_factor(unit) {
            let [x, y] = [vector.x, vector.y].map(|part| self.deviation(part.id()));
            return self.of_angle(vector, [&x, &y]).and(2 * self.rounded(unit.x * unit.y));
        }
        let [x, y] = [unit.x, unit.y].map(|part| self.by_operations(part));
        let turn = Deviation::shares_of(&x, &y, |dx, dy| unit.x * dy - unit.y * dx);
        turn.and(unit.x.abs() * y.rest + unit.y.abs() * x.rest)
    }

    /// The vector whose components, times the same, are these.
    fn without_common_factor(&self, product: Vector<'g>) -> Option<Vector<'g>> {
        let factors = |part: Expr<'g>| {
            let node = if let Op::Quantity(inner) = part.op() { inner } else { part.id() };
            if let Op::Mul(a, b) = self.graph.op(node) { Some([[a, b], [b, a]]) } else { None }
        };
        let (first, second) = (factors(product.x)?, factors(product.y)?);
        let same = first.into_iter().flat_map(|one| second.map(|other| (one, other)));
        // A constant may become one of the terms of each, where it is rounded.
        let common =
            same.into_iter().find(|([one, _], [other, _])| one == other && self.graph.expr(*one).value().is_none());
        common.map(|([_, x], [_, y])| Vector::new(self.graph.expr(x), self.graph.expr(y)))
    }

    /// The deviation of a value.
    pub fn deviation(&mut self, of: NodeId) -> Deviation<'g> {
        if let Some(deviation) = self.done.get(&of) {
            return deviation.clone();
        }
        if let Some(index) = self.solved.get(&of) {
            let (equations, values) = self.solutions[*index].clone();
            let deviations = self.of_solution(&equations, &values);
            let known = values.into_iter().zip(deviations);
            for (value, deviation) in
                known.filter(|(value, _)| self.solved.contains_key(&value.id())).collect::<Vec<_>>()
            {
                self.state(value, deviation);
            }
            return self.done[&of].clone();
        }
        if self.direction_of(of).is_some() {
            return self.done[&of].clone();
        }
        let deviation = self.deviation_of(of);
        let mut deviation = self.named(of, deviation);
        let is_source = self.graph.is_passed_on(of) && !deviation.rest.is_zero();
        if let Some(label) = self.graph.label(of).filter(|_| is_source) {
            deviation = deviation.from(self.source(&label.name));
        }
        self.found(of, deviation.clone());
        deviation
    }

    fn found(&mut self, of: NodeId, deviation: Deviation<'g>) {
        self.done.insert(of, deviation);
        if let Some(supposed) = &mut self.supposed {
            supposed.push(of);
        }
    }

    fn named(&self, of: NodeId, deviation: Deviation<'g>) -> Deviation<'g> {
        let Some(label) = self.graph.label(of) else { return deviation };
        let of = label.name;
        let share = |(source, share): (&Source, &Expr<'g>)| {
            let by = self.name_of(*source);
            (*source, share.named(format!("error_{of}_by_{by}"), format!("of {of}, its share of the error of {by}")))
        };
        let shares: BTreeMap<_, _> = deviation.shares.iter().map(share).collect();
        let what = if shares.is_empty() { format!("of {of}") } else { format!("of {of}, the rest") };
        Deviation { shares, rest: deviation.rest.named(format!("error_{of}"), what) }
    }

    fn deviation_of(&mut self, of: NodeId) -> Deviation<'g> {
        let graph = self.graph;
        let value = graph.expr(of);
        match graph.op(of) {
            Op::Constant(_) => Deviation::within(self.rounding_of_constant(value)),
            Op::Symbol(_) => Deviation::within(graph.zero()),
            Op::Neg(a) => self.deviation(a).opposite(),
            // No further than the value, but which way is open where that may change its sign.
            Op::Abs(a) => Deviation::within(self.deviation(a).total()),
            // It follows the value unless that may be negative.
            Op::NonNegative(a) => {
                let deviation = self.deviation(a);
                let total = deviation.total();
                deviation.and((2 * total).where_above(total, graph.expr(a)))
            }
            // Nothing that is looked at is limited: only bounds are.
            Op::Lesser(a, _) | Op::Quantity(a) | Op::Checked { value: a, .. } => self.deviation(a),
            // What is not significant counts as zero: then it is an error to divide by it.
            Op::Where { then, .. } => self.deviation(then),
            Op::Held(a) => {
                let deviation = self.deviation(a);
                self.keep(of, BoundOf::Value, &deviation)
            }
            Op::Add(a, b) | Op::Sub(a, b) => match self.of_projection(value, [a, b]) {
                Some(deviation) => deviation,
                None => {
                    let other = self.deviation(b);
                    let other = if matches!(value.op(), Op::Sub(..)) { other.opposite() } else { other };
                    self.deviation(a).plus(&other).and(self.rounded(value))
                }
            },
            Op::Mul(a, b) if a == b => {
                let (own, a) = (self.deviation(a), graph.expr(a));
                let total = own.total();
                own.scaled(2 * a).and(total * total + self.rounded(value))
            }
            Op::Mul(a, b) => {
                let (da, db) = (self.deviation(a), self.deviation(b));
                let (a, b) = (graph.expr(a), graph.expr(b));
                let both = if da.is_zero() || db.is_zero() { graph.zero() } else { da.total() * db.total() };
                let passed = db.scaled(a).plus(&da.scaled(b)).and(both);
                if is_power_of_two(a) || is_power_of_two(b) {
                    passed
                } else {
                    passed.and(self.rounded(value) + self.of_multiplied_terms(value))
                }
            }
            Op::Div(a, b) => {
                let (da, db) = (self.deviation(a), self.deviation(b));
                let (b, rounded) = (graph.expr(b), 2 * self.rounded(value));
                let passed = da.plus(&db.scaled(value).opposite());
                let passed = Deviation { rest: passed.rest / b.abs(), ..passed.each(|share| share / b, graph.zero()) };
                if db.is_zero() {
                    return passed.and(rounded);
                }
                let (error, total) = (db.total(), passed.total());
                // Nothing is known of a quotient by what may be zero: infinite, here.
                let least = b.abs() - error;
                passed.and(total * (error / least.where_above(least, graph.zero())) + rounded)
            }
            Op::Sqrt(a) => {
                let da = self.deviation(a);
                if da.is_zero() {
                    return Deviation::within(self.rounded(value));
                }
                let half = graph.constant(&Number::ratio(1, 2));
                let factor = half / value;
                // √a (1 − t/2 − √(1 − t)) ≤ √a t²/2.
                let part = da.total() / graph.expr(a);
                da.scaled(factor).and(half * (value * (part * part)) + self.rounded(value))
            }
            Op::Kernel { kernel, args, part } => self.of_kernel(value, kernel, &args, part),
        }
    }

    /// What is rounded more where `k(a x ± b y)` becomes `(ka) x ± (kb) y`, and `k(p x ± q y)` becomes `(kp) x ± (kq) y` with such sums p and q:
    /// of ka and kb it is not what they are off, and each product counts by itself, however little is left of the sum.
    fn of_multiplied_terms(&self, product: Expr<'g>) -> Expr<'g> {
        let graph = self.graph;
        let terms = |k: NodeId, sum: NodeId| {
            let k = graph.expr(k);
            k.value()?;
            Some(k.abs() * self.terms_of_multiples(sum, true)?)
        };
        match product.op() {
            Op::Mul(a, b) => terms(a, b).or_else(|| terms(b, a)).map_or(graph.zero(), |terms| self.rounded(terms)),
            _ => graph.zero(),
        }
    }

    /// The sizes of the terms of a sum without a name, added up, if each is a constant, a multiple by one, or a product with a sum of those.
    fn terms_of_multiples(&self, sum: NodeId, of_products: bool) -> Option<Expr<'g>> {
        let graph = self.graph;
        let (terms, _) = graph.op(sum).terms().filter(|_| graph.label(sum).is_none())?;
        let size = |term: NodeId| match graph.op(term) {
            Op::Constant(_) => Some(graph.expr(term).abs()),
            Op::Mul(a, b) if [a, b].iter().any(|factor| graph.expr(*factor).value().is_some()) => {
                Some(graph.expr(term).abs())
            }
            Op::Mul(a, b) if of_products => [(a, b), (b, a)]
                .into_iter()
                .find_map(|(factor, other)| Some(self.terms_of_multiples(factor, false)? * graph.expr(other).abs())),
            _ => None,
        };
        Some(size(terms[0])? + size(terms[1])?)
    }

    /// The deviation of a sum or a difference of products with the components of one direction.
    fn of_projection(&mut self, value: Expr<'g>, terms: [NodeId; 2]) -> Option<Deviation<'g>> {
        let graph = self.graph;
        let factors = |term: NodeId| match graph.op(term) {
            Op::Mul(a, b) => Some([[a, b], [b, a]]),
            _ => None,
        };
        let (first, second) = (factors(terms[0])?, factors(terms[1])?);
        let minus = matches!(value.op(), Op::Sub(..));
        let signed = |x: Expr<'g>| if minus { -x } else { x };
        // With the angle, x changes by −y and y by x.
        let turned = |of: Expr<'g>, unit: Vector<'g>| if of == unit.x { -unit.y } else { unit.x };
        for [p, a] in first {
            let Some(Direction { unit, turn, stretch }) = self.direction_of(p) else { continue };
            for [q, b] in second {
                if p == q || ![unit.x.id(), unit.y.id()].contains(&q) {
                    continue;
                }
                let (p, q, a, b) = (graph.expr(p), graph.expr(q), graph.expr(a), graph.expr(b));
                let change = turned(p, unit) * a + signed(turned(q, unit) * b);
                let angle = turn.total();
                let own = turn.scaled(change).and(value.abs() * stretch + angle * angle * (a.abs() + b.abs()));
                let others = match (self.direction_of(a.id()), self.direction_of(b.id())) {
                    (Some(other), Some(same)) if other.unit == same.unit && a != b => {
                        let change = p * turned(a, other.unit) + signed(q * turned(b, other.unit));
                        let its = other.turn.total();
                        let both = its * (its + angle) * (p.abs() + q.abs());
                        other.turn.scaled(change).and(value.abs() * other.stretch + both)
                    }
                    _ => {
                        let (da, db) = (self.deviation(a.id()), self.deviation(b.id()));
                        let both = if angle.is_zero() { angle } else { angle * (da.total() + db.total()) };
                        da.scaled(p).plus(&db.scaled(signed(q))).and(both)
                    }
                };
                let products = (p * a).abs() + (q * b).abs();
                return Some(own.plus(&others).and(self.rounded(products) + self.rounded(value)));
            }
        }
        None
    }

    fn of_kernel(&mut self, value: Expr<'g>, kernel: Kernel, args: &[NodeId], part: u8) -> Deviation<'g> {
        let graph = self.graph;
        match kernel {
            Kernel::Solve2 | Kernel::Solve3 => return self.of_solved(kernel, args, part),
            Kernel::Solve(size) if part < size => return self.of_solved(kernel, args, part),
            // How far from singular it is only decides.
            Kernel::Solve(_) => return Deviation::within(graph.zero()),
            // What is found is known by what it leaves open, and stated.
            Kernel::Search { .. } => return Deviation::within(graph.largest()),
            Kernel::SinCos | Kernel::SinCosSum(_) | Kernel::Atan2 | Kernel::MulAdd | Kernel::Unit => {}
        }
        let deviations: Vec<Deviation<'g>> = args.iter().map(|arg| self.deviation(*arg)).collect();
        let args: Vec<Expr<'g>> = args.iter().map(|arg| graph.expr(*arg)).collect();
        // 0.95 ulp of a sine, fused 0.96, 0.70 of an angle, and no ulp is more than 2u|x|; 1.5 ε of a direction.
        let ulps = Number::ratio(if graph.is_fused() { 192 } else { 190 }, 100);
        let own = graph.constant(&ulps) * self.rounded(value);
        let of_sine = |own: Expr<'g>| {
            let other = graph.kernel(kernel, &args, 1 - part);
            let total = deviations[0].total();
            deviations[0].scaled(if part == 0 { other } else { -other }).and(total * total + own)
        };
        match kernel {
            Kernel::SinCos => of_sine(own),
            Kernel::SinCosSum(_) => {
                // Besides, ε² max(4, |x|).
                let tail = graph.epsilons(1).squared() * (args[0].abs() + graph.integer(4));
                of_sine(own + tail)
            }
            Kernel::Atan2 => self.of_angle(Vector::new(args[1], args[0]), [&deviations[1], &deviations[0]]).and(own),
            Kernel::MulAdd => {
                let [a, b, c] = [&deviations[0], &deviations[1], &deviations[2]];
                let both = a.total() * b.total();
                b.scaled(args[0]).plus(&a.scaled(args[1])).plus(c).and(both + self.rounded(value))
            }
            Kernel::Unit => {
                let own = 3 * self.rounded(value);
                let vector = Vector::new(args[0], args[1]);
                let turn = self.of_angle(vector, [&deviations[0], &deviations[1]]);
                let unit = graph.unit(vector);
                let total = turn.total();
                turn.scaled(if part == 0 { -unit.y } else { unit.x }).and(total * total + own)
            }
            Kernel::Solve2 | Kernel::Solve3 | Kernel::Solve(_) | Kernel::Search { .. } => {
                Deviation::within(graph.zero())
            }
        }
    }

    /// The deviation of a vector's angle. With ρ the bound of the vector's error over its size, what is not linear in it is no more than
    /// `ρ²/(2 − 2ρ)`.
    fn of_angle(&self, vector: Vector<'g>, [x, y]: [&Deviation<'g>; 2]) -> Deviation<'g> {
        if x.is_zero() && y.is_zero() {
            return Deviation::within(self.graph.zero());
        }
        let square = vector.squared();
        let linear = Deviation::shares_of(x, y, |dx, dy| (vector.x * dy - vector.y * dx) / square);
        let rest = (vector.x.abs() * y.rest + vector.y.abs() * x.rest) / square;
        let (size, error) = (square.sqrt(), x.total() + y.total());
        let least = size - error;
        linear.and(rest + (error / size) * (error / least.where_above(size, 2 * error)))
    }

    /// The deviation of an unknown of linear equations; those of the others are found with it.
    fn of_solved(&mut self, kernel: Kernel, args: &[NodeId], part: u8) -> Deviation<'g> {
        let graph = self.graph;
        let args: Vec<Expr<'g>> = args.iter().map(|arg| graph.expr(*arg)).collect();
        let size = match kernel {
            Kernel::Solve(size) => usize::from(size),
            _ => usize::from(kernel.parts()),
        };
        // Between coefficients and right sides there may be the sizes of the coefficients.
        let (rows, right) = (args[..size * size].chunks(size), &args[args.len() - size..]);
        let equation = |(row, right): (&[Expr<'g>], &Expr<'g>)| Equation {
            coefficients: row.to_vec(),
            right: *right,
            gives: None,
        };
        let equations: Vec<Equation<'g>> = rows.zip(right).map(equation).collect();
        let values: Vec<Expr<'g>> = (0..=u8::MAX).take(size).map(|part| graph.kernel(kernel, &args, part)).collect();
        let deviations = self.of_solution(&equations, &values);
        let own = deviations[usize::from(part)].clone();
        for (value, deviation) in values.into_iter().zip(deviations) {
            self.state(value, deviation);
        }
        own
    }

    /// `u|x|`: what rounding a result of this size may change.
    fn rounded(&self, value: Expr<'g>) -> Expr<'g> {
        let unit = self.graph.scalar().epsilon().mul(&Number::ratio(1, 2));
        self.graph.constant(&unit) * value.abs()
    }

    /// How far a constant is from the number of the scalar that stands for it: known when compiled. Of one that is all but such a number
    /// a thousandth of what it could be, lest the scalar cannot hold it.
    fn rounding_of_constant(&self, constant: Expr<'g>) -> Expr<'g> {
        let scalar = self.graph.scalar();
        let Some(number) = constant.value() else { return self.rounded(constant) };
        let Some(nearest) = Number::from_f64(number.nearest(scalar)) else { return self.rounded(constant) };
        let [off, least] = [nearest.sub(&number), scalar.epsilon().mul(&number).mul(&Number::power_of_two(-11))]
            .map(|number| number.abs());
        self.graph.constant(if off.is_zero() || off.compare(&least).is_gt() { &off } else { &least })
    }
}

/// Whether a product with this is exact.
fn is_power_of_two(factor: Expr<'_>) -> bool {
    let Some(number) = factor.value() else { return false };
    let bits = number.to_f64().abs().to_bits();
    bits & ((1 << 52) - 1) == 0
        && Number::from_f64(f64::from_bits(bits)).is_some_and(|n| n.compare(&number.abs()).is_eq())
}

#[cfg(test)]
mod tests {
    use super::Rounding;
    use crate::graph::number::Number;
    use crate::graph::{Graph, Scalar};

    #[test]
    fn constants_count_by_what_they_are_off() {
        for scalar in [Scalar::F64, Scalar::F32] {
            let graph = Graph::new(scalar);
            let mut rounding = Rounding::new(&graph);
            let mut off = |number: &Number| {
                rounding.deviation(graph.constant(number).id()).total().value().expect("known when compiled")
            };
            for number in [Number::ratio(1, 10), Number::ratio(-1, 10), Number::ratio(1_000_003, 7)] {
                let nearest = Number::from_f64(number.nearest(scalar)).expect("finite");
                assert!(off(&number).compare(&nearest.sub(&number).abs()).is_eq(), "{number:?}");
            }
            assert!([Number::ratio(-3, 4), Number::zero()].iter().all(|number| off(number).is_zero()));
            // All but a number of the scalar: no less than the scalar can hold, and less than rounding could be.
            let small = Number::power_of_two(-100).add(&Number::power_of_two(-230));
            let bound = off(&small);
            assert!(bound.fits(scalar) && !bound.is_zero());
            assert!(bound.compare(&scalar.epsilon().mul(&small)).is_lt());
        }
    }
}
