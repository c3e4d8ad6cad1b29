//! The results of every scene, by its method.

use super::framed::Framed;
use super::inverse::drivers;
use super::posed::Posed;
use super::resultants::{Resultant, rate_of, reacted_by_ground};
use super::rules::{Rule, RuleResult};
use super::sensitivities::Sensitivities;
use super::{Assembly, Balance, Comparison, Meaning, Motion, Output, PlacedLink, heading, joint_name};
use crate::diagnostics::Sink;
use crate::equations::joints::Component;
use crate::equations::loads::{Action, Case, Line, by_dalembert, cases_of};
use crate::equations::{Exerted, Source, System};
use crate::graph::{Expr, Failure, Order, Symbol, Vector};
use crate::model::ids::{GROUND, JointId, LinkId, LoadId, UnknownId};
use crate::model::units::Kind;
use crate::model::{Along, Drive, End, JointKind, LoadKind, Mass, Method, Model, Scene, Spot, UnknownKind, Wanted};
use crate::plan::output::Field;
use crate::topology::Group;

/// What the solution of forces needs.
pub(super) struct Forces<'a, 'm> {
    pub(super) model: &'m Model,
    groups: &'a [Group],
    rules: &'a [&'static dyn Rule],
    pub(super) motion_rules: &'a [&'static dyn Rule],
    pub(super) assembly: &'a Assembly<'m>,
    posed: Posed<'m, 'a>,
    /// The cases of each load.
    cases: Vec<Vec<(Case, Vec<Action>)>>,
    pub(super) sink: &'a Sink,
}

