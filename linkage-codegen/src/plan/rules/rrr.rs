//! The RRR dyad: two links, a pin between them, a pin at each outer end.
//!
//! With the outer pins P and Q, the inner pin B, `r₁ = |PB|`, `r₂ = |QB|`, `d = Q − P`, `D² = d·d`, `S = r₁ + r₂`, `M = r₁ − r₂`:
//!
//! ```text
//! p = S² − D²    q = D² − M²    K = ±√(p q) = 2 r₁ r₂ sin μ         + where B is on the left of P → Q
//! u₁ = [(D² + r₁² − r₂²) d + K d⊥] / (2 r₁ D²)                       direction P → B
//! u₂ = [−(D² − r₁² + r₂²) d + K d⊥] / (2 r₂ D²)                      direction Q → B
//! ```
//!
//! each as the vector along the link, `v = ±sum e + K e⊥` by `e = d/(2D²)`, which does not wait for the root, brought to unit size: by one
//! step `v (3 − v·v/r²)/(2r)` where constant lengths are not too different. Where they are of the same order, the vector along the longer
//! link is that along the shorter one and d, `r₁u₁ − r₂u₂ = d`. If moreover neither is more than twice as long as the other, the vectors have
//! their lengths but for a few roundings: `sum`, `K` and `e` are exact to a few roundings of `r D`, `r D` and `1/D`, however close the pins come
//! or the links fold. Where only what is made of them is wanted, that along the second link then serves as it is (pass `lengths`): forces and
//! velocities have its few roundings once. Those of the first link, along which forces are resolved, they would have twice; so there only
//! the moments of the loads are found of the vector as it is, and need not wait for the step.
//!
//! Of legs of the same length `sum e` is `±d/2`.
//!
//! `sin μ = u₁ × u₂` is the pivot of velocities and forces, and near its zeros the closure knows it better than the directions do, as
//! `K/(2 r₁ r₂)`. Where one link is much shorter than the other one, or may be as lengths are given at run time, it is found of the directions
//! as they are, or of the vectors along the links.
//!
//! Where moreover a driven angle ψ opens the outer pins, `D² = (b − a)² + 4ab sin²(ψ/2)`, all areas are divided when the linkage is
//! compiled, so that the root is `sin μ` at once: by `2 r₁ r₂`, or at a fold so that `cos(ψ/2)` or `sin(ψ/2)` is left of the one margin and
//! all factors are in the other. There `cos μ = u₁ · u₂ = (r₁² + r₂² − D²)/(2 r₁ r₂)` is one subtraction; where the links fold stretched
//! only, it is found of cos²(ψ/2) instead, which vanishes there, and nothing is lost beside the −1.
//!
//! In a parallelogram that moves through its folds smoothly, each link keeps the direction of the arm opposite to it, and nothing is solved for.
//!
//! Where a drive gives the length of one link, `r₁² = x² + y²` with a constant y, and D and r₂ are constants, the same four factors are
//! taken together as `p = (D + r₂)² − r₁²`, `q = r₁² − (D − r₂)²`: there the constants fold. The drive's line is turned from the leg by the
//! constant y, and from the other leg by the sum of that angle and μ, whose sine and cosine follow from those of both.
//!
//! Forces, by the textbooks' resolution along and across the links: with `m₁`, `m₂` the moments of the loads about P and Q, the
//! force F on the first link at B has across it `t = −m₁/r₁` and, from `u₂ × F = m₂/r₂`, along it `N = (t cos μ − m₂/r₂)/sin μ`. Where
//! `m₂ = 0` the second link is held by two forces alone, which go along it: `F = t/sin μ u₂`.

mod by_half_angle;

use by_half_angle::{by_half_angle, half_angle, not_opened};

use super::dyad::{Dyad, Leg, difference, dyad};
use super::{Rule, RuleResult};
use crate::diagnostics::Diagnostic;
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Scalar, Vector};
use crate::model::{Closure, End, Model, Side};
use crate::plan::assembly::{Assembly, ClosedLoop, DyadPivot, Found, Pivot, Sign};
use crate::plan::balance::Balance;
use crate::plan::framed::Framed;
use crate::plan::placement::{Spot, Way};
use crate::plan::velocities::Motion;
use crate::topology::Group;

/// The rule.
pub(super) struct Rrr;

/// The group as an RRR dyad, if it is one. Its first leg is the one whose outer pin the closure names first.
#[must_use]
pub fn pinned_dyad<'a>(model: &'a Model, group: &Group) -> Option<Dyad<'a>> {
    let mut dyad = dyad(model, group).filter(|dyad| dyad.pins() == [true; 3])?;
    let closure = model.closure_at(dyad.inner, &group.outer).map(|id| model.closure(id));
    if closure.is_some_and(|c| c.of.first() == Some(&dyad.legs[1].outer)) {
        dyad.legs.swap(0, 1);
    }
    Some(dyad)
}

impl<'a> Dyad<'a> {
    /// The outer pins, on the links outside the group.
    fn outer_spots(&self) -> [Spot; 2] {
        self.legs.each_ref().map(|leg| leg.far)
    }

