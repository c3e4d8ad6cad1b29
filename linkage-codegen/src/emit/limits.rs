//! What is known of four-bars and slider-cranks: as constants or a function, and as a section of the derivation.

use rustc_hash::FxHashMap;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::body::Body;
use super::docs;
use super::formula::{Formula, Nodes, number_text};
use super::functions::{body, given_params};
use super::literals::{ident, signed_literal};
use super::types::{has_params, scalar};
use crate::Linkage;
use crate::graph::number::Number;
use crate::graph::{NodeId, Scalar};
use crate::limits::{
    DrivenSlide, Extreme, FourBar, Inversion, Known, KnownPosition, KnownRange, Limits, Loop, Possible, Posture, Shape,
    SliderCrank, Stroke, Turning, outlines,
};
use crate::model::{JointKind, Model};
use crate::program::Program;

/// `Limits`, and `LIMITS` or `Limits::of`; nothing for a linkage without such loops.
pub(super) fn tokens(linkage: &Linkage, runtime: &TokenStream) -> TokenStream {
    let Limits { loops, prepare } = &linkage.limits;
    if loops.is_empty() {
        return TokenStream::new();
    }
    let scalar = scalar(&linkage.model);
    let fields = loops.iter().map(|found| {
        let (name, ty, doc) = (ident(&found.name), type_of(&found.shape), format!(" {}.", capitalised(&found.title)));
        quote!(#[doc = #doc] pub #name: limits::#ty<#scalar>)
    });
    let values = if has_params(linkage) {
        prepared(linkage, prepare.as_ref())
    } else {
        let values = loops.iter().map(|found| {
            let (name, value) = (ident(&found.name), constant(linkage, found));
            quote!(#name: #value)
        });
        quote! {
            /// How far each loop's driver can go, where its output is at a dead centre, how well it transmits.
            pub const LIMITS: Limits = Limits { #(#values),* };
        }
    };
    let doc = " What is known of every four-bar and slider-crank: each named after the joint at which it is assembled";
    let chosen = linkage.model.given_closures().next().map_or(".", |_| ", and after its side if that is an argument.");
    let doc = format!("{doc}{chosen}");
    quote! {
        use #runtime::limits;

        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Limits { #(#fields),* }
        #values
    }
}

/// The same names without values.
pub(super) fn fallback(model: &Model, runtime: &TokenStream) -> TokenStream {
    let (scalar, loops) = (scalar(model), outlines(model));
    if loops.is_empty() {
        return TokenStream::new();
    }
    let fields = loops.iter().map(|(name, ty)| {
        let (name, ty) = (ident(name), ident(ty));
        quote!(pub #name: limits::#ty<#scalar>)
    });
    // A constant is worked out even if nobody reads it.
    let nothing = loops.iter().map(|(name, ty)| {
        let (name, value) = (ident(name), nothing(ty));
        quote!(#name: #value)
    });
    let value = if model.params.is_empty() {
        quote!(pub const LIMITS: Limits = Limits { #(#nothing),* };)
    } else {
        quote!(impl Limits { pub fn of(params: &Params) -> Result<Self, Error> { loop {} } })
    };
    quote! {
        use #runtime::limits;
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Limits { #(#fields),* }
        #value
    }
}

/// A loop of which nothing is known.
fn nothing(ty: &str) -> TokenStream {
    let range = quote!(range: limits::DriverRange::Unlimited, dead_centres: [None, None]);
    let angle = quote!(limits::Transmission { angle: 0.0, at: 0.0 });
    match ty {
        "FourBar" => {
            let class = quote!(class: limits::Grashof::ChangePoint);
            quote!(limits::FourBar { #class, #range, swing: None, transmission: [#angle, #angle] })
        }
        "SliderCrank" => {
            let inversion = quote!(inversion: limits::Inversion::OnFrame);
            quote!(limits::SliderCrank { #inversion, #range, stroke: None, transmission: None })
        }
        _ => quote!(limits::DrivenSlide { range: limits::DriverRange::Unlimited }),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn type_of(shape: &Shape) -> Ident {
    ident(match shape {
        Shape::FourBar(_) => "FourBar",
        Shape::SliderCrank(_) => "SliderCrank",
        Shape::DrivenSlide(_) => "DrivenSlide",
    })
}

fn inversion(slider_crank: &SliderCrank) -> TokenStream {
    let name = ident(match slider_crank.inversion {
        Inversion::OnFrame => "OnFrame",
        Inversion::OnCrank => "OnCrank",
        Inversion::Opposite => "Opposite",
    });
    quote!(limits::Inversion::#name)
}

fn posture(posture: Posture) -> TokenStream {
    let name = ident(posture.name());
    quote!(limits::Posture::#name)
}

/// A loop as a struct of literals.
fn constant(linkage: &Linkage, found: &Loop) -> TokenStream {
    let literals = Literals { scalar: linkage.model.graph.scalar() };
    found.known.as_ref().map_or_else(TokenStream::new, |known| literals.of(&found.shape, known))
}

struct Literals {
    scalar: Scalar,
}

impl Literals {
    fn of(&self, shape: &Shape, known: &Known) -> TokenStream {
        let range = self.range(&known.range);
        let [first, second] =
            known.dead_centres.each_ref().map(|dead| optional(dead.as_ref().map(|position| self.position(position))));
        let stroke = optional(known.stroke.as_ref().map(|stroke| {
            let (extent, ratio) = (self.number(&stroke.extent), self.number(&stroke.time_ratio));
            quote!(limits::Stroke { extent: #extent, time_ratio: #ratio })
        }));
        let transmission = known.transmission.as_ref().map(|both| {
            let [least, greatest] = both.each_ref().map(|one| {
                let (angle, at) = (self.number(&one.angle), self.number(&one.at));
                quote!(limits::Transmission { angle: #angle, at: #at })
            });
            quote!([#least, #greatest])
        });
        match shape {
            Shape::FourBar(_) => {
                let class = ident(known.class.map_or("ChangePoint", crate::limits::Grashof::name));
                four_bar(&quote!(limits::Grashof::#class), &range, &[first, second], &stroke, transmission.as_ref())
            }
            Shape::SliderCrank(shape) => {
                let (inversion, transmission) = (inversion(shape), optional(transmission));
                slider_crank(&inversion, &range, &[first, second], &stroke, &transmission)
            }
            Shape::DrivenSlide(_) => quote!(limits::DrivenSlide { range: #range }),
        }
    }

    fn number(&self, number: &Number) -> TokenStream {
        signed_literal(number, self.scalar)
    }

    fn position(&self, position: &KnownPosition) -> TokenStream {
        let (at, joint, posture) = (self.number(&position.at), &position.joint, posture(position.posture));
        quote!(limits::Position { at: #at, joint: #joint, posture: #posture })
    }

    fn range(&self, range: &KnownRange) -> TokenStream {
        let interval = |[from, to]: &[KnownPosition; 2]| {
            let (from, to) = (self.position(from), self.position(to));
            quote!(limits::Interval { from: #from, to: #to })
        };
        match range {
            KnownRange::Unlimited => quote!(limits::DriverRange::Unlimited),
            KnownRange::One(one) => {
                let one = interval(one);
                quote!(limits::DriverRange::One(#one))
            }
            KnownRange::Two([first, second]) => {
                let (first, second) = (interval(first), interval(second));
                quote!(limits::DriverRange::Two([#first, #second]))
            }
        }
    }
}

/// What is known of a four-bar.
fn four_bar(
    class: &TokenStream,
    range: &TokenStream,
    [first, second]: &[TokenStream; 2],
    swing: &TokenStream,
    transmission: Option<&TokenStream>,
) -> TokenStream {
    quote! {
        limits::FourBar {
            class: #class,
            range: #range,
            dead_centres: [#first, #second],
            swing: #swing,
            transmission: #transmission,
        }
    }
}

/// What is known of a slider-crank.
fn slider_crank(
    inversion: &TokenStream,
    range: &TokenStream,
    [first, second]: &[TokenStream; 2],
    stroke: &TokenStream,
    transmission: &TokenStream,
) -> TokenStream {
    quote! {
        limits::SliderCrank {
            inversion: #inversion,
            range: #range,
            dead_centres: [#first, #second],
            stroke: #stroke,
            transmission: #transmission,
        }
    }
}

fn optional(value: Option<TokenStream>) -> TokenStream {
    value.map_or_else(|| quote!(None), |value| quote!(Some(#value)))
}

/// `Limits::of`.
fn prepared(linkage: &Linkage, program: Option<&Program>) -> TokenStream {
    let none = Program::default();
    let program = program.unwrap_or(&none);
    let (statements, body) = body(linkage, program).statements();
    let values = Values::new(linkage, program, &body);
    let loops = linkage.limits.loops.iter().map(|found| {
        let name = ident(&found.name);
        let value = if found.known.is_some() { constant(linkage, found) } else { values.of(&found.shape) };
        quote!(#name: #value)
    });
    let given = given_params(linkage);
    let lines = docs::function(
        linkage,
        "How far each loop's driver can go, where its output is at a dead centre, how well it transmits.",
        &[],
        program,
        &[],
    );
    quote! {
        impl Limits {
            #lines
            pub fn of(params: &Params) -> Result<Self, Error> {
                #given
                #statements
                Ok(Self { #(#loops),* })
            }
        }
    }
}

/// The values of a program by the nodes that they are of.
struct Values {
    of: FxHashMap<NodeId, TokenStream>,
}

impl Values {
    fn new(linkage: &Linkage, program: &Program, body: &Body<'_>) -> Self {
        let open = linkage.limits.loops.iter().filter(|found| found.known.is_none());
        let nodes = open.flat_map(|found| found.shape.nodes());
        Self { of: nodes.zip(program.outputs.iter().map(|(_, value)| body.value(*value))).collect() }
    }

    fn value(&self, node: NodeId) -> TokenStream {
        self.of.get(&node).cloned().unwrap_or_else(|| quote!(0.0))
    }

    fn all(&self, nodes: &[NodeId]) -> TokenStream {
        let values = nodes.iter().map(|node| self.value(*node));
        quote!([#(#values),*])
    }

    fn of(&self, shape: &Shape) -> TokenStream {
        match shape {
            Shape::FourBar(FourBar { balances, range, dead_centres, swing, transmission, .. }) => {
                let (balances, range, swing) = (self.all(balances), self.turning(range), self.stroke(swing));
                let dead_centres = dead_centres.each_ref().map(|dead| self.possible(dead));
                let transmission = self.extremes(transmission);
                four_bar(&quote!(math::grashof(#balances)), &range, &dead_centres, &swing, Some(&transmission))
            }
            Shape::SliderCrank(shape) => {
                let (inversion, range) = (inversion(shape), self.turning(&shape.range));
                let dead = |index: usize| {
                    shape.dead_centres.get(index).map_or_else(|| quote!(None), |dead| self.possible(dead))
                };
                let (first, second) = (dead(0), dead(1));
                let stroke = shape.stroke.as_ref().map_or_else(|| quote!(None), |stroke| self.stroke(stroke));
                let transmission = optional(shape.transmission.as_ref().map(|both| self.extremes(both)));
                slider_crank(&inversion, &range, &[first, second], &stroke, &transmission)
            }
            Shape::DrivenSlide(DrivenSlide { centre, near: [margin, near], far, joint }) => {
                let [centre, margin, near, far] = [centre, margin, near, far].map(|node| self.value(*node));
                quote!(limits::DrivenSlide { range: math::sliding(#centre, (#margin, #near), #far, #joint) })
            }
        }
    }

    fn turning(&self, turning: &Turning) -> TokenStream {
        let Turning { centre, near, far, joint, postures } = turning;
        let limit = |limit: &Option<[NodeId; 2]>, at: Posture| {
            let posture = posture(at);
            // A margin that is never negative stands for a limit that there never is.
            let [margin, angle] =
                limit.map_or_else(|| [quote!(1.0), quote!(0.0)], |nodes| nodes.map(|n| self.value(n)));
            quote!((#margin, #angle, #posture))
        };
        let (centre, near, far) = (self.value(*centre), limit(near, postures[0]), limit(far, postures[1]));
        quote!(math::turning(#centre, #near, #far, #joint))
    }

    fn possible(&self, possible: &Possible) -> TokenStream {
        let Possible { margins, at, joint, posture: how } = possible;
        let (margins, at, how) = (self.all(margins), self.value(*at), posture(*how));
        quote!(math::possible(#margins, #at, #joint, #how))
    }

    fn stroke(&self, stroke: &Stroke) -> TokenStream {
        let Stroke { margins, extent, advance } = stroke;
        let (margins, extent, advance) = (self.all(margins), self.value(*extent), self.value(*advance));
        quote!(math::stroke(#margins, #extent, #advance))
    }

    fn extremes(&self, both: &[Extreme; 2]) -> TokenStream {
        let [least, greatest] = both.map(|one| {
            let (angle, at) = (self.value(one.angle), self.value(one.at));
            quote!(limits::Transmission { angle: #angle, at: math::within_a_turn(#at) })
        });
        quote!([#least, #greatest])
    }
}

/// The section of the derivation; nothing for a linkage without such loops.
pub(super) fn text(linkage: &Linkage) -> String {
    let loops = &linkage.limits.loops;
    if loops.is_empty() {
        return String::new();
    }
    let each = loops.iter().map(|found| Words { linkage, found }.section());
    format!("Limits\n------\n\n{}", each.collect::<String>())
}

/// The heading and the program of what parameters determine.
pub(super) fn closed_form(linkage: &Linkage) -> Option<(String, &Program)> {
    Some(("limits, from the parameters".to_owned(), linkage.limits.prepare.as_ref()?))
}

/// A loop in words.
struct Words<'a> {
    linkage: &'a Linkage,
    found: &'a Loop,
}

impl Words<'_> {
    fn section(&self) -> String {
        let lines = core::iter::once(self.dimensions()).chain([self.origin()]).chain(self.findings());
        let lines = lines.map(|line| format!("  {line}\n"));
        format!("{}\n{}\n", self.found.title, lines.collect::<String>())
    }

    fn formula(&self, node: NodeId) -> String {
        let model = &self.linkage.model;
        Formula { model, terms: Nodes(&model.graph) }.of(node)
    }

    fn dimensions(&self) -> String {
        let each = self.found.dimensions.iter().map(|(name, node)| format!("{name} = {}", self.formula(*node)));
        each.collect::<Vec<_>>().join(", ")
    }

    fn origin(&self) -> String {
        let origin = &self.found.origin;
        let sign = if origin.forwards { "" } else { "−" };
        let phase = self.linkage.model.graph.expr(origin.phase);
        let phase = match phase.sign() {
            Some(0) => String::new(),
            Some(-1) => format!(" − {}", self.formula((-phase).id())),
            _ => format!(" + {}", self.formula(origin.phase)),
        };
        let between = self.found.between.as_ref().map_or_else(String::new, |between| format!(", that {between}"));
        format!("{} = {sign}{}{phase}{between}", origin.meaning, self.found.coordinate)
    }

    fn findings(&self) -> Vec<String> {
        match &self.found.shape {
            Shape::FourBar(four_bar) => self.four_bar(four_bar),
            Shape::SliderCrank(slider_crank) if slider_crank.inversion == Inversion::Opposite => self.inverted(),
            Shape::SliderCrank(slider_crank) => self.slider_crank(slider_crank),
            Shape::DrivenSlide(_) => self.driven_slide(),
        }
    }

    fn four_bar(&self, four_bar: &FourBar) -> Vec<String> {
        let inner = &four_bar.range.joint;
        let mut lines = vec![self.grashof(four_bar)];
        lines.push(format!("{inner} closes where |h − b| ≤ D ≤ h + b, D² = (g − a)² + 4ga sin²(ψ/2){}", self.range()));
        let joint = &four_bar.dead_centres[0].joint;
        lines.push(format!(
            "output as driver dead where {joint} is in line, cos ψ = (g² + L² − b²)/(2gL), L = a ± h{}",
            self.dead_centres()
        ));
        lines.extend(self.stroke("output swings by", true));
        lines.extend(self.transmission(inner, "cos μ = (h² + b² − D²)/(2hb)"));
        lines
    }

    /// The shortest and the longest length against the two others.
    fn grashof(&self, four_bar: &FourBar) -> String {
        let graph = &self.linkage.model.graph;
        let lengths: Option<Vec<Number>> = four_bar.lengths.iter().map(|node| graph.constant_value(*node)).collect();
        let class = self.found.known.as_ref().and_then(|known| known.class);
        let (Some(mut lengths), Some(class)) = (lengths, class) else {
            return "Grashof by the signs of T₁ = g − a + h − b, T₂ = g − a − h + b, T₃ = h + b − g − a: +++ crank-rocker, \
                    −−+ double-crank, −+− double-rocker, +−− rocker-crank, one or three negative triple-rocker, a zero change point"
                .to_owned();
        };
        lengths.sort_by(Number::compare);
        let [s, p, q, l] = lengths.as_slice() else { return String::new() };
        let (ends, middle) = (s.add(l), p.add(q));
        let relation = match ends.compare(&middle) {
            core::cmp::Ordering::Less => "<",
            core::cmp::Ordering::Equal => "=",
            core::cmp::Ordering::Greater => ">",
        };
        let text = |number: &Number| number_text(number.to_f64());
        format!(
            "Grashof: s + l = {} + {} = {} {relation} p + q = {} + {} = {}: {}",
            text(s),
            text(l),
            text(&ends),
            text(p),
            text(q),
            text(&middle),
            class.words()
        )
    }

    fn slider_crank(&self, slider_crank: &SliderCrank) -> Vec<String> {
        let inner = &slider_crank.range.joint;
        let mut lines = vec![format!("{inner} closes where |c − a sin χ| ≤ r, always if a + |c| ≤ r{}", self.range())];
        let dead = if slider_crank.inversion == Inversion::OnFrame {
            let joint = slider_crank.dead_centres.first().map_or("", |dead| dead.joint.as_str());
            format!("slider as driver dead where {joint} is in line, sin χ = c/L, L = a ± r")
        } else {
            "output as driver dead where its end is square to the slide from the driver, sin χ = (a² + c² − r²)/(2ac)"
                .to_owned()
        };
        lines.push(format!("{dead}{}", self.dead_centres()));
        lines.extend(self.stroke("stroke √((r + a)² − c²) − √((r − a)² − c²)", false));
        lines.extend(self.transmission(inner, "from the normal of the slide, cos μ = (c − a sin χ)/r"));
        lines
    }

    fn inverted(&self) -> Vec<String> {
        let mut lines = vec![
            format!("closes where D ≥ |h|, D² = (g − a)² + 4ga sin²(ψ/2){}", self.range()),
            format!(
                "output as driver dead where the crank is square to the slide, cos ν = (h ± a)/g{}",
                self.dead_centres()
            ),
        ];
        lines.extend(self.stroke("output swings by", true));
        lines
    }

    fn driven_slide(&self) -> Vec<String> {
        vec![format!("closes where |r₁ − r₂| ≤ D ≤ r₁ + r₂, D² = x² + c²{}", self.range())]
    }

    /// Whether positions are angles.
    fn turns(&self) -> bool {
        matches!(self.linkage.model.joint(self.found.driver).kind, JointKind::Revolute | JointKind::Slot { .. })
            && !matches!(self.found.shape, Shape::DrivenSlide(_))
    }

    fn value(number: &Number, turns: bool) -> String {
        let value = number.to_f64();
        if !turns {
            return number_text(value);
        }
        let degrees = (value.to_degrees() * 1e4).round() / 1e4;
        format!("{} ({}°)", number_text(value), number_text(degrees))
    }

    fn range(&self) -> String {
        let Some(known) = &self.found.known else { return String::new() };
        let turns = self.turns();
        let piece = |[from, to]: &[KnownPosition; 2]| {
            let end =
                |at: &KnownPosition| format!("{}, {} {}", Self::value(&at.at, turns), at.joint, at.posture.words());
            format!("from {} to {}", end(from), end(to))
        };
        let coordinate = &self.found.coordinate;
        match &known.range {
            KnownRange::Unlimited => format!(": {coordinate} all round"),
            KnownRange::One(one) => format!(": {coordinate} {}", piece(one)),
            KnownRange::Two([first, second]) => format!(": {coordinate} {}; or {}", piece(first), piece(second)),
        }
    }

    fn dead_centres(&self) -> String {
        let Some(known) = &self.found.known else { return String::new() };
        let there = known.dead_centres.iter().flatten();
        let each = there.map(|dead| format!("{} at {}", dead.posture.words(), Self::value(&dead.at, self.turns())));
        let each = each.collect::<Vec<_>>();
        if each.is_empty() {
            ": nowhere".to_owned()
        } else {
            format!(": {} {}", self.found.coordinate, each.join(", "))
        }
    }

    fn stroke(&self, what: &str, turns: bool) -> Option<String> {
        let stroke = self.found.known.as_ref()?.stroke.as_ref()?;
        let (extent, ratio) = (Self::value(&stroke.extent, turns), number_text(stroke.time_ratio.to_f64()));
        let equals = if turns { " " } else { " = " };
        Some(format!("{what}{equals}{extent}, time ratio (180° + α)/(180° − α) = {ratio}"))
    }

    fn transmission(&self, joint: &str, formula: &str) -> Option<String> {
        let [least, greatest] = self.found.known.as_ref()?.transmission.as_ref()?;
        let one = |one: &crate::limits::KnownTransmission| {
            format!("{} at {}", Self::value(&one.angle, true), Self::value(&one.at, true))
        };
        Some(format!("transmission angle at {joint}, {formula}: least {}, greatest {}", one(least), one(greatest)))
    }
}
