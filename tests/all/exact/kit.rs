//! Scenes and runs that the rows share.

use choque_engine::scene::{Body, ExchangeRule, Kind, MotionRule, Part, Settings};
use choque_engine::{Hit, Rect, Scene, World};

/// A mobile body of one centred rectangle.
pub(crate) fn block(name: &str, size: (f64, f64), at: (f64, f64), velocity: (f64, f64), mass: f64) -> Body {
    let mut block = Body::new(name, Kind::Mobile);
    block.parts.push(Part::Rect(Rect::centred(size.0, size.1)));
    Body { at, velocity: Some(velocity), mass: Some(mass), ..block }
}

/// A fixed body of one centred rectangle.
pub(crate) fn wall(name: &str, size: (f64, f64), at: (f64, f64)) -> Body {
    let mut wall = Body::new(name, Kind::Fixed);
    wall.parts.push(Part::Rect(Rect::centred(size.0, size.1)));
    Body { at, ..wall }
}

/// Four walls whose inner faces enclose |x| ≤ `half.0`, |z| ≤ `half.1`.
pub(crate) fn room(half: (f64, f64)) -> Vec<Body> {
    let long = 4.0 * (half.0 + half.1);
    vec![
        wall("+x", (1.0, long), (half.0 + 0.5, 0.0)),
        wall("-x", (1.0, long), (-half.0 - 0.5, 0.0)),
        wall("+y", (long, 1.0), (0.0, half.1 + 0.5)),
        wall("-y", (long, 1.0), (0.0, -half.1 - 0.5)),
    ]
}

/// A scene in continuous motion with the impulse exchange.
pub(crate) fn continuous(restitution: f64, time_step: f64, bodies: Vec<Body>) -> Scene {
    let settings = Settings {
        motion: MotionRule::Continuous,
        exchange: ExchangeRule::Impulse,
        restitution,
        time_step,
        ..Settings::default()
    };
    Scene { settings, bodies, ..Scene::default() }
}

/// The same with gravity along −z.
pub(crate) fn falling(restitution: f64, time_step: f64, bodies: Vec<Body>) -> Scene {
    let mut scene = continuous(restitution, time_step, bodies);
    scene.settings.gravity = (0.0, -9.81);
    scene
}

/// The same scene in stepped motion.
pub(crate) fn stepped(scene: &Scene, time_step: f64) -> Scene {
    let settings = Settings { motion: MotionRule::Stepped, time_step, ..scene.settings.clone() };
    Scene { settings, ..scene.clone() }
}

/// A world that has run, and its hits with their times.
pub(crate) struct Ran {
    pub(crate) world: World,
    pub(crate) hits: Vec<(f64, Hit)>,
}

impl Ran {
    pub(crate) fn times(&self) -> Vec<f64> {
        self.hits.iter().map(|(time, _)| *time).collect()
    }

    /// Times of the hits in which the body of that name took part.
    pub(crate) fn times_of(&self, name: &str) -> Vec<f64> {
        let id = self.world.find(name).expect("it is there");
        self.hits.iter().filter(|(_, hit)| hit.a == id || hit.b == id).map(|(time, _)| *time).collect()
    }
}

/// Runs some steps; `look` sees the world after each hit.
pub(crate) fn run_watching(scene: &Scene, steps: u32, mut look: impl FnMut(&World, &Hit)) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    for _ in 0..steps {
        world.begin();
        while let Some(hit) = world.treat_next() {
            look(&world, &hit);
        }
        world.finish();
        assert_eq!(world.fault(), None);
    }
    world
}

pub(crate) fn run(scene: &Scene, steps: u32) -> Ran {
    let mut hits = Vec::new();
    let world = run_watching(scene, steps, |world, hit| hits.push((world.time(), *hit)));
    Ran { world, hits }
}

/// The world right after its first hit.
pub(crate) fn at_first_hit(scene: &Scene) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    for _ in 0..100_000 {
        world.begin();
        if world.treat_next().is_some() {
            return world;
        }
        world.finish();
    }
    panic!("nothing was hit");
}

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) x: f64,
    pub(crate) z: f64,
    pub(crate) angle: f64,
    pub(crate) vx: f64,
    pub(crate) vz: f64,
    pub(crate) spin: f64,
}

impl State {
    /// Reflected in the z axis.
    pub(crate) fn mirrored(self) -> State {
        State { x: -self.x, angle: -self.angle, vx: -self.vx, spin: -self.spin, ..self }
    }
}

pub(crate) fn state(world: &World, name: &str) -> State {
    let id = world.find(name).expect("it is there");
    let (p, v) = (world.position(id), world.velocity(id));
    State { x: p.x, z: p.y, angle: world.angle(id), vx: v.x, vz: v.y, spin: world.spin(id) }
}

/// The scene reflected in the z axis.
pub(crate) fn mirrored(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.settings.gravity.0 = -scene.settings.gravity.0;
    for body in &mut scene.bodies {
        body.at.0 = -body.at.0;
        body.angle = -body.angle;
        body.velocity = body.velocity.map(|(x, z)| (-x, z));
        body.spin = body.spin.map(|spin| -spin);
        for part in &mut body.parts {
            if let Part::Rect(rect) = part {
                (rect.x_min, rect.x_max) = (-rect.x_max, -rect.x_min);
            }
        }
    }
    scene
}

/// Everywhere x velocities, in order of creation.
pub(crate) fn velocities(world: &World) -> Vec<f64> {
    world.ids().map(|id| world.velocity(id).x).collect()
}

#[track_caller]
pub(crate) fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: {found:?}");
    let worst = worst(found, expected);
    assert!(worst <= tolerance, "{what}: off by {worst:e}: {found:?} instead of {expected:?}");
}

/// Greatest difference; not a number if one is none.
pub(crate) fn worst(found: &[f64], expected: &[f64]) -> f64 {
    found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, |a, b| if b <= a { a } else { b })
}

/// SplitMix64 (Steele, Lea, Flood 2014): all the randomness these tests need.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From `least` up to `greatest`.
    pub(crate) fn between(&mut self, least: f64, greatest: f64) -> f64 {
        least + (greatest - least) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Runs some steps; `look` sees the world after each.
pub(crate) fn watch(scene: &Scene, steps: u32, mut look: impl FnMut(&World)) -> World {
    let mut world = World::new(scene).expect("a valid scene");
    for _ in 0..steps {
        world.step();
        assert_eq!(world.fault(), None);
        look(&world);
    }
    world
}

/// Kinetic and potential energy of the mobile bodies under a gravity along −z [J], the latter from z = 0.
pub(crate) fn energy_under(world: &World, gravity: f64) -> f64 {
    let lifted = world.ids().filter(|id| world.kind(*id) == Kind::Mobile);
    world.kinetic_energy() + lifted.map(|id| world.mass(id) * gravity * world.position(id).y).sum::<f64>()
}
