//! Turns of gears: a file counts the direction between the centres so that its guess fits, a declaration from the arm's own frame.

use std::f64::consts::PI;

use crate::file::{End, File, Joint, JointKind};

/// By how many turns of both wheels together the declaration's phase is ahead of the file's: `2π (ra ± rb)` each.
pub(crate) fn turns(file: &File, gear: &Joint) -> Option<i32> {
    let [ra, rb] = [file.value(gear.ra.as_ref()?).ok()?, file.value(gear.rb.as_ref()?).ok()?];
    let rb = if gear.internal { -rb } else { rb };
    let phase = gear.phase.as_ref().map_or(Ok(0.0), |phase| file.value(phase)).ok()?;
    let (arm, [from, to]) = arm(file, gear)?;
    let angle = |link: &str| file.guessed(link).map(|[_, _, angle]| angle);
    let psi = angle(arm)? + (to[1] - from[1]).atan2(to[0] - from[0]);
    let [a, b] = [angle(&gear.a.0)?, angle(&gear.b.0)?];
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
    let centre_place = file.place(centre)?;
    let is_centre = |end: &End| end.0 == centre.0 && file.place(end) == Some(centre_place);
    file.joints.iter().filter(|joint| joint.kind == JointKind::Revolute).find_map(|joint| {
        let own = match (is_centre(&joint.a), is_centre(&joint.b)) {
            (true, _) => &joint.b,
            (_, true) => &joint.a,
            _ => return None,
        };
        if own.0 == link { file.place(own) } else { None }
    })
}
