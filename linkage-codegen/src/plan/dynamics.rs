//! The reduced equation of motion `τ = M q̈ + h`: what the efforts are, for any accelerations of the drives.
//!
//! With `v_j`, `ω_j` the velocities of the links at unit rate of drive j, `v_i*`, `ω_i*` the virtual motion of unknown i, and `a₀`, `α₀` what
//! the accelerations are without those of the drives, virtual work in the motion of unknown i says
//! `M_ij = Σ (m v_i*·v_j + I ω_i* ω_j)` and `h_i = Σ (m a₀·v_i* + I α₀ ω_i*) − P_i`, with `P_i` the power of the loads.
//! Where the unknowns act at the drives, the virtual motions are those at unit rates: M is symmetric, and the mass of the kinetic energy
//! `T = ½ q̇ᵀ M q̇`.

use std::collections::BTreeMap;

use super::posed::Posed;
use super::scenes::{Forces, unknown_meaning};
use super::{Balance, Field, Meaning, Motion, Output};
use crate::equations::loads::{Action, cases_of, inertia_of};
use crate::graph::{Expr, NodeId, Order, Vector};
use crate::model::ids::{DriveId, LinkId, UnknownId};
use crate::model::units::Kind;
use crate::model::{Drive, LoadKind, Model, Part, Scene, UnknownKind, Wanted};

/// Rounding of a velocity, in epsilons of the sum of the magnitudes of its terms, unit vectors taken as a whole.
const ROUNDING: i64 = 8;

