//! The complete test: separating axes. It finds every overlap of two rectangles, crossed bars too.
//!
//! ```text
//!                     ┌───────────────┐
//!     owner           │   reference   │     The axis of least overlap belongs to a face of one rectangle, the
//!     ┌──────────┐    │               │     reference. The face of the other (the owner) that looks at it most
//!     │        ∙─┼──> │ face          │     squarely is cut to it; what lies inside are one or two points.
//!     │        ∙ │    │               │
//!     └──────────┘    └───────────────┘     Four axes are tried in the order i.X, i.Z, j.X, j.Z; a later one must
//!                                           be better by more than [`PREFERENCE`], so that equals go to the first.
//! ```

use super::{Contact, Face};
use crate::area::{Rect, Vec2};
use crate::bodies::Bodies;
use crate::frame::Frame;
use crate::work::Work;

/// By how much a later axis must beat an earlier one, relative to the rectangles' size. Far above rounding (1e-16)
/// and far below what can be seen: without it two squares that meet face to face would choose by rounding, and the
/// normal could change from step to step.
const PREFERENCE: f64 = 1e-9;

/// One or two points in which two bodies touch, and the face they lie at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manifold {
    /// The body whose vertices or edge it is.
    pub owner: usize,
    /// The body whose face is hit.
    pub reference: usize,
    /// That face.
    pub face: Face,
    /// Overlap along the face's normal \[m\], > 0: the least way apart.
    pub depth: f64,
    points: [Point; 2],
    count: usize,
}

/// A point of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// The point of the owner, in its frame.
    pub vertex: Vec2,
    /// The same point put onto the face, in the reference's frame.
    pub on_face: Vec2,
    /// How far inside the face it lies \[m\], ≥ 0.
    pub depth: f64,
    /// Which feature of the owner it is: an end of the edge that was cut (0, 1), or where the face's side cut it (2, 3).
    pub feature: u8,
}

impl From<Contact> for Manifold {
    /// A vertex alone.
    fn from(contact: Contact) -> Self {
        let Contact { owner, reference, vertex, on_face, face, depth } = contact;
        let point = Point { vertex, on_face, depth, feature: 0 };
        Manifold { owner, reference, face, depth, points: [point, Point::default()], count: 1 }
    }
}

impl Manifold {
    /// A manifold of the first `count` of two points.
    #[must_use]
    pub fn new(owner: usize, reference: usize, face: Face, depth: f64, points: [Point; 2], count: usize) -> Self {
        Manifold { owner, reference, face, depth, points, count }
    }

    /// Its one or two points.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.points[..self.count]
    }

    /// The contact at the mean of the points: where the document's exchange acts (reading R10).
    #[must_use]
    pub fn mean(&self) -> Contact {
        let share = 1.0 / self.count as f64;
        let mean = |part: fn(&Point) -> Vec2| self.points().iter().map(part).sum::<Vec2>() * share;
        Contact {
            owner: self.owner,
            reference: self.reference,
            vertex: mean(|point| point.vertex),
            on_face: mean(|point| point.on_face),
            face: self.face,
            depth: self.depth,
        }
    }
}

/// The deepest overlap between rectangles of i and of j, the first of equals; `None` when no two overlap.
/// Touching is not overlapping.
#[must_use]
pub fn find(bodies: &Bodies, i: usize, j: usize, work: &mut Work) -> Option<Manifold> {
    work.pairs_tested += 1;
    let mut deepest: Option<Manifold> = None;
    for rect_i in bodies.rects_of(i) {
        for rect_j in bodies.rects_of(j) {
            work.axes_tested += 4;
            let found = between((i, &bodies.frame[i], rect_i), (j, &bodies.frame[j], rect_j));
            if let Some(manifold) = found.filter(|found| deepest.is_none_or(|best| found.depth > best.depth)) {
                deepest = Some(manifold);
            }
        }
    }
    deepest
}

/// A rectangle of a body, with the body's index and frame.
pub type Placed<'a> = (usize, &'a Frame, &'a Rect);

