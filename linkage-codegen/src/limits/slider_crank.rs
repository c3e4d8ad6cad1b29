//! Three pins and a slide, driven at a pin.
//!
//! **The slide on the frame**, or, with frame and crank exchanged, on the crank: with the lengths a of the crank and r of the rod, c the
//! distance of the rod's far pin from the slide's line through the driver (its eccentricity), and χ the angle from the slide's direction
//! to the crank, the rod is at `sin` of its angle `(c − a sin χ)/r`:
//!
//! ```text
//! m₁ = r − a − c    m₂ = r − a + c    f₁ = r + a − c    f₂ = r + a + c
//! the crank goes all round if a + |c| ≤ r, that is m₁ ≥ 0 and m₂ ≥ 0
//! limits    tan²((χ + 90°)/2) = −m₁/f₁   if m₁ < 0      tan²((χ − 90°)/2) = −m₂/f₂   if m₂ < 0
//! slider dead, crank and rod stretched   χ = atan2(c, ±√(f₁f₂))     folded   χ = atan2(∓c, ∓√(m₁m₂))
//! stroke = √(f₁f₂) − √(m₁m₂)
//! ```
//!
//! **The slide opposite to the driver**, an inverted slider-crank (oscillating cylinder, slotted lever): with the lengths g of the frame and a
//! of the crank, h the distance of the output's pin from the slide's line through the crank's pin, and ψ the angle from the frame's line to
//! the crank's, the distance of the outer pins must be at least |h|; the output is dead where the crank is square to the slide:
//!
//! ```text
//! u₁ = g − a − h    u₂ = g − a + h    v₁ = g + a − h    v₂ = g + a + h
//! limit          tan²(ψ/2) = −u₁u₂/(v₁v₂)   if u₁u₂ < 0
//! output dead    ψ = ±ν₁, ψ = ±ν₂ + 180°    tan²(ν₁/2) = u₁/v₂    tan²(ν₂/2) = v₁/u₂
//! swing = ν₂ − ν₁
//! ```

use super::cycles::Chain;
use super::{Closing, Extreme, Inversion, Loop, Possible, Posture, Shape, SliderCrank, Stroke, Turning, Writing};
use crate::graph::Expr;
use crate::graph::number::Number;

