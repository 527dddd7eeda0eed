//! Tuned values put into scripts: what is found, what is left as it is, what is refused.

use std::fs;
use std::thread;
use std::time::Duration;

use choque_scripting::{Options, rewrite};

use crate::support::Folder;

const CAR: &str = "mobile(\"car\").rect(4, 2);\n";

/// The script with these values in it, or the first line of the refusal and where it points.
fn rewritten(script: &str, values: &[(&str, f64)]) -> Result<String, String> {
    rewritten_beside(&[], script, values)
}

fn rewritten_beside(files: &[(&str, &str)], script: &str, values: &[(&str, f64)]) -> Result<String, String> {
    let folder = Folder::with(files);
    let path = folder.path("scene.rhai");
    fs::write(&path, script).unwrap();
    let values: Vec<(String, f64)> = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    rewrite(&path, script, &values, &Options::default()).map_err(|error| {
        let place = error.line.zip(error.column).map_or(String::new(), |(line, column)| format!(" at {line}:{column}"));
        format!("{}{place}", error.message)
    })
}

#[test]
fn only_the_number_changes() {
    let script = format!(
        "// mu_l(0.5) in a comment, \"param(\\\"push\\\", 8)\" too\r\nmu_l( 0.5 /* so */ ) ; let push = param(\"push\", 8, 0, 30); // 8\r\n\
         const SAID = `mu_l(0.5) ${{param(\"push\", 8)}}`;\r\n{CAR}fn on_step(world) {{ param(\"push\", 8); }}"
    );
    let expected = script.replace("mu_l( 0.5", "mu_l( 0.75").replace("param(\"push\", 8", "param(\"push\", 12");
    assert_eq!(rewritten(&script, &[("mu_l", 0.75), ("push", 12.0)]).unwrap(), expected);
}

#[test]
fn numbers_are_the_shortest_that_read_back_and_stay_whole_or_not() {
    let put = |written: &str, value: f64| {
        let text = rewritten(&format!("param(\"p\", {written});\n{CAR}"), &[("p", value)]).unwrap();
        text.split_once(", ").unwrap().1.split_once(')').unwrap().0.to_owned()
    };
    for (written, value, put_in) in [
        ("8", 9.0, "9"),
        ("8", 8.5, "8.5"),
        ("8.0", 9.0, "9.0"),
        ("-3", 4.0, "4"),
        ("4", -0.25, "-0.25"),
        ("1e-3", 2e-7, "0.0000002"),
        ("0.1", 0.1 + 0.2, "0.30000000000000004"),
        ("1_000", 1000.0, "1_000"),
        ("2", -0.0, "0"),
    ] {
        assert_eq!(put(written, value), put_in, "{written} {value}");
    }
}

#[test]
fn a_setting_that_is_not_there_is_added_to_the_settings() {
    for (script, expected) in [
        ("title(\"a\");\nsteps(10); // ten\n\nCAR", "title(\"a\");\nsteps(10); // ten\nmu_a(0.5);\n\nCAR"),
        ("// what one sees\n\nCAR", "// what one sees\n\nmu_a(0.5);\nCAR"),
        ("steps(10); CAR", "steps(10); mu_a(0.5); CAR"),
        ("steps(10); /* a\nb */ CAR", "steps(10); mu_a(0.5); /* a\nb */ CAR"),
        ("steps(10);\r\nCAR", "steps(10);\r\nmu_a(0.5);\r\nCAR"),
        ("steps(10);", "steps(10);\nmu_a(0.5);"),
        ("", "mu_a(0.5);\n"),
    ] {
        let [script, expected] = [script, expected].map(|text| text.replace("CAR", CAR));
        assert_eq!(rewritten(&script, &[("mu_a", 0.5)]).unwrap(), expected);
    }
}

