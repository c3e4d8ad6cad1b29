//! Results against answers.
//!
//! An effort may be off by a share of its size, a reaction by a share of the largest one, that the file states: how far rounded data
//! alone move the answer. A load's own part of an effort may be as far off as the effort, or by the share of reactions in its own
//! size: where parts cancel, each is larger than what is left of them.

use std::collections::BTreeMap;

use crate::declaration::{
    ACCELERATIONS, ALL, CENTROID, CONTROL, Declaration, INERTIA, OFFSET, ORIGIN, PARTS, PLACES, POWERS, RESOLVED,
    SHAKING, SPEEDS, WEIGHT, WORK, is_pure_couple, point_of,
};
use crate::exact::{difference, difference_of_angles, nearest};
use crate::file::{Answers, File, Limits, LinkMotion, Ordered, Reaction, Reduced};
use crate::printed::Value;

/// No limit is closer than some roundings.
const ROUNDINGS: f64 = 1e-13;

/// The largest error of a file, in units of its limit.
#[derive(Clone, Debug)]
pub(crate) struct Worst {
    pub(crate) ratio: f64,
    pub(crate) what: String,
    /// The same against the closer limits, if the file has some.
    pub(crate) tight: Option<f64>,
}

impl Worst {
    pub(crate) fn new() -> Self {
        Self { ratio: 0.0, what: String::new(), tight: None }
    }

    /// Whether all numbers are within closer limits that the file has.
    pub(crate) fn is_tight(&self) -> bool {
        self.tight.is_some_and(|ratio| ratio <= 1.0)
    }

    fn see(&mut self, error: f64, [loose, tight]: [f64; 2], what: impl FnOnce() -> String) {
        let ratio = |limit: f64| if error == 0.0 { 0.0 } else { error / limit };
        // What is no number is beyond every limit.
        let beyond = |ratio: f64| if ratio.is_nan() { f64::INFINITY } else { ratio };
        let ratio = [beyond(ratio(loose)), beyond(ratio(tight))];
        if ratio[0] > self.ratio || self.what.is_empty() {
            *self = Self { ratio: ratio[0], what: what(), tight: self.tight };
        }
        self.tight = self.tight.map(|worst| worst.max(ratio[1]));
    }
}

/// The results of the scenes in one form at one position.
pub(crate) type Results = BTreeMap<String, Value>;

/// Holds the results of a position against its answers.
pub(crate) fn compare(
    file: &File,
    declaration: &Declaration,
    answers: &Answers,
    results: &Results,
    worst: &mut Worst,
) -> Result<(), String> {
    let scales = Scales::of(file, answers)?;
    if answers.accept.as_ref().is_some_and(|accept| accept.tight.is_some()) {
        worst.tight = worst.tight.or(Some(0.0));
    }
    let comparison = Comparison { file, declaration, answers, scales };
    let scene = |name: &str| {
        let value = results.get(name).ok_or_else(|| format!("the scene `{name}` printed nothing"))?;
        if let Value::Error(error) = value { Err(format!("{name}: {error}")) } else { Ok(value) }
    };
    comparison.pose(scene(PLACES)?, worst)?;
    for (name, answers) in [(SPEEDS, &answers.velocity), (ACCELERATIONS, &answers.acceleration)] {
        if !answers.0.is_empty() {
            comparison.motion(scene(name)?, answers, name, worst)?;
        }
    }
    for (link, line) in answers.inertia_offset.iter() {
        let name = declaration.links.find(link)?;
        let field = format!("{name}_offset");
        let own = scene(&format!("{OFFSET}{name}"))?.field(&field).ok_or_else(|| format!("no line of `{link}`"))?;
        comparison.line(own, (link, line), worst)?;
    }
    comparison.pure_couples(results)?;
    if let Some(power) = &answers.power {
        comparison.power(scene(POWERS)?, power, worst)?;
    }
    if let Some(shaking) = &answers.shaking {
        if declaration.shakes {
            comparison.shaking(scene(SHAKING)?, shaking, worst)?;
        } else if [&shaking.force[0], &shaking.force[1], &shaking.moment].into_iter().any(|number| number != "0") {
            return Err("without any mass something shakes".into());
        }
    }
    if let Some(reduced) = &answers.reduced {
        if declaration.shakes {
            comparison.equation_of_motion(scene(CONTROL)?, reduced, worst)?;
        } else {
            comparison.without_mass(scene(ALL)?, reduced, worst)?;
        }
    }
    comparison.equilibrium(scene(ALL)?, worst)?;
    comparison.resolved(scene(ALL)?, results.get(RESOLVED), worst)?;
    comparison.work(scene(WORK)?, worst)?;
    comparison.parts(scene(PARTS)?, worst)
}

