//! Differentiation, substitution and evaluation.

use rustc_hash::FxHashMap;

use super::number::Number;
use super::real::Real;
use super::{Coordinate, Expr, Graph, Kernel, NodeId, Op, Order, Stage, Symbol};
use crate::model::ids::LinkId;

/// Values of nodes, as far as they are known.
pub type NodeValues<T> = FxHashMap<NodeId, T>;

impl Graph {
    /// Partial derivative by a coordinate of a link: its place or its angle. Cosine and sine of a link are functions of its angle.
    #[must_use]
    pub fn derivative<'g>(&'g self, of: Expr<'g>, link: LinkId, by: Coordinate) -> Expr<'g> {
        let symbol = |symbol: Symbol| match symbol {
            Symbol::Coordinate(owner, coordinate) if owner == link => match (coordinate, by) {
                (a, b) if a == b => self.one(),
                (Coordinate::Cos, Coordinate::Angle) => -self.symbol(Symbol::Coordinate(link, Coordinate::Sin)),
                (Coordinate::Sin, Coordinate::Angle) => self.symbol(Symbol::Coordinate(link, Coordinate::Cos)),
                _ => self.zero(),
            },
            _ => self.zero(),
        };
        // Dimensions do not move.
        self.change(of, Stage::Posed, &symbol)
    }

    /// Derivative by time of what coordinates and their rates determine.
    #[must_use]
    pub fn rate<'g>(&'g self, of: Expr<'g>) -> Expr<'g> {
        let moving = |link, which, order| self.symbol(Symbol::Moving(link, which, order));
        let symbol = |symbol: Symbol| match symbol {
            Symbol::Coordinate(link, which) => {
                let turning = moving(link, Coordinate::Angle, Order::Rate);
                match which {
                    Coordinate::Cos => -(self.symbol(Symbol::Coordinate(link, Coordinate::Sin)) * turning),
                    Coordinate::Sin => self.symbol(Symbol::Coordinate(link, Coordinate::Cos)) * turning,
                    Coordinate::X | Coordinate::Y | Coordinate::Angle => moving(link, which, Order::Rate),
                }
            }
            Symbol::Moving(link, which, Order::Rate) => moving(link, which, Order::Acceleration),
            Symbol::Drive(drive) => self.symbol(Symbol::Driven(drive, Order::Rate)),
            Symbol::Driven(drive, Order::Rate) => self.symbol(Symbol::Driven(drive, Order::Acceleration)),
            _ => self.zero(),
        };
        self.change(of, Stage::Posed, &symbol)
    }

