//! Expressions as text, in the notation of a textbook.

use crate::graph::{Coordinate, Graph, Kernel, NodeId, Op, Order, Stage, Symbol};
use crate::model::Model;
use crate::program::{Definition, Program, ValueId};

/// What can be written as text: a node with all that it is made of, or a value of a program down to the next names.
pub(super) trait Terms<T> {
    /// What a term computes.
    fn op(&self, term: T) -> Op<T>;
    /// The name of a term that is not written out.
    fn name(&self, term: T) -> Option<String>;
}

/// Operations of the longest formula that is written out: nobody reads a longer one, and where values are used often, its length
/// grows without bounds.
const LENGTH: usize = 256;

/// Nodes, written out down to the next names of what depends on the pose.
pub(super) struct Nodes<'a>(pub(super) &'a Graph);

impl Terms<NodeId> for Nodes<'_> {
    fn op(&self, term: NodeId) -> Op {
        self.0.op(term)
    }

    fn name(&self, term: NodeId) -> Option<String> {
        let named = |term: NodeId| match (self.0.op(term), self.0.stage(term)) {
            (Op::Quantity(_), Stage::Posed | Stage::Loaded) => self.0.label(term).map(|label| label.name),
            _ => None,
        };
        if let Some(name) = named(term) {
            return Some(name);
        }
        let mut open = vec![term];
        let mut operations = 0;
        while let Some(term) = open.pop() {
            if named(term).is_none() {
                open.extend(self.0.op(term).operands());
            }
            operations += 1;
            if operations > LENGTH {
                return Some("…".to_owned());
            }
        }
        None
    }
}

/// Values of a program, each by its name where it has one.
pub(super) struct Values<'a> {
    pub(super) program: &'a Program,
    pub(super) names: &'a dyn Fn(ValueId) -> Option<String>,
    /// The value that is written out.
    pub(super) of: ValueId,
}

impl Terms<ValueId> for Values<'_> {
    fn op(&self, term: ValueId) -> Op<ValueId> {
        match &self.program.value(term).definition {
            Definition::Computed(op) => op.clone(),
            Definition::Input(_) => Op::Quantity(term),
        }
    }

    fn name(&self, term: ValueId) -> Option<String> {
        if term == self.of { None } else { (self.names)(term) }
    }
}

/// Writes terms as text.
pub(super) struct Formula<'a, S> {
    pub(super) model: &'a Model,
    pub(super) terms: S,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Choice,
    Sum,
    Product,
    Atom,
}

