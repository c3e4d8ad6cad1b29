//! Holds what `linkage!` computes against mechanisms whose answers are known to many digits.
//!
//! ```console
//! cargo run --release -p reference -- [DIR] [--only NAME]… [--allow-unsupported]
//! ```
//!
//! Every file of the folder becomes a declaration. All are compiled in one crate, whose program prints what each scene gives, and
//! each number is held against the file's. Without a folder it is that of the project, `tests/reference`.

mod closure;
mod compare;
mod declaration;
mod driver;
mod exact;
mod file;
mod gears;
mod number;
mod printed;
mod verdict;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use closure::{Closed, Refused};
use declaration::Declaration;
use file::File;
use verdict::Verdict;

/// What is to be run.
struct Options {
    folder: PathBuf,
    only: Vec<String>,
    allow_unsupported: bool,
}

fn options() -> Result<Options, String> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/reference");
    let mut options = Options { folder: own, only: Vec::new(), allow_unsupported: false };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--only" => options.only.push(arguments.next().ok_or("--only wants a name")?),
            "--allow-unsupported" => options.allow_unsupported = true,
            flag if flag.starts_with('-') => return Err(format!("there is no option {flag}")),
            folder => options.folder = folder.into(),
        }
    }
    Ok(options)
}

/// A file, as far as it went.
enum Stage {
    /// It is decided without being run.
    Decided(Verdict),
    /// It is to be run.
    Compiled(Box<(File, Declaration, Closed)>),
}

fn prepare(path: &Path) -> Stage {
    let read = std::fs::read_to_string(path).map_err(|error| error.to_string()).and_then(|text| File::parse(&text));
    let file = match read {
        Ok(file) => file,
        Err(problem) => return Stage::Decided(Verdict::Failed(format!("cannot be read: {problem}"))),
    };
    if file.expect.is_none() && file.reference.is_none() && file.sweep.is_none() {
        return Stage::Decided(Verdict::Failed("has no answers".into()));
    }
    let declaration = match Declaration::of(&file) {
        Ok(declaration) => declaration,
        Err(problem) => return Stage::Decided(Verdict::Failed(format!("cannot be expressed: {problem}"))),
    };
    // A fault of the compiler in one file is that file's failure.
    let closed = std::panic::catch_unwind(|| closure::close(&file, &declaration))
        .unwrap_or_else(|_| Err(Refused::Broken("the compiler panics".into())));
    match closed {
        Ok(closed) => Stage::Compiled(Box::new((file, declaration, closed))),
        Err(refused) => Stage::Decided(verdict::of_refusal(&file, &refused)),
    }
}

/// The files of a folder with their names, in order.
fn files(options: &Options) -> Result<Vec<(String, PathBuf)>, String> {
    let folder = &options.folder;
    let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut files: Vec<(String, PathBuf)> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
        .filter_map(|path| Some((path.file_stem()?.to_str()?.to_owned(), path)))
        .filter(|(name, _)| {
            options.only.is_empty() || options.only.iter().any(|only| only.trim_end_matches(".json") == name)
        })
        .collect();
    files.sort();
    if files.is_empty() {
        return Err(format!("{}: no mechanisms there", folder.display()));
    }
    if let Some(missing) =
        options.only.iter().find(|only| files.iter().all(|(name, _)| name != only.trim_end_matches(".json")))
    {
        return Err(format!("{}: no mechanism {missing}", folder.display()));
    }
    Ok(files)
}

/// The name of a folder as that of a crate.
fn crate_name(folder: &Path) -> String {
    let name = folder.canonicalize().ok().and_then(|path| Some(path.file_name()?.to_str()?.to_lowercase()));
    name.unwrap_or_default().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect()
}

fn run(options: &Options) -> Result<bool, String> {
    let files = files(options)?;
    let mut stages: Vec<(String, Stage)> = files.into_iter().map(|(name, path)| (name, prepare(&path))).collect();
    let cases: Vec<driver::Case<'_>> = stages
        .iter()
        .filter_map(|(_, stage)| if let Stage::Compiled(case) = stage { Some(case) } else { None })
        .map(|case| driver::Case { declaration: &case.1, closed: &case.2 })
        .collect();
    let mut printed = driver::run(&cases, &crate_name(&options.folder))?.into_iter();
    let verdicts: Vec<(String, Verdict)> = stages
        .drain(..)
        .map(|(name, stage)| match stage {
            Stage::Decided(verdict) => (name, verdict),
            Stage::Compiled(case) => {
                let printed = printed.next().unwrap_or_default();
                (name, verdict::of_results(&case.0, &case.1, driver::form_of_sweep(&case.2), &printed))
            }
        })
        .collect();
    Ok(verdict::report(&verdicts, options.allow_unsupported))
}

fn main() -> ExitCode {
    match options().and_then(|options| run(&options)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(problem) => {
            eprintln!("{problem}");
            ExitCode::FAILURE
        }
    }
}
