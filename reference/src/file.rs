//! The files: mechanisms and what is known of them, as they are written.
//!
//! A part that is not known here is an error: what a file says and the runner passes over would be another mechanism than the one
//! that the answers belong to.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{IgnoredAny, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::number::{Mode, Number, Raw};

/// A mapping in the order of the file: links are declared in that order, and contributions reported so.
#[derive(Clone, Debug)]
pub(crate) struct Ordered<T>(pub(crate) Vec<(String, T)>);

impl<T> Default for Ordered<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> Ordered<T> {
    pub(crate) fn get(&self, name: &str) -> Option<&T> {
        self.0.iter().find_map(|(key, value)| (key == name).then_some(value))
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &T)> {
        self.0.iter().map(|(key, value)| (key.as_str(), value))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Ordered<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
            type Value = Ordered<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a mapping")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Ordered(entries))
            }
        }
        deserializer.deserialize_map(Entries(PhantomData))
    }
}

/// A mechanism with its answers.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct File {
    #[serde(default)]
    pub(crate) number_mode: Mode,
    pub(crate) gravity: Option<[Raw; 2]>,
    #[serde(default = "yes")]
    pub(crate) include_inertia: bool,
    pub(crate) ground: Body,
    pub(crate) links: Ordered<Body>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) inputs: Vec<Input>,
    #[serde(default)]
    pub(crate) loads: Vec<Load>,
    #[serde(default)]
    pub(crate) guess: Ordered<[Raw; 3]>,
    pub(crate) reference: Option<Answers>,
    pub(crate) sweep: Option<Sweep>,
    pub(crate) expect: Option<Expected>,
    // Text for readers.
    #[serde(rename = "name")]
    _name: IgnoredAny,
    #[serde(rename = "description")]
    _description: Option<IgnoredAny>,
    #[serde(rename = "tags")]
    _tags: Option<IgnoredAny>,
    #[serde(rename = "units")]
    _units: Option<IgnoredAny>,
    #[serde(rename = "source")]
    _source: Option<IgnoredAny>,
    #[serde(rename = "published")]
    _published: Option<IgnoredAny>,
}

fn yes() -> bool {
    true
}

/// The ground or a link.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Body {
    #[serde(default)]
    pub(crate) points: Ordered<[Raw; 2]>,
    pub(crate) mass: Option<Raw>,
    pub(crate) centroid: Option<Place>,
    pub(crate) inertia: Option<Raw>,
}

/// A point by its name or its coordinates.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub(crate) enum Place {
    Named(String),
    At([Raw; 2]),
}

/// A point on a link.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct End(pub(crate) String, pub(crate) Place);

/// A joint.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Joint {
    pub(crate) name: String,
    #[serde(rename = "type")]
    pub(crate) kind: JointKind,
    pub(crate) a: End,
    pub(crate) b: End,
    pub(crate) axis: Option<[Raw; 2]>,
    pub(crate) angle: Option<Raw>,
    pub(crate) ra: Option<Raw>,
    pub(crate) rb: Option<Raw>,
    pub(crate) phase: Option<Raw>,
    #[serde(default)]
    pub(crate) internal: bool,
    pub(crate) pressure_angle: Option<Raw>,
    pub(crate) flank: Option<i8>,
}

/// Kinds of joints.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum JointKind {
    Revolute,
    Prismatic,
    PinInSlot,
    Weld,
    Gear,
}

/// A driven joint.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Input {
    pub(crate) joint: String,
    pub(crate) coord: Coordinate,
    pub(crate) value: Raw,
    pub(crate) rate: Option<Raw>,
    pub(crate) acc: Option<Raw>,
    pub(crate) effort: Option<Effort>,
}

/// Which coordinate of a joint is driven.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Coordinate {
    Angle,
    Displacement,
}

/// Where an unknown acts, if not at its driven joint.
#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub(crate) enum Effort {
    Moment { link: String, reaction_link: Option<String> },
    Force { link: String, point: Place, direction: [Raw; 2], frame: Option<String> },
    Axial { a: End, b: End },
}

/// A load.
#[derive(Debug, Deserialize)]
pub(crate) struct Load {
    pub(crate) name: String,
    #[serde(flatten)]
    pub(crate) kind: LoadKind,
}

/// What a load is.
#[derive(Debug, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum LoadKind {
    Force {
        link: String,
        point: Place,
        force: [Raw; 2],
        frame: Option<String>,
    },
    Moment {
        link: String,
        moment: Raw,
        reaction_link: Option<String>,
    },
    Spring {
        a: End,
        b: End,
        stiffness: Option<Raw>,
        free_length: Option<Raw>,
        damping: Option<Raw>,
        preload: Option<Raw>,
    },
    Axial {
        a: End,
        b: End,
        force: Raw,
    },
    TorsionSpring {
        a: String,
        b: String,
        stiffness: Option<Raw>,
        free_angle: Option<Raw>,
        damping: Option<Raw>,
    },
}