/// The results of all scenes.
pub(super) fn outputs<'m>(
    assembly: &Assembly<'m>,
    posed: Posed<'m, '_>,
    [motion_rules, rules]: [&[&'static dyn Rule]; 2],
    equations: (&System, &[PlacedLink]),
    sink: &Sink,
) -> Vec<Output> {
    let model = assembly.model();
    let cases = (0..model.loads.len()).map(LoadId::new).map(|load| {
        model.graph.begin_section(format!("Load {}", model.load(load).name));
        cases_of(&posed, load)
    });
    let cases = cases.collect();
    let forces = Forces { model, groups: &assembly.topology.forces, rules, motion_rules, assembly, posed, cases, sink };
    let output = |(index, scene): (usize, &Scene)| {
        model.graph.begin_scene(index);
        let output = match scene.method {
            Method::Position => position(&forces, scene),
            Method::Velocity => motion(&forces, scene, posed.velocities, Order::Rate),
            Method::Acceleration => motion(&forces, scene, posed.accelerations, Order::Acceleration),
            Method::Equilibrium => forces.equilibrium(scene),
            Method::Superposition => forces.superposition(scene),
            Method::VirtualWork => forces.virtual_work(scene),
            Method::Motion => forces.equation_of_motion(scene),
            Method::Coefficients => forces.coefficients(scene),
            Method::Inverse => drivers(assembly, posed, scene),
            Method::Verify => forces.verify(scene, equations),
            // Of the results of another one, once these are known.
            Method::Derivative => Output::Record(Vec::new()),
        };
        forces.are_results(output)
    };
    let mut all: Vec<Output> = model.scenes.iter().enumerate().map(output).collect();
    let mut sensitivities = Sensitivities::new(assembly, motion_rules, sink);
    for (index, scene) in model.scenes.iter().enumerate() {
        if let Some(derivative) = &scene.derivative {
            model.graph.begin_scene(index);
            all[index] = sensitivities.of(derivative, &all[derivative.of]);
        }
    }
    model.graph.end_scenes();
    all
}

fn position(forces: &Forces<'_, '_>, scene: &Scene) -> Output {
    let (model, placement) = (forces.model, &forces.assembly.placement);
    let unit = Kind::Length.unit(&model.units);
    model.graph.begin_section("Places");
    let fields = scene.results.iter().filter_map(|wanted| match *wanted {
        Wanted::Joint(joint) => Some(Field {
            name: joint_name(model, joint).into(),
            doc: format!("Place of the joint `{}`, {unit}, ground axes.", joint_name(model, joint)),
            value: Output::vector(placement.joint_place(joint), Meaning::Place),
        }),
        Wanted::Point(end) => Some(Field {
            name: model.end_name(end).replace('.', "_"),
            doc: format!("Place of the point `{}`, {unit}, ground axes.", model.end_name(end)),
            value: Output::vector(placement.place(end), Meaning::Place),
        }),
        Wanted::Angle(link) => Some(Field {
            name: format!("{}_angle", model.link(link).name),
            doc: format!(
                "Angle of the x axis of the frame of `{}`, rad, counter-clockwise from the ground's.",
                model.link(link).name
            ),
            value: Output::scalar(placement.angle(link), Meaning::Angle),
        }),
        _ => None,
    });
    Output::Record(fields.collect())
}

/// The velocities or the accelerations that a scene asks for.
fn motion(forces: &Forces<'_, '_>, scene: &Scene, motion: Option<&Motion<'_, '_>>, order: Order) -> Output {
    let Some(motion) = motion else { return Output::Record(Vec::new()) };
    let model = forces.model;
    let wanted = Moved { model, motion, velocities: forces.posed.velocities, order };
    model.graph.begin_section(match order {
        Order::Rate => "Velocities",
        Order::Acceleration => "Accelerations",
    });
    let fields = scene.results.iter().filter_map(|result| {
        let (doc, value) = match *result {
            Wanted::Joint(joint) => wanted.vector(Spot::Joint(joint)),
            Wanted::Point(end) => wanted.vector(Spot::Point(end)),
            Wanted::Angle(link) => wanted.turning(link),
            Wanted::Resolved(spot, Along::Link(link)) => wanted.along_link(spot, link),
            Wanted::Resolved(spot, Along::Path) => wanted.along_path(spot),
            Wanted::Inertia(link) => forces.inertia(link),
            Wanted::Offset(link) => forces.offset(link),
            Wanted::Shaking(at) => forces.shaking(at),
            _ => return None,
        };
        Some(Field { name: model.result_name(*result)?, doc, value })
    });
    Output::Record(fields.collect())
}

/// Velocities or accelerations as results.
struct Moved<'a, 'm> {
    model: &'m Model,
    motion: &'a Motion<'m, 'a>,
    velocities: Option<&'a Motion<'m, 'a>>,
    order: Order,
}

impl<'m> Moved<'_, 'm> {
    /// `Velocity` or `Acceleration`, with its letter, its unit and its meaning.
    fn words(&self) -> (&'static str, char, String, Meaning) {
        let kind = Drive::kind_of(self.order, false);
        let unit = kind.unit(&self.model.units);
        match self.order {
            Order::Rate => ("Velocity", 'v', unit, Meaning::Velocity),
            Order::Acceleration => ("Acceleration", 'a', unit, Meaning::Acceleration),
        }
    }

    /// What moves, in words, and its name among values.
    fn of(&self, spot: Spot) -> (String, String) {
        match spot {
            Spot::Joint(joint) => {
                let name = joint_name(self.model, joint);
                (format!("the joint `{name}`"), name.to_owned())
            }
            Spot::Point(end) => {
                let name = self.model.end_name(end);
                (format!("the point `{name}`"), name.replace('.', "_"))
            }
        }
    }

    fn vector(&self, spot: Spot) -> (String, Output) {
        let (what, letter, unit, meaning) = self.words();
        let (of, name) = self.of(spot);
        let vector = of_spot(self.motion, spot).ground();
        let vector = vector.named(&format!("{letter}_{name}"), &format!("{} of {name}", what.to_lowercase()));
        (format!("{what} of {of}, {unit}, ground axes."), Output::vector(vector, meaning))
    }

    fn turning(&self, link: LinkId) -> (String, Output) {
        let (what, meaning) = match self.order {
            Order::Rate => ("Angular velocity", Meaning::AngularRate),
            Order::Acceleration => ("Angular acceleration", Meaning::AngularAcceleration),
        };
        let unit = Drive::kind_of(self.order, true).unit(&self.model.units);
        let doc = format!("{what} of `{}`, {unit}, counter-clockwise.", self.model.link(link).name);
        (doc, Output::scalar(self.motion.rate(link), meaning))
    }

    fn along_link(&self, spot: Spot, link: LinkId) -> (String, Output) {
        let (what, _, unit, meaning) = self.words();
        let (of, _) = self.of(spot);
        let resolved = of_spot(self.motion, spot).along(self.motion.placement.frame(link));
        let name = &self.model.link(link).name;
        let field = |part: &str, how: &str, value| {
            let doc = format!("Along the x axis of the frame of `{name}`{how}, {unit}.");
            Field::new(part, doc, Output::scalar(value, meaning))
        };
        let fields = vec![field("axial", "", resolved.x), field("transverse", " turned by +90°", resolved.y)];
        (format!("{what} of {of}, along and across `{name}`."), Output::Record(fields))
    }

    /// Along and across the velocity: where that vanishes, there is no such direction.
    fn along_path(&self, spot: Spot) -> (String, Output) {
        let (_, _, unit, meaning) = self.words();
        let (of, name) = self.of(spot);
        let graph = &self.model.graph;
        let Some(velocities) = self.velocities else { return (String::new(), Output::Record(Vec::new())) };
        let velocity = of_spot(velocities, spot).ground();
        let velocity = velocity.named(&format!("v_{name}"), &format!("velocity of {name}"));
        let direction = graph.unit(velocity).named_direction(&format!("path_{name}"), &format!("v_{name}/|v_{name}|"));
        let shown = match spot {
            Spot::Joint(joint) => joint_name(self.model, joint).to_owned(),
            Spot::Point(end) => self.model.end_name(end),
        };
        let failure = Failure::NoDirection { of: format!("the velocity of {shown}") };
        let (speed, rounding) = (direction.dot(velocity), rounding_of(velocity));
        let checked = |value: Expr<'m>| value.require_above(speed, rounding, failure.clone());
        let acceleration = of_spot(self.motion, spot).ground().resolved_along(direction);
        let field = |part: &str, doc: &str, value| {
            Field::new(part, format!("{doc}, {unit}."), Output::scalar(checked(value), meaning))
        };
        let fields = vec![
            field("tangential", "Along its velocity", acceleration.x),
            field("normal", "Along its velocity turned by +90°", acceleration.y),
        ];
        (format!("Acceleration of {of}, along and across its path."), Output::Record(fields))
    }
}

