//! When and where the two rectangles of a touch meet.

use super::touch::Touch;
use crate::area::Rect;
use crate::bodies::Bodies;
use crate::detect::manifold::{Manifold, Placed, Point};
use crate::detect::near::{Before, meet};
use crate::detect::touch::at_face;
use crate::detect::{overlap, seams};
use crate::flight::Path;
use crate::frame::Frame;
use crate::impact_time::{Flier, Touch as Found, first_open_touch};
use crate::world::World;

/// Rectangles deeper in each other than this share of the smaller one do not come to touch any more; they are parted.
const OVERLAPPED: f64 = 1e-9;

/// The two rectangles of a touch, the reference first, with their bodies.
pub(super) struct Two<'a> {
    bodies: &'a Bodies,
    body: [usize; 2],
    index: [usize; 2],
}

impl<'a> Two<'a> {
    pub(super) fn of(bodies: &'a Bodies, touch: &Touch) -> Two<'a> {
        let (one, two) = (touch.rects.0 as usize, touch.rects.1 as usize);
        let index = if touch.of_first { [one, two] } else { [two, one] };
        Two { bodies, body: [touch.a as usize, touch.b as usize], index }
    }

    fn rect(&self, which: usize) -> &'a Rect {
        &self.bodies.rects[self.index[which]]
    }

    pub(super) fn placed<'b>(&self, frames: [&'b Frame; 2]) -> [Placed<'b>; 2]
    where
        'a: 'b,
    {
        [0, 1].map(|k| Placed { body: self.body[k], frame: frames[k], index: self.index[k], rect: self.rect(k) })
    }

    /// The contact at the face that a search found.
    fn contact(&self, found: &Found, frames: [&Frame; 2]) -> (bool, Manifold) {
        let [one, two] = self.placed(frames);
        let (reference, owner) = if found.face_of_first { (one, two) } else { (two, one) };
        let manifold = at_face(reference, owner, found.face);
        (seams::hides(&self.bodies.seams, reference, owner, &manifold), manifold)
    }
}

/// When and where the two rectangles of a touch meet within a time: at once where they overlap.
pub(super) fn meeting(world: &mut World, touch: &Touch, paths: &[Path; 2], left: f64) -> Option<(f64, Manifold)> {
    let two = Two::of(&world.bodies, touch);
    let small = two.rect(0).half().min().min(two.rect(1).half().min());
    let depth = overlap::depth(&paths[0].frame, two.rect(0), &paths[1].frame, two.rect(1));
    if depth > OVERLAPPED * small {
        let before = Before { of_first: true, face: touch.face, normal: touch.n };
        let [one, other] = two.placed([&paths[0].frame, &paths[1].frame]);
        let manifold = meet(&world.bodies, (one, other), 0.0, Some(&before), |body| world.bodies.frame[body])?;
        return Some((0.0, manifold));
    }
    world.work.touches_sought += 1;
    let [a, b] = [0, 1].map(|k| Flier { path: paths[k], rect: *two.rect(k) });
    let found = first_open_touch(&a, &b, left, |found, frames| two.contact(found, frames).0)?;
    let frames = paths.map(|path| path.after(found.time).frame);
    Some((found.time, two.contact(&found, [&frames[0], &frames[1]]).1))
}

/// Where two rectangles will meet soon, taken to meet there at once: those of their points that `come`.
pub(super) fn meeting_now(world: &World, touch: &Touch, frames: [&Frame; 2], come: [bool; 2]) -> Option<Manifold> {
    let two = Two::of(&world.bodies, touch);
    let [one, other] = two.placed(frames);
    let before = Before { of_first: true, face: touch.face, normal: touch.n };
    let margin = one.rect.half().min() + other.rect.half().min();
    let found = meet(&world.bodies, (one, other), margin, Some(&before), |body| world.bodies.frame[body])?;
    let of_end = |point: &Point| touch.ends.iter().position(|end| *end == point.feature & 1);
    let mut points = [Point::default(); 2];
    let mut count = 0;
    for point in found.points().iter().filter(|point| of_end(point).is_none_or(|at| come[at])) {
        points[count] = *point;
        count += 1;
    }
    (count > 0).then(|| Manifold::new(found.owner, found.reference, found.face, found.depth, points, count))
}
