//! Draws panels of run time against error as SVG: logarithmic axes, a numbered dot for each method, the front as a line, and a list of
//! the numbers.

use std::fmt::Write;

/// What a method is, and with it its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Family {
    /// Emitted by `linkage!`.
    Generated,
    /// Closed forms in the hands of an expert.
    Hand,
    /// Angles, as the textbook.
    Angles,
    /// Iteration.
    Iteration,
    /// All equations at once.
    Elimination,
}

impl Family {
    fn colour(self) -> &'static str {
        match self {
            Self::Generated => "#0b5cad",
            Self::Hand => "#c4570a",
            Self::Angles => "#8e2f8a",
            Self::Iteration => "#2f7d32",
            Self::Elimination => "#6b6b6b",
        }
    }
}

/// The front's colour.
const FRONT: &str = "#e0a800";

/// A method in a panel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    pub(crate) name: &'static str,
    pub(crate) family: Family,
    pub(crate) nanoseconds: f64,
    pub(crate) error: f64,
    pub(crate) on_front: bool,
}

/// A panel: what is asked for, and where.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub(crate) title: [String; 2],
    pub(crate) marks: Vec<Mark>,
}

/// Places and sizes, in pixels.
const WIDTH: f64 = 430.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 96.0;
const GAP: (f64, f64) = (90.0, 118.0);
/// Half a number's size, and how far it is from its dot.
const NUMBER: (f64, f64) = (8.0, 7.0);

/// The axes: powers of ten at their ends.
#[derive(Clone, Copy, Debug)]
struct Axes {
    nanoseconds: (i32, i32),
    error: (i32, i32),
}

impl Axes {
    /// Whole decades that hold all marks.
    fn of(panels: &[Panel]) -> Self {
        let marks = || panels.iter().flat_map(|panel| &panel.marks);
        let decades = |values: &dyn Fn(&Mark) -> f64| {
            let exponents = || marks().map(|mark| values(mark).log10());
            #[allow(clippy::cast_possible_truncation, reason = "small exponents")]
            let (low, high) =
                (exponents().fold(f64::MAX, f64::min) as i32, exponents().fold(f64::MIN, f64::max) as i32);
            (low, high)
        };
        let (low, high) = decades(&|mark| mark.nanoseconds);
        // Errors have negative exponents, which are cut off upwards.
        let (least, most) = decades(&|mark| mark.error);
        Self { nanoseconds: (low, high + 1), error: (least - 1, most) }
    }

    fn place(self, mark: &Mark) -> (f64, f64) {
        let part = |value: f64, (low, high): (i32, i32)| (value.log10() - f64::from(low)) / f64::from(high - low);
        (WIDTH * part(mark.nanoseconds, self.nanoseconds), HEIGHT * (1.0 - part(mark.error, self.error)))
    }
}

