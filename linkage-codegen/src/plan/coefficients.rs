//! Kinematic coefficients: the derivatives of places and angles by the drives, of first and second order.
//!
//! Those of first order are the velocities at unit rate of one drive; those of second order the accelerations at unit rates without any of the
//! drives, or of two drives what is linear in both rates. With them `ẋ = Σ x_i q̇_i` and `ẍ = Σ x_i q̈_i + Σ x_ij q̇_i q̇_j`, whatever the motion.

use super::scenes::{Forces, joint_of, of_spot};
use super::{Field, Meaning, Motion, Output};
use crate::model::ids::DriveId;
use crate::model::units::Kind;
use crate::model::{Model, Scene, Spot, Wanted};

/// By which drives, with the name of the field.
struct By<'m, 'p> {
    drives: Vec<DriveId>,
    motion: Motion<'m, 'p>,
}

impl<'m> Forces<'_, 'm> {
    /// The coefficients that a scene asks for.
    pub(super) fn coefficients(&self, scene: &Scene) -> Output {
        let (model, graph) = (self.model, &self.model.graph);
        let drives = || (0..model.drives.len()).map(DriveId::new);
        let first: Vec<By<'m, '_>> = drives()
            .map(|drive| {
                let prefix = format!("{}_", by(model, &[drive]));
                let motion = Motion::of_drive(&self.assembly.placement, &self.assembly.pivots, drive, prefix);
                By {
                    drives: vec![drive],
                    motion: motion.through(&self.assembly.topology.motion, self.motion_rules, self.sink),
                }
            })
            .collect();
        let pairs = drives().flat_map(|one| drives().skip(one.index()).map(move |other| [one, other]));
        let second: Vec<By<'m, '_>> = pairs
            .map(|pair| {
                let prefix = format!("{}_", by(model, &pair));
                let of = pair.map(|drive| &first[drive.index()].motion);
                let motion = Motion::second_order(of, prefix);
                By {
                    drives: pair.to_vec(),
                    motion: motion.through(&self.assembly.topology.motion, self.motion_rules, self.sink),
                }
            })
            .collect();
        graph.begin_section("Kinematic coefficients");
        let fields = scene.results.iter().filter_map(|wanted| {
            let (what, shown) = match *wanted {
                Wanted::Joint(joint) => {
                    (Some(Spot::Joint(joint)), format!("the place of `{}`", joint_of(model, joint)))
                }
                Wanted::Point(end) => (Some(Spot::Point(end)), format!("the place of `{}`", model.end_name(end))),
                Wanted::Angle(link) => (None, format!("the angle of `{}`", model.link(link).name)),
                _ => return None,
            };
            let parts = first.iter().chain(&second).map(|By { drives, motion }| {
                let value = match (what, *wanted) {
                    (Some(spot), _) => Output::vector(of_spot(motion, spot).ground(), Meaning::Number),
                    (None, Wanted::Angle(link)) => Output::scalar(motion.rate(link), Meaning::Number),
                    (None, _) => Output::scalar(graph.zero(), Meaning::Number),
                };
                Field { name: by(model, drives), doc: part_doc(model, drives, &shown, what.is_some()), value }
            });
            let doc = format!("Derivatives of {shown} by the drives.");
            Some(Field { name: model.result_name(*wanted)?, doc, value: Output::Record(parts.collect()) })
        });
        Output::Record(fields.collect())
    }
}

/// `by_theta`, `by_theta_theta`
fn by(model: &Model, drives: &[DriveId]) -> String {
    drives.iter().fold("by".to_owned(), |name, drive| format!("{name}_{}", model.drive(*drive).name))
}

fn part_doc(model: &Model, drives: &[DriveId], what: &str, is_place: bool) -> String {
    let length = Kind::Length.unit(&model.units);
    let of = if is_place { &length } else { "rad" };
    let by = |drive: &DriveId| if model.drive(*drive).turns { "rad" } else { length.as_str() };
    let unit = match drives.iter().map(by).collect::<Vec<_>>().as_slice() {
        [one, other] if one == other => format!("{of}/{one}²"),
        units => format!("{of}/({})", units.join("·")).replace("(rad)", "rad").replace(&format!("({length})"), &length),
    };
    let names: Vec<String> = drives.iter().map(|drive| format!("`{}`", model.drive(*drive).name)).collect();
    let axes = if is_place { ", ground axes" } else { "" };
    format!("Of {what} by {}, {unit}{axes}.", names.join(" and "))
}

/// The fields of a result that is a number or a vector.
pub(crate) fn names(model: &Model) -> Vec<String> {
    let drives = || (0..model.drives.len()).map(DriveId::new);
    let pairs = drives().flat_map(|one| drives().skip(one.index()).map(move |other| [one, other]));
    drives().map(|drive| by(model, &[drive])).chain(pairs.map(|pair| by(model, &pair))).collect()
}
