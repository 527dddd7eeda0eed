//! A scene played with a method, and what it came to.

use std::time::Duration;

use choque_engine::area::Vec2;

use crate::contact::Contact;
use crate::detect;
use crate::method::Method;
use crate::scenes::{DT, Known, Scene};
use crate::world::World;

/// What a run came to.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome {
    /// How far the last body is from where it should be (or its apex, or its way), m.
    pub(crate) error: f64,
    /// The greatest distance of any body from where it should be, m.
    pub(crate) shape: f64,
    /// The greatest difference between a body and its mirror image, m or rad.
    pub(crate) asymmetry: f64,
    /// The deepest overlap, m.
    pub(crate) deepest: f64,
    /// The greatest rise of the energy above what it was at first, J.
    pub(crate) gained: f64,
    /// Of the fastest body at the end, m/s.
    pub(crate) speed: f64,
    /// Passes over all contacts, a step.
    pub(crate) passes: f64,
    /// Rounds of the finish in all, and the most in a step.
    pub(crate) rounds: usize,
    pub(crate) most_rounds: usize,
    /// What a solve left undone at most, m/s.
    pub(crate) residual: f64,
    /// Time in the method (contacts come from outside), ms a step.
    pub(crate) ms: f64,
}

/// Plays it.
pub(crate) fn play(scene: &Scene, method: &mut dyn Method) -> Outcome {
    let mut world = scene.world.clone();
    let mut contacts: Vec<Contact> = Vec::new();
    let (mut result, mut visits, mut seen) = (Outcome::default(), 0, 0);
    let mut time = Duration::ZERO;
    let energy = world.energy();
    let mut apex = Apex::default();
    for _ in 0..scene.steps {
        contacts = detect::contacts(&world, &contacts, DT);
        result.deepest = result.deepest.max(deepest(&contacts));
        let before = choque::clock::cpu();
        let told = method.step(&mut world, &mut contacts, DT);
        time += choque::clock::cpu() - before;
        visits += told.visits;
        seen += contacts.len();
        result.rounds += told.rounds;
        result.most_rounds = result.most_rounds.max(told.rounds);
        result.residual = result.residual.max(told.residual);
        result.gained = result.gained.max(world.energy() - energy);
        apex.see(&world);
    }
    result.deepest = result.deepest.max(deepest(&detect::contacts(&world, &[], DT)));
    result.passes = visits as f64 / seen.max(1) as f64;
    result.ms = 1e3 * time.as_secs_f64() / scene.steps as f64;
    result.speed = world.bodies.iter().filter(|body| body.is_mobile()).map(|body| body.fastest()).fold(0.0, f64::max);
    judge(&mut result, scene, &world, apex.high);
    result
}

/// The first rise of the last body after its first fall.
#[derive(Default)]
struct Apex {
    low: f64,
    falls: bool,
    high: f64,
    over: bool,
}

impl Apex {
    fn see(&mut self, world: &World) {
        let body = &world.bodies[world.bodies.len() - 1];
        let height = body.x.y - body.half.y;
        if body.v.y < -1.0 {
            self.over |= self.low > 0.0;
            self.falls = true;
        } else if self.falls && !self.over {
            // The top between two steps, as the motion has it.
            let top = if body.v.y > 0.0 { height + body.v.y * body.v.y / (-2.0 * world.gravity) } else { height };
            self.high = self.high.max(top);
            self.low = 1.0;
        }
    }
}

/// The deepest overlap of contacts as they were found, m.
fn deepest(contacts: &[Contact]) -> f64 {
    contacts.iter().flat_map(|contact| &contact.points).fold(0.0, |deepest, point| deepest.max(-point.found))
}

fn judge(result: &mut Outcome, scene: &Scene, world: &World, apex: f64) {
    let start = &scene.world.bodies;
    let off = |body: usize| (world.bodies[body].x - start[body].x).norm();
    let last = start.len() - 1;
    let stands = match &scene.known {
        Known::Apex(_) | Known::Moves(_) => 1..last,
        _ => 1..start.len(),
    };
    result.shape = stands.map(off).fold(0.0, f64::max);
    result.error = match &scene.known {
        Known::Stands(images) => {
            result.asymmetry = asymmetry(world, images);
            off(last)
        }
        Known::Sinks(height, images) => {
            result.asymmetry = asymmetry(world, images);
            result.shape = 0.0;
            (world.bodies[last].x - start[last].x + Vec2::new(0.0, *height)).norm()
        }
        Known::Apex(height) => (apex - height).abs(),
        Known::Moves(way) => (off(last) - way).abs(),
        Known::Stays => {
            result.shape = 0.0;
            world.bodies[4..].iter().map(|body| (body.x - Vec2::new(0.0, 10.0)).norm() - 14.0).fold(0.0, f64::max)
        }
    };
}

/// The greatest difference between bodies and their images about x = 0.
fn asymmetry(world: &World, images: &[(usize, usize)]) -> f64 {
    let differs = |(one, two): &(usize, usize)| {
        let (a, b) = (&world.bodies[*one], &world.bodies[*two]);
        Vec2::new(a.x.x + b.x.x, a.x.y - b.x.y).norm().max((a.angle + b.angle).abs())
    };
    images.iter().map(differs).fold(0.0, f64::max)
}
