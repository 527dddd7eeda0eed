//! Small scenes made by hand, and worlds run to an end.

use std::error::Error;

use choque_engine::scene::{Body, Detection, ExchangeRule, Kind, MotionRule, Part, Settings};
use choque_engine::{Rect, Scene, World};

/// A choice of model.
#[derive(Clone, Copy)]
pub(crate) struct Model {
    pub(crate) exchange: ExchangeRule,
    pub(crate) detection: Detection,
    pub(crate) motion: MotionRule,
    pub(crate) restitution: f64,
}

/// The document's own.
pub(crate) const DOCUMENT: Model = Model {
    exchange: ExchangeRule::Document,
    detection: Detection::Vertices,
    motion: MotionRule::Stepped,
    restitution: 1.0,
};
/// Impulses that lose nothing.
pub(crate) const IMPULSE: Model = Model { exchange: ExchangeRule::Impulse, detection: Detection::Complete, ..DOCUMENT };

impl Model {
    pub(crate) fn settings(self, time_step: f64) -> Settings {
        Settings {
            time_step,
            exchange: self.exchange,
            detection: Some(self.detection),
            motion: self.motion,
            restitution: self.restitution,
            ..Settings::default()
        }
    }
}

/// A body with one centred rectangle.
pub(crate) fn body(name: &str, kind: Kind, [width, depth]: [f64; 2], at: (f64, f64)) -> Body {
    let mut body = Body::new(name, kind);
    body.parts.push(Part::Rect(Rect::centred(width, depth)));
    body.at = at;
    body
}

/// A body that moves.
pub(crate) fn moving(name: &str, size: [f64; 2], at: (f64, f64), velocity: (f64, f64)) -> Body {
    Body { velocity: Some(velocity), ..body(name, Kind::Mobile, size, at) }
}

/// The world of a scene after so many iterations, or when something says so.
pub(crate) fn run(
    settings: Settings,
    bodies: Vec<Body>,
    steps: u64,
    until: impl Fn(&World) -> bool,
) -> Result<World, Box<dyn Error>> {
    let mut world = World::new(&Scene { settings, bodies, ..Scene::default() })?;
    for _ in 0..steps {
        if until(&world) {
            break;
        }
        world.step();
    }
    match world.fault() {
        Some(fault) => Err(fault.to_string().into()),
        None => Ok(world),
    }
}