impl<'m> Forces<'_, 'm> {
    /// The equilibrium under some actions.
    fn balance(&self, prefix: &str, actions: &[Action]) -> Balance<'m, '_> {
        let case =
            if prefix.is_empty() { "forces".to_owned() } else { format!("forces by {}", prefix.trim_end_matches('_')) };
        let mut balance = Balance::new(&self.assembly.placement, &self.assembly.pivots, prefix.into(), actions);
        for (index, (group, rule)) in self.groups.iter().zip(self.rules).enumerate().rev() {
            self.model.graph.begin_section(heading(self.model, index, group, rule.class(), &case));
            self.report(rule.balance(&mut balance, group));
        }
        for joint in self.groups.iter().flat_map(|group| &group.outer) {
            if self.model.joint(*joint).end_on(GROUND).is_none() {
                let Vector { x, y } = balance.reaction(*joint).force.components;
                [x, y].into_iter().for_each(|part| self.model.graph.pass_on(part));
            }
        }
        self.model.graph.begin_section(format!("Results{}", case.trim_start_matches("forces")));
        balance
    }

    /// The same results; they stand under the heading that is open.
    fn are_results(&self, output: Output) -> Output {
        self.model.graph.are_results(output.leaves().into_iter().map(|(_, node)| node));
        output
    }

    /// An error of a rule is the same in every scene: once is enough.
    fn report(&self, result: RuleResult) {
        if let (Err(error), true) = (result, self.sink.is_clean()) {
            self.sink.report(error);
        }
    }

    /// The cases of a load.
    fn cases_of(&self, load: LoadId) -> &[(Case, Vec<Action>)] {
        &self.cases[load.index()]
    }

    /// All actions of some loads.
    fn actions(&self, loads: &[LoadId]) -> Vec<Action> {
        loads.iter().flat_map(|load| self.cases_of(*load)).flat_map(|(_, actions)| actions.clone()).collect()
    }

    fn equilibrium(&self, scene: &Scene) -> Output {
        let prefix = self.prefix_of(scene);
        let balance = self.balance(&prefix, &self.actions(&scene.loads));
        Output::Record(self.results(&balance, &scene.results, &self.reacted_by_ground(&scene.loads)))
    }

    /// What loads exert on links that act between these and the ground.
    fn reacted_by_ground(&self, loads: &[LoadId]) -> Vec<Action> {
        let reacted = loads.iter().copied().filter(|load| reacted_by_ground(self.model.load(*load).kind));
        self.actions(&reacted.collect::<Vec<_>>())
    }

    /// Scenes under other loads than all name their quantities apart.
    fn prefix_of(&self, scene: &Scene) -> String {
        match scene.loads.as_slice() {
            all if all.len() == self.model.loads.len() => String::new(),
            [one] => format!("{}_", self.model.load(*one).name),
            _ => format!("{}_", scene.name),
        }
    }

    /// What is wanted of a load case; of the loads in it, with what links get by those that the ground reacts.
    fn results(&self, balance: &Balance<'m, '_>, wanted: &[Wanted], reacted: &[Action]) -> Vec<Field> {
        let fields = wanted.iter().filter_map(|wanted| match *wanted {
            Wanted::Unknown(unknown) => Some(Field {
                name: self.model.unknown(unknown).name.clone(),
                doc: unknown_doc(self.model, unknown),
                value: Output::scalar(balance.effort(unknown), unknown_meaning(self.model, unknown)),
            }),
            Wanted::Joint(joint) => Some(Field {
                name: joint_name(self.model, joint).into(),
                doc: reaction_doc(self.model, joint),
                value: reaction(balance, joint),
            }),
            Wanted::Along(joint, link) => Some(Field {
                name: self.model.result_name(*wanted)?,
                doc: along_doc(self.model, joint, link),
                value: reaction_along(balance, joint, link),
            }),
            Wanted::About(joint, at) => Some(Field {
                name: self.model.result_name(*wanted)?,
                doc: about_doc(self.model, joint, at),
                value: couple_about(balance, joint, at),
            }),
            Wanted::OnGround(at) => {
                let mut resultant = Resultant::about(balance.placement, at);
                resultant.joints(balance);
                resultant.efforts(balance);
                resultant.opposite_of(reacted);
                let name = self.model.result_name(*wanted)?;
                let doc = format!("All that the linkage exerts on the ground: {}.", wrench_doc(self.model, at));
                Some(Field { value: resultant.output(&balance.name(&name)), name, doc })
            }
            Wanted::Power(of) => Some(self.power(*wanted, of, |unknown| balance.effort(unknown))?),
            _ => None,
        });
        fields.collect()
    }

    fn superposition(&self, scene: &Scene) -> Output {
        let fields = scene.loads.iter().map(|load| {
            let name = &self.model.load(*load).name;
            let cases = self.cases_of(*load);
            let one = |case: &Case, actions: &[Action]| {
                let balance = self.balance(&case_prefix(self.model, case), actions);
                let reacted = self.reacted_by_ground(&[*load]);
                let reacted = if reacted.is_empty() { &[] } else { actions };
                self.are_results(Output::Record(self.results(&balance, &scene.results, reacted)))
            };
            let value = match self.model.load(*load).kind {
                kind if kind.is_per_link() => {
                    let weights = cases.iter().filter_map(|(case, actions)| {
                        let link = &self.model.link(case.link?).name;
                        let doc = format!("By the {} of `{link}`.", part_of(kind));
                        Some(Field { name: link.text.clone(), doc, value: one(case, actions) })
                    });
                    Output::Record(weights.collect())
                }
                _ => cases.first().map_or_else(|| Output::Record(Vec::new()), |(case, actions)| one(case, actions)),
            };
            Field { name: name.text.clone(), doc: format!("By `{name}` alone."), value }
        });
        Output::Record(fields.collect())
    }

    /// The virtual motion of every unknown, each with the unknown.
    pub(super) fn motions(&self) -> Vec<(UnknownId, Motion<'m, '_>)> {
        let unknowns = (0..self.model.unknowns.len()).map(UnknownId::new);
        let single = self.model.unknowns.len() == 1;
        let prefix =
            |unknown: UnknownId| if single { String::new() } else { format!("{}_", self.model.unknown(unknown).name) };
        unknowns.map(|unknown| (unknown, self.motion(unknown, prefix(unknown)))).collect()
    }

    /// Some loads on the links, nothing solved.
    fn applied(&self, loads: &[LoadId]) -> Balance<'m, '_> {
        Balance::new(&self.assembly.placement, &self.assembly.pivots, String::new(), &self.actions(loads))
    }

    /// The effort that does as much work as the loads, with the opposite sign: loads near a link's other pin are carried there first. The works
    /// of a group's moments stand beside each other, since the rates of rotation of its links have factors in common.
    pub(super) fn effort_by_work(&self, motion: &Motion<'m, '_>, loads: &Balance<'m, '_>) -> Expr<'m> {
        let zero = self.model.graph.zero();
        let carried = motion.at_nearest_pins(loads);
        -self.groups.iter().fold(zero, |sum, group| {
            let [forces, moments] = group.links.iter().fold([zero; 2], |[forces, moments], link| {
                let [force, moment] = motion.power_of(&carried, *link);
                [forces + force, moments + moment]
            });
            sum + forces + moments
        })
    }

    /// D'Alembert's force and couple of a link, and the acceleration that makes them.
    fn inertia(&self, link: LinkId) -> (String, Output) {
        let model = self.model;
        let name = &model.link(link).name;
        let (acceleration, force, couple) = self.inertia_of(link);
        let (force_unit, moment_unit) = (Kind::Force.unit(&model.units), Kind::Moment.unit(&model.units));
        let unit = Kind::Acceleration.unit(&model.units);
        let fields = vec![
            Field::new(
                "acceleration",
                format!("Acceleration of the centre of mass, {unit}, ground axes."),
                Output::vector(acceleration, Meaning::Acceleration),
            ),
            Field::new("force", format!("−m a, {force_unit}, ground axes."), Output::vector(force, Meaning::Force)),
            Field::new(
                "couple",
                format!("−I α, {moment_unit}, counter-clockwise."),
                Output::scalar(couple, Meaning::Moment),
            ),
        ];
        (format!("Inertia of `{name}` by D'Alembert."), Output::Record(fields))
    }

    /// A link's mass, the acceleration of its centre in the axes in which it is found, and the angular one.
    fn mass_in_motion(&self, link: LinkId) -> Option<(Mass, Framed<'m>, Expr<'m>)> {
        let (mass, motion) = (self.model.link(link).mass?, self.posed.accelerations?);
        let at = self.posed.placement.carried(link, mass.centroid.vector(&self.model.graph));
        Some((mass, motion.of_place(link, at), motion.rate(link)))
    }

    /// Acceleration of the centre of mass, force and couple, ground axes.
    fn inertia_of(&self, link: LinkId) -> (Vector<'m>, Vector<'m>, Expr<'m>) {
        let (model, graph) = (self.model, &self.model.graph);
        let Some((mass, acceleration, rate)) = self.mass_in_motion(link) else {
            return (graph.zero_vector(), graph.zero_vector(), graph.zero());
        };
        let name = &model.link(link).name;
        let meaning = format!("acceleration of the centre of mass of {name}");
        let acceleration = acceleration.ground().named(&format!("a_G_{name}"), &meaning);
        let (force, couple) = by_dalembert(model, mass, acceleration, rate);
        (acceleration, force, couple)
    }

    /// The resultant of all links' inertia about a point: `Σ −m a`, `Σ r × (−m a) − I α`.
    fn shaking(&self, at: End) -> (String, Output) {
        let mut resultant = Resultant::about(self.posed.placement, at);
        for link in self.model.moving_links() {
            let Some((mass, acceleration, rate)) = self.mass_in_motion(link) else { continue };
            let (_, named, couple) = self.inertia_of(link);
            let components = by_dalembert(self.model, mass, acceleration.components, rate).0;
            let force = Framed { components, axes: acceleration.axes };
            resultant.inertia((link, mass.centroid.vector(&self.model.graph)), force, named, couple);
        }
        let name = self.model.result_name(Wanted::Shaking(at)).unwrap_or_default();
        let doc = format!("What the inertia of all links exerts: {}.", wrench_doc(self.model, at));
        (doc, resultant.output(&name))
    }

    /// The power of an unknown or of all: effort times the rate of the coordinate on which it works.
    fn power(&self, wanted: Wanted, of: Option<UnknownId>, effort: impl Fn(UnknownId) -> Expr<'m>) -> Option<Field> {
        let velocities = self.posed.velocities?;
        let all = (0..self.model.unknowns.len()).map(UnknownId::new).filter(|own| of.is_none_or(|of| of == *own));
        let power = all.map(|unknown| effort(unknown) * rate_of(velocities, unknown));
        let power = power.fold(self.model.graph.zero(), |sum, power| sum + power);
        let name = self.model.result_name(wanted)?;
        let unit = Kind::Moment.unit(&self.model.units);
        let doc = match of {
            Some(unknown) => format!("Power of `{}`, {unit}/s.", self.model.unknown(unknown).name),
            None => format!("Power that the efforts put in, {unit}/s."),
        };
        Some(Field { name, doc, value: Output::scalar(power, Meaning::Number) })
    }

    /// Where the force `−m a` alone does what force and couple do together: `h = I α/(m |a|)`, to the right of a where α is positive.
    fn offset(&self, link: LinkId) -> (String, Output) {
        let (model, graph) = (self.model, &self.model.graph);
        let name = &model.link(link).name;
        let unit = Kind::Length.unit(&model.units);
        let (acceleration, ..) = self.inertia_of(link);
        let (Some(mass), Some(motion)) = (model.link(link).mass, self.posed.accelerations) else {
            return (String::new(), Output::Record(Vec::new()));
        };
        let direction = graph.unit(acceleration).named_direction(&format!("a_G_{name}"), "");
        let failure = Failure::NoDirection { of: format!("the acceleration of the centre of mass of {name}") };
        let size = direction.dot(acceleration);
        let radius = graph.expr(mass.inertia) / graph.expr(mass.mass);
        let size = size.require_above(size, rounding_of(acceleration), failure);
        let distance = radius * motion.rate(link) / size;
        let distance = distance.named(format!("h_{name}"), format!("I α/(m |a|) of {name}"));
        let vector = -direction.perp().scaled(distance);
        let fields = vec![
            Field::new(
                "distance",
                format!("I α/(m |a|), {unit}: positive to the right of the acceleration."),
                Output::scalar(distance, Meaning::Length),
            ),
            Field::new(
                "vector",
                format!("From the centre of mass to the line of the force, {unit}, ground axes."),
                Output::vector(vector, Meaning::Length),
            ),
        ];
        (format!("Line of the single force that is equivalent to the inertia of `{name}`."), Output::Record(fields))
    }

    fn virtual_work(&self, scene: &Scene) -> Output {
        let motions = self.motions();
        let single = motions.len() == 1;
        self.model.graph.begin_section("Virtual work");
        let loads = self.applied(&scene.loads);
        let fields = scene.results.iter().filter_map(|wanted| match *wanted {
            Wanted::Unknown(unknown) => {
                let name = &self.model.unknown(unknown).name;
                let effort = self.effort_by_work(&motions[unknown.index()].1, &loads);
                let effort = effort.named(name.clone(), "−(Σ F·v + Σ M ω), at unit rate of its own coordinate");
                let value = Output::scalar(effort, unknown_meaning(self.model, unknown));
                Some(Field { name: name.clone(), doc: unknown_doc(self.model, unknown), value })
            }
            Wanted::Advantage(load) => {
                let value = if single {
                    self.advantage(&motions[0].1, load)
                } else {
                    let each = motions.iter().map(|(unknown, motion)| {
                        let unknown = &self.model.unknown(*unknown).name;
                        let doc = format!("Of `{unknown}`.");
                        Field { name: unknown.clone(), doc, value: self.advantage(motion, load) }
                    });
                    Output::Record(each.collect())
                };
                let doc = format!(
                    "Mechanical advantage: how much of `{}` a unit of effort holds.",
                    self.model.load(load).name
                );
                Some(Field { name: self.model.result_name(*wanted)?, doc, value })
            }
            Wanted::Power(of) => {
                self.power(*wanted, of, |unknown| self.effort_by_work(&motions[unknown.index()].1, &loads))
            }
            Wanted::Load(load) => {
                let name = self.model.load(load).name.text.clone();
                let doc = format!("Term of `{name}`: velocity along it for unit rate, and the work.");
                let value = if single {
                    self.terms(&motions[0].1, load)
                } else {
                    let each = motions.iter().map(|(unknown, motion)| {
                        let unknown = &self.model.unknown(*unknown).name;
                        let doc = format!("In the motion at unit rate of the coordinate of `{unknown}`.");
                        Field { name: unknown.clone(), doc, value: self.terms(motion, load) }
                    });
                    Output::Record(each.collect())
                };
                Some(Field { name, doc, value })
            }
            _ => None,
        });
        Output::Record(fields.collect())
    }

    /// Every method's answer beside the unreduced equations.
    fn verify(&self, scene: &Scene, (system, links): (&System, &[PlacedLink])) -> Output {
        let graph = &self.model.graph;
        let unknowns = |balance: &Balance<'m, '_>| -> Vec<Expr<'m>> {
            system.rows.iter().map(|row| unknown_of(balance, row.source)).collect()
        };
        let balance = self.balance(&self.prefix_of(scene), &self.actions(&scene.loads));
        let equilibrium = unknowns(&balance);
        let mut superposition = vec![graph.zero(); equilibrium.len()];
        for (case, actions) in scene.loads.iter().flat_map(|load| self.cases_of(*load)) {
            let part = unknowns(&self.balance(&case_prefix(self.model, case), actions));
            superposition.iter_mut().zip(part).for_each(|(sum, part)| *sum = *sum + part);
        }
        let motions = self.motions();
        let loads = self.applied(&scene.loads);
        let virtual_work = motions.iter().map(|(_, motion)| self.effort_by_work(motion, &loads).id()).collect();
        // The symbols of the equations are the coordinates that the pose gives.
        graph.begin_section("General equations");
        let placed = |symbol: Symbol| match symbol {
            Symbol::Coordinate(link, which) => Some(graph.expr(links[link.index()].coordinate(which))),
            Symbol::Moving(link, which, order) => Some(graph.expr(links[link.index()].moving(which, order)?)),
            _ => None,
        };
        let value = |node| graph.with_constants_together(graph.substituted(graph.expr(node), &placed));
        let lines = |exerted: &Exerted| {
            let first = 3 * (exerted.on.index() - 1);
            [(first, exerted.x), (first + 1, exerted.y), (first + 2, exerted.moment)]
        };
        let mut coefficients = Vec::new();
        for (column, row) in system.rows.iter().enumerate() {
            for (line, node) in row.exerts.iter().flat_map(lines) {
                let value = value(node);
                if !value.is_zero() {
                    coefficients.push((line, column, value.id()));
                }
            }
        }
        let mut exerted = vec![graph.zero(); equilibrium.len()];
        for case in system.cases.iter().filter(|case| scene.loads.contains(&case.case.load)) {
            for (line, node) in case.exerts.iter().flat_map(lines) {
                exerted[line] = exerted[line] + value(node);
            }
        }
        let moments = system.rows.iter().map(|row| is_moment(self.model, row.source)).collect();
        let ids = |values: Vec<Expr<'_>>| values.into_iter().map(Expr::id).collect();
        Output::Verification(Box::new(Comparison {
            coefficients,
            loads: ids(exerted),
            moments,
            equilibrium: ids(equilibrium),
            superposition: ids(superposition),
            virtual_work,
        }))
    }

    fn motion(&self, unknown: UnknownId, prefix: String) -> Motion<'m, '_> {
        let motion = Motion::of_unknown(&self.assembly.placement, &self.assembly.pivots, unknown, prefix);
        motion.through(self.groups, self.rules, self.sink)
    }

    /// What a load is over the effort that holds it, in size: the inverse of the velocity along it at unit rate.
    fn advantage(&self, motion: &Motion<'m, '_>, load: LoadId) -> Output {
        let (graph, name) = (&self.model.graph, &self.model.load(load).name);
        let Output::Term { velocity, .. } = self.terms(motion, load) else {
            return Output::scalar(graph.zero(), Meaning::Number);
        };
        let velocity = graph.expr(velocity);
        let pivot = motion.name(&format!("v_along_{name}"));
        let velocity = velocity.named(pivot.clone(), format!("velocity along {name}, at unit rate"));
        let directed = match self.model.load(load).kind {
            // A force that vanishes has no direction along which its point could move.
            LoadKind::Force { force, .. } => {
                let size = graph.expr(force.x).abs() + graph.expr(force.y).abs();
                let directed =
                    velocity.require_above(size, graph.zero(), Failure::NoDirection { of: name.text.clone() });
                if size.is_zero() {
                    // That is what is wrong, and not a velocity.
                    return Output::scalar(directed, Meaning::Number);
                }
                directed
            }
            _ => velocity,
        };
        let failure = Failure::DeadCentre { group: name.text.clone(), pivot };
        let limit = graph.epsilons(8) * velocity.magnitude_given(&mut self.unit_vectors());
        let divisor = directed.require_above(velocity.abs(), limit, failure);
        Output::scalar(graph.one() / divisor, Meaning::Number)
    }

    /// The term of a load; of gravity one for each link.
    fn terms(&self, motion: &Motion<'m, '_>, load: LoadId) -> Output {
        let cases = self.cases_of(load);
        let load_name = &self.model.load(load).name;
        let kind = self.model.load(load).kind;
        match kind {
            kind if kind.is_per_link() => {
                let each = cases.iter().filter_map(|(case, actions)| {
                    let link = &self.model.link(case.link?).name;
                    let doc = format!("Term of the {} of `{link}`.", part_of(kind));
                    Some(Field {
                        name: link.text.clone(),
                        doc,
                        value: term(motion, &format!("{load_name}_{link}"), kind, actions),
                    })
                });
                Output::Record(each.collect())
            }
            _ => cases.first().map_or_else(
                || Output::Record(Vec::new()),
                |(_, actions)| term(motion, &load_name.text, kind, actions),
            ),
        }
    }
}

