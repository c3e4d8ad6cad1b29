//! The same slides and slots, declared by other points of their lines.

use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;

use super::numbers::Extended;
use super::{Arguments, Number, scene};

/// The names of the slides and slots of a declaration, slides first.
pub fn lines(text: &str) -> Vec<&str> {
    let named = |kind| text.split(kind).skip(1).filter_map(|rest| Some(rest.split_once(": ")?.0));
    named("prismatic ").chain(named("slot ")).collect()
}

/// Whether a drive gives the travel of a line.
pub fn is_driven(text: &str, name: &str) -> bool {
    [";", ".travel;"].iter().any(|what| text.contains(&[": ", name, what].concat()))
}

/// The declaration with a point of a slide or slot so far along the line from where it is: that of the link in whose frame the line is given,
/// or that of the runner; a pin in a slot is where it is, and the travel of a driven line is an argument: they stay. Lines by two points or by a
/// vector have no angle to go by.
pub fn with_point_moved(text: &str, name: &str, distance: f64, runner: bool) -> Option<String> {
    let of_kind = |kind: &str| text.split_once(&[kind, name, ": "].concat());
    let slide = of_kind("prismatic ").or_else(|| of_kind("slot ").filter(|_| !runner))?;
    let ends_and_line = slide.1.split_once(';')?.0;
    let (ends, line) = ends_and_line.split_once(" along ")?;
    let (from, to) = ends.split_once(" -> ")?;
    let (line, turn) = line.split_once(", angle ").unwrap_or((line, "0deg"));
    let (angle, carrier) = line.split_once(" of ").unwrap_or((line, "ground"));
    if angle.contains("->") || angle.contains(',') {
        return None;
    }
    let is_of_carrier = |end: &&str| end.split('.').next() == Some(carrier);
    let end = [from, to].into_iter().find(|end| is_of_carrier(end) != runner).filter(|_| !is_driven(text, name))?;
    let angle = match (runner, end == to) {
        (false, _) => angle.to_owned(),
        (true, true) => format!("({angle} - ({turn}))"),
        (true, false) => format!("({angle} + {turn})"),
    };
    let (link, point) = end.split_once('.').unwrap_or((end, name));
    let opening = if link == "ground" { "ground { ".to_owned() } else { ["link ", link, " { "].concat() };
    let (before, after) = text.split_once(&opening)?;
    let (points, behind) = after.split_once(" }")?;
    let [x, y] = declared_place(points, point)?;
    let datum = format!("Far_{name}_{link}");
    let moved = format!(", {datum}: ({x} + {distance:?}m*cos({angle}), {y} + {distance:?}m*sin({angle})) }}");
    let text = [before, &opening, points, &moved, behind].concat();
    let by_datum = ends_and_line.replacen(end, &[link, ".", &datum].concat(), 1);
    Some(text.replacen(ends_and_line, &by_datum, 1))
}

/// The declaration with the points of the ground, and where links start, so far from where they are.
pub fn with_ground_moved(text: &str, [x, y]: [f64; 2]) -> String {
    let moved = |places: &str| {
        let (first, rest) = places.split_once(": (").unwrap_or((places, ""));
        let places = rest.split(": (").filter_map(|place| {
            let (coordinates, rest) = place.split_once(')')?;
            let (own_x, own_y) = coordinates.split_once(", ")?;
            Some(format!(": ({own_x} + {x:?}m, {own_y} + {y:?}m){rest}"))
        });
        [first.to_owned(), places.collect()].concat()
    };
    let items = text.split(';').map(|item| match item.split_once("ground { ") {
        Some((before, after)) => {
            let (points, behind) = after.split_once(" }").unwrap_or((after, ""));
            [before, "ground { ", &moved(points), " }", behind].concat()
        }
        None if item.trim_start().starts_with("start ") => moved(item),
        None => item.to_owned(),
    });
    items.collect::<Vec<_>>().join(";")
}

/// The coordinates of a point among those that a link declares, as they are written.
fn declared_place(points: &str, point: &str) -> Option<[String; 2]> {
    let zero = || "0m".to_owned();
    if points.starts_with(&[point, " -> "].concat()) {
        return Some([zero(), zero()]);
    }
    let place = points.split_once(&[point, ": "].concat())?.1;
    if points.contains(&["-> ", point, ": "].concat()) {
        return Some([place.split(',').next()?.trim().to_owned(), zero()]);
    }
    if let Some(rest) = place.strip_prefix('(') {
        let (x, y) = rest.split_once(')')?.0.split_once(", ")?;
        return Some([x.to_owned(), y.to_owned()]);
    }
    let (size, angle) = place.split(',').next()?.split_once(" @ ")?;
    Some([format!("{size}*cos({angle})"), format!("{size}*sin({angle})")])
}

/// Whether a result is a part of a force, which does not depend on the points by which lines are declared; couples do.
pub fn is_force(path: &str) -> bool {
    [".x", ".y", ".normal"].into_iter().any(|part| path.ends_with(part))
}

/// How much further off the results of one linkage are that do not depend on the points by which lines are declared than those of another
/// one, which says the same in other words: as parts of the latter's errors there and at some places nearby, where it may be less lucky, and
/// an epsilon of the largest. Nothing where that has no results.
pub fn further_off<T: Number>(
    [one, other]: [&Linkage; 2],
    (name, is_meant): (&str, impl Fn(&str) -> bool),
    arguments: &Arguments,
    nearby: impl Iterator<Item = Arguments>,
    epsilon: f64,
) -> Option<f64> {
    let off = |linkage: &Linkage, arguments: &Arguments| {
        let exact = scene::<Extended>(other, name, arguments).ok()?;
        let meant = || exact.iter().filter(|(path, _)| is_meant(path));
        let largest = meant().fold(0.0_f64, |largest, (_, value)| largest.max(value.to_f64().abs()));
        let found = scene::<T>(linkage, name, arguments).ok()?;
        let off = meant().map(|(path, value)| Extended::exactly(found[path].to_f64()).sub(value).to_f64().abs());
        Some(off.fold(0.0, f64::max) / largest.max(f64::MIN_POSITIVE))
    };
    let own = off(other, arguments)?.max(epsilon);
    let own = nearby.filter_map(|arguments| off(other, &arguments)).fold(own, f64::max);
    Some(off(one, arguments).map_or(f64::INFINITY, |off| off / own))
}
