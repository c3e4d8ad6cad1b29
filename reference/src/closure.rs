//! Closures: where a group can be assembled in two ways, the file's guess says which one is meant.
//!
//! Which groups there are is the compiler's to say. It offers the sides of each group that needs one, as items to be written, and the
//! guess decides between them. Whether a dyad folds with its driver is the compiler's to say too: `smooth` is written where it is taken.

use linkage_codegen::diagnostics::Sink;
use linkage_codegen::model::Model;
use linkage_codegen::model::ids::JointId;
use linkage_codegen::topology::{Freedom, Group, Topology};
use linkage_codegen::{Linkage, Refusal, analyse};
use proc_macro2::LexError;

use crate::declaration::{Declaration, is_pure_couple, joint_of, line_of};
use crate::exact::nearest;
use crate::file::{Coordinate, End, File};
use crate::number::{Number, Raw};

/// A declaration that the compiler took, with its closures.
pub(crate) struct Closed {
    pub(crate) text: String,
    pub(crate) linkage: Linkage,
}

/// Why a declaration was not taken.
#[derive(Debug)]
pub(crate) enum Refused {
    /// What the compiler said of it.
    Declined(Vec<String>),
    /// Nothing was said of it: its text cannot be read, or the compiler panics.
    Broken(String),
}

/// The first line of what a compiler said: the message without its remarks.
pub(crate) fn first_line(message: &str) -> &str {
    message.lines().next().unwrap_or("refused")
}

/// Closes all groups of a declaration.
pub(crate) fn close(file: &File, declaration: &Declaration) -> Result<Closed, Refused> {
    let guess = Guess { file, declaration, source: Source::Guess };
    let mut closures: Vec<String> = Vec::new();
    let mut without: Vec<String> = Vec::new();
    loop {
        match compile(declaration, &closures, &without)? {
            Ok(closed) => return smooth(declaration, closures, &without, &guess, closed),
            Err(refusal) => {
                let messages: Vec<String> = refusal.errors.iter().map(|error| error.message().to_owned()).collect();
                let (before, passed) = (closures.len(), without.len());
                without.extend(messages.iter().filter_map(|message| guess.without_line(message)));
                if without.len() > passed {
                    continue;
                }
                for message in &messages {
                    let chosen = guess.choose(message, refusal.model.as_deref());
                    for item in chosen.into_iter().chain(guess.starts(message)) {
                        // What several groups need, a drive's start, is said once.
                        if !closures.contains(&item) {
                            closures.push(item);
                        }
                    }
                }
                // What stands already and did not help is no way out.
                if closures.len() == before {
                    return Err(Refused::Declined(messages));
                }
            }
        }
    }
}

/// What the compiler says of a declaration, if that is text which it can read.
fn compile(
    declaration: &Declaration,
    closures: &[String],
    without: &[String],
) -> Result<Result<Closed, Refusal>, Refused> {
    let text = declaration.text(closures, without);
    let tokens =
        text.parse().map_err(|error: LexError| Refused::Broken(format!("no text of a declaration: {error}")))?;
    Ok(analyse(tokens).map(|linkage| Closed { text, linkage }))
}

/// Lets each dyad that folds with its driver go smoothly through its folds.
fn smooth(
    declaration: &Declaration,
    mut closures: Vec<String>,
    without: &[String],
    guess: &Guess<'_>,
    closed: Closed,
) -> Result<Closed, Refused> {
    let mut closed = closed;
    let sides: Vec<usize> = (0..closures.len()).filter(|index| closures[*index].starts_with("assemble ")).collect();
    for index in sides {
        for input in &guess.file.inputs {
            let Ok(at) = Number::new(&input.value, guess.file.number_mode) else { continue };
            let plain = closures[index].clone();
            closures[index] = format!("{} smooth at {};", plain.trim_end_matches(';'), at.in_unit("rad"));
            match compile(declaration, &closures, without)? {
                Ok(folding) => {
                    closed = folding;
                    break;
                }
                Err(_) => closures[index] = plain,
            }
        }
    }
    Ok(closed)
}

