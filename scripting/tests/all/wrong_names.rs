//! The whole text of errors. Misspelt names and broken syntax.

use choque_scripting::{Options, Scenario};
use insta::assert_snapshot;

use crate::support::{Folder, error, error_in, error_with, scene, set, while_running};

#[test]
fn a_misspelt_name_finds_its_word() {
    assert_snapshot!(error("mobil(\"a\");"), @r#"
    error: there is no word or function `mobil`
     --> scene.rhai:1:1
      |
    1 | mobil("a");
      | ^^^^^
      |
      = help: did you mean `mobile`?
    "#);
    assert_snapshot!(error("mobile(\"a\")\n    .rect(1, 1)\n    .velcoity(1, 0);"), @r#"
    error: there is no word or function `velcoity`
     --> scene.rhai:3:6
      |
    3 |     .velcoity(1, 0);
      |      ^^^^^^^^
      |
      = help: did you mean `velocity`?
    "#);
    assert_snapshot!(error("let wall = fixed(\"w\");\nprint(wal.x);"), @r#"
    error: there is no variable `wal` here
     --> scene.rhai:2:7
      |
    2 | print(wal.x);
      |       ^^^
      |
      = help: did you mean `wall`?
    "#);
    assert_snapshot!(error("exchange(\"impuls\");"), @r#"
    error: exchange must be "document" or "impulse", not "impuls"
     --> scene.rhai:1:1
      |
    1 | exchange("impuls");
      | ^^^^^^^^
      |
      = help: did you mean `exchange("impulse")`?
    "#);
    assert_snapshot!(error("title = \"x\";"), @r#"
    error: there is no variable `title` here
     --> scene.rhai:1:1
      |
    1 | title = "x";
      | ^^^^^
      |
      = help: write title(text)
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"cat\"].vx = 1; }"), @r#"
    error: the world has no body "cat", and no property of that name
     --> scene.rhai:2:26
      |
    2 | fn on_step(world) { world["cat"].vx = 1; }
      |                          ^
      |
      = note: in `on_step`
      = help: did you mean `world["car"]`?
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"car\"].vex = 1; }"), @r#"
    error: a body has no property `vex`
     --> scene.rhai:2:34
      |
    2 | fn on_step(world) { world["car"].vex = 1; }
      |                                  ^^^
      |
      = note: in `on_step`
      = help: did you mean `.vx`?
    "#);
    assert_snapshot!(while_running("fn on_step(world) { print(world.tme); }"), @r#"
    error: the world has no body "tme", and no property of that name
     --> scene.rhai:2:33
      |
    2 | fn on_step(world) { print(world.tme); }
      |                                 ^^^
      |
      = note: in `on_step`
      = help: did you mean `world.time`?
    "#);
    assert_snapshot!(while_running("fn on_steps(world) { }"), @r#"
    error: nothing calls `on_steps` by itself
     --> scene.rhai:2:4
      |
    2 | fn on_steps(world) { }
      |    ^^^^^^^^
      |
      = help: did you mean `on_step`? If not, give it a name less like it
    "#);
    assert_snapshot!(error_with("param(\"push\", 8);", &set(&[("pusch", 1.0)])), @r#"
    error: --set pusch: the scenario has no param of that name
    --> scene.rhai
     = help: did you mean `push`?
    "#);
}

/// Rhai would call the function and never the word.
#[test]
fn a_function_does_not_hide_a_word() {
    assert_snapshot!(error("fn at(a, b) { a + b }\nmobile(\"car\").rect(1, 1).at(3, 4);"), @r#"
    error: fn at(a, b) would be called where `.at` is written
     --> scene.rhai:1:4
      |
    1 | fn at(a, b) { a + b }
      |    ^^
      |
      = help: `at` is a word: give the function another name
    "#);
    let files = [
        ("scene.rhai", "import \"cars\" as c;\nc::car(1);"),
        ("cars.rhai", "fn mass(i) { 100 * i }\nfn car(i) { mobile(\"car\" + i).rect(1, 1).mass(mass(i)) }"),
    ];
    assert_snapshot!(error_in(&files, &Options::default()), @r#"
    error: fn mass(i) would be called where `.mass` is written
     --> cars.rhai:1:4
      |
    1 | fn mass(i) { 100 * i }
      |    ^^^^
      |
      = note: imported at scene.rhai:1:8
      = help: `mass` is a word: give the function another name
    "#);
    scene("fn at(world) { world.time }\nmobile(\"car\").rect(1, 1).at(3, 4);");
    scene("fn mass(i) { 100 * i }\nmobile(\"car\").rect(1, 1).at(mass(1), 0);");
}

/// Endings that agree are no likeness.
#[test]
fn a_file_is_suggested_for_its_own_name_only() {
    let import = |name: &str| {
        let script = format!("import \"{name}\" as n;");
        error_in(&[("scene.rhai", &script), ("bom.rhai", ""), ("vehicles.rhai", "")], &Options::default())
    };
    assert!(!import("nope").contains("did you mean"));
    assert!(import("vehicels").contains("did you mean \"vehicles.rhai\"?"));
}

#[test]
fn what_a_function_cannot_see_is_explained() {
    assert_snapshot!(error("let car = mobile(\"car\").rect(1, 1);\nfn on_step(world) { car.vx = 1; }"), @r#"
    error: there is no variable `car` here
     --> scene.rhai:2:21
      |
    2 | fn on_step(world) { car.vx = 1; }
      |                     ^^^
      |
      = help: a function does not see the variables outside it: hand `car` over as an argument; a constant is there as global::car, a body as world["…"]
    "#);
    assert_snapshot!(error("print(world.time);"), @r#"
    error: there is no variable `world` here
     --> scene.rhai:1:7
      |
    1 | print(world.time);
      |       ^^^^^
      |
      = help: the world is there in callbacks and expectations: fn on_step(world) { … }
    "#);
}

#[test]
fn syntax_errors_have_their_line_too() {
    assert_snapshot!(error("let a = 1\nlet b = 2;"), @r#"
    error: `;` is missing to terminate this statement
     --> scene.rhai:2:1
      |
    2 | let b = 2;
      | ^^^
      |
      = help: perhaps at the end of the line before
    "#);
    assert_snapshot!(error("mobile(\"a);"), @r#"
    error: this string is not closed
     --> scene.rhai:1:8
      |
    1 | mobile("a);
      |        ^^^^
      |
      = help: end it with the sign it began with
    "#);
    assert_snapshot!(error("if true {\n    steps(3);\n"), @r#"
    error: `}` is missing to terminate this block
     --> scene.rhai:2:14
      |
    2 |     steps(3);
      |              ^
    "#);
    assert_snapshot!(error("let x = 5 +* 3;"), @r#"
    error: `*` is not expected here
     --> scene.rhai:1:12
      |
    1 | let x = 5 +* 3;
      |            ^
    "#);
    assert_snapshot!(error("if 1 { }"), @r#"
    error: this must be a boolean expression, not a number
     --> scene.rhai:1:4
      |
    1 | if 1 { }
      |    ^
    "#);
    assert_snapshot!(error("let α = 3;"), @r#"
    error: `α` cannot stand in a name
     --> scene.rhai:1:5
      |
    1 | let α = 3;
      |     ^
      |
      = help: names have the letters a to z, digits and _
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world.body(\"car\").vx = 1; }"), @r#"
    error: this cannot be assigned to
     --> scene.rhai:2:27
      |
    2 | fn on_step(world) { world.body("car").vx = 1; }
      |                           ^^^^
      |
      = help: write `world["car"].vx = 1`
    "#);
}

#[test]
fn a_diagnostic_can_be_taken_apart() {
    let folder = Folder::with(&[("scene.rhai", "steps(3);\n  mobil(\"a\");")]);
    let error = Scenario::load(&folder.path("scene.rhai"), &Options::default()).err().unwrap();
    assert_eq!((error.line, error.column), (Some(2), Some(3)));
    assert_eq!(error.file, Some(folder.path("scene.rhai")));
    assert_eq!(error.message, "there is no word or function `mobil`");
    assert_eq!(error.hint.as_deref(), Some("did you mean `mobile`?"));
}
