//! The whole text of errors. What is handed over: of the wrong type, out of range, too much or too little.

use choque_scripting::Options;
use insta::assert_snapshot;

use crate::support::{Folder, error};

#[test]
fn a_wrong_type_names_the_argument() {
    assert_snapshot!(error("mobile(\"a\")\n    .rect(\"wide\", 2);"), @r#"
    error: body "a": rect: width must be a number, not a string
     --> scene.rhai:2:6
      |
    2 |     .rect("wide", 2);
      |      ^^^^
    "#);
    assert_snapshot!(error("mobile(3);"), @r#"
    error: mobile: name must be a string, not a whole number
     --> scene.rhai:1:1
      |
    1 | mobile(3);
      | ^^^^^^
    "#);
    assert_snapshot!(error("steps([]);"), @r#"
    error: steps must be a whole number, not an array
     --> scene.rhai:1:1
      |
    1 | steps([]);
      | ^^^^^
    "#);
    assert_snapshot!(error("let car = mobile(\"car\");\ncar.at(car, 0);"), @r#"
    error: body "car": at: x must be a number, not a body
     --> scene.rhai:2:5
      |
    2 | car.at(car, 0);
      |     ^^
    "#);
    assert_snapshot!(error("steps(1.5);"), @r#"
    error: steps must be a whole number, not 1.5
     --> scene.rhai:1:1
      |
    1 | steps(1.5);
      | ^^^^^
    "#);
    assert_snapshot!(error("steps(1e18);"), @r#"
    error: steps must be between -9007199254740992 and 9007199254740992, not 1e18
     --> scene.rhai:1:1
      |
    1 | steps(1e18);
      | ^^^^^
    "#);
    assert_snapshot!(error("sleeping(1);"), @r#"
    error: sleeping must be true or false, not a whole number
     --> scene.rhai:1:1
      |
    1 | sleeping(1);
      | ^^^^^^^^
    "#);
    assert_snapshot!(error("substeps(2.5);"), @r#"
    error: substeps must be a whole number, not 2.5
     --> scene.rhai:1:1
      |
    1 | substeps(2.5);
      | ^^^^^^^^
    "#);
    assert_snapshot!(error("sin(\"x\");"), @r#"
    error: `sin` works on numbers, not on a string
     --> scene.rhai:1:1
      |
    1 | sin("x");
      | ^^^
    "#);
}

#[test]
fn a_number_out_of_range_names_the_argument_and_the_value() {
    assert_snapshot!(error("steps(9);\nsubsteps(1001);"), @r#"
    error: substeps must be between 1 and 1000, not 1001
     --> scene.rhai:2:1
      |
    2 | substeps(1001);
      | ^^^^^^^^
    "#);
    assert_snapshot!(error("mobile(\"a\").mass(0);"), @r#"
    error: body "a": mass must be greater than 0, not 0
     --> scene.rhai:1:13
      |
    1 | mobile("a").mass(0);
      |             ^^^^
    "#);
    assert_snapshot!(error("mobile(\"a\").velocity(0.0 / 0.0, 0);"), @r#"
    error: body "a": velocity: x must be a finite number, not NaN
     --> scene.rhai:1:13
      |
    1 | mobile("a").velocity(0.0 / 0.0, 0);
      |             ^^^^^^^^
    "#);
    assert_snapshot!(error("gravity(0, -1e400);"), @r#"
    error: gravity: z must be a finite number, not -inf
     --> scene.rhai:1:1
      |
    1 | gravity(0, -1e400);
      | ^^^^^^^
    "#);
    assert_snapshot!(error("mobile(\"a\").rect(3, 1, 0, 1);"), @r#"
    error: body "a": rect: x_min must be less than x_max, but 3 is not less than 1
     --> scene.rhai:1:13
      |
    1 | mobile("a").rect(3, 1, 0, 1);
      |             ^^^^
      |
      = help: the order is rect(x_min, x_max, z_min, z_max)
    "#);
    assert_snapshot!(error("restitution(1.5);"), @r#"
    error: restitution must be between 0 and 1, not 1.5
     --> scene.rhai:1:1
      |
    1 | restitution(1.5);
      | ^^^^^^^^^^^
    "#);
    assert_snapshot!(error("mobile(\"a\").scale(1, 0, 1);"), @r#"
    error: body "a": scale: sy must be greater than 0, not 0
     --> scene.rhai:1:13
      |
    1 | mobile("a").scale(1, 0, 1);
      |             ^^^^^
    "#);
    assert_snapshot!(error("random(3, 1);"), @r#"
    error: random: min must not be above max, but 3 is above 1
     --> scene.rhai:1:1
      |
    1 | random(3, 1);
      | ^^^^^^
    "#);
}

#[test]
fn a_wrong_number_of_arguments_names_the_signatures() {
    assert_snapshot!(error("mobile(\"a\").rect(1);"), @r#"
    error: rect takes (width, depth) or (x_min, x_max, z_min, z_max), not 1 argument
     --> scene.rhai:1:13
      |
    1 | mobile("a").rect(1);
      |             ^^^^
    "#);
    assert_snapshot!(error("title();"), @r#"
    error: title takes (text), not 0 arguments
     --> scene.rhai:1:1
      |
    1 | title();
      | ^^^^^
    "#);
    assert_snapshot!(error("fn car(i) { mobile(\"car\" + i) }\ncar(1, 2);"), @r#"
    error: `car` takes (i), not 2 arguments
     --> scene.rhai:2:1
      |
    2 | car(1, 2);
      | ^^^
    "#);
    assert_snapshot!(error("5.rect(1, 2);"), @r#"
    error: `rect` is a word of a body, not of a whole number
     --> scene.rhai:1:3
      |
    1 | 5.rect(1, 2);
      |   ^^^^
      |
      = help: write body.rect(width, depth) or body.rect(x_min, x_max, z_min, z_max)
    "#);
    assert_snapshot!(error("rect(1, 2);"), @r#"
    error: `rect` is a word of a body, and needs one
     --> scene.rhai:1:1
      |
    1 | rect(1, 2);
      | ^^^^
      |
      = help: write body.rect(width, depth) or body.rect(x_min, x_max, z_min, z_max)
    "#);
}

#[test]
fn values_that_do_not_fit_are_named_in_words() {
    assert_snapshot!(error("let x = 1 + true;"), @r#"
    error: `+` does not work on a whole number and true or false
     --> scene.rhai:1:11
      |
    1 | let x = 1 + true;
      |           ^
    "#);
    assert_snapshot!(error("\"a\" - 1"), @r#"
    error: `-` does not work on a string and a whole number
     --> scene.rhai:1:5
      |
    1 | "a" - 1
      |     ^
    "#);
    assert_snapshot!(error("let a = [1, 2];\na[5]"), @r#"
    error: there is no entry 5: the array has 2 entries, counted from 0
     --> scene.rhai:2:3
      |
    2 | a[5]
      |   ^
    "#);
    assert_snapshot!(error("let n = 5;\nfor i in n { }"), @r#"
    error: `for` goes through a range, an array or a string, and this is none
     --> scene.rhai:2:10
      |
    2 | for i in n { }
      |          ^
    "#);
    assert_snapshot!(error("let n = 5;\nif n { steps(1); }"), @r#"
    error: this must be true or false, not a whole number
     --> scene.rhai:2:4
      |
    2 | if n { steps(1); }
      |    ^
    "#);
    assert_snapshot!(error("9223372036854775807 + 1"), @r#"
    error: addition overflow: 9223372036854775807 + 1
     --> scene.rhai:1:21
      |
    1 | 9223372036854775807 + 1
      |                     ^
    "#);
    assert_snapshot!(error("10 ** 30"), @r#"
    error: `**`: the result is larger than the largest whole number
     --> scene.rhai:1:4
      |
    1 | 10 ** 30
      |    ^
      |
      = help: write a number with decimals: 10.0 ** 30
    "#);
    assert_snapshot!(error("let car = mobile(\"car\");\ncar[\"x\"]"), @r#"
    error: a body has no entries to reach with [ ]
     --> scene.rhai:2:4
      |
    2 | car["x"]
      |    ^
      |
      = help: its properties are reached with a dot: body.x
    "#);
    assert_snapshot!(error("[1, \"a\"].sort()"), @r#"
    error: sort: a whole number and a string have no order of their own
     --> scene.rhai:1:10
      |
    1 | [1, "a"].sort()
      |          ^^^^
      |
      = help: give a closure: array.sort(|a, b| a.x - b.x)
    "#);
    assert_snapshot!(error("throw \"my own words\";"), @r#"
    error: the script threw: my own words
     --> scene.rhai:1:1
      |
    1 | throw "my own words";
      | ^^^^^
    "#);
    assert_snapshot!(error("try { mobile(\"a\").mass(-1) } catch (error) { throw error; }"), @r#"
    error: body "a": mass must be greater than 0, not -1
     --> scene.rhai:1:46
      |
    1 | try { mobile("a").mass(-1) } catch (error) { throw error; }
      |                                              ^^^^^
    "#);
}

#[test]
fn no_error_names_a_type_of_rust() {
    let values = ["1", "1.5", "true", "\"a\"", "'c'", "[1]", "#{a: 1}", "()", "|x| x", "0..3", "mobile(\"m\")"];
    for value in values {
        for call in [
            "{} + mobile(\"q\")",
            "mobile({})",
            "mobile(\"q\").at({}, {})",
            "{}.nonsense",
            "{}.nonsense()",
            "{}[#{}]",
            "for i in {} { i.x.y.z.w }",
            "throw {}",
            "expect(\"a\", {})",
            "-{}",
            "sin({})",
            "if {} { 1.x }",
            "title({}); title(1)",
            "[3, {}].sort(); 1.x",
            "range({}, 3); 1.x",
            "fixed(\"f\").patrol({}, 1)",
        ] {
            let script = call.replace("{}", value);
            let folder = Folder::with(&[("scene.rhai", &script)]);
            let Err(error) = folder.run("scene.rhai", &Options::default()) else { continue };
            for name in ["i64", "f64", "&str", "Dynamic", "alloc", "rhai::", "choque_", "Immutable", "FnPtr", "anon$"] {
                assert!(!error.contains(name), "{script}\n{error}");
            }
        }
    }
}
