//! Values put into a script's text: what changes, what stays, what is refused and where that is shown.

use std::fs;

use choque_scripting::{Diagnostic, Options, write_back};

use crate::support::{Folder, listening, set};

const CAR: &str = "mobile(\"car\").rect(4, 2);\n";

/// The text of `scene.rhai` with values in it.
fn written_in(folder: &Folder, values: &[(&str, f64)], options: &Options) -> Result<String, Diagnostic> {
    let file = folder.path("scene.rhai");
    let text = fs::read_to_string(&file).unwrap();
    let values: Vec<(String, f64)> = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    write_back(&file, &text, &values, options)
}

fn written(text: &str, values: &[(&str, f64)]) -> Result<String, Diagnostic> {
    written_in(&Folder::with(&[("scene.rhai", text)]), values, &Options::default())
}

/// The text with values in it, which has to be possible.
#[track_caller]
fn put(text: &str, values: &[(&str, f64)]) -> String {
    written(text, values).unwrap_or_else(|error| panic!("{error}"))
}

/// A refusal in one line: file, line and column where it has them, and the message.
fn told(refused: &Diagnostic) -> String {
    let file = refused.file.as_ref().and_then(|file| file.file_name()).unwrap_or_default().to_string_lossy();
    let place = refused.line.zip(refused.column).map_or(String::new(), |(line, column)| format!(":{line}:{column}"));
    format!("{file}{place}: {}", refused.message)
}

#[track_caller]
fn refused(text: &str, values: &[(&str, f64)]) -> String {
    told(&written(text, values).expect_err("this has no certain place"))
}

#[test]
fn only_the_numbers_change() {
    let text = r##"// mu_l(0.5) is what the car wants; param("push", 8)
/* mu_l(0.5); /* nested */ param("push", 8, 0, 30) */
let said = "mu_l(0.5); param(\"push\", 8)";  let told = `mu_l(0.5) ${1 + 1} param("push", 8)`;
mu_l( /* share */ 0.5 ) ;	// tab before this
mu_a(1);
let push = param(
    "push",   8 ,  // newtons
    0, 30);
let other = param("pushed", 8); let raw = #"mu_l(0.5) " param("push", 8)"#;
fn on_step(world) { let again = param("push", 8.0); }"##;
    let expected = text
        .replace("mu_l( /* share */ 0.5 ) ;", "mu_l( /* share */ 0.625 ) ;")
        .replace("\"push\",   8 ,", "\"push\",   12.5 ,")
        .replace("param(\"push\", 8.0); }", "param(\"push\", 12.5); }");
    assert_eq!(put(text, &[("mu_l", 0.625), ("push", 12.5)]), expected);
    let text = format!(
        "// mu_l(0.5) in a comment, \"param(\\\"push\\\", 8)\" too\r\nmu_l( 0.5 /* so */ ) ; let push = param(\"push\", 8, 0, 30); // 8\r\n\
         const SAID = `mu_l(0.5) ${{param(\"push\", 8)}}`;\r\n{CAR}fn on_step(world) {{ param(\"push\", 8); }}"
    );
    let expected = text.replace("mu_l( 0.5", "mu_l( 0.75").replace("param(\"push\", 8", "param(\"push\", 12");
    assert_eq!(put(&text, &[("mu_l", 0.75), ("push", 12.0)]), expected);
}

#[test]
fn what_has_the_value_already_keeps_its_look() {
    let text = "mu_l(0.50); let n = param(\"n\", 0x10); let m = param(\"m\", - 1_000.0);";
    assert_eq!(put(text, &[("mu_l", 0.5), ("n", 16.0), ("m", -1000.0)]), text);
}

