//! The derivation as text: what stands in it is evaluated, and held against the equations that are solved.

use std::collections::{BTreeSet, HashMap};

use linkage_codegen::emit::equations;
use linkage_codegen::equations::Source;
use linkage_codegen::graph::{Coordinate, Order, Symbol};
use linkage_codegen::model::ids::{DriveId, LoadId, ParamId};
use linkage_codegen::{Linkage, analyse};

use crate::support::declarations::{given, linkages, poses};
use crate::support::general::{Coordinates, equations_at};
use crate::support::linkages::Random;
use crate::support::numbers::Double;
use crate::support::{Arguments, pose};

/// All that a text may name.
type Names = HashMap<String, f64>;

/// The sums that are printed for the free bodies are those of the general equations, whatever the reactions are.
#[test]
fn free_bodies_are_those_of_the_general_equations() {
    let compared: usize = linkages().iter().map(|(name, linkage)| assert_general(name, linkage)).sum();
    assert!(compared > 500, "{compared}");
}

/// A force of a spring is written by its tension, however long what that is made of.
#[test]
fn springs_and_dampers_between_moving_links_are_written_out() {
    let declaration = "mod engine; units { mm, N } ground { O: (0, 0) }
        link crank { O -> A: 40mm, K: (20mm, 30mm) } link rod { A -> B: 140mm, K: (45mm, 10mm) } link piston { B }
        mass rod: 0.62kg at (45mm, 0), inertia 1900kg*mm^2;
        revolute O: ground -> crank; revolute A: crank -> rod; revolute B: rod -> piston;
        prismatic G: ground.O -> piston.B along 0deg; drive theta: O; assemble B: ahead(A);
        load K: spring(crank.K, rod.K) { rate: 3N/m, free: 10cm, damping: 0.3N*s/mm };
        load L: torsion(crank -> rod) { rate: 2N*m/rad, free: 20deg, damping: 3N*mm*s/rad }; load I: inertia;
        scene held: equilibrium;";
    let linkage = analyse(declaration.parse().expect("tokens")).expect("a linkage");
    assert_general("engine", &linkage);
}

/// No closed form reads a name that is neither given nor found above it: what is prepared and kept is said under the name that others read.
#[test]
fn closed_forms_read_what_is_found_above_them() {
    let (mut looked_at, mut unknown) = (0, Vec::new());
    for (name, linkage) in linkages() {
        let text = equations(&linkage);
        let (_, forms) = text.split_once("Closed forms\n------------\n").expect("closed forms");
        let given = given_names(&linkage);
        // What a pose and a prepared linkage keep is read by all that follows.
        let (mut shared, mut own, mut keeps) = (BTreeSet::new(), BTreeSet::new(), false);
        for line in forms.lines() {
            if !line.is_empty() && !line.starts_with(' ') {
                let found = std::mem::take(&mut own);
                if keeps {
                    shared.extend(found);
                }
                keeps = line.starts_with("pose") || line.starts_with("prepared");
            }
            let Some(line) = line.strip_prefix("      ") else { continue };
            // What is required reads what is found as well.
            let (found, formula) = line.split_once(" = ").unwrap_or(("", line));
            // What a search finds has its own name there.
            let formula = formula.strip_prefix(found).filter(|rest| rest.starts_with(" by ")).unwrap_or(formula);
            for read in names_in(formula) {
                if !(given.contains(read) || shared.contains(read) || own.contains(read)) {
                    unknown.push(format!("{name}: `{read}` in{line}"));
                }
                looked_at += 1;
            }
            own.insert(found);
        }
    }
    assert!(unknown.is_empty(), "{}", unknown.join("\n"));
    assert!(looked_at > 5000, "{looked_at}");
}

