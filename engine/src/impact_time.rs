//! The moment of impact: when two rectangles in flight first touch.
//!
//! In the frame of one of them, the reference, a vertex of the other has the distance q(t) from a face. With
//! |q″| ≤ A over the search, `q(t + Δ) ≥ q + q′ Δ − A Δ²/2`: until the first root of that parabola over all four
//! vertices the face separates the two, whatever they do. The search steps to that root, chooses the face that
//! separates best, and repeats. So **it cannot step over an impact**; and near one, where A Δ² fades, it is Newton's
//! iteration and doubles its digits at every step.
//!
//! Where a vertex lies at the face already, held there by what presses the two together, that parabola allows next to no
//! step. There the next term is known as well, q″, and |q‴| ≤ J bounds the rest.
//!
//! Before anything is searched, the time is cut to that in which the circles around both overlap;
//! there the centres are no further apart than the radii, which bounds A:
//!
//! ```text
//! q = R(−θ_r)(d + r) · n − h,   d = O_o − O_r,   r the vertex of the other, turning at ω_o
//! |q″| ≤ a + (ω_o² + α_o)|r| + 2|ω_r|(|d′| + |ω_o||r|) + (ω_r² + α_r)(|d| + |r|)
//! q″ = n · (a + α_o J r − ω_o² r − 2ω_r J w − α_r J p + ω_r² p),   w the velocity of the vertex seen from the reference,
//!                                                                   p its place there, J a quarter turn
//! ```
//!
//! with a, α bounds on the accelerations (gravity, drag, pushes) and |ω|, |d′| at their greatest. Between two bodies
//! that fall alike a is zero.

mod window;

use crate::area::{Rect, Vec2};
use crate::detect::Face;
use crate::flight::{Path, turned};
use crate::frame::{Frame, perp};
use window::Bounds;

/// A rectangle in flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flier {
    /// How its body flies from time 0.
    pub path: Path,
    /// The rectangle in its body's frame.
    pub rect: Rect,
}

impl Flier {
    /// The same later.
    #[must_use]
    pub fn after(&self, time: f64) -> Flier {
        Flier { path: self.path.after(time), rect: self.rect }
    }

    /// The greatest distance of any of its points from its body's centre.
    #[inline]
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.rect.radius()
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
    /// How fast the nearest vertex comes \[m/s\].
    pub speed: f64,
}

/// A gap below this share of the lengths involved is touching: a few roundings of the coordinates; smaller and the
/// search would chase noise.
pub const TOUCHING: f64 = 4e-16;

/// A vertex at a face that comes at less than this share of the speeds involved is not coming but rounded: after an
/// impact without restitution the two move alike to 1e-16.
pub const STILL: f64 = 1e-14;

/// Faces whose gaps differ by less than this share of the smaller rectangle's size separate equally well; the first of them
/// is the one that is hit (order: the first body's x and z, the second's). Without it two squares that meet face to
/// face would choose by rounding.
const ALIKE: f64 = 1e-10;

/// A step below this share of the time that is left is worth a closer look at what bends the way.
const CLOSE: f64 = 1e-3;

/// How often that closer look is shortened before it is given up.
const SHORTENINGS: u32 = 30;

/// Steps of one search; each at least halves what is left or doubles the digits, so only a grazing flight of absurd length
/// could need as many, and it is then taken to touch where the search has come: never to have passed.
const MOST_STEPS: u32 = 10_000;

/// When two rectangles that do not overlap first touch while approaching, within a horizon \[s\].
#[must_use]
pub fn first_touch(a: &Flier, b: &Flier, horizon: f64) -> Option<Touch> {
    first_open_touch(a, b, horizon, |_, _| false)
}

