//! What is said of each file, and of all.

use std::fmt;

use crate::closure::{Refused, first_line};
use crate::compare::{Results, Worst, compare};
use crate::declaration::{ALL, CYCLE, Declaration, PARTS, PLACES, WORK};
use crate::driver::{ANSWERED, FORMS, Printed, SWEPT};
use crate::file::{Answers, Expected, File};
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
                let tight = if worst.is_tight() { ", tight" } else { "" };
                write!(f, "passed         {:9.2e} of the limit: {}{tight}", worst.ratio, worst.what)
            }
            Self::Refused(how) => write!(f, "passed         {how}"),
            Self::Failed(why) => write!(f, "FAILED         {why}"),
            Self::Unsupported(what) => write!(f, "not supported  {what}"),
        }
    }
}

/// What is said of a linkage whose drives are not as many as its freedoms, on the whole or somewhere in it.
const OF_MOBILITY: [&str; 10] = [
    "cannot move",
    "over-driven",
    "nothing drives",
    "is driven by",
    "loose",
    "redundant",
    "constraint",
    "held twice",
    "cannot place",
    "cannot hold",
];
/// What is said of a linkage that works at no pose.
const OF_POSES: [&str; 5] = [
    "cannot be assembled",
    "cannot be closed",
    "coincide at every pose",
    "at every pose, nothing holds",
    "cannot hold",
];

/// What the compiler says where a linkage has no answer at a stage.
fn is_of_stage(message: &str, stage: &str) -> bool {
    let words = match stage {
        "mobility" => &OF_MOBILITY[..],
        "position" | "equilibrium" => &OF_POSES,
        _ => &[],
    };
    words.iter().any(|words| first_line(message).contains(words))
}

/// The verdict on a file whose declaration the compiler refuses: right where there is no answer, and for that reason.
pub(crate) fn of_refusal(file: &File, refused: &Refused) -> Verdict {
    let messages = match refused {
        Refused::Declined(messages) => messages,
        Refused::Broken(problem) => return Verdict::Failed(problem.clone()),
    };
    let summary = messages.first().map_or("refused", |message| first_line(message));
    // All that stands in the way is what the compiler does not carry out yet.
    if !messages.is_empty() && messages.iter().all(|message| message.contains("not supported yet")) {
        return Verdict::Unsupported(summary.to_owned());
    }
    let all = || messages.join("\n    ").replace('\n', "\n    ");
    let Some(expected) = &file.expect else { return Verdict::Failed(format!("refused: {}", all())) };
    let stages = match expected.stages() {
        Ok(stages) => stages,
        Err(problem) => return Verdict::Failed(problem),
    };
    let of_stage = |message: &String| stages.iter().any(|stage| is_of_stage(message, stage));
    if !messages.is_empty() && messages.iter().all(of_stage) {
        Verdict::Refused(format!("refused: {summary}"))
    } else {
        Verdict::Failed(format!("refused, and not for want of {}: {}", expected.stage, all()))
    }
}

