//! The document's test (§2.3): a vertex of one body in a rectangle of the other.
//!
//! ```text
//!        z                     "1 against 2": the vertices of 1, brought into the frame of 2,
//!        ^  ┌───────────┐       compared with the ranges of 2
//!        │  │ 2   (X_p,Z_p)
//!        │  │      ◇────┼──     a vertex with x_min ≤ X_p ≤ x_max and z_min ≤ Z_p ≤ z_max
//!        │  └─────/─────┘       is a collision; the first one found is the one treated
//!        └───────/  1 ────> x
//! ```
//!
//! Two crossed bars with no vertex inside each other are not a collision here: a known limit of the document.

use super::{Contact, Face};
use crate::area::{Rect, Vec2};
use crate::bodies::Bodies;
use crate::work::Work;

/// The first vertex of i in j, or else the first of j in i (reading R4).
#[must_use]
pub fn find(bodies: &Bodies, i: usize, j: usize, work: &mut Work) -> Option<Contact> {
    work.pairs_tested += 1;
    one_against_two(bodies, i, j, work).or_else(|| one_against_two(bodies, j, i, work))
}

/// "1 against 2": the first vertex of `owner` that lies in `reference`.
#[inline]
fn one_against_two(bodies: &Bodies, owner: usize, reference: usize, work: &mut Work) -> Option<Contact> {
    let seen = bodies.frame[owner].seen_from(&bodies.frame[reference]);
    for rect in bodies.rects_of(owner) {
        for target in bodies.rects_of(reference) {
            work.vertices_transformed += 4;
            let places = rect.vertices().map(|vertex| seen.place(vertex));
            if let Some(first) = first_inside(target, &places) {
                let (vertex, p) = (rect.vertices()[first], places[first]);
                let (face, depth) = nearest_face(target, p);
                return Some(Contact { owner, reference, vertex, on_face: face.project(target, p), face, depth });
            }
        }
    }
    None
}

/// The first of the points that lies in the closed ranges of the rectangle. All four are looked at without a
/// branch: which one it is cannot be foreseen, and a wrong guess costs more than four comparisons.
#[inline]
fn first_inside(rect: &Rect, points: &[Vec2; 4]) -> Option<usize> {
    let inside = points.map(|p| (rect.x_min <= p.x) & (p.x <= rect.x_max) & (rect.z_min <= p.y) & (p.y <= rect.z_max));
    let bits = inside.into_iter().rev().fold(0_u8, |bits, inside| bits << 1 | u8::from(inside));
    (bits != 0).then_some(bits.trailing_zeros() as usize)
}

/// The face the point is nearest to and how far inside it lies (§2.4; reading R5: the first of equals).
#[must_use]
pub fn nearest_face(rect: &Rect, p: Vec2) -> (Face, f64) {
    let [first, rest @ ..] = Face::ALL.map(|face| (face, face.depth_of(rect, p)));
    rest.into_iter().fold(first, |least, next| if next.1 < least.1 { next } else { least })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_between_faces_go_to_the_first() {
        let square = Rect::centred(2.0, 2.0);
        assert_eq!(nearest_face(&square, Vec2::new(0.0, 0.0)), (Face::XMax, 1.0));
        assert_eq!(nearest_face(&square, Vec2::new(-0.5, -0.5)), (Face::XMin, 0.5));
        assert_eq!(nearest_face(&square, Vec2::new(0.25, -0.75)), (Face::ZMin, 0.25));
    }
}
