//! The document's model, held to worked values, to its formulas, and to itself.

mod collisions;
mod impacts;
mod laws;
mod needs;
mod overlaps;
mod random_scenes;
mod refusals;
mod touches;
mod worked;

use choque_engine::scene::{Body, Kind, Part, Scene};
use choque_engine::{Rect, World};

/// A body with one centred rectangle.
fn body(name: &str, kind: Kind, width: f64, depth: f64) -> Body {
    let mut body = Body::new(name, kind);
    body.parts.push(Part::Rect(Rect::centred(width, depth)));
    body
}

/// A scene of these bodies with the default settings.
fn scene(bodies: Vec<Body>) -> Scene {
    Scene { bodies, ..Scene::default() }
}

/// The scene's world after so many steps.
fn after(scene: &Scene, steps: u32) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    (0..steps).for_each(|_| world.step());
    world
}