    /// The same, if they do not move along slots there.
    #[must_use]
    pub fn outer_ends(&self) -> Option<[End; 2]> {
        let spots = self.outer_spots();
        spots.iter().all(|spot| spot.slot.is_none()).then(|| spots.map(|spot| spot.end))
    }

    fn check_lengths(&self) -> RuleResult {
        self.legs.iter().try_for_each(|leg| self.check_length(leg))
    }

    fn lengths(&self) -> [Expr<'a>; 2] {
        self.legs.each_ref().map(|leg| self.length(leg))
    }

    /// Whether one leg may be much longer than the other one: by their constants, or as parameters give them, if not the same to both. The
    /// length of a driven leg has a rounding of its own, which is in its vector too.
    fn may_be_unlike(&self) -> bool {
        let [r1, r2] = self.lengths();
        let driven = self.legs.iter().any(|leg| !leg.is_constant(self.model));
        !driven && !lead_by_arms(r1, r2) && !(r1 - r2).is_zero()
    }

    fn other(&self, leg: &Leg) -> &Leg {
        &self.legs[usize::from(leg.link() == self.legs[0].link())]
    }

    /// The length of a leg as text: `|A B|`.
    fn length_name(&self, leg: &Leg) -> String {
        format!("|{} {}|", self.joint_name(leg.outer), self.joint_name(self.inner))
    }

    fn sum_name(&self) -> String {
        let [first, second] = self.legs.each_ref().map(|leg| self.length_name(leg));
        format!("{first} + {second}")
    }

    fn cosine_meaning(&self) -> String {
        let [first, second] = self.legs.each_ref().map(|leg| self.link_name(leg));
        format!("cos μ between {first} and {second}")
    }

    /// `2 r₁ r₂` as text.
    fn area_name(&self) -> String {
        let [first, second] = self.legs.each_ref().map(|leg| self.length_name(leg));
        format!("(2 {first} {second})")
    }

    fn difference_name(&self) -> String {
        let [first, second] = self.legs.each_ref().map(|leg| self.length_name(leg));
        format!("{first} − {second}")
    }

    /// `±(D² + r² − r'²)` of a leg r, over a divisor given as text: positive where it goes along d, from the first outer pin to the second.
    fn name_sum(&self, leg: &Leg, sum: Expr<'a>, divided: &str) -> Expr<'a> {
        let (mine, its) = (self.length_name(leg), self.length_name(self.other(leg)));
        let squares = |from: String, less: String| {
            if divided.is_empty() {
                format!("{from}² − {less}²")
            } else {
                format!("({from}² − {less}²){divided}")
            }
        };
        let d2 = format!("D2_{}", self.joint_name(self.inner));
        let equation = if leg.link() == self.legs[0].link() {
            format!("{d2} + {}", squares(mine, its))
        } else {
            format!("{} − {d2}", squares(its, mine))
        };
        sum.named(format!("sum_{}", self.link_name(leg)), equation)
    }

    fn separation_meaning(&self) -> String {
        let [first, second] = self.legs.each_ref().map(|leg| self.joint_name(leg.outer));
        format!("d, from {first} to {second}")
    }
}

impl Rule for Rrr {
    fn class(&self) -> &'static str {
        "RRR dyad"
    }

    fn fits(&self, model: &Model, group: &Group) -> bool {
        pinned_dyad(model, group).is_some()
    }

    fn place(&self, assembly: &mut Assembly<'_>, group: &Group) -> RuleResult {
        let Some(dyad) = pinned_dyad(assembly.model(), group) else { return Ok(()) };
        close(assembly, group, &dyad)
    }

    fn balance(&self, balance: &mut Balance<'_, '_>, group: &Group) -> RuleResult {
        let model = balance.model();
        let Some(dyad) = pinned_dyad(model, group) else { return Ok(()) };
        dyad.check_lengths()?;
        let [first, second] = &dyad.legs;
        // Moments of the loads about the outer pins, over the lengths.
        let shares = dyad.legs.each_ref().map(|leg| dyad.share(balance, leg));
        let [across_first, across_second] = shares.map(|share| share.inner);
        let (inner, link) = (dyad.joint_name(dyad.inner), dyad.link_name(first));
        let (outer, other) = (dyad.joint_name(first.outer), dyad.joint_name(second.outer));
        let of_force = format!("of the force on {link} at {inner}");
        let across = (-across_first).named(
            balance.name(&format!("{inner}_across_{link}")),
            format!("across {link}, {of_force}: −ΣM({outer})/|{outer} {inner}| of its loads"),
        );
        let second_link = dyad.link_name(second);
        let needed = across_second.named(
            balance.name(&format!("{inner}_across_{second_link}")),
            format!("across {second_link}, {of_force}: ΣM({other})/|{other} {inner}| of the loads on {second_link}"),
        );
        let force = inner_force(balance, &dyad, [across, needed]);
        let loads = [first, second].map(|leg| balance.total(leg.link()));
        let named = dyad.name_inner(balance, first, force);
        let forces = [if first.is_single() { named } else { force }, named.opposite()];
        for ((leg, share), (loads, force)) in dyad.legs.iter().zip(&shares).zip(loads.into_iter().zip(forces)) {
            dyad.balance_shared(balance, (leg, share), force, loads)?;
        }
        Ok(())
    }

