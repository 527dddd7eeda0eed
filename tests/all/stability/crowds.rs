//! Many bodies in little room, or struck at once: momentum is kept, energy stays bounded, nothing is squeezed out.

use choque_engine::World;
use choque_engine::scene::Body;

use super::kit::{block, fastest, floating, run, standing, state, wall, watch};

/// 512 kg at 40 m/s into rows of small boxes: all the momentum there will ever be.
fn smash(columns: usize, rows: usize, steps: u32) {
    const MOMENTUM: f64 = 8.0 * 64.0 * 40.0;
    let mut bodies =
        vec![Body { velocity: Some((40.0, 0.0)), mass: Some(512.0), ..block("hammer", (8.0, 8.0), (-20.0, 0.0)) }];
    for i in 0..columns {
        for j in 0..rows {
            let at = (0.4 * i as f64 + 30.0, 0.4 * (j as f64 - rows as f64 / 2.0));
            bodies.push(block(&format!("box{i}_{j}"), (0.4, 0.4), at));
        }
    }
    let world = watch(&floating(bodies), steps, |world| {
        let off = (world.momentum().x - MOMENTUM).abs().max(world.momentum().y.abs());
        assert!(off <= 1e-12 * MOMENTUM, "{}: momentum off by {off:e}", world.iteration());
    });
    assert!(state(&world, "hammer").vx < 39.0, "the hammer hit nothing");
}

#[test]
fn smashing_keeps_momentum() {
    smash(20, 20, 100);
}

#[test]
#[ignore = "9,601 boxes, 300 steps"]
fn smashing_9600_keeps_momentum() {
    smash(120, 80, 300);
}

/// Boxes poured into a pit stay in it and within 5 % of each other's surface once they lie.
fn barrel(columns: usize, rows: usize, steps: u32) {
    let (half, height) = (columns as f64 / 2.0 + 1.0, 1.2 * rows as f64);
    let mut bodies = vec![
        wall("floor", (2.0 * half + 4.0, 2.0), (0.0, -1.0)),
        wall("left", (2.0, height), (-half - 1.0, height / 2.0)),
        wall("right", (2.0, height), (half + 1.0, height / 2.0)),
    ];
    for column in 0..columns {
        for row in 0..rows {
            // Every row starts 20 cm off the one below, to the left and to the right by turns.
            let aside = if row % 2 == 0 { -0.1 } else { 0.1 };
            let at = (column as f64 * 1.02 - (columns - 1) as f64 * 0.51 + aside, 0.6 + 1.1 * row as f64);
            bodies.push(block(&format!("box{column}_{row}"), (1.0, 1.0), at));
        }
    }
    let world = watch(&standing(bodies), steps, |world| {
        for id in world.ids().skip(3) {
            let at = world.position(id);
            assert!(at.x.abs() < half && at.y > 0.0, "{}: {} is out {at}", world.iteration(), world.name(id));
        }
    });
    assert!(world.deepest() < 0.05, "pressed in by {}", world.deepest());
}

#[test]
fn boxes_poured_into_a_pit_stay_there() {
    barrel(6, 30, 150);
}

#[test]
#[ignore = "3,380 boxes, 300 steps"]
fn boxes_of_130_rows_stay_in_the_pit() {
    barrel(26, 130, 300);
}

/// Squares of more area than their room has: they can never part, and must not gather energy either.
fn confined(count: usize, size: (f64, f64), steps: u32) {
    let (half, pitch) = ((size.0 / 2.0, size.1 / 2.0), 0.72);
    let mut bodies = vec![
        wall("left", (4.0, size.1 + 8.0), (-half.0 - 2.0, 0.0)),
        wall("right", (4.0, size.1 + 8.0), (half.0 + 2.0, 0.0)),
        wall("floor", (size.0, 4.0), (0.0, -half.1 - 2.0)),
        wall("ceiling", (size.0, 4.0), (0.0, half.1 + 2.0)),
    ];
    let middle = pitch * (count - 1) as f64 / 2.0;
    for i in 0..count * count {
        let at = (pitch * (i % count) as f64 - middle, pitch * (i / count) as f64 - middle);
        bodies.push(block(&format!("box{i}"), (1.0, 1.0), at));
    }
    watch(&floating(bodies), steps, |world| {
        // A mean of 3 m/s: the speed at which other engines let overlaps part.
        let most = 4.5 * (count * count) as f64;
        assert!(world.kinetic_energy() < most, "{}: {} J", world.iteration(), world.kinetic_energy());
        assert_in_the_room(world, half);
    });
}

fn assert_in_the_room(world: &World, half: (f64, f64)) {
    for id in world.ids().skip(4) {
        let at = world.position(id);
        assert!(at.x.abs() < half.0 && at.y.abs() < half.1, "{}: {} is out at {at}", world.iteration(), world.name(id));
    }
}

#[test]
fn squares_without_room_stay_calm() {
    confined(10, (8.0, 7.8), 120);
}

#[test]
#[ignore = "625 boxes in 390 m², 600 steps"]
fn squares_of_625_m2_in_390_m2_stay_calm() {
    confined(25, (20.0, 19.5), 600);
}

#[test]
fn a_hundred_at_one_place_part_alike_each_time() {
    let scene = floating((0..100).map(|i| block(&format!("box{i}"), (1.0, 1.0), (0.0, 0.0))).collect());
    let (once, again) = (run(&scene, 60), run(&scene, 60));
    assert_eq!(once.digest(), again.digest());
    assert!(fastest(&once) < 30.0, "{} m/s", fastest(&once));
    assert!(once.deepest() < 1.0, "none has moved");
}
