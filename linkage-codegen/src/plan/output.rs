//! Results: trees of named nodes.

use crate::graph::{Expr, NodeId, Vector};

/// What a result is, for its unit and its documentation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// The coordinate of a drive.
    Coordinate,
    /// A place.
    Place,
    /// A direction.
    Direction,
    /// An angle.
    Angle,
    /// The sine of a transmission angle.
    Sine,
    /// A length.
    Length,
    /// A force.
    Force,
    /// A moment.
    Moment,
    /// A term of virtual work of a force.
    ForceTerm,
    /// A term of virtual work of a moment.
    MomentTerm,
    /// A velocity.
    Velocity,
    /// An acceleration.
    Acceleration,
    /// A rate of rotation.
    AngularRate,
    /// An angular acceleration.
    AngularAcceleration,
    /// A plain number.
    Number,
    /// Effort per acceleration of a drive.
    Mass,
}

/// A result.
#[derive(Clone, Debug)]
pub enum Output {
    /// A number.
    Scalar(NodeId, Meaning),
    /// A vector.
    Vector([NodeId; 2], Meaning),
    /// A number for each unknown.
    Column(Vec<NodeId>),
    /// A number for each pair of an unknown and a drive, row by row.
    Matrix(Vec<Vec<NodeId>>),
    /// A force along and across a link.
    Resolved([NodeId; 2]),
    /// A reaction that is more than a vector.
    Reaction {
        /// Its type in the run-time crate.
        ty: &'static str,
        /// The force in ground axes.
        force: [NodeId; 2],
        /// What it has beside the force, each with the name of its field.
        parts: Vec<(&'static str, NodeId)>,
    },
    /// A term of virtual work.
    Term {
        /// Velocity of the load's point along the load, for unit rate.
        velocity: NodeId,
        /// Load times velocity.
        work: NodeId,
        /// Of a force or a moment.
        meaning: Meaning,
    },
    /// All ways to the results, to be compared at run time.
    Verification(Box<Comparison>),
    /// Named results.
    Record(Vec<Field>),
}

/// The unreduced equations at a pose, and their unknowns by every method. Unknowns are in the order of the system's rows.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Coefficients that are not structurally zero: line, column, value.
    pub coefficients: Vec<(usize, usize, NodeId)>,
    /// What the loads exert, a value for each line.
    pub loads: Vec<NodeId>,
    /// Which unknowns are moments.
    pub moments: Vec<bool>,
    /// The unknowns by equilibrium.
    pub equilibrium: Vec<NodeId>,
    /// The unknowns as sums of all contributions.
    pub superposition: Vec<NodeId>,
    /// The efforts by virtual work.
    pub virtual_work: Vec<NodeId>,
}

/// A named result.
#[derive(Clone, Debug)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// What it is, in a sentence.
    pub doc: String,
    /// The result.
    pub value: Output,
}

impl Field {
    /// A result with its name and what it is.
    #[must_use]
    pub fn new(name: &str, doc: String, value: Output) -> Self {
        Self { name: name.to_owned(), doc, value }
    }
}

impl Output {
    /// A number.
    #[must_use]
    pub fn scalar(value: Expr<'_>, meaning: Meaning) -> Self {
        Self::Scalar(value.id(), meaning)
    }

    /// A vector.
    #[must_use]
    pub fn vector(value: Vector<'_>, meaning: Meaning) -> Self {
        Self::Vector([value.x.id(), value.y.id()], meaning)
    }

    /// The same tree of other nodes, and of other words.
    #[must_use]
    pub fn mapped(&self, node: &mut dyn FnMut(NodeId) -> NodeId, doc: &dyn Fn(&str) -> String) -> Self {
        match self {
            Self::Scalar(value, meaning) => Self::Scalar(node(*value), *meaning),
            Self::Vector(parts, meaning) => Self::Vector(parts.map(&mut *node), *meaning),
            Self::Column(values) => Self::Column(values.iter().map(|value| node(*value)).collect()),
            Self::Matrix(rows) => {
                Self::Matrix(rows.iter().map(|row| row.iter().map(|value| node(*value)).collect()).collect())
            }
            Self::Resolved(parts) => Self::Resolved(parts.map(&mut *node)),
            Self::Reaction { ty, force, parts } => Self::Reaction {
                ty,
                force: force.map(&mut *node),
                parts: parts.iter().map(|(part, value)| (*part, node(*value))).collect(),
            },
            Self::Term { velocity, work, meaning } => {
                Self::Term { velocity: node(*velocity), work: node(*work), meaning: *meaning }
            }
            // How far methods disagree is nothing that has a derivative; no scene asks for it.
            Self::Verification(comparison) => Self::Verification(comparison.clone()),
            Self::Record(fields) => {
                let fields = fields.iter().map(|field| Field {
                    name: field.name.clone(),
                    doc: doc(&field.doc),
                    value: field.value.mapped(node, doc),
                });
                Self::Record(fields.collect())
            }
        }
    }

    /// All its numbers, each with its path: `B.x`.
    #[must_use]
    pub fn leaves(&self) -> Vec<(String, NodeId)> {
        let mut all = Vec::new();
        self.collect("", &mut all);
        all
    }

    fn collect(&self, path: &str, all: &mut Vec<(String, NodeId)>) {
        let mut leaf = |part: &str, node: NodeId| {
            let separator = if path.is_empty() || part.is_empty() { "" } else { "." };
            all.push((format!("{path}{separator}{part}"), node));
        };
        match self {
            Self::Scalar(node, _) => leaf("", *node),
            Self::Vector([x, y], _) => {
                leaf("x", *x);
                leaf("y", *y);
            }
            Self::Column(values) => {
                values.iter().enumerate().for_each(|(row, node)| leaf(&format!("{}", row + 1), *node));
            }
            Self::Matrix(rows) => {
                // Column by column, as the type of the result has them.
                for column in 0..rows.len() {
                    let entries = rows.iter().enumerate().filter_map(|(row, values)| Some((row, values.get(column)?)));
                    entries.for_each(|(row, node)| leaf(&format!("{}.{}", row + 1, column + 1), *node));
                }
            }
            Self::Resolved([axial, transverse]) => {
                leaf("axial", *axial);
                leaf("transverse", *transverse);
            }
            Self::Reaction { force: [x, y], parts, .. } => {
                leaf("force.x", *x);
                leaf("force.y", *y);
                parts.iter().for_each(|(part, node)| leaf(part, *node));
            }
            Self::Term { velocity, work, .. } => {
                leaf("velocity", *velocity);
                leaf("work", *work);
            }
            Self::Verification(comparison) => {
                let coefficients = comparison.coefficients.iter().map(|(.., node)| node);
                let lists =
                    [&comparison.loads, &comparison.equilibrium, &comparison.superposition, &comparison.virtual_work];
                coefficients.chain(lists.into_iter().flatten()).for_each(|node| leaf("", *node));
            }
            Self::Record(fields) => {
                for field in fields {
                    let separator = if path.is_empty() { "" } else { "." };
                    field.value.collect(&format!("{path}{separator}{}", field.name), all);
                }
            }
        }
    }
}
