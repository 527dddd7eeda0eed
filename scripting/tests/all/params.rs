//! Tunable numbers and overrides.

use std::fs;

use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule, Param};
use choque_scripting::{Options, Overrides, Scenario, Step};

use crate::support::{Folder, printed, run, scene, scene_with, set};

const SCRIPT: &str = r#"
    let push = param("push", 8, 0, 30);
    let count = param("count", 3);
    for i in 0..count { mobile("car" + i).rect(1, 1).at(3 * i, 0).velocity(push, 0); }
"#;

#[test]
fn a_param_has_its_default_until_it_is_set() {
    let plain = scene(SCRIPT);
    assert_eq!(plain.bodies.len(), 3);
    assert_eq!(plain.bodies[0].velocity, Some((8.0, 0.0)));
    let push = Param { name: "push".to_owned(), value: 8.0, range: Some((0.0, 30.0)) };
    assert_eq!(plain.params, [push, Param { name: "count".to_owned(), value: 3.0, range: None }]);

    let tuned = scene_with(SCRIPT, &set(&[("push", 1.0), ("count", 5.0), ("push", 12.5)]));
    assert_eq!(tuned.bodies.len(), 5);
    assert_eq!(tuned.bodies[0].velocity, Some((12.5, 0.0)), "the last value counts");
    assert_eq!((tuned.params[0].value, tuned.params[1].value), (12.5, 5.0));
}

#[test]
fn a_param_may_be_asked_for_again_anywhere() {
    assert_eq!(printed(r#"let a = param("p", 2); fn f() { param("p", 2.0) } print(a + f());"#), ["4"]);
    let (run, _) = run(r#"
        param("stop", 5, 0, 10);
        mobile("a").rect(1, 1);
        fn stop_when(world) { world.iteration >= param("stop", 5) }
    "#);
    assert_eq!(run.world().iteration(), 5);
}

#[test]
fn set_reaches_the_settings_and_wins_over_the_script() {
    let values = [("mu_l", 0.5), ("mu_a", 0.25), ("epsilon", 0.125), ("restitution", 1.0), ("friction", 2.0)];
    let settings = scene_with("mu_l(0.9); restitution(0.1);", &set(&values)).settings;
    assert_eq!((settings.mu_l, settings.mu_a, settings.epsilon), (0.5, 0.25, 0.125));
    assert_eq!((settings.restitution, settings.friction), (1.0, 2.0));
}

#[test]
fn overrides_win_over_the_script() {
    let overrides = Overrides {
        steps: Some(3),
        time_step: Some(0.5),
        substeps: Some(8),
        seed: Some(-4),
        exchange: Some(ExchangeRule::Impulse),
        detection: Some(Detection::Complete),
        motion: Some(MotionRule::Continuous),
        broad_phase: Some(BroadPhaseChoice::AllPairs),
    };
    let options = Options { overrides, ..Options::default() };
    let settings = scene_with("steps(100); time_step(1); substeps(2); mu_l(0.5);", &options).settings;
    assert_eq!((settings.steps, settings.time_step, settings.mu_l), (3, 0.5, 0.5));
    assert_eq!((settings.exchange, settings.detection), (ExchangeRule::Impulse, Some(Detection::Complete)));
    assert_eq!((settings.motion, settings.broad_phase), (MotionRule::Continuous, BroadPhaseChoice::AllPairs));
    assert_eq!((settings.substeps, settings.seed), (Some(8), -4));
}

#[test]
fn a_seed_from_outside_wins_over_the_main_part_and_not_over_callbacks() {
    let script = r#"
        seed(3);
        mobile("a").rect(1, 1).at(random(0, 1), 0);
        fn on_step(world) { seed(5); world["a"].vx = random(0, 1); }
    "#;
    let folder = Folder::with(&[("scene.rhai", script), ("seven.rhai", &script.replace("seed(3)", "seed(7)"))]);
    let run = |name, seed| {
        let options = Options { overrides: Overrides { seed, ..Overrides::default() }, ..Options::default() };
        folder.run(name, &options).unwrap().0.world().digest()
    };
    assert_eq!(run("scene.rhai", Some(7)), run("seven.rhai", None));
    assert_ne!(run("scene.rhai", None), run("seven.rhai", None));
}

#[test]
fn a_scenario_with_other_numbers_is_the_one_loaded_with_them() {
    let folder = Folder::with(&[
        (
            "main.rhai",
            r#"import "lib/cars" as cars; seed(1); steps(20); for i in 0..param("count", 2) { cars::car(i); }"#,
        ),
        (
            "lib/cars.rhai",
            r#"fn car(i) { mobile("car" + i).rect(1, 1).at(3 * i, 0).velocity(random(0, 1), param("push", 1)); }
            always("not far", |world| world["car0"].x < 3);"#,
        ),
    ]);
    let mut plain = folder.load("main.rhai", &Options::default()).unwrap();
    fs::write(folder.path("plain.ron"), ron::to_string(plain.scene()).unwrap()).unwrap();
    let digest = |scenario: &Scenario| {
        let mut run = scenario.start().unwrap();
        while run.step().unwrap() == Step::Going {}
        assert!(run.conclude().unwrap().iter().all(|expectation| expectation.held));
        (run.world().digest(), run.world().len())
    };
    for (count, seed) in [(5.0, None), (1.0, Some(9)), (2.0, None)] {
        let mut options = set(&[("push", 0.5), ("count", count)]);
        options.overrides.seed = seed;
        let again = plain.with(&options.set, options.overrides).unwrap();
        let loaded = folder.load("main.rhai", &options).unwrap();
        assert_eq!(digest(&again), digest(&loaded), "{count} cars");
        assert_eq!(digest(&again), digest(&loaded), "a second run");
        plain = again;
    }
    let error = plain.with(&[("pusch".to_owned(), 1.0)], Overrides::default()).unwrap_err();
    assert_eq!(error.hint.as_deref(), Some("did you mean `push`?"));
    let scene = folder.load("plain.ron", &Options::default()).unwrap();
    let settings = Overrides { steps: Some(3), ..Overrides::default() };
    assert_eq!(scene.with(&[("mu_l".to_owned(), 0.25)], settings).unwrap().scene().settings.mu_l, 0.25);
    assert_eq!(scene.with(&[], Overrides::default()).unwrap().scene().settings, scene.scene().settings);
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
