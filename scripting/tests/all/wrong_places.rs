//! The whole text of errors. Where an error is shown, and how one gets there.

use choque_scripting::Options;
use insta::assert_snapshot;

use crate::support::{error, error_in};

#[test]
fn an_error_in_a_function_tells_how_one_gets_there() {
    assert_snapshot!(
        error("fn car(i) { mobile(\"c\" + i).rect(1, -1) }\nfn row(n) {\n    for i in 0..n { car(i); }\n}\nrow(3);"),
        @r#"
    error: body "c0": rect: depth must be greater than 0, not -1
     --> scene.rhai:1:29
      |
    1 | fn car(i) { mobile("c" + i).rect(1, -1) }
      |                             ^^^^
      |
      = note: in `car`, called at scene.rhai:3:21
      = note: in `row`, called at scene.rhai:5:1
    "#
    );
    assert_snapshot!(error("let f = |x| x.foo;\n[1, 2].map(f);"), @r#"
    error: a whole number has no property `foo`
     --> scene.rhai:1:15
      |
    1 | let f = |x| x.foo;
      |               ^^^
      |
      = note: in a closure called at scene.rhai:2:8
      = note: in `map`, called at scene.rhai:2:8
    "#);
    assert_snapshot!(error("let f = |a, b| a;\nf.call(1);"), @r#"
    error: the closure takes another number of arguments than it is given
     --> scene.rhai:2:3
      |
    2 | f.call(1);
      |   ^^^^
    "#);
}

#[test]
fn an_error_in_a_module_is_shown_there() {
    let module = "fn bad(name) {\n    mobile(name).rect(\"x\", 2)\n}\nfn later() { expect(\"later\", |world| world.foo > 1); }\n\
                  fn boom() { [1][7] }";
    let files = |script| {
        [
            ("scene.rhai", script),
            ("lib/cars.rhai", module),
            ("lib/broken.rhai", "fn f( { }"),
            ("lib/top.rhai", "\nsteps(-1);"),
        ]
    };
    let error = |script| error_in(&files(script), &Options::default());
    assert_snapshot!(error("import \"lib/cars\" as cars;\ncars::bad(\"a\");"), @r#"
    error: body "a": rect: width must be a number, not a string
     --> lib/cars.rhai:2:18
      |
    2 |     mobile(name).rect("x", 2)
      |                  ^^^^
      |
      = note: in `bad`, called at scene.rhai:2:7
    "#);
    assert_snapshot!(error("import \"lib/cars\" as cars;\nmobile(\"a\").rect(1, 1);\ncars::later();"), @r#"
    error: the world has no body "foo", and no property of that name
     --> lib/cars.rhai:4:44
      |
    4 | fn later() { expect("later", |world| world.foo > 1); }
      |                                            ^^^
      |
      = note: in expect "later"
    "#);
    assert_snapshot!(error("import \"lib/cars\" as cars;\nmobile(\"a\").rect(1, 1);\nfn on_step(world) { cars::boom(); }"), @r#"
    error: there is no entry 7: the array has 1 entry, counted from 0
     --> lib/cars.rhai:5:17
      |
    5 | fn boom() { [1][7] }
      |                 ^
      |
      = note: in `boom`, called at scene.rhai:3:27
      = note: in `on_step`
    "#);
    assert_snapshot!(error("import \"lib/broken\" as broken;"), @r#"
    error: `)` is missing to close the parameters list of function 'f'
     --> lib/broken.rhai:1:7
      |
    1 | fn f( { }
      |       ^
      |
      = note: imported at scene.rhai:1:8
    "#);
    assert_snapshot!(error("import \"lib/top\" as top;"), @r#"
    error: steps must be 0 or more, not -1
     --> lib/top.rhai:2:1
      |
    2 | steps(-1);
      | ^^^^^
      |
      = note: imported at scene.rhai:1:8
    "#);
    assert_snapshot!(error("import \"lib/car\" as cars;"), @r#"
    error: import: there is no file "lib/car"
     --> scene.rhai:1:8
      |
    1 | import "lib/car" as cars;
      |        ^^^^^^^^^
      |
      = help: did you mean "lib/cars.rhai"?
    "#);
    assert_snapshot!(error("cars::bad(\"a\");"), @r#"
    error: no module is imported as `cars`
     --> scene.rhai:1:1
      |
    1 | cars::bad("a");
      | ^^^^
      |
      = help: write import "…" as cars; above
    "#);
    assert_snapshot!(error("import \"lib/cars\" as cars;\ncars::baad(\"a\");"), @r#"
    error: there is no word or function `cars::baad`
     --> scene.rhai:2:7
      |
    2 | cars::baad("a");
      |       ^^^^
      |
      = help: did you mean `bad`?
    "#);
}

#[test]
fn a_scene_that_cannot_run_is_shown_where_the_body_was_made() {
    assert_snapshot!(error("steps(3);\nlet car = mobile(\"car\");"), @r#"
    error: body "car": it has no rectangle; give it one with .rect, .mesh or .model
     --> scene.rhai:2:11
      |
    2 | let car = mobile("car");
      |           ^^^^^^
    "#);
    let files = [("scene.rhai", "import \"m\" as m;\nm::car();"), ("m.rhai", "fn car() {\n    mobile(\"car\")\n}")];
    assert_snapshot!(error_in(&files, &Options::default()), @r#"
    error: body "car": it has no rectangle; give it one with .rect, .mesh or .model
     --> m.rhai:2:5
      |
    2 |     mobile("car")
      |     ^^^^^^
    "#);
}

#[test]
fn a_body_that_leaves_the_finite_numbers_is_named() {
    let script = "time_step(1000);\nmobile(\"rocket\").rect(1, 1).at(1.7e308, 0).velocity(1e307, 0);";
    assert_snapshot!(error(script), @r#"
    error: body "rocket" became non-finite in iteration 0: x = NaN, z = 0, vx = 1e307, vz = 0, spin = 0
     --> scene.rhai:2:1
      |
    2 | mobile("rocket").rect(1, 1).at(1.7e308, 0).velocity(1e307, 0);
      | ^^^^^^
      |
      = help: look for a huge velocity, mass or force; `always` can tell when it begins
    "#);
}
