//! Fast bodies: those that move by more than half their size within a sub-step.
//!
//! Touches are laid out for what faces each other as a step begins; what is fast may be past a corner and gone by its end. So
//! fast bodies are taken before all others: each is followed along its flight to the first impact with anything that its way
//! meets ([`crate::impact_time`] never steps over one), in the order of time, and becomes a touch there. What an impact makes
//! fast is followed from then on.
//!
//! What is not fast and touches others is held by them: nothing pulls at it on its way to where it is met.
//!
//! In a crowd of fast bodies impacts that take energy would never end, each a little weaker than the one before. Two that touch and
//! hardly come towards each other are left to the pushes, and what has met mobile bodies so many times within a sub-step is followed
//! to fixed ones only.

use super::Contacts;
use super::links::Links;
use super::meeting::Two;
use super::rows::Row;
use crate::bodies::{Bodies, Motion};
use crate::broad_phase::met::Bounds;
use crate::flight::{Path, Pull};
use crate::world::World;

/// Impacts in a sub-step at most, for every fast body.
const MOST_STRIKES: usize = 64;

/// Bodies come no further in a sub-step than this many times as far as in the one before, but by impacts.
const MORE: f64 = 2.0;

/// A meeting foreseen, or one that has been.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meets {
    /// From the start of the sub-step \[s\].
    pub(super) time: f64,
    pub(super) rects: (u32, u32),
}

/// What is known of whom a fast body meets next.
#[derive(Clone, Copy, Debug)]
pub(super) enum Foreseen {
    NotYet,
    Nobody,
    This(Meets),
}

/// A body that is followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Followed {
    pub(super) row: u32,
    /// Whom it meets next, and how often it has met mobile bodies and lost by it.
    pub(super) next: Foreseen,
    pub(super) strikes: u32,
    /// All that it sweeps over in what is left of the sub-step, and whether it leaves what it was taken to sweep over when the step
    /// began.
    pub(super) swept: Bounds,
    pub(super) strays: bool,
}

/// The fast bodies of a sub-step.
#[derive(Clone, Debug, Default)]
pub(super) struct Fast {
    pub(super) followed: Vec<Followed>,
    /// By row, whether it is one of them.
    is_fast: Vec<bool>,
    /// How far any body may come in a sub-step at most, when last looked at \[m\].
    farthest: f64,
    /// Who has met, and when; and touches by their rows.
    pub(super) met: Vec<Meets>,
    pub(super) by_row: Links,
    /// Rectangles that may be met.
    pub(super) near: Vec<u32>,
    /// The bodies that are fast as the part of the step begins.
    bodies: Vec<u32>,
    is_near: Vec<bool>,
    /// Touches of fast bodies that do not press, and whether they face each other still.
    looked: Vec<(u32, bool)>,
}

impl Fast {
    /// Touches that were looked at again in this sub-step, and whether the two face each other still.
    pub(super) fn looked(&self) -> &[(u32, bool)] {
        &self.looked
    }

    pub(super) fn bodies(&self) -> impl Iterator<Item = u32> {
        self.bodies.iter().copied()
    }
}

/// How far a body that moves so for a time comes at most, none of its points being further out than that.
#[inline]
fn bound(Motion { v, omega }: Motion, reach: f64, time: f64) -> f64 {
    (v.x.abs() + v.y.abs() + omega.abs() * reach) * time
}

/// No point of a body is further out than that, nor, of a mobile one, than of any \[m\].
#[inline]
fn most(bodies: &Bodies, body: usize, farthest: f64) -> f64 {
    if bodies.is_mobile(body) { farthest } else { bodies.reach(body) }
}

/// Whether a body that moves so for a time comes further than half its size.
fn is_fast(bodies: &Bodies, body: usize, Motion { v, omega }: Motion, time: f64) -> bool {
    (v.norm() + omega.abs() * bodies.reach(body)) * time > bodies.smallest_half(body)
}

impl Contacts {
    /// Finds the bodies that are fast over sub-steps of that length and may come to others; whether there are any.
    pub(super) fn find_fast(&mut self, world: &World, h: f64) -> bool {
        let bodies = &world.bodies;
        let Fast { bodies: fast, is_near, farthest, .. } = &mut self.fast;
        fast.clear();
        *farthest = 0.0;
        for body in 0..bodies.len() {
            let far = bound(bodies.motion[body], most(bodies, body, self.farthest), h);
            *farthest = farthest.max(far);
            if far > self.smallest && is_fast(bodies, body, bodies.motion[body], h) {
                fast.push(body as u32);
            }
        }
        if fast.is_empty() {
            return false;
        }
        is_near.clear();
        is_near.resize(bodies.len(), false);
        for rect in self.search.near().iter().flat_map(|pair| [pair.0, pair.1]) {
            is_near[self.search.body_of(rect)] = true;
        }
        fast.retain(|body| is_near[*body as usize]);
        !fast.is_empty()
    }

