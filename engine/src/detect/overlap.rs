//! How deep two rectangles overlap, by separating axes: a measure for reports and warnings, and a quick
//! way to see that two rectangles are certainly apart.

use crate::area::{Rect, Vec2};
use crate::bodies::Bodies;
use crate::frame::Frame;

/// Two rectangles seen from the second one's frame: centre of the first from the centre of the second,
/// their half sizes, and the first one's axes.
struct Relative {
    centres: Vec2,
    half_a: Vec2,
    half_b: Vec2,
    cos: f64,
    sin: f64,
}

impl Relative {
    #[inline]
    fn new(a: &Frame, rect_a: &Rect, b: &Frame, rect_b: &Rect) -> Self {
        let seen = a.seen_from(b);
        Relative {
            centres: seen.place(rect_a.centre()) - rect_b.centre(),
            half_a: rect_a.half(),
            half_b: rect_b.half(),
            cos: seen.cos,
            sin: seen.sin,
        }
    }

    /// Overlap along the second's X and Z, then the first's X and Z; negative where that axis separates.
    #[inline]
    fn overlaps(&self) -> [f64; 4] {
        let Relative { centres: d, half_a, half_b, cos, sin } = *self;
        let (c, s) = (cos.abs(), sin.abs());
        [
            half_b.x + (c * half_a.x + s * half_a.y) - d.x.abs(),
            half_b.y + (s * half_a.x + c * half_a.y) - d.y.abs(),
            half_a.x + (c * half_b.x + s * half_b.y) - (cos * d.x + sin * d.y).abs(),
            half_a.y + (s * half_b.x + c * half_b.y) - (cos * d.y - sin * d.x).abs(),
        ]
    }
}

/// How far the rectangles would have to be moved apart \[m\]; 0 or less when they do not overlap.
#[must_use]
pub fn depth(a: &Frame, rect_a: &Rect, b: &Frame, rect_b: &Rect) -> f64 {
    let [x, z, own_x, own_z] = Relative::new(a, rect_a, b, rect_b).overlaps();
    x.min(z).min(own_x).min(own_z)
}

/// The axis that holds two rectangles apart the most, from the first to the second in the world, and by how much \[m\]; negative
/// where none does.
#[must_use]
pub fn widest_gap(a: &Frame, rect_a: &Rect, b: &Frame, rect_b: &Rect) -> (Vec2, f64) {
    let relative = Relative::new(a, rect_a, b, rect_b);
    let [x, z, own_x, own_z] = relative.overlaps();
    let Relative { centres: d, cos, sin, .. } = relative;
    let (axis, overlap) = if x.min(z) <= own_x.min(own_z) {
        if x <= z { (Vec2::new(-d.x.signum(), 0.0), x) } else { (Vec2::new(0.0, -d.y.signum()), z) }
    } else if own_x <= own_z {
        let side = -(cos * d.x + sin * d.y).signum();
        (Vec2::new(cos, sin) * side, own_x)
    } else {
        let side = -(cos * d.y - sin * d.x).signum();
        (Vec2::new(-sin, cos) * side, own_z)
    };
    (b.outward(axis), -overlap)
}

/// Deepest overlap between the rectangles of two bodies \[m\]; 0 or less when there is none.
#[must_use]
pub fn between(bodies: &Bodies, i: usize, j: usize) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for rect_i in bodies.rects_of(i) {
        for rect_j in bodies.rects_of(j) {
            deepest = deepest.max(depth(&bodies.frame[i], rect_i, &bodies.frame[j], rect_j));
        }
    }
    deepest
}

/// Relative error allowed for when saying that two rectangles are apart: a vertex test that finds a
/// vertex inside errs by a few roundings (1e-16 each) of the sizes involved, never by this much.
const DOUBT: f64 = 1e-13;

/// Whether the rectangles are apart beyond doubt: then no vertex test can find a vertex inside.
#[inline]
#[must_use]
pub fn certainly_apart(a: &Frame, rect_a: &Rect, b: &Frame, rect_b: &Rect) -> bool {
    let relative = Relative::new(a, rect_a, b, rect_b);
    let [x, z, own_x, own_z] = relative.overlaps();
    let reach = (a.o - b.o).abs().sum() + far_corner(rect_a) + far_corner(rect_b);
    x.min(z).min(own_x).min(own_z) < -DOUBT * reach
}

/// How far a rectangle's coordinates reach from its body's centre, in the sum of both axes.
#[inline]
fn far_corner(rect: &Rect) -> f64 {
    rect.x_min.abs().max(rect.x_max.abs()) + rect.z_min.abs().max(rect.z_max.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, z: f64, angle: f64) -> Frame {
        Frame::new(Vec2::new(x, z), angle)
    }

    #[test]
    fn a_plus_sign_is_two_and_a_half_deep() {
        let (bar, post) = (Rect::centred(4.0, 1.0), Rect::centred(1.0, 4.0));
        assert_eq!(depth(&at(0.0, 0.0, 0.0), &bar, &at(0.0, 0.0, 0.0), &post), 2.5);
        assert!((depth(&at(0.0, 0.0, 0.0), &bar, &at(0.1, 0.0, 0.0), &post) - 2.4).abs() < 1e-15);
    }

    #[test]
    fn corners_that_miss_each_other_are_apart() {
        let square = Rect::centred(1.0, 1.0);
        let quarter_turn = core::f64::consts::FRAC_PI_4;
        assert!(certainly_apart(&at(0.0, 0.0, 0.0), &square, &at(0.9, 0.9, quarter_turn), &square));
        assert!(!certainly_apart(&at(0.0, 0.0, 0.0), &square, &at(0.8, 0.8, quarter_turn), &square));
        assert!(!certainly_apart(&at(0.0, 0.0, 0.0), &square, &at(1.0, 0.0, 0.0), &square), "touching");
    }
}
