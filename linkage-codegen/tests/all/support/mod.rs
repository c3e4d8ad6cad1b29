//! What the tests of the compiler share.
#![allow(unreachable_pub, reason = "all of it is for the tests alone")]
#![allow(clippy::missing_panics_doc, clippy::must_use_candidate, reason = "tests panic where something is wrong")]

pub mod bounds;
pub mod declarations;
pub mod examples;
pub mod families;
pub mod far_points;
pub mod general;
pub mod linkages;
pub mod measures;
pub mod numbers;

use std::collections::HashMap;

use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;
use linkage_codegen::graph::{NodeValues, Order, Sought, Symbol};
use linkage_codegen::model::ids::{DriveId, ParamId};
use linkage_codegen::program::{Fault, Input, Program, Run};

/// A declaration's linkage; its errors make the test fail.
pub fn compile(declaration: &str) -> Linkage {
    compile_if_it_closes(declaration).unwrap_or_else(|| panic!("closes at no pose\n\n{declaration}"))
}

/// The same; `None` if random lengths make a linkage that closes at no pose.
pub fn compile_if_it_closes(declaration: &str) -> Option<Linkage> {
    match linkage_codegen::analyse(declaration.parse().expect("tokens")) {
        Ok(linkage) => Some(linkage),
        Err(refusal) => {
            let errors: Vec<&str> =
                refusal.errors.iter().map(linkage_codegen::diagnostics::Diagnostic::message).collect();
            let closes =
                !errors.iter().all(|error| error.contains("cannot be assembled") && error.contains("at any pose"));
            assert!(!closes, "{}\n\n{declaration}", errors.join("\n\n"));
            None
        }
    }
}

/// The values of all arguments of a linkage's functions.
#[derive(Clone, Debug, Default)]
pub struct Arguments {
    pub drives: Vec<f64>,
    /// The components of each load, zeros where it is constant; of a spring's further values, the third is the first again.
    pub loads: Vec<[f64; 2]>,
    pub params: Vec<f64>,
    /// 1 or −1 for each closure that is chosen at run time, in the order of all closures.
    pub sides: Vec<f64>,
    /// Rate and acceleration of each drive.
    pub motion: Vec<[f64; 2]>,
    /// One of all these with another value.
    pub instead: Option<(Symbol, f64)>,
}

impl Arguments {
    pub fn of(&self, symbol: Symbol) -> f64 {
        if let Some((changed, value)) = self.instead
            && changed == symbol
        {
            return value;
        }
        match symbol {
            Symbol::Drive(drive) => self.drives[drive.index()],
            Symbol::Load(load, part) => self.loads[load.index()][usize::from(part) % 2],
            Symbol::Side(closure) => self.sides[closure.index()],
            Symbol::Parameter(param) => self.params[param.index()],
            Symbol::Driven(drive, order) => self.motion.get(drive.index()).map_or(f64::NAN, |motion| match order {
                Order::Rate => motion[0],
                Order::Acceleration => motion[1],
            }),
            Symbol::Coordinate(..)
            | Symbol::Moving(..)
            | Symbol::Dimension(_)
            | Symbol::Sought(..)
            | Symbol::Start(..) => f64::NAN,
        }
    }
}

/// A number type that takes its arguments as doubles, exactly.
pub trait Number: Real {
    fn exactly(value: f64) -> Self;
    fn to_f64(&self) -> f64;
}

/// What the parameters alone determine.
pub fn prepared<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<NodeValues<T>, Fault> {
    let program = &linkage.functions.prepare;
    let values = Run { program, graph: &linkage.model.graph }.with(&|input| match input {
        Input::Symbol(symbol) => T::exactly(arguments.of(symbol)),
        Input::Kept(_) | Input::Prepared(_) | Input::Known(_) => T::exactly(f64::NAN),
    })?;
    Ok(linkage.functions.prepared.iter().copied().zip(values).collect())
}

/// `Linkage::new`, which first asks for all parameters, those that nothing depends on as well.
pub fn checked_prepared<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<NodeValues<T>, Fault> {
    let mut all = (0..linkage.model.params.len()).map(|param| Symbol::Parameter(ParamId::new(param)));
    if all.all(|param| arguments.of(param).is_finite()) { prepared(linkage, arguments) } else { Err(Fault::NotFinite) }
}

/// What a pose keeps.
pub fn pose<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<NodeValues<T>, Fault> {
    let values = direct(linkage, &linkage.functions.pose, arguments)?;
    Ok(linkage.plan.pose.iter().map(|kept| kept.node).zip(values).collect())
}