    /// The change of an expression with the changes of its symbols, which are of a stage, or later. What is known earlier may be worked
    /// out in many steps that use each other often; these are not gone into.
    pub(crate) fn change<'g>(&'g self, of: Expr<'g>, stage: Stage, symbol: &dyn Fn(Symbol) -> Expr<'g>) -> Expr<'g> {
        if of.stage() < stage {
            return self.zero();
        }
        let d = |id: NodeId| self.change(self.expr(id), stage, symbol);
        match of.op() {
            Op::Symbol(which) => symbol(which),
            Op::Neg(a) => -d(a),
            Op::Add(a, b) => d(a) + d(b),
            Op::Sub(a, b) => d(a) - d(b),
            Op::Mul(a, b) => d(a) * self.expr(b) + self.expr(a) * d(b),
            Op::Div(a, b) => (d(a) - of * d(b)) / self.expr(b),
            Op::Sqrt(a) => d(a) / (2 * of),
            Op::Checked { value, .. } | Op::Quantity(value) | Op::Held(value) => d(value),
            Op::Kernel { kernel: Kernel::SinCos | Kernel::SinCosSum(_), args, part } => {
                let other = match part {
                    0 => self.with_part(of, 1),
                    _ => -self.with_part(of, 0),
                };
                d(args[0]) * other
            }
            Op::Kernel { kernel: Kernel::Atan2, args, .. } => {
                let (y, x) = (self.expr(args[0]), self.expr(args[1]));
                (x * d(args[0]) - y * d(args[1])) / (x * x + y * y)
            }
            Op::Kernel { kernel: Kernel::MulAdd, args, .. } => {
                d(args[0]) * self.expr(args[1]) + self.expr(args[0]) * d(args[1]) + d(args[2])
            }
            Op::Constant(_)
            // Constraints are smooth: they hold none of these.
            | Op::Abs(_)
            | Op::NonNegative(_)
            | Op::Lesser(..)
            | Op::Where { .. }
            | Op::Kernel {
                kernel: Kernel::Unit | Kernel::Solve2 | Kernel::Solve3 | Kernel::Solve(_) | Kernel::Search { .. },
                ..
            } => self.zero(),
        }
    }

    fn with_part<'g>(&'g self, of: Expr<'g>, part: u8) -> Expr<'g> {
        match of.op() {
            Op::Kernel { kernel, args, .. } => {
                let args: Vec<Expr<'g>> = args.iter().map(|a| self.expr(*a)).collect();
                self.kernel(kernel, &args, part)
            }
            _ => of,
        }
    }

    /// The expression with other operands: what the node computes, of what `with` makes of them.
    pub(crate) fn rebuilt<'g>(&'g self, id: NodeId, with: &mut dyn FnMut(NodeId) -> NodeId) -> Expr<'g> {
        let mut part = |id: NodeId| self.expr(with(id));
        match self.op(id) {
            Op::Constant(_) | Op::Symbol(_) => self.expr(id),
            Op::Neg(a) => -part(a),
            Op::Abs(a) => part(a).abs(),
            Op::NonNegative(a) => part(a).non_negative(),
            Op::Lesser(a, b) => part(a).at_most(part(b)),
            Op::Sqrt(a) => part(a).sqrt(),
            Op::Add(a, b) => part(a) + part(b),
            Op::Sub(a, b) => part(a) - part(b),
            Op::Mul(a, b) => part(a) * part(b),
            Op::Div(a, b) => part(a) / part(b),
            Op::Quantity(a) => part(a),
            Op::Held(a) => part(a).held(),
            Op::Where { value, limit, then } => {
                let (value, limit) = (part(value), part(limit));
                part(then).where_above(value, limit)
            }
            Op::Kernel { kernel, args, part: which } => {
                let args: Vec<Expr<'g>> = args.iter().map(|a| part(*a)).collect();
                self.kernel(kernel, &args, which)
            }
            Op::Checked { value, guard } => {
                let mut guard = self.guard(guard);
                let value = part(value);
                guard.condition = guard.condition.map(|id| part(id).id());
                guard.failure = guard.failure.map(|id| part(id).id());
                self.checked(value, &guard)
            }
        }
    }

    /// The expression with symbols replaced.
    pub fn substituted<'g>(&'g self, of: Expr<'g>, by: &dyn Fn(Symbol) -> Option<Expr<'g>>) -> Expr<'g> {
        self.substituted_from(of, Stage::Constant, by)
    }

    /// The expression with symbols of a stage, or later, replaced; what is known earlier stays as it is.
    pub fn substituted_from<'g>(
        &'g self,
        of: Expr<'g>,
        stage: Stage,
        by: &dyn Fn(Symbol) -> Option<Expr<'g>>,
    ) -> Expr<'g> {
        let mut done = FxHashMap::default();
        self.expr(self.substitute(of.id(), (stage, by), &mut done))
    }

    fn substitute<'g>(
        &'g self,
        id: NodeId,
        (stage, by): (Stage, &dyn Fn(Symbol) -> Option<Expr<'g>>),
        done: &mut FxHashMap<NodeId, NodeId>,
    ) -> NodeId {
        if self.stage(id) < stage {
            return id;
        }
        if let Some(found) = done.get(&id) {
            return *found;
        }
        let result = match self.op(id) {
            Op::Symbol(symbol) => by(symbol).map_or(id, Expr::id),
            _ => self.rebuilt(id, &mut |inner| self.substitute(inner, (stage, by), done)).id(),
        };
        done.insert(id, result);
        result
    }

    /// The expression with the constants of each sum brought together, exactly: between places far from the origin only then a way keeps the
    /// digits that the places have not.
    pub fn with_constants_together<'g>(&'g self, of: Expr<'g>) -> Expr<'g> {
        self.expr(self.together(of.id(), &mut FxHashMap::default()))
    }

    fn together(&self, id: NodeId, done: &mut FxHashMap<NodeId, NodeId>) -> NodeId {
        if let Some(found) = done.get(&id) {
            return *found;
        }
        let result = match self.op(id) {
            // What has a name is a line of the derivation.
            Op::Quantity(_) | Op::Held(_) => id,
            _ => {
                let (mut terms, mut constants) = (Vec::new(), Vec::new());
                self.add_terms((id, false), &mut terms, &mut constants);
                if constants.len() < 2 {
                    self.rebuilt(id, &mut |inner| self.together(inner, done)).id()
                } else {
                    let terms = terms.into_iter().map(|(term, minus)| {
                        let term = self.expr(self.together(term, done));
                        if minus { -term } else { term }
                    });
                    let constant = constants.iter().fold(Number::zero(), |sum, constant| sum.add(constant));
                    let sum = terms.reduce(|sum, term| sum + term).unwrap_or(self.zero());
                    (sum + self.constant(&constant)).id()
                }
            }
        };
        done.insert(id, result);
        result
    }

    /// The terms of a sum of sums, and the constants among them.
    fn add_terms(&self, (id, minus): (NodeId, bool), terms: &mut Vec<(NodeId, bool)>, constants: &mut Vec<Number>) {
        match (self.constant_value(id), self.op(id)) {
            (Some(constant), _) => constants.push(if minus { constant.neg() } else { constant }),
            (None, Op::Neg(a)) => self.add_terms((a, !minus), terms, constants),
            (None, Op::Add(a, b)) => [a, b].into_iter().for_each(|a| self.add_terms((a, minus), terms, constants)),
            (None, Op::Sub(a, b)) => {
                self.add_terms((a, minus), terms, constants);
                self.add_terms((b, !minus), terms, constants);
            }
            (None, _) => terms.push((id, minus)),
        }
    }

    /// The value of a node, checks passed over. `known` gives the values of symbols; it is remembered what was computed.
    pub fn evaluate<T: Real>(&self, id: NodeId, known: &dyn Fn(Symbol) -> T, done: &mut NodeValues<T>) -> T {
        if let Some(value) = done.get(&id) {
            return value.clone();
        }
        let mut of = |id: NodeId| self.evaluate(id, known, done);
        let value = match self.op(id) {
            Op::Constant(n) => T::from_number(&self.number(n)),
            // A search starts where it is declared to.
            Op::Symbol(Symbol::Start(search, number)) => of(self.start_of(search, number)),
            Op::Symbol(symbol) => known(symbol),
            Op::Kernel { kernel, args, part } => {
                let values: Vec<T> = args.iter().map(|a| of(*a)).collect();
                let mut results = self.apply(kernel, &values);
                // What else the call has found: a search is long.
                for (other, result) in (0..).zip(&results).filter(|(other, _)| *other != part) {
                    if let Some(node) = self.find(&Op::Kernel { kernel, args: args.clone(), part: other }) {
                        done.insert(node.id(), result.clone());
                    }
                }
                results.swap_remove(usize::from(part))
            }
            op => op.arithmetic(&mut of),
        };
        done.insert(id, value.clone());
        value
    }

    /// The results of a kernel.
    pub fn apply<T: Real>(&self, kernel: Kernel, args: &[T]) -> Vec<T> {
        let pair = |(first, second): (T, T)| vec![first, second];
        match kernel {
            Kernel::SinCos if self.is_fused() => pair(args[0].fused_sin_cos()),
            Kernel::SinCosSum(phase) if self.is_fused() => pair(args[0].fused_sin_cos_sum(&self.number(phase))),
            Kernel::SinCos => pair(args[0].sin_cos()),
            Kernel::SinCosSum(phase) => pair(args[0].sin_cos_sum(&self.number(phase))),
            Kernel::Atan2 => vec![args[0].atan2(&args[1])],
            Kernel::MulAdd => vec![args[0].mul_add(&args[1], &args[2])],
            Kernel::Unit => pair(args[0].unit(&args[1])),
            Kernel::Solve2 => pair(args[0].solve_2(&args[1], &args[2], &args[3], [&args[4], &args[5]])),
            Kernel::Solve3 => Real::solve_3(&args[..9], &args[9..]),
            Kernel::Solve(unknowns) => {
                let n = usize::from(unknowns);
                let rows = |from: usize| args[from..from + n * n].chunks(n).map(<[T]>::to_vec).collect::<Vec<_>>();
                let solved = super::linear::solve(&rows(0), &rows(n * n), &args[2 * n * n..]);
                // Singular equations are refused by their distance, before anything else is read of them.
                let (solution, distance) = solved.unwrap_or_else(|| (vec![T::zero(); n], T::zero()));
                solution.into_iter().chain([distance]).collect()
            }
            Kernel::Search { search, .. } => self.searched(search, args),
        }
    }
}
