//! The module of a wrong declaration: the same names without bodies, so that what uses it makes no errors of its own.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::ext::IdentExt;

use super::literals::ident;
use super::types::{closures, forward_signature, given_motion, loads, motion, results, run_time_loads, scalar};
use crate::graph::NodeId;
use crate::model::ids::LinkId;
use crate::model::{Along, By, Inverse, Load, Method, Model, OWN_CONSTANTS, Part, Scene, Sweep, Wanted, type_name};
use crate::plan::{Field, Meaning, Output, coefficient_names, reaction_type};
use crate::syntax::ast::Name;

/// The names of a module. Where several things would have one name, the first has it.
#[must_use]
pub fn module(mut model: Model) -> TokenStream {
    let names: Vec<Ident> = model.scenes.iter().map(|scene| ident(&scene.name.text)).collect();
    let direct: Vec<Ident> = model.scenes.iter().map(|scene| ident(&format!("{}_at", scene.name))).collect();
    name_apart(&mut model);
    let model = &model;
    let (visibility, name) = (&model.visibility, ident(&model.name.text));
    let runtime = model.runtime.clone().unwrap_or_else(|| quote!(::linkage_runtime));
    let types: Vec<Ident> = model.scenes.iter().map(|scene| ident(&type_name(&scene.name.text))).collect();
    let records: TokenStream = (0..model.scenes.len()).map(|index| records(model, index, &runtime)).collect();
    let (params, pose, scalar) = (params(model), pose(model), scalar(model));
    let prepared = (!model.params.is_empty()).then(|| quote!(linkage: &Linkage));
    let lifetime = (!model.params.is_empty()).then(|| quote!(<'l>));
    let bound = (!model.params.is_empty()).then(|| quote!(linkage: &'l Linkage));
    let drives: Vec<TokenStream> = drives(model);
    let given: Vec<Vec<TokenStream>> = model.scenes.iter().map(|scene| given_arguments(model, scene)).collect();
    let at = arguments(bound, &drives, &[]);
    let accessors = accessors(model);
    let wrench = super::uses_wrench(&runtime, wrenches(model));
    let sweeps: TokenStream = sweeps(model, &runtime);
    let inverses = super::inverses::stand_ins(model, &runtime);
    let from_pose = names
        .iter()
        .zip(&types)
        .zip(&given)
        .map(|((name, ty), given)| quote!(pub fn #name(&self #(, #given)*) -> Result<#ty, Error> { loop {} }));
    let direct = direct.iter().zip(&types).zip(&given).map(|((name, ty), given)| {
        let arguments = arguments(prepared.clone(), &drives, given);
        quote!(pub fn #name(#arguments) -> Result<#ty, Error> { loop {} })
    });
    let limits = super::limits::fallback(model, &runtime);
    let forward = (0..model.scenes.len()).filter_map(|index| {
        let (ty, signature) = (types.get(index)?, forward_signature(model, index)?);
        Some(quote!(impl #ty { #signature { loop {} } }))
    });
    let forward: TokenStream = forward.collect();
    let matrices = model.has_matrices().then(|| quote!(use #runtime::nalgebra::{SMatrix, SVector};));
    let (motion, loads) = (motion(model), loads(model, false));
    let closures = closures(model, false);
    let sides = (!closures.is_empty()).then(|| quote!(use #runtime::{Along, Side};));
    let own = names.iter().map(|name| name.unraw().to_string());
    // Whether there is a search is not known; a pose can be moved unless something else has that name.
    let coordinates = &drives[..model.drives.len()];
    let moved = quote!(pub fn moved_to(&self, #(#coordinates),*) -> Result<Self, Error> { loop {} });
    let moved = (!own.clone().any(|name| name == "moved_to")).then_some(moved);
    let methods = distinct(own.zip(from_pose).chain(accessors));
    quote! {
            #[allow(warnings, clippy::all, clippy::pedantic, reason = "stands in for a declaration that has errors")]
            #visibility mod #name {
                use #runtime::__private::#scalar as math;
    use #runtime::{
        Error, GearReaction, ResolvedForce, SliderReaction, SlotReaction, Vector2, WeldReaction, WorkTerm,
    };
                #wrench
                #matrices
                pub const EQUATIONS: &str = "";
                pub const OPERATIONS: &str = "";
                pub const SOURCE: &str = "";
                #sides
                #motion
                #loads
                #closures
                #params
                #limits
                #pose
                impl #lifetime Pose #lifetime {
                    pub fn at(#at) -> Result<Self, Error> { loop {} }
                    #moved
                    #methods
                }
                #records
                #forward
                #(#direct)*
                #inverses
                #sweeps
            }
        }
}

/// Whether results that were asked for, in vain or not, are resultants.
fn wrenches(model: &Model) -> bool {
    let refused = |(_, like): &(String, Option<Wanted>)| matches!(like, Some(Wanted::Shaking(_) | Wanted::OnGround(_)));
    model.has_wrenches() || model.scenes.iter().any(|scene| scene.refused.iter().any(refused))
}

fn sweeps(model: &Model, runtime: &TokenStream) -> TokenStream {
    let all = model.sweeps.iter().map(|sweep| {
        let scene = &model.scenes[sweep.scene];
        let output = match scene.method {
            Method::Verify => Output::Record(Vec::new()),
            _ => shape(model, scene),
        };
        super::sweeps::stand_in(model, sweep, &output, runtime)
    });
    all.collect()
}

/// Lets functions and types have names of their own, in whatever way names clash. The types of sweeps and inverse scenes are written where the
/// module is used, those of other scenes hardly ever are: these give way.
fn name_apart(model: &mut Model) {
    let mut taken: BTreeSet<String> = model.own_types().map(str::to_owned).collect();
    taken.extend(["Default", "Wrench"].map(str::to_owned));
    taken.extend(model.loads.iter().filter(|load| load.kind.is_spring()).map(Load::type_name));
    taken.extend(OWN_CONSTANTS.map(function));
    taken.extend(model.scenes.iter().map(|scene| function(&format!("{}_at", scene.name))));
    for sweep in &mut model.sweeps {
        rename(sweep, |sweep| &mut sweep.name, names_of_sweep, &mut taken);
    }
    for inverse in &mut model.inverses {
        rename(inverse, |inverse| &mut inverse.name, names_of_inverse, &mut taken);
        for name in &mut inverse.swept {
            let mut sweep = Sweep { name: name.clone(), scene: 0 };
            rename(&mut sweep, |sweep| &mut sweep.name, names_of_sweep, &mut taken);
            *name = sweep.name;
        }
    }
    for index in 0..model.scenes.len() {
        let types = |model: &Model| model.types_of(&model.scenes[index]).into_iter().map(|(name, _)| name).collect();
        rename(model, |model| &mut model.scenes[index].name, types, &mut taken);
    }
}

/// A function among the names that are taken: it may be called like a type.
fn function(name: &str) -> String {
    format!("fn {name}")
}

fn names_of_sweep(sweep: &Sweep) -> Vec<String> {
    sweep.types().into_iter().chain([function(&sweep.name.text)]).collect()
}

fn names_of_inverse(inverse: &Inverse) -> Vec<String> {
    inverse.types().into_iter().chain([function(&format!("{}_at", inverse.name))]).collect()
}

/// Gives something another name, if one is taken of all that it brings.
fn rename<T>(
    thing: &mut T,
    name: impl Fn(&mut T) -> &mut Name,
    brings: impl Fn(&T) -> Vec<String>,
    taken: &mut BTreeSet<String>,
) {
    if !name(thing).is_usable() {
        name(thing).text.push('_');
    }
    while brings(thing).iter().any(|made| taken.contains(made)) {
        name(thing).text.push_str("_x");
    }
    taken.extend(brings(thing));
}

/// The first method of each name.
fn distinct(named: impl Iterator<Item = (String, TokenStream)>) -> TokenStream {
    let mut seen = BTreeSet::from(["at".to_owned()]);
    named.filter(|(name, _)| seen.insert(name.clone())).map(|(_, method)| method).collect()
}

fn params(model: &Model) -> Option<TokenStream> {
    let scalar = scalar(model);
    let fields: Vec<Ident> = model.params.iter().map(|param| ident(&param.name.text)).collect();
    (!fields.is_empty()).then(|| {
        quote! {
            #[derive(Clone, Copy, Debug, Default, PartialEq)]
            pub struct Params { #(pub #fields: #scalar),* }
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct Linkage(());
            impl Linkage { pub fn new(params: &Params) -> Result<Self, Error> { loop {} } }
        }
    })
}

fn pose(model: &Model) -> TokenStream {
    let inside = if model.params.is_empty() { quote!((())) } else { quote!(<'l>(&'l Linkage)) };
    quote! {
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Pose #inside;
    }
}

/// The drives as arguments. What they are called is of no matter.
fn drives(model: &Model) -> Vec<TokenStream> {
    let scalar = scalar(model);
    let closures = model.given_closures().next().map(|_| quote!(_: Closures));
    model.drives.iter().map(|_| quote!(_: #scalar)).chain(closures).collect()
}

/// The arguments behind the drives.
fn given_arguments(model: &Model, scene: &Scene) -> Vec<TokenStream> {
    let moves = !given_motion(model).is_empty() && model.scene_moves(scene);
    let reads = scene.loads.iter().any(|load| run_time_loads(model).contains(load));
    moves.then(|| quote!(motion: &Motion)).into_iter().chain(reads.then(|| quote!(loads: &Loads))).collect()
}

fn arguments(first: Option<TokenStream>, drives: &[TokenStream], last: &[TokenStream]) -> TokenStream {
    let all = first.into_iter().chain(drives.iter().cloned()).chain(last.iter().cloned());
    quote!(#(#all),*)
}

/// What can be asked of a pose, by its name.
fn accessors(model: &Model) -> impl Iterator<Item = (String, TokenStream)> {
    let scalar = scalar(model);
    let number = |name: String| {
        let method = ident(&name);
        (name, quote!(pub fn #method(&self) -> #scalar { loop {} }))
    };
    let vector = |name: String| {
        let method = ident(&name);
        (name, quote!(pub fn #method(&self) -> Vector2<#scalar> { loop {} }))
    };
    let drives = model.drives.iter().map(|drive| number(drive.name.text.clone()));
    let joints = model.joints.iter().flat_map(|joint| {
        joint.asked_names().into_iter().map(number).chain([vector(joint.name.text.clone())]).collect::<Vec<_>>()
    });
    let links = model.links.iter().skip(1).flat_map(|link| {
        let points = link.points.iter().map(|point| point.name.text.as_str()).chain(["direction"]);
        points.map(|point| vector(format!("{}_{point}", link.name))).collect::<Vec<_>>()
    });
    drives.chain(joints).chain(links).collect::<Vec<_>>().into_iter()
}

/// The types of a scene.
fn records(model: &Model, index: usize, runtime: &TokenStream) -> TokenStream {
    let scene = &model.scenes[index];
    let ty = ident(&type_name(&scene.name.text));
    let scalar = scalar(model);
    match scene.method {
        Method::Verify if cfg!(feature = "reference") => {
            quote!(pub type #ty = #runtime::reference::Verification<#scalar>;)
        }
        // Without the general solution there is no such type; the scene keeps its name.
        Method::Verify => quote! {
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct #ty {
                pub superposition: #scalar,
                pub virtual_work: #scalar,
                pub general: #scalar,
                pub condition: #scalar,
            }
            impl ::core::fmt::Display for #ty {
                fn fmt(&self, _: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result { loop {} }
            }
        },
        _ => results(model, index, &shape(model, scene)),
    }
}

/// The results of a scene without their values.
fn shape(model: &Model, scene: &Scene) -> Output {
    let zero = model.graph.zero().id();
    let parts = |one: &dyn Fn() -> Output| {
        let fields = scene.loads.iter().map(|load| {
            let load = model.load(*load);
            field(&load.name.text, if load.kind.is_per_link() { per_link(model, load, one) } else { one() })
        });
        Output::Record(fields.collect())
    };
    if let Some(derivative) = &scene.derivative {
        let of = &Scene { results: scene.results.clone(), ..model.scenes[derivative.of].clone() };
        let by = derivative.by.iter().map(|variable| {
            let numbers: Vec<&str> = match variable.by {
                By::Load(load) => model.load(load).kind.given(model).filter(|value| !value.is_empty()).collect(),
                _ => Vec::new(),
            };
            (variable.name(model), numbers)
        });
        let mut seen = BTreeSet::new();
        let by = by.chain(derivative.refused.iter().cloned()).filter(|(name, _)| seen.insert(name.clone()));
        let by = by.map(|(name, numbers)| {
            let value = if numbers.is_empty() {
                shape(model, of)
            } else {
                Output::Record(numbers.into_iter().map(|number| field(number, shape(model, of))).collect())
            };
            field(&name, value)
        });
        return Output::Record(by.collect());
    }
    match scene.method {
        Method::Superposition => parts(&|| record(model, scene, zero)),
        _ => record(model, scene, zero),
    }
}

fn field(name: &str, value: Output) -> Field {
    Field { name: name.to_owned(), doc: String::new(), value }
}

/// One for each link that has mass; if none has, which is an error by itself, for each that moves.
fn per_link(model: &Model, load: &Load, one: &dyn Fn() -> Output) -> Output {
    let none = model.links.iter().all(|link| link.mass.is_none());
    let meant = |id: &LinkId| load.links.is_empty() || load.links.contains(id);
    let links = model.moving_links().filter(meant).map(|id| model.link(id));
    let massive = links.filter(|link| none || link.mass.is_some());
    Output::Record(massive.map(|link| field(&link.name.text, one())).collect())
}

fn record(model: &Model, scene: &Scene, zero: NodeId) -> Output {
    let given = scene.results.iter().filter_map(|wanted| Some((model.result_name(*wanted)?, Some(*wanted))));
    let refused = scene.refused.iter().cloned();
    let mut seen = BTreeSet::new();
    let all = given.chain(refused).filter(|(name, _)| seen.insert(name.clone()));
    Output::Record(all.map(|(name, wanted)| field(&name, value(model, scene, wanted, zero))).collect())
}

/// What a result is like.
fn value(model: &Model, scene: &Scene, wanted: Option<Wanted>, zero: NodeId) -> Output {
    let vector = Output::Vector([zero, zero], Meaning::Place);
    let number = Output::Scalar(zero, Meaning::Number);
    let term = || Output::Term { velocity: zero, work: zero, meaning: Meaning::ForceTerm };
    let terms = || {
        if model.unknowns.len() == 1 {
            return term();
        }
        Output::Record(model.unknowns.iter().map(|unknown| field(&unknown.name, term())).collect())
    };
    if let (Method::Coefficients, Some(Wanted::Joint(_) | Wanted::Point(_) | Wanted::Angle(_))) = (scene.method, wanted)
    {
        let one = if matches!(wanted, Some(Wanted::Angle(_))) { number } else { vector };
        return Output::Record(coefficient_names(model).iter().map(|name| field(name, one.clone())).collect());
    }
    match wanted {
        Some(Wanted::Advantage(_)) if model.unknowns.len() > 1 => {
            Output::Record(model.unknowns.iter().map(|unknown| field(&unknown.name, number.clone())).collect())
        }
        Some(Wanted::Joint(joint)) => {
            let ty = model.joints.get(joint.index()).and_then(|joint| reaction_type(&joint.kind));
            match ty.filter(|_| scene.method.has_loads()) {
                Some((ty, components)) => {
                    let parts = components.iter().map(|component| (component.name(), zero)).collect();
                    Output::Reaction { ty, force: [zero, zero], parts }
                }
                None => vector,
            }
        }
        Some(Wanted::Load(load)) => match model.loads.get(load.index()) {
            Some(load) if load.kind.is_per_link() => per_link(model, load, &terms),
            _ => terms(),
        },
        Some(Wanted::Point(_)) => vector,
        Some(Wanted::ErrorBound) => {
            let others = Scene { results: without_bounds(scene), ..scene.clone() };
            record(model, &others, zero)
        }
        Some(Wanted::Resolved(_, along)) => {
            let names = if let Along::Path = along { ["tangential", "normal"] } else { ["axial", "transverse"] };
            Output::Record(names.map(|name| field(name, number.clone())).into())
        }
        Some(Wanted::Inertia(_)) => {
            let parts = [("acceleration", vector.clone()), ("force", vector), ("couple", number)];
            Output::Record(parts.map(|(name, value)| field(name, value)).into())
        }
        Some(Wanted::Shaking(_) | Wanted::OnGround(_)) => {
            Output::Reaction { ty: "Wrench", force: [zero, zero], parts: vec![("moment", zero)] }
        }
        Some(Wanted::Offset(_)) => Output::Record(vec![field("distance", number), field("vector", vector)]),
        Some(Wanted::Part(part)) => match (model.unknowns.len(), part) {
            (0 | 1, _) => number,
            (unknowns, Part::Bias) => Output::Column(vec![zero; unknowns]),
            (unknowns, _) => Output::Matrix(vec![vec![zero; unknowns]; unknowns]),
        },
        Some(Wanted::Along(..)) => Output::Resolved([zero, zero]),
        Some(
            Wanted::Unknown(_)
            | Wanted::Angle(_)
            | Wanted::About(..)
            | Wanted::Power(_)
            | Wanted::Driver(..)
            | Wanted::Advantage(_),
        )
        | None => number,
    }
}

fn without_bounds(scene: &Scene) -> Vec<Wanted> {
    scene.results.iter().copied().filter(|wanted| *wanted != Wanted::ErrorBound).collect()
}
