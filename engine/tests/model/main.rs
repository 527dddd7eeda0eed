//! The document's model, held to worked values, to its formulas, and to itself.

mod booked;
mod booked_contacts;
mod collisions;
mod continuous;
mod crowds;
mod impacts;
mod laws;
mod ledger;
mod needs;
mod overlaps;
mod random_scenes;
mod refusals;
mod threads;
mod touches;
mod worked;

use choque_engine::bodies::{Bodies, Inertia, Motion, Role};
use choque_engine::frame::{Angle, Frame};
use choque_engine::scene::{Body, Kind, Part, Scene};
use choque_engine::{Rect, Vec2, World};

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

/// The columns of bodies that stand at the origin without a rectangle, for a stage tried on its own.
fn columns<const N: usize>(of: [(Role, Inertia, Motion); N]) -> Bodies {
    let mut bodies = Bodies { first_rect: vec![0; N + 1], ..Bodies::default() };
    for (role, inertia, motion) in of {
        bodies.frame.push(Frame::new(Vec2::zeros(), 0.0));
        bodies.lost.push(Vec2::zeros());
        bodies.angle.push(Angle::default());
        bodies.motion.push(motion);
        bodies.role.push(role);
        bodies.inertia.push(inertia);
    }
    bodies
}
