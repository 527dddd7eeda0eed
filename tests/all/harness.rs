//! The harness as a process of its own, over packages made for the purpose.
//!
//! [`stand_in`] is that process: this binary run again, told by two variables which package to test and how.

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode, Output};

use tempfile::TempDir;

use crate::support::{folder, isolated, stdout, write};

const PACKAGE: &str = "CHOQUE_TEST_PACKAGE";
const ARGUMENTS: &str = "CHOQUE_TEST_ARGUMENTS";

#[test]
#[ignore = "the process that the tests beside it start"]
fn stand_in() {
    let package = std::env::var(PACKAGE).expect("started by a test beside it");
    let arguments = std::env::var(ARGUMENTS).expect("started by a test beside it");
    let arguments = std::iter::once("scenarios").chain(arguments.split_whitespace()).map(OsString::from);
    println!(); // what the harness prints begins on a line of its own
    let code = choque::harness::run_with(arguments, &package, |name, body| choque::insta::assert_snapshot!(name, body));
    assert_eq!(code, ExitCode::SUCCESS);
}

/// Runs the harness over a package.
fn harness(package: &Path, arguments: &str, variables: &[(&str, &str)]) -> Output {
    let mut command = isolated(Command::new(std::env::current_exe().expect("this binary")));
    command.args(["--exact", "harness::stand_in", "--ignored", "--nocapture", "--test-threads=1"]);
    command.env(PACKAGE, package).env(ARGUMENTS, arguments).env("INSTA_WORKSPACE_ROOT", package);
    command.envs(variables.iter().copied());
    command.output().expect("this binary can be run")
}

const ACCEPT: &[(&str, &str)] = &[("INSTA_UPDATE", "always")];
const REFUSE: &[(&str, &str)] = &[("INSTA_UPDATE", "no")];

const FALL: &str = r#"
title("Fall");
time_step(0.125);
steps(16);
mobile("stone").rect(1, 1).at(0, 0).velocity(1, 0);
mobile("other").rect(1, 1).at(0, 10);
expect("it went on", |world| world["stone"].x > 1);
"#;

/// A package of one accepted scenario, `things::fall`.
fn accepted(script: &str) -> TempDir {
    let package = folder(&[("scenarios/things/fall.rhai", script)]);
    let output = harness(package.path(), "", ACCEPT);
    assert!(output.status.success(), "{}", stdout(&output));
    package
}

/// What the harness says about a package that must fail.
fn failure(package: &Path) -> String {
    let output = harness(package, "", REFUSE);
    assert!(!output.status.success(), "{}", stdout(&output));
    stdout(&output)
}

/// Replaces a piece of the accepted snapshot, which must be there.
fn edit_snapshot(package: &Path, from: &str, to: &str) {
    let path = package.join("snapshots/things/fall.snap");
    let text = fs::read_to_string(&path).expect("the snapshot was accepted");
    assert!(text.contains(from), "no {from:?} in {text}");
    fs::write(path, text.replacen(from, to, 1)).expect("the snapshot can be written");
}

#[test]
fn an_accepted_scenario_passes_and_a_snapshot_reads_well() {
    let package = accepted(FALL);
    let output = harness(package.path(), "", REFUSE);
    assert!(output.status.success(), "{}", stdout(&output));
    let text = fs::read_to_string(package.path().join("snapshots/things/fall.snap")).expect("the snapshot");
    assert!(text.contains("input_file: scenarios/things/fall.rhai"), "{text}");
    assert!(text.contains("description: \"Fall: 16 iterations of 125 ms\""), "{text}");
    let row = r#"    (name: "stone", x: 2.0, z: 0.0, angle: 0.0, vx: 1.0, vz: 0.0, spin: 0.0),"#;
    assert!(text.lines().any(|line| line == row), "{text}");
}

#[test]
fn every_script_is_a_test_but_those_of_a_library() {
    let package = folder(&[
        ("scenarios/b/c/two.rhai", FALL),
        ("scenarios/one.rhai", FALL),
        ("scenarios/lib/cars.rhai", "this is no scenario"),
        ("scenarios/b/lib/more.rhai", "nor this"),
        ("scenarios/notes.txt", ""),
        ("scenarios/.hidden.rhai", ""),
    ]);
    let listed = stdout(&harness(package.path(), "--list --format terse", REFUSE));
    let tests: Vec<&str> = listed.lines().filter(|line| line.ends_with(": test")).collect();
    assert_eq!(tests, ["b::c::two: test", "one: test"]);
    let ignored = stdout(&harness(package.path(), "--list --format terse --ignored", REFUSE));
    assert_eq!(ignored.lines().filter(|line| line.ends_with(": test")).count(), 0, "{ignored}");
}

#[test]
fn nothing_is_written_where_ci_is_set() {
    let package = folder(&[("scenarios/one.rhai", FALL)]);
    let output = harness(package.path(), "", &[("CI", "true")]);
    assert!(!output.status.success());
    assert!(stdout(&output).contains("one: it has no snapshot yet"), "{}", stdout(&output));
    assert!(!package.path().join("snapshots").exists());
}

