//! [`Ast`] in, [`Model`] out. Afterwards every name is resolved, every value has its dimension and stands in the units of the
//! generated functions, and every item is sound by itself; what only the whole linkage can tell comes later.

mod evaluate;
mod generated;
pub mod ids;
pub(crate) mod inverses;
mod joints;
mod links;
mod loads;
mod motion;
mod names;
mod options;
mod scenes;
mod turns;
pub use scenes::type_name;
pub(crate) use values::{OWN_CONSTANTS, OWN_PATTERNS, PLACE, SWEPT, arm_name, reciprocal_name};
mod sweeps;
pub mod units;
mod values;

use proc_macro2::TokenStream;

use crate::diagnostics::{Diagnostic, Place, Sink};
use crate::graph::{Expr, Graph, NodeId, Order, Scalar, Symbol, Vector};
use crate::syntax::ast::{Ast, Name};
use ids::{ClosureId, DriveId, GROUND, JointId, LinkId, LoadId, ParamId, PointId, UnknownId};
pub use inverses::{Coordinate, Exchanged, Inverse};
pub use sweeps::Sweep;
use units::{Kind, Units};

/// A pair of nodes: a point or a direction.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// Abscissa.
    pub x: NodeId,
    /// Ordinate.
    pub y: NodeId,
}

impl Pair {
    /// As a vector of expressions.
    #[must_use]
    pub fn vector(self, graph: &Graph) -> Vector<'_> {
        Vector::new(graph.expr(self.x), graph.expr(self.y))
    }
}

impl From<Vector<'_>> for Pair {
    fn from(vector: Vector<'_>) -> Self {
        Self { x: vector.x.id(), y: vector.y.id() }
    }
}

/// A linkage whose names and values are known.
#[derive(Debug)]
pub struct Model {
    /// Name of the module.
    pub name: Name,
    /// Its attributes.
    pub attributes: TokenStream,
    /// Its visibility.
    pub visibility: TokenStream,
    /// The units of the generated functions.
    pub units: Units,
    /// Path of the run-time crate.
    pub runtime: Option<TokenStream>,
    /// Whether the module is to hold its own source.
    pub emit_source: bool,
    /// All expressions.
    pub graph: Graph,
    /// Run-time dimensions.
    pub params: Vec<Param>,
    /// The links, the ground first.
    pub links: Vec<Link>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The drives.
    pub drives: Vec<Drive>,
    /// What balances.
    pub unknowns: Vec<Unknown>,
    /// Chosen closures.
    pub closures: Vec<Closure>,
    /// Where links start that are placed by iteration.
    pub starts: Vec<Start>,
    /// The loads.
    pub loads: Vec<Load>,
    /// What is wanted.
    pub scenes: Vec<Scene>,
    /// Which scenes are solved at many positions.
    pub sweeps: Vec<Sweep>,
    /// Which scenes give the drives for a wanted motion.
    pub inverses: Vec<Inverse>,
    /// Of a linkage whose wanted coordinates are its drives: what its drives were.
    pub exchanged: Option<Exchanged>,
}

/// A run-time dimension.
#[derive(Debug)]
pub struct Param {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub kind: Kind,
    /// Its default, a constant in the units of the generated functions.
    pub default: Option<NodeId>,
}

/// A rigid body.
#[derive(Debug)]
pub struct Link {
    /// Its name; `ground` for the fixed link.
    pub name: Name,
    /// Its points.
    pub points: Vec<Point>,
    /// Distances between points that were given as such.
    pub distances: Vec<(PointId, PointId, NodeId)>,
    /// Its masses taken together.
    pub mass: Option<Mass>,
    /// Whether some of its points could not be read. Never in a sound declaration.
    pub unread: bool,
}

impl Link {
    /// That it has no point of this name, where it may be asked for these other things.
    fn without_point<const N: usize>(&self, point: &Name, others: [&'static str; N]) -> Diagnostic {
        let found = Diagnostic::new(point.place(), format!("the link `{}` has no point `{point}`", self.name));
        match self.points.as_slice() {
            [] => found.help(self.with_point("that one", &point.text)),
            points => found.suggest(&point.text, points.iter().map(|p| p.name.text.as_str()).chain(others)),
        }
    }

    /// How a link that has no point gets one.
    fn with_point(&self, which: &str, point: &str) -> String {
        if self.name.text == "ground" {
            return format!("the ground has no point yet: give it {which}, as in `ground {{ {point}: (0, 0) }}`");
        }
        format!("`{0}` has no point yet: give it {which}, as in `link {0} {{ {point} }}`", self.name)
    }
}

/// A point of a link.
#[derive(Debug)]
pub struct Point {
    /// Its name.
    pub name: Name,
    /// Its coordinates in the link's frame.
    pub at: Pair,
}

/// The mass of a link.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    /// How much.
    pub mass: NodeId,
    /// Its centre in the link's frame.
    pub centroid: Pair,
    /// Its moment of inertia about that centre.
    pub inertia: NodeId,
}