#[test]
fn numbers_are_the_shortest_that_read_back_and_stay_whole_or_not() {
    let number = |written: &str, value: f64| {
        let text = put(&format!("param(\"p\", {written});\n{CAR}"), &[("p", value)]);
        text.split_once(", ").unwrap().1.split_once(");").unwrap().0.to_owned()
    };
    for (written, value, expected) in [
        ("8", 9.0, "9"),
        ("8", 8.5, "8.5"),
        ("8.0", 9.0, "9.0"),
        ("8", 1e300, "1e300"),
        ("-3", 4.0, "4"),
        ("4", -0.25, "-0.25"),
        ("1e-3", 2e-7, "2e-7"),
        ("1e0", 2.0, "2.0"),
        ("0.1", 0.1 + 0.2, "0.30000000000000004"),
        ("1_000", 1000.0, "1_000"),
        ("2", -0.0, "0"),
    ] {
        assert_eq!(number(written, value), expected, "{written} {value}");
    }
    let text = "let n = param(\"n\", 8); let x = param(\"x\", 8.0); for i in 0..n {} mu_l(1e0);";
    let after = put(text, &[("n", 3.0), ("x", 3.0), ("mu_l", 2.0)]);
    assert_eq!(after, "let n = param(\"n\", 3); let x = param(\"x\", 3.0); for i in 0..n {} mu_l(2.0);");
    assert_eq!(put("let n = param(\"n\", 8, -9, 9);", &[("n", -2.5)]), "let n = param(\"n\", -2.5, -9, 9);");
}

#[test]
fn every_way_of_writing_a_number_is_found_whole() {
    for number in ["8", "8.0", "8.", "0.8e1", "80e-1", "8e+0", "8_0e-1", "0x8", "0b1000", "0o10", "- 8", "-8", "-8.0e0"]
    {
        let text = format!("let a = param(\"a\", {number}) + 1;");
        assert_eq!(put(&text, &[("a", 0.25)]), "let a = param(\"a\", 0.25) + 1;", "{number}");
    }
    assert_eq!(put("mu_l((1));", &[("mu_l", 0.7)]), "mu_l((0.7));", "brackets around a number are no expression");
}

#[test]
fn small_and_large_values_read_back_to_the_same_bits() {
    for value in [1e-7, 1.0 / 3.0, 123_456_789.123, 2e300, 5e-324, 0.1 + 0.2] {
        let text = put("mu_l(1);", &[("mu_l", value)]);
        let folder = Folder::with(&[("scene.rhai", &text)]);
        let read = folder.load("scene.rhai", &Options::default()).unwrap().scene().settings.mu_l;
        assert_eq!(read.to_bits(), value.to_bits(), "{text}");
    }
}

#[test]
fn line_endings_a_byte_order_mark_and_foreign_letters_stay() {
    let text = "\u{feff}// Größe 🚗\r\nlet a = \"🚗\"; mu_l(0.5);\r\n// Ende";
    assert_eq!(put(text, &[("mu_l", 0.7)]), text.replace("0.5", "0.7"));
    let after = put("title(\"Größe µ\"); mu_l(0.5); // ε\r\n", &[("mu_l", 0.7), ("mu_a", 0.25)]);
    assert_eq!(after, "title(\"Größe µ\"); mu_l(0.7); // ε\r\nmu_a(0.25);\r\n");
}

#[test]
fn several_statements_in_a_line_and_calls_in_a_loop_or_a_function_are_found() {
    let text = "mu_l(0.5); mu_a(0.5); epsilon(0.5); for i in 0..3 { friction(0.5); } fn p() { param(\"p\", 0.5) } p();";
    let values = [("mu_l", 0.1), ("mu_a", 0.2), ("epsilon", 0.3), ("friction", 0.4), ("p", 0.6)];
    let expected =
        "mu_l(0.1); mu_a(0.2); epsilon(0.3); for i in 0..3 { friction(0.4); } fn p() { param(\"p\", 0.6) } p();";
    assert_eq!(put(text, &values), expected);
    assert_eq!(
        put("mu_l(0.5);", &[("mu_l", 0.1), ("mu_l", 0.2)]),
        "mu_l(0.2);",
        "of a name given twice the last counts"
    );
}

