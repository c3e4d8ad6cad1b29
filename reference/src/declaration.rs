//! A file as a declaration of `linkage!`.
//!
//! Names of a file may be anything and may meet each other; in a declaration all items share one namespace. So each gets a prefix
//! with its number: the link `crank` is `L0_crank`, its point `A` `P1_A`, the joint `A` `J1_A`. All numbers are taken as SI: a
//! consistent set of units gives consistent results.

use linkage_codegen::diagnostics::Sink;
use linkage_codegen::graph::{NodeValues, Symbol};
use linkage_codegen::model::ids::{GROUND, LinkId};
use linkage_codegen::topology::Topology;
use linkage_codegen::{model, syntax};

use crate::file::{Answers, Body, Coordinate, Effort, End, File, Given, Joint, JointKind, LoadKind, Place};
use crate::gears;
use crate::number::{Mode, Number, Raw};

/// The point at the origin of each link's frame: answers say where that is.
pub(crate) const ORIGIN: &str = "origin";
/// All loads at once.
pub(crate) const ALL: &str = "all";
/// Each load by itself.
pub(crate) const PARTS: &str = "parts";
/// The efforts by virtual work.
pub(crate) const WORK: &str = "work";
/// The scene of the reduced equation of motion.
pub(crate) const CONTROL: &str = "control";
/// Where the links are.
pub(crate) const PLACES: &str = "places";
/// Reactions along and across the links that the file says.
pub(crate) const RESOLVED: &str = "resolved";
/// All loads at once, at all positions of a sweep.
pub(crate) const CYCLE: &str = "cycle";
/// How the links move, of a file that moves.
pub(crate) const SPEEDS: &str = "speeds";
/// Their accelerations.
pub(crate) const ACCELERATIONS: &str = "accelerations";
/// Before the name of a link: the line of its inertia.
pub(crate) const OFFSET: &str = "offset_";
/// The resultant of inertia, of a file that moves.
pub(crate) const SHAKING: &str = "shaking_";
/// The point of the ground at its origin.
pub(crate) const GROUND_ORIGIN: &str = "ground_origin";
/// Powers of the efforts, of a file that moves.
pub(crate) const POWERS: &str = "powers";
/// The load that gravity is.
pub(crate) const WEIGHT: &str = "W";
/// The load that inertia is.
pub(crate) const INERTIA: &str = "I";
/// The point at the centre of mass of each link.
pub(crate) const CENTROID: &str = "centroid";

/// The names of one kind of item: in the file, and declared.
#[derive(Debug, Default)]
pub(crate) struct Names(Vec<(String, String)>);

impl Names {
    fn of<'a>(letter: char, names: impl Iterator<Item = &'a str>) -> Self {
        Self(names.enumerate().map(|(index, name)| (name.to_owned(), declared(letter, index, name))).collect())
    }

    /// The declared name.
    pub(crate) fn find(&self, name: &str) -> Result<&str, String> {
        let found = self.0.iter().find(|(own, _)| own == name);
        found.map(|(_, declared)| declared.as_str()).ok_or_else(|| format!("there is no `{name}`"))
    }

    /// The name in the file.
    pub(crate) fn original(&self, declared: &str) -> Option<&str> {
        self.0.iter().find_map(|(own, name)| (name == declared).then_some(own.as_str()))
    }
}

fn declared(letter: char, index: usize, name: &str) -> String {
    let safe: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    format!("{letter}{index}_{safe}")
}

/// A declaration but for the closures, which the compiler asks for.
#[derive(Debug)]
pub(crate) struct Declaration {
    items: Vec<String>,
    pub(crate) links: Names,
    pub(crate) joints: Names,
    pub(crate) loads: Names,
    /// The unknowns, in the order of the inputs.
    pub(crate) unknowns: Vec<String>,
    /// The arguments at each position: only one if the file has no sweep.
    pub(crate) positions: Vec<Vec<f64>>,
    /// Rate and acceleration of each drive.
    pub(crate) motion: Vec<[f64; 2]>,
    /// Whether there is a resultant of inertia: whether anything that moves has a mass.
    pub(crate) shakes: bool,
    /// The loads that are given at run time, as expressions for each position.
    pub(crate) run_time_loads: Vec<(String, Vec<String>)>,
}

