//! What is refused at the door, by name and value; and what stops a run.

use choque_engine::scene::{Body, Detection, ExchangeRule, Kind, MotionRule, Part, Patrol, Scene, Settings, Swing};
use choque_engine::{CommandError, Extent, Rect, Vec2, World, note};

use crate::{after, body, scene};

fn refusal(scene: &Scene) -> String {
    World::new(scene).expect_err("it should be refused").to_string()
}

fn refused_setting(change: impl FnOnce(&mut Settings)) -> String {
    let mut scene = scene(vec![body("a", Kind::Mobile, 1.0, 1.0)]);
    change(&mut scene.settings);
    refusal(&scene)
}

fn refused_body(kind: Kind, change: impl FnOnce(&mut Body)) -> String {
    let mut a = body("a", kind, 1.0, 1.0);
    change(&mut a);
    refusal(&scene(vec![a]))
}

#[test]
fn settings_out_of_range_are_named_with_their_value() {
    assert_eq!(refused_setting(|s| s.time_step = 0.0), "time_step must be greater than 0, not 0");
    assert_eq!(refused_setting(|s| s.time_step = f64::NAN), "time_step must be a finite number, not NaN");
    assert_eq!(refused_setting(|s| s.mu_l = -0.5), "mu_l must be 0 or more, not -0.5");
    assert_eq!(refused_setting(|s| s.mu_a = f64::INFINITY), "mu_a must be a finite number, not inf");
    assert_eq!(refused_setting(|s| s.epsilon = -1e-3), "epsilon must be 0 or more, not -0.001");
    assert_eq!(refused_setting(|s| s.restitution = 1.5), "restitution must be between 0 and 1, not 1.5");
    assert_eq!(refused_setting(|s| s.substeps = Some(0)), "substeps must be between 1 and 1000, not 0");
    assert_eq!(refused_setting(|s| s.substeps = Some(u32::MAX)), "substeps must be between 1 and 1000, not 4294967295");
    assert_eq!(refused_setting(|s| s.gravity.1 = f64::NAN), "gravity: z must be a finite number, not NaN");
    assert_eq!(refused_setting(|s| s.drag.0 = -1.0), "drag: linear must be 0 or more, not -1");
}

#[test]
fn bodies_out_of_range_are_named_with_their_value() {
    let mobile = |change: fn(&mut Body)| refused_body(Kind::Mobile, change);
    assert_eq!(mobile(|b| b.mass = Some(0.0)), "body \"a\": mass must be greater than 0, not 0");
    assert_eq!(mobile(|b| b.mass = Some(1e-310)), "body \"a\": mass must be large enough to divide by, not 1e-310");
    assert_eq!(mobile(|b| b.inertia = Some(-1.0)), "body \"a\": inertia must be greater than 0, not -1");
    assert_eq!(
        mobile(|b| b.velocity = Some((0.0, f64::NAN))),
        "body \"a\": velocity: z must be a finite number, not NaN"
    );
    assert_eq!(mobile(|b| b.scale.1 = 0.0), "body \"a\": scale: y must be greater than 0, not 0");
    assert_eq!(
        mobile(|b| b.parts = vec![Part::Rect(Rect::centred(1.0, -2.0))]),
        "body \"a\": depth must be greater than 0, not -2"
    );
    assert_eq!(
        mobile(|b| b.parts = vec![Part::Rect(Rect::centred(1e-160, 1.0))]),
        "body \"a\": width must be between 1e-12 and 1e12 m, not 1e-160"
    );
}

#[test]
fn bodies_that_make_no_sense_are_told_why() {
    let fixed = |change: fn(&mut Body)| refused_body(Kind::Fixed, change);
    assert!(fixed(|b| b.parts.clear()).contains("it has no rectangle"));
    assert!(
        refused_body(Kind::Mobile, |b| b.swing = Some(Swing { angle: 1.0, period: 1.0 }))
            .contains("this one is mobile")
    );
    assert!(fixed(|b| b.patrol = Some(Patrol { points: vec![(0.0, 0.0)], speed: 1.0 })).contains("goes nowhere"));
    let both = |b: &mut Body| {
        b.patrol = Some(Patrol { points: vec![(1.0, 0.0)], speed: 1.0 });
        b.velocity = Some((1.0, 0.0));
    };
    assert!(refused_body(Kind::Fixed, both).contains("keep one"));
    let twins = scene(vec![body("a", Kind::Mobile, 1.0, 1.0), body("a", Kind::Fixed, 1.0, 1.0)]);
    assert_eq!(refusal(&twins), "body \"a\": the name is taken already; names are unique");
}