    fn follow(&self, motion: &mut Motion<'_, '_>, group: &Group) -> RuleResult {
        let model = motion.model();
        let Some(dyad) = pinned_dyad(model, group) else { return Ok(()) };
        let [u1, u2] = dyad.legs.each_ref().map(|leg| dyad.direction(motion.placement, leg));
        // Where the inner pin would be if the legs' first links did not turn: v_P + ω₁ r₁ u₁⊥ = v_Q + ω₂ r₂ u₂⊥, multiplied by u₂ and by
        // u₁.
        dyad.legs.iter().try_for_each(|leg| dyad.turn(motion, leg, motion.graph().zero()))?;
        let [first, second] = dyad.legs.each_ref().map(|leg| dyad.velocity_of_pin(motion, leg));
        let gap = motion.lacking(dyad.inner, &second, &first);
        let sine = motion.pivots.dividing_sine(u1, u2, &dyad.pivot_name(), &dyad.group_name());
        let rates = [(u2, &dyad.legs[0]), (u1, &dyad.legs[1])].map(|(along, leg)| {
            let part = motion.part(&gap, along);
            let rate = if part.is_zero() { part } else { (part / sine) / dyad.length(leg) };
            let other = dyad.link_name(dyad.other(leg));
            let how = format!(": the pins' relative {{velocity}} along {other} over length times sin μ");
            (leg, motion.named_rate(rate, &dyad.link_name(leg), &how))
        });
        rates.into_iter().try_for_each(|(leg, rate)| dyad.turn(motion, leg, rate))
    }
}

/// The force of the second link on the first at the inner joint, from what it is across the first and from what has to be across the second.
fn inner_force<'m>(balance: &Balance<'m, '_>, dyad: &Dyad<'m>, [across, needed]: [Expr<'m>; 2]) -> Framed<'m> {
    let first = &dyad.legs[0];
    let [u1, u2] = dyad.legs.each_ref().map(|leg| dyad.direction(balance.placement, leg));
    let (inner, [link, other]) = (dyad.joint_name(dyad.inner), dyad.legs.each_ref().map(|leg| dyad.link_name(leg)));
    let of_force = format!("of the force on {link} at {inner}");
    let called = |part: Expr<'m>, leg: &Leg, sign: &str| {
        let (link, outer) = (dyad.link_name(leg), dyad.joint_name(leg.outer));
        let words = format!("{sign}ΣM({outer})/|{outer} {inner}| of the loads on {link}");
        balance.called(part, &format!("{inner}_across_{link}"), &words)
    };
    let [across_name, needed_name] = [called(across, first, "−"), called(needed, &dyad.legs[1], "")];
    let zero = balance.graph().zero();
    if across.is_zero() && needed.is_zero() {
        return Framed { components: Vector::new(zero, zero), axes: u1 };
    }
    let sine = balance.pivots.dividing_sine(u1, u2, &dyad.pivot_name(), &dyad.group_name());
    if needed.is_zero() && first.is_single() {
        // Nothing turns the second link: the force goes along it.
        let along = (across / sine).named(
            balance.name(&format!("{inner}_along_{other}")),
            format!("along {other}, {of_force}, as nothing turns {other}: {across_name}/sin μ"),
        );
        return Framed { components: Vector::new(along, zero), axes: u2 };
    }
    let known = balance.pivots.known_cosine(u1, u2);
    let cosine = known.unwrap_or_else(|| u1.dot(u2)).named(dyad.cosine_name(), dyad.cosine_meaning());
    let part = across * cosine - needed;
    // Found from the driver's angle with the cosine, the sine is there long before the loads' moments: so is its reciprocal.
    let along = if known.is_some() && !across.is_zero() && !needed.is_zero() {
        part * (sine.graph().one() / sine).named(format!("inverse_{}", dyad.pivot_name()), "")
    } else {
        part / sine
    };
    let terms = difference([(across, format!("{across_name} cos μ")), (needed, needed_name)]);
    let along =
        along.named(balance.name(&format!("{inner}_along_{link}")), format!("along {link}, {of_force}: {terms}/sin μ"));
    Framed { components: Vector::new(along, across), axes: u1 }
}

/// What the closure needs to know of the outer pins.
struct Closing<'m> {
    /// From the first outer pin to the second.
    d: Vector<'m>,
    /// Its square; where the root is sin μ, divided by `2 r₁ r₂` too.
    d2: Expr<'m>,
    /// `±D² + (r₁² − r₂²)`, where these are not best made of the difference of the lengths.
    sums: Option<[Expr<'m>; 2]>,
    /// `K = ±√(p q)`, or sin μ, which is `K/(2 r₁ r₂)`.
    k: Expr<'m>,
    /// What is known if it is sin μ.
    of_angle: Option<OfAngle<'m>>,
    /// cos μ by the law of cosines, where by these lengths it is as good as that of the directions.
    cosine: Option<Expr<'m>>,
    /// The directions of the legs, where they are known without it: in a parallelogram.
    directions: Option<[Vector<'m>; 2]>,
    /// What sin μ is found of, if K is not the sine.
    sine: SineOf,
    /// The sign of that root.
    sign: Sign<'m>,
    /// What must exceed what for `sin μ` to be more than rounding.
    significant: Vec<(Expr<'m>, Expr<'m>)>,
}

/// What sin μ is found of. The direction of a much shorter leg has the rounding of the longer one's square over its own length, and forces
/// balance along the directions as they are.
#[derive(Clone, Copy)]
enum SineOf {
    /// Of legs of the same order, and of sides of a parallelogram: `K/(2 r₁ r₂)`.
    Lengths,
    /// Where one may be much longer: the product of the directions.
    Directions,
    /// Where these fold with their driver, so that K keeps all digits next to the fold: the product of the vectors, `v₁ × v₂ = K/2`, by
    /// what brings both to unit size.
    Vectors,
}

/// What constant lengths give beside sin μ, at no more operations than K takes.
#[derive(Clone, Copy)]
struct OfAngle<'m> {
    /// `±(D² + r² − r'²)/(2 r r')` of the shorter leg r, negative if it is the second.
    sum: Expr<'m>,
    /// Whether the inner pin is always much farther from the outer pins than these are from each other.
    far: bool,
}