impl Declaration {
    pub(crate) fn of(file: &File) -> Result<Self, String> {
        Writer::new(file).write()
    }

    /// With closures, as a whole, but for some items.
    pub(crate) fn text(&self, closures: &[String], without: &[String]) -> String {
        let kept = self.items.iter().filter(|item| !without.contains(item));
        let items = kept.chain(closures).map(|item| format!("    {item}\n"));
        format!("    mod mechanism;\n{}", items.collect::<String>())
    }
}

struct Writer<'a> {
    file: &'a File,
    links: Names,
    joints: Names,
    loads: Names,
    /// Of each link, the ground first: what is known of its points, and their declared names.
    points: Vec<Vec<(Place, String)>>,
}

impl<'a> Writer<'a> {
    fn new(file: &'a File) -> Self {
        let links = Names::of('L', file.links.iter().map(|(name, _)| name));
        let joints = Names::of('J', file.joints.iter().map(|joint| joint.name.as_str()));
        let loads = Names::of('F', file.loads.iter().map(|load| load.name.as_str()));
        let bodies = std::iter::once(&file.ground).chain(file.links.iter().map(|(_, body)| body));
        let named = |body: &Body| {
            let names = body.points.iter().enumerate();
            names.map(|(index, (name, _))| (Place::Named(name.into()), declared('P', index, name))).collect()
        };
        Self { file, links, joints, loads, points: bodies.map(named).collect() }
    }

    fn number(&self, raw: &Raw) -> Result<Number, String> {
        Number::new(raw, self.file.number_mode)
    }

    fn quantity(&self, raw: &Raw, unit: &str) -> Result<String, String> {
        Ok(self.number(raw)?.in_unit(unit))
    }

    fn vector(&self, [x, y]: &[Raw; 2], unit: &str) -> Result<String, String> {
        Ok(format!("({}, {})", self.quantity(x, unit)?, self.quantity(y, unit)?))
    }

    fn link(&self, name: &str) -> Result<String, String> {
        if name == "ground" { Ok("ground".into()) } else { self.links.find(name).map(str::to_owned) }
    }

    /// A frame: `own` stands for the link on which a force acts.
    fn frame(&self, frame: Option<&str>, own: &str) -> Result<String, String> {
        self.link(match frame {
            Some("link") => own,
            Some(frame) => frame,
            None => "ground",
        })
    }

    /// A point, which is declared if it is given by coordinates.
    fn point(&mut self, link: &str, place: &Place) -> Result<String, String> {
        let index = match link {
            "ground" => 0,
            _ => {
                1 + self.file.links.iter().position(|(name, _)| name == link).ok_or(format!("there is no `{link}`"))?
            }
        };
        let points = &mut self.points[index];
        let name = match (points.iter().find(|(own, _)| own == place), place) {
            (Some((_, name)), _) => name.clone(),
            (None, Place::Named(name)) => return Err(format!("`{link}` has no point `{name}`")),
            (None, Place::At(_)) => {
                let name = declared('P', points.len(), "at");
                points.push((place.clone(), name.clone()));
                name
            }
        };
        Ok(format!("{}.{name}", self.link(link)?))
    }

    fn end(&mut self, End(link, place): &End) -> Result<String, String> {
        self.point(link, place)
    }