#[test]
fn commands_that_cannot_be_obeyed_change_nothing() {
    let mut world = World::new(&scene(vec![body("car", Kind::Mobile, 1.0, 1.0), body("wall", Kind::Fixed, 1.0, 1.0)]))
        .expect("a valid scene");
    let (car, wall) = (world.find("car").expect("there"), world.find("wall").expect("there"));
    let before = world.digest();
    let pushed = world.push(wall, Vec2::new(1.0, 0.0));
    assert_eq!(pushed, Err(CommandError::Fixed { body: "wall".into(), verb: "push" }));
    assert!(world.set_velocity(car, Vec2::new(f64::NAN, 0.0)).is_err());
    assert!(world.set_spin(wall, f64::INFINITY).is_err());
    assert!(world.set_position(car, Vec2::new(0.0, f64::NEG_INFINITY)).is_err());
    assert!(world.twist(car, f64::NAN).is_err());
    assert_eq!(world.digest(), before);
}

#[test]
fn a_body_that_leaves_the_finite_numbers_stops_the_run_by_name() {
    let mut runaway = body("runaway", Kind::Mobile, 1.0, 1.0);
    runaway.velocity = Some((1e308, 0.0));
    runaway.at = (1e308, 0.0);
    let settings = Settings { time_step: 0.25, ..Settings::default() };
    let mut world =
        World::new(&Scene { settings, ..scene(vec![body("calm", Kind::Mobile, 1.0, 1.0), runaway]) }).expect("valid");
    while world.fault().is_none() && world.iteration() < 100 {
        world.step();
    }
    let fault = world.fault().expect("1e308 + n·0.25e308 overflows").clone();
    assert_eq!((fault.body.as_str(), fault.iteration), ("runaway", 3));
    world.step();
    assert_eq!(world.fault(), Some(&fault), "the first fault is kept");
}

#[test]
fn notes_tell_of_settings_that_do_nothing() {
    let told = |exchange, motion, detection| {
        let settings =
            Settings { substeps: Some(8), sleeping: true, exchange, motion, detection, ..Settings::default() };
        let scene = Scene { settings, ..scene(vec![body("a", Kind::Mobile, 1.0, 1.0)]) };
        note::review(&scene, &after(&scene, 0)).iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert!(told(ExchangeRule::Impulse, MotionRule::Stepped, None).is_empty());
    let idle = "does nothing here: it is for detection(\"complete\")";
    let with_vertices = told(ExchangeRule::Impulse, MotionRule::Stepped, Some(Detection::Vertices));
    assert_eq!(with_vertices, [format!("substeps(8) {idle}"), format!("sleeping(true) {idle}")]);
    for (exchange, motion) in [
        (ExchangeRule::Document, MotionRule::Stepped),
        (ExchangeRule::Document, MotionRule::Continuous),
        (ExchangeRule::Impulse, MotionRule::Continuous),
    ] {
        let idle = "does nothing here: it is for exchange(\"impulse\") with motion(\"stepped\")";
        assert_eq!(told(exchange, motion, None), [format!("substeps(8) {idle}"), format!("sleeping(true) {idle}")]);
    }
}

/// A forgotten place in a loop: every pair overlaps, and a few lines say so.
#[test]
fn notes_stay_few_when_everything_overlaps() {
    let bodies = (0..3000).map(|i| body(&format!("b{i}"), Kind::Mobile, 1.0, 1.0)).collect();
    let scene = scene(bodies);
    let notes = note::review(&scene, &after(&scene, 0));
    assert_eq!(notes.len(), 6, "{notes:#?}");
    assert!(notes[0].to_string().starts_with("body \"b0\": it starts 1 m deep in \"b1\""), "{}", notes[0]);
    assert_eq!(notes[5].to_string(), "more pairs start overlapped");
}

#[test]
fn notes_name_what_a_designer_should_know() {
    let mut bridge = body("bridge", Kind::Fixed, 1.0, 1.0);
    bridge.parts = vec![Part::Mesh(Extent { x: (-1.0, 1.0), y: (0.0, 1.0), z: (-1.0, 1.0) })];
    bridge.height = 5.0;
    let mut blade = body("blade", Kind::Fixed, 6.0, 0.1);
    blade.spin = Some(10.0);
    let mut lopsided = body("lopsided", Kind::Mobile, 1.0, 1.0);
    lopsided.parts = vec![Part::Rect(Rect { x_min: 0.0, x_max: 2.0, z_min: 0.0, z_max: 1.0 })];
    let scene = scene(vec![bridge, blade, lopsided]);
    let notes: Vec<String> = note::review(&scene, &after(&scene, 0)).iter().map(ToString::to_string).collect();
    assert_eq!(notes.len(), 4, "{notes:#?}");
    assert!(notes[0].starts_with("body \"bridge\": its mesh does not cross the collision plane"), "{}", notes[0]);
    assert!(notes[2].starts_with("body \"blade\": its fastest point moves 0.5 m a step"), "{}", notes[2]);
    assert!(notes[1].contains("own centre is at (1, 0.5)"), "{}", notes[1]);
    assert!(notes[3].contains("starts 0.05 m deep in \"lopsided\""), "{}", notes[3]);
}
