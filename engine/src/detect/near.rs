//! Two rectangles that touch, overlap, or may come to touch within a step: where, and how far apart they are there.
//!
//! Separating axes again, told of the gap: the axis that separates most belongs to the face at which they will meet. A pair that
//! goes on touching keeps its face while another is no better than by [`LOYALTY`], and a pair in each other goes apart the way
//! it came.

use super::complete::{PREFERENCE, Way, along, entered};
use super::manifold::{Manifold, Placed, Point, cut_to_face};
use super::{Face, seams};
use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::frame::Frame;

/// A face that was touched is kept while no other separates better by this share of the smaller rectangle: parallel faces
/// do not take turns.
pub(crate) const LOYALTY: f64 = 1e-3;

/// Overlaps deeper than this share of the smaller rectangle go apart the way they came; shallower ones the least way.
pub(crate) const DEEP: f64 = 0.05;

/// Two points closer together than this share of the smaller rectangle are one.
pub(crate) const ONE: f64 = 1e-6;

/// How two rectangles touched a step ago.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Before {
    /// Whether the face was one of the first rectangle.
    pub(crate) of_first: bool,
    pub(crate) face: Face,
    /// Its normal in the world, from the first to the second.
    pub(crate) normal: Vec2,
}

/// Where two rectangles meet that are no further apart than `margin`; depths are negative across a gap.
///
/// `earlier` tells where a body stood a step ago: it is asked where they are in each other and were not in touch before.
pub(crate) fn meet(
    bodies: &Bodies,
    (one, two): (Placed, Placed),
    margin: f64,
    before: Option<&Before>,
    earlier: impl Fn(usize) -> Frame,
) -> Option<Manifold> {
    let ways = Way::each(one, two);
    let depth = ways.iter().map(|way| way.depth).fold(f64::INFINITY, f64::min);
    if depth < -margin {
        return None;
    }
    let small = one.rect.half().min().min(two.rect.half().min());
    let mut open = ways.map(Some);
    if depth > DEEP * small {
        let came = before.map(|before| before.normal).or_else(|| {
            let were = (earlier(one.body), earlier(two.body));
            entered(&ways, (one, two), (Placed { frame: &were.0, ..one }, Placed { frame: &were.1, ..two }))
        });
        if let Some(normal) = came {
            let kept = ways.map(|way| along(way, normal, one, two));
            if kept.iter().any(Option::is_some) {
                open = kept;
            }
        }
    }
    let loyal = before.map(|before| (before.of_first, before.face, LOYALTY * small));
    while let Some(k) = best(&open, (one, two), loyal) {
        let way = open[k].take()?;
        let (reference, owner) = if way.of_first { (one, two) } else { (two, one) };
        let Some(manifold) = at_face(reference, owner, way.face, margin) else {
            if way.depth < 0.0 {
                return None;
            }
            continue;
        };
        if !seams::hides(&bodies.seams, reference, owner, &manifold) {
            return Some(manifold);
        }
    }
    None
}

/// The way of least overlap or widest gap, the first of equals, with something in favour of the one taken before.
fn best(ways: &[Option<Way>; 4], (i, j): (Placed, Placed), loyal: Option<(bool, Face, f64)>) -> Option<usize> {
    let margin = PREFERENCE * i.rect.half().max().min(j.rect.half().max());
    let mut best: Option<(usize, f64)> = None;
    for (k, way) in ways.iter().enumerate() {
        let Some(way) = way else { continue };
        let favour = match loyal {
            Some((of_first, face, favour)) if (of_first, face) == (way.of_first, way.face) => favour,
            _ => 0.0,
        };
        let depth = way.depth - favour;
        if best.is_none_or(|(_, least)| depth < least - margin) {
            best = Some((k, depth));
        }
    }
    best.map(|(k, _)| k)
}

/// The one or two points at a face that are no further from it than `margin`; `None` where the owner passes beside it.
fn at_face(reference: Placed, owner: Placed, face: Face, margin: f64) -> Option<Manifold> {
    let [first, second] = cut_to_face(reference, owner, face);
    let (least, greatest) = face.width(reference.rect);
    let beside = |p: &Point| {
        let at = face.along(owner.frame.seen_from(reference.frame).place(p.vertex));
        let slack = 1e-9 * (greatest - least);
        at < least - slack || at > greatest + slack
    };
    let counts = |p: &Point| p.depth >= -margin && !beside(p);
    let small = reference.rect.half().min().min(owner.rect.half().min());
    let one_point = (second.vertex - first.vertex).norm() <= ONE * small;
    let (points, count) = match (counts(&first), counts(&second)) {
        (true, true) if !one_point => ([first, second], 2),
        (true, true) => ([first, second], 1),
        (true, false) => ([first, second], 1),
        (false, true) => ([second, first], 1),
        (false, false) => return None,
    };
    let depth = first.depth.max(second.depth);
    Some(Manifold::new(owner.body, reference.body, face, depth, points, count))
}