    fn write(mut self) -> Result<Declaration, String> {
        let mut items = Vec::new();
        for joint in &self.file.joints {
            items.push(self.joint(joint)?);
        }
        let unknowns = self.inputs(&mut items)?;
        let shakes = moves(self.file) && self.weighty()?;
        let run_time_loads = self.loads(&mut items)?;
        self.masses(&mut items)?;
        let results = |points: &[&str]| {
            let of = |link: &str| points.iter().map(|point| format!("{link}.{point}")).collect::<Vec<_>>();
            self.links.0.iter().flat_map(|(_, link)| of(link)).collect::<Vec<_>>().join(", ")
        };
        items.push(self.places()?);
        if moves(self.file) {
            let moved = results(&[ORIGIN, CENTROID, "angle"]);
            items.push(format!("scene {SPEEDS}: velocity -> ({moved});"));
            items.push(format!("scene {ACCELERATIONS}: acceleration -> ({moved});"));
            for (link, name) in &self.links.0 {
                let known = |answers: &Answers| answers.inertia_offset.get(link).is_some();
                if self.file.answers().any(|answers| known(answers) || is_pure_couple(self.file, answers, link)) {
                    items.push(line_of(name));
                }
            }
        }
        if moves(self.file) {
            let powers: Vec<String> = unknowns.iter().map(|unknown| format!("power({unknown})")).collect();
            items.push(format!("scene {POWERS}: equilibrium -> ({}, power);", powers.join(", ")));
            if shakes {
                items.push(format!("scene {SHAKING}: acceleration -> (shaking(ground.{GROUND_ORIGIN}));"));
            }
        }
        items.push(format!("scene {ALL}: equilibrium;"));
        if self.file.sweep.is_some() {
            items.push(format!("scene {CYCLE}: sweep({ALL});"));
        }
        items.extend(self.resolved()?);
        items.push(format!("scene {PARTS}: superposition;"));
        if shakes && self.file.include_inertia {
            items.push(format!("scene {CONTROL}: motion -> (M, h, rounding, M_kinetic);"));
        }
        items.push(format!("scene {WORK}: virtual_work;"));
        // Points last: those that are given by coordinates where they are used are known only now.
        let mut all = self.bodies()?;
        all.append(&mut items);
        self.turns(&mut all)?;
        let positions = self.positions()?;
        let motion = self.motion()?;
        let Self { links, joints, loads, .. } = self;
        Ok(Declaration { items: all, links, joints, loads, unknowns, positions, motion, shakes, run_time_loads })
    }

    /// Where the links are, and all of their points of which the file has answers.
    fn places(&self) -> Result<String, String> {
        let mut results = Vec::new();
        for (link, name) in &self.links.0 {
            results.extend([ORIGIN, CENTROID, "angle"].map(|point| format!("{name}.{point}")));
            let known = self.file.answers().find_map(|answers| answers.points.get(link));
            for (point, _) in known.iter().flat_map(|known| known.iter()) {
                results.push(format!("{name}.{}", point_of(self.file, link, point)?));
            }
        }
        Ok(format!("scene {PLACES}: position -> ({});", results.join(", ")))
    }

    /// The reactions that the file resolves along links; along the ground they are as they are.
    fn resolved(&self) -> Result<Option<String>, String> {
        let mut results: Vec<String> = Vec::new();
        for (joint, resolved) in self.file.answers().flat_map(|answers| answers.along.iter()) {
            let result = format!("{} along {}", self.joints.find(joint)?, self.link(&resolved.link)?);
            if resolved.link != "ground" && !results.contains(&result) {
                results.push(result);
            }
        }
        Ok((!results.is_empty()).then(|| format!("scene {RESOLVED}: equilibrium -> ({});", results.join(", "))))
    }

    fn bodies(&self) -> Result<Vec<String>, String> {
        let bodies = std::iter::once(("ground", &self.file.ground)).chain(self.file.links.iter());
        let body = |((name, body), points): ((&str, &Body), &Vec<(Place, String)>)| {
            let place = |(place, declared): &(Place, String)| {
                let at = match place {
                    Place::Named(name) => body.points.get(name).ok_or(format!("no point `{name}`"))?,
                    Place::At(at) => at,
                };
                Ok(format!("{declared}: {}", self.vector(at, "m")?))
            };
            let mut places: Vec<String> = points.iter().map(place).collect::<Result<_, String>>()?;
            if name == "ground" {
                places.push(format!("{GROUND_ORIGIN}: (0, 0)"));
                return Ok(format!("ground {{ {} }}", places.join(", ")));
            }
            places.push(format!("{ORIGIN}: (0, 0)"));
            let centroid = match &body.centroid {
                Some(Place::At(at)) => self.vector(at, "m")?,
                Some(Place::Named(point)) => {
                    self.vector(body.points.get(point).ok_or(format!("no point `{point}`"))?, "m")?
                }
                None => "(0, 0)".to_owned(),
            };
            places.push(format!("{CENTROID}: {centroid}"));
            Ok(format!("link {} {{ {} }}", self.link(name)?, places.join(", ")))
        };
        bodies.zip(&self.points).map(body).collect()
    }

