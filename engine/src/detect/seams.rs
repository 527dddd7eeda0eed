//! Seams: faces, or parts of them, that lie inside what several rectangles make up together.
//!
//! ```text
//!        n ^                  A floor of boxes is one floor: the sides at which they adjoin cannot be hit, and where two
//!     ┌────┴───┬────────┐     tops are level the corners between them are no corners. The same holds of the rectangles
//!     │        │ seam   │     of a compound body.
//!     └────────┴────────┘
//! ```
//!
//! Found once, at load, among the rectangles of each body and among the fixed bodies without physics. A contact is
//! hidden by a seam when all its points lie on a covered part of the face, or when its normal leans towards a covered face
//! of the rectangle whose vertices they are: what covers that face would be hit before.

use super::Face;
use super::manifold::{Manifold, Placed};
use crate::area::Vec2;
use crate::bodies::{Bodies, Role};

/// Rectangles closer than this share of the smaller one adjoin, and a strip of a face thinner than that is nothing. Far above
/// what rounding leaves between boxes laid side by side, far below what can be seen.
const SEAM: f64 = 1e-9;

/// A part of a face, covered by a rectangle of some body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    /// Four times the rectangle, and which of its faces.
    face: u32,
    by: u32,
    from: f64,
    to: f64,
}

/// All seams of a scene; empty when there is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seams {
    /// In the order of the faces, then of the bodies that cover them.
    spans: Vec<Span>,
    /// A bit for each rectangle up to the last that has a face covered anywhere.
    concerned: Vec<u64>,
}

impl Seams {
    /// How many parts of faces are covered.
    #[must_use]
    pub fn count(&self) -> usize {
        self.spans.len()
    }

    /// Whether the rectangle has a face that is covered anywhere.
    #[must_use]
    pub fn concern(&self, rect: usize) -> bool {
        self.concerned.get(rect / 64).is_some_and(|bits| bits >> (rect % 64) & 1 == 1)
    }

    /// Whether a face is covered at a place along it: within a span, or at the end of the face that a span reaches. At the
    /// end of a span inside the face, where something stands on it, there is a corner that can be hit.
    fn covers(&self, of: Placed, face: Face, at: f64, margin: f64) -> bool {
        let key = 4 * of.index as u32 + face as u32;
        let first = self.spans.partition_point(|span| span.face < key);
        let mut spans = self.spans[first..].iter().take_while(|span| span.face == key);
        let (start, end) = face.width(of.rect);
        let from = |span: &Span| if span.from <= start + margin { start - margin } else { span.from + margin };
        let to = |span: &Span| if span.to >= end - margin { end + margin } else { span.to - margin };
        spans.any(|span| from(span) <= at && at <= to(span))
    }

    /// Finds the seams of all bodies where they stand.
    #[must_use]
    pub fn of(bodies: &Bodies) -> Seams {
        let mut spans: Vec<Span> = Vec::new();
        let mut each = |one: Placed, two: Placed| {
            for (a, b) in [(one, two), (two, one)] {
                spans.extend(Face::ALL.into_iter().filter_map(|face| covered(a, face, b)));
            }
        };
        for body in 0..bodies.len() {
            let rects: Vec<Placed> = Placed::all(bodies, body).collect();
            for (k, one) in rects.iter().enumerate() {
                rects[k + 1..].iter().for_each(|two| each(*one, *two));
            }
        }
        adjoining_fixed(bodies, &mut each);
        spans.sort_by_key(|span| (span.face, span.by));
        Seams::new(spans)
    }

    fn new(spans: Vec<Span>) -> Seams {
        let mut concerned = Vec::new();
        for rect in spans.iter().map(|span| span.face as usize / 4) {
            concerned.resize(concerned.len().max(rect / 64 + 1), 0);
            concerned[rect / 64] |= 1 << (rect % 64);
        }
        Seams { spans, concerned }
    }

