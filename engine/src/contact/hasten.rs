//! Few touches, improved in pairs of sweeps, to and fro, each pair from beyond the last two.
//!
//! Sweeps lower the energy that is left to be lowered; where they creep, a pair goes the way of the last on (Nesterov 1983), unless
//! that led astray (O'Donoghue and Candès 2015). What a pair changes is measured as kinetic energy, in which light and heavy bodies
//! count alike. Where little is gained it is given up: a jam, and friction at its limit, may have no end to come to.

use super::Contacts;
use super::blocks::Block;
use super::kept::Kept;
use super::rest::{Effort, Momentum, Settled};
use super::rows::{INVERSE_MASS, INVERSE_MOMENT, Row};
use crate::bodies::Motion;
use crate::lanes::Eight;
use crate::world::World;

/// Pairs of sweeps after which what is gained is looked at, and what share of the change may be left then.
const SPELL: u32 = 25;
const GAINS: f64 = 0.95;

/// Where the sweeps began, the end of the last pair, and where the present one began: beyond it.
#[derive(Clone, Debug, Default)]
pub(super) struct Hasten {
    first: Kept,
    last: Kept,
    beyond: Vec<Motion>,
}

/// What a pair of sweeps changed.
#[derive(Clone, Copy, Debug)]
struct Change {
    /// Twice the kinetic energy of the change \[J\].
    energy: f64,
    /// The greatest change of a velocity, at the radius of gyration too, squared \[m²/s²\].
    most: f64,
    /// How far it goes on the way the last pair led; less than nothing where it turns back.
    onward: f64,
}

impl Contacts {
    /// Improves all touches until they are settled, or nothing much is gained; to the end of the effort in any case if it is patient.
    pub(super) fn hasten(&mut self, world: &mut World, effort: Effort, patient: bool) -> Settled {
        let (mut momentum, mut rounds, mut enough) = (Momentum::default(), 0, false);
        let (mut first, mut before, mut spell) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        let mut left = 0.0;
        self.hasten.first.keep(&self.rows.rows, &self.blocks.blocks);
        self.hasten.last.keep(&self.rows.rows, &self.blocks.blocks);
        while rounds < effort.most {
            rounds += 1;
            self.hasten.go_beyond(&mut self.rows.rows, &mut self.blocks.blocks, momentum.share());
            self.sweep_touches(world, 2);
            let change = self.hasten.change(&self.rows.rows);
            left = change.most.sqrt();
            enough = left <= effort.enough;
            if rounds == 1 {
                first = change.energy;
            }
            let gives_up = rounds % SPELL == 0 && !patient && change.energy > GAINS * spell;
            if enough || gives_up {
                break;
            }
            if rounds % SPELL == 0 {
                spell = change.energy;
            }
            momentum.go_on(change.onward < 0.0 || change.energy > before);
            before = change.energy;
        }
        if !enough && before > first {
            self.hasten.first.give_back(&mut self.rows.rows, &mut self.blocks.blocks);
        }
        Settled { rounds, left, enough }
    }
}

impl Hasten {
    /// On beyond the last two ends of pairs, by a share of the way between them.
    fn go_beyond(&mut self, rows: &mut [Row], blocks: &mut [Block], share: f64) {
        self.beyond.clear();
        for (row, last) in rows.iter_mut().zip(&mut self.last.motions) {
            let now = row.motion();
            let beyond =
                Motion { v: now.v + (now.v - last.v) * share, omega: now.omega + share * (now.omega - last.omega) };
            *last = now;
            row.set_motion(beyond);
            self.beyond.push(beyond);
        }
        let share = Eight::all(share);
        for (block, last) in blocks.iter_mut().zip(&mut self.last.pushes) {
            let now = block.pushes();
            block.set_pushes(core::array::from_fn(|k| now[k] + share * (now[k] - last[k])));
            *last = now;
        }
    }

    /// What the pair has changed.
    fn change(&self, rows: &[Row]) -> Change {
        let mut change = Change { energy: 0.0, most: 0.0, onward: 0.0 };
        for ((row, last), beyond) in rows.iter().zip(&self.last.motions).zip(&self.beyond) {
            if row.0[INVERSE_MASS] == 0.0 {
                continue;
            }
            let (mass, moment) = (1.0 / row.0[INVERSE_MASS], 1.0 / row.0[INVERSE_MOMENT]);
            let now = row.motion();
            let (dv, turn) = (now.v - beyond.v, now.omega - beyond.omega);
            let energy = mass * dv.norm_squared() + moment * turn * turn;
            change.energy += energy;
            change.most = change.most.max(energy * row.0[INVERSE_MASS]);
            change.onward += mass * dv.dot(&(now.v - last.v)) + moment * turn * (now.omega - last.omega);
        }
        change
    }
}