/// All panels, two in a row, and the list.
pub(crate) fn drawn(panels: &[Panel], machine: &str) -> String {
    let mut names: Vec<(&str, Family)> = Vec::new();
    for mark in panels.iter().flat_map(|panel| &panel.marks) {
        if !names.iter().any(|(name, _)| *name == mark.name) {
            names.push((mark.name, mark.family));
        }
    }
    names.sort_by_key(|(_, family)| *family);
    let axes = Axes::of(panels);
    let rows = panels.len().div_ceil(2);
    #[allow(clippy::cast_precision_loss, reason = "few")]
    let (lines, rows) = (names.len().div_ceil(3) as f64, rows as f64);
    let list = TOP + rows * HEIGHT + (rows - 1.0) * GAP.1 + 76.0;
    let (width, height) = (LEFT + 2.0 * WIDTH + GAP.0 + 30.0, list + 22.0 * lines + 24.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"12\" fill=\"#222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    text(
        &mut svg,
        (LEFT, 26.0),
        "font-size=\"16\" font-weight=\"bold\"",
        "Run time against error: the four-bar of METU Example 6.3",
    );
    text(&mut svg, (LEFT, 46.0), "fill=\"#555\"", &format!("{machine}; the lower left is best"));
    for (index, panel) in panels.iter().enumerate() {
        #[allow(clippy::cast_precision_loss, reason = "few")]
        let (column, row) = ((index / 2) as f64, (index % 2) as f64);
        let _ = writeln!(
            svg,
            "<g transform=\"translate({} {})\">",
            LEFT + column * (WIDTH + GAP.0),
            TOP + row * (HEIGHT + GAP.1)
        );
        frame(&mut svg, panel, axes);
        marks(&mut svg, panel, axes, &names);
        svg.push_str("</g>\n");
    }
    for (index, (name, family)) in names.iter().enumerate() {
        #[allow(clippy::cast_precision_loss, reason = "few")]
        let (column, line) = ((index % 3) as f64, (index / 3) as f64);
        let (x, y) = (LEFT + column * 310.0, list + 22.0 * line);
        let colour = family.colour();
        let _ = writeln!(svg, "<circle cx=\"{x}\" cy=\"{}\" r=\"4\" fill=\"{colour}\"/>", y - 4.0);
        text(&mut svg, (x + 12.0, y), &format!("fill=\"{colour}\""), &format!("{}  {name}", index + 1));
    }
    let y = list + 22.0 * lines;
    let _ = writeln!(
        svg,
        "<path d=\"M{} {2}H{}\" stroke=\"{FRONT}\" stroke-width=\"2\"/>",
        LEFT - 6.0,
        LEFT + 6.0,
        y - 4.0
    );
    text(
        &mut svg,
        (LEFT + 12.0, y),
        "",
        "the front: no other method for any linkage is both faster and more accurate than those on it",
    );
    svg.push_str("</svg>\n");
    svg
}

fn text(svg: &mut String, (x, y): (f64, f64), style: &str, text: &str) {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" {style}>{text}</text>");
}

/// The titles, the grid and the axes.
fn frame(svg: &mut String, panel: &Panel, axes: Axes) {
    let [what, where_] = &panel.title;
    text(svg, (0.0, -24.0), "font-size=\"13\" font-weight=\"bold\"", what);
    text(svg, (0.0, -8.0), "", where_);
    let mut line = |x1: f64, y1: f64, x2: f64, y2: f64, colour: &str| {
        let _ = writeln!(svg, "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"{colour}\"/>");
    };
    let (low, high) = axes.nanoseconds;
    let x = |value: f64| WIDTH * (value.log10() - f64::from(low)) / f64::from(high - low);
    for decade in low..high {
        for digit in 1..10 {
            let at = x(f64::from(digit) * 10_f64.powi(decade));
            line(at, 0.0, at, HEIGHT, if digit == 1 { "#ccc" } else { "#eee" });
        }
    }
    let (least, most) = axes.error;
    let y = |exponent: i32| HEIGHT * f64::from(most - exponent) / f64::from(most - least);
    for exponent in least..=most {
        line(0.0, y(exponent), WIDTH, y(exponent), "#e2e2e2");
    }
    let _ = writeln!(svg, "<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" stroke=\"#555\"/>");
    for decade in low..=high {
        let value = 10_f64.powi(decade);
        text(svg, (x(value), HEIGHT + 16.0), "text-anchor=\"middle\"", &format!("{value}"));
    }
    for exponent in (least..=most).filter(|exponent| exponent % 2 == 0) {
        let power = format!("10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>", exponent.to_string().replace('-', "−"));
        let _ = writeln!(svg, "<text x=\"-7\" y=\"{:.1}\" text-anchor=\"end\">{power}</text>", y(exponent) + 5.0);
    }
    text(svg, (WIDTH / 2.0, HEIGHT + 34.0), "text-anchor=\"middle\"", "ns for each call");
    let turned = format!("text-anchor=\"middle\" transform=\"rotate(-90 -50 {0})\"", HEIGHT / 2.0);
    text(svg, (-50.0, HEIGHT / 2.0), &turned, "relative error, root mean square");
}

