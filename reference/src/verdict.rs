//! What is said of each file, and of all.

use std::fmt;

use crate::closure::Refused;
use crate::compare::{Results, Worst, compare};
use crate::declaration::{ALL, Declaration, PARTS, PLACES, WORK};
use crate::driver::{FORMS, Printed};
use crate::file::{Answers, Expected, File, Outcome};
use crate::printed::Value;

/// The verdict on a file.
#[derive(Debug)]
pub(crate) enum Verdict {
    /// Every number is within its limit.
    Passed(Worst),
    /// Without an answer, and none was given.
    Refused(String),
    /// A number is wrong or missing, or there is one where none should be.
    Failed(String),
    /// The compiler says that it does not carry this out yet.
    Unsupported(String),
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Passed(worst) => {
                let tight = if worst.tight <= 1.0 { ", tight" } else { "" };
                write!(f, "passed         {:9.2e} of the limit: {}{tight}", worst.ratio, worst.what)
            }
            Self::Refused(how) => write!(f, "passed         {how}"),
            Self::Failed(why) => write!(f, "FAILED         {why}"),
            Self::Unsupported(what) => write!(f, "not supported  {what}"),
        }
    }
}

/// The verdict on a file whose declaration the compiler refuses: right where there is no answer.
pub(crate) fn of_refusal(file: &File, refused: &Refused) -> Verdict {
    if refused.is_unsupported() {
        Verdict::Unsupported(refused.summary())
    } else if file.expect.is_some() {
        Verdict::Refused(format!("refused: {}", refused.summary()))
    } else {
        Verdict::Failed(format!("refused: {}", refused.messages.join("\n    ").replace('\n', "\n    ")))
    }
}

/// The verdict on a file whose declaration was compiled.
pub(crate) fn of_results(file: &File, declaration: &Declaration, printed: &Printed) -> Verdict {
    if let Some(message) = &printed.broken {
        return Verdict::Failed(format!("its code does not compile: {message}"));
    }
    let found = if let Some(expected) = &file.expect {
        refusals(expected, printed).map(Verdict::Refused)
    } else {
        positions(file, declaration, printed).map(|worst| {
            let text = format!("{:9.2e} of the limit: {}", worst.ratio, worst.what);
            if worst.ratio > 1.0 { Verdict::Failed(text) } else { Verdict::Passed(worst) }
        })
    };
    found.unwrap_or_else(Verdict::Failed)
}

/// What all scenes of a position gave in one form.
fn results(printed: &Printed, position: usize, form: &str) -> Result<Results, String> {
    let of = printed.results.iter().filter(|((at, _, own), _)| *at == position && own == form);
    of.map(|((_, scene, _), text)| Ok((scene.clone(), Value::parse(text)?))).collect()
}

/// The worst error of all positions, in both forms of each scene.
fn positions(file: &File, declaration: &Declaration, printed: &Printed) -> Result<Worst, String> {
    let known: Vec<Option<&Answers>> = match (&file.sweep, &file.reference) {
        (Some(sweep), _) => sweep.results.iter().map(|position| answers(&position.outcome)).collect(),
        (None, Some(answers)) => vec![Some(answers)],
        (None, None) => Vec::new(),
    };
    let mut worst = Worst::new();
    for (position, answers) in known.into_iter().enumerate() {
        for form in FORMS {
            let at = |problem: String| {
                if file.sweep.is_some() { format!("position {position}: {problem}") } else { problem }
            };
            let results = results(printed, position, form).map_err(at)?;
            let before = worst.ratio;
            match answers {
                Some(answers) => compare(file, declaration, answers, &results, &mut worst).map_err(at)?,
                None => {
                    no_numbers(&results, &[PLACES, ALL, PARTS, WORK]).map_err(at)?;
                }
            }
            if worst.ratio > before && file.sweep.is_some() {
                worst.what = format!("{} at position {position}", worst.what);
            }
        }
    }
    Ok(worst)
}

fn answers(outcome: &Outcome) -> Option<&Answers> {
    if let Outcome::Answers(answers) = outcome { Some(answers) } else { None }
}

/// Whether these scenes all gave an error; one of them, as text.
fn no_numbers(results: &Results, scenes: &[&str]) -> Result<String, String> {
    let mut said = String::new();
    for scene in scenes {
        match results.get(*scene) {
            Some(Value::Error(error)) => said.clone_from(error),
            Some(_) => return Err(format!("the scene `{scene}` gives numbers where there is no answer")),
            None => return Err(format!("the scene `{scene}` printed nothing")),
        }
    }
    Ok(said)
}

/// Whether what has no answer got none, at the stage that the file names.
fn refusals(expected: &Expected, printed: &Printed) -> Result<String, String> {
    if expected.outcome != "error" {
        return Err(format!("an outcome `{}` is not known", expected.outcome));
    }
    let scenes: &[&str] = match expected.stage.as_str() {
        "mobility" => return Err("compiled, and its freedoms should have been found wrong".into()),
        "position" => &[PLACES, ALL, PARTS, WORK],
        _ => &[ALL, PARTS, WORK],
    };
    let mut said = String::new();
    for form in FORMS {
        said = no_numbers(&results(printed, 0, form)?, scenes)?;
    }
    Ok(format!("error: {said}"))
}

/// Prints all verdicts and their counts. Whether all is well.
pub(crate) fn report(verdicts: &[(String, Verdict)], allow_unsupported: bool) -> bool {
    let width = verdicts.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, verdict) in verdicts {
        println!("{name:width$}  {verdict}");
    }
    let count = |which: fn(&Verdict) -> bool| verdicts.iter().filter(|(_, verdict)| which(verdict)).count();
    let passed = count(|v| matches!(v, Verdict::Passed(_)));
    let tight = count(|v| matches!(v, Verdict::Passed(worst) if worst.tight <= 1.0));
    let refused = count(|v| matches!(v, Verdict::Refused(_)));
    let failed = count(|v| matches!(v, Verdict::Failed(_)));
    let unsupported = count(|v| matches!(v, Verdict::Unsupported(_)));
    println!(
        "\n{} files: {passed} passed with numbers, {tight} of them within the tight limits; {refused} rightly refused; \
         {failed} failed; {unsupported} not supported yet",
        verdicts.len()
    );
    failed == 0 && (allow_unsupported || unsupported == 0)
}

#[cfg(test)]
mod tests {
    use super::{Verdict, report};
    use crate::compare::Worst;

    fn all_is_well(verdict: Verdict, allow_unsupported: bool) -> bool {
        report(&[("a".into(), Verdict::Passed(Worst::new())), ("b".into(), verdict)], allow_unsupported)
    }

    #[test]
    fn only_what_is_not_supported_may_be_allowed() {
        assert!(!all_is_well(Verdict::Unsupported("gears".into()), false));
        assert!(all_is_well(Verdict::Unsupported("gears".into()), true));
        assert!(!all_is_well(Verdict::Failed("wrong".into()), true));
        assert!(all_is_well(Verdict::Refused("a dead centre".into()), false));
    }
}
