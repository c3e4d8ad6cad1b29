//! The RRR dyad whose outer pins a driven angle ψ opens, `D² = (b − a)² + 4ab sin²(ψ/2)`: p and q are sums of a constant and a square.
//!
//! ```text
//! p = k_p + 4ab cos²(ψ/2)        k_p = S² − (a + b)²
//! q = k_q + 4ab sin²(ψ/2)        k_q = (a − b)² − M²
//! ```
//!
//! Both constants are exact, and zero where the dyad folds with its driver: near such a fold the square alone is left, and nothing is lost.

use super::{Closing, OfAngle, SineOf, by_length, gap, lead_by_arms, name_sine};
use crate::diagnostics::Diagnostic;
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Symbol, Vector};
use crate::model::ids::DriveId;
use crate::model::{Closure, End};
use crate::plan::assembly::{Assembly, Sign};
use crate::plan::half_angle::{HalfAngle, arm_without_direction, first_dyad_on};
use crate::plan::rules::dyad::Dyad;

/// The half-angle form, if the outer pins hang on the two links of a driven pin, and whether the first of them is on the unmoved one.
///
/// It costs nothing for the dyad for which the drive's angle is halved anyway; for another one it is taken where that dyad comes near
/// its folds.
pub(super) fn half_angle<'m>(
    assembly: &Assembly<'m>,
    dyad: &Dyad<'m>,
    [p, q]: [End; 2],
) -> Option<(HalfAngle<'m>, bool)> {
    let model = dyad.model;
    [(p, q, false), (q, p, true)].into_iter().find_map(|(moved, other, swapped)| {
        let drive = model.drives.iter().position(|drive| {
            let joint = model.joint(drive.joint);
            let group = assembly.topology.motion.iter().find(|g| g.links == [moved.link]);
            joint.end_on(moved.link).is_some() && group.is_some_and(|g| g.outer == [drive.joint])
        })?;
        let arms = HalfAngle::between(assembly, moved, other)?;
        let first = first_dyad_on(assembly, DriveId::new(drive), moved.link) == Some((moved, other));
        (first || comes_near_a_fold(dyad, &arms)).then_some((arms, swapped))
    })
}

/// The closure.
pub(super) fn by_half_angle<'m>(
    dyad: &Dyad<'m>,
    (closure, side): (&Closure, Sign<'m>),
    arms: &HalfAngle<'m>,
    swapped: bool,
) -> Result<Closing<'m>, Diagnostic> {
    let joint = dyad.joint_name(dyad.inner);
    let opening = Opening::of(dyad, arms, swapped);
    let margins = opening.margins();
    let folds = margins.map(|margin| margin.folds);
    let smooth = closure.smooth_at.is_some();
    if smooth && folds == [false; 2] {
        return Err(opening.does_not_fold(closure));
    }
    let margins = opening.assembled(margins);
    let (root, equation) = opening.root(margins, smooth);
    let sign = side_sign(dyad, (closure, side), arms, folds)?;
    let (k, of_angle, cosine) = if opening.gives_sine {
        let equation = format!("{}{equation}", sign.text());
        (name_sine(dyad, sign.of(root), &equation), Some(opening.of_angle()), opening.cosine())
    } else {
        (sign.of(root.named(format!("K_{joint}"), equation)), None, None)
    };
    let directions = opening.of_parallelogram(sign, swapped).filter(|_| smooth && folds == [true; 2]);
    Ok(Closing {
        d: opening.d,
        d2: opening.d2,
        sums: None,
        k,
        of_angle,
        cosine,
        // Sides of a parallelogram have the directions of the arms, whatever their lengths.
        sine: match (dyad.may_be_unlike() && directions.is_none(), folds) {
            (false, _) => SineOf::Lengths,
            (true, [false, false]) => SineOf::Directions,
            (true, _) => SineOf::Vectors,
        },
        directions,
        sign,
        significant: opening.significant(margins),
    })
}