impl<'m> Closing<'m> {
    /// The root by its name.
    fn root(&self, joint: &str) -> String {
        if self.of_angle.is_some() { "sin μ".to_owned() } else { format!("{}K_{joint}", self.sign.text()) }
    }

    /// `±D² + (r₁² − r₂²)` for both legs.
    fn sums(&self, [r1, r2]: [Expr<'m>; 2]) -> [Expr<'m>; 2] {
        self.sums.unwrap_or_else(|| {
            let difference = (r1 - r2) * (r1 + r2);
            [self.d2 + difference, difference - self.d2]
        })
    }

    /// The vector along a leg, `sum e + K e⊥`, as text; by its part along d.
    fn resolved_text(&self, along: &str, joint: &str) -> String {
        let root = self.root(joint);
        match root.strip_prefix('−') {
            Some(root) => format!("{along} − {root} e⊥"),
            None => format!("{along} + {root} e⊥"),
        }
    }
}

/// `±1/2`, if a sum is `±D²` alone: of legs of the same length the inner pin is over the middle of d.
fn half_of<'m>(sum: Expr<'m>, d2: Expr<'m>) -> Option<Expr<'m>> {
    let graph = d2.graph();
    let half = graph.constant(&Number::ratio(1, 2));
    if graph.are_same(sum, d2) { Some(half) } else { graph.are_same(sum, -d2).then_some(-half) }
}

fn close<'m>(assembly: &mut Assembly<'m>, group: &Group, dyad: &Dyad<'m>) -> RuleResult {
    let [first, second] = &dyad.legs;
    dyad.check_lengths()?;
    let outer_names = [first, second].map(|leg| dyad.joint_name(leg.outer));
    let of = format!("{} -> {}", outer_names[0], outer_names[1]);
    let Some(closure) = assembly.closure(dyad.inner, group) else {
        return Err(assembly.missing_closure(group, dyad.inner, [Side::Left, Side::Right], &of));
    };
    check_closure(dyad, closure, &of)?;
    let [p, q] = dyad.outer_spots();
    let side = assembly.sign(closure, Side::Left);
    let closing = match dyad.outer_ends().and_then(|ends| half_angle(assembly, dyad, ends)) {
        Some((arms, swapped)) => by_half_angle(dyad, (closure, side), &arms, swapped)?,
        None => {
            if closure.smooth_at.is_some() {
                return Err(not_opened(dyad, closure));
            }
            let way = assembly.placement.way(p, q);
            match driven(dyad, &way) {
                Some(driven) => by_driven_length(dyad, side, &way, &driven),
                None => by_distance(dyad, side, &way),
            }
        }
    };
    let (r1, r2) = (dyad.length(first), dyad.length(second));
    let name = dyad.joint_name(dyad.inner);
    let (mut directions, mut closed) = ([closing.d; 2], Vec::new());
    let pointing = match closing.directions {
        Some(known) => known.map(|unit| Pointing { unit, factor: None, rough: None }),
        None => arms(dyad, &closing),
    };
    let factors = pointing.each_ref().map(|pointing| pointing.factor);
    for ((found, leg), Pointing { unit: direction, rough, .. }) in directions.iter_mut().zip(&dyad.legs).zip(pointing) {
        let link = dyad.link_name(leg);
        let meaning = format!("direction of {link} from {} to {name}", dyad.joint_name(leg.outer));
        let direction = direction.named_direction(&link, &meaning);
        closed.push(direction);
        *found = dyad.orient(assembly, leg, direction)?;
        if let Some(rough) = rough.filter(|_| leg.is_single()) {
            assembly.placement.know_rough(leg.link(), rough);
        }
        dyad.take_moments_over_length(&mut assembly.placement, leg);
        assembly.placement.connect(leg.outer);
    }
    assembly.placement.connect(dyad.inner);
    let [u1, u2] = directions;
    let [link, other] = [first, second].map(|leg| dyad.link_name(leg));
    let sine = match (closing.sine, factors) {
        _ if closing.of_angle.is_some() => closing.k,
        (SineOf::Vectors, [Some(f1), Some(f2)]) => {
            let half = closing.k.graph().constant(&Number::ratio(1, 2));
            let equation = format!("{} unit_{link} unit_{other}/2", closing.root(name));
            name_sine(dyad, closing.k * (half * f1 * f2), &equation)
        }
        (SineOf::Lengths, _) => {
            name_sine(dyad, closing.k / (2 * (r1 * r2)), &format!("{}/{}", closing.root(name), dyad.area_name()))
        }
        _ => name_sine(dyad, u1.cross(u2), &format!("{link} × {other}")),
    };
    if let [u1, u2] = closed[..] {
        let legs = [u1.scaled(r1), u2.scaled(-r2)];
        assembly.closed(|| ClosedLoop {
            name: name.to_owned(),
            residual: legs[0] + legs[1] - closing.d,
            found: [(u1, legs[0]), (u2, legs[1])].map(|(direction, arm)| Found::Direction {
                direction,
                column: arm.perp(),
                arm,
            }),
            determinant: -(r1 * r2 * sine),
            pivot: Some(Pivot { value: sine, again: u1.cross(u2), slopes: Some([-u1.dot(u2), u1.dot(u2)]) }),
            apart: closing.sums.is_some() || closing.of_angle.is_some_and(|known| known.far),
        });
    }
    let pivot = closing.significant.iter().fold(sine, |pivot, (value, limit)| pivot.where_above(*value, *limit));
    let meaning = if closing.directions.is_some() {
        let names = dyad.legs.each_ref().map(|leg| dyad.link_name(leg));
        format!("of a parallelogram, whose {} and {} keep the directions of opposite sides; ", names[0], names[1])
    } else {
        String::new()
    };
    let meaning = format!("{meaning}zero where it is no larger than its rounding");
    let pivot = pivot.named(format!("{}_or_zero", dyad.pivot_name()), meaning).held();
    let cosine = closing.cosine.map(Expr::held);
    assembly.pivots.state(u1, u2, Some(pivot), cosine);
    for (leg, sine, other) in [(first, pivot, u2), (second, -pivot, u1)] {
        if !leg.is_constant(dyad.model) {
            let cosine = cosine.unwrap_or_else(|| u1.dot(u2).named(dyad.cosine_name(), dyad.cosine_meaning()));
            dyad.state_carried(assembly, leg, other, Vector::new(cosine, sine));
        }
    }
    assembly.dyads.push(DyadPivot::sine(dyad.model, dyad.inner, pivot, cosine));
    Ok(())
}