/// What errors are measured by, and how far they may go: loose limits and tight ones.
struct Scales {
    effort: Vec<f64>,
    reaction: f64,
    length: f64,
    limits: [Limits; 2],
    pose: f64,
    motion: f64,
}

impl Scales {
    fn of(file: &File, answers: &Answers) -> Result<Self, String> {
        let limit = |floor: &str| Ok::<f64, String>((64.0 * nearest(floor)?).max(ROUNDINGS));
        let limits = match (&answers.accept, &answers.f64_floor) {
            (Some(accept), _) => [accept.loose.clone(), accept.tight.clone().unwrap_or_else(|| accept.loose.clone())],
            (None, Some(floor)) => {
                let effort = floor.effort.iter().map(|floor| limit(floor)).collect::<Result<_, _>>()?;
                let limits = Limits { effort, reaction: limit(&floor.reaction_normwise)? };
                [limits.clone(), limits]
            }
            (None, None) => {
                let limits = Limits { effort: vec![ROUNDINGS; answers.efforts.len()], reaction: ROUNDINGS };
                [limits.clone(), limits]
            }
        };
        let (effort, reaction) = match &answers.accept {
            Some(accept) => {
                let effort = accept.effort_scale.iter().map(|scale| nearest(scale)).collect::<Result<_, _>>()?;
                (effort, nearest(&accept.reaction_scale)?)
            }
            None => (effort_scales(answers)?, largest(answers.reactions.iter().map(|(_, reaction)| reaction))?),
        };
        // Without a measure of its own, a pose may move as far as the forces that follow from it.
        let moved = limits[0].effort.iter().fold(limits[0].reaction, |most, limit| most.max(*limit));
        let pose = answers.f64_floor.as_ref().map_or(Ok(moved), |floor| limit(&floor.pose))?;
        Ok(Self { effort, reaction, length: length_of(file)?, limits, pose, motion: moved })
    }

    fn effort_limits(&self, index: usize) -> [f64; 2] {
        let scale = self.effort.get(index).copied().unwrap_or(0.0);
        self.limits.each_ref().map(|limits| scale * limits.effort.get(index).copied().unwrap_or(0.0))
    }
}

/// The size of each effort; of one that vanishes, that of its parts.
fn effort_scales(answers: &Answers) -> Result<Vec<f64>, String> {
    let scale = |(index, effort): (usize, &crate::file::EffortAnswer)| {
        let size = nearest(effort.text())?.abs();
        let parts = answers.contributions.iter().map(|(_, part)| part.efforts.get(index));
        let parts: f64 = parts.flatten().map(|part| nearest(part).map(f64::abs)).sum::<Result<_, _>>()?;
        Ok(if size == 0.0 { parts } else { size })
    };
    answers.efforts.iter().enumerate().map(scale).collect()
}

fn largest<'a>(reactions: impl Iterator<Item = &'a Reaction>) -> Result<f64, String> {
    let size = |reaction: &Reaction| Ok(nearest(&reaction.force[0])?.hypot(nearest(&reaction.force[1])?));
    reactions.map(size).try_fold(0.0, |most: f64, size: Result<f64, String>| Ok(most.max(size?)))
}

/// The largest distance of two points of a link, or a driven travel: by it places are measured, and couples against forces.
fn length_of(file: &File) -> Result<f64, String> {
    let value = |raw| file.value(raw);
    let mut length: f64 = 0.0;
    for body in std::iter::once(&file.ground).chain(file.links.iter().map(|(_, body)| body)) {
        let points = body.points.iter().map(|(_, [x, y])| Ok([value(x)?, value(y)?]));
        let points = points.collect::<Result<Vec<_>, String>>()?;
        for (index, a) in points.iter().enumerate() {
            length = points[..index].iter().fold(length, |most, b| most.max((a[0] - b[0]).hypot(a[1] - b[1])));
        }
    }
    for input in file.inputs.iter().filter(|input| input.coord == crate::file::Coordinate::Displacement) {
        length = length.max(value(&input.value)?.abs());
    }
    Ok(if length > 0.0 { length } else { 1.0 })
}

