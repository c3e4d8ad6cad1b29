//! Values are found in multiples of themselves where that spares products: not `k x` but `x`, where what is made of it can be found over k as well
//! and constants take that back. So a moment times a constant, of which a force is made, is found without it: the constants of the loads' arms
//! have it then.
//!
//! Which values go together is what [`Sizes`] says, in powers of k. A constant that the scalar has exactly, in a sum or as a dividend, is never
//! exchanged for one that it has not. What a root or an angle is taken of keeps its size, and all that it is made of: next to a dead centre the
//! pose hangs on their roundings, which this leaves as they are, and a wanted motion has the same drive with its rate and without.
//!
//! Not where rounding errors are counted, which would have to know of it.

use std::collections::{BTreeMap, BTreeSet};

use super::sizes::{Constant, Order, Scale, Sizes, exchange, factor_beside};
use crate::graph::number::Number;
use crate::graph::{Graph, Kernel, Label, Op, Scalar};
use crate::program::{Program, ValueId};

pub(super) fn find(mut program: Program, graph: &Graph) -> Program {
    if program.counts_rounding {
        return program;
    }
    let mut search = Search::of(&program, graph);
    for value in program.computed() {
        search.spare(value);
    }
    let Search { changed, found, .. } = search;
    found.tell(&mut program);
    exchange(&mut program, graph, &changed, BTreeMap::new());
    super::unused::remove(program, graph)
}

/// For the sizes in which values are found.
struct Search<'p> {
    program: &'p Program,
    graph: &'p Graph,
    scalar: Scalar,
    /// What the sizes must satisfy if exact dividends stay as they are, and if others take their place.
    ways: [Sizes; 2],
    /// What is made of each value.
    readers: Vec<Vec<ValueId>>,
    uses: Vec<usize>,
    /// The constants of operations, as they are by now.
    constants: Vec<Option<Constant>>,
    /// Those that have changed.
    changed: BTreeMap<ValueId, Constant>,
    found: Multiples,
}

impl<'p> Search<'p> {
    fn of(program: &'p Program, graph: &'p Graph) -> Self {
        let scalar = graph.scalar();
        let mut constants = vec![None; program.values.len()];
        program.computed().for_each(|value| constants[value.index()] = Constant::of(program, graph, value));
        let ways = [sizes_by_exact(program, graph, &constants), sizes(program, graph, &|_| false)];
        let (changed, found) = (BTreeMap::new(), Multiples::default());
        let (readers, uses) = (program.readers(), program.uses());
        Self { program, graph, scalar, ways, readers, uses, constants, changed, found }
    }

    /// Leaves out a product with a constant, if values can be found in sizes that allow it.
    fn spare(&mut self, product: ValueId) {
        if !self.costs_a_product(product) {
            return;
        }
        let factor = match &self.constants[product.index()] {
            Some(k) if !k.number.abs().is_one() => Number::one().div(&k.number.abs()),
            _ => None,
        };
        let Some(factor) = factor else { return };
        let ways = self.ways.iter().flat_map(|sizes| [(sizes, Order::FirstMade), (sizes, Order::LastMade)]);
        let found = ways.filter_map(|(sizes, order)| {
            let scale = Scale { factor: factor.clone(), powers: sizes.solve_near(product, order)? };
            let (spares, changed) = self.changed_by(&scale)?;
            Some((spares, scale, changed))
        });
        // Of ways that spare as many the first one.
        let best = found.reduce(|best, other| if other.0 > best.0 { other } else { best });
        if let Some((_, scale, changed)) = best {
            self.take(&scale, changed);
        }
    }

    /// Whether a value is a product that costs something: not one that is but added to constants without being rounded.
    fn costs_a_product(&self, value: ValueId) -> bool {
        let is_beside_constant = |sum: &ValueId| self.program.adds_constant(self.graph, *sum);
        // As a result, and for a check, it has to be known itself.
        let readers = &self.readers[value.index()];
        let is_added = || readers.len() == self.uses[value.index()] && readers.iter().all(is_beside_constant);
        matches!(self.program.op(value), Some(Op::Mul(..))) && !(self.graph.is_fused() && is_added())
    }

