//! A heavy box hits a block of many.

use super::{Body, Judge, Role, Scene};

/// A box of 8 m at 40 m/s, eight times as dense, hits so many columns and rows of boxes that touch and sleep. No gravity: all forces
/// are inner ones, so linear and angular momentum should be kept.
#[must_use]
pub fn smash([columns, rows]: [usize; 2]) -> Scene {
    const SIDE: f64 = 0.4;
    let mut scene = Scene::new(300, Judge::Momenta { striker: 0 });
    scene.gravity = [0.0, 0.0];
    scene.sleeping = true;
    let mut striker = Body::new(Role::Mobile, [-20.0, 0.0], [4.0, 4.0]);
    striker.velocity = [40.0, 0.0];
    striker.density = 8.0;
    scene.bodies.push(striker);
    for column in 0..columns {
        for row in 0..rows {
            let at = [SIDE * column as f64 + 30.0, SIDE * (row as f64 - 0.5 * rows as f64)];
            let mut body = Body::new(Role::Mobile, at, [0.5 * SIDE, 0.5 * SIDE]);
            body.asleep = true;
            scene.bodies.push(body);
        }
    }
    scene
}
