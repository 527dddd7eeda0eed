//! A touch: two rectangles in contact, or that may come into contact within the step, ready to be solved.
//!
//! ```text
//!            n ^          Velocities at a point, of the owner b against the reference a:
//!              │  b         along n:  u = n·(v_b − v_a) + lever_b ω_b − lever_a ω_a,   lever = r × n
//!       ───∙───┼──∙──> t    along t:  the same with levers r × t, alike for both points of a face
//!              a
//! ```

use super::rows::{SPIN, TURN, VX, VZ, X, Z};
use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::detect::Face;
use crate::detect::manifold::{Manifold, Placed, edge_along};
use crate::detect::near::{Before, meet};
use crate::exchange::impact::Surface;
use crate::frame::{Frame, perp};
use crate::lanes::LANES;

/// A point that is not there: further away than any that is.
pub(super) const FAR: f64 = 1e30;

/// Two rectangles in contact or nearly so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    /// The rectangles by their indices among all, the earlier created first.
    pub(super) rects: (u32, u32),
    /// The bodies: the reference, whose face it is, and the owner.
    pub(super) a: u32,
    pub(super) b: u32,
    /// The face of the reference, and whether that is the first rectangle.
    pub(super) face: Face,
    pub(super) of_first: bool,
    /// From a to b, in the world.
    pub(super) n: Vec2,
    /// Which end of the owner's edge each point is, whole or cut, and how many points there are.
    pub(super) ends: [u8; 2],
    pub(super) count: u8,
    /// Which points are no corners of the owner's but where its edge passes an end of the face: they do not turn with the owner.
    pub(super) cut: [bool; 2],
    /// Gaps at the start of the step, negative where they overlap \[m\].
    pub(super) gap: [f64; 2],
    /// r × n of both points on both bodies, and r × t \[m\].
    pub(super) lever_a: [f64; 2],
    pub(super) lever_b: [f64; 2],
    pub(super) along_a: f64,
    pub(super) along_b: f64,
    /// How far b may slip along t before it leaves the face, backward and forward \[m\].
    pub(super) slip: (f64, f64),
    /// Friction and restitution of the pair.
    pub(super) surface: Surface,
    /// The middle of the points, from the plan's origin \[m\].
    pub(super) middle: Vec2,
    /// Impulses over a sub-step at both points, and along t \[N·s\].
    pub(super) push: [f64; 2],
    pub(super) grip: f64,
    /// Whether an impact without restitution, with nothing to press them together, has met them in this step: what comes of it is
    /// left as it is until the next.
    pub(super) met: bool,
    /// Whether they touched at the end of the last step.
    pub(super) touching: bool,
}

impl Touch {
    /// Two rectangles that may meet within the step, with what they remember of the last.
    pub(super) fn find(
        bodies: &Bodies,
        (one, two): (Placed, Placed),
        margin: f64,
        last: Option<&Touch>,
        earlier: impl Fn(usize) -> Frame,
    ) -> Option<Touch> {
        let before = last.map(|last| Before {
            of_first: last.of_first,
            face: last.face,
            normal: if last.of_first { last.n } else { -last.n },
        });
        let manifold = meet(bodies, (one, two), margin, before.as_ref(), earlier)?;
        let of_first = manifold.reference == one.body;
        let (reference, owner) = if of_first { (one, two) } else { (two, one) };
        let mut touch = Touch::of(bodies, (reference, owner), &manifold);
        touch.of_first = of_first;
        touch.rects = (one.index as u32, two.index as u32);
        if let Some(last) = last {
            touch.remember(last);
        }
        Some(touch)
    }

