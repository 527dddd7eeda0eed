//! The command as a process: what it prints where, and the codes it exits with.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Output, Stdio};

use serde_json::Value;

use crate::support::{choque, folder, stderr, stdout};

/// What each call prints, word for word: `TRYCMD=overwrite cargo test` writes them anew.
#[test]
fn calls_print_what_is_written_down() {
    trycmd::TestCases::new().register_bin("choque", Path::new(env!("CARGO_BIN_EXE_choque"))).case("tests/cmd/*.trycmd");
}

const TWO_SQUARES: &str = r#"
title("Two squares");
time_step(1.0 / 64.0);
steps(100);
let speed = param("speed", 2);
mobile("a").rect(1, 1).at(-2, 0).velocity(speed, 0);
mobile("b").rect(1, 1).mass(3);
"#;

fn call(folder: &Path, arguments: &[&str]) -> Output {
    choque().current_dir(folder).args(arguments).output().expect("the command can be started")
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = call(folder, &[arguments, &["--format", "json"]].concat());
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {}", stderr(&output)))
}

#[test]
fn data_goes_to_standard_output_and_everything_else_to_standard_error() {
    let script = format!("{TWO_SQUARES}\nprint(\"made\");");
    let folder = folder(&[("two.rhai", &script)]);
    let text = call(folder.path(), &["run", "two.rhai"]);
    assert_eq!(stdout(&text), "");
    assert!(stderr(&text).contains("made") && stderr(&text).contains("Two squares"), "{}", stderr(&text));
    for format in ["json", "ron"] {
        let data = call(folder.path(), &["run", "two.rhai", "--format", format]);
        assert_eq!(data.status.code(), Some(0));
        assert_eq!(stderr(&data), "made\n");
        assert!(stdout(&data).starts_with(['{', '(']) && !stdout(&data).contains("made"));
    }
}

#[test]
fn nothing_piped_has_colours() {
    let folder = folder(&[("two.rhai", TWO_SQUARES)]);
    let plain = call(folder.path(), &["run", "two.rhai", "--verbose"]);
    assert!(!stderr(&plain).contains('\u{1b}'), "{}", stderr(&plain));
    let forced = choque().env("CLICOLOR_FORCE", "1").current_dir(folder.path()).args(["run", "two.rhai"]).output();
    assert!(stderr(&forced.expect("the command can be started")).contains("\u{1b}[1m"));
}

#[test]
fn the_object_has_the_keys_of_the_manual_in_their_order() {
    let folder = folder(&[("two.rhai", &format!("{TWO_SQUARES} expect(\"no\", |world| world[\"a\"].x > 9);"))]);
    let output = call(folder.path(), &["run", "two.rhai", "--format", "json"]);
    assert_eq!(output.status.code(), Some(1), "an expectation failed");
    let text = stdout(&output);
    let keys = "scenario title time_step steps time collisions kinetic_energy momentum angular_momentum deepest digest \
                bodies name kind x z angle vx vz spin mass expectations text held first_failure numbers work";
    let mut rest = text.as_str();
    for key in keys.split_whitespace() {
        let at = rest.find(&format!("\"{key}\":")).unwrap_or_else(|| panic!("no {key:?} in its place in {text}"));
        rest = &rest[at + 1..];
    }
    assert_eq!(text.lines().count(), 1);
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    let script = "steps(1); mobile(\"a\").rect(1, 1).at(0.1, 1e-300).angle(3.5).velocity(-0.0, 1.0/3.0).mass(1e21);";
    let folder = folder(&[("one.rhai", script)]);
    let text = stdout(&call(folder.path(), &["run", "one.rhai", "--format", "json", "--time-step", "1e-300"]));
    let body = serde_json::from_str::<Value>(&text).expect("an object")["bodies"][0].clone();
    let number = |key: &str| body[key].as_f64().expect("a number");
    assert_eq!(number("x"), 0.1);
    assert_eq!(number("vz"), 1.0 / 3.0);
    assert_eq!(number("mass"), 1e21);
    assert_eq!(number("z"), 1e-300 + 1e-300 / 3.0);
    assert_eq!(number("angle"), 3.5 - std::f64::consts::TAU);
    assert!(!text.contains("-0.0"), "{text}");
}

#[test]
fn overrides_reach_a_run() {
    let folder = folder(&[("two.rhai", TWO_SQUARES)]);
    let as_written = json(folder.path(), &["run", "two.rhai"]);
    assert_eq!((as_written["steps"].as_u64(), as_written["time_step"].as_f64()), (Some(100), Some(1.0 / 64.0)));
    let other = json(folder.path(), &["run", "two.rhai", "--steps", "50", "--time-step", "1/32", "--set", "speed=4"]);
    assert_eq!((other["steps"].as_u64(), other["time"].as_f64()), (Some(50), Some(50.0 / 32.0)));
    assert_ne!(other["bodies"][0]["x"], as_written["bodies"][0]["x"]);
    for broad_phase in ["auto", "all_pairs", "strips"] {
        let again = json(folder.path(), &["run", "two.rhai", "--broad-phase", broad_phase]);
        assert_eq!(again["digest"], as_written["digest"], "{broad_phase}");
    }
    for threads in ["1", "2", "7"] {
        let again = json(folder.path(), &["run", "two.rhai", "--threads", threads]);
        assert_eq!(again["digest"], as_written["digest"], "{threads} threads");
    }
}

