//! `choque fit`: known coefficients found again in recordings, what is not determined said so, values written into scripts.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{choque, folder, stderr, stdout};

fn fit(folder: &Path, arguments: &[&str]) -> Value {
    let output = choque().current_dir(folder).arg("fit").args(arguments).args(["--format", "json"]).output();
    let output = output.expect("the command can be started");
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {}", stderr(&output)))
}

/// What was found for a name.
fn found<'a>(answer: &'a Value, name: &str) -> &'a Value {
    let values = answer["values"].as_array().expect("values");
    values.iter().find(|value| value["name"] == name).unwrap_or_else(|| panic!("no {name} in {answer}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// Fits a shipped scenario to the recording beside it, made with those μ_L, μ_A, ε; a thousandth of each is the most it may
/// be off, which is also less than a thousandth of its range.
fn finds_again(name: &str, known: [f64; 3]) {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/fit");
    let (script, recording) = (format!("{name}.rhai"), format!("{name}.choque"));
    let answer = fit(&scenarios, &[&script, "--recording", &recording]);
    assert_eq!(answer["met"], true, "{answer}");
    for (name, known) in ["mu_l", "mu_a", "epsilon"].into_iter().zip(known) {
        let value = found(&answer, name);
        assert!((number(&value["value"]) - known).abs() < 1e-3 * known, "{name} is {known}: {value}");
        assert_eq!(value["determined"], true, "{value}");
        let [low, high] = [0, 1].map(|end| number(&value["interval"][end]));
        assert!(low < high && (low..=high).contains(&known), "{name} is {known}: {value}");
    }
}

#[test]
fn a_blade_and_two_cars_tell_what_their_coefficients_were() {
    finds_again("blade_and_two_cars", [0.6173, 0.3481, 0.0314]);
}

#[test]
fn a_crossing_tells_what_its_coefficients_were() {
    finds_again("crossing", [0.7319, 0.2847, 0.0173]);
}

#[test]
fn a_gate_and_its_crates_tell_what_their_coefficients_were() {
    finds_again("gate_and_crates", [0.5541, 0.6228, 0.0067]);
}

#[test]
fn what_a_recording_does_not_show_is_not_made_up() {
    // A corner meets the middle of a face, head on: nothing turns, and friction is no part of the document's exchange.
    let script = "steps(90); mu_l(0.9); mu_a(0.6); epsilon(0.01);\n\
        mobile(\"a\").rect(1, 1).at(-2, 0).angle(deg(45)).velocity(3, 0);\nmobile(\"b\").rect(1, 1.5).mass(3);\n\
        vary(mu_l, 0, 1); vary(mu_a, 0, 1); vary(epsilon, 0, 0.1); vary(friction, 0, 1);";
    let folder = folder(&[("two.rhai", script)]);
    let run =
        ["run", "two.rhai", "--set", "mu_l=0.4", "--set", "mu_a=0.25", "--set", "epsilon=0.03", "--record", "r.choque"];
    let output = choque().current_dir(folder.path()).args(run).output().expect("it starts");
    assert!(output.status.success(), "{}", stderr(&output));
    let answer = fit(folder.path(), &["two.rhai", "--recording", "r.choque"]);
    for (name, known) in [("mu_l", 0.4), ("epsilon", 0.03)] {
        assert!((number(&found(&answer, name)["value"]) - known).abs() < 1e-3 * known, "{answer}");
        assert_eq!(found(&answer, name)["determined"], true);
    }
    for (name, own) in [("mu_a", 0.6), ("friction", 0.0)] {
        let value = found(&answer, name);
        assert_eq!((value["determined"].as_bool(), number(&value["value"])), (Some(false), own), "it stays: {value}");
        assert_eq!([0, 1].map(|end| number(&value["interval"][end])), [0.0, 1.0], "{value}");
    }
}

const PAIR: &str = "time_step(1/12); steps(60); drag(1, 0);\nlet push = param(\"push\", 8, 0, 30);\n\
    let start = param(\"start\", -2.0, -8, 0);\nmobile(\"car\").rect(4, 2).at(start, 0).velocity(push, 0);\n\
    vary(\"push\"); vary(\"start\");\n";

#[test]
fn two_values_that_only_count_together_are_named_as_a_pair() {
    let script = format!("{PAIR}target(\"at 5\", |world| world[\"car\"].x - 5);");
    let folder = folder(&[("pair.rhai", &script)]);
    let answer = fit(folder.path(), &["pair.rhai"]);
    assert_eq!((answer["met"].as_bool(), found(&answer, "start")["determined"].as_bool()), (Some(true), Some(false)));
    assert_eq!(found(&answer, "start")["along"][0]["name"], "push");
    assert_eq!(found(&answer, "push")["along"][0]["name"], "start");
    assert!(number(&answer["correlations"][0][1]) < -0.99, "the further back, the harder: {answer}");
    assert_eq!(number(&found(&answer, "start")["value"]), -2.0, "what may stay stays");

    // A second target parts them. The car rolls (1 − e⁻⁵) push m; it leaves at the speed that it has at the start.
    let script = format!("{script}\ntarget(\"at 3 m/s\", 100, |world| world[\"car\"].speed - 0.06);");
    fs::write(folder.path().join("pair.rhai"), script).expect("it can be written");
    let answer = fit(folder.path(), &["pair.rhai"]);
    let push = 0.06 * libm::exp(5.0);
    assert!((number(&found(&answer, "push")["value"]) - push).abs() < 1e-3, "{push}: {answer}");
    assert!((number(&found(&answer, "start")["value"]) - (5.0 - push + 0.06)).abs() < 1e-3, "{answer}");
    assert_eq!(found(&answer, "start")["determined"], true, "{answer}");
}

#[test]
fn of_a_sum_neither_part_is_determined() {
    let script = "steps(60); let a = param(\"a\", 1.0, 0, 2); let b = param(\"b\", 1.0, 0, 2);\n\
        mobile(\"car\").rect(1, 1).velocity(a + b, 0);\n\
        target(\"at 3\", |world| world[\"car\"].x - 3); vary(\"a\"); vary(\"b\");";
    let folder = folder(&[("sum.rhai", script)]);
    let answer = fit(folder.path(), &["sum.rhai"]);
    let [a, b] = ["a", "b"].map(|name| found(&answer, name));
    assert!((number(&a["value"]) + number(&b["value"]) - 3.0).abs() < 1e-3, "{answer}");
    for (value, other) in [(a, "b"), (b, "a")] {
        assert_eq!(value["determined"], false, "{value}");
        assert_eq!(value["along"][0]["name"], other, "{value}");
        let [low, high] = [0, 1].map(|end| number(&value["interval"][end]));
        assert!((low - 1.0).abs() < 0.03 && (high - 2.0).abs() < 1e-9, "{value}");
    }
}

#[test]
fn numbers_that_count_and_switches_are_found_as_whole_numbers() {
    let script = "steps(60); let n = param(\"n\", 2, 1, 40); let v = param(\"v\", 1.5, 0, 10);\n\
        let on = param(\"on\", 0, 0, 1); let push = param(\"push\", 2, 0, 9);\n\
        for i in 0..n { mobile(`c${i}`).rect(1, 1).at(3 * i, 0).velocity(if on == 1 { v } else { 0.0 }, push); }\n\
        target(\"17 cars\", |world| world.bodies().len() - 17); target(\"x\", |world| world[\"c0\"].x - 4.2);\n\
        target(\"z\", |world| world[\"c0\"].z - 2.5);\n\
        vary(\"n\"); vary(\"v\"); vary(\"on\"); vary(\"push\");";
    let folder = folder(&[("counts.rhai", script)]);
    let answer = fit(folder.path(), &["counts.rhai"]);
    assert!(answer["met"] == true && answer["alternatives"] == serde_json::json!([]), "{answer}");
    for (name, known, whole) in [("n", 17.0, true), ("v", 4.2, false), ("on", 1.0, true), ("push", 2.5, false)] {
        let value = found(&answer, name);
        assert!((number(&value["value"]) - known).abs() < if whole { 1e-300 } else { 1e-3 }, "{value}");
        assert_eq!((value["whole"].as_bool(), value["determined"].as_bool()), (Some(whole), Some(true)), "{value}");
    }
}

#[test]
fn the_answer_is_the_same_at_any_number_of_jobs_and_for_one_seed() {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/fit");
    let answers = ["1", "3"].map(|jobs| fit(&scenarios, &["stops_at_the_kerb.rhai", "--jobs", jobs]));
    assert!(answers[0]["met"] == true && answers[0] == answers[1], "{answers:?}");
    assert_ne!(fit(&scenarios, &["stops_at_the_kerb.rhai", "--search-seed", "5"])["runs"], answers[0]["runs"]);
}

#[test]
fn values_that_no_run_can_be_made_with_are_only_passed_by() {
    let script = format!(
        "{PAIR}target(\"at 5\", |world| {{ if world[\"car\"].x > 6 {{ throw \"over the kerb\"; }} \
         if world[\"car\"].x < -1 {{ 0.0 / 0.0 }} else {{ world[\"car\"].x - 5 }} }});"
    );
    let folder = folder(&[("pair.rhai", &script)]);
    let answer = fit(folder.path(), &["pair.rhai", "--set", "start=-3"]);
    assert_eq!(answer["met"], true, "{answer}");
    assert!((number(&found(&answer, "push")["value"]) - 8.0 / (1.0 - libm::exp(-5.0))).abs() < 1e-2, "{answer}");
}

#[test]
fn values_are_written_into_the_script_and_nothing_else_is() {
    let script = "// param(\"push\", 8)\r\ntime_step(1/60); steps(300); drag(1, 0);\r\n\
        let push = param(\"push\",  8, 0, 30); // 8 m/s\r\nmobile(\"car\").rect(4, 2).velocity(push, 0);\r\n\
        target(\"at 5\", |world| world[\"car\"].x - 5);\r\nvary(\"push\"); vary(mu_l, 0, 1);\r\n";
    let folder = folder(&[("kerb.rhai", script)]);
    let output = choque().current_dir(folder.path()).args(["fit", "kerb.rhai", "--write"]).output().expect("it starts");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).ends_with("push written into kerb.rhai\n"), "{}", stderr(&output));
    let written = fs::read_to_string(folder.path().join("kerb.rhai")).expect("the script");
    let value = written.split("param(\"push\",  ").nth(1).and_then(|rest| rest.split(',').next()).expect("its number");
    assert_eq!(written, script.replace("\"push\",  8,", &format!("\"push\",  {value},")));
    let run =
        choque().current_dir(folder.path()).args(["run", "kerb.rhai", "--format", "json"]).output().expect("it runs");
    let outcome: Value = serde_json::from_slice(&run.stdout).expect("an object");
    assert!(number(&outcome["targets"][0]["residual"]).abs() < 1e-3, "{}", stdout(&run));
    let files = fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(files, 1, "nothing is left beside the script");
}

#[test]
fn a_fit_is_drawn() {
    let folder = folder(&[("pair.rhai", &format!("{PAIR}target(\"at 5\", |world| world[\"car\"].x - 5);"))]);
    for (name, head) in [("fit.svg", &b"<svg"[..]), ("fit.png", &b"\x89PNG"[..])] {
        fit(folder.path(), &["pair.rhai", "-o", name]);
        assert!(fs::read(folder.path().join(name)).expect("the plot").starts_with(head), "{name}");
    }
    let text = fs::read_to_string(folder.path().join("fit.svg")).expect("the plot");
    let document = roxmltree::Document::parse(&text).expect("an SVG document");
    assert!(document.descendants().filter(|node| node.has_tag_name("path")).count() > 100);
}
