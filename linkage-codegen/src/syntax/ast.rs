//! The declaration as it was written: every construct of the grammar, with its place, unresolved.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;

use crate::diagnostics::Place;

/// A name and where it stands.
#[derive(Clone, Debug)]
pub struct Name {
    /// Its letters, without `r#`.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

impl Name {
    /// From its token.
    pub(super) fn of(ident: &Ident) -> Self {
        Self { text: ident.unraw().to_string(), span: ident.span() }
    }

    /// Whether Rust can write it as a name.
    #[must_use]
    pub fn is_usable(&self) -> bool {
        !matches!(self.text.as_str(), "self" | "Self" | "super" | "crate" | "_")
    }

    /// Where it stands.
    #[must_use]
    pub fn place(&self) -> Place {
        Place::at(self.span)
    }
}

impl core::fmt::Display for Name {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.text)
    }
}

/// A whole declaration.
#[derive(Clone, Debug)]
pub struct Ast {
    /// Attributes of the module, documentation above all.
    pub attributes: TokenStream,
    /// Its visibility.
    pub visibility: TokenStream,
    /// Its name.
    pub name: Name,
    /// What it declares, in the order as written.
    pub items: Vec<Item>,
}

/// One item.
#[derive(Clone, Debug)]
pub enum Item {
    /// `units { mm, N }`
    Units(Vec<Name>),
    /// `scalar f32;`
    Scalar(Name),
    /// `arithmetic fused;`
    Arithmetic(Name),
    /// `crate = path;`
    Crate(TokenStream),
    /// `emit source;`
    Emit(Name),
    /// `param l2: length = 80mm;`
    Param(Param),
    /// `ground { … }` and `link crank { … }`
    Link(Link),
    /// `mass coupler: …;`
    Mass(Mass),
    /// `revolute A: …;` and the other joints
    Joint(Joint),
    /// `drive theta: A0;`
    Drive(Drive),
    /// `assemble B: …;`
    Assemble(Assemble),
    /// `start coupler: …;`
    Start(Start),
    /// `unknown T12: …;`
    Unknown(Unknown),
    /// `load F13: …;`
    Load(Load),
    /// `scene statics: …;`
    Scene(Scene),
    /// An item that could not be read; what it would have named counts as declared.
    Broken(Broken),
}

/// What is known of an item that could not be read.
#[derive(Clone, Debug)]
pub struct Broken {
    /// Its keyword, if it begins with a word.
    pub keyword: Option<Name>,
    /// What it would have named.
    pub name: Option<Name>,
    /// What stands behind these.
    pub rest: TokenStream,
}

impl Broken {
    /// Whether it begins with this word.
    #[must_use]
    pub fn is(&self, keyword: &str) -> bool {
        self.keyword.as_ref().is_some_and(|word| word.text == keyword)
    }

    /// All words behind its name, those in brackets included.
    #[must_use]
    pub fn words(&self) -> Vec<Name> {
        words(self.rest.clone())
    }
}

