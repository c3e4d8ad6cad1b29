//! Derivatives of a scene's results by drives, their rates and accelerations, by loads and by parameters.
//!
//! The results are differentiated as they stand, forwards through the graph. What places the links is not gone into: how directions,
//! travels and transmission angles change with a drive or a parameter is a motion of the linkage, found by the rules of its groups, so
//! that a derivative is as good near a fold as a velocity is, and groups placed by iteration have theirs by their Jacobian. What a
//! load changes is linear: no derivative of the pose takes part.

use super::rules::Rule;
use super::{Assembly, Field, Motion, Output};
use crate::diagnostics::{Diagnostic, Sink};
use crate::graph::tangent::Tangent;
use crate::graph::{Expr, Op, Symbol, Vector};
use crate::model::ids::DriveId;
use crate::model::units::Kind;
use crate::model::{By, Derivative, LoadKind, Model, Part as EquationPart, Variable, Wanted};

/// Derivatives of the results of scenes.
pub(super) struct Sensitivities<'a, 'm> {
    assembly: &'a Assembly<'m>,
    rules: &'a [&'static dyn Rule],
    sink: &'a Sink,
    /// Of each unknown that was asked for.
    tangents: Vec<Tangent<'m>>,
    /// Whether the motion was found: only then is it worth saying what is zero.
    sound: bool,
}

impl<'a, 'm> Sensitivities<'a, 'm> {
    /// None asked for yet. The rules are those of the groups of motion.
    pub(super) fn new(assembly: &'a Assembly<'m>, rules: &'a [&'static dyn Rule], sink: &'a Sink) -> Self {
        Self { assembly, rules, sink, tangents: Vec::new(), sound: sink.is_clean() }
    }

    /// A record for each variable, of the shape of the scene's own results.
    pub(super) fn of(&mut self, derivative: &Derivative, results: &Output) -> Output {
        let results = &smooth(self.assembly.model(), derivative, results);
        let fields = derivative.by.iter().map(|variable| self.by(variable, derivative, results));
        Output::Record(fields.collect())
    }

    fn by(&mut self, variable: &Variable, derivative: &Derivative, results: &Output) -> Field {
        let model = self.assembly.model();
        let name = variable.name(model);
        let parts: Vec<Field> = parts_of(model, variable.by)
            .into_iter()
            .map(|part| {
                let value = self.by_symbol(&part, variable, results);
                Field { doc: format!("By {}.", part.what), name: part.field, value }
            })
            .collect();
        let fields = parts.iter().flat_map(|part| part.value.leaves());
        if fields.into_iter().all(|(_, node)| model.graph.expr(node).is_zero()) && self.sound {
            let scene = &model.scenes[derivative.of].name;
            let problem = format!(
                "no result of `{scene}` depends on `{}`: all these derivatives are zero",
                variable.written(model)
            );
            self.sink.report(Diagnostic::new(variable.place, problem).help("leave it out"));
        }
        match <[Field; 1]>::try_from(parts) {
            Ok([only]) if only.name.is_empty() => Field { name, ..only },
            Ok(parts) => {
                Field { name, doc: format!("By `{}`.", variable.written(model)), value: Output::Record(parts.into()) }
            }
            Err(parts) => {
                Field { name, doc: format!("By `{}`.", variable.written(model)), value: Output::Record(parts) }
            }
        }
    }

    fn by_symbol(&mut self, part: &Part, variable: &Variable, results: &Output) -> Output {
        let found = self.tangents.iter().position(|tangent| tangent.unknown() == part.symbol);
        let index = found.unwrap_or_else(|| {
            let before = self.sink.is_clean();
            let tangent = self.tangent(part);
            self.sound &= !before || self.sink.is_clean();
            self.tangents.push(tangent);
            self.tangents.len() - 1
        });
        let tangent = &self.tangents[index];
        let graph = self.assembly.graph();
        graph.begin_section(format!("Derivatives by {}", tangent.name()));
        let output = results.mapped(&mut |node| tangent.of(graph.expr(node)).id(), &|doc| {
            format!("By {}: {}", part.what, lowered(doc))
        });
        if tangent.reached_a_search() && self.sink.is_clean() {
            let problem =
                format!("the derivative by `{}` could not be formed", variable.written(self.assembly.model()));
            self.sink.report(
                Diagnostic::new(variable.place, problem)
                    .note("it would need the change of a number of a search by Newton's method that is no direction, angle or travel")
                    .help("leave it out"),
            );
        }
        output
    }

    /// The derivatives by an unknown, those of the pose stated as the motion gives them.
    fn tangent(&self, part: &Part) -> Tangent<'m> {
        let (assembly, model, graph) = (self.assembly, self.assembly.model(), self.assembly.graph());
        let tangent = Tangent::by(graph, part.symbol, &part.name);
        if !matches!(part.symbol, Symbol::Drive(_) | Symbol::Parameter(_)) {
            return tangent;
        }
        let (placement, pivots) = (&assembly.placement, &assembly.pivots);
        let motion = Motion::change(placement, pivots, part.symbol, &part.name).through(
            &assembly.topology.motion,
            self.rules,
            self.sink,
        );
        graph.begin_section(format!("Change of the pose with {}", part.name));
        for link in model.moving_links() {
            let (direction, rate) = (placement.direction(link), motion.rate_of_direction(link));
            let turning = direction.perp().scaled(rate);
            for direction in [direction, placement.rough_direction(link)] {
                tangent.state(direction.x, turning.x);
                tangent.state(direction.y, turning.y);
            }
            tangent.state(placement.angle(link), motion.rate(link));
        }
        let runs = placement.runs().map(|(joint, run, _)| (joint, run));
        for (joint, travel) in placement.travels().chain(runs) {
            tangent.state(travel, motion.of_travel(joint));
        }
        for (from, to, sine, cosine) in pivots.stated() {
            let turning = |vector: Vector<'m>| {
                let own = model.moving_links().find(|link| {
                    let direction = placement.direction(*link);
                    vector == direction || vector == -direction
                });
                own.map_or_else(|| vector.cross(tangent.of_vector(vector)), |link| motion.rate_of_direction(link))
            };
            let relative = turning(to) - turning(from);
            let angle = |known: Option<Expr<'m>>, other: Expr<'m>| known.unwrap_or(other);
            if let Some(sine) = sine {
                tangent.state(sine, angle(cosine, from.dot(to)) * relative);
            }
            if let Some(cosine) = cosine {
                tangent.state(cosine, -(angle(sine, from.cross(to)) * relative));
            }
        }
        tangent
    }
}

