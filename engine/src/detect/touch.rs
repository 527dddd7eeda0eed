//! The contact of two rectangles that touch: one point, or two of a face that lands flat.
//!
//! **The rule of near-flat landings.** A face whose tilt against the other is at most [`FLAT`] lands flat: both its points
//! touch at once. With any more tilt the nearer corner lands first, alone, and the other when it comes down: a different
//! outcome even in the limit (a unit square that falls without turning bounces back without spin when flat; its corners
//! one after the other leave it with v = 23/25 and ω = 24/25 of what came). The true answer has this step in it; the
//! threshold only says where, far above rounding (1e-16 each hit) and far below what a scene can mean.

use super::manifold::{Manifold, Placed, Point, cut_to_face};
use super::seams::{self, Seams};
use super::{Contact, Face};
use crate::area::{Rect, Vec2};

/// Greatest tilt that lands flat \[rad\]. Smaller, and rounding would decide; greater, and true corner hits would be lost.
pub const FLAT: f64 = 1e-10;

/// The contact at a face of the reference that the owner has come to.
#[must_use]
pub fn at_face(reference: Placed, owner: Placed, face: Face) -> Manifold {
    let [first, second] = cut_to_face(reference, owner, face);
    let apart = (second.vertex - first.vertex).norm();
    let size = reference.rect.half().min().min(owner.rect.half().min());
    let is_flat = (first.depth - second.depth).abs() <= FLAT * apart;
    let (points, count) = match first.depth >= second.depth {
        _ if is_flat && apart > FLAT * size => ([first, second], 2),
        true => ([first, second], 1),
        false => ([second, first], 1),
    };
    let depth = points[0].depth.max(if count == 2 { points[1].depth } else { f64::NEG_INFINITY });
    Manifold::new(owner.body, reference.body, face, depth, points, count)
}

/// The contact of two rectangles that stand at each other: at the face that separates them best, or least overlaps, the
/// points no further from it than a band; `None` when there are none. A face that a seam hides is passed over.
#[must_use]
pub fn standing(seams: &Seams, one: Placed, two: Placed, band: f64) -> Option<Manifold> {
    let [x, z] = faces(one, two);
    let [other_x, other_z] = faces(two, one);
    let mut all = [(one, two, x), (one, two, z), (two, one, other_x), (two, one, other_z)].map(Some);
    if all.iter().flatten().any(|(_, _, (_, gap))| *gap > band) {
        return None;
    }
    let size = one.rect.half().min().min(two.rect.half().min());
    loop {
        let mut best: Option<(usize, f64)> = None;
        for (k, gap) in all.iter().enumerate().filter_map(|(k, way)| Some((k, way.as_ref()?.2.1))) {
            if best.is_none_or(|(_, so_far)| gap > so_far + FLAT * size) {
                best = Some((k, gap));
            }
        }
        let (reference, owner, (face, gap)) = all[best?.0].take()?;
        let points = within(band, cut_to_face(reference, owner, face));
        let manifold = |(points, count)| Manifold::new(owner.body, reference.body, face, -gap, points, count);
        match points.map(manifold) {
            Some(manifold) if !seams::hides(seams, reference, owner, &manifold) => return Some(manifold),
            _ => {}
        }
    }
}

/// Those of two points that are no further from their face than a band, and how many.
fn within(band: f64, [first, second]: [Point; 2]) -> Option<([Point; 2], usize)> {
    match (first.depth >= -band, second.depth >= -band) {
        (true, true) => Some(([first, second], 2)),
        (true, false) => Some(([first, second], 1)),
        (false, true) => Some(([second, first], 1)),
        (false, false) => None,
    }
}

/// The faces of a reference that look at another rectangle, along x and z, and how far it is from each.
fn faces(reference: Placed, other: Placed) -> [(Face, f64); 2] {
    let seen = other.frame.seen_from(reference.frame);
    let d = seen.place(other.rect.centre()) - reference.rect.centre();
    let (half, reach, c, s) = (reference.rect.half(), other.rect.half(), seen.cos.abs(), seen.sin.abs());
    let x = d.x.abs() - (half.x + (c * reach.x + s * reach.y));
    let z = d.y.abs() - (half.y + (s * reach.x + c * reach.y));
    [(if d.x >= 0.0 { Face::XMax } else { Face::XMin }, x), (if d.y >= 0.0 { Face::ZMax } else { Face::ZMin }, z)]
}

/// The one vertex that the document's test finds first when two rectangles touch (reading R4): of the body created first,
/// or else of the other.
#[must_use]
pub fn first_vertex(manifold: &Manifold, rect_of: impl Fn(usize) -> Rect) -> Contact {
    let Manifold { owner, reference, face, .. } = *manifold;
    let (rect, opposite) = (rect_of(owner), rect_of(reference));
    let own = manifold.points().iter().filter(|point| point.feature < 2).min_by_key(|p| nearest(&rect, p.vertex));
    let cut = manifold.points().iter().filter(|point| point.feature >= 2);
    match (own, cut.min_by_key(|point| nearest(&opposite, point.on_face))) {
        (_, Some(point)) if own.is_none() || reference < owner => {
            let vertex = opposite.vertices()[nearest(&opposite, point.on_face)];
            let face = facing(&rect, point);
            let on_face = face.project(&rect, point.vertex);
            Contact { owner: reference, reference: owner, vertex, on_face, face, depth: 0.0 }
        }
        (own, _) => {
            let Point { vertex, on_face, .. } = *own.unwrap_or(&manifold.points()[0]);
            let vertex = if own.is_some() { rect.vertices()[nearest(&rect, vertex)] } else { vertex };
            Contact { owner, reference, vertex, on_face, face, depth: 0.0 }
        }
    }
}

/// The vertex of a rectangle that is nearest to a point, in the order of reading R4.
fn nearest(rect: &Rect, point: Vec2) -> usize {
    let distance = |k: usize| (rect.vertices()[k] - point).norm_squared();
    (1..4).fold(0, |best, k| if distance(k) < distance(best) { k } else { best })
}

/// The face of the owner that one of its edge points lies on.
fn facing(rect: &Rect, point: &Point) -> Face {
    let distance = |face: &Face| face.depth_of(rect, point.vertex).abs();
    let [first, rest @ ..] = Face::ALL;
    rest.into_iter().fold(first, |best, next| if distance(&next) < distance(&best) { next } else { best })
}