    /// How many products are spared, if any are, and the constants that change, if they may.
    fn changed_by(&self, scale: &Scale) -> Option<(usize, Vec<(ValueId, Constant)>)> {
        let (mut changed, mut spares) = (Vec::new(), 0);
        for value in scale.touched(&self.readers) {
            let Some(before) = &self.constants[value.index()] else { continue };
            let Some(number) = scale.of(before) else { continue };
            let is_product = matches!(self.program.op(value), Some(Op::Mul(..)));
            let stays_exact = !is_exact(&before.number, self.scalar) || is_exact(&number, self.scalar);
            if !is_moderate(&number, self.scalar) || !is_product && !stays_exact {
                return None;
            }
            spares += usize::from(self.costs_a_product(value) && number.abs().is_one());
            changed.push((value, Constant { number, ..before.clone() }));
        }
        (spares > 0).then_some((spares, changed))
    }

    /// Values are found in these sizes. From now on what is a product no more has the size of its factor.
    fn take(&mut self, scale: &Scale, changed: Vec<(ValueId, Constant)>) {
        for (value, constant) in changed {
            if let Some(rest) = self.program.op(value).and_then(|op| factor_beside(op, &constant)) {
                self.ways.iter_mut().for_each(|sizes| sizes.equate(vec![(value, 1), (rest, -1)]));
                if constant.number.is_one() {
                    self.spared(value, rest);
                }
            }
            // A dividend that is exact by now stays as it is from now on; it was not before, or it would not have changed.
            if let Some(Op::Div(dividend, divisor)) = self.program.op(value)
                && self.program.constant(self.graph, *dividend).is_some()
                && is_exact(&constant.number, self.scalar)
            {
                self.ways[0].equate(vec![(value, 1), (*divisor, 1)]);
            }
            self.constants[value.index()] = Some(constant.clone());
            self.changed.insert(value, constant);
        }
        for (value, exponent) in &scale.powers {
            let factor = self.found.factors.entry(*value).or_insert_with(Number::one);
            *factor = factor.mul(&power(&scale.factor, *exponent));
        }
    }

    /// What a product that is left out was called: its other factor is, or where this has a name, equations have the product.
    fn spared(&mut self, product: ValueId, rest: ValueId) {
        let named = self.found.named(product);
        let Some(label) = &self.program.value(named).label else { return };
        match (&self.program.value(rest).label, self.program.multiple(self.graph, product)) {
            (Some(of), Some((k, _))) => {
                self.found.spared.push((label.name.clone(), format!("{}·{}", k.to_f64(), of.name)));
            }
            (None, _) if self.uses[rest.index()] == 1 => drop(self.found.renamed.insert(rest, product)),
            _ => {}
        }
    }
}

/// How the sizes of values go together, where the dividends of some stay as they are.
fn sizes(program: &Program, graph: &Graph, stays: &dyn Fn(ValueId) -> bool) -> Sizes {
    let mut sizes = Sizes::of(program, graph, &BTreeMap::new(), stays);
    sizes.keep(program.computed().filter_map(|value| program.op(value)).flat_map(|op| match op {
        Op::Sqrt(_) | Op::Kernel { kernel: Kernel::Atan2, .. } => op.operands(),
        _ => Vec::new(),
    }));
    sizes.settled()
}

/// The same where exact dividends stay as they are.
fn sizes_by_exact(program: &Program, graph: &Graph, constants: &[Option<Constant>]) -> Sizes {
    let scalar = graph.scalar();
    sizes(program, graph, &|value| constants[value.index()].as_ref().is_some_and(|k| is_exact(&k.number, scalar)))
}

/// Whether a constant is far from the ends of the scalar's range.
fn is_moderate(number: &Number, scalar: Scalar) -> bool {
    let limit = match scalar {
        Scalar::F64 => 1e270,
        Scalar::F32 => 1e36,
    };
    number.is_zero() || (1.0 / limit..limit).contains(&number.nearest(scalar).abs())
}

/// Whether the scalar has the number itself.
fn is_exact(number: &Number, scalar: Scalar) -> bool {
    Number::from_f64(number.nearest(scalar)).is_some_and(|nearest| nearest.sub(number).is_zero())
}

/// How the names of values end that are found in multiples.
pub(super) const MULTIPLE: &str = "_scaled";

/// What the derivation says of values that are found in multiples.
#[derive(Default)]
struct Multiples {
    /// By what they are multiplied.
    factors: BTreeMap<ValueId, Number>,
    /// Names of products that are spared, each with what stands for it in equations.
    spared: Vec<(String, String)>,
    /// Values without names, with the products in whose places they stand.
    renamed: BTreeMap<ValueId, ValueId>,
}

