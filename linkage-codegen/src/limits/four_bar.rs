//! Four pins.
//!
//! With the lengths g of the frame, a of the crank, h of the coupler and b of the output, ψ the angle at the driver from the frame's line
//! to the crank's, `Σ = g + a + h + b`, and `e_i = Σ − 2 i` for each length i, which must not be negative:
//!
//! ```text
//! T₁ = g − a + h − b    T₂ = g − a − h + b    T₃ = h + b − g − a
//! D² = (g − a)² + 4ga sin²(ψ/2)               |h − b| ≤ D ≤ h + b
//! ```
//!
//! D is the distance of the outer pins of coupler and output. By their signs T₁, T₂, T₃ tell the eight types of a four-bar (Murray and
//! McCarthy): all three or just one are positive where the sum of the shortest and the longest length is less than that of the other two
//! (Grashof), and one is zero at a change point. Every limit is twice the angle of a right triangle whose sides are roots of products of
//! these seven sums: none is the arc cosine of a rounded cosine, and each is exactly 0 or π where the linkage folds.
//!
//! ```text
//! limit, folded      tan²(ψ/2) = −T₁T₂/(e_h e_b)         if T₁T₂ < 0
//! limit, stretched   tan²(ψ/2) = e_g e_a/(−T₃ Σ)         if T₃ < 0
//! output dead, crank and coupler stretched   tan²(ψ/2) = e_g T₂/(e_b Σ)
//!              folded                        tan²(ψ/2) = e_a T₁/(e_h T₃)
//! transmission angle at ψ = 0   tan²(μ/2) = T₁T₂/(e_g e_a)     at ψ = π   tan²(μ/2) = e_h e_b/(T₃ Σ)
//! ```

use super::cycles::Chain;
use super::{Closing, Extreme, FourBar, Loop, Possible, Posture, Shape, Stroke, Turning, Writing};
use crate::graph::Expr;

