//! Files that are no scenario, and scenes as plain data.

use std::fs;

use choque_engine::scene::ExchangeRule;
use choque_scripting::{Callbacks, Options, Overrides, Step};
use insta::assert_snapshot;

use crate::support::{Folder, error_in, error_with, set};

const PLAIN: &str = r#"(
    title: "Two",
    settings: (time_step: 0.5, steps: 4),
    bodies: [
        (name: "a", kind: mobile, parts: [rect((x_min: -1, x_max: 1, z_min: -1, z_max: 1))], velocity: Some((1, 0))),
        (name: "b", kind: fixed, parts: [rect((x_min: -1, x_max: 1, z_min: -1, z_max: 1))], at: (9, 0)),
    ],
)"#;

fn plain_error(text: &str, options: &Options) -> String {
    error_in(&[("scene.ron", text)], options)
}

#[test]
fn a_plain_scene_runs_without_callbacks() {
    let folder = Folder::with(&[("two.ron", PLAIN)]);
    let mut options = set(&[("mu_l", 0.5)]);
    options.overrides = Overrides { steps: Some(3), ..Overrides::default() };
    let scenario = folder.load("two.ron", &options).unwrap();
    assert_eq!((scenario.name(), scenario.title()), ("two", "Two".to_owned()));
    assert_eq!(scenario.callbacks(), Callbacks::default());
    assert_eq!((scenario.scene().settings.mu_l, scenario.scene().settings.steps), (0.5, 3));
    assert_eq!(scenario.scene().settings.exchange, ExchangeRule::Document);
    let mut run = scenario.start().unwrap();
    assert_eq!([run.step(), run.step(), run.step()].map(Result::unwrap), [Step::Going, Step::Going, Step::Done]);
    assert_eq!(run.world().time(), 1.5);
    assert!(run.conclude().unwrap().is_empty());
}

#[test]
fn a_script_and_its_plain_scene_run_to_the_same_bits() {
    let script = r#"steps(60); mobile("a").rect(1, 1).velocity(1, 0.5).spin(1); fixed("b").rect(1, 4).at(2, 0);"#;
    let folder = Folder::with(&[("scene.rhai", script)]);
    let scenario = folder.load("scene.rhai", &Options::default()).unwrap();
    fs::write(folder.path("plain.ron"), ron::to_string(scenario.scene()).unwrap()).unwrap();
    let digest = |name| folder.run(name, &Options::default()).unwrap().0.world().digest();
    assert_eq!(digest("plain.ron"), digest("scene.rhai"));
}