/// The front, the dots, and a number beside each where there is room.
fn marks(svg: &mut String, panel: &Panel, axes: Axes, names: &[(&str, Family)]) {
    let mut front: Vec<(f64, f64)> =
        panel.marks.iter().filter(|mark| mark.on_front).map(|mark| axes.place(mark)).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    // From a method to the next that is more accurate: what is no better than the front is to the right of it and above.
    if let Some((first, rest)) = front.split_first() {
        let mut path = format!("M{:.1} 0V{:.1}", first.0, first.1);
        for (x, y) in rest {
            let _ = write!(path, "H{x:.1}V{y:.1}");
        }
        let _ = writeln!(svg, "<path d=\"{path}H{WIDTH}\" fill=\"none\" stroke=\"{FRONT}\" stroke-width=\"2\"/>");
    }
    let dots: Vec<(f64, f64)> = panel.marks.iter().map(|mark| axes.place(mark)).collect();
    let mut taken = dots.clone();
    for (mark, &(x, y)) in panel.marks.iter().zip(&dots) {
        let colour = mark.family.colour();
        let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>");
        let number = names.iter().position(|(name, _)| *name == mark.name).map_or(0, |index| index + 1);
        let (at_x, at_y) = room((x, y), &taken);
        taken.push((at_x, at_y));
        if (at_x - x).hypot(at_y - y) > 2.5 * NUMBER.0 {
            let _ = writeln!(
                svg,
                "<path d=\"M{x:.1} {y:.1}L{at_x:.1} {at_y:.1}\" stroke=\"{colour}\" stroke-width=\"0.7\"/>"
            );
            let _ = writeln!(svg, "<circle cx=\"{at_x:.1}\" cy=\"{at_y:.1}\" r=\"{}\" fill=\"#fff\"/>", NUMBER.0);
        }
        let style = format!(
            "fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\" text-anchor=\"middle\" \
             font-size=\"11\" font-weight=\"bold\""
        );
        text(svg, (at_x, at_y + 4.0), &style, &number.to_string());
    }
}

/// The nearest place for a number that is within the panel and hides nothing.
fn room((x, y): (f64, f64), taken: &[(f64, f64)]) -> (f64, f64) {
    let (half, gap) = NUMBER;
    for ring in 0..8 {
        let radius = half + gap + 7.0 * f64::from(ring);
        for direction in 0..16 {
            let (sin, cos) = (std::f64::consts::PI * (0.125 * f64::from(direction) - 0.25)).sin_cos();
            let (at_x, at_y) = (x + radius * cos, y + radius * sin);
            let inside = (half..WIDTH - half).contains(&at_x) && (half..HEIGHT - half).contains(&at_y);
            if inside && taken.iter().all(|other| (other.0 - at_x).hypot(other.1 - at_y) > half + 5.5) {
                return (at_x, at_y);
            }
        }
    }
    (x, y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(nanoseconds: f64, error: f64) -> Mark {
        Mark { name: "a < b", family: Family::Hand, nanoseconds, error, on_front: true }
    }

    #[test]
    fn axes_are_whole_decades_that_hold_all() {
        let panel = Panel { title: [String::new(), String::new()], marks: vec![mark(20.0, 3e-16), mark(600.0, 2e-4)] };
        let axes = Axes::of(&[panel]);
        assert_eq!((axes.nanoseconds, axes.error), ((1, 3), (-16, -3)));
    }

    #[test]
    fn numbers_hide_nothing() {
        let mut taken = vec![(100.0, 100.0); 10];
        for _ in 0..10 {
            let place = room((100.0, 100.0), &taken);
            assert!(taken.iter().all(|other| (other.0 - place.0).hypot(other.1 - place.1) > NUMBER.0));
            taken.push(place);
        }
    }

    #[test]
    fn names_are_escaped() {
        let panel = Panel { title: [String::new(), String::new()], marks: vec![mark(20.0, 3e-16)] };
        assert!(drawn(&[panel], "").contains("a &lt; b"));
    }
}