/// A loop of four pins; `sense` is 1 if the outer pin on the crank, that on the frame and the inner pin follow each other counter-clockwise.
/// `None` if it closes at no angle.
pub(super) fn of(chain: &Chain<'_>, sense: i64, closing: &Closing<'_>) -> Option<Loop> {
    let dimensions = [("g", [0, 3]), ("a", [0, 1]), ("h", [1, 2]), ("b", [3, 2])];
    let dimensions = dimensions.map(|(symbol, ends)| (symbol, chain.distance_name(ends)));
    let writing = Writing::new(chain, closing, &dimensions);
    let lengths = [(0, "a"), (1, "h"), (2, "b"), (3, "g")];
    let [a, h, b, g] = lengths.map(|(body, symbol)| writing.length(body, symbol));
    let sum = writing.named(g + a + h + b, "sum", "Σ = g + a + h + b");
    let [t1, t2, t3] = balances(&writing, [g, a, h, b]);
    let excess = excesses(&writing, [g, a, h, b]);
    let [eg, ea, eh, eb] = writing.assembled(&excess)?.try_into().ok()?;
    let phase = writing.phase(-chain.arm(3), chain.arm(0));
    let phase = writing.named(phase, "phase", "ψ at the coordinate 0");
    let at = |angle, name| writing.coordinate(angle, phase, name).id();

    let nearest = t1 * t2;
    let nearest = writing.named(nearest, "near2", "(g − a)² − (h − b)² = T₁T₂");
    let near =
        writing.twice(-nearest, eh * eb, "psi_folded", "ψ where coupler and output fold: tan²(ψ/2) = −T₁T₂/(e_h e_b)");
    let far =
        writing.twice(eg * ea, -t3 * sum, "psi_stretched", "ψ where they are stretched: tan²(ψ/2) = −e_g e_a/(T₃ Σ)");
    let stretched = writing.twice(
        eg * t2,
        eb * sum,
        "psi_dead_stretched",
        "|ψ| with crank and coupler stretched: tan²(ψ/2) = e_g T₂/(e_b Σ)",
    );
    let folded = writing.twice(
        ea * t1.abs(),
        eh * t3.abs(),
        "psi_dead_folded",
        "|ψ| with crank and coupler folded: tan²(ψ/2) = e_a T₁/(e_h T₃)",
    );
    let both = writing.named(t1 * t3, "product_dead_folded", "T₁T₃, not negative if crank and coupler can fold");

    // From the frame's line to the output, in the triangle of both with the line of crank and coupler.
    let outer =
        writing.twice(eg * eb, t2 * sum, "output_stretched", "angle of the output there: tan²(φ/2) = e_g e_b/(T₂ Σ)");
    let inner = writing.twice(both, eh * ea, "output_folded", "tan²(φ/2) = T₁T₃/(e_h e_a)");
    let swing = writing.named(outer - inner, "swing", "angle of the output between its dead centres");
    let advance = writing.named(writing.pi() - (stretched + folded), "advance", "π less the crank's turn between them");
    let least = writing.twice(
        nearest,
        eg * ea,
        "mu_least",
        "tan²(μ/2) = T₁T₂/(e_g e_a), at ψ = 0 or where coupler and output fold",
    );
    let greatest = writing.twice(
        eh * eb,
        t3 * sum,
        "mu_greatest",
        "tan²(μ/2) = e_h e_b/(T₃ Σ), at ψ = π or where they are stretched",
    );

    let joint = |hinge: usize| chain.hinge_name(hinge).to_owned();
    let dead = |margin: Expr<'_>, angle, name, posture| Possible {
        margins: vec![margin.id()],
        at: at(angle, name),
        joint: joint(1),
        posture,
    };
    let shape = FourBar {
        lengths: [g, a, h, b].map(Expr::id),
        balances: [t1, t2, t3].map(Expr::id),
        range: Turning {
            centre: at(writing.graph.zero(), "centre"),
            near: Some([nearest.id(), near.id()]),
            far: Some([t3.id(), far.id()]),
            joint: joint(2),
            postures: [Posture::Folded, Posture::Stretched],
        },
        // Where they are stretched, the inner pin lies beyond the crank's pin, and folded on this side of it: which is on the left
        // depends on the sign of ψ.
        dead_centres: [
            dead(t2, sense * stretched, "dead_stretched", Posture::Stretched),
            dead(both, -(sense * folded), "dead_folded", Posture::Folded),
        ],
        swing: Stroke { margins: [t1, t2, t3].map(Expr::id).to_vec(), extent: swing.id(), advance: advance.id() },
        transmission: [
            Extreme { angle: least.id(), at: at(near, "mu_least") },
            Extreme { angle: greatest.id(), at: at(far, "mu_greatest") },
        ],
    };
    let names = [0, 1, 2, 3].map(|body| chain.body_name(body));
    let title = format!(
        "four-bar {}: {} driven at {}, {}, {} on {}",
        writing.name,
        names[0],
        joint(0),
        names[1],
        names[2],
        names[3]
    );
    let lines = [[0, 3], [0, 1]].map(|[from, to]| format!("the line {} {}", joint(from), joint(to)));
    let origin = writing.origin(format!("ψ, from {} to {},", lines[0], lines[1]), phase);
    Some(writing.of(title, &[g, a, h, b], origin, Shape::FourBar(shape)))
}

/// T₁, T₂, T₃.
fn balances<'m>(writing: &Writing<'m>, [g, a, h, b]: [Expr<'m>; 4]) -> [Expr<'m>; 3] {
    let all = [
        ((g - a) + (h - b), "T1", "T₁ = g − a + h − b"),
        ((g - a) - (h - b), "T2", "T₂ = g − a − h + b"),
        ((h + b) - (g + a), "T3", "T₃ = h + b − g − a"),
    ];
    all.map(|(value, name, equation)| writing.named(value, name, equation))
}

/// By how much each three lengths together exceed the fourth.
fn excesses<'m>(writing: &Writing<'m>, [g, a, h, b]: [Expr<'m>; 4]) -> [Expr<'m>; 4] {
    let all = [
        ((a + h + b) - g, "e_g", "e_g = a + h + b − g"),
        ((g + h + b) - a, "e_a", "e_a = g + h + b − a"),
        ((g + a + b) - h, "e_h", "e_h = g + a + b − h"),
        ((g + a + h) - b, "e_b", "e_b = g + a + h − b"),
    ];
    all.map(|(value, name, equation)| writing.named(value, name, equation))
}
