//! The whole text of errors. What a scenario must not do, at the wrong time or at all.

use insta::assert_snapshot;

use crate::support::{error, error_with, set, while_running};

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
    error: an expectation or a target only looks: it must not change the world
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
    assert_snapshot!(error("fixed(\"a\").patrol([[1]], 1);"), @r#"
    error: body "a": patrol, entry 0 must be [x, z], not 1 number
     --> scene.rhai:1:12
      |
    1 | fixed("a").patrol([[1]], 1);
      |            ^^^^^^
    "#);
    assert_snapshot!(error("fixed(\"a\").patrol([[1, 1, 1]], 1);"), @r#"
    error: body "a": patrol, entry 0 must be [x, z], not 3 numbers
     --> scene.rhai:1:12
      |
    1 | fixed("a").patrol([[1, 1, 1]], 1);
      |            ^^^^^^
    "#);
    assert_snapshot!(error("fixed(\"a\").patrol([], 1);"), @r#"
    error: body "a": patrol needs a point to travel to
     --> scene.rhai:1:12
      |
    1 | fixed("a").patrol([], 1);
      |            ^^^^^^
      |
      = help: write .patrol([[x, z]], speed)
    "#);
    assert_snapshot!(error("mobile(\"a\").mesh([[0, 0, 0], [1, \"y\", 1]]);"), @r#"
    error: body "a": mesh, entry 1, number 1 must be a number, not a string
     --> scene.rhai:1:13
      |
    1 | mobile("a").mesh([[0, 0, 0], [1, "y", 1]]);
      |             ^^^^
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