/// What is known of a pose; numbers are decimals of many digits.
#[derive(Debug, Deserialize)]
pub(crate) struct Answers {
    pub(crate) pose: Ordered<[String; 3]>,
    pub(crate) efforts: Vec<EffortAnswer>,
    pub(crate) reactions: Ordered<Reaction>,
    /// The places of each link's points, and of its centre of mass.
    #[serde(default)]
    pub(crate) points: Ordered<Ordered<[String; 2]>>,
    #[serde(default)]
    pub(crate) centroid: Ordered<[String; 2]>,
    /// Reactions along and across the x axis of a link.
    #[serde(default)]
    pub(crate) along: Ordered<Resolved>,
    #[serde(default)]
    pub(crate) velocity: Ordered<LinkMotion>,
    #[serde(default)]
    pub(crate) acceleration: Ordered<LinkMotion>,
    #[serde(default)]
    pub(crate) inertia_offset: Ordered<InertiaOffset>,
    #[serde(default)]
    pub(crate) contributions: Ordered<Contribution>,
    pub(crate) virtual_work: Option<VirtualWork>,
    pub(crate) power: Option<Power>,
    pub(crate) shaking: Option<Shaking>,
    pub(crate) reduced: Option<Reduced>,
    pub(crate) f64_floor: Option<Floor>,
    pub(crate) accept: Option<Accept>,
}

/// An effort, by itself or with the joint of its input.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum EffortAnswer {
    Plain(String),
    OfInput { effort: String },
}

impl EffortAnswer {
    pub(crate) fn text(&self) -> &str {
        match self {
            Self::Plain(text) | Self::OfInput { effort: text } => text,
        }
    }
}

/// Velocity or acceleration of a link's frame, of its centre of mass, and of its angle.
#[derive(Debug, Deserialize)]
pub(crate) struct LinkMotion {
    pub(crate) origin: [String; 2],
    pub(crate) centroid: Option<[String; 2]>,
    #[serde(alias = "omega", alias = "alpha")]
    pub(crate) angle: String,
}

/// The line of the single force that is equivalent to a link's inertia.
#[derive(Debug, Deserialize)]
pub(crate) struct InertiaOffset {
    pub(crate) h: String,
    pub(crate) offset: [String; 2],
}

/// What the second link of a joint feels.
#[derive(Debug, Deserialize)]
pub(crate) struct Reaction {
    pub(crate) force: [String; 2],
    pub(crate) moment: Option<String>,
    pub(crate) scalar: Option<String>,
}

/// A reaction along and across the x axis of a link.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Resolved {
    pub(crate) link: String,
    pub(crate) axial: String,
    pub(crate) transverse: String,
}

/// What one load brings.
#[derive(Debug, Deserialize)]
pub(crate) struct Contribution {
    pub(crate) efforts: Vec<String>,
    pub(crate) reactions: Ordered<Reaction>,
}

/// What the efforts put in.
#[derive(Debug, Deserialize)]
pub(crate) struct Power {
    pub(crate) inputs: Vec<String>,
    pub(crate) effort: String,
    /// The same of each load, by which it is measured.
    pub(crate) loads: String,
    pub(crate) kinetic_energy_rate: String,
}

/// The resultant of inertia about the origin of the ground.
#[derive(Debug, Deserialize)]
pub(crate) struct Shaking {
    pub(crate) force: [String; 2],
    pub(crate) moment: String,
}

/// Efforts without the equilibrium equations.
#[derive(Debug, Deserialize)]
pub(crate) struct VirtualWork {
    pub(crate) efforts: Vec<String>,
}

/// The reduced equation of motion: of one input numbers, of several a row for each effort.
#[derive(Debug, Deserialize)]
pub(crate) struct Reduced {
    #[serde(rename = "M", deserialize_with = "matrix")]
    pub(crate) mass: Vec<Vec<String>>,
    #[serde(rename = "h", deserialize_with = "column")]
    pub(crate) bias: Vec<String>,
    #[serde(rename = "M_kinetic", default, deserialize_with = "matrix")]
    pub(crate) kinetic: Vec<Vec<String>>,
}

/// A number, or a list of what is in it.
#[derive(Deserialize)]
#[serde(untagged)]
enum OneOr<T> {
    One(String),
    Several(Vec<T>),
}