#[test]
fn an_exported_scene_runs_to_the_same_digest() {
    let folder = folder(&[("two.rhai", TWO_SQUARES)]);
    let exported = call(folder.path(), &["export", "two.rhai", "-o", "two.ron", "--set", "speed=2.5"]);
    assert_eq!((exported.status.code(), stdout(&exported).as_str()), (Some(0), ""), "{}", stderr(&exported));
    let (from_script, from_scene) =
        (json(folder.path(), &["run", "two.rhai", "--set", "speed=2.5"]), json(folder.path(), &["run", "two.ron"]));
    assert_eq!(from_scene["digest"], from_script["digest"]);
    assert_eq!(from_scene["title"], from_script["title"]);
    let printed = call(folder.path(), &["export", "two.rhai", "-o", "-", "--set", "speed=2.5"]);
    assert_eq!(stdout(&printed), fs::read_to_string(folder.path().join("two.ron")).expect("the scene"));
    let files = fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(files, 2, "nothing is left beside the script and the scene");
}

#[test]
fn an_exported_scene_keeps_how_contacts_are_solved() {
    let script = "exchange(\"impulse\"); substeps(7); sleeping(true);\nmobile(\"a\").rect(1, 1);\nmobile(\"b\").rect(1, 1).at(3, 0);";
    let folder = folder(&[("two.rhai", script)]);
    let exported = call(folder.path(), &["export", "two.rhai", "-o", "two.ron"]);
    assert_eq!(exported.status.code(), Some(0), "{}", stderr(&exported));
    for file in ["two.rhai", "two.ron"] {
        let explained = stdout(&call(folder.path(), &["explain", file]));
        assert!(explained.contains("contacts: solved in 7 sub-steps, bodies at rest sleep"), "{file}: {explained}");
    }
}

#[test]
fn a_failed_export_leaves_the_old_scene() {
    let folder = folder(&[("bad.rhai", "mobile(\"a\").rect(1, 1).mass(-1);"), ("old.ron", "old")]);
    let output = call(folder.path(), &["export", "bad.rhai", "-o", "old.ron"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_to_string(folder.path().join("old.ron")).expect("the scene"), "old");
}

#[test]
fn an_export_never_replaces_a_script() {
    let script = "mobile(\"a\").rect(1, 1);";
    let folder = folder(&[("scene.rhai", script)]);
    for target in ["scene.rhai", "scene", "/dev/null"] {
        let output = call(folder.path(), &["export", "scene.rhai", "-o", target]);
        assert_eq!(output.status.code(), Some(2), "{target}");
        assert!(stderr(&output).contains("a scene's file name ends in .ron"), "{}", stderr(&output));
    }
    assert_eq!(fs::read_to_string(folder.path().join("scene.rhai")).expect("the script"), script);
}

#[test]
fn totals_beyond_the_numbers_are_an_error_and_not_null() {
    let folder = folder(&[("heavy.rhai", "mobile(\"a\").rect(1, 1).velocity(1e200, 0).mass(1e200);")]);
    let output = call(folder.path(), &["run", "heavy.rhai", "--format", "json"]);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""));
    assert!(stderr(&output).contains("the kinetic energy is beyond the range of numbers"), "{}", stderr(&output));
}

#[test]
fn a_body_that_leaves_the_finite_numbers_ends_the_run_without_a_result() {
    let folder = folder(&[("far.rhai", "time_step(1); steps(10); mobile(\"rocket\").rect(1, 1).velocity(1e308, 0);")]);
    let output = call(folder.path(), &["run", "far.rhai", "--format", "json"]);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""));
    let said = stderr(&output);
    assert!(said.contains("far.rhai") && said.contains("\"rocket\" became non-finite in iteration 1"), "{said}");
}

#[test]
fn a_reader_who_leaves_early_is_no_error() {
    let mut child = choque()
        .args(["completions", "bash"]) // more than a pipe holds
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command can be started");
    drop(child.stdout.take());
    let mut said = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut said).expect("text");
    assert!(child.wait().expect("it ends").success(), "{said}");
    assert_eq!(said, "");
}

#[test]
fn definitions_for_editors_are_written() {
    let folder = folder(&[]);
    let output = call(folder.path(), &["words", "--definitions", "editor/choque"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let written = fs::read_dir(folder.path().join("editor/choque")).expect("the folder was made");
    let names: Vec<String> = written.map(|f| f.expect("a file").file_name().to_string_lossy().into_owned()).collect();
    assert!(!names.is_empty() && names.iter().all(|name| name.ends_with(".d.rhai")), "{names:?}");
}