/// The manifold of two rectangles that overlap.
fn between(i: Placed, j: Placed) -> Option<Manifold> {
    let on_i = least_overlap(i, j)?;
    let on_j = least_overlap(j, i)?;
    let size = i.2.half().max().min(j.2.half().max());
    let ((reference, owner), (face, depth)) =
        if on_j.1 < on_i.1 - PREFERENCE * size { ((j, i), on_j) } else { ((i, j), on_i) };
    let [first, second] = cut_to_face(reference, owner, face);
    // An end of the edge that lies outside the face does not touch; rounding may put both there.
    let (points, count) = match (first.depth >= 0.0, second.depth >= 0.0) {
        (true, true) => ([first, second], 2),
        (is_first, is_second) if is_first || (!is_second && first.depth >= second.depth) => ([first, second], 1),
        _ => ([second, first], 1),
    };
    Some(Manifold { owner: owner.0, reference: reference.0, face, depth, points, count })
}

/// The face of the reference across which the other rectangle overlaps it least, and by how much; `None` when an
/// axis of the reference separates the two.
fn least_overlap((_, frame, rect): Placed, (_, other_frame, other): Placed) -> Option<(Face, f64)> {
    let seen = other_frame.seen_from(frame);
    let d = seen.place(other.centre()) - rect.centre();
    let (cos, sin) = (seen.cos.abs(), seen.sin.abs());
    let (half, reach) = (rect.half(), other.half());
    let x = half.x + (cos * reach.x + sin * reach.y) - d.x.abs();
    let z = half.y + (sin * reach.x + cos * reach.y) - d.y.abs();
    if x <= 0.0 || z <= 0.0 {
        return None;
    }
    let size = half.max().min(reach.max());
    Some(match z < x - PREFERENCE * size {
        false => (if d.x >= 0.0 { Face::XMax } else { Face::XMin }, x),
        true => (if d.y >= 0.0 { Face::ZMax } else { Face::ZMin }, z),
    })
}

/// The owner's edge that looks at the face most squarely, cut to the face's width: its two ends.
#[must_use]
pub fn cut_to_face((_, frame, rect): Placed, (_, owner_frame, owner): Placed, face: Face) -> [Point; 2] {
    let seen = owner_frame.seen_from(frame);
    let edge = facing_edge(owner, seen.inward(face.normal()));
    let [from, to] = edge.map(|vertex| seen.place(vertex));
    let along = |p: Vec2| if matches!(face, Face::XMax | Face::XMin) { p.y } else { p.x };
    let (least, greatest) = match face {
        Face::XMax | Face::XMin => (rect.z_min, rect.z_max),
        Face::ZMax | Face::ZMin => (rect.x_min, rect.x_max),
    };
    let point = |share: f64, feature: u8| {
        let p = from + (to - from) * share;
        let vertex = edge[0] + (edge[1] - edge[0]) * share;
        Point { vertex, on_face: face.project(rect, p), depth: face.depth_of(rect, p), feature }
    };
    let (start, end) = (along(from), along(to));
    let share_at = |t: f64| ((t - start) / (end - start)).clamp(0.0, 1.0);
    let limits = |t: f64, feature: u8| match t {
        t if t < least => (share_at(least), feature + 2),
        t if t > greatest => (share_at(greatest), feature + 2),
        _ => (f64::from(feature), feature),
    };
    [limits(start, 0), limits(end, 1)].map(|(share, feature)| point(share, feature))
}

/// The edge of a rectangle whose outward normal is most against a direction, by its two ends in R4's order round.
fn facing_edge(rect: &Rect, against: Vec2) -> [Vec2; 2] {
    let [v0, v1, v2, v3] = rect.vertices();
    match (against.x.abs() >= against.y.abs(), against.x > 0.0, against.y > 0.0) {
        (true, true, _) => [v3, v0],
        (true, false, _) => [v1, v2],
        (false, _, true) => [v0, v1],
        (false, _, false) => [v2, v3],
    }
}
