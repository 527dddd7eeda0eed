//! Foreseeing: when a pair touches, and whom a body that was hit may meet next.

use super::Continuous;
use super::forecast::{Pair, What};
use super::lasting::{BAND, Key};
use super::neighbours::Bounds;
use crate::bodies::{Bodies, Role};
use crate::broad_phase::bounds::sweep;
use crate::detect::manifold::Placed;
use crate::detect::touch::at_face;
use crate::detect::{overlap, seams};
use crate::flight::{Path, Pull};
use crate::impact_time::{Flier, TOUCHING, first_open_touch, first_touch};
use crate::work::Work;
use crate::world::World;

/// An overlap deeper than this share of the smaller rectangle is no touch: the two started in each other, or were put
/// there. Far above what rounding leaves after an impact, far below what can be seen.
const OVERLAPPED: f64 = 1e-9;

/// A stuck pair is looked at again no sooner than after this share of the segment.
const LEAST_WAIT: f64 = 1.0 / 64.0;

impl Continuous {
    /// Foresees the first touch of each two rectangles of a pair, within the segment.
    pub(super) fn foresee(&mut self, bodies: &Bodies, pulls: &[Pull], (i, j): (usize, usize), work: &mut Work) {
        let (i, j) = (i.min(j), i.max(j));
        let left = self.length - self.now;
        let at_present = |body: usize| {
            let path = Path::of(bodies, pulls, body);
            let late = self.now - self.since[body];
            if late > 0.0 { path.after(late) } else { path }
        };
        let (one, two) = (at_present(i), at_present(j));
        if self.stuck.binary_search(&(i as u32, j as u32)).is_ok() {
            self.watch_parting(bodies, (i, &one), (j, &two), left);
            return;
        }
        for (k, rect_i) in bodies.rects_of(i).iter().enumerate() {
            for (l, rect_j) in bodies.rects_of(j).iter().enumerate() {
                work.pairs_tested += 1;
                let depth = overlap::depth(&one.frame, rect_i, &two.frame, rect_j);
                if -depth > one.closing(&two, rect_i.far(), rect_j.far(), left) * (1.0 + 1e-12) {
                    continue;
                }
                let small = rect_i.half().min().min(rect_j.half().min());
                if depth > OVERLAPPED * small {
                    self.hold_stuck((i as u32, j as u32));
                    self.watch_parting(bodies, (i, &one), (j, &two), left);
                    return;
                }
                let key = (i as u32, j as u32, k as u32, l as u32);
                if -depth <= BAND * small {
                    self.suspect(key);
                }
                work.touches_sought += 1;
                let (a, b) = (Flier { path: one, rect: *rect_i }, Flier { path: two, rect: *rect_j });
                self.seek(bodies, key, (&a, &b), left);
            }
        }
    }

    /// Seeks the first touch of two rectangles.
    fn seek(&mut self, bodies: &Bodies, key: Key, (a, b): (&Flier, &Flier), left: f64) {
        let at = |(body, k): (u32, u32)| bodies.first_rect[body as usize] as usize + k as usize;
        let (at_a, at_b) = (at((key.0, key.2)), at((key.1, key.3)));
        let now = self.now;
        let found = if bodies.seams.concern(at_a) || bodies.seams.concern(at_b) {
            first_open_touch(a, b, left, |touch, [frame_a, frame_b]| {
                let one = Placed { body: key.0 as usize, frame: frame_a, index: at_a, rect: &a.rect };
                let two = Placed { body: key.1 as usize, frame: frame_b, index: at_b, rect: &b.rect };
                let (reference, owner) = if touch.face_of_first { (one, two) } else { (two, one) };
                let hidden = seams::hides(&bodies.seams, reference, owner, &at_face(reference, owner, touch.face));
                if hidden && self.holds_lasting {
                    self.forecast.expect(now + touch.time, 0.0, What::Look(key));
                }
                hidden
            })
        } else {
            first_touch(a, b, left)
        };
        if let Some(touch) = found {
            let scale = (a.path.frame.o - b.path.frame.o).abs().max() + a.radius() + b.radius();
            let blur = if touch.speed > 0.0 { 16.0 * TOUCHING * scale / touch.speed } else { 0.0 };
            let pair = Pair { a: key.0, b: key.1, rects: (key.2, key.3), touch };
            self.forecast.expect(now + touch.time, blur, What::Touch(pair));
        }
    }

    /// Looks again at a stuck pair when it can have parted at the earliest, or after a while.
    fn watch_parting(&mut self, bodies: &Bodies, (i, one): (usize, &Path), (j, two): (usize, &Path), left: f64) {
        let (mut deepest, parting) = (0.0_f64, one.closing(two, bodies.reach(i), bodies.reach(j), left));
        for rect_i in bodies.rects_of(i) {
            for rect_j in bodies.rects_of(j) {
                deepest = deepest.max(overlap::depth(&one.frame, rect_i, &two.frame, rect_j));
            }
        }
        if parting > deepest {
            let wait = (deepest / parting * left).max(self.length * LEAST_WAIT);
            self.forecast.expect(self.now + wait, 0.0, What::Look((i as u32, j as u32, 0, 0)));
        }
    }

