//! Multiples of one value in a sum are one multiple of it, with the constants added when compiled: `(k₁ x + y) − k₂ x = (k₁ − k₂) x + y`, where
//! nothing else reads the terms. So a point that is reached along a link by way of one of its pins is reached straight, and the inertia of a
//! link's turning and that of its centre of mass have one factor.
//!
//! The graph adds like terms of short sums while they are written; here those meet that stand further apart, or had another name. What is the
//! rounding of its term stays by itself: in the sum of the constants it would be lost. So does what is small beside a term without a
//! rounding of its own, of which little may be left in the sum; it would be rounded then. And nothing is added where rounding errors are
//! counted, which would have to know of it.

use crate::graph::number::Number;
use crate::graph::{Graph, Op};
use crate::program::{Program, Step, ValueId};

pub(super) fn add(program: Program, graph: &Graph) -> Program {
    if program.counts_rounding {
        return program;
    }
    let uses = program.uses();
    let mut adding = Adding { graph, program, uses, steps: Vec::new() };
    for step in core::mem::take(&mut adding.program.steps) {
        if let Step::Let(value) = step {
            adding.sum(value);
        }
        adding.steps.push(step);
    }
    adding.program.steps = adding.steps;
    super::unused::remove(adding.program, graph)
}

struct Adding<'g> {
    graph: &'g Graph,
    program: Program,
    uses: Vec<usize>,
    steps: Vec<Step>,
}

/// A sum by its terms.
enum Sum {
    Term(Term),
    /// A sum or a difference, as it is computed now.
    Of {
        value: ValueId,
        terms: Box<[Sum; 2]>,
        minus: bool,
    },
}

/// A multiple of a value, as it is computed now; behind like terms are added with their constants.
struct Term {
    value: ValueId,
    k: Number,
    of: ValueId,
    /// What it is to be multiplied by; nothing is left of a term that another one has taken.
    becomes: Option<Number>,
}

impl Adding<'_> {
    /// Adds the like terms of a sum.
    fn sum(&mut self, value: ValueId) {
        let Some((terms, minus)) = self.program.op(value).and_then(Op::terms) else { return };
        let mut sum = Sum::Of { value, terms: Box::new(terms.map(|term| self.read(term))), minus };
        if !sum.merge(self.graph.scalar().epsilon().to_f64()) {
            return;
        }
        let before = self.steps.len();
        let whole = match self.write(&sum) {
            Some((true, opposite)) => Some(self.add(Op::Neg(opposite), value)),
            Some((false, whole)) => Some(whole),
            None => None,
        };
        // What was added for the whole is its definition now.
        if let (Some(whole), Some(Step::Let(last))) = (whole, self.steps[before..].last())
            && whole == *last
        {
            self.steps.pop();
            self.program.values[value.index()].definition = self.program.value(whole).definition.clone();
        } else {
            self.steps.truncate(before);
        }
    }

    /// The terms of what a sum reads.
    fn read(&self, value: ValueId) -> Sum {
        let is_inner = |value| self.program.is_inner(value, &self.uses);
        if is_inner(value)
            && let Some((terms, minus)) = self.program.op(value).and_then(Op::terms)
        {
            return Sum::Of { value, terms: Box::new(terms.map(|term| self.read(term))), minus };
        }
        let (mut k, mut of) = (Number::one(), value);
        while is_inner(of) {
            (k, of) = match (self.program.op(of), self.program.multiple(self.graph, of)) {
                (Some(Op::Neg(x)), _) => (k.neg(), *x),
                (_, Some((own, x))) => (k.mul(&own), x),
                _ => break,
            };
        }
        Sum::Term(Term { value, becomes: Some(k.clone()), k, of })
    }

    /// The sum of what is left of its terms, if anything is: whether it is the opposite of a value, and which.
    fn write(&mut self, sum: &Sum) -> Option<(bool, ValueId)> {
        match sum {
            Sum::Term(Term { value, k, of, becomes }) => {
                let becomes = becomes.as_ref().filter(|becomes| !becomes.is_zero())?;
                if becomes.compare(k).is_eq() {
                    return Some((false, *value));
                }
                let (negative, size) = (becomes.signum() < 0, becomes.abs());
                if size.is_one() {
                    return Some((negative, *of));
                }
                let constant = self.program.add_constant(self.graph, &size, *value);
                Some((negative, self.add(Op::Mul(constant, *of), *value)))
            }
            Sum::Of { value, terms, minus } => {
                let [a, b] = terms.each_ref().map(|term| self.write(term));
                let b = b.map(|(negative, b)| (negative != *minus, b));
                let (Some((of_a, a)), Some((of_b, b))) = (a, b) else { return a.or(b) };
                let (negative, op) = match (of_a, of_b) {
                    (true, false) => (false, Op::Sub(b, a)),
                    (true, true) => (true, Op::Add(a, b)),
                    (false, minus) => (false, Op::of_terms([a, b], minus)),
                };
                let is_there = self.program.op(*value) == Some(&op);
                Some((negative, if is_there { *value } else { self.add(op, *value) }))
            }
        }
    }

    /// A new value, which one other reads.
    fn add(&mut self, op: Op<ValueId>, beside: ValueId) -> ValueId {
        let value = self.program.add(op, beside);
        self.uses.resize(value.index() + 1, 1);
        self.steps.push(Step::Let(value));
        value
    }
}

