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
    let engine = kept("o07_engine_slider_crank_3000rpm.json");
    let several = kept("o14_five_bar_two_inputs.json");
    let welded = kept("o22_weld_bell_crank.json");
    let grounded = kept("o02_fourbar_triple_rocker_follower_force.json");
    let placed = kept("thrust_between_moving_points.json");
    let swept = kept("sweep_o38a_into_limit.json");
    let changes = [
        ("effort", &text, &["\"efforts\"", "\"effort\": \""][..]),
        ("reaction", &text, &["\"reactions\"", "\"B\": {\"force\": [\""]),
        ("axial", &text, &["\"along\"", "\"B\"", "\"axial\": \""]),
        ("transverse", &text, &["\"along\"", "\"B\"", "\"transverse\": \""]),
        ("along_the_ground", &grounded, &["\"along\"", "\"link\": \"ground\"", "\"axial\": \""]),
        ("part", &text, &["\"contributions\"", "\"gravity:rocker\"", "\"efforts\": [\""]),
        ("part_of_reaction", &text, &["\"contributions\"", "\"F_rocker\"", "\"O4\": {\"force\": [\""]),
        ("place", &text, &["\"pose\"", "\"coupler\": [\""]),
        ("angle", &text, &["\"pose\"", "\"crank\": [\"0\", \"0\", \""]),
        ("point", &placed, &["\"reference\"", "\"points\"", "\"D\": [", "\""]),
        ("centroid", &placed, &["\"reference\"", "\"centroid\"", "\"coupler\": [", "\""]),
        ("work", &text, &["\"virtual_work\": {\"efforts\": [\""]),
        ("size", &slider, &["\"reactions\"", "\"scalar\": \""]),
        ("couple", &welded, &["\"reactions\"", "\"W\"", "\"moment\": \""]),
        ("couple_of_a_part", &welded, &["\"contributions\"", "\"W\"", "\"moment\": \""]),
        ("velocity", &engine, &["\"velocity\"", "\"rod\": {\"origin\": [\""]),
        ("velocity_of_a_centroid", &engine, &["\"velocity\"", "\"rod\"", "\"centroid\": [\""]),
        ("angular_velocity", &engine, &["\"velocity\"", "\"rod\"", "\"omega\": \""]),
        ("acceleration", &engine, &["\"acceleration\"", "\"rod\": {\"origin\": [\""]),
        ("angular_acceleration", &engine, &["\"acceleration\"", "\"rod\"", "\"alpha\": \""]),
        ("offset", &engine, &["\"inertia_offset\"", "\"rod\": {\"h\": \""]),
        ("line", &engine, &["\"inertia_offset\"", "\"rod\"", "\"offset\": [\""]),
        ("reduced_mass", &engine, &["\"reduced\"", "\"M\": \""]),
        ("reduced_coupling", &several, &["\"reduced\"", "\"M\": [[", ", \""]),
        ("reduced_bias", &engine, &["\"reduced\"", "\"h\": \""]),
        ("power_of_an_input", &engine, &["\"power\"", "\"inputs\": [\""]),
        ("power", &engine, &["\"power\"", "\"effort\": \""]),
        ("shaking_force", &engine, &["\"shaking\"", "\"force\": [\""]),
        ("shaking_moment", &engine, &["\"shaking\"", "\"moment\": \""]),
        ("swept_effort", &swept, &["\"results\"", "\"efforts\"", "\"efforts\"", "\"efforts\": [\""]),
        ("swept_reaction", &swept, &["\"results\"", "\"efforts\"", "\"efforts\"", "\"B\": {\"force\": [\""]),
        ("swept_along", &swept, &["\"results\"", "\"along\"", "\"along\"", "\"axial\": \""]),
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
    // Only one of the two that pass stores tight limits.
    let files = format!("{} files: 2 passed with numbers, 1 of 1 that store tight limits", changes.len() + 3);
    let failed = format!("1 rightly refused; {} failed", changes.len());
    assert!(said.contains(&files) && said.contains(&failed), "{said}");

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
fn what_has_no_answer_for_another_reason_fails() {
    let folder = folder("refused-otherwise");
    let open = kept("neg_o3_cannot_assemble.json");
    let over_driven = kept("neg_o5_over_driven.json");
    let dead = kept("neg_o1_toggle_exact_slider_effort.json");
    let broken = [
        // A mass that no link has, in one that cannot be assembled and in one that is driven twice.
        ("mass", open.replacen("\"A\": [1.0, 0.0]}", "\"A\": [1.0, 0.0]}, \"mass\": -1.0", 1)),
        ("mass_of_over_driven", over_driven.replacen("\"A\": [1.0, 0.0]}", "\"A\": [1.0, 0.0]}, \"mass\": -1.0", 1)),
        // Found at another stage than it should.
        ("driven_twice", over_driven.replacen("\"mobility\"", "\"position\"", 1)),
        ("open", open.replacen("\"position\"", "\"mobility\"", 1)),
        ("dead", dead.replacen("\"equilibrium\"", "\"position\"", 1)),
        ("unknown", open.replacen("\"position\"", "\"somewhere\"", 1)),
    ];
    for (name, text) in &broken {
        std::fs::write(folder.join(format!("{name}.json")), text).expect("a file");
    }
    let (success, said) = run(&folder, &["--allow-unsupported"]);
    assert!(!success && said.contains("0 rightly refused; 6 failed"), "{said}");
    for reason in ["not for want of position", "not for want of mobility", "a stage `somewhere` is not known"] {
        assert!(said.contains(reason), "{said}");
    }
}

#[test]
fn a_line_of_what_is_a_couple_alone_fails() {
    let folder = folder("couples-alone");
    // The rod's centre of mass is said to rest, and then the file has no line of its inertia.
    let text = kept("o07_engine_slider_crank_3000rpm.json").replacen("\"inertia_offset\"", "\"passed_over\"", 1);
    let rod = ["\"acceleration\"", "\"rod\"", "\"centroid\": ["];
    let place = rod.iter().fold(0, |from, word| from + text[from..].find(word).expect("the word") + word.len());
    let end = place + text[place..].find(']').expect("its end");
    let text = format!("{}\"0\", \"0\"{}", &text[..place], &text[end..]);
    std::fs::write(folder.join("resting.json"), text).expect("a file");
    // Here the crank's rests at every pose, and there is no line in the file.
    std::fs::write(folder.join("balanced.json"), kept("o09_scotch_yoke.json")).expect("a file");
    let (success, said) = run(&folder, &[]);
    assert!(!success && said.contains("the inertia of `rod` is a couple alone, and was given a line"), "{said}");
    assert!(said.contains("1 passed with numbers"), "{said}");
}

#[test]
fn a_sweep_that_stops_elsewhere_fails() {
    let folder = folder("sweeps");
    let text = kept("sweep_o38a_into_limit.json");
    // The first of its positions, said to have no answer, and the first one without any, said to have that of the one before.
    let lines: Vec<&str> = text.lines().collect();
    let first_error = lines.iter().position(|line| line.contains("\"error\"")).expect("an error");
    let with = |index: usize, line: &str| {
        let mut lines = lines.clone();
        lines[index] = line;
        lines.join("\n")
    };
    let value_of = |line: &str| line.split(',').next().expect("a value").to_owned();
    let (_, answers) = lines[first_error - 1].split_once(',').expect("answers");
    let early = with(first_error - 1, &format!("{}, \"error\": \"limit\"}},", value_of(lines[first_error - 1])));
    let late = with(first_error, &format!("{},{answers}", value_of(lines[first_error])));
    for (name, text) in [("early", early), ("late", late), ("right", text.clone())] {
        std::fs::write(folder.join(format!("{name}.json")), text).expect("a file");
    }
    let (success, said) = run(&folder, &[]);
    assert!(!success && said.contains("1 passed with numbers"), "{said}");
    for reason in ["stops at position 18, and should at position 17", "stops at position 18, and should at position 19"]
    {
        assert!(said.contains(reason), "{said}");
    }
}

#[test]
fn few_within_their_tight_limits_fail() {
    let folder = folder("tight-limits");
    let text = kept("o01_fourbar_crank_rocker_static.json");
    let place = text.find("\"tight\"").expect("tight limits");
    let closer = format!("{}{}", &text[..place], text[place..].replacen("1e-13", "1e-22", 1));
    std::fs::write(folder.join("closer.json"), closer).expect("a file");
    let (success, said) = run(&folder, &[]);
    assert!(!success && said.contains("1 passed with numbers, 0 of 1 that store tight limits"), "{said}");
    assert!(said.contains("; 0 failed"), "{said}");
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
