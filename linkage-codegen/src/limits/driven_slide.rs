//! Three pins and a slide, driven at the slide: a piston that turns a crank, a cylinder that lifts a boom.
//!
//! With the lengths r₁ and r₂ of the two links without the slide, c the distance of their outer pins across the slide and x along it:
//!
//! ```text
//! D² = x² + c²      |r₁ − r₂| ≤ D ≤ r₁ + r₂
//! far    x² = (r₁ + r₂ − c)(r₁ + r₂ + c)
//! near   x² = (|r₁ − r₂| − c)(|r₁ − r₂| + c)   if |r₁ − r₂| > |c|
//! ```

use super::cycles::Chain;
use super::{Closing, DrivenSlide, Loop, Shape, Writing};

/// A loop that its slide drives. `None` if it closes at no travel.
pub(super) fn of(chain: &Chain<'_>, closing: &Closing<'_>) -> Option<Loop> {
    let joint = |hinge: usize| chain.hinge_name(hinge).to_owned();
    let dimensions = [
        ("r₁", chain.distance_name([1, 2])),
        ("r₂", chain.distance_name([3, 2])),
        ("c", format!("offset of {} from {} across the slide", joint(1), joint(3))),
    ];
    let writing = Writing::new(chain, closing, &dimensions);
    let [r1, r2] = [(1, "r1"), (2, "r2")].map(|(body, symbol)| writing.length(body, symbol));
    let slide = &chain.hinges[0];
    let behind = slide.sides[1].to(chain.hinges[1].sides[0]);
    let before = slide.sides[0].to(chain.hinges[3].sides[1]);
    let offset = behind - before;
    let c = writing.named(offset.y, "offset", "c, across the slide from the one outer pin to the other");
    let phase = writing.named(offset.x, "phase", "x at the travel 0");
    let (sum, difference) = (r1 + r2, (r1 - r2).abs());
    let margins = [writing.named(sum - c, "far1", "r₁ + r₂ − c"), writing.named(sum + c, "far2", "r₁ + r₂ + c")];
    let [far1, far2] = writing.assembled(&margins)?.try_into().ok()?;
    let near2 = writing.named((difference - c) * (difference + c), "near2", "(r₁ − r₂)² − c²");
    let near = writing.named(near2.non_negative().sqrt(), "near", "√((r₁ − r₂)² − c²), or 0");
    let far = writing.named((far1 * far2).non_negative().sqrt(), "far", "√((r₁ + r₂)² − c²)");
    let centre = if slide.forwards { -phase } else { phase };
    let shape = DrivenSlide { centre: centre.id(), near: [near2.id(), near.id()], far: far.id(), joint: joint(2) };
    let names = [0, 1, 2, 3].map(|body| chain.body_name(body));
    let title = format!(
        "driven slide {}: {} and {} along {}, with {} and {}",
        writing.name,
        names[3],
        names[0],
        joint(0),
        names[1],
        names[2]
    );
    let meaning = format!("x, from {} to {} along the slide,", joint(3), joint(1));
    let origin = writing.origin(meaning, phase);
    Some(writing.of(title, &[r1, r2, c], origin, Shape::DrivenSlide(shape)))
}