/// A result stands under the heading of what asks for it, whatever other scene had made it before; a load's own contribution under that of
/// this load.
#[test]
fn values_stand_under_the_headings_of_their_own_scenes() {
    let (mut results, mut contributions) = (0, 0);
    for (name, linkage) in linkages() {
        let text = equations(&linkage);
        let loads: Vec<String> = linkage.model.loads.iter().map(|load| load.name.text.clone()).collect();
        let (mut of_scene, mut heading, mut meaning) = (false, "", "");
        for line in text.lines().filter(|line| !line.is_empty()) {
            let words = line.trim_start();
            match line.len() - words.len() {
                0 => of_scene = words.starts_with("scene"),
                _ if !of_scene => {}
                2 => heading = words,
                4 => meaning = words,
                6 if meaning == "a result" => {
                    let is_others = heading.starts_with("Group") || heading.starts_with("Load");
                    assert!(!is_others, "{name}: {words} under {heading}");
                    results += 1;
                }
                6 => {
                    let Some((_, case)) = heading.trim_end_matches(':').split_once(": forces by ") else { continue };
                    let is_of = |load: &&String| words.starts_with(&format!("{load}_"));
                    let Some(load) = loads.iter().filter(is_of).max_by_key(|load| load.len()) else { continue };
                    assert!(case.starts_with(load.as_str()), "{name}: {words} under {heading}");
                    contributions += 1;
                }
                _ => {}
            }
        }
    }
    assert!(results > 50 && contributions > 50, "{results} {contributions}");
}

/// What the functions of a linkage have as arguments.
fn given_names(linkage: &Linkage) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for model in linkage.inverses.iter().chain([linkage]).map(|linkage| &linkage.model) {
        for drive in &model.drives {
            names.insert(drive.name.text.clone());
            names.extend([Order::Rate, Order::Acceleration].map(|order| drive.motion_name(order)));
        }
        names.extend(model.params.iter().map(|param| param.name.text.clone()));
        names.extend(model.closures.iter().map(|closure| format!("side_{}", model.joint(closure.joint).name)));
        for load in &model.loads {
            let values = (0..4).map(|part| load.kind.value_name(part));
            names.extend(values.map(|value| load.value_name(value)));
        }
        names.extend(model.graph.searches().into_iter().map(|(_, search)| search.name));
    }
    names
}

/// The names of values in a formula: neither functions nor words.
fn names_in(formula: &str) -> impl Iterator<Item = &str> {
    const WORDS: [&str; 16] = [
        "where", "else", "and", "unknown", "of", "by", "smallest", "pivot", "over", "the", "size", "its", "terms",
        "what", "stays", "open",
    ];
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let words = formula.split(move |c: char| !is_part(c)).filter(|word| word.starts_with(char::is_alphabetic));
    words.filter(move |word| {
        let behind = word.as_ptr().addr() - formula.as_ptr().addr() + word.len();
        !WORDS.contains(word) && !formula[behind..].starts_with('(')
    })
}

/// Of a linkage: how many sums were compared.
fn assert_general(name: &str, linkage: &Linkage) -> usize {
    let text = equations(linkage);
    let mut compared = 0;
    for drives in poses(linkage) {
        let arguments = Arguments { drives, ..given(linkage) };
        let kept = pose::<Double>(linkage, &arguments).expect("a pose");
        let coordinates = Coordinates::at(linkage, &arguments, &kept);
        let general = equations_at(&coordinates);
        let mut random = Random(7);
        let reactions: Vec<f64> = general.sources.iter().map(|_| random.range(-100.0, 100.0)).collect();
        let mut names = known(linkage, &coordinates);
        names.extend(general.sources.iter().map(|source| name_of(linkage, *source)).zip(reactions.iter().copied()));
        let (bodies, sums) = free_bodies(&text, &mut names);
        let moving: Vec<&str> = linkage.model.links.iter().skip(1).map(|link| link.name.text.as_str()).collect();
        assert_eq!(bodies, moving, "{name}");
        for (line, (text, found)) in sums.iter().enumerate() {
            let terms = general.matrix[line].iter().zip(&reactions).map(|(of, reaction)| of.0 * reaction);
            let terms: Vec<f64> = terms.chain(general.cases.iter().map(|(_, exerted)| exerted[line].0)).collect();
            let (sum, size) = terms.iter().fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
            assert!((found - sum).abs() <= 1e-12 * size, "{name}: {found:e} for {sum:e}: {text}");
            compared += 1;
        }
    }
    compared
}

