//! Square drums that turn and tumble boxes: none may get out.

use choque_engine::scene::{Body, Kind, Part};
use choque_engine::{Rect, Scene};

use super::kit::{block, standing, state, watch};

/// How fast drums turn \[rad/s\]: 25° a second.
const SPIN: f64 = 25.0 * core::f64::consts::PI / 180.0;
/// How far an overlapping box's centre may be beyond the wall's face less half its side, in sides.
const PRESSED_IN: f64 = 0.5;

/// Four walls 1 m thick about a square hole of half width `half`, turning.
fn drum(half: f64, paddles: Option<Rect>) -> Body {
    let mut drum = Body::new("drum", Kind::Fixed);
    let outer = half + 1.0;
    let mut walls = vec![
        Rect { x_min: half, x_max: outer, z_min: -outer, z_max: outer },
        Rect { x_min: -outer, x_max: -half, z_min: -outer, z_max: outer },
        Rect { x_min: -outer, x_max: outer, z_min: half, z_max: outer },
        Rect { x_min: -outer, x_max: outer, z_min: -outer, z_max: -half },
    ];
    if let Some(p) = paddles {
        walls.push(p);
        walls.push(Rect { x_min: -p.x_max, x_max: -p.x_min, ..p });
        walls.push(Rect { x_min: p.z_min, x_max: p.z_max, z_min: p.x_min, z_max: p.x_max });
        walls.push(Rect { x_min: p.z_min, x_max: p.z_max, z_min: -p.x_max, z_max: -p.x_min });
    }
    drum.parts = walls.into_iter().map(Part::Rect).collect();
    Body { at: (0.0, 10.0), spin: Some(SPIN), ..drum }
}

/// Boxes in a grid, the lowest left one at `from`.
fn grid(count: usize, side: f64, from: (f64, f64), pitch: f64) -> impl Iterator<Item = Body> {
    (0..count * count).map(move |i| {
        let (row, column) = ((i / count) as f64, (i % count) as f64);
        block(&format!("box{i}"), (side, side), (from.0 + pitch * column, from.1 + pitch * row))
    })
}

fn assert_none_gets_out(scene: &Scene, half: f64, side: f64, steps: u32) {
    let farthest = half - side * (0.5 - PRESSED_IN);
    watch(scene, steps, |world| {
        let drum = state(world, "drum");
        let (sin, cos) = (libm::sin(drum.angle), libm::cos(drum.angle));
        for id in world.ids().skip(1) {
            let (x, z) = (world.position(id).x - drum.x, world.position(id).y - drum.z);
            let (x, z) = (cos * x + sin * z, cos * z - sin * x);
            assert!(
                x.abs() < farthest && z.abs() < farthest,
                "{}: {} at ({x}, {z})",
                world.iteration(),
                world.name(id)
            );
        }
    });
}

fn tumbler(count: usize, steps: u32) {
    let mut bodies = vec![drum(9.5, None)];
    bodies.extend(grid(count, 0.25, (-9.0, 1.0), 0.4));
    assert_none_gets_out(&standing(bodies), 9.5, 0.25, steps);
}

#[test]
fn none_gets_out_of_a_tumbler() {
    tumbler(15, 200);
}

#[test]
#[ignore = "2,025 boxes, 750 steps"]
fn none_of_2025_gets_out_of_the_tumbler() {
    tumbler(45, 750);
}

/// A washer's drum has a paddle of 2 m on each side and drifts a little, so that nothing in it ever repeats.
fn washer(count: usize, steps: u32) {
    let half = 14.0;
    let paddle = Rect { x_min: half - 2.0, x_max: half, z_min: -0.25, z_max: 0.25 };
    let mut bodies = vec![Body { velocity: Some((0.001, -0.002)), ..drum(half, Some(paddle)) }];
    let pitch = 0.21;
    let from = -pitch * (count as f64 - 1.0) / 2.0;
    bodies.extend(grid(count, 0.2, (from, 10.0 + from), pitch));
    assert_none_gets_out(&standing(bodies), half, 0.2, steps);
}

#[test]
fn none_gets_out_of_a_washer() {
    washer(18, 160);
}

#[test]
#[ignore = "8,100 boxes, 500 steps"]
fn none_of_8100_gets_out_of_the_washer() {
    washer(90, 500);
}