/// Velocities of a link in one motion.
struct Moving<'m> {
    /// Of the centre of mass and of the angle.
    parts: [Expr<'m>; 3],
    /// How large their rounding may be.
    rounding: [Expr<'m>; 3],
}

impl<'m> Forces<'_, 'm> {
    /// The parts of the equation that a scene asks for.
    pub(super) fn equation_of_motion(&self, scene: &Scene) -> Output {
        let (model, graph) = (self.model, &self.model.graph);
        let virtual_motions: Vec<Motion<'m, '_>> = self.motions().into_iter().map(|(_, motion)| motion).collect();
        let own = self.unit_motions();
        let drives = (0..model.drives.len()).map(DriveId::new);
        let units: Vec<&Motion<'m, '_>> = match &own {
            Some(own) => own.iter().collect(),
            None => drives.filter_map(|drive| virtual_motions.get(at_drive(model, drive)?.index())).collect(),
        };
        let masses = model.moved_masses(scene);
        let wanted = |part| scene.results.contains(&Wanted::Part(part));
        let bias = if wanted(Part::Bias) { self.bias(scene, &virtual_motions, &units, &masses) } else { Vec::new() };
        graph.begin_section("Equation of motion");
        let virtual_motions: Vec<&Motion<'m, '_>> = virtual_motions.iter().collect();
        let fields = scene.results.iter().filter_map(|wanted| {
            let Wanted::Part(part) = *wanted else { return None };
            let value = match part {
                Part::Mass => self.masses(&masses, &virtual_motions, &units, "M"),
                Part::Kinetic => self.masses(&masses, &units, &units, "M_kinetic"),
                Part::Rounding => self.rounding(&masses, &virtual_motions, &units),
                Part::Bias => column(&bias, unknown_meaning(model, UnknownId::new(0))),
            };
            Some(Field { name: part.name().to_owned(), doc: part_doc(model, part), value })
        });
        Output::Record(fields.collect())
    }

    /// The velocities at unit rate of each drive, unless these are the virtual motions.
    fn unit_motions(&self) -> Option<Vec<Motion<'m, '_>>> {
        let drives = || (0..self.model.drives.len()).map(DriveId::new);
        if drives().all(|drive| at_drive(self.model, drive).is_some()) {
            return None;
        }
        let motions = drives().map(|drive| {
            let prefix = format!("unit_{}_", self.model.drive(drive).name);
            let motion = Motion::of_drive(&self.assembly.placement, &self.assembly.pivots, drive, prefix);
            motion.through(&self.assembly.topology.motion, self.motion_rules, self.sink)
        });
        Some(motions.collect())
    }

    /// `h`: the efforts that balance loads and inertia as long as the drives do not accelerate.
    fn bias(
        &self,
        scene: &Scene,
        virtual_motions: &[Motion<'m, '_>],
        units: &[&Motion<'m, '_>],
        masses: &[LinkId],
    ) -> Vec<Expr<'m>> {
        let (model, graph) = (self.model, &self.model.graph);
        let (placement, pivots) = (&self.assembly.placement, &self.assembly.pivots);
        graph.begin_section("Velocities");
        let velocities = Motion::combined(units, placement, pivots);
        let accelerations = Motion::undriven_accelerations(&velocities);
        let accelerations = accelerations.through(&self.assembly.topology.motion, self.motion_rules, self.sink);
        let posed = Posed { placement, velocities: Some(&velocities), accelerations: Some(&accelerations) };
        graph.begin_section("Equation of motion");
        let others = scene.loads.iter().filter(|load| !matches!(model.load(**load).kind, LoadKind::Inertia));
        let applied = others.flat_map(|load| cases_of(&posed, *load)).flat_map(|(_, actions)| actions);
        let inertia = masses.iter().flat_map(|link| inertia_of(&posed, *link));
        let actions: Vec<Action> = applied.chain(inertia).collect();
        let all = Balance::new(placement, pivots, String::new(), &actions);
        let bias = virtual_motions.iter().map(|motion| {
            let effort = self.effort_by_work(motion, &all);
            effort.named(motion.name("h"), "−(Σ F·v + Σ M ω), at unit rate, with the inertia that is left without q̈")
        });
        bias.collect()
    }

    /// `Σ (m v_i·v_j + I ω_i ω_j)`; what is symmetric is computed once.
    fn masses(&self, masses: &[LinkId], rows: &[&Motion<'m, '_>], columns: &[&Motion<'m, '_>], name: &str) -> Output {
        self.matrix(rows, columns, (name, "Σ (m v·v + I ω ω), at unit rates"), |row, column| {
            let terms = masses.iter().map(|link| {
                let [own, other] = self.moving(*link, [row, column]);
                self.weighted(*link, [0, 1, 2].map(|part| own.parts[part] * other.parts[part]))
            });
            terms.fold(self.model.graph.zero(), |sum, term| sum + term)
        })
    }

    /// With velocities that may be off by δ, what `(|v_i| + δ_i)(|v_j| + δ_j)` is beyond `|v_i| |v_j|`.
    fn rounding(&self, masses: &[LinkId], rows: &[&Motion<'m, '_>], columns: &[&Motion<'m, '_>]) -> Output {
        let meaning = "what of M may be nothing but the rounding of velocities";
        self.matrix(rows, columns, ("rounding", meaning), |row, column| {
            let terms = masses.iter().map(|link| {
                let [own, other] = self.moving(*link, [row, column]);
                let parts = [0, 1, 2].map(|part| {
                    let [v, w] = [own.parts[part].abs(), other.parts[part].abs()];
                    v * other.rounding[part] + own.rounding[part] * (w + other.rounding[part])
                });
                self.weighted(*link, parts)
            });
            terms.fold(self.model.graph.zero(), |sum, term| sum + term)
        })
    }

    /// The entries for all unknowns and drives, each with a name.
    fn matrix(
        &self,
        rows: &[&Motion<'m, '_>],
        columns: &[&Motion<'m, '_>],
        (name, meaning): (&str, &str),
        entry: impl Fn(&Motion<'m, '_>, &Motion<'m, '_>) -> Expr<'m>,
    ) -> Output {
        let symmetric = rows.len() == columns.len() && rows.iter().zip(columns).all(|(a, b)| core::ptr::eq(*a, *b));
        let mut all: Vec<Vec<NodeId>> = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            let values = columns.iter().enumerate().map(|(j, column)| match all.get(j) {
                Some(above) if symmetric => above[i],
                _ => {
                    let drive = &self.model.drive(DriveId::new(j)).name;
                    let name = if columns.len() == 1 { name.to_owned() } else { format!("{name}_{drive}") };
                    entry(row, column).named(row.name(&name), meaning).id()
                }
            });
            all.push(values.collect());
        }
        match all.as_slice() {
            [row] if row.len() == 1 => Output::Scalar(row[0], Meaning::Mass),
            _ => Output::Matrix(all),
        }
    }

    /// Times mass, mass and moment of inertia of a link, in the units of the generated functions.
    fn weighted(&self, link: LinkId, [x, y, angle]: [Expr<'m>; 3]) -> Expr<'m> {
        let graph = &self.model.graph;
        let Some(mass) = self.model.link(link).mass else { return graph.zero() };
        let conversion = graph.constant(&self.model.units.force_per_mass_acceleration());
        conversion * graph.expr(mass.mass) * (x + y) + conversion * graph.expr(mass.inertia) * angle
    }

    /// How a link moves in two motions, along and across one direction.
    fn moving(&self, link: LinkId, motions: [&Motion<'m, '_>; 2]) -> [Moving<'m>; 2] {
        let (model, graph, placement) = (self.model, &self.model.graph, &self.assembly.placement);
        let at = match model.link(link).mass {
            Some(mass) => placement.carried(link, mass.centroid.vector(graph)),
            None => graph.zero_vector(),
        };
        let found = motions.map(|motion| motion.of_place(link, at));
        let shared = found[0].axes == found[1].axes;
        let resolved = found.map(|velocity| if shared { velocity.components } else { velocity.ground() });
        let mut known = self.unit_vectors();
        let name = &model.link(link).name;
        let mut of = |motion: &Motion<'m, '_>, velocity: Vector<'m>| {
            let meaning = format!("velocity of the centre of mass of {name}, at unit rate");
            let velocity = velocity.named(&motion.name(&format!("v_G_{name}")), &meaning);
            let parts = [velocity.x, velocity.y, motion.rate(link)];
            let rounding = parts.map(|part| graph.epsilons(ROUNDING) * part.magnitude_given(&mut known));
            Moving { parts, rounding }
        };
        [of(motions[0], resolved[0]), of(motions[1], resolved[1])]
    }

    /// The directions of links are as uncertain as a vector of length one, however small a component is.
    pub(super) fn unit_vectors(&self) -> BTreeMap<NodeId, Expr<'m>> {
        let (model, placement) = (self.model, &self.assembly.placement);
        let directions = model.moving_links().map(|link| placement.direction(link));
        let parts = directions.flat_map(|direction| [direction.x, direction.y]);
        parts.filter(|part| part.value().is_none()).map(|part| (part.id(), model.graph.one())).collect()
    }
}