    /// Two rectangles are to be looked at again: whether they have parted, or whether they are in lasting contact.
    pub(super) fn look(&mut self, world: &mut World, key: Key) {
        let pair = (key.0, key.1);
        let Ok(at) = self.stuck.binary_search(&pair) else {
            self.suspect(key);
            self.take_in(world);
            return;
        };
        for body in [pair.0, pair.1] {
            self.bring(world, body as usize);
        }
        if !holds_together(&world.bodies, pair.0 as usize, pair.1 as usize) {
            self.stuck.remove(at);
        }
        let pulls = core::mem::take(&mut self.pulls);
        self.foresee(&world.bodies, &pulls, (pair.0 as usize, pair.1 as usize), &mut world.work);
        self.pulls = pulls;
    }

    /// From now on the pair is treated once an iteration, until it parts.
    pub(super) fn hold_stuck(&mut self, key: (u32, u32)) {
        if let Err(at) = self.stuck.binary_search(&key) {
            self.stuck.insert(at, key);
        }
    }

    /// Holds anew what was struck, and foresees anew what the changed bodies will meet.
    pub(super) fn foresee_dirty(&mut self, world: &mut World) {
        self.hold_struck(world);
        while !self.dirty.is_empty() {
            let mut dirty = core::mem::take(&mut self.dirty);
            dirty.sort_unstable();
            dirty.dedup();
            let pulls = core::mem::take(&mut self.pulls);
            if self.middling.is_some() {
                self.enter_all(&world.bodies, &pulls, &dirty);
            }
            for (k, body) in dirty.iter().enumerate() {
                self.foresee_body(world, &pulls, *body as usize, &dirty[..k]);
            }
            self.pulls = pulls;
            dirty.clear();
            self.dirty = dirty;
            if !self.close.is_empty() {
                self.take_in(world);
            }
        }
    }

    /// Tells the grid where changed bodies go now: all of them before any asks for its neighbours, for two that changed at one
    /// instant may be each other's.
    fn enter_all(&mut self, bodies: &Bodies, pulls: &[Pull], changed: &[u32]) {
        let mut neighbours = core::mem::replace(&mut self.neighbours, super::Neighbours::new(1.0, 0));
        neighbours.build(bodies, |body| self.swept(bodies, pulls, body));
        for body in changed.iter().map(|body| *body as usize).filter(|body| !bodies.rects_of(*body).is_empty()) {
            neighbours.enter(body, self.swept(bodies, pulls, body));
        }
        self.neighbours = neighbours;
    }

    /// Foresees anew what one body will meet; those in `done` have seen it already.
    fn foresee_body(&mut self, world: &mut World, pulls: &[Pull], body: usize, done: &[u32]) {
        let World { bodies, work, .. } = world;
        if bodies.rects_of(body).is_empty() {
            return;
        }
        let mobile = bodies.role[body] == Role::Mobile;
        if self.middling.is_none() {
            for other in 0..bodies.len() {
                let can = other != body && (mobile || bodies.is_mobile(other)) && !bodies.rects_of(other).is_empty();
                if can && done.binary_search(&(other as u32)).is_err() {
                    self.foresee(bodies, pulls, (body, other), work);
                }
            }
            return;
        }
        let mut neighbours = core::mem::replace(&mut self.neighbours, super::Neighbours::new(1.0, 0));
        let mut found = core::mem::take(&mut self.scratch.found);
        neighbours.of(body, bodies, &mut found);
        for &other in &found {
            if (mobile || bodies.is_mobile(other as usize)) && done.binary_search(&other).is_err() {
                self.foresee(bodies, pulls, (body, other as usize), work);
            }
        }
        self.neighbours = neighbours;
        self.scratch.found = found;
    }

    /// Where a body can be from when it last changed to the segment's end.
    fn swept(&self, bodies: &Bodies, pulls: &[Pull], body: usize) -> Bounds {
        let path = Path::of(bodies, pulls, body);
        let time = self.length - self.since[body];
        let all = bodies.rects_of(body).iter().map(|rect| sweep(&path, rect, time));
        let (low, high) = all.reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1))).unwrap_or((path.frame.o, path.frame.o));
        let slack = 1e-12 * (low.abs() + high.abs());
        Bounds { low: low - slack, high: high + slack }
    }
}

/// Whether a stuck pair is one still: it overlaps, or stands at the other's face.
pub(super) fn holds_together(bodies: &Bodies, i: usize, j: usize) -> bool {
    overlap::between(bodies, i, j) > OVERLAPPED * bodies.smallest_half(i).min(bodies.smallest_half(j))
}
