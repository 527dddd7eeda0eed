//! T19 … T21: what a script may not say, and time steps that are none.

use std::process::Output;

use choque_engine::scene::{ExchangeRule, MotionRule};
use choque_engine::{Vec2, World};

use super::kit::{block, continuous, run, state, wall};
use crate::support::{choque, folder, stderr};

fn play(script: &str) -> Output {
    let folder = folder(&[("scene.rhai", script)]);
    choque().arg("run").arg(folder.path().join("scene.rhai")).output().expect("the command starts")
}

/// Refused: exit code 2, and the message names what is wrong, with the value and the line.
#[track_caller]
fn assert_refused(script: &str, names: &[&str]) {
    let output = play(script);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{script}\n{message}");
    for name in names {
        assert!(message.contains(name), "{script}\ndoes not name {name}:\n{message}");
    }
}

const BODY: &str = "mobile(\"b\").rect(1, 1);";

#[test]
fn t19_what_is_not_a_finite_number_is_an_error_that_names_it() {
    let (nan, inf) = ("(0.0 / 0.0)", "(1.0 / 0.0)");
    for (word, argument) in [
        (".at(X, 0)", "at"),
        (".at(0, X)", "at"),
        (".velocity(X, 0)", "velocity"),
        (".velocity(0, X)", "velocity"),
        (".angle(X)", "angle"),
        (".spin(X)", "spin"),
        (".mass(X)", "mass"),
        (".inertia(X)", "inertia"),
        (".restitution(X)", "restitution"),
        (".friction(X)", "friction"),
    ] {
        for number in [nan, inf] {
            let word = word.replace('X', number);
            assert_refused(
                &format!("exchange(\"impulse\");\nmobile(\"b\").rect(1, 1){word};"),
                &[argument, "scene.rhai:2:"],
            );
        }
    }
    for setting in ["time_step", "restitution", "friction", "mu_l", "mu_a", "epsilon"] {
        for number in [nan, inf] {
            assert_refused(&format!("exchange(\"impulse\");\n{setting}({number});\n{BODY}"), &[setting]);
        }
    }
    for pair in ["gravity(X, 0)", "gravity(0, X)", "drag(X, 0)", "drag(0, X)"] {
        let word = pair.split('(').next().unwrap_or_default();
        assert_refused(&format!("{};\n{BODY}", pair.replace('X', nan)), &[word]);
    }
}

#[test]
fn t19_in_a_callback_too() {
    for write in ["x = X", "z = X", "angle = X", "vx = X", "vz = X", "spin = X"] {
        let script = format!("{BODY}\nfn on_step(world) {{ world[\"b\"].{}; }}", write.replace('X', "(0.0 / 0.0)"));
        assert_refused(&script, &["on_step", write.split(' ').next().unwrap_or_default()]);
    }
    for call in ["push(X, 0)", "push(0, X)", "twist(X)"] {
        let script = format!("{BODY}\nfn on_step(world) {{ world[\"b\"].{}; }}", call.replace('X', "(1.0 / 0.0)"));
        assert_refused(&script, &[call.split('(').next().unwrap_or_default()]);
    }
}

/// A command that is refused changes nothing: not the body it was meant for, and no other.
#[test]
fn t19_a_refused_command_leaves_the_world_as_it_was() {
    let bodies =
        vec![block("a", (1.0, 1.0), (0.0, 0.0), (1.0, 0.0), 1.0), block("b", (1.0, 1.0), (3.0, 0.0), (0.0, 0.0), 1.0)];
    for motion in [MotionRule::Stepped, MotionRule::Continuous] {
        let mut scene = continuous(1.0, 1.0 / 60.0, bodies.clone());
        scene.settings.motion = motion;
        let mut world = World::new(&scene).expect("a valid scene");
        let mut untouched = world.clone();
        for step in 0..300 {
            let id = world.find("a").expect("it is there");
            let bad = if step % 2 == 0 { f64::NAN } else { f64::INFINITY };
            assert!(world.set_position(id, Vec2::new(bad, 0.0)).is_err());
            assert!(world.set_velocity(id, Vec2::new(0.0, bad)).is_err());
            assert!(world.set_angle(id, bad).is_err() && world.set_spin(id, bad).is_err());
            assert!(world.push(id, Vec2::new(bad, 0.0)).is_err() && world.twist(id, bad).is_err());
            assert_eq!(world.digest(), untouched.digest());
            world.step();
            untouched.step();
        }
        assert_eq!(world.digest(), untouched.digest());
    }
}

#[test]
fn t20_zero_and_negative_are_errors_and_not_clamped() {
    for (word, argument) in [
        (".rect(0, 1)", "width"),
        (".rect(1, 0)", "depth"),
        (".rect(-1, 1)", "width"),
        (".rect(1, -1)", "depth"),
        (".rect(1, 1).mass(0)", "mass"),
        (".rect(1, 1).mass(-1)", "mass"),
        (".rect(1, 1).inertia(0)", "inertia"),
        (".rect(1, 1).restitution(-0.1)", "restitution"),
        (".rect(1, 1).restitution(1.1)", "restitution"),
        (".rect(1, 1).friction(-0.1)", "friction"),
    ] {
        assert_refused(&format!("exchange(\"impulse\");\nmobile(\"b\"){word};"), &[argument, "scene.rhai:2:"]);
    }
    for (setting, argument) in [
        ("restitution(-0.1)", "restitution"),
        ("restitution(1.5)", "restitution"),
        ("friction(-1)", "friction"),
        ("mu_l(-1)", "mu_l"),
        ("mu_a(-1)", "mu_a"),
        ("epsilon(-1)", "epsilon"),
        ("drag(-1, 0)", "drag"),
        ("steps(-1)", "steps"),
    ] {
        assert_refused(&format!("{setting};\n{BODY}"), &[argument]);
    }
}

/// A time step of zero is refused rather than run: no state can change. Negative ones too. A thousand seconds are finite.
#[test]
fn t21_time_steps_of_zero_below_zero_and_a_thousand_seconds() {
    assert_refused(&format!("time_step(0);\n{BODY}"), &["time_step", "greater than 0"]);
    assert_refused(&format!("time_step(-0.1);\n{BODY}"), &["time_step", "greater than 0"]);
    for exchange in [ExchangeRule::Document, ExchangeRule::Impulse] {
        for motion in [MotionRule::Stepped, MotionRule::Continuous] {
            for time_step in [1e3, 1e-9] {
                let bodies = vec![
                    wall("left", (1.0, 9.0), (-3.0, 0.0)),
                    wall("right", (1.0, 9.0), (3.0, 0.0)),
                    block("a", (1.0, 0.5), (0.0, 0.0), (2.0, 0.0), 1.0),
                ];
                let mut scene = continuous(0.9, time_step, bodies);
                (scene.settings.exchange, scene.settings.motion) = (exchange, motion);
                scene.settings.drag = (0.1, 0.1);
                let world = run(&scene, 3).world;
                let a = state(&world, "a");
                assert!(a.x.is_finite() && a.vx.abs() <= 2.0, "{exchange:?} {motion:?} {time_step}: {a:?}");
                // The document's exchange leaves a pair that goes on approaching to the next iteration (R11).
                let held = (exchange, motion) == (ExchangeRule::Impulse, MotionRule::Continuous);
                assert!(!held || a.x.abs() <= 2.0 + 1e-12, "it stays between the walls: {}", a.x);
            }
        }
    }
}