/// The verdict on a file whose declaration was compiled. `form` is that whose numbers a sweep has.
pub(crate) fn of_results(file: &File, declaration: &Declaration, form: &str, printed: &Printed) -> Verdict {
    if let Some(message) = &printed.broken {
        return Verdict::Failed(format!("its code does not compile: {message}"));
    }
    let found = if let Some(expected) = &file.expect {
        refusals(expected, printed).map(Verdict::Refused)
    } else {
        sweep(file, form, printed).and_then(|()| positions(file, declaration, printed)).map(|worst| {
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
        (Some(sweep), _) => sweep.results.iter().map(|position| position.outcome.answers()).collect(),
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

/// Whether the function of a sweep has the numbers of the single positions, bit by bit, and stops at the first one without an answer.
fn sweep(file: &File, form: &str, printed: &Printed) -> Result<(), String> {
    let Some(sweep) = &file.sweep else { return Ok(()) };
    let count = sweep.results.len();
    let expected = sweep.results.iter().position(|at| at.outcome.answers().is_none()).unwrap_or(count);
    let answered = printed.results.get(&(0, CYCLE.to_owned(), ANSWERED.to_owned())).ok_or("nothing was swept")?;
    let answered: usize = answered.parse().map_err(|_| format!("the sweep fails: {answered}"))?;
    let place = |position: usize| if position < count { format!("at position {position}") } else { "nowhere".into() };
    if answered != expected {
        return Err(format!("the sweep stops {}, and should {}", place(answered), place(expected)));
    }
    for position in 0..expected {
        let one = |form: &str| -> Result<Value, String> {
            let mut results = results(printed, position, form)?;
            results.remove(ALL).ok_or_else(|| format!("position {position}: the scene `{ALL}` printed nothing"))
        };
        let (mut known, mut found) = (Vec::new(), Vec::new());
        one(form)?.numbers("", &mut known);
        one(SWEPT)?.numbers("", &mut found);
        if known.is_empty() || known.len() != found.len() {
            return Err(format!("position {position}: the sweep has {} numbers for {}", found.len(), known.len()));
        }
        for (path, number) in known {
            let swept = found.iter().find_map(|(own, swept)| (*own == path).then_some(*swept));
            if swept.map(f64::to_bits) != Some(number.to_bits()) {
                return Err(format!("position {position}: `{path}` is {number:?}, and swept {swept:?}"));
            }
        }
    }
    Ok(())
}

/// What says at run time that a pose has no answer. Whatever else goes wrong is a fault of the file or of the code.
const WITHOUT_ANSWER: [&str; 4] = ["CannotAssemble", "NoConvergence", "CoincidentPivots", "DeadCentre"];

/// Whether these scenes all gave an error of a pose without an answer; one of them, as text.
fn no_numbers(results: &Results, scenes: &[&str]) -> Result<String, String> {
    let mut said = String::new();
    for scene in scenes {
        match results.get(*scene) {
            Some(Value::Error(error)) if WITHOUT_ANSWER.iter().any(|kind| error.starts_with(kind)) => {
                said.clone_from(error);
            }
            Some(Value::Error(error)) => return Err(format!("the scene `{scene}` fails otherwise: {error}")),
            Some(_) => return Err(format!("the scene `{scene}` gives numbers where there is no answer")),
            None => return Err(format!("the scene `{scene}` printed nothing")),
        }
    }
    Ok(said)
}

/// Whether what has no answer got none, at the stage that the file names.
fn refusals(expected: &Expected, printed: &Printed) -> Result<String, String> {
    let scenes: &[&str] = match expected.stages()?[..] {
        ["mobility"] => return Err("compiled, and its freedoms should have been found wrong".into()),
        ["position"] => &[PLACES, ALL, PARTS, WORK],
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
    let tight = count(|v| matches!(v, Verdict::Passed(worst) if worst.is_tight()));
    let with_tight = count(|v| matches!(v, Verdict::Passed(worst) if worst.tight.is_some()));
    let refused = count(|v| matches!(v, Verdict::Refused(_)));
    let failed = count(|v| matches!(v, Verdict::Failed(_)));
    let unsupported = count(|v| matches!(v, Verdict::Unsupported(_)));
    println!(
        "\n{} files: {passed} passed with numbers, {tight} of {with_tight} that store tight limits within these; {refused} \
         rightly refused; {failed} failed; {unsupported} not supported yet",
        verdicts.len()
    );
    // Tight limits are a goal, which most reach.
    let tight_enough = 10 * tight >= 9 * with_tight;
    if !tight_enough {
        println!("fewer than 90 % are within their tight limits");
    }
    failed == 0 && tight_enough && (allow_unsupported || unsupported == 0)
}

#[cfg(test)]
mod tests {
    use super::{Verdict, of_refusal, report, sweep};
    use crate::closure::Refused;
    use crate::compare::Worst;
    use crate::declaration::{ALL, CYCLE};
    use crate::driver::{ANSWERED, FORMS, Printed, SWEPT};
    use crate::file::File;

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
    #[test]
    fn only_a_refusal_for_the_stage_that_a_file_names_is_right() {
        let text = include_str!("../../tests/reference/neg_o5_over_driven.json");
        let file = File::parse(text).expect("a file");
        let declined = |messages: &[&str]| {
            let messages = messages.iter().map(|message| (*message).to_owned()).collect();
            of_refusal(&file, &Refused::Declined(messages))
        };
        let over_driven = "the linkage is over-driven by 1 drive\nhelp: take a drive out";
        assert!(matches!(declined(&[over_driven]), Verdict::Refused(_)));
        assert!(matches!(declined(&[]), Verdict::Failed(_)));
        assert!(matches!(declined(&[over_driven, "there is no link `rod`"]), Verdict::Failed(_)));
        // A remark is no reason.
        assert!(matches!(declined(&["there is no link `rod`\nnote: over-driven"]), Verdict::Failed(_)));
        assert!(matches!(declined(&["gears: not supported yet"]), Verdict::Unsupported(_)));
        assert!(matches!(of_refusal(&file, &Refused::Broken("a panic".into())), Verdict::Failed(_)));
    }

    #[test]
    fn a_sweep_has_the_bits_of_the_single_positions() {
        let text = include_str!("../../tests/reference/sweep_o38a_into_limit.json");
        let file = File::parse(text).expect("a file");
        let of = |first: &str, answered: &str| {
            let mut printed = Printed::default();
            let mut add = |at: usize, scene: &str, form: &str, text: String| {
                printed.results.insert((at, scene.to_owned(), form.to_owned()), text);
            };
            add(0, CYCLE, ANSWERED, answered.to_owned());
            for at in 0..18 {
                add(at, ALL, FORMS[1], "Ok(All { E: 0.1, A: [[1.0, -0.0]] })".to_owned());
                add(
                    at,
                    ALL,
                    SWEPT,
                    format!("Ok(Swept {{ E: {}, A_x: 1.0, A_y: -0.0, }})", if at == 3 { first } else { "0.1" }),
                );
            }
            sweep(&file, FORMS[1], &printed)
        };
        assert_eq!(of("0.1", "18"), Ok(()));
        assert!(of("0.10000000000000002", "18").is_err_and(|problem| problem.starts_with("position 3: `E`")));
        assert!(of("NaN", "18").is_err());
        assert!(of("0.1", "17").is_err());
        assert!(of("0.1", "A_x has 17 values for 18 positions").is_err());
    }
}
