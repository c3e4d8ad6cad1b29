//! A constant factor of a moment goes to the arm: `k (p F_y − q F_x) = (k p) F_y − (k q) F_x`, where p = a u ± b v and q, the arm turned into
//! ground axes, have constants that take it, and nothing else reads them but moments with the same factor.
//!
//! Bounds of errors count on what is multiplied here: before signs are absorbed, on sums as the graph has them.
//!
//! A moment over a length is `1/l (arm × F)`. Where the way to the next group goes along the arm, it is there anyway, and one product brings
//! the moment to the length. Where the arm is there for the moment alone, that product is spared.

use std::collections::{BTreeMap, BTreeSet};

use crate::graph::number::Number;
use crate::graph::{Graph, Op};
use crate::program::{Definition, Program, Step, ValueId};

pub(super) fn scale(mut program: Program, graph: &Graph) -> Program {
    let uses = program.uses();
    let mut moments: Vec<Moment> =
        program.computed().filter_map(|value| moment(&program, graph, &uses, value)).collect();
    loop {
        let before = moments.len();
        let arms = arms(&moments);
        let is_read_by_them = |arm: &ValueId| arms[arm].as_ref().is_some_and(|(_, reads)| *reads == uses[arm.index()]);
        // A moment that is itself a term of an arm stays as it is.
        let terms = arms.keys().filter_map(|arm| program.op(*arm).and_then(Op::terms)).flat_map(|(terms, _)| terms);
        let terms: BTreeSet<ValueId> = terms.collect();
        moments.retain(|moment| moment.arm.iter().all(is_read_by_them) && !terms.contains(&moment.value));
        if moments.len() == before {
            break;
        }
    }
    for (arm, factor) in arms(&moments) {
        let Some((terms, minus)) = program.op(arm).and_then(Op::terms) else { continue };
        let Some((k, _)) = factor else { continue };
        let terms = terms.map(|term| match program.multiple(graph, term) {
            Some((constant, of)) if k.mul(&constant).is_one() => of,
            Some((constant, of)) => {
                let constant = program.add_constant(graph, &k.mul(&constant), term);
                program.values[term.index()].definition = Definition::Computed(Op::Mul(constant, of));
                term
            }
            None => term,
        });
        program.values[arm.index()].definition = Definition::Computed(Op::of_terms(terms, minus));
    }
    for Moment { value, sum, .. } in &moments {
        program.values[value.index()].definition = program.values[sum.index()].definition.clone();
    }
    let sums: BTreeSet<ValueId> = moments.iter().map(|moment| moment.sum).collect();
    program.steps.retain(|step| !matches!(step, Step::Let(value) if sums.contains(value)));
    program
}

/// `value = k sum`, the sum one of products with the components of an arm.
struct Moment {
    value: ValueId,
    k: Number,
    sum: ValueId,
    arm: [ValueId; 2],
}

/// The components of arms, each with its factor and how many moments read it; nothing where they have different factors.
fn arms(moments: &[Moment]) -> BTreeMap<ValueId, Option<(Number, usize)>> {
    let mut arms: BTreeMap<ValueId, Option<(Number, usize)>> = BTreeMap::new();
    for Moment { k, arm, .. } in moments {
        for component in arm {
            let known = arms.entry(*component).or_insert_with(|| Some((k.clone(), 0)));
            *known = known.take().filter(|(other, _)| other.compare(k).is_eq()).map(|(k, reads)| (k, reads + 1));
        }
    }
    arms
}

fn moment(program: &Program, graph: &Graph, uses: &[usize], value: ValueId) -> Option<Moment> {
    let Op::Mul(k, sum) = program.op(value)? else { return None };
    let k = program.constant(graph, *k)?;
    let (terms, _) = program.op(*sum).filter(|_| program.is_inner(*sum, uses))?.terms()?;
    let component = |product: ValueId| match program.op(product) {
        Some(Op::Mul(a, b)) if program.is_inner(product, uses) => {
            [*a, *b].into_iter().find(|factor| is_component(program, graph, uses, *factor))
        }
        _ => None,
    };
    Some(Moment { value, k, sum: *sum, arm: [component(terms[0])?, component(terms[1])?] })
}

/// Whether a value without a name is a sum of two multiples by constants, which nothing else reads.
fn is_component(program: &Program, graph: &Graph, uses: &[usize], value: ValueId) -> bool {
    let is_multiple = |term: &ValueId| program.is_inner(*term, uses) && program.multiple(graph, *term).is_some();
    let terms = program.op(value).and_then(Op::terms);
    program.value(value).label.is_none() && terms.is_some_and(|(terms, _)| terms.iter().all(is_multiple))
}