/// The name of a joint.
pub(super) fn joint_of(model: &Model, joint: JointId) -> &str {
    joint_name(model, joint)
}

pub(super) fn of_spot<'m>(motion: &Motion<'m, '_>, spot: Spot) -> Framed<'m> {
    match spot {
        Spot::Joint(joint) => motion.of_joint(joint),
        Spot::Point(end) => motion.of_point(end),
    }
}

/// What the rounding of a vector may come to.
fn rounding_of(vector: Vector<'_>) -> Expr<'_> {
    vector.graph().epsilons(8) * (vector.x.magnitude() + vector.y.magnitude())
}

/// What a link has of a load that acts on each link.
fn part_of(kind: LoadKind) -> &'static str {
    if let LoadKind::Inertia = kind { "inertia" } else { "weight" }
}

/// Velocity along the load, and the work: `v = v·F/|F|`, `F v`; between two points the rate of their distance; of a moment the relative
/// rate of rotation, `M ω`.
fn term(motion: &Motion<'_, '_>, load: &str, kind: LoadKind, actions: &[Action]) -> Output {
    let graph = motion.graph();
    let name = format!("{}{load}", motion.prefix);
    let work = || actions.iter().fold(graph.zero(), |sum, action| sum + motion.power(action));
    match (kind, actions) {
        (
            LoadKind::Force { .. } | LoadKind::Gravity { .. } | LoadKind::Inertia,
            [Action::Force { link, at, force, frame }, couple @ ..],
        ) => {
            let velocity = motion.of_place(*link, motion.placement.carried(*link, at.vector(graph)));
            let velocity = velocity.along(motion.placement.direction(*frame));
            let velocity = velocity.named(&format!("v_{name}"), "velocity of its point, at unit rate");
            let force = motion.placement.carried(*frame, force.vector(graph));
            let along = velocity.dot(graph.unit(force));
            let work = couple.iter().fold(velocity.dot(force), |sum, couple| sum + motion.power(couple));
            Output::Term { velocity: along.id(), work: work.id(), meaning: Meaning::ForceTerm }
        }
        (LoadKind::Thrust { ends, .. } | LoadKind::Spring { ends, .. }, _) => {
            let [first, second] = ends.map(|end| motion.of_point(end));
            let velocity = motion.difference(&second, &first).ground();
            let velocity =
                velocity.named(&format!("v_{name}"), "velocity of its second point from the first, at unit rate");
            let along = velocity.dot(Line::between(&Posed::at_rest(motion.placement), load, ends).direction());
            // The force on one of the points, taken for the second; on the ground there is no action.
            let force = actions.iter().find_map(|action| match *action {
                Action::Force { link, force, .. } if link == ends[1].link => Some(force.vector(graph)),
                Action::Force { force, .. } if ends[1].link == GROUND => Some(-force.vector(graph)),
                _ => None,
            });
            let work = force.map_or_else(|| graph.zero(), |force| velocity.dot(force));
            Output::Term { velocity: along.id(), work: work.id(), meaning: Meaning::ForceTerm }
        }
        (LoadKind::Moment { on, from, .. }, _) => {
            let rate = from.map_or_else(|| motion.rate(on), |from| motion.rate(on) - motion.rate(from));
            Output::Term { velocity: rate.id(), work: work().id(), meaning: Meaning::MomentTerm }
        }
        (LoadKind::Torsion { on, from, .. }, _) => {
            let rate = motion.rate(on) - motion.rate(from);
            Output::Term { velocity: rate.id(), work: work().id(), meaning: Meaning::MomentTerm }
        }
        (LoadKind::Force { .. } | LoadKind::Gravity { .. } | LoadKind::Inertia, _) => {
            Output::Term { velocity: graph.zero().id(), work: work().id(), meaning: Meaning::ForceTerm }
        }
    }
}

