//! The derivation as text: free bodies, equilibrium equations, reduction, closed form.

use std::collections::{BTreeMap, BTreeSet};

use super::body::REQUIRED;
use super::docs::blocks;
use super::formula::{Formula, Nodes};
use super::functions::{body, prepare_program};
use super::types::load_doc;
use crate::Linkage;
use crate::diagnostics::count;
use crate::equations::joints::Component;
use crate::equations::{Exerted, Source};
use crate::graph::{Expr, NodeId, Op, Stage};
use crate::model::ids::{LinkId, UnknownId};
use crate::model::units::Kind;
use crate::model::{JointKind, LoadKind, Method};
use crate::plan::scenes::unknown_doc;
use crate::program::Program;

/// The derivation of a linkage as text.
#[must_use]
pub fn text(linkage: &Linkage) -> String {
    let model = &linkage.model;
    let mut text = format!("{}\n{}\n\n", model.name, "=".repeat(model.name.text.chars().count()));
    text.push_str(&mobility(linkage));
    text.push_str(&parts(linkage));
    text.push_str(&free_bodies(linkage));
    text.push_str(
        "Reduction\n---------\n\nThe equations fall apart into groups; each is solved by the rule of its class.\n\n",
    );
    text.push_str(&blocks(linkage));
    text.push('\n');
    text.push_str(&super::limits::text(linkage));
    text.push_str(&closed_forms(linkage));
    text
}

fn mobility(linkage: &Linkage) -> String {
    let model = &linkage.model;
    let moving = model.links.len() - 1;
    let constraints = linkage.system.rows.iter().filter(|row| matches!(row.source, Source::Joint(..))).count();
    format!(
        "{} links, {moving} of them moving; {} with {constraints} constraints: mobility 3·{moving} − {constraints} = {}\n\
         lengths in {}, forces in {}; the link that a reaction acts on stands behind the arrow\n\
         sin(link), cos(link): of the angle of the x axis of the link's own frame; link_sin, link_cos: of the direction that it carries\n{}\n",
        model.links.len(),
        count(model.joints.len(), "joint"),
        3 * moving - constraints,
        model.units.length.name,
        model.units.force.name,
        if model.moves() {
            "vx(link), ax(link), …: velocity and acceleration of the frame's origin; ω(link), α(link): of its angle\n"
        } else {
            ""
        },
    )
}

/// What there is: joints, unknowns, loads.
fn parts(linkage: &Linkage) -> String {
    let model = &linkage.model;
    let formula = Formula { model, terms: Nodes(&model.graph) };
    let joints = model.joints.iter().map(|joint| {
        let mut text = format!(
            "  {:<9} {}: {} -> {}",
            joint.kind.word(),
            joint.name,
            model.end_name(joint.from),
            model.end_name(joint.to)
        );
        if let Some((carrier, axis)) = joint.kind.line() {
            let (x, y) = (formula.of(axis.x), formula.of(axis.y));
            text.push_str(&format!(" along ({x}, {y}) of {}", model.link(carrier).name));
        }
        if let Some((_, angle)) = joint.kind.turn() {
            text.push_str(&format!(", at the angle {}", formula.of(angle)));
        }
        if let JointKind::Gear(gear) = joint.kind {
            let [first, second] = gear.radii.map(|radius| formula.of(radius));
            let (phase, arm) = (formula.of(gear.phase), &model.link(gear.arm[0].link).name);
            text.push_str(&format!(", radii {first} and {second}, phase {phase}, held apart by {arm}"));
            if !model.graph.expr(gear.incline).is_zero() {
                text.push_str(&format!(", tangent of the pressure angle {}", formula.of(gear.incline)));
            }
        }
        format!("{text}\n")
    });
    let plain = |sentence: String| sentence.replace('`', "");
    let unknowns = (0..model.unknowns.len()).map(UnknownId::new);
    let unknowns = unknowns.map(|unknown| {
        format!("  unknown   {}: {}\n", model.unknown(unknown).name, plain(unknown_doc(model, unknown)))
    });
    let loads = model.loads.iter().map(|load| {
        let value = match load.kind {
            LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
                let values = load.kind.values().into_iter();
                let values = values.map(|(name, value)| format!("{name} {}", formula.of(value)));
                format!(", {}", values.collect::<Vec<_>>().join(", "))
            }
            _ if load.kind.is_given_at_run_time(model) => String::new(),
            LoadKind::Force { force: pair, .. } | LoadKind::Gravity { acceleration: pair } => {
                format!(" = ({}, {})", formula.of(pair.x), formula.of(pair.y))
            }
            LoadKind::Moment { moment: value, .. } | LoadKind::Thrust { force: value, .. } => {
                format!(" = {}", formula.of(value))
            }
            LoadKind::Inertia => String::new(),
        };
        format!("  load      {}{value}: {}\n", load.name, plain(load_doc(model, load)))
    });
    let drives = model.drives.iter().map(|drive| {
        let kind = if drive.turns { "angle" } else { "travel" };
        format!("  drive     {}: {kind} of {}\n", drive.name, model.joint(drive.joint).name)
    });
    let masses = model.moving_links().filter_map(|link| {
        let mass = model.link(link).mass?;
        let [x, y, size, inertia] =
            [mass.centroid.x, mass.centroid.y, mass.mass, mass.inertia].map(|node| formula.of(node));
        let [unit, its] = [Kind::Mass, Kind::Inertia].map(|kind| kind.unit(&model.units));
        let name = &model.link(link).name;
        let about_it = if model.graph.expr(mass.inertia).is_zero() {
            String::new()
        } else {
            format!(", moment of inertia about it {inertia} {its}")
        };
        Some(format!("  mass      {name}: {size} {unit} at ({x}, {y}) of its frame{about_it}\n"))
    });
    joints.chain(drives).chain(masses).chain(unknowns).chain(loads).chain(["\n".to_owned()]).collect()
}