    fn joint(&mut self, joint: &Joint) -> Result<String, String> {
        let name = self.joints.find(&joint.name)?.to_owned();
        let carrier = self.link(&joint.a.0)?;
        let ends = format!("{name}: {} -> {}", self.end(&joint.a)?, self.end(&joint.b)?);
        let missing = |what: &str| format!("the joint `{}` has no {what}", joint.name);
        let along = || -> Result<String, String> {
            let [x, y] = joint.axis.as_ref().ok_or_else(|| missing("axis"))?;
            Ok(format!("along ({}, {}) of {carrier}", self.number(x)?.bare(), self.number(y)?.bare()))
        };
        let angle = || -> Result<String, String> {
            let angle = joint.angle.as_ref().map(|angle| self.quantity(angle, "rad")).transpose()?;
            Ok(angle.map_or_else(String::new, |angle| format!(", angle {angle}")))
        };
        let length = |raw: Option<&Raw>, what: &str| self.quantity(raw.ok_or_else(|| missing(what))?, "m");
        Ok(match joint.kind {
            JointKind::Revolute => format!("revolute {ends};"),
            JointKind::Prismatic => format!("prismatic {ends} {}{};", along()?, angle()?),
            JointKind::PinInSlot => format!("slot {ends} {};", along()?),
            JointKind::Weld => format!("weld {ends}{};", angle()?),
            JointKind::Gear => {
                let radii = [length(joint.ra.as_ref(), "ra")?, length(joint.rb.as_ref(), "rb")?];
                let mut text = format!("gear {ends}, radii ({}, {})", radii[0], radii[1]);
                if joint.internal {
                    text.push_str(", internal");
                }
                let phase = joint.phase.as_ref().map(|phase| self.quantity(phase, "m")).transpose()?;
                let turns = gears::turns(self.file, joint).filter(|turns| *turns != 0).map(|turns| {
                    let sign = if joint.internal { '-' } else { '+' };
                    format!("{}*pi*({} {sign} {})", 2 * turns, radii[0], radii[1])
                });
                let phase: Vec<String> = phase.into_iter().chain(turns).collect();
                if !phase.is_empty() {
                    text.push_str(&format!(", phase {}", phase.join(" + ")));
                }
                if let Some(angle) = &joint.pressure_angle {
                    text.push_str(&format!(", pressure_angle {}", self.quantity(angle, "rad")?));
                }
                if let Some(flank) = joint.flank {
                    text.push_str(if flank > 0 { ", flank left" } else { ", flank right" });
                }
                text + ";"
            }
        })
    }

    /// Drives and unknowns. Without any effort that acts elsewhere, each is the one at its driven joint.
    fn inputs(&mut self, items: &mut Vec<String>) -> Result<Vec<String>, String> {
        let elsewhere = self.file.inputs.iter().any(|input| input.effort.is_some());
        let mut unknowns = Vec::new();
        for (index, input) in self.file.inputs.iter().enumerate() {
            let joint = self.file.joints.iter().find(|joint| joint.name == input.joint);
            let joint = joint.ok_or_else(|| format!("there is no joint `{}`", input.joint))?;
            let coordinate = match (joint.kind, input.coord) {
                (JointKind::PinInSlot, Coordinate::Angle) => ".angle",
                (JointKind::PinInSlot, Coordinate::Displacement) => ".travel",
                _ => "",
            };
            items.push(format!("drive D{index}: {}{coordinate};", self.joints.find(&joint.name)?));
            if elsewhere {
                items.push(format!("unknown E{index}: {};", self.effort(input.effort.as_ref(), &format!("D{index}"))?));
                unknowns.push(format!("E{index}"));
            } else {
                unknowns.push(format!("effort_D{index}"));
            }
        }
        Ok(unknowns)
    }