impl Multiples {
    /// The value of whose name a value has the name.
    fn named(&self, mut value: ValueId) -> ValueId {
        while let Some(product) = self.renamed.get(&value) {
            value = *product;
        }
        value
    }

    /// Names and equations say it.
    fn tell(&self, program: &mut Program) {
        for rest in self.renamed.keys() {
            program.values[rest.index()].label = program.value(self.named(*rest)).label.clone();
        }
        let spared: BTreeMap<&str, usize> =
            self.spared.iter().enumerate().map(|(index, (name, _))| (&**name, index)).collect();
        let spared_in = |text: &str| words(text).filter_map(|word| spared.get(word).copied()).collect::<BTreeSet<_>>();
        for (index, value) in program.values.iter_mut().enumerate() {
            let Some(label) = &mut value.label else { continue };
            let equation = &mut label.equation;
            let mut met = spared_in(equation);
            while let Some(last) = met.pop_last() {
                let (name, product) = &self.spared[last];
                *equation = with_word(equation, name, product);
                // What stands for one may have the name of another that was spared before.
                met.extend(spared_in(product).range(..last));
            }
            let named = self.named(ValueId::new(index));
            if let Some(factor) = self.factors.get(&named).filter(|factor| !factor.is_one()) {
                tell_factor(label, factor);
            }
        }
    }
}

/// Name and equation say that the value is found times a factor.
pub(super) fn tell_factor(Label { name, equation }: &mut Label, factor: &Number) {
    let of = if equation.is_empty() { &*name } else { &*equation };
    *equation = format!("{of}, {}", in_words(factor));
    if !name.ends_with(MULTIPLE) {
        name.push_str(MULTIPLE);
    }
}

fn power(factor: &Number, exponent: i32) -> Number {
    let power = factor.pow(exponent.unsigned_abs());
    if exponent < 0 { Number::one().div(&power).unwrap_or(power) } else { power }
}

fn in_words(factor: &Number) -> String {
    let words = match Number::one().div(factor).filter(|_| factor.compare(&Number::one()).is_lt()) {
        Some(divisor) => format!("over {}", divisor.to_f64()),
        None => format!("times {}", factor.to_f64()),
    };
    words.replace('-', "−")
}

/// Whether a character may be one of a name.
fn is_inside(c: char) -> bool {
    c == '_' || c.is_ascii_alphanumeric() || (!c.is_ascii() && c.is_alphabetic())
}

/// The names in a text.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c| !is_inside(c))
}

/// A text with a product in the place of a word, in brackets where it is divided by or raised to a power.
fn with_word(text: &str, word: &str, product: &str) -> String {
    let is_power = |c: char| matches!(c, '²' | '³' | '^');
    let (mut changed, mut end) = (String::new(), 0);
    for (at, _) in text.match_indices(word) {
        let (before, after) = (text[..at].chars().next_back(), text[at + word.len()..].chars().next());
        if before.is_some_and(is_inside) || after.is_some_and(is_inside) {
            continue;
        }
        changed.push_str(&text[end..at]);
        let is_bound = before.is_some_and(|c| matches!(c, '/' | '√')) || after.is_some_and(is_power);
        changed.push_str(&if is_bound { format!("({product})") } else { product.to_owned() });
        end = at + word.len();
    }
    changed + &text[end..]
}

#[cfg(test)]
mod tests {
    use super::{Number, in_words, with_word};

    #[test]
    fn only_words_are_exchanged() {
        assert_eq!(with_word("D2_B + p_B p_B2 sp_B, p_B", "p_B", "3·x"), "D2_B + 3·x p_B2 sp_B, 3·x");
        assert_eq!(with_word("p_B/p_B + p_B² − √p_B", "p_B", "3·x"), "3·x/(3·x) + (3·x)² − √(3·x)");
        assert_eq!([with_word("aa", "a", "b"), with_word("", "p_B", "x")], ["aa", ""]);
    }

    #[test]
    fn factors_in_words() {
        let words = [(1, 4), (5, 2), (1, 1_690_000)].map(|(n, d)| in_words(&Number::ratio(n, d)));
        assert_eq!(words, ["over 4", "times 2.5", "over 1690000"]);
    }
}