/// A point on a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct End {
    /// The link.
    pub link: LinkId,
    /// Its point.
    pub point: PointId,
}

/// A joint.
#[derive(Debug)]
pub struct Joint {
    /// Its name.
    pub name: Name,
    /// The link that acts.
    pub from: End,
    /// The link that feels: the reaction is what it feels.
    pub to: End,
    /// What it constrains.
    pub kind: JointKind,
}

impl Joint {
    /// The two ends.
    #[must_use]
    pub fn ends(&self) -> [End; 2] {
        [self.from, self.to]
    }

    /// The end on a link.
    #[must_use]
    pub fn end_on(&self, link: LinkId) -> Option<End> {
        self.ends().into_iter().find(|end| end.link == link)
    }

    /// Whether it may have been declared by any point of a line of this link.
    #[must_use]
    pub fn is_line_on(&self, link: LinkId) -> bool {
        match self.kind {
            JointKind::Prismatic { .. } => self.end_on(link).is_some(),
            JointKind::Slot { carrier, .. } => carrier == link,
            JointKind::Revolute | JointKind::Weld { .. } | JointKind::Gear(_) => false,
        }
    }

    /// Its point on a link, but for one that may be declared anywhere on a line.
    #[must_use]
    pub fn pin_on(&self, link: LinkId) -> Option<End> {
        self.end_on(link).filter(|_| !self.is_line_on(link))
    }

    /// Where the joint is: of a slide its runner, the point on the line that the other link carries, of a slot its pin, of a gear pair
    /// the second centre. The couple of the reaction is about this point.
    #[must_use]
    pub fn place(&self) -> End {
        match self.kind {
            JointKind::Prismatic { carrier, .. } | JointKind::Slot { carrier, .. } if carrier == self.to.link => {
                self.from
            }
            _ => self.to,
        }
    }

    /// What the pivots of a dyad may be called whose inner joint it is.
    #[must_use]
    pub fn pivot_names(&self) -> Vec<String> {
        let sine = format!("sin_mu_{}", self.name);
        if self.kind.line().is_some() { vec![sine, format!("reach_{}", self.name)] } else { vec![sine] }
    }

    /// What a pose may be asked of it beside its place.
    #[must_use]
    pub fn asked_names(&self) -> Vec<String> {
        let travel = self.kind.line().map(|_| format!("travel_{}", self.name));
        self.pivot_names().into_iter().chain(travel).collect()
    }

    /// The end that is not on a link.
    #[must_use]
    pub fn end_off(&self, link: LinkId) -> Option<End> {
        if self.from.link == link { Some(self.to) } else { (self.to.link == link).then_some(self.from) }
    }
}

/// What a joint constrains.
#[derive(Clone, Copy, Debug)]
pub enum JointKind {
    /// The two points coincide.
    Revolute,
    /// The second point lies on the line through the first along the axis; the angle between the links is fixed.
    Prismatic {
        /// The link in whose frame the axis is given: one of the two.
        carrier: LinkId,
        /// The axis, a direction in the carrier's frame.
        axis: Pair,
        /// Angle of the second link minus angle of the first, a direction.
        turn: Pair,
        /// The same as an angle.
        angle: NodeId,
    },
    /// The two points coincide; the angle between the links is fixed.
    Weld {
        /// Angle of the second link minus angle of the first, a direction.
        turn: Pair,
        /// The same as an angle.
        angle: NodeId,
    },
    /// The point of one link, a pin, lies on a line of the other.
    Slot {
        /// The link that has the slot.
        carrier: LinkId,
        /// Its direction in that link's frame.
        axis: Pair,
    },
    /// The links are wheels about the two points, and roll on each other.
    Gear(Gear),
}

impl JointKind {
    /// Its word.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Revolute => "revolute",
            Self::Prismatic { .. } => "prismatic",
            Self::Weld { .. } => "weld",
            Self::Slot { .. } => "slot",
            Self::Gear(_) => "gear",
        }
    }

    /// What it is called among the field's words.
    #[must_use]
    pub fn noun(&self) -> &'static str {
        match self {
            Self::Revolute => "pin",
            Self::Prismatic { .. } => "slide",
            Self::Weld { .. } => "weld",
            Self::Slot { .. } => "slot",
            Self::Gear(_) => "gear pair",
        }
    }

    /// Of a slide or a slot the line: the link that carries it, and its direction in that link's frame.
    #[must_use]
    pub fn line(&self) -> Option<(LinkId, Pair)> {
        match *self {
            Self::Prismatic { carrier, axis, .. } | Self::Slot { carrier, axis } => Some((carrier, axis)),
            Self::Revolute | Self::Weld { .. } | Self::Gear(_) => None,
        }
    }

    /// Where the links do not turn against each other, the angle of the second minus that of the first: as a direction and as an angle.
    #[must_use]
    pub fn turn(&self) -> Option<(Pair, NodeId)> {
        match *self {
            Self::Prismatic { turn, angle, .. } | Self::Weld { turn, angle } => Some((turn, angle)),
            Self::Revolute | Self::Slot { .. } | Self::Gear(_) => None,
        }
    }
}

