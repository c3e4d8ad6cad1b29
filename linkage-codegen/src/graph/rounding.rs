//! Running error analysis (Wilkinson 1963; Higham, *Accuracy and Stability of Numerical Algorithms*, § 3.3): beside every value a bound of
//! how far rounding has taken it from what exact arithmetic would give.
//!
//! With `u` half the distance from 1 to the next number, and `e(x)` the bound of a computed value `x`:
//!
//! ```text
//! e(a ± b) = e(a) + e(b) + u|a ± b|               e(√a) = √a (t + t²)/2 + u√a, t = e(a)/a
//! e(a b)   = |a| e(b) + (|b| + e(b)) e(a) + u|ab|   e(a/b) = (e(a) + |a/b| e(b))/(|b| − e(b)) + 2u|a/b|
//! ```
//!
//! The errors of the two components of a direction are not independent: they are those of its angle, `δ`, and of its size, `ν`. So a sum
//! of products with them (a projection, a moment, a turned vector) has
//!
//! ```text
//! e(x a + y b) = |x b − y a| δ + |x a + y b| ν + |x| e(a) + |y| e(b) + u(|x a| + |y b| + |x a + y b|)
//! ```
//!
//! A quotient counts twice, because it may become a product with a reciprocal. What is given (drives, parameters, loads) is exact; constants
//! are rounded once. Bounds are not exact either: what all of them lack is made up for where a result takes its bound.

use std::collections::HashMap;

use super::number::Number;
use super::{Expr, Graph, Kernel, NodeId, Op, Scalar, Vector};

/// A direction, and the bounds of the errors of its angle and of its size.
#[derive(Clone, Copy, Debug)]
struct Direction<'g> {
    unit: Vector<'g>,
    turn: Expr<'g>,
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

/// A bound that a pose keeps.
#[derive(Clone, Copy, Debug)]
pub struct HeldBound<'g> {
    /// The kept value.
    pub value: NodeId,
    /// What of it is bounded.
    pub what: BoundOf,
    /// The bound.
    pub bound: Expr<'g>,
}

/// Bounds of the rounding errors of nodes.
#[derive(Debug)]
pub struct Rounding<'g> {
    graph: &'g Graph,
    done: HashMap<NodeId, Expr<'g>>,
    /// Directions, by either component.
    directions: HashMap<NodeId, Direction<'g>>,
    /// Which values are directions.
    pairs: HashMap<NodeId, Vector<'g>>,
    /// Whether a bound would have to be known of what is found by iteration, which it is not.
    pub searched: bool,
    /// The bounds that belong to values that a pose keeps; they are kept beside them.
    pub held: Vec<HeldBound<'g>>,
}

impl<'g> Rounding<'g> {
    /// Nothing bounded yet.
    #[must_use]
    pub fn new(graph: &'g Graph) -> Self {
        Self {
            graph,
            done: HashMap::new(),
            directions: HashMap::new(),
            pairs: HashMap::new(),
            searched: false,
            held: Vec::new(),
        }
    }

    /// Says that two values are a direction.
    pub fn is_direction(&mut self, unit: Vector<'g>) {
        self.pairs.extend([unit.x, unit.y].map(|part| (part.id(), unit)));
    }

    /// States the bounds of a direction's angle and size.
    pub fn state_direction(&mut self, unit: Vector<'g>, turn: Expr<'g>, stretch: Expr<'g>) {
        let found = Direction { unit, turn, stretch };
        for (part, other) in [(unit.x, unit.y), (unit.y, unit.x)] {
            self.directions.insert(part.id(), found);
            self.done.insert(part.id(), other.abs() * turn + part.abs() * stretch + turn * turn);
        }
    }