#[test]
fn a_setting_that_is_not_there_is_added_to_the_settings() {
    for (script, expected) in [
        ("title(\"a\");\nsteps(10); // ten\n\nCAR", "title(\"a\");\nsteps(10); // ten\nmu_a(0.5);\n\nCAR"),
        ("// what one sees\n\nCAR", "// what one sees\n\nmu_a(0.5);\nCAR"),
        ("/* head\n*/ CAR", "/* head\n*/ mu_a(0.5);\nCAR"),
        ("steps(10); CAR", "steps(10); mu_a(0.5); CAR"),
        ("steps(10); /* a\nb */ CAR", "steps(10); mu_a(0.5); /* a\nb */ CAR"),
        ("steps(10);\r\nCAR", "steps(10);\r\nmu_a(0.5);\r\nCAR"),
        ("steps({ let n = 9; n }); CAR", "steps({ let n = 9; n }); mu_a(0.5); CAR"),
        ("title(`a ${1 + 1};`); CAR", "title(`a ${1 + 1};`); mu_a(0.5); CAR"),
        ("steps(10);", "steps(10);\nmu_a(0.5);"),
        ("steps(10)", "mu_a(0.5);\nsteps(10)"),
        ("// nothing", "// nothing\nmu_a(0.5);\n"),
        ("// nothing\n", "// nothing\nmu_a(0.5);\n"),
        ("", "mu_a(0.5);\n"),
    ] {
        let [script, expected] = [script, expected].map(|text| text.replace("CAR", CAR));
        assert_eq!(put(&script, &[("mu_a", 0.5)]), expected);
    }
    let text = "// A scene.\ntitle(\"T\");\ntime_step(1/120);   // s\n\n// the body\nmobile(\"a\").rect(1, 1);\n";
    let expected = text.replace("// s\n", "// s\nmu_l(0.5);\nepsilon(0.25);\n");
    assert_eq!(put(text, &[("mu_l", 0.5), ("epsilon", 0.25)]), expected);
}

#[test]
fn what_is_in_doubt_is_refused_and_shown() {
    let handed = |name: &str| format!("{name} is handed an expression here: there is no number for 0.7 to replace");
    let many = |lines: &str| format!("mu_l(…) stands in the script 2 times (line {lines}): which should be 0.7?");
    let overruled = "mu_l would be 1 and not 0.7: something else in the script sets it";
    for (script, name, place, refusal) in [
        ("mu_l(0.5);\nmu_l(0.6);\n", "mu_l", ":1:1", many("1, 2")),
        ("if true { mu_l(0.5); }\nelse { mu_l(0.9); }\n", "mu_l", ":1:11", many("1, 2")),
        ("fn set(x) { mu_l(x); } set(0.5); mu_l(0.9);\n", "mu_l", ":1:13", many("1")),
        ("let x = 0.5;\nmu_l(x);\n", "mu_l", ":2:1", handed("mu_l(…)")),
        ("const M = 0.5; mu_l(M);\n", "mu_l", ":1:16", handed("mu_l(…)")),
        ("mu_l(1 - 0.5);\n", "mu_l", ":1:1", handed("mu_l(…)")),
        ("mu_l(1/2);\n", "mu_l", ":1:1", handed("mu_l(…)")),
        ("mu_l(0.5 + 0.0);\n", "mu_l", ":1:1", handed("mu_l(…)")),
        ("mu_l(if true { 0.5 } else { 1 });\n", "mu_l", ":1:1", handed("mu_l(…)")),
        ("param(\"p\", 1 / 2);\n", "p", ":1:1", handed("param(\"p\", …)")),
        ("let p = param(\"p\", deg(90));\n", "p", ":1:9", handed("param(\"p\", …)")),
        (
            "for i in 0..2 {\n param(\"p\" + i, 1);\n}\n",
            "p1",
            ":2:2",
            "the name \"p1\" is made up here: there is no number for 0.7 to replace".to_owned(),
        ),
        (
            "param(`p${1}`, 1);\n",
            "p1",
            ":1:1",
            "the name \"p1\" is made up here: there is no number for 0.7 to replace".to_owned(),
        ),
        ("if 1 > 2 { mu_l(0.5); }\n", "mu_l", ":1:12", overruled.to_owned()),
        ("fn mu_l(x) { } mu_l(0.5);\n", "mu_l", ":1:16", overruled.to_owned()),
        ("0.5.mu_l();\n", "mu_l", "", overruled.replace("be 1", "be 0.5")),
        ("param(\"p\", 1, 2, 3);\n", "p", ":1:1", "param \"p\": the default 1 is outside 2 … 3".to_owned()),
        ("param(\"p\", 2, 1, 2);\n", "p", ":1:1", "--set p=0.7: the script allows 1 … 2".to_owned()),
        ("", "nobody", "", "--set nobody: the scenario has no param of that name".to_owned()),
    ] {
        let refused = refused(&format!("{script}{CAR}"), &[(name, 0.7)]);
        assert_eq!(refused, format!("scene.rhai{place}: {refusal}"), "{script}");
    }
    let negative = refused("mu_l(0.5);", &[("mu_l", -1.0)]);
    assert!(negative.contains("--set mu_l=-1: mu_l must be 0 or more"), "{negative}");
}

