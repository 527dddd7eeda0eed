//! Whom a fast body meets next.

use super::Contacts;
use super::fast::{Followed, Foreseen, Meets};
use super::strike::MOST_STRIKES;
use crate::area::Vec2;
use crate::broad_phase::bounds::sweep;
use crate::broad_phase::met::Bounds;
use crate::flight::Path;
use crate::world::World;

/// A pair meets no more often than this within that share of a step: corner after corner where it lands flat. What goes on coming
/// is left to the pushes.
const CORNERS: usize = 8;
const AGAIN: f64 = 1e-9;

/// Two that touch and come towards each other by less than this share of half the size of the smaller are left to the pushes.
const SLOW: f64 = 0.1;

/// Circles that come closer than this many times their radii may overlap, in spite of rounding.
const SURE: f64 = 1.0 + 1e-6;

/// Where a body's centre is at a time of the sub-step, how it moves, and how fast that changes at most \[m/s²\].
struct Glance {
    o: Vec2,
    v: Vec2,
    time: f64,
    pulled: f64,
}

impl Contacts {
    /// Finds out whom fast bodies meet next, where that is not known.
    pub(super) fn foresee(&mut self, world: &mut World, h: f64) {
        self.fast.by_row.go_on(self.of_touch.iter().copied(), self.rows.rows.len());
        let is_unknown = |followed: &Followed| matches!(followed.next, Foreseen::NotYet);
        for at in 0..self.fast.followed.len() {
            let followed = self.fast.followed[at];
            if is_unknown(&followed) {
                let (swept, strays) = self.sweep_of(world, followed.row, h);
                self.fast.followed[at] = Followed { swept, strays, ..followed };
            }
        }
        for at in 0..self.fast.followed.len() {
            if is_unknown(&self.fast.followed[at]) {
                let found = self.next_of(world, at, h);
                self.fast.followed[at].next = found.map_or(Foreseen::Nobody, Foreseen::This);
            }
        }
    }

    /// All that the body of a row sweeps over in what is left of the sub-step, and whether it leaves what it was taken to sweep over
    /// when the step began.
    fn sweep_of(&self, world: &World, row: u32, h: f64) -> (Bounds, bool) {
        let (mut swept, mut strays) = (Bounds::NOTHING, false);
        let Some(body) = self.rows.body_of(row) else { return (swept, strays) };
        let (path, left) = (self.path_of(world, body), h - self.fliers.spent[row as usize]);
        for rect in world.bodies.first_rect[body]..world.bodies.first_rect[body + 1] {
            let (low, high) = sweep(&path, &world.bodies.rects[rect as usize], left);
            let bounds = Bounds([low.x, low.y, high.x, high.y]);
            strays |= !self.search.foresaw(rect, bounds);
            swept = swept.and(bounds);
        }
        (swept, strays)
    }

    /// Whom one of the fast bodies meets next within the sub-step, as all fly by now.
    fn next_of(&mut self, world: &mut World, at: usize, h: f64) -> Option<Meets> {
        let Followed { row, .. } = self.fast.followed[at];
        let body = self.rows.body_of(row)?;
        let (spent, path) = (self.fliers.spent[row as usize], self.path_of(world, body));
        let mut near = core::mem::take(&mut self.fast.near);
        let mut first: Option<Meets> = None;
        for rect in world.bodies.first_rect[body]..world.bodies.first_rect[body + 1] {
            let (low, high) = sweep(&path, &world.bodies.rects[rect as usize], h - spent);
            let bounds = Bounds([low.x, low.y, high.x, high.y]);
            near.clear();
            self.search.around((rect, bounds), world.plan.broad_phase, &mut near, &mut world.work);
            self.add_strays(world, (at, body), &mut near);
            near.sort_unstable();
            near.dedup();
            for other in &near {
                let rects = (rect.min(*other), rect.max(*other));
                let until = first.map_or(h, |first| first.time);
                if let Some(time) = self.meets_fast(world, rects, until) {
                    first = Some(Meets { time, rects });
                }
            }
        }
        self.fast.near = near;
        first
    }

