//! The functions of a module.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::body::Body;
use super::literals::ident;
use super::types::{drive_doc, has_params, linkage_type, motion_type, output_type, record_name, scalar};
use super::{docs, prepared_names};
use crate::Linkage;
use crate::graph::{NodeId, Order, Symbol};
use crate::model::ids::{DriveId, LoadId};
use crate::model::{LoadKind, Method, Model, SWEPT, type_name};
use crate::plan::{Comparison, Output};
use crate::program::{Input, Program, ValueId};

/// Names that a function's own values cannot have, nor what is prepared, of which functions make values: those of what they are given and of
/// constants of the module, and those by which a sweep computes.
pub(super) fn taken() -> Vec<&'static str> {
    let own = ["motion", "loads", "linkage", "params", "closures", "EQUATIONS", "LIMITS", "OPERATIONS", "SOURCE"];
    own.into_iter().chain(SWEPT).collect()
}

/// The names of inputs.
pub(super) struct InputNames<'a> {
    linkage: &'a Linkage,
    /// Those of what is prepared, once one of them is read: few functions read any.
    prepared: OnceCell<BTreeMap<NodeId, String>>,
}

impl<'a> InputNames<'a> {
    pub(super) fn of(linkage: &'a Linkage) -> Self {
        Self { linkage, prepared: OnceCell::new() }
    }

    /// That of one.
    pub(super) fn name(&self, input: Input) -> String {
        let model = &self.linkage.model;
        match input {
            Input::Symbol(Symbol::Drive(drive)) => model.drive(drive).name.text.clone(),
            Input::Symbol(Symbol::Parameter(param)) => model.param(param).name.text.clone(),
            Input::Symbol(Symbol::Side(closure)) => format!("side_{}", model.joint(model.closure(closure).joint).name),
            Input::Symbol(Symbol::Load(load, part)) => {
                let load = model.load(load);
                load.value_name(load.kind.value_name(part))
            }
            Input::Symbol(Symbol::Driven(drive, order)) => model.drive(drive).motion_name(order),
            // A number of an unknown, at the pose from which its search starts.
            Input::Symbol(Symbol::Start(search, number)) => {
                format!("{}_before", super::search::kept_name(model, &model.graph.search(search), number))
            }
            // Only in the functions of searches, and nowhere.
            Input::Symbol(Symbol::Sought(..) | Symbol::Coordinate(..) | Symbol::Moving(..) | Symbol::Dimension(_))
            | Input::Known(_) => String::new(),
            Input::Kept(node) => {
                let kept = self.linkage.plan.pose.iter().find(|kept| kept.node == node);
                kept.map_or_else(String::new, |kept| kept.name.clone())
            }
            Input::Prepared(node) => {
                let names = self.prepared.get_or_init(|| prepared_names(self.linkage));
                names.get(&node).cloned().unwrap_or_default()
            }
        }
    }
}

/// The names of all that functions read but parameters and what is made of these.
pub(super) fn given_names(linkage: &Linkage) -> Vec<String> {
    let model = &linkage.model;
    let drives = model.drives.iter().flat_map(|drive| {
        let motion = [Order::Rate, Order::Acceleration].map(|order| drive.motion_name(order));
        motion.into_iter().chain([drive.name.text.clone()])
    });
    let loads = model.loads.iter().flat_map(|load| {
        let values = load.kind.values().into_iter().map(|(value, _)| load.value_name(value));
        values.chain([load.name.text.clone()])
    });
    let sides = model.given_closures().map(|(_, closure)| format!("side_{}", model.joint(closure.joint).name));
    let kept = linkage.plan.pose.iter().flat_map(|kept| [kept.name.clone(), format!("{}_before", kept.name)]);
    drives.chain(loads).chain(sides).chain(kept).collect()
}

/// The body of a function.
pub(super) fn body<'a>(linkage: &'a Linkage, program: &'a Program) -> Body<'a> {
    let names = InputNames::of(linkage);
    Body::new(program, &linkage.model.graph, &|input| names.name(input), &taken())
}

/// Where a function has the coordinates of the drives from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Drives {
    Arguments,
    Pose,
    /// Arguments, and the rest from a pose that is moved.
    Moved,
    /// Arguments, as are rates and loads.
    Lane,
}

/// Statements that take what does not change along a sweep out of where it is kept.
pub(super) fn lane_bindings(linkage: &Linkage, program: &Program) -> TokenStream {
    bindings(linkage, program, Drives::Lane)
}