    /// What is known of a direction that a value is a component of.
    fn direction_of(&mut self, part: NodeId) -> Option<Direction<'g>> {
        if let Some(found) = self.directions.get(&part) {
            return Some(*found);
        }
        if let Op::Held(inner) = self.graph.op(part) {
            let Direction { unit, turn, stretch } = self.direction_of(inner)?;
            let unit = unit.held();
            let value = unit.x.id();
            let (turn, stretch) = (self.keep(value, BoundOf::Angle, turn), self.keep(value, BoundOf::Size, stretch));
            self.state_direction(unit, turn, stretch);
        } else {
            let unit = *self.pairs.get(&part)?;
            // Its components are as far off as their operations tell, also where one is computed from the other.
            self.pairs.retain(|_, other| *other != unit);
            let [ex, ey] = [unit.x, unit.y].map(|part| {
                let error = self.error_of(part.id());
                self.named(part.id(), error)
            });
            let (x, y) = (unit.x.abs(), unit.y.abs());
            self.state_direction(unit, y * ex + x * ey, x * ex + y * ey);
        }
        self.directions.get(&part).copied()
    }

    /// The bound of a kept value, as a pose keeps it.
    fn keep(&mut self, value: NodeId, what: BoundOf, error: Expr<'g>) -> Expr<'g> {
        let bound = error.held();
        let known = self.held.iter().any(|held| (held.value, held.what) == (value, what));
        if matches!(bound.op(), Op::Held(_)) && !known {
            self.held.push(HeldBound { value, what, bound });
        }
        bound
    }

    /// The bound of a result's error: that of its value, and a little more for the rounding of the bound itself. Where nothing can be
    /// said, because something was divided by what may be zero, it is the largest number.
    pub fn bound(&mut self, of: Expr<'g>) -> Expr<'g> {
        let graph = self.graph;
        let error = self.error(of.id());
        if error.value().is_some() {
            return error;
        }
        // More than thousands of operations on bounds can lose.
        let generous = Number::one().add(&Number::power_of_two(match graph.scalar() {
            Scalar::F64 => -40,
            Scalar::F32 => -11,
        }));
        let (bound, largest) = (graph.constant(&generous) * error, graph.largest());
        let known = graph.one().where_above(largest, bound);
        bound.where_above(largest, bound) + largest * (graph.one() - known)
    }

    /// States the bound of a value that is known better than its operations tell.
    pub fn state(&mut self, of: Expr<'g>, error: Expr<'g>) {
        if of.value().is_none() {
            self.done.insert(of.id(), self.named(of.id(), error));
        }
    }

    /// The bound of the error with which an expression is computed from some values, were these exact.
    pub fn error_from(&mut self, of: Expr<'g>, exact: &[Expr<'g>]) -> Expr<'g> {
        let before = (self.done.clone(), self.directions.clone(), self.pairs.clone());
        for value in exact {
            let zero = self.graph.zero();
            self.done.insert(value.id(), zero);
            let known = self.directions.get(&value.id()).map(|direction| direction.unit);
            if let Some(unit) = known.or_else(|| self.pairs.get(&value.id()).copied()) {
                self.directions.insert(value.id(), Direction { unit, turn: zero, stretch: zero });
            }
        }
        let error = self.error(of.id());
        (self.done, self.directions, self.pairs) = before;
        error
    }

    fn named(&self, of: NodeId, error: Expr<'g>) -> Expr<'g> {
        match self.graph.label(of) {
            Some(label) => error.named(format!("error_{}", label.name), format!("of {}", label.name)),
            None => error,
        }
    }

    fn error(&mut self, of: NodeId) -> Expr<'g> {
        if let Some(error) = self.done.get(&of) {
            return *error;
        }
        if self.direction_of(of).is_some() {
            return self.done[&of];
        }
        let error = self.error_of(of);
        let error = self.named(of, error);
        self.done.insert(of, error);
        error
    }

    fn error_of(&mut self, of: NodeId) -> Expr<'g> {
        let graph = self.graph;
        let value = graph.expr(of);
        match graph.op(of) {
            Op::Constant(_) => {
                if self.is_exact(value) {
                    graph.zero()
                } else {
                    self.rounded(value)
                }
            }
            Op::Symbol(_) => graph.zero(),
            Op::Neg(a) | Op::Abs(a) | Op::NonNegative(a) | Op::Quantity(a) | Op::Checked { value: a, .. } => {
                self.error(a)
            }
            // What is not significant counts as zero: then it is an error to divide by it.
            Op::Where { then, .. } => self.error(then),
            Op::Held(a) => {
                let error = self.error(a);
                self.keep(of, BoundOf::Value, error)
            }
            Op::Add(a, b) | Op::Sub(a, b) => match self.error_of_projection(value, [a, b]) {
                Some(error) => error,
                None => self.error(a) + self.error(b) + self.rounded(value),
            },
            Op::Mul(a, b) => {
                let (ea, eb) = (self.error(a), self.error(b));
                let (a, b) = (graph.expr(a), graph.expr(b));
                let passed = a.abs() * eb + (b.abs() + eb) * ea;
                if is_power_of_two(a) || is_power_of_two(b) { passed } else { passed + self.rounded(value) }
            }
            Op::Div(a, b) => {
                let (ea, eb) = (self.error(a), self.error(b));
                let rounded = 2 * self.rounded(value);
                if ea.is_zero() && eb.is_zero() {
                    return rounded;
                }
                let least = graph.expr(b).abs() - eb;
                // Nothing is known of a quotient by what may be zero: infinite, here.
                (ea + value.abs() * eb) / least.where_above(least, graph.zero()) + rounded
            }
            Op::Sqrt(a) => {
                let ea = self.error(a);
                if ea.is_zero() {
                    return self.rounded(value);
                }
                // 1 − √(1 − t) ≤ (t + t²)/2.
                let part = ea / graph.expr(a);
                let half = graph.constant(&Number::ratio(1, 2));
                value * (half * (part + part * part)) + self.rounded(value)
            }
            Op::Kernel { kernel, args, part } => self.error_of_kernel(value, kernel, &args, part),
        }
    }

    /// The error of a sum or a difference of products with the components of one direction.
    fn error_of_projection(&mut self, value: Expr<'g>, terms: [NodeId; 2]) -> Option<Expr<'g>> {
        let graph = self.graph;
        let factors = |term: NodeId| match graph.op(term) {
            Op::Mul(a, b) => Some([[a, b], [b, a]]),
            _ => None,
        };
        let (first, second) = (factors(terms[0])?, factors(terms[1])?);
        let minus = matches!(value.op(), Op::Sub(..));
        let signed = |x: Expr<'g>| if minus { -x } else { x };
        for [p, a] in first {
            let Some(direction) = self.direction_of(p) else { continue };
            for [q, b] in second {
                let Direction { unit, turn, stretch } = direction;
                if p == q || ![unit.x.id(), unit.y.id()].contains(&q) {
                    continue;
                }
                let (p, q, a, b) = (graph.expr(p), graph.expr(q), graph.expr(a), graph.expr(b));
                // With the angle, x changes by −y and y by x.
                let turned = |of: Expr<'g>, unit: Vector<'g>| if of == unit.x { -unit.y } else { unit.x };
                let change = turned(p, unit) * a + signed(turned(q, unit) * b);
                let own = change.abs() * turn + value.abs() * stretch + turn * turn * (a.abs() + b.abs());
                let others = match (self.direction_of(a.id()), self.direction_of(b.id())) {
                    (Some(other), Some(same)) if other.unit == same.unit && a != b => {
                        let change = p * turned(a, other.unit) + signed(q * turned(b, other.unit));
                        change.abs() * other.turn
                            + value.abs() * other.stretch
                            + other.turn * (other.turn + turn) * (p.abs() + q.abs())
                    }
                    _ => {
                        let (ea, eb) = (self.error(a.id()), self.error(b.id()));
                        (p.abs() + turn) * ea + (q.abs() + turn) * eb
                    }
                };
                let products = (p * a).abs() + (q * b).abs();
                return Some(own + others + self.rounded(products) + self.rounded(value));
            }
        }
        None
    }

    fn error_of_kernel(&mut self, value: Expr<'g>, kernel: Kernel, args: &[NodeId], part: u8) -> Expr<'g> {
        let graph = self.graph;
        let errors: Vec<Expr<'g>> = args.iter().map(|arg| self.error(*arg)).collect();
        let args: Vec<Expr<'g>> = args.iter().map(|arg| graph.expr(*arg)).collect();
        // 0.82 ulp of a sine, 0.70 of an angle, and no ulp is more than 2u|x|; 1.5 ε of a direction.
        let ulps = Number::ratio(164, 100);
        let own = graph.constant(&ulps) * self.rounded(value);
        match kernel {
            Kernel::SinCos => own + graph.kernel(kernel, &args, 1 - part).abs() * errors[0] + errors[0] * errors[0],
            Kernel::SinCosSum(_) => {
                // Besides, ε² max(4, |x|).
                let tail = graph.epsilons(1).squared() * (args[0].abs() + graph.integer(4));
                own + tail + graph.kernel(kernel, &args, 1 - part).abs() * errors[0] + errors[0] * errors[0]
            }
            Kernel::Atan2 => {
                let (y, x) = (args[0], args[1]);
                let (ey, ex) = (errors[0], errors[1]);
                if ey.is_zero() && ex.is_zero() {
                    return own;
                }
                // The angle of an error ρ across a vector of size r ≥ ρ is at most (π/2) ρ/r.
                let size = (x * x + y * y).sqrt();
                let error = ex + ey;
                let least = (size - error).where_above(size, error);
                own + 2 * (error / least)
            }
            Kernel::MulAdd => {
                args[0].abs() * errors[1] + (args[1].abs() + errors[1]) * errors[0] + errors[2] + self.rounded(value)
            }
            Kernel::Unit => {
                let error = errors[0] + errors[1];
                let own = 3 * self.rounded(value);
                if error.is_zero() {
                    return own;
                }
                let size = (args[0] * args[0] + args[1] * args[1]).sqrt();
                let least = (size - error).where_above(size, error);
                own + 2 * (error / least)
            }
            Kernel::Solve2 => self.error_of_solution(kernel, &args, &errors, part, 2),
            Kernel::Solve3 => self.error_of_solution(kernel, &args, &errors, part, 3),
            // How far from singular it is only decides.
            Kernel::Solve(size) if part == size => graph.zero(),
            Kernel::Solve(size) => self.error_of_solution(kernel, &args, &errors, part, usize::from(size)),
            Kernel::Search { .. } => {
                self.searched = true;
                graph.zero()
            }
        }
    }

    /// `|x̂ − x| ≤ 2 |A⁻¹| (E|x̂| + e + γ(|A||x̂| + |b|))` for equations `A x = b` with errors E and e of their numbers, as long as these are
    /// far from making A singular; `γ` stands for the elimination with row pivoting.
    fn error_of_solution(
        &self,
        kernel: Kernel,
        args: &[Expr<'g>],
        errors: &[Expr<'g>],
        part: u8,
        size: usize,
    ) -> Expr<'g> {
        let graph = self.graph;
        // Between coefficients and right sides there may be the sizes of the coefficients.
        let (before, right) = args.split_at(args.len() - size);
        let (matrix, matrix_errors) = (&args[..size * size], &errors[..size * size]);
        let right_errors = &errors[args.len() - size..];
        let solution: Vec<Expr<'g>> =
            (0..size).map(|k| graph.kernel(kernel, args, u8::try_from(k).unwrap_or(0)).abs()).collect();
        let elimination = graph.epsilons(8);
        let mut sum = graph.zero();
        for line in 0..size {
            let mut residual = right_errors[line] + elimination * right[line].abs();
            for (column, value) in solution.iter().enumerate() {
                let at = size * line + column;
                residual = residual + (matrix_errors[at] + elimination * matrix[at].abs()) * *value;
            }
            let unit = (0..size).map(|other| if other == line { graph.one() } else { graph.zero() });
            let equations: Vec<Expr<'g>> = before.iter().copied().chain(unit).collect();
            sum = sum + graph.kernel(kernel, &equations, part).abs() * residual;
        }
        2 * sum
    }

    /// `u|x|`: what rounding a result of this size may change.
    fn rounded(&self, value: Expr<'g>) -> Expr<'g> {
        let unit = self.graph.scalar().epsilon().mul(&Number::ratio(1, 2));
        self.graph.constant(&unit) * value.abs()
    }

    /// Whether a constant is a number of the scalar.
    fn is_exact(&self, constant: Expr<'g>) -> bool {
        let Some(number) = constant.value() else { return false };
        let nearest = match self.graph.scalar() {
            Scalar::F64 => number.to_f64(),
            Scalar::F32 => f64::from(number.to_f32()),
        };
        Number::from_f64(nearest).is_some_and(|nearest| nearest.compare(&number).is_eq())
    }
}

/// Whether a product with this is exact.
fn is_power_of_two(factor: Expr<'_>) -> bool {
    let Some(number) = factor.value() else { return false };
    let bits = number.to_f64().abs().to_bits();
    bits & ((1 << 52) - 1) == 0
        && Number::from_f64(f64::from_bits(bits)).is_some_and(|n| n.compare(&number.abs()).is_eq())
}
