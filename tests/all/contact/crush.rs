//! T30, and walls that close on fifty cars: what rigid bodies cannot do ends well all the same.

use choque_engine::scene::{Body, Kind};
use choque_engine::{Scene, World};

use super::kit::{DT, Random, block, grounded, resting, state, wall};

/// A crushed block's greatest speed [m/s], where the wall makes 1. Observed: 1.000.
const FLUNG: f64 = 1.01;

/// What is left of overlaps when there is room again, some seconds later [m]: what counts as none. Observed: 1.9e-8.
const RECOVERED: f64 = 4e-8;

/// The same a second later [m]. Observed: 6.4e-6.
const SOON: f64 = 1e-5;

/// A block between a wall and one that closes by `beyond` more than there is room for, and then leaves.
fn crush(gravity: bool, friction: f64, beyond: f64) {
    let left = wall("left", (1.0, 3.0), (-0.5, 1.5));
    let press = Body { velocity: Some((-1.0, 0.0)), ..wall("press", (1.0, 3.0), (2.5, 1.5)) };
    let block = resting("block", (1.0, 1.0), (0.7, if gravity { 0.5 } else { 1.3 }));
    let floor = wall("floor", (20.0, 1.0), (5.0, -0.5));
    let mut scene = grounded(DT, friction, vec![left, press, floor, block]);
    if !gravity {
        scene.settings.gravity = (0.0, 0.0);
    }
    let mut world = World::new(&scene).expect("a valid scene");
    let press = world.find("press").expect("it is there");
    let closing = ((1.0 + beyond) / DT) as u32;
    let mut fastest = 0.0_f64;
    for step in 0..closing + 120 {
        if step == closing {
            world.set_velocity(press, choque_engine::Vec2::new(1.0, 0.0)).expect("finite");
        }
        world.step();
        assert_eq!(world.fault(), None);
        let s = state(&world, "block");
        fastest = fastest.max(libm::hypot(s.vx, s.vz)).max(s.spin.abs());
    }
    let what = format!("gravity {gravity}, μ = {friction}, {beyond} m beyond");
    let s = state(&world, "block");
    println!("T30: {what}: at most {fastest:.3} m/s; now at ({:.4}, {:.4}), overlaps {:e}", s.x, s.z, world.deepest());
    assert!(fastest <= FLUNG, "{what}: {fastest} m/s");
    assert!(world.deepest() <= RECOVERED, "{what}: {:e} m", world.deepest());
    assert!(s.x >= 0.5 - RECOVERED && s.x < 4.0, "{what}: it is between its walls: {s:?}");
}

#[test]
fn t30_a_crushed_block_recovers() {
    for gravity in [false, true] {
        for friction in [0.0, 0.5] {
            for beyond in [0.05, 0.2, 0.4] {
                crush(gravity, friction, beyond);
            }
        }
    }
}

/// A car [m].
const CAR: (f64, f64) = (4.2, 1.8);

/// Half the side of the arena at the start [m], and where the walls turn back: a third more room than the cars need.
const OPEN: f64 = 18.0;

fn closed() -> f64 {
    libm::sqrt(2.2 * 50.0 * CAR.0 * CAR.1) / 2.0
}

/// How deep a car may be pressed in [m]: 1 % of its length, where there is a way out. Observed with seed 1 and a friction of 0.5: 5e-4.
const PRESSED: f64 = 0.01 * CAR.0;

/// The same where there may be none: a straight row of seven is 53 cm longer than the room that is left at the end, which is 6.7 cm at each
/// of its eight contacts if they share it evenly. Observed: 10.2 cm, where a car is wedged out of the row.
const JAMMED: f64 = 0.025 * CAR.0;

/// A car's greatest speed [m/s], where walls make 1. There is no bound for rigid bodies: a row between walls is a toggle, and
/// with a thirty-second of the time step and no guard against jams a car slips out of one at 23 m/s. Observed: 3.6.
const SQUEEZED: f64 = 4.0;

/// Fifty cars headed anywhere between four walls that close at 1 m/s.
fn arena(seed: u64, friction: f64) -> Scene {
    let mut random = Random(seed);
    let out = OPEN + 1.0;
    let walls = [((60.0, 2.0), 0.0, 1.0), ((60.0, 2.0), 0.0, -1.0), ((2.0, 60.0), 1.0, 0.0), ((2.0, 60.0), -1.0, 0.0)];
    let mut bodies: Vec<Body> = walls
        .into_iter()
        .enumerate()
        .map(|(k, (size, x, z))| Body {
            velocity: Some((-x, -z)),
            ..wall(&format!("wall{k}"), size, (x * out, z * out))
        })
        .collect();
    for k in 0..50_u32 {
        let at = ((f64::from(k % 7) - 3.0) * 4.8, (f64::from(k / 7) - 3.5) * 4.4);
        let car = block(&format!("car{k}"), CAR, at, (0.0, 0.0), 1200.0);
        bodies.push(Body { angle: random.between(-0.9, 0.9), ..car });
    }
    let mut scene = grounded(DT, friction, bodies);
    scene.settings.gravity = (0.0, 0.0);
    scene.settings.drag = (1.0, 1.0);
    scene.settings.restitution = 0.1;
    scene
}

/// Lets the walls close and open again; gives how deep cars are pressed in at most, and what is left of it [m].
fn close_and_open(seed: u64, friction: f64, steps_open: u32) -> (f64, f64) {
    let mut world = World::new(&arena(seed, friction)).expect("a valid scene");
    let closing = ((OPEN - closed()) / DT) as u32;
    let cars: Vec<_> = world.ids().filter(|id| world.kind(*id) == Kind::Mobile).collect();
    let (mut deepest, mut fastest) = (0.0_f64, 0.0_f64);
    for step in 0..closing + steps_open {
        if step == closing {
            for id in world.ids().take(4) {
                let back = -world.velocity(id);
                world.set_velocity(id, back).expect("finite");
            }
        }
        world.step();
        assert_eq!(world.fault(), None);
        deepest = deepest.max(world.deepest());
        fastest = cars.iter().map(|id| world.velocity(*id).norm()).fold(fastest, f64::max);
    }
    let what = format!("seed {seed}, μ = {friction}");
    println!("fifty cars, {what}: {deepest:.4} m deep at most, {fastest:.2} m/s, left {:e}", world.deepest());
    assert!(fastest <= SQUEEZED, "{what}: {fastest} m/s");
    let room = world.position(world.ids().next().expect("a wall")).y - 1.0;
    for id in cars {
        let at = world.position(id);
        assert!(at.x.abs() < room && at.y.abs() < room, "{what}: {} is at {at:?}", world.name(id));
    }
    (deepest, world.deepest())
}

#[test]
#[cfg_attr(debug_assertions, ignore = "fifty cars: ten seconds in debug")]
fn walls_close_on_fifty_cars_and_let_them_go() {
    let (deepest, left) = close_and_open(1, 0.5, 60);
    assert!(deepest <= PRESSED, "{deepest} m");
    assert!(left <= SOON, "{left:e} m left");
}

#[test]
#[cfg_attr(debug_assertions, ignore = "fifty cars, twelve times: minutes in debug")]
fn walls_close_on_fifty_cars_of_any_heading() {
    for seed in 0..6 {
        for friction in [0.0, 0.7] {
            let (deepest, left) = close_and_open(seed, friction, 420);
            assert!(deepest <= JAMMED, "seed {seed}, μ = {friction}: {deepest} m");
            assert!(left <= RECOVERED, "seed {seed}, μ = {friction}: {left:e} m left");
        }
    }
}