    /// An effort that acts elsewhere, or that at its drive.
    fn effort(&mut self, effort: Option<&Effort>, drive: &str) -> Result<String, String> {
        Ok(match effort {
            Some(Effort::Moment { link, reaction_link }) => {
                let from = reaction_link.as_deref().unwrap_or("ground");
                format!("torque({} -> {})", self.link(from)?, self.link(link)?)
            }
            Some(Effort::Force { link, point, direction: [x, y], frame }) => {
                let frame = self.frame(frame.as_deref(), link)?;
                let at = self.point(link, point)?;
                format!("force({at}) along ({}, {}) of {frame}", self.number(x)?.bare(), self.number(y)?.bare())
            }
            Some(Effort::Axial { a, b }) => format!("thrust({}, {})", self.end(a)?, self.end(b)?),
            None => format!("effort({drive})"),
        })
    }

    /// Loads: constants, but for those that have a value at each position.
    fn loads(&mut self, items: &mut Vec<String>) -> Result<Vec<(String, Vec<String>)>, String> {
        let mut run_time = Vec::new();
        let series = self.file.sweep.as_ref().map_or(&[][..], |sweep| &sweep.load);
        for load in &self.file.loads {
            let name = self.loads.find(&load.name)?.to_owned();
            let given = series.iter().find(|series| series.name == load.name);
            if let Some(series) = given {
                let field = match load.kind {
                    LoadKind::Force { .. } | LoadKind::Axial { .. } => "force",
                    LoadKind::Moment { .. } => "moment",
                    LoadKind::Spring { .. } | LoadKind::TorsionSpring { .. } => "none",
                };
                if series.field != field {
                    return Err(format!("`{}` of `{}` at each position has no words", series.field, series.name));
                }
                if Some(series.values.len()) != self.file.sweep.as_ref().map(|sweep| sweep.results.len()) {
                    return Err(format!("`{}` has not one value for each position", series.name));
                }
                let values = series.values.iter().map(|value| self.at_run_time(value)).collect::<Result<_, _>>()?;
                run_time.push((name.clone(), values));
            }
            let load = self.load(&load.kind, given.is_none())?;
            items.push(format!("load {name}: {load};"));
        }
        if let Some(unknown) = series.iter().find(|s| self.loads.find(&s.name).is_err()) {
            return Err(format!("there is no load `{}`", unknown.name));
        }
        Ok(run_time)
    }

    fn at_run_time(&self, given: &Given) -> Result<String, String> {
        Ok(match given {
            Given::Scalar(value) => format!("{:?}f64", self.number(value)?.value),
            Given::Vector([x, y]) => {
                format!("Vector2::new({:?}f64, {:?}f64)", self.number(x)?.value, self.number(y)?.value)
            }
        })
    }

    fn load(&mut self, load: &LoadKind, constant: bool) -> Result<String, String> {
        let value = |text: String| if constant { format!(" = {text}") } else { String::new() };
        // What does not move is not damped.
        let damped = moves(self.file) && is_damped(load);
        Ok(match load {
            LoadKind::Force { link, point, force, frame } => {
                let frame = self.frame(frame.as_deref(), link)?;
                let axes = if frame == "ground" { String::new() } else { format!(" in {frame}") };
                format!("force({}){axes}{}", self.point(link, point)?, value(self.vector(force, "N")?))
            }
            LoadKind::Moment { link, moment, reaction_link } => {
                let from = match reaction_link {
                    Some(from) => format!("{} -> ", self.link(from)?),
                    None => String::new(),
                };
                format!("moment({from}{}){}", self.link(link)?, value(self.quantity(moment, "N*m")?))
            }
            LoadKind::Axial { a, b, force } => {
                format!("thrust({}, {}){}", self.end(a)?, self.end(b)?, value(self.quantity(force, "N")?))
            }
            LoadKind::Spring { a, b, stiffness, free_length, damping, preload } => {
                let fields = self.fields(&[
                    ("rate", stiffness.as_ref(), "N/m"),
                    ("free", free_length.as_ref(), "m"),
                    ("preload", preload.as_ref(), "N"),
                    ("damping", damping.as_ref().filter(|_| damped), "N*s/m"),
                ])?;
                format!("spring({}, {}) {{ {fields} }}", self.end(a)?, self.end(b)?)
            }
            LoadKind::TorsionSpring { a, b, stiffness, free_angle, damping } => {
                let fields = self.fields(&[
                    ("rate", stiffness.as_ref(), "N*m/rad"),
                    ("free", free_angle.as_ref(), "rad"),
                    ("damping", damping.as_ref().filter(|_| damped), "N*m*s/rad"),
                ])?;
                format!("torsion({} -> {}) {{ {fields} }}", self.link(a)?, self.link(b)?)
            }
        })
    }