/// A scalar unknown of the unreduced equations, as a load case's solution has it.
fn unknown_of<'m>(balance: &Balance<'m, '_>, source: Source) -> Expr<'m> {
    match source {
        Source::Joint(joint, component) => component_of(balance, joint, component),
        Source::Unknown(unknown) => balance.effort(unknown),
        Source::Drive(_) => balance.graph().zero(),
    }
}

/// A component of a joint's reaction.
fn component_of<'m>(balance: &Balance<'m, '_>, joint: JointId, component: Component) -> Expr<'m> {
    let reaction = balance.reaction(joint);
    match component {
        Component::X => reaction.force.ground().x,
        Component::Y => reaction.force.ground().y,
        Component::Normal => reaction.force.along(balance.placement.slide_direction(joint)).y,
        Component::Tangential => match balance.model().joint(joint).kind {
            JointKind::Gear(gear) => reaction.force.along(balance.placement.centre_line(&gear)).y,
            _ => balance.graph().zero(),
        },
        Component::Couple => reaction.couple.unwrap_or_else(|| balance.graph().zero()),
    }
}

fn is_moment(model: &Model, source: Source) -> bool {
    match source {
        Source::Joint(_, component) => component == Component::Couple,
        Source::Unknown(unknown) => unknown_meaning(model, unknown) == Meaning::Moment,
        Source::Drive(_) => false,
    }
}

