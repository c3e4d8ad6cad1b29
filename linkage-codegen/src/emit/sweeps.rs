//! Sweeps: a scene at many positions, from slices into slices.

use std::collections::BTreeSet;
use std::ops::Range;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::body::{Question, with_notes};
use super::functions::{InputNames, body, lane_bindings, outputs};
use super::literals::ident;
use super::stages::{self, Column, Stage, Work};
use super::types::{drive_doc, given_motion, has_params, load_doc, motion_doc, motion_type, run_time_loads, scalar};
use crate::Linkage;
use crate::graph::{Kernel, Op, Symbol};
use crate::model::{Load, LoadKind, Model, Sweep};
use crate::plan::{Output, slice_name};
use crate::program::{Input, Program, Step};

/// What is given at each position. Of a refused declaration, what it says of drives and loads may lead nowhere: it is not told.
fn inputs(model: &Model, sweep: &Sweep, runtime: &TokenStream, whole: bool) -> TokenStream {
    let scalar = scalar(model);
    let scene = &model.scenes[sweep.scene];
    let ty = ident(&sweep.types()[0]);
    let drives = model.drives.iter().map(|drive| {
        let doc = if whole { format!(" {}", drive_doc(model, &drive.name.text)) } else { String::new() };
        (drive.name.text.clone(), doc, quote!(#scalar))
    });
    let motion = model.swept_motion(scene).into_iter();
    let motion = motion.map(|(drive, order)| {
        (drive.motion_name(order), format!(" {}", motion_doc(model, drive, order)), quote!(#scalar))
    });
    let loads = model.swept_loads(scene).into_iter().map(|load| {
        let load = model.load(load);
        let doc = if whole { format!(" {}", load_doc(model, load)) } else { String::new() };
        (load.name.text.clone(), doc, load_value(model, load))
    });
    let doc = format!(" What is given at each position of the sweep `{}`.", sweep.name);
    // In a module that is only a stand-in, names may meet.
    let mut seen = BTreeSet::new();
    let distinct = drives.chain(motion).chain(loads).filter(|(name, ..)| seen.insert(name.clone()));
    let members: Vec<TokenStream> = distinct
        .map(|(name, doc, value)| {
            let name = ident(&name);
            quote!(#[doc = #doc] pub #name: #runtime::Series<'a, #value>)
        })
        .collect();
    let nothing = members.is_empty().then(nothing_lent);
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #ty<'a> { #(#members,)* #nothing }
    }
}

/// What a type without members lends, in a module that is only a stand-in.
pub(super) fn nothing_lent() -> TokenStream {
    quote!(nothing: ::core::marker::PhantomData<&'a ()>)
}

/// The numbers of a scene's results, each with the name of its slice. In a module that is only a stand-in, names may meet.
fn slices(output: &Output) -> Vec<(String, String)> {
    let mut seen = BTreeSet::new();
    let all = output.leaves().into_iter().map(|(path, _)| (slice_name(&path), path));
    all.filter(|(name, _)| seen.insert(name.clone())).collect()
}

/// The number of a result that has this path. Entries of columns and matrices are counted from 1; nalgebra keeps them column by column.
fn number_of(path: &str) -> TokenStream {
    let (names, places): (Vec<&str>, Vec<&str>) = path.split('.').partition(|part| part.parse::<usize>().is_err());
    let names = names.into_iter().map(ident);
    let places: Vec<_> = places.iter().filter_map(|part| part.parse::<usize>().ok()).map(|place| place - 1).collect();
    let entry = match places.as_slice() {
        [] => None,
        [row, columns @ ..] => {
            let column = Literal::usize_unsuffixed(columns.first().copied().unwrap_or(0));
            let row = Literal::usize_unsuffixed(*row);
            Some(quote!(.data.0[#column][#row]))
        }
    };
    quote!(solved #(.#names)* #entry)
}

/// Where the results go.
fn results(model: &Model, sweep: &Sweep, output: &Output) -> TokenStream {
    let scalar = scalar(model);
    let ty = ident(&sweep.types()[1]);
    let scene = &model.scenes[sweep.scene].name;
    let fields = slices(output).into_iter().map(|(name, path)| {
        let (name, doc) = (ident(&name), format!(" `{path}` of the scene `{scene}`."));
        quote!(#[doc = #doc] pub #name: &'a mut [#scalar])
    });
    let doc = format!(" Where the results of the sweep `{}` go: a slice for every number.", sweep.name);
    let fields: Vec<TokenStream> = fields.collect();
    let nothing = fields.is_empty().then(nothing_lent);
    quote! {
        #[doc = #doc]
        #[derive(Debug, PartialEq)]
        pub struct #ty<'a> { #(#fields,)* #nothing }
    }
}

/// Motion and loads of a position, and the arguments that a scene's function takes behind the drives.
fn given_values(linkage: &Linkage, sweep: &Sweep) -> (TokenStream, Vec<TokenStream>) {
    let model = &linkage.model;
    let scene = &model.scenes[sweep.scene];
    let functions = &linkage.functions.scenes[sweep.scene];
    let (motion, loads) = (model.swept_motion(scene), model.swept_loads(scene));
    let member = |name: String| {
        let name = ident(&name);
        quote!(#name: inputs.#name.at(index))
    };
    // What the scene does not read is left as it is.
    let rest = |all: bool, ty: &Ident| (!all).then(|| quote!(..#ty::default()));
    let (motion_ty, loads_ty) = (motion_type(model), ident("Loads"));
    let program = if linkage.functions.near.is_some() { &functions.from_pose } else { &functions.direct };
    let motion_of = program.reads_motion().then(|| {
        let rest = rest(motion.len() == given_motion(model).len(), &motion_ty);
        let members = motion.iter().map(|(drive, order)| member(drive.motion_name(*order)));
        quote!(let motion = #motion_ty { #(#members,)* #rest };)
    });
    let loads_of = program.reads_loads().then(|| {
        let rest = rest(loads.len() == run_time_loads(model).len(), &loads_ty);
        let members = loads.iter().map(|load| member(model.load(*load).name.text.clone()));
        quote!(let loads = Loads { #(#members,)* #rest };)
    });
    let arguments: Vec<TokenStream> =
        [program.reads_motion().then(|| quote!(&motion)), program.reads_loads().then(|| quote!(&loads))]
            .into_iter()
            .flatten()
            .collect();
    (quote!(#motion_of #loads_of), arguments)
}

fn closures_argument(model: &Model) -> Option<TokenStream> {
    model.given_closures().next().map(|_| quote!(closures: Closures,))
}

/// How positions of a sweep are computed beside each other.
struct Lanes {
    /// The type, and what makes it one.
    items: TokenStream,
    /// The call that solves all positions.
    call: TokenStream,
}

/// Whether many positions can be computed at once, without a branch. A search takes as many steps as it needs, elimination exchanges lines,
/// and a comparison of methods is made for a single pose.
fn has_lanes(program: &Program, output: &Output) -> bool {
    let branches = |step: &Step| match step {
        Step::Let(value) => matches!(
            program.op(*value),
            Some(Op::Kernel { kernel: Kernel::Search { .. } | Kernel::Solve2 | Kernel::Solve3 | Kernel::Solve(_), .. })
        ),
        _ => false,
    };
    !program.steps.iter().any(branches) && !matches!(output, Output::Verification(_))
}

/// What a sweep reads of a series.
struct Given {
    series: Ident,
    /// What its values are.
    ty: TokenStream,
    /// Each number that is read, and, of a vector or a spring, which field it is.
    numbers: Vec<(Ident, Option<Ident>)>,
    /// Whether values are read where they lie. Otherwise their fields are copied into columns.
    in_place: bool,
}

/// Every series of which something is read. Whether it is read in place is seen when stages are known.
fn given(linkage: &Linkage, program: &Program) -> Vec<Given> {
    let model = &linkage.model;
    let scalar = scalar(model);
    let mut all: Vec<Given> = Vec::new();
    let names = InputNames::of(linkage);
    for (_, input) in program.inputs() {
        let name = ident(&names.name(input));
        let (series, ty, field) = match input {
            Input::Symbol(Symbol::Drive(_) | Symbol::Driven(..)) => (name.clone(), quote!(#scalar), ""),
            Input::Symbol(Symbol::Load(load, part)) => {
                let load = model.load(load);
                (ident(&load.name.text), load_value(model, load), load.kind.value_name(part))
            }
            _ => continue,
        };
        let number = (name, (!field.is_empty()).then(|| ident(field)));
        match all.iter_mut().find(|other| other.series == series) {
            Some(other) => other.numbers.push(number),
            None => all.push(Given { series, ty, numbers: vec![number], in_place: false }),
        }
    }
    all
}

impl Given {
    fn ty(&self) -> TokenStream {
        let ty = &self.ty;
        let count = Literal::usize_unsuffixed(self.numbers.len());
        if self.in_place { quote!(math::Given<'a, #ty>) } else { quote!(math::Parts<'a, #ty, #count>) }
    }

    /// All of it.
    fn whole(&self) -> TokenStream {
        let series = &self.series;
        let ty = if self.in_place { quote!(Given) } else { quote!(Parts) };
        quote!(math::#ty::new(&self.inputs.#series))
    }

    /// What a block has of that in this place.
    fn block(&self, place: usize) -> TokenStream {
        let place = Literal::usize_unsuffixed(place);
        let fields = self.numbers.iter().flat_map(|(_, field)| field);
        let parts = (!self.in_place).then(|| quote!(, |value| [#(value.#fields),*]));
        quote!(given.#place.block(end #parts))
    }

    /// How its numbers are read there.
    fn lanes(&self, place: usize) -> impl Iterator<Item = TokenStream> {
        let place = Literal::usize_unsuffixed(place);
        self.numbers.iter().enumerate().map(move |(part, (_, field))| {
            let part = Literal::usize_unsuffixed(part);
            let field = field.iter();
            if self.in_place {
                quote!(block.given.#place[lane] #(.#field)*)
            } else {
                quote!(block.given.#place[#part][lane])
            }
        })
    }
}

/// What is given of a load at each position.
fn load_value(model: &Model, load: &Load) -> TokenStream {
    let scalar = scalar(model);
    match load.kind {
        LoadKind::Moment { .. } | LoadKind::Thrust { .. } | LoadKind::Inertia => quote!(#scalar),
        LoadKind::Force { .. } | LoadKind::Gravity { .. } => quote!(Vector2<#scalar>),
        LoadKind::Spring { .. } | LoadKind::Torsion { .. } => {
            let ty = ident(&load.type_name());
            quote!(#ty)
        }
    }
}

/// The positions of a sweep beside each other, and one by one.
fn lanes(linkage: &Linkage, sweep: &Sweep, fields: &[Ident], point: &TokenStream) -> Lanes {
    let model = &linkage.model;
    let program = &linkage.functions.scenes[sweep.scene].direct;
    let [inputs_ty, results_ty] = sweep.types().map(|ty| ident(&ty));
    let ty = ident(&format!("{}Lanes", sweep.types()[1]));
    let mut given = given(linkage, program);
    let column = |name: &Ident| ident(&format!("{name}_lanes"));
    let result_columns = fields.iter().map(column);
    let put = fields.iter().map(|field| {
        let column = column(field);
        quote!(math::put(self.results.#field, positions.clone(), #column);)
    });
    let results_count = Literal::usize_unsuffixed(fields.len());
    let (prepared, closures) = (has_params(linkage), model.given_closures().next().is_some());
    let members = [
        prepared.then(|| quote!(linkage: &'s Linkage)),
        closures.then(|| quote!(closures: Closures)),
        Some(quote!(inputs: &'s #inputs_ty<'a>)),
        Some(quote!(results: #results_ty<'a>)),
    ];
    let names = [
        prepared.then(|| quote!(linkage)),
        closures.then(|| quote!(closures)),
        Some(quote!(inputs)),
        Some(quote!(results)),
    ];
    let (members, names) = (members.into_iter().flatten(), names.into_iter().flatten().collect::<Vec<_>>());
    let shared = [prepared.then(|| quote!(linkage)), closures.then(|| quote!(closures))];
    let shared: Vec<TokenStream> = shared.into_iter().flatten().collect();
    let shared = (!shared.is_empty()).then(|| quote!(let Self { #(#shared,)* .. } = *self;));
    let bindings = lane_bindings(linkage, program);
    let (statements, conditions, body) = body(linkage, program).straight();
    let results = outputs(&body, program);
    let numbers: Vec<Ident> =
        given.iter().flat_map(|given| given.numbers.iter().map(|(name, _)| name.clone())).collect();
    let stages = stages::stages(Work { statements, conditions, results }, &numbers);
    let mut first = 0;
    for given in &mut given {
        let places = first..first + given.numbers.len();
        given.in_place = is_read_in_place(given, places.clone(), &stages);
        first = places.end;
    }
    let lanes_given: Vec<_> = given.iter().enumerate().flat_map(|(place, given)| given.lanes(place)).collect();
    let (given_types, given_whole) = (given.iter().map(Given::ty), given.iter().map(Given::whole));
    let given_blocks = given.iter().enumerate().map(|(place, given)| given.block(place));
    let kept = stages.iter().flat_map(|stage| &stage.keeps).filter_map(|(column, _)| match column {
        Column::Kept(place) => Some(place + 1),
        _ => None,
    });
    let kept_count = Literal::usize_unsuffixed(kept.max().unwrap_or(0));
    // What reads neither drives nor loads has no checks.
    let checked = stages.iter().any(|stage| !stage.conditions.is_empty());
    let count = checked.then(|| quote!(let mut failed: math::Marks = 0;));
    let holds = if checked { quote!(math::all_hold(failed)) } else { quote!(true) };
    let loops = stages.into_iter().map(|stage| loop_over(stage, &lanes_given));
    let doc = format!(" The positions of the sweep `{}`, of which several are computed at once.", sweep.name);
    let items = quote! {
        #[doc = #doc]
        struct #ty<'s, 'a> { #(#members,)* }
        impl<'a> math::Lanes<#kept_count, #results_count> for #ty<'_, 'a> {
            type Given = (#(#given_types,)*);
            #[inline(always)]
            fn given(&self) -> Self::Given {
                (#(#given_whole,)*)
            }
            #[inline(always)]
            fn solve(
                &self,
                given: &mut Self::Given,
                end: usize,
                columns: &mut math::Columns<#kept_count, #results_count>,
                from: usize,
            ) -> bool {
                let block = columns.block((#(#given_blocks,)*));
                let lanes = from..math::BLOCK;
                #shared
                #bindings
                #count
                #(#loops)*
                #holds
            }
            #[inline(always)]
            fn take(&mut self, positions: ::core::ops::Range<usize>, [#(#result_columns),*]: &[math::Column; #results_count]) {
                #(#put)*
            }
            fn point(&mut self, index: usize) -> Result<(), Error> {
                let Self { #(#names),* } = self;
                #point
            }
        }
    };
    let first = &fields[0];
    Lanes { items, call: quote!(math::sweep(count, math::lead(results.#first), &mut #ty { #(#names),* })) }
}

/// Whether values are numbers, or vectors of which each stage that reads a component reads the other one too: then registers are full of what
/// is read. The numbers have these places.
fn is_read_in_place(given: &Given, places: Range<usize>, stages: &[Stage]) -> bool {
    let is_component = |field: &Ident| field == "x" || field == "y";
    let is_whole = match given.numbers.as_slice() {
        [(_, field)] => field.is_none(),
        [(_, Some(one)), (_, Some(other))] => is_component(one) && is_component(other),
        _ => false,
    };
    let all_or_none = |stage: &Stage| {
        let is_read = |place: &usize| stage.reads.iter().any(|(_, column)| *column == Column::Given(*place));
        let count = places.clone().filter(is_read).count();
        count == 0 || count == places.len()
    };
    is_whole && stages.iter().all(all_or_none)
}

/// A loop over the positions of a block, for which numbers are given so.
fn loop_over(Stage { reads, statements, conditions, keeps }: Stage, given: &[TokenStream]) -> TokenStream {
    let of = |column: Column| match column {
        Column::Given(place) => given[place].clone(),
        Column::Kept(place) => {
            let place = Literal::usize_unsuffixed(place);
            quote!(block.kept[#place][lane])
        }
        Column::Result(place) => {
            let place = Literal::usize_unsuffixed(place);
            quote!(block.results[#place][lane])
        }
    };
    let statements = with_notes(&statements);
    let reads = reads.into_iter().map(|(name, column)| {
        let value = of(column);
        quote!(let #name = #value;)
    });
    let keeps = keeps.into_iter().map(|(column, value)| {
        let place = of(column);
        quote!(#place = #value;)
    });
    let failures = failures(conditions).map(|failures| quote!(failed |= #failures;));
    quote! {
        for lane in lanes.clone() {
            #(#reads)*
            #statements
            #(#keeps)*
            #failures
        }
    }
}

/// The marks of all that fails, if anything can.
fn failures(conditions: Vec<Question>) -> Option<TokenStream> {
    let (mut holds, mut marks) = (Vec::new(), Vec::new());
    for condition in conditions {
        match condition {
            Question::Holds(condition) => holds.push(condition),
            Question::Marks(condition) => marks.push(condition),
        }
    }
    let all = holds.into_iter().reduce(|all, one| quote!(#all & #one));
    all.map(|all| quote!(math::failed(#all))).into_iter().chain(marks).reduce(|all, one| quote!(#all | #one))
}

/// A sweep with its types.
pub(super) fn function(linkage: &Linkage, sweep: &Sweep, runtime: &TokenStream) -> TokenStream {
    let model = &linkage.model;
    let scene = &model.scenes[sweep.scene];
    let output = &linkage.plan.scenes[sweep.scene];
    let (inputs, results) = (inputs(model, sweep, runtime, true), results(model, sweep, output));
    let name = ident(&sweep.name.text);
    let [inputs_ty, results_ty] = sweep.types().map(|ty| ident(&ty));
    let slices = slices(output);
    let fields: Vec<_> = slices.iter().map(|(name, _)| ident(name)).collect();
    let texts: Vec<_> = slices.iter().map(|(name, _)| name).collect();
    let paths = slices.iter().map(|(_, path)| number_of(path));
    let (motion, loads) = (model.swept_motion(scene), model.swept_loads(scene));
    let given_names = model.drives.iter().map(|drive| drive.name.text.clone());
    let given_names = given_names.chain(motion.iter().map(|(drive, order)| drive.motion_name(*order)));
    let given_names = given_names.chain(loads.iter().map(|load| model.load(*load).name.text.clone()));
    let given_names: Vec<String> = given_names.collect();
    let given = given_names.iter().map(|name| ident(name));
    let drives: Vec<TokenStream> = model
        .drives
        .iter()
        .map(|drive| {
            let name = ident(&drive.name.text);
            quote!(inputs.#name.at(index))
        })
        .collect();
    let (given_values, arguments) = given_values(linkage, sweep);
    let (prepared, passed) =
        if has_params(linkage) { (Some(quote!(linkage: &Linkage,)), Some(quote!(linkage,))) } else { (None, None) };
    // One choice for the whole sweep.
    let closures = closures_argument(model);
    let scene_name = ident(&scene.name.text);
    let direct = ident(&format!("{}_at", scene.name));
    let stored = quote!(#(store(results.#fields, index, #paths);)*);
    let (items, solved, branch) = if linkage.functions.near.is_some() {
        let closed = closures.is_some().then(|| quote!(closures,));
        let solved = quote! {
            let mut before: Option<Pose> = None;
            sweep(count, |index| {
                #given_values
                let pose = match before {
                    Some(before) => before.moved_to(#(#drives),*)?,
                    None => Pose::at(#passed #(#drives,)* #closed)?,
                };
                before = Some(pose);
                let solved = pose.#scene_name(#(#arguments),*)?;
                #stored
                Ok(())
            })
        };
        let branch = "From the second position on, groups that are placed by Newton's method are searched from the pose before, so that \
                      the sweep stays on their branch: that is [`Pose::moved_to`].";
        (None, solved, branch.to_owned())
    } else {
        let branch = format!("Each position has the numbers of [`{}_at`], bit by bit.", scene.name);
        let point = |closed: TokenStream| {
            quote! {
                #given_values
                let solved = #direct(#passed #(#drives,)* #closed #(#arguments),*)?;
                #stored
                Ok(())
            }
        };
        if has_lanes(&linkage.functions.scenes[sweep.scene].direct, output) && !fields.is_empty() {
            let closed = closures.is_some().then(|| quote!(*closures,));
            let Lanes { items, call } = lanes(linkage, sweep, &fields, &point(quote!(#closed)));
            (Some(items), call, branch)
        } else {
            let closed = closures.is_some().then(|| quote!(closures,));
            let point = point(quote!(#closed));
            (None, quote!(sweep(count, |index| { #point })), branch)
        }
    };
    let docs = [
        format!(" The scene `{}` at every position, in order.", scene.name),
        String::new(),
        format!(" {branch}"),
        " There are as many positions as the results have room; a series of values has one for each of them.".to_owned(),
        String::new(),
        " # Errors".to_owned(),
        String::new(),
        " `SweepError::Length` if slices are not all of one length: then nothing is computed. `SweepError::Position` with the first position that".to_owned(),
        " has no answer, and why; those before it have theirs, those behind it are untouched.".to_owned(),
    ];
    let count = fields.first().map_or_else(|| quote!(0), |first| quote!(results.#first.len()));
    quote! {
        #inputs
        #results
        #(#[doc = #docs])*
        pub fn #name(#prepared #closures inputs: &#inputs_ty<'_>, results: #results_ty<'_>) -> Result<(), #runtime::SweepError> {
            use #runtime::__private::{same_length, store, sweep};
            #items
            let count = #count;
            #(same_length(#texts, results.#fields.len(), count)?;)*
            #(inputs.#given.check(#given_names, count)?;)*
            #solved
        }
    }
}

/// The same without a body, for a declaration that has errors.
pub(super) fn stand_in(model: &Model, sweep: &Sweep, output: &Output, runtime: &TokenStream) -> TokenStream {
    let (inputs, results) = (inputs(model, sweep, runtime, false), results(model, sweep, output));
    let name = ident(&sweep.name.text);
    let [inputs_ty, results_ty] = sweep.types().map(|ty| ident(&ty));
    let prepared = (!model.params.is_empty()).then(|| quote!(linkage: &Linkage,));
    let closures = closures_argument(model);
    quote! {
        #inputs
        #results
        pub fn #name(#prepared #closures inputs: &#inputs_ty<'_>, results: #results_ty<'_>) -> Result<(), #runtime::SweepError> { loop {} }
    }
}