/// A gear pair.
#[derive(Clone, Copy, Debug)]
pub struct Gear {
    /// The radii; the second is negative where the first wheel is a ring.
    pub radii: [NodeId; 2],
    /// `r₁ (θ₁ − ψ) + r₂ (θ₂ − ψ)`, with ψ the direction from the first centre to the second.
    pub phase: NodeId,
    /// The tangent of the pressure angle, negative on the right flank.
    pub incline: NodeId,
    /// The centres on the link that keeps their distance, the first and the second.
    pub arm: [End; 2],
}

impl Gear {
    /// The distance of the centres.
    #[must_use]
    pub fn distance<'m>(&self, model: &'m Model) -> Expr<'m> {
        let [first, second] = self.arm;
        model.distance(first.link, first.point, second.point)
    }

    /// The direction from the first centre to the second, in the frame of the arm.
    #[must_use]
    pub fn centres<'m>(&self, model: &'m Model) -> Vector<'m> {
        let ([first, second], distance) = (self.arm, self.distance(model));
        let way = model.local(second) - model.local(first);
        Vector::new(way.x / distance, way.y / distance)
    }

    /// The radii of the circles that touch: in the ratio of the wheels' own, they fill the distance of the centres.
    #[must_use]
    pub fn rolling_radii<'m>(&self, model: &'m Model) -> [Expr<'m>; 2] {
        let [first, second] = self.radii.map(|radius| model.graph.expr(radius));
        [first, second].map(|radius| radius * self.distance(model) / (first + second))
    }
}

/// A known motion.
#[derive(Debug)]
pub struct Drive {
    /// Its name.
    pub name: Name,
    /// The joint whose coordinate it is.
    pub joint: JointId,
    /// Whether that is the angle between its links; otherwise it is the travel along its line.
    pub turns: bool,
    /// The rate at which it changes: declared, or a symbol.
    pub rate: NodeId,
    /// Its acceleration likewise.
    pub acceleration: NodeId,
    /// Its value where links start that are placed by iteration, and where that was declared.
    pub start: Option<(NodeId, Place)>,
}

impl Drive {
    /// What its rate or its acceleration is called where it is given at run time.
    #[must_use]
    pub fn motion_name(&self, order: Order) -> String {
        match order {
            Order::Rate => format!("{}_rate", self.name),
            Order::Acceleration => format!("{}_acceleration", self.name),
        }
    }

    /// The dimension of the rate or the acceleration of a coordinate that is an angle or a travel.
    #[must_use]
    pub fn kind_of(order: Order, turns: bool) -> Kind {
        match (order, turns) {
            (Order::Rate, true) => Kind::AngularRate,
            (Order::Rate, false) => Kind::Velocity,
            (Order::Acceleration, true) => Kind::AngularAcceleration,
            (Order::Acceleration, false) => Kind::Acceleration,
        }
    }

    /// What of its motion is given at run time.
    pub fn given_motion(&self, graph: &Graph) -> impl Iterator<Item = Order> {
        let symbol = |id| matches!(graph.op(id), crate::graph::Op::Symbol(Symbol::Driven(..)));
        let orders = [(Order::Rate, symbol(self.rate)), (Order::Acceleration, symbol(self.acceleration))];
        orders.into_iter().filter(|(_, given)| *given).map(|(order, _)| order)
    }
}

/// Where a link starts that is placed by iteration.
#[derive(Debug)]
pub struct Start {
    /// The link.
    pub link: LinkId,
    /// The origin of its frame, ground axes.
    pub origin: Pair,
    /// The direction of its frame's x axis.
    pub direction: Pair,
    /// The angle of that direction, with all its turns.
    pub angle: NodeId,
    /// Where it was declared.
    pub place: Place,
}

/// What balances the loads.
#[derive(Debug)]
pub struct Unknown {
    /// Its name.
    pub name: String,
    /// Where it was declared.
    pub place: Place,
    /// What it is.
    pub kind: UnknownKind,
}

/// What an unknown is.
#[derive(Clone, Copy, Debug)]
pub enum UnknownKind {
    /// The effort at the joint of a drive.
    Drive(DriveId),
    /// A torque on the second link by the first.
    Torque(LinkId, LinkId),
    /// A force on a point along a direction that is fixed in a link's frame.
    Force {
        /// Where it acts.
        at: End,
        /// Along which direction.
        along: Pair,
        /// In whose frame that is given.
        frame: LinkId,
    },
    /// Opposite forces on two points along the line between them, positive where they push the points apart.
    Thrust([End; 2]),
}

/// A chosen closure of a group.
#[derive(Debug)]
pub struct Closure {
    /// The group's inner joint.
    pub joint: JointId,
    /// On which side it lies.
    pub side: Side,
    /// Of the outer joint, or of the line between the two.
    pub of: Vec<JointId>,
    /// For a motion through folds: the driver's angle at which the side is meant.
    pub smooth_at: Option<NodeId>,
    /// Where it was declared.
    pub place: Place,
    /// Where its side is said.
    pub side_place: Place,
    /// Where its motion is said to be smooth.
    pub smooth_place: Place,
}

