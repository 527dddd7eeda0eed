//! The whole text of errors, as a designer sees them.

use choque_scripting::{Options, Scenario};
use insta::assert_snapshot;

use crate::support::{Folder, error, error_in, error_with, set};

/// A body that runs, for what goes wrong later.
#[track_caller]
fn while_running(callback: &str) -> String {
    error(&format!("mobile(\"car\").rect(1, 1);\n{callback}"))
}

#[test]
fn a_wrong_type_names_the_argument() {
    assert_snapshot!(error("mobile(\"a\")\n    .rect(\"wide\", 2);"), @r#"
    error: rect: width must be a number, not a string
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
    error: at: x must be a number, not a body
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
    assert_snapshot!(error("mobile(\"a\").mass(0);"), @r#"
    error: mass must be greater than 0, not 0
     --> scene.rhai:1:13
      |
    1 | mobile("a").mass(0);
      |             ^^^^
    "#);
    assert_snapshot!(error("mobile(\"a\").velocity(0.0 / 0.0, 0);"), @r#"
    error: velocity: x must be a finite number, not NaN
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
    error: rect: x_min must be less than x_max, but 3 is not less than 1
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
    error: scale: sy must be greater than 0, not 0
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
fn an_error_in_a_function_tells_how_one_gets_there() {
    assert_snapshot!(
        error("fn car(i) { mobile(\"c\" + i).rect(1, -1) }\nfn row(n) {\n    for i in 0..n { car(i); }\n}\nrow(3);"),
        @r#"
    error: rect: depth must be greater than 0, not -1
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
    error: rect: width must be a number, not a string
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
fn what_belongs_elsewhere_is_refused() {
    assert_snapshot!(while_running("fn on_step(world) { mobile(\"b\"); }"), @r#"
    error: `mobile` builds the scene: it belongs to the main part of the script, not to a callback
     --> scene.rhai:2:21
      |
    2 | fn on_step(world) { mobile("b"); }
      |                     ^^^^^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { time_step(1); }"), @r#"
    error: `time_step` builds the scene: it belongs to the main part of the script, not to a callback
     --> scene.rhai:2:21
      |
    2 | fn on_step(world) { time_step(1); }
      |                     ^^^^^^^^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { param(\"p\", 1); }"), @r#"
    error: param("p", …) is not declared in the main part of the script
     --> scene.rhai:2:21
      |
    2 | fn on_step(world) { param("p", 1); }
      |                     ^^^^^
      |
      = note: in `on_step`
      = help: declare it there too, so that --set and the tools know it before the run begins
    "#);
    assert_snapshot!(error("let car = mobile(\"car\").rect(1, 1);\ncar.vx = 3;"), @r#"
    error: .vx can be written in callbacks only
     --> scene.rhai:2:5
      |
    2 | car.vx = 3;
      |     ^^
      |
      = help: while the scene is being built, say .at(x, z), .angle(rad), .velocity(x, z), .spin(rad_per_s)
    "#);
    assert_snapshot!(while_running("always(\"looks\", |world| { world[\"car\"].vx = 1; true });"), @r#"
    error: an expectation only looks: it must not change the world
     --> scene.rhai:2:40
      |
    2 | always("looks", |world| { world["car"].vx = 1; true });
      |                                        ^^
      |
      = note: in always "looks"
      = help: change it in `fn on_step(world)`
    "#);
}

#[test]
fn what_cannot_be_written_says_so() {
    assert_snapshot!(while_running("fn on_step(world) { world.collisions = 3; }"), @r#"
    error: world.collisions can be read only
     --> scene.rhai:2:27
      |
    2 | fn on_step(world) { world.collisions = 3; }
      |                           ^^^^^^^^^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"car\"].mass = 3; }"), @r#"
    error: `mass` of a body can be read only
     --> scene.rhai:2:34
      |
    2 | fn on_step(world) { world["car"].mass = 3; }
      |                                  ^^^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"car\"] = 3; }"), @r#"
    error: world["car"] cannot be replaced
     --> scene.rhai:2:26
      |
    2 | fn on_step(world) { world["car"] = 3; }
      |                          ^
      |
      = note: in `on_step`
      = help: write its properties: world["car"].vx = 1
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"car\"].vx = 0.0 / 0.0; }"), @r#"
    error: body "car": vx must be a finite number, not NaN
     --> scene.rhai:2:34
      |
    2 | fn on_step(world) { world["car"].vx = 0.0 / 0.0; }
      |                                  ^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"car\"].vx = \"fast\"; }"), @r#"
    error: vx must be a number, not a string
     --> scene.rhai:2:34
      |
    2 | fn on_step(world) { world["car"].vx = "fast"; }
      |                                  ^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(error("fixed(\"wall\").rect(1, 1);\nfn on_step(world) { world[\"wall\"].push(1, 0); }"), @r#"
    error: body "wall" is fixed: push acts on mobile bodies only
     --> scene.rhai:2:35
      |
    2 | fn on_step(world) { world["wall"].push(1, 0); }
      |                                   ^^^^
      |
      = note: in `on_step`
    "#);
    assert_snapshot!(while_running("fn on_step(world) { world[\"car\"].push(1 / 0, 0); }"), @r#"
    error: body "car": push: fx must be a finite number, not inf
     --> scene.rhai:2:34
      |
    2 | fn on_step(world) { world["car"].push(1 / 0, 0); }
      |                                  ^^^^
      |
      = note: in `on_step`
    "#);
}

#[test]
fn bodies_that_contradict_themselves_are_refused() {
    assert_snapshot!(error("mobile(\"a\").rect(1, 1);\n\nmobile(\"a\");"), @r#"
    error: there is a body "a" already; it was made in line 1
     --> scene.rhai:3:1
      |
    3 | mobile("a");
      | ^^^^^^
      |
      = help: names are unique; in a loop write mobile("a" + i)
    "#);
    assert_snapshot!(error("mobile(\"a\").patrol([[1, 1]], 1);"), @r#"
    error: patrol is for fixed bodies, and "a" is mobile
     --> scene.rhai:1:13
      |
    1 | mobile("a").patrol([[1, 1]], 1);
      |             ^^^^^^
      |
      = help: make it with fixed("a"), or give it a .velocity or a .spin
    "#);
    assert_snapshot!(error("fixed(\"a\").patrol([[1, 1]], 1).velocity(1, 1);"), @r#"
    error: "a" has a patrol already; velocity would prescribe the same motion again
     --> scene.rhai:1:32
      |
    1 | fixed("a").patrol([[1, 1]], 1).velocity(1, 1);
      |                                ^^^^^^^^
      |
      = help: leave out .patrol or .velocity
    "#);
    assert_snapshot!(error("fixed(\"a\").spin(1).swing(1, 1);"), @r#"
    error: "a" has a spin already; swing would prescribe the same motion again
     --> scene.rhai:1:20
      |
    1 | fixed("a").spin(1).swing(1, 1);
      |                    ^^^^^
      |
      = help: leave out .spin or .swing
    "#);
    assert_snapshot!(error("fixed(\"a\").patrol([[1, 1, 1]], 1);"), @r#"
    error: patrol, entry 0 must be [x, z], not 3 numbers
     --> scene.rhai:1:12
      |
    1 | fixed("a").patrol([[1, 1, 1]], 1);
      |            ^^^^^^
    "#);
    assert_snapshot!(error("fixed(\"a\").patrol([], 1);"), @r#"
    error: patrol needs a point to travel to
     --> scene.rhai:1:12
      |
    1 | fixed("a").patrol([], 1);
      |            ^^^^^^
      |
      = help: write .patrol([[x, z]], speed)
    "#);
    assert_snapshot!(error("mobile(\"a\").mesh([[0, 0, 0], [1, \"y\", 1]]);"), @r#"
    error: mesh, entry 1, number 1 must be a number, not a string
     --> scene.rhai:1:13
      |
    1 | mobile("a").mesh([[0, 0, 0], [1, "y", 1]]);
      |             ^^^^
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
fn params_are_checked() {
    assert_snapshot!(error("param(\"p\", 5, 0, 3);"), @r#"
    error: param "p": the default 5 is outside 0 … 3
     --> scene.rhai:1:1
      |
    1 | param("p", 5, 0, 3);
      | ^^^^^
    "#);
    assert_snapshot!(error("param(\"p\", 5, 3, 0);"), @r#"
    error: param "p": min must not be above max, but 3 is above 0
     --> scene.rhai:1:1
      |
    1 | param("p", 5, 3, 0);
      | ^^^^^
    "#);
    assert_snapshot!(error("param(\"p\", 1);\nparam(\"p\", 2);"), @r#"
    error: param "p" has the default 1 in line 1, and 2 here
     --> scene.rhai:2:1
      |
    2 | param("p", 2);
      | ^^^^^
      |
      = help: use one default, or keep the value in a variable
    "#);
    assert_snapshot!(error("param(\"mu_l\", 1);"), @r#"
    error: param "mu_l": a setting has that name, and --set reaches it already
     --> scene.rhai:1:1
      |
    1 | param("mu_l", 1);
      | ^^^^^
      |
      = help: name it otherwise, or write mu_l(…)
    "#);
    assert_snapshot!(error_with("param(\"push\", 8, 0, 30);", &set(&[("push", 31.0)])), @r#"
    error: --set push=31: the script allows 0 … 30
     --> scene.rhai:1:1
      |
    1 | param("push", 8, 0, 30);
      | ^^^^^
    "#);
}

#[test]
fn callbacks_and_expectations_are_checked() {
    assert_snapshot!(while_running("fn on_step() { }"), @r#"
    error: on_step takes (world), not ()
     --> scene.rhai:2:4
      |
    2 | fn on_step() { }
      |    ^^^^^^^
      |
      = help: write fn on_step(world) { … }
    "#);
    assert_snapshot!(while_running("fn on_collision(world) { }"), @r#"
    error: on_collision takes (world, hit), not (world)
     --> scene.rhai:2:4
      |
    2 | fn on_collision(world) { }
      |    ^^^^^^^^^^^^
      |
      = help: write fn on_collision(world, hit) { … }
    "#);
    assert_snapshot!(while_running("fn stop_when(world) { 3 }"), @r#"
    error: stop_when must give true or false, not a whole number
     --> scene.rhai:2:4
      |
    2 | fn stop_when(world) { 3 }
      |    ^^^^^^^^^
    "#);
    assert_snapshot!(while_running("private fn on_step(world) { }"), @r#"
    error: on_step must not be private
     --> scene.rhai:2:12
      |
    2 | private fn on_step(world) { }
      |            ^^^^^^^
      |
      = help: write fn on_step(world) { … }
    "#);
    assert_snapshot!(error("expect(\"holds\", true);"), @r#"
    error: expect "holds": the condition must be a closure, not true or false
     --> scene.rhai:1:1
      |
    1 | expect("holds", true);
      | ^^^^^^
      |
      = help: write expect("holds", |world| …)
    "#);
    assert_snapshot!(error("expect(\"holds\", || true);"), @r#"
    error: expect "holds": the closure takes the world and nothing else
     --> scene.rhai:1:1
      |
    1 | expect("holds", || true);
      | ^^^^^^
      |
      = help: write expect("holds", |world| …)
    "#);
    assert_snapshot!(while_running("expect(\"holds\", |world| world.time);"), @r#"
    error: expect "holds" must give true or false, not a number with decimals
     --> scene.rhai:2:1
      |
    2 | expect("holds", |world| world.time);
      | ^^^^^^
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
    error: mass must be greater than 0, not -1
     --> scene.rhai:1:46
      |
    1 | try { mobile("a").mass(-1) } catch (error) { throw error; }
      |                                              ^^^^^
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