    /// The touch of two rectangles, if they have one.
    pub(super) fn touch_of(&self, rects: (u32, u32)) -> Option<usize> {
        let rows = [rects.0, rects.1].map(|rect| self.rows.of(self.search.body_of(rect) as u32));
        let row = rows.into_iter().flatten().find(|row| self.rows.mobile_of(*row).is_some())?;
        self.fast.by_row.of(row as usize).find(|k| self.touches[*k].rects == rects)
    }

    /// Follows fast bodies through the sub-step.
    pub(super) fn strike_fast(&mut self, world: &mut World, h: f64) {
        self.fast.looked.clear();
        if self.fast.farthest * MORE <= self.smallest {
            return;
        }
        let Fast { followed, met, by_row, is_fast, farthest, .. } = &mut self.fast;
        followed.clear();
        met.clear();
        by_row.clear();
        is_fast.clear();
        is_fast.resize(self.rows.rows.len(), false);
        *farthest = 0.0;
        for row in 0..self.rows.rows.len() as u32 {
            self.follow_if_fast(world, row, h);
        }
        let mut strikes = 0;
        while strikes < MOST_STRIKES * self.fast.followed.len() {
            self.foresee(world, h);
            let Some(next) = self.earliest() else {
                self.look_at_fast(world);
                break;
            };
            self.meet_fast(world, next, h);
            strikes += 1;
        }
    }

    /// Where fast bodies have been followed to, they stand otherwise than when the step began.
    fn look_at_fast(&mut self, world: &World) {
        for k in 0..self.touches.len() {
            let (a, b) = self.of_touch[k];
            if !self.is_fast(a) && !self.is_fast(b) {
                continue;
            }
            let (_, paths) = self.paths_together(world, self.touches[k].rects);
            if !self.is_pressing(world, k, &paths) {
                let found = self.look_again(world, k);
                self.fast.looked.push((k as u32, found));
            }
        }
    }

    /// Fast bodies have met all that they meet in the sub-step: what they do not touch now they are not pushed away from, and where
    /// they turn fast a straight line says nothing of how deep they are by its end.
    pub(super) fn leave_fast(&mut self) {
        for at in 0..self.fast.looked.len() {
            let (k, found) = self.fast.looked[at];
            let (k, [Row(a), Row(b)]) = (k as usize, self.rows_now(k as usize));
            for p in 0..2 {
                self.blocks.part_nothing(k, p);
                if !found || self.touches[k].state(p, &a, &b).0 > self.band {
                    self.blocks.ask_nothing(k, p);
                }
            }
        }
    }

    /// A row whose body is fast by now is followed.
    fn follow_if_fast(&mut self, world: &World, row: u32, h: f64) {
        if self.note_speed(world, row, h) <= self.smallest || self.is_fast(row) {
            return;
        }
        let motion = self.rows.rows[row as usize].motion();
        if self.rows.body_of(row).is_some_and(|body| is_fast(&world.bodies, body, motion, h)) {
            let Fast { followed, is_fast, .. } = &mut self.fast;
            followed.push(Followed { row, next: Foreseen::NotYet, strikes: 0, swept: Bounds::NOTHING, strays: false });
            is_fast.resize(self.rows.rows.len(), false);
            is_fast[row as usize] = true;
        }
    }

    /// Notes how far a row's body may come in a sub-step as it moves now, and gives it.
    pub(super) fn note_speed(&mut self, world: &World, row: u32, h: f64) -> f64 {
        let farthest = self.rows.body_of(row).map_or(0.0, |body| most(&world.bodies, body, self.farthest));
        let far = bound(self.rows.rows[row as usize].motion(), farthest, h);
        self.fast.farthest = self.fast.farthest.max(far);
        far
    }

    fn is_fast(&self, row: u32) -> bool {
        self.fast.is_fast.get(row as usize).is_some_and(|is_fast| *is_fast)
    }