impl Closure {
    /// Whether its side is an argument.
    #[must_use]
    pub fn is_given_at_run_time(&self) -> bool {
        self.side == Side::Either
    }

    /// The type of that argument: a side of a line, or one along a slide.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        if self.of.len() == 2 { "Side" } else { "Along" }
    }
}

/// A side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of the line.
    Left,
    /// Right of the line.
    Right,
    /// Further along the slide.
    Ahead,
    /// Less far along the slide.
    Behind,
    /// As an argument says.
    Either,
}

impl Side {
    /// Its word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Ahead => "ahead",
            Self::Behind => "behind",
            Self::Either => "either",
        }
    }
}

/// A load.
#[derive(Debug)]
pub struct Load {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub kind: LoadKind,
    /// Of inertia the links whose it is.
    pub links: Vec<LinkId>,
}

impl Load {
    /// What one of its values is called in the generated functions.
    #[must_use]
    pub fn value_name(&self, value: &str) -> String {
        if value.is_empty() { self.name.text.clone() } else { format!("{}_{value}", self.name) }
    }

    /// The type of what is given of a spring at run time.
    #[must_use]
    pub fn type_name(&self) -> String {
        format!("Loads{}", type_name(&self.name.text))
    }
}

/// What a load is; values that are given at run time are symbols.
#[derive(Clone, Copy, Debug)]
pub enum LoadKind {
    /// A force on a point.
    Force {
        /// Where it acts.
        at: End,
        /// Its components.
        force: Pair,
        /// In whose frame these are given.
        frame: LinkId,
    },
    /// A moment.
    Moment {
        /// On this link.
        on: LinkId,
        /// Reacted by this one.
        from: Option<LinkId>,
        /// How much.
        moment: NodeId,
    },
    /// The weight of every link that has mass.
    Gravity {
        /// The acceleration, ground axes.
        acceleration: Pair,
    },
    /// Opposite forces on two points along the line between them, positive where they push the points apart.
    Thrust {
        /// The points.
        ends: [End; 2],
        /// How much.
        force: NodeId,
    },
    /// A spring between two points: the tension `rate (length − free) + preload`.
    Spring {
        /// The points.
        ends: [End; 2],
        /// Force per length.
        rate: NodeId,
        /// The length without force but for the preload.
        free: NodeId,
        /// The tension at that length.
        preload: NodeId,
        /// Force per rate of the length, if it damps.
        damping: Option<NodeId>,
    },
    /// A torsion spring between two links: on the second `−rate (angle − free)`, with its angle from the first.
    Torsion {
        /// It is reacted by this link.
        from: LinkId,
        /// It acts on this link.
        on: LinkId,
        /// Moment per angle.
        rate: NodeId,
        /// The angle without moment.
        free: NodeId,
        /// Which turn is meant, if that is said: near to which angle the second link stands while the drives are zero.
        near: Option<NodeId>,
        /// Moment per rate of the angle, if it damps.
        damping: Option<NodeId>,
    },
    /// D'Alembert's forces and couples of links that have mass.
    Inertia,
}

/// What is wanted.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Its name.
    pub name: Name,
    /// How it is solved.
    pub method: Method,
    /// With which loads.
    pub loads: Vec<LoadId>,
    /// For which results.
    pub results: Vec<Wanted>,
    /// Of a scene of derivatives, of what and by what.
    pub derivative: Option<Derivative>,
    /// Results that were asked for in vain, and what they are like. None in a sound declaration.
    pub refused: Vec<(String, Option<Wanted>)>,
}

impl Scene {
    /// Whether powers are among its results: these depend on velocities.
    #[must_use]
    pub fn has_power(&self) -> bool {
        self.results.iter().any(|wanted| matches!(wanted, Wanted::Power(_)))
    }

    /// Whether the motion of what were drives is among its results; their accelerations, or these or rates.
    #[must_use]
    pub fn has_driver_motion(&self, accelerations: bool) -> bool {
        self.results.iter().any(|wanted| match wanted {
            Wanted::Driver(_, Some(order)) => !accelerations || *order == Order::Acceleration,
            _ => false,
        })
    }
}

/// What a scene of derivatives differentiates.
#[derive(Clone, Debug)]
pub struct Derivative {
    /// The scene whose results are differentiated, by its place in the list of scenes.
    pub of: usize,
    /// By what.
    pub by: Vec<Variable>,
    /// By what in vain: what it would be called, and the numbers that it would have. None in a sound declaration.
    pub refused: Vec<(String, Vec<&'static str>)>,
}

/// What results are differentiated by.
#[derive(Clone, Copy, Debug)]
pub struct Variable {
    /// What it is.
    pub by: By,
    /// Where it is asked for.
    pub place: Place,
}

/// A value of run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// The coordinate of a drive.
    Drive(DriveId),
    /// Its rate or its acceleration.
    Driven(DriveId, Order),
    /// All that is given of a load.
    Load(LoadId),
    /// A parameter.
    Parameter(ParamId),
}

