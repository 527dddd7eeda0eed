//! Foreseeing: when a pair touches, and whom a body that was hit may meet next.

use super::forecast::{Pair, What};
use super::neighbours::Bounds;
use super::{Continuous, rest};
use crate::bodies::{Bodies, Role};
use crate::broad_phase::bounds::sweep;
use crate::detect::overlap;
use crate::flight::{Path, Pull};
use crate::impact_time::{Flier, TOUCHING, first_touch};
use crate::work::Work;
use crate::world::World;

/// An overlap deeper than this share of the smaller rectangle is no touch: the two started in each other, or were put
/// there. Far above what rounding leaves after an impact, far below what can be seen.
const OVERLAPPED: f64 = 1e-9;

impl Continuous {
    /// Foresees the first touch of each two rectangles of a pair, within the segment.
    pub(super) fn foresee(&mut self, bodies: &Bodies, pulls: &[Pull], (i, j): (usize, usize), work: &mut Work) {
        let key = (i.min(j) as u32, i.max(j) as u32);
        if self.stuck.binary_search(&key).is_ok() {
            return;
        }
        let (i, j) = (key.0 as usize, key.1 as usize);
        let left = self.length - self.now;
        let at_present = |body: usize| {
            let path = Path::of(bodies, pulls, body);
            let late = self.now - self.since[body];
            if late > 0.0 { path.after(late) } else { path }
        };
        let (one, two) = (at_present(i), at_present(j));
        for (k, rect_i) in bodies.rects_of(i).iter().enumerate() {
            for (l, rect_j) in bodies.rects_of(j).iter().enumerate() {
                work.pairs_tested += 1;
                let depth = overlap::depth(&one.frame, rect_i, &two.frame, rect_j);
                if -depth > one.closing(&two, rect_i.far(), rect_j.far(), left) * (1.0 + 1e-12) {
                    continue;
                }
                let small = rect_i.half().min().min(rect_j.half().min());
                if depth > OVERLAPPED * small {
                    self.hold_stuck(key);
                    return;
                }
                work.touches_sought += 1;
                let (a, b) = (Flier { path: one, rect: *rect_i }, Flier { path: two, rect: *rect_j });
                if let Some(touch) = first_touch(&a, &b, left) {
                    if touch.speed < rest::REST_SPEED && self.resting.binary_search(&key).is_ok() {
                        continue; // it is held there
                    }
                    let scale = (one.frame.o - two.frame.o).abs().max() + rect_i.radius() + rect_j.radius();
                    let blur = if touch.speed > 0.0 { 16.0 * TOUCHING * scale / touch.speed } else { 0.0 };
                    let pair = Pair { a: key.0, b: key.1, rects: (k as u32, l as u32), touch };
                    self.forecast.expect(self.now + touch.time, blur, What::Touch(pair));
                }
            }
        }
    }

    /// From now on the pair is treated once an iteration, until it parts.
    pub(super) fn hold_stuck(&mut self, key: (u32, u32)) {
        if let Err(at) = self.stuck.binary_search(&key) {
            self.stuck.insert(at, key);
        }
    }

    /// Foresees anew what the changed bodies will meet.
    pub(super) fn foresee_dirty(&mut self, world: &mut World) {
        if self.dirty.is_empty() {
            return;
        }
        let mut dirty = core::mem::take(&mut self.dirty);
        dirty.sort_unstable();
        dirty.dedup();
        let pulls = core::mem::take(&mut self.pulls);
        for (k, body) in dirty.iter().enumerate() {
            self.foresee_body(world, &pulls, *body as usize, &dirty[..k]);
        }
        self.pulls = pulls;
        dirty.clear();
        self.dirty = dirty;
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
        neighbours.build(bodies, |other| self.swept(bodies, pulls, other));
        neighbours.enter(body, self.swept(bodies, pulls, body));
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
    let smallest = |body: usize| bodies.rects_of(body).iter().map(|r| r.half().min()).fold(f64::INFINITY, f64::min);
    overlap::between(bodies, i, j) > OVERLAPPED * smallest(i).min(smallest(j))
}
