//! Cars that fly about at random between four walls.

use std::f64::consts::TAU;

use super::{Body, Judge, Role, Scene};

/// Share of the ground that cars cover.
const FILLING: f64 = 0.3;

/// So many boxes of 2 m × 1 m, each in a cell of its own so that none overlaps at the start, with velocities to 10 m/s and spins to 2 rad/s.
#[must_use]
pub fn pileup(count: usize) -> Scene {
    let row = libm::ceil(libm::sqrt(count as f64)) as usize;
    let cell = libm::sqrt(2.0 / FILLING);
    let side = cell * row as f64;
    let mut scene = Scene::new(if count >= 100_000 { 60 } else { 300 }, Judge::Nothing);
    scene.gravity = [0.0, 0.0];
    scene.drag = 0.1;
    scene.bodies.extend(walls(side));
    let mut random = SplitMix(12_345);
    for i in 0..count {
        scene.bodies.push(car([(i % row) as f64, (i / row) as f64].map(|place| (place + 0.5) * cell), &mut random));
    }
    scene
}

fn walls(side: f64) -> [Body; 4] {
    let half = 0.5 * side;
    [
        ([half, -1.0], [half + 2.0, 1.0]),
        ([half, side + 1.0], [half + 2.0, 1.0]),
        ([-1.0, half], [1.0, half]),
        ([side + 1.0, half], [1.0, half]),
    ]
    .map(|(at, half)| coated(Body::new(Role::Fixed, at, half)))
}

fn car(middle: [f64; 2], random: &mut SplitMix) -> Body {
    let at = middle.map(|place| place + 0.3 * (random.next() - 0.5));
    let mut body = coated(Body::new(Role::Mobile, at, [1.0, 0.5]));
    body.density = 0.5;
    body.angle = TAU * random.next();
    let (speed, (sin, cos)) = (10.0 * random.next(), libm::sincos(TAU * random.next()));
    body.velocity = [speed * cos, speed * sin];
    body.spin = 4.0 * (random.next() - 0.5);
    body
}

fn coated(mut body: Body) -> Body {
    body.friction = 0.3;
    body.restitution = 0.5;
    body
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct SplitMix(u64);

impl SplitMix {
    /// A number from 0 up to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }
}
