//! Turns of gears: a file counts the direction between the centres so that its guess fits, a declaration from the arm's own frame.

use std::f64::consts::PI;

use crate::file::{End, File, Joint, JointKind, Place};
use crate::number::{Number, Raw};

/// By how many turns of both wheels together the declaration's phase is ahead of the file's: `2π (ra ± rb)` each.
pub(crate) fn turns(file: &File, gear: &Joint) -> Option<i32> {
    let [ra, rb] = [value(file, gear.ra.as_ref()?)?, value(file, gear.rb.as_ref()?)?];
    let rb = if gear.internal { -rb } else { rb };
    let phase = gear.phase.as_ref().map_or(Some(0.0), |phase| value(file, phase))?;
    let (arm, [from, to]) = arm(file, gear)?;
    let psi = angle(file, arm)? + (to[1] - from[1]).atan2(to[0] - from[0]);
    let [a, b] = [angle(file, &gear.a.0)?, angle(file, &gear.b.0)?];
    let open = ra * (a - psi) + rb * (b - psi) - phase;
    #[allow(clippy::cast_possible_truncation, reason = "a few turns")]
    Some((open / (2.0 * PI * (ra + rb))).round() as i32)
}

/// The link to which pins hold both centres, and where on it.
fn arm<'f>(file: &'f File, gear: &Joint) -> Option<(&'f str, [[f64; 2]; 2])> {
    let mut links = std::iter::once("ground").chain(file.links.iter().map(|(name, _)| name));
    links.find_map(|link| Some((link, [pinned(file, link, &gear.a)?, pinned(file, link, &gear.b)?])))
}

/// Where on a link a pin holds a point of another one.
fn pinned(file: &File, link: &str, centre: &End) -> Option<[f64; 2]> {
    let centre_place = place(file, centre)?;
    let is_centre = |end: &End| end.0 == centre.0 && place(file, end) == Some(centre_place);
    file.joints.iter().filter(|joint| joint.kind == JointKind::Revolute).find_map(|joint| {
        let own = match (is_centre(&joint.a), is_centre(&joint.b)) {
            (true, _) => &joint.b,
            (_, true) => &joint.a,
            _ => return None,
        };
        if own.0 == link { place(file, own) } else { None }
    })
}

/// A point in the frame of its link.
fn place(file: &File, End(link, at): &End) -> Option<[f64; 2]> {
    let body = if link == "ground" { &file.ground } else { file.links.get(link)? };
    let [x, y] = match at {
        Place::Named(name) => body.points.get(name)?,
        Place::At(at) => at,
    };
    Some([value(file, x)?, value(file, y)?])
}

/// The angle of a link at the guess, with its turns.
fn angle(file: &File, link: &str) -> Option<f64> {
    if link == "ground" {
        return Some(0.0);
    }
    let [_, _, angle] = file.guess.get(link)?;
    value(file, angle)
}

fn value(file: &File, raw: &Raw) -> Option<f64> {
    Number::new(raw, file.number_mode).ok().map(|number| number.value)
}