    pub(super) fn of(bodies: &Bodies, (reference, owner): (Placed, Placed), manifold: &Manifold) -> Touch {
        let (frame_a, frame_b) = (reference.frame, owner.frame);
        let n = frame_a.outward(manifold.face.normal());
        let t = -perp(n);
        let apart = frame_b.o - frame_a.o;
        let arms = |k: usize| {
            let point = manifold.points()[k.min(manifold.points().len() - 1)];
            let (on_a, on_b) = (frame_a.outward(point.on_face), frame_b.outward(point.vertex));
            // Halfway between the face and the owner's point, the same place for both bodies.
            let half = (apart + on_b - on_a) * 0.5;
            (on_a + half, on_b - half, -point.depth)
        };
        let [first, second] = [arms(0), arms(1)];
        let (w0, w1) = manifold.face.width(reference.rect);
        let (e0, e1) = edge_along(reference, owner, manifold.face);
        // `along` runs with t or against it.
        let with_t = manifold.face.place(reference.rect, 1.0) - manifold.face.place(reference.rect, 0.0);
        let slip = if frame_a.outward(with_t).dot(&t) > 0.0 { (w0 - e1, w1 - e0) } else { (e0 - w1, e1 - w0) };
        // Friction acts at the height of the nearer point: halfway from the face to it, not to the mean of both.
        let nearer = 0.25 * (first.2 - second.2).abs();
        let mut touch = Touch {
            rects: (0, 0),
            a: reference.body as u32,
            b: owner.body as u32,
            face: manifold.face,
            of_first: true,
            n,
            ends: [0, 1],
            count: manifold.points().len() as u8,
            cut: [0, 1].map(|k| manifold.points().get(k).is_some_and(|point| point.feature > 1)),
            gap: [first.2, second.2],
            lever_a: [cross(first.0, n), cross(second.0, n)],
            lever_b: [cross(first.1, n), cross(second.1, n)],
            along_a: 0.5 * (cross(first.0, t) + cross(second.0, t)) + nearer,
            along_b: 0.5 * (cross(first.1, t) + cross(second.1, t)) + nearer,
            slip,
            surface: Surface::of_pair(bodies.surface[reference.body], bodies.surface[owner.body]),
            middle: frame_a.o + (first.0 + second.0) * 0.5,
            push: [0.0; 2],
            grip: 0.0,
            met: false,
            touching: false,
        };
        for (k, point) in manifold.points().iter().enumerate() {
            touch.ends[k] = point.feature & 1;
        }
        if touch.count == 1 {
            // A second point beside the first and out of reach keeps all touches alike.
            let beside = reference.rect.half().min() + owner.rect.half().min();
            touch.lever_a[1] += beside;
            touch.lever_b[1] += beside;
            touch.gap[1] = FAR;
            touch.ends[1] = u8::MAX;
        }
        touch
    }

    /// Puts it behind others. Touches are large: their list grows by a quarter, not to twice its size.
    #[inline]
    pub(super) fn put_behind(self, touches: &mut Vec<Touch>) {
        if touches.len() == touches.capacity() {
            touches.reserve_exact(touches.len() / 4 + LANES);
        }
        touches.push(self);
    }

    /// Carries over the impulses of the last step where the same points touch.
    pub(super) fn remember(&mut self, last: &Touch) {
        if (self.of_first, self.face) != (last.of_first, last.face) {
            return;
        }
        (self.touching, self.met) = (last.touching, last.met);
        self.grip = last.grip;
        if (self.count, last.count) == (1, 1) && !self.cut[0] && !last.cut[0] {
            // The same corner, though it may by now be the other end of another edge.
            self.push[0] = last.push[0];
            return;
        }
        for k in 0..self.count as usize {
            let same = last.ends.iter().position(|end| *end == self.ends[k]);
            if let Some(at) = same {
                self.push[k] = last.push[at];
            }
        }
    }

    /// The gap at a point, and how fast it opens, for two bodies that have come so far since the step began.
    pub(super) fn state(&self, p: usize, a: &[f64; LANES], b: &[f64; LANES]) -> (f64, f64) {
        let along = |x: usize, z: usize| self.n.x * (b[x] - a[x]) + self.n.y * (b[z] - a[z]);
        let gap = self.gap[p] + along(X, Z) + self.lever_b[p] * b[TURN] - self.lever_a[p] * a[TURN];
        (gap, along(VX, VZ) + self.lever_b[p] * b[SPIN] - self.lever_a[p] * a[SPIN])
    }

    /// Whether the owner has slipped off the face since the step began.
    pub(super) fn slips(&self, a: &[f64; LANES], b: &[f64; LANES]) -> bool {
        let slipped = self.n.y * (b[X] - a[X]) - self.n.x * (b[Z] - a[Z]);
        slipped < self.slip.0 || slipped > self.slip.1
    }

    /// Makes gaps, levers and slip found just now count from the start of the step.
    pub(super) fn count_from(&mut self, a: &[f64; LANES], b: &[f64; LANES]) {
        let (dx, dz) = (b[X] - a[X], b[Z] - a[Z]);
        let apart = self.n.x * dx + self.n.y * dz;
        let slipped = self.n.y * dx - self.n.x * dz;
        for p in 0..2 {
            self.lever_a[p] -= 0.5 * slipped;
            self.lever_b[p] += 0.5 * slipped;
            self.gap[p] -= apart + self.lever_b[p] * b[TURN] - self.lever_a[p] * a[TURN];
        }
        self.along_a += 0.5 * apart;
        self.along_b -= 0.5 * apart;
        self.slip = (self.slip.0 + slipped, self.slip.1 + slipped);
    }

    /// What decides how the world goes on, for its digest.
    pub(super) fn words(&self) -> [u64; 6] {
        let rects = u64::from(self.rects.0) << 32 | u64::from(self.rects.1);
        let kind = u64::from(self.ends[0]) | u64::from(self.ends[1]) << 8 | (self.face as u64) << 16;
        let flags = u64::from(self.of_first) << 24 | u64::from(self.touching) << 25;
        let [p, q] = self.push.map(bits);
        [rects, kind | flags, p, q, bits(self.grip), bits(self.n.x)]
    }
}

/// A number's bits; −0 counts as 0.
fn bits(number: f64) -> u64 {
    (number + 0.0).to_bits()
}

fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}
