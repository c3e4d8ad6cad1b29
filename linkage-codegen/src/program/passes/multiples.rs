//! Values are found in multiples of themselves where that spares products: not `k x` but `x`, where what is made of it can be found over k as well
//! and constants take that back. So the square of a distance that is opened by `k sin²(ψ/2)` is found over k, and the area of its triangle
//! too, as the constants in both take it; and a moment times a constant, of which a force is made, leaves it to those of the loads' arms.
//!
//! Which values go together is what [`Sizes`] says, in powers of k. A constant that the scalar has exactly, in a sum or as a dividend, is never
//! exchanged for one that it has not.
//!
//! Not where rounding errors are counted, which would have to know of it.

use std::collections::BTreeMap;

use super::sizes::{Scale, Sizes, other_operand, rescaled, resize};
use crate::graph::number::Number;
use crate::graph::{Graph, Label, Op, Scalar};
use crate::program::{Program, ValueId};

pub(super) fn find(mut program: Program, graph: &Graph) -> Program {
    if graph.counts_rounding() {
        return program;
    }
    let mut multiples = Multiples::default();
    let mut ways = ways(&program, graph);
    for value in program.computed().collect::<Vec<_>>() {
        if let Some(scale) = ways.iter().find_map(|sizes| sparing(&program, graph, sizes, value)) {
            multiples.take(&mut program, graph, &scale);
            resize(&mut program, graph, &[scale], BTreeMap::new(), |_, label, _| label.clone());
            ways = self::ways(&program, graph);
        }
    }
    multiples.tell(&mut program);
    super::unused::remove(program, graph)
}

/// What the sizes must satisfy if exact dividends stay as they are, and if others take their place.
fn ways(program: &Program, graph: &Graph) -> [Sizes; 2] {
    let is_exact = |k| program.constant(graph, k).is_some_and(|k| is_exact(&k, graph.scalar()));
    [true, false].map(|stays| Sizes::of(program, &BTreeMap::new(), &|k| stays && is_exact(k)))
}

/// The sizes in which values are found where a product with a constant is its other factor, if products are spared.
fn sparing(program: &Program, graph: &Graph, sizes: &Sizes, product: ValueId) -> Option<Scale> {
    let (k, _) = program.multiple(graph, product)?;
    let scale = Scale { factor: Number::one().div(&k.abs())?, powers: sizes.solve([(product, 1)], &[])? };
    if scale.powers.values().any(|power| power.abs() > HIGHEST) {
        return None;
    }
    let mut spares = false;
    for (value, constant, number) in exchanged(program, graph, &scale) {
        let is_product = matches!(program.op(value), Some(Op::Mul(..)));
        let was_exact = is_exact(&program.constant(graph, constant)?, graph.scalar());
        if !is_moderate(&number, graph.scalar()) || !is_product && was_exact && !is_exact(&number, graph.scalar()) {
            return None;
        }
        spares |= is_product && number.abs().is_one();
    }
    spares.then_some(scale)
}

/// Powers beyond this would make numbers too large or too small of factors that are neither.
const HIGHEST: i32 = 2;

/// The values whose constants change, with the constant and what it becomes.
fn exchanged(program: &Program, graph: &Graph, scale: &Scale) -> Vec<(ValueId, ValueId, Number)> {
    let changed = |value: ValueId| {
        let is_found = |value: &ValueId| scale.powers.contains_key(value);
        let operands = program.op(value).map(Op::operands)?;
        if !is_found(&value) && !operands.iter().any(is_found) {
            return None;
        }
        let (constant, number) = rescaled(program, graph, std::slice::from_ref(scale), value)?;
        Some((value, constant, number))
    };
    program.computed().filter_map(changed).collect()
}

/// Whether a constant is far from the ends of the scalar's range.
fn is_moderate(number: &Number, scalar: Scalar) -> bool {
    let limit = match scalar {
        Scalar::F64 => 1e270,
        Scalar::F32 => 1e30,
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
}

impl Multiples {
    /// Values will be found in these sizes.
    fn take(&mut self, program: &mut Program, graph: &Graph, scale: &Scale) {
        let uses = program.uses();
        for (product, constant, number) in exchanged(program, graph, scale) {
            let Some(op @ Op::Mul(..)) = program.op(product).cloned() else { continue };
            let (Some(rest), Some(label)) = (other_operand(&op, constant), &program.value(product).label) else {
                continue;
            };
            if !number.is_one() {
                continue;
            }
            match &program.value(rest).label {
                Some(of) => {
                    let k = program.constant(graph, constant).map_or(f64::NAN, |k| k.to_f64());
                    self.spared.push((label.name.clone(), format!("{k}·{}", of.name)));
                }
                // It stands in the product's place.
                None if uses[rest.index()] == 1 => {
                    let mut factor = self.factors.get(&product).cloned().unwrap_or_else(Number::one);
                    if !scale.powers.contains_key(&rest) {
                        factor = factor.mul(&power(&scale.factor, scale.powers.get(&product).copied().unwrap_or(0)));
                    }
                    self.factors.insert(rest, factor);
                    program.values[rest.index()].label = Some(label.clone());
                }
                None => {}
            }
        }
        for (value, exponent) in &scale.powers {
            let factor = self.factors.entry(*value).or_insert_with(Number::one);
            *factor = factor.mul(&power(&scale.factor, *exponent));
        }
    }

    /// Names and equations say it.
    fn tell(&self, program: &mut Program) {
        for (index, value) in program.values.iter_mut().enumerate() {
            let Some(Label { name, equation }) = &mut value.label else { continue };
            for (spared, product) in &self.spared {
                *equation = with_word(equation, spared, product);
            }
            if let Some(factor) = self.factors.get(&ValueId::new(index)).filter(|factor| !factor.is_one()) {
                let of = if equation.is_empty() { &*name } else { &*equation };
                *equation = format!("{of}, {}", in_words(factor.to_f64()));
                name.push_str(MULTIPLE);
            }
        }
    }
}

fn power(factor: &Number, exponent: i32) -> Number {
    let power = factor.pow(exponent.unsigned_abs());
    if exponent < 0 { Number::one().div(&power).unwrap_or(power) } else { power }
}

fn in_words(factor: f64) -> String {
    if factor < 1.0 { format!("over {}", factor.recip()) } else { format!("times {factor}") }
}

/// A text with another word in the place of one.
fn with_word(text: &str, word: &str, other: &str) -> String {
    let is_inside = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let mut changed = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(word) {
        let (before, after) = (&rest[..at], &rest[at + word.len()..]);
        let is_word = !is_inside(before.chars().next_back()) && !is_inside(after.chars().next());
        changed.push_str(before);
        changed.push_str(if is_word { other } else { word });
        rest = after;
    }
    changed + rest
}

#[cfg(test)]
mod tests {
    use super::{in_words, with_word};

    #[test]
    fn only_words_are_exchanged() {
        assert_eq!(with_word("D2_B + p_B p_B2 sp_B, p_B", "p_B", "3·x"), "D2_B + 3·x p_B2 sp_B, 3·x");
        assert_eq!(with_word("", "p_B", "x"), "");
    }

    #[test]
    fn factors_in_words() {
        assert_eq!([in_words(0.25), in_words(2.5)], ["over 4", "times 2.5"]);
    }
}
