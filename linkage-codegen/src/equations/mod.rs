//! [`Model`] in, [`System`] out: the constraints of the joints and the equilibrium equations of the free bodies, complete and unreduced.
//!
//! A joint is defined by its constraints, a load by its forces; everything else follows by differentiation. With `q` the places and
//! angles of the links and `g(q) = 0` the constraints, the reactions `λ` act along `∂g/∂q` transposed:
//! for every link, `Σ λ ∂g/∂q + Q = 0` with `Q` the loads. These are the `3(l − 1)` equations of the textbooks.

mod bodies;
pub mod joints;
pub mod loads;
pub(crate) mod poses;

pub use bodies::Body;
use joints::{Component, Ends, Shape, Teeth};
use loads::{Action, Case};

use crate::graph::{Coordinate, Expr, Graph, NodeId, Vector};
use crate::model::ids::{DriveId, GROUND, JointId, LinkId, UnknownId};
use crate::model::{Drive, End, JointKind, Model, UnknownKind};
use crate::topology::Topology;

/// The equations of a linkage.
#[derive(Debug)]
pub struct System {
    /// What the joints and unknowns exert, a row for each scalar.
    pub rows: Vec<Row>,
    /// The loads, a case for each that is solved by itself.
    pub cases: Vec<LoadCase>,
}

/// Where a scalar unknown comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A component of a joint's reaction.
    Joint(JointId, Component),
    /// The effort at a driven joint.
    Drive(DriveId),
    /// An unknown effort.
    Unknown(UnknownId),
}

/// A scalar unknown of the equilibrium equations, and, of a joint, the constraint that it upholds.
#[derive(Clone, Debug)]
pub struct Row {
    /// Where it comes from.
    pub source: Source,
    /// The constraint, zero when it holds; an effort has none.
    pub residual: Option<NodeId>,
    /// What its unit exerts on the links.
    pub exerts: Vec<Exerted>,
}

/// Force and moment about the origin of the link's frame.
#[derive(Clone, Copy, Debug)]
pub struct Exerted {
    /// On this link.
    pub on: LinkId,
    /// Force along x.
    pub x: NodeId,
    /// Force along y.
    pub y: NodeId,
    /// Moment.
    pub moment: NodeId,
}

/// A load case and what it exerts.
#[derive(Debug)]
pub struct LoadCase {
    /// Which one.
    pub case: Case,
    /// What it exerts on the links.
    pub exerts: Vec<Exerted>,
}

/// The dimensions of joints: as declared, or standing for any.
pub trait Dimensions<'g> {
    /// A point in its link's frame.
    fn local(&self, end: End) -> Vector<'g>;
    /// What a joint constrains.
    fn shape(&self, joint: JointId) -> Shape<'g>;
}

/// The declared dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Declared<'m>(pub &'m Model);

impl<'m> Dimensions<'m> for Declared<'m> {
    fn local(&self, end: End) -> Vector<'m> {
        self.0.local(end)
    }

    fn shape(&self, joint: JointId) -> Shape<'m> {
        let (model, graph) = (self.0, &self.0.graph);
        match model.joint(joint).kind {
            JointKind::Revolute => Shape::Revolute,
            JointKind::Prismatic { carrier, axis, angle, .. } => Shape::Prismatic {
                carried_by_first: carrier == model.joint(joint).from.link,
                axis: axis.vector(graph),
                angle: graph.expr(angle),
            },
            JointKind::Weld { angle, .. } => Shape::Weld { angle: graph.expr(angle) },
            JointKind::Slot { carrier, axis } => {
                Shape::Slot { carried_by_first: carrier == model.joint(joint).from.link, axis: axis.vector(graph) }
            }
            JointKind::Gear(gear) => Shape::Gear(Teeth {
                radii: gear.radii.map(|radius| graph.expr(radius)),
                phase: graph.expr(gear.phase),
                incline: graph.expr(gear.incline),
                arm: Body::symbolic(graph, gear.arm[0].link),
                centres: gear.centres(model),
                distance: gear.distance(model),
            }),
        }
    }
}

impl System {
    /// The equations of a model, in the symbols of its links' coordinates.
    #[must_use]
    pub fn of(model: &Model, topology: &Topology) -> Self {
        let dimensions = Declared(model);
        let joints = model.joint_ids().flat_map(|joint| joint_rows(model, &model.graph, &dimensions, joint));
        let unknowns =
            (0..model.unknowns.len()).map(|u| unknown_row(model, &model.graph, &dimensions, UnknownId::new(u)));
        let rows = joints.chain(unknowns).collect();
        let bodies = |link| Body::symbolic(&model.graph, link);
        let cases = loads::cases(&loads::Symbolic { model, topology })
            .into_iter()
            .map(|(case, actions)| LoadCase {
                case,
                exerts: actions.iter().map(|a| a.exerted(model, &bodies)).collect(),
            })
            .collect();
        Self { rows, cases }
    }

