//! Which bodies of a large scene are worth a line: those with a tag, and the extremes.

use choque_engine::scene::{Kind, Scene};
use choque_engine::{BodyId, World};

/// Up to this many bodies a scene is told in full.
pub const TOLD_IN_FULL: usize = 64;

/// The bodies worth a line, in order of creation.
#[derive(Clone, Debug, PartialEq)]
pub struct Notable {
    /// All bodies of a small scene; of a large one those with a tag, 64 at most.
    pub bodies: Vec<BodyId>,
    /// Of a large scene: which body is the furthest, the fastest and so on.
    pub extremes: Vec<Extreme>,
    /// How many bodies are not among `bodies`.
    pub untold: usize,
}

/// The body in which some quantity is greatest or least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Which: `least x`, `fastest`.
    pub what: &'static str,
    /// The body; the first-created of equals.
    pub body: BodyId,
    /// The quantity \[m, m/s or rad/s\].
    pub value: f64,
}

/// Picks the bodies worth a line.
#[must_use]
pub fn notable(scene: &Scene, world: &World) -> Notable {
    if world.len() <= TOLD_IN_FULL {
        return Notable { bodies: world.ids().collect(), extremes: Vec::new(), untold: 0 };
    }
    let tagged = world.ids().zip(&scene.bodies).filter(|(_, body)| !body.tags.is_empty());
    let bodies: Vec<BodyId> = tagged.map(|(id, _)| id).take(TOLD_IN_FULL).collect();
    Notable { untold: world.len() - bodies.len(), bodies, extremes: extremes(world) }
}

/// The extremes among the mobile bodies, or among all when none is mobile.
fn extremes(world: &World) -> Vec<Extreme> {
    type Measure = fn(&World, BodyId) -> f64;
    let measures: [(&str, f64, Measure); 6] = [
        ("least x", -1.0, |world, id| world.position(id).x),
        ("greatest x", 1.0, |world, id| world.position(id).x),
        ("least z", -1.0, |world, id| world.position(id).y),
        ("greatest z", 1.0, |world, id| world.position(id).y),
        ("fastest", 1.0, |world, id| world.velocity(id).norm()),
        ("greatest spin", 1.0, |world, id| world.spin(id).abs()),
    ];
    let any_mobile = world.ids().any(|id| world.kind(id) == Kind::Mobile);
    let extreme = |(what, sign, measure): (&'static str, f64, Measure)| {
        let candidates = world.ids().filter(|id| !any_mobile || world.kind(*id) == Kind::Mobile);
        let measured = candidates.map(|body| Extreme { what, body, value: measure(world, body) });
        measured.reduce(|best, next| if sign * next.value > sign * best.value { next } else { best })
    };
    measures.into_iter().filter_map(extreme).collect()
}