fn case_prefix(model: &Model, case: &Case) -> String {
    let load = &model.load(case.load).name;
    match case.link {
        Some(link) => format!("{load}_{}_", model.link(link).name),
        None => format!("{load}_"),
    }
}

/// The reaction of a joint, in ground axes.
fn reaction(balance: &Balance<'_, '_>, joint: JointId) -> Output {
    let name = balance.name(joint_name(balance.model(), joint));
    let reaction = balance.reaction(joint);
    let force = reaction.force.ground().named_where_made(&name, &format!("{name} in ground axes"));
    let Some((ty, components)) = reaction_type(&balance.model().joint(joint).kind) else {
        return Output::vector(force, Meaning::Force);
    };
    let parts = components.iter().map(|c| (c.name(), component_of(balance, joint, *c).id())).collect();
    Output::Reaction { ty, force: [force.x.id(), force.y.id()], parts }
}

/// The type of a reaction that is more than a vector, and what it has beside the force.
pub(crate) fn reaction_type(kind: &JointKind) -> Option<(&'static str, &'static [Component])> {
    match kind {
        JointKind::Revolute => None,
        JointKind::Prismatic { .. } => Some(("SliderReaction", &[Component::Normal, Component::Couple])),
        JointKind::Weld { .. } => Some(("WeldReaction", &[Component::Couple])),
        JointKind::Slot { .. } => Some(("SlotReaction", &[Component::Normal])),
        JointKind::Gear(_) => Some(("GearReaction", &[Component::Tangential])),
    }
}

