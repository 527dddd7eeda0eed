//! A sub-step solved: pushes and friction at every touch that is laid out.

use super::blocks::Blocks;
use super::look::{Look, Warm};
use super::midway::Midway;
use super::rest::{Effort, Settled};
use super::sweep::Sweep;
use super::{Contacts, flying, rest, weights};
use crate::lanes::LANES;
use crate::threads::Threads;
use crate::world::World;

/// Touches to solve in a sub-step, in sweeps to and fro by turns, within limits; and to improve after that. In a quiet scene, where
/// things lean on each other, more of it pays than where they tumble.
struct Budget {
    swept: usize,
    improved: u64,
}

const IN_QUIET: Budget = Budget { swept: 16_000, improved: 8_000 };
const IN_MOTION: Budget = Budget { swept: 4_000, improved: 2_000 };

/// Where there are few touches they may all be improved until nothing is left to gain, at little cost: so many rounds times touches,
/// cubed. A heavy body that falls on a heap, or a house of cards, is worth it.
const THOROUGH: u64 = 10_000_000_000;

/// Up to so many touches are few.
const FEW: usize = 600;

/// Changes of velocity below this share of what gravity does in a sub-step, or where there is none of how fast things are, are not
/// worth another round where things move.
const GOOD: f64 = 1e-3;
const LEAST_SWEEPS: usize = 3;
const MOST_SWEEPS: usize = 16;

/// Sweeps over what pushes have come to while touches were solved.
const SPREAD_SWEEPS: usize = 2;

/// Sweeps where the pushes of the sub-step before were no help and all begins at nothing.
const FRESH_SWEEPS: usize = 8;

/// A scene in which no body is faster than this many times what gravity does in a sub-step is quiet: its contacts push on from
/// where its bodies were, for they hardly move.
const QUIET: f64 = 16.0;

/// A scene in which no body is faster than this many times that stands still, or is about to: worth being settled to the end.
const STILL: f64 = 2.0;

/// Rounds to settle what stands still, in a sub-step at most; after the first few the weights are guessed.
pub(super) const PATIENCE: u32 = 500;
const FIRST: u32 = 24;

/// Weights are guessed where more than this share of what gravity does is not borne yet.
const UNBALANCED: f64 = 1e-2;

/// Where there are few touches, only if nothing falls: is faster than this many times what gravity does in a sub-step.
const FALLS: f64 = 0.5;

/// How often in a sub-step pushes spread to what stayed apart.
const MOST_SPREADS: usize = 4;

impl Contacts {
    /// Pushes and friction at all touches that are laid out.
    pub(super) fn solve(&mut self, world: &mut World, h: f64) {
        let pulled = world.plan.gravity().norm() * h;
        self.look(0, h, flying::FORCEFUL * pulled);
        self.leave_clear();
        let fastest = self.rows.fastest();
        let turns = h == self.dt && self.are_few() && pulled > 0.0 && fastest > STILL * pulled;
        if turns {
            self.turn_midway(h, flying::FORCEFUL * pulled);
        }
        self.fliers.set_out(&mut self.rows, &self.pulls, h, &Threads::ONE);
        self.blocks.note_places(&self.rows);
        let quiet = fastest <= QUIET * pulled;
        // Where nothing pulls, what counts is how fast things are.
        let scale = if pulled > 0.0 { pulled } else { fastest };
        let budget = if quiet { IN_QUIET } else { IN_MOTION };
        if quiet && !turns {
            self.fliers.renew(&mut self.rows, &Threads::ONE);
        } else {
            self.width.run(Warm { rows: &mut self.rows.rows, blocks: &self.blocks.blocks });
        }
        if fastest <= STILL * pulled && pulled > 0.0 {
            self.settle_touches(world, h, pulled, fastest);
        } else {
            self.push_on(world, (h, scale), &budget);
        }
        if turns {
            self.slide();
        }
        // A jam has no solution: pushes grow without end, and do harm once it gives way.
        if self.gained(world) {
            self.begin_afresh();
            self.push_on(world, (h, scale), &Budget { swept: FRESH_SWEEPS * self.blocks.count, ..budget });
            if self.gained(world) {
                self.begin_afresh();
                self.sweep_touches(world, FRESH_SWEEPS);
            }
        }
    }

    /// Whether contact has made more of the motions than it can.
    fn gained(&self, world: &World) -> bool {
        self.fliers.gained(&self.rows, self.rows.driven(&world.bodies))
    }

    /// Touches that press are taken as they are midway through the sub-step.
    fn turn_midway(&mut self, h: f64, pulled: f64) {
        self.fliers.foresee(&self.rows, &self.pulls, h, &mut self.mean);
        self.blocks.begin_turning(&self.touches);
        let Blocks { blocks, turned, .. } = &mut self.blocks;
        let (rows, mean) = (&self.rows.rows[..], &self.mean[..]);
        self.width.run(Midway { rows, mean, blocks, turned, band: self.band, pulled });
    }

    /// Improves all touches of a scene that moves, to the scale of velocities that count \[m/s\].
    fn push_on(&mut self, world: &mut World, (h, scale): (f64, f64), budget: &Budget) {
        self.sweep_touches(world, (budget.swept / self.blocks.count).clamp(LEAST_SWEEPS, MOST_SWEEPS));
        self.spread(world, h);
        let most = self.worthwhile(budget);
        if most > 0 {
            let effort = Effort { enough: GOOD * scale, most };
            if self.are_few() {
                self.hasten(world, effort, false);
            } else {
                self.settle_for(world, effort);
            }
        }
    }