/// What of a scene's results varies smoothly: not how much of a mass is rounding.
fn smooth(model: &Model, derivative: &Derivative, results: &Output) -> Output {
    let Output::Record(fields) = results else { return results.clone() };
    let rounding = Wanted::Part(EquationPart::Rounding);
    let left_out = |field: &&Field| {
        let asked = model.scenes[derivative.of].results.contains(&rounding);
        asked && model.result_name(rounding).is_some_and(|name| name == field.name)
    };
    Output::Record(fields.iter().filter(|field| !left_out(field)).cloned().collect())
}

/// An unknown of run time as a part of a variable.
struct Part {
    symbol: Symbol,
    /// The field of the variable's record, empty of a variable that is one number.
    field: String,
    /// Its name among values.
    name: String,
    /// What it is in documentation, with its unit.
    what: String,
}

/// The numbers of a variable.
fn parts_of(model: &Model, by: By) -> Vec<Part> {
    let whole = |symbol, name: &str, shown: &str, kind: Kind| Part {
        symbol,
        field: String::new(),
        name: name.to_owned(),
        what: in_words(model, shown, kind),
    };
    match by {
        By::Drive(drive) => {
            let data = model.drive(drive);
            let kind = if data.turns { Kind::Angle } else { Kind::Length };
            vec![whole(Symbol::Drive(drive), &data.name.text, &data.name.text, kind)]
        }
        By::Driven(drive, order) => {
            let (data, shown) = (model.drive(drive), Variable::motion_written(model, drive, order));
            let kind = crate::model::Drive::kind_of(order, data.turns);
            vec![whole(Symbol::Driven(drive, order), &data.motion_name(order), &shown, kind)]
        }
        By::Parameter(param) => {
            let data = model.param(param);
            vec![whole(Symbol::Parameter(param), &data.name.text, &data.name.text, data.kind)]
        }
        By::Load(load) => {
            let data = model.load(load);
            let numbers = data.kind.values().into_iter().filter_map(|(field, node)| match model.graph.op(node) {
                Op::Symbol(symbol @ Symbol::Load(..)) => {
                    let shown =
                        if field.is_empty() { data.name.text.clone() } else { format!("{}.{field}", data.name) };
                    Some(Part {
                        symbol,
                        field: field.to_owned(),
                        name: data.value_name(field),
                        what: in_words(model, &shown, kind_of(data.kind, field)),
                    })
                }
                _ => None,
            });
            numbers.collect()
        }
    }
}

/// The dimension of a number of a load.
fn kind_of(load: LoadKind, value: &str) -> Kind {
    let turns = matches!(load, LoadKind::Torsion { .. });
    match (load, value) {
        (LoadKind::Gravity { .. }, _) => Kind::Acceleration,
        (LoadKind::Moment { .. }, _) => Kind::Moment,
        (_, "rate") => {
            if turns {
                Kind::TorsionStiffness
            } else {
                Kind::Stiffness
            }
        }
        (_, "free" | "near") => {
            if turns {
                Kind::Angle
            } else {
                Kind::Length
            }
        }
        (_, "damping") => {
            if turns {
                Kind::TorsionDamping
            } else {
                Kind::Damping
            }
        }
        _ => Kind::Force,
    }
}

/// `theta`, per rad
fn in_words(model: &Model, shown: &str, kind: Kind) -> String {
    match kind {
        Kind::Number => format!("`{shown}`"),
        _ => format!("`{shown}`, per {}", kind.unit(&model.units)),
    }
}

/// A sentence within another one.
fn lowered(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

impl Variable {
    /// The drive of a rate or an acceleration as it is written: `theta.rate`.
    pub(super) fn motion_written(model: &Model, drive: DriveId, order: crate::graph::Order) -> String {
        let word = match order {
            crate::graph::Order::Rate => "rate",
            crate::graph::Order::Acceleration => "acceleration",
        };
        format!("{}.{word}", model.drive(drive).name)
    }

    /// As it is written.
    #[must_use]
    pub fn written(&self, model: &Model) -> String {
        match self.by {
            By::Driven(drive, order) => Self::motion_written(model, drive, order),
            _ => self.name(model),
        }
    }

    /// The field of its derivatives.
    #[must_use]
    pub fn name(&self, model: &Model) -> String {
        match self.by {
            By::Drive(drive) => model.drive(drive).name.text.clone(),
            By::Driven(drive, order) => model.drive(drive).motion_name(order),
            By::Load(load) => model.load(load).name.text.clone(),
            By::Parameter(param) => model.param(param).name.text.clone(),
        }
    }
}