/// The equilibrium equations of every moving link: `3(l − 1)` in all.
fn free_bodies(linkage: &Linkage) -> String {
    let model = &linkage.model;
    let mut text = format!("Free bodies\n-----------\n\n{}", named_quantities(linkage));
    for link in model.moving_links() {
        let name = &model.link(link).name;
        let origin = origin_name(linkage, link);
        text.push_str(&format!("{name}\n"));
        let labels = ["ΣFx:".to_owned(), "ΣFy:".to_owned(), format!("ΣM({origin}):")];
        for (part, label) in labels.iter().enumerate() {
            let sum = equation(linkage, link, part);
            text.push_str(&format!("  {label:<9} {sum} = 0\n"));
        }
        text.push('\n');
    }
    text
}

/// What the loads at the links are made of, a line each.
fn named_quantities(linkage: &Linkage) -> String {
    let graph = &linkage.model.graph;
    let rows = linkage.system.rows.iter().flat_map(|row| &row.exerts);
    let exerted = rows.chain(linkage.system.cases.iter().flat_map(|case| &case.exerts));
    let mut open: Vec<NodeId> = exerted.flat_map(|exerted| [exerted.x, exerted.y, exerted.moment]).collect();
    let (mut seen, mut named) = (BTreeSet::new(), BTreeMap::new());
    while let Some(node) = open.pop() {
        if !seen.insert(node) || graph.stage(node) < Stage::Posed {
            continue;
        }
        if let (Op::Quantity(inner), Some(label)) = (graph.op(node), graph.label(node)) {
            named.insert(node, (label.name, inner));
        }
        open.extend(graph.op(node).operands());
    }
    let formula = Formula { model: &linkage.model, terms: Nodes(graph) };
    let lines = named.into_values().map(|(name, inner)| format!("  {name} = {}\n", formula.of(inner)));
    let lines: String = lines.collect();
    if lines.is_empty() { lines } else { format!("with\n{lines}\n") }
}

/// What stands at the origin of a link's frame: a point of it, or the frame's origin itself.
fn origin_name(linkage: &Linkage, link: LinkId) -> String {
    let model = &linkage.model;
    let at_origin = model.link(link).points.iter().find(|point| point.at.vector(&model.graph).is_zero());
    at_origin.map_or_else(|| "frame".to_owned(), |point| point.name.text.clone())
}

