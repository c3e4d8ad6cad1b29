//! Expressions as text, in the notation of a textbook.

use crate::graph::{Coordinate, Graph, Kernel, NodeId, Op, Symbol};
use crate::model::Model;

/// Writes expressions as text.
pub(super) struct Formula<'a> {
    pub(super) model: &'a Model,
    /// Names of nodes that are not written out.
    pub(super) name: &'a dyn Fn(NodeId) -> Option<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Atom,
}

impl Formula<'_> {
    /// A node as text.
    pub(super) fn of(&self, node: NodeId) -> String {
        self.bound(node).0
    }

    fn graph(&self) -> &Graph {
        &self.model.graph
    }

    fn within(&self, node: NodeId, binding: Binding) -> String {
        let (text, own) = self.bound(node);
        if own >= binding { text } else { format!("({text})") }
    }

    fn bound(&self, node: NodeId) -> (String, Binding) {
        if let Some(name) = (self.name)(node) {
            return (name, Binding::Atom);
        }
        let sum = |id| self.within(id, Binding::Sum);
        let product = |id| self.within(id, Binding::Product);
        let atom = |id| self.within(id, Binding::Atom);
        match self.graph().op(node) {
            Op::Constant(number) => {
                let value = self.graph().number(number).to_f64();
                (number_text(value), if value < 0.0 { Binding::Sum } else { Binding::Atom })
            }
            Op::Symbol(symbol) => (self.symbol(symbol), Binding::Atom),
            Op::Neg(a) => (format!("−{}", product(a)), Binding::Sum),
            Op::Add(a, b) => (format!("{} + {}", sum(a), product(b)), Binding::Sum),
            Op::Sub(a, b) => (format!("{} − {}", sum(a), product(b)), Binding::Sum),
            Op::Mul(a, b) => (format!("{}·{}", product(a), atom(b)), Binding::Product),
            Op::Div(a, b) => (format!("{}/{}", product(a), atom(b)), Binding::Product),
            Op::Sqrt(a) => (format!("√({})", self.of(a)), Binding::Atom),
            Op::Abs(a) => (format!("|{}|", self.of(a)), Binding::Atom),
            Op::NonNegative(a) => (format!("max({}, 0)", self.of(a)), Binding::Atom),
            Op::Where { value, limit, then } => {
                (format!("{} where {} > {}, else 0", sum(then), sum(value), sum(limit)), Binding::Sum)
            }
            Op::Quantity(a) | Op::Held(a) | Op::Checked { value: a, .. } => self.bound(a),
            Op::Kernel { kernel, args, part } => (self.call(kernel, &args, part), Binding::Atom),
        }
    }

    fn call(&self, kernel: Kernel, args: &[NodeId], part: u8) -> String {
        let args: Vec<String> = args.iter().map(|arg| self.of(*arg)).collect();
        match (kernel, part) {
            (Kernel::SinCos, 0) => format!("sin({})", args[0]),
            (Kernel::SinCos, _) => format!("cos({})", args[0]),
            (Kernel::SinCosSum(phase), part) => {
                let function = if part == 0 { "sin" } else { "cos" };
                format!("{function}({} + {})", args[0], number_text(self.graph().number(phase).to_f64()))
            }
            (Kernel::Atan2, _) => format!("atan2({}, {})", args[0], args[1]),
            (Kernel::Unit, part) => format!("{}/|({}, {})|", args[usize::from(part)], args[0], args[1]),
        }
    }

    fn symbol(&self, symbol: Symbol) -> String {
        match symbol {
            Symbol::Parameter(param) => self.model.param(param).name.text.clone(),
            Symbol::Drive(drive) => self.model.drive(drive).name.text.clone(),
            Symbol::Load(load, part) => {
                let load = self.model.load(load);
                let scalar = matches!(load.kind, crate::model::LoadKind::Moment { .. });
                format!("{}{}", load.name, if scalar { "" } else { [".x", ".y"][usize::from(part.min(1))] })
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