struct Comparison<'a> {
    file: &'a File,
    declaration: &'a Declaration,
    answers: &'a Answers,
    scales: Scales,
}

impl Comparison<'_> {
    fn pose(&self, own: &Value, worst: &mut Worst) -> Result<(), String> {
        let limit = [self.scales.pose; 2];
        for (link, [x, y, angle]) in self.answers.pose.iter() {
            let name = self.declaration.links.find(link)?;
            let missing = || format!("the pose has no `{link}`");
            let at = own.field(&format!("{name}_{ORIGIN}")).and_then(Value::vector).ok_or_else(missing)?;
            let turn = own.field(&format!("{name}_angle")).and_then(Value::number).ok_or_else(missing)?;
            let off = difference(at[0], x)?.hypot(difference(at[1], y)?);
            worst.see(off / self.scales.length, limit, || format!("place of {link}"));
            worst.see(difference_of_angles(turn, angle)?.abs(), limit, || format!("angle of {link}"));
        }
        let centroids = self.answers.centroid.iter().map(|(link, at)| (link, CENTROID, CENTROID.to_owned(), at));
        let mut places: Vec<(&str, &str, String, &[String; 2])> = centroids.collect();
        for (link, points) in self.answers.points.iter() {
            for (point, at) in points.iter() {
                places.push((link, point, point_of(self.file, link, point)?, at));
            }
        }
        for (link, point, declared, [x, y]) in places {
            let found = own.field(&format!("{}_{declared}", self.declaration.links.find(link)?));
            let at = found.and_then(Value::vector).ok_or_else(|| format!("the pose has no `{point}` of `{link}`"))?;
            let off = difference(at[0], x)?.hypot(difference(at[1], y)?);
            worst.see(off / self.scales.length, limit, || format!("place of {point} of {link}"));
        }
        Ok(())
    }

    /// Velocities or accelerations, measured by the largest of them: what turns by what that is over the length of the linkage.
    fn motion(&self, own: &Value, answers: &Ordered<LinkMotion>, scene: &str, worst: &mut Worst) -> Result<(), String> {
        let size = |[x, y]: &[String; 2]| Ok::<f64, String>(nearest(x)?.hypot(nearest(y)?));
        let mut scale: f64 = 0.0;
        for (_, answer) in answers.iter() {
            let centroid = answer.centroid.as_ref().map_or(Ok(0.0), size)?;
            scale =
                scale.max(size(&answer.origin)?).max(centroid).max(nearest(&answer.angle)?.abs() * self.scales.length);
        }
        let limits = [self.scales.motion * scale; 2];
        for (link, answer) in answers.iter() {
            let name = self.declaration.links.find(link)?;
            let missing = |what: &str| format!("{scene} have no {what} of `{link}`");
            let points = [(ORIGIN, Some(&answer.origin)), (CENTROID, answer.centroid.as_ref())];
            for (point, known) in points.into_iter().filter_map(|(point, known)| Some((point, known?))) {
                let found = own.field(&format!("{name}_{point}")).and_then(Value::vector);
                let [x, y] = found.ok_or_else(|| missing(point))?;
                let off = difference(x, &known[0])?.hypot(difference(y, &known[1])?);
                worst.see(off, limits, || format!("{scene}: {point} of {link}"));
            }
            let turn = own.field(&format!("{name}_angle")).and_then(Value::number).ok_or_else(|| missing("angle"))?;
            let off = difference(turn, &answer.angle)?.abs() * self.scales.length;
            worst.see(off, limits, || format!("{scene}: angle of {link}"));
        }
        Ok(())
    }

    /// The line of a link's inertia.
    fn line(
        &self,
        own: &Value,
        (link, answer): (&str, &crate::file::InertiaOffset),
        worst: &mut Worst,
    ) -> Result<(), String> {
        let missing = || format!("the line of `{link}` is not whole");
        let distance = own.field("distance").and_then(Value::number).ok_or_else(missing)?;
        let [x, y] = own.field("vector").and_then(Value::vector).ok_or_else(missing)?;
        let scale = nearest(&answer.h)?.abs().max(self.scales.length);
        let limits = [self.scales.motion * scale; 2];
        // Seen from the acceleration, it is on the right where it is positive.
        worst.see(difference(distance, &answer.h)?.abs(), limits, || format!("offset of {link}"));
        let off = difference(x, &answer.offset[0])?.hypot(difference(y, &answer.offset[1])?);
        worst.see(off, limits, || format!("line of {link}"));
        Ok(())
    }

    /// Where inertia is a couple alone, its line must be an error; if that is so at every pose, the compiler has refused it.
    fn pure_couples(&self, results: &Results) -> Result<(), String> {
        for (link, _) in self.file.links.iter().filter(|(link, _)| is_pure_couple(self.file, self.answers, link)) {
            match results.get(&format!("{OFFSET}{}", self.declaration.links.find(link)?)) {
                None => {}
                Some(Value::Error(error)) if error.starts_with("NoDirection") => {}
                Some(Value::Error(error)) => return Err(format!("the line of `{link}` fails otherwise: {error}")),
                Some(_) => return Err(format!("the inertia of `{link}` is a couple alone, and was given a line")),
            }
        }
        Ok(())
    }

    /// Powers, each measured by its effort's limit: a rate is as it is given, or as exact as the pose. That of all by the sum of their
    /// sizes, with what the loads and the masses take.
    fn power(&self, own: &Value, answer: &crate::file::Power, worst: &mut Worst) -> Result<(), String> {
        let number =
            |name: &str| own.field(name).and_then(Value::number).ok_or_else(|| format!("there is no power `{name}`"));
        let mut scale = nearest(&answer.loads)?.abs().max(nearest(&answer.kinetic_energy_rate)?.abs());
        for power in &answer.inputs {
            scale = scale.max(nearest(power)?.abs());
        }
        let limits =
            self.scales.limits.each_ref().map(|limits| scale * limits.effort.iter().fold(0.0, |a: f64, b| a.max(*b)));
        for (index, known) in answer.inputs.iter().enumerate() {
            let unknown = self.declaration.unknowns.get(index).ok_or_else(|| format!("there is no input {index}"))?;
            worst.see(difference(number(&format!("{unknown}_power"))?, known)?.abs(), limits, || {
                format!("power {index}")
            });
        }
        worst.see(difference(number("power")?, &answer.effort)?.abs(), limits, || "power".into());
        Ok(())
    }

    /// The resultant of inertia, measured by the largest of its links' forces, which cancel in a balanced machine; the moment by these
    /// at the length of the linkage, or at the distance from the origin.
    fn shaking(&self, own: &Value, answer: &crate::file::Shaking, worst: &mut Worst) -> Result<(), String> {
        let found = own.fields().first().map(|(_, value)| value);
        let missing = || "there is no resultant of inertia".to_owned();
        let [x, y] = found.and_then(|value| value.field("force")?.vector()).ok_or_else(missing)?;
        let moment = found.and_then(|value| value.field("moment")?.number()).ok_or_else(missing)?;
        let [known_x, known_y] = [nearest(&answer.force[0])?, nearest(&answer.force[1])?];
        let scale = self.scales.reaction.max(known_x.hypot(known_y));
        let mut distance = self.scales.length;
        for (_, [x, y, _]) in self.answers.pose.iter() {
            distance = distance.max(nearest(x)?.hypot(nearest(y)?));
        }
        let limits = [self.scales.motion * scale; 2];
        let off = difference(x, &answer.force[0])?.hypot(difference(y, &answer.force[1])?);
        worst.see(off, limits, || "shaking force".into());
        worst.see(difference(moment, &answer.moment)?.abs() / distance, limits, || "shaking moment".into());
        Ok(())
    }

    /// Masses are measured by the largest one of their row; `h` also by the effort that it is a part of.
    fn equation_of_motion(&self, own: &Value, answer: &Reduced, worst: &mut Worst) -> Result<(), String> {
        let part = |name: &str, place: &[usize]| {
            let found = own.field(name).and_then(|value| value.entry(place));
            found.ok_or_else(|| format!("the equation of motion has no `{name}`"))
        };
        let limits = |row: usize, scale: f64| {
            let limit = |limits: &Limits| limits.effort.get(row).map_or(0.0, |effort| effort.max(limits.reaction));
            self.scales.limits.each_ref().map(|limits| scale * limit(limits))
        };
        for (name, rows) in [("M", &answer.mass), ("M_kinetic", &answer.kinetic)] {
            for (row, known) in rows.iter().enumerate() {
                let mut sizes = known.iter().map(|value| nearest(value).map(f64::abs));
                let scale = sizes.try_fold(0.0, |most: f64, size| Ok::<f64, String>(most.max(size?)))?;
                for (column, value) in known.iter().enumerate() {
                    let off = difference(part(name, &[row, column])?, value)?.abs();
                    worst.see(off, limits(row, scale), || format!("{name} {row} {column}"));
                }
            }
        }
        for (row, value) in answer.bias.iter().enumerate() {
            let scale = self.scales.effort.get(row).copied().unwrap_or(0.0).max(nearest(value)?.abs());
            worst.see(difference(part("h", &[row])?, value)?.abs(), limits(row, scale), || format!("h {row}"));
        }
        Ok(())
    }

    /// Without any mass nothing resists an acceleration: the equation of motion is that of equilibrium.
    fn without_mass(&self, own: &Value, answer: &Reduced, worst: &mut Worst) -> Result<(), String> {
        if answer.mass.iter().chain(&answer.kinetic).flatten().any(|number| number != "0") {
            return Err("without any mass something resists an acceleration".into());
        }
        for (row, value) in answer.bias.iter().enumerate() {
            let off = difference(self.effort(own, row)?, value)?.abs();
            worst.see(off, self.scales.effort_limits(row), || format!("h {row}"));
        }
        Ok(())
    }

    fn equilibrium(&self, own: &Value, worst: &mut Worst) -> Result<(), String> {
        for (index, answer) in self.answers.efforts.iter().enumerate() {
            let off = difference(self.effort(own, index)?, answer.text())?.abs();
            worst.see(off, self.scales.effort_limits(index), || format!("effort {index}"));
        }
        let limits = self.scales.limits.each_ref().map(|limits| limits.reaction * self.scales.reaction);
        self.reactions(own, self.answers.reactions.iter(), limits, "", worst)
    }

    fn effort(&self, own: &Value, index: usize) -> Result<f64, String> {
        let name = self.declaration.unknowns.get(index).ok_or_else(|| format!("there is no input {index}"))?;
        own.field(name).and_then(Value::number).ok_or_else(|| format!("there is no effort `{name}`"))
    }

    fn reactions<'r>(
        &self,
        own: &Value,
        answers: impl Iterator<Item = (&'r str, &'r Reaction)>,
        limits: [f64; 2],
        of: &str,
        worst: &mut Worst,
    ) -> Result<(), String> {
        for (joint, answer) in answers {
            let name = self.declaration.joints.find(joint)?;
            let missing = || format!("there is no reaction of `{joint}`");
            let own = own.field(name).ok_or_else(missing)?;
            let force = own.vector().or_else(|| own.field("force")?.vector()).ok_or_else(missing)?;
            let off = difference(force[0], &answer.force[0])?.hypot(difference(force[1], &answer.force[1])?);
            worst.see(off, limits, || format!("reaction {joint}{of}"));
            if let Some(moment) = &answer.moment {
                let couple = ["couple", "moment"].into_iter().find_map(|name| own.field(name)?.number());
                let off = difference(couple.ok_or_else(|| format!("there is no couple of `{joint}`"))?, moment)?.abs();
                worst.see(off / self.scales.length, limits, || format!("couple {joint}{of}"));
            }
            if let Some(scalar) = &answer.scalar {
                let size = ["normal", "tangential"].into_iter().find_map(|name| own.field(name)?.number());
                let off = difference(size.ok_or_else(|| format!("there is no size of `{joint}`"))?, scalar)?.abs();
                worst.see(off, limits, || format!("size of {joint}{of}"));
            }
        }
        Ok(())
    }

    /// Reactions along and across a link, both components at once; along the ground they are those that have been compared, as they are.
    fn resolved(&self, all: &Value, resolved: Option<&Value>, worst: &mut Worst) -> Result<(), String> {
        let limits = self.scales.limits.each_ref().map(|limits| limits.reaction * self.scales.reaction);
        for (joint, answer) in self.answers.along.iter() {
            let (name, link) = (self.declaration.joints.find(joint)?, &answer.link);
            let found = if link == "ground" {
                all.field(name).and_then(|own| own.vector().or_else(|| own.field("force")?.vector()))
            } else {
                let field = format!("{name}_along_{}", self.declaration.links.find(link)?);
                let own = resolved.and_then(|own| own.field(&field));
                own.and_then(|own| Some([own.field("axial")?.number()?, own.field("transverse")?.number()?]))
            };
            let [axial, transverse] = found.ok_or_else(|| match resolved {
                Some(Value::Error(error)) => format!("{RESOLVED}: {error}"),
                _ => format!("there is no reaction of `{joint}` along `{link}`"),
            })?;
            let off = difference(axial, &answer.axial)?.hypot(difference(transverse, &answer.transverse)?);
            worst.see(off, limits, || format!("reaction {joint} along {link}"));
        }
        Ok(())
    }

    fn work(&self, own: &Value, worst: &mut Worst) -> Result<(), String> {
        let plain: Vec<&str> = self.answers.efforts.iter().map(crate::file::EffortAnswer::text).collect();
        let known = self.answers.virtual_work.as_ref();
        let known = known.map_or(plain, |work| work.efforts.iter().map(String::as_str).collect());
        for (index, answer) in known.into_iter().enumerate() {
            let off = difference(self.effort(own, index)?, answer)?.abs();
            worst.see(off, self.scales.effort_limits(index), || format!("virtual work {index}"));
        }
        Ok(())
    }

    /// What each load brings. A sweep keeps only sums: then the parts add up to them.
    fn parts(&self, own: &Value, worst: &mut Worst) -> Result<(), String> {
        let found: Vec<(String, &Value)> = own.fields().iter().flat_map(|part| self.part(part)).collect();
        if self.answers.contributions.0.is_empty() {
            return self.sums(&found, worst);
        }
        // The file is silent of what brings nothing: the inertia of a link that stands still, for one.
        for (load, own) in found.iter().filter(|(load, _)| self.answers.contributions.get(load).is_none()) {
            let mut numbers = Vec::new();
            own.numbers("", &mut numbers);
            if numbers.iter().any(|(_, number)| *number != 0.0) {
                return Err(format!("`{load}` brings something, and the file knows nothing of it"));
            }
        }
        for (load, answer) in self.answers.contributions.iter() {
            let own = found.iter().find_map(|(name, value)| (name == load).then_some(*value));
            let own = own.ok_or_else(|| format!("there is no part of `{load}`"))?;
            for (index, effort) in answer.efforts.iter().enumerate() {
                let (off, size) = (difference(self.effort(own, index)?, effort)?.abs(), nearest(effort)?.abs());
                let [loose, tight] = self.scales.effort_limits(index);
                let [of_loose, of_tight] = self.scales.limits.each_ref().map(|limits| limits.reaction * size);
                worst.see(off, [loose.max(of_loose), tight.max(of_tight)], || format!("effort {index} by {load}"));
            }
            let scale = self.scales.reaction.max(largest(answer.reactions.iter().map(|(_, reaction)| reaction))?);
            let limits = self.scales.limits.each_ref().map(|limits| limits.reaction * scale);
            self.reactions(own, answer.reactions.iter(), limits, &format!(" by {load}"), worst)?;
        }
        Ok(())
    }

    /// A field of a superposition under the file's name of its load; of gravity and inertia, a field for each link.
    fn part<'v>(&self, (name, value): &'v (String, Value)) -> Vec<(String, &'v Value)> {
        let what = match name.as_str() {
            WEIGHT => "gravity",
            INERTIA => "inertia",
            _ => return vec![(self.declaration.loads.original(name).unwrap_or(name).to_owned(), value)],
        };
        let of_link = |(link, value): &'v (String, Value)| {
            let link = self.declaration.links.original(link).unwrap_or(link);
            (format!("{what}:{link}"), value)
        };
        value.fields().iter().map(of_link).collect()
    }

    fn sums(&self, parts: &[(String, &Value)], worst: &mut Worst) -> Result<(), String> {
        for (index, answer) in self.answers.efforts.iter().enumerate() {
            let own: Vec<f64> =
                parts.iter().map(|(_, part)| self.effort(part, index)).collect::<Result<_, String>>()?;
            let off = difference(own.iter().sum(), answer.text())?.abs();
            let largest = own.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
            let [loose, tight] = self.scales.effort_limits(index);
            let [of_loose, of_tight] = self.scales.limits.each_ref().map(|limits| limits.reaction * largest);
            worst.see(off, [loose.max(of_loose), tight.max(of_tight)], || format!("sum of parts of effort {index}"));
        }
        Ok(())
    }
}