fn name_sine<'m>(dyad: &Dyad<'_>, sine: Expr<'m>, equation: &str) -> Expr<'m> {
    let [first, second] = dyad.legs.each_ref().map(|leg| dyad.link_name(leg));
    let equation = format!("sin μ at {} = {equation}, μ from {first} to {second}", dyad.joint_name(dyad.inner));
    sine.named(dyad.pivot_name(), equation)
}

/// The shorter leg, then the longer one.
fn by_length(lengths: [Expr<'_>; 2]) -> [usize; 2] {
    if (lengths[0] - lengths[1]).sign() == Some(1) { [1, 0] } else { [0, 1] }
}

/// Whether the vector along the longer leg comes from that along the shorter one.
fn lead_by_arms(r1: Expr<'_>, r2: Expr<'_>) -> bool {
    constant_lengths(r1, r2).is_some() && ratio_is_at_most(8, r1, r2)
}

/// Whether the outer pins are so close to each other that a leg of any length is about as long as the other one, a constant.
fn pins_are_close(d2: Expr<'_>, lengths: [Expr<'_>; 2]) -> bool {
    // (8 D)²
    let Some(limit) = d2.value().map(|d2| Number::integer(64).mul(&d2)) else { return false };
    lengths.into_iter().filter_map(Expr::value).any(|length| limit.compare(&length.mul(&length)).is_le())
}