impl Sum {
    /// Whether like terms were found: each goes to the first of its kind.
    fn merge(&mut self, epsilon: f64) -> bool {
        let mut terms = Vec::new();
        self.signed(false, &mut terms);
        let (mut known, mut merged): (Vec<(bool, &mut Term)>, bool) = (Vec::new(), false);
        for (negative, term) in terms {
            let like = known.iter_mut().find(|(other_negative, other)| {
                let k = if negative == *other_negative { term.k.clone() } else { term.k.neg() };
                other.of == term.of && other.becomes.as_ref().is_some_and(|own| are_added(own, &k, epsilon))
            });
            match like {
                Some((other_negative, other)) => {
                    let k = if negative == *other_negative { term.k.clone() } else { term.k.neg() };
                    other.becomes = other.becomes.take().map(|own| own.add(&k));
                    term.becomes = None;
                    merged = true;
                }
                None => known.push((negative, term)),
            }
        }
        merged
    }

    /// All terms, and whether each is subtracted.
    fn signed<'s>(&'s mut self, negative: bool, found: &mut Vec<(bool, &'s mut Term)>) {
        match self {
            Self::Term(term) => found.push((negative, term)),
            Self::Of { terms, minus, .. } => {
                let [a, b] = &mut **terms;
                a.signed(negative, found);
                b.signed(negative != *minus, found);
            }
        }
    }
}

/// Whether two constants of one value may be one, and that takes an operation less.
fn are_added(one: &Number, other: &Number, epsilon: f64) -> bool {
    let is_product = |k: &Number| !k.abs().is_one();
    let is_exact = |size: f64| size.to_bits().trailing_zeros() >= f64::MANTISSA_DIGITS - 1;
    let mut sizes = [one.to_f64().abs(), other.to_f64().abs()];
    sizes.sort_by(f64::total_cmp);
    let [small, large] = sizes;
    let least = if is_exact(large) && one.signum() == other.signum() { 1.0 / 16.0 } else { 4.0 * epsilon };
    (is_product(one) || is_product(other)) && small > least * large
}

#[cfg(test)]
mod tests {
    use super::{Graph, Number, Op, Program, Step, ValueId, add};
    use crate::graph::{Scalar, Symbol};
    use crate::model::ids::ParamId;
    use crate::program::{Definition, Input, Value};

    /// A sum in the making: of the parameters x and y.
    struct Making {
        graph: Graph,
        program: Program,
    }

    impl Making {
        fn value(&mut self, definition: Definition) -> ValueId {
            let section = String::new();
            self.program.values.push(Value {
                definition,
                label: None,
                section,
                divided: false,
                component: None,
                within: None,
            });
            ValueId::new(self.program.values.len() - 1)
        }

        fn input(&mut self, index: usize) -> ValueId {
            self.value(Definition::Input(Input::Symbol(Symbol::Parameter(ParamId::new(index)))))
        }

        fn computed(&mut self, op: Op<ValueId>) -> ValueId {
            let value = self.value(Definition::Computed(op));
            self.program.steps.push(Step::Let(value));
            value
        }

        fn times(&mut self, k: f64, of: ValueId) -> ValueId {
            let number = self.graph.intern_number(&Number::from_f64(k).unwrap());
            let constant = self.value(Definition::Computed(Op::Constant(number)));
            self.computed(Op::Mul(constant, of))
        }

