//! Values put into a script's text: what changes, what stays, what is refused.

use choque_scripting::{Options, write_back};

use crate::support::{Folder, set};

/// The text of `scene.rhai` with values in it.
fn written_in(folder: &Folder, values: &[(&str, f64)], options: &Options) -> Result<String, String> {
    let file = folder.path("scene.rhai");
    let text = std::fs::read_to_string(&file).unwrap();
    let values: Vec<(String, f64)> = values.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let shown = |error: choque_scripting::Diagnostic| error.to_string().replace(file.to_str().unwrap(), "scene.rhai");
    write_back(&file, &text, &values, options).map_err(shown)
}

fn written(text: &str, values: &[(&str, f64)]) -> Result<String, String> {
    written_in(&Folder::with(&[("scene.rhai", text)]), values, &Options::default())
}

fn refused(text: &str, values: &[(&str, f64)]) -> String {
    written(text, values).expect_err("this has no certain place")
}

#[test]
fn only_the_numbers_change() {
    let text = r#"// mu_l(0.5) is what the car wants; param("push", 8)
/* mu_l(0.5); /* nested */ param("push", 8, 0, 30) */
let said = "mu_l(0.5); param(\"push\", 8)";  let told = `mu_l(0.5) ${1 + 1} param("push", 8)`;
mu_l( /* share */ 0.5 ) ;	// tab before this
mu_a(1);
let push = param(
    "push",   8 ,  // newtons
    0, 30);
let other = param("pushed", 8);
fn on_step(world) { let again = param("push", 8.0); }"#;
    let expected = text
        .replace("mu_l( /* share */ 0.5 ) ;", "mu_l( /* share */ 0.625 ) ;")
        .replace("\"push\",   8 ,", "\"push\",   12.5 ,")
        .replace("param(\"push\", 8.0); }", "param(\"push\", 12.5); }");
    assert_eq!(written(text, &[("mu_l", 0.625), ("push", 12.5)]), Ok(expected));
}

#[test]
fn what_has_the_value_already_keeps_its_look() {
    let text = "mu_l(0.50); let n = param(\"n\", 0x10); let m = param(\"m\", - 1_000.0);";
    assert_eq!(written(text, &[("mu_l", 0.5), ("n", 16.0), ("m", -1000.0)]), Ok(text.to_owned()));
}

#[test]
fn a_whole_number_stays_one_where_it_can() {
    let text = "let n = param(\"n\", 8); let x = param(\"x\", 8.0); for i in 0..n {} mu_l(1e0);";
    let after = written(text, &[("n", 3.0), ("x", 3.0), ("mu_l", 2.0)]).unwrap();
    assert_eq!(after, "let n = param(\"n\", 3); let x = param(\"x\", 3.0); for i in 0..n {} mu_l(2.0);");
    let text = "let n = param(\"n\", 8, -9, 9);";
    assert_eq!(written(text, &[("n", -2.5)]).unwrap(), "let n = param(\"n\", -2.5, -9, 9);");
}

#[test]
fn every_way_of_writing_a_number_is_found_whole() {
    for number in ["8", "8.0", "8.", "0.8e1", "80e-1", "8e+0", "8_0e-1", "0x8", "0b1000", "0o10", "- 8", "-8", "-8.0e0"]
    {
        let text = format!("let a = param(\"a\", {number}) + 1;");
        assert_eq!(written(&text, &[("a", 0.25)]), Ok("let a = param(\"a\", 0.25) + 1;".to_owned()), "{number}");
    }
}

#[test]
fn small_and_large_values_read_back_to_the_same_bits() {
    for value in [1e-7, 1.0 / 3.0, 123_456_789.123, 2e300, 5e-324, 0.1 + 0.2] {
        let text = written("mu_l(1);", &[("mu_l", value)]).unwrap();
        let folder = Folder::with(&[("scene.rhai", &text)]);
        let read = folder.load("scene.rhai", &Options::default()).unwrap().scene().settings.mu_l;
        assert_eq!(read.to_bits(), value.to_bits(), "{text}");
    }
}

#[test]
fn line_endings_a_byte_order_mark_and_foreign_letters_stay() {
    let text = "\u{feff}// Größe\r\nlet ä_ = 1; mu_l(0.5);\r\n// Ende";
    let text = text.replace("ä_", "a"); // names are plain, comments and strings are not
    let expected = text.replace("0.5", "0.7");
    assert_eq!(written(&text, &[("mu_l", 0.7)]), Ok(expected));
    let after = written("title(\"Größe µ\"); mu_l(0.5); // ε\r\n", &[("mu_l", 0.7), ("mu_a", 0.25)]);
    assert_eq!(after, Ok("title(\"Größe µ\"); mu_l(0.7); // ε\r\nmu_a(0.25);\r\n".to_owned()));
}