/// The directions of both legs from the vectors along them, P → B and Q → B.
///
/// Of legs of the same order the longer one is the shorter one and d: both vectors have the rounding of the shorter link and of d, which is
/// at most twice as long as the longer link. Legs whose pins are close are of the same order, whatever one of them measures: found by
/// themselves, they would differ from d by the rounding of constants, over 2D. Of others each is found by itself.
fn arms<'m>(dyad: &Dyad<'m>, closing: &Closing<'m>) -> [Pointing<'m>; 2] {
    let lengths = dyad.lengths();
    let Closing { d, d2, of_angle, .. } = *closing;
    let (graph, name) = (d2.graph(), dyad.joint_name(dyad.inner));
    let sum = |index: usize| dyad.name_sum(&dyad.legs[index], closing.sums(lengths)[index], "");
    let [short, long] = by_length(lengths);
    let short_sum = of_angle.map_or_else(|| sum(short), |known| known.sum);
    let scale = (graph.constant(&Number::ratio(1, 2)) / d2).named(format!("scale_{name}"), format!("1/(2 D2_{name})"));
    let e = d.scaled(scale).named(&format!("e_{name}"), &format!("d/(2 D2_{name})"));
    let leads = lead_by_arms(lengths[0], lengths[1]) || pins_are_close(d2, lengths);
    let across = e.scaled(closing.k);
    let across =
        if leads { across } else { across.named(&format!("across_{name}"), &format!("{} e", closing.root(name))) };
    let resolved = |index: usize, sum: Expr<'m>| {
        let leg = &dyad.legs[index];
        let (link, outer) = (dyad.link_name(leg), dyad.joint_name(leg.outer));
        let (along, text) = match half_of(sum, d2) {
            Some(half) => (d.scaled(half), if half.sign() == Some(1) { "d/2".to_owned() } else { "−d/2".to_owned() }),
            None => (e.scaled(sum), format!("sum_{link} e")),
        };
        let equation = format!("from {outer} to {name}: {}, e = d/(2 D2_{name})", closing.resolved_text(&text, name));
        (along + across.perp()).named(&format!("arm_{link}"), &equation)
    };
    let mut vectors = [d; 2];
    vectors[short] = resolved(short, short_sum);
    vectors[long] = if leads {
        let (link, outer) = (dyad.link_name(&dyad.legs[long]), dyad.joint_name(dyad.legs[long].outer));
        let lead = dyad.link_name(&dyad.legs[short]);
        let (sign, arm) = if short == 0 { ('−', vectors[short] - d) } else { ('+', vectors[short] + d) };
        arm.named(&format!("arm_{link}"), &format!("from {outer} to {name}: arm_{lead} {sign} d"))
    } else {
        resolved(long, sum(long))
    };
    [0, 1].map(|index| {
        let leg = &dyad.legs[index];
        let (link, length) = (dyad.link_name(leg), dyad.length_name(leg));
        let [own, other] = [lengths[index], lengths[1 - index]];
        let alike = lengths_are_alike(graph.scalar(), own, other);
        let found = if alike && dyad.is_composed(leg) {
            Pointing { unit: vectors[index].scaled(graph.one() / own), factor: None, rough: None }
        } else {
            to_unit(vectors[index], [own, other], (&link, &length), index == 0)
        };
        Pointing { unit: dyad.refined(leg, found.unit), ..found }
    })
}

/// The direction of a leg.
struct Pointing<'m> {
    unit: Vector<'m>,
    /// What brings the vector along the leg to unit size, if that is all: not of several links, whose direction is refined.
    factor: Option<Expr<'m>>,
    /// The same before it is brought to unit size, if its size has a few roundings only.
    rough: Option<Vector<'m>>,
}

/// A vector of nearly the given length brought to unit size: by one step, `u = v (3 − v·v/r²)/(2r)`, which squares the error; where legs are
/// so different that this does not suffice, or not known before run time, by root and division.
///
/// After one step v may serve as well. Products of the second leg may read it whatever they are; of the first one only those that ask for it:
/// forces are resolved along that leg, and would have its roundings twice.
fn to_unit<'m>(
    arm: Vector<'m>,
    [length, other]: [Expr<'m>; 2],
    (link, name): (&str, &str),
    is_first: bool,
) -> Pointing<'m> {
    let graph = arm.graph();
    let called = |factor: Expr<'m>, equation: String| factor.named(format!("unit_{link}"), equation);
    if !lengths_are_alike(graph.scalar(), length, other) {
        let factor = called(graph.one() / arm.squared().sqrt(), format!("1/|v|, v = arm_{link}"));
        return Pointing { unit: arm.scaled(factor), factor: Some(factor), rough: None };
    }
    let half = |n: i64| graph.constant(&Number::ratio(n, 2));
    let factor = half(3) / length - (half(1) / (length * length * length)) * arm.squared();
    let factor = called(factor, format!("(3 − v·v/{name}²)/(2 {name}), v = arm_{link}"));
    let unit = arm.scaled(factor);
    let serves = ratio_is_at_most(2, length, other);
    let along = |of: Vector<'m>, arm: Option<Vector<'m>>| {
        let part = |of: Expr<'m>, arm: Option<Expr<'m>>| of.along(arm, length, name);
        Vector::new(part(of.x, arm.map(|arm| arm.x)), part(of.y, arm.map(|arm| arm.y)))
    };
    let rough = (is_first && serves).then(|| {
        let rough = arm.scaled(graph.one() / length);
        along(rough.named_direction(&format!("rough_{link}"), &format!("arm_{link}/{name}")), Some(arm))
    });
    Pointing { unit: along(unit, (serves && !is_first).then_some(arm)), factor: Some(factor), rough }
}

fn check_closure(dyad: &Dyad<'_>, closure: &Closure, of: &str) -> RuleResult {
    let outer = dyad.legs.each_ref().map(|leg| leg.outer);
    let fits = matches!(closure.side, Side::Left | Side::Right | Side::Either) && closure.of == outer;
    if fits {
        return Ok(());
    }
    let joint = dyad.joint_name(dyad.inner);
    let lies = format!("`{joint}` lies left or right of the line `{of}`");
    let along = matches!(closure.side, Side::Ahead | Side::Behind);
    let problem =
        if along { format!("`{}` is for dyads with a slider: here {lies}", closure.side.word()) } else { lies };
    Err(Diagnostic::new(closure.side_place, problem)
        .help(format!("choose one of\nassemble {joint}: left({of});\nassemble {joint}: right({of});")))
}

