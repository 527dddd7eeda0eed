//! Bodies that are in each other are moved apart; no velocity comes of it but what keeps angular momentum.
//!
//! The least displacements, weighted by mass, with which no point is deeper than it may be by the end of the step: the same problem as
//! that of velocities, so the same sweeps solve it, with displacements in the place of velocities. Friction holds there too:
//! what leans on a face does not slip off because something in the heap is lifted. Among many touches that would cost too much:
//! there every sweep over velocities moves apart what it meets ([`super::sweep`]).

use super::Contacts;
use super::arms::Arms;
use super::blocks::Block;
use super::rest::Effort;
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row, SPIN, TURN, VX, VZ, X, Z};
use super::solve::PATIENCE;
use super::sweep::{Part, Parting, gaps, gather, of};
use crate::area::Vec2;
use crate::bodies::Motion;
use crate::frame::perp;
use crate::lanes::Wide;
use crate::width::Work;
use crate::world::World;

/// Sweeps in a step, and rounds after that: so many times touches, cubed, for where there are few it is worth being done to the end.
const SWEEPS: usize = 6;
const ROUNDS: u64 = 2_000_000_000;

/// Displacements below this share of the deepest are not worth another round.
const GOOD: f64 = 1e-3;

impl Contacts {
    /// Moves bodies apart that are deeper in each other than they may be by now; whether any were.
    pub(super) fn part_overlaps(&mut self, world: &mut World) -> bool {
        let (rows, blocks) = (&self.rows.rows[..], &self.blocks.blocks[..]);
        let excess = self.width.run(Excess { rows, blocks });
        if excess <= self.band {
            return false;
        }
        if self.are_few() {
            self.part_to_the_end(world, excess);
        } else {
            let parting = self.parting();
            let (rows, blocks) = (&mut self.rows.rows[..], &self.blocks.blocks[..]);
            self.width.run(Part { rows, blocks, parting });
        }
        true
    }

    /// How bodies are moved apart among many touches.
    pub(super) fn parting(&self) -> Parting {
        Parting { band: self.band, keeps_turning: !self.falls }
    }

    fn part_to_the_end(&mut self, world: &mut World, excess: f64) {
        self.aside.keep(&self.rows.rows, &self.blocks.blocks);
        self.blocks.forget_pushes();
        self.blocks.turned.clear();
        self.rows.rows.iter_mut().for_each(|row| row.set_motion(Motion::default()));
        let (rows, blocks) = (&self.rows.rows[..], &mut self.blocks.blocks[..]);
        self.width.run(Ask { rows, blocks, band: self.band });
        self.sweep_touches(world, SWEEPS);
        let most = (ROUNDS / (self.blocks.count as u64).pow(3)).min(u64::from(PATIENCE)) as u32;
        self.settle_for(world, Effort { enough: (GOOD * excess).max(self.band), most });
        self.mean.clear();
        self.mean.extend(self.rows.rows.iter().map(|row| row.after(1.0)));
        self.aside.exchange(&mut self.rows.rows, &mut self.blocks.blocks);
        for touch in 0..self.touches.len() {
            self.part_bodies(touch);
        }
        for (row, moved) in self.rows.rows.iter_mut().zip(&self.mean) {
            [row.0[X], row.0[Z], row.0[TURN]] = moved.come_so_far();
        }
    }

    /// Moves the bodies of a touch apart by the impulses that are laid aside, after those of the touches before. Two mobile ones keep
    /// their angular momentum about each other, as they do among many touches ([`super::sweep`]).
    fn part_bodies(&mut self, touch: usize) {
        let Some((block, lane)) = self.blocks.lane(touch) else { return };
        let (at, _) = self.blocks.place[touch];
        let [p1, p2, along] = self.aside.pushes[at as usize].map(|moved| moved.0[lane]);
        if p1 + p2 == 0.0 && along == 0.0 {
            return;
        }
        let rows = [block.row_a[lane] as usize, block.row_b[lane] as usize];
        let [a, b] = rows.map(|row| &self.rows.rows[row].0);
        let n = Vec2::new(block.nx.0[lane], block.nz.0[lane]);
        let t = -perp(n);
        let moved = n * (p1 + p2) + t * along;
        let arms = Arms::in_lane(block, lane, a, b);
        let before = arms.along_b - arms.along_a;
        let after = before + (a[INVERSE_MASS] + b[INVERSE_MASS]) * (p1 + p2);
        let both = a[INVERSE_MASS].min(b[INVERSE_MASS]) > 0.0;
        let lost = if both { moved.perp(&Vec2::new(b[VX] - a[VX], b[VZ] - a[VZ])) } else { 0.0 };
        let (turns_a, turns_b) = (a[INVERSE_MOMENT], b[INVERSE_MOMENT]);
        let (slower, turn) = if before.min(after) > 0.0 {
            (t * (lost / after), 0.0)
        } else if lost != 0.0 && turns_a + turns_b > 0.0 {
            // As far as it gives no energy.
            let limit = -2.0 * (a[SPIN] * turns_b + b[SPIN] * turns_a) / (turns_a + turns_b);
            let turn = -lost * (turns_a * turns_b) / (turns_a + turns_b);
            (Vec2::zeros(), turn.clamp(limit.min(0.0), limit.max(0.0)))
        } else {
            (Vec2::zeros(), 0.0)
        };
        for (row, sign) in rows.into_iter().zip([-1.0, 1.0]) {
            let row = &mut self.rows.rows[row].0;
            let mass = sign * row[INVERSE_MASS];
            (row[X], row[Z]) = (row[X] + mass * moved.x, row[Z] + mass * moved.y);
            (row[VX], row[VZ]) = (row[VX] + mass * slower.x, row[VZ] + mass * slower.y);
            row[SPIN] += turn;
        }
    }
}

/// How much deeper than it may be is the deepest point \[m\].
struct Excess<'a> {
    rows: &'a [Row],
    blocks: &'a [Block],
}

impl Work for Excess<'_> {
    type Out = f64;

    #[inline(always)]
    fn run<V: Wide>(self) -> f64 {
        let mut most = V::zero();
        for block in self.blocks {
            let (a, b) = (gather::<V>(self.rows, &block.row_a), gather::<V>(self.rows, &block.row_b));
            let (gap, least) = (gaps(block, &a, &b), of::<V>(&block.least));
            most = most.max(least[0] - gap[0]).max(least[1] - gap[1]);
        }
        most.greatest()
    }
}

/// How far every point is to be moved apart at least: by less than nothing where it has room.
struct Ask<'a> {
    rows: &'a [Row],
    blocks: &'a mut [Block],
    /// Depths up to this are none \[m\].
    band: f64,
}

impl Work for Ask<'_> {
    type Out = ();

    #[inline(always)]
    fn run<V: Wide>(self) {
        let band = V::all(self.band);
        for block in self.blocks {
            let (a, b) = (gather::<V>(self.rows, &block.row_a), gather::<V>(self.rows, &block.row_b));
            let (gap, least) = (gaps(block, &a, &b), of::<V>(&block.least));
            for k in 0..2 {
                block.asked[k] = (least[k] - gap[k] - band).eight();
            }
        }
    }
}
