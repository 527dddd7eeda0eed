//! Tunable numbers and overrides.

use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule, Param};
use choque_scripting::{Options, Overrides};

use crate::support::{printed, run, scene, scene_with, set};

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
    assert_eq!(settings.substeps, Some(8));
}
