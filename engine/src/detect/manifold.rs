//! Where two bodies touch: one or two points at a face.

use super::{Contact, Face};
use crate::area::{Rect, Vec2};
use crate::bodies::Bodies;
use crate::frame::Frame;

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

/// A rectangle of a body where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The body.
    pub body: usize,
    /// Where it stands.
    pub frame: &'a Frame,
    /// Which rectangle, by its index among those of all bodies.
    pub index: usize,
    /// The rectangle, in the body's frame.
    pub rect: &'a Rect,
}

impl<'a> Placed<'a> {
    /// The k-th rectangle of a body.
    #[must_use]
    pub fn of(bodies: &'a Bodies, body: usize, k: usize) -> Placed<'a> {
        let index = bodies.first_rect[body] as usize + k;
        Placed { body, frame: &bodies.frame[body], index, rect: &bodies.rects[index] }
    }

    /// Every rectangle of a body, where it stands.
    pub fn all(bodies: &'a Bodies, body: usize) -> impl Iterator<Item = Placed<'a>> {
        (0..bodies.rects_of(body).len()).map(move |k| Placed::of(bodies, body, k))
    }
}

/// The owner's edge that looks at the face most squarely, cut to the face's width: its two ends.
#[must_use]
pub fn cut_to_face(reference: Placed, owner: Placed, face: Face) -> [Point; 2] {
    let rect = reference.rect;
    let seen = owner.frame.seen_from(reference.frame);
    let edge = facing_edge(owner.rect, seen.inward(face.normal()));
    let placed = edge.map(|vertex| seen.place(vertex));
    let (least, greatest) = face.width(rect);
    // Each end is cut from its own side: an end that is whole is the vertex to the bit, and mirror images stay so.
    [0, 1].map(|end| {
        let (near, far) = (end, 1 - end);
        let (t, other) = (face.along(placed[near]), face.along(placed[far]));
        let share_to = |limit: f64| ((limit - t) / (other - t)).clamp(0.0, 1.0);
        let (share, feature) = match t {
            t if t < least => (share_to(least), end + 2),
            t if t > greatest => (share_to(greatest), end + 2),
            _ => (0.0, end),
        };
        let p = placed[near] + (placed[far] - placed[near]) * share;
        let vertex = edge[near] + (edge[far] - edge[near]) * share;
        Point { vertex, on_face: face.project(rect, p), depth: face.depth_of(rect, p), feature: feature as u8 }
    })
}

/// From where to where that edge reaches along the face, uncut, in the order of its ends \[m\].
pub(crate) fn edge_along(reference: Placed, owner: Placed, face: Face) -> (f64, f64) {
    let seen = owner.frame.seen_from(reference.frame);
    let [one, two] = facing_edge(owner.rect, seen.inward(face.normal())).map(|vertex| face.along(seen.place(vertex)));
    (one.min(two), one.max(two))
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