/// How a scene is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Where everything is.
    Position,
    /// How fast everything moves.
    Velocity,
    /// How that changes.
    Acceleration,
    /// All loads at once.
    Equilibrium,
    /// Every load by itself.
    Superposition,
    /// By velocities of the loads' points.
    VirtualWork,
    /// The reduced equation of motion.
    Motion,
    /// The derivatives of places and angles by the drives.
    Coefficients,
    /// The drives for a wanted motion.
    Inverse,
    /// All of these against the general solution.
    Verify,
    /// How the results of another scene change.
    Derivative,
}

impl Method {
    /// Whether its results depend on loads. Those of a derivative may, as the results of its scene do.
    #[must_use]
    pub fn has_loads(self) -> bool {
        !matches!(
            self,
            Self::Position
                | Self::Velocity
                | Self::Acceleration
                | Self::Coefficients
                | Self::Inverse
                | Self::Derivative
        )
    }

    /// Whether there is nothing to it without loads.
    #[must_use]
    pub fn needs_loads(self) -> bool {
        self.has_loads() && self != Self::Motion
    }
}

/// A wanted result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// An unknown.
    Unknown(UnknownId),
    /// The reaction of a joint; in a position scene, its place.
    Joint(JointId),
    /// A load's term of virtual work.
    Load(LoadId),
    /// The place of a point.
    Point(End),
    /// The angle of a link.
    Angle(LinkId),
    /// The reaction of a joint along and across the x axis of a link.
    Along(JointId, LinkId),
    /// The couple of a joint about a point.
    About(JointId, End),
    /// The velocity or the acceleration of a joint or a point along and across the x axis of a link, or along and across its path.
    Resolved(Spot, Along),
    /// D'Alembert's force and couple of a link.
    Inertia(LinkId),
    /// Where a single force is equivalent to them.
    Offset(LinkId),
    /// The resultant of all links' inertia, about a point.
    Shaking(End),
    /// The resultant of all that the linkage exerts on the ground, about a point.
    OnGround(End),
    /// The power of an unknown; of all of them.
    Power(Option<UnknownId>),
    /// The mechanical advantage over a load.
    Advantage(LoadId),
    /// Bounds of the rounding errors of all other results.
    ErrorBound,
    /// A part of the equation of motion.
    Part(Part),
    /// Of a linkage that is driven elsewhere: what was a drive, its rate or its acceleration.
    Driver(DriveId, Option<Order>),
}

/// A part of the reduced equation of motion `τ = M q̈ + h`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The efforts for unit accelerations.
    Mass,
    /// The efforts without accelerations.
    Bias,
    /// What of the masses may be nothing but rounding.
    Rounding,
    /// The kinetic energy for unit rates, twice.
    Kinetic,
}

impl Part {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Mass, Self::Bias, Self::Rounding, Self::Kinetic];

    /// How it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Mass => "M",
            Self::Bias => "h",
            Self::Rounding => "rounding",
            Self::Kinetic => "M_kinetic",
        }
    }
}

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// A joint.
    Joint(JointId),
    /// A point of a link.
    Point(End),
}

/// Along what a vector is resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// The x axis of a link.
    Link(LinkId),
    /// The path of the point.
    Path,
}

impl Model {
    /// A link.
    #[must_use]
    pub fn link(&self, id: LinkId) -> &Link {
        &self.links[id.index()]
    }

    /// A joint.
    #[must_use]
    pub fn joint(&self, id: JointId) -> &Joint {
        &self.joints[id.index()]
    }

    /// A load.
    #[must_use]
    pub fn load(&self, id: LoadId) -> &Load {
        &self.loads[id.index()]
    }