impl<S> Formula<'_, S> {
    /// A term as text.
    pub(super) fn of<T: Copy>(&self, term: T) -> String
    where
        S: Terms<T>,
    {
        self.bound(term).0
    }

    fn within<T: Copy>(&self, term: T, binding: Binding) -> String
    where
        S: Terms<T>,
    {
        let (text, own) = self.bound(term);
        if own >= binding { text } else { format!("({text})") }
    }

    /// The size of a negative constant.
    fn negative<T: Copy>(&self, term: T) -> Option<String>
    where
        S: Terms<T>,
    {
        match (self.terms.name(term), self.terms.op(term)) {
            (None, Op::Constant(number)) => {
                let value = self.model.graph.number(number).to_f64();
                (value < 0.0).then(|| number_text(-value))
            }
            _ => None,
        }
    }

    fn bound<T: Copy>(&self, term: T) -> (String, Binding)
    where
        S: Terms<T>,
    {
        if let Some(name) = self.terms.name(term) {
            return (name, Binding::Atom);
        }
        let sum = |id| self.within(id, Binding::Sum);
        let product = |id| self.within(id, Binding::Product);
        let atom = |id| self.within(id, Binding::Atom);
        match self.terms.op(term) {
            Op::Constant(number) => {
                let value = self.model.graph.number(number).to_f64();
                (number_text(value), if value < 0.0 { Binding::Sum } else { Binding::Atom })
            }
            Op::Symbol(symbol) => (self.symbol(symbol), Binding::Atom),
            Op::Neg(a) => (format!("−{}", product(a)), Binding::Sum),
            Op::Add(a, b) => (format!("{} + {}", sum(a), product(b)), Binding::Sum),
            Op::Sub(a, b) => (format!("{} − {}", sum(a), product(b)), Binding::Sum),
            Op::Mul(a, b) => match self.negative(a) {
                Some(factor) => (format!("−{factor}·{}", atom(b)), Binding::Sum),
                None => (format!("{}·{}", product(a), atom(b)), Binding::Product),
            },
            Op::Div(a, b) => (format!("{}/{}", product(a), atom(b)), Binding::Product),
            Op::Sqrt(a) => (format!("√({})", self.of(a)), Binding::Atom),
            Op::Abs(a) => (format!("|{}|", self.of(a)), Binding::Atom),
            Op::NonNegative(a) => (format!("max({}, 0)", self.of(a)), Binding::Atom),
            Op::Lesser(a, b) => (format!("min({}, {})", self.of(a), self.of(b)), Binding::Atom),
            Op::Where { value, limit, then } => {
                // Of several conditions, all must hold.
                let (mut conditions, mut then) = (vec![format!("{} > {}", sum(value), sum(limit))], then);
                while let (None, Op::Where { value, limit, then: inner }) = (self.terms.name(then), self.terms.op(then))
                {
                    conditions.insert(0, format!("{} > {}", sum(value), sum(limit)));
                    then = inner;
                }
                (format!("{} where {}, else 0", sum(then), conditions.join(" and ")), Binding::Choice)
            }
            Op::Quantity(a) | Op::Held(a) | Op::Checked { value: a, .. } => self.bound(a),
            Op::Kernel { kernel, args, part } => {
                let args: Vec<String> = args.iter().map(|arg| self.of(*arg)).collect();
                (self.call(kernel, &args, part), Binding::Atom)
            }
        }
    }

    fn call(&self, kernel: Kernel, args: &[String], part: u8) -> String {
        match (kernel, part) {
            (Kernel::SinCos, 0) => format!("sin({})", args[0]),
            (Kernel::SinCos, _) => format!("cos({})", args[0]),
            (Kernel::SinCosSum(phase), part) => {
                let function = if part == 0 { "sin" } else { "cos" };
                let phase = self.model.graph.number(phase).to_f64();
                let sign = if phase < 0.0 { '−' } else { '+' };
                format!("{function}({} {sign} {})", args[0], number_text(phase.abs()))
            }
            (Kernel::Atan2, _) => format!("atan2({}, {})", args[0], args[1]),
            (Kernel::MulAdd, _) => format!("fma({}, {}, {})", args[0], args[1], args[2]),
            (Kernel::Solve2 | Kernel::Solve3, part) => {
                let unknowns = usize::from(kernel.parts());
                let rows = args[..unknowns * unknowns].chunks(unknowns).zip(&args[unknowns * unknowns..]);
                let rows: Vec<String> = rows.map(|(row, right)| format!("[{} | {right}]", row.join(", "))).collect();
                format!("unknown {} of {}", part + 1, rows.join(" "))
            }
            (Kernel::Solve(unknowns), part) => {
                let unknowns = usize::from(unknowns);
                let (coefficients, rest) = args.split_at(unknowns * unknowns);
                let rows = coefficients.chunks(unknowns).zip(&rest[unknowns * unknowns..]);
                let rows: Vec<String> = rows.map(|(row, right)| format!("[{} | {right}]", row.join(", "))).collect();
                if usize::from(part) < unknowns {
                    format!("unknown {} of {}", part + 1, rows.join(" "))
                } else {
                    format!("smallest pivot, over the size of its terms, of {}", rows.join(" "))
                }
            }
            (Kernel::Search { search, .. }, part) => {
                let search = self.model.graph.search(search);
                let names: Vec<String> = search.sought.iter().flat_map(crate::graph::Sought::names).collect();
                let what = usize::from(part).checked_sub(1).and_then(|index| names.get(index));
                format!("{} by {}", what.map_or("what stays open", String::as_str), search.name)
            }
            (Kernel::Unit, part) => format!("{}/|({}, {})|", args[usize::from(part)], args[0], args[1]),
        }
    }

    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Parameter(param) => self.model.param(param).name.text.clone(),
            Symbol::Drive(drive) => self.model.drive(drive).name.text.clone(),
            Symbol::Side(closure) => format!("side_{}", self.model.joint(self.model.closure(closure).joint).name),
            Symbol::Load(load, part) => {
                let load = self.model.load(load);
                let value = load.kind.value_name(part);
                format!("{}{}{value}", load.name, if value.is_empty() { "" } else { "." })
            }
            Symbol::Coordinate(link, coordinate) => {
                let link = &self.model.link(link).name;
                match coordinate {
                    Coordinate::X => format!("x({link})"),
                    Coordinate::Y => format!("y({link})"),
                    Coordinate::Angle => format!("θ({link})"),
                    Coordinate::Cos => format!("cos({link})"),
                    Coordinate::Sin => format!("sin({link})"),
                }
            }
            Symbol::Driven(drive, order) => self.model.drive(drive).motion_name(order),
            Symbol::Moving(link, coordinate, order) => {
                let link = &self.model.link(link).name;
                let (along, turning) = match order {
                    Order::Rate => ('v', 'ω'),
                    Order::Acceleration => ('a', 'α'),
                };
                match coordinate {
                    Coordinate::X => format!("{along}x({link})"),
                    Coordinate::Y => format!("{along}y({link})"),
                    Coordinate::Angle | Coordinate::Cos | Coordinate::Sin => format!("{turning}({link})"),
                }
            }
            Symbol::Sought(search, number) | Symbol::Start(search, number) => {
                super::search::kept_name(self.model, &self.model.graph.search(search), number)
            }
            Symbol::Dimension(_) => String::new(),
        }
    }
}

/// A number in the fewest digits, with a true minus sign.
pub(super) fn number_text(value: f64) -> String {
    let size = value.abs();
    let text = if size != 0.0 && !(1e-4..1e7).contains(&size) { format!("{size:e}") } else { format!("{size}") };
    if value < 0.0 { format!("−{text}") } else { text }
}
