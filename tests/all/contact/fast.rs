//! What is fast meets what lies in its way, in stepped motion too: from the side, and when it was made fast within the step.

use choque_engine::scene::Body;
use choque_engine::{Scene, Vec2, World};

use super::kit::{DT, Random, block, grounded, wall};

/// Energy that elastic impacts may be off by, as a share. Observed: 3e-16.
const ENERGY_OFF: f64 = 1e-14;

/// Moments of impact that a crowd of 201 may ask for in 20 steps. Observed: 167,000; followed pair after pair to the end it asks for 26 million.
const MOST_SOUGHT: u64 = 300_000;

fn free(bodies: Vec<Body>, restitution: f64, substeps: u32) -> Scene {
    let mut scene = grounded(DT, 0.0, bodies);
    scene.settings.gravity = (0.0, 0.0);
    scene.settings.restitution = restitution;
    scene.settings.substeps = Some(substeps);
    scene
}

/// Small darts at posts that stand at any angle, from any side; none that aims at the middle of one may go on as it came.
fn darts(seed: u64, (count, speed, substeps): (u32, f64, u32)) {
    let mut random = Random(seed);
    let mut bodies = Vec::new();
    let mut ways = Vec::new();
    for k in 0..count {
        let x = 20.0 * f64::from(k);
        let (way, far) = (random.between(0.0, core::f64::consts::TAU), random.between(1.0, 6.0));
        let (s, c) = (libm::sin(way), libm::cos(way));
        let post = wall(&format!("post{k}"), (0.3, 0.3), (x, 0.0));
        bodies.push(Body { angle: random.between(0.0, 1.5), ..post });
        bodies.push(block(&format!("dart{k}"), (0.1, 0.1), (x - far * c, -far * s), (speed * c, speed * s), 1.0));
        ways.push(Vec2::new(c, s) * speed);
    }
    let mut world = World::new(&free(bodies, 1.0, substeps)).expect("a valid scene");
    let before = world.kinetic_energy();
    for _ in 0..libm::ceil(6.0 / speed / DT) as u32 + 1 {
        world.step();
    }
    let passed = (0..count).filter(|k| {
        let dart = world.find(&format!("dart{k}")).expect("it is there");
        world.velocity(dart) == ways[*k as usize]
    });
    let (passed, off) = (passed.count(), world.kinetic_energy() / before - 1.0);
    println!("{count} darts at {speed} m/s, {substeps} sub-steps, seed {seed}: {passed} passed, energy {off:+e}");
    assert_eq!(passed, 0, "{count} darts at {speed} m/s, {substeps} sub-steps, seed {seed}");
    assert!(off.abs() <= ENERGY_OFF, "{off:e}");
}

#[test]
fn darts_meet_posts_from_any_side() {
    for seed in 0..3 {
        for speed in [60.0, 300.0, 2000.0] {
            for substeps in [1, 4] {
                darts(seed, (20, speed, substeps));
                darts(seed, (150, speed, substeps));
            }
        }
    }
}

/// A ball makes a box a hundred times lighter as fast again as it is itself, in front of a thin wall; beside others like it.
fn struck(copies: u32, speed: f64, restitution: f64) {
    let mut bodies = vec![wall("wall", (0.05, 2000.0), (3.0, 0.0))];
    for k in 0..copies {
        let z = f64::from(k);
        bodies.push(block(&format!("ball{k}"), (0.2, 0.2), (-2.0, z), (speed, 0.0), 100.0));
        bodies.push(block(&format!("box{k}"), (0.2, 0.2), (0.0, z), (0.0, 0.0), 1.0));
    }
    let mut world = World::new(&free(bodies, restitution, 4)).expect("a valid scene");
    for _ in 0..4 {
        world.step();
    }
    let what = format!("{copies} at {speed} m/s, e = {restitution}");
    for id in world.ids().skip(1) {
        let at = world.position(id).x;
        assert!(at < 3.0, "{what}: {} is at x = {at}", world.name(id));
    }
    assert_eq!(world.fault(), None);
}

#[test]
fn what_is_struck_meets_the_wall_behind_it() {
    for copies in [1, 3, 40] {
        for speed in [100.0, 600.0] {
            for restitution in [0.0, 0.5, 1.0] {
                struck(copies, speed, restitution);
            }
        }
    }
}

/// Bars that turn by more than half a turn a sub-step hit a block at the first pass.
#[test]
fn a_fast_bar_hits_at_the_first_pass() {
    for fixed in [false, true] {
        let bar = block("bar", (2.0, 0.02), (0.0, 0.0), (0.0, 0.0), 1.0);
        let bar = if fixed { Body { velocity: None, ..wall("bar", (2.0, 0.02), (0.0, 0.0)) } } else { bar };
        let bodies = vec![Body { spin: Some(400.0), ..bar }, block("block", (0.3, 0.3), (0.0, 0.8), (0.0, 0.0), 1.0)];
        let mut world = World::new(&free(bodies, 0.5, 4)).expect("a valid scene");
        world.step();
        let block = world.find("block").expect("it is there");
        assert!(world.velocity(block).norm() > 50.0, "the bar is fixed: {fixed}; {:?}", world.velocity(block));
        assert!(world.deepest() <= 1e-9, "{:e} m deep", world.deepest());
    }
}

/// A heavy box drives into a block of 200: all of them are fast then, and every one touches others.
#[test]
fn a_crowd_of_fast_bodies_costs_what_its_impacts_cost() {
    let mut bodies = vec![block("ram", (2.0, 2.0), (-3.0, 0.0), (40.0, 0.0), 2000.0)];
    for (k, (x, z)) in (0..20).flat_map(|x| (0..10).map(move |z| (x, z))).enumerate() {
        let at = (0.4 * f64::from(x), 0.4 * f64::from(z) - 1.8);
        bodies.push(block(&format!("box{k}"), (0.2, 0.2), at, (0.0, 0.0), 1.0));
    }
    let mut scene = free(bodies, 0.0, 4);
    scene.settings.time_step = 1.0 / 12.0;
    let mut world = World::new(&scene).expect("a valid scene");
    let (began, energy) = (world.momentum(), world.kinetic_energy());
    for _ in 0..20 {
        world.step();
    }
    let sought = world.work().touches_sought;
    let (lost, gained) = ((world.momentum() - began).norm() / began.norm(), world.kinetic_energy() / energy - 1.0);
    println!("{sought} moments of impact sought, momentum off by {lost:e}, energy {gained:+e}");
    assert!(sought < MOST_SOUGHT, "{sought}");
    assert!(lost < 1e-12, "{lost:e}");
    assert!(gained < 0.0, "{gained:e}");
}
