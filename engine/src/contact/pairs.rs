//! Pairs that touch no other and that nothing presses together: left to impacts, without a place in the blocks.
//!
//! When the next impact of such a pair is due is known from where it flies; until then the sub-steps pass it by.

use super::Contacts;
use super::meeting::{Two, Way};
use super::strike::{MOST_STRIKES, Meets};
use crate::world::World;

/// Fewer pairs than so many for a thread are not worth being shared out.
const PAIRS_PER_THREAD: usize = 512;

/// The next impact of a pair.
#[derive(Clone, Copy, Debug)]
struct Due {
    /// When it is due at the earliest, from the start of the part of the step \[s\].
    time: f64,
    /// How the pair meets then; not known, or at once where its rectangles overlap, without.
    way: Option<Way>,
}

impl Due {
    /// It is to be looked for.
    const UNKNOWN: Due = Due { time: 0.0, way: None };
    const NEVER: Due = Due { time: f64::INFINITY, way: None };
}

/// The pairs that are left to impacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    /// By their touches, in order.
    touches: Vec<u32>,
    due: Vec<Due>,
}

impl Pairs {
    pub(super) fn clear(&mut self) {
        self.touches.clear();
        self.due.clear();
    }

    pub(super) fn push(&mut self, touch: usize) {
        self.touches.push(touch as u32);
        self.due.push(Due::UNKNOWN);
    }

    /// The touches that are left out of the blocks.
    pub(super) fn left_out(&self) -> &[u32] {
        &self.touches
    }
}

impl Contacts {
    /// Whether a lonely touch needs no more than impacts: nothing presses, and nothing is to be parted.
    pub(super) fn is_left_to_impacts(&self, k: usize) -> bool {
        let touch = &self.touches[k];
        let free = |body: u32| {
            let pull = self.pulls.on(body as usize);
            pull.a.norm_squared() == 0.0 && pull.alpha == 0.0
        };
        free(touch.a) && free(touch.b) && touch.gap[0].min(touch.gap[1]) >= -self.band
    }

    /// Impacts of pairs within the sub-step.
    pub(super) fn strike_pairs(&mut self, world: &mut World, h: f64) {
        if self.gone == 0.0 {
            self.foresee_pairs(world, h);
        } else {
            self.forget_fast_pairs();
        }
        for at in 0..self.pairs.touches.len() {
            let (k, due) = (self.pairs.touches[at] as usize, self.pairs.due[at]);
            if due.time <= self.gone + h && self.blocks.lane(k).is_none() {
                self.pairs.due[at] = self.strike_pair(world, k, due, h);
            }
        }
    }

    /// Fast bodies have flown and met in this sub-step, maybe otherwise than was foreseen.
    fn forget_fast_pairs(&mut self) {
        for (touch, _) in self.fast.looked() {
            if let Ok(at) = self.pairs.touches.binary_search(touch) {
                self.pairs.due[at] = Due::UNKNOWN;
            }
        }
    }

    /// Looks for the next impacts of all pairs at once: none changes what another does.
    fn foresee_pairs(&mut self, world: &mut World, h: f64) {
        if self.pairs.touches.is_empty() {
            return;
        }
        let Pairs { touches, mut due } = core::mem::take(&mut self.pairs);
        let (contacts, scene) = (&*self, &*world);
        let sought = world.threads.each(&mut due[..], (1, PAIRS_PER_THREAD), |from, due| {
            let mut sought = 0;
            for (due, k) in due.iter_mut().zip(&touches[from..]) {
                *due = contacts.next_of_pair(scene, *k as usize, h, &mut sought);
            }
            sought
        });
        world.work.touches_sought += sought.into_iter().sum::<u64>();
        self.pairs = Pairs { touches, due };
    }

    /// When and how a pair meets next, as its bodies fly by now.
    fn next_of_pair(&self, world: &World, k: usize, h: f64, sought: &mut u64) -> Due {
        let (spent, touch) = (self.ahead(k), &self.touches[k]);
        let left = self.dt - self.gone - spent;
        if touch.met || !self.is_lonely(k) || !self.may_strike(k, left, h) {
            return Due::NEVER;
        }
        let (two, paths) = (Two::of(&world.bodies, touch), self.paths(world, k, [true; 2]));
        if two.overlap(&paths) {
            return Due { time: self.gone + spent, way: None };
        }
        *sought += 1;
        two.way(&paths, left).map_or(Due::NEVER, |(time, way)| Due { time: self.gone + spent + time, way: Some(way) })
    }

    /// Pairs whose bodies have come to touch others are left to impacts no more.
    pub(super) fn join_pairs(&mut self) {
        for at in 0..self.pairs.touches.len() {
            let k = self.pairs.touches[at] as usize;
            if self.blocks.lane(k).is_none() && !self.is_lonely(k) {
                self.join_blocks(k);
            }
        }
    }

    /// Impacts of a pair within the sub-step, the next as it is foreseen; gives the one after.
    fn strike_pair(&mut self, world: &mut World, k: usize, mut next: Due, h: f64) -> Due {
        for _ in 0..MOST_STRIKES {
            if next.way.is_none() {
                let mut sought = 0;
                next = self.next_of_pair(world, k, h, &mut sought);
                world.work.touches_sought += sought;
            }
            if next.time > self.gone + h {
                return next;
            }
            if !self.is_lonely(k) {
                return Due::NEVER;
            }
            let Some(meets) = self.meets_as_foreseen(world, k, next) else { return Due::NEVER };
            if !self.strike_at(world, k, [true; 2], &meets, h) {
                return Due { time: self.gone + 2.0 * h, way: None };
            }
            let met = self.touches[k].surface.restitution == 0.0;
            self.look_again(world, k);
            self.touches[k].met = met;
            next = Due::UNKNOWN;
        }
        self.join_blocks(k);
        Due::NEVER
    }

    /// The meeting of a pair that was foreseen; found anew where its rectangles overlap.
    fn meets_as_foreseen(&self, world: &mut World, k: usize, due: Due) -> Option<Meets> {
        let Some(way) = due.way else { return self.meets(world, k, [true; 2], 0.0) };
        let time = (due.time - self.gone - self.ahead(k)).max(0.0);
        let paths = self.paths(world, k, [true; 2]);
        let manifold = Two::of(&world.bodies, &self.touches[k]).met(&paths, (time, way));
        Some(Meets { paths, time, manifold })
    }

    /// A pair is left to impacts no more.
    fn join_blocks(&mut self, k: usize) {
        self.apart.push_too(&self.rows, self.of_touch[k]);
        self.blocks.add((k, &self.touches[k]), &self.rows, self.of_touch[k], (self.keep, self.band));
        if self.touches[k].surface.restitution > 0.0 && !self.is_lonely(k) {
            self.crowd.push(k as u32);
        }
    }
}