        fn text(&self, value: ValueId) -> String {
            match self.program.op(value) {
                None => ["x", "y"][value.index()].to_owned(),
                Some(Op::Constant(number)) => self.graph.number(*number).to_f64().to_string(),
                Some(Op::Mul(a, b)) => format!("{}{}", self.text(*a), self.text(*b)),
                Some(Op::Neg(a)) => format!("-({})", self.text(*a)),
                Some(op) => {
                    let ([a, b], minus) = op.terms().expect("a sum");
                    format!("({} {} {})", self.text(a), if minus { '-' } else { '+' }, self.text(b))
                }
            }
        }
    }

    /// What becomes of the sum that this makes of x and y.
    fn after(make: impl Fn(&mut Making, ValueId, ValueId) -> ValueId) -> String {
        let mut making = Making { graph: Graph::new(Scalar::F64), program: Program::default() };
        let [x, y] = [0, 1].map(|index| making.input(index));
        let sum = make(&mut making, x, y);
        making.program.outputs.push(("sum".to_owned(), sum));
        making.program = add(core::mem::take(&mut making.program), &making.graph);
        let uses = making.program.uses();
        assert!(making.program.computed().all(|value| uses[value.index()] > 0));
        making.text(sum)
    }

    #[test]
    fn like_terms_are_one() {
        let text = after(|making, x, y| {
            let [a, b, c] = [(2.0, x), (5.0, y), (3.0, x)].map(|(k, of)| making.times(k, of));
            let first = making.computed(Op::Add(a, b));
            making.computed(Op::Add(first, c))
        });
        assert_eq!(text, "(5x + 5y)");
        // What is subtracted within what is subtracted is added; a term is its own multiple by one.
        let text = after(|making, x, y| {
            let a = making.times(3.0, x);
            let inner = making.computed(Op::Sub(y, a));
            making.computed(Op::Sub(x, inner))
        });
        assert_eq!(text, "(4x - y)");
        // Terms may cancel, and nothing then is left of their sum.
        let text = after(|making, x, y| {
            let [a, b, c, d] = [(3.0, x), (2.0, y), (3.0, x), (7.0, y)].map(|(k, of)| making.times(k, of));
            let [first, second] = [Op::Add(a, b), Op::Sub(c, d)].map(|sum| making.computed(sum));
            making.computed(Op::Sub(first, second))
        });
        assert_eq!(text, "9y");
    }

    #[test]
    fn what_would_be_lost_or_rounded_stays() {
        let sum = |k: f64, own: Option<f64>| {
            after(|making, x, y| {
                let small = making.times(k, x);
                let term = own.map_or(x, |own| making.times(own, x));
                let rest = making.computed(Op::Sub(term, y));
                making.computed(Op::Add(rest, small))
            })
        };
        // The rounding of a term, and a small part of one that has no rounding of its own.
        assert_eq!(sum(1e-16, Some(3.0)), "((3x - y) + 0.0000000000000001x)");
        assert_eq!(sum(0.01, None), "((x - y) + 0.01x)");
        assert_eq!(
            [sum(0.01, Some(3.0)), sum(-0.01, None), sum(0.5, None)],
            ["(3.01x - y)", "(0.99x - y)", "(1.5x - y)"]
        );
        assert_eq!([sum(-3.0, Some(2.0)), sum(-4.0, Some(2.0))], ["-((x + y))", "-((2x + y))"]);
    }

    #[test]
    fn what_spares_nothing_or_is_counted_stays() {
        let twice = |other_reads: bool, counts_rounding: bool| {
            after(|making, x, y| {
                let a = making.times(2.0, x);
                let b = if other_reads { a } else { making.times(3.0, x) };
                if other_reads {
                    let own = making.computed(Op::Mul(a, y));
                    making.program.outputs.push(("product".to_owned(), own));
                }
                let first = making.computed(Op::Add(a, y));
                making.program.counts_rounding = counts_rounding;
                making.computed(Op::Add(first, b))
            })
        };
        assert_eq!(twice(true, false), "((2x + y) + 2x)");
        assert_eq!(twice(false, true), "((2x + y) + 3x)");
        assert_eq!(twice(false, false), "(5x + y)");
        let text = after(|making, x, y| {
            let first = making.computed(Op::Add(x, y));
            making.computed(Op::Add(first, x))
        });
        assert_eq!(text, "((x + y) + x)");
    }
}