    /// Adds the rectangles of fast bodies that are elsewhere than was foreseen when the step began; or where a body has met others so
    /// often that it is left to the pushes, leaves only what is fixed.
    fn add_strays(&self, world: &World, (at, body): (usize, usize), near: &mut Vec<u32>) {
        let (own, bodies) = (&self.fast.followed[at], &world.bodies);
        if own.strikes >= MOST_STRIKES {
            near.retain(|other| !bodies.is_mobile(self.search.body_of(*other)));
            return;
        }
        for stray in self.fast.followed.iter().filter(|other| other.strays && other.swept.meet(&own.swept)) {
            let Some(other) = self.rows.body_of(stray.row).filter(|other| *other != body) else { continue };
            if bodies.is_mobile(other) || bodies.is_mobile(body) {
                near.extend(bodies.first_rect[other]..bodies.first_rect[other + 1]);
            }
        }
    }

    /// When two rectangles meet, before a time of the sub-step.
    fn meets_fast(&self, world: &mut World, rects: (u32, u32), until: f64) -> Option<f64> {
        if !self.come_near(world, rects, until) {
            return None;
        }
        let (from, paths) = self.paths_together(world, rects);
        if self.touch_of(rects).is_some_and(|k| {
            self.is_pressing(world, k, &paths) || are_slow_together(world, rects, &paths, until - from)
        }) {
            return None;
        }
        world.work.touches_sought += 1;
        let time = from + self.two(world, rects).meet(&paths, until - from)?.0;
        let just_now = self.fast.met.iter().rev().take_while(|met| met.time + AGAIN * self.dt >= time);
        (time < until && just_now.filter(|met| met.rects == rects).count() < CORNERS).then_some(time)
    }

    /// Whether circles around two rectangles overlap at any time of the sub-step up to that.
    fn come_near(&self, world: &World, rects: (u32, u32), until: f64) -> bool {
        let [a, b] = [rects.0, rects.1].map(|rect| self.glance(world, self.search.body_of(rect)));
        let [far_a, far_b] = [rects.0, rects.1].map(|rect| world.bodies.rects[rect as usize].far());
        let from = a.time.max(b.time);
        let d = (b.o + b.v * (from - b.time)) - (a.o + a.v * (from - a.time));
        let (u, left) = (b.v - a.v, until - from);
        let uu = u.norm_squared();
        let nearest = if uu > 0.0 { (-d.dot(&u) / uu).clamp(0.0, left.max(0.0)) } else { 0.0 };
        let room = far_a + far_b + (a.pulled + b.pulled) * self.dt * self.dt;
        (d + u * nearest).norm_squared() <= room * room * SURE
    }

    fn glance(&self, world: &World, body: usize) -> Glance {
        let (o, pull) = (world.bodies.frame[body].o, self.pulls.on(body));
        let (o, v, time) = match self.rows.of(body as u32) {
            Some(row) => {
                let (row, spent) = (&self.rows.rows[row as usize], self.fliers.spent[row as usize]);
                (o + row.place(), row.motion().v, spent)
            }
            None => {
                let v = world.bodies.motion[body].v;
                (o + v * self.gone, v, 0.0)
            }
        };
        Glance { o, v, time, pulled: pull.a.norm() + pull.drag.0 * v.norm() }
    }
}

/// Whether two bodies come so little towards each other in a time: fast or not, they are so for others only.
fn are_slow_together(world: &World, rects: (u32, u32), paths: &[Path; 2], time: f64) -> bool {
    let [a, b] = [rects.0, rects.1].map(|rect| &world.bodies.rects[rect as usize]);
    let [one, two] = paths;
    one.closing(two, a.far(), b.far(), time) <= SLOW * a.half().min().min(b.half().min())
}
