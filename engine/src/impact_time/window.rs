//! When two fliers can touch at all, and how sharply their paths can bend meanwhile.

use super::Flier;
use crate::area::{Rect, Vec2};
use crate::flight::Path;
use crate::frame::Frame;

/// Bounds that hold from now to the horizon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Radii of the circles around both.
    pub(super) radii: (f64, f64),
    /// A: a bound on |q″|, with the first as the reference, and with the second.
    pub(super) bend: (f64, f64),
    /// How far gravity, drag and pushes can carry the centres off their straight relative course \[m\].
    stray: f64,
    /// What acts on each.
    each: (Greatest, Greatest),
    /// |d|, |d′|, |d″| and |d‴| at most.
    course: [f64; 4],
}

/// What acts on one body, at its greatest over the search: |ω|, |ω̇| and |ω̈|.
#[derive(Clone, Copy, Debug)]
struct Greatest {
    omega: f64,
    alpha: f64,
    alpha_rate: f64,
}

fn greatest(path: &Path, horizon: f64) -> Greatest {
    let alpha = path.angular_acceleration().abs();
    let turning = path.motion.omega.abs();
    Greatest {
        omega: if alpha == 0.0 { turning } else { turning + alpha * horizon },
        alpha,
        alpha_rate: alpha * path.pull.drag.1,
    }
}

/// More than rounding could take away from a bound.
const SURE: f64 = 1.0 + 1e-12;

impl Bounds {
    pub(super) fn of(a: &Flier, b: &Flier, horizon: f64) -> Bounds {
        let radii = (a.radius() * SURE, b.radius() * SURE);
        let (pull_a, pull_b) = (a.path.acceleration(), b.path.acceleration());
        let alike = a.path.pull.drag.0 == b.path.pull.drag.0;
        let acceleration = if alike { (pull_a - pull_b).norm() } else { pull_a.norm() + pull_b.norm() };
        let (stray, gained) = if acceleration == 0.0 {
            (0.0, 0.0)
        } else {
            (0.5 * acceleration * horizon * horizon, acceleration * horizon)
        };
        let u = (b.path.motion.v - a.path.motion.v).norm() + gained;
        let rate = pull_a.norm() * a.path.pull.drag.0 + pull_b.norm() * b.path.pull.drag.0;
        let each = (greatest(&a.path, horizon), greatest(&b.path, horizon));
        let (one, two) = each;
        let d = (radii.0 + radii.1) * SURE + 2.0 * stray;
        let bend = |reference: &Greatest, other: &Greatest, r: f64| {
            acceleration
                + (other.omega * other.omega + other.alpha) * r
                + 2.0 * reference.omega * (u + other.omega * r)
                + (reference.omega * reference.omega + reference.alpha) * (d + r)
        };
        let bend = (bend(&one, &two, radii.1), bend(&two, &one, radii.0));
        Bounds { radii, bend, stray, each, course: [d, u, acceleration, rate] }
    }

    /// J: a bound on |q‴|, with the first as the reference or the second.
    pub(super) fn jerk(&self, of_first: bool) -> f64 {
        let [d, u, a, rate] = self.course;
        let (reference, other, r) =
            if of_first { (self.each.0, self.each.1, self.radii.1) } else { (self.each.1, self.each.0, self.radii.0) };
        let Greatest { omega: w, alpha, alpha_rate } = reference;
        let Greatest { omega: v, alpha: beta, alpha_rate: beta_rate } = other;
        let third = rate + (v * v * v + 3.0 * v * beta + beta_rate) * r;
        let second = a + (v * v + beta) * r;
        let turning = w * w + alpha;
        third + 3.0 * w * second + 3.0 * turning * (u + v * r) + (w * w * w + 3.0 * w * alpha + alpha_rate) * (d + r)
    }

    /// The speeds that the motion of a vertex is put together from \[m/s\].
    pub(super) fn speeds(&self, a: &Flier, b: &Flier) -> f64 {
        let of = |flier: &Flier, radius: f64| flier.path.motion.v.abs().sum() + flier.path.motion.omega.abs() * radius;
        of(a, self.radii.0) + of(b, self.radii.1)
    }

    /// From when to when the two can touch, within the horizon: the circles around both overlap, and the circle around
    /// one reaches the rectangle of the other if that does not turn.
    pub(super) fn window(&self, a: &Flier, b: &Flier, horizon: f64) -> Option<(f64, f64)> {
        let (d, u) = (b.path.frame.o - a.path.frame.o, b.path.motion.v - a.path.motion.v);
        let circles = circles_meet(d, u, self.radii.0 + self.radii.1 + self.stray, horizon)?;
        let around_a = crosses(a, d, u, self.radii.1 + self.stray, circles)?;
        crosses(b, -d, -u, self.radii.0 + self.stray, around_a)
    }
}

/// From when to when two points are within reach of each other.
fn circles_meet(d: Vec2, u: Vec2, reach: f64, horizon: f64) -> Option<(f64, f64)> {
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

/// The part of a time in which a point on a straight course is within reach of a rectangle that does not turn; all
/// of it for one that does.
fn crosses(flier: &Flier, d: Vec2, u: Vec2, reach: f64, time: (f64, f64)) -> Option<(f64, f64)> {
    let Path { frame, motion, pull } = flier.path;
    if motion.omega != 0.0 || pull.alpha != 0.0 {
        return Some(time);
    }
    let Rect { x_min, x_max, z_min, z_max } = flier.rect;
    let along_x = between(inward_x(&frame, d), inward_x(&frame, u), (x_min - reach, x_max + reach), time)?;
    between(inward_z(&frame, d), inward_z(&frame, u), (z_min - reach, z_max + reach), along_x)
}

fn inward_x(frame: &Frame, v: Vec2) -> f64 {
    frame.cos * v.x + frame.sin * v.y
}

fn inward_z(frame: &Frame, v: Vec2) -> f64 {
    frame.cos * v.y - frame.sin * v.x
}

/// The part of a time in which p + u t lies within limits, which are widened by more than rounding.
fn between(p: f64, u: f64, (low, high): (f64, f64), (start, end): (f64, f64)) -> Option<(f64, f64)> {
    let slack = 1e-12 * (p.abs() + low.abs() + high.abs());
    let (low, high) = (low - slack, high + slack);
    if u == 0.0 {
        return (low <= p && p <= high).then_some((start, end));
    }
    let (one, two) = ((low - p) / u, (high - p) / u);
    let (start, end) = (start.max(one.min(two)), end.min(one.max(two)));
    (start <= end).then_some((start, end))
}