    /// A fixed body begins to move: it covers nothing of others any more, nor others of it.
    pub fn part(&mut self, bodies: &Bodies, body: usize) {
        let own = bodies.first_rect[body]..bodies.first_rect[body + 1];
        self.spans.retain(|span| own.contains(&(span.face / 4)) == (span.by as usize == body));
        *self = Seams::new(core::mem::take(&mut self.spans));
    }
}

/// Shows each two rectangles of different fixed bodies without physics that may adjoin: a sweep along x.
fn adjoining_fixed(bodies: &Bodies, each: &mut impl FnMut(Placed, Placed)) {
    let fixed = (0..bodies.len()).filter(|body| bodies.role[*body] == Role::Fixed);
    let mut all: Vec<(f64, f64, Placed)> = fixed
        .flat_map(|body| Placed::all(bodies, body))
        .map(|placed| {
            let centre = placed.frame.place(placed.rect.centre()).x;
            let (half, slack) = (placed.rect.half(), 1.0 + 4.0 * SEAM);
            let reach = (placed.frame.cos.abs() * half.x + placed.frame.sin.abs() * half.y) * slack;
            (centre - reach, centre + reach, placed)
        })
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.index.cmp(&b.2.index)));
    for (k, (_, end, one)) in all.iter().enumerate() {
        let near = all[k + 1..].iter().take_while(|(start, ..)| start <= end);
        near.filter(|(.., two)| two.body != one.body).for_each(|(.., two)| each(*one, *two));
    }
}

/// The part of a face that another rectangle covers: where a line just outside of it runs within that rectangle.
fn covered(of: Placed, face: Face, by: Placed) -> Option<Span> {
    let small = of.rect.half().min().min(by.rect.half().min());
    let (start, end) = face.width(of.rect);
    let outside = face.normal() * (SEAM * small);
    let seen = of.frame.seen_from(by.frame);
    let at = |along: f64| seen.place(face.place(of.rect, along) + outside);
    let (p, way) = (at(start), at(end) - at(start));
    let rect = by.rect;
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for (p, way, least, greatest) in [(p.x, way.x, rect.x_min, rect.x_max), (p.y, way.y, rect.z_min, rect.z_max)] {
        if way.abs() <= SEAM * small {
            if p < least || p > greatest {
                return None;
            }
            continue;
        }
        let (one, two) = ((least - p) / way, (greatest - p) / way);
        (low, high) = (low.max(one.min(two)), high.min(one.max(two)));
    }
    let length = end - start;
    ((high - low) * length > SEAM * small).then_some(Span {
        face: 4 * of.index as u32 + face as u32,
        by: by.body as u32,
        from: start + low * length,
        to: start + high * length,
    })
}

/// Whether a contact lies inside what rectangles make up together, where nothing can be hit.
#[must_use]
pub fn hides(seams: &Seams, reference: Placed, owner: Placed, contact: &Manifold) -> bool {
    if !seams.concern(reference.index) && !seams.concern(owner.index) {
        return false;
    }
    let margin = 4.0 * SEAM * reference.rect.half().min().min(owner.rect.half().min());
    let points = contact.points();
    let face = contact.face;
    let middle = contact.mean().on_face;
    let on_seam = seams.concern(reference.index)
        && points
            .iter()
            .map(|p| p.on_face)
            .chain([middle])
            .all(|p| seams.covers(reference, face, face.along(p), margin));
    let against = -owner.frame.inward(reference.frame.outward(contact.face.normal()));
    on_seam
        || (seams.concern(owner.index) && {
            let lean = |face: Face| face.normal().dot(&against) > SEAM;
            let at = |face: Face, p: Vec2| face.depth_of(owner.rect, p).abs() <= margin;
            let hidden = |face: Face, p: Vec2| at(face, p) && seams.covers(owner, face, face.along(p), margin);
            points.iter().all(|p| Face::ALL.into_iter().any(|face| lean(face) && hidden(face, p.vertex)))
        })
}