/// Coordinates, rates, loads and parameters by the names that they have in the text.
fn known(linkage: &Linkage, pose: &Coordinates<'_, Double>) -> Names {
    let model = &linkage.model;
    let mut names = Names::new();
    for link in model.moving_links() {
        let name = &model.link(link).name;
        let whiches = [Coordinate::X, Coordinate::Y, Coordinate::Angle, Coordinate::Cos, Coordinate::Sin];
        for (which, letters) in whiches.into_iter().zip(["x", "y", "θ", "cos", "sin"]) {
            names.insert(format!("{letters}({name})"), pose.of(link, which).0);
        }
        for (order, letters) in [(Order::Rate, ["vx", "vy", "ω"]), (Order::Acceleration, ["ax", "ay", "α"])] {
            for (which, letters) in whiches.into_iter().zip(letters) {
                if let Some(node) = linkage.plan.links[link.index()].moving(which, order) {
                    names.insert(format!("{letters}({name})"), pose.value(node).0);
                }
            }
        }
    }
    for (index, drive) in model.drives.iter().enumerate() {
        let id = DriveId::new(index);
        names.insert(drive.name.text.clone(), pose.arguments.of(Symbol::Drive(id)));
        for order in [Order::Rate, Order::Acceleration] {
            names.insert(drive.motion_name(order), pose.arguments.of(Symbol::Driven(id, order)));
        }
    }
    for (index, param) in model.params.iter().enumerate() {
        names.insert(param.name.text.clone(), pose.arguments.of(Symbol::Parameter(ParamId::new(index))));
    }
    for (index, load) in model.loads.iter().enumerate() {
        for part in 0..4 {
            let value = load.kind.value_name(part);
            let dot = if value.is_empty() { "" } else { "." };
            let symbol = Symbol::Load(LoadId::new(index), part);
            names.entry(format!("{}{dot}{value}", load.name)).or_insert_with(|| pose.arguments.of(symbol));
        }
    }
    names
}

fn name_of(linkage: &Linkage, source: Source) -> String {
    match source {
        Source::Joint(joint, component) => format!("{}.{}", linkage.model.joint(joint).name, component.name()),
        Source::Unknown(unknown) => linkage.model.unknown(unknown).name.clone(),
        Source::Drive(drive) => linkage.model.drive(drive).name.text.clone(),
    }
}

/// The bodies of a derivation, and its sums with their values. What they are made of becomes known on the way.
fn free_bodies<'t>(text: &'t str, names: &mut Names) -> (Vec<&'t str>, Vec<(&'t str, f64)>) {
    let (_, part) = text.split_once("Free bodies\n-----------\n\n").expect("free bodies");
    let (part, _) = part.split_once("\nReduction\n").expect("a reduction");
    let (mut bodies, mut sums, mut open) = (Vec::new(), Vec::new(), Vec::new());
    for line in part.lines() {
        match line.strip_prefix("  ") {
            None if line.is_empty() || line == "with" => {}
            None => bodies.push(line),
            Some(line) => match line.trim_start_matches(['Σ', 'F', 'M']).split_once(": ") {
                Some((_, sum)) => sums.push(sum.strip_suffix(" = 0").expect("an equation").trim()),
                None => open.push(line.split_once(" = ").expect("a quantity")),
            },
        }
    }
    // In no order: each may be made of others.
    while !open.is_empty() {
        let before = open.len();
        open.retain(|(name, formula)| match Reader::value(formula, names) {
            Ok(value) => {
                names.insert((*name).to_owned(), value);
                false
            }
            Err(_) => true,
        });
        assert!(open.len() < before, "{open:?} cannot be evaluated");
    }
    let value = |sum: &&'t str| Reader::value(sum, names).unwrap_or_else(|unknown| panic!("no {unknown}: {sum}"));
    let values: Vec<f64> = sums.iter().map(value).collect();
    (bodies, sums.into_iter().zip(values).collect())
}

