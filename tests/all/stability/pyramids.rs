//! Pyramids of squares that start in exact contact: how far their tops sink, and whether left and right stay the same.

use choque_engine::World;

use super::kit::{State, brick, ground, pyramid, run, standing, state, wall};

/// How far the top may be from where it started \[m\], whatever the size.
const TOP: f64 = 0.1;
/// How far a box may be from its mirror image's \[m, rad\].
const MIRRORED: f64 = 1e-9;

/// The large pyramid of that base after those steps.
fn large(base: usize, steps: u32) -> World {
    let mut bodies = vec![ground(base as f64)];
    bodies.extend(pyramid("box", base, 1.0, (0.0, 0.0), 1.0));
    run(&standing(bodies), steps)
}

fn assert_top_stands(world: &World, pyramid: &str, base: usize, x: f64, z: f64) {
    let top = state(world, &brick(pyramid, base - 1, 0));
    let sunk = z + base as f64 - 0.5 - top.z;
    assert!(sunk.abs() <= TOP && (top.x - x).abs() <= TOP, "the top sank by {sunk} and went {} aside", top.x - x);
}

fn assert_mirrored(world: &World, base: usize) {
    let mut worst = 0.0_f64;
    for row in 0..base {
        for place in 0..base - row {
            let here = state(world, &brick("box", row, place));
            let there = state(world, &brick("box", row, base - 1 - row - place)).mirrored();
            worst = worst.max(apart(here, there));
        }
    }
    assert!(worst <= MIRRORED, "a box and its mirror image are {worst:e} apart");
}

fn apart(a: State, b: State) -> f64 {
    (a.x - b.x).abs().max((a.z - b.z).abs()).max((a.angle - b.angle).abs())
}

fn the_top_stands_over_the_middle(base: usize, steps: u32) {
    assert_top_stands(&large(base, steps), "box", base, 0.0, 0.0);
}

fn left_and_right_are_mirror_images(base: usize, steps: u32) {
    assert_mirrored(&large(base, steps), base);
}

#[test]
fn a_pyramid_stands() {
    the_top_stands_over_the_middle(30, 120);
}

#[test]
fn a_pyramid_keeps_its_symmetry() {
    left_and_right_are_mirror_images(20, 200);
}

#[test]
#[ignore = "5,050 boxes, 500 steps"]
fn the_large_pyramid_stands() {
    the_top_stands_over_the_middle(100, 500);
}

#[test]
#[ignore = "5,050 boxes, 500 steps"]
fn the_large_pyramid_keeps_its_symmetry() {
    left_and_right_are_mirror_images(100, 500);
}

/// Side by side and floor above floor, none feels the others: each stands, and all stand alike.
fn many_stand(rows: usize, columns: usize, steps: u32) {
    const BASE: usize = 10;
    let place = |row: usize, column: usize| (11.0 * column as f64, 11.0 * row as f64);
    let name = |row: usize, column: usize| format!("{row}/{column}/");
    let mut bodies = Vec::new();
    for row in 0..rows {
        let width = 11.0 * columns as f64;
        bodies.push(wall(&format!("floor{row}"), (width, 0.2), (width / 2.0 - 5.5, 11.0 * row as f64 - 0.1)));
    }
    for row in 0..rows {
        for column in 0..columns {
            bodies.extend(pyramid(&name(row, column), BASE, 1.0, place(row, column), 1.0));
        }
    }
    let world = run(&standing(bodies), steps);
    let first = state(&world, &brick(&name(0, 0), BASE - 1, 0));
    for row in 0..rows {
        for column in 0..columns {
            let (x, z) = place(row, column);
            assert_top_stands(&world, &name(row, column), BASE, x, z);
            let top = state(&world, &brick(&name(row, column), BASE - 1, 0));
            let differs = apart(State { x: top.x - x, z: top.z - z, ..top }, first);
            assert!(differs <= MIRRORED, "row {row}, column {column}: {differs:e} from the first");
        }
    }
}

#[test]
fn four_pyramids_stand_alike() {
    many_stand(2, 2, 120);
}

#[test]
#[ignore = "22,000 boxes, 200 steps"]
fn four_hundred_pyramids_stand_alike() {
    many_stand(20, 20, 200);
}
