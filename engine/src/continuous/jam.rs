//! Jams: bodies that are hit again and again without time going on.
//!
//! A light body between a heavy one and a wall, or a row of bodies with little restitution, may bounce without end in no time
//! at all. Then the time for one after the other is over: all contacts that are closed around them act together, without
//! restitution. Should that not help either, as when walls close on what cannot yield, the pair is treated once an iteration
//! from then on, as in stepped motion.

use super::Continuous;
use super::forecast::Pair;
use super::lasting::{self, BAND, standing};
use crate::bodies::Bodies;
use crate::exchange::together;
use crate::plan::ExchangePlan;
use crate::world::World;

/// How often a body may be hit at one instant before it is taken to be jammed: enough for a pile that settles, and finite.
const MOST_AT_ONE_INSTANT: u32 = 200;

/// How often jams are resolved in a segment before a pair counts as stuck.
const MOST_JAMS: u32 = 8;

/// A touch at less than this share of the speeds at which the two pass each other is no progress.
const CREEPING: f64 = 1e-6;

fn creeps(bodies: &Bodies, pair: &Pair) -> bool {
    let turning = |body: u32| bodies.motion[body as usize].omega.abs() * bodies.reach(body as usize);
    let passing = (bodies.motion[pair.a as usize].v - bodies.motion[pair.b as usize].v).norm();
    pair.touch.speed < CREEPING * (passing + turning(pair.a) + turning(pair.b))
}

impl Continuous {
    /// Counts how often bodies are hit without time going on, or hardly at all; and ends it.
    pub(super) fn watch_for_jams(&mut self, world: &mut World, pair: &Pair) {
        let creeps = creeps(&world.bodies, pair);
        for body in [pair.a as usize, pair.b as usize] {
            let (when, times) = self.hit_at[body];
            let again = creeps || self.now <= when;
            self.hit_at[body] = (self.now, if again { times + 1 } else { 0 });
            self.was_hit.push(body as u32);
        }
        let times = |body: u32| self.hit_at[body as usize].1;
        if times(pair.a).max(times(pair.b)) <= MOST_AT_ONE_INSTANT {
            return;
        }
        self.jams += 1;
        // The document's exchange knows no acting together.
        if self.jams > MOST_JAMS || world.plan.exchange != ExchangePlan::Impulse {
            self.hold_stuck((pair.a, pair.b));
        } else {
            self.unjam(world, pair);
        }
    }

    /// Lets all contacts that are closed around a pair act together, without restitution.
    fn unjam(&mut self, world: &mut World, pair: &Pair) {
        for body in 0..world.bodies.len() {
            self.bring(world, body);
        }
        let bodies = &world.bodies;
        let mut points = Vec::new();
        let mut around = vec![pair.a, pair.b];
        let mut next = 0;
        while let Some(&body) = around.get(next) {
            next += 1;
            if !bodies.is_mobile(body as usize) {
                continue;
            }
            for other in (0..bodies.len() as u32).filter(|other| *other != body) {
                let is_done = around[..next - 1].contains(&other) && bodies.is_mobile(other as usize);
                let closed = if is_done { Vec::new() } else { closed_points(bodies, body.min(other), body.max(other)) };
                if !closed.is_empty() && !around.contains(&other) {
                    around.push(other);
                }
                points.extend(closed);
            }
        }
        world.act_together(&points, 0);
        for &body in &around {
            self.hit_at[body as usize].1 = 0;
            if world.bodies.is_mobile(body as usize) {
                self.changed(body as usize);
                self.struck.push(body);
            }
        }
    }
}

/// The points at which two bodies touch, without restitution.
fn closed_points(bodies: &Bodies, a: u32, b: u32) -> Vec<together::Point> {
    let count = |body: u32| bodies.rects_of(body as usize).len() as u32;
    let keys = (0..count(a)).flat_map(|k| (0..count(b)).map(move |l| (a, b, k, l)));
    let standing = keys.filter_map(|key| standing(bodies, key, BAND));
    standing.flat_map(|(manifold, _)| lasting::soft_points(bodies, &manifold)).collect()
}
