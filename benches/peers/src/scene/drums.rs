//! Drums that turn, and carry boxes up until they tumble.

use super::{Body, Judge, Rect, Role, Scene};

/// Where a drum's axis is \[m\].
const AXIS: [f64; 2] = [0.0, 10.0];

/// A square drum of four walls that turns at 25 degrees a second, `half` the side of its inside and `thickness` that of its walls.
/// The walls end where their middles meet.
fn drum(half: f64, thickness: f64) -> Body {
    let middle = half + 0.5 * thickness;
    let (upright, level) = ([0.5 * thickness, middle], [middle, 0.5 * thickness]);
    let mut drum = Body::new(Role::Driven, AXIS, upright);
    drum.spin = 25.0_f64.to_radians();
    drum.rects = vec![
        Rect { half: upright, at: [middle, 0.0] },
        Rect { half: upright, at: [-middle, 0.0] },
        Rect { half: level, at: [0.0, middle] },
        Rect { half: level, at: [0.0, -middle] },
    ];
    drum
}

/// A square grid of boxes about a place.
fn grid(scene: &mut Scene, count: usize, half: f64, pitch: f64, first: [f64; 2]) {
    for row in 0..count {
        for column in 0..count {
            let at = [first[0] + pitch * column as f64, first[1] + pitch * row as f64];
            scene.bodies.push(Body::new(Role::Mobile, at, [half, half]));
        }
    }
}

/// 45 × 45 boxes in a drum of 19 m. Box2D's own drum is moved by a motor; here it turns as it was told.
pub(super) fn tumbler() -> Scene {
    let mut scene = Scene::new(750, Judge::Inside { drum: 0, half: 9.5 });
    scene.sleeping = true;
    scene.bodies.push(drum(9.5, 1.0));
    grid(&mut scene, 45, 0.125, 0.4, [-9.0, 1.0]);
    scene
}

/// 90 × 90 small boxes in a drum of 32 m with a paddle at the middle of each wall. Box2D's drum is round.
pub(super) fn washer() -> Scene {
    const HALF: f64 = 16.0;
    const COUNT: usize = 90;
    const PITCH: f64 = 0.21;
    let mut scene = Scene::new(500, Judge::Inside { drum: 0, half: HALF });
    scene.sleeping = true;
    let mut drum = drum(HALF, 2.0);
    // So slow that it shows nowhere; it keeps engines from taking the drum for one that is at rest.
    drum.velocity = [0.001, -0.002];
    for side in [-1.0, 1.0] {
        drum.rects.push(Rect { half: [1.0, 0.25], at: [side * (HALF - 1.0), 0.0] });
        drum.rects.push(Rect { half: [0.25, 1.0], at: [0.0, side * (HALF - 1.0)] });
    }
    scene.bodies.push(drum);
    let reach = 0.5 * PITCH * (COUNT - 1) as f64;
    grid(&mut scene, COUNT, 0.1, PITCH, [AXIS[0] - reach, AXIS[1] - reach]);
    scene
}
