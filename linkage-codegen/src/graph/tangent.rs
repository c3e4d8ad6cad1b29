//! Partial derivatives of any node by one unknown of run time: forwards through the graph, each node once.
//!
//! What does not depend on the unknown has the derivative zero by structure, and nothing that is zero is ever written down. Values
//! that both need are shared, because the graph holds each of them once.

use core::cell::{Cell, RefCell};
use rustc_hash::FxHashMap;

use super::{Condition, Expr, Failure, Graph, Guard, Kernel, NodeId, Op, Stage, Symbol, Vector};

/// The derivatives by one unknown.
#[derive(Debug)]
pub(crate) struct Tangent<'g> {
    graph: &'g Graph,
    by: Symbol,
    /// What the unknown is called.
    name: String,
    /// What is stated or found.
    known: RefCell<FxHashMap<NodeId, NodeId>>,
    /// Whether what a pose keeps stands still.
    posed: bool,
    /// Whether a search was reached: what it finds has no derivative but what is stated.
    searched: Cell<bool>,
}

impl<'g> Tangent<'g> {
    /// The derivatives by an unknown that is called so.
    pub(crate) fn by(graph: &'g Graph, by: Symbol, name: &str) -> Self {
        Self { graph, by, name: name.to_owned(), known: RefCell::default(), posed: false, searched: Cell::new(false) }
    }

    /// The same with all that a pose keeps held where it is.
    pub(crate) fn at_rest(self) -> Self {
        Self { posed: true, ..self }
    }

    /// What the unknown is.
    pub(crate) fn unknown(&self) -> Symbol {
        self.by
    }

    /// What the unknown is called.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Whether the derivative of what a search finds was asked for and not stated.
    pub(crate) fn reached_a_search(&self) -> bool {
        self.searched.get()
    }

    /// States the derivative of a value. Of a constant it is known.
    pub(crate) fn state(&self, of: Expr<'g>, derivative: Expr<'g>) {
        if of.value().is_none() {
            self.known.borrow_mut().entry(of.id()).or_insert(derivative.id());
        }
    }