/// Reads a formula as it is printed.
struct Reader<'a> {
    rest: &'a str,
    names: &'a Names,
}

impl<'a> Reader<'a> {
    /// The value of a formula, or what in it is not known.
    fn value(text: &'a str, names: &'a Names) -> Result<f64, String> {
        let mut reader = Self { rest: text, names };
        let value = reader.choice()?;
        if reader.rest.is_empty() { Ok(value) } else { Err(reader.rest.to_owned()) }
    }

    fn takes(&mut self, sign: &str) -> bool {
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn expect(&mut self, sign: &str) -> Result<(), String> {
        if self.takes(sign) { Ok(()) } else { Err(format!("{sign} before {}", self.rest)) }
    }

    /// `a where b > c and d > e, else 0`
    fn choice(&mut self) -> Result<f64, String> {
        let value = self.sum()?;
        if !self.takes(" where ") {
            return Ok(value);
        }
        let mut holds = true;
        loop {
            let left = self.sum()?;
            self.expect(" > ")?;
            holds &= left > self.sum()?;
            if !self.takes(" and ") {
                break;
            }
        }
        self.expect(", else 0")?;
        Ok(if holds { value } else { 0.0 })
    }

    fn sum(&mut self) -> Result<f64, String> {
        let mut sum = self.product()?;
        loop {
            if self.takes(" + ") {
                sum += self.product()?;
            } else if self.takes(" − ") {
                sum -= self.product()?;
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self) -> Result<f64, String> {
        if self.takes("−") {
            return Ok(-self.product()?);
        }
        let mut product = self.atom()?;
        loop {
            if self.takes("·") {
                product *= self.atom()?;
            } else if self.takes("/") {
                product /= self.atom()?;
            } else {
                return Ok(product);
            }
        }
    }

    /// `|(x, y)|` behind its first stroke, if that is what stands there.
    fn size_of_vector(&mut self) -> Option<f64> {
        let mut ahead = Reader { rest: self.rest.strip_prefix('(')?, names: self.names };
        let x = ahead.choice().ok().filter(|_| ahead.takes(", "))?;
        let y = ahead.choice().ok().filter(|_| ahead.takes(")|"))?;
        self.rest = ahead.rest;
        Some(x.hypot(y))
    }

    fn atom(&mut self) -> Result<f64, String> {
        if self.takes("(") {
            let value = self.choice()?;
            self.expect(")")?;
            return Ok(value);
        }
        if self.takes("|") {
            if let Some(size) = self.size_of_vector() {
                return Ok(size);
            }
            let value = self.choice()?;
            self.expect("|")?;
            return Ok(value.abs());
        }
        if self.takes("atan2(") {
            let y = self.choice()?;
            self.expect(", ")?;
            let x = self.choice()?;
            self.expect(")")?;
            return Ok(y.atan2(x));
        }
        if self.takes("√(") {
            let value = self.choice()?;
            self.expect(")")?;
            return Ok(value.sqrt());
        }
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let end = self.rest.find(|c: char| !is_part(c)).unwrap_or(self.rest.len());
        // The exponent of a number may have a sign.
        let exponent = self.rest[..end].ends_with('e') && self.rest.starts_with(|c: char| c.is_ascii_digit());
        let end = if exponent {
            let digits = self.rest[end..].strip_prefix('-').unwrap_or_default();
            let count = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
            end + 1 + count
        } else {
            end
        };
        let (word, rest) = self.rest.split_at(end);
        if let Ok(number) = word.parse() {
            self.rest = rest;
            return Ok(number);
        }
        // A coordinate of a link, or a name.
        let called = rest.strip_prefix('(').and_then(|inner| inner.split_once(')'));
        let coordinate = called.and_then(|(inner, after)| Some((*self.names.get(&format!("{word}({inner})"))?, after)));
        let named = || Some((*self.names.get(word)?, rest));
        let (value, rest) = coordinate.or_else(named).ok_or_else(|| self.rest.to_owned())?;
        self.rest = rest;
        Ok(value)
    }
}