/// The reaction of a joint along and across the x axis of a link.
fn reaction_along(balance: &Balance<'_, '_>, joint: JointId, link: LinkId) -> Output {
    let resolved = balance.reaction(joint).force.along(balance.placement.frame(link));
    Output::Resolved([resolved.x.id(), resolved.y.id()])
}

/// The couple of a slide or a weld about a point: with the arm from there to its place, `C + arm × F`.
fn couple_about(balance: &Balance<'_, '_>, joint: JointId, at: End) -> Output {
    let reaction = balance.reaction(joint);
    let way = balance.placement.way(at, balance.model().joint(joint).place());
    let moment = way.resolved_along(reaction.force.axes).cross(reaction.force.components);
    let couple = reaction.couple.unwrap_or_else(|| balance.graph().zero()) + moment;
    Output::scalar(couple, Meaning::Moment)
}

fn along_doc(model: &Model, joint: JointId, link: LinkId) -> String {
    let data = model.joint(joint);
    let (from, to) = (&model.link(data.from.link).name, &model.link(data.to.link).name);
    let (force, link) = (Kind::Force.unit(&model.units), &model.link(link).name);
    format!("Force on `{to}` by `{from}` at `{}`, along and across `{link}`, {force}.", data.name)
}

/// A force, and a moment about a point.
fn wrench_doc(model: &Model, at: End) -> String {
    let (force, moment) = (Kind::Force.unit(&model.units), Kind::Moment.unit(&model.units));
    format!("force, {force}, ground axes, and moment about `{}`, {moment}", model.end_name(at))
}