    /// Stands for a value that could not be read: of no known size, sign or place.
    pub(crate) fn unread(&self) -> Expr<'_> {
        // Another one each time, so that no two of them cancel.
        self.graph.symbol(Symbol::Dimension(u32::try_from(self.graph.len()).unwrap_or(u32::MAX)))
    }

    /// Stands for a vector that could not be read.
    pub(crate) fn unread_vector(&self) -> Vector<'_> {
        Vector::new(self.unread(), self.unread())
    }

    /// A drive.
    #[must_use]
    pub fn drive(&self, id: DriveId) -> &Drive {
        &self.drives[id.index()]
    }

    /// A parameter.
    #[must_use]
    pub fn param(&self, id: ParamId) -> &Param {
        &self.params[id.index()]
    }

    /// An unknown.
    #[must_use]
    pub fn unknown(&self, id: UnknownId) -> &Unknown {
        &self.unknowns[id.index()]
    }

    /// The links on which an effort acts.
    #[must_use]
    pub fn links_of(&self, effort: UnknownKind) -> Vec<LinkId> {
        match effort {
            UnknownKind::Drive(drive) => self.joint(self.drive(drive).joint).ends().map(|end| end.link).to_vec(),
            UnknownKind::Torque(from, to) => vec![from, to],
            UnknownKind::Force { at, .. } => vec![at.link],
            UnknownKind::Thrust(ends) => ends.map(|end| end.link).to_vec(),
        }
    }

    /// The field of a result. `None` if the declaration is not sound.
    #[must_use]
    pub fn result_name(&self, wanted: Wanted) -> Option<String> {
        let link = |link: LinkId| Some(&self.links.get(link.index())?.name);
        let joint = |joint: JointId| Some(&self.joints.get(joint.index())?.name);
        let point = |end: End| {
            Some(format!(
                "{}_{}",
                link(end.link)?,
                self.links.get(end.link.index())?.points.get(end.point.index())?.name
            ))
        };
        Some(match wanted {
            Wanted::Unknown(unknown) => self.unknowns.get(unknown.index())?.name.clone(),
            Wanted::Joint(id) => joint(id)?.text.clone(),
            Wanted::Load(load) => self.loads.get(load.index())?.name.text.clone(),
            Wanted::Point(end) => point(end)?,
            Wanted::Angle(id) => format!("{}_angle", link(id)?),
            Wanted::Along(id, along) => format!("{}_along_{}", joint(id)?, link(along)?),
            Wanted::About(id, end) => format!("{}_about_{}", joint(id)?, point(end)?),
            Wanted::Resolved(spot, along) => {
                let spot = match spot {
                    Spot::Joint(id) => joint(id)?.text.clone(),
                    Spot::Point(end) => point(end)?,
                };
                match along {
                    Along::Link(id) => format!("{spot}_along_{}", link(id)?),
                    Along::Path => format!("{spot}_along_path"),
                }
            }
            Wanted::Inertia(id) => format!("{}_inertia", link(id)?),
            Wanted::Offset(id) => format!("{}_offset", link(id)?),
            Wanted::Shaking(end) => format!("shaking_{}", point(end)?),
            Wanted::OnGround(end) => format!("ground_about_{}", point(end)?),
            Wanted::Power(None) => "power".to_owned(),
            Wanted::Power(Some(unknown)) => format!("{}_power", self.unknowns.get(unknown.index())?.name),
            Wanted::Advantage(load) => format!("{}_advantage", self.loads.get(load.index())?.name),
            Wanted::Part(part) => part.name().to_owned(),
            Wanted::Driver(drive, order) => {
                Self::driver_name(&self.exchanged.as_ref()?.drives.get(drive.index())?.0, order)
            }
            Wanted::ErrorBound => scenes::ERROR_BOUND.to_owned(),
        })
    }

    /// Coordinates of a point in its link's frame; its origin for one that a mistake has left open.
    #[must_use]
    pub fn local(&self, end: End) -> Vector<'_> {
        let point = self.link(end.link).points.get(end.point.index());
        point.map_or_else(|| self.graph.zero_vector(), |point| point.at.vector(&self.graph))
    }

    /// Whether what a velocity is asked of never moves: a point of the ground, or one that a pin or a weld holds to the ground.
    fn is_fixed(&self, spot: Spot) -> bool {
        let to_ground = |joint: &&Joint| {
            matches!(joint.kind, JointKind::Revolute | JointKind::Weld { .. }) && joint.end_on(GROUND).is_some()
        };
        match spot {
            Spot::Point(end) => {
                end.link == GROUND || self.joints.iter().filter(to_ground).any(|joint| joint.ends().contains(&end))
            }
            Spot::Joint(id) => {
                self.joints.get(id.index()).is_some_and(|joint| joint.place().link == GROUND || to_ground(&joint))
            }
        }
    }

    /// Name of a point, as `crank.A`.
    #[must_use]
    pub fn end_name(&self, end: End) -> String {
        format!("{}.{}", self.link(end.link).name, self.point_name(end))
    }

    /// Name of a point alone.
    #[must_use]
    pub fn point_name(&self, end: End) -> &str {
        self.link(end.link).points.get(end.point.index()).map_or("?", |point| &point.name.text)
    }

    /// Distance of two points of a link: as declared, if it was declared as such.
    #[must_use]
    pub fn distance(&self, link: LinkId, a: PointId, b: PointId) -> Expr<'_> {
        let declared = self.link(link).distances.iter().find(|(p, q, _)| (*p, *q) == (a, b) || (*p, *q) == (b, a));
        match declared {
            Some((.., distance)) => self.graph.expr(*distance),
            None => (self.local(End { link, point: b }) - self.local(End { link, point: a })).size(),
        }
    }

    /// Whether anything is asked for that depends on velocities.
    #[must_use]
    pub fn moves(&self) -> bool {
        let moving = |scene: &Scene| {
            matches!(scene.method, Method::Velocity | Method::Motion)
                || scene.has_power()
                || scene.has_driver_motion(false)
        };
        self.accelerates()
            || self.scenes.iter().any(moving)
            || self.loads.iter().any(|load| load.kind.depends_on_motion())
    }

    /// Whether the results of a scene depend on velocities.
    #[must_use]
    pub fn scene_moves(&self, scene: &Scene) -> bool {
        let load = |load: &LoadId| self.loads.get(load.index()).is_some_and(|load| load.kind.depends_on_motion());
        let differentiated = scene.derivative.as_ref().and_then(|derivative| self.scenes.get(derivative.of));
        matches!(scene.method, Method::Velocity | Method::Acceleration | Method::Motion)
            || scene.has_power()
            || scene.has_driver_motion(false)
            || scene.loads.iter().any(load)
            || differentiated
                .is_some_and(|scene| matches!(scene.method, Method::Velocity | Method::Acceleration | Method::Motion))
    }

    /// Whether the results of a scene depend on accelerations.
    #[must_use]
    pub fn scene_accelerates(&self, scene: &Scene) -> bool {
        let inertia = |load: &LoadId| self.loads.get(load.index()).map(|load| &load.kind);
        let differentiated = scene.derivative.as_ref().and_then(|derivative| self.scenes.get(derivative.of));
        // In the equation of motion, accelerations of the drives are what is looked for.
        let reduced = |scene: &Scene| scene.method == Method::Motion;
        scene.method == Method::Acceleration
            || scene.has_driver_motion(true)
            || differentiated.is_some_and(|scene| scene.method == Method::Acceleration)
            || !reduced(scene)
                && !differentiated.is_some_and(reduced)
                && scene.loads.iter().filter_map(inertia).any(|kind| matches!(kind, LoadKind::Inertia))
    }

    /// Whether there are wheels, to which all turns of an angle count.
    #[must_use]
    pub fn has_gears(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.kind, JointKind::Gear(_)))
    }

    /// Whether any result is a resultant of forces.
    #[must_use]
    pub fn has_wrenches(&self) -> bool {
        let resultant = |wanted: &Wanted| matches!(wanted, Wanted::Shaking(_) | Wanted::OnGround(_));
        self.scenes.iter().any(|scene| scene.results.iter().any(resultant))
    }

    /// Whether anything is asked for that depends on accelerations.
    #[must_use]
    pub fn accelerates(&self) -> bool {
        self.scenes.iter().any(|scene| scene.method == Method::Acceleration || scene.has_driver_motion(true))
            || self.loads.iter().any(|load| matches!(load.kind, LoadKind::Inertia))
    }

    /// Whether equations of motion have matrices, because there are several drives. What stands in for a declaration that has errors may have none.
    #[must_use]
    pub fn has_matrices(&self) -> bool {
        self.unknowns.len() != 1 && self.scenes.iter().any(|scene| scene.method == Method::Motion)
    }

    /// The links whose masses count in the equation of motion: those of its loads `inertia`, as often as these name them; all that have
    /// mass, if it has no such load.
    #[must_use]
    pub fn moved_masses(&self, scene: &Scene) -> Vec<LinkId> {
        let inertia =
            scene.loads.iter().map(|load| self.load(*load)).filter(|load| matches!(load.kind, LoadKind::Inertia));
        let named: Vec<&Load> = inertia.collect();
        let links: Vec<LinkId> = if named.is_empty() {
            self.moving_links().collect()
        } else {
            named.into_iter().flat_map(|load| load.links.iter().copied()).collect()
        };
        links.into_iter().filter(|link| self.link(*link).mass.is_some()).collect()
    }

    /// All links but the ground.
    pub fn moving_links(&self) -> impl Iterator<Item = LinkId> + use<> {
        (1..self.links.len()).map(LinkId::new)
    }

    /// A closure.
    #[must_use]
    pub fn closure(&self, id: ClosureId) -> &Closure {
        &self.closures[id.index()]
    }

    /// The closures that fit a group with this inner joint between these outer ones.
    pub fn fitting_closures<'a>(
        &'a self,
        inner: JointId,
        outer: &'a [JointId],
    ) -> impl Iterator<Item = ClosureId> + 'a {
        let own = move |joint: &JointId| *joint == inner || outer.contains(joint);
        // Where a linkage is driven otherwise, what is said of a joint and a slide of the declaration's groups is said of no other slide.
        let sides = self.exchanged.as_ref().map_or(&[][..], |exchanged| &exchanged.closures);
        let along = move |id: ClosureId| sides.iter().find(|side| side.closure == id).and_then(|side| side.along);
        // Nor is what is said of a slot, where it is driven along itself: it is a pin then.
        let is_pin = move |[slot, joint]: [JointId; 2]| slot == joint && self.drive_of(slot, false).is_some();
        let fits = move |id: &ClosureId| {
            let closure = self.closure(*id);
            let named = closure.joint == inner && closure.of.iter().all(|of| outer.contains(of));
            named && along(*id).is_none_or(|joints| joints.iter().all(own) && !is_pin(joints))
        };
        (0..self.closures.len()).map(ClosureId::new).filter(fits)
    }

    /// The closure that is declared for a group with this inner joint; if none fits, one of that joint, which is wrong.
    #[must_use]
    pub fn closure_at(&self, inner: JointId, outer: &[JointId]) -> Option<ClosureId> {
        let of_joint = || self.closures.iter().position(|closure| closure.joint == inner).map(ClosureId::new);
        let wrong = || of_joint().filter(|_| self.exchanged.is_none());
        self.fitting_closures(inner, outer).next().or_else(wrong)
    }

    /// The closures whose sides are arguments, each with its place in the list.
    pub fn given_closures(&self) -> impl Iterator<Item = (ClosureId, &Closure)> {
        let all = self.closures.iter().enumerate().filter(|(_, closure)| closure.is_given_at_run_time());
        all.map(|(index, closure)| (ClosureId::new(index), closure))
    }

    /// All joints.
    pub fn joint_ids(&self) -> impl Iterator<Item = JointId> + use<> {
        (0..self.joints.len()).map(JointId::new)
    }

    /// The drive of a joint's angle, or of its travel.
    #[must_use]
    pub fn drive_of(&self, joint: JointId, turns: bool) -> Option<DriveId> {
        self.drives.iter().position(|d| d.joint == joint && d.turns == turns).map(DriveId::new)
    }

    /// All drives of a joint: a slot has two coordinates.
    pub fn drives_of(&self, joint: JointId) -> impl Iterator<Item = DriveId> {
        let own = self.drives.iter().enumerate().filter(move |(_, drive)| drive.joint == joint);
        own.map(|(index, _)| DriveId::new(index))
    }

    /// The unknown that is the effort at the drive of a joint's angle, or of its travel.
    #[must_use]
    pub fn effort_of(&self, joint: JointId, turns: bool) -> Option<UnknownId> {
        self.effort_at(self.drive_of(joint, turns)?)
    }

    /// The unknown that is the effort at a drive.
    #[must_use]
    pub fn effort_at(&self, drive: DriveId) -> Option<UnknownId> {
        let effort = |unknown: &Unknown| matches!(unknown.kind, UnknownKind::Drive(own) if own == drive);
        self.unknowns.iter().position(effort).map(UnknownId::new)
    }

    /// Names of links in a row: `coupler + rocker`.
    #[must_use]
    pub fn link_names(&self, links: &[LinkId]) -> String {
        links.iter().map(|l| self.link(*l).name.text.as_str()).collect::<Vec<_>>().join(" + ")
    }
}

