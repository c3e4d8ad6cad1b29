//! The types of a module: loads, parameters, pose, results.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::formula::{Formula, Nodes};
use super::literals::{ident, signed_literal};
use crate::Linkage;
use crate::graph::Order;
use crate::model::ids::{GROUND, JointId, LoadId};
use crate::model::units::Kind;
use crate::model::{Drive, Load, LoadKind, Method, Model, Part, Wanted, type_name};
use crate::plan::Output;

/// The scalar type.
pub(super) fn scalar(model: &Model) -> Ident {
    ident(model.graph.scalar().name())
}

/// Whether the module has parameters.
pub(super) fn has_params(linkage: &Linkage) -> bool {
    !linkage.model.params.is_empty()
}

/// Loads that are given at run time.
pub(super) fn run_time_loads(model: &Model) -> Vec<LoadId> {
    (0..model.loads.len()).map(LoadId::new).filter(|load| model.load(*load).kind.is_given_at_run_time(model)).collect()
}

/// `Loads`: a field for each load that is given at run time; none if there is none. Of a model that is not whole only names are sure.
pub(super) fn loads(model: &Model, whole: bool) -> TokenStream {
    let scalar = scalar(model);
    let (mut springs, mut named) = (TokenStream::new(), BTreeSet::new());
    let fields: Vec<TokenStream> = run_time_loads(model)
        .into_iter()
        .map(|load| {
            let load = model.load(load);
            let name = ident(&load.name.text);
            let doc = if whole { format!(" {}", load_doc(model, load)) } else { String::new() };
            let ty = match load.kind {
                LoadKind::Moment { .. } | LoadKind::Thrust { .. } => quote!(#scalar),
                LoadKind::Force { .. } | LoadKind::Gravity { .. } => quote!(Vector2<#scalar>),
                LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
                    let ty = ident(&load.type_name());
                    // In a declaration that is wrong two may have one name.
                    if named.insert(load.type_name()) {
                        springs.extend(spring(model, load));
                    }
                    quote!(#ty)
                }
                // Nothing of it is given.
                LoadKind::Inertia => quote!(()),
            };
            quote!(#[doc = #doc] pub #name: #ty)
        })
        .collect();
    if fields.is_empty() {
        return TokenStream::new();
    }
    quote! {
        /// The loads that are given at run time.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct Loads { #(#fields),* }
        #springs
    }
}

/// What of the drives' motion is given at run time.
#[must_use]
pub fn given_motion(model: &Model) -> Vec<(&Drive, Order)> {
    let read = |order: &Order| match order {
        Order::Rate => model.moves(),
        Order::Acceleration => model.accelerates(),
    };
    let of = |drive| Drive::given_motion(drive, &model.graph).filter(read).map(move |order| (drive, order));
    model.drives.iter().flat_map(of).collect()
}

/// The type of what is given of the drives' motion: of an inverse scene, what is wanted.
pub(super) fn motion_type(model: &Model) -> Ident {
    of_inverse(model, "Motion")
}

/// The type of the prepared linkage: of an inverse scene, of what is prepared for it.
pub(super) fn linkage_type(model: &Model) -> Ident {
    of_inverse(model, "Linkage")
}

fn of_inverse(model: &Model, name: &str) -> Ident {
    match (&model.exchanged, model.scenes.first()) {
        (Some(_), Some(scene)) => ident(&format!("{}{name}", type_name(&scene.name.text))),
        _ => ident(name),
    }
}

/// `Motion`: rates and accelerations of the drives that do not declare them; none if nothing moves.
pub(super) fn motion(model: &Model) -> TokenStream {
    let (scalar, ty) = (scalar(model), motion_type(model));
    let fields = given_motion(model).into_iter().map(|(drive, order)| {
        let (name, doc) = (ident(&drive.motion_name(order)), format!(" {}", motion_doc(model, drive, order)));
        quote!(#[doc = #doc] pub #name: #scalar)
    });
    let fields: Vec<TokenStream> = fields.collect();
    if fields.is_empty() {
        return TokenStream::new();
    }
    let doc = if model.exchanged.is_some() { " The motion that is wanted." } else { " The motion of the drives." };
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct #ty { #(#fields),* }
    }
}

/// What the rate or the acceleration of a drive is, with its unit; of an inverse scene, of a coordinate.
pub(super) fn motion_doc(model: &Model, drive: &Drive, order: Order) -> String {
    let what = match order {
        Order::Rate => "Rate",
        Order::Acceleration => "Acceleration",
    };
    let of = if model.exchanged.is_some() { "of" } else { "of the drive" };
    format!("{what} {of} `{}`, {}.", drive.name, Drive::kind_of(order, drive.turns).unit(&model.units))
}

/// The type of what is given of a spring at run time.
fn spring(model: &Model, load: &Load) -> TokenStream {
    let (scalar, ty) = (scalar(model), ident(&load.type_name()));
    let turns = matches!(load.kind, LoadKind::Torsion { .. });
    let fields = load.kind.given(model).map(|value| {
        let name = ident(value);
        let (what, kind) = match (value, turns) {
            ("rate", false) => ("Force per length", Kind::Stiffness),
            ("rate", true) => ("Moment per angle", Kind::TorsionStiffness),
            ("free", false) => ("Length without force, but for its preload", Kind::Length),
            ("free", true) => ("Angle without moment", Kind::Angle),
            ("damping", false) => ("Force per rate of its length", Kind::Damping),
            ("damping", true) => ("Moment per rate of its angle", Kind::TorsionDamping),
            ("near", _) => ("Angle that tells which turn is meant", Kind::Angle),
            _ => ("Tension at its free length", Kind::Force),
        };
        let doc = format!(" {what}, {}.", kind.unit(&model.units));
        quote!(#[doc = #doc] pub #name: #scalar)
    });
    let doc = format!(" What is given of the spring `{}` at run time.", load.name);
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct #ty { #(#fields),* }
    }
}

/// What a load is, in a sentence.
pub(super) fn load_doc(model: &Model, load: &Load) -> String {
    let link = |id| &model.link(id).name.text;
    match &load.kind {
        LoadKind::Force { at, frame, .. } => {
            let axes = if *frame == GROUND { "ground axes".to_owned() } else { format!("axes of `{}`", link(*frame)) };
            format!("Force on `{}`, {}, {axes}.", model.end_name(*at), Kind::Force.unit(&model.units))
        }
        LoadKind::Moment { on, from, .. } => {
            let by = from.map_or_else(String::new, |from| format!(" by `{}`", link(from)));
            format!("Moment on `{}`{by}, {}, counter-clockwise.", link(*on), Kind::Moment.unit(&model.units))
        }
        LoadKind::Thrust { ends: [first, second], .. } => format!(
            "Thrust between `{}` and `{}`, {}, positive where it pushes them apart.",
            model.end_name(*first),
            model.end_name(*second),
            Kind::Force.unit(&model.units)
        ),
        LoadKind::Spring { ends: [first, second], .. } => {
            format!("Spring between `{}` and `{}`.", model.end_name(*first), model.end_name(*second))
        }
        LoadKind::Torsion { from, on, .. } => {
            format!("Torsion spring on `{}`, reacted by `{}`.", link(*on), link(*from))
        }
        LoadKind::Inertia => {
            let links: Vec<String> = load.links.iter().map(|id| format!("`{}`", link(*id))).collect();
            format!("Inertia of {} by D'Alembert.", links.join(", "))
        }
        LoadKind::Gravity { .. } => {
            format!("Acceleration of gravity, {}, ground axes.", Kind::Acceleration.unit(&model.units))
        }
    }
}

/// `Closures`: a field for each group whose side is chosen at run time; none if there is none.
pub(super) fn closures(model: &Model, whole: bool) -> TokenStream {
    let fields: Vec<TokenStream> = model
        .given_closures()
        .filter_map(|(_, closure)| {
            let joint = |id: JointId| Some(&model.joints.get(id.index())?.name);
            let (inner, ty) = (joint(closure.joint)?, ident(closure.type_name()));
            let of: Option<Vec<String>> = closure.of.iter().map(|of| Some(format!("`{}`", joint(*of)?))).collect();
            let doc = match of?.as_slice() {
                [from, to] if whole => {
                    format!(" On which side of the line from {from} to {to} the joint `{inner}` lies.")
                }
                [of] if whole => format!(" Whether the group of `{inner}` closes ahead of {of} or behind it."),
                _ => String::new(),
            };
            let name = ident(&inner.text);
            Some(quote!(#[doc = #doc] pub #name: #ty))
        })
        .collect();
    if fields.is_empty() {
        return TokenStream::new();
    }
    quote! {
        /// The sides on which groups close, where they are chosen at run time.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct Closures { #(#fields),* }
    }
}

/// `Params` and `Linkage`; none without parameters.
pub(super) fn params(linkage: &Linkage, new: &TokenStream) -> TokenStream {
    let model = &linkage.model;
    if !has_params(linkage) {
        return TokenStream::new();
    }
    let scalar = scalar(model);
    let fields = model.params.iter().map(|param| {
        let name = ident(&param.name.text);
        let doc = format!(" {}, {}.", capitalised(param.kind.name()), param.kind.unit(&model.units));
        quote!(#[doc = #doc] pub #name: #scalar)
    });
    let defaults: Option<Vec<TokenStream>> = model
        .params
        .iter()
        .map(|param| {
            let name = ident(&param.name.text);
            let value = model.graph.constant_value(param.default?)?;
            let value = signed_literal(&value, model.graph.scalar());
            Some(quote!(#name: #value))
        })
        .collect();
    let default = defaults.map(|defaults| {
        quote! {
            impl Default for Params {
                /// The defaults of the declaration.
                fn default() -> Self { Self { #(#defaults),* } }
            }
        }
    });
    let prepared = prepared_fields(linkage);
    let inverses = linkage.inverses.iter().map(|inverse| {
        let (name, ty) = (super::inverses::prepared_name(inverse), linkage_type(&inverse.model));
        quote!(#name: #ty)
    });
    quote! {
        /// The dimensions that are given at run time.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Params { #(#fields),* }
        #default

        /// The linkage with its dimensions: validated, and all that depends on them alone computed.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Linkage { #(#prepared,)* #(#inverses),* }
        #new
    }
}

/// What is computed of the parameters alone.
pub(super) fn prepared_fields(linkage: &Linkage) -> Vec<TokenStream> {
    let model = &linkage.model;
    let (scalar, names) = (scalar(model), super::prepared_names(linkage));
    let formula = Formula { model, terms: Nodes(&model.graph) };
    let fields = linkage.functions.prepared.iter().map(|node| {
        let (name, doc) = (ident(&names[node]), format!(" {}", formula.of(*node)));
        quote!(#[doc = #doc] #name: #scalar)
    });
    fields.collect()
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// `Pose`: what is kept of it.
pub(super) fn pose(linkage: &Linkage) -> TokenStream {
    let model = &linkage.model;
    let scalar = scalar(model);
    let drives = model.drives.iter().map(|drive| {
        let name = ident(&drive.name.text);
        let doc = format!(" {}", drive_doc(model, &drive.name.text));
        quote!(#[doc = #doc] #name: #scalar)
    });
    let kept = linkage.plan.pose.iter().map(|kept| {
        let name = ident(&kept.name);
        let doc = format!(" {}", kept.meaning);
        quote!(#[doc = #doc] #name: #scalar)
    });
    let closures = super::functions::pose_keeps_closures(linkage)
        .then(|| quote!(/** The sides on which it closes. */ closures: Closures,));
    let (generics, prepared) = if has_params(linkage) {
        (quote!(<'l>), quote!(/** The prepared linkage. */ linkage: &'l Linkage,))
    } else {
        (TokenStream::new(), TokenStream::new())
    };
    quote! {
        /// A pose of the linkage, from which every scene can be solved.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Pose #generics { #prepared #(#drives,)* #closures #(#kept),* }
    }
}

/// What a drive's coordinate is, with its unit.
pub(super) fn drive_doc(model: &Model, name: &str) -> String {
    let Some(drive) = model.drives.iter().find(|d| d.name.text == name) else { return String::new() };
    let joint = model.joint(drive.joint);
    let (from, to) = (&model.link(joint.from.link).name, &model.link(joint.to.link).name);
    if drive.turns {
        format!("Angle of `{to}` from `{from}` at `{}`, rad, counter-clockwise.", joint.name)
    } else {
        let (what, unit) = (joint.kind.noun(), Kind::Length.unit(&model.units));
        format!("Travel of `{to}` from `{from}` along the {what} `{}`, {unit}.", joint.name)
    }
}

/// The type of a result.
pub(super) fn output_type(model: &Model, output: &Output, record: &str) -> TokenStream {
    let scalar = scalar(model);
    match output {
        Output::Scalar(..) => quote!(#scalar),
        Output::Vector(..) => quote!(Vector2<#scalar>),
        Output::Column(values) => {
            let size = Literal::usize_unsuffixed(values.len());
            quote!(SVector<#scalar, #size>)
        }
        Output::Matrix(rows) => {
            let size = Literal::usize_unsuffixed(rows.len());
            quote!(SMatrix<#scalar, #size, #size>)
        }
        Output::Resolved(_) => quote!(ResolvedForce<#scalar>),
        Output::Reaction { ty, .. } => {
            let ty = ident(ty);
            quote!(#ty<#scalar>)
        }
        Output::Term { .. } => quote!(WorkTerm<#scalar>),
        Output::Verification(_) => quote!(Verification<#scalar>),
        Output::Record(_) => {
            let name = ident(record);
            quote!(#name)
        }
    }
}

/// The head of the function that gives accelerations, where a scene has what it needs.
pub(super) fn forward_signature(model: &Model, index: usize) -> Option<TokenStream> {
    let scene = &model.scenes[index];
    let has = |part| scene.results.contains(&Wanted::Part(part));
    if scene.method != Method::Motion || ![Part::Mass, Part::Bias, Part::Rounding].into_iter().all(has) {
        return None;
    }
    let scalar = scalar(model);
    let ty = if model.unknowns.len() == 1 {
        quote!(#scalar)
    } else {
        let size = Literal::usize_unsuffixed(model.unknowns.len());
        quote!(SVector<#scalar, #size>)
    };
    Some(quote!(pub fn acceleration(&self, effort: #ty) -> Result<#ty, Error>))
}

/// The name of the type of a record in a record.
pub(super) fn record_name(method: Method, base: &str, parent: &str, field: &str, output: &Output) -> String {
    let Output::Record(fields) = output else { return String::new() };
    let contributions = fields.iter().any(|field| !matches!(field.value, Output::Record(_)));
    if method == Method::Superposition && contributions {
        format!("{base}Contribution")
    } else {
        format!("{parent}{}", type_name(field))
    }
}

/// The types of a scene's results.
pub(super) fn results(model: &Model, scene: usize, output: &Output) -> TokenStream {
    let scene = &model.scenes[scene];
    let base = type_name(&scene.name.text);
    let doc = match scene.method {
        Method::Superposition => format!(" Every load's own part in the scene `{}`.", scene.name),
        Method::Derivative => format!(" Derivatives, a record for each variable of the scene `{}`.", scene.name),
        _ => format!(" Results of the scene `{}`.", scene.name),
    };
    let mut types = TokenStream::new();
    let mut made = Vec::new();
    record(model, scene.method, &base, &base, &doc, output, &mut made, &mut types);
    types
}

#[allow(clippy::too_many_arguments, reason = "one recursion that carries its context")]
fn record(
    model: &Model,
    method: Method,
    base: &str,
    name: &str,
    doc: &str,
    output: &Output,
    made: &mut Vec<String>,
    types: &mut TokenStream,
) {
    let Output::Record(fields) = output else { return };
    if made.iter().any(|other| other == name) {
        return;
    }
    made.push(name.to_owned());
    let mut inner = TokenStream::new();
    let members = fields.iter().map(|field| {
        let child = record_name(method, base, name, &field.name, &field.value);
        let child_doc = if child.ends_with("Contribution") {
            " A part of the results.".to_owned()
        } else {
            format!(" {}", field.doc)
        };
        record(model, method, base, &child, &child_doc, &field.value, made, &mut inner);
        let member = ident(&field.name);
        let ty = output_type(model, &field.value, &child);
        let doc = format!(" {}", field.doc);
        quote!(#[doc = #doc] pub #member: #ty)
    });
    let members: Vec<TokenStream> = members.collect();
    let ty = ident(name);
    types.extend(quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #ty { #(#members),* }
    });
    let sums = method == Method::Superposition && fields.iter().any(|field| matches!(field.value, Output::Record(_)));
    if sums {
        types.extend(total(base, &ty, output));
    }
    types.extend(inner);
}

/// The paths to the contributions in a record, in order.
pub(super) fn contributions(output: &Output) -> Vec<Vec<String>> {
    let Output::Record(fields) = output else { return Vec::new() };
    if fields.iter().any(|field| !matches!(field.value, Output::Record(_))) {
        return vec![Vec::new()];
    }
    let deeper = fields.iter().flat_map(|field| {
        contributions(&field.value).into_iter().map(|path| core::iter::once(field.name.clone()).chain(path).collect())
    });
    deeper.collect()
}

/// `total()`: the sum of all contributions.
fn total(base: &str, ty: &Ident, output: &Output) -> TokenStream {
    let contribution = ident(&format!("{base}Contribution"));
    let paths: Vec<TokenStream> = contributions(output)
        .into_iter()
        .map(|path| {
            let path = path.iter().map(|name| ident(name));
            quote!(self #(.#path)*)
        })
        .collect();
    let Some(fields) = first_contribution(output) else { return TokenStream::new() };
    let sum = |part: &TokenStream| quote!(#(#paths #part)+*);
    let members = fields.iter().map(|field| {
        let name = ident(&field.name);
        let value = match &field.value {
            Output::Vector(..) => {
                let (x, y) = (sum(&quote!(.#name.x)), sum(&quote!(.#name.y)));
                quote!(Vector2::new(#x, #y))
            }
            Output::Resolved(_) => {
                let (axial, transverse) = (sum(&quote!(.#name.axial)), sum(&quote!(.#name.transverse)));
                quote!(ResolvedForce { axial: #axial, transverse: #transverse })
            }
            Output::Reaction { ty, parts, .. } => {
                let (x, y) = (sum(&quote!(.#name.force.x)), sum(&quote!(.#name.force.y)));
                let parts = parts.iter().map(|(part, _)| {
                    let part = ident(part);
                    let sum = sum(&quote!(.#name.#part));
                    quote!(#part: #sum)
                });
                let ty = ident(ty);
                quote!(#ty { force: Vector2::new(#x, #y), #(#parts),* })
            }
            _ => sum(&quote!(.#name)),
        };
        quote!(#name: #value)
    });
    let numbers = fields.iter().flat_map(|field| {
        let name = ident(&field.name);
        field.value.leaves().into_iter().map(move |(path, _)| {
            let parts = path.split('.').filter(|part| !part.is_empty()).map(ident);
            quote!(total.#name #(.#parts)*)
        })
    });
    // A call: inlined into a function that has much else, the shuffles of its sums and of their check keep LLVM busy for minutes.
    quote! {
        impl #ty {
            /// The sum of all parts.
            ///
            /// # Errors
            ///
            /// [`Error::NotFinite`]: a sum is too large for a number.
            pub fn total(&self) -> Result<#contribution, Error> {
                let total = #contribution { #(#members),* };
                if !math::all_finite([#(#numbers),*]) {
                    return Err(Error::NotFinite { what: "a sum" });
                }
                Ok(total)
            }
        }
    }
}

fn first_contribution(output: &Output) -> Option<&[crate::plan::Field]> {
    let Output::Record(fields) = output else { return None };
    match fields.first() {
        Some(first) if matches!(first.value, Output::Record(_)) => first_contribution(&first.value),
        _ => Some(fields),
    }
}