/// Statements that take a function's inputs out of where they are kept.
fn bindings(linkage: &Linkage, program: &Program, drives: Drives) -> TokenStream {
    let mut prepared = Vec::new();
    let mut kept = Vec::new();
    let mut motion = Vec::new();
    let mut statements = TokenStream::new();
    let mut loads: BTreeMap<LoadId, Vec<u8>> = BTreeMap::new();
    let names = InputNames::of(linkage);
    for (_, input) in program.inputs() {
        let name = ident(&names.name(input));
        match input {
            Input::Prepared(_) => prepared.push(name),
            Input::Kept(_) => kept.push(quote!(#name)),
            Input::Symbol(Symbol::Drive(_)) if drives == Drives::Pose => kept.push(quote!(#name)),
            Input::Symbol(Symbol::Start(search, number)) => {
                let own = ident(&super::search::kept_name(&linkage.model, &linkage.model.graph.search(search), number));
                kept.push(quote!(#own: #name));
            }
            Input::Symbol(Symbol::Driven(..)) => motion.push(name),
            Input::Symbol(Symbol::Load(load, part)) => loads.entry(load).or_default().push(part),
            Input::Symbol(Symbol::Side(closure)) => {
                let scalar = scalar(&linkage.model);
                let joint = ident(&linkage.model.joint(linkage.model.closure(closure).joint).name.text);
                let given = matches!(drives, Drives::Arguments | Drives::Lane);
                let of = if given { quote!(closures) } else { quote!(self.closures) };
                statements.extend(quote!(let #name = #scalar::from(#of.#joint.sign());));
            }
            Input::Symbol(_) | Input::Known(_) => {}
        }
    }
    if !kept.is_empty() {
        statements.extend(quote!(let Self { #(#kept,)* .. } = *self;));
    }
    if !prepared.is_empty() {
        let ty = linkage_type(&linkage.model);
        // What is prepared for an inverse scene is a part of the linkage.
        let of = linkage.model.exchanged.as_ref().map(|_| super::inverses::prepared_name(linkage));
        let whole = of.map_or_else(|| quote!(*linkage), |part| quote!(linkage.#part));
        statements.extend(quote!(let #ty { #(#prepared,)* .. } = #whole;));
    }
    if drives == Drives::Lane {
        return statements;
    }
    if !motion.is_empty() {
        let ty = motion_type(&linkage.model);
        statements.extend(quote!(let #ty { #(#motion,)* .. } = *motion;));
    }
    for (load, read) in loads {
        let data = linkage.model.load(load);
        let name = ident(&data.name.text);
        let local = |part: u8| ident(&names.name(Input::Symbol(Symbol::Load(load, part))));
        statements.extend(match data.kind {
            LoadKind::Moment { .. } | LoadKind::Thrust { .. } => quote!(let #name = loads.#name;),
            LoadKind::Force { .. } | LoadKind::Gravity { .. } => {
                let part = |part: u8| {
                    let name = local(part);
                    if read.contains(&part) { quote!(#name) } else { quote!(_) }
                };
                let (x, y) = (part(0), part(1));
                quote!(let [[#x, #y]] = loads.#name.data.0;)
            }
            LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
                let each = read.iter().map(|part| {
                    let (field, local) = (ident(data.kind.value_name(*part)), local(*part));
                    quote!(let #local = loads.#name.#field;)
                });
                each.collect()
            }
            LoadKind::Inertia => TokenStream::new(),
        });
    }
    statements
}

/// A member of a struct expression, in short where name and value are the same.
fn member(name: &str, value: &TokenStream) -> TokenStream {
    let name = ident(name);
    if name == value.to_string() { quote!(#name) } else { quote!(#name: #value) }
}

/// The expression of a result.
fn result(
    method: Method,
    base: &str,
    parent: &str,
    output: &Output,
    values: &mut dyn Iterator<Item = TokenStream>,
) -> TokenStream {
    let mut next = || values.next().unwrap_or_else(|| quote!(0.0));
    match output {
        Output::Scalar(..) => next(),
        Output::Vector(..) => {
            let (x, y) = (next(), next());
            quote!(Vector2::new(#x, #y))
        }
        Output::Column(values) => {
            let values = values.iter().map(|_| next()).collect::<Vec<_>>();
            quote!(SVector::from([#(#values),*]))
        }
        Output::Matrix(rows) => {
            // Column by column, as they come.
            let columns: Vec<TokenStream> = (0..rows.len())
                .map(|_| {
                    let values = rows.iter().map(|_| next()).collect::<Vec<_>>();
                    quote!([#(#values),*])
                })
                .collect();
            quote!(SMatrix::from([#(#columns),*]))
        }
        Output::Resolved(_) => {
            let (axial, transverse) = (next(), next());
            quote!(ResolvedForce { axial: #axial, transverse: #transverse })
        }
        Output::Reaction { ty, parts, .. } => {
            let (x, y) = (next(), next());
            let parts = parts.iter().map(|(part, _)| {
                let (part, value) = (ident(part), next());
                quote!(#part: #value)
            });
            let (ty, parts) = (ident(ty), parts.collect::<Vec<_>>());
            quote!(#ty { force: Vector2::new(#x, #y), #(#parts),* })
        }
        Output::Term { .. } => {
            let (velocity, work) = (next(), next());
            quote!(WorkTerm { velocity: #velocity, work: #work })
        }
        Output::Verification(comparison) => verification(comparison, values),
        Output::Record(fields) => {
            let ty = ident(parent);
            let members: Vec<TokenStream> = fields
                .iter()
                .map(|field| {
                    let child = record_name(method, base, parent, &field.name, &field.value);
                    member(&field.name, &result(method, base, &child, &field.value, values))
                })
                .collect();
            quote!(#ty { #(#members),* })
        }
    }
}

/// The comparison of all methods, at run time.
fn verification(comparison: &Comparison, values: &mut dyn Iterator<Item = TokenStream>) -> TokenStream {
    let mut take = |count: usize| (0..count).filter_map(|_| values.next()).collect::<Vec<_>>();
    let Comparison { coefficients, loads, moments, equilibrium, superposition, virtual_work } = comparison;
    let coefficients = coefficients.iter().zip(take(coefficients.len())).map(|((line, column, _), value)| {
        let (line, column) = (Literal::usize_unsuffixed(*line), Literal::usize_unsuffixed(*column));
        quote!((#line, #column, #value))
    });
    let coefficients: Vec<TokenStream> = coefficients.collect();
    let [loads, equilibrium, superposition, virtual_work] =
        [loads, equilibrium, superposition, virtual_work].map(|list| take(list.len()));
    quote! {
        verify(&Compared {
            coefficients: &[#(#coefficients),*],
            loads: &[#(#loads),*],
            moments: &[#(#moments),*],
            equilibrium: &[#(#equilibrium),*],
            superposition: &[#(#superposition),*],
            virtual_work: &[#(#virtual_work),*],
        })?
    }
}

pub(super) fn outputs(body: &Body<'_>, program: &Program) -> Vec<TokenStream> {
    program.outputs.iter().map(|(_, value): &(String, ValueId)| body.value(*value)).collect()
}

/// Whether what is asked of a pose reads the sides on which it closes.
pub(super) fn pose_keeps_closures(linkage: &Linkage) -> bool {
    let functions = &linkage.functions;
    let scenes = functions.scenes.iter().map(|scene| &scene.from_pose);
    if functions.near.is_some() && linkage.model.given_closures().next().is_some() {
        return true;
    }
    let mut inputs = functions.accessors.iter().chain(scenes).flat_map(Program::inputs);
    inputs.any(|(_, input)| matches!(input, Input::Symbol(Symbol::Side(_))))
}

/// The arguments that give the drives, and the closures if they are chosen at run time.
fn drive_arguments(linkage: &Linkage) -> Vec<TokenStream> {
    let closures = linkage.model.given_closures().next().map(|_| quote!(closures: Closures));
    coordinates(linkage).into_iter().chain(closures).collect()
}

/// The arguments that give the drives.
fn coordinates(linkage: &Linkage) -> Vec<TokenStream> {
    let scalar = scalar(&linkage.model);
    let arguments = linkage.model.drives.iter().map(|drive| {
        let name = ident(&drive.name.text);
        quote!(#name: #scalar)
    });
    arguments.collect()
}

fn linkage_argument(linkage: &Linkage, lifetime: &TokenStream) -> TokenStream {
    if has_params(linkage) { quote!(linkage: &#lifetime Linkage,) } else { TokenStream::new() }
}

/// The program of `Linkage::new`, with the names of what it prepares.
pub(super) fn prepare_program(linkage: &Linkage) -> Program {
    let mut program = linkage.functions.prepare.clone();
    let names = prepared_names(linkage);
    for ((path, _), node) in program.outputs.iter_mut().zip(&linkage.functions.prepared) {
        path.clone_from(&names[node]);
    }
    program
}

/// The parameters as values of their own, each a finite number.
pub(super) fn given_params(linkage: &Linkage) -> TokenStream {
    let params = linkage.model.params.iter().map(|param| ident(&param.name.text));
    let finite = linkage.model.params.iter().map(|param| {
        let name = ident(&param.name.text);
        let text = &param.name.text;
        quote!(if !#name.is_finite() { return Err(Error::NotFinite { what: #text }); })
    });
    quote! {
        let Params { #(#params),* } = *params;
        #(#finite)*
    }
}

/// `Linkage::new`.
pub(super) fn prepare(linkage: &Linkage) -> TokenStream {
    let program = prepare_program(linkage);
    let (statements, body) = body(linkage, &program).statements();
    let fields = program.outputs.iter().map(|(name, value)| member(name, &body.value(*value)));
    let given = given_params(linkage);
    let inverses = linkage.inverses.iter().map(|inverse| {
        let (name, ty) = (super::inverses::prepared_name(inverse), linkage_type(&inverse.model));
        quote!(#name: #ty::new(params)?)
    });
    let (ty, visibility) = match linkage.model.exchanged {
        Some(_) => (linkage_type(&linkage.model), None),
        None => (ident("Linkage"), Some(quote!(pub))),
    };
    quote! {
        impl #ty {
            /// Prepares the linkage of some dimensions.
            ///
            /// # Errors
            ///
            /// [`Error::Parameter`] if a dimension is out of its range, [`Error::NotFinite`] if one, or what is
            /// made of them, is not a finite number.
            #visibility fn new(params: &Params) -> Result<Self, Error> {
                #given
                #statements
                Ok(Self { #(#fields,)* #(#inverses),* })
            }
        }
    }
}

/// `Pose::at`, and with searches `Pose::moved_to`.
pub(super) fn poses(linkage: &Linkage) -> TokenStream {
    let summary = "The pose at given coordinates of the drives.";
    let start = "Groups that are placed by Newton's method are followed from their declared start: the drives go straight from where they \
                 start to the given coordinates. A pose to which no motion leads that way is [`Error::NoConvergence`].";
    let unposed = (!linkage.unposed.is_empty()).then(|| {
        let sides = linkage.unposed.iter().map(|sides| format!("with {sides}")).collect::<Vec<_>>().join(", ");
        format!("At the start of the drives it does not close {sides}: from there no pose has these sides.")
    });
    let points: Vec<&str> =
        linkage.functions.near.is_some().then_some(start).into_iter().chain(unposed.as_deref()).collect();
    let receiver = linkage_argument(linkage, &quote!('l));
    let own = if has_params(linkage) { quote!(linkage,) } else { TokenStream::new() };
    let mut all = pose_function(linkage, &linkage.functions.pose, &quote!(at), &receiver, &own, summary, &points);
    if let Some(near) = &linkage.functions.near {
        let summary = "The pose at other coordinates of the drives, from this one.";
        let points = [
            "Groups that are placed by Newton's method are followed from where they are: the drives go straight from their coordinates to \
             the given ones. A pose to which no motion leads that way, through a singular pose for one, is [`Error::NoConvergence`].",
        ];
        let own = if has_params(linkage) { quote!(linkage: self.linkage,) } else { TokenStream::new() };
        all.extend(pose_function(linkage, near, &quote!(moved_to), &quote!(&self,), &own, summary, &points));
    }
    all
}

fn pose_function(
    linkage: &Linkage,
    program: &Program,
    name: &TokenStream,
    receiver: &TokenStream,
    own: &TokenStream,
    summary: &str,
    points: &[&str],
) -> TokenStream {
    let from_self = receiver.to_string().contains("self");
    let prepared = if from_self { prepared_of_pose(linkage, program) } else { TokenStream::new() };
    let bindings = bindings(linkage, program, if from_self { Drives::Moved } else { Drives::Arguments });
    let (statements, body) = body(linkage, program).statements();
    let values = outputs(&body, program);
    let kept = linkage.plan.pose.iter().zip(values).map(|(kept, value)| member(&kept.name, &value));
    let drives = linkage.model.drives.iter().map(|drive| ident(&drive.name.text));
    let arguments = if from_self { coordinates(linkage) } else { drive_arguments(linkage) };
    // A drive that no direction depends on is checked all the same.
    let read: Vec<Input> = program.inputs().map(|(_, input)| input).collect();
    let unread =
        (0..linkage.model.drives.len()).map(DriveId::new).filter(|d| !read.contains(&Input::Symbol(Symbol::Drive(*d))));
    let unread = unread.map(|drive| {
        let text = &linkage.model.drive(drive).name.text;
        let name = ident(text);
        quote!(if !#name.is_finite() { return Err(Error::NotFinite { what: #text }); })
    });
    let drive_docs =
        linkage.model.drives.iter().map(|d| format!("* `{}`: {}", d.name, drive_doc(&linkage.model, &d.name.text)));
    let closures = linkage.model.given_closures().next().filter(|_| !from_self);
    let closure_doc = closures.map(|_| "* `closures`: On which side each group closes.".to_owned());
    let keeps = pose_keeps_closures(linkage)
        .then(|| if from_self { quote!(closures: self.closures,) } else { quote!(closures,) });
    let mut points: Vec<String> = points.iter().map(|point| format!("{point}\n")).collect();
    points.extend(drive_docs.chain(closure_doc));
    let lines = docs::function(linkage, summary, &points, program, &[]);
    quote! {
        #lines
        #[inline]
        pub fn #name(#receiver #(#arguments),*) -> Result<Self, Error> {
            #(#unread)*
            #prepared
            #bindings
            #statements
            Ok(Self { #own #(#drives,)* #keeps #(#kept),* })
        }
    }
}

/// The methods that ask a pose for places and directions.
pub(super) fn accessors(linkage: &Linkage) -> TokenStream {
    let all = linkage.plan.accessors.iter().zip(&linkage.functions.accessors).map(|(accessor, program)| {
        let name = ident(&accessor.name);
        let prepared = prepared_of_pose(linkage, program);
        let bindings = bindings(linkage, program, Drives::Pose);
        let plain = without_checks_and_headings(program);
        let (statements, body) = body(linkage, &plain).statements();
        let doc = format!(" {}", accessor.meaning);
        let ty = output_type(&linkage.model, &accessor.output, "");
        let value = result(Method::Position, "", "", &accessor.output, &mut outputs(&body, &plain).into_iter());
        quote! {
            #[doc = #doc]
            #[inline]
            #[must_use]
            pub fn #name(&self) -> #ty {
                #prepared
                #bindings
                #statements
                #value
            }
        }
    });
    all.collect()
}

/// A pose's own values are finite, and what follows from them by a few sums is too. What they are, the method's documentation says: the
/// heading would be the one under which they were first of use.
fn without_checks_and_headings(program: &Program) -> Program {
    let mut program = program.clone();
    program.steps.retain(|step| matches!(step, crate::program::Step::Let(_)));
    program.values.iter_mut().for_each(|value| value.section.clear());
    program
}

fn prepared_of_pose(linkage: &Linkage, program: &Program) -> TokenStream {
    let reads = program.inputs().any(|(_, input)| matches!(input, Input::Prepared(_)));
    if reads && has_params(linkage) { quote!(let linkage = self.linkage;) } else { TokenStream::new() }
}

/// A scene from a pose.
pub(super) fn from_pose(linkage: &Linkage, index: usize) -> TokenStream {
    let scene = &linkage.model.scenes[index];
    let program = &linkage.functions.scenes[index].from_pose;
    let name = ident(&scene.name.text);
    let ty = output_type(&linkage.model, &linkage.plan.scenes[index], &type_name(&scene.name.text));
    let given = given_arguments(linkage, program);
    let prepared = prepared_of_pose(linkage, program);
    let bindings = bindings(linkage, program, Drives::Pose);
    let (statements, body) = body(linkage, program).statements();
    let base = type_name(&scene.name.text);
    let value =
        result(scene.method, &base, &base, &linkage.plan.scenes[index], &mut outputs(&body, program).into_iter());
    let lines = docs::function(
        linkage,
        &docs::scene_summary(linkage, index, true),
        &[],
        program,
        &body.equations(&linkage.model),
    );
    quote! {
        #lines
        #[inline]
        pub fn #name(&self #given) -> Result<#ty, Error> {
            #prepared
            #bindings
            #statements
            Ok(#value)
        }
    }
}

/// The arguments behind the drives.
fn given_arguments(linkage: &Linkage, program: &Program) -> TokenStream {
    let ty = motion_type(&linkage.model);
    let motion = program.reads_motion().then(|| quote!(, motion: &#ty));
    let loads = program.reads_loads().then(|| quote!(, loads: &Loads));
    quote!(#motion #loads)
}

/// Of an equation of motion, the accelerations that follow from efforts; none if a part of it is missing.
pub(super) fn forward(model: &Model, index: usize) -> TokenStream {
    let name = &model.scenes[index].name.text;
    let Some(signature) = super::types::forward_signature(model, index) else { return TokenStream::new() };
    let ty = ident(&type_name(name));
    let unknowns = model.unknowns.len();
    let body = if unknowns == 1 {
        quote! {
            let Self { M, h, rounding, .. } = *self;
            if !(M.abs() > rounding) {
                return Err(Error::NoInertia { scene: #name });
            }
            let acceleration = (effort - h) / M;
            if !math::all_finite([acceleration]) {
                return Err(Error::NotFinite { what: "an effort or an acceleration" });
            }
            Ok(acceleration)
        }
    } else {
        // A pivot counts against the rounding that the same elimination makes of that of the masses.
        let number = |name: &str, row: usize, column: usize| ident(&format!("{name}_{}_{}", row + 1, column + 1));
        let list = |one: &dyn Fn(usize) -> TokenStream| {
            let all = (0..unknowns).map(one).collect::<Vec<_>>();
            quote!([#(#all),*])
        };
        // Matrices of nalgebra are stored by columns.
        let [by_rows, by_columns] = [false, true].map(|by_columns| {
            move |name: &'static str| {
                list(&|outer| {
                    list(&|inner| {
                        let (row, column) = if by_columns { (inner, outer) } else { (outer, inner) };
                        let name = number(name, row, column);
                        quote!(#name)
                    })
                })
            }
        });
        let part = |name: &str, row: usize| ident(&format!("{name}_{}", row + 1));
        let [efforts, biases] = ["effort", "h"].map(|name| {
            list(&|row| {
                let name = part(name, row);
                quote!(#name)
            })
        });
        let open = list(&|row| {
            let (effort, bias) = (part("effort", row), part("h", row));
            quote!(#effort - #bias)
        });
        let [masses, roundings] = ["M", "rounding"].map(by_columns);
        let [matrix, sizes] = ["M", "rounding"].map(by_rows);
        quote! {
            let (#masses, #roundings) = (self.M.data.0, self.rounding.data.0);
            let ([#biases], [#efforts]) = (self.h.data.0, effort.data.0);
            let (accelerations, distance) = math::solve(#matrix, #sizes, #open);
            if !(distance.abs() > 1.0) {
                return Err(Error::NoInertia { scene: #name });
            }
            if !math::all_finite(accelerations) {
                return Err(Error::NotFinite { what: "an effort or an acceleration" });
            }
            Ok(SVector::from(accelerations))
        }
    };
    quote! {
        impl #ty {
            /// Forward dynamics: the accelerations of the drives under given efforts, `q̈ = M⁻¹ (τ − h)`.
            ///
            /// # Errors
            ///
            /// * [`Error::NoInertia`]: `M` is singular: no mass resists some acceleration, or none that is more than rounding.
            /// * [`Error::NotFinite`]: an effort is not a finite number, or an acceleration is too large for one.
            #[inline]
            #signature { #body }
        }
    }
}

/// A scene straight from the drives.
pub(super) fn direct(linkage: &Linkage, index: usize) -> TokenStream {
    let scene = &linkage.model.scenes[index];
    let program = &linkage.functions.scenes[index].direct;
    let name = ident(&format!("{}_at", scene.name));
    let ty = output_type(&linkage.model, &linkage.plan.scenes[index], &type_name(&scene.name.text));
    let given = given_arguments(linkage, program);
    let prepared = linkage_argument(linkage, &TokenStream::new());
    let arguments = drive_arguments(linkage);
    let bindings = bindings(linkage, program, Drives::Arguments);
    let (statements, body) = body(linkage, program).statements();
    let base = type_name(&scene.name.text);
    let value =
        result(scene.method, &base, &base, &linkage.plan.scenes[index], &mut outputs(&body, program).into_iter());
    let points = match scene.method {
        Method::Inverse => super::inverses::points(linkage),
        _ => vec![format!(
            "The equations are those of [`Pose::at`] and [`Pose::{}`], as far as the results need them.",
            ident(&scene.name.text)
        )],
    };
    let equations = if scene.method == Method::Inverse { body.equations(&linkage.model) } else { Vec::new() };
    let lines = docs::function(linkage, &docs::scene_summary(linkage, index, false), &points, program, &equations);
    quote! {
        #lines
        #[inline]
        pub fn #name(#prepared #(#arguments),* #given) -> Result<#ty, Error> {
            #bindings
            #statements
            Ok(#value)
        }
    }
}