/// Resolves a declaration. What is wrong is reported; the model is whole only if nothing was.
pub fn resolve(ast: &Ast, sink: &Sink) -> Model {
    let ast = &names::distinct(ast, sink);
    let mut names = names::Names::collect(ast, sink);
    let options = options::options(ast, sink);
    let mut model = Model {
        name: ast.name.clone(),
        attributes: ast.attributes.clone(),
        visibility: ast.visibility.clone(),
        units: options.units,
        runtime: options.runtime,
        emit_source: options.emit_source,
        graph: Graph::new(options.scalar).with_fused(options.fused),
        params: Vec::new(),
        links: Vec::new(),
        joints: Vec::new(),
        drives: Vec::new(),
        unknowns: Vec::new(),
        closures: Vec::new(),
        starts: Vec::new(),
        loads: Vec::new(),
        scenes: Vec::new(),
        sweeps: Vec::new(),
        inverses: Vec::new(),
        exchanged: None,
    };
    links::params(&mut model, ast, &mut names, sink);
    links::links(&mut model, ast, &names, sink);
    links::masses(&mut model, ast, &names, sink);
    joints::joints(&mut model, ast, &names, sink);
    motion::drives(&mut model, ast, &names, sink);
    motion::unknowns(&mut model, ast, &names, sink);
    motion::closures(&mut model, ast, &names, sink);
    motion::starts(&mut model, ast, &names, sink);
    loads::loads(&mut model, ast, &names, sink);
    scenes::scenes(&mut model, ast, &names, sink);
    if sink.is_clean() {
        check_connected(&model, sink);
    }
    model
}

/// Every link hangs on a joint, and there is something to move.
fn check_connected(model: &Model, sink: &Sink) {
    for id in model.moving_links() {
        if model.joints.iter().all(|j| j.end_on(id).is_none()) {
            let name = &model.link(id).name;
            let found = Diagnostic::new(name.place(), format!("no joint holds the link `{name}`"));
            let point = model.link(id).points.first().map_or("P", |point| point.name.text.as_str());
            sink.report(found.help(format!(
                "join it to another link, as in `revolute {point}: ground -> {name};` with a point `{point}` on both, or leave it out"
            )));
        }
    }
    if model.links.len() <= GROUND.index() + 1 {
        sink.report(
            Diagnostic::new(model.name.place(), "a linkage needs a link besides the ground")
                .help("declare one: `link crank { A0 -> A: 80mm }`"),
        );
    }
}

/// A scalar type's name in `scalar …;`.
fn scalar_of(name: &str) -> Option<Scalar> {
    [Scalar::F64, Scalar::F32].into_iter().find(|s| s.name() == name)
}