    /// The derivative of a vector.
    pub(crate) fn of_vector(&self, of: Vector<'g>) -> Vector<'g> {
        Vector::new(self.of(of.x), self.of(of.y))
    }

    /// The derivative of a value.
    pub(crate) fn of(&self, of: Expr<'g>) -> Expr<'g> {
        let first = match self.by {
            Symbol::Parameter(_) => Stage::Prepared,
            Symbol::Drive(_) => Stage::Posed,
            _ => Stage::Loaded,
        };
        if of.stage() < first {
            return self.graph.zero();
        }
        let known = self.known.borrow().get(&of.id()).copied();
        if let Some(found) = known {
            return self.graph.expr(found);
        }
        let found = self.found(of);
        self.known.borrow_mut().insert(of.id(), found.id());
        found
    }

    fn found(&self, of: Expr<'g>) -> Expr<'g> {
        let graph = self.graph;
        let zero = graph.zero();
        let value = |id: NodeId| graph.expr(id);
        match of.op() {
            Op::Symbol(symbol) if symbol == self.by => graph.one(),
            Op::Constant(_) | Op::Symbol(_) => zero,
            Op::Neg(a) => -self.of(value(a)),
            Op::Add(a, b) => match self.sized(value(a), value(b)) {
                // The size of a vector: u·v̇, since u̇ is across it.
                Some((unit, vector)) => unit.dot(self.of_vector(vector)),
                None => self.of(value(a)) + self.of(value(b)),
            },
            Op::Sub(a, b) => self.of(value(a)) - self.of(value(b)),
            Op::Mul(a, b) if a == b => (2 * value(a)) * self.of(value(a)),
            Op::Mul(a, b) => self.of(value(a)) * value(b) + value(a) * self.of(value(b)),
            Op::Div(a, b) => {
                let (da, db) = (self.of(value(a)), self.of(value(b)));
                let change = da - of * db;
                if change.is_zero() { zero } else { change / value(b) }
            }
            Op::Sqrt(a) => {
                let da = self.of(value(a));
                if da.is_zero() { zero } else { da / (2 * of) }
            }
            // By its branch.
            Op::Abs(a) => {
                let (a, da) = (value(a), self.of(value(a)));
                da.where_above(a, zero) - da.where_above(zero, a)
            }
            Op::NonNegative(a) => self.of(value(a)).where_above(value(a), zero),
            Op::Lesser(a, b) => {
                let (a, b) = (value(a), value(b));
                self.of(a).where_above(b, a) + self.of(b).where_above(a, b)
            }
            Op::Where { value: compared, limit, then } => {
                self.of(value(then)).where_above(value(compared), value(limit))
            }
            Op::Held(_) if self.posed => zero,
            Op::Held(inner) => self.of(value(inner)),
            Op::Quantity(inner) => {
                let derivative = self.of(value(inner));
                // A change of sign is made where it is used.
                let is_negated = matches!(derivative.op(), Op::Neg(_));
                let derivative = match graph.put_together_from_pose(of.id()) {
                    Some(other) => derivative.or_from_pose(self.of(value(other))),
                    None => derivative,
                };
                let Some(label) = graph.label(of.id()).filter(|_| !self.posed && !is_negated) else {
                    return derivative;
                };
                let (name, by) = (&label.name, &self.name);
                derivative.named(format!("{name}_by_{by}"), format!("∂{name}/∂{by}"))
            }
            // Where the value is refused, so is its derivative; parameters are refused before there is any.
            Op::Checked { value: inner, guard } => {
                let (derivative, guard) = (self.of(value(inner)), graph.guard(guard));
                let prepared = matches!(guard.failure, Failure::Parameter { .. });
                if derivative.is_zero() || prepared { derivative } else { graph.checked(derivative, &guard) }
            }
            Op::Kernel { kernel, args, part } => {
                let args: Vec<Expr<'g>> = args.into_iter().map(value).collect();
                self.of_kernel(of, kernel, &args, part)
            }
        }
    }

    /// The unit vector and the vector whose product is this sum, if it is one: the vector's size.
    fn sized(&self, a: Expr<'g>, b: Expr<'g>) -> Option<(Vector<'g>, Vector<'g>)> {
        let bare = |id: NodeId| {
            let mut id = id;
            while let Op::Quantity(inner) = self.graph.op(id) {
                id = inner;
            }
            id
        };
        let product = |term: Expr<'g>| {
            let Op::Mul(p, q) = term.op() else { return None };
            [(p, q), (q, p)].into_iter().find_map(|(unit, component)| match self.graph.op(bare(unit)) {
                Op::Kernel { kernel: Kernel::Unit, args, part } if bare(args[usize::from(part)]) == bare(component) => {
                    Some((args, part, self.graph.expr(unit), self.graph.expr(component)))
                }
                _ => None,
            })
        };
        match (product(a)?, product(b)?) {
            ((args, 0, u, x), (same, 1, v, y)) | ((args, 1, v, y), (same, 0, u, x)) if args == same => {
                Some((Vector::new(u, v), Vector::new(x, y)))
            }
            _ => None,
        }
    }

    fn of_kernel(&self, of: Expr<'g>, kernel: Kernel, args: &[Expr<'g>], part: u8) -> Expr<'g> {
        let graph = self.graph;
        let zero = graph.zero();
        match kernel {
            Kernel::SinCos | Kernel::SinCosSum(_) => {
                let change = self.of(args[0]);
                match part {
                    _ if change.is_zero() => zero,
                    0 => change * graph.kernel(kernel, args, 1),
                    _ => -(change * graph.kernel(kernel, args, 0)),
                }
            }
            Kernel::Atan2 => {
                let (y, x) = (args[0], args[1]);
                let change = x * self.of(y) - y * self.of(x);
                if change.is_zero() { zero } else { change / (x * x + y * y) }
            }
            Kernel::MulAdd => self.of(args[0]) * args[1] + args[0] * self.of(args[1]) + self.of(args[2]),
            Kernel::Unit => {
                let vector = Vector::new(args[0], args[1]);
                let change = self.of_vector(vector);
                if change.x.is_zero() && change.y.is_zero() {
                    return zero;
                }
                let unit = graph.unit(vector);
                let size = unit.dot(vector);
                let of = graph.label(args[0].id()).map(|label| label.name.trim_end_matches("_x").to_owned());
                let of = of.unwrap_or_else(|| "a vector".to_owned());
                let guard = Guard {
                    condition: Condition::Above { value: size.id(), limit: zero.id() },
                    failure: Failure::NoDirection { of },
                };
                let turning = unit.cross(change) / graph.checked(size, &guard);
                let across = unit.perp();
                turning * if part == 0 { across.x } else { across.y }
            }
            Kernel::Solve2 => self.of_solution(of, kernel, args, (2, 4), part),
            Kernel::Solve3 => self.of_solution(of, kernel, args, (3, 9), part),
            Kernel::Solve(unknowns) if part < unknowns => {
                let n = usize::from(unknowns);
                self.of_solution(of, kernel, args, (n, 2 * n * n), part)
            }
            // How far the equations are from singular ones decides, and is nothing that is reckoned with.
            Kernel::Solve(_) => zero,
            Kernel::Search { .. } => {
                self.searched.set(true);
                zero
            }
        }
    }

    /// `A x = b`: `A ẋ = ḃ − Ȧ x`, by the same solver. The right sides stand behind `before` other arguments, the coefficients first.
    fn of_solution(
        &self,
        of: Expr<'g>,
        kernel: Kernel,
        args: &[Expr<'g>],
        (n, before): (usize, usize),
        part: u8,
    ) -> Expr<'g> {
        let graph = self.graph;
        let number = |index: usize| u8::try_from(index).unwrap_or(u8::MAX);
        let solution: Vec<Expr<'g>> = (0..n).map(|index| graph.kernel(kernel, args, number(index))).collect();
        let right: Vec<Expr<'g>> = (0..n)
            .map(|row| {
                let own = self.of(args[before + row]);
                (0..n).fold(own, |sum, column| sum - self.of(args[row * n + column]) * solution[column])
            })
            .collect();
        if right.iter().all(|value| value.is_zero()) {
            return graph.zero();
        }
        debug_assert_eq!(of, solution[usize::from(part)], "a part of its own solution");
        let args: Vec<Expr<'g>> = args[..before].iter().copied().chain(right).collect();
        graph.kernel(kernel, &args, part)
    }
}
