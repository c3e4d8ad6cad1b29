//! The runner notices what it is there for: a wrong digit, nothing to run, what it cannot read.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/reference");

/// An empty folder of this name.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn kept(name: &str) -> String {
    std::fs::read_to_string(Path::new(KEPT).join(name)).expect("a kept file")
}

fn run(folder: &Path, arguments: &[&str]) -> (bool, String) {
    let command = Command::new(env!("CARGO_BIN_EXE_reference")).arg(folder).args(arguments).output();
    let Output { status, stdout, stderr } = command.expect("the runner");
    (status.success(), String::from_utf8_lossy(&[stdout, stderr].concat()).into_owned())
}

/// A digit of a number that stands after these words, made another one: the ninth after the point.
fn changed(text: &str, words: &[&str]) -> String {
    let place = words.iter().fold(0, |from, word| from + text[from..].find(word).expect("the word") + word.len());
    let digit = place + text[place..].find('.').expect("a number") + 9;
    let other = if text.as_bytes()[digit] == b'5' { "6" } else { "5" };
    format!("{}{other}{}", &text[..digit], &text[digit + 1..])
}

#[test]
fn a_changed_digit_fails() {
    let folder = folder("changed-digits");
    let text = kept("o01_fourbar_crank_rocker_static.json");
    let slider = kept("o25_reversed_prismatic_static.json");
    let changes = [
        ("effort", &text, &["\"efforts\"", "\"effort\": \""][..]),
        ("reaction", &text, &["\"reactions\"", "\"B\": {\"force\": [\""]),
        ("part", &text, &["\"contributions\"", "\"gravity:rocker\"", "\"efforts\": [\""]),
        ("part_of_reaction", &text, &["\"contributions\"", "\"F_rocker\"", "\"O4\": {\"force\": [\""]),
        ("place", &text, &["\"pose\"", "\"coupler\": [\""]),
        ("angle", &text, &["\"pose\"", "\"crank\": [\"0\", \"0\", \""]),
        ("work", &text, &["\"virtual_work\": {\"efforts\": [\""]),
        ("size", &slider, &["\"reactions\"", "\"scalar\": \""]),
        ("load", &text, &["\"moment\": -4"]),
    ];
    for (name, text, words) in changes {
        let text = if name == "load" { text.replacen("-4.25", "-4.25000001", 1) } else { changed(text, words) };
        std::fs::write(folder.join(format!("{name}.json")), text).expect("a file");
    }
    std::fs::write(folder.join("as_it_was.json"), &text).expect("a file");
    std::fs::write(folder.join("decimals.json"), kept("metu_6_3.json")).expect("a file");
    std::fs::write(folder.join("without_an_answer.json"), kept("neg_o7_coincident_pivots.json")).expect("a file");

    let (success, said) = run(&folder, &[]);
    assert!(!success, "{said}");
    let line = |name: &str| {
        said.lines().find(|line| line.split(' ').next() == Some(name)).unwrap_or_else(|| panic!("{name}\n{said}"))
    };
    for (name, ..) in changes {
        assert!(line(name).contains("FAILED"), "{said}");
    }
    for name in ["as_it_was", "decimals", "without_an_answer"] {
        assert!(line(name).contains("passed"), "{said}");
    }
    assert!(said.contains("12 files: 2 passed with numbers") && said.contains("1 rightly refused; 9 failed"), "{said}");

    let (success, said) = run(&folder, &["--only", "as_it_was", "--only", "without_an_answer"]);
    assert!(success && said.contains("2 files: 1 passed"), "{said}");
}

#[test]
fn what_should_have_no_answer_and_has_one_fails() {
    let folder = folder("answers-where-none-should-be");
    // Away from the pose at which its pivots coincide.
    let text = kept("neg_o7_coincident_pivots.json").replacen("\"value\": 0.0", "\"value\": 0.5", 1);
    std::fs::write(folder.join("regular.json"), text).expect("a file");
    let (success, said) = run(&folder, &[]);
    assert!(!success && said.contains("gives numbers where there is no answer"), "{said}");
}

#[test]
fn nothing_to_run_and_nothing_to_understand_fail() {
    let folder = folder("nothing");
    let (success, said) = run(&folder, &[]);
    assert!(!success && said.contains("no mechanisms there"), "{said}");

    let text = kept("metu_6_3.json");
    let unknown = text.replacen("\"type\": \"force\"", "\"type\": \"wind\"", 1);
    let unnamed = text.replacen("\"point\": \"C\"", "\"point\": \"X\"", 1);
    let answerless = text.replacen("\"reference\"", "\"published\"", 1);
    for (name, text) in [("unknown", unknown), ("unnamed", unnamed), ("answerless", answerless)] {
        std::fs::write(folder.join(format!("{name}.json")), text).expect("a file");
    }
    let (success, said) = run(&folder, &["--allow-unsupported"]);
    assert!(!success && said.contains("3 failed"), "{said}");
    for reason in ["cannot be read", "`3` has no point `X`", "has no answers"] {
        assert!(said.contains(reason), "{said}");
    }
    let (success, said) = run(&folder, &["--only", "missing"]);
    assert!(!success, "{said}");
}
