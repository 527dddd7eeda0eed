//! Totals of a world: energy, momenta, and the digest over every bit.

use crate::area::Vec2;
use crate::bodies::Role;
use crate::world::World;

impl World {
    /// Kinetic energy of the mobile bodies \[J\].
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        self.sum_over_mobile(0.0, |sum, i| {
            let (motion, inertia) = (self.motion_now(i), self.bodies.inertia[i]);
            sum + 0.5 * (inertia.mass * motion.v.dot(&motion.v) + inertia.moment * motion.omega * motion.omega)
        })
    }

    /// Linear momentum of the mobile bodies \[kg·m/s\].
    #[must_use]
    pub fn momentum(&self) -> Vec2 {
        self.sum_over_mobile(Vec2::zeros(), |sum, i| sum + self.motion_now(i).v * self.bodies.inertia[i].mass)
    }

    /// Angular momentum of the mobile bodies about the world's origin \[kg·m²/s\].
    #[must_use]
    pub fn angular_momentum(&self) -> f64 {
        self.sum_over_mobile(0.0, |sum, i| {
            let (motion, inertia) = (self.motion_now(i), self.bodies.inertia[i]);
            let frame = self.path_now(i).map_or(self.bodies.frame[i], |path| path.frame);
            let o = frame.o + self.plan.origin;
            let orbital = inertia.mass * (o.x * motion.v.y - o.y * motion.v.x);
            sum + (orbital + inertia.moment * motion.omega)
        })
    }

    fn sum_over_mobile<T>(&self, zero: T, add: impl Fn(T, usize) -> T) -> T {
        self.movers.mobile.iter().fold(zero, |sum, i| add(sum, *i as usize))
    }

    /// A digest over every bit that decides how the world goes on: equal digests, equal futures.
    #[must_use]
    pub fn digest(&self) -> u64 {
        let mut digest = Digest::new();
        digest.word(self.iteration);
        digest.word(self.advances);
        digest.vec2(self.plan.origin);
        for i in 0..self.bodies.len() {
            let (frame, motion, angle) = (self.bodies.frame[i], self.bodies.motion[i], self.bodies.angle[i]);
            digest.vec2(frame.o);
            digest.vec2(self.bodies.lost[i]);
            digest.number(angle.value);
            digest.number(angle.lost);
            digest.vec2(motion.v);
            digest.number(motion.omega);
            digest.word(match self.bodies.role[i] {
                Role::Mobile => 0,
                Role::FixedWithPhysics => 1,
                Role::Fixed => 2,
            });
        }
        for word in self.continuous.iter().flat_map(|state| state.words()) {
            digest.word(word);
        }
        for word in self.contacts.iter().flat_map(|contacts| contacts.words()) {
            digest.word(word);
        }
        for word in self.sides.words() {
            digest.word(word);
        }
        digest.0
    }
}

/// FNV-1a over 64-bit words, each followed by a fold of the high half so that no bit stays in place.
struct Digest(u64);

impl Digest {
    fn new() -> Self {
        Digest(0xcbf2_9ce4_8422_2325)
    }

    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 ^= self.0 >> 32;
    }

    /// A number's bits; −0 counts as 0, for no further result can tell them apart.
    fn number(&mut self, number: f64) {
        self.word((number + 0.0).to_bits());
    }

    fn vec2(&mut self, v: Vec2) {
        self.number(v.x);
        self.number(v.y);
    }
}
