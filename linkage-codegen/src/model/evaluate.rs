//! Values as written, turned into expressions in the units of the generated functions.

use super::Model;
use super::ids::{LinkId, ParamId, PointId};
use super::names::{Entry, Names, Role};
use super::units::{Dimension, Kind, unit, unit_names};
use crate::diagnostics::{Diagnostic, Place, closest};
use crate::graph::number::Number;
use crate::graph::{Expr, Failure, Symbol, Vector};
use crate::syntax::FUNCTIONS;
use crate::syntax::ast::{Direction, DirectionKind, Name, Value, ValueKind, VectorKind, VectorValue};

/// An expression and its dimension; the bare zero has none, and fits all.
struct Quantity<'m> {
    expr: Expr<'m>,
    dimension: Option<Dimension>,
}

/// Where values are evaluated.
#[derive(Clone, Copy)]
pub(super) struct Scope<'m> {
    pub(super) model: &'m Model,
    pub(super) names: &'m Names,
}

type Evaluated<T> = Result<T, Diagnostic>;

impl<'m> Scope<'m> {
    /// A value that must be of a kind.
    pub(super) fn scalar(&self, value: &Value, kind: Kind) -> Evaluated<Expr<'m>> {
        let found = self.quantity(value)?;
        self.converted(&found, kind, value.place)
    }

    /// The same that must not be negative: of a parameter that is required of what is given for it.
    pub(super) fn not_negative(
        &self,
        value: &Value,
        kind: Kind,
        what: &str,
        requirement: String,
    ) -> Evaluated<Expr<'m>> {
        let found = self.scalar(value, kind)?;
        match found.sign() {
            Some(-1) => Err(Diagnostic::new(value.place, format!("{what} cannot be negative"))),
            _ => Ok(self.required_not_negative(found, requirement)),
        }
    }

    fn required_not_negative(&self, value: Expr<'m>, requirement: String) -> Expr<'m> {
        match value.sign() {
            Some(_) => value,
            None => value.require_at_least(value, self.model.graph.zero(), Failure::Parameter { requirement }),
        }
    }

    fn converted(&self, found: &Quantity<'m>, kind: Kind, place: Place) -> Evaluated<Expr<'m>> {
        let units = &self.model.units;
        let Some(dimension) = found.dimension else { return Ok(found.expr) };
        if let Some(factor) = kind.factor_from(dimension, units) {
            let converted = self.model.graph.constant(&factor) * found.expr;
            let fits = converted.value().is_none_or(|number| number.fits(self.model.graph.scalar()));
            if kind == Kind::Angle && converted.value().is_some_and(|angle| angle.is_excessive_angle()) {
                return Err(Diagnostic::new(place, "this angle is too large").help("leave whole turns out"));
            }
            return if fits { Ok(converted) } else { Err(self.beyond_range(place)) };
        }
        let help = if dimension == Dimension::NUMBER {
            format!("write the unit: `{}`", kind.example(units))
        } else {
            format!("{} is written `{}`", kind.name(), kind.example(units))
        };
        Err(Diagnostic::new(place, format!("expected {}, found {dimension}", kind.name())).help(help))
    }

    /// A vector whose components, or whose size, are of a kind.
    pub(super) fn vector(&self, vector: &VectorValue, kind: Kind) -> Evaluated<Vector<'m>> {
        match &vector.kind {
            VectorKind::Cartesian(x, y) => Ok(Vector::new(self.scalar(x, kind)?, self.scalar(y, kind)?)),
            VectorKind::Polar(size, angle) => {
                let size = self.scalar(size, kind)?;
                Ok(self.scalar(angle, Kind::Angle)?.direction().scaled(size))
            }
        }
    }

    /// A direction in the frame of a link, as a unit vector.
    pub(super) fn direction(&self, direction: &Direction, link: LinkId) -> Evaluated<Vector<'m>> {
        match &direction.kind {
            DirectionKind::Angle(angle) => Ok(self.scalar(angle, Kind::Angle)?.direction()),
            DirectionKind::Vector(vector) => {
                let components = match &vector.kind {
                    VectorKind::Polar(size, angle) => {
                        let (size, along) = (self.quantity(size)?.expr, self.scalar(angle, Kind::Angle)?.direction());
                        match size.sign() {
                            Some(1) => return Ok(along),
                            Some(-1) => return Ok(-along),
                            _ => along.scaled(size),
                        }
                    }
                    VectorKind::Cartesian(x, y) => {
                        let (x, y) = (self.quantity(x)?, self.quantity(y)?);
                        if let (Some(a), Some(b)) = (x.dimension, y.dimension)
                            && a != b
                        {
                            let problem = format!("the components of a direction are of one kind, not {a} and {b}");
                            return Err(Diagnostic::new(vector.place, problem));
                        }
                        Vector::new(x.expr, y.expr)
                    }
                };
                self.normalised(components, direction.place, link, &vector.to_string())
            }
            DirectionKind::Points(from, to) => {
                let ends = (self.point(link, from)?, self.point(link, to)?);
                let at = |p: Option<PointId>| {
                    p.map(|p| self.model.links[link.index()].points[p.index()].at.vector(&self.model.graph))
                };
                match (at(ends.0), at(ends.1)) {
                    (Some(start), Some(end)) => {
                        self.normalised(end - start, direction.place, link, &format!("{from} -> {to}"))
                    }
                    _ => Ok(self.model.unread().direction()),
                }
            }
        }
    }

    fn normalised(&self, vector: Vector<'m>, place: Place, of: LinkId, shown: &str) -> Evaluated<Vector<'m>> {
        if vector.is_zero() {
            return Err(Diagnostic::new(place, "a direction cannot be the zero vector"));
        }
        let link = self.model.links.get(of.index()).map_or("ground", |link| link.name.text.as_str());
        let requirement = format!("{link}: the direction `{shown}` must not be the zero vector");
        let checked = self.required_not_zero(vector, requirement);
        Ok(self.model.graph.unit(checked))
    }

    /// That a vector is not the zero vector is asked of one of its components, where parameters give it.
    fn required_not_zero(&self, Vector { x, y }: Vector<'m>, requirement: String) -> Vector<'m> {
        let checked = |value: Expr<'m>| self.where_positive(value, x.abs() + y.abs(), requirement);
        if x.value().is_some() { Vector::new(x, checked(y)) } else { Vector::new(checked(x), y) }
    }

    /// The value, where another one is positive.
    fn where_positive(&self, value: Expr<'m>, positive: Expr<'m>, requirement: String) -> Expr<'m> {
        value.require_above(positive, self.model.graph.zero(), Failure::Parameter { requirement })
    }

    /// A point of a link; `None` if the link could not be read.
    pub(super) fn point(&self, link: LinkId, name: &Name) -> Evaluated<Option<PointId>> {
        let Some(body) = self.model.links.get(link.index()) else { return Ok(None) };
        if let Some(index) = body.points.iter().position(|p| p.name.text == name.text) {
            return Ok(Some(PointId::new(index)));
        }
        if body.unread {
            return Ok(None);
        }
        Err(body.without_point(name, []))
    }

    /// An expression. A constant far beyond any scalar is refused at once: to go on with it could take any time.
    fn quantity(&self, value: &Value) -> Evaluated<Quantity<'m>> {
        let found = self.operation(value)?;
        match found.expr.value() {
            Some(number) if number.is_excessive() => Err(self.beyond_range(value.place)),
            _ => Ok(found),
        }
    }

    fn beyond_range(&self, place: Place) -> Diagnostic {
        let scalar = self.model.graph.scalar().name();
        Diagnostic::new(place, format!("this number is beyond the range of an `{scalar}`"))
    }

    fn operation(&self, value: &Value) -> Evaluated<Quantity<'m>> {
        let place = value.place;
        match &value.kind {
            ValueKind::Number(digits, suffix) => self.number(digits, suffix.as_deref(), place),
            ValueKind::Name(name) => self.named(name, place),
            ValueKind::Negative(inner) => {
                let inner = self.quantity(inner)?;
                Ok(Quantity { expr: -inner.expr, ..inner })
            }
            ValueKind::Sum(a, b) => self.joined(a, b, |a, b| a + b),
            ValueKind::Difference(a, b) => self.joined(a, b, |a, b| a - b),
            ValueKind::Product(a, b) => {
                let (a, b) = (self.quantity(a)?, self.quantity(b)?);
                let dimension = a.dimension.zip(b.dimension).map(|(a, b)| a.times(b));
                Ok(Quantity { expr: a.expr * b.expr, dimension })
            }
            ValueKind::Quotient(a, b) => {
                let (a, divisor) = (self.quantity(a)?, self.quantity(b)?);
                if divisor.expr.is_zero() {
                    return Err(Diagnostic::new(b.place, "division by zero")
                        .help("the divisor is exactly zero: check the formula"));
                }
                let dimension = a.dimension.zip(divisor.dimension).map(|(a, b)| a.over(b));
                let requirement = format!("`{b}`, by which is divided, must not be zero");
                Ok(Quantity {
                    expr: a.expr / self.where_positive(divisor.expr, divisor.expr.abs(), requirement),
                    dimension,
                })
            }
            ValueKind::Power(base, exponent) => {
                let base = self.quantity(base)?;
                Ok(Quantity { expr: base.expr.pow(*exponent), dimension: base.dimension.map(|d| d.power(*exponent)) })
            }
            ValueKind::Call(function, args) => self.call(function, args, place),
        }
    }

    fn number(&self, digits: &str, suffix: Option<&str>, place: Place) -> Evaluated<Quantity<'m>> {
        let graph = &self.model.graph;
        let Some(value) = Number::decimal(digits) else { return Err(self.beyond_range(place)) };
        let Some(suffix) = suffix else {
            let dimension = (!value.is_zero()).then_some(Dimension::NUMBER);
            return Ok(Quantity { expr: graph.constant(&value), dimension });
        };
        let Some(unit) = unit(suffix) else {
            let problem = Diagnostic::new(place, format!("there is no unit `{suffix}`"));
            return Err(match meant(suffix) {
                Some(meant) => problem.help(format!("did you mean `{meant}`?")),
                None => problem.suggest(suffix, unit_names()),
            });
        };
        let value = value.mul(&self.model.units.size_of(&unit));
        Ok(Quantity { expr: graph.constant(&value), dimension: Some(unit.dimension) })
    }

    fn named(&self, name: &str, place: Place) -> Evaluated<Quantity<'m>> {
        let graph = &self.model.graph;
        if name == "pi" {
            return Ok(Quantity { expr: graph.constant(&Number::pi(1, 1)), dimension: Some(Dimension::NUMBER) });
        }
        match (self.names.entry(name), unit(name)) {
            (Some(Entry { role: Role::Param, index, sound: true }), _) => {
                let param = &self.model.params[index];
                let expr = graph.symbol(Symbol::Parameter(ParamId::new(index)));
                Ok(Quantity { expr, dimension: Some(param.kind.dimension()) })
            }
            (Some(Entry { role: Role::Param | Role::Broken, .. }), _) => {
                Ok(Quantity { expr: self.model.unread(), dimension: None })
            }
            (_, Some(unit)) => {
                let size = self.model.units.size_of(&unit);
                Ok(Quantity { expr: graph.constant(&size), dimension: Some(unit.dimension) })
            }
            _ if self.names.may_mean(&[Role::Param], name) => {
                Ok(Quantity { expr: self.model.unread(), dimension: None })
            }
            (Some(entry), _) => {
                Err(Diagnostic::new(place, format!("`{name}` is {}, and no value", entry.role.describe()))
                    .help("a value is a number with its unit, such as `80mm`, or a parameter"))
            }
            (None, _) => {
                let param = closest(name, self.names.of(Role::Param)).map(str::to_owned);
                // Two letters are close to some unit or other: what is meant is one that differs in case alone.
                let is_near = |word: &&str| name.len() > 2 || word.eq_ignore_ascii_case(name);
                let word = || closest(name, unit_names().chain(FUNCTIONS).filter(is_near)).map(str::to_owned);
                let problem = format!("there is no parameter or unit `{name}`");
                let found = Diagnostic::new(place, problem);
                Err(match param.or_else(|| meant(name)).or_else(word) {
                    Some(near) => found.help(format!("did you mean `{near}`?")),
                    None => found
                        .help(format!("a dimension that is known at run time is declared as `param {name}: length;`")),
                })
            }
        }
    }

    fn joined(&self, a: &Value, b: &Value, join: fn(Expr<'m>, Expr<'m>) -> Expr<'m>) -> Evaluated<Quantity<'m>> {
        let (left, right) = (self.quantity(a)?, self.quantity(b)?);
        if let (Some(wanted), Some(found)) = (left.dimension, right.dimension)
            && wanted != found
        {
            let problem = format!("{wanted} and {found} cannot be added or subtracted");
            return Err(Diagnostic::new(a.place.to(b.place), problem));
        }
        Ok(Quantity { expr: join(left.expr, right.expr), dimension: left.dimension.or(right.dimension) })
    }

    fn call(&self, function: &Name, args: &[Value], place: Place) -> Evaluated<Quantity<'m>> {
        let graph = &self.model.graph;
        let name = function.text.as_str();
        let count = match name {
            "atan2" => 2,
            _ if FUNCTIONS.contains(&name) => 1,
            _ => {
                let problem = format!("there is no function `{name}`");
                return Err(Diagnostic::new(function.place(), problem).suggest(name, FUNCTIONS));
            }
        };
        if args.len() != count {
            let problem = format!("`{name}` takes {}", crate::diagnostics::count(count, "argument"));
            return Err(Diagnostic::new(place, problem));
        }
        let number = |expr| Quantity { expr, dimension: Some(Dimension::NUMBER) };
        let angle = |expr| Quantity { expr, dimension: Some(Dimension::ANGLE) };
        match name {
            "sqrt" => {
                let arg = self.quantity(&args[0])?;
                if arg.expr.sign() == Some(-1) {
                    return Err(Diagnostic::new(args[0].place, "the root of a negative number")
                        .help("check the signs under the root"));
                }
                let Some(dimension) = arg.dimension.map(Dimension::root) else { return Ok(arg) };
                let Some(dimension) = dimension else {
                    return Err(Diagnostic::new(
                        args[0].place,
                        format!("{} has no square root", arg.dimension.unwrap_or_default()),
                    ));
                };
                let requirement = format!("`{}`, whose root is taken, must not be negative", args[0]);
                Ok(Quantity {
                    expr: self.required_not_negative(arg.expr, requirement).sqrt(),
                    dimension: Some(dimension),
                })
            }
            "sin" => Ok(number(self.scalar(&args[0], Kind::Angle)?.direction().y)),
            "cos" => Ok(number(self.scalar(&args[0], Kind::Angle)?.direction().x)),
            "tan" => {
                let direction = self.scalar(&args[0], Kind::Angle)?.direction();
                if direction.x.is_zero() {
                    return Err(Diagnostic::new(place, "the tangent of a right angle is infinite"));
                }
                Ok(number(direction.y / direction.x))
            }
            "atan2" => {
                let (y, x) = (self.quantity(&args[0])?, self.quantity(&args[1])?);
                if let (Some(a), Some(b)) = (y.dimension, x.dimension)
                    && a != b
                {
                    return Err(Diagnostic::new(place, format!("`atan2` compares {a} with {b}")));
                }
                if y.expr.is_zero() && x.expr.is_zero() {
                    return Err(Diagnostic::new(place, "the zero vector has no angle"));
                }
                let requirement =
                    format!("of `{}` and `{}` one must not be zero, of which `atan2` is taken", args[0], args[1]);
                let vector = self.required_not_zero(Vector::new(x.expr, y.expr), requirement);
                Ok(angle(graph.atan2(vector.y, vector.x)))
            }
            _ => {
                let x = self.scalar(&args[0], Kind::Number)?;
                let rest = graph.one() - x * x;
                if name != "atan" && rest.sign() == Some(-1) {
                    return Err(Diagnostic::new(args[0].place, format!("`{name}` takes a number from −1 to 1"))
                        .help("it is a ratio of two lengths of one triangle: check which is the longer one"));
                }
                let requirement = || format!("`{}`, of which `{name}` is taken, must be from −1 to 1", args[0]);
                let rest = if name == "atan" { rest } else { self.required_not_negative(rest, requirement()) };
                Ok(angle(match name {
                    "asin" => graph.atan2(x, rest.sqrt()),
                    "acos" => graph.atan2(rest.sqrt(), x),
                    _ => graph.atan2(x, graph.one()),
                }))
            }
        }
    }
}

/// What is written otherwise elsewhere: the unit of a moment, of an impulse or of `kg m²` as one word, a power without its mark, an inch by its
/// abbreviation.
fn meant(suffix: &str) -> Option<String> {
    if suffix == "in" {
        return Some("inch".to_owned());
    }
    let power = suffix.strip_suffix(['2', '3']).filter(|base| unit(base).is_some());
    if let Some(base) = power {
        return Some(format!("{base}^{}", &suffix[base.len()..]));
    }
    let places = suffix.char_indices().map(|(place, _)| suffix.split_at(place));
    let is = |name: &str, dimension: Dimension| unit(name).is_some_and(|unit| unit.dimension == dimension);
    let products = [
        (Dimension::FORCE, Dimension::LENGTH),
        (Dimension::MASS, Dimension::LENGTH),
        (Dimension::FORCE, Dimension::TIME),
    ];
    // `gm` is meant as gram.
    let mut joined =
        places.filter(|(left, right)| *left != "g" && products.iter().any(|(a, b)| is(left, *a) && is(right, *b)));
    joined.next().map(|(left, right)| format!("{left}*{right}"))
}