fn about_doc(model: &Model, joint: JointId, at: End) -> String {
    let data = model.joint(joint);
    let (from, to) = (&model.link(data.from.link).name, &model.link(data.to.link).name);
    let (moment, at) = (Kind::Moment.unit(&model.units), model.end_name(at));
    format!("Couple on `{to}` by `{from}` at `{}`, about `{at}`, {moment}.", data.name)
}

pub(super) fn unknown_meaning(model: &Model, unknown: UnknownId) -> Meaning {
    match model.unknown(unknown).kind {
        UnknownKind::Torque(..) => Meaning::Moment,
        UnknownKind::Drive(drive) if model.drive(drive).turns => Meaning::Moment,
        UnknownKind::Force { .. } | UnknownKind::Thrust(_) | UnknownKind::Drive(_) => Meaning::Force,
    }
}

/// What an unknown is, in a sentence.
pub(crate) fn unknown_doc(model: &Model, unknown: UnknownId) -> String {
    let (force, moment) = (Kind::Force.unit(&model.units), Kind::Moment.unit(&model.units));
    let name = |link: crate::model::ids::LinkId| &model.link(link).name.text;
    match model.unknown(unknown).kind {
        UnknownKind::Torque(from, to) => {
            format!("Torque on `{}` by `{}`, {moment}, counter-clockwise.", name(to), name(from))
        }
        UnknownKind::Force { at, frame, .. } => {
            let turning = if frame == GROUND { String::new() } else { format!(", which turns with `{}`", name(frame)) };
            format!("Force on `{}` along its line{turning}, {force}.", model.end_name(at))
        }
        UnknownKind::Thrust([first, second]) => {
            let (first, second) = (model.end_name(first), model.end_name(second));
            format!("Thrust between `{first}` and `{second}`, {force}, positive where it pushes them apart.")
        }
        UnknownKind::Drive(drive) => {
            let joint = model.joint(model.drive(drive).joint);
            let (from, to) = (name(joint.from.link), name(joint.to.link));
            if model.drive(drive).turns {
                format!("Torque on `{to}` by `{from}` at `{}`, {moment}, counter-clockwise.", joint.name)
            } else {
                format!("Force on `{to}` by `{from}` along the {} `{}`, {force}.", joint.kind.noun(), joint.name)
            }
        }
    }
}

fn reaction_doc(model: &Model, joint: JointId) -> String {
    let (force, moment) = (Kind::Force.unit(&model.units), Kind::Moment.unit(&model.units));
    let data = model.joint(joint);
    let (from, to) = (&model.link(data.from.link).name, &model.link(data.to.link).name);
    match data.kind {
        JointKind::Revolute => format!("Force on `{to}` by `{from}`, {force}, ground axes."),
        JointKind::Prismatic { .. } | JointKind::Weld { .. } => {
            format!(
                "Force ({force}, ground axes) and couple ({moment}) on `{to}` by `{from}`, about `{}`.",
                model.end_name(data.place())
            )
        }
        JointKind::Slot { .. } => {
            format!("Force on `{to}` by `{from}` at `{}`, {force}, ground axes.", model.end_name(data.place()))
        }
        JointKind::Gear(_) => {
            format!("Force on `{to}` by `{from}` where the wheels touch, {force}, ground axes.")
        }
    }
}