    /// Of torsion springs that are wound by more than half a turn, near to which angle they stand without what the inputs turn: as the
    /// guess has it. Where inputs or gears tell the angle, which the compiler knows, there is nothing to say.
    fn turns(&self, items: &mut [String]) -> Result<(), String> {
        let torsion = |load: &LoadKind| match load {
            LoadKind::TorsionSpring { a, b, free_angle, .. } => Some((a.clone(), b.clone(), free_angle.clone())),
            _ => None,
        };
        let springs = self.file.loads.iter().filter_map(|load| Some((load, torsion(&load.kind)?)));
        let springs: Vec<_> = springs.collect();
        if springs.is_empty() {
            return Ok(());
        }
        let text = format!("mod mechanism; {}", items.concat());
        let sink = Sink::default();
        let model = text.parse().ok().and_then(|tokens| syntax::parse(tokens, &sink));
        let Some(model) = model.map(|ast| model::resolve(&ast, &sink)) else { return Ok(()) };
        let topology = if sink.is_clean() { Topology::of(&model, &sink) } else { None };
        let Some(topology) = topology else { return Ok(()) };
        let geared = topology.geared(&model);
        let inputs = self.file.inputs.iter().map(|input| self.number(&input.value).map(|value| value.value));
        let inputs: Vec<f64> = inputs.collect::<Result<_, _>>()?;
        for (load, (a, b, free)) in springs {
            let id = |name: &str| -> Result<LinkId, String> {
                let name = self.link(name)?;
                let found = model.links.iter().position(|link| link.name.text == name);
                found.map(LinkId::new).ok_or_else(|| format!("there is no link `{name}`"))
            };
            let (from, on) = (id(&a)?, id(&b)?);
            if model.driven_angle(from, on).is_some() || geared.contains(&from) || geared.contains(&on) {
                continue;
            }
            let angle = |link: &str| match self.file.guess.get(link) {
                Some([_, _, angle]) => self.number(angle).map(|angle| angle.value),
                None => Ok(0.0),
            };
            let relative = angle(&b)? - angle(&a)?;
            let free = free.map_or(Ok(0.0), |free| self.number(&free).map(|free| free.value))?;
            if (relative - free).abs() < 3.0 {
                continue;
            }
            let driven = |link: LinkId| {
                let known = |symbol| match symbol {
                    Symbol::Drive(drive) => inputs.get(drive.index()).copied().unwrap_or(f64::NAN),
                    _ => f64::NAN,
                };
                let driven = model.driven_angle(GROUND, link);
                driven.map_or(0.0, |[driven, _]| model.graph.evaluate(driven.id(), &known, &mut NodeValues::default()))
            };
            let near = relative + driven(from) - driven(on);
            let start = format!("load {}: torsion(", self.loads.find(&load.name)?);
            let Some(item) = items.iter_mut().find(|item| item.starts_with(&start)) else { continue };
            if let Some(fields) = item.strip_suffix(" };") {
                *item = format!("{fields}, near: {near:?}rad }};");
            }
        }
        Ok(())
    }

    /// The fields of a spring. What it must have is zero if the file leaves it out.
    fn fields(&self, fields: &[(&str, Option<&Raw>, &str)]) -> Result<String, String> {
        let written = fields.iter().filter_map(|(name, raw, unit)| match raw {
            Some(raw) => Some(self.quantity(raw, unit).map(|value| format!("{name}: {value}"))),
            None => matches!(*name, "rate" | "free").then(|| Ok(format!("{name}: 0"))),
        });
        Ok(written.collect::<Result<Vec<_>, String>>()?.join(", "))
    }