/// The same where some faces may be hidden (by seams): what comes at a hidden face is not touched there, and the search goes
/// on without that face. `hides` is told of a touch and of the frames at that time.
#[must_use]
pub fn first_open_touch(
    a: &Flier,
    b: &Flier,
    horizon: f64,
    mut hides: impl FnMut(&Touch, [&Frame; 2]) -> bool,
) -> Option<Touch> {
    let bounds = Bounds::of(a, b, horizon);
    let (start, end) = bounds.window(a, b, horizon)?;
    let mut search = Search::new(a, b, bounds, horizon);
    let mut time = start;
    for _ in 0..MOST_STEPS {
        let now = search.at(time);
        if now.best().gap < -search.alike && search.hidden != [false; 8] {
            return None; // it is behind what hides the face, which is touched before
        }
        match search.advance(&now, end - time) {
            Advance::By(step) if time + step > time => time += step,
            Advance::By(_) | Advance::Touching => {
                let touch = search.touch(&now, time);
                if !hides(&touch, [&now.frames[0], &now.frames[1]]) {
                    return Some(touch);
                }
                search.hidden[hidden_at(touch.face_of_first, touch.face)] = true;
            }
        }
        if time > end {
            return None;
        }
    }
    Some(search.touch(&search.at(time), time))
}

/// The place of a face among those that may be hidden.
fn hidden_at(of_first: bool, face: Face) -> usize {
    4 * usize::from(!of_first) + face as usize
}

/// A pair, and what holds of it all through the search.
struct Search<'a> {
    a: &'a Flier,
    b: &'a Flier,
    /// Where b's centre is from a's at time 0: differences of places first, so that far out is as exact as at home.
    d: Vec2,
    /// A gap below this is touching \[m\].
    tolerance: f64,
    /// Gaps that differ by less are alike \[m\].
    alike: f64,
    /// A vertex that comes more slowly, or would not come deeper than the tolerance in all the time, is still \[m/s\].
    still: f64,
    bounds: Bounds,
    /// Faces that are none.
    hidden: [bool; 8],
}

/// The pair at one time: the frames (a's centre at its own displacement, b's at d and its own), and the rest.
struct Now {
    frames: [Frame; 2],
    paths: [Path; 2],
    /// For each reference the face along x and the one along z that separate better than their opposites.
    faces: [Separating; 4],
}

/// A face of one of the two, and how far the other rectangle is from it \[m\].
#[derive(Clone, Copy, Debug)]
struct Separating {
    of_first: bool,
    face: Face,
    gap: f64,
}

/// What a separating face allows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Advance {
    /// Nothing: a vertex is at the face and comes closer.
    Touching,
    /// That much time without a touch.
    By(f64),
}

impl<'a> Search<'a> {
    fn new(a: &'a Flier, b: &'a Flier, bounds: Bounds, horizon: f64) -> Self {
        let d = b.path.frame.o - a.path.frame.o;
        let small = a.rect.half().min().min(b.rect.half().min());
        let scale = d.abs().max() + bounds.radii.0 + bounds.radii.1;
        Search {
            a,
            b,
            d,
            tolerance: TOUCHING * scale,
            alike: ALIKE * small,
            still: (STILL * bounds.speeds(a, b)).max(TOUCHING * scale / horizon),
            bounds,
            hidden: [false; 8],
        }
    }

    fn at(&self, time: f64) -> Now {
        let (a, b) = (&self.a.path, &self.b.path);
        let (change_a, change_b) = if a.pull == b.pull && !a.pull.is_none() {
            let flights = a.pull.flights(time);
            (a.change_by(flights), b.change_by(flights))
        } else {
            (a.change(time), b.change(time))
        };
        let frame_a = turned(&self.a.path.frame, Vec2::zeros(), change_a.turn);
        let frame_b = turned(&self.b.path.frame, self.d + (change_b.shift - change_a.shift), change_b.turn);
        let path = |of: &Path, frame, motion| Path { frame, motion, pull: of.pull };
        let (a, b) = (&self.a.rect, &self.b.rect);
        let [ax, az] = separating(true, &frame_a, a, &frame_b, b);
        let [bx, bz] = separating(false, &frame_b, b, &frame_a, a);
        Now {
            frames: [frame_a, frame_b],
            paths: [path(&self.a.path, frame_a, change_a.motion), path(&self.b.path, frame_b, change_b.motion)],
            faces: [ax, az, bx, bz].map(|face| self.unless_hidden(face)),
        }
    }