#[test]
fn a_malformed_plain_scene_is_told_with_its_line() {
    assert_snapshot!(plain_error("(\n    title: \"x\",\n    bodis: [],\n)", &Options::default()), @r#"
    error: not a scene: unexpected field named `bodis` in `Scene`, expected one of `title`, `settings`, `params`, or `bodies` instead
     --> scene.ron:3:5
      |
    3 |     bodis: [],
      |     ^^^^^
    "#);
    assert_snapshot!(plain_error("(\n    settings: (time_step: \"fast\"),\n)", &Options::default()), @r#"
    error: not a scene: expected float
     --> scene.ron:2:26
      |
    2 |     settings: (time_step: "fast"),
      |                          ^
    "#);
    assert_snapshot!(plain_error("(settings: (substeps: Some(-4)))", &Options::default()), @r#"
    error: not a scene: integer is out of bounds
     --> scene.ron:1:29
      |
    1 | (settings: (substeps: Some(-4)))
      |                             ^
    "#);
    assert_snapshot!(plain_error("(title: \"x\"", &Options::default()), @r#"
    error: not a scene: expected comma
     --> scene.ron:1:10
      |
    1 | (title: "x"
      |          ^
    "#);
}

#[test]
fn a_plain_scene_that_cannot_run_is_shown_where_the_body_is_named() {
    let uncut = PLAIN.replace("steps: 4", "substeps: Some(0)");
    assert_snapshot!(plain_error(&uncut, &Options::default()), @r#"
    error: substeps must be between 1 and 1000, not 0
    --> scene.ron
    "#);
    let heavy = PLAIN.replace("velocity: Some((1, 0))", "mass: Some(-3)");
    assert_snapshot!(plain_error(&heavy, &Options::default()), @r#"
    error: body "a": mass must be greater than 0, not -3
     --> scene.ron:5:16
      |
    5 |         (name: "a", kind: mobile, parts: [rect((x_min: -1, x_max: 1, z_min: -1, z_max: 1))], mass: Some(-3)),
      |                ^^^
    "#);
}

#[test]
fn a_plain_scene_has_no_params_left_to_set() {
    let with_param = PLAIN.replace("settings:", "params: [(name: \"push\", value: 8, range: None)],\n    settings:");
    assert_snapshot!(plain_error(&with_param, &set(&[("push", 1.0)])), @r#"
    error: --set push: the scenario has no param of that name
    --> scene.ron
     = help: a .ron scene is plain data: its params have been used; set them for its script
    "#);
    assert_snapshot!(plain_error(PLAIN, &set(&[("epsilom", 1.0)])), @r#"
    error: --set epsilom: the scenario has no param of that name
    --> scene.ron
     = help: did you mean `epsilon`?
    "#);
}

#[test]
fn what_is_no_scenario_is_refused() {
    let folder = Folder::with(&[("notes.txt", ""), ("folder.rhai/x", "")]);
    fs::write(folder.path("latin.rhai"), b"// first\n// caf\xe9\n").unwrap();
    fs::write(folder.path("bom.rhai"), "\u{feff}steps(3);").unwrap();
    let load = |name: &str| folder.load(name, &Options::default()).map(|scenario| scenario.scene().settings.steps);
    assert_snapshot!(load("missing.rhai").unwrap_err(), @r#"
    error: cannot read missing.rhai: there is no such file
    --> missing.rhai
    "#);
    assert_snapshot!(load("notes.txt").unwrap_err(), @r#"
    error: notes.txt is neither a .rhai script nor a .ron scene
    --> notes.txt
     = help: a scenario's file name ends in .rhai or .ron
    "#);
    assert_snapshot!(load("folder.rhai").unwrap_err(), @r#"
    error: cannot read folder.rhai: it is not a file
    --> folder.rhai
    "#);
    assert_snapshot!(load("latin.rhai").unwrap_err(), @r#"
    error: cannot read latin.rhai: line 2 is not UTF-8 text
    --> latin.rhai
     = help: save it as UTF-8
    "#);
    assert_eq!(load("bom.rhai"), Ok(3), "a byte order mark is no error");
}

#[test]
fn a_model_that_is_none_is_told_with_its_line() {
    let files = |text| [("scene.rhai", "let car = mobile(\"car\");\ncar.model(\"car.obj\");"), ("car.obj", text)];
    let error = |text| error_in(&files(text), &Options::default());
    assert_snapshot!(error("v 0 0 0\nv 1 one 1\n"), @r#"
    error: body "car": `one` is not a finite number
     --> car.obj:2:5
      |
    2 | v 1 one 1
      |     ^^^
      |
      = note: read at scene.rhai:2:5
    "#);
    assert_snapshot!(error("v 0 0 0\nw 1 1 1\n"), @r#"
    error: body "car": `w` is not a statement of a .obj file
     --> car.obj:2:1
      |
    2 | w 1 1 1
      | ^
      |
      = note: read at scene.rhai:2:5
    "#);
    assert_snapshot!(error("# nothing\n"), @r#"
    error: body "car": model has no vertices
     --> scene.rhai:2:5
      |
    2 | car.model("car.obj");
      |     ^^^^^
    "#);
    assert_snapshot!(error("v 0 0 0\nv 0 1 1\n"), @r#"
    error: body "car": model is flat: all its vertices have x = 0
     --> scene.rhai:2:5
      |
    2 | car.model("car.obj");
      |     ^^^^^
      |
      = help: an area needs a width along X and a depth along Z
    "#);
    assert_snapshot!(error_in(&[("scene.rhai", "mobile(\"a\").model(\"crate.obj\");"), ("crates.obj", "")], &Options::default()), @r#"
    error: body "a": model: there is no file "crate.obj"
     --> scene.rhai:1:13
      |
    1 | mobile("a").model("crate.obj");
      |             ^^^^^
      |
      = help: did you mean "crates.obj"?
    "#);
}

#[test]
fn options_that_cannot_be_are_refused() {
    let overrides = Overrides { time_step: Some(0.0), ..Overrides::default() };
    assert_snapshot!(error_with("", &Options { overrides, ..Options::default() }), @"error: --time-step must be greater than 0, not 0");
    let overrides = Overrides { substeps: Some(1001), ..Overrides::default() };
    assert_snapshot!(error_with("", &Options { overrides, ..Options::default() }), @"error: --substeps must be between 1 and 1000, not 1001");
    assert_snapshot!(error_with("", &set(&[("mu_l", -1.0)])), @r#"
    error: --set mu_l=-1: mu_l must be 0 or more, not -1
    --> scene.rhai
    "#);
    assert_snapshot!(error_with("", &set(&[("restitution", f64::NAN)])), @r#"
    error: --set restitution=NaN: restitution must be a finite number, not NaN
    --> scene.rhai
    "#);
    assert_snapshot!(error_with("param(\"push\", 8);", &set(&[("push", f64::INFINITY)])), @r#"
    error: --set push=inf: push must be a finite number, not inf
    --> scene.rhai
    "#);
}