    /// Nothing pushes any more, and nothing has been moved apart yet.
    fn begin_afresh(&mut self) {
        self.blocks.put_back(&mut self.rows);
        self.blocks.forget_pushes();
        self.fliers.let_go(&mut self.rows);
    }

    /// What has been pushed may now come to touch what stayed apart from it, which is pushed in turn.
    fn spread(&mut self, world: &mut World, h: f64) {
        for _ in 0..MOST_SPREADS {
            let from = self.blocks.later();
            if !self.wake_pushed(world, h) {
                break;
            }
            self.look(from, h, 0.0);
            self.leave_clear();
            for sweep in 0..SPREAD_SWEEPS {
                self.sweep(from, sweep % 2 == 1);
            }
            world.work.touches_solved += (SPREAD_SWEEPS * (self.blocks.blocks.len() - from) * LANES) as u64;
        }
    }

    /// Improves all touches of a scene that stands still together, for as long as it is worth it.
    fn settle_touches(&mut self, world: &mut World, h: f64, pulled: f64, fastest: f64) {
        let most = if fastest == 0.0 { PATIENCE } else { self.patience };
        let settled = rest::settled(self.touches.len(), pulled);
        let Settled { left, enough, .. } = self.settle_for(world, Effort { enough: settled, most: FIRST.min(most) });
        if !enough {
            if left > UNBALANCED * pulled && (!self.are_few() || fastest < FALLS * pulled) {
                let pull = world.plan.gravity() * h;
                weights::guess(&mut self.touches, &self.of_touch, &self.rows, &world.bodies, pull, self.band);
                self.fliers.carry(&self.rows, (&self.touches, &self.of_touch), 1.0);
                self.fliers.renew(&mut self.rows, &Threads::ONE);
                self.blocks.renew(&self.touches);
            }
            let mut more = self.settle_for(world, Effort { enough: settled, most });
            if !more.enough && self.are_few() {
                more = self.hasten(world, Effort { enough: settled, most: self.worthwhile(&IN_QUIET) }, true);
            }
            self.patience =
                if more.enough { (2 * self.patience).min(PATIENCE) } else { (self.patience / 2).max(FIRST) };
        }
    }

    /// Whether there are so few touches that sweeps may go on until nothing is left to gain.
    pub(super) fn are_few(&self) -> bool {
        self.blocks.count <= FEW
    }

    /// Whether most of so many touches do nothing: what nothing presses together flies apart once it has met.
    pub(super) fn idles(&self, touches: usize) -> bool {
        touches > FEW && !self.falls
    }

    /// How many rounds are always worth it.
    fn worthwhile(&self, budget: &Budget) -> u32 {
        let count = self.blocks.count as u64;
        (budget.improved / count + THOROUGH / count.pow(3)).min(u64::from(PATIENCE)) as u32
    }

    pub(super) fn settle_for(&mut self, world: &mut World, effort: Effort) -> Settled {
        let settled = self.rest.settle(&mut self.rows, &mut self.blocks, (self.width, &world.threads), effort);
        world.work.touches_solved += u64::from(settled.rounds) * self.blocks.count as u64;
        settled
    }

    pub(super) fn sweep_touches(&mut self, world: &mut World, sweeps: usize) {
        for sweep in 0..sweeps {
            self.sweep(0, sweep % 2 == 1);
        }
        world.work.touches_solved += (sweeps * self.blocks.count) as u64;
    }

    /// What every point asks for in the sub-step, from that block on.
    pub(super) fn look(&mut self, from: usize, h: f64, pulled: f64) {
        let few = self.are_few();
        let (rows, blocks) = (&self.rows.rows[..], &mut self.blocks.blocks[from..]);
        let look = Look::<false> { rows, blocks, h, band: self.band, pulled };
        if pulled > 0.0 && few { self.width.run(look.where_bodies_are()) } else { self.width.run(look) }
    }

    /// A sweep over the blocks from that one on.
    fn sweep(&mut self, from: usize, back: bool) {
        let (parts, parting) = (!self.are_few(), self.parting());
        let idles = self.idles(self.blocks.count);
        let Blocks { blocks, turned, .. } = &mut self.blocks;
        let turned = turned.get(from..).unwrap_or_default();
        let (rows, blocks) = (&mut self.rows.rows[..], &mut blocks[from..]);
        match (self.plan.friction, parts) {
            (true, true) => self.width.run(Sweep::<true, true, false> { rows, blocks, turned, parting, idles, back }),
            (true, false) if turned.is_empty() => {
                self.width.run(Sweep::<true, false, false> { rows, blocks, turned, parting, idles, back });
            }
            (true, false) => self.width.run(Sweep::<true, false, true> { rows, blocks, turned, parting, idles, back }),
            (false, true) => self.width.run(Sweep::<false, true, false> { rows, blocks, turned, parting, idles, back }),
            (false, false) => {
                self.width.run(Sweep::<false, false, false> { rows, blocks, turned, parting, idles, back });
            }
        }
    }
}