/// Where a pose is taken from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Source {
    Guess,
    Answer,
}

/// The pose near which the wanted one lies.
#[derive(Clone, Copy)]
struct Guess<'a> {
    file: &'a File,
    declaration: &'a Declaration,
    source: Source,
}

impl Guess<'_> {
    /// One of the sides that the compiler offers in a message. A guess whose joints are further apart than they lie from the fold says
    /// nothing of the side: then the pose does that the file knows.
    fn choose(&self, message: &str, model: Option<&Model>) -> Option<String> {
        let offers: Vec<&str> = offers(message, "assemble ").collect();
        let open = |offer: &&str| {
            let (margin, gap) = (self.margin(offer, model), self.gap(offer));
            margin.zip(gap).is_some_and(|(margin, gap)| margin.abs() <= gap)
        };
        let known = self.file.reference.is_some() && offers.iter().any(open);
        let by = if known { Self { source: Source::Answer, ..*self } } else { *self };
        let chosen = offers.iter().find(|offer| by.margin(offer, model).is_some_and(|by| by > 0.0));
        // At a guess that is on neither side, where there is no answer to come, either will do.
        chosen.or(offers.first()).map(|offer| (*offer).to_owned())
    }

    /// The starting poses of which the compiler gives an example in a message: of links, and of drives.
    fn starts(&self, message: &str) -> Vec<String> {
        let start = |offer: &str| {
            let (name, _) = offer.strip_prefix("start ")?.split_once(':')?;
            let written = |raw: &Raw, unit: &str| Some(Number::new(raw, self.file.number_mode).ok()?.in_unit(unit));
            if let Some(index) = name.strip_prefix('D').and_then(|index| index.parse::<usize>().ok()) {
                let input = self.file.inputs.get(index)?;
                let unit = if input.coord == Coordinate::Angle { "rad" } else { "m" };
                return Some(format!("start {name}: {};", written(&input.value, unit)?));
            }
            let [x, y, angle] = self.file.guess.get(self.declaration.links.original(name)?)?;
            let (x, y, angle) = (written(x, "m")?, written(y, "m")?, written(angle, "rad")?);
            Some(format!("start {name}: ({x}, {y}), angle {angle};"))
        };
        offers(message, "start ").filter_map(start).collect()
    }

    /// The scene of a line that the compiler refuses because there is none, where the file knows of none either.
    fn without_line(&self, message: &str) -> Option<String> {
        let of = first_line(message).strip_prefix("the acceleration of the centre of mass of ")?;
        let name = of.strip_suffix(" vanishes at every pose: it has no direction")?;
        let link = self.declaration.links.original(name)?;
        let none = self.file.answers().all(|answers| is_pure_couple(self.file, answers, link));
        none.then(|| line_of(name))
    }

    /// How far a joint lies on the side that is offered: `assemble B: left(A -> B0);`.
    fn margin(&self, offer: &str, model: Option<&Model>) -> Option<f64> {
        let (inner, side) = offer.strip_prefix("assemble ")?.split_once(':')?;
        let (word, of) = side.trim().split_once('(')?;
        let of: Vec<[f64; 2]> =
            of.split_once(')')?.0.split("->").map(|joint| self.place(joint.trim())).collect::<Option<_>>()?;
        let at = self.place(inner)?;
        Some(match (word, &of[..]) {
            ("left", [p, q]) => across(from(*p, *q), from(*p, at)),
            ("right", [p, q]) => -across(from(*p, *q), from(*p, at)),
            ("ahead", [_]) => self.ahead(offer, model?)?,
            ("behind", [_]) => -self.ahead(offer, model?)?,
            _ => return None,
        })
    }

    /// How far the two points of the pins of an offer are apart: of an answer not at all.
    fn gap(&self, offer: &str) -> Option<f64> {
        let (inner, side) = offer.strip_prefix("assemble ")?.split_once(':')?;
        let of = side.split_once('(')?.1.split_once(')')?.0.split("->");
        let pin = |joint: &str| {
            let joint = joint_of(self.file, &self.declaration.joints, joint.trim())?;
            let apart = from(self.end(&joint.a)?, self.end(&joint.b)?);
            let holds = matches!(joint.kind, crate::file::JointKind::Revolute | crate::file::JointKind::Weld);
            Some(if holds { apart[0].hypot(apart[1]) } else { 0.0 })
        };
        std::iter::once(inner).chain(of).map(pin).sum()
    }

    /// How far ahead of the pin in an offer the inner joint of its group lies along the slide or slot, of an inner slide the other pin.
    fn ahead(&self, offer: &str, model: &Model) -> Option<f64> {
        let (inner, side) = offer.strip_prefix("assemble ")?.split_once(':')?;
        let pin = side.split_once('(')?.1.split_once(')')?.0.trim();
        let named = |joint: &JointId| model.joint(*joint).name.text.as_str();
        let topology = Topology::of(model, &Sink::default())?;
        let joints = |group: &Group| -> Vec<JointId> { group.outer.iter().chain(&group.inner).copied().collect() };
        let group = topology.motion.iter().find(|group| joints(group).iter().any(|joint| named(joint) == inner))?;
        let slides = |joint: &&JointId| matches!(group.freedom(model, **joint), Freedom::Slide | Freedom::TurnAndSlide);
        let all = joints(group);
        let slide = all.iter().find(slides)?;
        // What slides on both links is no place of its own.
        let between =
            group.inner.contains(slide) && group.freedom(model, *slide) == Freedom::Slide && named(slide) == inner;
        let at = if between { group.outer.iter().map(named).find(|name| *name != pin)? } else { inner };
        let joint = joint_of(self.file, &self.declaration.joints, named(slide))?;
        let [x, y] = joint.axis.as_ref()?;
        let [_, _, angle] = self.frame(&joint.a.0)?;
        let along = turned([self.file.value(x).ok()?, self.file.value(y).ok()?], angle);
        Some(dot(along, from(self.place(pin)?, self.place(at)?)))
    }

    /// Where a joint is: between its two points, which a guess need not bring together exactly.
    fn place(&self, joint: &str) -> Option<[f64; 2]> {
        let joint = joint_of(self.file, &self.declaration.joints, joint)?;
        let [a, b] = [self.end(&joint.a)?, self.end(&joint.b)?];
        match joint.kind {
            crate::file::JointKind::Revolute | crate::file::JointKind::Weld => {
                Some([f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])])
            }
            _ => Some(b),
        }
    }

    fn end(&self, end: &End) -> Option<[f64; 2]> {
        let [at_x, at_y, angle] = self.frame(&end.0)?;
        let [x, y] = turned(self.file.place(end)?, angle);
        Some([at_x + x, at_y + y])
    }

    fn frame(&self, link: &str) -> Option<[f64; 3]> {
        if self.source == Source::Guess || link == "ground" {
            return self.file.guessed(link);
        }
        let [x, y, angle] = self.file.reference.as_ref()?.pose.get(link)?;
        Some([nearest(x).ok()?, nearest(y).ok()?, nearest(angle).ok()?])
    }
}

/// The items of this kind that stand in a message.
fn offers<'a>(message: &'a str, kind: &'a str) -> impl Iterator<Item = &'a str> {
    let lines = message.lines().map(|line| line.trim_start_matches("help:").trim());
    lines.filter(move |line| line.starts_with(kind))
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

fn from(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [b[0] - a[0], b[1] - a[1]]
}

/// How far b lies to the left of a line along a.
fn across(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]) / a[0].hypot(a[1])
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::{Refused, compile};
    use crate::declaration::Declaration;
    use crate::file::File;

    #[test]
    fn text_that_cannot_be_read_is_no_refusal() {
        let text = include_str!("../../tests/reference/neg_o5_over_driven.json");
        let file = File::parse(text).expect("a file");
        let declaration = Declaration::of(&file).expect("a declaration");
        assert!(matches!(compile(&declaration, &[], &[]), Ok(Err(_))));
        assert!(matches!(compile(&declaration, &["assemble B: left(".into()], &[]), Err(Refused::Broken(_))));
    }
}
