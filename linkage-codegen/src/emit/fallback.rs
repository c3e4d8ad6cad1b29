//! The module of a wrong declaration: the same names without bodies, so that what uses it makes no errors of its own.

use proc_macro2::TokenStream;
use quote::quote;

use super::literals::ident;
use super::types::{loads, results, run_time_loads, scalar};
use crate::graph::NodeId;
use crate::model::{JointKind, LoadKind, Method, Model, Scene, Wanted, type_name};
use crate::plan::{Field, Meaning, Output};

/// The names of a module.
#[must_use]
pub fn module(model: &Model) -> TokenStream {
    let (visibility, name) = (&model.visibility, ident(&model.name.text));
    let runtime = model.runtime.clone().unwrap_or_else(|| quote!(::linkage_runtime));
    let scalar = scalar(model);
    let has_params = !model.params.is_empty();
    let shapes: Vec<Output> = model.scenes.iter().map(|scene| shape(model, scene)).collect();
    let loads = loads(model, false);
    let records: TokenStream = shapes.iter().enumerate().map(|(index, shape)| results(model, index, shape)).collect();
    let (params, pose, prepared, lifetime) = if has_params {
        let fields = model.params.iter().map(|param| ident(&param.name.text));
        let params = quote! {
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            pub struct Params { #(pub #fields: #scalar),* }
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct Linkage(());
            impl Linkage { pub fn new(params: &Params) -> Result<Self, Error> { loop {} } }
        };
        (
            params,
            quote!(
                pub struct Pose<'l>(&'l Linkage);
            ),
            quote!(linkage: &'l Linkage,),
            quote!(<'l>),
        )
    } else {
        (
            TokenStream::new(),
            quote!(
                pub struct Pose(());
            ),
            TokenStream::new(),
            TokenStream::new(),
        )
    };
    let drives: Vec<TokenStream> = model
        .drives
        .iter()
        .map(|drive| {
            let name = ident(&drive.name.text);
            quote!(#name: #scalar)
        })
        .collect();
    let accessors = accessors(model);
    let reads_loads = |scene: &Scene| scene.loads.iter().any(|load| run_time_loads(model).contains(load));
    let scenes = model.scenes.iter().map(|scene| {
        let (name, ty) = (ident(&scene.name.text), ident(&type_name(&scene.name.text)));
        let loads = if reads_loads(scene) { quote!(, loads: &Loads) } else { TokenStream::new() };
        quote!(pub fn #name(&self #loads) -> Result<#ty, Error> { loop {} })
    });
    let direct = model.scenes.iter().map(|scene| {
        let (name, ty) = (ident(&format!("{}_at", scene.name)), ident(&type_name(&scene.name.text)));
        let loads = if reads_loads(scene) { quote!(, loads: &Loads) } else { TokenStream::new() };
        let prepared = if has_params { quote!(linkage: &Linkage,) } else { TokenStream::new() };
        quote!(pub fn #name(#prepared #(#drives),* #loads) -> Result<#ty, Error> { loop {} })
    });
    quote! {
        #[allow(warnings, clippy::all, clippy::pedantic, reason = "stands in for a declaration that has errors")]
        #visibility mod #name {
            use #runtime::{Error, SliderReaction, Vector2, WorkTerm};
            pub const EQUATIONS: &str = "";
            pub const OPERATIONS: &str = "";
            pub const SOURCE: &str = "";
            #loads
            #params
            #[derive(Clone, Copy, Debug, PartialEq)]
            #pose
            impl #lifetime Pose #lifetime {
                pub fn at(#prepared #(#drives),*) -> Result<Self, Error> { loop {} }
                #accessors
                #(#scenes)*
            }
            #records
            #(#direct)*
        }
    }
}

fn accessors(model: &Model) -> TokenStream {
    let scalar = scalar(model);
    let number = |name: String| {
        let name = ident(&name);
        quote!(pub fn #name(&self) -> #scalar { loop {} })
    };
    let vector = |name: String| {
        let name = ident(&name);
        quote!(pub fn #name(&self) -> Vector2<#scalar> { loop {} })
    };
    let drives = model.drives.iter().map(|drive| number(drive.name.text.clone()));
    let joints = model
        .joints
        .iter()
        .flat_map(|joint| [vector(joint.name.text.clone()), number(format!("sin_mu_{}", joint.name))]);
    let links = model.links.iter().skip(1).flat_map(|link| {
        let points = link.points.iter().map(|point| point.name.text.as_str()).chain(["direction"]);
        points.map(|point| vector(format!("{}_{point}", link.name))).collect::<Vec<_>>()
    });
    // A name that was declared twice is made once.
    let mut made = Vec::new();
    let mut all = TokenStream::new();
    for accessor in drives.chain(joints).chain(links) {
        let text = accessor.to_string();
        if !made.contains(&text) {
            made.push(text);
            all.extend(accessor);
        }
    }
    all
}

/// The results of a scene without their values.
fn shape(model: &Model, scene: &Scene) -> Output {
    let zero = model.graph.zero().id();
    let parts = |one: &dyn Fn() -> Output| {
        let fields = scene.loads.iter().map(|load| {
            let load = model.load(*load);
            field(&load.name.text, if let LoadKind::Gravity { .. } = load.kind { per_link(model, one) } else { one() })
        });
        Output::Record(fields.collect())
    };
    match scene.method {
        // Without the general solution there is no such type; the scene keeps its name.
        Method::Verify => Output::Record(Vec::new()),
        Method::Superposition => parts(&|| record(model, scene, zero)),
        _ => record(model, scene, zero),
    }
}

fn field(name: &str, value: Output) -> Field {
    Field { name: name.to_owned(), doc: String::new(), value }
}

/// One for each link that has mass.
fn per_link(model: &Model, one: &dyn Fn() -> Output) -> Output {
    let massive = model.links.iter().filter(|link| link.mass.is_some());
    Output::Record(massive.map(|link| field(&link.name.text, one())).collect())
}

fn record(model: &Model, scene: &Scene, zero: NodeId) -> Output {
    let place = scene.method == Method::Position;
    let term = || Output::Term { velocity: zero, work: zero, meaning: Meaning::ForceTerm };
    let terms = || {
        if model.unknowns.len() == 1 {
            return term();
        }
        Output::Record(model.unknowns.iter().map(|unknown| field(&unknown.name, term())).collect())
    };
    let fields = scene.results.iter().filter_map(|wanted| {
        Some(match *wanted {
            Wanted::Unknown(unknown) => field(&model.unknown(unknown).name, Output::Scalar(zero, Meaning::Number)),
            Wanted::Joint(joint) => {
                let joint = model.joint(joint);
                let slide = matches!(joint.kind, JointKind::Prismatic { .. }) && !place;
                let vector = Output::Vector([zero, zero], Meaning::Place);
                let slider = Output::Slider { force: [zero, zero], normal: zero, couple: zero };
                field(&joint.name.text, if slide { slider } else { vector })
            }
            Wanted::Load(load) => {
                let load = model.load(load);
                let value = if let LoadKind::Gravity { .. } = load.kind { per_link(model, &terms) } else { terms() };
                field(&load.name.text, value)
            }
            Wanted::Point(end) => {
                let link = model.links.get(end.link.index())?;
                let point = link.points.get(end.point.index())?;
                field(&format!("{}_{}", link.name, point.name), Output::Vector([zero, zero], Meaning::Place))
            }
            Wanted::Angle(link) => {
                let link = model.links.get(link.index())?;
                field(&format!("{}_angle", link.name), Output::Scalar(zero, Meaning::Angle))
            }
        })
    });
    Output::Record(fields.collect())
}
