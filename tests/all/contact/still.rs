//! What lies still is not searched for again, and is found when something comes to it: every result is the same as if all were looked at
//! anew in every step.

use choque_engine::scene::{Body, BroadPhaseChoice, Part, Patrol};
use choque_engine::{Rect, Scene, Vec2, World};

use super::kit::{DT, block, grounded, resting, wall};

/// A post that nothing comes to. Whoever puts a fixed body somewhere, be it where it stands, has everything looked at anew.
const POST: &str = "post";

fn free(mut bodies: Vec<Body>, (friction, restitution): (f64, f64)) -> Scene {
    bodies.push(wall(POST, (1.0, 1.0), (900.0, 900.0)));
    let mut scene = grounded(DT, friction, bodies);
    scene.settings.gravity = (0.0, 0.0);
    scene.settings.restitution = restitution;
    scene
}

/// Boxes at rest, so far from each other; every seventh of them a cross.
fn field([columns, rows]: [u32; 2], gap: f64) -> Vec<Body> {
    let place = |column: u32, row: u32| ((0.4 + gap) * f64::from(column), (0.4 + gap) * f64::from(row));
    let places = (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row)));
    let lies = |(k, (column, row)): (usize, (u32, u32))| {
        let mut body = Body { mass: Some(0.16), ..resting(&format!("box {k}"), (0.4, 0.4), place(column, row)) };
        if k % 7 == 3 {
            body.parts = vec![Part::Rect(Rect::centred(0.4, 0.1)), Part::Rect(Rect::centred(0.1, 0.4))];
        }
        body
    };
    places.enumerate().map(lies).collect()
}

/// The same, with two in each other, two that touch, one that something drives through, and what hits them: slow and heavy, and fast.
fn stirred(size: [u32; 2], gap: f64) -> Vec<Body> {
    let mut bodies = field(size, gap);
    let mut add = |name: &str, at| bodies.push(resting(name, (0.4, 0.4), at));
    add("in", (-3.0, 6.0));
    add("in it", (-2.7, 6.1));
    add("by", (-3.0, 8.0));
    add("by it", (-2.6, 8.0));
    add("alone", (-3.0, 10.0));
    let sweeps = Patrol { points: vec![(3.0, -6.0)], speed: 9.0 };
    bodies.push(Body { patrol: Some(sweeps), ..wall("blade", (0.3, 1.0), (3.0, 6.0)) });
    bodies.push(block("ram", (1.5, 1.5), (-3.0, 0.5), (12.0, 0.5), 8.0));
    bodies.push(block("dart", (0.1, 0.1), (-40.0, 2.0), (150.0, -1.0), 0.5));
    bodies
}

/// What a user does to it, a step after the other.
fn meddle(world: &mut World, step: u32) {
    let id = |name: &str| world.find(name).expect("it is there");
    let (alone, by, first) = (id("alone"), id("by"), id("box 0"));
    match step {
        6 => world.push(alone, Vec2::new(0.0, -400.0)),
        14 => world.set_velocity(by, Vec2::new(0.2, 0.0)),
        17 => world.set_position(first, Vec2::new(-2.9, 9.9)),
        19 => world.set_angle(first, 0.3),
        _ => Ok(()),
    }
    .expect("they are mobile");
}

/// Holds every step of a scene to one at which all is looked at anew; gives both worlds.
fn assert_as_if_anew(scene: &Scene, steps: u32, meddle: impl Fn(&mut World, u32), what: &str) -> [World; 2] {
    let mut worlds = [0, 1].map(|_| World::new(scene).expect("a valid scene"));
    let post = worlds[1].find(POST).expect("it is there");
    for step in 0..steps {
        let at = worlds[1].position(post);
        worlds[1].set_position(post, at).expect("it stands there");
        let hits = worlds.each_mut().map(|world| {
            meddle(world, step);
            let mut hits = Vec::new();
            world.begin();
            while let Some(hit) = world.treat_next() {
                hits.push(hit);
            }
            world.finish();
            assert_eq!(world.fault(), None);
            hits
        });
        assert_eq!(hits[0], hits[1], "{what}, step {step}");
        assert_eq!(worlds[0].digest(), worlds[1].digest(), "{what}, step {step}");
    }
    worlds
}