#[test]
fn what_an_import_says_is_not_changed_from_outside_it() {
    let rules = "// shared\nfn rules() { mu_l(0.5); param(\"p\", 1) }";
    let script = format!("import \"lib/rules\" as r;\nr::rules();\n{CAR}");
    let folder = Folder::with(&[("lib/rules.rhai", rules), ("scene.rhai", &script)]);
    for (name, column) in [("p", 25), ("mu_l", 14)] {
        let refused = written_in(&folder, &[(name, 0.75)], &Options::default()).unwrap_err();
        let why =
            format!("{name} gets its value in a file that other scenarios may import too: 0.75 is not written there");
        assert_eq!(told(&refused), format!("rules.rhai:2:{column}: {why}"));
    }
    // What an import could say and does not is in nobody's way.
    let text = format!("import \"lib/rules\" as r;\nmu_l(0.5); param(\"p\", 1);\n{CAR}");
    fs::write(folder.path("scene.rhai"), &text).unwrap();
    let after = written_in(&folder, &[("mu_l", 0.75), ("p", 2.0)], &Options::default()).unwrap();
    assert_eq!(after, text.replace("0.5", "0.75").replace("\"p\", 1", "\"p\", 2"));
}

#[test]
fn what_is_set_from_outside_is_no_obstacle_and_nothing_is_printed() {
    let folder = Folder::with(&[("scene.rhai", "mu_l(0.5); param(\"p\", 1); print(\"made\");")]);
    let (heard, lines) = listening();
    let options = Options { output: heard.output, ..set(&[("mu_l", 0.9), ("p", 3.0)]) };
    let after = written_in(&folder, &[("mu_l", 0.7)], &options).unwrap();
    assert_eq!(after, "mu_l(0.7); param(\"p\", 1); print(\"made\");");
    assert!(lines.take().is_empty());
}

#[test]
fn every_shipped_scenario_keeps_every_other_byte() {
    let scenarios = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    for name in ["vehicles/pileup_12.rhai", "blades/spinning_blade.rhai", "basics/first_steps.rhai"] {
        let path = scenarios.join(name);
        let text = fs::read_to_string(&path).unwrap();
        let new = write_back(&path, &text, &[("mu_l".to_owned(), 0.625)], &Options::default()).unwrap();
        let kept =
            |text: &str| text.lines().filter(|line| !line.starts_with("mu_l(")).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(kept(&new), kept(&text), "{name}");
        assert_eq!(new.matches("mu_l(0.625);").count(), 1, "{name}");
    }
}
