//! The stress suite: kinds of groups in families of poses that break weak implementations, held to the bars, in both scalars; with
//! `error_bound`, which no error may exceed, and which is within a hundred times the error as a median of each family and scalar. In plain
//! and in fused arithmetic. `.ci/run` has a reduced size, of some kinds among the quick tests and of the others after them; all of it is
//!
//! ```text
//! just stress
//! ```
//!
//! with 10⁶ random poses of four-bars and slider-cranks, and 10⁴ of each other kind and of any in fused arithmetic; with 100 members of a
//! kind in each family, 50 in fused arithmetic; of 6, 8, and of NaN and infinities with 20 and 10, at the ends of motions with the same
//! 100. Bounds are looked at in every fourth member, and members are drawn until 30 poses have some. The reduced size has two members in each
//! family, of blocks and cascades one, and no random poses beside them; bounds are looked at in every member, of blocks until 8 poses have
//! some, and a median of less than 30 poses is not judged. Of regular poses one in a hundred may be refused in doubles,
//! one in five in single precision, down to pivots at which rounding leaves digits: 10⁻⁷ and 10⁻²·⁵; of blocks with a loop that folds one
//! in twenty, as an iteration may come past a change point in many digits and not in few. Of the bounds there one in a hundred may say that
//! nothing is known; in 4 in single precision one in twenty; in 1, 2 and 3, whose pivots are about what they are said to be, one in eight,
//! in single precision one in four, and so many in 9, where legs may be 10⁻⁴ from meeting in a point. With links shorter by 10ⁿ than others
//! a pose is told as beside a pivot of 10⁻ⁿᐟ².
//! It prints, for each kind and family, the worst measure as a part of its bar, the median of bound over error, and how many bounds say
//! nothing. Members are drawn until as many as are asked for have poses in either scalar: a kind without poses in a family that is its own by
//! the table fails. The bars are `BARS` of `support/families.rs`, the measures explained in `support/measures.rs`.
//!
//! | family | where | for which kinds |
//! |---|---|---|
//! | 1 pivots of 10⁻¹ to 10⁻⁷ | here: distances from where the motion ends or the determinant of all equations changes its sign; slides inclined by 10⁻¹ to 10⁻⁶ | all that have such poses: not planets |
//! | 2 the same, loads compatible | here: without what the virtual displacement of the singular pose sees | as 1 |
//! | 3 folds | here: dimensions with which pivots meet or links lie on each other, 1 to 10⁻⁷ from there; blocks and cascades with a loop in them that folds; digits of four-bars in `families.rs` | those that fold: pins and slides in closed loops of equal lengths |
//! | 4 lengths that differ by 10² to 10⁸ | here, each set of lengths small; of cascades and blocks some joints next to others; of three-pin dyads in `families.rs` too; triads under 9 | all; blocks and cascades in f32 to 10⁴ |
//! | 5, 14 along the axes, collinear, in line | here: directions by quarter turns, drives too; joints of blocks and cascades on a lattice; `families.rs` | all |
//! | 6 far from the origin, the point of a slide or a slot far along its line: the same bits; for moved points of lines errors of efforts, and in cascades of all, of the same size; all rules in `rules.rs` | here | all |
//! | 7 loads 10⁸ apart, a single load | here | all |
//! | 8 units of length and of force that differ by powers of two: the same bits | here | all |
//! | 9 triads nearly concurrent, nearly parallel, third pin on the first line, tiny or huge ternary | here | triads |
//! | 10 loads that cancel to 10⁻¹⁰ | here: of the effort | all |
//! | 11 where the motion ends, one ulp and one percent beyond it; NaN and infinities | here; exact cases in `families.rs` | all |
//! | 12 cascades of six dyads of all kinds, any of them near its dead centre | here, as a kind | |
//! | 13 the same bits everywhere | `tests/no-std/proofs/digests.txt` of the repository, `tests/math/bits.rs` of the run-time crate | all examples |
//! | 15 ground lines at any angle | here: of every linkage but those of 5 and the blocks of 3; folds in `families.rs` | all |

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

use crate::support::bounds::{LOOSEST, median, ratios, with_bounds_of};
use crate::support::families::{
    BARS, boom, four_bar, length, loads, oscillating_block, planet, scotch_yoke, shaper, single, slider_crank,
    slotted_crank, slotted_yoke, tangent_mechanism, welded,
};
use crate::support::far_points::{self, is_force};
use crate::support::general::{Coordinates, equations_at};
use crate::support::linkages::{
    CLOSEST_IN_SINGLE, Class, Layout, Place, Random, direction, in_single_precision, intersection, minus, plus,
    sample_with_forces, size,
};
use crate::support::measures::{Measures, from_kept, is_moment, measure};
use crate::support::numbers::{Double, Extended, Single};
use crate::support::{Arguments, Number, compile_if_it_closes, pose, scene};
use linkage_codegen::Linkage;
use linkage_codegen::graph::Failure;
use linkage_codegen::graph::real::Real;
use linkage_codegen::program::Fault;
use nalgebra::{DMatrix, DVector};

/// A number type that linkages compute in.
trait Scalar: Number {
    const NAME: &'static str;
    const EPSILON: f64;
    /// The largest number.
    const MAX: f64;
    /// A power of two by which units may differ: constants have up to sixth powers of such lengths, which are numbers of the scalar.
    const UNITS: i32;
    fn next_up(&self) -> Self;
    fn next_down(&self) -> Self;
}

impl Scalar for Double {
    const NAME: &'static str = "f64";
    const EPSILON: f64 = f64::EPSILON;
    const MAX: f64 = f64::MAX;
    const UNITS: i32 = 40;

    fn next_up(&self) -> Self {
        Self(self.0.next_up())
    }
    fn next_down(&self) -> Self {
        Self(self.0.next_down())
    }
}

impl Scalar for Single {
    const NAME: &'static str = "f32";
    const EPSILON: f64 = f32::EPSILON as f64;
    const MAX: f64 = f32::MAX as f64;
    const UNITS: i32 = 16;

    fn next_up(&self) -> Self {
        Self(self.0.next_up())
    }
    fn next_down(&self) -> Self {
        Self(self.0.next_down())
    }
}

/// How the linkages of a kind are made.
enum Drawn {
    /// By dimensions, the first of them lengths, and an angle in degrees if `angle` is set.
    ByDimensions { text: fn(&[f64], &mut Random) -> String, dimensions: &'static [(f64, f64)], angle: bool },
    /// By places.
    ByPlaces(Class),
}

/// A kind of linkage, named by its groups.
struct Kind {
    name: &'static str,
    drawn: Drawn,
    /// The drive's range, about where the linkage starts if it is iterated.
    range: (f64, f64),
    /// Dimensions with which it folds.
    folds: &'static [&'static [f64]],
    /// Dimensions with which links come to lie along one line, and the axes.
    aligned: &'static [&'static [f64]],
}

const TURN: (f64, f64) = (-7.0, 7.0);

/// Ground link, crank, coupler and rocker of parallelograms, kites and others whose links come to lie along one line.
const FOUR_BAR_FOLDS: [&[f64]; 7] = [
    &[1.0, 0.5, 1.0, 0.5],
    &[0.5, 1.0, 0.5, 1.0],
    &[1.0, 1.0, 1.0, 1.0],
    &[1.0, 1.0, 0.5, 0.5],
    &[0.5, 1.0, 1.0, 0.5],
    &[1.75, 1.0, 1.25, 1.5],
    &[1.5, 0.5, 1.25, 0.75],
];