/// How the outer pins are opened.
struct Opening<'a, 'm> {
    dyad: &'a Dyad<'m>,
    arms: &'a HalfAngle<'m>,
    /// `k_p`, `k_q`.
    least: [Expr<'m>; 2],
    /// `4ab`
    span: Expr<'m>,
    /// Whether p has its form with the square of the cosine: with arms much longer than the dyad that would bring the rounding of their
    /// lengths into p, and D² does not.
    p_by_half: bool,
    /// Whether areas are divided by `2 r₁ r₂`, which makes the root of p q the sine of μ.
    gives_sine: bool,
    /// What areas are divided by, if not by one.
    area: Expr<'m>,
    /// This as text.
    divided: String,
    /// `4ab sin²(ψ/2)`, divided.
    spread: Expr<'m>,
    /// From the first outer pin to the second.
    d: Vector<'m>,
    /// `D²`, divided.
    d2: Expr<'m>,
    /// ψ itself is rounded: at half a turn, cos(ψ/2) of the rounded angle is not zero.
    rounding: Expr<'m>,
}

impl<'a, 'm> Opening<'a, 'm> {
    fn of(dyad: &'a Dyad<'m>, arms: &'a HalfAngle<'m>, swapped: bool) -> Self {
        let graph = arms.a.graph();
        let joint = dyad.joint_name(dyad.inner);
        let [r1, r2] = dyad.lengths();
        let least = fold_margins(arms, r1, r2);
        let span = 4 * (arms.a * arms.b);
        let p_by_half = least[0].is_zero() || (4 * least[0] + (r1 + r2).squared()).sign() == Some(1);
        let gives_sine = lead_by_arms(r1, r2) && p_by_half && least[0].value().is_some();
        let (area, divided) =
            if gives_sine { (2 * (r1 * r2), format!("/{}", dyad.area_name())) } else { (graph.one(), String::new()) };
        let spread = ((span / area) * arms.sine_squared())
            .named(format!("spread_{joint}"), format!("4ab sin²(ψ/2){divided}, {}", arms.lengths));
        let d = arms.separation();
        let d = if swapped { -d } else { d }.named(&format!("d_{joint}"), &dyad.separation_meaning());
        let theta = graph.symbol(Symbol::Drive(arms.drive)).abs();
        let fixed = graph.constant(&arms.phase.abs().add(&Number::one()));
        let rounding = graph.epsilons(2) * theta + graph.epsilons(2) * fixed;
        let name = arms.name;
        let size = if arms.phase.is_zero() {
            format!("2ε (|{name}| + 1)")
        } else {
            format!("2ε (|{name}| + |ψ₀| + 1), ψ₀ = ψ at {name} = 0")
        };
        let meaning = format!("what rounding makes of ψ at a fold: {size}");
        let rounding = rounding.named(format!("rounding_psi_{joint}"), meaning);
        let apart = arms.b - arms.a;
        let d2 = (apart.squared() / area + spread)
            .named(format!("D2_{joint}"), format!("d·d{divided} = (b − a)²{divided} + spread_{joint}"));
        let d2 = if apart.sign().is_some_and(|s| s != 0) || (r1 - r2).sign().is_some_and(|s| s != 0) {
            // Arms or legs of different lengths keep the outer pins apart.
            d2.known_positive()
        } else {
            let failure = Failure::CoincidentPivots { group: dyad.group_name(), joint: joint.into() };
            d2.require_above(d2, (rounding * (arms.a + arms.b)).squared() / area, failure)
        };
        Self { dyad, arms, least, span, p_by_half, gives_sine, area, divided, spread, d, d2, rounding }
    }

    /// p and q.
    fn margins(&self) -> [Margin<'m>; 2] {
        let Self { dyad, d2, .. } = *self;
        let (c, [kp, kq]) = (self.arms.half.x, self.least);
        let joint = dyad.joint_name(dyad.inner);
        let ([r1, r2], sum, difference) = (dyad.lengths(), dyad.sum_name(), dyad.difference_name());
        let p = if self.p_by_half {
            let (divisor, divided) = self.divisor(kp.is_zero(), kq.is_zero());
            let p = Margin::by_half(kp, self.span, c.squared(), divisor);
            p.named(format!("p_{joint}"), format!("(({sum})² − d·d){divided}, by cos²(ψ/2)"))
        } else {
            let p = Margin::by_distance((r1 + r2).squared() - d2, r1 + r2);
            p.named(format!("p_{joint}"), format!("({sum})² − D2_{joint}"))
        };
        let q = if kq.value().is_some() {
            let (divisor, divided) = self.divisor(kq.is_zero(), p.folds);
            let q = Margin::by_half(kq, self.span, self.arms.sine_squared(), divisor);
            q.named(format!("q_{joint}"), format!("(d·d − ({difference})²){divided}, by sin²(ψ/2)"))
        } else {
            let q = Margin::by_distance(d2 - (r1 - r2).squared(), r1 + r2);
            q.named(format!("q_{joint}"), format!("D2_{joint} − ({difference})²"))
        };
        [p, q]
    }