/// `Pose::at`, which also asks for the drives that nothing of a pose depends on.
pub fn checked_pose<T: Number>(linkage: &Linkage, arguments: &Arguments) -> Result<NodeValues<T>, Fault> {
    let read: Vec<Input> = linkage.functions.pose.inputs().map(|(_, input)| input).collect();
    let drives = (0..linkage.model.drives.len()).map(|drive| Symbol::Drive(DriveId::new(drive)));
    let mut unread = drives.filter(|drive| !read.contains(&Input::Symbol(*drive)));
    if unread.all(|drive| arguments.of(drive).is_finite()) { pose(linkage, arguments) } else { Err(Fault::NotFinite) }
}

/// A pose near another one: `moved_to`.
pub fn moved<T: Number>(
    linkage: &Linkage,
    (from, before): (&NodeValues<T>, &Arguments),
    arguments: &Arguments,
) -> Result<NodeValues<T>, Fault> {
    let program = linkage.functions.near.as_ref().expect("a search");
    let prepared = prepared::<T>(linkage, arguments)?;
    let values = Run { program, graph: &linkage.model.graph }.with(&|input| match input {
        Input::Symbol(Symbol::Start(search, number)) => {
            let search = linkage.model.graph.search(search);
            let names: Vec<String> = search.sought.iter().flat_map(Sought::names).collect();
            let number = usize::from(number);
            match number.checked_sub(names.len()) {
                Some(drive) => T::exactly(before.drives[search.drives[drive].index()]),
                None => {
                    let kept = linkage.plan.pose.iter().find(|kept| kept.name == names[number]);
                    from[&kept.expect("a kept number").node].clone()
                }
            }
        }
        Input::Symbol(symbol) => T::exactly(arguments.of(symbol)),
        Input::Prepared(node) => prepared[&node].clone(),
        Input::Kept(_) | Input::Known(_) => T::exactly(f64::NAN),
    })?;
    Ok(linkage.plan.pose.iter().map(|kept| kept.node).zip(values).collect())
}

/// The results of a program that starts from the drives.
pub fn direct<T: Number>(linkage: &Linkage, program: &Program, arguments: &Arguments) -> Result<Vec<T>, Fault> {
    let prepared = prepared::<T>(linkage, arguments)?;
    Run { program, graph: &linkage.model.graph }.with(&|input| match input {
        Input::Symbol(symbol) => T::exactly(arguments.of(symbol)),
        Input::Prepared(node) => prepared[&node].clone(),
        Input::Kept(_) | Input::Known(_) => T::exactly(f64::NAN),
    })
}

/// The results of a program that starts from a pose.
pub fn from_pose<T: Number>(
    linkage: &Linkage,
    program: &Program,
    pose: &NodeValues<T>,
    arguments: &Arguments,
) -> Result<Vec<T>, Fault> {
    let prepared = prepared::<T>(linkage, arguments)?;
    Run { program, graph: &linkage.model.graph }.with(&|input| match input {
        Input::Symbol(symbol) => T::exactly(arguments.of(symbol)),
        Input::Prepared(node) => prepared[&node].clone(),
        Input::Kept(node) => pose[&node].clone(),
        Input::Known(_) => T::exactly(f64::NAN),
    })
}

/// The place of a scene among the others.
pub fn index_of(linkage: &Linkage, scene: &str) -> usize {
    linkage.model.scenes.iter().position(|other| other.name.text == scene).expect("a scene of this name")
}

/// The results of a scene straight from the drives, by their paths.
pub fn scene<T: Number>(linkage: &Linkage, name: &str, arguments: &Arguments) -> Result<HashMap<String, T>, Fault> {
    let program = &linkage.functions.scenes[index_of(linkage, name)].direct;
    let values = direct(linkage, program, arguments)?;
    Ok(program.outputs.iter().map(|(path, _)| path.clone()).zip(values).collect())
}

/// What a function gave: its numbers bit for bit, or the kind of its error.
pub type Told = Result<Vec<u64>, String>;

/// Of what the interpreter finds.
pub fn told<T: Number>(found: Result<Vec<T>, Fault>) -> Told {
    match found {
        Ok(values) => Ok(values.iter().map(|value| value.to_f64().to_bits()).collect()),
        Err(Fault::NotFinite) => Err("NotFinite".to_owned()),
        Err(Fault::Failed(failure)) => Err(first_word(&format!("{failure:?}"))),
    }
}

/// Of what emitted code gives, as it is printed: all numbers in the order of its fields.
pub fn told_as_printed<T: Number>(printed: &str) -> Told {
    let Some(inner) = printed.strip_prefix("Ok(") else {
        return Err(first_word(printed.strip_prefix("Err(").expect("a result")));
    };
    let parts = inner.split(|c: char| "[]{}(),: ".contains(c));
    Ok(parts.filter_map(|part| part.parse::<f64>().ok()).map(|x| T::exactly(x).to_f64().to_bits()).collect())
}

fn first_word(error: &str) -> String {
    error.chars().take_while(|c| c.is_alphanumeric()).collect()
}