/// All words of a stretch of tokens, in order.
pub(super) fn words(tokens: TokenStream) -> Vec<Name> {
    let mut found = Vec::new();
    let mut open: Vec<TokenTree> = tokens.into_iter().collect();
    open.reverse();
    while let Some(token) = open.pop() {
        match token {
            TokenTree::Ident(ident) => found.push(Name::of(&ident)),
            TokenTree::Group(group) => {
                let inside: Vec<TokenTree> = group.stream().into_iter().collect();
                open.extend(inside.into_iter().rev());
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    found
}

/// A scalar expression.
#[derive(Clone, Debug)]
pub struct Value {
    /// What it says.
    pub kind: ValueKind,
    /// Where it stands.
    pub place: Place,
    /// How large it is.
    pub(super) extent: Extent,
}

/// How large an expression is. It bounds the recursion and the work of all that is made of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Extent {
    /// Operations within operations.
    pub(super) depth: usize,
    /// All operations, each as often as powers repeat it.
    pub(super) operations: usize,
}

impl Value {
    pub(super) fn new(kind: ValueKind, place: Place) -> Self {
        let extent = kind.extent();
        Self { kind, place, extent }
    }
}

/// As it may be written.
impl core::fmt::Display for Value {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let above =
            |value: &Self, least| if value.kind.binds() > least { format!("{value}") } else { format!("({value})") };
        let term = |value: &Self| above(value, Binding::Sum);
        let factor = |value: &Self| above(value, Binding::Product);
        match &self.kind {
            ValueKind::Number(digits, unit) => write!(f, "{digits}{}", unit.as_deref().unwrap_or_default()),
            ValueKind::Name(name) => f.write_str(name),
            ValueKind::Negative(a) => write!(f, "-{}", factor(a)),
            ValueKind::Sum(a, b) => write!(f, "{a} + {b}"),
            ValueKind::Difference(a, b) => write!(f, "{a} - {}", term(b)),
            ValueKind::Product(a, b) => match (&a.kind, &b.kind) {
                // Behind a literal a power is that of its unit.
                (ValueKind::Number(digits, None), ValueKind::Power(base, exponent)) if base.unit().is_some() => {
                    write!(f, "{digits}{}^{exponent}", base.unit().unwrap_or_default())
                }
                _ => write!(f, "{}*{}", term(a), factor(b)),
            },
            ValueKind::Quotient(a, b) => write!(f, "{}/{}", term(a), factor(b)),
            ValueKind::Power(base, exponent) => match base.unit() {
                Some(unit) => write!(f, "{unit}^{exponent}"),
                None => write!(f, "{}^{exponent}", above(base, Binding::Power)),
            },
            ValueKind::Call(function, args) => {
                let args: Vec<String> = args.iter().map(Self::to_string).collect();
                write!(f, "{function}({})", args.join(", "))
            }
        }
    }
}

impl Value {
    /// The unit that it is, as behind a literal.
    fn unit(&self) -> Option<&str> {
        match &self.kind {
            ValueKind::Number(one, unit) if one == "1" => unit.as_deref(),
            _ => None,
        }
    }
}

/// How firmly an operation holds its operands together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

impl ValueKind {
    fn binds(&self) -> Binding {
        match self {
            Self::Sum(..) | Self::Difference(..) => Binding::Sum,
            Self::Product(..) | Self::Quotient(..) => Binding::Product,
            Self::Negative(_) => Binding::Sign,
            // A power behind a number with a unit is that of the unit.
            Self::Power(..) | Self::Number(_, Some(_)) => Binding::Power,
            Self::Number(..) | Self::Name(_) | Self::Call(..) => Binding::Atom,
        }
    }

    fn extent(&self) -> Extent {
        let above = |inner: &[&Value], times: usize| Extent {
            depth: 1 + inner.iter().map(|value| value.extent.depth).max().unwrap_or(0),
            operations: times.saturating_mul(1 + inner.iter().map(|value| value.extent.operations).sum::<usize>()),
        };
        match self {
            Self::Number(..) | Self::Name(_) => Extent::default(),
            Self::Negative(a) => above(&[a], 1),
            Self::Sum(a, b) | Self::Difference(a, b) | Self::Product(a, b) | Self::Quotient(a, b) => above(&[a, b], 1),
            Self::Power(base, exponent) => above(&[base], usize::try_from(*exponent).unwrap_or(usize::MAX).max(1)),
            Self::Call(_, args) => above(&args.iter().collect::<Vec<_>>(), 1),
        }
    }
}

/// The kinds of scalar expressions.
#[derive(Clone, Debug)]
pub enum ValueKind {
    /// `80mm`: digits and unit.
    Number(String, Option<String>),
    /// `mm`, `pi`, `l2`
    Name(String),
    /// `-a`
    Negative(Box<Value>),
    /// `a + b`
    Sum(Box<Value>, Box<Value>),
    /// `a - b`
    Difference(Box<Value>, Box<Value>),
    /// `a * b`
    Product(Box<Value>, Box<Value>),
    /// `a / b`
    Quotient(Box<Value>, Box<Value>),
    /// `a ^ 2`
    Power(Box<Value>, u32),
    /// `sqrt(a)`
    Call(Name, Vec<Value>),
}

/// A vector.
#[derive(Clone, Debug)]
pub struct VectorValue {
    /// What it says.
    pub kind: VectorKind,
    /// Where it stands.
    pub place: Place,
}

/// As it may be written.
impl core::fmt::Display for VectorValue {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match &self.kind {
            VectorKind::Cartesian(x, y) => write!(f, "({x}, {y})"),
            VectorKind::Polar(size, angle) => write!(f, "{size} @ {angle}"),
        }
    }
}

/// The kinds of vectors.
#[derive(Clone, Debug)]
pub enum VectorKind {
    /// `(x, y)`
    Cartesian(Value, Value),
    /// `size @ angle`
    Polar(Value, Value),
}

/// What may stand behind `=` of a load.
#[derive(Clone, Debug)]
pub enum Magnitude {
    /// A scalar.
    Scalar(Value),
    /// A vector.
    Vector(VectorValue),
}

