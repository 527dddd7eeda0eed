//! The field of cars that all speed figures are taken on.

use std::f64::consts::TAU;

use choque_engine::Rect;
use choque_engine::scene::{Body, BroadPhaseChoice, Kind, Part, Scene, Settings};

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    /// From 0 up to 1.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// `count` boxes of 2 × 1 m on a jittered grid that they fill to 30 %, at any angle, with speeds to 10 m/s and
/// spins to ±2 rad/s, between four walls.
pub(crate) fn arena(count: usize, broad_phase: BroadPhaseChoice) -> Scene {
    let side = (count as f64).sqrt().ceil() as usize;
    let cell = (2.0_f64 / 0.3).sqrt();
    let length = cell * side as f64;
    let mut random = Random(12345);
    let mut bodies: Vec<Body> = walls(length).into();
    for i in 0..count {
        let mut body = rectangle(format!("box{i}"), Kind::Mobile, 2.0, 1.0);
        let mut place = |cell_index: usize| (cell_index as f64 + 0.5) * cell + (random.unit() - 0.5) * 0.3;
        body.at = (place(i % side), place(i / side));
        body.angle = random.unit() * TAU;
        let (speed, heading) = (random.unit() * 10.0, random.unit() * TAU);
        body.velocity = Some((speed * libm::cos(heading), speed * libm::sin(heading)));
        body.spin = Some((random.unit() - 0.5) * 4.0);
        bodies.push(body);
    }
    Scene { settings: Settings { broad_phase, ..Settings::default() }, bodies, ..Scene::default() }
}

fn walls(length: f64) -> [Body; 4] {
    let middle = 0.5 * length;
    [
        ("south", middle, -1.0, length + 4.0, 2.0),
        ("north", middle, length + 1.0, length + 4.0, 2.0),
        ("west", -1.0, middle, 2.0, length),
        ("east", length + 1.0, middle, 2.0, length),
    ]
    .map(|(name, x, z, width, depth)| {
        let mut wall = rectangle(name.to_owned(), Kind::Fixed, width, depth);
        wall.at = (x, z);
        wall
    })
}

pub(crate) fn rectangle(name: String, kind: Kind, width: f64, depth: f64) -> Body {
    let mut body = Body::new(name, kind);
    body.parts.push(Part::Rect(Rect::centred(width, depth)));
    body
}