    /// The next impact of all.
    fn earliest(&self) -> Option<Meets> {
        let foreseen = self.fast.followed.iter().filter_map(|followed| match followed.next {
            Foreseen::This(meets) => Some(meets),
            Foreseen::NotYet | Foreseen::Nobody => None,
        });
        foreseen.reduce(|first, next| if next.time < first.time { next } else { first })
    }

    /// Whether a touch has pressed and is still in touch.
    pub(super) fn is_pressing(&self, world: &World, k: usize, paths: &[Path; 2]) -> bool {
        self.blocks.presses(k) && self.two(world, self.touches[k].rects).depth(paths) >= -self.band
    }

    /// Two rectangles, the earlier created first.
    pub(super) fn two<'a>(&self, world: &'a World, rects: (u32, u32)) -> Two<'a> {
        Two::between(&world.bodies, [rects.0, rects.1].map(|rect| (self.search.body_of(rect), rect as usize)))
    }

    /// The bodies of two rectangles as they fly from a moment of the sub-step that both have come to, and which that is.
    pub(super) fn paths_together(&self, world: &World, rects: (u32, u32)) -> (f64, [Path; 2]) {
        let bodies = [rects.0, rects.1].map(|rect| self.search.body_of(rect));
        let spent = bodies.map(|body| self.rows.of(body as u32).map_or(0.0, |row| self.fliers.spent[row as usize]));
        let from = spent[0].max(spent[1]);
        (from, [0, 1].map(|k| self.path_ahead(world, bodies[k]).after(from - spent[k])))
    }

    /// How a body flies on from where it has come to: what is not fast and touches others is held by them.
    fn path_ahead(&self, world: &World, body: usize) -> Path {
        let path = self.path_of(world, body);
        if self.is_held_up(body) { Path { pull: Pull::NONE, ..path } } else { path }
    }

    fn is_held_up(&self, body: usize) -> bool {
        let Some(row) = self.rows.of(body as u32) else { return false };
        self.rows.mobile_of(row).is_some_and(|at| self.rows.degree[at] > 0) && !self.is_fast(row)
    }

    /// Two bodies meet: they go where they do, and exchange motion.
    fn meet_fast(&mut self, world: &mut World, next: Meets, h: f64) {
        let bodies = [next.rects.0, next.rects.1].map(|rect| self.search.body_of(rect));
        bodies.into_iter().for_each(|body| self.join(world, body, None));
        let (from, paths) = self.paths_together(world, next.rects);
        self.fast.met.push(next);
        let two = self.two(world, next.rects);
        let Some((after, manifold)) = two.meet(&paths, h - from) else {
            self.forget(bodies, false);
            return;
        };
        let touch = two.touch_at(&paths, after, &manifold);
        for body in bodies {
            self.fly_to(world, body, from + after);
        }
        let k = self.touch_of(next.rects).unwrap_or_else(|| {
            self.apart.join(next.rects);
            self.add_touch(world, touch)
        });
        let moved = paths.map(|path| path.after(after));
        let moved = if self.touches[k].a as usize == bodies[0] { moved } else { [moved[1], moved[0]] };
        self.exchange(world, k, (&manifold, &moved), h);
        self.look_again(world, k);
        let weakens = self.touches[k].surface.restitution < 1.0;
        self.forget(bodies, weakens && bodies.into_iter().all(|body| world.bodies.is_mobile(body)));
        for row in bodies.map(|body| self.rows.of(body as u32)).into_iter().flatten() {
            self.follow_if_fast(world, row, h);
        }
    }

    /// A mobile body flies on to a time of the sub-step.
    fn fly_to(&mut self, world: &mut World, body: usize, time: f64) {
        let Some(row) = self.rows.of(body as u32).filter(|row| self.rows.mobile_of(*row).is_some()) else { return };
        let (path, held) = (self.path_ahead(world, body), self.is_held_up(body));
        let more = time - self.fliers.spent[row as usize];
        self.fliers.go_on(&mut self.rows, row, &path, more);
        self.book_ahead(world, row, (more, !held));
    }

    /// Two bodies have met: what was foreseen of them holds no more.
    fn forget(&mut self, bodies: [usize; 2], counts: bool) {
        let concerns = |rect: u32| bodies.contains(&self.search.body_of(rect));
        for followed in &mut self.fast.followed {
            let own = self.rows.body_of(followed.row).is_some_and(|body| bodies.contains(&body));
            followed.strikes += u32::from(own && counts);
            let other =
                matches!(followed.next, Foreseen::This(meets) if concerns(meets.rects.0) || concerns(meets.rects.1));
            if own || other {
                followed.next = Foreseen::NotYet;
            }
        }
    }
}
