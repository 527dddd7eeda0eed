//! The moment of impact: when two rectangles that fly and turn uniformly first touch.
//!
//! In the frame of one of them, the reference, a vertex of the other has the distance q(t) from a face. With
//! |q″| ≤ A over the search, `q(t + Δ) ≥ q + q′ Δ − A Δ²/2`: until the first root of that parabola over all four
//! vertices the face separates the two, whatever they do. The search steps to that root, chooses the face that
//! separates best, and repeats. So **it cannot step over an impact**; and near one, where A Δ² fades, it is Newton's
//! iteration and doubles its digits at every step.
//!
//! Circles around both come first: before they meet and after they part there is nothing to look for, and while they
//! overlap the centres are no further apart than the radii, which bounds A:
//!
//! ```text
//! q = R(−θ_r)(d + r),   d = O_o − O_r with d″ = 0,   r the vertex, turning at ω_o
//! |q″| ≤ ω_o²|r| + 2|ω_r|(|d′| + |ω_o||r|) + ω_r²(|d| + |r|)
//! ```

use crate::area::{Rect, Vec2};
use crate::bodies::Motion;
use crate::detect::Face;
use crate::frame::{Frame, perp};

/// A rectangle in uniform flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flier {
    /// Where its body stands at time 0.
    pub frame: Frame,
    /// How its body moves.
    pub motion: Motion,
    /// The rectangle in its body's frame.
    pub rect: Rect,
}

impl Flier {
    /// The same after a time \[s\]. The rotation is composed with that of ω·t, so that nothing depends on how often it
    /// is asked.
    #[must_use]
    pub fn after(&self, time: f64) -> Flier {
        let (sin, cos) = libm::sincos(self.motion.omega * time);
        let Frame { o, cos: c, sin: s } = self.frame;
        let frame = Frame { o: o + self.motion.v * time, cos: c * cos - s * sin, sin: s * cos + c * sin };
        Flier { frame, ..*self }
    }

    /// The greatest distance of any of its points from its body's centre.
    fn radius(&self) -> f64 {
        self.rect.vertices().iter().map(|vertex| vertex.norm()).fold(0.0, f64::max)
    }
}

/// Where and when two rectangles touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// After how much time \[s\].
    pub time: f64,
    /// Whether the face is one of the first rectangle; its vertices are then the other's.
    pub face_of_first: bool,
    /// The face that separated them to the last.
    pub face: Face,
}

/// A gap below this share of the smaller rectangle's size is touching. A few roundings of the coordinates; smaller and
/// the search would chase noise.
const TOUCHING: f64 = 4e-16;

/// Steps of one search; each at least halves what is left or doubles the digits, so only a grazing flight of absurd length
/// could need as many, and it is then taken to touch where the search has come: never to have passed.
const MOST_STEPS: u32 = 10_000;

/// When two rectangles that do not overlap first touch while approaching, within a horizon \[s\].
#[must_use]
pub fn first_touch(a: &Flier, b: &Flier, horizon: f64) -> Option<Touch> {
    let (start, end) = circles_meet(a, b, horizon)?;
    let small = a.rect.half().min().min(b.rect.half().min());
    let scale = (a.frame.o - b.frame.o).abs().max() + a.radius() + b.radius();
    let tolerance = TOUCHING * small.max(scale);
    let mut time = start;
    for _ in 0..MOST_STEPS {
        let (fa, fb) = (a.after(time), b.after(time));
        let on_a = Separation::best(&fa, &fb);
        let on_b = Separation::best(&fb, &fa);
        let (best, face_of_first) = if on_b.gap > on_a.gap { (on_b, false) } else { (on_a, true) };
        let touch = Touch { time, face_of_first, face: best.face };
        match best.advance(tolerance) {
            Advance::Touching => return Some(touch),
            Advance::By(step) if time + step > time => time += step,
            Advance::By(_) => return Some(touch),
        }
        if time > end {
            return None;
        }
    }
    Some(Touch { time, face_of_first: true, face: Face::XMax })
}