const KINDS: [Kind; 15] = [
    Kind {
        name: "RRR: four-bars",
        drawn: Drawn::ByDimensions {
            text: |d, random| four_bar([d[0], d[1], d[2], d[3]], random),
            dimensions: &[(0.1, 2.0); 4],
            angle: false,
        },
        range: TURN,
        folds: &FOUR_BAR_FOLDS,
        aligned: &[&[2.0, 0.5, 1.75, 1.0], &[0.5, 1.0, 1.25, 1.0], &[1.0, 1.0, 1.0, 1.0], &[1.25, 0.5, 0.75, 1.0]],
    },
    Kind {
        name: "RRR with welds: four-bars",
        drawn: Drawn::ByDimensions {
            text: |d, random| welded([d[0], d[1], d[2]], random),
            dimensions: &[(0.1, 2.0); 3],
            angle: false,
        },
        range: TURN,
        folds: &[],
        aligned: &[&[1.0, 0.5, 1.0], &[0.5, 1.0, 1.0]],
    },
    Kind {
        name: "RRP: slider-cranks",
        drawn: Drawn::ByDimensions {
            text: |d, random| slider_crank([d[0], d[1], d[2]], random),
            dimensions: &[(0.1, 1.0), (0.3, 3.0), (-0.5, 0.5)],
            angle: false,
        },
        range: TURN,
        folds: &[&[1.0, 1.0, 0.0], &[0.75, 1.0, 0.25]],
        aligned: &[&[0.5, 1.5, 0.0], &[0.5, 1.0, 0.5], &[1.0, 1.25, 0.75]],
    },
    Kind {
        name: "RPR: oscillating blocks",
        drawn: Drawn::ByDimensions {
            text: |d, random| oscillating_block([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)],
            angle: false,
        },
        range: TURN,
        folds: &[&[1.0, 1.0, 0.0], &[1.0, 0.75, 0.25]],
        aligned: &[&[1.5, 0.5, 0.0], &[1.0, 0.5, 0.25], &[1.0, 1.0, 0.5]],
    },
    Kind {
        name: "RPR with its slide driven: booms on cylinders",
        drawn: Drawn::ByDimensions {
            text: |d, random| boom([d[0], d[1], d[2]], random),
            dimensions: &[(0.5, 2.0), (0.5, 2.0), (-0.2, 0.2)],
            angle: false,
        },
        range: (0.5, 3.0),
        folds: &[&[1.0, 1.0, 0.0]],
        aligned: &[&[1.5, 2.0, 0.0], &[1.0, 1.0, 0.0]],
    },
    Kind {
        name: "PRP: tangent mechanisms",
        drawn: Drawn::ByDimensions {
            text: |d, random| tangent_mechanism([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (-0.5, 0.5), (60.0, 120.0)],
            angle: true,
        },
        range: (-1.0, 1.0),
        folds: &[],
        aligned: &[&[1.0, 0.0, 90.0], &[1.0, 0.5, 90.0]],
    },
    Kind {
        name: "RPP: Scotch yokes",
        drawn: Drawn::ByDimensions {
            text: |d, random| scotch_yoke([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (-0.5, 0.5), (45.0, 135.0)],
            angle: true,
        },
        range: TURN,
        folds: &[],
        aligned: &[&[1.0, 0.0, 90.0], &[1.0, 0.5, 90.0]],
    },
    Kind {
        name: "slot and pin: levers with slots",
        drawn: Drawn::ByDimensions {
            text: |d, random| shaper([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)],
            angle: false,
        },
        range: TURN,
        folds: &[&[1.0, 1.0, 0.0], &[1.0, 0.75, 0.25]],
        aligned: &[&[1.5, 0.5, 0.0], &[1.0, 0.5, 0.25]],
    },
    Kind {
        name: "slot and pin: links in a crank's slot",
        drawn: Drawn::ByDimensions {
            text: |d, random| slotted_crank([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (0.5, 2.0), (-0.5, 0.5)],
            angle: false,
        },
        range: TURN,
        folds: &[&[1.0, 1.0, 0.0]],
        aligned: &[&[1.0, 1.5, 0.0], &[1.0, 2.0, 0.5]],
    },
    Kind {
        name: "slot and slide: yokes",
        drawn: Drawn::ByDimensions {
            text: |d, random| slotted_yoke([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (-0.5, 0.5), (45.0, 135.0)],
            angle: true,
        },
        range: TURN,
        folds: &[],
        aligned: &[&[1.0, 0.0, 90.0], &[1.0, 0.5, 90.0]],
    },
    Kind {
        name: "gear and pin: planets",
        drawn: Drawn::ByDimensions {
            text: |d, random| planet([d[0], d[1], d[2]], random),
            dimensions: &[(0.3, 2.0), (0.1, 2.0), (-0.5, 0.5)],
            angle: false,
        },
        range: TURN,
        folds: &[],
        aligned: &[&[1.0, 0.5, 0.0]],
    },
    Kind {
        name: "six dyads: cascades",
        drawn: Drawn::ByPlaces(Class::Cascade),
        range: (-1.0, 1.0),
        folds: &[],
        aligned: &[],
    },
    Kind { name: "Newton: triads", drawn: Drawn::ByPlaces(Class::Three), range: (-0.3, 0.3), folds: &[], aligned: &[] },
    Kind {
        name: "Newton: triads, some with a slider",
        drawn: Drawn::ByPlaces(Class::ThreeWithSlider),
        range: (-0.3, 0.3),
        folds: &[],
        aligned: &[],
    },
    Kind {
        name: "Newton: class IV",
        drawn: Drawn::ByPlaces(Class::Four),
        range: (-0.3, 0.3),
        folds: &[],
        aligned: &[],
    },
];

/// A linkage of a kind.
struct Member {
    text: String,
    longest: f64,
    range: (f64, f64),
    loads: Vec<[f64; 2]>,
}

impl Kind {
    fn slides(&self) -> bool {
        self.name.contains("booms")
    }

    fn drawn(&self, random: &mut Random) -> Member {
        match &self.drawn {
            Drawn::ByDimensions { dimensions, .. } => {
                let sizes: Vec<f64> = dimensions.iter().map(|(low, high)| length(random, *low, *high)).collect();
                self.with(&sizes, random).expect("dimensions")
            }
            Drawn::ByPlaces(class) => self.laid(*class, Layout::Anywhere, random),
        }
    }

    fn laid(&self, class: Class, layout: Layout, random: &mut Random) -> Member {
        let sample = sample_with_forces(random.next(), class, layout);
        let begin = sample.arguments.drives[0];
        let range = (begin + self.range.0, begin + self.range.1);
        Member { text: sample.text, longest: sample.longest, range, loads: sample.arguments.loads }
    }

    fn has_dead_centres(&self) -> bool {
        !self.name.contains("planets")
    }

    /// Whether the drive comes to such poses; those of yokes are slides in line.
    fn has_ends(&self) -> bool {
        self.has_dead_centres() && !self.name.contains("yokes")
    }

    fn is_by_places(&self) -> bool {
        matches!(self.drawn, Drawn::ByPlaces(..))
    }

    /// Whether every member has a slide or a slot that is not driven and whose line is given by a point and an angle; of blocks by places and
    /// cascades most have.
    fn has_lines(&self) -> bool {
        ["slider", "blocks", "tangent", "yokes", "slot", "cascades"].into_iter().any(|word| self.name.contains(word))
    }

    /// Whether it is a single group that is placed by iteration.
    fn is_block(&self) -> bool {
        self.is_by_places() && !self.is_cascade()
    }

    fn is_cascade(&self) -> bool {
        matches!(self.drawn, Drawn::ByPlaces(Class::Cascade))
    }

    /// A turn of the drive, or any length of a cylinder.
    fn widely(&self, member: &Member) -> (f64, f64) {
        let middle = member.range.0.midpoint(member.range.1);
        if self.slides() { (0.01, 5.0) } else { (middle - PI, middle + PI) }
    }

    /// One of given dimensions.
    fn with(&self, sizes: &[f64], random: &mut Random) -> Option<Member> {
        let Drawn::ByDimensions { text, angle, .. } = &self.drawn else { return None };
        let lengths = &sizes[..sizes.len() - usize::from(*angle)];
        let longest = lengths.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        Some(Member { text: text(sizes, random), longest, range: self.range, loads: loads(random) })
    }
}

/// Poses of a linkage, its declaration without its scalar.
struct Poses {
    text: String,
    longest: f64,
    each: Vec<Pose>,
    /// Whether single precision holds its dimensions.
    in_single: bool,
}

struct Pose {
    drive: f64,
    loads: Vec<[f64; 2]>,
    /// About how small a pivot is, as a part of what it is elsewhere.
    pivot: f64,
}

impl Member {
    /// Anywhere.
    fn poses(self, drives: Vec<f64>) -> Poses {
        self.near(drives.into_iter().map(|drive| (drive, 1.0)).collect())
    }

    /// With the pivots there.
    fn near(self, drives: Vec<(f64, f64)>) -> Poses {
        let pose = |(drive, pivot)| Pose { drive, loads: self.loads.clone(), pivot };
        let each = drives.into_iter().map(pose).collect();
        Poses { text: self.text, longest: self.longest, each, in_single: true }
    }

    fn drives(&self, random: &mut Random, count: usize) -> Vec<f64> {
        (0..count).map(|_| random.range(self.range.0, self.range.1)).collect()
    }
}

fn at(drive: f64, loads: &[[f64; 2]]) -> Arguments {
    Arguments { drives: vec![drive], loads: loads.to_vec(), ..Arguments::default() }
}

/// The nearest number that a scalar holds.
fn nearest<T: Number>(x: f64) -> f64 {
    T::exactly(x).to_f64()
}

/// The same with arguments that a scalar holds.
fn at_nearest<T: Number>(drive: f64, loads: &[[f64; 2]]) -> Arguments {
    let loads: Vec<_> = loads.iter().map(|load| load.map(nearest::<T>)).collect();
    at(nearest::<T>(drive), &loads)
}

/// A declaration with its scalar and its arithmetic.
fn computed_in<T: Scalar>(text: &str, fused: bool) -> String {
    let arithmetic = if fused { " arithmetic fused;" } else { "" };
    text.replacen(';', &format!("; scalar {};{arithmetic}", T::NAME), 1)
}

/// The equations of all free bodies, in doubles; nothing where the linkage cannot be assembled.
fn equations(linkage: &Linkage, arguments: &Arguments) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let kept = pose::<Double>(linkage, arguments).ok()?;
    let general = equations_at(&Coordinates::at(linkage, arguments, &kept));
    let right = DVector::from_vec(general.right_side(&|_| true).iter().map(|x| x.0).collect());
    let (lines, columns) = (right.len(), general.matrix[0].len());
    Some((DMatrix::from_fn(lines, columns, |i, j| general.matrix[i][j].0), right))
}

/// Where the drive comes to a singular pose: where the linkage ends, or the determinant of all its equations changes its sign. On
/// each side the nearest doubles.
fn singular(linkage: &Linkage, range: (f64, f64), steps: u32) -> Vec<Singular> {
    singular_to(0.0, linkage, range, steps)
}

/// The same to within a distance.
fn singular_to(distance: f64, linkage: &Linkage, (low, high): (f64, f64), steps: u32) -> Vec<Singular> {
    let sense = |drive: f64| {
        let (matrix, _) = equations(linkage, &at(drive, &vec![[0.0; 2]; linkage.model.loads.len()]))?;
        Some(matrix.determinant() > 0.0)
    };
    let place = |step: u32| low + (high - low) * f64::from(step) / f64::from(steps);
    let senses: Vec<Option<bool>> = (0..=steps).map(|step| sense(place(step))).collect();
    let mut found = Vec::new();
    for step in 0..steps {
        let (first, second) = (senses[step as usize], senses[step as usize + 1]);
        if first == second {
            continue;
        }
        let (mut near, mut far) = (place(step), place(step + 1));
        let (kept, other) = if first.is_some() { (first, second) } else { (second, first) };
        if first.is_none() {
            core::mem::swap(&mut near, &mut far);
        }
        loop {
            let middle = 0.5 * (near + far);
            // No double lies between.
            if (near - far).abs() < distance || [near, far].map(f64::to_bits).contains(&middle.to_bits()) {
                break;
            }
            if sense(middle) == kept { near = middle } else { far = middle }
        }
        found.push(Singular { inside: near, outside: far, ends: other.is_none() });
    }
    found
}

#[derive(Clone, Copy)]
struct Singular {
    inside: f64,
    outside: f64,
    /// Whether there is nothing beyond.
    ends: bool,
}

impl Singular {
    /// At which the pivot is about 10⁻¹ to 10⁻⁷ of what it is elsewhere, in steps of half a power of ten; and that part.
    fn near(self) -> impl Iterator<Item = (f64, f64)> {
        let sense = (self.inside - self.outside).signum();
        (2..=14).map(move |halves| {
            let pivot = 10f64.powf(-0.5 * f64::from(halves));
            // At an end the pivot grows with the root of the distance.
            let distance = if self.ends { pivot * pivot } else { pivot };
            (self.inside + sense * distance, pivot)
        })
    }
}

/// Loads without the part that the coefficients see, but for so much of it.
fn without(loads: &[[f64; 2]], coefficients: &[[f64; 2]], but: f64) -> Vec<[f64; 2]> {
    let dot = |a: &[[f64; 2]], b: &[[f64; 2]]| a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum::<f64>();
    let size = dot(coefficients, coefficients);
    let factor = if size > 0.0 { (1.0 - but) * dot(loads, coefficients) / size } else { 0.0 };
    let less = |(load, c): (&[f64; 2], &[f64; 2])| [load[0] - factor * c[0], load[1] - factor * c[1]];
    loads.iter().zip(coefficients).map(less).collect()
}

/// A function of the loads by its values for unit loads.
fn coefficients(count: usize, of: &dyn Fn(&[[f64; 2]]) -> Option<f64>) -> Option<Vec<[f64; 2]>> {
    let unit = |load: usize, part: usize| {
        let mut loads = vec![[0.0; 2]; count];
        loads[load][part] = 1.0;
        of(&loads)
    };
    (0..count).map(|load| Some([unit(load, 0)?, unit(load, 1)?])).collect()
}

/// Numbers of a declaration, each with what follows it, replaced.
fn with_numbers(text: &str, new: &dyn Fn(&str, &str) -> Option<String>) -> String {
    let bytes = text.as_bytes();
    let (mut out, mut i) = (String::new(), 0);
    while i < bytes.len() {
        let word = |b: u8| b.is_ascii_alphanumeric() || b == b'_';
        if bytes[i].is_ascii_digit() && (i == 0 || !word(bytes[i - 1])) {
            let digits = |from: usize| (from..bytes.len()).find(|j| !(bytes[*j].is_ascii_digit() || bytes[*j] == b'.'));
            let mut end = digits(i).unwrap_or(bytes.len());
            if text[end..].starts_with("e-") {
                end = digits(end + 2).unwrap_or(bytes.len());
            }
            let unit = (end..bytes.len()).find(|j| !word(bytes[*j])).unwrap_or(bytes.len());
            match new(&text[i..end], &text[end..unit]) {
                Some(other) => out.push_str(&other),
                None => out.push_str(&text[i..unit]),
            }
            i = unit;
        } else if word(bytes[i]) {
            let end = (i..bytes.len()).find(|j| !word(bytes[*j])).unwrap_or(bytes.len());
            out.push_str(&text[i..end]);
            i = end;
        } else {
            out.push(char::from(bytes[i]));
            i += 1;
        }
    }
    out
}

/// All directions along the axes.
fn along_the_axes(text: &str) -> String {
    with_numbers(text, &|number, unit| {
        let degrees: f64 = number.parse().ok()?;
        (unit == "deg").then(|| format!("{:?}deg", 90.0 * (degrees / 90.0).round()))
    })
}

/// Nothing for lengths that are rounding errors, and quarter turns for angles that are nearly some.
fn exactly_on_lattice(text: &str) -> String {
    with_numbers(text, &|number, unit| {
        let value: f64 = number.parse().ok()?;
        let quarters = (value / FRAC_PI_2).round();
        match unit {
            "m" if value < 1e-9 => Some("0.0m".to_owned()),
            "rad" if (value - quarters * FRAC_PI_2).abs() < 1e-6 => Some(format!("{:?}deg", 90.0 * quarters)),
            _ => None,
        }
    })
}

/// A family by its number: which kinds have such poses, and some of them. A member that was drawn may have none.
struct Hard {
    name: &'static str,
    of: fn(&Kind) -> bool,
    make: fn(&Kind, &mut Random) -> Vec<Poses>,
    unknown: Unknown,
}

impl Hard {
    /// Of how many regular poses of a kind one may be refused, in doubles and in single precision.
    fn refused(&self, kind: &Kind) -> [usize; 2] {
        match (self.name, kind.is_block()) {
            // Beyond a change point, where the branches of a loop cross, no motion leads to a pose, but an iteration in many digits may come past.
            (FOLDS, true) => [20, 5],
            // Measured of links in a crank's slot, the worst: one in nine.
            (FOLDS, false) => [100, 5],
            (_, false) if self.unknown == REGULAR => [100, 100],
            _ => [100, 20],
        }
    }
}

/// Of how many bounds of results at poses that are told one may say that nothing is known, in doubles and in single precision.
#[derive(Clone, Copy, PartialEq)]
struct Unknown {
    double: usize,
    single: usize,
}

/// At regular poses nothing makes a bound lose the error.
const REGULAR: Unknown = Unknown { double: 100, single: 100 };
const FOLDS: &str = "3 folds";
/// Lengths 10⁸ apart are told apart in doubles; in single precision a short link's angle may be known to a hundredth only. Measured of four-bars:
/// 3 in a hundred.
const APART: Unknown = Unknown { double: 100, single: 20 };
/// Legs that are 10⁻⁴ from meeting in a point or from being parallel are nearer to a singular pose than single precision can tell.
const TRIADS: Unknown = Unknown { double: 100, single: 4 };
/// A pivot is what it is said to be but for a factor, and what is not linear has no bound before the pivot has lost all its digits. Measured of
/// class IV, the worst: 9 and 22 in a hundred.
const SINGULAR: Unknown = Unknown { double: 8, single: 4 };

const FAMILIES: [Hard; 9] = [
    Hard {
        name: "random",
        unknown: REGULAR,
        of: |_| true,
        make: |kind, random| {
            let member = kind.drawn(random);
            let drives = member.drives(random, 20);
            vec![member.poses(drives)]
        },
    },
    Hard {
        name: "1 dead centres",
        unknown: SINGULAR,
        of: Kind::has_dead_centres,
        make: |kind, random| near_dead_centres(kind, random, false),
    },
    Hard {
        name: "2 compatible",
        unknown: SINGULAR,
        of: Kind::has_dead_centres,
        make: |kind, random| near_dead_centres(kind, random, true),
    },
    Hard {
        name: FOLDS,
        unknown: SINGULAR,
        of: |kind| !kind.folds.is_empty() || kind.is_by_places(),
        make: |kind, random| {
            if let Drawn::ByPlaces(class) = kind.drawn {
                // Of cascades several: how far bounds are above errors differs from one to another.
                let count = if matches!(class, Class::Cascade) { 3 } else { 1 };
                return (0..count).filter_map(|_| near_a_fold(class, kind, random)).collect();
            }
            let Some(member) = kind.with(random.pick::<&[f64]>(kind.folds), random) else { return Vec::new() };
            let Some(linkage) = compile_if_it_closes(&member.text) else { return Vec::new() };
            let found = singular(&linkage, (member.range.0, member.range.0.midpoint(member.range.1) + 0.1), 90);
            let drives = found.into_iter().flat_map(Singular::near).collect();
            // Pins that meet at no dead centre.
            let near = |about: f64| (0..=7).flat_map(move |k| [1.0, -1.0].map(|sign| about + sign * 10f64.powi(-k)));
            let text = along_the_axes(&member.text);
            let longest = member.longest;
            let other = Member { text, longest, range: member.range, loads: member.loads.clone() };
            let others = (-2..=2).flat_map(|k| near(f64::from(k) * FRAC_PI_2)).collect();
            vec![member.near(drives), other.poses(others)]
        },
    },
    Hard { name: "4 ratios", of: |_| true, make: lengths_apart, unknown: APART },
    Hard {
        name: "5, 14 aligned",
        unknown: REGULAR,
        of: |_| true,
        make: |kind, random| {
            if let Drawn::ByPlaces(class) = kind.drawn {
                let member = kind.laid(class, Layout::OnLattice, random);
                let text = exactly_on_lattice(&member.text);
                let begin = member.range.0.midpoint(member.range.1);
                let drives = [0.0, 0.1, -0.1, 0.25, -0.25, FRAC_PI_2, -FRAC_PI_2, PI].map(|turned| begin + turned);
                return vec![Member { text, ..member }.poses(drives.into())];
            }
            let Some(member) = kind.with(random.pick::<&[f64]>(kind.aligned), random) else { return Vec::new() };
            let text = along_the_axes(&member.text);
            let drives = (-4..=4).map(|k| f64::from(k) * FRAC_PI_2).chain([0.5, 1.0, 1.5, 2.5]).collect();
            vec![Member { text, ..member }.poses(drives)]
        },
    },
    Hard {
        name: "7 loads",
        unknown: REGULAR,
        of: |_| true,
        make: |kind, random| {
            let mut member = kind.drawn(random);
            let factor = *random.pick(&[0.0, 1e-8, 1e8, -1e8]);
            let which = random.below(member.loads.len());
            member.loads[which] = member.loads[which].map(|x| single(x * factor));
            let drives = member.drives(random, 20);
            vec![member.poses(drives)]
        },
    },
    Hard {
        name: "10 cancelling",
        unknown: REGULAR,
        of: |_| true,
        make: |kind, random| {
            let member = kind.drawn(random);
            let Some(linkage) = compile_if_it_closes(&member.text) else { return Vec::new() };
            let drives = member.drives(random, 20);
            let name = &linkage.model.unknowns[0].name;
            let poses = drives.into_iter().filter_map(|drive| {
                let torque =
                    |loads: &[[f64; 2]]| Some(scene::<Double>(&linkage, "work", &at(drive, loads)).ok()?[name].0);
                let loads = without(&member.loads, &coefficients(member.loads.len(), &torque)?, 1e-10);
                Some(Pose { drive, loads, pivot: 1.0 })
            });
            let each = poses.collect();
            vec![Poses { text: member.text, longest: member.longest, each, in_single: true }]
        },
    },
    Hard {
        name: "9 triads",
        of: |kind| kind.name == "Newton: triads",
        make: |_, random| special_triads(random),
        unknown: TRIADS,
    },
];

/// Poses next to folds of a loop in a block or in front of a cascade.
fn near_a_fold(class: Class, kind: &Kind, random: &mut Random) -> Option<Poses> {
    let lengths = FOUR_BAR_FOLDS[random.below(FOUR_BAR_FOLDS.len())].try_into().expect("four lengths");
    let member = match class {
        Class::Three => folding_triad(lengths, false, random),
        Class::ThreeWithSlider => folding_triad(lengths, true, random),
        Class::Four => folding_ring(random),
        Class::Cascade => kind.laid(class, Layout::BehindFold(lengths), random),
    };
    let member = Member { text: exactly_on_lattice(&member.text), ..member };
    let linkage = compile_if_it_closes(&member.text)?;
    let start = member.range.0.midpoint(member.range.1);
    let found = singular_to(1e-9, &linkage, (start - 0.8, start + 0.8), 10);
    // The pivot grows with the distance, whether or not the iteration comes past the fold.
    let drives = found.into_iter().flat_map(|fold| Singular { ends: false, ..fold }.near()).collect();
    Some(member.near(drives))
}

fn near_dead_centres(kind: &Kind, random: &mut Random, compatible: bool) -> Vec<Poses> {
    let mut members = vec![kind.drawn(random)];
    if let Drawn::ByDimensions { dimensions, angle: true, .. } = &kind.drawn {
        // Slides that are nearly parallel.
        let mut sizes: Vec<f64> = dimensions.iter().map(|(low, high)| length(random, *low, *high)).collect();
        let last = sizes.len() - 1;
        sizes[last] = single(10f64.powi(-1 - i32::try_from(random.below(6)).expect("small")).to_degrees());
        members.extend(kind.with(&sizes, random));
    }
    let mut families = Vec::new();
    for member in members {
        let Some(linkage) = compile_if_it_closes(&member.text) else { continue };
        let steps = if kind.is_by_places() { 40 } else { 90 };
        let found = singular(&linkage, kind.widely(&member), steps);
        let mut drives: Vec<(f64, f64)> = found.into_iter().flat_map(Singular::near).collect();
        if matches!(kind.drawn, Drawn::ByDimensions { angle: true, .. }) {
            drives.extend(member.drives(random, 4).into_iter().map(|drive| (drive, 1.0)));
        }
        let mut poses = member.near(drives);
        if compatible {
            poses.each.retain_mut(|pose| match compatible_loads(&linkage, pose) {
                Some(loads) => {
                    pose.loads = loads;
                    true
                }
                None => false,
            });
        }
        families.push(poses);
    }
    families
}

/// The loads of a pose without what the virtual displacement of the singular one sees.
fn compatible_loads(linkage: &Linkage, Pose { drive, loads, .. }: &Pose) -> Option<Vec<[f64; 2]>> {
    let (matrix, _) = equations(linkage, &at(*drive, loads))?;
    let last = matrix.nrows() - 1;
    let virtual_displacement = matrix.svd(true, false).u?.column(last).into_owned();
    let work = |loads: &[[f64; 2]]| Some(equations(linkage, &at(*drive, loads))?.1.dot(&virtual_displacement));
    Some(without(loads, &coefficients(loads.len(), &work)?, 0.0))
}

/// Lengths that differ by up to 10⁸, and so legs that are much longer than the distance between their pins.
fn lengths_apart(kind: &Kind, random: &mut Random) -> Vec<Poses> {
    let (dimensions, angle) = match &kind.drawn {
        Drawn::ByDimensions { dimensions, angle, .. } => (dimensions, angle),
        Drawn::ByPlaces(class) => {
            let laid = [3, 7].into_iter().map(|powers| {
                let distance = 10f64.powi(-2 - i32::try_from(random.below(powers)).expect("small"));
                let member = kind.laid(*class, Layout::Apart(distance), random);
                let middle = member.range.0.midpoint(member.range.1);
                let drives = (0..=5).flat_map(|k| [1.0, -1.0].map(|sign| middle + sign * 0.5 * 10f64.powi(-k)));
                Poses { in_single: distance >= CLOSEST_IN_SINGLE, ..member.poses(drives.collect()) }
            });
            return laid.collect();
        }
    };
    let lengths = dimensions.len() - usize::from(*angle);
    let small = 10f64.powi(-2 - i32::try_from(random.below(7)).expect("small"));
    let which = 1 + random.below((1 << lengths) - 2);
    // Those that are large are equal, as often as not.
    let equal = random.chance(0.5);
    let sizes: Vec<f64> = dimensions
        .iter()
        .enumerate()
        .map(|(index, (low, high))| {
            let size = if equal && index < lengths { 1.0 } else { length(random, *low, *high) };
            if index < lengths && which >> index & 1 == 1 { single(length(random, 0.3, 1.0) * small) } else { size }
        })
        .collect();
    let Some(member) = kind.with(&sizes, random) else { return Vec::new() };
    let near = (0..=8).flat_map(|k| [0.0, PI].map(|about| about + random.range(-1.0, 1.0) * 10f64.powi(-k)));
    let mut drives: Vec<f64> = near.collect();
    drives.extend(member.drives(random, 6));
    // What is known of the direction of a short link is the rounding of long ones over its length: ε/small, as beside a pivot of √small ε/pivot².
    vec![member.near(drives.into_iter().map(|drive| (drive, small.sqrt())).collect())]
}

/// The way of a length at an angle.
fn along(angle: f64, length: f64) -> Place {
    direction(angle).map(|x| length * x)
}

/// A way turned by an angle.
fn turned([x, y]: Place, angle: f64) -> Place {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

/// A point as it is declared.
fn point([x, y]: Place) -> String {
    format!("({x:?}m, {y:?}m)")
}

/// A ternary link on three legs, by its pins and the ways along the legs to them, where it starts.
fn triad(pins: [Place; 3], legs: [Place; 3], random: &mut Random) -> Member {
    let feet: Vec<Place> = pins.iter().zip(legs).map(|(p, l)| [p[0] - l[0], p[1] - l[1]]).collect();
    let (crank, q) = (length(random, 0.3, 1.0), random.range(-3.0, 3.0));
    let o = [feet[0][0] - crank * q.cos(), feet[0][1] - crank * q.sin()];
    let own = |p: Place| [p[0] - pins[0][0], p[1] - pins[0][1]];
    let lengths = legs.map(size);
    let [angle_b, angle_c, angle_d] = legs.map(|leg| leg[1].atan2(leg[0]));
    let (x, y) = (random.range(-1.0, 1.0), random.range(-1.0, 1.0));
    let text = format!(
        "pub mod sample; ground {{ O: {}, F: {}, G: {} }} link crank {{ O -> A: {crank:?}m }} link b {{ A -> P: {:?}m }}
         link t {{ P: (0, 0), Q: {}, R: {}, T: {} }} link c {{ F -> Q: {:?}m, S: ({x:?}m, {y:?}m) }} link d {{ G -> R: {:?}m }}
         revolute O: ground -> crank; revolute A: crank -> b; revolute P: b -> t; revolute F: ground -> c; revolute Q: c -> t;
         revolute G: ground -> d; revolute R: d -> t; drive q: O; start q: {q:?}rad;
         start b: {}, angle {angle_b:?}rad; start t: {}, angle 0rad; start c: {}, angle {angle_c:?}rad; start d: {}, angle {angle_d:?}rad;
         load L: force(t.T); load H: force(c.S); scene all: equilibrium; scene work: virtual_work;",
        point(o), point(feet[1]), point(feet[2]), lengths[0],
        point(own(pins[1])), point(own(pins[2])), point([x, y]), lengths[1], lengths[2],
        point(feet[0]), point(pins[0]), point(feet[1]), point(feet[2]),
    );
    let ternary = [size(own(pins[1])), size(own(pins[2])), size([pins[2][0] - pins[1][0], pins[2][1] - pins[1][1]])];
    let longest = lengths.into_iter().chain(ternary).chain([crank]).fold(0.0, f64::max);
    let text = in_single_precision(&text);
    Member { text, longest, range: (q - 0.1, q + 0.1), loads: loads(random) }
}

/// A triad on two legs of which the one on the crank moves a four-bar that folds, or a slider-crank whose crank is as long as its rod.
fn folding_triad([ground, crank, coupler, rocker]: [f64; 4], slider: bool, random: &mut Random) -> Member {
    let halves = |random: &mut Random| [(); 2].map(|()| random.range(-2.0, 2.0).round() / 2.0);
    let f = halves(random);
    let coupler = if slider { crank } else { coupler };
    let (g, [at_q, at_r]) = loop {
        let angle = random.range(-3.0, 3.0);
        let at_q = plus(f, along(angle, crank));
        if slider {
            let at_r = plus(f, [2.0 * crank * angle.cos(), 0.0]);
            break (plus(f, [-0.5, 0.0]), [at_q, at_r]);
        }
        let g = plus(f, [ground, 0.0]);
        if let Some(at_r) = intersection([at_q, g], [coupler, rocker]) {
            break (g, [at_q, at_r]);
        }
    };
    // The plate: its frame at Q, its x axis to R; and the leg from the crank to P.
    let angle_of = |way: Place| way[1].atan2(way[0]);
    let (plate, own, at_t) = (angle_of(minus(at_r, at_q)), halves(random), halves(random));
    let at_p = plus(at_q, turned(own, plate));
    let (leg, inclined) = (length(random, 0.5, 2.0), random.range(-3.0, 3.0));
    let at_a = minus(at_p, along(inclined, leg));
    let (drive, q) = (length(random, 0.5, 1.5), random.range(-3.0, 3.0));
    let o = minus(at_a, along(q, drive));
    let third = if slider {
        format!(
            "link d {{ R: (0, 0), V: (0.5m, 0.25m) }} prismatic G: ground.G -> d.R along 0deg, angle 0deg;
             start d: {}, angle 0deg;",
            point(at_r)
        )
    } else {
        format!(
            "link d {{ G -> R: {rocker:?}m, V: (0.5m, 0.25m) }} revolute G: ground -> d; start d: {}, angle {:?}rad;",
            point(g),
            angle_of(minus(at_r, g))
        )
    };
    let text = format!(
        "pub mod sample; ground {{ O: {}, F: {}, G: {} }} link crank {{ O -> A: {drive:?}m }} link b {{ A -> P: {leg:?}m }}
         link t {{ Q -> R: {coupler:?}m, P: {}, T: {} }} link c {{ F -> Q: {crank:?}m, S: (0.25m, 0.5m) }} {third}
         revolute O: ground -> crank; revolute A: crank -> b; revolute P: b -> t; revolute F: ground -> c; revolute Q: c -> t;
         revolute R: d -> t; drive q: O; start q: {q:?}rad;
         start b: {}, angle {inclined:?}rad; start t: {}, angle {plate:?}rad; start c: {}, angle {:?}rad;
         load L: force(t.T); load H: force({}); scene all: equilibrium; scene work: virtual_work;",
        point(o), point(f), point(g), point(own), point(at_t), point(at_a), point(at_q), point(f), angle_of(minus(at_q, f)),
        random.pick(&["c.S", "d.V"]),
    );
    let longest = [drive, leg, crank, coupler, rocker, own[0].hypot(own[1])].into_iter().fold(0.0, f64::max);
    Member { text: in_single_precision(&text), longest, range: (q - 0.3, q + 0.3), loads: loads(random) }
}

/// Two plates on legs that are parallel and of one length: they fold where the legs point along the plates.
fn folding_ring(random: &mut Random) -> Member {
    let quarters = |random: &mut Random| [(); 2].map(|()| random.range(-6.0, 6.0).round() / 4.0);
    let apart = |a: Place| size(a) > 0.4;
    let (c, e, between) = loop {
        let [c, e, between] = [(); 3].map(|()| quarters(random));
        // With c = e the crank's pin and the ground's would be on a third leg, as long as the others: nothing would hold the plates.
        if [c, e, between, plus(c, between), plus(e, between), minus(c, e)].into_iter().all(apart) {
            break (c, e, between);
        }
    };
    let (d, f) = (plus(c, between), plus(e, between));
    let (leg, angle) = (0.25 * random.range(2.0, 8.0).round(), random.range(-3.0, 3.0));
    let off = random.range(0.1, 0.6) * if random.chance(0.5) { 1.0 } else { -1.0 };
    let legs = angle + between[1].atan2(between[0]) + off;
    let (drive, q, o) = (length(random, 0.5, 1.5), random.range(-3.0, 3.0), quarters(random));
    let at_a = plus(o, along(q, drive));
    let [at_c, at_d] = [c, d].map(|place| plus(at_a, turned(place, angle)));
    let at_e = plus(at_c, along(legs, leg));
    let at_b = minus(at_e, turned(e, angle));
    let (s, t) = (quarters(random), quarters(random));
    let text = format!(
        "pub mod sample; ground {{ O: {}, B: {} }} link crank {{ O -> A: {drive:?}m }} link m {{ A: (0, 0), C: {}, D: {}, S: {} }}
         link n {{ B: (0, 0), E: {}, F: {}, T: {} }} link g {{ C -> E: {leg:?}m }} link h {{ D -> F: {leg:?}m }}
         revolute O: ground -> crank; revolute A: crank -> m; revolute B: ground -> n; revolute C: m -> g; revolute E: g -> n;
         revolute D: m -> h; revolute F: h -> n; drive q: O; start q: {q:?}rad;
         start m: {}, angle {angle:?}rad; start n: {}, angle {angle:?}rad; start g: {}, angle {legs:?}rad; start h: {}, angle {legs:?}rad;
         load L: force(m.S); load H: force(n.T); scene all: equilibrium; scene work: virtual_work;",
        point(o), point(at_b), point(c), point(d), point(s), point(e), point(f), point(t), point(at_a), point(at_b), point(at_c), point(at_d),
    );
    let longest = [c, d, e, f, between].map(size).into_iter().chain([drive, leg]).fold(0.0, f64::max);
    Member { text: in_single_precision(&text), longest, range: (q - 0.3, q + 0.3), loads: loads(random) }
}

/// Legs whose lines nearly meet in one point, or that are nearly parallel; the third pin on the first line; a tiny or a huge ternary.
fn special_triads(random: &mut Random) -> Vec<Poses> {
    let distance = 10f64.powi(-1 - i32::try_from(random.below(4)).expect("small"));
    let sign = |random: &mut Random| if random.chance(0.5) { 1.0 } else { -1.0 };
    let at = |random: &mut Random| [random.range(-1.0, 1.0), random.range(-1.0, 1.0)];
    let which = random.below(5);
    let mut pins = [at(random), at(random), at(random)];
    let sizes = [(); 3].map(|()| random.range(0.5, 2.0) * sign(random));
    let begin = random.range(-3.0, 3.0);
    let mut angles = [begin, begin + random.range(0.7, 1.5), begin - random.range(0.7, 1.5)];
    match which {
        0 => {
            let meet = at(random);
            angles = pins.map(|p| (meet[1] - p[1]).atan2(meet[0] - p[0]));
            angles[2] += distance * sign(random);
        }
        1 => angles = [begin, begin + distance * sign(random), begin - 0.7 * distance],
        2 => {
            let along = along(angles[0], random.range(0.4, 1.5));
            pins[2] = [pins[0][0] + along[0], pins[0][1] + along[1]];
        }
        _ => {
            let factor = if which == 3 { distance } else { 1.0 / distance };
            pins = pins.map(|p| p.map(|x| x * factor));
        }
    }
    let legs = [0, 1, 2].map(|i| along(angles[i], sizes[i]));
    let member = triad(pins, legs, random);
    if which < 2 && !(closes_from_its_start::<Double>(&member.text) && closes_from_its_start::<Single>(&member.text)) {
        return Vec::new();
    }
    let middle = member.range.0.midpoint(member.range.1);
    let reach = if which < 2 { distance } else { 1.0 } * 0.1;
    let drives = (0..6).map(|_| middle + random.range(-reach, reach)).collect();
    vec![member.poses(drives)]
}

/// Whether a pose is near: so close to a singular one lengths in single precision may leave none.
fn closes_from_its_start<T: Scalar>(text: &str) -> bool {
    let refused = linkage_codegen::analyse(computed_in::<T>(text, false).parse().expect("tokens")).err();
    refused.is_none_or(|refusal| !refusal.errors.iter().all(|e| e.message().contains("from their starting pose")))
}

/// What a family gave in one scalar.
#[derive(Default)]
struct Cell {
    /// The worst of each measure.
    worst: Measures,
    poses: usize,
    /// The worst pose.
    example: Option<(f64, String)>,
    /// Ratios of bounds to errors, and how many poses have some.
    ratios: Vec<f64>,
    bounded: usize,
    /// How many bounds there are at poses that are told, and how many of these are the largest number: of such a result nothing is known.
    bounds: usize,
    unknown: usize,
    /// Of poses that are regular in exact arithmetic, and so far from singular ones that rounding leaves digits, how many have an answer, and
    /// how many have none.
    answered: usize,
    refused: usize,
}

/// Whether a pivot is zero to rounding: of such a pose there are no forces, and directions at the very end of a motion are those that
/// are nearest to closing.
fn at_its_dead_centre<T: Number>(linkage: &Linkage, arguments: &Arguments) -> bool {
    let Ok(kept) = pose::<T>(linkage, arguments) else { return true };
    // The arm of a slot is a pivot, that of a load is not: it is zero wherever the load's line goes through the pin.
    let is_pivot = |name: &str| {
        let is_joint = |arm: &str| linkage.model.joints.iter().any(|joint| joint.name.text == arm);
        name.starts_with("sin_mu_") || name.strip_prefix("arm_").is_some_and(is_joint)
    };
    let pivots = linkage.plan.pose.iter().filter(|kept| is_pivot(&kept.name));
    pivots.map(|pivot| kept[&pivot.node].to_f64()).any(|pivot| pivot == 0.0)
}

/// Whether there are forces in exact arithmetic only.
fn is_refused<T: Number>(linkage: &Linkage, arguments: &Arguments) -> bool {
    let scenes = ["all", "work"];
    let are_regular = || {
        let Ok(kept) = pose::<Extended>(linkage, arguments) else { return false };
        scenes.into_iter().all(|name| from_kept(linkage, name, &kept, arguments).is_ok())
    };
    scenes.into_iter().any(|name| scene::<T>(linkage, name, arguments).is_err()) && are_regular()
}

/// The largest part of its bar that a measure takes, and its name.
fn share(measures: &Measures) -> (f64, &'static str) {
    let all = [
        (measures.unit / BARS.unit, "unit"),
        (measures.closure / BARS.closure, "closure"),
        (measures.backward / BARS.backward, "backward"),
        (measures.free_body / BARS.free_body, "free body"),
        (measures.torque / BARS.torque, "torque"),
    ];
    all.into_iter().fold((0.0, ""), |worst, one| if one.0 > worst.0 { one } else { worst })
}

/// Of how many poses a median of bounds over errors is judged: the results of one pose often share one error.
const ENOUGH: usize = 30;

/// Errors of forces grow as ε/pivot². How far above them bounds are is judged where this is small: in doubles down to pivots of 10⁻⁷, the
/// smallest there are, in single precision down to 10⁻²·⁵. Of nearer poses a bound may say that nothing is known; none is too small.
const TOLD: f64 = 0.03;

impl Cell {
    fn add<T: Scalar>(&mut self, Poses { text, longest, each, .. }: &Poses, fused: bool, bounded: bool) {
        let text = computed_in::<T>(text, fused);
        let Some(linkage) = compile_if_it_closes(&text) else { return };
        // A pose that is kept for bounds is computed by another program: the bars are those of the one without.
        let with_bounds = if bounded { with_bounds_of(&linkage, &text) } else { None };
        assert_eq!(with_bounds.is_some(), bounded, "{text}");
        for Pose { drive, loads, pivot } in each {
            let arguments = at_nearest::<T>(*drive, loads);
            let is_told = T::EPSILON <= TOLD * pivot * pivot;
            let measures = measure::<T>(&linkage, &arguments, *longest, T::EPSILON);
            let has_answer = measures.is_ok() && !at_its_dead_centre::<T>(&linkage, &arguments);
            if is_told && has_answer {
                self.answered += 1;
            } else if is_told && is_refused::<T>(&linkage, &arguments) {
                self.refused += 1;
            }
            let Some(measures) = measures.ok().filter(|_| has_answer) else { continue };
            self.poses += 1;
            self.worst = self.worst.worst(measures);
            let (share, _) = share(&measures);
            let context = || format!("{text}\ndrive {drive:?}, loads {loads:?}");
            if self.example.as_ref().is_none_or(|(worst, _)| share > *worst) {
                self.example = Some((share, format!("{measures:?}\n{}", context())));
            }
            if let Some(linkage) = &with_bounds {
                let Ok(found) = scene::<T>(linkage, "bounded", &arguments) else {
                    self.refused += usize::from(is_told);
                    continue;
                };
                let ratios = ratios(linkage, &arguments, &found, &context());
                if is_told {
                    self.bounded += usize::from(!ratios.is_empty());
                    self.ratios.extend(ratios);
                    let bounds = || found.iter().filter(|(path, _)| path.starts_with("error_bound."));
                    self.bounds += bounds().count();
                    self.unknown += bounds().filter(|(_, bound)| bound.to_f64() >= T::MAX).count();
                }
            }
        }
    }

    fn is_full(&self, size: &Size) -> bool {
        self.poses >= size.poses && self.bounded >= size.with_bounds
    }

    /// Its part of a line, and what is beyond its bar; of its regular poses one in so many may be refused, of their bounds one in so many be
    /// unknown.
    fn report(mut self, one_in: usize, unknown_in: usize) -> (String, Option<String>) {
        let (worst, of) = share(&self.worst);
        let median = median(&mut self.ratios).expect("results");
        let line = format!(
            "{:8} poses, {:4} refused {worst:5.2} {of:9} bound/error {median:4.0} of {:7}, {:6} of {:7} unknown",
            self.poses,
            self.refused,
            self.ratios.len(),
            self.unknown,
            self.bounds
        );
        let beyond = self.example.filter(|(share, _)| *share > 1.0).map(|(_, example)| example);
        let loose =
            (median > LOOSEST && self.bounded >= ENOUGH).then(|| format!("bounds are too far from errors: {median}"));
        // Of few poses two: those of one linkage are refused together.
        let allowed = ((self.answered + self.refused) / one_in).max(2);
        let refused = (self.refused > allowed)
            .then(|| format!("of {} regular poses {} are refused", self.answered + self.refused, self.refused));
        let unknown = (self.unknown > self.bounds / unknown_in)
            .then(|| format!("of {} bounds at regular poses {} are unknown", self.bounds, self.unknown));
        (line, beyond.or(loose).or(refused).or(unknown))
    }
}

/// How much of each family.
#[derive(Clone, Copy)]
struct Size {
    /// Members that have poses in both scalars.
    members: usize,
    /// Random poses in each scalar, beside those of the families.
    poses: usize,
    /// Each of how many members has its bounds looked at.
    bounded: usize,
    /// Poses with bounds in each scalar.
    with_bounds: usize,
    /// Whether products are added without being rounded.
    fused: bool,
}

impl Size {
    /// A member of many links has many poses, and an exact pose of a block is a long walk: few of these have bounds.
    fn reduced(kind: &Kind) -> Self {
        let members = if kind.is_by_places() { 1 } else { 2 };
        let with_bounds = if kind.is_block() { 8 } else { ENOUGH };
        Self { members, poses: 0, bounded: 1, with_bounds, fused: false }
    }

    const fn full(poses: usize) -> Self {
        Self { members: 100, poses, bounded: 4, with_bounds: ENOUGH, fused: false }
    }

    /// As much in fused arithmetic as suffices beside this.
    fn fused(self) -> Self {
        Self { members: self.members.div_ceil(2), poses: self.poses.min(10_000), fused: true, ..self }
    }

    /// Draws members until there are as many as are asked for, and enough of them for a median, in both scalars.
    fn filled(&self, what: &str, mut make: impl FnMut() -> Vec<Poses>) -> (Cell, Cell) {
        let (mut double, mut single) = (Cell::default(), Cell::default());
        let (mut members, most) = (0, 100 * self.members + self.poses);
        for _ in 0..most {
            if members >= self.members && double.is_full(self) && single.is_full(self) {
                return (double, single);
            }
            let before = (double.poses, single.poses);
            for poses in make() {
                let bounded = members % self.bounded == 0;
                double.add::<Double>(&poses, self.fused, bounded);
                if poses.in_single {
                    single.add::<Single>(&poses, self.fused, bounded);
                }
            }
            members += usize::from(double.poses > before.0 && single.poses > before.1);
        }
        let found = [double, single].map(|cell| (cell.poses, cell.bounded));
        panic!(
            "{what}: of {most} drawn {members} have poses; in either scalar poses, and those with bounds: {found:?}"
        );
    }
}

/// All families of a kind, and as many random poses as are asked for.
fn run(kind: &Kind, size: Size) {
    let mut beyond = String::new();
    let kind_name = if size.fused { format!("{}, fused", kind.name) } else { kind.name.to_owned() };
    let mut add = |family: &str, refused: [usize; 2], unknown: Unknown, (double, single): (Cell, Cell)| {
        let [(double, first), (single, second)] =
            [double.report(refused[0], unknown.double), single.report(refused[1], unknown.single)];
        println!("{kind_name:46} {family:14} f64 {double}  f32 {single}");
        for (scalar, example) in [("f64", first), ("f32", second)] {
            let Some(example) = example else { continue };
            beyond += &[&kind_name, ", ", family, ", ", scalar, ": ", &example, "\n"].concat();
        }
    };
    for (number, hard) in (0..).zip(&FAMILIES) {
        let Hard { name, of, make, unknown } = hard;
        if of(kind) {
            let mut random = Random(number);
            let size = Size { poses: 1, ..size };
            let cells = size.filled(&[&kind_name, ", ", name].concat(), || make(kind, &mut random));
            add(name, hard.refused(kind), *unknown, cells);
        }
    }
    if size.poses > 0 {
        let mut random = Random(77);
        let size = Size { members: 1, ..size };
        let cells = size.filled(&kind_name, || {
            let member = kind.drawn(&mut random);
            // Of very many poses each linkage has more: compiling it takes as long as measuring a hundred.
            let drives = member.drives(&mut random, if size.poses > 100_000 { 200 } else { 40 });
            vec![member.poses(drives)]
        });
        add("random, many", FAMILIES[0].refused(kind), REGULAR, cells);
    }
    assert!(beyond.is_empty(), "{beyond}");
}

/// The results of a scene by name, bit for bit.
fn bits<T: Number>(linkage: &Linkage, name: &str, arguments: &Arguments) -> Result<Vec<(String, u64)>, Fault> {
    let values = scene::<T>(linkage, name, arguments)?;
    let mut all: Vec<(String, u64)> =
        values.into_iter().map(|(path, value)| (path, value.to_f64().to_bits())).collect();
    all.sort();
    Ok(all)
}

/// Of the poses that were tried at least a quarter have results to be compared: where nothing is, nothing is shown.
fn assert_compared(kind: &Kind, what: &str, compared: usize, tried: usize) {
    assert!(
        4 * compared >= tried && tried > 0,
        "{}, {what}: of {tried} that were tried {compared} were compared",
        kind.name
    );
}

/// 6: elsewhere the same linkage has the same directions and forces.
fn moved<T: Scalar>(kind: &Kind, members: usize, fused: bool) {
    let mut random = Random(15);
    let (mut compared, mut tried) = (0, 0);
    for offset in ["1000", "123456", "100000000"] {
        for _ in 0..members {
            let member = kind.drawn(&mut random);
            let text = computed_in::<T>(&member.text, fused);
            let text = [shifted(&text, offset), text];
            tried += 4;
            let [Some(far), Some(near)] = text.each_ref().map(|text| compile_if_it_closes(text)) else { continue };
            for drive in member.drives(&mut random, 4) {
                let arguments = at_nearest::<T>(drive, &member.loads);
                let [here, there] = [&near, &far].map(|linkage| bits::<T>(linkage, "all", &arguments));
                assert_eq!(here, there, "{}", text[0]);
                compared += usize::from(here.is_ok());
                let kept = |linkage: &Linkage| {
                    let kept = pose::<T>(linkage, &arguments).ok()?;
                    let bits = |node| kept[node].to_f64().to_bits();
                    Some(linkage.plan.pose.iter().map(|k| (k.name.clone(), bits(&k.node))).collect::<Vec<_>>())
                };
                assert_eq!(kept(&near), kept(&far), "{}", text[0]);
            }
        }
    }
    assert_compared(kind, "moved", compared, tried);
}

/// The declaration with all points of the ground, and all starts, moved by the same amount.
fn shifted(text: &str, offset: &str) -> String {
    let start = text.find("ground {").expect("a ground") + "ground {".len();
    let end = start + text[start..].find('}').expect("its end");
    let mut places = String::new();
    for place in text[start..end].split(", ").fold(Vec::<String>::new(), |mut all, part| {
        // `A0: (0, 0)` was split at its own comma.
        if part.contains(": ") {
            all.push(part.to_owned());
        } else if let Some(last) = all.last_mut() {
            let _ = write!(last, ", {part}");
        }
        all
    }) {
        let (name, at) = place.trim().split_once(": ").expect("a point");
        let (x, y) = match at.split_once(" @ ") {
            Some((size, angle)) => (format!("({size})*cos({angle})"), format!("({size})*sin({angle})")),
            None => {
                let (x, y) = at.trim_matches(['(', ')']).split_once(", ").expect("two coordinates");
                (x.to_owned(), y.to_owned())
            }
        };
        let _ = write!(places, "{name}: ({x} + {offset}m, {y} - {offset}m), ");
    }
    let starts = text[end..].split("start ").map(|part| {
        let place = part.split_once(": (").and_then(|(name, rest)| Some((name, rest.split_once("), angle")?)));
        let Some((name, (place, rest))) = place.filter(|(name, _)| !name.contains(';')) else { return part.to_owned() };
        let (x, y) = place.split_once(", ").expect("two coordinates");
        format!("{name}: ({x} + {offset}m, {y} - {offset}m), angle{rest}")
    });
    format!("{}{places}{}", &text[..start], starts.collect::<Vec<_>>().join("start "))
}

/// 6: the point by which a slide's or a slot's line is given, from which its travel counts, may be anywhere on it, in Newton blocks and
/// cascades that of a slide's runner, too. Only couples, and what is found from them, have the rounding of a travel that is so large. In
/// cascades ways of later dyads go over the slide: their forces are rounded otherwise then, with errors of the same size.
fn datum_moved<T: Scalar>(kind: &Kind, members: usize, fused: bool) {
    let mut random = Random(19);
    let [line, runner, both]: [&[bool]; 3] = [&[false], &[true], &[false, true]];
    let moves =
        [(20.0, line), (1e3, line), (-123_456.0, line), (1e8, line), (-1e3, runner), (1e8, runner), (-1e5, both)];
    // Where a line's own point is moved, and where its runner's is, too: a pin in a slot has none.
    let (mut by_line, mut by_runner, mut tried) = (0, 0, 0);
    for (distance, points) in moves.into_iter().filter(|(_, points)| *points == line || kind.is_by_places()) {
        for _ in 0..members {
            let member = kind.drawn(&mut random);
            let text = computed_in::<T>(&member.text, fused);
            tried += if points == line { 4 } else { 0 };
            let move_point = |text: String, runner: &bool| {
                let first = *far_points::lines(&text).first()?;
                far_points::with_point_moved(&text, first, distance, *runner)
            };
            let Some(moved) = points.iter().try_fold(text.clone(), move_point) else {
                let first = far_points::lines(&text).first().copied();
                let has_none = first.is_none_or(|name| far_points::is_driven(&text, name));
                assert!(points != line || has_none, "no point was moved\n{text}");
                continue;
            };
            let both = [&moved, &text].map(|text| compile_if_it_closes(text));
            assert_eq!(both[0].is_some(), both[1].is_some(), "{moved}");
            let [Some(far), Some(near)] = both else { continue };
            for drive in member.drives(&mut random, 4) {
                let arguments = at_nearest::<T>(drive, &member.loads);
                if let Some(further) = further_off::<T>([&far, &near], &arguments) {
                    assert!(further < 10.0, "{further} times, at {drive:?}\n{text}\n{moved}");
                    *(if points == line { &mut by_line } else { &mut by_runner }) += 1;
                }
                if kind.is_cascade() {
                    continue;
                }
                let forces = |linkage| {
                    let mut all = bits::<T>(linkage, "all", &arguments)?;
                    all.retain(|(path, _)| is_force(path));
                    assert!(!all.is_empty(), "no forces\n{text}");
                    Ok::<_, Fault>(all)
                };
                assert_eq!(forces(&far), forces(&near), "at {drive:?}\n{text}\n{moved}");
                assert_eq!(directions::<T>(&far, &arguments), directions::<T>(&near, &arguments), "{text}\n{moved}");
            }
        }
    }
    if kind.has_lines() {
        assert_compared(kind, "points of lines moved", by_line, tried);
        assert!(by_runner > 0 || !kind.is_by_places(), "{}: no point of a runner was moved", kind.name);
    }
}

/// How much further off a linkage's forces and efforts are than those of another one, there and nearby.
fn further_off<T: Scalar>(linkages: [&Linkage; 2], arguments: &Arguments) -> Option<f64> {
    let nearby = (1..4).map(|k| {
        let drive = arguments.drives[0] + f64::from(k) * 1e3 * T::EPSILON;
        at_nearest::<T>(drive, &arguments.loads)
    });
    far_points::further_off::<T>(
        linkages,
        ("all", |path: &str| !path.ends_with("couple")),
        arguments,
        nearby,
        T::EPSILON,
    )
}

/// The directions of a pose, bit for bit.
fn directions<T: Scalar>(linkage: &Linkage, arguments: &Arguments) -> Option<Vec<(String, u64)>> {
    let kept = pose::<T>(linkage, arguments).ok()?;
    let directions = linkage.plan.pose.iter().filter(|kept| kept.name.ends_with("_cos") || kept.name.ends_with("_sin"));
    Some(directions.map(|found| (found.name.clone(), kept[&found.node].to_f64().to_bits())).collect())
}

/// 8: in units that differ by a power of two the same linkage has the same digits.
fn in_other_units<T: Scalar>(kind: &Kind, members: usize, fused: bool) {
    let mut random = Random(16);
    let (mut compared, mut tried) = (0, 0);
    for exponent in [-T::UNITS, -8, 8, T::UNITS] {
        let (factor, power) = (2f64.powi(exponent), 2f64.powi(exponent.abs()));
        for _ in 0..members {
            let member = kind.drawn(&mut random);
            let text = computed_in::<T>(&member.text, fused);
            tried += 4;
            // A unit of length that is smaller by the factor stands in the declaration exactly.
            let unit = if exponent < 0 { format!("m/{power:?}") } else { format!("m*{power:?}") };
            let plain = compile_if_it_closes(&text);
            let text = with_numbers(&text, &|number, of| (of == "m").then(|| format!("{number}*{unit}")));
            let scaled = compile_if_it_closes(&text);
            assert_eq!(plain.is_some(), scaled.is_some(), "{text}");
            let (Some(plain), Some(scaled)) = (plain, scaled) else { continue };
            for drive in member.drives(&mut random, 4) {
                let other = if kind.slides() { drive * factor } else { drive };
                let [found, others] = [(&plain, drive), (&scaled, other)]
                    .map(|(linkage, drive)| scene::<T>(linkage, "all", &at_nearest::<T>(drive, &member.loads)));
                assert_eq!(found.is_ok(), others.is_ok(), "with 2^{exponent} at {drive:?}\n{text}");
                let (Ok(found), Ok(others)) = (found, others) else { continue };
                compared += 1;
                for (path, value) in found {
                    let expected = value.to_f64() * if is_moment(&plain, &path) { factor } else { 1.0 };
                    assert_eq!(
                        others[&path].to_f64().to_bits(),
                        expected.to_bits(),
                        "{path} with 2^{exponent} at {drive:?}\n{text}"
                    );
                }
            }
        }
    }
    assert_compared(kind, "in other units", compared, tried);
}

/// 8: in units of force that differ by a power of two the results have the same digits.
fn in_other_units_of_force<T: Scalar>(kind: &Kind, members: usize, fused: bool) {
    let mut random = Random(20);
    let (mut compared, mut tried) = (0, 0);
    for exponent in [-T::UNITS, -8, 8, T::UNITS] {
        let factor = 2f64.powi(exponent);
        for _ in 0..members {
            let member = kind.drawn(&mut random);
            let text = computed_in::<T>(&member.text, fused);
            tried += 8;
            let Some(linkage) = compile_if_it_closes(&text) else { continue };
            for drive in member.drives(&mut random, 4) {
                let plain = at_nearest::<T>(drive, &member.loads);
                let scaled = plain.loads.iter().map(|load| load.map(|x| x * factor)).collect();
                let scaled = Arguments { loads: scaled, ..plain.clone() };
                for name in ["all", "work"] {
                    let [found, others] = [&plain, &scaled].map(|arguments| scene::<T>(&linkage, name, arguments));
                    assert_eq!(found.is_ok(), others.is_ok(), "with 2^{exponent} at {drive:?}\n{text}");
                    let (Ok(found), Ok(others)) = (found, others) else { continue };
                    compared += 1;
                    for (path, value) in found {
                        let factor = if path.ends_with(".velocity") { 1.0 } else { factor };
                        let [expected, other] = [value.to_f64() * factor, others[&path].to_f64()].map(f64::to_bits);
                        assert_eq!(expected, other, "{path} with 2^{exponent} at {drive:?}\n{text}");
                    }
                }
            }
        }
    }
    assert_compared(kind, "in other units of force", compared, tried);
}

/// 11: at the end of a motion and beyond it, and where a determinant changes its sign: a typed error, or a number that keeps to the bars.
/// Members are drawn until as many as are asked for have such poses.
fn ends(kind: &Kind, members: usize) {
    let mut random = Random(17);
    let mut looked_at = 0;
    let most = if kind.has_ends() { 20 * members } else { members };
    for _ in 0..most {
        let member = kind.drawn(&mut random);
        // Poses are found in doubles, whatever the scalar, and in plain arithmetic.
        let Some(doubles) = compile_if_it_closes(&member.text) else { continue };
        let found = singular(&doubles, kind.widely(&member), 40);
        for fused in [false, true] {
            ends_of::<Double>(kind, &member, &doubles, &found, fused);
            ends_of::<Single>(kind, &member, &doubles, &found, fused);
        }
        looked_at += usize::from(!found.is_empty());
        if looked_at == members {
            break;
        }
    }
    assert_eq!(looked_at, if kind.has_ends() { members } else { 0 }, "{}", kind.name);
}

/// At these ends of a member.
fn ends_of<T: Scalar>(kind: &Kind, member: &Member, doubles: &Linkage, found: &[Singular], fused: bool) {
    let text = computed_in::<T>(&member.text, fused);
    let Some(linkage) = compile_if_it_closes(&text) else { return };
    for found in found {
        let sense = (found.outside - found.inside).signum();
        let step = |x: &T| Some(if sense > 0.0 { x.next_up() } else { x.next_down() });
        let steps = core::iter::successors(Some(T::exactly(found.inside)), step).map(|x| x.to_f64()).take(5);
        let near = steps.chain([5.0, 5e3].map(|by| found.outside + sense * by * T::EPSILON));
        for drive in near {
            let arguments = at_nearest::<T>(drive, &member.loads);
            for name in ["all", "work"] {
                match scene::<T>(&linkage, name, &arguments) {
                    Ok(values) => assert!(values.values().all(|value| value.to_f64().is_finite())),
                    Err(fault) => assert!(matches!(fault, Fault::Failed(_)), "{fault:?} at {drive:?}\n{text}"),
                }
            }
            if at_its_dead_centre::<T>(&linkage, &arguments) {
                at_a_dead_centre::<T>(kind, &linkage, &arguments, member.longest);
                continue;
            }
            if let Ok(measures) = measure::<T>(&linkage, &arguments, member.longest, T::EPSILON) {
                let beyond = Measures { torque: 0.0, ..measures };
                assert!(share(&beyond).0 <= 1.0, "{measures:?} at {drive:?}\n{text}");
            }
        }
        let beyond = at_nearest::<T>(found.outside + sense * 0.01, &member.loads);
        if found.ends && equations(doubles, &beyond).is_none() {
            for name in ["all", "work"] {
                let Err(fault) = scene::<T>(&linkage, name, &beyond) else {
                    // Of a cascade without the dyad that cannot be assembled, if no load reaches that.
                    assert!(kind.is_cascade(), "{name}: nothing to solve\n{text}");
                    continue;
                };
                let typed = matches!(
                    fault,
                    Fault::Failed(
                        Failure::CannotAssemble { .. }
                            | Failure::NoConvergence { .. }
                            | Failure::CoincidentPivots { .. }
                            | Failure::DeadCentre { .. }
                    )
                );
                assert!(typed, "{name}: {fault:?}\n{text}");
            }
        }
    }
}

/// Where a pivot is zero or there is no pose: no function gives forces. Only of blocks and cascades some may: no load may reach the group that
/// has none, and then forces from the pose keep to their bars, while that group's directions are those that are nearest to closing; and functions
/// straight from the drives, which round what is placed before otherwise, may have a pivot of an epsilon where the pose's is zero, or the last
/// pose where `Pose::at` is beyond it. A pose of theirs to hold those to is not kept, and the one that is may be off by the root of an epsilon
/// there.
fn at_a_dead_centre<T: Scalar>(kind: &Kind, linkage: &Linkage, arguments: &Arguments, longest: f64) {
    let context = || format!("{} in {} at {:?}", kind.name, T::NAME, arguments.drives);
    if !kind.is_by_places() {
        let answered = ["all", "work"].into_iter().find(|name| scene::<T>(linkage, name, arguments).is_ok());
        assert!(answered.is_none(), "{answered:?} of {}", context());
    }
    if let Ok(measures) = measure::<T>(linkage, arguments, longest, T::EPSILON) {
        let forces = Measures { unit: 0.0, closure: 0.0, torque: 0.0, ..measures };
        assert!(share(&forces).0 <= 1.0, "{measures:?}, {}", context());
    }
}

/// 11: NaN and infinity in every argument of every function: a typed error, never a number.
fn not_finite<T: Scalar>(kind: &Kind, members: usize, fused: bool) {
    let mut random = Random(18);
    let mut looked_at = 0;
    for _ in 0..members {
        let member = kind.drawn(&mut random);
        let mut text = computed_in::<T>(&member.text, fused);
        for scene in ["scene parts: superposition;", "scene whole: position;"] {
            if !text.contains(scene) {
                text += scene;
            }
        }
        let Some(linkage) = compile_if_it_closes(&text) else { continue };
        let at = |drive: f64, loads: &[[f64; 2]]| at(single(drive), loads);
        let Some(drive) = member.drives(&mut random, 20).into_iter().find(|drive| {
            let regular = |name| scene::<T>(&linkage, name, &at(*drive, &member.loads)).is_ok();
            ["all", "parts", "work", "whole"].into_iter().all(regular)
        }) else {
            continue;
        };
        looked_at += 1;
        let good = at(drive, &member.loads);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for name in ["all", "parts", "work", "whole"] {
                let arguments = at(bad, &member.loads);
                let found = scene::<T>(&linkage, name, &arguments).err();
                assert_eq!(found, Some(Fault::NotFinite), "{name}\n{text}");
                for (load, part) in (0..member.loads.len()).flat_map(|load| [(load, 0), (load, 1)]) {
                    let mut arguments = good.clone();
                    arguments.loads[load][part] = bad;
                    let found = scene::<T>(&linkage, name, &arguments).err();
                    // Places do not depend on loads: they pass untouched.
                    let expected = (name != "whole").then_some(Fault::NotFinite);
                    assert_eq!(found, expected, "{name} with {bad} in load {load}\n{text}");
                }
            }
        }
        // Loads that are finite, and results that are not.
        let huge = nearest::<T>(T::MAX / 3.0);
        let huge = at(drive, &[[huge, huge], [-huge, huge]]);
        for name in ["all", "parts", "work"] {
            match scene::<T>(&linkage, name, &huge) {
                Err(fault) => assert_eq!(fault, Fault::NotFinite),
                Ok(values) => assert!(values.values().all(|value| value.to_f64().is_finite())),
            }
        }
    }
    assert_compared(kind, "not finite", looked_at, members);
}

/// One kind: in the reduced size, and at length.
macro_rules! kinds {
    ($($(#[$ignored:meta])? $name:ident: $index:literal, $random:literal;)*) => {
        mod reduced {$(
            #[test]
            $(#[$ignored])?
            fn $name() {
                let kind = &super::KINDS[$index];
                super::all(kind, super::Size::reduced(kind));
            }
        )*}
        mod long {$(
            #[test]
            #[ignore = "long"]
            fn $name() {
                super::all(&super::KINDS[$index], super::Size::full($random));
            }
        )*}
    };
}

fn each_by_itself<T: Scalar>(kind: &Kind, members: usize, fused: bool) {
    moved::<T>(kind, members.div_ceil(5), fused);
    datum_moved::<T>(kind, members.div_ceil(5), fused);
    in_other_units::<T>(kind, members.div_ceil(5), fused);
    in_other_units_of_force::<T>(kind, members.div_ceil(5), fused);
    not_finite::<T>(kind, members.div_ceil(5), fused);
}

fn all(kind: &Kind, size: Size) {
    ends(kind, size.members);
    for size in [size, size.fused()] {
        each_by_itself::<Double>(kind, size.members, size.fused);
        each_by_itself::<Single>(kind, size.members, size.fused);
        run(kind, size);
    }
}

kinds! {
    four_bars: 0, 1_000_000;
    #[ignore = "long"]
    welded_four_bars: 1, 10_000;
    slider_cranks: 2, 1_000_000;
    #[ignore = "long"]
    oscillating_blocks: 3, 10_000;
    #[ignore = "long"]
    booms: 4, 10_000;
    tangent_mechanisms: 5, 10_000;
    scotch_yokes: 6, 10_000;
    #[ignore = "long"]
    levers_with_slots: 7, 10_000;
    links_in_slots: 8, 10_000;
    yokes_with_slots: 9, 10_000;
    planets: 10, 10_000;
    #[ignore = "long"]
    cascades: 11, 10_000;
    #[ignore = "long"]
    triads: 12, 10_000;
    #[ignore = "long"]
    triads_with_sliders: 13, 10_000;
    #[ignore = "long"]
    class_four: 14, 10_000;
}