    /// The rows of a joint.
    pub fn joint(&self, joint: JointId) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| matches!(row.source, Source::Joint(j, _) if j == joint))
    }
}

/// The constraints of a joint and what its reactions exert.
pub fn joint_rows<'g>(model: &Model, graph: &'g Graph, dimensions: &dyn Dimensions<'g>, joint: JointId) -> Vec<Row> {
    let ends = ends(model, graph, dimensions, joint);
    joints::constraints(dimensions.shape(joint), &ends)
        .into_iter()
        .map(|constraint| Row {
            source: Source::Joint(joint, constraint.component),
            residual: Some(constraint.residual.id()),
            exerts: gradient(model, graph, joint, constraint.residual),
        })
        .collect()
}

/// What the unit of an unknown effort exerts.
pub fn unknown_row<'g>(model: &Model, graph: &'g Graph, dimensions: &dyn Dimensions<'g>, unknown: UnknownId) -> Row {
    let source = Source::Unknown(unknown);
    let bodies = |link| Body::symbolic(graph, link);
    let exerts = match model.unknown(unknown).kind {
        UnknownKind::Drive(drive) => drive_row(model, graph, dimensions, drive).exerts,
        UnknownKind::Torque(from, to) => [(from, -1), (to, 1)]
            .into_iter()
            .filter(|(link, _)| *link != GROUND)
            .map(|(on, sign)| Exerted {
                on,
                x: graph.zero().id(),
                y: graph.zero().id(),
                moment: graph.integer(sign).id(),
            })
            .collect(),
        UnknownKind::Force { at, along, frame } => {
            let force = bodies(frame).turned(along_in(model, graph, along));
            vec![loads::exerted_at(at.link, &bodies(at.link), dimensions.local(at), force)]
        }
        UnknownKind::Thrust(ends) => {
            let [first, second] = ends.map(|end| bodies(end.link).point(dimensions.local(end)));
            let name = &model.unknown(unknown).name;
            let span = (second - first).named(&format!("{name}_span"), "");
            let direction = graph.unit(span).named_direction(name, "");
            let forces = ends.into_iter().zip([-direction, direction]).filter(|(end, _)| end.link != GROUND);
            let exerts = |(end, force): (End, Vector<'g>)| {
                loads::exerted_at(end.link, &bodies(end.link), dimensions.local(end), force)
            };
            forces.map(exerts).collect()
        }
    };
    Row { source, residual: None, exerts }
}

/// A declared direction, as constants or parameters of another graph: only its numbers matter there.
fn along_in<'g>(model: &Model, graph: &'g Graph, along: crate::model::Pair) -> Vector<'g> {
    let number = |id| model.graph.constant_value(id).unwrap_or_else(crate::graph::number::Number::one);
    if core::ptr::eq(graph, &raw const model.graph) {
        return along.vector(graph);
    }
    Vector::new(graph.constant(&number(along.x)), graph.constant(&number(along.y)))
}

/// The coordinate of a driven joint, and what a unit of effort there exerts: the coordinate's gradient.
pub fn drive_row<'g>(model: &Model, graph: &'g Graph, dimensions: &dyn Dimensions<'g>, drive: DriveId) -> Row {
    let Drive { joint, turns, .. } = *model.drive(drive);
    let coordinate = joints::coordinate(dimensions.shape(joint), turns, &ends(model, graph, dimensions, joint));
    Row {
        source: Source::Drive(drive),
        residual: Some(coordinate.id()),
        exerts: gradient(model, graph, joint, coordinate),
    }
}

fn ends<'g>(model: &Model, graph: &'g Graph, dimensions: &dyn Dimensions<'g>, joint: JointId) -> Ends<'g> {
    let joint = model.joint(joint);
    Ends {
        first: Body::symbolic(graph, joint.from.link),
        second: Body::symbolic(graph, joint.to.link),
        first_point: dimensions.local(joint.from),
        second_point: dimensions.local(joint.to),
    }
}

fn gradient<'g>(model: &Model, graph: &'g Graph, joint: JointId, of: Expr<'g>) -> Vec<Exerted> {
    let by = |link, coordinate| graph.derivative(of, link, coordinate).id();
    model
        .joint(joint)
        .ends()
        .into_iter()
        .map(|end| end.link)
        .filter(|link| *link != GROUND)
        .map(|on| Exerted { on, x: by(on, Coordinate::X), y: by(on, Coordinate::Y), moment: by(on, Coordinate::Angle) })
        .collect()
}

impl Action {
    /// Force and moment about the origin of the link's frame.
    fn exerted<'m>(&self, model: &'m Model, bodies: &dyn Fn(LinkId) -> Body<'m>) -> Exerted {
        let graph = &model.graph;
        match *self {
            Self::Force { link, at, force, frame } => {
                let force = bodies(frame).turned(force.vector(graph));
                loads::exerted_at(link, &bodies(link), at.vector(graph), force)
            }
            Self::Couple { link, moment } => Exerted { on: link, x: graph.zero().id(), y: graph.zero().id(), moment },
        }
    }
}
