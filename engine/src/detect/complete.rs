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
//!
//! Two things overrule the least overlap: a pair that was apart an iteration ago is parted the way it came, and goes on
//! being parted that way ([`super::sides`]); and a face that lies inside what rectangles make up together is none
//! ([`super::seams`]).

use super::Face;
use super::manifold::{Manifold, Placed, cut_to_face};
use super::seams;
use super::sides::{ALONG, Sides};
use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::frame::Frame;
use crate::work::Work;

/// By how much a later axis must beat an earlier one, relative to the rectangles' size. Far above rounding (1e-16)
/// and far below what can be seen: without it two squares that meet face to face would choose by rounding, and the
/// normal could change from step to step.
pub(crate) const PREFERENCE: f64 = 1e-9;

/// The deepest overlap between rectangles of i and of j, the first of equals; `None` when no two overlap.
/// Touching is not overlapping.
#[must_use]
pub fn find(bodies: &Bodies, i: usize, j: usize, sides: &Sides, work: &mut Work) -> Option<Manifold> {
    work.pairs_tested += 1;
    let mut deepest: Option<Manifold> = None;
    for one in Placed::all(bodies, i) {
        for two in Placed::all(bodies, j) {
            work.axes_tested += 4;
            let found = between(bodies, one, two, sides.of(one.index, two.index));
            if let Some(manifold) = found.filter(|found| deepest.is_none_or(|best| found.depth > best.depth)) {
                deepest = Some(manifold);
            }
        }
    }
    deepest
}

/// Whether any two rectangles of i and j overlap; of those that do, remembers from which side they came together.
/// `earlier` tells where a body stood an iteration ago.
pub fn list(
    bodies: &Bodies,
    (i, j): (usize, usize),
    sides: &mut Sides,
    earlier: impl Fn(usize) -> Frame,
    work: &mut Work,
) -> bool {
    work.pairs_tested += 1;
    let mut any = false;
    for one in Placed::all(bodies, i) {
        for two in Placed::all(bodies, j) {
            work.axes_tested += 4;
            let Some(ways) = Way::all(one, two) else { continue };
            any = true;
            let were = (earlier(i), earlier(j));
            let (was_one, was_two) = (Placed { frame: &were.0, ..one }, Placed { frame: &were.1, ..two });
            let came = entered(&ways, (one, two), (was_one, was_two)).or_else(|| sides.before(one.index, two.index));
            sides.note(one.index, two.index, came);
        }
    }
    any
}

/// A way to part two rectangles: across a face of one of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Whether the face is one of the first rectangle.
    pub(super) of_first: bool,
    pub(super) face: Face,
    /// Overlap along the face's normal \[m\]; negative where it separates.
    pub(super) depth: f64,
}

impl Way {
    /// The four ways, in the order that breaks ties.
    pub(super) fn each(i: Placed, j: Placed) -> [Way; 4] {
        let ([ix, iz], [jx, jz]) = (ways_across(true, i, j), ways_across(false, j, i));
        [ix, iz, jx, jz]
    }

    /// The same; `None` when one of them separates the two.
    fn all(i: Placed, j: Placed) -> Option<[Way; 4]> {
        let all = Way::each(i, j);
        all.iter().all(|way| way.depth > 0.0).then_some(all)
    }

    /// The same axis with the face on the given side of the reference, for two rectangles as they stand.
    fn towards(self, positive: bool, i: Placed, j: Placed) -> Way {
        if self.face.is_positive() == positive {
            return self;
        }
        let (reference, owner) = if self.of_first { (i, j) } else { (j, i) };
        let from_centre = owner.frame.seen_from(reference.frame).place(owner.rect.centre()) - reference.rect.centre();
        let d = from_centre.dot(&self.face.normal());
        Way { face: self.face.opposite(), depth: self.depth + 2.0 * d, ..self }
    }

    /// The face's normal in the world, from the first rectangle to the second.
    fn normal(&self, i: Placed, j: Placed) -> Vec2 {
        if self.of_first { i.frame.outward(self.face.normal()) } else { -j.frame.outward(self.face.normal()) }
    }
}