    fn unless_hidden(&self, face: Separating) -> Separating {
        if self.hidden[hidden_at(face.of_first, face.face)] {
            Separating { gap: f64::NEG_INFINITY, ..face }
        } else {
            face
        }
    }

    /// How far time may go before any vertex can be at the face that separates best; where that one is reached, at
    /// another that separates still.
    fn advance(&self, now: &Now, left: f64) -> Advance {
        let best = now.best();
        if let By(step) = self.until_reached(now, best, left) {
            return By(step);
        }
        let others = now.faces.iter().filter(|other| other.gap >= -self.alike && other.gap < best.gap + self.alike);
        others.fold(Advance::Touching, |found, other| match (found, self.until_reached(now, *other, left)) {
            (By(so_far), By(step)) => By(so_far.max(step)),
            (By(step), Advance::Touching) | (Advance::Touching, By(step)) => By(step),
            (Advance::Touching, Advance::Touching) => Advance::Touching,
        })
    }

    fn until_reached(&self, now: &Now, by: Separating, left: f64) -> Advance {
        let bend = if by.of_first { self.bounds.bend.0 } else { self.bounds.bend.1 };
        let mut step = f64::INFINITY;
        for (k, (q, rate)) in self.vertices(now, by).into_iter().enumerate() {
            if q <= self.tolerance && rate < -self.still {
                return Advance::Touching;
            }
            // A vertex that lies at the face and leaves it may come back: it is followed down to the tolerance below.
            let room = q.max(self.tolerance);
            let mut sure = first_root(room, rate, bend);
            // Only what bends the way makes it short: a vertex that is on its way there gets there.
            if sure < CLOSE * left && room + rate * CLOSE * left > 0.0 {
                sure = sure.max(self.with_curvature(now, by, k, (room, rate), left));
            }
            step = step.min(sure);
        }
        By(step)
    }

    /// How far time may go before the k-th vertex can be at a face, knowing q″ too: over any τ, q ≥ q + q′ Δ + (q″ − Jτ/3) Δ²/2.
    fn with_curvature(&self, now: &Now, by: Separating, k: usize, (q, rate): (f64, f64), left: f64) -> f64 {
        let (curvature, jerk) = (self.curvature(now, by, k), self.bounds.jerk(by.of_first));
        let mut best: f64 = 0.0;
        let mut within = left;
        for _ in 0..SHORTENINGS {
            best = best.max(within.min(first_root(q, rate, jerk * within / 3.0 - curvature)));
            if best >= within {
                break;
            }
            within *= 0.5;
        }
        best
    }

    /// q″ of the k-th vertex of the other rectangle, from a face.
    fn curvature(&self, now: &Now, by: Separating, k: usize) -> f64 {
        let (r, o) = if by.of_first { (0, 1) } else { (1, 0) };
        let other = if by.of_first { &self.b.rect } else { &self.a.rect };
        let seen = now.frames[o].seen_from(&now.frames[r]);
        let (path_r, path_o) = (&now.paths[r], &now.paths[o]);
        let arm = seen.outward(other.vertices()[k]);
        let p = seen.o + arm;
        let (w_r, w_o) = (path_r.motion.omega, path_o.motion.omega);
        let inward = |v: Vec2| now.frames[r].inward(v);
        let w = inward(path_o.motion.v - path_r.motion.v) + perp(arm) * w_o - perp(p) * w_r;
        let material = inward(path_o.acceleration() - path_r.acceleration())
            + perp(arm) * path_o.angular_acceleration()
            - arm * (w_o * w_o);
        let seen_turning = perp(w) * (2.0 * w_r) + perp(p) * path_r.angular_acceleration() - p * (w_r * w_r);
        (material - seen_turning).dot(&by.face.normal())
    }