/// From when to when the circles around two fliers overlap, within the horizon.
fn circles_meet(a: &Flier, b: &Flier, horizon: f64) -> Option<(f64, f64)> {
    let (d, u) = (b.frame.o - a.frame.o, b.motion.v - a.motion.v);
    let reach = (a.radius() + b.radius()) * (1.0 + 1e-12); // beyond what rounding could take away
    let (uu, du, excess) = (u.dot(&u), d.dot(&u), d.dot(&d) - reach * reach);
    if uu == 0.0 {
        return (excess <= 0.0).then_some((0.0, horizon));
    }
    let discriminant = du * du - uu * excess;
    if discriminant < 0.0 {
        return None;
    }
    // Both roots of uu t² + 2 du t + excess, the one that would cancel from the product of the two.
    let sum = -(du + discriminant.sqrt().copysign(du));
    let (one, two) = (sum / uu, if sum == 0.0 { 0.0 } else { excess / sum });
    let (start, end) = (one.min(two).max(0.0), one.max(two).min(horizon));
    (start <= end).then_some((start, end))
}

/// The face of a reference that separates it best from another rectangle, and how its distances change.
struct Separation {
    face: Face,
    gap: f64,
    /// Distance and its rate of change, of each vertex of the other from the face.
    vertices: [(f64, f64); 4],
    /// A: a bound on how fast the rates change.
    bend: f64,
}

/// What a separating face allows.
enum Advance {
    /// Nothing: a vertex is at the face and comes closer.
    Touching,
    /// That much time without a touch.
    By(f64),
}

impl Separation {
    fn best(reference: &Flier, other: &Flier) -> Separation {
        let seen = other.frame.seen_from(&reference.frame);
        let rect = &reference.rect;
        let vertices = other.rect.vertices().map(|vertex| seen.place(vertex));
        let gap = |face: Face| vertices.iter().map(|p| -face.depth_of(rect, *p)).fold(f64::INFINITY, f64::min);
        let gaps = Face::ALL.map(|face| (face, gap(face)));
        let (face, gap) = gaps[1..].iter().fold(gaps[0], |best, next| if next.1 > best.1 { *next } else { best });
        let n = face.normal();
        let (w_r, w_o) = (reference.motion.omega, other.motion.omega);
        let u = reference.frame.inward(other.motion.v - reference.motion.v);
        let rate = |vertex: Vec2, p: Vec2| {
            let arm = seen.outward(vertex);
            (u + perp(arm) * w_o - perp(p) * w_r).dot(&n)
        };
        let own = other.rect.vertices();
        let states = [0, 1, 2, 3].map(|k| (-face.depth_of(rect, vertices[k]), rate(own[k], vertices[k])));
        Separation { face, gap, vertices: states, bend: bend(reference, other) }
    }

    /// How far time may go before any vertex can be at the face.
    fn advance(&self, tolerance: f64) -> Advance {
        let mut step = f64::INFINITY;
        for (q, rate) in self.vertices {
            if q <= tolerance && rate < 0.0 {
                return Advance::Touching;
            }
            // A vertex that lies at the face and leaves it may come back: it is followed down to the tolerance below.
            let room = if q <= tolerance { tolerance } else { q };
            step = step.min(first_root(room, rate, self.bend));
        }
        Advance::By(step)
    }
}

/// A: a bound on |q″| while the circles around both overlap.
fn bend(reference: &Flier, other: &Flier) -> f64 {
    let (w_r, w_o) = (reference.motion.omega.abs(), other.motion.omega.abs());
    let r = other.radius();
    let d = (reference.radius() + r) * (1.0 + 1e-9);
    let u = (other.motion.v - reference.motion.v).norm();
    w_o * w_o * r + 2.0 * w_r * (u + w_o * r) + w_r * w_r * (d + r)
}

/// The first Δ > 0 with q + q′ Δ − A Δ²/2 = 0, for q > 0 and A ≥ 0; infinite where there is none.
fn first_root(q: f64, rate: f64, bend: f64) -> f64 {
    let root = (rate * rate + 2.0 * bend * q).sqrt();
    // (q′ + √(q′² + 2Aq))/A, or written so that it does not cancel for q′ < 0
    if rate < 0.0 {
        2.0 * q / (root - rate)
    } else if bend > 0.0 {
        (rate + root) / bend
    } else {
        f64::INFINITY
    }
}