/// A loop with its slide on the frame; `ahead` is 1 if the pin on the slider lies ahead of the crank's pin. `None` if it closes at no angle.
pub(super) fn of(chain: &Chain<'_>, ahead: i64, inversion: Inversion, closing: &Closing<'_>) -> Option<Loop> {
    let joint = |hinge: usize| chain.hinge_name(hinge).to_owned();
    let dimensions = [
        ("a", chain.distance_name([0, 1])),
        ("r", chain.distance_name([1, 2])),
        ("c", format!("eccentricity of {} from {}", joint(2), joint(0))),
    ];
    let writing = Writing::new(chain, closing, &dimensions);
    let graph = writing.graph;
    let [a, r] = [(0, "a"), (1, "r")].map(|(body, symbol)| writing.length(body, symbol));
    let slide = &chain.hinges[3];
    let on_frame = slide.sides[1].to(chain.hinges[0].sides[0]);
    let on_slider = slide.sides[0].to(chain.hinges[2].sides[1]);
    let c =
        writing.named(on_slider.y - on_frame.y, "eccentricity", "c, across the slide from the driver to the rod's end");
    let margin = |value: Expr<'_>, name: &str, equation: &str| writing.named(graph.expr(value.id()), name, equation);
    let m1 = margin((r - a) - c, "m1", "m₁ = r − a − c");
    let m2 = margin((r - a) + c, "m2", "m₂ = r − a + c");
    let f1 = margin((r + a) - c, "f1", "f₁ = r + a − c");
    let f2 = margin((r + a) + c, "f2", "f₂ = r + a + c");
    let [f1, f2] = writing.assembled(&[f1, f2])?.try_into().ok()?;
    let phase = writing.named(writing.phase(slide.sides[1].axis, chain.arm(0)), "phase", "χ at the coordinate 0");
    let at = |angle, name| writing.coordinate(angle, phase, name).id();
    let quarter = graph.constant(&Number::pi(1, 2));

    // From −90°, where the rod is inclined most to the one side, to +90°, where it is most to the other.
    let near = writing.twice(-m1, f1, "near", "χ + 90° at the limit: tan²((χ + 90°)/2) = −m₁/f₁");
    let far = writing.twice(f2, -m2, "far", "χ + 90° at the other limit: cot²((χ − 90°)/2) = −f₂/m₂");
    let near2 = writing.named(m1 * m2, "folded2", "m₁m₂ = (r − a)² − c²");
    let far2 = f1 * f2;
    let (inner, outer) = (near2.non_negative().sqrt(), far2.non_negative().sqrt());
    let outer = writing.named(outer, "reach_stretched", "√(f₁f₂) = √((r + a)² − c²)");
    let inner = writing.named(inner, "reach_folded", "√(m₁m₂) = √((r − a)² − c²)");
    let stretched = graph.atan2(c, ahead * outer);
    let stretched = writing.named(stretched, "chi_stretched", "χ with crank and rod stretched");
    let shorter = r - a;
    let folded = graph.atan2(-(c * shorter), -(ahead * (shorter.abs() * inner)));
    let folded = writing.named(folded, "chi_folded", "χ with crank and rod folded");
    let advance = graph.atan2(c, inner) - graph.atan2(c, outer);
    let advance = writing.named(advance, "advance", "the crank's turn between the dead centres, beyond π");
    let stroke = writing.named(outer - inner, "stroke", "√(f₁f₂) − √(m₁m₂)");
    let least = writing.twice(m1, f2, "mu_least", "tan²(μ/2) = m₁/f₂, at χ = −90° or a limit");
    let greatest = writing.twice(f1, m2, "mu_greatest", "tan²(μ/2) = f₁/m₂, at χ = 90° or a limit");

    let dead = |margins: &[Expr<'_>], (angle, name), hinge, posture| Possible {
        margins: margins.iter().map(|margin| margin.id()).collect(),
        at: at(angle, name),
        joint: joint(hinge),
        posture,
    };
    let (dead_centres, stroke) = if inversion == Inversion::OnFrame {
        let dead = [
            dead(&[], (stretched, "dead_stretched"), 1, Posture::Stretched),
            dead(&[near2], (folded, "dead_folded"), 1, Posture::Folded),
        ];
        let margins = [m1, m2].map(Expr::id).to_vec();
        (dead.to_vec(), Some(Stroke { margins, extent: stroke.id(), advance: advance.id() }))
    } else {
        // The slider is as near to the driver as it comes: the rod's end is square to the slide from it.
        let turned = writing.twice(
            (m2 * f1).abs(),
            (m1 * f2).abs(),
            "delta",
            "|χ − 90°| where the slider is nearest to the driver",
        );
        (vec![dead(&[-near2], (quarter + ahead * turned, "dead"), 3, Posture::Square)], None)
    };
    let shape = SliderCrank {
        inversion,
        range: Turning {
            centre: at(-quarter, "centre"),
            near: Some([m1.id(), near.id()]),
            far: Some([m2.id(), far.id()]),
            joint: joint(2),
            postures: [Posture::Square; 2],
        },
        dead_centres,
        stroke,
        transmission: Some([
            Extreme { angle: least.id(), at: at(near - quarter, "mu_least") },
            Extreme { angle: greatest.id(), at: at(far - quarter, "mu_greatest") },
        ]),
    };
    let title = title(&writing, inversion);
    let meaning = format!("χ, from the direction of the slide {} to the line {} {},", joint(3), joint(0), joint(1));
    let origin = writing.origin(meaning, phase);
    Some(writing.of(title, &[a, r, c], origin, Shape::SliderCrank(shape)))
}

/// What a loop with its slide beside the driver is.
fn title(writing: &Writing<'_>, inversion: Inversion) -> String {
    let chain = &writing.chain;
    let ([first, second, third, fourth], driver) =
        ([0, 1, 2, 3].map(|body| chain.body_name(body)), chain.hinge_name(0));
    if inversion == Inversion::OnFrame {
        return format!("slider-crank {}: {first} driven at {driver}, {second}, {third} on {fourth}", writing.name);
    }
    format!(
        "inverted slider-crank {}: {fourth} driven at {driver}, {third} sliding on it, {second} on {first}",
        writing.name
    )
}

