//! Pairs that touch no other and that nothing presses together: left to impacts, without a place in the blocks.
//!
//! When the next impact of such a pair is due is known from where it flies; until then the sub-steps pass it by.

use super::Contacts;
use super::strike::MOST_STRIKES;
use crate::world::World;

/// The pairs that are left to impacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs {
    /// By their touches, in order.
    touches: Vec<u32>,
    /// When the next impact of each is due at the earliest, from the start of the part of the step \[s\].
    due: Vec<f64>,
}

impl Pairs {
    pub(super) fn clear(&mut self) {
        self.touches.clear();
        self.due.clear();
    }

    pub(super) fn push(&mut self, touch: usize) {
        self.touches.push(touch as u32);
        self.due.push(0.0);
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
        for at in 0..self.pairs.touches.len() {
            let k = self.pairs.touches[at] as usize;
            if self.pairs.due[at] > self.gone + h || self.blocks.lane(k).is_some() {
                continue;
            }
            self.pairs.due[at] = self.strike_pair(world, k, h);
        }
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

    /// Impacts of a pair within the sub-step; gives when the next is due.
    fn strike_pair(&mut self, world: &mut World, k: usize, h: f64) -> f64 {
        for _ in 0..MOST_STRIKES {
            let spent = self.ahead(k);
            let left = self.dt - self.gone - spent;
            if self.touches[k].met || !self.is_lonely(k) || !self.may_strike(k, left, h) {
                return f64::INFINITY;
            }
            let Some(meets) = self.meets(world, k, [true; 2], left) else { return f64::INFINITY };
            if spent + meets.time > h {
                return self.gone + spent + meets.time;
            }
            if !self.strike_at(world, k, [true; 2], &meets, h) {
                return self.gone + 2.0 * h;
            }
            let met = self.touches[k].surface.restitution == 0.0;
            self.look_again(world, k);
            self.touches[k].met = met;
        }
        self.join_blocks(k);
        f64::INFINITY
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