#[test]
fn elsewhere_a_new_snapshot_waits_for_review() {
    let package = folder(&[("scenarios/deep/one.rhai", FALL)]);
    assert!(!harness(package.path(), "", &[]).status.success());
    assert!(package.path().join("snapshots/deep/one.snap.new").exists());
    assert!(!package.path().join("snapshots/deep/one.snap").exists());
}

#[test]
fn a_broken_expectation_fails_the_test_in_words() {
    let package = accepted(FALL);
    write(&package.path().join("scenarios/things/fall.rhai"), &FALL.replace("x > 1", "x > 100"));
    let said = failure(package.path());
    assert!(said.contains("things::fall: 1 expectation failed\n  ✗ it went on"), "{said}");
    assert!(said.contains("stone"), "{said}");
    // It fails also when the snapshot is accepted: a snapshot is no excuse.
    assert!(!harness(package.path(), "", ACCEPT).status.success());
}

#[test]
fn a_changed_plan_is_told_as_a_changed_reading() {
    let package = accepted(FALL);
    edit_snapshot(package.path(), "2 mobile", "3 mobile");
    let said = failure(package.path());
    assert!(said.contains("the plan moved: the scene was read otherwise; the outcome is the same"), "{said}");
    assert!(said.contains("- bodies: 3 mobile") && said.contains("+ bodies: 2 mobile"), "{said}");
}

#[test]
fn a_changed_script_is_told_from_changed_physics() {
    let package = accepted(FALL);
    write(&package.path().join("scenarios/things/fall.rhai"), &FALL.replace("velocity(1, 0)", "velocity(1.5, 0)"));
    let said = failure(package.path());
    assert!(said.contains("the scene itself is another"), "{said}");
    assert!(said.contains("the runs differ from the very start"), "{said}");
    assert!(said.contains("1 body of 2 ended otherwise"), "{said}");
    assert!(said.contains("stone: x 2 → 3 (+1.000000), vx 1 → 1.5 (+0.500000)"), "{said}");
}

#[test]
fn moved_rows_are_told_as_moved_physics() {
    let package = accepted(FALL);
    edit_snapshot(package.path(), r#"(name: "stone", x: 2.0"#, r#"(name: "stone", x: 1.75"#);
    edit_snapshot(package.path(), "iteration: 6, collisions: 0", "iteration: 6, collisions: 4");
    let said = failure(package.path());
    assert!(said.contains("rows moved: the same scene came out otherwise"), "{said}");
    assert!(said.contains("agree up to iteration 4 and differ at 6: 0 collisions instead of 4"), "{said}");
    assert!(said.contains("stone: x 1.75 → 2 (+0.250000)"), "{said}");
}

#[test]
fn a_digest_alone_is_told_as_rounding() {
    let package = accepted(FALL);
    let path = package.path().join("snapshots/things/fall.snap");
    let text = fs::read_to_string(&path).expect("the snapshot");
    let line = text.lines().find(|line| line.starts_with("  digest:")).expect("a digest");
    edit_snapshot(package.path(), line, "  digest: \"0123456789abcdef\",");
    let said = failure(package.path());
    assert!(said.contains("only the digest moved: the rounding changed"), "{said}");
}

#[test]
fn counted_work_alone_is_told_as_cost() {
    let package = accepted(FALL);
    edit_snapshot(package.path(), "pairs_tested: ", "pairs_tested: 1");
    let said = failure(package.path());
    assert!(said.contains("only the counted work moved: the same outcome at another cost"), "{said}");
    assert!(said.contains("counted work: pairs tested"), "{said}");
}

#[test]
fn a_snapshot_of_another_format_is_said_to_be_one() {
    let package = accepted(FALL);
    edit_snapshot(package.path(), "  totals: (", "  sums: (");
    let said = failure(package.path());
    assert!(said.contains("its snapshot cannot be read, so nothing can be said about what moved"), "{said}");
}

#[test]
fn a_script_with_an_error_fails_with_its_place() {
    let package = folder(&[("scenarios/bad.rhai", "let x = 1;\nmobil(\"a\");\n")]);
    let said = failure(package.path());
    assert!(said.contains("bad.rhai:2:"), "{said}");
}

#[test]
fn a_package_without_scenarios_is_an_error() {
    let package = folder(&[]);
    assert!(!harness(package.path(), "", REFUSE).status.success());
}

#[test]
fn a_failure_says_where_the_runs_part_and_leaves_them_where_it_is_told_to() {
    let package = accepted(FALL);
    write(&package.path().join("scenarios/things/fall.rhai"), &FALL.replace("velocity(1, 0)", "velocity(1.5, 0)"));
    let left = package.path().join("left");
    let folder = left.to_str().expect("a path of UTF-8");
    let output = harness(package.path(), "", &[("INSTA_UPDATE", "no"), ("CHOQUE_ARTIFACTS", folder)]);
    assert!(!output.status.success());
    assert!(stdout(&output).contains("they differ from the start"), "{}", stdout(&output));
    let recording = choque::recording::Recording::read(&left.join("things/fall.choque")).expect("the run");
    assert_eq!(recording.about.scenario, "fall");
}