/// `param NAME: dimension = value;`
#[derive(Clone, Debug)]
pub struct Param {
    /// Its name.
    pub name: Name,
    /// Its dimension, by name.
    pub dimension: Name,
    /// Its default.
    pub default: Option<Value>,
}

/// `ground { … }` or `link NAME { … }`
#[derive(Clone, Debug)]
pub struct Link {
    /// `None` for the ground.
    pub name: Option<Name>,
    /// The keyword.
    pub keyword: Span,
    /// Its points.
    pub places: Vec<PointPlace>,
}

/// An entry of a link's body.
#[derive(Clone, Debug)]
pub enum PointPlace {
    /// `A0 -> A: 80mm`
    Frame(Name, Name, Value),
    /// `P: vector`
    At(Name, VectorValue),
    /// `P: left(A -> B, r1, r2)`; `true` for left
    Distances(Name, Box<Distances>),
    /// `P`, at the origin
    Origin(Name),
    /// A place that could not be read: any of its words may be a point.
    Unread(Vec<Name>),
}

/// By two distances.
#[derive(Clone, Debug)]
pub struct Distances {
    /// On the left of the line.
    pub left: bool,
    /// Start of the line.
    pub from: Name,
    /// End of the line.
    pub to: Name,
    /// Distance from its start.
    pub from_distance: Value,
    /// Distance from its end.
    pub to_distance: Value,
    /// The whole.
    pub place: Place,
}

/// A point by name or by coordinates.
#[derive(Clone, Debug)]
pub enum PointRef {
    /// A named point.
    Named(Name),
    /// Coordinates in the link's frame.
    At(VectorValue),
}

/// `mass LINK: value at P, inertia value;`
#[derive(Clone, Debug)]
pub struct Mass {
    /// Whose.
    pub link: Name,
    /// How much.
    pub mass: Value,
    /// Where.
    pub at: PointRef,
    /// Moment of inertia about that place.
    pub inertia: Option<Value>,
}

/// `LINK` or `LINK.POINT`
#[derive(Clone, Debug)]
pub struct End {
    /// The link.
    pub link: Name,
    /// The point; by default the one of the joint's name.
    pub point: Option<Name>,
}

impl End {
    /// As it was written.
    #[must_use]
    pub fn written(&self) -> String {
        self.point.as_ref().map_or_else(|| self.link.text.clone(), |point| format!("{}.{point}", self.link))
    }

    /// Where it stands.
    #[must_use]
    pub fn place(&self) -> Place {
        let start = self.link.place();
        self.point.as_ref().map_or(start, |p| start.to(p.place()))
    }
}

/// A direction and the link in whose frame it is meant.
#[derive(Clone, Debug)]
pub struct Direction {
    /// What it says.
    pub kind: DirectionKind,
    /// `of LINK`
    pub of: Option<Name>,
    /// Where it stands.
    pub place: Place,
}

/// The kinds of directions.
#[derive(Clone, Debug)]
pub enum DirectionKind {
    /// By its angle.
    Angle(Value),
    /// Along a vector.
    Vector(VectorValue),
    /// From a point to another.
    Points(Name, Name),
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: Name,
    /// The keyword.
    pub keyword: Name,
    /// The link that acts.
    pub from: End,
    /// The link that feels.
    pub to: End,
    /// `along …`
    pub along: Option<Direction>,
    /// `angle …`
    pub angle: Option<Value>,
    /// What a gear pair has beside.
    pub gear: Box<Gear>,
}

/// `radii (20mm, 30mm), internal, phase 5mm, pressure_angle 20deg, flank left`
#[derive(Clone, Debug, Default)]
pub struct Gear {
    /// The radii of the first and the second wheel.
    pub radii: Option<[Value; 2]>,
    /// Whether the first wheel is a ring.
    pub internal: bool,
    /// `phase …`
    pub phase: Option<Value>,
    /// `pressure_angle …`
    pub pressure_angle: Option<Value>,
    /// `flank left` or `flank right`
    pub flank: Option<Name>,
}

/// `drive NAME: JOINT;`
#[derive(Clone, Debug)]
pub struct Drive {
    /// Its name.
    pub name: Name,
    /// The joint.
    pub joint: Name,
    /// `.angle` or `.travel`
    pub coordinate: Option<Name>,
    /// `{ … }`
    pub motion: DriveMotion,
}

/// `{ rate: 3000rpm, acceleration: 0 }`
#[derive(Clone, Debug, Default)]
pub struct DriveMotion {
    /// `rate: …`
    pub rate: Option<Value>,
    /// `acceleration: …`
    pub acceleration: Option<Value>,
}