/// The general form: from the vector between the outer pins.
fn by_distance<'m>(dyad: &Dyad<'m>, sign: Sign<'m>, way: &Way<'m>) -> Closing<'m> {
    let joint = dyad.joint_name(dyad.inner);
    let [r1, r2] = dyad.lengths();
    let graph = r1.graph();
    let (s, m) = (r1 + r2, (r1 - r2).abs());
    let d = way.vector().named(&format!("d_{joint}"), &dyad.separation_meaning());
    let d2 = d.squared().named(format!("D2_{joint}"), "d·d");
    let (sum_name, difference_name) = (dyad.sum_name(), dyad.difference_name());
    let p = (s.squared() - d2).named(format!("p_{joint}"), format!("({sum_name})² − D2_{joint}"));
    let q = (d2 - m.squared()).named(format!("q_{joint}"), format!("D2_{joint} − ({difference_name})²"));
    // Near p = 0, D is near S, and near q = 0 it is near M; d is rounded to the length of its way, and so are lengths that drives give.
    let length = dyad.legs.iter().fold(way.length(), |sum, leg| sum + dyad.slack(leg));
    let rounding = |of: &str, value: Expr<'m>, size: &str| {
        let meaning =
            format!("what rounding makes of {of}_{joint} = 0: {size}, Λ the lengths that make up d and driven legs");
        value.named(format!("rounding_{of}_{joint}"), meaning)
    };
    let (p, p_rounding) = if way.falls_short_of(s, length) {
        (p.known_positive(), graph.zero())
    } else {
        (p, rounding("p", graph.epsilons(2) * (s.squared() + s * length), &format!("2ε S (S + Λ), S = {sum_name}")))
    };
    let (q, q_rounding) = if way.exceeds(m, length) {
        (q.known_positive(), graph.zero())
    } else {
        (
            q,
            rounding(
                "q",
                graph.epsilons(2) * (m.squared() + m * length),
                &format!("2ε |M| (|M| + Λ), M = {difference_name}"),
            ),
        )
    };
    let p = p.require_at_least(p, -p_rounding, gap(dyad, p, true, d2));
    let q = q.require_at_least(q, -q_rounding, gap(dyad, q, false, d2));
    // Coincident outer pins leave the direction open. Where |r₁ − r₂| keeps them apart, q has seen to that.
    let close = rounding("D2", (2 * graph.epsilons(1) * length).squared(), "(2ε Λ)²");
    let apart = way.exceeds(graph.zero(), length) || m.exceeds_rounding_of(length);
    let d2 = if apart {
        d2.known_positive()
    } else {
        let failure = Failure::CoincidentPivots { group: dyad.group_name(), joint: joint.into() };
        d2.require_above(d2, close, failure)
    };
    let root =
        (p.non_negative() * q.non_negative()).sqrt().named(format!("K_{joint}"), format!("√(p_{joint} q_{joint})"));
    let significant = vec![(p, p_rounding), (q, q_rounding)];
    let cosine = law_of_cosines(dyad, d2);
    let sine = if dyad.may_be_unlike() { SineOf::Directions } else { SineOf::Lengths };
    Closing { d, d2, sums: None, k: sign.of(root), of_angle: None, cosine, directions: None, sine, sign, significant }
}

/// cos μ from the distance of the outer pins, which is known before the directions are. D²/(2 r₁ r₂) is at most 2¼ if no leg is more than twice
/// as long as the other one; the larger it may be, the more its rounding tells in the cosine.
fn law_of_cosines<'m>(dyad: &Dyad<'m>, d2: Expr<'m>) -> Option<Expr<'m>> {
    let [r1, r2] = dyad.lengths();
    constant_lengths(r1, r2).filter(|_| ratio_is_at_most(2, r1, r2))?;
    let area = 2 * (r1 * r2);
    let joint = dyad.joint_name(dyad.inner);
    let [first, second] = dyad.legs.each_ref().map(|leg| dyad.length_name(leg));
    let equation = format!("cos μ at {joint} = ({first}² + {second}² − D2_{joint})/{}", dyad.area_name());
    Some(((r1.squared() + r2.squared()) / area - d2 / area).named(dyad.cosine_name(), equation))
}

/// The failure to assemble, with the gap: how much too far apart (`p < 0`) or too close together (`q < 0`) the outer pins are.
fn gap<'m>(dyad: &Dyad<'m>, value: Expr<'m>, far: bool, d2: Expr<'m>) -> Failure {
    let [r1, r2] = dyad.lengths();
    let limit = if far { r1 + r2 } else { (r1 - r2).abs() };
    let gap = -value / (d2.sqrt() + limit);
    Failure::CannotAssemble { group: dyad.group_name(), joint: dyad.joint_name(dyad.inner).into(), gap: gap.id() }
}

/// A leg whose length a drive gives, between pins that a constant distance separates; the other leg is constant.
struct Driven<'m> {
    /// Which leg it is.
    leg: usize,
    /// `D`, the distance of the outer pins.
    distance: Expr<'m>,
    /// The length of the other leg.
    other: Expr<'m>,
    /// `x`: of the driven leg's arm, the part along the drive.
    along: Expr<'m>,
    /// `y`: the constant part across it.
    across: Expr<'m>,
}