/// The unknown that acts at a drive, in its sense: the effort of the drive, or the torque between the links that it turns.
fn at_drive(model: &Model, drive: DriveId) -> Option<UnknownId> {
    let data = model.drive(drive);
    let joint = model.joint(data.joint);
    let acts = |kind: UnknownKind| match kind {
        UnknownKind::Drive(own) => own == drive,
        UnknownKind::Torque(from, to) => data.turns && joint.from.link == from && joint.to.link == to,
        UnknownKind::Force { .. } | UnknownKind::Thrust(_) => false,
    };
    model.unknowns.iter().position(|unknown| acts(unknown.kind)).map(UnknownId::new)
}

fn column(values: &[Expr<'_>], meaning: Meaning) -> Output {
    match values {
        [value] => Output::scalar(*value, meaning),
        _ => Output::Column(values.iter().map(|value| value.id()).collect()),
    }
}

/// What a part of the equation is, in a sentence.
pub(crate) fn part_doc(model: &Model, part: Part) -> String {
    let at_drives = (0..model.drives.len()).all(|drive| at_drive(model, DriveId::new(drive)).is_some());
    let single = model.unknowns.len() == 1;
    let unit = match (single, model.drives.first()) {
        (true, Some(drive)) => {
            let turning = unknown_meaning(model, UnknownId::new(0)) == Meaning::Moment;
            let effort = if turning { Kind::Moment } else { Kind::Force }.unit(&model.units);
            let acceleration = Drive::kind_of(Order::Acceleration, drive.turns).unit(&model.units);
            [effort.clone(), format!("{effort} per {acceleration}")]
        }
        _ => ["a row for each unknown".to_owned(), "a row for each unknown, a column for each drive".to_owned()],
    };
    match part {
        Part::Mass if at_drives => {
            let symmetric = if single { "" } else { ", symmetric" };
            format!(
                "The efforts for unit accelerations, {}: the mass in the kinetic energy `½ q̇ᵀ M q̇`{symmetric} and positive, but it vanishes \
                 where no mass moves.",
                unit[1]
            )
        }
        Part::Mass => format!(
            "The efforts for unit accelerations, {}. The unknowns act elsewhere than at the drives: it is not the mass of the kinetic \
             energy.",
            unit[1]
        ),
        Part::Bias => format!(
            "The efforts without accelerations, {}: centripetal and Coriolis terms, and what balances the loads.",
            unit[0]
        ),
        Part::Rounding => "How much of `M` may be nothing but rounding.".to_owned(),
        Part::Kinetic => "The mass in the kinetic energy `½ q̇ᵀ M q̇`, for the drives' rates.".to_owned(),
    }
}
