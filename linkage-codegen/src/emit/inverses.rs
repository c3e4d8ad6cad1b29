//! Inverse scenes: a function for each, of the linkage as it is driven where a motion is wanted.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::docs::motion_blocks;
use super::literals::ident;
use super::types::{drive_doc, has_params, linkage_type, prepared_fields, scalar};
use super::{functions, sweeps, types};
use crate::Linkage;
use crate::model::{Inverse, Model, Scene};
use crate::program::Program;

/// The scene of such a linkage, with its program.
pub(super) fn scene(inverse: &Linkage) -> Option<(&Scene, &Program)> {
    Some((inverse.model.scenes.first()?, &inverse.functions.scenes.first()?.direct))
}

/// Where a prepared linkage has what is prepared for the scene.
pub(super) fn prepared_name(inverse: &Linkage) -> Ident {
    let name = inverse.model.scenes.first().map_or("", |scene| scene.name.text.as_str());
    ident(&format!("inverse_{name}"))
}

/// The function with its types, and its sweeps.
pub(super) fn function(inverse: &Linkage, runtime: &TokenStream) -> TokenStream {
    let model = &inverse.model;
    let motion = types::motion(model);
    let results: TokenStream = inverse.plan.scenes.iter().map(|output| types::results(model, 0, output)).collect();
    let prepared = has_params(inverse).then(|| {
        let (ty, fields, new) = (linkage_type(model), prepared_fields(inverse), functions::prepare(inverse));
        let doc = format!(" What is prepared for the scene `{}`.", model.scenes[0].name);
        quote! {
            #[doc = #doc]
            #[derive(Clone, Copy, Debug, PartialEq)]
            struct #ty { #(#fields),* }
            #new
        }
    });
    let function = functions::direct(inverse, 0);
    let sweeps = model.sweeps.iter().map(|sweep| sweeps::function(inverse, sweep, runtime));
    quote!(#motion #results #prepared #function #(#sweeps)*)
}

/// What is to be said of the function: its arguments, and how the linkage is placed from them.
pub(super) fn points(inverse: &Linkage) -> Vec<String> {
    let model = &inverse.model;
    let wanted = model.drives.iter().map(|drive| {
        let name = &drive.name;
        format!("* `{name}`: {}", drive_doc(model, &name.text))
    });
    let groups = format!("\nThe linkage is placed from there:\n\n```text\n{}```", motion_blocks(inverse));
    wanted.chain([groups]).collect()
}

/// The same without bodies, for a declaration that has errors.
pub(super) fn stand_ins(model: &Model, runtime: &TokenStream) -> TokenStream {
    let scalar = scalar(model);
    let one = |inverse: &Inverse| {
        let [ty, motion, _] = inverse.types().map(|ty| ident(&ty));
        let function = ident(&format!("{}_at", inverse.name));
        let results = inverse.results.iter().filter_map(|(drive, order)| {
            let drive = model.drives.get(drive.index())?;
            Some(ident(&Model::driver_name(&drive.name.text, *order)))
        });
        let orders = inverse.orders();
        let wanted = inverse.wanted.iter().flat_map(|(name, _)| {
            orders.iter().map(|order| ident(&Model::driver_name(&name.text, Some(*order)))).collect::<Vec<_>>()
        });
        let (results, wanted): (Vec<_>, Vec<_>) = (results.collect(), wanted.collect());
        let placed = inverse.wanted.iter().map(|(name, _)| ident(&name.text));
        let placed: Vec<_> = placed.collect();
        let linkage = (!model.params.is_empty()).then(|| quote!(_: &Linkage,));
        let coordinates = inverse.wanted.iter().map(|_| quote!(_: #scalar,));
        let closures = model.given_closures().next().map(|_| quote!(_: Closures,));
        let given = (!orders.is_empty()).then(|| quote!(_: &#motion));
        let motion = given.as_ref().map(|_| {
            quote! {
                #[derive(Clone, Copy, Debug, Default, PartialEq)]
                pub struct #motion { #(pub #wanted: #scalar),* }
            }
        });
        let sweeps = inverse.sweeps().map(|sweep| {
            let [inputs, outputs] = sweep.types().map(|ty| ident(&ty));
            let name = ident(&sweep.name.text);
            let nothing_given = (placed.is_empty() && wanted.is_empty()).then(sweeps::nothing_lent);
            let nothing_found = results.is_empty().then(sweeps::nothing_lent);
            quote! {
                #[derive(Clone, Copy, Debug, PartialEq)]
                pub struct #inputs<'a> { #(pub #placed: #runtime::Series<'a, #scalar>,)* #(pub #wanted: #runtime::Series<'a, #scalar>,)* #nothing_given }
                #[derive(Debug, PartialEq)]
                pub struct #outputs<'a> { #(pub #results: &'a mut [#scalar],)* #nothing_found }
                pub fn #name(#linkage #closures _: &#inputs<'_>, _: #outputs<'_>) -> Result<(), #runtime::SweepError> { loop {} }
            }
        });
        quote! {
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct #ty { #(pub #results: #scalar),* }
            #motion
            pub fn #function(#linkage #(#coordinates)* #closures #given) -> Result<#ty, Error> { loop {} }
            #(#sweeps)*
        }
    };
    model.inverses.iter().map(one).collect()
}