#[test]
fn a_setting_that_is_not_made_comes_after_those_that_are() {
    let text = "// A scene.\ntitle(\"T\");\ntime_step(1/120);   // s\n\n// the body\nmobile(\"a\").rect(1, 1);\n";
    let expected = text.replace("// s\n", "// s\nmu_l(0.5);\nepsilon(0.25);\n");
    assert_eq!(written(text, &[("mu_l", 0.5), ("epsilon", 0.25)]), Ok(expected));
    let text = "/* head\n*/ mobile(\"a\").rect(1, 1);\n";
    assert_eq!(written(text, &[("mu_l", 0.5)]), Ok("/* head\n*/ mu_l(0.5);\nmobile(\"a\").rect(1, 1);\n".to_owned()));
    let text = "steps(9); /* a comment\nthat goes on */ mobile(\"a\").rect(1, 1);";
    assert_eq!(written(text, &[("mu_l", 0.5)]), Ok(text.replace("steps(9);", "steps(9); mu_l(0.5);")));
    let text = "steps({ let n = 9; n }); mobile(\"a\").rect(1, 1);";
    assert_eq!(written(text, &[("mu_l", 0.5)]), Ok(text.replace("n });", "n }); mu_l(0.5);")));
    assert_eq!(written("// nothing\n", &[("mu_l", 0.5)]), Ok("// nothing\n\nmu_l(0.5);\n".to_owned()));
    assert_eq!(written("steps(9)", &[("mu_l", 0.5)]).unwrap(), "mu_l(0.5);\nsteps(9)");
}

#[test]
fn an_expression_is_not_replaced() {
    for script in
        ["mu_l(1/2);", "mu_l(0.5 + 0.0);", "const M = 0.5; mu_l(M);", "mu_l(if true { 0.5 } else { 1 });", "mu_l((1));"]
    {
        let outcome = written(script, &[("mu_l", 0.7)]);
        if script == "mu_l((1));" {
            assert_eq!(outcome, Ok("mu_l((0.7));".to_owned()), "brackets around a number are no expression");
            continue;
        }
        let refused = outcome.expect_err(script);
        assert!(refused.contains("mu_l(…) is handed an expression here"), "{refused}");
        assert!(refused.contains("^^^^"), "{refused}");
    }
    let refused = refused("let p = param(\"p\", deg(90));", &[("p", 1.0)]);
    assert!(refused.contains("param(\"p\", …) is handed an expression here"), "{refused}");
}

#[test]
fn of_several_calls_none_is_guessed() {
    let message = refused("if true { mu_l(0.5); }\nelse { mu_l(0.9); }", &[("mu_l", 0.7)]);
    assert!(message.contains("mu_l(…) stands in the script 2 times") && message.contains("lines 1, 2"), "{message}");
    let message = refused("fn set(x) { mu_l(x); } set(0.5); mu_l(0.9);", &[("mu_l", 0.7)]);
    assert!(message.contains("2 times"), "{message}");
}

#[test]
fn a_name_that_is_made_up_or_missing_is_refused() {
    let message = refused("for i in 0..2 { param(\"p\" + i, 1); }", &[("p1", 2.0)]);
    assert!(message.contains("param(\"p1\", …) does not stand in the script"), "{message}");
    let message = refused("param(`p${1}`, 1);", &[("p1", 2.0)]);
    assert!(message.contains("does not stand in the script"), "{message}");
}

#[test]
fn what_overrules_the_new_value_is_told() {
    let message = refused("fn mu_l(x) { } mu_l(0.5);", &[("mu_l", 0.7)]);
    assert!(message.contains("mu_l would be 1 and not 0.7"), "{message}");
    let folder = Folder::with(&[
        ("scene.rhai", "import \"ice\" as ice;\nice::set();\n"),
        ("ice.rhai", "fn set() { mu_l(0.1); }"),
    ]);
    let message = written_in(&folder, &[("mu_l", 0.7)], &Options::default()).expect_err("the import has the last word");
    assert!(message.contains("mu_l would be 0.1 and not 0.7"), "{message}");
}

#[test]
fn a_value_that_the_script_does_not_allow_is_refused() {
    let message = refused("param(\"p\", 8, 0, 30);", &[("p", 31.0)]);
    assert!(message.contains("outside 0 … 30"), "{message}");
    let message = refused("mu_l(0.5);", &[("mu_l", -1.0)]);
    assert!(message.contains("mu_l must be 0 or more"), "{message}");
}

#[test]
fn what_is_set_from_outside_is_no_obstacle() {
    let folder = Folder::with(&[("scene.rhai", "mu_l(0.5); param(\"p\", 1);")]);
    let after = written_in(&folder, &[("mu_l", 0.7)], &set(&[("mu_l", 0.9), ("p", 3.0)]));
    assert_eq!(after, Ok("mu_l(0.7); param(\"p\", 1);".to_owned()));
}