#[test]
fn what_is_in_doubt_is_refused_and_shown() {
    for (script, name, refusal) in [
        (
            "mu_l(0.5);\nmu_l(0.6);\n",
            "mu_l",
            "mu_l is set more than once, first in line 1: it is not clear which counts at 2:1",
        ),
        (
            "let x = 0.5;\nmu_l(x);\n",
            "mu_l",
            "the value of mu_l is computed here: there is no number to replace at 2:1",
        ),
        ("mu_l(1 - 0.5);\n", "mu_l", "the value of mu_l is computed here: there is no number to replace at 1:1"),
        ("param(\"p\", 1 / 2);\n", "p", "the value of p is computed here: there is no number to replace at 1:1"),
        ("param(\"p\" + \"q\", 1);\n", "pq", "there is no param(\"pq\", …) with its name written out"),
        (
            "if 1 > 2 { mu_l(0.5); }\n",
            "mu_l",
            "with these values written into it the script would make another scene than the one shown",
        ),
        ("param(\"p\", 1, 0, 2);\n", "p", "--set p=7: the script allows 0 … 2 at 1:1"),
        ("", "nobody", "--set nobody: the scenario has no param of that name"),
    ] {
        let refused = rewritten(&format!("{script}{CAR}"), &[(name, 7.0)]).unwrap_err();
        assert_eq!(refused, refusal, "{script}");
    }
}

#[test]
fn what_an_import_says_is_not_changed_from_outside_it() {
    let library = [("lib/rules.rhai", "// shared\nfn rules() { mu_l(0.5); param(\"p\", 1) }")];
    let script = format!("import \"lib/rules\" as r;\nr::rules();\n{CAR}");
    for name in ["mu_l", "p"] {
        let refused = rewritten_beside(&library, &script, &[(name, 0.75)]).unwrap_err();
        let column = if name == "p" { 25 } else { 14 };
        assert_eq!(
            refused,
            format!("{name} gets its value in a file that other scenarios may import too at 2:{column}")
        );
    }
}

#[test]
fn every_shipped_scenario_keeps_every_other_byte() {
    let scenarios = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    for name in ["vehicles/pileup_12.rhai", "blades/spinning_blade.rhai", "basics/first_steps.rhai"] {
        let path = scenarios.join(name);
        let text = fs::read_to_string(&path).unwrap();
        let new = rewrite(&path, &text, &[("mu_l".to_owned(), 0.625)], &Options::default()).unwrap();
        let kept =
            |text: &str| text.lines().filter(|line| !line.starts_with("mu_l(")).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(kept(&new), kept(&text), "{name}");
        assert_eq!(new.matches("mu_l(0.625);").count(), 1, "{name}");
    }
}

#[test]
fn a_script_is_stopped_from_another_thread() {
    let options = Options::default();
    let stop = options.stop.clone();
    let stopping = thread::spawn(move || {
        thread::sleep(Duration::from_millis(30));
        stop.ask();
    });
    let folder = Folder::with(&[("scene.rhai", "loop { }")]);
    let error = folder.load("scene.rhai", &options).unwrap_err();
    assert!(error.contains("the script was stopped before its end"), "{error}");
    stopping.join().unwrap();
}

#[test]
fn what_may_be_tuned_is_told_with_what_the_script_says() {
    let folder = Folder::with(&[("scene.rhai", "mu_l(0.5); param(\"count\", 3, 1, 9); param(\"push\", 8.0);")]);
    let options = Options { set: vec![("push".to_owned(), 2.0)], ..Options::default() };
    let scenario = folder.load("scene.rhai", &options).unwrap();
    let told = scenario.controls().iter().map(|control| {
        (control.name.as_str(), control.value, control.written, control.range, control.is_param, control.is_whole)
    });
    let params = [("count", 3.0, 3.0, Some((1.0, 9.0)), true, true), ("push", 2.0, 8.0, None, true, false)];
    assert_eq!(told.clone().skip(5).collect::<Vec<_>>(), params);
    assert_eq!(told.clone().next(), Some(("mu_l", 0.5, 0.5, None, false, false)));
    assert_eq!(told.count(), 7);
}