/// A loop with its slide opposite to the driver; `ahead` is 1 if the output's pin lies ahead of the crank's. `None` if it closes at no angle.
pub(super) fn inverted(chain: &Chain<'_>, ahead: i64, closing: &Closing<'_>) -> Option<Loop> {
    let joint = |hinge: usize| chain.hinge_name(hinge).to_owned();
    let dimensions = [
        ("g", chain.distance_name([0, 3])),
        ("a", chain.distance_name([0, 1])),
        ("h", format!("offset of {} from the line of the slide through {}", joint(3), joint(1))),
    ];
    let writing = Writing::new(chain, closing, &dimensions);
    let [a, g] = [(0, "a"), (3, "g")].map(|(body, symbol)| writing.length(body, symbol));
    let slide = &chain.hinges[2];
    let on_crank = slide.sides[0].to(chain.hinges[1].sides[1]);
    let on_frame = slide.sides[1].to(chain.hinges[3].sides[0]);
    let h =
        writing.named(on_frame.y - on_crank.y, "offset", "h, across the slide from the crank's pin to the output's");
    let u1 = writing.named((g - a) - h, "u1", "u₁ = g − a − h");
    let u2 = writing.named((g - a) + h, "u2", "u₂ = g − a + h");
    let v1 = writing.named((g + a) - h, "v1", "v₁ = g + a − h");
    let v2 = writing.named((g + a) + h, "v2", "v₂ = g + a + h");
    let [v1, v2] = writing.assembled(&[v1, v2])?.try_into().ok()?;
    let phase = writing.named(writing.phase(-chain.arm(3), chain.arm(0)), "phase", "ψ at the coordinate 0");
    let at = |angle, name| writing.coordinate(angle, phase, name).id();
    let nearest = writing.named(u1 * u2, "near2", "(g − a)² − h² = u₁u₂");
    let near = writing.twice(
        -nearest,
        v1 * v2,
        "psi_square",
        "ψ where the line of the pins is square to the slide: tan²(ψ/2) = −u₁u₂/(v₁v₂)",
    );
    let first = writing.twice(u1, v2, "nu1", "ν₁: tan²(ν/2) = u₁/v₂");
    let second = writing.twice(v1, u2, "nu2", "ν₂: tan²(ν/2) = v₁/u₂");
    let swing = writing.named(second - first, "swing", "angle of the output between its dead centres: ν₂ − ν₁");
    let dead = |margin: Expr<'_>, angle, name| Possible {
        margins: vec![margin.id()],
        at: at(angle, name),
        joint: joint(1),
        posture: Posture::Square,
    };
    let shape = SliderCrank {
        inversion: Inversion::Opposite,
        range: Turning {
            centre: at(writing.graph.zero(), "centre"),
            near: Some([nearest.id(), near.id()]),
            far: None,
            joint: joint(2),
            postures: [Posture::Square; 2],
        },
        dead_centres: vec![dead(u1, ahead * first, "dead_1"), dead(u2, writing.pi() + ahead * second, "dead_2")],
        stroke: Some(Stroke { margins: [u1, u2].map(Expr::id).to_vec(), extent: swing.id(), advance: swing.id() }),
        transmission: None,
    };
    let names = [0, 1, 2, 3].map(|body| chain.body_name(body));
    let title = format!(
        "inverted slider-crank {}: {} driven at {}, {} sliding along {} on {}",
        writing.name,
        names[0],
        joint(0),
        names[1],
        names[2],
        names[3]
    );
    let lines = [[0, 3], [0, 1]].map(|[from, to]| format!("the line {} {}", joint(from), joint(to)));
    let origin = writing.origin(format!("ψ, from {} to {},", lines[0], lines[1]), phase);
    Some(writing.of(title, &[g, a, h], origin, Shape::SliderCrank(shape)))
}
