//! What contacts carry: told to whoever asks, after a step.

use super::Contacts;
use super::touch::Touch;
use crate::area::Vec2;
use crate::world::{BodyId, World};

/// What one face carried in the last part of the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// The two bodies, the earlier created first.
    pub a: BodyId,
    /// The other.
    pub b: BodyId,
    /// The face's normal, from a to b.
    pub normal: Vec2,
    /// Where they touched \[m\]; twice the same where only one point did.
    pub points: [Vec2; 2],
    /// The force at each of the points, from a on b along the normal \[N\]; never negative.
    pub push: [f64; 2],
    /// The force of friction on b, along the normal turned from +Z to +X \[N\].
    pub friction: f64,
}

impl World {
    /// What each contact that presses carries, in the order of the rectangles it is between. Empty before the first step and in
    /// scenes without lasting contact (other motion or exchange than stepped with impulses).
    #[must_use]
    pub fn loads(&self) -> Vec<Load> {
        let Some(contacts) = &self.contacts else { return Vec::new() };
        let rate = f64::from(contacts.plan.substeps) / self.plan.time_step;
        let pressing = contacts.remembered().filter(|touch| touch.push[0] + touch.push[1] > 0.0);
        pressing.map(|touch| touch.load(self.plan.origin, rate)).collect()
    }
}

impl Contacts {
    /// Whether any touch presses.
    pub(super) fn presses(&self) -> bool {
        self.touches.iter().any(|touch| touch.touching)
    }
}

impl Touch {
    fn load(&self, origin: Vec2, rate: f64) -> Load {
        let along = Vec2::new(self.n.y, -self.n.x);
        let [first, second] = self.lever_a;
        let half = if self.count == 2 { 0.5 * (second - first) } else { 0.0 };
        let middle = self.middle + origin;
        let sign = if self.a < self.b { 1.0 } else { -1.0 };
        Load {
            a: BodyId(self.a.min(self.b)),
            b: BodyId(self.a.max(self.b)),
            normal: self.n * sign,
            points: [middle - along * half, middle + along * half],
            push: self.push.map(|push| push * rate),
            // Turning the normal round turns what lies along it too.
            friction: self.grip * rate,
        }
    }
}