/// The faces of the reference along x and along z that are nearer to the other rectangle, and the overlaps there.
fn ways_across(of_first: bool, reference: Placed, owner: Placed) -> [Way; 2] {
    let seen = owner.frame.seen_from(reference.frame);
    let d = seen.place(owner.rect.centre()) - reference.rect.centre();
    let (cos, sin) = (seen.cos.abs(), seen.sin.abs());
    let (half, reach) = (reference.rect.half(), owner.rect.half());
    let x = half.x + (cos * reach.x + sin * reach.y) - d.x.abs();
    let z = half.y + (sin * reach.x + cos * reach.y) - d.y.abs();
    [
        Way { of_first, face: if d.x >= 0.0 { Face::XMax } else { Face::XMin }, depth: x },
        Way { of_first, face: if d.y >= 0.0 { Face::ZMax } else { Face::ZMin }, depth: z },
    ]
}

/// The manifold of two rectangles that overlap, parted the way they came where that is known.
fn between(bodies: &Bodies, i: Placed, j: Placed, came: Option<Vec2>) -> Option<Manifold> {
    let ways = Way::all(i, j)?;
    let mut open = ways.map(|way| came.map_or(Some(way), |normal| along(way, normal, i, j)));
    if open.iter().all(Option::is_none) {
        open = ways.map(Some);
    }
    while let Some(k) = least(&open, i, j) {
        let way = open[k].take()?;
        let (reference, owner) = if way.of_first { (i, j) } else { (j, i) };
        let manifold = manifold(reference, owner, way);
        if !seams::hides(&bodies.seams, reference, owner, &manifold) {
            return Some(manifold);
        }
    }
    None
}

/// The way as it leads in the direction the two came; `None` when its axis runs across that.
pub(super) fn along(way: Way, normal: Vec2, i: Placed, j: Placed) -> Option<Way> {
    let share = way.normal(i, j).dot(&normal);
    (share.abs() > ALONG).then(|| way.towards(way.face.is_positive() == (share > 0.0), i, j))
}

/// The way of least overlap, the first of equals.
fn least(ways: &[Option<Way>; 4], i: Placed, j: Placed) -> Option<usize> {
    let margin = PREFERENCE * i.rect.half().max().min(j.rect.half().max());
    let mut best: Option<(usize, f64)> = None;
    for (k, way) in ways.iter().enumerate() {
        if let Some(way) = way.filter(|way| best.is_none_or(|(_, depth)| way.depth < depth - margin)) {
            best = Some((k, way.depth));
        }
    }
    best.map(|(k, _)| k)
}

/// One or two points at the face of a way.
fn manifold(reference: Placed, owner: Placed, way: Way) -> Manifold {
    let [first, second] = cut_to_face(reference, owner, way.face);
    // An end of the edge that lies outside the face does not touch; rounding may put both there.
    let (points, count) = match (first.depth >= 0.0, second.depth >= 0.0) {
        (true, true) => ([first, second], 2),
        (is_first, is_second) if is_first || (!is_second && first.depth >= second.depth) => ([first, second], 1),
        _ => ([second, first], 1),
    };
    Manifold::new(owner.body, reference.body, way.face, way.depth, points, count)
}

/// The normal of the face across which two rectangles came to overlap, from the first to the second: of the axes that
/// separated them where they stood before, the one that ceased to last. `None` when none did.
pub(super) fn entered(ways: &[Way; 4], (i, j): (Placed, Placed), (was_i, was_j): (Placed, Placed)) -> Option<Vec2> {
    let before = Way::each(was_i, was_j);
    let mut latest: Option<(f64, Vec2)> = None;
    for (was, now) in before.iter().zip(ways) {
        if was.depth >= 0.0 {
            continue;
        }
        let now = now.towards(was.face.is_positive(), i, j);
        let share = -was.depth / (now.depth - was.depth);
        if latest.is_none_or(|(best, _)| share > best) {
            latest = Some((share, was.normal(was_i, was_j)));
        }
    }
    latest.map(|(_, normal)| normal)
}