    /// Distance and its rate of change, of each vertex of the other rectangle from a face.
    fn vertices(&self, now: &Now, by: Separating) -> [(f64, f64); 4] {
        let (r, o) = if by.of_first { (0, 1) } else { (1, 0) };
        let (rect, other) = if by.of_first { (&self.a.rect, &self.b.rect) } else { (&self.b.rect, &self.a.rect) };
        let seen = now.frames[o].seen_from(&now.frames[r]);
        let (w_r, w_o) = (now.paths[r].motion.omega, now.paths[o].motion.omega);
        let u = now.frames[r].inward(now.paths[o].motion.v - now.paths[r].motion.v);
        let n = by.face.normal();
        let mut found = [(0.0, 0.0); 4];
        for (vertex, found) in other.vertices().into_iter().zip(&mut found) {
            let arm = seen.outward(vertex);
            let p = seen.o + arm;
            *found = (-by.face.depth_of(rect, p), (u + perp(arm) * w_o - perp(p) * w_r).dot(&n));
        }
        found
    }

    /// The touch that has been reached: at the first of the faces that separate best and are come at.
    fn touch(&self, now: &Now, time: f64) -> Touch {
        let best = now.best();
        let speed = |by: Separating| {
            let vertices = self.vertices(now, by);
            let nearest = vertices.iter().map(|(q, _)| *q).fold(f64::INFINITY, f64::min);
            let near = vertices.iter().filter(|(q, _)| *q <= nearest + self.alike);
            -near.map(|(_, rate)| *rate).fold(f64::INFINITY, f64::min)
        };
        let alike = now.faces.iter().filter(|face| face.gap >= best.gap - self.alike);
        let coming = alike.map(|face| (*face, speed(*face))).find(|(_, speed)| *speed > self.still);
        let (by, speed) = coming.unwrap_or_else(|| (best, speed(best)));
        Touch { time, face_of_first: by.of_first, face: by.face, speed: speed.max(0.0) }
    }
}

use Advance::By;

impl Now {
    fn best(&self) -> Separating {
        let [first, rest @ ..] = self.faces;
        rest.into_iter().fold(first, |best, next| if next.gap > best.gap { next } else { best })
    }
}

/// The better of a reference's faces along x, and along z.
#[inline]
fn separating(of_first: bool, frame: &Frame, rect: &Rect, other_frame: &Frame, other: &Rect) -> [Separating; 2] {
    let seen = other_frame.seen_from(frame);
    let d = seen.place(other.centre()) - rect.centre();
    let (half, reach) = (rect.half(), other.half());
    let (c, s) = (seen.cos.abs(), seen.sin.abs());
    let x = d.x.abs() - (half.x + (c * reach.x + s * reach.y));
    let z = d.y.abs() - (half.y + (s * reach.x + c * reach.y));
    [
        Separating { of_first, face: if d.x >= 0.0 { Face::XMax } else { Face::XMin }, gap: x },
        Separating { of_first, face: if d.y >= 0.0 { Face::ZMax } else { Face::ZMin }, gap: z },
    ]
}

/// The first Δ > 0 with q + q′ Δ − A Δ²/2 = 0, for q > 0; infinite where there is none.
#[inline]
fn first_root(q: f64, rate: f64, bend: f64) -> f64 {
    let square = rate * rate + 2.0 * bend * q;
    if square < 0.0 {
        return f64::INFINITY;
    }
    let root = square.sqrt();
    // (q′ + √(q′² + 2Aq))/A, or written so that it does not cancel for q′ < 0
    if rate < 0.0 {
        2.0 * q / (root - rate)
    } else if bend > 0.0 {
        (rate + root) / bend
    } else {
        f64::INFINITY
    }
}