/// The sum of all terms of an equation of a link.
fn equation(linkage: &Linkage, link: LinkId, part: usize) -> String {
    let model = &linkage.model;
    // A load may exert a force on a link and a couple besides, as inertia does.
    let on_link = |exerts: &[Exerted]| -> Vec<Expr<'_>> {
        let exerted = exerts.iter().filter(|exerted| exerted.on == link);
        let parts = exerted.map(|exerted| model.graph.expr([exerted.x, exerted.y, exerted.moment][part]));
        parts.filter(|part| !part.is_zero()).collect()
    };
    let formula = Formula { model, terms: Nodes(&model.graph) };
    let mut terms: Vec<(bool, String)> = Vec::new();
    for row in &linkage.system.rows {
        let coefficient = on_link(&row.exerts).into_iter().fold(model.graph.zero(), |sum, part| sum + part);
        if coefficient.is_zero() {
            continue;
        }
        let name = match row.source {
            Source::Joint(joint, component) => reaction_name(&model.joint(joint).name.text, component),
            Source::Unknown(unknown) => model.unknown(unknown).name.clone(),
            Source::Drive(drive) => model.drive(drive).name.text.clone(),
        };
        terms.push(term(&formula, coefficient.id(), Some(&name)));
    }
    for case in &linkage.system.cases {
        terms.extend(on_link(&case.exerts).into_iter().map(|load| term(&formula, load.id(), None)));
    }
    let mut sum = String::new();
    for (index, (negative, text)) in terms.into_iter().enumerate() {
        let sign = match (index, negative) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        };
        sum.push_str(sign);
        sum.push_str(&text);
    }
    if sum.is_empty() { "0".into() } else { sum }
}

fn reaction_name(joint: &str, component: Component) -> String {
    format!("{joint}.{}", component.name())
}

/// A coefficient times an unknown, or a load's own term; the sign apart.
fn term(formula: &Formula<'_, Nodes<'_>>, node: NodeId, unknown: Option<&str>) -> (bool, String) {
    let graph = &formula.model.graph;
    let expr = graph.expr(node);
    let (negative, node) = match (graph.op(node), expr.sign()) {
        (Op::Neg(inner), _) => (true, inner),
        (_, Some(-1)) => (true, (-expr).id()),
        _ => (false, node),
    };
    let is_sum = matches!(graph.op(node), Op::Add(..) | Op::Sub(..));
    let text = formula.of(node);
    // A sum that is added needs no brackets.
    let text = if is_sum && (negative || unknown.is_some()) { format!("({text})") } else { text };
    let text = match unknown {
        Some(name) if graph.expr(node).is_one() => name.to_owned(),
        Some(name) => format!("{text}·{name}"),
        None => text,
    };
    (negative, text)
}

fn closed_forms(linkage: &Linkage) -> String {
    let model = &linkage.model;
    let mut text = String::new();
    if !model.params.is_empty() {
        text.push_str(&kept("prepared, from the parameters", linkage, &prepare_program(linkage)));
    }
    if let Some((heading, program)) = super::limits::closed_form(linkage) {
        text.push_str(&closed_form(&heading, program, body(linkage, program).equations(model)));
    }
    text.push_str(&kept("pose, from the drives", linkage, &linkage.functions.pose));
    let searches = model.graph.searches();
    for ((_, search), functions) in searches.iter().zip(&linkage.functions.searches) {
        let program = &functions.step;
        let heading = format!("{}, each step until nothing but rounding is open", search.name);
        text.push_str(&closed_form(&heading, program, super::search::step(linkage, search, program).equations(model)));
    }
    for (scene, functions) in model.scenes.iter().zip(&linkage.functions.scenes) {
        if scene.method != Method::Verify {
            let (heading, program) = (format!("scene {}, from a pose", scene.name), &functions.from_pose);
            text.push_str(&closed_form(&heading, program, body(linkage, program).equations(model)));
        }
    }
    for inverse in &linkage.inverses {
        let Some((scene, program)) = super::inverses::scene(inverse) else { continue };
        if !model.params.is_empty() {
            let heading = format!("prepared for the scene {}, from the parameters", scene.name);
            text.push_str(&kept(&heading, inverse, &prepare_program(inverse)));
        }
        let groups = super::docs::motion_blocks(inverse);
        let lines = groups.lines().map(str::to_owned).chain(body(inverse, program).equations(&inverse.model));
        text.push_str(&closed_form(&format!("scene {}, from what is wanted", scene.name), program, lines));
    }
    let limits = "\nLimits other than 0 are what rounding makes of zero: ε times the sizes of which the compared value is made.\n";
    let limits = if text.contains(REQUIRED) { limits } else { "" };
    format!("Closed forms\n------------\n{limits}{text}")
}

/// A program as text.
fn closed_form(heading: &str, program: &Program, lines: impl IntoIterator<Item = String>) -> String {
    let mut text = format!("\n{heading}: {}\n", program.counts());
    for line in lines {
        text.push_str(&format!("  {line}\n"));
    }
    text
}

/// A program of which others read what it finds, under the names by which they do.
fn kept(heading: &str, linkage: &Linkage, program: &Program) -> String {
    let body = body(linkage, program);
    closed_form(heading, program, [body.equations(&linkage.model), body.kept(&linkage.model)].concat())
}
