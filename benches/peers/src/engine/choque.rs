//! Choque. A pair's friction is the geometric mean of its bodies', its restitution the greater of the two.

use choque_engine::scene::{Body, ExchangeRule, Kind, MotionRule, Part, Settings};
use choque_engine::{BodyId, Rect, SceneError};

use super::How;
use crate::scene::{self, Role, Scene};

/// When collisions are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    /// After each step.
    Stepped,
    /// At the moment of impact.
    Continuous,
}

/// A world of choque's.
pub(super) struct World {
    world: choque_engine::World,
    ids: Vec<BodyId>,
}

impl World {
    pub(super) fn new(scene: &Scene, how: &How, motion: Motion) -> Result<World, SceneError> {
        let mut world = choque_engine::World::new(&described(scene, how, motion))?;
        world.set_threads(how.threads);
        let ids = world.ids().collect();
        Ok(World { world, ids })
    }
}

impl super::World for World {
    fn step(&mut self) {
        self.world.step();
    }

    fn bodies(&self) -> usize {
        self.world.len()
    }

    fn motion(&self, body: usize) -> super::Motion {
        let id = self.ids[body];
        let (at, velocity) = (self.world.position(id), self.world.velocity(id));
        super::Motion {
            at: [at.x, at.y],
            angle: self.world.angle(id),
            velocity: [velocity.x, velocity.y],
            spin: self.world.spin(id),
        }
    }

    fn contacts(&self) -> Option<usize> {
        Some(self.world.loads().len())
    }
}

/// The scene in choque's own terms.
fn described(scene: &Scene, how: &How, motion: Motion) -> choque_engine::Scene {
    let settings = Settings {
        time_step: how.time_step,
        substeps: (motion == Motion::Stepped).then_some(how.substeps),
        sleeping: motion == Motion::Stepped && scene.sleeping,
        exchange: ExchangeRule::Impulse,
        motion: match motion {
            Motion::Stepped => MotionRule::Stepped,
            Motion::Continuous => MotionRule::Continuous,
        },
        gravity: (scene.gravity[0], scene.gravity[1]),
        drag: (scene.drag, 0.0),
        ..Settings::default()
    };
    let bodies = scene.bodies.iter().enumerate().map(|(i, body)| told(i, body)).collect();
    choque_engine::Scene { settings, bodies, ..choque_engine::Scene::default() }
}

fn told(i: usize, body: &scene::Body) -> Body {
    let kind = if body.role == Role::Mobile { Kind::Mobile } else { Kind::Fixed };
    let moves = body.role != Role::Fixed;
    let rect = |rect: &scene::Rect| {
        let [x, z] = [0, 1].map(|axis| [rect.at[axis] - rect.half[axis], rect.at[axis] + rect.half[axis]]);
        Part::Rect(Rect { x_min: x[0], x_max: x[1], z_min: z[0], z_max: z[1] })
    };
    Body {
        parts: body.rects.iter().map(rect).collect(),
        at: (body.at[0], body.at[1]),
        angle: body.angle,
        velocity: moves.then_some((body.velocity[0], body.velocity[1])),
        spin: moves.then_some(body.spin),
        mass: Some(body.mass()),
        inertia: Some(body.inertia()),
        restitution: Some(body.restitution),
        friction: Some(body.friction),
        ..Body::new(i.to_string(), kind)
    }
}

/// The deepest overlap of a scene's bodies that can collide when they stand so \[m\]: one measure for all engines, choque's own by separating
/// axes.
///
/// # Errors
/// Poses that are not finite.
pub fn deepest(scene: &Scene, poses: &[super::Motion]) -> Result<f64, SceneError> {
    let mut posed = scene.clone();
    for (body, pose) in posed.bodies.iter_mut().zip(poses) {
        (body.at, body.angle) = (pose.at, pose.angle);
    }
    let world = choque_engine::World::new(&described(&posed, &How::usual(1), Motion::Stepped))?;
    Ok(world.deepest())
}