    /// Masses, and the weight of what has one.
    fn masses(&mut self, items: &mut Vec<String>) -> Result<(), String> {
        let mut weighty = false;
        for (name, body) in self.file.links.iter() {
            let Some(mass) = body.mass.as_ref().map(|mass| self.number(mass)).transpose()? else { continue };
            if mass.is_zero() {
                if body.inertia.as_ref().map(|i| self.number(i)).transpose()?.is_some_and(|i| !i.is_zero()) {
                    return Err(format!("`{name}` has a moment of inertia without a mass"));
                }
                continue;
            }
            weighty = true;
            let inertia = match &body.inertia {
                Some(inertia) => format!(", inertia {}", self.quantity(inertia, "kg*m^2")?),
                None => String::new(),
            };
            items.push(format!("mass {}: {} at {CENTROID}{inertia};", self.link(name)?, mass.in_unit("kg")));
        }
        if weighty && moves(self.file) && self.file.include_inertia {
            items.push(format!("load {INERTIA}: inertia;"));
        }
        if let Some(gravity) = self.file.gravity.as_ref().filter(|_| weighty) {
            items.push(format!("load {WEIGHT}: gravity = {};", self.vector(gravity, "m/s^2")?));
        }
        Ok(())
    }

    /// Whether any link has a mass.
    fn weighty(&self) -> Result<bool, String> {
        let masses = self.file.links.iter().filter_map(|(_, body)| body.mass.as_ref());
        masses.map(|mass| self.number(mass)).try_fold(false, |any, mass| Ok(any || !mass?.is_zero()))
    }

    fn motion(&self) -> Result<Vec<[f64; 2]>, String> {
        let value = |raw: Option<&Raw>| raw.map_or(Ok(0.0), |raw| self.number(raw).map(|number| number.value));
        self.file.inputs.iter().map(|input| Ok([value(input.rate.as_ref())?, value(input.acc.as_ref())?])).collect()
    }

    fn positions(&self) -> Result<Vec<Vec<f64>>, String> {
        let own = self.file.inputs.iter().map(|input| Ok(self.number(&input.value)?.value));
        let own = own.collect::<Result<Vec<f64>, String>>()?;
        let Some(sweep) = &self.file.sweep else { return Ok(vec![own]) };
        if sweep.input >= own.len() {
            return Err(format!("there is no input {}", sweep.input));
        }
        let position = |value: &Raw| {
            let mut all = own.clone();
            all[sweep.input] = self.number(value)?.value;
            Ok(all)
        };
        sweep.results.iter().map(|result| position(&result.value)).collect()
    }
}

fn is_zero(raw: Option<&Raw>) -> bool {
    raw.is_none_or(|raw| Number::new(raw, Mode::Decimal).is_ok_and(|number| number.is_zero()))
}

fn is_damped(load: &LoadKind) -> bool {
    match load {
        LoadKind::Spring { damping, .. } | LoadKind::TorsionSpring { damping, .. } => !is_zero(damping.as_ref()),
        _ => false,
    }
}

/// The scene of the line of a link's inertia.
pub(crate) fn line_of(link: &str) -> String {
    format!("scene {OFFSET}{link}: acceleration -> (offset({link}));")
}

/// Whether the inertia of a link is known to be a couple alone: then no single force does the same.
pub(crate) fn is_pure_couple(file: &File, answers: &Answers, link: &str) -> bool {
    let heavy = file.links.get(link).is_some_and(|body| !is_zero(body.mass.as_ref()));
    let rests = answers.acceleration.get(link).and_then(|motion| motion.centroid.as_ref());
    heavy && rests.is_some_and(|at| at.iter().all(|number| number == "0")) && answers.inertia_offset.get(link).is_none()
}

/// Whether anything moves.
pub(crate) fn moves(file: &File) -> bool {
    file.inputs.iter().any(|input| !is_zero(input.rate.as_ref()) || !is_zero(input.acc.as_ref()))
}

/// The declared name of a link's point.
pub(crate) fn point_of(file: &File, link: &str, point: &str) -> Result<String, String> {
    let index = file.links.get(link).and_then(|body| body.points.iter().position(|(own, _)| own == point));
    index.map(|index| declared('P', index, point)).ok_or_else(|| format!("`{link}` has no point `{point}`"))
}

/// The file's joint of this name.
pub(crate) fn joint_of<'a>(file: &'a File, names: &Names, declared: &str) -> Option<&'a Joint> {
    let original = names.original(declared)?;
    file.joints.iter().find(|joint| joint.name == original)
}
