//! Pyramids: boxes that should stay where they stand.

use super::{Body, Judge, Role, Scene};

/// Half a side of every box \[m\].
const HALF: f64 = 0.5;

/// A pyramid of unit boxes, its lowest row centred on `middle`, standing at height `floor`. Gives the place of the top box.
fn pyramid(bodies: &mut Vec<Body>, base: usize, middle: f64, floor: f64) -> usize {
    for row in 0..base {
        let first = middle - HALF * (base - row - 1) as f64;
        let height = floor + HALF * (2 * row + 1) as f64;
        for column in 0..base - row {
            bodies.push(Body::new(Role::Mobile, [first + column as f64, height], [HALF, HALF]));
        }
    }
    bodies.len() - 1
}

/// 100 boxes wide and 100 high. The top box stands at (0, 99.5) and should stay there.
pub(super) fn large_pyramid() -> Scene {
    let mut scene = Scene::new(500, Judge::Nothing);
    scene.bodies.push(Body::new(Role::Fixed, [0.0, -1.0], [100.0, 1.0]));
    let top = pyramid(&mut scene.bodies, 100, 0.0, 0.0);
    scene.judge = Judge::Stay(vec![top]);
    scene
}

/// Twenty floors above each other, twenty pyramids of ten rows on each. A floor is a thin box of its own.
pub(super) fn many_pyramids() -> Scene {
    const FLOORS: usize = 20;
    const BASE: usize = 10;
    /// From the middle of a pyramid to the next, and from floor to floor \[m\].
    const PITCH: f64 = 11.0;
    let half_width = 0.5 * PITCH * FLOORS as f64;
    let mut scene = Scene::new(200, Judge::Nothing);
    for floor in 0..FLOORS {
        let below = PITCH * floor as f64 - 0.1;
        scene.bodies.push(Body::new(Role::Fixed, [0.0, below], [half_width, 0.1]));
    }
    let mut tops = Vec::new();
    for floor in 0..FLOORS {
        for column in 0..FLOORS {
            let middle = -half_width + PITCH * column as f64 + 0.5 * BASE as f64 + 0.5;
            tops.push(pyramid(&mut scene.bodies, BASE, middle, PITCH * floor as f64));
        }
    }
    scene.judge = Judge::Stay(tops);
    scene
}
