//! Bounds of rectangles in the world: sure, not sharp.
//!
//! They are widened by more than the vertex test can err and rounded outwards, so that what they separate cannot
//! collide.

use crate::area::{Rect, Vec2};
use crate::flight::Path;
use crate::frame::Frame;

/// A range along an axis, rounded outwards to f32: bounds only have to be sure, and half the bytes is
/// half the traffic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) min: f32,
    pub(super) max: f32,
}

/// How far bounds are widened, relative to the coordinates they come from: the vertex test errs by a few
/// roundings (1e-16 each), never by this much.
const WIDENING: f64 = 1e-13;

impl Range {
    /// The range, rounded outwards: by twice what rounding to f32 can err.
    #[inline]
    pub(super) fn around(min: f64, max: f64) -> Self {
        let ulp = f64::from(f32::EPSILON);
        Range { min: (min - min.abs() * ulp) as f32, max: (max + max.abs() * ulp) as f32 }
    }

    pub(super) fn common(self, other: Range) -> Range {
        Range { min: self.min.max(other.min), max: self.max.min(other.max) }
    }
}

/// The widened bounds of a rectangle in the world: its ranges of x and of z.
#[inline]
pub(super) fn bounds(frame: &Frame, rect: &Rect) -> (Range, Range) {
    let (centre, half) = (frame.place(rect.centre()), rect.half());
    let (cos, sin) = (frame.cos.abs(), frame.sin.abs());
    let widening = widening(frame, rect);
    let reach_x = cos * half.x + sin * half.y + widening;
    let reach_z = sin * half.x + cos * half.y + widening;
    (Range::around(centre.x - reach_x, centre.x + reach_x), Range::around(centre.y - reach_z, centre.y + reach_z))
}

/// The widened bounds of all that a rectangle sweeps over some time: its bounds now, along the way of its body's centre,
/// padded by how far turning can carry a point, and never beyond the circle around it.
#[inline]
pub(super) fn swept(path: &Path, rect: &Rect, time: f64) -> (Range, Range) {
    let (low, high) = sweep(path, rect, time);
    let widening = widening(&path.frame, rect) + WIDENING * (high - low).sum();
    (Range::around(low.x - widening, high.x + widening), Range::around(low.y - widening, high.y + widening))
}

/// The least and greatest coordinates of all that a rectangle sweeps over some time, sure but for rounding \[m\].
#[inline]
pub(crate) fn sweep(path: &Path, rect: &Rect, time: f64) -> (Vec2, Vec2) {
    let Path { frame, motion, .. } = *path;
    let centre = frame.outward(rect.centre());
    let (half, cos, sin) = (rect.half(), frame.cos.abs(), frame.sin.abs());
    let reach = Vec2::new(cos * half.x + sin * half.y, sin * half.x + cos * half.y);
    let (mut low, mut high) = (centre - reach, centre + reach);
    let uniform = path.pull.is_none();
    if motion.omega != 0.0 || !uniform {
        let radius = rect.radius();
        let turned = (motion.omega.abs() + 0.5 * path.angular_acceleration().abs() * time) * time * radius;
        let (pad, circle) = (Vec2::repeat(turned), Vec2::repeat(radius));
        (low, high) = ((low - pad).sup(&-circle), (high + pad).inf(&circle));
    }
    let way = motion.v * time;
    let stray = if uniform { 0.0 } else { 0.5 * path.acceleration().norm() * time * time };
    let stray = Vec2::repeat(stray);
    (frame.o + low + way.inf(&Vec2::zeros()) - stray, frame.o + high + way.sup(&Vec2::zeros()) + stray)
}

/// By how much bounds may be wrong, many times over.
#[inline]
fn widening(frame: &Frame, rect: &Rect) -> f64 {
    let sizes = rect.x_min.abs() + rect.x_max.abs() + rect.z_min.abs() + rect.z_max.abs();
    WIDENING * (frame.o.x.abs() + frame.o.y.abs() + sizes)
}

/// The range of x that a rectangle covers between two values of z, widened; `None` where it has none.
pub(super) fn range_within(frame: &Frame, rect: &Rect, slab: (f64, f64)) -> Option<Range> {
    let widening = widening(frame, rect);
    let (low, high) = (slab.0 - widening, slab.1 + widening);
    let corners = rect.vertices().map(|vertex| frame.place(vertex));
    let mut range: Option<(f64, f64)> = None;
    for k in 0..4 {
        if let Some((p, q)) = cut(corners[k], corners[(k + 1) % 4], low, high) {
            let (least, greatest) = range.unwrap_or((p, p));
            range = Some((least.min(p).min(q), greatest.max(p).max(q)));
        }
    }
    // An edge cut at a shallow angle errs by more than a rounding; a thousandth of the depth is ample and cheap.
    let slack = widening + 1e-3 * (slab.1 - slab.0);
    range.map(|(least, greatest)| Range::around(least - slack, greatest + slack))
}

/// The x at both ends of what an edge has between two values of z.
fn cut(from: Vec2, to: Vec2, low: f64, high: f64) -> Option<(f64, f64)> {
    let (from, to) = if from.y <= to.y { (from, to) } else { (to, from) };
    if to.y < low || from.y > high {
        return None;
    }
    let rise = to.y - from.y;
    let x_at = |z: f64| if rise > 0.0 { from.x + (to.x - from.x) * ((z - from.y) / rise) } else { from.x };
    let start = if from.y < low { x_at(low) } else { from.x };
    let end = if to.y > high { x_at(high) } else { to.x };
    Some((start, end))
}