    /// What a margin is divided by. Where one of the two is a square alone, all factors are in the other.
    fn divisor(&self, folds: bool, other_folds: bool) -> (Expr<'m>, String) {
        match (folds, other_folds) {
            (true, false) if self.gives_sine => (self.span, String::new()),
            (false, true) if self.gives_sine => {
                (self.area.squared() / self.span, format!(" · 4ab/{}²", self.dyad.area_name()))
            }
            _ => (self.area, self.divided.clone()),
        }
    }

    /// The margins checked: below its rounding the dyad cannot be assembled.
    fn assembled(&self, [p, q]: [Margin<'m>; 2]) -> [Margin<'m>; 2] {
        let square = self.d2 * self.area;
        [p.assembled(self.dyad, true, square), q.assembled(self.dyad, false, square)]
    }

    /// `√(p q)`, and its equation. Where a margin is a square alone, its root is that of its only term, and in a smooth motion keeps its sign
    /// through the fold.
    fn root(&self, [p, q]: [Margin<'m>; 2], smooth: bool) -> (Expr<'m>, String) {
        let graph = self.span.graph();
        let root_of = |margin: Margin<'m>, half: Expr<'m>| match (margin.folds, smooth) {
            (true, true) => (half, self.span / margin.divisor),
            (true, false) => (half.abs(), self.span / margin.divisor),
            (false, _) => (margin.value.non_negative(), graph.one()),
        };
        let ((from_p, p_factor), (from_q, q_factor)) = (root_of(p, self.arms.half.x), root_of(q, self.arms.half.y));
        let factor = (p_factor * q_factor).sqrt();
        let joint = self.dyad.joint_name(self.dyad.inner);
        let half = |function: &str| if smooth { format!("{function}(ψ/2)") } else { format!("|{function}(ψ/2)|") };
        let (cosine, sine) = (half("cos"), half("sin"));
        let rest = if self.gives_sine { "" } else { "√(4ab) " };
        // The square root is known last: it is multiplied once.
        match (p.folds, q.folds) {
            (true, true) => (factor * (from_p * from_q), format!("4ab{} {cosine} {sine}", self.divided)),
            (true, false) => ((factor * from_p) * from_q.sqrt(), format!("{rest}{cosine} √(q_{joint})")),
            (false, true) => ((factor * from_q) * from_p.sqrt(), format!("{rest}{sine} √(p_{joint})")),
            (false, false) => ((from_p * from_q).sqrt(), format!("√(p_{joint} q_{joint})")),
        }
    }

    /// What must exceed what.
    fn significant(&self, [p, q]: [Margin<'m>; 2]) -> Vec<(Expr<'m>, Expr<'m>)> {
        let joint = self.dyad.joint_name(self.dyad.inner);
        let above = |margin: Margin<'m>, half: Expr<'m>| {
            if margin.folds {
                (half.abs().named(format!("fold_{joint}"), "distance from the fold"), self.rounding)
            } else {
                (margin.value, margin.rounding)
            }
        };
        vec![above(p, self.arms.half.x), above(q, self.arms.half.y)]
    }

    /// `±(D² + r² − r'²)/(2 r r')` of the shorter leg, from `spread = 4ab sin²(ψ/2)/(2 r r')`.
    fn of_angle(&self) -> OfAngle<'m> {
        let Self { dyad, arms, area, spread, ref divided, .. } = *self;
        let (lengths, apart) = (dyad.lengths(), arms.b - arms.a);
        let [short, long] = by_length(lengths);
        let (r, other) = (lengths[short], lengths[long]);
        let constant = (apart.squared() + (r - other) * (r + other)) / area;
        let sum = if short == 0 { constant + spread } else { -constant - spread };
        let sum = dyad.name_sum(&dyad.legs[short], sum, divided);
        let far = (r - 8 * (arms.a + arms.b)).sign() == Some(1);
        OfAngle { sum, far }
    }

    /// The directions of the legs if they and the arms are opposite sides of a parallelogram: of P → B that of OQ, of Q → B that of OP. There
    /// `sin μ` is `sin ψ`; of the other sign it is a crossed one.
    fn of_parallelogram(&self, sign: Sign<'m>, swapped: bool) -> Option<[Vector<'m>; 2]> {
        let Self { dyad, arms, .. } = *self;
        let mut opposite = [(arms.b, arms.base), (arms.a, arms.moved_direction())];
        if swapped {
            opposite.reverse();
        }
        let is_crossed = !matches!((sign, swapped), (Sign::Plus, false) | (Sign::Minus, true));
        let are_equal = dyad.lengths().iter().zip(opposite).all(|(leg, (arm, _))| (*leg - arm).is_zero());
        (are_equal && !is_crossed).then_some(opposite.map(|(_, along)| along))
    }

    /// cos μ by the law of cosines, from the spread; where the dyad folds stretched only, from the square that is nothing there.
    ///
    /// Where the driver goes all round, the spread is at most two. The more it may be, the more its rounding tells in the cosine, which then is
    /// that between the directions.
    fn cosine(&self) -> Option<Expr<'m>> {
        let Self { dyad, arms, span, area, spread, ref divided, .. } = *self;
        if (2 * area - span).sign() == Some(-1) {
            return None;
        }
        let [short, long] = by_length(dyad.lengths());
        let [r, other] = [short, long].map(|index| dyad.lengths()[index]);
        let [mine, its] = [short, long].map(|index| dyad.length_name(&dyad.legs[index]));
        let joint = dyad.joint_name(dyad.inner);
        if self.least[0].is_zero() && !self.least[1].is_zero() {
            let cosine = (span / area) * arms.half.x.squared() - area.graph().one();
            return Some(cosine.named(dyad.cosine_name(), format!("cos μ at {joint} = 4ab cos²(ψ/2){divided} − 1")));
        }
        let cosine = (r.squared() + other.squared() - (arms.b - arms.a).squared()) / area - spread;
        Some(cosine.named(dyad.cosine_name(), format!("cos μ at {joint} = ({mine}² + {its}²){divided} − D2_{joint}")))
    }

    fn does_not_fold(&self, closure: &Closure) -> Diagnostic {
        if self.least.iter().all(|k| k.value().is_some()) {
            return not_folding(self.dyad, closure, "its lengths leave a gap");
        }
        not_known(self.dyad, closure)
            .help("`smooth` is for folds of constants, or of a parameter that is the length of two links: leave it out, or give the lengths here")
    }
}

/// `p` or `q`: how far the outer pins are from one of the distances at which the dyad is stretched or folded.
#[derive(Clone, Copy)]
struct Margin<'m> {
    value: Expr<'m>,
    /// What it was divided by.
    divisor: Expr<'m>,
    /// What rounding could have made of a margin of zero.
    rounding: Expr<'m>,
    /// Whether it is `4ab cos²(ψ/2)` or `4ab sin²(ψ/2)` alone: then the dyad folds with its driver.
    folds: bool,
}

impl<'m> Margin<'m> {
    /// `k + 4ab cos²(ψ/2)` or `k + 4ab sin²(ψ/2)`, divided: a positive constant keeps it from zero, of a negative one the rounding counts.
    fn by_half(k: Expr<'m>, span: Expr<'m>, square: Expr<'m>, divisor: Expr<'m>) -> Self {
        let graph = k.graph();
        let k = k / divisor;
        let rounding = if k.sign() == Some(-1) { graph.epsilons(4) * k.abs() } else { graph.zero() };
        Self { value: k + (span / divisor) * square, divisor, rounding, folds: k.is_zero() }
    }

