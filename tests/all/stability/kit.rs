//! Scenes and runs that the suite shares.

use choque_engine::scene::{Body, ExchangeRule, Settings};
use choque_engine::{Scene, World};

pub(super) use crate::exact::kit::{Random, State, energy_under, state, wall, watch};

/// Gravity's pull in all these scenes \[m/s²\].
pub(super) const GRAVITY: f64 = 10.0;

/// A mobile rectangle at rest whose mass is its area.
pub(super) fn block(name: &str, size: (f64, f64), at: (f64, f64)) -> Body {
    crate::exact::kit::block(name, size, at, (0.0, 0.0), size.0 * size.1)
}

/// Level ground, its top at z = 0.
pub(super) fn ground(half_width: f64) -> Body {
    wall("ground", (2.0 * half_width, 2.0), (0.0, -1.0))
}

/// A scene in stepped motion with the impulse exchange: friction 0.6, no restitution, no gravity.
pub(super) fn floating(bodies: Vec<Body>) -> Scene {
    let settings = Settings { exchange: ExchangeRule::Impulse, friction: 0.6, ..Settings::default() };
    Scene { settings, bodies, ..Scene::default() }
}

/// The same under gravity.
pub(super) fn standing(bodies: Vec<Body>) -> Scene {
    let mut scene = floating(bodies);
    scene.settings.gravity = (0.0, -GRAVITY);
    scene
}

/// What a pyramid's box is called: rows count from the ground, places from the left.
pub(super) fn brick(pyramid: &str, row: usize, place: usize) -> String {
    format!("{pyramid}{row}_{place}")
}

/// A pyramid of squares on ground at height `at.1`, its middle at `at.0`; centres `pitch` sides apart along and across.
pub(super) fn pyramid(name: &str, base: usize, side: f64, at: (f64, f64), pitch: f64) -> Vec<Body> {
    let mut bodies = Vec::new();
    for row in 0..base {
        for place in 0..base - row {
            let along = place as f64 - (base - 1 - row) as f64 / 2.0;
            let centre = (at.0 + side * pitch * along, at.1 + side * (0.5 + pitch * row as f64));
            bodies.push(block(&brick(name, row, place), (side, side), centre));
        }
    }
    bodies
}

pub(super) fn run(scene: &Scene, steps: u32) -> World {
    watch(scene, steps, |_| ())
}

/// All mobile bodies' states, in order of creation.
pub(super) fn states(world: &World) -> Vec<State> {
    let mobile = world.ids().filter(|&id| world.kind(id) == choque_engine::scene::Kind::Mobile);
    mobile.map(|id| state(world, world.name(id))).collect()
}

/// The greatest speed of all bodies \[m/s\].
pub(super) fn fastest(world: &World) -> f64 {
    world.ids().map(|id| world.velocity(id).norm()).fold(0.0, f64::max)
}