#[test]
fn a_field_that_is_hit_moves_as_if_all_were_looked_at_anew() {
    for size in [[4, 3], [9, 8], [30, 25]] {
        for gap in [0.0, 0.001, 0.012, 0.1] {
            for surface in [(0.0, 0.0), (0.5, 0.0), (0.3, 0.5), (0.0, 1.0)] {
                let choices = [BroadPhaseChoice::Strips, BroadPhaseChoice::AllPairs];
                for choice in choices.into_iter().take(if size[0] < 30 { 2 } else { 1 }) {
                    let mut scene = free(stirred(size, gap), surface);
                    scene.settings.broad_phase = choice;
                    let what = format!("{size:?}, gap {gap}, {surface:?}, {choice:?}");
                    let [world, anew] = assert_as_if_anew(&scene, 40, meddle, &what);
                    let [tested, all] = [world, anew].map(|world| world.work().pairs_tested);
                    println!("{what}: {tested} pairs tested, not {all}");
                    assert!(tested < all, "{what}");
                }
            }
        }
    }
}

/// A row of boxes of which each reaches the next within the step: the last leaves in the step in which the first is struck. Slow ones, for
/// their size, and fast ones; a few, and beside so many that the step is solved in one.
#[test]
fn a_row_passes_a_blow_on_within_the_step() {
    for (side, speed, gap) in [(0.4, 4.0, 1e-4), (0.05, 40.0, 1e-4), (0.05, 40.0, 0.004)] {
        for others in [0, 12] {
            let mut bodies = field([others; 2], 0.001);
            bodies.iter_mut().for_each(|body| body.at.1 += 5.0);
            let row = |k: u32| resting(&format!("row {k}"), (side, side), (f64::from(k) * (side + gap), 0.0));
            bodies.extend((0..12).map(row));
            // In the fifth step.
            let from = -side - 4.5 * speed * DT;
            bodies.push(block("first", (side, side), (from, 0.0), (speed, 0.0), 1.0));
            let what = format!("boxes of {side} m, {gap} m apart, at {speed} m/s, beside {}", others * others);
            let scene = free(bodies, (0.0, 1.0));
            let last = |world: &World| world.velocity(world.find("row 11").expect("it is there")).x;
            let [world, _] = assert_as_if_anew(&scene, 4, |_, _| (), &what);
            assert_eq!(last(&world), 0.0, "{what}");
            let [world, anew] = assert_as_if_anew(&scene, 5, |_, _| (), &what);
            println!("{what}: the last leaves at {} m/s", last(&world));
            assert!(last(&world) > 0.1 * speed, "{what}: {}", last(&world));
            assert!((world.momentum().x / speed - 1.0).abs() < 1e-12, "{what}");
            assert!(world.work().bounds < anew.work().bounds, "{what}");
        }
    }
}

/// Once looked at, a field at rest asks for nothing; and what drives past it for itself only.
#[test]
fn a_field_at_rest_is_looked_at_once() {
    let counted = |world: &World| {
        let work = world.work();
        [work.bounds, work.bounds_compared, work.pairs_tested, work.pairs_listed]
    };
    let mut world = World::new(&free(field([30, 30], 0.001), (0.4, 0.2))).expect("a valid scene");
    world.step();
    let once = counted(&world);
    assert!(once[2] > 2_000, "{once:?}: they are near each other");
    for _ in 0..20 {
        world.step();
    }
    assert_eq!(counted(&world), once);

    let mut bodies = field([30, 30], 0.001);
    bodies.push(block("car", (0.4, 0.4), (-2.0, -0.401), (5.0, 0.0), 1.0));
    let mut world = World::new(&free(bodies, (0.4, 0.2))).expect("a valid scene");
    world.step();
    for _ in 0..100 {
        let before = counted(&world);
        world.step();
        let more = [0, 1, 2, 3].map(|k| counted(&world)[k] - before[k]);
        assert!(more[0] == 1 && more[1] <= 20 && more[2] <= 4 && more[3] == 0, "{more:?}");
    }
    let id = world.find("car").expect("it is there");
    assert_eq!(world.velocity(id), Vec2::new(5.0, 0.0));
}