/// `assemble JOINT: side;`
#[derive(Clone, Debug)]
pub struct Assemble {
    /// The inner joint of the group.
    pub joint: Name,
    /// The word.
    pub side: Name,
    /// The joints in parentheses: one or two.
    pub joints: Vec<Name>,
    /// `smooth at …`
    pub smooth: Option<Smooth>,
    /// The side with its joints.
    pub chosen: Place,
    /// The whole.
    pub place: Place,
}

/// `start LINK: vector, angle value;` or `start DRIVE: value;`
#[derive(Clone, Debug)]
pub struct Start {
    /// The link or the drive.
    pub name: Name,
    /// Where it starts.
    pub from: StartFrom,
    /// The whole.
    pub place: Place,
}

/// Where a search starts.
#[derive(Clone, Debug)]
pub enum StartFrom {
    /// Of a link, the place of its frame and the angle of its x axis.
    Pose(VectorValue, Value),
    /// The coordinate of a drive.
    Coordinate(Value),
}

/// `smooth at value`
#[derive(Clone, Debug)]
pub struct Smooth {
    /// The angle.
    pub at: Value,
    /// The whole.
    pub place: Place,
}

/// `unknown NAME: effort;`
#[derive(Clone, Debug)]
pub struct Unknown {
    /// Its name.
    pub name: Name,
    /// Name and effort.
    pub place: Place,
    /// What it is.
    pub effort: Effort,
}

/// What an unknown is.
#[derive(Clone, Debug)]
pub enum Effort {
    /// `torque(a -> b)`
    Torque(Name, Name),
    /// `force(link.P) along direction`
    Force(End, Box<Direction>),
    /// `thrust(a.P, b.Q)`
    Thrust([End; 2]),
    /// `effort(theta)`
    Drive(Name),
}

/// A load.
#[derive(Clone, Debug)]
pub struct Load {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub kind: LoadKind,
    /// `= …`
    pub magnitude: Option<Magnitude>,
}

/// The kinds of loads.
#[derive(Clone, Debug)]
pub enum LoadKind {
    /// `force(link.P) in LINK`
    Force {
        /// Where.
        at: End,
        /// The link with which it turns.
        frame: Option<Name>,
    },
    /// `moment(a -> b)` or `moment(b)`
    Moment {
        /// What reacts it.
        from: Option<Name>,
        /// What feels it.
        on: Name,
    },
    /// `gravity`
    Gravity,
    /// `thrust(a.P, b.Q)`
    Thrust([End; 2]),
    /// `spring(a.P, b.Q) { … }`
    Spring([End; 2], Vec<SpringField>),
    /// `torsion(a -> b) { … }`
    Torsion {
        /// What reacts it.
        from: Name,
        /// What feels it.
        on: Name,
        /// What is said of it.
        fields: Vec<SpringField>,
    },
    /// `inertia` or `inertia(rod, piston)`
    Inertia(Option<Vec<Name>>),
}

/// `rate: 2N/mm` of a spring.
#[derive(Clone, Debug)]
pub struct SpringField {
    /// Its name.
    pub name: Name,
    /// How much; `None` for `_`, a value that is given at run time.
    pub value: Option<Value>,
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Its name.
    pub name: Name,
    /// The method's keyword.
    pub method: Name,
    /// Its loads; all if left out. Of a sweep, the scene that it goes through.
    pub loads: Option<Vec<Name>>,
    /// Of an inverse scene, the joints whose motion is wanted, each with the word for its coordinate if that is said.
    pub wanted: Vec<End>,
    /// Its results; all if left out.
    pub results: Option<Vec<ResultItem>>,
    /// `(statics) by (theta, F13)` of a derivative.
    pub derivative: Option<Derivative>,
}

/// What is differentiated, and by what.
#[derive(Clone, Debug)]
pub struct Derivative {
    /// The scene.
    pub of: Name,
    /// `theta`, `theta.rate`, `F13`, `l2`.
    pub by: Vec<End>,
}

/// A wanted result.
#[derive(Clone, Debug)]
pub enum ResultItem {
    /// An unknown, a joint or a load.
    Name(Name),
    /// A point of a link, or its angle.
    Point(Name, Name),
    /// `B along coupler`
    Along(End, Name),
    /// `S about rail.P`
    About(End, End),
    /// `inertia(rod)` or `offset(rod)`
    OfLink(Name, Name),
    /// `shaking(ground.O)`
    OfPoint(Name, End),
}
