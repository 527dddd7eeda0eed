//! Every scene runs under every engine, and what is measured of it is right.

use choque_peers::engine::{How, Motion, USUAL, deepest};
use choque_peers::judge::{judge, motions};
use choque_peers::scene::{Body, Judge, Name, Role, Scene};
use clap::ValueEnum;

fn still(at: [f64; 2], angle: f64) -> Motion {
    Motion { at, angle, velocity: [0.0, 0.0], spin: 0.0 }
}

#[test]
fn every_engine_steps_every_scene_with_all_its_bodies() {
    // The largest pile-up is made by the same lines as the one before it.
    for name in Name::value_variants().iter().filter(|name| **name != Name::Pileup100000) {
        let scene = name.scene();
        for engine in USUAL {
            let mut world = engine.start(&scene, &How::usual(1)).expect("a scene");
            let start = motions(&*world, &scene);
            (0..3).for_each(|_| world.step());
            let end = motions(&*world, &scene);
            assert_eq!(world.bodies(), scene.bodies.len(), "{name:?} {engine:?}");
            let verdict = judge(&scene, &start, &end);
            assert!(verdict.deepest.is_some_and(|depth| depth < 0.5), "{name:?} {engine:?}: {verdict:?}");
            assert_eq!(verdict.energy_drift.is_none(), scene.is_driven(), "{name:?} {engine:?}");
        }
    }
}

#[test]
fn bodies_start_where_the_scene_has_them_under_every_engine() {
    let scene = Name::Pileup100.scene();
    for engine in USUAL {
        let world = engine.start(&scene, &How::usual(1)).expect("a scene");
        let tolerance = if engine.precision() == "f64" { 1e-12 } else { 1e-5 };
        for (body, found) in scene.bodies.iter().zip(motions(&*world, &scene)) {
            let turn = libm::remainder(found.angle - body.angle, std::f64::consts::TAU);
            let off = [found.at[0] - body.at[0], found.at[1] - body.at[1], turn, found.velocity[0] - body.velocity[0]];
            assert!(off.iter().all(|off| off.abs() <= tolerance), "{engine:?}: {off:?}");
        }
    }
}

#[test]
fn a_driven_body_turns_as_it_was_told_under_every_engine() {
    let scene = Name::Tumbler.scene();
    for engine in USUAL {
        let mut world = engine.start(&scene, &How::usual(1)).expect("a scene");
        (0..60).for_each(|_| world.step());
        let off = world.motion(0).angle - 25.0_f64.to_radians();
        assert!(off.abs() < 2e-4, "{engine:?}: {off}");
    }
}

#[test]
fn overlap_is_measured_as_it_can_be_seen_in_a_pose_made_by_hand() {
    let mut scene = Scene::new(1, Judge::Nothing);
    scene.bodies.push(Body::new(Role::Fixed, [0.0, -1.0], [10.0, 1.0]));
    scene.bodies.push(Body::new(Role::Mobile, [0.0, 0.5], [0.5, 0.5]));
    let depth = |pose: Motion| deepest(&scene, &[still([0.0, -1.0], 0.0), pose]).expect("finite poses");
    assert_eq!(depth(still([0.0, 0.5], 0.0)), 0.0);
    assert!((depth(still([0.0, 0.25], 0.0)) - 0.25).abs() < 1e-15);
    // On its corner a unit square reaches √½ below its middle.
    let corner = depth(still([3.0, 0.5], std::f64::consts::FRAC_PI_4));
    assert!((corner - (libm::sqrt(0.5) - 0.5)).abs() < 1e-12, "{corner}");
    assert_eq!(depth(still([0.0, 40.0], 0.0)), 0.0);
}

#[test]
fn momenta_and_energy_are_those_of_mechanics() {
    let mut scene = Scene::new(1, Judge::Momenta { striker: 0 });
    let mut striker = Body::new(Role::Mobile, [0.0, 0.0], [1.0, 1.0]);
    striker.velocity = [3.0, 0.0];
    scene.bodies.push(striker);
    let start = Motion { velocity: [3.0, 0.0], ..still([0.0, 0.0], 0.0) };
    // Half the momentum is gone: 6 of 12. Moment of inertia 4·(1 + 1)/3.
    let end = Motion { velocity: [1.5, 0.0], ..start };
    let verdict = judge(&scene, &[start], &[end]);
    assert_eq!(verdict.shape_error, Some(0.5));
    assert_eq!(verdict.energy_drift, Some(-0.75));
    let spinning = Motion { spin: 1.0, ..start };
    let turned = judge(&scene, &[start], &[spinning]).shape_error.expect("an error");
    assert!((turned - 8.0 / 3.0 / 12.0).abs() < 1e-15, "{turned}");
}