/// The dyad as one of these.
fn driven<'m>(dyad: &Dyad<'m>, way: &Way<'m>) -> Option<Driven<'m>> {
    let (leg, arm) = match dyad.legs.each_ref().map(|leg| dyad.driven_arm(leg)) {
        [Some(arm), None] => (0, arm),
        [None, Some(arm)] => (1, arm),
        _ => return None,
    };
    let (first, others) = way.segments.split_first()?;
    if others.iter().any(|segment| segment.direction != first.direction) {
        return None;
    }
    let distance = others.iter().fold(first.along(), |sum, segment| sum + segment.along()).size();
    let other = dyad.lengths()[1 - leg];
    let constant = [distance, other, arm.y].iter().all(|size| size.value().is_some());
    (constant && !distance.is_zero()).then_some(Driven { leg, distance, other, along: arm.x, across: arm.y })
}

/// The closure where a drive gives the length `L` of one leg, `L² = x² + y²` with a constant y, the other leg r and D are constants:
/// `p q = ((D + r)² − L²)(L² − (D − r)²)`. So the constants fold, and little is lost near the ends of the motion.
fn by_driven_length<'m>(dyad: &Dyad<'m>, sign: Sign<'m>, way: &Way<'m>, driven: &Driven<'m>) -> Closing<'m> {
    let joint = dyad.joint_name(dyad.inner);
    let Driven { leg, distance, other, along: x, across: y } = *driven;
    let graph = distance.graph();
    let length = dyad.lengths()[leg];
    let (name, rest) = (dyad.length_name(&dyad.legs[leg]), dyad.length_name(&dyad.legs[1 - leg]));
    let d = way.vector().named(&format!("d_{joint}"), &dyad.separation_meaning());
    let d2 = distance.squared().named(format!("D2_{joint}"), "d·d");
    let (most, least) = (distance + other, (distance - other).abs());
    // x² − k, by its factors where it has any.
    let beyond = |limit: Expr<'m>| {
        let k = limit.squared() - y.squared();
        if k.sign() == Some(1) { (x - k.sqrt()) * (x + k.sqrt()) } else { x.squared() - k }
    };
    let p = (-beyond(most)).named(format!("p_{joint}"), format!("(D + {rest})² − {name}²"));
    let q = beyond(least).named(format!("q_{joint}"), format!("{name}² − (D − {rest})²"));
    let slack = way.length() + dyad.slack(&dyad.legs[leg]);
    let rounding = |of: &str, limit: Expr<'m>| {
        let value = graph.epsilons(2) * (limit.squared() + limit * slack);
        let limit = if of == "p" { format!("D + {rest}") } else { format!("|D − {rest}|") };
        let size = format!("2ε L (L + Λ), L = {limit}, D = |d|, Λ the lengths that make up d and {name}");
        value.named(format!("rounding_{of}_{joint}"), format!("what rounding makes of {of}_{joint} = 0: {size}"))
    };
    let failure =
        |gap: Expr<'m>| Failure::CannotAssemble { group: dyad.group_name(), joint: joint.into(), gap: gap.id() };
    let mut significant = Vec::new();
    let mut reached = |margin: Expr<'m>, rounding: Expr<'m>, gap: Expr<'m>| {
        significant.push((margin, rounding));
        margin.require_at_least(margin, -rounding, failure(gap)).non_negative()
    };
    let p = reached(p, rounding("p", most), length - most);
    // Across the drive the leg may be long enough by itself.
    let q = if (y.abs() - least).sign() == Some(1) {
        q.known_positive()
    } else {
        reached(q, rounding("q", least), least - length)
    };
    let root = (p * q).sqrt().named(format!("K_{joint}"), format!("√(p_{joint} q_{joint})"));
    let (constant, square) = (d2 + other.squared() - y.squared(), d2 - other.squared() + y.squared());
    let sums = if leg == 1 {
        [constant - x.squared(), -square - x.squared()]
    } else {
        [square + x.squared(), x.squared() - constant]
    };
    // The driven leg is at least as long as the two constants differ by.
    let sine = if (least - 8 * other).sign() == Some(1) { SineOf::Directions } else { SineOf::Lengths };
    Closing {
        d,
        d2,
        sums: Some(sums),
        k: sign.of(root),
        of_angle: None,
        cosine: None,
        directions: None,
        sine,
        sign,
        significant,
    }
}

/// Whether the ratio of two lengths is at most `0.8/√ε`, as far as constants tell.
fn lengths_are_alike(scalar: Scalar, a: Expr<'_>, b: Expr<'_>) -> bool {
    let Some((larger, smaller)) = constant_lengths(a, b) else { return false };
    // ratio² ε ≤ 0.64
    let limit = Number::ratio(64, 100).mul(&smaller).mul(&smaller);
    larger.mul(&larger).mul(&scalar.epsilon()).compare(&limit).is_le()
}

/// Whether the ratio of two lengths is at most this, or is not known.
fn ratio_is_at_most(limit: i64, a: Expr<'_>, b: Expr<'_>) -> bool {
    constant_lengths(a, b).is_none_or(|(larger, smaller)| larger.compare(&smaller.mul(&Number::integer(limit))).is_le())
}

/// Two constants, the larger first.
fn constant_lengths(a: Expr<'_>, b: Expr<'_>) -> Option<(Number, Number)> {
    let (a, b) = (a.value()?, b.value()?);
    Some(if a.compare(&b).is_gt() { (a, b) } else { (b, a) })
}