    /// Of a distance and a limit, whose rounding counts.
    fn by_distance(value: Expr<'m>, limit: Expr<'m>) -> Self {
        let graph = value.graph();
        Self { value, divisor: graph.one(), rounding: graph.epsilons(4) * limit.squared(), folds: false }
    }

    fn named(self, name: String, equation: String) -> Self {
        Self { value: self.value.named(name, equation), ..self }
    }

    /// Checked: below its rounding the dyad cannot be assembled. `d2` is `D²`.
    fn assembled(self, dyad: &Dyad<'m>, far: bool, d2: Expr<'m>) -> Self {
        let gap = gap(dyad, self.value * self.divisor, far, d2);
        Self { value: self.value.require_at_least(self.value, -self.rounding, gap), ..self }
    }
}

/// `k_p = S² − (a + b)²` and `k_q = (a − b)² − M²`, as products that keep small differences: the least values of p and q.
fn fold_margins<'m>(arms: &HalfAngle<'m>, r1: Expr<'m>, r2: Expr<'m>) -> [Expr<'m>; 2] {
    let (s, m) = (r1 + r2, r1 - r2);
    let (sum, difference) = (arms.a + arms.b, arms.b - arms.a);
    [(s - sum) * (s + sum), (difference - m) * (difference + m)]
}