fn matrix<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec<String>>, D::Error> {
    Ok(match OneOr::deserialize(deserializer)? {
        OneOr::One(number) => vec![vec![number]],
        OneOr::Several(rows) => rows,
    })
}

fn column<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    Ok(match OneOr::deserialize(deserializer)? {
        OneOr::One(number) => vec![number],
        OneOr::Several(numbers) => numbers,
    })
}

/// How far answers move when the data move by half a unit in the last place.
#[derive(Debug, Deserialize)]
pub(crate) struct Floor {
    pub(crate) effort: Vec<String>,
    pub(crate) reaction_normwise: String,
    pub(crate) pose: String,
}

/// How far a result may be off.
#[derive(Debug, Deserialize)]
pub(crate) struct Accept {
    pub(crate) loose: Limits,
    pub(crate) tight: Option<Limits>,
    pub(crate) effort_scale: Vec<String>,
    pub(crate) reaction_scale: String,
}

/// Relative limits.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Limits {
    #[serde(deserialize_with = "doubles")]
    pub(crate) effort: Vec<f64>,
    #[serde(deserialize_with = "double")]
    pub(crate) reaction: f64,
}

fn double<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let (Raw::Literal(text) | Raw::Expression(text)) = Raw::deserialize(deserializer)?;
    text.parse().map_err(serde::de::Error::custom)
}

fn doubles<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
    let texts = Vec::<Raw>::deserialize(deserializer)?;
    let value = |raw: Raw| {
        let (Raw::Literal(text) | Raw::Expression(text)) = raw;
        text.parse().map_err(serde::de::Error::custom)
    };
    texts.into_iter().map(value).collect()
}

/// One drive through several positions.
#[derive(Debug, Deserialize)]
pub(crate) struct Sweep {
    pub(crate) input: usize,
    pub(crate) results: Vec<Position>,
    #[serde(default)]
    pub(crate) load: Vec<LoadSeries>,
}

/// A position of a sweep.
#[derive(Debug, Deserialize)]
pub(crate) struct Position {
    pub(crate) value: Raw,
    #[serde(flatten)]
    pub(crate) outcome: Outcome,
}

/// What a position gives.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Outcome {
    Error {
        #[serde(rename = "error")]
        _error: String,
    },
    Answers(Box<Answers>),
}

impl Outcome {
    pub(crate) fn answers(&self) -> Option<&Answers> {
        if let Self::Answers(answers) = self { Some(answers) } else { None }
    }
}

/// A load that has another value at each position.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoadSeries {
    pub(crate) name: String,
    pub(crate) field: String,
    pub(crate) values: Vec<Given>,
}

/// A value of a load.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum Given {
    Vector([Raw; 2]),
    Scalar(Raw),
}

/// What must happen to a mechanism without an answer.
#[derive(Debug, Deserialize)]
pub(crate) struct Expected {
    pub(crate) outcome: String,
    pub(crate) stage: String,
}

impl Expected {
    /// The stages at which it may turn out.
    pub(crate) fn stages(&self) -> Result<Vec<&str>, String> {
        if self.outcome != "error" {
            return Err(format!("an outcome `{}` is not known", self.outcome));
        }
        let stages: Vec<&str> = self.stage.split(" or ").collect();
        match stages.iter().find(|stage| !["mobility", "position", "equilibrium"].contains(stage)) {
            Some(unknown) => Err(format!("a stage `{unknown}` is not known")),
            None => Ok(stages),
        }
    }
}

impl File {
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    /// A number of the file, or the double next to it.
    pub(crate) fn value(&self, raw: &Raw) -> Result<f64, String> {
        Number::new(raw, self.number_mode).map(|number| number.value)
    }

    /// A point in the frame of its link.
    pub(crate) fn place(&self, End(link, place): &End) -> Option<[f64; 2]> {
        let body = if link == "ground" { &self.ground } else { self.links.get(link)? };
        let [x, y] = match place {
            Place::Named(name) => body.points.get(name)?,
            Place::At(at) => at,
        };
        Some([self.value(x).ok()?, self.value(y).ok()?])
    }

    /// A link's frame at the guess.
    pub(crate) fn guessed(&self, link: &str) -> Option<[f64; 3]> {
        if link == "ground" {
            return Some([0.0; 3]);
        }
        let [x, y, angle] = self.guess.get(link)?;
        Some([self.value(x).ok()?, self.value(y).ok()?, self.value(angle).ok()?])
    }

    /// The answers, at each position that has some.
    pub(crate) fn answers(&self) -> impl Iterator<Item = &Answers> {
        let swept = self.sweep.iter().flat_map(|sweep| &sweep.results);
        self.reference.iter().chain(swept.filter_map(|position| position.outcome.answers()))
    }
}
