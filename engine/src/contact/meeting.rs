//! When and where the two rectangles of a touch meet.

use super::touch::Touch;
use crate::area::Rect;
use crate::bodies::{Bodies, Motion};
use crate::detect::manifold::{Manifold, Placed, Point};
use crate::detect::near::{Before, meet};
use crate::detect::touch::at_face;
use crate::detect::{Face, overlap, seams};
use crate::flight::{Change, Path};
use crate::frame::Frame;
use crate::impact_time::{Flier, Touch as Found, first_open_touch};
use crate::world::World;

/// Rectangles deeper in each other than this share of the smaller one do not come to touch any more; they are parted.
const OVERLAPPED: f64 = 1e-9;

/// At which face two rectangles meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    of_first: bool,
    face: Face,
}

impl Way {
    fn of(found: &Found) -> Way {
        Way { of_first: found.face_of_first, face: found.face }
    }
}

/// Two rectangles with their bodies: of a touch, the reference first, or any.
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

    /// Of those bodies, the rectangles of those indices.
    pub(super) fn between(bodies: &'a Bodies, [one, two]: [(usize, usize); 2]) -> Two<'a> {
        Two { bodies, body: [one.0, two.0], index: [one.1, two.1] }
    }

    /// How deep they are in each other.
    pub(super) fn depth(&self, paths: &[Path; 2]) -> f64 {
        overlap::depth(&paths[0].frame, self.rect(0), &paths[1].frame, self.rect(1))
    }

    /// How deep they may be in each other and come to touch yet.
    fn least_depth(&self) -> f64 {
        OVERLAPPED * self.rect(0).half().min().min(self.rect(1).half().min())
    }

    /// Whether they are in each other, and do not come to touch any more.
    pub(super) fn overlap(&self, paths: &[Path; 2]) -> bool {
        self.depth(paths) > self.least_depth()
    }

    /// When and where they meet within a time, as their bodies fly; `None` where they overlap already.
    pub(super) fn meet(&self, paths: &[Path; 2], left: f64) -> Option<(f64, Manifold)> {
        let (time, way) = if self.overlap(paths) { None } else { self.way(paths, left) }?;
        Some((time, self.met(paths, (time, way))))
    }

    /// When and how they meet within a time, where they do not overlap.
    pub(super) fn way(&self, paths: &[Path; 2], left: f64) -> Option<(f64, Way)> {
        let [a, b] = [0, 1].map(|k| Flier { path: paths[k], rect: *self.rect(k) });
        let hides = |found: &Found, frames: [&Frame; 2]| self.contact(Way::of(found), frames).0;
        let found = first_open_touch(&a, &b, left, hides)?;
        Some((found.time, Way::of(&found)))
    }

    /// Where they touch once they have met so.
    pub(super) fn met(&self, paths: &[Path; 2], (time, way): (f64, Way)) -> Manifold {
        let frames = paths.map(|path| path.after(time).frame);
        self.contact(way, [&frames[0], &frames[1]]).1
    }

    /// The touch of the moment at which they meet, as if counted from when their bodies set out on their paths.
    pub(super) fn touch_at(&self, paths: &[Path; 2], time: f64, manifold: &Manifold) -> Touch {
        let frames = paths.map(|path| path.after(time).frame);
        let [one, two] = self.placed([&frames[0], &frames[1]]);
        let of_first = manifold.reference == one.body;
        let mut touch = Touch::of(self.bodies, if of_first { (one, two) } else { (two, one) }, manifold);
        touch.of_first = of_first;
        touch.rects = (one.index as u32, two.index as u32);
        let come = paths.map(|path| {
            let Change { shift, turn, motion: Motion { v, omega } } = path.change(time);
            [v.x, v.y, omega, shift.x, shift.y, turn, 0.0, 0.0]
        });
        let (a, b) = if of_first { (&come[0], &come[1]) } else { (&come[1], &come[0]) };
        touch.count_from(a, b);
        touch
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

    /// The contact at the face at which they meet, and whether a seam hides it.
    fn contact(&self, way: Way, frames: [&Frame; 2]) -> (bool, Manifold) {
        let [one, two] = self.placed(frames);
        let (reference, owner) = if way.of_first { (one, two) } else { (two, one) };
        let manifold = at_face(reference, owner, way.face);
        (seams::hides(&self.bodies.seams, reference, owner, &manifold), manifold)
    }
}

/// When and where the two rectangles of a touch meet within a time: at once where they overlap.
pub(super) fn meeting(world: &mut World, touch: &Touch, paths: &[Path; 2], left: f64) -> Option<(f64, Manifold)> {
    let two = Two::of(&world.bodies, touch);
    if two.overlap(paths) {
        let before = Before { of_first: true, face: touch.face, normal: touch.n };
        let [one, other] = two.placed([&paths[0].frame, &paths[1].frame]);
        let manifold = meet(&world.bodies, (one, other), 0.0, Some(&before), |body| world.bodies.frame[body])?;
        return Some((0.0, manifold));
    }
    world.work.touches_sought += 1;
    let (time, way) = two.way(paths, left)?;
    Some((time, two.met(paths, (time, way))))
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