/// Whether constant lengths let `p` or `q` fall below a sixteenth of its largest value.
fn comes_near_a_fold(dyad: &Dyad<'_>, arms: &HalfAngle<'_>) -> bool {
    let [r1, r2] = dyad.lengths();
    let span = 4 * (arms.a * arms.b);
    fold_margins(arms, r1, r2).into_iter().any(|k| (16 * k - span).sign() != Some(1))
}

/// The sign of K: of the side, and in a smooth motion of the fold factor at the stated angle.
fn side_sign<'m>(
    dyad: &Dyad<'_>,
    (closure, side): (&Closure, Sign<'m>),
    arms: &HalfAngle<'_>,
    folds: [bool; 2],
) -> Result<Sign<'m>, Diagnostic> {
    let Some(at) = closure.smooth_at else { return Ok(side) };
    let Some(at) = dyad.model.graph.constant_value(at) else {
        return Err(Diagnostic::new(
            closure.smooth_place,
            "the angle at which a smooth motion starts must be a constant",
        ));
    };
    let (cosine, sine) = arms.half_at(&at);
    let sign = |part: &Number, counts: bool| if counts { i64::from(part.signum()) } else { 1 };
    match sign(&cosine, folds[0]) * sign(&sine, folds[1]) {
        0 => Err(Diagnostic::new(
            closure.smooth_place,
            format!("at this angle the dyad is folded: `{}` is on neither side", dyad.joint_name(dyad.inner)),
        )
        .help("state the side at an angle away from the folds")),
        sign => Ok(if sign > 0 { side } else { side.opposite() }),
    }
}

/// A dyad that no driven angle opens, or none of which the arms' directions are known.
pub(super) fn not_opened(dyad: &Dyad<'_>, closure: &Closure) -> Diagnostic {
    let Some([pin, end]) = dyad.outer_ends().and_then(|ends| arm_without_direction(dyad.model, ends)) else {
        return not_folding(dyad, closure, "its outer joints do not hang on the two links of one driven pin");
    };
    not_known(dyad, closure).help(format!(
        "a side that a parameter gives points either way if that may be negative: give it as a length, as in `{pin} -> {end}: r`, or leave `smooth` out"
    ))
}

fn not_known(dyad: &Dyad<'_>, closure: &Closure) -> Diagnostic {
    let joint = dyad.joint_name(dyad.inner);
    Diagnostic::new(
        closure.smooth_place,
        format!("whether the dyad at `{joint}` folds is not known before its parameters are"),
    )
}

fn not_folding(dyad: &Dyad<'_>, closure: &Closure, why: &str) -> Diagnostic {
    let joint = dyad.joint_name(dyad.inner);
    Diagnostic::new(closure.smooth_place, format!("the dyad at `{joint}` does not fold: {why}"))
        .help("without a fold there is nothing to go through smoothly: leave `smooth` out")
        .note("a dyad folds with its driver where the lengths of its links and of the two arms satisfy r₁ + r₂ = a + b or |r₁ − r₂| = |a − b|, exactly")
}
